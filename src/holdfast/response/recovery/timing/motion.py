"""Timed motion through waypoints, within speeds and accelerations, with corners rounded where that is proved valid."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.files.output import write_table
from holdfast.core.formatting import format_count
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kinematics.paths.joint_table import motion_column_names
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import rotation_vectors
from holdfast.model.failure_modes import Degraded
from holdfast.response.recovery.space import FreeSpace
from holdfast.response.recovery.timing.profile import compute_fastest_profile
from holdfast.response.recovery.timing.rounding import CornerChords, find_corner_cuts, round_corners

PATH_TOLERANCE = 5e-4, np.deg2rad(0.25)  # largest deviation of a rounded corner from a tool path, m and rad
_WAYPOINT_TOLERANCE = 1e-12  # rad and m: closer waypoints are merged
_MAX_ROWS = 1_000_000  # rows of a timed motion
_MERGE_RATIO = 1.0  # of the shorter neighbouring line: a merge is tried for waypoints that are closer than this


@dataclass(frozen=True, kw_only=True, eq=False)
class TimedMotion:
    """Motion within speeds and accelerations from standstill to standstill, sampled with a constant period.

    Between two rows the motion is smooth, and differences of the rows respect the limits.

    Attributes:
        arm: The arm.
        time: (N,) times, s.
        q, qd, qdd: (N, n) joint positions, rates and accelerations, rad and m, per s and s^2.
        accelerations: (n,) limits, rad/s^2 and m/s^2; 0 for locked joints.
        duration: Duration of the fastest motion, s; the rows take up to one period more.
        without: Duration at the velocity limits alone, with every corner at full speed, s; None without velocity limits.
        stops: Number of waypoints on the way at which the arm stops, because no rounding of the corner could be proved, or
            because the tool path begins or ends there.
        place: (N,) fraction of the tool path, 0 to 1; NaN where the motion is not along it.
    """

    arm: Arm
    time: FloatArray
    q: FloatArray
    qd: FloatArray
    qdd: FloatArray
    accelerations: FloatArray
    duration: float
    without: float | None
    stops: int
    place: FloatArray

    @property
    def period(self) -> float:
        """Time between two rows, s; 0 if there is only one."""
        return float(self.time[-1]) / max(len(self.time) - 1, 1)

    def to_csv(self, file: str | Path) -> Path:
        """Write joints, rates and accelerations with their units to the CSV file ``file``, and return its path.

        Raises:
            StoreError: The file cannot be written.
        """
        columns = ["time_s", *(name for names in motion_column_names(self.arm) for name in names)]
        return write_table(file, "motion", columns, np.column_stack([self.time, self.q, self.qd, self.qdd]), "%.17g")

    def describe(self) -> str:
        """Return the timing in one sentence."""
        without = "" if self.without is None else f" ({self.without:.3g} s at the velocity limits alone)"
        stops_text = f", with {format_count(self.stops, 'stop')} on the way" if self.stops else ""
        return f"within the acceleration limits it takes {self.duration:.3g} s{without}{stops_text}"


def time_motion(
    space: FreeSpace,
    degraded: Degraded,
    q: FloatArray,
    *,
    accelerations: FloatArray,
    period: float,
    without: float | None,
    stop_indices: Sequence[int] = (),
    path_samples: tuple[FloatArray, slice] | None = None,
    stop_at_corners: bool = False,
) -> TimedMotion:
    """Return the fastest motion found through waypoints (K, n), straight in joint space except for their corners.

    A corner is rounded by the largest of a few parabolas that is proved to respect limits, rows and clearance; along a tool
    path it also stays near the path.

    Args:
        space: Free space of the arm.
        degraded: Failed arm with the speeds in force.
        q: (K, n) waypoints, rad and m.
        accelerations: (n,) limits, rad/s^2 and m/s^2.
        period: Time between rows, s.
        without: Duration of the motion at the velocity limits alone, s, if there are any.
        stop_indices: Indices of the waypoints at which it must stop.
        path_samples: Fractions (S,) of the tool path, and the slice of the waypoints at these fractions.
        stop_at_corners: True to stop at every waypoint and round no corner.

    Raises:
        InputError: There would be more than a million rows.
    """
    path_fractions = np.full(len(q), np.nan)
    if path_samples is not None:
        path_fractions[path_samples[1]] = path_samples[0]
    must_stop = np.zeros(len(q), dtype=bool)
    must_stop[list(stop_indices)] = True
    is_distinct = np.concatenate([[True], np.abs(np.diff(q, axis=0)).max(axis=1) > _WAYPOINT_TOLERANCE])
    group = np.cumsum(is_distinct) - 1
    waypoints, must_stop, path_fractions = q[is_distinct], np.bincount(group, must_stop) > 0, path_fractions[is_distinct]
    waypoints[-1] = q[-1]
    variants = [(waypoints, must_stop, path_fractions)]
    if not stop_at_corners:
        merged = _merge_close_waypoints(space, waypoints, must_stop | np.isfinite(path_fractions), must_stop, path_fractions)
        variants += [merged] * (len(merged[0]) < len(waypoints))
    speeds = np.where(degraded.v > 0, degraded.v, np.inf)
    timings = []
    for waypoints, must_stop, path_fractions in variants:
        cut_lengths = (
            np.zeros(len(waypoints))
            if stop_at_corners
            else find_corner_cuts(waypoints, must_stop, partial(_are_chords_valid, space, np.isfinite(path_fractions)))
        )
        timings.append(
            (
                *_sample_profile(waypoints, cut_lengths, path_fractions, speeds, accelerations, period),
                int((cut_lengths[1:-1] == 0).sum()),
            )
        )
    columns, rates, joint_accelerations, duration, stops = min(timings, key=lambda timing: timing[3])
    arm = space.arm
    return TimedMotion(
        arm=degraded.arm,
        time=np.arange(len(columns), dtype=np.float64) * period,
        q=columns[:, : arm.n],
        qd=rates,
        qdd=joint_accelerations,
        accelerations=accelerations,
        duration=duration,
        without=without,
        stops=stops,
        place=columns[:, arm.n],
    )


def _are_chords_valid(space: FreeSpace, on_path: BoolArray, chords: CornerChords) -> BoolArray:
    """Return (E,) True for chords that are valid and, where waypoints are on a tool path (K,), within its tolerance."""
    is_valid = space.are_segments_valid(chords.first, chords.last, chords.deviations)
    indices = np.flatnonzero(is_valid & on_path[chords.corner])
    if indices.size:
        is_valid[indices] = _is_tool_near(space.arm, chords.last[indices], chords.line_points[indices])
    return is_valid


def _merge_close_waypoints(
    space: FreeSpace, waypoints: FloatArray, is_fixed: BoolArray, must_stop: BoolArray, path_fractions: FloatArray
) -> tuple[FloatArray, BoolArray, FloatArray]:
    """Merge two close waypoints that need not stay, because a short line leaves little room for rounding.

    The new waypoint is where the extended neighbouring lines are closest to each other, or in the middle of the two, if the new
    lines are proved free.
    """
    index = 1
    while index < len(waypoints) - 2:
        before, first, second, after = (waypoints[neighbor] for neighbor in range(index - 1, index + 3))
        incoming, outgoing = first - before, after - second
        if not is_fixed[index : index + 2].any() and np.linalg.norm(second - first) < _MERGE_RATIO * min(
            map(np.linalg.norm, (incoming, outgoing))
        ):
            s, t = np.linalg.lstsq(np.stack([incoming, outgoing], axis=1), second - first)[0]
            candidates = np.stack([(first + s * incoming + second - t * outgoing) / 2, (first + second) / 2])
            is_valid = space.are_segments_valid(np.tile(before, (2, 1)), candidates) & space.are_segments_valid(
                candidates, np.tile(after, (2, 1))
            )
            is_valid[0] &= s > -1 and t > -1
            if is_valid.any():
                waypoints = np.insert(
                    np.delete(waypoints, [index, index + 1], axis=0), index, candidates[is_valid.argmax()], axis=0
                )
                is_fixed = np.delete(is_fixed, index)
                must_stop = np.delete(must_stop, index)
                path_fractions = np.delete(path_fractions, index)
                continue
        index += 1
    return waypoints, must_stop, path_fractions


def _sample_profile(
    waypoints: FloatArray,
    cut_lengths: FloatArray,
    path_fractions: FloatArray,
    speeds: FloatArray,
    accelerations: FloatArray,
    period: float,
) -> tuple[FloatArray, FloatArray, FloatArray, float]:
    """Return joints and path fraction (N, n + 1), rates and accelerations (N, n) every period, and the duration, s."""
    n = waypoints.shape[1]
    if len(waypoints) == 1:
        return np.column_stack([waypoints, path_fractions]), 0 * waypoints, 0 * waypoints, 0.0
    pieces = round_corners(waypoints, cut_lengths, path_fractions[:, None])
    profile = compute_fastest_profile(pieces, speeds, np.where(accelerations > 0, accelerations, np.inf))
    duration = float(profile.time[-1])
    if not duration < _MAX_ROWS * period:
        raise InputError(
            f"the motion takes {duration:.4g} s, more than {_MAX_ROWS:,} rows {period:g} s apart; give a longer period"
        )
    count = int(np.ceil(duration / period * (1 - 1e-12)))
    time_scale = duration / (count * period)  # full periods: the motion is slowed by less than one
    columns, rates, joint_accelerations = profile.sample(pieces, np.append(np.arange(count) * period * time_scale, duration))
    columns[-1, :n], rates[-1] = waypoints[-1], 0.0
    return (
        columns,
        rates[:, :n] * time_scale + 0.0,
        joint_accelerations[:, :n] * time_scale**2 + 0.0,
        duration,
    )  # + 0 replaces -0, which would appear in a file


def _is_tool_near(arm: Arm, q: FloatArray, other: FloatArray) -> BoolArray:
    """Return (N,) True where the tool at q (N, n) is within the path tolerance of its pose at the other configurations."""
    poses, other_poses = arm.forward_kinematics(q), arm.forward_kinematics(other)
    position_errors = np.linalg.norm(poses[:, :3, 3] - other_poses[:, :3, 3], axis=1)
    orientation_errors = np.linalg.norm(rotation_vectors(poses[:, :3, :3] @ other_poses[:, :3, :3].transpose(0, 2, 1)), axis=1)
    return np.asarray(
        (position_errors <= PATH_TOLERANCE[0] * max(arm.length_unit, 1.0)) & (orientation_errors <= PATH_TOLERANCE[1])
    )
