"""What the documentation makes from the code: commands with every option, equations with the functions that compute them."""

from __future__ import annotations

import inspect
import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from typing import Annotated, get_args, get_origin, get_type_hints

import pytest
import typer

from holdfast.interface.cli.declaration import as_typer
from holdfast.interface.cli.program import COMMAND_MODULES

DOCS = Path(__file__).parents[1] / "docs"
sys.path.insert(0, str(DOCS / "_ext"))
commands, equations, live = (pytest.importorskip(name) for name in ("commands", "equations", "live"))


@pytest.fixture(scope="module")
def pages():
    return commands.written()


def test_every_link_has_a_text():
    """Sphinx fills in the title of a page where a link has no text; a plain Markdown viewer shows nothing."""
    root = DOCS.parent
    files = [*DOCS.rglob("*.md"), *root.glob("*.md"), *(root / "examples").rglob("*.md")]
    blank = [
        f"{file.relative_to(root)}: {link}"
        for file in files
        if "_build" not in file.parts
        for link in re.findall(r"(?<!!)\[\s*\]\([^)]*\)", file.read_text(encoding="utf-8"))
    ]
    assert not blank


def functions(name):
    """The functions of a command, or of the commands of a group, with how each is called."""
    module, _, function = COMMAND_MODULES[name].partition(":")
    found = getattr(import_module(f"holdfast.interface.cli.{module}"), function or "command")
    if not isinstance(found, typer.Typer):
        return {name: as_typer(found)}
    return {
        f"{name} {each.name or each.callback.__name__.replace('_', '-')}": as_typer(each.callback)
        for each in found.registered_commands
    }


@pytest.mark.parametrize("name", COMMAND_MODULES)
def test_the_page_of_a_command_has_every_option_with_its_default(pages, name):
    page = pages[f"holdfast-{name}"]
    for called, function in functions(name).items():
        part = page.split(f"\nholdfast {called}\n")[-1].split("\nholdfast ")[0] if " " in called else page
        shown = dict(re.findall(r"^\.\. option:: (.+)\n\n   (.*)$", part, re.M))
        signature = inspect.signature(function)
        hints = get_type_hints(function, include_extras=True)
        for argument, hint in hints.items():
            info = next((x for x in get_args(hint)[1:] if isinstance(x, typer.models.OptionInfo)), None)
            if get_origin(hint) is not Annotated or info is None or info.hidden:
                continue
            names = info.param_decls or [f"--{argument.strip('_').replace('_', '-')}"]
            text = [text for head, text in shown.items() if re.split(r"[ ,/]", names[0])[0] in re.split(r"[ ,]+", head)]
            assert text, f"{called} {names}"
            value = signature.parameters[argument].default
            if isinstance(value, str | int | float) and not isinstance(value, bool) and "Default:" not in (info.help or ""):
                assert f"``{value}``" in text[0]


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (
            "Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, eq. (8), (9). The search is ours.",
            [("Goel2003", 8), ("Goel2003", 9)],
        ),
        (
            "Goel et al. 2005, eq. (18) to (20); English (1998), eq. (1)-(3)",
            [("Goel2005", k) for k in (18, 19, 20)] + [("English1998", k) for k in (1, 2, 3)],
        ),
        ("(N,) PKE, eq. (8): the largest.", [(None, 8)]),
        ("Smith 1990, (3) joints (2012)", []),
    ],
)
def test_equations_are_read_as_people_cite_them(text, found):
    assert list(equations.cited(text)) == found


def test_an_equation_is_found_by_its_number_in_any_spelling():
    table = equations.table()
    assert ":py:obj:`holdfast.kinematics.indices.susceptibility.torque`" in table["English1998"][12]
    assert ":py:obj:`holdfast.kinematics.indices.relative_manipulability`" in table["Abdi2012"][4]
    assert ":py:obj:`holdfast.joint_bounds`" in table["Goel2005"][8]
    assert "``holdfast.model.arm.statics.moment_derivative``, inside" in table["English1998"][15]
    of_a_module = table["Goel2003"][8]  # whose docstring names one paper; the function says "eq. (8)" alone
    assert ":py:obj:`holdfast.control.Deviations.peak_velocity_error`" in of_a_module
    spelled = {text.lower() for text in equations.spellings("English1998", 12)}
    assert spelled >= {"english 1998 eq. 12", "english 1998 eq. (12)", "english and maciejewski 1998 equation 12", "eq. (12)"}


def test_the_how_to_pages_name_the_page_that_a_command_writes():
    said = "\n\n".join(p.read_text() for p in sorted((DOCS / "how-to").glob("*.md"))).split("\n\n")
    silent = []
    for name in COMMAND_MODULES:
        for called, function in functions(name).items():
            told = get_type_hints(function, include_extras=True).get("out")
            text = next((x.help or "" for x in get_args(told)[1:] if isinstance(x, typer.models.OptionInfo)), "")
            if "report" in text and not any("--out" in part and re.search(rf"holdfast {called}\b(?!-)", part) for part in said):
                silent.append(called)
    assert not silent, f"say in docs/how-to what the page of --out shows: {', '.join(silent)}"


def test_a_command_of_a_page_says_what_a_process_of_its_own_says(tmp_path):
    for line, expected in (
        ("holdfast index planar-3r --q '10 20' --degrees", 2),
        ("holdfast stationary-points planar-3r --target 1.5,1.5 --lock 2=100 --degrees --out found", 0),
        ("holdfast arms | head -2", 0),
    ):
        done = live.executed(line, tmp_path)
        alone = subprocess.run(line, shell=True, cwd=tmp_path, env=live.environment(), capture_output=True, text=True)
        assert (done.returncode, done.stdout, done.stderr) == (alone.returncode, alone.stdout, alone.stderr)
        assert done.returncode == expected
        assert done.stdout or done.stderr
