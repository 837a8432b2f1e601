"""Draw the wings of holdfast, with their packages and the imports between wings, as a Mermaid diagram for CONTRIBUTING."""

from __future__ import annotations

import tomllib
from pathlib import Path

from tools.house.imports import File, graph, read

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "CONTRIBUTING.md"
MARKS = "<!-- packages: written by python -m tools.house --picture -->", "<!-- end of packages -->"


def arrows(imports: dict[str, set[str]], layers: list[str]) -> set[tuple[str, str]]:
    """Which layer imports which below it, without those that other arrows imply."""
    order = {name: k for k, name in enumerate(layers)}
    pairs = {(a.split(".")[1], b.split(".")[1]) for a in imports for b in imports[a] if "." in a and "." in b}
    down = {(a, b) for a, b in pairs if a in order and b in order and order[a] < order[b]}
    reached: dict[str, set[str]] = {}
    kept = set()
    for a in reversed(layers):
        reached[a] = set()
        for b in layers:  # the highest first: what it reaches needs no arrow of its own
            if (a, b) in down and b not in reached[a]:
                kept.add((a, b))
                reached[a] |= {b} | reached[b]
    return kept


def picture(files: dict[str, File] | None = None) -> str:
    """Return the diagram as Markdown, from the files of holdfast."""
    source = ROOT / "src" / "holdfast"
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"]["contracts"]
    wings = [name for name in next(c["layers"] for c in contracts if c["id"] == "wings") if (source / name).is_dir()]
    lines = []
    for wing in wings:
        packages = sorted(file.parent.name for file in (source / wing).glob("*/__init__.py"))
        lines += [f"  subgraph {wing}", *(f"    {wing}_{package}[{package}]" for package in packages), "  end"]
    pairs = arrows(graph(files or read(source, "holdfast")), wings)
    lines += [f"  {a} --> {b}" for a, b in sorted(pairs, key=lambda pair: (wings.index(pair[0]), wings.index(pair[1])))]
    return "\n".join(["```mermaid", "graph TD", *lines, "```"])


def put(page: str, diagram: str) -> str:
    """A page with the diagram between its marks."""
    before, rest = page.split(MARKS[0])
    return f"{before}{MARKS[0]}\n{diagram}\n{MARKS[1]}{rest.split(MARKS[1])[1]}"


def write() -> None:
    """Put the diagram into CONTRIBUTING."""
    PAGE.write_text(put(PAGE.read_text(encoding="utf-8"), picture()), encoding="utf-8")
