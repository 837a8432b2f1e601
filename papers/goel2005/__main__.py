"""Every part of the paper, and RESULTS.md."""

from __future__ import annotations

import argparse
from pathlib import Path

from papers.goel2005 import reachability, rest_points, statements, three_links, two_links, workspaces
from papers.part import write

HERE = Path(__file__).parent
PARTS = (two_links, three_links, reachability, rest_points, statements, workspaces)


def main() -> None:
    """Make everything and write RESULTS.md."""
    parser = argparse.ArgumentParser(prog="python -m papers.goel2005", description=__doc__)
    parser.add_argument("--brute", action="store_true", help="only simulate every failure of Fig. 10 and compare: two minutes")
    if parser.parse_args().brute:
        workspaces.brute()
        return
    (HERE / "figures").mkdir(exist_ok=True)
    parts = [part.result(HERE / "figures") for part in PARTS]
    write(HERE, "Goel, Maciejewski, Balakrishnan 2005: the paper's statements and ours", parts)


if __name__ == "__main__":
    main()
