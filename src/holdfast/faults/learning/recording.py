"""Episodes of an environment as records in a folder, one after the other, and read back."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import InputError, StoreError
from holdfast.faults.events import FaultEvent, FaultEvents
from holdfast.faults.log import Log
from holdfast.files.output import guarded, made
from holdfast.provenance import versions

Array = NDArray[np.float64]

INDEX = "episodes.jsonl"


@dataclass(frozen=True)
class Episode:
    """One recorded episode.

    Attributes:
        file: ``000000.npz``, with the arrays of a :class:`holdfast.faults.Log` (``q_ref`` is NaN for joints that follow no
            reference), and ``action`` (T, ...) and ``reward`` (T,).
        seed: That the environment was reset with; None if it was not.
        episode: Of the fault model.
        events: Its faults.
        id: Their digest.
        feasible: Whether the goal was within reach, as :class:`holdfast.faults.Feasibility` has it.
        outcome: ``terminated``, ``truncated`` or ``left``: reset or closed before its end.
        versions: Of packages.
        success: Success at the end, by ``is_success`` or ``success`` in the last ``info``; None if the environment has neither.
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
        """Its record.

        Raises:
            InputError: It cannot be read.
        """
        return Log.load(self.file)


def recorded(folder: str | Path) -> tuple[Episode, ...]:
    """The episodes that a :class:`holdfast.faults.FaultWrapper` recorded in a folder, in order.

    Raises:
        InputError: There are none, or a line cannot be read.
    """
    path = Path(folder) / INDEX
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise InputError(f"'{folder}' has no {INDEX}; give a folder that an environment recorded into") from error
    found = []
    for number, line in enumerate(lines, start=1):
        try:
            data = json.loads(line)
            events = FaultEvents(FaultEvent.from_stored(event) for event in data.pop("events"))
            found.append(Episode(file=path.parent / data.pop("file"), events=events, **data))
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise InputError(f"line {number} of '{path}' is not an episode; remove it if it was cut off") from error
    return tuple(found)


class Recorder:
    """Writes episodes into a folder; what is there already stays.

    Args:
        folder: Made if it is not there.

    Raises:
        StoreError: It cannot be made or read.
    """

    def __init__(self, folder: str | Path) -> None:
        self._folder = made(Path(folder))
        try:
            self._number = len(recorded(folder)) if (self._folder / INDEX).exists() else 0
        except InputError as error:
            raise StoreError(f"{error}, or record into another folder") from error
        self._rows: list[tuple[Any, ...]] = []

    def note(self, time: float, reference: Array, q: Array, torque: Array, action: Any, reward: float) -> None:
        """A step."""
        self._rows.append((time, reference, q, torque, np.array(action, dtype=np.float64), float(reward)))

    def finish(
        self, *, seed: int | None, episode: int, events: FaultEvents, feasible: str, outcome: str, success: bool | None = None
    ) -> None:
        """Write the episode, if it had two steps or more.

        Raises:
            StoreError: It cannot be written.
        """
        rows, self._rows = self._rows, []
        if len(rows) < 2:
            return
        t, reference, q, torque, action, reward = (np.array(part) for part in zip(*rows, strict=True))
        file = self._folder / f"{self._number:06}.npz"
        Log(t=t, q_ref=reference, q=q, tau=torque).save(file, action=action, reward=reward)
        entry = {
            "file": file.name,
            "seed": seed,
            "episode": episode,
            "events": [event.stored() for event in events],
            "id": events.id,
            "feasible": feasible,
            "outcome": outcome,
            "success": success,
            "versions": versions("holdfast", "numpy", "mujoco", "gymnasium"),
        }
        index = self._folder / INDEX
        with guarded(index, "episode"), index.open("a", encoding="utf-8") as lines:
            lines.write(json.dumps(entry) + "\n")
        self._number += 1
