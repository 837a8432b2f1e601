"""The experimenter's routes: only with the key, nothing changed by what is wrong, and the records not held up."""

import asyncio
import io
import json
import shutil
import subprocess
import sys
import urllib.error
import urllib.request
import zipfile
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import parse_qs

import numpy as np
import pytest
from serve_program import KEY
from starlette.requests import Request
from station_client import Client
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from conftest import PROGRAM, dump
from holdfast.core.errors import HoldfastError, InputError
from holdfast.teleop.records import tables
from holdfast.teleop.records.entries import SubjectKind, SubjectState, TrialKind
from holdfast.teleop.records.records import Records
from holdfast.teleop.serve import experimenter
from holdfast.teleop.serve import process as apart
from holdfast.teleop.serve.app import STATIC_FOLDER
from holdfast.teleop.serve.texts import ENGLISH_FILE
from holdfast.teleop.trials.recordings import End

TOKEN = "token-of-stations"
GETS = ("", "/subjects.json", "/export.zip", "/report")
POSTS = {
    "/pause": {"subject": None, "paused": True},
    "/note": {"subject": "S01", "note": "x"},
    "/drop": {"subject": "S01"},
    "/resume": {"subject": "S01"},
}
_open = urllib.request.build_opener(urllib.request.ProxyHandler({})).open


@pytest.fixture(scope="module")
def folder(protocol, tmp_path_factory):
    """An experiment with one simulated subject who is done."""
    made = tmp_path_factory.mktemp("made") / "experiment"
    with Records.create(made, protocol) as records:
        give_up(records, records.add_subject(kind=SubjectKind.SIMULATED))
        records.set_state("S01", SubjectState.COMPLETED)
    return made


def give_up(records, subject):
    """Let a subject abort every trial at once."""
    protocol = records.protocol
    for position, (task, scenario) in enumerate(protocol.session_order(subject.row, subject.number).tolist()):
        tasks = protocol.tasks.take(np.array([task]))
        number = records.begin_trial(subject.code, TrialKind.TRIAL, position, scenario=scenario, tasks=tasks, task=task)
        records.finish_trial(number, End.ABORTED, tasks.q0[0])
        records.rate_trial(number, 1)


@pytest.fixture(scope="module")
def http(folder):
    """Address of a server with the real page, which stations need a token for."""
    command = [sys.executable, str(PROGRAM), str(folder), str(STATIC_FOLDER), str(ENGLISH_FILE), TOKEN]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        yield f"http://127.0.0.1:{int(process.stdout.readline())}"
        process.kill()


@pytest.fixture
def station(http, protocol):
    """A station with a new subject, and its code."""
    client = Client(f"{http.replace('http', 'ws')}/session?token={TOKEN}", protocol)
    code = client.connect().subject
    yield client, code
    client.socket.close()


def ask(url, body=None, key=KEY, **headers):
    """(status, text, headers) of a GET, or of a POST with a body."""
    data = None if body is None else body if isinstance(body, bytes) else json.dumps(body).encode()
    query = "" if key is None else f"{'&' if '?' in url else '?'}key={key}"
    request = urllib.request.Request(url + query, data, {"Content-Type": "application/json"} | headers)
    try:
        with _open(request, timeout=300) as answer:
            return answer.status, answer.read(), answer.headers
    except urllib.error.HTTPError as error:
        with error:
            return error.code, error.read(), error.headers


def post(http, what, **body):
    status, said, _ = ask(f"{http}/experimenter/{what}", body)
    assert status == 200, said
    return json.loads(said)


def listed(http, code):
    status, said, _ = ask(f"{http}/experimenter/subjects.json")
    assert status == 200
    return next(s for s in json.loads(said)["subjects"] if s["subject"] == code)


# ---- who may ask -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", [None, "", "x", KEY[:-1], KEY + "x", KEY.upper(), TOKEN, "%00", "%FF"])
def test_nothing_without_the_key(http, folder, key):
    before = dump(folder)
    for path in GETS:
        status, said, _ = ask(f"{http}/experimenter{path}", key=key)
        assert status == 403
        assert b"key is missing or wrong" in said
    for path, body in POSTS.items():
        assert ask(f"{http}/experimenter{path}?token={TOKEN}", body, key)[0] == 403
    query = "" if key is None else f"?key={key}"
    with pytest.raises(InvalidStatus), connect(f"{http.replace('http', 'ws')}/live{query}", proxy=None):
        pass
    assert dump(folder) == before


def test_nothing_for_pages_of_other_hosts(http, folder):
    before = dump(folder)
    for headers in ({"Origin": "http://elsewhere.example"}, {"Origin": "null"}, {"Sec-Fetch-Site": "cross-site"}):
        for path, body in POSTS.items():
            status, said, _ = ask(f"{http}/experimenter{path}", body, **headers)
            assert status == 403
            assert b"another host" in said
    with pytest.raises(InvalidStatus):
        connect(f"{http.replace('http', 'ws')}/live?key={KEY}", proxy=None, origin="http://elsewhere.example")
    assert dump(folder) == before


@pytest.mark.parametrize(
    ("path", "body", "status", "reason"),
    [
        ("pause", {"subject": "nobody", "paused": True}, 400, "there is no subject nobody; there are S01"),
        ("pause", {"subject": None}, 400, "malformed at paused"),
        ("pause", {"subject": None, "paused": 1}, 400, "malformed at paused"),
        ("pause", {"subject": "../etc", "paused": True}, 400, "malformed at subject"),
        ("pause", {"paused": True, "subject": None, "more": 1}, 400, "malformed at more"),
        ("note", {"subject": "nobody", "note": ""}, 400, "there is no subject nobody"),
        ("note", {"subject": "S01", "note": "x" * 10_001}, 400, "malformed at note"),
        ("note", {"subject": "S01", "note": "x" * 70_000}, 413, "more than 65536 bytes"),
        ("drop", {}, 400, "malformed at subject"),
        ("drop", {"subject": None}, 400, "malformed at subject"),
        ("drop", {"subject": "nobody"}, 400, "there is no subject nobody"),
        ("resume", {"subject": "nobody"}, 400, "there is no subject nobody"),
        ("resume", b"{", 400, "malformed"),
        ("resume", b"\xff", 400, "malformed"),
        ("resume", [], 400, "malformed"),
    ],
)
def test_what_is_wrong_changes_nothing(http, folder, path, body, status, reason):
    before = dump(folder)
    got, said, _ = ask(f"{http}/experimenter/{path}", body)
    assert got == status
    assert reason in json.loads(said)["error"]
    assert dump(folder) == before


def test_only_json_is_read(http, folder):
    before = dump(folder)
    for kind in ("text/plain", "application/x-www-form-urlencoded", ""):
        got, said, _ = ask(f"{http}/experimenter/drop", {"subject": "S01"}, **{"Content-Type": kind})
        assert (got, json.loads(said)["error"]) == (415, "the request must be JSON, and say so")
    for path in POSTS:
        assert ask(f"{http}/experimenter{path}")[0] == 405
    assert dump(folder) == before


# ---- what it does ----------------------------------------------------------------------------------------------------------


def test_the_page_comes_with_the_key_only(http):
    status, page, headers = ask(f"{http}/experimenter")
    assert status == 200
    assert b"./experimenter.js" in page
    assert "default-src 'self'" in headers["content-security-policy"]
    assert ask(f"{http}/experimenter.html?token={TOKEN}", key=None)[0] == 404


def test_the_list_of_subjects(http, folder, protocol, station, rng):
    client, code = station
    client.trial("training", 0, rng)
    client.settle()
    status, said, _ = ask(f"{http}/experimenter/subjects.json")
    assert status == 200
    about = json.loads(said)
    assert about["folder"] == str(folder.resolve())
    assert about["station"] == f"{http}/?token={TOKEN}"
    assert about["scenarios"] == [s.label for s in protocol.scenarios]
    assert about["joints"] == list(protocol.arm.joint_names)
    assert about["paused"] is False
    assert about["plan"]["trials"][1]["target"] == protocol.tasks.target[1].tolist()
    first, *_ = about["subjects"]
    whole = len(protocol.tasks) * len(protocol.scenarios)
    assert (first["kind"], first["state"], first["trials"], first["of"]) == ("simulated", "completed", whole, whole)
    mine = listed(http, code)
    shown = [mine[key] for key in ("training", "trials", "connected", "paused", "differing", "note", "row")]
    with Records.open(folder) as records:
        assert shown == [1, 0, True, False, 0, "", records.subject(code).row]


def test_a_trial_that_differs_is_flagged_in_the_list(http, station):
    client, code = station
    client.say("begin", kind="training", position=0)
    q0 = client.welcome.plan.training[0].q0
    client.say("cycles", first=0, time=[0.0], velocity=[[0.05, 0.0]], q=[q0])
    client.say("end", end="aborted", q=q0)  # it stands although it is commanded
    client.settle()
    with connect(f"{http.replace('http', 'ws')}/live?key={KEY}", proxy=None) as socket:
        while True:
            news = json.loads(socket.recv(60))
            if [s["differing"] for s in news["subjects"] if s["subject"] == code] == [1]:
                break


def test_pauses(http, folder, station):
    client, code = station

    def told():
        return client.receive().paused, listed(http, code)["paused"]

    post(http, "pause", subject=code, paused=True)
    assert told() == (True, True)
    post(http, "pause", subject=code, paused=False)
    assert told() == (False, False)
    post(http, "pause", subject=None, paused=True)
    assert told() == (True, True)
    status, said, _ = ask(f"{http}/experimenter/pause", {"subject": code, "paused": False})
    assert (status, json.loads(said)["error"]) == (400, f"all sessions are paused; {code} resumes when all do")
    post(http, "pause", subject=None, paused=False)
    assert told() == (False, False)
    with Records.open(folder) as records:
        kinds = [e["kind"] for e in records.events() if e["subject"] == code]
    assert kinds == ["paused", "goes on"]


def test_a_note(http, folder, station):
    _, code = station
    note = 'She said: "<b>fast</b>"\nTwice. \u2603'
    post(http, "note", subject=code, note=note)
    assert listed(http, code)["note"] == note
    with Records.open(folder) as records:
        assert records.subject(code).note == note


def test_a_session_is_ended(http, folder, protocol, station, rng):
    client, code = station
    client.trial("training", 0, rng)
    client.settle()
    post(http, "drop", subject=code)
    assert "ended by the experimenter" in client.receive().reason
    with pytest.raises(ConnectionClosed):
        client.receive()
    assert listed(http, code)["state"] == "dropped"
    with Records.open(folder) as records:
        assert records.subject(code).state == SubjectState.DROPPED
        assert len(records.entries(code)) == 1
    status, said, _ = ask(f"{http}/experimenter/resume", {"subject": code})
    assert status == 400
    assert "cannot be resumed" in json.loads(said)["error"]


def test_a_session_goes_on_in_another_page(http, protocol, station, rng):
    client, code = station
    client.trial("training", 0, rng)
    client.settle()
    url = post(http, "resume", subject=code)["url"]
    address, _, query = url.partition("?")
    said = parse_qs(query)
    assert (address, said["token"]) == (f"{http}/", [TOKEN])
    assert "robot" in said  # the station is a simulated one
    assert "another page" in client.receive().reason
    other = Client(client.url, protocol)
    (other.key,) = said["session"]
    welcome = other.connect()
    assert (welcome.subject, welcome.seq, welcome.done.training) == (code, client.seq, [None])
    other.socket.close()


def test_live(http, protocol, station, rng):
    client, code = station
    with connect(f"{http.replace('http', 'ws')}/live?key={KEY}", proxy=None) as socket:
        first = json.loads(socket.recv(60))
        assert first["type"] == "subjects"
        assert code in [s["subject"] for s in first["subjects"]]
        path = client.trial("training", 0, rng, cycles=3)
        client.settle()
        cycle, done = None, None
        while cycle is None or done != 1:
            news = json.loads(socket.recv(60))
            if news["type"] == "cycle":
                cycle = cycle or news
            else:
                done = next(s["training"] for s in news["subjects"] if s["subject"] == code)
        task = client.welcome.plan.training[0]
        shown = [cycle[key] for key in ("subject", "kind", "position", "scenario", "target", "healthy", "q0")]
        assert shown == [code, "training", 0, 0, task.target, [1, 1, 1], task.q0]
        assert cycle["q"] == path[cycle["cycle"] - 1].tolist()
        socket.send("anything")
        with pytest.raises(ConnectionClosed) as raised:
            [socket.recv(60) for _ in range(100)]
    assert raised.value.rcvd.code == 1003


def test_the_export_is_that_of_the_records(http, folder, station, rng, tmp_path):
    client, _ = station
    client.trial("training", 0, rng, end=None)  # one is under way
    client.settle()
    status, content, headers = ask(f"{http}/experimenter/export.zip")
    assert status == 200
    assert headers["content-disposition"] == 'attachment; filename="experiment.zip"'
    with Records.open(folder) as records:
        files = tables.export_tables(records, tmp_path)
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        assert archive.testzip() is None
        assert {Path(n) for n in archive.namelist()} == {Path("experiment") / f.name for f in files}
        for file in files:
            assert archive.read(f"experiment/{file.name}") == file.read_bytes(), file.name


# ---- the report ------------------------------------------------------------------------------------------------------------


def report(folder, query=b""):
    """The route without a network."""

    class State:
        control = type("Control", (), {"folder": folder})

    app = type("App", (), {"state": State})
    request = Request({"type": "http", "method": "GET", "headers": [], "query_string": query, "app": app, "path": "/"})
    route = next(r for r in experimenter.make_routes(None or experimenter.Guard(), None) if r.path == "/experimenter/report")
    answer = asyncio.run(route.endpoint(request))
    return answer.status_code, answer.body.decode(), answer.headers


def test_the_report_is_shown_without_scripts(folder, monkeypatch):
    done = []

    async def made(job, experiment, out, missing):
        done.append((job, experiment, missing, out))
        (Path(out) / "report.html").write_text("<p>F(1, 23)</p>")

    monkeypatch.setattr(experimenter, "run_job", made)
    status, page, headers = report(folder, b"missing=mixed")
    assert (status, page) == (200, "<p>F(1, 23)</p>")
    assert "sandbox" in headers["content-security-policy"]
    assert "script-src" not in headers["content-security-policy"]
    ((job, experiment, missing, out),) = done
    assert (job, experiment, missing) == ("report", str(folder), "mixed")
    assert not Path(out).exists()


def test_a_report_that_cannot_be_made_is_a_sentence(http, folder, tmp_path, protocol):
    Records.create(tmp_path / "empty", protocol).close()
    status, said, _ = report(tmp_path / "empty")
    assert status == 400
    assert "there is nothing to analyse.\n" in said
    assert report(folder, b"missing=%00")[1] == "Missing must be one of refuse, complete, mixed.\n"
    status, said, headers = ask(f"{http}/experimenter/report?missing=nothing")
    assert (status, headers["content-type"]) == (400, "text/plain; charset=utf-8")


def test_the_report_is_of_people_where_people_took_part(folder, tmp_path, monkeypatch):
    """And of simulated subjects where there are no others; of those who dropped out it never is."""
    from holdfast.teleop.analysis import computation
    from holdfast.teleop.analysis import eligibility as results

    @dataclass
    class Result:
        subjects: list[str]
        notes: tuple[str, ...] = ("a note",)

        def save(self, out, protocol, paths):
            written.append(self)

    written: list[Result] = []
    monkeypatch.setattr(computation, "analyse", lambda table, *_, **options: Result(sorted(set(table["subject"]))))
    monkeypatch.setattr(results, "computer_table", lambda _: None)
    monkeypatch.setattr(tables, "tool_paths", lambda _: None)
    monkeypatch.setattr(apart.os, "nice", lambda _: 0)
    experiment = tmp_path / "experiment"
    shutil.copytree(folder, experiment)
    with Records.open(experiment) as records:
        programs = [s.code for s in records.subjects() if records.count_trials().get((s.code, TrialKind.TRIAL))]
    assert apart._run_job_function("report", str(experiment), str(tmp_path), "refuse") == 0
    with Records.open(experiment) as records:
        for code in ("P1", "P2", "P3"):
            give_up(records, records.add_subject(code, SubjectKind.PERSON))
        records.set_state("P3", SubjectState.DROPPED)
    assert apart._run_job_function("report", str(experiment), str(tmp_path), "refuse") == 0
    assert [r.subjects for r in written] == [programs, ["P1", "P2"]]
    dropped, simulated = written[1].notes[1:]
    assert dropped.startswith("dropped out, and not included: ")
    assert "P3" in dropped
    assert simulated == f"simulated, and not included: {', '.join(programs)}"


def test_a_job_that_fails_says_where_to_look(folder, tmp_path, caplog):
    with pytest.raises(InputError, match="contains no experiment"):
        asyncio.run(apart.run_job("export", str(tmp_path), str(tmp_path)))
    with pytest.raises(HoldfastError, match="the dance failed; the terminal in which the server was started shows why"):
        asyncio.run(apart.run_job("dance", str(folder), str(tmp_path)))
    assert "KeyError: 'dance'" in caplog.text


def test_what_is_read_is_of_one_moment(tmp_path, protocol):
    with Records.create(tmp_path / "experiment", protocol) as writer, Records.open(tmp_path / "experiment") as reader:
        writer.add_subject("A")
        with reader.read_snapshot():
            assert len(reader.subjects()) == 1
            writer.add_subject("B")  # is not held up
            assert len(reader.subjects()) == 1
        assert len(reader.subjects()) == 2
