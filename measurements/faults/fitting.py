"""Compare weak joints under bounds of many robots with bounds whose masses are fitted to the robot itself."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np

import holdfast as hf
from measurements.faults.records import KINDS, LENGTH
from measurements.faults.store import COULOMB, VISCOUS, Store, of

SEEDS, DRAWS = 150_000, 17
HEALTHY_SEEDS = 160_000
HEALTHY_S = 10.0  # s, of the healthy record to which masses and friction are fitted
NAMES = {"many": "of many robots", "fitted": "fitted to the robot"}


def judged(arm: hf.Arm, bounds: hf.diagnosis.Bounds, number: int) -> dict[str, Any]:
    """Return the answers about a weak joint of one robot, with both kinds of bounds."""
    events = hf.faults.FaultModel([KINDS["weak"]], seed=DRAWS).draw(arm, episode=number)
    robot, onset = SEEDS + number, events[0].onset
    healthy = hf.diagnosis.simulate_log(arm, HEALTHY_S, seed=HEALTHY_SEEDS + number, robot=robot)
    log = hf.diagnosis.simulate_log(arm, LENGTH, seed=robot, faults=events)
    dry, wet = np.full(arm.n, COULOMB), np.full(arm.n, VISCOUS)
    fitted = hf.diagnosis.calibrate(arm, [healthy], coulomb=dry, viscous=wet, fit=True)
    answers: dict[str, Any] = {"joint": arm.joint_index(events[0].joint) + 1}
    for name, chosen in (("many", bounds), ("fitted", fitted)):
        verdict = hf.diagnosis.diagnose(arm, log, chosen).verdict
        early = bool(verdict.alarm and verdict.time < onset)
        answer: dict[str, Any] = {"early": early, "right": verdict.joint == events[0].joint and not early, "kind": verdict.kind}
        if answer["right"] and np.isfinite(verdict.loss):
            answer["error"] = abs(verdict.loss - (1 - float(events[0].parameters["gain"])))
            answer["uncertainty"] = verdict.uncertainty
        answers[name] = answer
    return answers


def row(name: str, answers: Sequence[dict[str, Any]]) -> str:
    """Return one line of the table."""
    stated = [one for one in answers if "error" in one]
    error, width = (np.array([one[key] for one in stated]) for key in ("error", "uncertainty"))
    shown = "-"
    if stated:
        shown = f"{np.median(error):.3f} / {np.quantile(error, 0.9):.3f} / {error.max():.3f}"
    right, early = (sum(one[key] for one in answers) for key in ("right", "early"))
    covered = of(int((error <= width).sum()), len(stated))
    return f"| {name} | {of(right, len(answers))} | {early} | {len(stated)} | {shown} | {covered} |"


def table(store: Store, bounds: hf.diagnosis.Bounds, robots: int, count: int) -> list[str]:
    """Return the section about weak joints with fitted masses."""
    found = [store.get(f"fitted {robots} {k}", partial(judged, store.arm, bounds, k)) for k in range(count)]
    lines = [
        "## Masses fitted to each robot",
        "",
        f"Weak joints of {count} other robots are diagnosed with the thresholds above, and with thresholds whose masses and "
        f"friction `calibrate --fit` found in {HEALTHY_S:g} s of healthy motion of the same robot. An alarm before the fault "
        "counts as too early. The simulated robots differ from the model only in friction and in one factor on the mass of "
        "each link. The fit changes exactly these, so a fit to a real robot explains less.",
        "",
        "| thresholds | joint correct | alarm too early | loss stated | error, median / 90 % / largest | true loss within it |",
        "|---|---|---|---|---|---|",
    ]
    both = [one for one in found if all("error" in one[name] for name in NAMES)]
    weak = [one for one in found if one["fitted"]["kind"] == "weak"]
    for name, title in NAMES.items():
        lines.append(row(title, [one[name] for one in found]))
    for name, title in NAMES.items():
        lines.append(row(f"{title}, where both state a loss", [one[name] for one in both]))
    lines.append(row("fitted, classified as weak", [one["fitted"] for one in weak]))
    return [*lines, ""]
