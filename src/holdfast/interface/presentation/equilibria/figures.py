"""Figures of curves of stationary points and of basins; the module imports matplotlib, so import it where a figure is drawn."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.control.equilibria.attraction import Basins
from holdfast.control.equilibria.curves import Curves, EquilibriumCurve
from holdfast.control.equilibria.points import StationaryPoints
from holdfast.control.equilibria.system import wrap_angles
from holdfast.control.simulation.errors import display_errors, error_kinds
from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.model.arm.model import Arm

# Number of cells of the locked value, and of samples per cell, that show where the target is within reach
_REACH_CELLS = 360
_SAMPLES_PER_CELL = 16
_MAX_SHOWN_JOINTS = 3


def draw_curves(curves: Curves) -> report.Figure:
    """Draw curves of stationary points over the locked value: the error, and the other joints if they are few.

    Ranges in which the target can be reached are shaded; inverse kinematics finds them in steps of 1 degree, or 1/360 of the
    range of a prismatic joint.
    """
    arm, joint, system = curves.law.arm, curves.joint, curves._system
    other_joints = [k for k in np.flatnonzero(system.healthy) if np.flatnonzero(system.healthy).size <= _MAX_SHOWN_JOINTS]
    labels = [
        *(f"{kind.text}, {kind.unit}" for kind in error_kinds(curves.law)),
        *(_axis_label(arm, index) for index in other_joints),
    ]

    def plot_rows(stationary: EquilibriumCurve | StationaryPoints, selected: slice | NDArray[np.bool_]) -> list[FloatArray]:
        errors = display_errors(curves.law, stationary.q[selected], stationary.error[selected], curves.target)
        return [*errors, *(_display_values(arm, stationary.q[selected], index) for index in other_joints)]

    lines = [
        report.curves.StationaryCurve(segment.kind.word, _display_values(arm, curve.q[span], joint), plot_rows(curve, span))
        for curve in curves.curves
        for segment in curve.segments
        for span in [slice(segment.first, segment.last + 1)]
    ]
    surface_points = curves.loose
    point_lines = [
        report.curves.StationaryCurve(
            word, _display_values(arm, surface_points.q[selected], joint), plot_rows(surface_points, selected)
        )
        for word, selected in (("degenerate", ~surface_points.attracting), ("sink", surface_points.attracting))
        if selected.any()
    ]
    values, reached = _reachable_ranges(curves)
    caption = (
        f"{arm.name}, {curves.law.name}; undetected lock of {arm.joint_names[joint]}; "
        f"{len(curves)} curves from {curves.starts} starts"
        + (f", dots: {len(surface_points)} points sampled from surfaces" if len(surface_points) else "")
    )
    return report.curves.stationary_curves_figure(
        lines, point_lines, labels, _axis_label(arm, joint), (values[0], values[-1]), reached, caption
    )


def draw_basins(basins: Basins) -> report.Figure:
    """Draw a map of the basins where the initial configurations are a grid over two joints (Fig. 8 of Goel et al. 2005), else
    bars.
    """
    points, arm = basins.points, basins.points.law.arm
    lock_text = ", ".join(
        f"{arm.joint_names[index]} locked at {value * arm.joints[index].display_unit[0]:.4g} "
        f"{arm.joints[index].display_unit[1]}"
        for index, value in zip(points.locked, points.at, strict=True)
    )
    caption = f"{arm.name}, {points.law.name}; {lock_text}; {len(basins.end)} starts"
    shares = basins.shares
    if basins.shape is None:
        caption_text = f"{caption}; lines: {100 * basins.confidence:.4g} % intervals"
        return report.curves.basin_fraction_figure(
            [outcome for outcome, _ in shares],
            [(interval.value, interval.low, interval.high) for _, interval in shares],
            caption_text,
        )
    first, second = basins.healthy
    codes, cells = np.unique(basins.end, return_inverse=True)
    names = [basins.name(int(code)) for code in codes]
    lower, upper = (extremum(basins.starts[:, [first, second]], axis=0) for extremum in (np.min, np.max))
    half_cells = (upper - lower) / (np.array(basins.shape) - 1) / 2
    lower, upper = lower - half_cells, upper + half_cells
    scale = np.array([arm.joints[first].display_unit[0], arm.joints[second].display_unit[0]])
    lower_shown, upper_shown = lower * scale, upper * scale
    isolated = np.flatnonzero(~points.continuum)
    value, y = (_display_values(arm, points.q, index).tolist() for index in (first, second))
    marks = [(points.kinds[index], value[index], y[index], f"{points.kinds[index]} {index + 1}") for index in isolated]
    lines = [(_display_values(arm, q, first), _display_values(arm, q, second)) for q in basins.boundaries]
    extent = (float(lower_shown[0]), float(upper_shown[0]), float(lower_shown[1]), float(upper_shown[1]))
    return report.curves.basin_map_figure(
        cells.reshape(basins.shape), names, extent, marks, lines, (_axis_label(arm, first), _axis_label(arm, second)), caption
    )


def _reachable_ranges(curves: Curves) -> tuple[FloatArray, list[tuple[float, float]]]:
    """Return the locked values to show, in degrees or m, and their ranges in which the target is reached."""
    arm, joint = curves.law.arm, curves.joint
    lower, upper = (arm.lower[joint], arm.upper[joint]) if arm.joints[joint].prismatic else (-np.pi, np.pi)
    lower, upper = (lower if np.isfinite(lower) else -1.0), (upper if np.isfinite(upper) else 1.0)
    edges = np.linspace(lower, upper, _REACH_CELLS + 1)
    samples = np.repeat((edges[1:] + edges[:-1]) / 2, _SAMPLES_PER_CELL)
    is_reached = (
        curves._system.can_reach(samples, np.random.default_rng(0)).reshape(_REACH_CELLS, _SAMPLES_PER_CELL).any(axis=1)
    )
    changes = np.flatnonzero(np.diff(np.r_[0, is_reached.astype(int), 0]))
    displayed_edges = edges * arm.joints[joint].display_unit[0]
    return displayed_edges, [
        (float(displayed_edges[start]), float(displayed_edges[stop]))
        for start, stop in zip(changes[::2], changes[1::2], strict=True)
    ]


def _display_values(arm: Arm, q: FloatArray, joint: int | np.intp) -> FloatArray:
    """Return the values of one joint, in degrees from -180 to 180, or m."""
    return np.asarray(wrap_angles(arm, q)[:, joint] * arm.joints[joint].display_unit[0])


def _axis_label(arm: Arm, joint: int | np.intp) -> str:
    return f"{arm.joint_names[joint]}, {arm.joints[joint].display_unit[1]}"
