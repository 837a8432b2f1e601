"""False alarms over many hours and many robots, none of which the bounds were calibrated on."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from scipy.stats import chi2

import holdfast as hf
from measurements.faults.store import Store

RECORD = 60.0  # s, of one motion
SEEDS = 1_000_000  # begin here; those of one robot follow each other


def watched(arm: hf.Arm, bounds: hf.diagnosis.Bounds, robot: int, records: int) -> dict[str, Any]:
    """One robot in several motions: how many of its records alarm, and its largest residuals in units of their bounds."""
    alarms, largest = [], np.zeros(3)
    seeds = range(SEEDS + 10_000 * robot, SEEDS + 10_000 * robot + records)
    logs = hf.diagnosis.simulate_logs(arm, RECORD, seeds=seeds, robots=[SEEDS + robot] * records)
    for seed, log in zip(seeds, logs, strict=True):
        told = hf.diagnosis.diagnose(arm, log, bounds)
        scaled = told.scaled
        largest = np.maximum(largest, [scaled.torque.max(), scaled.tracking.max(), np.nanmax(scaled.tool)])
        if told.verdict.alarm:
            alarms.append([seed, told.verdict.time, told.verdict.joint, told.verdict.kind])
    return {"alarms": alarms, "largest": [round(float(x), 3) for x in largest]}


def section(store: Store, bounds: hf.diagnosis.Bounds, robots: int, *, plants: int, hours: float) -> list[str]:
    """What came of it: the first alarm of each motion is counted."""
    records = max(1, round(3600 * hours / plants / RECORD))
    found = [
        store.get(f"healthy {robots} {records} {k}", partial(watched, store.arm, bounds, k, records)) for k in range(plants)
    ]
    false, hours = sum(len(one["alarms"]) for one in found), plants * records * RECORD / 3600
    some = sum(bool(one["alarms"]) for one in found)
    most = np.max([one["largest"] for one in found], axis=0)
    return [
        "## False alarms",
        "",
        f"There were {false} false alarms in {hours:.4g} h of healthy motion, on {some} of {plants} robots that were not used "
        f"for the calibration, with {records} motions of {RECORD:g} s each. With 95 % confidence there are fewer than "
        f"{chi2.ppf(0.95, 2 * false + 2) / (2 * hours):.3g} per hour for this motion. The largest residuals were {most[0]:.2f} "
        f"(torques), {most[1]:.2f} (tracking) and {most[2]:.2f} (tool) of their thresholds.",
        "",
    ]
