"""A convergence map: numbers, figures and files."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.convergence.maps import ConvergenceMap
from holdfast.convergence.table import save_places
from holdfast.notice import says
from holdfast.present import results
from holdfast.present.clearance.shape import shape_summary, shape_text
from holdfast.present.convergence.places import panels
from holdfast.present.printing import Rows
from holdfast.present.story import Story
from holdfast.words import capitalised, counted, percent

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.present.results import Drawings
    from holdfast.report.outcomes import Stack

Array = NDArray[np.float64]

_ENDS = {"stuck": "stop elsewhere", "moving": "keep moving", "undecided": "are undecided"}
_ENDINGS = (
    "converges",
    "not there, target in reach",
    "stuck, target out of reach",
    "keeps moving, target out of reach",
    "undecided, target out of reach",
)


def to_dict(m: ConvergenceMap) -> dict[str, Any]:
    """Facts of a map as JSON types."""
    shares: dict[str, Any] = {}
    for word in m.words:
        shares[word] = {name: {"fraction": s.value, "low": s.low, "high": s.high} for name, s in m.shares(word).items()}
    return {
        **m.law.arm.entry(),
        "law": m.law.describe(),
        "task": m.law.task.name,
        "over": m.over,
        "places": len(m.places),
        "places_with_motions": int(m.known.any(axis=1).sum()),
        "motions": int(m.known.sum()),
        "seed": m.seed,
        "undecided_runs": m.undecided(),
        "confidence": 0.95,
        "limits_passed_fraction": dict(zip(m.columns, m.limits_passed[m.known].mean(axis=0).tolist(), strict=True)),
        "fractions": shares,
    } | ({} if m.clearance is None else {"clearance": shape_summary(m.clearance, 0.0)})


def key_table(m: ConvergenceMap) -> Rows:
    """How often the motions converge with each joint locked."""
    if not m.known.any():
        return Rows(["", ""], [["motions", "none"]])
    converged, trapped = m.shares("converged"), m.shares("trapped")
    cells = [
        [name, f"{100 * s.value:.1f} % ({100 * s.low:.1f} to {100 * s.high:.1f})", f"{100 * trapped[name].value:.1f} %"]
        for name, s in converged.items()
    ]
    return Rows(["locked", "converged, 95 %", "not there, target in reach"], cells)


def story(m: ConvergenceMap) -> Story:
    """How often the target is still reached, after which lock least often, and how the others end."""
    law, over = m.law, m.over
    title = (
        f"Starts from which {law.arm.name} reaches its target" if over == "starts" else f"Targets that {law.arm.name} reaches"
    )
    title += " after a lock that its controller does not know of"
    asked = f"{law.arm.name}, {law.describe()}"
    if not m.known.any():
        why = (
            f"No configuration was found at any of the {counted(len(m.places), over[:-1])}, so no "
            f"motion was made; choose places within reach."
        )
        return Story(title, why, about=asked, method=_method(m), arm=law.arm)
    converged, trapped = m.shares("converged"), m.shares("trapped")
    *joints, none = converged
    values = np.array([converged[name].value for name in joints])
    mean, worst, caught = float(values.mean()), joints[int(values.argmin())], float(np.mean([trapped[x].value for x in joints]))
    if not mean:
        ends = {word: float(np.mean([s.value for name, s in m.shares(word).items() if name != none])) for word in _ENDS}
        end = max(ends, key=lambda x: ends[x])
        answer = f"No motion reaches its target once a joint has locked: {percent(ends[end])} of them {_ENDS[end]}"
    else:
        answer = f"Once a joint has locked and nobody knows, {percent(mean)} of the motions reach their target"
        answer += (
            f"; a lock of {worst} leaves the least, {_often(float(values.min()))}"
            if np.ptp(values)
            else " whichever joint it is"
        )
    answer += f". With no joint locked {_often(converged[none].value)} do."
    facts = [(percent(mean), "of the motions reach their target, mean over the joint that locks")] if mean else []
    if np.ptp(values) and values.min():
        w = converged[worst]
        facts.append(
            (percent(w.value), f"once {worst} has locked, the worst of them; {percent(w.low)} to {percent(w.high)}, 95 %")
        )
    facts += [(percent(converged[none].value), "with no joint locked")] if converged[none].value else []
    facts += [(percent(caught), "do not get there although the target is still within reach")] if caught else []
    if m.touched is not None:
        touched = m.shares("touched")
        some = float(np.mean([touched[name].value for name in joints]))
        said = "of the motions touch something on the way at most, mean over the joint that locks, and a real arm would stop"
        facts += [(percent(some), said)] if some else []
        answer += f" On the way {percent(some) if some else 'none'} of those with a joint locked touch something."
    return Story(
        title,
        answer,
        about=asked,
        facts=facts,
        lines=[f"{capitalised(m.describe()[-1])}."] if sum(m.undecided().values()) else [],
        figures={
            "outcomes": (
                "How the motions end",
                "A bar for each joint that is locked from the start, and for none; lines: 95 % intervals.",
            ),
            **{
                f"map{view}": ("Where", f"The {over} by what becomes of their motions, joint by joint.")
                for view in ("", "-top", "-side")
            },
        },
        method=_method(m),
        arm=law.arm,
    )


def _often(fraction: float) -> str:
    return {0.0: "none", 1.0: "all"}.get(fraction, percent(fraction))


def _method(m: ConvergenceMap) -> list[tuple[str, str]]:
    places, motions = int(m.known.any(axis=1).sum()), int(m.known.sum())
    return [
        ("Law", m.law.describe()),
        (
            "Motions",
            (
                f"{motions:,} between {places:,} of {counted(len(m.places), m.over[:-1])} and their "
                f"counterparts, each with every joint locked and with none"
            ),
        ),
        (
            "Target within reach",
            "the arm reached it, or a configuration within the limits was found with the joint locked as it is",
        ),
        ("Intervals", "95 %; the unit is the place, whose motions resemble each other"),
        *([] if m.clearance is None else [("Contacts", f"reported, not enforced; {shape_text(m.clearance, 0.0)}")]),
        ("Seed", str(m.seed)),
    ]


def tables(m: ConvergenceMap) -> list[Rows]:
    """How the motions end with each joint locked."""
    if not m.known.any():
        return []
    ends = {word: m.shares(word) for word in m.words if word != "in_reach"}
    rows = []
    for name in m.columns:
        whole, *parts = (f"{100 * end[name].value:.1f} %" for end in ends.values())
        rows.append(
            [name, whole, f"{100 * ends['converged'][name].low:.1f} to {100 * ends['converged'][name].high:.1f}", *parts]
        )
    head = ["locked", "converged", "95 % interval", "stuck", "moving", "undecided", "not there, in reach"]
    return [Rows([*head, *(() if m.touched is None else ("touch something",))], rows)]


def next_steps(m: ConvergenceMap, name: str) -> list[str]:
    """The single motions, and the whole report."""
    del m
    return [f"{name}.to_xarray()  # every motion", f'{name}.report("map.html")']


@says("writing the results")
def save(m: ConvergenceMap, folder: Path, command: str = "") -> list[Path]:
    """``map.csv`` (a line for each place), ``map.json``, the figures and the page."""
    columns = ["motions", *(f"{word}_{name}" for word in m.words for name in m.columns)]
    values = [m.known.sum(axis=1), *(m.values(word) for word in m.words)]
    files = save_places(folder, "map", m.places, columns, values, m.to_dict())
    return files + results.save(m, folder, command, dpi=130)


def outcomes_figure(maps: Sequence[ConvergenceMap], titles: Sequence[str] = ("",)) -> Figure:
    """A bar for each locked joint and each map: how the motions ended."""
    from holdfast.report.outcomes import stack_figure

    stacks = [_bars(title, m) for title, m in zip(titles, maps, strict=True)]
    return stack_figure(stacks, _ENDINGS, "fraction of the motions", caption=_told(maps[0], len(maps)))


def _bars(title: str, m: ConvergenceMap) -> Stack:
    from holdfast.report.outcomes import Stack

    names = [f"{name} locked" for name in m.columns[:-1]] + ["no joint locked"]
    converged = m.shares("converged")
    trapped = np.array([s.value for s in m.shares("trapped").values()])
    there, low, high = (np.array([getattr(s, end) for s in converged.values()]) for end in ("value", "low", "high"))
    stuck, moving = _far(m, "stuck"), _far(m, "moving")
    return Stack(
        name=title,
        bars=names,
        shares=np.column_stack([there, trapped, stuck, moving, 1 - there - trapped - stuck - moving]),
        low=low,
        high=high,
    )


def drawings(m: ConvergenceMap) -> Drawings:
    """By file name: ``outcomes``, bars for each joint; ``map-top`` and ``map-side``, or ``map`` for a task in a plane."""
    rows = {"converges": 100 * m.values("converged"), "not there, in reach": 100 * m.values("trapped")}
    rows |= {} if m.touched is None else {"touches something": 100 * m.values("touched")}
    rows = {name: v[:, :-1] for name, v in rows.items()}
    target = m.target[m.known][:, :3, 3]
    alone = m.over == "starts" and len(np.unique(target, axis=0)) == 1
    maps = panels(
        m.law.task,
        m.places,
        rows,
        m.columns[:-1],
        "of the motions, percent",
        f"{_told(m)}\nwhere the {m.over} are",
        target[0] if alone else None,
    )
    return {"outcomes": partial(outcomes_figure, [m]), **{f"map{view}": draw for view, draw in maps.items()}}


def _told(m: ConvergenceMap, laws: int = 1) -> str:
    motions, places = int(m.known.sum()), len(m.places)
    law = f"{laws} laws" if laws > 1 else m.law.name
    return f"{m.law.arm.name}, {law}, task {m.law.task.name}: {motions} motions over {places} {m.over}, seed {m.seed}"


def _far(m: ConvergenceMap, word: str) -> Array:
    """(n + 1,) fraction of the runs that ended so with the target out of reach, every place alike."""
    some = m.known.any(axis=1)
    runs = (m.happened(word) & ~m.in_reach)[some].sum(axis=1)
    return np.asarray((runs / m.known[some].sum(axis=1)[:, None]).mean(axis=0))
