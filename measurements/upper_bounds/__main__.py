"""Every table of the page on ceilings: ``python -m measurements.upper_bounds`` (half an hour on a busy core, resumed if
stopped).
"""

from __future__ import annotations

import argparse
from math import comb
from pathlib import Path
from time import monotonic, process_time

import numpy as np

import holdfast as hf
from measurements.upper_bounds import again, designs, equal_levers, singular_values
from measurements.upper_bounds.minor_programmes import bounds_by_arrangement
from measurements.upper_bounds.proofs import certificates_of, replay

HERE = Path(__file__).parent
SEEDS = (1, 2)
ZERO, NAMED = 1e-7, 3  # below it is rounding of roots
BUSY = "Two shared cores, busy with eight others on 2026-11-25: seconds are wall time."
MARKET = [  # arm, task, joints that lock at once, what the specification found
    ("panda", "pose", 1, 0.3135),
    ("xarm7", "pose", 1, 0.3189),
    ("ur5-rail", "pose", 1, 0.3765),
    ("iiwa14", "pose", 1, 0.0),
    ("pa10-7dof", "pose", 1, 0.0),
    ("pa10-9dof", "pose", 1, 0.5396),
    ("pa10-9dof", "pose", 2, 0.1717),
    ("pa10-9dof", "pose", 3, 0.0),
    ("panda", "position", 1, 0.6929),
    ("panda", "position", 2, 0.3528),
    ("panda", "position", 3, 0.0),
    ("iiwa14", "position", 2, 0.1736),
    ("ur5", "position", 1, 0.6292),
    ("ur5", "position", 2, 0.0),
    ("planar-3r", "planar", 1, 0.57735),
]


def arrangements() -> list[str]:
    """Theorem R4: what the certificates of all classes prove."""
    lines = [
        "| joints, redundancy 3 | classes | proven in ball arithmetic | best null space | seconds |",
        "|---|---|---|---|---|",
    ]
    for n in (6, 7, 8, 9):
        start = monotonic()
        found = bounds_by_arrangement(n, enough=0.0465 if n == 9 else 0.0)
        best = hf.index_bounds.upper_bound(n=n, m=n - 3, k=3).best_known
        lines.append(f"| {n} | {len(found):,} | {max(found):.13f} | {best:.13f} | {monotonic() - start:.0f} |")
    return lines


def pairs() -> list[str]:
    """Theorem R3: what each certificate proves, replayed in integers."""
    lines = ["| joints | rows | proven | before: mean of all pairs | best null space | seconds |", "|---|---|---|---|---|---|"]
    for c in hf.index_bounds.bound_table().ceilings:
        if c.bound_by == "R3":
            start = monotonic()
            for certificate in certificates_of(c.n, c.m, c.k):
                replay(certificate)
            mean = np.sqrt(comb(c.n - c.m, 2) / comb(c.n, 2))
            lines.append(f"| {c.n} | {c.m} | {c.bound:.6f} | {mean:.6f} | {c.best_known:.6f} | {monotonic() - start:.0f} |")
    return lines


def ceilings() -> list[str]:
    """Bound and best null space of every stored size."""
    lines = [
        "| joints | rows | lock | bound | by | best known | in roots | bound above it |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for c in hf.index_bounds.bound_table().ceilings:
        best = "attained" if c.is_attained else f"{c.best_known:.7f}"
        gap = "0" if c.is_attained else f"{100 * (c.gap or 0):.1f} %"
        lines.append(f"| {c.n} | {c.m} | {c.k} | {c.bound:.7f} | {c.bound_by} | {best} | {c.closed_form} | {gap} |")
    return lines


def market() -> list[str]:
    """The best configuration found of arms that are sold, within their limits: lower bounds, the better of two seeds."""
    lines = [
        "| arm | task | lock | best found | specification | of the best known | of the bound | processor, s: first, again |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for name, task, k, said in MARKET:
        index = hf.indices.relative_manipulability(hf.arms.load(name), task, k)
        found, seconds = [], []
        for seed in SEEDS:
            start = process_time()
            found.append(float(hf.optimise(index.arm, None, index, seed=seed).value))
            seconds.append(f"{process_time() - start:.1f}")
        best = max(found)
        fraction = f"0: {fatal(index)}" if best < ZERO else f"{best / float(index.best_known or 1):.3f}"
        took = f"{best / float(index.bound or 1):.3f} | {', '.join(seconds)}"
        lines.append(f"| {name} | {task} | {k} | {best:.5f} | {said:.4f} | {fraction} | {took} |")
    return lines


def fatal(index: hf.indices.Index) -> str:
    """The sets of joints whose locks end the task in every sample: by structure, as far as samples tell."""
    rng = np.random.default_rng(0)
    values = index.by_joint(rng.uniform(-np.pi, np.pi, (2000, index.arm.n)))
    names = [name for name, worst in zip(index.failure_names, values.max(axis=0), strict=True) if worst < ZERO]
    return ", ".join(names[:NAMED]) + (f" and {len(names) - NAMED} more" if len(names) > NAMED else "")


def main() -> None:
    """All of it; a table that is there already is not made again."""
    parser = argparse.ArgumentParser(prog="python -m measurements.upper_bounds", description=__doc__)
    parser.add_argument("--parts", type=Path, default=Path("ceilings-parts"), help="folder of the tables that are made")
    parts = parser.parse_args().parts
    parts.mkdir(parents=True, exist_ok=True)
    lines = [
        "# Ceilings",
        "",
        "Written by `python -m measurements.upper_bounds`. Measured here; proofs are in `docs/theory/upper-bounds-proofs.md`.",
        "",
        BUSY,
        "",
    ]
    for title, table in (
        ("Certificates of theorem R4", arrangements),
        ("Certificates of theorem R3", pairs),
        ("Ceilings", ceilings),
        ("Ceilings of the least singular value", singular_values.table),
        ("Seven joints with equal levers", equal_levers.table),
        ("Designs by what has no slope", designs.table),
        ("Found again", lambda: again.table(parts / "again.jsonl")),
        ("Arms that are sold", market),
    ):
        part = parts / f"{title.lower().replace(' ', '-')}.md"
        if not part.exists():
            part.write_text("\n".join(table()) + "\n", encoding="utf-8")
        lines += [f"## {title}", "", part.read_text(encoding="utf-8")]
        print("\n".join(lines[-3:]), flush=True)
    (HERE / "RESULTS.md").write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main()
