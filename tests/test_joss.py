"""Every claim of the draft in ``paper`` has a command that exists, and the number stands where that command writes it."""

from __future__ import annotations

import re
import shlex
from importlib.util import find_spec
from pathlib import Path

import pytest
import typer
import yaml

from holdfast.interface.cli.program import build_app

ROOT = Path(__file__).parents[1]
SOURCE = (ROOT / "paper" / "paper.md").read_text(encoding="utf-8")
PAPER = " ".join(SOURCE.split())
ROWS = [
    [cell.strip() for cell in line.strip("| ").split(" | ")]
    for line in (ROOT / "paper" / "claims.md").read_text(encoding="utf-8").splitlines()
    if line.startswith("| C")
]


def parsed(command: str) -> None:
    """Options and arguments of a command of the program, read as it reads them; nothing is computed."""
    arguments = shlex.split(command)[1:]
    program = typer.main.get_command(build_app(arguments[0]))
    with program.make_context("holdfast", list(arguments)) as context:
        name, found, rest = program.resolve_command(context, arguments)
        found.make_context(name, rest, parent=context)


def rounded(said: str, computed: str) -> bool:
    """Whether every number of ``said`` is one that was computed, rounded at most."""
    figures = [float(figure) for figure in re.findall(r"\d+(?:\.\d+)?", computed)]
    return all(
        any(round(one, len(figure.partition(".")[2])) == float(figure) for one in figures)
        for figure in re.findall(r"\d+(?:\.\d+)?", said)
    )


def test_every_claim_has_a_row_and_every_row_a_claim():
    cited = re.findall(r"\(C(\d+)\)", PAPER.split("# Summary")[1])
    assert len(ROWS) == len(set(cited)) > 10
    assert {f"C{number}" for number in cited} == {row[0] for row in ROWS}


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0])
def test_a_claim_is_computed_by_a_command_and_stands_in_a_file(row):
    number, said, computed, command, file = row
    after = PAPER.split(said)[1] if PAPER.count(said) == 1 else ""
    assert re.search(r"\(C\d+\)", after)[0] == f"({number})"  # the next mark after the sentence is its own
    assert rounded(said, computed)
    text = (ROOT / file).read_text(encoding="utf-8")
    quoted = re.findall(r"`([^`]+)`", computed)
    assert quoted
    for part in quoted:
        assert part in text, f"{file} does not say '{part}' (any more): paper/claims.md and paper/paper.md are to follow"
    words = shlex.split(command.strip("`"))
    match words:
        case ["holdfast", "--help"]:
            pass
        case ["holdfast", *_]:
            parsed(command.strip("`"))
        case ["python", "-m", module, *_] if module.split(".")[0] in ("papers", "tools"):
            assert find_spec(module) is not None
            assert find_spec(f"{module}.__main__") is not None if (ROOT / module.replace(".", "/")).is_dir() else True
        case ["python", script, *_] if script.startswith("benchmarks/"):
            assert (ROOT / script).is_file()
        case _:
            pytest.fail(f"no command of holdfast: {command}")


def test_an_option_that_does_not_exist_is_noticed():
    with pytest.raises(typer.exceptions.TyperException):
        parsed("holdfast assess pa10-9dof --posse 2000")


def test_a_number_of_the_text_that_differs_is_noticed():
    assert rounded("0.48 and 70 %", "0.4847 of 69.9 %")
    assert not rounded("0.49", "0.4847 of 69.9 %")
    assert not rounded("71 %", "0.4847 of 69.9 %")


def test_every_reference_is_in_the_bibliography_and_cited():
    keys = set(re.findall(r"^@\w+\{(\w+),", (ROOT / "paper" / "paper.bib").read_text(encoding="utf-8"), re.MULTILINE))
    assert keys == set(re.findall(r"@([A-Z]\w+)", PAPER))
    front = yaml.safe_load(SOURCE.split("---")[1])
    assert {"title", "tags", "authors", "affiliations", "date", "bibliography"} <= front.keys()
