"""Verification of the leaves of a refutation: no configuration of the arm has the tool at a target.

In each leaf some combination of the task's rows is not 0, or the distance of a point of some link from the target lies outside
the range of distances between the tool and this point. A lemma bounds this range, with its own tree over the joints behind the
link.

If the tool pose is given, base, joints and tool form a closed loop. The distance between two points of links through the joints
between them equals their distance through the tool and the base. A leaf excludes the configurations for which it cannot.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import numpy as np

from .balls import ROUND_UP, Array, BallArray, Flags, bound_length, cross_matrix, einsum, flint, solve_or_nan
from .chain import BallChain, Leaf, LeafVerifier, enclose_configuration, enclose_sine_and_cosine
from .forms import NUMBER_PATTERN, TEXT_PATTERN, decompress_payload, parse_hex, require
from .motions import HealthyMotion
from .paths import SEGMENT_INSTANTS, StoredRefutation
from .targets import CENTER_UNIT, ReachVerifier, TargetLeafVerifier, locked_target_schema
from .taylor import DerivativeEnclosure, enclose_difference, vector_derivatives
from .tree import MAX_LEAVES, PROVED_TOKEN, SPLIT_TOKEN, Cell, iterate_cells

FIRST_LEMMA_TOKEN = 3  # token of a leaf that the first lemma excludes; 0 if the task rows exclude it
WITNESS_LEAF = (-2, 0)  # kind of a leaf that is a witness; (-1, k) for leaves of the main tree, (k, k) for those of a lemma


def bound_norm_below(form: DerivativeEnclosure, linear: int, remainders: tuple[Any, Any], half: Array) -> Array:
    """Bound the norm of the numbers from below along unit directions e; every direction is valid, and some are tried.

    ``remainders`` (N,) bound the terms after second order of the first ``linear`` numbers, as a vector, and of the others.
    """
    value, spans, identity = form.value.center, form.slopes.center * half[:, None], np.eye(form.value.center.shape[1])
    spread = spans @ spans.transpose(0, 2, 1) + (1e-6 * (value**2).sum(axis=1) + 1e-30)[:, None, None] * identity
    whitened = solve_or_nan(np.nan_to_num(spread) + 1e-30 * identity, value[:, :, None])[:, :, 0]
    best, is_position = np.full(len(value), -np.inf), np.arange(len(identity)) < linear
    for direction in (value, whitened, *([value * is_position, value * ~is_position] if linear < len(identity) else [])):
        unit = direction / np.sqrt((direction**2).sum(axis=1))[:, None] * (1 - 1e-12)
        unit = np.where(((unit**2).sum(axis=1) < 1 - 1e-13)[:, None], unit, 0.0)
        projection = form.combine_rows(BallArray(unit))
        loss = projection.bound_decrease_and_increase(half)[0][:, 0] + bound_length(unit * is_position) * remainders[0]
        loss = loss + bound_length(unit * ~is_position) * remainders[1]
        best = np.maximum(best, np.nextafter(projection.value.lower[:, 0] - loss * ROUND_UP, -np.inf))
    return best


def bound_norm_range(form: DerivativeEnclosure, derivatives: list[Array], half: Array) -> tuple[Array, Array]:
    """Bound the norm of a vector v from below, and from above through half its square.

    ``derivatives`` are upper bounds of the norms of its derivatives along half widths. The third derivative of half its square
    is at most three times the product of the first and second, plus the norm times the third.
    """
    (first_derivative, second_derivative, third_derivative), norm = derivatives, bound_length(form.value.magnitude)
    second = einsum("naj,nak->njk", form.slopes, form.slopes) + einsum("na,najk->njk", form.value, form.second)
    square = DerivativeEnclosure(form.value, einsum("na,nak->nk", form.value, form.slopes)[:, None], second[:, None])
    cubic = (3 * first_derivative * second_derivative + (norm + first_derivative) * third_derivative) / 6
    squared = norm**2 + 2 * (square.bound_decrease_and_increase(half)[1][:, 0] + cubic)
    upper = np.nextafter(np.sqrt(squared * ROUND_UP), np.inf)
    return bound_norm_below(form, 3, (third_derivative / 6, 0), half), np.asarray(upper)


def bound_distance_range(
    chain: BallChain, joints: list[Array], first: int, start: Array, end: Array, count: int
) -> tuple[Array, Array]:
    """Bound the distance (N,) of a point of link ``first`` from a point behind some joints, from below and above."""
    kinematics, half, slide_extent = chain.enclose_point(joints, first, end, count), *np.zeros((2, count, len(joints)))
    for index, joint in enumerate(joints):
        half[:, index], slide_extent[:, index] = joint[:, 2], joint[:, 0]
    # First axes that pass close to the point are ignored; rotations about them change the distance by at most ``displacement``.
    displacement, is_ignored = np.zeros(count), np.ones(count, dtype=bool)
    levers = einsum("nkij,nkj->nki", cross_matrix(kinematics.axes), -kinematics.points + start).magnitude
    for index, is_prismatic in enumerate(chain.slides[first : first + len(joints)]):
        cost = bound_length(levers[:, index]) * np.minimum(half[:, index], 2) * ROUND_UP
        is_ignored &= (cost < 1e-6) & (not is_prismatic)
        half[:, index] = np.where(is_ignored, 0.0, half[:, index])
        displacement = (displacement + np.where(is_ignored, cost, 0.0)) * ROUND_UP
    lengths = chain.bound_link_lengths(first, first + len(joints), end)
    form = DerivativeEnclosure(kinematics.tip + -start, *vector_derivatives(kinematics.spin_axes, kinematics.columns))
    lower, upper = bound_norm_range(
        form, [chain.bound_derivative(order, half, lengths, slide_extent, first) for order in (1, 2, 3)], half
    )
    return np.nextafter(lower - displacement, -np.inf), np.nextafter(upper + displacement, np.inf)


class RefutationVerifier(TargetLeafVerifier):
    """Verifier of a refutation, in which the tool misses every target."""

    def __init__(self, document: dict[str, Any]) -> None:
        limits, lemmas, planar = list(document["limits"]), document["lemmas"], document["task"].startswith("planar")
        if document["locked"] >= 0:
            limits[document["locked"]] = document["angle"]
        super().__init__(document, limit_to_revolution(limits, document["arm"]["joints"]), [], planar)
        self.points = [np.array([parse_hex(number) for number in lemma["point"]]) * [1, 1, not planar] for lemma in lemmas]
        self.links = [lemma["link"] for lemma in lemmas]
        self.least, self.most = ([parse_hex(lemma[key]) for lemma in lemmas] for key in ("least", "most"))

    def read_leaves(self, document: dict[str, Any]) -> tuple[int, list[Cell], Callable[[], Iterator[Leaf]]]:
        """Return the number of leaves, the undecided cells of the main tree, and an iterator of the leaves."""
        main_tree = decompress_payload(document["tree"], 2 * MAX_LEAVES - 1, "tree")
        axis_count = len(self.width)
        last_token = 2 + len(self.links)
        trees = [decompress_payload(lemma["tree"], 2 * MAX_LEAVES - 1, "tree of a lemma") for lemma in document["lemmas"]]
        require(last_token < SPLIT_TOKEN, f"there are more than {SPLIT_TOKEN - FIRST_LEMMA_TOKEN} lemmas")
        require(not any(tree.count(token) for tree in trees for token in (1, 2)), "a lemma is not proved everywhere")
        undecided = [cell for token, cell in iterate_cells(main_tree, axis_count, last_token) if token in (1, 2)]
        if document["witness"]:
            require(main_tree == b"\2" and not trees, "a file with a witness must not prove anything else")
            return 1, undecided, lambda: iter([(undecided[0], WITNESS_LEAF)])
        count = sum(tree.count(0) for tree in trees)
        count += sum(main_tree.count(token) for token in (PROVED_TOKEN, *range(FIRST_LEMMA_TOKEN, last_token + 1)))

        def iterate_leaves() -> Iterator[Leaf]:
            for index, tree in enumerate(trees):
                yield from ((cell, (index, index)) for _, cell in iterate_cells(tree, self.n - self.links[index]))
            cells = iterate_cells(main_tree, axis_count, last_token)
            yield from ((cell, (-1, max(token, 2) - FIRST_LEMMA_TOKEN)) for token, cell in cells if token not in (1, 2))

        return count, undecided, iterate_leaves

    def find_unproved_cells(self, rejected: list[Leaf], leaves: Callable[[], Iterator[Leaf]]) -> list[Cell]:
        """Return the cells of the main tree that are rejected, or that need a lemma with a rejected leaf."""
        broken_lemmas = {tree for _, (tree, _) in rejected if tree >= 0}
        rejected_cells = {cell for cell, (tree, _) in rejected if tree == -1}
        return [cell for cell, (tree, lemma) in leaves() if tree == -1 and (lemma in broken_lemmas or cell in rejected_cells)]

    def verify_leaves(self, kind: tuple[int, int], leaves: list[Leaf]) -> Any:
        """Return a mask of the proved leaves of a lemma, or of the main tree by a lemma or (-1) by the task rows."""
        leaf_cells, (tree, lemma) = [cell for cell, _ in leaves], kind
        if kind == WITNESS_LEAF:
            return [self.verify_witness(self._document["witness"])]
        if tree >= 0:
            joints, tool_point = self.enclose_centers(leaf_cells, self.links[tree]), self.arm.origins[-1]
            lower, upper = bound_distance_range(
                self.arm, joints, self.links[tree], self.points[tree], tool_point, len(leaf_cells)
            )
            return ((lower >= self.least[tree]) | (self.least[tree] <= 0)) & (upper <= self.most[tree])
        axes = self.enclose_centers(leaf_cells)
        joints, target = axes[: self.n if lemma < 0 else self.links[lemma]], axes[self.n :]
        half = np.stack([values[:, 2] for values in (*joints, *(target[axis] for axis in self.error_axes))], 1)
        if lemma < 0:
            error = self.enclose_error(joints, target)
            remainders, _ = error.bound_remainder_and_angle(half)
            return bound_norm_below(error, error.linear, (remainders[:, 0], remainders[:, -1] * error.uses_rotation), half) > 0
        lower, upper = self.bound_target_distance(lemma, joints, target, half)
        return (lower > self.most[lemma]) | (upper < self.least[lemma])

    def bound_target_distance(self, lemma: int, joints: list[Array], target: list[Array], half: Array) -> tuple[Array, Array]:
        """Bound the distance of a lemma's point from the target from below and above, for half widths (N, V) of an error."""
        joint_count, point, joint_half = len(joints), self.points[lemma], half[:, : len(joints)]
        arm_point = self.arm.enclose_point(joints, 0, point, len(half))
        target_point = self.goal.enclose_point([target[axis] for axis in self.chain_axes])
        slide_extent = np.reshape([values[:, 0] for values in joints], joint_half.T.shape).T
        lengths = self.arm.bound_link_lengths(0, joint_count, point)
        derivatives = [self.arm.bound_derivative(order, joint_half, lengths, slide_extent) for order in (1, 2, 3)]
        derivatives[0] += bound_length(half[:, joint_count + self.turning :])
        arm_vectors, target_vectors = ((x, x.columns, x.tip) for x in (arm_point, target_point))
        return bound_norm_range(enclose_difference(*arm_vectors, *target_vectors), derivatives, half)

    def verify_witness(self, witness: list[str]) -> bool:
        """Return True if a witness satisfies the claim's limits and has its tool in the box of targets."""
        q, document = [parse_hex(number) for number in witness], self._document
        ranges = [document["angle"] if joint == document["locked"] else pair for joint, pair in enumerate(document["limits"])]
        tip = self.arm.enclose_point(enclose_configuration(witness)).tip
        sides = [[parse_hex(number) for number in pair] for pair in document["target"]["box"]]
        ends = zip(sides, tip.lower[0], -(-tip).lower[0], strict=False)
        in_limits = all(parse_hex(pair[0]) <= number <= parse_hex(pair[1]) for number, pair in zip(q, ranges, strict=True))
        in_box = all(a <= number and y <= b for (a, b), number, y in ends) and document["task"] in ("planar", "position")
        return in_limits and (in_box or self._reaches_nearby(q, tip.center[0], sides))

    def _reaches_nearby(self, q: list[float], tip: Array, sides: list[list[float]]) -> bool:
        """Return True if a configuration near q, with the same locked value, provably reaches a target of the box.

        The proof is that of a leaf of a reach.
        """
        linear = self.target_size - self.turning
        position = [min(max(x, lower), upper) for x, (lower, upper) in zip(tip.tolist()[:linear], sides, strict=False)]
        position += [(lower + upper) / 2 for lower, upper in sides[linear:]]
        document = self._document | {"target": self._document["target"] | {"box": [[x.hex(), x.hex()] for x in position]}}
        if document["locked"] >= 0:
            document["angle"] = [q[document["locked"]].hex()] * 2
        reach_verifier = ReachVerifier(document)
        center_units = np.where([joint in reach_verifier.free for joint in range(self.n)], np.array(q) / CENTER_UNIT, 0.0)
        return bool(reach_verifier.verify_leaves(0, [(((0, 0),) * len(reach_verifier.width), center_units)])[0])


class LoopClosureVerifier(LeafVerifier):
    """Verifier that no configuration with joints in given ranges has the tool pose of ``tool_q``.

    ``uses_rotation`` is True if the pose includes the rotation; otherwise the later one of two points must be the tool point.
    """

    def __init__(
        self, arm: dict[str, Any], ranges: list[Any], *, tool_q: list[Fraction], uses_rotation: bool, planar: bool
    ) -> None:
        super().__init__({}, limit_to_revolution(ranges, arm["joints"]))
        self.chain = BallChain(arm, planar)
        self.n = len(ranges)
        self.uses_rotation = uses_rotation
        self._plane_mask = np.array([1, 1, not planar])
        chain, self.tip = self.chain, self.chain.origins[-1]
        kinematics = chain.enclose_point([np.array([enclose_sine_and_cosine(x)]) for x in tool_q])
        # Position and rotation of the base in the frame of the last link.
        base_rotation = einsum("ij,jk->ik", chain.turns[-1], kinematics.rotation[0].transpose(1, 0))
        self._base_frame = -einsum("ij,j->i", base_rotation, kinematics.tip[0]) + self.tip, base_rotation
        base_point = self._to_last_link_frame(chain.origins[0])
        chain.origins = [*chain.origins[:-1], base_point.center, *chain.origins[1:]]
        chain.turns = [*chain.turns[:-1], einsum("ij,jk->ik", base_rotation, chain.turns[0]), *chain.turns[1:]]
        chain.slides, chain.n, self._base_radius = np.tile(chain.slides, 2), 2 * self.n, base_point.radius

    def _to_last_link_frame(self, point: Array) -> BallArray:
        """Return a point of the base in the frame of the last link."""
        return self._base_frame[0] + einsum("ij,j->i", self._base_frame[1], point)

    def find_excluded_cells(self, pair: list[tuple[int, Array]], leaf_cells: list[Cell]) -> Flags:
        """Return a mask of cells in which two points cannot have equal distances along both branches of the loop.

        A point is its link and its position (3,) in the frame of the link, m.
        """
        (first, a), (last, b) = ((link, point * self._plane_mask) for link, point in pair)
        is_known = self.uses_rotation or (last == self.n and (b == self.tip).all())
        require(first <= last and is_known, "a point is behind the one it is paired with, or its place is not known")
        joints, count = self.enclose_centers(leaf_cells), len(leaf_cells)
        lower, upper = bound_distance_range(self.chain, joints[first:last], first, a, b, count)
        end_point = BallArray(a) if first else self._to_last_link_frame(a)
        other_lower, other_upper = bound_distance_range(
            self.chain, joints[last:] + joints[:first], last, b, end_point.center, count
        )
        radius = bound_length(self._base_radius + end_point.radius, 0) * 2
        return np.asarray((lower > (other_upper + radius) * ROUND_UP) | (upper < other_lower - radius * ROUND_UP))


class PathRefutationVerifier(HealthyMotion):
    """Verifier of lock instants of a path after which no configuration reaches the tool pose at some later path instant."""

    def __init__(self, document: dict[str, Any]) -> None:
        super().__init__(document)
        self._points = [(point["link"], np.array([parse_hex(x) for x in point["place"]])) for point in document["points"]]

    def check_leaves(self, chunk: list[StoredRefutation]) -> tuple[int, list[tuple[StoredRefutation, int]]]:
        """Check refutations, and return the number of leaves, and failed refutations with their number of rejected leaves."""
        rejected, document = list[tuple[StoredRefutation, int]](), self._document
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            for refutation in chunk:
                lock_index, ends, path_instant, leaves = refutation
                lock = document["locks"][lock_index]["joint"]
                ranges = [[parse_hex(number) for number in pair] for pair in document["limits"]]
                ranges[lock] = sorted(self.interpolate_joints(2 * k, max(k - 1, 0) // SEGMENT_INSTANTS)[lock] for k in ends)
                tool_q = self.interpolate_joints(2 * path_instant, (path_instant - 1) // SEGMENT_INSTANTS)
                uses_rotation = "pose" in self.task
                planar = self.task.startswith("planar")
                loop = LoopClosureVerifier(document["arm"], ranges, tool_q=tool_q, uses_rotation=uses_rotation, planar=planar)
                excluded = 0
                for token in sorted({token for token, _ in leaves}):
                    pair = [self._points[index] for index in document["pairs"][token]]
                    excluded += int(loop.find_excluded_cells(pair, [cell for kind, cell in leaves if kind == token]).sum())
                rejected += [(refutation, len(leaves) - excluded)] * (excluded < len(leaves))
        return sum(len(leaves) for *_, leaves in chunk), rejected


def limit_to_revolution(ranges: list[Any], joints: list[dict[str, Any]]) -> list[Any]:
    """Limit the ranges (low, high) of revolute joints to one full revolution."""
    half_turn, limited = math.nextafter(math.pi, 4), list[Any]()
    for pair, joint in zip(ranges, joints, strict=True):
        lower, upper = (parse_hex(number) if isinstance(number, str) else number for number in pair)
        is_revolute = joint["type"] == "revolute"
        require(is_revolute or math.isfinite(upper - lower), f"{joint['name']} is prismatic and has no limits")
        limited.append([-half_turn, half_turn] if is_revolute and not upper - lower < 2 * math.pi else [lower, upper])
    return limited


def refutation_schema(document: dict[str, Any], n: int) -> dict[str, Any]:
    """Return the form of the keys that a refutation has in addition to the common ones."""
    form = locked_target_schema(document, n)
    lemma: dict[str, Any] = {"link": range(n), "point": [NUMBER_PATTERN, 3], "least": NUMBER_PATTERN}
    lemma |= {"most": NUMBER_PATTERN, "tree": TEXT_PATTERN}
    return form | {"lemmas": [lemma, ...], "witness": [NUMBER_PATTERN, n] if document.get("witness") else None}
