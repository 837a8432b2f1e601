"""Random motions from point to point."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.model.arm.configurations import sampling_limits


@pytest.fixture(scope="module")
def arm():
    return hf.arms.load("planar-3r")


def seeds(rng):
    return int(rng.integers(1 << 30))


def test_starts_are_within_the_limits_and_targets_can_be_reached(mixed7, rng):
    found = hf.point_to_point(mixed7, 300, seed=seeds(rng))
    low, high = sampling_limits(mixed7)
    for q in (found.q0, found.q_target):
        assert (q >= low).all()
        assert (q <= high).all()
        assert (np.ptp(q, axis=0) > 0.8 * (high - low)).all()
    np.testing.assert_allclose(found.target, oracles.forward(mixed7, found.q_target), atol=1e-12)
    start = oracles.forward(mixed7, found.q0)[:, :3, 3]
    np.testing.assert_allclose(found.distance, np.linalg.norm(found.target[:, :3, 3] - start, axis=1), atol=1e-12)


def test_more_motions_begin_with_the_same(arm, rng):
    seed = seeds(rng)
    few, many = (hf.point_to_point(arm, count, seed=seed, distance=(0.5, 2.0)) for count in (20, 400))
    np.testing.assert_array_equal(few.q0, many.q0[:20])
    np.testing.assert_array_equal(few.target, many.target[:20])
    assert (many.distance >= 0.5).all()
    assert (many.distance <= 2.0).all()
    assert "0.5 to 2 m long" in few.describe()
    assert not np.array_equal(few.q0, hf.point_to_point(arm, 20, seed=seed + 1).q0)


@pytest.mark.parametrize("joint", [0, 1, 2])
def test_targets_that_stay_within_reach_are_kept_and_only_those(arm, rng, joint):
    """Closed form: two links reach a ring about where they begin, whatever stands."""
    seed = seeds(rng)
    every = hf.point_to_point(arm, 200, seed=seed)
    kept = hf.point_to_point(arm, 60, seed=seed, failures=[joint], task="planar")
    reached = in_ring(every, joint)
    clear = np.abs(margin(every, joint)) > 1e-6
    told = (every.q0[:, None] == kept.q0[None]).all(axis=2).any(axis=1)
    upto = np.flatnonzero(told).max() + 1
    np.testing.assert_array_equal(told[:upto][clear[:upto]], reached[:upto][clear[:upto]])
    assert margin(kept, joint).min() > -1e-6


def margin(motions, joint):
    """How far a target is inside the ring that the two healthy joints reach, m; links of 1 m, limits of +-180 deg."""
    x, q = motions.target[:, :2, 3], motions.q0
    if joint == 0:
        x, first, second = x - np.stack([np.cos(q[:, 0]), np.sin(q[:, 0])], axis=1), 1.0, 1.0
    else:
        bent = np.abs(1 + np.exp(1j * q[:, joint]))
        first, second = (bent, 1.0) if joint == 1 else (1.0, bent)
    r = np.linalg.norm(x, axis=1)
    return np.minimum(first + second - r, r - np.abs(first - second))


def in_ring(motions, joint):
    return margin(motions, joint) > 0


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"count": 0}, "count is 0"),
        ({"count": 3, "distance": (2, 1)}, "distance is 2 to 1 m"),
        ({"count": 3, "distance": (50, 60)}, "only 0 of"),
        ({"count": 3, "failures": "all"}, "failures 'all' is not known"),
        ({"count": 3, "failures": ["elbow"]}, "elbow"),
        ({"count": 3, "failures": "pairs"}, "failure 'joint1.joint2' locks several joints at once"),
        ({"count": 3, "failures": [1], "restarts": 0}, "restarts is 0"),
    ],
)
def test_wrong_wishes_are_one_sentence(arm, options, words):
    with pytest.raises((hf.InputError, hf.TaskError), match=words):
        hf.point_to_point(arm, **options)
