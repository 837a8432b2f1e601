"""Path files: YAML, validated.

.. code-block:: yaml

    name: along the glove box
    angles: deg               # unit of urdf_rpy and angle below; rad if not given
    line:                     # this, arc or poses
      from: {xyz: [0.4, -0.3, 0.5], urdf_rpy: [180, 0, 0]}    # m, world; roll, pitch, yaw as URDF: Rz(yaw) Ry(pitch) Rx(roll)
      to: {xyz: [0.4, 0.3, 0.5], quaternion: [1, 0, 0, 0]}    # or x, y, z, w
    timing:                   # not needed for the path alone
      duration: 10            # s
      accelerate: 0.2         # shares of the duration in which the speed rises and falls; 0.2 if not given
      decelerate: 0.2
      stop: false             # true: stop at each corner

Other paths::

    arc: {from: {xyz: [1, 0, 0]}, via: {xyz: [0, 1, 0]}, to: {xyz: [-1, 0, 0]}}
    arc: {from: {xyz: [1, 0, 0]}, center: [0, 0, 0], axis: [0, 0, 1], angle: 180, turning: false}
    poses: [{xyz: [0, 0, 1]}, {xyz: [0.5, 0, 1]}, {xyz: [0.5, 0.5, 1]}]    # straight lines between them
    poses: poses.csv          # next to this file; first line x,y,z or x,y,z,qx,qy,qz,qw

Where no pose has an orientation, none is asked for (task ``position``). A pose without one takes that of the pose before.
"""

from __future__ import annotations

import csv
import pathlib
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Discriminator, Field, Tag, ValidationError

from holdfast.arm.poses import rotations_of_quaternions
from holdfast.arm.urdf import rpy_rotation
from holdfast.errors import InputError
from holdfast.files import reading
from holdfast.files.yaml import Four, Number, Strict, Three, content, sentence

Array = NDArray[np.float64]

Shape = Literal["line", "arc", "sequence"]
POSITION, ORIENTATION = ("x", "y", "z"), ("qx", "qy", "qz", "qw")


def read(path: pathlib.Path) -> tuple[Shape, dict[str, Any], dict[str, float] | None, bool]:
    """The shape of the path in a file and its arguments; those of its timing, if it has one; whether to stop at corners.

    Raises:
        InputError: Unreadable, or a key that is unknown, missing or wrong; the message names it.
    """
    try:
        model = _PathFile.model_validate(content(path, "holdfast.paths.path_file", "line, arc or poses"))
        timing = model.timing
        if timing is None:
            return *_path(model, path), None, False
        return *_path(model, path), timing.model_dump(exclude={"stop"}), timing.stop
    except ValidationError as error:
        raise InputError(f"path file '{path}': {sentence(error, _PathFile, TAGS)}") from error
    except InputError as error:
        raise InputError(f"path file '{path}': {error}") from error


class _Pose(Strict):
    xyz: Three
    urdf_rpy: Three | None = None
    quaternion: Four | None = None


class _Line(Strict):
    start: _Pose = Field(alias="from")
    to: _Pose


class _Arc(Strict):
    start: _Pose = Field(alias="from")
    via: _Pose | None = None
    to: _Pose | None = None
    center: Three | None = None
    axis: Three | None = None
    angle: Number | None = None
    turning: bool = False


class _Timing(Strict):
    duration: Number
    accelerate: Number = 0.2
    decelerate: Number = 0.2
    stop: bool = False


TAGS = ("as a list", "as a file")


class _PathFile(Strict):
    name: str | None = None
    angles: Literal["deg", "rad"] = "rad"
    line: _Line | None = None
    arc: _Arc | None = None
    poses: (
        Annotated[
            Annotated[list[_Pose], Tag(TAGS[0])] | Annotated[str, Tag(TAGS[1])],
            Discriminator(lambda value: TAGS[1] if isinstance(value, str) else TAGS[0]),
        ]
        | None
    ) = None
    timing: _Timing | None = None


def _path(model: _PathFile, file: pathlib.Path) -> tuple[Shape, dict[str, Any]]:
    unit = np.pi / 180 if model.angles == "deg" else 1.0
    name = model.name or file.stem
    if sum(x is not None for x in (model.line, model.arc, model.poses)) != 1:
        raise InputError("it must hold one of 'line:', 'arc:' and 'poses:'")
    if model.line is not None:
        first, last = _pose(model.line.start, unit, "line.from"), _pose(model.line.to, unit, "line.to")
        return "line", {"start": first, "end": last, "name": name}
    if model.arc is not None:
        a = model.arc
        via, end = (None if p is None else _pose(p, unit, f"arc.{key}") for key, p in (("via", a.via), ("to", a.to)))
        angle = None if a.angle is None else a.angle * unit
        start = _pose(a.start, unit, "arc.from")
        given = {"start": start, "via": via, "end": end, "center": a.center, "axis": a.axis, "angle": angle}
        return "arc", {**given, "turning": a.turning, "name": name}
    if isinstance(model.poses, str):
        return "sequence", {"poses": pose_table(file.parent / model.poses), "name": name}
    assert model.poses is not None
    return "sequence", {"poses": [_pose(p, unit, f"poses[{k}]") for k, p in enumerate(model.poses)], "name": name}


def _pose(pose: _Pose, unit: float, place: str) -> Array:
    """(4, 4), or (3,) where there is no orientation."""
    if pose.urdf_rpy is not None and pose.quaternion is not None:
        raise InputError(f"{place}: it has both urdf_rpy and quaternion; give one of them")
    if pose.urdf_rpy is not None:
        return _whole(pose.xyz, rpy_rotation([angle * unit for angle in pose.urdf_rpy]))
    if pose.quaternion is not None:
        return _whole(pose.xyz, _rotation(np.array(pose.quaternion), place))
    return np.array(pose.xyz)


def _whole(xyz: list[float] | Array, rotation: Array) -> Array:
    out = np.eye(4)
    out[:3, :3], out[:3, 3] = rotation, xyz
    return out


def _rotation(quaternion: Array, place: str) -> Array:
    size = float(np.linalg.norm(quaternion))
    if not abs(size - 1) < 1e-2:  # files may round
        raise InputError(f"{place}: the quaternion (x, y, z, w) has length {size:g}; it must be 1")
    return rotations_of_quaternions(quaternion)


def pose_table(file: pathlib.Path, option: str = "poses") -> list[Array]:
    """Poses of a CSV file, one a line below the names of the columns.

    Args:
        file: The first line is ``x,y,z`` or ``x,y,z,qx,qy,qz,qw``, in any order; m, world.
        option: Where the file was named, for messages.

    Returns:
        (4, 4) each, or (3,) where the file has no orientations.

    Raises:
        InputError: What is wrong with which row.
    """
    try:
        with reading.guarded(f"{option}: '{file.name}'", "give a CSV file that exists"):
            lines = [[cell.strip() for cell in row] for row in csv.reader(reading.text(file).splitlines()) if row]
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{option}: '{file.name}' is not a CSV file ({error})") from error
    names = tuple(lines[0]) if lines else ()
    if sorted(names) not in (sorted(POSITION), sorted(POSITION + ORIENTATION)):
        raise InputError(
            f"{option}: the first line of '{file.name}' must be x,y,z or x,y,z,qx,qy,qz,qw; it is {','.join(names)}"
        )
    poses = []
    for k, cells in enumerate(lines[1:]):
        place = f"{option}: '{file.name}', row {k + 1}"
        try:
            row = dict(zip(names, map(float, cells), strict=True))
        except ValueError as error:
            raise InputError(f"{place}: it must hold {len(names)} numbers, got {','.join(cells)}") from error
        if not np.isfinite(list(row.values())).all():
            raise InputError(f"{place}: it holds NaN or infinity; all numbers must be finite")
        xyz = np.array([row[x] for x in POSITION])
        whole = len(names) > 3
        poses.append(_whole(xyz, _rotation(np.array([row[x] for x in ORIENTATION]), place)) if whole else xyz)
    return poses
