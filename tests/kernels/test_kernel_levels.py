"""Levels of compiling: quick code first, better code in the background, the same bits from each, and no deadlock in a fork."""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
import threading

import casadi as ca
import numpy as np
import pytest

from holdfast.kernels import Kernel, compiled, shared_pool, wait_for_compiler
from holdfast.kernels.llvm import machine_code
from holdfast.kernels.llvm.arithmetic import TargetMachine
from holdfast.kernels.program import Program

# Of two child processes, or of four threads.
ROUNDS = dict.fromkeys(("fork", "spawn", "threads"), int(os.environ.get("HOLDFAST_ROUNDS", "4")))
if "HOLDFAST_ROUNDS" not in os.environ:
    ROUNDS["spawn"] = 1  # a child starts Python anew: seconds


def long_function(rounds=400):
    """Products, sums, choices, roots, angles, exponentials and powers, some thousand operations."""
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
    x, y = long_function(50)
    program = Program("long", [x], [y])
    inputs = np.ascontiguousarray((rng.normal(size=(64, 9)) * 10 ** rng.uniform(-3, 3, (64, 1))).T)
    inputs[2, 5] = np.nan
    results = []
    for level in machine_code.COMPILE_LEVELS:
        for lanes in (1, 2, 4, 8, 16):
            code = machine_code.MachineCode(
                machine_code.compile_program(
                    program, level, TargetMachine(lanes, machine_code.detect_processor().machine.fused)
                )
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
    code = machine_code.MachineCode(machine_code.compile_program(program, 0, TargetMachine(4, False)))
    inputs, out = np.ascontiguousarray(rng.normal(size=(6, 400))), np.empty((4, 400))
    code.call(inputs.ctypes.data, out.ctypes.data, 400, 400)
    np.testing.assert_array_equal(out, np.asarray(program.function.map(400)(inputs)))


def test_a_product_inside_a_sum_is_rounded_once_where_the_machine_can():
    if not machine_code.detect_processor().machine.fused:
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
    monkeypatch.setattr(compiled, "SHORT_PROGRAM_OPERATIONS", 0)
    monkeypatch.setattr(compiled, "REPAYING_WORK", 2000)
    monkeypatch.setattr(compiled, "MAX_IMMEDIATE_OPERATIONS", 500)
    x, y = long_function(60)
    kernel = Kernel("long", [x], [y])
    assert kernel.program.size > compiled.MAX_IMMEDIATE_OPERATIONS
    assert kernel._compiled.level == 0
    rows = rng.normal(size=(1024, 9))
    first = kernel.rows(rows)
    wait_for_compiler()
    assert kernel._compiled.level == 0
    kernel.rows(rows)
    wait_for_compiler()
    assert kernel._compiled.level == 1
    np.testing.assert_array_equal(kernel.rows(rows), first)
    assert Kernel("again", [x], [y])._compiled.level == 1  # from the disk


def test_vast_programs_stay_as_they_are(fresh, monkeypatch, rng):
    monkeypatch.setattr(compiled, "SHORT_PROGRAM_OPERATIONS", 0)
    for name in ("REPAYING_WORK", "MAX_IMMEDIATE_OPERATIONS", "MAX_COMPILED_OPERATIONS"):
        monkeypatch.setattr(compiled, name, 500)
    x, y = long_function(60)
    kernel = Kernel("vast", [x], [y])
    assert kernel.program.size > compiled.MAX_COMPILED_OPERATIONS
    for _ in range(3):
        kernel.rows(rng.normal(size=(1024, 9)))
    wait_for_compiler()
    assert kernel._compiled.level == 0


def test_a_thread_of_the_pool_makes_better_code_itself(fresh, threads, monkeypatch, rng):
    """Every processor is busy there; in the background all rows of the meantime would be computed by the quick code."""
    monkeypatch.setattr(compiled, "SHORT_PROGRAM_OPERATIONS", 0)
    monkeypatch.setattr(compiled, "REPAYING_WORK", 1000)
    monkeypatch.setattr(compiled, "MAX_IMMEDIATE_OPERATIONS", 500)
    threads(2)
    x, y = long_function(60)
    kernel = Kernel("long", [x], [y])
    rows = rng.normal(size=(1024, 9))
    monkeypatch.setattr(compiled, "_submit_job", lambda job: pytest.fail("left to the background"))
    first = shared_pool().submit(kernel.rows, rows).result()
    assert kernel._compiled.level == 1
    np.testing.assert_array_equal(kernel.rows(rows), first)


def test_a_thread_of_the_pool_does_not_wait_for_other_code(fresh, threads, monkeypatch, rng):
    """What is being compiled may need what that thread makes."""
    monkeypatch.setattr(compiled, "SHORT_PROGRAM_OPERATIONS", 0)
    monkeypatch.setattr(compiled, "REPAYING_WORK", 1000)
    monkeypatch.setattr(compiled, "MAX_IMMEDIATE_OPERATIONS", 500)
    threads(2)
    x, y = long_function(60)
    kernel = Kernel("long", [x], [y])
    rows = rng.normal(size=(1024, 9))
    with compiled._busy:
        first = shared_pool().submit(kernel.rows, rows).result(timeout=120)
        assert kernel._compiled.level == 0
    wait_for_compiler()
    assert kernel._compiled.level == 1
    np.testing.assert_array_equal(kernel.rows(rows), first)


def test_a_short_program_is_compiled_well_at_once(fresh):
    x = ca.SX.sym("x")
    assert Kernel("short", [x], [ca.sin(x)])._compiled.level == 1


def test_better_code_is_made_at_once_where_many_rows_are_expected(fresh, monkeypatch, rng):
    monkeypatch.setattr(compiled, "SHORT_PROGRAM_OPERATIONS", 0)
    made, compile_program = [], machine_code.compile_program

    def watched(program, level, machine=None):
        made.append((program.name, level))
        return compile_program(program, level, machine)

    monkeypatch.setattr(machine_code, "compile_program", watched)
    x, y = long_function(60)
    with compiled.expect_row_count(compiled.REPAYING_WORK - 1):
        few = Kernel("few", [x], [y])
    with compiled.expect_row_count(compiled.REPAYING_WORK):
        many = Kernel("many", [x], [y + 1])
        with pytest.raises(ValueError, match="inside"), compiled.expect_row_count(0):
            raise ValueError("inside")
        Kernel("many again", [x], [y + 2])
    Kernel("after", [x], [y + 3])
    assert made == [("few", 0), ("many", 1), ("many again", 1), ("after", 0)]
    assert (few._compiled.level, many._compiled.level) == (0, 1)
    rows = rng.normal(size=(100, 9))
    monkeypatch.setenv("HOLDFAST_CACHE", "off")
    np.testing.assert_array_equal(Kernel("quick", [x], [y + 1]).rows(rows), many.rows(rows))


def test_short_programs_wait_longer_for_better_code(fresh, monkeypatch, rng):
    """Their quick code is nearly as quick."""
    monkeypatch.setattr(compiled, "REPAYING_WORK", 1000)
    monkeypatch.setattr(compiled, "REPAYING_WORK_OF_SHORT", 3000)
    x, y = long_function(60)
    kernel = Kernel("short", [x], [y])
    monkeypatch.setattr(compiled, "SHORT_PROGRAM_OPERATIONS", kernel.program.size + 1)
    for level in (0, 0, 1):
        kernel.rows(rng.normal(size=(1024, 9)))
        wait_for_compiler()
        assert kernel._compiled.level == level


def test_the_level_can_be_asked_for(fresh, monkeypatch):
    monkeypatch.setenv("HOLDFAST_LEVEL", "1")
    monkeypatch.setattr(compiled, "MAX_IMMEDIATE_OPERATIONS", 500)
    x, y = long_function(60)
    assert Kernel("long", [x], [y])._compiled.level == 1


def test_long_compiling_is_announced(fresh, monkeypatch, capsys):
    x, y = long_function()
    Kernel("quick", [x], [y])
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(machine_code, "COMPILE_SECONDS_PER_OPERATION", (1e-3, 1e-3))
    monkeypatch.delenv("HOLDFAST_NOTICES")
    Kernel("slow", [x], [y + 1])
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.startswith("holdfast: compiling 'slow', about ")


def test_a_job_that_raises_in_the_background_is_said_and_nobody_waits_for_it_for_ever(fresh, monkeypatch):
    said, done = [], []
    monkeypatch.setattr(threading, "excepthook", lambda args: said.append(args.exc_value))

    def fails():
        raise OSError("no room")

    compiled._submit_job(fails)
    compiled._submit_job(lambda: done.append(1))
    waiting = threading.Thread(target=wait_for_compiler, daemon=True)
    waiting.start()
    waiting.join(60)
    assert not waiting.is_alive()
    assert [str(error) for error in said] == ["no room"]
    assert done == [1]


def _in_a_child(rows):
    x, y = long_function(60)
    kernel = Kernel("child", [x], [y])
    many = np.tile(rows, (2 * kernel._chunk // len(rows) + 2, 1))  # enough for threads
    return float(kernel.rows(many).sum()), shared_pool().submit(lambda: 7).result()


@pytest.mark.parametrize("method", [m for m in ("fork", "spawn") if m in multiprocessing.get_all_start_methods()])
@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")
def test_a_child_process_has_threads_and_a_compiler_of_its_own(method, fresh, threads, rng):
    threads(2)
    rows = rng.normal(size=(50, 9))
    expected = _in_a_child(rows)
    stop, program = threading.Event(), Program("parent", *([part] for part in long_function(60)))
    parent = compiled.CompiledProgram(program)

    def compile_all_the_time():
        while not stop.is_set():
            machine_code.MachineCode(machine_code.compile_program(program, 0))
            compiled._submit_job(lambda: parent._compile_code(1, in_background=True))
            wait_for_compiler()

    busy = threading.Thread(target=compile_all_the_time)
    busy.start()
    try:
        context = multiprocessing.get_context(method)
        for _ in range(ROUNDS[method]):
            with context.Pool(2) as workers:
                assert workers.map_async(_in_a_child, [rows] * 2).get(timeout=120) == [expected] * 2
    finally:
        stop.set()
        busy.join()


def test_threads_make_and_use_the_same_kernel_at_once(fresh, threads, monkeypatch, rng):
    """Every round is a new program, compiled quickly by each thread, run in the pool, and compiled well in the background."""
    monkeypatch.setattr(compiled, "MAX_IMMEDIATE_OPERATIONS", 100)
    monkeypatch.setattr(compiled, "SHORT_PROGRAM_OPERATIONS", 0)
    monkeypatch.setattr(compiled, "REPAYING_WORK", 2000)
    threads(2)
    rows = rng.normal(size=(5000, 9))
    for k in range(ROUNDS["threads"]):
        found = []

        def work(k=k, found=found):
            x, y = long_function(10)
            kernel = Kernel("together", [x], [y + k])
            found.append((kernel.rows(rows).tobytes(), kernel.single_row()(rows[-1]).tobytes(), kernel.rows(rows).tobytes()))

        workers = [threading.Thread(target=work, daemon=True) for _ in range(4)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join(timeout=120)
        assert len(found) == 4, "a thread waits forever, or failed"
        wait_for_compiler()
        assert len(set(found)) == 1
        assert found[0][0].endswith(found[0][1])
        assert found[0][0] == found[0][2]


FORK_WHILE_IMPROVING = """
import os, threading
import casadi as ca
from holdfast.kernels import Program, compiled, wait_for_compiler

x = ca.SX.sym("x")
parent = compiled.CompiledProgram(Program("parent", [x], [x + 1]))
inside, forking = threading.Event(), threading.Event()


def improve():
    inside.set()
    forking.wait()
    for _ in range(50):
        parent._compile_code(1, in_background=True)


os.register_at_fork(before=forking.set)  # the last that is registered is called first
compiled._submit_job(improve)
inside.wait()
child = os.fork()
if child == 0:
    parent._compile_code(1)
    os._exit(0)
assert os.waitpid(child, 0)[1] == 0
wait_for_compiler()
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")
def test_a_fork_while_better_code_is_made_waits_for_it_and_not_for_ever(fresh):
    """In a process of its own: where it fails, it never ends."""
    run = [
        sys.executable,
        "-W",
        "ignore::DeprecationWarning",
        "-c",
        FORK_WHILE_IMPROVING,
    ]  # Python 3.12 warns of every such fork
    done = subprocess.run(run, capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stderr) == (0, "")


FORK_AT_THE_END = """
import atexit, os


def late():
    child = os.fork()
    if child == 0:
        os._exit(0)
    os.waitpid(child, 0)
    print("forked")


atexit.register(late)  # before holdfast, and so called after what holdfast does at the end
import casadi as ca
from holdfast.kernels import Kernel

x = ca.SX.sym("x")
Kernel("some", [x], [x + 1])(1.0)
"""


@pytest.mark.skipif(not hasattr(os, "fork") or sys.version_info >= (3, 12), reason="nothing forks here when a program ends")
def test_a_program_may_fork_at_its_end(fresh):
    done = subprocess.run([sys.executable, "-c", FORK_AT_THE_END], capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stdout, done.stderr) == (0, "forked\n", "")
