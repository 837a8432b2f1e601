"""``holdfast identify``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.interface.cli.groups import ArmSourceOptions, OutputOptions
from holdfast.interface.cli.options import AT_HELP, NOT_MET_EXIT_CODE, ArmArgument, AtDegreesOption, SeedOption, TaskOption
from holdfast.interface.cli.values import read_configuration, read_joint, read_task
from holdfast.interface.presentation.results import print_result


def command(
    arm: ArmArgument,
    at: Annotated[str | None, f"{AT_HELP} Required without --record."] = None,
    degrees: AtDegreesOption = False,
    suspects: Annotated[str | None, "Candidate joints, by name or number, comma-separated. Default: all."] = None,
    record: Annotated[Path | None, "Log (.npz, .csv) of the executed motion with the tool pose, to evaluate."] = None,
    task: TaskOption = None,
    duration: Annotated[float, "Longest duration in s of each of the up to three parts of the motion."] = 5.0,
    speed: Annotated[float, "Norm of the joint rates in rad/s and m/s."] = 0.25,
    seed: SeedOption = 0,
    chain: ArmSourceOptions = ArmSourceOptions(),
    csv: Annotated[Path | None, "CSV file for the motion."] = None,
    output: OutputOptions = OutputOptions(),
) -> None:
    """Plan a self-motion that identifies a locked joint, or evaluate its log.

    Before anything moves, the command prints which candidate joints the motion can distinguish. With --record, the exit code is
    0 if none of the candidates is locked, else 3.

    Example: holdfast identify panda --at "0 -0.4 0.3 -2 0.2 1.8 0.5" --csv probe.csv
    """
    model = chain.resolve_arm(arm)
    candidate_joints = None if suspects is None else [read_joint(model, text) for text in suspects.split(",")]
    if (at is None) == (record is None):
        raise InputError("give either --at, to plan a motion, or --record, to evaluate its log")
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
