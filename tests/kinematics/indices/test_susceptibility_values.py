"""Free-swinging susceptibilities: values, derivatives and the facts they must obey (specification, sections 2 to 6, 8, 9)."""

from __future__ import annotations

from dataclasses import replace

import casadi as ca
import numpy as np
import pytest
from scipy.optimize import minimize_scalar
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast import arms
from holdfast import susceptibility as sus
from holdfast.kernels import Kernel
from holdfast.kinematics.indices.susceptibility.formulas import ACCELERATION_FORMULA, SWING_ANGLE_FORMULA, TORQUE_FORMULA
from holdfast.model.arm import kinematics

FORMULAS = {f.name: f for f in (TORQUE_FORMULA, ACCELERATION_FORMULA, SWING_ANGLE_FORMULA)}
NAMES = ["torque", "acceleration", "swing-angle"]  # of joints that fail alone


@pytest.fixture(autouse=True)
def _no_compilation(monkeypatch):
    """Many arms, few rows: the CasADi machine; that both backends agree is one test, the edges run on the default one."""
    monkeypatch.setenv("HOLDFAST_BACKEND", "casadi")


@pytest.fixture(scope="module")
def loaded(generator):
    """Six joints, one sliding, nothing aligned, full inertias, a payload, rotor inertias, gravity askew."""
    draw = generator("loaded")
    return oracles.with_bodies(oracles.random_arm(draw, types="RRPRRR", limits=2.0), draw, payload=True, armature=True)


@pytest.fixture(scope="module")
def measures(loaded):
    return {name: sus.by_name(name, loaded) for name in NAMES}


def lever(arm, q):
    """``|s x z| |z x g|`` (N, turning joints) against its typical size: how far each joint is from being degenerate."""
    turning = ~arm.prismatic
    sine = np.abs(np.sin(sus.swing_angle(arm).by_joint(q)[:, turning]))
    out = np.abs(sus.torque(arm).by_joint(q)[:, turning]) / np.maximum(sine, 1e-300)
    return out / np.median(out, axis=0)


def clear(arm, q):
    """Rows away from degenerate joints and from half a turn, where a difference quotient means something."""
    return q[(lever(arm, q).min(axis=1) > 0.2) & (np.abs(sus.swing_angle(arm).by_joint(q)).max(axis=1) < 3.0)]


# ---- values --------------------------------------------------------------------------------------------------------


def test_random_arms_against_pinocchio(rng):
    """Torque, acceleration of the failed joint with the others held, and rest: no torque left, lowest potential energy."""
    import pinocchio as pin

    for trial in range(20):
        arm = oracles.with_bodies(oracles.random_arm(rng, limits=2.0), rng, trial % 3 == 0, trial % 2 == 0)
        model, _ = oracles.to_pinocchio(arm)
        data = model.createData()
        q = kinematics.joint_symbols(arm)
        kernel = Kernel("f", [q], [f.values(arm, q)[0] for f in FORMULAS.values()], backend="casadi")
        x = oracles.inside(arm, rng, 1)[0]
        torque, acceleration, swing = kernel(x)
        size = max(1.0, np.abs(torque).max())
        np.testing.assert_allclose(torque, pin.computeGeneralizedGravity(model, data, x), atol=1e-10 * size)
        for i in range(arm.n):
            only = np.zeros(arm.n)
            only[i] = acceleration[i]
            left = pin.rnea(model, data, x, np.zeros(arm.n), only)[i]
            np.testing.assert_allclose(left, 0, atol=1e-9 * size)
            if arm.prismatic[i]:
                assert swing[i] == 0
                continue
            rest = x.copy()
            rest[i] += swing[i]
            np.testing.assert_allclose(pin.computeGeneralizedGravity(model, data, rest)[i], 0, atol=1e-9 * size)
            energies = []
            for turn in (-0.1, 0.0, 0.1):
                tried = rest.copy()
                tried[i] += turn
                energies.append(pin.computePotentialEnergy(model, data, tried))
            assert energies[1] <= min(energies) + 1e-10 * size


def test_swing_is_the_lowest_potential_energy(loaded, measures, rng):
    import pinocchio as pin

    model, _ = oracles.to_pinocchio(loaded)
    data = model.createData()
    for x in clear(loaded, oracles.inside(loaded, rng, 200))[:5]:
        for i in np.flatnonzero(~loaded.prismatic):

            def energy(turn, x=x, i=i):
                return pin.computePotentialEnergy(model, data, x + turn * np.eye(loaded.n)[i])

            best = minimize_scalar(energy, bounds=(-np.pi, np.pi), method="bounded", options={"xatol": 1e-9}).x
            assert measures["swing-angle"].by_joint(x)[i] == pytest.approx(best, abs=1e-5)


def test_backends_agree(loaded, rng, monkeypatch):
    q = oracles.inside(loaded, rng, 50)
    slow = [sus.by_name(name, loaded) for name in NAMES]
    expected = [(m.evaluate(q), m.gradient(q), m.jacobian(q)) for m in slow]
    monkeypatch.setenv("HOLDFAST_BACKEND", "llvm")
    for name, (values, gradient, jacobian) in zip(NAMES, expected, strict=True):
        fast = sus.by_name(name, loaded)
        got = fast.evaluate(q)
        np.testing.assert_allclose(got.by_joint, values.by_joint, rtol=1e-9, atol=1e-11)
        np.testing.assert_array_equal(got.joint_status, values.joint_status)
        np.testing.assert_allclose(fast.gradient(q), gradient, atol=1e-9 * np.abs(gradient).max())
        np.testing.assert_allclose(fast.jacobian(q), jacobian, atol=1e-9 * np.abs(jacobian).max())


def test_planar_arm_of_the_paper():
    """Specification, section 8.2: normalised values at the best and the worst configuration of the point (0.6, -1.9)."""
    arm = arms.load("planar-3r")
    np.testing.assert_allclose(sus.largest_static_torque(arm), 9.81 * np.array([4.5, 2, 0.5]), rtol=1e-12)
    torque = sus.torque(arm, "worst-case")
    q = np.radians([[1.968, -112.677, 18.084], [-138.349, 71.885, 47.885]])
    np.testing.assert_allclose(torque(q) / 3, [0.088498, 0.405835], atol=3e-6)
    np.testing.assert_allclose(torque(-q) / 3, torque(q) / 3, rtol=1e-12)
    relative = torque.by_joint(q) / sus.largest_static_torque(arm)
    np.testing.assert_allclose(relative, [[0.432, -0.277, -0.046], [-0.177, 0.537, 0.948]], atol=6e-4)
    second = sus.swing_angle(arm, [0, 1 / np.pi**2, 0])
    np.testing.assert_allclose(second(q), (sus.swing_angle(arm).by_joint(q)[:, 1] / np.pi) ** 2, rtol=1e-12)


# ---- derivatives ---------------------------------------------------------------------------------------------------


def test_the_closed_forms_of_the_paper_are_the_derivatives(rng):
    """(11), (13), (24), (41) by (14)-(17), (31)-(35), (44), (45), and the gradient (3), against differentiation."""
    for trial in range(8):
        arm = oracles.with_bodies(
            oracles.random_arm(rng, int(rng.integers(2, 7)), limits=2.0), rng, trial % 3 == 0, trial % 2 == 0
        )
        n = arm.n
        w = rng.normal(size=(n, n))
        w = w @ w.T
        q = kinematics.joint_symbols(arm)
        for formula in FORMULAS.values():
            f, _ = formula.values(arm, q)
            paper = formula.jacobian(arm, q)
            outputs = [paper, ca.jacobian(f, q), 2 * paper.T @ ca.DM(w) @ f, ca.gradient(ca.dot(f, ca.DM(w) @ f), q)]
            kernel = Kernel(formula.name, [q], outputs, backend="casadi")
            df, expected, gradient, expected_gradient = kernel(oracles.inside(arm, rng, 3))
            np.testing.assert_allclose(df, expected, atol=1e-9 * max(1, np.abs(expected).max()))
            np.testing.assert_allclose(gradient, expected_gradient, atol=1e-9 * max(1, np.abs(expected_gradient).max()))


@pytest.mark.parametrize("name", NAMES)
def test_derivatives_against_differences(name, loaded, rng):
    w = rng.normal(size=(6, 6))
    measure = sus.by_name(name, loaded, w @ w.T)
    q = clear(loaded, oracles.inside(loaded, rng, 300))[:8]
    assert len(q) == 8
    slopes, gradients = measure.jacobian(q), measure.gradient(q)
    for x, slope, gradient in zip(q, slopes, gradients, strict=True):
        expected = oracles.slope(measure.by_joint, x).T
        np.testing.assert_allclose(slope, expected, atol=1e-6 * max(1, np.abs(expected).max()))
        expected = oracles.slope(measure, x)
        np.testing.assert_allclose(gradient, expected, atol=1e-6 * max(1, np.abs(expected).max()))
        np.testing.assert_allclose(gradient, 2 * slope.T @ measure.weights @ measure.by_joint(x), rtol=1e-8, atol=1e-8)
        np.testing.assert_array_equal(measure.gradient(x), gradient)
        np.testing.assert_array_equal(measure.jacobian(x), slope)


@pytest.mark.parametrize("name", NAMES)
def test_expressions_are_what_the_kernels_compute(name, measures, loaded, rng):
    measure = measures[name]
    q = ca.SX.sym("x", 6)
    outputs = [measure.expression(q), measure.by_joint_expression(q), measure.gradient_expression(q)]
    kernel = Kernel("own", [q], outputs, backend="casadi")
    x = oracles.inside(loaded, rng, 20)
    value, by_joint, gradient = kernel(x)
    np.testing.assert_allclose(value, measure(x), rtol=1e-9)
    np.testing.assert_allclose(by_joint, measure.by_joint(x), rtol=1e-9, atol=1e-10)
    np.testing.assert_allclose(gradient, measure.gradient(x), rtol=1e-8, atol=1e-8)


def test_together_is_each_by_itself(measures, loaded, rng):
    together = sus.SusceptibilityBatch([measures[name] for name in NAMES])
    q = oracles.inside(loaded, rng, 30)
    q[4, 1] = np.nan
    values, gradients = together(q)
    assert (values.shape, gradients.shape) == ((30, 3), (30, 3, 6))
    for k, name in enumerate(NAMES):
        np.testing.assert_allclose(values[:, k], measures[name](q), rtol=1e-9)
        np.testing.assert_allclose(gradients[:, k], measures[name].gradient(q), rtol=1e-8, atol=1e-8)
    np.testing.assert_array_equal(together(q[3])[1], gradients[3])
    with pytest.raises(hf.InputError, match="at least one, and all of the same arm"):
        sus.SusceptibilityBatch([])
    with pytest.raises(hf.InputError, match="NaN or infinity"):
        together(q[4])


# ---- facts ---------------------------------------------------------------------------------------------------------


def test_each_joint_turns_its_own_swing_back_one_to_one(measures, loaded, rng):
    q = oracles.inside(loaded, rng, 100)
    own = np.diagonal(measures["swing-angle"].jacobian(q), axis1=1, axis2=2)
    np.testing.assert_allclose(own, np.where(loaded.prismatic, 0.0, -1.0) * np.ones((100, 1)), atol=1e-9)


def test_swing_is_where_it_accelerates_and_never_over_the_top(measures, loaded, rng):
    q = oracles.inside(loaded, rng, 500)
    swing, acceleration = measures["swing-angle"].by_joint(q), measures["acceleration"].by_joint(q)
    turning = ~loaded.prismatic
    assert (np.abs(swing) <= np.pi).all()
    assert (np.sign(swing) == np.sign(acceleration))[:, turning].all()


def test_torque_is_lever_times_sine_of_the_swing(loaded, measures, rng):
    """``A^2 + B^2 = |s x z|^2 |z x g|^2``: the torque a quarter turn from rest, found by turning the joint there."""
    for x in oracles.inside(loaded, rng, 5):
        swing = measures["swing-angle"].by_joint(x)
        for i in np.flatnonzero(~loaded.prismatic):
            quarter = x.copy()
            quarter[i] += swing[i] - np.pi / 2
            most = -measures["torque"].by_joint(quarter)[i]
            np.testing.assert_allclose(-measures["torque"].by_joint(x)[i], most * np.sin(swing[i]), atol=1e-9 * abs(most))


def test_torque_derivatives_are_a_hessian(measures, loaded, rng):
    slopes = measures["torque"].jacobian(oracles.inside(loaded, rng, 50))
    np.testing.assert_allclose(slopes, slopes.transpose(0, 2, 1), atol=1e-9)


def test_strength_of_gravity_and_scale_of_mass(loaded, measures, rng):
    q = oracles.inside(loaded, rng, 20)
    strong = replace(loaded, gravity=3 * loaded.gravity)

    def scaled(body):
        return hf.Link(5 * body.mass, body.com, 5 * body.inertia)

    heavy = replace(loaded, links=tuple(scaled(b) for b in loaded.links), payload=scaled(loaded.payload))
    for name, by_gravity, by_mass in (("torque", 3, 5), ("acceleration", 3, None), ("swing-angle", 1, 1)):
        f = measures[name].by_joint(q)
        np.testing.assert_allclose(sus.by_name(name, strong).by_joint(q), by_gravity * f, rtol=1e-9, atol=1e-10)
        if by_mass:  # rotor inertia does not scale with the links
            np.testing.assert_allclose(sus.by_name(name, heavy).by_joint(q), by_mass * f, rtol=1e-9, atol=1e-10)


def test_the_world_may_be_turned(loaded, measures, rng):
    """Base and gravity turned together change nothing."""
    turn = oracles.random_pose(rng)
    turned = replace(loaded.with_base(turn @ loaded.base), gravity=turn[:3, :3] @ loaded.gravity)
    q = oracles.inside(loaded, rng, 20)
    for name in NAMES:
        np.testing.assert_allclose(
            sus.by_name(name, turned).by_joint(q), measures[name].by_joint(q), rtol=1e-8, atol=1e-9, err_msg=name
        )


def test_a_joint_with_its_axis_along_gravity_changes_nothing_behind_it(rng):
    arm = oracles.with_bodies(oracles.random_arm(rng, types="RRRR", base=False), rng)
    upright = Rotation.align_vectors([[0, 0, 1]], [arm.joints[0].origin[:3, :3] @ arm.joints[0].axis])[0].as_matrix()
    arm = replace(arm.with_base(oracles.pose(upright)), gravity=np.array([0, 0, -9.81]))
    q = rng.uniform(-2, 2, (10, 4))
    for name in NAMES:
        measure = sus.by_name(name, arm)
        np.testing.assert_allclose(measure.jacobian(q)[:, :, 0], 0, atol=1e-7)
        turned = q.copy()
        turned[:, 0] += 1.0
        np.testing.assert_allclose(measure(turned), measure(q), rtol=1e-7)


def test_payload_is_a_body_of_the_last_link(loaded, rng):
    q = oracles.inside(loaded, rng, 10)
    welded = replace(loaded, payload=None, links=(*loaded.links[:-1], hf.Link.merge([loaded.links[-1], loaded.payload])))
    for name in NAMES:
        np.testing.assert_allclose(sus.by_name(name, welded).by_joint(q), sus.by_name(name, loaded).by_joint(q), rtol=1e-12)
        assert (
            np.abs(sus.by_name(name, replace(loaded, payload=None)).by_joint(q) - sus.by_name(name, loaded).by_joint(q)).max()
            > 0.01
        )


def test_armature_slows_the_failed_joint_only(loaded, rng):
    q = oracles.inside(loaded, rng, 10)
    bare = replace(loaded, joints=tuple(replace(j, armature=0.0) for j in loaded.joints))
    for name in ("torque", "swing-angle"):
        np.testing.assert_array_equal(sus.by_name(name, bare).by_joint(q), sus.by_name(name, loaded).by_joint(q))
    rotor = np.array([j.armature for j in loaded.joints])
    np.testing.assert_allclose(
        -sus.torque(loaded).by_joint(q) / sus.acceleration(loaded).by_joint(q), bare.inertia_diagonal(q) + rotor, rtol=1e-9
    )
