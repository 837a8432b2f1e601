"""Episodes of joint positions and references, as data sets, bags, and logs contain them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.formatting import format_count
from holdfast.core.typing import FloatArray

Clock = Literal["measured", "computed"]


@dataclass(frozen=True, eq=False, kw_only=True)
class RecordedEpisode:
    """One recorded run of T frames of n joints, in the unit of its recording.

    Attributes:
        index: Number of the episode in its recording, from 0.
        t: (T,) times, s.
        q: (T, n) measured joint positions.
        q_ref: (T, n) references of the servos. None: not recorded.
        tau: (T, n) torques, in the unit of the file. None: not recorded.
        clock: ``computed`` if the times are frame number / frame rate, so that late and lost frames do not show in them.
    """

    index: int
    t: FloatArray
    q: FloatArray
    q_ref: FloatArray | None = None
    tau: FloatArray | None = None
    clock: Clock = "measured"

    def __post_init__(self) -> None:
        if self.q.ndim != 2 or self.t.shape != self.q.shape[:1] or not self.q.size:
            raise InputError(
                f"episode {self.index} has positions of shape {self.q.shape} and times of shape {self.t.shape}; it must have a "
                "row of positions for each time"
            )
        for name, values in (("q_ref", self.q_ref), ("tau", self.tau)):
            if values is not None and values.shape != self.q.shape:
                raise InputError(f"{name} of episode {self.index} has shape {values.shape}; it must be {self.q.shape}")


@dataclass(frozen=True, eq=False, kw_only=True)
class Recording:
    """Recording of one robot, from :func:`holdfast.response.diagnosis.read_recording`.

    Attributes:
        source: Path of the file or folder.
        format: Format of the recording, for example ``LeRobot v3.0``.
        robot: Name of the robot in the file; empty if the file contains none.
        joints: Names of the n joints.
        unit: Unit of positions and references (``rad`` or ``deg``; ``rad`` includes m for prismatic joints). None: the file
            does not state it.
        fps: Frames per second.
        episodes: Recorded episodes, in order.
        notes: Sentences on signals that could not be used, and on assumptions.
    """

    source: str
    format: str
    robot: str = ""
    joints: tuple[str, ...]
    unit: str | None
    fps: float
    episodes: tuple[RecordedEpisode, ...]
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if not self.fps > 0:
            raise InputError(f"'{self.source}' has no two frames between which the time increases; check its times")

    @property
    def title(self) -> str:
        """Robot, format, and size of the recording, in one line."""
        is_computed = any(episode.clock == "computed" for episode in self.episodes)
        counts = [format_count(len(self.episodes), "episode"), format_count(len(self.joints), "joint")]
        parts = [self.robot, self.format, *counts]
        rate = f"{self.fps:.4g} frames per second" + " (times computed from the frame number)" * is_computed
        return ", ".join([*filter(None, parts), rate])

    def change_arrays(self, names: Sequence[str], change: Callable[[FloatArray], FloatArray]) -> Recording:
        """Return the recording with changed arrays (``q``, ``q_ref``, ``tau``) of all episodes; ``names`` selects them."""
        episodes = []
        for episode in self.episodes:
            arrays = {name: getattr(episode, name) for name in names}
            changed: dict[str, Any] = {name: change(values) for name, values in arrays.items() if values is not None}
            episodes.append(replace(episode, **changed))
        return replace(self, episodes=tuple(episodes))


def median_rate(t: FloatArray) -> float:
    """Return the frames per second of times (T,) in s: the reciprocal of the median step; NaN for fewer than two times."""
    steps = np.diff(t)
    steps = steps[steps > 0]
    return float(1 / np.median(steps)) if steps.size else float("nan")
