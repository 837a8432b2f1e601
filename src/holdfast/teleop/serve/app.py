"""Application: pages, the experiment as JSON, the arm as JavaScript, and the WebSocket of the stations."""

from __future__ import annotations

import asyncio
import json
import logging
import socket
from collections.abc import AsyncIterator, Callable
from contextlib import ExitStack, asynccontextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

import uvicorn
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp

from holdfast.core.errors import InputError, StoreError
from holdfast.teleop.protocol.protocol import Protocol, read_protocol
from holdfast.teleop.records.file import RECORDS_FILE, lock_records_folder
from holdfast.teleop.records.records import Records
from holdfast.teleop.serve import bounded, experimenter
from holdfast.teleop.serve.briefing import describe_experiment
from holdfast.teleop.serve.connection import serve_session
from holdfast.teleop.serve.control import Control
from holdfast.teleop.serve.guard import Guard, GuardedApp
from holdfast.teleop.serve.messages import MOST_BYTES
from holdfast.teleop.serve.texts import ENGLISH_FILE
from holdfast.teleop.serve.texts import load_texts as read_texts

STATIC_FOLDER = Path(__file__).with_name("static")
_BACKLOG_CONNECTIONS = 1024  # connections that the system queues until they are accepted
_ACCEPT_BATCH_SIZE = 8  # connections that are accepted at a time, so that stations are answered in between
_INDEX_PAGE = "index.html"
_CONTENT_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".json": "application/json",
    ".svg": "image/svg+xml",
}


@dataclass(frozen=True)
class ServerOptions:
    """Options of the server of an experiment.

    Attributes:
        folder: Folder of the experiment.
        guard: Token, key, and hosts.
        texts: File of translated texts. None: English.
        tlx: True to ask for the NASA task load index.
        static: Folder of the built page.
        english: File of the English texts, which determines the keys.
        protocol: Name or file. None: the protocol of the experiment, or the paper's for a new one.
        behind_proxy: True if a proxy on this computer sets ``X-Forwarded-For`` and ``X-Forwarded-Proto``; otherwise both are
            ignored.
    """

    folder: Path
    guard: Guard = field(default_factory=Guard)
    texts: Path | None = None
    tlx: bool = False
    static: Path = STATIC_FOLDER
    english: Path = ENGLISH_FILE
    protocol: str | None = None
    behind_proxy: bool = False


def open_or_create(folder: Path, protocol: str | None) -> Protocol:
    """Open the experiment in a folder, or begin one in a new folder, and return its protocol.

    Args:
        folder: Folder of the experiment.
        protocol: Name or file. None: the protocol of the experiment, or the paper's for a new one.

    Raises:
        StoreError: The folder is neither empty nor an experiment.
        InputError: The experiment in the folder has another protocol.
    """
    if not (folder / RECORDS_FILE).is_file():
        with Records.create(folder, read_protocol() if protocol is None else read_protocol(protocol)) as records:
            return records.protocol
    with Records.open(folder) as records:
        if protocol is not None and read_protocol(protocol).to_yaml() != records.protocol.to_yaml():
            raise InputError(
                f"'{folder}' contains an experiment with another protocol than '{protocol}'; leave --protocol out, "
                "or give a new folder"
            )
        return records.protocol


def make_app(options: ServerOptions, ready: Callable[[], None] | None = None) -> ASGIApp:
    """Open or begin the experiment, and return the application that serves it.

    Args:
        options: Options of the server.
        ready: Function that is called when stations can connect.

    Raises:
        StoreError: The built page is missing, or the folder is neither empty nor an experiment.
        InputError: The texts cannot be used, or the experiment has another protocol.
    """
    from holdfast.teleop.protocol.printed_arm import generate_arm_javascript

    texts = read_texts(options.texts, options.english)
    answers = _load_page_handlers(options.static)
    # It has a separate route, which requires the key.
    experimenter_page = answers.pop("/experimenter.html", None)
    # After everything that may fail, so that a server that cannot run begins no experiment.
    protocol = open_or_create(options.folder, options.protocol)
    answers["/experiment.json"] = _make_file_handler(
        json.dumps(describe_experiment(protocol, texts, options.tlx)).encode(), ".json"
    )
    answers["/arm.js"] = _make_file_handler(generate_arm_javascript(protocol).encode(), ".js")

    @asynccontextmanager
    async def lifespan(app: Starlette) -> AsyncIterator[None]:
        bounded.limit_asyncio_log(asyncio.get_running_loop())
        control = Control(options.folder, asyncio.get_running_loop())
        app.state.control = control
        await control.begin()
        if ready is not None:
            ready()
        try:
            yield
        finally:
            await asyncio.to_thread(control.close)

    routes = [
        *(Route(path, answer, methods=["GET"]) for path, answer in answers.items()),
        *experimenter.make_routes(options.guard, experimenter_page),
        WebSocketRoute("/session", serve_session),
    ]
    app = Starlette(routes=routes, lifespan=lifespan)
    app.router.redirect_slashes = False
    return GuardedApp(app, options.guard)


def serve_experiment(
    options: ServerOptions, host: str = "127.0.0.1", port: int = 8000, ready: Callable[[int], None] | None = None
) -> None:
    """Serve the experiment until interrupted.

    Args:
        options: Options of the server.
        host: Host name or address on which the server listens.
        port: Port on which it listens; 0 for any free port.
        ready: Function that is called with the port when stations can connect.

    Raises:
        StoreError: The port is taken, or this computer has no such address; the built page is missing, or the folder is
            neither empty nor an experiment.
        InputError: The texts cannot be used, or the experiment has another protocol.
    """
    with _open_listener(host, port) as listener:
        bound_port = listener.getsockname()[1]
        app = make_app(options, None if ready is None else lambda: ready(bound_port))
        http, websocket = bounded.make_bounded_protocols(bounded.raise_file_limit() // 2)
        config = uvicorn.Config(
            app,
            loop="asyncio",
            http=http,
            backlog=_ACCEPT_BATCH_SIZE,
            ws=websocket,
            ws_max_size=MOST_BYTES,
            ws_ping_timeout=60.0,
            ws_per_message_deflate=False,  # compressing small messages takes longer than sending them on a local network
            log_level="warning",
            access_log=False,
            server_header=False,
            proxy_headers=options.behind_proxy,
            timeout_graceful_shutdown=5,
        )
        logging.getLogger("uvicorn.error").addFilter(bounded.RateLimitedLogFilter())
        with lock_records_folder(options.folder), suppress(KeyboardInterrupt):
            _Server(config).run(sockets=[listener])


class _Server(uvicorn.Server):
    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        for listener in sockets or ():
            listener.listen(_BACKLOG_CONNECTIONS)  # asyncio has set the backlog to the batch size


def _open_listener(host: str, port: int) -> socket.socket:
    with ExitStack() as cleanup:
        try:
            family, socket_type, *_, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)[
                0
            ]
            listener = cleanup.enter_context(socket.socket(family, socket_type))
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            listener.bind(address)
            listener.listen(_BACKLOG_CONNECTIONS)
        except OSError as error:
            raise StoreError(
                f"cannot listen at {host}, port {port}: {error.strerror or error}; choose another port or host"
            ) from error
        cleanup.pop_all()
    return listener


def _load_page_handlers(folder: Path) -> dict[str, Callable[[Request], Response]]:
    """Return a handler for every built file by its exact path, so that no path of a URL reaches the file system."""
    if not (folder / _INDEX_PAGE).is_file():
        raise StoreError(
            f"the built page is not in this installation ('{folder / _INDEX_PAGE}' is missing); install holdfast again, "
            "or build it from the sources"
        )
    answers = {
        f"/{file.name}": _make_file_handler(file.read_bytes(), file.suffix)
        for file in sorted(folder.iterdir())
        if file.suffix in _CONTENT_TYPES
    }
    answers["/"] = answers.pop(f"/{_INDEX_PAGE}")
    return answers


def _make_file_handler(content: bytes, suffix: str) -> Callable[[Request], Response]:
    return lambda _: Response(content, headers={"content-type": _CONTENT_TYPES[suffix]})
