"""The figure of a run in MuJoCo."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from holdfast.present.physics.console import key_table
from holdfast.present.results import as_table
from holdfast.present.simulation import run as simulation
from holdfast.report import figures as style
from holdfast.report.figures import save_png, svg
from holdfast.report.page import Picture, Section, Text
from holdfast.words import capitalised

if TYPE_CHECKING:
    from holdfast.physics.run import PhysicalRun


def write(run: PhysicalRun, path: Path, command: str = "") -> Path:
    """The page of the kinematic run, with what differs in MuJoCo."""
    return simulation.write(run.kinematic, path, command=command, more=[_section(run, figures(run)["physics"])])


def save(run: PhysicalRun, folder: Path, command: str = "") -> list[Path]:
    """What is saved of the kinematic run, and physics.png."""
    drawn = figures(run)["physics"]
    files = simulation.save(run.kinematic, folder, command=command, more=[_section(run, drawn)])
    return [*files, save_png(drawn, folder / "physics.png")]


def _section(run: PhysicalRun, drawn: Figure) -> Section:
    about = "Thick: kinematic; thin: with masses and joint servos. Right: how far the joints lag behind."
    said = [Text(f"{capitalised(line)}.") for line in run.describe()]
    picture = Picture(svg(drawn, "physics", "The same run in MuJoCo"), about)
    return Section("The same with masses and servos", [*said, picture, as_table(key_table(run))])


def figures(run: PhysicalRun) -> dict[str, Figure]:
    """Both tool paths in the two world axes along which they are longest, errors and tracking errors over time."""
    told, arm = run.kinematic_path, run.law.arm
    spread = np.ptp(np.vstack([run.x, told.x]), axis=0)
    a, b = sorted(np.argsort(spread)[-2:])
    with style.style():
        drawn = Figure(figsize=((1.6 if run.law.task.angular else 1.25) * style.WIDTH, 4.1))
        angular = run.law.task.angular
        path, error, *turn, lag = drawn.subplots(1, 4 if angular else 3)
        path.plot(told.x[:, a], told.x[:, b], color=style.SKY, linewidth=4.5, label="kinematic")
        path.plot(run.x[:, a], run.x[:, b], color=style.BLUE, linewidth=1.4, label="in MuJoCo")
        path.plot(*run.x[0, [a, b]], "o", color=style.INK, markersize=4, label="start")
        path.plot(*told.x[-1, [a, b]], "s", color=style.ORANGE, markersize=7, markerfacecolor="none", label="kinematic end")
        path.set(xlabel=f"{'xyz'[a]} of the tool, m", ylabel=f"{'xyz'[b]} of the tool, m", title="Path of the end effector")
        path.set_aspect("equal", adjustable="datalim")
        position, angle = run.errors_apart
        for axes in (error, *turn):
            factor, unit = (1000.0, "distance from the target, mm") if axes is error else (180 / np.pi, "angle, degrees")
            kinematic, physical = (told.position_error, position) if axes is error else (told.angle_error, angle)
            axes.plot(told.time, factor * kinematic, color=style.SKY, linewidth=4.5)
            axes.plot(run.time, factor * physical, color=style.BLUE, linewidth=1.4)
            axes.set(xlabel="time, s", ylabel=unit, title="Error", ylim=(0, None))
        healthy = np.where(run.locked, 0.0, np.abs(run.q - run.reference)).max(axis=1)
        unit = "m or rad" if arm.prismatic.any() else "rad"
        lag.plot(run.time, np.maximum(healthy, 1e-9), color=style.BLUE, linewidth=1.2)
        lag.set(xlabel="time, s", ylabel=f"largest servo error of a healthy joint, {unit}", title="Servos", yscale="log")
        for axes in (error, *turn, lag):
            axes.set_xlim(0, max(float(run.time[-1]), 1e-3))
        locked = [name for name, t in zip(arm.joint_names, run.kinematic.lock_time, strict=True) if np.isfinite(t)]
        caption = (
            f"{arm.name}, {run.law.name}, locked: {', '.join(locked) or 'none'}; one run. "
            f"Kinematic: {run.kinematic.outcome}; in MuJoCo, {run.servos.describe()}: {run.ending}"
        )
        style.legend_below(drawn, path, 4)
        drawn.suptitle(style.plain(caption, 200), fontsize=9, color=style.SOFT)
        return {"physics": style.finished(drawn)}
