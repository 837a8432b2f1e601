"""Who is let in: hosts, origins, token and key; what is handed out; what never is."""

import asyncio
import http.client
import json
import socket
from types import SimpleNamespace

import pytest
import uvicorn
from serve_program import KEY
from starlette.responses import PlainTextResponse
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

import holdfast as hf
from holdfast.teleop.records.records import Records
from holdfast.teleop.serve.app import ServerOptions, make_app, open_or_create, serve_experiment
from holdfast.teleop.serve.guard import FailedAttempts, Guard, GuardedApp, RateLimiter, check_token

TOKEN = "token-of-the-experiment"


class Asker:
    """Asks a server, with the headers that it is told."""

    def __init__(self, port):
        self.port = port

    def ask(self, method, path, headers=None):
        said = {"Host": f"localhost:{self.port}"} | {k.title(): v for k, v in (headers or {}).items()}
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=30)
        try:
            connection.putrequest(method, path, skip_host=True)
            for name, value in said.items():
                connection.putheader(name, value)
            connection.endheaders()
            answer = connection.getresponse()
            text = answer.read().decode()
        finally:
            connection.close()
        headers = {k.lower(): v for k, v in answer.getheaders()}
        return SimpleNamespace(status_code=answer.status, headers=headers, text=text)

    def get(self, path, headers=None):
        return self.ask("GET", path, headers)

    def post(self, path, headers=None):
        return self.ask("POST", path, headers)

    def connects(self, path, origin=None):
        """Whether a WebSocket is let in."""
        try:
            with connect(f"ws://localhost:{self.port}{path}", origin=origin, proxy=None):
                return True
        except InvalidStatus as error:
            return error.response.status_code != 403


@pytest.fixture(scope="module")
def served(server, start, tmp_path_factory):
    """A server for this computer only, and one with a token."""
    other = start(tmp_path_factory.mktemp("guarded") / "experiment", TOKEN)
    return SimpleNamespace(local=Asker(server.port), other=Asker(other.port), folder=server.folder)


def test_what_is_handed_out(served, protocol):
    page = served.local.get("/")
    assert page.status_code == 200
    assert page.headers["content-type"].startswith("text/html")
    policy = page.headers["content-security-policy"]
    assert "default-src 'self'" in policy
    assert f"connect-src 'self' ws://localhost:{served.local.port} wss://localhost:{served.local.port}" in policy
    assert "unsafe" not in policy
    assert page.headers["x-content-type-options"] == "nosniff"
    assert page.headers["referrer-policy"] == "no-referrer"
    assert page.headers["cache-control"] == "no-store"
    assert served.local.get("/station.js").headers["content-type"].startswith("text/javascript")
    assert "export function cycle" in served.local.get("/arm.js").text
    experiment = json.loads(served.local.get("/experiment.json").text)
    assert (experiment["joints"], experiment["axes"], experiment["cycle_limit"]) == (3, 2, 40)
    assert experiment["texts"]["title"] == "Welcome"
    assert KEY not in str(experiment)


@pytest.mark.parametrize(
    "path",
    [
        "/../pyproject.toml", "/..%2f..%2fetc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/station.js/../index.html", "//etc/passwd",
        "/static/index.html", "/index.html", "/records.sqlite", "/protocol.yaml", "/station.js%00", "/station.js/", "/.", "/..",
        "/\\..\\x", "/experimenter.html", "/en.yaml", "/texts/en.yaml", "/file:///etc/passwd", "/STATION.JS",
    ],
)  # fmt: skip
def test_no_path_reaches_the_file_system(server, path):
    """As it is written, past every client that tidies it up."""
    request = f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nConnection: close\r\n\r\n"
    with socket.create_connection(("127.0.0.1", server.port), timeout=30) as raw:
        raw.sendall(request.encode())
        answer = b"".join(iter(lambda: raw.recv(65536), b""))
    assert answer.split()[1] in (b"404", b"400"), answer[:200]
    assert b"root:" not in answer


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:8000", "localhost.evil.example", "127.0.0.1.evil.example", "a b", ""]
)
def test_other_hosts_are_refused(served, host):
    assert served.local.get("/", headers={"host": host}).status_code == 403


@pytest.mark.parametrize("host", ["127.0.0.1", "127.0.0.1:8000", "localhost:9", "[::1]:8000"])
def test_this_computer_has_these_names(served, host):
    assert served.local.get("/", headers={"host": host}).status_code == 200


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "null", "http://localhost:8001", "https://localhost", "file://", "http://["]
)
def test_pages_of_other_hosts_are_refused(served, origin):
    assert served.local.get("/experiment.json", headers={"origin": origin}).status_code == 403
    assert not served.local.connects("/session", origin=origin)


def test_the_page_itself_is_let_in(served):
    assert served.local.connects("/session", origin=f"http://localhost:{served.local.port}")
    assert served.local.connects("/session")  # no browser


def test_a_token_is_asked_for(served):
    other = served.other
    for path in ("/", "/experiment.json", "/arm.js", "/?token=", "/?token=wrong", "/?token=" + TOKEN[:-1], "/?Token=" + TOKEN):
        answer = other.get(path)
        assert answer.status_code == 403
        assert "token is missing or wrong" in answer.text
        assert TOKEN not in answer.text
    assert not other.connects("/session")
    assert not other.connects("/session?token=wrong")
    assert other.get(f"/experiment.json?token={TOKEN}").status_code == 200
    assert other.get(f"/experiment.json?key={KEY}").status_code == 200
    assert other.connects(f"/session?token={TOKEN}")
    answer = other.get(f"/?token={TOKEN}", headers={"host": "lab.example"})
    cookie = answer.headers["set-cookie"]
    assert "HttpOnly" in cookie
    assert "SameSite=Strict" in cookie
    assert other.get("/experiment.json", headers={"cookie": cookie.split(";")[0], "host": "lab.example"}).status_code == 200
    assert other.get("/experiment.json", headers={"cookie": "holdfast=\x07;;=", "host": "lab.example"}).status_code == 403


@pytest.mark.parametrize(
    "path", ["/experimenter", "/experimenter/subjects.json", "/experimenter?key=wrong", "/experimenter?key="]
)
def test_the_experimenter_has_a_key(served, path):
    for client in (served.local, served.other):
        answer = client.get(path)
        assert answer.status_code == 403
        assert "key is missing or wrong" in answer.text
    assert not served.local.connects("/live")
    assert served.other.get(f"/experimenter?token={TOKEN}").status_code == 403
    assert "set-cookie" not in served.local.get(f"/experimenter?key={KEY}").headers  # a subject may sit there next


def test_odd_requests(served):
    many = "&".join(f"a{k}=1" for k in range(100))
    assert served.other.get(f"/experiment.json?{many}&token={TOKEN}").status_code == 403
    assert served.local.post("/experiment.json").status_code == 405
    assert served.local.get("/session").status_code == 404
    assert served.local.post("/", headers={"sec-fetch-site": "cross-site"}).status_code == 403


def test_tokens_that_can_be_guessed_are_refused():
    for token in ("4d1e07a9c2b8", "9f8b2c61d04e7a35c1f0e8d27b96a413", "k3vR-9fQzT1m"):
        check_token(token)
    weak = "aaaaaaaaaaaa abcdefghijkl 0123456789ab 9876543210-zyx x1-yx1-yx1-y password1234 holdfast-token"
    for token in weak.split():
        with pytest.raises(hf.InputError, match="easily guessed"):
            check_token(token)
    for token in ("", "short", "with space here", "a/b/c/d/e/f/g/h", "x" * 129, "äöüäöüäöüäöüäöü"):
        with pytest.raises(hf.InputError, match="token"):
            check_token(token)


def test_wrong_secrets_are_counted_and_right_ones_always_pass(start, tmp_path):
    """After two hundred wrong ones an address is told to wait, whatever it claims to be."""
    asker = Asker(start(tmp_path / "experiment", TOKEN).port)
    assert [asker.get(f"/?token=wrong-{k}").status_code for k in range(200)] == [403] * 200
    forged = [{}, {"x-forwarded-for": "203.0.113.7"}, {"forwarded": "for=203.0.113.8"}, {"x-real-ip": "203.0.113.9"}]
    asked = [asker.get("/experimenter?key=wrong", headers=forged[k % 4]).status_code for k in range(8)]
    assert asked[-4:] == [429] * 4
    assert asker.get(f"/experimenter?key={KEY}").status_code == 200
    assert asker.get(f"/?token={TOKEN}").status_code == 200
    assert asker.connects(f"/session?token={TOKEN}")


@pytest.mark.parametrize("site", ["cross-site", "same-site"])
@pytest.mark.parametrize("mode", ["no-cors", "cors", "navigate"])
def test_pages_of_other_servers_use_up_no_attempts(site, mode):
    """The headers are those that a browser sends for an image, a script, a frame, and a link of another page."""
    guarded = GuardedApp(answer_here, Guard(token=TOKEN, key=KEY))
    for dest in ("image", "iframe", "document"):
        said = {"sec-fetch-site": site, "sec-fetch-mode": mode, "sec-fetch-dest": dest}
        assert {asked(guarded, f"key=wrong-{k}", said) for k in range(300)} == {403}
        follows_link = mode == "navigate" and dest == "document"
        assert asked(guarded, f"key={KEY}", said) == (200 if follows_link else 403)
    assert [asked(guarded, f"key=wrong-{k}", {}) for k in range(220)][-1] == 429
    assert asked(guarded, f"key={KEY}", {}) == 200


async def answer_here(scope, receive, send):
    await PlainTextResponse("here")(scope, receive, send)


def asked(app, query, headers):
    """The status with which an application answers the experimenter's browser."""
    sent = []

    async def send(message):
        sent.append(message)

    said = [(b"host", b"localhost:8000"), *((k.encode(), v.encode()) for k, v in headers.items())]
    scope = {"type": "http", "method": "GET", "path": "/experimenter", "query_string": query.encode(), "headers": said}
    asyncio.run(app({**scope, "client": ("127.0.0.1", 4)}, None, send))
    return sent[0]["status"]


def test_a_proxy_is_believed_only_if_asked_for(built, protocol, tmp_path, monkeypatch):
    configured = []
    monkeypatch.setattr(uvicorn.Server, "run", lambda self, sockets: configured.append(self.config))
    Records.create(tmp_path / "experiment", protocol).close()
    for behind_proxy in (False, True):
        serve_experiment(
            ServerOptions(tmp_path / "experiment", static=built[0], english=built[1], behind_proxy=behind_proxy), port=0
        )
    assert [config.proxy_headers for config in configured] == [False, True]


def test_wrong_tokens_are_counted_by_address():
    now = [0.0]
    wrong = FailedAttempts(lambda: now[0])
    for _ in range(201):
        assert not wrong.has_too_many_failures("a")
        wrong.count_attempt("a")
    assert wrong.has_too_many_failures("a")
    assert not wrong.has_too_many_failures("b")
    now[0] = 1.1
    assert not wrong.has_too_many_failures("a")
    wrong.count_attempt("a")
    assert wrong.has_too_many_failures("a")
    for k in range(3000):
        wrong.count_attempt(str(k))
    assert len(wrong._limiters) <= 1024


def test_keys_are_made_anew():
    assert Guard().key != Guard().key
    assert len(Guard().key) >= 24


def test_bucket():
    now = [0.0]
    bucket = RateLimiter(rate=10, burst=5, clock=lambda: now[0])
    assert [bucket.reserve_and_get_wait() for _ in range(5)] == [0.0] * 5
    assert bucket.reserve_and_get_wait() == pytest.approx(0.1)
    now[0] = 100.0
    assert [bucket.reserve_and_get_wait() for _ in range(5)] == [0.0] * 5
    assert bucket.reserve_and_get_wait() > 0


def test_an_experiment_is_begun_or_opened(protocol, tmp_path):
    file = protocol.write(tmp_path / "p.yaml")
    assert open_or_create(tmp_path / "experiment", str(file)).to_yaml() == protocol.to_yaml()
    assert open_or_create(tmp_path / "experiment", None).to_yaml() == protocol.to_yaml()
    assert open_or_create(tmp_path / "experiment", str(file)).to_yaml() == protocol.to_yaml()
    with pytest.raises(hf.InputError, match="another protocol"):
        open_or_create(tmp_path / "experiment", "goel2003")
    with pytest.raises(hf.StoreError, match="not an empty folder"):
        open_or_create(tmp_path, None)


def test_a_missing_page_is_one_sentence(built, served, tmp_path):
    with pytest.raises(hf.StoreError, match="the built page is not in this installation"):
        make_app(ServerOptions(served.folder, static=tmp_path, english=built[1]))


def test_a_server_that_cannot_run_begins_no_experiment(built, tmp_path):
    """The port is taken, the page is missing, or the translation cannot be used."""
    folder = tmp_path / "experiment"
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        with pytest.raises(hf.StoreError, match="cannot listen"):
            serve_experiment(ServerOptions(folder, static=built[0], english=built[1]), port=taken.getsockname()[1])
    with pytest.raises(hf.StoreError, match="built page"):
        serve_experiment(ServerOptions(folder, static=tmp_path, english=built[1]), port=0)
    with pytest.raises(hf.HoldfastError):
        serve_experiment(ServerOptions(folder, texts=tmp_path / "none.yaml", static=built[0], english=built[1]), port=0)
    assert not folder.exists()
