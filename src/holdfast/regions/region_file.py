"""Region files: YAML, validated.

.. code-block:: yaml

    format: 2              # roll, pitch, yaw as in URDF; without this line they are read as in format 1, see below
    name: in front of the cell door
    angles: deg            # unit of the angles below; rad if not given
    box:
      center: [0.968, 0, 0.041]      # m, in the world
      size: 0.5                      # m, an edge or three
      rpy_center: [0, 174, 0]        # roll, pitch, yaw: R = Rz(yaw) Ry(pitch) Rx(roll)
      rpy_size: 90                   # full range, one or three

In place of the two rpy keys, ``cone: {axis: [0, 0, -1], within: 30}`` makes the tool's z axis uniform on the spherical cap
within 30 degrees (always degrees) of an axis in the world, with any turn about the z axis.

``order: abdi`` takes roll, pitch, yaw as ``R = Rz(roll) Ry(pitch) Rx(yaw)``, the order of Abdi et al. 2012. Format 1, a file
without ``format:``, is always read so: files that were written for it keep their meaning.

In a box, ``density: {z: [[0.0, 1], [0.5, 3]]}`` makes poses count more where the robot works more: points of coordinate
(x, y, z, m; roll, pitch, yaw, in the unit of the angles) and weight, linear between them; coordinates are multiplied.

For configurations instead of poses, ``joints:`` with the lists ``lower`` and ``upper``, rad and m; for a list of poses,
``poses: file.csv``, relative to the region file, a table with the header x,y,z,qx,qy,qz,qw and perhaps weight.
"""

from __future__ import annotations

import reprlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, ValidationError

from holdfast.errors import InputError
from holdfast.files.yaml import content
from holdfast.regions.pose_list import PoseList


def read(file: Path) -> tuple[Literal["box", "cone", "joints", "poses"], dict[str, Any]]:
    """The kind of region in a file, and the arguments that make it; see :meth:`holdfast.Region.load`."""
    try:
        data = content(file, "holdfast.regions.region_file", "box, joints or poses")
    except InputError as error:
        raise InputError(f"region file '{file}': {error}") from error
    try:
        model = _RegionFile.model_validate(data)
    except ValidationError as error:
        raise InputError(f"region file '{file}': {_first(error)}") from error
    if [model.box, model.joints, model.poses].count(None) != 2:
        raise InputError(f"region file '{file}' must hold either 'box:' or 'joints:' or 'poses:'")
    if model.box is None and model.angles == "deg":
        raise InputError(f"region file '{file}': 'angles: deg' goes with 'box:'; joint values are in rad and m")
    name = model.name or file.stem
    unit = np.pi / 180 if model.angles == "deg" else 1.0
    if model.box is not None:
        b = model.box
        scale = {"roll": unit, "pitch": unit, "yaw": unit}
        density = {c: [(x * scale.get(c, 1.0), w) for x, w in points] for c, points in (b.density or {}).items()}
        size, turn = np.broadcast_to(b.size, 3), np.broadcast_to(0.0 if b.rpy_size is None else b.rpy_size, 3) * unit
        if b.cone is not None:
            if b.rpy_center is not None or b.rpy_size is not None:
                raise InputError(f"region file '{file}': box.cone takes the place of rpy_center and rpy_size; leave them out")
            cone = {"axis": b.cone.axis, "within": float(np.deg2rad(b.cone.within))}
            return "cone", {"center": b.center, "size": size, **cone, "name": name, "weight": density or None}
        if model.format == 1 and model.order == "urdf":
            raise InputError(f"region file '{file}': 'order: urdf' needs 'format: 2'; add that line")
        order = model.order or ("urdf" if model.format == 2 else "abdi")
        given = {"center": b.center, "size": size, "rpy_center": np.multiply(b.rpy_center or (0, 0, 0), unit), "rpy_size": turn}
        return "box", {**given, "name": name, "weight": density or None, "order": order}
    if model.poses is not None:
        try:
            return "poses", {"name": name, "listed": PoseList.read(file.parent / model.poses)}
        except InputError as error:
            raise InputError(f"region file '{file}': {error}") from error
    assert model.joints is not None
    return "joints", {"lower": model.joints.lower, "upper": model.joints.upper, "name": name}


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)


class _Cone(_Strict):
    axis: tuple[float, float, float]
    within: float


class _Box(_Strict):
    center: tuple[float, float, float]
    size: float | tuple[float, float, float]
    rpy_center: tuple[float, float, float] | None = None
    rpy_size: float | tuple[float, float, float] | None = None
    cone: _Cone | None = None
    density: dict[str, list[tuple[float, float]]] | None = None


class _Joints(_Strict):
    lower: list[float]
    upper: list[float]


class _RegionFile(_Strict):
    format: Literal[1, 2] = 1
    order: Literal["urdf", "abdi"] | None = None
    name: str | None = None
    angles: Literal["deg", "rad"] = "rad"
    box: _Box | None = None
    joints: _Joints | None = None
    poses: str | None = None


def _first(error: ValidationError) -> str:
    entry = error.errors()[0]
    place = _place([x for x in entry["loc"] if x not in ("float", "tuple[float, float, float]")])
    if entry["loc"][-1:] == ("float",) and isinstance(entry.get("input"), (list, tuple)):
        return f"{place}: must be one number or 3, got {reprlib.repr(entry['input'])}"
    if entry["type"] == "extra_forbidden":
        known = _known_keys(entry["loc"][:-1])
        return f"key '{place}' is not known; keys there are {', '.join(known)}"
    if entry["type"] == "missing":
        return f"key '{place}' is missing"
    return f"{place}: {entry['msg'].lower()}, got {reprlib.repr(entry.get('input'))}"


def _place(loc: Sequence[int | str]) -> str:
    return ".".join(str(x) for x in loc)


def _known_keys(loc: Sequence[int | str]) -> list[str]:
    model: type[BaseModel] = _RegionFile
    if loc:
        model = _Cone if "cone" in loc else _Box if loc[0] == "box" else _Joints
    return list(model.model_fields)
