"""Every table of the page on ceilings: ``python -m papers.ceilings`` (about five minutes on one core); RESULTS.md."""

from __future__ import annotations

from pathlib import Path
from time import monotonic

import numpy as np

import holdfast as hf

HERE = Path(__file__).parent
SAMPLES, CLIMBS, SEEDS = 100_000, 300, (1, 2)
SEARCHED = 20.0  # s
AGAIN = [(9, 6, 2), (9, 6, 3), (8, 5, 3), (7, 3, 3), (10, 3, 2), (6, 2, 2)]  # sizes searched anew
MARKET = [  # arm, task, joints that lock at once, what the specification found
    ("panda", "pose", 1, 0.3135),
    ("xarm7", "pose", 1, 0.3189),
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
        found = hf.ceilings.bounds_by_arrangement(n, enough=0.0465 if n == 9 else 0.0)
        best = hf.ceilings.look_up(n=n, m=n - 3, k=3).best_known
        lines.append(f"| {n} | {len(found):,} | {max(found):.13f} | {best:.13f} | {monotonic() - start:.0f} |")
    return lines


def ceilings() -> list[str]:
    """Bound and best null space of every stored size."""
    lines = [
        "| joints | rows | lock | bound | by | best known | in roots | bound above it |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for c in hf.ceilings.table().ceilings:
        best = "attained" if c.attained else f"{c.best_known:.7f}"
        gap = "0" if c.attained else f"{100 * (c.gap or 0):.1f} %"
        lines.append(f"| {c.n} | {c.m} | {c.k} | {c.bound:.7f} | {c.bound_by} | {best} | {c.closed_form} | {gap} |")
    return lines


def searches() -> list[str]:
    """What a fresh search of one seed finds."""
    lines = [f"| joints, rows, lock | found in {SEARCHED:.0f} s, seed 7 | of the best known |", "|---|---|---|"]
    for n, m, k in AGAIN:
        found = hf.ceilings.search(n=n, m=m, k=k, seed=7, seconds=SEARCHED)
        lines.append(f"| {n}, {m}, {k} | {found.value:.10f} | {found.value / found.ceiling.best_known:.9f} |")
    return lines


def market() -> list[str]:
    """The best configuration found of arms that are sold: samples within the limits, then climbs; lower bounds."""
    lines = [
        "| arm | task | lock | best found | specification | of the best known | of the bound | seconds |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for name, task, k, said in MARKET:
        arm, start = hf.arms.load(name), monotonic()
        index = hf.indices.relative_manipulability(arm, task, k)
        best = max(best_configuration(index, seed) for seed in SEEDS)
        zero = best < 1e-9
        fraction = "zero in all samples" if zero else f"{best / index.best_known:.3f}"
        took = f"{best / index.bound:.3f} | {monotonic() - start:.1f}"
        lines.append(f"| {name} | {task} | {k} | {best:.4f} | {said:.4f} | {fraction} | {took} |")
    return lines


def best_configuration(index: hf.indices.Index, seed: int) -> float:
    """The best of many samples, then random steps that shrink where they do not help."""
    arm, rng = index.arm, np.random.default_rng(seed)
    lower, upper = np.maximum(arm.lower, -np.pi), np.minimum(arm.upper, np.pi)
    q = rng.uniform(lower, upper, (SAMPLES, arm.n))
    q = q[np.argsort(-index(q))[:CLIMBS]]
    value, size = index(q), np.full(len(q), 0.2)
    for _ in range(400):
        new = np.clip(q + size[:, None] * rng.normal(size=q.shape), lower, upper)
        tried = index(new)
        better = tried > value
        q[better], value[better] = new[better], tried[better]
        size = np.clip(np.where(better, size * 1.5, size * 0.9), 1e-6, 0.5)
    return float(value.max())


def main() -> None:
    """All of it."""
    lines = ["# Ceilings", "", "Written by `python -m papers.ceilings`. Measured here; proofs are in `docs/ceilings.md`.", ""]
    for title, table in (
        ("Certificates of theorem R4", arrangements),
        ("Ceilings", ceilings),
        ("Found again", searches),
        ("Arms that are sold", market),
    ):
        lines += [f"## {title}", "", *table(), ""]
        print("\n".join(lines[-40:]), flush=True)
    (HERE / "RESULTS.md").write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main()
