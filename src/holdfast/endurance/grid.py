"""The self-motion curves of every pose of a path as numbered nodes, and who is beside whom."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.caching import cached_property
from holdfast.solvers import joint_space
from holdfast.solvers.self_motions import SelfMotion

if TYPE_CHECKING:
    from scipy.spatial import KDTree

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Index = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Nodes:
    """The points of all curves of one pose, P of them.

    Attributes:
        arm: The arm.
        q: (P, n) rad and m.
        curve: (P,) the number of its curve.
        before, after: (P,) neighbours along the curve; at an open end the node itself.
        pieces: (P, n) from each node to the one after it, rad and m.
        flat: (P, e) where straight distances are those between configurations: (cos, sin) of joints without limits.
        span: How far apart neighbours may be, rad (and m).
    """

    arm: Arm
    q: Array
    curve: Index
    before: Index
    after: Index
    pieces: Array
    flat: Array
    span: float

    @classmethod
    def of(cls, arm: Arm, found: SelfMotion) -> Nodes:
        """Those of a manifold of curves."""
        before, after, curve = [], [], []
        at = 0
        for k, part in enumerate(found.components):
            size = len(part.q)
            number = np.arange(at, at + size)
            ends = (number[-1], number[0]) if part.closed else (number[0], number[-1])
            before.append(np.concatenate([[ends[0]], number[:-1]]))
            after.append(np.concatenate([number[1:], [ends[1]]]))
            curve.append(np.full(size, k))
            at += size
        none = [np.empty(0, dtype=np.int64)]
        return cls._of(
            arm, found.q, found.spacing, *(np.concatenate(x or none).astype(np.int64) for x in (curve, before, after))
        )

    @classmethod
    def single(cls, arm: Arm, q: Array, span: float) -> Nodes:
        """One configuration (n,) alone."""
        zero = np.zeros(1, dtype=np.int64)
        return cls._of(arm, q[None], span, zero, zero, zero)

    @classmethod
    def _of(cls, arm: Arm, q: Array, span: float, curve: Index, before: Index, after: Index) -> Nodes:
        return cls(arm, q, curve, before, after, joint_space.difference(arm, q[after], q), flat(arm, q), span)

    @cached_property
    def _tree(self) -> KDTree:
        return joint_space.tree(self.arm, self.q)

    def place(self, q: Array) -> tuple[Index, Array, Flags]:
        """Where q (N, n) lies: behind which node along its curve (N,), how far towards the next one (N,), 0 to 1, and
        whether it lies on a curve at all (N,).
        """
        if not len(self.q):
            return np.zeros(len(q), dtype=np.int64), np.zeros(len(q)), np.zeros(len(q), dtype=bool)
        away, first = self._tree.query(joint_space.folded(self.arm, q))
        back, on = self.before[first], self.after[first]
        ahead = (
            np.einsum("ij,ij->i", joint_space.difference(self.arm, q, self.q[first]), self.pieces[first] + self.pieces[back])
            > 0
        )
        behind = np.where(ahead & (on != first), first, back)
        piece = self.pieces[behind]
        part = np.einsum("ij,ij->i", joint_space.difference(self.arm, q, self.q[behind]), piece)
        share = np.clip(part / np.maximum(np.einsum("ij,ij->i", piece, piece), 1e-300), 0.0, 1.0)
        return behind, share, np.asarray(away <= self.span)


def nodes_of(arm: Arm, found: Sequence[SelfMotion]) -> list[Nodes]:
    """The nodes of every pose."""
    return [Nodes.of(arm, each) for each in found]


def flat(arm: Arm, q: Array) -> Array:
    """(N, e) coordinates of q (N, n): joints that turn without limits as cosine and sine, the others as they are."""
    turning = joint_space.turning(arm)
    return np.concatenate([q[:, ~turning], np.cos(q[:, turning]), np.sin(q[:, turning])], axis=1)


def squared_distances(a: Array, b: Array) -> Array:
    """(N, P) squared distances of rows a (N, e) from rows b (P, e); 0 where rounding left less."""
    product = a @ b.T
    product *= -2
    product += np.einsum("ij,ij->i", a, a)[:, None]
    product += np.einsum("ij,ij->i", b, b)
    return np.maximum(product, 0.0, out=product)
