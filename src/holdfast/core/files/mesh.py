"""Read and check triangle meshes of STL files and, with the extra ``cell``, of OBJ, GLB, PLY, and DAE files."""

from __future__ import annotations

import io
import logging
import re
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.files import reading
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.core.validation import require_real_numbers

MESH_FORMATS = ("stl", "obj", "glb", "ply", "dae")
_STL_VERTEX = re.compile(rb"\bvertex\s+(\S+)\s+(\S+)\s+(\S+)", re.IGNORECASE)
_STL_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


@dataclass(frozen=True, eq=False)
class Triangles:
    """Triangle surface.

    Attributes:
        vertices: (V, 3) distinct vertices.
        faces: (F, 3) row numbers of the corners in ``vertices``, without triangles of zero area.
    """

    vertices: FloatArray
    faces: IndexArray

    @property
    def is_closed(self) -> bool:
        """True if every edge belongs to two triangles that pass it in opposite directions, so the surface has an inside."""
        start, end = self.faces.ravel(), np.roll(self.faces, -1, axis=1).ravel()
        one, other = start * len(self.vertices) + end, end * len(self.vertices) + start
        one.sort()
        other.sort()
        return bool(len(one)) and bool((one == other).all()) and bool((one[1:] != one[:-1]).all())

    @property
    def volume(self) -> float:
        """Enclosed volume in the cube of the vertices' unit; negative if the triangles face inward."""
        a, b, c = (self.vertices[self.faces[:, k]] - self.vertices.mean(axis=0) for k in range(3))
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def import_trimesh() -> ModuleType:
    """Import the optional package that reads meshes.

    Raises:
        HoldfastError: The package is not installed.
    """
    try:
        import trimesh
    except ImportError as error:
        raise HoldfastError(
            "meshes are read by trimesh, which is not installed; install holdfast-arms[cell] (pip install "
            "'holdfast-arms[cell]')"
        ) from error
    logging.getLogger("trimesh").setLevel(logging.CRITICAL)  # errors are reported once, by holdfast
    return trimesh  # type: ignore[no-any-return, unused-ignore]


def read_mesh(path: Path) -> tuple[Triangles, bytes]:
    """Read the triangles of a file in its own length unit, and the bytes of the file.

    Raises:
        InputError: The file is missing, empty, truncated, of an unknown format, or contains NaN.
        HoldfastError: The file is not an STL file and the extra ``cell`` is not installed.
    """
    kind = path.suffix.lower().lstrip(".")
    if kind not in MESH_FORMATS:
        raise InputError(f"'{path.name}' is not a mesh file of a known format; use {', '.join(MESH_FORMATS).upper()}")
    with reading.guard_reading(f"'{path.name}'", "give the path of a mesh that exists"):
        content = reading.read_bytes(path)
    if not content:
        raise InputError(f"'{path.name}' is empty; give a mesh with triangles")
    _reject_truncated_file(content, kind, path.name)
    if kind == "stl":
        return make_triangles(*_read_stl(content, path.name), f"'{path.name}'"), content
    if kind == "dae" and find_spec("collada") is None:
        raise HoldfastError(
            f"'{path.name}' is read by pycollada, which is not installed; install holdfast-arms[cell] (pip install "
            f"'holdfast-arms[cell]')"
        )
    trimesh = import_trimesh()
    try:
        # From memory, so that no other file, such as a texture, is opened.
        with np.errstate(invalid="ignore"):  # a signaling NaN, which is rejected below
            loaded = trimesh.load_mesh(io.BytesIO(content), file_type=kind, process=False)
            vertices, faces = np.array(loaded.vertices, dtype=np.float64), np.array(loaded.faces, dtype=np.int64)
    except Exception as error:  # trimesh and its readers raise errors of all kinds
        raise InputError(f"'{path.name}' is damaged or not a mesh in the format {kind.upper()}; export it again") from error
    return make_triangles(vertices, faces, f"'{path.name}'"), content


def _reject_truncated_file(content: bytes, kind: str, name: str) -> None:
    """Reject a truncated file that its reader would accept."""
    text = kind == "stl" and _is_text_stl(content)
    if kind == "stl" and not text:
        stated_count = int.from_bytes(content[80:84], "little") if len(content) >= 84 else 1
        is_cut = len(content) < 84 + 50 * stated_count
    elif kind == "stl":
        is_cut = b"endsolid" not in content[-1000:]
    elif kind == "glb":
        is_cut = len(content) < 12 or len(content) < int.from_bytes(content[8:12], "little")
    else:
        return
    if is_cut:
        raise InputError(f"'{name}' is cut off or damaged: it is shorter than its header states; export it again")


def _is_text_stl(content: bytes) -> bool:
    """Return whether an STL file is in text form."""
    return content[:5].lower() == b"solid" and b"facet" in content[:1000]


def _read_stl(content: bytes, name: str) -> tuple[NDArray[np.floating[Any]], IndexArray]:
    """Read the corners (3 F, 3) of the triangles of a complete STL file, and their numbers (F, 3)."""
    if _is_text_stl(content):
        try:
            corners = np.array(_STL_VERTEX.findall(content), dtype=np.float64).reshape(-1, 3)
        except ValueError as error:
            raise InputError(f"'{name}' is damaged: a vertex in it is not three numbers; export it again") from error
        if len(corners) % 3:
            raise InputError(f"'{name}' is damaged: a triangle in it does not have three vertices; export it again")
    else:
        count = int.from_bytes(content[80:84], "little")
        corners = np.frombuffer(content, _STL_RECORD, count, 84)["corners"].reshape(-1, 3)
    return corners, np.arange(len(corners), dtype=np.int64).reshape(-1, 3)


def make_triangles(vertices: ArrayLike, faces: ArrayLike, surface_name: str) -> Triangles:
    """Check a surface and return it with every vertex once.

    Args:
        vertices: (V, 3) coordinates in the unit of the caller.
        faces: (F, 3) whole numbers, the row numbers of the corners in ``vertices``.
        surface_name: Name of the surface in error messages.

    Raises:
        InputError: There are no triangles, or the arrays are not finite or not of these shapes.
    """
    points = np.array(require_real_numbers(vertices, f"{surface_name}: vertices"))
    corners = require_real_numbers(faces, f"{surface_name}: faces")
    if points.ndim != 2 or points.shape[-1] != 3 or corners.ndim != 2 or corners.shape[-1] != 3 or not corners.size:
        raise InputError(f"{surface_name} has no triangles; give vertices (V, 3) and faces (F, 3)")
    if not np.isfinite(points).all():
        raise InputError(f"{surface_name} holds NaN or infinity; all its vertices must be finite")
    if not ((corners >= 0) & (corners < len(points)) & (corners == np.floor(corners))).all():
        raise InputError(f"{surface_name} is damaged: a face refers to a vertex that does not exist; export it again")
    used, numbers = _unique_rows(points[corners.astype(np.int64).ravel()] + 0.0)
    sound = numbers.reshape(-1, 3)
    sound = sound[(sound != np.roll(sound, 1, axis=1)).all(axis=1)]
    if not len(sound):
        raise InputError(f"{surface_name} has no triangle with an area; export it again")
    return Triangles(used, sound)


def _unique_rows(points: FloatArray) -> tuple[FloatArray, IndexArray]:
    """Return the distinct rows and, for each row, its number among them."""
    order = np.lexsort(points.T)
    rows = points[order]
    is_new = np.concatenate([[True], (rows[1:] != rows[:-1]).any(axis=1)])
    numbers = np.empty(len(points), dtype=np.int64)
    numbers[order] = np.cumsum(is_new) - 1
    return rows[is_new], numbers


def write_obj_text(surface: Triangles) -> str:
    """Return a surface as the text of an OBJ file, numbers with all digits."""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in surface.vertices.tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (surface.faces + 1).tolist()]
    return "\n".join(lines) + "\n"
