"""Recording of a motion for the Rerun viewer (https://rerun.io)."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from holdfast.control.simulation.runs import Runs
from holdfast.core.errors import InputError
from holdfast.core.extras import import_extra
from holdfast.core.files.output import replace_file
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.body import MeshPart, stretched_length
from holdfast.interface.presentation.arm.visuals import build_body
from holdfast.interface.presentation.cell.bodies import build_cell_parts
from holdfast.model.arm.model import Arm
from holdfast.response.recovery.recovery import Recovery
from holdfast.response.supervisor.run import FaultRun


class _RecordedMotion(NamedTuple):
    arm: Arm
    q: FloatArray  # (T, n), rad and m
    time: FloatArray | None  # (T,), s; None for a motion without timing, whose samples are numbered
    lock_times: Mapping[str, float]  # s, or number of a sample; infinite for joints that do not lock


def _read_motion(result: Result) -> _RecordedMotion:
    """Return the motion of a result, the first one of several runs."""
    if isinstance(result, Runs):
        path, joints = result.path(), result.law.arm.joint_names
        times = np.append(np.arange(len(path.time)) if result.cycles else path.time, np.inf)
        first_locked = np.where(path.locked.any(axis=0), path.locked.argmax(axis=0), -1)
        lock_times = dict(zip(joints, times[first_locked].tolist(), strict=True))
        return _RecordedMotion(result.law.arm, path.q, None if result.cycles else path.time, lock_times)
    if isinstance(result, Recovery) and len(result.q):
        timed, start_locks = result.timed, dict.fromkeys(result.locked, 0.0)
        if timed is None:
            return _RecordedMotion(result.arm, result.q, None, start_locks)
        return _RecordedMotion(result.arm, timed.q, timed.time, start_locks)
    arm, time, q = (getattr(result, name, None) for name in ("arm", "time", "q"))
    if not (isinstance(arm, Arm) and isinstance(time, np.ndarray) and isinstance(q, np.ndarray) and len(q) == len(time) > 0):
        raise InputError(f"{type(result).__name__} contains no motion, so there is nothing to record for Rerun")
    lock_times = dict(zip(arm.joint_names, getattr(result, "lock_time", ()), strict=False))
    if isinstance(result, FaultRun):
        locks = [(event.joint, event.onset) for event in result.events if event.kind == "locked"]
        locks += [(str(action.joint), action.time) for action in result.actions if action.what == "brake"]
        lock_times = dict(sorted(locks, key=lambda lock: -lock[1]))  # the first lock of each joint counts
    return _RecordedMotion(arm, q, time, lock_times)


def write_rrd(result: Result, path: Path) -> Path:
    """Write the motion of a result; :meth:`holdfast.core.result.Result.to_rrd` describes the file."""
    rerun = import_extra("rerun", "rerun", "rerun-sdk")
    from scipy.spatial.transform import Rotation

    arm, q, time, lock_times = _read_motion(result)
    clearance = getattr(result, "clearance", None)
    cell = None if clearance is None else clearance.cell
    timeline, unit = ("sample", "sequence") if time is None else ("time", "duration")
    index = [rerun.TimeColumn(timeline, **{unit: np.arange(len(q)) if time is None else time})]
    recording = rerun.RecordingStream("holdfast")
    stream = recording.binary_stream()
    recording.log("/", rerun.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    links = ["base", *arm.joint_names, "tool"]
    for link, poses in zip(links, arm.frames(q).swapaxes(0, 1), strict=True):
        quaternions = Rotation.from_matrix(poses[:, :3, :3]).as_quat()
        columns = rerun.Transform3D.columns(translation=poses[:, :3, 3], quaternion=quaternions)
        recording.send_columns(rerun.new_entity_path(["arm", link]), index, columns)
    size = stretched_length(arm)
    for number, part in enumerate(build_body(arm, size)[0] + ([] if cell is None else build_cell_parts(cell, arm.base, size))):
        recording.log(["arm", links[part.frame], f"shape{number}"], _make_mesh(rerun, part), static=True)
    for joint, values in zip(arm.joints, q.T, strict=True):
        entity = rerun.new_entity_path(["joints", joint.name])
        recording.log(entity, rerun.SeriesLines(names=f"{joint.name}, {joint.unit}"), static=True)
        recording.send_columns(entity, index, rerun.Scalars.columns(scalars=values))
        lock_time = lock_times.get(joint.name, np.inf)
        if np.isfinite(lock_time):
            recording.set_time(timeline, **{unit: int(lock_time) if time is None else float(lock_time)})
            recording.log("events", rerun.TextLog(f"{joint.name} locked", level=rerun.TextLogLevel.WARN))
    replace_file(path, stream.read(), "the recording to")
    return path


def _make_mesh(rerun: Any, part: MeshPart) -> Any:
    """Return a part as a mesh with flat shading: every triangle has its own corners and their normals."""
    corners = part.vertices[part.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    return rerun.Mesh3D(
        vertex_positions=corners.reshape(-1, 3),
        triangle_indices=np.arange(corners.size // 3).reshape(-1, 3),
        vertex_normals=np.repeat(normals, 3, axis=0),
        albedo_factor=part.color,
    )
