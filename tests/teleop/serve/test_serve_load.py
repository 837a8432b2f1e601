"""A small load: nothing is lost. ``load.py`` itself takes minutes and more stations."""

import logging
import socket
import subprocess
import sys
import urllib.request
from contextlib import ExitStack, suppress

from load import load
from silent import attacked

from holdfast.teleop.serve.bounded import Sparing


def test_no_cycle_is_lost(tmp_path):
    figures = load(tmp_path, stations=3, rate=30.0, seconds=2.0)
    assert figures.sent > 0
    assert (figures.lost, figures.differing) == (0, 0)


def test_silent_sockets_cost_the_stations_nothing():
    """A tenth of what 'make soak' opens; what it costs in milliseconds is asked there."""
    seen = attacked(sockets=150, stations=3, rate=30.0, seconds=3.0)
    assert seen.opened >= 150
    assert (seen.lost, seen.log < 100_000) == (0, True)


def served(http, files):
    """Run a server with a protocol on a port of its own, with so many files at most; what a client sees."""
    program = f"""
import asyncio, resource, sys
import uvicorn
from holdfast.teleop.serve import bounded
resource.setrlimit(resource.RLIMIT_NOFILE, ({files}, {files}))
async def app(scope, receive, send):
    await send({{"type": "http.response.start", "status": 200, "headers": []}})
    await send({{"type": "http.response.body", "body": b"here"}})
class Server(uvicorn.Server):
    async def startup(self, sockets=None):
        await super().startup(sockets)
        print(self.servers[0].sockets[0].getsockname()[1], flush=True)
config = uvicorn.Config(app, port=0, http={http}, backlog=8, lifespan="off", log_level="warning", access_log=False)
Server(config).run()
"""
    return subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def test_more_sockets_than_files_let_others_in():
    """The oldest silent socket makes room: the server never runs out of files, and the log says nothing."""
    with served("bounded.protocol(bounded.files() // 2, (30.0, 30.0))", 64) as server, ExitStack() as opened:
        port = int(server.stdout.readline())
        silent = [opened.enter_context(socket.create_connection(("127.0.0.1", port))) for _ in range(150)]
        for each in silent[:5]:
            with suppress(OSError):
                each.sendall(b"GET / HTTP/1.1\r\n")
        assert urllib.request.urlopen(f"http://127.0.0.1:{port}/", timeout=30).read() == b"here"
        server.terminate()
        assert server.communicate(timeout=30)[1] == ""


def test_a_request_that_does_not_end_is_ended():
    with served("bounded.protocol(100, (0.2, 0.3))", 256) as server:
        with socket.create_connection(("127.0.0.1", int(server.stdout.readline()))) as slow:
            slow.sendall(b"GET / HTTP/1.1\r\nHost: x\r\nX: ")
            slow.settimeout(30)
            with suppress(ConnectionResetError):
                assert slow.recv(1) == b""
        server.kill()


def test_a_flood_of_lines_becomes_a_few(caplog):
    now = [0.0]
    log = logging.getLogger("flood")
    log.addFilter(Sparing(lines=3, clock=lambda: now[0]))
    for _ in range(1000):
        log.warning("bad %s", "request")
    now[0] = 61.0
    log.warning("later")
    said = [r.getMessage() for r in caplog.records]
    assert said == ["bad request", "bad request", "bad request (no more lines in this minute)", "later"]
