from holdfast.core import files as files
from holdfast.core import probability as probability
from holdfast.core import sweeps as sweeps
