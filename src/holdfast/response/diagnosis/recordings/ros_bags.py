"""Read joint states and commands of ROS 2 from bags (SQLite and MCAP) and single MCAP files."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.extras import import_extra
from holdfast.core.formatting import list_names
from holdfast.core.typing import FloatArray
from holdfast.response.diagnosis.recordings.recording import RecordedEpisode, Recording, median_rate

BAG_INFO_FILE = "metadata.yaml"
_JOINT_STATE = "sensor_msgs/msg/JointState"
_CONTROLLER_STATE = "control_msgs/msg/JointTrajectoryControllerState"
_FLOAT_COMMAND = "std_msgs/msg/Float64MultiArray"
_TRAJECTORY = "trajectory_msgs/msg/JointTrajectory"
_USUAL_STATE_TOPIC = "/joint_states"
_LONGEST_PAUSE_S = 1.0  # a longer pause separates two runs
_NANOSECONDS = 1e9


@dataclass(frozen=True)
class _Sample:
    """Joint values of one message, by joint name; ``joints`` is empty for commands without names."""

    time: float  # s
    joints: tuple[str, ...]
    values: Sequence[float]
    references: Sequence[float] = ()
    torques: Sequence[float] = ()


def read_bag(path: Path, state: str | None, reference: str | None) -> Recording:
    """Read a bag folder or an MCAP file; pauses of more than 1 s separate episodes.

    Args:
        path: Folder with ``metadata.yaml``, or an MCAP file.
        state: Topic with the joint states. Default: the only one, or ``/joint_states``.
        reference: Topic with the references. Default: that of the states, or the only topic with commands.

    Raises:
        InputError: The bag cannot be read, or the topics are not in it.
        HoldfastError: The package ``rosbags`` is not installed.
    """
    highlevel = import_extra("rosbags.highlevel", "records", "rosbags")
    stores = import_extra("rosbags.typesys", "records", "rosbags")
    try:
        store = stores.get_typestore(stores.Stores.ROS2_HUMBLE)  # for bags that do not contain their message types
        with highlevel.AnyReader([path], default_typestore=store) as reader:
            types = {connection.topic: connection.msgtype for connection in reader.connections}
            state_topic = _choose_state(path, types, state)
            reference_topic, notes = _choose_reference(path, types, state_topic, reference)

            def read_samples(topic: str, read: Callable[[Any, float], _Sample]) -> list[_Sample]:
                connections = [connection for connection in reader.connections if connection.topic == topic]
                messages = reader.messages(connections=connections)
                return [read(reader.deserialize(raw, c.msgtype), time / _NANOSECONDS) for c, time, raw in messages]

            states = read_samples(state_topic, _read_state)
            read_command = _read_state if types.get(reference_topic or "") == _JOINT_STATE else _read_command
            commands = [] if reference_topic in (None, state_topic) else read_samples(str(reference_topic), read_command)
            trajectories = types.get(reference_topic or "") == _TRAJECTORY
    except HoldfastError:
        raise
    except Exception as error:  # SQLite, the decoders, and the metadata raise errors of many types
        raise InputError(f"'{path}' cannot be read as a ROS 2 bag or MCAP file ({error})") from error
    joints = max((sample.joints for sample in states), key=len, default=())
    states = [sample for sample in states if set(joints) <= set(sample.joints)]
    if len(states) < 2 or not joints:
        raise InputError(f"'{path}' has {len(states)} joint states in topic '{state_topic}'; at least 2 are needed")
    t = np.array([sample.time for sample in states])
    q = np.array([_select(sample, sample.values, joints) for sample in states])
    q_ref = None
    if reference_topic == state_topic:
        q_ref = np.array([_select(sample, sample.references, joints) for sample in states])
    elif commands:
        q_ref, note = _hold_commands(commands, t, q, joints, trajectories)
        notes += [note] if note else []
    has_torques = all(len(sample.torques) == len(sample.joints) for sample in states)
    tau = np.array([_select(sample, sample.torques, joints) for sample in states]) if has_torques else None
    runs = np.split(np.arange(len(t)), np.flatnonzero(np.diff(t) > _LONGEST_PAUSE_S) + 1)
    episodes = [
        RecordedEpisode(
            index=index,
            t=t[rows] - t[rows[0]],
            q=q[rows],
            q_ref=None if q_ref is None else q_ref[rows],
            tau=None if tau is None else tau[rows],
        )
        for index, rows in enumerate(runs)
    ]
    return Recording(
        source=str(path),
        format="ROS 2 bag" if path.is_dir() else "MCAP file",
        joints=joints,
        unit="rad",
        fps=median_rate(t),
        episodes=tuple(episodes),
        notes=tuple(notes),
    )


def _choose_state(path: Path, types: dict[str, str], state: str | None) -> str:
    topics = [topic for topic, kind in types.items() if kind in (_JOINT_STATE, _CONTROLLER_STATE)]
    if state is not None and state in topics:
        return state
    if not topics or state is not None:
        place = f" in '{state}'" if state else ""
        raise InputError(f"'{path}' has no joint states{place}; its topics are {list_names(list(types)) or 'none'}")
    controllers = [topic for topic in topics if types[topic] == _CONTROLLER_STATE]
    for choice in (controllers, [_USUAL_STATE_TOPIC] if _USUAL_STATE_TOPIC in topics else topics):
        if len(choice) == 1:
            return choice[0]
    raise InputError(f"'{path}' has several topics with joint states: {list_names(topics)}; name one by --state")


def _choose_reference(
    path: Path, types: dict[str, str], state_topic: str, reference: str | None
) -> tuple[str | None, list[str]]:
    if reference is not None:
        if types.get(reference) in (_FLOAT_COMMAND, _TRAJECTORY, _JOINT_STATE, _CONTROLLER_STATE):
            return reference, []
        raise InputError(f"'{path}' has no joint commands in '{reference}'; its topics are {list_names(list(types))}")
    if types[state_topic] == _CONTROLLER_STATE:
        return state_topic, []
    commands = [topic for topic, kind in types.items() if kind in (_FLOAT_COMMAND, _TRAJECTORY)]
    if len(commands) == 1:
        return commands[0], []
    reason = f"several topics with commands ({list_names(commands)}): name one by --reference" if commands else "no commands"
    return None, [f"the bag has {reason}, so positions are not compared with a reference"]


def _stamp(message: Any, recorded: float) -> float:
    """Return the time of the header in s, or the time of recording if the header has none."""
    stamp = message.header.stamp
    return float(stamp.sec + stamp.nanosec / _NANOSECONDS) or recorded


def _read_state(message: Any, recorded: float) -> _Sample:
    time = _stamp(message, recorded)
    if hasattr(message, "name"):
        return _Sample(time, tuple(message.name), message.position, torques=message.effort)
    measured = message.feedback if hasattr(message, "feedback") else message.actual
    wanted = message.reference if hasattr(message, "reference") else message.desired
    return _Sample(time, tuple(message.joint_names), measured.positions, wanted.positions, measured.effort)


def _read_command(message: Any, recorded: float) -> _Sample:
    if hasattr(message, "data"):
        return _Sample(recorded, (), message.data)
    if not hasattr(message, "points"):
        state = _read_state(message, recorded)
        return _Sample(state.time, state.joints, state.references)
    points = [(point.time_from_start, point.positions) for point in message.points]
    delays = [delay.sec + delay.nanosec / _NANOSECONDS for delay, _ in points]
    return _Sample(_stamp(message, recorded), tuple(message.joint_names), [positions for _, positions in points], delays)


def _select(sample: _Sample, values: Sequence[float], joints: Sequence[str]) -> FloatArray:
    """Return values in the order of the joints; NaN if the message has none."""
    if len(values) != len(sample.joints):
        return np.full(len(joints), np.nan)
    return np.array([values[sample.joints.index(name)] for name in joints], dtype=np.float64)


def _hold_commands(
    commands: Sequence[_Sample], t: FloatArray, q: FloatArray, joints: Sequence[str], trajectories: bool
) -> tuple[FloatArray | None, str]:
    """Return the references (T, n) at times ``t``: the last command, or the point of the last trajectory; and a note."""
    names, note = commands[0].joints, ""
    if not names:
        if any(len(command.values) != len(joints) for command in commands):
            return None, f"the commands do not have {len(joints)} values, so positions are not compared with a reference"
        names, note = tuple(joints), f"the commands have no names and are used in the order {list_names(list(joints))}"
    elif missing := [name for name in joints if name not in names]:
        return None, f"the commands have no '{missing[0]}', so positions are not compared with a reference"
    order = [names.index(name) for name in joints]
    references = np.full(q.shape, np.nan)
    last = np.searchsorted([command.time for command in commands], t, side="right") - 1
    for number in np.unique(last[last >= 0]):
        rows, command = np.flatnonzero(last == number), commands[number]
        values = np.asarray(command.values, dtype=np.float64)
        if not trajectories:
            references[rows] = values[order]
            continue
        before = references[rows[0] - 1] if rows[0] and np.isfinite(references[rows[0] - 1]).all() else q[rows[0]]
        knots = np.concatenate([[command.time], command.time + np.asarray(command.references)])
        points = np.vstack([before, values[:, order]])
        references[rows] = np.stack([np.interp(t[rows], knots, column) for column in points.T], axis=1)
    return references, note
