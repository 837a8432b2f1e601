"""What a free-swinging failure of each joint would do to an arm at rest: torque, acceleration, swing angle.

Each constructor takes ``(arm, weights=None)`` and returns a :class:`Susceptibility`; smaller is better. Weights combine
the joints into ``f' W f`` and are None (all alike), n numbers (diagonal), an (n, n) positive semidefinite matrix, and for
torques also ``"effort"`` (each over its joint's effort limit) or ``"worst-case"`` (each over its largest static value in
the workspace, so that every term is 0 to 1).

Source: English and Maciejewski 1998.
"""

from __future__ import annotations

from collections.abc import Callable

from holdfast.arm.model import Arm
from holdfast.checked import checked
from holdfast.errors import InputError
from holdfast.indices.susceptibility.formulas import ACCELERATION, SWING_ANGLE, TORQUE, Formula
from holdfast.indices.susceptibility.measure import Evaluation, JointStatus, Susceptibility, Together
from holdfast.indices.susceptibility.weights import WeightSpec, largest_static_torque


@checked
def torque(arm: Arm, weights: WeightSpec = None) -> Susceptibility:
    """The torque or force that holds each joint against gravity; English and Maciejewski 1998, eq. (7), (8), (12).

    Raises:
        ArmError: A link of which nothing is known.
        InputError: Weights that are not positive semidefinite or do not fit the arm.
    """
    return Susceptibility(TORQUE, arm, weights)


@checked
def acceleration(arm: Arm, weights: WeightSpec = None) -> Susceptibility:
    """How fast each joint would accelerate as it fails, the others held; English and Maciejewski 1998, eq. (22).

    Armature counts as inertia. Where all the mass that a turning joint carries lies on its axis it is NaN.

    Raises:
        ArmError: A link of which nothing is known or whose inertia no body has, or a joint that carries no mass.
        InputError: Weights that are not positive semidefinite or do not fit the arm; weights named after torques.
    """
    return Susceptibility(ACCELERATION, arm, weights)


@checked
def swing_angle(arm: Arm, weights: WeightSpec = None) -> Susceptibility:
    """How far each turning joint would swing, the others held, until it hangs; English and Maciejewski 1998, eq. (36)-(39).

    In (-pi, pi], joint limits and obstacles ignored. It and its gradient are 0 for a sliding joint, for a balanced one and
    where gravity runs along the axis; near those it changes abruptly, and at pi it is discontinuous.

    Raises:
        ArmError: A link of which nothing is known.
        InputError: Weights that are not positive semidefinite or do not fit the arm; weights named after torques.
    """
    return Susceptibility(SWING_ANGLE, arm, weights)


BY_NAME: dict[str, Callable[..., Susceptibility]] = {
    "torque": torque,
    "acceleration": acceleration,
    "swing-angle": swing_angle,
}
"""The susceptibilities by the names used on the command line and in files."""


@checked
def by_name(name: str, arm: Arm, weights: WeightSpec = None) -> Susceptibility:
    """A susceptibility by name.

    Raises:
        InputError: There is no such measure; the message lists those there are.
    """
    if name not in BY_NAME:
        raise InputError(f"susceptibility '{name}' is not known; use one of {', '.join(BY_NAME)}")
    return BY_NAME[name](arm, weights)


__all__ = [
    "BY_NAME",
    "Evaluation",
    "Formula",
    "JointStatus",
    "Susceptibility",
    "Together",
    "acceleration",
    "by_name",
    "largest_static_torque",
    "swing_angle",
    "torque",
]
