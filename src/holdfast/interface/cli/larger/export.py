"""``holdfast export``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.interface.cli.laws import LawOptions
from holdfast.interface.cli.options import ArmArgument, JsonOption
from holdfast.interface.presentation.results import print_result

EXPORT_LANGUAGES = ("c",)


def command(
    arm: ArmArgument,
    out: Annotated[Path, "Folder for the files; it is created if necessary."],
    controlled: LawOptions = LawOptions(law="failure-tolerant"),
    language: Annotated[str, "Language: c, which is C99 that needs only math.h."] = "c",
    name: Annotated[str | None, "Name of the function and the files. Default: that of the law."] = None,
    monitor: Annotated[Path | None, "Threshold file of 'holdfast calibrate'; also exports the monitor NAME_monitor."] = None,
    controller: Annotated[bool, "Export the C++17 controller NAME_controller, which reacts to the monitor."] = False,
    json_: JsonOption = False,
) -> None:
    """Export a control law, monitor or controller as C or C++ code.

    Example: holdfast export panda --law failure-tolerant --language c --out controller
    """
    if language not in EXPORT_LANGUAGES:
        raise InputError(f"--language '{language}' is not known; use {', '.join(EXPORT_LANGUAGES)}")
    if controller and monitor is None:
        raise InputError("--controller needs a monitor; add --monitor BOUNDS, a file of 'holdfast calibrate'")
    control_law = controlled.read_law(arm)
    files = control_law.export_c(out, name)
    monitor_files: list[Path] = []
    if monitor is not None:
        bounds, stem = hf.diagnosis.load(monitor), files.source.stem
        if controller:
            monitor_files += hf.supervisor.export_controller(control_law, bounds, out, name=f"{stem}_controller")
        else:
            monitor_files += hf.diagnosis.export_c(control_law.arm, bounds, out, name=f"{stem}_monitor")
    print_result(files, json_, monitor_files, listed=monitor is not None)
