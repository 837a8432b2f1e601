"""Run every workload, each in its own process, and write RESULTS.md beside this file."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import harness

HERE = Path(__file__).parent
WORKLOADS = ("w1_index", "w2_gradient", "w3_inverse", "w4_optimise", "spectral", "start_up", "memory")

INTRODUCTION = """# Results

Written by `run_all.py`; `README.md` says what is measured. Ratios are the numbers to compare between machines: each is
the median over rounds in which holdfast and the peer ran one after the other.
"""


def main() -> None:
    arguments = sys.argv[1:]
    parts = [INTRODUCTION, f"{harness.environment()}.\n"]
    if arguments:
        parts.append(f"Options: `{' '.join(arguments)}`.\n")
    for workload in WORKLOADS:
        command = [sys.executable, str(HERE / f"{workload}.py"), *arguments]
        result = subprocess.run(command, stdout=subprocess.PIPE, text=True)
        parts.append(result.stdout.strip() if result.returncode == 0 else f"### {workload}\n\nfailed, see the messages above")
        parts.append("")
    (HERE / "RESULTS.md").write_text("\n".join(parts))
    print("\n".join(parts))


if __name__ == "__main__":
    main()
