"""The geoms of an MJCF file, as MuJoCo compiles them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm import mjcf
from holdfast.arm.model import Arm
from holdfast.shapes.pieces import Carriers, Kind, Missing, Piece, Place, Purpose

Array = NDArray[np.float64]


def read(file: Path, arm: Arm, purpose: Purpose, hold: Mapping[str, float] | None) -> tuple[list[Piece], list[Missing]]:
    """See :func:`holdfast.shapes.reading.read_pieces`.

    What collides are the geoms with a ``contype`` or ``conaffinity``, but for those of the world, which are around the arm;
    what is drawn are the others, or all where there are no others on a body.
    """
    model, tree = mjcf.compiled_tree(file)
    return collected(model, purpose, Carriers(tree, arm, hold).place)


def collected(model: Any, purpose: Purpose, place_of: Place, world: bool = False) -> tuple[list[Piece], list[Missing]]:
    """The shapes of the bodies that have a place, those of the world only if they are wanted; and what could not be read."""
    mujoco = mjcf.import_mujoco()
    kinds: dict[int, Kind] = {
        int(mujoco.mjtGeom.mjGEOM_BOX): "box",
        int(mujoco.mjtGeom.mjGEOM_CYLINDER): "cylinder",
        int(mujoco.mjtGeom.mjGEOM_CAPSULE): "capsule",
        int(mujoco.mjtGeom.mjGEOM_SPHERE): "sphere",
        int(mujoco.mjtGeom.mjGEOM_ELLIPSOID): "ellipsoid",
        int(mujoco.mjtGeom.mjGEOM_MESH): "mesh",
        **({int(mujoco.mjtGeom.mjGEOM_PLANE): "half space"} if world else {}),
    }
    collides = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    pieces: list[Piece] = []
    missing: list[Missing] = []
    for g in range(model.ngeom):
        body = int(model.geom_bodyid[g])
        only_colliding = bool(collides[model.geom_bodyid == body].all())
        wanted = collides[g] and (world or body > 0) if purpose == "collision" else not collides[g] or only_colliding
        place = place_of(mjcf.body_name(model, body)) if wanted else None
        if place is None:
            continue
        kind = kinds.get(int(model.geom_type[g]))
        if kind is None:
            missing.append(Missing(place[0], f"geom of type {mujoco.mjtGeom(int(model.geom_type[g])).name[7:].lower()}"))
            continue
        vertices, faces = np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)
        name: str = kind
        if kind == "mesh":
            mesh = int(model.geom_dataid[g])
            first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
            start, many = int(model.mesh_faceadr[mesh]), int(model.mesh_facenum[mesh])
            vertices = model.mesh_vert[first : first + count].astype(np.float64)
            faces = model.mesh_face[start : start + many].astype(np.int64)
            name = str(model.mesh(mesh).name)
        pieces.append(
            Piece(
                link=place[0],
                owner=mjcf.body_name(model, body),
                kind=kind,
                name=name,
                size=_size(kind, model.geom_size[g]),
                pose=place[1] @ mjcf.pose_of(model.geom_pos[g], model.geom_quat[g]),
                vertices=vertices,
                faces=faces,
                rgba=tuple(float(x) for x in model.geom_rgba[g]),
                label=str(model.geom(g).name),
            )
        )
    return pieces, missing


def excluded(file: Path) -> frozenset[tuple[str, str]]:
    """Pairs of bodies whose contacts the model excludes, each in alphabetical order."""
    model, _ = mjcf.compiled_tree(file)
    pairs = [(int(x) >> 16, int(x) & 0xFFFF) for x in model.exclude_signature]
    names = [sorted((mjcf.body_name(model, a), mjcf.body_name(model, b))) for a, b in pairs]
    return frozenset((a, b) for a, b in names)


def _size(kind: Kind, size: Array) -> tuple[float, ...]:
    """As :class:`Piece` has it; MuJoCo gives half sizes."""
    x, y, z = (float(v) for v in size)
    return {
        "box": (2 * x, 2 * y, 2 * z),
        "cylinder": (x, 2 * y),
        "capsule": (x, 2 * y),
        "sphere": (x,),
        "ellipsoid": (x, y, z),
        "mesh": (),
        "half space": (),
    }[kind]
