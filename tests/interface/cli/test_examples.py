"""The example in the help of every command works in an empty folder, and ``--json`` is ``to_dict()`` of the result."""

from __future__ import annotations

import contextlib
import inspect
import io
import json
import re
import shlex
import sys
from importlib import import_module

import pytest
import typer

from holdfast.interface.cli import groups
from holdfast.interface.cli.declaration import as_typer
from holdfast.interface.cli.program import COMMAND_MODULES
from holdfast.interface.presentation.printing import to_json_types
from holdfast.interface.presentation.results import print_result, print_results

# ---- what an example needs beside the command ----------------------------------------------------------------------------

FILES = {
    "path.yaml": "line: {from: {xyz: [0.45, -0.1, 0.5]}, to: {xyz: [0.45, 0.1, 0.5]}}\ntiming: {duration: 2}\n",
    "line.yaml": "angles: deg\nline: {from: {xyz: [0.45, -0.1, 0.4], urdf_rpy: [180, 0, 0]}, to: {xyz: [0.45, 0.1, 0.4]}}\n"
    "timing: {duration: 2}\n",
    "motion.csv": "joint1_rad,joint2_rad,joint3_rad\n0.3,0.8,1.1\n0.35,0.77,1.15\n",
    "bench.yaml": "objects: {table: {box: [0.8, 1.2, 0.04], pose: {xyz: [0.6, 0, -0.02]}}}\n",
    "faults.yaml": "faults: [{kind: locked, onset: {uniform: [0.3, 1.5]}}]\n",
    "cell.yaml": "box: {center: [0.5, 0, 0.5], size: 0.1, rpy_center: [180, 0, 0], rpy_size: 10}\nangles: deg\n",
}
STUDY = "study new tools.yaml --arm planar-3r --poses 64 --chunk 32"
EXPERIMENT = "teleop run --simulated --operators 2 --seed 1 --out experiment"
DONE = [STUDY, "study run tools.yaml --out tools"]
FIRST = {  # commands before
    "report": ["assess planar-3r --poses 16 --out results"],
    "study run": [STUDY],
    **{f"study {of}": DONE for of in ("status", "verify", "report")},
    "study merge": [STUDY, *(f"study run tools.yaml --out machine{k}/tools --part {k}/2" for k in (1, 2))],
    "calibrate": ["simulate-logs panda --records 2 --duration 1 --out healthy"],
    "diagnose": [
        "simulate-logs panda --records 2 --duration 1 --out healthy",
        "calibrate healthy/000000.npz healthy/000001.npz --arm panda --out bounds.json",
        "simulate-logs panda --faults faults.yaml --duration 2 --out faulty",
    ],
    "predict-detection": [
        "simulate-logs panda --records 2 --duration 1 --out healthy",
        "calibrate healthy/000000.npz healthy/000001.npz --arm panda --out bounds.json",
    ],
    **{f"certificate {of}": ["certify reach planar-3r --box '1.5 0.5' --size 0.2"] for of in ("check", "show")},
    **{f"teleop {of}": [EXPERIMENT] for of in ("replay", "verify", "backup", "export", "subjects")},
}
CHEAPER = {  # options at the end, the last of which counts
    "assess": "--poses 16",
    "basins": "--grid 4",
    "compare-laws": "--motions 2",
    "convergence-map": "--starts 2 --configurations 2 --time-limit 60",
    "optimise": "--starts 2",
    "design": "--designs 4 --local-searches 1 --poses 8 --check-poses 32",
    "follow": "--samples 11",
    "plan-motion": "--samples 5 --spacing 0.3",
    "reachability-map": "--samples 2000",
    "recover": "--samples 0",
    "simulate-logs": "--records 1 --duration 0.2",
    "power-loss": "--duration 0.2",
    "teleop run": "--operators 2",
    "teleop tasks": "--per-joint 20 --select 4 --no-special",
    "tolerant-workspace": "--points 50",
    "trade-off": "--samples 16",
    "workspace": "--starts 2 --configurations 2 --points 1",
}
APART = {"studio", "teleop serve", "teleop analyse"}  # servers; what test_teleop_commands runs word for word
QUICK = {"arms", "upper-bound", "describe", "faults draw", "index", "susceptibility", "stationary-points", "power-loss"}
QUICK |= {
    "certify reach",
    "certify ceiling",
    "certify floor",
    "certify hold",
    "certify structural-zero",
    "certify out-of-reach",
    "certify tolerant",
    "certify path",
    "certificate check",
    "certificate show",
    "record-designs list",
    "record-designs show",
    "record-designs check",
    "study new",
    "study run",
    "teleop allocation",
    "teleop protocol",
    "teleop texts",
}


def examples():
    """Each command with its function and the examples in its docstring."""
    for name, place in COMMAND_MODULES.items():
        module, _, function = place.partition(":")
        made = getattr(import_module(f"holdfast.interface.cli.{module}"), function or "command")
        parts = [("", made)]
        if isinstance(made, typer.Typer):
            parts = [(f" {each.name or each.callback.__name__}", each.callback) for each in made.registered_commands]
        for part, each in parts:
            yield f"{name}{part}", as_typer(each), re.findall(r"Example: holdfast (.+)", each.__doc__)


HERE = {name: (each, found[0]) for name, each, found in examples() if found and name not in APART}


def test_every_command_has_an_example():
    for name, _, found in examples():
        assert found, f"{name}: its docstring has no line 'Example: holdfast {name} ...'"
        assert all(text.startswith(name) for text in found)


def carry_out(name, cli, monkeypatch, folder):
    monkeypatch.chdir(folder)
    for file, text in FILES.items():
        (folder / file).write_text(text, encoding="utf-8")
    function, text = HERE[name]
    expected_code = 3 if name == "diagnose" else 0  # its log has a fault
    for first in FIRST.get(name, []):
        assert cli(*shlex.split(first))[0] == 0, first
    words = shlex.split(f"{text} {CHEAPER.get(name, '')}")
    module = sys.modules[function.__module__]
    shown = (
        "json_" in inspect.signature(function).parameters
        and re.search(r"print_results?\(", inspect.getsource(function)) is not None
    )
    # Computed once and shown both ways; a command that asks itself which way, or has no JSON, is run for people too.
    if not shown or re.search(r"if (not )?json_", inspect.getsource(function)):
        code, out, err = cli(*words)
        assert code == expected_code, err
        assert out
    if not shown:
        return
    found = []

    def seen(result, files=(), **more):
        with contextlib.redirect_stdout(io.StringIO()) as read:
            print_result(result, False, files, **more)
        assert read.getvalue().strip()
        found.append((result, more))

    def both(result, as_json, files=(), **more):
        assert as_json
        seen(result, files, **more)
        print_result(result, True, files, **more)

    def both_each(results, as_json):
        for result in results:
            seen(result)
        print_results(results, as_json)

    for place in (module, groups):
        monkeypatch.setattr(place, "print_result", both, raising=False)
    monkeypatch.setattr(module, "print_results", both_each, raising=False)
    code, out, err = cli(*words, "--json")
    assert code == expected_code, err
    ((result, asked),) = found
    asked.pop("listed", None)
    expected = json.loads(json.dumps(to_json_types(result.to_dict(**asked))))
    assert {key: value for key, value in json.loads(out).items() if key in expected} == expected


@pytest.mark.parametrize("name", sorted(QUICK))
def test_the_example(name, cli, monkeypatch, tmp_path):
    carry_out(name, cli, monkeypatch, tmp_path)


@pytest.mark.parametrize("name", sorted(set(HERE) - QUICK))
def test_the_example_that_takes_longer(name, cli, monkeypatch, tmp_path):
    carry_out(name, cli, monkeypatch, tmp_path)
