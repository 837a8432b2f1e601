"""Derivatives of the failure-tolerant inverse against differences of the law with the damping from polynomials."""

from __future__ import annotations

import ctypes
import shutil
import subprocess

import casadi as ca
import damping_oracle
import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.control.laws import damping_search
from holdfast.kernels.program import Program
from holdfast.model.arm import kinematics

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
    one, other = (
        Program("error", [s, missing, *sizes], [ca.vertcat(*found)]) for found in (error(s), error._build_value_slope(s))
    )
    assert one.digest == other.digest


def search_in_c(folder, m, n, allowed):
    """What the search in C tells of J (m, n) and v (m,): rates (n,), damping, largest damping and whether one is allowed."""
    source, library = folder / "search.c", folder / f"search{m}{n}.so"
    call = "void call(const double *j, const double *v, double *out)"
    text = damping_search.generate_c_search(m, n, allowed)
    ends = f"{call};\n{call} {{ damped_inverse(j, v, out, out + {n}, out + {n + 1}, out + {n + 2}); }}\n"
    source.write_text(f"#include <math.h>\n{text}\n{ends}")
    flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O1", "-ffp-contract=off", "-fsanitize=undefined"]
    done = ["-fno-sanitize-recover=all", "-shared", "-fPIC", str(source), "-o", str(library), "-lm"]
    subprocess.run(["cc", *flags, *done], check=True, timeout=60)
    function = ctypes.CDLL(str(library)).call

    def run(j, v):
        out = np.full(n + 3, np.nan)
        function(*[np.ascontiguousarray(x).ctypes.data_as(ctypes.c_void_p) for x in (j, v, out)])
        return out

    return run


def jacobians(rng, m, n):
    """Well-conditioned ones, columns of joints that no longer follow, almost singular and singular ones, and none at all."""
    for _ in range(400):
        yield rng.normal(size=(m, n))
    for _ in range(20):
        yield rng.normal(size=(m, n)) * (rng.random(n) > 0.3)
    for far in (1e-2, 1e-4, 1e-6, 0.0):
        for _ in range(5):
            left, right = rng.normal(size=(m, m)), rng.normal(size=(m, n))
            yield left @ (np.append(np.ones(m - 1), far)[:, None] * right)
    yield np.zeros((m, n))


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler (cc) on this machine")
@pytest.mark.parametrize(("m", "n"), [(1, 1), (1, 3), (2, 3), (3, 4), (3, 7), (4, 8), (5, 7), (6, 6), (6, 7), (6, 9)])
def test_in_c_it_finds_what_the_kernel_finds(m, n, rng, tmp_path):
    """Where two dampings are as good as each other rounding chooses: then the peak error says whether both are right."""
    allowed = 0.4
    run = search_in_c(tmp_path, m, n, allowed)
    j, v = ca.SX.sym("j", m, n), ca.SX.sym("v", m)
    size = ca.sqrt(ca.sumsqr(v))
    found = damping_search.search_damping(j, v / size, allowed)
    told = [size * ca.vertcat(*found.rates), found.damping, found.largest, found.feasible]
    kernel = ca.Function("search", [j, v], [ca.vertcat(*told)], {"cse": True})
    others = 0
    for matrix in jacobians(rng, m, n):
        along = rng.uniform(0.1, 3) * rng.normal(size=m)
        got, expected = run(matrix, along), np.array(kernel(matrix, along)).ravel()
        assert got[n + 2] == expected[n + 2]
        np.testing.assert_allclose(got[n + 1], expected[n + 1], rtol=1e-6)
        if np.abs(got[:n] - expected[:n]).max() > 1e-6 * np.abs(expected[:n]).max():
            others += 1
            u = along / np.linalg.norm(along)
            ours, theirs = (damping_oracle.errors(matrix, u, x[:n] / np.linalg.norm(along))[0].max() for x in (got, expected))
            assert ours == pytest.approx(theirs, rel=1e-6)
        assert (run(matrix, np.zeros(m)) == [*np.zeros(n + 2), 1]).all()
    assert others <= 20 or n == 1  # one joint: every damping is as good
