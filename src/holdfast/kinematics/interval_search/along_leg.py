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

_BOX_WIDTHS = (0.2, 0.1, 0.05, 0.025, 0.0125)  # rad and m: approximate sizes of the boxes that are joined
_MAX_JOINED_BOXES = 20_000  # maximum number of boxes
_MAX_GROWTH = 4  # ratio of the numbers of boxes of two sizes above which they fill a region that smaller ones hardly divide
_MIN_JOINED_BOXES = 1000  # boxes of the larger size below which this ratio counts from this number
_MAX_NEIGHBOR_PAIRS = 10_000_000  # approximate maximum number of pairs of boxes that may touch
_COUNTED_BOXES = 200  # boxes from whose neighbors that number is estimated
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
    """Prove that no continuous motion follows a straight leg of a path from end to end, for any start configuration.

    Boxes cover the configurations of all poses of the leg, each with its position on the leg. A motion along the leg, also one
    that temporarily reverses, stays within these boxes and passes through touching boxes from the beginning to the end. If no
    chain of touching boxes connects both ends, there is no motion; otherwise the boxes of the chains are bisected.

    Args:
        arm: Arm model.
        task: Task whose rows are met along the whole leg with the same target orientation.
        pose: (4, 4) pose of the end effector at the beginning of the leg, world, m.
        way: (3,) vector from the beginning to the end of the leg, m.
        limits: (n,) lower and (n,) upper limits, finite, rad and m; equal for a locked joint.
        tolerance: Allowed error of each row, m and rad; the proof covers all poses within it.
        time_limit: Time limit, s; the search then ends without a proof.
        most_boxes: Maximum number of boxes; the search then ends without a proof.
        blocked: Function of boxes as for :func:`holdfast.all_configurations`.

    Returns:
        Number of boxes that the proof took, up to floating point; None without a proof.

    Raises:
        TaskError: No bounds exist for the task, or the pose is tilted out of the plane of a planar arm.

    Source: derived here; bounds of ``holdfast/kinematics/interval_search/box_bounds.py``.
    """
    deadline, leg_vector = time.perf_counter() + time_limit, np.asarray(way, dtype=np.float64)
    contractor = BoxContractor(
        arm, task, np.asarray(pose, dtype=np.float64), tolerance=tolerance, limits=limits, blocked=blocked, way=leg_vector
    )
    weights = np.append(np.ones(arm.n), np.linalg.norm(leg_vector))
    open_boxes = np.stack([(contractor.low + contractor.high) / 2, (contractor.high - contractor.low) / 2])[None]
    max_count = _MAX_JOINED_BOXES
    with report_work("halving boxes along the leg") as advance:
        for width in _BOX_WIDTHS:
            small_boxes, stack, small_count = [open_boxes[:0]], [open_boxes], 0
            while stack:
                if time.perf_counter() > deadline or contractor.checked >= most_boxes or small_count > max_count:
                    return None
                contracted = contractor.drop_blocked(contractor.contract(contractor.pop_batch(stack)))
                advance(contractor.checked, most_boxes)
                is_small = (2 * contracted.box[:, 1] * weights).max(axis=1, initial=0.0) < width
                small_boxes.append(contracted.box[is_small])
                small_count += int(is_small.sum())
                halves = contracted[~is_small].bisect()
                if len(halves):
                    stack.append(halves)
            open_boxes = np.concatenate(small_boxes)
            chained = _connected_to_both_ends(open_boxes)
            if chained is None:
                return None
            open_boxes = open_boxes[chained]
            max_count = min(_MAX_JOINED_BOXES, _MAX_GROWTH * max(len(open_boxes), _MIN_JOINED_BOXES))
            if not len(open_boxes):
                return contractor.checked
    return None


def _connected_to_both_ends(boxes: FloatArray) -> BoolArray | None:
    """Return (N,) True for boxes (N, 2, n) in a chain of touching boxes from value 0 to value 1 of the last joint.

    The result is None if too many boxes touch.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    if not len(boxes):
        return np.zeros(0, dtype=bool)
    centers, half_widths = boxes[:, 0], boxes[:, 1]
    widest = half_widths.max(axis=0) + _CONTACT_TOLERANCE  # of each joint: touching boxes are at most this far apart
    tree, neighbor_distance = cKDTree(centers / widest), 2.0
    counted = centers[:: len(centers) // _COUNTED_BOXES + 1] / widest
    neighbor_counts = tree.query_ball_point(counted, neighbor_distance, p=np.inf, return_length=True)
    if neighbor_counts.mean() * len(centers) > 2 * _MAX_NEIGHBOR_PAIRS:
        return None
    first, second = tree.query_pairs(neighbor_distance, p=np.inf, output_type="ndarray").T
    for center_values, widths in zip(centers.T, half_widths.T, strict=True):  # joint by joint, because there are many pairs
        touching = np.abs(center_values[first] - center_values[second]) <= widths[first] + widths[second] + _CONTACT_TOLERANCE
        first, second = first[touching], second[touching]
    _, label = connected_components(coo_array((np.ones(len(first)), (first, second)), shape=(len(boxes),) * 2), directed=False)
    begins = centers[:, -1] - half_widths[:, -1] <= _CONTACT_TOLERANCE
    ends = centers[:, -1] + half_widths[:, -1] >= 1 - _CONTACT_TOLERANCE
    return np.asarray(np.isin(label, np.intersect1d(label[begins], label[ends])))
