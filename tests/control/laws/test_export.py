"""Laws as C: compiled with the machine's compiler, loaded, and compared with the kernel."""

from __future__ import annotations

import ctypes
import math
import py_compile
import re
import shutil
import subprocess
from pathlib import Path

import casadi as ca
import damping_oracle
import numpy as np
import pinocchio as pin
import pytest

import holdfast as hf
import oracles
from holdfast.core.errors import InputError, StoreError
from holdfast.core.registry import LAW_REGISTRY
from holdfast.kernels.program import Program
from holdfast.model.arm.kinematics import joint_symbols
from holdfast.model.arms.builtin import DATA_FOLDER

COMPILER = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
EXAMPLES = Path(__file__).parents[3] / "examples"
needs_compiler = pytest.mark.skipif(COMPILER is None, reason="no C compiler (cc, gcc or clang) on this machine")


def compiled(source, header, m, n, others, optimise="-O1"):
    """A Python function of the C function."""
    name, library = source.stem, source.with_suffix(".so")
    flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-Wno-unused-parameter", optimise, "-ffp-contract=off"]
    subprocess.run([COMPILER, *flags, "-shared", "-fPIC", str(source), "-o", str(library), "-lm"], check=True, timeout=300)
    assert f"int {name}(const double q[{n}], const double v[{m}], double rates[{n}]" in header.read_text()
    function = getattr(ctypes.CDLL(str(library)), name)
    pointer = ctypes.POINTER(ctypes.c_double)
    function.argtypes, function.restype = [pointer] * (3 + others), ctypes.c_int

    def call(q, v, nulls=False):
        arrays = [np.array(q, dtype=float), np.array(v, dtype=float), np.full(n, np.nan), *np.full((others, 1), np.nan)]
        pointers = [a.ctypes.data_as(pointer) for a in arrays]
        if nulls:
            pointers[3:] = [None] * others
        return function(*pointers), arrays[2], [float(a[0]) for a in arrays[3:]]

    return call


_DONE = {
    ca.OP_ADD: np.add, ca.OP_SUB: np.subtract, ca.OP_MUL: np.multiply, ca.OP_DIV: np.divide, ca.OP_NEG: np.negative,
    ca.OP_SQ: np.square, ca.OP_TWICE: lambda a: 2 * a, ca.OP_INV: lambda a: 1 / a, ca.OP_SQRT: np.sqrt, ca.OP_FABS: np.abs,
    ca.OP_SIN: np.vectorize(math.sin), ca.OP_COS: np.vectorize(math.cos), ca.OP_EXP: np.vectorize(math.exp),
    ca.OP_LOG: np.vectorize(math.log), ca.OP_LT: np.less, ca.OP_LE: np.less_equal, ca.OP_EQ: np.equal,
    ca.OP_NOT: np.logical_not, ca.OP_AND: np.logical_and, ca.OP_OR: np.logical_or,
    ca.OP_IF_ELSE_ZERO: lambda a, b: np.where(a, b, 0.0),
}  # fmt: skip


def interpreted(law, q, v):
    """Outputs (N, k) of a law, operation by operation, where several divide by one value by its inverse, as kernels do."""
    at, along = joint_symbols(law.arm), ca.SX.sym("v", law.task.m)
    program = Program("law", [at, along], list(law.outputs(at, along).values()))
    given, work, out = np.concatenate((q, v), axis=1).T, {}, np.empty((len(q), program.n_out))
    shared = program.shared_divisors()
    with np.errstate(all="ignore"):
        for k, row in enumerate(program.instructions):
            if row.op == ca.OP_INPUT:
                work[row.output] = given[row.inputs[0]]
            elif row.op == ca.OP_CONST:
                work[row.output] = np.full(len(q), row.constant)
            elif row.op == ca.OP_OUTPUT:
                out[:, row.output] = work[row.inputs[0]]
            elif k in shared and row.op == ca.OP_DIV:
                work[row.output] = work[row.inputs[0]] * (1 / work[row.inputs[1]])
            else:
                work[row.output] = _DONE[row.op](*(work[i] for i in row.inputs))
    return out


@needs_compiler
@pytest.mark.parametrize("slug", LAW_REGISTRY)
def test_c_does_what_the_kernel_does(slug, rng, tmp_path, monkeypatch):
    arm = hf.arms.load("planar-3r")
    law, jit = (hf.control.by_name(oracles.example(LAW_REGISTRY, slug, arm), arm, task="planar") for _ in range(2))
    others = 3 if slug == "failure-tolerant" else 0
    files = list(law.export_c(tmp_path / "new" / "folder"))
    name = slug.replace("-", "_")
    assert [f.name for f in files] == [f"{name}{end}" for end in (".c", ".h", "_example.c", "_test.c")]
    call = compiled(*files[:2], 2, 3, others)
    q, v = rng.uniform(-np.pi, np.pi, (300, 3)), rng.normal(size=(300, 2))
    compiled_here = jit.velocity(q, v)  # its sines differ in the last digit, and a damping where PKE is flat by more
    monkeypatch.setenv("HOLDFAST_BACKEND", "casadi")
    rates, damping, ours = law.velocity(q, v), law.damping(q, v), interpreted(law, q, v)
    for k in range(len(q)):
        code, got, told = call(q[k], v[k])
        size = np.abs(rates[k]).max()
        assert code == 0
        if not others:  # that law is written in C by hand
            np.testing.assert_allclose(got, ours[k], rtol=0, atol=1e-15 * size)
        np.testing.assert_allclose(got, rates[k], rtol=0, atol=1e-11 * size)  # the virtual machine divides each time
        np.testing.assert_allclose(got, compiled_here[k], rtol=0, atol=1e-7 * (1 + size**2))
        if others:
            np.testing.assert_allclose(told, [damping[k], law.largest_damping(q[k], v[k]), 1], rtol=1e-9)
            assert call(q[k], v[k], nulls=True)[0] == 0


@needs_compiler
def test_what_has_no_answer_stops_the_arm(tmp_path):
    arm = hf.arms.load("planar-3r")
    call = compiled(*list(hf.control.pseudoinverse(arm, "planar").export_c(tmp_path))[:2], 2, 3, 0)
    for q, v in (([np.nan, 0, 1], [1, 0]), ([0.1, 0.2, 1], [np.inf, 0]), ([0, 0, 0], [1, 0])):
        code, rates, _ = call(q, v)
        assert code == 1
        np.testing.assert_array_equal(rates, 0)


def pinocchio_jacobian(task):
    """The task Jacobian of the Panda's flange by Pinocchio, in the frame of the task."""
    file = str(DATA_FOLDER.joinpath("panda.urdf"))
    full = pin.buildModelFromUrdf(file)
    model = pin.buildReducedModel(full, [i for i, x in enumerate(full.names) if "finger" in x], pin.neutral(full))
    data, frame = model.createData(), model.getFrameId("panda_link8")
    seen = pin.LOCAL if task.frame == "tool" else pin.LOCAL_WORLD_ALIGNED

    def jacobian(q):
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        return task.rows @ pin.getFrameJacobian(model, data, frame, seen)

    return jacobian


def planar_jacobian(q):
    """Three unit links in a plane."""
    angles = np.cumsum(q)
    ends = np.stack([-np.sin(angles), np.cos(angles)])
    return np.stack([ends[:, k:].sum(axis=1) for k in range(3)], axis=1)


TASKS = [("planar-3r", "planar", 2), ("panda", "position", 3), ("panda", "pointing", 5), ("panda", "pose", 6)]


@needs_compiler
@pytest.mark.parametrize(("name", "task", "m"), TASKS)
@pytest.mark.parametrize("slug", LAW_REGISTRY)
def test_c_agrees_with_numpy_formulas_over_a_jacobian_of_pinocchio(slug, name, task, m, rng, tmp_path):
    """Nothing of holdfast on the other side: the Jacobian is Pinocchio's, or a plane's, and the laws are formulas in NumPy."""
    panda = hf.Arm.from_urdf(str(DATA_FOLDER.joinpath("panda.urdf")), tip="panda_link8")
    arm = panda if name == "panda" else hf.arms.load(name)
    law = hf.control.by_name(oracles.example(LAW_REGISTRY, slug, arm, task), arm, task=task)
    jacobian = pinocchio_jacobian(law.task) if name == "panda" else planar_jacobian
    others = 3 if slug == "failure-tolerant" else 0
    call = compiled(*list(law.export_c(tmp_path, "law"))[:2], m, arm.n, others, "-O0")
    for _ in range(40):
        q, v = rng.uniform(-2.5, 2.5, arm.n), rng.normal(size=m)
        j = jacobian(q)
        if np.linalg.cond(j) > 50:
            continue
        code, rates, told = call(q, v)
        expected = oracles.ORACLES["control law"][slug](j, v, law, told[0] if told else 0.0)
        assert code == 0
        np.testing.assert_allclose(rates, expected, rtol=0, atol=1e-9 * np.abs(expected).max())
        if others:
            u = v / np.linalg.norm(v)
            _, least, largest = damping_oracle.optimum(j, u, law.pre_failure_error)
            assert told[0] <= told[1] == pytest.approx(largest, rel=1e-9)
            assert told[2] == 1
            assert least - 1e-9 <= damping_oracle.peak(j, u, told[0]) <= least + 1e-6


def run(
    folder, *sources, compiler=COMPILER, flags=("-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-Wno-unused-parameter")
):
    """Compile, run: exit code and what it said."""
    binary = folder / "program"
    subprocess.run([compiler, *flags, *map(str, sources), "-o", str(binary), "-lm"], check=True, timeout=300)
    done = subprocess.run([str(binary)], capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout + done.stderr


@needs_compiler
@pytest.mark.parametrize("slug", ["pseudoinverse", "failure-tolerant"])
def test_the_test_beside_it_passes_and_can_fail(slug, tmp_path):
    law = hf.control.by_name(slug, hf.arms.load("planar-3r"), task="planar")
    source, _, _, test = law.export_c(tmp_path, "law")
    assert run(tmp_path, source, test) == (0, "passed\n")
    text = test.read_text()
    lists = [np.array([float(x) for x in part.split(",")]) for part in re.findall(r"{([-\d][^{}]*)}", text.split("cases[")[1])]
    assert len(lists) == 15
    if slug == "pseudoinverse":  # what it expects is no copy of the C: the plane's own formula gives it
        for q, v, rates in zip(lists[::3], lists[1::3], lists[2::3], strict=True):
            np.testing.assert_allclose(rates, np.linalg.pinv(planar_jacobian(q)) @ v, rtol=1e-9)
    test.write_text(text.replace(repr(float(lists[2][0])), repr(float(lists[2][0]) + 1e-6), 1))
    code, told = run(tmp_path, source, test)
    assert code == 1
    assert "case 1: returned 0, the relative error of the rates is" in told


@needs_compiler
def test_the_example_follows_the_command_and_stops_at_a_wrong_order_of_joints(tmp_path):
    arm = hf.arms.load("planar-3r")
    source, _, example, _ = hf.control.pseudoinverse(arm, "planar").export_c(tmp_path, "law")
    code, told = run(tmp_path, source, example)
    assert code == 0
    q = np.array([float(line.split()[1]) for line in told.splitlines()])
    start = np.array(hf.arms.about("planar-3r").home)
    moved = arm.forward_kinematics(q)[:2, 3] - arm.forward_kinematics(start)[:2, 3]
    np.testing.assert_allclose(moved, [0.01, 0], atol=1e-5)  # 0.01 m/s for a second, in steps of 0.01 s
    example.write_text(example.read_text().replace('"joint1", "joint2"', '"joint2", "joint1"'))
    assert run(tmp_path, source, example) == (2, "joint 1 of the driver is not the arm's\n")


@needs_compiler
def test_names_of_joints_are_compared_letter_by_letter(tmp_path):
    arm = hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0, name=x) for x in ('a"\\b??/', "größe", "a")], name="odd")
    files = list(hf.control.pseudoinverse(arm, "planar").export_c(tmp_path, "law"))
    compiled(*files[:2], 2, 3, 0)
    library = ctypes.CDLL(str(files[0].with_suffix(".so")))
    given = (ctypes.c_char_p * 3).in_dll(library, "law_joints")
    assert [x.decode() for x in given] == list(arm.joint_names)

    def check(*names):
        return library.law_check_joints((ctypes.c_char_p * max(len(names), 1))(*[x and x.encode() for x in names]), len(names))

    assert check(*arm.joint_names) == 0
    assert check(*arm.joint_names[:2]) == 3
    assert check(*arm.joint_names, "b") == 4
    assert check(arm.joint_names[0], "a", "größe") == 2
    assert check(arm.joint_names[0], "größ", "a") == 2
    assert check(arm.joint_names[0], "größen", "a") == 2
    assert check(None, "größe", "a") == 1
    assert check() == 1


def test_the_header_says_what_made_it(tmp_path):
    law = hf.control.damped(hf.arms.load("ur5-rail"), 0.1, "position")
    text = law.export_c(tmp_path, "law").header.read_text()
    assert f'#define LAW_ARM "{law.arm.fingerprint}"' in text
    assert f'#define LAW_HOLDFAST "{hf.__version__}"' in text
    other = hf.control.damped(law.arm.with_base(np.diag([1.0, -1, -1, 1])), 0.1, "position")
    assert law.arm.fingerprint not in other.export_c(tmp_path, "other").header.read_text()


@pytest.mark.skipif(shutil.which("g++") is None, reason="no C++ compiler (g++) on this machine")
def test_cpp_links_with_it(tmp_path):
    source, _, example, _ = hf.control.pseudoinverse(hf.arms.load("planar-3r"), "planar").export_c(tmp_path, "law")
    shutil.move(example, example.with_suffix(".cpp"))
    subprocess.run([COMPILER, "-std=c99", "-c", str(source), "-o", str(tmp_path / "law.o")], check=True, timeout=300)
    code, told = run(tmp_path, example.with_suffix(".cpp"), tmp_path / "law.o", compiler="g++", flags=("-Wall", "-Werror"))
    assert (code, told.split()[0]) == (0, "joint1")


def test_what_is_refused(tmp_path):
    law = hf.control.pseudoinverse(hf.arms.load("planar-3r"), "planar")
    for name in ("my-law", "3r", "", "a b", "double", "x;y"):
        with pytest.raises(InputError, match="cannot name a C function"):
            law.export_c(tmp_path, name)
    file = tmp_path / "file"
    file.write_text("")
    with pytest.raises(StoreError, match="choose another folder"):
        law.export_c(file)
    assert list(tmp_path.iterdir()) == [file]


@pytest.mark.parametrize("name", ["ros2_node", "pink_adapter", "mink_adapter"])
def test_examples_compile(name, tmp_path):
    py_compile.compile(str(EXAMPLES / f"{name}.py"), cfile=str(tmp_path / "out.pyc"), doraise=True)


def test_the_second_export_builds_no_graph(tmp_path, monkeypatch):
    monkeypatch.setenv("HOLDFAST_CACHE", str(tmp_path / "cache"))
    arm = hf.arms.load("planar-3r")

    def written(folder, error=0.4, name=None):
        files = hf.control.failure_tolerant(arm, "planar", error).export_c(tmp_path / folder, name)
        return {file.name: file.read_bytes() for file in files}

    first, other = written("first"), written("other", 0.3)
    assert first != other
    with monkeypatch.context() as patched:
        patched.setenv("HOLDFAST_CACHE", "off")
        assert written("without") == first

    def never(*_):
        raise AssertionError("built again")

    monkeypatch.setattr(hf.control.FailureTolerant, "outputs", never)
    assert written("second") == first
    with pytest.raises(AssertionError, match="built again"):
        written("named", name="another")
    with pytest.raises(AssertionError, match="built again"):
        written("third", np.nextafter(0.4, 1))
