"""``holdfast export``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import holdfast as hf
from holdfast.cli.groups import Chain
from holdfast.cli.laws import LawOption, law_of
from holdfast.cli.options import ArmArgument, JsonOption, TaskOption
from holdfast.errors import InputError
from holdfast.present.results import printed

LANGUAGES = ("c",)


def command(
    arm: ArmArgument,
    out: Annotated[Path, "Folder for the files; made if it is not there."],
    law: LawOption = "failure-tolerant",
    language: Annotated[str, "c: C99 that needs only math.h."] = "c",
    name: Annotated[str | None, "Name of the function and the files. Default: the law's."] = None,
    task: TaskOption = None,
    monitor: Annotated[Path | None, "Bounds of calibrate: also a monitor of joint faults, NAME_monitor."] = None,
    controller: Annotated[bool, "With --monitor: also a controller in C++17 that reacts to it, NAME_controller."] = False,
    chain: Chain = Chain(),
    json_: JsonOption = False,
) -> None:
    """Export a control law, monitor or controller as C or C++ code.

    Example: holdfast export panda --law failure-tolerant --language c --out controller
    """
    if language not in LANGUAGES:
        raise InputError(f"--language '{language}' is not known; use {', '.join(LANGUAGES)}")
    if controller and monitor is None:
        raise InputError("--controller needs --monitor BOUNDS, which 'holdfast calibrate' makes")
    chosen = law_of(law, arm, task, chain)
    files = chosen.export_c(out, name)
    watching: list[Path] = []
    if monitor is not None:
        bounds, stem = hf.diagnosis.load(monitor), files.source.stem
        if controller:
            watching += hf.reaction.export_controller(chosen, bounds, out, name=f"{stem}_controller")
        else:
            watching += hf.diagnosis.export_c(chosen.arm, bounds, out, name=f"{stem}_monitor")
    printed(files, json_, watching, listed=monitor is not None)
