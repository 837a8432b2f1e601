"""Cells from YAML files.

An example with every key; only ``objects``, and one kind in each object, must be there::

    name: bench               # default: the file's name
    margin: 0.01              # what is kept from everything at least, m; default 0
    objects:                  # each with a name of its own; poses in the world, lengths in m
      table: {box: [0.8, 1.2, 0.04], pose: {xyz: [0.5, 0, -0.02]}}      # full sizes, as URDF
      post:                                                             # along its z; rpy in rad as URDF
        {cylinder: {radius: 0.05, length: 1.0}, pose: {xyz: [0.2, 0.55, 0.5], rpy: [0, 0.1, 0]}}
      pipe:                                                             # length between the centres of its ends; x, y, z, w
        {capsule: {radius: 0.04, length: 0.6}, pose: {xyz: [0.6, 0, 0.9], quaternion: [0, 0.6, 0, 0.8]}}
      ball: {sphere: 0.12, pose: {xyz: [0.45, 0.35, 0.8]}}
      ground: {half_space: [0, 0, 1], pose: {xyz: [0, 0, -0.8]}}        # all on the other side of the plane across this
      jig: {mesh: jig.stl, scale: 0.001, solid: exact}                  # STL OBJ GLB PLY beside this file; exact or hull
      scan: {points: scan.npy, radius: 0.005}                           # (N, 3) m; every point a ball
      sealed: {mesh: box.glb, solid: hull, margin: 0.03}                # own margin: the larger of the two counts
    held:                     # moves with the tool, as a part in the gripper; poses in the tool's frame
      - {capsule: {radius: 0.02, length: 0.15}, pose: {xyz: [0, 0, 0.08]}}
    may_touch:                # an object and a link, by the joint that moves it or base: not checked
      - [table, base]
      - [ball, panda_joint7]
    arm: {shape: meshes, spheres_to: 0.01, hold: {panda_finger_joint1: 0.04}}

``arm`` says what shape the arm has: ``meshes`` of its own file, ``assumed`` capsules, or a capsule file beside this one; how
far its spheres may reach beyond it, m; and where joints outside its chain are, rad or m. A pose may also be 4 rows of 4
numbers, a mesh ``{vertices: [...], faces: [...]}`` and points a list.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
import yaml
from numpy.typing import NDArray
from pydantic import Discriminator, Field, Tag, ValidationError

from holdfast.arm.poses import rotations_of_quaternions
from holdfast.arm.urdf import rpy_rotation
from holdfast.cell.meshes import Mesh, Points
from holdfast.cell.solids import Box, Capsule, Cylinder, HalfSpace, Solid, Sphere
from holdfast.errors import HoldfastError, InputError
from holdfast.files.yaml import Four, Number, Strict, Three, content, sentence

Array = NDArray[np.float64]
Positive = Annotated[Number, Field(gt=0)]
Least = Annotated[Number, Field(ge=0)]

EXAMPLE = "holdfast.cell.cell_file"
SHAPES = ("", "meshes", "assumed")  # of the arm; every other is a capsule file
KINDS = ("box", "cylinder", "capsule", "sphere", "half_space", "mesh", "points")
_HELD = KINDS[:4]
_UNIT = 1e-2  # files may round the numbers of a unit quaternion


class _Placement(Strict):
    xyz: Three = Field(default_factory=lambda: [0.0, 0.0, 0.0])
    rpy: Three | None = None
    quaternion: Four | None = None


class _Round(Strict):
    radius: Positive
    length: Positive


class _Surface(Strict):
    vertices: list[Three]
    faces: list[Three]


TAGS = ("as rows", "as xyz and rpy", "as a list", "as a file", "as vertices and faces")
_Pose = Annotated[
    Annotated[list[Four], Field(min_length=4, max_length=4), Tag(TAGS[0])] | Annotated[_Placement, Tag(TAGS[1])],
    Discriminator(lambda value: TAGS[0] if isinstance(value, list) else TAGS[1]),
]
_Cloud = Annotated[
    Annotated[list[Three], Tag(TAGS[2])] | Annotated[str, Tag(TAGS[3])],
    Discriminator(lambda value: TAGS[2] if isinstance(value, list) else TAGS[3]),
]
_Mesh = Annotated[
    Annotated[str, Tag(TAGS[3])] | Annotated[_Surface, Tag(TAGS[4])],
    Discriminator(lambda value: TAGS[4] if isinstance(value, dict) else TAGS[3]),
]


class _Object(Strict):
    box: Annotated[list[Positive], Field(min_length=3, max_length=3)] | None = None
    cylinder: _Round | None = None
    capsule: _Round | None = None
    sphere: Positive | None = None
    half_space: Three | None = None
    mesh: _Mesh | None = None
    points: _Cloud | None = None
    scale: Positive | None = None
    solid: Literal["exact", "hull"] | None = None
    radius: Positive | None = None
    pose: _Pose | None = None
    margin: Least = 0.0


class _Shape(Strict):
    shape: str | None = None
    spheres_to: Positive | None = None
    hold: dict[str, Number] = Field(default_factory=dict)


class File(Strict):
    """A file's keys and values."""

    objects: dict[str, _Object]
    name: str | None = None
    margin: Least = 0.0
    held: list[_Object] = Field(default_factory=list)
    may_touch: list[Annotated[list[str], Field(min_length=2, max_length=2)]] = Field(default_factory=list)
    arm: _Shape = Field(default_factory=_Shape)


def read(path: Path) -> dict[str, Any]:
    """The keys and values in a file, not checked yet.

    Raises:
        InputError: It cannot be read or is not YAML.
    """
    return {"name": path.stem} | content(path, EXAMPLE, "objects")


def parse(data: dict[str, Any], folder: Path) -> dict[str, Any]:
    """What :class:`holdfast.Cell` takes, of a file's keys and values.

    Args:
        data: The keys and values.
        folder: Where the files that it names are.

    Raises:
        InputError: A key is unknown, missing or wrong, or a file that it names; the sentence says where.
    """
    try:
        told = File.model_validate(data)
    except ValidationError as error:
        raise InputError(sentence(error, File, TAGS)) from error
    return {
        "objects": [_solid(name, entry, f"objects.{name}", folder) for name, entry in told.objects.items()],
        "name": told.name or "cell",
        "margin": told.margin,
        "held": [_held(k, entry, folder) for k, entry in enumerate(told.held)],
        "may_touch": [(a, b) for a, b in told.may_touch],
        **told.arm.model_dump(exclude_none=True),
        "shape": shape if (shape := told.arm.shape or "") in SHAPES else str(folder / shape),
    }


def _held(number: int, entry: _Object, folder: Path) -> Solid:
    place = f"held[{number}]"
    found = _solid(f"held {number + 1}", entry, place, folder)
    if _kind(entry, place) not in _HELD:
        raise InputError(f"{place}: a {_kind(entry, place)} cannot be held; use {', '.join(_HELD)}")
    return found


def _kind(entry: _Object, place: str) -> str:
    found = [kind for kind in KINDS if getattr(entry, kind) is not None]
    if len(found) != 1:
        said = "no kind" if not found else " and ".join(found)
        raise InputError(f"{place}: it has {said}; give one of {', '.join(KINDS)}")
    only = {"scale": "mesh", "solid": "mesh", "radius": "points"}
    wrong = next((key for key, kind in only.items() if getattr(entry, key) is not None and found[0] != kind), None)
    if wrong is not None:
        raise InputError(f"{place}: {wrong} is for {only[wrong]} alone, and this is a {found[0]}; leave it out")
    return found[0]


def _solid(name: str, entry: _Object, place: str, folder: Path) -> Solid:
    kind = _kind(entry, place)
    about: dict[str, Any] = {"pose": _pose(entry.pose, place), "margin": entry.margin}
    value: Any = getattr(entry, kind)
    match kind:
        case "box":
            return Box(name, np.array(value), **about)
        case "cylinder" | "capsule":
            return (Cylinder if kind == "cylinder" else Capsule)(name, value.radius, value.length, **about)
        case "sphere":
            return Sphere(name, value, **about)
        case "half_space":
            return HalfSpace(name, **about | {"pose": about["pose"] @ _upright(np.array(value), place)})
        case "mesh":
            shape = str(folder / value) if isinstance(value, str) else (np.array(value.vertices), np.array(value.faces))
            return Mesh(name, shape, scale=entry.scale or 1.0, solid=entry.solid or "exact", **about)
    if entry.radius is None:
        raise InputError(f"{place}.radius: it is missing; every point is a ball of this radius, m")
    return Points(name, str(folder / value) if isinstance(value, str) else np.array(value), radius=entry.radius, **about)


def _pose(pose: list[list[float]] | _Placement | None, place: str) -> Array:
    if pose is None:
        return np.eye(4)
    if isinstance(pose, list):
        return np.array(pose)
    out = np.eye(4)
    out[:3, 3] = pose.xyz
    if pose.rpy is not None and pose.quaternion is not None:
        raise InputError(f"{place}.pose: it has both rpy and quaternion; give one of them")
    if pose.rpy is not None:
        out[:3, :3] = rpy_rotation(pose.rpy)
    elif pose.quaternion is not None:
        size = math.hypot(*pose.quaternion)
        if not abs(size - 1) < _UNIT:
            raise InputError(f"{place}.pose: the quaternion (x, y, z, w) has length {size:g}; it must be 1")
        out[:3, :3] = rotations_of_quaternions(pose.quaternion)
    return out


def _upright(normal: Array, place: str) -> Array:
    """(4, 4) rotation of z onto a direction."""
    largest = np.abs(normal).max()
    if not largest > 0:
        raise InputError(f"{place}.half_space: the direction is 0, 0, 0; give the one that points out of it")
    z, out = normal / largest, np.eye(4)
    z /= np.linalg.norm(z)
    if z[2] > 1 - 1e-15:
        return out
    x = np.cross(np.eye(3)[np.abs(z).argmin()], z)
    x /= np.linalg.norm(x)
    out[:3, :3] = np.stack([x, np.cross(z, x), z], axis=1)
    return out


# ---- writing -----------------------------------------------------------------------------------------------------


def text(data: dict[str, Any]) -> str:
    """A file of keys and values."""
    return yaml.safe_dump(data, sort_keys=False, allow_unicode=True, default_flow_style=None, width=128)


def entry_of(solid: Solid) -> dict[str, Any]:
    """An object's keys and values, every digit kept; a file is named by its whole path.

    Raises:
        InputError: It is no kind that a file can hold.
    """
    match solid:
        case Box():
            said: dict[str, Any] = {"box": solid.size.tolist()}
        case Cylinder() | Capsule():
            said = {type(solid).__name__.lower(): {"radius": float(solid.radius), "length": float(solid.length)}}
        case Sphere():
            said = {"sphere": float(solid.radius)}
        case HalfSpace():
            said = {"half_space": [0.0, 0.0, 1.0]}
        case Mesh():
            said = {"mesh": _surface(solid) if solid.source is None else str(solid.source.path)}
            said |= {"scale": float(solid.scale)} if solid.source is not None else {}
            said |= {"solid": solid.solid}
        case Points():
            said = {"points": solid.centres.tolist() if solid.source is None else str(solid.source.path)}
            said |= {"radius": float(solid.radius)}
        case _:
            raise InputError(f"object '{solid.name}' is a {type(solid).__name__}, which no file can hold")
    if not np.array_equal(solid.pose, np.eye(4)):
        turned = not np.array_equal(solid.pose[:3, :3], np.eye(3))
        said["pose"] = solid.pose.tolist() if turned else {"xyz": solid.pose[:3, 3].tolist()}
    return said | ({"margin": float(solid.margin)} if solid.margin else {})


def _surface(solid: Mesh) -> dict[str, Any]:
    """Its triangles, in m: what the scale was is in them."""
    return {"vertices": solid.surface.vertices.tolist(), "faces": solid.surface.faces.tolist()}


def refused(path: Path, error: HoldfastError) -> InputError:
    """The sentence for a file that cannot be used."""
    return InputError(f"cell file '{path}': {error}")
