"""Progress of long commands on the terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any


class ProgressBar:
    """Progress bar on stderr if it is a terminal, and no output otherwise."""

    def __init__(self, quiet: bool, label: str) -> None:
        self._label = label
        self._quiet = quiet or not sys.stderr.isatty()
        self._bar: Any = None
        self.set_text: Callable[[str], None] = lambda text: None  # replaces the label

    def __enter__(self) -> Any:
        if self._quiet:
            return None
        from rich.console import Console
        from rich.progress import Progress, TimeRemainingColumn

        self._bar = Progress(
            *Progress.get_default_columns()[:-1], TimeRemainingColumn(), console=Console(stderr=True), transient=True
        )
        self._bar.start()
        task = self._bar.add_task(self._label, total=None)
        self.set_text = lambda text: self._bar.update(task, description=text)
        return lambda done, total: self._bar.update(task, completed=done, total=total)

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.stop()


@contextmanager
def show_status(text: str) -> Iterator[Callable[[str], None]]:
    """Show the current activity during the block, and yield a function that changes the text."""
    from rich.console import Console
    from rich.markup import escape

    from holdfast.core import progress

    screen = Console(stderr=True)
    with (
        progress.report_work(text, progress.ignore_progress if screen.is_terminal else None),
        screen.status(escape(text)) as status,
    ):
        yield lambda next_text: status.update(escape(next_text))
