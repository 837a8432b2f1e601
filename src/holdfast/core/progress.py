"""Report the progress of long work: its name, how much is done, and how much time remains.

Messages go to stderr. In a notebook they go to a line below the cell, which changes in place.
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
from typing import Any

from holdfast.core.typing import P, T

Progress = Callable[[int, int], None]

LONG_WORK_S = 1.0  # s
# REPEAT_FACTOR and MAX_SILENCE_S: the next message comes after this multiple of the elapsed time, or after this many s
REPEAT_FACTOR = 4.0
MAX_SILENCE_S = 60.0
MIN_COUNTED_PARTS = 10  # fewer finished parts give no remaining time, because threads finish whole blocks
RESUMED_WITHIN_S = 0.1  # s: work done by then was done in an earlier run
_clock = time.monotonic
_lock = threading.Lock()


@contextmanager
def long_task(task_name: str, seconds: float) -> Iterator[None]:
    """Print the name and the expected duration of a task that is expected to take more than a second."""
    notebook_bar = _make_notebook_bar() if seconds > LONG_WORK_S else None
    if notebook_bar is not None:
        notebook_bar.show(f"{task_name}, about {_format_time(seconds)}")
    elif seconds > LONG_WORK_S:
        _print_notice(f"{task_name}, about {_format_time(seconds)}")
    start_time = _clock()
    yield
    if notebook_bar is not None:
        notebook_bar.show(f"{task_name}: {_format_time(_clock() - start_time)}", last=True)


@contextmanager
def report_work(task_name: str, progress: Progress | None = None) -> Iterator[Progress]:
    """Print the name of a task once it has taken a second, and the remaining time as soon as it is known.

    A task within another task is named only after the outer task, with its progress. Outside the main thread nothing is
    printed, because the caller reports the progress.

    Args:
        task_name: Name, for example "comparing control laws".
        progress: Function that receives the progress instead of stderr.

    Yields:
        Function to call with the parts done and the total number of parts.
    """
    global _outer
    if threading.current_thread() is not threading.main_thread():
        yield progress or ignore_progress
        return
    if (within := _outer) is not None:
        within.names.append(task_name)
        try:
            yield progress or ignore_progress
        finally:
            within.names.pop()
        return
    _outer = work = _RunningWork(task_name)
    try:
        if progress is None:
            _start_watcher()
        work.silent = progress is not None
        yield progress or work.advance
    except BaseException:
        work.finish("stopped after ")
        raise
    else:
        work.finish("")
    finally:
        _outer = None


def reports_progress(task_name: str, passes_progress: bool = True) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Wrap a function with :func:`report_work`, which reports through its argument ``progress`` if it has one."""

    def decorate(function: Callable[P, T]) -> Callable[P, T]:
        names = list(inspect.signature(function).parameters)
        position = names.index("progress") if passes_progress and "progress" in names else None
        call: Callable[..., T] = function

        @functools.wraps(function)
        def call_reporting(*args: P.args, **kwargs: P.kwargs) -> T:
            if position is None:
                with report_work(task_name):
                    return function(*args, **kwargs)
            # Found by position, because binding the arguments to the signature would take longer than all the rest.
            by_place = len(args) > position
            progress: Any = args[position] if by_place else kwargs.get("progress")
            with report_work(task_name, progress) as advance:
                if by_place:
                    return call(*args[:position], advance, *args[position + 1 :], **kwargs)
                return call(*args, **{**kwargs, "progress": advance})

        return call_reporting

    return decorate


class ProgressCount:
    """Context manager that counts finished parts of a longer task and returns the function that adds to the count.

    If it is opened in the main thread, any thread may add to the count; opened elsewhere, it reports nothing. Count blocks, not
    rows.

    Args:
        of: Plural noun of the parts, for example "starts".
        total: Number of parts; 0 if it is unknown, and then ``of`` is singular: "start".
        most: The number of parts is an upper limit.
        whole: The parts are the whole work and take about equally long, so that the remaining time follows from the count.
    """

    def __init__(self, of: str, total: int, most: bool = False, whole: bool = False) -> None:
        self._of, self._total, self._most, self._whole = of, total, most, whole
        self._work: _RunningWork | None = None
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
        """Add to the number of finished parts."""
        if self._work is not None:
            with _lock:
                self.done += count
            if self._whole and MIN_COUNTED_PARTS * self.done >= self._total:
                self._work.record_progress(self.done, self._total)

    def describe_progress(self, task_name: str) -> str:
        """Return the progress within the named work as text."""
        name = "" if self._name == task_name else f": {self._name}"
        whole_text = f" of {'at most ' * self._most}{self._total:,} {self._of}"
        return f"{task_name}{name}, so far {self.done:,}{whole_text if self._total else f' {self._of}' + 's' * (self.done > 1)}"


def track(unit_name: str, items: Collection[T], most: bool = False, whole: bool = False, every: int = 1) -> Iterator[T]:
    """Yield the items and count each as finished when the next one is requested, in steps of ``every``."""
    with ProgressCount(unit_name, len(items), most, whole) as add_progress:
        for k, item in enumerate(items, 1):
            yield item
            if not k % every:
                add_progress(every)


def count_finished_part(unit_name: str) -> None:
    """Count one more finished part if the total is unknown, for example a "figure"."""
    if _outer is not None and threading.current_thread() is threading.main_thread():
        if unit_name not in _outer.others:
            _outer.others[unit_name] = ProgressCount(unit_name, 0).__enter__()
        _outer.others[unit_name](1)


def print_warning(text: str) -> None:
    """Print a message at once, on its own line."""
    _print_notice(text)


class _RunningWork:
    """Current task of the main thread."""

    def __init__(self, what: str) -> None:
        self.what, self.begun, self.next = what, _clock(), LONG_WORK_S
        self.names = [what]  # of nested tasks
        self.counts: list[ProgressCount] = []  # outermost first
        self.others: dict[str, Callable[[int], None]] = {}  # of parts whose total is unknown
        self.first = self.begun, 0.0  # start time, and the fraction done by then
        self.share = 0.0
        self.left: float | None = None
        self.silent = False  # the caller reports the progress
        self.bar = _make_notebook_bar()
        self.shown = 0.0  # time of the last update of the bar

    def advance(self, done: int, total: int, left: float | None = None) -> None:
        """Record how much is done and, if the caller knows it better, the remaining seconds."""
        self.record_progress(done, total, left)
        self.print_if_due()

    def record_progress(self, done: int, total: int, left: float | None = None) -> None:
        """Record the progress as :meth:`advance` does, without printing."""
        now, fraction_done = _clock(), done / max(total, 1)
        if not self.share:
            if now - self.begun < RESUMED_WITHIN_S:
                self.first = now, fraction_done
            elif self.next > LONG_WORK_S:  # the name was printed without a remaining time
                self.next = 0.0
        self.share, self.left = fraction_done, left

    def print_if_due(self) -> None:
        """Print the progress if it is time."""
        passed = _clock() - self.begun
        if passed < LONG_WORK_S or self.silent:
            return
        if self.bar is not None:
            self._show_in_notebook(self.bar, passed)
        elif passed >= self.next:
            self._print_progress(passed)

    def finish(self, outcome: str) -> None:
        """Finish the work; in a notebook the line then shows the time taken."""
        if self.bar is not None and self.shown:
            self.bar.show(f"{self.what}: {outcome}{_format_time(_clock() - self.begun)}", last=True)

    def _show_in_notebook(self, bar: _NotebookBar, elapsed_seconds: float) -> None:
        """Update the line in a notebook, where messages replace each other."""
        if elapsed_seconds < self.shown + RESUMED_WITHIN_S:
            return
        self.shown = elapsed_seconds
        remaining, count = self._remaining_seconds(), next((c for c in tuple(self.counts) if c.done), None)
        if remaining is not None:
            bar.show(f"{self.what}, about {_format_time(remaining)} more", self.share)
        else:
            bar.show(self.what if count is None else count.describe_progress(self.what))

    def _print_progress(self, elapsed_seconds: float) -> None:
        """Print the progress on stderr at increasing intervals."""
        named = self.next > LONG_WORK_S
        self.next = min(REPEAT_FACTOR * max(elapsed_seconds, LONG_WORK_S), elapsed_seconds + MAX_SILENCE_S)
        remaining, count = self._remaining_seconds(), next((c for c in tuple(self.counts) if c.done), None)
        if remaining is not None:
            if remaining >= LONG_WORK_S:
                _print_notice(f"{self.what}, about {_format_time(remaining)} more")
        elif count is not None:
            _print_notice(count.describe_progress(self.what))
        elif not named:
            _print_notice(self.what)

    def _remaining_seconds(self) -> float | None:
        """Return the estimated remaining seconds, or None while they are not known."""
        when, before = self.first
        if self.left is not None or self.share <= before:
            return self.left
        return (_clock() - when) * (1 - self.share) / (self.share - before)


class _NotebookBar:
    """Progress line in plain HTML below a notebook cell; any thread may update it.

    Args:
        publish: ``publish`` function of the kernel, which displays in the running cell.
    """

    def __init__(self, publish: Any) -> None:
        self._publish, self._id = publish, uuid.uuid4().hex
        self._lock, self._said, self._ended = threading.Lock(), "", False

    def show(self, text: str, fraction_done: float | None = None, last: bool = False) -> None:
        """Replace the text of the line, with a progress bar if the finished fraction is known.

        Args:
            text: Text for people.
            fraction_done: Finished fraction, 0 to 1.
            last: The line does not change after this call.
        """
        bar = (
            ""
            if fraction_done is None
            else f'<progress style="width:12em;margin-right:.8em" max="1" value="{fraction_done:.3f}"></progress>'
        )
        html = f'<div style="opacity:.75">{bar}{escape(text)}</div>'
        with self._lock:
            if self._ended or html == self._said:
                return
            data = {"text/html": html, "text/plain": f"holdfast: {text}"}
            self._publish.publish(data, transient={"display_id": self._id}, update=bool(self._said))
            self._said, self._ended = html, last


_outer: _RunningWork | None = None
_watcher = threading.Thread()


def _start_watcher() -> None:
    """Start a thread that prints progress while the main thread works and that ends soon after the work."""
    global _watcher
    if not _watcher.is_alive():
        _watcher = threading.Thread(target=_watch_work, name="holdfast-notice", daemon=True)
        _watcher.start()


def _watch_work() -> None:
    idle = 0
    while idle < 8:
        time.sleep(LONG_WORK_S / 4)
        work = _outer
        idle = 0 if work is not None else idle + 1
        if work is not None:
            work.print_if_due()


def ignore_count(count: int) -> None:
    """Ignore a count, in place of :meth:`ProgressCount.add`."""


def ignore_progress(done: int, total: int, left: float | None = None) -> None:
    """Ignore progress, because an outer task already reports it."""


def _format_time(seconds: float) -> str:
    units = [(1, "s"), (60, "min"), (3600, "h"), (86400, "days"), (31_557_600, "years")]
    size, unit = next((candidate for candidate in units if seconds < 100 * candidate[0]), units[-1])
    return f"{seconds / size:.0f} {unit}"


def _make_notebook_bar() -> _NotebookBar | None:
    """Return a progress bar if this is the kernel of a notebook."""
    shell: Any = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    is_notebook = getattr(shell, "kernel", None) is not None and os.environ.get("HOLDFAST_NOTICES") != "off"
    return _NotebookBar(shell.display_pub) if is_notebook else None


def _print_notice(text: str) -> None:
    if os.environ.get("HOLDFAST_NOTICES") != "off":
        print(f"holdfast: {text}", file=sys.stderr, flush=True)
