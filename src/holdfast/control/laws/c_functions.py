"""Translation of expressions to static C99 functions, which compile without warnings and export no linker symbols."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import resources

import casadi as ca

from holdfast.kernels.c_backend import write_c_function
from holdfast.kernels.program import SX, Program


@dataclass(frozen=True)
class CFunction:
    """Inputs and outputs of one C function.

    Attributes:
        inputs: Symbols of each input pointer, by its name.
        outputs: Expressions that fill each output array in order, by its name; matrices are stored column by column.
    """

    inputs: Mapping[str, SX]
    outputs: Mapping[str, Sequence[SX]]

    @property
    def arrays(self) -> dict[str, SX]:
        """Each output as one column of expressions."""
        return {
            name: ca.vertcat(*[ca.vec(ca.densify(expression)) for expression in parts]) for name, parts in self.outputs.items()
        }


def generate_c_functions(functions: Mapping[str, CFunction]) -> str:
    """Return the C99 text of functions ``static void CALL(const double *input, ..., double *output, ...)``.

    Args:
        functions: Inputs and outputs of each function, by its name.
    """
    texts = []
    for function_name, function in functions.items():
        sizes = ({name: array.numel() for name, array in arrays.items()} for arrays in (function.inputs, function.arrays))
        program = Program(function_name, list(function.inputs.values()), list(function.arrays.values()))
        texts.append(write_c_function(program, function_name, *sizes))
    return "\n".join(texts)


def fill_template(package: str, folder: str, file: str, words: Mapping[str, str]) -> str:
    """Return a text file of a package with each placeholder in ``words`` replaced, the longest placeholder first."""
    text = resources.files(package).joinpath(folder, file).read_text(encoding="utf-8")
    placeholders = "|".join(sorted(words, key=len, reverse=True))
    return re.sub(placeholders, lambda match: words[match[0]], text)


def write_c_comment(lines: Sequence[str]) -> str:
    """Return lines as a C comment in plain ASCII, with comment delimiters inside the lines broken up."""
    safe_lines = [
        line.replace("*/", "* /").replace("/*", "/ *").encode("ascii", "replace").decode().replace("\n", " ") for line in lines
    ]
    return "/*\n" + "\n".join(f" * {line}".rstrip() for line in safe_lines) + "\n */"
