"""Kinematic chains of an arm and of its target, with enclosures of tool positions for configurations and for boxes of them.

Three prismatic and three revolute joints move a tool to any pose. A target is therefore the tool pose of such a chain, and an
arm reaches all targets of a box if its tool can follow the tool of this chain for all values of the chain's joints in the box.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from .balls import ROUND_UP, Array, BallArray, cross_matrix, einsum, flint, round_up, stack_second
from .forms import decompress_payload, parse_hex, require
from .tree import FIRST_LOCK_TOKEN, MAX_LEAVES, SPLIT_TOKEN, Cell, iterate_cells

Leaf = tuple[Cell, Any]  # a cell, and the data of its proof
IDENTITY_HEX = [float(k % 4 == 0).hex() for k in range(9)]


def enclose_rotation(numbers: list[str]) -> BallArray:
    """Return nine numbers R as balls that contain the nearest rotation.

    Its distance from R is less than that of R'R from the identity, in the Frobenius norm.
    """
    matrix = flint.arb_mat(3, 3, [parse_hex(number) for number in numbers])
    gram = (matrix.transpose() * matrix - flint.arb_mat([[1, 0, 0], [0, 1, 0], [0, 0, 1]])).entries()
    radius = math.hypot(*(round_up(abs(number)) for number in gram)) * ROUND_UP
    is_rotation = radius < 1e-12 and matrix.det() > 0
    require(is_rotation, "a rotation of the file is invalid; its columns must be orthonormal to 1e-12 and right-handed")
    return BallArray(np.reshape([parse_hex(number) for number in numbers], (3, 3)), radius)


def enclose_sine_and_cosine(exact: Fraction) -> list[float]:
    """Return a number as a double, its error radius, 0 (for a half width), and its sine and cosine."""
    sine, cosine = flint.arb(flint.fmpq(exact.numerator, exact.denominator)).sin_cos()
    require(max(round_up(sine.rad()), round_up(cosine.rad())) < 2.0**-55, "an angle is too large to compute its sine")
    return [float(exact), 2.0**-52 * abs(float(exact)), 0.0, float(sine), float(cosine)]


def enclose_sines_and_cosines(values: Array) -> Array:
    """Return the rows of :func:`enclose_sine_and_cosine` for doubles below 2^7, which are exact numbers (N, 5)."""
    rows = np.zeros((len(values), 5))
    rows[:, 0], rows[:, 3:] = values, [[float(number) for number in flint.arb(value).sin_cos()] for value in values.tolist()]
    return rows


def build_target_chain(target: dict[str, Any]) -> dict[str, Any]:
    """Build the chain of a target: slides along z, y and x, or y and x, then rotations by yaw, pitch and roll, or yaw."""
    axes, first, orientation = target["axes"], [IDENTITY_HEX] * ("z" in target["axes"]), target["orientation"] or IDENTITY_HEX
    kinds = ["prismatic"] * sum(axis in "xyz" for axis in axes) + ["revolute"] * sum(axis not in "xyz" for axis in axes)
    # The first cyclic permutation of the rows maps z to y, the next y to x, and so on; three of them are the identity.
    rotations = (first + [IDENTITY_HEX[3:] + IDENTITY_HEX[:3]] * 6)[: len(kinds)]
    frames = [{"rotation": rows, "origin": ["0x0p+0"] * 3} for rows in rotations]
    tool = {"rotation": orientation if axes == "xya" else orientation[3:] + orientation[:3], "origin": ["0x0p+0"] * 3}
    return {"joints": [frame | {"type": kind} for frame, kind in zip(frames, kinds, strict=True)], "tool": tool}


@dataclass(frozen=True)
class PointKinematics:
    """Point of a link in the frame of another link, for N configurations and k joints between the links.

    ``tip`` (N, 3) is the point, ``rotation`` (N, 3, 3) the rotation of its link, ``axes`` (N, k, 3) the axes of the joints, in
    ``spin_axes`` 0 for a prismatic joint, ``points`` (N, k, 3) points on the axes, ``columns`` (N, k, 3) the derivatives.
    """

    tip: BallArray
    rotation: BallArray
    axes: BallArray
    spin_axes: BallArray
    points: BallArray
    columns: BallArray


class BallChain:
    """Chain of joints about or along the z axes of their frames, and the tool behind them."""

    def __init__(self, arm: dict[str, Any], planar: bool = False) -> None:
        frames, self.n = [*arm["joints"], arm["tool"]], len(arm["joints"])
        self.slides = np.array([joint["type"] == "prismatic" for joint in arm["joints"]])
        self.origins = [np.array([parse_hex(value) for value in frame["origin"]]) for frame in frames]
        self.turns = [enclose_rotation(frame["rotation"]) for frame in frames]
        if planar:  # all motions lie in the plane, so heights do not matter
            matrices = [rotation.center for rotation in self.turns]
            is_planar = all(abs(x[2, 2]) == 1 and not x[2, :2].any() and not x[:2, 2].any() for x in matrices)
            require(is_planar and not self.slides.any(), "a planar task needs an arm that stays in the plane")
            self.origins = [value * [1, 1, 0] for value in self.origins]
        self.link_lengths = self.bound_link_lengths(0, self.n)

    def enclose_point(self, joints: list[Array], first: int = 0, end: Array | None = None, count: int = 1) -> PointKinematics:
        """Enclose a point in the frame of the joint behind some joints that begin with ``first``; default: the tool point.

        Each joint is an array (N, 5) of :func:`enclose_sine_and_cosine`; ``count`` is N if there are no joints.
        """
        count, end = len(joints[0]) if joints else count, self.origins[-1] if end is None else end
        tip, orientation = BallArray(np.zeros((count, 3))), BallArray(np.broadcast_to(np.eye(3), (count, 3, 3)))
        empty, axes, points = BallArray(np.zeros((count, 0, 3))), [], []
        for index, joint in enumerate(joints, first):
            tip = tip + einsum("nij,j->ni", orientation, self.origins[index])
            orientation = einsum("nij,jk->nik", orientation, self.turns[index])
            axes.append(orientation[:, :, 2])
            points.append(tip)
            if self.slides[index]:
                tip += einsum("ni,n->ni", axes[-1], BallArray(joint[:, 0], joint[:, 1]))
            else:
                cosine, sine, zeros = joint[:, 4], joint[:, 3], np.zeros(count)
                joint_rotation = np.array([[cosine, -sine, zeros], [sine, cosine, zeros], [zeros, zeros, zeros + 1]])
                orientation = einsum("nij,njk->nik", orientation, BallArray(joint_rotation.transpose(2, 0, 1), 2.0**-52))
        tip += einsum("nij,j->ni", orientation, end)
        if first + len(joints) == self.n:
            orientation = einsum("nij,jk->nik", orientation, self.turns[-1])
        z, axis_points = (stack_second(vectors) if joints else empty for vectors in (axes, points))
        slides = self.slides[first : first + len(joints), None]
        spin_axes = z.multiply_signs(1.0 * ~slides)
        columns = einsum("nkij,nkj->nki", cross_matrix(spin_axes), tip[:, None] + -axis_points) + z.multiply_signs(1.0 * slides)
        return PointKinematics(tip, orientation, z, spin_axes, axis_points, columns)

    def bound_link_lengths(self, first: int, last: int, end: Array | None = None) -> Array:
        """Bound the lengths, m, that each of some joints and the joints before it rotate, but the next joint does not.

        A length is the part of the link across the joint's axis (the whole link for a prismatic joint), plus the part of the
        next link along the next axis.
        """
        links, lengths = [*self.origins[first + 1 : last], self.origins[-1] if end is None else end], np.zeros(last - first)
        for index, link in enumerate(links[: last - first]):
            extent = BallArray(link * [1, 1, self.slides[first + index]])
            if index + 1 < len(links) and not self.slides[first + index + 1]:
                extent += einsum("ij,j->i", self.turns[first + index + 1], links[index + 1] * [0, 0, 1])
            lengths[index] = math.hypot(*extent.magnitude) * ROUND_UP
        return lengths

    def bound_derivative(self, order: int, joint_travel: Array, lengths: Array, slide_extent: Array, first: int = 0) -> Array:
        """Bound the norm (N,) of a derivative of a point along joint motions of at most ``joint_travel`` (N, k).

        ``slide_extent`` (N, k) is the extent of the prismatic joints at the center.
        """
        slides = self.slides[first : first + joint_travel.shape[1]]
        c, slide_range = np.cumsum(joint_travel * ~slides, axis=1) * ROUND_UP, joint_travel * slides
        terms = c**order * (lengths + np.abs(slide_extent) * slides + slide_range) + order * c ** (order - 1) * slide_range
        return np.asarray(terms.sum(axis=1) * ROUND_UP)


def read_bisection(
    document: dict[str, Any], axes: int, leaf_tokens: Collection[int]
) -> tuple[int, list[Cell], Callable[[], Iterator[Leaf]]]:
    """Return the number of leaves of a tree, its undecided cells, and an iterator of its leaves with their numbers.

    The number is 0, or for tokens from ``FIRST_LOCK_TOKEN`` on their distance from it.
    """
    tree = decompress_payload(document["tree"], 2 * MAX_LEAVES - 1, "tree")
    is_valid = set(tree) <= {2, *leaf_tokens, *range(SPLIT_TOKEN, SPLIT_TOKEN + axes)}
    require(is_valid, "a token of the tree is unknown, or not among the locks")
    undecided = [cell for token, cell in iterate_cells(tree, axes, 2, FIRST_LOCK_TOKEN) if token == 2]

    def iterate_leaves() -> Iterator[Leaf]:
        cells = iterate_cells(tree, axes, 2, FIRST_LOCK_TOKEN)
        return ((cell, max(token - FIRST_LOCK_TOKEN, 0)) for token, cell in cells if token != 2)

    return sum(tree.count(token) for token in leaf_tokens), undecided, iterate_leaves


class LeafVerifier:
    """Verifier of the leaves of a tree over a root box."""

    targets: slice | None = None  # the axes of the box that belong to targets

    def __init__(self, document: dict[str, Any], intervals: Iterable[Iterable[Any]]) -> None:
        self._document = {key: value for key, value in document.items() if key not in ("tree", "centres")}
        exact_intervals = [[Fraction(parse_hex(x) if isinstance(x, str) else x) for x in pair] for pair in intervals]
        self.low, self.width = [low for low, _ in exact_intervals], [high - low for low, high in exact_intervals]
        self._cache: dict[tuple[int, int, int], list[float]] = {}

    def __reduce__(self) -> tuple[Any, ...]:  # another process makes its own balls
        return type(self), (self._document,)

    def enclose_centers(self, cells: Iterable[Cell], first: int = 0) -> list[Array]:
        """Return the rows (N, 5) of :func:`enclose_sine_and_cosine` for the centers of each axis from ``first`` on.

        Their half widths are rounded up.
        """
        columns = enumerate(zip(*cells, strict=True), first)
        return [np.array([self._enclose_interval_center(axis, part) for part in parts]) for axis, parts in columns]

    def find_unproved_cells(self, rejected: list[Leaf], leaves: Callable[[], Iterator[Leaf]]) -> list[Cell]:
        """Return the cells of the root box that rejected leaves leave unproved."""
        return [cell for cell, _ in rejected]

    def find_refuted_cells(self, leaves: Callable[[], Iterator[Leaf]]) -> set[Cell]:
        """Return the cells in which the claim is false."""
        return set()

    def check_leaves(self, chunk: list[Leaf]) -> tuple[int, list[Leaf]]:
        """Check leaves, and return their number and the leaves that prove nothing."""
        rejected = list[Leaf]()
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            for kind in sorted({self.leaf_kind(leaf) for leaf in chunk}):
                group = [leaf for leaf in chunk if self.leaf_kind(leaf) == kind]
                rejected += [leaf for leaf, proved in zip(group, self.verify_leaves(kind, group), strict=True) if not proved]
        return len(chunk), rejected

    def leaf_kind(self, leaf: Leaf) -> Any:
        """Return the kind of a leaf; leaves of one kind are verified together."""
        return leaf[1]

    def verify_leaves(self, kind: Any, leaves: list[Leaf]) -> Iterable[Any]:
        """Return flags of the leaves of one kind that are proved."""
        raise NotImplementedError

    def _enclose_interval_center(self, axis: int, index_and_depth: tuple[int, int]) -> list[float]:
        (k, d), key = index_and_depth, (axis, *index_and_depth)
        if key not in self._cache:
            self._cache[key] = enclose_sine_and_cosine(self.low[axis] + self.width[axis] * Fraction(2 * k + 1, 2 << d))
            self._cache[key][2] = math.nextafter(float(self.width[axis] / (2 << d)), math.inf)
        return self._cache[key]


def enclose_configuration(q: list[str]) -> list[Array]:
    """Return joint values, one row for each joint, in the form for :meth:`BallChain.enclose_point`."""
    values = [parse_hex(number) for number in q]
    require(max(map(abs, values)) < 100, "a joint of a configuration is beyond 100 rad or m")
    return [enclose_sines_and_cosines(np.array([number])) for number in values]
