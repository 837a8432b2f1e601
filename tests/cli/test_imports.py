"""What a command imports: nothing that it does not use, and no other command."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

from holdfast.cli.app import COMMANDS, program

DRAWING = {"matplotlib", "jinja2"}
STORING = {"xarray", "zarr", "pandas", "pyarrow", "dask"}
PHYSICS = {"mujoco"}
STATISTICS = {"scipy.stats", "statsmodels", "pingouin"}
SERVING = {"starlette", "uvicorn", "viser", "websockets"}
EVERYTHING = {"scipy", *DRAWING, *STORING, *PHYSICS, *STATISTICS, *SERVING}

PROGRAM = """
import json, sys
from holdfast.cli import main
try:
    main()
except SystemExit as end:
    assert end.code in (None, 0, 3), end.code
print(json.dumps(sorted(sys.modules)), file=sys.stderr)
"""
Q = ["--q", "0.3 0.5 0.7"]
PLANAR = ["planar-3r", "--target", "1.5,1.5"]
LEAN = [
    (["--help"], EVERYTHING | {"casadi"}),
    (["simulate", "--help"], EVERYTHING | {"casadi"}),
    (["--version"], EVERYTHING | {"casadi"}),
    (["arms"], EVERYTHING),
    (["describe", "planar-3r"], EVERYTHING),
    (["index", "planar-3r", "--task", "planar", *Q], EVERYTHING),
    (["susceptibility", "planar-3r", *Q], EVERYTHING),
    (["configure", "planar-3r", "--at", "0.3 0.5 0.7", "--minimise", "torque"], EVERYTHING),
    (["simulate", *PLANAR, "--start", "0.3 0.5 0.7", "--lock", "2"], EVERYTHING),
    (["stationary", *PLANAR, "--lock", "2", "--at", "1"], EVERYTHING),
    (["self-motion", *PLANAR, "--bounds"], EVERYTHING),
    (["teleop", "protocol"], EVERYTHING),
    (["teleop", "allocation"], EVERYTHING),
]


def modules(*arguments, **options):
    """All that was imported when the command had ended."""
    run = [sys.executable, "-c", PROGRAM, *arguments]
    done = subprocess.run(run, capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stderr
    return set(json.loads(done.stderr.splitlines()[-1]))


@pytest.mark.parametrize(("arguments", "unused"), LEAN, ids=lambda x: " ".join(x[:2]) if isinstance(x, list) else "")
def test_a_command_imports_what_it_uses(arguments, unused, monkeypatch):
    monkeypatch.setenv("HOLDFAST_BACKEND", "casadi")  # what compiles is another question
    found = modules(*arguments)
    assert found & unused == set()
    if not arguments[0].startswith("-"):
        own = {f"holdfast.cli.{COMMANDS[arguments[0]]}"}
        assert {name for name in found if name.endswith("_commands")} == own


PATH = """
name: across
line: {from: {xyz: [1.2, 0.4, 0]}, to: {xyz: [0.8, 0.4, 0]}}
timing: {duration: 1}
"""


def test_a_motion_is_drawn_without_matplotlib(tmp_path, monkeypatch):
    monkeypatch.setenv("HOLDFAST_BACKEND", "casadi")
    (tmp_path / "path.yaml").write_text(PATH)
    follow = ["follow", "planar-3r", "path.yaml", "--task", "planar", "--minimise", "torque", "--samples", "11", "--out", "m"]
    assert modules(*follow, cwd=tmp_path) & (EVERYTHING - {"jinja2"}) == set()
    assert (tmp_path / "m" / "report.html").exists()


def test_a_report_is_written_without_what_its_numbers_do_not_need(tmp_path, monkeypatch):
    monkeypatch.setenv("HOLDFAST_BACKEND", "casadi")
    modules("assess", "planar-3r", "--poses", "20", "--seed", "1", "--out", "r", cwd=tmp_path)
    (tmp_path / "r" / "report.html").unlink()
    unused = {"xarray", "pandas", "pyarrow", "dask", "scipy.spatial", "matplotlib.pyplot", *PHYSICS, *STATISTICS, *SERVING}
    assert modules("report", "r", cwd=tmp_path) & unused == set()
    assert (tmp_path / "r" / "report.html").exists()


def test_the_library_waits_for_what_is_asked():
    code = "import holdfast as hf, sys; print(sorted({'numpy', 'casadi', 'yaml'} & set(sys.modules))); hf.ArmError, hf.Status"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_the_help_lists_every_command_in_its_order():
    registered = [c.name or c.callback.__name__ for c in program().registered_commands]
    groups = [g.name or g.typer_instance.info.name for g in program().registered_groups]
    assert sorted([*registered, *groups]) == sorted(COMMANDS)
    assert registered == [name for name in COMMANDS if name not in groups]
    for name in COMMANDS:
        one = program(name)
        assert name in [c.name or c.callback.__name__ for c in one.registered_commands] + [
            g.name or g.typer_instance.info.name for g in one.registered_groups
        ]


def test_a_mistyped_command_is_still_guessed(refused):
    assert "Did you mean 'simulate'?" in refused("simulat")
