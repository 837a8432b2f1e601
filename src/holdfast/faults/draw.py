"""Faults drawn from raw words of Philox, which are alike on every machine and in every version of NumPy.

NumPy promises no stream for the methods of its ``Generator``; the words of a counter-based bit generator are fixed by its
definition (Salmon et al. 2011). Entry f of episode e has the words of its own key, so that adding an entry changes no other.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import islice

import numpy as np

from holdfast.errors import InputError
from holdfast.faults.entry import SIGNED, Fault
from holdfast.faults.events import FaultEvent
from holdfast.faults.spread import exponential

_HOUR = 3600.0
_WORDS = 8  # of an entry before its dwell times
_MOST = 10_000  # times that a fault comes and goes in an episode


def uniforms(seed: int, episode: int, entry: int) -> Iterator[float]:
    """Uniform numbers of [0, 1), of 53 bits, for one entry of one episode, without end."""
    key = np.array([seed % 2**64, (65536 * episode + entry) % 2**64], dtype=np.uint64)
    words = np.random.Philox(key=key, counter=0)
    while True:
        for word in words.random_raw(_WORDS).tolist():
            yield (word >> 11) * 2.0**-53


def drawn(
    entry: Fault, joints: Sequence[str], *, seed: int, episode: int, number: int, horizon: float = math.inf
) -> list[FaultEvent]:
    """The events of one entry in one episode.

    Args:
        entry: The family.
        joints: Names of all joints.
        seed: Of all draws.
        episode: From 0.
        number: Of the entry, from 0.
        horizon: s, the end of the episode: a fault with a rate may come later, and then does not come.

    Raises:
        InputError: An unknown joint, or a fault that comes and goes for ever.
    """
    if entry.joints is not None:
        unknown = next((name for name in entry.joints if name not in joints), None)
        if unknown is not None:
            raise InputError(f"'{entry.kind}' names joint '{unknown}'; the joints are {', '.join(joints)}")
    names, weights = entry.joints or joints, entry.weights or (1.0,) * len(entry.joints or joints)
    if entry.together > len(names):
        raise InputError(f"together of '{entry.kind}' is {entry.together}, and there are {len(names)} joints")
    stream = uniforms(seed, episode, number)
    u = list(islice(stream, _WORDS))
    if not u[0] < entry.probability:
        return []
    if entry.rate_per_hour is not None:
        onset = exponential(_HOUR / entry.rate_per_hour, u[2])
        if onset > horizon:
            return []
    else:
        assert entry.onset is not None
        onset = entry.onset.at(u[2])
    onset = round(onset, 6)
    end = math.inf if entry.duration is None else round(onset + entry.duration.at(u[5]), 6)
    sign = -1.0 if u[4] < 0.5 else 1.0
    parameters = {
        name: law if isinstance(law, str) else round((sign if name in SIGNED else 1.0) * law.at(u[k]), 9)
        for (name, law), k in zip(entry.parameters.items(), (3, 7), strict=False)
    }
    spans = [(onset, end)]
    if entry.on is not None and entry.off is not None:
        spans = list(_dwells(entry, onset, min(end, horizon), stream))
    which = _chosen(names, weights, u[1], u[6], entry.together)
    return [FaultEvent(entry.kind, joint, start, end=stop, parameters=parameters) for joint in which for start, stop in spans]


def _chosen(names: Sequence[str], weights: Sequence[float], first: float, others: float, count: int) -> list[str]:
    """The joint of ``first``; then those of ``others``, what is left of which chooses the next one again."""
    left, found, u = list(zip(names, weights, strict=True)), list[str](), first
    while len(found) < count:
        target, passed = u * sum(weight for _, weight in left), 0.0
        for k, (_, weight) in enumerate(left):
            if passed + weight > target or k == len(left) - 1:
                break
            passed += weight
        found.append(left[k][0])
        u = others if len(found) == 1 else (target - passed) / weight
        del left[k]
    return found


def _dwells(entry: Fault, onset: float, end: float, stream: Iterator[float]) -> Iterator[tuple[float, float]]:
    """When it is there, by exponential times from the ninth word on."""
    assert entry.on is not None
    assert entry.off is not None
    if math.isinf(end):
        raise InputError(f"'{entry.kind}' comes and goes for ever; give the horizon of the episode, or its duration")
    start = onset
    for _ in range(_MOST):
        if start >= end:
            return
        there, away = exponential(entry.on, next(stream)), exponential(entry.off, next(stream))
        yield start, round(min(start + there, end), 6)
        start = round(start + there + away, 6)
    raise InputError(f"'{entry.kind}' comes and goes more than {_MOST} times in an episode; make them longer")
