"""Working ranges for a failure-tolerant box: against brute force for planar arms, and fresh samples for arms in space."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError, TaskError

FINE = np.radians(0.2)


def planar(lengths, low=-np.pi, high=np.pi):
    return hf.Arm.from_dh([hf.DH(a=x, alpha=0.0) for x in lengths], name="3R").with_limits([low] * 3, [high] * 3)


def in_annulus(distance, one, two):
    return (distance >= abs(one - two)) & (distance <= one + two)


def runs(good, values):
    """Ends of the runs of values that are good."""
    ends = np.flatnonzero(np.diff(np.concatenate([[0], good.astype(int), [0]]))).reshape(-1, 2) - [0, 1]
    return values[ends]


def lost_at_no_value(lengths, points):
    """For each joint the runs of values at which two links reach every point: the annulus about the foot or the elbow."""
    a, b, c = lengths
    values = np.arange(-np.pi, np.pi + FINE / 2, FINE)
    rest = np.linalg.norm(points[None] - a * np.stack([np.cos(values), np.sin(values)], -1)[:, None], axis=-1)
    radius = np.linalg.norm(points, axis=1)[None]
    first = np.abs(a + b * np.exp(1j * values))[:, None], np.abs(b + c * np.exp(1j * values))[:, None]
    tables = in_annulus(rest, b, c), in_annulus(radius, first[0], c), in_annulus(radius, a, first[1])
    return [runs(table.all(axis=1), values) for table in tables]


def healthy(lengths, ranges, points):
    """Whether some first angle of a grid in its range leaves the other two joints theirs, for every point."""
    a, b, c = lengths
    first = np.linspace(*ranges[0], 300)
    left = points @ np.array([1, 1j]) - a * np.exp(1j * first)[:, None]
    reached = np.zeros(left.shape, dtype=bool)
    with np.errstate(invalid="ignore"):
        bend = np.arccos((np.abs(left) ** 2 - b * b - c * c) / (2 * b * c))
    for third in (bend, -bend):
        with np.errstate(invalid="ignore"):
            second = np.angle(left / (b + c * np.exp(1j * third)) / np.exp(1j * first)[:, None])
        reached |= ((second >= ranges[1][0]) & (second <= ranges[1][1])) & ((third >= ranges[2][0]) & (third <= ranges[2][1]))
    return reached.any(axis=0).all()


@pytest.mark.parametrize(
    ("lengths", "centre", "size"),
    [
        ((1.0, 1.0, 1.0), (1.5, 0.5), 0.4),
        ((1.0, 1.0, 1.0), (2.2, 0.5), 0.3),
        ((1.2, 0.8, 0.5), (0.9, -0.6), 0.2),  # locks of joint 2 near 0 leave a hole around the foot: two intervals
        ((0.7, 1.1, 0.6), (0.3, 1.2), 0.25),
    ],
)
def test_the_ranges_are_the_widest_of_brute_force(lengths, centre, size):
    """Without a margin: each range is a whole interval, and no combination of intervals has a larger smallest width."""
    found = hf.find_working_ranges(planar(lengths), centre, size, margin=0.0)
    assert found.ok
    offsets = size * (np.linspace(0, 1, 15) - 0.5)
    points = np.array(list(product(centre[0] + offsets, centre[1] + offsets)))
    intervals = lost_at_no_value(lengths, points)
    for pair, choices in zip(found.ranges, intervals, strict=True):
        assert np.abs(choices - pair).max(axis=1).min() < 1.5 * FINE
    assert healthy(lengths, found.ranges, points)
    best = max(
        min(high - low for low, high in chosen) for chosen in product(*intervals) if healthy(lengths, np.array(chosen), points)
    )
    assert np.diff(found.ranges).min() == pytest.approx(best, abs=3 * FINE)
    least = int(np.argmin(np.diff(found.ranges)[:, 0]))
    assert found.limiting_joint == found.claim.arm.joint_names[least]


def test_a_margin_is_cut_off_only_where_targets_are_lost():
    arm = planar((1.0, 1.0, 1.0))
    whole, cut = (hf.find_working_ranges(arm, (1.5, 0.5), 0.2, margin=margin).ranges for margin in (0.0, 0.05))
    away = 0.05 * np.diff(whole) * [1, -1]
    np.testing.assert_allclose(cut, whole + away, atol=np.radians(0.02))
    inside = hf.find_working_ranges(arm, (1.5, 0.5), 0.1, working_ranges={0: (-1.0, 0.4), "joint3": (0.0, 1.4)})
    assert inside.ok
    np.testing.assert_allclose(inside.ranges[[0, 2]], [[-1.0, 0.4], [0.0, 1.4]], atol=np.radians(0.02))
    assert (inside.ranges[:, 0] >= [-1.0, -np.pi, 0.0]).all()
    assert (inside.ranges[:, 1] <= [0.4, np.pi, 1.4]).all()


def test_a_joint_that_is_held_keeps_its_value_and_others_that_do_not_lock_their_ranges():
    held = {"joint1": (-0.6, -0.6), "joint3": (0.3, 2.0)}
    found = hf.find_working_ranges(planar((1.0, 1.0, 1.0)), (1.5, 0.5), 0.05, working_ranges=held, failures=[0, 1])
    assert found.ok
    np.testing.assert_array_equal(found.ranges[0], [-0.6, -0.6])
    np.testing.assert_allclose(found.ranges[2], [0.3, 2.0], atol=np.radians(0.02))
    assert [len(text.split("..")) for text in found.options] == [2, 2, 2]


def test_a_joint_without_limits_may_have_a_range_across_half_a_turn():
    free = hf.find_working_ranges(planar((1.0, 1.0, 1.0), -np.inf, np.inf), (-1.5, -0.5), 0.2, margin=0.0)
    turned = hf.find_working_ranges(planar((1.0, 1.0, 1.0)), (1.5, 0.5), 0.2, margin=0.0)  # the same box, half a turn ahead
    assert free.ok
    shift = np.mod(free.ranges[0] - turned.ranges[0], 2 * np.pi)
    np.testing.assert_allclose(shift, np.pi, atol=np.radians(0.05))
    np.testing.assert_allclose(free.ranges[1:], turned.ranges[1:], atol=np.radians(0.05))


@pytest.mark.parametrize(("name", "centre"), [("iiwa14", (0.5, 0.1, 0.4)), ("panda", (0.5, 0.0, 0.5))])
def test_a_fresh_sample_passes_and_the_claim_is_proved(name, centre, rng):
    """Configurations of other targets and locked values are found, and forward kinematics confirms them."""
    arm, size = hf.arms.load(name), 0.03
    found = hf.find_working_ranges(arm, centre, size, values=24, seed=7)
    assert found.ok
    assert name == "panda" or hf.certify(found.claim).ok
    assert found.passed == found.targets
    low, high = found.ranges.T
    targets = np.array(centre) + size * (rng.random((150, 3)) - 0.5)
    for k in range(arm.n):
        reach = hf.reachable_when_locked(arm, targets, {k: rng.uniform(low[k], high[k], 150)}, task="position", seed=11)
        assert reach.success.all(), arm.joint_names[k]
        np.testing.assert_allclose(arm.forward_kinematics(reach.q)[:, :3, 3], targets, atol=1e-5)
    options = dict(text.rsplit("=", 1) for text in found.options)
    for joint, pair in zip(arm.joints, found.ranges, strict=True):
        if joint.name in options:
            np.testing.assert_array_equal(pair, [np.pi / 180 * float(x) for x in options[joint.name].split("..")])
        else:
            np.testing.assert_array_equal(pair, [joint.lower, joint.upper])


@pytest.mark.parametrize("task", ["pose", "slide"])
def test_turned_tools_and_slides(task):
    """An arm on a rail or with nine joints: more joints than a lock takes from the task."""
    if task == "slide":
        found = hf.find_working_ranges(hf.arms.load("ur5-rail"), (0.6, 0.0, 0.4), 0.1, targets=20, values=24)
        assert found.options[0].startswith("rail=")
    else:
        tool = hf.arms.load("pa10-9dof").forward_kinematics(np.radians([0, 40, 0, 80, 0, 40, 0, 30, 0]))
        kept = {"rotation": tool[:3, :3], "targets": 20, "values": 24}
        found = hf.find_working_ranges(hf.arms.load("pa10-9dof"), tool[:3, 3], 0.02, **kept)
    assert found.claim.task == (task if task != "slide" else "position")
    assert found.ok
    assert (found.ranges[:, 1] > found.ranges[:, 0]).all()


def test_what_cannot_be_found_is_said_with_the_best_ranges():
    """The arm is 3 m long: of this box at most the part nearer than that can pass."""
    found = hf.find_working_ranges(planar((1.0, 1.0, 1.0)), (2.9, 0.0), 0.3, targets=40, values=24)
    assert not found.ok
    grid = np.array(list(product(np.linspace(2.75, 3.05, 60), np.linspace(-0.15, 0.15, 60))))
    assert 0 < found.passed / found.targets <= (np.linalg.norm(grid, axis=1) <= 3).mean() + 0.08
    (sentence,) = found.describe()
    reached = f"the arm reaches {found.passed} of {found.targets} sampled targets"
    assert sentence.startswith(f"Not found: with the best working ranges, {reached}")
    assert hf.find_working_ranges(planar((1.0, 1.0, 1.0)), (5.0, 0.0), 0.1, targets=5, values=6).passed == 0


@pytest.mark.parametrize(
    ("change", "kind", "sentence"),
    [
        ({"targets": 0}, InputError, "targets must be 1 or more"),
        ({"values": 1}, InputError, "values 2 or more"),
        ({"margin": 0.5}, InputError, "margin from 0 to below 0.5"),
        ({"margin": float("nan")}, InputError, "margin from 0 to below 0.5"),
        ({"size": -1.0}, InputError, "size of the box"),
        ({"working_ranges": {"joint1": (-9.0, 0.5)}}, InputError, "outside of its limits"),
        ({"working_ranges": {"joint9": (0.0, 0.5)}}, InputError, "joint9"),
        ({"failures": "pairs"}, TaskError, "lock one at a time"),
        ({"centre": (1.5, 0.5, 0.0)}, InputError, "2 joints are free for 3 task rows"),
        ({"rotation": np.eye(3)}, InputError, "give the centre of the box with three numbers"),
    ],
)
def test_what_makes_no_search(change, kind, sentence):
    with pytest.raises(kind, match=sentence):
        hf.find_working_ranges(hf.arms.load("planar-3r"), **({"centre": (1.5, 0.5), "size": 0.1} | change))
