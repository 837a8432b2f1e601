"""Smooth a motion over nodes along its self-motion curves without loss of its total gain."""

from __future__ import annotations

import numpy as np

from holdfast.endurance.grid import CurveNodes
from holdfast.endurance.tables import LockTable
from holdfast.solvers.curve_tracing import ManifoldTracer
from holdfast.typing import FloatArray, IndexArray

_MAX_CURVE_SHIFT_RAD = 0.15  # rad along its curve is the most that a configuration is moved
_SMOOTHING_ROUNDS = 3


def smooth_motion(
    tracer: ManifoldTracer,
    nodes: list[CurveNodes],
    lock_tables: list[LockTable],
    gains: list[FloatArray],
    chosen: IndexArray,
    q: FloatArray,
    poses: FloatArray,
    *,
    start_is_fixed: bool,
) -> FloatArray:
    """Smooth the motion q (T, n) over the chosen nodes (T,) so that its squared steps are smallest.

    Each configuration moves along its self-motion curve, by at most ``_MAX_CURVE_SHIFT_RAD`` and no farther than it is worth as
    much; with ``start_is_fixed`` the first one stays. A step is nearly linear in these moves, so that it is a least-squares
    problem with
    bounds, solved a few times over.
    """
    from scipy.optimize import lsq_linear

    sides = zip(
        *(
            _bound_shift(pose_nodes, lock_table, pose_gains, int(node))
            for pose_nodes, lock_table, pose_gains, node in zip(nodes, lock_tables, gains, chosen, strict=True)
        ),
        strict=True,
    )
    lower, upper = (np.array(side) for side in sides)
    movable = np.flatnonzero((upper - lower > 1e-9) & ~(start_is_fixed & (np.arange(len(q)) == 0)))
    if not movable.size:
        return q
    # The curve of a node may run against the null vector that comes with it.
    curve_directions = np.array(
        [
            pose_nodes.pieces[node] if pose_nodes.following[node] != node else pose_nodes.pieces[pose_nodes.previous[node]]
            for pose_nodes, node in zip(nodes, chosen, strict=True)
        ]
    )
    smooth_q, shifts = q, np.zeros(len(q))
    for _ in range(_SMOOTHING_ROUNDS):
        tangent = tracer.correct(smooth_q, poses)[2][:, 0]
        tangent *= np.where(np.einsum("ij,ij->i", tangent, curve_directions) < 0, -1.0, 1.0)[:, None]
        matrix = np.zeros((len(q) - 1, q.shape[1], len(q)))
        row = np.arange(len(q) - 1)
        matrix[row, :, row], matrix[row, :, row + 1] = -tangent[:-1], tangent[1:]
        steps = np.diff(smooth_q, axis=0).reshape(-1)
        bounds = (lower - shifts)[movable], (upper - shifts)[movable]
        change = np.zeros(len(q))
        change[movable] = lsq_linear(matrix.reshape(-1, len(q))[:, movable], -steps, bounds, tol=1e-6).x
        candidate_q, is_on_pose, _ = tracer.correct(smooth_q + change[:, None] * tangent, poses)
        inside = ((candidate_q >= tracer.arm.lower) & (candidate_q <= tracer.arm.upper)).all(axis=1)
        if not (is_on_pose & inside).all():
            break
        smooth_q, shifts = candidate_q, shifts + change
    return smooth_q


def _bound_shift(nodes: CurveNodes, verdicts: LockTable, gain: FloatArray, chosen: int) -> tuple[float, float]:
    """Return how far a configuration may move against and along its curve without a loss of gain."""
    limits = []
    for neighbors, sign in ((nodes.previous, -1.0), (nodes.following, 1.0)):
        length, node = 0.0, chosen
        while length < _MAX_CURVE_SHIFT_RAD and neighbors[node] != node:
            other = int(neighbors[node])
            segment_length = float(np.linalg.norm(nodes.pieces[node if sign > 0 else other]))
            if gain[other] < gain[chosen] - 1e-12:
                length += segment_length * verdicts.safe_fraction(node, other, is_ahead=sign > 0)
                break
            length, node = length + segment_length, other
        limits.append(sign * min(length, _MAX_CURVE_SHIFT_RAD))
    return limits[0], limits[1]
