"""Errors of the end effector in millimetres and degrees."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.control.laws.law import Law
from holdfast.control.simulation.errors import ErrorAt, ErrorHistory
from holdfast.control.simulation.runs import Runs
from holdfast.core.formatting import format_number
from holdfast.interface.presentation.presentation import Fact

REACHED_ERROR = 1e-5  # smaller errors count as zero


def format_errors(law: Law, position: float, angle: float) -> str:
    """Format a position error (m) and an angle error (rad) in mm and degrees, as far as the task prescribes them."""
    parts = [f"{format_number(1000 * position)} mm"] if law.task.rows[:, :3].any() else []
    parts += [f"{format_number(np.rad2deg(angle))}°"] if law.task.angular else []
    return " and ".join(parts)


def list_error_facts(runs: Runs, history: ErrorHistory, smallest: tuple[float, float], run_index: int) -> list[Fact]:
    """Return the errors of one run; ``smallest`` are the smallest errors found for the failed arm, m and rad."""
    law, unit = runs.law, runs.unit
    event = "after the lock" if np.isfinite(np.atleast_2d(runs.lock_time)[run_index]).any() else "after the start"

    def make_fact(label: str, position: float, angle: float, phrase: str) -> Fact:
        is_error = max(position, angle) > REACHED_ERROR
        return Fact(label, format_errors(law, position, angle), phrase=phrase if is_error else "")

    facts = [make_fact("error at the end", history.end.position, history.end.angle, "off the target at the end")]
    distance, angle = history.largest_position, history.largest_angle
    time_notes = [f", at {format_number(largest.time)} {unit}" for largest in (distance, angle)]
    if law.task.rows[:, :3].any():
        text = f"{format_number(1000 * distance.position)} mm{time_notes[0]}"
        label = f"largest distance from the target {event}"
        facts.append(Fact(label, text, phrase=label if distance.position > REACHED_ERROR else ""))
    if law.task.angular:
        text = f"{format_number(np.rad2deg(angle.angle))}°{time_notes[1]}"
        label = f"largest angle from the target {event}"
        facts.append(Fact(label, text, phrase=label if angle.angle > REACHED_ERROR else ""))
    for later_error in history.later:
        label = f"error {format_delay(later_error, history)} {unit} {event}"
        facts.append(Fact(label, format_errors(law, later_error.position, later_error.angle)))
    label = "smallest error found for the failed arm"
    facts.append(make_fact(label, *smallest, label))
    closest = format_errors(law, history.least_position.position, history.least_angle.angle)
    return [*facts, Fact("smallest error on the way" + ", position and angle separately" * (" and " in closest), closest)]


def format_delay(error: ErrorAt, history: ErrorHistory) -> str:
    """Format the time since the lock."""
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
