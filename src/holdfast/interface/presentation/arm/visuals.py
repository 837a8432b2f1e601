"""Visual shapes of the links of an arm, read from its file."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import HoldfastError
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.body import (
    LINK_COLOR_RGB,
    MeshPart,
    build_stick_parts,
    mesh_box,
    mesh_cylinder,
    mesh_sphere,
)
from holdfast.interface.report.viewer import simplify_mesh
from holdfast.model.arm.model import Arm
from holdfast.model.shapes.pieces import Missing, Piece
from holdfast.model.shapes.reading import read_pieces

MAX_MESH_TRIANGLES = 60_000  # triangles of one mesh; more take longer and do not look smoother


def build_body(arm: Arm, size: float, meshes: bool = True) -> tuple[list[MeshPart], str]:
    """Build the meshes of an arm from the visual shapes of its file, or a stick model for links without shapes.

    Returns the parts, and a note on missing meshes, which is empty if none are missing. ``size`` is the length of the stretched
    arm, m, to which the stick model is scaled; for ``meshes`` see :func:`read_visual_parts`.
    """
    sticks = build_stick_parts(arm, size)
    shapes, lacking = read_visual_parts(arm, meshes)
    if not shapes:
        return sticks, f"no mesh was found or read ({lacking[0].what}), so the arm is drawn as sticks" if lacking else ""
    if lacking:
        frames_with_shapes = {mesh_part.frame for mesh_part in shapes}
        shapes += [mesh_part for mesh_part in sticks if mesh_part.frame not in frames_with_shapes]
        groups = (("not found", False), ("found but not readable", True))
        missing_by_reason = [
            (reason, [item.what for item in lacking if item.is_present is present]) for reason, present in groups
        ]
        counts = [f"{len(names)} {reason}, such as {names[0]}" for reason, names in missing_by_reason if names]
        return shapes, f"of the meshes in the file, {' and '.join(counts)}; these links are drawn as sticks"
    return shapes, ""


def read_visual_parts(arm: Arm, meshes: bool = True) -> tuple[list[MeshPart], list[Missing]]:
    """Read the visual shapes of the links of an arm, in the frames of its bodies.

    Returns the shapes that were read, and the shapes that are missing or not readable. With ``meshes=False``, all meshes count
    as missing, and only the file of the arm is opened.
    """
    try:
        pieces, missing = read_pieces(arm, "visual", open_files=meshes)
    except HoldfastError as error:  # the file has changed to another arm, or its reader is not installed
        return [], [Missing(-1, str(error))]
    return [make_part(piece) for piece in pieces], missing


def make_part(piece: Piece) -> MeshPart:
    """Convert a shape of a file to a triangle mesh with the colour of the shape."""
    vertices, faces = _triangulate_piece(piece)
    color = LINK_COLOR_RGB
    if piece.rgba is not None:
        r, g, b = (round(255 * min(max(channel, 0.0), 1.0)) for channel in piece.rgba[:3])
        color = r, g, b
    return MeshPart(piece.link + 1, vertices @ piece.pose[:3, :3].T + piece.pose[:3, 3], faces, color)


def _triangulate_piece(piece: Piece) -> tuple[FloatArray, NDArray[np.int64]]:
    """Triangulate a piece in its own frame."""
    if piece.kind == "mesh":
        return simplify_mesh(piece.vertices, piece.faces, MAX_MESH_TRIANGLES)
    if piece.kind == "box":
        return mesh_box(np.array(piece.size))
    if piece.kind in ("cylinder", "capsule"):
        radius, length = piece.size
        return mesh_cylinder(np.array([0, 0, -length / 2]), np.array([0, 0, length / 2]), radius)
    vertices, faces = mesh_sphere()
    return vertices * np.array(piece.size), faces
