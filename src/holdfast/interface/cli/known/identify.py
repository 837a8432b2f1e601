"""``holdfast identify``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.interface.cli.groups import ArmSourceOptions, OutputOptions
from holdfast.interface.cli.options import NOT_MET_EXIT_CODE, ArmArgument, SeedOption, TaskOption
from holdfast.interface.cli.values import read_configuration, read_joint, read_task
from holdfast.interface.presentation.results import print_result


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
    chain: ArmSourceOptions = ArmSourceOptions(),
    csv: Annotated[Path | None, "Write the motion to this file."] = None,
    output: OutputOptions = OutputOptions(),
) -> None:
    """Plan a self-motion that identifies a locked joint, or evaluate its log.

    What it can tell apart and what not is printed before anything moves. With --record: exit code 0 if none of the suspects is
    locked, 3 otherwise.

    Example: holdfast identify panda --at "0 -0.4 0.3 -2 0.2 1.8 0.5" --csv probe.csv
    """
    model = chain.resolve_arm(arm)
    candidate_joints = None if suspects is None else [read_joint(model, text) for text in suspects.split(",")]
    if (at is None) == (record is None):
        raise InputError("give --at to plan, or --record to decide, one of them")
    if record is not None:
        finding = hf.diagnosis.identify(model, hf.faults.Log.load(record), suspects=candidate_joints)
        print_result(finding, output.json_)
        if finding.remaining != ("none",):
            raise typer.Exit(NOT_MET_EXIT_CODE)
        return
    probe_motion = hf.diagnosis.plan_identification(
        model,
        read_configuration(model, str(at), degrees, "--at"),
        suspects=candidate_joints,
        task=read_task(task, arm, model),
        duration=duration,
        speed=speed,
        seed=seed,
    )
    output.print_result(probe_motion, [] if csv is None else [probe_motion.to_csv(csv)])
