"""Program -> text of an LLVM function: straight-line vector code over the rows of a batch, for any machine.

The same graph gives the same bits on every level of optimisation and for every number of lanes: products are contracted with
sums here, by a rule of our own, and nothing is left to the compiler that could change a rounding. What differs between
machines is only whether they have fused multiply-add.

Sources: LLVM language reference for the instructions; the contraction is what C calls ``FP_CONTRACT`` (C17, 6.5).
"""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca

from holdfast.errors import KernelError
from holdfast.kernels.llvm.arithmetic import Arithmetic, Machine, sincos
from holdfast.kernels.llvm.functions import FUNCTIONS
from holdfast.kernels.program import OP_NAMES, Program

NAME = "rows"  # of the function

# A comparison with NaN is false, also "not equal"; a condition that is NaN counts as true.
_COMPARISONS = {ca.OP_LT: "olt", ca.OP_LE: "ole", ca.OP_EQ: "oeq", ca.OP_NE: "one"}


def emit(program: Program, machine: Machine) -> str:
    """The function ``void rows(in, out, stride, n)`` as text.

    Input k of row i is ``in[k * stride + i]``, output k ``out[k * stride + i]``; n is a multiple of the lanes.

    Raises:
        KernelError: The program uses an operation that has no translation; the message names it.
    """
    return Emitter(program, machine).text()


class Emitter(Arithmetic):
    """One program on its way."""

    def __init__(self, program: Program, machine: Machine) -> None:
        super().__init__(machine)
        self.program = program
        self._angles: dict[str, tuple[str, str]] = {}
        self._masks: dict[str, str] = {}  # value 0 or 1, or any -> its mask
        self._nots: dict[str, str] = {}  # mask -> the mask it negates
        self._choices: dict[str, tuple[str, str]] = {}  # "condition ? a : 0" -> mask, a
        self._products: dict[str, tuple[str, str]] = {}  # products that wait for the sum they go into

    # ---- frame -------------------------------------------------------------------------------------------------

    def text(self) -> str:
        """The whole function."""
        guard = self.guard()
        self.body(guard)
        lanes = self.machine.lanes
        head, body = "\n".join(sorted(self.declared)), "\n".join(self.lines)
        return f"""{head}
define void @{NAME}(ptr noalias %in, ptr noalias %out, i64 %stride, i64 %n) nounwind {{
entry:
%some = icmp ugt i64 %n, 0
br i1 %some, label %loop, label %end
loop:
%i = phi i64 [0, %entry], [%after, %loop]
{body}
%after = add i64 %i, {lanes}
%more = icmp ult i64 %after, %n
br i1 %more, label %loop, label %end
end:
ret void
}}
"""

    def _place(self, base: str, k: int) -> str:
        row = self._new(f"mul i64 %stride, {k}")
        at = self._new(f"add i64 {row}, %i")
        return self._new(f"getelementptr double, ptr {base}, i64 {at}")

    def _load(self, k: int) -> str:
        return self._new(f"load {self.type}, ptr {self._place('%in', k)}, align 8")

    def _store(self, k: int, value: str) -> None:
        self.lines.append(f"store {self.type} {value}, ptr {self._place('%out', k)}, align 8")

    def guard(self) -> str:
        """Zero, or NaN in rows with an input that is not finite, also one that the expression ignores."""
        total = zero = self.number(0.0)
        for k in range(self.program.n_in):
            total = self.add(self.mul(self._load(k), zero), total)
        return total

    # ---- instructions ------------------------------------------------------------------------------------------

    def body(self, guard: str) -> None:
        """All instructions; ``guard`` is added to each output."""
        work: dict[int, str] = {}
        alone = _used_once_in_a_sum(self.program)
        divisors = self.program.shared_divisors()
        reciprocals: dict[int, str] = {}
        for k, row in enumerate(self.program.instructions):
            op = row.op
            if op == ca.OP_CONST:
                work[row.output] = self.number(row.constant)
                continue
            if op == ca.OP_INPUT:
                work[row.output] = self._load(row.inputs[0])
                continue
            a, *others = (work[i] for i in row.inputs)
            if op == ca.OP_OUTPUT:
                self._store(row.output, self.add(a, guard))
                continue
            b = others[0] if others else a
            if k in divisors:
                # CasADi writes x (1/y) as x / y. One division serves all.
                made = divisors[k]
                if made not in reciprocals:
                    reciprocals[made] = self.binary("fdiv", self.number(1.0), b)
                shared = reciprocals[made]
                result = shared if op == ca.OP_INV else self._product(k in alone, a, shared)
            elif op == ca.OP_ADD:
                result = self._choice(a, b) or self._sum(a, b)
            elif op == ca.OP_SUB:
                result = self._difference(a, b)
            elif op in (ca.OP_MUL, ca.OP_SQ):
                result = self._product(k in alone, a, b)
            else:
                result = self._other(k, op, a, b)
            work[row.output] = result

    def _product(self, waits: bool, a: str, b: str) -> str:
        if not waits or not self.machine.fused:
            return self.mul(a, b)
        name = f"%p{len(self._products)}"
        self._products[name] = a, b
        return name

    def _known(self, a: str) -> str:
        """The value of a product that waited for a sum which takes another one."""
        return self.mul(*self._products[a]) if a in self._products else a

    def _sum(self, a: str, b: str) -> str:
        if a in self._products:
            return self.fma(*self._products[a], self._known(b))
        if b in self._products:
            return self.fma(*self._products[b], a)
        return self.add(a, b)

    def _difference(self, a: str, b: str) -> str:
        if b in self._products:
            x, y = self._products[b]
            return self.fma(self.negative(x), y, self._known(a))
        if a in self._products:
            return self.fma(*self._products[a], self.negative(b))
        return self.sub(a, b)

    def _choice(self, a: str, b: str) -> str | None:
        """CasADi writes ``c ? x : y`` as ``(c ? x : 0) + (!c ? y : 0)``; one select instead of four operations."""
        if a not in self._choices or b not in self._choices:
            return None
        (c, x), (d, y) = self._choices[a], self._choices[b]
        if self._nots.get(d) == c:
            return self.select(c, x, y)
        if self._nots.get(c) == d:
            return self.select(d, y, x)
        return None

    def _other(self, k: int, op: int, a: str, b: str) -> str:
        if op in _COMPARISONS:
            return self.truth(self.compare(_COMPARISONS[op], a, b))
        if op in FUNCTIONS:
            return FUNCTIONS[op](self, a, b)
        if op in (ca.OP_SIN, ca.OP_COS, ca.OP_TAN):
            if a not in self._angles:
                self._angles[a] = sincos(self, a)
            sine, cosine = self._angles[a]
            return {ca.OP_SIN: sine, ca.OP_COS: cosine}.get(op) or self.binary("fdiv", sine, cosine)
        one = _TABLE.get(op)
        if one is None:
            raise KernelError(
                f"kernel '{self.program.name}': instruction {k} is CasADi operation {OP_NAMES[op]}, which the llvm "
                "backend does not have; write the expression with operations listed in docs/extending"
            )
        return one(self, a, b)

    # ---- conditions --------------------------------------------------------------------------------------------

    def truth(self, mask: str) -> str:
        """1 where a mask is true, else 0."""
        value = self.select(mask, self.number(1.0), self.number(0.0))
        self._masks[value] = mask
        return value

    def condition(self, a: str) -> str:
        """The mask of a value: true where it is not 0, and where it is NaN."""
        if a not in self._masks:
            self._masks[a] = self.compare("une", a, self.number(0.0))
        return self._masks[a]

    def no(self, a: str) -> str:
        """1 where a is 0, else 0."""
        if a in self._masks:
            mask = self.opposite(self._masks[a])
            self._nots[mask] = self._masks[a]
        else:
            mask = self.compare("oeq", a, self.number(0.0))
            self._nots[mask] = self.condition(a)
        return self.truth(mask)

    def or_zero(self, c: str, a: str) -> str:
        """``c ? a : 0``."""
        mask = self.condition(c)
        value = self.select(mask, a, self.number(0.0))
        self._choices[value] = mask, a
        return value


# What takes one instruction or few. CasADi differentiates |x| into sign(x).
_TABLE: dict[int, Callable[[Emitter, str, str], str]] = {
    ca.OP_ASSIGN: lambda e, a, b: a,
    ca.OP_DIV: lambda e, a, b: e.binary("fdiv", a, b),
    ca.OP_NEG: lambda e, a, b: e.negative(a),
    ca.OP_SQRT: lambda e, a, b: e.intrinsic("sqrt", a),
    ca.OP_FABS: lambda e, a, b: e.intrinsic("fabs", a),
    ca.OP_TWICE: lambda e, a, b: e.add(a, a),
    ca.OP_INV: lambda e, a, b: e.binary("fdiv", e.number(1.0), a),
    ca.OP_NOT: lambda e, a, b: e.no(a),
    ca.OP_AND: lambda e, a, b: e.truth(e.both(e.condition(a), e.condition(b))),
    ca.OP_OR: lambda e, a, b: e.truth(e.either(e.condition(a), e.condition(b))),
    ca.OP_IF_ELSE_ZERO: lambda e, a, b: e.or_zero(a, b),
    ca.OP_SIGN: lambda e, a, b: e.select(
        e.compare("ogt", a, e.number(0.0)),
        e.number(1.0),
        e.select(e.less(a, e.number(0.0)), e.number(-1.0), e.number(0.0)),
    ),
    ca.OP_FMIN: lambda e, a, b: e.select(e.compare("ole", a, b), a, b),
    ca.OP_FMAX: lambda e, a, b: e.select(e.compare("oge", a, b), a, b),
    ca.OP_HYPOT: lambda e, a, b: e.intrinsic("sqrt", e.fma(a, a, e.mul(b, b))),
}

OPERATIONS = frozenset(
    {ca.OP_CONST, ca.OP_INPUT, ca.OP_OUTPUT, ca.OP_ADD, ca.OP_SUB, ca.OP_MUL, ca.OP_SQ, ca.OP_SIN, ca.OP_COS, ca.OP_TAN}
    | FUNCTIONS.keys()
    | _COMPARISONS.keys()
    | _TABLE.keys()
)


def _used_once_in_a_sum(program: Program) -> set[int]:
    """Instructions whose result goes into one sum or difference and nowhere else."""
    made: dict[int, int] = {}
    uses: dict[int, int] = {}
    sums: set[int] = set()
    for k, row in enumerate(program.instructions):
        if row.op not in (ca.OP_INPUT, ca.OP_CONST):
            for slot in row.inputs:
                source = made[slot]
                uses[source] = uses.get(source, 0) + 1
                if row.op in (ca.OP_ADD, ca.OP_SUB):
                    sums.add(source)
        if row.op != ca.OP_OUTPUT:
            made[row.output] = k
    return {k for k in sums if uses[k] == 1}
