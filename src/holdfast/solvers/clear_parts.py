"""The parts of a curve of configurations that are clear, or meet another inequality: between points, not only at them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.clearance.clearance import Clearance
from holdfast.solvers import joint_space
from holdfast.solvers.curve_tracing import Component, Tracer

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

FINEST = 5e-4  # m or rad of possible change: what cannot be told clear at this ends the part
_STRAYED = 0.25  # of a piece is the most that its middle lies beside the curve; a half is then no longer than 0.75 of it
_BENT = 1.1  # a curve is longer than the straight piece between two of its points by less than this


@dataclass(frozen=True)
class Clear:
    """What must be kept, and how fast that can change.

    Attributes:
        gaps: Of configurations (N, n) what is left (N, P) of each of P rooms, m or rad; below 0 it is not clear.
        slopes: (P, n) how fast they can change, m or rad per rad and m.
        names: (P,) of what ends a part where the room is used up.
    """

    gaps: Callable[[Array], Array]
    slopes: Array
    names: Sequence[str]

    @classmethod
    def of(cls, clearance: Clearance, margin: float) -> Clear:
        """The distance of every pair of a clearance beyond what it keeps, for configurations within the limits of its arm."""

        def gaps(q: Array) -> Array:
            return np.asarray(clearance.by_pair(q) - clearance.margins - margin)

        return cls(gaps, clearance.changes(*finite_limits(clearance.arm)), clearance.pair_names)

    def keeps(self, q: Array) -> Flags:
        """(N,) True where enough room is left at q (N, n)."""
        return np.asarray((self.gaps(q) >= 0).all(axis=1))

    def parts(self, tracer: Tracer, pose: Array, whole: Component) -> list[Component]:
        """The parts of a curve of a pose (4, 4) that are clear, in order; what ends them by name.

        Between two of its points, at which d_1 and d_2 of a room are left, no less than ``(d_1 + d_2 - L) / 2`` is, L the
        most that it can change on the way (of a distance :meth:`Clearance.changes`). Pieces for which that does not do are
        halved, by points brought back to the pose, until it does or L is below half a millimetre: there a part ends.
        """
        q = whole.q
        if whole.closed:
            q = np.concatenate([q, q[-1] + joint_space.difference(tracer.arm, q[:1], q[-1])])
        gaps = self.gaps(q)
        while True:
            clear = gaps.min(axis=1) >= 0
            most = _BENT * np.abs(np.diff(q, axis=0)) @ self.slopes.T
            proved = clear[1:] & clear[:-1] & ((gaps[1:] + gaps[:-1] - most).min(axis=1) >= 0)
            open_ = np.flatnonzero(~proved & (clear[1:] | clear[:-1]) & (most.max(axis=1) >= FINEST))
            if not open_.size:
                break
            piece, between_ends = q[open_ + 1] - q[open_], (q[open_] + q[open_ + 1]) / 2
            middle, on, _ = tracer.corrected(between_ends, np.broadcast_to(pose, (open_.size, 4, 4)))
            # Near a singular configuration it may land anywhere, and halves would not get shorter.
            on &= np.linalg.norm(middle - between_ends, axis=1) <= _STRAYED * np.linalg.norm(piece, axis=1)
            middle[~on] = between_ends[~on]
            between = self.gaps(middle)
            between[~on] = -np.inf
            q = np.insert(q, open_ + 1, middle, axis=0)
            gaps = np.insert(gaps, open_ + 1, between, axis=0)
        if proved.all():
            return [whole]
        return self._cut(whole, q, gaps, proved)

    def _cut(self, whole: Component, q: Array, gaps: Array, proved: Flags) -> list[Component]:
        """The runs of pieces that are proved, of points q (K, n)."""
        if whole.closed:  # begin behind a piece that is not clear
            first = int(np.flatnonzero(~proved)[0]) + 1
            ahead = q[1:] + (q[-1] - q[0])
            q = np.concatenate([q[first:], ahead[:first]])
            gaps = np.concatenate([gaps[first:], gaps[1 : first + 1]])
            proved = np.concatenate([proved[first:], proved[:first]])
        edges = np.flatnonzero(np.diff(np.r_[False, proved, False].astype(np.int8)))
        found = []
        for start, end in zip(edges[::2], edges[1::2], strict=True):
            ended = (start > 0 or whole.closed, end < len(q) - 1 or whole.closed)
            names = tuple(
                self._name(gaps[k], gaps[other % len(gaps)]) if cut else ""
                for cut, k, other in ((ended[0], start, start - 1), (ended[1], end, end + 1))
            )
            bounds = tuple(None if cut else joint for cut, joint in zip(ended, whole.bounded_by, strict=True))
            part = q[start : end + 1]
            length = float(np.linalg.norm(np.diff(part, axis=0), axis=1).sum())
            found.append(
                replace(
                    whole,
                    q=part,
                    closed=False,
                    bounded_by=(bounds[0], bounds[1]),
                    barred_by=(names[0], names[1]),
                    length=length,
                )
            )
        return found

    def _name(self, inside: Array, outside: Array) -> str:
        """What ends a part: the least room just beyond its end, or at it where nothing is known of beyond."""
        there = outside if np.isfinite(outside).all() else inside
        return self.names[int(np.argmin(there))]
