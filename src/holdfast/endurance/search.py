"""The motion along a path that survives most single locks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.clearance.choice import CellLike
from holdfast.clearance.clearance import Clearance
from holdfast.endurance import tables
from holdfast.endurance.choice import Front, advanced
from holdfast.endurance.comparison import beside
from holdfast.endurance.endurance import Endurance, Found
from holdfast.endurance.grid import Nodes, nodes_of
from holdfast.endurance.problem import ON, Mode, Problem, posed
from holdfast.endurance.rates import FailureRates, RatesLike
from holdfast.endurance.smoothing import smoothed
from holdfast.errors import HoldfastError, InputError
from holdfast.indices.objective import Objective
from holdfast.notice import says
from holdfast.paths.timed_path import TimedPath
from holdfast.solvers import joint_space
from holdfast.solvers.inverse_kinematics import solver
from holdfast.solvers.self_motions import STARTS

Array = NDArray[np.float64]

_ALIKE = 1e-9  # of a probability: less is rounding


@checked
@says("looking for the motion that survives most locks")
def endure(
    arm: Arm,
    path: TimedPath,
    *,
    rates: RatesLike | FailureRates | None = None,
    per_second: bool = False,
    mode: Mode = "on-path",
    task: str | Task | Sequence[str] | None = None,
    samples: int = 101,
    spacing: float = 0.05,
    start: ArrayLike | None = None,
    seed: int = 0,
    starts: int = STARTS,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    margin: float = 0.0,
    compare: Sequence[Objective | str] = (),
) -> Endurance:
    """The motion along a path after which most locks of a joint, whichever and whenever, leave the rest of the path possible.

    Every configuration of every pose is looked at (for one degree of redundancy: the self-motion curves, at points
    ``spacing`` apart), with the question whether the path can be finished if joint i locks there. Dynamic programming then
    finds the motion over these points that survives most: the best there is, up to the grid. Of motions that are equal it
    takes the shortest, and smooths it where that costs nothing. A motion within the velocity limits comes first.

    Args:
        arm: The arm.
        path: Where the tool is to be, and when.
        rates: How often each joint locks, (n,) or by joint: relative weights. Default: all alike.
        per_second: The rates are in 1/s: an instant then counts by the probability that nothing has failed before.
        mode: ``on-path``: after a lock the tool follows its path without leaving it, at its own pace. ``detour``: it may
            leave it and come back. That only asks for the locked joint's value at every pose still to come: without obstacles
            the straight way to a configuration that has it lies within the joint limits. Among obstacles it is an upper bound.
        task: Rows of the poses to keep. Default: ``position`` for a path of positions, else ``pose``; of an arm that moves in a
            plane those in it.
        samples: Poses, evenly spaced in time.
        spacing: Of the points on the self-motion curves, rad.
        start: (n,) where the motion must begin, on the first pose. Default: anywhere.
        seed: Of the search for the curves; see :func:`holdfast.solvers.fibres`.
        starts: Random starts of inverse kinematics per pose.
        clearance: Keep the links of the arm apart; not looked at if not given. See :func:`holdfast.follow`.
        cell: Objects around the arm, or their file, to keep clear of before the lock and after it, at every sample.
        margin: m; from an object beyond what the cell keeps from it.
        compare: Motions along the same path that the result is to be compared with: ``least-norm``, and for every index or
            susceptibility the motion by gradient projection and the best continuous one at every pose (:func:`holdfast.follow`
            with ``best``).

    Returns:
        An :class:`Endurance` with the motion, its survival, the bound and the interval of the grid.

    Raises:
        InputError: Rates, a start or options that do not fit.
        TaskError: No redundancy, or more than one degree of it.
        HoldfastError: A pose without a (clear) configuration, or no continuous motion along the path.

    Source: sets of values that a joint may be locked at, Lewis and Maciejewski 1997; survival over a whole path, its optimum
    and its bound are ours.
    """
    problem = posed(
        arm, path, rates, per_second, mode, task, samples, clearance, cell, margin, spacing=spacing, seed=seed, starts=starts
    )
    lock, poses = problem.lock, problem.lock.poses
    found = problem.fibres
    for time, each in zip(problem.time, found, strict=True):
        if not len(each.q):
            raise HoldfastError(f"the path cannot be followed at {time:.4g} s: {each.describe()[0]}")
    nodes = nodes_of(arm, found)
    if start is not None:
        nodes[0] = Nodes.single(arm, _begun(problem, start), spacing)
    table = tables.on_path(lock, nodes) if mode == "on-path" else tables.detours(nodes, found)
    weights = problem.rates.weights(problem.time)
    gains = [w * v.survives @ problem.rates.each for w, v in zip(weights, table, strict=True)]
    limit = np.array([j.velocity for j in arm.joints]) * float(np.diff(problem.time).max())
    whole = float(weights.sum()) * problem.rates.total
    near = [w * v.most_near(x, problem.rates.each) for w, v, x in zip(weights, table, nodes, strict=True)]
    fronts, bound = (Front(gains), Front(gains, spacing)), Front(near, spacing)
    advanced(arm, nodes, limit, (*fronts, bound))
    ended = bound.ended
    if ended is not None:
        raise HoldfastError(
            f"no continuous motion along the path was found: it ends at {problem.time[ended]:.4g} s; slow the path down, take "
            "more samples, or prescribe fewer rows"
        )
    known = Found(
        bound=bound.most / whole,
        interval=(fronts[0].most / whole, fronts[1].most / whole),
        spacing=spacing,
        nodes=[x.q for x in nodes],
        curve=[x.curve for x in nodes],
        survives=[v.survives for v in table],
        moved=np.max([np.ptp(c.q, axis=0) for each in found for c in each.components], axis=0),
    )
    results = []
    for front in fronts:
        if front.ended is not None:
            continue
        chosen = front.motion()
        q = _continued(arm, np.array([x.q[k] for x, k in zip(nodes, chosen, strict=True)]))
        smooth = smoothed(lock.tracer, nodes, table, gains, chosen, q, poses, held=start is not None)
        made = Endurance.of(problem, smooth, survives=problem.judge(smooth), found=known)
        if made.survival < front.most / whole - _ALIKE or made.speed > 1 + _ALIKE:  # smoothing may have cost something
            plain = Endurance.of(problem, q, survives=problem.judge(q), found=known)
            made = max(made, plain, key=_goodness)
        results.append(made)
    best = max(results, key=_goodness)  # of equals the first
    return best if not compare else beside(problem, best, compare, seed)


def _goodness(made: Endurance) -> tuple[bool, float]:
    """What the joints can do comes first."""
    return made.speed <= 1 + _ALIKE, round(made.survival, 9)


def _begun(problem: Problem, start: ArrayLike) -> Array:
    """The start (n,), brought to the first pose."""
    arm, first = problem.arm, problem.lock.poses[:1]
    q = arm.check_configurations(start)
    if q.ndim != 1 or not np.isfinite(q).all():
        raise InputError(f"the start of '{arm.name}' must be one configuration of {arm.n} finite numbers")
    if not solver(arm, problem.task).verdict(q[None], first, ON)[0]:
        raise InputError(
            "the start is not on the first pose of the path, or outside the joint limits; leave it out to have one"
        )
    if problem.kept is not None and float(problem.kept[0].room(q)) < problem.kept[1]:
        raise InputError(f"at the start the arm {problem.kept[0].too_close(problem.kept[1], q)}; leave it out to have one")
    on_pose: Array = problem.lock.tracer.corrected(q[None], first)[0][0]
    return on_pose


def _continued(arm: Arm, q: Array) -> Array:
    """Joints that turn without limits take the short way from pose to pose."""
    return np.concatenate([q[:1], q[0] + np.cumsum(joint_space.difference(arm, q[1:], q[:-1]), axis=0)])
