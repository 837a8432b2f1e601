"""Presentation of the choice of a law: a comparison of the laws, and the convergence map of each."""

from __future__ import annotations

from functools import partial
from typing import Any

from holdfast.control.convergence.law_choice import LawChoice
from holdfast.core.formatting import format_count, format_percent
from holdfast.interface import report
from holdfast.interface.presentation import renderers
from holdfast.interface.presentation.convergence import maps
from holdfast.interface.presentation.convergence.shares import format_points, rank_successes
from holdfast.interface.presentation.presentation import Column, Fact, FigureSpec, Header, Presentation, TableSpec

_MAX_TITLE_LENGTH = 24  # characters of a title
save = partial(renderers.save, dpi=130)


def to_dict(choice: LawChoice) -> dict[str, Any]:
    """Return the best law, and the map of each law, as JSON data."""
    return {"best": choice.best, "laws": list(choice.names), "maps": [maps.to_dict(law_map) for law_map in choice.maps]}


def present(choice: LawChoice) -> Presentation:
    """Present the law that reaches the target most often, and the confidence in that result."""
    first_map, ranking = choice.maps[0], choice.ranking
    arm, task, best_law = first_map.law.arm, first_map.law.task, ranking[0]
    shares = {name: choice.share(name) for name in ranking}
    failures = format_count(int(first_map.has_configuration.sum()) * arm.n, "failure")
    share = shares[best_law]
    if not share.value:
        answer = (
            f"No target is reached after an undetected lock under any of the {len(shares)} laws; the success rate is at most "
            f"{format_percent(share.high)} (upper end of the 95 % interval)."
        )
    else:
        runner_up = ranking[1]
        difference = choice.difference(best_law, runner_up)
        points = f"{100 * difference.value:.1f} percentage points"
        if difference.low > 0:
            comparison = (
                f"{points} more than {runner_up} (95 % interval {100 * difference.low:.1f} to {100 * difference.high:.1f})"
            )
        else:
            comparison = (
                f"the difference from {runner_up} ({format_percent(shares[runner_up].value)}) is not significant at the 95 % "
                "level"
            )
        answer = (
            f"After an undetected lock, {best_law} reaches the target most often, in {format_percent(share.value)} of "
            f"{failures}; {comparison}."
        )
    facts = rank_successes(shares)
    columns: list[Column] = [
        "law",
        Header("converges after a lock", style="percent"),
        "difference from the best, percentage points",
    ]
    rows: list[list[Any]] = [
        [name, shares[name], "" if name == best_law else format_points(choice.difference(name, best_law))] for name in ranking
    ]
    if first_map.touched is not None:
        touched = [choice.share(name, outcome="touched").value for name in ranking]
        touched_text = f"at most {format_percent(touched[0])}" if touched[0] else "none"
        answer += f" With {best_law}, {touched_text} of the motions touch something on the way."
        phrase = f"of the motions with {best_law}, at most, touch something; a real arm would stop there"
        facts.append(Fact("", touched[0], phrase=phrase, style="percent"))
        columns.append(Header("touches something, at most", style="percent"))
        rows = [[*row, value] for row, value in zip(rows, touched, strict=True)]
    places = int(first_map.has_configuration.any(axis=1).sum())
    caption = "One bar for each joint that is locked from the start, and one for no lock. Lines are 95 % intervals."
    return Presentation(
        f"Control law with which {arm.name} reaches its targets most often",
        answer,
        about=f"{len(ranking)} laws on {arm.title}, task {task.describe()}; the same {failures} from {places} {first_map.over}",
        facts=facts,
        tables=[TableSpec("Paired differences with 95 % intervals", columns, rows)],
        figures={"laws": FigureSpec(partial(_draw_outcomes, choice), "How the motions end under each law", caption)},
        method=[
            *((f"Law {index}", law_map.law.describe()) for index, law_map in enumerate(choice.maps, 1)),
            *maps.list_method_facts(first_map)[1:],
        ],
        arm=arm,
        exports={f"{index}-{law_map.law.slug}": law_map.save for index, law_map in enumerate(choice.maps, 1)},
    )


def _draw_outcomes(choice: LawChoice) -> report.Figure:
    titles = [
        name if len(name) <= _MAX_TITLE_LENGTH else law_map.law.label
        for name, law_map in zip(choice.names, choice.maps, strict=True)
    ]
    return maps.draw_map_outcomes(choice.maps, titles)
