"""Every part of the paper, and RESULTS.md."""

from __future__ import annotations

from pathlib import Path

from papers.goel2005 import reachability, rest_points, statements, three_links, two_links, workspaces
from papers.part import write

HERE = Path(__file__).parent
PARTS = (two_links, three_links, reachability, rest_points, statements, workspaces)


def main() -> None:
    """Make everything and write RESULTS.md."""
    (HERE / "figures").mkdir(exist_ok=True)
    parts = [part.result(HERE / "figures") for part in PARTS]
    write(HERE, "Goel, Maciejewski, Balakrishnan 2005: the paper's statements and ours", parts)


if __name__ == "__main__":
    main()
