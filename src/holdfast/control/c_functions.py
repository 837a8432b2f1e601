"""Expressions as static C functions, for a file of ours around them: no warning in C99, nothing that a linker sees."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import resources

import casadi as ca

from holdfast.kernels.program import SX


@dataclass(frozen=True)
class Function:
    """What one of them computes.

    Attributes:
        inputs: Its pointers, each with its symbols.
        outputs: Its arrays, each with the expressions that fill it one after the other, every matrix column by column.
    """

    inputs: Mapping[str, SX]
    outputs: Mapping[str, Sequence[SX]]


def written(name: str, functions: Mapping[str, Function]) -> str:
    """C99 text of functions ``static void CALL(const double *input, ..., double output[size], ...)``.

    Args:
        name: Begins the names of what they need.
        functions: By their names.
    """
    graphs = [
        ca.Function(
            f"{name}_{call}_graph",
            list(function.inputs.values()),
            [ca.densify(ca.vertcat(*[ca.vec(ca.densify(x)) for x in parts])) for parts in function.outputs.values()],
            {"cse": True},
        )
        for call, function in functions.items()
    ]
    generator = ca.CodeGenerator(f"{name}.c", {"with_export": False, "casadi_int": "int"})
    for graph in graphs:
        generator.add(graph)
    # What is for loading the graph elsewhere goes; arguments that it does not need are no mistake.
    outer = rf"^[a-z][\w ]*[ *]+{name}_\w+\((?:[^\n]*\}}|[^\n]*\{{\n.*?^\}})\n"
    text = re.sub(outer, "", generator.dump(), flags=re.M | re.S)
    text = re.sub(r"^(?:static const casadi_int|#define) casadi_s\d.*\n", "", text, flags=re.M)
    text = re.sub(r"int mem\) ?\{\n", "int mem) {\n  (void)iw; (void)w; (void)mem;\n", text)
    for k, (graph, (call, function)) in enumerate(zip(graphs, functions.items(), strict=True)):
        sizes = {out: graph.numel_out(i) for i, out in enumerate(function.outputs)}
        given = ", ".join(
            [f"const double *{x}" for x in function.inputs] + [f"double {x}[{size}]" for x, size in sizes.items()]
        )
        text += f"""
static void {call}({given}) {{
    const double *arg[{max(graph.sz_arg(), len(function.inputs))}] = {{{", ".join(function.inputs)}}};
    double *res[{max(graph.sz_res(), len(sizes))}] = {{{", ".join(sizes)}}};
    int iw[{max(graph.sz_iw(), 1)}];
    double w[{max(graph.sz_w(), 1)}];
    casadi_f{k}(arg, res, iw, w, 0);
}}
"""
    return text


def filled(package: str, folder: str, file: str, words: Mapping[str, str]) -> str:
    """A file of text that a package holds, with its words in capitals filled in, the longest first."""
    text = resources.files(package).joinpath(folder, file).read_text(encoding="utf-8")
    for word in sorted(words, key=len, reverse=True):
        text = text.replace(word, words[word])
    return text


def commented(lines: Sequence[str]) -> str:
    """Lines as a comment of C, in plain ASCII, that nothing in them ends."""
    safe = [x.replace("*/", "* /").encode("ascii", "replace").decode().replace("\n", " ") for x in lines]
    return "/*\n" + "\n".join(f" * {x}".rstrip() for x in safe) + "\n */"
