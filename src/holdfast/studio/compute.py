"""What takes long, as functions of an arm and plain data: they run in a process beside the page."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import InputError
from holdfast.studio.motions import Motion, law_motions, swing_motion
from holdfast.studio.scene.cloud import Cloud, around, read_cloud
from holdfast.studio.scene.machine import Machine
from holdfast.studio.state import State
from holdfast.studio.watching import watched

Array = NDArray[np.float64]
Progress = Callable[[int, int], None]
STARTS = 64  # of the search for a best configuration


@dataclass(frozen=True)
class Extremes:
    """The best and the worst configuration of a pose.

    Attributes:
        q: Two configurations (n,), rad and m.
        values: Of the objective, there and where the arm is.
    """

    q: tuple[Array, Array]
    values: tuple[float, float, float]


def best_worst(machine: Machine, state: State, progress: Progress) -> Extremes:
    """The best and the worst configuration of the present pose by the objective of the state.

    Raises:
        InputError: The arm has no such objective, or no configuration of the pose was found.
    """
    from holdfast.solvers.optima import optimise

    both = machine.objectives(state.objective)
    if isinstance(both, str):
        raise InputError(both)
    q, clear = np.array(state.q), machine.clearance(state.moved)
    found = []
    for k, wanted in enumerate(both):
        progress(k, 2)
        found.append(optimise(machine.arm, machine.hand(q), wanted, task=machine.task, starts=STARTS, clearance=clear))
    if not all(bool(f.success) for f in found):
        raise InputError("no configuration of this pose was found; move the end effector and try again")
    # The searches are local: where the arm is may beat what they found.
    here, sign = float(both[0](q)), 1.0 if both[0].better == "larger" else -1.0
    best, worst = ((f.q, float(f.value)) for f in found)
    best = (q, here) if sign * here > sign * best[1] else best
    worst = (q, here) if sign * here < sign * worst[1] else worst
    return Extremes((best[0], worst[0]), (best[1], worst[1], here))


def laws(machine: Machine, state: State, progress: Progress) -> list[Motion]:
    """The motion to the target under both laws; see :func:`holdfast.studio.motions.law_motions`."""
    return law_motions(machine, state, progress)


def swing(machine: Machine, state: State, progress: Progress) -> list[Motion]:
    """The free swing of the joint that is free; see :func:`holdfast.studio.motions.swing_motion`."""
    progress(0, 1)
    return [swing_motion(machine.arm, state)]


def region(machine: Machine, state: State, progress: Progress) -> Cloud:
    """The region of the state's results folder, or one around the end effector, assessed now.

    Raises:
        InputError: The arm has no such index.
    """
    if state.region is not None:
        return read_cloud(machine.arm, state.region)
    index = machine.index(state.index)
    if isinstance(index, str):
        raise InputError(index)
    return around(index, machine.hand(np.array(state.q)), machine.size, progress)


JOBS: dict[str, Callable[[Machine, State, Progress], object]] = {
    "best-worst": best_worst,
    "laws": laws,
    "swing": swing,
    "region": region,
    "watch": watched,
}
