"""The best known null space of each size searched anew: which are found again, with which seed, and how soon."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import holdfast as hf
from holdfast.kinematics.index_bounds import UpperBound
from measurements.upper_bounds.ascent_search import search_null_space

SECONDS, SEEDS = 60.0, (101, 102, 103)  # seconds of all seeds of a size together; fresh seeds
SAME = 1e-7  # relative


def rows(stored: Path) -> Iterator[dict[str, Any]]:
    """What the search of each size found; read from the file as far as it goes, and added to it."""
    done = [json.loads(line) for line in stored.read_text().splitlines()] if stored.exists() else []
    known = {tuple(row["size"]): row for row in done}
    for c in hf.index_bounds.bound_table().ceilings:
        row = known.get((c.n, c.m, c.k)) or searched(c)
        if (c.n, c.m, c.k) not in known:
            with stored.open("a") as file:
                file.write(json.dumps(row) + "\n")
        yield row


def searched(c: UpperBound) -> dict[str, Any]:
    """Seed after seed until the best known value is found again, or the time is over."""
    assert c.best_known is not None
    best, took, seed = 0.0, 0.0, 0
    for seed in SEEDS:
        enough = c.best_known * (1 - SAME / 10)
        found = search_null_space(n=c.n, m=c.m, k=c.k, seed=seed, seconds=SECONDS / len(SEEDS), enough=enough)
        best, took = max(best, found.value), took + found.seconds
        if best >= enough:
            break
    return {"size": [c.n, c.m, c.k], "found": best, "known": c.best_known, "seed": seed, "seconds": round(took, 1)}


def table(stored: Path) -> list[str]:
    """The sizes, and how many were found again."""
    lines, again = [], 0
    for row in rows(stored):
        n, m, k = row["size"]
        missing = 1 - row["found"] / row["known"]
        again += missing <= SAME
        said = "found again" if missing <= SAME else f"{100 * missing:.2g} % below"
        lines.append(f"| {n}, {m}, {k} | {row['found']:.10f} | {said} | {row['seed'] - SEEDS[0] + 1} | {row['seconds']:.1f} |")
        print(lines[-1], flush=True)
    return [
        f"{again} of {len(lines)} sizes to 1e-7, with at most {len(SEEDS)} fresh seeds, {SECONDS:.0f} s of wall time in all:",
        "",
        "| joints, rows, lock | found | of the best known | seeds | seconds |",
        "|---|---|---|---|---|",
        *lines,
    ]
