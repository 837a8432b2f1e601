"""Presentation of a fall in MuJoCo."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from holdfast.control.falls.physical import PhysicalFall
from holdfast.core.formatting import capitalise_first, format_number
from holdfast.interface import report
from holdfast.interface.presentation.collision.contacts import list_contacts, tabulate_contacts
from holdfast.interface.presentation.falls import motion
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Notice, Presentation
from holdfast.interface.report.page import Section


def to_dict(fall: PhysicalFall) -> dict[str, Any]:
    """Return the drop, the outcome, the final configuration, and the contacts."""
    return {
        **fall.arm.entry(),
        "free": [fall.arm.joint_names[joint] for joint in fall.free],
        "outcome": fall.outcome,
        "drop_m": fall.drop,
        "simulated_s": fall.time[-1],
        "q": fall.q[0],
        "q_final": fall.q[-1],
        "contacts": None if fall.contacts is None else list_contacts(fall.contacts),
    }


def present(fall: PhysicalFall) -> Presentation:
    """Present the drop of the tool and the contacts."""
    end = "is at rest" if fall.outcome == "rest" else "still moves"
    return Presentation(
        f"Fall of {fall.arm.name} in MuJoCo",
        f"{motion.describe_drop(fall)}, and the arm {end} after {format_number(float(fall.time[-1]), 3)} s.",
        about=f"Arm {fall.arm.title}. {motion.describe_free_joints(fall)}.",
        lines=["The arm touches nothing."] if fall.contacts == () else [],
        notices=[Notice(f"{capitalise_first(fall.contacts[0].sentence())}.")] if fall.contacts else [],
        facts=[
            Fact(f"largest {motion.name_drop(fall.of)}", 1000 * fall.drop, "mm"),
            Fact("simulated time", float(fall.time[-1]), "s"),
        ],
        tables=[tabulate_contacts(fall.contacts)] if fall.contacts else [],
        figures={"fall": FigureSpec(partial(_draw_figure, fall), "Over time", "Drop over time.")},
        sections=partial(_animate_fall, fall),
        method=[("Simulation", f"MuJoCo, {len(fall.time) - 1:,} time steps"), *motion.list_friction(fall)],
        arm=fall.arm,
    )


def _animate_fall(fall: PhysicalFall) -> list[Section]:
    rows = np.linspace(0, len(fall.time) - 1, min(motion.FILM_FRAMES, len(fall.time))).astype(int)
    return [motion.build_film(fall, {"fall": fall.q[rows]}, np.linspace(0.0, float(fall.time[-1]), len(rows)))]


def _draw_figure(fall: PhysicalFall) -> report.Figure:
    drops = 1000 * fall.drops
    first_times = [contact.time for contact in fall.contacts or ()][:1]
    moments = tuple((time, float(np.interp(time, fall.time, drops)), "first contact") for time in first_times)
    panel = report.motions.TimePanel(fall.time, drops, f"{motion.name_drop(fall.of)}, mm", "Drop", moments=moments)
    return report.motions.motion_figure([panel], f"{fall.arm.name} without power, MuJoCo", motion.TIME_LABEL, panel_width=7)
