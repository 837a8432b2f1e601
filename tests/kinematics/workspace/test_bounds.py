"""Where a joint may lock: closed forms and triangles for 3R arms, traced manifolds and locked inverse kinematics for others."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import InputError, TaskError, arms, joint_bounds
from holdfast.kinematics.solvers import self_motion

DEG = 180 / np.pi


def three_links(a, b, c) -> hf.Arm:
    return hf.Arm.from_dh([hf.DH(a=x, alpha=0.0) for x in (a, b, c)], name="3R")


@pytest.fixture(scope="module")
def unit3() -> hf.Arm:
    return three_links(1, 1, 1)


def holds(arcs, values, circle=True):
    """Whether values lie in arcs, on a circle or not."""
    values = np.asarray(values)
    turns = (-2 * np.pi, 0.0, 2 * np.pi) if circle else (0.0,)
    return np.any([(values + t >= a) & (values + t <= b) for a, b in arcs for t in turns], axis=0)


def close(found, wanted, within=1e-8):
    """Arcs agree, ends modulo whole turns."""
    assert len(found) == len(wanted), (found, wanted)
    for arc in wanted:
        off = [np.abs(np.exp(1j * np.array(arc)) - np.exp(1j * np.array(f))).max() for f in found]
        assert min(off) <= within, (found, arc)


def triangle(lengths, joint, angle, r):
    """Whether the point (r, 0) is reached with the joint at these angles: the triangle of what is left."""
    a, b, c = lengths
    if joint == 0:
        away = np.hypot(r - a * np.cos(angle), a * np.sin(angle))
        return (away >= abs(b - c)) & (away <= b + c)
    one, two, other = (a, b, c) if joint == 1 else (b, c, a)
    joined = np.abs(one + two * np.exp(1j * angle))
    return (r >= np.abs(joined - other)) & (r <= joined + other)


def test_the_published_bounds(unit3):
    found = joint_bounds(unit3, [1.5, 1.5], task="planar")
    degrees = np.round(np.degrees(np.array(found)[:, 0]), 2)
    np.testing.assert_array_equal(degrees, [[-24.30, 114.30], [-111.80, 111.80], [-111.80, 111.80]])


@pytest.mark.parametrize("r", [1.05, 1.5, 2.5, 2.99])
def test_one_manifold_in_closed_form(unit3, rng, r):
    direction = rng.uniform(-np.pi, np.pi)
    first = np.arccos((r * r - 3) / (2 * r))
    other = 2 * np.arccos((r - 1) / 2)
    found = joint_bounds(unit3, r * np.array([np.cos(direction), np.sin(direction)]), task="planar")
    close(found[0], [(direction - first, direction + first)])
    for arcs in found[1:]:
        close(arcs, [(-other, other)])


@pytest.mark.parametrize("r", [0.2, 0.5, 0.9])
def test_two_manifolds_in_closed_form(unit3, r):
    low, high = 2 * np.arccos((1 + r) / 2), 2 * np.arccos((1 - r) / 2)
    found = joint_bounds(unit3, [0, r], task="planar")
    assert found[0] == [(-np.pi, np.pi)]
    for arcs in found[1:]:
        close(arcs, [(-high, -low), (low, high)])


def test_the_middle_the_edge_and_beyond(unit3):
    found = joint_bounds(unit3, [0.0, 0.0], task="planar")
    assert found[0] == [(-np.pi, np.pi)]
    for arcs in found[1:]:
        close(arcs, [(-2 * np.pi / 3,) * 2, (2 * np.pi / 3,) * 2])
    for arcs, value in zip(joint_bounds(unit3, [0.0, 3.0], task="planar"), (np.pi / 2, 0, 0), strict=True):
        close(arcs, [(value, value)], within=1e-4)
    assert joint_bounds(unit3, [0.0, 3.001], task="planar") == [[], [], []]


def test_arcs_of_turning_joints_begin_within_half_a_turn(unit3):
    ((low, high),) = joint_bounds(unit3, [-1.5, -1.5], task="planar")[0]
    assert -np.pi <= low < np.pi < high


def test_any_lengths_against_triangles(rng):
    for _ in range(3):
        lengths = rng.uniform(0.3, 1.2, 3)
        r = rng.uniform(0.05, 0.98) * lengths.sum()
        found = joint_bounds(three_links(*lengths), [r, 0], task="planar")
        for joint in range(3):
            angle = rng.uniform(-np.pi, np.pi, 2000)
            np.testing.assert_array_equal(holds(found[joint], angle), triangle(lengths, joint, angle, r))
            # The ends themselves, from both sides.
            for end in np.array([a for a in found[joint] if a != (-np.pi, np.pi)]).ravel():
                two = triangle(lengths, joint, end + np.array([-1e-6, 1e-6]), r)
                assert two[0] != two[1]


def test_joint_limits_cut_arcs(rng):
    limits = [(-0.5, 1.0), (-2.0, 1.2), (-0.8, 2.5)]
    rows = [hf.DH(a=1.0, alpha=0.0, lower=a, upper=b) for a, b in limits]
    arm = hf.Arm.from_dh(rows, name="limited")
    target = arm.forward_kinematics(oracles.inside(arm, rng, 1)[0])[:2, 3]
    found = joint_bounds(arm, target, task="planar")
    curves = self_motion(arm, target, task="planar", spacing=0.006)
    for joint, (low, high) in enumerate(limits):
        assert all(low <= a <= b <= high for a, b in found[joint])
        check_against_curves(curves, found[joint], joint)


def check_against_curves(motion, arcs, joint, within=1e-5):
    """Arcs are the union of the ranges over the traced curves, whose extremes lie at most a step's bend inside."""
    ranges = sorted((c.q[:, joint].min(), c.q[:, joint].max()) for c in motion.components)
    merged: list[list[float]] = []
    for low, high in ranges:
        if merged and low <= merged[-1][1] + within:
            merged[-1][1] = max(merged[-1][1], high)
        else:
            merged.append([low, high])
    assert len(merged) == len(arcs)
    np.testing.assert_allclose(merged, arcs, atol=within)


def test_a_planar_arm_against_its_traced_curves(rng):
    arm = three_links(1.0, 0.8, 0.5)
    for r in (0.4, 1.4):
        motion = self_motion(arm, [0.0, r], task="planar", spacing=0.012)
        found = joint_bounds(arm, [0.0, r], task="planar")
        for joint in range(3):
            values = np.concatenate([c.q[:, joint] for c in motion.components])
            assert holds([(a - 1e-9, b + 1e-9) for a, b in found[joint]], values).all()
            for end in np.array([a for a in found[joint] if a != (-np.pi, np.pi)]).ravel():
                assert np.abs(np.angle(np.exp(1j * (values - end)))).min() < 1e-4


@pytest.mark.parametrize("name", ["panda", "iiwa14"])
def test_a_real_arm_against_its_traced_curves(name):
    arm = arms.load(name)
    pose = arm.forward_kinematics(np.array(arms.about(name).home))
    motion = self_motion(arm, pose, spacing=0.02, starts=400)
    found = joint_bounds(arm, pose)
    for joint in range(arm.n):
        check_against_curves(motion, found[joint], joint, within=2e-4)


@pytest.mark.parametrize(("fixture", "task", "target"), [("flat4", "planar", [1.9, 0.3]), ("mixed5", "position", None)])
def test_more_redundancy_against_locked_inverse_kinematics(request, rng, fixture, task, target):
    arm = request.getfixturevalue(fixture)
    if target is None:
        target = arm.forward_kinematics(oracles.inside(arm, rng, 1)[0])[:3, 3]
    found = joint_bounds(arm, target, task=task)
    low = np.where(np.isfinite(arm.lower), arm.lower, -np.pi)
    high = np.where(np.isfinite(arm.upper), arm.upper, np.pi)
    for joint in range(arm.n):
        values = rng.uniform(low[joint], high[joint], 80)
        ends = np.array(found[joint]).ravel()
        if ends.size:
            values = values[np.abs(values[:, None] - ends).min(axis=1) > 1e-3]
        reached = hf.reachable_when_locked(arm, target, {joint: values}, task=task, restarts=200).success
        np.testing.assert_array_equal(holds(found[joint], values, circle=np.isinf(arm.upper[joint])), reached)


def test_the_same_seed_gives_the_same(unit3):
    once, again = (joint_bounds(unit3, [1.2, 0.3], task="planar", seed=5) for _ in range(2))
    assert once == again


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"task": "planar-pose"}, TaskError, "without redundancy every lock"),
        ({"target": [1.0, np.nan]}, InputError, "holds NaN"),
        ({"target": [[1.0, 0.0]]}, InputError, "give one target"),
        ({"starts": 0}, InputError, "starts is 0"),
    ],
)
def test_errors(unit3, options, error, message):
    with pytest.raises(error, match=message):
        joint_bounds(unit3, **{"target": [1.5, 1.5], "task": "planar", **options})
