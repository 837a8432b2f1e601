"""Routes of the experimenter; the guard has checked the key before any of them runs."""

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

from holdfast.core.errors import HoldfastError, InputError
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.entries import SubjectKind
from holdfast.teleop.records.session import training_tasks
from holdfast.teleop.serve.control import Control
from holdfast.teleop.serve.guard import Guard
from holdfast.teleop.serve.messages import Code, Message, describe_error
from holdfast.teleop.serve.process import run_job

_MISSING_POLICIES = ("refuse", "complete", "mixed")  # see holdfast.teleop.analysis.analyse
_MAX_REQUEST_BYTES = 64 * 1024  # largest request body; the longest note fits
# A report is self-contained. It contains text from subjects, and its address contains the key, so no script may run in it.
_REPORT_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'none'; sandbox"


class PauseRequest(Message):
    """Request to pause or resume one subject's session; None for all."""

    subject: Code | None
    paused: bool


class NoteRequest(Message):
    """Request to write a note about a subject."""

    subject: Code
    note: Annotated[str, Field(max_length=10_000)]


class SubjectRequest(Message):
    """Request about a subject."""

    subject: Code


M = TypeVar("M", bound=Message)
Endpoint = Callable[[Request], Awaitable[Response]]


class _RequestRefusal(Exception):
    """Refusal of a request that cannot be read."""

    def __init__(self, status: int, reason: str) -> None:
        super().__init__(reason)
        self.status = status


def make_routes(guard: Guard, page: Callable[[Request], Response] | None) -> list[BaseRoute]:
    """Return all routes; ``request.app.state.control`` is the :class:`holdfast.teleop.serve.control.Control`.

    Args:
        guard: Guard, whose token is part of a station's address.
        page: Handler of the experimenter's page; None if it was not built.
    """
    handlers = _ExperimenterHandlers(guard.token)
    api_routes: list[BaseRoute] = [
        Route("/experimenter/subjects.json", _with_error_responses(handlers.get_subjects), methods=["GET"]),
        Route("/experimenter/pause", _with_error_responses(handlers.post_pause), methods=["POST"]),
        Route("/experimenter/note", _with_error_responses(handlers.post_note), methods=["POST"]),
        Route("/experimenter/drop", _with_error_responses(handlers.post_drop), methods=["POST"]),
        Route("/experimenter/resume", _with_error_responses(handlers.post_resume), methods=["POST"]),
        Route("/experimenter/export.zip", _with_error_responses(handlers.get_export), methods=["GET"]),
        Route("/experimenter/report", _with_error_responses(handlers.get_report), methods=["GET"]),
        WebSocketRoute("/live", stream_live),
    ]
    return api_routes if page is None else [Route("/experimenter", page, methods=["GET"]), *api_routes]


class _ExperimenterHandlers:
    """Handlers of the routes.

    Args:
        token: Token of the stations; None for none.
    """

    def __init__(self, token: str | None) -> None:
        self._token = token
        self._job_lock = asyncio.Lock()  # tables and reports run one at a time, because each is a process

    async def get_subjects(self, request: Request) -> Response:
        """Return all data of the page, except the moving arm."""
        control = _get_control(request)
        constant = {
            "name": control.protocol.name,
            "folder": str(control.folder.resolve()),
            "station": self._station_url(request),
            "scenarios": [scenario.label for scenario in control.protocol.scenarios],
            "joints": list(control.protocol.arm.joint_names),
            "plan": await asyncio.to_thread(_list_starts_and_targets, control.protocol),
        }
        return JSONResponse(constant | await control.describe_state())

    async def post_pause(self, request: Request) -> Response:
        """Pause or resume one session, or all of them."""
        posted = await _read_posted(request, PauseRequest)
        await _get_control(request).pause(posted.subject, posted.paused)
        return JSONResponse({})

    async def post_note(self, request: Request) -> Response:
        """Set the note about a subject."""
        posted = await _read_posted(request, NoteRequest)
        await _get_control(request).set_note(posted.subject, posted.note)
        return JSONResponse({})

    async def post_drop(self, request: Request) -> Response:
        """End a subject's session permanently."""
        posted = await _read_posted(request, SubjectRequest)
        await _get_control(request).drop_subject(posted.subject)
        return JSONResponse({})

    async def post_resume(self, request: Request) -> Response:
        """Return an address that resumes a session in another page."""
        posted = await _read_posted(request, SubjectRequest)
        control = _get_control(request)
        key = await control.renew_key(posted.subject)
        subject = await control.reader.run_job(lambda records: records.subject(posted.subject))
        # A dry run remains a dry run.
        robot_query = {"robot": str(subject.number)} if subject.kind == SubjectKind.SIMULATED else {}
        return JSONResponse({"url": self._station_url(request, session=key, **robot_query)})

    async def get_export(self, request: Request) -> Response:
        """Return all tables as a zip archive."""
        control = _get_control(request)
        output = await self._run_job("export", control)
        file_name = f"{control.folder.resolve().name or 'experiment'}.zip"
        file = Path(output.name) / "export.zip"
        return FileResponse(file, media_type="application/zip", filename=file_name, background=BackgroundTask(output.cleanup))

    async def get_report(self, request: Request) -> Response:
        """Return the analysis, as ``holdfast teleop analyse`` writes it."""
        missing = request.query_params.get("missing", "refuse")
        if missing not in _MISSING_POLICIES:
            raise InputError(f"missing must be one of {', '.join(_MISSING_POLICIES)}")
        output = await self._run_job("report", _get_control(request), missing)
        with output:
            page = await asyncio.to_thread((Path(output.name) / "report.html").read_bytes)
        return HTMLResponse(page, headers={"content-security-policy": _REPORT_POLICY})

    async def _run_job(self, job: str, control: Control, *arguments: str) -> TemporaryDirectory[str]:
        """Run a job, and return the folder with its output, which the caller removes."""
        async with self._job_lock:
            output = TemporaryDirectory(prefix=f"holdfast-{job}-")
            try:
                await run_job(job, str(control.folder), output.name, *arguments)
            except BaseException:
                output.cleanup()
                raise
        return output

    def _station_url(self, request: Request, **query: str) -> str:
        """Return a station's address, as the experimenter's browser sees this server."""
        parameters = ({} if self._token is None else {"token": self._token}) | query
        return str(request.base_url) + (f"?{urlencode(parameters)}" if parameters else "")


def _list_starts_and_targets(protocol: Protocol) -> dict[str, Any]:
    """Return the possible positions of arm and target in the form of a station's plan, with the first subject's training."""
    tasks = {"training": training_tasks(protocol, 0), "trials": protocol.tasks}
    return {
        key: [
            {"q0": q0, "target": target}
            for q0, target in zip(point_tasks.q0.tolist(), point_tasks.target.tolist(), strict=True)
        ]
        for key, point_tasks in tasks.items()
    }


async def stream_live(socket: WebSocket) -> None:
    """Serve the route ``/live``: the list of subjects, now and after changes, and the moving arms; messages are rejected."""
    await socket.accept()
    sending, disconnected = asyncio.ensure_future(_send_updates(socket)), asyncio.ensure_future(socket.receive())
    try:
        await asyncio.wait((sending, disconnected), return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in (sending, disconnected):
            task.cancel()
        await asyncio.gather(sending, disconnected, return_exceptions=True)
    if (
        not disconnected.cancelled()
        and disconnected.exception() is None
        and disconnected.result()["type"] == "websocket.receive"
    ):
        with suppress(RuntimeError, WebSocketDisconnect):
            await socket.close(1003, "nothing is listened to here")


async def _send_updates(socket: WebSocket) -> None:
    control = _get_control(socket)
    control.mark_subjects_changed()  # the list is sent as soon as the page is connected, which is in the next line
    async for message in control.live.stream_messages():
        await socket.send_text(json.dumps(message))


def _get_control(connection: HTTPConnection) -> Control:
    control: Control = connection.app.state.control
    return control


def _with_error_responses(endpoint: Endpoint) -> Endpoint:
    """Wrap an endpoint so that errors become responses: JSON for the page's posts, text for a person's browser."""

    def make_refusal(request: Request, status: int, reason: str) -> Response:
        if request.method == "POST":
            return JSONResponse({"error": reason}, status)
        return PlainTextResponse(f"{reason[:1].upper()}{reason[1:]}.\n", status)

    async def answer_request(request: Request) -> Response:
        try:
            return await endpoint(request)
        except _RequestRefusal as refusal:
            return make_refusal(request, refusal.status, str(refusal))
        except InputError as error:
            return make_refusal(request, 400, str(error))
        except HoldfastError as error:
            return make_refusal(request, 500, str(error))
        except ClientDisconnect:
            return Response(status_code=400)  # not received by anyone: the connection ended within the request

    return answer_request


async def _read_posted(request: Request, model: type[M]) -> M:
    """Read and validate the posted JSON."""
    if request.headers.get("content-type", "").split(";")[0].strip().lower() != "application/json":
        raise _RequestRefusal(415, "the request must be JSON, and say so")
    body = bytearray()
    async for chunk in request.stream():
        body += chunk
        if len(body) > _MAX_REQUEST_BYTES:
            raise _RequestRefusal(413, f"the request has more than {_MAX_REQUEST_BYTES} bytes")
    try:
        return model.model_validate_json(bytes(body))
    except ValidationError as error:
        raise InputError(describe_error(error)) from None
