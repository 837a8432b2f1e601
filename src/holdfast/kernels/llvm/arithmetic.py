"""Arithmetic as LLVM instructions, including sine and cosine together and without branches.

A library's functions switch to another method for very large angles, and a vector library switches for a whole group of rows if
one of them is large, infinite or NaN, so that its neighbours differ in the last digit. The functions here do the same
operations in every lane, and compute sine and cosine for little more than the cost of one of them (measured: the worst-case
index of the 9-joint PA10 gains 15 to 20 %).

Source: reduction by pi in three parts (W. J. Cody, W. Waite 1980), polynomials of fdlibm (``k_sin.c``, ``k_cos.c``)
at half the angle, then the formulas of the double angle. Largest absolute error 4.5e-16 for ``|x| <= 1e15`` (measured).
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

# pi in three parts; the first two end in zeros, so that products with whole numbers are exact.
_PI_PARTS = (2 * 1.57079632673412561417e00, 2 * 6.07710050630396597660e-11, 2 * 2.02226624879595063154e-21)
_SINE_COEFFICIENTS = (
    1.58969099521155010221e-10,
    -2.50507602534068634195e-08,
    2.75573137070700676789e-06,
    -1.98412698298579493134e-04,
    8.33333333332248946124e-03,
    -1.66666666666666324348e-01,
)
_COSINE_COEFFICIENTS = (
    -1.13596475577881948265e-11,
    2.08757232129817482790e-09,
    -2.75573143513906633035e-07,
    2.48015872894767294178e-05,
    -1.38888888888741095749e-03,
    4.16666666666666019037e-02,
)
ROUNDING_SHIFT = 6755399441055744.0  # 1.5 * 2^52: adding and subtracting it rounds to a whole number
BITS_OF_ONE = 0x3FF << 52
_LARGEST_ANGLE_RAD = 1e15


@dataclass(frozen=True)
class TargetMachine:
    """Properties of the processor on which the generated code depends.

    Attributes:
        lanes: Number of rows computed at once.
        fused: True if the machine has fused multiply-add.
    """

    lanes: int
    fused: bool


class Arithmetic:
    """Values of ``lanes`` doubles by their names in the text; a method adds an instruction and returns its name."""

    def __init__(self, machine: TargetMachine) -> None:
        self.machine = machine
        self.lines: list[str] = []
        self.type = f"<{machine.lanes} x double>"
        self.mask = f"<{machine.lanes} x i1>"
        self.whole_type = f"<{machine.lanes} x i64>"
        self.declared: set[str] = set()  # functions that are declared but not defined here

    def _add_instruction(self, text: str) -> str:
        name = f"%v{len(self.lines)}"
        self.lines.append(f"{name} = {text}")
        return name

    def constant(self, value: float) -> str:
        """Return a constant, bit for bit."""
        return f"splat (double 0x{struct.unpack('<Q', struct.pack('<d', value))[0]:016X})"

    def binary(self, operation: str, a: str, b: str) -> str:
        """Return the result of ``fadd``, ``fsub``, ``fmul`` or ``fdiv``."""
        return self._add_instruction(f"{operation} {self.type} {a}, {b}")

    def add(self, a: str, b: str) -> str:
        """Return the sum."""
        return self.binary("fadd", a, b)

    def sub(self, a: str, b: str) -> str:
        """Return the difference."""
        return self.binary("fsub", a, b)

    def mul(self, a: str, b: str) -> str:
        """Return the product."""
        return self.binary("fmul", a, b)

    def negate(self, a: str) -> str:
        """Return the negative."""
        return self._add_instruction(f"fneg {self.type} {a}")

    def fma(self, a: str, b: str, c: str) -> str:
        """Return the product of a and b plus c, rounded once if the machine can."""
        if not self.machine.fused:
            return self.add(self.mul(a, b), c)
        return self.intrinsic("fma", a, b, c)

    def intrinsic(self, name: str, *arguments: str) -> str:
        """Return the result of an LLVM intrinsic that all machines round alike: ``fma``, ``sqrt``, ``fabs``, ``copysign``."""
        name = f"@llvm.{name}.v{self.machine.lanes}f64"
        self.declared.add(f"declare {self.type} {name}({', '.join([self.type] * len(arguments))})")
        return self._add_instruction(f"call {self.type} {name}({', '.join(f'{self.type} {a}' for a in arguments)})")

    def compare_less(self, a: str, b: str) -> str:
        """Return the mask of a < b."""
        return self.compare("olt", a, b)

    def compare(self, predicate: str, a: str, b: str) -> str:
        """Return the mask of a comparison."""
        return self._add_instruction(f"fcmp {predicate} {self.type} {a}, {b}")

    def select(self, mask: str, a: str, b: str) -> str:
        """Return ``mask ? a : b``."""
        return self._add_instruction(f"select {self.mask} {mask}, {self.type} {a}, {self.type} {b}")

    def mask_and(self, a: str, b: str) -> str:
        """Return the mask that is true where both are."""
        return self._add_instruction(f"and {self.mask} {a}, {b}")

    def mask_or(self, a: str, b: str) -> str:
        """Return the mask that is true where at least one is."""
        return self._add_instruction(f"or {self.mask} {a}, {b}")

    def mask_not(self, a: str) -> str:
        """Return the negated mask."""
        return self._add_instruction(f"xor {self.mask} {a}, splat (i1 true)")

    def to_bits(self, a: str) -> str:
        """Return the 64 bits of a value."""
        return self._add_instruction(f"bitcast {self.type} {a} to {self.whole_type}")

    def from_bits(self, a: str) -> str:
        """Return the value of 64 bits."""
        return self._add_instruction(f"bitcast {self.whole_type} {a} to {self.type}")

    def integer_operation(self, operation: str, a: str, constant: int) -> str:
        """Return ``add``, ``and``, ``or``, ``shl`` or ``lshr`` of 64 bits and a constant."""
        return self._add_instruction(f"{operation} {self.whole_type} {a}, splat (i64 {constant})")

    def sign_bit_mask(self, a: str) -> str:
        """Return the mask of values with a minus sign, including -0."""
        return self._add_instruction(f"icmp slt {self.whole_type} {self.to_bits(a)}, zeroinitializer")


def emit_sine_and_cosine(e: Arithmetic, x: str) -> tuple[str, str]:
    """Return sine and cosine of ``x``, rad; NaN beyond 1e15, where an angle in double precision has no meaning.

    Args:
        e: Receiver of the instructions.
        x: Name of the angle.
    """
    x = e.select(e.compare_less(e.intrinsic("fabs", x), e.constant(_LARGEST_ANGLE_RAD)), x, e.constant(float("nan")))
    rounding_shift = e.constant(ROUNDING_SHIFT)
    # Nearest whole number of x / pi.
    shifted = e.fma(x, e.constant(0.31830988618379067154), rounding_shift)
    turns, reduced = e.sub(shifted, rounding_shift), x
    for part in _PI_PARTS:
        reduced = e.fma(turns, e.constant(-part), reduced)
    half = e.mul(e.constant(0.5), reduced)
    square = e.mul(half, half)
    sine = e.fma(half, e.mul(square, emit_polynomial(e, _SINE_COEFFICIENTS, square)), half)
    cosine = e.fma(
        e.mul(square, square),
        emit_polynomial(e, _COSINE_COEFFICIENTS, square),
        e.fma(e.constant(-0.5), square, e.constant(1.0)),
    )
    # The last bit of the number of turns is the sign bit of 1 or -1.
    sign = e.from_bits(e.integer_operation("or", e.integer_operation("shl", e.to_bits(shifted), 63), BITS_OF_ONE))
    return e.mul(sign, e.mul(e.add(sine, sine), cosine)), e.mul(sign, e.mul(e.sub(cosine, sine), e.add(cosine, sine)))


def emit_polynomial(e: Arithmetic, coefficients: tuple[float, ...], x: str) -> str:
    """Return the value of a polynomial, coefficients of the highest degree first."""
    value = e.constant(coefficients[0])
    for c in coefficients[1:]:
        value = e.fma(value, x, e.constant(c))
    return value
