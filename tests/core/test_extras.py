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
from holdfast.core.extras import import_extra
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


BLOCKED = """
import sys
sys.modules["xarray"] = sys.modules["pandas"] = None
from holdfast.interface.cli import main
main()
"""


def test_an_assessment_and_its_report_need_neither_xarray_nor_pandas(tmp_path):
    command = ["assess", "planar-3r", "--poses", "16", "--out", "r", "--json"]
    environment = {**os.environ, "COLUMNS": "100"}
    done = subprocess.run(
        [sys.executable, "-c", BLOCKED, *command], capture_output=True, text=True, cwd=tmp_path, env=environment, check=False
    )
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)
    assert (tmp_path / "r" / "report.html").exists()
