"""The process beside the page."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import holdfast as hf
from holdfast.interface.studio.compute import find_region_cloud, plan_stow_motion
from holdfast.interface.studio.machine import CompiledArm
from holdfast.interface.studio.state import State
from holdfast.interface.studio.worker_process import Cancelled, WorkerProcess
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
    assert found["values"][0] == pytest.approx(values.max(), abs=5e-3)
    assert found["values"][1] == pytest.approx(values.min(), abs=5e-3)
    assert found["values"][2] == pytest.approx(float(rho(state.q)))
    for q in found["q"]:
        np.testing.assert_allclose(arm.forward_kinematics(q)[:3, 3], hand, atol=1e-5)


def test_motions_are_those_of_the_closed_loop(aside, arm):
    there = arm.forward_kinematics([0.3, 0.9, 0.5])
    state = state_of(
        arm, conditions=("healthy", "locked", "healthy"), target=pose_numbers(there), laws=("pseudoinverse", "damped:0.2")
    )
    motions, _ = go(aside, "laws", state)
    assert [m["label"].partition(":")[0] for m in motions] == ["pseudoinverse", "damped"]
    for motion, damping in zip(motions, (0.0, 0.2), strict=True):
        time, path, label = np.array(motion["time"]), np.array(motion["q"]), motion["label"]
        assert (path[:, 1] == state.q[1]).all()

        def rate(_, q, damping=damping):
            j = arm.jacobian(q)[:2]
            error = (there - arm.forward_kinematics(q))[:2, 3]
            return j.T @ np.linalg.solve(j @ j.T + damping**2 * np.eye(2), error) * [1, 0, 1]

        found = solve_ivp(rate, (0, time[-1]), state.q, t_eval=time, rtol=1e-8, atol=1e-10)
        np.testing.assert_allclose(path, found.y.T, atol=1e-6)
        assert "reaches the target" in label or "stops elsewhere" in label


def test_region_is_coloured_by_the_index_of_its_configurations(aside, arm, tmp_path):
    cloud, seen = go(aside, "region", state_of(arm))
    assert seen[-1] == (1200, 1200)
    assert {len(cloud[name]) for name in ("points", "colors", "q", "values")} == {1200}
    sound = [k for k, q in enumerate(cloud["q"]) if q is not None]
    assert len(sound) > 600
    assert all(cloud["colors"][k] == [150] * 3 for k in set(range(1200)) - set(sound))
    q, values, points, colors = (np.array([cloud[name][k] for k in sound]) for name in ("q", "values", "points", "colors"))
    np.testing.assert_allclose(hf.indices.relative_manipulability(arm, "planar")(q), values)
    np.testing.assert_allclose(arm.forward_kinematics(q)[:, :2, 3], points[:, :2], atol=1e-5)
    order, bright = np.argsort(values), colors.sum(axis=1)
    assert bright[order[-50:]].mean() > bright[order[:50]].mean()
    region = hf.Region.box([1.5, 1.0, 0], [0.5, 0.5, 0])
    hf.assess(arm, region, hf.indices.relative_manipulability(arm, "planar"), poses=100, store=tmp_path / "run")
    kept, _ = go(aside, "region", state_of(arm, region=str(tmp_path / "run")))
    assert len(kept["q"]) == 100
    two = hf.arms.load("planar-2r")
    other = State("planar-2r", two.joint_names, (0.1, 0.2), task="planar", region=str(tmp_path / "run"))
    with pytest.raises(hf.InputError, match="is an assessment of 'planar-3r'"):
        find_region_cloud(CompiledArm(two, as_task(two, "planar")), other, lambda *_: None)


def test_stow_plays_the_path_of_the_library(aside):
    panda = hf.arms.load("panda")
    q = tuple(np.radians([0.0, -45, 0, -135, 0, 90, 45]).tolist())
    state = State("panda", panda.joint_names, q, task="pose", friction=3.0)
    (motion,) = plan_stow_motion(CompiledArm(panda, as_task(panda, "pose")), state, lambda *_: None)
    path = np.array(motion["q"])
    np.testing.assert_allclose(path[0], q, atol=1e-12)
    friction = hf.Friction(coulomb=3.0)
    assert hf.holds(panda, path[-1], friction=friction).holds
    limits = np.array([joint.velocity for joint in panda.joints])
    assert (np.abs(np.diff(path, axis=0)) <= limits * np.diff(motion["time"])[:, None] + 1e-9).all()
    assert motion["unit"] == "s"
    with pytest.raises(hf.HoldfastError, match="speed limit"):
        go(aside, "stow", state_of(hf.arms.load("planar-3r"), friction=30.0))


def test_errors_come_back_and_the_process_goes_on(aside, arm):
    with pytest.raises(hf.HoldfastError, match="all joints are locked"):
        go(aside, "fall", state_of(arm, conditions=("locked",) * arm.n))
    with pytest.raises(hf.HoldfastError, match="no target"):
        go(aside, "laws", state_of(arm))
    with pytest.raises(hf.HoldfastError, match="nowhere"):
        go(aside, "region", state_of(arm, region="nowhere"))
    assert go(aside, "best-worst", state_of(arm))[0]["values"][0] > 0


def test_giving_up_leaves_the_process_fit_for_the_next(aside, arm):
    def impatient():
        raise Cancelled

    with pytest.raises(Cancelled):
        aside.run("best-worst", state_of(arm), impatient, lambda *_: None)
    calls = []

    def later():
        calls.append(1)
        if len(calls) > 1:
            raise Cancelled

    with pytest.raises(Cancelled):
        aside.run("region", state_of(arm), later, lambda *_: None)
    assert go(aside, "best-worst", state_of(arm))[0]["values"][0] > 0


def test_a_process_that_died_is_started_again(aside, arm):
    go(aside, "best-worst", state_of(arm))
    aside._process.kill()
    aside._process.wait()
    assert go(aside, "best-worst", state_of(arm))[0]["values"][0] > 0
