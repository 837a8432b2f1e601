"""Bounds on the cost of connections: sockets that send no request, sockets that read no answer, and lines of the log."""

from __future__ import annotations

import asyncio
import logging
import os
import random
import socket
import struct
import time
from collections.abc import Callable
from typing import Any

from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

_PATIENCE = 10.0, 20.0  # s for the head of a request: drawn, so that who comes again does not come all at once
_MAX_UNREAD_PEERS = 512  # connections at once whose peer has not read all that was sent; a page of a station is 0.1 MB
_LEAST_READ = 8192  # bytes that a slow peer must read within the patience
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


def protocols(
    most: int, patience: tuple[float, float] = _PATIENCE, most_unread: int = _MAX_UNREAD_PEERS
) -> tuple[type[asyncio.Protocol], type[asyncio.Protocol]]:
    """Return the HTTP and the WebSocket protocol of one server, in which no connection can hold memory or a file for ever.

    Args:
        most: Maximum number of connections that have sent no whole request; the oldest is closed when there are more.
        patience: Least and greatest time in seconds for the head of a request, and for a peer to read what was sent.
        most_unread: Maximum number of connections whose peer has not read all that was sent; the oldest is closed likewise.
    """
    silent, unread = (_Deadlines(limit, patience) for limit in (most, most_unread))

    class _ReadByPeer(asyncio.Protocol):
        """Closes a connection whose peer does not read."""

        transport: asyncio.Transport

        def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
            transport.set_write_buffer_limits(high=0)  # so that any unread byte pauses writing
            super().connection_made(transport)

        def connection_lost(self, exc: Exception | None) -> None:
            unread.stop(self.transport)
            super().connection_lost(exc)

        def pause_writing(self) -> None:
            unread.start(self.transport)
            super().pause_writing()

        def resume_writing(self) -> None:
            unread.stop(self.transport)
            super().resume_writing()

    class _Http(_ReadByPeer, H11Protocol):
        def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
            super().connection_made(transport)
            silent.start(transport)

        def connection_lost(self, exc: Exception | None) -> None:
            silent.stop(self.transport)
            super().connection_lost(exc)

        def handle_events(self) -> None:
            before = self.cycle
            super().handle_events()
            if self.cycle is not before:
                silent.stop(self.transport)

        def handle_websocket_upgrade(self, event: Any) -> None:
            silent.stop(self.transport)
            super().handle_websocket_upgrade(event)

        def on_response_complete(self) -> None:
            silent.start(self.transport)
            super().on_response_complete()

    class _WebSocket(_ReadByPeer, WebSocketsSansIOProtocol):  # type: ignore[misc]
        pass

    return _Http, _WebSocket


class _Deadlines:
    """Closes connections that make no progress in time, and the oldest of them when there are too many.

    Args:
        most: Maximum number of connections.
        patience: Least and greatest time in seconds.
    """

    def __init__(self, most: int, patience: tuple[float, float]) -> None:
        self._most, self._patience = most, patience
        self._timers: dict[asyncio.Transport, asyncio.TimerHandle] = {}  # oldest first

    def start(self, transport: asyncio.Transport) -> None:
        """Give a connection a new deadline."""
        self.stop(transport)
        late = random.uniform(*self._patience)
        pending = transport.get_write_buffer_size()
        self._timers[transport] = asyncio.get_running_loop().call_later(late, self._check, transport, pending)
        if len(self._timers) > self._most:
            self._close(next(iter(self._timers)))

    def stop(self, transport: asyncio.Transport) -> None:
        """Take the deadline from a connection that has made progress, or is closed."""
        timer = self._timers.pop(transport, None)
        if timer is not None:
            timer.cancel()

    def _check(self, transport: asyncio.Transport, pending: int) -> None:
        """Close a connection, unless its peer reads, however slowly, at a useful rate."""
        if pending - transport.get_write_buffer_size() >= _LEAST_READ:
            self.start(transport)
        else:
            self._close(transport)

    def _close(self, transport: asyncio.Transport) -> None:
        self.stop(transport)
        if transport.get_write_buffer_size():  # then the system too would keep what it has not sent: it must drop it
            linger = struct.pack("hh" if os.name == "nt" else "ii", 1, 0)
            transport.get_extra_info("socket").setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, linger)
        transport.abort()


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
