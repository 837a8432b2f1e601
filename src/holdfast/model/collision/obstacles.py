"""Lower bound of the distance between an arm and the objects of a cell, compiled once for the arm: objects are inputs.

Spheres cover the arm (:mod:`holdfast.model.collision.sphere_cover`), so a configuration that is found collision-free is
collision-free. Objects are processed in blocks, which share the positions of the spheres; a changed cell compiles nothing.
Meshes and point clouds are looked up in their grids (:mod:`holdfast.model.collision.objects.gridded`).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kernels.kernel import SingleRowKernel
from holdfast.model.arm.model import Arm
from holdfast.model.cell.cell import Cell
from holdfast.model.cell.meshes import GriddedSolid
from holdfast.model.cell.solids import PrimitiveSolid, Solid
from holdfast.model.collision.capsules import BASE_LINK, Capsules, link_name
from holdfast.model.collision.changes import link_lipschitz_bounds
from holdfast.model.collision.object_kernels import FAR_AWAY_M, FormulaObjects, outward_gradient_kernel
from holdfast.model.collision.objects.end_links import EndLinks
from holdfast.model.collision.objects.gridded import GriddedObjects
from holdfast.model.collision.sphere_cover import SphereCover, make_sphere_cover


@dataclass(frozen=True, kw_only=True, eq=False)
class NearestGap:
    """Smallest margin between an arm and an object.

    Attributes:
        pair: Position in ``pairs`` of the obstacles.
        distance: Distance of the cover of the arm, m: at most the true one.
        margin: Distance minus the required distance, m.
        on_arm, on_object: (3,) the two closest points in the world, m; the first is on the sphere that covers the link there.
    """

    pair: int
    distance: float
    margin: float
    on_arm: FloatArray
    on_object: FloatArray


class Obstacles:
    """Objects of a cell, against the spheres of an arm.

    Args:
        arm: Arm model.
        capsules: Capsules that cover its links.
        cell: Cell with the objects.

    Attributes:
        arm, capsules, cell: Arguments of the constructor.
        spheres: Spheres that cover the capsules.
        links: (L,) moving links with spheres, ascending.
        pairs: (L K, 2) link and object of each pair: all objects of the first link, then of the next.
        margins: (L K,) required distance of each pair, m.
        names: Names of the pairs, ``panda_joint4 & table``.
        may_touch: (n + 1, K) True if a link, the base first, and an object may touch.

    Raises:
        InputError: The base touches an object, or ``may_touch`` names no object or link.
    """

    def __init__(self, arm: Arm, capsules: Capsules, cell: Cell) -> None:
        self.arm, self.capsules, self.cell = arm, capsules, cell
        self.spheres: SphereCover = make_sphere_cover(capsules)
        self.links: IndexArray = np.unique(self.spheres.link[self.spheres.link > BASE_LINK])
        count = len(cell)
        self.pairs: IndexArray = np.stack(
            [np.repeat(self.links, count), np.tile(np.arange(count, dtype=np.int64), len(self.links))], axis=1
        )
        self._own_margins: FloatArray = np.array([cell.margin_of(solid) for solid in cell])
        self.margins: FloatArray = np.tile(self._own_margins, len(self.links))
        names = [solid.name for solid in cell]
        self.names = [f"{link_name(arm, int(link))} & {names[index]}" for link, index in self.pairs]
        self._formula_indices: IndexArray = np.array(
            [index for index, solid_object in enumerate(cell) if isinstance(solid_object, PrimitiveSolid)], dtype=np.int64
        )
        self._grid_indices: IndexArray = np.array(
            [index for index, solid_object in enumerate(cell) if isinstance(solid_object, GriddedSolid)], dtype=np.int64
        )
        unsupported = next(
            (solid_object for solid_object in cell if not isinstance(solid_object, (PrimitiveSolid, GriddedSolid))), None
        )
        if unsupported is not None:
            raise InputError(
                f"object '{unsupported.name}' is a {type(unsupported).__name__}, which has no distance formula; "
                f"make it one of the solids of holdfast.model.cell"
            )
        self.may_touch = self._allowed_contacts()
        self._check_base_contacts()

    # ---- checked pairs -------------------------------------------------------------------------------------------

    def _allowed_contacts(self) -> BoolArray:
        """Return (n + 1, K) True for pairs of a link, the base first, and an object that may touch."""
        names = [solid.name for solid in self.cell]
        links = ["base", *self.arm.joint_names]
        allowed = np.zeros((len(links), len(names)), dtype=np.bool_)
        for object_name, link in self.cell.may_touch:
            if object_name not in names:
                raise InputError(f"may_touch: cell '{self.cell.name}' has no object '{object_name}'; it has {', '.join(names)}")
            if link not in links:
                raise InputError(f"may_touch: '{self.arm.name}' has no link '{link}'; its links are {', '.join(links)}")
            allowed[links.index(link), names.index(object_name)] = True
        return allowed

    def _check_base_contacts(self) -> None:
        """Check the contacts of the base, which does not move, so that any contact is permanent.

        Raises:
            InputError: The base touches an object that it may not touch.
        """
        from holdfast.model.collision.exact.bodies import bounding_primitive  # slow to import

        for index, solid in enumerate(self.cell):
            margin = self.cell.margin_of(solid)
            # A box around it is checked first, so that a distant object needs no grid.
            if self.may_touch[0, index] or base_distances(self.arm, self.spheres, [bounding_primitive(solid)])[0] >= margin:
                continue
            (gap,) = base_distances(self.arm, self.spheres, [solid])
            if gap < margin:
                place_phrase = f"{-gap:.3g} m inside" if gap < 0 else f"{gap:.3g} m and so nearer than the margin to"
                raise InputError(
                    f"the base of '{self.arm.name}' is {place_phrase} object '{solid.name}' of the cell, always; "
                    f"if it is mounted there, add may_touch: [[{solid.name}, base]]"
                )

    def distance_offsets(self, links: IndexArray, objects: IndexArray) -> FloatArray:
        """Return (L, F) offsets of the distances of links from objects, m; pairs that may touch are moved far away."""
        return np.where(self.may_touch[np.ix_(links + 1, objects)], FAR_AWAY_M, 0.0)

    @cached_property
    def _formula_objects(self) -> FormulaObjects:
        objects = [solid for solid in self.cell if isinstance(solid, PrimitiveSolid)]
        return FormulaObjects(
            self.arm,
            self.spheres,
            objects,
            self.distance_offsets(self.links, self._formula_indices),
            self._own_margins[self._formula_indices],
        )

    @cached_property
    def _gridded_objects(self) -> GriddedObjects | None:
        objects = [solid for solid in self.cell if isinstance(solid, GriddedSolid)]
        return (
            GriddedObjects(self.arm, self.spheres, objects, self.distance_offsets(self.links, self._grid_indices))
            if objects and len(self.links)
            else None
        )

    @cached_property
    def _end_links(self) -> EndLinks:
        offsets = self.distance_offsets(np.arange(self.arm.n), self._formula_indices)
        return EndLinks(
            self.arm, self.spheres, self._formula_objects.objects, offsets, self._own_margins[self._formula_indices]
        )

    @property
    def has_only_formulas(self) -> bool:
        """True if every object has a distance formula, and none a grid."""
        return len(self._formula_indices) == len(self.cell)

    # ---- evaluation ----------------------------------------------------------------------------------------------

    def nearest_margin_and_gradient(self, q: FloatArray) -> tuple[FloatArray, IndexArray, FloatArray]:
        """Return the smallest distance (N,) beyond the margin of its pair, m, the pair, and the gradient (N, n).

        Args:
            q: (N, n) configurations, rad and m; a row that is not finite gets NaN and pair -1.
        """
        count = len(self.cell)
        margin, pair, gradient = np.full(len(q), np.inf), np.full(len(q), np.nan), np.zeros((len(q), self.arm.n))
        if len(self._formula_indices) and len(self.links):
            margin, link, object_index, gradient = self._formula_objects.nearest_margin_and_gradient(q)
            pair = np.where(np.isnan(margin), np.nan, link * count + self._formula_indices[object_index])
        if self._gridded_objects is not None:
            grid_margin, link, object_index, grid_gradient = self._gridded_objects.nearest_margin_and_gradient(
                q, self._own_margins[self._grid_indices]
            )
            closer = ~(margin <= grid_margin)
            margin, gradient = np.where(closer, grid_margin, margin), np.where(closer[:, None], grid_gradient, gradient)
            pair = np.where(
                closer, np.where(np.isnan(grid_margin), np.nan, link * count + self._grid_indices[object_index]), pair
            )
        return margin, np.where(np.isnan(pair), -1, pair).astype(np.int64), gradient

    def single_row_kernels(self) -> list[SingleRowKernel]:
        """Return the kernels for one configuration at a time, by block of objects; none with objects that have grids."""
        formulas = len(self._formula_indices) and len(self.links) and self._gridded_objects is None
        return self._formula_objects.single_row_kernels() if formulas else []

    def smallest_margin(self, q: FloatArray) -> FloatArray:
        """Return the least distance beyond the margin of its pair, (N,) m."""
        margin = self._formula_objects.smallest_margin(q)
        if self._gridded_objects is not None:
            margin = np.minimum(margin, self._gridded_objects.smallest_margin(q, self._own_margins[self._grid_indices]))
        return margin

    def smallest_distance(self, q: FloatArray) -> FloatArray:
        """Return the least distance (N,), m."""
        smallest = self._formula_objects.smallest_distance(q)
        return (
            smallest
            if self._gridded_objects is None
            else np.minimum(smallest, self._gridded_objects.smallest_margin(q, np.zeros(len(self._grid_indices))))
        )

    def pair_distances(self, q: FloatArray) -> FloatArray:
        """Return a lower bound (N, L K) of the distance of every pair, m; about 1e9 m if a pair may touch."""
        if self.has_only_formulas and len(self.links):
            return self._formula_objects.link_distances(q).reshape(len(q), len(self.pairs))
        distances = np.empty((len(q), len(self.links), len(self.cell)))
        if len(self._formula_indices) and len(self.links):
            distances[:, :, self._formula_indices] = self._formula_objects.link_distances(q)
        if self._gridded_objects is not None:
            distances[:, :, self._grid_indices] = self._gridded_objects.link_distances(q)
        return distances.reshape(len(q), len(self.pairs))

    def distances_of_pairs(self, q: FloatArray, pairs: IndexArray) -> FloatArray:
        """Return the entry (N,) of :meth:`pair_distances` for one pair (N,) at each configuration (N, n)."""
        if self.has_only_formulas:
            return self._formula_objects.evaluate_pairs(q, *np.divmod(pairs, len(self.cell)), 1)[:, 0]
        return self.pair_distances(q)[np.arange(len(q)), pairs]

    def find_contact_points(self, q: FloatArray, pairs: IndexArray) -> tuple[FloatArray, FloatArray]:
        """Return the closest points of links and the unit vectors away from objects (N, 3), of one pair (N,) at each q."""
        if self.has_only_formulas:
            results = self._formula_objects.evaluate_pairs(q, *np.divmod(pairs, len(self.cell)), 8)
            return results[:, 1:4] - results[:, 4:5] * results[:, 5:], results[:, 5:]
        (points, outward), frames = np.empty((2, len(q), 3)), self.arm.frames(q)
        for pair in np.unique(pairs):
            rows = np.flatnonzero(pairs == pair)
            link_poses = frames[rows, self.pairs[pair, 0] + 1]
            points[rows], _, outward[rows] = self.find_closest_points(int(pair), link_poses)
        return points, outward

    def are_poses_always_colliding(self, poses: FloatArray, margin: float) -> BoolArray:
        """Return (N,) True where every configuration that meets a tool pose (N, 4, 4) to 1e-6 violates ``margin``, m.

        The margin is added to that of each object.

        The proof uses the positions that the last two links can have, for objects with a formula; False is no proof.
        """
        return self._end_links.are_poses_too_close(poses, margin)

    def find_nearest_gap(self, q: FloatArray) -> NearestGap:
        """Return the pair with the smallest margin at one configuration (n,)."""
        margin, pair, _ = (value[0] for value in self.nearest_margin_and_gradient(q[None]))
        on_arm, on_object, _ = self.find_closest_points(int(pair), self.arm.frames(q)[None, self.pairs[pair, 0] + 1])
        return NearestGap(
            pair=int(pair),
            distance=float(margin + self.margins[pair]),
            margin=float(margin),
            on_arm=on_arm[0],
            on_object=on_object[0],
        )

    def find_closest_points(self, pair: int, link_poses: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the closest points of a link and an object, and the unit vector away from the object, (N, 3) each, m.

        Args:
            pair: Position in ``pairs``.
            link_poses: (N, 4, 4) poses of the frame that moves with the link.
        """
        link, object_index = self.pairs[pair]
        solid, on_link, rows = self.cell.objects[object_index], self.spheres.link == link, np.arange(len(link_poses))
        centers = self.spheres.center[on_link] @ link_poses[:, :3, :3].swapaxes(1, 2) + link_poses[:, None, :3, 3]
        distances = solid.signed_distance(centers)
        nearest_sphere = (distances - self.spheres.radius[on_link]).argmin(axis=1)
        center, distance = centers[rows, nearest_sphere], distances[rows, nearest_sphere]
        if isinstance(solid, PrimitiveSolid):
            gradient = outward_gradient_kernel().rows(center, solid.numbers())
        else:
            gradient = solid.distance_and_gradient(center)[1]
        outward = gradient / np.maximum(np.linalg.norm(gradient, axis=1, keepdims=True), 1e-300)
        on_arm = center - self.spheres.radius[on_link][nearest_sphere, None] * outward
        return on_arm, center - distance[:, None] * outward, outward

    def lipschitz_bounds(self, low: FloatArray, high: FloatArray) -> FloatArray:
        """Bound the change of the distance of each pair per rad and m of each joint in a box, (L K, n).

        Args:
            low: (n,) lower corner of the box, finite, rad and m.
            high: (n,) upper corner of the box, finite, rad and m.
        """
        center_distances = np.linalg.norm(self.spheres.center, axis=1)
        max_distances = np.array([center_distances[self.spheres.link == link].max() for link in self.links])
        return np.repeat(link_lipschitz_bounds(self.arm, self.links, max_distances, low, high), len(self.cell), axis=0)


def base_distances(arm: Arm, spheres: SphereCover, objects: Iterable[Solid]) -> list[float]:
    """Return a lower bound of the distance of the base from each object, m; infinite if no sphere covers the base."""
    on_base = spheres.link == BASE_LINK
    center = spheres.center[on_base] @ arm.base[:3, :3].T + arm.base[:3, 3]
    return [float((solid.signed_distance(center) - spheres.radius[on_base]).min(initial=np.inf)) for solid in objects]
