"""Text, tables, and JSON of upper bounds of relative manipulability, and of their table."""

from __future__ import annotations

from math import isfinite
from typing import Any

from holdfast.core.formatting import format_percent
from holdfast.interface.presentation.printing import TextTable
from holdfast.kinematics.index_bounds.least_singular_values import BOUND_REASONS, SingularValueBound
from holdfast.kinematics.index_bounds.manipulability_bounds import UpperBound, UpperBoundTable

Found = UpperBound | UpperBoundTable | SingularValueBound


def to_dict(bounds: Found) -> dict[str, Any]:
    """Return the bound, the best known value, and the null space; the table has no null spaces."""
    if isinstance(bounds, UpperBoundTable):
        return {"ceilings": [_bound_values(bound) for bound in bounds.ceilings]}
    if isinstance(bounds, SingularValueBound):
        size = {
            "joints": bounds.n,
            "rows": bounds.m,
            "failures": bounds.k,
            "lever": bounds.lever if isfinite(bounds.lever) else None,
            "angular": bounds.angular,
        }
        jacobian = None if bounds.jacobian is None else bounds.jacobian.tolist()
        return size | {"bound": bounds.bound, "bound_by": bounds.bound_by, "jacobian": jacobian}
    return _bound_values(bounds) | {"null_space": None if bounds.null_space is None else bounds.null_space.tolist()}


def _bound_values(bound: UpperBound) -> dict[str, Any]:
    return {
        "joints": bound.n,
        "rows": bound.m,
        "failures": bound.k,
        "bound": bound.bound,
        "bound_by": bound.bound_by,
        "best_known": bound.best_known,
        "attained": bound.is_attained,
        "closed_form": bound.closed_form or None,
        "gap": bound.gap,
    }


def _format_row(bound: UpperBound) -> list[str]:
    best_text = "not known" if bound.best_known is None else "the same" if bound.is_attained else f"{bound.best_known:.6f}"
    gap_text = "" if bound.gap is None else "0" if bound.is_attained else format_percent(bound.gap)
    return [
        f"{bound.n}",
        f"{bound.m}",
        f"{bound.k}",
        f"{bound.bound:.6f}",
        bound.bound_by,
        best_text,
        bound.closed_form,
        gap_text,
    ]


_HEADER_ROW = ["joints", "rows", "failures", "bound", "by", "best known", "in roots", "gap"]


def tables(bounds: Found) -> list[TextTable]:
    """Tabulate the upper bounds, one row for each."""
    if isinstance(bounds, SingularValueBound):
        numbers = [f"{bounds.n}", f"{bounds.m}", f"{bounds.k}", f"{bounds.lever:.4g}", f"{bounds.bound:.6f}"]
        return [
            TextTable(
                [*_HEADER_ROW[:3], "lever", "bound", "by"], [[*numbers, f"{bounds.bound_by}: {BOUND_REASONS[bounds.bound_by]}"]]
            )
        ]
    return [
        TextTable(
            _HEADER_ROW,
            [_format_row(bound) for bound in (bounds.ceilings if isinstance(bounds, UpperBoundTable) else [bounds])],
        )
    ]


def key_table(bounds: Found) -> TextTable:
    """Return the first table."""
    return tables(bounds)[0]


def next_steps(bounds: Found, name: str) -> list[str]:
    """Suggest the null space or Jacobian that attains the value, or a verification."""
    if isinstance(bounds, UpperBoundTable):
        return [f"{name}.ceilings[0].null_space  # the best that is known"]
    if isinstance(bounds, SingularValueBound):
        return [f"{name}.bound  # no Jacobian has more" if bounds.jacobian is None else f"{name}.jacobian  # attains it"]
    return [f"{name}.verify()  # measures the null space anew"]
