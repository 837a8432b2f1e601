"""Which locks can be survived, at every node of a path: backwards in time, so that each lock is followed by one step only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.endurance.grid import Nodes
from holdfast.endurance.locks import Lock
from holdfast.notice import each
from holdfast.solvers import joint_space
from holdfast.solvers.self_motions import SelfMotion

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Index = NDArray[np.int64]
Spans = list[tuple[float, float]]

_PARTS = 16  # of a piece of a curve in which a verdict changes: in two rounds the place is known to a 256th

_SAME = 1e-9  # rad and m
KEPT = 4  # of the configurations that a failed arm with redundancy left may be in


@dataclass(frozen=True, eq=False)
class Verdicts:
    """Which locks are survived at the P nodes of one pose.

    Attributes:
        survives: (P, n) True where a lock of the joint is.
        edge: (P, n) where between a node and the next along its curve the verdict changes, 0 to 1; only of use where it does.
            NaN where nobody looked.
    """

    survives: Flags
    edge: Array

    def at(self, nodes: Nodes, behind: Index, share: Array, joint: Index) -> Flags:
        """(N,) Verdicts for joint (N,) between the nodes, as :meth:`Nodes.place` says where."""
        after = np.where(share < self.edge[behind, joint], behind, nodes.after[behind])
        return np.asarray(self.survives[after, joint])

    def most_near(self, nodes: Nodes, rates: Array) -> Array:
        """(P,) the largest sum of rates (n,) of survived locks at each node and up to halfway to its neighbours."""
        here, there = self.survives, self.survives[nodes.after]
        known = np.isfinite(self.edge)
        ahead, behind = np.zeros((2, len(here)))  # of each piece in its first half, and in its second
        # Along a piece verdicts change one after the other: with each change, and in the middle, something new may be had.
        for place in (np.zeros(len(here)), np.full(len(here), 0.5), *self.edge.T):
            sums = np.where(known, np.where(place[:, None] < self.edge, here, there), here | there) @ rates
            np.maximum(ahead, sums, out=ahead, where=~(place > 0.5))
            np.maximum(behind, sums, out=behind, where=~(place < 0.5))
        return np.where(nodes.before == np.arange(len(here)), ahead, np.maximum(ahead, behind[nodes.before]))

    def kept_share(self, node: int, other: int, *, ahead: bool) -> float:
        """How far a node may go towards its neighbour, ahead of it or behind, and lose nothing: 0 to 1, rather too little."""
        lost = self.survives[node] & ~self.survives[other]
        edge = self.edge[node if ahead else other, lost]
        share = float(np.min(edge if ahead else 1 - edge, initial=1.0)) - 1 / _PARTS
        return max(share, 0.0) if share == share else 0.0


def on_path(lock: Lock, nodes: list[Nodes]) -> list[Verdicts]:
    """For every pose: is a lock of the joint there, at the node, followed by the rest of the tool's path?

    One step of the locked arm leads to the next pose, between nodes there whose verdicts are known, and where between them they
    change. Where it does not lead to a known curve the arm is followed on until it does.
    """
    n = lock.arm.n
    sizes = [len(x.q) for x in nodes[:-1]]
    every = np.concatenate([x.q for x in nodes[:-1]])
    landed, reached = lock.step_all(every, np.repeat(np.arange(len(sizes)), sizes))
    ends = np.cumsum([0, *sizes])
    table = [_always(nodes[-1], n)]
    for t in each("poses", range(len(nodes) - 2, -1, -1)):
        here = slice(ends[t], ends[t + 1])
        node, joint = np.nonzero(reached[here])
        survives = np.zeros((sizes[t], n), dtype=bool)
        survives[node, joint] = _followed(lock, nodes, table, t + 1, landed[here][node, joint], joint)
        table.append(Verdicts(survives, _edges(lock, nodes, table, t, survives)))
    return table[::-1]


def _always(nodes: Nodes, n: int) -> Verdicts:
    """At the last pose nothing is left to be lost."""
    shape = (len(nodes.q), n)
    return Verdicts(np.ones(shape, dtype=bool), np.ones(shape))


def _edges(lock: Lock, nodes: list[Nodes], table: list[Verdicts], t: int, survives: Flags) -> Array:
    """(P, n) Where the verdicts of pose t change, between the nodes; the table is known back to t + 1."""
    here = nodes[t]
    edge = np.full(survives.shape, 0.5)
    node, joint = np.nonzero(survives != survives[here.after])
    first = survives[node, joint]
    low = np.zeros(node.size)
    for parts in (1 / _PARTS, 1 / _PARTS**2):
        share = low[:, None] + parts * np.arange(1, _PARTS)
        some, lock_of = np.repeat(node, _PARTS - 1), np.repeat(joint, _PARTS - 1)
        q = here.q[some] + share.reshape(-1, 1) * here.pieces[some]
        q, on, _ = lock.tracer.corrected(q, np.broadcast_to(lock.poses[t], (len(q), 4, 4)))
        q, good = lock.step(q, lock_of, t)
        good &= on
        verdict = np.zeros(len(q), dtype=bool)
        verdict[good] = _followed(lock, nodes, table, t + 1, q[good], lock_of[good])
        # Up to the first part that differs from the node behind.
        differs = np.column_stack([verdict.reshape(share.shape) != first[:, None], np.ones(node.size, dtype=bool)])
        low += parts * differs.argmax(axis=1)
    edge[node, joint] = low + 0.5 / _PARTS**2
    return edge


def _followed(lock: Lock, nodes: list[Nodes], table: list[Verdicts], t: int, q: Array, joint: Index) -> Flags:
    """(N,) Verdicts of q (N, n) on pose t with joint (N,) locked; the table is known from its end back to t."""
    verdict = np.ones(len(q), dtype=bool)
    left = np.arange(len(q))
    last = len(nodes) - 1
    while left.size and t < last:
        behind, share, known = nodes[t].place(q)
        verdict[left[known]] = table[last - t].at(nodes[t], behind[known], share[known], joint[known])
        left, q, joint = left[~known], q[~known], joint[~known]
        if left.size:
            q, good = lock.step(q, joint, t)
            verdict[left[~good]] = False
            left, q, joint = left[good], q[good], joint[good]
        t += 1
    return verdict


def detours(nodes: list[Nodes], found: list[SelfMotion]) -> list[Verdicts]:
    """For every pose: do all poses from there on have a configuration with the joint where it locks?

    Then a failed arm without obstacles gets back to the path from wherever it is: a locked value is common to both ends of the
    straight way, and joint limits are a box.

    Source: Lewis and Maciejewski 1997, ranges of a joint over a self-motion manifold.
    """
    survives = [within(x.arm, x.q, ranges) for x, ranges in zip(nodes, common_ranges(found), strict=True)]
    return [Verdicts(s, np.full(s.shape, np.nan)) for s in survives]


def common_ranges(found: list[SelfMotion]) -> list[list[Spans]]:
    """For every pose and joint its values common to all poses from there on; of joints without limits in 0 to 2 pi."""
    arm = found[0].arm
    turning = joint_space.turning(arm)
    common: list[Spans] = [[(-np.inf, np.inf)]] * arm.n
    table = []
    for each_pose in reversed(found):
        arcs = [_folded(arc) if turns else arc for arc, turns in zip(each_pose.arcs(), turning, strict=True)]
        common = [_shared(a, b) for a, b in zip(common, arcs, strict=True)]
        table.append(common)
    return table[::-1]


def within(arm: Arm, q: Array, ranges: list[Spans]) -> Flags:
    """(N, n) which joints of q (N, n) are within their ranges."""
    inside = np.zeros(q.shape, dtype=bool)
    for k, values in enumerate(joint_space.folded(arm, q).T):
        for low, high in ranges[k]:
            inside[:, k] |= (values >= low - _SAME) & (values <= high + _SAME)
    return inside


def _folded(arcs: Spans) -> Spans:
    """Arcs of a circle as parts of 0 to 2 pi."""
    found: Spans = []
    for low, high in arcs:
        begin = low % (2 * np.pi)
        end = begin + min(high - low, 2 * np.pi)
        found.append((begin, min(end, 2 * np.pi)))
        if end > 2 * np.pi:
            found.append((0.0, end - 2 * np.pi))
    return found


def _shared(a: Spans, b: Spans) -> Spans:
    """What two unions of intervals have in common."""
    both = [(max(low, other[0]), min(high, other[1])) for low, high in a for other in b]
    return sorted((low, high) for low, high in both if low <= high)


def along(lock: Lock, q: Array, asked: Flags | None = None) -> Flags:
    """(T, n) as :func:`on_path` for one configuration q (T, n) of each pose: every lock is followed to the end.

    Only those ``asked`` (T, n) if given; where q is NaN none is.
    """
    survives = np.zeros(q.shape, dtype=bool)
    there = np.isfinite(q).all(axis=1, keepdims=True)
    wanted = np.broadcast_to(there, q.shape) if asked is None else asked & there
    survives[-1] = wanted[-1]
    at = np.empty((0, lock.arm.n))
    begun, joint = np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    for t in each("poses", range(len(q) - 1)):
        fresh = np.flatnonzero(wanted[t])
        at = np.concatenate([at, np.repeat(q[t : t + 1], fresh.size, axis=0)])
        begun, joint = np.concatenate([begun, np.full(fresh.size, t)]), np.concatenate([joint, fresh])
        at, good = lock.step(at, joint, t)
        at, begun, joint = at[good], begun[good], joint[good]
    survives[begun, joint] = True
    return survives


def changing(locks: Sequence[Lock], q: Array, asked: Flags) -> Flags:
    """(T, n) as :func:`along`, of an arm with redundancy left that may hold other joints, those of another lock, at every pose.

    Of all configurations that this leads to a few are followed on, far apart.
    """
    survives = np.zeros(q.shape, dtype=bool)
    survives[-1] = asked[-1]
    at = np.empty((0, q.shape[1]))
    begun, joint = np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    for t in each("poses", range(len(q) - 1)):
        fresh = np.flatnonzero(asked[t])
        at = np.concatenate([at, np.repeat(q[t : t + 1], fresh.size, axis=0)])
        begun, joint = np.concatenate([begun, np.full(fresh.size, t)]), np.concatenate([joint, fresh])
        landed, row = [at[:0]], [begun[:0]]
        for lock in locks:
            some = np.flatnonzero(~np.isin(joint, list(lock.tracer.held)))
            moved, good = lock.step(at[some], joint[some], t)
            landed.append(moved[good])
            row.append(some[good])
        at, rows = np.concatenate(landed), np.concatenate(row)
        begun, joint = begun[rows], joint[rows]
        some = apart(at, begun * q.shape[1] + joint)
        at, begun, joint = at[some], begun[some], joint[some]
    survives[begun, joint] = True
    return survives


def apart(q: Array, owner: Index) -> Index:
    """Which of q (N, n) to keep: of each owner (N,) the first and then, up to a few, the farthest from those that are kept."""
    _, first, group = np.unique(owner, return_index=True, return_inverse=True)
    kept, away = [first], np.full(len(q), np.inf)
    for _ in range(KEPT - 1):
        away = np.minimum(away, np.abs(q - q[kept[-1]][group]).max(axis=1))
        order = np.lexsort((-away, group))
        kept.append(order[np.flatnonzero(np.diff(group[order], prepend=-1))])
    return np.unique(np.concatenate(kept))
