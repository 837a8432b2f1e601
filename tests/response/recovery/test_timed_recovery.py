"""Motions timed within accelerations: closed forms, a linear programme, differences of the file, and distances by hand."""

from __future__ import annotations

import csv
from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest
from scipy.interpolate import BSpline
from scipy.optimize import linprog
from scipy.sparse import lil_array
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast.kinematics.tool_constraints.manifold import ConstraintManifold
from holdfast.model.collision import Capsules
from holdfast.response.recovery import check_waypoints, completion, read_times, read_waypoints
from holdfast.response.recovery.space import FreeSpace
from holdfast.response.recovery.timing.motion import time_motion
from holdfast.response.recovery.timing.profile import compute_fastest_profile
from holdfast.response.recovery.timing.rounding import find_corner_cuts, round_corners


def fine_way(q, cut):
    return round_corners(q, cut, np.zeros((len(q), 0)))


def always(chords):
    return np.ones(len(chords.corner), dtype=bool)


def wide(q):
    return find_corner_cuts(q, np.zeros(len(q), dtype=bool), always)


def random_way(rng, n, count):
    return np.cumsum(rng.normal(size=(count, n)), axis=0)


# ---- the profile -----------------------------------------------------------------------------------------------------


def test_one_joint_runs_the_trapezoid(rng):
    for _ in range(50):
        length, v, a = 10 ** rng.uniform(-2, 1, 3)
        pieces = fine_way(np.array([[0.3], [0.3 - length]]), np.zeros(2))
        profile = compute_fastest_profile(pieces, np.array([v]), np.array([a]))
        took = length / v + v / a if length * a > v**2 else 2 * np.sqrt(length / a)
        assert profile.time[-1] == pytest.approx(took, rel=1e-12)
        time = np.linspace(0, took, 9)
        q, qd, _ = profile.sample(pieces, time)
        t = np.minimum(time, took - time)
        gone = np.where(t < v / a, a * t**2 / 2, v * (t - v / a / 2))
        np.testing.assert_allclose(np.abs(q[:, 0] - np.where(time < took / 2, 0.3, 0.3 - length)), gone, atol=1e-9 * length)
        np.testing.assert_allclose(-qd[1:-1, 0], np.minimum(a * t[1:-1], v), rtol=1e-9)


def by_linear_programme(pieces, v, a, count):
    """Seconds of the fastest way by HiGHS: squares of the speed at many places, of which the sum is largest."""
    place, of = [], []
    for k, length in enumerate(pieces.length):
        s = np.linspace(0, length, max(int(count * length / pieces.length.sum()), 4) + 1)
        place.append(s[:-1])
        of.append(np.full(len(s) - 1, k))
    of, s = np.concatenate(of), np.concatenate(place)
    step = np.append(np.diff(s), 0.0)
    step = np.where(step > 0, step, pieces.length[of] - s)
    middle = s + step / 2
    _, slope, bend = pieces.evaluate(of, middle)
    total = len(s) + 1
    rows, bounds = lil_array((2 * len(s) * len(v), total)), []
    r = 0
    for k in range(len(s)):
        for j in range(len(v)):
            for sign in (1, -1):
                rows[r, k] = sign * (bend[k, j] / 2 - slope[k, j] / (2 * step[k]))
                rows[r, k + 1] = sign * (bend[k, j] / 2 + slope[k, j] / (2 * step[k]))
                bounds.append(a[j])
                r += 1
    fast = np.min((v / np.maximum(np.abs(slope), 1e-12)) ** 2, axis=1)
    most = np.minimum(np.append(fast, fast[-1]), np.append(fast[0], fast))
    stop = np.append(pieces.stops[of] & (s == 0), True)
    found = linprog(
        -np.ones(total), A_ub=rows.tocsr(), b_ub=bounds, bounds=[(0, 0 if q else m) for q, m in zip(stop, most, strict=True)]
    )
    root = np.sqrt(np.maximum(found.x, 0))
    return float((2 * step / (root[:-1] + root[1:])).sum())


@pytest.mark.parametrize(("n", "count"), [(1, 4), (2, 3), (3, 5)])
def test_no_linear_programme_is_faster(rng, n, count):
    q = random_way(rng, n, count)
    v, a = rng.uniform(0.5, 3, n), rng.uniform(1, 6, n)
    cut = wide(q)
    if count == 5:
        cut[2] = 0.0  # and one corner at which it stops
    pieces = fine_way(q, cut)
    took = compute_fastest_profile(pieces, v, a).time[-1]
    assert took == pytest.approx(by_linear_programme(pieces, v, a, 300), rel=0.02)


def test_limits_are_kept_at_every_instant(rng):
    for n, count in ((1, 6), (2, 9), (7, 5), (3, 40)):
        q = random_way(rng, n, count)
        if n > 1:
            q[3, 0] = q[2, 0]  # a joint that pauses
        v, a = rng.uniform(0.5, 3, n), rng.uniform(1, 9, n)
        cut = wide(q) * rng.choice([0.0, 0.3, 1.0], count)
        pieces = fine_way(q, cut)
        profile = compute_fastest_profile(pieces, v, a)
        time = np.sort(np.concatenate([rng.uniform(0, profile.time[-1], 4000), profile.time]))
        x, rate, second = profile.sample(pieces, time)
        assert (np.abs(rate) <= v * (1 + 1e-9)).all()
        assert (np.abs(second) <= a * (1 + 1e-9)).all()
        np.testing.assert_allclose(x[-1], q[-1], atol=1e-12)
        # Rates and accelerations are those of the places.
        step = np.diff(time)[:, None]
        some = step[:, 0] > 1e-6
        mean = (np.diff(x, axis=0) / np.where(step > 0, step, 1))[some]
        assert (np.abs(mean) <= v * (1 + 1e-9)).all()
        assert (np.abs(np.diff(rate, axis=0)) <= a * step * (1 + 1e-9) + 1e-12).all()
        assert np.abs(mean - (rate[1:] + rate[:-1])[some] / 2).max() <= (a * step.max()).max()


def test_rounded_corners_are_quadratic_b_splines(rng):
    a, c, b = rng.normal(size=(3, 4))
    q = np.array([a, c, b])
    cut = np.array([0.0, 0.4, 0.0]) * min(np.linalg.norm(c - a), np.linalg.norm(b - c))
    pieces = fine_way(q, cut)
    begin, end = c + cut[1] * (a - c) / np.linalg.norm(a - c), c + cut[1] * (b - c) / np.linalg.norm(b - c)
    curve = BSpline(np.array([0, 0, 0, 1, 1, 1.0]), np.array([begin, c, end]), 2)
    share = np.linspace(0, 1, 11)
    made, _, _ = pieces.evaluate(np.full(11, 1), share * pieces.length[1])
    np.testing.assert_allclose(made, curve(share), atol=1e-12)
    seen = []
    find_corner_cuts(q, np.zeros(3, dtype=bool), lambda chords: seen.append(chords) or always(chords))
    (chords,) = seen
    whole = fine_way(q, wide(q))
    dense = whole.evaluate(np.full(4001, 1), np.linspace(0, whole.length[1], 4001))[0]
    k = np.minimum(np.arange(4001) * 12 // 4000, 11)
    off = dense - chords.first[k]
    along = chords.last[k] - chords.first[k]
    on = np.linspace(0, 1, 4001) * 12 - k
    assert (np.abs(off - on[:, None] * along) <= chords.deviations[k] + 1e-12).all()
    assert np.abs(off - on[:, None] * along).max() > 0.99 * chords.deviations.max()


# ---- what is proved of a rounded corner ------------------------------------------------------------------------------


def test_everything_beside_a_proved_piece_is_clear_and_keeps_its_rows(rng):
    arm = oracles.random_arm(rng, types="RRPRRR", limits=2.4)
    clearance = hf.Clearance(arm, Capsules.along_links(arm, 0.03))
    space = FreeSpace(arm, np.ones(6, dtype=bool), clearance, 0.01, np.zeros((1, 6)))
    q = rng.uniform(arm.lower, arm.upper, (400, 6))
    q = q[space.are_valid(q)][:80]
    a, b = q[::2], q[1::2]
    b = a[: len(b)] + 0.3 * (b - a[: len(b)])
    a = a[: len(b)]
    away = rng.uniform(0, 0.02, a.shape)
    said = space.are_segments_valid(a, b, away)
    assert said.any()
    assert (said <= space.are_segments_valid(a, b)).all()
    assert (said < space.are_segments_valid(a, b)).any()
    on, off = rng.uniform(0, 1, (300, 1)), rng.uniform(-1, 1, (300, 6))
    for x, y, most in zip(a[said], b[said], away[said], strict=True):
        assert clearance(x + on * (y - x) + off * most).min() >= 0.01 - 1e-9
    pose = arm.forward_kinematics(a[0])
    keep = [
        hf.tool_constraints.rail([0, 0, 1], within=(0.05, 0.2), pose=pose),
        hf.tool_constraints.plane([0, 1, 0], within=(0.04, 0.2), pose=pose),
    ]
    manifold = ConstraintManifold(arm, keep, space.free, (arm.lower, arm.upper))
    d = rng.normal(0, 0.02, (200, 6))
    first = np.repeat(a[:1], 200, axis=0)
    away = rng.uniform(0, 0.01, d.shape)
    good = manifold.prove_edges(first, first + d, away)
    assert good.any()
    assert (good < manifold.prove_edges(first, first + d)).any()
    for x, step, most in zip(first[good], d[good], away[good], strict=True):
        assert manifold.is_satisfied(x + on * step + off * most).all()


def links_to(centres, q):
    """Least distance (N,) of three unit links in a plane from points (M, 2), by projection."""
    ends = np.concatenate([np.zeros((len(q), 1)), np.cumsum(np.exp(1j * np.cumsum(q, axis=1)), axis=1)], axis=1)
    least = np.full(len(q), np.inf)
    for c in centres @ [1, 1j]:
        for k in range(3):
            a, d = ends[:, k], ends[:, k + 1] - ends[:, k]
            s = np.clip(((c - a) * d.conj()).real, 0, 1)
            least = np.minimum(least, np.abs(a + s * d - c))
    return least


@pytest.fixture(scope="module")
def among_balls():
    """A recovery round a corner: the arm must be folded to get past a ball."""
    arm = hf.arms.load("planar-3r")
    arm = replace(arm, joints=tuple(replace(j, velocity=2.0) for j in arm.joints))
    centres = np.array([[2.6, 0.4], [1.0, -2.3]])
    balls = [hf.cell.Sphere(f"ball{k}", 0.2, pose=[*c, 0]) for k, c in enumerate(centres)]
    clearance = hf.Clearance(arm, Capsules.along_links(arm, 0.02), hf.Cell(balls), itself=False)
    start, goal = [-0.9, 0.4, 0.3], [0.5, 0.4, 0.3]
    return round_the_corner(arm, start, goal, clearance), centres


def round_the_corner(arm, start, goal, clearance):
    return hf.recover(arm, ["joint2"], start, goal=goal, clearance=clearance, samples=0, tries=1, accelerations=4.0)


def test_rounded_corners_keep_clear(among_balls):
    bent, centres = among_balls
    timed = bent.timed
    assert bent.verdict.is_solved
    dense = np.stack([np.interp(np.linspace(0, timed.time[-1], 20_000), timed.time, x) for x in timed.q.T], axis=1)
    assert links_to(centres, dense).min() >= 0.22 - 1e-6
    assert (timed.q[:, 1] == bent.q[0, 1]).all()
    assert not timed.stops
    np.testing.assert_array_equal(timed.q[[0, -1]], bent.q[[0, -1]])
    assert timed.without == pytest.approx((np.abs(np.diff(bent.q, axis=0)) / 2.0).max(axis=1).sum())
    stop = compute_fastest_profile(fine_way(bent.q, np.zeros(len(bent.q))), np.full(3, 2.0), np.full(3, 4.0)).time[-1]
    assert timed.without < timed.duration < stop


def test_two_close_waypoints_are_one_corner_where_that_is_free_and_faster():
    arm = hf.arms.load("planar-3r")
    arm = replace(arm, joints=tuple(replace(j, velocity=2.0) for j in arm.joints))
    bad = hf.Degraded(arm, speeds={"joint1": 1.0})
    near = np.array([[0, 0, 0], [1.0, 0, 0], [1.02, 0.02, 0], [1.0, 1.0, 0]])
    cell = hf.Cell([hf.cell.Sphere("far", 0.1, pose=[0, 0, 5.0])])

    def timed(way, space):
        return time_motion(space, bad, way, accelerations=np.full(3, 4.0), period=0.01, without=None)

    class Blocked(FreeSpace):
        """No line but those of the way."""

        def are_segments_valid(self, a, b, deviations=None):
            return super().are_segments_valid(a, b, deviations) & (np.abs(b - a).max(axis=1) < 0.2)

    free = np.ones(3, dtype=bool)
    clearance = hf.Clearance(arm, Capsules.along_links(arm, 0.02), cell, itself=False)
    one = timed(np.delete(near, 1, axis=0), FreeSpace(arm, free, clearance, 0.0, near[:1]))
    both = timed(near, FreeSpace(arm, free, clearance, 0.0, near[:1]))
    assert both.duration == pytest.approx(one.duration, rel=0.02)
    kept = timed(near, Blocked(arm, free, clearance, 0.0, near[:1]))
    assert kept.duration > 1.2 * both.duration
    np.testing.assert_array_equal(both.q[[0, -1]], near[[0, -1]])


def test_the_file_keeps_speeds_and_accelerations(among_balls, tmp_path):
    bent, _ = among_balls
    rows = list(csv.reader(bent.to_csv(tmp_path / "motion.csv").read_text().splitlines()))
    assert rows[0][:5] == ["time_s", "joint1_rad", "joint2_rad", "joint3_rad", "joint1_rate_rad_per_s"]
    table = np.array(rows[1:], dtype=np.float64)
    time, q, rate, second = table[:, 0], table[:, 1:4], table[:, 4:7], table[:, 7:]
    np.testing.assert_allclose(np.diff(time), 0.01, rtol=1e-9)
    assert bent.timed.duration <= time[-1] < bent.timed.duration + 0.01
    means = np.diff(q, axis=0) / 0.01
    assert np.abs(means).max() <= 2.0 * (1 + 1e-9)
    assert np.abs(np.diff(means, axis=0)).max() <= 4.0 * 0.01 * (1 + 1e-9)
    assert np.abs(np.diff(rate, axis=0)).max() <= 4.0 * 0.01 * (1 + 1e-9)
    assert (np.abs(rate).max(), np.abs(second).max()) <= (2.0 * (1 + 1e-9), 4.0 * (1 + 1e-9))
    assert np.abs(means - (rate[1:] + rate[:-1]) / 2).max() < 4.0 * 0.01 / 2
    assert not rate[[0, -1]].any()
    np.testing.assert_array_equal(read_waypoints(bent.arm, tmp_path / "motion.csv"), q)
    np.testing.assert_array_equal(read_times(bent.arm, tmp_path / "motion.csv"), time)
    check = check_waypoints(bent.arm, q, ["joint2"], clearance=bent.clearance, time=time, accelerations=4.0)
    assert check.ok
    assert bent.check().ok
    assert "Speeds and accelerations are respected." in check.describe()
    assert check_waypoints(bent.arm, q, ["joint2"], clearance=False, time=time, accelerations=3.9).too_hard
    hasty = check_waypoints(bent.arm, q, ["joint2"], clearance=False, time=0.9 * time)
    assert hasty.too_fast
    assert not hasty.ok
    assert "too fast" in " ".join(hasty.describe())


def test_a_corner_that_other_code_refuses_is_a_stop(among_balls, monkeypatch):
    bent, _ = among_balls
    real, made = completion.verify_waypoints, []

    def strict(*asked, **more):
        found = real(*asked, **more)
        made.append(more["timing_limits"])
        return replace(found, faults=("a corner is cut off",)) if len(made) == 2 else found

    monkeypatch.setattr(completion, "verify_waypoints", strict)
    again = round_the_corner(bent.arm, bent.at, bent.q[-1], bent.clearance)
    assert again.ok
    assert [timing_limits is not None for timing_limits in made] == [False, True, True]
    assert again.timed.stops == len(bent.q) - 2
    assert again.timed.duration > bent.timed.duration
    monkeypatch.setattr(
        completion,
        "verify_waypoints",
        lambda *_, timing_limits, **__: replace(bent.verified, faults=("no",) * (timing_limits is not None)),
    )
    never = round_the_corner(bent.arm, bent.at, bent.q[-1], bent.clearance)
    assert never.verdict.answer == "undecided"
    assert "in the timed motion, no" in never.verdict.why


# ---- tool paths and rows ---------------------------------------------------------------------------------------------


def test_a_tool_path_is_followed_without_a_stop():
    arm = hf.arms.load("panda")
    at = np.array([0, -0.5, 0, -2.2, 0, 1.8, 0.8])
    first = arm.forward_kinematics(at)
    last = first.copy()
    last[:3, 3] += [0.1, 0.3, 0.0]
    result = hf.recover(
        arm, ["panda_joint3"], at, goal="home", task="pose", path=hf.paths.line(first, last), samples=0, accelerations=10.0
    )
    assert result.ok
    timed = result.timed
    assert timed.stops == 1
    along = np.isfinite(timed.place)
    model, tool = oracles.to_pinocchio(arm)
    data = model.createData()
    for share, q in zip(timed.place[along][::5], timed.q[along][::5], strict=True):
        pin.framesForwardKinematics(model, data, q)
        pose = data.oMf[tool].homogeneous
        np.testing.assert_allclose(pose[:3, 3], first[:3, 3] + share * (last - first)[:3, 3], atol=1e-3)
        assert Rotation.from_matrix(pose[:3, :3].T @ first[:3, :3]).magnitude() < np.deg2rad(0.5)
    end = result.legs[0].last
    met = np.abs(timed.q - result.q[end]).max(axis=1)
    assert met.min() < 10 * 0.01**2 / 2 + 1e-6
    assert (np.diff(timed.place[along]) >= -1e-12).all()
    assert result.verified.path_miss < 1e-3


def test_rows_are_kept_where_corners_are_rounded():
    arm = hf.arms.load("panda")
    at = np.array([1.92, 1.35, 2.63, -1.39, -1.44, 0.5, 0.98])
    goal = arm.forward_kinematics(np.array([1.16, -0.04, 2.63, -3.07, 0.52, 3.1, 2.64]))
    upright = hf.tool_constraints.upright(np.deg2rad(5))
    result = hf.recover(
        arm,
        ["panda_joint3"],
        at,
        goal=goal,
        clearance=False,
        samples=0,
        keep=upright,
        accelerations=dict.fromkeys(range(7), 8.0),
    )
    assert result.ok
    tilt = np.arccos(-oracles.forward(arm, result.timed.q)[:, 2, 2])
    assert tilt.max() <= np.deg2rad(5) + 1e-9
    assert tilt.max() > np.deg2rad(2)
    assert result.timed.stops == 0


# ---- what cannot be ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        (0.0, "the acceleration of 'joint1' is 0"),
        ([1.0, np.nan, 1.0], "finite number above 0"),
        ([1.0, 1.0], r"shape \(2,\)"),
        ({"joint1": 1.0}, "no limit for 'joint3'"),
        ({"joint9": 1.0}, "no joint 'joint9'"),
        ({"joint1": [1.0, 2.0]}, "give a number"),
        ("fast", "accelerations"),
        (1e-15, "longer period"),
    ],
)
def test_wrong_accelerations_are_refused(given, sentence):
    arm = hf.arms.load("planar-3r")
    if isinstance(given, list) and len(given) == 3:
        locked: list[str] = ["joint3"]
    else:
        locked = ["joint2"]
    with pytest.raises(hf.InputError, match=sentence):
        hf.recover(arm, locked, [0.3, 0.6, 0.9], goal=[0.4, 0.6, 0.9], clearance=False, samples=0, accelerations=given)


def test_a_motion_of_no_length_takes_no_time():
    arm = hf.arms.load("planar-3r")
    here = [0.3, 0.6, 0.9]
    found = hf.recover(arm, ["joint2"], here, goal=here, samples=0, accelerations=1.0)
    assert found.ok
    assert (found.timed.duration, found.timed.period, len(found.timed.q)) == (0.0, 0.0, 1)
    with pytest.raises(hf.InputError, match="period is 0"):
        hf.recover(arm, ["joint2"], here, goal=here, samples=0, accelerations=1.0, period=0.0)
    with pytest.raises(hf.InputError, match="accelerations need times"):
        check_waypoints(arm, [here], accelerations=1.0)
    with pytest.raises(hf.InputError, match="never fall"):
        check_waypoints(arm, [here, here], time=[1.0, 0.0])
