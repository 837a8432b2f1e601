"""That no motion follows a straight leg of a path: the boxes that may hold configurations do not join its ends."""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.enclosure.boxes import Blocked, Boxes
from holdfast.notice import says, working

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_WIDTHS = (0.2, 0.1, 0.05, 0.025, 0.0125)  # rad and m: boxes of about this size are joined
_JOINED = 20_000  # boxes at most
_NEIGHBOURS = 10_000_000  # of them, all together, at most
_SLACK = 1e-12


@checked
@says("looking for a way along a leg")
def parted(
    arm: Arm,
    task: Task,
    pose: ArrayLike,
    *,
    way: ArrayLike,
    limits: tuple[Array, Array],
    tolerance: tuple[float, float] = (0.0, 0.0),
    time_limit: float = 10.0,
    most_boxes: int = 20_000_000,
    blocked: Blocked | None = None,
) -> int | None:
    """Prove that no continuous motion follows a straight leg of a path from end to end, wherever it begins.

    The configurations of all poses of the leg, each with its place on it, are covered by boxes. A motion along the leg, also
    one that turns back now and then, stays within them, from one that holds the beginning to one that holds the end, through
    boxes that touch. Where no chain of boxes does that, there is no motion; else those of the chains are halved.

    Args:
        arm: The arm.
        task: Whose rows are met all the way; the orientation wanted stays the same.
        pose: (4, 4) of the end effector where the leg begins, world, m.
        way: (3,) from there to its end, m.
        limits: (n,) and (n,), finite, rad and m; equal where a joint is locked.
        tolerance: m and rad by which each row may be missed: the proof is about all these.
        time_limit: s after which there is no proof.
        most_boxes: The same, of boxes.
        blocked: As of :func:`holdfast.all_configurations`.

    Returns:
        How many boxes the proof took, up to floating point; None without a proof.

    Raises:
        TaskError: A task about which nothing can be proved, or a pose tilted out of the plane of a planar arm.

    Source: derived here; bounds of ``holdfast/enclosure/box_bounds.py``.
    """
    until, shift = time.perf_counter() + time_limit, np.asarray(way, dtype=np.float64)
    boxes = Boxes(arm, task, np.asarray(pose, dtype=np.float64), tolerance=tolerance, limits=limits, blocked=blocked, way=shift)
    size = np.append(np.ones(arm.n), np.linalg.norm(shift))
    left = np.stack([(boxes.low + boxes.high) / 2, (boxes.high - boxes.low) / 2])[None]
    with working("halving boxes along the leg") as advance:
        for width in _WIDTHS:
            small, stack = [left[:0]], [left]
            while stack:
                if time.perf_counter() > until or boxes.looked_at >= most_boxes:
                    return None
                cut = boxes.clear(boxes.cut(boxes.taken(stack)))
                advance(boxes.looked_at, most_boxes)
                done = (2 * cut.box[:, 1] * size).max(axis=1, initial=0.0) < width
                small.append(cut.box[done])
                more = cut[~done].halved()
                if len(more):
                    stack.append(more)
            left = np.concatenate(small)
            if len(left) > _JOINED:
                return None
            chained = _through(left)
            if chained is None:
                return None
            left = left[chained]
            if not len(left):
                return boxes.looked_at
    return None


def _through(boxes: Array) -> Flags | None:
    """(N,) True for boxes (N, 2, n) in a chain of boxes that touch, from one with the last joint at 0 to one with it at 1.

    None if too many touch.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    if not len(boxes):
        return np.zeros(0, dtype=bool)
    centre, half = boxes[:, 0], boxes[:, 1]
    widest = half.max(axis=0) + _SLACK  # of each joint on its own: as near as boxes that touch must be
    tree, near = cKDTree(centre / widest), 2.0
    if tree.count_neighbors(tree, near, p=np.inf) > _NEIGHBOURS:
        return None
    i, j = tree.query_pairs(near, p=np.inf, output_type="ndarray").T
    for at, by in zip(centre.T, half.T, strict=True):  # joint by joint: there are many pairs
        met = np.abs(at[i] - at[j]) <= by[i] + by[j] + _SLACK
        i, j = i[met], j[met]
    _, label = connected_components(coo_array((np.ones(len(i)), (i, j)), shape=(len(boxes),) * 2), directed=False)
    begins, ends = centre[:, -1] - half[:, -1] <= _SLACK, centre[:, -1] + half[:, -1] >= 1 - _SLACK
    return np.asarray(np.isin(label, np.intersect1d(label[begins], label[ends])))
