"""One-file HTML pages from a few kinds of blocks; every text is escaped unless it is ``Markup``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass, field
from functools import cache
from pathlib import Path
from typing import ClassVar, Literal

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from holdfast.files.output import replaced
from holdfast.report.viewer import with_library

Cell = str | Markup
_LONG = 15  # letters of a cell that is broken where need be


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
    tone: Literal["bad", "good", "note"] = "note"
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
    """

    rows: Sequence[Sequence[Cell]]
    head: Sequence[Cell] = ()
    numbers: frozenset[int] = frozenset()
    _: KW_ONLY
    marks: frozenset[int] = frozenset()
    caption: Cell = ""
    wide: bool = False
    kind: ClassVar[str] = "table"

    def look(self, column: int) -> str:
        """Class of the cells of a column."""
        return "number" if column in self.numbers else "mark" if column in self.marks else ""


@dataclass(frozen=True)
class Picture:
    """A figure with what it shows."""

    image: Markup
    caption: Cell
    kind: ClassVar[str] = "picture"


@dataclass(frozen=True)
class Code:
    """Text to copy."""

    text: str
    label: Cell = ""
    kind: ClassVar[str] = "code"


Block = Text | Callout | Table | Picture | Code


@dataclass(frozen=True)
class Section:
    """Blocks under a heading; a sheet begins a new page when it is printed."""

    title: str
    blocks: Sequence[Block]
    sheet: bool = False


@dataclass(frozen=True)
class Page:
    """A report: the answer first, then why.

    Attributes:
        title, subtitle: At the top.
        headline: The answer in one sentence.
        sections: In order.
        warnings: Before everything else.
        footer: At the end.
    """

    title: str
    headline: Cell
    sections: Sequence[Section]
    _: KW_ONLY
    subtitle: Cell = ""
    warnings: Sequence[Callout] = field(default_factory=tuple)
    footer: Cell = ""


def _breakable(cell: Cell) -> Cell:
    """A cell whose long names may be broken behind an underscore, so that those of a file do not push a table off the page."""
    return cell if isinstance(cell, Markup) or len(cell) < _LONG else Markup("_<wbr>").join(cell.split("_"))


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
    return made


def render(page: Page) -> str:
    """The page as HTML that needs nothing else: no files, no network, and no scripts but those of an animation in it."""
    return with_library(environment().get_template("page.html").render(page=page))


def write(page: Page, path: str | Path) -> Path:
    """Write the page, all of it or nothing.

    Raises:
        StoreError: The file cannot be written; what was there before is as it was.
    """
    file = Path(path)
    replaced(file, render(page), "report", errors="replace")
    return file
