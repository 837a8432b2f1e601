"""The monitor in C: compiled without a warning, and in every cycle what the one in Python says."""

from __future__ import annotations

import shutil
import subprocess

import c_monitor
import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError

needs_compiler = pytest.mark.skipif(c_monitor.COMPILER is None, reason="no C compiler (cc, gcc or clang) on this machine")


@needs_compiler
def test_c_says_what_python_says(rng, tmp_path):
    arm = hf.arms.load("panda")
    bounds = c_monitor.bounds_of(arm)
    worst, unlike, named = c_monitor.compared(arm, c_monitor.built(arm, bounds, tmp_path), 20, rng, bounds)
    assert worst <= c_monitor.TOLERANCE
    assert unlike == 0
    assert len(named) > 2  # of 20 records, whatever the seed: 5 to 8 for each of 16


@needs_compiler
def test_the_example_watches_a_record(tmp_path):
    """An arm without torques, from a console, and a header that C++ takes."""
    arm = hf.arms.load("planar-3r")
    logs, t = [], np.arange(1500) / 1000
    for k in range(2):
        q = 0.3 * np.sin(np.outer(t - 0.1 * np.tanh(t / 0.1), [1.0, 1.3, 0.7 + 0.1 * k]))
        logs.append(hf.faults.Log(t=t, q_ref=q, q=q - 1e-3 * np.sin(40 * t)[:, None]))
    bounds = hf.diagnosis.calibrate(arm, logs)
    made = hf.diagnosis.export_c(arm, bounds, tmp_path, name="watch")
    assert made.digest in made.header.read_text(encoding="utf-8")
    assert arm.fingerprint in made.header.read_text(encoding="utf-8")
    command = [c_monitor.COMPILER, *c_monitor.FLAGS, "watch.c", "watch_example.c", "-lm", "-o", "watch"]
    subprocess.run(command, cwd=tmp_path, check=True, timeout=100)
    stuck = logs[0].q.copy()
    stuck[700:, 1] = stuck[700, 1]
    for q, code, words in ((logs[0].q, 0, "does not prove"), (stuck, 3, "joint2: locked")):
        text = "\n".join(" ".join(map(repr, row)) for row in np.c_[q, logs[0].q_ref, 0 * q].tolist())
        done = subprocess.run([str(tmp_path / "watch")], input=text, capture_output=True, text=True, check=False)
        assert done.returncode == code
        assert words in done.stdout
    if shutil.which("nm"):  # nothing but arithmetic is called: no memory, no files, no clocks
        subprocess.run([c_monitor.COMPILER, "-O2", "-c", "watch.c"], cwd=tmp_path, check=True, timeout=60)
        said = subprocess.run(["nm", "-P", "watch.o"], cwd=tmp_path, capture_output=True, text=True, check=True).stdout
        names = {line.split()[0].lstrip("_"): line.split()[1] for line in said.splitlines()}
        called = {name for name, kind in names.items() if kind == "U"}
        assert called <= {"sin", "cos", "sincos", "sqrt", "tanh", "atan2", "memset", "memcpy", "stack_chk_fail"}
        assert not [name for name, kind in names.items() if kind in "BbDdC" and name != "watch_joints" and "names" not in name]
    if shutil.which("g++"):
        command = ["g++", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-x", "c++", str(made.header)]
        subprocess.run([*command, "-Wno-pragma-once-outside-header"], check=True, timeout=60)


def test_what_is_not_written(tmp_path):
    arm = hf.arms.load("planar-3r")
    bounds = c_monitor.bounds_of(arm)
    with pytest.raises(InputError, match="cannot name a C function"):
        hf.diagnosis.export_c(arm, bounds, tmp_path, name="2")
    with pytest.raises(InputError, match="the thresholds are not of"):
        hf.diagnosis.export_c(hf.arms.load("panda"), bounds, tmp_path)
