"""A lower bound of the distance between an arm and the objects of a cell, compiled once for the arm: objects are inputs.

The arm is covered by spheres (:mod:`holdfast.clearance.chains`), so what is said to be clear is clear. Objects are taken in
blocks, which share the positions of the spheres; a cell that changed compiles nothing. Meshes and clouds of points are looked
up in their grids (:mod:`holdfast.clearance.objects.gridded`).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.caching import cached_property
from holdfast.cell.cell import Cell
from holdfast.cell.meshes import Gridded
from holdfast.cell.solids import Primitive, Solid
from holdfast.clearance.capsules import BASE, Capsules, link_name
from holdfast.clearance.chains import Balls, spheres_of
from holdfast.clearance.changes import changes_from_outside
from holdfast.clearance.object_kernels import NOWHERE, FormulaObjects, outward_kernel
from holdfast.clearance.objects.end_links import EndLinks
from holdfast.clearance.objects.gridded import GriddedObjects
from holdfast.errors import InputError
from holdfast.kernels.kernel import Single

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Gap:
    """Where an arm comes nearest to an object.

    Attributes:
        pair: Position in ``pairs`` of the obstacles.
        distance: m, of the cover of the arm: at most the true one.
        room: m, the distance less what must be kept.
        on_arm, on_object: (3,) the two points in the world, m; the first on the sphere that covers the link there.
    """

    pair: int
    distance: float
    room: float
    on_arm: Array
    on_object: Array


class Obstacles:
    """The objects of a cell as an arm meets them.

    Args:
        arm: The arm.
        capsules: What covers its links.
        cell: The objects.

    Attributes:
        arm, capsules, cell: As given.
        balls: The spheres that cover the capsules.
        links: (L,) the links that have spheres and move, ascending.
        pairs: (L K, 2) link and object of each pair: all objects of the first link, then of the next.
        margins: (L K,) what each pair keeps at least, m.
        names: Of the pairs, ``panda_joint4 & table``.
        apart: (n + 1, K) whether a link, the base first, and an object may touch.

    Raises:
        InputError: The base touches an object, or ``may_touch`` names no object or link.
    """

    def __init__(self, arm: Arm, capsules: Capsules, cell: Cell) -> None:
        self.arm, self.capsules, self.cell = arm, capsules, cell
        self.balls: Balls = spheres_of(capsules)
        self.links: Indices = np.unique(self.balls.link[self.balls.link > BASE])
        count = len(cell)
        self.pairs: Indices = np.stack(
            [np.repeat(self.links, count), np.tile(np.arange(count, dtype=np.int64), len(self.links))], axis=1
        )
        self._own_margins: Array = np.array([cell.margin_of(solid) for solid in cell])
        self.margins: Array = np.tile(self._own_margins, len(self.links))
        names = [solid.name for solid in cell]
        self.names = [f"{link_name(arm, int(link))} & {names[k]}" for link, k in self.pairs]
        self._plain: Indices = np.array([k for k, x in enumerate(cell) if isinstance(x, Primitive)], dtype=np.int64)
        self._grids: Indices = np.array([k for k, x in enumerate(cell) if isinstance(x, Gridded)], dtype=np.int64)
        strange = next((x for x in cell if not isinstance(x, (Primitive, Gridded))), None)
        if strange is not None:
            raise InputError(
                f"object '{strange.name}' is a {type(strange).__name__}, and no distance from one is known; "
                f"make it one of the solids of holdfast.cell"
            )
        self.apart = self._switched_off()
        self._check_base()

    # ---- what is looked at ---------------------------------------------------------------------------------------

    def _switched_off(self) -> NDArray[np.bool_]:
        """(n + 1, K) pairs of a link, the base first, and an object that may touch."""
        names = [solid.name for solid in self.cell]
        links = ["base", *self.arm.joint_names]
        off = np.zeros((len(links), len(names)), dtype=np.bool_)
        for thing, link in self.cell.may_touch:
            if thing not in names:
                raise InputError(f"may_touch: cell '{self.cell.name}' has no object '{thing}'; it has {', '.join(names)}")
            if link not in links:
                raise InputError(f"may_touch: '{self.arm.name}' has no link '{link}'; its links are {', '.join(links)}")
            off[links.index(link), names.index(thing)] = True
        return off

    def _check_base(self) -> None:
        """The base does not move, so what it touches it touches always.

        Raises:
            InputError: It touches an object that it may not touch.
        """
        from holdfast.clearance.exact.bodies import box_about  # takes long to import

        for k, solid in enumerate(self.cell):
            margin = self.cell.margin_of(solid)
            # A box about it is asked first: for what is far away no grid need be made.
            if self.apart[0, k] or base_gaps(self.arm, self.balls, [box_about(solid)])[0] >= margin:
                continue
            (gap,) = base_gaps(self.arm, self.balls, [solid])
            if gap < margin:
                near = f"{-gap:.3g} m inside" if gap < 0 else f"{gap:.3g} m and so nearer than the margin to"
                raise InputError(
                    f"the base of '{self.arm.name}' is {near} object '{solid.name}' of the cell, always; "
                    f"if it is mounted there, add may_touch: [[{solid.name}, base]]"
                )

    def added(self, links: Indices, objects: Indices) -> Array:
        """(L, F) what is added to the distances of links from objects, m: what may touch is far away."""
        return np.where(self.apart[np.ix_(links + 1, objects)], NOWHERE, 0.0)

    @cached_property
    def _formulas(self) -> FormulaObjects:
        objects = [x for x in self.cell if isinstance(x, Primitive)]
        return FormulaObjects(
            self.arm, self.balls, objects, self.added(self.links, self._plain), self._own_margins[self._plain]
        )

    @cached_property
    def _gridded(self) -> GriddedObjects | None:
        objects = [x for x in self.cell if isinstance(x, Gridded)]
        return (
            GriddedObjects(self.arm, self.balls, objects, self.added(self.links, self._grids))
            if objects and len(self.links)
            else None
        )

    @cached_property
    def _end_links(self) -> EndLinks:
        added = self.added(np.arange(self.arm.n), self._plain)
        return EndLinks(self.arm, self.balls, self._formulas.objects, added, self._own_margins[self._plain])

    # ---- what is asked -------------------------------------------------------------------------------------------

    def nearest(self, q: Array) -> tuple[Array, Indices, Array]:
        """What is nearest once every pair has what it must keep: (N,) distance beyond that margin, m; pair; gradient (N, n).

        Args:
            q: (N, n) rad and m; a row that is not finite gets NaN and pair -1.
        """
        count = len(self.cell)
        room, pair, slope = np.full(len(q), np.inf), np.full(len(q), np.nan), np.zeros((len(q), self.arm.n))
        if len(self._plain) and len(self.links):
            room, link, thing, slope = self._formulas.nearest(q)
            pair = np.where(np.isnan(room), np.nan, link * count + self._plain[thing])
        if self._gridded is not None:
            other, link, thing, theirs = self._gridded.nearest(q, self._own_margins[self._grids])
            closer = ~(room <= other)
            room, slope = np.where(closer, other, room), np.where(closer[:, None], theirs, slope)
            pair = np.where(closer, np.where(np.isnan(other), np.nan, link * count + self._grids[thing]), pair)
        return room, np.where(np.isnan(pair), -1, pair).astype(np.int64), slope

    def single_blocks(self) -> list[Single]:
        """What is nearest at one configuration at a time, by block of objects; none with objects that have grids."""
        formulas = len(self._plain) and len(self.links) and self._gridded is None
        return self._formulas.single_blocks() if formulas else []

    def room(self, q: Array) -> Array:
        """(N,) the least distance beyond what each pair keeps, m."""
        room = self._formulas.room(q)
        if self._gridded is not None:
            room = np.minimum(room, self._gridded.least(q, self._own_margins[self._grids]))
        return room

    def least(self, q: Array) -> Array:
        """(N,) the least distance, m."""
        least = self._formulas.least(q)
        return least if self._gridded is None else np.minimum(least, self._gridded.least(q, np.zeros(len(self._grids))))

    def distances(self, q: Array) -> Array:
        """(N, L K) lower bound of the distance of every pair, m; about 1e9 m where a pair may touch."""
        out = np.empty((len(q), len(self.links), len(self.cell)))
        if len(self._plain) and len(self.links):
            out[:, :, self._plain] = self._formulas.distances(q)
        if self._gridded is not None:
            out[:, :, self._grids] = self._gridded.distances(q)
        return out.reshape(len(q), len(self.pairs))

    def never_clear(self, poses: Array, margin: float) -> NDArray[np.bool_]:
        """(N,) True where no configuration that meets a pose (N, 4, 4) of the tool to 1e-6 keeps a margin, m, beyond its own.

        Proved by the places that the last two links can have, for objects with a formula; False proves nothing.
        """
        return self._end_links.too_close(poses, margin)

    def gap(self, q: Array) -> Gap:
        """What is nearest at one configuration (n,), once every pair has what it must keep."""
        room, pair, _ = (x[0] for x in self.nearest(q[None]))
        link, k = self.pairs[pair]
        solid, some = self.cell.objects[k], self.balls.link == link
        pose = self.arm.frames(q)[link + 1]
        centres = self.balls.centre[some] @ pose[:3, :3].T + pose[:3, 3]
        away = solid.signed_distance(centres)
        ball = int((away - self.balls.radius[some]).argmin())
        point = centres[ball]
        if isinstance(solid, Primitive):
            rise = outward_kernel()(point, solid.numbers())
        else:
            rise = solid.distance_and_gradient(point)[1]
        outward = rise / max(float(np.linalg.norm(rise)), 1e-300)
        return Gap(
            pair=int(pair),
            distance=float(room + self.margins[pair]),
            room=float(room),
            on_arm=point - self.balls.radius[some][ball] * outward,
            on_object=point - away[ball] * outward,
        )

    def changes(self, low: Array, high: Array) -> Array:
        """(L K, n) bounds of how much the distance of each pair changes per rad and m of each joint within a box.

        Args:
            low: (n,) lower corner of the box, finite, rad and m.
            high: (n,) upper corner.
        """
        reach = np.linalg.norm(self.balls.centre, axis=1)
        far = np.array([reach[self.balls.link == link].max() for link in self.links])
        return np.repeat(changes_from_outside(self.arm, self.links, far, low, high), len(self.cell), axis=0)


def base_gaps(arm: Arm, balls: Balls, objects: Iterable[Solid]) -> list[float]:
    """A lower bound of the distance of the base from each object, m; infinite if no sphere covers the base."""
    still = balls.link == BASE
    centre = balls.centre[still] @ arm.base[:3, :3].T + arm.base[:3, 3]
    return [float((solid.signed_distance(centre) - balls.radius[still]).min(initial=np.inf)) for solid in objects]
