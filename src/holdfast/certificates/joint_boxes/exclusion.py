"""Exclusion of targets: boxes of configurations and targets are bisected until one distance excludes each box.

The distance of a point of link k from the target must equal that of the tool from the point. A lemma, proved by a separate
bisection, bounds the latter and depends only on the joints behind the point. A box is excluded if the distance of the point
from the target, which depends only on the joints before the point, lies outside the lemma's range. With a point of the base on
the first axes (a shoulder), the lemma is the whole proof. The last such point is the tool, whose distance must be 0.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from holdfast.certificates.claims import OutOfReachClaim
from holdfast.certificates.joint_boxes.halving import (
    DISTANCE_MARGIN_M,
    OPEN_TOKEN,
    Bisection,
    BoxBisection,
    BoxVerdicts,
    bisect_box,
    require_feasible_box_count,
)
from holdfast.certificates.joint_boxes.segments import ChainSegment, curvature_costs, find_axis_points, limit_to_one_turn
from holdfast.certificates.search_pool import SearchBudget
from holdfast.certificates.taylor import CertificateChain, ReachSolver
from holdfast.core.typing import BoolArray, FloatArray, IndexArray

FIRST_LEMMA_TOKEN = 3  # token of a box that the first lemma excludes; 0 if the tool point itself excludes it
_MAX_LEMMAS = 12
_SAMPLE_COUNT = 2048
_LOCAL_SEARCH_COUNT = 32
_LOCAL_SEARCH_STEPS = 60
_MAX_LEMMA_NODES = 40_000
_LEMMA_WIDENING = 1e-3, 2e-4  # fractions of the range that was found, and of the length behind the point, that widen a lemma
_MAX_LEMMA_HALVINGS = 40
_WITNESS_TOLERANCE = 1e-10  # m and rad: largest error of a witness at its target
_WITNESS_LIMIT_MARGIN = 1e-6  # rad and m: least distance of a witness from limits


class TaskErrorBound:
    """Lower bound of the task error of a claim: if some combination of rows is never 0, the tool misses the target.

    Args:
        claim: Claim that no target is reached.
        joints: (n, 2) ranges of the joints, rad and m.
    """

    def __init__(self, claim: OutOfReachClaim, joints: FloatArray) -> None:
        self._arguments = claim, joints
        self.reach = ReachSolver(claim.arm, claim.task, claim.locked, joints, claim.rotation, claim.angle)
        self._linear = self.reach.linear

    def __reduce__(self) -> tuple[Any, ...]:  # another process compiles its own
        return TaskErrorBound, self._arguments

    def lower_error_bound(
        self, q: FloatArray, half: FloatArray, targets: FloatArray, target_half: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Bound a combination of rows away from 0 over q +- half (N, n) and targets +- target_half (N, a).

        Returns:
            Bounds (N,), their values at the middles (N,), and the reduction by each joint and target axis (N, n + a).
        """
        reach, linear = self.reach, self._linear
        count, n, extra_rows = len(q), q.shape[1], int(reach.uses_rotation)
        m, variables = reach.m + extra_rows, q.shape[1] + reach.axes - linear
        outputs = reach.expansion.error_derivative_kernel.rows(q, reach.append_target_rotation(targets))
        error, gradients, second = np.split(outputs, np.cumsum([m, m * variables]), axis=1)
        gradients, second = gradients.reshape(count, m, variables), second.reshape(count, m, variables, variables)
        half_widths = np.concatenate([half, target_half[:, linear:]], axis=1)
        # The third-order remainder of the point, m, and the angle by which it rotates, rad.
        c, slide_range = np.cumsum(half * ~reach.slides, axis=1), half * reach.slides
        max_lengths = reach.expansion.lengths + np.abs(q) * reach.slides + slide_range
        position_remainder = (c**3 * max_lengths + 3 * c**2 * slide_range).sum(axis=1) / 6
        angle = c[:, -1] + target_half[:, linear:].sum(axis=1)
        spans = gradients * half_widths[:, None]
        spread = spans @ spans.transpose(0, 2, 1) + (1e-6 * (error**2).sum(axis=1) + 1e-30)[:, None, None] * np.eye(m)
        spread[:, range(linear), range(linear)] += target_half[:, :linear] ** 2
        whitened = np.linalg.solve(spread, error[:, :, None])[:, :, 0]
        is_position = np.arange(m) < linear
        best = np.full(count, -np.inf), np.zeros(count), np.zeros((count, n + reach.axes))
        for direction in (error, whitened, *([error * is_position, error * ~is_position] if extra_rows else [])):
            unit = direction / np.maximum(np.linalg.norm(direction, axis=1), 1e-300)[:, None]
            slope, curvature = np.abs(np.einsum("na,nak->nk", unit, gradients)), np.einsum("na,najk->njk", unit, second)
            own_costs, pair_costs = curvature_costs(slope, curvature, half_widths)
            remainder = np.linalg.norm(unit[:, :linear], axis=1) * position_remainder
            remainder = remainder + np.linalg.norm(unit[:, linear:], axis=1) * angle**3 / 6
            target_costs, center_value = np.abs(unit[:, :linear]) * target_half[:, :linear], np.einsum("na,na->n", unit, error)
            bound = center_value - own_costs.sum(axis=1) - pair_costs.sum(axis=1) / 2 - remainder - target_costs.sum(axis=1)
            remainder_costs = (3 * remainder / np.maximum(half_widths.sum(axis=1), 1e-300))[:, None] * half_widths
            joint_costs = own_costs + pair_costs + remainder_costs
            all_costs = np.concatenate([joint_costs[:, :n], target_costs, joint_costs[:, n:]], axis=1)
            # Rows are in m and rad, so combinations are compared by the lost fraction of their value, not by the value.
            improved = bound / np.maximum(center_value, 1e-12) > best[0] / np.maximum(best[1], 1e-12)
            best = tuple(  # type: ignore[assignment]
                np.where(improved if new.ndim == 1 else improved[:, None], new, old)
                for new, old in zip((bound, center_value, all_costs), best, strict=True)
            )
        return best


@dataclass(frozen=True, eq=False)
class DistanceRangeLemma:
    """Bounds of the distance of the tool from a point of a link, for all values of the joints behind the link.

    Attributes:
        link: Index of the link; 0 is the base.
        point: (3,) position of the point in the frame of the link, m.
        least, most: Bounds of the distance, m.
        tree: Bisection of the joints behind the link, each leaf of which satisfies the bounds.
    """

    link: int
    point: FloatArray
    least: float
    most: float
    tree: bytes


@dataclass(frozen=True, eq=False, kw_only=True)
class Exclusion(Bisection):
    """Result of the search for an exclusion: the bisection of the box of all joints, then the target's coordinates.

    Attributes:
        lemmas: Lemmas that the tree uses; their boxes count as leaves and nodes.
        witness: (n,) configuration, rad, with its tool in the box of targets, which refutes the claim.
    """

    lemmas: list[DistanceRangeLemma] = field(default_factory=list)
    witness: FloatArray | None = None


def joint_ranges(claim: OutOfReachClaim) -> FloatArray:
    """Return ranges (n, 2) of the joints, rad, including the locked joint; those of revolute joints are at most one turn."""
    limits = claim.limits.copy()
    if claim.angle is not None:
        limits[claim.locked] = claim.angle
    return limit_to_one_turn(limits, claim.arm.prismatic)


def search_witness_or_exclusion(claim: OutOfReachClaim, halvings: int, seed: int, budget: SearchBudget) -> Exclusion:
    """Search for a witness, and without one for a proof."""
    rng = np.random.default_rng(seed)
    witness = _search_reaching_configuration(claim, rng)
    if witness is not None:
        return Exclusion(b"\2", Fraction(1), 0, 1, True, witness=witness)
    chain, joints = CertificateChain.from_arm(claim.arm), joint_ranges(claim)
    if claim.task.startswith("planar"):  # the arm moves in the plane
        chain = replace(chain, origins=chain.origins * [1, 1, 0])
    box, error_bound = np.vstack([joints, claim.box]), TaskErrorBound(claim, joints)
    lemmas, tested = list[DistanceRangeLemma](), 0
    target_box = claim.box[: error_bound.reach.linear]
    for link, point in find_axis_points(chain, joints, rng)[:_MAX_LEMMAS]:
        lemma, nodes = _prove_distance_range(chain, joints, target_box, link, point, budget.deadline, rng)
        tested += nodes
        if lemma is not None:
            lemmas.append(lemma)
            root_tokens, _ = _ExclusionTest(chain, lemmas, error_bound)(box.mean(axis=1)[None], np.diff(box).T / 2)
            if root_tokens[0] != OPEN_TOKEN:  # nothing more is needed
                break
    test = _ExclusionTest(chain, lemmas, error_bound)
    require_feasible_box_count(test, box, halvings, seed, "use a smaller box, or a narrower interval of the lock")
    bisection = bisect_box(test, box, halvings, budget)
    tree = bisection.tree
    used_indices = [index for index in range(len(lemmas)) if FIRST_LEMMA_TOKEN + index in tree]
    token_map = {FIRST_LEMMA_TOKEN + index: FIRST_LEMMA_TOKEN + rank for rank, index in enumerate(used_indices)}
    used_lemmas = [lemmas[index] for index in used_indices]
    tree = tree.translate(bytes(token_map.get(token, token) for token in range(256)))
    leaves = bisection.leaves + sum(lemma.tree.count(0) for lemma in used_lemmas)
    return Exclusion(tree, bisection.undecided, leaves, bisection.nodes + tested, bisection.finished, lemmas=used_lemmas)


class _ExclusionTest:
    """Test that excludes boxes of configurations and targets by a lemma, or by the tool itself."""

    def __init__(self, chain: CertificateChain, lemmas: list[DistanceRangeLemma], error_bound: TaskErrorBound) -> None:
        self.n, self.m, self.lemmas, self.error_bound = len(chain.lengths), error_bound.reach.linear, lemmas, error_bound
        self.segments = [ChainSegment.from_chain(chain, 0, lemma.link, lemma.point) for lemma in lemmas]

    def __call__(self, middle: FloatArray, half: FloatArray) -> tuple[IndexArray, FloatArray]:
        n, m, verdicts = self.n, self.m, BoxVerdicts(half)
        targets, target_half = np.zeros((2, len(middle), 3))
        targets[:, :m], target_half[:, :m] = middle[:, n : n + m], half[:, n : n + m]
        for token, (lemma, segment) in enumerate(zip(self.lemmas, self.segments, strict=True), FIRST_LEMMA_TOKEN):
            rows, joints_behind = verdicts.open_rows, [lemma.link] * (n - lemma.link)
            if not rows.size:
                break
            arguments = middle[rows, : lemma.link], half[rows, : lemma.link], targets[rows], target_half[rows]
            bound, center_distance, costs = segment.lower_distance_bound(*arguments)
            costs = np.insert(costs[:, : lemma.link + m], joints_behind, 0, axis=1)
            verdicts.record(rows, token, bound - lemma.most, center_distance - lemma.most, costs)
            distances = np.linalg.norm(segment.point_axes_and_derivatives(arguments[0])[0] - targets[rows], axis=1)
            close = np.flatnonzero(distances < lemma.least)
            if close.size:
                bound, center_distance, costs = segment.upper_distance_bound(*(values[close] for values in arguments))
                costs = np.insert(costs[:, : lemma.link + m], joints_behind, 0, axis=1)
                verdicts.record(rows[close], token, lemma.least - bound, lemma.least - center_distance, costs)
        rows = verdicts.open_rows
        verdicts.record(
            rows, 0, *self.error_bound.lower_error_bound(middle[rows, :n], half[rows, :n], middle[rows, n:], half[rows, n:])
        )
        return verdicts.tokens, verdicts.gain


def _prove_distance_range(
    chain: CertificateChain,
    joints: FloatArray,
    target_box: FloatArray,
    link: int,
    point: FloatArray,
    deadline: float,
    rng: np.random.Generator,
) -> tuple[DistanceRangeLemma | None, int]:
    """Return a lemma about a point, as narrow as a few boxes prove, or None, and the number of examined boxes."""
    n = len(joints)
    segment = ChainSegment.from_chain(chain, link, n, chain.origins[-1])
    min_distance, max_distance = _search_distance_range(segment, joints[link:], point, rng)
    max_reach = float(segment.lengths.sum() + np.linalg.norm(segment.origins, axis=1).sum() + np.linalg.norm(point))
    max_reach += float(np.abs(joints[link:]).max(axis=1)[segment.slides].sum())
    margin = max(_LEMMA_WIDENING[0] * (max_distance - min_distance), _LEMMA_WIDENING[1] * max_reach)
    interval = max(0.0, min_distance - margin), max_distance + margin
    if link == 0:  # if this lemma alone excludes all targets, it can be as wide as possible
        offsets = target_box - point[: len(target_box), None]
        lower = float(np.linalg.norm(np.maximum(np.maximum(offsets[:, 0], -offsets[:, 1]), 0)))
        upper = float(np.linalg.norm(np.abs(offsets).max(axis=1)))
        if lower > max_distance:
            interval = 0.0, lower - min(1e-6, (lower - max_distance) / 10)
        elif upper < min_distance:
            interval = upper + min(1e-6, (min_distance - upper) / 10), max_reach
    moves, tested = np.arange(n - link) >= segment.count_leading_axes_through(point), 0
    while margin < max_reach:
        lower, upper = interval
        test = partial(_test_distance_range, segment, point, moves, lower, upper if upper < max_reach else np.inf)
        halving = BoxBisection(joints[link:], _MAX_LEMMA_HALVINGS)
        finished = halving.run(test, deadline, max_nodes=_MAX_LEMMA_NODES)
        tested += halving.tested
        if finished and not halving.undecided:
            useful = lower > 0 or upper < max_reach
            lemma = DistanceRangeLemma(link, point, lower, upper, halving.tree.preorder_tokens()) if useful else None
            return lemma, tested
        margin *= 3
        interval = max(0.0, min_distance - margin), max_distance + margin
    return None, tested


def _test_distance_range(
    segment: ChainSegment, point: FloatArray, moves: BoolArray, lower: float, upper: float, middle: FloatArray, half: FloatArray
) -> tuple[IndexArray, FloatArray]:
    """Test which boxes of joints keep the end at a distance from ``lower`` to ``upper``; only joints that move it count."""
    half = half * moves
    points, zeros = np.broadcast_to(point, (len(middle), 3)), np.zeros((len(middle), 3))
    tokens, gain = np.zeros(len(middle), dtype=np.int64), np.zeros(half.shape)
    bounds = [(segment.upper_distance_bound, 1.0, upper)] * (upper < np.inf)
    bounds += [(segment.lower_distance_bound, -1.0, lower)] * (lower > 0)
    for bound_distance, sign, limit in bounds:
        distance, _, axis_costs = bound_distance(middle, half, points, zeros)
        undecided = sign * distance > sign * limit - DISTANCE_MARGIN_M
        tokens[undecided] = OPEN_TOKEN
        gain[undecided] += axis_costs[undecided, : len(moves)]
    return tokens, gain


def _search_distance_range(
    segment: ChainSegment, joints: FloatArray, point: FloatArray, rng: np.random.Generator
) -> tuple[float, float]:
    """Return the least and greatest distance found between end and point, by local searches from samples and corners."""
    lower, upper = joints.T
    fractions = np.concatenate([rng.random((_SAMPLE_COUNT, len(lower))), rng.integers(0, 3, (_SAMPLE_COUNT, len(lower))) / 2])
    q, extremes = lower + (upper - lower) * fractions, list[float]()
    for sign in (1.0, -1.0):

        def measure(q: FloatArray, sign: float = sign) -> FloatArray:
            return np.asarray(sign * np.linalg.norm(segment.point_axes_and_derivatives(q)[0] - point, axis=1))

        distances = measure(q)
        best_rows = np.argsort(distances)[:_LOCAL_SEARCH_COUNT]
        candidates, best_distances = q[best_rows], distances[best_rows]
        for step_size in 0.3 * 0.8 ** np.arange(_LOCAL_SEARCH_STEPS):
            moves = rng.normal(size=candidates.shape) * step_size * rng.integers(0, 2, candidates.shape)
            trials = np.clip(candidates + moves, lower, upper)
            distances = measure(trials)
            improved = distances < best_distances
            candidates[improved], best_distances[improved] = trials[improved], distances[improved]
        extremes.append(sign * float(best_distances.min()))
    return extremes[0], extremes[1]


def _search_reaching_configuration(claim: OutOfReachClaim, rng: np.random.Generator) -> FloatArray | None:
    """Return a configuration within the claim whose tool is inside the box, or None if none is found."""
    joints = joint_ranges(claim)
    reach = ReachSolver(claim.arm, claim.task, claim.locked, joints, claim.rotation, claim.angle)
    targets = claim.box[:, 0] + np.diff(claim.box)[:, 0] * rng.uniform(0.1, 0.9, (2000, len(claim.box)))
    q = reach.solve_inverse_kinematics(rng.uniform(joints[:, 0], joints[:, 1], (len(targets), claim.arm.n)), targets, 40)
    (lower, upper), margin = joints.T, _WITNESS_LIMIT_MARGIN
    is_valid = ((q >= lower + margin) & (q <= upper - margin) | ~reach.free).all(axis=1)
    is_valid &= (reach.measure_pose_error(q, targets) < _WITNESS_TOLERANCE).all(axis=1)
    return q[is_valid.argmax()] if is_valid.any() else None
