"""What ``clearance=`` and ``cell=`` mean together, for every function that takes them."""

from __future__ import annotations

from pathlib import Path

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.cell.cell import Cell, as_cell
from holdfast.clearance.clearance import Clearance
from holdfast.errors import InputError

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
