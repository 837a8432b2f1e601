"""Basins in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from holdfast.equilibria.attraction import Basins
from holdfast.equilibria.stability import Kind
from holdfast.present.equilibria import points as points_of
from holdfast.present.printing import Rows
from holdfast.present.story import Story
from holdfast.words import counted, percent

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def to_dict(found: Basins) -> dict[str, Any]:
    """The stationary points, and which fraction of the starts ends at each."""
    return {
        **points_of.to_dict(found.points),
        "starts": len(found.end),
        "fractions": [{"end": name, "fraction": i.value, "low": i.low, "high": i.high} for name, i in found.shares],
        "converged": {"fraction": found.converged.value, "low": found.converged.low, "high": found.converged.high},
        "confidence": found.confidence,
    }


def tables(found: Basins) -> list[Rows]:
    """A row for each end of a start."""
    off = dict(zip(map(found.name, range(len(found.points))), points_of.off_target(found.points), strict=True))
    rows = [[name, str(share), off.get(name, "")] for name, share in found.shares]
    return [Rows(["ends at", "fraction of starts", "error"], rows)]


def story(found: Basins) -> Story:
    """Which fraction of the starts reaches the target, and where the others end."""
    p, points = found.converged, found.points
    told, count = points_of.story(points), counted(len(found.end), "start")
    away = max((x for x in found.shares if not _reached(found, x[0])), key=lambda x: x[1].value, default=None)
    lost = points_of.where(points)
    sure = f"{100 * p.confidence:.4g} %"
    if p.value == 0:
        out = "" if (points.kind == Kind.SOLUTION).any() else ": it is out of reach"
        answer = f"With {lost} none of {count} reaches the target{out} (at most {percent(p.high)} would, {sure})."
    else:
        answer = f"With {lost} {percent(p.value)} of {count} reach the target ({percent(p.low)} to {percent(p.high)}, {sure})."
    off = _off(found)
    if away is not None and away[1].value:
        answer = answer[:-1] + f"; {percent(away[1].value)} end {_words(away[0])}{off.get(away[0], '')}."
    facts = [
        *([(percent(p.value), f"of the starts reach the target; {percent(p.low)} to {percent(p.high)}")] if p.value else []),
        *[(percent(s.value), f"end {_words(name)}{off.get(name, '')}") for name, s in found.shares if s.value][:4],
    ]
    many = f"{found.shape[0]} by {found.shape[1]} cells" if found.shape else "starts drawn uniformly within the limits"
    return Story(
        f"Starts from which {points.law.arm.name} still reaches its target",
        answer,
        about=told.about,
        facts=facts if p.value else facts[:4],
        views=told.views,
        figures={"basins": ("Where the starts end", f"{count}, by where each ends; {many}.")},
        method=[
            ("Starts", f"{count}: {many}; each is simulated until it stops or the time limit comes"),
            (
                "Intervals",
                f"{100 * p.confidence:.4g} %, exact (Clopper-Pearson); of a grid those that as many random starts would have",
            ),
            *told.method[:-1],
        ],
        arm=points.law.arm,
    )


def _reached(found: Basins, name: str) -> bool:
    return name == "target" or name.startswith("solution")


def _words(name: str) -> str:
    """Where a start ends, behind the verb."""
    return {"moving": "nowhere: they keep moving", "undecided": "undecided", "target": "at the target"}.get(
        name, name if name.startswith("stuck") else f"at {name}"
    )


def _off(found: Basins) -> dict[str, str]:
    return {
        found.name(k): f", {error} off it"
        for k, error in enumerate(points_of.off_target(found.points))
        if found.points.kind[k] != Kind.SOLUTION
    }


def next_steps(found: Basins, name: str) -> list[str]:
    """The points themselves."""
    del found
    return [f"{name}.points  # where they are"]


def figures(found: Basins) -> dict[str, Figure]:
    """``basins``: a map where the starts are a grid over two joints, else bars."""
    from holdfast.present.equilibria.figures import basins_figure

    return {"basins": basins_figure(found)}
