"""Work cell with the objects around an arm and the distances that the arm must keep from them."""

from __future__ import annotations

import hashlib
import json
import os
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.caching import cached_property
from holdfast.core.errors import ArmError, InputError
from holdfast.core.formatting import format_count
from holdfast.core.validation import check_arguments, check_constructor
from holdfast.model.arms.loading import root_element_name
from holdfast.model.cell.meshes import Mesh, Points, Source
from holdfast.model.cell.solids import Solid


@check_constructor
@dataclass(frozen=True, eq=False)
class Cell:
    """Static objects in the world, and objects that the arm holds.

    Attributes:
        objects: Objects in any order, each with its own name.
        name: Name for people and files.
        margin: Smallest distance that an arm must keep from each object, m.
        may_touch: Pairs of an object and a link that are not checked; the link is named by its joint, or ``base``.
        held: Objects that move with the tool, such as a part in the gripper: boxes, cylinders, capsules and spheres with their
            poses in the tool's frame.
        shape: Collision model of the arm in this cell: ``meshes`` of its own file, ``assumed`` capsules along its links, or a
            capsule file; default: the best one available.
        spheres_to: Mean distance by which the spheres around the arm may extend beyond it, m; None: the default of the cover.
        hold: Values of joints outside the arm's chain, rad or m, by name.

    Raises:
        InputError: Two objects have the same name, or a margin is below 0 or not finite.
    """

    objects: Sequence[Solid]
    _: KW_ONLY
    name: str = "cell"
    margin: float = 0.0
    may_touch: Sequence[tuple[str, str]] = ()
    held: Sequence[Solid] = ()
    shape: str = ""
    spheres_to: float | None = None
    hold: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "objects", tuple(self.objects))
        object.__setattr__(self, "may_touch", tuple((object_name, link_name) for object_name, link_name in self.may_touch))
        object.__setattr__(self, "held", tuple(self.held))
        object.__setattr__(self, "hold", dict(self.hold))
        if not 0 <= self.margin < float("inf"):
            raise InputError(f"the margin of cell '{self.name}' is {self.margin:g} m; it must be finite and 0 or more")
        names = [solid.name for solid in self.objects]
        double = next((name for index, name in enumerate(names) if name in names[:index]), None)
        if double is not None:
            raise InputError(f"cell '{self.name}': the name '{double}' is used by two objects; names must be unique")

    def __iter__(self) -> Iterator[Solid]:
        return iter(self.objects)

    def __len__(self) -> int:
        return len(self.objects)

    def with_poses(self, poses: Mapping[str, ArrayLike]) -> Cell:
        """Return the same cell with some of its objects at other poses.

        Args:
            poses: Poses (4, 4) in the world, m, by the name of the object.

        Raises:
            InputError: The cell has no such object.
        """
        names = [solid.name for solid in self.objects]
        unknown = next((name for name in poses if name not in names), None)
        if unknown is not None:
            raise InputError(f"cell '{self.name}' has no object '{unknown}'; it has {', '.join(names)}")
        objects = [member.moved_to(poses[member.name]) if member.name in poses else member for member in self.objects]
        return replace(self, objects=objects)

    def __str__(self) -> str:
        kinds = Counter(type(solid).__name__ for solid in self.objects)
        summary = ", ".join(format_count(count, _KIND_NAMES.get(kind, kind)) for kind, count in kinds.items())
        return f"cell '{self.name}': {summary or 'no objects'}" + (f"; margin {self.margin:g} m" if self.margin else "")

    def margin_of(self, solid: Solid) -> float:
        """Return the distance to keep from the object ``solid``, m: the larger of its own margin and the cell's."""
        return max(self.margin, solid.margin)

    # ---- files -------------------------------------------------------------------------------------------------

    @classmethod
    @check_arguments
    def load(cls, path: str | Path) -> Cell:
        """Return the cell in the file ``path``: YAML (:mod:`holdfast.model.cell.cell_file`), URDF or MJCF, by its content.

        For a URDF or MJCF file with several ends use :meth:`from_urdf` or :meth:`from_mjcf`, which take the end of the arm.

        Raises:
            InputError: The file cannot be read, or an entry is wrong; the message names it.
            HoldfastError: An extra that the file needs is not installed.
        """
        from holdfast.model.cell import cell_file

        path = Path(path)
        if path.suffix.lower() in _XML_ENDINGS:
            return cls.from_mjcf(path) if root_element_name(str(path)) == "mujoco" else cls.from_urdf(path)
        try:
            return cls.from_dict(cell_file.read_cell_file(path), path.parent)
        except (InputError, ArmError) as error:
            raise cell_file.cell_file_error(path, error) from error

    @classmethod
    @check_arguments
    def from_urdf(
        cls,
        path: str | Path,
        base: str | None = None,
        tip: str | None = None,
        *,
        hold: Mapping[str, float] | None = None,
        meshes: str | Path | None = None,
    ) -> Cell:
        """Return the objects around an arm in a URDF file: the ``<collision>`` of every link that does not move with the arm.

        The links from ``base`` to the first joint that moves belong to the arm. Poses are in the frame of ``base``, as those of
        the arm that :meth:`holdfast.Arm.from_urdf` reads with the same arguments. A mesh that is not closed becomes its convex
        hull. Objects that touch the base may touch it, because neither moves.

        Args:
            path: URDF file.
            base: Link on which the arm is mounted; default: the root.
            tip: Link whose frame is the arm's tool, as for :meth:`holdfast.Arm.from_urdf`; not needed if nothing moves.
            hold: Values, rad or m, of held joints that do not belong to the arm.
            meshes: Folder with the mesh files, if they are not where the file states.

        Raises:
            InputError: The file or a shape in it cannot be read, or it has no such links.
        """
        from holdfast.model.cell import cell_file, surroundings

        try:
            folder = None if meshes is None else Path(meshes)
            return cls(**surroundings.cell_arguments_from_urdf(Path(path), base, tip, hold or {}, folder))
        except (InputError, ArmError) as error:
            raise cell_file.cell_file_error(Path(path), error) from error

    @classmethod
    @check_arguments
    def from_mjcf(
        cls, path: str | Path, base: str | None = None, tip: str | None = None, *, hold: Mapping[str, float] | None = None
    ) -> Cell:
        """Return the objects around an arm in an MJCF file: colliding geoms of bodies that do not move with the arm.

        The bodies from ``base`` to the first joint that moves belong to the arm, except the world. A mesh becomes its convex
        hull, as in MuJoCo. Objects that touch the base may touch it, because neither moves. Needs ``holdfast-arms[physics]``.

        Args:
            path: MJCF file.
            base: Body on which the arm is mounted; default: ``world``.
            tip: Body whose frame is the arm's tool, as for :meth:`holdfast.Arm.from_mjcf`; not needed if nothing moves.
            hold: Values, rad or m, of held joints that do not belong to the arm.

        Raises:
            InputError: MuJoCo cannot read the file, it has no such bodies, or a geom has no distance formula.
            HoldfastError: MuJoCo is not installed.
        """
        from holdfast.model.cell import cell_file, surroundings

        try:
            return cls(**surroundings.cell_arguments_from_mjcf(Path(path), base, tip, hold or {}))
        except (InputError, ArmError) as error:
            raise cell_file.cell_file_error(Path(path), error) from error

    @classmethod
    def from_dict(cls, data: dict[str, Any], folder: str | Path = ".") -> Cell:
        """Return the cell from JSON data of :meth:`to_dict`, or from the keys and values of a file.

        Args:
            data: Keys and values.
            folder: Folder of the files that the data name.

        Raises:
            InputError: An entry is wrong; the message names it.
        """
        from holdfast.model.cell import cell_file

        return cls(**cell_file.cell_arguments_from_data(data, Path(folder)))

    def to_dict(self) -> dict[str, Any]:
        """Return all data as JSON types: the keys and values of a file, with the full paths of other files.

        Raises:
            InputError: An object has a user-defined class, which a file cannot store.
        """
        from holdfast.model.cell import cell_file

        data: dict[str, Any] = {"name": self.name} | ({"margin": float(self.margin)} if self.margin else {})
        data["objects"] = {solid.name: cell_file.object_to_dict(solid) for solid in self.objects}
        data |= {"held": [cell_file.object_to_dict(solid) for solid in self.held]} if self.held else {}
        data |= {"may_touch": [list(pair) for pair in self.may_touch]} if self.may_touch else {}
        full_shape = self.shape if self.shape in cell_file.SHAPE_WORDS else str(Path(self.shape).resolve())
        arm: dict[str, Any] = {"shape": full_shape} if full_shape else {}
        arm |= {"spheres_to": float(self.spheres_to)} if self.spheres_to is not None else {}
        arm |= {"hold": {name: float(value) for name, value in self.hold.items()}} if self.hold else {}
        return data | ({"arm": arm} if arm else {})

    @check_arguments
    def save(self, path: str | Path) -> list[Path]:
        """Write the cell to the YAML file ``path``, which :meth:`load` reads, with all digits.

        Mesh and point files stay in place and are named relative to the new file; arrays are written to files next to it.

        Returns:
            The YAML file and the files written next to it.

        Raises:
            StoreError: A file cannot be written.
            InputError: An object has a user-defined class, which a file cannot store.
        """
        import io

        from holdfast.core.files import mesh, output
        from holdfast.model.cell import cell_file

        file, data, companions = Path(path), self.to_dict(), {}
        folder = file.absolute().parent
        for number, solid in enumerate(self.objects):
            if not isinstance(solid, (Mesh, Points)):
                continue
            key, entry = "mesh" if isinstance(solid, Mesh) else "points", data["objects"][solid.name]
            if solid.source is not None:
                entry[key] = os.path.relpath(solid.source.path, folder)
                continue
            entry[key] = f"{file.stem}-{number + 1}.{'obj' if isinstance(solid, Mesh) else 'npy'}"
            if isinstance(solid, Mesh):
                companions[folder / entry[key]] = mesh.write_obj_text(solid.surface).encode()
            else:
                stream = io.BytesIO()
                np.save(stream, solid.centres)
                companions[folder / entry[key]] = stream.getvalue()
        if self.shape not in cell_file.SHAPE_WORDS:
            data["arm"]["shape"] = os.path.relpath(data["arm"]["shape"], folder)
        for companion, content in companions.items():
            output.replace_file(companion, content, "cell to")
        output.replace_file(file, cell_file.format_cell(data), "cell to")
        return [file, *companions]

    # ---- data -------------------------------------------------------------------------------------------------

    @property
    def changes_arm(self) -> bool:
        """True if the cell holds objects or chooses a collision model, so that the arm has another shape than by default."""
        return bool(self.held or self.shape or self.hold) or self.spheres_to is not None

    @cached_property
    def digest(self) -> str:
        """SHA-256 of the geometry and margins, with triangles and points, without names and paths of files.

        The same shape from a file of another format, or from arrays, has the same digest. For a capsule file its bytes count.

        Raises:
            InputError: The capsule file cannot be read.
        """
        from holdfast.core.files import reading
        from holdfast.model.cell import cell_file

        shape = self.shape
        if shape not in cell_file.SHAPE_WORDS:
            with reading.guard_reading(f"capsule file '{shape}'"):
                shape = hashlib.sha256(reading.read_bytes(Path(shape))).hexdigest()

        def describe_solid(solid: Solid) -> Any:
            if not isinstance(solid, (Mesh, Points)):
                return [solid.name, cell_file.object_to_dict(solid)]
            radius = solid.radius if isinstance(solid, Points) else 0.0
            return [solid.name, type(solid).__name__, solid.digest, radius, solid.pose.tolist(), solid.margin]

        content = [
            sorted(map(describe_solid, self.objects), key=lambda row: row[0]),
            [cell_file.object_to_dict(solid) for solid in self.held],
            [float(self.margin), sorted(map(list, self.may_touch))],
            [shape, self.spheres_to, sorted(self.hold.items())],
        ]
        return hashlib.sha256(json.dumps(content).encode()).hexdigest()

    @property
    def sources(self) -> dict[str, Source]:
        """Files from which objects were read, by the name of the object."""
        return {
            solid.name: solid.source for solid in self.objects if isinstance(solid, (Mesh, Points)) and solid.source is not None
        }

    def require_unchanged(self) -> None:
        """Raise an error if the file of a mesh or point cloud has changed since it was read; a run calls this before it writes.

        Raises:
            InputError: A file has changed; the message names it.
        """
        for name, source in self.sources.items():
            if source.changed():
                raise InputError(
                    f"'{source.path.name}', the file of object '{name}', changed since the cell was read, so nothing was "
                    f"written; run again"
                )


_XML_ENDINGS = (".urdf", ".xml", ".mjcf")
_KIND_NAMES = {"HalfSpace": "half space", "Points": "point cloud"} | {
    kind: kind.lower() for kind in ("Box", "Cylinder", "Capsule", "Sphere", "Mesh")
}


def as_cell(cell: Cell | str | Path | None) -> Cell | None:
    """Return ``cell`` itself, or the cell in the file with this path; None for None.

    Raises:
        InputError: The file cannot be used.
    """
    return cell if cell is None or isinstance(cell, Cell) else Cell.load(cell)
