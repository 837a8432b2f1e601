"""Edges that once broke: half turns, empty batches, one-row tasks, NumPy integers, odd starts."""

import casadi as ca
import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.core.registry import INDEX_REGISTRY
from holdfast.kernels import Kernel, Loop
from holdfast.kinematics.indices import CustomIndex, by_name
from holdfast.kinematics.solvers import solve_ik, solver
from holdfast.model.arm.task import as_task
from holdfast.model.failure_modes import failure_sets


@pytest.fixture(scope="module")
def pa10():
    return oracles.pa10_nine()


@pytest.fixture(scope="module")
def pa10_7():
    from holdfast import arms

    return arms.load("pa10-7dof")


def test_half_a_turn_is_not_reached(pa10_7):
    q = np.radians([10.0, 30, 20, 90, 10, 60, 0])
    turned = q.copy()
    turned[6] = np.pi
    target = pa10_7.forward_kinematics(turned)
    reach = solve_ik(pa10_7, target, start=q, restarts=50)
    assert np.abs(pa10_7.forward_kinematics(reach.q) - target).max() < 1e-5 or reach.status != 0
    flipped = pa10_7.forward_kinematics(q) @ np.diag([1.0, -1, -1, 1])
    for task in ("pose", "pointing"):
        reach = solve_ik(pa10_7, flipped, start=q, task=task, restarts=50)
        off = pa10_7.forward_kinematics(reach.q)[:3, 2] - flipped[:3, 2]
        assert np.abs(off).max() < 1e-5 or reach.status != 0


@pytest.mark.parametrize("op", ["sincos", "tan"])
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_nan_leaves_the_bits_of_its_neighbours(op, bad):
    x = ca.SX.sym("x")
    k = Kernel(op, [x], [ca.vertcat(ca.sin(x), ca.cos(x)) if op == "sincos" else ca.tan(x)], backend="llvm")
    a = np.random.default_rng(0).uniform(-4, 4, (20000, k.lanes))
    clean = k(a.ravel()).reshape(20000, k.lanes, -1)
    a[:, 3] = bad
    dirty = k(a.ravel()).reshape(20000, k.lanes, -1)
    np.testing.assert_array_equal(np.delete(dirty, 3, 1), np.delete(clean, 3, 1))


def test_casadi_backend_takes_infinity_without_a_warning():
    x = ca.SX.sym("x", 2)
    got = Kernel("k", [x], [x[0] + x[1]], backend="casadi")(np.array([[1.0, 2], [np.inf, 0], [np.inf, -np.inf]]))
    np.testing.assert_array_equal(np.isnan(got), [False, True, True])
    loop = Loop("l", x[0], [x[1]], next_state=(x[0] + x[1] / x[0]) / 2, residual=ca.fabs(x[0] ** 2 - x[1]), backend="casadi")
    assert not loop.run(np.zeros((1, 1)), np.ones((1, 1)), 1e-9, 5).done.any()


@pytest.mark.parametrize("backend", ["llvm", "casadi"])
def test_no_rows(backend, pa10):
    x, a = ca.SX.sym("x", 2), ca.SX.sym("a", 2, 3)
    one, two = Kernel("k", [x, a], [x[0] * a, x], backend=backend)(np.zeros((0, 2)), np.zeros((0, 2, 3)))
    assert (one.shape, two.shape) == ((0, 2, 3), (0, 2))


def test_no_rows_higher_up(pa10):
    q = np.zeros((0, 9))
    assert pa10.forward_kinematics(q).shape == (0, 4, 4)
    assert pa10.jacobian(q).shape == (0, 6, 9)
    for index in (*(oracles.index_of(n, pa10, "position") for n in INDEX_REGISTRY), CustomIndex(ca.sumsqr, pa10, "position")):
        e = index.evaluate(q)
        assert (e.value.shape, e.by_failure.shape, index(q).shape, index.gradient(q).shape) == ((0,), (0, 9), (0,), (0, 9))
    assert solve_ik(pa10, np.zeros((0, 4, 4))).q.shape == (0, 9)


@pytest.mark.parametrize("name", [n for n in INDEX_REGISTRY if "singular" in n])
def test_gradient_of_a_task_of_one_row(name, pa10):
    index = by_name(name, pa10, ["vx"])
    q = np.random.default_rng(0).uniform(pa10.lower, pa10.upper, (5, 9))
    g = index.gradient(q)
    assert g.shape == (5, 9)
    np.testing.assert_array_equal(g[2], index.gradient(q[2]))


def test_numpy_integers_are_joints(pa10):
    assert failure_sets(pa10, [np.int64(2), (np.int64(0), 1)]) == ((2,), (0, 1))
    assert failure_sets(pa10, np.int64(2)) == failure_sets(pa10, "pairs")


def test_the_solver_of_an_arm_and_task_is_compiled_once(pa10):
    assert solver(pa10, as_task(pa10, "pose")) is solver(pa10, as_task(pa10, "pose"))


def test_starts_for_another_number_of_poses(pa10):
    poses = np.tile(np.eye(4), (2, 1, 1))
    with pytest.raises(hf.InputError, match="start"):
        solve_ik(pa10, poses, start=np.zeros((3, 9)), restarts=1)
