"""The process beside the page."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import holdfast as hf
from holdfast.interface.studio.scene.cloud import RegionCloud, read_cloud
from holdfast.interface.studio.state import State
from holdfast.interface.studio.work import Cancelled
from holdfast.interface.studio.worker_process import WorkerProcess
from holdfast.model.arm.poses import pose_numbers
from holdfast.model.arm.task import as_task


@pytest.fixture(scope="module")
def arm():
    return hf.arms.load("planar-3r")


@pytest.fixture(scope="module")
def aside(arm):
    beside = WorkerProcess(arm, as_task(arm, "planar"))
    yield beside
    beside.stop()


def state_of(arm, **more):
    return State("planar-3r", arm.joint_names, (0.3, 0.8, 0.9), task="planar", **more)


def go(aside, job, state):
    seen = []
    found = aside.run(job, state, lambda: None, lambda done, total: seen.append((done, total)))
    return found, seen


def test_best_and_worst_are_those_of_a_dense_search(aside, arm):
    state = state_of(arm)
    found, seen = go(aside, "best-worst", state)
    assert seen[0] == (0, 2)
    rho = hf.indices.relative_manipulability(arm, "planar")
    hand = arm.forward_kinematics(state.q)[:3, 3]
    curve = np.concatenate([c.q for c in hf.self_motion(arm, hand[:2], "planar", spacing=0.01).components])
    values = rho(curve)
    assert found.values[0] == pytest.approx(values.max(), abs=5e-3)
    assert found.values[1] == pytest.approx(values.min(), abs=5e-3)
    assert found.values[2] == pytest.approx(float(rho(state.q)))
    for q in found.q:
        np.testing.assert_allclose(arm.forward_kinematics(q)[:3, 3], hand, atol=1e-5)


def test_motions_are_those_of_the_closed_loop(aside, arm):
    there = arm.forward_kinematics([0.3, 0.9, 0.5])
    state = state_of(
        arm, conditions=("healthy", "locked", "healthy"), target=pose_numbers(there), laws=("pseudoinverse", "damped:0.2")
    )
    motions, _ = go(aside, "laws", state)
    assert [m.label.partition(":")[0] for m in motions] == ["pseudoinverse", "damped"]
    for motion, damping in zip(motions, (0.0, 0.2), strict=True):
        assert (motion.q[:, 1] == state.q[1]).all()

        def rate(_, q, damping=damping):
            j = arm.jacobian(q)[:2]
            error = (there - arm.forward_kinematics(q))[:2, 3]
            return j.T @ np.linalg.solve(j @ j.T + damping**2 * np.eye(2), error) * [1, 0, 1]

        found = solve_ivp(rate, (0, motion.time[-1]), state.q, t_eval=motion.time, rtol=1e-8, atol=1e-10)
        np.testing.assert_allclose(motion.q, found.y.T, atol=1e-6)
        np.testing.assert_allclose(motion.configuration_at(1.234), [np.interp(1.234, motion.time, x) for x in motion.q.T])
        assert "reaches the target" in motion.label or "stops elsewhere" in motion.label


def test_region_is_coloured_by_the_index_of_its_configurations(aside, arm, tmp_path):
    cloud, seen = go(aside, "region", state_of(arm))
    assert isinstance(cloud, RegionCloud)
    assert seen[-1] == (1200, 1200)
    sound = np.isfinite(cloud.q).all(axis=1)
    assert sound.mean() > 0.5
    np.testing.assert_allclose(hf.indices.relative_manipulability(arm, "planar")(cloud.q[sound]), cloud.values[sound])
    bright = cloud.colors.sum(axis=1)[sound]
    order = np.argsort(cloud.values[sound])
    assert bright[order[-50:]].mean() > bright[order[:50]].mean()
    region = hf.Region.box([1.5, 1.0, 0], [0.5, 0.5, 0])
    hf.assess(arm, region, hf.indices.relative_manipulability(arm, "planar"), poses=100, store=tmp_path / "run")
    kept, _ = go(aside, "region", state_of(arm, region=str(tmp_path / "run")))
    assert len(kept.q) == 100
    with pytest.raises(hf.InputError, match="is an assessment of 'planar-3r'"):
        read_cloud(hf.arms.load("planar-2r"), str(tmp_path / "run"))


def test_errors_come_back_and_the_process_goes_on(aside, arm):
    with pytest.raises(hf.HoldfastError, match="all joints are locked"):
        go(aside, "fall", state_of(arm, conditions=("locked",) * arm.n))
    with pytest.raises(hf.HoldfastError, match="no target"):
        go(aside, "laws", state_of(arm))
    with pytest.raises(hf.HoldfastError, match="nowhere"):
        go(aside, "region", state_of(arm, region="nowhere"))
    assert go(aside, "best-worst", state_of(arm))[0].values[0] > 0


def test_giving_up_leaves_the_process_fit_for_the_next(aside, arm):
    def impatient():
        raise Cancelled

    with pytest.raises(Cancelled):
        aside.run("best-worst", state_of(arm), impatient, lambda *_: None)
    calls = []

    def later():
        calls.append(1)
        if len(calls) > 3:
            raise Cancelled

    with pytest.raises(Cancelled):
        aside.run("region", state_of(arm), later, lambda *_: None)
    assert go(aside, "best-worst", state_of(arm))[0].values[0] > 0


def test_a_process_that_died_is_started_again(aside, arm):
    go(aside, "best-worst", state_of(arm))
    aside._process.kill()
    aside._process.wait()
    assert go(aside, "best-worst", state_of(arm))[0].values[0] > 0
