"""The errors of a run in millimetres and degrees against SciPy's integrator and rotations."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast.control.simulation.errors import error_history


def test_the_errors_after_a_lock_are_those_of_an_independent_integration(rng):
    """A Panda with a pose task, joint 4 locked on the way; the orientation error by SciPy."""
    arm = hf.arms.load("panda")
    law = hf.control.pseudoinverse(arm, "pose")
    start = np.array([0.0, -0.5, 0.0, -2.0, 0.0, 1.6, 0.8])
    target = arm.forward_kinematics(start + rng.uniform(-0.4, 0.4, 7))
    runs = hf.simulate(law, start, target, locked=[3], time=0.8, time_limit=30.0)
    history = error_history(runs)

    def parts(q):
        pose = arm.forward_kinematics(q)
        return pose, target[:3, 3] - pose[:3, 3], Rotation.from_matrix(target[:3, :3] @ pose[:3, :3].T).as_rotvec()

    def rates(t, q):
        _, linear, angular = parts(q)
        return np.where((np.arange(7) == 3) & (t >= 0.8), 0, np.linalg.pinv(arm.jacobian(q)) @ np.r_[linear, angular])

    before = solve_ivp(rates, (0, 0.8 - 1e-12), start, "DOP853", rtol=1e-10, atol=1e-12).y[:, -1]
    after = solve_ivp(rates, (0.8, 12), before, "DOP853", rtol=1e-10, atol=1e-12, dense_output=True).sol
    for error in history.later[:2]:
        _, linear, angular = parts(after(error.time))
        assert error.position == pytest.approx(np.linalg.norm(linear), abs=1e-7)
        assert error.angle == pytest.approx(np.linalg.norm(angular), abs=1e-7)
    assert [error.time for error in history.later[:2]] == pytest.approx([1.8, 10.8])
    time = np.linspace(0.8, 12, 2001)
    errors = np.array([[np.linalg.norm(x) for x in parts(after(t))[1:]] for t in time])
    known = ((history.largest_position, "position", 0), (history.largest_angle, "angle", 1))
    for found, kind, column in known:
        if found.time <= 12:
            k = int(np.argmax(errors[:, column]))
            assert getattr(found, kind) == pytest.approx(errors[k, column], rel=1e-4)
            assert getattr(found, kind) >= errors[:, column].max() - 1e-7


def test_a_run_at_rest_keeps_its_error_and_one_under_way_has_none_later():
    arm = hf.arms.load("planar-2r")
    law = hf.control.pseudoinverse(arm, "planar")
    stuck = hf.simulate(law, np.deg2rad([0.0, -30.0]), [0.0, 3**0.5], locked=[0])
    history = error_history(stuck)
    assert stuck.outcome == "stuck"
    assert stuck.time < 60
    assert [error.time for error in history.later] == [1, 10, 60]
    assert history.later[-1].position == pytest.approx(float(stuck.error), abs=1e-9)
    assert history.end.angle == 0
    short = hf.simulate(law, np.deg2rad([0.0, -30.0]), [0.0, 3**0.5], locked=[0], time_limit=5.0)
    assert [error.time for error in error_history(short).later] == [1]


@pytest.mark.parametrize(("name", "task", "joint"), [("panda", "position", 3), ("planar-3r", "planar", 1)])
def test_the_deviation_from_the_line_is_that_of_an_independent_integration(rng, name, task, joint):
    arm = hf.arms.load(name)
    law = hf.laws.by_name("pseudoinverse", arm, task=task, gain=2.0, speed_limit=0.25)
    start = oracles.inside(arm, rng, 1)[0]
    near = np.clip(start + rng.uniform(-0.5, 0.5, (3, arm.n)), arm.lower, arm.upper)
    targets = arm.forward_kinematics(near)[:, :3, 3]
    runs = hf.simulate(law, start, targets @ law.task.rows[:, :3].T, locked=[joint])
    rows = law.task.rows[:, :3]

    def rates(t, q, target):
        error = rows @ (target - arm.forward_kinematics(q)[:3, 3])
        speed = min(2.0, 0.25 / np.linalg.norm(error))
        return np.where(np.arange(arm.n) == joint, 0, np.linalg.pinv(rows @ arm.jacobian(q)[:3]) @ (speed * error))

    for k, target in enumerate(targets):
        motion = solve_ivp(
            rates, (0, 5), start, "DOP853", rtol=1e-9, atol=1e-11, args=(target,), t_eval=np.linspace(0, 5, 4001)
        )
        points = arm.forward_kinematics(motion.y.T)[:, :3, 3]
        line = target - points[0]
        fraction = np.clip((points - points[0]) @ line / (line @ line), 0, 1)
        expected = np.linalg.norm(points - points[0] - fraction[:, None] * line, axis=1)
        assert runs.line_deviation(k, until=5.0) == pytest.approx(expected.max(), abs=2e-5)
        assert runs.line_deviation(k, until=1.0) == pytest.approx(expected[:801].max(), abs=2e-5)
        assert runs.line_deviation(k) >= expected.max() - 2e-5
    single = hf.simulate(law, start, rows @ targets[0], locked=[joint])
    assert single.line_deviation() == pytest.approx(runs.line_deviation(0), abs=1e-9)
    with pytest.raises(hf.InputError, match="there is no run 3"):
        runs.line_deviation(3)
