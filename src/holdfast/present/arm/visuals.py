"""What is drawn of the links of an arm: the shapes that its file gives them, where they can be read."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.errors import HoldfastError
from holdfast.present.arm.body import LINK, Part, ball, box, stick_parts, tube
from holdfast.report.viewer import thinned
from holdfast.shapes.pieces import Missing, Piece
from holdfast.shapes.reading import read_pieces

Array = NDArray[np.float64]
MOST_TRIANGLES = 60_000  # of one mesh: more are not smoother, only slower


def body_of(arm: Arm, size: float, meshes: bool = True) -> tuple[list[Part], str]:
    """What an arm is made of: the shapes of its file where it has some, else sticks; and a note where meshes are missing.

    Args:
        arm: The arm.
        size: What sticks are drawn in proportion to, m.
        meshes: As in :func:`visual_parts`.
    """
    sticks = stick_parts(arm, size)
    shapes, lacking = visual_parts(arm, meshes)
    if not shapes:
        return sticks, f"no mesh was found or read ({lacking[0].what}), so the arm is drawn as sticks" if lacking else ""
    if lacking:
        clad = {p.frame for p in shapes}
        shapes += [p for p in sticks if p.frame not in clad]
        groups = (("not found", False), ("found but not readable", True))
        sorted_out = [(words, [item.what for item in lacking if item.is_present is present]) for words, present in groups]
        counts = [f"{len(which)} {words}, such as {which[0]}" for words, which in sorted_out if which]
        return shapes, f"of the file's meshes {' and '.join(counts)}; such links are drawn as sticks"
    return shapes, ""


def visual_parts(arm: Arm, meshes: bool = True) -> tuple[list[Part], list[Missing]]:
    """The visual shapes of the links of an arm, in the frames of its bodies, and those that could not be read.

    Args:
        arm: The arm.
        meshes: Open the files of meshes; else all count as missing, and no file but the arm's is opened.
    """
    try:
        pieces, missing = read_pieces(arm, "visual", open_files=meshes)
    except HoldfastError as error:  # another arm than the one in the file, or a reader that is not installed
        return [], [Missing(-1, str(error))]
    return [part_of(piece) for piece in pieces], missing


def part_of(piece: Piece) -> Part:
    """A shape of a file as triangles, in its own colour."""
    vertices, faces = _triangles(piece)
    color = LINK
    if piece.rgba is not None:
        r, g, b = (round(255 * min(max(x, 0.0), 1.0)) for x in piece.rgba[:3])
        color = r, g, b
    return Part(piece.link + 1, vertices @ piece.pose[:3, :3].T + piece.pose[:3, 3], faces, color)


def _triangles(piece: Piece) -> tuple[Array, NDArray[np.int64]]:
    """In the frame of the piece."""
    if piece.kind == "mesh":
        return thinned(piece.vertices, piece.faces, MOST_TRIANGLES)
    if piece.kind == "box":
        return box(np.array(piece.size))
    if piece.kind in ("cylinder", "capsule"):
        radius, length = piece.size
        return tube(np.array([0, 0, -length / 2]), np.array([0, 0, length / 2]), radius)
    vertices, faces = ball()
    return vertices * np.array(piece.size), faces
