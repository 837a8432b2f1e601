"""Writes RESULTS.md: the bars E1 to E4 and the finding, beside the first study's numbers."""

from __future__ import annotations

import argparse
from pathlib import Path

from papers.part import Part, write

from measurements.fail_active.lines import many_lines, one_line
from measurements.fail_active.planar import guarantees, more_redundancy
from measurements.fail_active.points import point_to_point

HERE = Path(__file__).parent
TITLE = "Motions that survive a lock: the specification's bars, and a local measure beside the best motion"


def parts(quick: bool = False) -> list[Part]:
    """All of them, in order; quick: on coarser grids, fewer of each."""
    return [part(quick) for part in (one_line, many_lines, point_to_point, guarantees, more_redundancy)]


def main() -> None:
    """Compute, and write unless it is only tried."""
    parser = argparse.ArgumentParser(prog="python -m measurements.fail_active", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer and coarser, written nowhere")
    if parser.parse_args().quick:
        for part in parts(quick=True):
            print(*part.claims, *part.sections, sep="\n")
    else:
        write(HERE, TITLE, parts())


if __name__ == "__main__":
    main()
