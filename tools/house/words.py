"""How often a retired word is still read: on the command line, in messages, in docstrings, in the documentation."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from tools.house.imports import File
from tools.house.prose import find_pages

# What to say instead is in CONTRIBUTING. A pattern leaves out what the word may still say ("by hand", "stands for").
RETIRED = {
    "hand": r"(?<!by )(?<!in )(?<!at )(?<!other )(?<!right-)(?<!left-)\bhands?\b(?!-| (over|on|in|out|back|it|them)\b)",
    "stand": r"\b(stands?|stood|standing)\b(?! (for|alone|in)\b)",
    "stuck joint": r"\b(joints?|brakes?|it|one|which) (is|are|gets?) stuck\b|\bstuck (joint|brake)s?\b",
    "let go": r"\blets? go\b(?! on\b)",
    "turning joint": r"\bturning joints?\b",
    "sliding joint": r"\bsliding joints?\b",
    "rest": r"\b(points?|places?) of rest\b|\brest (points?|curves?)\b|\bcom(e|es|ing) to rest\b",
    "way home": r"\bways? home\b",
    "to spare": r"\bto spare\b",
    "go on": r"\b(stopped|killed|interrupted|study|search|again to)\b[^.;:]{0,30}\bgo(es)? on\b|\bgo(es)? on there\b",
}
# In keys of --json, columns and stored tables, where a name is one word.
RETIRED_NAMES = {
    "share": r"(^|_)shares?(_|$)",
    "hand": r"(^|_)hand(_|$)",
    "stand": r"(^|_)stands(_|$)",
}
STUDY = r"\bstud(y|ies)\b"  # of people: an experiment
GUIDES = {"run-your-own-experiment.md", "serve-an-experiment.md", "experiment.md"}
# A pattern is tried where one of these is in the text: most texts have none.
STEMS = {
    "stand": ("stand", "stood"),
    "go on": (" go",),
    "let go": ("let",),
}


def texts(root: Path, files: dict[str, File]) -> Iterator[tuple[str, bool, str]]:
    """Everything that a user reads: where, whether it is on experiments, and the text.

    It is read in one of ``cli`` (docstrings included: they are its help), ``messages`` (of everything else, reports
    included), ``docstrings``, ``docs``, ``page`` (texts and templates), or it is one of the ``names``.
    """
    for name, file in files.items():
        cli, teleop = name.startswith("holdfast.interface.cli"), ".teleop" in name
        for text in file.docstrings:
            yield "cli" if cli else "docstrings", teleop, text
        for text in file.strings:
            place = ("cli" if cli else "messages") if re.search(r"\s", text) else "names"
            yield place, teleop, text
    pages = [
        path for path in find_pages(root) if path.name not in ("CONTRIBUTING.md", "CHANGELOG.md")
    ]  # they quote retired words
    for path in [*pages, *sorted((root / "docs" / "examples").glob("*.py"))]:
        yield "docs", path.name in GUIDES, path.read_text(encoding="utf-8")
    source = root / "src" / "holdfast"
    for path in sorted([*source.rglob("*.html"), *source.rglob("texts/*.yaml")]):
        yield "page", "teleop" in path.parts, path.read_text(encoding="utf-8")


def count(found: Iterator[tuple[str, bool, str]]) -> dict[str, int]:
    """Each retired word with where it is read, and how often."""
    counts: Counter[str] = Counter()
    for place, teleop, text in found:
        if place == "names":
            counts.update(
                f"{word}, {place}" for word, pattern in RETIRED_NAMES.items() if word[:5] in text and re.search(pattern, text)
            )
            continue
        one = " ".join(text.lower().split())
        for word, pattern in RETIRED.items():
            if teleop and word == "hand":  # of a person
                continue
            if any(stem in one for stem in STEMS.get(word, (word.split()[0],))):
                counts[f"{word}, {place}"] += sum(1 for _ in re.finditer(pattern, one))
        if teleop and "stud" in one:
            counts[f"study, {place}"] += sum(1 for _ in re.finditer(STUDY, one))
    return {name: number for name, number in sorted(counts.items()) if number}
