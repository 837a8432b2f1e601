"""Rest curves over the locked angle against closed forms, published ranges and the search at fixed angles."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.control import Damped, Weighted
from holdfast.control.equilibria import Kind
from holdfast.control.equilibria.curves import merge_arcs

RAD = np.deg2rad
R = np.hypot(1.5, 1.5)


@pytest.fixture(scope="module")
def curves(three):
    return [hf.stationary_points(three, [1.5, 1.5], {k: None}) for k in range(3)]


def arcs(found):
    return np.rad2deg(np.array(found).reshape(-1, 2))


def test_sinks_are_the_complement_of_the_reachable_range(curves):
    bound = np.rad2deg(2 * np.arccos((R - 1) / 2))  # joints 2 and 3
    turn = np.rad2deg(np.arccos((R * R - 3) / (2 * R)))  # joint 1, about 45 deg
    np.testing.assert_allclose(arcs(curves[0].sink_arcs), [[45 + turn, 405 - turn]], atol=1e-3)
    for k in (1, 2):
        np.testing.assert_allclose(arcs(curves[k].sink_arcs), [[bound, 360 - bound]], atol=1e-3)


def test_joint_1_stretched_and_folded(curves):
    folded = np.rad2deg(np.arccos(1 / R))
    np.testing.assert_allclose(np.rad2deg(curves[0].degenerate_angles), [45 - folded, 45 + folded], atol=1e-6)
    lines = [c for c in curves[0].curves if c.degenerate]
    assert len(lines) == 2
    for line in lines:
        np.testing.assert_allclose(np.cos(line.q[:, 2]), -1, atol=1e-9)
        assert np.ptp(line.q[:, 1]) > 2 * np.pi - 1e-6
    (loop,) = (c for c in curves[0].curves if not c.degenerate)
    assert loop.closed
    np.testing.assert_allclose(np.sin(loop.q[:, 2]), 0, atol=1e-9)
    # From the source's side of the fold: -9.1414 deg and its mirror image.
    fold_angles = (np.rad2deg(loop.locked_values[loop.folds]) + 180) % 360 - 180
    np.testing.assert_allclose(sorted(fold_angles), [-9.1414, 99.1414], atol=1e-3)
    np.testing.assert_allclose(np.abs(np.cos(loop.q[loop.rank_losses, 1])), 1, atol=1e-6)
    assert len(loop.rank_losses) == 2
    # Thales: the hand is at a right angle between the base and the target.
    x = curves[0].law.arm.forward_kinematics(loop.q)[:, :2, 3]
    np.testing.assert_allclose(np.einsum("ij,ij->i", x, [1.5, 1.5] - x), 0, atol=1e-9)


@pytest.mark.parametrize("k", [1, 2])
def test_joints_2_and_3_families(curves, k):
    """theta3 = -theta2/2 (and the other way round), that plus half a turn, and the line at 180 deg."""
    np.testing.assert_allclose(curves[k].degenerate_angles, [np.pi], atol=1e-9)  # one angle, also if curves wrap to -pi
    other = 3 - k
    for c in curves[k].curves:
        if not c.degenerate:
            np.testing.assert_allclose(np.sin(c.q[:, other] + c.q[:, k] / 2), 0, atol=1e-6)
    fold = {1: 96.922, 2: 71.8487}[k]
    folds = np.concatenate([c.locked_values[c.folds] for c in curves[k].curves])
    np.testing.assert_allclose(np.unique(np.abs((np.rad2deg(folds) + 180) % 360 - 180).round(3)), [fold], atol=2e-3)
    met = np.concatenate([c.locked_values[c.solutions] for c in curves[k].curves])
    np.testing.assert_allclose(np.abs(np.cos(met)), np.abs(np.cos(2 * np.arccos((R - 1) / 2))), atol=1e-6)


@pytest.mark.parametrize(
    ("radius", "window"),
    [(0.9, (167.909, 168.226)), (1.03, (160.124, 160.133))],
)
def test_window_of_sinks_between_a_fold_and_a_hopf_point(three, radius, window):
    found = hf.stationary_points(three, [radius, 0.0], {1: None})
    ends = arcs(found.sink_arcs)
    k = int(np.argmin(np.abs(ends[:, 0] - window[0])))
    np.testing.assert_allclose(ends[k], window, atol=1.1e-3)
    hopf = np.concatenate([c.locked_values[c.hopf_points] for c in found.curves])
    assert np.abs(np.cos(hopf) - np.cos(RAD(window[1]))).min() < 1e-4


def test_points_are_at_rest_and_kinds_are_those_of_the_eigenvalues(curves):
    for found in curves:
        assert found.describe()
        for c in found.curves:
            sink = [s for s in c.segments if s.kind == Kind.SINK]
            for s in sink:
                inside = c.eigenvalues[s.first + 1 : s.last]
                assert (inside.real < 1e-6 * np.abs(inside).max(axis=1, keepdims=True)).all()
            assert c.segments[0].first == 0
            assert c.segments[-1].last >= len(c.q) - 2


def test_every_point_of_the_search_is_on_a_curve_and_the_other_way_round(three, rng):
    arm = three.arm
    laws = [three, Weighted(arm, rng.uniform(0.3, 3, 3), "planar"), Damped(arm, 0.2, "planar")]
    for law in laws:
        angle = rng.uniform(-np.pi, np.pi)
        x = rng.uniform(0.3, 3.5) * np.array([np.cos(angle), np.sin(angle)])
        joint, at = int(rng.integers(3)), rng.uniform(-np.pi, np.pi)
        points = hf.stationary_points(law, x, {joint: at})
        found = hf.stationary_points(law, x, {joint: None})
        searched, traced = points.q[points.kind != Kind.SOLUTION], found.points_at(at)
        assert len(searched) == len(traced)
        for q in searched:
            assert np.abs(np.exp(1j * traced) - np.exp(1j * q)).max(axis=1).min() < 1e-5
        inside = any(low <= at <= high or low <= at + 2 * np.pi <= high for low, high in found.sink_arcs)
        assert inside == (points.kind == Kind.SINK).any()


def test_arcs_are_united_modulo_turns():
    pi = np.pi
    assert merge_arcs([], True) == []
    np.testing.assert_allclose(merge_arcs([(3, 3.5), (-3, -2)], True), [(3, 2 * pi - 2)])
    np.testing.assert_allclose(
        merge_arcs([(1, 2), (1 + 2 * pi, 2.5 + 2 * pi), (4 - 2 * pi, 4.5 - 2 * pi)], True),
        [(4 - 2 * pi, 4.5 - 2 * pi), (1, 2.5)],
    )
    assert merge_arcs([(0, 4), (3, 7)], True) == [(-pi, pi)]
    assert merge_arcs([(0, 1), (5, 6), (0.5, 2)], False) == [(0, 2), (5, 6)]
