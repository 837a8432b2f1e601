"""Proofs that no motion leads to the goal, or to the beginning of a tool path, and the tolerance for which they hold."""

from __future__ import annotations

from holdfast.core.typing import BoolArray, FloatArray
from holdfast.response.recovery.proofs.flood import ConnectedCells, find_confined_regions
from holdfast.response.recovery.proofs.reach import EXACT_TOLERANCE, Tolerance, enumerate_configurations, make_blocked_boxes
from holdfast.response.recovery.recovery import Recovery
from holdfast.response.recovery.space import FreeSpace


def prove_goal_disconnected(
    recovery: Recovery,
    space: FreeSpace,
    *,
    start: FloatArray,
    known_goals: FloatArray,
    poses: FloatArray,
    q_goal: FloatArray | None = None,
) -> tuple[str, bool] | None:
    """Prove that no motion leads to the goal; return the sentence and its validity within the tolerance, or None.

    Args:
        recovery: Recovery so far.
        space: Free space of the arm.
        start: (n,) start configuration, rad and m.
        known_goals: (K, n) configurations of the goal that were found and not reached.
        poses: (G, 4, 4) poses of the goal.
        q_goal: (n,) configuration that is the goal instead, if one is requested.
    """
    requested_tolerance = recovery.tolerance or EXACT_TOLERANCE
    for flood in find_confined_regions(space, start, known_goals):
        for tolerance in dict.fromkeys((requested_tolerance, EXACT_TOLERANCE)):
            if q_goal is not None or all(_is_goal_outside_region(flood, recovery, pose, space, tolerance) for pose in poses):
                return flood.proof_sentence, tolerance == requested_tolerance
    return None


def _is_goal_outside_region(
    flood: ConnectedCells, recovery: Recovery, pose: FloatArray, space: FreeSpace, tolerance: Tolerance
) -> bool:
    """Return True if it is proved that a flood contains no collision-free configuration of a pose (4, 4), in half the time."""
    blocked_boxes = make_blocked_boxes(space)

    def is_excluded(middle: FloatArray, half_widths: FloatArray) -> BoolArray:
        excluded = flood.excludes_boxes(middle, half_widths)
        if blocked_boxes is not None and not excluded.all():
            excluded[~excluded] = blocked_boxes(middle[~excluded], half_widths[~excluded])
        return excluded

    request = (recovery.degraded, recovery.task, pose, space.seconds_left / 2)
    solutions = enumerate_configurations(*request, is_excluded, tolerance, first=True)
    return solutions is not None and solutions.proved_empty
