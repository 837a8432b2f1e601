"""One WebSocket of a station's page."""

from __future__ import annotations

import asyncio
from collections import deque
from contextlib import suppress
from typing import Any

from starlette.websockets import WebSocket, WebSocketDisconnect

from holdfast.errors import HoldfastError, InputError, StoreError
from holdfast.teleop.serve import messages
from holdfast.teleop.serve.control import Control
from holdfast.teleop.serve.guard import Bucket
from holdfast.teleop.serve.messages import Ack, Bye, Hello, Message, Pause, Refused, Unstored

_UNANSWERED = 512  # messages of one page that wait for the disk
_GREETING = 10.0  # s for the first message
_BYTES, _AT_ONCE = 256 * 1024.0, 4 * 2.0**20  # that a page may send in a second for ever, and at once after a pause


class Connection:
    """A page that is connected: reads no faster than it may, and answers in order.

    Args:
        socket: The WebSocket, not yet accepted.
        control: Of the server.

    Attributes:
        code: The subject whose session the page holds; None before hello.
    """

    def __init__(self, socket: WebSocket, control: Control) -> None:
        self._socket, self._control = socket, control
        self._bucket, self._bytes = Bucket(), Bucket(_BYTES, _AT_ONCE)
        self._room = asyncio.Semaphore(_UNANSWERED)
        self._out: deque[tuple[Message | None, bool]] = deque()
        self._news = asyncio.Event()
        self._barred = False
        self.code: str | None = None

    async def run(self) -> None:
        """Until the page goes away, or is told to."""
        await self._socket.accept()
        reading, sending = asyncio.ensure_future(self._read()), asyncio.ensure_future(self._send())
        try:
            await asyncio.wait((reading, sending), return_when=asyncio.FIRST_COMPLETED)
        finally:
            self._barred = True
            for task in (reading, sending):
                task.cancel()
            results = await asyncio.gather(reading, sending, return_exceptions=True)
            self._control.leave(self)
        for result in results:
            if isinstance(result, Exception):
                raise result

    # ---- told by the server ----------------------------------------------------------------------------------------

    def answered(self, reply: Message | Exception) -> None:
        """The reply to a message, in the order of the messages; an exception: it could not be written."""
        if isinstance(reply, Exception):
            self.unstored(counts=True)
        else:
            self._put(reply, counts=True)
            self._barred = self._barred or isinstance(reply, Bye)

    def pause(self, paused: bool) -> None:
        """Tell the page to wait, or to go on."""
        self._put(Pause(paused=paused))

    def unstored(self, counts: bool = False) -> None:
        """Say that the records cannot be written, and close; the page comes back by itself."""
        if not self._barred:
            self._barred = True
            self._put(Unstored(), counts)
        self._put(None, counts)

    def turn_away(self) -> None:
        """Close, without a word: there are too many that say nothing."""
        self._barred = True
        self._put(None)

    def bye(self, reason: str) -> None:
        """Say why, and close; nothing that comes after this is taken."""
        self._barred = True
        self._put(Bye(reason=reason))

    # ---- inside ----------------------------------------------------------------------------------------------------

    def _put(self, message: Message | None, counts: bool = False) -> None:
        self._out.append((message, counts))
        self._news.set()

    async def _read(self) -> None:
        with self._control.greeted(self):
            await asyncio.wait_for(self._greet(), _GREETING)
        while True:
            text = await self._text()
            await self._room.acquire()
            if self._barred:
                break
            try:
                message = messages.read(text)
                if isinstance(message, Hello):
                    raise InputError("this page has said hello already")
            except InputError as error:
                self._refuse(str(error))
            else:
                self._control.take(self, message, len(text))
        await asyncio.Event().wait()  # the sender ends the connection

    async def _greet(self) -> None:
        while self.code is None and not self._barred:
            text = await self._text()
            try:
                hello = messages.read(text)
                if not isinstance(hello, Hello):
                    raise InputError("the first message must be hello")
                reply: Message = await self._control.enter(self, hello)
            except InputError as error:
                reply = Refused(seq=None, reason=str(error), last=0)
            except StoreError:
                self.unstored()
                break
            self._put(reply)
            self._barred = self._barred or isinstance(reply, Bye)

    def _refuse(self, reason: str) -> None:
        """Through the writer, so that the answer has its place among the others."""
        code = self.code
        assert code is not None

        def last(result: Any) -> None:
            self.answered(result if isinstance(result, Exception) else Refused(seq=None, reason=reason, last=result))

        self._control.writer.put(lambda records: records.last_seq(code), last)

    async def _text(self) -> str | bytes:
        await asyncio.sleep(self._bucket.wait())
        message = await self._socket.receive()
        if message["type"] == "websocket.disconnect":
            raise WebSocketDisconnect(message.get("code", 1006))
        text: str | bytes | None = message.get("text")
        text = message["bytes"] if text is None else text
        await asyncio.sleep(self._bytes.wait(len(text)))
        return text

    async def _send(self) -> None:
        while True:
            await self._news.wait()
            self._news.clear()
            while self._out:
                message, counts = self._out.popleft()
                answered = int(counts)
                # One acknowledgement for all that are on the disk.
                while isinstance(message, Ack) and self._out and isinstance(self._out[0][0], Ack):
                    message, _ = self._out.popleft()
                    answered += 1
                if message is None:
                    await self._socket.close(1011)
                    return
                await self._socket.send_text(message.model_dump_json())
                for _ in range(answered):
                    self._room.release()
                if isinstance(message, Bye):
                    with suppress(RuntimeError):
                        await self._socket.close(1000)
                    return


async def session(socket: WebSocket) -> None:
    """The route ``/session``."""
    # A page that is gone, or was silent; and records that cannot be written, which the log tells of.
    with suppress(WebSocketDisconnect, TimeoutError, HoldfastError):
        await Connection(socket, socket.app.state.control).run()
