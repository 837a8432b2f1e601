"""Program as a graph of values, each computed once, from which text in another language is written."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass

import casadi as ca

from holdfast.core.errors import KernelError
from holdfast.kernels.program import OP_NAMES, Program

# OP_SELECT, OP_INPUT, OP_CONST and OP_OUTPUT: in addition to the operations of CasADi
OP_SELECT = -4
OP_INPUT = -3
OP_CONST = -2
OP_OUTPUT = -1


@dataclass(frozen=True)
class GraphNode:
    """Value: an operation, the numbers of its arguments, and the number of its input or output, or the constant."""

    op: int
    args: tuple[int, ...] = ()
    value: float = 0.0


class ValueGraph:
    """Values, each computed once, in a valid order.

    Attributes:
        nodes: Values, each after its arguments.
        needed: Numbers of the values that an output needs, in order.
    """

    def __init__(self) -> None:
        self.nodes: list[GraphNode] = []
        self.needed: list[int] = []
        self._known: dict[tuple[GraphNode, float], int] = {}

    def add_program(self, program: Program, language: str, operations: Collection[int], *, guarded: bool) -> None:
        """Add the values of a program and select those that its outputs need.

        Args:
            program: Program.
            language: Name of the target language.
            operations: Operations of the target language.
            guarded: If True, NaN or infinity in any input makes every output NaN, as in a kernel.

        Raises:
            KernelError: The language does not have an operation of the program; the message names it.
        """
        work: dict[int, int] = {}
        inputs = [self.add_node(OP_INPUT, value=i) for i in range(program.n_in)]
        if guarded:  # the guard must reach every output, even if its expression ignores that input
            guard = zero = self.add_node(OP_CONST, value=0.0)
            for term in inputs:
                guard = self.add_node(ca.OP_ADD, guard, self.add_node(ca.OP_MUL, term, zero))
        divisors = program.shared_divisors()
        outputs: list[int] = []
        for k, row in enumerate(program.instructions):
            args = tuple(work[i] for i in row.inputs) if row.op != ca.OP_INPUT else ()
            if row.op == ca.OP_INPUT:
                work[row.output] = inputs[row.inputs[0]]
            elif row.op == ca.OP_CONST:
                work[row.output] = self.add_node(OP_CONST, value=row.constant)
            elif row.op == ca.OP_ASSIGN:
                work[row.output] = args[0]
            elif row.op == ca.OP_OUTPUT:
                guarded_value = self.add_node(ca.OP_ADD, args[0], guard) if guarded else args[0]
                outputs.append(self.add_node(OP_OUTPUT, guarded_value, value=row.output))
            elif row.op not in operations:
                raise KernelError(
                    f"kernel '{program.name}': instruction {k} is CasADi operation {OP_NAMES[row.op]}, which {language} does "
                    "not have; write the expression with operations listed in docs/project/own-index"
                )
            elif k in divisors:
                shared = self.add_node(ca.OP_INV, args[-1])
                work[row.output] = shared if row.op == ca.OP_INV else self.add_node(ca.OP_MUL, args[0], shared)
            elif row.op == ca.OP_ADD:
                work[row.output] = self.add_node(*(self._merge_choice(*args) or (ca.OP_ADD, *args)))
            else:
                work[row.output] = self.add_node(row.op, *args)
        self.select_needed(outputs)

    def select_needed(self, outputs: list[int]) -> None:
        """Set :attr:`needed` to the values from which the outputs are computed, including them."""
        reached, stack = set(outputs), list(outputs)
        while stack:
            for a in self.nodes[stack.pop()].args:
                if a not in reached:
                    reached.add(a)
                    stack.append(a)
        self.needed = sorted(reached)

    def add_node(self, op: int, *args: int, value: float = 0.0) -> int:
        """Return the number of a value; the value is added if it is new."""
        node = GraphNode(op, args, value)
        key = node, math.copysign(1.0, value)  # 0 and -0 are different constants
        if key not in self._known:
            self._known[key] = len(self.nodes)
            self.nodes.append(node)
        return self._known[key]

    def _merge_choice(self, x: int, y: int) -> tuple[int, int, int, int] | None:
        """Merge to one choice CasADi's form of ``c ? a : b``, which is ``(c ? a : 0) + (!c ? b : 0)`` with four operations."""
        first, second = self.nodes[x], self.nodes[y]
        if first.op != ca.OP_IF_ELSE_ZERO or second.op != ca.OP_IF_ELSE_ZERO:
            return None
        (c, a), (d, b) = first.args, second.args
        if self.nodes[d] == GraphNode(ca.OP_NOT, (c,)):
            return OP_SELECT, c, a, b
        if self.nodes[c] == GraphNode(ca.OP_NOT, (d,)):
            return OP_SELECT, d, b, a
        return None
