"""Ceilings of the least singular value (S0 to S3): random Jacobians and an optimiser try to beat them, frames attain them."""

from itertools import combinations

import numpy as np
import pytest
from scipy.optimize import minimize

import holdfast as hf


def least(j, k):
    """The least singular value after the worst k columns are gone, (...,), by NumPy alone."""
    n = j.shape[-1]
    left = [np.linalg.svd(np.delete(j, list(s), axis=-1), compute_uv=False)[..., -1] for s in combinations(range(n), k)]
    return np.min(left, axis=0)


@pytest.mark.parametrize(
    ("size", "said", "by"),
    [
        ({"n": 3, "m": 2}, 0.707107, "S1"),
        ({"n": 5, "m": 3}, 0.816497, "S1"),
        ({"n": 6, "m": 3, "k": 2}, 0.743496, "S2"),
        ({"n": 5, "m": 1, "k": 2}, np.sqrt(3), "S0"),
        ({"n": 7, "m": 6, "angular": True}, np.sqrt(1 / 3), "S1"),
        ({"n": 7, "m": 6, "angular": True, "lever": np.inf}, np.sqrt(7 / 12), "S3"),
        ({"n": 9, "m": 6, "angular": True, "lever": np.inf, "k": 2}, np.sqrt(3 / 2), "S3"),
    ],
)
def test_values_of_the_theorems(size, said, by):
    c = hf.index_bounds.bound_singular_value(**size)
    assert (c.bound, c.bound_by) == (pytest.approx(said, abs=1e-6), by)
    assert c.describe()[0].startswith(f"With {c.n} joints")


@pytest.mark.parametrize(("n", "m", "k"), [(3, 2, 1), (7, 3, 1), (6, 3, 2), (7, 2, 3), (6, 5, 1)])
def test_no_random_jacobian_beats_them(n, m, k, rng):
    j = rng.normal(size=(1000, m, n)) * rng.uniform(0.2, 1, size=(1000, 1, n))
    found = least(j, k) / np.sqrt((j**2).sum(axis=(1, 2)) / n)
    assert 0 < found.max() <= hf.index_bounds.bound_singular_value(n=n, m=m, k=k).bound


def test_no_random_pose_beats_them(rng):
    """Columns (v, w) with unit w across v: of any length, and of mean square length 1."""
    w = rng.normal(size=(1000, 3, 8))
    w /= np.linalg.norm(w, axis=1, keepdims=True)
    v = np.cross(w, rng.normal(size=w.shape), axis=1)
    long = np.concatenate([30 * v, w], axis=1)
    assert least(long, 1).max() <= hf.index_bounds.bound_singular_value(n=8, m=6, angular=True, lever=np.inf).bound
    v /= np.sqrt((v**2).sum(axis=(1, 2), keepdims=True) / 8)
    assert (
        least(np.concatenate([v, w], axis=1), 2).max()
        <= hf.index_bounds.bound_singular_value(n=8, m=6, k=2, angular=True).bound
    )


@pytest.mark.parametrize(("n", "m", "k"), [(3, 2, 1), (5, 3, 1), (5, 2, 2)])
def test_an_optimiser_does_not_beat_them(n, m, k, rng):
    def loss(x):
        j = x.reshape(m, n)
        return -float(least(j, k)) / np.sqrt((x**2).sum() / n)

    bound = hf.index_bounds.bound_singular_value(n=n, m=m, k=k).bound
    best = max(-minimize(loss, rng.normal(size=m * n), method="Powell", options={"maxiter": 6}).fun for _ in range(2))
    assert 0.8 * bound < best <= bound * (1 + 1e-12)


def test_frames_attain_them():
    for n, m in ((3, 2), (7, 3), (6, 5)):
        c = hf.index_bounds.bound_singular_value(n=n, m=m, lever=0.8)
        assert np.linalg.norm(c.jacobian, axis=0) == pytest.approx(0.8)
        assert least(c.jacobian, 1) == pytest.approx(c.bound, rel=1e-12)
    # S2: the six diagonals of an icosahedron, from the null space of equal angles
    null = hf.index_bounds.upper_bound(n=6, m=3, k=2).null_space
    rows = np.linalg.qr(null, mode="complete")[0][:, 3:].T * np.sqrt(2)
    assert np.linalg.norm(rows, axis=0) == pytest.approx(1)
    assert least(rows, 2) == pytest.approx(hf.index_bounds.bound_singular_value(n=6, m=3, k=2).bound, abs=1e-6)


@pytest.mark.parametrize(("name", "task"), [("panda", "position"), ("pa10-9dof", "pose")])
def test_the_levers_of_an_arm_bound_its_columns(name, task, rng):
    arm = hf.arms.load(name)
    index = hf.indices.minimum_singular_value(arm, task, length=0.5)
    c = hf.index_bounds.bound_singular_value_of_index(index)
    assert c.angular == (task == "pose")
    q = rng.uniform(np.maximum(arm.lower, -3), np.minimum(arm.upper, 3), (200, arm.n))
    columns = index.task_jacobian(q)[:, :3]
    assert np.sqrt((columns**2).sum(axis=1).mean(axis=1)).max() <= c.lever * (1 + 1e-12)
    assert index(q).max() <= c.bound
    assert hf.index_bounds.bound_singular_value_of_index(hf.indices.minimum_singular_value(arm, task, failures=[0, 1])) is None


@pytest.mark.parametrize(
    ("size", "said"),
    [
        ({"n": 6, "m": 6}, "no redundancy"),
        ({"n": 7, "m": 6, "lever": 0.0}, "the lever is 0"),
        ({"n": 7, "m": 6, "lever": np.inf}, "infinite for a pose alone"),
    ],
)
def test_sizes_that_have_none(size, said):
    with pytest.raises(hf.InputError, match=said):
        hf.index_bounds.bound_singular_value(**size)
