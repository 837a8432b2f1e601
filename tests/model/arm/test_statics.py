"""Gravity torques, composite bodies and the inertia diagonal against Pinocchio, plain sums over links and differences."""

from __future__ import annotations

from dataclasses import replace

import casadi as ca
import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import arms
from holdfast.kernels import Kernel
from holdfast.model.arm import kinematics, statics

WITH_INERTIA = ["planar-3r", "panda", "xarm7", "iiwa14", "ur5-rail", "kinova-j2s6s200"]


def compiled(arm, build):
    """Values of a list of expressions on the CasADi machine: many arms without a compilation each."""
    q = kinematics.joint_symbols(arm)
    return Kernel("test", [q], build(q), backend="casadi")


def close(got, expected, tolerance=1e-10):
    np.testing.assert_allclose(got, expected, rtol=0, atol=tolerance * max(1.0, np.abs(expected).max()))


def bodies_in_world(arm, q):
    """Masses, centres (N, 3) and inertias (N, 3, 3) of all bodies, payload last, and the link each belongs to."""
    made = oracles.frames(arm, q)
    out = []
    for k, body in [*enumerate(arm.links), *([] if arm.payload is None else [(arm.n - 1, arm.payload)])]:
        t = made[k + 1]
        turn = t[:, :3, :3]
        out.append((k, body.mass, t[:, :3, 3] + turn @ body.com, turn @ body.inertia @ turn.transpose(0, 2, 1)))
    return out


def sums(arm, q):
    """First (N, n, 3) and second (N, n, 3, 3) moments behind each joint about its frame's origin, by summing over bodies."""
    made = oracles.frames(arm, q)
    first, second = np.zeros((len(q), arm.n, 3)), np.zeros((len(q), arm.n, 3, 3))
    for i in range(arm.n):
        origin = (made[i] @ arm.joints[i].origin)[:, :3, 3]
        for k, mass, centre, inertia in bodies_in_world(arm, q):
            if k >= i:
                r = centre - origin
                first[:, i] += mass * r
                second[:, i] += inertia + mass * (
                    np.einsum("ni,ni->n", r, r)[:, None, None] * np.eye(3) - r[:, :, None] * r[:, None, :]
                )
    return first, second


def axes(arm, q):
    """Joint axes (N, n, 3) in the world."""
    made = oracles.frames(arm, q)
    return np.stack([t[:, :3, :3] @ j.origin[:3, :3] @ j.axis for t, j in zip(made, arm.joints, strict=False)], 1)


@pytest.mark.interpreted
def test_random_arms_against_pinocchio(rng):
    import pinocchio as pin

    for trial in range(40):
        arm = oracles.random_arm(rng, limits=2.0)
        arm = oracles.with_bodies(arm, rng, payload=trial % 3 == 0, armature=trial % 2 == 0)
        model, _ = oracles.to_pinocchio(arm)
        data = model.createData()

        def build(q, arm=arm):
            c = statics.composite_bodies(arm, q)
            tau = statics.gravity_torques(arm, c)
            return [tau, statics.inertia_diagonal(arm, c), ca.jacobian(tau, q)]

        q = oracles.inside(arm, rng, 4)
        for row, tau, m, slope in zip(q, *compiled(arm, build)(q), strict=True):
            close(tau, pin.computeGeneralizedGravity(model, data, row))
            close(m, np.diag(pin.crba(model, data, row)))
            close(slope, pin.computeGeneralizedGravityDerivatives(model, data, row))
            np.testing.assert_allclose(slope, slope.T, atol=1e-10)


@pytest.mark.parametrize("name", WITH_INERTIA)
def test_built_in_arms_against_pinocchio(name, rng):
    import pinocchio as pin

    arm = arms.load(name)
    arm = arm.with_base(oracles.random_pose(rng)).with_payload(oracles.random_link(rng))
    model, _ = oracles.to_pinocchio(arm)
    data = model.createData()
    q = oracles.inside(arm, rng, 20)
    torque, inertia = arm.gravity_torque(q), arm.inertia_diagonal(q)
    assert torque.shape == inertia.shape == q.shape
    for row, tau, m in zip(q, torque, inertia, strict=True):
        close(tau, pin.computeGeneralizedGravity(model, data, row))
        close(m, np.diag(pin.crba(model, data, row)))
    np.testing.assert_array_equal(arm.gravity_torque(q[3]), torque[3])
    np.testing.assert_array_equal(arm.inertia_diagonal(q[3]), inertia[3])


@pytest.mark.interpreted
def test_composite_bodies_are_plain_sums_over_links(rng):
    """Eq. (9), (10), (26), (27)."""
    for trial in range(8):
        arm = oracles.with_bodies(oracles.random_arm(rng, limits=2.0), rng, payload=trial % 2 == 0)

        def build(q, arm=arm):
            w = statics.express_in_world(statics.composite_bodies(arm, q))
            return [ca.horzcat(*w.moments).T, ca.vertcat(*w.inertias), ca.horzcat(*w.points).T, ca.horzcat(*w.axes).T]

        q = oracles.inside(arm, rng, 5)
        first, second, points, axes = compiled(arm, build)(q)
        expected = sums(arm, q)
        close(first.reshape(expected[0].shape), expected[0])
        close(second.reshape(expected[1].shape), expected[1])
        made = oracles.frames(arm, q)
        for i, joint in enumerate(arm.joints):
            frame = made[i] @ joint.origin
            close(points.reshape(-1, arm.n, 3)[:, i], frame[:, :3, 3])
            close(axes.reshape(-1, arm.n, 3)[:, i], frame[:, :3, :3] @ joint.axis)
        masses = statics.composite_bodies(arm, kinematics.joint_symbols(arm)).masses
        np.testing.assert_allclose(
            masses, [sum(b[1] for b in bodies_in_world(arm, q) if b[0] >= i) for i in range(arm.n)], rtol=1e-13
        )


@pytest.mark.interpreted
@pytest.mark.parametrize("types", ["RPRRPR", "PRRPR", "RRRR"])
def test_the_derivatives_of_the_paper_against_differences(types, rng):
    """Eq. (14)-(17) and (31), (33)-(35), all pairs of joints."""
    arm = oracles.with_bodies(oracles.random_arm(rng, types=types, limits=2.0), rng, payload=True, armature=True)
    n = arm.n

    def build(q):
        w = statics.express_in_world(statics.composite_bodies(arm, q))
        every = [(i, j) for j in range(n) for i in range(n)]
        return [
            ca.horzcat(*[statics.axis_derivative(arm, w, i, j) for i, j in every]).T,
            ca.horzcat(*[statics.moment_derivative(arm, w, i, j) for i, j in every]).T,
            ca.vertcat(*[statics.inertia_derivative(arm, w, i, j) for i, j in every]),
        ]

    def diagonal(q):
        z, second = axes(arm, q), sums(arm, q)[1]
        sliding = np.array([sum(b[1] for b in bodies_in_world(arm, q) if b[0] >= i) for i in range(n)])
        return np.where(arm.prismatic, sliding, np.einsum("nia,niab,nib->ni", z, second, z))

    for row in oracles.inside(arm, rng, 3):
        dz, ds, dm = compiled(arm, build)(row)
        close(dz.reshape(n, n, 3), oracles.slope(lambda x: axes(arm, x), row), 1e-9)
        close(ds.reshape(n, n, 3), oracles.slope(lambda x: sums(arm, x)[0], row), 1e-9)
        close(dm.reshape(n, n), oracles.slope(diagonal, row), 1e-9)


def test_planar_arm_by_hand(rng):
    """Specification, section 8.1: half of g times the horizontal reach, counted from the tip."""
    arm, g = arms.load("planar-3r"), 9.81
    q = rng.uniform(-3, 3, (50, 3))
    c1, c2, c3 = np.cos(np.cumsum(q, axis=1)).T
    expected = g / 2 * np.stack([5 * c1 + 3 * c2 + c3, 3 * c2 + c3, c3], 1)
    close(arm.gravity_torque(q), expected, 1e-13)
    reach = 1 + 1 / 4 + 1 / 12 + np.cos(q[:, 2])  # the last two rods about joint 2
    close(arm.inertia_diagonal(q), np.stack([arm.inertia_diagonal(q)[:, 0], 1 / 3 + reach, np.full(50, 1 / 3)], 1), 1e-13)


def test_bad_rows_and_bad_configurations(mixed5, rng):
    arm = oracles.with_bodies(mixed5, rng)
    q = oracles.inside(arm, rng, 3)
    q[1, 2] = np.nan
    tau = arm.gravity_torque(q)
    np.testing.assert_array_equal(np.isnan(tau).all(axis=1), [False, True, False])
    assert np.isfinite(tau[[0, 2]]).all()
    with pytest.raises(hf.InputError, match="has 4 values"):
        arm.gravity_torque(q[:, :4])


def test_links_of_which_nothing_is_known_are_refused(rng):
    arm = oracles.with_bodies(oracles.random_arm(rng, types="RRR"), rng)
    unknown = replace(arm, links=(arm.links[0], None, arm.links[2]))
    for ask in (unknown.gravity_torque, unknown.inertia_diagonal):
        with pytest.raises(hf.ArmError, match=r"link after joint 'j1': it has no inertial data.*mass 0"):
            ask(np.zeros(3))


@pytest.mark.interpreted
def test_massless_links_and_points_pass_but_impossible_inertias_do_not(rng):
    arm = oracles.with_bodies(oracles.random_arm(rng, types="RRR"), rng)
    massless, point = hf.Link(0.0, np.zeros(3), np.zeros((3, 3))), hf.Link(2.0, np.array([0.1, 0.2, 0.3]), np.zeros((3, 3)))
    fine = replace(arm, links=(arm.links[0], massless, point))
    q = rng.uniform(-1, 1, 3)
    first, second = sums(fine, q[None])
    z = axes(fine, q[None])[0]
    close(fine.gravity_torque(q), np.einsum("ia,ia->i", z, np.cross(first[0], -fine.gravity)))
    close(fine.inertia_diagonal(q), np.einsum("ia,iab,ib->i", z, second[0], z))
    for moments, words in (([1.0, 1.0, 3.0], "triangle"), ([-1.0, 1.0, 1.0], "principal moment")):
        bad = hf.Link(1.0, np.zeros(3), np.diag(moments), name="odd")
        for wrong, subject in (
            (replace(arm, links=(*arm.links[:2], bad)), "link 'odd'"),
            (replace(arm, payload=bad), "payload"),
        ):
            assert np.isfinite(wrong.gravity_torque(q)).all()
            with pytest.raises(hf.ArmError, match=f"{subject}: .*{words}"):
                wrong.inertia_diagonal(q)
