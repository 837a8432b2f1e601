"""Presentation of a study: its progress, and its report with the ranking of arms and laws."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from markupsafe import Markup

from holdfast.core.errors import StoreError
from holdfast.core.formatting import format_count, format_duration, list_alternatives
from holdfast.core.progress import reports_progress
from holdfast.core.sweeps.study import Study
from holdfast.core.sweeps.study_merge import MergeReport
from holdfast.interface.presentation.presentation import Notice, Presentation, TableSpec
from holdfast.interface.presentation.renderers import build_page, format_versions
from holdfast.interface.presentation.studies.answer import compose_answer, get_index_key, list_leaders, read_cells
from holdfast.interface.presentation.studies.sections import build_sections
from holdfast.interface.report import page
from holdfast.interface.report.page import Block, Code, Text
from holdfast.studies.assessment.plan import AssessmentPlan
from holdfast.studies.assessment.single_points import Structure, structure
from holdfast.studies.study_files import results
from holdfast.studies.study_files.ranking import Ended, Key, make_structure_key, rank_arms
from holdfast.studies.study_files.results import AssessedCell
from holdfast.studies.study_files.study_file import read_thresholds

_MAX_TABLE_CELLS = 40  # combinations (cells of the study) in a table


def to_dict(study: Study) -> dict[str, Any]:
    """Return the progress of a study, cell by cell, as JSON data."""
    cells = study.status()
    return {
        "folder": str(study.path),
        "name": study.name,
        "seed": study.seed,
        "digest": study.digest,
        "complete": all(cell.is_complete for cell in cells),
        "chunks": sum(cell.chunks for cell in cells),
        "chunks_done": sum(cell.chunks_done for cell in cells),
        "thread_seconds": sum(cell.seconds for cell in cells),
        "cells": [
            {attribute: getattr(cell, attribute) for attribute in ("name", "chunks", "chunks_done", "rows", "rows_done")}
            for cell in cells
        ],
        "made_by": study.makers,
    }


def present(result: Study | MergeReport) -> Presentation:
    """Present the progress of a study, or the chunks that a merge of its folders added."""
    return _present_merge(result) if isinstance(result, MergeReport) else _present_progress(result)


def _present_progress(study: Study) -> Presentation:
    """Present the progress of a study; if there are many cells, the table lists only those that are not complete."""
    cells = study.status()
    done, total = sum(cell.chunks_done for cell in cells), sum(cell.chunks for cell in cells)
    state = "complete" if done == total else f"{100 * done / total:.1f} %" if total else "empty"
    spent = format_duration(sum(cell.seconds for cell in cells))
    listed_cells = [cell for cell in cells if not cell.is_complete] if len(cells) > _MAX_TABLE_CELLS else cells
    is_cut = len(listed_cells) > _MAX_TABLE_CELLS
    columns = ["cell", "rows", "chunks", "processor time"]
    rows = [
        (
            cell.name,
            f"{cell.rows_done:,} of {cell.rows:,}",
            f"{cell.chunks_done:,} of {cell.chunks:,}",
            format_duration(cell.seconds),
        )
        for cell in listed_cells[:_MAX_TABLE_CELLS]
    ]
    title = f"{_MAX_TABLE_CELLS} of {len(listed_cells)} cells that are not complete" if is_cut else ""
    answer = f"{study.name} ({study.path}): {done:,} of {total:,} chunks, {state}, {spent} of processor time"
    return Presentation(study.name, answer, tables=[TableSpec(title, columns, rows)])


def _present_merge(merge: MergeReport) -> Presentation:
    """Present the added and the existing chunks, the machines, and the progress of the study."""
    lines = []
    if merge.close:
        lines.append(f"{merge.close} chunks already existed and agree to 1e-12.")
    if merge.apart:
        cell, chunk = merge.apart[0]
        lines.append(
            f"{len(merge.apart)} chunks already existed with different values (first: chunk {chunk + 1} of '{cell}'); those of "
            f"'{merge.study.path}' were not replaced."
        )
    for maker in merge.study.makers:
        lines.append(f"Computed on {maker['processor']}: Python {maker['python']}, {format_versions(maker['versions'])}.")
    if len(merge.study.makers) > 1:
        lines.append("Versions or processors differ: values agree with those of a single machine to 1e-12, not bit for bit.")
    progress = _present_progress(merge.study)
    answer = f"{merge.study.path}: {merge.added} chunks added; {merge.both} already existed and are identical bit for bit"
    return replace(progress, answer=answer, lines=[*lines, progress.answer])


@reports_progress("drawing the report")
def write(study: Study, path: Path, command: str = "") -> Path:
    """Write the report of a study, complete or not; the report contains the file and the command that repeat the study.

    Raises:
        StoreError: No chunk has been computed, a chunk is damaged, or the file cannot be written.
    """
    return page.write(build_page(present_results(study), command), path)


def save(study: Study, folder: Path, command: str = "") -> list[Path]:
    """Write the report into a folder."""
    return [write(study, folder / "report.html", command)]


def present_results(study: Study) -> Presentation:
    """Present the results: the best arm and law, with the reasons.

    Raises:
        StoreError: No chunk has been computed, or a chunk is damaged.
    """
    cells = study.status()
    chunks_done, chunk_count = sum(item.chunks_done for item in cells), sum(item.chunks for item in cells)
    if not chunks_done:
        raise StoreError(f"nothing of '{study.path}' is computed yet; run the study first")
    assessed = read_cells(study, "assess", results.read_assessment)
    laws = [result for result in read_cells(study, "convergence", results.read_convergence) if result is not None]
    sweeps = [item for item in read_cells(study, "designs", results.read_design_sweep) if item is not None]
    limits, fatal_structures = _choose_thresholds(study, assessed), find_fatal_structures(assessed)
    ranking = rank_arms(
        assessed,
        laws,
        limits,
        {key: _format_fatal_joints(job_plan, item) for key, (job_plan, item) in fatal_structures.items()},
    )
    missing = f"{chunks_done:,} of {chunk_count:,} chunks have been computed. Repeat the command to resume."
    arm_names = list(dict.fromkeys(cell["labels"]["arm"] for cell in study.cells))

    return Presentation(
        study.name,
        compose_answer(ranking, sweeps, has_rankings=bool(assessed or laws or not sweeps)),
        about=f"A study of {format_count(len(arm_names), 'arm')}: {', '.join(arm_names)}",
        notices=[Notice(missing, "bad", "Not complete")] if chunks_done < chunk_count else [],
        facts=list_leaders(ranking),
        sections=partial(build_sections, study, assessed, laws, sweeps, limits, fatal_structures, ranking),
        method=_list_method(study, assessed),
        again=partial(_build_rerun_blocks, study),
    )


def _choose_thresholds(study: Study, assessed: Sequence[AssessedCell]) -> dict[Key, float]:
    """Return the threshold of each index and task from the study file, or else one chosen from the results."""
    specified = read_thresholds(study.source)
    groups: dict[Key, list[AssessedCell]] = {}
    for entry in assessed:
        groups.setdefault(get_index_key(entry), []).append(entry)
    return {key: specified.get(key[0], results.choose_threshold(group)) for key, group in groups.items()}


def find_fatal_structures(assessed: Sequence[AssessedCell]) -> dict[Ended, tuple[AssessmentPlan, Structure]]:
    """Return the structure, with its plan, of each arm and task that some lock makes singular in every configuration."""
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


def _format_fatal_joints(plan: AssessmentPlan, analysis: Structure) -> str:
    """Name the joints whose lock makes a task singular in every configuration."""
    return list_alternatives([plan.arm.joint_names[joint] for joint in analysis.fatal]) if analysis.fatal else "any joint"


def _list_method(study: Study, assessed: Sequence[AssessedCell]) -> list[tuple[str, str]]:
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
        ("Samples", f"{samples:,} rows (poses, motions, starts)"),
        ("Time", f"{format_duration(processor_time)} of processor time; completed runs took {format_duration(wall_time)}"),
        ("Size on disk", f"{size / 1e6:.3g} MB"),
    ]
    for position, run in enumerate(study.runs[-5:]):
        run_text = f"{run['started']}: {run['chunks']:,} chunks in {format_duration(run['seconds'])} on {run['on']}"
        entries.append(("Runs" if not position else "", run_text))
    for position, maker in enumerate(study.makers):
        text = f"{maker['processor']}; Python {maker['python']}, {format_versions(maker['versions'])}"
        entries.append(("Computed on" if not position else "", text))
    if len(study.makers) > 1:
        text = "values agree with those of a single machine to 1e-12; machines of one kind agree bit for bit"
        entries.append(("Agreement", text))
    for region in dict.fromkeys((entry.labels["arm"], entry.plan.region.describe()) for entry in assessed):
        entries.append((f"Region of {region[0]}", region[1]))
    entries.append(
        ("Intervals", "95 %: exact (Clopper-Pearson) for fractions of poses; betting for means over motions; DKW for curves")
    )
    return entries


def _build_rerun_blocks(study: Study) -> list[Block]:
    blocks: list[Block] = [Text("The same file, versions and kind of processor give the same bits.", quiet=True)]
    if study.source:
        lines = [line for line in study.source.splitlines() if line.strip() and not line.lstrip().startswith("#")]
        commands = [
            Code("holdfast study run study.yaml --out DIR"),
            Code("\n".join(lines), Markup("with <code>study.yaml</code>:")),
        ]
        return [*commands, *blocks]
    return blocks
