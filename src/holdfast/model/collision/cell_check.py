"""Check of a cell before any computation: contacts with the arm, and the resolution of the object distances."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from holdfast.core.probability.sobol_sequence import sobol_points
from holdfast.core.result import Result
from holdfast.core.validation import check_arguments
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.cell.cell import Cell, as_cell
from holdfast.model.cell.meshes import GriddedSolid, Mesh, Points
from holdfast.model.cell.solids import Solid
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.obstacles import Obstacles, base_distances
from holdfast.model.collision.sphere_cover import make_sphere_cover

CHECKED_CONFIGURATIONS = 512  # configurations


@dataclass(frozen=True, kw_only=True)
class CheckedObject:
    """An object of a cell, as found by a check.

    Attributes:
        name: Its name.
        kind: box, cylinder, capsule, sphere, half space, mesh, hull, or point cloud.
        parts: How many triangles or points it has; 0 for what a formula describes.
        width: Of its grid, m; 0 for what a formula describes.
        excess: How much nearer it seems than it is at most, close to it, m; 0 for what a formula describes.
        margin: What is kept from it, m.
        touching: Fraction of the sampled configurations in which a link touches it, its margin not counted; NaN without an arm.
        file: What it was read from and the SHA-256 of that; empty for none.
    """

    name: str
    kind: str
    parts: int
    width: float
    excess: float
    margin: float
    touching: float
    file: tuple[str, str] | tuple[()] = ()


@dataclass(frozen=True, kw_only=True)
class CellCheck(Result):
    """Result of the check of a cell.

    Attributes:
        cell: Its name.
        digest: SHA-256 of everything that counts in it.
        arm: Name of the arm; empty for none.
        objects: One for each object, in its order.
        base: Objects that the base touches, or is nearer to than their margin, though they are not in ``may_touch``.
        always: Pairs of a link and an object that touch in all sampled configurations.
        colliding: Fraction of the sampled configurations in which anything touches; NaN without an arm.
        samples: Configurations within the limits of the arm, the first points of the Sobol sequence.
        spheres: How many cover the links of the arm that move.
        reach: How far they reach beyond the capsules that they cover at most, m.
        shape: What the arm's shape is, in words.
    """

    cell: str
    digest: str
    arm: str = ""
    objects: tuple[CheckedObject, ...]
    base: tuple[str, ...] = ()
    always: tuple[str, ...] = ()
    colliding: float = float("nan")
    samples: int = 0
    spheres: int = 0
    reach: float = 0.0
    shape: str = ""

    @property
    def ok(self) -> bool:
        """True if nothing touches the base, and no pair always touches."""
        return not self.base and not self.always


@check_arguments
def check_cell(cell: Cell | str | Path, arm: Arm | None = None, *, clearance: Clearance | None = None) -> CellCheck:
    """Check a cell for contacts, and for the resolution of its object distances.

    Args:
        cell: The cell or its file.
        arm: The arm in it; without one only the objects are looked at.
        clearance: The shape of the arm; :meth:`Clearance.by_default` if not given.

    Raises:
        InputError: The cell cannot be read, or ``may_touch`` names nothing of it or of the arm.
    """
    loaded_cell = as_cell(cell)
    assert loaded_cell is not None
    if arm is None:
        checked_objects = [_check_object(loaded_cell, solid, float("nan")) for solid in loaded_cell]
        loaded_cell.require_unchanged()
        return CellCheck(cell=loaded_cell.name, digest=loaded_cell.digest, objects=tuple(checked_objects))
    resolved_clearance = Clearance(arm) if clearance is None else clearance
    gaps = zip(loaded_cell, base_distances(arm, make_sphere_cover(resolved_clearance.capsules), loaded_cell), strict=True)
    base_contacts = [
        checked_solid.name
        for checked_solid, gap in gaps
        if gap < loaded_cell.margin_of(checked_solid) and (checked_solid.name, "base") not in loaded_cell.may_touch
    ]
    open_cell = replace(loaded_cell, may_touch=[*loaded_cell.may_touch, *((name, "base") for name in base_contacts)])
    obstacles = Obstacles(arm, resolved_clearance.capsules, open_cell)
    lower, upper = sampling_limits(arm)
    touches = obstacles.pair_distances(lower + (upper - lower) * sobol_points(CHECKED_CONFIGURATIONS, arm.n)) < 0
    by_object = np.zeros(0)
    if len(loaded_cell):
        by_object = touches.reshape(CHECKED_CONFIGURATIONS, -1, len(loaded_cell)).any(axis=1).mean(axis=0)
    checked_objects = [
        _check_object(loaded_cell, solid, float(fraction)) for solid, fraction in zip(loaded_cell, by_object, strict=True)
    ]
    loaded_cell.require_unchanged()
    spheres, capsule_radii = obstacles.spheres, np.array([part.radius for part in resolved_clearance.capsules])
    moving = spheres.link >= 0
    return CellCheck(
        cell=loaded_cell.name,
        digest=loaded_cell.digest,
        arm=arm.name,
        objects=tuple(checked_objects),
        base=tuple(base_contacts),
        always=tuple(
            name
            for name, always_touches in zip(obstacles.names, np.asarray(touches.all(axis=0)), strict=True)
            if always_touches
        ),
        colliding=float(touches.any(axis=1).mean()),
        samples=CHECKED_CONFIGURATIONS,
        spheres=int(moving.sum()),
        reach=float((spheres.radius - capsule_radii[spheres.part])[moving].max(initial=0.0)),
        shape=resolved_clearance.capsules.describe(arm),
    )


def _check_object(cell: Cell, solid: Solid, touching: float) -> CheckedObject:
    kind = {"HalfSpace": "half space", "Points": "point cloud"}.get(type(solid).__name__, type(solid).__name__.lower())
    distance_field, part_count = solid.field if isinstance(solid, GriddedSolid) else None, 0
    if isinstance(solid, Mesh):
        kind, part_count = "mesh" if solid.solid == "exact" else "hull", len(solid.surface.faces)
    elif isinstance(solid, Points):
        part_count = len(solid.centres)
    source = cell.sources.get(solid.name)
    return CheckedObject(
        name=solid.name,
        kind=kind,
        parts=part_count,
        width=0.0 if distance_field is None else distance_field.grid.width,
        excess=0.0 if distance_field is None else 2 * distance_field.max_underestimate,
        margin=cell.margin_of(solid),
        touching=touching,
        file=() if source is None else (str(source.path), source.sha256),
    )
