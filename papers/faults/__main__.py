"""The tables of sections 4 and 6 of the specification, at sizes that one chooses, and RESULTS.md."""

from __future__ import annotations

import argparse
from collections import Counter
from datetime import datetime
from importlib.metadata import version
from pathlib import Path

import numpy as np
from scipy.stats import chi2

import holdfast as hf
from holdfast.probability import Interval
from papers.faults import probes

HERE = Path(__file__).parent
COULOMB, VISCOUS = 0.5, 0.3  # N m, N m s/rad: what the records have, within 20 %
CALIBRATED = 30.0  # s of each robot
LENGTH, ONSET = 3.0, (0.8, 1.5)  # s
FRESH = 10_000  # seeds of what is watched begin here
KINDS = {
    "locked": hf.faults.locked(onset=ONSET),
    "limp": hf.faults.limp(onset=ONSET),
    "weak": hf.faults.weak(gain=(0.2, 0.7), onset=ONSET),
    "friction": hf.faults.friction(coulomb=(2 * COULOMB, 8 * COULOMB), onset=ONSET),
    "reduced_range": hf.faults.reduced_range(travel=(0.02, 0.3), onset=ONSET),
    "reduced_speed": hf.faults.reduced_speed(velocity=(0.2, 0.6), onset=ONSET),
    "sensor_bias": hf.faults.sensor_bias(bias=(0.005, 0.05), onset=ONSET),
    "sensor_drift": hf.faults.sensor_drift(rate=(0.01, 0.05), onset=ONSET),
    "sensor_freeze": hf.faults.sensor_freeze(onset=ONSET),
    "slipping_clutch": hf.faults.slipping_clutch(onset=ONSET),
}


def bounds_of(arm: hf.Arm, robots: int) -> hf.diagnosis.Bounds:
    """Bounds over many robots of one kind."""
    logs = [hf.diagnosis.rehearse(arm, CALIBRATED, seed=k) for k in range(robots)]
    return hf.diagnosis.calibrate(arm, logs, coulomb=np.full(arm.n, COULOMB), viscous=np.full(arm.n, VISCOUS))


def row(arm: hf.Arm, bounds: hf.diagnosis.Bounds, kind: str, count: int) -> list[str]:
    """One line of the table."""
    faults, delays, distances, named = hf.faults.Faults([KINDS[kind]], seed=16), [], [], Counter[str]()
    noticed = right = early = 0
    for k in range(count):
        (event,) = faults.draw(arm, episode=k)
        log = hf.diagnosis.rehearse(arm, LENGTH, seed=FRESH + k, faults=[event])
        verdict = hf.diagnosis.diagnose(arm, log, bounds).verdict
        early += verdict.alarm and verdict.time < event.onset
        if not verdict.alarm or verdict.time < event.onset:
            continue
        noticed, right = noticed + 1, right + (verdict.joint == event.joint)
        named[verdict.kind] += 1
        delays.append(1e3 * (verdict.time - event.onset))
        at = int(np.searchsorted(log.t, verdict.time))
        both = arm.forward_kinematics(np.stack([log.q_ref[at], log.q[at]]))[:, :3, 3]
        distances.append(1e3 * float(np.linalg.norm(both[0] - both[1])))
    found = Interval.of(noticed, count)
    shown = ["-", "-"]
    if delays:
        shown = [f"{np.median(x):.3g} / {np.quantile(x, 0.9):.3g}" for x in (delays, distances)]
    if kind.startswith("sensor") or kind == "slipping_clutch":
        shown[1] = "-"
    told = ", ".join(f"{name} {times}" for name, times in named.most_common())
    seen = f"{noticed} of {count} ({100 * found.low:.0f} to {100 * found.high:.0f} %)"
    return [kind, seen, str(right), str(early), *shown, told or "-"]


def alarms(arm: hf.Arm, bounds: hf.diagnosis.Bounds, robots: int, hours: float) -> int:
    """False ones, over robots that bounds were not calibrated on."""
    found = 0
    for k in range(robots):
        log = hf.diagnosis.rehearse(arm, 3600 * hours / robots, seed=FRESH // 2 + k)
        found += hf.diagnosis.diagnose(arm, log, bounds).verdict.alarm
    return found


def main() -> None:
    """Make the tables and write RESULTS.md."""
    parser = argparse.ArgumentParser(prog="python -m papers.faults", description=__doc__)
    parser.add_argument("--robots", type=int, default=20, help="robots that bounds are calibrated on, and as many watched")
    parser.add_argument("--count", type=int, default=20, help="faults of each kind")
    parser.add_argument("--hours", type=float, default=0.1, help="of healthy motion that is watched")
    parser.add_argument("--probes", type=int, default=5, help="configurations of self-motions")
    parser.add_argument("--arm", default="panda")
    chosen = parser.parse_args()
    arm = hf.arms.load(chosen.arm)
    bounds = bounds_of(arm, chosen.robots)
    false = alarms(arm, bounds, chosen.robots, chosen.hours)
    rows = []
    for kind in KINDS:
        rows.append(row(arm, bounds, kind, chosen.count))
        print(*rows[-1], sep=" | ", flush=True)
    made = ", ".join(f"{name} {version(name)}" for name in ("holdfast", "numpy", "mujoco"))
    lines = [
        "# Faults in simulated records",
        "",
        f"Written by `python -m papers.faults --arm {chosen.arm} --robots {chosen.robots} --count {chosen.count} --hours "
        f"{chosen.hours:g} --probes {chosen.probes}` on {datetime.now():%Y-%m-%d}; {made}. Everything is **simulated**.",
        "",
        "Each record is of a robot of its own, whose masses and friction are up to 20 % off the model; joints swing to and fro "
        f"at 0.25 to 0.5 rad/s, {LENGTH:g} s, 1000 samples a second, the tool's pose at 100 Hz (0.5 mm, 1 mrad). Bounds: "
        f"the largest residuals of {chosen.robots} other robots, {CALIBRATED:g} s each, times {bounds.factor:g}. In brackets: "
        "95 % intervals.",
        "",
        f"Healthy: {false} false alarms in {chosen.hours:.3g} h over {chosen.robots} robots that were not calibrated on; with "
        f"95 % confidence fewer than {chi2.ppf(0.95, 2 * false + 2) / (2 * chosen.hours):.3g} an hour.",
        "",
        "| fault | noticed | joint right | too early | delay, ms, median / 90 % | reference to tool, mm | named |",
        "|---|---|---|---|---|---|---|",
        *(f"| {' | '.join(cells)} |" for cells in rows),
        "",
        "Beside the specification (its own spike, point-to-point motion under a control law): a lock 25 / 69 ms and 1.1 / 2.1 "
        "mm, free-swinging 46 / 88 ms. A joint that is not asked to move, or carries next to nothing, is not found. "
        "Sluggish: weak or more friction; where gravity is small nothing tells them apart.",
        "",
    ]
    results = HERE / "RESULTS.md"
    results.write_text("\n".join(lines), encoding="utf-8")
    lines += probes.table(chosen.probes)
    results.write_text("\n".join(lines), encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
