"""holdfast: what happens to the task when a joint of a redundant arm fails, and what can be done about it beforehand."""

from holdfast import arms, control, indices, paths
from holdfast.arm import DH, Arm, Joint, Link
from holdfast.arm.task import Task
from holdfast.assess import Assessment, Comparison, Region, assess, compare, load
from holdfast.clearance import Capsules, Clearance
from holdfast.control import Trajectory, follow
from holdfast.errors import ArmError, HoldfastError, InputError, KernelError, StoreError, TaskError
from holdfast.indices import susceptibility
from holdfast.kernels import set_threads
from holdfast.simulate import BrakedDrop, FreeSwing, PhysicalRun, Runs, Servos, free_swing, simulate, simulate_physics
from holdfast.solve import Optimum, Reach, optimise, solve_ik
from holdfast.status import Status

__version__ = "0.1.0"

__all__ = [
    "DH",
    "Arm",
    "ArmError",
    "Assessment",
    "BrakedDrop",
    "Capsules",
    "Clearance",
    "Comparison",
    "FreeSwing",
    "HoldfastError",
    "InputError",
    "Joint",
    "KernelError",
    "Link",
    "Optimum",
    "PhysicalRun",
    "Reach",
    "Region",
    "Runs",
    "Servos",
    "Status",
    "StoreError",
    "Task",
    "TaskError",
    "Trajectory",
    "__version__",
    "arms",
    "assess",
    "compare",
    "control",
    "follow",
    "free_swing",
    "indices",
    "load",
    "optimise",
    "paths",
    "set_threads",
    "simulate",
    "simulate_physics",
    "solve_ik",
    "susceptibility",
]
