"""``holdfast certify path``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.certify_options import CertificateOption, CheckOption, ReportOption, StoreOption, TimeOption, WorkersOption
from holdfast.cli.certify_search import proved
from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    FailuresOption,
    HoldOption,
    JsonOption,
    PlotOption,
    TipOption,
    read_arm,
    read_numbers,
)
from holdfast.errors import InputError
from holdfast.failures.sets import read_failures


def path(
    arm: ArmArgument,
    motion: Annotated[
        Path, typer.Argument(metavar="MOTION", help="CSV file with a column for each joint.", show_default=False)
    ],
    failures: FailuresOption = "single",
    during: Annotated[str, typer.Option("--during", help="When a joint may lock: two parts of the motion.")] = "0 1",
    tube: Annotated[
        str,
        typer.Option("--tube", help="How far off the path may be, m, and rad where the tool turns; or one number for both."),
    ] = "0",
    task: Annotated[
        str, typer.Option("--task", help="What follows the path: pose, position, pointing, planar or planar-pose.")
    ] = "pose",
    segments: Annotated[
        int | None, typer.Option("--segments", help="Use so many of the motion. Default: all.", show_default=False)
    ] = None,
    halvings: Annotated[int, typer.Option("--halvings", help="Of intervals of lock instants, at most.")] = 6,
    time_limit: TimeOption = None,
    workers: WorkersOption = 1,
    store: StoreOption = None,
    check: CheckOption = True,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    out: CertificateOption = Path("path.certificate"),
    plot: PlotOption = None,
    report: ReportOption = None,
    json_: JsonOption = False,
) -> None:
    """Prove that whatever joint locks, and whenever, one continuous motion finishes the path of the tool.

    The motion is a table of the healthy arm's configurations, such as follow writes; between them joints move along straight
    lines. The exit code is 0 if all is proved, 3 if something is undecided, 4 if something is refuted, 1 if the check rejects
    something. Ctrl-C writes what is found so far; with --store the same command resumes.

    Example: holdfast certify path planar-3r motion.csv --task planar --tube 0.0005
    """
    from holdfast.paths.joint_table import joint_columns, read_joint_table

    model, when = read_arm(arm, base, tip, hold), read_numbers("--during", during, "two numbers from 0 to 1")
    if when.size != 2:
        raise InputError("--during takes two parts of the motion, for example --during '0 0.5'")
    claim = hf.certificates.path_claim(
        model,
        read_joint_table(model, motion, "motion", "time_s").numbers(joint_columns(model)),
        failures=read_failures(model, failures),
        during=tuple(when.tolist()),
        tube=read_numbers("--tube", tube, "one number or two, m and rad,"),
        task=task,
        segments=segments,
    )
    how = {"halvings": halvings, "time_limit": time_limit, "workers": workers, "store": store}
    proved(claim, out, check, json_, plot, report, **how)
