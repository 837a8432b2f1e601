"""Translate a program to JavaScript for a browser.

V8 does not optimise a function with more than 60 kB of code, so a long program becomes several functions, which share values
through an array. Measured with Node 20 on one core of a shared machine, ten sub-steps of the failure-tolerant law: three links
(4,300 CasADi operations) 29 us in functions of 100 operations, 20 of 200, 12 of 800 and more; Panda's position (12,800
operations) 85 us in functions of 200, 57 of 1600, 1,300 as a single function. A value that is used once stays inside the
expression that reads it, which an engine skips if the other branch of a choice is taken.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from heapq import heappop, heappush
from itertools import count
from string import ascii_letters

import casadi as ca

from holdfast.kernels.graph import OP_CONST, OP_INPUT, OP_OUTPUT, OP_SELECT, ValueGraph
from holdfast.kernels.program import Program

_OPERATIONS_PER_FUNCTION = 1000  # approximate operations in one function
_OPERATIONS_PER_EXPRESSION = 60  # maximum operations in one expression, because engines parse expressions recursively

# Operator precedence, from weak to strong; -x has that of a sum, so that it is never written next to another sign.
_BINDS_CHOICE = 1
_BINDS_OR = 2
_BINDS_AND = 3
_BINDS_EQUAL = 4
_BINDS_LESS = 5
_BINDS_SUM = 6
_BINDS_PRODUCT = 7
_BINDS_UNARY = 8
_BINDS_ATOM = 9


@dataclass(frozen=True)
class _OperationForm:
    """JavaScript form of an operation.

    Attributes:
        text: Code with ``{0}``, ``{1}``, ... for the arguments.
        binds: Precedence of the whole.
        needs: Minimum precedence of each argument.
        truths: For each argument, True if it is a condition rather than a number.
        truth: True if the result is a condition.
        helper: Name of a function that the code calls.
    """

    text: str
    binds: int
    needs: tuple[int, ...]
    truths: tuple[bool, ...] = (False, False, False)
    truth: bool = False
    helper: str = ""


def _call_form(name: str, count: int = 1, helper: str = "") -> _OperationForm:
    places = ",".join(f"{{{k}}}" for k in range(count))
    return _OperationForm(f"{name}({places})", _BINDS_ATOM, (_BINDS_CHOICE,) * count, helper=helper)


_JAVASCRIPT_FORMS = {
    ca.OP_ADD: _OperationForm("{0}+{1}", _BINDS_SUM, (_BINDS_SUM, _BINDS_PRODUCT)),
    ca.OP_SUB: _OperationForm("{0}-{1}", _BINDS_SUM, (_BINDS_SUM, _BINDS_PRODUCT)),
    ca.OP_MUL: _OperationForm("{0}*{1}", _BINDS_PRODUCT, (_BINDS_PRODUCT, _BINDS_UNARY)),
    ca.OP_DIV: _OperationForm("{0}/{1}", _BINDS_PRODUCT, (_BINDS_PRODUCT, _BINDS_UNARY)),
    ca.OP_NEG: _OperationForm("-{0}", _BINDS_SUM, (_BINDS_UNARY,)),
    ca.OP_SQ: _OperationForm("{0}*{0}", _BINDS_PRODUCT, (_BINDS_UNARY,)),
    ca.OP_TWICE: _OperationForm("2*{0}", _BINDS_PRODUCT, (_BINDS_UNARY,)),
    ca.OP_INV: _OperationForm("1/{0}", _BINDS_PRODUCT, (_BINDS_UNARY,)),
    # As in compiled code, a comparison with NaN is false, also "not equal", and a condition that is NaN counts as true.
    ca.OP_LT: _OperationForm("{0}<{1}", _BINDS_LESS, (_BINDS_SUM, _BINDS_SUM), truth=True),
    ca.OP_LE: _OperationForm("{0}<={1}", _BINDS_LESS, (_BINDS_SUM, _BINDS_SUM), truth=True),
    ca.OP_EQ: _OperationForm("{0}==={1}", _BINDS_EQUAL, (_BINDS_LESS, _BINDS_LESS), truth=True),
    ca.OP_NE: _OperationForm("{0}<{1}||{0}>{1}", _BINDS_OR, (_BINDS_SUM, _BINDS_SUM), truth=True),
    ca.OP_NOT: _OperationForm("!{0}", _BINDS_UNARY, (_BINDS_UNARY,), (True,), truth=True),
    ca.OP_AND: _OperationForm("{0}&&{1}", _BINDS_AND, (_BINDS_AND, _BINDS_EQUAL), (True, True), truth=True),
    ca.OP_OR: _OperationForm("{0}||{1}", _BINDS_OR, (_BINDS_OR, _BINDS_AND), (True, True), truth=True),
    ca.OP_IF_ELSE_ZERO: _OperationForm("{0}?{1}:0", _BINDS_CHOICE, (_BINDS_OR, _BINDS_CHOICE), (True, False)),
    OP_SELECT: _OperationForm("{0}?{1}:{2}", _BINDS_CHOICE, (_BINDS_OR, _BINDS_CHOICE, _BINDS_CHOICE), (True, False, False)),
    ca.OP_SIGN: _OperationForm("{0}>0?1:{0}<0?-1:0", _BINDS_CHOICE, (_BINDS_SUM,)),
    ca.OP_FMIN: _OperationForm("{0}<={1}?{0}:{1}", _BINDS_CHOICE, (_BINDS_SUM, _BINDS_SUM)),
    ca.OP_FMAX: _OperationForm("{0}>={1}?{0}:{1}", _BINDS_CHOICE, (_BINDS_SUM, _BINDS_SUM)),
    ca.OP_HYPOT: _OperationForm("Math.sqrt({0}*{0}+{1}*{1})", _BINDS_ATOM, (_BINDS_UNARY, _BINDS_UNARY)),
    ca.OP_FABS: _call_form("Math.abs"),
    ca.OP_SQRT: _call_form("Math.sqrt"),
    ca.OP_EXP: _call_form("Math.exp"),
    ca.OP_LOG: _call_form("Math.log"),
    ca.OP_ASIN: _call_form("Math.asin"),
    ca.OP_ACOS: _call_form("Math.acos"),
    ca.OP_ATAN: _call_form("Math.atan"),
    ca.OP_ATAN2: _call_form("Math.atan2", 2),
    ca.OP_SINH: _call_form("Math.sinh"),
    ca.OP_COSH: _call_form("Math.cosh"),
    ca.OP_TANH: _call_form("Math.tanh"),
    ca.OP_LOG1P: _call_form("Math.log1p"),
    ca.OP_EXPM1: _call_form("Math.expm1"),
    ca.OP_SIN: _call_form("sine", helper="sine"),
    ca.OP_COS: _call_form("cosine", helper="cosine"),
    ca.OP_TAN: _call_form("tangent", helper="tangent"),
    ca.OP_POW: _call_form("power", 2, "power"),
    ca.OP_CONSTPOW: _call_form("power", 2, "power"),
}

_HELPER_FUNCTIONS = {
    # An angle beyond 1e15 has no meaning in double precision; see holdfast.kernels.llvm.arithmetic.
    "sine": "const sine=a=>a*a<1e30?Math.sin(a):NaN;",
    "cosine": "const cosine=a=>a*a<1e30?Math.cos(a):NaN;",
    "tangent": "const tangent=a=>a*a<1e30?Math.tan(a):NaN;",
    # C and IEEE 754 return 1 where JavaScript returns NaN.
    "power": "const power=(a,b)=>a===1||a===-1&&(b===Infinity||b===-Infinity)?1:Math.pow(a,b);",
}


def write_javascript(program: Program, name: str) -> str:
    """Write a program in JavaScript: ``const NAME = (x, y) => ...``, strict, without allocation or dependencies.

    ``x`` and ``y`` are two ``Float64Array``: the inputs are read from the first, and the outputs are written to the second,
    both in the order of the program. Up to rounding, the outputs equal those of a :class:`holdfast.kernels.Kernel`; NaN or
    infinity in an input makes every output NaN.

    Args:
        program: Program to translate.
        name: Name of the constant.

    Raises:
        KernelError: The program has an operation without a JavaScript form; the message names it.
    """
    graph = _NamedGraph(program)
    pieces, spilled = _write_functions(graph)
    helpers = sorted({f.helper for f in map(graph.operation_form, graph.needed) if f} - {""})
    calls = "".join(f"p{i}(x,y,w);" for i in range(len(pieces)))
    lines = [
        f"const {name}=(()=>{{",
        '"use strict";',
        *(_HELPER_FUNCTIONS[h] for h in helpers),
        f"const w=new Float64Array({spilled});",
        *(f"function p{i}(x,y,w){{\n{text}}}" for i, text in enumerate(pieces)),
        f"return (x,y)=>{{{calls}}};",
        "})();",
    ]
    return "\n".join(lines) + "\n"


class _NamedGraph(ValueGraph):
    """Values of a program, and names for those that are used more than once.

    Attributes:
        named: Numbers of the named values.
        size: Number of operations in the expression of each value.
    """

    def __init__(self, program: Program) -> None:
        super().__init__(program, "JavaScript", _JAVASCRIPT_FORMS.keys(), guarded=True)
        uses: Counter[int] = Counter()
        size: dict[int, int] = {}
        self.named: set[int] = set()
        for k in self.needed:
            node, form = self.nodes[k], self.operation_form(k)
            for place, a in enumerate(node.args):
                uses[a] += form.text.count(f"{{{place}}}") if form else 1
        for k in self.needed:
            inner = [a for a in self.nodes[k].args if a not in self.named]
            size[k] = int(self.nodes[k].op not in (OP_INPUT, OP_CONST)) + sum(size[a] for a in inner)
            if size[k] and (uses[k] > 1 or size[k] > _OPERATIONS_PER_EXPRESSION):
                self.named.add(k)
        self.size = size

    def operation_form(self, k: int) -> _OperationForm | None:
        """Return the form of a value; None for an input, an output, or a constant."""
        return _JAVASCRIPT_FORMS.get(self.nodes[k].op)

    def named_operands(self, k: int) -> Iterator[int]:
        """Yield the named values in the expression of a value."""
        for a in self.nodes[k].args:
            if a in self.named:
                yield a
            else:
                yield from self.named_operands(a)

    def is_condition(self, k: int) -> bool:
        """Return whether a value is a condition."""
        form = self.operation_form(k)
        return form is not None and form.truth

    def write_expression(
        self,
        k: int,
        names: dict[int, str],
        min_binding: int = _BINDS_CHOICE,
        as_condition: bool = False,
        ignore_own_name: bool = False,
    ) -> str:
        """Write the expression of a value.

        Args:
            k: Number of the value.
            names: Names of the named values.
            min_binding: Minimum precedence; a weaker expression gets brackets.
            as_condition: Return a condition rather than a number.
            ignore_own_name: Write the expression even if the value has a name.
        """
        node, form = self.nodes[k], self.operation_form(k)
        if k in names and not ignore_own_name:
            text, binds = names[k], _BINDS_ATOM
        elif form is None:
            text, binds = (f"x[{int(node.value)}]", _BINDS_ATOM) if node.op == OP_INPUT else _number_and_binding(node.value)
        else:
            parts = [
                self.write_expression(a, names, need, wanted)
                for a, need, wanted in zip(node.args, form.needs, form.truths, strict=False)
            ]
            text, binds = form.text.format(*parts), form.binds
        if as_condition and not self.is_condition(k):
            text, binds = (text if binds > _BINDS_EQUAL else f"({text})") + "!==0", _BINDS_EQUAL
        elif self.is_condition(k) and not as_condition:
            text, binds = (text if binds > _BINDS_CHOICE else f"({text})") + "?1:0", _BINDS_CHOICE
        return text if binds >= min_binding else f"({text})"


def _write_functions(graph: _NamedGraph) -> tuple[list[str], int]:
    """Return the bodies of functions, and the number of values that they share.

    Engines do not optimise functions that are too long.
    """
    statements = [k for k in graph.needed if k in graph.named or graph.nodes[k].op == OP_OUTPUT]
    total = sum(graph.size[k] for k in statements)
    pieces = max(1, -(-total // _OPERATIONS_PER_FUNCTION))
    piece: dict[int, int] = {}
    done = 0
    for k in statements:
        piece[k] = min(done * pieces // total, pieces - 1)
        done += graph.size[k]
    last_use: dict[int, int] = {}  # named value -> last piece that reads it
    for k in statements:
        for a in graph.named_operands(k):
            last_use[a] = piece[k]
    slot: dict[int, int] = {}
    free: list[int] = []
    spilled = 0
    bodies: list[str] = []
    for number in range(pieces):
        names: dict[int, str] = {}
        new_names = _short_names()
        lines: list[str] = []
        tail: list[str] = []
        for k in (s for s in statements if piece[s] == number):
            for a in graph.named_operands(k):
                if a not in names:
                    names[a] = next(new_names)
                    stored = f"w[{slot[a]}]"
                    lines.append(f"{names[a]}={stored}" + ("!==0" if graph.is_condition(a) else ""))
            if graph.nodes[k].op == OP_OUTPUT:
                tail.append(f"y[{int(graph.nodes[k].value)}]={graph.write_expression(graph.nodes[k].args[0], names)};")
                continue
            text = graph.write_expression(k, names, as_condition=graph.is_condition(k), ignore_own_name=True)
            names[k] = next(new_names)
            if last_use[k] > number:
                if free:
                    slot[k] = heappop(free)
                else:
                    slot[k], spilled = spilled, spilled + 1
                if graph.is_condition(k):
                    tail.append(f"w[{slot[k]}]={names[k]}?1:0;")
                else:
                    text = f"w[{slot[k]}]={text}"
            lines.append(f"{names[k]}={text}")
        bodies.append(("const " + ",\n".join(lines) + ";\n" if lines else "") + "\n".join(tail) + "\n")
        for k in slot:
            if last_use[k] == number:
                heappush(free, slot[k])
    return bodies, spilled


def _short_names() -> Iterator[str]:
    """Yield short names except reserved words of the language and w, x, y."""
    letters = [c for c in ascii_letters if c not in "wxy"]
    yield from letters
    for number in count():
        for letter in ascii_letters:
            yield f"{letter}{number}"


def _number_and_binding(value: float) -> tuple[str, int]:
    """Return a constant that reads back as the same double, and its precedence."""
    if math.isnan(value):
        return "NaN", _BINDS_ATOM
    size = abs(value)
    text = "Infinity" if math.isinf(size) else str(int(size)) if size.is_integer() and size < 1e15 else repr(size)
    return (f"-{text}", _BINDS_SUM) if math.copysign(1, value) < 0 else (text, _BINDS_ATOM)
