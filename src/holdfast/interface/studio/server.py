"""Local server of the studio: the page of an arm, and answers to the questions that the page asks."""

from __future__ import annotations

import hmac
import ipaddress
import json
import select
import socket
import sys
import threading
import traceback
from collections.abc import Callable, Sequence
from contextlib import suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from secrets import token_urlsafe
from socketserver import TCPServer
from typing import Any, cast

from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.files.hosts import is_loopback_host, request_rejection_reason
from holdfast.interface.presentation.arm_page.build import build_studio_page
from holdfast.interface.studio import upload
from holdfast.interface.studio.answers import LONG_QUESTIONS, QUICK_ANSWERS, Request, ServedArm
from holdfast.interface.studio.machine import CompiledArm, describe_error
from holdfast.interface.studio.state import State
from holdfast.interface.studio.worker_process import Cancelled
from holdfast.model.arm.model import Arm
from holdfast.model.arm.postures import generic_configuration
from holdfast.model.arm.task import Task, as_task
from holdfast.model.arms.spec import default_task
from holdfast.model.cell.cell import Cell

LOOPBACK_HOST = "127.0.0.1"
DEFAULT_PORT = 8123
MAX_BODY_BYTES = 6 << 20  # of a question: a file of 4 MiB in base64, and a view
MAX_UPLOADED_ARMS = 8  # arms that visitors opened; a further one replaces the oldest
_MAX_DISCARDED_BYTES = 64 << 20  # of a body that is too large; a browser reads the refusal only after it has sent the body
_SOCKET_TIMEOUT_S = 30.0  # longest silence of a client in the middle of a request
_SECURITY_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Content-Security-Policy": "frame-ancestors 'none'",
    "Cache-Control": "no-store",
}


class Studio:
    """Running studio server.

    Args:
        arm: Arm to serve.
        host: Address on which the server listens.
        port: Port on which it listens; 0: any free port.

    Attributes:
        url: URL of the server.
        host: Address on which it listens.
        port: Port on which it listens.
    """

    def __init__(self, arm: ServedArm, host: str, port: int) -> None:
        self.host, self._token = host, token_urlsafe(32)
        self._arms: dict[str, ServedArm] = {"": arm}  # by the number of an uploaded arm; empty for the arm of the studio
        self._pages: dict[str, bytes] = {}
        self._uploads, self._lock, self._stopped = 0, threading.RLock(), threading.Event()
        self._server = _start_server(self, host, port)
        self.port = int(self._server.server_address[1])
        self.url = f"http://{f'[{host}]' if ':' in host else host}:{self.port}"

    def find_arm(self, number: str) -> ServedArm | None:
        """Return the arm with a number, which is empty for the arm of the studio; None if it is not served."""
        return self._arms.get(number)

    def page(self, number: str) -> bytes:
        """Return the page of an arm, which is built once."""
        with self._lock:
            if number not in self._pages:
                self._pages[number] = self._build_page(self._arms[number])
            return self._pages[number]

    def _build_page(self, served: ServedArm, mesh_files: bool = True) -> bytes:
        machine, state = served.machine, served.state
        data = served.page_data(self._token)
        page = build_studio_page(machine.arm, state.q, machine.task, data, cell=machine.cell, mesh_files=mesh_files)
        return page.text.encode()

    def open_arm(self, name: str, content: bytes) -> str:
        """Open the arm of an uploaded file, and return the address of its page.

        Raises:
            HoldfastError: The file is not an arm that can be shown.
        """
        with upload.open_uploaded_arm(name, content) as (machine, state):
            served = ServedArm(machine, state)
            page = self._build_page(served, mesh_files=False)
        with self._lock:
            self._uploads += 1
            number = str(self._uploads)
            self._arms[number], self._pages[number] = served, page
            for oldest in list(self._arms)[1:-MAX_UPLOADED_ARMS]:
                self._pages.pop(oldest)
                self._arms.pop(oldest).worker_process.stop()
        return f"/arm/{number}/"

    def is_token(self, token: str) -> bool:
        """Return True for the token of the pages of this server."""
        return hmac.compare_digest(token.encode(), self._token.encode())

    def wait(self) -> None:
        """Wait until :meth:`stop` is called or the program is interrupted."""
        self._stopped.wait()

    def stop(self) -> None:
        """Stop the server and its computations."""
        self._server.shutdown()
        self._server.server_close()
        for served in self._arms.values():
            served.worker_process.stop()
        self._stopped.set()

    def __enter__(self) -> Studio:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()


def serve(
    arm: Arm,
    state: State | None = None,
    host: str = LOOPBACK_HOST,
    *,
    port: int = DEFAULT_PORT,
    task: Task | None = None,
    cell: Cell | None = None,
    ready: Callable[[str], None] = lambda url: None,
) -> Studio:
    """Open the studio of an arm and serve it until :meth:`Studio.stop`.

    Each open page has its own arm, which begins with ``state``. The studio sends no request to any other host.

    Args:
        arm: Arm to show.
        state: Initial state. Default: all joints healthy, in a generic configuration.
        host: Address on which the server listens. It answers only pages that it has served, but everyone who reaches the
            address can open such a page. Therefore, use another address than the loopback address only in a trusted network.
        port: Port on which the server listens; 0: any free port.
        task: Task, if its name in ``state`` does not determine it.
        cell: Objects around the arm, which can be dragged. None: no objects.
        ready: Function that is called with the URL as soon as a browser may open it; the page is built while the browser loads.

    Raises:
        InputError: The port is in use, the host is not an address of this machine, or the arm's base touches an object.
        TaskError: The task does not fit the arm.
    """
    if state is None:
        q = tuple(float(value) for value in generic_configuration(arm))
        state = State(arm.name, arm.joint_names, q, task=default_task(arm.name, arm))
    machine = CompiledArm(arm, task or as_task(arm, state.task), cell)
    machine.get_clearance(state.moved)  # raises errors of the cell before a page is open
    served = ServedArm(machine, state)
    studio = Studio(served, host, port)
    ready(studio.url)

    def prepare_first_view() -> None:
        with suppress(HoldfastError):  # the page reports it
            studio.page("")
            QUICK_ANSWERS["reading"](served, Request(state))

    threading.Thread(target=prepare_first_view, daemon=True, name="studio warm-up").start()
    return studio


def is_own_request(hosts: Sequence[str], origins: Sequence[str], served: str) -> bool:
    """Return True if a request addresses this studio and comes from one of its pages or from no page.

    :mod:`holdfast.core.files.hosts` defines the rule.

    Args:
        hosts: ``Host`` headers of the request.
        origins: ``Origin`` headers of the request.
        served: Address on which the studio listens, as given by the user.
    """
    return request_rejection_reason(hosts, origins, lambda name: _is_safe_host_name(name, served)) is None


def _is_safe_host_name(name: str, served: str) -> bool:
    """Return True if no other page can have this host name, because it is an address or this machine's own name."""
    if name in ("localhost", served.lower()):
        return True
    is_exposed = not is_loopback_host(served.lower())
    try:
        return ipaddress.ip_address(name).is_loopback or is_exposed
    except ValueError:
        return is_exposed and name in (socket.gethostname().lower(), f"{socket.gethostname()}.local".lower())


class _StudioServer(ThreadingHTTPServer):
    """Server that answers each request in its own thread."""

    daemon_threads = True
    request_queue_size = 32
    studio: Studio

    def server_bind(self) -> None:
        TCPServer.server_bind(self)  # without the look-up of the host's name, which can take seconds

    def handle_error(self, request: Any, client_address: Any) -> None:
        if not isinstance(sys.exception(), ConnectionError | TimeoutError):  # the visitor has closed the page
            super().handle_error(request, client_address)


class _StudioServer6(_StudioServer):
    """Server on an address of IPv6."""

    address_family = socket.AF_INET6


def _start_server(studio: Studio, host: str, port: int) -> _StudioServer:
    """Start a server in its own thread.

    Raises:
        InputError: The port is in use or invalid, or the host is not an address of this machine.
    """
    if not 0 <= port <= 65535:
        raise InputError(f"port {port} is not a port; give a number from 0 (any that is free) to 65535")
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        server = (_StudioServer6 if family == socket.AF_INET6 else _StudioServer)((host, port), _Handler)
    except socket.gaierror as error:
        raise InputError(f"host '{host}' is not known; give an address of this machine, such as {LOOPBACK_HOST}") from error
    except OSError as error:
        raise InputError(
            f"port {port} of {host} cannot be used ({error.strerror or error}); choose another with --port, or 0 for any"
        ) from error
    server.studio = studio
    threading.Thread(target=server.serve_forever, args=(0.1,), daemon=True, name="studio server").start()
    return server


class _Handler(BaseHTTPRequestHandler):
    """Handler of one request; its connection closes after the answer."""

    server_version, sys_version = "holdfast", ""
    timeout = _SOCKET_TIMEOUT_S
    _has_begun = False  # the status was sent, and lines of the answer may follow

    @property
    def _studio(self) -> Studio:
        return cast(_StudioServer, self.server).studio

    def log_message(self, format: str, *args: Any) -> None:
        del format, args

    # ---- pages ------------------------------------------------------------------------------------------------------

    def do_GET(self) -> None:
        """Send the page of an arm."""
        number, rest = self._split_path()
        if self._refuse_stranger() or self._refuse_unknown(number, rest in ("", "index.html")):
            return
        try:
            self._send(200, "text/html; charset=utf-8", self._studio.page(number))
        except HoldfastError as error:
            self._send(500, "text/plain; charset=utf-8", f"{describe_error(error)}\n".encode())

    def _split_path(self) -> tuple[str, str]:
        """Return the number of the arm, which is empty for the arm of the studio, and the rest of the path."""
        path = self.path.partition("?")[0].removeprefix("/")
        if not path.startswith("arm/"):
            return "", path
        number, _, rest = path.removeprefix("arm/").partition("/")
        return number or "none", rest

    def _refuse_stranger(self) -> bool:
        hosts, origins = (self.headers.get_all(name, []) for name in ("Host", "Origin"))
        if is_own_request(hosts, origins, self._studio.host):
            return False
        self._send_error(
            403, "Refused: this studio answers only to pages that it has served itself; open the address that it printed."
        )
        return True

    def _refuse_unknown(self, number: str, is_known: bool) -> bool:
        if is_known and self._studio.find_arm(number) is not None:
            return False
        self._send_error(404, "There is no such page or question; open the address that the studio printed, or the file again.")
        return True

    # ---- questions --------------------------------------------------------------------------------------------------

    def do_POST(self) -> None:
        """Answer a question with lines of JSON: progress, then an answer or an error."""
        number, rest = self._split_path()
        question = rest.removeprefix("answer/")
        length = self.headers.get("Content-Length", "")
        body_length = int(length) if length.isascii() and length.isdigit() and len(length) < 16 else -1
        # The body is read in any case, because a client that still sends does not read the refusal.
        body = self._read_body(body_length)
        if self._refuse_stranger():
            return
        if not self._studio.is_token(self.headers.get("X-Token", "")):
            self._send_error(403, "This page was served by an earlier studio; load it again.")
        elif body_length < 0 or body_length > MAX_BODY_BYTES:
            self._send_error(413, f"The question is too large; at most {MAX_BODY_BYTES >> 20} MiB can be sent.")
        elif not self._refuse_unknown(number, rest.startswith("answer/") and question in {*QUICK_ANSWERS, *LONG_QUESTIONS}):
            served = self._studio.find_arm(number)
            assert served is not None
            self._answer(served, question, body)

    def _read_body(self, length: int) -> bytes:
        """Return the body of an admissible length, or discard it."""
        if length <= MAX_BODY_BYTES:
            return self.rfile.read(max(length, 0))
        remaining = min(length, _MAX_DISCARDED_BYTES)
        while remaining > 0 and self.rfile.read(min(remaining, 1 << 20)):
            remaining -= 1 << 20
        return b""

    def _answer(self, served: ServedArm, question: str, body: bytes) -> None:
        try:
            request = served.read_request(body)
            if question in LONG_QUESTIONS:
                answer = served.worker_process.run(question, request.state, self._check_connection, self._send_progress)
            elif question == "open" and request.file is not None and upload.detect_file_kind(request.file.name) == "arm":
                answer = {"address": self._open_arm(request.file.name, request.file.content)}
            else:
                answer = QUICK_ANSWERS[question](served, request)
        except (Cancelled, OSError):
            return
        except HoldfastError as error:
            self._send_error(400, describe_error(error))
        except Exception as error:
            traceback.print_exception(error)
            self._send_error(500, describe_error(error))
        else:
            self._send_line({"answer": answer})

    def _open_arm(self, name: str, content: bytes) -> str:
        try:
            return self._studio.open_arm(name, content)
        except HoldfastError as error:
            raise InputError(f"the file was not opened, and nothing has changed: {error}") from error

    def _check_connection(self) -> None:
        """Cancel the computation if the visitor has closed the connection."""
        if select.select([self.connection], [], [], 0)[0] and not self.connection.recv(1, socket.MSG_PEEK):
            raise Cancelled

    def _send_progress(self, done: int, total: int) -> None:
        with suppress(OSError):  # the next check of the connection cancels the computation
            self._send_line({"progress": [done, total]})

    # ---- answers ----------------------------------------------------------------------------------------------------

    def _send_error(self, status: int, sentence: str) -> None:
        self._send_line({"error": sentence}, status)

    def _send_line(self, message: dict[str, Any], status: int = 200) -> None:
        """Send a line of JSON; the first one sends the status."""
        content = json.dumps(message, allow_nan=False).encode() + b"\n"
        if self._has_begun:
            self.wfile.write(content)
        else:
            self._has_begun = True
            self._send(status, "application/x-ndjson", content)

    def _send(self, status: int, content_type: str, content: bytes) -> None:
        self.send_response(status)
        for name, value in {"Content-Type": content_type, **_SECURITY_HEADERS}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(content)
