"""The tables of sections 4, 6 and 9 of the specification on one arm, at sizes that one chooses: RECORDS-ARM.md."""

from __future__ import annotations

import argparse
from datetime import datetime
from importlib.metadata import version
from pathlib import Path

import holdfast as hf
from measurements.faults import blind, fitting, healthy, probes, pushes, records
from measurements.faults.store import CALIBRATED, Store

HERE = Path(__file__).parent
SIZES = {  # and what they are when nothing else is asked for
    "robots": (20, "robots that bounds are calibrated on"),
    "plants": (20, "other robots that are watched in healthy motion"),
    "hours": (0.1, "of healthy motion that is watched; 0: none"),
    "count": (20, "faults of each kind of the body"),
    "sensors": (20, "of each kind of sensors, and clutches"),
    "pushes": (21, "pushes, the links in turn"),
    "blind": (4, "files of logs for the command line; 0: none"),
    "probes": (5, "configurations of self-motions; 0: none"),
    "fitted": (0, "robots whose masses are fitted; 0: none"),
}


def main() -> None:
    """Make the tables and write them; what a run before has found is taken from the store."""
    parser = argparse.ArgumentParser(prog="python -m measurements.faults", description=__doc__)
    parser.add_argument("--arm", default="panda")
    for name, (usual, what) in SIZES.items():
        parser.add_argument(f"--{name}", type=type(usual), default=usual, help=what)
    parser.add_argument("--store", type=Path, help="folder of what was found: resumed, and added to")
    chosen = parser.parse_args()
    store = Store(chosen.store, hf.arms.load(chosen.arm))
    arm, bounds = store.arm, store.bounds(chosen.robots)
    made = ", ".join(f"{name} {version(name)}" for name in ("holdfast", "numpy", "mujoco"))
    options = " ".join(f"--{name} {getattr(chosen, name):g}" for name in SIZES)
    lines = [
        f"# Faults in simulated logs, {arm.title}",
        "",
        f"Written by `python -m measurements.faults --arm {chosen.arm} {options}` on {datetime.now():%Y-%m-%d} with "
        f"{made}. Everything "
        "is **simulated**.",
        "",
        "Each log is from its own robot, whose masses and friction differ from the model by up to 20 %. The joints move to and "
        f"fro at 0.25 to 0.5 rad/s for {records.LENGTH:g} s, with 1000 samples per second and tool poses at 100 Hz (0.5 mm, "
        f"1 mrad). The thresholds are {bounds.factor:g} times the largest residuals of {chosen.robots} other robots in "
        f"{CALIBRATED:g} s each. Parentheses contain Clopper-Pearson intervals of 95 %. The faults are drawn "
        f"with seed {records.DRAWS}. Seeds of robots begin at 0 (calibration), {records.SEEDS} (faults), {pushes.SEEDS} "
        f"(pushes) and {healthy.SEEDS} (healthy motion).",
        "",
        *records.table(store, bounds, chosen.robots, count=chosen.count, sensors=chosen.sensors),
        *pushes.table(store, bounds, chosen.robots, chosen.pushes),
    ]
    if chosen.hours:
        lines += healthy.section(store, bounds, chosen.robots, plants=chosen.plants, hours=chosen.hours)
    if chosen.blind:
        lines += blind.table(store, chosen.blind)
    if chosen.probes:
        lines += probes.table(store, chosen.probes)
    if chosen.fitted:
        lines += fitting.table(store, bounds, chosen.robots, chosen.fitted)
    (HERE / f"RECORDS-{chosen.arm}.md").write_text("\n".join(lines), encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
