"""The chain: a joint fails, the monitor names it, the controller reacts, the tool reaches its target."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
from cells import placed
from holdfast.core.errors import HoldfastError, InputError
from holdfast.response.faults import FaultEvent
from holdfast.response.supervisor.masked_law import MaskedLaw
from holdfast.response.supervisor.replanning import candidate_configurations

pytest.importorskip("mujoco")
BODY = hf.Body(3)
START, GOAL = np.array([0.0, 0.0, 0.0, -1.5, 0.0, 1.5, 0.0]), np.array([0.3, 0.4, 0.6])
LOCKED = FaultEvent("locked", "panda_joint3", 0.5)


@pytest.fixture(scope="module")
def law():
    return hf.control.damped(hf.arms.load("panda"), 0.02, task="position", gain=2.0, speed_limit=0.25)


@pytest.fixture(scope="module")
def monitor(law):
    goals = GOAL + np.array([[0, 0, 0], [0.1, 0, -0.1], [0, -0.6, 0], [0, -0.2, 0.1]])
    logs = [hf.simulate_faults(law, START, goal, body=BODY, seed=k).require_ok().log() for k, goal in enumerate(goals)]
    return hf.diagnosis.Monitor(
        law.arm, hf.diagnosis.calibrate(law.arm, logs, factor=2.0, coulomb=[0.5] * 7, viscous=[0.3] * 7)
    )


def run(law, *faults, **options):
    return hf.simulate_faults(law, START, GOAL, faults=faults, body=BODY, seed=9, **options)


def test_a_masked_law_is_that_of_the_columns_left(law, rng):
    """Beside NumPy's least squares of the other columns, and the projection onto what they leave open."""
    arm, centring = law.arm, 0.3
    masked = MaskedLaw(law, GOAL, centring=centring)
    for _ in range(5):
        q = rng.uniform(0.8 * arm.lower, 0.8 * arm.upper)
        masked.mask = np.ones(7)
        masked.mask[rng.choice(7, 2, replace=False)] = 0
        error = GOAL - arm.forward_kinematics(q)[:3, 3]
        size = 2.0 * np.linalg.norm(error)
        v = 2.0 * error * min(1.0, 0.25 / size)
        j = arm.jacobian(q)[:3] * masked.mask
        inverse = j.T @ np.linalg.inv(j @ j.T + 0.02**2 * np.eye(3))
        pull = masked.mask * centring * ((arm.lower + arm.upper) / 2 - q)
        assert masked.rates(q) == pytest.approx(inverse @ (v - j @ pull) + pull, abs=1e-9)
        assert (masked.position_error, masked.orientation_error) == (pytest.approx(np.linalg.norm(error)), 0.0)
    at = arm.upper.copy()
    assert (masked.rates(at) <= 0).all()


def test_a_locked_joint_is_named_braked_and_left_out(law, monitor):
    fault = FaultEvent("locked", "panda_joint4", 0.5)
    blind, chain = run(law, fault), run(law, fault, monitor=monitor)
    assert (blind.actions, blind.detection_time) == ((), np.inf)
    assert [v.joint for v in chain.require_ok().verdicts] == ["panda_joint4"]
    assert 0 < chain.delay < 0.1
    brake = next(a for a in chain.actions if a.what == "brake")
    assert brake.joint == "panda_joint4"
    assert np.ptp(chain.q[chain.time > brake.time + 0.1, 3]) < 1e-4
    assert list(chain.degraded.locked) == ["panda_joint4"]
    true = np.linalg.norm(chain.poses[-200:, :3, 3] - GOAL, axis=1)
    assert (true < 5.1e-3).all()
    again = run(law, fault, monitor=monitor)
    assert chain.q_measured.tobytes() == again.q_measured.tobytes()


def test_a_weak_joint_goes_on_slowly_and_a_frozen_sensor_is_measured_by_the_tool(law, monitor):
    weak = run(law, FaultEvent("weak", "panda_joint2", 0.5, parameters={"gain": 0.3}), monitor=monitor).require_ok()
    assert [a.what for a in weak.actions][-1] in ("slow", "brake")
    fault = FaultEvent("sensor_freeze", "panda_joint4", 0.5)
    with pytest.raises(HoldfastError, match="did not reach its target"):
        run(law, fault, time_limit=3.0).require_ok()
    frozen = run(law, fault, monitor=monitor).require_ok()
    assert [a.what for a in frozen.actions if a.joint][-2:] == ["brake", "measure"]
    assert frozen.degraded.locked["panda_joint4"] == pytest.approx(frozen.q[-1, 3], abs=3e-3)


def test_everything_stops_and_what_is_known_at_once(law, monitor):
    fault = FaultEvent("limp", "panda_joint2", 0.5)
    stopped = run(law, fault, monitor=monitor, react="stop", time_limit=4.0)
    assert (stopped.outcome, [a.what for a in stopped.actions]) == ("stopped", ["alarm", "stop"])
    known = run(law, fault, react="known")
    assert [a.time for a in known.actions][:2] == pytest.approx([0.5, 0.5])
    assert np.ptp(known.q[known.time > 0.6, 1]) < 1e-4
    assert known.places[1] == pytest.approx(known.q[500, 1], abs=1e-3)


def test_where_the_law_would_end_off_its_target_it_goes_by_another_posture_or_along_a_route(law, monkeypatch):
    start, goal = [-2.05, -0.14, 1.13, -1.12, -0.88, 0.52, 1.94], [-0.125, -0.026, 0.623]
    options = {"faults": [FaultEvent("locked", "panda_joint3", 0.3)], "body": BODY, "react": "known"}
    detour = hf.simulate_faults(law, start, goal, plan=False, **options).require_ok()
    assert [a.what for a in detour.actions] == ["alarm", "brake", "detour"]
    monkeypatch.setattr(
        "holdfast.response.supervisor.replanning.choose_intermediate_configuration", lambda *args, **given: None
    )
    alone = hf.simulate_faults(law, start, goal, plan=False, **options)
    assert (alone.outcome, [a.what for a in alone.actions]) == ("missed", ["alarm", "brake"])
    assert alone.position_error[-1] > 0.02
    route = hf.simulate_faults(law, start, goal, **options).require_ok()
    assert [a.what for a in route.actions] == ["alarm", "brake", "plan"]
    for run in (detour, route):
        assert (run.q >= law.arm.lower - 5e-3).all()
        assert (run.q <= law.arm.upper + 5e-3).all()


@pytest.fixture(scope="module")
def ball(law):
    """A cell with a ball where the tool passes on its way, if nobody looks out for it."""
    passed = run(law, LOCKED, react="known").poses[:, :3, 3]
    gone = np.cumsum(np.linalg.norm(np.diff(passed, axis=0, prepend=passed[:1]), axis=1))
    return hf.Cell([hf.cell.Sphere("ball", 0.04, pose=placed(*passed[np.searchsorted(gone, 0.6 * gone[-1])]))])


def test_after_a_brake_the_arm_keeps_clear_of_a_cell(law, ball, monkeypatch):
    blind = run(law, LOCKED, react="known").require_ok()
    detour = run(law, LOCKED, react="known", cell=ball, plan=False).require_ok()
    assert [a.what for a in detour.actions] == ["alarm", "brake", "detour"]
    assert "the law would miss the target or touch the cell" in detour.actions[-1].why
    monkeypatch.setattr(
        "holdfast.response.supervisor.replanning.choose_intermediate_configuration", lambda *args, **given: None
    )
    route, stopped = (run(law, LOCKED, react="known", cell=ball, plan=plan) for plan in (True, False))
    assert [a.what for a in route.require_ok().actions] == ["alarm", "brake", "plan"]
    assert (stopped.outcome, stopped.actions[-1].why) == ("stopped", "no intermediate configuration helps")
    for kept in (detour, route, stopped):
        assert detour.clearance.sign(kept.q[::10]).all()  # of the meshes, by another library
        assert kept.contacts == ()
        assert "The arm touched nothing." in kept.describe()
    touched = replace(blind, clearance=detour.clearance)
    assert not detour.clearance.sign(blind.q[::10]).all()
    assert {contact.object for contact in touched.contacts} == {"ball"}
    first = next(t for t, q in zip(blind.time, blind.q, strict=True) if detour.clearance(q) <= 0)
    assert touched.contacts[0].time == pytest.approx(first, abs=2e-3)
    assert any("touches ball" in line for line in touched.describe())


def test_what_already_touches_something_stops(law, ball):
    at = hf.Cell([hf.cell.Sphere("wall", 0.2, pose=placed(*law.arm.forward_kinematics(START)[:3, 3]))])
    stuck = run(law, LOCKED, react="known", cell=at)
    assert (stuck.outcome, stuck.actions[-1].what) == ("stopped", "stop")
    assert stuck.contacts[0].time == 0


@pytest.mark.parametrize("task", ["position", "pose"])
def test_a_law_that_is_followed_ahead_ends_where_its_single_steps_do(task, rng):
    arm = hf.arms.load("iiwa14")
    law = hf.control.damped(arm, 0.02, task=task, gain=2.0, speed_limit=0.25)
    most = np.array([joint.velocity for joint in arm.joints])
    q, ends = rng.uniform(0.9 * arm.lower, 0.9 * arm.upper, (12, arm.n)), []
    there = arm.forward_kinematics(rng.uniform(0.9 * arm.lower, 0.9 * arm.upper))
    masked = MaskedLaw(law, there if task == "pose" else there[:3, 3], centring=0.15)
    masked.mask[2] = 0
    for row in q:
        at, takes, nearest, since = row.copy(), np.inf, np.inf, 0.0
        for time in 0.05 * np.arange(240):
            rates = masked.rates(at)
            off = masked.position_error + masked.orientation_error
            nearest, since = (off, time) if off < nearest - 1e-3 else (nearest, since)
            if off < 2e-3 or time - since > 1.5:
                takes = time if off < 2e-3 else np.inf
                break
            slower = max(1.0, (np.abs(rates) / most).max())
            at = np.clip(at + 0.05 * rates / slower, arm.lower + 2e-3, arm.upper - 2e-3)
        ends.append(takes)
    assert np.isfinite(ends).any()
    assert np.isinf(ends).any()
    np.testing.assert_allclose(masked.predict_time_to_target(q, max_speeds=most), ends)


def test_postures_of_a_detour_leave_braked_joints_alone_and_a_joint_without_limits_turns_either_way():
    arm, q = hf.arms.load("kinova-j2s6s200"), np.linspace(1.0, 4.0, 6)
    mask = np.where(np.arange(6) == 4, 0.0, 1.0)
    found = candidate_configurations(arm, q, mask)
    bounded = np.isfinite(arm.lower) & np.isfinite(arm.upper)
    middle = np.array([(low + high) / 2 if np.isfinite(high) else 0.0 for low, high in zip(arm.lower, arm.upper, strict=True)])
    assert (found[:, 4] == q[4]).all()
    np.testing.assert_allclose(found[3, bounded & (mask > 0)], middle[bounded & (mask > 0)])
    moved = [tuple(np.flatnonzero(row != q)) for row in found[4:]]
    assert moved == [(j,) for j in np.flatnonzero(mask) for _ in range(2)]
    for one, other in zip(found[4::2], found[5::2], strict=True):
        (j,) = np.flatnonzero(other != q)
        expected = (middle[j], 2 * middle[j] - q[j]) if bounded[j] else (q[j] - np.pi / 2, q[j] + np.pi / 2)
        assert (one[j], other[j]) == pytest.approx(expected)


def test_a_healthy_run_as_a_record_is_its_own_measurement(law):
    healthy = run(law)
    log, seen = healthy.log(), np.isfinite(healthy.x[:, 0])
    assert (healthy.delay, seen[:21].nonzero()[0].tolist()) == (np.inf, [0, 10, 20])
    assert np.abs(log.x[seen] - healthy.poses[seen, :3, 3]).max() < 6 * BODY.position
    assert np.std(healthy.q_measured - healthy.q) == pytest.approx(BODY.joint, rel=0.05)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"react": "chain"}, "needs a monitor"),
        ({"time_limit": 0.0}, "time_limit is 0"),
        ({"centring": -1.0}, "centring is -1"),
        ({"faults": [FaultEvent("locked", "elbow", 0.1)]}, "the joints are panda_joint1"),
    ],
)
def test_bad_input(law, options, words):
    with pytest.raises(InputError, match=words):
        hf.simulate_faults(law, START, GOAL, **options)


def test_bodies():
    with pytest.raises(InputError, match="below 1"):
        hf.Body(mismatch=1.0)
    with pytest.raises(InputError, match="coulomb of the body is -1"):
        hf.Body(coulomb=-1.0)


def test_lock_times_of_drawn_faults_in_the_kinematic_loop(law):
    faults = hf.faults.FaultModel([hf.faults.locked(onset=(0.2, 2.0), probability=0.7)], seed=4)
    batch = faults.batch(law.arm, episodes=4)
    runs = hf.simulate(law, np.tile(START, (4, 1)), GOAL, faults=batch)
    for k, events in enumerate(batch.episodes):
        one = hf.simulate(law, START, GOAL, locked=[e.joint for e in events], time=[e.onset for e in events] or 0.0)
        assert runs.q_final[k] == pytest.approx(one.q_final, abs=1e-9)
        assert hf.simulate(law, START, GOAL, faults=events).q_final.tolist() == one.q_final.tolist()
    with pytest.raises(InputError, match="it needs bodies and motors"):
        hf.simulate(law, START, GOAL, faults=hf.faults.FaultModel([hf.faults.limp(onset=1.0)]).draw(law.arm))
    with pytest.raises(InputError, match="leave one of them out"):
        hf.simulate(law, START, GOAL, locked=["panda_joint1"], faults=batch)
