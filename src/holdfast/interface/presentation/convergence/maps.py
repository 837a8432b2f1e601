"""Presentation of a convergence map."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.control.convergence.maps import ConvergenceMap
from holdfast.core.formatting import format_count, format_percent
from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation import renderers
from holdfast.interface.presentation.collision.shape import describe_shape, summarize_shape
from holdfast.interface.presentation.convergence.places import prepare_place_maps, write_place_table
from holdfast.interface.presentation.convergence.shares import format_range
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Presentation, TableSpec, make_headers

save = partial(renderers.save, dpi=130)
_END_PHRASES = {"stuck": "stop elsewhere", "moving": "keep moving", "undecided": "are undecided"}
_ENDING_LABELS = (
    "converges",
    "not reached, target in reach",
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


def present(result: ConvergenceMap) -> Presentation:
    """Present how often the target is still reached, the lock with the fewest successes, and the other outcomes."""
    law, arm, places = result.law, result.law.arm, format_count(len(result.places), result.over[:-1])
    title = (
        f"Starts from which {arm.name} reaches its target" if result.over == "starts" else f"Targets that {arm.name} reaches"
    )
    motions, motion_places = int(result.has_configuration.sum()), int(result.has_configuration.any(axis=1).sum())
    about = (
        f"{law.describe()} on {arm.title}: {motion_places} of {places} with {motions} motions, "
        f"{motions * len(result.columns)} runs, seed {result.seed}"
    )
    if motions:
        answer, facts, lines = _compose_answer(result)
    else:
        answer = (
            f"No configuration was found at any of the {places}, so no motion was simulated; choose {result.over} within reach."
        )
        facts, lines = [], []
    undecided = [f"{count} ({reason.replace('_', ' ')})" for reason, count in result.count_undecided().items() if count]
    if undecided:
        lines.append(f"Undecided runs: {', '.join(undecided)}.")
    return Presentation(
        f"{title} after an undetected lock",
        answer,
        about=about,
        lines=lines,
        facts=facts,
        tables=[_tabulate_outcomes(result)] if motions else [],
        figures=_list_figures(result) if motions else {},
        method=list_method_facts(result),
        arm=arm,
        exports={"map.csv": partial(_write_csv, result), "map.json": partial(renderers.write_json, result)},
    )


def _compose_answer(result: ConvergenceMap) -> tuple[str, list[Fact], list[str]]:
    """Compose the answer, its facts, and the sentences that follow it."""
    converged, trapped = result.shares("converged"), result.shares("trapped")
    *joints, healthy = converged
    values = np.array([converged[name].value for name in joints])
    mean_success, worst_joint = float(values.mean()), joints[int(values.argmin())]
    trapped_mean = float(np.mean([trapped[name].value for name in joints]))
    if not mean_success:
        fractions = {
            outcome: float(np.mean([share.value for name, share in result.shares(outcome).items() if name != healthy]))
            for outcome in _END_PHRASES
        }
        ending = max(fractions, key=lambda outcome: fractions[outcome])
        answer = (
            f"After an undetected lock, no motion reaches its target; {format_percent(fractions[ending])} of them "
            f"{_END_PHRASES[ending]}"
        )
    else:
        answer = f"After an undetected lock, {format_percent(mean_success)} of the motions reach their target"
        answer += (
            f" on average over the joints; after a lock of {worst_joint}, the worst, {_format_fraction(float(values.min()))} do"
            if np.ptp(values)
            else ", whichever joint locks"
        )
    answer += f". With no joint locked, {_format_fraction(converged[healthy].value)} do."
    phrase = "of the motions reach their target after a lock, on average over the joints"
    facts = [Fact("", mean_success, phrase=phrase, style="percent")]
    if np.ptp(values):
        phrase = f"after a lock of {worst_joint}, the worst; {format_range(converged[worst_joint])}"
        facts.append(Fact("", converged[worst_joint].value, phrase=phrase, style="percent"))
    facts.append(Fact("", converged[healthy].value, phrase="with no joint locked", style="percent"))
    if result.touched is not None:
        touched = result.shares("touched")
        touched_mean = float(np.mean([touched[name].value for name in joints]))
        answer += (
            f" {f'At most {format_percent(touched_mean)}' if touched_mean else 'None'} of the motions with a joint locked "
            "touch something on the way."
        )
        phrase = "of the motions with a joint locked, at most, touch something; a real arm would stop there"
        facts.append(Fact("", touched_mean, phrase=phrase, style="percent"))
    lines = []
    if trapped_mean:
        lines.append(
            f"{format_percent(trapped_mean)} of the motions with a joint locked do not reach their target although it is still "
            "within reach."
        )
    return answer, facts, lines


def _format_fraction(fraction: float) -> str:
    return {0.0: "none", 1.0: "all"}.get(fraction, format_percent(fraction))


def list_method_facts(result: ConvergenceMap) -> list[tuple[str, str]]:
    """List how the map was computed."""
    places, motions = int(result.has_configuration.any(axis=1).sum()), int(result.has_configuration.sum())
    return [
        ("Law", result.law.describe()),
        (
            "Motions",
            (
                f"{motions:,} between {places:,} of {format_count(len(result.places), result.over[:-1])} and their "
                f"counterparts, each simulated with every single joint locked and with none"
            ),
        ),
        (
            "Target within reach",
            "the arm reached it, or a search found a configuration within the limits with the joint locked at its value",
        ),
        ("Intervals", f"95 %; sampled by {result.over}, because the motions of one resemble each other"),
        *(
            []
            if result.clearance is None
            else [("Contacts", f"reported, not enforced; {describe_shape(result.clearance, 0.0)}")]
        ),
        ("Seed", str(result.seed)),
    ]


def _tabulate_outcomes(result: ConvergenceMap) -> TableSpec:
    """Tabulate the outcomes of the motions for each locked joint."""
    labels = {name: name for name in ("converged", "stuck", "moving", "undecided")} | {"trapped": "in reach, not reached"}
    labels |= {} if result.touched is None else {"touched": "touch something"}
    shares = [result.shares(outcome) for outcome in labels]
    rows = [(name, shares[0][name], *(share[name].value for share in shares[1:])) for name in result.columns]
    return TableSpec("How the motions end", ["locked", *make_headers(*labels.values(), style="percent")], rows)


def _write_csv(result: ConvergenceMap, path: Path) -> None:
    """Write the outcomes at each place."""
    columns = ["motions", *(f"{outcome}_{name}" for outcome in result.words for name in result.columns)]
    values = [result.has_configuration.sum(axis=1), *(result.values(outcome) for outcome in result.words)]
    write_place_table(path, result.places, columns, values)


def draw_map_outcomes(maps: Sequence[ConvergenceMap], titles: Sequence[str] = ("",)) -> report.Figure:
    """Draw the outcomes of the motions as one bar for each locked joint and each map."""
    stacks = [_build_outcome_stack(title, convergence_map) for title, convergence_map in zip(titles, maps, strict=True)]
    return report.stack_figure(stacks, _ENDING_LABELS, "fraction of the motions", caption=_compose_caption(maps[0], len(maps)))


def _build_outcome_stack(title: str, result: ConvergenceMap) -> report.Stack:
    bar_labels = [f"{name} locked" for name in result.columns[:-1]] + ["no joint locked"]
    converged = result.shares("converged")
    trapped = np.array([share.value for share in result.shares("trapped").values()])
    converged_values, lower, upper = (
        np.array([getattr(share, bound) for share in converged.values()]) for bound in ("value", "low", "high")
    )
    stuck, moving = _compute_unreachable_fractions(result, "stuck"), _compute_unreachable_fractions(result, "moving")
    return report.Stack(
        name=title,
        bars=bar_labels,
        shares=np.column_stack([converged_values, trapped, stuck, moving, 1 - converged_values - trapped - stuck - moving]),
        low=lower,
        high=upper,
    )


def _list_figures(result: ConvergenceMap) -> dict[str, FigureSpec]:
    """List ``outcomes``, bars for each joint, and ``map-top`` and ``map-side``, or ``map`` for a planar task."""
    percentages = {"converges": 100 * result.values("converged"), "in reach, not reached": 100 * result.values("trapped")}
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
        f"{_compose_caption(result)}\npositions of the {result.over}",
        target[0] if has_one_target else None,
    )
    bars_caption = "One bar for each joint that is locked from the start, and one for no lock. Lines are 95 % intervals."
    map_caption = f"Outcomes of the motions at the positions of the {result.over}, for each locked joint."
    return {
        "outcomes": FigureSpec(partial(draw_map_outcomes, [result]), "How the motions end", bars_caption),
        **{f"map{view}": FigureSpec(draw_view, "Outcomes by position", map_caption) for view, draw_view in maps.items()},
    }


def _compose_caption(result: ConvergenceMap, laws: int = 1) -> str:
    motions, places = int(result.has_configuration.sum()), len(result.places)
    law_text = f"{laws} laws" if laws > 1 else result.law.name
    return (
        f"{result.law.arm.name}, {law_text}, task {result.law.task.name}: {motions} motions over {places} "
        f"{result.over}, seed {result.seed}"
    )


def _compute_unreachable_fractions(result: ConvergenceMap, outcome: str) -> FloatArray:
    """Compute the fraction (n + 1,) of runs with this outcome and the target out of reach, as the mean over the places."""
    has_motions = result.has_configuration.any(axis=1)
    runs = (result.has_outcome(outcome) & ~result.in_reach)[has_motions].sum(axis=1)
    return np.asarray((runs / result.has_configuration[has_motions].sum(axis=1)[:, None]).mean(axis=0))
