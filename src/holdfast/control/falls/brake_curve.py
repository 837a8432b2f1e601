"""Drops of the tool with brakes of several torques and delays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.falls.brakes import Brakes
from holdfast.control.falls.drop_points import DropOf
from holdfast.control.falls.power_cut import power_loss
from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress, track
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.kinematics.holding.static_check import holds
from holdfast.model.arm.friction import Friction, JointNumbers, joint_numbers
from holdfast.model.arm.model import Arm


@dataclass(frozen=True, kw_only=True)
class BrakeComparison(Result):
    """Drops of the tool after a power loss for B brake torques and A delays.

    Attributes:
        arm: The arm.
        q: (n,) configuration at the power loss, rad and m.
        rates: (n,) joint rates at the power loss, rad/s and m/s.
        friction: Friction of the joints as requested; None as the arm states.
        of: ``tool``, or ``any point`` of the arm, whose drop was computed.
        after: (A,) times from the power loss until the brakes act, s.
        torque: (B, n) brake torque of each joint, N m or N.
        drop: (B, A) largest displacement along gravity, m.
        drop_at_brake: (A,) the same until the brakes act, m: the drop if they stopped the arm at once.
        drop_without: Drop without brakes, m.
        need: (n,) brake torque that holds each joint of the arm at rest in q, N m or N; below 0 if a stop carries it.
    """

    arm: Arm
    q: FloatArray
    rates: FloatArray
    friction: Friction | None
    of: DropOf
    after: FloatArray
    torque: FloatArray
    drop: FloatArray
    drop_at_brake: FloatArray
    drop_without: float
    need: FloatArray


@check_arguments
@reports_progress("comparing brakes")
def compare_brakes(
    arm: Arm,
    q: ArrayLike,
    rates: ArrayLike | None = None,
    *,
    torque: Sequence[JointNumbers],
    after: ArrayLike = (0.0, 0.01, 0.02, 0.05, 0.1, 0.2),
    friction: Friction | None = None,
    **options: Any,
) -> BrakeComparison:
    """Simulate how far an arm drops after a power loss, with brakes of several torques that act after several delays.

    Brakes of finite torque let the arm drop further after they act, and brakes that are too weak do not stop it.

    Args:
        arm: The arm, with inertial data for every link.
        q: (n,) configuration at the power loss, rad and m.
        rates: (n,) joint rates at the power loss, rad/s and m/s. Default: at rest.
        torque: Brake torques to compare, N m or N; each is one number for all joints, or n numbers.
        after: Times from the power loss until the brakes act, s.
        friction: Friction of the joints. Default: as the arm states.
        **options: Other keyword arguments of :func:`holdfast.power_loss`.

    Raises:
        InputError: A torque or delay is below 0, or an argument of :func:`holdfast.power_loss` is wrong.
        ArmError: As for :func:`holdfast.power_loss`.
    """
    start = arm.check_configurations(q)
    if start.ndim != 1:
        raise InputError(f"q has shape {start.shape}; brakes are compared in one configuration, ({arm.n},)")
    delays = require_real_numbers(after, "after")
    if delays.ndim != 1 or not delays.size:
        raise InputError(f"after is {after!r}; give at least one delay in s")
    torques = np.array([joint_numbers(arm, number, "brake torque") for number in torque])
    if not torques.size:
        raise InputError("torque is empty; give at least one brake torque in N m")
    options |= {"friction": friction, "rates": rates}
    drops = np.empty((len(torques), len(delays)))
    for row, column in track("brakes", list(np.ndindex(drops.shape))):
        brakes = Brakes(after=float(delays[column]), torque=torques[row])
        drops[row, column] = power_loss(arm, start, brakes=brakes, **options).require_ok().drop
    unbraked = power_loss(arm, start, **options).require_ok()
    until_brake = [power_loss(arm, start, **options | {"duration": t}).drop if t > 0 else 0.0 for t in delays]
    return BrakeComparison(
        arm=arm,
        q=start,
        rates=unbraked.rates,
        friction=friction,
        of=unbraked.of,
        after=delays,
        torque=torques,
        drop=drops,
        drop_at_brake=np.array(until_brake, dtype=np.float64),
        drop_without=float(unbraked.drop),
        need=holds(arm, start, friction=friction, stops=options.get("stops", True)).need,
    )
