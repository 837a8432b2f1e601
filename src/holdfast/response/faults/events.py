"""Faults of one episode, with their joints, times, and parameters."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.response.faults.kind import find_kind


@dataclass(frozen=True)
class FaultEvent:
    """Fault of one joint in one episode.

    Attributes:
        kind: Name of the kind of fault, such as ``locked``.
        joint: Name of the joint.
        onset: Time of the onset, s.
        end: Time of the end, s; infinite for a permanent fault.
        parameters: Parameters of the kind by name, with their sign, in rad, N m, rad/s (m, N, m/s for prismatic joints).
    """

    kind: str
    joint: str
    onset: float
    _: KW_ONLY
    end: float = math.inf
    parameters: Mapping[str, float | str] = field(default_factory=dict, hash=False)

    def active(self, time: float) -> bool:
        """Return True if the fault is present at ``time``, s."""
        return self.onset <= time < self.end

    def to_stored(self) -> dict[str, Any]:
        """Return the event in JSON types; ``end`` is None for a permanent fault."""
        end = None if math.isinf(self.end) else self.end
        return {"kind": self.kind, "joint": self.joint, "onset": self.onset, "end": end, **self.parameters}

    @classmethod
    def from_stored(cls, data: Mapping[str, Any]) -> FaultEvent:
        """Return the event from ``data`` of :meth:`to_stored`."""
        parameters = {name: value for name, value in data.items() if name not in ("kind", "joint", "onset", "end")}
        end = math.inf if data["end"] is None else data["end"]
        return cls(data["kind"], data["joint"], data["onset"], end=end, parameters=parameters)

    def sentence(self) -> str:
        """Return a sentence such as ``panda_joint4: weak from 0.812 s on (gain 0.41)``."""
        numbers = ", ".join(f"{name} {value:.4g}" for name, value in self.parameters.items() if not isinstance(value, str))
        end_text = "on" if math.isinf(self.end) else f"to {self.end:.4g} s"
        return f"{self.joint}: {self.kind} from {self.onset:.4g} s {end_text}{f' ({numbers})' if numbers else ''}"


class FaultEvents(tuple[FaultEvent, ...]):
    """Faults of an episode, a tuple in the order of onset, joint, and kind."""

    __slots__ = ()

    def __new__(cls, events: Iterable[FaultEvent] = ()) -> FaultEvents:  # noqa: D102
        return super().__new__(cls, sorted(events, key=lambda event: (event.onset, event.joint, event.kind, event.end)))

    def times_of(self, joints: Sequence[str]) -> NDArray[np.float64]:
        """Return the lock times (n,) of these joints, s, infinite for joints that do not lock, for :func:`holdfast.simulate`.

        Args:
            joints: Names of the n joints, in the order of the result.

        Raises:
            InputError: A joint is unknown, or a fault is not a permanent lock at the position of the joint at the onset.
        """
        times = np.full(len(joints), np.inf)
        for event in self:
            kind = find_kind(event.kind)
            if not kind.holds_joint or kind.is_delayed(event.parameters) or math.isfinite(event.end):
                raise InputError(
                    f"'{event.sentence()}' is not a permanent lock at the joint's position, so it needs bodies and motors; add "
                    "--physics, or use holdfast.simulate_faults"
                )
            if event.joint not in joints:
                raise InputError(f"a fault names joint '{event.joint}'; the joints are {', '.join(joints)}")
            times[joints.index(event.joint)] = min(times[joints.index(event.joint)], event.onset)
        return times

    @property
    def id(self) -> str:
        """SHA-256, in hexadecimal digits, of the events as JSON with sorted keys and no spaces; identical on every machine."""
        text = json.dumps([event.to_stored() for event in self], sort_keys=True, separators=(",", ":"), allow_nan=False)
        return hashlib.sha256(text.encode()).hexdigest()
