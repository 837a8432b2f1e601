"""Program -> heyoka compiled function: LLVM JIT, SIMD over rows of the batch."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.errors import KernelError
from holdfast.kernels.program import OP_NAMES, Program
from holdfast.kernels.trigonometry import sincos

_ARITHMETIC = {
    getattr(ca, f"OP_{name}")
    for name in (
        *(
            "CONST",
            "INPUT",
            "OUTPUT",
            "ASSIGN",
            "ADD",
            "SUB",
            "MUL",
            "DIV",
            "NEG",
            "SQ",
            "TWICE",
            "INV",
            "SQRT",
            "FABS",
            "SIGN",
        ),
        *("SIGN", "SIN", "COS", "TAN", "LT", "LE", "EQ", "NE", "NOT", "AND", "OR", "IF_ELSE_ZERO", "FMIN", "FMAX", "HYPOT"),
    )
}


def available() -> bool:
    """True if heyoka can be imported on this machine."""
    try:
        import heyoka  # noqa: F401
    except ImportError:
        return False
    return True


def simd_lanes() -> int:
    """Rows handled at once: two SIMD registers, which hides the latency of divisions and roots (measured: +18 %)."""
    import heyoka as hy

    hy.set_nthreads(1)  # process-wide: our own pool of threads calls single-threaded kernels
    return 2 * int(hy.recommended_simd_size())


def _table() -> dict[int, Callable[..., Any]]:
    import heyoka as hy

    zero, one = hy.expression(0.0), hy.expression(1.0)
    return {
        ca.OP_ASSIGN: lambda a: a,
        ca.OP_ADD: operator.add,
        ca.OP_SUB: operator.sub,
        ca.OP_MUL: operator.mul,
        ca.OP_DIV: operator.truediv,
        ca.OP_NEG: operator.neg,
        ca.OP_EXP: hy.exp,
        ca.OP_LOG: hy.log,
        ca.OP_POW: operator.pow,
        ca.OP_CONSTPOW: operator.pow,
        ca.OP_SQRT: hy.sqrt,
        ca.OP_SQ: lambda a: a * a,
        ca.OP_TWICE: lambda a: a + a,
        ca.OP_ASIN: hy.asin,
        ca.OP_ACOS: hy.acos,
        ca.OP_ATAN: hy.atan,
        ca.OP_ATAN2: hy.atan2,
        ca.OP_INV: lambda a: one / a,
        ca.OP_LT: hy.lt,
        ca.OP_LE: hy.lte,
        ca.OP_EQ: hy.eq,
        ca.OP_NE: hy.neq,
        ca.OP_NOT: lambda a: hy.eq(a, zero),
        ca.OP_AND: lambda a, b: hy.logical_and([a, b]),
        ca.OP_OR: lambda a, b: hy.logical_or([a, b]),
        ca.OP_IF_ELSE_ZERO: lambda c, a: hy.select(c, a, zero),
        # CasADi differentiates |x| into sign(x); both are exact for every finite x, and the guard handles NaN.
        ca.OP_FABS: lambda a: hy.select(hy.lt(a, zero), -a, a),
        ca.OP_SIGN: lambda a: hy.select(hy.gt(a, zero), one, hy.select(hy.lt(a, zero), -one, zero)),
        ca.OP_FMIN: lambda a, b: hy.select(hy.lte(a, b), a, b),
        ca.OP_FMAX: lambda a, b: hy.select(hy.gte(a, b), a, b),
        ca.OP_SINH: hy.sinh,
        ca.OP_COSH: hy.cosh,
        ca.OP_TANH: hy.tanh,
        ca.OP_ERF: hy.erf,
        ca.OP_LOG1P: hy.log1p,
        ca.OP_EXPM1: hy.expm1,
        ca.OP_HYPOT: lambda a, b: hy.sqrt(a * a + b * b),
    }


def same_for_one_row(program: Program) -> bool:
    """True if heyoka's code for one row, without SIMD, gives the same bits: other functions come from another library there."""
    return all(row.op in _ARITHMETIC for row in program.instructions)


def compile_program(program: Program) -> Any:
    """Compile to a heyoka ``cfunc`` over ``(n_in, lanes * k)`` arrays.

    Raises:
        KernelError: The program uses an operation that has no row in the table; the message names it.
    """
    import heyoka as hy

    table = _table()
    names = [f"x{i:04d}" for i in range(program.n_in)]
    x = [hy.expression(name) for name in names]
    work: dict[int, Any] = {}
    outputs: list[Any] = [None] * program.n_out
    # A NaN in any input must reach every output, also where the expression ignores that input.
    total = x[0]
    for term in x[1:]:
        total = total + term
    guard = total - total
    choices: dict[int, tuple[Any, Any]] = {}  # id of "condition ? value : 0" -> condition, value
    negations: dict[int, Any] = {}  # id of "not condition" -> condition
    alive: list[Any] = []  # ids stay unique while their objects live
    angles: dict[int, tuple[Any, Any]] = {}  # id of x -> sin x, cos x
    divisors = program.shared_divisors()
    reciprocals: dict[int, Any] = {}
    one = hy.expression(1.0)
    for k, row in enumerate(program.instructions):
        if row.op == ca.OP_CONST:
            work[row.output] = hy.expression(row.constant)
            continue
        if row.op == ca.OP_INPUT:
            work[row.output] = x[row.inputs[0]]
            continue
        if row.op == ca.OP_OUTPUT:
            outputs[row.output] = work[row.inputs[0]] + guard
            continue
        arguments = [work[i] for i in row.inputs]
        result = None
        if k in divisors:
            # CasADi writes x (1/y) as x / y. One division serves all; "+ guard" keeps heyoka from undoing this.
            if divisors[k] not in reciprocals:
                reciprocals[divisors[k]] = one / arguments[-1] + guard
            shared = reciprocals[divisors[k]]
            result = shared if row.op == ca.OP_INV else arguments[0] * shared
        elif row.op in (ca.OP_SIN, ca.OP_COS, ca.OP_TAN):
            if id(arguments[0]) not in angles:
                angles[id(arguments[0])] = sincos(arguments[0], guard)
                alive.append(arguments[0])
            sine, cosine = angles[id(arguments[0])]
            result = {ca.OP_SIN: sine, ca.OP_COS: cosine}.get(row.op)
            if result is None:
                result = sine / cosine
        elif row.op == ca.OP_ADD:
            result = _choice(choices, negations, *arguments)
        if result is None:
            function = table.get(row.op)
            if function is None:
                raise KernelError(
                    f"kernel '{program.name}': instruction {k} is CasADi operation {OP_NAMES[row.op]}, which the heyoka "
                    "backend does not have; write the expression with operations listed in docs/extending"
                )
            result = function(*arguments)
        if row.op == ca.OP_IF_ELSE_ZERO:
            choices[id(result)] = arguments[0], arguments[1]
        elif row.op == ca.OP_NOT:
            negations[id(result)] = arguments[0]
        alive.append(result)
        work[row.output] = result
    return hy.cfunc(outputs, vars=x, batch_size=simd_lanes())


def _choice(choices: dict[int, tuple[Any, Any]], negations: dict[int, Any], x: Any, y: Any) -> Any | None:
    """CasADi writes ``c ? a : b`` as ``(c ? a : 0) + (!c ? b : 0)``; one select instead of four operations."""
    import heyoka as hy

    if id(x) not in choices or id(y) not in choices:
        return None
    (c, a), (d, b) = choices[id(x)], choices[id(y)]
    if negations.get(id(d)) is c:
        return hy.select(c, a, b)
    if negations.get(id(c)) is d:
        return hy.select(d, b, a)
    return None


def call(compiled: Any, inputs: NDArray[np.float64], outputs: NDArray[np.float64]) -> None:
    """Evaluate columns of contiguous ``inputs (n_in, W)`` into ``outputs (n_out, W)``; W a multiple of the lanes."""
    compiled(inputs, outputs)
