"""Read data sets of LeRobot: their joint vectors from Parquet files. Videos are never opened.

Facts on the format are from the source text of LeRobot 0.4.4 and 0.6.1: ``timestamp`` is ``frame_index / fps`` unless the
recording program passes its own, the unit is not stated, and the names of a vector are a list, a dictionary of lists, or None.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.extras import import_extra
from holdfast.core.files.reading import guard_reading, read_json
from holdfast.core.formatting import list_names
from holdfast.core.typing import FloatArray
from holdfast.response.diagnosis.recordings.recording import RecordedEpisode, Recording

INFO_FILE = Path("meta", "info.json")
_KNOWN_VERSIONS = ("v2.0", "v2.1", "v3.0")
_INDEX_COLUMNS = ("timestamp", "frame_index", "episode_index")
_CLOCK_TOLERANCE_S = 1e-4  # single precision of a computed time
_MOTOR_TICKS = 4095  # of a full turn: the resolution by which LeRobot converts Feetech and Dynamixel positions
_FULL_TURN_DEG = 360.0
_NORMALISED_SPAN = 200.0  # from -100 to 100


def read_data_set(folder: Path, state: str | None, reference: str | None, episodes: Sequence[int] | None) -> Recording:
    """Read a data set of LeRobot 2.0, 2.1 or 3.0.

    Args:
        folder: Folder with ``meta/info.json``.
        state: Name of the vector with the joint positions. Default: ``observation.state``.
        reference: Name of the vector with the references. Default: ``action``.
        episodes: Numbers of the episodes to read. None: all.

    Raises:
        InputError: The folder lacks files or vectors, or has another format.
    """
    info = _read_info(folder)
    vectors = {
        name: feature
        for name, feature in info["features"].items()
        if str(feature.get("dtype")).startswith("float") and len(feature.get("shape", ())) == 1
    }
    options = {"state": state or "observation.state", "reference": reference or "action"}
    for option, name in options.items():
        if name not in vectors and (option == "state" or reference is not None):
            raise InputError(
                f"'{folder}' has no '{name}'; its vectors of numbers are {list_names(list(vectors)) or 'none'}: name one by "
                f"--{option}"
            )
    columns = _read_columns(folder, [name for name in options.values() if name in vectors], episodes)
    state_values, action = columns[options["state"]], columns.get(options["reference"])
    entries = _name_entries(vectors[options["state"]], state_values.shape[1])
    joints = {name.removesuffix(".pos"): column for name, column in entries.items() if not name.endswith((".vel", ".torque"))}
    torque_columns = [entries[f"{name}.torque"] for name in joints if f"{name}.torque" in entries]
    action_columns, note = None, f"the data set has no '{options['reference']}'"
    if action is not None:
        action_columns, note = _match_action(vectors[options["reference"]], action.shape[1], list(joints))
    if action_columns is None:
        note += ", so positions are not compared with a reference"
    fps, times = float(info["fps"]), columns["timestamp"]
    is_measured = np.abs(times - columns["frame_index"] / fps) > _CLOCK_TOLERANCE_S + 1e-6 * np.abs(times)
    recorded = []
    for number in np.unique(columns["episode_index"]).astype(int):
        rows = columns["episode_index"] == number
        recorded.append(
            RecordedEpisode(
                index=int(number),
                t=times[rows],
                q=state_values[rows][:, list(joints.values())],
                q_ref=None if action is None or action_columns is None else action[rows][:, action_columns],
                tau=state_values[rows][:, torque_columns] if len(torque_columns) == len(joints) else None,
                clock="measured" if is_measured[rows].any() else "computed",
            )
        )
    return Recording(
        source=str(folder),
        format=f"LeRobot {info['codebase_version']}",
        robot=str(info.get("robot_type") or ""),
        joints=tuple(joints),
        unit=None,
        fps=fps,
        episodes=tuple(recorded),
        notes=(note,) if note else (),
    )


def _read_info(folder: Path) -> dict[str, Any]:
    try:
        with guard_reading(f"'{folder / INFO_FILE}'"):
            info = read_json(folder / INFO_FILE)
        version, features, fps = info["codebase_version"], info["features"], float(info["fps"])
        if not (isinstance(features, dict) and all(isinstance(value, dict) for value in features.values()) and fps > 0):
            raise ValueError("its features are no dictionaries, or its fps is not above 0")
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(
            f"'{folder / INFO_FILE}' is not the description of a LeRobot data set ({error}); it must have codebase_version, "
            "features and fps"
        ) from error
    if version not in _KNOWN_VERSIONS:
        raise InputError(f"'{folder}' has LeRobot's format {version}; 2.0, 2.1 and 3.0 are read: convert it with LeRobot")
    return dict(info)


def _read_columns(folder: Path, vectors: Sequence[str], episodes: Sequence[int] | None) -> dict[str, FloatArray]:
    """Return the rows of all files: vectors (rows, size) and numbers (rows,)."""
    parquet = import_extra("pyarrow.parquet", "records", "pyarrow")
    files = sorted(folder.glob("data/*/*.parquet"))
    if not files:
        raise InputError(
            f"'{folder}' has no data/*/*.parquet; download the data set first, for example with hf download NAME --repo-type "
            "dataset --exclude 'videos/*' --local-dir FOLDER"
        )
    names, parts = [*vectors, *_INDEX_COLUMNS], []
    chosen = None if episodes is None else [("episode_index", "in", list(episodes))]
    for file in files:
        try:  # one thread: threads of pyarrow that still run when Python exits would crash the process
            table = parquet.read_table(file, columns=names, filters=chosen, use_threads=False, pre_buffer=False)
            if len(table):
                parts.append({name: np.array(table[name].to_pylist(), dtype=np.float64) for name in names})
        except Exception as error:  # missing columns, vectors of different sizes, damaged files: errors of many types
            raise InputError(f"'{file}' cannot be read ({error}); download it again") from error
    if not parts or any(len({part[name].shape[1:] for part in parts}) > 1 for name in names):
        raise InputError(f"'{folder}' has no rows of the requested episodes, or vectors of different sizes")
    return {name: np.concatenate([part[name] for part in parts]) for name in names}


def _list_names(feature: Mapping[str, Any], size: int) -> list[str]:
    """Return the names of the entries of a vector; none if the data set does not have one name for each."""
    names = feature.get("names")
    if isinstance(names, dict):
        groups = [group if isinstance(group, list) else [name] for name, group in names.items()]
        names = [name for group in groups for name in group]
    texts = list(map(str, names)) if isinstance(names, list) else []
    return texts if len(texts) == size == len(set(texts)) else []


def _name_entries(feature: Mapping[str, Any], size: int) -> dict[str, int]:
    """Return the column of each entry of a vector by its name; without names, joint_1, joint_2, ..."""
    return {name: index for index, name in enumerate(_list_names(feature, size) or [f"joint_{k + 1}" for k in range(size)])}


def _match_action(feature: Mapping[str, Any], size: int, joints: Sequence[str]) -> tuple[list[int] | None, str]:
    """Return the columns of an action that are the references of the joints, or None, and a note."""
    names = _list_names(feature, size)
    if not names and size == len(joints):
        return list(range(size)), "the entries of the action have no names and are used in the order of the joints"
    by_name = {name.removesuffix(".pos"): index for index, name in enumerate(names)}
    if missing := [name for name in joints if name not in by_name]:
        return None, f"the action has {list_names(names) or f'{size} entries without names'} and no '{missing[0]}'"
    return [by_name[name] for name in joints], ""


def degrees_per_unit(file: Path, joints: Sequence[str]) -> FloatArray:
    """Return the degrees (n,) per unit of positions from -100 to 100, from a calibration file of LeRobot.

    Raises:
        InputError: The file cannot be read, or lacks the range of a joint.
    """
    try:
        with guard_reading(f"calibration '{file}'", "give --unit deg, --unit rad, or a calibration file of LeRobot"):
            entries = read_json(file)
        ticks = [float(entries[name]["range_max"]) - float(entries[name]["range_min"]) for name in joints]
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(f"calibration '{file}' has no range_min and range_max of every joint ({error})") from error
    return np.array(ticks) / _NORMALISED_SPAN * _FULL_TURN_DEG / _MOTOR_TICKS
