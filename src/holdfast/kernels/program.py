"""CasADi expression as a flat list of scalar instructions, which every backend translates."""

from __future__ import annotations

import hashlib
import struct
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca

from holdfast.core.caching import cached_property

SX = Any  # CasADi ships no type information

OP_NAMES = {getattr(ca, name): name for name in dir(ca) if name.startswith("OP_")}


@dataclass(frozen=True)
class Instruction:
    """Scalar operation ``work[output] = op(work[inputs])``; constants carry their value."""

    op: int
    output: int
    inputs: tuple[int, ...]
    constant: float = 0.0


class Program:
    """Straight-line scalar code with ``n_in`` inputs and ``n_out`` outputs.

    Inputs and outputs of any shape are flattened row by row (C order), so that a batch of results can be reshaped to
    ``(N, rows, columns)`` without moving data.

    Args:
        name: Name for messages.
        inputs: Symbols, each a scalar, vector or matrix ``SX`` without repeated elements.
        outputs: Expressions of the symbols.
    """

    def __init__(self, name: str, inputs: Sequence[SX], outputs: Sequence[SX]) -> None:
        self.name = name
        self.input_shapes = [tuple(x.shape) for x in inputs]
        self.output_shapes = [tuple(y.shape) for y in outputs]
        self._build: Callable[[], Program] | None = None
        self.n_in, self.n_out = _count_elements(self.input_shapes), _count_elements(self.output_shapes)
        self.function = _make_function(inputs, outputs)
        self.size = int(self.function.n_instructions())

    @classmethod
    def from_facts(cls, facts: list[Any], build: Callable[[], Program]) -> Program:
        """Return a program with known ``facts`` (:meth:`facts`); ``build`` makes the rest when it is needed."""
        program = cls.__new__(cls)
        program.name, shapes_in, shapes_out, program.size, program.digest = facts
        program.input_shapes, program.output_shapes = [tuple(x) for x in shapes_in], [tuple(y) for y in shapes_out]
        program.n_in, program.n_out = _count_elements(program.input_shapes), _count_elements(program.output_shapes)
        program._build = build
        return program

    def facts(self) -> list[Any]:
        """Return the properties that are known without the operations."""
        return [self.name, self.input_shapes, self.output_shapes, self.size, self.digest]

    recipe: str | None = None  # digest of its sources, if it has one

    @cached_property
    def function(self) -> Any:
        """CasADi function of all inputs in a column to all outputs in a column."""
        assert self._build is not None
        return self._build().function

    @cached_property
    def instructions(self) -> list[Instruction]:
        """Operations in order; ``OP_INPUT`` reads input ``inputs[0]``, ``OP_OUTPUT`` writes output ``output``."""
        f = self.function
        rows: list[Instruction] = []
        for k in range(f.n_instructions()):
            op, outputs, inputs = f.instruction_id(k), f.instruction_output(k), f.instruction_input(k)
            if op == ca.OP_CONST:
                rows.append(Instruction(op, outputs[0], (), f.instruction_constant(k)))
            elif op == ca.OP_INPUT:
                rows.append(Instruction(op, outputs[0], (inputs[1],)))
            elif op == ca.OP_OUTPUT:
                rows.append(Instruction(op, outputs[1], (inputs[0],)))
            else:
                rows.append(Instruction(op, outputs[0], tuple(inputs)))
        return rows

    def shared_divisors(self) -> dict[int, int]:
        """Return the divisions that share a divisor, each with the instruction that computes the divisor."""
        producers: dict[int, int] = {}  # work slot -> instruction that wrote it last
        divisor: dict[int, int] = {}
        for k, row in enumerate(self.instructions):
            if row.op in (ca.OP_DIV, ca.OP_INV):
                divisor[k] = producers[row.inputs[-1]]
            if row.op != ca.OP_OUTPUT:
                producers[row.output] = k
        uses = Counter(divisor.values())
        return {k: d for k, d in divisor.items() if uses[d] > 1}

    @cached_property
    def digest(self) -> str:
        """SHA-256 of the operations, names and constants (bit for bit): the identity of the computation."""
        hasher = hashlib.sha256(f"{self.n_in},{self.n_out}".encode())
        for row in self.instructions:
            hasher.update(f"{OP_NAMES[row.op]}:{row.output}:{row.inputs}".encode())
            if row.op == ca.OP_CONST:
                hasher.update(struct.pack("<d", row.constant))
        return hasher.hexdigest()


def _make_function(inputs: Sequence[SX], outputs: Sequence[SX]) -> Any:
    flat_in = ca.vertcat(*[_to_row_major(x) for x in inputs])
    return ca.Function("program", [flat_in], [ca.vertcat(*[_to_row_major(y) for y in outputs])], {"cse": True})


def _count_elements(shapes: list[tuple[int, int]]) -> int:
    return sum(rows * columns for rows, columns in shapes)


def _to_row_major(x: SX) -> SX:
    return ca.vec(ca.densify(x).T)
