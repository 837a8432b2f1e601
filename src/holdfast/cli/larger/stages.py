"""What a command that takes a while is doing, on the terminal."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def working(text: str) -> Iterator[Callable[[str], None]]:
    """What is being done, while it is; a function that says what comes next."""
    from rich.console import Console
    from rich.markup import escape

    from holdfast import notice

    screen = Console(stderr=True)
    with notice.working(text, notice.told if screen.is_terminal else None), screen.status(escape(text)) as status:
        yield lambda now: status.update(escape(now))
