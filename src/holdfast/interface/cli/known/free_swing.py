"""``holdfast free-swing``."""

from __future__ import annotations

from typing import Annotated

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions, ContactOptions, OutputOptions
from holdfast.interface.cli.options import ArmArgument, DegreesOption, MotionCsvOption
from holdfast.interface.cli.values import read_configuration, read_joint


def command(
    arm: ArmArgument,
    q: Annotated[str, "Joint values, rad and m, separated by commas or spaces."],
    joint: Annotated[str, "The joint that swings free, by name or number from 1."],
    damping: Annotated[
        float | None,
        "Viscous friction, N m s/rad or N s/m. Default: the joint's own, or 10 % of critical if it has next to none.",
    ] = None,
    brake: Annotated[list[float] | None, "Brakes engage after so many ms. May be given again.", "50, 100 and 200"] = None,
    limits: Annotated[bool, "The joint's limits stop it (those of prismatic joints always do)."] = False,
    duration: Annotated[float | None, "Longest time, s. Default: until it is at rest."] = None,
    touched: ContactOptions = ContactOptions(),
    degrees: DegreesOption = False,
    chain: ArmSourceOptions = ArmSourceOptions(),
    csv: MotionCsvOption = None,
    output: OutputOptions = OutputOptions(),
) -> None:
    """Simulate a joint that swings freely under gravity (needs the extra 'physics').

    This is a failed drive, not a power loss: a power loss frees all joints at once, and the tool drops further.
    Brakes are assumed to stop the joint at once.

    Example: holdfast free-swing panda --q "0 -45 0 -135 0 90 45" --degrees --joint 4 --brake 50 --brake 100
    """
    from holdfast.control.physics.swing import DEFAULT_BRAKE_TIMES_MS

    model = chain.resolve_arm(arm)
    swing = hf.free_swing(
        model,
        read_configuration(model, q, degrees),
        read_joint(model, joint),
        damping=damping,
        duration=duration,
        brake_after=tuple(brake) if brake else DEFAULT_BRAKE_TIMES_MS,
        limits=limits,
        clearance=touched.build_contact_clearance(model),
    )
    output.print_result(swing, [] if csv is None else [swing.to_csv(csv)])
