"""Assessments: sample, solve, evaluate, and count poses of a region, in memory or chunk by chunk in a folder."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from holdfast.core.errors import InputError, StoreError
from holdfast.core.files import reading
from holdfast.core.progress import reports_progress
from holdfast.core.sweeps.folder import STUDY_FILE, own_study_folder
from holdfast.core.sweeps.store import Store
from holdfast.core.sweeps.study import Study
from holdfast.core.typing import Rows
from holdfast.core.validation import check_arguments
from holdfast.kinematics.indices.index import Index, by_name
from holdfast.kinematics.regions.region import Region, Sampling, default_region
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike
from holdfast.studies.assessment.assessment import Assessment
from holdfast.studies.assessment.bins import merge_chunk_counts
from holdfast.studies.assessment.block import compile_plan
from holdfast.studies.assessment.plan import AssessmentPlan, make_plan
from holdfast.studies.assessment.rows import AssessmentTally, Progress, compute_blocks, compute_chunks, describe_provenance

_MAX_ROWS_IN_MEMORY = 2_000_000  # default limit of rows kept in memory
_MAX_NAMED_CELLS = 4  # cells of a study that a message names


@check_arguments
@reports_progress("assessing poses")
def assess(
    arm: Arm,
    region: Region | None = None,
    index: Index | str = "relative-manipulability",
    *,
    poses: int | None = None,
    seed: int = 0,
    sampling: Sampling = "random",
    restarts: int = 100,
    store: str | Path | None = None,
    keep: bool | None = None,
    progress: Progress | None = None,
    task: str | Task | Sequence[str] | None = None,
    optimise: bool = False,
    after_lock: bool = False,
    locked: Mapping[str | int, float] | None = None,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    margin: float = 0.0,
) -> Assessment:
    """Compute the distribution of an index over a region.

    Each pose is solved by inverse kinematics from random starts. The configuration that is found is evaluated (the paper's
    non-optimised sample), and on request also the best configuration of the pose (the optimised sample). The configurations of
    a region of joints are evaluated directly.

    Args:
        arm: The arm.
        region: Region of the poses or configurations. Default: that of the paper for its arm, else a box around the arm's home.
        index: Index of the arm, or its name.
        poses: Number of poses. Default: 2000, or all poses of a list once; see :meth:`Region.from_poses`.
        seed: Seed of all random numbers. The result does not depend on the number of threads or chunks.
        sampling: ``random``, or ``sobol`` (scrambled; best with a power of two of poses).
        restarts: Number of random starts after which a pose counts as not reached.
        store: Folder for the results, which are written chunk by chunk; an existing folder of the same run is continued.
        keep: True to keep every row in memory. Default: True for at most two million rows without a store.
        progress: Function that is called with (poses done, poses in all).
        task: Task of the index. Default: ``pose``, or the task of the given index, which it must equal.
        optimise: True to find also the best configuration of each pose; see :func:`holdfast.optimise`.
        after_lock: True to find also the poses that are reached after each joint has locked; see :meth:`Assessment.survival`.
        locked: Values at which joints lock, as ``{joint: value}``, rad or m, by name or index from 0. With ``after_lock`` the
            other joints lock at their values for another pose; otherwise they are omitted.
        clearance: Clearance of the arm from itself, which the best configurations keep; the number of violations is counted.
            True: capsules of an assumed radius along the links (:meth:`holdfast.Capsules.along_links`). False: the arm may
            collide with itself. Default: True when optimising, except for a planar arm, whose links lie next to each other.
        cell: Objects around the arm, or their file. Configurations that touch them are counted; the best configurations and
            those after a lock are collision-free. Self-collisions are then checked, too, except for a planar arm and with
            ``clearance=False``.
        margin: Smallest clearance of the best configurations, m; for an object, in addition to the margin of the cell.

    Raises:
        InputError: Options are out of range, the index is of another arm or task, the clearance is of another arm, or the cell
            cannot be read, does not fit the arm, or has files that changed during the run.
        TaskError: The arm is not redundant for the task, or the index cannot be optimised.
        StoreError: The folder cannot be used; committed chunks are not lost.
        KeyboardInterrupt: The run was interrupted; committed chunks remain, and the same call resumes.

    Source: Abdi et al. 2012, sections IV and V.
    """
    if isinstance(index, str):
        index = by_name(index, arm, "pose" if task is None else task)
    elif task is not None:
        index_task, requested_task = index.task, as_task(arm, task)
        if not index_task.same_rows(requested_task) or (isinstance(task, Task) and index_task.length != requested_task.length):
            raise InputError(
                f"the index is for task {index_task.describe()}, but task is {requested_task.describe()}; make the index with "
                "the task to assess, or leave task out"
            )
    region = default_region(arm) if region is None else region
    plan = make_plan(arm, region, index, poses, seed, sampling, restarts, optimise, after_lock, locked, clearance, margin, cell)
    start_time = time.monotonic()
    keep = (store is None and plan.poses <= _MAX_ROWS_IN_MEMORY) if keep is None else keep
    folder = None if store is None else plan.create_store(Path(store))
    compile_plan(plan)
    tally = AssessmentTally(plan)
    kept_rows: list[Rows] = []

    def add_rows(rows: Rows) -> None:
        tally.add(rows)
        if keep:
            kept_rows.append(rows)

    if folder is None:
        for start, rows in compute_blocks(plan, 0, plan.poses):
            add_rows(rows)
            if progress is not None:
                progress(start + len(rows["status"]), plan.poses)
    else:
        with folder.lock_for_writing():
            was_complete = folder.is_complete
            folder.commit_missing(lambda missing: compute_chunks(folder, plan, missing), progress)
            if not was_complete:
                earlier_seconds = folder.notes.get("seconds") or 0.0
                folder.add_notes(**describe_provenance(earlier_seconds + time.monotonic() - start_time))
        for rows in folder.read_all_checked():
            add_rows(rows)
    if plan.cell is not None:
        plan.cell.require_unchanged()
    merged = {name: np.concatenate([block[name] for block in kept_rows]) for name in kept_rows[0]} if kept_rows else None
    return _make_assessment(plan, tally, folder, time.monotonic() - start_time, True, merged)


@check_arguments
def load(path: str | Path) -> Assessment:
    """Read the assessment in a results folder, or in the folder of a study or of one of its cells.

    The assessment of a stopped run contains the committed poses. A study with ``keep: counts`` has distributions in bins and no
    rows. A study with several cells has several assessments, each in a separate folder.

    Args:
        path: Folder of ``--out`` of ``holdfast assess`` or ``holdfast study run``, or a folder in ``cells`` of a study.

    Raises:
        StoreError: The folder is not the results folder of an assessment, is damaged, or is a study of several cells, which
            the message names.
    """
    return read_assessment_store(Store.open(_find_cell_folder(Path(path))))


def read_assessment_store(store: Store) -> Assessment:
    """Read the assessment in an open results folder; see :func:`load`."""
    kind = store.plan.get("kind")
    if kind == "assess-counts":
        return _read_counts(store)
    if kind != "assess":
        raise StoreError(f"'{store.path}' is not an assessment; give the folder that `holdfast assess --out` wrote")
    plan = AssessmentPlan.from_store(store, store.rows)
    tally = AssessmentTally(plan)
    for rows in store.read_all_checked():
        tally.add(rows)
    return _make_assessment(plan, tally, store, store.notes.get("seconds"), store.is_complete, None)


def _find_cell_folder(folder: Path) -> Path:
    """Return the folder of the only cell of a study; return any other folder unchanged."""
    if not reading.path_exists(folder / STUDY_FILE):
        return folder
    study = Study.open(folder)
    if len(study.cells) == 1:
        return study.cell_folder(0)
    cells = [f"'{study.cell_folder(number)}'" for number in range(min(len(study.cells), _MAX_NAMED_CELLS))]
    more_text = f" or one of {len(study.cells) - len(cells)} more" if len(study.cells) > len(cells) else ""
    raise StoreError(f"'{folder}' is a study of {len(study.cells)} cells; load one of them: {', '.join(cells)}{more_text}")


def _read_counts(store: Store) -> Assessment:
    """Return the assessment of a cell of a study that kept counts instead of rows."""
    parent = own_study_folder(store.path)
    rows_by_cell = {} if parent is None else {cell["name"]: cell["rows"] for cell in Study.open(parent).cells}
    one_pose_plan = AssessmentPlan.from_store(store, 1, rows=False)
    parts = merge_chunk_counts(one_pose_plan.index, one_pose_plan.optimise, store.read_all_checked())
    samples = int(parts[0][0].facts[:2].sum())
    plan = replace(one_pose_plan, poses=max(rows_by_cell.get(store.path.resolve().name, samples), 1))
    best_counts = parts[1] if plan.optimise else None
    return Assessment(
        plan=plan,
        distribution=parts[0][0].finish(),
        worst_counts=parts[0][1],
        optimised=None if best_counts is None else best_counts[0].finish(),
        optimised_worst_counts=None if best_counts is None else best_counts[1],
        seconds=sum(entry.seconds for entry in store.entries.values()),
        complete=store.is_complete,
    )


def _make_assessment(
    plan: AssessmentPlan, tally: AssessmentTally, store: Store | None, seconds: float | None, complete: bool, rows: Rows | None
) -> Assessment:
    best_statistics = tally.optimised
    return Assessment(
        plan=plan,
        distribution=tally.unoptimised.finish(),
        worst_counts=tally.unoptimised.worst_counts,
        optimised=None if best_statistics is None else best_statistics.finish(),
        optimised_worst_counts=None if best_statistics is None else best_statistics.worst_counts,
        survivors=tally.survivors,
        collisions=tally.collisions,
        clear=tally.clear,
        store=store,
        seconds=seconds,
        complete=complete,
        _rows=rows,
    )
