"""Exponential, logarithm, powers, arcs: against Arb's balls of 120 bits, and at what is special."""

from __future__ import annotations

import math

import casadi as ca
import numpy as np
import pytest
from flint import arb, ctx

from holdfast.kernels import Kernel, Program
from holdfast.kernels.llvm.arithmetic import TargetMachine
from holdfast.kernels.llvm.machine_code import MachineCode, compile_program, detect_processor

MACHINES = [pytest.param(True, id="fused"), pytest.param(False, id="unfused")]


COUNT = 400  # draws of each kind; with 100,000 the limits hold as well


def either_sign(rng, low, high, count):
    return 10 ** rng.uniform(low, high, count) * rng.choice([-1.0, 1.0], count)


def reals(rng, count):
    return np.r_[rng.uniform(-745, 709.7, count), rng.uniform(-2, 2, count), either_sign(rng, -300, 2, count)]


def positive(rng, count):
    near = 1 + either_sign(rng, -16, -1, count)
    return np.r_[10 ** rng.uniform(-323, 308, count), rng.uniform(0.3, 3, count), near]


def sines(rng, count):
    return np.clip(
        np.r_[rng.uniform(-1, 1, 2 * count), either_sign(rng, -300, 0, count), 1 - 10 ** rng.uniform(-16, -1, count)], -1, 1
    )


# CasADi's function, Arb's, where to look, and the largest error with and without fused multiply-add, units in the last place
ONE = {
    "exp": (ca.exp, lambda x: x.exp(), reals, 0.9, 0.9),
    "log": (ca.log, lambda x: x.log(), positive, 0.85, 0.85),
    "asin": (ca.asin, lambda x: x.asin(), sines, 0.75, 0.75),
    "acos": (ca.acos, lambda x: x.acos(), sines, 0.75, 0.75),
    "atan": (ca.atan, lambda x: x.atan(), lambda rng, n: either_sign(rng, -300, 300, 3 * n), 0.8, 0.8),
    "near atan": (ca.atan, lambda x: x.atan(), lambda rng, n: rng.uniform(-4, 4, 4 * n), 0.8, 0.8),
}


def angle(y, x):
    return arb.atan2(arb(y), arb(x))


def pairs(rng, count):
    far = either_sign(rng, -320, 300, count), either_sign(rng, -320, 300, count)
    near = rng.normal(size=(2, 3 * count))
    tiny = either_sign(rng, -323, -300, count), either_sign(rng, -290, 0, count)  # fewer digits, and not in the quotient
    return np.r_[far[0], near[0], tiny[0]], np.r_[far[1], near[1], tiny[1]]


def bases(rng, count):
    """Bases and exponents whose power is a normal number."""
    x = positive(rng, count)
    y = rng.uniform(-700, 700, len(x)) / np.where(x == 1, 1, np.log(x))
    y[::3] = np.round(rng.uniform(-8, 8, len(y[::3])) * 2) / 2
    keep = (np.abs(y * np.log(x)) < 700) & (np.abs(y) < 1e300)
    return x[keep], y[keep]


TWO = {
    "atan2": (ca.atan2, angle, pairs, 0.99, 0.99),
    "pow": (ca.power, lambda x, y: arb(x) ** arb(y), bases, 0.9, 0.9),
}


def columns(function, fused, *rows, lanes=None):
    """The function of a program on a machine with or without fused multiply-add."""
    symbols = [ca.SX.sym("x"), ca.SX.sym("y")][: len(rows)]
    machine = TargetMachine(lanes or detect_processor().machine.lanes, fused)
    if fused and not detect_processor().machine.fused:
        pytest.skip("this processor has no fused multiply-add")
    code = MachineCode(compile_program(Program("function", symbols, [function(*symbols)]), 0, machine))
    width = -(-len(rows[0]) // machine.lanes) * machine.lanes
    inputs, outputs = np.ones((len(rows), width)), np.empty((1, width))
    inputs[:, : len(rows[0])] = rows
    code.call(inputs.ctypes.data, outputs.ctypes.data, width, width)
    return outputs[0, : len(rows[0])]


def errors(found, exact):
    """In units in the last place of the exact values."""
    return np.array(
        [abs(float(((arb(y) - x) / math.ulp(float(x.mid()))).mid())) for y, x in zip(found.tolist(), exact, strict=True)]
    )


@pytest.fixture(autouse=True)
def precise():
    ctx.prec = 160
    yield
    ctx.prec = 53


@pytest.mark.parametrize("fused", MACHINES)
@pytest.mark.parametrize("name", ONE)
def test_error_of_functions_of_one_number(name, fused, rng):
    function, exactly, draw, limit, unfused_limit = ONE[name]
    x = draw(rng, COUNT)
    error = errors(columns(function, fused, x), [exactly(arb(v)) for v in x.tolist()])
    worst = error.argmax()
    assert error[worst] < (limit if fused else unfused_limit), (x[worst], error[worst])


@pytest.mark.parametrize("fused", MACHINES)
@pytest.mark.parametrize("name", TWO)
def test_error_of_functions_of_two_numbers(name, fused, rng):
    function, exactly, draw, limit, unfused_limit = TWO[name]
    x, y = draw(rng, COUNT)
    error = errors(columns(function, fused, x, y), [exactly(a, b) for a, b in zip(x.tolist(), y.tolist(), strict=True)])
    worst = error.argmax()
    assert error[worst] < (limit if fused else unfused_limit), (x[worst], y[worst], error[worst])


# ---- what is special -----------------------------------------------------------------------------------------------

SPECIAL = np.array(
    [np.inf, -np.inf, np.nan, 0.0, -0.0, 5e-324, -5e-324, 1e-310, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0, 0.5, -0.5, 0.3]
)
SPECIAL = np.r_[SPECIAL, 1e308, -1e308, 2.0**53, -(2.0**53) + 1, 710.0, -746.0, 1 + 2.0**-52, 1 - 2.0**-53]
NUMPY = {"exp": np.exp, "log": np.log, "asin": np.arcsin, "acos": np.arccos, "atan": np.arctan}
NUMPY |= {"atan2": np.arctan2, "pow": np.power}


def any_number(x, kind):
    """A symbol that may be infinite or no number, although inputs may not."""
    for value, code in ((ca.SX.inf(), 1), (-ca.SX.inf(), 2), (ca.SX.nan(), 3)):
        x = ca.if_else(kind == code, value, x)
    return x


def coded(values):
    kind = np.select([np.isposinf(values), np.isneginf(values), np.isnan(values)], [1.0, 2.0, 3.0], 0.0)
    return np.where(kind > 0, 1.0, values), kind


@pytest.mark.parametrize("name", NUMPY)
def test_special_values_are_those_of_the_c_library(name):
    two = name in TWO
    function = (TWO if two else ONE)[name][0]
    x, y = (v.ravel() for v in np.meshgrid(SPECIAL, SPECIAL if two else [0.0]))
    symbols = [ca.SX.sym(s) for s in "xkym"]
    given = [any_number(*symbols[:2]), any_number(*symbols[2:])][: 1 + two]
    value = function(*given)
    kernel = Kernel(name, symbols, [ca.vertcat(value, 1 / value)], backend="llvm")  # an output has no sign of zero
    found, inverse = kernel(*coded(x), *coded(y)).T
    with np.errstate(all="ignore"):
        expected = NUMPY[name](*[x, y][: 1 + two])
    np.testing.assert_allclose(found, expected, rtol=3e-15, atol=5e-324)
    zero = expected == 0
    np.testing.assert_array_equal(np.signbit(inverse[zero]), np.signbit(expected[zero]))


def test_one_lane_and_many_give_the_same_bits(rng):
    """What a graphics processor computes row by row is what the processor computes by lanes."""
    x, y = rng.uniform(0.1, 0.9, (2, 64))
    for name, (function, *_) in (ONE | TWO).items():
        rows = [x, y][: 1 + (name in TWO)]
        many = columns(function, detect_processor().machine.fused, *rows)
        np.testing.assert_array_equal(columns(function, detect_processor().machine.fused, *rows, lanes=1), many, err_msg=name)
