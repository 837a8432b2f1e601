"""The motion along a path that survives most single locks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.clearance.choice import CellLike
from holdfast.clearance.clearance import Clearance
from holdfast.endurance import tables
from holdfast.endurance.choice import Front, advanced
from holdfast.endurance.endurance import Endurance, Found
from holdfast.endurance.given import beside
from holdfast.endurance.grid import Nodes, nodes_of
from holdfast.endurance.problem import ON, Mode, Problem, posed
from holdfast.endurance.rates import FailureRates, RatesLike
from holdfast.endurance.smoothing import smoothed
from holdfast.errors import HoldfastError, InputError
from holdfast.indices.objective import Objective
from holdfast.keep.labels import KeepLike
from holdfast.notice import each, says
from holdfast.paths.timed_path import TimedPath
from holdfast.solvers import joint_space
from holdfast.solvers.inverse_kinematics import solver
from holdfast.solvers.self_motions import STARTS

Array = NDArray[np.float64]

_ALIKE = 1e-9  # of a probability: less is rounding
_TRIED = 3  # choices of joints that are held, of which the motion is looked for on the whole grid
_AXES = 2  # along which the tool is held in a cone; its middle is where many arms are singular


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
    keep: KeepLike | None = None,
    compare: Sequence[Objective | str] = (),
) -> Endurance:
    """The motion along a path after which most locks of a joint, whichever and whenever, leave the rest of the path possible.

    With one degree of redundancy every configuration of every pose is looked at (its self-motion curves, at points ``spacing``
    apart), with the question whether the path can be finished if joint i locks there. Dynamic programming then finds the
    motion over these points that survives most: the best there is, up to the grid. Of motions that are equal it takes the
    shortest, and smooths it where that costs nothing. A motion within the velocity limits comes first.

    With more redundancy the result is a lower bound: of the motions only those are looked at that hold further joints where
    they are, or the axis that is kept in a cone, and of a failed arm only the ways on that do; which joints, and where, is
    drawn and tried.

    Args:
        arm: The arm.
        path: Where the tool is to be, and when.
        rates: How often each joint locks, (n,) or by joint: relative weights. Default: all alike.
        per_second: The rates are in 1/s: an instant then counts by the probability that nothing has failed before.
        mode: ``on-path``: after a lock the tool follows its path without leaving it, at its own pace. ``detour``: it may
            leave it and come back. That only asks for the locked joint's value at every pose still to come: without obstacles
            the straight way to a configuration that has it lies within the joint limits. Among obstacles it is an upper bound.
            With more than one degree of redundancy inverse kinematics looks for these configurations.
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
        keep: What the tool keeps at every sample, before the lock and after it: :func:`holdfast.keep.upright`,
            :func:`holdfast.keep.rail`, :func:`holdfast.keep.plane`, a label (``"upright:10deg"``), or several. Rows that the
            task prescribes are those of the path, and it is checked that they keep it. Of the others a cone limits what the
            arm may do; an axis kept exactly along a path of positions becomes two rows of the task.
        compare: Motions along the same path that the result is to be compared with: ``least-norm``, and for every index or
            susceptibility the motion by gradient projection and the best continuous one at every pose (:func:`holdfast.follow`
            with ``best``).

    Returns:
        An :class:`Endurance` with the motion, its survival, the bound and the interval of the grid.

    Raises:
        InputError: Rates, a start or options that do not fit, a path that breaks what is kept, or a row kept exactly that the
            task leaves free.
        TaskError: No redundancy, or more than one degree of it and detours among obstacles or with something kept.
        HoldfastError: A pose without a (clear) configuration, or no continuous motion along the path.

    Source: sets of values that a joint may be locked at, Lewis and Maciejewski 1997; survival over a whole path, its optimum
    and its bound are ours.
    """
    problem = posed(
        arm,
        path,
        rates,
        per_second,
        mode,
        task,
        samples,
        clearance,
        cell,
        margin,
        keep=keep,
        spacing=spacing,
        seed=seed,
        starts=starts,
    )
    begin = None if start is None else _begun(problem, start)
    best = _Curves(problem, begin).motion(problem) if problem.spare == 1 else _holding(problem, begin)
    return best if not compare else beside(problem, best, compare, seed)


class _Curves:
    """The motions over the self-motion curves of every pose, of a problem that leaves one degree of redundancy.

    Attributes:
        most: What the best of them survives, of those within the velocity limits, and with the spacing on top; NaN: none.
    """

    def __init__(self, problem: Problem, begin: Array | None) -> None:
        self._problem, self._held = problem, begin is not None
        arm, lock = problem.arm, problem.lock
        self._found = problem.fibres
        for time, pose in zip(problem.time, self._found, strict=True):
            if not len(pose.q):
                why = problem.conditions.why_none(pose)
                raise HoldfastError(f"the path cannot be followed at {time:.4g} s: {why}")
        self._nodes = nodes_of(arm, self._found)
        given_up = problem.conditions.given_up(np.array([x.q[0] for x in self._nodes]))
        if given_up is not None:
            when, trouble = problem.time[given_up[0]], given_up[1]
            raise InputError(f"the path itself breaks what is kept: at {when:.4g} s the tool is {trouble}")
        if begin is not None:
            self._nodes[0] = Nodes.single(arm, begin, problem.spacing)
        of_path = problem.mode == "on-path"
        self._table = tables.on_path(lock, self._nodes) if of_path else tables.detours(self._nodes, self._found)
        weights = problem.rates.weights(problem.time)
        self._gains = [w * v.survives @ problem.rates.each for w, v in zip(weights, self._table, strict=True)]
        limit = np.array([j.velocity for j in arm.joints]) * float(np.diff(problem.time).max())
        self._whole = float(weights.sum()) * problem.rates.total
        near = [w * v.most_near(x, problem.rates.each) for w, v, x in zip(weights, self._table, self._nodes, strict=True)]
        self._fronts, bound = (Front(self._gains), Front(self._gains, problem.spacing)), Front(near, problem.spacing)
        advanced(arm, self._nodes, limit, (*self._fronts, bound))
        if bound.ended is not None:
            raise HoldfastError(
                f"no continuous motion along the path was found: it ends at {problem.time[bound.ended]:.4g} s; slow the path "
                "down, take more samples, or prescribe fewer rows"
            )
        self._bound = bound.most / self._whole
        self.most = self._fronts[0].most / self._whole, self._fronts[1].most / self._whole

    def motion(self, asked: Problem) -> Endurance:
        """The best, made smooth and judged as it was asked for."""
        problem, nodes, table = self._problem, self._nodes, self._table
        arm, lock = problem.arm, problem.lock
        known = Found(
            bound=self._bound,
            interval=self.most,
            spacing=problem.spacing,
            nodes=[x.q for x in nodes],
            curve=[x.curve for x in nodes],
            survives=[v.survives for v in table],
            moved=np.max([np.ptp(c.q, axis=0) for each in self._found for c in each.components], axis=0),
            held={arm.joint_names[k]: x for k, x in lock.tracer.held.items() if k not in problem.immobile},
        )
        results = []
        for front, most in zip(self._fronts, self.most, strict=True):
            if front.ended is not None:
                continue
            chosen = front.motion()
            q = _continued(arm, np.array([x.q[k] for x, k in zip(nodes, chosen, strict=True)]))
            smooth = smoothed(lock.tracer, nodes, table, self._gains, chosen, q, lock.poses, held=self._held)
            made = Endurance.of(asked, smooth, survives=asked.judge(smooth), found=known)
            if made.survival < most - _ALIKE or made.speed > 1 + _ALIKE:  # smoothing may have cost something
                plain = Endurance.of(asked, q, survives=asked.judge(q), found=known)
                made = max(made, plain, key=_goodness)
            results.append(made)
        return max(results, key=_goodness)  # of equals the first


def _holding(problem: Problem, begin: Array | None) -> Endurance:
    """The best of motions that hold all joints but those that leave one degree of redundancy.

    Which joints, and where, is looked for on a coarse grid; the best few are then looked at on the grid that was asked for.
    """
    tried = []
    for asked, q in each("configurations of the first pose", list(_begun_from(problem, begin))):
        coarse = asked.coarser()
        for joints in asked.sets:
            if not asked.leaves_one(q, joints):  # no curves, and their tracing has no end
                continue
            values = {k: float(q[k]) for k in joints}
            try:
                within, over = _Curves(coarse.holding(values), begin).most
            except InputError:
                raise
            except HoldfastError:
                continue
            tried.append((not np.isnan(within), over if np.isnan(within) else within, asked, values))
    if not tried:
        raise HoldfastError(
            f"no continuous motion along the path was found that holds {problem.spare - 1} joints: slow the path down, or give "
            "another start"
        )
    tried.sort(key=lambda x: x[:2], reverse=True)
    results, failed = [], None
    for _, _, asked, values in tried[:_TRIED]:
        try:
            results.append(_Curves(asked.holding(values), begin).motion(asked))
        except HoldfastError as error:  # the finer grid of poses holds one that the coarse one had not
            failed = error
    if not results:
        assert failed is not None
        raise failed
    best = max(results, key=_goodness)
    if not problem.conditions.left:
        return best
    return Endurance.of(problem, best.q, survives=problem.judge(best.q), found=best.found)  # maybe a narrower one's


def _begun_from(problem: Problem, begin: Array | None) -> Iterator[tuple[Problem, Array]]:
    """The problem, and narrower ones that hold the axis of a cone, with configurations (n,) that their motions begin at."""
    if begin is not None:
        narrower = problem.narrower_at(begin)
        yield from ((one, begin) for one in (problem, narrower) if one is not None)
        return
    first = problem.first()
    yield from ((problem, q) for q in first)
    for narrower in map(problem.narrower_at, first[:_AXES]):
        if narrower is not None:
            yield from ((narrower, q) for q in narrower.first())


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
    room = problem.conditions.room
    if room is not None and float(room[0].room(q)) < room[1]:
        raise InputError(f"at the start the arm {room[0].too_close(room[1], q)}; leave it out to have one")
    broken = problem.conditions.broken(q[None])
    if broken is not None:
        raise InputError(f"at the start the tool is {broken[1]}; leave it out to have one")
    on_pose: Array = problem.lock.tracer.corrected(q[None], first)[0][0]
    return on_pose


def _continued(arm: Arm, q: Array) -> Array:
    """Joints that turn without limits take the short way from pose to pose."""
    return np.concatenate([q[:1], q[0] + np.cumsum(joint_space.difference(arm, q[1:], q[:-1]), axis=0)])
