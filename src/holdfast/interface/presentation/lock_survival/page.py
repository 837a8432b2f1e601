"""Figures and page of the lock survival of a motion."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from holdfast.core.files.output import write_files
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation import results
from holdfast.interface.presentation.lock_survival.strips import StripPanel, draw_lines, draw_strips
from holdfast.interface.report.figures import save_png
from holdfast.interface.report.scenes import Scale
from holdfast.kinematics.solvers import joint_space

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.response.lock_survival.dynamic_program import SearchBounds
    from holdfast.response.lock_survival.planning import LockSurvival


_MAP_BINS = 64
_SAMPLES_PER_NODE = 8  # places in a piece between two nodes


def figures(survival: LockSurvival) -> dict[str, Figure]:
    """Draw the survival over time with that of other motions, the map of all configurations if it was computed, and velocity
    jumps.
    """
    bound_line = (
        None if survival.survival_bound is None else (100 * survival.survival_bound, "no motion survives more, in the mean")
    )
    motion_name = "most locks survived" if survival.found is not None else "this motion"
    lines = [
        (motion_name, 100 * survival.curve()),
        *((baseline.name, 100 * baseline.curve) for baseline in survival.comparisons),
    ]
    drawings = {
        "survival": draw_lines(survival.time, lines, "if a joint locks now, survived, %", level=bound_line, percents=True)
    }
    if survival.found is not None:
        drawings["map"] = _draw_survival_map(survival, survival.found)
    jumps = list(zip(survival.arm.joint_names, survival.jump.linear.T, strict=True))
    drawings["jump"] = draw_lines(survival.time, jumps, "tool velocity lost, m/s", percents=False)
    return drawings


def _draw_survival_map(survival: LockSurvival, search: SearchBounds) -> Figure:
    """Draw which locks are survivable at every node, over the joint that the self-motion moves most."""
    joint = int(search.moved.argmax())
    factor, unit = survival.arm.joints[joint].display_unit
    is_turning = joint_space.is_unlimited(survival.arm)[joint]

    def display_position(q: FloatArray) -> FloatArray:
        return np.asarray(factor * (np.arctan2(np.sin(q), np.cos(q)) if is_turning else q))

    positions = display_position(np.concatenate(search.nodes)[:, joint])
    lower, upper = positions.min(), positions.max()
    edges = np.linspace(lower, upper + 1e-9 * (upper - lower + 1), _MAP_BINS + 1)
    lock_fractions = survival.rates.each / survival.rates.total
    values = np.full((survival.arm.n + 1, len(survival.time), _MAP_BINS), np.nan)
    for pose_index in range(len(survival.time)):
        curve_values, survives = _sample_curves(search, pose_index, joint)
        bins = np.clip(np.searchsorted(edges, display_position(curve_values), side="right") - 1, 0, _MAP_BINS - 1)
        order = np.argsort(survives @ lock_fractions, kind="stable")  # what is written last stays
        values[0, pose_index, bins[order]] = 100 * (survives @ lock_fractions)[order]
        values[1:, pose_index, bins[order]] = 100.0 * survives[order].T
    path = display_position(survival.q[:, joint])
    path[1:][np.abs(np.diff(path)) > (upper - lower) / 2] = np.nan  # round by way of pi
    panels = [
        StripPanel(values[0], "all locks"),
        *(
            StripPanel(panel, f"lock of {joint_name}")
            for panel, joint_name in zip(values[1:], survival.arm.joint_names, strict=True)
        ),
    ]
    label, ylabel = "survivable, %", f"{survival.arm.joint_names[joint]}, {unit}"
    return draw_strips(survival.time, edges, panels, path, scale=Scale(0.0, 100.0), label=label, ylabel=ylabel)


def _sample_curves(search: SearchBounds, pose_index: int, joint: int) -> tuple[FloatArray, FloatArray]:
    """Return values (N,) of a joint along the curves of a pose, denser than its nodes, with the verdicts (N, n) of the nearer
    node.
    """
    values, is_connected = search.nodes[pose_index][:, joint], np.diff(search.curve[pose_index]) == 0
    first = np.flatnonzero(is_connected)
    fraction = np.linspace(0, 1, _SAMPLES_PER_NODE, endpoint=False)[:, None]
    interpolated = values[first] + fraction * (values[first + 1] - values[first])
    nearer = np.where(fraction < 0.5, first, first + 1)
    order = np.concatenate([np.arange(len(values)), nearer.ravel()])
    return np.concatenate([values, interpolated.ravel()]), search.survives[pose_index][order]


def save(survival: LockSurvival, folder: Path, command: str = "") -> list[Path]:
    """Write endurance.json, motion.csv, survival.png, jump.png, map.png if the map was computed, and report.html."""
    (file,) = write_files(folder, {"endurance.json": json.dumps(survival.to_dict(), indent=2) + "\n"})
    drawings = figures(survival)
    pictures = [save_png(figure, folder / f"{name}.png", 150) for name, figure in drawings.items()]
    return [
        file,
        survival.to_csv(folder / "motion.csv"),
        *pictures,
        results.write(survival, folder / "report.html", command, drawings),
    ]
