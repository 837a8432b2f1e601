"""Presentation of a comparison of assessments: the candidate that meets the threshold most often, and its worst joints."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

from holdfast.core.formatting import format_as_given, format_count, format_interval, format_percent, indefinite_article
from holdfast.core.probability.intervals import Interval
from holdfast.interface.presentation.assessment.answer import ThresholdAnswer
from holdfast.interface.presentation.assessment.assessment import Thresholds, collect_numbers
from holdfast.interface.presentation.assessment.comparison_figures import build_sections, draw_distributions
from holdfast.interface.presentation.assessment.tables import (
    best_intervals_are_disjoint,
    find_leaders,
    list_gain_cells,
    rank_optimised_upgrades,
)
from holdfast.interface.presentation.collision.shape import describe_cell
from holdfast.interface.presentation.commands import build_command_line, build_region_file_blocks, build_shape_file_blocks
from holdfast.interface.presentation.presentation import (
    Column,
    FigureSpec,
    Header,
    Notice,
    Presentation,
    TableSpec,
    make_headers,
)
from holdfast.interface.report.page import Block, Code, Text
from holdfast.model.arm.model import Arm
from holdfast.model.arms.tool import format_tool_pose
from holdfast.studies.assessment.comparison import Comparison
from holdfast.studies.assessment.upgrade import MAX_REOPTIMISED_POSES

_MAX_UPGRADES = 3  # joints per candidate; its own report has all


def to_dict(comparison: Comparison, thresholds: Thresholds = None, report: Path | None = None) -> dict[str, Any]:
    """Return the assessment of every candidate, and the comparison table, as JSON data."""
    optimised = all(assessment.optimised is not None for assessment in comparison.assessments)
    candidates = zip(comparison.names, comparison.tools, comparison.assessments, strict=True)
    threshold_values = thresholds or [comparison.threshold]
    return {
        "candidates": [
            {"name": name, "tool": tool, **collect_numbers(assessment, threshold_values)}
            for name, tool, assessment in candidates
        ],
        "comparison": {
            "threshold": comparison.threshold,
            "table": comparison.table,
            "ranking": comparison.ranking(),
            "optimised_ranking": comparison.ranking(optimised=True) if optimised else None,
            "notes": comparison.notes,
            "report": None if report is None else str(report),
        },
    }


def present(comparison: Comparison, thresholds: Thresholds = None, report: Path | None = None) -> Presentation:
    """Present the best candidate, the differences between the candidates, their probabilities, and their joints."""
    del thresholds, report  # only the JSON document needs them
    first = ThresholdAnswer(comparison.assessments[0], comparison.threshold)
    unfinished = [name for name, run in zip(comparison.names, comparison.assessments, strict=True) if not run.complete]
    notices = [Notice(" ".join(comparison.notes), title="Before you compare")] if comparison.notes else []
    if unfinished:
        notices.append(Notice("Repeat the command to resume.", "bad", f"Not complete: {', '.join(unfinished)}"))
    region = first.assessment.region
    return Presentation(
        f"Fault tolerance of {len(comparison.names)} candidates",
        _compose_answer(comparison, first),
        about=f"{region.name}: {region.describe()}; worst-case {first.index.name} of "
        f"{format_count(first.distribution.samples, first.noun)} of each candidate",
        notices=notices,
        tables=partial(_build_tables, comparison, first),
        figures={"compare": FigureSpec(partial(draw_distributions, comparison), on_page=False)}
        if _has_values(comparison)
        else {},
        sections=partial(build_sections, comparison) if _has_values(comparison) else tuple,
        method=_list_method(comparison, first),
        again=partial(_build_rerun_blocks, comparison),
    )


def _compose_answer(comparison: Comparison, first: ThresholdAnswer) -> str:
    target = (
        f"{first.index.name} of at {'least' if first.larger_is_better else 'most'} "
        f"{format_as_given(comparison.threshold)}{first.unit_suffix} after any failure considered"
    )
    target = f"{indefinite_article(target)} {target}"
    task_names = list(dict.fromkeys(assessment.index.task.name for assessment in comparison.assessments))
    if len(task_names) > 1:
        task_leaders = [(task, comparison.best(task)) for task in task_names]
        verdicts = [
            f"{task}, {f'{name} with {format_interval(p)}' if (p := comparison.interval(name)).value > 0 else 'none'}"
            for task, name in task_leaders
        ]
        return f"Best candidate of each task, with its probability of keeping {target}: {'; '.join(verdicts)}."
    ranked = comparison.ranking()
    best, runner_up = (comparison.interval(name) for name in ranked[:2])
    if best.value == 0:
        text = f"No candidate keeps {target} at any {first.noun} of the region."
        text += _describe_nearest_candidate(comparison)
    else:
        text = (
            f"{ranked[0]} keeps {target} with the largest probability, {format_interval(best)}; "
            f"next is {ranked[1]} with {format_interval(runner_up)}."
        )
        if runner_up.value < best.value and not best_intervals_are_disjoint(comparison):
            text += f" Their intervals overlap, so the order is not certain; more {first.noun}s give narrower intervals."
    if all(assessment.optimised is not None for assessment in comparison.assessments):
        optimised_leaders = find_leaders(comparison, optimised=True)
        probability = comparison.interval(optimised_leaders[0], optimised=True)
        if probability.value > 0:
            text += (
                f" After optimisation {' and '.join(optimised_leaders)} {'has' if len(optimised_leaders) == 1 else 'have'} the "
                f"largest probability, {format_interval(probability)}."
            )
    return text


def _describe_nearest_candidate(comparison: Comparison) -> str:
    """Name the candidate with the best median where no candidate meets the threshold, and the reason; empty without medians."""
    medians = [
        (row["median"], row["name"], assessment)
        for row, assessment in zip(comparison.table, comparison.assessments, strict=True)
        if row["median"] is not None
    ]
    if not medians:
        return ""
    sign = 1.0 if comparison.assessments[0].index.better == "larger" else -1.0
    _, name, assessment = max(medians, key=lambda entry: sign * entry[0])
    return f" {name} has the best median. {ThresholdAnswer(assessment, comparison.threshold).low_probability_reason}"


def _build_tables(comparison: Comparison, first: ThresholdAnswer) -> Iterator[TableSpec]:
    """Yield the tables of the probabilities, the joints, the gains from protecting joints, and the arms."""
    table, runs = comparison.table, comparison.assessments
    optimised = any(run.optimised is not None for run in runs)
    survival = any(run.survivors is not None for run in runs)
    prefixes = ("", "optimised_")[: 1 + optimised]
    condition = f"P({'≥' if first.larger_is_better else '≤'} {format_as_given(comparison.threshold)})"
    probabilities = [f"{p and 'optimised '}{condition}, 95 % interval" for p in prefixes]
    columns: list[Column] = [
        *("candidate", "task", "redundancy"),
        *make_headers("reached, 95 % interval", *probabilities, style="percent"),
        *[f"{p and 'optimised '}median" for p in prefixes],
        *[Header("reached after a lock", style="percent")] * survival,
    ]
    keys = ["name", "task", "redundancy", "reached", *[f"{p}{key}" for key in ("probability", "median") for p in prefixes]]
    keys += ["expected_survival"] * survival
    title = (
        f"P: fraction of the {format_count(first.distribution.samples, first.noun)} with {first.condition}. Medians: over "
        f"the reached {first.noun}s. Redundancy: joints minus task dimensions"
    )
    title += ". Optimised: at the best configurations" if optimised else ""
    title += ". Reached after a lock: fraction of the poses, if every joint is equally likely to fail" if survival else ""
    yield TableSpec(title, columns, [[_read_cell(row, key) for key in keys] for row in table])
    yield TableSpec(
        "Worst failure: most often the worst one, with the fraction of the reached poses. Single point of failure: a joint "
        "whose lock makes the task singular in every configuration",
        ["candidate", *[f"{p and 'optimised: '}worst failure" for p in prefixes], "single point of failure"],
        [
            [row["name"], *[_format_worst_failure(row, prefix) for prefix in prefixes], _list_single_points(row)]
            for row in table
        ],
    )
    upgrades = _tabulate_upgrades(comparison, first, optimised)
    if upgrades is not None:
        yield upgrades
    detail_rows = [
        [
            *(row["name"], run.arm.name, _format_tool_pose(run.arm)),
            *("not known" if run.index.bound is None else run.index.bound, *[row[f"{p}gap"] for p in prefixes]),
            *(_describe_source(run.arm), run.arm.fingerprint[:10]),
        ]
        for row, run in zip(table, runs, strict=True)
    ]
    gaps = [f"{p and 'optimised: '}gap of the median" for p in prefixes]
    columns = ["candidate", "arm", "tool", *make_headers("bound of the index", *gaps, digits=3), "source", "fingerprint"]
    yield TableSpec(
        "Tool: x, y, z; roll, pitch, yaw as in URDF, in the frame of the last link. Bound: no configuration can exceed it. "
        "Gap: bound (or best known value) minus the median of the reached poses",
        columns,
        detail_rows,
        on_console=False,
    )


def _read_cell(row: dict[str, Any], key: str) -> Any:
    """Return a value of the comparison table, with its interval if there is one."""
    if row[key] is None or f"{key}_low" not in row:
        return "–" if row[key] is None else row[key]
    return Interval(value=row[key], low=row[f"{key}_low"], high=row[f"{key}_high"], confidence=0.95)


def _format_worst_failure(row: dict[str, Any], prefix: str) -> str:
    name, fraction = row[f"{prefix}worst_joint"], row[f"{prefix}worst_fraction"]
    return "none" if name is None else f"{name} ({format_percent(fraction)})"


def _list_single_points(row: dict[str, Any]) -> str:
    names = row["single_points_of_failure"]
    return "every joint" if len(names) == row["joints"] else ", ".join(names) or "none"


def _describe_source(arm: Arm) -> str:
    source = arm.source if len(arm.source) <= 60 else arm.source[:59] + "…"
    return (source or "no source given") + ("" if arm.chain is None else f"; {arm.chain}")


def _format_tool_pose(arm: Arm) -> str:
    x, y, z, *angles = (format_as_given(float(value)) for value in format_tool_pose(arm).split(","))
    return f"{x}, {y}, {z} m; {', '.join(angles)} deg"


def _tabulate_upgrades(comparison: Comparison, first: ThresholdAnswer, optimised: bool) -> TableSpec | None:
    """Tabulate, for each candidate, the joints whose protection from failure gains most."""
    rows: list[list[Any]] = []
    for name, run in zip(comparison.names, comparison.assessments, strict=True):
        ranked = comparison.upgrades(name)[:_MAX_UPGRADES] if run.has_rows else []
        after = {each.joint: each for each in rank_optimised_upgrades(run, comparison.threshold)} if ranked else {}
        for upgrade in ranked:
            cells = [name, upgrade.joint, upgrade.before, *list_gain_cells(upgrade)]
            cells += (list_gain_cells(after[upgrade.joint]) if after else ["–", "–"]) if optimised else []
            rows.append(cells)
    missing = [name for name, run in zip(comparison.names, comparison.assessments, strict=True) if not run.has_rows]
    columns: list[Column] = ["candidate", "protected joint", Header("P without", digits=3)]
    for label in ("P with protection", "after optimisation")[: 1 + optimised]:
        columns += [Header(label, digits=3, aligned=False), "gain, 95 % interval"]
    title = (
        f"P({first.condition}) if one joint never failed: the {_MAX_UPGRADES} joints of each candidate that gain most from a "
        f"redundant motor or brake; the report of each candidate lists all joints"
    )
    if optimised:
        title += (
            f". After optimisation: configurations of up to {MAX_REOPTIMISED_POSES} {first.noun}s, optimised again for the "
            f"remaining failures"
        )
    title += f". Without {', '.join(missing)}, whose {first.noun}s were not stored" if missing else ""
    return TableSpec(title, columns, rows) if rows or missing else None


def _list_method(comparison: Comparison, first: ThresholdAnswer) -> list[tuple[str, str]]:
    runs, run = comparison.assessments, first.assessment
    threshold_reason = "as given"
    if not comparison.chosen:
        bounded = all(candidate.index.bound is not None for candidate in runs)
        middle = "about the middle of the candidates' medians, because this index has no bound"
        threshold_reason = "half of the smallest bound" if bounded else middle
    seeds = sorted({candidate.seed for candidate in runs})
    samples = f"{format_count(first.distribution.samples, first.noun)} of each candidate, {run.sampling}"
    entries = [
        ("Region", f"{run.region.name}: {run.region.describe()}"),
        ("Samples", f"{samples}, seed {', '.join(map(str, seeds))}"),
        (
            "Index",
            f"worst-case {first.index.name}{first.unit_suffix and f', unit{first.unit_suffix}'}; "
            f"{'larger' if first.larger_is_better else 'smaller'} is better",
        ),
        ("Threshold", f"{format_as_given(comparison.threshold)}{first.unit_suffix}: {threshold_reason}"),
        ("Not found", f"a pose without a configuration counts as {'0' if first.larger_is_better else 'infinite'}"),
        ("Intervals", "95 %: Clopper-Pearson (exact) for a probability, Dvoretzky-Kiefer-Wolfowitz for a whole CDF"),
        (
            "Ranking",
            "by the probability of meeting the threshold at the configurations found by inverse kinematics; then by the median",
        ),
        (
            "Gain of a joint",
            "the worst case is taken over the failures of the other joints, at the same configurations; the intervals are "
            f"paired, because a gain is the fraction of the {first.noun}s that miss the threshold only without the protection",
        ),
    ]
    if len(seeds) == 1 and len({candidate.sampling for candidate in runs}) == 1:
        entries.append(("Same poses", "every candidate was evaluated at the same poses of the region"))
    cell_texts = {each.plan.cell.digest: describe_cell(each.plan.cell) for each in runs if each.plan.cell is not None}
    if cell_texts:
        entries.append(("Cell", "; ".join(cell_texts.values())))
    models = [
        f"{name}: {each.plan.clearance.capsules.describe(each.arm)}"
        for name, each in zip(comparison.names, runs, strict=True)
        if each.plan.clearance
    ]
    if models and any(candidate.optimised is not None for candidate in runs):
        avoided = f"itself{' and the cell' * bool(cell_texts)}"
        text = f"best configurations do not bring the arm into collision with {avoided}, by capsules ({'; '.join(models)})"
        entries.append(("Clearance", text))
    return entries


def _has_values(comparison: Comparison) -> bool:
    """Return whether some index of some candidate is finite."""
    return any(
        run.distribution_of(optimised).reached > run.distribution_of(optimised).infinite
        for run in comparison.assessments
        for optimised in (False, True)[: 1 + (run.optimised is not None)]
    )


def _build_rerun_blocks(comparison: Comparison) -> list[Block]:
    """Build the command of each candidate, and the files that the commands need."""
    blocks: list[Block] = []
    for name, assessment in zip(comparison.names, comparison.assessments, strict=True):
        command, remark = build_command_line(assessment)
        blocks.append(
            Text(f"{name}: {remark}") if command is None else Code(command, f"Only {name}{f' ({remark})' if remark else ''}:")
        )
        blocks += build_shape_file_blocks(assessment)
    region = comparison.assessments[0].region
    return [*blocks, *(build_region_file_blocks(region) if region.storable else [])]
