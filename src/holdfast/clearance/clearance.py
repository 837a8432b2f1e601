"""The clearance of an arm from itself: the smallest distance between capsules that could meet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm import kinematics
from holdfast.arm.configurations import configurations, finite_limits
from holdfast.arm.model import Arm
from holdfast.clearance.capsules import Capsules, link_name
from holdfast.clearance.segments import Segment, distance, feet
from holdfast.errors import ArmError
from holdfast.kernels import SX, Kernel
from holdfast.linalg import Vector, slopes_along, smallest

Array = NDArray[np.float64]
Pair = tuple[int, int]

_SAMPLES_LOG2 = 9  # 512 configurations
_ALWAYS = 0.95  # pairs that overlap in this share of them touch by construction


@dataclass(frozen=True)
class IgnoredPair:
    """Two capsules that are not checked against each other.

    Attributes:
        pair: Positions in ``capsules.parts``.
        name: As in ``pair_names``.
        reason: Why, for people.
    """

    pair: Pair
    name: str
    reason: str


@dataclass(frozen=True)
class _Gaps:
    """Distances as functions of q and of feet that are symbols of their own."""

    q: SX
    feet: SX
    values: list[SX]
    feet_of_q: SX


class Clearance:
    """Distance in m between the capsules of an arm that come closest; below 0 where two of them overlap.

    A negative value is minus the depth: the distance between the axes less the two radii.

    Not checked are capsules of one link or of adjacent links, links under ``ignore``, and capsules that touch by
    construction: those that overlap in at least 95 % of 512 configurations within the limits (the first 512 points of the
    unscrambled Sobol sequence; +-pi rad or +-1 m where there is no limit). These are pairs with nothing but short links
    between them, such as the two sides of an elbow: that they meet says nothing. The default collision matrix of the
    MoveIt Setup Assistant draws the same line in the same way (Coleman et al. 2014, J. Software Eng. Robotics 5(1)).

    Args:
        arm: The arm.
        capsules: Its shape; :meth:`Capsules.along` if not given, whose radius is an assumption.

    Attributes:
        arm, capsules: As given.
        pairs: Positions in ``capsules.parts`` of the capsules that are checked.
        pair_names: Their links, ``base & joint3``, by the joints that move them, with the number of the capsule where a
            link has several.
        ignored: The pairs on different links that are not checked, and why.

    Raises:
        ArmError: A capsule on a link that the arm does not have.
    """

    def __init__(self, arm: Arm, capsules: Capsules | None = None) -> None:
        self.arm = arm
        self.capsules = Capsules.along(arm) if capsules is None else capsules
        highest = max((link for link in self._links + [x for p in self.capsules.ignore for x in p]), default=-1)
        if highest >= arm.n:
            raise ArmError(f"a capsule names link {highest}, but '{arm.name}' has links -1 (base) to {arm.n - 1}")
        self.pairs: list[Pair] = []
        self.ignored: list[IgnoredPair] = []
        self._choose_pairs()
        self.pair_names = [self._name(pair) for pair in self.pairs]

    # ---- which pairs -------------------------------------------------------------------------------------------

    @property
    def _links(self) -> list[int]:
        return [part.link for part in self.capsules]

    def _choose_pairs(self) -> None:
        reasons: dict[Pair, str] = {}
        links = self._links
        different = [(a, b) for a, b in combinations(range(len(links)), 2) if links[a] != links[b]]
        for a, b in different:
            low, high = sorted((links[a], links[b]))
            if high - low == 1:
                reasons[a, b] = "adjacent links"
            elif (low, high) in self.capsules.ignore:
                reasons[a, b] = "to be ignored"
        open_pairs = [pair for pair in different if pair not in reasons]
        for pair, share in zip(open_pairs, self._overlaps(open_pairs), strict=True):
            if share >= _ALWAYS:
                reasons[pair] = f"overlap in {100 * share:.1f} % of {2**_SAMPLES_LOG2} configurations within the limits"
            else:
                self.pairs.append(pair)
        self.ignored = [IgnoredPair(pair, self._name(pair), reasons[pair]) for pair in different if pair in reasons]

    def _overlaps(self, pairs: list[Pair]) -> Array:
        """Share of configurations in which each pair overlaps."""
        if not pairs:
            return np.zeros(0)
        from scipy.stats import qmc

        low, high = finite_limits(self.arm)
        q = low + (high - low) * qmc.Sobol(self.arm.n, scramble=False).random_base2(_SAMPLES_LOG2)
        x = kinematics.joint_symbols(self.arm)
        # Used once: the virtual machine needs no compilation.
        values = Kernel("overlaps", [x], [ca.vertcat(*self._distances(x, pairs))], backend="casadi").rows(q)
        return np.asarray((values < 0).mean(axis=0))

    def _name(self, pair: Pair) -> str:
        return " & ".join(self._label(part) for part in pair)

    def _label(self, part: int) -> str:
        links = self._links
        name = link_name(self.arm, links[part])
        return name if links.count(links[part]) == 1 else f"{name} ({links[: part + 1].count(links[part])})"

    # ---- symbols -----------------------------------------------------------------------------------------------

    def _segments(self, q: SX) -> list[Segment]:
        """The axes of the capsules, all seen from a link in the middle: distances do not mind, and the code is short."""
        moving, _ = kinematics.frames(self.arm, kinematics.joint_steps(self.arm, q), (self.arm.n + 1) // 2)
        out = []
        for part in self.capsules:
            rotation, position = moving[part.link + 1]
            span = np.subtract(part.end, part.start)
            start = position + rotation @ kinematics.constant(np.array(part.start))
            out.append(Segment(start, rotation @ kinematics.constant(span), float(span @ span)))
        return out

    def _distances(self, q: SX, pairs: list[Pair]) -> list[SX]:
        made = self._segments(q)
        return [distance(made[a], made[b], *feet(made[a], made[b])) - self._reach((a, b)) for a, b in pairs]

    def _reach(self, pair: Pair) -> float:
        return sum(self.capsules.parts[k].radius for k in pair)

    @cached_property
    def _gaps(self) -> _Gaps:
        q = kinematics.joint_symbols(self.arm)
        made = self._segments(q)
        held = ca.SX.sym("feet", 2 * len(self.pairs))
        values, places = [], []
        for k, (a, b) in enumerate(self.pairs):
            values.append(distance(made[a], made[b], held[2 * k], held[2 * k + 1]) - self._reach((a, b)))
            places += feet(made[a], made[b])
        return _Gaps(q, held, values, ca.vertcat(*places))

    def distances(self, q: SX) -> list[SX]:
        """The distance of every checked pair, m, for use in other programs; their smallest is the clearance.

        Args:
            q: (n,) symbols or expressions, rad and m.
        """
        return self._distances(q, self.pairs)

    def slopes(self, q: SX, directions: Sequence[SX]) -> list[Vector]:
        """Derivatives of :meth:`distances` along each direction (n,), one list per pair.

        The closest points are held still, which is exact (envelope theorem), short, and free of the huge numbers that
        cancel when the closest points of nearly parallel capsules are differentiated.
        """
        g = self._gaps
        if not self.pairs:
            return []
        rows = slopes_along(g.values, g.q, directions)
        flat = ca.substitute(ca.substitute(ca.vertcat(*[x for row in rows for x in row]), g.feet, g.feet_of_q), g.q, q)
        entries = ca.vertsplit(flat)
        return [entries[k : k + len(directions)] for k in range(0, len(entries), len(directions))]

    @cached_property
    def _value_kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        return Kernel("clearance", [q], [smallest(self.distances(q))])

    @cached_property
    def _pairs_kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        return Kernel("clearance by pair", [q], [ca.vertcat(*self.distances(q))])

    @cached_property
    def _gradient_kernel(self) -> Kernel:
        g = self._gaps
        slope = ca.gradient(smallest(g.values), g.q)
        return Kernel("clearance gradient", [g.q], [ca.substitute(slope, g.feet, g.feet_of_q)])

    # ---- what a user asks --------------------------------------------------------------------------------------

    def __call__(self, q: ArrayLike) -> Array:
        """The clearance in m, (N,), or a scalar for one configuration; infinite if the arm has no pair to check.

        Args:
            q: (n,) or (N, n), rad and m.

        Raises:
            InputError: Wrong shape; NaN or infinity in a single configuration (in a batch such a row gets NaN).
        """
        rows, single = configurations(self.arm, q)
        values = self._value_kernel.rows(rows)[:, 0] if self.pairs else _constant(rows, np.inf)
        return values[0] if single else values

    def by_pair(self, q: ArrayLike) -> Array:
        """The distance of every checked pair in m, (N, P) or (P,), in the order of ``pairs``."""
        rows, single = configurations(self.arm, q)
        values = self._pairs_kernel.rows(rows) if self.pairs else np.empty((len(rows), 0))
        return values[0] if single else values

    def closest_pair(self, q: ArrayLike) -> NDArray[np.int64]:
        """Position in ``pairs`` of the pair with the smallest distance, the first of several, (N,) or a scalar.

        It is -1 where q is not finite and if there is no pair to check.
        """
        rows, single = configurations(self.arm, q)
        closest = np.full(len(rows), -1, dtype=np.int64)
        if self.pairs:
            finite = np.isfinite(rows).all(axis=1)
            closest[finite] = self.by_pair(rows[finite]).argmin(axis=1)
        return closest[0] if single else closest

    def gradient(self, q: ArrayLike) -> Array:
        """Exact gradient of the clearance, (N, n) or (n,), m per rad and m.

        Where two pairs tie it is that of the first. It is 0 where the two axes cross, which is a kink, and if there is no
        pair to check, and NaN where q is.
        """
        rows, single = configurations(self.arm, q)
        g = self._gradient_kernel.rows(rows) if self.pairs else np.repeat(_constant(rows, 0.0)[:, None], self.arm.n, axis=1)
        return g[0] if single else g

    def __repr__(self) -> str:
        return f"<clearance of {self.arm.name!r}: {len(self.capsules)} capsules, {len(self.pairs)} pairs checked>"


def _constant(rows: Array, value: float) -> Array:
    """``value`` for every row that is finite, NaN for the others."""
    return np.where(np.isfinite(rows).all(axis=1), value, np.nan)
