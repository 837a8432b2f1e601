"""Write the episodes of an environment to a folder, and read them back."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.errors import InputError, StoreError
from holdfast.core.files.output import guard_writing, make_folder
from holdfast.core.provenance import versions
from holdfast.core.typing import FloatArray
from holdfast.response.faults.events import FaultEvent, FaultEvents
from holdfast.response.faults.log import Log

INDEX_FILE_NAME = "episodes.jsonl"


@dataclass(frozen=True)
class Episode:
    """Recorded episode.

    Attributes:
        file: ``000000.npz``, with the arrays of a :class:`holdfast.response.faults.Log` (``q_ref`` is NaN for joints that
            follow no reference), and ``action`` (T, ...) and ``reward`` (T,).
        seed: Seed of the environment's reset; None if it had none.
        episode: Index of the episode in the fault model.
        events: Faults of the episode.
        id: Digest of the faults.
        feasible: Feasibility of the goal, as in :class:`holdfast.response.faults.Feasibility`.
        outcome: ``terminated``, ``truncated`` or ``left`` (reset or closed before its end).
        versions: Versions of the packages.
        success: Success at the end, from ``is_success`` or ``success`` in the last ``info``; None if the environment has
            neither.
    """

    file: Path
    _: KW_ONLY
    seed: int | None
    episode: int
    events: FaultEvents
    id: str
    feasible: str
    outcome: str
    versions: Mapping[str, str]
    success: bool | None = None

    def log(self) -> Log:
        """Load the log of the episode.

        Raises:
            InputError: The file cannot be read.
        """
        return Log.load(self.file)


def read_episodes(folder: str | Path) -> tuple[Episode, ...]:
    """Read the episodes that a :class:`holdfast.response.faults.FaultWrapper` recorded in ``folder``, in order.

    Raises:
        InputError: The folder has no episodes, or a line cannot be read.
    """
    path = Path(folder) / INDEX_FILE_NAME
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise InputError(f"'{folder}' has no {INDEX_FILE_NAME}; give a folder into which an environment recorded") from error
    episodes = []
    for number, line in enumerate(lines, start=1):
        try:
            data = json.loads(line)
            events = FaultEvents(FaultEvent.from_stored(event) for event in data.pop("events"))
            episodes.append(Episode(file=path.parent / data.pop("file"), events=events, **data))
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise InputError(f"line {number} of '{path}' is not an episode; remove it if it was cut off") from error
    return tuple(episodes)


class EpisodeRecorder:
    """Writer of episodes into a folder; existing episodes stay.

    Args:
        folder: Output folder, created if necessary.

    Raises:
        StoreError: The folder cannot be created or read.
    """

    def __init__(self, folder: str | Path) -> None:
        self._folder = make_folder(Path(folder))
        try:
            self._next_number = len(read_episodes(folder)) if (self._folder / INDEX_FILE_NAME).exists() else 0
        except InputError as error:
            raise StoreError(f"{error}, or record into another folder") from error
        self._steps: list[tuple[Any, ...]] = []

    def record_step(
        self, time: float, reference: FloatArray, q: FloatArray, torque: FloatArray, action: Any, reward: float
    ) -> None:
        """Record a step."""
        self._steps.append((time, reference, q, torque, np.array(action, dtype=np.float64), float(reward)))

    def finish_episode(
        self, *, seed: int | None, episode: int, events: FaultEvents, feasible: str, outcome: str, success: bool | None = None
    ) -> None:
        """Write the episode, if it has two steps or more.

        Raises:
            StoreError: The file cannot be written.
        """
        steps, self._steps = self._steps, []
        if len(steps) < 2:
            return
        times, reference, q, torque, action, reward = (np.array(column) for column in zip(*steps, strict=True))
        file = self._folder / f"{self._next_number:06}.npz"
        Log(t=times, q_ref=reference, q=q, tau=torque).save(file, action=action, reward=reward)
        entry = {
            "file": file.name,
            "seed": seed,
            "episode": episode,
            "events": [event.to_stored() for event in events],
            "id": events.id,
            "feasible": feasible,
            "outcome": outcome,
            "success": success,
            "versions": versions("holdfast", "numpy", "mujoco", "gymnasium"),
        }
        index = self._folder / INDEX_FILE_NAME
        with guard_writing(index, "episode"), index.open("a", encoding="utf-8") as index_stream:
            index_stream.write(json.dumps(entry) + "\n")
        self._next_number += 1
