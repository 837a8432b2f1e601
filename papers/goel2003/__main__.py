"""Every part of the paper, and RESULTS.md."""

from __future__ import annotations

from pathlib import Path

from papers.goel2003 import experiment, laws
from papers.part import write

HERE = Path(__file__).parent
PARTS = (laws, experiment)


def main() -> None:
    """Make everything and write RESULTS.md."""
    (HERE / "figures").mkdir(exist_ok=True)
    parts = [part.result(HERE / "figures") for part in PARTS]
    write(HERE, "Goel, Maciejewski, Balakrishnan, Proctor 2003: the paper's statements and ours", parts)


if __name__ == "__main__":
    main()
