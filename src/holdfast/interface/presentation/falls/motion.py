"""Sentences and films of falls, in the batch engine and in MuJoCo."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.control.falls.physical import PhysicalFall
from holdfast.core.formatting import format_number
from holdfast.core.typing import FloatArray

if TYPE_CHECKING:
    from holdfast.control.falls.fall import PowerLoss
    from holdfast.interface.report.page import Section

FILM_FRAMES = 161
TIME_LABEL = "time since the power loss, s"
_LARGEST_MM = 0.1  # m: longer distances are printed in cm


def format_distance(distance: float) -> str:
    """Format a distance in m as mm or cm."""
    factor, unit = (1000, "mm") if abs(distance) < _LARGEST_MM else (100, "cm")
    return f"{format_number(factor * distance, 3)} {unit}"


def describe_drop(drop: float) -> str:
    """Describe the largest drop of the tool."""
    return f"The tool falls {format_distance(drop)}" if drop >= 5e-5 else "The tool does not fall"


def describe_free_joints(fall: PowerLoss | PhysicalFall) -> str:
    """Describe the joints without torque, and the brakes."""
    is_whole = len(fall.free) == fall.arm.n
    names = "all joints" if is_whole else ", ".join(fall.arm.joint_names[joint] for joint in fall.free)
    brakes = "" if fall.brakes is None else f"; brakes act after {1000 * fall.brakes.after:g} ms"
    return f"Without torque: {names}{'' if is_whole else '; all others are held'}{brakes}"


def list_friction(fall: PowerLoss | PhysicalFall) -> list[tuple[str, Any]]:
    """List the friction and the brakes as entries of a method."""
    brakes, friction = fall.brakes, fall.friction
    entries = [
        ("Dry friction, moving", friction.coulomb),
        ("Dry friction, at rest", friction.stiction),
        ("Viscous friction", friction.viscous),
        ("Friction per gravity torque", friction.load),
        *([] if brakes is None else [("Brake torque", np.broadcast_to(brakes.torque, (fall.arm.n,)))]),
    ]
    units = {False: ("N m", "N m", "N m s/rad", "", "N m"), True: ("N", "N", "N s/m", "", "N")}
    texts = []
    for index, (label, values) in enumerate(entries):
        numbers = [
            f"{format_number(value, 3)} {units[joint.prismatic][index]}".strip()
            for value, joint in zip(values, fall.arm.joints, strict=True)
        ]
        texts.append((label, numbers[0] if len(set(numbers)) == 1 else ", ".join(numbers)))
    return [entry for entry in texts if entry[0] != "Friction per gravity torque" or friction.load.any()]


def build_film(fall: PowerLoss | PhysicalFall, motions: Mapping[str, FloatArray], time: FloatArray, caption: str) -> Section:
    """Build the view of motions (F, n) over times (F,), the first opaque, next to a ghost at the power loss."""
    from holdfast.interface.presentation.arm.view import build_view_section

    start = np.tile(np.atleast_2d(fall.q)[0], (len(time), 1))
    shown = {**motions, "at the power loss": start}
    return build_view_section(
        "The fall",
        fall.arm,
        np.array(list(shown.values())),
        caption,
        labels=list(shown),
        free=list(fall.free),
        time=time,
        readings=[f"{instant:.2f} s" for instant in time],
        cell=getattr(fall, "cell", None),
    )
