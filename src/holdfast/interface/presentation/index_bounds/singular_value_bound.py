"""Presentation of an upper bound on the smallest singular value."""

from __future__ import annotations

from math import inf

from holdfast.interface.presentation.presentation import Fact, Presentation
from holdfast.kinematics.index_bounds.least_singular_values import BOUND_REASONS, SingularValueBound
from holdfast.kinematics.index_bounds.manipulability_bounds import count_rows, failure_phrase


def present(bound: SingularValueBound) -> Presentation:
    """Present the bound, its reason, and its assumptions."""
    lever_unit = "characteristic lengths" if bound.angular else "m"
    if bound.lever == inf:
        lengths = "any lengths"
    else:
        lengths = f"mean lever of the joints {bound.lever:.4g} {'in ' * bound.angular}{lever_unit}"
    reason = f"{bound.bound_by}, {BOUND_REASONS[bound.bound_by]}{', attained' if bound.jacobian is not None else ''}"
    return Presentation(
        "Upper bound on the smallest singular value",
        f"With {bound.n} joints, a task of {count_rows(bound.m)} and {lengths}, the smallest singular value is at most "
        f"{bound.bound:.6g} when {failure_phrase(bound.k)} ({reason}).",
        facts=[
            Fact("joints", bound.n, key="joints"),
            Fact("rows", bound.m, key="rows"),
            Fact("failures", bound.k, key="failures"),
            Fact("lever", bound.lever, "" if bound.lever == inf else lever_unit, key="lever"),
            Fact("angular rows", bound.angular, key="angular"),
            Fact("bound", bound.bound, digits=6, key="bound"),
            Fact("by", bound.bound_by, key="bound_by"),
            Fact("", bound.jacobian, key="jacobian"),
        ],
    )
