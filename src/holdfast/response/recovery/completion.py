"""Complete a motion that was found: verify it with independent code, and time it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.response.recovery.problem import RecoveryGoal
from holdfast.response.recovery.recovery import Recovery, RecoveryOutcome
from holdfast.response.recovery.space import FreeSpace
from holdfast.response.recovery.task_rows import TaskRows
from holdfast.response.recovery.timing.motion import TimedMotion, time_motion
from holdfast.response.recovery.verification import Verification, verify_waypoints
from holdfast.response.recovery.waypoints import FIRST_COLUMNS, time_or_length_column

if TYPE_CHECKING:
    from holdfast.kinematics.paths.path import Path


def verify_and_time_recovery(
    recovery: Recovery,
    space: FreeSpace,
    rows: TaskRows,
    aim: RecoveryGoal | None,
    path: Path | None,
    timing_limits: tuple[FloatArray, float] | None,
) -> Recovery:
    """Verify a recovery that has a motion, and time the motion if that is requested.

    Args:
        recovery: Recovery with its motion.
        space: Free space in which the motion was planned.
        rows: Task rows that the motion must meet.
        aim: Goal, if there is one.
        path: Tool path, if there is one.
        timing_limits: Accelerations (n,), rad/s^2 and m/s^2, and the period of the timed motion, s. None: not timed.
    """
    leg = next((leg for leg in recovery.legs if leg.name == "along the path"), None)
    path_samples = None
    if leg is not None and recovery.rest is not None:
        path_samples = recovery.rest.share, slice(leg.first, leg.last + 1)

    def verify_motion(
        q: FloatArray, path_samples_used: tuple[FloatArray, slice] | None, timing: tuple[FloatArray, FloatArray] | None = None
    ) -> Verification:
        goal_is_met = recovery.ending == RecoveryOutcome.GOAL_REACHED
        return verify_waypoints(
            recovery.degraded,
            recovery.at,
            q,
            rows=rows,
            goals=None if aim is None or not goal_is_met else aim.poses,
            goal_q=None if aim is None or not goal_is_met else aim.q,
            path_samples=None if path is None or path_samples_used is None or not goal_is_met else (path, *path_samples_used),
            constraints=recovery.keep,
            clearance=recovery.clearance,
            margin=recovery.margin,
            timing_limits=timing,
        )

    verified = verify_motion(recovery.q, path_samples)
    if timing_limits is None:
        return replace(recovery, verified=verified)
    column_name, column_values = time_or_length_column(space.arm, recovery.q)
    for cautious in (False, True):  # if the independent check rejects a rounded corner, no corner is rounded
        timed_result = time_motion(
            space,
            recovery.degraded,
            recovery.q,
            accelerations=timing_limits[0],
            period=timing_limits[1],
            without=float(column_values[-1]) if column_name == FIRST_COLUMNS[0] else None,
            stop_indices=[leg.last for leg in recovery.legs],
            path_samples=path_samples,
            stop_at_corners=cautious,
        )
        timed_verification = verify_motion(
            timed_result.q, _locate_tool_path_samples(timed_result), (timed_result.time, timed_result.accelerations)
        )
        if timed_verification.ok:
            break
    return replace(recovery, timed=timed_result, verified=verified.merge_timed(timed_verification))


def _locate_tool_path_samples(timed: TimedMotion) -> tuple[FloatArray, slice] | None:
    """Return the fractions of the tool path of the samples that lie on it, and their slice; None for fewer than two."""
    indices = np.flatnonzero(np.isfinite(timed.place))
    return (timed.place[indices], slice(int(indices[0]), int(indices[-1]) + 1)) if len(indices) > 1 else None
