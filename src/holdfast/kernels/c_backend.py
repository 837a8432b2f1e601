"""Program -> C99: the computation of a kernel in a robot's own controller.

Where one side of a choice needs much that nothing else does, it becomes an ``if``, and what is not taken is not computed.
Variables are used again once their value is not needed: without optimisation a compiler gives each a place on the stack.
"""

from __future__ import annotations

import math
import re
from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass
from heapq import heappop, heappush

import casadi as ca

from holdfast.kernels.graph import CONST, INPUT, OUTPUT, SELECT, Graph
from holdfast.kernels.program import Program

_LARGE = 100  # operations on one side of a choice that are worth an `if`

_FORMS = {
    ca.OP_ADD: "{0} + {1}",
    ca.OP_SUB: "{0} - {1}",
    ca.OP_MUL: "{0} * {1}",
    ca.OP_DIV: "{0} / {1}",
    ca.OP_NEG: "-{0}",
    ca.OP_SQ: "{0} * {0}",
    ca.OP_TWICE: "2 * {0}",
    ca.OP_INV: "1 / {0}",
    ca.OP_LT: "{0} < {1}",
    ca.OP_LE: "{0} <= {1}",
    ca.OP_EQ: "{0} == {1}",
    # As compiled code has them: a comparison with NaN is false, also "not equal"; a condition that is NaN counts as true.
    ca.OP_NE: "({0} < {1}) | ({0} > {1})",
    ca.OP_NOT: "!{0}",
    ca.OP_AND: "({0} != 0) & ({1} != 0)",
    ca.OP_OR: "({0} != 0) | ({1} != 0)",
    ca.OP_IF_ELSE_ZERO: "{0} ? {1} : 0",
    SELECT: "{0} ? {1} : {2}",
    ca.OP_SIGN: "{0} > 0 ? 1 : {0} < 0 ? -1 : 0",
    ca.OP_FMIN: "{0} <= {1} ? {0} : {1}",
    ca.OP_FMAX: "{0} >= {1} ? {0} : {1}",
    ca.OP_HYPOT: "sqrt({0} * {0} + {1} * {1})",
    ca.OP_POW: "pow({0}, {1})",
    ca.OP_CONSTPOW: "pow({0}, {1})",
    ca.OP_ATAN2: "atan2({0}, {1})",
    ca.OP_FABS: "fabs({0})",
} | {
    getattr(ca, f"OP_{name.upper()}"): f"{name}({{0}})"
    for name in ("sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "log1p", "expm1")
}
_TRUTHS = {ca.OP_LT, ca.OP_LE, ca.OP_EQ, ca.OP_NE, ca.OP_NOT, ca.OP_AND, ca.OP_OR}

_VARIABLE = re.compile(r"[cv]\d+")
_Path = tuple[tuple[int, int], ...]  # conditions and sides (1: true, 2: false), from outside in


def c_function(program: Program, name: str, inputs: Mapping[str, int], outputs: Mapping[str, int]) -> str:
    """C99 that computes a program: ``static void NAME(const double *input, ..., double *output, ...)``, needing ``math.h``.

    The operations are those of a :class:`holdfast.kernels.Kernel`, bit for bit but for functions of ``math.h`` where a
    compiler neither contracts nor reorders them. Inputs must be finite.

    Args:
        program: The computation.
        name: Of the function.
        inputs: Names of its arrays and their sizes, which hold the inputs of the program in order.
        outputs: Likewise of its outputs.

    Raises:
        KernelError: An operation that has no row in the table; the message names it.
    """
    graph = Graph(program, "C", _FORMS.keys(), guarded=False)
    lines, doubles, conditions = _text(graph, _Layout(graph).lines, _places(inputs), _places(outputs))
    declared = [f"    {kind} {', '.join(names)};\n" for kind, names in (("double", doubles), ("int", conditions)) if names]
    unused = [f"    (void){x};\n" for x in inputs if not any(f"{x}[" in line for line in lines)]
    given = ", ".join([f"const double *{x}" for x in inputs] + [f"double *{x}" for x in outputs])
    return f"static void {name}({given}) {{\n{''.join([*declared, *unused, *lines])}}}\n"


def _places(arrays: Mapping[str, int]) -> list[str]:
    return [f"{name}[{k}]" for name, size in arrays.items() for k in range(size)]


@dataclass(frozen=True)
class _Line:
    """A value that is computed; or with ``side`` the beginning of an ``if`` (0), or the end of one of its sides (1, 2).

    Attributes:
        values: One, or the choices that the ``if`` makes.
        side: As above; -1 for a value.
    """

    values: tuple[int, ...]
    side: int = -1


class _Layout:
    """The order of lines.

    Attributes:
        lines: In order.
    """

    def __init__(self, graph: Graph) -> None:
        self._graph = graph
        self._path = self._blocks()
        self._members: dict[_Path, list[int]] = defaultdict(list)
        for k in graph.needed:
            self._members[self._path[k]].append(k)
        self.lines: list[_Line] = []
        self._lay_out(())

    def _paths(self, together: dict[int, _Path]) -> dict[int, _Path]:
        """Sides of choices that alone need each value.

        Choices by one condition lie in one place, or what their sides share would be in none of them: ``together`` has it for
        each condition, and is brought up to date.
        """
        nodes, path = self._graph.nodes, dict[int, _Path]()
        for k in reversed(self._graph.needed):
            node, own = nodes[k], path.setdefault(k, ())
            if node.op == SELECT:
                own = path[k] = together[node.args[0]] = _common(own, together.get(node.args[0], own))
            for place, a in enumerate(node.args):
                side = (*own, (node.args[0], place)) if node.op == SELECT and place else own
                path[a] = _common(path[a], side) if a in path else side
        return path

    def _blocks(self) -> dict[int, _Path]:
        """The block of each value: sides of choices that alone need it, as far as they are large."""
        needed, together = self._graph.needed, dict[int, _Path]()
        self._paths(together)
        path = self._paths(together)
        sizes: dict[_Path, int] = defaultdict(int)
        for k in needed:
            for depth in range(1, len(path[k]) + 1):
                sizes[path[k][:depth]] += 1
        for k in needed:
            large = [depth for depth in range(1, len(path[k]) + 1) if sizes[path[k][:depth]] < _LARGE]
            path[k] = path[k][: large[0] - 1] if large else path[k]
        return path

    def _choices(self, block: _Path) -> dict[int, list[int]]:
        """Of a block: conditions of an ``if``, and the choices that it makes."""
        nodes, found = self._graph.nodes, defaultdict(list)
        for k in self._members[block]:
            if nodes[k].op == SELECT and any(
                self._path[a] == (*block, (nodes[k].args[0], s)) for s, a in _sides(nodes[k].args)
            ):
                found[nodes[k].args[0]].append(k)
        return found

    def _lay_out(self, block: _Path) -> None:
        """Lines of a block: each value once what it needs is there, an ``if`` once all that its sides need is."""
        nodes, begun = self._graph.nodes, len(self.lines)
        choices = self._choices(block)
        made = {k: condition for condition, some in choices.items() for k in some}
        left = {k for k in self._members[block] if nodes[k].op not in (INPUT, CONST)}
        busy: set[int] = set()

        def add(k: int) -> bool:
            """A value, or the ``if`` that makes it; False: that needs what it makes."""
            if k not in left:
                return True
            if k not in made:
                left.remove(k)
                self.lines.append(_Line((k,)))
                return True
            condition = made[k]
            if condition in busy:
                return False
            busy.add(condition)
            if not all(add(a) for a in self._before(block, condition, choices[condition], left, made)):
                return False
            left.difference_update(choices[condition])
            self.lines.append(_Line(tuple(choices[condition]), 0))
            for side in (1, 2):
                self._lay_out((*block, (condition, side)))
                self.lines.append(_Line(tuple(choices[condition]), side))
            return True

        for k in self._members[block]:
            if not add(k):
                del self.lines[begun:]
                self._dissolve(block, [(*block, (made[k], side)) for side in (1, 2)])
                self._lay_out(block)
                return

    def _before(self, block: _Path, condition: int, choices: list[int], left: set[int], made: Mapping[int, int]) -> list[int]:
        """Values of a block that are left to be made before an ``if``, in order."""
        nodes, sides = self._graph.nodes, [(*block, (condition, side)) for side in (1, 2)]
        inside = [k for path, some in self._members.items() if path[: len(block) + 1] in sides for k in some]
        stack, found = [*inside, *choices], set[int]()
        while stack:
            for a in nodes[stack.pop()].args:
                if a in left and a not in found:
                    found.add(a)
                    stack += [a] if a not in made else []
        return sorted(found)

    def _dissolve(self, block: _Path, sides: list[_Path]) -> None:
        """Values of blocks, and of blocks in them, become values of the block around."""
        for path in [path for path in self._members if path[: len(block) + 1] in sides]:
            for k in self._members.pop(path):
                self._path[k] = (*block, *path[len(block) + 1 :])
                self._members[self._path[k]].append(k)
        for members in self._members.values():
            members.sort()


def _sides(args: tuple[int, ...]) -> list[tuple[int, int]]:
    return list(enumerate(args))[1:]


def _common(one: _Path, other: _Path) -> _Path:
    """The beginning that both have."""
    for depth, (a, b) in enumerate(zip(one, other, strict=False)):
        if a != b:
            return one[:depth]
    return min(one, other, key=len)


def _text(graph: Graph, lines: list[_Line], inputs: list[str], outputs: list[str]) -> tuple[list[str], list[str], list[str]]:
    """Lines of C, and the variables that they use: of numbers and of conditions."""
    nodes = graph.nodes
    asked = [
        [a for k in line.values for a in (nodes[k].args if line.side < 0 else nodes[k].args[line.side : line.side + 1])]
        for line in lines
    ]
    last = {a: i for i, needs in enumerate(asked) for a in needs}
    last |= {nodes[k].args[0]: len(lines) for k in graph.needed if nodes[k].op == OUTPUT}
    names = {k: inputs[int(nodes[k].value)] if nodes[k].op == INPUT else number(nodes[k].value) for k in graph.needed}
    free: dict[bool, list[int]] = {True: [], False: []}
    count = {True: 0, False: 0}
    out, ends, depth = [], list[str](), 1

    def fresh(k: int) -> str:
        kind = nodes[k].op in _TRUTHS
        if not free[kind]:
            heappush(free[kind], count[kind])
            count[kind] += 1
        names[k] = f"{'c' if kind else 'v'}{heappop(free[kind])}"
        return names[k]

    for i, (line, needs) in enumerate(zip(lines, asked, strict=True)):
        first = line.values[0]
        if line.side == 0:
            condition = names[needs[0]]
            for k in line.values:
                fresh(k)
            out.append(f"{'    ' * depth}if ({condition}) {{\n")
            depth += 1
        elif line.side > 0:
            out += [f"{'    ' * depth}{names[k]} = {names[a]};\n" for k, a in zip(line.values, needs, strict=True)]
            out.append(f"{'    ' * (depth - 1)}}}{' else {' if line.side == 1 else ''}\n")
            depth -= line.side == 2
        elif nodes[first].op == OUTPUT:
            ends.append(f"    {outputs[int(nodes[first].value)]} = {names[needs[0]]};\n")
            continue
        else:
            text = _FORMS[nodes[first].op].format(*(names[a] for a in needs))
            _release(names, needs, last, i, free)
            out.append(f"{'    ' * depth}{fresh(first)} = {text};\n")
            continue
        _release(names, needs, last, i, free)
    return out + ends, [f"v{k}" for k in range(count[False])], [f"c{k}" for k in range(count[True])]


def _release(names: dict[int, str], needs: list[int], last: dict[int, int], line: int, free: dict[bool, list[int]]) -> None:
    """Variables whose value nothing after this line needs may be used again."""
    for a in set(needs):
        if last[a] == line and _VARIABLE.fullmatch(names[a]):
            heappush(free[names[a][0] == "c"], int(names[a][1:]))


def number(value: float) -> str:
    """A constant of C that reads back as the same double."""
    text = "HUGE_VAL" if math.isinf(value) else repr(abs(float(value)))
    return f"(-{text})" if math.copysign(1, value) < 0 else text
