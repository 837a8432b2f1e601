"""WebSocket connection of a station's page."""

from __future__ import annotations

import asyncio
from collections import deque
from contextlib import suppress
from typing import Any

from starlette.websockets import WebSocket, WebSocketDisconnect

from holdfast.core.errors import HoldfastError, InputError, StoreError
from holdfast.teleop.serve import messages
from holdfast.teleop.serve.control import Control
from holdfast.teleop.serve.guard import RateLimiter
from holdfast.teleop.serve.messages import Ack, Bye, Hello, Message, Pause, Refused, Unstored

_MAX_UNANSWERED_MESSAGES = 512  # messages of one page that wait for the disk
_GREETING_TIMEOUT_S = 10.0  # time for the first message, s
# _BYTES_PER_SECOND and _BURST_BYTES: bytes that a page may send per second in the long run, and at once after a pause
_BYTES_PER_SECOND = 256 * 1024.0
_BURST_BYTES = 4 * 2.0**20


class Connection:
    """Connection of a page: reads no faster than allowed, and answers in order.

    Args:
        socket: WebSocket that is not yet accepted.
        control: State of the server.

    Attributes:
        code: Code of the subject whose session the page holds; None before hello.
    """

    def __init__(self, socket: WebSocket, control: Control) -> None:
        self._socket, self._control = socket, control
        self._message_limiter, self._byte_limiter = RateLimiter(), RateLimiter(_BYTES_PER_SECOND, _BURST_BYTES)
        self._free_slots = asyncio.Semaphore(_MAX_UNANSWERED_MESSAGES)
        self._outbox: deque[tuple[Message | None, bool]] = deque()
        self._outbox_filled = asyncio.Event()
        self._is_closing = False
        self.code: str | None = None

    async def run(self) -> None:
        """Serve the page until it disconnects or is disconnected."""
        await self._socket.accept()
        reading, sending = asyncio.ensure_future(self._read_messages()), asyncio.ensure_future(self._send_messages())
        try:
            await asyncio.wait((reading, sending), return_when=asyncio.FIRST_COMPLETED)
        finally:
            self._is_closing = True
            for task in (reading, sending):
                task.cancel()
            results = await asyncio.gather(reading, sending, return_exceptions=True)
            self._control.release_session(self)
        for result in results:
            if isinstance(result, Exception):
                raise result

    # ---- calls from the server -------------------------------------------------------------------------------------

    def send_reply(self, reply: Message | Exception) -> None:
        """Send the reply to a message, in the order of the messages; an exception means that it could not be written."""
        if isinstance(reply, Exception):
            self.report_write_failure(is_reply=True)
        else:
            self._queue_message(reply, is_reply=True)
            self._is_closing = self._is_closing or isinstance(reply, Bye)

    def pause(self, paused: bool) -> None:
        """Send the page the message to wait, or to continue."""
        self._queue_message(Pause(paused=paused))

    def report_write_failure(self, is_reply: bool = False) -> None:
        """Report that the records cannot be written, and close; the page reconnects by itself."""
        if not self._is_closing:
            self._is_closing = True
            self._queue_message(Unstored(), is_reply)
        self._queue_message(None, is_reply)

    def close_silently(self) -> None:
        """Close without a message, because too many connections have not sent hello."""
        self._is_closing = True
        self._queue_message(None)

    def bye(self, reason: str) -> None:
        """Send the reason and close; later messages of the page are ignored."""
        self._is_closing = True
        self._queue_message(Bye(reason=reason))

    # ---- internal --------------------------------------------------------------------------------------------------

    def _queue_message(self, message: Message | None, is_reply: bool = False) -> None:
        self._outbox.append((message, is_reply))
        self._outbox_filled.set()

    async def _read_messages(self) -> None:
        with self._control.track_until_hello(self):
            await asyncio.wait_for(self._await_hello(), _GREETING_TIMEOUT_S)
        while True:
            text = await self._receive_text()
            await self._free_slots.acquire()
            if self._is_closing:
                break
            try:
                message = messages.parse_message(text)
                if isinstance(message, Hello):
                    raise InputError("this page has said hello already")
            except InputError as error:
                self._queue_refusal(str(error))
            else:
                self._control.apply_message(self, message, len(text))
        await asyncio.Event().wait()  # the sender ends the connection

    async def _await_hello(self) -> None:
        while self.code is None and not self._is_closing:
            text = await self._receive_text()
            try:
                hello = messages.parse_message(text)
                if not isinstance(hello, Hello):
                    raise InputError("the first message must be hello")
                reply: Message = await self._control.enter_session(self, hello)
            except InputError as error:
                reply = Refused(seq=None, reason=str(error), last=0)
            except StoreError:
                self.report_write_failure()
                break
            self._queue_message(reply)
            self._is_closing = self._is_closing or isinstance(reply, Bye)

    def _queue_refusal(self, reason: str) -> None:
        """Queue a refusal through the writer, so that the replies stay in order."""
        code = self.code
        assert code is not None

        def send_refusal(result: Any) -> None:
            self.send_reply(result if isinstance(result, Exception) else Refused(seq=None, reason=reason, last=result))

        self._control.writer.submit_job(lambda records: records.last_seq(code), send_refusal)

    async def _receive_text(self) -> str | bytes:
        await asyncio.sleep(self._message_limiter.reserve_and_get_wait())
        message = await self._socket.receive()
        if message["type"] == "websocket.disconnect":
            raise WebSocketDisconnect(message.get("code", 1006))
        text: str | bytes | None = message.get("text")
        text = message["bytes"] if text is None else text
        await asyncio.sleep(self._byte_limiter.reserve_and_get_wait(len(text)))
        return text

    async def _send_messages(self) -> None:
        while True:
            await self._outbox_filled.wait()
            self._outbox_filled.clear()
            while self._outbox:
                message, counts = self._outbox.popleft()
                answer_count = int(counts)
                # One acknowledgement for all messages that are on the disk.
                while isinstance(message, Ack) and self._outbox and isinstance(self._outbox[0][0], Ack):
                    message, _ = self._outbox.popleft()
                    answer_count += 1
                if message is None:
                    await self._socket.close(1011)
                    return
                await self._socket.send_text(message.model_dump_json())
                for _ in range(answer_count):
                    self._free_slots.release()
                if isinstance(message, Bye):
                    with suppress(RuntimeError):
                        await self._socket.close(1000)
                    return


async def serve_session(socket: WebSocket) -> None:
    """Serve the route ``/session``."""
    # Errors of a page that has disconnected or was silent, and of records that cannot be written, which the log reports.
    with suppress(WebSocketDisconnect, TimeoutError, HoldfastError):
        await Connection(socket, socket.app.state.control).run()
