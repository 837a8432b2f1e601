"""Read the shapes of an arm from the file of the arm."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from holdfast.core.errors import InputError
from holdfast.model.arm.formats import urdf
from holdfast.model.arm.model import Arm
from holdfast.model.arms.loading import is_mujoco_file
from holdfast.model.shapes.pieces import Missing, Piece, Purpose


def read_pieces(
    arm: Arm,
    purpose: Purpose,
    *,
    hold: Mapping[str, float] | None = None,
    meshes: str | Path | None = None,
    open_files: bool = True,
) -> tuple[list[Piece], list[Missing]]:
    """Return the shapes of the links in the arm's file, and the shapes that could not be read.

    Both lists are empty if the arm has no file, or the file no longer exists.

    Args:
        arm: Arm model.
        purpose: Visual or collision shapes.
        hold: Values of joints next to the chain instead of those of the arm, rad or m.
        meshes: Folder with the mesh files; default: the one with which the arm was read.
        open_files: Open the mesh files; otherwise all meshes count as missing, and only the arm's file is opened.

    Raises:
        ArmError: The file has changed since the arm was read, or ``hold`` does not fit it.
    """
    if arm.chain is None or not arm.chain.file or not Path(arm.chain.file).is_file():
        return [], []
    folder = Path(meshes) if meshes is not None else Path(arm.chain.meshes) if arm.chain.meshes else None
    if is_mujoco_file(arm.chain.file):
        from holdfast.model.shapes import mjcf_pieces

        # MuJoCo opens the files that the model names in any case.
        return mjcf_pieces.read_mjcf_pieces(Path(arm.chain.file), arm, purpose, hold) if open_files else ([], [])
    from holdfast.model.shapes import urdf_pieces

    return urdf_pieces.read_urdf_pieces(Path(arm.chain.file), arm, purpose, hold, folder, open_files)


def unchecked_pairs(arm: Arm) -> frozenset[tuple[str, str]]:
    """Return the pairs of links, in alphabetical order, that the SRDF file of ``arm`` excludes from collision checks.

    For an MJCF file, they are the ``<exclude>`` of its contacts.

    Raises:
        ArmError: The file cannot be read.
    """
    if arm.chain is None or not arm.chain.file or not Path(arm.chain.file).is_file():
        return frozenset()
    if is_mujoco_file(arm.chain.file):
        from holdfast.model.shapes import mjcf_pieces

        return mjcf_pieces.read_excluded_contacts(Path(arm.chain.file))
    return urdf.read_disabled_pairs(Path(arm.chain.srdf)) if arm.chain.srdf else frozenset()


def with_mesh_folder(arm: Arm, folder: str | Path) -> Arm:
    """Return the same arm with a folder that is searched first for its meshes.

    Raises:
        InputError: There is no such folder, or the arm has no file.
    """
    if not Path(folder).is_dir():
        raise InputError(f"the folder of meshes is '{folder}', which cannot be found or is not a folder; give another")
    if arm.chain is None or not arm.chain.file:
        raise InputError(f"'{arm.name}' was not read from a URDF file, so it has no meshes; leave out their folder")
    return replace(arm, chain=replace(arm.chain, meshes=str(Path(folder).absolute())))
