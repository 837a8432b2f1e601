"""Demonstration of a calibrated monitor that identifies a joint fault during a motion: simulation."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.interface.studio.machine import CompiledArm, to_plain
from holdfast.interface.studio.motions import PlayedMotion
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
SPEED_LIMIT_M_S = 0.25
LAW_GAIN_PER_S = 2.0
MOTION_TIME_LIMIT_S = 8.0
HEALTHY_MOTIONS = 4  # motions from which the thresholds are computed
THRESHOLD_FACTOR = 2.0  # on their largest residuals; it is large because the motions are few
MAX_LINE_POINTS = 150  # points of the line of a residual
MOTION_SAMPLES = 240  # configurations of a shown motion under a law


_last_thresholds: dict[object, Bounds] = {}  # of the last request, so that another fault needs one motion and not five


def simulate_monitor_demo(machine: CompiledArm, state: State, progress: Callable[[int, int], None]) -> dict[str, Any]:
    """Simulate a motion to the target under the first law during which a joint fails, and run a monitor on its log.

    The controller does not respond to the fault. Masses and friction of the simulated robot are up to 20 % off the arm's model,
    and its sensors are noisy.

    Args:
        machine: Compiled arm.
        state: State with the configuration, the target, the law, and the fault (kind, joint and time).
        progress: Function that is called with (done, total) motions, and raises an exception to cancel.

    Returns:
        ``Watch`` of ``page/src/arm_page/answers.ts``: residuals in units of their thresholds, and sentences with their times.

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


def _evaluate_monitor(run: FaultRun, diagnosis: Diagnosis, onset: float, names: tuple[str, ...]) -> dict[str, Any]:
    verdict, scaled, end = diagnosis.verdict, diagnosis.scaled, float(run.time[-1])
    isolation_time = float(verdict.time) + (SENSOR_REVISION_TIME_S if verdict.kind == "sensor" else ISOLATION_TIME_S)
    stride, motion_stride = max(1, len(run.time) // MAX_LINE_POINTS), max(1, len(run.time) // (4 * MOTION_SAMPLES))
    signals = {"torque residual": scaled.torque, "tracking error": scaled.tracking, "tool-pose residual": scaled.tool[:, None]}
    is_isolated = verdict.alarm and verdict.joint in names
    label = "the arm with the fault, no response"
    return {
        "motion": PlayedMotion(label, run.time[::motion_stride], "s", run.q[::motion_stride]).to_plain(),
        "time": run.time[::stride].tolist(),
        "signals": [
            {"label": name, "values": to_plain(_downsample_maxima(values, stride))}
            for name, values in signals.items()
            if np.isfinite(values).any()
        ],
        "onset": onset if np.isfinite(onset) else None,
        "alarm": float(verdict.time) if verdict.alarm else None,
        "isolated": {"joint": names.index(verdict.joint), "from": isolation_time} if is_isolated else None,
        "sentences": [
            {"from": min(time, end), "text": text} for time, text in _write_sentences(diagnosis, onset, isolation_time, end)
        ],
    }


def _write_sentences(diagnosis: Diagnosis, onset: float, isolation_time: float, end: float) -> list[tuple[float, str]]:
    """Write what the monitor reports, each sentence with the time from which it is known, s."""
    verdict = diagnosis.verdict
    sentences: list[tuple[float, str]] = []
    if verdict.alarm:
        alarm_time = float(verdict.time)
        delay_text = f"{1000 * (alarm_time - onset):.0f} ms after the fault"
        when = delay_text if alarm_time >= onset else f"at {alarm_time:.3f} s, before any fault"
        sentences.append((alarm_time, f"Alarm {when}."))
        if verdict.joint is not None:
            sentences.append((isolation_time, f"The monitor isolates {verdict.joint}."))
        fault = diagnosis.describe()[0].partition(": ")[2].removesuffix(".")
        known_from = isolation_time + (0.0 if verdict.kind == "sensor" else CLASSIFICATION_TIME_S)
        names = tuple(diagnosis.arm.joint_names)
        for text in (fault, *verdict.evidence):
            start = text[:1] if text.startswith(names) else text[:1].upper()
            sentences.append((known_from, f"{start}{text[1:].removesuffix('.')}."))
    else:
        sentences.append((end, "No fault was detected, which does not prove that there is none."))
    if diagnosis.inconclusive:
        sentences.append((end, f"Did not move enough for a diagnosis: {', '.join(diagnosis.inconclusive)}."))
    if verdict.alarm and len(verdict.candidates) > 1:
        sentences.append((end, f"Not distinguished: {', '.join(verdict.candidates)}."))
    return sentences


def _downsample_maxima(values: FloatArray, stride: int) -> FloatArray:
    """Return the largest value of each group of samples, so that no peak is lost: (T', n); NaN without values."""
    groups = -(-len(values) // stride)
    padded = np.full((groups * stride, values.shape[1]), -np.inf)
    padded[: len(values)] = np.where(np.isfinite(values), values, -np.inf)
    maxima = padded.reshape(groups, stride, -1).max(axis=1)
    return np.where(np.isfinite(maxima), maxima, np.nan)
