"""Sentences and films of falls, in the batch engine and in MuJoCo."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from holdfast.control.falls.drop_points import DropOf
from holdfast.control.falls.fall import PowerLoss
from holdfast.control.falls.physical import PhysicalFall
from holdfast.core.formatting import format_number
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.view import build_view_section
from holdfast.interface.report.page import Section

FILM_FRAMES = 161
TIME_LABEL = "time since the power loss, s"
_FRICTION_LABELS = {
    "coulomb": "Dry friction while moving, N m (N)",
    "stiction": "Dry friction at rest, N m (N)",
    "viscous": "Viscous friction, N m s/rad (N s/m)",
    "load": "Friction as a fraction of the gravity torque",
}


def format_distance(distance: float) -> str:
    """Format a distance in m as mm, cm, or m."""
    factor, unit = (1000, "mm") if abs(distance) < 0.1 else (100, "cm") if abs(distance) < 1 else (1, "m")
    return f"{format_number(factor * distance, 3)} {unit}"


def name_drop(of: DropOf) -> str:
    """Name the drop of the tool, or of any point."""
    return "drop of the tool" if of == "tool" else "drop of any point"


def describe_drop(fall: PowerLoss | PhysicalFall) -> str:
    """Describe the largest drop of a single fall."""
    drop, is_tool = float(fall.drop), fall.of == "tool"
    if drop < 5e-5:
        return "The tool does not fall" if is_tool else "No point of the arm falls"
    return f"{'The tool' if is_tool else 'A point of the arm'} falls {format_distance(drop)}"


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


def build_film(
    fall: PowerLoss | PhysicalFall, motions: Mapping[str, FloatArray], time: FloatArray, swept: FloatArray | None = None
) -> Section:
    """Build the view of motions (F, n) over times (F,), the first opaque, a ghost at the power loss, and swept points."""
    shown = {**motions, "at the power loss": np.tile(np.atleast_2d(fall.q)[0], (len(time), 1))}
    return build_view_section(
        "The fall",
        fall.arm,
        np.array(list(shown.values())),
        f"The simulated fall, and the arm at the power loss.{'' if swept is None else ' Points bound the swept space.'}",
        labels=list(shown),
        free=fall.free if len(fall.free) < fall.arm.n else (),
        time=time,
        readings=[f"{instant:.2f} s" for instant in time],
        cell=fall.cell,
        points=swept,
    )
