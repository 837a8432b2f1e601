"""Read and validate region files in YAML.

.. code-block:: yaml

    format: 2              # roll, pitch, yaw as in URDF; without this line they are read as in format 1, see below
    name: in front of the cell door
    angles: deg            # unit of the angles below; rad if not given
    box:
      center: [0.968, 0, 0.041]      # m, in the world
      size: 0.5                      # m, an edge or three
      rpy_center: [0, 174, 0]        # roll, pitch, yaw: R = Rz(yaw) Ry(pitch) Rx(roll)
      rpy_size: 90                   # full range, one or three

Instead of the two rpy keys, ``cone: {axis: [0, 0, -1], within: 30}`` makes the tool's z axis uniform on the spherical cap
within 30 degrees (always degrees) of an axis in the world, with any rotation about the z axis.

``order: abdi`` reads roll, pitch, yaw as ``R = Rz(roll) Ry(pitch) Rx(yaw)``, the order of Abdi et al. 2012. Format 1, a file
without ``format:``, always has this order, so files that were written for it keep their meaning.

In a box, ``density: {z: [[0.0, 1], [0.5, 3]]}`` gives more weight to poses where the robot works more often: points of
coordinate (x, y, z, m; roll, pitch, yaw, in the unit of the angles) and weight, linear between them; coordinates are
multiplied.

For configurations instead of poses, write ``joints:`` with the lists ``lower`` and ``upper``, rad and m. For a list of poses,
write ``poses: file.csv``, relative to the region file, a table with the header x,y,z,qx,qy,qz,qw and an optional weight.
"""

from __future__ import annotations

import reprlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, ValidationError

from holdfast.core.errors import InputError
from holdfast.core.files.yaml import read_mapping
from holdfast.kinematics.regions.pose_list import PoseList


def read_region_file(file: Path) -> tuple[Literal["box", "cone", "joints", "poses"], dict[str, Any]]:
    """Return the kind of region in a file, and the arguments that construct it; see :meth:`holdfast.Region.load`."""
    try:
        data = read_mapping(file, "holdfast.kinematics.regions.region_file", "box, joints or poses")
    except InputError as error:
        raise InputError(f"region file '{file}': {error}") from error
    try:
        model = _RegionFile.model_validate(data)
    except ValidationError as error:
        raise InputError(f"region file '{file}': {_first_error_message(error)}") from error
    if [model.box, model.joints, model.poses].count(None) != 2:
        raise InputError(f"region file '{file}' must hold either 'box:' or 'joints:' or 'poses:'")
    if model.box is None and model.angles == "deg":
        raise InputError(f"region file '{file}': 'angles: deg' goes with 'box:'; joint values are in rad and m")
    name = model.name or file.stem
    radians_per_unit = np.pi / 180 if model.angles == "deg" else 1.0
    if model.box is not None:
        box = model.box
        units_by_angle = {"roll": radians_per_unit, "pitch": radians_per_unit, "yaw": radians_per_unit}
        density = {
            coordinate: [(value * units_by_angle.get(coordinate, 1.0), weight_value) for value, weight_value in points]
            for coordinate, points in (box.density or {}).items()
        }
        size = np.broadcast_to(box.size, 3)
        angle_size = np.broadcast_to(0.0 if box.rpy_size is None else box.rpy_size, 3) * radians_per_unit
        if box.cone is not None:
            if box.rpy_center is not None or box.rpy_size is not None:
                raise InputError(f"region file '{file}': box.cone takes the place of rpy_center and rpy_size; leave them out")
            cone = {"axis": box.cone.axis, "within": float(np.deg2rad(box.cone.within))}
            return "cone", {"center": box.center, "size": size, **cone, "name": name, "weight": density or None}
        if model.format == 1 and model.order == "urdf":
            raise InputError(f"region file '{file}': 'order: urdf' needs 'format: 2'; add that line")
        order = model.order or ("urdf" if model.format == 2 else "abdi")
        common_arguments = {
            "center": box.center,
            "size": size,
            "rpy_center": np.multiply(box.rpy_center or (0, 0, 0), radians_per_unit),
            "rpy_size": angle_size,
        }
        return "box", {**common_arguments, "name": name, "weight": density or None, "order": order}
    if model.poses is not None:
        try:
            return "poses", {"name": name, "listed": PoseList.read_csv(file.parent / model.poses)}
        except InputError as error:
            raise InputError(f"region file '{file}': {error}") from error
    assert model.joints is not None
    return "joints", {"lower": model.joints.lower, "upper": model.joints.upper, "name": name}


class _StrictModel(BaseModel):
    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)


class _ConeEntry(_StrictModel):
    axis: tuple[float, float, float]
    within: float


class _BoxEntry(_StrictModel):
    center: tuple[float, float, float]
    size: float | tuple[float, float, float]
    rpy_center: tuple[float, float, float] | None = None
    rpy_size: float | tuple[float, float, float] | None = None
    cone: _ConeEntry | None = None
    density: dict[str, list[tuple[float, float]]] | None = None


class _JointsEntry(_StrictModel):
    lower: list[float]
    upper: list[float]


class _RegionFile(_StrictModel):
    format: Literal[1, 2] = 1
    order: Literal["urdf", "abdi"] | None = None
    name: str | None = None
    angles: Literal["deg", "rad"] = "rad"
    box: _BoxEntry | None = None
    joints: _JointsEntry | None = None
    poses: str | None = None


def _first_error_message(error: ValidationError) -> str:
    entry = error.errors()[0]
    location = ".".join(str(key) for key in entry["loc"] if key not in ("float", "tuple[float, float, float]"))
    if entry["loc"][-1:] == ("float",) and isinstance(entry.get("input"), (list, tuple)):
        return f"{location}: must be one number or 3, got {reprlib.repr(entry['input'])}"
    if entry["type"] == "extra_forbidden":
        known_keys = _known_keys(entry["loc"][:-1])
        return f"key '{location}' is not known; keys there are {', '.join(known_keys)}"
    if entry["type"] == "missing":
        return f"key '{location}' is missing"
    return f"{location}: {entry['msg'].lower()}, got {reprlib.repr(entry.get('input'))}"


def _known_keys(loc: Sequence[int | str]) -> list[str]:
    model: type[BaseModel] = _RegionFile
    if loc:
        model = _ConeEntry if "cone" in loc else _BoxEntry if loc[0] == "box" else _JointsEntry
    return list(model.model_fields)
