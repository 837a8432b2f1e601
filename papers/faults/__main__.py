"""The tables of sections 4, 6 and 9 of the specification, at sizes that one chooses, and RESULTS.md."""

from __future__ import annotations

import argparse
from datetime import datetime
from importlib.metadata import version
from pathlib import Path

import holdfast as hf
from papers.faults import blind, healthy, probes, pushes, records
from papers.faults.store import CALIBRATED, Store

HERE = Path(__file__).parent


def section(store: Store, chosen: argparse.Namespace) -> list[str]:
    """What is measured on one arm."""
    arm, bounds = store.arm, store.bounds(chosen.robots)
    return [
        f"## Faults in records, {arm.title}",
        "",
        f"Bounds: the largest residuals of {chosen.robots} other robots, {CALIBRATED:g} s each, times {bounds.factor:g}.",
        "",
        *records.table(store, bounds, chosen.robots, chosen.count),
        *pushes.table(store, bounds, chosen.robots, chosen.pushes),
        f"## False alarms, {arm.title}",
        "",
        *healthy.sentences(store, bounds, chosen.robots, plants=chosen.plants, hours=chosen.hours),
        "",
    ]


def main() -> None:
    """Make the tables and write RESULTS.md; what a run before has found is taken from the store."""
    parser = argparse.ArgumentParser(prog="python -m papers.faults", description=__doc__)
    parser.add_argument("--robots", type=int, default=20, help="robots that bounds are calibrated on")
    parser.add_argument("--plants", type=int, default=20, help="other robots that are watched in healthy motion")
    parser.add_argument("--hours", type=float, default=0.1, help="of healthy motion that is watched")
    parser.add_argument("--count", type=int, default=20, help="faults of each kind")
    parser.add_argument("--pushes", type=int, default=21, help="pushes, the links in turn")
    parser.add_argument("--blind", type=int, default=4, help="files of logs for the command line")
    parser.add_argument("--probes", type=int, default=5, help="configurations of self-motions")
    parser.add_argument("--arms", default=["panda", "iiwa14"], nargs="+")
    parser.add_argument("--store", type=Path, help="folder of what was found: resumed, and added to")
    chosen = parser.parse_args()
    stores = [Store(chosen.store, hf.arms.load(name)) for name in chosen.arms]
    made = ", ".join(f"{name} {version(name)}" for name in ("holdfast", "numpy", "mujoco"))
    options = " ".join(f"--{name} {getattr(chosen, name):g}" for name in ("robots", "plants", "hours", "count", "pushes"))
    lines = [
        "# Faults in simulated records",
        "",
        f"Written by `python -m papers.faults {options} --blind {chosen.blind} --probes {chosen.probes} --arms "
        f"{' '.join(chosen.arms)}` on {datetime.now():%Y-%m-%d}; {made}. Everything is **simulated**.",
        "",
        "Each record is of a robot of its own, whose masses and friction are up to 20 % off the model; joints swing to and fro "
        f"at 0.25 to 0.5 rad/s, {records.LENGTH:g} s, 1000 samples a second, the tool's pose at 100 Hz (0.5 mm, 1 mrad). In "
        f"brackets: exact 95 % intervals (Clopper and Pearson). Seeds: calibration from 0, faults {records.DRAWS} (draws) and "
        f"from {records.SEEDS} (robots), pushes from {pushes.SEEDS}, healthy motion from {healthy.SEEDS}.",
        "",
    ]
    for store in stores:
        lines += section(store, chosen)
    lines += [
        "Beside the specification (its own spike, point-to-point motion under a control law): a lock 25 / 69 ms and 1.1 / 2.1 "
        "mm, free-swinging 46 / 88 ms. A joint that is not asked to move, or carries next to nothing, is not found. "
        "Sluggish: weak or more friction; where gravity is small nothing tells them apart.",
        "",
    ]
    lines += blind.table(stores[0], chosen.blind)
    lines += probes.table(stores[0], chosen.probes)
    (HERE / "RESULTS.md").write_text("\n".join(lines), encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
