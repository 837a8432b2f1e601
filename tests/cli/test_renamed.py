"""Renamed commands, options, and public names produce one sentence with the new name."""

from __future__ import annotations

from importlib import import_module

import pytest

from holdfast import renamed


@pytest.mark.parametrize("old", sorted(renamed.COMMANDS))
def test_a_renamed_command_names_its_successor(cli, old):
    code, out, error = cli(old)
    assert (code, out) == (2, "")
    assert error == f"holdfast: No such command '{old}'; it is now '{renamed.COMMANDS[old]}'\n"
    assert cli(renamed.COMMANDS[old], "--help")[0] == 0


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
    assert error.endswith(f"; it is now '{renamed.OPTIONS[old]}'\n")
    assert len(error.splitlines()) == 1
    assert renamed.OPTIONS[old] in cli(command, "--help")[1]


@pytest.mark.parametrize("old", sorted(renamed.PUBLIC_NAMES))
def test_a_renamed_public_name_names_its_successor(old):
    package, _, name = old.rpartition(".")
    with pytest.raises(AttributeError, match=f"it is now {renamed.PUBLIC_NAMES[old]}$"):
        getattr(import_module(package), name)
    package, _, name = renamed.PUBLIC_NAMES[old].rpartition(".")
    assert getattr(import_module(package), name).__name__ == name
