"""What one configuration is worth after a failure: locked-joint indices and free-swinging susceptibilities, with gradients.

Free-swinging joints are in :mod:`holdfast.indices.susceptibility`. Every constructor of an index takes
``(arm, task="pose", failures="single", length=None)`` and returns an :class:`Index`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.checked import checked
from holdfast.errors import TaskError
from holdfast.failures import FailureSpec
from holdfast.indices import susceptibility
from holdfast.indices.custom import CustomIndex
from holdfast.indices.index import SINGULAR_RATIO, Evaluation, Index, WorstCase
from holdfast.indices.objective import Objective, Opposite, Part, WeightedSum
from holdfast.indices.relative import Manipulability, RelativeManipulability
from holdfast.indices.spectral import SpectralIndex

TaskSpec = str | Task | Sequence[str]


@checked
def manipulability(arm: Arm, task: TaskSpec = "pose", failures: FailureSpec = "single", length: float | None = None) -> Index:
    """Worst-case manipulability of the reduced Jacobian; Abdi et al. 2012, eq. (1), (2)."""
    return Manipulability(arm, task, failures, length)


@checked
def relative_manipulability(
    arm: Arm, task: TaskSpec = "pose", failures: FailureSpec = "single", length: float | None = None
) -> Index:
    """Worst-case relative manipulability, 0 to 1; Abdi et al. 2012, eq. (3), (4)."""
    return RelativeManipulability(arm, task, failures, length)


@checked
def mean_singular_value(
    arm: Arm, task: TaskSpec = "pose", failures: FailureSpec = "single", length: float | None = None
) -> Index:
    """Worst-case arithmetic mean of the singular values; Abdi et al. 2012, eq. (7)."""
    return SpectralIndex("mean", arm, task, failures, length)


@checked
def geometric_mean_singular_value(
    arm: Arm, task: TaskSpec = "pose", failures: FailureSpec = "single", length: float | None = None
) -> Index:
    """Worst-case geometric mean of the singular values; Abdi et al. 2012, eq. (8)."""
    return SpectralIndex("geometric mean", arm, task, failures, length)


@checked
def minimum_singular_value(
    arm: Arm, task: TaskSpec = "pose", failures: FailureSpec = "single", length: float | None = None
) -> Index:
    """Worst-case smallest singular value; Abdi et al. 2012, eq. (9)."""
    return SpectralIndex("minimum", arm, task, failures, length)


@checked
def condition_number(arm: Arm, task: TaskSpec = "pose", failures: FailureSpec = "single", length: float | None = None) -> Index:
    """Worst-case condition number, smaller is better; Abdi et al. 2012, eq. (10)."""
    return SpectralIndex("condition number", arm, task, failures, length)


BY_NAME: dict[str, Callable[..., Index]] = {
    "relative-manipulability": relative_manipulability,
    "manipulability": manipulability,
    "mean-singular-value": mean_singular_value,
    "geometric-mean-singular-value": geometric_mean_singular_value,
    "minimum-singular-value": minimum_singular_value,
    "condition-number": condition_number,
}
"""The built-in indices by the names used on the command line and in files."""


@checked
def by_name(
    name: str, arm: Arm, task: TaskSpec = "pose", failures: FailureSpec = "single", length: float | None = None
) -> Index:
    """A built-in index by name.

    Raises:
        TaskError: There is no such index; the message lists those there are.
    """
    if name not in BY_NAME:
        raise TaskError(f"index '{name}' is not known; use one of {', '.join(BY_NAME)}")
    return BY_NAME[name](arm, task, failures, length)


__all__ = [
    "BY_NAME",
    "SINGULAR_RATIO",
    "CustomIndex",
    "Evaluation",
    "Index",
    "Manipulability",
    "Objective",
    "Opposite",
    "Part",
    "RelativeManipulability",
    "SpectralIndex",
    "WeightedSum",
    "WorstCase",
    "by_name",
    "condition_number",
    "geometric_mean_singular_value",
    "manipulability",
    "mean_singular_value",
    "minimum_singular_value",
    "relative_manipulability",
    "susceptibility",
]
