"""Read and write cells as YAML files.

An example with every key; only ``objects``, and one kind in each object, are required::

    name: bench               # default: the file's name
    margin: 0.01              # smallest permitted distance from every object, m; default 0
    objects:                  # each has a unique name; poses in the world, lengths in m
      table: {box: [0.8, 1.2, 0.04], pose: {xyz: [0.5, 0, -0.02]}}      # full edges, as in URDF
      post:                                                             # axis along z; rpy in rad, as in URDF
        {cylinder: {radius: 0.05, length: 1.0}, pose: {xyz: [0.2, 0.55, 0.5], rpy: [0, 0.1, 0]}}
      pipe:                                                             # length between the centres of its end caps; x, y, z, w
        {capsule: {radius: 0.04, length: 0.6}, pose: {xyz: [0.6, 0, 0.9], quaternion: [0, 0.6, 0, 0.8]}}
      ball: {sphere: 0.12, pose: {xyz: [0.45, 0.35, 0.8]}}
      ground: {half_space: [0, 0, 1], pose: {xyz: [0, 0, -0.8]}}        # solid below a plane with this outward normal
      jig: {mesh: jig.stl, scale: 0.001, solid: exact}                  # STL, OBJ, GLB or PLY next to this file; exact or hull
      scan: {points: scan.npy, radius: 0.005}                           # (N, 3) m; a sphere at every point
      sealed: {mesh: box.glb, solid: hull, margin: 0.03}                # the larger of both margins applies
    held:                     # moves with the tool, as a part in the gripper; poses in the tool's frame
      - {capsule: {radius: 0.02, length: 0.15}, pose: {xyz: [0, 0, 0.08]}}
    may_touch:                # pairs of an object and a link (its joint, or base) that are not checked
      - [table, base]
      - [ball, panda_joint7]
    arm: {shape: meshes, spheres_to: 0.01, hold: {panda_finger_joint1: 0.04}}

``arm`` describes the collision model of the arm: ``meshes`` of its own file, ``assumed`` capsules, or a capsule file next to
this file; the mean distance by which its spheres may extend beyond it, m; and the values of joints outside its chain, rad or m.
A pose may also be 4 rows of 4 numbers, a mesh ``{vertices: [...], faces: [...]}`` and points a list.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
import yaml
from pydantic import Discriminator, Field, Tag, ValidationError

from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.files.yaml import Four, Number, Strict, Three, describe_validation_error, read_mapping
from holdfast.core.typing import FloatArray
from holdfast.model.arm.formats.urdf import rpy_rotation
from holdfast.model.arm.poses import rotations_of_quaternions
from holdfast.model.cell.meshes import Mesh, Points
from holdfast.model.cell.solids import Box, Capsule, Cylinder, HalfSpace, Solid, Sphere

Positive = Annotated[Number, Field(gt=0)]
Least = Annotated[Number, Field(ge=0)]

EXAMPLE_MODULE = "holdfast.model.cell.cell_file"
SHAPE_WORDS = ("", "meshes", "assumed")  # of the arm; any other text is a capsule file
OBJECT_KINDS = ("box", "cylinder", "capsule", "sphere", "half_space", "mesh", "points")
_HOLDABLE_KINDS = OBJECT_KINDS[:4]
_QUATERNION_NORM_TOLERANCE = 1e-2  # files may round the numbers of a unit quaternion


class _ObjectPlacement(Strict):
    xyz: Three = Field(default_factory=lambda: [0.0, 0.0, 0.0])
    rpy: Three | None = None
    quaternion: Four | None = None


class _RoundObject(Strict):
    radius: Positive
    length: Positive


class _SurfaceEntry(Strict):
    vertices: list[Three]
    faces: list[Three]


FORMAT_TAGS = ("as rows", "as xyz and rpy", "as a list", "as a file", "as vertices and faces")
_Pose = Annotated[
    Annotated[list[Four], Field(min_length=4, max_length=4), Tag(FORMAT_TAGS[0])]
    | Annotated[_ObjectPlacement, Tag(FORMAT_TAGS[1])],
    Discriminator(lambda value: FORMAT_TAGS[0] if isinstance(value, list) else FORMAT_TAGS[1]),
]
_Cloud = Annotated[
    Annotated[list[Three], Tag(FORMAT_TAGS[2])] | Annotated[str, Tag(FORMAT_TAGS[3])],
    Discriminator(lambda value: FORMAT_TAGS[2] if isinstance(value, list) else FORMAT_TAGS[3]),
]
_Mesh = Annotated[
    Annotated[str, Tag(FORMAT_TAGS[3])] | Annotated[_SurfaceEntry, Tag(FORMAT_TAGS[4])],
    Discriminator(lambda value: FORMAT_TAGS[4] if isinstance(value, dict) else FORMAT_TAGS[3]),
]


class _ObjectEntry(Strict):
    box: Annotated[list[Positive], Field(min_length=3, max_length=3)] | None = None
    cylinder: _RoundObject | None = None
    capsule: _RoundObject | None = None
    sphere: Positive | None = None
    half_space: Three | None = None
    mesh: _Mesh | None = None
    points: _Cloud | None = None
    scale: Positive | None = None
    solid: Literal["exact", "hull"] | None = None
    radius: Positive | None = None
    pose: _Pose | None = None
    margin: Least = 0.0


class _ArmEntry(Strict):
    shape: str | None = None
    spheres_to: Positive | None = None
    hold: dict[str, Number] = Field(default_factory=dict)


class CellFile(Strict):
    """Keys and values of a cell file."""

    objects: dict[str, _ObjectEntry]
    name: str | None = None
    margin: Least = 0.0
    held: list[_ObjectEntry] = Field(default_factory=list)
    may_touch: list[Annotated[list[str], Field(min_length=2, max_length=2)]] = Field(default_factory=list)
    arm: _ArmEntry = Field(default_factory=_ArmEntry)


def read_cell_file(path: Path) -> dict[str, Any]:
    """Return the unchecked keys and values of a file.

    Raises:
        InputError: The file cannot be read or is not YAML.
    """
    return {"name": path.stem} | read_mapping(path, EXAMPLE_MODULE, "objects")


def cell_arguments_from_data(data: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Return the arguments of :class:`holdfast.Cell` from the keys and values of a file.

    Args:
        data: Keys and values.
        folder: Folder of the files that the data name.

    Raises:
        InputError: A key or a named file is unknown, missing or wrong; the message names it.
    """
    try:
        parsed = CellFile.model_validate(data)
    except ValidationError as error:
        raise InputError(describe_validation_error(error, CellFile, FORMAT_TAGS)) from error
    return {
        "objects": [_build_solid(name, entry, f"objects.{name}", folder) for name, entry in parsed.objects.items()],
        "name": parsed.name or "cell",
        "margin": parsed.margin,
        "held": [_build_held_object(index, entry, folder) for index, entry in enumerate(parsed.held)],
        "may_touch": [(object_name, link_name) for object_name, link_name in parsed.may_touch],
        **parsed.arm.model_dump(exclude_none=True),
        "shape": shape if (shape := parsed.arm.shape or "") in SHAPE_WORDS else str(folder / shape),
    }


def _build_held_object(number: int, entry: _ObjectEntry, folder: Path) -> Solid:
    location = f"held[{number}]"
    solid = _build_solid(f"held {number + 1}", entry, location, folder)
    if _object_kind(entry, location) not in _HOLDABLE_KINDS:
        raise InputError(f"{location}: a {_object_kind(entry, location)} cannot be held; use {', '.join(_HOLDABLE_KINDS)}")
    return solid


def _object_kind(entry: _ObjectEntry, location: str) -> str:
    given_kinds = [kind for kind in OBJECT_KINDS if getattr(entry, kind) is not None]
    if len(given_kinds) != 1:
        given_text = "no kind" if not given_kinds else " and ".join(given_kinds)
        raise InputError(f"{location}: it has {given_text}; give one of {', '.join(OBJECT_KINDS)}")
    kind_of_key = {"scale": "mesh", "solid": "mesh", "radius": "points"}
    misplaced = next(
        (key for key, kind in kind_of_key.items() if getattr(entry, key) is not None and given_kinds[0] != kind), None
    )
    if misplaced is not None:
        raise InputError(
            f"{location}: {misplaced} is for {kind_of_key[misplaced]} alone, and this is a {given_kinds[0]}; leave it out"
        )
    return given_kinds[0]


def _build_solid(name: str, entry: _ObjectEntry, location: str, folder: Path) -> Solid:
    kind = _object_kind(entry, location)
    common_arguments: dict[str, Any] = {"pose": _build_pose(entry.pose, location), "margin": entry.margin}
    value: Any = getattr(entry, kind)
    match kind:
        case "box":
            return Box(name, np.array(value), **common_arguments)
        case "cylinder" | "capsule":
            return (Cylinder if kind == "cylinder" else Capsule)(name, value.radius, value.length, **common_arguments)
        case "sphere":
            return Sphere(name, value, **common_arguments)
        case "half_space":
            return HalfSpace(
                name, **common_arguments | {"pose": common_arguments["pose"] @ _rotation_to_normal(np.array(value), location)}
            )
        case "mesh":
            shape = str(folder / value) if isinstance(value, str) else (np.array(value.vertices), np.array(value.faces))
            return Mesh(name, shape, scale=entry.scale or 1.0, solid=entry.solid or "exact", **common_arguments)
    if entry.radius is None:
        raise InputError(f"{location}.radius: it is missing; every point is a ball of this radius, m")
    return Points(
        name, str(folder / value) if isinstance(value, str) else np.array(value), radius=entry.radius, **common_arguments
    )


def _build_pose(pose: list[list[float]] | _ObjectPlacement | None, location: str) -> FloatArray:
    if pose is None:
        return np.eye(4)
    if isinstance(pose, list):
        return np.array(pose)
    matrix = np.eye(4)
    matrix[:3, 3] = pose.xyz
    if pose.rpy is not None and pose.quaternion is not None:
        raise InputError(f"{location}.pose: it has both rpy and quaternion; give one of them")
    if pose.rpy is not None:
        matrix[:3, :3] = rpy_rotation(pose.rpy)
    elif pose.quaternion is not None:
        norm = math.hypot(*pose.quaternion)
        if not abs(norm - 1) < _QUATERNION_NORM_TOLERANCE:
            raise InputError(f"{location}.pose: the quaternion (x, y, z, w) has length {norm:g}; it must be 1")
        matrix[:3, :3] = rotations_of_quaternions(pose.quaternion)
    return matrix


def _rotation_to_normal(normal: FloatArray, location: str) -> FloatArray:
    """Return the pose (4, 4) that rotates z onto a direction."""
    largest = np.abs(normal).max()
    if not largest > 0:
        raise InputError(f"{location}.half_space: the direction is 0, 0, 0; give the one that points out of it")
    z, pose = normal / largest, np.eye(4)
    z /= np.linalg.norm(z)
    if z[2] > 1 - 1e-15:
        return pose
    x = np.cross(np.eye(3)[np.abs(z).argmin()], z)
    x /= np.linalg.norm(x)
    pose[:3, :3] = np.stack([x, np.cross(z, x), z], axis=1)
    return pose


# ---- writing -----------------------------------------------------------------------------------------------------


def format_cell(data: dict[str, Any]) -> str:
    """Return the text of a file with the given keys and values."""
    return yaml.safe_dump(data, sort_keys=False, allow_unicode=True, default_flow_style=None, width=128)


def object_to_dict(solid: Solid) -> dict[str, Any]:
    """Return an object's keys and values with all digits; a file is named by its full path.

    Raises:
        InputError: A file cannot store an object of this kind.
    """
    match solid:
        case Box():
            entry: dict[str, Any] = {"box": solid.size.tolist()}
        case Cylinder() | Capsule():
            entry = {type(solid).__name__.lower(): {"radius": float(solid.radius), "length": float(solid.length)}}
        case Sphere():
            entry = {"sphere": float(solid.radius)}
        case HalfSpace():
            entry = {"half_space": [0.0, 0.0, 1.0]}
        case Mesh():
            surface = solid.surface  # in m, with its scale already applied
            triangles = {"vertices": surface.vertices.tolist(), "faces": surface.faces.tolist()}
            entry = {"mesh": triangles if solid.source is None else str(solid.source.path)}
            entry |= {"scale": float(solid.scale)} if solid.source is not None else {}
            entry |= {"solid": solid.solid}
        case Points():
            entry = {"points": solid.centres.tolist() if solid.source is None else str(solid.source.path)}
            entry |= {"radius": float(solid.radius)}
        case _:
            raise InputError(f"object '{solid.name}' is a {type(solid).__name__}, which a file cannot store")
    if not np.array_equal(solid.pose, np.eye(4)):
        is_rotated = not np.array_equal(solid.pose[:3, :3], np.eye(3))
        entry["pose"] = solid.pose.tolist() if is_rotated else {"xyz": solid.pose[:3, 3].tolist()}
    return entry | ({"margin": float(solid.margin)} if solid.margin else {})


def cell_file_error(path: Path, error: HoldfastError) -> InputError:
    """Return the error for a cell file that cannot be used."""
    return InputError(f"cell file '{path}': {error}")
