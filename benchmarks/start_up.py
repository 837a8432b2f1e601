"""How long a person waits for the first number: a whole process, with nothing cached and with everything cached."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import harness
from harness import Spread

ANGLES = [10.0, 20, -15, 90, 5, 30, -20, 40, 0]

COMMAND = [
    *(sys.executable, "-m", "holdfast.cli", "index", "pa10-9dof", "--index", "relative-manipulability"),
    *("--q", ",".join(f"{a:g}" for a in ANGLES), "--degrees"),
]
SNIPPET = f"""
import numpy as np
from holdfast import arms, indices
print(indices.relative_manipulability(arms.load("pa10-9dof"))(np.deg2rad({ANGLES})))
"""
IMPORT = [sys.executable, "-c", "import holdfast"]
NOTHING = [sys.executable, "-c", "pass"]


def environment(folder: str) -> dict[str, str]:
    """Kernel caches of holdfast and of heyoka (which keeps its own under XDG_CACHE_HOME) inside ``folder``."""
    return {**os.environ, "HOLDFAST_CACHE": str(Path(folder) / "holdfast"), "XDG_CACHE_HOME": folder}


def run(command: Sequence[str], folder: str) -> float:
    """Seconds of the whole process."""
    return harness.seconds(lambda: subprocess.run(command, env=environment(folder), check=True, capture_output=True))


def works(command: Sequence[str]) -> bool:
    with tempfile.TemporaryDirectory() as folder:
        return subprocess.run(command, env=environment(folder), capture_output=True).returncode == 0


def main() -> None:
    chosen = harness.options(__doc__, rounds=7)
    command, label = COMMAND, "`holdfast index pa10-9dof`"
    if not works(COMMAND):
        command, label = [sys.executable, "-c", SNIPPET], "the same through Python (the command line did not run)"
    times: dict[str, list[float]] = {}
    with tempfile.TemporaryDirectory() as warm:
        run(command, warm)
        for _ in range(chosen.rounds):
            harness.progress("start-up")
            with tempfile.TemporaryDirectory() as cold:
                times.setdefault(f"{label}, empty caches", []).append(run(command, cold))
            times.setdefault(f"{label}, warm caches", []).append(run(command, warm))
            times.setdefault("`import holdfast` only", []).append(run(IMPORT, warm))
            times.setdefault("an empty Python process", []).append(run(NOTHING, warm))
    lines = [[name, str(Spread.of(values)), ""] for name, values in times.items()]
    print(harness.table(f"Start-up, median of {chosen.rounds}", ["process", "s (range)", ""], lines))


if __name__ == "__main__":
    main()
