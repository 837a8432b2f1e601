"""A real server and stations at the other end of a real network, which is cut, taken over, and killed."""

import json
import os
import signal
import threading

import numpy as np
import pytest
from station_client import Client, read_reply
from test_serve_messages import malformed
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from conftest import dump
from holdfast.teleop.records.check import replay_trials
from holdfast.teleop.records.entries import SubjectState, TrialKind
from holdfast.teleop.records.records import Records
from holdfast.teleop.serve import messages
from holdfast.teleop.trials.recordings import End


def recorded(folder, code):
    """[(kind, position, end, configurations)] of a subject."""
    with Records.open(folder) as records:
        entries = records.entries(code)
        trials = records.read_trials(entries)
        return [(e.kind, e.position, e.end, trials.configurations(i)) for i, e in enumerate(entries)]


def arrival(client, position, rng):
    """A training task done in one cycle; the server flags it, as the hand is not where it says."""
    path = client.trial("training", position, rng, cycles=1, end=None)
    client.say("end", end="arrived", q=path[-1].tolist())
    return path


def test_a_whole_session(server, protocol, rng):
    client = Client(server.url, protocol)
    welcome = client.connect()
    code = welcome.subject
    assert (welcome.seq, welcome.over, welcome.answered) == (0, False, [])
    client.say("answers", form="consent", answers={"agree": True})
    paths = [client.trial("training", 0, rng), arrival(client, 1, rng)]
    for k in range(4):
        paths.append(client.trial("trial", k, rng, cycles=3 + k))
        if k == 2:
            client.say("event", kind="dropped-frames", data={"count": 3})
    client.settle()
    again = client.connect()
    assert (again.over, again.unrated, again.answered) == (True, False, ["consent"])
    assert (again.done.training, again.done.trials) == ([None, 1], 4)
    client.socket.close()
    for (kind, _, end, path), said in zip(recorded(server.folder, code), paths, strict=True):
        assert end == (End.ARRIVED if len(said) == 2 else End.ABORTED), kind
        np.testing.assert_array_equal(path, said)
    with Records.open(server.folder) as records:
        assert records.subject(code).state == SubjectState.COMPLETED
        assert [e.rating for e in records.entries(code, TrialKind.TRIAL)] == [1] * 4
        real = [e for e in records.entries(code) if e.end == End.ABORTED]
        assert len(real) == 5
        assert replay_trials(records, real).differing_entries == []


def test_trials_that_differ_are_flagged_before_ctrl_c_ends_it(start, tmp_path, protocol, rng):
    served = start(tmp_path / "experiment")
    client = Client(served.url, protocol)
    code = client.connect().subject
    q0 = client.welcome.plan.training[0].q0
    client.trial("training", 0, rng, cycles=4)
    client.say("begin", kind="training", position=1)
    for k in range(3):  # an arm that stands although it is commanded
        client.say("cycles", first=k, time=[k / 6], velocity=[[0.05, 0.0]], q=[client.welcome.plan.training[1].q0])
    client.say("end", end="arrived", q=q0)
    client.settle()
    served.process.send_signal(signal.SIGINT)  # the end waits for the replay, and not for those who are connected
    assert served.process.wait(60) == 0
    with pytest.raises(ConnectionClosed):
        client.receive()
    with Records.open(tmp_path / "experiment") as records:
        (event,) = records.events("replay differs")
        bad = records.entries(code)[1]
        assert (event["trial"], event["subject"]) == (bad.id, code)
        assert event["data"]["difference"] > 0.01
        assert event["data"]["outside"] is True


def test_two_stations_at_once(server, protocol):
    clients = [Client(server.url, protocol) for _ in range(2)]
    paths: dict[str, np.ndarray] = {}

    def station(client, seed):
        client.connect()
        paths[client.welcome.subject] = client.trial("training", 0, np.random.default_rng(seed), cycles=40)
        client.settle()
        client.socket.close()

    threads = [threading.Thread(target=station, args=(c, k)) for k, c in enumerate(clients)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert len(paths) == 2
    for code, path in paths.items():
        np.testing.assert_array_equal(recorded(server.folder, code)[0][3], path)


@pytest.mark.parametrize("draw", range(3))
def test_a_lost_connection_loses_nothing(server, protocol, rng, draw):
    """Cut at random moments, also between what was said and its acknowledgement; the page goes on meanwhile."""
    client = Client(server.url, protocol)
    code = client.connect().subject
    q, path, plant = np.array(client.welcome.plan.training[0].q0), [], protocol.plants[0]
    client.say("begin", kind="training", position=0)
    for k in range(40):
        if client.socket is not None and rng.random() < 0.1:
            client.cut()
        elif client.socket is None and rng.random() < 0.3:
            client.connect()
        v = protocol.stick.limit_velocity(rng.normal(0, 0.03, 2))
        path.append(q)
        client.say("cycles", first=k, time=[k / 6], velocity=[v.tolist()], q=[q.tolist()])
        q, _ = plant.step_one(q, v, np.ones(3))
    client.say("end", end="aborted", q=q.tolist())
    if client.socket is None:
        client.connect()
    client.settle()
    client.socket.close()
    ((kind, _, end, configurations),) = recorded(server.folder, code)
    assert (kind, end) == (TrialKind.TRAINING, End.ABORTED)
    np.testing.assert_array_equal(configurations, [*path, q])


def test_a_closed_tab_begins_the_trial_again(server, protocol, rng):
    client = Client(server.url, protocol)
    code = client.connect().subject
    client.trial("training", 0, rng, end=None)
    client.settle()
    client.cut()
    back = Client(server.url, protocol)
    back.key = client.key
    welcome = back.connect()
    assert (welcome.seq, welcome.done.training) == (client.seq, [])
    back.trial("training", 0, rng)
    back.settle()
    back.socket.close()
    assert [(p, e) for _, p, e, _ in recorded(server.folder, code)] == [(0, End.BROKEN_OFF), (0, End.ABORTED)]


def test_another_page_takes_over(server, protocol, rng):
    first = Client(server.url, protocol)
    code = first.connect().subject
    first.trial("training", 0, rng)
    first.settle()
    second = Client(server.url, protocol)
    second.key = first.key
    assert second.connect().seq == first.seq
    assert "another page" in first.receive().reason
    with pytest.raises(ConnectionClosed):
        first.receive()
    second.trial("training", 1, rng)
    second.settle()
    second.socket.close()
    assert [p for _, p, _, _ in recorded(server.folder, code)] == [0, 1]


def test_what_is_wrong_is_refused_and_the_session_goes_on(server, protocol, rng):
    client = Client(server.url, protocol)
    code = client.connect().subject
    client.trial("training", 0, rng, cycles=2)
    client.settle()
    last = client.seq
    for wrong, reason in [
        ({"type": "begin", "seq": last + 1, "kind": "trial", "position": 0}, "training 2 is the next"),
        ({"type": "begin", "seq": last + 2, "kind": "training", "position": 1}, f"{last + 1} is next"),
        ({"type": "begin", "seq": 1, "kind": "training", "position": 0}, "on record already"),
        (
            {"type": "cycles", "seq": last + 1, "first": 2, "time": [0], "velocity": [[0, 0]], "q": [[0, 0, 0]]},
            "no trial is in progress",
        ),
        ({"type": "hello", "format": 1, "session": None, "code": None, "kind": "person"}, "hello already"),
        ({"type": "shutdown"}, "malformed"),
    ]:
        client.socket.send(json.dumps(wrong))
        reply = client.receive()
        assert (reply.type, reply.last) == ("refused", last)
        assert reason in reply.reason
    client.trial("training", 1, rng, cycles=2)
    client.settle()
    client.socket.close()
    assert len(recorded(server.folder, code)) == 2


def test_the_first_message_must_be_hello(server):
    for text in ('{"type":"event","seq":1,"kind":"x","data":{}}', "", "{", b"\xff\xfe"):
        with connect(server.url, proxy=None) as socket:
            socket.send(text)
            reply = read_reply(socket.recv(30))
            assert (reply.type, reply.seq, reply.last) == ("refused", None, 0)
    with connect(server.url, proxy=None) as socket:
        socket.send(json.dumps({"type": "hello", "format": 1, "session": "x" * 24, "code": None, "kind": "person"}))
        assert read_reply(socket.recv(30)).type == "bye"
        with pytest.raises(ConnectionClosed):
            socket.recv(30)


def test_too_large_messages_end_the_connection(server, protocol, rng):
    client = Client(server.url, protocol)
    client.connect()
    client.trial("training", 0, rng, cycles=2)
    client.settle()
    before = dump(server.folder)
    client.socket.send('{"type":"event","seq":99,"kind":"x","data":{"a":"' + "x" * messages.MOST_BYTES + '"}}')
    with pytest.raises(ConnectionClosed) as raised:
        client.receive()
    assert raised.value.rcvd.code == 1009
    assert dump(server.folder) == before


def test_malformed_messages_change_nothing(server, protocol, rng):
    """Over the network: HOLDFAST_FUZZ of them, and the server goes on."""
    client = Client(server.url, protocol)
    client.connect()
    client.trial("training", 0, rng, cycles=2, end=None)
    client.settle()
    before = dump(server.folder)
    left = int(os.environ.get("HOLDFAST_FUZZ", "1000"))
    while left:
        count = min(left, 1500)  # a connection lets so many through at once
        for text in malformed(rng, count):
            client.socket.send(text)
        for _ in range(count):
            reply = client.receive()
            assert (reply.type, reply.seq, reply.last) == ("refused", None, client.seq)
        client.connect()
        left -= count
    assert dump(server.folder) == before
    client.say("end", end="aborted", q=[0.0, 0.0, 0.0])
    client.settle()
    client.socket.close()


def test_a_killed_server_goes_on(start, tmp_path, protocol, rng):
    """kill -9 in mid-trial; what was acknowledged is there, what was not is said again, and nothing is there twice."""
    folder = tmp_path / "experiment"
    client = Client("", protocol)
    q, path, plant = None, [], protocol.plants[0]
    for round_ in range(3):
        served = start(folder)
        client.url = served.url
        welcome = client.connect()
        assert welcome.seq >= client.seq - len(client.outbox)
        if q is None:
            q = np.array(welcome.plan.training[0].q0)
            client.say("begin", kind="training", position=0)
        for _ in range(12):
            v = protocol.stick.limit_velocity(rng.normal(0, 0.03, 2))
            path.append(q)
            client.say("cycles", first=len(path) - 1, time=[len(path) / 6], velocity=[v.tolist()], q=[q.tolist()])
            q, _ = plant.step_one(q, v, np.ones(3))
            if rng.random() < 0.3 and client.outbox:
                client.receive()
        if round_ < 2:
            served.process.kill()
            served.process.wait()
            client.socket = None
    client.say("end", end="aborted", q=q.tolist())
    client.settle()
    client.socket.close()
    ((_, _, _, configurations),) = recorded(folder, welcome.subject)
    np.testing.assert_array_equal(configurations, [*path, q])
