"""Draw poses in a region, solve, evaluate, count: in memory or chunk by chunk into a folder."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task
from holdfast.assessment.assessment import Assessment
from holdfast.assessment.bins import add_chunks
from holdfast.assessment.block import compile_for
from holdfast.assessment.plan import Plan, Rows, make_plan
from holdfast.assessment.rows import Progress, Tally, blocks, fill, provenance, stored
from holdfast.clearance.choice import CellLike
from holdfast.clearance.clearance import Clearance
from holdfast.engine.store import Store
from holdfast.engine.study import STUDY_FILE, Study
from holdfast.errors import InputError, StoreError
from holdfast.files import reading
from holdfast.indices.index import Index, by_name
from holdfast.notice import says
from holdfast.regions.region import Region, Sampling, default_region

_KEEP = 2_000_000  # rows held in memory unless asked otherwise
_NAMED_CELLS = 4  # of a study, in a message


@checked
@says("assessing poses")
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
    """The distribution of an index over a region.

    Each pose is solved by inverse kinematics from random starts; the configuration found is evaluated as it is (the
    paper's non-optimised sample) and, if asked for, the best configuration of the pose as well (the optimised sample).
    A region of joints is evaluated directly.

    Args:
        arm: The arm.
        region: Which poses, or configurations. Default: that of the paper for its arm, else a box around the arm's home.
        index: An index of that arm, or its name.
        poses: Number of poses. Default: 2000, or of a list of poses each once; see :meth:`Region.from_poses`.
        seed: The same seed gives the same result, whatever the number of threads or chunks.
        sampling: ``random``, or ``sobol`` (scrambled; a power of two of poses is best).
        restarts: Random starts per pose before it counts as not reached.
        store: Folder for the results, written chunk by chunk; an existing folder of the same run is continued.
        keep: Hold every row in memory. Default: if there are no more than two million and there is no store.
        progress: Called with (poses done, poses in all).
        task: Of the index, ``pose`` if not given. An index that is given has its own, and this must be the same.
        optimise: Also find the best configuration of each pose; see :func:`holdfast.optimise`.
        after_lock: Also find which poses can still be reached once each joint has locked; see :meth:`Assessment.survival`.
        locked: ``{joint: value}``, rad or m, by name or index from 0, where these joints lock. The others lock where they were
            at another pose if ``after_lock``, and are left out if not.
        clearance: Of the arm from itself. The best configurations keep it, and how many would not is counted. True: capsules
            of an assumed radius along the links (:meth:`holdfast.Capsules.along`); False: the arm may collide with itself.
            Default: True when optimising, but for an arm that moves in a plane, whose links lie beside each other.
        cell: Objects around the arm, or their file. Configurations that touch them are counted, the best ones keep clear of
            them, and so do those that reach a pose after a lock. The arm's own links are then looked at as well, but for an
            arm that moves in a plane and with ``clearance=False``.
        margin: Smallest clearance of the best configurations, m; from an object beyond what the cell keeps from it.

    Raises:
        InputError: Options out of range, or an index of another arm or task, or a clearance of another arm, or a cell that
            cannot be read, does not fit the arm, or whose files changed while the run was under way.
        TaskError: The arm is not redundant for the task, or the index cannot be optimised.
        StoreError: The folder cannot be used; nothing committed is lost.
        KeyboardInterrupt: Passed on after the chunk in hand; committed chunks stay, and the same call resumes.

    Source: Abdi et al. 2012, sections IV and V.
    """
    if isinstance(index, str):
        index = by_name(index, arm, "pose" if task is None else task)
    elif task is not None:
        own, other = index.task, as_task(arm, task)
        if not own.same_rows(other) or (isinstance(task, Task) and own.length != other.length):
            raise InputError(
                f"the index is for task {own.describe()}, asked for is {other.describe()}; make it with the task to assess, or "
                "leave task out"
            )
    region = default_region(arm) if region is None else region
    plan = make_plan(arm, region, index, poses, seed, sampling, restarts, optimise, after_lock, locked, clearance, margin, cell)
    begin = time.monotonic()
    keep = (store is None and plan.poses <= _KEEP) if keep is None else keep
    folder = None if store is None else plan.create(Path(store))
    compile_for(plan)
    tally = Tally(plan)
    kept: list[Rows] = []

    def take(rows: Rows) -> None:
        tally.add(rows)
        if keep:
            kept.append(rows)

    if folder is None:
        for start, rows in blocks(plan, 0, plan.poses):
            take(rows)
            if progress is not None:
                progress(start + len(rows["status"]), plan.poses)
    else:
        with folder.writing():
            was_complete = folder.complete
            fill(folder, plan, progress)
            if not was_complete:
                spent = folder.notes.get("seconds") or 0.0
                folder.note(**provenance(spent + time.monotonic() - begin))
        for rows in stored(folder, plan):
            take(rows)
    if plan.cell is not None:
        plan.cell.require_unchanged()
    merged = {name: np.concatenate([r[name] for r in kept]) for name in kept[0]} if kept else None
    return _finished(plan, tally, folder, time.monotonic() - begin, True, merged)


@checked
def load(path: str | Path) -> Assessment:
    """Read the assessment in a results folder, or in the folder of a study or of one of its cells.

    Of a run that was stopped it has what is there. A study that kept counts (``keep: counts``) has distributions in bins and no
    rows. A study with several cells has several assessments, each in a folder of its own.

    Args:
        path: What ``--out`` of ``holdfast assess`` or ``holdfast study run`` named, or a folder in ``cells`` of the latter.

    Raises:
        StoreError: Not a results folder of an assessment, or damaged, or a study of several cells; the message names them.
    """
    folder = _cell_of(Path(path))
    store = Store.open(folder)
    kind = store.plan.get("kind")
    if kind == "assess-counts":
        return _load_counted(store)
    if kind != "assess":
        raise StoreError(f"'{folder}' is not an assessment; give the folder that `holdfast assess --out` wrote")
    plan = Plan.stored(store, store.rows)
    tally = Tally(plan)
    for rows in stored(store, plan):
        tally.add(rows)
    return _finished(plan, tally, store, store.notes.get("seconds"), store.complete, None)


def _cell_of(folder: Path) -> Path:
    """Return the folder of the only cell of a study; any other folder as it is."""
    if not reading.exists(folder / STUDY_FILE):
        return folder
    study = Study.open(folder)
    if len(study.cells) == 1:
        return study.folder(0)
    cells = [f"'{study.folder(k)}'" for k in range(min(len(study.cells), _NAMED_CELLS))]
    more = f" or one of {len(study.cells) - len(cells)} more" if len(study.cells) > len(cells) else ""
    raise StoreError(f"'{folder}' is a study of {len(study.cells)} cells; load one of them: {', '.join(cells)}{more}")


def _load_counted(store: Store) -> Assessment:
    """Build the assessment of a study's cell that kept counts instead of rows."""
    parent = store.path.resolve().parents[1]
    sizes = {}
    if reading.exists(parent / STUDY_FILE):
        sizes = {cell["name"]: cell["rows"] for cell in Study.open(parent).cells}
    first = Plan.stored(store, 1, rows=False)
    parts = add_chunks(first.index, first.optimise, (store.checked(k) for k in store.done))
    samples = int(parts[0][0].facts[:2].sum())
    plan = replace(first, poses=max(sizes.get(store.path.resolve().name, samples), 1))
    best = parts[1] if plan.optimise else None
    return Assessment(
        plan=plan,
        distribution=parts[0][0].finish(),
        worst_counts=parts[0][1],
        optimised=None if best is None else best[0].finish(),
        optimised_worst_counts=None if best is None else best[1],
        survivors=None,
        collisions=None,
        clear=None,
        store=None,
        seconds=sum(entry.seconds for entry in store.entries.values()),
        complete=store.complete,
    )


def _finished(
    plan: Plan, tally: Tally, store: Store | None, seconds: float | None, complete: bool, rows: Rows | None
) -> Assessment:
    best = tally.optimised
    return Assessment(
        plan=plan,
        distribution=tally.found.finish(),
        worst_counts=tally.found.worst,
        optimised=None if best is None else best.finish(),
        optimised_worst_counts=None if best is None else best.worst,
        survivors=tally.survivors,
        collisions=tally.collisions,
        clear=tally.clear,
        store=store,
        seconds=seconds,
        complete=complete,
        _rows=rows,
    )
