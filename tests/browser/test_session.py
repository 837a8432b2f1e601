"""Sessions on the real page: what was done at the station is what is in the records."""

import os
import subprocess
import sys
import time

import numpy as np
import pytest

from browser.compare import compare
from browser.station import Station
from holdfast.teleop.records.entries import SubjectKind, SubjectState
from holdfast.teleop.records.records import Records

OUTAGE = float(os.environ.get("HOLDFAST_OUTAGE", "2"))  # s; make soak has 30


def test_a_whole_session_with_a_gamepad(contexts, experiment):
    station = Station(contexts(), experiment.station)
    station.calibrate()
    station.join("pad")
    for part in (1, 2):
        station.at(f"instructions-{part}").get_by_test_id("instructions-next").click()
    station.steer()
    station.ended()
    station.started()
    station.page.keyboard.press("Escape")
    station.at("practice-done").click()
    station.at("training-begin").click()
    # A training task that is given up does not count.
    station.started()
    station.at("abort").click()
    station.ended()
    station.steer()
    station.at("trials-begin").click()
    ratings = [1, 2, 3, 4]
    for k, rating in enumerate(ratings):
        if k == 2:
            station.started()
            station.page.keyboard.press("Escape")
        else:
            station.steer()
        station.rate(rating)
    tlx = ["mental", "physical", "temporal", "performance", "effort", "frustration"]
    for k, name in enumerate(tlx):
        for _ in range(k + 1):
            station.at(name).press("ArrowRight" if k % 2 else "ArrowLeft")
    station.at("submit").click()
    station.at("debriefing").wait_for()
    station.settled()
    assert station.page.evaluate("localStorage.getItem('holdfast.session')") is None
    station.at("next-subject").click()
    station.at("setup").wait_for()

    done, entries = compare(experiment.folder, "pad", station.said)
    assert [(d.kind, d.position, d.end) for d in done] == [
        ("training", 0, "aborted"),
        ("training", 1, "arrived"),
        ("trial", 0, "arrived"),
        ("trial", 1, "arrived"),
        ("trial", 2, "aborted"),
        ("trial", 3, "arrived"),
    ]
    assert [d.rating for d in done] == [None, None, *(r - 1 for r in ratings)]
    with Records.open(experiment.folder) as records:
        subject, protocol = records.subject("pad"), records.protocol
        order = protocol.session_order(subject.row, subject.number)
        assert [(e.task, e.scenario) for e in entries[2:]] == [tuple(row) for row in order]
        assert (subject.kind, subject.state) == (SubjectKind.PERSON, SubjectState.COMPLETED)
        answers = {key: value for key, value in subject.answers.items() if "." in key}
        arrived = records.read_trials([e for e in entries if e.end.name == "ARRIVED"])
        away = np.linalg.norm(arrived.x_end - arrived.target, axis=1)
        assert (away <= protocol.radius).all()
        assert [e["data"]["id"] for e in records.events("input") if e["subject"] == "pad"] == ["Stick of the tests"]
    assert answers == {
        "consent.informed": True,
        "consent.agreed": True,
        "demographics.age": "25-34",
        "demographics.hand": "left",
        "demographics.games": "never",
        "demographics.robots": "once",
        **{f"tlx.{name}": 50 + 5 * (k + 1) * (1 if k % 2 else -1) for k, name in enumerate(tlx)},
    }
    replayed = subprocess.run(
        [sys.executable, "-m", "holdfast", "teleop", "replay", str(experiment.folder)], capture_output=True, text=True
    )
    assert replayed.returncode == 0, replayed.stdout + replayed.stderr
    assert " 0 differ" in replayed.stdout


@pytest.mark.parametrize("device", ["pointer", "keys"])
def test_other_sticks(contexts, experiment, device):
    station = Station(contexts(), experiment.station)
    steer = station.steer_keys if device == "keys" else station.steer_pointer
    station.enter(device, device)
    steer()
    station.at("trials-begin").click()
    steer()
    station.rate(2)
    station.settled()
    done, _ = compare(experiment.folder, device, station.said)
    assert [(d.kind, d.end, d.rating) for d in done] == [("training", "arrived", None), ("trial", "arrived", 1)]
    if device == "keys":  # along an axis, or half-way between two
        for right, up in (v for d in done for v in d.velocity):
            assert right == 0 or up == 0 or abs(right) == abs(up)


def test_the_network_is_lost_and_comes_back(contexts, experiment, line):
    station = Station(contexts("WebSocket connection"), experiment.station.replace(str(experiment.port), str(line.port)))
    station.enter("cut")
    station.steer()
    station.at("trials-begin").click()
    station.under_way()
    line.cut()
    begun = time.monotonic()
    station.page.locator("[data-testid=connection][data-online=false]").wait_for()
    station.until(lambda: time.monotonic() > begun + OUTAGE, "the end of the outage")
    # All that was before is on the disk, and the rest is not.
    with Records.open(experiment.folder) as records:
        before = records.count_cycles(records.latest_trial("cut"))
    station.operator("goal = 'target'")
    station.rate(3)
    station.steer()
    station.rate(1)
    assert int(station.at("connection").get_attribute("data-waiting")) > 3
    line.mend()
    station.settled()
    done, _ = compare(experiment.folder, "cut", station.said)
    assert [(d.kind, d.position, d.end, d.rating) for d in done[1:]] == [("trial", 0, "arrived", 2), ("trial", 1, "arrived", 0)]
    assert before < len(done[1].time)
    # The arm went on through it, at its rate.
    assert np.diff(done[1].time).max() < max(1.0, OUTAGE / 2)
    assert done[1].time[-1] > OUTAGE
    with Records.open(experiment.folder) as records:
        [lost] = [e for e in records.events("offline") if e["subject"] == "cut"]
    assert lost["data"]["seconds"] > OUTAGE


def test_a_closed_tab_goes_on_where_it_stopped(contexts, experiment, line):
    context = contexts("WebSocket connection")
    url = experiment.station.replace(str(experiment.port), str(line.port))
    first = Station(context, url)
    first.enter("tab")
    first.steer()
    first.at("trials-begin").click()
    first.steer()
    first.rate(2)

    # Closed in mid-trial.
    first.under_way()
    first.leave()
    second = Station(context, url)
    second.set_up("gamepad")
    assert "tab" in second.at("join-screen").inner_text()
    second.at("continue").click()
    second.at("trial").wait_for()
    assert "Task 2 of 4" in second.at("progress").inner_text()
    second.under_way()

    # Closed in mid-trial, and off line.
    line.cut()
    second.page.locator("[data-testid=connection][data-online=false]").wait_for()
    second.page.wait_for_timeout(300)
    second.leave()
    line.mend()
    third = Station(context, url)
    third.set_up("gamepad")
    third.at("continue").click()
    third.steer()
    third.rate(4)
    third.settled()
    done, _ = compare(experiment.folder, "tab", third.said)
    assert [(d.position, d.end == "arrived", d.rating) for d in done[1:]] == [
        (0, True, 1),
        (1, False, None),
        (1, False, None),
        (1, True, 3),
    ]
    # Its tab closes while a page is hidden: it breaks the trial off itself if it still comes to that.
    assert {d.end for d in done[2:4]} <= {None, "broken-off"}
    assert all(len(d.time) for d in done)


def test_two_stations_at_once(contexts, experiment):
    left, right = Station(contexts(), experiment.station), Station(contexts(), experiment.station)
    for station, code in ((left, "left"), (right, "right")):
        station.enter(code)
    for part in ("training", "trial"):
        for station in (left, right):
            station.operator("trials = 1")
        for station in (left, right):
            if part == "training":
                station.at("trials-begin").click()
            else:
                station.rate(1)
                station.settled()
    rows = set()
    for station, code in ((left, "left"), (right, "right")):
        done, _ = compare(experiment.folder, code, station.said)
        assert [(d.kind, d.end) for d in done] == [("training", "arrived"), ("trial", "arrived")]
        with Records.open(experiment.folder) as records:
            rows.add(records.subject(code).row)
    assert len(rows) == 2

    # The same session in another tab: the older one is told so, and the newer one goes on.
    newer = Station(left.context, experiment.station)
    newer.set_up("gamepad")
    newer.at("continue").click()
    newer.at("trial").wait_for()
    left.at("stopped").wait_for()
    newer.steer()
    newer.rate(2)
    newer.settled()
    done, _ = compare(experiment.folder, "left", newer.said)
    assert [(d.position, d.end) for d in done[1:]] == [(0, "arrived"), (1, "arrived")]


def test_a_dry_run_plays_a_whole_session(contexts, experiment):
    station = Station(contexts(), f"{experiment.station}?robot=5")
    station.at("debriefing").wait_for(timeout=300_000)
    station.settled()
    code = station.at("subject").inner_text().removeprefix("Code ")
    done, _ = compare(experiment.folder, code, station.said)
    assert [d.kind for d in done if d.end != "broken-off"][-4:] == ["trial"] * 4
    with Records.open(experiment.folder) as records:
        subject = records.subject(code)
    assert (subject.kind, subject.state) == (SubjectKind.SIMULATED, SubjectState.COMPLETED)
    assert {"consent", "demographics", "tlx"} <= subject.answers.keys()
