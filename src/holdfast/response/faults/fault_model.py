"""Fault model: entries and a seed, from which episodes are sampled identically on every machine, with batches and files."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import yaml
from pydantic import Field, ValidationError, create_model, model_validator

from holdfast.core.errors import InputError
from holdfast.core.files.output import replace_file
from holdfast.core.files.yaml import Number, Strict, describe_validation_error, read_mapping
from holdfast.core.validation import check_constructor
from holdfast.response.faults.batch import FaultBatch, make_batch
from holdfast.response.faults.entry import Fault, exponential_quantile
from holdfast.response.faults.events import FaultEvent, FaultEvents
from holdfast.response.faults.kind import fault_kinds, find_kind

_SECONDS_PER_HOUR = 3600.0
_WORDS_PER_ENTRY = 8  # random words of an entry before its dwell times
_MAX_INTERVALS = 10_000  # largest number of intervals of an intermittent fault in an episode


class HasJointNames(Protocol):
    """Object with names of joints, such as an arm."""

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Names of the joints from base to tool."""
        ...


class _EntryFields(Strict):
    kind: str
    joints: list[str] | str | None = None
    weights: list[Number] | None = None
    probability: Number = 1.0
    onset: Any = None
    duration: Any = None
    rate_per_hour: Number | None = None
    together: int = 1
    on: Number | None = None
    off: Number | None = None

    @model_validator(mode="before")
    @classmethod
    def _restore_on_and_off(cls, data: Any) -> Any:
        """Restore the keys ``on`` and ``off``, which YAML 1.1 reads as true and false."""
        names: dict[Any, str] = {True: "on", False: "off"}
        return {names.get(key, key): value for key, value in data.items()} if isinstance(data, dict) else data


_PARAMETER_FIELDS: Any = dict.fromkeys(
    (name for kind in fault_kinds().values() for name in kind.parameters_by_name), (Any, None)
)
_Entry: type[_EntryFields] = create_model("_Entry", __base__=_EntryFields, **_PARAMETER_FIELDS)


class _FaultModelFile(Strict):
    seed: int = Field(default=0, ge=0)
    faults: list[_Entry] = Field(min_length=1)  # type: ignore[valid-type]


@check_constructor
@dataclass(frozen=True)
class FaultModel:
    """Fault model: possible faults of the joints in an episode.

    Attributes:
        entries: Families of faults, from functions such as :func:`holdfast.response.faults.locked`.
        seed: Seed of all random numbers.

    Raises:
        InputError: An entry is not a :class:`holdfast.response.faults.Fault`, or the seed is below 0.
    """

    entries: Sequence[Fault]
    seed: int = 0

    def __post_init__(self) -> None:
        entries = tuple(self.entries)
        invalid = next((entry for entry in entries if not isinstance(entry, Fault)), None)
        if invalid is not None:
            raise InputError(
                f"an entry of the faults is {invalid!r}; create it with holdfast.response.faults.locked(...) or another kind"
            )
        object.__setattr__(self, "entries", entries)

    def draw(self, joints: HasJointNames | Sequence[str], *, episode: int = 0, horizon: float = math.inf) -> FaultEvents:
        """Sample the faults of one episode, identically on every machine.

        Args:
            joints: Arm, or the names of its joints.
            episode: Index of the episode, from 0.
            horizon: End of the episode, s. A fault with a rate begins before it, and an intermittent fault ends there.

        Raises:
            InputError: An entry names an unknown joint, the episode is below 0, or the horizon is not above 0.
        """
        if isinstance(episode, bool) or episode != int(episode) or episode < 0:
            raise InputError(f"episode is {episode}; it must be a whole number of 0 or more")
        if not horizon > 0:
            raise InputError(f"horizon is {horizon:g}; it must be above 0")
        names = list_joint_names(joints)
        return FaultEvents(
            event
            for entry_index, entry in enumerate(self.entries)
            for event in _draw_events(
                entry, names, seed=self.seed, episode=int(episode), entry_index=entry_index, horizon=horizon
            )
        )

    def batch(
        self, joints: HasJointNames | Sequence[str], *, episodes: int, first: int = 0, horizon: float = math.inf
    ) -> FaultBatch:
        """Sample episodes ``first``, ``first`` + 1, ... as arrays, for simulators that run many episodes at once.

        Args:
            joints: Arm, or the names of its joints.
            episodes: Number of episodes.
            first: Index of the first episode, from 0.
            horizon: End of each episode, s, as for :meth:`draw`.

        Raises:
            InputError: As for :meth:`draw`, or there is less than one episode.
        """
        if isinstance(episodes, bool) or episodes != int(episodes) or episodes < 1:
            raise InputError(f"episodes is {episodes}; it must be a whole number above 0")
        drawn_episodes = [self.draw(joints, episode=first + offset, horizon=horizon) for offset in range(int(episodes))]
        return make_batch(list_joint_names(joints), drawn_episodes, seed=self.seed, first=first)

    def with_seed(self, seed: int | None) -> FaultModel:
        """Return the fault model with another ``seed`` of 0 or more, or unchanged if it is None.

        Raises:
            InputError: The seed is not an integer of 0 or more.
        """
        return self if seed is None else FaultModel(self.entries, seed)

    def save(self, file: str | Path) -> Path:
        """Write the YAML file ``file`` that :func:`holdfast.response.faults.load` reads, and return its path.

        Raises:
            StoreError: The file cannot be written.
        """
        data = {"seed": self.seed, "faults": [entry.to_stored() for entry in self.entries]}
        path = Path(file)
        replace_file(
            path, yaml.safe_dump(data, sort_keys=False, allow_unicode=True, default_flow_style=None, width=120), "faults"
        )
        return path


def load(file: str | Path) -> FaultModel:
    """Load a fault model from the YAML file with the path ``file``.

    .. code-block:: yaml

        seed: 7                       # of all random numbers; default 0
        faults:
          - {kind: locked, onset: {uniform: [0.3, 1.5]}, probability: 0.5}
          - {kind: weak, joints: [panda_joint2, panda_joint4], gain: {uniform: [0.2, 0.7]}, onset: {exponential: 4.0}}
          - {kind: friction, joints: [panda_joint2], coulomb: 3.0, rate_per_hour: 0.5}

    Keys, units and distributions are those of :class:`holdfast.response.faults.Fault`.

    Raises:
        InputError: The file cannot be read, or an entry is unknown, missing or wrong; the message names it.
    """
    try:
        model: Any = _FaultModelFile.model_validate(read_mapping(Path(file), "holdfast.response.faults.load", "faults"))
        entries = []
        for index, entry in enumerate(model.faults):
            entry_values = {name: value for name, value in entry if name in entry.model_fields_set}
            common = {name: entry_values.pop(name) for name in Fault.__dataclass_fields__ if name in entry_values}
            try:
                entries.append(Fault(**common, parameters=entry_values))
            except InputError as error:
                raise InputError(f"faults[{index}]: {error}") from error
        return FaultModel(entries, model.seed)
    except ValidationError as error:
        raise InputError(
            f"faults file '{file}': {describe_validation_error(error, _FaultModelFile, ('str', 'list[str]'))}"
        ) from error
    except InputError as error:
        raise InputError(f"faults file '{file}': {error}") from error


def list_joint_names(joints: HasJointNames | Sequence[str]) -> tuple[str, ...]:
    """Return the names of the joints of an arm, or the given names."""
    names: Any = getattr(joints, "joint_names", joints)
    if isinstance(names, str) or not all(isinstance(name, str) for name in names) or len(set(names)) < max(len(names), 1):
        raise InputError(f"joints are {names!r}; give an arm, or the name of each joint once")
    return tuple(names)


# ---- random numbers ----------------------------------------------------------------------------------------------
#
# NumPy guarantees no stream for the methods of its ``Generator``, but the words of a counter-based bit generator are fixed by
# its definition (Salmon et al. 2011). Entry f of episode e has its own key, so adding an entry does not change the others.


def generate_uniforms(seed: int, episode: int, entry: int) -> Iterator[float]:
    """Yield an infinite stream of uniform numbers of [0, 1), with 53 bits, for one entry of one episode."""
    key = np.array([seed % 2**64, (65536 * episode + entry) % 2**64], dtype=np.uint64)
    generator = np.random.Philox(key=key, counter=0)
    while True:
        for word in generator.random_raw(_WORDS_PER_ENTRY).tolist():
            yield (word >> 11) * 2.0**-53


def _draw_events(
    entry: Fault, joints: Sequence[str], *, seed: int, episode: int, entry_index: int, horizon: float = math.inf
) -> list[FaultEvent]:
    """Sample the events of one entry in an episode that ends at ``horizon``, s; faults with a rate begin before it."""
    if entry.joints is not None:
        unknown = next((name for name in entry.joints if name not in joints), None)
        if unknown is not None:
            raise InputError(f"'{entry.kind}' names joint '{unknown}'; the joints are {', '.join(joints)}")
    names, weights = entry.joints or joints, entry.weights or (1.0,) * len(entry.joints or joints)
    if entry.together > len(names):
        raise InputError(f"together of '{entry.kind}' is {entry.together}, and there are {len(names)} joints")
    stream = generate_uniforms(seed, episode, entry_index)
    uniform_values = list(islice(stream, _WORDS_PER_ENTRY))
    if not uniform_values[0] < entry.probability:
        return []
    if entry.rate_per_hour is not None:
        onset = exponential_quantile(_SECONDS_PER_HOUR / entry.rate_per_hour, uniform_values[2])
        if onset > horizon:
            return []
    else:
        assert entry.onset is not None
        onset = entry.onset.at(uniform_values[2])
    onset = round(onset, 6)
    end = math.inf if entry.duration is None else round(onset + entry.duration.at(uniform_values[5]), 6)
    sign = -1.0 if uniform_values[4] < 0.5 else 1.0
    known = find_kind(entry.kind).parameters_by_name
    parameters = {
        name: law
        if isinstance(law, str)
        else round((sign if known[name].has_random_sign else 1.0) * law.at(uniform_values[value_index]), 9)
        for (name, law), value_index in zip(entry.parameters.items(), (3, 7), strict=False)
    }
    intervals = [(onset, end)]
    if entry.on is not None and entry.off is not None:
        intervals = list(_draw_intervals(entry, onset, min(end, horizon), stream))
    chosen_joints = _choose_joints(names, weights, uniform_values[1], uniform_values[6], entry.together)
    return [
        FaultEvent(entry.kind, joint, start, end=interval_end, parameters=parameters)
        for joint in chosen_joints
        for start, interval_end in intervals
    ]


def _choose_joints(names: Sequence[str], weights: Sequence[float], first: float, others: float, count: int) -> list[str]:
    """Choose a joint by ``first``, then further joints by ``others``, whose remainder chooses the next one again."""
    remaining, chosen, uniform_value = list(zip(names, weights, strict=True)), list[str](), first
    while len(chosen) < count:
        target, weight_passed = uniform_value * sum(weight for _, weight in remaining), 0.0
        for index, (_, weight) in enumerate(remaining):
            if weight_passed + weight > target or index == len(remaining) - 1:
                break
            weight_passed += weight
        chosen.append(remaining[index][0])
        uniform_value = others if len(chosen) == 1 else (target - weight_passed) / weight
        del remaining[index]
    return chosen


def _draw_intervals(entry: Fault, onset: float, end: float, stream: Iterator[float]) -> Iterator[tuple[float, float]]:
    """Yield the intervals in which an intermittent fault is present, from exponential times that start at the ninth word."""
    assert entry.on is not None
    assert entry.off is not None
    if math.isinf(end):
        raise InputError(f"'{entry.kind}' is intermittent without an end; give the horizon of the episode, or its duration")
    start = onset
    for _ in range(_MAX_INTERVALS):
        if start >= end:
            return
        time_on, time_off = exponential_quantile(entry.on, next(stream)), exponential_quantile(entry.off, next(stream))
        yield start, round(min(start + time_on, end), 6)
        start = round(start + time_on + time_off, 6)
    raise InputError(
        f"'{entry.kind}' is intermittent with more than {_MAX_INTERVALS} intervals in an episode; increase on or off"
    )
