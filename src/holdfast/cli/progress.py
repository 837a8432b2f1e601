"""What a command that takes a while is doing, on the terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any


class progress_bar:
    """A bar on stderr while a person looks, nothing otherwise."""

    def __init__(self, quiet: bool, label: str) -> None:
        self._label = label
        self._quiet = quiet or not sys.stderr.isatty()
        self._bar: Any = None
        self.says: Callable[[str], None] = lambda text: None  # in place of the label

    def __enter__(self) -> Any:
        if self._quiet:
            return None
        from rich.console import Console
        from rich.progress import Progress, TimeRemainingColumn

        self._bar = Progress(
            *Progress.get_default_columns()[:-1], TimeRemainingColumn(), console=Console(stderr=True), transient=True
        )
        self._bar.start()
        job = self._bar.add_task(self._label, total=None)
        self.says = lambda text: self._bar.update(job, description=text)
        return lambda done, total: self._bar.update(job, completed=done, total=total)

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.stop()


@contextmanager
def working(text: str) -> Iterator[Callable[[str], None]]:
    """What is being done, while it is; a function that says what comes next."""
    from rich.console import Console
    from rich.markup import escape

    from holdfast import notice

    screen = Console(stderr=True)
    with notice.working(text, notice.told if screen.is_terminal else None), screen.status(escape(text)) as status:
        yield lambda now: status.update(escape(now))
