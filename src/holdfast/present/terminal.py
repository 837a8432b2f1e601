"""A console and tables for people, in which nothing is cut and no word is broken, however narrow the window."""

from __future__ import annotations

import re
from typing import Any

from rich.cells import cell_len
from rich.console import Console, ConsoleOptions, RenderResult
from rich.table import Table
from rich.text import Text

_WIDE = 140  # where no terminal says how wide it is
_GAP = 2  # between columns
_NUMBER = re.compile(r"[<>≥≤±~+−-]*(\d[\d,.]*(e[+−-]?\d+)?|inf(inite)?|∞) ?%?")
_BESIDE = re.compile(r"to|of|none|–|[A-Za-z%°²^/*·0-9-]{1,7}")  # words in a cell of numbers: units most of all


class Screen(Console):
    """Sentences are wrapped between words on a terminal, and stay lines in a file or a pipe."""

    def __init__(self, stderr: bool = False) -> None:
        super().__init__(stderr=stderr, highlight=False, emoji=False)
        if not self.is_terminal:
            self.width = _WIDE

    def print(self, *objects: Any, soft_wrap: bool | None = None, **options: Any) -> None:
        """As rich does; what may be one long line is one only where no window cuts it into pieces."""
        super().print(*objects, soft_wrap=bool(soft_wrap) and not self.is_terminal, **options)


class Grid(Table):
    """A table without lines: numbers to the right; where it is too wide, its columns one below the other, in bands.

    Without a head it holds facts: a name and a value in each row.
    """

    def __init__(self, *head: str) -> None:
        super().__init__(*head, box=None, pad_edge=False, padding=(0, _GAP, 0, 0), show_header=bool(head))

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Lines of the width that there is."""
        columns = [[_text(console, x) for x in (column.header, *column.cells)] for column in self.columns]
        numbers = [self.show_header and _are_numbers([text.plain for text in texts[1:]]) for texts in columns]
        for column, of_numbers in zip(self.columns, numbers, strict=True):
            column.justify = "right" if of_numbers else "left"
        whole = [max(map(_width, texts)) for texts in columns]
        words = [max(map(_longest_word, texts)) for texts in columns]
        cells = [max(map(_width, texts[1:]), default=0) if n else 0 for n, texts in zip(numbers, columns, strict=True)]
        least = [max(pair) for pair in zip(words, cells, strict=True)]  # numbers stay on one line if they can
        room = options.max_width - _GAP * (len(columns) - 1)
        if sum(whole) <= room:
            yield from super().__rich_console__(console, options)
        elif sum(least) > room and (bands := self._bands(columns, numbers, least, options.max_width)):
            yield from bands
        elif sum(least := least if sum(least) <= room else words) <= room:
            spare, wanted = room - sum(least), sum(whole) - sum(least)
            for column, low, high in zip(self.columns, least, whole, strict=True):
                column.width = low + spare * (high - low) // wanted
            yield from super().__rich_console__(console, options)
        else:
            for row in zip(*(texts[1:] for texts in columns), strict=True):
                for texts, cell in zip(columns, row, strict=True):
                    yield Text.assemble(texts[0], " ", cell)

    def _bands(self, columns: list[list[Text]], numbers: list[bool], least: list[int], most: int) -> list[Grid]:
        """Tables of some columns each, after those that name the row; none where even one column does not fit beside them."""
        names = max(next((k for k, of_numbers in enumerate(numbers) if of_numbers), 1), 1)
        beside = sum(least[:names]) + _GAP * names
        if names == len(columns) or beside + max(least[names:]) > most:
            return []
        groups: list[list[int]] = [[]]
        for k in range(names, len(columns)):
            if groups[-1] and beside + sum(least[j] + _GAP for j in (*groups[-1], k)) - _GAP > most:
                groups.append([])
            groups[-1].append(k)
        bands = []
        for group in groups:
            chosen = [*columns[:names], *(columns[k] for k in group)]
            band = Grid(*(texts[0].markup for texts in chosen))
            for row in zip(*(texts[1:] for texts in chosen), strict=True):
                band.add_row(*row)
            bands.append(band)
        return bands


def _width(text: Text) -> int:
    return max(map(cell_len, text.plain.split("\n")))


def _longest_word(text: Text) -> int:
    return max(map(cell_len, text.plain.split()), default=0)


def _are_numbers(cells: list[str]) -> bool:
    """Numbers, or nothing, with or without units."""
    return any(map(_is_number, cells)) and all(not x or _is_number(x) or _BESIDE.fullmatch(x) for x in cells)


def _text(console: Console, cell: Any) -> Text:
    return console.render_str(cell) if isinstance(cell, str) else cell


def _is_number(text: str) -> bool:
    first, *others = re.findall(r"[^\s(),]+(?:,\d+)*", text) or [""]
    return bool(_NUMBER.fullmatch(first)) and all(_NUMBER.fullmatch(x) or _BESIDE.fullmatch(x) for x in others)
