"""Exponential, logarithm, powers and their kin as LLVM instructions, without branches: the same bits on every machine.

Nothing is called: a processor's C library, a graphics processor and every lane of a batch would each round in their own way.
What is left to the machine is whether it has fused multiply-add. Largest errors, measured against exact values, in units in
the last place: exp 0.83, log 0.79, pow 0.86, asin 0.65, acos 0.68, atan 0.75, atan2 0.94; of what no kernel of holdfast uses
log1p 0.76, erf 0.86, expm1 1.1, sinh and cosh 1.7, tanh 2.2. ``tests/kernels/test_kernel_functions.py`` holds limits on them
and compares special values.

Source: reductions and polynomials of fdlibm (Sun Microsystems 1993, 2004; ``e_exp.c``, ``e_log.c``, ``e_pow.c``, ``s_atan.c``,
``e_asin.c``, ``s_erf.c``), whose branches are choices here; the rounding of a quotient or product is carried along as in
T. J. Dekker, "A floating-point technique for extending the available precision" (1971). Hyperbolic functions, ``expm1`` and
``log1p`` from the same pieces: derived here.
"""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca

from holdfast.kernels.llvm.arithmetic import ROUND, Arithmetic, polynomial


def _numbers(text: str) -> tuple[float, ...]:
    return tuple(map(float, text.split()))


# Coefficients, highest degree first.
_LN2, _LN2_REST = 6.93147180369123816490e-01, 1.90821492927058770002e-10  # the first ends in zeros: times 2000 it is exact
_QUARTER = 1.57079632679489655800e00, 6.12323399573676603587e-17  # of a turn, in two parts, as of all pairs here
_ATAN_OF_HALF = 4.63647609000806093515e-01, 2.26987774529616870924e-17
_ERF_AT_1 = 8.45062911510467529297e-01  # rounded to 24 bits
_EXP = _numbers(
    "4.1381367970572385e-08 -1.6533902205465252e-06 6.613756321437934e-05 -0.0027777777777015593 0.16666666666666602"
)
_LOG = _numbers(
    "0.14798198605116586 0.15313837699209373 0.1818357216161805 0.22222198432149784 0.2857142874366239 0.3999999999940942 "
    "0.6666666666666735"
)
_LOG_OF_POW = _numbers(
    "0.20697501780033842 0.23066074577556175 0.272728123808534 0.33333332981837743 0.4285714285785502 0.5999999999999946"
)
_ATAN = _numbers(
    "0.016285820115365782 -0.036531572744216916 0.049768779946159324 -0.058335701337905735 0.06661073137387531 "
    "-0.0769187620504483 0.09090887133436507 -0.11111110405462356 0.14285714272503466 -0.19999999999876483 "
    "0.3333333333333293"
)
_ASIN = _numbers(
    "3.479331075960212e-05 0.0007915349942898145 -0.04005553450067941 0.20121253213486293 -0.3255658186224009 "
    "0.16666666666666666"
)
_ASIN_BELOW = _numbers("0.07703815055590194 -0.6882839716054533 2.0209457602335057 -2.403394911734414 1.0")
_ERF = [  # numerator and denominator to 0.84375, to 1.25, to 1/0.35, and beyond
    _numbers(row)
    for row in (
        "-2.3763016656650163e-05 -0.005770270296489442 -0.02848174957559851 -0.3250421072470015 0.12837916709551256",
        "-3.960228278775368e-06 0.00013249473800432164 0.005081306281875766 0.0650222499887673 0.39791722395915535 1.0",
        "-0.002166375594868791 0.035478304325618236 -0.11089469428239668 0.31834661990116175 -0.3722078760357013 "
        "0.41485611868374833 -0.0023621185607526594",
        "0.011984499846799107 0.01363708391202905 0.12617121980876164 0.07182865441419627 0.540397917702171 "
        "0.10642088040084423 1.0",
        "-9.814329344169145 -81.2874355063066 -184.60509290671104 -162.39666946257347 -62.375332450326006 "
        "-10.558626225323291 -0.6938585727071818 -0.009864944034847148",
        "-0.0604244152148581 6.570249770319282 108.63500554177944 429.00814002756783 645.3872717332679 434.56587747522923 "
        "137.65775414351904 19.651271667439257 1.0",
        "-483.5191916086514 -1025.0951316110772 -637.5664433683896 -160.63638485582192 -17.757954917754752 "
        "-0.799283237680523 -0.0098649429247001",
        "-22.44095244658582 474.52854120695537 2553.0504064331644 3199.8582195085955 1536.729586084437 325.7925129965739 "
        "30.33806074348246 1.0",
    )
]
_CENTRES = (  # of the thirds of a range; their logarithms in two parts
    (1.5, 0.75, 1.0),
    (0.4054651081081644, -0.2876820724517809, 0.0),
    (-2.8811380259626426e-18, -2.607160616442564e-17, 0.0),
)
_INF, _NAN = float("inf"), float("nan")
_MANTISSA, _ONE, _ROOT_HALF = (1 << 52) - 1, 0x3FF << 52, 0x3FE6A09E << 32  # bits


# ---- exponential ---------------------------------------------------------------------------------------------------


def _power_of_2(e: Arithmetic, k: str) -> str:
    """2^k of a whole number, -1022 <= k <= 1023."""
    return e.of_bits(e.whole("shl", e.bits(e.add(k, e.number(ROUND + 1023))), 52))


def _scaled(e: Arithmetic, x: str, k: str) -> str:
    """Product of x and 2^k, |k| < 2040, rounded once, also where the result has fewer digits."""
    half = e.sub(e.fma(k, e.number(0.5), e.number(ROUND)), e.number(ROUND))
    return e.mul(e.mul(x, _power_of_2(e, half)), _power_of_2(e, e.sub(k, half)))


def _reduced(e: Arithmetic, x: str, rest: str | None = None, low: float = -746.0) -> tuple[str, str, str]:
    """The k, a and b of ``exp(x + rest) = 2^k (1 + a + b)``, |b| small against a; x is taken from ``low`` to 720."""
    most, least = e.number(720.0), e.number(low)
    x = e.select(e.compare("ogt", x, most), most, e.select(e.less(x, least), least, x))
    shift = e.number(ROUND)
    k = e.sub(e.fma(x, e.number(1.44269504088896338700), shift), shift)
    a = e.fma(k, e.number(-_LN2), x)
    below = e.mul(k, e.number(_LN2_REST))
    if rest is not None:
        below = e.sub(below, rest)
    r = e.sub(a, below)
    square = e.mul(r, r)
    c = e.fma(e.negative(square), polynomial(e, _EXP, square), r)
    return k, a, e.sub(e.binary("fdiv", e.mul(r, c), e.sub(e.number(2.0), c)), below)


def _exp(e: Arithmetic, x: str, rest: str | None = None) -> str:
    k, a, b = _reduced(e, x, rest)
    return _scaled(e, e.add(e.number(1.0), e.add(a, b)), k)


def _expm1(e: Arithmetic, x: str, doublings: float = 0.0) -> str:
    """(exp(x) - 1) 2^doublings."""
    k, a, b = _reduced(e, x, low=-60.0)
    total, lost = _sum(
        e, e.sub(e.number(1.0), _power_of_2(e, e.negative(e.select(e.less(k, e.number(60.0)), k, e.number(60.0))))), a
    )
    y = _scaled(e, e.add(total, e.add(lost, b)), e.add(k, e.number(doublings)))
    return e.select(e.compare("oeq", x, e.number(0.0)), x, y)


def _sinh(e: Arithmetic, x: str) -> str:
    size = e.intrinsic("fabs", x)
    h = _expm1(e, size, -1.0)
    y = e.add(h, e.binary("fdiv", h, e.add(e.add(h, h), e.number(1.0))))
    y = e.select(e.compare("oeq", h, e.number(_INF)), h, e.select(e.less(size, e.number(2.0**-28)), size, y))
    return e.intrinsic("copysign", y, x)


def _cosh(e: Arithmetic, x: str) -> str:
    k, a, b = _reduced(e, e.intrinsic("fabs", x))
    w = _scaled(e, e.add(e.number(1.0), e.add(a, b)), e.add(k, e.number(-1.0)))
    return e.add(w, e.binary("fdiv", e.number(0.25), w))


def _tanh(e: Arithmetic, x: str) -> str:
    size = e.intrinsic("fabs", x)
    size = e.select(e.compare("ogt", size, e.number(25.0)), e.number(25.0), size)
    t = _expm1(e, e.add(size, size))
    return e.intrinsic("copysign", e.binary("fdiv", t, e.add(t, e.number(2.0))), x)


# ---- logarithm -----------------------------------------------------------------------------------------------------


def _split(e: Arithmetic, x: str) -> tuple[str, str]:
    """The k and m of x = 2^k m, m from the root of 1/2 to that of 2, of a positive finite x."""
    small = e.less(x, e.number(2.0**-1022))
    x = e.select(small, e.mul(x, e.number(2.0**54)), x)
    moved = e.whole("add", e.bits(x), _ONE - _ROOT_HALF)
    # The bits of a small whole number below those of 2^52 are 2^52 plus that number.
    k = e.sub(e.of_bits(e.whole("or", e.whole("lshr", moved, 52), 0x433 << 52)), e.number(2.0**52 + 1023))
    k = e.sub(k, e.select(small, e.number(54.0), e.number(0.0)))
    return k, e.of_bits(e.whole("add", e.whole("and", moved, _MANTISSA), _ROOT_HALF))


def _log(e: Arithmetic, x: str, rest: str | None = None) -> str:
    """Logarithm of x; ``rest`` is added to it."""
    k, m = _split(e, x)
    f = e.add(m, e.number(-1.0))
    s = e.binary("fdiv", f, e.add(f, e.number(2.0)))
    z = e.mul(s, s)
    r = e.mul(z, polynomial(e, _LOG, z))
    half = e.mul(e.mul(e.number(0.5), f), f)
    below = e.mul(k, e.number(_LN2_REST))
    if rest is not None:
        below = e.add(below, rest)
    y = e.fma(k, e.number(_LN2), e.sub(f, e.sub(half, e.fma(s, e.add(half, r), below))))
    y = e.select(e.compare("oeq", x, e.number(_INF)), x, y)
    y = e.select(e.compare("oeq", x, e.number(0.0)), e.number(-_INF), y)
    return e.select(e.compare("oge", x, e.number(0.0)), y, e.number(_NAN))


def _log1p(e: Arithmetic, x: str) -> str:
    u, lost = _sum(e, e.number(1.0), x)
    finite = e.less(x, e.number(2.0**60))  # infinity loses itself
    y = _log(e, u, e.select(finite, e.binary("fdiv", lost, u), e.number(0.0)))
    y = e.select(e.compare("oeq", u, e.number(0.0)), e.number(-_INF), y)
    return e.select(e.compare("oeq", x, e.number(0.0)), x, y)


# ---- powers --------------------------------------------------------------------------------------------------------


def _quick_sum(e: Arithmetic, a: str, b: str) -> tuple[str, str]:
    """Sum, and what rounding took from it, where a is 0 or not the smaller one."""
    total = e.add(a, b)
    return total, e.sub(b, e.sub(total, a))


def _sum(e: Arithmetic, a: str, b: str) -> tuple[str, str]:
    """Sum, and what rounding took from it."""
    total = e.add(a, b)
    back = e.sub(total, a)
    return total, e.add(e.sub(a, e.sub(total, back)), e.sub(b, back))


def _product(e: Arithmetic, a: str, b: str) -> tuple[str, str]:
    """Product, and what rounding took from it; |a|, |b| below 1e290."""
    p = e.mul(a, b)
    if e.machine.fused:
        return p, e.fma(a, b, e.negative(p))
    (a1, a2), (b1, b2) = _halves(e, a), _halves(e, b)
    return p, e.add(e.mul(a2, b2), e.add(e.mul(a2, b1), e.add(e.mul(a1, b2), e.sub(e.mul(a1, b1), p))))


def _halves(e: Arithmetic, a: str) -> tuple[str, str]:
    wide = e.mul(a, e.number(2.0**27 + 1))
    first = e.sub(wide, e.sub(wide, a))
    return first, e.sub(a, first)


def _log_in_two(e: Arithmetic, x: str) -> tuple[str, str]:
    """Logarithm of a positive finite x in two parts, to some 68 bits."""
    k, m = _split(e, x)
    upper, lower = e.compare("ogt", m, e.number(1.2247448713915890)), e.less(m, e.number(0.8660254037844386))
    centre, *known = (e.select(upper, e.number(a), e.select(lower, e.number(b), e.number(c))) for a, b, c in _CENTRES)
    f = e.sub(m, centre)
    divisor, lost = _sum(e, m, centre)
    s = e.binary("fdiv", f, divisor)
    p, q = _product(e, s, divisor)
    s_low = e.binary("fdiv", e.sub(e.sub(e.sub(f, p), q), e.mul(s, lost)), divisor)
    z, z_low = _product(e, s, s)
    z_low = e.fma(e.add(s, s), s_low, z_low)
    r = e.mul(e.mul(z, z), polynomial(e, _LOG_OF_POW, z))
    t, t_low = _quick_sum(e, e.number(3.0), z)
    t, t_low = _quick_sum(e, t, e.add(t_low, e.add(z_low, r)))
    p, q = _product(e, s, t)
    q = e.add(q, e.fma(s, t_low, e.mul(s_low, t)))
    y, y_low = _product(e, p, e.number(2 / 3))
    y_low = e.add(y_low, e.fma(q, e.number(2 / 3), e.mul(p, e.number(2 / 3 * 2.0**-54))))
    high, first = _sum(e, e.mul(k, e.number(_LN2)), known[0])
    high, second = _sum(e, high, y)
    rest = e.fma(k, e.number(_LN2_REST), e.add(known[1], y_low))
    return _quick_sum(e, high, e.add(e.add(first, second), rest))


def _pow(e: Arithmetic, x: str, y: str) -> str:
    size, power = e.intrinsic("fabs", x), e.intrinsic("fabs", y)
    zero, one, infinite = e.number(0.0), e.number(1.0), e.number(_INF)
    huge = e.number(1e21)  # whatever is not 1 overflows or vanishes
    high, low = _log_in_two(e, size)
    exponent = e.intrinsic("copysign", e.select(e.compare("ogt", power, huge), huge, power), y)
    p, q = _product(e, exponent, high)
    q = e.fma(exponent, low, q)
    result = _exp(e, p, e.select(e.less(e.intrinsic("fabs", p), e.number(800.0)), q, zero))
    grows = e.compare("ogt", y, zero)
    result = e.select(e.compare("oeq", size, zero), e.select(grows, zero, infinite), result)
    result = e.select(e.compare("oeq", size, infinite), e.select(grows, infinite, zero), result)
    odd = e.both(_is_whole(e, power), e.opposite(_is_whole(e, e.mul(power, e.number(0.5)))))
    result = e.select(odd, e.intrinsic("copysign", result, x), result)
    fails = e.both(e.less(x, zero), e.both(e.less(size, infinite), e.opposite(_is_whole(e, power))))
    result = e.select(e.either(fails, e.compare("uno", x, y)), e.number(_NAN), result)
    return e.select(e.either(e.compare("oeq", y, zero), e.compare("oeq", x, one)), one, result)


def _is_whole(e: Arithmetic, size: str) -> str:
    """Mask: a number that is not negative is a whole one."""
    limit = e.number(2.0**52)
    return e.either(e.compare("oge", size, limit), e.compare("oeq", e.sub(e.add(size, limit), limit), size))


# ---- angles --------------------------------------------------------------------------------------------------------


def _atan2(e: Arithmetic, y: str, x: str) -> str:
    zero, one, two, infinite = e.number(0.0), e.number(1.0), e.number(2.0), e.number(_INF)
    high, wide = e.intrinsic("fabs", y), e.intrinsic("fabs", x)
    steep = e.compare("ogt", high, wide)
    less, more = e.select(steep, wide, high), e.select(steep, high, wide)
    # Two infinities are as good as equal, and beside one of them everything else is 0; two zeros have the angle 0.
    both, one_of = e.compare("oeq", less, infinite), e.compare("oeq", more, infinite)
    less = e.select(one_of, e.select(both, one, zero), less)
    more = e.select(e.either(one_of, e.compare("oeq", more, zero)), one, more)
    # So that neither what is missing in a quotient nor the reciprocal of a divisor has fewer digits.
    small, large = e.less(more, e.number(2.0**300)), e.compare("ogt", more, e.number(2.0**900))
    scale = e.select(small, e.number(2.0**600), e.select(large, e.number(2.0**-200), one))
    less, more = e.mul(less, scale), e.mul(more, scale)
    middle = e.compare("ogt", less, e.mul(more, e.number(7 / 16)))
    far = e.compare("ogt", less, e.mul(more, e.number(11 / 16)))
    n = e.select(far, e.sub(less, more), e.select(middle, e.fma(less, two, e.negative(more)), less))
    d = e.select(far, e.add(less, more), e.select(middle, e.fma(more, two, less), more))
    inverse = e.binary("fdiv", one, d)
    q = e.mul(n, inverse)
    q = e.fma(_missing(e, n, q, d), inverse, q)
    tail = e.mul(_missing(e, n, q, d), inverse)
    z = e.mul(q, q)
    tail = e.fma(e.negative(q), e.mul(z, polynomial(e, _ATAN, z)), tail)
    eighth, half = (c / 2 for c in _QUARTER), _ATAN_OF_HALF
    known = [e.select(far, e.number(a), e.select(middle, e.number(b), zero)) for a, b in zip(eighth, half, strict=True)]
    back = e.negative_sign(x)
    turned = [e.select(steep, e.number(c), e.select(back, e.number(2 * c), zero)) for c in _QUARTER]
    sign = e.select(steep, e.select(back, one, e.number(-1.0)), e.select(back, e.number(-1.0), one))
    first, lost = _sum(e, turned[0], e.mul(sign, known[0]))
    rest = e.add(e.add(lost, turned[1]), e.mul(sign, e.add(tail, known[1])))
    angle = e.add(first, e.fma(sign, q, rest))
    return e.select(e.compare("uno", x, y), e.number(_NAN), e.intrinsic("copysign", angle, y))


def _missing(e: Arithmetic, n: str, q: str, d: str) -> str:
    """What is missing in q d to n."""
    if e.machine.fused:
        return e.fma(e.negative(q), d, n)
    p, lost = _product(e, q, d)
    return e.sub(e.sub(n, p), lost)


def _arc(e: Arithmetic, x: str) -> tuple[str, str, str, str]:
    """Of |x|: mask of those below 1/2, and v, r and c: the arc is ``v + v r + c``, of the sine |x| or of 1/2 of (1 - |x|)."""
    size = e.intrinsic("fabs", x)
    small = e.less(size, e.number(0.5))
    z = e.select(small, e.mul(size, size), e.mul(e.sub(e.number(1.0), size), e.number(0.5)))
    r = e.binary("fdiv", e.mul(z, polynomial(e, _ASIN, z)), polynomial(e, _ASIN_BELOW, z))
    root = e.intrinsic("sqrt", z)
    twice = e.add(root, root)
    c = e.binary("fdiv", _missing(e, z, root, root), twice)
    c = e.select(e.either(small, e.compare("oeq", z, e.number(0.0))), e.number(0.0), e.add(c, c))
    return small, e.select(small, size, twice), r, c


def _asin(e: Arithmetic, x: str) -> str:
    small, v, r, c = _arc(e, x)
    from_above = [e.select(small, e.number(0.0), e.number(q)) for q in _QUARTER]
    sign = e.select(small, e.number(1.0), e.number(-1.0))
    first, lost = _sum(e, from_above[0], e.mul(sign, v))
    angle = e.add(first, e.add(e.add(lost, from_above[1]), e.mul(sign, e.fma(v, r, c))))
    return e.intrinsic("copysign", angle, x)


def _acos(e: Arithmetic, x: str) -> str:
    small, v, r, c = _arc(e, x)
    back = e.negative_sign(x)
    turned = [e.select(small, e.number(q), e.select(back, e.number(2 * q), e.number(0.0))) for q in _QUARTER]
    one, minus = e.number(1.0), e.number(-1.0)
    sign = e.select(small, e.select(back, one, minus), e.select(back, minus, one))
    first, lost = _sum(e, turned[0], e.mul(sign, v))
    return e.add(first, e.add(e.add(lost, turned[1]), e.mul(sign, e.fma(v, r, c))))


# ---- error function ------------------------------------------------------------------------------------------------


def _erf(e: Arithmetic, x: str) -> str:
    size, one = e.intrinsic("fabs", x), e.number(1.0)
    size = e.select(e.compare("ogt", size, e.number(6.0)), e.number(6.0), size)
    square = e.mul(size, size)
    ends = [e.less(size, e.number(end)) for end in (0.84375, 1.25, 1 / 0.35)]

    def chosen(values: list[str]) -> str:
        value = values[3]
        for mask, other in zip(reversed(ends), reversed(values[:3]), strict=True):
            value = e.select(mask, other, value)
        return value

    z = chosen([square, e.sub(size, one), *[e.binary("fdiv", one, e.select(ends[0], one, square))] * 2])

    def rational(part: int) -> str:
        value = e.number(0.0)
        for degree in reversed(range(9)):
            row = [c[-1 - degree] if degree < len(c) else 0.0 for c in _ERF[part::2]]
            value = e.fma(value, z, chosen([e.number(c) for c in row]))
        return value

    ratio = e.binary("fdiv", rational(0), rational(1))
    tail = e.binary("fdiv", _exp(e, e.add(e.sub(e.number(-0.5625), square), ratio)), e.select(ends[0], one, size))
    beyond = e.sub(one, tail)
    value = chosen([e.fma(size, ratio, size), e.add(e.number(_ERF_AT_1), ratio), beyond, beyond])
    return e.intrinsic("copysign", value, x)


FUNCTIONS: dict[int, Callable[[Arithmetic, str, str], str]] = {
    ca.OP_EXP: lambda e, x, _: _exp(e, x),
    ca.OP_LOG: lambda e, x, _: _log(e, x),
    ca.OP_POW: _pow,
    ca.OP_CONSTPOW: _pow,
    ca.OP_ASIN: lambda e, x, _: _asin(e, x),
    ca.OP_ACOS: lambda e, x, _: _acos(e, x),
    ca.OP_ATAN: lambda e, x, _: _atan2(e, x, e.number(1.0)),
    ca.OP_ATAN2: _atan2,
    ca.OP_SINH: lambda e, x, _: _sinh(e, x),
    ca.OP_COSH: lambda e, x, _: _cosh(e, x),
    ca.OP_TANH: lambda e, x, _: _tanh(e, x),
    ca.OP_ERF: lambda e, x, _: _erf(e, x),
    ca.OP_LOG1P: lambda e, x, _: _log1p(e, x),
    ca.OP_EXPM1: lambda e, x, _: _expm1(e, x),
}
