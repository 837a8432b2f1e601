"""The state machines of the controller: the documented table, and random events that take its transitions."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import HoldfastError
from holdfast.response.diagnosis import FaultVerdict
from holdfast.response.supervisor import replanning, states
from holdfast.response.supervisor.controller import Controller

PAGE = Path(__file__).parents[3] / "docs/theory/fault-controller.md"
ARM = hf.arms.load("panda")
BOUNDS = SimpleNamespace(tracking=np.full(7, 1e-3), speed=np.full(7, 0.5))
KINDS = ("locked", "limp", "weak", "friction", "sluggish", "sensor", "unknown", "contact")
CONTROL_PERIOD_S = 0.01


def read_table(title):
    """Return the rows of the table in a section of the page, without code marks."""
    section = PAGE.read_text(encoding="utf-8").split(f"\n## {title}\n")[1].split("\n## ")[0]
    return [re.split(r" *\| *", line.strip("| ").replace("`", "")) for line in section.splitlines() if line.startswith("|")]


def test_the_documentation_shows_the_transitions_of_the_code():
    _, _, *rows = read_table("Transitions")
    transitions = [tuple(row) for row in rows if len(row) == 4]
    assert transitions == [tuple(transition) for transition in states.TRANSITION_TABLE]
    documented_events = {row[0] for row in rows if len(row) == 3} - {"event"}
    assert documented_events >= {transition.event for transition in states.TRANSITION_TABLE}


def test_the_documentation_shows_the_states_of_the_code():
    _, _, *rows = read_table("States")
    documented = {(machine, state) for machine, state, *_ in rows}
    assert documented == {(t.machine, name) for t in states.TRANSITION_TABLE for name in (t.source, t.target)}
    classes = states.MotionState.__args__ + states.SupervisionState.__args__ + states.TrialState.__args__
    assert sorted(name for _, name in documented) == sorted(state.__name__ for state in classes)


def test_a_transition_outside_the_table_is_an_error():
    machine = states.StateMachine("supervision", states.Watching())
    with pytest.raises(HoldfastError, match="no transition"):
        machine.enter(states.Braked("panda_joint1"), "joint braked")
    machine.enter(states.Alarmed(0.1), "alarm raised")
    assert machine.state.start_time == 0.1


class RandomLaw:
    """A masked law that fails, collides, and is predicted to fail at random."""

    def __init__(self, rng, is_in_cell):
        self.rng, self.arm, self.mask, self.pose = rng, ARM, np.ones(7), np.eye(4)
        self.whole, self.clearance = (
            SimpleNamespace(speed_limit=None),
            SimpleNamespace(others="the cell") if is_in_cell else None,
        )
        self.position_error, self.orientation_error = 1.0, 0.0

    def rates(self, q):
        self.position_error *= 0.999
        return self.rng.choice([0.0, 0.1, 1.0], p=[0.02, 0.49, 0.49]) * np.ones(7)

    def is_collision_free(self, q):
        return self.clearance is None or self.rng.random() > 0.01

    def predict_time_to_target(self, q, *, max_speeds):
        return np.where(self.rng.random(len(q)) < 0.4, 1.0, np.inf)


class RandomRoute:
    """A route that takes some control cycles."""

    waypoints, duration = 2, 1.0

    def __init__(self, cycles):
        self.remaining = cycles

    @property
    def is_finished(self):
        return self.remaining == 0

    def rates(self, q, *, pace, dt):
        self.remaining -= 1
        return np.full(7, 0.1 * pace)


@pytest.fixture
def taken(monkeypatch):
    """Counts of the transitions that are taken; routes are found at random."""
    counts, enter = Counter(), states.StateMachine.enter

    def count_transition(machine, state, event):
        counts[(machine.machine, type(machine.state).__name__, event, type(state).__name__)] += 1
        enter(machine, state, event)

    def plan_route(law, q, goal, failures, *, max_speeds):
        is_found = law.rng.random() < (0.3 if failures.locked else 0.8)
        return RandomRoute(int(law.rng.integers(1, 300))) if is_found else "no route"

    monkeypatch.setattr(states.StateMachine, "enter", count_transition)
    monkeypatch.setattr(replanning, "plan_route", plan_route)
    monkeypatch.setattr(
        replanning, "choose_intermediate_configuration", lambda law, q, **limits: q if law.rng.random() < 0.5 else None
    )
    return counts


def run_random_events(seed):
    """Send a controller control cycles, verdicts, tool poses, or known faults in a random order."""
    rng = np.random.default_rng([seed, 20])
    react = str(rng.choice(["chain", "chain", "stop", "known"]))
    law = RandomLaw(rng, bool(rng.random() < 0.3))
    ignore = SimpleNamespace(
        brake=lambda joint: None, release=lambda joint: None, rearm=lambda: None, exclude=lambda joint: None
    )
    controller = Controller(law, bounds=BOUNDS, brakes=ignore, monitor=ignore, react=react, plan=bool(rng.random() < 0.8))
    q, verdict = np.array([0.1, 0.4, 0.0, -1.5, 0.0, 1.5, 0.0]), FaultVerdict(False, 0.0)
    for cycle in range(1200):
        if controller.is_stopped and react != "known":
            break
        time = CONTROL_PERIOD_S * cycle
        if react == "known" and rng.random() < 0.01:
            controller.on_known_fault(time, "locked", str(rng.choice(ARM.joint_names)), 0.1)
        if rng.random() < 0.1:
            controller.on_tool_pose(time, q, ARM.forward_kinematics(q))
        rates = controller.rates(time, q)
        free_joints = [name for name, mask in zip(ARM.joint_names, law.mask, strict=True) if mask]
        if cycle % 80 == 0 and free_joints:
            kind = str(rng.choice(KINDS))
            joint = None if kind == "contact" or rng.random() < 0.1 else str(rng.choice(free_joints))
            verdict = FaultVerdict(bool(rng.random() < 0.6), 1.0, joint=joint, kind=kind, loss=0.3)
            tracking_error = np.full(7, rng.choice([0.0, 5e-4, 2e-3, 9e-3], p=[0.3, 0.2, 0.2, 0.3]))
        if react != "known" and (verdict.joint in free_joints or verdict.joint is None):
            signals = {"tracking_error": tracking_error, "v": rates, "commanded_rates": rates, "gravity": np.full(7, 1.0)}
            controller.on_verdict(time, verdict, **signals)


def test_random_events_take_every_transition_of_the_table_and_no_other(taken):
    for seed in range(60):
        run_random_events(seed)
    assert set(taken) == {tuple(transition) for transition in states.TRANSITION_TABLE}
