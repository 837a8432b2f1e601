"""Laws as C: compiled with the machine's compiler, loaded, and compared with the kernel."""

from __future__ import annotations

import ctypes
import py_compile
import shutil
import subprocess
from pathlib import Path

import damping_oracle
import numpy as np
import pytest

import holdfast as hf
from holdfast.errors import InputError, StoreError

COMPILER = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
EXAMPLES = Path(__file__).parents[2] / "examples"
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


@needs_compiler
@pytest.mark.parametrize("slug", list(hf.control.BY_NAME))
def test_c_does_what_the_kernel_does(slug, rng, tmp_path, monkeypatch):
    arm = hf.arms.load("planar-3r")
    options = {"weighted": {"weights": [1.0, 2, 3]}, "damped": {"damping": 0.3}}
    law = hf.control.by_name(slug, arm, task="planar", **options.get(slug, {}))
    jit = hf.control.by_name(slug, arm, task="planar", **options.get(slug, {}))
    others = 3 if slug == "failure-tolerant" else 0
    files = law.export_c(tmp_path / "new" / "folder")
    assert [f.name for f in files] == [f"{slug.replace('-', '_')}{end}" for end in (".c", ".h")]
    call = compiled(*files, 2, 3, others)
    q, v = rng.uniform(-np.pi, np.pi, (300, 3)), rng.normal(size=(300, 2))
    compiled_here = jit.velocity(q, v)  # its sines differ in the last digit, and a damping where PKE is flat by more
    monkeypatch.setenv("HOLDFAST_BACKEND", "casadi")
    rates, damping = law.velocity(q, v), law.damping(q, v)
    for k in range(len(q)):
        code, got, told = call(q[k], v[k])
        size = np.abs(rates[k]).max()
        assert code == 0
        np.testing.assert_allclose(got, rates[k], rtol=0, atol=1e-12 * size)
        np.testing.assert_allclose(got, compiled_here[k], rtol=0, atol=1e-7 * (1 + size**2))
        if others:
            np.testing.assert_allclose(told, [damping[k], law.largest_damping(q[k], v[k]), 1], rtol=1e-12)
            assert call(q[k], v[k], nulls=True)[0] == 0


@needs_compiler
def test_what_has_no_answer_stops_the_arm(tmp_path):
    arm = hf.arms.load("planar-3r")
    call = compiled(*hf.control.pseudoinverse(arm, "planar").export_c(tmp_path), 2, 3, 0)
    for q, v in (([np.nan, 0, 1], [1, 0]), ([0.1, 0.2, 1], [np.inf, 0]), ([0, 0, 0], [1, 0])):
        code, rates, _ = call(q, v)
        assert code == 1
        np.testing.assert_array_equal(rates, 0)


@needs_compiler
def test_seven_joints_and_a_pose(rng, tmp_path, monkeypatch):
    """The longest law there is; unoptimised, as the compiler takes long for 29,000 operations."""
    monkeypatch.setenv("HOLDFAST_BACKEND", "casadi")
    law = hf.control.failure_tolerant(damping_oracle.arm_7r(), "pose")
    call = compiled(*law.export_c(tmp_path, "seven"), 6, 7, 3, "-O0")
    q, v = rng.uniform(-np.pi, np.pi, (200, 7)), rng.normal(size=(200, 6))
    for a, b, rates, damping in zip(q, v, law.velocity(q, v), law.damping(q, v), strict=True):
        code, got, told = call(a, b)
        assert code == 0
        np.testing.assert_allclose(got, rates, rtol=1e-12, atol=1e-12 * np.abs(rates).max())
        assert told[0] == pytest.approx(damping, rel=1e-12)


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
