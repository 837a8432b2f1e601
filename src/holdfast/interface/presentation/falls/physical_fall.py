"""Presentation of a fall in MuJoCo, with sentences and films that falls of the batch engine share."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.control.falls.physical import PhysicalFall
from holdfast.core.formatting import capitalise_first, format_number
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.collision.contacts import list_contacts, tabulate_contacts
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Notice, Presentation

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.control.falls.fall import PowerLoss
    from holdfast.interface.report.page import Section


FILM_FRAMES = 161
TIME_LABEL = "time since the power loss, s"
_FRICTION_LABELS = {
    "coulomb": "Dry friction while moving, N m (N)",
    "stiction": "Dry friction at rest, N m (N)",
    "viscous": "Viscous friction, N m s/rad (N s/m)",
    "load": "Friction as a fraction of the gravity torque",
}


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
        f"{describe_drop(fall.drop)}, and the arm {end} after {format_number(float(fall.time[-1]), 3)} s.",
        about=f"Arm {fall.arm.title}. {describe_free_joints(fall)}.",
        lines=["The arm touches nothing."] if fall.contacts == () else [],
        notices=[Notice(f"{capitalise_first(fall.contacts[0].sentence())}.")] if fall.contacts else [],
        facts=[Fact("largest drop of the tool", 1000 * fall.drop, "mm"), Fact("simulated time", float(fall.time[-1]), "s")],
        tables=[tabulate_contacts(fall.contacts)] if fall.contacts else [],
        figures={"fall": FigureSpec(partial(_draw_figure, fall), "Over time", "Drop of the tool over time.")},
        sections=partial(_animate_fall, fall),
        method=[("Simulation", f"MuJoCo, {len(fall.time) - 1:,} time steps"), *list_friction(fall)],
        arm=fall.arm,
    )


def _animate_fall(fall: PhysicalFall) -> list[Section]:
    rows = np.linspace(0, len(fall.time) - 1, min(FILM_FRAMES, len(fall.time))).astype(int)
    return [build_film(fall, {"fall": fall.q[rows]}, np.linspace(0.0, float(fall.time[-1]), len(rows)))]


def _draw_figure(fall: PhysicalFall) -> Figure:
    from holdfast.interface.report.motions import TimePanel, motion_figure

    drops = 1000 * fall.drops
    first_times = [contact.time for contact in fall.contacts or ()][:1]
    moments = tuple((time, float(np.interp(time, fall.time, drops)), "first contact") for time in first_times)
    panel = TimePanel(fall.time, drops, "drop of the tool, mm", "Tool", moments=moments)
    return motion_figure([panel], f"{fall.arm.name} without power, MuJoCo", TIME_LABEL, panel_width=7)


# ---- also for falls of the batch engine ------------------------------------------------------------------------


def format_distance(distance: float) -> str:
    """Format a distance in m as mm, cm, or m."""
    factor, unit = (1000, "mm") if abs(distance) < 0.1 else (100, "cm") if abs(distance) < 1 else (1, "m")
    return f"{format_number(factor * distance, 3)} {unit}"


def describe_drop(drop: float) -> str:
    """Describe the largest drop of the tool, m."""
    return f"The tool falls {format_distance(drop)}" if drop >= 5e-5 else "The tool does not fall"


def describe_free_joints(fall: PowerLoss | PhysicalFall) -> str:
    """Describe the joints without torque, and the brakes."""
    is_whole = len(fall.free) == fall.arm.n
    names = "all joints" if is_whole else ", ".join(fall.arm.joint_names[joint] for joint in fall.free)
    brakes = "" if fall.brakes is None else f"; brakes act after {1000 * fall.brakes.after:g} ms"
    return f"Without torque: {names}{'' if is_whole else '; all others are held'}{brakes}"


def list_friction(fall: PowerLoss | PhysicalFall) -> list[tuple[str, str]]:
    """List the friction and the torque of the brakes as entries of a method."""
    values = {label: getattr(fall.friction, name) for name, label in _FRICTION_LABELS.items()}
    if fall.brakes is not None:
        values["Torque of the brakes, N m (N)"] = np.atleast_1d(fall.brakes.torque)
    texts = {label: [format_number(number, 3) for number in numbers] for label, numbers in values.items()}
    return [(label, numbers[0] if len(set(numbers)) == 1 else ", ".join(numbers)) for label, numbers in texts.items()]


def build_film(fall: PowerLoss | PhysicalFall, motions: Mapping[str, FloatArray], time: FloatArray) -> Section:
    """Build the view of motions (F, n) over times (F,), the first opaque, next to a ghost at the power loss."""
    from holdfast.interface.presentation.arm.view import build_view_section

    shown = {**motions, "at the power loss": np.tile(np.atleast_2d(fall.q)[0], (len(time), 1))}
    return build_view_section(
        "The fall",
        fall.arm,
        np.array(list(shown.values())),
        "The simulated fall, and the arm at the power loss.",
        labels=list(shown),
        free=fall.free if len(fall.free) < fall.arm.n else (),
        time=time,
        readings=[f"{instant:.2f} s" for instant in time],
        cell=fall.cell,
    )
