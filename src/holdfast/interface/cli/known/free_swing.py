"""``holdfast free-swing``."""

from __future__ import annotations

from typing import Annotated

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions, ContactOptions, OutputOptions
from holdfast.interface.cli.options import ArmArgument, DegreesOption, MotionCsvOption
from holdfast.interface.cli.values import read_configuration, read_joint


def command(
    arm: ArmArgument,
    q: Annotated[str, "Joint values at the failure in rad and m, separated by commas or spaces."],
    joint: Annotated[str, "Free-swinging joint, by name or number from 1."],
    damping: Annotated[
        float | None,
        "Viscous friction in N m s/rad or N s/m. Default: that of the joint, or 10 % of critical if it has almost none.",
    ] = None,
    brake: Annotated[list[float] | None, "Delay of the brake after the failure in ms. Repeatable.", "50, 100 and 200"] = None,
    limits: Annotated[bool, "Stop the joint at its limits (prismatic joints always stop there)."] = False,
    duration: Annotated[
        float | None, "Longest duration in s. Default: until the joint is at rest, at most 60 to 300 s."
    ] = None,
    touched: ContactOptions = ContactOptions(),
    degrees: DegreesOption = False,
    chain: ArmSourceOptions = ArmSourceOptions(),
    csv: MotionCsvOption = None,
    output: OutputOptions = OutputOptions(),
) -> None:
    """Simulate a joint that swings freely under gravity (needs the extra 'physics').

    The command simulates a failed drive. A power loss would free all joints at once, and the tool would drop further. Brakes
    are assumed to stop the joint immediately.

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
