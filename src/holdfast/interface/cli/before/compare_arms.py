"""``holdfast compare-arms``."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import holdfast as hf
from holdfast.interface.cli.groups import ArmsArgument, ArmSourcesOptions
from holdfast.interface.cli.options import FailuresOption, JsonOption, PageOption, RegionOption, SeedOption, TaskOption
from holdfast.interface.cli.start.candidates import read_candidates
from holdfast.interface.cli.values import read_failures, read_task
from holdfast.interface.presentation.results import print_result, write_outputs


def command(
    arm: ArmsArgument,
    region: RegionOption = None,
    task: TaskOption = None,
    failures: FailuresOption = "single",
    measures: Annotated[
        list[str] | None,
        "Measure: quantile, fraction-above, self-motion-size or tolerant-workspace. Repeatable. Default: all that are defined "
        "for the arms.",
    ] = None,
    level: Annotated[float, "Fraction of the poses that have at least the value of quantile or self-motion-size."] = 0.95,
    thresholds: Annotated[list[float] | None, "Threshold of fraction-above. Repeatable. Default: 0.05, 0.1, 0.2, 0.3."] = None,
    poses: Annotated[int, "Number of poses sampled from the region."] = 100,
    samples: Annotated[int, "Number of configurations sampled per arm."] = 20_000,
    points: Annotated[int, "Number of points of a tolerant workspace, if it must be sampled."] = 300,
    best_limits: Annotated[bool, "Search for the artificial joint limits with the largest tolerant workspace."] = False,
    seed: SeedOption = 0,
    chains: ArmSourcesOptions = ArmSourcesOptions(),
    out: PageOption = None,
    json_: JsonOption = False,
) -> None:
    """Compare arms by global fault-tolerance measures, with confidence intervals.

    The measures cover the whole arm, because the index at one configuration does not characterise the rest.

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
