"""Point to point: the least exposure beside brute force over all goals, and injected locks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np
from papers.claims import Claim
from papers.part import Part

import holdfast as hf
from holdfast.kinematics.solvers import fibres
from measurements.fail_active.lines import verdict

PAIRS, INJECTED = 20, 20  # locks of a pair
_FINE = 0.004
_APART = 1e-3  # rad: shorter intervals in which two ways to find ranges differ are rounding


def point_to_point(quick: bool) -> Part:
    """E3: against all goals on a grid five times as fine, with the ranges of the joints by another algorithm.

    That misses arcs and gaps narrower than a 90th of a joint's range. Where it differs from the curves a proof decides: all
    configurations of the goal with the joint locked there, by branch and bound.
    """
    arm, generator, locks = hf.arms.load("panda"), np.random.default_rng(16), np.random.default_rng(17)
    velocity = np.array([j.velocity for j in arm.joints])
    ours, brute, straight, right, differ, lost_inside, tried = [], [], [], 0, 0, 0, 0
    for _ in range(3 if quick else PAIRS):
        start, other = generator.uniform(arm.lower, arm.upper, (2, arm.n))
        pose = arm.forward_kinematics(other)

        def there(k: int, value: float, pose: np.ndarray = pose) -> bool:
            low, high = arm.lower.copy(), arm.upper.copy()
            low[k] = high[k] = value
            return len(hf.all_configurations(arm, pose, limits=(low, high)).q) > 0

        got = hf.plan_motion_to(arm, start, pose)
        goals = fibres(arm, pose, spacing=_FINE)[0].q
        lost = np.zeros((len(goals), arm.n))
        for k, theirs in enumerate(hf.joint_bounds(arm, pose, "pose")):
            arcs, agreed, parts = decided(theirs, got.ranges[k], lambda value, k=k: there(k, value))  # type: ignore[misc]
            right, differ = right + agreed, differ + parts
            low, high = np.minimum(start[k], goals[:, k]), np.maximum(start[k], goals[:, k])
            safe = sum(np.maximum(np.minimum(high, b) - np.maximum(low, a), 0.0) for a, b in arcs)
            lost[:, k] = (high - low - safe) / velocity[k]
        ours.append(got.exposure)
        brute.append(lost.sum(axis=1).min())
        nearest = goals[np.abs(goals - start).max(axis=1).argmin()]
        way = start + np.linspace(0, 1, 2001)[:, None] * (nearest - start)
        out = [~np.any([(x >= a) & (x <= b) for a, b in spans], axis=0) for x, spans in zip(way.T, got.ranges, strict=True)]
        straight.append(float(np.mean(out, axis=1).sum()) * float((np.abs(nearest - start) / velocity).max()))
        for q, k in zip(
            got.positions_at(locks.uniform(0, got.duration, INJECTED)), locks.integers(0, arm.n, INJECTED), strict=True
        ):
            if any(a + 1e-6 <= q[k] <= b - 1e-6 for a, b in got.ranges[k]):
                tried += 1
                lost_inside += not there(int(k), q[k])
    each, force = np.array(ours), np.array(brute)
    worst = 100 * float(np.abs(each / force - 1).max())
    claims = [
        Claim(
            "E3 exposure beside brute force",
            "asked within 0.5 %",
            f"{worst:.3f} % at most, {len(each)} pairs",
            f"in the mean {each.mean():.3f} s and {force.mean():.3f} s; where the ranges of `joint_bounds` differ, in {differ} "
            f"intervals, branch and bound decides: the curves are right in {right}",
            verdict(worst <= 0.5),
        ),
        Claim(
            "E3 locks inside the ranges that lose the goal",
            "asked 0",
            f"{lost_inside} of {tried}",
            "all configurations with the joint locked, by branch and bound",
            verdict(lost_inside == 0),
        ),
        Claim(
            "7.3 exposure in the mean, s",
            "1.51, straight to the nearest goal 2.62",
            f"{each.mean():.2f}, {np.mean(straight):.2f}",
            "other pairs, drawn alike",
        ),
    ]
    return Part(claims)


def decided(
    theirs: Sequence[tuple[float, float]], ours: Sequence[tuple[float, float]], there: Callable[[float], bool]
) -> tuple[list[tuple[float, float]], int, int]:
    """Arcs by the proof ``there`` where two lists of them differ; in how many intervals ``ours`` is right, of how many."""
    ends = sorted({x for arc in (*theirs, *ours) for x in arc})
    arcs, right, differ = [], 0, 0
    for a, b in pairwise(ends):
        said = [any(low <= (a + b) / 2 <= high for low, high in every) for every in (theirs, ours)]
        yes = said[0]
        if said[0] != said[1] and b - a > _APART:
            yes = there((a + b) / 2)
            right, differ = right + (yes == said[1]), differ + 1
        if yes:
            arcs.append((a, b))
    return arcs, right, differ
