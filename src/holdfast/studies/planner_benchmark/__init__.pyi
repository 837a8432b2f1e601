from holdfast.studies.planner_benchmark.cases import BenchmarkCase as BenchmarkCase
from holdfast.studies.planner_benchmark.suite import FailActive as FailActive
from holdfast.studies.planner_benchmark.suite import Score as Score
from holdfast.studies.planner_benchmark.suite import fail_active as fail_active
from holdfast.studies.planner_benchmark.verdicts import BenchmarkMotion as BenchmarkMotion
from holdfast.studies.planner_benchmark.verdicts import find_violation as find_violation
