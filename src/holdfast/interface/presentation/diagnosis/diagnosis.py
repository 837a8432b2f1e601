"""Presentation of the diagnosis of a log: the fault, its evidence, and the signals that were not monitored."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from holdfast.core.formatting import capitalise_first, format_seconds
from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.diagnosis.bounds import present as present_bounds
from holdfast.interface.presentation.presentation import FigureSpec, Presentation, TableSpec, make_headers
from holdfast.response.diagnosis.answer import Diagnosis

_KIND_PHRASES = {
    "locked": "is locked",
    "standstill": "does not move, so it is locked, or free-swinging and held by friction",
    "limp": "swings freely, because its motor gives no torque",
    "weak": "has lost part of its motor torque",
    "friction": "has increased friction",
    "sluggish": "needs more torque than the model predicts, so it has lost part of its motor torque or has increased friction",
    "sensor": "has a faulty sensor or a slipping clutch",
    "unknown": "has a fault of an unknown kind",
}
_RESIDUALS_CAPTION = (
    "Residuals divided by their thresholds, one line per joint. A line that stays above 1 for too long raises an alarm; at "
    "twice the threshold, after 10 ms of torque, 20 ms of tracking, or 50 ms of the tool pose."
)
_MAX_POINTS = 2000  # points of a line; each is the largest value of its interval
_MIN_PLOTTED_RATIO = 1e-2
_PANEL_TITLES = {
    "torque": "Torque residuals",
    "tracking": "Tracking errors of the joints",
    "tool": "Measured tool pose, compared with that of the joint sensors",
}


def to_dict(diagnosis: Diagnosis) -> dict[str, Any]:
    """Return the verdict with the joints that could not be diagnosed."""
    verdict = diagnosis.verdict
    return {
        **diagnosis.arm.entry(),
        "alarm": verdict.alarm,
        "time_s": verdict.time,
        "joint": verdict.joint,
        "suspect": verdict.suspect,
        "kind": verdict.kind if verdict.alarm else None,
        "loss": verdict.loss,
        "uncertainty": verdict.uncertainty,
        "candidates": list(verdict.candidates),
        "evidence": list(verdict.evidence),
        "not_looked_at_s": [list(interval) for interval in diagnosis.gaps],
        "did_not_move_enough": list(diagnosis.inconclusive),
        "not_watched": list(diagnosis.unmonitored),
        "faster_than_calibrated": list(diagnosis.beyond),
    }


def present(diagnosis: Diagnosis) -> Presentation:
    """Present the fault, or that none was detected, with the reasons and the inconclusive joints."""
    verdict = diagnosis.verdict
    lines = list(verdict.evidence)
    other_kinds = [kind for kind in verdict.candidates if kind != verdict.kind]
    if other_kinds:
        lines.append(f"other possible kinds: {', '.join(other_kinds)}")
    if diagnosis.inconclusive:
        lines.append(f"these joints did not move enough for a diagnosis: {', '.join(diagnosis.inconclusive)}")
    if diagnosis.gaps:
        unmonitored = sum(gap_end - gap_start for gap_start, gap_end in diagnosis.gaps)
        lines.append(f"nothing was checked for {unmonitored:.4g} s, because there the log has no joint values")
    if diagnosis.unmonitored:
        lines.append(f"not monitored: {', '.join(diagnosis.unmonitored)}")
    if diagnosis.beyond:
        lines.append(f"faster than in the calibration, so that an alarm proves little: {', '.join(diagnosis.beyond)}")
    bounds = present_bounds(diagnosis.bounds)
    lines += ["a log without an alarm does not prove that the arm has no fault", "this is not a certified safety function"]
    return Presentation(
        "Diagnosis of a log",
        _compose_answer(diagnosis),
        about=f"{diagnosis.arm.title}, {diagnosis.log.duration:.4g} s at {diagnosis.log.rate:.4g} Hz",
        lines=[f"{capitalise_first(line)}." for line in lines],
        tables=[_tabulate_joints(diagnosis)],
        figures={
            "residuals": FigureSpec(partial(_draw_residuals, diagnosis), "Residuals and their thresholds", _RESIDUALS_CAPTION)
        },
        method=[("Thresholds", " ".join((bounds.answer, *bounds.lines)))],
        arm=diagnosis.arm,
    )


def _compose_answer(diagnosis: Diagnosis) -> str:
    verdict = diagnosis.verdict
    if not verdict.alarm:
        return f"No fault was detected in {diagnosis.log.duration:.4g} s."
    if verdict.kind == "contact":
        blame_text = "; no joint was found faulty"
        if verdict.suspect:
            blame_text = f", or {verdict.suspect} is faulty, because only its residual exceeds its threshold"
        return f"Alarm at {format_seconds(verdict.time)}: an external force acted on the arm{blame_text}."
    loss_text = f" (it gives {1 - verdict.loss:.0%} of its torque, ± {verdict.uncertainty:.0%})"
    return (
        f"Alarm at {format_seconds(verdict.time)}: {verdict.joint or 'an unidentified joint'} "
        f"{_KIND_PHRASES[verdict.kind]}{loss_text if verdict.kind == 'weak' else ''}."
    )


def _tabulate_joints(diagnosis: Diagnosis) -> TableSpec:
    scaled, has_torque = diagnosis.scaled, "torque" in diagnosis.signals.levels
    rows = [
        [
            name,
            float(np.fmax.reduce(scaled.torque[:, joint])) if has_torque else "-",
            float(np.fmax.reduce(scaled.tracking[:, joint])),
            "no" if name in diagnosis.inconclusive else "yes",
        ]
        for joint, name in enumerate(diagnosis.arm.joint_names)
    ]
    residuals = make_headers("residual torque", "tracking", digits=3, aligned=False)
    return TableSpec("Largest residuals, divided by their thresholds", ["joint", *residuals, "moved enough"], rows)


def _draw_residuals(diagnosis: Diagnosis) -> report.Figure:
    """Draw a panel for each monitored level."""
    names, verdict = [name for name in _PANEL_TITLES if name in diagnosis.signals.levels], diagnosis.verdict
    joints = diagnosis.arm.joint_names
    with report.styled_figure(1.25 * report.WIDTH_IN, 0.6 + 1.9 * len(names)) as figure:
        panels = np.atleast_1d(figure.subplots(len(names), 1, sharex=True))
        for name, axes in zip(names, panels, strict=True):
            values = getattr(diagnosis.scaled, name).reshape(len(diagnosis.log.t), -1)
            for joint, column in enumerate(values.T):
                is_blamed = name != "tool" and joints[joint] == verdict.joint
                color = report.ORANGE if is_blamed else report.BLUE if name == "tool" else report.SKY
                times, residuals = _thin_samples(diagnosis.log.t, column)
                label = joints[joint] if is_blamed else None
                axes.plot(
                    times,
                    np.maximum(residuals, _MIN_PLOTTED_RATIO),
                    color=color,
                    linewidth=1.6 if is_blamed else 0.9,
                    label=label,
                    zorder=2 + is_blamed,
                )
            for interval in diagnosis.gaps:
                axes.axvspan(*interval, color=report.EMPTY_COLOR, linewidth=0, zorder=4)  # above the lines that bridge the gap
            axes.axhline(1.0, color=report.INK, linewidth=1.0, linestyle="--")
            if verdict.alarm:
                axes.axvline(verdict.time, color=report.INK, linewidth=1.0)
                if axes is panels[0]:
                    axes.text(
                        verdict.time, 1.02, f" alarm, {verdict.time:.3f} s", transform=axes.get_xaxis_transform(), fontsize=8
                    )
            axes.set(title=_PANEL_TITLES[name], ylabel="residual / threshold", yscale="log", ylim=(_MIN_PLOTTED_RATIO, None))
            if verdict.joint is not None and name != "tool":
                axes.legend(loc="lower left", fontsize=8)
        panels[-1].set(xlabel="time, s", xlim=(diagnosis.log.t[0], diagnosis.log.t[-1]))
    return figure


def _thin_samples(t: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Reduce a signal to the number of points that a figure shows; each segment keeps its largest value."""
    is_finite = np.isfinite(y)
    t, y = t[is_finite], y[is_finite]
    stride = max(len(t) // _MAX_POINTS, 1)
    segment_count = len(t) // stride
    return t[: segment_count * stride : stride], y[: segment_count * stride].reshape(segment_count, stride).max(
        axis=1, initial=0.0
    )
