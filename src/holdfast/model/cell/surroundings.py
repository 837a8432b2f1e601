"""Cells from URDF and MJCF files: the shapes that do not move with the arm."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.files.mesh import Triangles
from holdfast.core.typing import FloatArray
from holdfast.model.arm.formats import mjcf
from holdfast.model.arm.formats.tree import LinkTree, LockedJoints, resolve_base_and_tip
from holdfast.model.arm.formats.urdf import read_tree, robot_element
from holdfast.model.cell.meshes import Mesh
from holdfast.model.cell.solids import Box, Capsule, Cylinder, HalfSpace, Solid, Sphere
from holdfast.model.shapes.mjcf_pieces import collect_mjcf_shapes as collected_geoms
from holdfast.model.shapes.pieces import Missing, Piece, Place
from holdfast.model.shapes.urdf_pieces import collect_urdf_shapes as collected_elements


def cell_arguments_from_urdf(
    path: Path, base: str | None, tip: str | None, hold: Mapping[str, float], meshes: Path | None
) -> dict[str, Any]:
    """Return the arguments of :class:`holdfast.Cell` from a URDF file; poses are in the frame of the arm's base, the world.

    Raises:
        ArmError: The file is no valid tree, or has no such links or joints.
        InputError: A shape cannot be read.
    """
    robot = robot_element(path)
    tree = read_tree(robot, path.stem)
    base, arm_links, place_link = _separate_arm_links(tree, base, tip, hold)
    world_to_base = np.linalg.inv(place_link(base)[1])  # type: ignore[index]

    def place_in_base(link: str) -> tuple[int, FloatArray] | None:
        placement = None if link in arm_links else place_link(link)
        return None if placement is None else (-1, world_to_base @ placement[1])

    pieces, missing = collected_elements(robot, path, "collision", place_in_base, meshes)
    return _cell_arguments(tree.name, pieces, missing, lambda surface: "exact" if surface.is_closed else "hull")


def cell_arguments_from_mjcf(path: Path, base: str | None, tip: str | None, hold: Mapping[str, float]) -> dict[str, Any]:
    """Return the arguments of :class:`holdfast.Cell` from an MJCF file; meshes become their convex hulls, as in MuJoCo.

    Raises:
        ArmError: MuJoCo cannot read the file, or it has no such bodies or joints.
        InputError: A geom has no distance formula.
        HoldfastError: MuJoCo is not installed.
    """
    model, tree = mjcf.compile_tree(path)
    _, arm_links, place_link = _separate_arm_links(tree, base, tip, hold)
    arm_links = arm_links - {tree.root}  # the world, which never belongs to the arm
    pieces, missing = collected_geoms(
        model, "collision", lambda body: None if body in arm_links else place_link(body), world=True
    )
    return _cell_arguments(tree.name, pieces, missing, lambda _: "hull", tree.root)


def _separate_arm_links(
    tree: LinkTree, base: str | None, tip: str | None, hold: Mapping[str, float]
) -> tuple[str, set[str], Place]:
    """Return the base, the links of the arm below its first joint, and a function that places links that do not move."""
    moving, arm_links = set(), set()
    if any(joint.is_moving for joint in tree.joints.values()):
        base, tip = resolve_base_and_tip(tree, base, tip)
        path = tree.joint_path(base, tip)
        moving = {joint.name for joint in path if not tree.is_fixed(joint, hold)}
        first_moving = next((index for index, joint in enumerate(path) if joint.name in moving), len(path))
        arm_links = {base, *(joint.child for joint in path[:first_moving])}
    locked_joints = LockedJoints(tree, moving, hold)

    def place_link(link: str) -> tuple[int, FloatArray] | None:
        pose = np.eye(4)
        while link in tree.joint_above:
            joint = tree.joint_above[link]
            if joint.name in moving:
                return None
            pose = joint.child_pose(locked_joints.joint_value(joint)) @ pose
            link = joint.parent
        return -1, pose

    return base or tree.root, arm_links, place_link


def _cell_arguments(
    name: str, pieces: list[Piece], missing: list[Missing], solid: Callable[[Triangles], str], world: str = ""
) -> dict[str, Any]:
    """Return the arguments of a cell whose objects the base may touch, because neither moves."""
    if missing:
        raise InputError(f"a shape in it cannot be read: {missing[0].what}; repair or remove it, so that no object is missed")
    objects = [_build_solid(label, piece, solid) for label, piece in zip(_unique_names(pieces, world), pieces, strict=True)]
    return {"objects": objects, "name": name, "may_touch": [(member.name, "base") for member in objects]}


def _unique_names(pieces: list[Piece], world: str) -> list[str]:
    """Return the names of the pieces: their own, else those of owners or, in the world, of kinds, numbered if taken."""
    taken = {piece.label for piece in pieces}
    names = []
    for piece in pieces:
        stem = piece.name if piece.owner == world else piece.owner
        numbered = (stem if number == 1 else f"{stem} {number}" for number in count(1))
        names.append(piece.label or next(name for name in numbered if name not in taken))
        taken.add(names[-1])
    return names


def _build_solid(name: str, piece: Piece, solid: Callable[[Triangles], str]) -> Solid:
    match piece.kind:
        case "box":
            return Box(name, np.array(piece.size), pose=piece.pose)
        case "cylinder":
            return Cylinder(name, *piece.size, pose=piece.pose)
        case "capsule":
            return Capsule(name, *piece.size, pose=piece.pose)
        case "sphere":
            return Sphere(name, *piece.size, pose=piece.pose)
        case "half space":
            return HalfSpace(name, pose=piece.pose)
        case "mesh":
            solid_kind: Any = solid(Triangles(piece.vertices, piece.faces))
            return Mesh(name, (piece.vertices, piece.faces), solid=solid_kind, pose=piece.pose)
    raise InputError(f"object '{name}' is an {piece.kind}, which has no distance formula; make it a capsule or a mesh")
