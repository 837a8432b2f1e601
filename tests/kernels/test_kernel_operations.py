"""Each row of the table of operations, alone, against numpy."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest
from scipy.special import erf

import holdfast as hf
from holdfast.core.errors import KernelError
from holdfast.kernels import Kernel
from holdfast.kernels.llvm.translation import SUPPORTED_OPERATIONS
from holdfast.kernels.program import OP_NAMES

ANY = (-5.0, 5.0)


def truth(condition):
    return np.where(condition, 1.0, 0.0)


# operation that must appear, expression of CasADi scalars, the same in numpy, range of x, relative tolerance
TABLE = {
    "add": (ca.OP_ADD, lambda x, y: x + y, np.add, ANY),
    "sub": (ca.OP_SUB, lambda x, y: x - y, np.subtract, ANY),
    "mul": (ca.OP_MUL, lambda x, y: x * y, np.multiply, ANY),
    "div": (ca.OP_DIV, lambda x, y: x / y, np.divide, ANY),
    "neg": (ca.OP_NEG, lambda x, y: -x, lambda x, y: -x, ANY),
    "exp": (ca.OP_EXP, lambda x, y: ca.exp(x), lambda x, y: np.exp(x), ANY),
    "log": (ca.OP_LOG, lambda x, y: ca.log(x), lambda x, y: np.log(x), (1e-6, 9.0)),
    "pow": (ca.OP_POW, lambda x, y: ca.power(x, y), np.power, (1e-3, 5.0)),
    "constpow": (ca.OP_CONSTPOW, lambda x, y: ca.constpow(x, 2.5), lambda x, y: x**2.5, (0.0, 5.0)),
    "negative power": (None, lambda x, y: ca.constpow(x, -3.0), lambda x, y: x**-3.0, ANY),
    "cube": (None, lambda x, y: x**3, lambda x, y: x**3, ANY),
    "sqrt": (ca.OP_SQRT, lambda x, y: ca.sqrt(x), lambda x, y: np.sqrt(x), (0.0, 9.0)),
    "sq": (ca.OP_SQ, lambda x, y: x * x, lambda x, y: x * x, ANY),
    "twice": (ca.OP_TWICE, lambda x, y: x + x, lambda x, y: 2 * x, ANY),
    "sin": (ca.OP_SIN, lambda x, y: ca.sin(x), lambda x, y: np.sin(x), (-50.0, 50.0)),
    "cos": (ca.OP_COS, lambda x, y: ca.cos(x), lambda x, y: np.cos(x), (-50.0, 50.0)),
    "tan": (ca.OP_TAN, lambda x, y: ca.tan(x), lambda x, y: np.tan(x), ANY),
    "asin": (ca.OP_ASIN, lambda x, y: ca.asin(x), lambda x, y: np.arcsin(x), (-1.0, 1.0)),
    "acos": (ca.OP_ACOS, lambda x, y: ca.acos(x), lambda x, y: np.arccos(x), (-1.0, 1.0)),
    "atan": (ca.OP_ATAN, lambda x, y: ca.atan(x), lambda x, y: np.arctan(x), ANY),
    "atan2": (ca.OP_ATAN2, lambda x, y: ca.atan2(x, y), np.arctan2, ANY),
    "inv": (ca.OP_INV, lambda x, y: 1 / x, lambda x, y: 1 / x, ANY),
    "lt": (ca.OP_LT, lambda x, y: x < y, lambda x, y: truth(x < y), ANY),
    "le": (ca.OP_LE, lambda x, y: x <= y, lambda x, y: truth(x <= y), ANY),
    "gt": (ca.OP_LT, lambda x, y: x > y, lambda x, y: truth(x > y), ANY),
    "ge": (ca.OP_LE, lambda x, y: x >= y, lambda x, y: truth(x >= y), ANY),
    "eq": (ca.OP_EQ, lambda x, y: x == y, lambda x, y: truth(x == y), ANY),
    "ne": (ca.OP_NE, lambda x, y: x != y, lambda x, y: truth(x != y), ANY),
    "not": (ca.OP_NOT, lambda x, y: ca.logic_not(x), lambda x, y: truth(x == 0), ANY),
    "and": (ca.OP_AND, lambda x, y: ca.logic_and(x, y), lambda x, y: truth((x != 0) & (y != 0)), ANY),
    "or": (ca.OP_OR, lambda x, y: ca.logic_or(x, y), lambda x, y: truth((x != 0) | (y != 0)), ANY),
    "condition and": (
        ca.OP_AND,
        lambda x, y: ca.logic_and(x < y, ca.logic_or(x > -2, y > 3)),
        lambda x, y: truth((x < y) & ((x > -2) | (y > 3))),
        ANY,
    ),
    "if_else": (ca.OP_IF_ELSE_ZERO, lambda x, y: ca.if_else(x < y, x, 2 * y), lambda x, y: np.where(x < y, x, 2 * y), ANY),
    "if_else zero": (ca.OP_IF_ELSE_ZERO, lambda x, y: ca.if_else(x < y, x, 0), lambda x, y: np.where(x < y, x, 0), ANY),
    "else only": (ca.OP_IF_ELSE_ZERO, lambda x, y: ca.if_else(x < y, 0, y), lambda x, y: np.where(x < y, 0, y), ANY),
    "nested if_else": (
        ca.OP_IF_ELSE_ZERO,
        lambda x, y: ca.if_else(x < 0, ca.if_else(y < 0, x * y, x), ca.if_else(y > x, y - x, -y)),
        lambda x, y: np.where(x < 0, np.where(y < 0, x * y, x), np.where(y > x, y - x, -y)),
        ANY,
    ),
    "sum of two choices": (
        ca.OP_IF_ELSE_ZERO,
        lambda x, y: ca.if_else(x < 0, x, 0) + ca.if_else(y < 0, y, 0),
        lambda x, y: np.minimum(x, 0) + np.minimum(y, 0),
        ANY,
    ),
    "the same condition twice": (
        ca.OP_IF_ELSE_ZERO,
        lambda x, y: ca.if_else(x < y, x, 0) + ca.if_else(x < y, y, 0),
        lambda x, y: np.where(x < y, x + y, 0),
        ANY,
    ),
    "fabs": (ca.OP_FABS, lambda x, y: ca.fabs(x), lambda x, y: np.abs(x), ANY),
    "sign": (ca.OP_SIGN, lambda x, y: ca.sign(x), lambda x, y: np.sign(x), ANY),
    "fmin": (ca.OP_FMIN, lambda x, y: ca.fmin(x, y), np.minimum, ANY),
    "fmax": (ca.OP_FMAX, lambda x, y: ca.fmax(x, y), np.maximum, ANY),
    "hypot": (ca.OP_HYPOT, lambda x, y: ca.hypot(x, y), np.hypot, ANY),
}


def operations(kernel):
    return {i.op for i in kernel.program.instructions}


def points(rng, low, high):
    """Random, whole numbers with ties and zeros, and small ones where cancellation shows."""
    x = np.concatenate([rng.uniform(low, high, 300), rng.integers(-3, 4, 100), 10.0 ** rng.uniform(-9, 0, 100)])
    y = np.concatenate([rng.uniform(-5, 5, 300), rng.integers(-3, 4, 100), rng.uniform(-5, 5, 100)])
    keep = (x >= low) & (x <= high)
    return x[keep], y[keep]


@pytest.mark.parametrize("backend", ["llvm", "casadi"])
@pytest.mark.parametrize("name", TABLE)
def test_operation_against_numpy(name, backend, rng):
    op, expression, formula, (low, high) = TABLE[name]
    x, y = ca.SX.sym("x"), ca.SX.sym("y")
    kernel = Kernel(name, [x, y], [expression(x, y)], backend=backend)
    assert op is None or op in operations(kernel)
    a, b = points(rng, low, high)
    with np.errstate(all="ignore"):
        expected = formula(a, b)
    usable = np.isfinite(expected)
    assert usable.sum() > 300
    # Sine, cosine and tangent keep their digits against 1, not against values near their zeros.
    loose = {"sin": 1.0, "cos": 1.0, "tan": 1 + expected[usable] ** 2}.get(name, 0.0)
    off = np.abs(kernel(a, b)[usable] - expected[usable])
    assert (off <= 2e-15 * np.abs(expected[usable]) + 5e-16 * loose).all()


@pytest.mark.skipif(np.finfo(np.longdouble).eps > 1e-18, reason="long double is double here")
@pytest.mark.parametrize(("low", "high"), [(1e-12, 1e-3), (1e-3, 7), (7, 1e3), (1e3, 1e8), (1e8, 9e14)])
def test_sine_and_cosine_of_small_and_large_angles(low, high, rng):
    x = ca.SX.sym("x")
    kernel = Kernel("sincos", [x], [ca.vertcat(ca.sin(x), ca.cos(x), ca.tan(x))], backend="llvm")
    a = 10 ** rng.uniform(np.log10(low), np.log10(high), 20000) * rng.choice([-1, 1], 20000)
    exact = a.astype(np.longdouble)
    error = np.abs(kernel(a) - np.stack([np.sin(exact), np.cos(exact), np.tan(exact)], axis=1))
    assert error[:, :2].max() < 5e-16
    assert (error[:, 0] / np.abs(np.sin(exact))).max() < 6e-16  # also beside its zeros
    assert (error[:, 2] / (1 + np.tan(exact) ** 2)).max() < 1e-15
    assert np.array_equal(kernel(np.array([0.0])), [[0.0, 1.0, 0.0]])


@pytest.mark.parametrize("name", TABLE)
def test_one_bad_row_does_not_change_the_bits_of_its_neighbours(name, rng):
    """Library functions may treat a whole SIMD vector differently if one of its lanes is odd: then this finds it."""
    _, expression, _, (low, high) = TABLE[name]
    x, y = ca.SX.sym("x"), ca.SX.sym("y")
    kernel = Kernel(name, [x, y], [ca.vertcat(expression(x, y), ca.sin(x), ca.cos(x))], backend="llvm")
    a, b = rng.uniform(low, high, (1000, kernel.lanes)), rng.uniform(-4, 4, (1000, kernel.lanes))
    clean = kernel(a.ravel(), b.ravel()).reshape(1000, kernel.lanes, 3)
    for bad in (np.nan, np.inf, -1e300, 1e17, 40.0, 5e-324, 0.0):
        a[:, 3] = bad
        dirty = kernel(a.ravel(), b.ravel()).reshape(1000, kernel.lanes, 3)
        np.testing.assert_array_equal(np.delete(dirty, 3, 1), np.delete(clean, 3, 1), err_msg=str(bad))


UNTRANSLATED = {
    "sinh": (ca.sinh, np.sinh),
    "cosh": (ca.cosh, np.cosh),
    "tanh": (ca.tanh, np.tanh),
    "erf": (ca.erf, erf),
    "log1p": (ca.log1p, np.log1p),
    "expm1": (ca.expm1, np.expm1),
    "floor": (ca.floor, np.floor),
}


@pytest.mark.parametrize("name", UNTRANSLATED)
def test_an_operation_without_translation_runs_on_the_virtual_machine(name, rng, monkeypatch):
    expression, formula = UNTRANSLATED[name]
    x = ca.SX.sym("x")
    with pytest.raises(KernelError, match=f"OP_{name.upper()}, which the llvm backend does not have"):
        Kernel(name, [x], [expression(x)], backend="llvm")
    monkeypatch.setenv("HOLDFAST_BACKEND", "llvm")
    kernel = Kernel(name, [x], [expression(x)])
    assert kernel.backend == "casadi"
    values = rng.uniform(-0.9, 5.0, 3000)
    np.testing.assert_allclose(kernel(values), formula(values), rtol=1e-14, atol=1e-15)
    assert kernel.single_row()(0.5) == pytest.approx(formula(0.5), rel=1e-14)
    assert np.isnan(kernel(np.array([0.5, np.nan]))).tolist() == [False, True]


def test_an_index_with_the_error_function_and_its_gradient(monkeypatch, rng):
    """erf(w) of the plain index w, and its slope 2 / sqrt(pi) exp(-w^2) times that of w."""
    monkeypatch.setenv("HOLDFAST_BACKEND", "llvm")
    arm = hf.arms.load("planar-3r")

    def squared(j):
        return ca.det(j @ j.T)

    plain = hf.indices.CustomIndex(squared, arm, "planar", name="plain")
    index = hf.indices.CustomIndex(lambda j: ca.erf(squared(j)), arm, "planar", name="own")
    q = rng.uniform(-2, 2, (50, arm.n))
    np.testing.assert_allclose(index.by_joint(q), erf(plain.by_joint(q)), rtol=1e-10, atol=1e-12)
    slope = 2 / np.sqrt(np.pi) * np.exp(-(plain(q) ** 2))
    np.testing.assert_allclose(index.gradient(q), slope[:, None] * plain.gradient(q), rtol=1e-8, atol=1e-10)


def test_every_row_of_the_table_has_a_test():
    tested = {row[0] for row in TABLE.values()}
    missing = {OP_NAMES[op] for op in SUPPORTED_OPERATIONS if op not in tested}
    # CasADi folds an assignment away before we see it; the others are in every test.
    assert missing == {"OP_ASSIGN", "OP_CONST", "OP_INPUT", "OP_OUTPUT"}


def test_derivatives_of_choices_take_one_side(rng):
    """|x|, min and max differentiate into sign and choices: no half values away from the kink."""
    x, y = ca.SX.sym("x"), ca.SX.sym("y")
    f = ca.fabs(x) + ca.fmin(x, y) ** 2 + ca.if_else(x > y, ca.sin(x), x * y)
    kernel = Kernel("slope", [x, y], [ca.gradient(f, x)], backend="llvm")
    a, b = rng.uniform(-3, 3, (2, 200))
    expected = np.sign(a) + np.where(a < b, 2 * a, 0) + np.where(a > b, np.cos(a), b)
    np.testing.assert_allclose(kernel(a, b), expected, rtol=1e-14, atol=1e-15)


def test_the_branch_not_taken_may_be_nan(rng):
    x = ca.SX.sym("x")
    kernel = Kernel("guarded root", [x], [ca.if_else(x > 0, ca.sqrt(x), 0.0), ca.if_else(x > 0, 1 / x, x)], backend="llvm")
    a = np.r_[rng.uniform(-2, 2, 50), 0.0]
    root, inverse = kernel(a)
    np.testing.assert_allclose(root, np.sqrt(np.maximum(a, 0)), rtol=1e-15)
    np.testing.assert_allclose(inverse, np.divide(1, a, where=a > 0, out=a.copy()), rtol=1e-15)


def test_constants_keep_every_bit(rng):
    values = [0.1, 1 / 3, np.pi, 1e-17, 5e-324, 1.7976931348623157e308, -1e-300, *rng.normal(size=5)]
    x = ca.SX.sym("x")
    for backend in ("llvm", "casadi"):
        np.testing.assert_array_equal(Kernel("constants", [x], [ca.vertcat(*values)], backend=backend)(0.0), values)
