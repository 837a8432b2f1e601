"""Basins in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from holdfast.equilibria.attraction import Basins
from holdfast.present.equilibria import points
from holdfast.present.printing import Rows, number

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def to_dict(found: Basins) -> dict[str, Any]:
    """The stationary points, and which fraction of the starts ends at each."""
    return {
        **points.to_dict(found.points),
        "starts": len(found.end),
        "fractions": [{"end": name, "fraction": i.value, "low": i.low, "high": i.high} for name, i in found.shares],
        "converged": {"fraction": found.converged.value, "low": found.converged.low, "high": found.converged.high},
        "confidence": found.confidence,
    }


def tables(found: Basins) -> list[Rows]:
    """A row for each end of a start."""
    codes = {found.name(k): k for k in range(len(found.points))}
    rows = [
        [name, str(share), number(found.points.error[codes[name]]) if name in codes else ""] for name, share in found.shares
    ]
    return [Rows(["ends at", "fraction of starts", points.error_head(found.points.law)], rows)]


def next_steps(found: Basins, name: str) -> list[str]:
    """The points themselves."""
    del found
    return [f"{name}.points  # where they are"]


def figures(found: Basins) -> dict[str, Figure]:
    """``basins``: a map where the starts are a grid over two joints, else bars."""
    from holdfast.present.equilibria.figures import basins_figure

    return {"basins": basins_figure(found)}
