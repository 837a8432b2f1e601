"""What follows from each verdict, one after the other, without a robot."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

import holdfast as hf
from holdfast.response.diagnosis import FaultVerdict
from holdfast.response.supervisor.controller import Controller
from holdfast.response.supervisor.masked_law import MaskedLaw
from holdfast.response.supervisor.replanning import plan_route

JOINTS = hf.arms.load("panda").joint_names
BOUNDS = SimpleNamespace(tracking=np.full(7, 1e-3), speed=np.full(7, 0.5))


class Robot:
    """Brakes and a monitor that are only counted."""

    def __init__(self, react="chain", rates=0.1, plan=False):
        self.braked, self.released, self.left, self.rearmed, arm = [], [], [], 0, hf.arms.load("panda")
        law = SimpleNamespace(
            mask=np.ones(7), rates=lambda q: np.full(7, rates), position_error=1.0, orientation_error=0.0, pose=None
        )
        law.predict_time_to_target, law.arm = (
            lambda q, max_speeds: np.full(len(q), np.inf),
            arm,
        )  # it ends elsewhere, wherever it begins
        law.whole, law.clearance, law.is_collision_free = SimpleNamespace(arm=arm, speed_limit=None), None, lambda q: True
        self.controller = Controller(law, bounds=BOUNDS, brakes=self, monitor=self, react=react, plan=plan)

    def brake(self, joint):
        self.braked.append(joint)

    def release(self, joint):
        self.released.append(joint)

    def rearm(self):
        self.rearmed += 1

    def exclude(self, joint):
        self.left.append(joint)

    def hear(self, time, *, behind=0.0, v=0.1, wanted=0.1, gravity=0.0, alarm=True, **verdict):
        told = {"joint": JOINTS[1], "candidates": (), **verdict}
        rows = {
            name: np.full(7, x)
            for name, x in (("tracking_error", behind), ("v", v), ("commanded_rates", wanted), ("gravity", gravity))
        }
        self.controller.on_verdict(time, FaultVerdict(alarm, 1.0, **told), **rows)

    def did(self):
        return [action.what for action in self.controller.actions]


@pytest.mark.parametrize("kind", ["locked", "limp", "standstill", "sensor"])
def test_what_stops_a_joint_is_braked(kind):
    robot = Robot()
    robot.hear(1.0, kind=kind)
    assert (robot.braked, robot.did()) == ([JOINTS[1]], ["alarm", "brake"])
    assert robot.controller.law.mask.tolist() == [1, 0, 1, 1, 1, 1, 1]


def test_after_a_brake_the_others_are_watched_on_and_a_second_fault_is_reacted_to():
    robot = Robot()
    robot.hear(1.0, kind="locked")
    robot.hear(1.04, kind="limp", joint=JOINTS[3])  # the arm waits: what is seen now is of the brake
    assert (robot.braked, robot.left) == ([JOINTS[1]], [])
    robot.hear(1.06, kind="locked")
    assert robot.left == [JOINTS[1]]
    robot.hear(3.0, joint=JOINTS[3])
    robot.hear(3.1, kind="limp", joint=JOINTS[3])
    assert (robot.did(), robot.braked) == (["alarm", "brake"] * 2, [JOINTS[1], JOINTS[3]])
    assert robot.controller.law.mask.tolist() == [1, 0, 1, 0, 1, 1, 1]
    robot.hear(3.2, kind="limp", joint=JOINTS[3])
    assert (robot.left, robot.controller.pace) == ([JOINTS[1], JOINTS[3]], 1.0)
    assert [(v.joint, v.kind) for v in robot.controller.verdicts] == [(JOINTS[1], "locked"), (JOINTS[3], "limp")]


def test_after_a_joint_was_slowed_for_good_a_push_leaves_the_pace_as_it_was():
    robot = Robot()
    for time in (1.0, 1.7):
        robot.hear(time, kind="friction")
    assert (robot.left, robot.braked) == ([JOINTS[1]], [])
    robot.hear(2.0, kind="contact", joint=None)
    assert robot.controller.pace == 0.3
    robot.hear(3.1, kind="contact", joint=None)
    assert (robot.did()[-1], robot.controller.pace) == ("resume", 0.5)


@pytest.mark.parametrize(
    ("found", "what"),
    [
        ({"behind": 2e-3, "v": 0.0}, "brake"),  # it does not move
        ({"behind": 9e-3, "v": 0.5}, "brake"),  # it runs away
        ({"behind": 2e-3, "v": -0.5}, "brake"),  # it falls, and its servo does what it can
        ({"behind": 1e-3, "v": -0.5}, "slow"),
        ({"behind": 2e-3, "v": 0.5}, "slow"),
        ({"behind": 0.5e-3, "v": 0.0}, "slow"),
        ({"behind": 9e-3, "v": 0.15}, "slow"),
    ],
)
def test_at_once_where_the_kind_is_not_known(found, what):
    robot = Robot()
    robot.hear(1.0, **found)
    assert robot.did() == ["alarm"]  # 20 ms are given to the joint's name
    robot.hear(1.02, **found)
    assert robot.did() == ["alarm", what]


def test_a_weak_joint_is_slowed_and_braked_if_it_cannot_carry_the_arm():
    """87 N m of effort: a tenth carries 7 N m with a fifth more, and not 8."""
    for gravity, expected in ((7.0, "slow"), (8.0, "brake")):
        robot = Robot()
        robot.hear(1.0, kind="weak", loss=0.9, gravity=gravity)
        assert robot.did() == ["alarm", expected]
    robot = Robot()
    robot.hear(1.0, kind="sluggish", gravity=50.0)
    robot.hear(1.1, kind="sluggish", gravity=50.0)
    assert (robot.did(), robot.controller.pace) == (["alarm", "slow"], 0.5)
    robot.hear(1.3, kind="sensor")  # the tool's pose tells more
    assert robot.braked == [JOINTS[1]]


def test_a_push_slows_the_arm_for_a_second_and_blames_nobody():
    robot = Robot()
    robot.hear(1.0, kind="contact", joint=None)
    robot.hear(1.5, kind="contact", joint=None)
    assert (robot.did(), robot.controller.pace) == (["alarm", "slow"], 0.3)
    robot.hear(2.01, kind="contact", joint=None)
    assert (robot.did()[-1], robot.controller.pace, robot.rearmed, robot.braked) == ("resume", 1.0, 1, [])


def test_a_joint_that_stays_unknown_stops_the_arm_and_so_does_any_alarm_without_a_chain():
    robot = Robot()
    robot.hear(1.0, kind="sensor", joint=None)
    robot.hear(3.1, kind="sensor", joint=None)
    assert (robot.did(), robot.controller.is_stopped) == (["alarm", "stop"], True)
    stopped = Robot(react="stop")
    stopped.hear(1.0)
    assert (stopped.did(), stopped.braked) == (["alarm", "stop"], [])


def test_rates_are_smooth_within_limits_and_slow_towards_the_ends_of_the_range():
    robot, arm = Robot(rates=50.0), hf.arms.load("panda")
    middle = (arm.lower + arm.upper) / 2
    rates = np.array([robot.controller.rates(k * 1e-3, middle) for k in range(600)])
    assert np.abs(np.diff(rates, axis=0)).max() <= 10.0 * 1e-3 + 1e-12
    assert rates[-1] == pytest.approx(min(joint.velocity for joint in arm.joints))
    near = robot.controller.rates(0.6, arm.upper - 0.05)
    for k in range(601, 900):
        near = robot.controller.rates(k * 1e-3, arm.upper - 0.05)
    assert near == pytest.approx(np.sqrt(2 * 10.0 * 0.05))


def test_a_joint_on_trial_that_is_as_fast_as_it_can_is_given_time(monkeypatch):
    route = SimpleNamespace(waypoints=2, duration=1.0, is_finished=False, rates=lambda q, pace, dt: np.zeros(7))
    monkeypatch.setattr(
        "holdfast.response.supervisor.replanning.plan_route", lambda *args, max_speeds: "no route" if args[3].locked else route
    )
    robot = Robot(rates=0.0, plan=True)
    robot.hear(1.0, kind="limp", v=0.05, wanted=0.1)
    for time in (3.0, 3.1):
        robot.controller.rates(time, np.zeros(7))
    assert (robot.did()[-1], robot.controller.pace) == ("plan", 0.2)
    for behind, v, pace in (
        (1.4e-3, 0.15, 0.2),
        (1.6e-3, 0.35, 0.2),
        (1.6e-3, -0.15, 0.2),
        (1.6e-3, 0.09, 0.2),
        (1.6e-3, 0.15, 0.08),
    ):
        robot.hear(3.2, alarm=False, behind=behind, v=v, wanted=0.3)
        assert robot.controller.pace == pytest.approx(pace)
    assert robot.controller.law.mask[1] == 1


def test_what_is_left_of_the_law_is_left_before_something_is_near():
    """Each cycle asks where the arm is after twice the way that it takes to stop at 10 rad/s^2; before a brake none does."""
    robot = Robot(rates=0.3)
    law, asked = robot.controller.law, []
    law.clearance = SimpleNamespace(others="the cell")
    law.predict_time_to_target = lambda q, max_speeds: np.full(
        len(q), 0.0 if len(q) == 1 else np.inf
    )  # it would end well; no posture does
    law.is_collision_free = lambda q: asked.append(q) or bool(q.max() < 0.105)
    for k in range(500):
        robot.controller.rates(1e-3 * k, np.full(7, 0.1))
    assert not asked
    robot.hear(0.5, kind="locked")
    sent = np.array([robot.controller.rates(0.5 + 1e-3 * k, np.full(7, 0.1)) for k in range(600)])
    assert robot.did() == ["alarm", "brake", "stop"]
    assert robot.controller.actions[-1].why == "no intermediate configuration helps"
    after = sent[100:]  # it has stopped after the brake, goes on, and stops again
    assert after.max() == pytest.approx(np.sqrt(0.005 * 10), abs=2e-3)
    assert (sent[-1] == 0).all()


@pytest.mark.parametrize("falls", [True, False])
@pytest.mark.parametrize("at_a_stop", [True, False])
def test_a_braked_joint_without_which_there_is_no_route_is_tried_once_slowly(monkeypatch, at_a_stop, falls):
    """At a stop, or slow, a joint looks as one that drives nothing."""
    asked, q, arm = [], np.array([0.1, 0.4, 0.0, -1.5, 0.0, 1.5, 0.0]), hf.arms.load("panda")

    def some(law, q, target, left, max_speeds):
        asked.append(left)
        if left.locked or (left.ranges[JOINTS[1]][1] < arm.upper[1] and not at_a_stop):
            return "no route"
        return SimpleNamespace(waypoints=2, duration=1.0, is_finished=False, rates=lambda q, pace, dt: np.zeros(7))

    monkeypatch.setattr("holdfast.response.supervisor.replanning.plan_route", some)
    robot = Robot(rates=0.0, plan=True)
    for time in (1.0, 1.2):
        robot.hear(time, kind="limp", v=0.05, wanted=0.1)
    robot.controller.rates(3.0, q)
    assert (robot.did(), robot.released) == (["alarm", "brake", "release", "plan"], [JOINTS[1]])
    tries = [({}, {JOINTS[1]: (arm.lower[1], end)}) for end in ((0.4,) if at_a_stop else (0.4, arm.upper[1]))]
    assert [(dict(left.locked), dict(left.ranges)) for left in asked] == [({JOINTS[1]: 0.4}, {}), *tries]
    assert robot.controller.pace == 0.2
    robot.hear(3.5, alarm=False, behind=7.9e-3)
    assert robot.controller.law.mask[1] == 1
    if falls:  # its servo is at its effort, so its reference stays near
        for k in range(1, 40):
            robot.hear(3.5 + 1e-3 * k, alarm=False, behind=3e-3, v=0.1, wanted=-0.1)
            assert robot.controller.law.mask[1] == 1
        for k in range(40, 42):
            robot.hear(3.5 + 1e-3 * k, alarm=False, behind=3e-3, v=0.1, wanted=-0.1)
    else:
        robot.hear(3.6, alarm=False, behind=-8.1e-3)
    assert (robot.did()[-2:], robot.controller.is_stopped, robot.controller.law.mask[1]) == (["brake", "stop"], True, 0)
    assert robot.braked == [JOINTS[1]] * 2


def test_a_joint_whose_sensor_is_wrong_is_not_tried(monkeypatch):
    monkeypatch.setattr("holdfast.response.supervisor.replanning.plan_route", lambda *args, **options: "no route")
    robot = Robot(react="known", rates=0.0, plan=True)
    robot.controller.on_known_fault(1.0, "sensor_freeze", JOINTS[1], 0.3)
    robot.controller.rates(3.0, np.zeros(7))
    assert (robot.did()[-1], robot.released) == ("stop", [])


def test_a_route_is_run_through_at_its_pace_and_slowed_down_keeps_to_its_line():
    arm = hf.arms.load("panda")
    law = MaskedLaw(hf.control.damped(arm, 0.02, speed_limit=0.25), np.eye(4), centring=0.0)
    q = np.array([0.2, 0.3, 0.1, -1.6, 0.4, 1.5, 0.3])
    goal = arm.forward_kinematics(q + np.array([0.5, -0.3, 0.4, 0.0, 0.6, 0.2, -0.4]))
    lines = []
    limits = np.array([joint.velocity for joint in arm.joints])
    for pace, most in ((1.0, limits), (0.4, limits), (1.0, np.full(7, 0.1))):
        route, here, line = plan_route(law, q, goal, hf.Degraded(arm, locked={3: q[3]}), max_speeds=most), q, [q]
        while not route.is_finished:
            here = here + 2e-3 * route.rates(here, pace=pace, dt=2e-3)
            line.append(here)
        lines.append(np.array(line))
        seconds = 2e-3 * (len(line) - 1)
        assert seconds == pytest.approx(route.duration / pace, rel=0.02)
        tool = np.linalg.norm(np.diff(arm.forward_kinematics(lines[-1])[:, :3, 3], axis=0), axis=1) / 2e-3
        rates = np.abs(np.diff(lines[-1], axis=0)) / 2e-3
        assert 0.2 * pace < tool.max() < 0.26 * pace if most is limits else 0.09 < rates.max() < 0.105
        assert arm.forward_kinematics(here) == pytest.approx(goal, abs=2e-3)
    for other in lines[1:]:
        near = np.abs(lines[0][:, None, :] - other[None, ::5, :]).max(axis=2).min(axis=1)
        assert near.max() < 0.02
