"""holdfast: what happens to the task when a joint of a redundant arm fails, and what can be done about it beforehand."""

from holdfast import arms, indices
from holdfast.arm import DH, Arm, Joint, Link
from holdfast.arm.task import Task
from holdfast.assess import Assessment, Comparison, Region, assess, compare, load
from holdfast.errors import ArmError, HoldfastError, InputError, KernelError, StoreError, TaskError
from holdfast.kernels import set_threads
from holdfast.solve import Optimum, Reach, optimise, solve_ik
from holdfast.status import Status

__version__ = "0.1.0"

__all__ = [
    "DH",
    "Arm",
    "ArmError",
    "Assessment",
    "Comparison",
    "HoldfastError",
    "InputError",
    "Joint",
    "KernelError",
    "Link",
    "Optimum",
    "Reach",
    "Region",
    "Status",
    "StoreError",
    "Task",
    "TaskError",
    "__version__",
    "arms",
    "assess",
    "compare",
    "indices",
    "load",
    "optimise",
    "set_threads",
    "solve_ik",
]
