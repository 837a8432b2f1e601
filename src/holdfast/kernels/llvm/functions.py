"""Exponential, logarithm, powers, and related functions as LLVM instructions without branches, with the same bits on every
machine.

No library function is called, because a C library, a graphics processor and the lanes of a batch could round differently. The
results depend on the machine only by whether it has fused multiply-add. Largest errors, measured against exact values, in units
in the last place: exp 0.83, log 0.79, pow 0.86, asin 0.65, acos 0.68, atan 0.75, atan2 0.94.
``tests/kernels/test_kernel_functions.py`` checks limits on these errors and compares special values.

Source: reductions and polynomials of fdlibm (Sun Microsystems 1993, 2004; ``e_exp.c``, ``e_log.c``, ``e_pow.c``, ``s_atan.c``,
``e_asin.c``), whose branches are choices here; the rounding error of a quotient or product is carried along as in
T. J. Dekker, "A floating-point technique for extending the available precision" (1971).
"""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca

from holdfast.kernels.llvm.arithmetic import BITS_OF_ONE, ROUNDING_SHIFT, Arithmetic, emit_polynomial


def _read_coefficients(text: str) -> tuple[float, ...]:
    return tuple(map(float, text.split()))


# Coefficients, highest degree first.
# _LN2_HIGH and _LN2_LOW: the first ends in zeros, so that 2000 times it is exact
_LN2_HIGH = 6.93147180369123816490e-01
_LN2_LOW = 1.90821492927058770002e-10
_QUARTER_TURN = 1.57079632679489655800e00, 6.12323399573676603587e-17  # pi/2 in two parts, as all pairs here
_ATAN_OF_HALF = 4.63647609000806093515e-01, 2.26987774529616870924e-17
_EXP_COEFFICIENTS = _read_coefficients(
    "4.1381367970572385e-08 -1.6533902205465252e-06 6.613756321437934e-05 -0.0027777777777015593 0.16666666666666602"
)
_LOG_COEFFICIENTS = _read_coefficients(
    "0.14798198605116586 0.15313837699209373 0.1818357216161805 0.22222198432149784 0.2857142874366239 0.3999999999940942 "
    "0.6666666666666735"
)
_LOG_OF_POW = _read_coefficients(
    "0.20697501780033842 0.23066074577556175 0.272728123808534 0.33333332981837743 0.4285714285785502 0.5999999999999946"
)
_ATAN_COEFFICIENTS = _read_coefficients(
    "0.016285820115365782 -0.036531572744216916 0.049768779946159324 -0.058335701337905735 0.06661073137387531 "
    "-0.0769187620504483 0.09090887133436507 -0.11111110405462356 0.14285714272503466 -0.19999999999876483 0.3333333333333293"
)
_ASIN_NUMERATOR = _read_coefficients(
    "3.479331075960212e-05 0.0007915349942898145 -0.04005553450067941 0.20121253213486293 -0.3255658186224009 "
    "0.16666666666666666"
)
_ASIN_DENOMINATOR = _read_coefficients("0.07703815055590194 -0.6882839716054533 2.0209457602335057 -2.403394911734414 1.0")
_RANGE_CENTERS = (  # centres of the thirds of a range, with their logarithms in two parts
    (1.5, 0.75, 1.0),
    (0.4054651081081644, -0.2876820724517809, 0.0),
    (-2.8811380259626426e-18, -2.607160616442564e-17, 0.0),
)
_INFINITY = float("inf")
_NOT_A_NUMBER = float("nan")
# _MANTISSA_BITS and _BITS_OF_ROOT_HALF: bits
_MANTISSA_BITS = (1 << 52) - 1
_BITS_OF_ROOT_HALF = 0x3FE6A09E << 32


# ---- exponential ---------------------------------------------------------------------------------------------------


def _power_of_2(e: Arithmetic, k: str) -> str:
    """Return 2^k for a whole number k, -1022 <= k <= 1023."""
    return e.from_bits(e.integer_operation("shl", e.to_bits(e.add(k, e.constant(ROUNDING_SHIFT + 1023))), 52))


def _scale_by_power(e: Arithmetic, x: str, k: str) -> str:
    """Return the product of x and 2^k, |k| < 2040, rounded once, also where the result has fewer digits."""
    half = e.sub(e.fma(k, e.constant(0.5), e.constant(ROUNDING_SHIFT)), e.constant(ROUNDING_SHIFT))
    return e.mul(e.mul(x, _power_of_2(e, half)), _power_of_2(e, e.sub(k, half)))


def _reduce_exp_argument(e: Arithmetic, x: str, correction: str | None = None) -> tuple[str, str, str]:
    """Return the k, a and b of ``exp(x + rest) = 2^k (1 + a + b)``, |b| small against a; x is taken from -746 to 720."""
    upper, lower = e.constant(720.0), e.constant(-746.0)
    x = e.select(e.compare("ogt", x, upper), upper, e.select(e.compare_less(x, lower), lower, x))
    shift = e.constant(ROUNDING_SHIFT)
    k = e.sub(e.fma(x, e.constant(1.44269504088896338700), shift), shift)
    a = e.fma(k, e.constant(-_LN2_HIGH), x)
    below = e.mul(k, e.constant(_LN2_LOW))
    if correction is not None:
        below = e.sub(below, correction)
    r = e.sub(a, below)
    square = e.mul(r, r)
    c = e.fma(e.negate(square), emit_polynomial(e, _EXP_COEFFICIENTS, square), r)
    return k, a, e.sub(e.binary("fdiv", e.mul(r, c), e.sub(e.constant(2.0), c)), below)


def _emit_exp(e: Arithmetic, x: str, correction: str | None = None) -> str:
    k, a, b = _reduce_exp_argument(e, x, correction)
    return _scale_by_power(e, e.add(e.constant(1.0), e.add(a, b)), k)


# ---- logarithm -----------------------------------------------------------------------------------------------------


def _split_exponent(e: Arithmetic, x: str) -> tuple[str, str]:
    """Return the k and m of x = 2^k m, m from the root of 1/2 to that of 2, of a positive finite x."""
    small = e.compare_less(x, e.constant(2.0**-1022))
    x = e.select(small, e.mul(x, e.constant(2.0**54)), x)
    shifted = e.integer_operation("add", e.to_bits(x), BITS_OF_ONE - _BITS_OF_ROOT_HALF)
    # The bits of a small whole number below those of 2^52 give 2^52 plus that number.
    k = e.sub(
        e.from_bits(e.integer_operation("or", e.integer_operation("lshr", shifted, 52), 0x433 << 52)),
        e.constant(2.0**52 + 1023),
    )
    k = e.sub(k, e.select(small, e.constant(54.0), e.constant(0.0)))
    return k, e.from_bits(e.integer_operation("add", e.integer_operation("and", shifted, _MANTISSA_BITS), _BITS_OF_ROOT_HALF))


def _emit_log(e: Arithmetic, x: str) -> str:
    """Return the logarithm of x."""
    k, m = _split_exponent(e, x)
    f = e.add(m, e.constant(-1.0))
    s = e.binary("fdiv", f, e.add(f, e.constant(2.0)))
    z = e.mul(s, s)
    r = e.mul(z, emit_polynomial(e, _LOG_COEFFICIENTS, z))
    half = e.mul(e.mul(e.constant(0.5), f), f)
    below = e.mul(k, e.constant(_LN2_LOW))
    y = e.fma(k, e.constant(_LN2_HIGH), e.sub(f, e.sub(half, e.fma(s, e.add(half, r), below))))
    y = e.select(e.compare("oeq", x, e.constant(_INFINITY)), x, y)
    y = e.select(e.compare("oeq", x, e.constant(0.0)), e.constant(-_INFINITY), y)
    return e.select(e.compare("oge", x, e.constant(0.0)), y, e.constant(_NOT_A_NUMBER))


# ---- powers --------------------------------------------------------------------------------------------------------


def _fast_sum_and_error(e: Arithmetic, a: str, b: str) -> tuple[str, str]:
    """Return the sum and its rounding error if a is 0 or not the smaller number."""
    total = e.add(a, b)
    return total, e.sub(b, e.sub(total, a))


def _sum_and_error(e: Arithmetic, a: str, b: str) -> tuple[str, str]:
    """Return the sum and its rounding error."""
    total = e.add(a, b)
    recovered = e.sub(total, a)
    return total, e.add(e.sub(a, e.sub(total, recovered)), e.sub(b, recovered))


def _product_and_error(e: Arithmetic, a: str, b: str) -> tuple[str, str]:
    """Return the product and its rounding error; |a|, |b| below 1e290."""
    p = e.mul(a, b)
    if e.machine.fused:
        return p, e.fma(a, b, e.negate(p))
    (a1, a2), (b1, b2) = _split_mantissa(e, a), _split_mantissa(e, b)
    return p, e.add(e.mul(a2, b2), e.add(e.mul(a2, b1), e.add(e.mul(a1, b2), e.sub(e.mul(a1, b1), p))))


def _split_mantissa(e: Arithmetic, a: str) -> tuple[str, str]:
    scaled = e.mul(a, e.constant(2.0**27 + 1))
    first = e.sub(scaled, e.sub(scaled, a))
    return first, e.sub(a, first)


def _log_in_two_parts(e: Arithmetic, x: str) -> tuple[str, str]:
    """Return the logarithm of a positive finite x in two parts, to about 68 bits."""
    k, m = _split_exponent(e, x)
    upper, lower = e.compare("ogt", m, e.constant(1.2247448713915890)), e.compare_less(m, e.constant(0.8660254037844386))
    centre, *center_and_log = (
        e.select(upper, e.constant(a), e.select(lower, e.constant(b), e.constant(c))) for a, b, c in _RANGE_CENTERS
    )
    f = e.sub(m, centre)
    divisor, rounding_error = _sum_and_error(e, m, centre)
    s = e.binary("fdiv", f, divisor)
    p, q = _product_and_error(e, s, divisor)
    s_low = e.binary("fdiv", e.sub(e.sub(e.sub(f, p), q), e.mul(s, rounding_error)), divisor)
    z, z_low = _product_and_error(e, s, s)
    z_low = e.fma(e.add(s, s), s_low, z_low)
    r = e.mul(e.mul(z, z), emit_polynomial(e, _LOG_OF_POW, z))
    t, t_low = _fast_sum_and_error(e, e.constant(3.0), z)
    t, t_low = _fast_sum_and_error(e, t, e.add(t_low, e.add(z_low, r)))
    p, q = _product_and_error(e, s, t)
    q = e.add(q, e.fma(s, t_low, e.mul(s_low, t)))
    y, y_low = _product_and_error(e, p, e.constant(2 / 3))
    y_low = e.add(y_low, e.fma(q, e.constant(2 / 3), e.mul(p, e.constant(2 / 3 * 2.0**-54))))
    high, first = _sum_and_error(e, e.mul(k, e.constant(_LN2_HIGH)), center_and_log[0])
    high, second = _sum_and_error(e, high, y)
    rest = e.fma(k, e.constant(_LN2_LOW), e.add(center_and_log[1], y_low))
    return _fast_sum_and_error(e, high, e.add(e.add(first, second), rest))


def _emit_pow(e: Arithmetic, x: str, y: str) -> str:
    size, power = e.intrinsic("fabs", x), e.intrinsic("fabs", y)
    zero, one, infinite = e.constant(0.0), e.constant(1.0), e.constant(_INFINITY)
    huge = e.constant(1e21)  # any power except of 1 overflows or vanishes
    high, low = _log_in_two_parts(e, size)
    exponent = e.intrinsic("copysign", e.select(e.compare("ogt", power, huge), huge, power), y)
    p, q = _product_and_error(e, exponent, high)
    q = e.fma(exponent, low, q)
    result = _emit_exp(e, p, e.select(e.compare_less(e.intrinsic("fabs", p), e.constant(800.0)), q, zero))
    grows = e.compare("ogt", y, zero)
    result = e.select(e.compare("oeq", size, zero), e.select(grows, zero, infinite), result)
    result = e.select(e.compare("oeq", size, infinite), e.select(grows, infinite, zero), result)
    odd = e.mask_and(_integer_mask(e, power), e.mask_not(_integer_mask(e, e.mul(power, e.constant(0.5)))))
    result = e.select(odd, e.intrinsic("copysign", result, x), result)
    fails = e.mask_and(e.compare_less(x, zero), e.mask_and(e.compare_less(size, infinite), e.mask_not(_integer_mask(e, power))))
    result = e.select(e.mask_or(fails, e.compare("uno", x, y)), e.constant(_NOT_A_NUMBER), result)
    return e.select(e.mask_or(e.compare("oeq", y, zero), e.compare("oeq", x, one)), one, result)


def _integer_mask(e: Arithmetic, size: str) -> str:
    """Return the mask of non-negative integers."""
    limit = e.constant(2.0**52)
    return e.mask_or(e.compare("oge", size, limit), e.compare("oeq", e.sub(e.add(size, limit), limit), size))


# ---- angles --------------------------------------------------------------------------------------------------------


def _emit_atan2(e: Arithmetic, y: str, x: str) -> str:
    zero, one, two, infinite = e.constant(0.0), e.constant(1.0), e.constant(2.0), e.constant(_INFINITY)
    high, wide = e.intrinsic("fabs", y), e.intrinsic("fabs", x)
    steep = e.compare("ogt", high, wide)
    less, more = e.select(steep, wide, high), e.select(steep, high, wide)
    # Two infinities count as equal, any number is 0 relative to an infinity, and two zeros have the angle 0.
    both, one_of = e.compare("oeq", less, infinite), e.compare("oeq", more, infinite)
    less = e.select(one_of, e.select(both, one, zero), less)
    more = e.select(e.mask_or(one_of, e.compare("oeq", more, zero)), one, more)
    # So that neither the remainder of a quotient nor the reciprocal of a divisor loses digits.
    small, large = e.compare_less(more, e.constant(2.0**300)), e.compare("ogt", more, e.constant(2.0**900))
    scale = e.select(small, e.constant(2.0**600), e.select(large, e.constant(2.0**-200), one))
    less, more = e.mul(less, scale), e.mul(more, scale)
    middle = e.compare("ogt", less, e.mul(more, e.constant(7 / 16)))
    far = e.compare("ogt", less, e.mul(more, e.constant(11 / 16)))
    n = e.select(far, e.sub(less, more), e.select(middle, e.fma(less, two, e.negate(more)), less))
    d = e.select(far, e.add(less, more), e.select(middle, e.fma(more, two, less), more))
    inverse = e.binary("fdiv", one, d)
    q = e.mul(n, inverse)
    q = e.fma(_division_remainder(e, n, q, d), inverse, q)
    tail = e.mul(_division_remainder(e, n, q, d), inverse)
    z = e.mul(q, q)
    tail = e.fma(e.negate(q), e.mul(z, emit_polynomial(e, _ATAN_COEFFICIENTS, z)), tail)
    eighth, half = (c / 2 for c in _QUARTER_TURN), _ATAN_OF_HALF
    known = [e.select(far, e.constant(a), e.select(middle, e.constant(b), zero)) for a, b in zip(eighth, half, strict=True)]
    back = e.sign_bit_mask(x)
    turned = [e.select(steep, e.constant(c), e.select(back, e.constant(2 * c), zero)) for c in _QUARTER_TURN]
    sign = e.select(steep, e.select(back, one, e.constant(-1.0)), e.select(back, e.constant(-1.0), one))
    first, lost = _sum_and_error(e, turned[0], e.mul(sign, known[0]))
    rest = e.add(e.add(lost, turned[1]), e.mul(sign, e.add(tail, known[1])))
    angle = e.add(first, e.fma(sign, q, rest))
    return e.select(e.compare("uno", x, y), e.constant(_NOT_A_NUMBER), e.intrinsic("copysign", angle, y))


def _division_remainder(e: Arithmetic, n: str, q: str, d: str) -> str:
    """Return the remainder ``n - q d``."""
    if e.machine.fused:
        return e.fma(e.negate(q), d, n)
    p, rounding_error = _product_and_error(e, q, d)
    return e.sub(e.sub(n, p), rounding_error)


def _arcsine_parts(e: Arithmetic, x: str) -> tuple[str, str, str, str]:
    """Return for |x| the mask of |x| < 1/2, and v, r, c: the arc ``v + v r + c``, of the sine |x| or of (1 - |x|) / 2."""
    size = e.intrinsic("fabs", x)
    small = e.compare_less(size, e.constant(0.5))
    z = e.select(small, e.mul(size, size), e.mul(e.sub(e.constant(1.0), size), e.constant(0.5)))
    r = e.binary("fdiv", e.mul(z, emit_polynomial(e, _ASIN_NUMERATOR, z)), emit_polynomial(e, _ASIN_DENOMINATOR, z))
    root = e.intrinsic("sqrt", z)
    twice = e.add(root, root)
    c = e.binary("fdiv", _division_remainder(e, z, root, root), twice)
    c = e.select(e.mask_or(small, e.compare("oeq", z, e.constant(0.0))), e.constant(0.0), e.add(c, c))
    return small, e.select(small, size, twice), r, c


def _emit_asin(e: Arithmetic, x: str) -> str:
    small, v, r, c = _arcsine_parts(e, x)
    from_above = [e.select(small, e.constant(0.0), e.constant(q)) for q in _QUARTER_TURN]
    sign = e.select(small, e.constant(1.0), e.constant(-1.0))
    first, rounding_error = _sum_and_error(e, from_above[0], e.mul(sign, v))
    angle = e.add(first, e.add(e.add(rounding_error, from_above[1]), e.mul(sign, e.fma(v, r, c))))
    return e.intrinsic("copysign", angle, x)


def _emit_acos(e: Arithmetic, x: str) -> str:
    small, v, r, c = _arcsine_parts(e, x)
    is_negative = e.sign_bit_mask(x)
    turned = [e.select(small, e.constant(q), e.select(is_negative, e.constant(2 * q), e.constant(0.0))) for q in _QUARTER_TURN]
    one, minus = e.constant(1.0), e.constant(-1.0)
    sign = e.select(small, e.select(is_negative, one, minus), e.select(is_negative, minus, one))
    first, rounding_error = _sum_and_error(e, turned[0], e.mul(sign, v))
    return e.add(first, e.add(e.add(rounding_error, turned[1]), e.mul(sign, e.fma(v, r, c))))


EMITTED_FUNCTIONS: dict[int, Callable[[Arithmetic, str, str], str]] = {
    ca.OP_EXP: lambda e, x, _: _emit_exp(e, x),
    ca.OP_LOG: lambda e, x, _: _emit_log(e, x),
    ca.OP_POW: _emit_pow,
    ca.OP_CONSTPOW: _emit_pow,
    ca.OP_ASIN: lambda e, x, _: _emit_asin(e, x),
    ca.OP_ACOS: lambda e, x, _: _emit_acos(e, x),
    ca.OP_ATAN: lambda e, x, _: _emit_atan2(e, x, e.constant(1.0)),
    ca.OP_ATAN2: _emit_atan2,
}
