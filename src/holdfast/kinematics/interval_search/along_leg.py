"""Proofs that no motion follows a straight leg of a path: no chain of joint boxes connects its ends."""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.progress import report_work, reports_progress
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.interval_search.boxes import Blocked, BoxContractor
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task

_BOX_WIDTHS = (0.2, 0.1, 0.05, 0.025, 0.0125)  # rad and m: boxes of about this size are joined
_MAX_JOINED_BOXES = 20_000  # boxes at most
_MAX_NEIGHBOR_PAIRS = 10_000_000  # of them, all together, at most
_CONTACT_TOLERANCE = 1e-12


@check_arguments
@reports_progress("looking for a way along a leg")
def prove_leg_impossible(
    arm: Arm,
    task: Task,
    pose: ArrayLike,
    *,
    way: ArrayLike,
    limits: tuple[FloatArray, FloatArray],
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

    Source: derived here; bounds of ``holdfast/kinematics/interval_search/box_bounds.py``.
    """
    deadline, leg_vector = time.perf_counter() + time_limit, np.asarray(way, dtype=np.float64)
    contractor = BoxContractor(
        arm, task, np.asarray(pose, dtype=np.float64), tolerance=tolerance, limits=limits, blocked=blocked, way=leg_vector
    )
    weights = np.append(np.ones(arm.n), np.linalg.norm(leg_vector))
    open_boxes = np.stack([(contractor.low + contractor.high) / 2, (contractor.high - contractor.low) / 2])[None]
    with report_work("halving boxes along the leg") as advance:
        for width in _BOX_WIDTHS:
            small_boxes, stack = [open_boxes[:0]], [open_boxes]
            while stack:
                if time.perf_counter() > deadline or contractor.checked >= most_boxes:
                    return None
                contracted = contractor.drop_blocked(contractor.contract(contractor.pop_batch(stack)))
                advance(contractor.checked, most_boxes)
                is_small = (2 * contracted.box[:, 1] * weights).max(axis=1, initial=0.0) < width
                small_boxes.append(contracted.box[is_small])
                halves = contracted[~is_small].bisect()
                if len(halves):
                    stack.append(halves)
            open_boxes = np.concatenate(small_boxes)
            if len(open_boxes) > _MAX_JOINED_BOXES:
                return None
            chained = _connected_to_both_ends(open_boxes)
            if chained is None:
                return None
            open_boxes = open_boxes[chained]
            if not len(open_boxes):
                return contractor.checked
    return None


def _connected_to_both_ends(boxes: FloatArray) -> BoolArray | None:
    """Return (N,) True for boxes (N, 2, n) in a chain of touching boxes from the last joint at 0 to the last joint at 1.

    None if too many touch.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    if not len(boxes):
        return np.zeros(0, dtype=bool)
    centers, half_widths = boxes[:, 0], boxes[:, 1]
    widest = half_widths.max(axis=0) + _CONTACT_TOLERANCE  # of each joint on its own: as near as boxes that touch must be
    tree, neighbor_distance = cKDTree(centers / widest), 2.0
    if tree.count_neighbors(tree, neighbor_distance, p=np.inf) > _MAX_NEIGHBOR_PAIRS:
        return None
    first, second = tree.query_pairs(neighbor_distance, p=np.inf, output_type="ndarray").T
    for center_values, widths in zip(centers.T, half_widths.T, strict=True):  # joint by joint: there are many pairs
        touching = np.abs(center_values[first] - center_values[second]) <= widths[first] + widths[second] + _CONTACT_TOLERANCE
        first, second = first[touching], second[touching]
    _, label = connected_components(coo_array((np.ones(len(first)), (first, second)), shape=(len(boxes),) * 2), directed=False)
    begins = centers[:, -1] - half_widths[:, -1] <= _CONTACT_TOLERANCE
    ends = centers[:, -1] + half_widths[:, -1] >= 1 - _CONTACT_TOLERANCE
    return np.asarray(np.isin(label, np.intersect1d(label[begins], label[ends])))
