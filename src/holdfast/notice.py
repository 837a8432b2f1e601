"""Notices of work that takes a while: what it is, and how long it will take or how far it has come.

They go to stderr; in a notebook to a line below the cell, which changes in place.
"""

from __future__ import annotations

import functools
import inspect
import os
import sys
import threading
import time
import uuid
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from html import escape
from typing import Any, ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")
Progress = Callable[[int, int], None]

_LONG = 1.0  # s
_AGAIN, _AT_MOST = 4.0, 60.0  # next word after as many times as long, but not later than so many s
_ENOUGH = 10  # once such a part of a whole is done, the time left follows from it: threads hand over whole blocks
_SOON = 0.1  # s: what is done by then was done before
_clock = time.monotonic
_lock = threading.Lock()


@contextmanager
def long(what: str, seconds: float) -> Iterator[None]:
    """Say what is being done if it is expected to take more than a second, and for how long."""
    bar = _bar() if seconds > _LONG else None
    if bar is not None:
        bar.show(f"{what}, about {_shown(seconds)}")
    elif seconds > _LONG:
        _say(f"{what}, about {_shown(seconds)}")
    begun = _clock()
    yield
    if bar is not None:
        bar.show(f"{what}: {_shown(_clock() - begun)}", last=True)


@contextmanager
def working(what: str, progress: Progress | None = None) -> Iterator[Progress]:
    """Say what is being done once it has taken a second, and how long the rest takes as soon as that is known.

    Work within other work is named only beside the outer one, with how far it has come. What is not done in the main thread is
    for others to tell of.

    Args:
        what: For example "comparing control laws".
        progress: Is told in place of stderr.

    Yields:
        To be told (done, in all).
    """
    global _outer
    if threading.current_thread() is not threading.main_thread():
        yield progress or told
        return
    if (within := _outer) is not None:
        within.names.append(what)
        try:
            yield progress or told
        finally:
            within.names.pop()
        return
    _outer = work = _Work(what)
    try:
        if progress is None:
            _watch()
        work.silent = progress is not None
        yield progress or work.advance
    except BaseException:
        work.end("stopped after ")
        raise
    else:
        work.end("")
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


class Count:
    """How much is done of something that others wait for: a context manager, which gives what is to be told.

    Opened in the main thread, it may be told from any; elsewhere it tells nobody. It is for blocks, not for rows.

    Args:
        of: For example "starts".
        total: So many; 0 if nobody knows, and then ``of`` is one: "start".
        most: Or fewer.
        whole: This is all that the work consists of, and each takes about as long: the time left follows from it.
    """

    def __init__(self, of: str, total: int, most: bool = False, whole: bool = False) -> None:
        self._of, self._total, self._most, self._whole = of, total, most, whole
        self._work: _Work | None = None
        self._name, self.done = "", 0

    def __enter__(self) -> Callable[[int], None]:
        if _outer is not None and threading.current_thread() is threading.main_thread():
            self._work, self._name = _outer, _outer.names[-1]
            self._whole = self._whole and len(_outer.names) == 1 and not _outer.share
            _outer.counts.append(self)
            if self._whole:
                _outer.first = _clock(), 0.0
        return self.add

    def __exit__(self, *_: object) -> None:
        if self._work is not None:
            self._work.counts.remove(self)
            if self._whole:
                self._work.share = 0.0

    def add(self, count: int) -> None:
        """So many more are done."""
        if self._work is not None:
            with _lock:
                self.done += count
            if self._whole and _ENOUGH * self.done >= self._total:
                self._work.note(self.done, self._total)

    def text(self, what: str) -> str:
        """How far it has come, in words, within such work."""
        name = "" if self._name == what else f": {self._name}"
        of = f" of {'at most ' * self._most}{self._total:,} {self._of}"
        return f"{what}{name}, so far {self.done:,}{of if self._total else f' {self._of}' + 's' * (self.done > 1)}"


def each(of: str, items: Collection[T], most: bool = False, whole: bool = False, every: int = 1) -> Iterator[T]:
    """The items, one done when the next is asked for: a :class:`Count` that is told of ``every`` so many."""
    with Count(of, len(items), most, whole) as tell:
        for k, item in enumerate(items, 1):
            yield item
            if not k % every:
                tell(every)


def another(of: str) -> None:
    """One more is done, of an unknown number, for example a "figure"."""
    if _outer is not None and threading.current_thread() is threading.main_thread():
        if of not in _outer.others:
            _outer.others[of] = Count(of, 0).__enter__()
        _outer.others[of](1)


def aside(text: str) -> None:
    """Something that who waits should know at once: a line of its own."""
    _say(text)


class _Work:
    """Work under way in the main thread."""

    def __init__(self, what: str) -> None:
        self.what, self.begun, self.next = what, _clock(), _LONG
        self.names = [what]  # of work within work
        self.counts: list[Count] = []  # from the outermost
        self.others: dict[str, Callable[[int], None]] = {}  # of what has no total
        self.first = self.begun, 0.0  # when, and how much was done
        self.share = 0.0
        self.left: float | None = None
        self.silent = False  # somebody else tells of it
        self.bar = _bar()
        self.shown = 0.0  # when the bar was told

    def advance(self, done: int, total: int, left: float | None = None) -> None:
        """So much is done; ``left`` seconds are left, if that is known better here than there."""
        self.note(done, total, left)
        self.look()

    def note(self, done: int, total: int, left: float | None = None) -> None:
        """As :meth:`advance`, but nothing is said yet."""
        now, share = _clock(), done / max(total, 1)
        if not self.share:
            if now - self.begun < _SOON:
                self.first = now, share
            elif self.next > _LONG:  # it was named without a time
                self.next = 0.0
        self.share, self.left = share, left

    def look(self) -> None:
        """Say something if it is time."""
        passed = _clock() - self.begun
        if passed < _LONG or self.silent:
            return
        if self.bar is not None:
            self._show(self.bar, passed)
        elif passed >= self.next:
            self._tell(passed)

    def end(self, how: str) -> None:
        """It is over; a notebook keeps how long it took."""
        if self.bar is not None and self.shown:
            self.bar.show(f"{self.what}: {how}{_shown(_clock() - self.begun)}", last=True)

    def _show(self, bar: _Bar, passed: float) -> None:
        """In a notebook, where nothing piles up."""
        if passed < self.shown + _SOON:
            return
        self.shown = passed
        rest, count = self._rest(), next((c for c in tuple(self.counts) if c.done), None)
        if rest is not None:
            bar.show(f"{self.what}, about {_shown(rest)} more", self.share)
        else:
            bar.show(self.what if count is None else count.text(self.what))

    def _tell(self, passed: float) -> None:
        """On stderr, ever more rarely."""
        named, self.next = self.next > _LONG, min(_AGAIN * max(passed, _LONG), passed + _AT_MOST)
        rest, count = self._rest(), next((c for c in tuple(self.counts) if c.done), None)
        if rest is not None:
            if rest >= _LONG:
                _say(f"{self.what}, about {_shown(rest)} more")
        elif count is not None:
            _say(count.text(self.what))
        elif not named:
            _say(self.what)

    def _rest(self) -> float | None:
        """Seconds that are probably left; None while that is not known."""
        when, before = self.first
        if self.left is not None or self.share <= before:
            return self.left
        return (_clock() - when) * (1 - self.share) / (self.share - before)


class _Bar:
    """How far work is, in a line below the cell that waits for it; told from any thread. Plain HTML, no widgets.

    Args:
        publish: The kernel's, which displays in the cell that runs.
    """

    def __init__(self, publish: Any) -> None:
        self._publish, self._id = publish, uuid.uuid4().hex
        self._lock, self._said, self._ended = threading.Lock(), "", False

    def show(self, text: str, share: float | None = None, last: bool = False) -> None:
        """Say so in place of what was said before; with a bar if the share that is done is known.

        Args:
            text: For people.
            share: 0 to 1.
            last: Nothing more is said after this, whoever tries.
        """
        bar = "" if share is None else f'<progress style="width:12em;margin-right:.8em" max="1" value="{share:.3f}"></progress>'
        html = f'<div style="opacity:.75">{bar}{escape(text)}</div>'
        with self._lock:
            if self._ended or html == self._said:
                return
            data = {"text/html": html, "text/plain": f"holdfast: {text}"}
            self._publish.publish(data, transient={"display_id": self._id}, update=bool(self._said))
            self._said, self._ended = html, last


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


def unheard(count: int) -> None:
    """In place of :meth:`Count.add`."""


def told(done: int, total: int, left: float | None = None) -> None:
    """This work is being told of already."""


def _shown(seconds: float) -> str:
    units = [(1, "s"), (60, "min"), (3600, "h"), (86400, "days"), (31_557_600, "years")]
    size, unit = next((each for each in units if seconds < 100 * each[0]), units[-1])
    return f"{seconds / size:.0f} {unit}"


def _bar() -> _Bar | None:
    """Where this is the kernel of a notebook."""
    shell: Any = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    known = getattr(shell, "kernel", None) is not None and os.environ.get("HOLDFAST_NOTICES") != "off"
    return _Bar(shell.display_pub) if known else None


def _say(text: str) -> None:
    if os.environ.get("HOLDFAST_NOTICES") != "off":
        print(f"holdfast: {text}", file=sys.stderr, flush=True)
