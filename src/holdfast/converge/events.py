"""What happens along a curve of rest points: folds, branch points, changes of stability, loss of rank, the target itself.

Each is a change of sign of a function of the point, bisected between two points of the curve, and becomes a point of it.
Stability changes where the determinant of the linearisation changes its sign, or the product of all sums of two eigenvalues
(the determinant of the bialternate sum): the second catches pairs that cross the imaginary axis while the determinant keeps
its sign, which Goel et al. 2005 leave out.
"""

from __future__ import annotations

import itertools
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from holdfast.converge.curves import Curve, Segment
from holdfast.converge.linearisation import Kind, kinds
from holdfast.converge.rest_system import RestSystem

Array = NDArray[np.float64]

SHORT = 1e-4  # rad and m: events nearer than this are at one place
_BISECTIONS, _NEWTON = 48, 4


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
    forward = np.gradient(z, axis=0)
    tests = _tests(system, joint, z, forward)
    skip = (Event.FOLD, Event.DETERMINANT, Event.PAIR) if constant else ()
    signs = np.sign(tests)
    changes = (signs[1:] * signs[:-1] < 0) & ~np.isin(np.arange(len(Event)), skip)
    at, which = np.nonzero(changes)
    share, points = _bisected(system, joint, z[at], z[at + 1], which, signs[at, which])
    position = np.concatenate([np.arange(len(z), dtype=float), at + share])
    label = np.concatenate([np.full(len(z), -1), which])
    order = np.argsort(position, kind="stable")
    z, label = np.concatenate([z, points])[order], label[order]
    q = z[:, :n]
    eigenvalues, (_, error) = system.eigenvalues(q), system.linear.rates(q, system.pose)
    kind = np.full(len(q), Kind.DEGENERATE, dtype=np.uint8) if constant else kinds(eigenvalues, error)
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


def _tests(system: RestSystem, joint: int, z: Array, forward: Array) -> Array:
    """(N, 6) the functions of which a change of sign is an event."""
    n = system.law.arm.n
    _, slopes = system.values(z)
    tangent = np.linalg.svd(slopes)[2][:, -1]
    # Idle joints and the like leave trivial columns; the last right vector is then still along the curve.
    tangent *= np.sign(np.einsum("ij,ij->i", tangent, forward))[:, None]
    moving = np.abs(slopes).max(axis=(0, 1)) > 0
    square = np.concatenate([slopes[:, :, moving], tangent[:, None, moving]], axis=1)
    branch = np.linalg.slogdet(square)[0] if square.shape[1] == square.shape[2] else np.ones(len(z))
    values = system.eigenvalues(z[:, :n])
    first, second = np.triu_indices(values.shape[1], 1)
    pair = np.prod(values[:, first] + values[:, second], axis=1).real
    return np.stack([tangent[:, joint], branch, system.pulls(z), z[:, -1], np.prod(values, axis=1).real, pair], axis=1)


def _bisected(system: RestSystem, joint: int, a: Array, b: Array, which: NDArray[np.intp], sign: Array) -> tuple[Array, Array]:
    """Where, as a share of the step from a to b (N, size), a test function changes its sign, and the points there."""
    rows = np.arange(len(a))
    low, high = np.zeros(len(a)), np.ones(len(a))
    points = a.copy()
    for _ in range(_BISECTIONS if len(a) else 0):
        middle = (low + high) / 2
        points = _between(system, a, b, middle)
        same = np.sign(_tests(system, joint, points, b - a)[rows, which]) == sign
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return (low + high) / 2, points


def _between(system: RestSystem, a: Array, b: Array, share: Array) -> Array:
    """Points of the curve between a and b (N, size), in the plane across the step at a share (N,) of it."""
    step = b - a
    z = a + share[:, None] * step
    for _ in range(_NEWTON):
        values, slopes = system.values(z)
        square = np.concatenate([slopes, step[:, None]], axis=1)
        z = z - np.einsum("ijk,ik->ij", np.linalg.pinv(square, rcond=1e-12), np.pad(values, ((0, 0), (0, 1))))
    return z


def _segments(system: RestSystem, z: Array, label: NDArray[np.int64], kind: NDArray[np.uint8]) -> tuple[Segment, ...]:
    """Stretches of one kind between events."""
    n, out = system.law.arm.n, list[Segment]()
    # Events of several functions at one place leave stretches of no length between them.
    cuts, last = [0], len(z) - 1
    cuts += [
        k for k in np.flatnonzero(label >= 0) if np.linalg.norm(z[k] - z[0]) > SHORT and np.linalg.norm(z[k] - z[last]) > SHORT
    ]
    for first, end in itertools.pairwise([*cuts, last]):
        if np.linalg.norm(z[end] - z[first]) <= SHORT:
            continue
        inside = kind[first + 1 : end]
        inside = inside[np.isin(inside, (Kind.SINK, Kind.SADDLE, Kind.SOURCE))]
        if not len(inside):
            middle = _between(system, z[first : first + 1], z[end : end + 1], np.array([0.5]))[:, :n]
            inside = kinds(system.eigenvalues(middle), system.linear.rates(middle, system.pose)[1])
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
