"""The experimenter's routes; the guard has seen the key before any of them is asked."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Callable
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated, Any, TypeVar
from urllib.parse import urlencode

from pydantic import Field, ValidationError
from starlette.background import BackgroundTask
from starlette.requests import ClientDisconnect, HTTPConnection, Request
from starlette.responses import FileResponse, HTMLResponse, JSONResponse, PlainTextResponse, Response
from starlette.routing import BaseRoute, Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from holdfast.errors import HoldfastError, InputError
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.entries import Who
from holdfast.teleop.records.session import training_tasks
from holdfast.teleop.serve.control import Control
from holdfast.teleop.serve.guard import Guard
from holdfast.teleop.serve.messages import Code, Message, sentence
from holdfast.teleop.serve.process import apart

_MISSING = ("refuse", "complete", "mixed")  # see holdfast.teleop.analysis.analyse
_MOST_BYTES = 64 * 1024  # of what is posted: the longest note fits
# A report needs nothing but itself. It holds what subjects wrote, in an address that has the key: no script runs in it.
_REPORT_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'none'; sandbox"


class Pausing(Message):
    """Let one subject's session wait or go on; None for all."""

    subject: Code | None
    paused: bool


class Note(Message):
    """A note about a subject."""

    subject: Code
    note: Annotated[str, Field(max_length=10_000)]


class Chosen(Message):
    """A subject."""

    subject: Code


M = TypeVar("M", bound=Message)
Endpoint = Callable[[Request], Awaitable[Response]]


class _Refusal(Exception):
    """A request that cannot be read."""

    def __init__(self, status: int, reason: str) -> None:
        super().__init__(reason)
        self.status = status


def routes(guard: Guard, page: Callable[[Request], Response] | None) -> list[BaseRoute]:
    """All of them; ``request.app.state.control`` is the :class:`holdfast.teleop.serve.control.Control`.

    Args:
        guard: Whose token a station's address needs.
        page: Answers with the experimenter's page; None where it was not built.
    """
    served = _Served(guard.token)
    found: list[BaseRoute] = [
        Route("/experimenter/subjects.json", _answering(served.subjects), methods=["GET"]),
        Route("/experimenter/pause", _answering(served.pause), methods=["POST"]),
        Route("/experimenter/note", _answering(served.note), methods=["POST"]),
        Route("/experimenter/drop", _answering(served.drop), methods=["POST"]),
        Route("/experimenter/resume", _answering(served.resume), methods=["POST"]),
        Route("/experimenter/export.zip", _answering(served.export), methods=["GET"]),
        Route("/experimenter/report", _answering(served.report), methods=["GET"]),
        WebSocketRoute("/live", live),
    ]
    return found if page is None else [Route("/experimenter", page, methods=["GET"]), *found]


class _Served:
    """What the routes answer.

    Args:
        token: Of the stations; None for none.
    """

    def __init__(self, token: str | None) -> None:
        self._token = token
        self._one = asyncio.Lock()  # tables and reports one at a time: each is a process

    async def subjects(self, request: Request) -> Response:
        """Everything that the page shows but the moving arm."""
        control = _control(request)
        constant = {
            "name": control.protocol.name,
            "folder": str(control.folder.resolve()),
            "station": self._station(request),
            "scenarios": [s.label for s in control.protocol.scenarios],
            "joints": list(control.protocol.arm.joint_names),
            "plan": await asyncio.to_thread(_plan, control.protocol),
        }
        return JSONResponse(constant | await control.state())

    async def pause(self, request: Request) -> Response:
        """Let one session, or all of them, wait or go on."""
        asked = await _posted(request, Pausing)
        await _control(request).pause(asked.subject, asked.paused)
        return JSONResponse({})

    async def note(self, request: Request) -> Response:
        """Write a note about a subject."""
        asked = await _posted(request, Note)
        await _control(request).note(asked.subject, asked.note)
        return JSONResponse({})

    async def drop(self, request: Request) -> Response:
        """End a subject's session for good."""
        asked = await _posted(request, Chosen)
        await _control(request).drop(asked.subject)
        return JSONResponse({})

    async def resume(self, request: Request) -> Response:
        """An address that resumes a session in another page."""
        asked = await _posted(request, Chosen)
        control = _control(request)
        key = await control.new_key(asked.subject)
        subject = await control.reader.do(lambda records: records.subject(asked.subject))
        # A dry run stays one.
        robot = {"robot": str(subject.number)} if subject.kind == Who.SIMULATED else {}
        return JSONResponse({"url": self._station(request, session=key, **robot)})

    async def export(self, request: Request) -> Response:
        """All tables, zipped."""
        control = _control(request)
        out = await self._made("export", control)
        name = f"{control.folder.resolve().name or 'experiment'}.zip"
        file = Path(out.name) / "export.zip"
        return FileResponse(file, media_type="application/zip", filename=name, background=BackgroundTask(out.cleanup))

    async def report(self, request: Request) -> Response:
        """The analysis, as ``holdfast teleop analyse`` writes it."""
        missing = request.query_params.get("missing", "refuse")
        if missing not in _MISSING:
            raise InputError(f"missing must be one of {', '.join(_MISSING)}")
        out = await self._made("report", _control(request), missing)
        with out:
            page = await asyncio.to_thread((Path(out.name) / "report.html").read_bytes)
        return HTMLResponse(page, headers={"content-security-policy": _REPORT_POLICY})

    async def _made(self, job: str, control: Control, *more: str) -> TemporaryDirectory[str]:
        """A folder with what a job made; the caller's to clean up."""
        async with self._one:
            out = TemporaryDirectory(prefix=f"holdfast-{job}-")
            try:
                await apart(job, str(control.folder), out.name, *more)
            except BaseException:
                out.cleanup()
                raise
        return out

    def _station(self, request: Request, **query: str) -> str:
        """A station's address, as the experimenter's browser sees this server."""
        asked = ({} if self._token is None else {"token": self._token}) | query
        return str(request.base_url) + (f"?{urlencode(asked)}" if asked else "")


def _plan(protocol: Protocol) -> dict[str, Any]:
    """Where the arm and the target may be, as a station's plan has it: with the first subject's training."""
    tasks = {"training": training_tasks(protocol, 0), "trials": protocol.tasks}
    return {
        key: [{"q0": q0, "target": target} for q0, target in zip(of.q0.tolist(), of.target.tolist(), strict=True)]
        for key, of in tasks.items()
    }


async def live(socket: WebSocket) -> None:
    """The route ``/live``: the list of subjects now and when it changes, and the arms that move; nothing is listened to."""
    await socket.accept()
    telling, gone = asyncio.ensure_future(_tell(socket)), asyncio.ensure_future(socket.receive())
    try:
        await asyncio.wait((telling, gone), return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in (telling, gone):
            task.cancel()
        await asyncio.gather(telling, gone, return_exceptions=True)
    if not gone.cancelled() and gone.exception() is None and gone.result()["type"] == "websocket.receive":
        with suppress(RuntimeError, WebSocketDisconnect):
            await socket.close(1003, "nothing is listened to here")


async def _tell(socket: WebSocket) -> None:
    control = _control(socket)
    control.changed()  # a list comes as soon as there is somebody who watches, that is, in the next line
    async for message in control.live.watch():
        await socket.send_text(json.dumps(message))


def _control(asked: HTTPConnection) -> Control:
    control: Control = asked.app.state.control
    return control


def _answering(endpoint: Endpoint) -> Endpoint:
    """With a sentence where it cannot be done: as JSON to what the page posts, as text to what a person opens."""

    def refused(request: Request, status: int, reason: str) -> Response:
        if request.method == "POST":
            return JSONResponse({"error": reason}, status)
        return PlainTextResponse(f"{reason[:1].upper()}{reason[1:]}.\n", status)

    async def answer(request: Request) -> Response:
        try:
            return await endpoint(request)
        except _Refusal as refusal:
            return refused(request, refusal.status, str(refusal))
        except InputError as error:
            return refused(request, 400, str(error))
        except HoldfastError as error:
            return refused(request, 500, str(error))
        except ClientDisconnect:
            return Response(status_code=400)  # nobody receives it: the connection ended within the request

    return answer


async def _posted(request: Request, model: type[M]) -> M:
    """What was posted."""
    if request.headers.get("content-type", "").split(";")[0].strip().lower() != "application/json":
        raise _Refusal(415, "the request must be JSON, and say so")
    body = bytearray()
    async for chunk in request.stream():
        body += chunk
        if len(body) > _MOST_BYTES:
            raise _Refusal(413, f"the request has more than {_MOST_BYTES} bytes")
    try:
        return model.model_validate_json(bytes(body))
    except ValidationError as error:
        raise InputError(sentence(error)) from None
