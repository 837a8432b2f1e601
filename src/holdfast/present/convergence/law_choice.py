"""The best law: numbers, the laws side by side, and the map of each."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from holdfast.convergence.law_choice import LawChoice
from holdfast.present import results
from holdfast.present.convergence import maps
from holdfast.present.printing import Rows
from holdfast.present.story import Story
from holdfast.words import capitalised, counted, percent

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SHORT = 24  # letters of a title


def to_dict(choice: LawChoice) -> dict[str, Any]:
    """The best law, and the map of each."""
    return {"best": choice.best, "laws": list(choice.names), "maps": [maps.to_dict(one) for one in choice.maps]}


def key_table(choice: LawChoice) -> Rows:
    """How often each law converges, the best first."""
    found = {name: choice.share(name) for name in choice.ranking}
    rows = [[name, f"{100 * s.value:.1f} % ({100 * s.low:.1f} to {100 * s.high:.1f})"] for name, s in found.items()]
    head = ["law", "converges after a lock, 95 %"]
    if choice.maps[0].touched is None:
        return Rows(head, rows)
    touched = [percent(choice.share(name, outcome="touched").value) for name in found]
    return Rows([*head, "touches something, at most"], [[*row, text] for row, text in zip(rows, touched, strict=True)])


def story(choice: LawChoice) -> Story:
    """Which law reaches the target most often, and how sure that is."""
    first = choice.maps[0]
    arm, best, shares = first.law.arm, choice.best, {name: choice.share(name) for name in choice.ranking}
    title, p = f"The law with which {arm.name} reaches its targets most often", shares[best]
    failures = int(first.known.sum()) * arm.n
    if not p.value:
        answer = (
            f"Under none of the {len(shares)} laws a target is reached after a lock; at most {percent(p.high)} would be, 95 %."
        )
    else:
        answer = (
            f"After an unnoticed lock {best} reaches the target most often, in "
            f"{percent(p.value)} of {counted(failures, 'failure')}"
        )
    facts = [(percent(p.value), f"with {best}; {percent(p.low)} to {percent(p.high)}, 95 %")] if p.value else []
    if p.value and len(shares) > 1:
        second = choice.ranking[1]
        d = choice.difference(best, second)
        points = f"{100 * d.value:.1f} percentage points"
        if d.low > 0:
            answer += f"; {points} more than {second} ({100 * d.low:.1f} to {100 * d.high:.1f}, 95 %)."
        else:
            answer += (
                f"; that it is more than with {second} ({percent(shares[second].value)}) cannot be told from these failures."
            )
        facts += [(percent(shares[second].value), f"with {second}, the next")] if shares[second].value else []
        last = choice.ranking[-1]
        facts += [(percent(shares[last].value), f"with {last}, the last")] if len(shares) > 2 and shares[last].value else []
    elif p.value:
        answer += "."
    if first.touched is not None:
        some = choice.share(best, outcome="touched").value
        answer += f" With {best} {f'at most {percent(some)}' if some else 'none'} of the motions touch something on the way."
        facts += (
            [(percent(some), f"of the motions touch something at most, with {best}; a real arm would stop")] if some else []
        )
    return Story(
        title,
        answer,
        about=f"{arm.name}, task {first.law.task.describe()}",
        facts=facts,
        lines=[f"{capitalised(line)}." for line in choice.describe()[1:]],
        figures={
            "laws": (
                "How the motions end under each law",
                "A bar for each joint that is locked from the start, and for none; lines: 95 % intervals.",
            )
        },
        tables=[key_table(choice)],
        method=[
            *((f"Law {k + 1}", one.law.describe()) for k, one in enumerate(choice.maps)),
            *maps.story(first).method[1:],
        ],
        arm=arm,
    )


def next_steps(choice: LawChoice, name: str) -> list[str]:
    """How sure the ranking is."""
    sure = [f"{name}.difference(*{name}.ranking[:2])  # how sure that is"] if len(choice.names) > 1 else []
    return [*sure, f"{name}.map_of({name}.best)"]


def figures(choice: LawChoice) -> dict[str, Figure]:
    """``laws``: how the motions ended with each joint locked, law by law."""
    titles = [name if len(name) <= _SHORT else one.law.label for name, one in zip(choice.names, choice.maps, strict=True)]
    return {"laws": maps.outcomes_figure(choice.maps, titles)}


def save(choice: LawChoice, folder: Path, command: str = "") -> list[Path]:
    """The figure and the page, and a folder with the map of each law."""
    files = results.save(choice, folder, command, dpi=130)
    for k, one in enumerate(choice.maps):
        files += maps.save(one, folder / f"{k + 1}-{one.law.slug}")
    return files
