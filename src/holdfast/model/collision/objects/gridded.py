"""Distances between the spheres that cover an arm and objects with a distance grid: meshes and point clouds.

The positions of the spheres are compiled for the arm; NumPy reads the grids.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import casadi as ca
import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.model.arm import kinematics
from holdfast.model.arm.machine import ArmData
from holdfast.model.cell.interpolation import FieldTables, interpolate_bounds
from holdfast.model.cell.meshes import GriddedSolid
from holdfast.model.collision.capsules import BASE_LINK
from holdfast.model.collision.object_kernels import directional_jacobian, sphere_centers
from holdfast.model.collision.sphere_cover import SphereCover

_BATCH_CONFIGURATIONS = 1 << 9  # configurations
_FULL_CHECK_BELOW = 8  # configurations: for fewer, everything is checked
_ROUNDING_M = 1e-6  # m: larger than the rounding error of the distance of centres


@cached_kernel
def center_kernel(arm: ArmData, spheres: SphereCover) -> Kernel:
    """Compile the position of each moving sphere in the world, (3 S,), m, for q (n,)."""
    q, centers = sphere_centers(arm, spheres)
    return Kernel("spheres of an arm", [q], [ca.vertcat(*(coordinate for center in centers for coordinate in center))])


@cached_kernel
def point_speed_kernel(arm: ArmData) -> Kernel:
    """Compile the speed of a point on a link along a direction, (n,) per unit of each joint's speed.

    Inputs: q (n,), and in one vector (7,) the point and the direction in the world and the joint that moves the link.
    """
    q, point_data = kinematics.joint_symbols(arm), ca.SX.sym("told", 7)
    gradient = directional_jacobian(arm, q, point_data[6], ca.vertsplit(point_data[:3]), ca.vertsplit(point_data[3:6]))
    return Kernel("speed of a point along a direction", [q, point_data], [ca.vertcat(*gradient)])


class GriddedObjects:
    """Objects with a distance grid, against the spheres of an arm.

    Args:
        arm: Arm model.
        spheres: Spheres that cover the arm.
        objects: G objects.
        offsets: (L, G) offset of the distance of each moving link from each object, m.
    """

    def __init__(self, arm: ArmData, spheres: SphereCover, objects: Sequence[GriddedSolid], offsets: FloatArray) -> None:
        self.arm, self.spheres, self.objects = arm, spheres, list(objects)
        moving = spheres.link > BASE_LINK
        self._links, radius = spheres.link[moving], spheres.radius[moving]
        _, self._first_spheres, self._link_positions = np.unique(self._links, return_index=True, return_inverse=True)
        self._own_offsets: FloatArray = offsets[self._link_positions] - radius[:, None]

    @cached_property
    def _center_kernel(self) -> Kernel:
        return center_kernel(self.arm, self.spheres)

    @cached_property
    def _gradient_kernel(self) -> Kernel:
        return point_speed_kernel(self.arm)

    @cached_property
    def _distance_offsets(self) -> FloatArray:
        """Offsets (S, G) from the grid value at the center of a sphere to the distance, m."""
        return self._own_offsets - [solid.field.offset for solid in self.objects]

    @cached_property
    def _distance_tables(self) -> list[FieldTables]:
        return [solid.field.tables for solid in self.objects]

    @cached_property
    def _bounding_spheres(self) -> tuple[FloatArray, FloatArray]:
        """Centers (3, G) in the world and radii (G,), m, of balls that contain each object."""
        centers = [solid.pose[:3, :3] @ solid.field.center + solid.pose[:3, 3] for solid in self.objects]
        return np.stack(centers, axis=1), np.array([solid.field.enclosing_radius for solid in self.objects])

    def _iterate_batches(self, q: FloatArray) -> Iterator[tuple[slice, FloatArray]]:
        """Yield batches of rows, and the centers (N, S, 3) of the spheres there."""
        for start in range(0, len(q), _BATCH_CONFIGURATIONS):
            batch = slice(start, start + _BATCH_CONFIGURATIONS)
            yield batch, self._center_kernel.rows(q[batch]).reshape(len(q[batch]), -1, 3)

    def _sphere_distances(self, centers: FloatArray, offsets: FloatArray, starts: Sequence[int], together: bool) -> FloatArray:
        """Return distances (N, S, G); infinite where the balls around objects show that another distance is not larger.

        Args:
            centers: (N, S, 3) centres of spheres, m.
            offsets: (S, G) offsets of the grid values at these centres, m.
            starts: First spheres of the groups in which the least distance is searched.
            together: True if it is searched among all objects, not for each object.
        """
        distances = np.full((len(centers), *offsets.shape), np.inf)
        if len(centers) < _FULL_CHECK_BELOW:
            self._fill_selected_distances(centers, offsets, np.ones(distances.shape, dtype=np.bool_), distances)
            return distances
        object_centers, radius = self._bounding_spheres
        square = (
            (centers * centers).sum(axis=2)[:, :, None]
            + (object_centers * object_centers).sum(axis=0)
            - 2 * (centers @ object_centers)
        )
        lower_bounds = np.sqrt(np.maximum(square, 0.0)) - radius + (offsets - _ROUNDING_M)
        evaluated = np.zeros(lower_bounds.shape, dtype=np.bool_)
        for start, stop in pairwise([*starts, centers.shape[1]]):  # first at the sphere that may be the nearest
            np.put_along_axis(evaluated, start + lower_bounds[:, start:stop].argmin(axis=1, keepdims=True), True, axis=1)
        self._fill_selected_distances(centers, offsets, evaluated, distances)
        known_distances = np.minimum.reduceat(distances, starts, axis=1)
        if together:
            known_distances = known_distances.min(axis=2, keepdims=True)
        group = np.repeat(np.arange(len(starts)), np.diff([*starts, centers.shape[1]]))
        self._fill_selected_distances(centers, offsets, (lower_bounds < known_distances[:, group]) & ~evaluated, distances)
        return distances

    def _fill_selected_distances(
        self, centers: FloatArray, offsets: FloatArray, selected: BoolArray, distances: FloatArray
    ) -> None:
        places = [np.nonzero(selected[:, :, index]) for index in range(len(self.objects))]
        local_points = [solid.to_object_frame(centers[place]) for solid, place in zip(self.objects, places, strict=True)]
        counts = [len(rows) for rows in local_points]
        value = interpolate_bounds(np.concatenate(local_points), self._distance_tables, counts)[:, 0]
        ends = np.cumsum(counts)
        for index, (row, sphere) in enumerate(places):
            distances[row, sphere, index] = value[ends[index] - counts[index] : ends[index]] + offsets[sphere, index]

    def link_distances(self, q: FloatArray) -> FloatArray:
        """Return a lower bound (N, L, G) of the distance of every link from every object, m.

        Args:
            q: (N, n) configurations, rad and m; a row that is not finite gets NaN.
        """
        distances = np.empty((len(q), len(self._first_spheres), len(self.objects)))
        for batch, centers in self._iterate_batches(q):
            sphere_values = self._sphere_distances(
                centers, self._distance_offsets, self._first_spheres.tolist(), together=False
            )
            distances[batch] = np.minimum.reduceat(sphere_values, self._first_spheres, axis=1)
        return distances

    def smallest_margin(self, q: FloatArray, margins: FloatArray) -> FloatArray:
        """Return the least distance beyond the margins (G,), (N,) m."""
        margins_left = np.empty(len(q))
        for batch, centers in self._iterate_batches(q):
            margins_left[batch] = self._sphere_distances(centers, self._distance_offsets - margins, [0], together=True).min(
                axis=(1, 2)
            )
        return margins_left

    def nearest_margin_and_gradient(
        self, q: FloatArray, margins: FloatArray
    ) -> tuple[FloatArray, IndexArray, IndexArray, FloatArray]:
        """Return the least distance beyond the margins (G,), m, the position of its link, its object, and the gradient (N, n).

        Args:
            q: (N, n) configurations, rad and m; a row that is not finite gets NaN.
            margins: (G,) distance to keep from each object, m.
        """
        margins_left, point_data = np.empty(len(q)), np.empty((len(q), 7))
        sphere, object_index = np.empty(len(q), np.int64), np.empty(len(q), np.int64)
        for batch, centers in self._iterate_batches(q):
            flat_distances = self._sphere_distances(centers, self._distance_offsets - margins, [0], together=True).reshape(
                len(centers), -1
            )
            best_index, rows = flat_distances.argmin(axis=1), np.arange(len(flat_distances))
            margins_left[batch] = flat_distances[rows, best_index]
            sphere[batch], object_index[batch] = np.divmod(best_index, len(self.objects))
            point_data[batch, :3] = centers[rows, sphere[batch]]
        point_data[:, 6] = self._links[sphere]
        for number, solid in enumerate(self.objects):
            is_nearest = object_index == number
            point_data[is_nearest, 3:6] = solid.distance_and_gradient(point_data[is_nearest, :3])[1]
        return margins_left, self._link_positions[sphere], object_index, self._gradient_kernel.rows(q, point_data)
