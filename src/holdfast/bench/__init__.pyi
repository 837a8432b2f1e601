from holdfast.bench.cases import BenchmarkCase as BenchmarkCase
from holdfast.bench.judge import BenchmarkMotion as BenchmarkMotion
from holdfast.bench.judge import find_violation as find_violation
from holdfast.bench.suite import FailActive as FailActive
from holdfast.bench.suite import Score as Score
from holdfast.bench.suite import fail_active as fail_active
