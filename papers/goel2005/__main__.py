"""Every part of the paper, and RESULTS.md."""

from __future__ import annotations

from pathlib import Path

from papers.claims import table
from papers.goel2005 import statements, three_links, two_links

HERE = Path(__file__).parent
PARTS = (two_links, three_links, statements)


def main() -> None:
    """Make everything and write RESULTS.md."""
    folder = HERE / "figures"
    folder.mkdir(exist_ok=True)
    parts = [part.result(folder) for part in PARTS]
    lines = [
        "# Goel, Maciejewski, Balakrishnan 2005: the paper's statements and ours",
        "",
        "Written by `python -m papers.goel2005`. Ours are measured, the paper's are cited. The specification is our own, worked out "
        "by other routes before holdfast was written; its numbers stand in for those that the paper shows in figures only.",
        "",
        *table([claim for part in parts for claim in part.claims]),
        "",
        *[line for part in parts for line in [*part.sections, ""]],
        *[f"![{title}](figures/{name}.png)" for part in parts for name, title in part.figures.items()],
        "",
    ]
    (HERE / "RESULTS.md").write_text("\n".join(lines), encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
