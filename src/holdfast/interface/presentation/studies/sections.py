"""Sections of the report of a study."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from holdfast.core.formatting import format_as_given, format_half_width, format_number, format_percent
from holdfast.core.sweeps.study import Study
from holdfast.interface import report
from holdfast.interface.presentation.presentation import TableSpec, make_headers
from holdfast.interface.presentation.renderers import build_table_block
from holdfast.interface.presentation.studies.answer import get_index_key, read_cells
from holdfast.interface.presentation.studies.designs import build_sweep_blocks
from holdfast.interface.report.page import Block, Callout, Picture, Section
from holdfast.studies.assessment.plan import AssessmentPlan
from holdfast.studies.assessment.single_points import Structure, explain
from holdfast.studies.study_files import results
from holdfast.studies.study_files.ranking import ArmRanking, Ended, Key, format_count_range, format_unit, label_arm
from holdfast.studies.study_files.results import AssessedCell, DesignSweep, DrivenCell

_OUTCOME_LABELS = ("reaches the target", "stops elsewhere", "keeps moving", "undecided")


def build_sections(
    study: Study,
    assessed: Sequence[AssessedCell],
    laws: Sequence[DrivenCell],
    sweeps: Sequence[DesignSweep],
    limits: dict[Key, float],
    fatal_structures: dict[Ended, tuple[AssessmentPlan, Structure]],
    ranking: Sequence[ArmRanking],
) -> list[Section]:
    """Build the sections of the report."""
    return [
        Section("Ranking of the arms", build_ranking_blocks(ranking)),
        Section("Single points of failure by structure", build_structure_blocks(fatal_structures)),
        *[
            Section(f"Designs of {item.labels['arm']}", build_sweep_blocks(item, position))
            for position, item in enumerate(sweeps)
        ],
        Section("All arms, indices and laws", _build_table_blocks(assessed, laws, limits)),
        Section("Distributions of the indices", _build_distribution_blocks(assessed, limits)),
        Section("Worst failure of each arm", _build_worst_joint_blocks(assessed)),
        Section("Convergence after an undetected lock", _build_law_blocks(laws)),
        Section(
            "Start positions from which the target is still reached",
            _build_measure_blocks(study, "workspace", results.read_workspace, "starts", "percent"),
        ),
        Section(
            "Tasks under computer control",
            _build_measure_blocks(study, "bank", results.read_bank, "sets of tasks", "percent, or cycles"),
        ),
    ]


def _tabulate(title: str, head: Sequence[str], rows: Sequence[Sequence[Any]]) -> Block:
    """Build a table of texts and fractions."""
    block: Block = build_table_block(TableSpec(title, make_headers(*head, style="percent"), rows).texts())
    return block


def _get_row_key(labels: dict[str, Any]) -> tuple[str, ...]:
    """Return the key of a row of the table: the arm, the region and the failures."""
    return labels["arm"], labels.get("region", ""), labels.get("failures", "single")


def build_ranking_blocks(ranking: Sequence[ArmRanking]) -> list[Block]:
    """Build the ranking of several arms: a figure with a row for each question, and a table of the best arms."""
    names = list(dict.fromkeys(name for standing in ranking for name, _ in standing.entries))
    if len(names) < 2:
        return []
    shares = []
    for name in names:
        fractions = [dict(standing.entries).get(name) for standing in ranking]
        value, lower, upper = (
            np.array([np.nan if fraction is None else getattr(fraction, attribute) for fraction in fractions])
            for attribute in ("value", "low", "high")
        )
        shares.append(report.Gains(label=name, value=value, low=lower, high=upper))
    figure = report.fraction_figure(
        [standing.question for standing in ranking], shares, "fraction of the poses, or of the motions; bars: 95 % interval"
    )
    rows: list[list[Any]] = []
    for standing in ranking:
        (name, fraction), *runners_up = standing.ranked_entries
        tied_arms = standing.tied_with_first[1:]
        lead_text = "significant" if fraction.low > 0 else "may be 0, too"  # the others may be 0 for certain
        certainty = "–" if not runners_up else f"overlaps with {', '.join(tied_arms)}" if tied_arms else lead_text
        certainty += "".join(f"; {arm}: 0 by structure" for arm in standing.ended)
        next_text = f"{runners_up[0][0]}, {format_percent(runners_up[0][1].value)}" if runners_up else "–"
        question = standing.question + (f", in {standing.unit}" if standing.unit else "")
        rows.append([question, name, fraction, next_text, certainty, standing.about])
    explanation = (
        "Arm with the largest fraction for each question. Significant: its 95 % interval lies above those of all other arms. "
        "Overlaps: the intervals overlap, so more samples are needed to distinguish the arms. Rows of an index: fraction of "
        "the poses at which the index meets the threshold after every failure considered. Converges: fraction of the motions "
        "that reach their target after an undetected lock"
    )
    head = ["question", "best arm", "fraction, with 95 % interval", "next", "difference", "samples of each arm"]
    return [
        Picture(report.svg(figure, "standings", "Fractions of all arms for every question"), "Larger is better in every row."),
        _tabulate(explanation, head, rows),
    ]


def build_structure_blocks(fatal_structures: dict[Ended, tuple[AssessmentPlan, Structure]]) -> list[Block]:
    """Build a callout for each arm and task that some lock makes singular in every configuration."""
    return [Callout(explain(job_plan.arm, analysis, []), "bad") for job_plan, analysis in fatal_structures.values()]


def _build_table_blocks(assessed: Sequence[AssessedCell], laws: Sequence[DrivenCell], limits: dict[Key, float]) -> list[Block]:
    row_keys = list(
        dict.fromkeys([*(_get_row_key(entry.labels) for entry in assessed)] or [_get_row_key(result.labels) for result in laws])
    )
    keys = list(limits)
    law_keys = list(dict.fromkeys((law_result.labels["law"], law_result.labels["task"]) for law_result in laws))
    if not row_keys or not (keys or law_keys):
        return []
    regions = len({other_key[1:] for other_key in row_keys if other_key[0] == row_keys[0][0]}) > 1
    tasks = len({task_name for _, task_name in keys}) > 1
    head = ["arm"]
    for index, task in keys:
        cells = [entry for entry in assessed if get_index_key(entry) == (index, task)]
        measure, limit = cells[0].plan.index, format_as_given(limits[index, task])
        question = f"{measure.name} {'≥' if measure.better == 'larger' else '≤'} {limit}{f', {task}' * tasks}"
        head += [question, *[f"{question}, optimised"] * any(entry.optimised is not None for entry in cells)]
    head += [f"{law} converges" for law, _ in law_keys]
    rows: list[list[Any]] = []
    for row_key in row_keys:
        row: list[Any] = [f"{row_key[0]}: {row_key[1]}, {row_key[2]}" if regions else row_key[0]]
        for key in keys:
            cells = [entry for entry in assessed if get_index_key(entry) == key]
            matching = [entry for entry in cells if _get_row_key(entry.labels) == row_key]
            for optimised in (False, True)[: 1 + any(entry.optimised is not None for entry in cells)]:
                row.append((matching[0].interval(limits[key], optimised) if matching else None) or "–")
        for law in law_keys:
            law_matches = [
                result
                for result in laws
                if (result.labels["law"], result.labels["task"]) == law and result.labels["arm"] == row_key[0]
            ]
            row.append(law_matches[0].mean_fraction if law_matches else "–")
        rows.append(row)
    caption = ""
    if keys:
        caption += (
            "Fraction of the poses of the region at which the index meets the threshold after every failure considered, with "
            "its 95 % interval; optimised: at the best configuration of each pose. All arms have the same threshold. "
        )
        if any(entry.labels["region"] == "default region" for entry in assessed):
            caption += "The default region is around the home of each arm and scaled by its reach, or that of a paper. "
    if law_keys:
        caption += (
            "Converges: fraction of random motions that reach their target with one joint locked from the start, undetected, "
            "averaged over the joints; every law was simulated on the same motions of an arm."
        )
    return [_tabulate(caption, head, rows)]


def _build_distribution_blocks(assessed: Sequence[AssessedCell], limits: dict[Key, float]) -> list[Block]:
    """Build a figure for each index and task, with a curve for each arm."""
    blocks: list[Block] = []
    for number_, (key, limit) in enumerate(limits.items()):
        matching = [entry for entry in assessed if get_index_key(entry) == key and entry.plain is not None]
        samples = [("At the configurations found", [(entry, entry.plain) for entry in matching])]
        if any(entry.optimised is not None for entry in matching):
            samples.append(
                ("At the best configurations", [(entry, entry.optimised) for entry in matching if entry.optimised is not None])
            )
        distributions = [distribution for _, group in samples for _, distribution in group if distribution is not None]
        extremes = [value for shown in distributions for value in (shown.lowest, shown.highest) if np.isfinite(value)]
        if not extremes:
            continue
        index = matching[0].plan.index
        is_logarithmic = index.better == "smaller" and min(extremes) > 0 and max(extremes) > 20 * min(extremes)
        lower, upper = min(*extremes, limit), max(*extremes, limit)
        axis_values = (
            np.geomspace(lower, upper, 801) if is_logarithmic else np.linspace(min(0.0, lower), 1.04 * max(0.0, upper), 801)
        )
        panels = [
            (
                title,
                [
                    report.Curve(axis_values, distribution.cdf(axis_values), _name_arm(entry, matching))
                    for entry, distribution in group
                    if distribution is not None
                ],
            )
            for title, group in samples
        ]
        unit_text = format_unit(index.unit, ", ")
        figure = report.compare_cdf_figure(
            panels,
            [report.Mark(limit, f"threshold {format_as_given(limit)}{format_unit(index.unit)}")],
            f"worst-case {index.name}{unit_text}",
            ylabel="fraction with a smaller value, F",
            log=is_logarithmic,
        )
        poses = format_count_range([distribution.samples for distribution in distributions])
        band = max(distribution.band() for distribution in distributions)
        text = (
            f"Cumulative distributions of the worst-case {index.name} (task {key[1]}) over {poses} poses of each arm; the 95 % "
            f"band of each curve is {format_half_width(band)}. A pose without a configuration counts as "
            f"{'0' if index.better == 'larger' else 'infinite'}."
        )
        description = f"Cumulative distributions of the {index.name} of all arms"
        blocks.append(Picture(report.svg(figure, f"cdf{number_}", description), text))
    return blocks


def _name_arm(assessed: AssessedCell, others_shown: Sequence[AssessedCell]) -> str:
    return label_arm(assessed.labels, [entry.labels for entry in others_shown])


def _build_worst_joint_blocks(assessed: Sequence[AssessedCell]) -> list[Block]:
    rows: list[list[Any]] = []
    has_survival = any(entry.survival_fraction is not None for entry in assessed)
    for entry in assessed:
        if entry.plain is None:
            continue
        medians = [
            format_number(float(distribution.quantile(0.5))) if distribution.reached else "–"
            for distribution in (entry.plain, entry.optimised)
            if distribution is not None
        ]
        others = [candidate for candidate in assessed if get_index_key(candidate) == get_index_key(entry)]
        row: list[Any] = [
            *(_name_arm(entry, others), entry.plan.index.name, " → ".join(medians)),
            "not known" if entry.plan.index.bound is None else format_number(entry.plan.index.bound),
            "–" if entry.worst is None else f"{entry.worst[0]} ({format_percent(entry.worst[1])})",
            entry.plain.unreached_share,
        ]
        rows.append([*row, "–" if entry.survival_fraction is None else entry.survival_fraction][: 6 + has_survival])
    head = ["arm", "index", "median", "bound", "worst failure", "poses not reached", "reached after a lock"][: 6 + has_survival]
    title = (
        "Median over the reached poses, → at the best configurations. No configuration can exceed the bound. The worst failure "
        "is the one that most often has the worst index, with the fraction of poses"
    )
    return [_tabulate(title, head, rows)] if rows else []


def _build_law_blocks(laws: Sequence[DrivenCell]) -> list[Block]:
    if not laws:
        return []
    stacks = []
    arm_names = list(dict.fromkeys(result.labels["arm"] for result in laws))
    for arm in arm_names:
        arm_results = [result for result in laws if result.labels["arm"] == arm]
        shares = np.stack([result.ends[:-1].mean(axis=0) for result in arm_results])
        lower, upper = (np.array([getattr(result.mean_fraction, bound) for result in arm_results]) for bound in ("low", "high"))
        stacks.append(
            report.Stack(name=arm, bars=[result.labels["law"] for result in arm_results], shares=shares, low=lower, high=upper)
        )
    motion_count = format_count_range([result.motions for result in laws])
    figure = report.stack_figure(stacks, _OUTCOME_LABELS, "fraction of the runs, averaged over the locked joint")
    blocks: list[Block] = [
        Picture(
            report.svg(figure, "laws", "How motions with a locked joint end, for each arm and law"),
            f"{motion_count} random motions of each arm between the end-effector positions of random configurations, each "
            "repeated with every joint locked from the start. Not every target is within reach of the arm with a locked joint. "
            "Undecided: stopped at the time limit or near a singular configuration.",
        )
    ]
    rows: list[list[Any]] = []
    touches = [] if laws[0].touched is None else ["collides, at most"]
    for result in laws:
        reference = next(
            candidate
            for candidate in laws
            if candidate.labels["arm"] == result.labels["arm"] and candidate.labels["task"] == result.labels["task"]
        )
        gain_text, gain = "–", None if result is reference else results.compare_convergence_cells(reference, result)
        if gain is not None:
            gain_text = f"{gain.value:+.3f} ({gain.low:+.3f} to {gain.high:+.3f})".replace("-", "−")
        joint = int(np.argmin([reach_interval.value for reach_interval in result.reaches[:-1]]))
        worst = f"{result.joints[joint] if joint < len(result.joints) else joint + 1}: {result.reaches[joint].value:.3f}"
        row: list[Any] = [result.labels["arm"], result.labels["law"], result.labels["task"], result.mean_fraction, gain_text]
        rows.append([*row, worst, result.reaches[-1], result.in_reach, *[result.touched or 0.0] * len(touches)])
    head = ["arm", "law", "task", "converges", "gain over the first law", "worst joint", "converges, none locked", "in reach"]
    title = (
        "95 % intervals. The gain is paired, because both laws were simulated on the same motions. In reach: fraction of the "
        "runs with a locked joint for which a configuration at the target exists"
    )
    return [*blocks, _tabulate(title, [*head, *touches], rows)]


def _build_measure_blocks(
    study: Study, job: str, read: Callable[[Study, int], results.MeasureTable | None], noun: str, unit: str
) -> list[Block]:
    measured = [table for table in read_cells(study, job, read) if table is not None]
    if not measured:
        return []
    measure_names = list(measured[0].values)
    rows: list[list[Any]] = []
    for table in measured:
        cells = []
        for value, lower, upper in (table.values[name] for name in measure_names):
            interval_text = "" if np.isnan(lower) else f" ({lower:.1f} to {upper:.1f})"
            cells.append("–" if np.isnan(value) else f"{value:.1f}{interval_text}")
        rows.append([table.labels["arm"], table.labels["law"], table.samples, *cells])
    title = f"{unit.capitalize()}, with 95 % intervals, for an arbitrary locked joint"
    return [_tabulate(title, ["arm", "law", noun, *measure_names], rows)]
