"""Timing against integrals and finite differences."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from scipy.integrate import quad

import oracles
from holdfast import InputError
from holdfast.kinematics.paths import Constant, Path, TimedPath, Trapezoid, arc, sequence

TIMINGS = [Trapezoid(10.0), Trapezoid(3.0, 0.1, 0.5), Trapezoid(2.0, 0.5, 0.5), Trapezoid(2.0, 0.0, 0.3), Constant(4.0)]


@pytest.mark.parametrize("timing", TIMINGS, ids=repr)
def test_s_is_the_integral_of_the_rate_and_the_rate_that_of_the_acceleration(timing, rng):
    knots = [0.0, timing.accelerate * timing.duration, (1 - timing.decelerate) * timing.duration, timing.duration]

    def integral(of, t):
        points = [0.0, *[k for k in knots if 0 < k < t], t]
        return sum(quad(lambda x: float(of(np.array([x]))[0]), a, b)[0] for a, b in itertools.pairwise(points))

    for t in rng.uniform(0, timing.duration, 6):
        at = np.array([t])
        assert timing.s(at)[0] == pytest.approx(integral(timing.rate, t), abs=1e-12)
        jump = 0.0 if timing.accelerate else timing.peak
        assert timing.rate(at)[0] == pytest.approx(jump + integral(timing.acceleration, t), abs=1e-12)
    np.testing.assert_array_equal(timing.s(np.array([-1.0, 0.0, timing.duration, 99.0])), [0, 0, 1, 1])
    np.testing.assert_array_equal(timing.rate(np.array([-1.0, timing.duration + 1])), 0)
    np.testing.assert_array_equal(timing.acceleration(np.array([-1.0, timing.duration + 1])), 0)
    nan = np.array([np.nan])
    assert np.isnan([timing.s(nan), timing.rate(nan), timing.acceleration(nan)]).all()


def test_the_trapezoid_of_the_paper():
    """20 % up, 60 % at speed, 20 % down: the speed is 1 / (0.8 T)."""
    timing = Trapezoid(10.0)
    assert timing.peak == pytest.approx(0.125)
    np.testing.assert_allclose(timing.rate(np.array([0, 1, 2, 5, 8, 9, 10.0])), 0.125 * np.array([0, 0.5, 1, 1, 1, 0.5, 0]))
    np.testing.assert_allclose(timing.s(np.array([2.0, 5.0, 8.0])), [0.125, 0.5, 0.875])
    assert Constant(4.0).rate(np.array([1.0]))[0] == 0.25


class Cosine:
    """A timing of one's own."""

    duration = 2.0

    def __repr__(self):
        return "Cosine()"  # names of tests must be the same in every process

    def s(self, t):
        return (1 - np.cos(np.pi * np.clip(t, 0, 2) / 2)) / 2

    def rate(self, t):
        return np.where((t >= 0) & (t <= 2), np.pi / 4 * np.sin(np.pi * t / 2), 0)

    def acceleration(self, t):
        return np.where((t >= 0) & (t <= 2), np.pi**2 / 8 * np.cos(np.pi * t / 2), 0)


@pytest.mark.parametrize("stop", [False, True])
@pytest.mark.parametrize("timing", [Trapezoid(3.0), Trapezoid(3.0, 0.3, 0.1), Constant(2.0), Cosine()], ids=repr)
@pytest.mark.parametrize("factor", [None, 2.5])
def test_twist_and_its_rate_are_derivatives_by_time(timing, stop, factor, rng):
    poses = [oracles.random_pose(rng) for _ in range(4)]
    for path in (sequence(poses), arc(*poses[:3])):
        timed = TimedPath(path, timing, stop)
        timed = timed if factor is None else timed.stretch(factor)
        h = 1e-6
        t = rng.uniform(0.01, 0.99, 200) * timed.duration
        twist = timed.twist(t)
        got = (timed.pose(t + h) - timed.pose(t - h)) / (2 * h)
        rate = (timed.twist(t + h) - timed.twist(t - h)) / (2 * h)
        spin = got[:, :3, :3] @ timed.pose(t)[:, :3, :3].transpose(0, 2, 1)
        got = np.concatenate([got[:, :3, 3], np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], 1)], axis=1)
        # Corners of path and timing are met by few of the 200 times.
        off = np.abs(got - twist).max(axis=1) > 1e-6 * np.abs(twist).max()
        off |= np.abs(rate - timed.twist_rate(t)).max(axis=1) > 1e-4 * np.abs(timed.twist_rate(t)).max() + 1e-6
        assert off.sum() <= 2
        np.testing.assert_allclose(timed.pose([0.0, timed.duration]), [poses[0], path.pose(1.0)], atol=1e-12)


def test_stopping_at_corners(rng):
    path = sequence(rng.normal(size=(4, 3)))
    timed = TimedPath(path, Trapezoid(6.0), stop=True)
    corners = path.corners * 6.0
    np.testing.assert_allclose(timed.twist(corners), 0, atol=1e-9)
    np.testing.assert_allclose(timed.pose(corners), path.pose(path.corners), atol=1e-12)
    assert timed.duration == 6.0
    assert np.abs(TimedPath(path, Trapezoid(6.0)).twist(corners)).max() > 0.1
    assert "with a stop at each corner" in timed.describe()


def test_slowed(rng):
    timed = TimedPath(sequence(rng.normal(size=(4, 3))), Trapezoid(6.0))
    slow = timed.stretch(3.0)
    t = rng.uniform(0, 6, 10)
    assert slow.duration == 18.0
    np.testing.assert_allclose(slow.pose(3 * t), timed.pose(t), atol=1e-12)
    np.testing.assert_allclose(slow.twist(3 * t), timed.twist(t) / 3, atol=1e-12)
    np.testing.assert_allclose(slow.twist_rate(3 * t), timed.twist_rate(t) / 9, atol=1e-12)


def test_one_time_and_times_outside(rng):
    timed = TimedPath(sequence(rng.normal(size=(3, 3))), Constant(2.0))
    assert timed.pose(1.0).shape == (4, 4)
    assert timed.twist(1.0).shape == timed.twist_rate(1.0).shape == (6,)
    np.testing.assert_array_equal(timed.pose(5.0), timed.path.pose(1.0))
    np.testing.assert_array_equal(timed.twist([-1.0, 5.0]), np.zeros((2, 6)))
    assert np.isnan(timed.twist([np.nan, 1.0])[0]).all()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: Trapezoid(0.0), "duration is 0 s; it must be above 0"),
        (lambda: Trapezoid(np.nan), "duration is nan s"),
        (lambda: Constant(-1.0), "duration is -1 s"),
        (lambda: Trapezoid(1.0, 0.7, 0.4), "accelerate is 0.7 and decelerate 0.4; they are fractions"),
        (lambda: Trapezoid(1.0, -0.1), "accelerate is -0.1"),
        (lambda: TimedPath(sequence(np.eye(3)), Constant(1.0)).stretch(0), "factor is 0; it must be above 0"),
        (lambda: TimedPath(sequence(np.eye(3)), Constant(1.0)).pose(np.zeros((2, 2))), r"t has shape \(2, 2\)"),
    ],
)
def test_bad_timing(call, message):
    with pytest.raises(InputError, match=message):
        call()


def test_a_path_is_not_read_from_a_file_whose_timing_is_none(tmp_path):
    """The path alone does not need it, and who reads it wants to hear of the mistake before the motion begins."""
    file = tmp_path / "p.yaml"
    file.write_text("line: {from: {xyz: [0, 0, 0]}, to: {xyz: [1, 0, 0]}}\ntiming: {duration: -1}\n")
    for load in (Path.load, TimedPath.load):
        with pytest.raises(InputError, match=r"path file '.*p\.yaml': timing: duration is -1 s; it must be above 0"):
            load(file)
