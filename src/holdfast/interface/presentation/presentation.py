"""Description of a result from which its console text, JSON, notebook view, page, and files are rendered.

The presenter of a class is a module with a function ``present(result, **options) -> Presentation``, and ``to_dict`` if the JSON
document contains more than the facts and tables. The options are parameters of the presentation, for example thresholds.
Parts that take time (figures, views of an arm, long tables) are given as functions, which are called only if they are shown.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from holdfast.core.formatting import Probability, format_interval, format_number, format_percent
from holdfast.interface import report
from holdfast.interface.presentation.printing import TextTable, format_column, format_position, format_positions
from holdfast.interface.report.page import Block, Section

if TYPE_CHECKING:
    from holdfast.model.arm.model import Arm

Style = Literal["number", "percent", "text", "angle"]  # angle: rad is also given in degrees


def format_value(value: Any, style: Style = "number", unit: str = "", digits: int = 4) -> str:
    """Format a value of a fact or a cell with its unit; it can be a text, flag, count, number, interval, or range (a tuple)."""
    if value is None or isinstance(value, str):
        return value or ""
    if isinstance(value, (bool, np.bool_)):
        return "yes" if value else "no"
    if isinstance(value, (int, np.integer)):
        text = f"{value:,}"
    elif isinstance(value, tuple):
        text = " to ".join(format_value(end, style, "", digits) for end in value)
    elif hasattr(value, "confidence"):
        text = _format_probability(value, style)
    elif style == "percent":
        return format_percent(float(value)) if math.isfinite(value) else "–"
    elif style == "angle":
        return format_position(value, unit, digits)
    else:
        text = format_number(value, digits)
    return f"{text} {unit}" if unit not in ("", "1") else text


def _format_probability(estimate: Probability, style: Style) -> str:
    if style != "percent":
        return format_interval(estimate)
    low, high = (format_percent(end) for end in (estimate.low, estimate.high))
    return f"{format_percent(estimate.value)} ({low} to {high}, {100 * estimate.confidence:.4g} %)"


@dataclass(frozen=True)
class Fact:
    """Number or word of a result.

    Attributes:
        label: Name on the console, in notebooks, and in the table of the page; empty if only the top of the page shows it.
        value: A number, text, flag, interval (:class:`~holdfast.Interval`), or range (a tuple).
        unit: Unit of the value, for example ``"mm"``.
        phrase: Explanation next to the number at the top of the page; empty if the table of the page contains it instead.
        style: Format of the value: ``percent`` for fractions, ``angle`` for rad with the value in degrees added.
        digits: Significant digits.
        key: Name in JSON, used if the presenter has no ``to_dict``.
    """

    label: str
    value: Any
    unit: str = ""
    _: KW_ONLY
    phrase: str = ""
    style: Style = "number"
    digits: int = 4
    key: str = ""

    @property
    def text(self) -> str:
        """Formatted value with its unit."""
        return format_value(self.value, self.style, self.unit, self.digits)


@dataclass(frozen=True)
class Header:
    """Head of a column of a table: its label, and the unit of its values, or one unit for each row.

    Numbers with the same unit share one precision if their magnitudes allow it; ``aligned=False`` formats each separately.
    ``key`` is the name in JSON if it differs from the label.
    """

    label: str
    unit: str | Sequence[str] = ""
    _: KW_ONLY
    style: Style = "number"
    digits: int = 4
    aligned: bool = True
    key: str = ""

    def texts(self, values: Sequence[Any]) -> list[str]:
        """Format the values of the column."""
        units = [self.unit] * len(values) if isinstance(self.unit, str) else list(self.unit)
        if self.aligned and self.style == "angle":
            return format_positions(values, units, self.digits)
        if self.aligned and self.style == "number":
            if values and all(isinstance(value, (float, np.floating)) for value in values):
                return format_column(values, units, self.digits)
            if values and all(isinstance(value, tuple) for value in values):  # both ends of all ranges with one precision
                ends = format_column([end for value in values for end in value], digits=self.digits)
                return [
                    f"{low} to {high}" + (f" {unit}" if unit not in ("", "1") else "")
                    for low, high, unit in zip(ends[::2], ends[1::2], units, strict=True)
                ]
        return [format_value(value, self.style, unit, self.digits) for value, unit in zip(values, units, strict=True)]


Column = Header | str  # a text is the label of a column of the default style


def make_headers(*labels: str, **style: Any) -> list[Header]:
    """Make the heads of columns of one style."""
    return [Header(label, **style) for label in labels]


@dataclass(frozen=True)
class TableSpec:
    """Table of typed values, rendered on the console, on pages, and as JSON records.

    Attributes:
        title: Text above the table.
        columns: Heads of the columns.
        rows: Values of each row, one for each column.
        key: Name in JSON, used if the presenter has no ``to_dict``.
        on_console, on_page: Whether the console and the generic part of the page show the table.
    """

    title: str
    columns: Sequence[Column]
    rows: Sequence[Sequence[Any]]
    _: KW_ONLY
    key: str = ""
    on_console: bool = True
    on_page: bool = True

    @property
    def headers(self) -> list[Header]:
        """Heads of the columns with their styles."""
        return [Header(column) if isinstance(column, str) else column for column in self.columns]

    def texts(self) -> TextTable:
        """Return the table as texts."""
        columns = [header.texts([row[index] for row in self.rows]) for index, header in enumerate(self.headers)]
        return TextTable([header.label for header in self.headers], list(map(list, zip(*columns, strict=True))), self.title)

    def records(self) -> list[dict[str, Any]]:
        """Return the rows as dictionaries, for JSON."""
        keys = [header.key or header.label for header in self.headers]
        return [dict(zip(keys, row, strict=True)) for row in self.rows]


@dataclass(frozen=True)
class FigureSpec:
    """Figure with the function that draws it, the title of its section on the page, and its caption.

    With ``on_page=False``, the generic part of the page does not contain the figure; a section of the page may contain it.
    ``preview`` draws a faster version for notebooks. With ``saved=False``, the results folder does not contain the figure.
    """

    draw: Callable[[], report.Figure]
    title: str = "Results"
    caption: str = ""
    on_page: bool = True
    preview: Callable[[], report.Figure] | None = None
    saved: bool = True


@dataclass(frozen=True)
class Notice:
    """Important remark, printed in colour on the console and as a highlighted paragraph on the page."""

    text: str
    tone: Literal["bad", "warn", "good", "note"] = "warn"
    title: str = ""

    @property
    def sentence(self) -> str:
        """Title and text in one line."""
        return f"{self.title}: {self.text}" if self.title else self.text


@dataclass(frozen=True)
class Presentation:
    """Description of a result, from which every renderer takes its content.

    Attributes:
        title: Title of the page, which names the question.
        answer: The answer in one or two sentences; instead of a bare zero, the reason and the next informative number.
        about: Subject of the result: the arm, the task, the law.
        lines: Sentences after the answer: the reason, the checks, the next steps.
        notices: Important remarks.
        facts: Numbers of the answer.
        tables: Tables of the result, or a function that builds them if that takes time; see :meth:`list_tables`.
        figures: Figures by name; the first one is the main figure.
        sections: Function that builds further sections of the page, before the figures (for example 3-D views of the arm).
        method: Description of the computation, by name; the arm and the versions are added automatically.
        arm: Arm that the method section describes; None if there is none.
        again: Function that builds the blocks that repeat the run; None for the command line alone.
        exports: Further files of a results folder, by name, each with the function that writes it to a path.
    """

    title: str
    answer: str
    _: KW_ONLY
    about: str = ""
    lines: Sequence[str] = ()
    notices: Sequence[Notice] = ()
    facts: Sequence[Fact] = ()
    tables: Sequence[TableSpec] | Callable[[], Iterable[TableSpec]] = ()
    figures: Mapping[str, FigureSpec] = field(default_factory=dict)
    sections: Callable[[], Sequence[Section]] = tuple
    method: Sequence[tuple[str, Any]] = ()
    arm: Arm | None = None
    again: Callable[[], Sequence[Block]] | None = None
    exports: Mapping[str, Callable[[Path], Any]] = field(default_factory=dict)

    def list_tables(self) -> Iterable[TableSpec]:
        """List the tables of the result."""
        return self.tables() if callable(self.tables) else self.tables
