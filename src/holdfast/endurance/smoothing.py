"""A motion over nodes made smooth: moved along its self-motion curves, as far as it keeps what it gathers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.endurance.grid import Nodes
from holdfast.endurance.tables import Verdicts
from holdfast.solvers.curve_tracing import Tracer

Array = NDArray[np.float64]
Index = NDArray[np.int64]

_FAR = 0.15  # rad along its curve is the most that a configuration is moved
_ROUNDS = 3


def smoothed(
    tracer: Tracer,
    nodes: list[Nodes],
    table: list[Verdicts],
    gains: list[Array],
    chosen: Index,
    q: Array,
    poses: Array,
    *,
    held: bool,
) -> Array:
    """The motion q (T, n) over the chosen nodes (T,), moved to where its squared steps are smallest.

    Each configuration moves along its self-motion curve, by at most ``_FAR`` and no farther than it is worth as much; with
    ``held`` the first one stays. A step is nearly linear in these moves, so that it is a least-squares problem with bounds,
    solved a few times over.
    """
    from scipy.optimize import lsq_linear

    sides = zip(*(_room(x, v, g, int(k)) for x, v, g, k in zip(nodes, table, gains, chosen, strict=True)), strict=True)
    low, high = (np.array(side) for side in sides)
    free = np.flatnonzero((high - low > 1e-9) & ~(held & (np.arange(len(q)) == 0)))
    if not free.size:
        return q
    # The curve of a node may run against the null vector that comes with it.
    ahead = np.array([x.pieces[k] if x.after[k] != k else x.pieces[x.before[k]] for x, k in zip(nodes, chosen, strict=True)])
    moved, shift = q, np.zeros(len(q))
    for _ in range(_ROUNDS):
        tangent = tracer.corrected(moved, poses)[2][:, 0]
        tangent *= np.where(np.einsum("ij,ij->i", tangent, ahead) < 0, -1.0, 1.0)[:, None]
        matrix = np.zeros((len(q) - 1, q.shape[1], len(q)))
        row = np.arange(len(q) - 1)
        matrix[row, :, row], matrix[row, :, row + 1] = -tangent[:-1], tangent[1:]
        steps = np.diff(moved, axis=0).reshape(-1)
        bounds = (low - shift)[free], (high - shift)[free]
        change = np.zeros(len(q))
        change[free] = lsq_linear(matrix.reshape(-1, len(q))[:, free], -steps, bounds, tol=1e-6).x
        after, on, _ = tracer.corrected(moved + change[:, None] * tangent, poses)
        inside = ((after >= tracer.arm.lower) & (after <= tracer.arm.upper)).all(axis=1)
        if not (on & inside).all():
            break
        moved, shift = after, shift + change
    return moved


def _room(nodes: Nodes, verdicts: Verdicts, gain: Array, chosen: int) -> tuple[float, float]:
    """How far a configuration may go against and along its curve before it is worth less."""
    ends = []
    for to, sign in ((nodes.before, -1.0), (nodes.after, 1.0)):
        way, k = 0.0, chosen
        while way < _FAR and to[k] != k:
            other = int(to[k])
            piece = float(np.linalg.norm(nodes.pieces[k if sign > 0 else other]))
            if gain[other] < gain[chosen] - 1e-12:
                way += piece * verdicts.kept_share(k, other, ahead=sign > 0)
                break
            way, k = way + piece, other
        ends.append(sign * min(way, _FAR))
    return ends[0], ends[1]
