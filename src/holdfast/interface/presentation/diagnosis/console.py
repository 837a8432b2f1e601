"""Text, tables, and JSON of residual bounds and diagnoses."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.core.formatting import capitalise_first
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable, format_significant
from holdfast.response.diagnosis.answer import Diagnosis
from holdfast.response.diagnosis.bounds import Bounds

NO_ALARM_NOTE = "A record without an alarm does not prove that nothing is wrong. This is no certified safety function."


def to_dict(result: Bounds | Diagnosis) -> dict[str, Any]:
    """Return the bounds with their rate of false alarms; or the verdict with the joints that could not be diagnosed."""
    if isinstance(result, Bounds):
        false_alarm_rate = result.false_alarms()
        return {
            **vars(result),
            "false_alarms_per_hour": false_alarm_rate and false_alarm_rate[0],
            "upper_limit_per_hour": false_alarm_rate and false_alarm_rate[1],
        }
    verdict = result.verdict
    return {
        **result.arm.entry(),
        "alarm": verdict.alarm,
        "time_s": verdict.time,
        "joint": verdict.joint,
        "suspect": verdict.suspect,
        "kind": verdict.kind if verdict.alarm else None,
        "loss": verdict.loss,
        "uncertainty": verdict.uncertainty,
        "candidates": list(verdict.candidates),
        "evidence": list(verdict.evidence),
        "not_looked_at_s": [list(interval) for interval in result.gaps],
        "did_not_move_enough": list(result.inconclusive),
        "not_watched": list(result.unmonitored),
        "faster_than_calibrated": list(result.beyond),
    }


def tables(result: Bounds | Diagnosis) -> list[TextTable]:
    """Tabulate the joints: their bounds, or the largest residuals relative to them."""
    if isinstance(result, Bounds):
        header = ["joint", "residual torque, N m (N)", "tracking, rad (m)", "fastest, rad/s (m/s)"]
        columns = (result.torque, result.tracking, result.speed)
        rows = [
            [name, *(format_significant(column[joint], 3) for column in columns)] for joint, name in enumerate(result.joints)
        ]
        return [TextTable(header, rows, "bounds")]
    scaled, has_no_torque = result.scaled, "torque" not in result.signals.levels
    rows = []
    for joint, name in enumerate(result.arm.joint_names):
        torque = "-" if has_no_torque else format_significant(np.fmax.reduce(scaled.torque[:, joint]), 3)
        motion_text = "too little to tell" if name in result.inconclusive else "yes"
        rows.append([name, torque, format_significant(np.fmax.reduce(scaled.tracking[:, joint]), 3), motion_text])
    return [TextTable(["joint", "residual torque", "tracking", "moved"], rows, "largest, in units of the bounds")]


def key_table(result: Bounds | Diagnosis) -> TextTable:
    """Return the table of the joints."""
    return tables(result)[0]


def story(result: Diagnosis) -> PageContent:
    """Compose the report of a diagnosis."""
    headline, *remarks = result.describe()
    return PageContent(
        "Diagnosis of a record",
        f"{capitalise_first(headline)}.",
        about=f"{result.arm.title}, {result.log.duration:.4g} s at {result.log.rate:.4g} samples a second",
        lines=[
            *(f"{capitalise_first(line)}." for line in remarks),
            *(f"{capitalise_first(remark)}." for remark in result.bounds.describe()),
            NO_ALARM_NOTE,
        ],
        figures={
            "residuals": (
                "Residuals and their bounds",
                "Every residual in units of its bound, one line a joint. A line above 1 for longer than the test allows is an "
                "alarm: 10 ms of torque, 20 ms of tracking, 50 ms of the tool, each at twice its bound.",
            )
        },
        arm=result.arm,
    )
