"""Word on stderr of silent work that takes a while: what it is, and how long it will take."""

from __future__ import annotations

import functools
import inspect
import os
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")
Progress = Callable[[int, int], None]

_LONG = 1.0  # s
_AGAIN, _AT_MOST = 4.0, 60.0  # next word after as many times as long, but not later than so many s
_SOON = 0.1  # s: what is done by then was done before
_clock = time.monotonic


@contextmanager
def long(what: str, seconds: float) -> Iterator[None]:
    """Say what is being done if it is expected to take more than a second, and for how long."""
    if seconds > _LONG:
        _say(f"{what}, about {_shown(seconds)}")
    yield


@contextmanager
def working(what: str, progress: Progress | None = None) -> Iterator[Progress]:
    """Say what is being done once it has taken a second, and how long the rest takes as soon as that is known.

    Of work within other work only the outer one is named. What is not done in the main thread is for others to tell of.

    Args:
        what: For example "comparing control laws".
        progress: Is told in place of stderr.

    Yields:
        To be told (done, in all).
    """
    global _outer
    if _outer is not None or threading.current_thread() is not threading.main_thread():
        yield progress or told
        return
    _outer = work = _Work(what)
    try:
        if progress is None:
            _watch()
        yield progress or work.advance
    finally:
        _outer = None


def says(what: str, counts: bool = True) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """The function as :func:`working`, which tells its argument ``progress`` where it has one that ``counts``."""

    def decorated(function: Callable[P, T]) -> Callable[P, T]:
        names = list(inspect.signature(function).parameters)
        at = names.index("progress") if counts and "progress" in names else None
        call: Callable[..., T] = function

        @functools.wraps(function)
        def called(*args: P.args, **kwargs: P.kwargs) -> T:
            if at is None:
                with working(what):
                    return function(*args, **kwargs)
            # Looked up by place: binding the arguments to the signature would take longer than all the rest.
            by_place = len(args) > at
            given: Any = args[at] if by_place else kwargs.get("progress")
            with working(what, given) as advance:
                if by_place:
                    return call(*args[:at], advance, *args[at + 1 :], **kwargs)
                return call(*args, **{**kwargs, "progress": advance})

        return called

    return decorated


class _Work:
    """Work under way in the main thread."""

    def __init__(self, what: str) -> None:
        self.what, self.begun, self.next = what, _clock(), _LONG
        self.first = self.begun, 0.0  # when, and how much was done
        self.share = 0.0
        self.left: float | None = None

    def advance(self, done: int, total: int, left: float | None = None) -> None:
        """So much is done; ``left`` seconds are left, if that is known better here than there."""
        now, share = _clock(), done / max(total, 1)
        if not self.share:
            if now - self.begun < _SOON:
                self.first = now, share
            elif self.next > _LONG:  # it was named without a time
                self.next = 0.0
        self.share, self.left = share, left
        self.look()

    def look(self) -> None:
        """Say something if it is time."""
        passed = _clock() - self.begun
        if passed < self.next:
            return
        named, self.next = self.next > _LONG, min(_AGAIN * max(passed, _LONG), passed + _AT_MOST)
        rest = self._rest()
        if rest is None:
            if not named:
                _say(self.what)
        elif rest >= _LONG:
            _say(f"{self.what}, about {_shown(rest)} more")

    def _rest(self) -> float | None:
        """Seconds that are probably left; None while that is not known."""
        when, before = self.first
        if self.left is not None or self.share <= before:
            return self.left
        return (_clock() - when) * (1 - self.share) / (self.share - before)


_outer: _Work | None = None
_watcher = threading.Thread()


def _watch() -> None:
    """Have somebody look in whatever the main thread does; who ends soon after there is nothing to look at."""
    global _watcher
    if not _watcher.is_alive():
        _watcher = threading.Thread(target=_looking, name="holdfast-notice", daemon=True)
        _watcher.start()


def _looking() -> None:
    idle = 0
    while idle < 8:
        time.sleep(_LONG / 4)
        work = _outer
        idle = 0 if work is not None else idle + 1
        if work is not None:
            work.look()


def told(done: int, total: int, left: float | None = None) -> None:
    """Somebody tells of this work already."""


def _shown(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min"


def _say(text: str) -> None:
    if os.environ.get("HOLDFAST_NOTICES") != "off":
        print(f"holdfast: {text}", file=sys.stderr, flush=True)
