"""Examine the episodes of a recording for joint faults, with a stated rate of false alarms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.model import Arm
from holdfast.response.diagnosis.recordings.findings import find_conspicuous
from holdfast.response.diagnosis.recordings.following import Frames, HealthyBehaviour
from holdfast.response.diagnosis.recordings.naming import name_fault
from holdfast.response.diagnosis.recordings.recording import RecordedEpisode, Recording

_MIN_HEALTHY_EPISODES = 20
_CONFIDENCE_LEVEL = 0.95
_HELD_ERROR_S = 0.5
_EXAMINED_FPS = 30.0
_MAX_FPS = 60.0  # faster recordings are reduced to about 30 frames per second
_MAX_LENGTH_RATIO = 1.1  # of an episode to the longest healthy one
_MIN_MOTION_DEG = 5.0  # of a reference: below, nothing can be said of its joint
_EULER_GAMMA = 0.5772156649015329


@dataclass(frozen=True, kw_only=True)
class StatedRate:
    """Rate of false alarms that the calibration supports.

    Attributes:
        kind: ``conformal`` (guaranteed if the healthy episodes are exchangeable) or ``extrapolated`` from a Gumbel law.
        per_episode: Probability that a further healthy episode alarms, on average over calibrations.
        limit: Probability below which that of this calibration is with 95 % confidence. None: extrapolated.
        per_hour: False alarms per hour of healthy motion.
        fit_count: Number of healthy episodes that fit the model.
        threshold_count: Number of healthy episodes that set the threshold.
    """

    kind: Literal["conformal", "extrapolated"]
    per_episode: float
    limit: float | None
    per_hour: float
    fit_count: int
    threshold_count: int


@dataclass(frozen=True, kw_only=True)
class ExaminedEpisode:
    """Result for one episode.

    Attributes:
        index: Number of the episode in the recording.
        role: ``fit`` or ``threshold`` for healthy episodes, else ``examined``; only examined episodes can alarm.
        alarm: Time of the alarm, s from the first frame. None: no alarm.
        joint: Name of the joint. None: no alarm, or it concerns the whole arm.
        kind: Kind of the fault; None without an alarm.
        candidates: All causes that the frames do not exclude.
        score: Largest score; above the threshold if there is an alarm. None: not computed.
        unheard: Joints whose reference moved by less than 5 deg, so that nothing can be said of them.
        findings: Conspicuous facts that need no calibration.
        held_error: Largest distance of a joint from its reference that was held for 0.5 s, in the unit of the recording. None:
            there are no references.
    """

    index: int
    role: str
    findings: tuple[str, ...]
    alarm: float | None = None
    joint: str | None = None
    kind: str | None = None
    candidates: tuple[str, ...] = ()
    score: float | None = None
    unheard: tuple[str, ...] = ()
    held_error: float | None = None


@dataclass(frozen=True, eq=False, kw_only=True)
class Examination(Result):
    """Result of :func:`holdfast.response.diagnosis.examine`.

    Attributes:
        recording: Examined recording.
        arm: Arm of the recording. None: not given.
        healthy: Healthy behaviour. None: no test was possible.
        threshold: Score above which an episode alarms.
        false_alarms: Stated rate of false alarms. None: no test was possible.
        inconclusive: Reason why no test was possible; empty otherwise.
        episodes: Result for every episode, in the order of the recording.
    """

    recording: Recording
    arm: Arm | None
    healthy: HealthyBehaviour | None
    threshold: float
    false_alarms: StatedRate | None
    inconclusive: str
    episodes: tuple[ExaminedEpisode, ...]

    @property
    def alarms(self) -> tuple[ExaminedEpisode, ...]:
        """Episodes with an alarm."""
        return tuple(episode for episode in self.episodes if episode.alarm is not None)


@check_arguments
def examine(recording: Recording, *, healthy: Sequence[int], arm: Arm | None = None, rate: float | None = None) -> Examination:
    """Compare the episodes of a recording with healthy ones of the same robot and kind of task.

    Half of the healthy episodes fit a model of each joint, and the other half set the threshold. If healthy episodes are
    exchangeable, one of m + 1 further ones alarms on average, where m episodes set the threshold.

    Args:
        recording: Recording with references, for example at 10 to 50 frames per second.
        healthy: Numbers of the healthy episodes, at least 20.
        arm: Arm with the joints of the recording in order, to name a fall and to check limits; needs a known unit.
        rate: False alarms per hour; the threshold for a lower rate than the guaranteed one is extrapolated. Default: the
            guaranteed rate.

    Returns:
        The alarms with joints and kinds, the stated rate, and what could not be tested.

    Raises:
        InputError: A healthy episode is not in the recording, the arm has other joints, a unit is missing, or an episode has
            no finite number.
    """
    if rate is not None and not rate > 0:
        raise InputError(f"rate is {rate:g}; it must be above 0 false alarms per hour")
    if arm is not None and arm.n != len(recording.joints):
        raise InputError(
            f"arm '{arm.name}' has {arm.n} joints and the recording {len(recording.joints)}; name those of the arm, in order"
        )
    if arm is not None and recording.unit is None:
        raise InputError("the unit of the recording is unknown, so it cannot be compared with an arm; give the unit")
    roles = {episode.index: "examined" for episode in recording.episodes}
    for position, index in enumerate(dict.fromkeys(healthy)):
        if index not in roles:
            raise InputError(f"healthy episode {index} is not in the recording; it has episodes {min(roles)} to {max(roles)}")
        roles[index] = "threshold" if position % 2 else "fit"
    inconclusive, behaviour, threshold, stated = "", None, np.inf, None
    if any(episode.q_ref is None for episode in recording.episodes):
        inconclusive = "the recording has no reference, so only facts that need none are listed"
    elif len(healthy) < _MIN_HEALTHY_EPISODES:
        inconclusive = (
            f"there are {len(healthy)} healthy episodes; {_MIN_HEALTHY_EPISODES} are needed to state a rate (half fit, half "
            "set the threshold), so only facts that need no rate are listed"
        )
    else:
        behaviour, threshold, stated = _calibrate(recording, roles, rate)
    findings, results = find_conspicuous(recording, arm), []
    longest = max((len(each.t) for each in recording.episodes if roles[each.index] != "examined"), default=0)
    for episode in recording.episodes:
        if behaviour is not None and len(episode.t) > _MAX_LENGTH_RATIO * longest:
            findings[episode.index] += ("it is longer than every healthy episode, so the stated rate does not hold for it",)
        known: dict[str, Any] = {} if episode.q_ref is None else _measure_motion(recording, episode)
        if behaviour is not None:
            scores = behaviour.score(examined_frames(recording, episode))
            known["score"] = float(scores.max())
            if roles[episode.index] == "examined" and known["score"] > threshold:
                known |= _describe_alarm(recording, episode, behaviour, scores, threshold, arm)
        results.append(
            ExaminedEpisode(index=episode.index, role=roles[episode.index], findings=findings[episode.index], **known)
        )
    return Examination(
        recording=recording,
        arm=arm,
        healthy=behaviour,
        threshold=threshold,
        false_alarms=stated,
        inconclusive=inconclusive,
        episodes=tuple(results),
    )


def examined_frames(recording: Recording, episode: RecordedEpisode) -> Frames:
    """Return the frames of an episode that are examined; a value that is missing is the last one before it.

    Raises:
        InputError: A signal has no finite number.
    """
    filled = []
    for name, values in (("reference", episode.q_ref), ("position", episode.q)):
        is_finite = np.isfinite(values) if values is not None else np.zeros((1, 1), dtype=bool)
        if values is None or not is_finite.any(axis=0).all():
            raise InputError(f"the {name} of episode {episode.index} has no finite number; leave this episode out")
        rows = np.maximum.accumulate(np.where(is_finite, np.arange(len(values))[:, None], is_finite.argmax(axis=0)), axis=0)
        filled.append(np.take_along_axis(values, rows, axis=0)[:: frame_stride(recording.fps)])
    return Frames(*filled)


def frame_stride(fps: float) -> int:
    """Return the number of recorded frames per examined frame."""
    return max(1, round(fps / _EXAMINED_FPS)) if fps > _MAX_FPS else 1


def _degree(recording: Recording) -> float:
    """Return one degree in the unit of the recording; if it is unknown, positions beyond a full turn cannot be in rad."""
    is_large = max(float(np.nanmax(np.abs(episode.q), initial=0.0)) for episode in recording.episodes) > 2 * np.pi
    return 1.0 if recording.unit == "deg" or (recording.unit is None and is_large) else np.pi / 180


def _calibrate(recording: Recording, roles: dict[int, str], rate: float | None) -> tuple[HealthyBehaviour, float, StatedRate]:
    """Return the healthy behaviour, the threshold of the scores, and the stated rate of false alarms."""
    fit, others = (
        [examined_frames(recording, episode) for episode in recording.episodes if roles[episode.index] == role]
        for role in ("fit", "threshold")
    )
    fps = recording.fps / frame_stride(recording.fps)
    behaviour = HealthyBehaviour.fit(fit, fps, _degree(recording))
    scores = np.array([behaviour.score(frames).max() for frames in others])
    hours = sum(len(frames.position) for frames in others) / fps / 3600 / len(others)
    guaranteed, limit = 1 / (len(others) + 1), 1 - (1 - _CONFIDENCE_LEVEL) ** (1 / len(others))
    wanted = guaranteed if rate is None else float(-np.expm1(-rate * hours))
    is_guaranteed = wanted >= guaranteed
    scale = scores.std(ddof=1) * np.sqrt(6) / np.pi  # of a Gumbel law with the mean and variance of the scores
    threshold = scores.max() if is_guaranteed else scores.mean() - scale * (_EULER_GAMMA + np.log(-np.log1p(-wanted)))
    stated = StatedRate(
        kind="conformal" if is_guaranteed else "extrapolated",
        per_episode=min(wanted, guaranteed),
        limit=limit if is_guaranteed else None,
        per_hour=min(wanted, guaranteed) / hours,
        fit_count=len(fit),
        threshold_count=len(others),
    )
    return behaviour, float(threshold), stated


def _measure_motion(recording: Recording, episode: RecordedEpisode) -> dict[str, Any]:
    """Return the largest error that was held for half a second, and the joints whose references hardly moved."""
    frames = examined_frames(recording, episode)
    moves = np.ptp(frames.reference, axis=0) >= _MIN_MOTION_DEG * _degree(recording)
    unheard = tuple(name for name, has_moved in zip(recording.joints, moves, strict=True) if not has_moved)
    error = np.abs(frames.position - np.concatenate([frames.reference[:1], frames.reference[:-1]]))
    window = min(max(1, round(_HELD_ERROR_S * recording.fps / frame_stride(recording.fps))), len(error))
    held = np.lib.stride_tricks.sliding_window_view(error, window, axis=0).min(axis=-1)
    return {"unheard": unheard, "held_error": float(held.max())}


def _describe_alarm(
    recording: Recording,
    episode: RecordedEpisode,
    behaviour: HealthyBehaviour,
    scores: FloatArray,
    threshold: float,
    arm: Arm | None,
) -> dict[str, Any]:
    """Return time, joint, kind, and possible causes of the first alarm of an episode with these scores (T, 9, n)."""
    frames = examined_frames(recording, episode)
    frame = int(np.flatnonzero(scores.max(axis=(1, 2)) > threshold)[0])
    weight: FloatArray | None = None
    if arm is not None:
        weight = -arm.gravity_torque(np.radians(frames.position[frame - 1] / behaviour.degree))
    joint, kind, candidates = name_fault(behaviour, frames, scores, frame=frame, threshold=threshold, weight=weight)
    time = float(episode.t[frame * frame_stride(recording.fps)] - episode.t[0])
    name = None if kind in ("stale", "dropped") else recording.joints[joint]
    return {"alarm": time, "joint": name, "kind": kind, "candidates": candidates}
