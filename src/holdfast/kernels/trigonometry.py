"""Sine and cosine together, without branches, as LLVM instructions.

A library's functions switch to another method for very large angles, and a vector library's do so for a whole group of rows
when one of them is large, infinite or NaN: its neighbours then differ in the last digit. These do the same operations in
every lane, and give sine and cosine for little more than the price of one (measured: the worst-case index of the 9-joint
PA10 gains 15 to 20 %).

Source: reduction by pi split in three parts (W. J. Cody, W. Waite 1980), polynomials of fdlibm (``k_sin.c``, ``k_cos.c``)
at half the angle, then the formulas of the double angle. Largest absolute error 4.5e-16 for ``|x| <= 1e15`` (measured).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from holdfast.kernels.llvm_ir import Arithmetic

# pi in three parts; the first two have zeros at their end, so that products with whole numbers are exact.
_PI = (2 * 1.57079632673412561417e00, 2 * 6.07710050630396597660e-11, 2 * 2.02226624879595063154e-21)
_SINE = (
    1.58969099521155010221e-10,
    -2.50507602534068634195e-08,
    2.75573137070700676789e-06,
    -1.98412698298579493134e-04,
    8.33333333332248946124e-03,
    -1.66666666666666324348e-01,
)
_COSINE = (
    -1.13596475577881948265e-11,
    2.08757232129817482790e-09,
    -2.75573143513906633035e-07,
    2.48015872894767294178e-05,
    -1.38888888888741095749e-03,
    4.16666666666666019037e-02,
)
_ROUND = 6755399441055744.0  # 1.5 * 2^52: adding and taking it away rounds to a whole number
_LARGEST = 1e15


def sincos(e: Arithmetic, x: str) -> tuple[str, str]:
    """Sine and cosine of ``x``, rad; NaN beyond 1e15, where an angle in double precision means nothing.

    Args:
        e: Where the instructions go.
        x: Name of the angle.
    """
    x = e.select(e.less(e.mul(x, x), e.number(_LARGEST**2)), x, e.number(float("nan")))
    shift = e.number(_ROUND)
    turns = e.sub(e.fma(x, e.number(0.31830988618379067154), shift), shift)  # nearest whole number of x / pi
    reduced = x
    for part in _PI:
        reduced = e.fma(turns, e.number(-part), reduced)
    half = e.mul(e.number(0.5), reduced)
    square = e.mul(half, half)
    sine = e.fma(half, e.mul(square, _polynomial(e, _SINE, square)), half)
    cosine = e.fma(e.mul(square, square), _polynomial(e, _COSINE, square), e.fma(e.number(-0.5), square, e.number(1.0)))
    pairs = e.sub(e.fma(turns, e.number(0.5), shift), shift)
    odd = e.fma(pairs, e.number(-2.0), turns)  # -1, 0 or 1
    sign = e.fma(e.mul(odd, odd), e.number(-2.0), e.number(1.0))
    return e.mul(sign, e.mul(e.add(sine, sine), cosine)), e.mul(sign, e.mul(e.sub(cosine, sine), e.add(cosine, sine)))


def _polynomial(e: Arithmetic, coefficients: tuple[float, ...], x: str) -> str:
    value = e.number(coefficients[0])
    for c in coefficients[1:]:
        value = e.fma(value, x, e.number(c))
    return value
