"""Distance from a surface or a cloud by a grid of numbers: from below, and fast."""

from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.cell.nodes import DIAGONAL, Grid, between, inside, points, triangles
from holdfast.files.mesh import Triangles
from holdfast.kernels import cache

Array = NDArray[np.float64]

_FORMAT = 1  # of what is on the disk; another number where the making changes
_NODES = 1_000_000
_FINEST = 1e-3  # m
_RIM = 2.0  # widths
_LONGEST = 4.0  # widths: edge of the triangles that nodes are compared with
_AT_ONCE = 1 << 16  # points


@dataclass(frozen=True, eq=False)
class Field:
    """A lower bound of a signed distance, from its values at the nodes of a grid.

    A signed distance changes by at most 1 m per m, so what is between the nodes differs from their mean, weighted as trilinear
    interpolation does, by at most half a diagonal of the grid's cubes: the bound is that mean less this. For a point p beyond
    the grid and b, the nearest to it in the grid's box, ``|p - s|^2 >= |p - b|^2 + |b - s|^2`` for all s in it, as it is
    convex.

    Attributes:
        grid: The nodes, in the object's own frame.
        values: What the signed distance of each node is at least, m.
        less: Taken away from the distance at the end, m: the radius of the balls of a cloud.
    """

    grid: Grid
    values: NDArray[np.float32]
    less: float = 0.0

    @property
    def excess(self) -> float:
        """How far the bound is below the value that the nodes interpolate, m."""
        return float(DIAGONAL * self.grid.width)

    def distance(self, at: ArrayLike) -> Array:
        """The bound (...,), m, at points (..., 3) in the object's own frame."""
        rows = np.asarray(at, dtype=np.float64)
        flat = rows.reshape(-1, 3)
        found = [self._some(flat[k : k + _AT_ONCE], slope=False)[0] for k in range(0, len(flat), _AT_ONCE)]
        return np.concatenate([np.zeros(0), *found]).reshape(rows.shape[:-1])

    def distance_and_gradient(self, at: ArrayLike) -> tuple[Array, Array]:
        """The bound (...,), m, and its gradient (..., 3) at points (..., 3), all in the object's own frame."""
        rows = np.asarray(at, dtype=np.float64)
        flat = rows.reshape(-1, 3)
        found = [self._some(flat[k : k + _AT_ONCE], slope=True) for k in range(0, len(flat), _AT_ONCE)]
        distance = np.concatenate([np.zeros(0), *[a for a, _ in found]]).reshape(rows.shape[:-1])
        return distance, np.concatenate([np.zeros((0, 3)), *[b for _, b in found]]).reshape(rows.shape)

    def _some(self, at: Array, slope: bool) -> tuple[Array, Array]:
        grid = self.grid
        last = np.array(grid.shape) - 1
        place = (at - grid.origin) / grid.width
        within = np.clip(place, 0, last)
        beyond = (place - within) * grid.width
        cube = np.minimum(np.nan_to_num(within).astype(np.int64), last - 1)
        t = within - cube
        _, ny, nz = grid.shape
        first = (cube[:, 0] * ny + cube[:, 1]) * nz + cube[:, 2]
        flat = self.values.reshape(-1)
        corner = [flat[first + (i * ny + j) * nz + k].astype(np.float64) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
        along_z = [corner[n] + t[:, 2] * (corner[n + 1] - corner[n]) for n in (0, 2, 4, 6)]
        along_y = [along_z[n] + t[:, 1] * (along_z[n + 1] - along_z[n]) for n in (0, 2)]
        value = along_y[0] + t[:, 0] * (along_y[1] - along_y[0]) - self.excess
        away = np.sqrt((beyond**2).sum(axis=1))
        out = away > 0
        distance = np.where(out, np.hypot(away, np.maximum(value, 0.0)), value)
        if not slope:
            return distance - self.less, at
        over_y = [along_z[n + 1] - along_z[n] for n in (0, 2)]
        over_z = [corner[n + 1] - corner[n] for n in (0, 2, 4, 6)]
        over_z = [over_z[n] + t[:, 1] * (over_z[n + 1] - over_z[n]) for n in (0, 2)]
        ways = [along_y[1] - along_y[0], *(pair[0] + t[:, 0] * (pair[1] - pair[0]) for pair in (over_y, over_z))]
        gradient = np.stack(ways, axis=1) / grid.width
        outward = beyond + np.where(beyond == 0, np.maximum(value, 0.0)[:, None] * gradient, 0.0)
        safe = np.where(out, distance, 1.0)[:, None]
        return distance - self.less, np.where(out[:, None], outward / safe, gradient)


def of_surface(surface: Triangles, digest: str) -> Field:
    """The field of what a closed surface encloses; the one on the disk, if it was made before.

    Args:
        surface: Triangles that face outward, m.
        digest: SHA-256 of them.
    """
    return _kept(digest, lambda: _surface_values(surface), 0.0)


def of_points(centres: Array, radius: float, digest: str) -> Field:
    """The field of balls: the distance from the nearest centre (N, 3), less the radius, m."""
    return _kept(digest, lambda: _cloud_values(centres), radius)


def _surface_values(surface: Triangles) -> tuple[Grid, Array]:
    grid = Grid.around(surface.vertices.min(axis=0), surface.vertices.max(axis=0), _RIM, _NODES, _FINEST)
    below, above = between(grid, triangles(surface.vertices[surface.faces], _LONGEST * grid.width))
    within = inside(grid, surface.vertices, surface.faces, below)
    return grid, np.where(within, -above, below)


def _cloud_values(centres: Array) -> tuple[Grid, Array]:
    grid = Grid.around(centres.min(axis=0), centres.max(axis=0), _RIM, _NODES, _FINEST)
    return grid, between(grid, points(centres))[0]


def _kept(digest: str, make: Callable[[], tuple[Grid, Array]], less: float) -> Field:
    """From the disk, or made and put there."""
    name = cache.key(digest, "field", _FORMAT, _NODES, _FINEST)
    found = cache.load(name)
    if found is not None:
        stored = np.load(io.BytesIO(found), allow_pickle=False)
        values = stored["values"]
        x, y, z = values.shape
        return Field(Grid(stored["origin"], float(stored["width"]), (x, y, z)), values, less)
    grid, exact = make()
    values = np.nextafter(exact.astype(np.float32), np.float32(-np.inf))
    stream = io.BytesIO()
    np.savez(stream, values=values, origin=grid.origin, width=grid.width)
    cache.store(name, stream.getvalue())
    return Field(grid, values, less)
