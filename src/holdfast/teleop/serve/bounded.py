"""Bounds on what connections may cost: sockets that say nothing, and lines of the log."""

from __future__ import annotations

import asyncio
import logging
import random
import time
from collections.abc import Callable
from typing import Any

from uvicorn.protocols.http.h11_impl import H11Protocol

_PATIENCE = 10.0, 20.0  # s for the head of a request: drawn, so that who comes again does not come all at once
_FILES = 8192  # that the server may have open, where the system lets it
_LINES = 20  # of the log, a minute

_log = logging.getLogger(__name__)


def files() -> int:
    """How many files this process may have open, after asking for enough."""
    try:
        import resource
    except ImportError:  # Windows, where sockets are no files
        return _FILES
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = _FILES if hard == resource.RLIM_INFINITY else min(_FILES, hard)
    if soft != resource.RLIM_INFINITY and soft < wanted:
        resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
        soft = wanted
    return _FILES if soft == resource.RLIM_INFINITY else soft


def protocol(most: int, patience: tuple[float, float] = _PATIENCE) -> type[asyncio.Protocol]:
    """HTTP for one server, in which sockets that have sent no whole request do not last, and take no files from the others.

    Args:
        most: Such connections at once; the oldest is closed where there are more.
        patience: Seconds for the head of a request, at least and at most.
    """
    silent: dict[_Http, None] = {}  # oldest first

    class _Http(H11Protocol):
        _late: asyncio.TimerHandle | None = None

        def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
            super().connection_made(transport)
            self._wait()
            if len(silent) > most:
                next(iter(silent))._end()

        def connection_lost(self, exc: Exception | None) -> None:
            self._speaks()
            super().connection_lost(exc)

        def handle_events(self) -> None:
            before = self.cycle
            super().handle_events()
            if self.cycle is not before:
                self._speaks()

        def handle_websocket_upgrade(self, event: Any) -> None:
            self._speaks()
            super().handle_websocket_upgrade(event)

        def on_response_complete(self) -> None:
            self._wait()
            super().on_response_complete()

        def _wait(self) -> None:
            self._speaks()
            silent[self] = None
            self._late = self.loop.call_later(random.uniform(*patience), self._end)

        def _speaks(self) -> None:
            silent.pop(self, None)
            if self._late is not None:
                self._late.cancel()
                self._late = None

        def _end(self) -> None:
            self._speaks()
            self.transport.abort()

    return _Http


class Sparing(logging.Filter):
    """Lets few lines of a log pass: what anybody can provoke must not fill a disk.

    Args:
        lines: A minute.
        clock: Seconds.
    """

    def __init__(self, lines: int = _LINES, clock: Callable[[], float] = time.monotonic) -> None:
        super().__init__()
        self._lines, self._clock = lines, clock
        self._until, self._passed = clock() + 60, 0

    def filter(self, record: logging.LogRecord) -> bool:
        """Whether a line passes."""
        now = self._clock()
        if now >= self._until:
            self._until, self._passed = now + 60, 0
        self._passed += 1
        if self._passed == self._lines:
            record.msg = f"{record.getMessage()} (no more lines in this minute)"
            record.args = None
        return self._passed <= self._lines


def sparing_loop(loop: asyncio.AbstractEventLoop) -> None:
    """Let what asyncio says of failures, such as no more files for a connection, be few lines too."""
    spare = Sparing()

    def handle(loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        record = logging.LogRecord(__name__, logging.ERROR, __file__, 0, str(context.get("message")), None, None)
        if spare.filter(record):
            loop.default_exception_handler({**context, "message": record.msg})

    loop.set_exception_handler(handle)
