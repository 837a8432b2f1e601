"""Search for better null spaces, and store those that beat the stored ones.

``python -m measurements.upper_bounds.null_spaces --seconds 40 --seed 1``

Writes ``src/holdfast/kinematics/index_bounds/null_spaces.json``; a stored value is recomputed by code that shares nothing with
the search.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import numpy as np

from holdfast.kinematics.index_bounds.minors import measure_orthonormality_error, worst_relative_manipulability
from measurements.upper_bounds.ascent import best_null_space

FILE = Path(__file__).parents[2] / "src/holdfast/kinematics/index_bounds/null_spaces.json"
CASES = [(n, m, k) for m in range(2, 7) for n in range(m + 2, 11) for k in (2, 3) if k <= n - m]


def main() -> None:
    """Search each case for the given time."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=40.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--cases", nargs="*", default=[], help="such as 9,6,2; all if not given")
    asked = parser.parse_args()
    stored = json.loads(FILE.read_text(encoding="utf-8")) if FILE.exists() else {}
    for case in CASES:
        name = ",".join(map(str, case))
        if asked.cases and name not in asked.cases:
            continue
        n, m, k = case
        found, _ = best_null_space(n, n - m, k, seed=asked.seed, seconds=asked.seconds)
        null = np.linalg.qr(found)[0]
        assert measure_orthonormality_error(null) < 1e-14
        value = worst_relative_manipulability(null, k)
        before = worst_relative_manipulability(np.array(stored[name]), k) if name in stored else 0.0
        print(f"{name}: {value:.16f}, stored {before:.16f}", flush=True)
        if value > before:
            stored[name] = null.tolist()
            names = [key for key in (",".join(map(str, c)) for c in CASES) if key in stored]
            lines = [f"{json.dumps(key)}: {json.dumps(stored[key])}" for key in names]
            FILE.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
