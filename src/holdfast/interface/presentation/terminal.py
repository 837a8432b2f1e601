"""Console and tables that cut no text and break no word, however narrow the window is."""

from __future__ import annotations

import re
from typing import Any

from rich.cells import cell_len
from rich.console import Console, ConsoleOptions, RenderResult
from rich.table import Table
from rich.text import Text

_DEFAULT_WIDTH = 140  # where no terminal says how wide it is
_COLUMN_GAP = 2  # between columns
_NUMBER_PATTERN = re.compile(r"[<>≥≤±~+−-]*(\d[\d,.]*(e[+−-]?\d+)?|inf(inite)?|∞) ?%?")
_QUALIFIER_PATTERN = re.compile(r"to|of|none|–|[A-Za-z%°²^/*·0-9-]{1,7}")  # words in a cell of numbers: units most of all


class WrappingConsole(Console):
    """Console that wraps sentences between words on a terminal, and keeps them on one line in a file or a pipe."""

    def __init__(self, stderr: bool = False) -> None:
        super().__init__(stderr=stderr, highlight=False, emoji=False)
        if not self.is_terminal:
            self.width = _DEFAULT_WIDTH

    def print(self, *objects: Any, soft_wrap: bool | None = None, **options: Any) -> None:
        """Print as rich does; a text that may be one long line stays one line only where no window cuts it."""
        super().print(*objects, soft_wrap=bool(soft_wrap) and not self.is_terminal, **options)


class BandedTable(Table):
    """Table without lines: numbers are right-aligned, and columns that do not fit are printed below each other, in bands.

    Without a head it holds facts: a name and a value in each row.
    """

    def __init__(self, *head: str) -> None:
        super().__init__(*head, box=None, pad_edge=False, padding=(0, _COLUMN_GAP, 0, 0), show_header=bool(head))

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Yield lines of the available width."""
        columns = [[_render_cell(console, value) for value in (column.header, *column.cells)] for column in self.columns]
        are_numeric = [self.show_header and _contain_numbers([text.plain for text in texts[1:]]) for texts in columns]
        for column, is_numeric in zip(self.columns, are_numeric, strict=True):
            column.justify = "right" if is_numeric else "left"
        full_widths = [max(map(_text_width, texts)) for texts in columns]
        word_widths = [max(map(_longest_word_width, texts)) for texts in columns]
        number_widths = [
            max(map(_text_width, texts[1:]), default=0) if is_number_column else 0
            for is_number_column, texts in zip(are_numeric, columns, strict=True)
        ]
        # Numbers stay on one line if they can.
        min_widths = [max(pair) for pair in zip(word_widths, number_widths, strict=True)]
        available = options.max_width - _COLUMN_GAP * (len(columns) - 1)
        if sum(full_widths) <= available:
            yield from super().__rich_console__(console, options)
        elif sum(min_widths) > available and (
            bands := self._split_into_bands(columns, are_numeric, min_widths, options.max_width)
        ):
            yield from bands
        elif sum(min_widths := min_widths if sum(min_widths) <= available else word_widths) <= available:
            spare_width, missing_width = available - sum(min_widths), sum(full_widths) - sum(min_widths)
            for column, narrow, full in zip(self.columns, min_widths, full_widths, strict=True):
                column.width = narrow + spare_width * (full - narrow) // missing_width
            yield from super().__rich_console__(console, options)
        else:
            for row in zip(*(texts[1:] for texts in columns), strict=True):
                for texts, cell in zip(columns, row, strict=True):
                    yield Text.assemble(texts[0], " ", cell)

    def _split_into_bands(
        self, columns: list[list[Text]], are_numeric: list[bool], min_widths: list[int], max_width: int
    ) -> list[BandedTable]:
        """Return tables of some columns each, after the columns that name the row; none where not even one column fits."""
        name_columns = max(next((column for column, is_numeric in enumerate(are_numeric) if is_numeric), 1), 1)
        name_width = sum(min_widths[:name_columns]) + _COLUMN_GAP * name_columns
        if name_columns == len(columns) or name_width + max(min_widths[name_columns:]) > max_width:
            return []
        groups: list[list[int]] = [[]]
        for column in range(name_columns, len(columns)):
            if (
                groups[-1]
                and name_width
                + sum(min_widths[other_column] + _COLUMN_GAP for other_column in (*groups[-1], column))
                - _COLUMN_GAP
                > max_width
            ):
                groups.append([])
            groups[-1].append(column)
        bands = []
        for group in groups:
            chosen = [*columns[:name_columns], *(columns[column] for column in group)]
            band = BandedTable(*(texts[0].markup for texts in chosen))
            for row in zip(*(texts[1:] for texts in chosen), strict=True):
                band.add_row(*row)
            bands.append(band)
        return bands


def _text_width(text: Text) -> int:
    return max(map(cell_len, text.plain.split("\n")))


def _longest_word_width(text: Text) -> int:
    return max(map(cell_len, text.plain.split()), default=0)


def _contain_numbers(cells: list[str]) -> bool:
    """Return whether the cells contain numbers, or nothing, with or without units."""
    return any(map(_is_number, cells)) and all(
        not cell_text or _is_number(cell_text) or _QUALIFIER_PATTERN.fullmatch(cell_text) for cell_text in cells
    )


def _render_cell(console: Console, cell: Any) -> Text:
    return console.render_str(cell) if isinstance(cell, str) else cell


def _is_number(text: str) -> bool:
    head_token, *other_tokens = re.findall(r"[^\s(),]+(?:,\d+)*", text) or [""]
    return bool(_NUMBER_PATTERN.fullmatch(head_token)) and all(
        _NUMBER_PATTERN.fullmatch(token) or _QUALIFIER_PATTERN.fullmatch(token) for token in other_tokens
    )
