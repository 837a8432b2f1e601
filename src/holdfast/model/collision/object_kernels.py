"""Compiled distances between the spheres that cover an arm and a block of objects, whose parameters are inputs.

A program belongs to an arm and its spheres, so a changed cell compiles nothing. The objects of a block share the positions of
the spheres. Among the spheres of one radius on a link the nearest is found without a root: outside, the squared distance from
the object is monotonic in the distance; inside, the depth is used directly.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache, lru_cache, reduce
from itertools import groupby

import casadi as ca
import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel, SingleRowKernel, default_backend
from holdfast.kernels.linalg import Vector, select_smallest
from holdfast.kernels.program import SX
from holdfast.model.arm import kinematics
from holdfast.model.arm.machine import ArmData
from holdfast.model.cell.solids import PrimitiveSolid
from holdfast.model.collision.capsules import BASE_LINK
from holdfast.model.collision.sphere_cover import SphereCover

BLOCK_OBJECTS = 4  # objects of one call
OBJECT_PARAMETERS = 18  # of an object: see PrimitiveSolid.numbers
FAR_AWAY_M = 1e9  # m: distance of pairs that are not checked


@cached_kernel
def distance_kernel(arm: ArmData, spheres: SphereCover) -> Kernel:
    """Compile the least distance from a block of objects: 1 + L BLOCK distances, of the arm and of each link from each object.

    Inputs: q (n,) and the block (BLOCK, 18 + L): the numbers of each object, and the offset of its distance from each link.
    """
    q, objects, sphere_positions = _kernel_symbols(arm, spheres)
    columns = [_distances_by_link(spheres, sphere_positions, objects[object_index, :]) for object_index in range(BLOCK_OBJECTS)]
    by_link = [column[link_position][0] for link_position in range(len(columns[0])) for column in columns]
    return Kernel("distance from a block of objects", [q, objects], [ca.vertcat(select_smallest(by_link), *by_link)])


@cached_kernel
def link_distance_kernel(arm: ArmData, spheres: SphereCover) -> Kernel:
    """Compile the distance of the only link with spheres from an object, whose inputs (19,) are as in :func:`distance_kernel`.

    The other results are the center (3,) and the radius of the nearest sphere, and the unit vector (3,) away from the object.
    """
    q, sphere_positions = sphere_centers(arm, spheres)
    numbers = ca.SX.sym("numbers", OBJECT_PARAMETERS + 1)
    distance, center, radius = _distances_by_link(spheres, sphere_positions, numbers)[0]
    return Kernel("distance from an object", [q, numbers], [distance, *center, radius, *_outward_gradient(numbers, center)])


@cached_kernel
def nearest_gradient_kernel(arm: ArmData, spheres: SphereCover) -> Kernel:
    """Compile the least distance from a block, the position of its link, the object in the block, and the gradient (n,)."""
    q, objects, sphere_positions = _kernel_symbols(arm, spheres)
    best: Vector = []
    for object_index in range(BLOCK_OBJECTS):
        for link_position, (value, point, _) in enumerate(
            _distances_by_link(spheres, sphere_positions, objects[object_index, :])
        ):
            candidate = [value, ca.SX(link_position), ca.SX(object_index), *point]
            best = _select_vector(value < best[0], candidate, best) if best else candidate
    distance, link_position, object_index, *point = best
    numbers = ca.horzsplit(objects[0, :OBJECT_PARAMETERS])
    for other_object in range(1, BLOCK_OBJECTS):
        numbers = _select_vector(object_index == other_object, ca.horzsplit(objects[other_object, :OBJECT_PARAMETERS]), numbers)
    link = sum(ca.if_else(link_position == position, int(link), 0) for position, link in enumerate(_moving_links(spheres)))
    gradient = directional_jacobian(arm, q, link, point, _outward_gradient(ca.horzcat(*numbers), point))
    return Kernel("nearest object of a block", [q, objects], [ca.vertcat(distance, link_position, object_index, *gradient)])


def _moving_links(spheres: SphereCover) -> IndexArray:
    return np.unique(spheres.link[spheres.link > BASE_LINK])


def _kernel_symbols(arm: ArmData, spheres: SphereCover) -> tuple[SX, SX, list[Vector]]:
    """Return joint variables (n,), the block's parameters (BLOCK, 18 + L), and world positions (3,) of the moving spheres."""
    q, sphere_positions = sphere_centers(arm, spheres)
    return q, ca.SX.sym("objects", BLOCK_OBJECTS, OBJECT_PARAMETERS + len(_moving_links(spheres))), sphere_positions


def sphere_centers(arm: ArmData, spheres: SphereCover) -> tuple[SX, list[Vector]]:
    """Return joint variables (n,), and the center of each moving sphere, (3,) in the world, m."""
    q = kinematics.joint_symbols(arm)
    moving, _ = kinematics.body_and_joint_frames(arm, kinematics.joint_transforms(arm, q))
    centers = []
    for sphere in np.flatnonzero(spheres.link > BASE_LINK):
        rotation, position = moving[spheres.link[sphere] + 1]
        centers.append(ca.vertsplit(position + rotation @ kinematics.constant_matrix(spheres.center[sphere])))
    return q, centers


def directional_jacobian(arm: ArmData, q: SX, link: SX, point: Sequence[SX], direction: Sequence[SX]) -> Vector:
    """Return the speed of a point (3,) on a link along a direction (3,) per unit of each joint's speed, (n,)."""
    chain = kinematics.kinematic_chain(arm, q)
    derivatives = []
    for index, joint in enumerate(arm.joints):
        velocity = (
            chain.axes[index] if joint.prismatic else ca.cross(chain.axes[index], ca.vertcat(*point) - chain.points[index])
        )
        derivatives.append(ca.if_else(link >= index, sum(velocity[axis] * direction[axis] for axis in range(3)), 0.0))
    return derivatives


@cache
def outward_gradient_kernel() -> Kernel:
    """Compile the gradient (3,) in the world of the signed distance at a point (3,), for an object's parameters (18,)."""
    point, numbers = ca.SX.sym("point", 3), ca.SX.sym("numbers", OBJECT_PARAMETERS)
    return Kernel(
        "direction away from an object", [point, numbers], [ca.vertcat(*_outward_gradient(numbers, ca.vertsplit(point)))]
    )


def _distances_by_link(spheres: SphereCover, sphere_positions: list[Vector], numbers: SX) -> list[tuple[SX, Vector, SX]]:
    """Return for each link its smallest distance from an object, and the center (3,) and radius of the nearest sphere."""
    moving = spheres.link > BASE_LINK
    links, radii = spheres.link[moving], spheres.radius[moving]
    results = []
    for link_position, link in enumerate(_moving_links(spheres)):
        best: Vector = []
        by_radius = sorted(np.flatnonzero(links == link).tolist(), key=radii.__getitem__)
        for radius, sphere_group in groupby(by_radius, radii.__getitem__):
            nearest: Vector = []
            for sphere in sphere_group:
                candidate = [
                    _squared_distance_or_depth(_point_in_object_frame(numbers, sphere_positions[sphere])[2]),
                    *sphere_positions[sphere],
                ]
                nearest = _select_vector(candidate[0] < nearest[0], candidate, nearest) if nearest else candidate
            value, *point = nearest
            root = ca.sqrt(_positive_part(value))
            candidate = [ca.if_else(value > 0, root, value) - float(radius), *point, ca.SX(float(radius))]
            best = _select_vector(candidate[0] < best[0], candidate, best) if best else candidate
        results.append((best[0] - numbers[15] + numbers[OBJECT_PARAMETERS + link_position], best[1:4], best[4]))
    return results


def _point_in_object_frame(numbers: SX, point: Sequence[SX]) -> tuple[Vector, Vector, Vector]:
    """Return the point in the object's frame, its distance from the center along each axis, and that minus the half sizes."""
    local_point: Vector = [
        numbers[9 + axis] + sum(numbers[3 * axis + column] * point[column] for column in range(3)) for axis in range(3)
    ]
    is_round, closed = numbers[16], 1 - 2 * numbers[17]
    height_below = -closed * local_point[2]  # y[2] with its sign if the object is open
    extents = [
        ca.sqrt(local_point[0] * local_point[0] + is_round * (local_point[1] * local_point[1])),
        ca.fabs(local_point[1]),
        ca.if_else(local_point[2] > height_below, local_point[2], height_below),
    ]
    return local_point, extents, [extents[axis] - numbers[12 + axis] for axis in range(3)]


def _squared_distance_or_depth(d: Vector) -> SX:
    """Return the square of the distance outside, or the signed distance inside, of an object without rounding."""
    depth = _maximum(d)
    return ca.if_else(depth > 0, _outside_square(d), depth)


def _outside_square(d: Vector) -> SX:
    positive_parts = [_positive_part(component) for component in d]
    return sum(component * component for component in positive_parts)


def _positive_part(x: SX) -> SX:
    return ca.if_else(x > 0, x, 0.0)


def _maximum(d: Vector) -> SX:
    largest = d[0]
    for x in d[1:]:
        largest = ca.if_else(x > largest, x, largest)
    return largest


def _outward_gradient(numbers: SX, point: Sequence[SX]) -> Vector:
    """Return the gradient (3,) in the world of the signed distance, a unit vector; 0 in the middle of a sphere or an axis."""
    local_point, extents, excess = _point_in_object_frame(numbers, point)
    depth, length = _maximum(excess), ca.sqrt(_outside_square(excess))
    outside = depth > 0
    faces_taken: SX = 0.0  # inside, the first of the nearest faces
    components: Vector = []
    for component in excess:
        is_face = ca.if_else(ca.logic_and(component >= depth, faces_taken < 0.5), 1.0, 0.0)
        faces_taken = faces_taken + is_face
        components.append(ca.if_else(outside, _positive_part(component) / ca.if_else(outside, length, 1.0), is_face))
    is_round, is_open = numbers[16] > 0.5, numbers[17] > 0.5
    unit_vector = [local_point[axis] / ca.if_else(extents[axis] == 0, 1.0, extents[axis]) for axis in range(3)]
    local_gradient = [
        components[0] * unit_vector[0],
        ca.if_else(
            is_round,
            components[0] * local_point[1] / ca.if_else(extents[0] == 0, 1.0, extents[0]),
            components[1] * unit_vector[1],
        ),
        components[2] * ca.if_else(is_open, 1.0, unit_vector[2]),
    ]
    return [sum(numbers[3 * axis + column] * local_gradient[axis] for axis in range(3)) for column in range(3)]


def _select_vector(condition: SX, a: Vector, b: Vector) -> Vector:
    return [ca.if_else(condition, x, y) for x, y in zip(a, b, strict=True)]


# ---- objects --------------------------------------------------------------------------------------------------------------


@lru_cache(maxsize=64)
def _share_kernel(build: Callable[[ArmData, SphereCover], Kernel], arm: ArmData, spheres: SphereCover, _backend: str) -> Kernel:
    """Return the kernel of an arm and its spheres, one for all cells."""
    return build(arm, spheres)


@lru_cache(maxsize=256)
def _select_link(spheres: SphereCover, link: int) -> SphereCover:
    return SphereCover(*(getattr(spheres, name)[spheres.link == link] for name in ("link", "center", "radius", "part")))


class FormulaObjects:
    """Objects with a distance formula, against the spheres of an arm.

    Args:
        arm: Arm model.
        spheres: Spheres that cover the arm.
        objects: F objects.
        offsets: (L, F) offset of the distance of each moving link from each object, m.
        margins: (F,) distance to keep from each object, m; default: 0.
    """

    def __init__(
        self,
        arm: ArmData,
        spheres: SphereCover,
        objects: Sequence[PrimitiveSolid],
        offsets: FloatArray,
        margins: FloatArray | None = None,
    ) -> None:
        self.arm, self.spheres, self.objects, self._offsets = arm, spheres, list(objects), offsets
        self._margins = np.zeros(len(self.objects)) if margins is None else margins
        self._links = len(np.unique(spheres.link[spheres.link > BASE_LINK]))

    @cached_property
    def _distance_kernel(self) -> Kernel:
        return _share_kernel(distance_kernel, self.arm, self.spheres, default_backend())

    @cached_property
    def _nearest_kernel(self) -> Kernel:
        return _share_kernel(nearest_gradient_kernel, self.arm, self.spheres, default_backend())

    @cached_property
    def _link_kernels(self) -> list[tuple[Kernel, FloatArray]]:
        """Kernels :func:`link_distance_kernel` of each moving link, and the inputs (F, 19) of all objects."""
        numbers = np.array([solid.numbers() for solid in self.objects])
        covers = [_select_link(self.spheres, int(link)) for link in _moving_links(self.spheres)]
        kernels = [_share_kernel(link_distance_kernel, self.arm, cover, default_backend()) for cover in covers]
        return [(kernel, np.column_stack([numbers, offset])) for kernel, offset in zip(kernels, self._offsets, strict=True)]

    @cached_property
    def _uninflated_blocks(self) -> FloatArray:
        return self._pack_blocks(np.zeros(len(self.objects)))

    @cached_property
    def _inflated_blocks(self) -> FloatArray:
        return self._pack_blocks(self._margins)

    def _pack_blocks(self, inflation: FloatArray) -> FloatArray:
        """Pack the kernel inputs block by block, (B, BLOCK, 18 + L), with every object inflated by its entry of (F,), m."""
        # Padding to whole blocks.
        far_object = np.concatenate([np.zeros(OBJECT_PARAMETERS), np.full(self._links, FAR_AWAY_M)])
        numbers = [
            solid.numbers(solid_inflation) for solid, solid_inflation in zip(self.objects, inflation.tolist(), strict=True)
        ]
        rows = [np.concatenate(row) for row in zip(numbers, self._offsets.T, strict=True)]
        rows += [far_object] * (-len(rows) % BLOCK_OBJECTS)
        return np.array(rows).reshape(-1, BLOCK_OBJECTS, len(far_object))

    def _evaluate_blocks(
        self, kernel: Kernel, q: FloatArray, blocks: FloatArray, output_count: int | None = None
    ) -> list[FloatArray]:
        """Evaluate a kernel on each block, (N, outputs) each."""
        if len(q) == 1:  # one call, with the blocks as its rows
            return list(kernel.rows(np.repeat(q, len(blocks), axis=0), blocks, first=output_count)[:, None])
        return [kernel.rows(q, block, first=output_count) for block in blocks]

    def _smallest_distance(self, q: FloatArray, blocks: FloatArray) -> FloatArray:
        if not (self.objects and self._links):
            return np.where(np.isfinite(q).all(axis=1), np.inf, np.nan)
        return reduce(
            np.minimum, [rows[:, 0] for rows in self._evaluate_blocks(self._distance_kernel, q, blocks, output_count=1)]
        )

    def smallest_distance(self, q: FloatArray) -> FloatArray:
        """Return the least distance (N,), m; infinite without an object, NaN for rows (N, n) that are not finite."""
        return self._smallest_distance(q, self._uninflated_blocks)

    def smallest_margin(self, q: FloatArray) -> FloatArray:
        """Return the least distance beyond the margins (N,), m."""
        return self._smallest_distance(q, self._inflated_blocks)

    def link_distances(self, q: FloatArray) -> FloatArray:
        """Return a lower bound (N, L, F) of the distance of every link from every object, m."""
        distances = np.empty((len(q), self._links, len(self.objects)))
        for block, outputs in enumerate(self._evaluate_blocks(self._distance_kernel, q, self._uninflated_blocks)):
            columns = distances[:, :, BLOCK_OBJECTS * block : BLOCK_OBJECTS * (block + 1)]
            columns[...] = outputs[:, 1:].reshape(len(q), self._links, BLOCK_OBJECTS)[:, :, : columns.shape[2]]
        return distances

    def evaluate_pairs(self, q: FloatArray, links: IndexArray, objects: IndexArray, count: int) -> FloatArray:
        """Return the first results (N, count) of :func:`link_distance_kernel` for one link and object (N,) at each q (N, n)."""
        results = np.empty((len(q), count))
        for link in np.flatnonzero(np.bincount(links, minlength=self._links)):
            rows = np.flatnonzero(links == link)
            kernel, numbers = self._link_kernels[link]
            results[rows] = kernel.rows(q[rows], numbers[objects[rows]], first=count)
        return results

    def single_row_kernels(self) -> list[SingleRowKernel]:
        """Return :func:`nearest_gradient_kernel` of each block for one configuration at a time: the first n of its inputs."""
        kernels = [self._nearest_kernel.single_row() for _ in self._inflated_blocks]
        for single_kernel, block in zip(kernels, self._inflated_blocks, strict=True):
            single_kernel.inputs[self.arm.n :] = block.ravel()
        return kernels

    def nearest_margin_and_gradient(self, q: FloatArray) -> tuple[FloatArray, IndexArray, IndexArray, FloatArray]:
        """Return the least distance beyond the margins, m, the position of its link, its object, and the gradient (N, n).

        Args:
            q: (N, n) configurations, rad and m; a row that is not finite gets NaN.
        """
        rows = np.stack(self._evaluate_blocks(self._nearest_kernel, q, self._inflated_blocks))
        block = np.argmin(rows[:, :, 0], axis=0)  # NaN is in all of them or in none
        best = rows[block, np.arange(len(q))]
        link, object_index = np.nan_to_num(best[:, 1]).astype(np.int64), np.nan_to_num(best[:, 2]).astype(np.int64)
        # If all pairs may touch, the first object may be padding.
        return best[:, 0], link, np.minimum(block * BLOCK_OBJECTS + object_index, len(self.objects) - 1), best[:, 3:]
