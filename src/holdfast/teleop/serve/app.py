"""The application: pages, the experiment as JSON, the arm as JavaScript, and the WebSocket of the stations."""

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

from holdfast.errors import InputError, StoreError
from holdfast.teleop.protocol.protocol import Protocol, read_protocol
from holdfast.teleop.records.file import FILE, alone
from holdfast.teleop.records.records import Records
from holdfast.teleop.serve import bounded, experimenter
from holdfast.teleop.serve.briefing import experiment
from holdfast.teleop.serve.connection import session
from holdfast.teleop.serve.control import Control
from holdfast.teleop.serve.guard import Guard, Guarded
from holdfast.teleop.serve.messages import MOST_BYTES
from holdfast.teleop.serve.texts import ENGLISH
from holdfast.teleop.serve.texts import read as read_texts

STATIC = Path(__file__).with_name("static")
_BACKLOG = 1024  # connections that the system keeps until they are taken ...
_AT_ONCE = 8  # ... so many at a time, so that stations are answered meanwhile
_PAGE = "index.html"
_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".json": "application/json",
    ".svg": "image/svg+xml",
}


@dataclass(frozen=True)
class Options:
    """How an experiment is served.

    Attributes:
        folder: Of the experiment.
        guard: Token, key, hosts.
        texts: A translation; None for English.
        tlx: Ask for the NASA task load index.
        static: Where the built page is.
        english: Which texts there are.
        protocol: Name or file; None for the protocol of the experiment, or the paper's for a new one.
        behind_proxy: A proxy on this computer sets ``X-Forwarded-For`` and ``X-Forwarded-Proto``; otherwise both are ignored.
    """

    folder: Path
    guard: Guard = field(default_factory=Guard)
    texts: Path | None = None
    tlx: bool = False
    static: Path = STATIC
    english: Path = ENGLISH
    protocol: str | None = None
    behind_proxy: bool = False


def prepare(folder: Path, protocol: str | None) -> Protocol:
    """Open the experiment in a folder, or begin one in a new folder.

    Args:
        folder: Of the experiment.
        protocol: Name or file; None: that of the experiment, or the paper's for a new one.

    Raises:
        StoreError: The folder is neither empty nor an experiment.
        InputError: The experiment in it has another protocol.
    """
    if not (folder / FILE).is_file():
        with Records.create(folder, read_protocol() if protocol is None else read_protocol(protocol)) as records:
            return records.protocol
    with Records.open(folder) as records:
        if protocol is not None and read_protocol(protocol).text() != records.protocol.text():
            raise InputError(
                f"'{folder}' holds an experiment with another protocol than '{protocol}'; leave --protocol out, "
                "or give a new folder"
            )
        return records.protocol


def make_app(options: Options, ready: Callable[[], None] | None = None) -> ASGIApp:
    """Open or begin the experiment, and return the application that serves it.

    Args:
        options: Experiment, guard, texts, and page.
        ready: Called when stations can connect.

    Raises:
        StoreError: The built page is missing, or the folder is neither empty nor an experiment.
        InputError: The texts cannot be used, or the experiment has another protocol.
    """
    from holdfast.teleop.protocol.printed_arm import arm_module

    words = read_texts(options.texts, options.english)
    files = _files(options.static)
    # It has its route, which asks for the key.
    experimenters = files.pop("/experimenter.html", None)
    protocol = prepare(options.folder, options.protocol)  # after all that may fail: a server that cannot run begins nothing
    files["/experiment.json"] = _file(json.dumps(experiment(protocol, words, options.tlx)).encode(), ".json")
    files["/arm.js"] = _file(arm_module(protocol).encode(), ".js")

    @asynccontextmanager
    async def lifespan(app: Starlette) -> AsyncIterator[None]:
        bounded.sparing_loop(asyncio.get_running_loop())
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
        *(Route(path, answer, methods=["GET"]) for path, answer in files.items()),
        *experimenter.routes(options.guard, experimenters),
        WebSocketRoute("/session", session),
    ]
    app = Starlette(routes=routes, lifespan=lifespan)
    app.router.redirect_slashes = False
    return Guarded(app, options.guard)


def serve(options: Options, host: str = "127.0.0.1", port: int = 8000, ready: Callable[[int], None] | None = None) -> None:
    """Serve until interrupted.

    Args:
        options: What.
        host: To listen at.
        port: Likewise; 0 for any that is free.
        ready: Is told the port when stations may come.

    Raises:
        StoreError: The port is taken, or this computer has no such address; the built page is missing, or the folder is
            neither empty nor an experiment.
        InputError: The texts cannot be used, or the experiment has another protocol.
    """
    with _listening(host, port) as listener:
        at = listener.getsockname()[1]
        app = make_app(options, None if ready is None else lambda: ready(at))
        http, websocket = bounded.protocols(bounded.files() // 2)
        config = uvicorn.Config(
            app,
            loop="asyncio",
            http=http,
            backlog=_AT_ONCE,
            ws=websocket,
            ws_max_size=MOST_BYTES,
            ws_ping_timeout=60.0,
            ws_per_message_deflate=False,  # small messages on a near line: packing them takes longer than sending them
            log_level="warning",
            access_log=False,
            server_header=False,
            proxy_headers=options.behind_proxy,
            timeout_graceful_shutdown=5,
        )
        logging.getLogger("uvicorn.error").addFilter(bounded.Sparing())
        with alone(options.folder), suppress(KeyboardInterrupt):
            _Server(config).run(sockets=[listener])


class _Server(uvicorn.Server):
    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        for listener in sockets or ():
            listener.listen(_BACKLOG)  # asyncio has set it to what is taken at once


def _listening(host: str, port: int) -> socket.socket:
    with ExitStack() as opened:
        try:
            family, kind, *_, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)[0]
            listener = opened.enter_context(socket.socket(family, kind))
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            listener.bind(address)
            listener.listen(_BACKLOG)
        except OSError as error:
            raise StoreError(
                f"cannot listen at {host}, port {port}: {error.strerror or error}; choose another port or host"
            ) from error
        opened.pop_all()
    return listener


def _files(folder: Path) -> dict[str, Callable[[Request], Response]]:
    """Every built file by its exact path: no path of a URL reaches the file system."""
    if not (folder / _PAGE).is_file():
        raise StoreError(
            f"the built page is not in this installation ('{folder / _PAGE}' is missing); install holdfast again, "
            "or build it from the sources"
        )
    found = {f"/{f.name}": _file(f.read_bytes(), f.suffix) for f in sorted(folder.iterdir()) if f.suffix in _TYPES}
    found["/"] = found.pop(f"/{_PAGE}")
    return found


def _file(content: bytes, suffix: str) -> Callable[[Request], Response]:
    return lambda _: Response(content, headers={"content-type": _TYPES[suffix]})
