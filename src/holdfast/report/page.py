"""One-file HTML pages from a few kinds of blocks; every text is escaped unless it is ``Markup``.

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

from holdfast.files.output import replaced
from holdfast.report.viewer import scripted, template, with_library
from holdfast.words import together

Cell = str | Markup
FOOTER = "Written by holdfast. This file needs no network and no other file."
_LONG = 15  # letters of a cell that is broken where need be
_SHORT = 16  # rows of a table that is kept on one sheet of paper


@dataclass(frozen=True)
class Text:
    """A paragraph."""

    text: Cell
    quiet: bool = False
    kind: ClassVar[str] = "text"


@dataclass(frozen=True)
class Callout:
    """A paragraph that must not be missed."""

    text: Cell
    tone: Literal["bad", "warn", "good", "note"] = "note"
    title: str = ""
    kind: ClassVar[str] = "callout"


@dataclass(frozen=True)
class Table:
    """A table.

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
        """Class of the cells of a column."""
        return "number" if column in self.numbers else "mark" if column in self.marks else ""

    @property
    def classes(self) -> str:
        """Classes of the table."""
        named = bool(self.head) and len(self.rows) > 2 and all(row[0] for row in self.rows)
        looks = {
            "wide": self.wide,
            "keys": not self.head,
            "many": len(self.head) > 7,
            "short": len(self.rows) < _SHORT,
            "sortable": named if self.sortable is None else self.sortable,
        }
        return " ".join(name for name, has in looks.items() if has)


@dataclass(frozen=True)
class Picture:
    """A figure with what it shows; one for the screen alone is not printed."""

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
    """Controls that answer back; without JavaScript, and on paper, they are not seen.

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
    """Blocks under a heading; a sheet begins a new page when it is printed.

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
    """A report: the answer first, then why, then how.

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
    footer: Cell = FOOTER

    @property
    def parts(self) -> list[tuple[str, Section]]:
        """The sections that hold something, each with an anchor of its own."""
        again = self.again
        if isinstance(again, str):
            again = [Code(again)] if again else []
        last = [
            Section("How it was computed", self.method, anchor="method"),
            Section("The same run again", again, anchor="again"),
        ]
        found: list[tuple[str, Section]] = []
        seen: Counter[str] = Counter()
        for section in (s for s in [*self.sections, *last] if s.blocks):
            name = section.anchor or re.sub(r"[^a-z0-9]+", "-", section.title.lower()).strip("-") or "part"
            seen[name] += 1
            found.append((name if seen[name] == 1 else f"{name}--{seen[name]}", section))
        return found

    @property
    def scripts(self) -> list[str]:
        """Names of the scripts of its extras."""
        extras = [b.script for _, section in self.parts for b in section.blocks if isinstance(b, Extra)]
        return list(dict.fromkeys(extras))


def _together(text: Cell) -> Cell:
    """A text in which no line ends between a number and its unit."""
    return Markup(together(text, html=True)) if isinstance(text, Markup) else together(text)


def _breakable(cell: Cell) -> Cell:
    """A cell whose long names may be broken behind an underscore, so that those of a file do not push a table off the page."""
    whole = _together(cell)
    return whole if isinstance(whole, Markup) or len(whole) < _LONG else Markup("_<wbr>").join(whole.split("_"))


@cache
def environment() -> Environment:
    """Where the templates are."""
    made = Environment(
        loader=PackageLoader("holdfast.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters["breakable"] = _breakable
    made.filters["together"] = _together
    made.filters["scripted"] = lambda data: Markup(scripted(data))
    made.globals["source"] = lambda file: Markup(template(file))
    return made


def render(page: Page) -> str:
    """The page as HTML that needs nothing else: no files, no network."""
    return with_library(environment().get_template("page.html").render(page=page))


def write(page: Page, path: str | Path) -> Path:
    """Write the page, all of it or nothing.

    Raises:
        StoreError: The file cannot be written; what was there before is as it was.
    """
    file = Path(path)
    replaced(file, render(page), "report", errors="replace")
    return file
