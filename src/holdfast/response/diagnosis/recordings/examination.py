"""Examine the episodes of a recording for joint faults, with a stated rate of false alarms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.model import Arm
from holdfast.response.diagnosis.recordings.findings import find_conspicuous
from holdfast.response.diagnosis.recordings.following import FollowingModel, Frames
from holdfast.response.diagnosis.recordings.naming import Alarm
from holdfast.response.diagnosis.recordings.recording import RecordedEpisode, Recording

MIN_HEALTHY_EPISODES = 20
CONFIDENCE = 0.95
HELD_ERROR_S = 0.5
_EXAMINED_FPS = 30.0
_MAX_FPS = 60.0  # faster recordings are reduced to about 30 frames per second
_MIN_SPREAD = 0.3  # of the logarithm of a statistic
_MIN_MOTION_DEG = 5.0  # of a reference: below, nothing can be said of its joint
_LARGEST_ANGLE_RAD = 2 * np.pi  # positions beyond it are not in rad
_SECONDS_PER_HOUR = 3600.0
_EULER = 0.5772156649015329

Role = Literal["fit", "threshold", "examined"]


@dataclass(frozen=True)
class StatedRate:
    """Rate of false alarms that the calibration supports.

    Attributes:
        kind: ``conformal`` (guaranteed if the healthy episodes are exchangeable) or ``extrapolated`` from a Gumbel law.
        per_episode: Probability that a further healthy episode alarms, on average over calibrations.
        limit: Probability below which the rate of this calibration is with 95 % confidence. None: extrapolated.
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


@dataclass(frozen=True, eq=False, kw_only=True)
class ExaminedEpisode:
    """Result for one episode.

    Attributes:
        index: Number of the episode in the recording.
        role: ``fit`` or ``threshold`` for healthy episodes, else ``examined``; only examined episodes can alarm.
        alarm: Time of the alarm, s from the first frame. None: no alarm.
        joint: Name of the joint. None: no alarm, or it concerns the whole arm.
        kind: Kind of the fault; None without an alarm.
        candidates: All causes that the frames do not exclude.
        score: Largest score; it is above the threshold if there is an alarm. NaN: not computed.
        unheard: Joints whose reference moved by less than 5 deg, so that nothing can be said of them.
        findings: Conspicuous facts that need no calibration.
        held_error: Largest distance of a position from its reference that was held for 0.5 s, in the unit of the recording;
            NaN without references.
        held_error_joint: Joint of this error.
    """

    index: int
    role: Role
    alarm: float | None = None
    joint: str | None = None
    kind: str | None = None
    candidates: tuple[str, ...] = ()
    score: float = float("nan")
    unheard: tuple[str, ...] = ()
    findings: tuple[str, ...] = ()
    held_error: float = float("nan")
    held_error_joint: str | None = None


@dataclass(frozen=True, eq=False)
class Calibration:
    """Healthy behaviour of a robot: the model of its joints, the distribution of each statistic, and the threshold.

    Attributes:
        model: Model of the joints.
        level: Means of the logarithm of the largest value in an episode: of joints (7, n) and of the arm (2,).
        spread: Standard deviations of this logarithm: of joints (7,), pooled over the joints, and of the arm (2,).
        threshold: Score above which an episode alarms.
    """

    model: FollowingModel
    level: tuple[FloatArray, FloatArray]
    spread: tuple[FloatArray, FloatArray]
    threshold: float

    def score(self, frames: Frames) -> tuple[FloatArray, FloatArray]:
        """Return the scores of joints (T, 7, n) and of the arm (T, 2) in each frame of an episode."""
        logarithms = _logarithms(self.model, frames)
        joint_scores = (logarithms[0] - self.level[0]) / self.spread[0][:, None]
        return joint_scores, (logarithms[1] - self.level[1]) / self.spread[1]


@dataclass(frozen=True, eq=False, kw_only=True)
class Examination(Result):
    """Result of :func:`holdfast.response.diagnosis.examine`.

    Attributes:
        recording: Examined recording.
        arm: Arm of the recording. None: not given.
        calibration: Healthy behaviour. None: no test was possible.
        false_alarms: Stated rate of false alarms. None: no test was possible.
        inconclusive: Reason why no test was possible; empty otherwise.
        episodes: Result for every episode, in the order of the recording.
    """

    recording: Recording
    arm: Arm | None
    calibration: Calibration | None
    false_alarms: StatedRate | None
    inconclusive: str
    episodes: tuple[ExaminedEpisode, ...]

    @cached_property
    def alarms(self) -> tuple[ExaminedEpisode, ...]:
        """Episodes with an alarm."""
        return tuple(episode for episode in self.episodes if episode.alarm is not None)

    def signals(self, index: int) -> tuple[FloatArray, Frames, FloatArray]:
        """Return times (T,), frames, and healthy positions (T, n) of an episode, as they were examined.

        Raises:
            InputError: The recording has no such episode, or nothing was calibrated.
        """
        for episode in self.recording.episodes:
            if episode.index == index and self.calibration is not None:
                frames = _frames(self.recording, episode)
                times = episode.t[:: _stride(self.recording.fps)]
                return times - times[0], frames, self.calibration.model.predict(frames.reference)
        raise InputError(f"there are no examined signals of episode {index}")


@check_arguments
def examine(recording: Recording, *, healthy: Sequence[int], arm: Arm | None = None, rate: float | None = None) -> Examination:
    """Compare the episodes of a recording with healthy ones of the same robot and kind of task.

    Half of the healthy episodes fit a model of each joint, and the other half set the threshold. If healthy episodes are
    exchangeable, one of m + 1 further ones alarms on average, where m episodes set the threshold.

    Args:
        recording: Recording with references, for example at 10 to 50 frames per second.
        healthy: Numbers of the healthy episodes, at least 20.
        arm: Arm with the joints of the recording in order. It is needed to name a fall and to check limits, and requires that
            the unit is known.
        rate: False alarms per hour; a threshold for a lower rate than the guaranteed one is extrapolated. Default: the
            guaranteed rate.

    Returns:
        The alarms with joints and kinds, the stated rate, and what could not be tested.

    Raises:
        InputError: A healthy episode is not in the recording, the arm has other joints, a unit is missing, or an episode has
            no finite number.
    """
    roles = _assign_roles(recording, healthy)
    if rate is not None and not rate > 0:
        raise InputError(f"rate is {rate:g}; it must be above 0 false alarms per hour")
    if arm is not None and arm.n != len(recording.joints):
        raise InputError(
            f"arm '{arm.name}' has {arm.n} joints and the recording {len(recording.joints)}; name those of the arm, in order"
        )
    if arm is not None and recording.unit is None:
        raise InputError("the unit of the recording is unknown, so it cannot be compared with an arm; give the unit")
    findings = find_conspicuous(recording, arm)
    has_reference = all(episode.q_ref is not None for episode in recording.episodes)
    if not has_reference:
        inconclusive = "the recording has no reference, so only facts that need none are listed"
    elif len(healthy) < MIN_HEALTHY_EPISODES:
        inconclusive = (
            f"there are {len(healthy)} healthy episodes; {MIN_HEALTHY_EPISODES} are needed to state a rate (half fit, half set "
            "the threshold), so only facts that need no rate are listed"
        )
    else:
        inconclusive = ""
    calibration = stated = None
    if not inconclusive:
        calibration, stated = _calibrate(recording, roles, rate)
    examined = []
    for episode in recording.episodes:
        result = ExaminedEpisode(index=episode.index, role=roles[episode.index], findings=findings[episode.index])
        if episode.q_ref is not None:
            result = _measure_error(recording, episode, result)
        if calibration is not None:
            result = _examine_episode(recording, episode, result, calibration, arm)
        examined.append(result)
    return Examination(
        recording=recording,
        arm=arm,
        calibration=calibration,
        false_alarms=stated,
        inconclusive=inconclusive,
        episodes=tuple(examined),
    )


def _assign_roles(recording: Recording, healthy: Sequence[int]) -> dict[int, Role]:
    """Return the role of each episode; healthy ones alternate between fit and threshold."""
    roles: dict[int, Role] = {episode.index: "examined" for episode in recording.episodes}
    for position, index in enumerate(dict.fromkeys(healthy)):
        if index not in roles:
            raise InputError(f"healthy episode {index} is not in the recording; it has episodes {min(roles)} to {max(roles)}")
        roles[index] = "threshold" if position % 2 else "fit"
    return roles


# ---- calibration -------------------------------------------------------------------------------------------------


def _calibrate(recording: Recording, roles: dict[int, Role], rate: float | None) -> tuple[Calibration, StatedRate]:
    """Return the healthy behaviour and the stated rate of false alarms."""
    fit, threshold_set = (
        [episode for episode in recording.episodes if roles[episode.index] == role] for role in ("fit", "threshold")
    )
    frames = [_frames(recording, episode) for episode in fit]
    model = FollowingModel.fit(frames, recording.fps / _stride(recording.fps), _degree(recording))
    peaks = [[part.max(axis=0) for part in _logarithms(model, each)] for each in frames]
    of_joints, of_arm = (np.array([peak[part] for peak in peaks]) for part in (0, 1))
    # One spread per statistic: a joint that no fitting episode disturbed would otherwise have a spread close to 0.
    spread = np.sqrt(of_joints.var(axis=0, ddof=1).mean(axis=1)), of_arm.std(axis=0, ddof=1)
    level, limited = (of_joints.mean(axis=0), of_arm.mean(axis=0)), tuple(np.maximum(part, _MIN_SPREAD) for part in spread)
    calibration = Calibration(model, level, (limited[0], limited[1]), np.inf)
    scores = np.array([_largest_score(calibration, _frames(recording, episode)) for episode in threshold_set])
    hours = sum(len(episode.t) for episode in threshold_set) / recording.fps / _SECONDS_PER_HOUR / len(scores)
    guaranteed = 1 / (len(scores) + 1)
    limit = 1 - (1 - CONFIDENCE) ** (1 / len(scores))
    counts = {"fit_count": len(fit), "threshold_count": len(scores)}
    wanted = guaranteed if rate is None else -np.expm1(-rate * hours)
    if wanted >= guaranteed:
        stated = StatedRate("conformal", guaranteed, float(limit), guaranteed / hours, **counts)
        return replace(calibration, threshold=float(scores.max())), stated
    width = scores.std(ddof=1) * np.sqrt(6) / np.pi
    threshold = scores.mean() - _EULER * width - width * np.log(-np.log1p(-wanted))
    stated = StatedRate("extrapolated", float(wanted), None, float(wanted / hours), **counts)
    return replace(calibration, threshold=float(threshold)), stated


def _logarithms(model: FollowingModel, frames: Frames) -> tuple[FloatArray, FloatArray]:
    """Return the logarithms of the statistics; values below the resolution of the positions count as the resolution."""
    of_joints, of_arm = model.statistics(frames)
    return np.log(np.maximum(of_joints, model.ticks)), np.log(np.maximum(of_arm, model.ticks.sum()))


def _largest_score(calibration: Calibration, frames: Frames) -> float:
    return float(max(scores.max() for scores in calibration.score(frames)))


# ---- one episode -------------------------------------------------------------------------------------------------


def _stride(fps: float) -> int:
    return max(1, round(fps / _EXAMINED_FPS)) if fps > _MAX_FPS else 1


def _degree(recording: Recording) -> float:
    """Return one degree in the unit of the recording; if it is unknown, from the size of the positions."""
    is_large = max(float(np.nanmax(np.abs(episode.q))) for episode in recording.episodes) > _LARGEST_ANGLE_RAD
    return 1.0 if recording.unit == "deg" or (recording.unit is None and is_large) else np.pi / 180


def _frames(recording: Recording, episode: RecordedEpisode) -> Frames:
    """Return the frames that are examined; a value that is missing is the last one before it."""
    assert episode.q_ref is not None
    stride, filled = _stride(recording.fps), []
    for name, values in (("reference", episode.q_ref), ("position", episode.q)):
        is_finite = np.isfinite(values)
        if not is_finite.any(axis=0).all():
            raise InputError(f"the {name} of episode {episode.index} has no finite number; leave this episode out")
        rows = np.where(is_finite, np.arange(len(values))[:, None], 0)
        rows = np.maximum(np.maximum.accumulate(rows, axis=0), is_finite.argmax(axis=0))
        filled.append(np.take_along_axis(values, rows, axis=0)[::stride])
    return Frames(*filled)


def _measure_error(recording: Recording, episode: RecordedEpisode, result: ExaminedEpisode) -> ExaminedEpisode:
    """Add the largest error that was held for half a second, and the joints whose references hardly moved."""
    frames = _frames(recording, episode)
    moved = np.ptp(frames.reference, axis=0) >= _MIN_MOTION_DEG * _degree(recording)
    unheard = tuple(name for name, has_moved in zip(recording.joints, moved, strict=True) if not has_moved)
    window = max(1, round(HELD_ERROR_S * recording.fps / _stride(recording.fps)))
    error = np.abs(frames.position[1:] - frames.reference[:-1])
    if len(error) < window:
        return replace(result, unheard=unheard)
    held = np.lib.stride_tricks.sliding_window_view(error, window, axis=0).min(axis=-1).max(axis=0)
    joint = int(held.argmax())
    return replace(result, unheard=unheard, held_error=float(held[joint]), held_error_joint=recording.joints[joint])


def _examine_episode(
    recording: Recording, episode: RecordedEpisode, result: ExaminedEpisode, calibration: Calibration, arm: Arm | None
) -> ExaminedEpisode:
    """Add the score, and for an examined episode the first alarm with its joint and kind."""
    frames = _frames(recording, episode)
    joint_scores, arm_scores = calibration.score(frames)
    largest = np.maximum(joint_scores.max(axis=(1, 2)), arm_scores.max(axis=1))
    result = replace(result, score=float(largest.max()))
    alarmed: NDArray[np.intp] = np.flatnonzero(largest > calibration.threshold)
    if result.role != "examined" or not alarmed.size:
        return result
    frame, degree = int(alarmed[0]), calibration.model.degree
    joint = int(joint_scores[frame].max(axis=0).argmax())
    predicted = calibration.model.predict(frames.reference)
    kind, candidates = Alarm(
        frame,
        joint,
        frames.position[:, joint] / degree,
        predicted[:, joint] / degree,
        joint_scores,
        arm_scores,
        calibration.threshold,
        calibration.model.fps,
        float(calibration.model.ticks[joint] / degree),
        None if arm is None else partial(_weight, arm, np.radians(frames.position[frame - 1] / degree), joint),
    ).classify()
    time = float(episode.t[:: _stride(recording.fps)][frame] - episode.t[0])
    name = None if kind in ("stale", "dropped") else recording.joints[joint]
    return replace(result, alarm=time, joint=name, kind=kind, candidates=candidates)


def _weight(arm: Arm, q: FloatArray, joint: int) -> float:
    """Return the torque, N m, with which gravity pulls a joint at a configuration (n,) in rad."""
    return -float(arm.gravity_torque(q)[joint])
