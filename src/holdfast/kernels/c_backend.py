"""Translate a program to C99 for the controller of a robot.

A variable is reused once its value is no longer needed, because an unoptimised compiler gives each variable its own stack slot.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from heapq import heappop, heappush

import casadi as ca

from holdfast.kernels.graph import OP_CONST, OP_INPUT, OP_OUTPUT, OP_SELECT, ValueGraph
from holdfast.kernels.program import Program

_C_FORMS = {
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
    # As in compiled code, a comparison with NaN is false, also "not equal", and a condition that is NaN counts as true.
    ca.OP_NE: "({0} < {1}) | ({0} > {1})",
    ca.OP_NOT: "!{0}",
    ca.OP_AND: "({0} != 0) & ({1} != 0)",
    ca.OP_OR: "({0} != 0) | ({1} != 0)",
    ca.OP_IF_ELSE_ZERO: "{0} ? {1} : 0",
    OP_SELECT: "{0} ? {1} : {2}",
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
_CONDITION_OPERATIONS = {ca.OP_LT, ca.OP_LE, ca.OP_EQ, ca.OP_NE, ca.OP_NOT, ca.OP_AND, ca.OP_OR}

_VARIABLE_PATTERN = re.compile(r"[cv]\d+")


def write_c_function(program: Program, name: str, inputs: Mapping[str, int], outputs: Mapping[str, int]) -> str:
    """Write a program in C99: ``static void NAME(const double *input, ..., double *output, ...)``, needing ``math.h``.

    The operations are those of a :class:`holdfast.kernels.Kernel`, bit for bit except for functions of ``math.h``, if the
    compiler neither contracts nor reorders them. Inputs must be finite.

    Args:
        program: The computation.
        name: Name of the C function.
        inputs: Names and sizes of its input arrays, which hold the inputs of the program in order.
        outputs: Names and sizes of its output arrays.

    Raises:
        KernelError: The program has an operation without a C form; the message names it.
    """
    graph = ValueGraph()
    graph.add_program(program, "C", _C_FORMS.keys(), guarded=False)
    lines, doubles, conditions = _write_statements(graph, _element_names(inputs), _element_names(outputs))
    declared = [f"    {kind} {', '.join(names)};\n" for kind, names in (("double", doubles), ("int", conditions)) if names]
    unused = [f"    (void){x};\n" for x in inputs if not any(f"{x}[" in line for line in lines)]
    arguments = ", ".join([f"const double *{x}" for x in inputs] + [f"double *{x}" for x in outputs])
    return f"static void {name}({arguments}) {{\n{''.join([*declared, *unused, *lines])}}}\n"


def _element_names(arrays: Mapping[str, int]) -> list[str]:
    return [f"{name}[{k}]" for name, size in arrays.items() for k in range(size)]


def _write_statements(graph: ValueGraph, inputs: list[str], outputs: list[str]) -> tuple[list[str], list[str], list[str]]:
    """Return lines of C, and the names of their variables for numbers and for conditions."""
    nodes = graph.nodes
    last_use = {a: k for k in graph.needed for a in nodes[k].args}
    last_use |= {nodes[k].args[0]: len(nodes) for k in graph.needed if nodes[k].op == OP_OUTPUT}
    names: dict[int, str] = {}
    free: dict[bool, list[int]] = {True: [], False: []}
    count = {True: 0, False: 0}
    lines, result_lines = list[str](), list[str]()
    for k in graph.needed:
        node = nodes[k]
        if node.op in (OP_INPUT, OP_CONST):
            names[k] = inputs[int(node.value)] if node.op == OP_INPUT else c_number(node.value)
            continue
        if node.op == OP_OUTPUT:
            result_lines.append(f"    {outputs[int(node.value)]} = {names[node.args[0]]};\n")
            continue
        text = _C_FORMS[node.op].format(*(names[a] for a in node.args))
        for a in set(node.args):  # a variable whose value no later line needs may be reused
            if last_use[a] == k and _VARIABLE_PATTERN.fullmatch(names[a]):
                heappush(free[names[a][0] == "c"], int(names[a][1:]))
        kind = node.op in _CONDITION_OPERATIONS
        if not free[kind]:
            heappush(free[kind], count[kind])
            count[kind] += 1
        names[k] = f"{'c' if kind else 'v'}{heappop(free[kind])}"
        lines.append(f"    {names[k]} = {text};\n")
    return lines + result_lines, [f"v{k}" for k in range(count[False])], [f"c{k}" for k in range(count[True])]


def c_number(value: float) -> str:
    """Return a constant of C that reads back as the same double."""
    text = "HUGE_VAL" if math.isinf(value) else repr(abs(float(value)))
    return f"(-{text})" if math.copysign(1, value) < 0 else text
