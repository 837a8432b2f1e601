"""Interpretation of the arguments ``clearance=`` and ``cell=`` for every function that has them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from holdfast.core.errors import InputError
from holdfast.core.validation import check_arguments
from holdfast.model.arm.model import Arm
from holdfast.model.cell.cell import Cell, as_cell
from holdfast.model.collision.capsules import Capsules
from holdfast.model.collision.clearance import Clearance

if TYPE_CHECKING:
    from holdfast.model.collision.shape import CollisionModel

CellLike: TypeAlias = Cell | str | Path
"""Cell, or the path of its file."""


@check_arguments
def chosen_clearance(
    arm: Arm, clearance: Clearance | bool | None = None, cell: CellLike | None = None, *, looks: bool = True
) -> Clearance | None:
    """Return the clearance that an arm must respect, or None for none.

    Args:
        arm: Arm model.
        clearance: Collision model, possibly with a cell; None: :meth:`holdfast.Clearance.by_default`; True: the default model,
            also for a planar arm; False: the arm is not checked against itself.
        cell: Environment, or its file; it counts for any ``clearance``.
        looks: Without a clearance and a cell, True uses the default clearance and False none.

    Raises:
        InputError: The clearance belongs to another arm, or contains another cell than the given one.
        HoldfastError: The cell cannot be read, or does not fit the arm.
    """
    if isinstance(clearance, Clearance) and clearance.arm.fingerprint != arm.fingerprint:
        raise InputError(f"the clearance belongs to '{clearance.arm.name}', not to '{arm.name}'; make it with the same arm")
    loaded_cell = as_cell(cell)
    if isinstance(clearance, Clearance):
        if loaded_cell is None or (clearance.cell is not None and loaded_cell.digest == clearance.cell.digest):
            return clearance
        if clearance.cell is not None:
            raise InputError(
                f"the clearance holds the cell '{clearance.cell.name}' and cell is '{loaded_cell.name}'; give the cell "
                f"in one place"
            )
        return clearance.with_cell(loaded_cell)
    if clearance is None:
        return Clearance.by_default(arm, loaded_cell) if looks or loaded_cell is not None else None
    return Clearance(arm, cell=loaded_cell, itself=clearance) if clearance or loaded_cell is not None else None


def encode_clearance(clearance: Clearance, margin: float = 0.0) -> dict[str, Any]:
    """Return a clearance, and the margin in m, as JSON data: ``clearance`` and, around the arm, ``cell``."""
    data: dict[str, Any] = {"clearance": {"capsules": clearance.capsules.to_dict(clearance.arm), "margin": margin}}
    if not clearance.itself:
        data["clearance"]["itself"] = False
    if clearance.cell is not None:
        cell = clearance.cell
        data["cell"] = {"name": cell.name, "sha256": cell.digest, "data": cell.to_dict()}
    return data


def decode_clearance(arm: Arm, data: dict[str, Any], shape: CollisionModel | None = None) -> Clearance | None:
    """Make the clearance that :func:`encode_clearance` encoded; None if the data contain none.

    Args:
        arm: Arm model.
        data: Stored data.
        shape: Shape that the capsules contain, if known; else they are the shape itself.

    Raises:
        InputError: A file that the cell names is missing or has changed.
    """
    stored_clearance, stored_cell = data.get("clearance"), data.get("cell")
    if stored_clearance is None:
        return None
    cell = None
    if stored_cell is not None:
        cell = Cell.from_dict(stored_cell["data"])
        if stored_cell["sha256"] != cell.digest:
            raise InputError(f"the cell '{cell.name}' has changed since the run began: a file that it names is different")
    capsules = replace(Capsules.from_dict(stored_clearance["capsules"], arm), shape=shape)
    return Clearance(arm, capsules, cell, itself=stored_clearance.get("itself", True))
