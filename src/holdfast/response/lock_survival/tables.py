"""Tables of the survivable locks at every node of a path, computed backwards in time with one step per lock."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from holdfast.core.progress import track
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.solvers.self_motions import SelfMotion
from holdfast.model.arm.model import Arm
from holdfast.response.lock_survival.grid import CurveNodes
from holdfast.response.lock_survival.locks import LockedFollower

Spans = list[tuple[float, float]]

_PARTS_PER_SEGMENT = 16  # parts of a curve segment in which survival changes: two rounds locate the change to 1/256

_RANGE_TOLERANCE = 1e-9  # rad and m
MAX_RETAINED_BRANCHES = 4  # configurations of a redundant failed arm that are followed


@dataclass(frozen=True, eq=False)
class LockTable:
    """Survivable locks at the P nodes of one pose.

    Attributes:
        survives: (P, n) True where a lock of the joint is survivable.
        switch_fractions: (P, n) fraction, 0 to 1, between a node and the next along its curve at which survival changes; used
            only if it does. NaN where it was not computed.
    """

    survives: BoolArray
    switch_fractions: FloatArray

    def survives_between_nodes(
        self, nodes: CurveNodes, nodes_behind: IndexArray, fractions: FloatArray, joints: IndexArray
    ) -> BoolArray:
        """Return (N,) the survival for joint (N,) between nodes, located by :meth:`CurveNodes.locate_on_curves`."""
        decisive_nodes = np.where(
            fractions < self.switch_fractions[nodes_behind, joints], nodes_behind, nodes.following[nodes_behind]
        )
        return np.asarray(self.survives[decisive_nodes, joints])

    def maximize_survived_rates(self, nodes: CurveNodes, rates: FloatArray) -> FloatArray:
        """Return (P,) the largest sum of rates (n,) of survived locks at each node and up to halfway to its neighbors."""
        survives_here, survives_next = self.survives, self.survives[nodes.following]
        is_known = np.isfinite(self.switch_fractions)
        best_ahead, best_behind = np.zeros((2, len(survives_here)))  # in the first and second half of each segment
        # Along a segment, survival changes joint by joint, so it is evaluated at each change and in the middle.
        for fractions in (np.zeros(len(survives_here)), np.full(len(survives_here), 0.5), *self.switch_fractions.T):
            sums = (
                np.where(
                    is_known,
                    np.where(fractions[:, None] < self.switch_fractions, survives_here, survives_next),
                    survives_here | survives_next,
                )
                @ rates
            )
            np.maximum(best_ahead, sums, out=best_ahead, where=~(fractions > 0.5))
            np.maximum(best_behind, sums, out=best_behind, where=~(fractions < 0.5))
        return np.where(
            nodes.previous == np.arange(len(survives_here)), best_ahead, np.maximum(best_ahead, best_behind[nodes.previous])
        )

    def lossless_move_fraction(self, node: int, neighbor: int, *, is_ahead: bool) -> float:
        """Return how far a node may move towards its neighbor, ahead or behind, without a loss: 0 to 1, rounded down."""
        is_lost = self.survives[node] & ~self.survives[neighbor]
        switches = self.switch_fractions[node if is_ahead else neighbor, is_lost]
        fraction = float(np.min(switches if is_ahead else 1 - switches, initial=1.0)) - 1 / _PARTS_PER_SEGMENT
        return max(fraction, 0.0) if fraction == fraction else 0.0


def compute_path_tables(follower: LockedFollower, nodes: list[CurveNodes]) -> list[LockTable]:
    """Return for every pose the locks at its nodes after which the failed arm can follow the rest of the tool path.

    One step of the locked arm leads to the next pose, between nodes there with known survival and a known location of its
    change between them. If the step does not lead to a known curve, the arm is followed further until it does.
    """
    n = follower.arm.n
    sizes = [len(pose_nodes.q) for pose_nodes in nodes[:-1]]
    all_q = np.concatenate([pose_nodes.q for pose_nodes in nodes[:-1]])
    landed, reached = follower.step_with_each_lock(all_q, np.repeat(np.arange(len(sizes)), sizes))
    offsets = np.cumsum([0, *sizes])
    shape = (len(nodes[-1].q), n)  # at the last pose every lock is survived
    table = [LockTable(np.ones(shape, dtype=bool), np.ones(shape))]
    for pose in track("poses", range(len(nodes) - 2, -1, -1)):
        rows = slice(offsets[pose], offsets[pose + 1])
        node_indices, joints = np.nonzero(reached[rows])
        survives = np.zeros((sizes[pose], n), dtype=bool)
        survives[node_indices, joints] = _evaluate_steps(
            follower, nodes, table, pose + 1, landed[rows][node_indices, joints], joints
        )
        table.append(LockTable(survives, _locate_survival_changes(follower, nodes, table, pose, survives)))
    return table[::-1]


def _locate_survival_changes(
    follower: LockedFollower, nodes: list[CurveNodes], table: list[LockTable], pose: int, survives: BoolArray
) -> FloatArray:
    """Return (P, n) the fraction between nodes at which the survival at pose t changes; the table is known back to t + 1."""
    pose_nodes = nodes[pose]
    switches = np.full(survives.shape, 0.5)
    node_indices, joints = np.nonzero(survives != survives[pose_nodes.following])
    survives_behind = survives[node_indices, joints]
    lower = np.zeros(node_indices.size)
    for part_length in (1 / _PARTS_PER_SEGMENT, 1 / _PARTS_PER_SEGMENT**2):
        fractions = lower[:, None] + part_length * np.arange(1, _PARTS_PER_SEGMENT)
        repeated_nodes = np.repeat(node_indices, _PARTS_PER_SEGMENT - 1)
        repeated_joints = np.repeat(joints, _PARTS_PER_SEGMENT - 1)
        q = pose_nodes.q[repeated_nodes] + fractions.reshape(-1, 1) * pose_nodes.pieces[repeated_nodes]
        q, is_on_pose, _ = follower.tracer.project_onto_poses(q, np.broadcast_to(follower.poses[pose], (len(q), 4, 4)))
        q, has_arrived = follower.step(q, repeated_joints, pose)
        has_arrived &= is_on_pose
        verdict = np.zeros(len(q), dtype=bool)
        verdict[has_arrived] = _evaluate_steps(follower, nodes, table, pose + 1, q[has_arrived], repeated_joints[has_arrived])
        # Up to the first part that differs from the node behind it.
        differs = np.column_stack(
            [verdict.reshape(fractions.shape) != survives_behind[:, None], np.ones(node_indices.size, dtype=bool)]
        )
        lower += part_length * differs.argmax(axis=1)
    switches[node_indices, joints] = lower + 0.5 / _PARTS_PER_SEGMENT**2
    return switches


def _evaluate_steps(
    follower: LockedFollower, nodes: list[CurveNodes], table: list[LockTable], pose: int, q: FloatArray, joints: IndexArray
) -> BoolArray:
    """Return (N,) the survival of q (N, n) on pose t with joint (N,) locked; the table is known from its end back to t."""
    survives = np.ones(len(q), dtype=bool)
    active = np.arange(len(q))
    last_pose = len(nodes) - 1
    while active.size and pose < last_pose:
        nodes_behind, fractions, is_on_curve = nodes[pose].locate_on_curves(q)
        survives[active[is_on_curve]] = table[last_pose - pose].survives_between_nodes(
            nodes[pose], nodes_behind[is_on_curve], fractions[is_on_curve], joints[is_on_curve]
        )
        active, q, joints = active[~is_on_curve], q[~is_on_curve], joints[~is_on_curve]
        if active.size:
            q, has_arrived = follower.step(q, joints, pose)
            survives[active[~has_arrived]] = False
            active, q, joints = active[has_arrived], q[has_arrived], joints[has_arrived]
        pose += 1
    return survives


def compute_detour_tables(nodes: list[CurveNodes], self_motions: list[SelfMotion]) -> list[LockTable]:
    """Return for every pose the locks at its nodes for which all later poses have a configuration with the locked value.

    A failed arm without obstacles then returns to the path from any configuration, because both ends of the straight line have
    the locked value, and joint limits are a box.

    Source: Lewis and Maciejewski 1997, ranges of a joint over a self-motion manifold.
    """
    survives = [
        are_in_ranges(pose_nodes.arm, pose_nodes.q, ranges)
        for pose_nodes, ranges in zip(nodes, compute_remaining_path_ranges(self_motions), strict=True)
    ]
    return [LockTable(pose_survives, np.full(pose_survives.shape, np.nan)) for pose_survives in survives]


def compute_remaining_path_ranges(self_motions: list[SelfMotion]) -> list[list[Spans]]:
    """Return for every pose and joint its values common to all poses from there on; of unlimited joints in 0 to 2 pi."""
    arm = self_motions[0].arm
    is_unlimited = joint_space.is_unlimited(arm)
    common: list[Spans] = [[(-np.inf, np.inf)]] * arm.n
    table = []
    for each_pose in reversed(self_motions):
        arcs = [_fold_arcs(arc) if unlimited else arc for arc, unlimited in zip(each_pose.arcs(), is_unlimited, strict=True)]
        common = [_intersect_spans(common_spans, pose_spans) for common_spans, pose_spans in zip(common, arcs, strict=True)]
        table.append(common)
    return table[::-1]


def are_in_ranges(arm: Arm, q: FloatArray, ranges: list[Spans]) -> BoolArray:
    """Return (N, n) True for joints of q (N, n) within their ranges."""
    inside = np.zeros(q.shape, dtype=bool)
    for joint, values in enumerate(joint_space.wrap_joints_to_positive(arm, q).T):
        for lower, upper in ranges[joint]:
            inside[:, joint] |= (values >= lower - _RANGE_TOLERANCE) & (values <= upper + _RANGE_TOLERANCE)
    return inside


def _fold_arcs(arcs: Spans) -> Spans:
    """Fold arcs of a circle into 0 to 2 pi."""
    folded_arcs: Spans = []
    for lower, upper in arcs:
        begin = lower % (2 * np.pi)
        end = begin + min(upper - lower, 2 * np.pi)
        folded_arcs.append((begin, min(end, 2 * np.pi)))
        if end > 2 * np.pi:
            folded_arcs.append((0.0, end - 2 * np.pi))
    return folded_arcs


def _intersect_spans(a: Spans, b: Spans) -> Spans:
    """Return the intersection of two unions of intervals."""
    overlaps = [(max(lower, interval[0]), min(upper, interval[1])) for lower, upper in a for interval in b]
    return sorted((lower, upper) for lower, upper in overlaps if lower <= upper)


def follow_motion_locks(follower: LockedFollower, q: FloatArray, requested: BoolArray | None = None) -> BoolArray:
    """Return (T, n) True where a lock of a motion q (T, n) is survived: every lock is followed to the end.

    Only locks in ``requested`` (T, n), if given, are followed; where q is NaN no lock is survived.
    """
    survives = np.zeros(q.shape, dtype=bool)
    is_defined = np.isfinite(q).all(axis=1, keepdims=True)
    is_requested = np.broadcast_to(is_defined, q.shape) if requested is None else requested & is_defined
    survives[-1] = is_requested[-1]
    configurations = np.empty((0, follower.arm.n))
    lock_poses, joints = np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    for pose in track("poses", range(len(q) - 1)):
        new_joints = np.flatnonzero(is_requested[pose])
        configurations = np.concatenate([configurations, np.repeat(q[pose : pose + 1], new_joints.size, axis=0)])
        lock_poses, joints = np.concatenate([lock_poses, np.full(new_joints.size, pose)]), np.concatenate([joints, new_joints])
        configurations, has_arrived = follower.step(configurations, joints, pose)
        configurations, lock_poses, joints = configurations[has_arrived], lock_poses[has_arrived], joints[has_arrived]
    survives[lock_poses, joints] = True
    return survives


def find_switching_survived_locks(followers: Sequence[LockedFollower], q: FloatArray, requested: BoolArray) -> BoolArray:
    """Return (T, n) True where a redundant arm survives a lock if it may fix the joints of another follower at every pose.

    A few of the resulting configurations, far apart, are followed further.
    """
    survives = np.zeros(q.shape, dtype=bool)
    survives[-1] = requested[-1]
    configurations = np.empty((0, q.shape[1]))
    lock_poses, joints = np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    for pose in track("poses", range(len(q) - 1)):
        new_joints = np.flatnonzero(requested[pose])
        configurations = np.concatenate([configurations, np.repeat(q[pose : pose + 1], new_joints.size, axis=0)])
        lock_poses, joints = np.concatenate([lock_poses, np.full(new_joints.size, pose)]), np.concatenate([joints, new_joints])
        landed, row_parts = [configurations[:0]], [lock_poses[:0]]
        for follower in followers:
            selected = np.flatnonzero(~np.isin(joints, list(follower.tracer.fixed_joints)))
            next_q, has_arrived = follower.step(configurations[selected], joints[selected], pose)
            landed.append(next_q[has_arrived])
            row_parts.append(selected[has_arrived])
        configurations, rows = np.concatenate(landed), np.concatenate(row_parts)
        lock_poses, joints = lock_poses[rows], joints[rows]
        selected = select_farthest_by_owner(configurations, lock_poses * q.shape[1] + joints)
        configurations, lock_poses, joints = configurations[selected], lock_poses[selected], joints[selected]
    survives[lock_poses, joints] = True
    return survives


def select_farthest_by_owner(q: FloatArray, owners: IndexArray) -> IndexArray:
    """Return the indices of q (N, n) to retain: for each owner (N,) the first, then the few farthest from those retained."""
    _, first_indices, groups = np.unique(owners, return_index=True, return_inverse=True)
    retained, distances = [first_indices], np.full(len(q), np.inf)
    for _ in range(MAX_RETAINED_BRANCHES - 1):
        distances = np.minimum(distances, np.abs(q - q[retained[-1]][groups]).max(axis=1))
        order = np.lexsort((-distances, groups))
        retained.append(order[np.flatnonzero(np.diff(groups[order], prepend=-1))])
    return np.unique(np.concatenate(retained))
