"""Optional packages that are not there: one sentence, and everything else works."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import numpy as np
import pytest

import holdfast as hf
from holdfast.control import equilibria
from holdfast.core.errors import HoldfastError
from holdfast.core.extras import guard_imports, import_extra
from holdfast.teleop.protocol.protocol import read_protocol

SENTENCE = (
    r"xarray is needed here and is not installed; install holdfast-arms\[xarray\] \(pip install 'holdfast-arms\[xarray\]'\)"
)
ARM = hf.arms.load("planar-3r")
LAW = hf.control.pseudoinverse(ARM, "planar")
FEW = {"configurations": 1, "time_limit": 20.0}
RESULTS = {
    "Assessment": lambda: hf.assess(ARM, task="planar", poses=8, keep=True).dataset,
    "Assessment in a folder": lambda: hf.load("run").dataset,
    "Basins": lambda: hf.basins(LAW, [1.5, 1.5], {1: 0.8}, grid=2).to_xarray(),
    "ConvergenceMap": lambda: hf.convergence_map(LAW, [1.0, 1.0], 1, **FEW).to_xarray(),
    "TargetMeasures": lambda: hf.workspace(LAW, [[1.0, 1.0]], 1, over="targets", points=0, **FEW).to_xarray(),
    "TolerantWorkspace": lambda: hf.tolerant_workspace(ARM, "planar").to_xarray(),
    "Workspace": lambda: hf.workspace(LAW, [1.0, 1.0], 1, points=0, **FEW).to_xarray(),
}


@pytest.mark.parametrize("name", RESULTS)
def test_a_result_says_that_xarray_is_missing(name, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    if name == "Assessment in a folder":
        hf.assess(ARM, task="planar", poses=8, store="run", keep=True)
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(HoldfastError, match=SENTENCE):
        RESULTS[name]()


def test_every_public_result_with_a_data_set_is_in_the_table():
    classes = {name for name in (*dir(hf), "Basins") if hasattr(getattr(hf, name, equilibria.Basins), "to_xarray")}
    assert classes == set(RESULTS) - {"Assessment", "Assessment in a folder"}


def test_tables_of_an_experiment_say_that_pandas_is_missing(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(HoldfastError, match=r"pandas is needed here and is not installed; install holdfast-arms\[stats\]"):
        hf.teleop.describe_columns(read_protocol())


def test_a_recording_says_that_rerun_is_missing(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "rerun", None)
    runs = hf.simulate(LAW, [0.3, 0.5, 0.4], [1.5, 1.5])
    with pytest.raises(HoldfastError, match=r"rerun-sdk is needed here and is not installed; install holdfast-arms\[rerun\]"):
        runs.to_rrd(tmp_path / "run.rrd")


def test_an_extra_that_is_there_is_returned():
    assert import_extra("numpy", "none") is np


PROGRAM = """
import sys
for name in sys.argv.pop(1).split(","):
    sys.modules[name] = None
from holdfast.interface.cli import main
main()
"""


def run_without(modules, *command, **options):
    """Run a command in a process that cannot import some modules."""
    run = [sys.executable, "-c", PROGRAM, modules, *command]
    return subprocess.run(run, capture_output=True, text=True, env={**os.environ, "COLUMNS": "100"}, check=False, **options)


def test_an_assessment_and_its_report_need_neither_xarray_nor_pandas(tmp_path):
    done = run_without("xarray,pandas", "assess", "planar-3r", "--poses", "16", "--out", "r", "--json", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)
    assert (tmp_path / "r" / "report.html").exists()


Q = "0.3 0.5 0.7"
ASSESS = ["assess", "planar-3r", "--poses", "16"]
TERMINAL = {
    "describe": ["describe", "planar-3r"],
    "assess": ASSESS,
    "simulate": ["simulate", "planar-3r", "--target", "1.5,1.5", "--start", Q, "--lock", "2"],
    "recover": ["recover", "planar-3r", "--lock", "2", "--at", Q, "--goal", "pose:1.5,1.5,0", "--samples", "0"],
}
REPORT_MODULES = "matplotlib,zarr,numcodecs,PIL"


@pytest.mark.parametrize("name", TERMINAL)
def test_the_terminal_needs_neither_matplotlib_nor_zarr(name, tmp_path):
    done = run_without(REPORT_MODULES, *TERMINAL[name], cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert len(done.stdout.splitlines()) > 5


@pytest.mark.parametrize("name", [name for name in TERMINAL if name != "describe"])
def test_a_report_without_matplotlib_is_refused_before_anything_is_computed(name, tmp_path):
    done = run_without(REPORT_MODULES, *TERMINAL[name], "--out", "r", cwd=tmp_path)
    expected = "--out needs matplotlib, which is not installed; install it with: pip install 'holdfast-arms[report]'"
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"holdfast: {expected}\n")
    assert list(tmp_path.iterdir()) == []


def test_a_results_folder_without_zarr_is_refused_before_anything_is_written(tmp_path):
    done = run_without("zarr", *ASSESS, "--out", "r", cwd=tmp_path)
    expected = "a results folder needs zarr, which is not installed; install it with: pip install 'holdfast-arms[report]'"
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"holdfast: {expected}\n")
    assert not (tmp_path / "r").exists()


def test_results_in_python_say_that_matplotlib_is_missing(monkeypatch, tmp_path):
    basins = hf.basins(LAW, [1.5, 1.5], {1: 0.8}, grid=2)
    for name in [name for name in sys.modules if name.startswith(("matplotlib", "holdfast.interface."))]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    for draw in (basins.plot, basins.figures, lambda: basins.report(tmp_path / "r.html"), lambda: basins.save(tmp_path / "r")):
        with pytest.raises(HoldfastError, match=r"matplotlib, which is not installed; .* 'holdfast-arms\[report\]'$"):
            draw()
    view = basins._repr_html_().replace("\N{NO-BREAK SPACE}", " ")
    assert basins.describe()[0] in view
    assert "holdfast-arms[report]" in view


def test_another_missing_module_keeps_its_error():
    with pytest.raises(ModuleNotFoundError, match="nowhere"), guard_imports("a figure"):
        raise ModuleNotFoundError("nowhere", name="nowhere")
