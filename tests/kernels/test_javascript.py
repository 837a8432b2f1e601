"""Printed programs, run by Node, against numpy, the CasADi virtual machine and compiled code."""

from __future__ import annotations

import re
import shutil
from importlib import import_module

import casadi as ca
import numpy as np
import pytest

import javascript as browser
from holdfast.core.errors import KernelError
from holdfast.kernels import Kernel, Program
from holdfast.kernels.graph import OP_CONST, OP_INPUT, OP_OUTPUT, OP_SELECT
from holdfast.kernels.javascript_backend import write_javascript
from holdfast.kernels.program import OP_NAMES

printer = import_module("holdfast.kernels.javascript_backend")
expressions = import_module("holdfast.kernels.javascript.expressions")

# Exact in every language: an expression of these alone has one right result, bit for bit.
EXACT = {
    ca.OP_ADD: lambda x, y: x + y,
    ca.OP_SUB: lambda x, y: x - y,
    ca.OP_MUL: lambda x, y: x * y,
    ca.OP_NEG: lambda x, y: -x,
    ca.OP_SQ: lambda x, y: x * x,
    ca.OP_TWICE: lambda x, y: x + x,
    ca.OP_SQRT: lambda x, y: ca.sqrt(ca.fabs(x)),
    ca.OP_FABS: lambda x, y: ca.fabs(x),
    ca.OP_SIGN: lambda x, y: ca.sign(x),
    ca.OP_FMIN: lambda x, y: ca.fmin(x, y),
    ca.OP_FMAX: lambda x, y: ca.fmax(x, y),
    ca.OP_LT: lambda x, y: x < y,
    ca.OP_LE: lambda x, y: x <= y,
    ca.OP_EQ: lambda x, y: x == y,
    ca.OP_NE: lambda x, y: x != y,
    ca.OP_NOT: lambda x, y: ca.logic_not(x),
    ca.OP_AND: lambda x, y: ca.logic_and(x, y),
    ca.OP_OR: lambda x, y: ca.logic_or(x, y),
    ca.OP_IF_ELSE_ZERO: lambda x, y: ca.if_else(x < y, x, 0),
    OP_SELECT: lambda x, y: ca.if_else(x < y, y, x - 1),
}
ROUNDED = {
    ca.OP_DIV: lambda x, y: x / y,
    ca.OP_INV: lambda x, y: 1 / x,
    ca.OP_EXP: lambda x, y: ca.exp(x),
    ca.OP_LOG: lambda x, y: ca.log(x),
    ca.OP_POW: lambda x, y: ca.power(x, y),
    ca.OP_CONSTPOW: lambda x, y: ca.constpow(x, 2.3),
    ca.OP_SIN: lambda x, y: ca.sin(x),
    ca.OP_COS: lambda x, y: ca.cos(x),
    ca.OP_TAN: lambda x, y: ca.tan(x),
    ca.OP_ASIN: lambda x, y: ca.asin(x),
    ca.OP_ACOS: lambda x, y: ca.acos(x),
    ca.OP_ATAN: lambda x, y: ca.atan(x),
    ca.OP_ATAN2: lambda x, y: ca.atan2(x, y),
    ca.OP_SINH: lambda x, y: ca.sinh(x),
    ca.OP_COSH: lambda x, y: ca.cosh(x),
    ca.OP_TANH: lambda x, y: ca.tanh(x),
    ca.OP_LOG1P: lambda x, y: ca.log1p(x),
    ca.OP_EXPM1: lambda x, y: ca.expm1(x),
    ca.OP_HYPOT: lambda x, y: ca.hypot(x, y),
}
EVERY = {**EXACT, **ROUNDED}


def test_every_row_of_the_table_is_tested():
    assert set(expressions.JAVASCRIPT_FORMS) == set(EVERY)


def in_node(inputs, outputs, rows):
    program = Program("test", inputs, outputs)
    return browser.rows(write_javascript(program, "f"), "f", rows, program.n_out)


def forms(program):
    graph = expressions.NamedGraph()
    graph.add_program(program, "JavaScript", expressions.JAVASCRIPT_FORMS, guarded=True)
    return {graph.nodes[k].op for k in graph.needed}


@pytest.mark.parametrize("seed", range(4))
def test_random_expressions_of_exact_operations_have_the_bits_of_the_virtual_machine(seed, rng):
    x = ca.SX.sym("x", 4)
    values = ca.vertsplit(x)
    for _ in range(60 * (seed + 1)):
        a, b = (values[k] for k in rng.integers(0, len(values), 2))
        b = b if rng.random() < 0.9 else ca.SX(rng.choice([0.0, 1.0, -2.0, 1 / 3, 1e-17]))
        values.append(EXACT[int(rng.choice(list(EXACT)))](a, b) * rng.choice([1, 1, 0.5, -1]))
    out = ca.vertcat(*values[-30:])
    points = np.vstack([rng.normal(size=(400, 4)), rng.integers(-2, 3, (400, 4))]).astype(float)
    found = in_node([x], [out], points)
    kernel = Kernel("test", [x], [out], backend="casadi")
    # Inside, a product may overflow and make NaN, which one virtual machine takes for true and the other for false.
    fine = np.isfinite(found).all(axis=1)
    assert fine.mean() > 0.3
    np.testing.assert_array_equal(found[fine], kernel.rows(points)[fine])


@pytest.mark.parametrize("seed", range(2))
def test_random_expressions_of_all_operations(seed, rng):
    """Everything is kept between -1 and 1, so that rounding stays small; conditions are rarely near a tie."""
    x = ca.SX.sym("x", 5)
    values = ca.vertsplit(x)
    every = [op for op in EVERY for _ in range(4)]
    rng.shuffle(every)
    for op in every:
        a, b = (values[k] for k in rng.integers(max(0, len(values) - 12), len(values), 2))
        if op in (ca.OP_LOG, ca.OP_LOG1P, ca.OP_POW, ca.OP_CONSTPOW, ca.OP_DIV, ca.OP_INV):
            a, b = a * a + 0.5, b * b + 0.5
        values.append(ca.sin(EVERY[op](a, b) + 0.1 * values[rng.integers(5)]))
    out = ca.vertcat(*values[-40:])
    program = Program("all", [x], [out])
    assert len(forms(program) - {OP_INPUT, OP_CONST, OP_OUTPUT}) > 20
    points = rng.uniform(-1, 1, (300, 5))
    found = in_node([x], [out], points)
    for backend in ("casadi", None):  # None: compiled code, or the virtual machine for operations that it lacks
        off = np.abs(found - Kernel("all", [x], [out], backend=backend).rows(points)).max(axis=1)
        assert np.mean(off < 1e-9) > 0.99, (backend, np.sort(off)[-5:])  # the rest passed a tie on another side
        assert np.median(off) < 1e-13


SPECIAL = np.array([[0, 1], [0, -1], [1, 0], [-1, 0], [0, 0], [1, 1], [-1, 1], [5, 2], [-3, 4], [1e-3, 1], [1e200, 1e-200]])


@pytest.mark.parametrize("op", EVERY, ids=lambda op: OP_NAMES.get(op, "select"))
def test_nan_infinity_and_zeros_inside_an_expression_are_those_of_compiled_code(op):
    """Finite inputs; their quotients are NaN, infinite, or a zero of either sign."""
    x = ca.SX.sym("x", 4)
    a, b = x[0] / x[1], x[2] / x[3]
    value = EVERY[op](a, b)
    out = ca.vertcat(value, ca.if_else(value, 2, 3), ca.if_else(a < b, value, x[0]))
    grid = np.array([np.r_[p, q] for p in SPECIAL for q in SPECIAL], dtype=float)
    found, expected = in_node([x], [out], grid), Kernel("special", [x], [out]).rows(grid)
    with np.errstate(all="ignore"):
        beyond = (op in (ca.OP_SIN, ca.OP_COS, ca.OP_TAN)) & (np.abs(grid[:, 0] / grid[:, 1]) > 1e15)
    np.testing.assert_array_equal(np.isnan(found), np.isnan(expected))
    assert not np.any(beyond) or np.isnan(found[beyond, 0]).all()
    finite = np.isfinite(expected)
    np.testing.assert_array_equal(found[~finite & ~np.isnan(expected)], expected[~finite & ~np.isnan(expected)])
    np.testing.assert_allclose(found[finite], expected[finite], rtol=3e-15, atol=3e-16)


def test_nan_or_infinity_in_an_input_makes_every_output_nan(rng):
    x = ca.SX.sym("x", 3)
    outputs = [x[0] * 2, ca.SX(1.5), ca.if_else(x[1] > 0, x[0], 1)]  # the third input is in none of them
    points = rng.normal(size=(60, 3))
    bad = rng.random((60, 3)) < 0.2
    points[bad] = rng.choice([np.nan, np.inf, -np.inf], bad.sum())
    found = in_node([x], [ca.vertcat(*outputs)], points)
    np.testing.assert_array_equal(np.isnan(found), np.repeat(bad.any(axis=1)[:, None], 3, axis=1))
    np.testing.assert_array_equal(found, Kernel("guard", [x], [ca.vertcat(*outputs)]).rows(points))


def test_constants_keep_every_bit(rng):
    """Infinite and undefined ones, and signs of zero seen through a quotient, too."""
    values = [0.1, 1 / 3, -np.pi, 1e-17, 5e-324, 1.7976931348623157e308, -1e-300, 1e15, 1e16, -7.0, 2.0**53, np.inf, -np.inf]
    values += [np.nan, 0.0, *rng.normal(size=5), *10 ** rng.uniform(-300, 300, 20)]
    x = ca.SX.sym("x")
    found = in_node([x], [ca.vertcat(*values)], np.zeros((1, 1)))[0]
    np.testing.assert_array_equal(found, values)
    assert expressions._number_and_binding(-0.0) == ("-0", expressions._BINDS_SUM)
    signs = in_node([x], [ca.vertcat(x - ca.SX(-2.0), x + ca.SX(-3.0), -2.0 * (-x), -(-2.0 - x))], np.array([[1.0]]))
    np.testing.assert_array_equal(signs, [[3.0, -2.0, 2.0, 3.0]])


@pytest.mark.parametrize("piece", [1, 7, 60, 10**9])
def test_no_bit_depends_on_how_a_program_is_split(piece, monkeypatch, rng):
    x = ca.SX.sym("x", 4)
    values = ca.vertsplit(x)
    for _ in range(400):
        a, b = (values[k] for k in rng.integers(0, len(values), 2))
        values.append(EVERY[int(rng.choice(list(EVERY)))](a, b) * 0.5)
    out = ca.vertcat(*values[-50:])
    points = rng.normal(size=(200, 4))
    whole = in_node([x], [out], points)
    monkeypatch.setattr(printer, "_OPERATIONS_PER_FUNCTION", piece)
    monkeypatch.setattr(expressions, "_OPERATIONS_PER_EXPRESSION", min(piece, 60))
    text = write_javascript(Program("test", [x], [out]), "f")
    count = len(re.findall(r"^function p", text, re.MULTILINE))
    assert count == 1 if piece > 1000 else count > 3
    np.testing.assert_array_equal(browser.rows(text, "f", points, 50), whole)


def test_matrices_are_read_and_written_row_by_row(rng):
    a, b = ca.SX.sym("a", 2, 3), ca.SX.sym("b", 3)
    points = rng.normal(size=(20, 9))
    found = in_node([a, b], [a.T, a @ b], points)
    for row, out in zip(points, found, strict=True):
        m = row[:6].reshape(2, 3)
        np.testing.assert_allclose(out, np.r_[m.T.ravel(), m @ row[6:]], rtol=1e-14, atol=1e-15)


@pytest.mark.parametrize(("expression", "name"), [(ca.floor, "OP_FLOOR"), (ca.erf, "OP_ERF"), (ca.asinh, "OP_ASINH")])
def test_an_unknown_operation_is_named(expression, name):
    x = ca.SX.sym("x")
    with pytest.raises(KernelError, match=f"'odd'.*{name}.*JavaScript"):
        write_javascript(Program("odd", [x], [expression(x)]), "f")


WORDS = """
const function return new Float64Array Uint32Array buffer fill NaN Infinity e exponential logarithm sine cosine tangent power
arcsine arccosine arctangent bits words high low highWord lowWord joinWords turn turnTo
Math abs sqrt sinh cosh tanh log1p expm1
"""


def test_the_text_needs_nothing_and_makes_nothing():
    x = ca.SX.sym("x", 3)
    values = [f(ca.sin(x[0]), x[1]) for f in EVERY.values()]
    text = write_javascript(Program("every", [x], values), "f")
    arrays = re.findall(r"^const (?:\w+=new \w+\([\w.]+\)(?:\.fill\(NaN\))?[,;])+$", text, re.MULTILINE)
    assert len(arrays) == 3
    assert text.count("new ") == sum(line.count("new ") for line in arrays)
    words = set(re.findall(r"[A-Za-z_$][\w$]*[A-Za-z_$][\w$]*", text.split('"use strict";')[1]))
    assert words <= set(re.findall(r"\w+", WORDS)), words


def test_without_node_the_tests_fail_with_a_sentence(monkeypatch):
    monkeypatch.setattr(shutil, "which", lambda _: None)
    with pytest.raises(AssertionError, match="need Node 20 or newer"):
        browser.node()
