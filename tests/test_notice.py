"""Silent work of more than a second is named on stderr, with the time that it takes; by a clock of our own."""

from __future__ import annotations

import inspect
import threading

import numpy as np
import pytest

import holdfast as hf
from holdfast import notice
from holdfast.notice import says, working


class Clock:
    """Stands until it is told to go on."""

    now = 0.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock(monkeypatch):
    """A clock; nobody looks in but the test."""
    made = Clock()
    monkeypatch.setattr(notice, "_clock", made)
    monkeypatch.setattr(notice, "_watch", lambda: None)
    monkeypatch.delenv("HOLDFAST_NOTICES")
    return made


@pytest.fixture
def said(capsys):
    def lines():
        out, err = capsys.readouterr()
        assert out == ""
        return err.splitlines()

    return lines


def look(clock, seconds):
    clock.now += seconds
    notice._outer.look()


def test_short_work_is_not_named(clock, said):
    with working("thinking") as advance:
        look(clock, 0.9)
        advance(1, 2)
    assert said() == []
    assert notice._outer is None


def test_long_work_is_named_once_and_its_time_said_when_it_is_known(clock, said):
    with working("thinking") as advance:
        look(clock, 1.1)
        look(clock, 0.2)
        look(clock, 3.6)
        assert said() == ["holdfast: thinking"]
        clock.now = 5.0
        advance(1, 10)
        assert said() == ["holdfast: thinking, about 45 s more"]
        clock.now = 6.0
        advance(2, 10)
        assert said() == []
        clock.now = 50.0
        advance(3, 30)
        assert said() == ["holdfast: thinking, about 8 min more"]
        clock.now = 200.0
        advance(100, 100)
    assert said() == []


def test_what_was_done_before_does_not_count(clock, said):
    with working("going on") as advance:
        advance(60, 100)
        clock.now = 10.0
        advance(70, 100)
        assert said() == ["holdfast: going on, about 30 s more"]
        clock.now = 100.0
        advance(80, 100, 7.0)
        assert said() == ["holdfast: going on, about 7 s more"]


def test_work_within_work_and_aside_is_not_named(clock, said):
    with working("outside") as advance:
        with working("inside") as within:
            clock.now = 2.0
            within(1, 2)
        assert said() == []
        advance(1, 2)
        assert said() == ["holdfast: outside, about 2 s more"]

    def aside():
        with working("aside") as step:
            clock.now += 100.0
            step(1, 2)
            assert notice._outer is None

    thread = threading.Thread(target=aside)
    thread.start()
    thread.join()
    assert said() == []


def test_who_is_told_tells(clock, said):
    told = []
    with working("outside", lambda *x: told.append(x)) as advance, working("inside") as within:
        clock.now = 2.0
        within(1, 3)
        advance(1, 2)
    assert told == [(1, 2)]
    with working("outside"), working("inside", lambda *x: told.append(x)) as within:
        within(2, 3)
    assert told[1:] == [(2, 3)]
    assert said() == []


def test_it_can_be_switched_off(clock, said, monkeypatch):
    monkeypatch.setenv("HOLDFAST_NOTICES", "off")
    with working("thinking"), notice.long("compiling", 100.0):
        look(clock, 2.0)
    assert said() == []


def test_an_error_ends_it(clock):
    with pytest.raises(KeyboardInterrupt), working("thinking"):
        raise KeyboardInterrupt
    assert notice._outer is None


def test_somebody_looks_in_while_the_main_thread_does_not_speak(monkeypatch):
    """The one test with the true watcher: it waits for it, however long that takes."""
    monkeypatch.delenv("HOLDFAST_NOTICES")
    monkeypatch.setattr(notice, "_LONG", 0.01)
    heard = threading.Event()
    monkeypatch.setattr(notice, "_say", lambda text: heard.set())
    with working("thinking"):
        assert heard.wait(600)


def test_an_argument_named_progress_is_told():
    @says("counting")
    def count(total, progress=None):
        """Count."""
        progress(1, total)
        return total

    told = []
    assert count(3) == 3
    assert count(4, lambda *x: told.append(x)) == count(5, progress=lambda *x: told.append(x)) - 1
    assert told == [(1, 4), (1, 5)]
    assert list(inspect.signature(count).parameters) == ["total", "progress"]


# ---- what says so --------------------------------------------------------------------------------------------------------

QUICK = {
    "load": "reads a file",
    "compare": "compares what is computed",
    "set_threads": "sets a number",
    "susceptibility": "is a module, and a function of one configuration",
    "self_motion": "is one of fibres, which says so",
    "point_to_point": "is a formula",
}


def test_every_public_function_that_may_take_long_says_so():
    """A new one is to be decorated, or named above with the reason."""
    silent = set()
    for name in hf.__all__:
        function = getattr(hf, name)
        if inspect.isfunction(function) and not {"says", "working"} & set(inspect.unwrap(function).__globals__):
            silent.add(name)
    assert silent <= set(QUICK)


CALLS = {
    "assessing poses": lambda arm, law, x: hf.assess(arm, hf.Region.around(arm, x), poses=4, task="planar"),
    "solving inverse kinematics": lambda arm, law, x: hf.solve_ik(arm, arm.forward_kinematics(x), task="planar"),
    "tracing self-motions": lambda arm, law, x: hf.self_motion(arm, [1.5, 1.5], "planar", starts=4),
    "simulating motions": lambda arm, law, x: hf.simulate(law, x, [1.5, 1.5]),
    "comparing control laws": lambda arm, law, x: hf.compare_laws([law], x, [1.5, 1.5], restarts=2),
    "computing the trade-off": lambda arm, law, x: hf.control.trade_off(arm, "planar", samples=10, allowed=[0, 0.5]),
    "looking for stationary points": lambda arm, law, x: hf.stationary_points(law, [1.5, 1.5], 1, at=1.0),
    "simulating the basins": lambda arm, law, x: hf.basins(law, [1.5, 1.5], 1, at=1.0, starts=4),
    "simulating failures": lambda arm, law, x: hf.convergence_map(law, 1, 2, configurations=1),
    "looking for the ranges of the joints": lambda arm, law, x: hf.joint_bounds(arm, [1.5, 1.5], "planar", starts=4),
    "planning the way back": lambda arm, law, x: hf.recover(arm, "joint2", x, "home", samples=0),
}


@pytest.mark.interpreted
@pytest.mark.parametrize("what", CALLS)
def test_what_is_named_is_what_was_asked_for(what, clock, monkeypatch):
    names = []

    class Noted(notice._Work):
        def __init__(self, what):
            names.append(what)
            super().__init__(what)

    monkeypatch.setattr(notice, "_Work", Noted)
    arm = hf.arms.load("planar-3r")
    CALLS[what](arm, hf.control.Pseudoinverse(arm, "planar"), np.array([0.3, 0.5, 0.7]))
    assert names == [what]
    assert notice._outer is None
