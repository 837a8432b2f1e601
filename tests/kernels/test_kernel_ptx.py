"""Kernels as PTX: what the translation writes, and where NVIDIA's assembler is installed, what it says of that."""

from __future__ import annotations

import ast
import os
import re
from pathlib import Path

import casadi as ca
import ptx_kernels
import pytest
from test_kernel_operations import TABLE

import holdfast
from holdfast.kernels import Program
from holdfast.kernels.gpu import ptx
from holdfast.kernels.llvm.functions import EMITTED_FUNCTIONS
from holdfast.kernels.program import OP_NAMES


def test_every_operation_becomes_ptx_that_calls_nothing():
    x, y = ca.SX.sym("x"), ca.SX.sym("y")
    program = Program("all", [x, y], [ca.vertcat(*[expression(x, y) for _, expression, *_ in TABLE.values()])])
    assert {OP_NAMES[op] for op in EMITTED_FUNCTIONS} <= {OP_NAMES[i.op] for i in program.instructions}
    for capability in (70, 75, 90, 100, 121):
        text = ptx.make_ptx(program, capability).decode()
        assert re.search(r"\.target sm_(\d+)", text)[1] == str(min(capability, 90))
        assert ".visible .entry rows(" in text
        assert not re.search(r"\bcall\b|\.extern|\.local", text)
        assert not re.search(r"\b(div|sqrt|fma|add|mul)\.(approx|ftz|rz|full)", text)  # all rounded to nearest


def test_ptx_is_kept_beside_the_object_files(monkeypatch):
    x = ca.SX.sym("x", 2)
    program = Program("kept", [x], [ca.vertcat(ca.exp(x), ca.sumsqr(x))])
    first = ptx.make_ptx(program, 80), ptx.make_ptx(program, 90), ptx.make_ptx(program, 90, state=2)
    assert len(set(first)) == 3
    monkeypatch.setattr(ptx, "_translate_to_ptx", None)
    assert first == (ptx.make_ptx(program, 80), ptx.make_ptx(program, 90), ptx.make_ptx(program, 90, state=2))


def test_the_assembler_takes_every_kernel_and_needs_what_the_table_says():
    ptxas = ptx_kernels.assembler()
    if ptxas is None:
        pytest.skip("NVIDIA's assembler is not installed: CONTRIBUTING has the command that runs this test")
    head, table = ptx_kernels.stored()
    every = os.environ.get("HOLDFAST_PTX") == "all"
    found = {
        (name, target): ptx_kernels.assembled(program, state, target, ptxas)
        for name, (program, state) in ptx_kernels.kernels(every).items()
        for target in (ptx_kernels.TARGETS if every else ptx_kernels.TARGETS[-1:])
    }
    assert found
    if head == ptx_kernels.versions(ptxas):
        assert found == {key: table[key] for key in found}


def test_every_kernel_of_the_package_is_in_the_table():
    """By the names in the sources: a constant, or the constant parts of a name that is made."""
    table = "\n".join(f"{name.rpartition(', ')[0]}," for name, _ in ptx_kernels.stored()[1])
    made = [
        call.args[0]
        for file in Path(holdfast.__file__).parent.rglob("*.py")
        if re.search(text := r"\b(Kernel|Loop)\(", file.read_text(encoding="utf-8"))
        for call in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(call, ast.Call) and call.args and re.match(text, ast.unparse(call))
    ]
    assert len(made) > 70
    for name in made:
        parts = [name] if isinstance(name, ast.Constant) else name.values if isinstance(name, ast.JoinedStr) else []
        shape = "".join(re.escape(p.value) if isinstance(p, ast.Constant) else ".*" for p in parts)
        assert re.search(f"^{shape},$" if parts else "", table, re.MULTILINE), ast.unparse(name)
