"""Read the ``<visual>`` and ``<collision>`` elements of a URDF file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast
from xml.etree import ElementTree

import numpy as np

from holdfast.core.errors import ArmError, HoldfastError
from holdfast.core.files import mesh
from holdfast.model.arm.formats.mesh_files import find_mesh
from holdfast.model.arm.formats.urdf import read_origin, read_tree, robot_element
from holdfast.model.arm.model import Arm
from holdfast.model.shapes.pieces import Kind, LinkCarriers, Missing, Piece, Place, Purpose

_SIZE_ATTRIBUTES = {"box": ("size",), "cylinder": ("radius", "length"), "capsule": ("radius", "length"), "sphere": ("radius",)}


def read_urdf_pieces(
    file: Path, arm: Arm, purpose: Purpose, hold: Mapping[str, float] | None, folder: Path | None, open_files: bool
) -> tuple[list[Piece], list[Missing]]:
    """Return the shapes of a URDF file; see :func:`holdfast.model.shapes.reading.read_pieces`; ``folder`` has the meshes."""
    robot = robot_element(file)
    return collect_urdf_shapes(
        robot, file, purpose, LinkCarriers(read_tree(robot, file.stem), arm, hold).locate_link, folder, open_files
    )


def collect_urdf_shapes(
    robot: ElementTree.Element, file: Path, purpose: Purpose, find_pose: Place, folder: Path | None, open_files: bool = True
) -> tuple[list[Piece], list[Missing]]:
    """Return the shapes of the links that have a pose, and the shapes that could not be read."""
    materials = {
        material.get("name", ""): color for material in robot.findall("material") if (color := _read_rgba(material)) is not None
    }
    pieces: list[Piece] = []
    missing: list[Missing] = []
    for element in robot.findall("link"):
        owner = element.get("name", "")
        link_pose = find_pose(owner)
        if link_pose is None:
            continue
        for shown in element.findall(purpose):
            shape = shown.find("geometry")
            if shape is None or not len(shape):
                continue
            try:
                pose = link_pose[1] @ read_origin(shown, f"link '{owner}'")
                geometry = _read_geometry(shape[0], file, folder, open_files)
                pieces.append(Piece(link=link_pose[0], owner=owner, pose=pose, rgba=_find_color(shown, materials), **geometry))
            except (ArmError, ValueError) as error:
                missing.append(Missing(link_pose[0], str(error), isinstance(error, _UnreadableError)))
    return pieces, missing


class _UnreadableError(ArmError):
    """Mesh whose file was found but could not be read."""


def _read_geometry(element: ElementTree.Element, file: Path, folder: Path | None, open_files: bool) -> dict[str, Any]:
    """Read kind, name, size, and triangles of a shape."""
    nothing = (np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))
    if element.tag in _SIZE_ATTRIBUTES:
        size = tuple(x for key in _SIZE_ATTRIBUTES[element.tag] for x in _read_floats(element, key))
        if len(size) != (3 if element.tag == "box" else len(_SIZE_ATTRIBUTES[element.tag])) or min(size) <= 0:
            raise ArmError(f"{element.tag} whose size is not above 0")
        kind: Kind = cast(Kind, element.tag)
        return {"kind": kind, "name": kind, "size": size, "vertices": nothing[0], "faces": nothing[1]}
    if element.tag != "mesh":
        raise ArmError(f"shape '{element.tag}'; known are {', '.join([*_SIZE_ATTRIBUTES, 'mesh'])}")
    name = element.get("filename", "")
    mesh_path = find_mesh(name, file, folder) if open_files else None
    if mesh_path is None:
        raise ArmError(name)
    try:
        surface, _ = mesh.read_mesh(mesh_path)
    except HoldfastError as error:
        raise _UnreadableError(f"{name} ({error})") from error
    scale = np.array(_read_floats(element, "scale")) if element.get("scale") else np.ones(3)
    if scale.shape != (3,):
        raise ArmError(f"{name} (its scale must be 3 numbers)")
    return {"kind": "mesh", "name": name, "size": (), "vertices": surface.vertices * scale, "faces": surface.faces}


def _find_color(shown: ElementTree.Element, materials: dict[str, tuple[float, ...]]) -> tuple[float, ...] | None:
    material = shown.find("material")
    return None if material is None else _read_rgba(material) or materials.get(material.get("name", ""))


def _read_rgba(material: ElementTree.Element) -> tuple[float, ...] | None:
    color = material.find("color")
    return None if color is None else tuple(_read_floats(color, "rgba"))


def _read_floats(element: ElementTree.Element, key: str) -> list[float]:
    """Read the finite numbers of an attribute, at least one."""
    values = [float(x) for x in element.get(key, "").split()]
    if not values or not np.isfinite(values).all():
        raise ArmError(f"{element.tag} without {key}")
    return values
