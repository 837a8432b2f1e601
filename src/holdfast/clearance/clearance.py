"""The clearance of an arm from itself and from a cell: the smallest distance between what could collide."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from itertools import combinations
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm import kinematics
from holdfast.arm.configurations import as_configurations, finite_limits
from holdfast.arm.model import Arm
from holdfast.arm.task import plane_normal
from holdfast.caching import cached_property
from holdfast.cell.cell import Cell
from holdfast.clearance.capsules import Capsules, IgnoredPair
from holdfast.clearance.changes import changes_between
from holdfast.clearance.obstacles import Obstacles
from holdfast.clearance.segments import Segment, distance, feet, wrench
from holdfast.errors import ArmError
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled, recalled_data
from holdfast.linalg import Vector, dot, smallest
from holdfast.probability.sobol_sequence import sobol

if TYPE_CHECKING:
    from holdfast.clearance.exact.exactness import Exactness

Array = NDArray[np.float64]
Pair = tuple[int, int]

_SAMPLES = 512  # configurations
_ALWAYS = 0.95  # pairs that overlap in this share of them touch by construction


class Clearance:
    """Distance in m between what comes closest, of the capsules of an arm and the objects of its cell; below 0 in a collision.

    Between two capsules a negative value is minus the depth: the distance between the axes less the two radii. The distance
    from an object of the cell is a lower bound: that of the spheres that cover the capsules of a link.

    Not checked are capsules of one link, of adjacent links and of links under ``ignore`` (what is held is checked against all
    links but the last), and capsules that touch by construction: those that overlap in at least 95 % of 512 configurations
    within the limits (the first 512 points of the unscrambled Sobol sequence; +-pi rad or +-1 m where there is no limit). These
    are pairs with nothing but short links between them, such as the two sides of an elbow: that they meet says nothing. The
    default collision matrix of the MoveIt Setup Assistant draws the same line in the same way (Coleman et al. 2014, J. Software
    Eng. Robotics 5(1)).

    Args:
        arm: The arm.
        capsules: Its shape; if not given, a cover of the collision shapes of the arm's file
            (:func:`holdfast.clearance.cover.shape_of`), and :meth:`Capsules.along`, whose radius is an assumption, where there
            are none. What the cell says to be held is added to the last link.
        cell: The objects around it; none if not given. Objects are never adjacent to a link and never left out: only
            ``may_touch`` of the cell takes a pair away.
        itself: Look at the arm's own links as well, one against the other.

    Attributes:
        arm, capsules, cell: As given.
        obstacles: The objects of the cell as the arm meets them, or None.
        margins: (P,) what each pair keeps at least, m: 0 between links, the object's or the cell's margin otherwise.
        pairs: Positions in ``capsules.parts`` of the capsules that are checked, the one nearer to the base first.
        pair_names: Of all P pairs, their links, ``base & joint3``, by the joints that move them, with the number of the capsule
            where a link has several; then each link with each object, ``joint3 & table``.
        ignored: The pairs on different links that are not checked, and why.

    Raises:
        ArmError: A capsule on a link that the arm does not have.
        InputError: The base touches an object, or ``may_touch`` names nothing of the cell or the arm.
    """

    @checked
    def __init__(self, arm: Arm, capsules: Capsules | None = None, cell: Cell | None = None, *, itself: bool = True) -> None:
        self.arm = arm
        if capsules is None or (cell is not None and cell.held):
            from holdfast.clearance.cover import shape_in  # takes long to import

            capsules = shape_in(arm, cell, capsules)
        self.capsules = capsules.own if cell is None or not cell.held else capsules
        highest = max((link for link in self._links + [x for p in self.capsules.ignore for x in p]), default=-1)
        if highest >= arm.n:
            raise ArmError(f"a capsule names link {highest}, but '{arm.name}' has links -1 (base) to {arm.n - 1}")
        self.pairs: list[Pair] = []
        self.ignored: list[IgnoredPair] = []
        self.itself = itself
        if itself:
            self._choose_pairs()
        self._meet(cell)

    def _meet(self, cell: Cell | None) -> None:
        seen = None if cell is None or not len(cell) else Obstacles(self.arm, self.capsules, cell)
        self.cell, self.obstacles = cell, seen
        self.pair_names = [self._name(pair) for pair in self.pairs] + ([] if seen is None else seen.names)
        self.margins = np.concatenate([np.zeros(len(self.pairs)), np.zeros(0) if seen is None else seen.margins])

    def with_cell(self, cell: Cell | None) -> Clearance:
        """The same clearance in another cell; the arm's own pairs are chosen again only where it holds something else."""
        same = getattr(self.cell, "held", ()) == getattr(cell, "held", ())
        return self._in(cell) if same else Clearance(self.arm, self.capsules, cell, itself=self.itself)

    def _in(self, cell: Cell | None) -> Clearance:
        other = copy(self)
        vars(other).pop("exactness", None)
        other._meet(cell)
        return other

    @classmethod
    def by_default(cls, arm: Arm, cell: Cell | None = None) -> Clearance | None:
        """What is kept where nothing else is said: the arm's own shape, as ``capsules`` has it where they are not given.

        The links of an arm that moves in a plane lie beside each other, not in one plane: they are not checked against each
        other, and without a cell there is nothing to keep: None.
        """
        flat = plane_normal(arm) is not None
        return None if flat and cell is None else cls(arm, cell=cell, itself=not flat)

    # ---- which pairs -------------------------------------------------------------------------------------------

    @property
    def _links(self) -> list[int]:
        return [part.link for part in self.capsules]

    def _choose_pairs(self) -> None:
        reasons: dict[Pair, str] = {}
        links = self._links
        by_link = sorted(range(len(links)), key=links.__getitem__)
        different = [(a, b) for a, b in combinations(by_link, 2) if links[a] != links[b]]
        held = len(links) - self.capsules.held  # from there on; what is said about links was not said about that
        for a, b in different:
            if b >= held:
                continue
            low, high = links[a], links[b]
            if high - low == 1:
                reasons[a, b] = "adjacent links"
            elif (low, high) in self.capsules.ignore or (min(a, b), max(a, b)) in self.capsules.apart:
                reasons[a, b] = "to be ignored"
        open_pairs = [pair for pair in different if pair not in reasons]
        for pair, share in zip(open_pairs, self._overlaps(open_pairs) if open_pairs else [], strict=True):
            if share >= _ALWAYS:
                reasons[pair] = f"overlap in {100 * share:.1f} % of {_SAMPLES} configurations within the limits"
            else:
                self.pairs.append(pair)
        self.ignored = [IgnoredPair(pair, self._name(pair), reasons[pair]) for pair in different if pair in reasons]

    @recalled_data
    def _overlaps(self, pairs: list[Pair]) -> list[float]:
        """Share of configurations in which each pair overlaps."""
        low, high = finite_limits(self.arm)
        q = low + (high - low) * sobol(_SAMPLES, self.arm.n)
        x = kinematics.joint_symbols(self.arm)
        # Used once: the virtual machine needs no compilation.
        values = Kernel("overlaps", [x], [ca.vertcat(*self._distances(self._segments(x), pairs))], backend="casadi").rows(q)
        return [float(share) for share in (values < 0).mean(axis=0)]

    def _name(self, pair: Pair) -> str:
        return " & ".join(self.capsules.label(self.arm, part) for part in pair)

    # ---- symbols -----------------------------------------------------------------------------------------------

    @property
    def _frame(self) -> int:
        """Everything is seen from a link in the middle: distances do not mind, and the code is short."""
        return self.arm.n // 2

    def _segments(self, q: SX) -> list[Segment]:
        """The axes of the capsules."""
        moving, _ = kinematics.frames(self.arm, kinematics.joint_steps(self.arm, q), self._frame)
        out = []
        for part in self.capsules:
            rotation, position = moving[part.link + 1]
            span = np.subtract(part.end, part.start)
            start = position + rotation @ kinematics.constant(np.array(part.start))
            out.append(Segment(start, rotation @ kinematics.constant(span), float(span @ span)))
        return out

    def _distances(self, made: list[Segment], pairs: list[Pair]) -> list[SX]:
        reach = [sum(self.capsules.parts[k].radius for k in pair) for pair in pairs]
        return [distance(made[a], made[b], *feet(made[a], made[b])) - r for (a, b), r in zip(pairs, reach, strict=True)]

    def _wrenches(self, made: list[Segment]) -> list[SX]:
        return [wrench(made[a], made[b], *feet(made[a], made[b])) for a, b in self.pairs]

    def _screws(self, q: SX) -> list[SX]:
        """What each joint does, (6,): its product with a wrench is the power of the wrench per unit of joint speed."""
        c = kinematics.chain(self.arm, q, self._frame)
        return [
            ca.vertcat(ca.SX(3, 1), z) if joint.prismatic else ca.vertcat(z, ca.cross(p, z))
            for joint, z, p in zip(self.arm.joints, c.axes, c.points, strict=True)
        ]

    def distances(self, q: SX) -> list[SX]:
        """The distance of every checked pair, m, for use in other programs; their smallest is the clearance.

        Args:
            q: (n,) symbols or expressions, rad and m.
        """
        return self._distances(self._segments(q), self.pairs)

    def slopes(self, q: SX, directions: Sequence[SX]) -> list[Vector]:
        """Derivatives of :meth:`distances` along each direction (n,), one list per pair.

        Only the joints between two links move one against the other. Exact, and shorter and better behaved than the
        derivative of the code of the distances, where the feet of nearly parallel capsules give huge numbers that cancel.
        """
        screws = self._screws(q)
        out = []
        for (a, b), push in zip(self.pairs, self._wrenches(self._segments(q)), strict=True):
            between = range(self._links[a] + 1, self._links[b] + 1)
            row = [ca.dot(screws[k], push) for k in between]
            out.append([dot(row, [v[k] for k in between]) for v in directions])
        return out

    def smallest_with_slopes(self, q: SX, directions: Sequence[SX]) -> tuple[SX, Vector]:
        """The clearance and its derivatives along each direction (n,): those of the pair that is closest."""
        best: SX = None
        chosen: Vector = []
        for value, row in zip(self.distances(q), self.slopes(q, directions), strict=True):
            if best is None:
                best, chosen = value, row
                continue
            closer = value < best
            chosen = [ca.if_else(closer, x, y) for x, y in zip(row, chosen, strict=True)]
            best = ca.if_else(closer, value, best)
        return best, chosen

    @cached_property
    def alone(self) -> Clearance:
        """The same without the cell: what programs are made of, so that for a changed cell none is made anew."""
        return self if self.cell is None else self._in(None)

    @cached_property
    @recalled
    def _value_kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        return Kernel("clearance", [q], [smallest(self.distances(q))])

    @cached_property
    @recalled
    def _pairs_kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        return Kernel("clearance by pair", [q], [ca.vertcat(*self.distances(q))])

    @cached_property
    @recalled
    def _gradient_kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        made = self._segments(q)
        rows = zip(self._distances(made, self.pairs), self._wrenches(made), self.pairs, strict=True)
        best, push, (a, b) = next(rows)
        low, high = ca.SX(self._links[a]), ca.SX(self._links[b])
        for value, other, (a, b) in rows:
            closer = value < best
            best, push = ca.if_else(closer, value, best), ca.if_else(closer, other, push)
            low, high = ca.if_else(closer, self._links[a], low), ca.if_else(closer, self._links[b], high)
        slopes = [
            ca.if_else(ca.logic_and(low < k, k <= high), ca.dot(screw, push), 0.0) for k, screw in enumerate(self._screws(q))
        ]
        return Kernel("clearance gradient", [q], [ca.vertcat(*slopes)])

    # ---- what a user asks --------------------------------------------------------------------------------------

    def __call__(self, q: ArrayLike) -> Array:
        """The smallest distance in m, (N,), or a scalar for one configuration; infinite if there is no pair to check.

        Args:
            q: (n,) or (N, n), rad and m.

        Raises:
            InputError: Wrong shape; NaN or infinity in a single configuration (in a batch such a row gets NaN).
        """
        return self._of_rows(q, lambda rows: self._least(rows, None if self.obstacles is None else self.obstacles.least))

    def by_pair(self, q: ArrayLike) -> Array:
        """The distance of every pair in m, (N, P) or (P,), in the order of ``pair_names``."""
        rows, single = as_configurations(self.arm, q)
        values = self.alone._pairs_kernel.rows(rows) if self.pairs else np.empty((len(rows), 0))
        if self.obstacles is not None:
            values = np.concatenate([values, self.obstacles.distances(rows)], axis=1)
        return values[0] if single else values

    def room(self, q: ArrayLike) -> Array:
        """The smallest distance beyond what each pair keeps at least (``margins``), m, (N,) or a scalar."""
        return self._of_rows(q, lambda rows: self._least(rows, None if self.obstacles is None else self.obstacles.room))

    def _least(self, q: Array, beside: Callable[[Array], Array] | None) -> Array:
        values = self.alone._value_kernel.rows(q)[:, 0] if self.pairs else _constant(q, np.inf)
        return values if beside is None else np.minimum(values, beside(q))

    @cached_property
    def exactness(self) -> Exactness:
        """What is asked exactly, by a library."""
        ignored, alone, held = [x.pair for x in self.ignored], self.alone, () if self.cell is None else self.cell.held
        from holdfast.clearance.exact.exactness import Exactness  # takes long to import

        return Exactness(self.arm, self.capsules, (alone, alone.by_pair), self.pairs, ignored, self.obstacles, held)

    def sign(self, q: ArrayLike) -> NDArray[np.bool_]:
        """Whether no checked link touches another or an object, (N,) or a scalar: exact, of the bodies that the capsules cover.

        Margins do not count, less than 1e-6 m may, and a row that is not finite is not clear. Needs python-fcl or coal.
        """
        return self._of_rows(q, self.exactness.clear)

    def exact(self, q: ArrayLike) -> Array:
        """The smallest distance of those bodies, m, (N,) or a scalar; 0 where they touch; ``exact_by`` says how right it is."""
        return self._of_rows(q, self.exactness.distances)

    def _of_rows(self, q: ArrayLike, ask: Callable[[Array], NDArray[Any]]) -> NDArray[Any]:
        rows, single = as_configurations(self.arm, q)
        values = ask(rows)
        return values[0] if single else values

    @property
    def exact_by(self) -> str:
        """The library that :meth:`exact` asks, and how right it is: ``coal 3.0.3, to 0.001 mm``."""
        return self.exactness.library

    def closest_pair(self, q: ArrayLike) -> NDArray[np.int64]:
        """Position in ``pair_names`` of the pair with the least room, the first of several, (N,) or a scalar.

        It is -1 where q is not finite and if there is no pair to check.
        """
        rows, single = as_configurations(self.arm, q)
        closest = np.full(len(rows), -1, dtype=np.int64)
        if self.pair_names:
            finite = np.isfinite(rows).all(axis=1)
            closest[finite] = (self.by_pair(rows[finite]) - self.margins).argmin(axis=1)
        return closest[0] if single else closest

    def gradient(self, q: ArrayLike) -> Array:
        """Exact gradient of the room, (N, n) or (n,), m per rad and m; that of the clearance where all margins are equal.

        Where two pairs tie it is that of the first. It is 0 if there is no pair to check, near 0 where the two
        axes cross, which is a kink, and NaN where q is.
        """
        return self._of_rows(q, lambda rows: self.nearest(rows)[1])

    def nearest(self, q: Array) -> tuple[Array, Array]:
        """Room (N,) m and its gradient (N, n) of configurations (N, n)."""
        room, slope = _constant(q, np.inf), np.repeat(_constant(q, 0.0)[:, None], self.arm.n, axis=1)
        if self.pairs:
            room, slope = self.alone._value_kernel.rows(q)[:, 0], self.alone._gradient_kernel.rows(q)
        if self.obstacles is not None:
            other, _, theirs = self.obstacles.nearest(q)
            closer = ~(room <= other)
            room, slope = np.where(closer, other, room), np.where(closer[:, None], theirs, slope)
        return room, slope

    def changes(self, low: Array, high: Array) -> Array:
        """(P, n) bounds of how much the distance of each pair changes per rad and m of each joint within a box; for proofs.

        Args:
            low: (n,) lower corner of the box, finite, rad and m.
            high: (n,) upper corner.
        """
        bounds = changes_between(self.arm, self.capsules, self.pairs, low, high)
        return bounds if self.obstacles is None else np.concatenate([bounds, self.obstacles.changes(low, high)])

    # ---- words -------------------------------------------------------------------------------------------------

    @property
    def others(self) -> str:
        """What the arm is kept clear of: ``itself``, ``the cell``, or ``itself or the cell``."""
        named = (("itself", self.itself), ("the cell", self.obstacles is not None))
        return " or ".join(name for name, there in named if there) or "nothing"

    @property
    def everything(self) -> str:
        """The same with ``and``."""
        return self.others.replace(" or ", " and ")

    def too_close(self, margin: float = 0.0, q: ArrayLike | None = None) -> str:
        """The phrase for an arm whose room is below the margin.

        Args:
            margin: m.
            q: (n,) rad and m, to say what is too close there: the pair with the least room and its distance.
        """
        other, where, own = self.others, "", bool(self.margins.any())
        if q is not None:
            k = int(self.closest_pair(q))
            other, own = ("itself", False) if k < len(self.pairs) else ("the cell", bool(self.margins[k]))
            where = f" ({self.pair_names[k]}, {abs(away := float(self.by_pair(q)[k])):.3g} m {'deep' if away < 0 else 'apart'})"
        if own:
            return f"comes closer to {other} than it may{where}"
        return (f"comes closer than {margin:g} m to {other}" if margin else f"collides with {other}") + where

    def __repr__(self) -> str:
        return f"<clearance of {self.arm.name!r}: {len(self.capsules)} capsules, {len(self.pair_names)} pairs checked>"


def _constant(rows: Array, value: float) -> Array:
    """``value`` for every row that is finite, NaN for the others."""
    return np.where(np.isfinite(rows).all(axis=1), value, np.nan)
