from holdfast.response import diagnosis as diagnosis
from holdfast.response import faults as faults
from holdfast.response import lock_survival as lock_survival
from holdfast.response import recovery as recovery
from holdfast.response import stowing as stowing
from holdfast.response import supervisor as supervisor
