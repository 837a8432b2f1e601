"""What is watched of a record: residual torques, tracking, and the measured tool against that of the joints."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.poses import rotation_vectors, rotations_of_quaternions
from holdfast.diagnosis.gaps import STALE, seen, stretches
from holdfast.diagnosis.observer import excess, filtered_rates, level, momentum_kernel, residuals
from holdfast.faults.log import Log

Array = NDArray[np.float64]

LIMITS = {"torque": 0.010, "tracking": 0.020, "tool": 0.050}  # s of excess
SMOOTHED = 5  # samples of the tool's pose
SLOW, CALM = (
    0.6,
    0.1,
)  # rad/s or m/s, s: with joint sensors alone, tracking counts while all references were so slow for so long


@dataclass(frozen=True, eq=False, kw_only=True)
class Scaled:
    """Residuals in units of their bounds, and their seconds of excess.

    Attributes:
        torque, tracking: (T, n).
        tool: (T,) NaN where the pose is not measured.
        excess: By level, seconds.
        alarm: Row of the first alarm, and the levels that alarm there; None if there is none.
    """

    torque: Array
    tracking: Array
    tool: Array
    excess: dict[str, Array]
    alarm: tuple[int, tuple[str, ...]] | None


@dataclass(frozen=True, eq=False, kw_only=True)
class Signals:
    """Residuals of a record, T samples of n joints.

    Attributes:
        dt: s.
        seen: (T,) whether the joints told all of their numbers; where not, what follows has NaN.
        torque: (T, n) residual torque r, N m and N; 0 without torques.
        tracking: (T, n) distance from the reference, rad and m; without torques NaN in motion that is not slow.
        tool: (T, 6) measured pose less that of the joints, m and rad, smoothed; NaN between samples.
        v: (T, n) filtered rates, rad/s and m/s.
        gravity: (T, n) N m and N; 0 without torques.
        asked: (T, n) commanded torques through both filters of the residual, likewise.
        levels: What of ``torque``, ``tracking`` and ``tool`` is there.
    """

    dt: float
    seen: NDArray[np.bool_]
    torque: Array
    tracking: Array
    tool: Array
    v: Array
    gravity: Array
    asked: Array
    levels: tuple[str, ...]

    def largest(self, name: str) -> Array | float:
        """Largest size of ``torque``, its ``change`` or ``tracking``, (n,), or of the tool's ``position`` or ``angle``.

        Infinite if absent.
        """
        if name == "change":
            torque = self.torque[self.seen]
            change = torque - level(torque, self.dt)
            return np.asarray(np.abs(change).max(axis=0) if "torque" in self.levels else np.full(change.shape[1], np.inf))
        if name in ("torque", "tracking"):
            values = np.nan_to_num(np.abs(getattr(self, name))).max(axis=0)
            return np.asarray(values if name in self.levels else np.full(len(values), np.inf))
        part = self.tool[:, :3] if name == "position" else self.tool[:, 3:]
        return float(np.nanmax(np.linalg.norm(part, axis=1))) if "tool" in self.levels else np.inf

    def scaled(self, torque: Array, tracking: Array, position: float, angle: float) -> Scaled:
        """In units of bounds, with what alarms first."""
        z, y = np.abs(self.torque) / torque, np.abs(self.tracking) / tracking
        sizes = [np.linalg.norm(self.tool[:, :3], axis=1) / position, np.linalg.norm(self.tool[:, 3:], axis=1) / angle]
        w = np.maximum(*sizes)
        over = {"torque": excess(z, self.dt), "tracking": excess(y, self.dt), "tool": self._tool_excess(w)}
        flags = {name: (over[name].reshape(len(w), -1) > LIMITS[name]).any(axis=1) for name in over if name in self.levels}
        rows = {name: int(flag.argmax()) for name, flag in flags.items() if flag.any()}
        alarm = None
        if rows:
            first = min(rows.values())
            alarm = first, tuple(name for name, row in rows.items() if row == first)
        return Scaled(torque=z, tracking=y, tool=w, excess=over, alarm=alarm)

    def _tool_excess(self, w: Array) -> Array:
        """Between samples of the pose it stays; each counts for the time since the last one, but for no more than 50 ms."""
        there = np.flatnonzero(np.isfinite(w))
        total = np.zeros(len(w))
        if there.size > 1:
            steps = np.minimum(np.diff(there, prepend=there[0]) * self.dt, STALE)
            found = excess(w[there], steps)
            total = found[np.maximum(np.searchsorted(there, np.arange(len(w)), side="right") - 1, 0)]
            total[: there[0]] = 0.0
        return total


def signals_of(arm: Arm, log: Log, *, coulomb: Array, viscous: Array, body: Arm | None = None) -> Signals:
    """The residuals of a record.

    Args:
        arm: The arm.
        log: The record, evenly sampled; missing joint values are nobody's fault.
        coulomb: (n,) dry friction, N m and N.
        viscous: (n,) N m s/rad and N s/m.
        body: The arm with the masses that it has, if they are known better.

    Raises:
        InputError: A record of another arm, in other units, or without a row that has all of its numbers.
        ArmError: Torques are there, and the arm's inertial data are missing or impossible.
    """
    dt, told = 1 / log.rate, seen(log)
    levels, tracking = ["tracking"], np.where(told[:, None], log.q_ref - log.q, np.nan)
    r, v, gravity, asked = (np.where(told[:, None], np.zeros(log.q.shape), np.nan) for _ in range(4))
    of = partial(residuals, dt=dt, coulomb=coulomb, viscous=viscous)
    for part in stretches(log, told):
        rows = told[part.rows]
        if part.tau is None:
            v[part.rows][rows] = filtered_rates(part.q, dt, moving=part.settling > 1)[rows]
            continue
        found = of(momentum_kernel(body or arm), part.q, part.tau, settling=part.settling)
        for whole, values in zip((r, v, gravity, asked), found, strict=True):
            whole[part.rows][rows] = values[rows]
    if log.tau is not None:
        levels.append("torque")
    else:
        tracking[~calm(log.q_ref, told, dt)] = np.nan
    tool = np.full((len(told), 6), np.nan)
    if log.x is not None and log.quat is not None:
        there = np.flatnonzero(told & np.isfinite(log.x).all(axis=1) & np.isfinite(log.quat).all(axis=1))
        if there.size >= SMOOTHED:
            rotations = rotations_of_quaternions(log.quat[there])
            tool[there] = _smoothed(tool_residual(arm, log.q[there], log.x[there], rotations))
            levels.append("tool")
    parts = {"torque": r, "tracking": tracking, "tool": tool, "v": v, "gravity": gravity, "asked": asked}
    return Signals(dt=dt, seen=told, **parts, levels=tuple(levels))


def tool_residual(arm: Arm, q: Array, x: Array, rotations: Array) -> Array:
    """(N, 6) measured tool poses less those of the joints: ``(x_m - x(q); log(R_m R(q)'))``, m and rad."""
    poses = arm.forward_kinematics(q)
    turns = rotation_vectors(rotations @ poses[:, :3, :3].transpose(0, 2, 1))
    return np.concatenate([x - poses[:, :3, 3], turns], axis=1)


def calm(reference: Array, told: NDArray[np.bool_], dt: float) -> NDArray[np.bool_]:
    """(T,) whether all references (T, n) were slow for a while, of the rows that have them."""
    rows, slow = np.flatnonzero(told), np.zeros(len(told), dtype=bool)
    steps = np.abs(np.diff(reference[rows], axis=0, prepend=reference[rows[:1]]))
    fast = (steps >= SLOW * dt * np.diff(rows, prepend=rows[0] - 1)[:, None]).any(axis=1)
    slow[rows] = rows - np.maximum.accumulate(np.where(fast, rows, -1)) >= max(1, round(CALM / dt))
    return slow


def _smoothed(rows: Array) -> Array:
    """Means of the last samples, fewer at the beginning."""
    total = np.cumsum(np.vstack([np.zeros(rows.shape[1]), rows]), axis=0)
    last = np.arange(1, len(rows) + 1)
    first = np.maximum(last - SMOOTHED, 0)
    return np.asarray((total[last] - total[first]) / (last - first)[:, None])
