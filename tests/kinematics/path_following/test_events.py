"""Events: found where they are known to be, one for each thing that happened, and none where nothing did."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.kinematics.indices import NegatedObjective, susceptibility
from holdfast.kinematics.path_following.events import Curvature, MotionHistory, find_events


@pytest.fixture(scope="module")
def torque(planar):
    return susceptibility.torque(planar, "worst-case")


@pytest.fixture(scope="module")
def swing(planar, across):
    measure = susceptibility.swing_angle(planar, [0, 1, 0])
    return hf.follow(planar, across(1.9, -0.1), minimise=measure, task="planar")


def of_kind(trajectory, kind):
    return [e for e in trajectory.events if e.kind == kind]


def borders_of_zero(planar, y, xs):
    """Where along the line the swing of joint 2 can be 0: some q1 puts the mass of links 2 and 3 below their joint."""
    measure = susceptibility.swing_angle(planar, [0, 1, 0])
    q1 = np.linspace(-np.pi, np.pi, 4001)
    able = []
    for x in xs:
        rest = np.array([x, y]) - np.stack([np.cos(q1), np.sin(q1)], axis=1)
        far = np.linalg.norm(rest, axis=1)
        ok = far <= 2
        bend = 2 * np.arccos(far[ok] / 2)
        least = np.inf
        for sign in (1, -1):
            q2 = np.arctan2(rest[ok, 1], rest[ok, 0]) - sign * bend / 2 - q1[ok]
            least = min(least, measure(np.stack([q1[ok], q2, sign * bend], axis=1)).min())
        able.append(least < 1e-4)
    return np.array(able)


def test_the_border_of_the_zero_region_is_an_algorithmic_singularity(planar, swing):
    """Section VI-B: with as many weights as degrees of redundancy, zero is entered and left only there (Figs. 6, 7)."""
    found = of_kind(swing, "algorithmic singularity")
    assert 1 <= len(found) <= 2
    xs = np.linspace(1.9, -1.9, 191)
    able = borders_of_zero(planar, -0.1, xs)
    first = xs[able.argmax()]
    assert first == pytest.approx(1.51, abs=0.03)  # known from an independent calculation
    x = np.interp(found[0].start, swing.time, swing.poses[:, 0, 3])
    assert x == pytest.approx(first, abs=0.05)
    assert "border of the region in which it can be zero" in found[0].text
    zero = max(of_kind(swing, "zero cost"), key=lambda e: e.end - e.start)
    assert zero.end > 8  # until about the other border
    last = xs[len(xs) - 1 - able[::-1].argmax()]
    assert np.interp(zero.end, swing.time, swing.poses[:, 0, 3]) == pytest.approx(last, abs=0.15)
    assert swing.on_path
    assert swing.value.max() == pytest.approx(swing.value[0], rel=1e-3)  # worst at the ends, as in Fig. 6


def test_the_rates_peak_where_the_event_says(swing):
    event = of_kind(swing, "algorithmic singularity")[0]
    assert event.start <= swing.peak_time <= event.end
    assert swing.peak_rate >= swing.rate_norm.max() - 1e-9
    assert f"{swing.peak_rate:.4g} rad/s" in event.text


def test_each_thing_is_told_once(swing):
    assert len(of_kind(swing, "not at an extremum")) == 0  # told with the singularity
    assert not of_kind(swing, "fast motion")
    starts = [e.start for e in swing.events]
    assert starts == sorted(starts)


def test_an_extremum_that_nearly_ends_is_told(planar, torque, across):
    """The line of Fig. 5 has no jump, but in its middle the minimum that is followed becomes shallow."""
    t = hf.follow(planar, across(1.8, -1.8), minimise=torque, task="planar")
    assert [e.kind for e in t.events] == ["algorithmic singularity"]
    assert "close to an algorithmic singularity" in t.events[0].text
    assert t.curvature.min() > 0


def test_nothing_happens_on_a_quiet_stretch(planar, torque):
    from holdfast.kinematics.paths import TimedPath, Trapezoid, line

    t = hf.follow(planar, TimedPath(line([1.8, -1.8, 0], [0.4, -1.8, 0]), Trapezoid(5.0)), minimise=torque, task="planar")
    assert t.events == ()


def test_a_start_that_is_not_the_best_is_told(planar, torque, across):
    best = hf.follow(planar, across(1.8, -1.8), minimise=torque, task="planar", samples=51).q[0]
    poses = planar.forward_kinematics(best)
    other = hf.solve_ik(planar, poses[None].repeat(20, 0), 3, task="planar").q
    away = other[np.abs(other - best).max(axis=1).argmax()]
    t = hf.follow(planar, across(1.8, -1.8), minimise=torque, task="planar", q=away, rate_cap=3.0)
    first = [e for e in t.events if e.start < 0.1]
    assert "not at an extremum" in {e.kind for e in first}
    assert "rate cap" in {e.kind for e in t.events}
    assert "does not start at a local best" in next(e.text for e in first if e.kind == "not at an extremum")


def test_curvature_is_the_second_derivative_along_the_self_motion(planar, torque, rng):
    q = rng.uniform(-2, 2, (40, 3))
    task = hf.path_following.GradientProjection(planar, torque, task="planar").task
    curvature = Curvature(torque, task)
    slope, matrices = curvature(q)

    def along(x):
        null = np.cross(*(task.rows @ oracles.jacobian(planar, x[None])[0]))
        return null / np.linalg.norm(null)

    h = 1e-3
    for k, x in enumerate(q):
        null = along(x)
        values = []
        for sign in (1, -1):  # a Runge-Kutta step along the curve of self-motion
            y = x + sign * h / 2 * null
            middle = along(y) * np.sign(along(y) @ null)
            end = x + sign * h * middle
            values.append(float(torque(end)))
        second = (values[0] - 2 * float(torque(x)) + values[1]) / h**2
        assert matrices[k, 0, 0] == pytest.approx(second, rel=1e-2, abs=1e-2 * np.abs(matrices).max())
    expected = [abs(along(x) @ oracles.slope(torque, x)) for x in q]
    np.testing.assert_allclose(slope, expected, rtol=1e-5, atol=1e-8)
    upside = Curvature(NegatedObjective(torque), task)
    np.testing.assert_allclose(upside.smallest(q), -matrices[:, 0, 0], rtol=1e-6)


@pytest.fixture
def calm(torque):
    """A motion on which nothing happens."""
    time = np.linspace(0, 10, 2001)
    one = np.ones_like(time)
    return MotionHistory(time, 2 + np.sin(time), one, one, one, one, 0 * one, {"joint1": 0 * one > 1})


def told(torque, course, **options):
    settings = {"follows_extremum": True, "requested_value": None, "cap_phrase": "the cap"} | options
    return {e.kind: e for e in find_events(torque, course, **settings)}


def test_events_of_made_up_motions(torque, calm):
    assert told(torque, calm) == {}
    middle = (calm.time > 4) & (calm.time < 5)
    found = told(
        torque,
        replace(
            calm,
            self_motion=np.where(middle, 0.5, 1.0),
            task_share=np.where(middle, 0.9, 1.0),
            damping=np.where(middle, 0.1, 0.0),
            at_limit={"joint1": middle},
        ),
    )
    assert set(found) == {"rate cap", "end effector slowed", "near a singularity", "joint limit"}
    for event in found.values():
        assert (event.start, event.end) == pytest.approx((4, 5), abs=0.01)
        assert event.text.startswith("from 4.005 s to 4.995 s: ")
    lost = told(torque, replace(calm, curvature=np.where(middle, -1.0, 1.0)))
    assert list(lost) == ["algorithmic singularity"]
    assert "on its way to another local best" in lost["algorithmic singularity"].text
    assert told(torque, replace(calm, curvature=np.where(middle, -1.0, 1.0)), follows_extremum=False) == {}
    never = told(torque, replace(calm, curvature=np.where(calm.time > 4, -1.0, 1.0)))
    assert "has not reached one by the end" in never["algorithmic singularity"].text
    fast = told(torque, replace(calm, rate_norm=np.where(middle, 30.0, 1.0)))
    assert list(fast) == ["fast motion"]
    assert "30 rad/s (30 times" in fast["fast motion"].text
    jump = told(torque, replace(calm, value=np.where(calm.time > 4, 5.0, 1.0)))
    assert jump["value jump"].start == pytest.approx(4, abs=0.01)
    kept = told(torque, replace(calm, value=np.where(middle, 2.0, 1.0)), requested_value=1.0)
    assert kept["value not kept"].start == pytest.approx(4, abs=0.01)
    empty = told(torque, replace(calm, value=0 * calm.time))
    assert empty == {}
    blind = told(torque, replace(calm, curvature=np.full_like(calm.time, np.nan)))
    assert blind == {}
