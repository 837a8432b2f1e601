"""That a tool path cannot be followed: a pose of it, or the way along a straight leg."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from holdfast.arm.task import Task
from holdfast.enclosure import parted
from holdfast.errors import TaskError
from holdfast.failures import Degraded
from holdfast.recovery.continuation import RestOfPath
from holdfast.recovery.proofs.reach import BOXES, EXACT, Tolerance, blocked_in, every_clear, nothing_within, unreachable
from holdfast.recovery.question import broken_by
from holdfast.recovery.recovery import Recovery
from holdfast.recovery.rows import RowSolver
from holdfast.recovery.space import Space

if TYPE_CHECKING:
    from holdfast.paths.path import Path

_PROVED = 3  # poses of a path, of which no configuration was found, that are tried to be proved to have none


def proved_of_path(made: Recovery, rest: RestOfPath, path: Path, *, solver: RowSolver, space: Space) -> Recovery:
    """The same with a proof that the path cannot be followed, if there is one, and whether it holds within the tolerance.

    Args:
        made: The recovery, as far as it is known.
        rest: What became of the path.
        path: To be followed.
        solver: Of the rows that count.
        space: Where the arm may be.
    """
    share, found, poses = rest.share, rest.found, path.pose(rest.share)
    order = list(telling_first(len(poses)))
    hardest = [k for k in order if not found[k]][:_PROVED]
    asked, at = (made.degraded, made.task), np.where(space.free, made.at, made.degraded.lo)
    broken = ((k, broken_by(made.keep, solver.rows, poses[k]) or None) for k in order)
    tried = ((k, unreachable(solver, space.free, at, poses[k])) for k in order)
    boxes = ((k, every_clear(made, solver, space, poses[k : k + 1])[2][0]) for k in hardest)
    known = next(((k, proof) for k, proof in chain(broken, tried, boxes) if proof is not None), None)
    if known is not None:
        hardest = list(dict.fromkeys([known[0], *hardest]))
        place = f"at {100 * share[known[0]]:.1f} % of the tool path"
        kept = broken_by(made.keep, solver.rows, poses[known[0]])
        pose = None if kept else poses[known[0]]
        made = replace(made, proof=f"{place} {known[1]}", proof_kind="a pose of the path", proved_pose=pose)
    else:
        leg = _parted_leg(*asked, path, space)
        if leg is None:
            return made
        made = replace(made, proof=leg, proof_kind="disconnected")
    within = made.tolerance
    if within is None:
        return made
    told = any(nothing_within(*asked, poses[k], space, within) for k in hardest) or _parted_leg(*asked, path, space, within)
    return replace(made, proved_within=bool(told))


def telling_first(count: int) -> Iterator[int]:
    """0 to count - 1, those first that most often tell: the last, the first, the middle, quarters, eighths, ..."""
    seen, parts = set[int](), 1
    while len(seen) < count:
        for k in [count - 1, 0] if parts == 1 else [round(i * (count - 1) / parts) for i in range(1, parts, 2)]:
            if k not in seen:
                seen.add(k)
                yield k
        parts *= 2


def _parted_leg(degraded: Degraded, task: Task, path: Path, space: Space, tolerance: Tolerance = EXACT) -> str | None:
    """A sentence that proves that no continuous motion follows a tool path; None if that is proved of no straight leg.

    Each leg gets half of the time that is left.
    """
    limits = degraded.lo, degraded.hi
    if not np.isfinite(limits).all():  # joints that turn round and round join what boxes do not
        return None
    straight = path.shift.any(axis=1) & ~path.sweep.any(axis=1) & ~path.turn.any(axis=1)
    for k in np.flatnonzero(straight).tolist():
        try:
            boxes = parted(
                degraded.arm,
                task,
                path.starts[k],
                way=path.shift[k],
                limits=limits,
                tolerance=tolerance,
                time_limit=space.seconds_left / 2,
                most_boxes=BOXES,
                blocked=blocked_in(space),
            )
        except TaskError:
            return None
        if boxes is not None:
            begin, end = 100 * path.bounds[k : k + 2]
            return (
                f"from {begin:.4g} to {end:.4g} % of the tool path no continuous motion leads through its poses: {boxes:,} "
                "boxes of joints that may hold a configuration do not join its ends, up to floating point"
            )
    return None
