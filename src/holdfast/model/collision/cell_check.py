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
    """Object of a cell, with the results of a check.

    Attributes:
        name: Name of the object.
        kind: box, cylinder, capsule, sphere, half space, mesh, hull, or point cloud.
        parts: Number of triangles or points; 0 for an object with a distance formula.
        width: Width of its grid, m; 0 for an object with a distance formula.
        excess: Largest underestimate of its distance, close to it, m; 0 for an object with a distance formula.
        margin: Distance to keep from it, m.
        touching: Fraction of the sampled configurations in which a link touches it, without its margin; NaN without an arm.
        file: File from which it was read, and the SHA-256 of the file; empty for none.
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
        cell: Name of the cell.
        digest: SHA-256 of the cell's geometry and margins.
        arm: Name of the arm; empty for none.
        objects: Results for each object, in the order of the cell.
        base: Objects that touch the base, or are closer to it than their margin, and are not in ``may_touch``.
        always: Pairs of a link and an object that touch in all sampled configurations.
        colliding: Fraction of the sampled configurations with any contact; NaN without an arm.
        samples: Number of configurations within the limits of the arm, the first points of the Sobol sequence.
        spheres: Number of spheres that cover the moving links of the arm.
        reach: Largest distance by which the spheres extend beyond the capsules that they cover, m.
        shape: Description of the arm's collision model.
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
        cell: Cell or its file.
        arm: Arm in the cell; without an arm only the objects are checked.
        clearance: Collision model of the arm; default: :meth:`Clearance.by_default`.

    Raises:
        InputError: The cell cannot be read, or ``may_touch`` names no object of the cell or no link of the arm.
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
