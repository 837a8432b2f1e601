"""What ``clearance=`` and ``cell=`` mean together, for every function that takes them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.cell.cell import Cell, as_cell
from holdfast.clearance.capsules import Capsules
from holdfast.clearance.clearance import Clearance
from holdfast.errors import InputError

if TYPE_CHECKING:
    from holdfast.clearance.shape import Shape

CellLike = Cell | str | Path
"""A cell, or the file that holds it."""


@checked
def chosen_clearance(
    arm: Arm, clearance: Clearance | bool | None = None, cell: CellLike | None = None, *, looks: bool = True
) -> Clearance | None:
    """What an arm is to be kept clear of, or None for nothing.

    Args:
        arm: The arm.
        clearance: Its shape and what it keeps clear of, maybe with a cell; None: :meth:`holdfast.Clearance.by_default`;
            True: the default shape, of an arm that moves in a plane too; False: the arm is not looked at beside itself.
        cell: Objects around it, or their file; they count whatever ``clearance`` says.
        looks: Without a clearance and a cell the default is looked at; else nothing is.

    Raises:
        InputError: A clearance of another arm, or with another cell than the one given.
        HoldfastError: The cell cannot be read, or does not fit the arm.
    """
    if isinstance(clearance, Clearance) and clearance.arm.fingerprint != arm.fingerprint:
        raise InputError(f"the clearance belongs to '{clearance.arm.name}', not to '{arm.name}'; make it with the same arm")
    around = as_cell(cell)
    if isinstance(clearance, Clearance):
        if around is None or (clearance.cell is not None and around.digest == clearance.cell.digest):
            return clearance
        if clearance.cell is not None:
            raise InputError(
                f"the clearance holds the cell '{clearance.cell.name}' and cell is '{around.name}'; give the cell in one place"
            )
        return clearance.with_cell(around)
    if clearance is None:
        return Clearance.by_default(arm, around) if looks or around is not None else None
    return Clearance(arm, cell=around, itself=clearance) if clearance or around is not None else None


def stored(clearance: Clearance, margin: float = 0.0) -> dict[str, Any]:
    """A clearance, and the margin kept in m, as JSON data: ``clearance`` and, around the arm, ``cell``."""
    data: dict[str, Any] = {"clearance": {"capsules": clearance.capsules.to_dict(clearance.arm), "margin": margin}}
    if not clearance.itself:
        data["clearance"]["itself"] = False
    if clearance.cell is not None:
        around = clearance.cell
        data["cell"] = {"name": around.name, "sha256": around.digest, "data": around.to_dict()}
    return data


def from_stored(arm: Arm, data: dict[str, Any], shape: Shape | None = None) -> Clearance | None:
    """What :func:`stored` made of a clearance; None if the data hold none.

    Args:
        arm: The arm.
        data: As stored.
        shape: What the capsules cover, if that is known; else they are the shape itself.

    Raises:
        InputError: A file that the cell names is gone, or not as it was.
    """
    apart, around = data.get("clearance"), data.get("cell")
    if apart is None:
        return None
    cell = None if around is None else Cell.from_dict(around["data"])
    if cell is not None and around is not None:
        formerly = cell.digest_with(around["data"].get("arm", {}).get("shape", ""))
        if around["sha256"] != formerly and around["sha256"] != cell.digest:
            raise InputError(f"the cell '{cell.name}' is not as it was when the run began: a file that it names changed")
    capsules = replace(Capsules.from_dict(apart["capsules"], arm), shape=shape)
    return Clearance(arm, capsules, cell, itself=apart.get("itself", True))
