"""Rest points at a locked value against the published table, closed forms and Poincare-Hopf."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast import arms
from holdfast.control import Damped, FailureTolerant, Pseudoinverse, Weighted
from holdfast.control.equilibria import Kind
from holdfast.control.equilibria.stability import linearisation
from holdfast.core.errors import InputError

RAD = np.deg2rad
TARGET = [1.5, 1.5]

# Goel et al. 2005, the corrected tables: locked joint, angle, and per point q (deg), kind, eigenvalues.
TABLE = {
    (0, 0): [
        ((0, 33.8038, 75.5225), "solution", (-1, -0.1370)),
        ((0, 109.3263, -75.5225), "solution", (-1, -0.27925)),
    ],
    (0, 125): [
        ((125, -157.1061, 0), "source", (3.31541, 1.60012)),
        ((125, -98.8754, 0), "sink", (-1.30541, -0.06619)),
    ],
    (1, 45): [
        ((-173.2216, 45, 157.5), "saddle", (2.22085, -20.59738)),
        ((15.7216, 45, 157.5), "saddle", (-2.25746, 8.82651)),
        ((-5.6173, 45, 66.1698), "solution", (-1, -0.49187)),
        ((50.6173, 45, -111.1698), "solution", (-1, -0.78898)),
    ],
    (1, 100): [
        ((-42.4502, 100, -50), "source", (0.36716, 0.62402)),
        ((-17.5498, 100, -50), "saddle", (-0.46467, 0.17619)),
        ((-26.7385, 100, 130), "saddle", (-2.63981, 3.02110)),
        ((146.7385, 100, 130), "saddle", (2.09675, -4.86264)),
        ((-24.1407, 100, -5.9284), "solution", (-1, -0.16870)),
        ((14.1407, 100, -94.0716), "solution", (-1, -0.26845)),
    ],
    (1, 140): [
        ((-10.5639, 140, -70), "sink", (-1.63856, -0.12823)),
        ((-109.4361, 140, -70), "source", (1.50326, 0.55799)),
        ((124.9008, 140, 110), "saddle", (0.86188, -3.20359)),
        ((-64.9008, 140, 110), "saddle", (2.27117, -1.55501)),
    ],
    (2, 30): [
        ((-85.1071, 165, 30), "saddle", (-5.91808, 3.41776)),
        ((145.1071, 165, 30), "saddle", (5.58923, -4.65807)),
        ((-20.3730, 78.4432, 30), "solution", (-1, -0.61291)),
        ((110.3730, -108.4432, 30), "solution", (-1, -0.88565)),
    ],
    (2, 130): [
        ((48.4314, -65, 130), "sink", (-1.22073, -0.12128)),
        ((-88.4314, -65, 130), "source", (0.74794, 2.40174)),
        ((68.2331, 115, 130), "saddle", (-1.80731, 3.23737)),
        ((-108.2331, 115, 130), "saddle", (1.31303, -5.08737)),
    ],
}


def turned(a, b):
    """Difference of angles in degrees, modulo a turn."""
    return np.abs((np.asarray(a) - b + 180) % 360 - 180)


@pytest.mark.parametrize(("joint", "angle"), list(TABLE))
def test_published_table(three, joint, angle):
    points = hf.stationary_points(three, TARGET, {joint: RAD(angle)})
    expected = TABLE[joint, angle]
    assert len(points) == len(expected)
    for q, kind, eigenvalues in expected:
        k = int(np.argmin(turned(np.rad2deg(points.q), q).max(axis=1)))
        assert turned(np.rad2deg(points.q[k]), q).max() < 1e-3
        assert points.kinds[k] == kind
        np.testing.assert_allclose(points.eigenvalues[k], sorted(eigenvalues, reverse=True), atol=1e-4)
        assert not points.continuum[k]
        assert points.residual[k] < 1e-9
    assert points.balance == (2 if joint == 0 else 0)  # Poincare and Hopf; singular points of J carry -2 for joint 1


def test_solutions_have_the_eigenvalues_of_the_null_vector(three, rng):
    x = rng.uniform(0.3, 1.5, 2)
    points = hf.stationary_points(three, x, {"joint2": rng.uniform(1.0, 1.5)}).of_kind(Kind.SOLUTION)
    assert len(points) == 2
    for q, values in zip(points.q, points.eigenvalues, strict=True):
        n = np.linalg.svd(three.arm.jacobian(q)[:2])[2][-1]
        np.testing.assert_allclose(np.sort(values.real), [-1, -(n[1] ** 2)], atol=1e-9)


@pytest.mark.parametrize(("rho", "phi", "angle"), [(2, 120, 98.2132), (2, 75, 28.0389), (2, 150, 139.7922)])
def test_two_link_arm_rests_where_the_closed_form_says(rho, phi, angle):
    law = Pseudoinverse(arms.load("planar-2r"), "planar")
    x = np.array([1 + rho * np.cos(RAD(phi)), rho * np.sin(RAD(phi))])
    points = hf.stationary_points(law, x, {0: 0.0})
    assert points.kinds == ["sink"]
    assert np.rad2deg(points.q[0, 1]) == pytest.approx(angle, abs=1e-3)
    np.testing.assert_allclose(points.eigenvalues[0], -(2 - x[0]) / (2 * np.sin(points.q[0, 1] / 2) ** 2), atol=1e-8)


def test_folded_line_is_a_continuum(three):
    """Joint 1 at exactly the angle of the folded arm: a line of rest points besides the two solutions."""
    angle = np.pi / 4 + np.arccos(1 / np.hypot(*TARGET))
    points = hf.stationary_points(three, TARGET, {0: angle})
    line = points.continuum
    assert line.sum() > 50
    assert turned(np.rad2deg(points.q[line, 2]), 180).max() < 1e-3
    assert (points.kind[line] == Kind.DEGENERATE).all()
    assert points.error[line] == pytest.approx(1.87083, abs=1e-5)
    assert points.attracting[line].any()
    assert not points.attracting[line].all()
    assert points.kinds.count("solution") == 2
    assert any("not isolated" in line for line in points.describe())


def test_several_locked_joints(planar4, rng):
    """Two of four joints: the healthy ones alone are commanded nothing; runs end where the sinks are."""
    law = Weighted(planar4, [1.0, 2, 0.5, 1], "planar")
    target = planar4.forward_kinematics(rng.uniform(-2, 2, 4))
    at = rng.uniform(-2, 2, 2)
    points = hf.stationary_points(law, target, dict(zip([0, 2], at, strict=True)))
    np.testing.assert_allclose(points.q[:, [0, 2]], np.tile((at + np.pi) % (2 * np.pi) - np.pi, (len(points), 1)), atol=1e-12)
    assert points.residual.max() < 1e-7
    q0 = rng.uniform(-np.pi, np.pi, (80, 4))
    q0[:, [0, 2]] = at
    runs = hf.simulate(law, q0, target, locked=[0, 2])
    rests = runs.q_final[runs.code <= 1]
    away = np.abs(np.exp(1j * rests)[:, None] - np.exp(1j * points.q)[None]).max(axis=2)
    assert (away.min(axis=1) < 1e-3).all()
    assert points.attracting[away.argmin(axis=1)].all()


def test_redundancy_left_after_the_lock_is_a_continuum_of_solutions(planar4):
    points = hf.stationary_points(Pseudoinverse(planar4, "planar"), planar4.forward_kinematics([0.3, 0.4, 0.5, 0.6]), {1: 0.4})
    reached = points.kind == Kind.SOLUTION
    assert reached.sum() > 20
    assert points.continuum[reached].all()
    assert not points.continuum[~reached].any()


def test_joints_that_the_task_does_not_notice_are_left_out(rng):
    arm = hf.Arm.from_dh([*[hf.DH(a=a, alpha=0.0) for a in (1.0, 0.8, 0.6)], hf.DH(a=0.0, alpha=0.0)], name="spin")
    law = Damped(arm, 0.1, ["vx", "vy"])
    points = hf.stationary_points(law, [1.0, 1.0, 0.0][:2], {1: 2.5})
    plain = hf.stationary_points(
        Damped(hf.Arm.from_dh([hf.DH(a=a, alpha=0.0) for a in (1.0, 0.8, 0.6)]), 0.1, ["vx", "vy"]),
        [1.0, 1.0],
        {1: 2.5},
    )
    assert points.eigenvalues.shape[1] == 2
    assert (points.q[:, 3] == 0).all()
    np.testing.assert_allclose(points.error, plain.error, atol=1e-9)
    assert any("do not affect the task" in line for line in points.describe())


@pytest.mark.parametrize(
    ("locked", "words"),
    [
        ({0: [1.0, 2.0]}, r"'joint1' is locked at \[1.0, 2.0\]; give a finite number, rad"),
        ({0: np.nan}, "finite"),
        ({0: "far"}, "the lock of 'joint1' is not numbers"),
        ({0: 1.0, "joint1": 1.0}, "each joint once"),
        ({0: 1, 1: 1, 2: 1}, "locked names 3 joints of 'planar-3r'; give 1 to 2"),
        ({}, "locked names 0 joints"),
        ([0, 1], "locked gives no value for 'joint1' and 'joint2'; give {joint: value}, rad or m"),
        ({0: 1.0, 1: None}, "no value for 'joint2'"),
        ({"elbow": 1.0}, "elbow"),
        (1.0, "locked is 1.0; it must be a mapping"),
    ],
)
def test_wrong_input_is_one_sentence(three, locked, words):
    with pytest.raises(InputError, match=words):
        hf.stationary_points(three, TARGET, locked)
    with pytest.raises(InputError, match="give one target"):
        hf.stationary_points(three, [TARGET, TARGET], {0: 1.0})


@pytest.mark.parametrize(("joint", "angle"), [(0, 0.3), (1, 0.8)])
def test_none_of_the_failure_tolerant_law_is_lost(joint, angle):
    """What Newton's method finds on the law's own rates, with their differences for slopes, from a grid of starts."""
    law = FailureTolerant(arms.load("planar-3r"), "planar")
    target = law.arm.forward_kinematics([0.7, 1.2, 1.0])
    points = hf.stationary_points(law, target, {joint: angle})
    rest = rest_by_newton(law, target, joint, angle)
    assert len(rest) >= 3
    nearest = np.abs(np.exp(1j * rest)[:, None] - np.exp(1j * points.q)[None]).max(axis=2)
    assert nearest.min(axis=1).max() < 1e-6
    assert nearest.min(axis=0).max() < 1e-6
    linear = linearisation(law)
    for q, kind in zip(rest, nearest.argmin(axis=1), strict=True):
        h = 1e-6 * np.eye(3)[np.arange(3) != joint]
        slopes = (commanded(law, q + h, target) - commanded(law, q - h, target))[:, np.arange(3) != joint].T / 2e-6
        real = np.linalg.eigvals(slopes).real
        expected = "sink" if (real < 0).all() else "source" if (real > 0).all() else "saddle"
        reached = linear.rates(q[None], target)[2][0] < 1e-6
        assert points.kinds[kind] == ("solution" if reached else expected)


def commanded(law, q, target):
    error = target[:2, 3] - law.arm.forward_kinematics(q)[:, :2, 3]
    return law.velocity(q, error)


def rest_by_newton(law, target, joint, angle):
    """(P, 3) where the healthy joints stand still, each once."""
    healthy, grid, h = np.arange(3) != joint, np.arange(-np.pi, np.pi, np.pi / 12), 1e-7
    q = np.full((grid.size**2, 3), angle)
    q[:, healthy] = np.array(np.meshgrid(grid, grid)).reshape(2, -1).T + 0.01
    for _ in range(60):
        rates = commanded(law, q, target)[:, healthy]
        ends = [
            commanded(law, q + side * h * np.eye(3)[k], target)[:, healthy] for k in np.flatnonzero(healthy) for side in (1, -1)
        ]
        slopes = np.stack([ends[0] - ends[1], ends[2] - ends[3]], axis=2) / (2 * h)
        step = -np.einsum("nij,nj->ni", np.linalg.pinv(slopes), rates)
        q[:, healthy] += step * np.minimum(1, 0.3 / np.maximum(np.linalg.norm(step, axis=1, keepdims=True), 1e-12))
    q = q[np.linalg.norm(commanded(law, q, target)[:, healthy], axis=1) < 1e-10]
    kept = []
    for x in q:
        if all(np.abs(np.exp(1j * x) - np.exp(1j * y)).max() > 1e-4 for y in kept):
            kept.append(x)
    return np.array(kept)
