"""Monitored signals of a log: residual torques, tracking errors, and measured minus computed tool pose."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from holdfast.core.typing import FloatArray
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import rotation_vectors, rotations_of_quaternions
from holdfast.response.diagnosis.gaps import MAX_BRIDGED_GAP_S, complete_row_mask, split_at_gaps
from holdfast.response.diagnosis.observer import (
    accumulate_excess,
    filtered_rates,
    momentum_kernel,
    observe_residuals,
    slow_residual_component,
)
from holdfast.response.faults.log import Log

EXCESS_LIMITS_S = {"torque": 0.010, "tracking": 0.020, "tool": 0.050}  # accumulated excess that raises an alarm, s
SMOOTHING_SAMPLES = 5  # samples of the tool pose over which its residual is averaged
MAX_SLOW_RATE = 0.6  # rad/s or m/s; without torques, tracking counts while all references are slower than this
CALM_TIME_S = 0.1  # and have been slower for this time, s


@dataclass(frozen=True, eq=False, kw_only=True)
class ScaledResiduals:
    """Residuals in units of their thresholds, and their accumulated excess in seconds."""

    torque: FloatArray  # (T, n)
    tracking: FloatArray  # (T, n)
    tool: FloatArray  # (T,) NaN where the pose is not measured
    excess: dict[str, FloatArray]  # by level, seconds
    alarm: tuple[int, tuple[str, ...]] | None  # row of the first alarm, and the levels that alarm there; None if there is none


@dataclass(frozen=True, eq=False, kw_only=True)
class Signals:
    """Residuals of a log, T samples of n joints."""

    dt: float  # s
    seen: NDArray[np.bool_]  # (T,) True where every joint signal has a value; elsewhere, the arrays below contain NaN
    torque: FloatArray  # (T, n) residual torque r, N m and N; 0 without torques
    tracking: FloatArray  # (T, n) distance from the reference, rad and m; without torques NaN in motion that is not slow
    tool: FloatArray  # (T, 6) measured minus computed tool pose, m and rad, smoothed; NaN between samples
    v: FloatArray  # (T, n) filtered rates, rad/s and m/s
    gravity: FloatArray  # (T, n) N m and N; 0 without torques
    asked: FloatArray  # (T, n) commanded torques through both filters of the residual, N m and N; 0 without torques
    levels: tuple[str, ...]  # available signals of ``torque``, ``tracking`` and ``tool``

    def largest_residual(self, name: str) -> FloatArray | float:
        """Return the largest ``torque``, its ``change``, or ``tracking``, (n,), or the largest ``position`` or ``angle`` error
        of the tool; infinite if the signal is absent.
        """
        if name == "change":
            torque = self.torque[self.seen]
            change = torque - slow_residual_component(torque, self.dt)
            return np.asarray(np.abs(change).max(axis=0) if "torque" in self.levels else np.full(change.shape[1], np.inf))
        if name in ("torque", "tracking"):
            values = np.nan_to_num(np.abs(getattr(self, name))).max(axis=0)
            return np.asarray(values if name in self.levels else np.full(len(values), np.inf))
        part = self.tool[:, :3] if name == "position" else self.tool[:, 3:]
        return float(np.nanmax(np.linalg.norm(part, axis=1))) if "tool" in self.levels else np.inf

    def scale_by_bounds(self, torque: FloatArray, tracking: FloatArray, position: float, angle: float) -> ScaledResiduals:
        """Return the residuals in units of their thresholds, with the first alarm."""
        scaled_torque, scaled_tracking = np.abs(self.torque) / torque, np.abs(self.tracking) / tracking
        tool_sizes = [np.linalg.norm(self.tool[:, :3], axis=1) / position, np.linalg.norm(self.tool[:, 3:], axis=1) / angle]
        scaled_tool = np.maximum(*tool_sizes)
        excess_times = {
            "torque": accumulate_excess(scaled_torque, self.dt),
            "tracking": accumulate_excess(scaled_tracking, self.dt),
            "tool": self._tool_excess(scaled_tool),
        }
        first_rows, alarm = dict[str, int](), None
        for name in (name for name in excess_times if name in self.levels):
            is_alarmed = (excess_times[name].reshape(len(scaled_tool), -1) > EXCESS_LIMITS_S[name]).any(axis=1)
            if is_alarmed.any():
                first_rows[name] = int(is_alarmed.argmax())
        if first_rows:
            first_row = min(first_rows.values())
            alarm = first_row, tuple(name for name, row in first_rows.items() if row == first_row)
        return ScaledResiduals(
            torque=scaled_torque, tracking=scaled_tracking, tool=scaled_tool, excess=excess_times, alarm=alarm
        )

    def _tool_excess(self, scaled: FloatArray) -> FloatArray:
        """Accumulate the tool's excess; each sample counts for the time since the previous one, at most 50 ms."""
        sampled_rows = np.flatnonzero(np.isfinite(scaled))
        total = np.zeros(len(scaled))
        if sampled_rows.size > 1:
            durations = np.minimum(np.diff(sampled_rows, prepend=sampled_rows[0]) * self.dt, MAX_BRIDGED_GAP_S)
            sample_excess = accumulate_excess(scaled[sampled_rows], durations)
            total = sample_excess[np.maximum(np.searchsorted(sampled_rows, np.arange(len(scaled)), side="right") - 1, 0)]
            total[: sampled_rows[0]] = 0.0
        return total


def compute_signals(arm: Arm, log: Log, *, coulomb: FloatArray, viscous: FloatArray, body: Arm | None = None) -> Signals:
    """Compute the residuals of a log.

    Args:
        arm: Arm that was recorded.
        log: Evenly sampled log; missing joint values raise no alarm.
        coulomb: (n,) dry friction, N m and N.
        viscous: (n,) viscous friction, N m s/rad and N s/m.
        body: Arm with fitted masses, used for the dynamics. Default: ``arm``.

    Raises:
        InputError: The log is of another arm, has other units, or has no complete row.
        ArmError: Torques were recorded, and the arm's inertial data are missing or impossible.
    """
    period, is_complete = 1 / log.rate, complete_row_mask(log)
    levels, tracking = ["tracking"], np.where(is_complete[:, None], log.q_ref - log.q, np.nan)
    torque_residual, rates, gravity, commanded = np.where(is_complete[:, None], np.zeros((4, *log.q.shape)), np.nan)
    observe = partial(observe_residuals, dt=period, coulomb=coulomb, viscous=viscous)
    for segment in split_at_gaps(log, is_complete):
        complete_part = is_complete[segment.rows]
        if segment.tau is None:
            rates[segment.rows][complete_part] = filtered_rates(segment.q, period, moving=segment.settling > 1)[complete_part]
            continue
        segment_signals = observe(momentum_kernel(body or arm), segment.q, segment.tau, settling=segment.settling)
        for target, values in zip((torque_residual, rates, gravity, commanded), segment_signals, strict=True):
            target[segment.rows][complete_part] = values[complete_part]
    if log.tau is not None:
        levels.append("torque")
    else:
        tracking[~find_slow_rows(log.q_ref, is_complete, period)] = np.nan
    tool_errors = np.full((len(is_complete), 6), np.nan)
    if log.x is not None and log.quat is not None:
        pose_rows = np.flatnonzero(is_complete & np.isfinite(log.x).all(axis=1) & np.isfinite(log.quat).all(axis=1))
        if pose_rows.size >= SMOOTHING_SAMPLES:
            rotations = rotations_of_quaternions(log.quat[pose_rows])
            tool_errors[pose_rows] = _smooth_poses(tool_residual(arm, log.q[pose_rows], log.x[pose_rows], rotations))
            levels.append("tool")
    fields = {"torque": torque_residual, "tracking": tracking, "tool": tool_errors, "v": rates, "gravity": gravity}
    return Signals(dt=period, seen=is_complete, **fields, asked=commanded, levels=tuple(levels))


def tool_residual(arm: Arm, q: FloatArray, x: FloatArray, rotations: FloatArray) -> FloatArray:
    """Return measured minus computed tool poses (N, 6): ``(x_m - x(q); log(R_m R(q)'))``, m and rad."""
    poses = arm.forward_kinematics(q)
    rotation_errors = rotation_vectors(rotations @ poses[:, :3, :3].transpose(0, 2, 1))
    return np.concatenate([x - poses[:, :3, 3], rotation_errors], axis=1)


def find_slow_rows(reference: FloatArray, is_complete: NDArray[np.bool_], dt: float) -> NDArray[np.bool_]:
    """Return (T,) True where all references (T, n) were slow for a while, counting only the rows that have them."""
    row_indices, is_calm = np.flatnonzero(is_complete), np.zeros(len(is_complete), dtype=bool)
    steps = np.abs(np.diff(reference[row_indices], axis=0, prepend=reference[row_indices[:1]]))
    is_fast = (steps >= MAX_SLOW_RATE * dt * np.diff(row_indices, prepend=row_indices[0] - 1)[:, None]).any(axis=1)
    rows_since_fast = row_indices - np.maximum.accumulate(np.where(is_fast, row_indices, -1))
    is_calm[row_indices] = rows_since_fast >= max(1, round(CALM_TIME_S / dt))
    return is_calm


def _smooth_poses(rows: FloatArray) -> FloatArray:
    """Return means of the last samples, fewer at the beginning."""
    cumulative = np.cumsum(np.vstack([np.zeros(rows.shape[1]), rows]), axis=0)
    window_ends = np.arange(1, len(rows) + 1)
    window_starts = np.maximum(window_ends - SMOOTHING_SAMPLES, 0)
    return np.asarray((cumulative[window_ends] - cumulative[window_starts]) / (window_ends - window_starts)[:, None])
