"""Sine, exponential, and other functions in JavaScript, with the same bits in every engine.

ECMAScript leaves the digits of ``Math.sin`` and its like to the engine, but not those of sums, products, quotients and roots.
The functions here therefore come from the emitters of :mod:`holdfast.kernels.llvm`, which need these operations alone.
"""

from __future__ import annotations

import re
from functools import cache

import casadi as ca

from holdfast.kernels.graph import OP_CONST, OP_INPUT, OP_SELECT
from holdfast.kernels.javascript.expressions import WORD_OPERATIONS, NamedGraph, make_short_names
from holdfast.kernels.llvm.arithmetic import Arithmetic, TargetMachine, emit_sine_and_cosine
from holdfast.kernels.llvm.functions import EMITTED_FUNCTIONS

# Functions that are written by hand or by an emitter; each needs only functions before it.
_FUNCTION_TEXTS: dict[str, str | int] = {
    "bits": "const bits=new Float64Array(1),words=new Uint32Array(bits.buffer);",
    "highWord": "const highWord=a=>(bits[0]=a,words[1]);",
    "lowWord": "const lowWord=a=>(bits[0]=a,words[0]);",
    "joinWords": "const joinWords=(high,low)=>(words[1]=high,words[0]=low,bits[0]);",
    "copySign": "const copySign=(a,b)=>b<0||1/b<0?-Math.abs(a):Math.abs(a);",
    "exponential": ca.OP_EXP,
    "logarithm": ca.OP_LOG,
    "power": ca.OP_POW,
    "arcsine": ca.OP_ASIN,
    "arccosine": ca.OP_ACOS,
    "arctangent": ca.OP_ATAN2,
    # The latest angle with its sine and cosine, because most programs need both; 0 and -0 have the same.
    "turn": "const turn=new Float64Array(3).fill(NaN);",
    "turnTo": ca.OP_SIN,
    "sine": "const sine=a=>(a===turn[0]||turnTo(a),turn[1]);",
    "cosine": "const cosine=a=>(a===turn[0]||turnTo(a),turn[2]);",
    "tangent": "const tangent=a=>sine(a)/cosine(a);",
}


def define_functions(text: str) -> str:
    """Define sine, cosine, exponential, and other functions that a JavaScript text calls, each function in one line."""
    definitions = ""
    for name, source in reversed(_FUNCTION_TEXTS.items()):
        if re.search(rf"\b{name}[(\[]", text + definitions):
            definitions = f"{_write_function(name, source) if isinstance(source, int) else source}\n{definitions}"
    return definitions


@cache
def _write_function(name: str, op: int) -> str:
    """Write a function of x, or of x and y; the function of ``OP_SIN`` stores angle, sine and cosine in ``turn``."""
    e = _FunctionEmitter()
    x, y = (str(e.graph.add_node(OP_INPUT, value=k)) for k in range(2))
    results = emit_sine_and_cosine(e, x) if op == ca.OP_SIN else (EMITTED_FUNCTIONS[op](e, x, y),)
    graph, outputs = e.graph, [int(result) for result in results]
    graph.select_needed(outputs)
    graph.name_values()
    names, new_names, lines = {int(x): "x", int(y): "y"}, make_short_names(), []
    for k in (k for k in graph.needed if k in graph.named):
        text = graph.write_expression(k, names, as_condition=graph.is_condition(k))
        names[k] = next(new_names)
        lines.append(f"{names[k]}={text}")
    values = [graph.write_expression(k, names) for k in outputs]
    result = f"turn[0]=x;turn[1]={values[0]};turn[2]={values[-1]};" if op == ca.OP_SIN else f"return {values[0]};"
    arguments = "(x,y)" if int(y) in graph.needed else "x"
    return f"const {name}={arguments}=>{{const {','.join(lines)};{result}}};"


class _FunctionEmitter(Arithmetic):
    """Values of a function as numbers of graph nodes; the operations are those of a machine without fused multiply-add."""

    def __init__(self) -> None:
        super().__init__(TargetMachine(lanes=1, fused=False))
        self.graph = NamedGraph()

    def _add(self, op: int, *arguments: str) -> str:
        return str(self.graph.add_node(op, *map(int, arguments)))

    def constant(self, value: float) -> str:
        """Return a constant, bit for bit."""
        return str(self.graph.add_node(OP_CONST, value=float(value)))

    def binary(self, operation: str, a: str, b: str) -> str:
        """Return the result of ``fadd``, ``fsub``, ``fmul`` or ``fdiv``."""
        return self._add({"fadd": ca.OP_ADD, "fsub": ca.OP_SUB, "fmul": ca.OP_MUL, "fdiv": ca.OP_DIV}[operation], a, b)

    def negate(self, a: str) -> str:
        """Return the negative."""
        return self._add(ca.OP_NEG, a)

    def intrinsic(self, name: str, *arguments: str) -> str:
        """Return the result of ``sqrt``, ``fabs`` or ``copysign``."""
        if name == "sqrt":
            return self._add(ca.OP_SQRT, *arguments)
        size = self._add(ca.OP_FABS, arguments[0])
        return size if name == "fabs" else self.select(self.sign_bit_mask(arguments[1]), self.negate(size), size)

    def compare(self, predicate: str, a: str, b: str) -> str:
        """Return the mask of a comparison; the sign and the payload of NaN are not seen."""
        if predicate == "uno":
            return self.mask_or(*(self.mask_not(self.compare("oeq", x, x)) for x in (a, b)))
        a, b = (b, a) if predicate in ("ogt", "oge") else (a, b)
        return self._add(ca.OP_EQ if predicate == "oeq" else ca.OP_LT if predicate in ("olt", "ogt") else ca.OP_LE, a, b)

    def select(self, mask: str, a: str, b: str) -> str:
        """Return ``mask ? a : b``."""
        return self._add(OP_SELECT, mask, a, b)

    def mask_and(self, a: str, b: str) -> str:
        """Return the mask that is true where both are."""
        return self._add(ca.OP_AND, a, b)

    def mask_or(self, a: str, b: str) -> str:
        """Return the mask that is true where at least one is."""
        return self._add(ca.OP_OR, a, b)

    def mask_not(self, a: str) -> str:
        """Return the negated mask."""
        return self._add(ca.OP_NOT, a)

    def sign_bit_mask(self, a: str) -> str:
        """Return the mask of values with a minus sign, including -0."""
        zero = self.constant(0.0)
        return self.mask_or(self.compare_less(a, zero), self.compare_less(self._add(ca.OP_INV, a), zero))

    def to_bits(self, a: str) -> str:
        """Return the high and the low word of a value."""
        return f"{self._add(WORD_OPERATIONS['high'], a)} {self._add(WORD_OPERATIONS['low'], a)}"

    def from_bits(self, a: str) -> str:
        """Return the value of two words."""
        return self._add(WORD_OPERATIONS["join"], *a.split())

    def integer_operation(self, operation: str, a: str, constant: int) -> str:
        """Return the words after ``add``, ``and``, ``or``, or a shift by 32 bits or more; no constant changes the low word."""
        high, low = a.split()
        word, zero = WORD_OPERATIONS[operation], self.constant(0.0)
        if operation in ("shl", "lshr"):
            assert constant >= 32, "the other shifts mix both words"
            moved = self._add(word, low if operation == "shl" else high, self.constant(constant - 32.0))
            return f"{moved} {zero}" if operation == "shl" else f"{zero} {moved}"
        assert constant & 0xFFFFFFFF == (0xFFFFFFFF if operation == "and" else 0), "the constant changes the low word"
        return f"{self._add(word, high, self.constant(constant >> 32))} {low}"
