"""What the experimenter sees and does: the hub, and the hands on the sessions."""

import asyncio
import json
import time
from contextlib import suppress

import numpy as np
import pytest

import holdfast as hf
from holdfast.teleop.records.entries import SubjectState
from holdfast.teleop.records.records import Records
from holdfast.teleop.serve import messages
from holdfast.teleop.serve.control import Control
from holdfast.teleop.serve.live import StatusBroadcaster
from holdfast.teleop.serve.messages import Ack, Bye, Hello, Pause, Welcome


class Page:
    """A page without a socket."""

    def __init__(self):
        self.code, self.said = None, []

    def send_reply(self, reply):
        self.said.append(reply)

    def pause(self, paused):
        self.said.append(Pause(paused=paused))

    def bye(self, reason):
        self.said.append(Bye(reason=reason))


def hello(**change):
    return Hello(**{"type": "hello", "format": 1, "session": None, "code": None, "kind": "person"} | change)


async def settled(control):
    """Everything that was given to the threads so far is done."""
    for keeper in (control.writer, control.reader, control.writer):
        await keeper.run_job(lambda _: None)


async def next_message(message, seconds=30.0):
    """The message that is awaited; the test fails if there is none in time."""
    try:
        return await asyncio.wait_for(message, seconds)
    except TimeoutError:
        pytest.fail(f"the experimenter's page was sent no message for {seconds:g} s")


def test_slow_watchers_drop_old_messages_and_nobody_waits():
    async def scene():
        now = [0.0]
        live = StatusBroadcaster(clock=lambda: now[0])
        live.publish({"n": -1})  # nobody watches: nothing is kept
        slow, quick = live.stream_messages(), live.stream_messages()
        first = [asyncio.ensure_future(anext(w)) for w in (slow, quick)]
        await asyncio.sleep(0)
        assert live.is_watched
        live.publish({"n": 0})
        assert [await f for f in first] == [{"n": 0}] * 2
        got = []
        for n in range(1, 200):
            live.publish({"n": n})
            got.append((await anext(quick))["n"])
        assert got == list(range(1, 200))
        assert (await anext(slow))["n"] == 200 - 64
        await slow.aclose()
        for n in range(30):  # 10 ms apart: at most 15 a second of one topic pass
            now[0] += 0.01
            live.publish({"n": n}, topic="P1")
        live.publish({"n": "other"}, topic="P2")
        passed = []
        while not passed or passed[-1] != "other":
            passed.append((await anext(quick))["n"])
        assert 4 <= len(passed[:-1]) <= 5
        await quick.aclose()
        assert not live.is_watched

    asyncio.run(scene())


@pytest.fixture
def experiment(records):
    records.close()
    return records.folder


def test_the_experimenter_watches_and_acts(experiment):
    async def scene():
        control = Control(experiment, asyncio.get_running_loop())
        try:
            watch = control.live.stream_messages()
            news = asyncio.ensure_future(anext(watch))
            await asyncio.sleep(0)
            one, two = Page(), Page()
            welcome = await control.enter_session(one, hello(code="P1"))
            assert isinstance(welcome, Welcome)
            await control.enter_session(two, hello(code="P2"))
            control.apply_message(one, messages.Begin(type="begin", seq=1, kind="training", position=0))
            q0 = welcome.plan.training[0].q0
            cycle = {"first": 0, "time": [0.0], "velocity": [[0.01, 0.0]], "q": [q0]}
            control.apply_message(one, messages.Cycles(type="cycles", seq=2, **cycle))
            await settled(control)
            assert one.said == [Ack(seq=1), Ack(seq=2)]
            told, deadline = [await next_message(news)], time.monotonic() + 30
            while {m["type"] for m in told} != {"cycle", "subjects"}:
                assert time.monotonic() < deadline, f"after 30 s there were only messages of type {told[-1]['type']}"
                told.append(await next_message(anext(watch)))
            shown = next(m for m in told if m["type"] == "cycle")
            assert (shown["subject"], shown["kind"], shown["position"], shown["q"]) == ("P1", "training", 0, q0)
            assert shown["healthy"] == [1, 1, 1]
            json.dumps(told, allow_nan=False)

            await control.pause("P1", True)
            assert (one.said[-1], two.said) == (Pause(paused=True), [])
            await control.pause(None, True)
            assert (one.said[-1], two.said) == (Pause(paused=True), [Pause(paused=True)])
            rows = {r["subject"]: r for r in await control.describe_subjects()}
            assert rows["P1"]["connected"]
            assert rows["P2"]["paused"]
            assert (rows["P1"]["training"], rows["P1"]["of"]) == (0, 4)
            await control.pause(None, False)
            assert two.said[-1] == one.said[-1] == Pause(paused=False)
            await control.set_note("P1", "left-handed")

            key = await control.renew_key("P1")  # another page takes over
            assert isinstance(one.said[-1], Bye)
            assert isinstance(await control.enter_session(Page(), hello(session=welcome.session)), Bye)
            third = Page()
            again = await control.enter_session(third, hello(session=key))
            assert (again.seq, again.paused, again.subject) == (2, False, "P1")
            fourth = Page()
            await control.enter_session(fourth, hello(session=key))
            assert "another page" in third.said[-1].reason
            control.release_session(third)  # it is gone, and does not hold the session any more
            await control.drop_subject("P1")
            assert "ended by the experimenter" in fourth.said[-1].reason
            for act in (control.set_note("X", ""), control.drop_subject("X"), control.renew_key("X"), control.pause("X", True)):
                with pytest.raises(hf.InputError, match="no subject X"):
                    await act
            with pytest.raises(hf.InputError, match="cannot be resumed"):
                await control.renew_key("P1")
            with pytest.raises(hf.InputError, match="10,000"):
                await control.set_note("P2", "x" * 10_001)
            await watch.aclose()
        finally:
            await asyncio.to_thread(control.close)

    asyncio.run(scene())
    with Records.open(experiment) as records:
        assert records.subject("P1").state == SubjectState.DROPPED
        assert records.subject("P1").note == "left-handed"
        kinds = [e["kind"] for e in records.events()]
        assert kinds == ["paused", "paused", "goes on"]


def test_what_was_not_replayed_before_a_kill_is_replayed_after(experiment, protocol):
    from holdfast.teleop.serve.station import Station, admit_page
    from holdfast.teleop.trials.recordings import End

    with Records.open(experiment) as records:
        code = admit_page(records, hello()).code
        station = Station(records, code)
        q0 = station.make_welcome("x" * 20, False).plan.training[0].q0
        station.apply_message(messages.Begin(type="begin", seq=1, kind="training", position=0))
        still = {"time": [0.0, 0.1], "velocity": [[0.03, 0.0]] * 2, "q": [q0, q0]}
        station.apply_message(messages.Cycles(type="cycles", seq=2, first=0, **still))
        station.apply_message(messages.EndMessage(type="end", seq=3, end="aborted", q=q0))

    async def scene():
        control = Control(experiment, asyncio.get_running_loop())
        await control.begin()
        await settled(control)
        rows = await control.describe_subjects()
        await asyncio.to_thread(control.close)
        return rows

    for _ in range(2):  # and flagged once
        assert [r["differing"] for r in asyncio.run(scene())] == [1]
    with Records.open(experiment) as records:
        (event,) = records.events("replay differs")
        (entry,) = records.entries(code)
        assert entry.end == End.ABORTED
        plant = records.protocol.plants[0]
        q1, _ = plant.step_one(entry.q0, np.array([0.03, 0.0]), np.ones(3))  # both cycles begin where the record has them
        worst = np.abs(q1 - entry.q0).max()
        assert event["data"] == {"difference": pytest.approx(worst), "outside": False}
        assert event["trial"] == entry.id


def test_a_disk_that_is_full_stops_nobody_for_good(experiment):
    async def scene():
        control = Control(experiment, asyncio.get_running_loop())
        page = Page()
        try:
            await control.enter_session(page, hello())
            pages = await control.writer.run_job(lambda r: r._db.execute("PRAGMA page_count").fetchone()[0])
            control.writer.submit_job(lambda r: r._db.execute(f"PRAGMA max_page_count = {pages}"), lambda _: None)
            for k in range(200):
                data = {f"k{i}": "x" * 3000 for i in range(9)}
                control.apply_message(page, messages.EventMessage(type="event", seq=k + 1, kind="x", data=data))
            deadline = time.monotonic() + 60
            while len(page.said) < 200:
                assert time.monotonic() < deadline, f"after 60 s there were {len(page.said)} of 200 replies"
                with suppress(hf.StoreError):  # the question is part of a transaction that is lost
                    await settled(control)
            broken = next(i for i, r in enumerate(page.said) if isinstance(r, hf.StoreError))
            assert "cannot be written" in str(page.said[broken])
            control.writer.submit_job(lambda r: r._db.execute("PRAGMA max_page_count = 1000000"), lambda _: None)
            await control.writer.run_job(lambda _: None)
            last = await control.writer.run_job(lambda r: r.last_seq(page.code))
            assert all(not isinstance(r, Ack) or r.seq <= last for r in page.said)
            control.apply_message(page, messages.EventMessage(type="event", seq=last + 1, kind="y", data={}))
            await settled(control)
            assert page.said[-1] == Ack(seq=last + 1)
        finally:
            await asyncio.to_thread(control.close)

    asyncio.run(scene())
