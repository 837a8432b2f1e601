"""Clearance of an arm from itself and from a cell: the smallest distance between bodies that could collide."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from functools import lru_cache
from itertools import combinations
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.caching import cached_property
from holdfast.core.errors import ArmError
from holdfast.core.probability.sobol_sequence import sobol_points
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.core.validation import check_arguments
from holdfast.kernels.disk_cache import cached_json, cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import Vector, dot_product, select_smallest
from holdfast.kernels.program import SX
from holdfast.model.arm import kinematics
from holdfast.model.arm.configurations import as_configurations, sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import plane_normal
from holdfast.model.cell.cell import Cell
from holdfast.model.collision.capsules import Capsules, IgnoredPair
from holdfast.model.collision.changes import capsule_lipschitz_bounds
from holdfast.model.collision.obstacles import Obstacles
from holdfast.model.collision.segments import LineSegment, closest_parameters, distance_between_points, separating_wrench

if TYPE_CHECKING:
    from holdfast.model.collision.exact.exactness import ExactQueries
    from holdfast.model.collision.exact.narrow_phase import ArmBody

Pair = tuple[int, int]

_OVERLAP_SAMPLES = 512  # configurations
_ALWAYS_FRACTION = 0.95  # pairs that overlap in this fraction of the configurations touch by construction


class Clearance:
    """Smallest distance, m, between the capsules of an arm and the objects of its cell; below 0 in a collision.

    A negative distance between two capsules is minus the penetration depth: the distance between the axes minus the two radii.
    The distance from an object of the cell is a lower bound, computed from the spheres that cover the capsules of a link.

    Some pairs of capsules are not checked: those of one link, of adjacent links, of links under ``ignore`` (held objects are
    checked against all links except the last), and pairs that touch by construction, which overlap in at least 95 % of 512
    configurations within the limits (the first 512 points of the unscrambled Sobol sequence; +-pi rad or +-1 m if there is no
    limit). Such pairs have only short links between them, for example the two sides of an elbow, so their overlap has no
    meaning. The default collision matrix of the MoveIt Setup Assistant has the same criterion (Coleman et al. 2014, J. Software
    Eng. Robotics 5(1)).

    Args:
        arm: Arm model.
        capsules: Collision model of the arm. Default: a cover of the collision shapes of the arm's file
            (:func:`holdfast.model.collision.cover.choose_capsules`) or, without such shapes, :meth:`Capsules.along_links`,
            whose radius is an assumption. Held objects of the cell are added to the last link.
        cell: Objects around the arm; default: none. Objects are never adjacent to a link and never left out; only ``may_touch``
            of the cell excludes a pair.
        itself: Check the arm's own links against each other.

    Attributes:
        arm, capsules, cell: Arguments of the constructor.
        obstacles: Objects of the cell as obstacles of the arm, or None.
        margins: (P,) required distance of each pair, m: 0 between links, the object's or the cell's margin otherwise.
        pairs: Positions in ``capsules.parts`` of the checked capsules, the one nearer to the base first.
        pair_names: Names of all P pairs: links, ``base & joint3``, by the joints that move them, with the number of the capsule
            if a link has several; then each link with each object, ``joint3 & table``.
        ignored: Pairs on different links that are not checked, with the reason.

    Raises:
        ArmError: A capsule belongs to a link that the arm does not have.
        InputError: The base touches an object, or ``may_touch`` names no object of the cell or no link of the arm.
    """

    @check_arguments
    def __init__(self, arm: Arm, capsules: Capsules | None = None, cell: Cell | None = None, *, itself: bool = True) -> None:
        self.arm = arm
        if capsules is None or (cell is not None and cell.held):
            from holdfast.model.collision.cover import capsules_in_cell  # slow to import

            capsules = capsules_in_cell(arm, cell, capsules)
        self.capsules = capsules.without_held if cell is None or not cell.held else capsules
        highest = max(
            (link for link in self._capsule_links + [ignored_link for pair in self.capsules.ignore for ignored_link in pair]),
            default=-1,
        )
        if highest >= arm.n:
            raise ArmError(f"a capsule names link {highest}, but '{arm.name}' has links -1 (base) to {arm.n - 1}")
        self.pairs: list[Pair] = []
        self.ignored: list[IgnoredPair] = []
        self.itself = itself
        if itself:
            self._choose_pairs()
        self._own_pair_names = [self._pair_name(pair) for pair in self.pairs]
        self._set_cell(cell)

    def _set_cell(self, cell: Cell | None) -> None:
        obstacles = None if cell is None or not len(cell) else Obstacles(self.arm, self.capsules, cell)
        self.cell, self.obstacles = cell, obstacles
        self.pair_names = self._own_pair_names + ([] if obstacles is None else obstacles.names)
        self.margins = np.concatenate([np.zeros(len(self.pairs)), np.zeros(0) if obstacles is None else obstacles.margins])

    def with_cell(self, cell: Cell | None) -> Clearance:
        """Return the clearance in another ``cell``; the arm's own pairs are chosen again only if the held objects differ."""
        same_held = getattr(self.cell, "held", ()) == getattr(cell, "held", ())
        return self._copy_with_cell(cell) if same_held else Clearance(self.arm, self.capsules, cell, itself=self.itself)

    def _copy_with_cell(self, cell: Cell | None) -> Clearance:
        clearance_copy = copy(self)
        clearance_copy._set_cell(cell)
        if cell is not None:
            vars(clearance_copy)["self_only"] = self.self_only  # with its kernels
        return clearance_copy

    @classmethod
    def by_default(cls, arm: Arm, cell: Cell | None = None) -> Clearance | None:
        """Return the default clearance of ``arm`` in ``cell``: with the default of ``capsules``.

        The links of a planar arm lie next to each other, not in one plane, so they are not checked against each other. Without
        a cell there is then nothing to check, and the result is None.
        """
        is_planar = plane_normal(arm) is not None
        if is_planar and cell is None:
            return None
        if cell is not None and cell.changes_arm:
            return cls(arm, cell=cell, itself=not is_planar)
        clearance = _default_clearance(arm, not is_planar)
        return clearance if cell is None else clearance._copy_with_cell(cell)

    # ---- choice of pairs ---------------------------------------------------------------------------------------

    @property
    def _capsule_links(self) -> list[int]:
        return [part.link for part in self.capsules]

    def _choose_pairs(self) -> None:
        reasons: dict[Pair, str] = {}
        links = self._capsule_links
        by_link = sorted(range(len(links)), key=links.__getitem__)
        different = [(first, second) for first, second in combinations(by_link, 2) if links[first] != links[second]]
        first_held = len(links) - self.capsules.held  # first held object; the rules for links do not apply to it
        for first, second in different:
            if second >= first_held:
                continue
            lower_link, upper_link = links[first], links[second]
            if upper_link - lower_link == 1:
                reasons[first, second] = "adjacent links"
            elif (lower_link, upper_link) in self.capsules.ignore or (
                min(first, second),
                max(first, second),
            ) in self.capsules.apart:
                reasons[first, second] = "to be ignored"
        open_pairs = [pair for pair in different if pair not in reasons]
        for pair, fraction in zip(open_pairs, self._overlap_fractions(open_pairs) if open_pairs else [], strict=True):
            if fraction >= _ALWAYS_FRACTION:
                reasons[pair] = f"overlap in {100 * fraction:.1f} % of {_OVERLAP_SAMPLES} configurations within the limits"
            else:
                self.pairs.append(pair)
        self.ignored = [IgnoredPair(pair, self._pair_name(pair), reasons[pair]) for pair in different if pair in reasons]

    @cached_json
    def _overlap_fractions(self, pairs: list[Pair]) -> list[float]:
        """Return the fraction of configurations in which each pair overlaps."""
        lower, upper = sampling_limits(self.arm)
        q = lower + (upper - lower) * sobol_points(_OVERLAP_SAMPLES, self.arm.n)
        symbols = kinematics.joint_symbols(self.arm)
        # Used once, so the virtual machine, which needs no compilation, is faster.
        values = Kernel(
            "overlaps", [symbols], [ca.vertcat(*self._pair_distances(self._capsule_axes(symbols), pairs))], backend="casadi"
        ).rows(q)
        return [float(fraction) for fraction in (values < 0).mean(axis=0)]

    def _pair_name(self, pair: Pair) -> str:
        return " & ".join(self.capsules.label(self.arm, part) for part in pair)

    # ---- symbols -----------------------------------------------------------------------------------------------

    @property
    def _reference_link(self) -> int:
        """Link whose frame all expressions use, in the middle of the arm, which gives equal distances by shorter code."""
        return self.arm.n // 2

    def _capsule_axes(self, q: SX) -> list[LineSegment]:
        """Return the axes of the capsules."""
        moving, _ = kinematics.body_and_joint_frames(self.arm, kinematics.joint_transforms(self.arm, q), self._reference_link)
        axes = []
        for part in self.capsules:
            rotation, position = moving[part.link + 1]
            span = np.subtract(part.end, part.start)
            start = position + rotation @ kinematics.constant_matrix(np.array(part.start))
            axes.append(LineSegment(start, rotation @ kinematics.constant_matrix(span), float(span @ span)))
        return axes

    def _pair_distances(self, axes: list[LineSegment], pairs: list[Pair]) -> list[SX]:
        radius_sums = [sum(self.capsules.parts[part].radius for part in pair) for pair in pairs]
        return [
            distance_between_points(axes[first], axes[second], *closest_parameters(axes[first], axes[second])) - radius_sum
            for (first, second), radius_sum in zip(pairs, radius_sums, strict=True)
        ]

    def _pair_wrenches(self, axes: list[LineSegment]) -> list[SX]:
        feet = [(first, second, closest_parameters(axes[first], axes[second])) for first, second in self.pairs]
        return [separating_wrench(axes[first], axes[second], *parameters) for first, second, parameters in feet]

    def _joint_screws(self, q: SX) -> list[SX]:
        """Return the screw (6,) of each joint: its product with a wrench is the power per unit of joint speed."""
        chain = kinematics.kinematic_chain(self.arm, q, self._reference_link)
        return [
            ca.vertcat(ca.SX(3, 1), axis) if joint.prismatic else ca.vertcat(axis, ca.cross(point, axis))
            for joint, axis, point in zip(self.arm.joints, chain.axes, chain.points, strict=True)
        ]

    def distances(self, q: SX) -> list[SX]:
        """Return the distance of every checked pair, m, for other programs; the smallest one is the clearance.

        Args:
            q: (n,) symbols or expressions, rad and m.
        """
        return self._pair_distances(self._capsule_axes(q), self.pairs)

    def slopes(self, q: SX, directions: Sequence[SX]) -> list[Vector]:
        """Return the derivatives of :meth:`distances` at ``q`` (n,) along each of the ``directions`` (n,), one list per pair.

        Only the joints between two links move one relative to the other. The result is exact, and its code is shorter and more
        stable than the derivative of the distances, in which the feet of nearly parallel capsules give huge numbers that
        cancel.
        """
        screws = self._joint_screws(q)
        derivatives = []
        for (first, second), wrench_symbol in zip(self.pairs, self._pair_wrenches(self._capsule_axes(q)), strict=True):
            moving_joints = range(self._capsule_links[first] + 1, self._capsule_links[second] + 1)
            row = [ca.dot(screws[joint], wrench_symbol) for joint in moving_joints]
            derivatives.append([dot_product(row, [direction[joint] for joint in moving_joints]) for direction in directions])
        return derivatives

    def smallest_with_slopes(self, q: SX, directions: Sequence[SX]) -> tuple[SX, Vector]:
        """Return the clearance at ``q`` (n,) and its derivatives along the ``directions`` (n,): those of the closest pair."""
        best_distance: SX = None
        best_derivatives: Vector = []
        for value, derivatives in zip(self.distances(q), self.slopes(q, directions), strict=True):
            if best_distance is None:
                best_distance, best_derivatives = value, derivatives
                continue
            closer = value < best_distance
            best_derivatives = [ca.if_else(closer, new, old) for new, old in zip(derivatives, best_derivatives, strict=True)]
            best_distance = ca.if_else(closer, value, best_distance)
        return best_distance, best_derivatives

    @cached_property
    def self_only(self) -> Clearance:
        """Clearance without the cell, from which kernels are compiled, so that a changed cell needs no new kernel."""
        return self if self.cell is None else self._copy_with_cell(None)

    @cached_property
    @cached_kernel
    def _value_kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        return Kernel("clearance", [q], [select_smallest(self.distances(q))])

    @cached_property
    @cached_kernel
    def _pair_distances_kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        return Kernel("clearance by pair", [q], [ca.vertcat(*self.distances(q))])

    @cached_property
    @cached_kernel
    def _gradient_kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        axes = self._capsule_axes(q)
        rows = zip(self._pair_distances(axes, self.pairs), self._pair_wrenches(axes), self.pairs, strict=True)
        best_distance, best_wrench, (first, second) = next(rows)
        lower_link, upper_link = ca.SX(self._capsule_links[first]), ca.SX(self._capsule_links[second])
        for value, other_wrench, (first, second) in rows:
            closer = value < best_distance
            best_distance, best_wrench = ca.if_else(closer, value, best_distance), ca.if_else(closer, other_wrench, best_wrench)
            lower_link = ca.if_else(closer, self._capsule_links[first], lower_link)
            upper_link = ca.if_else(closer, self._capsule_links[second], upper_link)
        gradient = [
            ca.if_else(ca.logic_and(lower_link < joint, joint <= upper_link), ca.dot(screw, best_wrench), 0.0)
            for joint, screw in enumerate(self._joint_screws(q))
        ]
        return Kernel("clearance gradient", [q], [ca.vertcat(*gradient)])

    # ---- evaluation --------------------------------------------------------------------------------------------

    def __call__(self, q: ArrayLike) -> FloatArray:
        """Return the smallest distance in m, (N,), or a scalar for one configuration; infinite if there is no pair to check.

        Args:
            q: (n,) or (N, n) configurations, rad and m.

        Raises:
            InputError: A wrong shape; NaN or infinity in a single configuration (in a batch such a row gets NaN).
        """
        return self._evaluate_rows(
            q, lambda rows: self._smallest_value(rows, None if self.obstacles is None else self.obstacles.smallest_distance)
        )

    def by_pair(self, q: ArrayLike) -> FloatArray:
        """Return the distance of every pair, m, (N, P) or (P,), in the order of ``pair_names``, at ``q`` (N, n) or (n,)."""
        rows, single = as_configurations(self.arm, q)
        values = self.self_only._pair_distances_kernel.rows(rows) if self.pairs else np.empty((len(rows), 0))
        if self.obstacles is not None:
            values = np.concatenate([values, self.obstacles.pair_distances(rows)], axis=1)
        return values[0] if single else values

    def margin_left(self, q: ArrayLike) -> FloatArray:
        """Return the smallest distance beyond the pair's margin (``margins``), m, (N,) or a scalar, at ``q`` (N, n) or (n,)."""
        return self._evaluate_rows(
            q, lambda rows: self._smallest_value(rows, None if self.obstacles is None else self.obstacles.smallest_margin)
        )

    def _smallest_value(self, q: FloatArray, obstacle_values: Callable[[FloatArray], FloatArray] | None) -> FloatArray:
        values = self.self_only._value_kernel.rows(q)[:, 0] if self.pairs else _constant_if_finite(q, np.inf)
        return values if obstacle_values is None else np.minimum(values, obstacle_values(q))

    @cached_property
    def exactness(self) -> ExactQueries:
        """Exact collision queries, computed by a library."""
        from holdfast.model.collision.exact.exactness import ExactQueries  # slow to import
        from holdfast.model.collision.exact.narrow_phase import arm_bodies

        ignored = [ignored_pair.pair for ignored_pair in self.ignored]
        self_clearance = self.self_only
        held_objects = () if self.cell is None else self.cell.held
        bodies = arm_bodies(self.arm, self.capsules, held_objects) if held_objects else self_clearance._own_bodies
        return ExactQueries(
            self.arm, self.capsules, bodies, (self_clearance, self_clearance.by_pair), self.pairs, ignored, self.obstacles
        )

    @cached_property
    def _own_bodies(self) -> tuple[ArmBody, ...]:
        from holdfast.model.collision.exact.narrow_phase import arm_bodies

        return arm_bodies(self.arm, self.capsules)

    def sign(self, q: ArrayLike) -> BoolArray:
        """Return whether no checked link touches another or an object at ``q`` (N, n) or (n,), (N,) or a scalar.

        The result is exact for the bodies that the capsules contain. Margins do not count, and gaps below 1e-6 m may count as
        contact. A row that is not finite is not collision-free. Needs python-fcl or coal.
        """
        return self._evaluate_rows(q, self.exactness.check_collision_free)

    def exact(self, q: ArrayLike) -> FloatArray:
        """Return the smallest exact distance, m, (N,) or a scalar, 0 in contact, at ``q`` (N, n) or (n,). Cf. ``exact_by``."""
        return self._evaluate_rows(q, self.exactness.smallest_distances)

    def _evaluate_rows(self, q: ArrayLike, evaluate: Callable[[FloatArray], NDArray[Any]]) -> NDArray[Any]:
        rows, single = as_configurations(self.arm, q)
        values = evaluate(rows)
        return values[0] if single else values

    @property
    def exact_by(self) -> str:
        """Library of :meth:`exact` and its accuracy, such as ``coal 3.0.3, to 0.001 mm``."""
        return self.exactness.library_description

    def closest_pair(self, q: ArrayLike) -> IndexArray:
        """Return the position in ``pair_names`` of the smallest margin, (N,) or a scalar, at ``q`` (N, n) or (n,).

        Of several pairs it is the first. It is -1 where q is not finite and if there is no pair to check.
        """
        rows, single = as_configurations(self.arm, q)
        closest = np.full(len(rows), -1, dtype=np.int64)
        if self.pair_names:
            finite = np.isfinite(rows).all(axis=1)
            closest[finite] = (self.by_pair(rows[finite]) - self.margins).argmin(axis=1)
        return closest[0] if single else closest

    def gradient(self, q: ArrayLike) -> FloatArray:
        """Return the exact gradient of :meth:`margin_left` at ``q`` (N, n) or (n,), of the same shape, m per rad and m.

        If two pairs tie it is that of the first. It is 0 if there is no pair to check, near 0 where the two axes intersect,
        which is a kink, and NaN where q is not finite.
        """
        return self._evaluate_rows(q, lambda rows: self.nearest(rows)[1])

    def nearest(self, q: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the smallest distance beyond its margin (N,), m, and its gradient (N, n) at ``q`` (N, n), rad and m."""
        margin, gradient = _constant_if_finite(q, np.inf), np.repeat(_constant_if_finite(q, 0.0)[:, None], self.arm.n, axis=1)
        if self.pairs:
            margin, gradient = self.self_only._value_kernel.rows(q)[:, 0], self.self_only._gradient_kernel.rows(q)
        if self.obstacles is not None:
            obstacle_margin, _, obstacle_gradient = self.obstacles.nearest_margin_and_gradient(q)
            closer = ~(margin <= obstacle_margin)
            margin, gradient = np.where(closer, obstacle_margin, margin), np.where(closer[:, None], obstacle_gradient, gradient)
        return margin, gradient

    def lipschitz_bounds(self, low: FloatArray, high: FloatArray) -> FloatArray:
        """Bound the change of the distance of each pair per rad and m of each joint in a box, (P, n), for proofs.

        Args:
            low: (n,) lower corner of the box, finite, rad and m.
            high: (n,) upper corner of the box, finite, rad and m.
        """
        bounds = capsule_lipschitz_bounds(self.arm, self.capsules, self.pairs, low, high)
        return bounds if self.obstacles is None else np.concatenate([bounds, self.obstacles.lipschitz_bounds(low, high)])

    # ---- phrases -----------------------------------------------------------------------------------------------

    @property
    def others(self) -> str:
        """Checked obstacles as a phrase: ``itself``, ``the cell``, or ``itself or the cell``."""
        named = (("itself", self.itself), ("the cell", self.obstacles is not None))
        return " or ".join(name for name, is_checked in named if is_checked) or "nothing"

    @property
    def everything(self) -> str:
        """Phrase of :attr:`others` with ``and``."""
        return self.others.replace(" or ", " and ")

    def too_close(self, margin: float = 0.0, q: ArrayLike | None = None) -> str:
        """Return a phrase for an arm whose clearance is below the margin.

        Args:
            margin: Required distance, m.
            q: (n,) configuration, rad and m; the phrase then has the pair with the smallest margin and its distance.
        """
        obstacle_phrase, location_phrase, has_own_margin = self.others, "", bool(self.margins.any())
        if q is not None:
            pair = int(self.closest_pair(q))
            obstacle_phrase, has_own_margin = (
                ("itself", False) if pair < len(self.pairs) else ("the cell", bool(self.margins[pair]))
            )
            location_phrase = (
                f" ({self.pair_names[pair]}, {abs(distance := float(self.by_pair(q)[pair])):.3g} m "
                f"{'deep' if distance < 0 else 'apart'})"
            )
        if has_own_margin:
            return f"comes closer to {obstacle_phrase} than it may{location_phrase}"
        return (
            f"comes closer than {margin:g} m to {obstacle_phrase}" if margin else f"collides with {obstacle_phrase}"
        ) + location_phrase

    def __repr__(self) -> str:
        return f"<clearance of {self.arm.name!r}: {len(self.capsules)} capsules, {len(self.pair_names)} pairs checked>"


@lru_cache(maxsize=16)
def _default_clearance(arm: Arm, itself: bool) -> Clearance:
    """Return the default clearance of an arm without a cell; the kernels of all its copies in cells are compiled once."""
    return Clearance(arm, itself=itself)


def _constant_if_finite(rows: FloatArray, value: float) -> FloatArray:
    """Return ``value`` for every row that is finite, NaN for the others."""
    return np.where(np.isfinite(rows).all(axis=1), value, np.nan)
