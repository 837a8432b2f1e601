"""Demonstration of a calibrated monitor that identifies a joint fault during a motion: simulation and drawing."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from html import escape
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.interface.studio.motions import MOTION_SAMPLES, PlayedMotion
from holdfast.interface.studio.scene.machine import CompiledArm
from holdfast.interface.studio.state import State
from holdfast.model.arm.poses import pose_from_quaternion
from holdfast.response.diagnosis.decision import CLASSIFICATION_TIME_S, ISOLATION_TIME_S, SENSOR_REVISION_TIME_S
from holdfast.response.faults.log import MAX_LIMIT_EXCESS

if TYPE_CHECKING:
    from holdfast.response.diagnosis.answer import Diagnosis
    from holdfast.response.diagnosis.bounds import Bounds
    from holdfast.response.supervisor.run import FaultRun


FAULT_PARAMETERS: Mapping[str, Mapping[str, float | str]] = MappingProxyType(
    {
        "locked": {"at": "here"},
        "limp": {},
        "weak": {"gain": 0.3},
        "friction": {"coulomb": 8.0, "viscous": 0.0},
        "sensor_freeze": {},
        "sensor_drift": {"rate": 0.05},
        "slipping_clutch": {},
        "none": {},
    }
)
LATEST_ONSET_S = 4.0  # latest onset of a fault, s
# SPEED_LIMIT_M_S, LAW_GAIN_PER_S and MOTION_TIME_LIMIT_S: limits and gain of the motions, m/s, 1/s, s
SPEED_LIMIT_M_S = 0.25
LAW_GAIN_PER_S = 2.0
MOTION_TIME_LIMIT_S = 8.0
# HEALTHY_MOTIONS and THRESHOLD_FACTOR: number of motions for the thresholds, and factor on their largest residuals, which is
# large because the motions are few
HEALTHY_MOTIONS = 4
THRESHOLD_FACTOR = 2.0
# MAX_LINE_POINTS and PLAYBACK_STEPS: points of a line, and steps of the time during playback
MAX_LINE_POINTS = 150
PLAYBACK_STEPS = 60
# _MIN_DRAWN_RATIO and _MAX_DRAWN_RATIO: drawn range of a residual, in units of its threshold
_MIN_DRAWN_RATIO = 0.1
_MAX_DRAWN_RATIO = 30.0
# _PANEL_WIDTH_PX and _PANEL_HEIGHT_PX: size of one panel, px
_PANEL_WIDTH_PX = 300
_PANEL_HEIGHT_PX = 74


@dataclass(frozen=True, kw_only=True)
class MonitorDemo:
    """Motion with a fault, and the output of the monitor.

    Attributes:
        motion: Motion of the arm with its fault.
        time: (T,) times, s.
        residuals: Residuals by signal, in units of their thresholds: (T, n), or (T, 1) for the tool.
        onset: Onset of the fault, s; infinite without a fault.
        alarm_time: Time of the alarm, s; infinite without an alarm.
        joint: Index of the isolated joint, from 0; None without one.
        isolation_time: Time of the isolation, s; infinite without an isolated joint.
        kind: Kind of the fault, as the monitor names it.
        classification_time: Time from which the kind and the findings are known, s; infinite without an alarm.
        findings: Sentences about the fault.
        inconclusive: Sentences about inconclusive results.
    """

    motion: PlayedMotion
    time: FloatArray
    residuals: Mapping[str, FloatArray]
    onset: float
    alarm_time: float
    joint: int | None
    isolation_time: float
    kind: str
    classification_time: float
    findings: tuple[str, ...]
    inconclusive: tuple[str, ...]


_last_thresholds: dict[object, Bounds] = {}  # of the last request, so that another fault needs one motion and not five


def simulate_monitor_demo(machine: CompiledArm, state: State, progress: Callable[[int, int], None]) -> MonitorDemo:
    """Simulate a motion to the target under the first law during which a joint fails, and run a monitor on its log.

    The controller does not respond to the fault. Masses and friction of the simulated robot are up to 20 % off the arm's model,
    and its sensors are noisy.

    Args:
        machine: Compiled arm.
        state: State with the configuration, the target, the law, and the fault (kind, joint and time).
        progress: Function that is called with (done, total) motions, and raises an exception to cancel.

    Raises:
        InputError: There is no target, or no such fault.
        ArmError: The arm's inertial data are missing or impossible.
        HoldfastError: MuJoCo is not installed.
    """
    import holdfast as hf

    kind, joint, onset = state.fault
    if state.target is None:
        raise InputError("there is no target; choose one first")
    arm, q = machine.arm, np.array(state.q)
    target_pose, start_pose = pose_from_quaternion(state.target[:3], state.target[3:]), machine.tool_pose(q)
    law = hf.control.by_name(state.laws[0], arm, task=machine.task, gain=LAW_GAIN_PER_S, speed_limit=SPEED_LIMIT_M_S)
    robot, start, logs = hf.Body(), q, list[hf.faults.Log]()
    calibration_key = (arm.fingerprint, machine.task.name, state.laws[0], state.q, state.target)
    for number in range(HEALTHY_MOTIONS if calibration_key not in _last_thresholds else 0):
        progress(number, HEALTHY_MOTIONS + 1)
        motion_target = _to_task_target(machine, start_pose if number % 2 else target_pose)
        run = hf.simulate_faults(law, start, motion_target, body=robot, seed=number, time_limit=MOTION_TIME_LIMIT_S)
        logs, start = [*logs, run.log()], np.asarray(run.q[-1])
    if logs:
        coulomb, viscous = np.full(arm.n, robot.coulomb), np.full(arm.n, robot.viscous)
        _last_thresholds.clear()
        _last_thresholds[calibration_key] = hf.diagnosis.calibrate(
            arm, logs, factor=THRESHOLD_FACTOR, coulomb=coulomb, viscous=viscous
        )
    monitor = hf.diagnosis.Monitor(arm, _last_thresholds[calibration_key])
    progress(HEALTHY_MOTIONS, HEALTHY_MOTIONS + 1)
    faults = [] if kind == "none" else [hf.faults.FaultEvent(kind, joint, onset, parameters=FAULT_PARAMETERS[kind])]

    def simulate(time_limit: float) -> FaultRun:
        motion_target = _to_task_target(machine, target_pose)
        return hf.simulate_faults(law, q, motion_target, faults=faults, body=robot, seed=HEALTHY_MOTIONS, time_limit=time_limit)

    run = simulate(MOTION_TIME_LIMIT_S)
    # If a joint is limp, a law that ignores joint limits can command values far beyond them, and a monitor rejects such a log.
    excess = np.maximum(arm.lower - run.reference, run.reference - arm.upper).max(axis=1)
    if (excess > MAX_LIMIT_EXCESS).any():
        run = simulate(float(run.time[np.argmax(excess > MAX_LIMIT_EXCESS) - 1]))
    return _evaluate_monitor(run, monitor.run(run.log()), onset if faults else np.inf, state.names)


def _to_task_target(machine: CompiledArm, pose: FloatArray) -> FloatArray:
    """Convert a pose to a target of the task."""
    return pose if machine.task.angular else np.asarray(machine.task.rows[:, :3] @ pose[:3, 3])


def _evaluate_monitor(run: FaultRun, diagnosis: Diagnosis, onset: float, names: tuple[str, ...]) -> MonitorDemo:
    verdict, scaled, stride = diagnosis.verdict, diagnosis.scaled, max(1, len(run.time) // MAX_LINE_POINTS)
    findings: list[str] = []
    alarm_time = float(verdict.time) if verdict.alarm else np.inf
    isolation_time = alarm_time + (SENSOR_REVISION_TIME_S if verdict.kind == "sensor" else ISOLATION_TIME_S)
    if verdict.alarm:
        fault = diagnosis.describe()[0].partition(": ")[2].removesuffix(".")
        findings = [fault, *verdict.evidence]
    inconclusive = (
        [f"did not move enough for a diagnosis: {', '.join(diagnosis.inconclusive)}"] if diagnosis.inconclusive else []
    )
    if verdict.alarm and len(verdict.candidates) > 1:
        inconclusive.append(f"not distinguished: {', '.join(verdict.candidates)}")
    if not verdict.alarm:
        inconclusive.insert(0, "no fault was detected, which does not prove that there is none")
    residuals = {
        "torque residual": _downsample_maxima(scaled.torque, stride),
        "tracking error": _downsample_maxima(scaled.tracking, stride),
    }
    if np.isfinite(scaled.tool).any():
        residuals["tool-pose residual"] = _downsample_maxima(scaled.tool[:, None], stride)
    motion_samples = slice(None, None, max(1, len(run.time) // (4 * MOTION_SAMPLES)))
    return MonitorDemo(
        motion=PlayedMotion("the arm with the fault, no response", run.time[motion_samples], "s", run.q[motion_samples]),
        time=run.time[::stride],
        residuals=residuals,
        onset=onset,
        alarm_time=alarm_time,
        joint=names.index(verdict.joint) if verdict.joint in names else None,
        isolation_time=np.inf if verdict.joint is None else isolation_time,
        kind=verdict.kind,
        classification_time=isolation_time if verdict.kind == "sensor" else isolation_time + CLASSIFICATION_TIME_S,
        findings=tuple(findings),
        inconclusive=tuple(inconclusive),
    )


def _downsample_maxima(values: FloatArray, stride: int) -> FloatArray:
    """Return the largest value of each group of samples, so that no peak is lost: (T', n); NaN without values."""
    groups = -(-len(values) // stride)
    padded = np.full((groups * stride, values.shape[1]), -np.inf)
    padded[: len(values)] = np.where(np.isfinite(values), values, -np.inf)
    maxima = padded.reshape(groups, stride, -1).max(axis=1)
    return np.where(np.isfinite(maxima), maxima, np.nan)


# ---- drawing ---------------------------------------------------------------------------------------------------------


def monitor_html(demo: MonitorDemo, names: tuple[str, ...], current: float) -> str:
    """Draw the residuals up to the current time, each in units of its threshold, and the findings of the monitor so far."""
    end = float(demo.time[-1])
    # Limited, because otherwise the page would be sent thirty times a second.
    current = current if current >= end else end * np.floor(current / end * PLAYBACK_STEPS) / PLAYBACK_STEPS
    panels = [
        _draw_panel(quantity, demo, values, current, names)
        for quantity, values in demo.residuals.items()
        if np.isfinite(values).any()
    ]
    findings = demo.findings if current >= demo.classification_time else ()
    lines = [*findings, *(demo.inconclusive if current >= end * (1 - 1e-9) else ())]
    items = "".join(f"<li>{escape(line)}</li>" for line in lines)
    legend = "Each line is a joint. Dashed: threshold; purple: onset of the fault; orange: alarm."
    return (
        f'<div class="hf-watch"{" data-alarm" if current >= demo.alarm_time else ""}>'
        f'<strong class="hf-head">{escape(_describe_alarm(demo, names, current))}</strong><div class="hf-soft">{legend}</div>'
        f"{''.join(panels)}<ul>{items}</ul></div>"
    )


def _describe_alarm(demo: MonitorDemo, names: tuple[str, ...], current: float) -> str:
    """Describe the alarm, and the joint and the kind of fault that the monitor has found by the current time."""
    if current < demo.alarm_time:
        return "No alarm so far."
    delay = demo.alarm_time - demo.onset
    when = f"at {demo.alarm_time:.3f} s, before any fault" if delay < 0 else f"{1000 * delay:.0f} ms after the fault"
    joint = "not identified"
    if demo.joint is not None and current >= demo.isolation_time:
        is_classified = current >= demo.classification_time and demo.kind != "unknown"
        joint = names[demo.joint] + (f", {demo.kind}" if is_classified else "")
    return f"Alarm {when}; joint: {joint}."


def _draw_panel(quantity: str, demo: MonitorDemo, values: FloatArray, current: float, names: tuple[str, ...]) -> str:
    end = float(demo.time[-1]) or 1.0
    is_past = demo.time <= current
    x = _PANEL_WIDTH_PX * demo.time / end
    y = _PANEL_HEIGHT_PX - _PANEL_HEIGHT_PX * np.log(
        np.clip(values, _MIN_DRAWN_RATIO, _MAX_DRAWN_RATIO) / _MIN_DRAWN_RATIO
    ) / np.log(_MAX_DRAWN_RATIO / _MIN_DRAWN_RATIO)
    bound = _PANEL_HEIGHT_PX - _PANEL_HEIGHT_PX * np.log(1 / _MIN_DRAWN_RATIO) / np.log(_MAX_DRAWN_RATIO / _MIN_DRAWN_RATIO)
    lines = []
    for column in range(values.shape[1]):
        is_drawn = is_past & np.isfinite(values[:, column])
        is_isolated = column == demo.joint and values.shape[1] > 1 and current >= demo.isolation_time
        points = " ".join(
            f"{point_x:.1f},{point_y:.1f}" for point_x, point_y in zip(x[is_drawn], y[is_drawn, column], strict=True)
        )
        lines.append((is_isolated, f'<polyline{" class=hf-named" if is_isolated else ""} points="{points}"/>'))
    marks = [
        f'<line class="{mark}" x1="{_PANEL_WIDTH_PX * mark_time / end:.1f}" x2="{_PANEL_WIDTH_PX * mark_time / end:.1f}" '
        f'y1="0" y2="{_PANEL_HEIGHT_PX}"/>'
        for mark, mark_time in (("hf-onset", demo.onset), ("hf-alarm", demo.alarm_time))
        if mark_time <= min(current, end)
    ]
    exceeding = [
        names[column]
        for column in range(values.shape[1])
        if values.shape[1] > 1 and np.nanmax(np.append(values[is_past, column], 0)) > 1
    ]
    label = f"{quantity} / threshold until {current:.2f} s; above it: {', '.join(exceeding) or 'none'}"
    polylines = "".join(text for _, text in sorted(lines))
    return (
        f"<figure><figcaption>{escape(quantity)} / threshold</figcaption>"
        f'<svg viewBox="0 0 {_PANEL_WIDTH_PX} {_PANEL_HEIGHT_PX}" role="img" '
        f'aria-label="{escape(label, quote=True)}">{polylines}'
        f'<line class="hf-bound" x1="0" x2="{_PANEL_WIDTH_PX}" y1="{bound:.1f}" y2="{bound:.1f}"/>{"".join(marks)}'
        f'<text x="2" y="{bound - 2:.1f}">1</text></svg></figure>'
    )
