"""Default presentation of results: sentences, figures, a page with both, and a folder with everything."""

from __future__ import annotations

import re
import shlex
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from holdfast.core.errors import InputError
from holdfast.core.files.output import make_folder
from holdfast.core.formatting import capitalise_first
from holdfast.core.progress import reports_progress
from holdfast.core.result import Presentable, Result
from holdfast.interface.presentation import call_presenter, find_presenter
from holdfast.interface.presentation.page_content import PageContent, build_method_blocks
from holdfast.interface.presentation.printing import (
    TextTable,
    make_console,
    print_json,
    print_table,
    print_written_files,
)
from holdfast.interface.presentation.renderers import as_json as as_json
from holdfast.interface.presentation.renderers import build_table_block, render_svg

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console

    Drawings = dict[str, Callable[[], Figure]]


def print_result(
    result: Result, as_json: bool, files: Sequence[Path | None] = (), listed: bool = False, **options: Any
) -> None:
    """Print a result: JSON for machines, with the files if they are listed; or text for people, and the files.

    The options are what was asked about the result: its ``to_dict`` and ``show`` take them.
    """
    if as_json:
        print_json(result.to_dict(**options) | ({"files": list(map(str, files))} if listed else {}))
        return
    out = make_console()
    call_presenter(result, "show", out, **options)
    print_written_files(out, files)


def print_results(results: Sequence[Result], as_json: bool) -> None:
    """Print several results: one JSON document (a list where there are several), or text."""
    if as_json:
        data = [result.to_dict() for result in results]
        print_json(data if len(data) > 1 else data[0])
        return
    for result in results:
        print_result(result, False)


def current_command() -> str:
    """Return the current command line for the report."""
    return f"holdfast {shlex.join(sys.argv[1:])}"


def write_outputs(result: Result, plot: Path | None, out: Path | None = None) -> list[Path]:
    """Write the first figure of the result as PNG, and the folder of its report, each if requested."""
    files = []
    if plot is not None:
        from holdfast.interface.report.figures import save_png

        files.append(save_png(next(iter(result.figures().values())), plot))
    return files if out is None else [*files, *result.save(out, command=current_command())]


def show(result: Result, out: Console) -> None:
    """Print the sentences and the tables."""
    for sentence in result.describe():
        out.print(sentence, markup=False, soft_wrap=True)
    for table in call_presenter(result, "tables"):
        print_table(out, table)


def tables(result: Result) -> list[TextTable]:
    """Return no tables."""
    del result
    return []


def figures(result: Result, **options: Any) -> dict[str, Figure]:
    """Draw all figures of the result."""
    return {name: draw_figure() for name, draw_figure in call_presenter(result, "drawings", **options).items()}


def drawings(result: Result, **options: Any) -> Drawings:
    """Return functions that draw the figures of the result, by name; a figure that is not requested takes no time.

    Of a class that has none of its own they are what it draws at once, if anything.
    """
    draw_all = find_presenter(type(result), "figures")
    figures_by_name = {} if draw_all is figures else draw_all(result, **options)
    return {name: partial(_return_figure, figure) for name, figure in figures_by_name.items()}


def _return_figure(figure: Figure) -> Figure:
    return figure


def story(result: Result) -> PageContent:
    """Compose the report from the sentences of the result."""
    headline, *remarks = map(capitalise_first, result.describe())
    title = re.sub("(?<=[a-z])(?=[A-Z])", " ", type(result).__name__).capitalize()
    return PageContent(title, headline, lines=remarks)


@reports_progress("drawing the report")
def write(
    result: Result, path: Path, command: str = "", drawn: Mapping[str, Figure] | None = None, content: PageContent | None = None
) -> Path:
    """Write the report: the answer, the figures and the tables, the method, and the command that reproduces the run.

    The figures are drawn anew if they are not given; what is said is what the result's own presenter says.
    """
    from holdfast.interface.report import page

    content = content or call_presenter(result, "story")
    figure_blocks: dict[str, list[page.Block]] = {}
    for name, figure in (result.figures() if drawn is None else drawn).items():
        captions = content.figures.get(name, ("What was found", ""))
        if captions is None:
            continue
        title, caption = captions
        description = f"{content.title}: {title.lower()}"
        figure_blocks.setdefault(title, []).append(page.Picture(render_svg(figure, name, description), caption))
    tables = call_presenter(result, "tables") if content.tables is None else content.tables
    return page.write(
        page.Page(
            content.title,
            content.answer,
            [
                page.Section("", [page.Text(sentence) for sentence in content.lines]),
                *[page.Section(title, blocks) for title, blocks in [*content.views, *figure_blocks.items()]],
                page.Section("In numbers", [build_table_block(text_table) for text_table in tables]),
            ],
            subtitle=content.about,
            facts=content.facts,
            method=build_method_blocks(content.arm, *content.method),
            again=command,
        ),
        path,
    )


def save(result: Result, folder: Path, command: str = "", prefix: str = "", dpi: float = 100) -> list[Path]:
    """Write the figures as PNG files, and the page."""
    from holdfast.interface.report.figures import save_png

    folder, figures_by_name = make_folder(folder), result.figures()
    pictures = [save_png(figure, folder / f"{prefix}{name}.png", dpi) for name, figure in figures_by_name.items()]
    report_file = folder / "report.html"
    uses_default_page = find_presenter(type(result), "write") is write
    return [
        *pictures,
        write(result, report_file, command, figures_by_name)
        if uses_default_page
        else result.report(report_file, command=command),
    ]


def plot(result: Result, name: str = "", **options: Any) -> Figure:
    """Draw one figure of the result, the first if none is named; a notebook shows it with or without pyplot."""
    from holdfast.interface.presentation.notebook import show_once

    draw_functions = call_presenter(result, "drawings", **options) if name or options else call_presenter(result, "main_figure")
    if not draw_functions:
        raise InputError(f"{type(result).__name__} has no figure; ask result.describe() instead")
    if name and name not in draw_functions:
        raise InputError(f"{type(result).__name__} has no figure '{name}'; it has {', '.join(draw_functions)}")
    return show_once(draw_functions[name or next(iter(draw_functions))]())


def main_figure(result: Result) -> Drawings:
    """Return the first figure with its name; nothing where there is none. A presenter with a faster figure overrides this
    function.
    """
    return dict(list(call_presenter(result, "drawings").items())[:1])


def sentences(thing: Any) -> list[str]:
    """Return the description of the result as a list of sentences."""
    description = thing.describe()
    return [description] if isinstance(description, str) else list(description)


def key_table(result: Result) -> TextTable:
    """Return the first table, or the scalar entries of ``to_dict`` if there is none."""
    for table in call_presenter(result, "tables"):
        return table  # type: ignore[no-any-return]
    rows = [
        [key.replace("_", " "), str(value)] for key, value in result.to_dict().items() if isinstance(value, (str, int, float))
    ]
    return TextTable(["", ""], rows)


def picture(thing: Presentable, about: str) -> str:
    """Return the main figure of a result as HTML, if it has one."""
    from holdfast.interface.presentation.notebook import embed_figure

    draw_functions = call_presenter(thing, "main_figure") if isinstance(thing, Result) else {}
    return "".join(embed_figure(draw_figure(), f"{name}: {about}") for name, draw_figure in draw_functions.items())


def in_notebook(thing: Presentable) -> str:
    """Return the answer, a table of key numbers, the main figure, and suggested next calls."""
    from holdfast.interface.presentation.notebook import build_card

    return build_card(thing)
