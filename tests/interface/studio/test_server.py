"""Who is answered, what is refused, and that windows do not disturb each other."""

from __future__ import annotations

import json
import re
import socket
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from html.parser import HTMLParser
from urllib.request import urlopen
from xml.etree import ElementTree

import pytest
from studio_requests import Page

import holdfast as hf
from holdfast.interface.report.palette import GREEN, ORANGE
from holdfast.interface.studio import State, answers, compute, serve, server

NAMES = ("a<!--<script>", '"b"', "c</script>")


@pytest.fixture(scope="module")
def studio():
    arm = hf.arms.load("planar-3r")
    with serve(arm, State("planar-3r", arm.joint_names, (0.3, 0.8, 0.9), task="planar"), port=0) as running:
        yield running


@pytest.fixture(scope="module")
def page(studio):
    return Page(studio.url)


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
    assert server.is_own_request([] if host is None else [host], [] if origin is None else [origin], served) is let_in


def test_a_header_that_is_there_twice_is_no_header():
    host, origin = "127.0.0.1:8123", "http://127.0.0.1:8123"
    assert server.is_own_request([host], [origin], "127.0.0.1")
    assert not server.is_own_request([host, host], [origin], "127.0.0.1")
    assert not server.is_own_request([host], [origin, origin], "127.0.0.1")


def test_pages_of_others_are_refused_and_its_own_are_not(page):
    body = {"state": page.state}
    assert page.post("reading", body, Origin=f"http://{page.host}")[0] == 200
    assert page.post("reading", body)[0] == 200
    port = page.host.partition(":")[2]
    for origin in ("http://evil.example", f"http://localhost:{port}", "null", f"https://{page.host}.evil.example"):
        assert page.post("reading", body, Origin=origin)[0] == 403
        assert page.request("GET", "/", Origin=origin)[0] == 403
    status, messages = page.post("reading", body, Host="evil.example")
    assert status == 403
    assert page.token not in json.dumps(messages)
    assert page.request("GET", "/", Host="evil.example")[0] == 403


@pytest.mark.parametrize("token", ["", "x", "\xfc"])
def test_who_has_no_token_asks_in_vain(page, token):
    status, messages = page.post("reading", {"state": page.state}, X_Token=token)
    assert status == 403
    assert "load it again" in messages[0]["error"]


def test_the_page_may_ask_its_server_and_nobody_else(page):
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page.html)[1]
    assert "default-src 'none'" in policy
    assert "connect-src 'self'" in policy
    assert "unsafe-eval" not in policy
    assert "http:" not in policy
    assert page.headers["Content-Security-Policy"] == "frame-ancestors 'none'"
    assert page.headers["X-Content-Type-Options"] == "nosniff"
    assert page.headers["Cache-Control"] == "no-store"
    assert not re.search(r'(?:src|href)="(?!#|data:)', page.html)


@pytest.mark.parametrize("path", ["/favicon.ico", "/arm/1/", "/arm//", "/arm/1", "/../etc/passwd", "/answer/reading", "/%2e"])
def test_there_is_nothing_else_to_get(page, path):
    assert page.request("GET", path)[0] == 404
    assert page.request("PUT", path)[0] == 501


@pytest.mark.parametrize("question", ["", "everything", "reading/", "../reading", "__init__"])
def test_there_is_nothing_else_to_ask(page, question):
    assert page.post(question, {"state": page.state})[0] == 404


def test_what_is_too_large_is_not_kept(page):
    limit = server.MAX_BODY_BYTES
    assert 4 / 3 * (4 << 20) < limit <= 6 << 20
    status, messages = page.post("reading", b" " * (limit + 1))
    assert status == 413
    assert "at most 6 MiB" in messages[0]["error"]
    for length in ("-1", "x", "1e3", "9" * 30, ""):
        assert page.request("POST", "/answer/reading", None, X_Token=page.token, Content_Length=length)[0] == 413


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"names": ["a", "b"]}, "q has 3 values"),
        ({"names": list("abc")}, "load the page again"),
        ({"q": [1, 2]}, "it must have 3"),
        ({"q": [1, 2, "3"]}, "state.q.2 cannot be read"),
        ({"q": [1, 2, 1e999]}, "infinite or not a number"),
        ({"q": None}, "state.q cannot be read"),
        ({"conditions": ["healthy", "broken", "free"]}, "state.conditions.1 cannot be read"),
        ({"index": "os:system"}, "index is 'os:system'; choose one of relative-manipulability"),
        ({"objective": "../x:f"}, "choose one of"),
        ({"laws": ["pseudoinverse", "magic"]}, "law is 'magic'; choose one of pseudoinverse"),
        ({"laws": ["pseudoinverse"]}, "state.laws.1 cannot be read"),
        ({"target": [1, 2, 3]}, "target has the numbers"),
        ({"target": [1, 2, 3, 0, 0, 0, 0]}, "other than 0"),
        ({"fault": ["locked", "nobody", 1]}, "joint of the fault is 'nobody'"),
        ({"fault": ["locked", "joint1", 1e9]}, "choose a time from 0 to 4 s"),
        ({"region": "/etc"}, "from the command line only"),
        ({"show": "everything"}, "state.show cannot be read"),
        ({"friction": "much"}, "state.friction cannot be read"),
    ],
)
def test_impossible_questions_are_one_sentence(page, change, sentence):
    content = json.dumps({"state": page.state | change}).replace("Infinity", "1e999").encode()
    status, messages = page.post("reading", content)
    assert status == 400
    assert sentence.lower() in messages[0]["error"].lower()
    assert "\n" not in messages[0]["error"]


@pytest.mark.parametrize("body", [b"", b"{", b"[]", b"null", b"\xff", b'{"state": 1}', b"[" * 10_000])
def test_noise_is_one_sentence(page, body):
    status, messages = page.post("reading", body)
    assert status == 400
    assert len(messages) == 1
    assert "cannot be read" in messages[0]["error"]


def test_the_worker_has_a_job_for_each_long_question():
    assert set(answers.LONG_QUESTIONS) == set(compute.JOB_FUNCTIONS)


def test_two_windows_have_their_own_views(studio):
    first, second = Page(studio.url), Page(studio.url)
    locked = first.ask("reading", q=[0.1, 0.2, 0.3], conditions=["locked", "healthy", "healthy"])
    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(lambda k: second.ask("reading", q=[0.1 * k, 0.8, 0.9]), range(8)))
    rho = hf.indices.relative_manipulability(hf.arms.load("planar-3r"), "planar")
    for k, reading in enumerate(found):
        assert reading["index"]["values"] == rho.by_joint([0.1 * k, 0.8, 0.9]).tolist()
        assert "--lock" not in reading["command"]
    assert "--lock=joint1" in locked["command"]
    jobs = [(first, "best-worst"), (second, "region"), (first, "fall"), (second, "best-worst")]
    with ThreadPoolExecutor(4) as pool:
        done = list(pool.map(lambda job: job[0].ask(job[1]), jobs))
    assert done[0] == done[3]
    assert len(done[1]["points"]) == 1200
    assert done[2][0]["label"].startswith("power loss")


def test_progress_is_sent_while_the_computation_runs(page):
    status, messages = page.post("region", {"state": page.state})
    assert status == 200
    assert messages[-2] == {"progress": [1200, 1200]}
    assert set(messages[-1]) == {"answer"}


def test_who_leaves_cancels_the_computation(studio, page, monkeypatch):
    process, started, ended = studio.find_arm("").worker_process, threading.Event(), []

    def run(job, state, check, progress):
        progress(0, 1)
        started.set()
        try:
            while True:
                check()
                time.sleep(0.001)
        except BaseException as error:
            ended.append(error)
            raise

    monkeypatch.setattr(process, "run", run)
    body = json.dumps({"state": page.state}).encode()
    with socket.create_connection(page.host.split(":")) as client:
        client.sendall(
            f"POST /answer/best-worst HTTP/1.1\r\nHost: {page.host}\r\nX-Token: {page.token}\r\n"
            f"Content-Length: {len(body)}\r\n\r\n".encode()
            + body
        )
        assert started.wait(30)
        assert b'{"progress": [0, 1]}' in client.recv(4096)
        time.sleep(0.05)
        assert not ended
    deadline = time.monotonic() + 30
    while not ended and time.monotonic() < deadline:
        time.sleep(0.01)
    assert isinstance(ended[0], server.Cancelled)


def test_an_error_of_the_program_is_a_sentence_and_the_server_goes_on(page, monkeypatch, capsys):
    monkeypatch.setattr(hf.Arm, "frames", lambda *_: 1 / 0)
    status, messages = page.post("reading", {"state": page.state})
    assert (status, messages[0]["error"]) == (500, "ZeroDivisionError: division by zero")
    assert "Traceback" in capsys.readouterr().err
    monkeypatch.undo()
    assert page.post("reading", {"state": page.state})[0] == 200


def test_names_from_a_file_do_not_end_the_script(studio):
    rows = [hf.DH(a=1.0, alpha=0.0, name=name) for name in NAMES]
    arm = hf.Arm.from_dh(rows, name="</script><b>")
    with serve(arm, State("x", NAMES, (0.1, 0.2, 0.3), task="planar"), port=0) as running:
        found = Page(running.url)
    assert found.state["names"] == list(NAMES)
    for tag in ("script", "b", "button"):  # as many as on the page of an arm with harmless names
        counts = []
        for page in (found, Page(studio.url)):
            reader, tags = HTMLParser(), []
            reader.handle_starttag = lambda name, _, tags=tags: tags.append(name)
            reader.feed(page.html)
            counts.append(tags.count(tag))
        assert counts[0] == counts[1] > 0


def test_the_address_is_there_before_the_page_is_built(monkeypatch):
    order, real = [], server.build_studio_page
    monkeypatch.setattr(server, "build_studio_page", lambda *a, **b: (order.append("build"), real(*a, **b))[1])

    def ready(url):
        order.append("ready")
        with urlopen(url) as answer:
            order.append((answer.status, b"<html" in answer.read(1000)))

    with serve(hf.arms.load("planar-3r"), port=0, ready=ready) as running:
        assert Page(running.url).data["name"] == "planar-3r"
    assert order == ["ready", "build", (200, True)]


def test_a_stopped_studio_answers_nobody_and_frees_its_port():
    arm = hf.arms.load("planar-3r")
    running = serve(arm, port=0)
    waited = threading.Thread(target=running.wait)
    waited.start()
    page = Page(running.url)
    assert page.ask("best-worst")["values"][0] > 0
    process = running.find_arm("").worker_process._process
    running.stop()
    waited.join(10)
    assert not waited.is_alive()
    assert process.poll() is not None
    with pytest.raises(OSError):  # noqa: PT011
        Page(running.url)
    with serve(arm, port=running.port) as again:
        assert Page(again.url).token != page.token


def test_a_computation_that_runs_ends_with_the_studio():
    running = serve(hf.arms.load("planar-3r"), port=0)
    page, found = Page(running.url), []
    asked = threading.Thread(target=lambda: found.append(page.ask("watch", target=page.ask("reading")["target"])))
    asked.start()
    while running.find_arm("").worker_process._process is None:
        time.sleep(0.01)
    running.stop()
    asked.join(30)
    assert "ended unexpectedly" in found[0] or "was stopped" in found[0]


@pytest.mark.parametrize("host", ["::1", "localhost"])
def test_other_names_of_this_machine(host):
    try:
        running = serve(hf.arms.load("planar-3r"), host=host, port=0)
    except hf.InputError as error:
        pytest.skip(str(error))
    with running:
        assert Page(running.url).ask("reading")["command"].startswith("holdfast studio")


def test_a_drawing_shows_the_arm_its_failures_and_the_ghosts(page):
    ghosts = [[0.1, 0.2, 0.3], [0.3, 0.1, 0.2]]
    alone, with_ghosts = (page.ask("drawing", ghosts=each)["svg"] for each in ([], ghosts))
    for text in (alone, with_ghosts):
        assert ElementTree.fromstring(text).tag == "{http://www.w3.org/2000/svg}svg"
    for color in (GREEN, ORANGE):
        assert (f"stroke: {color}" in alone, f"stroke: {color}" in with_ghosts) == (False, True)
    locked = page.ask("drawing", conditions=["healthy", "locked", "free"])["svg"]
    assert ElementTree.fromstring(locked).get("aria-label") == "planar-3r: joint2 locked, joint3 free"
    assert "at most 3 configurations of 3 values" in page.ask("drawing", ghosts=[[1, 2]])
