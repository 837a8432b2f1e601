"""The control laws by name."""

from __future__ import annotations

import inspect
from collections.abc import Sequence
from typing import Any

from numpy.typing import ArrayLike

from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.checked import checked
from holdfast.control.failure_tolerant import FailureTolerant
from holdfast.control.inverses import Damped, Pseudoinverse, Weighted
from holdfast.control.law import Law
from holdfast.errors import InputError

TaskSpec = str | Task | Sequence[str]

BY_NAME: dict[str, type[Law]] = {law.slug: law for law in (Pseudoinverse, Weighted, Damped, FailureTolerant)}


@checked
def pseudoinverse(arm: Arm, task: TaskSpec = "pose", gain: float = 1.0, speed_limit: float | None = None) -> Pseudoinverse:
    """Least-norm joint rates; see :class:`Pseudoinverse`."""
    return Pseudoinverse(arm, task, gain, speed_limit)


@checked
def weighted(
    arm: Arm, weights: ArrayLike, task: TaskSpec = "pose", gain: float = 1.0, speed_limit: float | None = None
) -> Weighted:
    """Joint rates of least weighted norm; see :class:`Weighted`."""
    return Weighted(arm, weights, task, gain, speed_limit)


@checked
def damped(arm: Arm, damping: float, task: TaskSpec = "pose", gain: float = 1.0, speed_limit: float | None = None) -> Damped:
    """Damped least squares with fixed damping; see :class:`Damped`."""
    return Damped(arm, damping, task, gain, speed_limit)


@checked
def failure_tolerant(
    arm: Arm,
    task: TaskSpec = "pose",
    pre_failure_error: float = 0.5,
    gain: float = 1.0,
    speed_limit: float | None = None,
) -> FailureTolerant:
    """Damped inverse that makes the worst single locked joint least bad; see :class:`FailureTolerant`."""
    return FailureTolerant(arm, task, pre_failure_error, gain, speed_limit)


@checked
def by_name(name: str, arm: Arm, **options: Any) -> Law:
    """A law from its name on the command line: ``pseudoinverse``, ``weighted``, ``damped`` or ``failure-tolerant``.

    Args:
        name: The law's ``slug``.
        arm: The arm.
        options: What the law takes besides: ``task``, ``gain``, ``speed_limit``, and ``weights``, ``damping`` or
            ``pre_failure_error``.

    Raises:
        InputError: Unknown name, an option that the law does not have, or one that is missing.
        TaskError: The task has more rows than the arm has joints.
    """
    if name not in BY_NAME:
        raise InputError(f"control law '{name}' is not known; use one of {', '.join(BY_NAME)}")
    law = BY_NAME[name]
    known = dict(list(inspect.signature(law).parameters.items())[1:])
    for option in options:
        if option not in known:
            raise InputError(f"the {law.name} has no option '{option}'; it takes {', '.join(known)}")
    for option, about in known.items():
        if about.default is inspect.Parameter.empty and option not in options:
            raise InputError(f"the {law.name} needs {option}")
    return law(arm, **options)
