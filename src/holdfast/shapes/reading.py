"""The shapes of an arm from the file that it was read from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from holdfast.arm import urdf
from holdfast.arm.model import Arm
from holdfast.arms.catalogue import outermost
from holdfast.errors import InputError
from holdfast.shapes.pieces import Missing, Piece, Purpose


def read_pieces(
    arm: Arm,
    purpose: Purpose,
    *,
    hold: Mapping[str, float] | None = None,
    meshes: str | Path | None = None,
    open_files: bool = True,
) -> tuple[list[Piece], list[Missing]]:
    """The shapes that the arm's file gives its links, and what of them could not be read.

    Nothing at all if the arm is from no file, or from one that is gone.

    Args:
        arm: The arm.
        purpose: What is drawn, or what collides.
        hold: Where joints beside the chain are held instead of where the arm has them, rad or m.
        meshes: Folder with the files of meshes; the one that the arm was read with if not given.
        open_files: Open the files of meshes; else all count as missing, and no file but the arm's is opened.

    Raises:
        ArmError: The file is no longer the one the arm was read from, or ``hold`` does not fit it.
    """
    if arm.chain is None or not arm.chain.file or not Path(arm.chain.file).is_file():
        return [], []
    folder = Path(meshes) if meshes is not None else Path(arm.chain.meshes) if arm.chain.meshes else None
    if outermost(arm.chain.file) == "mujoco":
        from holdfast.shapes import mjcf_pieces

        # MuJoCo opens the files that the model names whether or not they are wanted.
        return mjcf_pieces.read(Path(arm.chain.file), arm, purpose, hold) if open_files else ([], [])
    from holdfast.shapes import urdf_pieces

    return urdf_pieces.read(Path(arm.chain.file), arm, purpose, hold, folder, open_files)


def unchecked_pairs(arm: Arm) -> frozenset[tuple[str, str]]:
    """Pairs of links of the arm's file, each in alphabetical order, that it says never collide or may: those of its SRDF file.

    Of an MJCF file, the ``<exclude>`` of its contacts.

    Raises:
        ArmError: The file cannot be read.
    """
    if arm.chain is None or not arm.chain.file or not Path(arm.chain.file).is_file():
        return frozenset()
    if outermost(arm.chain.file) == "mujoco":
        from holdfast.shapes import mjcf_pieces

        return mjcf_pieces.excluded(Path(arm.chain.file))
    return urdf.disabled_pairs(Path(arm.chain.srdf)) if arm.chain.srdf else frozenset()


def with_meshes(arm: Arm, folder: str | Path) -> Arm:
    """The same arm with a folder in which the meshes that its file names are looked for first.

    Raises:
        InputError: There is no such folder, or the arm is from no file.
    """
    if not Path(folder).is_dir():
        raise InputError(f"the folder of meshes is '{folder}', which cannot be found or is not a folder; give another")
    if arm.chain is None or not arm.chain.file:
        raise InputError(f"'{arm.name}' is from no URDF file, so no meshes belong to it; leave out their folder")
    return replace(arm, chain=replace(arm.chain, meshes=str(Path(folder).absolute())))
