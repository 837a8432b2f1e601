"""The errors of the end effector in millimetres and degrees."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.control.law import Law
from holdfast.simulation.errors import ErrorAt, ErrorHistory, least_errors
from holdfast.simulation.runs import Runs
from holdfast.words import number


def error_text(law: Law, position: float, angle: float) -> str:
    """Return a position error, m, and an angle error, rad, in words, as far as the task prescribes them."""
    parts = [f"{number(1000 * position)} mm"] if law.task.rows[:, :3].any() else []
    parts += [f"{number(np.rad2deg(angle))}°"] if law.task.angular else []
    return " and ".join(parts)


def error_rows(runs: Runs, history: ErrorHistory, k: int = 0) -> list[tuple[str, str]]:
    """Return the errors of one run as rows of a table."""
    law, unit = runs.law, runs.unit

    def format_error_at(error: ErrorAt) -> str:
        return error_text(law, error.position, error.angle)

    since = "after the lock" if np.isfinite(np.atleast_2d(runs.lock_time)[k]).any() else "after the start"
    rows = [("error at the end", format_error_at(history.end))]
    if law.task.rows[:, :3].any():
        largest = history.largest_position
        rows.append(
            (
                f"largest distance from the target {since}",
                f"{number(1000 * largest.position)} mm, at {number(largest.time)} {unit}",
            )
        )
    if law.task.angular:
        largest = history.largest_angle
        rows.append(
            (
                f"largest angle from the target {since}",
                f"{number(np.rad2deg(largest.angle))}°, at {number(largest.time)} {unit}",
            )
        )
    rows += [(f"error {delay_of(e, history)} {unit} {since}", format_error_at(e)) for e in history.later]
    rows.append(("least error that the failed arm can have", f"{error_text(law, *least_errors(runs, k))}, as far as was found"))
    closest = error_text(law, history.least_position.position, history.least_angle.angle)
    rows.append(("least error on the way" + ", each for itself" * (" and " in closest), closest))
    return rows


def delay_of(error: ErrorAt, history: ErrorHistory) -> str:
    """Return the time since the lock, in words."""
    return f"{error.time - history.lock_time:.6g}"


def error_entries(runs: Runs, history: ErrorHistory) -> dict[str, Any]:
    """Return the errors of one run by name, m and rad, as far as the task prescribes them."""
    unit, law = runs.unit, runs.law
    entries: dict[str, Any] = {}
    for kind, name, prescribed in (
        ("position", "position_error_m", law.task.rows[:, :3].any()),
        ("angle", "angle_error_rad", law.task.angular),
    ):
        if prescribed:
            largest = history.largest_position if kind == "position" else history.largest_angle
            entries[name] = {
                "end": getattr(history.end, kind),
                "largest_after_lock": getattr(largest, kind),
                f"largest_at_{unit}": largest.time,
                f"after_lock_{unit}": {delay_of(e, history): getattr(e, kind) for e in history.later},
            }
    return entries
