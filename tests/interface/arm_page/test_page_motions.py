"""Drags, self-motions, and closed loops of the page, against the library's own simulations and the compiled kernels."""

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import control
from holdfast.model.arm.task import default_path_task

ARMS = ("panda", "panda position", "iiwa14", "pa10-9dof", "planar-3r", "crane")
GAIN, SPEED_M_S, STEP_S = 2.0, 0.25, 0.02


def near(arm, rng, q, distance):
    """Configurations within the limits whose joints are at most this far away."""
    return np.clip(q + rng.uniform(-distance, distance, q.shape), arm.lower, arm.upper)


def pose_errors(page, q, target):
    """Largest difference of the entries of the tool poses that the task sees."""
    found, wanted = page.arm.forward_kinematics(q), page.arm.forward_kinematics(target)
    return np.abs(found - wanted)[:, :3, None if page.task.angular else 3 :].max(axis=(1, 2))


def poses(page, q):
    return page.arm.forward_kinematics(q)[:, :3].reshape(len(q), 12)


@pytest.mark.parametrize("name", ARMS)
def test_a_drag_reaches_what_is_near(page_arm, rng, name):
    page, count = page_arm(name), 500
    q = oracles.inside(page.arm, rng, count)
    locked = rng.integers(page.arm.n, size=count)
    goal = near(page.arm, rng, q, 0.3)
    goal[range(count), locked] = q[range(count), locked]
    rows = list(zip(q, poses(page, goal), locked.tolist(), strict=True))
    found = page.call("(page, arm, [q, target, joint]) => page.followTarget(arm, q, target, arm.freeJoints([joint]))", rows)
    ends = np.array([row["configuration"] for row in found])
    np.testing.assert_array_equal(ends[range(count), locked], q[range(count), locked])
    assert (ends >= page.arm.lower).all()
    assert (ends <= page.arm.upper).all()
    reached = np.array([row["reached"] for row in found])
    assert reached.mean() >= 0.998
    assert pose_errors(page, ends, goal)[reached].max() < 1e-5
    assert (pose_errors(page, ends, goal)[~reached] > 1e-7).all()


@pytest.mark.parametrize("name", ["panda", "crane"])
def test_random_starts_reach_what_is_reachable(page_arm, rng, name):
    page, count = page_arm(name), 20
    q, goal = oracles.inside(page.arm, rng, 2 * count).reshape(2, count, -1)
    locked = rng.integers(page.arm.n, size=count)
    goal[range(count), locked] = q[range(count), locked]
    rows = list(zip(q, poses(page, goal), locked.tolist(), strict=True))
    script = """(page, arm, [q, target, joint]) => [
        page.reachTarget(arm, q, target, arm.freeJoints([joint])),
        page.searchTarget(arm, q, target, arm.freeJoints([joint]))]"""
    found = page.call(script, rows)
    ends = np.array([search["configuration"] for _, search in found])
    np.testing.assert_array_equal(ends[range(count), locked], q[range(count), locked])
    assert sum(search["reached"] for _, search in found) >= 0.95 * count
    assert sum(drag["reached"] for drag, _ in found) < count
    assert all(search["error"] <= drag["error"] for drag, search in found)


def test_a_target_beyond_the_arm_is_not_reached(page_arm, rng):
    page = page_arm("panda")
    q = oracles.inside(page.arm, rng, 5)
    targets = poses(page, q)
    targets[:, [3, 7, 11]] *= 4 / np.linalg.norm(targets[:, [3, 7, 11]], axis=1, keepdims=True)
    rows = list(zip(q, targets, strict=True))
    found = page.call("(page, arm, [q, target]) => page.searchTarget(arm, q, target, arm.freeJoints([]))", rows)
    assert not any(row["reached"] for row in found)
    script = """(page, arm, [q, target]) => Array.from({length: 31}, (_, steps) =>
        page.reachTarget(arm, q, target, arm.freeJoints([]), steps).error)"""
    errors = np.array(page.call(script, rows))
    assert (np.diff(errors) <= 0).all()  # a further step never leads away


@pytest.mark.parametrize("name", ARMS)
def test_the_tool_stays_on_the_self_motion(page_arm, rng, name):
    page = page_arm(name)
    index = hf.indices.relative_manipulability(page.arm, page.task)
    starts = oracles.inside(page.arm, rng, 6)
    for start, motion in zip(starts, page.call("(page, arm, q) => page.traceSelfMotion(arm, q)", starts.tolist()), strict=True):
        q = np.array(motion["configurations"])
        np.testing.assert_array_equal(q[motion["start"]], start)
        assert pose_errors(page, q, np.broadcast_to(start, q.shape)).max() < 1e-5
        assert ((q >= page.arm.lower) & (q <= page.arm.upper)).all()
        worst = index.evaluate(q).value
        np.testing.assert_allclose(motion["worst"], worst, rtol=0, atol=1e-11)
        assert motion["best"] == np.argmax(motion["worst"])
        assert np.linalg.norm(np.diff(q, axis=0), axis=1).max() < 0.05
        for end, reason in zip((q[0], q[-1]), motion["ends"], strict=True):
            at_limit = np.isclose(end, page.arm.lower, rtol=0, atol=1e-3) | np.isclose(end, page.arm.upper, rtol=0, atol=1e-3)
            assert reason in ("limit", "no progress", "closed loop", "length")
            assert reason != "limit" or at_limit.any()
        if page.arm.n - page.task.m > 1:
            rise = np.diff(worst[motion["start"] :])
            assert (rise > -1e-2).all()


@pytest.mark.parametrize("name", ["panda", "planar-3r", "crane"])
def test_the_self_motion_is_the_whole_curve(page_arm, rng, name):
    page, compared = page_arm(name), 0
    starts = oracles.inside(page.arm, rng, 8)
    for start, motion in zip(starts, page.call("(page, arm, q) => page.traceSelfMotion(arm, q)", starts.tolist()), strict=True):
        q = np.array(motion["configurations"])
        curves = hf.self_motion(page.arm, page.arm.forward_kinematics(start), page.task, spacing=0.03).components
        for curve in curves:
            turns = np.rint((curve.q - start) / (2 * np.pi)) * ~(page.arm.prismatic | np.isfinite(page.arm.lower))
            if np.linalg.norm(curve.q - 2 * np.pi * turns - start, axis=1).min() < 0.02:
                compared += 1
                assert (motion["ends"] == ["closed loop"] * 2) == curve.closed
                length = np.linalg.norm(np.diff(q, axis=0), axis=1).sum()
                assert abs(length - curve.length) < 0.06 + 0.02 * curve.length
    assert compared


@pytest.mark.parametrize("column", [None, 0])
def test_a_self_motion_keeps_locked_joints(page_arm, rng, column):
    page = page_arm("pa10-9dof")
    starts, locked = oracles.inside(page.arm, rng, 4), [[2], [0, 4], [7], [1, 5]]
    script = "(page, arm, [q, locked, column]) => page.traceSelfMotion(arm, q, locked, column)"
    rows = [[q, joints, column] for q, joints in zip(starts.tolist(), locked, strict=True)]
    for start, joints, motion in zip(starts, locked, page.call(script, rows), strict=True):
        q = np.array(motion["configurations"])
        np.testing.assert_allclose(q[:, joints], np.broadcast_to(start[joints], q[:, joints].shape), rtol=0, atol=1e-12)
        assert pose_errors(page, q, np.broadcast_to(start, q.shape)).max() < 1e-5
        assert np.ptp(q, axis=0).max() > 0.1


def test_a_lock_ends_the_only_self_motion(page_arm, rng):
    page = page_arm("panda")
    rows = [[q, [3]] for q in oracles.inside(page.arm, rng, 3).tolist()]
    motions = page.call("(page, arm, [q, locked]) => page.traceSelfMotion(arm, q, locked)", rows)
    assert [len(motion["configurations"]) for motion in motions] == [1, 1, 1]


@pytest.mark.parametrize("name", ["panda", "iiwa14", "crane"])
def test_a_self_motion_ends_at_limits(page_arm, rng, name):
    """Close to a singular configuration it turns within a step, and goes on."""
    page = page_arm(name)
    starts = oracles.inside(page.arm, rng, 40)
    assert all(
        "no progress" not in ends for ends in page.call("(page, arm, q) => page.traceSelfMotion(arm, q).ends", starts.tolist())
    )


def closed_loops(page, rng, name, count, label):
    """Rows of the page's closed loops, and its motions."""
    q = oracles.inside(page.arm, rng, count)
    target = page.arm.forward_kinematics(near(page.arm, rng, q, 0.5))[:, :3, 3]
    rows = list(zip(q, target, rng.integers(page.arm.n, size=count).tolist(), strict=True))
    settings = f'{{law: "{label}", gain: {GAIN}, speed: {SPEED_M_S}}}'
    return rows, page.call(
        f"(page, arm, [q, target, joint]) => page.simulateControl(arm, q, target, [joint], {settings})", rows
    )


def distances_from_line(x, target):
    """Distances (T,) of points (T, 3) from the straight line between the first one and a target."""
    line = target - x[0]
    fraction = np.clip((x - x[0]) @ line / (line @ line), 0, 1)
    return np.linalg.norm(x - x[0] - fraction[:, None] * line, axis=1)


@pytest.mark.parametrize("label", ["pseudoinverse", "failure-tolerant"])
@pytest.mark.parametrize("name", ["panda", "planar-3r", "crane"])
def test_closed_loops_are_those_of_simulate(page_arm, rng, name, label):
    page = page_arm(name)
    rows, motions = closed_loops(page, rng, name, 10, label)
    task = default_path_task(page.arm, oriented=False)
    law = control.by_name(label, page.arm, task=task, gain=GAIN, speed_limit=SPEED_M_S)
    for (q, target, joint), motion in zip(rows, motions, strict=True):
        q_page = np.array(motion["q"])
        trail = page.arm.forward_kinematics(q_page)[:, :3, 3]
        time = STEP_S * np.arange(len(trail))
        np.testing.assert_allclose(motion["time"], time, rtol=0, atol=1e-12)
        run = hf.simulate(law, q, law.task.rows[:, :3] @ target, locked={joint: None}, tolerance=1e-11)
        end = min(int(float(run.time) / STEP_S), len(time) - 1)
        path = run.path(samples=end + 1, until=time[end])
        np.testing.assert_allclose(q_page[: end + 1, joint], q[joint], rtol=0, atol=0)
        tolerance = 1e-6
        np.testing.assert_allclose(trail[: end + 1], path.x, rtol=0, atol=tolerance)
        np.testing.assert_allclose(trail[end:], np.broadcast_to(trail[end], trail[end:].shape), rtol=0, atol=tolerance)
        assert abs(motion["deviation"] - distances_from_line(path.x, target).max()) < tolerance


POINT_ARM = """(() => {{
    let calls = 0;
    const arm = {{
        freeJoints: () => [1, 1, 1],
        toolPosition: (q) => q,
        commandRates: (law, q, velocity) => {{ calls++; return {rates}; }},
    }};
    const motion = page.simulateControl(arm, {start}, {target}, [], {{law: "", gain: 2, speed: 0.25}});
    return {{...motion, calls}};
}})()"""


def test_a_limited_speed_is_that_of_the_closed_form(page_arm):
    """The tool moves at the speed limit to 0.125 m from the target, and its distance then decays as exp(-2 t)."""
    script = POINT_ARM.format(rates="velocity", start="[0, 0, 0]", target="[0.6, 0, 0.8]")
    motion = page_arm("planar-3r").call(f"(page) => {script}", [0])[0]
    time = np.array(motion["time"])
    distance = np.where(time < 3.5, 1 - 0.25 * time, 0.125 * np.exp(-2 * np.maximum(time - 3.5, 0)))
    expected = np.outer(1 - distance, [0.6, 0, 0.8])
    np.testing.assert_allclose(motion["q"], expected, rtol=0, atol=1e-9)
    assert distance[-1] <= 0.001 < distance[-2]
    assert motion["deviation"] < 1e-12


def test_a_law_that_switches_back_and_forth_takes_little_work(page_arm):
    """The tool slides along y = 0.01 m, at the mean of the rates on both sides."""
    rates = "q[1] > 0.01 ? [0.05, -0.1, 0] : [0.05, 0.1, 0]"
    script = POINT_ARM.format(rates=rates, start="[0, 0, 0]", target="[9, -9, 0]")
    motion = page_arm("planar-3r").call(f"(page) => {script}", [0])[0]
    assert len(motion["time"]) == 601
    assert motion["calls"] < 20_000
    q = np.array(motion["q"])[5:]
    np.testing.assert_allclose(q[:, 0], 0.05 * np.array(motion["time"])[5:], rtol=0, atol=1e-9)
    np.testing.assert_allclose(q[:, 1], 0.01, rtol=0, atol=0.1 * STEP_S)
