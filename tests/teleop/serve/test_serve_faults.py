"""What goes wrong around a server: a folder that goes away, an answer that is lost, a restart, a page that sends too much."""

import json
import socket
import subprocess
import sys
import time
import urllib.request

import numpy as np
import pytest
from serve_program import KEY
from station_client import Client, read_reply
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

import holdfast as hf
from conftest import PROGRAM
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.verification import verify_records
from holdfast.teleop.serve import messages
from holdfast.teleop.serve.app import ServerOptions, serve_experiment
from holdfast.teleop.serve.messages import Ack, Refused, Unstored, Welcome
from holdfast.teleop.serve.station import Admission, Station, admit_page, message_quota_bytes


def list_of(served):
    return json.load(urllib.request.urlopen(f"{served.http}/experimenter/subjects.json?key={KEY}", timeout=30))


def test_a_folder_that_goes_away_ends_acknowledgement_at_once(start, tmp_path, protocol, rng):
    served = start(tmp_path / "experiment")
    client, idle = Client(served.url, protocol), Client(served.url, protocol)
    code = client.connect().subject
    idle.connect()
    client.trial("training", 0, rng, cycles=3)
    client.settle()
    (tmp_path / "experiment").rename(tmp_path / "gone")
    path = client.trial("training", 1, rng, cycles=3)
    assert isinstance(client.receive(), Unstored)
    assert isinstance(idle.receive(), Unstored)  # told although it said nothing
    for each in (client, idle):
        with pytest.raises(ConnectionClosed):
            each.receive()
    assert "no longer exists" in list_of(served)["fault"]
    with connect(served.url, proxy=None) as new:  # nobody begins a session either
        new.send(json.dumps({"type": "hello", "format": 1, "session": None, "code": None, "kind": "person"}))
        assert isinstance(read_reply(new.recv(30)), Unstored)
    (tmp_path / "gone").rename(tmp_path / "experiment")
    client.connect()
    client.settle()
    client.socket.close()
    assert list_of(served)["fault"] is None
    with Records.open(tmp_path / "experiment") as records:
        entries = records.entries(code)
        assert len(entries) == 2
        np.testing.assert_array_equal(records.read_trials(entries).configurations(1), path)
        assert len(records.events("written again")) == 1
    assert verify_records(tmp_path / "experiment").damages == []


def test_one_server_for_a_folder(server, built):
    with pytest.raises(hf.StoreError, match="is already served by another program"):
        serve_experiment(ServerOptions(server.folder, static=built[0], english=built[1]), port=0)


def test_nobody_is_deleted_behind_a_servers_back(start, tmp_path, protocol):
    served = start(tmp_path / "experiment")
    code = Client(served.url, protocol).connect().subject
    with Records.open(served.folder) as records:
        with pytest.raises(hf.StoreError, match="is already served by another program; stop that one first"):
            records.delete_subject(code)
        assert records.subject(code).code == code
        served.process.kill()
        served.process.wait()
        records.delete_subject(code)
        assert records.subjects() == []


def test_a_lost_answer_makes_no_second_subject(server):
    hello = {"type": "hello", "format": 1, "session": None, "code": None, "kind": "simulated", "fresh": "0123456789abcdef" * 3}
    found = []
    for _ in range(2):
        with connect(server.url, proxy=None) as socket:
            socket.send(json.dumps(hello))
            found.append(read_reply(socket.recv(30)))
    first, second = found
    assert isinstance(first, Welcome)
    assert (first.subject, first.session) == (second.subject, hello["fresh"])
    with connect(server.url, proxy=None) as socket:
        socket.send(json.dumps(hello | {"fresh": "fedcba9876543210" * 3}))
        assert read_reply(socket.recv(30)).subject != first.subject


def test_pauses_survive_a_restart(start, tmp_path, protocol):
    def pause(served, subject, paused):
        body = json.dumps({"subject": subject, "paused": paused}).encode()
        asked = urllib.request.Request(
            f"{served.http}/experimenter/pause?key={KEY}", body, {"Content-Type": "application/json"}
        )
        urllib.request.urlopen(asked, timeout=30).close()

    def again(served, *keys):
        served.process.kill()
        served.process.wait()
        other = start(tmp_path / "experiment")
        told = []
        for key in keys:
            client = Client(other.url, protocol)
            client.key = key
            told.append(client.connect().paused)
            client.socket.close()
        return other, told

    served = start(tmp_path / "experiment")
    clients = [Client(served.url, protocol) for _ in range(2)]
    codes = [c.connect().subject for c in clients]
    keys = [c.key for c in clients]
    pause(served, codes[1], True)
    served, told = again(served, *keys)
    assert told == [False, True]
    pause(served, None, True)
    served, told = again(served, *keys)
    assert told == [True, True]
    assert list_of(served)["paused"] is True
    pause(served, None, False)
    assert again(served, *keys)[1] == [False, False]


def test_a_session_may_send_only_so_much(records, protocol):
    entered = admit_page(records, messages.Hello(type="hello", format=1, session=None, code=None, kind="person"))
    assert isinstance(entered, Admission)
    station, most = Station(records, entered.code), message_quota_bytes(protocol)
    assert 16 * 2**20 <= most < 2**30

    def say(seq, size):
        return station.apply_message(messages.EventMessage(type="event", seq=seq, kind="x", data={}), size).reply

    assert isinstance(say(1, most // 2), Ack)
    assert isinstance(say(2, most // 2), Ack)
    reply = say(3, 2)
    assert isinstance(reply, Refused)
    assert (reply.last, "MiB" in reply.reason) == (2, True)


def test_a_rating_of_the_training_is_refused(server, protocol, rng):
    client = Client(server.url, protocol)
    client.connect()
    client.trial("training", 0, rng, cycles=2)
    client.settle()
    client.socket.send(json.dumps({"type": "rate", "seq": client.seq + 1, "rating": 1, "answers": {}}))
    assert "is a training trial" in client.receive().reason
    client.socket.close()


def test_a_post_that_breaks_off_leaves_no_traceback(built, protocol, tmp_path):
    """The experimenter's browser loses its connection within the body of a request."""
    Records.create(tmp_path / "experiment", protocol).close()
    program = [sys.executable, str(PROGRAM), str(tmp_path / "experiment"), *map(str, built)]
    with subprocess.Popen(program, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as server:
        port = int(server.stdout.readline())
        with socket.create_connection(("127.0.0.1", port)) as client:
            head = f"POST /experimenter/pause?key={KEY} HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 100\r\n"
            client.sendall(f"{head}Content-Type: application/json\r\n\r\n{{".encode())
            time.sleep(0.2)
        urllib.request.urlopen(f"http://127.0.0.1:{port}/experimenter/subjects.json?key={KEY}", timeout=30).read()
        server.terminate()
        assert "Traceback" not in server.communicate(timeout=30)[1]
