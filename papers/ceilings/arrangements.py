"""The certificates of theorem R4, replayed in ball arithmetic: ``python -m papers.ceilings.arrangements 9`` (minutes)."""

from __future__ import annotations

import sys
from time import monotonic

import holdfast as hf


def main(n: int) -> None:
    """Each class of n lines: what its certificate proves, and which class is the best."""
    start = monotonic()
    found = sorted(hf.ceilings.bounds_by_arrangement(n), reverse=True)
    best = hf.ceilings.look_up(n=n, m=n - 3, k=3).best_known
    print(f"{n} lines, {len(found)} classes, {monotonic() - start:.0f} s")
    print(f"largest bounds {', '.join(f'{x:.14f}' for x in found[:3])}; the best null space has {best:.14f}")


if __name__ == "__main__":
    main(int(sys.argv[1]))
