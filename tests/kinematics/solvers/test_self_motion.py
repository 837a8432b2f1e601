"""Self-motion of planar 3R arms against four-bar linkages in closed form; of real arms against other routes to the pose."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import InputError, TaskError, arms
from holdfast.core.status import Status
from holdfast.kinematics.paths import line
from holdfast.kinematics.solvers import fibres, self_motion, solve_ik
from holdfast.kinematics.solvers.curve_tracing import distance_to_curve

SPACING = 0.05


def three_links(a, b, c) -> hf.Arm:
    return hf.Arm.from_dh([hf.DH(a=x, alpha=0.0) for x in (a, b, c)], name="3R")


@pytest.fixture(scope="module")
def unit3() -> hf.Arm:
    return three_links(1, 1, 1)


def at(radius, angle=0.7) -> np.ndarray:
    return oracles.pose(None, [radius * np.cos(angle), radius * np.sin(angle), 0.0])


def wrapped(q):
    return np.arctan2(np.sin(q), np.cos(q))


def closed_form(lengths, target, count=400) -> np.ndarray:
    """Configurations of a 3R arm at a point (2,): scan the first joint, solve the triangle of the other two links."""
    a, b, c = lengths
    first = np.linspace(-np.pi, np.pi, count)
    left = target - a * np.stack([np.cos(first), np.sin(first)], axis=1)
    cosine = (np.einsum("ij,ij->i", left, left) - b * b - c * c) / (2 * b * c)
    first, left, cosine = (x[np.abs(cosine) <= 1] for x in (first, left, cosine))
    out = []
    for sign in (1, -1):
        third = sign * np.arccos(cosine)
        second = np.arctan2(left[:, 1], left[:, 0]) - np.arctan2(c * np.sin(third), b + c * np.cos(third)) - first
        out.append(np.stack([first, wrapped(second), third], axis=1))
    return np.concatenate(out)


def check_points(arm, motion, rows=slice(0, 6)) -> None:
    got = oracles.forward(arm, motion.q)
    np.testing.assert_allclose(got[:, :3, 3], np.broadcast_to(motion.pose[:3, 3], (len(got), 3)), atol=1e-9)
    if rows == slice(0, 6):
        np.testing.assert_allclose(got[:, :3, :3], np.broadcast_to(motion.pose[:3, :3], (len(got), 3, 3)), atol=1e-9)
    assert (motion.q >= arm.lower).all()
    assert (motion.q <= arm.upper).all()


@pytest.mark.parametrize("radius", [1.1, 1.5, 2.1213203435596424, 2.9])
def test_unit_links_beyond_one_metre_have_one_curve_with_the_joint_ranges_of_the_closed_form(unit3, radius):
    motion = self_motion(unit3, at(radius), "planar", spacing=SPACING)
    (curve,) = motion.components
    assert curve.closed
    assert curve.bounded_by == (None, None)
    check_points(unit3, motion, rows=slice(0, 2))
    first = np.arccos((radius**2 - 3) / (2 * radius))
    other = 2 * np.arccos((radius - 1) / 2)
    seen = np.abs(wrapped(curve.q - [0.7, 0, 0])).max(axis=0)
    assert (seen <= np.array([first, other, other]) + 1e-9).all()
    np.testing.assert_allclose(seen, [first, other, other], atol=SPACING**2)
    assert "form 1 closed curve" in motion.describe()[0]


@pytest.mark.parametrize("radius", [0.2, 0.5, 0.9])
def test_unit_links_within_one_metre_have_two_mirrored_curves(unit3, radius):
    motion = self_motion(unit3, at(radius), "planar", spacing=SPACING)
    assert [c.closed for c in motion.components] == [True, True]
    signs = set()
    low, high = 2 * np.arccos((1 + radius) / 2), 2 * np.arccos((1 - radius) / 2)
    for curve in motion.components:
        other = wrapped(curve.q[:, 1:])
        assert np.ptp(np.sign(other)) == 0
        signs.add(float(np.sign(other[0, 0])))
        np.testing.assert_allclose([np.abs(other).min(), np.abs(other).max()], [low, high], atol=SPACING**2)
        turned = np.unwrap(np.r_[curve.q[:, 0], curve.q[0, 0]])
        assert abs(turned[-1] - turned[0]) == pytest.approx(2 * np.pi)  # joint 1 goes all the way round
    assert signs == {1.0, -1.0}
    assert motion.components[0].length == pytest.approx(motion.components[1].length, rel=1e-3)


def test_number_of_curves_and_coverage_follow_the_rule_of_grashof(rng):
    """Arm and target make a four-bar linkage: two circuits if shortest + longest < the other two, else one."""
    for _ in range(7):
        lengths = rng.uniform(0.3, 1.2, 3)
        radius = rng.uniform(0.1, 0.95 * lengths.sum())
        sides = np.sort([*lengths, radius])
        slack = sides[0] + sides[3] - sides[1] - sides[2]
        if abs(slack) < 0.05 or sides[3] > sides[:3].sum() - 0.05:
            continue  # near a singular linkage, or out of reach
        arm = three_links(*lengths)
        motion = self_motion(arm, at(radius), "planar", spacing=SPACING)
        assert len(motion.components) == (2 if slack < 0 else 1)
        assert all(c.closed for c in motion.components)
        check_points(arm, motion, rows=slice(0, 2))
        known = closed_form(lengths, at(radius)[:2, 3])
        away = np.min([distance_to_curve(arm, c, known) for c in motion.components], axis=0)
        assert away.max() < 0.2 * SPACING
        ends = [np.r_[c.q, c.q[:1]] for c in motion.components]
        assert max(np.linalg.norm(wrapped(np.diff(q, axis=0)), axis=1).max() for q in ends) <= 1.6 * SPACING


def test_limits_cut_a_closed_curve():
    arm = arms.load("planar-3r")  # all joints within +-pi
    motion = self_motion(arm, at(0.5), "planar", spacing=SPACING)
    assert len(motion.components) == 2
    for curve in motion.components:
        assert not curve.closed
        assert curve.bounded_by == (0, 0)
        np.testing.assert_allclose(np.sort(curve.q[[0, -1], 0]), [-np.pi, np.pi], atol=1e-9)
    check_points(arm, motion, rows=slice(0, 2))


@pytest.mark.parametrize("name", ["panda", "iiwa14", "mixed7"])
def test_real_arms(name, rng, request):
    arm = request.getfixturevalue(name) if name == "mixed7" else arms.load(name)
    poses = arm.forward_kinematics(oracles.inside(arm, rng, 4))
    every = fibres(arm, poses, spacing=SPACING, starts=500)
    assert any(len(m.components) for m in every)
    for pose, motion in zip(poses, every, strict=True):
        assert motion.redundancy == 1
        check_points(arm, motion)
        for c in motion.components:
            assert np.linalg.norm(np.diff(c.q, axis=0), axis=1).max(initial=0) <= 1.6 * SPACING
            for end, joint in zip((c.q[0], c.q[-1]), c.bounded_by, strict=True):
                if joint is not None:
                    assert min(arm.upper[joint] - end[joint], end[joint] - arm.lower[joint]) <= 1e-9
                else:
                    least = np.linalg.svd(oracles.jacobian(arm, end[None])[0], compute_uv=False)[-1]
                    assert c.closed or least < 1e-3
        found = solve_ik(arm, np.stack([pose] * 40), seed=5, restarts=20)
        known = found.q[found.success]
        away = np.min([distance_to_curve(arm, c, known) for c in motion.components], axis=0)
        assert (away < 0.2 * SPACING).mean() > 0.9


def test_a_curve_runs_along_the_null_space(rng):
    arm = arms.load("panda")
    motion = self_motion(arm, arm.forward_kinematics(oracles.inside(arm, rng, 1)[0]), spacing=0.01)
    for c in motion.components:
        chord = (c.q[2:] - c.q[:-2])[5:-5]
        along = np.einsum("kij,kj->ki", oracles.jacobian(arm, c.q[1:-1][5:-5]), chord)
        assert np.abs(along).max(initial=0) < 1e-3 * 0.02


def test_two_degrees_of_redundancy_are_sampled_evenly(flat4, rng):
    motion = self_motion(flat4, at(1.6), "planar", spacing=0.3)
    assert motion.redundancy == 2
    assert motion.components == ()
    check_points(flat4, motion, rows=slice(0, 2))
    pairs = wrapped(motion.q[:, None] - motion.q[None])
    apart = np.linalg.norm(pairs, axis=2) + 10 * np.eye(len(motion.q))
    assert apart.min() >= 0.9 * 0.3 - 1e-12
    known = solve_ik(flat4, np.stack([motion.pose] * 200), task="planar", seed=3).require_ok().q
    away = np.linalg.norm(wrapped(known[:, None] - motion.q[None]), axis=2).min(axis=1)
    assert away.max() < 1.2 * 0.3
    assert "a manifold of dimension 2" in motion.describe()[0]


def test_curves_that_no_start_found_are_found_from_the_neighbours_on_a_path():
    arm = arms.load("panda")
    start = arm.forward_kinematics(np.array(arms.about("panda").home))
    end = start @ oracles.pose(None, [0.0, -0.15, 0.1])
    poses = line(start, end).pose(np.linspace(0, 1, 21))
    few, many = (fibres(arm, poses, starts=k, follow=k < 100) for k in (3, 200))
    assert [len(m.components) for m in few] == [len(m.components) for m in many]
    lost = fibres(arm, poses, starts=3)
    assert sum(len(m.components) for m in lost) < sum(len(m.components) for m in many)
    for motion in few:
        check_points(arm, motion)


def test_limits_hold_in_samples(mixed5, rng):
    motion = self_motion(mixed5, mixed5.forward_kinematics(oracles.inside(mixed5, rng, 1)[0]), "position", spacing=0.3)
    assert len(motion.q) > 10
    check_points(mixed5, motion, rows=slice(0, 3))


def test_a_pose_gives_the_same_alone_and_among_others(rng):
    arm = arms.load("panda")
    poses = arm.forward_kinematics(oracles.inside(arm, rng, 3))
    alone, among = self_motion(arm, poses[0], starts=16), fibres(arm, poses, starts=16)[0]
    np.testing.assert_array_equal(alone.q, among.q)
    assert [c.bounded_by for c in alone.components] == [c.bounded_by for c in among.components]


def test_poses_out_of_reach_and_nan(unit3):
    poses = np.stack([at(3.5), at(1.5), np.full((4, 4), np.nan)])
    status = [m.status for m in fibres(unit3, poses, "planar")]
    assert status == [Status.NOT_FOUND, Status.OK, Status.BAD_INPUT]
    assert fibres(unit3, poses, "planar")[0].q.shape == (0, 3)
    assert "does not prove that none exists" in fibres(unit3, poses, "planar")[0].describe()[0]
    assert fibres(unit3, np.zeros((0, 4, 4)), "planar") == []


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"task": "pose"}, TaskError, "has 3 joints and the task 'pose' 6 rows: without redundancy"),
        ({"task": "planar-pose"}, TaskError, "choose a task with fewer rows"),
        ({"task": "planar", "spacing": 0}, InputError, "spacing is 0; it must be above 0 and at most 0.5 rad"),
        ({"task": "planar", "spacing": np.nan}, InputError, "spacing is nan"),
        ({"task": "planar", "starts": 0}, InputError, "starts is 0; it must be 1 or more"),
        ({"task": "planar", "target": np.eye(4)[None]}, InputError, r"give one target, \(2,\) or \(4, 4\)"),
        ({"task": "planar", "target": [1.0, np.nan]}, InputError, "the target holds NaN or infinity"),
        ({"task": "planar", "target": [1.0, 0, 0]}, InputError, r"task 'planar' takes \(2,\) or \(N, 2\)"),
    ],
)
def test_errors(unit3, options, error, message):
    with pytest.raises(error, match=message):
        self_motion(unit3, **{"target": at(1.5), **options})
