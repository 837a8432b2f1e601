"""What a command declares becomes options, and what is given comes back as it was declared."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

import pytest
import typer
from typer.testing import CliRunner

from holdfast.interface.cli.declaration import as_typer

Kind = Annotated[Literal["inside", "whole"], typer.Option("--relative-to", help="Of which part.")]
seen = []


@dataclass(frozen=True)
class Box:
    edge_length: Annotated[float, "Edge, m."]
    name_: Annotated[str, "What it is called."] = "box"
    lid: Annotated[bool, "With a lid."] = False


def bare(box: Box, kind: Kind = "inside", most: Annotated[int | None, "How many.", "all"] = None) -> None:
    seen.append((box, kind, most))


def with_defaults(box: Box = Box(2.0, "crate", lid=True)) -> None:
    seen.append(box)


@pytest.fixture
def run():
    seen.clear()

    def call(command, *words):
        app = typer.Typer(add_completion=False)
        app.command()(as_typer(command))
        return CliRunner().invoke(app, words)

    return call


def test_options_of_a_group_come_back_as_the_group(run):
    words = ["--edge-length", "0.5", "--lid", "--relative-to", "whole", "--most", "3"]
    assert run(bare, *words).exit_code == 0
    assert run(bare, "--edge-length", "1").exit_code == 0
    assert seen == [(Box(0.5, lid=True), "whole", 3), (Box(1.0), "inside", None)]


def test_what_has_no_default_is_required_and_a_given_group_has_its_values(run):
    assert run(bare).exit_code == 2
    assert run(with_defaults, "--name", "chest").exit_code == 0
    assert seen == [Box(2.0, "chest", lid=True)]


def test_the_help_says_what_is_declared_in_its_order(run):
    said = run(bare, "--help").output
    parts = ["--edge-length", "Edge, m.", "--name", "[default: box]", "--lid", "--relative-to", "--most", "How many.", "(all)"]
    places = [said.index(part) for part in parts]
    assert places == sorted(places)
    assert "--no-lid" not in said


def test_a_command_that_typer_reads_already_stays_as_it_is():
    once = as_typer(bare)
    assert as_typer(once) is once
