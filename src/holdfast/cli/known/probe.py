"""``holdfast probe``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.groups import Chain, Output
from holdfast.cli.options import NOT_MET, ArmArgument, SeedOption, TaskOption
from holdfast.cli.values import read_configuration, read_joint, read_task
from holdfast.errors import InputError
from holdfast.present.results import printed


def command(
    arm: ArmArgument,
    at: Annotated[str | None, "Current joint values, rad and m, by commas or spaces."] = None,
    degrees: Annotated[bool, "--at is in degrees (prismatic joints stay in m)."] = False,
    suspects: Annotated[str | None, "Joints that may be locked, by commas. Default: all."] = None,
    record: Annotated[Path | None, "Decide: a record of the motion with the tool's pose (.npz, .csv)."] = None,
    task: TaskOption = None,
    duration: Annotated[float, "Of each leg, at most, s."] = 5.0,
    speed: Annotated[float, "Norm of the joint rates, rad/s and m/s."] = 0.25,
    seed: SeedOption = 0,
    chain: Chain = Chain(),
    csv: Annotated[Path | None, "Write the motion to this file."] = None,
    output: Output = Output(),
) -> None:
    """Plan a self-motion that identifies a locked joint, or evaluate its log.

    What it can tell apart and what not is printed before anything moves. With --record: exit code 0 if none of the suspects is
    locked, 3 otherwise.

    Example: holdfast probe panda --at "0 -0.4 0.3 -2 0.2 1.8 0.5" --csv probe.csv
    """
    model = chain.arm(arm)
    chosen = None if suspects is None else [read_joint(model, text) for text in suspects.split(",")]
    if (at is None) == (record is None):
        raise InputError("give --at to plan, or --record to decide, one of them")
    if record is not None:
        finding = hf.diagnosis.decide(model, hf.faults.Log.load(record), suspects=chosen)
        printed(finding, output.json_)
        if finding.remaining != ("none",):
            raise typer.Exit(NOT_MET)
        return
    found = hf.diagnosis.plan_probe(
        model,
        read_configuration(model, str(at), degrees, "--at"),
        suspects=chosen,
        task=read_task(task, arm, model),
        duration=duration,
        speed=speed,
        seed=seed,
    )
    output.printed(found, [] if csv is None else [found.to_csv(csv)])
