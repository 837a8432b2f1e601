"""Levels of compiling: quick code first, better code in the background, the same bits from each, and no deadlock in a fork."""

from __future__ import annotations

import ctypes
import multiprocessing
import os
import threading

import casadi as ca
import numpy as np
import pytest

from holdfast.kernels import Kernel, compiled, llvm_backend, pool, settle
from holdfast.kernels.llvm_ir import LIBRARY, Machine
from holdfast.kernels.program import Program

ROUNDS = int(os.environ.get("HOLDFAST_FORKS", "8"))  # of two child processes


def long_function(rounds=400):
    """Products, sums, choices, roots, angles and functions of the C library, some thousand operations."""
    x = ca.SX.sym("x", 9)
    y = x
    for k in range(rounds):
        new = y[0] * y[5] / (1 + y[0] ** 2) - 0.4 * ca.sin(y[7]) * ca.if_else(y[2] < y[8], y[4], 3 / ca.sqrt(y[1] ** 2 + 1))
        y = ca.vertcat(y[1:], ca.atan2(new, 1 + ca.exp(-(new**2))) if k % 50 == 0 else new)
    return x, ca.vertcat(y, x[0] * x[1] - x[1] * x[2], ca.if_else(x[0] > 0, ca.log(x[0] ** 2 + 1), ca.tan(x[1])))


@pytest.fixture
def fresh(tmp_path, monkeypatch):
    monkeypatch.setenv("HOLDFAST_CACHE", str(tmp_path))


def test_levels_and_lanes_give_the_same_bits(rng):
    x, y = long_function(100)
    program = Program("long", [x], [y])
    inputs = np.ascontiguousarray((rng.normal(size=(64, 9)) * 10 ** rng.uniform(-3, 3, (64, 1))).T)
    inputs[2, 5] = np.nan
    results = []
    for level in llvm_backend.LEVELS:
        for lanes in (1, 2, 4, 8, 16):
            code = llvm_backend.Code(
                llvm_backend.compile_program(program, level, Machine(lanes, llvm_backend.host().machine.fused))
            )
            out = np.empty((program.n_out, 64))
            code.call(inputs.ctypes.data, out.ctypes.data, 64, 64)
            results.append(out)
    for other in results[1:]:
        np.testing.assert_array_equal(other, results[0])
    expected = np.asarray(program.function.map(64)(inputs))
    clean = np.delete(np.arange(64), 5)
    np.testing.assert_allclose(results[0][:, clean], expected[:, clean], rtol=1e-9, atol=1e-9)
    assert np.isnan(results[0][:, 5]).all()


def test_without_fused_multiply_add_every_rounding_is_that_of_casadi(rng):
    """The same sums, products and quotients in the same order give the same bits as the machine of CasADi."""
    x = ca.SX.sym("x", 6)
    y = ca.vertcat(
        x[0] * x[1] + x[2] * x[3] - x[4] * x[5], x[0] - x[1] * x[2], (x[3] * x[4] - x[5]) / x[0], ca.sqrt(x[1] ** 2 + 2)
    )
    program = Program("plain", [x], [y])
    code = llvm_backend.Code(llvm_backend.compile_program(program, 0, Machine(4, False)))
    inputs, out = np.ascontiguousarray(rng.normal(size=(6, 400))), np.empty((4, 400))
    code.call(inputs.ctypes.data, out.ctypes.data, 400, 400)
    np.testing.assert_array_equal(out, np.asarray(program.function.map(400)(inputs)))


def test_a_product_inside_a_sum_is_rounded_once_where_the_machine_can():
    if not llvm_backend.host().machine.fused:
        pytest.skip("this machine has no fused multiply-add")
    x = ca.SX.sym("x", 3)
    tiny = 2.0**-30
    row = np.array([1 + tiny, 1 - tiny, -1.0])
    for expression in (x[0] * x[1] + x[2], x[2] + x[0] * x[1], x[0] * x[1] - (-x[2])):
        assert Kernel("fused", [x], [expression])(row) == -(2.0**-60)
    assert Kernel("reversed", [x], [-x[2] - x[0] * x[1]])(row) == 2.0**-60
    # A product that others read too is rounded by itself.
    total, product = Kernel("shared", [x], [x[0] * x[1] + x[2], x[0] * x[1]])(row)
    assert (total, product) == (0.0, 1.0)


def test_quick_code_serves_until_enough_rows_have_come(fresh, monkeypatch, rng):
    monkeypatch.setattr(compiled, "WORTH", 2000)
    monkeypatch.setattr(compiled, "AT_ONCE", 500)
    x, y = long_function(60)
    kernel = Kernel("long", [x], [y])
    assert kernel.program.size > compiled.AT_ONCE
    assert kernel._compiled.level == 0
    rows = rng.normal(size=(1024, 9))
    first = kernel.rows(rows)
    settle()
    assert kernel._compiled.level == 0
    kernel.rows(rows)
    settle()
    assert kernel._compiled.level == 1
    np.testing.assert_array_equal(kernel.rows(rows), first)
    assert Kernel("again", [x], [y])._compiled.level == 1  # from the disk


def test_a_short_program_is_compiled_well_at_once(fresh):
    x = ca.SX.sym("x")
    assert Kernel("short", [x], [ca.sin(x)])._compiled.level == 1


def test_the_level_can_be_asked_for(fresh, monkeypatch):
    monkeypatch.setenv("HOLDFAST_LEVEL", "1")
    monkeypatch.setattr(compiled, "AT_ONCE", 500)
    x, y = long_function(60)
    assert Kernel("long", [x], [y])._compiled.level == 1


def test_long_compiling_is_announced(fresh, monkeypatch, capsys):
    x, y = long_function()
    Kernel("quick", [x], [y])
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(llvm_backend, "COMPILING", (1e-3, 1e-3))
    monkeypatch.delenv("HOLDFAST_NOTICES")
    Kernel("slow", [x], [y + 1])
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.startswith("holdfast: compiling 'slow', about ")


def test_every_function_of_the_c_library_is_found():
    llvm_backend.host()
    for name in LIBRARY:
        assert ctypes.cast(getattr(ctypes.CDLL(None), name), ctypes.c_void_p).value


def _in_a_child(rows):
    x, y = long_function(60)
    kernel = Kernel("child", [x], [y])
    many = np.tile(rows, (2 * kernel._chunk // len(rows) + 2, 1))  # enough for threads
    return float(kernel.rows(many).sum()), pool().submit(lambda: 7).result()


@pytest.mark.parametrize("method", [m for m in ("fork", "spawn") if m in multiprocessing.get_all_start_methods()])
@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")
def test_a_child_process_has_threads_and_a_compiler_of_its_own(method, fresh, threads, rng):
    threads(2)
    rows = rng.normal(size=(50, 9))
    expected = _in_a_child(rows)
    stop, program = threading.Event(), Program("parent", *([part] for part in long_function(60)))

    def compile_all_the_time():
        while not stop.is_set():
            llvm_backend.Code(llvm_backend.compile_program(program, 0))

    busy = threading.Thread(target=compile_all_the_time)
    busy.start()
    try:
        context = multiprocessing.get_context(method)
        for _ in range(ROUNDS if method == "fork" else max(ROUNDS // 8, 1)):
            with context.Pool(2) as workers:
                assert workers.map_async(_in_a_child, [rows] * 2).get(timeout=120) == [expected] * 2
    finally:
        stop.set()
        busy.join()
