"""``holdfast assess`` and ``holdfast report``."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from holdfast.core.errors import InputError, StoreError
from holdfast.core.files import reading
from holdfast.interface.cli.declaration import FigurePath
from holdfast.interface.cli.groups import ArmsArgument, ArmSourcesOptions, ClearanceOptions
from holdfast.interface.cli.measure_options import IndexOption
from holdfast.interface.cli.options import (
    TASK_HELP,
    FailuresOption,
    JsonOption,
    LengthOption,
    RegionOption,
    SeedOption,
    ThreadsOption,
)
from holdfast.interface.cli.progress import ProgressBar
from holdfast.interface.cli.start.candidates import TOOL_HELP, read_candidates
from holdfast.interface.cli.values import read_failures, read_numbers_by_joint, read_task
from holdfast.interface.presentation.printing import make_console
from holdfast.interface.presentation.results import print_result

if TYPE_CHECKING:
    from holdfast.core.result import Result
    from holdfast.kinematics.regions.region import Region
    from holdfast.model.arm.model import Arm

FailureRateOption = Annotated[
    list[str] | None,
    "Relative failure rate JOINT=RATE, to average the poses reachable after a lock. Default: no average. Repeatable.",
]
AtLeastOption = Annotated[
    list[float] | None,
    "Estimate the probability that the index is at least this value. Default: half of its bound, or its median. Repeatable.",
]


def command(
    arm: ArmsArgument,
    region: RegionOption = None,
    index: IndexOption = "relative-manipulability",
    task: Annotated[list[str] | None, f"{TASK_HELP} Repeatable, to compare tasks."] = None,
    tool: Annotated[list[str] | None, TOOL_HELP] = None,
    failures: FailuresOption = "single",
    length: LengthOption = 1.0,
    poses: Annotated[int | None, "Number of poses. Default: 2000; each pose once if the region lists poses."] = None,
    seed: SeedOption = 0,
    sampling: Annotated[str, "Sampling of the region: random or sobol (scrambled Sobol points)."] = "random",
    restarts: Annotated[int, "Number of random starts per pose before it counts as not found."] = 100,
    optimise: Annotated[bool, "Also find the best configuration of each pose."] = False,
    after_lock: Annotated[bool, "Also find poses reachable after a lock of each joint at its value in another pose."] = False,
    lock: Annotated[
        list[str] | None, "Value at which a joint locks, JOINT=VALUE in rad or m; implies its --after-lock. Repeatable."
    ] = None,
    failure_rate: FailureRateOption = None,
    apart: ClearanceOptions = ClearanceOptions(),
    at_least: AtLeastOption = None,
    out: Annotated[FigurePath, "Folder for results and report; the same command resumes a stopped run."] = None,
    threads: ThreadsOption = None,
    chains: ArmSourcesOptions = ArmSourcesOptions(),
    json_: JsonOption = False,
) -> None:
    """Estimate how likely an arm is to keep its dexterity when any one joint locks.

    Several arms, tools or tasks are compared in every combination, over one region and in one report. To compare the control
    laws of one arm, use 'holdfast compare-laws'.

    Example: holdfast assess pa10-9dof --poses 2000 --seed 1 --out results

    Example: holdfast assess panda iiwa14 --task pose --task position --region cell.yaml --out results
    """
    from holdfast.kernels.threads import set_threads
    from holdfast.kinematics.indices.index import by_name
    from holdfast.studies.assessment.comparison import compare_assessments
    from holdfast.studies.assessment.plan import make_plan
    from holdfast.studies.assessment.run import assess
    from holdfast.studies.assessment.single_points import explain, structure, structures

    threshold = _read_report_threshold(at_least)
    apart.check_consistency()
    if threads is not None:
        set_threads(threads)
    candidates = read_candidates(chains.resolve_arms(arm), tool or [], task or [])
    is_comparison = len(candidates) > 1
    first_candidate = candidates[0]
    common_region = read_region(region, first_candidate.spec, first_candidate.arm)
    if is_comparison and failure_rate:
        raise InputError(
            f"--failure-rate applies to one arm and there are {len(candidates)} candidates; assess each alone, or leave it out "
            "(a comparison weights all joints equally)"
        )
    if apart.capsules is not None and len(arm) > 1:
        raise InputError(f"--capsules describes one arm and there are {len(arm)}; assess each with its own, or give --radius")
    rates = _read_rates(first_candidate.arm, failure_rate, after_lock, lock)
    planned_runs = []
    for candidate in candidates:
        measure = by_name(
            index,
            candidate.arm,
            read_task(candidate.task, candidate.spec, candidate.arm),
            failures=read_failures(candidate.arm, failures),
            length=length,
        )
        options: dict[str, Any] = {
            "poses": poses,
            "seed": seed,
            "sampling": sampling,
            "restarts": restarts,
            "optimise": optimise,
            "after_lock": after_lock,
            "locked": read_numbers_by_joint(candidate.arm, lock, "--lock"),
            "clearance": apart.build_clearance(candidate.arm, chooses_configurations=optimise or apart.cell is not None)
            or False,
            "margin": apart.margin or 0.0,
        }
        if is_comparison:  # raises for a candidate that cannot run, before the first one takes its time
            make_plan(candidate.arm, common_region, measure, **options)
        planned_runs.append((measure, options))
    if is_comparison and out is not None and reading.path_exists(out / "run.json"):
        raise StoreError(f"'{out}' contains a single run; give another folder for the comparison")
    if is_comparison and region is None:
        make_console(stderr=True).print(
            f"--region is not given, so every candidate is assessed in the default region of '{first_candidate.name}'",
            markup=False,
            soft_wrap=True,
        )
    assessments = []
    for candidate, (measure, options) in zip(candidates, planned_runs, strict=True):
        if not json_:
            survival = structure(candidate.arm, measure.task)
            if not survival.survives or survival.weak:
                make_console(stderr=True).print(
                    explain(candidate.arm, survival, structures(candidate.arm)), markup=False, soft_wrap=True
                )
        store = out / candidate.name if out is not None and is_comparison else out
        with ProgressBar(json_, candidate.name if is_comparison else "poses") as progress:
            assessments.append(assess(candidate.arm, common_region, measure, store=store, progress=progress, **options))
    if is_comparison:
        comparison = compare_assessments(
            assessments,
            [candidate.name for candidate in candidates],
            threshold,
            tools=[candidate.tool for candidate in candidates],
        )
        files = [] if out is None else comparison.save(out)
        _print_with_report(comparison, json_, files, thresholds=at_least)
    else:
        files = [] if out is None else assessments[0].save(out, threshold)
        _print_with_report(assessments[0], json_, files, thresholds=at_least, rates=rates)


def report(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="Folder that 'holdfast assess --out' wrote.")],
    to: Annotated[Path | None, "HTML file for the report. Default: DIR/report.html."] = None,
    at_least: AtLeastOption = None,
    failure_rate: FailureRateOption = None,
    json_: JsonOption = False,
) -> None:
    """Rebuild the report of a results folder.

    Example: holdfast report results
    """
    from holdfast.studies.assessment.comparison import COMPARISON_FILE, load_comparison
    from holdfast.studies.assessment.run import load

    threshold = _read_report_threshold(at_least)
    page = to or folder / "report.html"
    if not reading.path_exists(folder / "run.json") and reading.path_exists(folder / COMPARISON_FILE):
        if failure_rate:
            raise InputError(f"'{folder}' contains a comparison; give --failure-rate with the folder of one candidate in it")
        comparison = load_comparison(folder, threshold)
        _print_with_report(comparison, json_, [comparison.report(page)], thresholds=at_least)
        return
    assessment = load(folder)
    rates = read_numbers_by_joint(assessment.arm, failure_rate, "--failure-rate")
    if rates and assessment.distribution.samples:
        assessment.expected_survival(rates)  # before anything is written
    _print_with_report(assessment, json_, [assessment.report(page, threshold)], thresholds=at_least, rates=rates)


def _print_with_report(result: Result, json_: bool, files: list[Path], **options: Any) -> None:
    """Print a result with the path of its report, the last of the files."""
    page = files[-1] if files else None
    print_result(result, json_, [page], report=page, **options)


def _read_rates(arm: Arm, failure_rate: list[str] | None, after_lock: bool, lock: list[str] | None) -> dict[str | int, float]:
    """Read ``--failure-rate``, which needs a lock of each of its joints."""
    from holdfast.studies.assessment.upgrade import check_failure_rates

    rates = read_numbers_by_joint(arm, failure_rate, "--failure-rate")
    locks = read_numbers_by_joint(arm, lock, "--lock") if rates else {}
    if rates:
        check_failure_rates(arm, rates)
    for name in rates:
        if not after_lock and name not in locks:
            raise InputError(f"--failure-rate of '{name}' needs its lock; add --after-lock, or --lock {name}=VALUE")
    return rates


def _read_report_threshold(at_least: list[float] | None) -> float | None:
    """Return the first --at-least, the threshold of the reports; nan raises before any work is done."""
    if any(math.isnan(threshold) for threshold in at_least or []):
        raise InputError("--at-least is nan; give a number")
    return at_least[0] if at_least else None


def read_region(path: Path | None, spec: str, arm: Arm) -> Region:
    """Read ``--region``, or return a region around the arm's home; the arm of Abdi et al. gets their region."""
    from holdfast.kinematics.regions.region import Region, default_region

    return default_region(arm, spec) if path is None else Region.load(path)
