"""Distances of the nodes of a grid from a surface or from points: exact near by, and from below and above far away.

Near by, each triangle is compared with the nodes about it. Far away, the distance transform of a grid of half the width tells
the distance from its nodes that are nearest to the surface, which lies within half a diagonal of these.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.kernels import Kernel

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Flags = NDArray[np.bool_]

DIAGONAL = np.sqrt(3) / 2  # of a cube of edge 1, half of it
_AT_ONCE = 1 << 19  # pairs of a part and a node, which fit into the cache of a processor
_MOST_PAIRS = 1 << 24
_BANDS = (3.0, 2.0, 1.5, 1.0)  # widths: how far from a part distances are exact, the first that is not too much work


@dataclass(frozen=True)
class Grid:
    """A grid of nodes.

    Attributes:
        origin: (3,) its first node, m.
        width: Between neighbours, m.
        shape: Nodes along x, y and z.
    """

    origin: Array
    width: float
    shape: tuple[int, int, int]

    @property
    def finer(self) -> Grid:
        """With half the width; each second node is one of these."""
        x, y, z = (2 * count - 1 for count in self.shape)
        return Grid(self.origin, self.width / 2, (x, y, z))

    def axis(self, k: int) -> Array:
        """Where its nodes are along x, y or z, m."""
        return np.asarray(self.origin[k] + self.width * np.arange(self.shape[k]))

    @staticmethod
    def around(low: Array, high: Array, rim: float, nodes: int, finest: float) -> Grid:
        """About a box, with at most as many nodes and a rim of so many widths."""
        size = high - low

        def count(width: float) -> Indices:
            return np.asarray(np.ceil(size / width + 2 * rim).astype(np.int64) + 1)

        width = max(finest, float(size.max()) / 1000)
        while count(width).astype(np.float64).prod() > nodes:
            width *= 1.02
        shape = count(width)
        origin = (low + high) / 2 - width * (shape - 1) / 2
        return Grid(origin, width, (int(shape[0]), int(shape[1]), int(shape[2])))


@dataclass(frozen=True)
class Parts:
    """What distances are from: a point or triangle each.

    Attributes:
        low, high: (M, 3) the boxes around them, m.
        squared: Squares of the distances, m^2, of points (P, 3) from the parts of numbers (P,).
    """

    low: Array
    high: Array
    squared: Callable[[Indices, Array], Array]


def points(centres: Array) -> Parts:
    """Parts that are points (N, 3)."""

    def squared(which: Indices, at: Array) -> Array:
        across = at - centres[which]
        return np.asarray(np.einsum("ij,ij->i", across, across))

    return Parts(centres, centres, squared)


def triangles(corners: Array, longest: float) -> Parts:
    """Parts that are triangles (N, 3, 3), cut until no edge is longer, m.

    Each is looked at in a frame of its own: a in the origin, b on the first axis, c above it.
    """
    corners = cut(corners, longest)
    a, b, c = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    long = np.linalg.norm(b, axis=1)
    first = _unit(b, np.array([1.0, 0.0, 0.0]))
    across = c - np.einsum("ij,ij->i", c, first)[:, None] * first
    spare = np.cross(first, np.eye(3)[np.abs(first).argmin(axis=1)])
    second = _unit(across, spare)
    second = _unit(second - np.einsum("ij,ij->i", second, first)[:, None] * first, spare)
    frame = np.stack([first, second, np.cross(first, second)], axis=1)
    cx, cy = np.einsum("ij,ij->i", c, first), np.einsum("ij,ij->i", c, second)
    numbers = np.concatenate([a, frame.reshape(-1, 9), np.stack([long, cx, cy], axis=1)], axis=1)

    squares = _of_triangle()
    return Parts(corners.min(axis=1), corners.max(axis=1), lambda which, at: squares(at, numbers[which]))


@cache
def _of_triangle() -> Kernel:
    """Squares of the distances (P,), m^2, of points (P, 3) from triangles (P, 15): a, the frame, and b and c in it."""
    at, row = ca.SX.sym("at", 3), ca.SX.sym("row", 15)
    own = at - row[:3]
    x, y, z = (ca.dot(own, row[3 + 3 * k : 6 + 3 * k]) for k in range(3))
    long, cx, cy = row[12], row[13], row[14]
    left = cy * (long - x) - y * (long - cx)  # of the edge from b to c
    right = cy * x - y * cx  # of that from c to a
    over = ca.logic_and(y >= 0, ca.logic_and(left >= 0, right >= 0))
    edges = ca.fmin(_segment(x, y, long, 0), ca.fmin(_segment(x, y, cx, cy), _segment(x - long, y, cx - long, cy)))
    return Kernel("distance from a triangle", [at, row], [ca.if_else(over, 0, edges) + z * z])


def _segment(x: ca.SX, y: ca.SX, ex: ca.SX, ey: ca.SX) -> ca.SX:
    """Square of the distance of a point in a plane from a segment that starts in the origin."""
    length = ex * ex + ey * ey
    share = ca.fmin(ca.fmax((x * ex + y * ey) / ca.if_else(length > 0, length, 1), 0), 1)
    return (x - share * ex) ** 2 + (y - share * ey) ** 2


def _unit(rows: Array, spare: Array) -> Array:
    size = np.linalg.norm(rows, axis=1, keepdims=True)
    return np.asarray(
        np.where(size > 1e-12, rows / np.where(size > 1e-12, size, 1.0), spare / np.linalg.norm(spare, axis=-1, keepdims=True))
    )


def cut(corners: Array, longest: float) -> Array:
    """The same surface in triangles without an edge that is longer: each is cut in two at its longest edge."""
    done = []
    while len(corners):
        edges = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
        long = edges.max(axis=1) > longest
        done.append(corners[~long])
        corners, at = corners[long], edges[long].argmax(axis=1)
        rows = np.arange(len(corners))
        a, b, c = corners[rows, at], corners[rows, (at + 1) % 3], corners[rows, (at + 2) % 3]
        middle = (a + b) / 2
        corners = np.concatenate([np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)])
    return np.concatenate(done)


# ---- distances without a sign ------------------------------------------------------------------------------------


def between(grid: Grid, parts: Parts) -> tuple[Array, Array]:
    """Distances of every node from the nearest part, m, from below and from above; equal where they are exact."""
    from scipy.ndimage import distance_transform_edt

    fine = grid.finer
    half = DIAGONAL * fine.width
    seeds = _close(fine, parts, half * (1 + 1e-9)) <= half * (1 + 1e-9)
    # Where the nearest seed of each node is; asked for distances, it would tell those of seven times as many nodes.
    nearest = distance_transform_edt(~seeds, sampling=fine.width, return_distances=False, return_indices=True)
    across = fine.width * (nearest[:, ::2, ::2, ::2] - 2 * np.indices(grid.shape))
    far = np.sqrt((across * across).sum(axis=0))
    band = next((x for x in _BANDS if _work(grid, parts, x * grid.width) <= _MOST_PAIRS), _BANDS[-1]) * grid.width
    near = _close(grid, parts, band)
    exact = near <= band
    return np.where(exact, near, np.maximum(far - half * (1 + 1e-9), 0.0)), np.where(exact, near, far + half * (1 + 1e-9))


def _boxes(grid: Grid, parts: Parts, band: float) -> tuple[Indices, Indices]:
    """First node and numbers of nodes along x, y and z, (M, 3) each, of what is about each part."""
    last = np.array(grid.shape) - 1
    low = np.clip(np.ceil((parts.low - band - grid.origin) / grid.width), 0, last).astype(np.int64)
    high = np.clip(np.floor((parts.high + band - grid.origin) / grid.width), -1, last).astype(np.int64)
    return low, np.maximum(high - low + 1, 0)


def _work(grid: Grid, parts: Parts, band: float) -> float:
    return float(_boxes(grid, parts, band)[1].astype(np.float64).prod(axis=1).sum())


def _close(grid: Grid, parts: Parts, band: float) -> Array:
    """Distance of every node from the nearest part, m, exact where it is at most ``band``; infinite or more elsewhere."""
    low, counts = _boxes(grid, parts, band)
    _, ny, nz = grid.shape
    found = np.full(int(np.prod(grid.shape)), np.inf)
    for which, (i, j, k) in _pairs(low, counts):
        node = (i * ny + j) * nz + k
        at = grid.origin + grid.width * np.stack([i, j, k], axis=1)
        np.minimum.at(found, node, parts.squared(which, at))
    return np.asarray(np.sqrt(found).reshape(grid.shape))


def _pairs(low: Indices, counts: Indices) -> Iterator[tuple[Indices, tuple[Indices, Indices, Indices]]]:
    """Pairs of a part and the place (three numbers) of a node in its box, some at a time."""
    total = counts.prod(axis=1)
    ends = np.cumsum(total)
    start = 0
    while start < len(total):
        done = ends[start - 1] if start else 0
        stop = max(int(np.searchsorted(ends, done + _AT_ONCE, side="right")), start + 1)
        which = np.repeat(np.arange(start, stop), total[start:stop])
        place = np.arange(len(which)) - np.repeat(ends[start:stop] - total[start:stop] - done, total[start:stop])
        box, first = counts[which], low[which]
        rest, k = np.divmod(place, box[:, 2])
        i, j = np.divmod(rest, box[:, 1])
        yield which, (first[:, 0] + i, first[:, 1] + j, first[:, 2] + k)
        start = stop


# ---- the sign ----------------------------------------------------------------------------------------------------


def inside(grid: Grid, vertices: Array, faces: Indices, below: Array) -> Flags:
    """The nodes within a closed surface; where rounding leaves a doubt, those too.

    The triangles above a node are counted with their orientation, along z and, as a check, along x. Neighbours that are both
    further from the surface than half a width are on the same side of it: they vote.

    Args:
        grid: The nodes.
        vertices: (V, 3) m.
        faces: (F, 3) triangles that face outward.
        below: What the distance of each node is at least, m.
    """
    from scipy.ndimage import label

    upward = _winding(grid, vertices, faces) != 0
    turned = Grid(grid.origin[[1, 2, 0]], grid.width, (grid.shape[1], grid.shape[2], grid.shape[0]))
    sideways = (_winding(turned, vertices[:, [1, 2, 0]], faces) != 0).transpose(2, 0, 1)
    groups, count = label(below > grid.width / 2 * (1 + 1e-9))
    votes = np.bincount(groups.ravel(), weights=(upward.astype(np.float64) + sideways).ravel(), minlength=count + 1)
    within = votes > np.bincount(groups.ravel(), minlength=count + 1)
    return np.where(groups > 0, within[groups], upward | sideways)


def _winding(grid: Grid, vertices: Array, faces: Indices) -> NDArray[np.int32]:
    """How often the surface is passed outward less inward on the way up along z from far below to each node, negated."""
    corners = vertices[faces]
    flat = Grid(grid.origin * [1, 1, 0], grid.width, (grid.shape[0], grid.shape[1], 1))
    low, high = corners.min(axis=1) * [1, 1, 0], corners.max(axis=1) * [1, 1, 0]
    first, counts = _boxes(flat, Parts(low, high, lambda which, at: at[:, 0]), 0.0)
    found = np.zeros((*grid.shape[:2], grid.shape[2] + 1), dtype=np.int32)
    for which, (i, j, _) in _pairs(first, counts):
        x, y = grid.origin[0] + grid.width * i, grid.origin[1] + grid.width * j
        sides = []
        weights = []
        for k in range(3):
            # Both triangles at an edge see it from the same end, so that a line through it passes exactly one of them.
            one, two = faces[which, k], faces[which, (k + 1) % 3]
            forward = one < two
            p, q = vertices[np.where(forward, one, two)], vertices[np.where(forward, two, one)]
            area = (q[:, 0] - p[:, 0]) * (y - p[:, 1]) - (q[:, 1] - p[:, 1]) * (x - p[:, 0])
            sides.append((area >= 0) == forward)
            weights.append(np.where(forward, area, -area))
        up = sides[0] & sides[1] & sides[2]
        hit = up | ~(sides[0] | sides[1] | sides[2])
        if not hit.any():
            continue
        share = np.stack([weights[1], weights[2], weights[0]], axis=1)[hit]  # of the corner that is not on the edge
        heights = corners[which[hit], :, 2]
        whole = share.sum(axis=1)
        z = np.where(whole != 0, (share * heights).sum(axis=1) / np.where(whole != 0, whole, 1.0), heights.mean(axis=1))
        z = np.clip(z, heights.min(axis=1), heights.max(axis=1))
        above = np.clip(np.ceil((z - grid.origin[2]) / grid.width), 0, grid.shape[2]).astype(np.int64)
        np.add.at(found, (i[hit], j[hit], above), np.where(up[hit], 1, -1).astype(np.int32))
    return np.cumsum(found[:, :, :-1], axis=2, dtype=np.int32)
