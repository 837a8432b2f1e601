"""Printed kernels in Node and in Chromium, bit for bit against code that LLVM compiles without fused multiply-add."""

from __future__ import annotations

import base64
import re

import casadi as ca
import numpy as np
import pytest

import chromium
import holdfast as hf
import javascript as browser
from holdfast.interface.presentation.arm_page.printed_kernels import make_page_programs
from holdfast.kernels import Program
from holdfast.kernels.javascript_backend import write_javascript
from holdfast.kernels.llvm.arithmetic import TargetMachine
from holdfast.kernels.llvm.machine_code import MachineCode, compile_program
from holdfast.model.arm import kinematics
from holdfast.model.arm.task import as_task, default_path_task
from holdfast.studies.designs.family import make_revolute_arm

ROWS = 200  # in each test; with 10,000 the bits are equal as well
FUNCTIONS = {
    "sin": (1, ca.sin),
    "cos": (1, ca.cos),
    "tan": (1, ca.tan),
    "exp": (1, ca.exp),
    "log": (1, ca.log),
    "asin": (1, ca.asin),
    "acos": (1, ca.acos),
    "atan": (1, ca.atan),
    "atan2": (2, ca.atan2),
    "pow": (2, ca.power),
}
TINY = 5e-324
SPECIAL = [0, 1, -1, 0.5, 2, 3, -3, 1e15, -1.1e15, 1e16, 1e300, -1e300, TINY, -TINY, 2e-308, 720, -746, 1e-30]
# Quotients of these are NaN, infinite, a zero of either sign, subnormal or large.
QUOTIENTS = np.array([[x, y] for x in [*SPECIAL, np.pi / 2, -np.pi] for y in (1, -1, 0, 1e200)], dtype=float)


def compiled_rows(program, rows, lanes=4):
    """What LLVM's code for a machine without fused multiply-add makes of rows (N, n_in)."""
    code = MachineCode(compile_program(program, 0, TargetMachine(lanes, False)))
    width = -(-len(rows) // lanes) * lanes
    inputs, outputs = np.zeros((program.n_in, width)), np.empty((program.n_out, width))
    inputs[:, : len(rows)] = rows.T
    code.call(inputs.ctypes.data, outputs.ctypes.data, width, width)
    return np.ascontiguousarray(outputs[:, : len(rows)].T)


def assert_same_bits(found, expected):
    """Every NaN counts as the same."""
    different = (np.ascontiguousarray(found).view(np.int64) != expected.view(np.int64)) & ~(
        np.isnan(found) & np.isnan(expected)
    )
    assert not different.any(), (different.any(axis=1).sum(), found[different][:3], expected[different][:3])


def programs(name):
    """The kernels of a built-in arm for its page, and those of its worst case, by name; ``any arm`` has a geometry as input."""
    if name == "any arm":
        arm = make_revolute_arm(9)
        made = make_page_programs(arm, as_task(arm, "pose"), kinematics.joint_symbols(arm), arm.symbols)
        return {key: program for key, program in made.items() if program}
    arm = hf.arms.load(name)
    q, position = kinematics.joint_symbols(arm), as_task(arm, default_path_task(arm, oriented=False))
    task = as_task(arm, "pose") if arm.n >= 6 else position
    made = {key: program for key, program in make_page_programs(arm, task, q).items() if program and program.n_out}
    if arm.n > task.m:
        index = hf.indices.by_name("relative-manipulability", arm, task)
        made |= {"index": index._build_values(True, False).program, "gradient": index._build_gradient(True).program}
    v = ca.SX.sym("v", position.m)
    for label in ("pseudoinverse", "damped"):
        law = hf.control.pseudoinverse(arm, position) if label == "pseudoinverse" else hf.control.damped(arm, 0.1, position)
        made[label] = Program(label, [q, v], [law.rates(q, v)])
    return made


def draws(rng, program, count=ROWS):
    """Rows of numbers; in the second half some are 0 of either sign, right angles, huge, not finite, or 0 or 1 as in a mask."""
    rows = rng.uniform(-4, 4, (count, program.n_in))
    rare = rng.random(rows.shape) < 0.05
    rows[rare] = rng.choice([0.0, -0.0, np.pi / 2, -np.pi, 1e15, 1e17, -1e200, 1e308, TINY, -TINY, np.nan, np.inf], rare.sum())
    mask = rng.random(rows.shape) < 0.1
    rows[mask] = rng.choice([0.0, 1.0], mask.sum())
    rows[: count // 2] = rng.uniform(-4, 4, (count // 2, program.n_in))
    return rows


@pytest.mark.parametrize("name", [*hf.arms.names(), "any arm"])
def test_every_kernel_of_an_arm_has_the_bits_of_compiled_code(name, rng):
    for key, program in programs(name).items():
        rows = draws(rng, program)
        found = browser.rows(write_javascript(program, "f"), "f", rows, program.n_out)
        assert np.isfinite(found[: ROWS // 2]).any(axis=1).mean() > 0.9, key
        assert_same_bits(found, compiled_rows(program, rows))


@pytest.mark.parametrize("task", ["position", "pose"])
def test_the_straight_failure_tolerant_law_has_the_bits_of_compiled_code(task, rng):
    law = hf.control.failure_tolerant(hf.arms.load("panda"), task)
    q, v = kinematics.joint_symbols(law.arm), ca.SX.sym("v", law.task.m)
    program = Program("law", [q, v], [law.rates(q, v)])
    rows = draws(rng, program)
    assert_same_bits(browser.rows(write_javascript(program, "f"), "f", rows, program.n_out), compiled_rows(program, rows))


def function_rows(rng, count):
    """Numerators and denominators of two arguments: special ones, and random ones of every size."""
    pairs = [np.r_[a, b] for a in QUOTIENTS for b in QUOTIENTS[::3]]
    sizes = 10 ** rng.uniform(-320, 305, (count, 2)) * rng.choice([-1, 1], (count, 2))
    close = rng.uniform(-1, 1, (count, 2)) * rng.choice([1, 1, 4, 700, 1e5], (count, 1))
    ones = np.ones((count, 2))
    return np.vstack([pairs, *(np.column_stack([x[:, 0], ones[:, 0], x[:, 1], ones[:, 1]]) for x in (sizes, close))])


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_function_has_the_bits_of_compiled_code(name, rng):
    """Inside an expression, where an argument may be NaN, infinite, or -0; the sign of a result of 0 is seen, too."""
    count, function = FUNCTIONS[name]
    x = ca.SX.sym("x", 4)
    value = function(*[x[0] / x[1], x[2] / x[3]][:count])
    program = Program(name, [x], [ca.vertcat(value, 1 / value, ca.if_else(value < x[0], value, 3))])
    rows = function_rows(rng, 3000)
    found = browser.rows(write_javascript(program, "f"), "f", rows, program.n_out)
    assert np.isfinite(found[:, 0]).sum() > 3000
    assert_same_bits(found, compiled_rows(program, rows))


OPERATIONS = [
    lambda a, b: a + b,
    lambda a, b: a - b,
    lambda a, b: a * b,
    lambda a, b: a / b,
    lambda a, b: 1 / a + a * a,
    lambda a, b: ca.sqrt(ca.fabs(a)) - ca.hypot(a, b),
    lambda a, b: ca.fmin(a, -b) + 2 * a,
    lambda a, b: ca.fmax(a, b) * ca.sign(b),
    lambda a, b: ca.if_else(ca.logic_and(a < b, ca.logic_not(b <= 0)), a, -b),
    lambda a, b: ca.if_else(ca.logic_or(a == b, a != 1), b, 0),
    lambda a, b: ca.if_else(a, a < b, b) + (a != b),
    *(lambda a, b, function=function, count=count: function(*[a, b][:count]) for count, function in FUNCTIONS.values()),
]


@pytest.mark.parametrize("seed", range(4))
def test_random_expressions_have_the_bits_of_compiled_code(seed, rng):
    """Also where a part is NaN or infinite and a condition depends on it."""
    x = ca.SX.sym("x", 4)
    values = ca.vertsplit(x)
    for _ in range(80 * (seed + 1)):
        a, b = (values[k] for k in rng.integers(max(0, len(values) - 60), len(values), 2))
        values.append(OPERATIONS[rng.integers(len(OPERATIONS))](a, b if rng.random() < 0.9 else rng.choice([0.0, 1.0, -2.0])))
    program = Program("random", [x], [ca.vertcat(*values[-60:])])
    rows = np.vstack([rng.normal(size=(400, 4)), rng.integers(-2, 3, (400, 4))]).astype(float)
    found = browser.rows(write_javascript(program, "f"), "f", rows, program.n_out)
    assert np.isfinite(found).mean() > 0.1
    assert_same_bits(found, compiled_rows(program, rows))


def test_a_large_sum_of_inputs_is_no_nan():
    x = ca.SX.sym("x", 2)
    program = Program("large", [x], [x[0] * 1e-300])
    rows = np.array([[1.7e308, 1.7e308], [np.inf, 1], [1, np.nan]])
    found = browser.rows(write_javascript(program, "f"), "f", rows, 1)
    assert found[0, 0] == 1.7e308 * 1e-300
    assert np.isnan(found[1:]).all()
    assert_same_bits(found, compiled_rows(program, rows))


@pytest.mark.parametrize("part", ["program", "sine"])
def test_a_changed_digit_is_seen(part, rng):
    """The last digit of a length of the arm, or of a coefficient of the cosine."""
    program = programs("panda")["frames"]
    text, rows = write_javascript(program, "f"), rng.uniform(-4, 4, (ROWS, program.n_in))
    start = text.index("function p0") if part == "program" else text.index("0.041")
    place = start + re.search(r"0\.\d{3,}", text[start:]).end() - 1
    broken = text[:place] + str((int(text[place]) + 5) % 10) + text[place + 1 :]
    with pytest.raises(AssertionError):
        assert_same_bits(browser.rows(broken, "f", rows, program.n_out), compiled_rows(program, rows))


IN_PAGE = """([text,width,outputs,data])=>{
const bytes=Uint8Array.from(atob(data),c=>c.charCodeAt(0)),input=new Float64Array(bytes.buffer);
const f=new Function(text+"return f;")();
const count=input.length/width,all=new Float64Array(count*outputs),y=new Float64Array(outputs);
for(let k=0;k<count;k++){f(input.subarray(k*width,(k+1)*width),y);all.set(y,k*outputs);}
let result="";for(const byte of new Uint8Array(all.buffer))result+=String.fromCharCode(byte);
return btoa(result);}"""


def test_chromium_has_the_same_bits(rng):
    """All kernels of two arms, and all functions."""
    x = ca.SX.sym("x", 4)
    values = [function(*[x[0] / x[1], x[2] / x[3]][:count]) for count, function in FUNCTIONS.values()]
    every = [(Program("functions", [x], values), function_rows(rng, 500))]
    every += [(program, draws(rng, program)) for name in ("panda", "pa10-9dof") for program in programs(name).values()]
    with chromium.opened(chromium.required) as opened:
        page = opened.new_page()
        for program, rows in every:
            data = base64.b64encode(rows.astype("<f8").tobytes()).decode()
            text = page.evaluate(IN_PAGE, [write_javascript(program, "f"), program.n_in, program.n_out, data])
            found = np.frombuffer(base64.b64decode(text), dtype="<f8").reshape(len(rows), program.n_out)
            assert_same_bits(found, compiled_rows(program, rows))
