"""A small load: nothing is lost. ``load.py`` itself takes minutes and more stations."""

import logging
import select
import socket
import subprocess
import sys
import time
import urllib.request
from contextlib import ExitStack, contextmanager, suppress

import pytest
from load import load
from silent import attacked

from holdfast.teleop.serve.bounded import RateLimitedLogFilter


def test_no_cycle_is_lost(tmp_path):
    figures = load(tmp_path, stations=3, rate=30.0, seconds=2.0)
    assert figures.sent > 0
    assert (figures.lost, figures.differing) == (0, 0)


def test_silent_sockets_cost_the_stations_nothing():
    """A tenth of what 'make soak' opens; what it costs in milliseconds is asked there."""
    seen = attacked(sockets=150, stations=3, rate=30.0, seconds=3.0)
    assert seen.opened >= 150
    assert (seen.lost, seen.log < 100_000) == (0, True)


@contextmanager
def served(protocols, files, body='b"here"'):
    """Run a server with HTTP and WebSocket protocols and a maximum number of files; it answers with a body."""
    program = f"""
import asyncio, resource, sys
import uvicorn
from holdfast.teleop.serve import bounded
resource.setrlimit(resource.RLIMIT_NOFILE, ({files}, {files}))
async def app(scope, receive, send):
    if scope["type"] == "websocket":
        await send({{"type": "websocket.accept"}})
        while True:
            await send({{"type": "websocket.send", "bytes": {body}}})
    await send({{"type": "http.response.start", "status": 200, "headers": []}})
    await send({{"type": "http.response.body", "body": {body}}})
class Server(uvicorn.Server):
    async def startup(self, sockets=None):
        await super().startup(sockets)
        print(self.servers[0].sockets[0].getsockname()[1], flush=True)
http, ws = {protocols}
config = uvicorn.Config(app, port=0, http=http, ws=ws, backlog=8, lifespan="off", log_level="warning", access_log=False)
Server(config).run()
"""
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as server:
        try:
            yield server
        finally:
            server.kill()


def test_more_sockets_than_files_let_others_in():
    """The oldest silent socket makes room: the server never runs out of files, and the log says nothing."""
    with (
        served("bounded.make_bounded_protocols(bounded.raise_file_limit() // 2, (30.0, 30.0))", 64) as server,
        ExitStack() as opened,
    ):
        port = int(server.stdout.readline())
        silent = [opened.enter_context(socket.create_connection(("127.0.0.1", port))) for _ in range(150)]
        for each in silent[:5]:
            with suppress(OSError):
                each.sendall(b"GET / HTTP/1.1\r\n")
        assert urllib.request.urlopen(f"http://127.0.0.1:{port}/", timeout=30).read() == b"here"
        server.terminate()
        assert server.communicate(timeout=30)[1] == ""


def test_a_request_that_does_not_end_is_ended():
    with (
        served("bounded.make_bounded_protocols(100, (0.2, 0.3))", 256) as server,
        socket.create_connection(("127.0.0.1", int(server.stdout.readline()))) as slow,
    ):
        slow.sendall(b"GET / HTTP/1.1\r\nHost: x\r\nX: ")
        slow.settimeout(30)
        with suppress(ConnectionResetError):
            assert slow.recv(1) == b""


GET = b"GET / HTTP/1.1\r\nHost: x\r\n"
UPGRADE = (
    GET + b"Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: "
    b"dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
)  # fmt: skip


def is_closed(client):
    """Wait for the end of a connection without reading what it holds."""
    state = select.poll()
    state.register(client, select.POLLRDHUP | select.POLLHUP | select.POLLERR)
    return bool(state.poll(20_000))


@pytest.mark.skipif(not hasattr(select, "POLLRDHUP"), reason="the end of an unread connection is seen on Linux only")
@pytest.mark.parametrize("request_text", [GET + b"\r\n", 200 * (GET + b"\r\n"), UPGRADE], ids=["one", "pipelined", "websocket"])
def test_a_client_that_reads_no_answer_is_closed(request_text):
    """The answer is larger than the buffers of the system, and so it stays in the server's memory."""
    with (
        served("bounded.make_bounded_protocols(100, (0.2, 0.3))", 256, "bytes(2**23)") as server,
        socket.create_connection(("127.0.0.1", int(server.stdout.readline()))) as client,
    ):
        client.sendall(request_text)
        assert is_closed(client)


@pytest.mark.skipif(not hasattr(select, "POLLRDHUP"), reason="the end of an unread connection is seen on Linux only")
def test_unread_answers_take_a_bounded_amount_of_memory():
    """The third client that does not read takes the place of the first one, long before the deadline."""
    with served("bounded.make_bounded_protocols(100, (600.0, 600.0), 2)", 256, "bytes(2**23)") as server, ExitStack() as opened:
        port = int(server.stdout.readline())
        clients = [opened.enter_context(socket.create_connection(("127.0.0.1", port))) for _ in range(3)]
        for client in clients:
            client.sendall(2 * (GET + b"\r\n"))
        assert is_closed(clients[0])


def test_a_slow_reader_gets_the_whole_answer():
    """Several deadlines pass while it reads."""
    with (
        served("bounded.make_bounded_protocols(100, (0.2, 0.2))", 256, "bytes(2**23)") as server,
        socket.create_connection(("127.0.0.1", int(server.stdout.readline())), timeout=30) as client,
    ):
        client.sendall(GET + b"Connection: close\r\n\r\n")
        received = 0
        while part := client.recv(2**18):
            received += len(part)
            time.sleep(0.03)
    assert received > 2**23


def test_a_flood_of_lines_becomes_a_few(caplog):
    now = [0.0]
    log = logging.getLogger("flood")
    log.addFilter(RateLimitedLogFilter(lines=3, clock=lambda: now[0]))
    for _ in range(1000):
        log.warning("bad %s", "request")
    now[0] = 61.0
    log.warning("later")
    said = [r.getMessage() for r in caplog.records]
    assert said == ["bad request", "bad request", "bad request (no more lines in this minute)", "later"]
