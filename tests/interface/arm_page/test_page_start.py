"""Start of the page's story, against NumPy's null spaces, an own tracer of self-motions, and single runs of ``hf.simulate``."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg

import holdfast as hf
import oracles
from holdfast.interface.presentation.arm_page.start import (
    choose_start,
    find_prepared,
    simulate_deviations,
    simulate_story,
)
from holdfast.model.arm.postures import generic_configuration
from holdfast.model.arm.task import as_task
from holdfast.model.collision.clearance import Clearance

LAWS = ("pseudoinverse", "failure-tolerant")


def worst_case(arm, task, q):
    return np.linalg.norm(scipy.linalg.null_space(task.rows @ arm.jacobian(q)), axis=1).min()


def trace(arm, task, start, step=0.02):
    """Configurations of the self-motion through a start, both ways until a joint limit or the start again."""
    pose = arm.forward_kinematics(start)
    ways = []
    for sign in (-1, 1):
        q, tangent, way = start, sign * scipy.linalg.null_space(task.rows @ arm.jacobian(start))[:, 0], [start]
        while len(way) < 1500:
            null_vector = scipy.linalg.null_space(task.rows @ arm.jacobian(q))[:, 0]
            tangent = null_vector * np.sign(null_vector @ tangent)
            q = q + step * tangent
            for _ in range(4):
                tool = arm.forward_kinematics(q)
                turn = pose[:3, :3] @ tool[:3, :3].T
                axial = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
                twist = np.r_[pose[:3, 3] - tool[:3, 3], axial]
                q = q + np.linalg.pinv(task.rows @ arm.jacobian(q)) @ task.rows @ twist
            if (q < arm.lower).any() or (q > arm.upper).any() or np.linalg.norm(q - start) < step / 2:
                break
            way.append(q)
        ways.append(way)
    return np.array(ways[0][:0:-1] + ways[1])


@pytest.mark.parametrize(("name", "label"), [("panda", "pose"), ("planar-3r", "planar")])
def test_the_start_leaves_much_to_gain(name, label):
    arm = hf.arms.load(name)
    task = as_task(arm, label)
    start = choose_start(arm, task)
    np.testing.assert_array_equal(start, choose_start(hf.arms.load(name), task))
    curve = trace(arm, task, start)
    worst = np.array([worst_case(arm, task, q) for q in curve])
    assert np.linalg.norm(np.diff(curve, axis=0), axis=1).sum() >= 1.4
    assert worst_case(arm, task, start) <= 0.2505 * worst.max()
    prepared = find_prepared(arm, task, start)
    assert abs(worst_case(arm, task, prepared) - worst.max()) < 0.02 * worst.max()
    assert np.linalg.norm(curve - prepared, axis=1).min() < 0.05
    pose, same_pose = arm.forward_kinematics(np.stack([start, prepared]))
    shown = slice(0, 4) if task.m == 6 else slice(3, 4)
    np.testing.assert_allclose(same_pose[:, shown], pose[:, shown], atol=1e-6)
    clearance = Clearance.by_default(arm)
    if clearance is not None:
        indices = sorted(int(np.linalg.norm(curve - q, axis=1).argmin()) for q in (start, prepared))
        assert (clearance(curve[indices[0] : indices[1] + 1]) > -1e-3).all()
    if task.m == 6:
        home = arm.forward_kinematics(arm.states["home"])
        np.testing.assert_allclose(pose[:3, :3], home[:3, :3], atol=1e-5)


@pytest.mark.parametrize("label", LAWS)
@pytest.mark.parametrize(("name", "task"), [("panda", "position"), ("planar-3r", "planar")])
def test_deviations_are_those_of_single_runs(rng, name, task, label):
    arm = hf.arms.load(name)
    law = hf.laws.by_name(label, arm, task=task, gain=2.0, speed_limit=0.25)
    start = oracles.inside(arm, rng, 1)[0]
    near = np.clip(start + rng.uniform(-0.5, 0.5, (5, arm.n)), arm.lower, arm.upper)
    targets, locked = arm.forward_kinematics(near)[:, :3, 3], int(rng.integers(arm.n))
    found, has_arrived = simulate_deviations(law, start, targets, locked)
    for k, target in enumerate(targets):
        run = hf.simulate(law, start, law.task.rows[:, :3] @ target, locked=[locked])
        path = run.path(samples=601, until=12.0)
        line = target - path.x[0]
        fraction = np.clip((path.x - path.x[0]) @ line / (line @ line), 0, 1)
        distances = np.linalg.norm(path.x - path.x[0] - fraction[:, None] * line, axis=1)
        assert found[k] == pytest.approx(distances.max(), abs=1e-4)
        errors = np.linalg.norm(path.x - target, axis=1)
        if abs(errors.min() - 0.001) > 1e-4:
            assert has_arrived[k] == (errors.min() < 0.001)


def test_the_story_states_the_medians_of_its_motions():
    arm = hf.arms.load("panda")
    task = as_task(arm, "pose")
    start = choose_start(arm, task)
    prepared = find_prepared(arm, task, start)
    story = simulate_story(arm, task, start, prepared, LAWS)
    assert story == simulate_story(arm, task, start, prepared, LAWS)
    assert story.motions == 400
    assert story.start == start.tolist()
    origin = arm.forward_kinematics(start)[:3, 3]
    assert np.linalg.norm(story.target - origin) >= 0.15 * (1 - 1e-6)
    example = simulate_story(arm, task, start, prepared, LAWS, target=story.target)
    assert example.motions == 0
    assert example.target == story.target
    np.testing.assert_allclose(example.deviations, story.deviations, rtol=0.25)
    locked = int(np.argmin(np.linalg.norm(scipy.linalg.null_space(arm.jacobian(start)), axis=1)))
    for label, q, expected in zip((*LAWS, LAWS[0]), (start, start, prepared), example.deviations, strict=True):
        law = hf.laws.by_name(label, arm, task="position", gain=story.gain, speed_limit=story.speed)
        run = hf.simulate(law, q, story.target, locked=[locked])
        assert run.line_deviation() == pytest.approx(expected, abs=1e-4)
        assert run.outcome == "converged"


def test_the_example_is_typical_where_few_motions_arrive():
    arm = hf.arms.load("planar-3r")
    task = as_task(arm, "planar")
    start = choose_start(arm, task)
    prepared = find_prepared(arm, task, start)
    story = simulate_story(arm, task, start, prepared, LAWS)
    example = simulate_story(arm, task, start, prepared, LAWS, target=story.target)
    np.testing.assert_allclose(example.deviations, story.deviations, rtol=0.25)


def test_arms_without_redundancy():
    ur5, planar = hf.arms.load("ur5"), hf.arms.load("planar-2r")
    pose, plane = as_task(ur5, "pose"), as_task(planar, "planar")
    start = choose_start(ur5, pose)
    np.testing.assert_array_equal(start, generic_configuration(ur5))
    np.testing.assert_array_equal(find_prepared(ur5, pose, start), start)
    story = simulate_story(ur5, pose, start, start, LAWS)
    assert story.deviations[0] == story.deviations[2] > 0
    start = choose_start(planar, plane)
    assert simulate_story(planar, plane, start, find_prepared(planar, plane, start), LAWS) is None
    with pytest.raises(hf.InputError, match="target has shape"):
        simulate_story(ur5, pose, start, start, LAWS, target=[1.0])
