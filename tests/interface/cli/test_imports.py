"""What a command imports: nothing that it does not use, and no other command."""

from __future__ import annotations

import ast
import json
import re
import subprocess
import sys
from inspect import signature
from pathlib import Path
from typing import Annotated, get_origin

import pytest

from holdfast.interface import cli as package
from holdfast.interface.cli.declaration import require_matplotlib
from holdfast.interface.cli.program import COMMAND_MODULES, PANEL_TITLES, build_app

# What is slow to import. The list of each command is exact: what it no longer loads is taken from it and stays away.
HEAVY = {"scipy", "scipy.stats", "matplotlib", "jinja2", "xarray", "zarr", "pydantic", "mujoco"}
BESIDE_XARRAY = {"pandas", "pyarrow", "dask"}  # where they are installed
SERVING = {"starlette", "uvicorn", "websockets"}
STATISTICS = {"statsmodels", "pingouin"}
FILES = {"pydantic"}

PROGRAM = """
import json, sys
from holdfast.interface.cli import main
try:
    main()
except SystemExit as end:
    assert end.code in (None, 0, 3), end.code
print(json.dumps(sorted(sys.modules)), file=sys.stderr)
"""
Q = ["--q", "0.3 0.5 0.7"]
PLANAR = ["planar-3r", "--target", "1.5,1.5"]
LAWS = ["--law", "pseudoinverse", "--law", "damped:0.3", "--time-limit", "50", "--motions", "2"]
LEAN = [
    (["--help"], set()),
    (["simulate", "--help"], FILES),
    (["--version"], set()),
    (["arms"], FILES),
    (["describe", "planar-3r"], FILES),
    (["index", "planar-3r", "--task", "planar", *Q], FILES),
    (["susceptibility", "planar-3r", *Q], FILES),
    (["optimise", "planar-3r", "--at", "0.3 0.5 0.7", "--minimise", "torque"], FILES),
    (["simulate", *PLANAR, "--start", "0.3 0.5 0.7", "--lock", "2"], FILES),
    (["stationary-points", *PLANAR, "--lock", "2=1"], FILES),
    (["self-motion", *PLANAR, "--bounds"], FILES),
    (["teleop", "protocol"], FILES),
    (["teleop", "allocation"], FILES),
]
FEW = ["--starts", "2", "--configurations", "2", "--points", "1"]
RICHER = [
    (["assess", "planar-3r", "--task", "planar", "--poses", "64", "--json"], FILES | {"scipy"}),
    (["power-loss", "planar-3r", *Q, "--physics"], FILES | {"mujoco"}),
    (["workspace", *PLANAR, *FEW], FILES | {"scipy"}),
    (["trade-off", "planar-3r", "--samples", "10"], FILES | {"scipy", "scipy.stats"}),
    (["compare-laws", "planar-3r", *LAWS], FILES | {"scipy", "scipy.stats"}),
    (["recover", "planar-3r", "--lock", "2", "--at", "0.3 0.5 0.7", "--goal", "home"], FILES | {"scipy"}),
    (["export", "planar-3r", "--law", "pseudoinverse", "--out", "."], FILES),
    (["study", "new", "cell.yaml", "--arm", "planar-3r", "--poses", "64"], FILES | {"scipy"}),
]


def modules(*arguments, **options):
    """All that was imported when the command had ended."""
    run = [sys.executable, "-c", PROGRAM, *arguments]
    done = subprocess.run(run, capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stderr
    return set(json.loads(done.stderr.splitlines()[-1]))


def label(x):
    return " ".join(x[:2]) if isinstance(x, list) else ""


def loads_only(found, expected):
    assert found & HEAVY == expected
    assert found & (SERVING | STATISTICS) == set()
    assert "xarray" in expected or found & BESIDE_XARRAY == set()


@pytest.mark.parametrize(("arguments", "heavy"), LEAN, ids=label)
def test_a_command_imports_what_it_uses(arguments, heavy, monkeypatch):
    monkeypatch.setenv("HOLDFAST_BACKEND", "casadi")  # what compiles is another question
    found = modules(*arguments)
    loads_only(found, heavy)
    assert "casadi" not in found or not {"--help", "--version"} & set(arguments)
    if not arguments[0].startswith("-"):
        module = {name: f"holdfast.interface.cli.{place.partition(':')[0]}" for name, place in COMMAND_MODULES.items()}
        assert found & set(module.values()) == {module[arguments[0]]}


@pytest.mark.parametrize(("arguments", "heavy"), RICHER, ids=label)
def test_a_command_that_needs_more_imports_no_more_than_that(arguments, heavy, monkeypatch, tmp_path):
    loads_only(modules(*arguments, cwd=tmp_path), heavy)


def test_an_option_for_figures_is_refused_without_matplotlib_before_the_command_begins():
    app = build_app()
    commands = [
        *app.registered_commands,
        *(one for group in app.registered_groups for one in group.typer_instance.registered_commands),
    ]
    options = [
        (f"{command.name or command.callback.__name__} {parameter.name}", parameter.annotation.__metadata__[-1])
        for command in commands
        for parameter in signature(command.callback).parameters.values()
        if get_origin(parameter.annotation) is Annotated
    ]
    drawn = {name: option for name, option in options if re.search(r"figure|PNG|picture|bank\.png", option.help or "")}
    assert len(drawn) > 15
    assert [name for name, option in drawn.items() if option.callback is not require_matplotlib] == []


PATH = """
name: across
line: {from: {xyz: [1.2, 0.4, 0]}, to: {xyz: [0.8, 0.4, 0]}}
timing: {duration: 1}
"""


def test_a_motion_is_drawn_without_matplotlib(tmp_path, monkeypatch):
    (tmp_path / "path.yaml").write_text(PATH)
    follow = ["follow", "planar-3r", "path.yaml", "--task", "planar", "--minimise", "torque", "--samples", "11", "--out", "m"]
    loads_only(modules(*follow, cwd=tmp_path), FILES | {"jinja2"})
    assert (tmp_path / "m" / "report.html").exists()


def test_a_report_is_written_without_what_its_numbers_do_not_need(tmp_path, monkeypatch):
    modules("assess", "planar-3r", "--poses", "20", "--seed", "1", "--out", "r", cwd=tmp_path)
    (tmp_path / "r" / "report.html").unlink()
    found = modules("report", "r", cwd=tmp_path)
    assert found & {"xarray", "scipy.spatial", "matplotlib.pyplot", *BESIDE_XARRAY, *SERVING, *STATISTICS} == set()
    assert (tmp_path / "r" / "report.html").exists()


def test_the_library_waits_for_what_is_asked():
    code = "import holdfast as hf, sys; print(sorted({'numpy', 'casadi', 'yaml'} & set(sys.modules))); hf.ArmError, hf.Status"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_the_help_lists_every_command_in_its_order_and_panel(cli):
    lines = cli("--help")[1].splitlines()
    shown = [found[1] for line in lines if (found := re.match("│ ([a-z][a-z-]+) ", line))]
    assert shown == list(COMMAND_MODULES)
    panels = [words for line in lines if (words := line.strip("╭╮─ ")) in PANEL_TITLES.values()]
    assert panels == list(PANEL_TITLES.values())
    folders = [place.partition(".")[0] for place in COMMAND_MODULES.values()]
    assert folders == sorted(folders, key=list(PANEL_TITLES).index)


def test_every_command_is_in_the_table():
    places = {place.partition(":")[0] for place in COMMAND_MODULES.values()}
    for panel in PANEL_TITLES:
        for file in sorted((Path(package.__file__).parent / panel).glob("*.py")):
            defined = {getattr(node, "name", "") for node in ast.parse(file.read_text(encoding="utf-8")).body}
            if "command" in defined and f"{panel}.{file.stem}" not in places:
                pytest.fail(
                    f"no line of COMMAND_MODULES in src/holdfast/interface/cli/program.py names {panel}.{file.stem}, "
                    "which defines a command"
                )


@pytest.mark.parametrize("name", COMMAND_MODULES)
def test_a_command_is_found_alone(name):
    one = build_app(name)
    assert [each.name for each in [*one.registered_commands, *one.registered_groups]] == [name]


def test_a_mistyped_command_is_still_guessed(refused):
    assert "Did you mean 'simulate', 'simulate-logs'?" in refused("simulat")
