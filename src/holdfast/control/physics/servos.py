"""Joint servos for an arm in MuJoCo, which convert commanded joint rates to torques."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from types import ModuleType
from typing import Any

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_constructor
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm

INERTIA_SAMPLES = 64  # random configurations among which the largest inertia tunes a servo
SATURATION_FRACTION = 0.999  # fraction of the effort from which a motor counts as torque-saturated
DEFAULT_LEAD = 1.0  # rad or m: largest distance of a reference from a joint without torque limit


@check_constructor
@dataclass(frozen=True)
class Servos:
    """Joint servos, with the gains and rates at which each joint follows its command.

    The commanded rate is integrated into a reference r at every control cycle, and the motor's torque is

        K (r - q) + D (commanded rate - rate) + compensation x gravity torque,

    limited to the joint's effort. The reference stays within effort / K of the joint (1 rad or 1 m if the arm states no
    effort), which prevents windup at a saturated motor. There is no further integral action and no friction compensation.

    Attributes:
        bandwidth: Bandwidth of a joint, Hz. With w = 2 pi bandwidth, the joint's friction B, and its largest inertia M (with
            the other joints fixed) at the start and at 64 random configurations, K = w^2 M + w B and D = 2 ratio w M. With a
            ratio of 1 a joint alone follows with a pole at -w, with or without friction. Coupling between the joints makes some
            motions slower and some faster.
        ratio: Damping ratio of a joint without friction.
        rate: Rate of the control cycle (measured configuration, law, reference), Hz. The torques are updated at every step of
            the physics.
        compensation: Fraction of the gravity torque that the motors get as feedforward.
        stiffness: (n,) K of the joints, N m/rad or N/m, in place of ``bandwidth`` and ``ratio``; requires ``damping``.
        damping: (n,) D of the joints, N m s/rad or N s/m; requires ``stiffness``.
        step: Longest time step of the physics, s.

    Raises:
        InputError: A value is not above 0 (``compensation``, ``damping``: is below 0), or only one of K and D is given.
    """

    bandwidth: float = 10.0
    ratio: float = 1.0
    rate: float = 500.0
    _: KW_ONLY
    compensation: float = 1.0
    stiffness: Sequence[float] | None = None
    damping: Sequence[float] | None = None
    step: float = 1e-3

    def __post_init__(self) -> None:
        for name in ("bandwidth", "ratio", "rate", "step"):
            value = getattr(self, name)
            if not 1e-9 < value < 1e9:
                raise InputError(f"{name} of the servos is {value:g}; it must be above 1e-9 and below 1e9")
        if not (np.isfinite(self.compensation) and self.compensation >= 0):
            raise InputError(f"compensation of the servos is {self.compensation:g}; it must be a finite number of 0 or more")

        if (self.stiffness is None) != (self.damping is None):
            raise InputError("the servos have only one of stiffness and damping; give both, or a bandwidth")

    @property
    def substeps(self) -> int:
        """Steps of the physics in one control cycle."""
        return int(np.ceil(1 / (self.rate * self.step) - 1e-9))

    def gains(self, arm: Arm, mujoco: ModuleType, model: Any, *, start: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return K and D, (n,) each, of ``arm`` for its MuJoCo ``model``, whose ``qpos`` is 0 at ``start`` (n,), rad and m.

        ``mujoco`` is the imported module.
        """
        if self.stiffness is not None:
            return self._read_gains("stiffness", arm), self._read_gains("damping", arm)
        inertia, natural_frequency = _largest_inertia(arm, mujoco, model, start), 2 * np.pi * self.bandwidth
        friction = np.array([joint.friction for joint in arm.joints])
        return natural_frequency**2 * inertia + natural_frequency * friction, 2 * self.ratio * natural_frequency * inertia

    def _read_gains(self, name: str, arm: Arm) -> FloatArray:
        gain_values = np.asarray(getattr(self, name), dtype=np.float64)
        lower_bound = 0.0 if name == "damping" else np.finfo(np.float64).tiny
        if gain_values.shape != (arm.n,) or not np.isfinite(gain_values).all() or (gain_values < lower_bound).any():
            condition = "of 0 or more" if name == "damping" else "above 0"
            raise InputError(
                f"{name} of the servos must be {arm.n} finite numbers {condition}, one for each joint of '{arm.name}'"
            )
        return gain_values

    def describe(self) -> str:
        """Return a phrase with the gains, the rate, and the gravity compensation."""
        gains = "gains as given" if self.stiffness is not None else f"{self.bandwidth:g} Hz, damping ratio {self.ratio:g}"
        gravity = "" if self.compensation == 1 else f", {self.compensation:.0%} of gravity compensated"
        return f"joint servos with {gains}, control at {self.rate:g} Hz{gravity}"


def max_reference_offsets(arm: Arm, stiffness: FloatArray) -> FloatArray:
    """Return the largest distance (n,) of a reference from its joint, which requests the full effort."""
    effort = np.array([joint.effort for joint in arm.joints])
    return np.where(np.isfinite(effort), effort / stiffness, DEFAULT_LEAD)


def max_tracking_error(q: FloatArray, reference: FloatArray, locked: BoolArray) -> FloatArray:
    """Return the largest distance (n,) of each joint (T, n) from its reference while it was not locked (T, n), rad or m."""
    return np.asarray(np.where(locked, 0.0, np.abs(q - reference)).max(axis=0, initial=0.0))


def saturated_fraction(arm: Arm, torque: FloatArray, locked: BoolArray) -> FloatArray:
    """Return the fraction of the time (n,) for which the motor of each joint was torque-saturated while it was not locked."""
    effort = np.array([joint.effort for joint in arm.joints])
    healthy = ~locked
    is_saturated = healthy & (np.abs(torque) >= SATURATION_FRACTION * effort)
    return np.asarray(is_saturated.sum(axis=0) / np.maximum(healthy.sum(axis=0), 1))


def _largest_inertia(arm: Arm, mujoco: ModuleType, model: Any, start: FloatArray) -> FloatArray:
    """Return the largest sampled diagonal entry (n,) of the inertia matrix for each joint."""
    configurations = np.random.default_rng(0).uniform(*sampling_limits(arm), (INERTIA_SAMPLES, arm.n))
    data, inertias, product = mujoco.MjData(model), np.zeros(arm.n), np.zeros(arm.n)
    for q in (start, *configurations):
        data.qpos[:] = q - start
        mujoco.mj_forward(model, data)
        for joint, unit_vector in enumerate(np.eye(arm.n)):
            mujoco.mj_mulM(model, data, product, unit_vector)
            inertias[joint] = max(inertias[joint], product[joint])
    return inertias
