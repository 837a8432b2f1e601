"""The ``<visual>`` and ``<collision>`` elements of a URDF file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.urdf import read_origin, read_tree, robot_element
from holdfast.errors import ArmError, HoldfastError
from holdfast.files import mesh
from holdfast.shapes.meshes import find_mesh
from holdfast.shapes.pieces import Carriers, Kind, Missing, Piece, Place, Purpose

Array = NDArray[np.float64]

_SIZES = {"box": ("size",), "cylinder": ("radius", "length"), "capsule": ("radius", "length"), "sphere": ("radius",)}


def read(
    file: Path, arm: Arm, purpose: Purpose, hold: Mapping[str, float] | None, folder: Path | None, open_files: bool
) -> tuple[list[Piece], list[Missing]]:
    """See :func:`holdfast.shapes.reading.read_pieces`; ``folder`` has the meshes."""
    robot = robot_element(file)
    return collected(robot, file, purpose, Carriers(read_tree(robot, file.stem), arm, hold).place, folder, open_files)


def collected(
    robot: ElementTree.Element, file: Path, purpose: Purpose, place_of: Place, folder: Path | None, open_files: bool = True
) -> tuple[list[Piece], list[Missing]]:
    """The shapes of the links that have a place, and what of them could not be read."""
    materials = {m.get("name", ""): color for m in robot.findall("material") if (color := _rgba(m)) is not None}
    pieces: list[Piece] = []
    missing: list[Missing] = []
    for element in robot.findall("link"):
        owner = element.get("name", "")
        place = place_of(owner)
        if place is None:
            continue
        for shown in element.findall(purpose):
            shape = shown.find("geometry")
            if shape is None or not len(shape):
                continue
            try:
                pose = place[1] @ read_origin(shown, f"link '{owner}'")
                form = _form(shape[0], file, folder, open_files)
                pieces.append(Piece(link=place[0], owner=owner, pose=pose, rgba=_color(shown, materials), **form))
            except (ArmError, ValueError) as error:
                missing.append(Missing(place[0], str(error), isinstance(error, _UnreadableError)))
    return pieces, missing


class _UnreadableError(ArmError):
    """A mesh whose file was found and could not be read."""


def _form(element: ElementTree.Element, file: Path, folder: Path | None, open_files: bool) -> dict[str, Any]:
    """Kind, name, size and triangles of a piece."""
    nothing = (np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))
    if element.tag in _SIZES:
        size = tuple(x for key in _SIZES[element.tag] for x in _floats(element, key))
        if len(size) != (3 if element.tag == "box" else len(_SIZES[element.tag])) or min(size) <= 0:
            raise ArmError(f"{element.tag} whose size is not above 0")
        kind: Kind = cast(Kind, element.tag)
        return {"kind": kind, "name": kind, "size": size, "vertices": nothing[0], "faces": nothing[1]}
    if element.tag != "mesh":
        raise ArmError(f"shape '{element.tag}'; known are {', '.join([*_SIZES, 'mesh'])}")
    name = element.get("filename", "")
    found = find_mesh(name, file, folder) if open_files else None
    if found is None:
        raise ArmError(name)
    try:
        surface, _ = mesh.read(found)
    except HoldfastError as error:
        raise _UnreadableError(f"{name} ({error})") from error
    scale = np.array(_floats(element, "scale")) if element.get("scale") else np.ones(3)
    if scale.shape != (3,):
        raise ArmError(f"{name} (its scale must be 3 numbers)")
    return {"kind": "mesh", "name": name, "size": (), "vertices": surface.vertices * scale, "faces": surface.faces}


def _color(shown: ElementTree.Element, materials: dict[str, tuple[float, ...]]) -> tuple[float, ...] | None:
    material = shown.find("material")
    return None if material is None else _rgba(material) or materials.get(material.get("name", ""))


def _rgba(material: ElementTree.Element) -> tuple[float, ...] | None:
    color = material.find("color")
    return None if color is None else tuple(_floats(color, "rgba"))


def _floats(element: ElementTree.Element, key: str) -> list[float]:
    """The finite numbers of an attribute, at least one."""
    values = [float(x) for x in element.get(key, "").split()]
    if not values or not np.isfinite(values).all():
        raise ArmError(f"{element.tag} without {key}")
    return values
