"""Files of meshes: where they are, and what is in them. STL is read here, other formats by trimesh."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import ArmError
from holdfast.files import reading

Array = NDArray[np.float64]
Triangles = NDArray[np.int64]

MOST_BYTES = 100 << 20  # of one file
_VERTEX = re.compile(rb"\bvertex\s+(\S+)\s+(\S+)\s+(\S+)")
_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def find_mesh(name: str, file: Path, folder: Path | None = None) -> Path | None:
    """The file of a mesh that a URDF file names, or None.

    A path is taken from the folder of the URDF file. For ``package://NAME/...``, NAME is a folder beside the URDF file or
    above it, or one in ``ROS_PACKAGE_PATH``, or the last folder of one of its entries.

    Args:
        name: As the URDF file has it.
        file: The URDF file.
        folder: Where the meshes are; looked into first, for the name and for ever fewer of its last parts.
    """
    scheme, mark, inside = name.partition("://")
    if not mark:
        scheme, inside = "", name
    if scheme not in ("", "file", "package") or "\0" in name:
        return None
    for place in [*_inside(inside, folder), *_usual(scheme, inside, file)]:
        if place.is_file():
            return place
    return None


def _inside(name: str, folder: Path | None) -> Iterator[Path]:
    if folder is not None:
        parts = [part for part in PurePosixPath(name).parts if part not in ("/", "..")]
        yield from (folder.joinpath(*parts[k:]) for k in range(len(parts)))


def _usual(scheme: str, inside: str, file: Path) -> Iterator[Path]:
    if scheme != "package":
        yield file.parent / inside  # an absolute path stays one
        return
    package, _, rest = inside.partition("/")
    listed = [Path(entry) for entry in os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep) if entry]
    for above in [*file.resolve().parents, *listed]:
        yield above / package / rest
        if above.name == package:
            yield above / rest


def read_mesh(path: Path) -> tuple[Array, Triangles]:
    """Corners (V, 3) and triangles (F, 3) of a mesh file, in its own unit; equal corners of an STL file are one.

    Raises:
        ArmError: The file is too large, cannot be read, or has no triangles of finite numbers.
    """
    with reading.guarded(f"{path.name},", kind=ArmError):
        content = reading.raw(path, MOST_BYTES)
    vertices, faces = _stl(content, path.name) if path.suffix.lower() == ".stl" else _other(path)
    if not len(faces) or not np.isfinite(vertices).all():
        raise ArmError(f"{path.name} has no triangles of finite numbers")
    return vertices, faces


def _stl(content: bytes, name: str) -> tuple[Array, Triangles]:
    count = int.from_bytes(content[80:84], "little")
    if len(content) >= 84 and len(content) == 84 + 50 * count:
        corners = np.frombuffer(content, _RECORD, count, 84)["corners"].reshape(-1, 3).astype(np.float64)
    else:
        try:
            corners = np.array(_VERTEX.findall(content), dtype=np.float64).reshape(-1, 3)
        except ValueError as error:
            raise ArmError(f"{name} cannot be read: a corner is not three numbers") from error
        if not len(corners) or len(corners) % 3 or not content.lstrip().startswith(b"solid"):
            raise ArmError(f"{name} cannot be read: it is no whole STL file")
    vertices, which = np.unique(corners, axis=0, return_inverse=True)
    return vertices, which.reshape(-1, 3).astype(np.int64)


def _other(path: Path) -> tuple[Array, Triangles]:
    try:
        import trimesh
    except ImportError as error:
        raise ArmError(f"{path.name} is read by trimesh, which comes with holdfast[cell]; STL files need nothing") from error
    try:
        loaded: Any = trimesh.load(path, force="mesh")
        return np.asarray(loaded.vertices, dtype=np.float64), np.asarray(loaded.faces, dtype=np.int64)
    except Exception as error:  # readers of meshes raise whatever they like
        raise ArmError(f"{path.name} cannot be read ({type(error).__name__})") from error
