"""``holdfast susceptibility``."""

from __future__ import annotations

from typing import Annotated

from holdfast.core.registry import SUSCEPTIBILITY_REGISTRY
from holdfast.interface.cli.groups import ArmSourceOptions, MountingOptions
from holdfast.interface.cli.options import ArmArgument, DegreesOption, JsonOption, QOption
from holdfast.interface.cli.values import read_configuration, read_weights
from holdfast.interface.presentation.printing import print_evaluations


def command(
    arm: ArmArgument,
    q: QOption,
    measure: Annotated[str, f"{SUSCEPTIBILITY_REGISTRY.usage}."] = "torque",
    weights: Annotated[
        str | None,
        "effort, worst-case, one number per joint as 1,2,3, or a CSV file of them or of a square matrix. "
        "Default: all joints alike.",
    ] = None,
    placement: MountingOptions = MountingOptions(),
    degrees: DegreesOption = False,
    chain: ArmSourceOptions = ArmSourceOptions(),
    json_: JsonOption = False,
) -> None:
    """Compute how strongly each joint would react to losing its torque.

    Example: holdfast susceptibility panda --measure swing-angle --q "0 -45 0 -135 0 90 45" --degrees --mount wall
    """
    from holdfast.interface.presentation.indices.console import show_susceptibility, susceptibility_values
    from holdfast.kinematics.indices.susceptibility.measure import by_name

    model = placement.mount_arm(chain.resolve_arm(arm))
    configurations = [read_configuration(model, text, degrees) for text in q]
    chosen = by_name(measure, model, None if weights is None else read_weights("--weights", weights))
    print_evaluations(chosen, configurations, json_, susceptibility_values, show_susceptibility)
