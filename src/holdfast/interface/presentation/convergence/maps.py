"""Numbers, figures and files of a convergence map."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.control.convergence.maps import ConvergenceMap
from holdfast.control.convergence.table import save_places
from holdfast.core.formatting import capitalise_first, format_count, format_percent
from holdfast.core.progress import reports_progress
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation import results
from holdfast.interface.presentation.collision.shape import describe_shape, summarize_shape
from holdfast.interface.presentation.convergence.places import prepare_place_maps
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.interface.presentation.results import Drawings
    from holdfast.interface.report.outcomes import Stack


_END_PHRASES = {"stuck": "stop elsewhere", "moving": "keep moving", "undecided": "are undecided"}
_ENDING_LABELS = (
    "converges",
    "not there, target in reach",
    "stuck, target out of reach",
    "keeps moving, target out of reach",
    "undecided, target out of reach",
)


def to_dict(result: ConvergenceMap) -> dict[str, Any]:
    """Return the contents of a convergence map as JSON data."""
    shares: dict[str, Any] = {}
    for outcome in result.words:
        shares[outcome] = {
            name: {"fraction": share.value, "low": share.low, "high": share.high}
            for name, share in result.shares(outcome).items()
        }
    return {
        **result.law.arm.entry(),
        "law": result.law.describe(),
        "task": result.law.task.name,
        "over": result.over,
        "places": len(result.places),
        "places_with_motions": int(result.has_configuration.any(axis=1).sum()),
        "motions": int(result.has_configuration.sum()),
        "seed": result.seed,
        "undecided_runs": result.count_undecided(),
        "confidence": 0.95,
        "limits_passed_fraction": dict(
            zip(result.columns, result.limits_passed[result.has_configuration].mean(axis=0).tolist(), strict=True)
        ),
        "fractions": shares,
    } | ({} if result.clearance is None else {"clearance": summarize_shape(result.clearance, 0.0)})


def key_table(result: ConvergenceMap) -> TextTable:
    """Return how often the motions converge with each joint locked."""
    if not result.has_configuration.any():
        return TextTable(["", ""], [["motions", "none"]])
    converged, trapped = result.shares("converged"), result.shares("trapped")
    cells = [
        [
            name,
            f"{100 * share.value:.1f} % ({100 * share.low:.1f} to {100 * share.high:.1f})",
            f"{100 * trapped[name].value:.1f} %",
        ]
        for name, share in converged.items()
    ]
    return TextTable(["locked", "converged, 95 %", "not there, target in reach"], cells)


def story(result: ConvergenceMap) -> PageContent:
    """Compose the report: how often the target is still reached, the lock with the fewest successes, and the other outcomes."""
    law, place_noun = result.law, result.over
    title = (
        f"Starts from which {law.arm.name} reaches its target"
        if place_noun == "starts"
        else f"Targets that {law.arm.name} reaches"
    )
    title += " after a lock that its controller does not know of"
    subject = f"{law.arm.name}, {law.describe()}"
    if not result.has_configuration.any():
        explanation = (
            f"No configuration was found at any of the {format_count(len(result.places), place_noun[:-1])}, so no "
            f"motion was made; choose places within reach."
        )
        return PageContent(title, explanation, about=subject, method=_list_method_facts(result), arm=law.arm)
    converged, trapped = result.shares("converged"), result.shares("trapped")
    *joints, healthy = converged
    values = np.array([converged[name].value for name in joints])
    mean_success, worst_joint, trapped_mean = (
        float(values.mean()),
        joints[int(values.argmin())],
        float(np.mean([trapped[x].value for x in joints])),
    )
    if not mean_success:
        fractions = {
            outcome: float(np.mean([share.value for name, share in result.shares(outcome).items() if name != healthy]))
            for outcome in _END_PHRASES
        }
        ending = max(fractions, key=lambda x: fractions[x])
        answer = (
            f"No motion reaches its target once a joint has locked: {format_percent(fractions[ending])} of them "
            f"{_END_PHRASES[ending]}"
        )
    else:
        answer = f"Once a joint has locked and nobody knows, {format_percent(mean_success)} of the motions reach their target"
        answer += (
            f"; a lock of {worst_joint} leaves the least, {_format_fraction(float(values.min()))}"
            if np.ptp(values)
            else " whichever joint it is"
        )
    answer += f". With no joint locked {_format_fraction(converged[healthy].value)} do."
    facts = (
        [(format_percent(mean_success), "of the motions reach their target, mean over the joint that locks")]
        if mean_success
        else []
    )
    if np.ptp(values) and values.min():
        lowest = converged[worst_joint]
        facts.append(
            (
                format_percent(lowest.value),
                f"once {worst_joint} has locked, the worst of them; {format_percent(lowest.low)} to "
                f"{format_percent(lowest.high)}, 95 %",
            )
        )
    facts += [(format_percent(converged[healthy].value), "with no joint locked")] if converged[healthy].value else []
    facts += (
        [(format_percent(trapped_mean), "do not get there although the target is still within reach")] if trapped_mean else []
    )
    if result.touched is not None:
        touched = result.shares("touched")
        touched_mean = float(np.mean([touched[name].value for name in joints]))
        touched_text = (
            "of the motions touch something on the way at most, mean over the joint that locks, and a real arm would stop"
        )
        facts += [(format_percent(touched_mean), touched_text)] if touched_mean else []
        answer += (
            f" On the way {format_percent(touched_mean) if touched_mean else 'none'} of those with a joint locked "
            f"touch something."
        )
    return PageContent(
        title,
        answer,
        about=subject,
        facts=facts,
        lines=[f"{capitalise_first(result.describe()[-1])}."] if sum(result.count_undecided().values()) else [],
        figures={
            "outcomes": (
                "How the motions end",
                "A bar for each joint that is locked from the start, and for none; lines: 95 % intervals.",
            ),
            **{
                f"map{view}": ("Where", f"The {place_noun} by what becomes of their motions, joint by joint.")
                for view in ("", "-top", "-side")
            },
        },
        method=_list_method_facts(result),
        arm=law.arm,
    )


def _format_fraction(fraction: float) -> str:
    return {0.0: "none", 1.0: "all"}.get(fraction, format_percent(fraction))


def _list_method_facts(result: ConvergenceMap) -> list[tuple[str, str]]:
    places, motions = int(result.has_configuration.any(axis=1).sum()), int(result.has_configuration.sum())
    return [
        ("Law", result.law.describe()),
        (
            "Motions",
            (
                f"{motions:,} between {places:,} of {format_count(len(result.places), result.over[:-1])} and their "
                f"counterparts, each with every joint locked and with none"
            ),
        ),
        (
            "Target within reach",
            "the arm reached it, or a configuration within the limits was found with the joint locked as it is",
        ),
        ("Intervals", "95 %; the unit is the place, whose motions resemble each other"),
        *(
            []
            if result.clearance is None
            else [("Contacts", f"reported, not enforced; {describe_shape(result.clearance, 0.0)}")]
        ),
        ("Seed", str(result.seed)),
    ]


def tables(result: ConvergenceMap) -> list[TextTable]:
    """Return how the motions end with each joint locked."""
    if not result.has_configuration.any():
        return []
    shares = {outcome: result.shares(outcome) for outcome in result.words if outcome != "in_reach"}
    table_rows = []
    for name in result.columns:
        converged, *other_cells = (f"{100 * outcome_shares[name].value:.1f} %" for outcome_shares in shares.values())
        table_rows.append(
            [
                name,
                converged,
                f"{100 * shares['converged'][name].low:.1f} to {100 * shares['converged'][name].high:.1f}",
                *other_cells,
            ]
        )
    header = ["locked", "converged", "95 % interval", "stuck", "moving", "undecided", "not there, in reach"]
    return [TextTable([*header, *(() if result.touched is None else ("touch something",))], table_rows)]


def next_steps(result: ConvergenceMap, name: str) -> list[str]:
    """Suggest the single motions and the full report."""
    del result
    return [f"{name}.to_xarray()  # every motion", f'{name}.report("map.html")']


@reports_progress("writing the results")
def save(result: ConvergenceMap, folder: Path, command: str = "") -> list[Path]:
    """Save ``map.csv`` (a line for each place), ``map.json``, the figures and the report."""
    columns = ["motions", *(f"{outcome}_{name}" for outcome in result.words for name in result.columns)]
    values = [result.has_configuration.sum(axis=1), *(result.values(outcome) for outcome in result.words)]
    files = save_places(folder, "map", result.places, columns, values, result.to_dict())
    return files + results.save(result, folder, command, dpi=130)


def draw_map_outcomes(maps: Sequence[ConvergenceMap], titles: Sequence[str] = ("",)) -> Figure:
    """Draw how the motions ended, with a bar for each locked joint and each map."""
    from holdfast.interface.report.outcomes import stack_figure

    stacks = [_build_outcome_stack(title, convergence_map) for title, convergence_map in zip(titles, maps, strict=True)]
    return stack_figure(stacks, _ENDING_LABELS, "fraction of the motions", caption=_compose_caption(maps[0], len(maps)))


def _build_outcome_stack(title: str, result: ConvergenceMap) -> Stack:
    from holdfast.interface.report.outcomes import Stack

    bar_labels = [f"{name} locked" for name in result.columns[:-1]] + ["no joint locked"]
    converged = result.shares("converged")
    trapped = np.array([share.value for share in result.shares("trapped").values()])
    converged_values, lower, upper = (
        np.array([getattr(share, bound) for share in converged.values()]) for bound in ("value", "low", "high")
    )
    stuck, moving = _compute_unreachable_fractions(result, "stuck"), _compute_unreachable_fractions(result, "moving")
    return Stack(
        name=title,
        bars=bar_labels,
        shares=np.column_stack([converged_values, trapped, stuck, moving, 1 - converged_values - trapped - stuck - moving]),
        low=lower,
        high=upper,
    )


def drawings(result: ConvergenceMap) -> Drawings:
    """Return functions that draw ``outcomes``, bars for each joint, and ``map-top`` and ``map-side``, or ``map`` for a planar
    task.
    """
    percentages = {"converges": 100 * result.values("converged"), "not there, in reach": 100 * result.values("trapped")}
    percentages |= {} if result.touched is None else {"touches something": 100 * result.values("touched")}
    percentages = {name: values[:, :-1] for name, values in percentages.items()}
    target = result.target[result.has_configuration][:, :3, 3]
    has_one_target = result.over == "starts" and len(np.unique(target, axis=0)) == 1
    maps = prepare_place_maps(
        result.law.task,
        result.places,
        percentages,
        result.columns[:-1],
        "of the motions, percent",
        f"{_compose_caption(result)}\nwhere the {result.over} are",
        target[0] if has_one_target else None,
    )
    return {"outcomes": partial(draw_map_outcomes, [result]), **{f"map{view}": draw_view for view, draw_view in maps.items()}}


def _compose_caption(result: ConvergenceMap, laws: int = 1) -> str:
    motions, places = int(result.has_configuration.sum()), len(result.places)
    law_text = f"{laws} laws" if laws > 1 else result.law.name
    return (
        f"{result.law.arm.name}, {law_text}, task {result.law.task.name}: {motions} motions over {places} "
        f"{result.over}, seed {result.seed}"
    )


def _compute_unreachable_fractions(result: ConvergenceMap, outcome: str) -> FloatArray:
    """Compute the fraction (n + 1,) of runs with this outcome and the target out of reach, every place alike."""
    has_motions = result.has_configuration.any(axis=1)
    runs = (result.has_outcome(outcome) & ~result.in_reach)[has_motions].sum(axis=1)
    return np.asarray((runs / result.has_configuration[has_motions].sum(axis=1)[:, None]).mean(axis=0))
