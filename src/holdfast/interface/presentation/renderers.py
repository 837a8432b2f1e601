"""Renderers of a presentation as console text, JSON, notebook view, page, figures, and results folder."""

from __future__ import annotations

import json
from collections.abc import Mapping
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from holdfast.core.errors import InputError
from holdfast.core.extras import MissingModuleError
from holdfast.core.files.output import make_folder, replace_file
from holdfast.core.formatting import insert_nonbreaking_spaces
from holdfast.core.progress import reports_progress
from holdfast.core.provenance import versions
from holdfast.core.result import Presentable, Result
from holdfast.interface import report
from holdfast.interface.presentation import call_presenter, find_presenter
from holdfast.interface.presentation.notebook import embed_figure, format_table, show_once
from holdfast.interface.presentation.presentation import FigureSpec, Presentation
from holdfast.interface.presentation.printing import TextTable, print_table, to_json_types
from holdfast.interface.report import page
from holdfast.interface.report.page import Block, Callout, Page, Picture, Section, Table, Text

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.model.arm.model import Arm

_MAX_NARROW_COLUMNS = 5  # columns
_HARD_SPACE = "\N{NO-BREAK SPACE}"
_TONE_COLORS = {"bad": "red", "warn": "yellow", "good": "green", "note": "default"}


def present(thing: Presentable, **options: Any) -> Presentation:
    """Return the presentation of an object; without a presenter for its class, it contains the sentences of ``describe``."""
    presenter = find_presenter(type(thing), "present")
    if presenter is present:
        answer, *lines = thing.describe()  # type: ignore[attr-defined]
        return Presentation(type(thing).__name__, answer, lines=lines)
    presentation: Presentation = presenter(thing, **options)
    return presentation


def sentences(thing: Presentable) -> list[str]:
    """Return the answer, the sentences after the answer, and the notices."""
    return _list_sentences(present(thing))


def _list_sentences(presentation: Presentation) -> list[str]:
    notices = [notice.sentence for notice in presentation.notices]
    return [text for text in (presentation.answer, *presentation.lines, *notices) if text]


def as_json(result: Result, *args: Any, **options: Any) -> dict[str, Any]:
    """Return the numbers of the result in JSON types."""
    data: dict[str, Any] = to_json_types(call_presenter(result, "to_dict", *args, **options))
    return data


def to_dict(result: Result, **options: Any) -> dict[str, Any]:
    """Return the arm, and the facts and tables that have a key, as JSON data."""
    presentation = present(result, **options)
    arm_entry = {} if presentation.arm is None else presentation.arm.entry()
    facts = {fact.key: fact.value for fact in presentation.facts if fact.key}
    return {**arm_entry, **facts, **{table.key: table.records() for table in presentation.list_tables() if table.key}}


def show(result: Result, out: Console, **options: Any) -> None:
    """Print the subject of the result, the answer, the reasons and notices, the numbers, and the tables."""
    from rich.markup import escape as escape_markup

    from holdfast.interface.presentation.terminal import BandedTable

    presentation = present(result, **options)
    if presentation.about:
        out.print(escape_markup(presentation.about), soft_wrap=True)
    out.print(f"[bold]{escape_markup(presentation.answer)}[/]", soft_wrap=True)
    for line in presentation.lines:
        out.print(escape_markup(line), soft_wrap=True)
    for notice in presentation.notices:
        out.print(f"[{_TONE_COLORS[notice.tone]}]{escape_markup(notice.sentence)}[/]", soft_wrap=True)
    if rows := _list_facts(presentation):
        facts = BandedTable()
        for row in rows:
            facts.add_row(*map(escape_markup, row))
        out.print(facts)
    for table in presentation.list_tables():
        if table.on_console and table.rows:
            print_table(out, table.texts())


def _list_facts(presentation: Presentation) -> list[list[str]]:
    """List the facts that have a label as rows of two texts."""
    return [[fact.label, fact.text] for fact in presentation.facts if fact.label]


# ---- notebooks -----------------------------------------------------------------------------------------------------------


def in_notebook(thing: Presentable) -> str:
    """Return the answer, the key numbers, and the main figure as HTML without scripts, for the output of a notebook cell."""
    presentation = present(thing)
    answer, *remarks = _list_sentences(presentation)
    parts = [f"<p><strong>{escape(answer)}</strong></p>", *(f"<p>{escape(remark)}</p>" for remark in remarks[:2])]
    rows = _list_facts(presentation)
    if not rows and not presentation.tables and isinstance(thing, Result):
        rows = [[key.replace("_", " "), str(x)] for key, x in thing.to_dict().items() if isinstance(x, (str, int, float))]
    facts = TextTable(["", ""], rows)
    parts.append(
        format_table(facts if facts.rows or not presentation.tables else next(iter(presentation.list_tables())).texts())
    )
    try:
        parts.append(call_presenter(thing, "picture", answer))
    except MissingModuleError as error:
        parts.append(f"<p>{escape(str(error))}</p>")
    return f'<div class="holdfast" style="max-width:60em">{insert_nonbreaking_spaces("".join(parts), html=True)}</div>'


def picture(thing: Presentable, about: str) -> str:
    """Return the main figure as HTML, if there is one."""
    main_figure = list(present(thing).figures.items())[:1]
    return "".join(embed_figure((figure.preview or figure.draw)(), f"{name}: {about}") for name, figure in main_figure)


# ---- figures -------------------------------------------------------------------------------------------------------------


def figures(result: Result, **options: Any) -> dict[str, report.Figure]:
    """Draw all figures of the result."""
    return {name: figure.draw() for name, figure in present(result, **options).figures.items()}


def plot(result: Result, name: str = "", **options: Any) -> report.Figure:
    """Draw one figure of the result, the first one if ``name`` is empty; a notebook shows it with or without pyplot.

    Raises:
        InputError: The result has no figure, or none with this name.
    """
    specs: Mapping[str, FigureSpec] = present(result, **options).figures
    if not specs:
        raise InputError(f"{type(result).__name__} has no figure; use result.describe() instead")
    if name and name not in specs:
        raise InputError(f"{type(result).__name__} has no figure '{name}'; it has {', '.join(specs)}")
    return show_once(specs[name or next(iter(specs))].draw())


# ---- pages and folders ---------------------------------------------------------------------------------------------------


@reports_progress("drawing the report")
def write(result: Result, path: Path, command: str = "", **options: Any) -> Path:
    """Write the HTML report: the answer, the evidence, the method, and the command that reproduces the run."""
    return page.write(build_page(present(result, **options), command), path)


def build_page(presentation: Presentation, command: str = "", drawn: Mapping[str, report.Figure] | None = None) -> Any:
    """Build the page of a presentation; ``drawn`` contains figures, by name, that need not be drawn again."""
    figure_blocks: dict[str, list[Block]] = {}
    for name, figure in presentation.figures.items():
        if figure.on_page:
            drawn_figure = drawn[name] if drawn and name in drawn else figure.draw()
            image = report.svg(drawn_figure, name, f"{presentation.title}: {figure.title.lower()}")
            figure_blocks.setdefault(figure.title, []).append(Picture(image, figure.caption))
    # A number that is zero or missing is omitted at the top of the page.
    is_at_top = [bool(fact.phrase) and fact.text.partition(" ")[0] not in ("0", "–", "none") for fact in presentation.facts]
    facts = list(zip(presentation.facts, is_at_top, strict=True))
    small_facts = [[fact.label, fact.text] for fact, at_top in facts if fact.label and not at_top]
    tables = [TextTable(["", ""], small_facts)] if small_facts else []
    tables += [table.texts() for table in presentation.list_tables() if table.on_page]
    sections: list[Section] = [
        Section("", [Text(sentence) for sentence in presentation.lines]),
        *presentation.sections(),
        *[Section(title, blocks) for title, blocks in figure_blocks.items()],
        Section("Numbers", [build_table_block(table) for table in tables]),
    ]
    return Page(
        presentation.title,
        presentation.answer,
        sections,
        subtitle=presentation.about,
        warnings=[Callout(notice.text, notice.tone, notice.title) for notice in presentation.notices],
        facts=[(fact.text, fact.phrase) for fact, at_top in facts if at_top],
        method=build_method_blocks(presentation.arm, *presentation.method),
        again=command if presentation.again is None else presentation.again(),
    )


def build_table_block(table: TextTable) -> Any:
    """Convert a table to a block of a page; columns that contain words are left-aligned."""
    head = table.head if any(table.head) else ()
    rows = [[_flatten_cell(cell) for cell in row] for row in table.rows]
    is_wide = bool(rows) and len(rows[0]) > _MAX_NARROW_COLUMNS
    word_columns = {
        column
        for row in table.rows
        for column, cell in enumerate(row)
        if cell[:1].isalpha() and cell not in ("none", "infinite")
    }
    return Table(rows, head, frozenset(range(1, len(head))) - word_columns, caption=table.title, wide=is_wide)


def _flatten_cell(cell: str) -> str:
    """Return a two-line cell as one line, with the second line (an interval) in parentheses."""
    value, _, second_line = cell.partition("\n")
    return f"{value} ({_HARD_SPACE.join(second_line.split())})" if second_line else value


def save(result: Result, folder: Path, command: str = "", prefix: str = "", dpi: float = 100, **options: Any) -> list[Path]:
    """Write the figures as PNG files, the exported files, and the report into a folder; return all written paths."""
    folder, presentation = make_folder(folder), present(result, **options)
    drawn = {name: figure.draw() for name, figure in presentation.figures.items() if figure.saved}
    files = [report.save_png(figure, folder / f"{prefix}{name}.png", dpi) for name, figure in drawn.items()]
    for name, write_file in presentation.exports.items():
        write_file(folder / name)
        files.append(folder / name)
    return [*files, page.write(build_page(presentation, command, drawn), folder / "report.html")]


def write_rrd(result: Result, path: Path) -> Path:
    """Write the motion of the result as a recording for the Rerun viewer."""
    from holdfast.interface.presentation.arm import rerun

    return rerun.write_rrd(result, path)


def write_json(result: Result, path: Path) -> None:
    """Write the numbers of the result as JSON."""
    replace_file(path, json.dumps(result.to_dict(), indent=2) + "\n")


def build_method_blocks(arm: Arm | None, *rows: tuple[Any, Any]) -> list[Any]:
    """Build the method section of a page from the given rows, the provenance of the arm, and the package versions."""
    if arm is not None:
        fingerprint = Markup("<code>{}</code>").format(arm.fingerprint)
        rows = (*rows, ("Arm", arm.provenance), ("Fingerprint of the arm", fingerprint))
    return [Table([*rows, ("Versions", format_versions(versions("holdfast", "numpy", "scipy", "casadi", "llvmlite")))])]


def format_versions(versions: Mapping[str, Any]) -> str:
    """Format the versions of packages as one line."""
    return ", ".join(f"{name} {version}" for name, version in versions.items())
