"""HTML report of a comparison: one file that begins with the table of the candidates."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.core.formatting import (
    format_as_given,
    format_count,
    format_decimals,
    format_half_width,
    format_interval,
    format_number,
    format_percent,
    indefinite_article,
)
from holdfast.core.progress import reports_progress
from holdfast.interface.presentation.assessment import thresholds
from holdfast.interface.presentation.assessment.console import rank_optimised_upgrades
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.presentation.assessment.sections.upgrades import format_gain
from holdfast.interface.presentation.collision.shape import describe_cell
from holdfast.interface.presentation.commands import build_command_line, build_region_file_blocks, build_shape_file_blocks
from holdfast.interface.report import figures as drawing
from holdfast.interface.report import page
from holdfast.interface.report.figures import Curve, Mark
from holdfast.interface.report.page import Block, Callout, Cell, Code, Page, Picture, Section, Table, Text
from holdfast.model.arm.model import Arm
from holdfast.model.arms.tool import format_tool_pose
from holdfast.studies.assessment.assessment import Assessment
from holdfast.studies.assessment.comparison import Comparison
from holdfast.studies.assessment.upgrade import MAX_REOPTIMISED_POSES

_MAX_UPGRADES = 3  # joints per candidate; its own report has all


@reports_progress("drawing the report")
def write(comparison: Comparison, path: Path) -> Path:
    """Write the comparison as an HTML report, which begins with the table of the candidates."""
    return page.write(build(comparison), path)


def build(comparison: Comparison) -> Page:
    """Build the comparison report as blocks, before it becomes HTML."""
    c = comparison
    first = AssessmentFacts(c.assessments[0], c.threshold)
    unfinished = [name for name, assessment in zip(c.names, c.assessments, strict=True) if not assessment.complete]
    alerts = []
    if unfinished:
        names = ", ".join(unfinished)
        alerts.append(Callout("Run the same command again to resume.", "bad", f"Not complete: {names}."))
    sections = [
        Section("", [Callout(" ".join(c.notes), title="Before comparing")] if c.notes else []),
        Section("The candidates", [_tabulate_candidates(c, first)]),
        Section("How the index is distributed", _build_distribution_blocks(c, first)),
        Section("Which joint deserves a redundant motor or brake", _build_upgrade_blocks(c, first)),
        Section("About each candidate", [_tabulate_candidate_details(c)]),
    ]
    return Page(
        f"Fault tolerance of {len(c.names)} candidates",
        _compose_headline(c, first),
        sections,
        subtitle=first.assessment.region.name,
        warnings=alerts,
        method=_build_method_blocks(c, first),
        again=_build_rerun_blocks(c),
    )


def _compose_headline(comparison: Comparison, facts: AssessmentFacts) -> str:
    target = (
        f"{facts.index.name} of at {'least' if facts.larger_is_better else 'most'} "
        f"{format_as_given(comparison.threshold)}{facts.unit_suffix} after any failure considered"
    )
    task_names = list(dict.fromkeys(assessment.index.task.name for assessment in comparison.assessments))
    if len(task_names) > 1:
        verdicts = [f"{task}, {_describe_task_leader(comparison, task)}" for task in task_names]
        return (
            f"Probability of keeping {indefinite_article(target)} {target}, the best candidate of each task: "
            f"{'; '.join(verdicts)}."
        )
    ranked = comparison.ranking()
    best, runner_up = (comparison.interval(name) for name in ranked[:2])
    if best.value == 0:
        text = f"No candidate keeps {indefinite_article(target)} {target} at any {facts.noun} of the region."
        text += _describe_nearest_candidate(comparison)
    else:
        text = (
            f"{ranked[0]} keeps {indefinite_article(target)} {target} with the largest probability, "
            f"{format_interval(best)}; next is "
        )
        text += f"{ranked[1]} with {format_interval(runner_up)}."
        if runner_up.value < best.value and not _best_intervals_are_disjoint(comparison):
            text += f" Their intervals overlap: more {facts.noun}s would tell them apart."
    if all(assessment.optimised is not None for assessment in comparison.assessments):
        leaders = _find_leaders(comparison, optimised=True)
        probability = comparison.interval(leaders[0], optimised=True)
        if probability.value > 0:
            text += (
                f" After optimisation the largest probability is that of {' and '.join(leaders)}, "
                f"{format_interval(probability)}."
            )
    return text


def _find_leaders(comparison: Comparison, optimised: bool = False) -> list[str]:
    """List the candidates with the largest probability of meeting the threshold."""
    probabilities = {name: comparison.interval(name, optimised).value for name in comparison.names}
    return [name for name, value in probabilities.items() if value == max(probabilities.values())]


def _best_intervals_are_disjoint(comparison: Comparison) -> bool:
    """Return whether the intervals of the two best candidates do not overlap."""
    best_interval, runner_up = (comparison.interval(name) for name in comparison.ranking()[:2])
    return runner_up.high < best_interval.low


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
    return f" Nearest is {name}. {AssessmentFacts(assessment, comparison.threshold).low_probability_reason}"


def _describe_task_leader(comparison: Comparison, task: str) -> str:
    name = comparison.best(task)
    probability = comparison.interval(name)
    return f"{name} with {format_interval(probability)}" if probability.value > 0 else "none"


def _tabulate_candidates(comparison: Comparison, facts: AssessmentFacts) -> Table:
    """Build the main table with one row per candidate."""
    optimised = any(assessment.optimised is not None for assessment in comparison.assessments)
    survival = any(assessment.survivors is not None for assessment in comparison.assessments)
    header: list[Cell] = [
        "Candidate",
        "task",
        "redundancy",
        "reached",
        f"P({'≥' if facts.larger_is_better else '≤'} {format_as_given(comparison.threshold)})",
    ]
    header += [*["optimised"] * optimised, "median", *["left after a lock"] * survival, "worst failure"]
    table_rows = []
    for row, assessment in zip(comparison.table, comparison.assessments, strict=True):
        cells: list[Cell] = [row["name"], row["task"], str(row["redundancy"])]
        cells += [_format_with_interval(row, "reached"), _format_with_interval(row, "probability")]
        cells += [_format_with_interval(row, "optimised_probability")] * optimised
        cells.append(
            _stack_lines([_format_value(row["median"]), *[f"{_format_value(row['optimised_median'])} opt."] * optimised])
        )
        cells += [_format_value(row["expected_survival"])] * survival
        cells.append(
            _stack_lines(
                [
                    _format_worst_failure(row, assessment, ""),
                    *[f"{_format_worst_failure(row, assessment, 'optimised_')} opt."] * optimised,
                ]
            )
        )
        joint_numbers = [str(assessment.arm.joint_index(name) + 1) for name in row["single_points_of_failure"]]
        cells.append("every joint" if len(joint_numbers) == assessment.arm.n else ", ".join(joint_numbers) or "none")
        table_rows.append(cells)
    caption = (
        f"P: fraction of the {format_count(facts.distribution.samples, facts.noun)} whose {facts.condition}, with 95 % "
        f"intervals; medians are over the "
        "reached ones. Redundancy: joints minus rows of the task. Joints are numbered from the "
        "base. Single point of failure: a joint whose lock ends the task "
        "in every configuration."
    )
    if optimised:
        caption += " Optimised (opt.): at the best configurations."
    if survival:
        caption += " Left after a lock: fraction of the poses still reached, every joint equally likely to fail."
    numeric_columns = frozenset(range(2, 6 + optimised + survival))
    return Table(table_rows, [*header, "single point of failure"], numeric_columns, caption=caption, wide=True)


def _format_with_interval(row: dict[str, Any], name: str) -> Cell:
    if row[name] is None:
        return "–"
    lower, upper = (format_decimals(row[f"{name}_{bound_name}"], 3) for bound_name in ("low", "high"))
    return _stack_lines([format_decimals(row[name], 3), f"{lower} to {upper}"])


def _stack_lines(lines: list[str]) -> Cell:
    """Stack lines in one cell: the first one normal, the others in quiet type below it."""
    quiet_lines = [Markup('<br><span class="quiet">{}</span>').format(line) for line in lines[1:]]
    return Markup("").join([Markup("{}").format(lines[0]), *quiet_lines])


def _format_value(value: float | None) -> str:
    return "–" if value is None else format_number(value)


def _format_worst_failure(row: dict[str, Any], assessment: Assessment, key_prefix: str) -> str:
    """Format the worst failure as joint numbers from 1, because joint names are too long for this table, with its frequency."""
    failure_name = row[f"{key_prefix}worst_joint"]
    if failure_name is None:
        return "–"
    failed_joints = assessment.index.failures[assessment.index.failure_names.index(failure_name)]
    return f"{'+'.join(str(joint + 1) for joint in failed_joints)} ({format_percent(row[f'{key_prefix}worst_fraction'])})"


def figures(comparison: Comparison) -> dict[str, Figure]:
    """Draw the cumulative distributions of all candidates; empty where no value is finite."""
    f = AssessmentFacts(comparison.assessments[0], comparison.threshold)
    candidates = list(zip(comparison.names, comparison.assessments, strict=True))
    samples = [
        ("As inverse kinematics found them" if f.assessment.region.kind != "joints" else "Cumulative (CDF)", candidates, False)
    ]
    if any(assessment.optimised is not None for assessment in comparison.assessments):
        samples.append(
            (
                "After optimisation",
                [(name, assessment) for name, assessment in candidates if assessment.optimised is not None],
                True,
            )
        )
    axis, log = _choose_index_axis(comparison, f)
    if axis is None:
        return {}
    marks = [Mark(comparison.threshold, f"threshold {format_as_given(comparison.threshold)}{f.unit_suffix}")]
    if (bound := _find_common_bound(comparison)) is not None:
        marks.append(Mark(bound, f"no configuration can exceed {bound:.3f}", "bound"))
    panels = [
        (title, [Curve(axis, assessment.cdf(axis, optimised=optimised), name) for name, assessment in group])
        for title, group, optimised in samples
    ]
    return {
        "compare": drawing.compare_cdf_figure(panels, marks, f.axis_label, ylabel="fraction with a smaller value, F", log=log)
    }


def _find_common_bound(comparison: Comparison) -> float | None:
    """Return the upper bound of the index if all candidates share one number, else None."""
    bounds = {assessment.index.bound for assessment in comparison.assessments}
    return bounds.pop() if len(bounds) == 1 else None


def _choose_index_axis(comparison: Comparison, facts: AssessmentFacts) -> tuple[NDArray[np.float64] | None, bool]:
    """Return the index values at which all distributions are drawn, None if no value is finite, and whether they are
    logarithmic.
    """
    distributions = [
        assessment.distribution_of(optimised)
        for assessment in comparison.assessments
        for optimised in (False, True)[: 1 + (assessment.optimised is not None)]
    ]
    extremes = [
        value for distribution in distributions for value in (distribution.lowest, distribution.highest) if np.isfinite(value)
    ]
    if not extremes:
        return None, False
    log = not facts.larger_is_better and min(extremes) > 0 and max(extremes) > 20 * min(extremes)
    extremes += [value for value in (comparison.threshold, _find_common_bound(comparison)) if value is not None]
    if log:
        return np.geomspace(min(extremes), max(extremes), 801), True
    return np.linspace(min(0.0, *extremes), 1.04 * max(0.0, *extremes), 801), False


def _build_threshold_slider(comparison: Comparison, facts: AssessmentFacts, figure: Figure, band: float) -> Block:
    """Build a movable threshold with the probability of each candidate and the leader at every step."""
    axis, log = _choose_index_axis(comparison, facts)
    assert axis is not None
    threshold_values = thresholds.choose_thresholds(axis, log, comparison.threshold)
    comparisons = [replace(comparison, threshold=moved) for moved in threshold_values.tolist()]
    answers: dict[str, list[str]] = {}
    if len({assessment.index.task.name for assessment in comparison.assessments}) == 1:
        answers["Largest probability"] = [_describe_leader(moved) for moved in comparisons]
    for name, assessment in zip(comparison.names, comparison.assessments, strict=True):
        answers[name] = [format_interval(moved.interval(name)) for moved in comparisons]
        if assessment.optimised is not None:
            answers[f"{name}, best configurations"] = [
                format_interval(moved.interval(name, optimised=True)) for moved in comparisons
            ]
    return thresholds.build_slider(facts, threshold_values, answers, figure, "each curve", band)


def _describe_leader(comparison: Comparison) -> str:
    """Name the leading candidate and whether its lead is significant; of several leaders all names."""
    leaders = _find_leaders(comparison)
    if len(leaders) > 1:
        return "all alike" if len(leaders) == len(comparison.names) else f"{' and '.join(leaders)} alike"
    return leaders[0] if _best_intervals_are_disjoint(comparison) else f"{leaders[0]}; its interval overlaps with the next"


def _build_distribution_blocks(comparison: Comparison, facts: AssessmentFacts) -> list[Block]:
    """Build the figure of the distributions, its explanation, and a threshold to move over it."""
    drawn_figures = comparison.figures()
    if not drawn_figures:
        return []
    term = "1 − F" if facts.larger_is_better else "F"
    text = (
        f"Over all {format_count(facts.distribution.samples, facts.noun)} of each candidate; the probability of "
        f"meeting a threshold is {term} there. "
    )
    if any(assessment.distribution.unreached for assessment in comparison.assessments):
        text += f"A pose without a configuration counts as {'0' if facts.larger_is_better else 'infinite'}. "
    band_width = max(assessment.distribution.band() for assessment in comparison.assessments)
    text += f"The 95 % band of each curve is {format_half_width(band_width)}."
    picture = Picture(drawing.svg(drawn_figures["compare"], "compare", "Cumulative distributions of all candidates"), text)
    return [picture, _build_threshold_slider(comparison, facts, drawn_figures["compare"], band_width)]


def _build_upgrade_blocks(comparison: Comparison, facts: AssessmentFacts) -> list[Block]:
    """Build the table of the joints of each candidate whose protection from failure gains most."""
    table_rows: list[list[Cell]] = []
    candidates_without_rows = [
        candidate
        for candidate, assessment in zip(comparison.names, comparison.assessments, strict=True)
        if not assessment.has_rows
    ]
    optimised = any(assessment.optimised is not None for assessment in comparison.assessments)
    for name, assessment in zip(comparison.names, comparison.assessments, strict=True):
        ranked = comparison.upgrades(name) if assessment.has_rows else []
        upgrades_by_joint = (
            {upgrade.joint: upgrade for upgrade in rank_optimised_upgrades(assessment, comparison.threshold)}
            if assessment.has_rows
            else {}
        )
        for rank, upgrade in enumerate(ranked[:_MAX_UPGRADES]):
            cells: list[Cell] = [
                "" if rank else name,
                upgrade.joint,
                f"{upgrade.before:.3f}",
                f"{upgrade.after:.3f}",
                format_gain(upgrade),
            ]
            if optimised:
                cells += (
                    [f"{upgrades_by_joint[upgrade.joint].after:.3f}", format_gain(upgrades_by_joint[upgrade.joint])]
                    if upgrades_by_joint
                    else ["–", "–"]
                )
            table_rows.append(cells)
    blocks: list[Block] = []
    if table_rows:
        header = ["Candidate", "if this never fails", "P now", "P then", "gain, 95 % interval"]
        header += ["after optimisation", "gain, 95 % interval"] * optimised
        caption = f"P({facts.condition}). The {_MAX_UPGRADES} joints of each candidate that gain most; its own report has all."
        blocks.append(Table(table_rows, header, frozenset(range(2, len(header))), caption=caption, wide=True))
        explanation = (
            "Suppose that a redundant motor or brake keeps one joint from failing: the worst case is then over the "
            f"failures in which it has no part, at the same {facts.noun}s and configurations. The intervals are "
            f"paired: a gain is "
            f"the fraction of the {facts.noun}s that fail now and would not then."
        )
        if optimised:
            explanation += (
                f" After optimisation: configurations of up to {MAX_REOPTIMISED_POSES} {facts.noun}s optimised "
                f"again without it."
            )
        blocks.append(Text(explanation, quiet=True))
    if candidates_without_rows:
        blocks.append(
            Text(f"The {facts.noun}s of {', '.join(candidates_without_rows)} were not kept, so they are not in this table.")
        )
    return blocks


def _tabulate_candidate_details(comparison: Comparison) -> Table:
    table_rows: list[list[Cell]] = []
    for name, a in zip(comparison.names, comparison.assessments, strict=True):
        bound = "not known" if a.index.bound is None else f"{a.index.bound:.3f}"
        median_gaps = [
            format_number(gap) for gap in (a.gap(), a.gap(True) if a.optimised is not None else None) if gap is not None
        ]
        fingerprint = Markup("<code>{}</code>").format(a.arm.fingerprint[:10])
        source = a.arm.source if len(a.arm.source) <= 60 else a.arm.source[:59] + "…"
        chain_suffix = "" if a.arm.chain is None else f"; {a.arm.chain}"
        table_rows.append(
            [
                name,
                a.arm.name,
                _format_tool_pose(a.arm),
                bound,
                " → ".join(median_gaps) or "–",
                (source or "no source given") + chain_suffix,
                fingerprint,
            ]
        )
    header = ["Candidate", "arm", "tool", "bound of the index", "gap of the median", "source", "fingerprint"]
    caption = (
        "Tool: x, y, z; roll, pitch, yaw as in URDF, in the last link's own frame. Bound: no configuration can exceed it. "
        "Gap: by how much the median of the reached poses falls short of it"
    )
    caption += ", before → after optimisation." if any(a.optimised is not None for a in comparison.assessments) else "."
    return Table(table_rows, header, frozenset({3, 4}), caption=caption, wide=True)


def _format_tool_pose(arm: Arm) -> str:
    x, y, z, *angles = (format_as_given(float(value)) for value in format_tool_pose(arm).split(","))
    return f"{x}, {y}, {z} m; {', '.join(angles)} deg"


def _build_method_blocks(comparison: Comparison, facts: AssessmentFacts) -> list[Block]:
    assessment = facts.assessment
    threshold_reason = "it was given"
    if not comparison.chosen:
        bounded = all(candidate.index.bound is not None for candidate in comparison.assessments)
        threshold_reason = (
            "half of the smallest bound"
            if bounded
            else "about the middle of the candidates' medians, because this index has no bound"
        )
    seeds = sorted({candidate.seed for candidate in comparison.assessments})
    entries: list[tuple[str, str]] = [
        ("Region", f"{assessment.region.name}: {assessment.region.describe()}"),
        (
            "Samples",
            f"{format_count(facts.distribution.samples, facts.noun)} of each candidate, {assessment.sampling}, seed "
            f"{', '.join(map(str, seeds))}",
        ),
        (
            "Index",
            f"worst-case {facts.index.name}{facts.unit_suffix and f', unit{facts.unit_suffix}'}; "
            f"{'larger' if facts.larger_is_better else 'smaller'} is better",
        ),
        ("Threshold", f"{format_as_given(comparison.threshold)}{facts.unit_suffix}: {threshold_reason}"),
        ("Not found", f"a pose without a configuration counts as {'0' if facts.larger_is_better else 'infinite'}"),
        ("Intervals", "95 %: Clopper-Pearson (exact) for a probability, Dvoretzky-Kiefer-Wolfowitz for a whole CDF"),
        (
            "Ranking",
            "by the probability of meeting the threshold as inverse kinematics found the configurations; then the median",
        ),
    ]
    if len(seeds) == 1 and len({candidate.sampling for candidate in comparison.assessments}) == 1:
        entries.append(("Same poses", "every candidate was tried at the same poses of the region"))
    collision_models = [
        (candidate_name, candidate.plan.clearance.capsules.describe(candidate.arm))
        for candidate_name, candidate in zip(comparison.names, comparison.assessments, strict=True)
        if candidate.plan.clearance
    ]
    cell_texts = {
        candidate.plan.cell.digest: describe_cell(candidate.plan.cell)
        for candidate in comparison.assessments
        if candidate.plan.cell is not None
    }
    if cell_texts:
        entries.append(("Cell", "; ".join(cell_texts.values())))
    if collision_models and any(candidate.optimised is not None for candidate in comparison.assessments):
        models = "; ".join(f"{name}: {shape}" for name, shape in collision_models)
        entries.append(
            (
                "Clearance",
                f"best configurations keep the arm clear of itself{' and the cell' * bool(cell_texts)}, by capsules ({models})",
            )
        )
    return [Table([[label, value] for label, value in entries])]


def _build_rerun_blocks(comparison: Comparison) -> list[Block]:
    """Build the command of each candidate and the files that it needs."""
    blocks: list[Block] = []
    for name, assessment in zip(comparison.names, comparison.assessments, strict=True):
        command, remark = build_command_line(assessment)
        blocks.append(
            Text(f"{name}: {remark}") if command is None else Code(command, f"{name} alone{f' ({remark})' if remark else ''}:")
        )
        blocks += build_shape_file_blocks(assessment)
    region = comparison.assessments[0].region
    return [*blocks, *(build_region_file_blocks(region) if region.storable else [])]
