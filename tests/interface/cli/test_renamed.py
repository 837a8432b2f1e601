"""Renamed commands, options, and public names produce one sentence with the new name."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec

import pytest

from holdfast.core import renamed


@pytest.mark.parametrize("old", sorted(renamed.COMMAND_SUCCESSORS))
def test_a_renamed_command_names_its_successor(cli, old):
    code, out, error = cli(old)
    assert (code, out) == (2, "")
    assert error.startswith(f"holdfast: No such command '{old}'")
    assert error.endswith(f"; it is now '{renamed.COMMAND_SUCCESSORS[old]}'\n")
    assert len(error.splitlines()) == 1
    assert cli(*renamed.COMMAND_SUCCESSORS[old].split(), "--help")[0] == 0


@pytest.mark.parametrize("old", sorted(renamed.REPOSITORY_COMMANDS))
def test_a_command_that_left_the_package_names_its_place(cli, old):
    code, out, error = cli(old)
    command = renamed.REPOSITORY_COMMANDS[old]
    assert (code, out) == (2, "")
    assert error.endswith(f"; it is now '{command}' in a checkout of the repository\n")
    assert find_spec(command.removeprefix("python -m ") + ".__main__")


@pytest.mark.parametrize(
    ("command", "old"),
    [
        ("optimise", "--anywhere"),
        ("simulate-logs", "--body"),
        ("design", "--climbs"),
        ("design", "--fresh"),
        ("plan-motion", "--inject"),
        ("simulate", "--notice"),
    ],
)
def test_a_renamed_option_names_its_successor(cli, command, old):
    code, _, error = cli(command, "planar-3r", old, "1")
    assert code == 2
    assert error.endswith(f"; it is now '{renamed.OPTION_SUCCESSORS[old]}'\n")
    assert len(error.splitlines()) == 1
    assert renamed.OPTION_SUCCESSORS[old] in cli(command, "--help")[1]


def renamed_public_names(table):
    package = ""
    for word in table.split():
        if word.endswith(":"):
            package = word[:-1]
        else:
            yield package, *word.split("=")


@pytest.mark.parametrize(("package", "old", "new"), list(renamed_public_names(renamed.read_table("renamed_names.txt"))))
def test_a_renamed_public_name_names_its_successor(package, old, new):
    with pytest.raises(AttributeError, match=f"it is now {package}.{new}$"):
        getattr(import_module(package), old)
    assert hasattr(import_module(package), new)


@pytest.mark.parametrize(("package", "old", "new"), list(renamed_public_names(renamed.read_table("moved_names.txt"))))
def test_a_public_name_that_left_the_package_names_its_place(package, old, new):
    with pytest.raises(AttributeError, match=f"it is now {new}, which is not installed; it is in the repository$"):
        getattr(import_module(package), old)
    parent, _, name = new.rpartition(".")
    assert hasattr(import_module(parent), name) or find_spec(new)
