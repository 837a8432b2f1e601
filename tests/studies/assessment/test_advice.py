"""Which joint to double, which one is a single point of failure, and what optimisation gains: by brute force on three arms.

The brute force draws thousands of points of the self-motion manifold of a pose by Newton's method in NumPy and takes the best.
"""

from __future__ import annotations

from functools import lru_cache

import casadi as ca
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast.core.formatting import format_percent
from holdfast.core.registry import INDEX_REGISTRY
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.presentation.assessment.method import explain_index
from holdfast.model.arm.machine import Joint
from holdfast.studies.assessment import explain, structure, structures

GEN3 = [  # Kinova Gen3 with 7 joints: origin in m, turn about x in rad, limit in rad; its shoulder axes miss a point by 12 mm
    ((0, 0, 0.15643), np.pi, np.inf),
    ((0, 0.005375, -0.12838), np.pi / 2, 2.41),
    ((0, -0.21038, -0.006375), -np.pi / 2, np.inf),
    ((0, 0.006375, -0.21038), np.pi / 2, 2.66),
    ((0, -0.20843, -0.006375), -np.pi / 2, np.inf),
    ((0, 0.00017505, -0.10593), np.pi / 2, 2.23),
    ((0, -0.10593, -0.00017505), -np.pi / 2, np.inf),
]
TASKS = {"gen3": "pose", "panda": "pose", "planar-3r": "planar"}
POSES = 3


def transform(position, about_x):
    out = np.eye(4)
    out[:3, :3], out[:3, 3] = Rotation.from_euler("x", about_x).as_matrix(), position
    return out


@lru_cache
def load(name):
    if name != "gen3":
        return hf.arms.load(name)
    joints = tuple(
        Joint(f"joint_{k + 1}", "revolute", transform(p, turn), axis=(0, 0, 1), lower=-limit, upper=limit)
        for k, (p, turn, limit) in enumerate(GEN3)
    )
    return hf.Arm("gen3", joints, tool=transform((0, 0, -0.061525), np.pi))


def rho(arm, q, task):
    """Relative manipulability after each single lock (N, n)."""
    return oracles.index("relative-manipulability", oracles.task_jacobian(arm, q, task), [[k] for k in range(arm.n)])


def error(arm, q, pose, task):
    reached = oracles.forward(arm, q)
    turn = Rotation.from_matrix(pose[:3, :3] @ np.swapaxes(reached[:, :3, :3], 1, 2)).as_rotvec()
    both = np.concatenate([pose[:3, 3] - reached[:, :3, 3], turn], axis=1)
    return both if task == "pose" else both[:, :2]


def step_onto(arm, q, pose, task):
    """One step of Newton's method towards the pose, at most 0.5 rad, and a unit vector of the null space."""
    e = error(arm, q, pose, task)
    u, s, vt = np.linalg.svd(oracles.jacobian(arm, q)[:, : e.shape[1]])
    along = np.einsum("kji,kj->ki", u, e) * s / (s**2 + 1e-6)
    step = np.einsum("kij,ki->kj", vt[:, : e.shape[1]], along)
    return q + step * np.minimum(1, 0.5 / np.abs(step).max(axis=1, keepdims=True).clip(1e-9)), vt[:, -1]


def self_motion(arm, pose, task, rng, starts=700, walked=150):
    """Configurations (K, n) of a pose within the limits: from random starts, and from some of these along the null space."""
    low, high = np.maximum(arm.lower, -np.pi), np.minimum(arm.upper, np.pi)
    turns = ~np.isfinite(arm.upper)

    def kept(q):
        q = np.where(turns, (q + np.pi) % (2 * np.pi) - np.pi, q)
        good = np.abs(error(arm, q, pose, task)).max(axis=1) < 1e-5
        return q[good & ((q >= arm.lower) & (q <= arm.upper)).all(axis=1)]

    q = rng.uniform(low, high, (starts, arm.n))
    for _ in range(15):
        q, _ = step_onto(arm, q, pose, task)
    found = [kept(q)]
    for sign in (-1, 1):
        q, ahead = found[0][:walked], sign
        for _ in range(10):
            there, null = step_onto(arm, q, pose, task)
            null = null * np.sign((null * ahead).sum(axis=1, keepdims=True))
            q, _ = step_onto(arm, there + 0.05 * null, pose, task)
            ahead = null
            found.append(kept(q))
    return np.concatenate(found)


@lru_cache
def case(name):
    """The arm, an optimised assessment of a few poses, and rho at many configurations of each of them."""
    arm, task = load(name), TASKS[name]
    rng = np.random.default_rng(20)
    poses = oracles.forward(arm, rng.uniform(np.maximum(arm.lower, -1.5), np.minimum(arm.upper, 1.5), (POSES, arm.n)))
    run = hf.assess(arm, hf.Region.from_poses(poses), task=task, optimise=True, clearance=False, after_lock=True)
    assert run.distribution.reached == POSES
    return arm, run, [rho(arm, self_motion(arm, pose, task, rng), task) for pose in poses]


def assert_as_good(found, brute):
    """The optimiser is not worse than the best sample, and not better than a dense sample allows."""
    np.testing.assert_array_less(np.sort(brute) * (1 - 2e-3), np.sort(found))
    np.testing.assert_array_less(np.sort(found) * 0.97, np.sort(brute))


@pytest.mark.parametrize("name", TASKS)
def test_optimisation_gains_what_brute_force_gains(name):
    _, run, samples = case(name)
    assert_as_good(run.optimised.values, [x.min(axis=1).max() for x in samples])


@pytest.mark.parametrize("name", TASKS)
def test_the_value_without_a_joint_is_optimised_again(name):
    arm, run, samples = case(name)
    for k in range(arm.n):
        found = run.if_never_fails(k, optimised=True).values
        assert_as_good(found, [np.delete(x, k, axis=1).min(axis=1).max() for x in samples])
        np.testing.assert_array_less(run.optimised.values - 1e-12, found)


@pytest.mark.parametrize("name", TASKS)
def test_the_joint_to_double_is_that_of_brute_force(name):
    arm, run, samples = case(name)
    after = np.array([[np.delete(x, k, axis=1).min(axis=1).max() for x in samples] for k in range(arm.n)])
    before = np.array([x.min(axis=1).max() for x in samples])
    threshold = np.sqrt(before.max() * after.max())  # no pose meets it now
    best = run.upgrades(threshold, optimised=True)[0]
    wanted = (after >= threshold).mean(axis=1)
    assert best.before == 0
    assert best.after == pytest.approx(wanted.max())
    assert wanted[arm.joint_index(best.joint)] == wanted.max()


def test_the_elbow_of_a_gen3_is_worth_a_second_motor():
    """The configurations chosen for all failures keep 0.02 without the elbow as well; those chosen again keep up to 0.33."""
    _, run, samples = case("gen3")
    (best, *others) = run.upgrades(0.1, optimised=True)
    assert (best.joint, best.before) == ("joint_4", 0)
    assert best.after == pytest.approx(2 / 3)
    assert {u.after for u in others} == {0}
    assert all(x.min(axis=1).max() < 0.05 for x in samples)


@pytest.mark.parametrize("name", TASKS)
def test_weak_joints_are_those_whose_lock_leaves_little_manipulability(name):
    arm, task = load(name), TASKS[name]
    j = oracles.task_jacobian(arm, np.random.default_rng(7).uniform(-np.pi, np.pi, (4000, arm.n)), task)
    healthy = np.linalg.svd(j, compute_uv=False).prod(axis=1).max()
    left = [np.linalg.svd(np.delete(j, k, axis=2), compute_uv=False).prod(axis=1).max() / healthy for k in range(arm.n)]
    found = structure(arm, task)
    assert [w.joint for w in found.weak] == [k for k in range(arm.n) if left[k] <= 0.03]
    assert [w.joint for w in found.weak] == ([3] if name == "gen3" else [])
    for w in found.weak:
        assert w.manipulability_left == pytest.approx(left[w.joint], rel=0.3)
        assert w.best < 0.2 * w.bound


def test_the_axes_of_a_gen3_miss_a_point_by_12_mm():
    """5.375 mm and 6.375 mm lie along the second axis, between its feet on the first and on the third."""
    arm = load("gen3")
    (weak,) = structure(arm, "pose").weak
    assert weak.axis_distance == pytest.approx(0.005375 + 0.006375, abs=1e-12)
    text = explain(arm, structure(arm, "pose"), structures(arm))
    assert "joint_4 (joint 4) nearly is" in text
    assert "by 12 mm" in text
    assert text.endswith("Possible after every single lock: position.")


def test_the_report_warns_of_the_elbow_of_a_gen3(tmp_path):
    _, run, _ = case("gen3")
    page = run.report(tmp_path / "report.html").read_text()
    assert '<div class="callout warn"><p><strong>A lock of joint_4 nearly ends this task</strong>' in page
    left = run.survival()["joint_4"].value
    assert f"Once joint_4 has locked, {format_percent(left)} of the poses" in page.replace("\u00a0", " ")


@pytest.mark.parametrize("name", ["gen3", "panda", "iiwa14"])
def test_the_joint_that_caps_the_value_is_named(name):
    """Where it is named, brute force gains less than a tenth of a loss with it, and at least as much as the loss without it."""
    arm = load(name)
    q = np.array([0.3, 0.5, 0.2, 1.2 if name == "gen3" else -1.2, 0.4, 0.7, 0.1])
    index = hf.indices.relative_manipulability(arm)
    found = hf.optimise(arm, oracles.forward(arm, q[None])[0], index, initial=q)
    if name == "panda":
        assert found.cap is None
        return
    samples = rho(arm, self_motion(arm, found.poses, "pose", np.random.default_rng(3)), "pose")
    before, after = (rho(arm, x[None], "pose")[0] for x in (q, found.q))
    loss = (before - after).max()
    assert found.cap.failure == arm.joint_names[3]
    assert samples.min(axis=1).max() - before.min() < 0.1 * loss
    others = [0, 1, 2, 4, 5, 6]
    assert found.cap.remaining == tuple(others)
    best = samples[:, others].min(axis=1).max()
    assert best - before[others].min() > loss
    again = hf.optimise(arm, found.poses, index.with_failures([[k] for k in others]), initial=q)
    assert again.cap is None
    assert_as_good([float(again.value)], [best])


def test_what_an_index_of_ones_own_gains_without_a_joint():
    """It is built again for fewer failures, like one that has a name."""
    arm = load("planar-3r")
    own = hf.indices.CustomIndex(lambda j: ca.sumsqr(j), arm, "planar")
    poses = oracles.forward(arm, np.array([[0.3, 0.9, 0.7], [0.1, 1.5, -0.4]]))
    run = hf.assess(arm, hf.Region.from_poses(poses), own, optimise=True)
    for k in range(3):
        again = own.with_failures([[i] for i in range(3) if i != k])
        best = hf.optimise(arm, poses, again, starts=300).value
        np.testing.assert_allclose(run.if_never_fails(k, optimised=True).values, np.sort(best), rtol=1e-3)


def test_thresholds_and_axes_fit_small_values():
    """The bound is 0.378 and the elbow of a Gen3 caps the index near 0.02: usual thresholds would give rows of zeros."""
    _, run, samples = case("gen3")
    found = run.to_dict()
    best = max(x.min(axis=1).max() for x in samples)
    assert all(0 < p["at_least"] <= 1.01 * best for p in found["probability"])
    assert max(p["value"] for p in found["optimised"]["probability"]) > 0
    assert AssessmentFacts(run, None).axis_values[-1] < 5 * best
    assert AssessmentFacts(run, 0.3).axis_values[-1] > 0.3  # a threshold that was asked for is always shown


@pytest.mark.parametrize("name", [n for n in INDEX_REGISTRY if n != "directional-velocity"])
def test_every_index_is_explained_in_one_line(name):
    assert explain_index(INDEX_REGISTRY.make(name, load("panda")))


def test_the_console_begins_with_the_reach_after_the_worst_lock():
    _, run, _ = case("gen3")
    shares = run.survival()
    worst = min(shares, key=lambda joint: shares[joint].value)
    assert run.describe()[0].startswith(
        f"Once {worst} has locked, {format_percent(shares[worst].value)} of the poses of the region are"
    )
