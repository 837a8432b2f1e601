"""Static check of gravity against dry friction, joint stops, and weakened motors.

An arm at rest stays where it is if every joint without full torque bears its own gravity torque, because inertia does not
matter before the first motion. All results are closed forms of the gravity torques.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.errors import InputError
from holdfast.core.result import Result
from holdfast.core.status import Status, require_ok
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm import statics
from holdfast.model.arm.configurations import as_configurations
from holdfast.model.arm.friction import Friction, JointFriction
from holdfast.model.arm.model import Arm
from holdfast.model.failure_modes.sets import JointSet, read_joint_set

STOP_TOLERANCE = 1e-4
"""A joint is at a stop if it is this close to its limit, rad or m, so that limits may be given with four decimals."""

_ROUNDING_RATIO = 1e-12  # a torque this small relative to the largest possible one is rounding noise


@dataclass(frozen=True, kw_only=True)
class HoldCheck(Result):
    """Balance of torques of an arm at rest, at N configurations, or at one configuration (without the leading N).

    Torques of prismatic joints are forces, in N.

    Attributes:
        arm: The arm.
        q: (N, n) configurations, rad and m.
        free: Indices from 0 of the joints without full motor torque; the motors of all other joints hold them.
        friction: Friction of each joint, of which ``stiction`` and ``load`` matter here.
        effort: Fraction of their effort limits that the motors of the free joints still provide.
        torque: (N, n) torques that hold the arm against gravity, N m.
        stop: (N, n) -1 for a joint at its lower stop, 1 at its upper stop, 2 between two stops without travel, else 0.
        need: (N, n) torques that friction and motors must provide, N m; below 0 if a stop carries the joint.
        available: (N, n) largest torques that friction and motors provide, N m.
        holds: (N,) True if no free joint moves.
        margin: (N,) smallest ``available - need`` of the free joints, N m; negative if the arm falls.
        factor: (N,) smallest ``available / need`` of the free joints; infinite if the stops carry all of them.
        joint: (N,) index from 0 of the free joint with the smallest margin; -1 in a row of NaN.
        least_effort: (N,) smallest fraction of all effort limits with which motors, friction, and stops hold the arm; NaN if a
            required effort limit is unknown.
        status: (N,) ``Status.OK``, or ``BAD_INPUT`` in a row of NaN.
    """

    arm: Arm
    q: FloatArray
    free: tuple[int, ...]
    friction: JointFriction
    effort: float
    torque: FloatArray
    stop: NDArray[np.int8]
    need: FloatArray
    available: FloatArray
    holds: BoolArray
    margin: FloatArray
    factor: FloatArray
    joint: IndexArray
    least_effort: FloatArray
    status: NDArray[np.uint8]

    @property
    def largest_payload(self) -> FloatArray:
        """(N,) largest additional point mass at the tool point, kg, that friction, stops, and motors hold.

        The motors have the fraction ``effort`` for free joints, and the whole effort limit for others. NaN if no mass, not even
        0, is held.
        """
        q, torque, available = (np.atleast_2d(values) for values in (self.q, self.torque, self.available))
        strength = (available - self.friction.load * np.abs(torque)) / (1 - self.friction.load)
        payload = _largest_payload(self.arm, q, torque, np.atleast_2d(self.stop), strength)
        return np.asarray(payload[0]) if self.q.ndim == 1 else payload

    def require_ok(self) -> HoldCheck:
        """Return the object itself, or raise :class:`holdfast.HoldfastError`, which names the first row of NaN."""
        require_ok(self.status, "holds")
        return self


@check_arguments
def holds(
    arm: Arm,
    q: ArrayLike,
    *,
    free: JointSet = None,
    friction: Friction | None = None,
    effort: float = 0.0,
    stops: bool = True,
) -> HoldCheck:
    """Check whether an arm at rest stays where it is if joints lose their motor torque, or a part of it.

    A joint at a limit, within 1e-4 rad or m, is carried by its
    stop if gravity pushes it there.

    Args:
        arm: Arm model with the masses of its links.
        q: (n,) or (N, n) configurations, rad and m.
        free: Joints without full torque: names and indices from 0, or one text with names and numbers from 1 between commas;
            also ``board:NAME`` for a board of the friction; default: all joints.
        friction: Friction of the joints. Default: as the arm states.
        effort: Fraction of their effort limits that the motors of the free joints still provide, 0 to 1.
        stops: False if the limits of the arm are no stops.

    Returns:
        The verdict with the margin, the joint that gives way first, the least effort, and the largest payload.

    Raises:
        ArmError: The mass of a link is unknown.
        InputError: A joint does not exist or has no effort limit, friction is negative, stiction is below Coulomb friction, or
            a configuration is outside the limits; the message names the joint.
    """
    rows, single = as_configurations(arm, q)
    joints = np.array(read_joint_set(arm, free, (friction or Friction()).boards))
    if not 0 <= effort <= 1:
        raise InputError(f"effort is {effort:g}; it must be a fraction from 0 to 1, for example 0.35 for 35 %")
    joint_friction = (friction or Friction()).of_joints(arm)
    stop = _find_stops(arm, rows) if stops else np.zeros(rows.shape, dtype=np.int8)
    torque = _without_rounding_noise(arm, arm.gravity_torque(rows))
    need = _needed_torque(torque, stop)
    own_friction = joint_friction.stiction + joint_friction.load * np.abs(torque)
    limits = np.array([joint.effort for joint in arm.joints])
    motors = _motor_torque(arm, joints, limits, effort)
    available = own_friction + motors
    margin, factor = (available - need)[:, joints], _divide(available, need)[:, joints]
    is_valid = np.asarray(np.isfinite(rows).all(axis=1))
    first = np.argmin(np.where(is_valid[:, None], margin, 0.0), axis=1)
    selection = 0 if single else slice(None)
    return HoldCheck(
        arm=arm,
        q=rows[selection],
        free=tuple(joints.tolist()),
        friction=joint_friction,
        effort=float(effort),
        torque=torque[selection],
        stop=stop[selection],
        need=need[selection],
        available=available[selection],
        holds=np.asarray((margin >= 0).all(axis=1))[selection],
        margin=margin.min(axis=1)[selection],
        factor=factor.min(axis=1)[selection],
        joint=np.where(is_valid, joints[first], -1)[selection],
        least_effort=_least_effort(need - own_friction, limits)[selection],
        status=np.where(is_valid, Status.OK, Status.BAD_INPUT).astype(np.uint8)[selection],
    )


def _find_stops(arm: Arm, q: FloatArray) -> NDArray[np.int8]:
    below, above = arm.lower - q, q - arm.upper
    excess = np.maximum(below, above)
    for row, k in np.argwhere(excess > STOP_TOLERANCE):
        joint, where = arm.joints[k], f" in row {row}" if len(q) > 1 else ""
        raise InputError(
            f"joint '{joint.name}' is {excess[row, k]:.4g} {joint.unit} outside its limits{where}, {joint.lower:.6g} to "
            f"{joint.upper:.6g}; give a configuration within them, or stops=False (--no-stops) if they are no stops"
        )
    at_lower, at_upper = below >= -STOP_TOLERANCE, above >= -STOP_TOLERANCE
    return np.where(at_lower & at_upper, 2, at_upper.astype(np.int8) - at_lower.astype(np.int8)).astype(np.int8)


def _without_rounding_noise(arm: Arm, torque: FloatArray) -> FloatArray:
    """Replace torques that are 0 except for rounding, such as those of a joint with a vertical axis."""
    return np.where(np.abs(torque) <= _ROUNDING_RATIO * statics.torque_scale(arm), 0.0, torque)


def _needed_torque(torque: FloatArray, stop: NDArray[np.int8]) -> FloatArray:
    return np.select([stop == -1, stop == 1, stop == 2], [-torque, torque, np.full(torque.shape, -np.inf)], np.abs(torque))


def _motor_torque(arm: Arm, free: IndexArray, limits: FloatArray, effort: float) -> FloatArray:
    """Return the largest motor torque (n,) of each joint: its effort limit, or the fraction ``effort`` of it if it is free."""
    motors = limits.copy()
    motors[free] = 0.0
    if effort > 0:
        for k in free[np.isinf(limits[free])]:
            raise InputError(
                f"joint '{arm.joint_names[k]}' of '{arm.name}' has no effort limit, so a fraction of it is not known; give the "
                "joint its effort in the arm file, or leave the effort out"
            )
        motors[free] = effort * limits[free]
    return motors


def _divide(available: FloatArray, need: FloatArray) -> FloatArray:
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = available / need
    return np.where(need > 0, ratio, np.where(np.isnan(need), np.nan, np.inf))


def _least_effort(missing: FloatArray, limits: FloatArray) -> FloatArray:
    """Return the smallest sufficient fraction (N,) of the effort limits (n,) for missing torques (N, n)."""
    with np.errstate(divide="ignore", invalid="ignore"):
        fractions = np.where(np.isinf(limits), np.nan, missing / limits)
    return np.asarray(np.where(missing <= 0, 0.0, fractions).max(axis=1))


def _largest_payload(arm: Arm, q: FloatArray, torque: FloatArray, stop: NDArray[np.int8], strength: FloatArray) -> FloatArray:
    """Return the largest mass (N,) for which the torque of every joint stays between its bounds, +- ``strength`` (N, n)."""
    per_kilogram = -np.einsum("rik,i->rk", arm.jacobian(q)[:, :3], arm.gravity)
    is_noise = np.abs(per_kilogram) <= _ROUNDING_RATIO * np.linalg.norm(arm.gravity) * np.where(
        arm.prismatic, 1, arm.length_unit
    )
    per_kilogram = np.where(is_noise, 0.0, per_kilogram)
    highest = np.where((stop == -1) | (stop == 2), np.inf, strength)
    lowest = np.where((stop == 1) | (stop == 2), -np.inf, -strength)
    with np.errstate(divide="ignore", invalid="ignore"):
        limits = np.sort([(highest - torque) / per_kilogram, (lowest - torque) / per_kilogram], axis=0)
    is_carried = (lowest <= torque) & (torque <= highest)
    least, most = np.where(per_kilogram == 0, [np.where(is_carried, -np.inf, np.inf), np.full(torque.shape, np.inf)], limits)
    least, most = np.maximum(least.max(axis=1), 0.0), most.min(axis=1)
    return np.where(least <= most, most, np.nan)
