"""Fault model: its entries and its seed, with episodes, batches, and files."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import yaml
from pydantic import Field, ValidationError, create_model, model_validator

from holdfast.core.errors import InputError
from holdfast.core.files.output import replace_file
from holdfast.core.files.yaml import Number, Strict, describe_validation_error, read_mapping
from holdfast.core.validation import check_constructor
from holdfast.response.faults.batch import FaultBatch, make_batch
from holdfast.response.faults.draw import draw_events
from holdfast.response.faults.entry import Fault
from holdfast.response.faults.events import FaultEvents
from holdfast.response.faults.kind import fault_kinds


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
            for event in draw_events(
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
