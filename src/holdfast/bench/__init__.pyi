from holdfast.bench.cases import Case as Case
from holdfast.bench.judge import Motion as Motion
from holdfast.bench.judge import trouble as trouble
from holdfast.bench.suite import FailActive as FailActive
from holdfast.bench.suite import Score as Score
from holdfast.bench.suite import fail_active as fail_active
