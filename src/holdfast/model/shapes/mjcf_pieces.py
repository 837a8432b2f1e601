"""Read the geoms of an MJCF file as MuJoCo compiles them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.model.arm.formats import mjcf
from holdfast.model.arm.model import Arm
from holdfast.model.shapes.pieces import Kind, LinkCarriers, Missing, Piece, Place, Purpose


def read_mjcf_pieces(
    file: Path, arm: Arm, purpose: Purpose, hold: Mapping[str, float] | None
) -> tuple[list[Piece], list[Missing]]:
    """Return the shapes of an MJCF file; see :func:`holdfast.model.shapes.reading.read_pieces`.

    Collision shapes are the geoms with a ``contype`` or ``conaffinity``, except those of the world, which surround the arm.
    Visual shapes are the other geoms of a body, or all its geoms if there are no others.
    """
    model, tree = mjcf.compile_tree(file)
    return collect_mjcf_shapes(model, purpose, LinkCarriers(tree, arm, hold).locate_link)


def collect_mjcf_shapes(
    model: Any, purpose: Purpose, find_pose: Place, world: bool = False
) -> tuple[list[Piece], list[Missing]]:
    """Return the shapes of the bodies that have a pose (those of the world only on request) and the unreadable ones."""
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
    for geom in range(model.ngeom):
        body = int(model.geom_bodyid[geom])
        only_colliding = bool(collides[model.geom_bodyid == body].all())
        is_wanted = collides[geom] and (world or body > 0) if purpose == "collision" else not collides[geom] or only_colliding
        place = find_pose(mjcf.body_name(model, body)) if is_wanted else None
        if place is None:
            continue
        kind = kinds.get(int(model.geom_type[geom]))
        if kind is None:
            missing.append(Missing(place[0], f"geom of type {mujoco.mjtGeom(int(model.geom_type[geom])).name[7:].lower()}"))
            continue
        vertices, faces = np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)
        name: str = kind
        if kind == "mesh":
            mesh = int(model.geom_dataid[geom])
            first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
            start, face_count = int(model.mesh_faceadr[mesh]), int(model.mesh_facenum[mesh])
            vertices = model.mesh_vert[first : first + count].astype(np.float64)
            faces = model.mesh_face[start : start + face_count].astype(np.int64)
            name = str(model.mesh(mesh).name)
        pieces.append(
            Piece(
                link=place[0],
                owner=mjcf.body_name(model, body),
                kind=kind,
                name=name,
                size=_piece_size(kind, model.geom_size[geom]),
                pose=place[1] @ mjcf.pose_from_wxyz(model.geom_pos[geom], model.geom_quat[geom]),
                vertices=vertices,
                faces=faces,
                rgba=tuple(float(x) for x in model.geom_rgba[geom]),
                label=str(model.geom(geom).name),
            )
        )
    return pieces, missing


def read_excluded_contacts(file: Path) -> frozenset[tuple[str, str]]:
    """Return the pairs of bodies whose contacts the model excludes, each in alphabetical order."""
    model, _ = mjcf.compile_tree(file)
    pairs = [(int(x) >> 16, int(x) & 0xFFFF) for x in model.exclude_signature]
    names = [sorted((mjcf.body_name(model, a), mjcf.body_name(model, b))) for a, b in pairs]
    return frozenset((a, b) for a, b in names)


def _piece_size(kind: Kind, size: FloatArray) -> tuple[float, ...]:
    """Return the size as :class:`Piece` defines it; MuJoCo uses half sizes."""
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
