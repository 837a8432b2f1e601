"""Bounds of residuals and diagnoses in numbers and words."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.diagnosis.answer import Diagnosis
from holdfast.diagnosis.bounds import Bounds
from holdfast.present.printing import Rows, number
from holdfast.present.story import Story
from holdfast.words import capitalised

NEVER = "A record without an alarm does not prove that nothing is wrong. This is no certified safety function."


def to_dict(found: Bounds | Diagnosis) -> dict[str, Any]:
    """The bounds with their rate of false alarms; or the verdict with what could not be told."""
    if isinstance(found, Bounds):
        told = found.false_alarms()
        return {**vars(found), "false_alarms_per_hour": told and told[0], "upper_limit_per_hour": told and told[1]}
    v = found.verdict
    return {
        **found.arm.entry(),
        "alarm": v.alarm,
        "time_s": v.time,
        "joint": v.joint,
        "suspect": v.suspect,
        "kind": v.kind if v.alarm else None,
        "loss": v.loss,
        "uncertainty": v.uncertainty,
        "candidates": list(v.candidates),
        "evidence": list(v.evidence),
        "not_looked_at_s": [list(gap) for gap in found.gaps],
        "did_not_move_enough": list(found.untold),
        "not_watched": list(found.off),
        "faster_than_calibrated": list(found.beyond),
    }


def tables(found: Bounds | Diagnosis) -> list[Rows]:
    """A row for each joint: its bounds, or how near to them it came."""
    if isinstance(found, Bounds):
        head = ["joint", "residual torque, N m (N)", "tracking, rad (m)", "fastest, rad/s (m/s)"]
        columns = (found.torque, found.tracking, found.speed)
        rows = [[name, *(number(x[k], 3) for x in columns)] for k, name in enumerate(found.joints)]
        return [Rows(head, rows, "bounds")]
    scaled, off = found.scaled, "torque" not in found.signals.levels
    rows = []
    for k, name in enumerate(found.arm.joint_names):
        torque = "-" if off else number(np.fmax.reduce(scaled.torque[:, k]), 3)
        moved = "too little to tell" if name in found.untold else "yes"
        rows.append([name, torque, number(np.fmax.reduce(scaled.tracking[:, k]), 3), moved])
    return [Rows(["joint", "residual torque", "tracking", "moved"], rows, "largest, in units of the bounds")]


def key_table(found: Bounds | Diagnosis) -> Rows:
    """The joints."""
    return tables(found)[0]


def next_steps(found: Bounds | Diagnosis, name: str) -> list[str]:
    """Watch with the bounds; look at the residuals."""
    if isinstance(found, Bounds):
        return [f"{name}.to_json('bounds.json')", f"hf.diagnosis.Monitor(arm, {name})"]
    return [f"{name}.plot()", f"{name}.signals.torque"]


def story(found: Diagnosis) -> Story:
    """What the page says."""
    first, *others = found.describe()
    return Story(
        "Diagnosis of a record",
        f"{capitalised(first)}.",
        about=f"{found.arm.title}, {found.log.duration:.4g} s at {found.log.rate:.4g} samples a second",
        lines=[*(f"{capitalised(line)}." for line in others), *(f"{capitalised(x)}." for x in found.bounds.describe()), NEVER],
        figures={
            "residuals": (
                "Residuals and their bounds",
                "Every residual in units of its bound, one line a joint. A line above 1 for longer than the test allows is an "
                "alarm: 10 ms of torque, 20 ms of tracking, 50 ms of the tool, each at twice its bound.",
            )
        },
        arm=found.arm,
    )
