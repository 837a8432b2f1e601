"""Which values a joint takes over all configurations of a target: where it may lock without losing the target."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task, target_pose
from holdfast.errors import InputError, TaskError
from holdfast.notice import each, says
from holdfast.reach.extrema import CriticalPoints, critical_points
from holdfast.solvers import joint_space

Array = NDArray[np.float64]
Arcs = list[tuple[float, float]]

STARTS = 256
RESTARTS = 60
_SCAN = 90  # values of each joint that are tried besides the critical ones
_REACHED = 1e-8  # rad, and lengths in units of the arm's own
_HALVINGS = 18  # of a gap of the scan: 5 deg becomes 3e-7 rad
_SAME = 1e-6  # rad and m: critical values nearer than this are one
_INSIDE = 1e-4  # rad and m: nearer to a cut, a value says nothing: at the edge of the workspace it may be that wrong


@checked
@says("looking for the ranges of the joints")
def joint_bounds(
    arm: Arm,
    target: ArrayLike,
    task: str | Task | Sequence[str] = "pose",
    *,
    seed: int = 0,
    starts: int = STARTS,
) -> list[Arcs]:
    """The values of each joint over all configurations of a target: a lock there, and only there, leaves it reachable.

    The ends are critical points of the joint on the self-motion manifold: equations (8) and (9), solved by Newton's method
    from many starts (with joint limits also on the faces where joints rest on theirs). These and a scan of 90 values cut the
    range of the joint into segments; one is reached if a configuration known to be on the target lies in it, or inverse
    kinematics with the joint locked at its middle finds one. An end that is not a critical point, because Newton's method
    missed it, is found by bisection.

    Ends that are critical points are exact to 1e-9, others to 1e-6 rad where inverse kinematics finds what there is; at the
    edge of the workspace, where arcs shrink to points, to 1e-4. Gaps and arcs narrower than a 90th of the joint's range may be
    missed, where Newton's method missed both their ends: what is not found is not proved absent.

    Args:
        arm: The arm, with any number of redundant joints.
        target: (m,) for tasks without angular rows: the task's rows of the wanted tool point, m. For any task, (4, 4), a
            tool pose in the world.
        task: Rows of the pose that matter.
        seed: Of the starts.
        starts: Of Newton's method per joint.

    Returns:
        For each joint a list of ``(lower, upper)``, rad (m for prismatic joints), in ascending order: ``[(-pi, pi)]`` where a
        joint without limits is free, ``[]`` where no configuration of the target was found. An arc of a joint that turns
        without limits begins in -pi to pi and may end beyond pi. Of a joint with limits arcs lie within them. An arc of
        length 0 is a single value.

    Raises:
        InputError: A target of another shape or with NaN, or options out of range.
        TaskError: The arm has no redundancy for the task.

    Source: Goel et al. 2005, eq. (8) and (9); the segment test, limits and the scan are ours.
    """
    rows = as_task(arm, task)
    if arm.n <= rows.m:
        raise TaskError(
            f"'{arm.name}' has {arm.n} joints and the task '{rows.name}' {rows.m} rows: without redundancy every lock loses "
            "almost every target; choose a task with fewer rows"
        )
    if starts < 1:
        raise InputError(f"starts is {starts}; it must be 1 or more")
    pose = target_pose(rows, target)
    solve = critical_points(arm, rows)
    generator = np.random.default_rng(np.random.SeedSequence(seed))
    known = solve.seeds(pose, max(starts, 128), generator)
    if not len(known):
        return [[] for _ in range(arm.n)]
    joint, extreme = _critical_values(solve, pose, known, starts, generator)
    cuts = [_cuts(arm, k, extreme[joint == k, k]) for k in range(arm.n)]
    everything = joint_space.folded(arm, np.concatenate([known, extreme]))
    _decide(solve, pose, cuts, everything, seed)
    return [c.arcs() for c in cuts]


def _critical_values(
    solve: CriticalPoints, pose: Array, known: Array, starts: int, generator: np.random.Generator
) -> tuple[NDArray[np.int64], Array]:
    """Critical points (C, n) and the joint (C,) of which each one is critical."""
    arm = solve.arm
    joint = np.repeat(np.arange(arm.n), starts)
    q = known[generator.integers(0, len(known), joint.size)]
    held = np.zeros(q.shape, dtype=bool)
    ends = np.stack([arm.lower, arm.upper])
    if np.isfinite(ends).any():
        # Every other start on a face: some of the other joints rest on a limit, at most as many as are redundant.
        order = generator.permuted(np.broadcast_to(np.arange(arm.n), q.shape), axis=1)
        resting = generator.integers(1, arm.n - solve.m + 1, joint.size)
        side = ends[generator.integers(0, 2, q.shape), np.arange(arm.n)]
        held = (order < resting[:, None]) & np.isfinite(side) & (np.arange(arm.n) != joint[:, None])
        held[::2] = False
        q = np.where(held, side, q)
    found, good = solve.solve(pose, q, joint, held)
    return joint[good], np.clip(found[good], arm.lower, arm.upper)


@dataclass
class _Cuts:
    """The range of one joint, cut into segments.

    Attributes:
        joint: Index from 0.
        at: (K,) ascending. Segment k runs from cut k to the next; on a circle the last runs on to the first.
        critical: (K,) the cut is a critical value, and so a value that is reached.
        circle: The joint turns without limits; values in 0 to 2 pi.
        witness: (S, 2) lowest and highest value in each segment that is known to be reached, NaN where none is.
    """

    joint: int
    at: Array
    critical: NDArray[np.bool_]
    circle: bool
    witness: Array

    @property
    def reached(self) -> NDArray[np.bool_]:
        """(S,)"""
        return np.asarray(~np.isnan(self.witness[:, 0]))

    @property
    def ends(self) -> Array:
        """(S + 1,) where segments begin and end."""
        return np.append(self.at, self.at[0] + 2 * np.pi) if self.circle else self.at

    @property
    def middle(self) -> Array:
        """(S,)"""
        return (self.ends[1:] + self.ends[:-1]) / 2

    def note(self, values: Array) -> None:
        """Take values (V,) that are reached as witnesses of the segments that they are well inside of."""
        if self.circle:
            values = np.where(values < self.at[0], values + 2 * np.pi, values)
        segment = np.searchsorted(self.ends, values, side="right") - 1
        inside = (segment >= 0) & (segment < self.middle.size)
        segment, values = segment[inside], values[inside]
        clear = np.minimum(values - self.ends[segment], self.ends[segment + 1] - values) > _INSIDE
        np.fmin.at(self.witness[:, 0], segment[clear], values[clear])
        np.fmax.at(self.witness[:, 1], segment[clear], values[clear])

    def changes(self) -> list[tuple[int, float, float]]:
        """Cuts between a segment that is reached and one that is not; a value reached on one side, one not on the other."""
        found = []
        size = self.reached.size
        for k in range(0 if self.circle else 1, size):
            before, after = self.reached[k - 1], self.reached[k]
            turn = 2 * np.pi if k == 0 else 0.0  # the last segment of a circle lies before the first cut
            if before and not after:
                found.append((k, float(self.witness[k - 1, 1]) - turn, float(self.middle[k])))
            elif after and not before:
                found.append((k, float(self.witness[k, 0]), float(self.middle[k - 1]) - turn))
        return found

    def arcs(self) -> Arcs:
        """Reached segments joined, and critical values with nothing reached beside them."""
        if self.reached.all():
            return [(-np.pi, np.pi)] if self.circle else [(float(self.at[0]), float(self.at[-1]))]
        ends, size = self.ends, self.reached.size
        pieces = [(ends[k], ends[k + 1]) for k in range(size) if self.reached[k]]
        pieces = sorted(pieces + [(c, c) for c in self.at[self.critical]])
        joined: list[list[float]] = []
        for low, high in pieces:
            if joined and low <= joined[-1][1] + 10 * _SAME:
                joined[-1][1] = max(joined[-1][1], high)
            else:
                joined.append([low, high])
        if self.circle:
            if len(joined) > 1 and joined[0][0] + 2 * np.pi <= joined[-1][1] + 10 * _SAME:
                joined[-1][1] = max(joined[-1][1], joined[0][1] + 2 * np.pi)
                joined.pop(0)
            turn = [2 * np.pi if low >= np.pi else 0.0 for low, _ in joined]
            joined = [[low - t, high - t] for (low, high), t in zip(joined, turn, strict=True)]
        return sorted((float(low), float(high)) for low, high in joined)


def _cuts(arm: Arm, joint: int, critical: Array) -> _Cuts:
    """A scan of the range of a joint and its critical values."""
    circle = bool(joint_space.turning(arm)[joint])
    low, high = (0.0, 2 * np.pi) if circle else (float(x[joint]) for x in finite_limits(arm))
    values = np.sort(critical % (2 * np.pi)) if circle else np.sort(critical)
    groups = np.split(values, np.flatnonzero(np.diff(values) > _SAME) + 1) if values.size else []
    exact = np.array([np.median(g) for g in groups])
    if circle and exact.size > 1 and exact[0] + 2 * np.pi - exact[-1] <= _SAME:
        exact = exact[:-1]
    # A joint that ends on its own limit needs no other cut there.
    scan = np.linspace(low, high, _SCAN + 1)[: _SCAN if circle else None]
    if exact.size:
        gap = np.abs(scan[:, None] - exact)
        apart = np.minimum(gap, 2 * np.pi - gap) if circle else gap
        scan = scan[apart.min(axis=1) > _INSIDE]
    at = np.concatenate([exact, scan])
    order = np.argsort(at, kind="stable")
    at, marked = at[order], (np.arange(at.size) < exact.size)[order]
    if not circle and (at[0] != low or at[-1] != high):
        at, marked = np.r_[low, at, high], np.r_[False, marked, False]
        keep = np.r_[True, np.diff(at) > 0]
        at, marked = at[keep], marked[keep]
    return _Cuts(joint, at, marked, circle, np.full((at.size - (0 if circle else 1), 2), np.nan))


def _decide(solve: CriticalPoints, pose: Array, cuts: list[_Cuts], known: Array, seed: int) -> None:
    """Which segments are reached; then the cuts that turn out to be ends are moved to where the ends are."""

    def reached(joint: NDArray[np.int64], values: Array) -> NDArray[np.bool_]:
        poses = np.broadcast_to(pose, (joint.size, 4, 4))
        return solve.engine.reaches_locked(poses, joint, values, np.random.SeedSequence(seed), RESTARTS, _REACHED)

    for c in cuts:
        c.note(known[:, c.joint])
    unknown = [(c, k) for c in cuts for k in np.flatnonzero(~c.reached)]
    middle = np.array([c.middle[k] for c, k in unknown])
    yes = reached(np.array([c.joint for c, _ in unknown], dtype=np.int64), middle)
    for (c, k), found, value in zip(unknown, yes, middle, strict=True):
        if found:
            c.witness[k] = value
    edges = [(c, *change) for c in cuts for change in c.changes()]
    if not edges:
        return
    joint = np.array([c.joint for c, *_ in edges], dtype=np.int64)
    at = np.array([c.at[k] for c, k, _, _ in edges])
    good, bad = (np.array([edge[side] for edge in edges]) for side in (2, 3))
    # A critical value is the end if what lies beside it says so.
    exact = np.array([c.critical[k] for c, k, _, _ in edges])
    ends = exact & reached(joint, _towards(at, good)) & ~reached(joint, _towards(at, bad))
    moved = np.flatnonzero(~ends)
    joint, good, bad = joint[moved], good[moved], bad[moved]
    for _ in each("halvings", range(_HALVINGS)):
        half = (good + bad) / 2
        found = reached(joint, half)
        good, bad = np.where(found, half, good), np.where(found, bad, half)
    for index, value in zip(moved, good, strict=True):
        cut, place = edges[index][:2]
        cut.at[place], cut.critical[place] = value, False


def _towards(at: Array, other: Array) -> Array:
    """A little way from values ``at`` to others (E,)."""
    return np.asarray(at + np.clip(other - at, -10 * _INSIDE, 10 * _INSIDE) / 2)
