"""``holdfast compare-arms``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourcesOptions
from holdfast.interface.cli.options import FailuresOption, JsonOption, OutOption, SeedOption, TaskOption
from holdfast.interface.cli.start.candidates import read_candidates
from holdfast.interface.cli.values import read_failures, read_task
from holdfast.interface.presentation.results import print_result, write_outputs


def command(
    arm: Annotated[
        list[str], typer.Argument(metavar="ARM...", help="Built-in name, URDF file, or DH table (YAML); several side by side.")
    ],
    region: Annotated[Path | None, "Region file (YAML). Default: around the home of the first arm."] = None,
    task: TaskOption = None,
    failures: FailuresOption = "single",
    measures: Annotated[
        list[str] | None,
        "quantile, fraction-above, self-motion-size or tolerant-workspace; may be given again. Default: all that the "
        "arms have.",
    ] = None,
    level: Annotated[float, "Fraction of the poses that have at least a quantile."] = 0.95,
    thresholds: Annotated[list[float] | None, "For fraction-above; may be given again. Default: 0.05, 0.1, 0.2, 0.3."] = None,
    poses: Annotated[int, "Poses of the region."] = 100,
    samples: Annotated[int, "Configurations of each arm."] = 20_000,
    points: Annotated[int, "Points of a workspace, where it is sampled."] = 300,
    best_limits: Annotated[bool, "Look for the artificial limits of the largest tolerant workspace."] = False,
    seed: SeedOption = 0,
    chains: ArmSourcesOptions = ArmSourcesOptions(),
    out: OutOption = None,
    json_: JsonOption = False,
) -> None:
    """Compare arms by global fault-tolerance measures, with confidence intervals.

    An index at one configuration says little about the rest of an arm.

    Example: holdfast compare-arms panda xarm7 --measures fraction-above
    """
    candidates = read_candidates(chains.resolve_arms(arm), [], [] if task is None else [task])
    first = candidates[0]
    comparison = hf.designs.compare_arms(
        [replace(candidate.arm, name=candidate.name) for candidate in candidates],
        None if region is None else hf.Region.load(region),
        task=read_task(first.task, first.spec, first.arm),
        failures=read_failures(first.arm, failures),
        measures=measures or None,
        level=level,
        thresholds=thresholds or (0.05, 0.1, 0.2, 0.3),
        poses=poses,
        samples=samples,
        points=points,
        best_limits=best_limits,
        seed=seed,
    )
    print_result(comparison, json_, write_outputs(comparison, None, out))
