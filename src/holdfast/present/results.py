"""How a result is shown where its own presenter does not say: sentences, figures, a page of both, a folder of everything."""

from __future__ import annotations

import re
import shlex
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from holdfast.errors import InputError
from holdfast.files.output import made
from holdfast.notice import says
from holdfast.present import presenter
from holdfast.present.printing import Rows, console, plain, print_json, print_rows, print_written
from holdfast.present.story import Story, how
from holdfast.result import Result, Shown
from holdfast.words import capitalised

_NARROW = 5  # columns
_HARD = "\N{NO-BREAK SPACE}"

if TYPE_CHECKING:
    from markupsafe import Markup
    from matplotlib.figure import Figure
    from rich.console import Console

    Drawings = dict[str, Callable[[], Figure]]


def printed(result: Result, as_json: bool, files: Sequence[Path | None] = (), listed: bool = False, **options: Any) -> None:
    """What a command prints: JSON for machines, with the files if they are listed; or what people read, and the files.

    The options are what was asked about the result: its ``to_dict`` and ``show`` take them.
    """
    if as_json:
        print_json(result.to_dict(**options) | ({"files": list(map(str, files))} if listed else {}))
        return
    out = console()
    result._presented("show", out, **options)
    print_written(out, files)


def printed_each(results: Sequence[Result], as_json: bool) -> None:
    """The same of several: one JSON document, a list where there are several."""
    if as_json:
        data = [result.to_dict() for result in results]
        print_json(data if len(data) > 1 else data[0])
        return
    for result in results:
        printed(result, False)


def said() -> str:
    """The command that runs, for its report."""
    return f"holdfast {shlex.join(sys.argv[1:])}"


def drawn(result: Result, plot: Path | None, out: Path | None = None) -> list[Path]:
    """The result's first figure as PNG, and the folder of its report, each if it is asked for."""
    files = []
    if plot is not None:
        from holdfast.report.figures import save_png

        files.append(save_png(next(iter(result.figures().values())), plot))
    return files if out is None else [*files, *result.save(out, command=said())]


def as_json(result: Result, *args: Any, **options: Any) -> dict[str, Any]:
    """Its numbers in types that JSON has."""
    data: dict[str, Any] = plain(result._presented("to_dict", *args, **options))
    return data


def show(result: Result, out: Console) -> None:
    """The sentences and the tables."""
    for line in result.describe():
        out.print(line, markup=False, soft_wrap=True)
    for table in result._presented("tables"):
        print_rows(out, table)


def tables(result: Result) -> list[Rows]:
    """None."""
    del result
    return []


def figures(result: Result, **options: Any) -> dict[str, Figure]:
    """All that it can draw."""
    return {name: draw() for name, draw in result._presented("drawings", **options).items()}


def drawings(result: Result, **options: Any) -> Drawings:
    """Its figures by name, drawn when they are asked for; one that nobody wants takes no time.

    Of a class that has none of its own they are what it draws at once, if anything.
    """
    names = [each.__name__ for each in type(result).__mro__]
    at_once = presenter(names, "figures")
    drawn = {} if at_once is figures else at_once(result, **options)
    return {name: partial(_itself, figure) for name, figure in drawn.items()}


def _itself(figure: Figure) -> Figure:
    return figure


def story(result: Result) -> Story:
    """What it says of itself."""
    first, *others = map(capitalised, result.describe())
    title = re.sub("(?<=[a-z])(?=[A-Z])", " ", type(result).__name__).capitalize()
    return Story(title, first, lines=others)


@says("drawing the report")
def write(
    result: Result, path: Path, command: str = "", drawn: Mapping[str, Figure] | None = None, said: Story | None = None
) -> Path:
    """The answer, the figures and the tables, how it was computed, and the same run again.

    The figures are drawn anew if they are not given; what is said is what the result's own presenter says.
    """
    from holdfast.report import page

    said = said or result._presented("story")
    pictures: dict[str, list[page.Block]] = {}
    for name, figure in (result.figures() if drawn is None else drawn).items():
        told = said.figures.get(name, ("What was found", ""))
        if told is None:
            continue
        title, caption = told
        about = f"{said.title}: {title.lower()}"
        pictures.setdefault(title, []).append(page.Picture(_svg(figure, name, about), caption))
    tables = result._presented("tables") if said.tables is None else said.tables
    return page.write(
        page.Page(
            said.title,
            said.answer,
            [
                page.Section("", [page.Text(line) for line in said.lines]),
                *[page.Section(title, blocks) for title, blocks in [*said.views, *pictures.items()]],
                page.Section("In numbers", [as_table(rows) for rows in tables]),
            ],
            subtitle=said.about,
            facts=said.facts,
            method=how(said.arm, *said.method),
            again=command,
        ),
        path,
    )


def as_table(table: Rows) -> Any:
    """Rows as a block of a page; columns of words begin at the left."""
    from holdfast.report.page import Table

    rows = [[_beside(cell) for cell in row] for row in table.rows]
    wide = bool(rows) and len(rows[0]) > _NARROW
    worded = {k for row in table.rows for k, cell in enumerate(row) if cell[:1].isalpha() and cell not in ("none", "infinite")}
    return Table(rows, table.head, frozenset(range(1, len(table.head))) - worded, caption=table.title, wide=wide)


def _beside(cell: str) -> str:
    """With what is below a value beside it, or as a whole on the next line."""
    value, _, below = cell.partition("\n")
    return f"{value} ({_HARD.join(below.split())})" if below else value


def _svg(figure: Figure, name: str, about: str) -> Markup:
    from holdfast.report.figures import svg

    return svg(figure, name, about)


def save(result: Result, folder: Path, command: str = "", prefix: str = "", dpi: float = 100) -> list[Path]:
    """The figures as pictures, and the page."""
    from holdfast.report.figures import save_png

    folder, drawn = made(folder), result.figures()
    pictures = [save_png(figure, folder / f"{prefix}{name}.png", dpi) for name, figure in drawn.items()]
    page = folder / "report.html"
    common = presenter([each.__name__ for each in type(result).__mro__], "write") is write
    return [*pictures, write(result, page, command, drawn) if common else result.report(page, command=command)]


def plot(result: Result, name: str = "", **options: Any) -> Figure:
    """One of its figures, the first if none is named, which a notebook shows whether or not pyplot was imported."""
    from holdfast.present.notebook import shown_alone

    found = result._presented("drawings", **options) if name or options else result._presented("main_figure")
    if not found:
        steps = " or ".join(step.partition("  #")[0] for step in result._presented("next_steps", "result"))
        raise InputError(f"{type(result).__name__} has no figure; ask {steps} instead")
    if name and name not in found:
        raise InputError(f"{type(result).__name__} has no figure '{name}'; it has {', '.join(found)}")
    return shown_alone(found[name or next(iter(found))]())


def main_figure(result: Result) -> Drawings:
    """The first of its figures with its name; nothing where it has none. What is quicker alone says so."""
    return dict(list(result._presented("drawings").items())[:1])


def sentences(thing: Any) -> list[str]:
    """What it says of itself: of a result several, of anything else one."""
    said = thing.describe()
    return [said] if isinstance(said, str) else list(said)


def key_table(result: Result) -> Rows:
    """The first of its tables; of what has none the single numbers of its ``to_dict``."""
    for table in result._presented("tables"):
        return table  # type: ignore[no-any-return]
    rows = [
        [key.replace("_", " "), str(value)] for key, value in result.to_dict().items() if isinstance(value, (str, int, float))
    ]
    return Rows(["", ""], rows)


def next_steps(result: Result, name: str) -> list[str]:
    """All that it says."""
    del result
    return [f"{name}.describe()"]


def picture(thing: Shown, about: str) -> str:
    """The main figure of a result as HTML, if it has one."""
    from holdfast.present.notebook import image

    drawn = thing._presented("main_figure") if isinstance(thing, Result) else {}
    return "".join(image(draw(), f"{name}: {about}") for name, draw in drawn.items())


def in_notebook(thing: Shown) -> str:
    """The answer, a table of key numbers, the main figure, and what to ask next."""
    from holdfast.present.notebook import card

    return card(thing)
