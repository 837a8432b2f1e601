"""Read recordings of all formats with one function."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from holdfast.core.errors import InputError
from holdfast.core.files.reading import path_exists
from holdfast.core.formatting import list_names
from holdfast.core.validation import check_arguments
from holdfast.response.diagnosis.recordings.lerobot import INFO_FILE, degrees_per_unit, read_data_set
from holdfast.response.diagnosis.recordings.recording import RecordedEpisode, Recording, median_rate
from holdfast.response.diagnosis.recordings.ros_bags import BAG_INFO_FILE, read_bag
from holdfast.response.faults.log import read_log_arrays

_LOG_ENDINGS = (".csv", ".npz", ".parquet", ".txt")
_BAG_ENDINGS = (".mcap", ".db3")
_KNOWN_UNITS = ("deg", "rad")
_RATE_TOLERANCE = 0.05  # largest relative difference between the rates of the files of one recording


@check_arguments
def read_recording(
    path: str | Path,
    *,
    state: str | None = None,
    reference: str | None = None,
    joints: Sequence[str] | None = None,
    unit: str | Path | None = None,
    episodes: Sequence[int] | None = None,
    columns: str | Path | None = None,
) -> Recording:
    """Read the episodes of a recording, whose format is recognised from its files.

    The formats are LeRobot data sets (2.0, 2.1, 3.0), ROS 2 bags and MCAP files, logs of libfranka and of RTDE clients, and
    :class:`~holdfast.response.faults.Log` files. Any other folder is read as one recording of all bags and logs in it, in the
    order of their names.

    Args:
        path: File or folder.
        state: Vector (LeRobot) or topic (ROS 2) with the joint positions. Default: ``observation.state``, or the only topic.
        reference: Vector or topic with the references. Default: ``action``, or the only topic.
        joints: Names of the joints to keep, in this order. Default: all whose names do not contain "gripper", because a healthy
            gripper stops at the object that it holds.
        unit: Unit of a file that states none: ``deg``, ``rad``, or the path of a calibration file of LeRobot for positions from
            -100 to 100, which are then converted to degrees. Default: the unit remains unknown.
        episodes: Numbers of the episodes to read. Default: all.
        columns: YAML file with names and units of the columns of a log, see :meth:`holdfast.response.faults.Log.load`.

    Returns:
        The recording with its episodes as arrays in the unit of the file. Logs are in rad and m.

    Raises:
        InputError: The recording cannot be read; the message states the file, the problem, and the alternatives.
        HoldfastError: The format needs a package that is not installed.
    """
    recording = _read_path(Path(path), state, reference, episodes, columns)
    recording = _select_joints(recording, joints)
    if unit is not None:
        recording = _apply_unit(recording, unit)
    chosen = recording.episodes if episodes is None else [each for each in recording.episodes if each.index in episodes]
    if not chosen:
        raise InputError(f"'{path}' has none of the requested episodes; it has {len(recording.episodes)}, numbered from 0")
    return replace(recording, episodes=tuple(chosen))


def _read_path(
    path: Path, state: str | None, reference: str | None, episodes: Sequence[int] | None, columns: str | Path | None
) -> Recording:
    if not path_exists(path):
        raise InputError(f"'{path}' does not exist; give a data set, a bag, or a log")
    if path.is_dir():
        if (path / INFO_FILE).exists():
            return read_data_set(path, state, reference, episodes)
        if (path / BAG_INFO_FILE).exists():
            return read_bag(path, state, reference)
        return _read_folder(path, state, reference, columns)
    if path.suffix.lower() in _BAG_ENDINGS:
        return read_bag(path, state, reference)
    arrays = read_log_arrays(path, columns)
    episode = RecordedEpisode(index=0, t=arrays["t"], q=arrays["q"], q_ref=arrays["q_ref"], tau=arrays.get("tau"))
    return Recording(
        source=str(path),
        format=f"log ({path.suffix})",
        joints=tuple(f"joint_{number + 1}" for number in range(arrays["q"].shape[1])),
        unit="rad",
        fps=median_rate(arrays["t"]),
        episodes=(episode,),
    )


def _read_folder(folder: Path, state: str | None, reference: str | None, columns: str | Path | None) -> Recording:
    """Read all bags and logs of a folder as one recording."""
    content = sorted(folder.iterdir())
    items = [item for item in content if item.suffix.lower() in _LOG_ENDINGS + _BAG_ENDINGS or (item / BAG_INFO_FILE).exists()]
    if not items:
        names = list_names([item.name for item in content], 8) or "nothing"
        raise InputError(
            f"'{folder}' is a folder without {INFO_FILE} (LeRobot) or {BAG_INFO_FILE} (ROS 2 bag); it contains {names}; give "
            "the folder that has one of them, a folder of logs, or one file"
        )
    parts = [_read_path(item, state, reference, None, columns) for item in items]
    first = parts[0]
    for part in parts:
        if part.joints != first.joints or abs(part.fps / first.fps - 1) > _RATE_TOLERANCE:
            raise InputError(
                f"'{part.source}' has {len(part.joints)} joints at {part.fps:.4g} Hz and '{first.source}' has "
                f"{len(first.joints)} at {first.fps:.4g} Hz; give a folder with logs of one robot"
            )
    episodes = [episode for part in parts for episode in part.episodes]
    numbered = tuple(replace(episode, index=index) for index, episode in enumerate(episodes))
    return replace(first, source=str(folder), format=f"{len(items)} files, {first.format}", episodes=numbered)


def _select_joints(recording: Recording, joints: Sequence[str] | None) -> Recording:
    """Keep joints by name; by default, leave out grippers."""
    if joints is None:
        joints = [name for name in recording.joints if "gripper" not in name.lower()] or recording.joints
        if left_out := [name for name in recording.joints if name not in joints]:
            note = f"{list_names(left_out)} is left out, because a gripper stops at objects"
            recording = replace(recording, notes=(*recording.notes, note))
    if missing := [name for name in joints if name not in recording.joints]:
        names = list_names(list(recording.joints))
        raise InputError(f"'{recording.source}' has no joint '{missing[0]}'; its joints are {names}")
    order = [recording.joints.index(name) for name in joints]
    return replace(recording.change_arrays(("q", "q_ref", "tau"), lambda values: values[:, order]), joints=tuple(joints))


def _apply_unit(recording: Recording, unit: str | Path) -> Recording:
    """Set the unit of positions whose file does not state it; positions from -100 to 100 are converted to degrees."""
    if recording.unit is not None:
        if str(unit) != recording.unit:
            raise InputError(f"'{recording.source}' is in {recording.unit}, and unit is '{unit}'; leave it out")
        return recording
    if str(unit) in _KNOWN_UNITS:
        return replace(recording, unit=str(unit))
    scale = degrees_per_unit(Path(unit), recording.joints)
    return replace(recording.change_arrays(("q", "q_ref"), lambda values: values * scale), unit="deg")
