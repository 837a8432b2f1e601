"""HTML report of a study: the fractions that each arm retains, under which law, and how they were computed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from markupsafe import Markup

from holdfast.core.errors import StoreError
from holdfast.core.formatting import (
    format_as_given,
    format_count,
    format_duration,
    format_half_width,
    format_number,
    format_percent,
    list_alternatives,
)
from holdfast.core.probability.intervals import Interval
from holdfast.core.progress import reports_progress
from holdfast.core.sweeps.study import Study
from holdfast.core.typing import T
from holdfast.interface.presentation.studies.answer import headline, list_leaders
from holdfast.interface.presentation.studies.designs import build_sweep_blocks, describe_best_design
from holdfast.interface.report import figures, page
from holdfast.interface.report.figures import Curve, Mark
from holdfast.interface.report.outcomes import Gains, Stack, fraction_figure, stack_figure
from holdfast.interface.report.page import Block, Callout, Cell, Code, Page, Picture, Section, Table, Text
from holdfast.studies.assessment.plan import AssessmentPlan
from holdfast.studies.assessment.single_points import Structure, explain, structure
from holdfast.studies.study_files import results
from holdfast.studies.study_files.ranking import (
    ArmRanking,
    Ended,
    Key,
    format_count_range,
    format_unit,
    label_arm,
    make_structure_key,
    rank_arms,
)
from holdfast.studies.study_files.results import AssessedCell, DrivenCell
from holdfast.studies.study_files.study_file import read_thresholds

_OUTCOME_LABELS = ("reaches the target", "stops elsewhere", "keeps moving", "undecided")


@reports_progress("drawing the report")
def write(study: Study, path: str | Path, command: str = "") -> Path:
    """Write the report of a study, also of one that is not complete; the report contains the instructions that repeat it.

    Raises:
        StoreError: Nothing is computed, a chunk is damaged, or the file cannot be written.
    """
    del command
    return page.write(build(study), path)


def build(study: Study) -> Page:
    """Build the report as blocks, before it becomes HTML."""
    cells = study.status()
    chunks_done, chunk_count = sum(item.chunks_done for item in cells), sum(item.chunks for item in cells)
    if not chunks_done:
        raise StoreError(f"nothing of '{study.path}' is computed yet; run the study first")
    assessed = _read_results(study, "assess", results.read_assessment)
    laws = [
        law_result for law_result in _read_results(study, "convergence", results.read_convergence) if law_result is not None
    ]
    limits = _choose_thresholds(study, assessed)
    alerts = []
    if chunks_done < chunk_count:
        missing = f"{chunks_done:,} of {chunk_count:,} chunks are computed; run the same command again to resume."
        alerts.append(Callout(missing, "bad", "Not complete."))
    sweeps = [item for item in _read_results(study, "designs", results.read_design_sweep) if item is not None]
    fatal_structures = _find_fatal_structures(assessed)
    ranking = rank_arms(
        assessed,
        laws,
        limits,
        {key: _format_fatal_joints(job_plan, item) for key, (job_plan, item) in fatal_structures.items()},
    )
    sections = [
        Section("Which arm for what", _build_ranking_blocks(ranking)),
        Section("Single points of failure by structure", _build_structure_blocks(fatal_structures)),
        *[
            Section(f"Designs of {item.labels['arm']}", build_sweep_blocks(item, position))
            for position, item in enumerate(sweeps)
        ],
        Section("Arms, indices and laws", _build_table_blocks(assessed, laws, limits)),
        Section("How the indices are distributed", _build_distribution_blocks(assessed, limits)),
        Section("Which joint is the worst to lose", _build_worst_joint_blocks(assessed)),
        Section("Reaching the target with a locked joint that nobody has noticed", _build_law_blocks(laws)),
        Section(
            "Starts that still reach the target",
            _build_measure_blocks(study, "workspace", results.read_workspace, "starts", "percent"),
        ),
        Section(
            "Tasks that the computer drives",
            _build_measure_blocks(study, "bank", results.read_bank, "sets of tasks", "percent, or cycles"),
        ),
    ]
    arm_names = list(dict.fromkeys(cell["labels"]["arm"] for cell in study.cells))
    return Page(
        study.name,
        " ".join([*([headline(ranking)] if assessed or laws or not sweeps else []), *map(describe_best_design, sweeps)]),
        sections,
        facts=list_leaders(ranking),
        subtitle=f"A study of {format_count(len(arm_names), 'arm')}: {', '.join(arm_names)}",
        warnings=alerts,
        method=_build_provenance_blocks(study, assessed),
        again=_build_rerun_blocks(study),
    )


def _read_results(study: Study, job: str, read: Callable[[Study, int], T]) -> list[T]:
    matching = [cell for cell in range(len(study.cells)) if results.read_labels(study, cell)["job"] == job]
    return [read(study, cell) for cell in matching if study.cell_folder(cell).exists()]


def _choose_thresholds(study: Study, assessed: Sequence[AssessedCell]) -> dict[Key, float]:
    """Return the threshold of each index and task: the one of the study file, else one chosen from the results."""
    specified = read_thresholds(study.source)
    groups: dict[Key, list[AssessedCell]] = {}
    for entry in assessed:
        groups.setdefault(_get_index_key(entry), []).append(entry)
    return {key: specified.get(key[0], results.choose_threshold(group)) for key, group in groups.items()}


def _get_index_key(assessed: AssessedCell) -> Key:
    return assessed.labels["index"], assessed.labels["task"]


def _get_row_key(labels: dict[str, Any]) -> tuple[str, ...]:
    """Return the key of a row of the table: the arm, the region and the failures."""
    return labels["arm"], labels.get("region", ""), labels.get("failures", "single")


# ---- the answer --------------------------------------------------------------------------------------------------------


def _build_ranking_blocks(ranking: Sequence[ArmRanking]) -> list[Block]:
    """Build the first section of a study of several arms: a figure of all questions, and the leader of each."""
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
        shares.append(Gains(label=name, value=value, low=lower, high=upper))
    figure = fraction_figure(
        [standing.question for standing in ranking], shares, "fraction of the poses, or of the motions; bars: 95 % interval"
    )
    table_rows: list[list[Cell]] = []
    for standing in ranking:
        (name, fraction), *runners_up = standing.ranked_entries
        tied_arms = standing.tied_with_first[1:]
        lead_text = "clearly ahead" if fraction.low > 0 else "perhaps 0 as well"  # the others may be 0 for certain
        certainty = "–" if not runners_up else f"level with {', '.join(tied_arms)}" if tied_arms else lead_text
        certainty += "".join(f"; {arm}: 0 by structure" for arm in standing.ended)
        next_cell: Cell = "–" if not runners_up else _stack_lines([runners_up[0][0], f"{runners_up[0][1].value:.3f}"])
        question = _stack_lines([standing.question, *[f"in {standing.unit}"] * bool(standing.unit)])
        table_rows.append(
            [question, _prevent_line_break(name), _format_interval(fraction), next_cell, certainty, standing.about]
        )
    explanation = (
        "Of each question the arm with the largest fraction. Clearly ahead: its 95 % interval lies above those of all others; "
        "level: the intervals overlap, and more samples would be needed to tell them apart. Poses: those at which the "
        "index meets the threshold whatever single failure happens. Converges: the arm reaches its target with a locked "
        "joint that its controller does not know of."
    )
    header = ["Question", "first", "fraction, with 95 % interval", "next", "how sure", "of each arm"]
    return [
        Picture(figures.svg(figure, "standings", "Fractions of all arms for every question"), "More is better in every row."),
        Table(table_rows, header, frozenset({2}), caption=explanation, wide=True),
    ]


def _find_fatal_structures(assessed: Sequence[AssessedCell]) -> dict[Ended, tuple[AssessmentPlan, Structure]]:
    """Return the structure of each arm and task that some lock makes impossible in every configuration, with its plan."""
    fatal: dict[Ended, tuple[AssessmentPlan, Structure]] = {}
    structures: dict[tuple[str, str], Structure] = {}
    for entry in assessed:
        if entry.labels.get("failures", "single") == "single":
            job_plan, key = entry.plan, (entry.plan.arm.fingerprint, entry.plan.index.task.name)
            if key not in structures:
                structures[key] = structure(job_plan.arm, job_plan.index.task)
            if not structures[key].survives:
                fatal.setdefault(make_structure_key(entry), (job_plan, structures[key]))
    return fatal


def _build_structure_blocks(fatal_structures: dict[Ended, tuple[AssessmentPlan, Structure]]) -> list[Block]:
    return [Callout(explain(job_plan.arm, analysis, []), "bad") for job_plan, analysis in fatal_structures.values()]


def _format_fatal_joints(plan: AssessmentPlan, analysis: Structure) -> str:
    """Name the joints whose lock ends a task in every configuration."""
    return list_alternatives([plan.arm.joint_names[joint] for joint in analysis.fatal]) if analysis.fatal else "any joint"


def _build_table_blocks(assessed: Sequence[AssessedCell], laws: Sequence[DrivenCell], limits: dict[Key, float]) -> list[Block]:
    row_keys = list(
        dict.fromkeys(
            [*(_get_row_key(entry.labels) for entry in assessed)] or [_get_row_key(law_result.labels) for law_result in laws]
        )
    )
    keys, law_keys = (
        list(limits),
        list(dict.fromkeys((law_result.labels["law"], law_result.labels["task"]) for law_result in laws)),
    )
    if not row_keys or not (keys or law_keys):
        return []
    regions = len({other_key[1:] for other_key in row_keys if other_key[0] == row_keys[0][0]}) > 1
    tasks = len({task_name for _, task_name in keys}) > 1
    header: list[Cell] = ["Arm"]
    for index, task in keys:
        measure = next(entry for entry in assessed if _get_index_key(entry) == (index, task)).plan.index
        larger = measure.better == "larger"
        condition = f"{'≥' if larger else '≤'} {format_as_given(limits[index, task])}"
        header.append(_stack_lines([measure.name, f"{task}: {condition}" if tasks else condition]))
    header += [_stack_lines([law, "converges"]) for law, _ in law_keys]
    table_rows: list[list[Cell]] = []
    for row_key in row_keys:
        cells: list[Cell] = [
            _stack_lines([row_key[0], f"{row_key[1]}, {row_key[2]}"]) if regions else _prevent_line_break(row_key[0])
        ]
        for key in keys:
            matching = [entry for entry in assessed if _get_index_key(entry) == key and _get_row_key(entry.labels) == row_key]
            cells.append(_format_probabilities(matching[0], limits[key]) if matching else "–")
        for law in law_keys:
            law_matches = [
                law_result
                for law_result in laws
                if (law_result.labels["law"], law_result.labels["task"]) == law and law_result.labels["arm"] == row_key[0]
            ]
            cells.append(_format_interval(law_matches[0].mean_fraction) if law_matches else "–")
        table_rows.append(cells)
    caption = ""
    if keys:
        caption += (
            "Fraction of the poses of the region whose index meets the threshold whatever single failure happens, with "
            "its 95 % "
            "interval; opt.: at the best configuration of each pose. Thresholds are one for all arms. "
        )
        if any(entry.labels["region"] == "default region" for entry in assessed):
            caption += "Default regions are around the home of each arm, sized by its reach, or the paper's. "
    if law_keys:
        caption += (
            "Converges: fraction of random motions that reach their target with one joint locked from the start and a "
            "controller that does not know it, mean over the joints; every law has the same motions of an arm."
        )
    return [Table(table_rows, header, frozenset(range(1, len(header))), caption=caption, wide=True)]


def _format_probabilities(assessed: AssessedCell, limit: float) -> Cell:
    intervals = [assessed.interval(limit, optimised) for optimised in (False, True)]
    if intervals[0] is None:
        return "–"
    lines = [_format_interval(intervals[0])]
    if intervals[1] is not None:
        lines.append(Markup("opt. {}").format(_format_interval(intervals[1])))
    return Markup("<br>").join(lines)


def _format_interval(fraction: Interval) -> Markup:
    return Markup('{:.3f} <span class="quiet">{:.3f} to {:.3f}</span>').format(fraction.value, fraction.low, fraction.high)


def _prevent_line_break(text: str) -> Markup:
    """Wrap text in an element that is not broken into lines."""
    return Markup('<span style="white-space: nowrap">{}</span>').format(text)


def _stack_lines(lines: Sequence[str]) -> Markup:
    quiet_lines = [Markup('<br><span class="quiet">{}</span>').format(line) for line in lines[1:]]
    return Markup("").join([Markup("{}").format(lines[0]), *quiet_lines])


# ---- why ---------------------------------------------------------------------------------------------------------------


def _build_distribution_blocks(assessed: Sequence[AssessedCell], limits: dict[Key, float]) -> list[Block]:
    """Build a figure for each index and task, with a curve for each arm."""
    blocks: list[Block] = []
    for number_, (key, limit) in enumerate(limits.items()):
        matching = [entry for entry in assessed if _get_index_key(entry) == key and entry.plain is not None]
        samples = [("As inverse kinematics found them", [(entry, entry.plain) for entry in matching])]
        if any(entry.optimised is not None for entry in matching):
            samples.append(
                ("At the best configurations", [(entry, entry.optimised) for entry in matching if entry.optimised is not None])
            )
        extremes = [
            value
            for _, group in samples
            for _, distribution in group
            if distribution is not None
            for value in (distribution.lowest, distribution.highest)
            if np.isfinite(value)
        ]
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
                    Curve(axis_values, distribution.cdf(axis_values), _name_arm(entry, matching))
                    for entry, distribution in group
                    if distribution is not None
                ],
            )
            for title, group in samples
        ]
        unit_text = format_unit(index.unit, ", ")
        figure = figures.compare_cdf_figure(
            panels,
            [Mark(limit, f"threshold {format_as_given(limit)}{format_unit(index.unit)}")],
            f"worst-case {index.name}{unit_text}",
            ylabel="fraction with a smaller value, F",
            log=is_logarithmic,
        )
        poses = format_count_range(
            [distribution.samples for _, group in samples for _, distribution in group if distribution is not None]
        )
        band = max(distribution.band() for _, group in samples for _, distribution in group if distribution is not None)
        text = (
            f"Cumulative distributions of the worst-case {index.name} (task {key[1]}) over {poses} poses of each arm; the 95 % "
            f"band of each curve is {format_half_width(band)}. A pose without a configuration counts as "
            f"{'0' if index.better == 'larger' else 'infinite'}."
        )
        description = f"Cumulative distributions of the {index.name} of all arms"
        blocks.append(Picture(figures.svg(figure, f"cdf{number_}", description), text))
    return blocks


def _name_arm(assessed: AssessedCell, others_shown: Sequence[AssessedCell]) -> str:
    return label_arm(assessed.labels, [entry.labels for entry in others_shown])


def _build_worst_joint_blocks(assessed: Sequence[AssessedCell]) -> list[Block]:
    table_rows: list[list[Cell]] = []
    for entry in assessed:
        if entry.plain is None:
            continue
        unreached = format_percent(entry.plain.unreached_share)
        medians = [
            format_number(float(distribution.quantile(0.5))) if distribution.reached else "–"
            for distribution in (entry.plain, entry.optimised)
            if distribution is not None
        ]
        worst = "–" if entry.worst is None else f"{entry.worst[0]} ({format_percent(entry.worst[1])})"
        bound = "not known" if entry.plan.index.bound is None else format_number(entry.plan.index.bound)
        survival = "–" if entry.survival_fraction is None else format_number(entry.survival_fraction)
        name, index = (
            _name_arm(entry, [candidate for candidate in assessed if _get_index_key(candidate) == _get_index_key(entry)]),
            entry.plan.index.name,
        )
        table_rows.append([name, index, " → ".join(medians), bound, worst, unreached, survival])
    if not table_rows:
        return []
    header = ["Arm", "index", "median", "bound", "worst failure", "poses not reached", "left after a lock"]
    caption = (
        "Median over the reached poses, → at the best configurations; the bound is what no configuration can exceed; the worst "
        "failure is the one that most often leaves the least."
    )
    shown_columns = range(7 if any(entry.survival_fraction is not None for entry in assessed) else 6)
    return [
        Table(
            [[row[column] for column in shown_columns] for row in table_rows],
            [header[column] for column in shown_columns],
            frozenset({2, 3, 5, 6}),
            caption=caption,
        )
    ]


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
            Stack(name=arm, bars=[result.labels["law"] for result in arm_results], shares=shares, low=lower, high=upper)
        )
    motion_count = format_count_range([result.motions for result in laws])
    figure = stack_figure(stacks, _OUTCOME_LABELS, "fraction of the runs, mean over the joint that is locked")
    blocks: list[Block] = [
        Picture(
            figures.svg(figure, "laws", "How motions with a locked joint end, for each arm and law"),
            f"{motion_count} random motions of each arm, between places of the end effector at random configurations, each "
            f"with every joint "
            "locked in turn from the start. Not every target is in reach with a joint locked; undecided: at the time limit, or "
            "next to a singular configuration.",
        )
    ]
    table_rows: list[list[Cell]] = []
    for result in laws:
        reference = next(
            candidate
            for candidate in laws
            if candidate.labels["arm"] == result.labels["arm"] and candidate.labels["task"] == result.labels["task"]
        )
        improvement = None if result is reference else results.compare_convergence_cells(reference, result)
        gain_text = (
            "–"
            if improvement is None
            else f"{improvement.value:+.3f} ({improvement.low:+.3f} to {improvement.high:+.3f})".replace("-", "−")
        )
        joint = int(np.argmin([reach_interval.value for reach_interval in result.reaches[:-1]]))
        worst_text = f"{result.joints[joint] if joint < len(result.joints) else joint + 1}: {result.reaches[joint].value:.3f}"
        cells: list[Cell] = [
            _format_interval(result.mean_fraction),
            gain_text,
            worst_text,
            _format_interval(result.reaches[-1]),
            format_percent(result.in_reach),
        ]
        cells += [] if laws[0].touched is None else [format_percent(result.touched or 0.0)]
        table_rows.append(
            [
                _prevent_line_break(result.labels["arm"]),
                _prevent_line_break(result.labels["law"]),
                result.labels["task"],
                *cells,
            ]
        )
    header = ["Arm", "law", "task", "converges", "gain over the first law", "worst joint", "converges, none locked", "in reach"]
    header += [] if laws[0].touched is None else ["touches something, at most"]
    caption = (
        "95 % intervals. The gain is paired: both laws have the same motions. In reach: runs with a locked joint in which a "
        "configuration at the target exists."
    )
    return [*blocks, Table(table_rows, header, frozenset({3, 4, 6, 7, 8}), caption=caption, wide=True)]


def _build_measure_blocks(
    study: Study, job: str, read: Callable[[Study, int], results.MeasureTable | None], noun: str, unit: str
) -> list[Block]:
    measured = [table for table in _read_results(study, job, read) if table is not None]
    if not measured:
        return []
    measure_names = list(measured[0].values)
    table_rows: list[list[Cell]] = []
    for table in measured:
        cells: list[Cell] = [
            _prevent_line_break(table.labels["arm"]),
            _prevent_line_break(table.labels["law"]),
            f"{table.samples:,}",
        ]
        for name in measure_names:
            value, lower, upper = table.values[name]
            interval_text = "" if np.isnan(lower) else f"{lower:.1f} to {upper:.1f}"
            cells.append(_stack_lines(["–" if np.isnan(value) else f"{value:.1f}", *[interval_text] * bool(interval_text)]))
        table_rows.append(cells)
    caption = f"{unit.capitalize()}, with 95 % intervals; of an arbitrary joint."
    return [
        Table(
            table_rows,
            ["Arm", "law", noun, *measure_names],
            frozenset(range(2, 3 + len(measure_names))),
            caption=caption,
            wide=True,
        )
    ]


# ---- how ---------------------------------------------------------------------------------------------------------------


def _build_provenance_blocks(study: Study, assessed: Sequence[AssessedCell]) -> list[Block]:
    cells = study.status()
    samples = sum(cell.rows_done for cell in cells)
    processor_time, wall_time = sum(cell.seconds for cell in cells), sum(finished_run["seconds"] for finished_run in study.runs)
    size = sum(results.stored_size_bytes(study.cell_store(k)) for k in range(len(cells)) if study.cell_folder(k).exists())
    entries = [
        ("Study", f"{study.name}, seed {study.seed}, digest {study.digest}"),
        (
            "Cells",
            f"{len(cells):,}, {sum(cell.chunks_done for cell in cells):,} of {sum(cell.chunks for cell in cells):,} chunks",
        ),
        ("Samples", f"{samples:,} rows (poses, motions, starts) in all"),
        (
            "Time",
            f"{format_duration(processor_time)} of processor time to compute; runs that ended took "
            f"{format_duration(wall_time)}",
        ),
        ("On the disk", f"{size / 1e6:.3g} MB"),
    ]
    for position, run in enumerate(study.runs[-5:]):
        run_text = f"{run['started']}: {run['chunks']:,} chunks in {format_duration(run['seconds'])} on {run['on']}"
        entries.append(("Runs" if not position else "", run_text))
    for position, maker in enumerate(study.makers):
        versions = ", ".join(f"{k} {v}" for k, v in maker["versions"].items())
        entries.append(("Computed on" if not position else "", f"{maker['processor']}; Python {maker['python']}, {versions}"))
    if len(study.makers) > 1:
        entries.append(("Agreement", "computed on one of these alone, values agree to 1e-12; on one kind, in every bit"))
    for region in dict.fromkeys((entry.labels["arm"], entry.plan.region.describe()) for entry in assessed):
        entries.append((f"Region of {region[0]}", region[1]))
    entries.append(
        ("Intervals", "95 %: exact (Clopper-Pearson) for fractions of poses; betting for means over motions; DKW for curves")
    )
    return [Table([[k, v] for k, v in entries])]


def _build_rerun_blocks(study: Study) -> list[Block]:
    blocks: list[Block] = [Text("Same file, same versions, same kind of processor: the same bits.", quiet=True)]
    if study.source:
        lines = [line for line in study.source.splitlines() if line.strip() and not line.lstrip().startswith("#")]
        commands = [
            Code("holdfast study run study.yaml --out DIR"),
            Code("\n".join(lines), Markup("with <code>study.yaml</code>:")),
        ]
        return [*commands, *blocks]
    return blocks
