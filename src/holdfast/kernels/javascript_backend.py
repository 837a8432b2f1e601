"""Program -> JavaScript: the computation of a kernel in a browser.

V8 does not optimise a function of more than 60 kB of its own code, so a long program becomes several functions, which hand on
through an array what more than one of them needs. Measured with Node 20 on one core of a shared machine, ten sub-steps of the
failure-tolerant law: three links (4,300 CasADi operations) 29 us in functions of 100 operations, 20 of 200, 12 of 800 and more;
Panda's position (12,800 operations) 85 us in functions of 200, 57 of 1600, 1,300 as a single function. Values written once stay
inside the expression that reads them, which an engine skips on the side of a choice that is not taken.
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

from holdfast.kernels.graph import CONST, INPUT, OUTPUT, SELECT, Graph
from holdfast.kernels.program import Program

_PIECE = 1000  # operations in one function, about
_TREE = 60  # operations in one expression, at most: engines read expressions recursively

# Strength of binding, from loose to tight; -x has that of a sum, so that it is never written next to another sign.
_CHOICE, _OR, _AND, _EQUAL, _LESS, _SUM, _PRODUCT, _UNARY, _ATOM = range(1, 10)


@dataclass(frozen=True)
class _Form:
    """How an operation is written.

    Attributes:
        text: With ``{0}``, ``{1}``, ... for its arguments.
        binds: Strength of binding of the whole.
        needs: What each argument must bind at least.
        truths: For each argument, whether it is a condition rather than a number.
        truth: Whether the result is a condition.
        helper: Name of a function that the text calls.
    """

    text: str
    binds: int
    needs: tuple[int, ...]
    truths: tuple[bool, ...] = (False, False, False)
    truth: bool = False
    helper: str = ""


def _call(name: str, count: int = 1, helper: str = "") -> _Form:
    places = ",".join(f"{{{k}}}" for k in range(count))
    return _Form(f"{name}({places})", _ATOM, (_CHOICE,) * count, helper=helper)


_FORMS = {
    ca.OP_ADD: _Form("{0}+{1}", _SUM, (_SUM, _PRODUCT)),
    ca.OP_SUB: _Form("{0}-{1}", _SUM, (_SUM, _PRODUCT)),
    ca.OP_MUL: _Form("{0}*{1}", _PRODUCT, (_PRODUCT, _UNARY)),
    ca.OP_DIV: _Form("{0}/{1}", _PRODUCT, (_PRODUCT, _UNARY)),
    ca.OP_NEG: _Form("-{0}", _SUM, (_UNARY,)),
    ca.OP_SQ: _Form("{0}*{0}", _PRODUCT, (_UNARY,)),
    ca.OP_TWICE: _Form("2*{0}", _PRODUCT, (_UNARY,)),
    ca.OP_INV: _Form("1/{0}", _PRODUCT, (_UNARY,)),
    # As compiled code has them: a comparison with NaN is false, also "not equal"; a condition that is NaN counts as true.
    ca.OP_LT: _Form("{0}<{1}", _LESS, (_SUM, _SUM), truth=True),
    ca.OP_LE: _Form("{0}<={1}", _LESS, (_SUM, _SUM), truth=True),
    ca.OP_EQ: _Form("{0}==={1}", _EQUAL, (_LESS, _LESS), truth=True),
    ca.OP_NE: _Form("{0}<{1}||{0}>{1}", _OR, (_SUM, _SUM), truth=True),
    ca.OP_NOT: _Form("!{0}", _UNARY, (_UNARY,), (True,), truth=True),
    ca.OP_AND: _Form("{0}&&{1}", _AND, (_AND, _EQUAL), (True, True), truth=True),
    ca.OP_OR: _Form("{0}||{1}", _OR, (_OR, _AND), (True, True), truth=True),
    ca.OP_IF_ELSE_ZERO: _Form("{0}?{1}:0", _CHOICE, (_OR, _CHOICE), (True, False)),
    SELECT: _Form("{0}?{1}:{2}", _CHOICE, (_OR, _CHOICE, _CHOICE), (True, False, False)),
    ca.OP_SIGN: _Form("{0}>0?1:{0}<0?-1:0", _CHOICE, (_SUM,)),
    ca.OP_FMIN: _Form("{0}<={1}?{0}:{1}", _CHOICE, (_SUM, _SUM)),
    ca.OP_FMAX: _Form("{0}>={1}?{0}:{1}", _CHOICE, (_SUM, _SUM)),
    ca.OP_HYPOT: _Form("Math.sqrt({0}*{0}+{1}*{1})", _ATOM, (_UNARY, _UNARY)),
    ca.OP_FABS: _call("Math.abs"),
    ca.OP_SQRT: _call("Math.sqrt"),
    ca.OP_EXP: _call("Math.exp"),
    ca.OP_LOG: _call("Math.log"),
    ca.OP_ASIN: _call("Math.asin"),
    ca.OP_ACOS: _call("Math.acos"),
    ca.OP_ATAN: _call("Math.atan"),
    ca.OP_ATAN2: _call("Math.atan2", 2),
    ca.OP_SINH: _call("Math.sinh"),
    ca.OP_COSH: _call("Math.cosh"),
    ca.OP_TANH: _call("Math.tanh"),
    ca.OP_LOG1P: _call("Math.log1p"),
    ca.OP_EXPM1: _call("Math.expm1"),
    ca.OP_SIN: _call("sine", helper="sine"),
    ca.OP_COS: _call("cosine", helper="cosine"),
    ca.OP_TAN: _call("tangent", helper="tangent"),
    ca.OP_POW: _call("power", 2, "power"),
    ca.OP_CONSTPOW: _call("power", 2, "power"),
}

_HELPERS = {
    # An angle beyond 1e15 means nothing in double precision; see holdfast.kernels.llvm.arithmetic.
    "sine": "const sine=a=>a*a<1e30?Math.sin(a):NaN;",
    "cosine": "const cosine=a=>a*a<1e30?Math.cos(a):NaN;",
    "tangent": "const tangent=a=>a*a<1e30?Math.tan(a):NaN;",
    # C and IEEE 754 have 1 where JavaScript has NaN.
    "power": "const power=(a,b)=>a===1||a===-1&&(b===Infinity||b===-Infinity)?1:Math.pow(a,b);",
}


def javascript(program: Program, name: str) -> str:
    """JavaScript that computes a program: ``const NAME = (x, y) => ...``, strict, without allocation, needing nothing.

    ``x`` and ``y`` are two ``Float64Array``: the inputs are read from the first, the outputs written to the second, both
    in the order of the program. What comes out is what a :class:`holdfast.kernels.Kernel` gives, to rounding: NaN or
    infinity in an input makes every output NaN.

    Args:
        program: The computation.
        name: Of the constant.

    Raises:
        KernelError: An operation that has no row in the table; the message names it.
    """
    graph = _Graph(program)
    pieces, spilled = _pieces(graph)
    helpers = sorted({f.helper for f in map(graph.form, graph.needed) if f} - {""})
    calls = "".join(f"p{i}(x,y,w);" for i in range(len(pieces)))
    lines = [
        f"const {name}=(()=>{{",
        '"use strict";',
        *(_HELPERS[h] for h in helpers),
        f"const w=new Float64Array({spilled});",
        *(f"function p{i}(x,y,w){{\n{text}}}" for i, text in enumerate(pieces)),
        f"return (x,y)=>{{{calls}}};",
        "})();",
    ]
    return "\n".join(lines) + "\n"


class _Graph(Graph):
    """The values of a program, and which of them get a name: those that are written more than once.

    Attributes:
        named: Their numbers.
        size: Operations that an expression is written with.
    """

    def __init__(self, program: Program) -> None:
        super().__init__(program, "JavaScript", _FORMS.keys(), guarded=True)
        uses: Counter[int] = Counter()
        size: dict[int, int] = {}
        self.named: set[int] = set()
        for k in self.needed:
            node, form = self.nodes[k], self.form(k)
            for place, a in enumerate(node.args):
                uses[a] += form.text.count(f"{{{place}}}") if form else 1
        for k in self.needed:
            inner = [a for a in self.nodes[k].args if a not in self.named]
            size[k] = int(self.nodes[k].op not in (INPUT, CONST)) + sum(size[a] for a in inner)
            if size[k] and (uses[k] > 1 or size[k] > _TREE):
                self.named.add(k)
        self.size = size

    def form(self, k: int) -> _Form | None:
        """How a value is written; None for an input, an output or a constant."""
        return _FORMS.get(self.nodes[k].op)

    def leaves(self, k: int) -> Iterator[int]:
        """Named values that the expression of a value is written with."""
        for a in self.nodes[k].args:
            if a in self.named:
                yield a
            else:
                yield from self.leaves(a)

    def truth(self, k: int) -> bool:
        """Whether a value is a condition."""
        form = self.form(k)
        return form is not None and form.truth

    def text(self, k: int, names: dict[int, str], needs: int = _CHOICE, truth: bool = False, whole: bool = False) -> str:
        """The expression of a value.

        Args:
            k: The value.
            names: Of named values.
            needs: What it must bind at least; otherwise it gets brackets.
            truth: Whether a condition is wanted rather than a number.
            whole: Written out even if it has a name.
        """
        node, form = self.nodes[k], self.form(k)
        if k in names and not whole:
            text, binds = names[k], _ATOM
        elif form is None:
            text, binds = (f"x[{int(node.value)}]", _ATOM) if node.op == INPUT else _number(node.value)
        else:
            parts = [
                self.text(a, names, need, wanted) for a, need, wanted in zip(node.args, form.needs, form.truths, strict=False)
            ]
            text, binds = form.text.format(*parts), form.binds
        if truth and not self.truth(k):
            text, binds = (text if binds > _EQUAL else f"({text})") + "!==0", _EQUAL
        elif self.truth(k) and not truth:
            text, binds = (text if binds > _CHOICE else f"({text})") + "?1:0", _CHOICE
        return text if binds >= needs else f"({text})"


def _pieces(graph: _Graph) -> tuple[list[str], int]:
    """Bodies of functions, and how many numbers they hand on to each other.

    Engines do not optimise a function that is too long.
    """
    statements = [k for k in graph.needed if k in graph.named or graph.nodes[k].op == OUTPUT]
    total = sum(graph.size[k] for k in statements)
    pieces = max(1, -(-total // _PIECE))
    piece: dict[int, int] = {}
    done = 0
    for k in statements:
        piece[k] = min(done * pieces // total, pieces - 1)
        done += graph.size[k]
    last: dict[int, int] = {}  # named value -> last piece that reads it
    for k in statements:
        for a in graph.leaves(k):
            last[a] = piece[k]
    slot: dict[int, int] = {}
    free: list[int] = []
    spilled = 0
    bodies: list[str] = []
    for number in range(pieces):
        names: dict[int, str] = {}
        fresh = _names()
        lines: list[str] = []
        tail: list[str] = []
        for k in (s for s in statements if piece[s] == number):
            for a in graph.leaves(k):
                if a not in names:
                    names[a] = next(fresh)
                    stored = f"w[{slot[a]}]"
                    lines.append(f"{names[a]}={stored}" + ("!==0" if graph.truth(a) else ""))
            if graph.nodes[k].op == OUTPUT:
                tail.append(f"y[{int(graph.nodes[k].value)}]={graph.text(graph.nodes[k].args[0], names)};")
                continue
            text = graph.text(k, names, truth=graph.truth(k), whole=True)
            names[k] = next(fresh)
            if last[k] > number:
                if free:
                    slot[k] = heappop(free)
                else:
                    slot[k], spilled = spilled, spilled + 1
                if graph.truth(k):
                    tail.append(f"w[{slot[k]}]={names[k]}?1:0;")
                else:
                    text = f"w[{slot[k]}]={text}"
            lines.append(f"{names[k]}={text}")
        bodies.append(("const " + ",\n".join(lines) + ";\n" if lines else "") + "\n".join(tail) + "\n")
        for k in slot:
            if last[k] == number:
                heappush(free, slot[k])
    return bodies, spilled


def _names() -> Iterator[str]:
    """Short names other than words of the language and w, x, y."""
    letters = [c for c in ascii_letters if c not in "wxy"]
    yield from letters
    for number in count():
        for letter in ascii_letters:
            yield f"{letter}{number}"


def _number(value: float) -> tuple[str, int]:
    """A constant that reads back as the same double, and how it binds."""
    if math.isnan(value):
        return "NaN", _ATOM
    size = abs(value)
    text = "Infinity" if math.isinf(size) else str(int(size)) if size.is_integer() and size < 1e15 else repr(size)
    return (f"-{text}", _SUM) if math.copysign(1, value) < 0 else (text, _ATOM)
