"""Figure of a run in MuJoCo."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from holdfast.core.formatting import capitalise_first
from holdfast.interface.presentation.physics.console import key_table
from holdfast.interface.presentation.results import build_table_block
from holdfast.interface.presentation.simulation import run as simulation
from holdfast.interface.report import figures as style
from holdfast.interface.report.figures import save_png, svg
from holdfast.interface.report.page import Picture, Section, Text

if TYPE_CHECKING:
    from holdfast.control.physics.run import PhysicalRun


def write(run: PhysicalRun, path: Path, command: str = "") -> Path:
    """Write the page of the kinematic run, with the differences in MuJoCo."""
    return simulation.write(run.kinematic, path, command=command, more=[_build_physics_section(run, figures(run)["physics"])])


def save(run: PhysicalRun, folder: Path, command: str = "") -> list[Path]:
    """Write the files of the kinematic run, and physics.png."""
    figure = figures(run)["physics"]
    files = simulation.save(run.kinematic, folder, command=command, more=[_build_physics_section(run, figure)])
    return [*files, save_png(figure, folder / "physics.png")]


def _build_physics_section(run: PhysicalRun, figure: Figure) -> Section:
    caption = "Thick: kinematic; thin: with masses and joint servos. Right: how far the joints lag behind."
    paragraphs = [Text(f"{capitalise_first(sentence)}.") for sentence in run.describe()]
    picture = Picture(svg(figure, "physics", "The same run in MuJoCo"), caption)
    return Section("The same with masses and servos", [*paragraphs, picture, build_table_block(key_table(run))])


def figures(run: PhysicalRun) -> dict[str, Figure]:
    """Draw both tool paths in the two world axes of largest extent, and errors and tracking errors over time."""
    kinematic_path, arm = run.kinematic_path, run.law.arm
    extent = np.ptp(np.vstack([run.x, kinematic_path.x]), axis=0)
    first_axis, second_axis = sorted(np.argsort(extent)[-2:])
    with style.style():
        figure = Figure(figsize=((1.6 if run.law.task.angular else 1.25) * style.WIDTH_IN, 4.1))
        angular = run.law.task.angular
        path_axes, error_axes, *angle_axes, servo_axes = figure.subplots(1, 4 if angular else 3)
        path_axes.plot(
            kinematic_path.x[:, first_axis], kinematic_path.x[:, second_axis], color=style.SKY, linewidth=4.5, label="kinematic"
        )
        path_axes.plot(run.x[:, first_axis], run.x[:, second_axis], color=style.BLUE, linewidth=1.4, label="in MuJoCo")
        path_axes.plot(*run.x[0, [first_axis, second_axis]], "o", color=style.INK, markersize=4, label="start")
        path_axes.plot(
            *kinematic_path.x[-1, [first_axis, second_axis]],
            "s",
            color=style.ORANGE,
            markersize=7,
            markerfacecolor="none",
            label="kinematic end",
        )
        path_axes.set(
            xlabel=f"{'xyz'[first_axis]} of the tool, m",
            ylabel=f"{'xyz'[second_axis]} of the tool, m",
            title="Path of the end effector",
        )
        path_axes.set_aspect("equal", adjustable="datalim")
        position_errors, angle_errors = run.errors_apart
        for axes in (error_axes, *angle_axes):
            factor, unit = (1000.0, "distance from the target, mm") if axes is error_axes else (180 / np.pi, "angle, degrees")
            kinematic, physical = (
                (kinematic_path.position_error, position_errors)
                if axes is error_axes
                else (kinematic_path.angle_error, angle_errors)
            )
            axes.plot(kinematic_path.time, factor * kinematic, color=style.SKY, linewidth=4.5)
            axes.plot(run.time, factor * physical, color=style.BLUE, linewidth=1.4)
            axes.set(xlabel="time, s", ylabel=unit, title="Error", ylim=(0, None))
        servo_errors = np.where(run.is_locked, 0.0, np.abs(run.q - run.reference)).max(axis=1)
        unit = "m or rad" if arm.prismatic.any() else "rad"
        servo_axes.plot(run.time, np.maximum(servo_errors, 1e-9), color=style.BLUE, linewidth=1.2)
        servo_axes.set(xlabel="time, s", ylabel=f"largest servo error of a healthy joint, {unit}", title="Servos", yscale="log")
        for axes in (error_axes, *angle_axes, servo_axes):
            axes.set_xlim(0, max(float(run.time[-1]), 1e-3))
        locked = [
            name
            for name, lock_instant in zip(arm.joint_names, run.kinematic.lock_time, strict=True)
            if np.isfinite(lock_instant)
        ]
        caption = (
            f"{arm.name}, {run.law.name}, locked: {', '.join(locked) or 'none'}; one run. "
            f"Kinematic: {run.kinematic.outcome}; in MuJoCo, {run.servos.describe()}: {run.ending}"
        )
        style.legend_below(figure, path_axes, 4)
        figure.suptitle(style.format_label(caption, 200), fontsize=9, color=style.SOFT)
        return {"physics": style.settle_layout(figure)}
