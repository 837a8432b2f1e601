"""One description of a result, from which the console, JSON, notebooks, pages, and files are rendered.

The presenter of a class is a module with one function ``present(result, **options) -> Presentation``, and ``to_dict`` where the
JSON document is more than its facts and tables. The options are what the caller asks about the result, for example thresholds.
Whatever takes time (figures, views of an arm, long tables) is given as a function that is called only where it is shown.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from holdfast.core.formatting import Probability, format_interval, format_number, format_percent
from holdfast.interface.presentation.printing import (
    TextTable,
    format_column,
    format_position,
    format_positions,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.interface.report.page import Block, Section
    from holdfast.model.arm.model import Arm

Style = Literal["number", "percent", "text", "angle"]  # angle: rad is also given in degrees


def format_value(value: Any, style: Style = "number", unit: str = "", digits: int = 4) -> str:
    """Format a value of a fact or a cell, with its unit: a text, a flag, a count, a number, an interval, or a range."""
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
    """One number of a result, or one word.

    Attributes:
        label: Its name on the console, in notebooks, and in the table of the page; empty: it is only at the top of the page.
        value: A number, text, flag, interval (:class:`~holdfast.Interval`), or range (a tuple).
        unit: Unit of the value, for example ``"mm"``.
        phrase: What the number is, after it, at the top of the page; empty: it is in the table of the page instead.
        style: Percent for fractions.
        digits: Significant digits.
        key: Its name in JSON, where the presenter has no ``to_dict``.
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
        """The value with its unit."""
        return format_value(self.value, self.style, self.unit, self.digits)


@dataclass(frozen=True)
class Header:
    """Head of a column of a table: its key in JSON, its label, and the unit of its values, if need be one for each row.

    Numbers of one unit share one precision where their magnitudes allow it; ``aligned=False`` formats each by itself.
    """

    key: str
    label: str
    unit: str | Sequence[str] = ""
    _: KW_ONLY
    style: Style = "number"
    digits: int = 4
    aligned: bool = True

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


@dataclass(frozen=True)
class TableSpec:
    """Table of typed values: rendered on the console, on pages, and as JSON records.

    Attributes:
        title: Above the table.
        columns: See :class:`Header`.
        rows: Values, a sequence for each row.
        key: Its name in JSON, where the presenter has no ``to_dict``.
        on_console, on_page: Where it is shown.
    """

    title: str
    columns: Sequence[Header]
    rows: Sequence[Sequence[Any]]
    _: KW_ONLY
    key: str = ""
    on_console: bool = True
    on_page: bool = True

    def texts(self) -> TextTable:
        """Return the table as texts."""
        columns = [column.texts([row[index] for row in self.rows]) for index, column in enumerate(self.columns)]
        return TextTable([column.label for column in self.columns], list(map(list, zip(*columns, strict=True))), self.title)

    def records(self) -> list[dict[str, Any]]:
        """Return the rows as dictionaries, for JSON."""
        return [{column.key: value for column, value in zip(self.columns, row, strict=True)} for row in self.rows]


@dataclass(frozen=True)
class FigureSpec:
    """Figure: the function that draws it, the title of its section on the page, and its caption.

    ``on_page=False``: it is a file and a plot, and the page does not show it, or shows it in a section of its own.
    ``preview`` draws it faster, for notebooks. ``saved=False``: it is not written into the folder of the results.
    """

    draw: Callable[[], Figure]
    title: str = "What was found"
    caption: str = ""
    on_page: bool = True
    preview: Callable[[], Figure] | None = None
    saved: bool = True


@dataclass(frozen=True)
class Notice:
    """Remark that must not be overlooked: in colour on the console, and a highlighted paragraph on the page."""

    text: str
    tone: Literal["bad", "warn", "good", "note"] = "warn"
    title: str = ""

    @property
    def sentence(self) -> str:
        """The text after its title."""
        return f"{self.title}: {self.text}" if self.title else self.text


@dataclass(frozen=True)
class Presentation:
    """Description of a result, from which every renderer takes its content.

    Attributes:
        title: What was asked.
        answer: The answer in one or two sentences; never an uninformative zero: why nothing is left, then what there is.
        about: What was given: the arm, the task, the law.
        lines: Sentences after the answer: the reason, the checks, what to do.
        notices: See :class:`Notice`.
        facts: The answer in numbers.
        tables: Tables of the result, or the function that builds them, if that takes time; see :meth:`list_tables`.
        figures: Figures by name; the first is the main one.
        sections: Further sections of the page, before the figures (views of the arm that can be turned, for example).
        method: How it was computed, by name; the arm and the versions follow by themselves.
        arm: The arm, for the method.
        again: Blocks that repeat the run; the command, if not given.
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
