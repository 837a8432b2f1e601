"""``python -m papers.design [FOLDER]``: tables and figure; FOLDER remembers the searches."""

from __future__ import annotations

import sys
from pathlib import Path

from papers.design import attachment, known

HERE = Path(__file__).parent


def main() -> None:
    """Make everything and write RESULTS.md."""
    store = sys.argv[1] if len(sys.argv) > 1 else None
    searches = known.rows(store)
    found = attachment.searched(0.95, store)
    built = found.space.arm_of(attachment.rounded(found), "as built")
    runs = {
        "paper": attachment.assessed(found.space.arm, store),
        "better tool, rounded to 5 mm and 5 deg": attachment.assessed(built, store),
    }
    attachment.figure(runs, HERE / "attachment.png")
    given, best = found.checked.given, found.checked.best
    lines = [
        "# Design: known optima, and a better tool for the PA10",
        "",
        "Written by `python -m papers.design`.",
        "",
        "## Known optima",
        "",
        "With n joints and a task of m rows no configuration has more worst-case relative manipulability than "
        "sqrt((n - m) / n).",
        "",
        *searches,
        "",
        "## The tool of Abdi et al. 2012",
        "",
        f"Rows 7 to 9 of the 9-joint PA10, limits as they are; {attachment.POSES} poses of the paper's region, "
        f"{attachment.DESIGNS} designs, {found.climbs} climbs, seed {attachment.SEED}. Guaranteed for 95 % of the poses, on "
        f"{attachment.FRESH:,} fresh poses: {given.guaranteed} before, {best.guaranteed} after; on the poses of the search the "
        f"best design looked better by {found.checked.optimism:+.4f}. Reach {found.start_reach:.3f} m before, "
        f"{found.reach[found.best]:.3f} m after.",
        "",
        *attachment.table(found),
        "",
        f"The arms assessed anew, {attachment.FRESH:,} random poses, best configurations, links may run through one another:",
        "",
        "| tool | poses not reached | 5 % quantile | 25 % | median | best pose (bound 0.577) | P(rho >= 0.2) |",
        "|---|---|---|---|---|---|---|",
        *[attachment.worth(name, run) for name, run in runs.items()],
        "",
        "![CDF before and after](attachment.png)",
        "",
    ]
    (HERE / "RESULTS.md").write_text("\n".join(lines))
    print("\n".join(lines))


if __name__ == "__main__":
    main()
