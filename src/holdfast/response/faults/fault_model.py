"""Fault model: its entries and its seed, with episodes, batches, files, and draws that are identical on every machine."""

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
_WORDS_PER_ENTRY = 8  # of an entry before its dwell times
_MAX_INTERVALS = 10_000  # times that a fault comes and goes in an episode


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
        entries: Families of faults, as :func:`holdfast.response.faults.locked` makes them.
        seed: Of all draws.

    Raises:
        InputError: Something else than entries, or a seed below 0.
    """

    entries: Sequence[Fault]
    seed: int = 0

    def __post_init__(self) -> None:
        entries = tuple(self.entries)
        invalid = next((entry for entry in entries if not isinstance(entry, Fault)), None)
        if invalid is not None:
            raise InputError(
                f"an entry of the faults is {invalid!r}; make it by holdfast.response.faults.locked(...) or another kind"
            )
        object.__setattr__(self, "entries", entries)

    def draw(self, joints: HasJointNames | Sequence[str], *, episode: int = 0, horizon: float = math.inf) -> FaultEvents:
        """Draw the faults of one episode, identical on every machine.

        Args:
            joints: An arm, or the names of its joints.
            episode: From 0.
            horizon: Its end, s: a fault with a rate per hour does not come later, one that comes and goes ends there.

        Raises:
            InputError: An entry names an unknown joint; a number below 0.
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
        """Draw episodes ``first``, ``first`` + 1, ... as arrays, for simulators that run many at once.

        Raises:
            InputError: As :meth:`draw`, or fewer than one episode.
        """
        if isinstance(episodes, bool) or episodes != int(episodes) or episodes < 1:
            raise InputError(f"episodes is {episodes}; it must be a whole number above 0")
        drawn_episodes = [self.draw(joints, episode=first + offset, horizon=horizon) for offset in range(int(episodes))]
        return make_batch(list_joint_names(joints), drawn_episodes, seed=self.seed, first=first)

    def with_seed(self, seed: int | None) -> FaultModel:
        """Return the fault model with another seed, or unchanged where it is None.

        Raises:
            InputError: No whole number of 0 or more.
        """
        return self if seed is None else FaultModel(self.entries, seed)

    def save(self, file: str | Path) -> Path:
        """Write a YAML file that :func:`holdfast.response.faults.load` reads.

        Raises:
            StoreError: It cannot be written.
        """
        data = {"seed": self.seed, "faults": [entry.to_stored() for entry in self.entries]}
        path = Path(file)
        replace_file(
            path, yaml.safe_dump(data, sort_keys=False, allow_unicode=True, default_flow_style=None, width=120), "faults"
        )
        return path


def load(file: str | Path) -> FaultModel:
    """Load a fault model from a YAML file.

    .. code-block:: yaml

        seed: 7                       # of all draws; 0 if not given
        faults:
          - {kind: locked, onset: {uniform: [0.3, 1.5]}, probability: 0.5}
          - {kind: weak, joints: [panda_joint2, panda_joint4], gain: {uniform: [0.2, 0.7]}, onset: {exponential: 4.0}}
          - {kind: friction, joints: [panda_joint2], coulomb: 3.0, rate_per_hour: 0.5}

    Keys, units and laws are those of :class:`holdfast.response.faults.Fault`.

    Raises:
        InputError: Unreadable, or something that is unknown, missing or wrong; the message names it.
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


# ---- draws -------------------------------------------------------------------------------------------------------
#
# NumPy promises no stream for the methods of its ``Generator``; the words of a counter-based bit generator are fixed by its
# definition (Salmon et al. 2011). Entry f of episode e has the words of its own key, so that adding an entry changes no other.


def generate_uniforms(seed: int, episode: int, entry: int) -> Iterator[float]:
    """Yield uniform numbers of [0, 1), of 53 bits, for one entry of one episode, without end."""
    key = np.array([seed % 2**64, (65536 * episode + entry) % 2**64], dtype=np.uint64)
    generator = np.random.Philox(key=key, counter=0)
    while True:
        for word in generator.random_raw(_WORDS_PER_ENTRY).tolist():
            yield (word >> 11) * 2.0**-53


def _draw_events(
    entry: Fault, joints: Sequence[str], *, seed: int, episode: int, entry_index: int, horizon: float = math.inf
) -> list[FaultEvent]:
    """Draw the events of one entry in one episode that ends at a horizon in s; a fault with a rate does not come later."""
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
        raise InputError(f"'{entry.kind}' comes and goes for ever; give the horizon of the episode, or its duration")
    start = onset
    for _ in range(_MAX_INTERVALS):
        if start >= end:
            return
        time_on, time_off = exponential_quantile(entry.on, next(stream)), exponential_quantile(entry.off, next(stream))
        yield start, round(min(start + time_on, end), 6)
        start = round(start + time_on + time_off, 6)
    raise InputError(f"'{entry.kind}' comes and goes more than {_MAX_INTERVALS} times in an episode; make them longer")
