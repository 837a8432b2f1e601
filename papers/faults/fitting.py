"""Compare weak joints under bounds of many robots with bounds whose masses are fitted to the robot itself."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np

import holdfast as hf
from papers.faults.records import KINDS, LENGTH
from papers.faults.store import COULOMB, VISCOUS, Store, of

SEEDS, DRAWS = 150_000, 17
HEALTHY_SEEDS = 160_000
HEALTHY_S = 10.0  # s, of the healthy record to which masses and friction are fitted
NAMES = {"many": "of many robots", "fitted": "fitted to the robot"}


def judged(arm: hf.Arm, bounds: hf.diagnosis.Bounds, numbers: range) -> list[dict[str, Any]]:
    """Return the answers about weak joints of some robots, with both kinds of bounds."""
    faults = hf.faults.Faults([KINDS["weak"]], seed=DRAWS)
    events = [faults.draw(arm, episode=k) for k in numbers]
    robots = [SEEDS + k for k in numbers]
    healthy = hf.diagnosis.rehearse_many(arm, HEALTHY_S, seeds=[HEALTHY_SEEDS + k for k in numbers], bodies=robots)
    logs = hf.diagnosis.rehearse_many(arm, LENGTH, seeds=robots, bodies=robots, faults=events)
    friction = {"coulomb": np.full(arm.n, COULOMB), "viscous": np.full(arm.n, VISCOUS)}
    found = []
    for (event,), log, record in zip(events, logs, healthy, strict=True):
        fitted = hf.diagnosis.calibrate(arm, [record], **friction, fit=True)
        entry: dict[str, Any] = {"joint": arm.joint_index(event.joint) + 1}
        for name, chosen in (("many", bounds), ("fitted", fitted)):
            verdict = hf.diagnosis.diagnose(arm, log, chosen).verdict
            early = bool(verdict.alarm and verdict.time < event.onset)
            answer: dict[str, Any] = {"early": early, "right": verdict.joint == event.joint and not early, "kind": verdict.kind}
            if answer["right"] and np.isfinite(verdict.loss):
                answer["error"] = abs(verdict.loss - (1 - float(event.parameters["gain"])))
                answer["uncertainty"] = verdict.uncertainty
            entry[name] = answer
        found.append(entry)
    return found


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
    found = store.some(f"fitted {robots}", count, partial(judged, store.arm, bounds))
    lines = [
        "## Masses fitted to each robot",
        "",
        f"Weak joints of {count} other robots, judged with the bounds above and with bounds whose masses and friction "
        f"`calibrate --fit` found in {HEALTHY_S:g} s of healthy motion of the same robot. An alarm before the fault is counted "
        "as too early.",
        "",
        "| bounds | joint right | too early | loss stated | error, median / 90 % / largest | truth within the uncertainty |",
        "|---|---|---|---|---|---|",
    ]
    both = [one for one in found if all("error" in one[name] for name in NAMES)]
    weak = [one for one in found if one["fitted"]["kind"] == "weak"]
    for name, title in NAMES.items():
        lines.append(row(title, [one[name] for one in found]))
    for name, title in NAMES.items():
        lines.append(row(f"{title}, where both state a loss", [one[name] for one in both]))
    lines.append(row("fitted, called weak", [one["fitted"] for one in weak]))
    return [*lines, ""]
