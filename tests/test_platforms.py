"""The page of wheels names every package of the locks, at its version, and says what is missing where."""

from __future__ import annotations

import re

from tools import wheels

PAGE = wheels.PAGE.read_text(encoding="utf-8")


def rows(part: str) -> dict[str, list[str]]:
    """The cells of a table, by package and version."""
    lines = [line.strip("|").split("|") for line in part.splitlines() if line.startswith("|")]
    assert [cell.strip() for cell in lines[0]] == ["package", *wheels.SYSTEMS]
    return {row[0].strip(): [cell.strip() for cell in row[1:]] for row in lines[2:]}


def test_the_page_names_what_is_locked_and_every_system():
    needed, more = PAGE.split("## What every command needs")[1].split("## What the extras add")
    for part, packages in ((needed, wheels.locked("requirements.lock")), (more, wheels.extras())):
        table = rows(part)
        assert table.keys() == {f"{name} {version}" for name, version in packages.items()}
        for cells in table.values():
            assert len(cells) == len(wheels.SYSTEMS)
            for cell in cells:
                assert cell in (wheels.ALL, wheels.NONE) or set(cell.split(", ")) < set(wheels.PYTHONS)


def test_every_dependency_is_in_the_lock():
    text = (wheels.ROOT / "pyproject.toml").read_text(encoding="utf-8")
    named = re.findall(r'"([a-z0-9-]+)>=', text.split("dependencies = [")[1].split("]")[0])
    assert len(named) > 10
    assert set(named) <= wheels.locked("requirements.lock").keys()


def test_a_cell_says_yes_no_or_which_versions():
    one = {"a": "1", "b": "2", "c": "3"}
    found = {
        name: dict.fromkeys(wheels.SYSTEMS, pythons)
        for name, pythons in zip("abc", ([], ["3.11"], list(wheels.PYTHONS)), strict=True)
    }
    _, _, *lines = wheels.table(one, found)
    assert [line.split("|")[2].strip() for line in lines] == ["**no**", "3.11", "yes"]
