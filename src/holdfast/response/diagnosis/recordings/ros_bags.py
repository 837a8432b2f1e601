"""Read joint states and commands of ROS 2 from bags (SQLite and MCAP) and single MCAP files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

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
_USUAL_STATE_TOPIC = "/joint_states"
_LONGEST_PAUSE_S = 1.0  # a longer pause separates two episodes
_SECONDS_PER_NANOSECOND = 1e-9


class _Sample(NamedTuple):
    """Joint values of one message; ``names`` is empty for commands without names."""

    time: float  # s
    names: tuple[str, ...]
    positions: Sequence[float]
    references: Sequence[float] = ()
    torques: Sequence[float] = ()


def read_bag(path: Path, state: str | None, reference: str | None) -> Recording:
    """Read a bag folder or a file of a bag; pauses of more than 1 s separate episodes.

    Args:
        path: Folder with ``metadata.yaml``, or an MCAP or SQLite file.
        state: Topic with the joint states. Default: the only one, or ``/joint_states``.
        reference: Topic with the references. Default: that of the states, or the only topic with commands.

    Raises:
        InputError: The bag cannot be read, or the topics are not in it.
        HoldfastError: The package ``rosbags`` is not installed.
    """
    any_reader = import_extra("rosbags.highlevel", "records", "rosbags").AnyReader
    stores = import_extra("rosbags.typesys", "records", "rosbags")
    try:
        store = stores.get_typestore(stores.Stores.ROS2_HUMBLE)  # for bags that do not contain their message types
        with any_reader([path], default_typestore=store) as reader:
            types = {connection.topic: connection.msgtype for connection in reader.connections}
            state_topic = _choose_state(path, types, state)
            reference_topic, notes = _choose_reference(path, types, state_topic, reference)
            samples: dict[str | None, list[_Sample]] = {state_topic: [], reference_topic: []}
            connections = [connection for connection in reader.connections if connection.topic in samples]
            for connection, time, raw in reader.messages(connections=connections):
                message = reader.deserialize(raw, connection.msgtype)
                samples[connection.topic].append(_read_message(message, time * _SECONDS_PER_NANOSECOND))
    except HoldfastError:
        raise
    except Exception as error:  # SQLite, the decoders, and the metadata raise errors of many types
        raise InputError(f"'{path}' cannot be read as a ROS 2 bag or MCAP file ({error})") from error
    joints = max((sample.names for sample in samples[state_topic]), key=len, default=())
    states = [sample for sample in samples[state_topic] if set(joints) <= set(sample.names)]
    if len(states) < 2 or not joints:
        raise InputError(f"'{path}' has {len(states)} joint states in topic '{state_topic}'; at least 2 are needed")
    t, q, tau = np.array([each.time for each in states]), _stack(states, joints, "positions"), _stack(states, joints, "torques")
    q_ref = _stack(states, joints, "references") if reference_topic == state_topic else None
    if reference_topic not in (None, state_topic):
        commands = samples[reference_topic]
        if all(not command.names and len(command.positions) == len(joints) for command in commands):
            commands = [command._replace(names=joints) for command in commands]
            notes.append(f"the commands have no names and are used in the order {list_names(list(joints))}")
        last = np.searchsorted([command.time for command in commands], t, side="right") - 1
        q_ref = np.where(last[:, None] >= 0, _stack(commands, joints, "positions")[last], np.nan)
        if not np.isfinite(q_ref).any(axis=0).all():
            q_ref, notes = None, [*notes, "the commands lack joints, so positions are not compared with a reference"]
    runs = np.split(np.arange(len(t)), np.flatnonzero(np.diff(t) > _LONGEST_PAUSE_S) + 1)
    episodes = [
        RecordedEpisode(
            index=index,
            t=t[rows] - t[rows[0]],
            q=q[rows],
            q_ref=None if q_ref is None else q_ref[rows],
            tau=tau[rows] if np.isfinite(tau).all() else None,
        )
        for index, rows in enumerate(runs)
    ]
    return Recording(
        source=str(path),
        format="ROS 2 bag" if path.is_dir() else f"ROS 2 file ({path.suffix})",
        joints=joints,
        unit="rad",
        fps=median_rate(t),
        episodes=tuple(episodes),
        notes=tuple(notes),
    )


def _choose_state(path: Path, types: dict[str, str], state: str | None) -> str:
    topics = [topic for topic, kind in types.items() if kind in (_JOINT_STATE, _CONTROLLER_STATE)]
    controllers = [topic for topic in topics if types[topic] == _CONTROLLER_STATE]
    if state is not None:
        topics = controllers = [state] if state in topics else []
    if not topics:
        raise InputError(f"'{path}' has no joint states; its topics are {list_names(list(types)) or 'none'}")
    for choice in (controllers, [topic for topic in topics if topic == _USUAL_STATE_TOPIC], topics):
        if len(choice) == 1:
            return choice[0]
    raise InputError(f"'{path}' has several topics with joint states: {list_names(topics)}; name one by --state")


def _choose_reference(
    path: Path, types: dict[str, str], state_topic: str, reference: str | None
) -> tuple[str | None, list[str]]:
    """Return the topic with the references, or None, and notes."""
    if reference is not None and types.get(reference) not in (_FLOAT_COMMAND, _JOINT_STATE):
        raise InputError(f"'{path}' has no joint commands in '{reference}'; its topics are {list_names(list(types))}")
    if reference is not None or types[state_topic] == _CONTROLLER_STATE:
        return reference or state_topic, []
    commands = [topic for topic, kind in types.items() if kind == _FLOAT_COMMAND]
    if len(commands) == 1:
        return commands[0], []
    reason = f"several topics with commands ({list_names(commands)}): name one by --reference" if commands else "no commands"
    return None, [f"the bag has {reason}, so positions are not compared with a reference"]


def _read_message(message: Any, recorded_time: float) -> _Sample:
    """Return the joint values of a message, at the time of its header if that is given."""
    if hasattr(message, "data"):
        return _Sample(recorded_time, (), message.data)
    stamp = message.header.stamp
    time = float(stamp.sec + stamp.nanosec * _SECONDS_PER_NANOSECOND) or recorded_time
    if hasattr(message, "name"):
        return _Sample(time, tuple(message.name), message.position, torques=message.effort)
    is_new = hasattr(message, "feedback")  # the fields have other names since ROS 2 Iron
    measured, wanted = (message.feedback, message.reference) if is_new else (message.actual, message.desired)
    return _Sample(time, tuple(message.joint_names), measured.positions, wanted.positions, measured.effort)


def _stack(samples: Sequence[_Sample], joints: Sequence[str], field: str) -> FloatArray:
    """Return values (T, n) of one field in the order of the joints; NaN where a message has none."""
    rows = []
    for sample in samples:
        values = dict(zip(sample.names, getattr(sample, field), strict=False))
        rows.append([values.get(name, np.nan) for name in joints])
    return np.array(rows, dtype=np.float64)
