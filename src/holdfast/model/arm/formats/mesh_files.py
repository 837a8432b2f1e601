"""Find the mesh files that the file of an arm names."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path, PurePosixPath


def find_mesh(name: str, file: Path, folder: Path | None = None) -> Path | None:
    """Return the path of a mesh that a URDF file names, or None.

    A path is relative to the folder of the URDF file. For ``package://NAME/...``, NAME is a folder next to the URDF file or
    above it, or one in ``ROS_PACKAGE_PATH``, or the last folder of one of its entries.

    Args:
        name: Name of the mesh in the URDF file.
        file: URDF file.
        folder: Folder that is searched first, for the name and then for fewer and fewer of its last parts.
    """
    scheme, mark, inside = name.partition("://")
    if not mark:
        scheme, inside = "", name
    if scheme not in ("", "file", "package") or "\0" in name:
        return None
    for place in [*_paths_in_folder(inside, folder), *_package_paths(scheme, inside, file)]:
        if place.is_file():
            return place
    return None


def _paths_in_folder(name: str, folder: Path | None) -> Iterator[Path]:
    if folder is not None:
        parts = [part for part in PurePosixPath(name).parts if part not in ("/", "..")]
        yield from (folder.joinpath(*parts[k:]) for k in range(len(parts)))


def _package_paths(scheme: str, inside: str, file: Path) -> Iterator[Path]:
    if scheme != "package":
        yield file.parent / inside  # an absolute path stays absolute
        return
    package, _, relative_path = inside.partition("/")
    listed = [Path(entry) for entry in os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep) if entry]
    for above in [*file.resolve().parents, *listed]:
        yield above / package / relative_path
        if above.name == package:
            yield above / relative_path
