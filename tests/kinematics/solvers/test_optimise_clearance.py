"""Optimised configurations that keep the arm clear of itself: against distances of our own and exhaustive search."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import Capsules, Clearance, arms
from holdfast.core.errors import InputError
from holdfast.core.status import Status
from holdfast.kinematics.solvers import optimise

MARGIN = 0.02


def between_segments(a, b, c, d):
    """Distance (N,) between the segments a-b and c-d, (N, 3) each: Ericson, Real-Time Collision Detection, 5.1.9."""
    u, v, w = b - a, d - c, a - c
    dot = lambda x, y: np.einsum("ij,ij->i", x, y)  # noqa: E731
    uu, vv, uv, uw, vw = dot(u, u), dot(v, v), dot(u, v), dot(u, w), dot(v, w)
    with np.errstate(divide="ignore", invalid="ignore"):
        s = np.nan_to_num(np.clip((uv * vw - uw * vv) / (uu * vv - uv**2), 0, 1))
        t = (uv * s + vw) / vv
        low, high = t < 0, t > 1
        s = np.where(low, np.clip(-uw / uu, 0, 1), np.where(high, np.clip((uv - uw) / uu, 0, 1), s))
    t = np.clip(t, 0, 1)
    return np.linalg.norm(w + s[:, None] * u - t[:, None] * v, axis=1)


def apart(clearance, q):
    """The clearance (N,) by NumPy: capsules moved by the oracle's frames."""
    moving = oracles.frames(clearance.arm, q)[:-1]
    parts = clearance.capsules.parts

    def place(link, point):
        frame = moving[link + 1]
        return frame[:, :3, :3] @ np.array(point) + frame[:, :3, 3]

    ends = [(place(p.link, p.start), place(p.link, p.end)) for p in parts]
    gaps = [between_segments(*ends[a], *ends[b]) - parts[a].radius - parts[b].radius for a, b in clearance.pairs]
    return np.min(gaps, axis=0)


# ---- an arm in space -------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def index():
    return hf.indices.relative_manipulability(arms.load("panda"))


@pytest.fixture(scope="module")
def thick(index):
    """The base, the upper arm and the hand, twice as thick as assumed: few pairs, so that it compiles soon."""
    every = Capsules.along_links(index.arm, 0.14)
    return Clearance(index.arm, Capsules(tuple(p for p in every if p.link in (-1, 1, 6))))


@pytest.fixture(scope="module")
def poses(index, generator):
    return oracles.forward(index.arm, oracles.inside(index.arm, generator("thick panda"), 60))


@pytest.fixture(scope="module")
def free(index, poses):
    return optimise(index.arm, poses, index)


@pytest.fixture(scope="module")
def clear(index, poses, thick):
    return optimise(index.arm, poses, index, clearance=thick, margin=MARGIN)


def test_the_best_configurations_keep_the_margin(index, poses, thick, clear):
    good = clear.success
    assert good.sum() > 20
    assert (apart(thick, clear.q[good]) >= MARGIN - 1e-9).all()
    np.testing.assert_allclose(oracles.forward(index.arm, clear.q[good]), poses[good], atol=3e-6)
    assert ((clear.q[good] >= index.arm.lower) & (clear.q[good] <= index.arm.upper)).all()


def test_a_constraint_gains_nothing(free, clear):
    """Where the best configuration is clear anyway it is the very same; elsewhere the value is no better."""
    assert clear.blocked.any()
    assert (~clear.blocked & clear.success).any()
    np.testing.assert_array_equal(clear.start_q, free.start_q)
    same = ~clear.blocked
    np.testing.assert_array_equal(clear.q[same], free.q[same])
    held = clear.blocked & clear.success
    assert (clear.value[held] <= free.value[held] + 1e-9).all()


def test_blocked_says_that_the_best_is_not_clear(thick, free, clear):
    reached = free.success
    np.testing.assert_array_equal(clear.blocked[reached], apart(thick, free.q[reached]) < MARGIN)
    assert not free.blocked.any()


def test_infeasible_poses_have_no_clear_configuration(index, poses, thick, free, clear):
    """Many solutions of each such pose, found with other seeds: of thousands hardly one is clear."""
    none = clear.status == Status.INFEASIBLE
    assert none.any()
    assert clear.blocked[none].all()
    assert np.isnan(clear.q[none]).all()
    assert np.isnan(clear.value[none]).all()
    assert (clear.agreeing[none] == 0).all()
    np.testing.assert_array_equal(none | clear.success, free.success)
    many = np.repeat(poses[none], 60, axis=0)
    found = hf.solve_ik(index.arm, many, seed=99)
    assert found.success.mean() > 0.9
    assert (apart(thick, found.q[found.success]) >= MARGIN).mean() < 0.01


def test_one_pose_and_require_ok(index, poses, thick, clear):
    k = int(np.flatnonzero(clear.status == Status.INFEASIBLE)[0])
    alone = optimise(index.arm, poses[k], index, clearance=thick, margin=MARGIN)
    assert (alone.status, bool(alone.blocked)) == (Status.INFEASIBLE, True)
    with pytest.raises(hf.HoldfastError, match="relax"):
        alone.require_ok()


def test_what_does_not_fit_is_refused(index, poses, thick):
    other = Clearance(arms.load("xarm7"))
    with pytest.raises(InputError, match="clearance belongs to 'xarm7', not to 'panda'"):
        optimise(index.arm, poses, index, clearance=other)
    for margin in (np.nan, np.inf):
        with pytest.raises(InputError, match="margin is"):
            optimise(index.arm, poses, index, clearance=thick, margin=margin)


# ---- exhaustive search in the plane ------------------------------------------------------------------------------------


def every_configuration(point, count=4000):
    """Configurations of three unit links that put the tool on a point: every direction of the last link, two elbows."""
    angle = np.linspace(-np.pi, np.pi, count, endpoint=False)
    wrist = point - np.stack([np.cos(angle), np.sin(angle)], axis=1)
    cosine = ((wrist**2).sum(axis=1) - 2) / 2
    angle, wrist, cosine = (x[np.abs(cosine) <= 1] for x in (angle, wrist, cosine))
    rows = []
    for elbow in (np.arccos(cosine), -np.arccos(cosine)):
        first = np.arctan2(wrist[:, 1], wrist[:, 0]) - np.arctan2(np.sin(elbow), 1 + np.cos(elbow))
        rows.append(np.stack([first, elbow, angle - first - elbow], axis=1))
    return np.concatenate(rows)


def test_exhaustive_search_in_the_plane(rng):
    """First and third of three links as capsules in one plane: the best of all clear configurations, or none."""
    arm = hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0) for _ in range(3)], name="planar")
    index = hf.indices.manipulability(arm, "planar")
    clearance = Clearance(arm, Capsules.along_links(arm, 0.2))
    assert len(clearance.pairs) == 1
    radius, angle = rng.uniform(0.02, 2.8, 60), rng.uniform(-np.pi, np.pi, 60)
    poses = np.tile(np.eye(4), (60, 1, 1))
    poses[:, :2, 3] = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    best = optimise(arm, poses, index, clearance=clearance)
    free = optimise(arm, poses, index)
    assert best.blocked.any()
    short = []
    for k, pose in enumerate(poses):
        q = every_configuration(pose[:2, 3])
        values = oracles.index("manipulability", oracles.task_jacobian(arm, q, "planar"), [(0,), (1,), (2,)]).min(axis=1)
        gap = apart(clearance, q)
        assert values.max() <= free.value[k] + 1e-2
        if best.status[k] == Status.INFEASIBLE:
            assert gap.max() < 1e-2  # at most a sliver
        else:
            assert apart(clearance, best.q[k][None])[0] >= -1e-9
            assert best.blocked[k] == (apart(clearance, free.q[k][None])[0] < 0)
            short.append(values[gap >= 0].max(initial=0) - best.value[k])
    assert (np.array(short) <= 2e-3).mean() >= 0.95
