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
    """A table without lines: numbers to the right, and where it is too narrow, a block for each row in place of a line.

    Without a head it holds facts: a name and a value in each row.
    """

    def __init__(self, *head: str) -> None:
        super().__init__(*head, box=None, pad_edge=False, padding=(0, _GAP, 0, 0), show_header=bool(head))

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Lines of the width that there is."""
        columns = [[_text(console, x) for x in (column.header, *column.cells)] for column in self.columns]
        for column, texts in zip(self.columns, columns, strict=True):
            cells = [text.plain for text in texts[1:]]
            if (
                self.show_header
                and any(map(_is_number, cells))
                and all(not x or _is_number(x) or _BESIDE.fullmatch(x) for x in cells)
            ):
                column.justify = "right"
        whole = [max(cell_len(line) for text in texts for line in text.plain.split("\n")) for texts in columns]
        least = [max((cell_len(word) for text in texts for word in text.plain.split()), default=0) for texts in columns]
        room = options.max_width - _GAP * (len(columns) - 1)
        if sum(whole) > room >= sum(least):
            spare, wanted = room - sum(least), sum(whole) - sum(least)
            for column, low, high in zip(self.columns, least, whole, strict=True):
                column.width = low + spare * (high - low) // wanted
        elif sum(whole) > room:
            yield from self._blocks(columns)
            return
        yield from super().__rich_console__(console, options)

    def _blocks(self, columns: list[list[Text]]) -> RenderResult:
        """Each row as lines of a head and its value."""
        heads = [texts[0].plain for texts in columns]
        for k in range(1, len(columns[0])):
            for head, texts in zip(heads, columns, strict=True):
                if texts[k].plain:
                    first = texts is columns[0]
                    line = texts[k] if not head else Text.assemble((f"{head} ", "bold" if first else ""), texts[k])
                    yield Text.assemble("" if first else "  ", line)


def _text(console: Console, cell: Any) -> Text:
    return console.render_str(cell) if isinstance(cell, str) else cell


def _is_number(text: str) -> bool:
    first, *others = re.findall(r"[^\s(),]+(?:,\d+)*", text) or [""]
    return bool(_NUMBER.fullmatch(first)) and all(_NUMBER.fullmatch(x) or _BESIDE.fullmatch(x) for x in others)
