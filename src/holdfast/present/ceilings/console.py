"""Ceilings of relative manipulability, their table, and what a search found, in numbers and words."""

from __future__ import annotations

from math import isfinite
from typing import Any

from holdfast.ceilings.ceiling import Ceiling, CeilingTable
from holdfast.ceilings.least_singular_values import REASONS, SingularValueCeiling
from holdfast.ceilings.searching import CeilingSearch
from holdfast.present.printing import Rows
from holdfast.words import percent

Found = Ceiling | CeilingTable | CeilingSearch | SingularValueCeiling


def to_dict(found: Found) -> dict[str, Any]:
    """Bound, best known value and null space; of a table without null spaces."""
    if isinstance(found, CeilingTable):
        return {"ceilings": [_numbers(c) for c in found.ceilings]}
    if isinstance(found, CeilingSearch):
        numbers = _numbers(found.ceiling) | {"value": found.value, "seed": found.seed, "seconds": found.seconds}
        return numbers | {"null_space": found.null_space.tolist()}
    if isinstance(found, SingularValueCeiling):
        size = {
            "joints": found.n,
            "rows": found.m,
            "failures": found.k,
            "lever": found.lever if isfinite(found.lever) else None,
            "angular": found.angular,
        }
        jacobian = None if found.jacobian is None else found.jacobian.tolist()
        return size | {"bound": found.bound, "bound_by": found.bound_by, "jacobian": jacobian}
    return _numbers(found) | {"null_space": None if found.null_space is None else found.null_space.tolist()}


def _numbers(c: Ceiling) -> dict[str, Any]:
    return {
        "joints": c.n,
        "rows": c.m,
        "failures": c.k,
        "bound": c.bound,
        "bound_by": c.bound_by,
        "best_known": c.best_known,
        "attained": c.attained,
        "closed_form": c.closed_form or None,
        "gap": c.gap,
    }


def _row(c: Ceiling) -> list[str]:
    best = "not known" if c.best_known is None else "the same" if c.attained else f"{c.best_known:.6f}"
    gap = "" if c.gap is None else "0" if c.attained else percent(c.gap)
    return [f"{c.n}", f"{c.m}", f"{c.k}", f"{c.bound:.6f}", c.bound_by, best, c.closed_form, gap]


_HEAD = ["joints", "rows", "failures", "bound", "by", "best known", "in roots", "gap"]


def tables(found: Found) -> list[Rows]:
    """A row for each ceiling."""
    if isinstance(found, CeilingSearch):
        return [Rows(_HEAD, [_row(found.ceiling)], "what was known")]
    if isinstance(found, SingularValueCeiling):
        numbers = [f"{found.n}", f"{found.m}", f"{found.k}", f"{found.lever:.4g}", f"{found.bound:.6f}"]
        return [Rows([*_HEAD[:3], "lever", "bound", "by"], [[*numbers, f"{found.bound_by}: {REASONS[found.bound_by]}"]])]
    return [Rows(_HEAD, [_row(c) for c in (found.ceilings if isinstance(found, CeilingTable) else [found])])]


def key_table(found: Found) -> Rows:
    """The same for notebooks."""
    return tables(found)[0]


def next_steps(found: Found, name: str) -> list[str]:
    """What one does with it."""
    if isinstance(found, CeilingTable):
        return [f"{name}.ceilings[0].null_space  # the best that is known"]
    if isinstance(found, CeilingSearch):
        return [f"{name}.null_space  # attains {found.value:.6g}"]
    if isinstance(found, SingularValueCeiling):
        return [f"{name}.bound  # no Jacobian has more" if found.jacobian is None else f"{name}.jacobian  # attains it"]
    search = f"hf.ceilings.search(n={found.n}, m={found.m}, k={found.k}, seconds=60)  # is there a better one?"
    return [f"{name}.verify()  # measures the null space anew", *([] if found.attained else [search])]
