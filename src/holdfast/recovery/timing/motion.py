"""A motion through waypoints with its timing: within speeds and accelerations, its corners rounded where that is proved."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.poses import rotation_vectors
from holdfast.errors import InputError
from holdfast.failures import Degraded
from holdfast.files.output import write_table
from holdfast.paths.joint_table import motion_columns
from holdfast.recovery.space import Space
from holdfast.recovery.timing.profile import fastest
from holdfast.recovery.timing.rounding import Corners, cuts_of, rounded
from holdfast.words import counted

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

OFF_PATH = 5e-4, np.deg2rad(0.25)  # m and rad: what a rounded corner may take off a tool path
_SAME = 1e-12  # rad and m: waypoints this near are one
_MOST = 1_000_000  # rows
_CLOSE = 1.0  # of the shorter line beside two waypoints: those nearer to each other than that are tried as one


@dataclass(frozen=True, kw_only=True, eq=False)
class TimedMotion:
    """A motion within speeds and accelerations that begins and ends at standstill, at equal steps of time.

    Between two rows the motion goes on smoothly: differences of the rows keep the limits as the motion does.

    Attributes:
        arm: The arm.
        time: (N,) s.
        q, qd, qdd: (N, n) joints, their rates and accelerations; rad and m, s.
        accelerations: (n,) the limits, rad/s^2 and m/s^2; 0 of locked joints.
        duration: s, of the motion at its fastest; the rows take up to one step more.
        without: s, at the speed limits alone, every corner taken at speed; None without speed limits.
        stops: Waypoints on the way at which the arm stops: no rounding of their corner could be proved, or the tool path begins
            or ends there.
        place: (N,) on the tool path, 0 to 1; NaN where the motion is not along it.
    """

    arm: Arm
    time: Array
    q: Array
    qd: Array
    qdd: Array
    accelerations: Array
    duration: float
    without: float | None
    stops: int
    place: Array

    @property
    def period(self) -> float:
        """Time between two rows, s; 0 if there is one."""
        return float(self.time[-1]) / max(len(self.time) - 1, 1)

    def to_csv(self, file: str | Path) -> Path:
        """Write a row for each instant: its time, and the joints, rates and accelerations with their units.

        Raises:
            StoreError: The file cannot be written.
        """
        head = ["time_s", *(name for names in motion_columns(self.arm) for name in names)]
        return write_table(file, "motion", head, np.column_stack([self.time, self.q, self.qd, self.qdd]), "%.17g")

    def describe(self) -> str:
        """One sentence for people."""
        without = "" if self.without is None else f" ({self.without:.3g} s at the speed limits alone)"
        stops = f", with {counted(self.stops, 'stop')} on the way" if self.stops else ""
        return f"within the accelerations given it takes {self.duration:.3g} s{without}{stops}"


def timed_motion(
    space: Space,
    degraded: Degraded,
    q: Array,
    *,
    accelerations: Array,
    period: float,
    without: float | None,
    exact: Sequence[int] = (),
    along: tuple[Array, slice] | None = None,
    cautious: bool = False,
) -> TimedMotion:
    """The fastest motion found through waypoints (K, n), straight in joint space but for their corners.

    A corner is rounded by the largest parabola, of a few, that is proved to keep limits, rows and clearance; along a tool path
    it stays near it too.

    Args:
        space: Where the arm may be.
        degraded: What speeds are in force.
        q: (K, n) waypoints, rad and m.
        accelerations: (n,) limits, rad/s^2 and m/s^2.
        period: s between rows.
        without: s that the motion takes at the speed limits alone, if there are any.
        exact: At which waypoints it must stop.
        along: Places (S,) on the tool path, and which waypoints are there.
        cautious: Round no corner: stop at every waypoint.

    Raises:
        InputError: There would be more than a million rows.
    """
    place = np.full(len(q), np.nan)
    if along is not None:
        place[along[1]] = along[0]
    held = np.zeros(len(q), dtype=bool)
    held[list(exact)] = True
    new = np.concatenate([[True], np.abs(np.diff(q, axis=0)).max(axis=1) > _SAME])
    group = np.cumsum(new) - 1
    way, held, place = q[new], np.bincount(group, held) > 0, place[new]
    way[-1] = q[-1]
    ways = [(way, held, place)]
    if not cautious:
        joined = _joined(space, way, held | np.isfinite(place), held, place)
        ways += [joined] * (len(joined[0]) < len(way))
    speeds = np.where(degraded.v > 0, degraded.v, np.inf)
    found = []
    for way, held, place in ways:
        cut = np.zeros(len(way)) if cautious else cuts_of(way, held, partial(_allowed, space, np.isfinite(place)))
        found.append((*_sampled(way, cut, place, speeds, accelerations, period), int((cut[1:-1] == 0).sum())))
    columns, rates, seconds, duration, stops = min(found, key=lambda made: made[3])
    arm = space.arm
    return TimedMotion(
        arm=degraded.arm,
        time=np.arange(len(columns), dtype=np.float64) * period,
        q=columns[:, : arm.n],
        qd=rates,
        qdd=seconds,
        accelerations=accelerations,
        duration=duration,
        without=without,
        stops=stops,
        place=columns[:, arm.n],
    )


def _allowed(space: Space, near: Flags, chords: Corners) -> Flags:
    """Which chords are free, and where waypoints are on a tool path (K,) hardly off it."""
    good = space.edges(chords.first, chords.last, chords.away)
    some = np.flatnonzero(good & near[chords.corner])
    if some.size:
        good[some] = _near(space.arm, chords.last[some], chords.cut[some])
    return good


def _joined(space: Space, way: Array, stays: Flags, held: Flags, place: Array) -> tuple[Array, Flags, Array]:
    """The way (K, n) with one waypoint for two close ones that need not stay, as a short line leaves little to round.

    It is where the lines beside them come nearest to each other, drawn on, or in the middle of the two: if the new lines are
    proved to be free.
    """
    k = 1
    while k < len(way) - 2:
        before, a, b, after = (way[i] for i in range(k - 1, k + 3))
        towards, onwards = a - before, after - b
        if not stays[k : k + 2].any() and np.linalg.norm(b - a) < _CLOSE * min(map(np.linalg.norm, (towards, onwards))):
            s, t = np.linalg.lstsq(np.stack([towards, onwards], axis=1), b - a)[0]
            tried = np.stack([(a + s * towards + b - t * onwards) / 2, (a + b) / 2])
            free = space.edges(np.tile(before, (2, 1)), tried) & space.edges(tried, np.tile(after, (2, 1)))
            free[0] &= s > -1 and t > -1
            if free.any():
                way = np.insert(np.delete(way, [k, k + 1], axis=0), k, tried[free.argmax()], axis=0)
                stays, held, place = np.delete(stays, k), np.delete(held, k), np.delete(place, k)
                continue
        k += 1
    return way, held, place


def _sampled(
    way: Array, cut: Array, place: Array, speeds: Array, accelerations: Array, period: float
) -> tuple[Array, Array, Array, float]:
    """Joints and the place (N, n + 1), rates and accelerations (N, n) every period, and the duration of the motion, s."""
    n = way.shape[1]
    if len(way) == 1:
        return np.column_stack([way, place]), 0 * way, 0 * way, 0.0
    pieces = rounded(way, cut, place[:, None])
    profile = fastest(pieces, speeds, np.where(accelerations > 0, accelerations, np.inf))
    duration = float(profile.time[-1])
    if not duration < _MOST * period:
        raise InputError(
            f"the motion takes {duration:.4g} s, more than {_MOST:,} rows {period:g} s apart; give a longer period"
        )
    count = int(np.ceil(duration / period * (1 - 1e-12)))
    pace = duration / (count * period)  # whole periods: it is slowed by less than one
    columns, rates, seconds = profile.at(pieces, np.append(np.arange(count) * period * pace, duration))
    columns[-1, :n], rates[-1] = way[-1], 0.0
    return columns, rates[:, :n] * pace + 0.0, seconds[:, :n] * pace**2 + 0.0, duration  # + 0: no -0 in a file


def _near(arm: Arm, q: Array, other: Array) -> Flags:
    """(N,) True where the tool at q (N, n) is hardly off where it is at the other configurations."""
    a, b = arm.forward_kinematics(q), arm.forward_kinematics(other)
    off = np.linalg.norm(a[:, :3, 3] - b[:, :3, 3], axis=1)
    turned = np.linalg.norm(rotation_vectors(a[:, :3, :3] @ b[:, :3, :3].transpose(0, 2, 1)), axis=1)
    return np.asarray((off <= OFF_PATH[0] * max(arm.length_unit, 1.0)) & (turned <= OFF_PATH[1]))
