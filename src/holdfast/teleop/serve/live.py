"""Broadcast of the server's state to the experimenter's pages, without waiting for a slow page."""

from __future__ import annotations

import asyncio
import time
from collections import deque
from collections.abc import AsyncIterator, Awaitable, Callable
from typing import Any

_QUEUE_LENGTH = 64  # messages for a page that is too slow; older ones are dropped
_MIN_INTERVAL_S = 1 / 15  # time between two messages of one topic, s
_SUBJECTS_INTERVAL_S = 0.5  # time between two lists of subjects, s


class StatusBroadcaster:
    """Broadcaster of messages to the experimenter's pages, for use inside the event loop only.

    Args:
        clock: Function that returns the time in s.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._queues: list[tuple[deque[dict[str, Any]], asyncio.Event]] = []
        self._last_times: dict[str, float] = {}
        self._stale = asyncio.Event()

    @property
    def is_watched(self) -> bool:
        """True while at least one page is connected."""
        return bool(self._queues)

    def publish(self, message: dict[str, Any], topic: str | None = None) -> None:
        """Send a message to all connected pages.

        Args:
            message: JSON data.
            topic: Topic of which at most 15 messages a second are sent, and the others dropped. None: all messages are sent.
        """
        if not self._queues:
            return
        if topic is not None:
            now = self._clock()
            if now - self._last_times.get(topic, -1e9) < _MIN_INTERVAL_S:
                return
            self._last_times[topic] = now
        for pending, arrived in self._queues:
            pending.append(message)
            arrived.set()

    async def stream_messages(self) -> AsyncIterator[dict[str, Any]]:
        """Yield the messages from now on, without end."""
        pending: deque[dict[str, Any]] = deque(maxlen=_QUEUE_LENGTH)
        arrived = asyncio.Event()
        watcher = (pending, arrived)
        self._queues.append(watcher)
        try:
            while True:
                while pending:
                    yield pending.popleft()
                arrived.clear()
                await arrived.wait()
        finally:
            self._queues.remove(watcher)

    def forget_topic(self, topic: str) -> None:
        """Forget a topic that does not return."""
        self._last_times.pop(topic, None)

    def mark_subjects_changed(self) -> None:
        """Mark the list of subjects as changed."""
        self._stale.set()

    async def publish_subjects(self, state: Callable[[], Awaitable[dict[str, Any]]]) -> None:
        """Publish the list of subjects with its state whenever it has changed, at most twice a second, without end."""
        while True:
            await self._stale.wait()
            self._stale.clear()
            if self._queues:
                self.publish({"type": "subjects", **await state()})
            await asyncio.sleep(_SUBJECTS_INTERVAL_S)
