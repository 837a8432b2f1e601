"""Every configuration, or a proof that there is none: beside closed forms, many starts of Newton's method, and samples."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast.kinematics.interval_search import SearchOutcome, all_configurations
from holdfast.kinematics.interval_search.box_bounds import BoundedTask, box_contraction_kernel
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.task import as_task
from holdfast.response.recovery.task_rows import make_row_solver


@pytest.fixture(scope="module")
def panda():
    return hf.arms.load("panda")


def locked_at(arm, q, joints, widths=1.0, rng=None):
    """The arm's limits with joints locked where q has them; of the others a part about q if ``widths`` is below 1."""
    low, high = (x.copy() for x in sampling_limits(arm))
    if widths < 1:
        size = widths * (high - low)
        begin = np.maximum(low, np.minimum(q - size * rng.uniform(0, 1, arm.n), high - size))
        low, high = begin, begin + size
    low[list(joints)] = high[list(joints)] = q[list(joints)]
    return low, high


def newton(arm, task, pose, low, high, starts, rng):
    """Configurations that Newton's method finds from random starts within limits."""
    solver = make_row_solver(arm, as_task(arm, task))
    free = high > low
    q = rng.uniform(low, high, (starts, arm.n))
    poses, kept = np.repeat(pose[None], starts, axis=0), np.ones((starts, solver.rows.m))
    q = solver.solve(q, poses, kept, free)
    q = q[solver.meets_rows(q, poses, kept, free) & ((q >= low) & (q <= high)).all(axis=1)]
    found = []
    for x in q:
        if all(np.abs(x - y).max() > 1e-4 for y in found):
            found.append(x)
    return np.array(found).reshape(-1, arm.n)


@pytest.mark.parametrize(("task", "locks"), [("pose", 1), ("pose", 2), ("pointing", 2), ("position", 4)])
def test_all_that_newton_finds_is_found_and_never_a_proof_against_it(panda, task, locks, rng):
    for k in range(6):
        q = rng.uniform(panda.lower, panda.upper)
        low, high = locked_at(panda, q, rng.choice(6 if task == "pointing" else 7, locks, replace=False))
        pose = panda.forward_kinematics(q if k % 2 == 0 else rng.uniform(panda.lower, panda.upper))
        found = all_configurations(panda, pose, task, limits=(low, high), time_limit=60)
        assert found.finding in (SearchOutcome.ALL, SearchOutcome.NONE)
        assert found.finding == SearchOutcome.ALL or k % 2
        solver = make_row_solver(panda, as_task(panda, task))
        errors = solver.compute_errors(found.q, np.repeat(pose[None], len(found.q), axis=0))
        np.testing.assert_allclose(errors, 0, atol=1e-8)
        if task != "pose" and high[-1] > low[-1]:  # the last joint is idle and left in the middle
            low[-1] = high[-1] = (low[-1] + high[-1]) / 2
        for x in newton(panda, task, pose, low, high, 400, rng):
            assert np.abs(found.q - x).max(axis=1).min() < 1e-5


def test_two_branches_of_a_planar_arm_and_none_beyond_its_reach():
    """Law of cosines: links of 1 m, joint 1 free, joint 2 free, joint 3 locked straight: a chain of 1 and 2 m."""
    arm = hf.arms.load("planar-3r")
    low, high = np.full(3, -np.pi), np.full(3, np.pi)
    low[2] = high[2] = 0.0
    for distance in (1.2, 2.0, 2.9):
        found = all_configurations(arm, [distance, 0.0], "planar", limits=(low, high))
        elbow = np.pi - np.arccos((1 + 4 - distance**2) / 4)
        np.testing.assert_allclose(np.sort(found.q[:, 1]), [-elbow, elbow], atol=1e-9)
        assert found.finding == SearchOutcome.ALL
    for distance in (0.98, 3.02):
        assert all_configurations(arm, [distance, 0.0], "planar", limits=(low, high)).proved_empty


@pytest.mark.parametrize(("types", "task"), [("RPRRRR", "pose"), ("RRRPR", "position"), ("RRRRRRR", "pose")])
def test_a_reachable_pose_is_never_proved_absent(types, task, generator):
    """Arms with nothing aligned, slides among them; each pose has a configuration within the limits by construction."""
    rng = generator(f"enclosure {types}")
    arm = oracles.random_arm(rng, types=types, limits=2.0)
    for _ in range(4):
        q = rng.uniform(arm.lower, arm.upper)
        low, high = locked_at(arm, q, rng.choice(arm.n, max(arm.n - (6 if task == "pose" else 3), 0), replace=False), 0.3, rng)
        found = all_configurations(arm, arm.forward_kinematics(q), task, limits=(low, high), first=True, time_limit=60)
        assert found.finding == SearchOutcome.SOME
        assert ((found.q >= low - 1e-6) & (found.q <= high + 1e-6)).all()


@pytest.mark.parametrize("task", ["pose", "pointing", "position"])
def test_no_box_that_holds_a_configuration_is_called_empty_or_cut_past_it(panda, task, rng):
    parts = BoundedTask.from_task(panda, as_task(panda, task))
    kernel = box_contraction_kernel(panda, parts)
    count = 20_000
    q = rng.uniform(panda.lower, panda.upper, (count, 7))
    half = rng.uniform(0, 1, (count, 7)) * 10 ** rng.uniform(-4, 0.5, (count, 1))
    half[rng.uniform(size=half.shape) < 0.2] = 0.0
    centre = q + half * rng.uniform(-1, 1, half.shape)
    poses = panda.forward_kinematics(q)
    margin, middle, radius, *_ = kernel(centre, half, poses[:, :3, 3], poses[:, :3, :3], np.zeros((count, parts.m)))
    assert margin.max() <= 0
    assert (np.abs(q - middle) - radius).max() <= 1e-13
    # The other way round: small boxes away from the pose are told to be empty, or the test would say nothing.
    far = kernel(centre, half * 1e-3, poses[:, :3, 3] + [0.3, 0, 0], poses[:, :3, :3], np.zeros((count, parts.m)))[0]
    assert (far > 0).mean() > 0.9


@pytest.mark.parametrize("task", ["pose", "pointing", "position"])
def test_no_box_that_holds_a_configuration_within_the_tolerance_is_called_empty_or_cut_past_it(panda, task, rng):
    """The pose is moved and turned by up to the allowed norms, in any direction."""
    parts = BoundedTask.from_task(panda, as_task(panda, task))
    kernel, count, allowed = box_contraction_kernel(panda, parts), 20_000, np.array([2e-3, 0.02])
    q, half = rng.uniform(panda.lower, panda.upper, (count, 7)), 10 ** rng.uniform(-5, 0.5, (count, 7))
    centre, poses = q + half * rng.uniform(-1, 1, half.shape), panda.forward_kinematics(q)
    errors = rng.normal(size=(2, count, 3))
    errors *= rng.choice([0.999, 0.5], (2, count, 1)) / np.linalg.norm(errors, axis=2, keepdims=True)
    poses[:, :3, 3] += allowed[0] * errors[0]
    poses[:, :3, :3] = Rotation.from_rotvec(np.arcsin(allowed[1]) * errors[1]).as_matrix() @ poses[:, :3, :3]
    tolerance = np.repeat(allowed, [len(parts.linear), parts.m - len(parts.linear)])
    margin, middle, radius, *_ = kernel(centre, half, poses[:, :3, 3], poses[:, :3, :3], tolerance)
    assert margin.max() <= 0
    assert (np.abs(q - middle) - radius).max() <= 1e-13


def test_a_tolerance_is_the_same_in_all_directions():
    arm, direction = hf.arms.load("planar-3r"), np.array([1.0, 1.0]) / np.sqrt(2)
    limits = np.array([0.0, -np.pi, 0.0]), np.array([0.0, np.pi, 0.0])  # the tool on a circle of 2 m about (1, 0)
    for point, is_proved in ((2.0009, True), (2.0006, False)):  # a tolerance of 0.5 mm of two rows allows 0.707 mm
        for offset in (point * direction, np.array([0.0, point]), np.array([0.0, 4 - point])):
            found = all_configurations(arm, offset + np.array([1.0, 0.0]), "planar", limits=limits, tolerance=5e-4)
            assert found.proved_empty == is_proved


def test_a_tolerance_is_part_of_the_proof():
    arm = hf.arms.load("planar-3r")
    limits = np.array([0.0, -np.pi, 0.0]), np.array([0.0, np.pi, 0.0])  # the tool on a circle of 2 m about (1, 0)
    assert all_configurations(arm, [1.0, 2.001], "planar", limits=limits).proved_empty
    assert all_configurations(arm, [1.0, 2.001], "planar", limits=limits, tolerance=5e-4).proved_empty
    assert not all_configurations(arm, [1.0, 2.001], "planar", limits=limits, tolerance=2e-3).proved_empty


def test_more_joints_than_rows_end_with_one_configuration(panda, rng):
    q = rng.uniform(panda.lower, panda.upper)
    found = all_configurations(panda, panda.forward_kinematics(q), time_limit=60)
    assert found.finding == SearchOutcome.SOME
    np.testing.assert_allclose(panda.forward_kinematics(found.q[0]), panda.forward_kinematics(q), atol=1e-7)
    away = panda.forward_kinematics(q)
    away[:3, 3] += [2.0, 0, 0]
    assert all_configurations(panda, away).proved_empty


def test_what_is_spent_is_said(panda, rng):
    pose = panda.forward_kinematics(rng.uniform(panda.lower, panda.upper))
    low, high = locked_at(panda, (panda.lower + panda.upper) / 2, [2])
    found = all_configurations(panda, pose, limits=(low, high), most_boxes=100)
    assert found.finding == SearchOutcome.OPEN
    assert found.open > 0
    assert found.widest > 0
    assert "undecided" in found.describe()[0]
    assert "undecided" in found.describe()[1]


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"limits": (np.zeros(6), np.ones(7))}, "limits must be two arrays of 7"),
        ({"limits": (np.ones(7), np.zeros(7))}, "upside down"),
        ({"tolerance": -1.0}, "tolerance is -1"),
        ({"time_limit": 0.0}, "time_limit 0"),
        ({"most_boxes": 0}, "most_boxes 0"),
    ],
)
def test_bad_input(panda, options, sentence):
    with pytest.raises(hf.InputError, match=sentence):
        all_configurations(panda, np.eye(4), **options)


@pytest.mark.parametrize(("types", "task", "free"), [("RRP", "position", 1), ("RRRPR", "position", 2), ("RRRRPR", "pose", 2)])
def test_a_slide_outside_its_stroke_is_no_proof(types, task, free, generator):
    """A lock may be anywhere: here 3 m out of a stroke of 0.05 m; what moves has the configuration by construction."""
    rng, slide = generator(f"stroke {types}"), types.index("P")
    for _ in range(3):
        arm = oracles.random_arm(rng, types=types, limits=2.0)
        stroke = np.where(np.arange(arm.n) == slide, 0.05, 2.0)
        arm, q = arm.with_limits(-stroke, stroke), rng.uniform(-1, 1, arm.n)
        q[slide] = 3.0
        low, high = q.copy(), q.copy()
        low[:free] -= 0.02
        high[:free] += 0.8
        pose = arm.forward_kinematics(q)
        assert not all_configurations(arm, pose, task, limits=(low, high), first=True, time_limit=60).proved_empty


def test_a_pose_tilted_out_of_the_plane_is_refused_and_one_in_it_is_not(rng):
    arm, q = hf.arms.load("planar-3r"), rng.uniform(-2, 2, 3)
    pose, tilted = arm.forward_kinematics(q), arm.forward_kinematics(q)
    tilted[:3, :3] = tilted[:3, :3] @ [[1, 0, 0], [0, 0.6, -0.8], [0, 0.8, 0.6]]
    assert np.abs(all_configurations(arm, pose, "planar-pose").q - q).max(axis=1).min() < 1e-6
    with pytest.raises(hf.TaskError, match="tilted out of the arm's plane"):
        all_configurations(arm, tilted, "planar-pose")


def test_a_task_without_bounds_is_refused(panda):
    with pytest.raises(hf.TaskError, match="nothing can be proved about"):
        all_configurations(panda, np.eye(4), hf.model.arm.task.task_from_rows(["vx", "wy"], frame="tool"))


def test_a_configuration_found_early_meets_the_pose_and_not_its_half_turn(panda, generator):
    """The orientation rows also vanish at half a turn, where Newton's method may end; forward kinematics decides."""
    rng = generator("half turns")
    for _ in range(8):
        q = rng.uniform(panda.lower, panda.upper)
        pose = panda.forward_kinematics(q)
        found = all_configurations(panda, pose, tolerance=1e-6, time_limit=60)
        assert found.finding == SearchOutcome.SOME
        np.testing.assert_allclose(panda.forward_kinematics(found.q[0]), pose, atol=1e-5)
        assert found.boxes < 200_000


def test_a_blocked_configuration_is_not_found(panda, generator):
    """Everything on one side of the middle of joint 1 is blocked, so that the configuration found lies on the other side."""
    rng, middle = generator("blocked side"), (panda.lower[0] + panda.upper[0]) / 2

    def blocked(centre, half):  # large boxes are undecided, as in collisions
        return (centre[:, 0] + half[:, 0] < middle) & (half.max(axis=1) < 1e-3)

    for _ in range(6):
        q = rng.uniform(panda.lower, panda.upper)
        q[0] = rng.uniform(middle, panda.upper[0])
        found = all_configurations(panda, panda.forward_kinematics(q), tolerance=1e-6, time_limit=60, blocked=blocked)
        assert found.finding == SearchOutcome.SOME
        assert found.q[0, 0] >= middle - 1e-5
