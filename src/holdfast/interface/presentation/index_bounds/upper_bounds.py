"""Presentation of an upper bound on relative manipulability, and of the table of stored bounds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from holdfast.core.formatting import format_percent
from holdfast.interface.presentation.presentation import Column, Header, Presentation, TableSpec
from holdfast.kinematics.index_bounds.manipulability_bounds import UpperBound, UpperBoundTable, count_rows, failure_phrase
from holdfast.kinematics.index_bounds.theorems import THEOREM_TEXTS


def to_dict(bounds: UpperBound | UpperBoundTable) -> dict[str, Any]:
    """Return the bound, the best known value, and the null space; the table has no null spaces."""
    if isinstance(bounds, UpperBoundTable):
        return {"ceilings": _tabulate_bounds(bounds.ceilings).records()}
    return _tabulate_bounds([bounds]).records()[0] | {"null_space": bounds.null_space}


def present(bounds: UpperBound | UpperBoundTable) -> Presentation:
    """Present the proved bound and the best known value, of one size or of all stored sizes."""
    if isinstance(bounds, UpperBoundTable):
        attained_count = sum(bound.is_attained for bound in bounds.ceilings)
        answer = (
            f"The maximum is known for {attained_count} of {len(bounds.ceilings)} sizes, where the bound is attained; for the "
            "others, the best known value is below the bound."
        )
        return Presentation("Upper bounds on relative manipulability", answer, tables=[_tabulate_bounds(bounds.ceilings)])
    head = f"With {bounds.n} joints and a task of {count_rows(bounds.m)}, when {failure_phrase(bounds.k)}"
    proof = " and ".join(f"{name}, {THEOREM_TEXTS[name]}" for name in bounds.bound_by.replace(" with ", " and ").split(" and "))
    if bounds.is_attained:
        answer = f"{head}, relative manipulability is at most {bounds.bound:.10g}: proved, and attained ({proof})."
    else:
        answer = f"{head}, no arm keeps more than {bounds.bound:.6g} of its manipulability: proved ({proof})."
    lines = []
    if bounds.best_known is None:
        lines.append("No best known value is stored for this size; search for one.")
    elif not bounds.is_attained:
        form = f" = {bounds.closed_form}" if bounds.closed_form else ""
        gap_text = format_percent(bounds.gap or 0.0)
        lines.append(f"The best known value is {bounds.best_known:.10g}{form}; the bound is {gap_text} above it.")
    return Presentation("Upper bound on relative manipulability", answer, lines=lines, tables=[_tabulate_bounds([bounds])])


def _tabulate_bounds(bounds: Sequence[UpperBound]) -> TableSpec:
    columns: list[Column] = [
        *("joints", "rows", "failures"),
        Header("bound", digits=6),
        Header("theorem", key="bound_by"),
        Header("best known", digits=6, key="best_known"),
        "attained",
        Header("closed form", key="closed_form"),
        Header("gap", style="percent"),
    ]
    rows = [(b.n, b.m, b.k, b.bound, b.bound_by, b.best_known, b.is_attained, b.closed_form or None, b.gap) for b in bounds]
    return TableSpec("", columns, rows)
