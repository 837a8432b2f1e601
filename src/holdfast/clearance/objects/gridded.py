"""Distances between the spheres that cover an arm and objects whose distance is a grid of numbers: meshes and clouds of points.

The positions of the spheres are compiled for the arm; what they read in the grids is NumPy's.
"""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.machine import Machine
from holdfast.caching import cached_property
from holdfast.cell.meshes import Gridded
from holdfast.clearance.capsules import BASE
from holdfast.clearance.chains import Balls
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.recall import recalled

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_AT_ONCE = 1 << 11  # configurations


@recalled
def centre_kernel(arm: Machine, balls: Balls) -> Kernel:
    """Where each moving sphere is in the world, (3 S,), m, of q (n,)."""
    q = kinematics.joint_symbols(arm)
    moving, _ = kinematics.frames(arm, kinematics.joint_steps(arm, q))
    where = []
    for s in np.flatnonzero(balls.link > BASE):
        rotation, position = moving[balls.link[s] + 1]
        where.append(position + rotation @ kinematics.constant(balls.centre[s]))
    return Kernel("spheres of an arm", [q], [ca.vertcat(*where)])


@recalled
def slope_kernel(arm: Machine) -> Kernel:
    """How fast a point on a link goes along a direction, (n,) per unit of each joint's speed.

    Inputs: q (n,), and in one vector (7,) the point and the direction in the world and the joint that moves the link.
    """
    q, told = kinematics.joint_symbols(arm), ca.SX.sym("told", 7)
    point, push, link = told[:3], told[3:6], told[6]
    c = kinematics.chain(arm, q)
    slopes = []
    for j, joint in enumerate(arm.joints):
        way = c.axes[j] if joint.prismatic else ca.cross(c.axes[j], point - c.points[j])
        slopes.append(ca.if_else(link >= j, ca.dot(way, push), 0.0))
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
        self._links, self._radius = balls.link[moving], balls.radius[moving]
        _, self._first, self._at = np.unique(self._links, return_index=True, return_inverse=True)
        self._added: Array = added[self._at]

    @cached_property
    def _centre_kernel(self) -> Kernel:
        return centre_kernel(self.arm, self.balls)

    @cached_property
    def _slope_kernel(self) -> Kernel:
        return slope_kernel(self.arm)

    def _by_sphere(self, centres: Array) -> Array:
        """(N, S, G) distances of spheres whose centres (N, S, 3) are in the world, m."""
        found = [solid.signed_distance(centres) for solid in self.objects]
        return np.stack(found, axis=2) - self._radius[:, None] + self._added

    def _centres(self, q: Array) -> Array:
        return self._centre_kernel.rows(q).reshape(len(q), -1, 3)

    def distances(self, q: Array) -> Array:
        """(N, L, G) lower bound of the distance of every link from every object, m.

        Args:
            q: (N, n) rad and m; a row that is not finite gets NaN.
        """
        found = [
            np.minimum.reduceat(self._by_sphere(self._centres(q[k : k + _AT_ONCE])), self._first, axis=1)
            for k in range(0, len(q), _AT_ONCE)
        ]
        return np.concatenate([np.empty((0, len(self._first), len(self.objects))), *found])

    def nearest(self, q: Array, margins: Array) -> tuple[Array, Indices, Indices, Array]:
        """Least distance beyond the margins (G,), m; position of its link, its object, and the gradient (N, n).

        Args:
            q: (N, n) rad and m; a row that is not finite gets NaN.
            margins: (G,) m.
        """
        rooms, sphere, thing, told = (
            np.empty(len(q)),
            np.empty(len(q), np.int64),
            np.empty(len(q), np.int64),
            np.empty((len(q), 7)),
        )
        for start in range(0, len(q), _AT_ONCE):
            part = slice(start, start + _AT_ONCE)
            centres = self._centres(q[part])
            beyond = self._by_sphere(centres) - margins
            flat = beyond.reshape(len(beyond), -1)
            best, rows = flat.argmin(axis=1), np.arange(len(flat))
            rooms[part] = flat[rows, best]
            sphere[part], thing[part] = np.divmod(best, len(self.objects))
            told[part, :3] = centres[rows, sphere[part]]
        told[:, 6] = self._links[sphere]
        for number, solid in enumerate(self.objects):
            mine = thing == number
            told[mine, 3:6] = solid.distance_and_gradient(told[mine, :3])[1]
        return rooms, self._at[sphere], thing, self._slope_kernel.rows(q, told)
