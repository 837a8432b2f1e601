"""Cells from URDF and MJCF files: what is in them beside the arm and does not move with it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm import mjcf
from holdfast.arm.tree import Held, Tree, check_ends
from holdfast.arm.urdf import read_tree, robot_element
from holdfast.cell.meshes import Mesh
from holdfast.cell.solids import Box, Capsule, Cylinder, HalfSpace, Solid, Sphere
from holdfast.errors import InputError
from holdfast.files.mesh import Triangles
from holdfast.shapes.mjcf_pieces import collected as collected_geoms
from holdfast.shapes.pieces import Missing, Piece, Place
from holdfast.shapes.urdf_pieces import collected as collected_elements

Array = NDArray[np.float64]


def from_urdf(path: Path, base: str | None, tip: str | None, hold: Mapping[str, float], meshes: Path | None) -> dict[str, Any]:
    """What :class:`holdfast.Cell` takes, of a URDF file; poses in the frame of the arm's base, which is its world.

    Raises:
        ArmError: The file is no sound tree, or has no such links or joints.
        InputError: A shape that cannot be read.
    """
    robot = robot_element(path)
    tree = read_tree(robot, path.stem)
    base, own, place = _around(tree, base, tip, hold)
    here = np.linalg.inv(place(base)[1])  # type: ignore[index]

    def place_of(link: str) -> tuple[int, Array] | None:
        found = None if link in own else place(link)
        return None if found is None else (-1, here @ found[1])

    pieces, missing = collected_elements(robot, path, "collision", place_of, meshes)
    return _data(tree.name, pieces, missing, lambda surface: "exact" if surface.closed else "hull")


def from_mjcf(path: Path, base: str | None, tip: str | None, hold: Mapping[str, float]) -> dict[str, Any]:
    """What :class:`holdfast.Cell` takes, of an MJCF file; meshes are their hulls, as MuJoCo has them.

    Raises:
        ArmError: MuJoCo cannot read the file, or it has no such bodies or joints.
        InputError: A geom of which no distance is known.
        HoldfastError: MuJoCo is not installed.
    """
    model, tree = mjcf.compiled_tree(path)
    _, own, place = _around(tree, base, tip, hold)
    own = own - {tree.root}  # the world, which is never of the arm
    pieces, missing = collected_geoms(model, "collision", lambda body: None if body in own else place(body), world=True)
    return _data(tree.name, pieces, missing, lambda _: "hull", tree.root)


def _around(tree: Tree, base: str | None, tip: str | None, hold: Mapping[str, float]) -> tuple[str, set[str], Place]:
    """The base, the links that the arm has below its first joint, and where links are that do not move with it."""
    moving, own = set(), set()
    if any(joint.moving for joint in tree.joints.values()):
        base, tip = check_ends(tree, base, tip)
        path = tree.path(base, tip)
        moving = {joint.name for joint in path if not tree.stands(joint, hold)}
        first = next((k for k, joint in enumerate(path) if joint.name in moving), len(path))
        own = {base, *(joint.child for joint in path[:first])}
    still = Held(tree, moving, hold)

    def place(link: str) -> tuple[int, Array] | None:
        pose = np.eye(4)
        while link in tree.above:
            joint = tree.above[link]
            if joint.name in moving:
                return None
            pose = joint.at(still.value(joint)) @ pose
            link = joint.parent
        return -1, pose

    return base or tree.root, own, place


def _data(
    name: str, pieces: list[Piece], missing: list[Missing], solid: Callable[[Triangles], str], world: str = ""
) -> dict[str, Any]:
    """Objects, which the base may touch: neither moves."""
    if missing:
        raise InputError(f"a shape in it cannot be read: {missing[0].what}; mend or remove it, so that nothing is overlooked")
    objects = [_solid(label, piece, solid) for label, piece in zip(_names(pieces, world), pieces, strict=True)]
    return {"objects": objects, "name": name, "may_touch": [(x.name, "base") for x in objects]}


def _names(pieces: list[Piece], world: str) -> list[str]:
    """Their own; else of what carries them, or in the world of what they are, with a number where that is taken."""
    taken = {piece.label for piece in pieces}
    names = []
    for piece in pieces:
        about = piece.name if piece.owner == world else piece.owner
        numbered = (about if k == 1 else f"{about} {k}" for k in count(1))
        names.append(piece.label or next(name for name in numbered if name not in taken))
        taken.add(names[-1])
    return names


def _solid(name: str, piece: Piece, solid: Callable[[Triangles], str]) -> Solid:
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
            kind: Any = solid(Triangles(piece.vertices, piece.faces))
            return Mesh(name, (piece.vertices, piece.faces), solid=kind, pose=piece.pose)
    raise InputError(f"object '{name}' is an {piece.kind}, and no distance from one is known; make it a capsule or a mesh")
