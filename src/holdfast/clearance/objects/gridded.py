"""Distances between the spheres that cover an arm and objects whose distance is a grid of numbers: meshes and clouds of points.

The positions of the spheres are compiled for the arm; what they read in the grids is NumPy's.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.machine import Machine
from holdfast.caching import cached_property
from holdfast.cell.interpolation import Tables, bounds
from holdfast.cell.meshes import Gridded
from holdfast.clearance.capsules import BASE
from holdfast.clearance.chains import Balls
from holdfast.clearance.object_kernels import slopes_of, sphere_centres
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.recall import recalled

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Flags = NDArray[np.bool_]

_AT_ONCE = 1 << 9  # configurations
_FEW = 8  # configurations: of fewer everything is looked at
_ROUNDING = 1e-6  # m: more than the distance of middles may be wrong by


@recalled
def centre_kernel(arm: Machine, balls: Balls) -> Kernel:
    """Where each moving sphere is in the world, (3 S,), m, of q (n,)."""
    q, where = sphere_centres(arm, balls)
    return Kernel("spheres of an arm", [q], [ca.vertcat(*(x for centre in where for x in centre))])


@recalled
def slope_kernel(arm: Machine) -> Kernel:
    """How fast a point on a link goes along a direction, (n,) per unit of each joint's speed.

    Inputs: q (n,), and in one vector (7,) the point and the direction in the world and the joint that moves the link.
    """
    q, told = kinematics.joint_symbols(arm), ca.SX.sym("told", 7)
    slopes = slopes_of(arm, q, told[6], ca.vertsplit(told[:3]), ca.vertsplit(told[3:6]))
    return Kernel("speed of a point along a direction", [q, told], [ca.vertcat(*slopes)])


class GriddedObjects:
    """Objects with a grid, as an arm meets them.

    Args:
        arm: The arm.
        balls: The spheres that cover it.
        objects: G of them.
        added: (L, G) added to the distance of each moving link from each, m.
    """

    def __init__(self, arm: Machine, balls: Balls, objects: Sequence[Gridded], added: Array) -> None:
        self.arm, self.balls, self.objects = arm, balls, list(objects)
        moving = balls.link > BASE
        self._links, radius = balls.link[moving], balls.radius[moving]
        _, self._first, self._at = np.unique(self._links, return_index=True, return_inverse=True)
        self._own_beside: Array = added[self._at] - radius[:, None]

    @cached_property
    def _centre_kernel(self) -> Kernel:
        return centre_kernel(self.arm, self.balls)

    @cached_property
    def _slope_kernel(self) -> Kernel:
        return slope_kernel(self.arm)

    @cached_property
    def _beside(self) -> Array:
        """(S, G) what is added to that which is read at the centre of a sphere, m."""
        return self._own_beside - [solid.field.less for solid in self.objects]

    @cached_property
    def _tables(self) -> list[Tables]:
        return [solid.field.tables for solid in self.objects]

    @cached_property
    def _around(self) -> tuple[Array, Array]:
        """Middles (3, G) in the world and radii (G,), m, of balls that have all of each object."""
        middles = [solid.pose[:3, :3] @ solid.field.middle + solid.pose[:3, 3] for solid in self.objects]
        return np.stack(middles, axis=1), np.array([solid.field.reach for solid in self.objects])

    def _parts(self, q: Array) -> Iterator[tuple[slice, Array]]:
        """Rows, some at a time, and the centres (N, S, 3) of the spheres there."""
        for start in range(0, len(q), _AT_ONCE):
            part = slice(start, start + _AT_ONCE)
            yield part, self._centre_kernel.rows(q[part]).reshape(len(q[part]), -1, 3)

    def _beyond(self, centres: Array, beside: Array, starts: Sequence[int], together: bool) -> Array:
        """(N, S, G) distances; infinite where it is known, from the balls around objects, that another one is not larger.

        Args:
            centres: (N, S, 3) of spheres, m.
            beside: (S, G) added to what is read at them, m.
            starts: First spheres of the groups in which the least distance is sought.
            together: Whether it is sought among all objects, not of each.
        """
        found = np.full((len(centres), *beside.shape), np.inf)
        if len(centres) < _FEW:
            self._read(centres, beside, np.ones(found.shape, dtype=np.bool_), found)
            return found
        middle, radius = self._around
        square = (centres * centres).sum(axis=2)[:, :, None] + (middle * middle).sum(axis=0) - 2 * (centres @ middle)
        least = np.sqrt(np.maximum(square, 0.0)) - radius + (beside - _ROUNDING)
        looked = np.zeros(least.shape, dtype=np.bool_)
        for start, stop in pairwise([*starts, centres.shape[1]]):  # first at the sphere that may be the nearest
            np.put_along_axis(looked, start + least[:, start:stop].argmin(axis=1, keepdims=True), True, axis=1)
        self._read(centres, beside, looked, found)
        enough = np.minimum.reduceat(found, starts, axis=1)
        if together:
            enough = enough.min(axis=2, keepdims=True)
        group = np.repeat(np.arange(len(starts)), np.diff([*starts, centres.shape[1]]))
        self._read(centres, beside, (least < enough[:, group]) & ~looked, found)
        return found

    def _read(self, centres: Array, beside: Array, which: Flags, found: Array) -> None:
        places = [np.nonzero(which[:, :, k]) for k in range(len(self.objects))]
        own = [solid.own(centres[place]) for solid, place in zip(self.objects, places, strict=True)]
        counts = [len(rows) for rows in own]
        value = bounds(np.concatenate(own), self._tables, counts)[:, 0]
        ends = np.cumsum(counts)
        for k, (row, sphere) in enumerate(places):
            found[row, sphere, k] = value[ends[k] - counts[k] : ends[k]] + beside[sphere, k]

    def distances(self, q: Array) -> Array:
        """(N, L, G) lower bound of the distance of every link from every object, m.

        Args:
            q: (N, n) rad and m; a row that is not finite gets NaN.
        """
        out = np.empty((len(q), len(self._first), len(self.objects)))
        for part, centres in self._parts(q):
            beyond = self._beyond(centres, self._beside, self._first.tolist(), together=False)
            out[part] = np.minimum.reduceat(beyond, self._first, axis=1)
        return out

    def least(self, q: Array, margins: Array) -> Array:
        """(N,) least distance beyond the margins (G,), m."""
        out = np.empty(len(q))
        for part, centres in self._parts(q):
            out[part] = self._beyond(centres, self._beside - margins, [0], together=True).min(axis=(1, 2))
        return out

    def nearest(self, q: Array, margins: Array) -> tuple[Array, Indices, Indices, Array]:
        """Least distance beyond the margins (G,), m; position of its link, its object, and the gradient (N, n).

        Args:
            q: (N, n) rad and m; a row that is not finite gets NaN.
            margins: (G,) m.
        """
        rooms, told = np.empty(len(q)), np.empty((len(q), 7))
        sphere, thing = np.empty(len(q), np.int64), np.empty(len(q), np.int64)
        for part, centres in self._parts(q):
            flat = self._beyond(centres, self._beside - margins, [0], together=True).reshape(len(centres), -1)
            best, rows = flat.argmin(axis=1), np.arange(len(flat))
            rooms[part] = flat[rows, best]
            sphere[part], thing[part] = np.divmod(best, len(self.objects))
            told[part, :3] = centres[rows, sphere[part]]
        told[:, 6] = self._links[sphere]
        for number, solid in enumerate(self.objects):
            mine = thing == number
            told[mine, 3:6] = solid.distance_and_gradient(told[mine, :3])[1]
        return rooms, self._at[sphere], thing, self._slope_kernel.rows(q, told)
