"""Presentation of the same run in MuJoCo and in the kinematic simulation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from holdfast.control.physics.run import PhysicalRun
from holdfast.control.simulation.errors import error_history, error_kinds
from holdfast.core.formatting import capitalise_first, format_number, format_percent
from holdfast.interface import report
from holdfast.interface.presentation.collision.contacts import list_contacts, tabulate_contacts
from holdfast.interface.presentation.physics.execution import SERVO_QUANTITIES
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Notice, Presentation, TableSpec
from holdfast.interface.presentation.simulation import runs as simulation
from holdfast.interface.presentation.simulation.errors import format_errors
from holdfast.model.collision.contacts import Contact


def to_dict(run: PhysicalRun) -> dict[str, Any]:
    """Return the kinematic run, and under "physics" the differences."""
    names = run.law.arm.joint_names
    physics = {
        **{name: getattr(run, name) for name in ("outcome", "reason", "agrees")},
        "time_s": float(run.time[-1]),
        "error": float(run.error[-1]),
        "x_final": run.x[-1].tolist(),
        "q_final": dict(zip(names, run.q[-1].tolist(), strict=True)),
        "path_distance_m": run.path_distance,
        "terminal_distance_m": run.terminal_distance,
        "terminal_turn_rad": run.terminal_turn,
        **{name: dict(zip(names, getattr(run, name), strict=True)) for name in SERVO_QUANTITIES},
        "control_rate_hz": run.servos.rate,
    } | ({} if run.contacts is None else {"contacts": list_contacts(run.contacts)})
    return run.kinematic.to_dict() | {"physics": physics}


def present(run: PhysicalRun) -> Presentation:
    """Present the kinematic run, and its differences from the run in MuJoCo."""
    kinematic = simulation.present(run.kinematic)
    lines = [f"In MuJoCo, with {run.servos.describe()}: {run.ending}; in the kinematic simulation: {run.kinematic.outcome}."]
    contact_sentence = "The arm touches nothing" if not run.contacts else run.contacts[0].sentence()
    contact_sentence = f"{capitalise_first(contact_sentence)} (with masses and servos)."
    notices = [Notice(contact_sentence)] if run.contacts else []
    saturation = zip(run.law.arm.joint_names, run.saturated_fraction, strict=True)
    saturated_text = ", ".join(f"{name} {format_percent(fraction)}" for name, fraction in saturation if fraction > 0)
    if saturated_text:
        notices.append(Notice(f"Motors are at their torque limit for a part of the time: {saturated_text}."))
    columns = ["", "kinematic", "in MuJoCo"]
    caption = (
        "Thick lines: kinematic simulation. Thin lines: with masses and joint servos. Right: tracking error of the joints."
    )
    return replace(
        kinematic,
        lines=[*kinematic.lines, *lines, *([contact_sentence] if run.contacts == () else [])],
        notices=[*kinematic.notices, *notices],
        facts=[
            *kinematic.facts,
            Fact("largest distance between the tool paths, kinematic and in MuJoCo", 1000 * run.path_distance, "mm", digits=3),
            Fact("distance between the tools at the end", 1000 * run.terminal_distance, "mm", digits=3),
            *([] if saturated_text else [Fact("motors at their torque limit", "none")]),
        ],
        tables=[
            *kinematic.list_tables(),
            TableSpec("Comparison with the simulation with masses and servos", columns, _compare_endings(run)),
            *([replace(tabulate_contacts(run.contacts), title="Contacts in MuJoCo")] if run.contacts else []),
        ],
        figures={
            "physics": FigureSpec(partial(_draw_figure, run), "Comparison with the simulation with masses and servos", caption),
            **kinematic.figures,
        },
    )


def _compare_endings(run: PhysicalRun) -> list[tuple[str, str, str]]:
    """Return the outcome, the last error, the time, and the first contact, kinematic and in MuJoCo."""
    law, end, (position, angle) = run.law, error_history(run.kinematic).end, run.errors_apart
    rows = [
        ("outcome", str(run.kinematic.outcome), run.ending),
        (
            "error at the end",
            format_errors(law, end.position, end.angle),
            format_errors(law, float(position[-1]), float(angle[-1])),
        ),
        ("simulated time, s", format_number(float(run.kinematic.time), 4), format_number(run.time[-1], 4)),
    ]
    if run.contacts is not None:
        rows.append(("first contact", _format_first_contact(run.kinematic.contacts), _format_first_contact(run.contacts)))
    return rows


def _format_first_contact(contacts: Sequence[Contact] | None) -> str:
    return f"{contacts[0].link} & {contacts[0].object}, {format_number(contacts[0].time, 4)} s" if contacts else "none"


def _draw_figure(run: PhysicalRun) -> report.Figure:
    """Draw both tool paths in the two world axes of largest extent, and errors and tracking errors over time."""
    kinematic_path, arm, kinds = run.kinematic_path, run.law.arm, error_kinds(run.law)
    first_axis, second_axis = chosen = sorted(np.argsort(np.ptp(np.vstack([run.x, kinematic_path.x]), axis=0))[-2:])
    servo_errors = np.where(run.is_locked, 0.0, np.abs(run.q - run.reference)).max(axis=1)
    panels = [
        report.motions.TimePanel(
            run.time,
            kind.factor * errors,
            f"{kind.text}, {kind.unit}",
            "Error",
            compared=(kinematic_path.time, kind.factor * getattr(kinematic_path, kind.name)),
        )
        for kind in kinds
        for errors in (run.errors_apart[kind.name == "angle_error"],)
    ]
    servo_unit = "m or rad" if arm.prismatic.any() else "rad"
    panels.append(
        report.motions.TimePanel(
            run.time,
            np.maximum(servo_errors, 1e-9),
            f"largest servo error of a healthy joint, {servo_unit}",
            "Servos",
            log_scale=True,
        )
    )
    with report.styled_figure((1.6 if len(kinds) > 1 else 1.25) * report.WIDTH_IN, 4.1) as figure:
        path_axes, *panel_axes = figure.subplots(1, 1 + len(panels))
        for path, color, width, label in (
            (kinematic_path.x, report.SKY, 4.5, "kinematic"),
            (run.x, report.BLUE, 1.4, "in MuJoCo"),
        ):
            path_axes.plot(*path[:, chosen].T, color=color, linewidth=width, label=label)
        path_axes.plot(*run.x[0, chosen], "o", color=report.INK, markersize=4, label="start")
        path_axes.plot(
            *kinematic_path.x[-1, chosen], "s", color=report.ORANGE, markersize=7, fillstyle="none", label="kinematic end"
        )
        path_axes.set(
            xlabel=f"{'xyz'[first_axis]} of the tool, m",
            ylabel=f"{'xyz'[second_axis]} of the tool, m",
            title="Path of the end effector",
        )
        path_axes.set_aspect("equal", adjustable="datalim")
        for axes, panel in zip(panel_axes, panels, strict=True):
            report.motions.draw_panel(axes, panel, "time, s")
        locked = [name for name, instant in zip(arm.joint_names, run.kinematic.lock_time, strict=True) if np.isfinite(instant)]
        caption = (
            f"{arm.name}, {run.law.name}, locked: {', '.join(locked) or 'none'}; one run. "
            f"Kinematic: {run.kinematic.outcome}; in MuJoCo, {run.servos.describe()}: {run.ending}"
        )
        report.legend_below(figure, path_axes, 4)
        figure.suptitle(report.format_label(caption, 200), fontsize=9, color=report.SOFT)
    return figure
