"""One-file HTML pages built from a few kinds of blocks; every text is escaped unless it is ``Markup``.

All pages have one skeleton: the answer, its evidence, how it was computed, the same run again. Without JavaScript everything
is there to be read; with it tables are sorted, the theme is chosen, and :class:`Extra` answers back.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass
from functools import cache
from pathlib import Path
from typing import Any, ClassVar, Literal

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from holdfast.core.files.output import replace_file
from holdfast.core.formatting import insert_nonbreaking_spaces
from holdfast.interface.report.viewer import embed_viewer_library, read_template, to_script_json

Cell = str | Markup
FOOTER_TEXT = "Written by holdfast. This file needs no network and no other file."
_BREAKABLE_LETTERS = 15  # letters of a cell that is broken where need be
_UNBROKEN_TABLE_ROWS = 16  # rows of a table that is kept on one sheet of paper


@dataclass(frozen=True)
class Text:
    """Paragraph."""

    text: Cell
    quiet: bool = False
    kind: ClassVar[str] = "text"


@dataclass(frozen=True)
class Callout:
    """Highlighted paragraph."""

    text: Cell
    tone: Literal["bad", "warn", "good", "note"] = "note"
    title: str = ""
    kind: ClassVar[str] = "callout"


@dataclass(frozen=True)
class Table:
    """Table of cells.

    Attributes:
        rows: Cells; the first of a row is its name.
        head: Names of the columns; none if empty.
        numbers: Columns, from 0, that are aligned as numbers.
        marks: Columns that are centred.
        caption: Above the table.
        wide: Takes the width of the page.
        sortable: By its head, where there is JavaScript; None: if it has a head and each of three rows or more has a name.
    """

    rows: Sequence[Sequence[Cell]]
    head: Sequence[Cell] = ()
    numbers: frozenset[int] = frozenset()
    _: KW_ONLY
    marks: frozenset[int] = frozenset()
    caption: Cell = ""
    wide: bool = False
    sortable: bool | None = None
    kind: ClassVar[str] = "table"

    def look(self, column: int) -> str:
        """Return the CSS class of the cells of a column."""
        return "number" if column in self.numbers else "mark" if column in self.marks else ""

    @property
    def classes(self) -> str:
        """CSS classes of the table."""
        rows_are_named = bool(self.head) and len(self.rows) > 2 and all(row[0] for row in self.rows)
        class_flags = {
            "wide": self.wide,
            "keys": not self.head,
            "many": len(self.head) > 7,
            "short": len(self.rows) < _UNBROKEN_TABLE_ROWS,
            "sortable": rows_are_named if self.sortable is None else self.sortable,
        }
        return " ".join(name for name, applies in class_flags.items() if applies)


@dataclass(frozen=True)
class Picture:
    """Figure with its caption; one for the screen only is not printed."""

    image: Markup
    caption: Cell
    _: KW_ONLY
    screen: bool = False
    kind: ClassVar[str] = "picture"


@dataclass(frozen=True)
class Code:
    """Text to copy."""

    text: str
    label: Cell = ""
    kind: ClassVar[str] = "code"


@dataclass(frozen=True)
class Extra:
    """Interactive controls, which are hidden without JavaScript and on paper.

    Attributes:
        script: ``templates/SCRIPT.js``, which sets ``extras.SCRIPT = function (box, data) {...}``.
        data: What it knows, in types that JSON has.
        html: The controls.
        label: What they do, for people who cannot see them.
    """

    script: str
    data: Mapping[str, Any]
    html: Markup
    _: KW_ONLY
    label: str
    kind: ClassVar[str] = "extra"


Block = Text | Callout | Table | Picture | Code | Extra


@dataclass(frozen=True)
class Section:
    """Blocks under a heading; a sheet begins a new page in print.

    Attributes:
        title: The heading, and its entry in the contents.
        blocks: What is in it; a page leaves out a section of none.
        sheet: See above.
        anchor: Its place in the page, for links; made from the title if not given.
    """

    title: str
    blocks: Sequence[Block]
    sheet: bool = False
    _: KW_ONLY
    anchor: str = ""


@dataclass(frozen=True)
class Page:
    """HTML report: the answer, its evidence, and the method.

    Attributes:
        title, subtitle: At the top.
        headline: The answer in one sentence: never an uninformative zero.
        sections: The evidence, in order.
        warnings: Right after the answer.
        facts: The answer in a few numbers, each with what it is.
        method: How it was computed.
        again: The command that does it again, or blocks.
        footer: At the end.
    """

    title: str
    headline: Cell
    sections: Sequence[Section]
    _: KW_ONLY
    subtitle: Cell = ""
    warnings: Sequence[Callout] = ()
    facts: Sequence[tuple[Cell, Cell]] = ()
    method: Sequence[Block] = ()
    again: str | Sequence[Block] = ()
    footer: Cell = FOOTER_TEXT

    @property
    def parts(self) -> list[tuple[str, Section]]:
        """Sections with content, each with a unique anchor."""
        repeat_blocks = self.again
        if isinstance(repeat_blocks, str):
            repeat_blocks = [Code(repeat_blocks)] if repeat_blocks else []
        closing_sections = [
            Section("How it was computed", self.method, anchor="method"),
            Section("The same run again", repeat_blocks, anchor="again"),
        ]
        anchored_sections: list[tuple[str, Section]] = []
        anchor_counts: Counter[str] = Counter()
        for section in (candidate for candidate in [*self.sections, *closing_sections] if candidate.blocks):
            anchor = section.anchor or re.sub(r"[^a-z0-9]+", "-", section.title.lower()).strip("-") or "part"
            anchor_counts[anchor] += 1
            anchored_sections.append((anchor if anchor_counts[anchor] == 1 else f"{anchor}--{anchor_counts[anchor]}", section))
        return anchored_sections

    @property
    def scripts(self) -> list[str]:
        """Names of the scripts of the page's extras."""
        extras = [block.script for _, section in self.parts for block in section.blocks if isinstance(block, Extra)]
        return list(dict.fromkeys(extras))


def _join_numbers_to_units(text: Cell) -> Cell:
    """Replace the spaces between numbers and their units by non-breaking ones."""
    return Markup(insert_nonbreaking_spaces(text, html=True)) if isinstance(text, Markup) else insert_nonbreaking_spaces(text)


def _break_after_underscores(cell: Cell) -> Cell:
    """Allow line breaks behind the underscores of long names, so that names from files do not push a table off the page."""
    joined = _join_numbers_to_units(cell)
    return (
        joined if isinstance(joined, Markup) or len(joined) < _BREAKABLE_LETTERS else Markup("_<wbr>").join(joined.split("_"))
    )


@cache
def create_template_environment() -> Environment:
    """Create the environment of the HTML templates, with their filters."""
    templates = Environment(
        loader=PackageLoader("holdfast.interface.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    templates.filters["breakable"] = _break_after_underscores
    templates.filters["together"] = _join_numbers_to_units
    templates.filters["scripted"] = lambda data: Markup(to_script_json(data))
    templates.globals["source"] = lambda file: Markup(read_template(file))
    return templates


def render(page: Page) -> str:
    """Render the page as HTML that needs no other files and no network."""
    return embed_viewer_library(create_template_environment().get_template("page.html").render(page=page))


def write(page: Page, path: str | Path) -> Path:
    """Write the page to a file, completely or not at all.

    Raises:
        StoreError: The file cannot be written; what was there before is as it was.
    """
    file = Path(path)
    replace_file(file, render(page), "report", errors="replace")
    return file
