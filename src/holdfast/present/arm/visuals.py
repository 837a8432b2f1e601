"""Shapes that a URDF file gives its links, where they can be read; only files beside it are opened."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.tree import Held, Tree
from holdfast.arm.urdf import read_origin, read_tree, robot_element
from holdfast.errors import ArmError
from holdfast.present.arm.body import LINK, Color, Part, ball, box, stick_parts, tube
from holdfast.report.viewer import thinned

Array = NDArray[np.float64]
MOST_TRIANGLES = 60_000  # of one mesh: more are not smoother, only slower
MOST_BYTES = 100 << 20  # of one file


def body_of(arm: Arm, size: float, meshes: bool = True) -> tuple[list[Part], str]:
    """What an arm is made of: the shapes of its URDF file where it has some, else sticks; and a note where meshes are missing.

    Args:
        arm: The arm.
        size: What sticks are drawn in proportion to, m.
        meshes: As in :func:`urdf_parts`.
    """
    sticks = stick_parts(arm, size)
    if arm.chain is None or not Path(arm.chain.file).is_file():
        return sticks, ""
    shapes, missing = urdf_parts(arm.chain.file, arm, arm.chain.base, meshes)
    if not shapes:
        return sticks, f"no mesh was found or read ({missing[0]}), so the arm is drawn as sticks" if missing else ""
    if missing:
        clad = {p.frame for p in shapes}
        shapes += [p for p in sticks if p.frame not in clad]
        return shapes, f"{len(missing)} of the file's meshes not found, such as {missing[0]}; such links are drawn as sticks"
    return shapes, ""


def urdf_parts(path: str | Path, arm: Arm, base: str | None = None, meshes: bool = True) -> tuple[list[Part], list[str]]:
    """The visual shapes of the links of an arm, in the frames of its bodies, and names of mesh files that were not found.

    Links that hang beside the chain on a moving joint are where the arm's mass has them.

    Args:
        path: The URDF file.
        arm: The arm that was read from it.
        base: The link that it is mounted on; the root if not given.
        meshes: Open the files of meshes; else all count as not found, and no file but the URDF is opened.
    """
    file = Path(path)
    robot = robot_element(file)
    tree = read_tree(robot, file.stem)
    still = Held(tree, set(arm.joint_names), {} if arm.chain is None else dict(arm.chain.held))
    materials = {m.get("name", ""): c for m in robot.findall("material") if (c := _rgba(m)) is not None}
    parts: list[Part] = []
    missing: list[str] = []
    for element in robot.findall("link"):
        place = _carried(tree, arm, still, element.get("name", ""), base or tree.root)
        if place is None:
            continue
        frame, pose = place
        for visual in element.findall("visual"):
            shape = visual.find("geometry")
            if shape is None or not len(shape):
                continue
            try:
                vertices, faces = _shape(shape[0], file if meshes else None)
                at = pose @ read_origin(visual, f"link '{element.get('name')}'")
            except (ArmError, ValueError) as error:
                missing.append(str(error))
                continue
            color = _color(visual, materials)
            parts.append(Part(frame, vertices @ at[:3, :3].T + at[:3, 3], faces, color))
    return parts, missing


def _carried(tree: Tree, arm: Arm, still: Held, link: str, base: str) -> tuple[int, Array] | None:
    """The frame of the arm that carries a link, and the link's pose in it; None for what does not hang on the base."""
    numbers = {name: k + 1 for k, name in enumerate(arm.joint_names)}
    pose = np.eye(4)
    while link != base:
        if link not in tree.above:
            return None
        joint = tree.above[link]
        if joint.name in numbers:
            return numbers[joint.name], pose
        pose = joint.at(still.value(joint)) @ pose
        link = joint.parent
    return 0, pose


def _shape(element: ElementTree.Element, file: Path | None) -> tuple[Array, NDArray[np.int64]]:
    if element.tag == "box":
        return box(np.array(_floats(element, "size")))
    if element.tag in ("cylinder", "capsule"):
        (radius,), (length,) = _floats(element, "radius"), _floats(element, "length")
        return tube(np.array([0, 0, -length / 2]), np.array([0, 0, length / 2]), radius)
    if element.tag == "sphere":
        vertices, faces = ball()
        return vertices * _floats(element, "radius")[0], faces
    if element.tag == "mesh":
        return _mesh(element, file)
    raise ArmError(f"shape '{element.tag}'")


def _mesh(element: ElementTree.Element, file: Path | None) -> tuple[Array, NDArray[np.int64]]:
    name = element.get("filename", "")
    found = None if file is None else find_mesh(name, file)
    if found is None:
        raise ArmError(name)
    if found.stat().st_size > MOST_BYTES:
        raise ArmError(f"{name} ({found.stat().st_size >> 20} MB; at most {MOST_BYTES >> 20} MB are read)")
    try:
        import trimesh
    except ImportError as error:
        raise ArmError(f"{name} (meshes are read by trimesh, which comes with holdfast[view])") from error
    try:
        loaded: Any = trimesh.load(found, force="mesh")
        vertices, faces = np.asarray(loaded.vertices, dtype=np.float64), np.asarray(loaded.faces, dtype=np.int64)
    except Exception as error:  # readers of meshes raise whatever they like
        raise ArmError(f"{name} (cannot be read: {type(error).__name__})") from error
    if not len(faces) or not np.isfinite(vertices).all():
        raise ArmError(f"{name} (no triangles of finite numbers)")
    vertices, faces = thinned(vertices, faces, MOST_TRIANGLES)
    scale = _floats(element, "scale") if element.get("scale") else [1.0, 1.0, 1.0]
    return vertices * np.array(scale), faces


def find_mesh(name: str, file: Path) -> Path | None:
    """The file of a mesh: a path, or ``package://NAME/...`` with NAME a folder beside the URDF file or above it."""
    if "://" not in name:
        path = file.parent / name
        return path if path.is_file() else None
    scheme, _, rest = name.partition("://")
    if scheme == "file":
        return Path(rest) if Path(rest).is_file() else None
    if scheme != "package":
        return None
    package, _, inside = rest.partition("/")
    for folder in file.resolve().parents:
        for candidate in (folder / package / inside, *([folder / inside] if folder.name == package else [])):
            if candidate.is_file():
                return candidate
    return None


def _floats(element: ElementTree.Element, key: str) -> list[float]:
    values = [float(x) for x in element.get(key, "").split()]
    if not values or not np.isfinite(values).all():
        raise ArmError(f"{element.tag} without {key}")
    return values


def _color(visual: ElementTree.Element, materials: dict[str, Color]) -> Color:
    material = visual.find("material")
    if material is None:
        return LINK
    return _rgba(material) or materials.get(material.get("name", ""), LINK)


def _rgba(material: ElementTree.Element) -> Color | None:
    color = material.find("color")
    if color is None:
        return None
    r, g, b = (round(255 * min(max(x, 0.0), 1.0)) for x in _floats(color, "rgba")[:3])
    return r, g, b
