"""Geometry of paths against finite differences, scipy's Slerp and circles from closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

import oracles
from holdfast import InputError
from holdfast.kinematics.paths import Path, arc, line, sequence


def twist_by_differences(pose, s, h=1e-5):
    """(N, 6): fourth order, the angular part read off ``dR/ds R'``."""
    a, b, c, d = (pose(s + k * h) for k in (1, -1, 2, -2))
    slope = (8 * (a - b) - (c - d)) / (12 * h)
    spin = slope[:, :3, :3] @ pose(s)[:, :3, :3].transpose(0, 2, 1)
    return np.concatenate([slope[:, :3, 3], np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], 1)], axis=1)


def inside(path: Path, rng, count: int = 50) -> np.ndarray:
    """Values of s away from the bounds of the legs."""
    s = rng.uniform(0.001, 0.999, count)
    return s[(np.abs(s[:, None] - path.bounds) > 1e-3).all(axis=1)]


def made(rng) -> dict[str, Path]:
    a, b, c, d = (oracles.random_pose(rng, 1.0) for _ in range(4))
    return {
        "line": line(a, b),
        "turn on the spot": line(a, oracles.pose(b[:3, :3], a[:3, 3])),
        "positions": sequence(rng.normal(size=(5, 3))),
        "poses": sequence([a, b, oracles.pose(c[:3, :3], b[:3, 3]), c, d]),
        "three points": arc(a, b, c),
        "about": arc(a, center=[0.1, 3.0, 0.2], axis=[1, 2, 2], angle=-1.2),
        "door": arc(a, center=[0.1, 3.0, 0.2], axis=[1, 2, 2], angle=7.5, turning=True),
    }


KINDS = list(made(np.random.default_rng(0)))


@pytest.mark.parametrize("kind", KINDS)
def test_twist_is_the_derivative_of_the_pose_and_its_slope_that_of_the_twist(kind, rng):
    path = made(rng)[kind]
    s = inside(path, rng)
    size = np.abs(path.twist(s)).max()
    np.testing.assert_allclose(path.twist(s), twist_by_differences(path.pose, s), atol=1e-8 * size)
    h = 1e-5
    slope = (path.twist(s + h) - path.twist(s - h)) / (2 * h)
    np.testing.assert_allclose(path.twist_slope(s), slope, atol=1e-6 * size)


@pytest.mark.parametrize("kind", KINDS)
def test_speed_is_the_length_everywhere(kind, rng):
    path = made(rng)[kind]
    s = inside(path, rng)
    v = path.twist(s)
    linear, angular = np.linalg.norm(v[:, :3], axis=1), np.linalg.norm(v[:, 3:], axis=1)
    if kind == "poses":
        speed = np.where(linear > 1e-9, linear, angular)
        assert np.ptp(speed) < 1e-12 * speed.max()
    else:
        np.testing.assert_allclose(angular if kind == "turn on the spot" else linear, path.length, rtol=1e-12)


def test_a_line_runs_straight_from_start_to_end_with_the_orientation_of_slerp(rng):
    a, b = oracles.random_pose(rng), oracles.random_pose(rng)
    path = line(a, b)
    np.testing.assert_allclose(path.pose([0, 1]), [a, b], atol=1e-15 * 10)
    s = rng.uniform(0, 1, 20)
    got = path.pose(s)
    np.testing.assert_allclose(got[:, :3, 3], a[:3, 3] + s[:, None] * (b - a)[:3, 3], atol=1e-14)
    slerp = Slerp([0, 1], Rotation.from_matrix(np.stack([a, b])[:, :3, :3]))
    np.testing.assert_allclose(got[:, :3, :3], slerp(s).as_matrix(), atol=1e-14)
    assert path.length == pytest.approx(np.linalg.norm((b - a)[:3, 3]))
    assert path.pose(0.5).shape == (4, 4)
    assert path.twist(0.5).shape == path.twist_slope(0.5).shape == (6,)
    assert path.oriented


def test_an_arc_through_three_points(rng):
    poses = np.stack([oracles.random_pose(rng) for _ in range(3)])
    path = arc(*poses)
    center, share = path.center[0], path.bounds[1]
    np.testing.assert_allclose(path.pose([0, share, 1]), poses, atol=1e-13)
    s = np.linspace(0, 1, 2001)
    p = path.pose(s)
    radius = np.linalg.norm(p[:, :3, 3] - center, axis=1)
    np.testing.assert_allclose(radius, radius[0], rtol=1e-12)
    normal = np.cross(poses[1, :3, 3] - poses[0, :3, 3], poses[2, :3, 3] - poses[0, :3, 3])
    assert np.abs((p[:, :3, 3] - center) @ normal).max() < 1e-13
    assert path.length == pytest.approx(np.linalg.norm(np.diff(p[:, :3, 3], axis=0), axis=1).sum(), rel=1e-6)
    slerp = Slerp([0, share, 1], Rotation.from_matrix(poses[:, :3, :3]))
    np.testing.assert_allclose(p[:, :3, :3], slerp(s).as_matrix(), atol=1e-13)


@pytest.mark.parametrize("via", [30.0, 100.0, 200.0, 350.0])
def test_an_arc_passes_its_via_point_before_its_end(via):
    point = lambda degrees: np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees)), 0.3])  # noqa: E731
    path = arc(point(0), point(via), point(355))
    assert path.length == pytest.approx(np.radians(355))
    assert not path.corners.size
    back = arc(point(0), point(-via), point(-355))
    assert back.length == pytest.approx(np.radians(355))
    np.testing.assert_allclose(path.pose(0.4)[:3, 3], point(0.4 * 355), atol=1e-12)
    assert not path.oriented
    np.testing.assert_array_equal(path.pose(0.7)[:3, :3], np.eye(3))


def test_a_door(rng):
    start = oracles.random_pose(rng)
    path = arc(start, center=[0.2, 0.1, 0], axis=[0, 0, 2], angle=np.pi / 2, turning=True)
    swing = oracles.pose(Rotation.from_euler("z", 90, degrees=True).as_matrix())
    hinge = oracles.pose(None, [0.2, 0.1, 0])
    np.testing.assert_allclose(path.pose(1.0), hinge @ swing @ np.linalg.inv(hinge) @ start, atol=1e-14)
    kept = arc(start, center=[0.2, 0.1, 0], axis=[0, 0, 2], angle=np.pi / 2)
    np.testing.assert_allclose(kept.pose(1.0)[:3, :3], start[:3, :3], atol=1e-15)
    np.testing.assert_allclose(kept.pose(1.0)[:3, 3], path.pose(1.0)[:3, 3], atol=1e-15)


def test_a_sequence_meets_its_poses_at_the_bounds_and_jumps_at_corners(rng):
    poses = np.stack([oracles.random_pose(rng) for _ in range(5)])
    path = sequence(poses)
    np.testing.assert_allclose(path.pose(path.bounds), poses, atol=1e-13)
    np.testing.assert_array_equal(path.corners, path.bounds[1:-1])
    corner = path.corners[1]
    np.testing.assert_allclose(path.twist(corner), path.twist(corner + 1e-9), atol=1e-12)
    assert np.abs(path.twist(corner) - path.twist(corner - 1e-9)).max() > 1e-3
    straight = sequence([[0, 0, 0], [1, 0, 0], [3, 0, 0]])
    assert not straight.corners.size
    np.testing.assert_allclose(straight.bounds, [0, 1 / 3, 1])


def test_positions_take_the_orientation_of_the_pose_before(rng):
    a = oracles.random_pose(rng)
    path = sequence([[0, 0, 0], a, [1, 1, 1]])
    np.testing.assert_allclose(path.pose(path.bounds)[:, :3, :3], np.stack([a[:3, :3]] * 3), atol=1e-14)
    assert path.oriented
    assert not sequence(np.eye(3)).oriented


def test_length_of_a_turn_is_in_radians_and_a_line_says_what_it_is():
    half = line(np.eye(4), oracles.pose(Rotation.from_euler("x", 90, degrees=True).as_matrix()))
    assert half.length == pytest.approx(np.pi / 2)
    assert half.describe() == "a rotation of 90 deg"
    assert line([0, 0, 0], [0, 0, 0.5]).describe() == "0.5 m (straight); positions only"
    assert "2 corners" in sequence([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 0, 1]]).describe()
    assert "(arc)" in arc([1, 0, 0], [0, 1, 0], [-1, 0, 0]).describe()


def test_nan_stays_in_its_row(rng):
    path = made(rng)["three points"]
    s = np.array([0.2, np.nan, 0.7])
    for values in (path.pose(s), path.twist(s), path.twist_slope(s)):
        flat = values.reshape(3, -1)
        assert np.isnan(flat[1]).all()
        assert np.isfinite(flat[[0, 2]]).all()
    assert np.isnan(path.pose(np.nan)).all()


E = np.eye(4)
BAD = [
    (lambda: line(E, E), "poses 0 and 1 of the path .* are the same"),
    (lambda: sequence([E]), "a path needs 2 poses or more, got 1"),
    (lambda: sequence([]), "a path needs 2 poses or more, got 0"),
    (lambda: sequence([[0, 0, 0], [1, 0, 0], [1, 0, 0]]), "poses 1 and 2 of the path .* are the same; leave one"),
    (lambda: sequence([[0, 0, 0], [1, 0]]), r"pose 1 of the path has shape \(2,\); it must be \(4, 4\) or \(3,\)"),
    (lambda: line([0, 0, np.nan], [1, 0, 0]), "pose 0 of the path .* finite numbers"),
    (lambda: line("here", [1, 0, 0]), "line: start is 'here'; it must be numbers"),
    (lambda: line(2 * E, E), "no rotation in its upper left 3x3 block"),
    (lambda: arc([0, 0, 0], [1, 0, 0], [2, 0, 0]), "three points of the arc lie on a line"),
    (lambda: arc([0, 0, 0], [0, 0, 0], [2, 0, 0]), "three points of the arc lie on a line or are the same"),
    (lambda: arc([0, 0, 0], [1, 0, 0]), "either via and end, or center, axis and angle"),
    (lambda: arc([0, 0, 0], center=[1, 0, 0], axis=[0, 0, 1]), "either via and end, or center, axis and angle"),
    (lambda: arc([0, 0, 0], center=[1, 0], axis=[0, 0, 1], angle=1.0), "center of the arc .* 3 finite numbers"),
    (lambda: arc([0, 0, 0], center=[1, 0, 0], axis=[0, 0, 0], angle=1.0), "neither may be 0"),
    (lambda: arc([0, 0, 0], center=[1, 0, 0], axis=[1, 0, 0], angle=1.0), "lies on its axis"),
    (lambda: arc([0, 0, 0], center=[1, 0, 0], axis=[0, 0, 1], angle=1.0, turning=True), "must start from a pose"),
    (lambda: line([0, 0, 0], [1, 0, 0]).pose(1.1), "s is 1.1 to 1.1; it must lie from 0 to 1"),
    (lambda: line([0, 0, 0], [1, 0, 0]).twist(np.zeros((2, 2))), r"s has shape \(2, 2\)"),
]


@pytest.mark.parametrize(("call", "message"), BAD, ids=[m for _, m in BAD])
def test_bad_paths_are_answered_with_one_sentence(call, message):
    with pytest.raises(InputError, match=message) as caught:
        call()
    assert "\n" not in str(caught.value)
