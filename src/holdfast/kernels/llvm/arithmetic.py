"""Arithmetic as LLVM instructions; sine and cosine together, without branches.

A library's functions switch to another method for very large angles, and a vector library's do so for a whole group of rows
when one of them is large, infinite or NaN: its neighbours then differ in the last digit. These do the same operations in
every lane, and give sine and cosine for little more than the price of one (measured: the worst-case index of the 9-joint
PA10 gains 15 to 20 %).

Source: reduction by pi split in three parts (W. J. Cody, W. Waite 1980), polynomials of fdlibm (``k_sin.c``, ``k_cos.c``)
at half the angle, then the formulas of the double angle. Largest absolute error 4.5e-16 for ``|x| <= 1e15`` (measured).
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

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
ROUND = 6755399441055744.0  # 1.5 * 2^52: adding and taking it away rounds to a whole number
_LARGEST = 1e15


@dataclass(frozen=True)
class Machine:
    """What the text depends on.

    Attributes:
        lanes: Rows handled at once.
        fused: Whether the machine has fused multiply-add.
    """

    lanes: int
    fused: bool


class Arithmetic:
    """Values of ``lanes`` doubles by their names in the text; a method adds an instruction and returns its name."""

    def __init__(self, machine: Machine) -> None:
        self.machine = machine
        self.lines: list[str] = []
        self.type = f"<{machine.lanes} x double>"
        self.mask = f"<{machine.lanes} x i1>"
        self.whole_type = f"<{machine.lanes} x i64>"
        self.declared: set[str] = set()  # functions that are not defined here

    def _new(self, text: str) -> str:
        name = f"%v{len(self.lines)}"
        self.lines.append(f"{name} = {text}")
        return name

    def number(self, value: float) -> str:
        """A constant, bit for bit."""
        return f"splat (double 0x{struct.unpack('<Q', struct.pack('<d', value))[0]:016X})"

    def binary(self, operation: str, a: str, b: str) -> str:
        """``fadd``, ``fsub``, ``fmul`` or ``fdiv``."""
        return self._new(f"{operation} {self.type} {a}, {b}")

    def add(self, a: str, b: str) -> str:
        """Sum."""
        return self.binary("fadd", a, b)

    def sub(self, a: str, b: str) -> str:
        """Difference."""
        return self.binary("fsub", a, b)

    def mul(self, a: str, b: str) -> str:
        """Product."""
        return self.binary("fmul", a, b)

    def negative(self, a: str) -> str:
        """Negative."""
        return self._new(f"fneg {self.type} {a}")

    def fma(self, a: str, b: str, c: str) -> str:
        """Product of a and b plus c, rounded once where the machine can."""
        if not self.machine.fused:
            return self.add(self.mul(a, b), c)
        return self.intrinsic("fma", a, b, c)

    def intrinsic(self, name: str, *arguments: str) -> str:
        """An LLVM intrinsic that every machine rounds alike: ``fma``, ``sqrt``, ``fabs``, ``copysign``."""
        name = f"@llvm.{name}.v{self.machine.lanes}f64"
        self.declared.add(f"declare {self.type} {name}({', '.join([self.type] * len(arguments))})")
        return self._new(f"call {self.type} {name}({', '.join(f'{self.type} {a}' for a in arguments)})")

    def less(self, a: str, b: str) -> str:
        """The mask of a < b."""
        return self.compare("olt", a, b)

    def compare(self, how: str, a: str, b: str) -> str:
        """A mask."""
        return self._new(f"fcmp {how} {self.type} {a}, {b}")

    def select(self, mask: str, a: str, b: str) -> str:
        """``mask ? a : b``."""
        return self._new(f"select {self.mask} {mask}, {self.type} {a}, {self.type} {b}")

    def both(self, a: str, b: str) -> str:
        """The mask where both are true."""
        return self._new(f"and {self.mask} {a}, {b}")

    def either(self, a: str, b: str) -> str:
        """The mask where one is true, or both."""
        return self._new(f"or {self.mask} {a}, {b}")

    def opposite(self, a: str) -> str:
        """The mask where this one is false."""
        return self._new(f"xor {self.mask} {a}, splat (i1 true)")

    def bits(self, a: str) -> str:
        """The 64 bits of a value."""
        return self._new(f"bitcast {self.type} {a} to {self.whole_type}")

    def of_bits(self, a: str) -> str:
        """The value of 64 bits."""
        return self._new(f"bitcast {self.whole_type} {a} to {self.type}")

    def whole(self, operation: str, a: str, constant: int) -> str:
        """``add``, ``and``, ``or``, ``shl`` or ``lshr`` of 64 bits and a constant."""
        return self._new(f"{operation} {self.whole_type} {a}, splat (i64 {constant})")

    def negative_sign(self, a: str) -> str:
        """The mask of what has a minus sign, -0 too."""
        return self._new(f"icmp slt {self.whole_type} {self.bits(a)}, zeroinitializer")


def sincos(e: Arithmetic, x: str) -> tuple[str, str]:
    """Sine and cosine of ``x``, rad; NaN beyond 1e15, where an angle in double precision means nothing.

    Args:
        e: Where the instructions go.
        x: Name of the angle.
    """
    x = e.select(e.less(e.mul(x, x), e.number(_LARGEST**2)), x, e.number(float("nan")))
    shift = e.number(ROUND)
    turns = e.sub(e.fma(x, e.number(0.31830988618379067154), shift), shift)  # nearest whole number of x / pi
    reduced = x
    for part in _PI:
        reduced = e.fma(turns, e.number(-part), reduced)
    half = e.mul(e.number(0.5), reduced)
    square = e.mul(half, half)
    sine = e.fma(half, e.mul(square, polynomial(e, _SINE, square)), half)
    cosine = e.fma(e.mul(square, square), polynomial(e, _COSINE, square), e.fma(e.number(-0.5), square, e.number(1.0)))
    pairs = e.sub(e.fma(turns, e.number(0.5), shift), shift)
    odd = e.fma(pairs, e.number(-2.0), turns)  # -1, 0 or 1
    sign = e.fma(e.mul(odd, odd), e.number(-2.0), e.number(1.0))
    return e.mul(sign, e.mul(e.add(sine, sine), cosine)), e.mul(sign, e.mul(e.sub(cosine, sine), e.add(cosine, sine)))


def polynomial(e: Arithmetic, coefficients: tuple[float, ...], x: str) -> str:
    """Its value, highest degree first."""
    value = e.number(coefficients[0])
    for c in coefficients[1:]:
        value = e.fma(value, x, e.number(c))
    return value
