"""The page of wheels names every package of the locks, at its version for each system, and says what is missing where."""

from __future__ import annotations

import re

from tools import wheels

PAGE = wheels.PAGE.read_text(encoding="utf-8")


def told(part: str) -> wheels.Packages:
    """The versions that a table of the page names, by system; every cell is one that can be read."""
    head, _, *lines = [line for line in part.splitlines() if line.startswith("|")]
    assert head == wheels.HEAD
    found: wheels.Packages = {system: {} for system in wheels.SYSTEMS}
    for line in lines:
        label, *cells = [cell.strip() for cell in line.strip("|").split("|")]
        name, version = label.split()
        for system, cell in zip(wheels.SYSTEMS, cells, strict=True):
            said, other = re.fullmatch(r"(.*?)(?: \((.+)\))?", cell).groups()
            assert said in (wheels.ALL, wheels.NONE, wheels.NOT_NEEDED) or set(said.split(", ")) < set(wheels.PYTHONS)
            if said != wheels.NOT_NEEDED:
                found[system][name] = other or version
    return found


def test_the_page_names_what_is_locked_and_every_system():
    needed, more = PAGE.split("## Packages for every command and for reports")[1].split("## Packages of the extras")
    assert told(needed) == wheels.locked()
    assert told(more) == wheels.extras()


def test_every_dependency_is_locked_for_every_system():
    text = (wheels.ROOT / "pyproject.toml").read_text(encoding="utf-8")
    named = set(re.findall(r'"([a-z0-9-]+)>=', text.split("dependencies = [")[1].split("]")[0]))
    assert len(named) > 8
    assert all(named <= versions.keys() for versions in wheels.locked().values())


def test_the_summary_says_where_everything_can_be_installed():
    short = wheels.summary({"here": {"a": list(wheels.PYTHONS), "b": ["3.11"]}, "there": {"a": list(wheels.PYTHONS), "b": []}})
    assert short[2:] == ["| here | 3.11 | b |", "| there | **no** | b |"]


def test_a_cell_says_yes_no_or_which_versions():
    packages = {system: {"a": "1", "b": "2", "c": "3"} for system in wheels.SYSTEMS}
    packages["Linux x86-64"] = {"a": "1", "b": "2"}
    packages["macOS x86-64"] = {"a": "1", "b": "1.9", "c": "3"}
    made = {system: {"a": [], "b": ["3.11"], "c": list(wheels.PYTHONS)} for system in wheels.SYSTEMS}
    _, _, *lines = wheels.table(packages, made)
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    assert [row[0] for row in cells] == ["a 1", "b 2", "c 3"]
    assert [row[1] for row in cells] == ["**no**", "3.11", "not needed"]
    assert [row[3] for row in cells] == ["**no**", "3.11 (1.9)", "yes"]
