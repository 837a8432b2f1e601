"""Arms whose joints turn as far as can be on one self-motion: whatever joint locks at whatever angle, the pose is left."""

from __future__ import annotations

import time
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.designs.evolution.found import EvolvedDesign
from holdfast.designs.evolution.strategy import evolved
from holdfast.designs.evolution.sweeps import Sweeps
from holdfast.designs.family import Family
from holdfast.designs.space import Vary, design_space
from holdfast.errors import InputError, TaskError
from holdfast.notice import Count, says

Array = NDArray[np.float64]

_POPULATION = 48
_SPACING, _LAST_SPACING = 0.1, 0.02  # rad; long steps may pass from one curve to another
_FULL = 1e-6  # of a turn
_WINDS = 1e-3  # turns that a joint that winds is worth more than one that turns all the way and back


@checked
@says("searching designs")
def design_for_self_motion(
    arm: Arm, vary: Vary, *, task: str | Task | Sequence[str] = "pose", generations: int = 150, restarts: int = 3, seed: int = 0
) -> EvolvedDesign:
    """Search an arm and a pose on one of whose self-motions the joints turn farthest: at most all of them all the way.

    Where all do, the pose stays within reach whatever joint locks, at whatever angle, and all these configurations are on one
    curve. Of equal sums more joints that wind are better: those take every angle, whatever the spacing of the points. A pose
    of full size may lie in a small pocket; nothing is said of others.

    Args:
        arm: Of revolute joints, one more than the task has rows; its own limits hold.
        vary: What is varied, and between which bounds, m and rad, as for :func:`holdfast.design`.
        task: Rows of the pose to keep.
        generations: Of each search, 48 designs each.
        restarts: Searches, until every joint winds.
        seed: Of all draws.

    Raises:
        InputError: Prismatic joints, or counts below 1.
        TaskError: The redundancy is not 1.

    Source: Almarkhi and Maciejewski, RA-L 2020, for the size; the search is ours.
    """
    begin = time.monotonic()
    if generations < 1 or restarts < 1:
        raise InputError(f"generations is {generations} and restarts {restarts}; give at least 1")
    space = design_space(arm, vary)
    family = Family(space, task=task)
    if arm.n - family.task.m != 1:
        raise TaskError(
            f"'{arm.name}' has {arm.n} joints and the task {family.task.m} rows; the size of a self-motion is that of a curve, "
            f"of {family.task.m + 1} joints"
        )
    if family.prismatic.any():
        raise InputError(f"'{arm.name}' has prismatic joints, which have no turns; vary an arm of revolute joints")
    sweeps, rng, history = Sweeps(family), np.random.default_rng(seed), list[float]()
    size = len(space.start)

    def placed(x: Array) -> Array:
        """Designs (P, k) within their bounds: what is beyond is mirrored."""
        unit = np.mod(x[:, :size], 2)
        return np.asarray(space.lower + np.where(unit > 1, 2 - unit, unit) * (space.upper - space.lower))

    def turns(values: Array, q: Array, spacing: float) -> tuple[Array, NDArray[np.int64]]:
        swept = sweeps(values, q, spacing)
        return swept.ranges.sum(axis=1) / (2 * np.pi), swept.winding

    def cost(x: Array) -> Array:
        found, winding = turns(placed(x), x[:, size:], _SPACING)
        return np.asarray(-found - _WINDS * (winding != 0).sum(axis=1))

    starts = rng.uniform(-np.pi, np.pi, (_POPULATION, arm.n))
    given = float(turns(np.tile(space.start, (_POPULATION, 1)), starts, _LAST_SPACING)[0].max())
    best: tuple[float, float, Array] | None = None
    everything = arm.n * (1 + _WINDS) - _FULL
    with Count("generations", restarts * generations, most=True) as step:

        def tell(least: float) -> bool:
            step(1)
            history.append(max(-least, history[-1] if history else 0.0))
            return -least >= everything

        for _ in range(restarts):
            start = np.concatenate([rng.uniform(0.2, 0.8, size), rng.uniform(-np.pi, np.pi, arm.n)])
            width = np.concatenate([np.full(size, 0.25), np.full(arm.n, 1.5)])
            x, _ = evolved(cost, start, width, population=_POPULATION, generations=generations, rng=rng, tell=tell)
            value, winding = turns(placed(x[None]), x[None, size:], _LAST_SPACING)
            score = float(value[0]) + _WINDS * float((winding != 0).sum())
            if best is None or score > best[0]:
                best = score, float(value[0]), x
            if best[0] >= everything:
                break
    assert best is not None
    values, q = placed(best[2][None]), np.mod(best[2][size:] + np.pi, 2 * np.pi) - np.pi
    return EvolvedDesign(
        space=space,
        objective="self-motion-size",
        values=values[0],
        value=best[1],
        given=given,
        bound=float(arm.n),
        q=q,
        winding=turns(values, q[None], _LAST_SPACING)[1][0],
        history=np.minimum(history, arm.n),
        seed=seed,
        seconds=time.monotonic() - begin,
    )
