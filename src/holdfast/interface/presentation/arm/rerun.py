"""Recording of a motion for the Rerun viewer (https://rerun.io)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.extras import import_extra
from holdfast.core.files.output import replace_file
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.body import MeshPart, stretched_length
from holdfast.interface.presentation.arm.visuals import build_body
from holdfast.interface.presentation.cell.bodies import build_cell_parts
from holdfast.model.arm.model import Arm
from holdfast.model.cell.cell import Cell


@dataclass(frozen=True)
class Motion:
    """Configurations of an arm over time.

    Attributes:
        arm: Arm model.
        q: (T, n) configurations, rad and m.
        time: (T,) times, s; None for a motion without timing, whose samples are numbered.
        lock_times: ``{joint: time}`` at which a joint locks, s, or the number of its first locked sample.
        cell: Objects around the arm.
    """

    arm: Arm
    q: FloatArray
    time: FloatArray | None
    lock_times: Mapping[str, float] = field(default_factory=dict)
    cell: Cell | None = None

    @classmethod
    def from_result(cls, result: Any) -> Motion:
        """Return the motion of a result with the fields ``arm``, ``time``, ``q`` and, if joints lock in it, ``lock_time``.

        Raises:
            InputError: The result is not a motion.
        """
        arm: Arm | None = getattr(result, "arm", None)
        time, q = (np.asarray(getattr(result, name, ())) for name in ("time", "q"))
        if arm is None or time.ndim != 1 or not time.size or q.shape != (time.size, arm.n):
            raise InputError(f"{type(result).__name__} contains no motion, so there is nothing to record for Rerun")
        lock_times = zip(arm.joint_names, getattr(result, "lock_time", ()), strict=False)
        finite = {name: float(lock_time) for name, lock_time in lock_times if np.isfinite(lock_time)}
        return cls(arm, q, time, finite)


def write_rrd(motion: Motion, path: Path) -> Path:
    """Write a Rerun recording: the shapes of the arm and its environment, its frames, its joint values, and its locks.

    Entities: ``arm/LINK`` with its pose in the world (m), ``joints/JOINT`` with its value (rad or m), ``locks/JOINT`` with 0 or
    1, and ``events`` with a text at each lock. The timeline is ``time`` (s), or ``sample`` for a motion without timing.

    Raises:
        HoldfastError: rerun-sdk is not installed (extra ``rerun``).
        StoreError: The file cannot be written.
    """
    rerun = import_extra("rerun", "rerun", "rerun-sdk")
    from scipy.spatial.transform import Rotation

    arm, size = motion.arm, stretched_length(motion.arm)
    times = np.arange(len(motion.q)) if motion.time is None else motion.time
    timeline, unit = ("sample", "sequence") if motion.time is None else ("time", "duration")
    index = [rerun.TimeColumn(timeline, **{unit: times})]
    recording = rerun.RecordingStream("holdfast")
    stream = recording.binary_stream()
    recording.log("/", rerun.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    links = ["base", *arm.joint_names, "tool"]
    for link, poses in zip(links, arm.frames(motion.q).swapaxes(0, 1), strict=True):
        quaternions = Rotation.from_matrix(poses[:, :3, :3]).as_quat()
        columns = rerun.Transform3D.columns(translation=poses[:, :3, 3], quaternion=quaternions)
        recording.send_columns(rerun.new_entity_path(["arm", link]), index, columns)
    parts, _ = build_body(arm, size)
    parts += [] if motion.cell is None else build_cell_parts(motion.cell, arm.base, size)
    for number, part in enumerate(parts):
        recording.log(["arm", links[part.frame], f"shape{number}"], _make_mesh(rerun, part), static=True)
    for joint, values in zip(arm.joints, motion.q.T, strict=True):
        lock_time = motion.lock_times.get(joint.name, np.inf)
        for entity, series, label in (
            ("joints", values, f"{joint.name}, {joint.unit}"),
            ("locks", (times >= lock_time).astype(np.float64), f"{joint.name} locked"),
        ):
            entity_path = rerun.new_entity_path([entity, joint.name])
            recording.log(entity_path, rerun.SeriesLines(names=label), static=True)
            recording.send_columns(entity_path, index, rerun.Scalars.columns(scalars=series))
        if np.isfinite(lock_time):
            recording.set_time(timeline, **{unit: lock_time if unit == "duration" else int(lock_time)})
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
