"""Values of a program as expressions of JavaScript."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count
from string import ascii_letters

import casadi as ca

from holdfast.kernels.graph import OP_CONST, OP_INPUT, OP_SELECT, ValueGraph

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
    """

    text: str
    binds: int
    needs: tuple[int, ...]
    truths: tuple[bool, ...] = (False, False, False)
    truth: bool = False


def _call_form(name: str, count: int = 1) -> _OperationForm:
    places = ",".join(f"{{{k}}}" for k in range(count))
    return _OperationForm(f"{name}({places})", _BINDS_ATOM, (_BINDS_CHOICE,) * count)


JAVASCRIPT_FORMS = {
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
    ca.OP_SINH: _call_form("Math.sinh"),
    ca.OP_COSH: _call_form("Math.cosh"),
    ca.OP_TANH: _call_form("Math.tanh"),
    ca.OP_LOG1P: _call_form("Math.log1p"),
    ca.OP_EXPM1: _call_form("Math.expm1"),
    ca.OP_SIN: _call_form("sine"),
    ca.OP_COS: _call_form("cosine"),
    ca.OP_TAN: _call_form("tangent"),
    ca.OP_EXP: _call_form("exponential"),
    ca.OP_LOG: _call_form("logarithm"),
    ca.OP_POW: _call_form("power", 2),
    ca.OP_CONSTPOW: _call_form("power", 2),
    ca.OP_ASIN: _call_form("arcsine"),
    ca.OP_ACOS: _call_form("arccosine"),
    ca.OP_ATAN: _OperationForm("arctangent({0},1)", _BINDS_ATOM, (_BINDS_CHOICE,)),
    ca.OP_ATAN2: _call_form("arctangent", 2),
}
# Operations on the 64 bits of a number, as two words of 32 bits. They occur in functions, not in programs.
_WORD_FORMS = {
    "high": _call_form("highWord"),
    "low": _call_form("lowWord"),
    "join": _call_form("joinWords", 2),
    "add": JAVASCRIPT_FORMS[ca.OP_ADD],
    "and": _OperationForm("({0}&{1})", _BINDS_ATOM, (_BINDS_SUM, _BINDS_SUM)),
    "or": _OperationForm("({0}|{1})", _BINDS_ATOM, (_BINDS_SUM, _BINDS_SUM)),
    "shl": _OperationForm("({0}<<{1})", _BINDS_ATOM, (_BINDS_SUM, _BINDS_SUM)),
    "lshr": _OperationForm("({0}>>>{1})", _BINDS_ATOM, (_BINDS_SUM, _BINDS_SUM)),
}
WORD_OPERATIONS = {name: -10 - k for k, name in enumerate(_WORD_FORMS)}  # other numbers than those of CasADi and graph
_ALL_FORMS = JAVASCRIPT_FORMS | {WORD_OPERATIONS[name]: form for name, form in _WORD_FORMS.items()}


class NamedGraph(ValueGraph):
    """Values, and names for those that are used more than once.

    Attributes:
        named: Numbers of the named values.
        size: Number of operations in the expression of each value.
    """

    def __init__(self) -> None:
        super().__init__()
        self.named: set[int] = set()
        self.size: dict[int, int] = {}

    def name_values(self) -> None:
        """Choose the values that get a name, among those that are needed."""
        uses: Counter[int] = Counter()
        size = self.size
        for k in self.needed:
            node, form = self.nodes[k], self.operation_form(k)
            for place, a in enumerate(node.args):
                uses[a] += form.text.count(f"{{{place}}}") if form else 1
        for k in self.needed:
            inner = [a for a in self.nodes[k].args if a not in self.named]
            size[k] = int(self.nodes[k].op not in (OP_INPUT, OP_CONST)) + sum(size[a] for a in inner)
            if size[k] and (uses[k] > 1 or size[k] > _OPERATIONS_PER_EXPRESSION):
                self.named.add(k)

    def operation_form(self, k: int) -> _OperationForm | None:
        """Return the form of a value; None for an input, an output, or a constant."""
        return _ALL_FORMS.get(self.nodes[k].op)

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


def make_short_names() -> Iterator[str]:
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
