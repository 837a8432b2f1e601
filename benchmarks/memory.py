"""A hundred million configurations assessed but not stored: memory must not grow with their number."""

from __future__ import annotations

import argparse
import json
import resource
import subprocess
import sys

import harness

COUNTS = (1_000_000, 10_000_000, 100_000_000)


def child(poses: int) -> None:
    """In a process of its own, since the peak of a process never falls; prints one JSON object."""
    import holdfast as hf
    from holdfast import arms, indices

    arm = arms.load("pa10-9dof")
    index = indices.relative_manipulability(arm)
    index(arm.lower)  # compiled before the clock starts
    before = peak()
    took = harness.seconds(
        lambda: hf.assess(arm, hf.Region.joints(arm.lower, arm.upper), index, poses=poses, seed=1, keep=False)
    )
    print(json.dumps({"seconds": took, "before": before, "after": peak()}))


def peak() -> float:
    """Peak resident memory of this process, MiB."""
    size = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return size / (2**20 if sys.platform == "darwin" else 2**10)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--child", type=int, help=argparse.SUPPRESS)
    parser.add_argument("--quick", action="store_true", help="ten and twenty thousand only: does it run")
    parser.add_argument("--rounds", type=int, help="ignored: one run each")
    chosen = parser.parse_args()
    if chosen.child is not None:
        child(chosen.child)
        return
    lines = []
    for poses in (10_000, 20_000) if chosen.quick else COUNTS:
        harness.progress(f"memory: {poses:,}")
        result = subprocess.run([sys.executable, __file__, "--child", str(poses)], capture_output=True, text=True)
        if result.returncode:
            reason = (result.stderr.strip().splitlines() or ["no message"])[-1]
            lines.append([f"{poses:,}", "-", "-", "-", "-", f"failed: {reason[:100]}"])
            continue
        r = json.loads(result.stdout.splitlines()[-1])
        rate = harness.number(poses / r["seconds"] / 1e6)
        lines.append([f"{poses:,}", f"{r['seconds']:.2f}", rate, f"{r['before']:.0f}", f"{r['after']:.0f}", ""])
    head = ["configurations", "s", "M/s", "peak before, MiB", "peak after, MiB", "note"]
    print(harness.table("Assessed, not stored: `hf.assess(..., keep=False)`", head, lines))


if __name__ == "__main__":
    main()
