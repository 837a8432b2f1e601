"""Today's sins: what is new is refused, and so is what has gone and is still listed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import yaml

from tools.house import inner, prose, rules, vocabulary, words
from tools.house.imports import File, circles, graph, read

ROOT = Path(__file__).parents[2]
LISTS = Path(__file__).with_name("ratchet.yaml")
HEAD = """\
# Today's sins, by rule: written by `python -m tools.house --tighten`, which only ever takes away.
# A line is added by hand, with the reason in the commit. Limits and aims are numbers of lines.
"""
SLACK = 500  # lines that a limit may lie above the count

Sins = dict[str, int]


@dataclass(frozen=True)
class Count:
    """The sins of each rule, with how many there are of each; how many lines there are; and the circles of files."""

    sins: dict[str, Sins]
    lines: dict[str, int]
    circles: list[list[str]]


@cache
def source() -> dict[str, File]:
    """The files of holdfast."""
    return read(ROOT / "src" / "holdfast", "holdfast")


@cache
def counted() -> Count:
    """What there is in this checkout."""
    files, papers = source(), read(ROOT / "papers", "papers")
    sins = {
        "imports in circles": rules.in_circles(files) | rules.in_circles(papers),
        "shadowed names": rules.shadowed(files),
        "positional arguments": rules.positional(files),
        "long files": rules.long_files(files),
        "full folders": rules.full_folders(files),
        "inner names": inner.inner_names(ROOT, files),
        "foreign prose": prose.find_excesses(prose.read_pages(ROOT)),
        "retired words": words.count(words.texts(ROOT, files)),
        "bare function names": vocabulary.find_bare_functions(files),
        "repeated classes": vocabulary.find_repeated_classes(files),
        "one-word constants": vocabulary.find_short_constants(files),
        "unpacked constants": vocabulary.find_unpacked_constants(files),
        "vague docstrings": vocabulary.find_vague_docstrings(files),
    }
    lines = {
        "src": sum(file.lines for file in files.values()),
        "cli": sum(file.lines for name, file in files.items() if name.startswith("holdfast.interface.cli")),
    }
    return Count(sins, lines, circles(graph(files)) + circles(graph(papers)))


@dataclass(frozen=True)
class Lists:
    """What is in ``ratchet.yaml``: the sins, the most lines there may be today, and how many there are to be in 1.0."""

    sins: dict[str, Sins]
    limits: dict[str, int]
    aims: dict[str, int]

    @classmethod
    def load(cls, path: Path = LISTS) -> Lists:
        """Read the file; a sin without a number is there once."""
        data = yaml.safe_load(path.read_text(encoding="utf-8"))
        limits, aims = data.pop("limits"), data.pop("aims")
        sins = {rule: dict.fromkeys(each, 1) if isinstance(each, list) else dict(each) for rule, each in data.items()}
        return cls(sins, limits, aims)

    def save(self, path: Path = LISTS) -> None:
        """Write the file."""
        short = {rule: sins if set(sins.values()) - {1} else list(sins) for rule, sins in self.sins.items()}
        text = yaml.safe_dump({"limits": self.limits, "aims": self.aims, **short}, sort_keys=False, width=200)
        path.write_text(HEAD + text, encoding="utf-8")

    def tightened(self, count: Count) -> Lists:
        """The lists without what has gone."""
        sins = {}
        for rule, old in self.sins.items():
            found = count.sins[rule]
            sins[rule] = {name: min(number, found[name]) for name, number in old.items() if name in found}
        limits = {name: min(limit, -(-count.lines[name] // SLACK) * SLACK) for name, limit in self.limits.items()}
        return Lists(sins, limits, self.aims)

    def broken(self, count: Count) -> list[str]:
        """One line for each thing that is not as the lists say."""
        said = [f"{rule}: {line}" for rule, sins in count.sins.items() for line in differences(sins, self.sins[rule])]
        for name, number in count.lines.items():
            limit = self.limits[name]
            if number > limit:
                said.append(f"lines of {name}: {number}, at most {limit}")
            elif number < limit - SLACK:
                said.append(f"lines of {name}: {number}, and the limit is still {limit}")
        return said


def differences(found: Mapping[str, int], allowed: Mapping[str, int]) -> list[str]:
    """One line for each sin that there is more or less of than the list says."""
    said = []
    for name in sorted({*found, *allowed}):
        there, before = found.get(name, 0), allowed.get(name, 0)
        if there > before:
            said.append(f"new: {name}" + (f", {there} instead of {before}" if before else ""))
        elif there < before:
            said.append(f"gone, but still listed: {name}" + (f", {there} instead of {before}" if there else ""))
    return said
