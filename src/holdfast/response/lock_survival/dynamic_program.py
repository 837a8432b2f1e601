"""Moves between the nodes of a path for the search of the motion with the greatest total gain, and smoothing of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from holdfast.core.progress import track
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.solvers.best_paths import BestPathTable, NodeMoves, bound_move_length
from holdfast.kinematics.solvers.curve_tracing import ManifoldTracer
from holdfast.model.arm.model import Arm
from holdfast.response.lock_survival.grid import CurveNodes, compute_squared_distances
from holdfast.response.lock_survival.tables import LockTable

# Largest number of node pairs of two poses that are all evaluated; of more pairs, a tree finds the close ones.
_MAX_DENSE_MOVES = 1 << 20
_MAX_CURVE_SHIFT_RAD = 0.15  # largest shift of a configuration along its curve, rad
_SMOOTHING_ROUNDS = 3


@dataclass(frozen=True, eq=False, kw_only=True)
class SearchBounds:
    """Results of a search over all motions of the grid.

    Attributes:
        bound: Upper bound on the survival of every motion, up to the grid: survival of the best motion over the nodes if each
            node had the best value up to halfway to its neighbours, with the spacing added to the velocity limits.
        interval: Largest survival of motions over the nodes within the velocity limits, and with one ``spacing`` more per step,
            because the grid is not finer. NaN: no such motion.
        spacing: Distance of neighbouring nodes, rad (and m).
        nodes: T arrays (P, n) of all configurations that were found, rad and m.
        curve: T arrays (P,) with the index of the curve of each node.
        survives: T arrays (P, n): True where a lock of the joint is survivable.
        moved: (n,) largest range of each joint along one curve of one pose, rad and m.
        held: Joints that all evaluated motions keep fixed, with their values, rad and m; empty with one degree of redundancy.
    """

    bound: float
    interval: tuple[float, float]
    spacing: float
    nodes: Sequence[FloatArray]
    curve: Sequence[IndexArray]
    survives: Sequence[BoolArray]
    moved: FloatArray
    held: dict[str, float] = field(default_factory=dict)


def advance_tables(arm: Arm, nodes: list[CurveNodes], max_steps: FloatArray, path_tables: Sequence[BestPathTable]) -> None:
    """Advance tables of best motions from the first pose to the last.

    Args:
        arm: The arm.
        nodes: Nodes of each pose.
        max_steps: (n,) largest motion of each joint from pose to pose, rad and m; infinite where there is no limit.
        path_tables: Tables at the first pose, which are updated.
    """
    allowed_excess = max(path_table.allowed_excess for path_table in path_tables)
    for nodes_before, nodes_after in track("poses", list(pairwise(nodes)), whole=True):
        moves = _find_moves(arm, nodes_after, nodes_before, max_steps, allowed_excess)
        for path_table in path_tables:
            path_table.advance_to_next_pose(moves)


def _find_moves(
    arm: Arm, nodes_after: CurveNodes, nodes_before: CurveNodes, max_steps: FloatArray, allowed_excess: float
) -> NodeMoves:
    """Return the moves between the nodes within the limits plus ``allowed_excess``, or short ones without a limit."""
    is_limited = np.isfinite(max_steps)
    if len(nodes_before.q) * len(nodes_after.q) <= _MAX_DENSE_MOVES:
        node_distances = compute_squared_distances(nodes_after.embedded, nodes_before.embedded)
        nearest = np.sqrt(node_distances.min(axis=0))
        max_length = np.inf if is_limited.all() else bound_move_length(nodes_before.spacing, nearest)
        targets, sources = (indices.ravel() for indices in np.indices(node_distances.shape))
        move_distances = node_distances.ravel()
        excesses = _measure_excess(arm, nodes_after.q[:, None], nodes_before.q[None], max_steps).ravel()
    else:
        from scipy.spatial import KDTree

        nearest = np.asarray(KDTree(nodes_after.embedded).query(nodes_before.embedded)[0])
        max_length = np.inf if is_limited.all() else bound_move_length(nodes_before.spacing, nearest)
        max_differences = np.where(is_limited, max_steps + allowed_excess, np.pi / 2 * max_length)
        targets, sources = _find_close_pairs(arm, nodes_after.q, nodes_before.q, max_differences)
        move_distances = ((nodes_after.embedded[targets] - nodes_before.embedded[sources]) ** 2).sum(axis=1)
        excesses = _measure_excess(arm, nodes_after.q[targets], nodes_before.q[sources], max_steps)
    is_selected = (excesses <= allowed_excess) & (move_distances <= max_length**2)
    return NodeMoves(targets[is_selected], sources[is_selected], move_distances[is_selected], excesses[is_selected])


def _measure_excess(arm: Arm, q: FloatArray, before: FloatArray, max_steps: FloatArray) -> FloatArray:
    """Return (...) the greatest excess over the limits of a joint's motion from ``before`` to q (..., n)."""
    excesses = np.full(np.broadcast_shapes(q.shape, before.shape)[:-1], -np.inf)
    for joint_index in np.flatnonzero(np.isfinite(max_steps)):
        joint_steps = np.abs(q[..., joint_index] - before[..., joint_index])
        if joint_space.is_unlimited(arm)[joint_index]:
            joint_steps = np.abs(np.remainder(joint_steps + np.pi, 2 * np.pi) - np.pi)
        np.maximum(excesses, joint_steps - max_steps[joint_index], out=excesses)
    return excesses


def _find_close_pairs(
    arm: Arm, first_q: FloatArray, second_q: FloatArray, max_differences: FloatArray
) -> tuple[IndexArray, IndexArray]:
    """Return the ordered pairs of rows (Q, n) and (P, n) that differ by at most ``max_differences`` (n,) in every joint."""
    from scipy.spatial import KDTree

    padded_reach = max_differences * (1 + 1e-9)
    boxes = np.where(joint_space.is_unlimited(arm), 2 * np.pi * (1 + 1e-12) / padded_reach, 0.0)  # above rounded angles
    trees = [
        KDTree(joint_space.wrap_joints_to_positive(arm, configurations) / padded_reach, boxsize=boxes)
        for configurations in (first_q, second_q)
    ]
    pairs = trees[0].sparse_distance_matrix(trees[1], 1.0, p=np.inf, output_type="ndarray")
    order = np.lexsort((pairs["j"], pairs["i"]))
    return pairs["i"][order], pairs["j"][order]


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
    """Smooth the motion q (T, n) over the chosen nodes (T,) so that the sum of its squared steps is smallest.

    Each configuration moves along its self-motion curve by at most ``_MAX_CURVE_SHIFT_RAD``, and only as far as it loses no
    gain. With ``start_is_fixed`` the first one does not move. A step is nearly linear in these shifts, so a few least-squares
    problems with bounds are solved.
    """
    from scipy.optimize import lsq_linear

    sides = zip(
        *(
            _lossless_shift_bounds(pose_nodes, lock_table, pose_gains, int(node))
            for pose_nodes, lock_table, pose_gains, node in zip(nodes, lock_tables, gains, chosen, strict=True)
        ),
        strict=True,
    )
    lower, upper = (np.array(side) for side in sides)
    movable = np.flatnonzero((upper - lower > 1e-9) & ~(start_is_fixed & (np.arange(len(q)) == 0)))
    if not movable.size:
        return q
    # The direction of a curve may be opposite to its null vector.
    curve_directions = np.array(
        [
            pose_nodes.pieces[node] if pose_nodes.following[node] != node else pose_nodes.pieces[pose_nodes.previous[node]]
            for pose_nodes, node in zip(nodes, chosen, strict=True)
        ]
    )
    smooth_q, shifts = q, np.zeros(len(q))
    for _ in range(_SMOOTHING_ROUNDS):
        tangent = tracer.project_onto_poses(smooth_q, poses)[2][:, 0]
        tangent *= np.where(np.einsum("ij,ij->i", tangent, curve_directions) < 0, -1.0, 1.0)[:, None]
        matrix = np.zeros((len(q) - 1, q.shape[1], len(q)))
        row = np.arange(len(q) - 1)
        matrix[row, :, row], matrix[row, :, row + 1] = -tangent[:-1], tangent[1:]
        steps = np.diff(smooth_q, axis=0).reshape(-1)
        bounds = (lower - shifts)[movable], (upper - shifts)[movable]
        change = np.zeros(len(q))
        change[movable] = lsq_linear(matrix.reshape(-1, len(q))[:, movable], -steps, bounds, tol=1e-6).x
        candidate_q, is_on_pose, _ = tracer.project_onto_poses(smooth_q + change[:, None] * tangent, poses)
        inside = ((candidate_q >= tracer.arm.lower) & (candidate_q <= tracer.arm.upper)).all(axis=1)
        if not (is_on_pose & inside).all():
            break
        smooth_q, shifts = candidate_q, shifts + change
    return smooth_q


def _lossless_shift_bounds(nodes: CurveNodes, lock_table: LockTable, gain: FloatArray, chosen: int) -> tuple[float, float]:
    """Return how far a configuration may move against and along its curve without a loss of gain."""
    limits = []
    for neighbors, sign in ((nodes.previous, -1.0), (nodes.following, 1.0)):
        length, node = 0.0, chosen
        while length < _MAX_CURVE_SHIFT_RAD and neighbors[node] != node:
            other = int(neighbors[node])
            segment_length = float(np.linalg.norm(nodes.pieces[node if sign > 0 else other]))
            if gain[other] < gain[chosen] - 1e-12:
                length += segment_length * lock_table.lossless_move_fraction(node, other, is_ahead=sign > 0)
                break
            length, node = length + segment_length, other
        limits.append(sign * min(length, _MAX_CURVE_SHIFT_RAD))
    return limits[0], limits[1]
