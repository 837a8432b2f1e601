"""Silent work of more than a second is named on stderr, with the time that it takes; by a clock of our own."""

from __future__ import annotations

import inspect
import sys
import threading
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure

import holdfast as hf
from holdfast.core import progress
from holdfast.core.progress import ProgressCount, count_finished_part, report_work, reports_progress, track
from holdfast.interface.report import figures


class Clock:
    """Stands until it is told to go on."""

    now = 0.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock(monkeypatch):
    """A clock; nobody looks in but the test."""
    made = Clock()
    monkeypatch.setattr(progress, "_clock", made)
    monkeypatch.setattr(progress, "_start_watcher", lambda: None)
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
    progress._outer.print_if_due()


def test_short_work_is_not_named(clock, said):
    with report_work("thinking") as advance:
        look(clock, 0.9)
        advance(1, 2)
    assert said() == []
    assert progress._outer is None


def test_long_work_is_named_once_and_its_time_said_when_it_is_known(clock, said):
    with report_work("thinking") as advance:
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


@pytest.mark.parametrize(("total", "left"), [(3_000, "50 min"), (86_401, "24 h"), (5e6, "58 days"), (1e12, "31688 years")])
def test_a_long_time_is_told_in_its_own_unit(clock, said, total, left):
    with report_work("thinking") as advance:
        clock.now = 9.0
        advance(9, total)
        assert said() == [f"holdfast: thinking, about {left} more"]


def test_what_was_done_before_does_not_count(clock, said):
    with report_work("going on") as advance:
        advance(60, 100)
        clock.now = 10.0
        advance(70, 100)
        assert said() == ["holdfast: going on, about 30 s more"]
        clock.now = 100.0
        advance(80, 100, 7.0)
        assert said() == ["holdfast: going on, about 7 s more"]


def test_work_within_work_and_aside_is_not_named(clock, said):
    with report_work("outside") as advance:
        with report_work("inside") as within:
            clock.now = 2.0
            within(1, 2)
        assert said() == []
        advance(1, 2)
        assert said() == ["holdfast: outside, about 2 s more"]

    def aside():
        with report_work("aside") as step:
            clock.now += 100.0
            step(1, 2)
            assert progress._outer is None

    thread = threading.Thread(target=aside)
    thread.start()
    thread.join()
    assert said() == []


def test_who_is_told_tells(clock, said):
    told = []
    with report_work("outside", lambda *x: told.append(x)) as advance, report_work("inside") as within:
        look(clock, 2.0)
        within(1, 3)
        advance(1, 2)
    assert told == [(1, 2)]
    with report_work("outside"), report_work("inside", lambda *x: told.append(x)) as within:
        within(2, 3)
    assert told[1:] == [(2, 3)]
    assert said() == []


def test_it_can_be_switched_off(clock, said, monkeypatch):
    monkeypatch.setenv("HOLDFAST_NOTICES", "off")
    with report_work("thinking"), progress.long_task("compiling", 100.0):
        look(clock, 2.0)
    assert said() == []


@pytest.fixture
def cell(monkeypatch):
    """What the kernel of a notebook is told to show: the line, whether in place of another one, and which."""
    shown = []

    class Kernel:
        kernel = object()

        class display_pub:
            @staticmethod
            def publish(data, *, transient, update):
                assert data["text/plain"].startswith("holdfast: ")
                shown.append((data["text/html"], update, transient["display_id"]))

    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: Kernel))
    return shown


def test_in_a_notebook_one_line_changes_in_place(clock, said, cell):
    with report_work("<thinking>") as advance:
        look(clock, 0.9)
        assert cell == []
        look(clock, 0.2)
        assert "&lt;thinking&gt;</div>" in cell[-1][0]
        clock.now = 5.0
        advance(1, 10)
        assert "about 45 s more" in cell[-1][0]
        assert 'max="1" value="0.100"' in cell[-1][0]
        clock.now = 6.0
    assert cell[-1][0] == '<div style="opacity:.75">&lt;thinking&gt;: 6 s</div>'
    assert [update for _, update, _ in cell] == [False, True, True]
    assert len({which for *_, which in cell}) == 1

    def interrupted():
        with report_work("again"), ProgressCount("parts", 2) as tell:
            tell(1)
            look(clock, 3.0)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert "again, so far 1 of 2 parts<" in cell[-2][0]
    assert "again: stopped after 3 s<" in cell[-1][0]
    with report_work("short"), progress.long_task("compiling", 3.0):
        clock.now += 0.5
    assert "compiling, about 3 s<" in cell[-2][0]
    assert "compiling: 0 s<" in cell[-1][0]
    assert said() == []


def test_a_notebook_may_be_told_nothing(clock, said, cell, monkeypatch):
    monkeypatch.setenv("HOLDFAST_NOTICES", "off")
    with report_work("thinking"):
        look(clock, 9.0)
    assert said() == cell == []


def test_how_far_it_has_come_is_said_where_nobody_knows_the_time(clock, said):
    with report_work("thinking"), ProgressCount("thoughts", 24, most=True) as outer:
        with ProgressCount("words", 5) as inner:
            inner(2)
            look(clock, 1.1)
            assert said() == ["holdfast: thinking, so far 2 of 5 words"]
            outer(7)
            inner(1)
            look(clock, 4.0)
        assert said() == ["holdfast: thinking, so far 7 of at most 24 thoughts"]
    assert said() == []


def test_the_time_follows_from_the_parts_of_a_whole_once_enough_are_done(clock, said):
    with report_work("thinking"):
        clock.now = 2.0  # spent on something else
        with ProgressCount("thoughts", 100, whole=True) as tell:
            look(clock, 1.0)
            assert said() == ["holdfast: thinking"]
            tell(9)
            look(clock, 9.0)
            assert said() == ["holdfast: thinking, so far 9 of 100 thoughts"]
            tell(1)
            look(clock, 0.0)
            assert said() == ["holdfast: thinking, about 90 s more"]
        look(clock, 1000.0)
        assert said() == []


def test_a_part_of_work_within_work_tells_no_time(clock, said):
    with report_work("outside"), report_work("inside"), ProgressCount("parts", 10, whole=True) as tell:
        tell(5)
        look(clock, 2.0)
    assert said() == ["holdfast: outside: inside, so far 5 of 10 parts"]


def test_items_count_once_the_next_is_asked_for(clock, said):
    with report_work("thinking"):
        for k in track("items", range(7), most=True, every=2):
            if k == 5:
                look(clock, 2.0)
                break
        assert progress._outer.counts == []
    assert said() == ["holdfast: thinking, so far 4 of at most 7 items"]


def test_what_has_no_total_is_counted(clock, said):
    count_finished_part("figure")
    with report_work("drawing"):
        for seconds in (2.0, 8.0):
            figures.svg(Figure(), "a", "nothing")
            look(clock, seconds)
    figures.svg(Figure(), "b", "nothing")
    assert said() == ["holdfast: drawing, so far 1 figure", "holdfast: drawing, so far 2 figures"]


def test_a_count_is_told_from_any_thread_and_opened_in_the_main_one(clock, said):
    def aside(tell):
        tell(3)
        with ProgressCount("others", 9) as other:
            other(4)

    with report_work("thinking"), ProgressCount("parts", 8) as tell:
        thread = threading.Thread(target=aside, args=[tell])
        thread.start()
        thread.join()
        look(clock, 2.0)
    assert said() == ["holdfast: thinking, so far 3 of 8 parts"]


def test_an_error_ends_it(clock):
    with pytest.raises(KeyboardInterrupt), report_work("thinking"):
        raise KeyboardInterrupt
    assert progress._outer is None
    with report_work("outside"):
        with pytest.raises(ValueError, match="inside"), report_work("inside"), ProgressCount("parts", 2):
            raise ValueError("inside")
        assert (progress._outer.names, progress._outer.counts) == (["outside"], [])


def test_somebody_looks_in_while_the_main_thread_does_not_speak(monkeypatch):
    """The one test with the true watcher: it waits for it, however long that takes."""
    monkeypatch.delenv("HOLDFAST_NOTICES")
    monkeypatch.setattr(progress, "LONG_WORK_S", 0.01)
    heard = threading.Event()
    monkeypatch.setattr(progress, "_print_notice", lambda text: heard.set())
    with report_work("thinking"):
        assert heard.wait(600)


def test_an_argument_named_progress_is_told():
    @reports_progress("counting")
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
    "compare_assessments": "compares what is computed",
    "set_threads": "sets a number",
    "set_backend": "sets a name",
    "susceptibility": "is a module, and a function of one configuration",
    "self_motion": "is one of fibres, which says so",
    "point_to_point": "is a formula",
    "check_cell": "looks at 512 configurations",
    "holds": "is a formula",
}


def test_every_public_function_that_may_take_long_says_so():
    """A new one is to be decorated, or named above with the reason."""
    silent = set()
    for name in hf.__all__:
        function = getattr(hf, name)
        if inspect.isfunction(function) and not {"reports_progress", "report_work"} & set(inspect.unwrap(function).__globals__):
            silent.add(name)
    assert silent <= set(QUICK)


FALL = hf.power_loss(hf.arms.load("planar-3r"), [0.3, 0.5, 0.7])


def wish(arm):
    return hf.indices.manipulability(arm, "planar")


def assess(arm, region):
    return hf.assess(arm, region, poses=region.block + 4, task="planar")


def tolerant(arm):
    """Not one of those that are known in closed form: its joints have limits."""
    return hf.tolerant_workspace(arm.with_limits(-2 * np.ones(3), 2 * np.ones(3)), "planar", points=4, angles=2)


def along(arm, x):
    """A short timed path from where the arm stands."""
    here = arm.forward_kinematics(x)
    there = here.copy()
    there[0, 3] += 0.01
    return hf.paths.TimedPath(hf.paths.line(here, there), hf.paths.Constant(1.0))


def best_path(arm, x):
    poses = along(arm, x).pose(np.linspace(0, 1, 3))
    return hf.solvers.best_path(arm, poses, lambda q: q[:, 0] ** 2, task="planar", starts=4)


CALLS = {
    "assessing poses": lambda arm, law, x: assess(arm, hf.Region.around_tool(arm, x)),
    "solving inverse kinematics": lambda arm, law, x: hf.solve_ik(arm, arm.forward_kinematics(x), task="planar"),
    "tracing self-motions": lambda arm, law, x: hf.self_motion(arm, [1.5, 1.5], "planar", starts=4),
    "simulating motions": lambda arm, law, x: hf.simulate(law, x, [1.5, 1.5]),
    "comparing control laws": lambda arm, law, x: hf.compare_laws([law], x, [1.5, 1.5], restarts=2),
    "computing the trade-off": lambda arm, law, x: hf.control.trade_off(arm, "planar", samples=10, allowed=[0, 0.5]),
    "looking for stationary points": lambda arm, law, x: hf.stationary_points(law, [1.5, 1.5], {1: 1.0}),
    "simulating the basins": lambda arm, law, x: hf.basins(law, [1.5, 1.5], {1: 1.0}, starts=4),
    "simulating failures": lambda arm, law, x: hf.convergence_map(law, 1, 2, configurations=1),
    "looking for the ranges of the joints": lambda arm, law, x: hf.joint_bounds(arm, [1.5, 1.5], "planar", starts=4),
    "planning the route": lambda arm, law, x: hf.recover(arm, "joint2", x, goal="home", samples=20),
    "optimising configurations": lambda arm, law, x: hf.optimise(arm, arm.forward_kinematics(x), wish(arm), starts=3),
    "following the path": lambda arm, law, x: hf.follow(arm, along(arm, x), maximise=wish(arm), q=x, samples=5),
    "looking for the best path": lambda arm, law, x: best_path(arm, x),
    "looking for configurations with a locked joint": lambda arm, law, x: hf.reachable_when_locked(
        arm, [1.5, 1.5], {"joint1": [0.5]}, task="planar"
    ),
    "mapping the reachable workspace": lambda arm, law, x: hf.reachability_map(arm, samples=100, cell_size=0.5),
    "explaining a pose without a solution": lambda arm, law, x: hf.explain_ik(arm, [3.5, 0], task="planar", starts=3),
    "measuring the failure-tolerant workspace": lambda arm, law, x: tolerant(arm),
    "executing the motion": lambda arm, law, x: hf.execute(arm, [x, x + 0.1], [0.0, 1.0]),
    "simulating the physics": lambda arm, law, x: hf.simulate_physics(law, x, [1.5, 1.5], time_limit=1.0),
    "simulating power losses": lambda arm, law, x: hf.power_loss(arm, x, duration=0.1),
    "simulating a fall in MuJoCo": lambda arm, law, x: FALL.physical(clearance=False),
}


@pytest.mark.parametrize("what", CALLS)
def test_what_is_named_is_what_was_asked_for(what, clock, monkeypatch):
    names = []

    class Noted(progress._RunningWork):
        def __init__(self, what):
            names.append(what)
            super().__init__(what)

    monkeypatch.setattr(progress, "_RunningWork", Noted)
    arm = hf.arms.load("planar-3r")
    CALLS[what](arm, hf.control.Pseudoinverse(arm, "planar"), np.array([0.3, 0.5, 0.7]))
    assert names == [what]
    assert progress._outer is None


class Running(Clock):
    """Nothing is quick: at each look it is later."""

    def __call__(self):
        self.now += 50.0
        return self.now


@pytest.mark.parametrize("what", CALLS)
def test_long_work_says_how_long_or_how_far(what, clock, said, monkeypatch):
    """Everything that takes long says something from which a person can tell whether to wait."""
    told = ProgressCount.add

    def add(self, count):
        told(self, count)
        if progress._outer is not None:
            progress._outer.print_if_due()

    monkeypatch.setattr(ProgressCount, "add", add)
    monkeypatch.setattr(progress, "_clock", Running())
    monkeypatch.setattr(progress, "MAX_SILENCE_S", 0.0)  # at each look
    arm = hf.arms.load("planar-3r")
    CALLS[what](arm, hf.control.Pseudoinverse(arm, "planar"), np.array([0.3, 0.5, 0.7]))
    lines = [line for line in said() if "compiling" not in line]
    assert all(line.startswith(f"holdfast: {what}") for line in lines)
    assert any(line.endswith(" more") or ", so far " in line for line in lines)
