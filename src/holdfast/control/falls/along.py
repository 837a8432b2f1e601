"""Power losses at every instant of a motion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.falls.fall import PowerLoss
from holdfast.control.falls.measures import measure_fall
from holdfast.control.falls.power_cut import power_loss
from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.model.arm.model import Arm
from holdfast.model.failure_modes.sets import read_joint_set

RATE_FIT_SAMPLES = 5  # of the parabola whose slope is the rate
MAX_PLAUSIBLE_RATE_RAD_S = 100.0
REFINEMENTS = 3  # each halves the time between instants whose drops differ
REFINED_CHANGE_FRACTION = 0.1  # of the largest drop


@dataclass(frozen=True, kw_only=True)
class DropCurve(Result):
    """Drop of the tool as a function of the instant of a motion at which the power is lost, T instants.

    Between these instants nothing was simulated, so the worst instant is the worst of these T.

    Attributes:
        arm: The arm.
        time: (T,) instants, s; those of the motion, and further ones where the drop changes by more than 10 % of its maximum.
        q: (T, n) configurations, rad and m.
        rates: (T, n) joint rates, rad/s and m/s.
        rates_from: ``given`` or ``fitted`` (slope of a parabola through 5 configurations).
        drop: (T,) largest displacement of the tool along gravity after a power loss at this instant, m; until the first contact
            if contacts are checked.
        impact_speed: (T,) normal speed at the first contact, m/s; NaN without contact.
        impact_energy: (T,) kinetic energy that an inelastic first contact takes, J; NaN without contact.
        error: (T,) estimated error of the tool point at the end of the fall, m.
        worst_fall: Fall from the instant with the largest drop.
    """

    arm: Arm
    time: FloatArray
    q: FloatArray
    rates: FloatArray
    rates_from: Literal["given", "fitted"]
    drop: FloatArray
    impact_speed: FloatArray
    impact_energy: FloatArray
    error: FloatArray
    worst_fall: PowerLoss

    @property
    def worst(self) -> int:
        """Index of the instant with the largest drop."""
        return int(np.argmax(self.drop))

    @property
    def exposure(self) -> float:
        """Integral of the drop over time, m s: expected drop for a power loss at a uniformly random instant, times duration."""
        return float(np.trapezoid(self.drop, self.time))

    @property
    def spacing(self) -> float:
        """Largest time between two instants, s; 0 if there is only one."""
        return float(np.diff(self.time).max(initial=0.0))

    def find_hold_up_time(self, below: float) -> float | None:
        """Return the first instant from which on the drop stays at or below a limit in m; None if there is none.

        If the arm starts this motion when the supply fails, its drives must be supplied for this time, s.
        """
        above = np.flatnonzero(~(self.drop <= below))
        if not above.size:
            return float(self.time[0])
        return None if above[-1] + 1 == len(self.time) else float(self.time[above[-1] + 1])


@check_arguments
@reports_progress("simulating power losses along the motion")
def power_loss_along(
    arm: Arm, q: ArrayLike, time: ArrayLike, rates: ArrayLike | None = None, *, refine: bool = True, **options: Any
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
    free = np.isin(np.arange(arm.n), read_joint_set(arm, options.get("free")))

    def simulate(rows: FloatArray, row_rates: FloatArray) -> FloatArray:
        fall = power_loss(arm, rows, row_rates * free, **options).require_ok()
        return np.column_stack([measure_fall(fall, name) for name in ("drop", "impact_speed", "impact_energy")] + [fall.error])

    values = simulate(motion, speeds)
    for _ in range(REFINEMENTS if refine else 0):
        changes = np.abs(np.diff(values[:, 0]))
        gaps = np.flatnonzero(changes > REFINED_CHANGE_FRACTION * np.abs(values[:, 0]).max())
        if not gaps.size:
            break
        middle_q, middle_rates = _interpolate_middle(instants, motion, speeds, gaps)
        middle_values = simulate(middle_q, middle_rates)
        middle_instants = (instants[gaps] + instants[gaps + 1]) / 2
        instants, motion = np.insert(instants, gaps + 1, middle_instants), np.insert(motion, gaps + 1, middle_q, axis=0)
        speeds, values = np.insert(speeds, gaps + 1, middle_rates, axis=0), np.insert(values, gaps + 1, middle_values, axis=0)
    worst = int(np.argmax(values[:, 0]))
    return DropCurve(
        arm=arm,
        time=instants,
        q=motion,
        rates=speeds,
        rates_from="fitted" if rates is None else "given",
        drop=values[:, 0],
        impact_speed=values[:, 1],
        impact_energy=values[:, 2],
        error=values[:, 3],
        worst_fall=power_loss(arm, motion[worst], speeds[worst] * free, **options),
    )


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
