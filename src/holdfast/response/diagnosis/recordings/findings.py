"""Conspicuous facts of episodes that need no calibration; they have no rate of false alarms and raise no alarm."""

from __future__ import annotations

from collections.abc import Iterator

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
    """Return sentences for each episode, by its number; with an ``arm`` and a known unit, also on limits."""
    references = [episode.q_ref for episode in recording.episodes if episode.q_ref is not None]
    ranges = _range(np.concatenate(references)) if references else np.zeros(len(recording.joints))
    starts = np.array([episode.q[0] for episode in recording.episodes])
    deviations = starts - np.median(starts, axis=0)
    limits = _START_DEVIATIONS * np.median(np.abs(deviations), axis=0)
    findings, first_index_by_content = {}, dict[bytes, int]()
    for episode, deviation in zip(recording.episodes, deviations, strict=True):
        sentences = [*_check_samples(episode), *_check_motion(recording, episode, ranges)]
        if arm is not None and recording.unit is not None:
            sentences += _check_limits(episode, arm, recording.fps, 1.0 if recording.unit == "rad" else np.pi / 180)
        first = first_index_by_content.setdefault(episode.q.tobytes(), episode.index)
        sentences += [f"it equals episode {first}"] if first != episode.index else []
        sentences += [
            f"{recording.joints[joint]} starts {deviation[joint]:+.3g} from the median of the recording"
            for joint in np.flatnonzero((np.abs(deviation) > limits) & (limits > 0))
        ]
        findings[episode.index] = tuple(sentences)
    return findings


def _range(values: FloatArray) -> FloatArray:
    """Return the range (n,) of values (T, n) without NaN; 0 if all are NaN."""
    return np.asarray(np.nan_to_num(np.fmax.reduce(values) - np.fmin.reduce(values)))


def _check_samples(episode: RecordedEpisode) -> Iterator[str]:
    for name, values in (("position", episode.q), ("reference", episode.q_ref)):
        if values is not None and (count := int((~np.isfinite(values)).any(axis=1).sum())):
            yield f"the {name} has no finite number in {count} of {len(values)} frames"
    steps = np.diff(episode.t)
    if count := int((~(steps > 0)).sum()):
        yield f"the time does not increase at {count} of {len(episode.t)} frames"
    elif episode.clock == "measured" and len(steps) and steps.max() > _GAP_FACTOR * np.median(steps):
        yield f"{steps.max():.3g} s without a frame at {episode.t[steps.argmax()] - episode.t[0]:.3g} s"


def _check_motion(recording: Recording, episode: RecordedEpisode, ranges: FloatArray) -> Iterator[str]:
    """Yield the joints that are constant while their references move, and repetitions of all positions."""
    reference, q = episode.q_ref, episode.q
    if reference is None:
        return
    asked = _range(reference)
    for joint in np.flatnonzero((np.fmax.reduce(q) == np.fmin.reduce(q)) & (asked > _CONSTANT_FRACTION * ranges)):
        yield f"{recording.joints[joint]} is constant while its reference moves by {asked[joint]:.3g}"
    repeats = np.concatenate([[False], (np.diff(q, axis=0) == 0).all(axis=1), [False]])
    edges = np.flatnonzero(np.diff(repeats.astype(int)))
    runs = [
        (first, last)
        for first, last in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True)
        if last - first >= _MIN_REPEATED_FRAMES and (_range(reference[first : last + 1]) > _MOVING_FRACTION * ranges).any()
    ]
    if runs:
        first, last = max(runs, key=lambda run: run[1] - run[0])
        start = episode.t[first] - episode.t[0]
        times = format_count(len(runs), "time")
        yield f"all positions repeat while a reference moves ({times}; the longest is {last - first} frames at {start:.3g} s)"


def _check_limits(episode: RecordedEpisode, arm: Arm, fps: float, to_rad: float) -> Iterator[str]:
    speeds = np.abs(np.diff(episode.q, axis=0)) * to_rad * fps
    for joint, values, speed in zip(arm.joints, episode.q.T * to_rad, speeds.T, strict=True):
        excess = max(joint.lower - np.fmin.reduce(values), np.fmax.reduce(values) - joint.upper)
        if excess > _LIMIT_TOLERANCE_RAD:
            yield f"{joint.name} is up to {excess / to_rad:.3g} beyond its limit"
        if count := int(((speed[:-1] > joint.velocity) & (speed[1:] > joint.velocity)).sum()):
            yield f"{joint.name} leaps and returns faster than its speed limit ({format_count(count, 'time')})"
