"""Exclusion of lock instants after which no configuration has the tool at a later path position, by closed loops over boxes of
joints.

With a given tool pose, base, joints and tool form a closed loop. The distance between two points of links through the joints
between them equals that through the tool and the base. Points on axes make these distances depend on few joints. For an arm
with a spherical shoulder and wrist, the distance of their centers depends only on the elbow. The numbers here have no error
bounds; the verifier decides.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations_with_replacement

import numpy as np

from holdfast.certificates.joint_boxes.halving import BoxBisection, BoxVerdicts
from holdfast.certificates.joint_boxes.segments import ChainSegment, find_axis_points, limit_to_one_turn
from holdfast.certificates.taylor import CertificateChain
from holdfast.certificates.tool_paths.cells import SEGMENT_INSTANTS
from holdfast.certificates.tool_paths.claims import PathClaim
from holdfast.certificates.tool_paths.forms import LockedTrackingEnclosure
from holdfast.core.typing import BoolArray, FloatArray, IndexArray

Point = tuple[int, FloatArray]  # link, and position in its frame, m

_MAX_PAIRS = 12  # pairs of points
_MAX_SIMILAR_PAIRS = 2  # pairs whose distances depend on the same joints
_MAX_TREE_NODES = 4000  # boxes of a tree
_MAX_HALVINGS = 16  # bisections of each joint
_PATH_SAMPLES = 8  # path positions at which configurations are searched
# Random starts, steps and tolerance (m and rad) of Newton's method.
_RANDOM_STARTS = 40
_NEWTON_STEPS = 25
_TARGET_TOLERANCE = 1e-8
_RANDOM_SEED = 15


@dataclass(frozen=True, eq=False)
class RefutedInterval:
    """Refuted interval of lock instants.

    Attributes:
        begin, stop: First and last instant, in one segment.
        path_instant: Instant of the path at which no configuration has the tool pose.
        tree: Tree of boxes of the joints, each with the pair of points that excludes it.
    """

    begin: int
    stop: int
    path_instant: int
    tree: bytes


@dataclass(frozen=True, eq=False)
class _LoopBranch:
    """Branch of a loop from one point to another through some joints.

    Attributes:
        segment: Joints of the branch, and the point behind them.
        joints: Indices of these joints in the arm.
        start: (3,) point before them, m.
        moves: Flags of the joints that change the distance of the points.
    """

    segment: ChainSegment
    joints: IndexArray
    start: FloatArray
    moves: BoolArray

    @classmethod
    def from_loop(cls, loop: CertificateChain, first: int, last: int, start: FloatArray, end: FloatArray) -> _LoopBranch:
        """Make a branch of successive joints of a loop."""
        segment, joints = ChainSegment.from_chain(loop, first, last, end), np.arange(first, last) % (len(loop.lengths) // 2)
        return cls(segment, joints, start, np.arange(last - first) >= segment.count_leading_axes_through(start))

    def bound_distance(
        self, middle: FloatArray, half: FloatArray, from_above: bool
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return a bound of the least or greatest distance over boxes, the distance of the middles, and joint costs (N, n)."""
        count, joint_costs = len(middle), np.zeros(middle.shape)
        if not len(self.joints):
            distance = np.full(count, np.linalg.norm(self.segment.end - self.start))
            return distance, distance, joint_costs
        q, half_range = middle[:, self.joints], half[:, self.joints] * self.moves
        bound_distance = self.segment.upper_distance_bound if from_above else self.segment.lower_distance_bound
        starts, zeros = np.broadcast_to(self.start, (count, 3)), np.zeros((count, 3))
        bound, center_distance, costs = bound_distance(q, half_range, starts, zeros)
        if from_above:
            costs = costs / np.maximum(center_distance, 1e-9)[:, None]
        joint_costs[:, self.joints] = costs[:, : len(self.joints)]
        return bound, center_distance, joint_costs


class LoopClosureExclusion:
    """Search for refuted lock instants of one joint.

    Args:
        enclosure: Enclosure of the arm with this joint locked and all others free.
        uses_rotation: True if the tool pose includes the rotation.
        planar: True if the arm moves in the plane.
    """

    def __init__(self, enclosure: LockedTrackingEnclosure, uses_rotation: bool, planar: bool) -> None:
        self._enclosure, self._uses_rotation, chain = enclosure, uses_rotation, enclosure.chain
        self._plane_mask = np.array([1, 1, not planar])
        self._chain = replace(chain, origins=chain.origins * self._plane_mask)
        self._joint, self._limits = enclosure.driven[0], limit_to_one_turn(enclosure.limits, chain.slides)
        self._path_end = self._last_position = (len(enclosure.knots) - 1) * SEGMENT_INSTANTS
        self._rng = np.random.default_rng(_RANDOM_SEED)
        self.points, self.pairs = self._choose_pairs()

    def _choose_pairs(self) -> tuple[list[Point], list[tuple[int, int]]]:
        """Choose points of links, and pairs of them whose distances depend on few joints."""
        chain, n = self._chain, self._enclosure.n
        axis_points = find_axis_points(chain, self._limits, self._rng)
        scale = float(chain.lengths.mean())
        others = [(link, position + scale * chain.rotations[link][:, 2]) for link, position in axis_points]
        points = [*axis_points, *others] if self._uses_rotation else axis_points
        points = [*sorted(points, key=lambda point: point[0]), (n, chain.origins[-1])]
        q = self._rng.uniform(self._limits[:, 0], self._limits[:, 1], (8, n))
        candidates = list[tuple[int, bytes, tuple[int, int]]]()
        for i, j in combinations_with_replacement(range(len(points)), 2):
            if not self._uses_rotation and j + 1 < len(points):
                continue
            branches, depends_on = self._split_loop(self._path_end, points, (i, j)), np.zeros(n, dtype=bool)
            for branch in branches:
                tip, _, columns = branch.segment.point_axes_and_derivatives(q[:, branch.joints])
                changes = np.abs(np.einsum("na,nka->nk", tip - branch.start, columns)).max(axis=0) > 1e-9
                depends_on[branch.joints] |= changes | ((i == j) & (np.abs(columns).max(axis=(0, 2)) > 1e-9))
            if depends_on.any():
                candidates.append((int(depends_on.sum()), depends_on.tobytes(), (i, j)))
        pairs, seen = list[tuple[int, int]](), list[bytes]()
        for _, signature, pair in sorted(candidates, key=lambda candidate: candidate[:2]):
            if seen.count(signature) < _MAX_SIMILAR_PAIRS and len(pairs) < _MAX_PAIRS:
                seen.append(signature)
                pairs.append(pair)
        return points, pairs

    def _split_loop(self, path_instant: int, points: list[Point], pair: tuple[int, int]) -> tuple[_LoopBranch, _LoopBranch]:
        """Return the branches between two points, by the joints between them and by the tool, fixed at a path instant."""
        chain, n, ((first, a), (last, b)) = self._chain, self._enclosure.n, (points[index] for index in pair)
        q, _ = self._enclosure.healthy_joints_and_rates(np.array([2 * path_instant]), np.array([path_instant]))
        position, rotation = (values[0] for values in self._enclosure.tool_pose_and_jacobian(q)[:2])
        base_rotation = chain.rotations[n] @ rotation.T
        base_origin = chain.origins[n] - base_rotation @ (position * self._plane_mask)
        rotations = np.concatenate([chain.rotations[:n], [base_rotation @ chain.rotations[0]], chain.rotations[1:]])
        origins = np.concatenate([chain.origins[:n], [base_origin + base_rotation @ chain.origins[0]], chain.origins[1:]])
        loop = CertificateChain(rotations, origins, np.tile(chain.lengths, 2), np.tile(chain.slides, 2))
        end = a if first else base_origin + base_rotation @ a
        return _LoopBranch.from_loop(loop, first, last, a, b), _LoopBranch.from_loop(loop, last, n + first, b, end)

    def refute_lock_interval(self, begin: int, stop: int) -> tuple[RefutedInterval | None, bool, int]:
        """Try to refute lock instants of one segment.

        Return the interval or None, whether parts of it may be refuted, and the number of examined boxes.
        """
        locks, may_split = np.array([begin, (begin + stop) // 2, stop]), False
        next_knot = -(-stop // SEGMENT_INSTANTS) * SEGMENT_INSTANTS
        samples = np.linspace(self._path_end, next_knot, _PATH_SAMPLES, dtype=np.int64)
        for path_instant in dict.fromkeys([self._last_position, *samples]):
            position = int(path_instant) // SEGMENT_INSTANTS * SEGMENT_INSTANTS
            if position < stop:
                continue
            has_solution = self._has_reaching_configuration(locks, position)
            may_split |= not has_solution.all()
            if not has_solution.any():
                self._last_position = position
                halving, is_excluded = self._bisect_joint_ranges(begin, stop, position)
                tree = halving.tree.preorder_tokens()
                return RefutedInterval(begin, stop, position, tree) if is_excluded else None, True, halving.tested
        return None, may_split, 0

    def _has_reaching_configuration(self, locks: IndexArray, path_instant: int) -> BoolArray:
        """Return a mask of locks for which Newton's method finds a configuration with the tool at a path instant."""
        enclosure, (lower, upper), count = self._enclosure, self._limits.T, len(locks)
        lock_q, goal_q = (
            enclosure.healthy_joints_and_rates(2 * instants, np.maximum(instants, 1))[0]
            for instants in (locks, np.array([path_instant]))
        )
        q = self._rng.uniform(lower, upper, (count, _RANDOM_STARTS, enclosure.n))
        q[:, 0], q[:, 1] = lock_q, goal_q
        q[:, :, self._joint] = lock_q[:, [self._joint]]
        q, target = q.reshape(-1, enclosure.n), enclosure.tool_pose_and_jacobian(goal_q)
        for _ in range(_NEWTON_STEPS):
            error, jacobian = enclosure.tracking_error_and_jacobian(enclosure.tool_pose_and_jacobian(q), target)
            free_jacobian = jacobian[:, :, enclosure.free]
            transposed = free_jacobian.transpose(0, 2, 1)
            gram = free_jacobian @ transposed + 1e-9 * np.eye(enclosure.m)
            q[:, enclosure.free] -= np.clip((transposed @ np.linalg.solve(gram, error[:, :, None]))[:, :, 0], -0.4, 0.4)
        # Of all equivalent configurations, the one nearest to the middles of the limits.
        turns = [joint in enclosure.free for joint in range(enclosure.n)] & ~enclosure.slides
        q -= 2 * np.pi * np.round((q - (lower + upper) / 2) / (2 * np.pi)) * turns
        tool_state = enclosure.tool_pose_and_jacobian(q)
        error, _ = enclosure.tracking_error_and_jacobian(tool_state, target)
        is_solved = (np.abs(error) < _TARGET_TOLERANCE).all(axis=1)
        is_solved &= ((q >= lower) & (q <= upper))[:, enclosure.free].all(axis=1)
        if enclosure.uses_rotation:
            is_solved &= enclosure.compute_rotation_trace(tool_state, target) > 1
        return np.asarray(is_solved.reshape(count, -1).any(axis=1))

    def _bisect_joint_ranges(self, begin: int, stop: int, path_instant: int) -> tuple[BoxBisection, bool]:
        """Bisect the ranges of all joints, of the locked one between two instants; also return whether all are excluded."""
        box = self._limits.copy()
        box[self._joint] = np.sort(
            self._enclosure.healthy_joints_and_rates(np.array([2 * begin, 2 * stop]), np.array([stop]))[0][:, self._joint]
        )
        halving = BoxBisection(box, _MAX_HALVINGS)
        test = _LoopExclusionTest([self._split_loop(path_instant, self.points, pair) for pair in self.pairs])
        return halving, halving.run(test, max_nodes=_MAX_TREE_NODES) and halving.undecided == 0


def make_loop_closure_exclusion(claim: PathClaim, joint: int) -> LoopClosureExclusion | None:
    """Make the loop closure test; None for an arm with unlimited prismatic joints or one that leaves the plane of its task."""
    enclosure = LockedTrackingEnclosure.from_claim(claim, [joint], np.empty(0))
    chain, planar = enclosure.chain, claim.task.startswith("planar")
    in_plane = not chain.slides.any() and (np.abs(chain.rotations[:, 2, 2]) == 1).all()
    if not np.isfinite(enclosure.limits[chain.slides]).all() or (planar and not in_plane):
        return None
    return LoopClosureExclusion(enclosure, "pose" in claim.task, planar)


class _LoopExclusionTest:
    """Test that excludes boxes of joints by a pair of points whose two branches cannot close the loop."""

    def __init__(self, pairs: list[tuple[_LoopBranch, _LoopBranch]]) -> None:
        self._pairs = pairs

    def __call__(self, middle: FloatArray, half: FloatArray) -> tuple[IndexArray, FloatArray]:
        """Return the tokens of boxes and the gain of halving each joint."""
        verdicts = BoxVerdicts(half)
        for token, branches in enumerate(self._pairs):
            rows = verdicts.open_rows
            if not rows.size:
                break
            tips = (branch.segment.point_axes_and_derivatives(middle[rows][:, branch.joints])[0] for branch in branches)
            offsets = (tip - branch.start for tip, branch in zip(tips, branches, strict=True))
            first, second = (np.linalg.norm(offset, axis=1) for offset in offsets)
            for (longer, shorter), mask in ((branches, first >= second), (branches[::-1], first < second)):
                chosen = rows[mask]
                if chosen.size:
                    lower, longer_center, longer_costs = longer.bound_distance(middle[chosen], half[chosen], from_above=False)
                    upper, shorter_center, shorter_costs = shorter.bound_distance(middle[chosen], half[chosen], from_above=True)
                    costs = longer_costs + shorter_costs
                    verdicts.record(chosen, token, lower - upper, longer_center - shorter_center, costs)
        return verdicts.tokens, verdicts.gain
