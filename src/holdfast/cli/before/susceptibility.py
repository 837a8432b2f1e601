"""``holdfast susceptibility``."""

from __future__ import annotations

from typing import Annotated

from holdfast.cli.groups import Chain, Placement
from holdfast.cli.options import ArmArgument, DegreesOption, JsonOption, QOption
from holdfast.cli.values import read_configuration, read_weights
from holdfast.present.printing import print_each
from holdfast.registry import SUSCEPTIBILITIES


def command(
    arm: ArmArgument,
    q: QOption,
    measure: Annotated[str, f"{SUSCEPTIBILITIES.usage}."] = "torque",
    weights: Annotated[
        str | None,
        "effort, worst-case, one number per joint as 1,2,3, or a CSV file of them or of a square matrix. "
        "Default: all joints alike.",
    ] = None,
    placement: Placement = Placement(),
    degrees: DegreesOption = False,
    chain: Chain = Chain(),
    json_: JsonOption = False,
) -> None:
    """Compute how strongly each joint would react to losing its torque.

    Example: holdfast susceptibility panda --measure swing-angle --q "0 -45 0 -135 0 90 45" --degrees --mount wall
    """
    from holdfast.indices.susceptibility.measure import by_name
    from holdfast.present.indices.console import show_susceptibility, susceptibility_values

    model = placement.of(chain.arm(arm))
    configurations = [read_configuration(model, text, degrees) for text in q]
    chosen = by_name(measure, model, None if weights is None else read_weights("--weights", weights))
    print_each(chosen, configurations, json_, susceptibility_values, show_susceptibility)
