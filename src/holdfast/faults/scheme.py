"""A fault model: its entries and its seed; episodes, batches and files of it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import yaml
from pydantic import Field, ValidationError, create_model, model_validator

from holdfast.arguments import checked_class
from holdfast.errors import InputError
from holdfast.faults.batch import FaultBatch, batch_of
from holdfast.faults.draw import drawn
from holdfast.faults.entry import PARAMETERS, Fault
from holdfast.faults.events import FaultEvents
from holdfast.files.output import replaced
from holdfast.files.yaml import Number, Strict, content, sentence


class Jointed(Protocol):
    """Whatever has names of joints, as an arm."""

    @property
    def joint_names(self) -> tuple[str, ...]:
        """From base to tool."""
        ...


class _Common(Strict):
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
    def _on_and_off(cls, data: Any) -> Any:
        """YAML 1.1 reads these two keys as true and false."""
        names: dict[Any, str] = {True: "on", False: "off"}
        return {names.get(key, key): value for key, value in data.items()} if isinstance(data, dict) else data


_NUMBERS: Any = dict.fromkeys((name for sets in PARAMETERS.values() for names in sets for name in names), (Any, None))
_Entry: type[_Common] = create_model("_Entry", __base__=_Common, **_NUMBERS)


class _File(Strict):
    seed: int = Field(default=0, ge=0)
    faults: list[_Entry] = Field(min_length=1)  # type: ignore[valid-type]


@checked_class
@dataclass(frozen=True)
class Faults:
    """A fault model: what may happen to the joints in an episode.

    Attributes:
        entries: Families of faults, as :func:`holdfast.faults.locked` makes them.
        seed: Of all draws.

    Raises:
        InputError: Something else than entries, or a seed below 0.
    """

    entries: Sequence[Fault]
    seed: int = 0

    def __post_init__(self) -> None:
        entries = tuple(self.entries)
        wrong = next((x for x in entries if not isinstance(x, Fault)), None)
        if wrong is not None:
            raise InputError(f"an entry of the faults is {wrong!r}; make it by holdfast.faults.locked(...) or another kind")
        object.__setattr__(self, "entries", entries)

    def draw(self, joints: Jointed | Sequence[str], *, episode: int = 0, horizon: float = math.inf) -> FaultEvents:
        """What happens in one episode, alike on every machine.

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
        names = names_of(joints)
        return FaultEvents(
            event
            for number, entry in enumerate(self.entries)
            for event in drawn(entry, names, seed=self.seed, episode=int(episode), number=number, horizon=horizon)
        )

    def batch(self, joints: Jointed | Sequence[str], *, episodes: int, first: int = 0, horizon: float = math.inf) -> FaultBatch:
        """Episodes ``first``, ``first`` + 1, ... as arrays, for simulators that run many at once.

        Raises:
            InputError: As :meth:`draw`, or fewer than one episode.
        """
        if isinstance(episodes, bool) or episodes != int(episodes) or episodes < 1:
            raise InputError(f"episodes is {episodes}; it must be a whole number above 0")
        each = [self.draw(joints, episode=first + k, horizon=horizon) for k in range(int(episodes))]
        return batch_of(names_of(joints), each, seed=self.seed, first=first)

    def seeded(self, seed: int | None) -> Faults:
        """With another seed; as they are where it is None.

        Raises:
            InputError: No whole number of 0 or more.
        """
        return self if seed is None else Faults(self.entries, seed)

    def save(self, file: str | Path) -> Path:
        """Write a YAML file that :func:`holdfast.faults.load` reads.

        Raises:
            StoreError: It cannot be written.
        """
        data = {"seed": self.seed, "faults": [entry.stored() for entry in self.entries]}
        path = Path(file)
        replaced(path, yaml.safe_dump(data, sort_keys=False, allow_unicode=True, default_flow_style=None, width=120), "faults")
        return path


def load(file: str | Path) -> Faults:
    """A fault model from a YAML file.

    .. code-block:: yaml

        seed: 7                       # of all draws; 0 if not given
        faults:
          - {kind: locked, onset: {uniform: [0.3, 1.5]}, probability: 0.5}
          - {kind: weak, joints: [panda_joint2, panda_joint4], gain: {uniform: [0.2, 0.7]}, onset: {exponential: 4.0}}
          - {kind: friction, joints: [panda_joint2], coulomb: 3.0, rate_per_hour: 0.5}

    Keys, units and laws are those of :class:`holdfast.faults.Fault`.

    Raises:
        InputError: Unreadable, or something that is unknown, missing or wrong; the message names it.
    """
    try:
        model: Any = _File.model_validate(content(Path(file), "holdfast.faults.load", "faults"))
        entries = []
        for k, entry in enumerate(model.faults):
            given = {name: value for name, value in entry if name in entry.model_fields_set}
            common = {name: given.pop(name) for name in Fault.__dataclass_fields__ if name in given}
            try:
                entries.append(Fault(**common, parameters=given))
            except InputError as error:
                raise InputError(f"faults[{k}]: {error}") from error
        return Faults(entries, model.seed)
    except ValidationError as error:
        raise InputError(f"faults file '{file}': {sentence(error, _File, ('str', 'list[str]'))}") from error
    except InputError as error:
        raise InputError(f"faults file '{file}': {error}") from error


def names_of(joints: Jointed | Sequence[str]) -> tuple[str, ...]:
    """The names of the joints of an arm, or these names."""
    names: Any = getattr(joints, "joint_names", joints)
    if isinstance(names, str) or not all(isinstance(name, str) for name in names) or len(set(names)) < max(len(names), 1):
        raise InputError(f"joints are {names!r}; give an arm, or the name of each joint once")
    return tuple(names)
