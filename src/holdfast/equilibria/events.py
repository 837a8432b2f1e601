"""What happens along a curve of stationary points: folds, branch points, changes of stability, loss of rank, the target itself.

Each is a change of sign of a function of the point, bisected between two points of the curve, and becomes a point of it.
Stability changes where the determinant of the linearisation changes its sign, or the product of all sums of two eigenvalues
(the determinant of the bialternate sum): the second catches pairs that cross the imaginary axis while the determinant keeps
its sign, which Goel et al. 2005 leave out.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from holdfast.equilibria.curves import Curve, Segment
from holdfast.equilibria.stability import Kind, kinds
from holdfast.equilibria.system import RestSystem

Array = NDArray[np.float64]

SHORT = 1e-4  # rad and m: events nearer than this are at one place
_BISECTIONS, _NEWTON = 44, 3
_CROSSING = 1e-3  # of the largest singular value: directions with less are those of a crossing curve


class Event(IntEnum):
    """What happens at a point of a curve; the order is that of the test functions.

    ``FOLD``: the locked value turns back. ``BRANCH``: another curve crosses. ``RANK_LOSS``: the Jacobian loses rank.
    ``TARGET``: the target is reached. ``DETERMINANT`` and ``PAIR``: the determinant, or a sum of two eigenvalues, is 0.
    """

    FOLD = 0
    BRANCH = 1
    RANK_LOSS = 2
    TARGET = 3
    DETERMINANT = 4
    PAIR = 5


def marked(system: RestSystem, joint: int, z: Array, closed: bool, constant: bool) -> Curve:
    """A curve from its traced points z (K, size), with all events found and put in as points."""
    n = system.law.arm.n
    tests, tangents = _tests(system, joint, z, np.gradient(z, axis=0))
    skip = (Event.FOLD, Event.DETERMINANT, Event.PAIR) if constant else ()
    signs = np.sign(tests)
    changes = (signs[1:] * signs[:-1] < 0) & ~np.isin(np.arange(len(Event)), skip)
    at, which = np.nonzero(changes)
    steps = Steps(system, z[at], z[at + 1], tangents[at], tangents[at + 1])
    share, points = _bisected(system, joint, steps, which, signs[at, which])
    position = np.concatenate([np.arange(len(z), dtype=float), at + share])
    label = np.concatenate([np.full(len(z), -1), which])
    order = np.argsort(position, kind="stable")
    z, label = np.concatenate([z, points])[order], label[order]
    q = z[:, :n]
    eigenvalues, (_, error, scaled) = system.eigenvalues(q), system.linear.rates(q, system.pose)
    kind = np.full(len(q), Kind.DEGENERATE, dtype=np.uint8) if constant else kinds(eigenvalues, scaled)
    kind[label == Event.TARGET] = Kind.SOLUTION
    segments = (Segment(Kind.DEGENERATE, 0, len(q) - 1),) if constant else _segments(system, z, label, kind)
    return Curve(
        q=q,
        joint=joint,
        kind=kind,
        eigenvalues=eigenvalues,
        error=error,
        closed=closed,
        degenerate=constant,
        folds=np.flatnonzero(label == Event.FOLD),
        branch_points=np.flatnonzero(label == Event.BRANCH),
        rank_losses=np.flatnonzero(label == Event.RANK_LOSS),
        solutions=np.flatnonzero(label == Event.TARGET),
        hopf_points=np.flatnonzero((label == Event.PAIR) & _oscillates(eigenvalues)),
        segments=segments,
    )


@dataclass(frozen=True)
class Steps:
    """Steps along a curve, from one point to the next.

    Attributes:
        system: What the curve is of.
        start, end: (N, size) unknowns.
        start_tangent, end_tangent: (N, size) unit tangents.
    """

    system: RestSystem
    start: Array
    end: Array
    start_tangent: Array
    end_tangent: Array

    def between(self, share: Array) -> Array:
        """Points (N, size) at a share (N,) of the steps: a cubic, and from it back to the curve.

        Where another curve crosses, the way back is not defined in its direction; there the cubic stays as it is.
        """
        x = share[:, None]
        step, active = self.end - self.start, self.system.active
        size = np.linalg.norm(step, axis=1, keepdims=True)
        z = self.start + x * x * (3 - 2 * x) * step
        z += x * (1 - x) * size * ((1 - x) * self.start_tangent - x * self.end_tangent)
        across = step[:, None, active] / size[:, None]
        plane = np.einsum("ij,ij->i", across[:, 0], z[:, active])
        for _ in range(_NEWTON):
            values, slopes = self.system.values(z)
            off = np.einsum("ij,ij->i", across[:, 0], z[:, active]) - plane
            back = np.linalg.pinv(np.concatenate([slopes, across], axis=1), rcond=_CROSSING)
            z[:, active] -= np.einsum("ijk,ik->ij", back, np.column_stack([values, off]))
        return z


def _tests(system: RestSystem, joint: int, z: Array, forward: Array) -> tuple[Array, Array]:
    """(N, 6) the functions of which a change of sign is an event, and unit tangents (N, size)."""
    _, slopes = system.values(z)
    tangent = np.zeros_like(z)
    tangent[:, system.active] = np.linalg.svd(slopes)[2][:, -1]
    tangent *= np.sign(np.einsum("ij,ij->i", tangent, forward))[:, None]
    branch = np.linalg.slogdet(np.concatenate([slopes, tangent[:, None, system.active]], axis=1))[0]
    values = system.eigenvalues(z[:, : system.law.arm.n])
    first, second = np.triu_indices(values.shape[1], 1)
    pair = np.prod(values[:, first] + values[:, second], axis=1).real
    tests = [tangent[:, joint], branch, system.pulls(z), z[:, -1], np.prod(values, axis=1).real, pair]
    return np.stack(tests, axis=1), tangent


def _bisected(system: RestSystem, joint: int, steps: Steps, which: NDArray[np.intp], sign: Array) -> tuple[Array, Array]:
    """Where, as a share of each step, a test function changes its sign, and the points there."""
    rows, forward = np.arange(len(which)), steps.end - steps.start
    low, high = np.zeros(len(which)), np.ones(len(which))
    points = steps.start.copy()
    for _ in range(_BISECTIONS if len(which) else 0):
        middle = (low + high) / 2
        points = steps.between(middle)
        same = np.sign(_tests(system, joint, points, forward)[0][rows, which]) == sign
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return (low + high) / 2, points


def _segments(system: RestSystem, z: Array, label: NDArray[np.int64], kind: NDArray[np.uint8]) -> tuple[Segment, ...]:
    """Stretches of one kind between events."""
    n, out = system.law.arm.n, list[Segment]()
    # Events of several functions at one place leave stretches of no length between them.
    last = len(z) - 1
    away = np.minimum(np.linalg.norm(z - z[0], axis=1), np.linalg.norm(z - z[last], axis=1))
    cuts = [0, *np.flatnonzero((label >= 0) & (away > SHORT))]
    for first, end in itertools.pairwise([*cuts, last]):
        if np.linalg.norm(z[end] - z[first]) <= SHORT:
            continue
        inside = kind[first + 1 : end]
        inside = inside[np.isin(inside, (Kind.SINK, Kind.SADDLE, Kind.SOURCE))]
        if not len(inside):
            chord = (z[[end]] - z[[first]]) / np.linalg.norm(z[end] - z[first])
            middle = Steps(system, z[[first]], z[[end]], chord, chord).between(np.array([0.5]))[:, :n]
            inside = kinds(system.eigenvalues(middle), system.linear.rates(middle, system.pose)[2])
        found = Kind(int(inside[len(inside) // 2]))
        if out and out[-1].kind == found and not (label[out[-1].first + 1 : end] == Event.FOLD).any():
            out[-1] = Segment(found, out[-1].first, int(end))
        else:
            out.append(Segment(found, int(first), int(end)))
    return tuple(out)


def _oscillates(eigenvalues: NDArray[np.complex128]) -> NDArray[np.bool_]:
    """(N,) whether a complex pair lies on the imaginary axis."""
    size = np.maximum(1.0, np.abs(eigenvalues).max(axis=1, initial=0.0))[:, None]
    return np.asarray(((np.abs(eigenvalues.real) < 1e-6 * size) & (np.abs(eigenvalues.imag) > 1e-6 * size)).any(axis=1))
