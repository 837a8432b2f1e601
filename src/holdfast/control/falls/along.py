"""Power losses at every instant of a motion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.falls.fall import PowerLoss, measure_fall
from holdfast.control.falls.power_cut import power_loss
from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress, track
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.model.arm.friction import Friction
from holdfast.model.arm.model import Arm
from holdfast.model.failure_modes.sets import read_joint_set

RATE_FIT_SAMPLES = 5  # of the parabola whose slope is the rate
MAX_PLAUSIBLE_RATE_RAD_S = 100.0
MAX_REFINEMENTS = 3  # each halves the time between instants whose drops differ
REFINED_CHANGE_FRACTION = 0.1  # of the largest drop


@dataclass(frozen=True, kw_only=True)
class DropCurve(Result):
    """Drop of the tool as a function of the instant of a motion at which the power is lost, T instants.

    Between these instants nothing was simulated, so the worst instant is the worst of these T.

    Attributes:
        time: (T,) instants, s; those of the motion, and further ones where the drop changes by more than 10 % of its maximum.
        falls: Falls from the T instants.
        rates_from: ``given`` or ``fitted`` (slope of a parabola through 5 configurations).
    """

    time: FloatArray
    falls: PowerLoss
    rates_from: Literal["given", "fitted"]

    @property
    def drop(self) -> FloatArray:
        """(T,) largest displacement of the tool along gravity, m; until the first contact if contacts are checked."""
        return self.falls.drop

    @property
    def impact_speed(self) -> FloatArray:
        """(T,) normal speed at the first contact, m/s; NaN without contact."""
        return measure_fall(self.falls, "impact_speed")

    @property
    def impact_energy(self) -> FloatArray:
        """(T,) kinetic energy that an inelastic first contact takes, J; NaN without contact."""
        return measure_fall(self.falls, "impact_energy")

    @property
    def worst(self) -> int:
        """Index of the instant with the largest drop."""
        return int(np.argmax(self.drop))

    @property
    def exposure(self) -> float:
        """Integral of the drop over time, m s: the mean drop for a power loss at a random instant, times the duration."""
        return float(np.trapezoid(self.drop, self.time))

    @property
    def spacing(self) -> float:
        """Largest time between two instants, s; 0 if there is only one."""
        return float(np.diff(self.time).max(initial=0.0))

    def confirm(self, count: int = 25) -> tuple[FloatArray, FloatArray]:
        """Simulate falls from evenly spaced instants in MuJoCo, with all contacts, also after the first one.

        Args:
            count: Number of instants.

        Returns:
            Their times (K,), s, and drops (K,), m.

        Raises:
            HoldfastError: MuJoCo is not installed.
        """
        rows = np.unique(np.linspace(0, len(self.time) - 1, count).round().astype(int))
        return self.time[rows], np.array([self.falls.physical(row).drop for row in track("falls", rows.tolist())])

    def find_hold_up_time(self, below: float) -> float | None:
        """Return the time since the start, s, after which the drop stays at or below a limit, m; None if it does not.

        If the arm starts this motion when the supply fails, a buffer must supply its drives for this time.
        """
        above = np.flatnonzero(~(self.drop <= below))
        first_safe = above[-1] + 1 if above.size else 0
        return None if first_safe == len(self.time) else float(self.time[first_safe] - self.time[0])


@check_arguments
@reports_progress("simulating power losses along the motion")
def power_loss_along(
    arm: Arm, q: ArrayLike, time: ArrayLike, *, rates: ArrayLike | None = None, refine: bool = True, **options: Any
) -> DropCurve:
    """Simulate a power loss at every instant of a motion.

    Args:
        arm: The arm, with inertial data for every link.
        q: (T, n) configurations of the motion, rad and m.
        time: (T,) increasing instants, s.
        rates: (T, n) joint rates, rad/s and m/s. Default: the slope of a parabola through 5 neighbouring configurations.
        refine: True to add instants where the drop changes by more than 10 % of its maximum between two instants.
        **options: Keyword arguments of :func:`holdfast.power_loss`, for example ``friction`` or ``cell``. Joints that are not
            in ``free`` stop at once.

    Raises:
        InputError: Times do not increase, there are fewer than 5 instants without rates, a rate is implausible, or an argument
            of :func:`holdfast.power_loss` is wrong.
        ArmError: As for :func:`holdfast.power_loss`.
    """
    instants, motion = _check_motion(arm, q, time)
    speeds = _fit_rates(instants, motion) if rates is None else require_real_numbers(rates, "rates")
    if speeds.shape != motion.shape or not np.isfinite(speeds).all():
        raise InputError(f"rates has shape {speeds.shape}; give one finite rate for each value of q, {motion.shape}")
    too_fast = np.argwhere((np.abs(speeds) > MAX_PLAUSIBLE_RATE_RAD_S) & ~arm.prismatic)
    if too_fast.size:
        row, joint = too_fast[0]
        raise InputError(
            f"joint '{arm.joint_names[joint]}' moves at {speeds[row, joint]:.4g} rad/s at {instants[row]:g} s; if q is in "
            "degrees, convert it to rad"
        )
    friction: Friction = options.get("friction") or Friction()
    free = np.isin(np.arange(arm.n), read_joint_set(arm, options.get("free"), friction.boards))

    def simulate(rows: FloatArray, row_rates: FloatArray) -> PowerLoss:
        return power_loss(arm, rows, row_rates * free, **options).require_ok()

    falls = simulate(motion, speeds)
    drops = falls.drop
    for _ in range(MAX_REFINEMENTS if refine else 0):
        gaps = np.flatnonzero(np.abs(np.diff(drops)) > REFINED_CHANGE_FRACTION * np.abs(drops).max())
        if not gaps.size:
            break
        middle_q, middle_rates = _interpolate_middle(instants, motion, speeds, gaps)
        instants = np.insert(instants, gaps + 1, (instants[gaps] + instants[gaps + 1]) / 2)
        motion, speeds = np.insert(motion, gaps + 1, middle_q, axis=0), np.insert(speeds, gaps + 1, middle_rates, axis=0)
        drops = np.insert(drops, gaps + 1, simulate(middle_q, middle_rates).drop)
    if len(drops) > len(falls):
        falls = simulate(motion, speeds)
    return DropCurve(time=instants, falls=falls, rates_from="fitted" if rates is None else "given")


def _check_motion(arm: Arm, q: ArrayLike, time: ArrayLike) -> tuple[FloatArray, FloatArray]:
    instants, motion = require_real_numbers(time, "time"), arm.check_configurations(q)
    if motion.ndim != 2 or instants.shape != (len(motion),):
        raise InputError(f"q has shape {motion.shape} and time {instants.shape}; give (T, {arm.n}) and (T,)")
    if not np.isfinite(motion).all():
        raise InputError(f"q for '{arm.name}' holds NaN or infinity in row {np.argmin(np.isfinite(motion).all(axis=1))}")
    if not len(instants) or not np.isfinite(instants).all() or not (np.diff(instants) > 0).all():
        raise InputError("time must contain at least one instant, and finite, increasing values")
    return instants, motion


def _fit_rates(time: FloatArray, q: FloatArray) -> FloatArray:
    """Return the slopes (T, n) of parabolas through 5 neighbouring rows (Savitzky and Golay 1964, uneven times allowed)."""
    if len(time) < RATE_FIT_SAMPLES:
        raise InputError(f"the motion has {len(time)} rows without rates; give the rates, or at least {RATE_FIT_SAMPLES} rows")
    first = np.clip(np.arange(len(time)) - RATE_FIT_SAMPLES // 2, 0, len(time) - RATE_FIT_SAMPLES)
    rows = first[:, None] + np.arange(RATE_FIT_SAMPLES)
    offsets = time[rows] - time[:, None]
    powers = offsets[..., None] ** np.arange(3)
    return np.asarray((np.linalg.pinv(powers) @ q[rows])[:, 1])


def _interpolate_middle(time: FloatArray, q: FloatArray, rates: FloatArray, gaps: IndexArray) -> tuple[FloatArray, FloatArray]:
    """Return configurations and rates in the middle between rows ``gaps`` and the next ones, on cubic polynomials."""
    duration = (time[gaps + 1] - time[gaps])[:, None]
    middle = (q[gaps] + q[gaps + 1]) / 2 + duration / 8 * (rates[gaps] - rates[gaps + 1])
    return middle, 1.5 * (q[gaps + 1] - q[gaps]) / duration - (rates[gaps] + rates[gaps + 1]) / 4
