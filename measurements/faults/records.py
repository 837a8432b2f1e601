"""The table of section 4: faults of every kind in records of robots that bounds were not calibrated on."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

import holdfast as hf
from measurements.faults.store import COULOMB, Store, of

LENGTH, ONSET = 3.0, (0.8, 1.5)  # s
SEEDS, DRAWS = 10_000, 16
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
POSED = ("sensor_bias", "sensor_drift", "sensor_freeze", "slipping_clutch")  # the tool's pose tells them
HEAD = [
    "| fault | detected | joint correct, of those | alarm too early | delay, ms, median / 90 % | tool off its reference, mm "
    "| classified as |",
    "|---|---|---|---|---|---|---|",
]


def judged(arm: hf.Arm, bounds: hf.diagnosis.Bounds, kind: str, numbers: range) -> list[dict[str, Any]]:
    """What is said of some faults of a kind."""
    faults = hf.faults.FaultModel([KINDS[kind]], seed=DRAWS)
    events = [faults.draw(arm, episode=k) for k in numbers]
    logs = hf.diagnosis.simulate_logs(arm, LENGTH, seeds=[SEEDS + k for k in numbers], faults=events)
    found = []
    _, stiffness, damping = hf.Body().model(arm, hf.Servos(rate=bounds.rate))
    for (event,), log in zip(events, logs, strict=True):
        verdict = hf.diagnosis.diagnose(arm, log, bounds).verdict
        entry: dict[str, Any] = {"joint": arm.joint_index(event.joint) + 1, "noticed": bool(verdict.alarm)}
        if verdict.alarm:
            at = int(np.searchsorted(log.t, verdict.time))
            both = arm.forward_kinematics(np.stack([log.q_ref[at], log.q[at]]))[:, :3, 3]
            entry |= {"delay": verdict.time - event.onset, "right": verdict.joint == event.joint, "kind": verdict.kind}
            entry["distance"] = 1e3 * float(np.linalg.norm(both[0] - both[1]))
            if kind == "locked":
                gains = {"stiffness": stiffness, "damping": damping}
                expected = hf.diagnosis.expected_delays(bounds, log.q_ref, **gains, onset=event.onset)
                entry["expected"] = float(expected[entry["joint"] - 1])
            if kind == "weak" and np.isfinite(verdict.loss):
                entry |= {"off": verdict.loss - (1 - float(event.parameters["gain"])), "uncertainty": verdict.uncertainty}
        found.append(entry)
    return found


def row(kind: str, found: Sequence[Mapping[str, Any]]) -> str:
    """One line of the table."""
    seen = [one for one in found if one["noticed"] and one["delay"] >= 0]
    early = sum(one["noticed"] and one["delay"] < 0 for one in found)
    shown = ["-", "-"]
    if seen:
        columns = ([1e3 * one["delay"] for one in seen], [one["distance"] for one in seen])
        shown = [f"{np.median(x):.3g} / {np.quantile(x, 0.9):.3g}" for x in columns]
    if kind in POSED:
        shown[1] = "-"
    told = ", ".join(f"{name} {times}" for name, times in Counter(one["kind"] for one in seen).most_common())
    cells = [kind, of(len(seen), len(found)), of(sum(one["right"] for one in seen), len(seen)), str(early), *shown, told or "-"]
    return f"| {' | '.join(cells)} |"


def losses(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """How well the loss of weak joints is told, by what they are called and by joint."""
    told = [one for one in found if one.get("off") is not None and one["right"] and one["delay"] >= 0]
    groups = {"classified as weak": [one for one in told if one["kind"] == "weak"], "all": told}
    groups |= {f"joint {k}": [one for one in told if one["joint"] == k] for k in sorted({one["joint"] for one in told})}
    lines = [
        "Torque loss of weak joints, estimated after 120 ms, compared with the true loss:",
        "",
        "| joints | estimates | error, median / 90 % / largest | stated uncertainty, median / 90 % | true loss within it |",
        "|---|---|---|---|---|",
    ]
    for name, some in groups.items():
        if some:
            off, stated = (np.array([one[key] for one in some]) for key in ("off", "uncertainty"))
            error = f"{np.median(abs(off)):.3f} / {np.quantile(abs(off), 0.9):.3f} / {abs(off).max():.3f}"
            width = f"{np.median(stated):.2f} / {np.quantile(stated, 0.9):.2f}"
            covered = int((abs(off) <= stated).sum())
            lines.append(f"| {name} | {len(some)} | {error} | {width} | {of(covered, len(some))} |")
    return [*lines, ""]


def predictions(locked: Sequence[Mapping[str, Any]]) -> list[str]:
    """How well :func:`holdfast.response.diagnosis.expected_delays` predicts the delays of the locks."""
    ratios = np.array([one["delay"] / one["expected"] for one in locked if one.get("expected") and one["delay"] >= 0])
    if not ratios.size:
        return []
    near = int(((ratios >= 0.5) & (ratios <= 2)).sum())
    return [
        "`expected_delays` predicts the delays of locks from the motion and the servos. The ratio of measured to predicted "
        f"delay is {np.median(ratios):.2f} in the median and {ratios.min():.2f} to {ratios.max():.2f} in total. It is within a "
        f"factor of 2 in {of(near, ratios.size)}.",
        "",
    ]


def table(store: Store, bounds: hf.diagnosis.Bounds, robots: int, *, count: int, sensors: int) -> list[str]:
    """All kinds."""
    lines, parts = [*HEAD], dict[str, list[Any]]()
    for kind in KINDS:
        size = sensors if kind in POSED else count
        parts[kind] = store.some(f"{kind} {robots}", size, partial(judged, store.arm, bounds, kind))
        lines.append(row(kind, parts[kind]))
    return [*lines, "", *predictions(parts["locked"]), *losses(parts["weak"])]
