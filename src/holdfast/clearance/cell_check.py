"""What a cell is like before anything is computed in it: what touches whom, and how sharply its objects are seen."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from holdfast.arguments import checked
from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.cell.cell import Cell, as_cell
from holdfast.cell.meshes import Gridded, Mesh, Points
from holdfast.cell.solids import Solid
from holdfast.clearance.chains import spheres_of
from holdfast.clearance.clearance import Clearance
from holdfast.clearance.obstacles import Obstacles, base_gaps
from holdfast.probability.sobol_sequence import sobol
from holdfast.result import Result
from holdfast.words import counted, percent

SAMPLES = 512  # configurations


@dataclass(frozen=True, kw_only=True)
class CheckedObject:
    """An object of a cell, as a check finds it.

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
    """What a check of a cell finds.

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
        """Nothing touches the base, and no pair touches always."""
        return not self.base and not self.always

    def describe(self) -> list[str]:
        """What touches, and what the bound is of."""
        told = [f"cell '{self.cell}' has {counted(len(self.objects), 'object')}"]
        if not self.arm:
            return [*told, "give an arm to see what it touches"]
        if self.base:
            told.append(
                f"the base of '{self.arm}' touches {', '.join(self.base)}; if it is mounted there, put it into may_touch"
            )
        if self.always:
            told.append(f"in all of {self.samples} configurations these touch: {', '.join(self.always)}; see may_touch")
        told.append(
            f"{percent(self.colliding)} of {self.samples} configurations within the limits touch an object, by the bound"
        )
        told.append(
            f"{counted(self.spheres, 'sphere')} cover the moving links of '{self.arm}' ({self.shape}) and reach up to "
            f"{1000 * self.reach:.3g} mm beyond its capsules"
        )
        return told


@checked
def check_cell(cell: Cell | str | Path, arm: Arm | None = None, *, clearance: Clearance | None = None) -> CellCheck:
    """What touches in a cell, and how sharply its objects are seen.

    Args:
        cell: The cell or its file.
        arm: The arm in it; without one only the objects are looked at.
        clearance: The shape of the arm; :meth:`Clearance.by_default` if not given.

    Raises:
        InputError: The cell cannot be read, or ``may_touch`` names nothing of it or of the arm.
    """
    found = as_cell(cell)
    assert found is not None
    if arm is None:
        seen = [_object(found, solid, float("nan")) for solid in found]
        found.require_unchanged()
        return CellCheck(cell=found.name, digest=found.digest, objects=tuple(seen))
    given = Clearance(arm) if clearance is None else clearance
    gaps = zip(found, base_gaps(arm, spheres_of(given.capsules), found), strict=True)
    base = [x.name for x, gap in gaps if gap < found.margin_of(x) and (x.name, "base") not in found.may_touch]
    open_ = replace(found, may_touch=[*found.may_touch, *((name, "base") for name in base)])
    obstacles = Obstacles(arm, given.capsules, open_)
    low, high = finite_limits(arm)
    touches = obstacles.distances(low + (high - low) * sobol(SAMPLES, arm.n)) < 0
    by_object = touches.reshape(SAMPLES, -1, len(found)).any(axis=1).mean(axis=0) if len(found) else np.zeros(0)
    seen = [_object(found, solid, float(share)) for solid, share in zip(found, by_object, strict=True)]
    found.require_unchanged()
    balls, parts = obstacles.balls, np.array([part.radius for part in given.capsules])
    moving = balls.link >= 0
    return CellCheck(
        cell=found.name,
        digest=found.digest,
        arm=arm.name,
        objects=tuple(seen),
        base=tuple(base),
        always=tuple(name for name, each in zip(obstacles.names, np.asarray(touches.all(axis=0)), strict=True) if each),
        colliding=float(touches.any(axis=1).mean()),
        samples=SAMPLES,
        spheres=int(moving.sum()),
        reach=float((balls.radius - parts[balls.part])[moving].max(initial=0.0)),
        shape=given.capsules.describe(arm),
    )


def _object(cell: Cell, solid: Solid, touching: float) -> CheckedObject:
    kind = {"HalfSpace": "half space", "Points": "point cloud"}.get(type(solid).__name__, type(solid).__name__.lower())
    grid, parts = solid.field if isinstance(solid, Gridded) else None, 0
    if isinstance(solid, Mesh):
        kind, parts = "mesh" if solid.solid == "exact" else "hull", len(solid.surface.faces)
    elif isinstance(solid, Points):
        parts = len(solid.centres)
    source = cell.sources.get(solid.name)
    return CheckedObject(
        name=solid.name,
        kind=kind,
        parts=parts,
        width=0.0 if grid is None else grid.grid.width,
        excess=0.0 if grid is None else 2 * grid.excess,
        margin=cell.margin_of(solid),
        touching=touching,
        file=() if source is None else (str(source.path), source.sha256),
    )
