"""A joint motion carried out by servos, against MuJoCo itself on the arm's own file, and what is said of it."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import holdfast as hf
from cards import check_card
from holdfast.core.errors import HoldfastError, InputError

FILE = """
<mujoco><compiler angle="radian"/><worldbody><body pos="0 0 0.2">
 <joint name="turn" axis="0 0 1" range="-2 2" damping="0.2" armature="0.02"/>
 <geom type="capsule" fromto="0 0 0 0 0 0.3" size="0.03" mass="2"/>
 <body pos="0 0 0.3"><joint name="lift" axis="0 1 0" range="-2 2" damping="0.1"/>
  <geom type="capsule" fromto="0 0 0 0.4 0 0" size="0.03" mass="1.5"/>
  <body pos="0.4 0 0"><joint name="bend" axis="0 1 0" range="-2 2"/>
   <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="1"/>
   <body pos="0.3 0 0"><joint name="nod" axis="0 1 0" range="-2 2"/>
    <geom type="box" pos="0.05 0 0" size="0.05 0.03 0.01" mass="0.4"/><site name="tip" pos="0.1 0 0.02" euler="0.2 0 0.1"/>
</body></body></body></body></worldbody></mujoco>"""
SERVOS = hf.Servos(bandwidth=4.0, ratio=1.2, rate=100.0, compensation=0.9, step=1e-4)
TIME = np.linspace(0, 0.6, 31)
WAY = np.array([0.1, -0.4, 0.9, -0.5]) + (0.5 - 0.5 * np.cos(np.pi * TIME / 0.6))[:, None] * [0.8, 0.5, -0.7, 0.6]


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("arm") / "arm.xml"
    path.write_text(FILE, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def arm(file):
    return hf.Arm.from_mjcf(file, tip="tip")


@pytest.fixture(scope="module")
def native(file):
    return mujoco.MjModel.from_xml_path(str(file))


@pytest.fixture(scope="module")
def run(arm):
    """A joint locks in the middle, and nobody notices."""
    goal, keep = arm.forward_kinematics(WAY[-1]), hf.tool_constraints.upright(0.3, axis=[0, 0, 1], direction=[0, 0, 1])
    return hf.execute(arm, WAY, TIME, locked=["lift"], lock_time=0.3, servos=SERVOS, settle=0.2, goal=goal, keep=keep)


def sites(native, q):
    """Places (T, 3) and turns (T, 3, 3) of the tool, by MuJoCo."""
    data, places, turns = mujoco.MjData(native), [], []
    for row in q:
        data.qpos[:] = row
        mujoco.mj_kinematics(native, data)
        places.append(data.site("tip").xpos.copy())
        turns.append(data.site("tip").xmat.reshape(3, 3).copy())
    return np.array(places), np.array(turns)


def by_mujoco(native, stiffness, damping):
    """The same servos on MuJoCo's mass matrix and bias of the file, in small steps of our own; joint 1 locks after 0.3 s."""
    data, q, v, step = mujoco.MjData(native), WAY[0].copy(), np.zeros(4), 1e-4
    whole, free, path = np.zeros((4, 4)), np.arange(4), [WAY[0].copy()]

    def looked(q, v):
        data.qpos[:], data.qvel[:] = q, v
        mujoco.mj_forward(native, data)
        for row, unit in zip(whole, np.eye(4), strict=True):
            mujoco.mj_mulM(native, data, row, unit)
        return whole, data.qfrc_bias.copy()

    for k in range(80):
        wanted = np.array([[np.interp(t, TIME, x) for x in WAY.T] for t in (k / 100, (k + 1) / 100)])
        if k == 30:
            m, _ = looked(q, v)
            free = np.array([0, 2, 3])
            v[free], v[1] = np.linalg.solve(m[np.ix_(free, free)], (m @ v)[free]), 0.0
        for _ in range(100):
            weight = looked(q, 0 * v)[1]
            m, bias = looked(q, v)
            torque = stiffness * (wanted[1] - q) + damping * (np.diff(wanted, axis=0)[0] * 100 - v) + 0.9 * weight
            left = torque - bias - native.dof_damping * v
            v[free] += step * np.linalg.solve(m[np.ix_(free, free)], left[free])
            q = q + step * v
        path.append(q.copy())
    return np.array(path)


def test_the_motion_is_that_of_mujoco_on_the_file(native, run):
    expected = by_mujoco(native, run.stiffness, run.damping)
    assert run.q.shape == expected.shape
    np.testing.assert_allclose(run.q, expected, atol=2e-3)  # the steps of both are of first order: 0.1 ms
    assert np.ptp(expected, axis=0).min() > 0.1


def test_what_is_said_of_the_tool_is_what_mujoco_has(native, run):
    places, turns = sites(native, run.q)
    np.testing.assert_allclose(run.poses[:, :3, 3], places, atol=1e-9)
    goal, turned = sites(native, WAY[-1:])
    assert run.goal_distance == pytest.approx(np.linalg.norm(places[-1] - goal[0]), abs=1e-9)
    cosine = (np.trace(turns[-1] @ turned[0].T) - 1) / 2
    assert run.goal_turn == pytest.approx(np.arccos(cosine), abs=1e-6)
    tilt = np.arccos(turns[:, 2, 2]).max()
    assert tilt > 0.3
    assert run.constraint_errors == ((0.0, pytest.approx(tilt, abs=1e-6)),)
    assert run.outcome == "moving", "a tenth of the weight is not compensated, and the servos are soft"
    assert not run.ok
    assert f"{np.rad2deg(tilt):.4g} deg, beyond 17.19 deg" in run.faults()[2]
    with pytest.raises(HoldfastError, match=r"still moving at the end; the tool is .* off the goal; the tool was rotated away"):
        run.require_ok()


def test_a_lock_that_is_noticed_stops_the_arm_on_its_way(arm, run):
    stopped = hf.execute(arm, WAY, TIME, locked={"lift": None}, lock_time=0.3, notice=0.03, stop=0.1, servos=SERVOS, settle=1.0)
    assert stopped.outcome == "stopped"
    assert stopped.noticed == pytest.approx(0.33)
    np.testing.assert_array_equal(stopped.q[:34], run.q[:34])
    held = stopped.q[30:, 1]
    np.testing.assert_array_equal(held, held[0])
    assert stopped.degraded.locked == {"lift": held[0]}
    np.testing.assert_array_equal(stopped.is_locked[:, 1], np.arange(len(stopped.time)) >= 30)
    # It slows down evenly in 0.1 s: half as far as it would have gone.
    expected = [np.interp(0.38, TIME, x) for x in WAY.T]
    np.testing.assert_allclose(stopped.reference[-1, [0, 2, 3]], np.array(expected)[[0, 2, 3]], atol=1e-12)
    assert np.abs(stopped.rates[-1]).max() < 1e-3
    assert "The controller detected the lock at 0.33 s" in " ".join(stopped.describe())
    late = hf.execute(arm, WAY, TIME, locked=["lift"], lock_time=0.5, notice=0.08, stop=0.1, servos=SERVOS)
    assert late.outcome == "finished", "the motion is over before it is slowed down"


def test_from_the_lock_to_the_task_finished():
    arm = hf.arms.load("planar-3r")
    time = np.linspace(0, 2, 101)
    way = np.array([0.4, 0.9, -0.6]) + np.sin(np.pi * time / 4)[:, None] ** 2 * [0.7, 0.3, 0.9]
    goal, servos = arm.forward_kinematics(way[-1])[:3, 3], hf.Servos(rate=250.0)
    gone = hf.execute(arm, way, time, locked=["joint2"], lock_time=0.8, goal=goal, servos=servos)
    assert gone.goal_distance > 0.05
    first = hf.execute(arm, way, time, locked=["joint2"], lock_time=0.8, notice=0.02, servos=servos)
    pose = np.eye(4)
    pose[:3, 3] = goal
    answer = hf.recover(arm, first.degraded, first.q_final, goal=pose, task="planar", samples=0).require_ok()
    slowly = np.r_[0, np.linalg.norm(np.diff(answer.q, axis=0), axis=1).cumsum()] / 0.5
    last = hf.execute(arm, answer.q, slowly, locked=answer.degraded, goal=goal, servos=servos).require_ok()
    assert last.goal_distance < 1e-4
    np.testing.assert_array_equal(last.q[:, 1], first.q_final[1])
    assert "The joints stayed within their position and speed limits." in last.describe()


def test_limits_speeds_and_objects_are_looked_at(arm):
    fast = hf.execute(arm.with_limits([-1, -1, -1, -0.2], [1] * 4), WAY, TIME, servos=hf.Servos(rate=250.0), settle=0.1)
    assert list(fast.beyond_limits) == ["nod"]
    assert fast.beyond_limits["nod"] == pytest.approx((-0.2 - fast.q[:, 3]).max())
    assert not fast.ok
    panda, home = hf.arms.load("panda"), np.array(hf.arms.about("panda").home)
    way = np.stack([home, home + 0.2 * np.eye(7)[6]])
    assert hf.execute(panda, way, [0, 0.1], servos=hf.Servos(rate=250.0)).too_fast == {}
    slow = hf.Degraded(panda, locked=["panda_joint1"], speeds={"panda_joint7": 0.5})
    left = hf.execute(panda, way, [0, 0.1], locked=slow, servos=hf.Servos(rate=250.0))
    assert left.too_fast["panda_joint7"] == pytest.approx(np.abs(left.rates[:, 6]).max())
    wall = hf.Cell([hf.cell.Box("wall", [0.2, 2, 2], pose=panda.forward_kinematics(home)[:3, 3] + [0.3, 0, 0])])
    shape = hf.Clearance(panda, hf.Capsules.along_links(panda, radius=0.03), itself=False)
    reaching = home + np.linspace(0, 1, 3)[:, None] * np.array([0, 0.9, 0, 0.6, 0, 0, 0])
    hit = hf.execute(panda, reaching, [0, 0.6, 1.2], clearance=shape, cell=wall, servos=hf.Servos(rate=250.0), settle=0.1)
    assert hit.contacts[0].object == "wall"
    assert not hit.ok


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        ({"time": TIME[:-1]}, "give two or more, and a time for each"),
        ({"time": np.r_[TIME[:-1], TIME[-2]]}, "every time must be after the one before"),
        ({"time": TIME * 1e5}, "it must take 3600 s or less"),
        ({"q": np.where(WAY > 0.8, np.nan, WAY)}, "NaN or infinity"),
        ({"locked": {"lift": 0.3}}, "locked at 0.3, but the motion begins with it at -0.4"),
        ({"locked": ["lift"], "lock_time": [0.1, 0.2]}, "or 1, one for each joint that locks"),
        ({"notice": 0.1}, "no joint locks"),
        ({"locked": ["lift"], "notice": -0.1}, "notice is -0.1 s"),
        ({"settle": np.inf}, "settle is inf s"),
        ({"goal": [1, 2]}, "give a pose"),
    ],
)
def test_wrong_input_gets_a_sentence(arm, wrong, sentence):
    with pytest.raises(InputError, match=sentence):
        hf.execute(**{"arm": arm, "q": WAY, "time": TIME, **wrong})


def test_it_is_shown(arm, run, tmp_path):
    check_card(run)
    page = run.report(tmp_path / "page.html").read_text(encoding="utf-8")
    assert "Over time" in page
    rows = np.loadtxt(run.to_csv(tmp_path / "motion.csv"), delimiter=",", skiprows=1)
    np.testing.assert_allclose(rows[:, 1:5], run.q, atol=1e-9)
    data = run.to_dict()
    assert data["kept"][0]["turned"] == pytest.approx(run.constraint_errors[0][1])
    assert (data["ok"], data["noticed_s"], data["lock_time_s"]) == (False, None, {"lift": 0.3})
