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

_PATIENCE_RANGE_S = 10.0, 20.0  # time for the head of a request, s; random, so that clients do not all reconnect at once
_MAX_UNREAD_PEERS = 512  # connections at once whose peer has not read everything that was sent; a station's page has 0.1 MB
_MIN_READ_BYTES = 8192  # bytes that a slow peer must read within this time
_MAX_OPEN_FILES = 8192  # open files of the server, if the system allows it
_LOG_LINES_PER_MINUTE = 20  # lines of the log per minute

_log = logging.getLogger(__name__)


def raise_file_limit() -> int:
    """Raise the limit of open files of this process where it is too low, and return the limit."""
    try:
        import resource
    except ImportError:  # Windows, where sockets are not files
        return _MAX_OPEN_FILES
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    target = _MAX_OPEN_FILES if hard == resource.RLIM_INFINITY else min(_MAX_OPEN_FILES, hard)
    if soft != resource.RLIM_INFINITY and soft < target:
        resource.setrlimit(resource.RLIMIT_NOFILE, (target, hard))
        soft = target
    return _MAX_OPEN_FILES if soft == resource.RLIM_INFINITY else soft


def make_bounded_protocols(
    max_silent: int, patience: tuple[float, float] = _PATIENCE_RANGE_S, max_unread: int = _MAX_UNREAD_PEERS
) -> tuple[type[asyncio.Protocol], type[asyncio.Protocol]]:
    """Return the HTTP and the WebSocket protocol of a server, in which no connection can hold memory or a file indefinitely.

    Args:
        max_silent: Largest number of connections that have sent no complete request; above it, the oldest is closed.
        patience: Least and greatest time in seconds for the head of a request, and for a peer to read the sent data.
        max_unread: Largest number of connections whose peer has unread data; above it, the oldest is closed.
    """
    silent, unread = (_Deadlines(limit, patience) for limit in (max_silent, max_unread))

    class _ReadByPeer(asyncio.Protocol):
        """Connection that is closed if its peer does not read."""

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
    """Deadlines that close connections without progress, and the oldest of them when there are too many.

    Args:
        max_connections: Maximum number of connections.
        patience: Least and greatest time in seconds.
    """

    def __init__(self, max_connections: int, patience: tuple[float, float]) -> None:
        self._max_connections, self._patience = max_connections, patience
        self._timers: dict[asyncio.Transport, asyncio.TimerHandle] = {}  # oldest first

    def start(self, transport: asyncio.Transport) -> None:
        """Give a connection a new deadline."""
        self.stop(transport)
        delay = random.uniform(*self._patience)
        pending = transport.get_write_buffer_size()
        self._timers[transport] = asyncio.get_running_loop().call_later(delay, self._check_progress, transport, pending)
        if len(self._timers) > self._max_connections:
            self._abort_connection(next(iter(self._timers)))

    def stop(self, transport: asyncio.Transport) -> None:
        """Take the deadline from a connection that has made progress, or is closed."""
        timer = self._timers.pop(transport, None)
        if timer is not None:
            timer.cancel()

    def _check_progress(self, transport: asyncio.Transport, pending: int) -> None:
        """Close a connection, unless its peer reads at a useful rate."""
        if pending - transport.get_write_buffer_size() >= _MIN_READ_BYTES:
            self.start(transport)
        else:
            self._abort_connection(transport)

    def _abort_connection(self, transport: asyncio.Transport) -> None:
        self.stop(transport)
        if transport.get_write_buffer_size():  # otherwise the system would keep the unsent data too
            linger = struct.pack("hh" if os.name == "nt" else "ii", 1, 0)
            transport.get_extra_info("socket").setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, linger)
        transport.abort()


class RateLimitedLogFilter(logging.Filter):
    """Filter that passes few lines of a log per minute, because requests from anywhere must not fill a disk.

    Args:
        lines: Number of lines per minute.
        clock: Function that returns the time in s.
    """

    def __init__(self, lines: int = _LOG_LINES_PER_MINUTE, clock: Callable[[], float] = time.monotonic) -> None:
        super().__init__()
        self._lines, self._clock = lines, clock
        self._minute_end, self._line_count = clock() + 60, 0

    def filter(self, record: logging.LogRecord) -> bool:
        """Return whether a line passes."""
        now = self._clock()
        if now >= self._minute_end:
            self._minute_end, self._line_count = now + 60, 0
        self._line_count += 1
        if self._line_count == self._lines:
            record.msg = f"{record.getMessage()} (no more lines in this minute)"
            record.args = None
        return self._line_count <= self._lines


def limit_asyncio_log(loop: asyncio.AbstractEventLoop) -> None:
    """Limit the log lines of failures in asyncio as well, such as a lack of files for a connection."""
    log_filter = RateLimitedLogFilter()

    def log_failure(loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        record = logging.LogRecord(__name__, logging.ERROR, __file__, 0, str(context.get("message")), None, None)
        if log_filter.filter(record):
            loop.default_exception_handler({**context, "message": record.msg})

    loop.set_exception_handler(log_failure)
