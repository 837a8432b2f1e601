"""Figure of a motion along a path, and the sections of its report."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from holdfast.core.errors import ArmError
from holdfast.core.formatting import capitalise_first, format_percent
from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.arm.view import build_view_section, choose_views
from holdfast.interface.presentation.collision.shape import describe_shape
from holdfast.interface.presentation.indices.console import display_unit
from holdfast.interface.presentation.presentation import format_value
from holdfast.interface.report.page import Block, Picture, Section, Text
from holdfast.interface.report.timelines import Timeline, TimelineLine, draw_small_multiples, draw_stacked_panels
from holdfast.kinematics.path_following.trajectory import TRACKING_TOLERANCE, Trajectory, find_susceptibilities
from holdfast.model.arm.model import Arm

_MAX_VIEW_FRAMES = 201
# A relative change below _NEGLIGIBLE_CHANGE is reported as none; above _MAX_RELATIVE_CHANGE a percentage is not helpful.
_NEGLIGIBLE_CHANGE = 5e-3
_MAX_RELATIVE_CHANGE = 10.0
SPEED_FACTORS = (1.0, 0.5, 0.25)  # fractions of the duration of the motion, as in Figs. 9 to 12


def draw_figure(trajectory: Trajectory) -> report.Figure:
    """Draw the arm at start and end, the path of its tool, and the objective over time."""
    chain = trajectory.arm.frames(trajectory.q)[..., :3, 3]
    moving = report.motions.StickMotion(chain, np.r_[False, trajectory.arm.prismatic, False], trajectory.poses[:, :3, 3])
    unit = display_unit(trajectory.objective)
    panel = report.motions.TimePanel(
        trajectory.time,
        trajectory.value,
        f"{trajectory.objective.name}{unit and ', '}{unit}",
        f"{capitalise_first(trajectory.objective.better)} is better",
    )
    caption = f"{trajectory.arm.name}, {trajectory.method}, {len(trajectory.time):,} samples"
    return report.motions.stick_motion_figure(
        moving, choose_views(trajectory.arm, chain), panel, caption, "time, s", path_label="desired path"
    )


def draw_joint_positions(
    arm: Arm, time: FloatArray, q: FloatArray, titles: Sequence[str], xlabel: str = "time, s", remark: str = ""
) -> Picture:
    """Draw the position of each joint (T, n) over time (T,), and its limits where one is near; a remark ends the caption."""
    panels = []
    for joint, positions, title in zip(arm.joints, q.T, titles, strict=True):
        scale, unit = joint.display_unit
        lines = [TimelineLine(scale * positions, "position", "first")]
        reach = np.ptp(scale * positions) + (0.1 if joint.prismatic else 10.0)
        for limit in (joint.lower, joint.upper):
            # A limit far away would only flatten the curve.
            if np.isfinite(limit) and np.abs(scale * (positions - limit)).min() < reach:
                lines.append(TimelineLine(np.full(len(time), scale * limit), "limit", "compared"))
        panels.append(Timeline(lines, unit, title))
    image = draw_small_multiples(time, panels, "Joint positions over time", xlabel)
    return Picture(image, f"Joint positions. Dashed lines are joint limits, where one is near. {remark}".strip())


def build_sections(trajectory: Trajectory) -> list[Section]:
    """Build the sections of the report."""
    return [
        Section("", _compare_objective(trajectory)),
        _animate_motion(trajectory),
        Section(f"{capitalise_first(trajectory.objective.name)} along the path", _draw_objective(trajectory)),
        Section("Clearance", _draw_clearance(trajectory)),
        Section("Joint rates", _draw_rates(trajectory)),
        Section(
            "Joint positions",
            [draw_joint_positions(trajectory.arm, trajectory.time, trajectory.q, trajectory.arm.joint_names)],
        ),
        Section("Joint torques at three speeds", _draw_torques(trajectory)),
        Section("Curvature along the self-motion", _draw_curvature(trajectory)),
        Section("Error of the end effector", _draw_tool_error(trajectory)),
    ]


def _compare_objective(trajectory: Trajectory) -> list[Block]:
    """Compare the worst value with that on the same path without the objective."""
    baseline, worst = trajectory.without_objective, trajectory.worst
    if baseline is None:
        return []
    change = (worst - baseline.worst) / abs(baseline.worst) if baseline.worst else np.inf
    text = format_value(baseline.worst, unit=display_unit(trajectory.objective))
    if abs(change) < _NEGLIGIBLE_CHANGE:
        return [Text(f"On the same path without the objective, with least-norm rates, the worst value is the same ({text}).")]
    comparison = ""
    if abs(change) < _MAX_RELATIVE_CHANGE:
        comparison = f"; the objective {'reduces' if change < 0 else 'increases'} it by {format_percent(abs(change))}"
    return [Text(f"On the same path without the objective, with least-norm rates, the worst value is {text}{comparison}.")]


def _animate_motion(trajectory: Trajectory) -> Section:
    """Animate the arm, with the motion without the objective for comparison."""
    baseline = trajectory.without_objective
    samples = np.unique(np.linspace(0, len(trajectory.time) - 1, min(_MAX_VIEW_FRAMES, len(trajectory.time))).astype(int))
    readings = []
    for sample in samples:
        comparison = "" if baseline is None else f", without the objective {baseline.value[sample]:.4g}"
        readings.append(
            f"{trajectory.time[sample]:.2f} s, {trajectory.objective.name} {trajectory.value[sample]:.4g}{comparison}"
        )
    q = trajectory.q[samples] if baseline is None else np.stack([trajectory.q[samples], baseline.q[samples]])
    caption = "The arm on its path (orange)."
    if baseline is not None:
        caption += " Transparent: the same path from the same configuration without the objective, with least-norm rates."
    return build_view_section(
        "The motion",
        trajectory.arm,
        q,
        caption,
        label=f"{trajectory.arm.name} moving along its path",
        labels=() if baseline is None else (trajectory.method, "without the objective"),
        time=np.linspace(trajectory.time[0], trajectory.time[-1], len(samples)),
        path=trajectory.poses[samples, :3, 3],
        readings=readings,
        cell=None if trajectory.clear_of is None else trajectory.clear_of.cell,
    )


# ---- curves --------------------------------------------------------------------------------------------------------------


def _list_singular_times(trajectory: Trajectory) -> list[float]:
    return [event.start for event in trajectory.events if event.kind == "algorithmic singularity"]


def _stack_panels(trajectory: Trajectory, panels: list[Timeline], description: str, caption: str) -> Picture:
    return Picture(draw_stacked_panels(trajectory.time, panels, description), caption)


def _draw_objective(trajectory: Trajectory) -> list[Block]:
    """Draw the objective and, where it has them, the susceptibilities of the joints."""
    lines = [TimelineLine(trajectory.value, trajectory.method, "first")]
    if trajectory.without_objective is not None:
        lines.append(TimelineLine(trajectory.without_objective.value, "without the objective", "third"))
    caption = (
        f"{capitalise_first(trajectory.objective.name)} at {len(trajectory.time):,} samples; "
        f"{trajectory.objective.better} is better."
    )
    if trajectory.best_value is not None:
        lines.append(TimelineLine(trajectory.best_value, "best of each pose", "compared"))
        caption += (
            " Best of each pose: over the whole self-motion manifold, traced at up to 101 poses, even if no continuous "
            "motion leads there."
        )
    if trajectory.best_path is not None:
        has_motion = np.isfinite(trajectory.best_path).all(axis=1)
        if has_motion.any():
            value = np.full(len(trajectory.time), np.nan)
            value[has_motion] = trajectory.objective(trajectory.best_path[has_motion])
            lines.append(TimelineLine(value, "best continuous motion", "second"))
            caption += " Best continuous motion: dynamic programming over these manifolds, on points between 0.05 rad apart."
        if not has_motion.all():
            caption += f" No continuous motion was found for {format_percent(float(np.mean(~has_motion)))} of the samples."
    unit = "" if trajectory.objective.unit == "1" else f", {trajectory.objective.unit}"
    panels = [
        Timeline(
            lines,
            f"objective{unit}" if len(unit) < 24 else "objective",
            trajectory.objective.name,
            _list_singular_times(trajectory),
        )
    ]
    for measure in find_susceptibilities(trajectory.objective):
        values = measure.by_joint(trajectory.q)
        units = ", ".join(dict.fromkeys(measure.joint_unit))
        joint_lines = [
            TimelineLine(joint_values, joint.name) for joint_values, joint in zip(values.T, trajectory.arm.joints, strict=True)
        ]
        name = measure.formula.name
        panels.append(Timeline(joint_lines, f"{name}, {units}", f"{capitalise_first(name)} of each joint if it fails"))
    if len(panels) > 1:
        caption += " Below: the signed measure of each joint, without weights."
    return [_stack_panels(trajectory, panels, f"{trajectory.objective.name} along the path", caption)]


def _draw_rates(trajectory: Trajectory) -> list[Block]:
    """Draw the norm of the joint rates, and the rate of each joint."""
    cap_lines = (
        []
        if trajectory.rate_cap is None
        else [TimelineLine(np.full(len(trajectory.time), trajectory.rate_cap), "cap", "compared")]
    )
    has_slides = bool(trajectory.arm.prismatic.any())
    unit = "rad/s and m/s" if has_slides else "rad/s"
    panels = [
        Timeline(
            [TimelineLine(trajectory.rate_norm, "norm", "first"), *cap_lines],
            unit,
            "Norm of the joint rates",
            _list_singular_times(trajectory),
        ),
        Timeline(
            [TimelineLine(rates, joint.name) for rates, joint in zip(trajectory.qd.T, trajectory.arm.joints, strict=True)],
            unit,
            "Joint rates",
        ),
    ]
    caption = (
        f"Rates at the samples; between them the norm reaches {trajectory.peak_rate:.4g} rad/s at {trajectory.peak_time:.4g} s."
    )
    if trajectory.rate_cap is not None:
        caption += " The cap slows only the self-motion, so the norm exceeds the cap where the task alone needs more."
    return [_stack_panels(trajectory, panels, "Joint rates over time", caption)]


def _draw_clearance(trajectory: Trajectory) -> list[Block]:
    """Draw the smallest distance of the arm from everything that it must avoid."""
    if trajectory.clear_of is None or trajectory.clearance is None or trajectory.nearest is None:
        return []
    lines = [TimelineLine(1000 * trajectory.clearance, "smallest distance", "first")]
    required_mm = 1000 * (trajectory.margin + float(trajectory.clear_of.margins.max(initial=0.0)))
    lines.append(TimelineLine(np.full(len(trajectory.time), required_mm), "required", "level"))
    caption = (
        f"Smallest distance over all pairs of bodies; the closest pair is {trajectory.nearest[1]}. "
        f"{capitalise_first(describe_shape(trajectory.clear_of, trajectory.margin))}."
    )
    return [_stack_panels(trajectory, [Timeline(lines, "mm", "Smallest distance")], "Clearance over time", caption)]


def _draw_torques(trajectory: Trajectory) -> list[Block]:
    """Draw the torques that hold the arm, and those of the motion at three speeds."""
    try:
        gravity = trajectory.arm.gravity_torque(trajectory.q)
        torques_by_speed = {speed_factor: trajectory.torques(speed_factor) for speed_factor in SPEED_FACTORS}
    except ArmError as error:
        return [Text(f"No torques: {error}.", quiet=True)]
    line_styles = ("first", "second", "third")
    panels = []
    for index, joint in enumerate(trajectory.arm.joints):
        lines = [TimelineLine(gravity[:, index], "gravity alone", "compared")]
        lines += [
            TimelineLine(
                torques_by_speed[speed_factor][:, index],
                f"in {speed_factor * trajectory.time[-1]:.4g} s",
                line_style,  # type: ignore[arg-type]
            )
            for speed_factor, line_style in zip(SPEED_FACTORS, line_styles, strict=True)
        ]
        panels.append(Timeline(lines, "N" if joint.prismatic else "N m", joint.name))
    image = draw_small_multiples(trajectory.time, panels, "Joint torques over time")
    return [
        Picture(
            image,
            "Torque of each joint, with inertia, centrifugal and Coriolis terms and viscous friction, if the same motion "
            f"takes {', '.join(f'{joint_slowness * trajectory.time[-1]:.4g}' for joint_slowness in SPEED_FACTORS)} s. All "
            "curves are plotted over the time of the first; dashed lines are the torques at rest. The susceptibilities "
            "assume that these torques hardly differ (English and Maciejewski 1998, eq. (5), Figs. 9 to 12). Accelerations "
            "are differences of the sampled rates.",
        )
    ]


def _draw_curvature(trajectory: Trajectory) -> list[Block]:
    """Draw the smallest curvature of the objective along the self-motion."""
    is_finite = np.isfinite(trajectory.curvature)
    if not is_finite.any():
        return []
    typical = float(np.median(np.abs(trajectory.curvature[is_finite])))
    level = TimelineLine(np.zeros(len(trajectory.time)), "zero", "compared")
    panel = Timeline(
        [TimelineLine(trajectory.curvature, "smallest curvature", "first"), level],
        "per rad^2",
        "Curvature of the objective along the self-motion",
        _list_singular_times(trajectory),
        "symlog" if typical > 0 and np.abs(trajectory.curvature[is_finite]).max() > 30 * typical else "linear",
        typical or 1.0,
    )
    return [
        _stack_panels(
            trajectory,
            [panel],
            "Curvature along the self-motion over time",
            "The curvature is above 0 at a local optimum. Where it reaches 0 while the arm is not singular, the local "
            "optimum ends or splits. This is an algorithmic singularity (English and Maciejewski 1998, section VI-B); it "
            "is marked where the joint rates show it.",
        )
    ]


def _draw_tool_error(trajectory: Trajectory) -> list[Block]:
    """Draw the error of the end effector relative to its path."""
    panels = [
        Timeline(
            [TimelineLine(1000 * trajectory.position_error, "error", "first")],
            "mm",
            "Position error of the end effector",
            (),
            "log",
        )
    ]
    if trajectory.task.angular:
        lines = [TimelineLine(1000 * trajectory.rotation_error, "error", "first")]
        panels.append(Timeline(lines, "mrad", "Orientation error of the end effector", (), "log"))
    caption = (
        f"Errors in the dimensions of task '{trajectory.task.name}', on a log scale. Above {1000 * TRACKING_TOLERANCE:g} "
        "mm or mrad, the end effector has left its path."
    )
    return [_stack_panels(trajectory, panels, "Error of the end effector over time", caption)]
