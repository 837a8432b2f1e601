"""Errors of the end effector in millimetres and degrees."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.control.laws.law import Law
from holdfast.control.simulation.errors import ErrorAt, ErrorHistory, least_errors
from holdfast.control.simulation.runs import Runs
from holdfast.core.formatting import format_number


def format_errors(law: Law, position: float, angle: float) -> str:
    """Return a position error, m, and an angle error, rad, in words, as far as the task prescribes them."""
    parts = [f"{format_number(1000 * position)} mm"] if law.task.rows[:, :3].any() else []
    parts += [f"{format_number(np.rad2deg(angle))}°"] if law.task.angular else []
    return " and ".join(parts)


def tabulate_errors(runs: Runs, history: ErrorHistory, run_index: int = 0) -> list[tuple[str, str]]:
    """Return the errors of one run as rows of a table."""
    law, unit = runs.law, runs.unit

    def format_error_at(error: ErrorAt) -> str:
        return format_errors(law, error.position, error.angle)

    reference_event = "after the lock" if np.isfinite(np.atleast_2d(runs.lock_time)[run_index]).any() else "after the start"
    rows = [("error at the end", format_error_at(history.end))]
    if law.task.rows[:, :3].any():
        largest = history.largest_position
        rows.append(
            (
                f"largest distance from the target {reference_event}",
                f"{format_number(1000 * largest.position)} mm, at {format_number(largest.time)} {unit}",
            )
        )
    if law.task.angular:
        largest = history.largest_angle
        rows.append(
            (
                f"largest angle from the target {reference_event}",
                f"{format_number(np.rad2deg(largest.angle))}°, at {format_number(largest.time)} {unit}",
            )
        )
    rows += [
        (f"error {format_delay(later_error, history)} {unit} {reference_event}", format_error_at(later_error))
        for later_error in history.later
    ]
    rows.append(
        (
            "least error that the failed arm can have",
            f"{format_errors(law, *least_errors(runs, run_index))}, as far as was found",
        )
    )
    closest = format_errors(law, history.least_position.position, history.least_angle.angle)
    rows.append(("least error on the way" + ", each for itself" * (" and " in closest), closest))
    return rows


def format_delay(error: ErrorAt, history: ErrorHistory) -> str:
    """Return the time since the lock, in words."""
    return f"{error.time - history.lock_time:.6g}"


def list_errors(runs: Runs, history: ErrorHistory) -> dict[str, Any]:
    """Return the errors of one run by name, m and rad, as far as the task prescribes them."""
    unit, law = runs.unit, runs.law
    entries: dict[str, Any] = {}
    for component, name, prescribed in (
        ("position", "position_error_m", law.task.rows[:, :3].any()),
        ("angle", "angle_error_rad", law.task.angular),
    ):
        if prescribed:
            largest = history.largest_position if component == "position" else history.largest_angle
            entries[name] = {
                "end": getattr(history.end, component),
                "largest_after_lock": getattr(largest, component),
                f"largest_at_{unit}": largest.time,
                f"after_lock_{unit}": {
                    format_delay(later_error, history): getattr(later_error, component) for later_error in history.later
                },
            }
    return entries
