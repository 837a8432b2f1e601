"""Conspicuous facts of episodes that need no calibration; they have no rate of false alarms and raise no alarm."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence

import numpy as np

from holdfast.core.formatting import format_count
from holdfast.core.typing import FloatArray
from holdfast.model.arm.model import Arm
from holdfast.response.diagnosis.recordings.recording import RecordedEpisode, Recording

_MIN_REPEATED_FRAMES = 3
_CONSTANT_FRACTION = 0.05  # of the range of a reference in the recording
_MOVING_FRACTION = 0.01
_GAP_FACTOR = 3.0  # of the median step
_START_DEVIATIONS = 6.0  # median absolute deviations
_LIMIT_TOLERANCE_RAD = 0.01


def find_conspicuous(recording: Recording, arm: Arm | None) -> dict[int, tuple[str, ...]]:
    """Return sentences for each episode, by its number.

    Args:
        recording: Recording with references or without.
        arm: Arm with the joints of the recording, for limits of position and speed; used if the recording has a unit.
    """
    findings: dict[int, list[str]] = {episode.index: [] for episode in recording.episodes}
    ranges = _reference_ranges(recording)
    for episode in recording.episodes:
        add = findings[episode.index].append
        signals = [("position", episode.q), *([("reference", episode.q_ref)] if episode.q_ref is not None else [])]
        for name, values in signals:
            if count := int((~np.isfinite(values)).any(axis=1).sum()):
                add(f"the {name} has no finite number in {count} of {len(values)} frames")
        steps = np.diff(episode.t)
        if count := int((~(steps > 0)).sum()):
            add(f"the time does not increase at {count} of {len(episode.t)} frames")
        elif episode.clock == "measured" and len(steps) and steps.max() > _GAP_FACTOR * np.median(steps):
            row = int(steps.argmax())
            add(f"{steps[row]:.3g} s without a frame at {episode.t[row] - episode.t[0]:.3g} s")
        if episode.q_ref is not None:
            _add_standstills(episode, recording.joints, ranges, add)
        if arm is not None and recording.unit is not None:
            _add_limits(episode, arm, 1.0 if recording.unit == "rad" else np.pi / 180, add)
    _add_equal_episodes(recording, findings)
    _add_start_positions(recording, findings)
    return {index: tuple(sentences) for index, sentences in findings.items()}


def _reference_ranges(recording: Recording) -> FloatArray:
    references = [episode.q_ref for episode in recording.episodes if episode.q_ref is not None]
    if not references:
        return np.zeros(len(recording.joints))
    return np.asarray(np.nan_to_num(np.fmax.reduce(np.concatenate(references)) - np.fmin.reduce(np.concatenate(references))))


def _add_standstills(episode: RecordedEpisode, joints: Sequence[str], ranges: FloatArray, add: Callable[[str], None]) -> None:
    assert episode.q_ref is not None
    reference, q = episode.q_ref, episode.q
    asked = np.nan_to_num(np.fmax.reduce(reference) - np.fmin.reduce(reference))
    for joint in np.flatnonzero((np.fmax.reduce(q) == np.fmin.reduce(q)) & (asked > _CONSTANT_FRACTION * ranges)):
        add(f"{joints[joint]} is constant while its reference moves by {asked[joint]:.3g}")
    repeats = np.concatenate([[False], (np.diff(q, axis=0) == 0).all(axis=1), [False]])
    edges = np.flatnonzero(np.diff(repeats.astype(int)))
    runs = [(first, last) for first, last in zip(edges[::2], edges[1::2], strict=True) if last - first >= _MIN_REPEATED_FRAMES]
    moving = [run for run in runs if (np.ptp(reference[run[0] : run[1] + 1], axis=0) > _MOVING_FRACTION * ranges).any()]
    if moving:
        first, last = max(moving, key=lambda run: run[1] - run[0])
        add(
            f"all positions repeat while a reference moves ({format_count(len(moving), 'time')}; the longest is {last - first} "
            f"frames at {episode.t[first] - episode.t[0]:.3g} s)"
        )


def _add_limits(episode: RecordedEpisode, arm: Arm, to_rad: float, add: Callable[[str], None]) -> None:
    speeds = np.abs(np.diff(episode.q, axis=0)) / np.maximum(np.median(np.diff(episode.t)), 1e-9) * to_rad
    for joint, values, speed in zip(arm.joints, episode.q.T * to_rad, speeds.T, strict=True):
        excess = max(joint.lower - np.fmin.reduce(values), np.fmax.reduce(values) - joint.upper)
        if excess > _LIMIT_TOLERANCE_RAD:
            add(f"{joint.name} is up to {excess / to_rad:.3g} beyond its limit")
        is_pulse = (speed[:-1] > joint.velocity) & (speed[1:] > joint.velocity) if len(speed) > 1 else np.zeros(0, dtype=bool)
        if is_pulse.any():
            add(f"{joint.name} leaps and returns faster than its speed limit ({format_count(int(is_pulse.sum()), 'time')})")


def _add_equal_episodes(recording: Recording, findings: dict[int, list[str]]) -> None:
    same: dict[bytes, list[int]] = defaultdict(list)
    for episode in recording.episodes:
        same[episode.q.tobytes()].append(episode.index)
    for first, *others in same.values():
        for index in others:
            findings[index].append(f"it equals episode {first}")


def _add_start_positions(recording: Recording, findings: dict[int, list[str]]) -> None:
    starts = np.array([episode.q[0] for episode in recording.episodes])
    if len(starts) < 5:
        return
    middle = np.nanmedian(starts, axis=0)
    deviation = np.nanmedian(np.abs(starts - middle), axis=0)
    for episode, start in zip(recording.episodes, starts, strict=True):
        for joint in np.flatnonzero(np.abs(start - middle) > _START_DEVIATIONS * deviation):
            if deviation[joint] > 0:
                findings[episode.index].append(
                    f"{recording.joints[joint]} starts {start[joint] - middle[joint]:+.3g} from the median of the recording"
                )
