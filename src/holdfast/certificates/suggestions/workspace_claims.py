"""Suggestion of a box that lies inside a sampled region, as the claim of a certificate."""

from __future__ import annotations

import numpy as np

from holdfast.certificates.claims import TolerantClaim, tolerant_claim
from holdfast.core.errors import InputError
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.workspace import TolerantWorkspace

_SEED_POINTS = 8
_STRETCH_ROUNDS = 3
_KEPT_FRACTION = 0.9  # fraction of each edge that is kept, because the space between points was not sampled


@check_arguments
def make_workspace_claim(workspace: TolerantWorkspace) -> TolerantClaim:
    """Make the claim that a box of points of a failure-tolerant workspace is tolerant, which ``certify`` can prove.

    The box is a large one without a sampled point outside the workspace. The artificial limits become the working ranges.

    Args:
        workspace: Workspace of :func:`holdfast.tolerant_workspace`.

    Raises:
        InputError: The task is neither position nor planar in the xy plane, or too few points are inside.
    """
    rows = workspace.task.rows
    if rows.shape[0] not in (2, 3) or not np.array_equal(rows, np.eye(6)[: len(rows)]):
        raise InputError(f"task is {workspace.task.name}; for a certificate of a box it must be position or planar")
    box = find_inner_box(workspace.points[:, : len(rows)], workspace.inside)
    if box is None:
        raise InputError("too few points are inside to suggest a box; sample more")
    ranges = dict[str | int, tuple[float, float]](enumerate(map(tuple, workspace.limits.tolist())))
    return tolerant_claim(workspace.arm, box.mean(axis=1), box[:, 1] - box[:, 0], working_ranges=ranges)


def find_inner_box(points: FloatArray, inside: BoolArray) -> FloatArray | None:
    """Find a large box with sampled points inside the region and none outside.

    Args:
        points: (N, d) sampled points, m.
        inside: (N,) True for points inside the region.

    Returns:
        (d, 2) bounds, m, of a box slightly smaller than one that no point contradicts; None if too few points are inside.

    Source: derived here. From the points that are farthest from those outside, the faces are moved outwards in turn.
    """
    from scipy.spatial import KDTree

    inner_points, outer_points = points[inside], points[~inside]
    if len(inner_points) < 2:
        return None
    distances = KDTree(outer_points).query(inner_points, p=np.inf)[0] if len(outer_points) else np.zeros(len(inner_points))
    spacing = float(np.median(np.asarray(KDTree(points).query(points, k=2, p=np.inf)[0])[:, 1])) / 2
    best, best_size = None, 0.0
    for start in np.argsort(-distances)[:_SEED_POINTS]:
        box = np.column_stack([inner_points[start], inner_points[start]])
        for _ in range(_STRETCH_ROUNDS):
            for axis in range(points.shape[1]):
                _stretch_axis(box, axis, inner_points, outer_points, spacing)
        size = float(np.prod(box[:, 1] - box[:, 0]))
        if size > best_size:
            best, best_size = box, size
    if best is None:
        return None
    middle, half_size = best.mean(axis=1), _KEPT_FRACTION / 2 * (best[:, 1] - best[:, 0])
    return np.column_stack([middle - half_size, middle + half_size])


def _stretch_axis(box: FloatArray, axis: int, inner_points: FloatArray, outer_points: FloatArray, spacing: float) -> None:
    """Stretch the box in place along an axis over inner points, up to the spacing before the next outer point."""
    others = np.arange(len(box)) != axis
    lower, upper = box[others].T

    def coordinates_near(points: FloatArray, width: float) -> FloatArray:
        is_near = ((points[:, others] >= lower - width) & (points[:, others] <= upper + width)).all(axis=1)
        return np.asarray(points[is_near, axis])

    stops, ends = coordinates_near(outer_points, spacing), coordinates_near(inner_points, 2 * spacing)
    minimum = stops[stops < box[axis, 0]].max(initial=-np.inf) + spacing
    maximum = stops[stops > box[axis, 1]].min(initial=np.inf) - spacing
    ends = ends[(ends > minimum) & (ends < maximum)]
    box[axis] = min(ends.min(initial=box[axis, 0]), box[axis, 0]), max(ends.max(initial=box[axis, 1]), box[axis, 1])
