"""Distance from a surface or a cloud by tables of numbers: from below, and fast."""

from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.caching import cached_property
from holdfast.cell.interpolation import Tables, bounds
from holdfast.cell.nodes import DIAGONAL, Grid, between, cut, inside, points, triangles
from holdfast.cell.outside import ACROSS, AWAY, half, nearest_to, seen_from_outside
from holdfast.files.mesh import Triangles
from holdfast.kernels import cache

Array = NDArray[np.float64]
Made = tuple[Grid, Array, NDArray[np.float32], float]  # grid, signed distances of its nodes, and what is seen from outside

_FORMAT = 3  # of what is on the disk; another number where the making changes
_NODES = 1_000_000
_FINEST = 1e-3  # m
_RIM = 2.0  # widths
_LONGEST = 4.0  # widths: edge of the triangles that nodes are compared with
_AT_ONCE = 1 << 13  # points


@dataclass(frozen=True, eq=False)
class Field:
    """A lower bound of a signed distance, from its values at the nodes of a grid and, beyond that, on the faces of its box.

    Two bounds are interpolated in the grid. A signed distance changes by at most 1 m per m, so what is between the nodes
    differs from their mean, weighted as trilinear interpolation does, by at most half a diagonal of the grid's cubes. And
    ``|p|^2 - d^2`` is convex, being the largest of ``2 p.s - |s|^2`` over the surface; so outside ``d^2`` is at least its mean
    less the mean of the squares of how far the nodes are, ``w^2 sum t (1 - t)``. The second is the better one but next to the
    surface, where it counts by and by, so that the bound has no step. Nor has it where the grid ends, see
    :mod:`holdfast.cell.outside`: within the outermost width one passes over into the other.

    Attributes:
        grid: The nodes, in the object's own frame.
        values: What the signed distance of each node is at least, m.
        beyond: (6, ACROSS, ACROSS, AWAY) what is seen from outside, see :func:`holdfast.cell.outside.seen_from_outside`.
        reach: How far any of it is from the middle of the grid, m.
        less: Taken away from the distance at the end, m: the radius of the balls of a cloud.
    """

    grid: Grid
    values: NDArray[np.float32]
    beyond: NDArray[np.float32]
    reach: float
    less: float = 0.0

    @property
    def middle(self) -> Array:
        """(3,) of the grid, m."""
        return np.asarray(self.grid.origin + half(self.grid))

    @property
    def excess(self) -> float:
        """How far the bound is below the signed distance that the nodes interpolate, m."""
        return float(DIAGONAL * self.grid.width)

    def distance_and_gradient(self, at: ArrayLike) -> tuple[Array, Array]:
        """The bound (...,), m, and its gradient (..., 3) at points (..., 3), all in the object's own frame.

        It is never below the distance from the ball about ``middle`` that has all of it, less ``less``.
        """
        rows = np.asarray(at, dtype=np.float64)
        flat = rows.reshape(-1, 3)
        parts = [flat[k : k + _AT_ONCE] for k in range(0, len(flat), _AT_ONCE)]
        found = np.concatenate([np.empty((0, 4)), *[bounds(part, [self.tables], [len(part)]) for part in parts]])
        return found[:, 0].reshape(rows.shape[:-1]) - self.less, found[:, 1:].reshape(rows.shape)

    @cached_property
    def tables(self) -> Tables:
        """Its numbers, as they are looked up."""
        grid = self.grid
        last = np.array(grid.shape) - 1.0
        facts = np.array([*grid.origin, grid.width, *last, nearest_to(grid), _RIM * grid.width, self.reach])
        return Tables(facts, self.values, self.beyond)


def of_surface(surface: Triangles, digest: str) -> Field:
    """The field of what a closed surface encloses; the one on the disk, if it was made before.

    Args:
        surface: Triangles that face outward, m.
        digest: SHA-256 of them.
    """
    return _kept(digest, lambda: _of_surface(surface), 0.0)


def of_points(centres: Array, radius: float, digest: str) -> Field:
    """The field of balls: the distance from the nearest centre (N, 3), less the radius, m."""
    return _kept(digest, lambda: _of_points(centres), radius)


def _of_surface(surface: Triangles) -> Made:
    corners = surface.vertices[surface.faces]
    grid = Grid.around(surface.vertices.min(axis=0), surface.vertices.max(axis=0), _RIM, _NODES, _FINEST)
    below, above = between(grid, triangles(corners, _LONGEST * grid.width))
    within = inside(grid, surface.vertices, surface.faces, below)
    # The foot of a point on the surface is in a cut triangle. A corner of that which is in the same plane, or on the same edge,
    # is within the longest edge over the root of 3 of the foot, and farther from the point by Pythagoras.
    longest = half(grid).max() / ACROSS
    beyond = seen_from_outside(grid, cut(corners, longest).reshape(-1, 3), longest / np.sqrt(3))
    return grid, np.where(within, -above, below), *beyond


def _of_points(centres: Array) -> Made:
    grid = Grid.around(centres.min(axis=0), centres.max(axis=0), _RIM, _NODES, _FINEST)
    return grid, between(grid, points(centres))[0], *seen_from_outside(grid, centres, 0.0)


def _kept(digest: str, make: Callable[[], Made], less: float) -> Field:
    """From the disk, or made and put there."""
    name = cache.key(digest, "field", _FORMAT, _NODES, _FINEST, ACROSS, AWAY)
    found = cache.load(name)
    if found is not None:
        stored = np.load(io.BytesIO(found), allow_pickle=False)
        values = stored["values"]
        x, y, z = values.shape
        grid = Grid(stored["origin"], float(stored["width"]), (x, y, z))
        return Field(grid, values, stored["beyond"], float(stored["reach"]), less)
    grid, exact, beyond, reach = make()
    values = np.nextafter(exact.astype(np.float32), np.float32(-np.inf))
    stream = io.BytesIO()
    np.savez(stream, values=values, beyond=beyond, reach=reach, origin=grid.origin, width=grid.width)
    cache.store(name, stream.getvalue())
    return Field(grid, values, beyond, reach, less)
