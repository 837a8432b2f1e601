"""``holdfast arms`` and ``holdfast describe``."""

from __future__ import annotations

from holdfast.interface.cli.groups import ArmSourceOptions
from holdfast.interface.cli.options import ArmArgument, JsonOption
from holdfast.interface.presentation.printing import make_console, print_json, to_json_types


def command(json_: JsonOption = False) -> None:
    """List the built-in arms.

    Example: holdfast arms
    """
    from holdfast.interface.presentation.arm.console import list_library_arms, show_library

    if json_:
        print_json(to_json_types(list_library_arms()))
    else:
        show_library(make_console())


def describe(arm: ArmArgument, chain: ArmSourceOptions = ArmSourceOptions(), json_: JsonOption = False) -> None:
    """Print the joints, data problems and single points of failure of an arm.

    Example: holdfast describe panda
    """
    from holdfast.interface.presentation.arm.console import show, to_dict

    model = chain.resolve_arm(arm)
    if json_:
        print_json(to_json_types(to_dict(model)))
    else:
        show(model, make_console())
