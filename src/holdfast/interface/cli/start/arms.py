"""``holdfast arms`` and ``holdfast describe``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from holdfast.core.errors import InputError
from holdfast.interface.cli.groups import ArmSourceOptions
from holdfast.interface.cli.options import ArmArgument, DegreesOption, JsonOption
from holdfast.interface.cli.values import read_configuration, read_joint
from holdfast.interface.presentation.printing import make_console, print_json, print_written_files, to_json_types


def command(json_: JsonOption = False) -> None:
    """List the built-in arms.

    Example: holdfast arms
    """
    from holdfast.interface.presentation.arm.console import list_library_arms, show_library

    if json_:
        print_json(to_json_types(list_library_arms()))
    else:
        show_library(make_console())


def describe(
    arm: ArmArgument,
    chain: ArmSourceOptions = ArmSourceOptions(),
    view: Annotated[Path | None, "HTML file for a 3-D view of the arm with a slider per joint."] = None,
    q: Annotated[str | None, "Joint values in --view, rad and m. Default: a generic configuration."] = None,
    degrees: DegreesOption = False,
    lock: Annotated[list[str] | None, "Locked joint in --view, by name or number from 1. Repeatable."] = None,
    json_: JsonOption = False,
) -> None:
    """Print the joints, data problems and single points of failure of an arm.

    Example: holdfast describe panda --view panda.html --lock 4
    """
    from holdfast.interface.presentation.arm.console import show, to_dict

    model = chain.resolve_arm(arm)
    written = None
    if view is not None:
        configuration = None if q is None else read_configuration(model, q, degrees)
        written = model.show(configuration, locked=[read_joint(model, name) for name in lock or []]).save(view)
    elif q is not None or lock:
        raise InputError("--q and --lock need --view FILE, the page that shows them; add it")
    if json_:
        print_json(to_json_types(to_dict(model) | ({} if written is None else {"files": [str(written)]})))
    else:
        show(model, make_console())
        print_written_files(make_console(), [written])
