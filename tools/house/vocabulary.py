"""Rules for names and docstrings: each function returns the violations of one rule with their counts."""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterator

from tools.house.imports import File

# Names that Python or click prescribe.
PRESCRIBED = {"command", "main"}
IRREGULAR_PARTICIPLES = {
    "begun",
    "bound",
    "built",
    "cut",
    "done",
    "drawn",
    "found",
    "given",
    "gone",
    "grown",
    "held",
    "kept",
    "known",
    "laid",
    "led",
    "left",
    "lost",
    "made",
    "meant",
    "met",
    "put",
    "read",
    "said",
    "seen",
    "sent",
    "set",
    "shown",
    "spent",
    "split",
    "stood",
    "taken",
    "thought",
    "told",
    "written",
}
NOUNS_IN_ED = {"bed", "feed", "need", "seed", "speed"}
PARTICLES = {
    "above",
    "across",
    "after",
    "again",
    "ahead",
    "alike",
    "alone",
    "along",
    "anew",
    "another",
    "any",
    "apart",
    "around",
    "aside",
    "at",
    "away",
    "back",
    "before",
    "behind",
    "below",
    "beside",
    "besides",
    "between",
    "both",
    "each",
    "else",
    "enough",
    "ever",
    "every",
    "far",
    "fast",
    "few",
    "first",
    "from",
    "given",
    "here",
    "how",
    "just",
    "last",
    "later",
    "least",
    "left",
    "less",
    "like",
    "likewise",
    "long",
    "lost",
    "made",
    "many",
    "most",
    "much",
    "near",
    "nearby",
    "needed",
    "none",
    "nothing",
    "now",
    "of",
    "off",
    "on",
    "once",
    "one",
    "only",
    "other",
    "others",
    "out",
    "outside",
    "over",
    "own",
    "past",
    "rest",
    "same",
    "several",
    "so",
    "some",
    "soon",
    "still",
    "such",
    "there",
    "this",
    "those",
    "through",
    "together",
    "too",
    "under",
    "unheard",
    "untold",
    "up",
    "what",
    "when",
    "where",
    "whether",
    "which",
    "who",
    "whole",
    "why",
    "within",
    "without",
}
VAGUE_OPENING = re.compile(r"(What|How|Whether|Where|Who|Of|As|With|By|So|On|That|Which|The same)\b")


def words_of(name: str) -> list[str]:
    """Split a name in snake or camel case into its words."""
    return [word for word in re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", name).split("_") if word]


def is_bare(name: str) -> bool:
    """Return whether a function's name is a single participle, particle, or pronoun."""
    words = words_of(name)
    if len(words) != 1 or name in PRESCRIBED:
        return False
    word = words[0].lower()
    participle = word in IRREGULAR_PARTICIPLES or (word.endswith("ed") and len(word) > 4 and word not in NOUNS_IN_ED)
    return participle or word in PARTICLES


def find_bare_functions(files: dict[str, File]) -> dict[str, int]:
    """Find functions and methods that are named by a participle, particle, or pronoun alone."""
    return _count(
        f"{module}.{node.name}"
        for module, tree in _trees(files)
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and is_bare(node.name)
    )


def find_repeated_classes(files: dict[str, File]) -> dict[str, int]:
    """Find class names that are defined more than once, with the number of definitions."""
    counts = Counter(node.name for _, tree in _trees(files) for node in ast.walk(tree) if isinstance(node, ast.ClassDef))
    return {name: count for name, count in sorted(counts.items()) if count > 1}


def find_short_constants(files: dict[str, File]) -> dict[str, int]:
    """Find module constants whose name is a single word, which states neither the quantity nor the unit."""
    return _count(
        f"{module}.{name}" for module, name, _ in _constants(files) if len(words_of(name)) == 1 and len(name.strip("_")) > 1
    )


def find_unpacked_constants(files: dict[str, File]) -> dict[str, int]:
    """Find module constants that are defined by unpacking a tuple."""
    return _count(f"{module}.{name}" for module, name, unpacked in _constants(files) if unpacked)


def find_vague_docstrings(files: dict[str, File]) -> dict[str, int]:
    """Count the docstrings of each module that open with a word such as *What* or *Of* in place of a noun or verb."""
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    return _count(
        module
        for module, tree in _trees(files)
        for node in ast.walk(tree)
        if isinstance(node, documented) and VAGUE_OPENING.match(ast.get_docstring(node) or "")
    )


def _trees(files: dict[str, File]) -> Iterator[tuple[str, ast.Module]]:
    for module, file in files.items():
        yield module, ast.parse(file.path.read_text(encoding="utf-8"))


def _constants(files: dict[str, File]) -> Iterator[tuple[str, str, bool]]:
    """Yield each constant as (module, name, whether a tuple was unpacked)."""
    for module, tree in _trees(files):
        for node in tree.body:
            targets = node.targets if isinstance(node, ast.Assign) else [node.target] if isinstance(node, ast.AnnAssign) else []
            for target in targets:
                unpacked = isinstance(target, ast.Tuple)
                for name in target.elts if isinstance(target, ast.Tuple) else [target]:
                    if isinstance(name, ast.Name) and name.id.isupper():
                        yield module, name.id, unpacked


def _count(names: Iterator[str]) -> dict[str, int]:
    return dict(sorted(Counter(names).items()))
