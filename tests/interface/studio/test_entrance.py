"""Who is let in: the studio's own pages and programs of this machine, and no page of anybody else."""

from __future__ import annotations

import http.client
import socket

import pytest

import holdfast as hf
from holdfast.interface.studio import serve
from holdfast.interface.studio.page.access import AccessFilter, is_own_request

viser = pytest.importorskip("viser")


@pytest.mark.parametrize(
    ("host", "origin", "served", "let_in"),
    [
        ("127.0.0.1:8123", "http://127.0.0.1:8123", "127.0.0.1", True),
        ("localhost:8123", "http://localhost:8123", "127.0.0.1", True),
        ("LOCALHOST:8123", "http://localhost:8123", "127.0.0.1", True),
        ("[::1]:8123", "http://[::1]:8123", "localhost", True),
        ("localhost:9000", "http://localhost:9000", "127.0.0.1", True),  # through an ssh tunnel
        ("127.0.0.1:8123", None, "127.0.0.1", True),  # no browser
        ("127.0.0.1:8123", "http://evil.example", "127.0.0.1", False),
        ("127.0.0.1:8123", "http://localhost:3000", "127.0.0.1", False),  # another page of this machine
        ("127.0.0.1:8123", "null", "127.0.0.1", False),  # a file, or a frame without rights
        ("127.0.0.1:8123", "http://127.0.0.1:8123.evil.example", "127.0.0.1", False),
        ("evil.example:8123", "http://evil.example:8123", "127.0.0.1", False),  # DNS rebinding
        ("evil.example:8123", None, "127.0.0.1", False),
        ("192.0.2.7:8123", "http://192.0.2.7:8123", "127.0.0.1", False),
        ("192.0.2.7:8123", "http://192.0.2.7:8123", "0.0.0.0", True),
        ("evil.example:8123", "http://evil.example:8123", "0.0.0.0", False),
        ("robot.example:8123", "http://robot.example:8123", "robot.example", True),
        (f"{socket.gethostname()}:8123", None, "0.0.0.0", True),
        ("a@127.0.0.1:8123", "http://a@127.0.0.1:8123", "127.0.0.1", False),
        ("", None, "127.0.0.1", False),
        (None, None, "127.0.0.1", False),
        ("[::1:8123", None, "127.0.0.1", False),
    ],
)
def test_who_is_welcome(host, origin, served, let_in):
    assert is_own_request([] if host is None else [host], [] if origin is None else [origin], served) is let_in


def test_a_header_that_is_there_twice_is_no_header():
    host, origin = "127.0.0.1:8123", "http://127.0.0.1:8123"
    assert is_own_request([host], [origin], "127.0.0.1")
    assert not is_own_request([host, host], [origin], "127.0.0.1")
    assert not is_own_request([host], [origin, origin], "127.0.0.1")


def test_pages_of_others_are_refused_and_its_own_are_not():
    from websockets.exceptions import InvalidStatus
    from websockets.sync.client import connect

    def opened(origin, host=None):
        headers = {} if host is None else {"Host": host}
        with connect(
            f"ws://127.0.0.1:{page.port}",
            origin=origin,
            additional_headers=headers,
            subprotocols=[f"viser-v{viser.__version__}"],
            proxy=None,
            max_size=None,
        ) as client:
            return len(client.recv(timeout=20)) > 0

    def asked(**headers):
        connection = http.client.HTTPConnection("127.0.0.1", page.port, timeout=20)
        connection.request("GET", "/", headers=headers)
        answer = connection.getresponse()
        found = answer.status, answer.read()
        connection.close()
        return found

    with serve(hf.arms.load("planar-3r"), port=0) as page:
        own = f"127.0.0.1:{page.port}"
        assert opened(f"http://{own}")
        assert opened(None)
        for origin in ("http://evil.example", f"http://localhost:{page.port}", "null", f"https://{own}.evil.example"):
            with pytest.raises(InvalidStatus) as refused:
                opened(origin)
            assert refused.value.response.status_code == 403
        assert asked(Host="evil.example")[0] == 403
        assert asked(Host=own, Origin="http://evil.example")[0] == 403
        status, content = asked(Host=own)
        assert status == 200
        assert content.count(b"<title>") == content.count(b"<title>holdfast studio</title>") == 1
        assert b"holdfast-legend" in content
        status, packed = asked(**{"Host": own, "Accept-Encoding": "gzip"})
        assert status == 200
        assert len(packed) < len(content)


def test_a_server_that_does_not_ask_is_not_served():
    with (
        pytest.raises(hf.HoldfastError, match="cannot reject requests of other web pages"),
        AccessFilter("127.0.0.1").filter_requests(),
    ):
        pass
