"""What lies between the numbers of a field, and its gradient: compiled once for all fields, whose numbers are inputs.

A point is looked up in two tables, the grid and what is seen from outside: one kernel says where, the other what is there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.cell.nodes import DIAGONAL
from holdfast.cell.outside import ACROSS, AWAY
from holdfast.kernels import Kernel
from holdfast.kernels.program import SX
from holdfast.linalg import Vector

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

FACTS = 10  # of a field: origin (3), width, last node (3), largest 1 / r, rim, reach
_MOST = 1 << 20  # more nodes than any table has in a row


class Place(NamedTuple):
    """Where a point is.

    Attributes:
        grid: (3,) in the grid, widths from its first node.
        table: (3,) in what is seen from outside, steps from the first node of a face.
        face: Which.
        beyond: How far outside the box of the grid, m; below 0 within.
        far: r, m.
        own: (3,) from the middle of the grid, m.
        half: (3,) half the edges of the grid, m.
    """

    grid: Vector
    table: Vector
    face: SX
    beyond: SX
    far: SX
    own: Vector
    half: Vector


@dataclass(frozen=True, eq=False)
class Tables:
    """The numbers of one field.

    Attributes:
        facts: (FACTS,).
        values: (X, Y, Z) of the nodes of its grid.
        beyond: (6, ACROSS, ACROSS, AWAY) of what is seen from outside.
    """

    facts: Array
    values: NDArray[np.float32]
    beyond: NDArray[np.float32]


def bounds(at: Array, tables: Sequence[Tables], counts: Sequence[int]) -> Array:
    """(N, 4) the bound and its gradient at points (N, 3): so many of the first field, each in its own frame, and so on."""
    facts = np.repeat([one.facts for one in tables], counts, axis=0) if len(tables) > 1 else tables[0].facts
    where = np.clip(np.nan_to_num(_place_kernel().rows(at, facts)), 0, _MOST).astype(np.int64)
    cells, corners = np.empty((len(at), 6)), np.empty((len(at), 16))
    ends = np.cumsum(counts)
    for one, start, stop in zip(tables, ends - counts, ends, strict=True):
        _look_up(one.values, where[start:stop, :3], 0, cells[start:stop, :3], corners[start:stop, :8])
        _look_up(one.beyond, where[start:stop, 3:6], where[start:stop, 6], cells[start:stop, 3:], corners[start:stop, 8:])
    return _bound_kernel().rows(at, facts, cells, corners)


def _look_up(table: NDArray[np.float32], where: Indices, block: Indices | int, cells: Array, corners: Array) -> None:
    """Cells (N, 3) of a block of a table in which places (N, 3) are, or the nearest, and what is at their corners (N, 8)."""
    x, y, z = table.shape[-3:]
    cell = np.minimum(where, [x - 2, y - 2, z - 2])
    cells[:] = cell
    first = ((block * x + cell[:, 0]) * y + cell[:, 1]) * z + cell[:, 2]
    steps = [(i * y + j) * z + k for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    corners[:] = table.reshape(-1)[first[:, None] + steps]


@cache
def _place_kernel() -> Kernel:
    """(7,) places of a point (3,) in the two tables, and the face; of facts."""
    at, facts = ca.SX.sym("at", 3), ca.SX.sym("facts", FACTS)
    place = _place(at, facts)
    return Kernel("place in a field", [at, facts], [ca.vertcat(*place.grid, *place.table, place.face)])


@cache
def _bound_kernel() -> Kernel:
    """The bound and its gradient, (4,), at a point (3,); of facts, the cells (6,) it is in and their corners (16,)."""
    at, facts, cells, corners = (ca.SX.sym(*x) for x in (("at", 3), ("facts", FACTS), ("cells", 6), ("corners", 16)))
    place, width = _place(at, facts), facts[3]
    t = [x - cells[k] for k, x in enumerate(place.grid)]
    inner = _in_grid(ca.vertsplit(corners[:8]), t, width)
    one, two, root = place.table
    last = cells[5]
    s = [one - cells[3], two - cells[4], (root * root - last * last) / (2 * last + 1)]
    outer = _from_outside(ca.vertsplit(corners[8:]), s, place, facts[8])
    share = 1 + place.beyond / width  # of what is seen from outside
    value = ca.if_else(share <= 0, inner, ca.if_else(share >= 1, outer, inner + share * (outer - inner)))
    ball = _root(_square(place.own)) - facts[9]
    value = ca.if_else(value < ball, ball, value)
    return Kernel("bound of a field", [at, facts, cells, corners], [ca.vertcat(value, ca.gradient(value, at))])


def _place(at: SX, facts: SX) -> Place:
    width = facts[3]
    half = [width * facts[4 + k] / 2 for k in range(3)]
    own = [at[k] - facts[k] - half[k] for k in range(3)]
    out = [ca.fabs(own[k]) - half[k] for k in range(3)]
    first, second = ca.logic_and(out[0] >= out[1], out[0] >= out[2]), out[1] >= out[2]

    def turned(v: Vector, k: int) -> SX:
        """The coordinate of the face for k = 0, then those that follow."""
        return ca.if_else(first, v[k], ca.if_else(second, v[(k + 1) % 3], v[(k + 2) % 3]))

    beyond = turned(out, 0)
    z = ca.if_else(beyond > -width, beyond, -width)  # deeper within nothing is looked up
    share = [turned(own, k) / (turned(half, k) + z) for k in (1, 2)]
    far = z + width + 1 / facts[7]
    table = [*((x + 1) * ((ACROSS - 1) / 2) for x in share), (AWAY - 1) / ca.sqrt(far * facts[7])]
    face = 2 * ca.if_else(first, 0.0, ca.if_else(second, 1.0, 2.0)) + ca.if_else(turned(own, 0) > 0, 1.0, 0.0)
    return Place([(at[k] - facts[k]) / width for k in range(3)], table, face, beyond, far, own, half)


def _in_grid(corners: Vector, t: Vector, width: SX) -> SX:
    plain = _trilinear(corners, t) - DIAGONAL * width
    square = _trilinear([ca.if_else(x > 0, x * x, 0.0) for x in corners], t)
    square -= width * width * sum(x * (1 - x) for x in t)
    more = _root(square) - plain
    part = ca.if_else(square < width * width, square / (width * width), 1.0)
    return plain + ca.if_else(ca.logic_and(square > 0, more > 0), part * more, 0.0)


def _from_outside(corners: Vector, s: Vector, place: Place, rim: SX) -> SX:
    root = _root(_square(place.own) - place.far * _trilinear(corners, s))
    # All of it is in a smaller box, too.
    gap = [ca.fabs(place.own[k]) - place.half[k] + rim for k in range(3)]
    box = _root(_square([ca.if_else(x > 0, x, 0.0) for x in gap]))
    return ca.if_else(root < box, box, root)


def _trilinear(corners: Vector, t: Vector) -> SX:
    """Between the corners of a cube, whose last coordinate changes first."""
    for x in t:
        half = len(corners) // 2
        corners = [a + x * (b - a) for a, b in zip(corners[:half], corners[half:], strict=True)]
    return corners[0]


def _square(v: Vector) -> SX:
    return sum(x * x for x in v)


def _root(x: SX) -> SX:
    """0 where there is none, and so is its derivative."""
    return ca.if_else(x > 0, ca.sqrt(ca.if_else(x > 0, x, 1.0)), 0.0)
