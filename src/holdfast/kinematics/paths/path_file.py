"""Read and validate path files in YAML.

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

If no pose has an orientation, none is prescribed (task ``position``). A pose without orientation takes the previous one's.
"""

from __future__ import annotations

import pathlib
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Discriminator, Field, Tag, ValidationError

from holdfast.core.errors import InputError
from holdfast.core.files.csv_table import read_csv_table
from holdfast.core.files.yaml import Four, Number, Strict, Three, describe_validation_error, read_mapping
from holdfast.core.typing import FloatArray
from holdfast.model.arm.formats.urdf import rpy_rotation
from holdfast.model.arm.poses import rotations_of_quaternions

Shape = Literal["line", "arc", "sequence"]
POSITION_COLUMNS = ("x", "y", "z")
QUATERNION_COLUMNS = ("qx", "qy", "qz", "qw")


def parse_path_file(path: pathlib.Path) -> tuple[Shape, dict[str, Any], dict[str, float] | None, bool]:
    """Return the shape of the path in a file, its arguments, those of its timing or None, and whether to stop at corners.

    Raises:
        InputError: The file cannot be read, or a key is unknown, missing or wrong; the message names it.
    """
    try:
        model = _PathFile.model_validate(read_mapping(path, "holdfast.kinematics.paths.path_file", "line, arc or poses"))
        timing = model.timing
        if timing is None:
            return *_shape_and_arguments(model, path), None, False
        return *_shape_and_arguments(model, path), timing.model_dump(exclude={"stop"}), timing.stop
    except ValidationError as error:
        raise InputError(f"path file '{path}': {describe_validation_error(error, _PathFile, POSE_LIST_TAGS)}") from error
    except InputError as error:
        raise InputError(f"path file '{path}': {error}") from error


class _PoseEntry(Strict):
    xyz: Three
    urdf_rpy: Three | None = None
    quaternion: Four | None = None


class _LineEntry(Strict):
    start: _PoseEntry = Field(alias="from")
    to: _PoseEntry


class _ArcEntry(Strict):
    start: _PoseEntry = Field(alias="from")
    via: _PoseEntry | None = None
    to: _PoseEntry | None = None
    center: Three | None = None
    axis: Three | None = None
    angle: Number | None = None
    turning: bool = False


class _TimingEntry(Strict):
    duration: Number
    accelerate: Number = 0.2
    decelerate: Number = 0.2
    stop: bool = False


POSE_LIST_TAGS = ("as a list", "as a file")


class _PathFile(Strict):
    name: str | None = None
    angles: Literal["deg", "rad"] = "rad"
    line: _LineEntry | None = None
    arc: _ArcEntry | None = None
    poses: (
        Annotated[
            Annotated[list[_PoseEntry], Tag(POSE_LIST_TAGS[0])] | Annotated[str, Tag(POSE_LIST_TAGS[1])],
            Discriminator(lambda value: POSE_LIST_TAGS[1] if isinstance(value, str) else POSE_LIST_TAGS[0]),
        ]
        | None
    ) = None
    timing: _TimingEntry | None = None


def _shape_and_arguments(model: _PathFile, file: pathlib.Path) -> tuple[Shape, dict[str, Any]]:
    radians_per_unit = np.pi / 180 if model.angles == "deg" else 1.0
    name = model.name or file.stem
    if sum(entry is not None for entry in (model.line, model.arc, model.poses)) != 1:
        raise InputError("it must hold one of 'line:', 'arc:' and 'poses:'")
    if model.line is not None:
        start_pose = _pose_array(model.line.start, radians_per_unit, "line.from")
        end_pose = _pose_array(model.line.to, radians_per_unit, "line.to")
        return "line", {"start": start_pose, "end": end_pose, "name": name}
    if model.arc is not None:
        arc = model.arc
        via, end = (
            None if pose_entry is None else _pose_array(pose_entry, radians_per_unit, f"arc.{field_name}")
            for field_name, pose_entry in (("via", arc.via), ("to", arc.to))
        )
        angle = None if arc.angle is None else arc.angle * radians_per_unit
        arc_start = _pose_array(arc.start, radians_per_unit, "arc.from")
        arguments = {"start": arc_start, "via": via, "end": end, "center": arc.center, "axis": arc.axis, "angle": angle}
        return "arc", {**arguments, "turning": arc.turning, "name": name}
    if isinstance(model.poses, str):
        return "sequence", {"poses": read_pose_table(file.parent / model.poses), "name": name}
    assert model.poses is not None
    return "sequence", {
        "poses": [_pose_array(pose_entry, radians_per_unit, f"poses[{index}]") for index, pose_entry in enumerate(model.poses)],
        "name": name,
    }


def _pose_array(pose: _PoseEntry, radians_per_unit: float, location: str) -> FloatArray:
    """Return a pose (4, 4), or a position (3,) without an orientation."""
    if pose.urdf_rpy is not None and pose.quaternion is not None:
        raise InputError(f"{location}: it has both urdf_rpy and quaternion; give one of them")
    if pose.urdf_rpy is not None:
        return _assemble_pose(pose.xyz, rpy_rotation([angle * radians_per_unit for angle in pose.urdf_rpy]))
    if pose.quaternion is not None:
        return _assemble_pose(pose.xyz, _rotation_matrix(np.array(pose.quaternion), location))
    return np.array(pose.xyz)


def _assemble_pose(xyz: list[float] | FloatArray, rotation: FloatArray) -> FloatArray:
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rotation, xyz
    return pose


def _rotation_matrix(quaternion: FloatArray, location: str) -> FloatArray:
    norm = float(np.linalg.norm(quaternion))
    if not abs(norm - 1) < 1e-2:  # files may contain rounded numbers
        raise InputError(f"{location}: the quaternion (x, y, z, w) has length {norm:g}; it must be 1")
    return rotations_of_quaternions(quaternion)


def read_pose_table(file: pathlib.Path, option: str = "poses") -> list[FloatArray]:
    """Return the poses of a CSV file, one per line below the names of the columns.

    Args:
        file: File whose first line is ``x,y,z`` or ``x,y,z,qx,qy,qz,qw``, in any order; m, world.
        option: Name of the option with the file, for messages.

    Returns:
        Poses (4, 4), or positions (3,) if the file has no orientations.

    Raises:
        InputError: A row is wrong; the message names the row and the problem.
    """
    table = read_csv_table(file, f"{option}: '{file.name}'")
    names = (*POSITION_COLUMNS, *QUATERNION_COLUMNS)[: 3 if len(table.header) == 3 else 7]
    if sorted(table.header) != sorted(names):
        raise InputError(
            f"{option}: the first line of '{file.name}' must be x,y,z or x,y,z,qx,qy,qz,qw; it is {','.join(table.header)}"
        )
    rows = table.select_columns(names) if table.numbered_lines else np.zeros((0, len(names)))
    if len(names) == 3:
        return list(rows)
    return [
        _assemble_pose(row[:3], _rotation_matrix(row[3:], f"{table.title}, line {number}"))
        for (number, _), row in zip(table.numbered_lines, rows, strict=True)
    ]
