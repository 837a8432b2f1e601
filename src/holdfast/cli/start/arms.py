"""``holdfast arms`` and ``holdfast describe``."""

from __future__ import annotations

from holdfast.cli.options import ArmArgument, BaseOption, HoldOption, JsonOption, TipOption, read_arm
from holdfast.present.printing import console, plain, print_json


def command(json_: JsonOption = False) -> None:
    """List the built-in arms.

    Example: holdfast arms
    """
    from holdfast.present.arm.console import library, show_library

    if json_:
        print_json(plain(library()))
    else:
        show_library(console())


def describe(
    arm: ArmArgument, base: BaseOption = None, tip: TipOption = None, hold: HoldOption = None, json_: JsonOption = False
) -> None:
    """Show an arm, problems in its data, and which joints are single points of failure by structure.

    Example: holdfast describe pa10-7dof
    """
    from holdfast.present.arm.console import show, to_dict

    model = read_arm(arm, base, tip, hold)
    if json_:
        print_json(plain(to_dict(model)))
    else:
        show(model, console())
