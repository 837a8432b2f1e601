"""Derivatives of the failure-tolerant inverse against differences of the law with the damping from polynomials."""

from __future__ import annotations

import casadi as ca
import damping_oracle
import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.arm import kinematics
from holdfast.control import damping_search
from holdfast.kernels.program import Program

STEP = 1e-5


def oracle(law, x):
    """Rates (n,) at x = (q, v), and the damping and the largest one."""
    q, v = x[: law.arm.n], x[law.arm.n :]
    j = law.task.rows @ oracles.jacobian(law.arm, q[None])[0]
    size = np.linalg.norm(v)
    damping, _, largest = damping_oracle.optimum(j, v / size, law.pre_failure_error)
    return damping_oracle.damped(j, damping) @ v, damping, largest


def symbols(law):
    return kinematics.joint_symbols(law.arm), ca.SX.sym("v", law.task.m)


def test_all_that_the_damping_rests_on_against_differences(rng):
    """No damping, the largest one, where two joints are the worst, and where the slope of the worst is 0."""
    law = hf.control.failure_tolerant(hf.arms.load("planar-3r"), "planar")
    q, v = symbols(law)
    call = ca.Function("slopes", [q, v], list(law.with_slopes(q, v, ca.vertcat(q, v))))
    seen = set()
    for _ in range(150):
        x = np.concatenate([rng.uniform(-np.pi, np.pi, 3), rng.uniform(0.5, 2) * law.task.rows[:, :2] @ circle(rng)])
        rates, damping, largest = oracle(law, x)
        found, slopes = (np.array(part) for part in call(x[:3], x[3:]))
        np.testing.assert_allclose(found.ravel(), rates, rtol=1e-6, atol=1e-6)
        ends = [[oracle(law, x + side * row) for side in (1, -1)] for row in STEP * np.eye(5)]
        expected = np.column_stack([(ahead[0] - behind[0]) / (2 * STEP) for ahead, behind in ends])
        half = np.column_stack([(ahead[0] - rates) / STEP for ahead, _ in ends])
        if np.abs(expected - half).max() > 1e-3 * np.abs(expected).max():
            continue  # the damping goes from one condition to another, or jumps, within the step
        np.testing.assert_allclose(slopes, expected, rtol=1e-5, atol=1e-5 * np.abs(expected).max())
        seen.add("none" if damping == 0 else "largest" if damping > largest * (1 - 1e-9) else worst(law, x, damping))
    assert seen == {"none", "largest", "one joint", "two joints"}


def circle(rng):
    angle = rng.uniform(0, 2 * np.pi)
    return np.array([np.cos(angle), np.sin(angle)])


def worst(law, x, damping):
    j = law.task.rows @ oracles.jacobian(law.arm, x[None, :3])[0]
    u = x[3:] / np.linalg.norm(x[3:])
    sizes = np.sort(damping_oracle.errors(j, u, damping_oracle.damped(j, damping) @ u)[0])
    return "two joints" if sizes[-2] > sizes[-1] * (1 - 1e-7) else "one joint"


@pytest.mark.parametrize("task", ["position", "pose"])
def test_of_a_spatial_arm_they_are_those_of_the_search(task, rng):
    """CasADi's derivative of the search itself, in some directions: ten times the operations."""
    law = hf.control.failure_tolerant(hf.arms.load("panda"), task)
    q, v = symbols(law)
    x, along = ca.vertcat(q, v), ca.SX.sym("along", law.arm.n + law.task.m)
    rates, slopes = law.with_slopes(q, v, x)
    call = ca.Function("slopes", [x, along], [slopes @ along, ca.jtimes(rates, x, along)])
    for _ in range(30):
        found, expected = (np.array(part) for part in call(rng.uniform(-2, 2, x.numel()), rng.normal(size=x.numel())))
        np.testing.assert_allclose(found, expected, rtol=1e-5, atol=1e-5 * np.abs(expected).max())


def test_the_search_is_not_differentiated():
    """With their derivatives the rates take less than twice the operations; the search's own derivative took 13 times."""
    law = hf.control.failure_tolerant(hf.arms.load("panda"), "position")
    q, v = symbols(law)
    rates, slopes = law.with_slopes(q, v, ca.vertcat(q, v))
    alone, both = (ca.Function("rates", [q, v], out, {"cse": True}).n_instructions() for out in ([rates], [rates, slopes]))
    assert both < 2 * alone


def test_the_peak_error_that_is_written_down_once_is_the_one_of_every_call():
    """The same program: the same bits."""
    sizes = [
        ca.SX.sym(name, n) for name, n in (("squares", 3), ("c", 3), ("first", 5), ("second", 5), ("third", 5), ("columns", 5))
    ]
    squares, c, *products, columns = (ca.vertsplit(x) for x in sizes)
    s, missing = ca.SX.sym("s"), ca.SX.sym("missing")
    error = damping_search._PeakError(squares, c, products, columns, missing)
    one, other = (Program("error", [s, missing, *sizes], [ca.vertcat(*found)]) for found in (error(s), error._written(s)))
    assert one.digest == other.digest
