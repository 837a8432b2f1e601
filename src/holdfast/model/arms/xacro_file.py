"""Expand xacro files with the package xacro."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from xml.etree import ElementTree

from holdfast.core.errors import ArmError
from holdfast.core.extras import import_extra
from holdfast.model.arm.formats.mesh_files import find_mesh


def expand_xacro(path: Path, arguments: Mapping[str, str], packages: str | Path | None) -> str:
    """Return the URDF text of a xacro file, in which the mesh files that exist have absolute paths.

    Args:
        path: The xacro file.
        arguments: Arguments of the file.
        packages: Folder that is searched first for the ROS packages of ``$(find ...)``; then come the folders above the file.

    Raises:
        ArmError: The file cannot be expanded.
        HoldfastError: The package xacro is not installed.
    """
    xacro = import_extra("xacro", "xacro")
    substitutions = import_extra("xacro.substitution_args", "xacro")
    if not path.is_file():
        raise ArmError(f"{path.name}: the file cannot be read (no such file); give the path of a xacro file")
    find_installed, missing_packages = substitutions._eval_find, []

    def find(package: str) -> str:
        folder = _find_package(package, path, packages)
        if folder is not None:
            return str(folder)
        missing_packages.append(package)
        installed = str(find_installed(package))
        missing_packages.remove(package)
        return installed

    substitutions._eval_find = find
    try:
        text: str = xacro.process_file(str(path), mappings=dict(arguments)).toxml()
    except Exception as error:  # xacro raises many types
        if missing_packages:
            raise ArmError(
                f"{path.name}: it needs the ROS package '{missing_packages[0]}', which is in no folder above it; name the "
                "folder that contains the package with packages (--packages)"
            ) from error
        reason = " ".join(str(error).split()) or type(error).__name__
        raise ArmError(
            f"{path.name}: xacro cannot expand this ({reason}); correct the file, or give its arguments with xacro "
            "(--xacro NAME=VALUE)"
        ) from error
    finally:
        substitutions._eval_find = find_installed
    folder = None if packages is None else Path(packages)

    def use_absolute_path(match: re.Match[str]) -> str:
        mesh = find_mesh(match[1], path, folder)
        return match[0] if mesh is None else f'filename="{mesh.absolute()}"'

    return re.sub(r'filename="([^"]+)"', use_absolute_path, text)


def _find_package(package: str, path: Path, packages: str | Path | None) -> Path | None:
    """Return the folder of a ROS package: anywhere in ``packages``, or a folder above the file, or beside one of these."""
    if packages is not None:
        for file in sorted(Path(packages).rglob("package.xml")):
            if file.parent.name == package or _package_name(file) == package:
                return file.parent
    for folder in path.resolve().parents:
        for candidate in (folder, folder / package):
            if candidate.name == package and (candidate / "package.xml").is_file():
                return candidate
    return None


def _package_name(file: Path) -> str:
    try:
        return (ElementTree.parse(file).findtext("name") or "").strip()
    except (ElementTree.ParseError, OSError):
        return ""
