"""Numbers of the choice of a law, a comparison of the laws, and the convergence map of each."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from holdfast.control.convergence.law_choice import LawChoice
from holdfast.core.formatting import capitalise_first, format_count, format_percent
from holdfast.interface.presentation import results
from holdfast.interface.presentation.convergence import maps
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MAX_TITLE_LENGTH = 24  # letters of a title


def to_dict(choice: LawChoice) -> dict[str, Any]:
    """Return the best law, and the map of each law, as JSON data."""
    return {"best": choice.best, "laws": list(choice.names), "maps": [maps.to_dict(law_map) for law_map in choice.maps]}


def key_table(choice: LawChoice) -> TextTable:
    """Return how often each law converges, the best first."""
    shares = {name: choice.share(name) for name in choice.ranking}
    table_rows = [
        [name, f"{100 * share.value:.1f} % ({100 * share.low:.1f} to {100 * share.high:.1f})"] for name, share in shares.items()
    ]
    header = ["law", "converges after a lock, 95 %"]
    if choice.maps[0].touched is None:
        return TextTable(header, table_rows)
    touched = [format_percent(choice.share(name, outcome="touched").value) for name in shares]
    return TextTable(
        [*header, "touches something, at most"],
        [[*row, touched_text] for row, touched_text in zip(table_rows, touched, strict=True)],
    )


def story(choice: LawChoice) -> PageContent:
    """Compose the report: the law that reaches the target most often, and the confidence in that."""
    first_map = choice.maps[0]
    arm, best_law, shares = first_map.law.arm, choice.best, {name: choice.share(name) for name in choice.ranking}
    title, probability = f"The law with which {arm.name} reaches its targets most often", shares[best_law]
    failures = int(first_map.has_configuration.sum()) * arm.n
    if not probability.value:
        answer = (
            f"Under none of the {len(shares)} laws a target is reached after a lock; at most "
            f"{format_percent(probability.high)} would be, 95 %."
        )
    else:
        answer = (
            f"After an unnoticed lock {best_law} reaches the target most often, in "
            f"{format_percent(probability.value)} of {format_count(failures, 'failure')}"
        )
    facts = (
        [
            (
                format_percent(probability.value),
                f"with {best_law}; {format_percent(probability.low)} to {format_percent(probability.high)}, 95 %",
            )
        ]
        if probability.value
        else []
    )
    if probability.value and len(shares) > 1:
        runner_up = choice.ranking[1]
        difference = choice.difference(best_law, runner_up)
        points = f"{100 * difference.value:.1f} percentage points"
        if difference.low > 0:
            answer += f"; {points} more than {runner_up} ({100 * difference.low:.1f} to {100 * difference.high:.1f}, 95 %)."
        else:
            answer += (
                f"; that it is more than with {runner_up} ({format_percent(shares[runner_up].value)}) cannot be "
                f"told from these failures."
            )
        facts += [(format_percent(shares[runner_up].value), f"with {runner_up}, the next")] if shares[runner_up].value else []
        last_law = choice.ranking[-1]
        facts += (
            [(format_percent(shares[last_law].value), f"with {last_law}, the last")]
            if len(shares) > 2 and shares[last_law].value
            else []
        )
    elif probability.value:
        answer += "."
    if first_map.touched is not None:
        touched = choice.share(best_law, outcome="touched").value
        answer += (
            f" With {best_law} {f'at most {format_percent(touched)}' if touched else 'none'} of the motions touch "
            f"something on the way."
        )
        facts += (
            [(format_percent(touched), f"of the motions touch something at most, with {best_law}; a real arm would stop")]
            if touched
            else []
        )
    return PageContent(
        title,
        answer,
        about=f"{arm.name}, task {first_map.law.task.describe()}",
        facts=facts,
        lines=[f"{capitalise_first(line)}." for line in choice.describe()[1:]],
        figures={
            "laws": (
                "How the motions end under each law",
                "A bar for each joint that is locked from the start, and for none; lines: 95 % intervals.",
            )
        },
        tables=[key_table(choice)],
        method=[
            *((f"Law {index + 1}", law_map.law.describe()) for index, law_map in enumerate(choice.maps)),
            *maps.story(first_map).method[1:],
        ],
        arm=arm,
    )


def next_steps(choice: LawChoice, name: str) -> list[str]:
    """Suggest the confidence in the ranking and the map of the best law."""
    steps = [f"{name}.difference(*{name}.ranking[:2])  # how sure that is"] if len(choice.names) > 1 else []
    return [*steps, f"{name}.map_of({name}.best)"]


def figures(choice: LawChoice) -> dict[str, Figure]:
    """Draw ``laws``, the outcomes of the motions with each joint locked, law by law."""
    titles = [
        name if len(name) <= _MAX_TITLE_LENGTH else law_map.law.label
        for name, law_map in zip(choice.names, choice.maps, strict=True)
    ]
    return {"laws": maps.draw_map_outcomes(choice.maps, titles)}


def save(choice: LawChoice, folder: Path, command: str = "") -> list[Path]:
    """Save the figure, the report, and a folder with the map of each law."""
    files = results.save(choice, folder, command, dpi=130)
    for index, law_map in enumerate(choice.maps):
        files += maps.save(law_map, folder / f"{index + 1}-{law_map.law.slug}")
    return files
