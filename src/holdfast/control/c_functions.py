"""Expressions as static C functions, for a file of ours around them: no warning in C99, nothing that a linker sees."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import resources

import casadi as ca

from holdfast.kernels.c_backend import c_function
from holdfast.kernels.program import SX, Program


@dataclass(frozen=True)
class Function:
    """What one of them computes.

    Attributes:
        inputs: Its pointers, each with its symbols.
        outputs: Its arrays, each with the expressions that fill it one after the other, every matrix column by column.
    """

    inputs: Mapping[str, SX]
    outputs: Mapping[str, Sequence[SX]]

    @property
    def arrays(self) -> dict[str, SX]:
        """Outputs as columns."""
        return {name: ca.vertcat(*[ca.vec(ca.densify(x)) for x in parts]) for name, parts in self.outputs.items()}

    def program(self, name: str) -> Program:
        """All inputs one after the other, to all outputs."""
        return Program(name, list(self.inputs.values()), list(self.arrays.values()))


def written(functions: Mapping[str, Function]) -> str:
    """C99 text of functions ``static void CALL(const double *input, ..., double *output, ...)``.

    Args:
        functions: By their names.
    """
    texts = []
    for call, function in functions.items():
        sizes = ({key: x.numel() for key, x in arrays.items()} for arrays in (function.inputs, function.arrays))
        texts.append(c_function(function.program(call), call, *sizes))
    return "\n".join(texts)


def filled(package: str, folder: str, file: str, words: Mapping[str, str]) -> str:
    """A file of text that a package holds, with its words in capitals filled in, the longest first."""
    text = resources.files(package).joinpath(folder, file).read_text(encoding="utf-8")
    for word in sorted(words, key=len, reverse=True):
        text = text.replace(word, words[word])
    return text


def commented(lines: Sequence[str]) -> str:
    """Lines as a comment of C, in plain ASCII, that nothing in them ends."""
    safe = [x.replace("*/", "* /").replace("/*", "/ *").encode("ascii", "replace").decode().replace("\n", " ") for x in lines]
    return "/*\n" + "\n".join(f" * {x}".rstrip() for x in safe) + "\n */"
