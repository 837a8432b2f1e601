"""Self-contained HTML reports built from a few kinds of blocks; every text is escaped unless it is ``Markup``.

All reports have the same structure: the answer, the evidence, the computation, and the command that repeats the run. They are
complete without JavaScript, which adds sortable tables, the choice of theme, and the controls of :class:`Extra`.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from markupsafe import Markup

from holdfast.core.files.output import replace_file
from holdfast.core.formatting import insert_nonbreaking_spaces
from holdfast.interface.report.viewer import embed_viewer_library, read_template, to_script_json

if TYPE_CHECKING:
    from jinja2 import Environment

Cell = str | Markup
FOOTER_TEXT = "Written by holdfast. This file needs no network and no other file."
_BREAKABLE_LETTERS = 15  # length from which the text of a cell may be broken after underscores
_UNBROKEN_TABLE_ROWS = 16  # tables with fewer rows are not split across printed pages


@dataclass(frozen=True)
class Text:
    """Paragraph, in small grey type if ``quiet``."""

    text: Cell
    quiet: bool = False
    kind: ClassVar[str] = "text"


@dataclass(frozen=True)
class Callout:
    """Highlighted paragraph with an optional title; ``tone`` selects its colour."""

    text: Cell
    tone: Literal["bad", "warn", "good", "note"] = "note"
    title: str = ""
    kind: ClassVar[str] = "callout"


@dataclass(frozen=True)
class Table:
    """Table of cells.

    Attributes:
        rows: Cells of each row; the first cell is the name of the row.
        head: Names of the columns; empty for a table without a head.
        numbers: Indices, from 0, of columns that are right-aligned.
        marks: Indices, from 0, of columns that are centred.
        caption: Text above the table.
        wide: Use the full width of the page.
        sortable: Make the table sortable by its head; None: only if it has a head, and at least three rows, all with names.
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
    """Figure with its caption; it is not printed if it is for the ``screen`` only."""

    image: Markup
    caption: Cell
    _: KW_ONLY
    screen: bool = False
    kind: ClassVar[str] = "picture"


@dataclass(frozen=True)
class Code:
    """Preformatted text to copy, with an optional paragraph (``label``) above."""

    text: str
    label: Cell = ""
    kind: ClassVar[str] = "code"


@dataclass(frozen=True)
class Extra:
    """Interactive controls, which are hidden without JavaScript and on paper.

    Attributes:
        script: Name of the script ``templates/SCRIPT.js``, which sets ``extras.SCRIPT = function (box, data) {...}``.
        data: Data for the script, in JSON types.
        html: HTML of the controls.
        label: Text alternative of the controls.
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
    """Blocks under a heading.

    Attributes:
        title: Heading and entry in the table of contents; both are omitted if empty.
        blocks: Content; a page omits a section without blocks.
        sheet: Start a new page in print.
        anchor: Id of the section for links; derived from the title if empty.
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
        title, subtitle: Heading of the page, and the line below it.
        headline: Answer in one or two sentences; never an uninformative zero.
        sections: Evidence, in order.
        warnings: Highlighted paragraphs directly after the answer.
        facts: Most important numbers, each with its explanation.
        method: Description of the computation.
        again: Command that repeats the run, or blocks with this command and its files.
        footer: Line at the end.
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
            Section("Repeat this run", repeat_blocks, anchor="again"),
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
        """Names of the scripts that the controls (:class:`Extra`) of the page need."""
        extras = [block.script for _, section in self.parts for block in section.blocks if isinstance(block, Extra)]
        return list(dict.fromkeys(extras))


def _join_numbers_to_units(text: Cell) -> Cell:
    """Replace the spaces between numbers and their units by non-breaking ones."""
    return Markup(insert_nonbreaking_spaces(text, html=True)) if isinstance(text, Markup) else insert_nonbreaking_spaces(text)


def _break_after_underscores(cell: Cell) -> Cell:
    """Allow line breaks after the underscores of long names, so that such names do not make a table wider than the page."""
    joined = _join_numbers_to_units(cell)
    return (
        joined if isinstance(joined, Markup) or len(joined) < _BREAKABLE_LETTERS else Markup("_<wbr>").join(joined.split("_"))
    )


@cache
def create_template_environment() -> Environment:
    """Create the environment of the HTML templates, with their filters."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

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
    """Return the page as HTML that needs no other files and no network."""
    return embed_viewer_library(create_template_environment().get_template("page.html").render(page=page))


def write(page: Page, path: str | Path) -> Path:
    """Write the page to a file, completely or not at all, and return its path.

    Raises:
        StoreError: The file cannot be written; an existing file is then unchanged.
    """
    file = Path(path)
    replace_file(file, render(page), "report", errors="replace")
    return file
