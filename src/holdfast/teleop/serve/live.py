"""What the experimenter's page watches: a hub that never waits for a slow watcher."""

from __future__ import annotations

import asyncio
import time
from collections import deque
from collections.abc import AsyncIterator, Awaitable, Callable
from typing import Any

_KEPT = 64  # messages for a watcher who does not keep up; older ones are dropped
_INTERVAL = 1 / 15  # s between two of the same topic
_SUBJECTS = 0.5  # s between two lists of subjects


class Live:
    """A hub, for use inside the event loop only.

    Args:
        clock: Seconds.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._queues: list[tuple[deque[dict[str, Any]], asyncio.Event]] = []
        self._last: dict[str, float] = {}
        self._stale = asyncio.Event()

    @property
    def watched(self) -> bool:
        """Whether anybody watches."""
        return bool(self._queues)

    def publish(self, message: dict[str, Any], topic: str | None = None) -> None:
        """Tell all watchers.

        Args:
            message: As JSON takes it.
            topic: Of one topic at most 15 messages a second pass, the others are dropped; None for messages that all pass.
        """
        if not self._queues:
            return
        if topic is not None:
            at = self._clock()
            if at - self._last.get(topic, -1e9) < _INTERVAL:
                return
            self._last[topic] = at
        for kept, news in self._queues:
            kept.append(message)
            news.set()

    async def watch(self) -> AsyncIterator[dict[str, Any]]:
        """The messages from now on, without end."""
        kept: deque[dict[str, Any]] = deque(maxlen=_KEPT)
        news = asyncio.Event()
        mine = (kept, news)
        self._queues.append(mine)
        try:
            while True:
                while kept:
                    yield kept.popleft()
                news.clear()
                await news.wait()
        finally:
            self._queues.remove(mine)

    def forget(self, topic: str) -> None:
        """A topic that does not come back."""
        self._last.pop(topic, None)

    def stale(self) -> None:
        """The list of subjects is not what it was."""
        self._stale.set()

    async def keep_fresh(self, state: Callable[[], Awaitable[dict[str, Any]]]) -> None:
        """Publish the list of subjects, and what goes with it, when it changed, at most twice a second, without end."""
        while True:
            await self._stale.wait()
            self._stale.clear()
            if self._queues:
                self.publish({"type": "subjects", **await state()})
            await asyncio.sleep(_SUBJECTS)
