"""Poses, Jacobians and their derivatives against transforms in numpy and against Pinocchio."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

import oracles
from holdfast import arms
from holdfast.core.errors import InputError
from holdfast.model.arm import kinematics

TYPES = ["RR", "PR", "CPR", "RRRR", "RPRPR", "RRCRRR", "PRRRRRR", "RPRRRPRR", "RRRRRRRRR"]


@pytest.fixture(scope="module", params=TYPES)
def arm(request, generator):
    return oracles.random_arm(generator(f"kinematics {request.param}"), types=request.param)


@pytest.fixture
def q(arm, rng):
    return rng.uniform(-4, 4, (25, arm.n))


def evaluate(expression, symbol, q):
    """A plain CasADi function over rows, no kernel."""
    f = ca.Function("f", [symbol], [ca.densify(expression)])
    return np.array([np.array(f(x)) for x in q])


def test_pose_is_the_product_of_transforms(arm, q):
    np.testing.assert_allclose(arm.forward_kinematics(q), oracles.forward(arm, q), atol=2e-14)


def test_jacobian_is_the_derivative_of_the_pose(arm, q):
    np.testing.assert_allclose(arm.jacobian(q), oracles.jacobian(arm, q), atol=3e-14)


@pytest.mark.parametrize("name", arms.names())
def test_built_in_arms(name, rng):
    arm = arms.load(name)
    q = oracles.inside(arm, rng, 10)
    np.testing.assert_allclose(arm.forward_kinematics(q), oracles.forward(arm, q), atol=2e-14)
    np.testing.assert_allclose(arm.jacobian(q), oracles.jacobian(arm, q), atol=3e-14)


def test_pinocchio_agrees(arm, q):
    pin = pytest.importorskip("pinocchio")
    model, tool = oracles.to_pinocchio(arm)
    data = model.createData()
    for row, t, j in zip(q, arm.forward_kinematics(q), arm.jacobian(q), strict=True):
        theirs = pin.computeFrameJacobian(model, data, row, tool, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
        pin.framesForwardKinematics(model, data, row)
        np.testing.assert_allclose(t, data.oMf[tool].homogeneous, atol=2e-14)
        np.testing.assert_allclose(j, theirs, atol=3e-14)


@pytest.mark.interpreted
@pytest.mark.parametrize("types", ["CPR", "RPRPR", "RPRRRPRR"])
def test_jacobian_derivative(types, rng):
    arm = oracles.random_arm(rng, types=types)
    q = rng.uniform(-3, 3, (3, arm.n))
    derivative = arm.jacobian_derivative(q)
    assert derivative.shape == (3, arm.n, 6, arm.n)
    for row, ours in zip(q, derivative, strict=True):
        np.testing.assert_allclose(ours, oracles.slope(lambda x: oracles.jacobian(arm, x), row, 1e-3), atol=5e-11)
        np.testing.assert_allclose(ours, oracles.jacobian_slope(arm, oracles.jacobian(arm, row[None])[0]), atol=1e-13)
        np.testing.assert_array_equal(arm.jacobian_derivative(row), ours)


def test_tool_jacobian_is_the_jacobian_in_the_tool_frame(arm, q):
    x = kinematics.joint_symbols(arm)
    ours = evaluate(kinematics.tool_jacobian(arm, x), x, q)
    turn = oracles.forward(arm, q)[:, :3, :3].transpose(0, 2, 1)
    j = oracles.jacobian(arm, q)
    np.testing.assert_allclose(ours, np.concatenate([turn @ j[:, :3], turn @ j[:, 3:]], axis=1), atol=3e-14)


@pytest.mark.interpreted
@pytest.mark.parametrize("types", ["RRRRRR", "RPRRRRR", "RRRRRRRRR", "PRRRRPRR"])
def test_invariant_jacobian_is_a_unimodular_change_of_rows(types, rng):
    arm = oracles.random_arm(rng, types=types)
    q = rng.uniform(-3, 3, (20, arm.n))
    x = kinematics.joint_symbols(arm)
    for ours, j in zip(evaluate(kinematics.invariant_jacobian(arm, x), x, q), oracles.jacobian(arm, q), strict=True):
        change = ours @ np.linalg.pinv(j)
        tolerance = 1e-13 * oracles.condition(j)
        np.testing.assert_allclose(change @ j, ours, atol=tolerance)  # the same row space
        assert np.linalg.det(change) == pytest.approx(1, abs=100 * tolerance)
        assert np.linalg.det(ours @ ours.T) == pytest.approx(np.linalg.det(j @ j.T), rel=100 * tolerance)


def test_invariant_jacobian_has_no_more_entries_than_the_world_one(pa10):
    x = kinematics.joint_symbols(pa10)
    assert kinematics.invariant_jacobian(pa10, x).nnz() < kinematics.world_jacobian(pa10, x).nnz()


def test_chain_is_the_same_in_every_frame(arm, rng):
    q = rng.uniform(-3, 3, (4, arm.n))
    made = oracles.frames(arm, q)
    x = kinematics.joint_symbols(arm)
    for frame in (None, *range(arm.n + 1)):
        c = kinematics.kinematic_chain(arm, x, frame)
        got = evaluate(ca.horzcat(c.rotation, c.position, *c.axes, *c.points), x, q)
        seen_from = np.broadcast_to(np.eye(4), made[0].shape) if frame is None else made[frame]
        rotation, position = seen_from[:, :3, :3], seen_from[:, :3, 3]
        world = rotation @ got
        np.testing.assert_allclose(world[:, :, :3], made[-1][:, :3, :3], atol=2e-14)
        np.testing.assert_allclose(world[:, :, 3] + position, made[-1][:, :3, 3], atol=4e-14)
        for k, joint in enumerate(arm.joints):
            moved = made[k + 1]
            np.testing.assert_allclose(world[:, :, 4 + k], moved[:, :3, :3] @ joint.axis, atol=2e-14)
            off = world[:, :, 4 + arm.n + k] + position - moved[:, :3, 3]  # a point on the axis: any of them
            np.testing.assert_allclose(np.cross(off, moved[:, :3, :3] @ joint.axis), 0, atol=5e-14)


def test_frames_are_the_products_of_the_joints_motions_and_those_of_pinocchio(arm, rng):
    pin = pytest.importorskip("pinocchio")
    q = rng.uniform(-3, 3, (5, arm.n))
    found = arm.frames(q)
    assert found.shape == (5, arm.n + 2, 4, 4)
    np.testing.assert_allclose(found, np.stack(oracles.frames(arm, q), axis=1), atol=4e-14)
    np.testing.assert_array_equal(arm.frames(q[3]), found[3])
    assert arm.frames(q[:0]).shape == (0, arm.n + 2, 4, 4)
    model, tool = oracles.to_pinocchio(arm)
    data = model.createData()
    for row, frames in zip(q, found, strict=True):
        pin.framesForwardKinematics(model, data, row)
        np.testing.assert_allclose(frames[1:-1], [placement.homogeneous for placement in list(data.oMi)[1:]], atol=1e-12)
        np.testing.assert_allclose(frames[-1], data.oMf[tool].homogeneous, atol=1e-12)
    for k, joint in enumerate(arm.joints):
        alone = np.array([joint.motion(x) for x in q[:, k]])
        np.testing.assert_allclose(found[:, k] @ joint.origin @ alone, found[:, k + 1], atol=4e-14)


def test_frames_and_axes_at_zero(arm):
    zero = arm.frames(np.zeros(arm.n))
    np.testing.assert_allclose(arm.frames_at_zero, zero[1:], atol=1e-14)
    axes = [t[:3, :3] @ joint.axis for t, joint in zip(zero[1:], arm.joints, strict=False)]
    np.testing.assert_allclose(arm.axes_at_zero, axes, atol=1e-14)


def test_frames_of_bodies_and_joints_are_the_same_in_every_frame(arm, rng):
    q = rng.uniform(-3, 3, (4, arm.n))
    made = oracles.frames(arm, q)[:-1]
    joints = [before @ joint.origin for before, joint in zip(made, arm.joints, strict=False)]
    x = kinematics.joint_symbols(arm)
    for frame in (None, *range(arm.n + 1)):
        moving, still = kinematics.body_and_joint_frames(arm, kinematics.joint_transforms(arm, x), frame)
        seen_from = np.broadcast_to(np.eye(4), made[0].shape) if frame is None else made[frame]
        got = evaluate(ca.horzcat(*[ca.horzcat(*f) for f in moving + still]), x, q)
        world = seen_from[:, :3, :3] @ got
        world[:, :, 3::4] += seen_from[:, :3, 3, None]
        np.testing.assert_allclose(world, np.concatenate([t[:, :3] for t in made + joints], axis=2), atol=4e-14)


def test_single_configurations_and_batches_give_the_same_bits(arm, q):
    together = arm.jacobian(q)
    for k in (0, 11, 24):
        np.testing.assert_array_equal(arm.jacobian(q[k]), together[k])
        np.testing.assert_array_equal(arm.forward_kinematics(q[k]), arm.forward_kinematics(q)[k])
    assert arm.forward_kinematics(q[0]).shape == (4, 4)


def test_nan_stays_in_its_row(arm, q):
    clean = arm.forward_kinematics(q)
    q[7, -1] = np.nan
    dirty = arm.forward_kinematics(q)
    assert np.isnan(dirty[7]).all()
    np.testing.assert_array_equal(np.delete(dirty, 7, 0), np.delete(clean, 7, 0))


def test_nominal_pose_of_the_paper(pa10):
    t = pa10.forward_kinematics(oracles.NOMINAL)
    np.testing.assert_allclose(t[:3, 3], [0.967484, 0, 0.040735], atol=5e-7)
    np.testing.assert_allclose(t, oracles.forward(pa10, oracles.NOMINAL[None])[0], atol=1e-14)
    np.testing.assert_allclose(t[:3, :3] @ [0, 0, 1], [np.sin(np.radians(174)), 0, np.cos(np.radians(174))], atol=1e-14)
    sigma = np.linalg.svd(pa10.jacobian(oracles.NOMINAL), compute_uv=False)
    np.testing.assert_allclose(sigma, [2.390872, 2.145014, 1.454992, 0.665358, 0.460756, 0.343474], atol=1e-6)


def test_wrong_shapes_are_named(pa10):
    for bad in (np.zeros(8), np.zeros((3, 10)), np.zeros((2, 3, 9)), 0.0, "a"):
        with pytest.raises(InputError, match=r"9|numbers"):
            pa10.forward_kinematics(bad)
