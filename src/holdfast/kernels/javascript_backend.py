"""Translate a program to JavaScript for a browser.

V8 does not optimise a function with more than 60 kB of code, so a long program becomes several functions, which share values
through an array. Measured with Node 24 on one core of a shared machine, ten calls of the failure-tolerant law: three links
(4,400 CasADi operations) 14 us in functions of 100 operations, 12 of 200, 10 of 800 and more; Panda's position (12,900
operations) 36 us in functions of 200, 28 of 1000, 31 as a single function; its pose (28,900 operations) 98, 71 and 83 us.
A value that is used once stays inside the expression that reads it, which an engine skips if the other branch of a choice is
taken.

Sine and cosine add 0.7 kB to a text, the arctangent 1.1 kB, the exponential and the logarithm 0.7 kB each. With them Panda's
kernels take as long as with ``Math.sin``: task Jacobian 0.19 us (0.17), null space 0.26 (0.22), step of the inverse kinematics
0.51 (0.53).
"""

from __future__ import annotations

from heapq import heappop, heappush

from holdfast.kernels.graph import OP_OUTPUT
from holdfast.kernels.javascript.expressions import JAVASCRIPT_FORMS, NamedGraph, make_short_names
from holdfast.kernels.javascript.functions import define_functions
from holdfast.kernels.program import Program

_OPERATIONS_PER_FUNCTION = 1000  # approximate operations in one function


def write_javascript(program: Program, name: str, *, with_functions: bool = True) -> str:
    """Write a program in JavaScript: ``const NAME = (x, y) => ...``, strict, without allocation or dependencies.

    ``x`` and ``y`` are two ``Float64Array``: the inputs are read from the first, and the outputs are written to the second,
    both in the order of the program. In every engine the outputs equal, bit for bit, those of the function that LLVM compiles
    for a machine without fused multiply-add, except for the functions sinh, cosh, tanh, log1p and expm1, which LLVM does not
    have. NaN or infinity in an input makes every output NaN.

    Args:
        program: Program to translate.
        name: Name of the constant.
        with_functions: If False, :func:`define_functions` must define the functions that the text calls, so that several
            programs can share them.

    Raises:
        KernelError: The program has an operation without a JavaScript form; the message names it.
    """
    graph = NamedGraph()
    graph.add_program(program, "JavaScript", JAVASCRIPT_FORMS.keys(), guarded=True)
    graph.name_values()
    pieces, spilled = _write_functions(graph)
    body = "".join(f"function p{i}(x,y,w){{\n{text}}}\n" for i, text in enumerate(pieces))
    calls = "".join(f"p{i}(x,y,w);" for i in range(len(pieces)))
    lines = [
        f"const {name}=(()=>{{",
        '"use strict";',
        f"{define_functions(body) if with_functions else ''}const w=new Float64Array({spilled});",
        f"{body}return (x,y)=>{{{calls}}};",
        "})();",
    ]
    return "\n".join(lines) + "\n"


def _write_functions(graph: NamedGraph) -> tuple[list[str], int]:
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
        new_names = make_short_names()
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
