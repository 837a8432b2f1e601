"""Self-motions that tell joints apart: what they can show against the indices, and what is decided from the pose alone."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import holdfast as hf
from cards import check_card
from holdfast.core.errors import InputError
from holdfast.response.faults import Log

POSE = (0.5e-3, 1e-3)  # m, rad


@pytest.fixture(scope="module")
def panda():
    return hf.arms.load("panda")


@pytest.fixture(scope="module")
def probe(panda):
    return hf.diagnosis.plan_identification(panda, [0.0, -0.4, 0.3, -2.0, 0.2, 1.8, 0.5])


def measured(arm, plan, locked, rng):
    """What a pose sensor tells while a joint, or none, does not follow."""
    true = plan.q.copy()
    if locked is not None:
        true[:, locked] = true[0, locked]
    poses = arm.forward_kinematics(true)
    noise = Rotation.from_rotvec(rng.normal(0, POSE[1], (len(true), 3)))
    quat = (noise * Rotation.from_matrix(poses[:, :3, :3])).as_quat()
    x = poses[:, :3, 3] + rng.normal(0, POSE[0], (len(true), 3))
    return Log(t=plan.t, q_ref=plan.q, q=plan.q, x=x, quat=quat)


@pytest.mark.parametrize("task", ["pose", "position"])
def test_visible_is_tolerable(task, panda, rng):
    """The theorem: the largest rate of a joint over unit self-motions is the relative manipulability of its lock."""
    q = rng.uniform(panda.lower, panda.upper, (50, 7))
    shown = hf.diagnosis.self_motion_rates(panda, q, task)
    for i in range(7):
        index = hf.indices.relative_manipulability(panda, task, failures=[i])
        assert shown[:, i] == pytest.approx(index(q), abs=1e-9)


def test_no_self_motion_shows_more(panda, rng):
    """Against null vectors found another way: random rates less what moves the tool."""
    q = rng.uniform(panda.lower, panda.upper)
    jacobian = panda.jacobian(q)[:3]
    rates = rng.normal(size=(20_000, 7))
    rates -= (np.linalg.pinv(jacobian) @ (jacobian @ rates.T)).T
    found = np.abs(rates / np.linalg.norm(rates, axis=1, keepdims=True)).max(axis=0)
    shown = hf.diagnosis.self_motion_rates(panda, q, "position")
    assert (found <= shown + 1e-9).all()
    assert found == pytest.approx(shown, rel=0.05)


def test_the_elbow_is_invisible_for_ever(rng):
    arm = hf.arms.load("iiwa14")
    shown = hf.diagnosis.self_motion_rates(arm, rng.uniform(arm.lower, arm.upper, (40, 7)))
    assert shown[:, 3].max() < 1e-9
    found = hf.diagnosis.plan_identification(arm, [0.0, 0.4, 0.3, -1.0, 0.2, 0.8, 0.5])
    assert found.untestable == (arm.joint_names[3],)
    assert "no self-motion moves it here; its lock is not tolerable here either" in found.describe()[1]


def test_every_testable_lock_is_found_and_no_other_is(panda, probe, rng):
    assert set(probe.isolable) == set(panda.joint_names)
    poses = panda.forward_kinematics(probe.q)
    assert np.linalg.norm(poses[:, :3, 3] - poses[0, :3, 3], axis=1).max() <= probe.tool + 1e-12 < 1e-4
    for i, name in enumerate(panda.joint_names):
        found = probe.decide(measured(panda, probe, i, rng))
        assert found.joint == name
        assert found.remaining == (name,)
        assert found.displacement < 0.012
    healthy = probe.decide(measured(panda, probe, None, rng))
    assert (healthy.joint, healthy.remaining) == (None, ("none",))
    assert set(healthy.cleared) <= set(panda.joint_names)
    assert not any("healthy" in line for line in healthy.describe())


def test_what_is_predicted_is_what_is_measured(panda, probe, rng):
    """The separation of two hypotheses is the mean of half the difference of their squares, by brute force."""
    weight = np.repeat(1 / np.hypot(POSE, 5 * np.array([0.5e-3, 1e-3])), 3)
    for i, j in ((0, 2), (3, 5)):
        motions = [probe.q.copy(), probe.q.copy()]
        for motion, k in zip(motions, (i, j), strict=True):
            if k:
                motion[:, k - 1] = motion[0, k - 1]
        a, b = map(panda.forward_kinematics, motions)
        turn = Rotation.from_matrix(b[:, :3, :3] @ a[:, :3, :3].transpose(0, 2, 1)).as_rotvec()
        error = np.c_[b[:, :3, 3] - a[:, :3, 3], turn] * weight
        assert probe.separation[i, j] == pytest.approx((error**2).sum() / 2, rel=1e-9)
    assert np.array_equal(probe.separation, probe.separation.T)


def test_a_lock_that_is_not_seen_stays_undecided(panda, probe, rng):
    log = measured(panda, probe, 3, rng)
    short = Log(t=log.t[:30], q_ref=log.q_ref[:30], q=log.q[:30], x=log.x[:30], quat=log.quat[:30])
    found = probe.decide(short)
    assert found.joint is None
    assert {"none", "panda_joint4"} <= set(found.remaining)
    assert found.describe()[0].startswith("Not decided after 0.29 s")


def test_a_motion_that_keeps_a_joint_still_does_not_show_it(panda, probe):
    still = probe.q.copy()
    still[:, 4] = still[0, 4]
    assert hf.diagnosis.predict_detection(panda, still, rate=100.0).unseen == ("panda_joint5",)


def test_a_notebook_shows_them(rng):
    arm = hf.arms.load("planar-3r")
    plan = hf.diagnosis.plan_identification(arm, [0.3, 0.5, 0.7], task="planar", suspects=[0, 1])
    check_card(plan, True)
    check_card(hf.diagnosis.predict_detection(arm, plan.q, rate=100.0), True)
    check_card(plan.decide(measured(arm, plan, None, rng)), False)


def test_delays_are_those_of_the_filters_step_by_step(panda, rng):
    """Against a loop over the difference equations, for one joint."""
    log = hf.diagnosis.simulate_log(panda, 1.0, seed=4)
    bounds = hf.diagnosis.calibrate(panda, [log, log])
    told = hf.diagnosis.expected_delays(bounds, log.q_ref, stiffness=np.full(7, 400.0), damping=np.full(7, 20.0), onset=0.5)
    dt, rates = 1e-3, np.gradient(log.q_ref, 1e-3, axis=0)
    for i in range(7):
        torque = residual = over = far = 0.0
        for k in range(501, len(log.t)):
            behind = log.q_ref[k, i] - log.q_ref[500, i]
            torque += 2 * np.pi * 20 * dt * (400 * behind + 20 * rates[k, i] - torque)
            residual += 40 * dt * (torque - residual)
            over = max(0.0, over + (abs(residual) / bounds.torque[i] - 1) * dt)
            far = max(0.0, far + (abs(behind) / bounds.tracking[i] - 1) * dt)
            if over > 0.010 or far > 0.020:
                break
        assert told[i] == pytest.approx((k - 500) * dt, abs=1.01e-3)


def test_what_cannot_be_asked(panda, probe, rng):
    with pytest.raises(InputError, match="has no redundancy for task 'pose'"):
        hf.diagnosis.plan_identification(hf.arms.load("ur5"), np.zeros(6))
    log = measured(panda, probe, 1, rng)
    with pytest.raises(InputError, match="the log has no measured pose"):
        probe.decide(Log(t=log.t, q_ref=log.q_ref, q=log.q))
    late = np.where(np.arange(len(log.t))[:, None] < 40, np.nan, log.x)
    with pytest.raises(InputError, match="begin the log at rest"):
        probe.decide(Log(t=log.t, q_ref=log.q_ref, q=log.q, x=late, quat=log.quat))
    with pytest.raises(InputError, match=r"they must be above 0\.6"):
        hf.diagnosis.plan_identification(panda, probe.q[0], duration=0.5)
