"""Basins and orbits against the published shares, the limit cycle and the arm that turns forever."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from cards import check_card
from holdfast.control.equilibria import Kind, orbit
from holdfast.core.errors import InputError

RAD = np.deg2rad


def test_figure_8(three):
    found = hf.basins(three, [1.5, 1.5], {1: RAD(45)}, starts=200)
    assert found.convergence.value == 1
    shares = dict(found.shares)
    assert sorted(shares) == ["solution 1", "solution 2"]
    assert all(s.low < 0.51 and s.high > 0.49 for s in shares.values())
    saddles = found.points.q[found.points.kind == Kind.SADDLE]
    assert len(saddles) == 2
    assert len(found.boundaries) == 4
    # Starts a little to either side of a boundary end at different solutions.
    line = found.boundaries[0][60:200:20]
    across = np.gradient(found.boundaries[0], axis=0)[60:200:20][:, [2, 1, 0]] * [1, 0, -1]
    beside = np.concatenate([line + 0.5 * across, line - 0.5 * across])
    one, other = np.split(hf.basins(three, [1.5, 1.5], {1: RAD(45)}, starts=beside).end, 2)
    assert (one != other).all()


def test_a_boundary_ends_where_the_arm_is_singular(three):
    """With joints 2 and 3 in line the direction of the motion jumps, and no step is small enough to follow it."""
    found = hf.basins(three, [1.5, 1.0], {0: 2.0}, starts=10)
    ends = [line[-1] for line in found.boundaries]
    assert ends
    reach = np.array([np.linalg.det(three.arm.jacobian(q)[:2, 1:]) for q in ends])  # 0 where joints 2 and 3 are in line
    speeds = np.array([np.linalg.norm(np.diff(line, axis=0), axis=1).max() for line in found.boundaries])
    short = np.array([len(line) for line in found.boundaries]) < 1500
    assert short.any()
    np.testing.assert_allclose(reach[short], 0, atol=0.03)
    assert (speeds < 0.0201).all()


def test_a_joint_that_the_task_does_not_notice():
    """Three links and a wrist at the tool point: wherever the wrist stands, the stuck runs are at the one sink."""
    arm = hf.Arm.from_dh([hf.DH(a=a, alpha=0.0) for a in (1.0, 1.0, 1.0, 0.0)])
    law = hf.control.pseudoinverse(arm, task="planar")
    found = hf.basins(law, [1.5, 1.5], {1: RAD(140)}, starts=40)
    assert dict(found.shares)["sink 1"].value == 1.0


def test_a_grid_where_no_start_arrives(three):
    found = hf.basins(three, [1.5, 1.5], {1: RAD(140)}, grid=8)
    assert found.shape == (8, 8)
    assert found.healthy == (0, 2)
    assert found.convergence.value == 0
    (name, share), *_ = found.shares
    assert (name, share.value) == ("sink 1", 1.0)
    assert len(found.describe()) == 1


@pytest.mark.parametrize(
    ("angle", "width", "period"), [(168.26, 6.018, 75.76), (168.30, 9.2372, 79.76), (168.36, 13.380, 88.84)]
)
def test_limit_cycle(three, angle, width, period):
    runs = hf.simulate(three, RAD([-130.0, angle, -84.0]), [0.9, 0.0], locked=[1], time_limit=4000 if angle > 168.3 else None)
    found = orbit(runs)
    assert found.label == "limit cycle"
    assert found.stable
    assert found.period == pytest.approx(period, abs=0.011)
    assert np.rad2deg(found.amplitude[0]) == pytest.approx(width, abs=2e-3)
    assert found.amplitude[1] == 0
    assert not found.windings.any()
    if angle == 168.30:
        assert found.position_error == pytest.approx((0.809, 0.997), abs=1e-3)
        assert found.angle_error == (0.0, 0.0)
        path = runs.path(samples=20_000)
        distance = np.linalg.norm(path.x[:, :2] - [0.9, 0.0], axis=1)
        first = np.abs(path.q[:, 0] - found.q[0]).argmin()  # the orbit passes here, then its farthest point within a period
        once = (path.time >= path.time[first]) & (path.time <= path.time[first] + found.period)
        if path.time[-1] >= path.time[first] + found.period:
            later = path.time[once][distance[once].argmax()] - path.time[first]
            assert found.largest_times[0] == pytest.approx(later, abs=0.5)
        assert found.describe() == [f"Limit cycle (period {found.period:.4g} s)."]


@pytest.mark.parametrize(("angle", "rate"), [(10, -3.31), (30, -0.816)])
def test_an_arm_that_turns_for_ever(three, angle, rate):
    """Fig. 7: no rest point at all, joint 1 turns."""
    assert len(hf.stationary_points(three, [-0.8, 0.0], {2: RAD(angle)})) == 0
    runs = hf.simulate(three, RAD([10.8852, 72.5087, angle]), [-0.8, 0.0], locked=[2], time_limit=500)
    found = orbit(runs)
    assert found.label == "turning"
    assert found.windings.tolist() == [-1, 0, 0]
    assert found.rates[0] == pytest.approx(rate, rel=0.02)
    check_card(found, False)
    assert found.rates[0] == pytest.approx(-2 * np.pi / found.period, rel=1e-6)


def test_wrong_input_is_one_sentence(three):
    with pytest.raises(InputError, match="it takes two healthy joints"):
        hf.basins(three, [1.5, 1.5], {0: 0, 1: 1}, grid=5)
    with pytest.raises(InputError, match="starts is 0"):
        hf.basins(three, [1.5, 1.5], {0: 0.0}, starts=0)
    with pytest.raises(InputError, match="locked gives no value for 'joint2'"):
        hf.basins(three, [1.5, 1.5], {1: None})
    for locked in (1, "joint2"):
        with pytest.raises(InputError, match="it must be a mapping or a Degraded"):
            hf.basins(three, [1.5, 1.5], locked)
    runs = hf.simulate(three, [0.1, 0.2, 0.3], [1.5, 1.5])
    with pytest.raises(InputError, match="did not end moving"):
        orbit(runs)
    with pytest.raises(InputError, match="there is no run 1"):
        orbit(runs, 1)


def test_starts_and_ends_as_a_data_set(three):
    found = hf.basins(three, [1.5, 1.5], {1: RAD(140)}, starts=5)
    data = found.to_xarray()
    assert data.start.sel(joint="joint2").values == pytest.approx(RAD(140))
    assert np.array_equal(data.end, found.end)
