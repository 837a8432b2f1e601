"""The best path over manifolds against brute force over every sequence of points."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import InputError
from holdfast.core.status import Status
from holdfast.kinematics.paths import line
from holdfast.kinematics.solvers import SelfMotion, best_path
from holdfast.kinematics.solvers.fibre_paths import best_path_over
from holdfast.model.arm.task import as_task


@pytest.fixture(scope="module")
def arm() -> hf.Arm:
    """Two joints that turn without limits, and one with."""
    free = [hf.DH(a=1.0, alpha=0.0) for _ in range(2)]
    return hf.Arm.from_dh([*free, hf.DH(a=1.0, alpha=0.0, lower=-3.0, upper=3.0)], name="3R")


def given(arm, points, spacing=0.1) -> list[SelfMotion]:
    """Manifolds of which only the points (T lists of (K, 3)) matter."""
    task = as_task(arm, "planar")
    return [
        SelfMotion(
            arm=arm,
            pose=np.eye(4),
            task=task,
            redundancy=1,
            components=(),
            q=np.asarray(p, dtype=float).reshape(-1, 3),
            spacing=spacing,
            status=Status.OK if len(p) else Status.NOT_FOUND,
        )
        for p in points
    ]


def apart(a, b):
    d = b - a
    d[:2] = np.arctan2(np.sin(d[:2]), np.cos(d[:2]))
    return d


def brute_force(points, value, limit, spacing, cost, motion):
    """Smallest cost over all sequences that keep to the limit."""
    values = [value(p) for p in points]
    every = np.concatenate(values)
    weight = motion * (np.median(every) - every.min())
    reach = np.linalg.norm(np.full(3, limit + spacing))
    best = (np.inf, np.inf)
    for choice in itertools.product(*(range(len(p)) for p in points)):
        moves = [apart(points[t][choice[t]], points[t + 1][choice[t + 1]]) for t in range(len(points) - 1)]
        if any((np.abs(m) > limit + spacing).any() for m in moves):
            continue
        v = [values[t][k] for t, k in enumerate(choice)]
        total = sum(v) + weight * sum((np.linalg.norm(m) / reach) ** 2 for m in moves)
        best = min(best, (max(v) if cost == "max" else 0.0, total))
    return best[1], weight, reach


@pytest.mark.parametrize("cost", ["mean", "max"])
@pytest.mark.parametrize("motion", [0.0, 0.01, 3.0])
def test_brute_force(arm, rng, cost, motion):
    def value(q):
        return np.sin(3 * q[:, 0]) + q[:, 1] ** 2 + np.cos(5 * q[:, 2])

    solved = 0
    for _ in range(8):
        points = [np.array([3.0, 0, 0]) + rng.uniform(-1, 1, (int(rng.integers(3, 6)), 3)) for _ in range(5)]
        limit, spacing = 1.0, 0.1
        want, weight, reach = brute_force(points, value, limit, spacing, cost, motion)
        got = best_path_over(arm, given(arm, points, spacing), value, rate_limit=limit, cost=cost, motion=motion)
        assert got.continuous == np.isfinite(want)
        if got.continuous:
            solved += 1
            moves = [apart(*pair) for pair in itertools.pairwise(got.q.copy())]
            total = got.value.sum() + weight * sum((np.linalg.norm(m) / reach) ** 2 for m in moves)
            assert total == pytest.approx(want, rel=1e-12)
            assert (np.abs(moves) <= limit + spacing).all()
            np.testing.assert_allclose(value(got.q), got.value, atol=1e-12)
        np.testing.assert_allclose(got.global_value, [value(p).min() for p in points], atol=1e-12)
        np.testing.assert_allclose(value(got.global_q), got.global_value, atol=1e-12)
    assert solved


def test_no_jump_where_there_is_no_way_on(arm):
    """Two valleys: the better one breaks off after pose 2, the other begins at pose 1; a third piece at pose 4."""
    low, high = [0.0, 0.0, 0.0], [0.0, 0.0, 2.0]
    points = [[low], [low, high], [low, high], [high], [[0.0, 2.0, -2.0]], [[0.0, 2.0, -2.0]]]
    path = best_path_over(arm, given(arm, points), lambda q: q[:, 2] ** 2, rate_limit=0.3)
    np.testing.assert_array_equal(path.gaps, [2, 3])
    assert not path.continuous
    np.testing.assert_array_equal(path.q[:, 2], [0, 0, 0, 2, -2, -2])
    np.testing.assert_array_equal(path.value, path.q[:, 2] ** 2)
    np.testing.assert_array_equal(path.status, Status.OK)


def test_a_worse_start_is_taken_where_it_alone_leads_through(arm):
    low, high = [0.0, 0.0, 0.0], [0.0, 0.0, 2.0]
    points = [[low, high], [low, high], [high]]
    path = best_path_over(arm, given(arm, points), lambda q: q[:, 2] ** 2, rate_limit=0.3)
    assert path.continuous
    np.testing.assert_array_equal(path.q[:, 2], 2)
    np.testing.assert_array_equal(path.global_value, [0, 0, 4])


def test_poses_without_configurations_and_values_that_are_nan(arm):
    here = [[0.0, 0.0, 0.0]]
    points = [here, [], here, here, here]
    objective = np.array([1.0, 2.0, np.nan, 3.0])
    path = best_path_over(arm, given(arm, points), lambda q: objective)
    np.testing.assert_array_equal(path.status, [Status.OK, Status.NOT_FOUND, Status.OK, Status.UNDEFINED, Status.OK])
    np.testing.assert_array_equal(path.value, [1, np.nan, 2, np.nan, 3])
    np.testing.assert_array_equal(np.isnan(path.q).all(axis=1), [False, True, False, True, False])
    assert not path.continuous
    assert path.gaps.size
    with pytest.raises(hf.HoldfastError, match="best path: 2 of 5 rows failed; first: row 1, not_found"):
        path.require_ok()


def test_turning_joints_run_on_beyond_pi(arm):
    angles = np.arange(0, 9, 0.25)
    points = [[[np.arctan2(np.sin(x), np.cos(x)), 0.0, 0.0]] for x in angles]
    path = best_path_over(arm, given(arm, points), lambda q: q[:, 1] * 0, rate_limit=0.3)
    assert path.continuous
    np.testing.assert_allclose(path.q[:, 0], angles, atol=1e-12)


def test_a_path_of_a_real_fibre(arm, rng):
    """Global values against a scan of the first joint in closed form."""
    from test_self_motion import closed_form

    def value(q):
        return np.sin(q[:, 1]) + 0.3 * np.cos(q[:, 2] - 1) + 0.2 * np.sin(q[:, 0])

    poses = line([1.3, -0.4, 0], [1.3, 0.6, 0]).pose(np.linspace(0, 1, 25))
    for cost in ("mean", "max"):
        path = best_path(arm, poses, value, task="planar", cost=cost)
        assert path.continuous
        np.testing.assert_allclose(oracles.forward(arm, path.q)[:, :2, 3], poses[:, :2, 3], atol=1e-9)
        assert (path.value >= path.global_value).all()
        moves = np.array([apart(a.copy(), b.copy()) for a, b in itertools.pairwise(path.q)])
        assert (np.linalg.norm(moves, axis=1) <= path.reach + 1e-12).all()
        for pose, smallest in zip(poses, path.global_value, strict=True):
            scan = closed_form((1, 1, 1), pose[:2, 3], 4000)
            scan = scan[np.abs(scan[:, 2]) <= 3]
            assert smallest == pytest.approx(value(scan).min(), abs=2e-3)
    assert path.value.max() == pytest.approx(path.global_value.max(), abs=0.05)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"poses": np.eye(4)}, r"a path needs \(T, 4, 4\) with T of 2 or more"),
        ({"poses": np.eye(4)[None]}, "T of 2 or more"),
        ({"rate_limit": 0.0}, "rate_limit is 0.0; it must be one number or 3, above 0"),
        ({"rate_limit": [1.0, 2.0]}, "it must be one number or 3"),
        ({"cost": "sum"}, "cost is 'sum'; use 'mean' or 'max'"),
        ({"motion": -1.0}, "motion is -1; it must be 0 or more"),
        ({"objective_value": lambda q: q}, r"the objective gives shape \(\d+, 3\) for \d+ configurations"),
    ],
)
def test_errors(arm, change, message):
    poses = line([1.3, -0.4, 0], [1.3, -0.3, 0]).pose([0, 1])
    with pytest.raises(InputError, match=message):
        best_path(arm, **{"poses": poses, "objective_value": lambda q: q[:, 0], "task": "planar", **change})
