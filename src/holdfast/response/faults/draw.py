"""Draw faults from raw words of Philox, which are identical on every machine and in every version of NumPy.

NumPy promises no stream for the methods of its ``Generator``; the words of a counter-based bit generator are fixed by its
definition (Salmon et al. 2011). Entry f of episode e has the words of its own key, so that adding an entry changes no other.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import islice

import numpy as np

from holdfast.core.errors import InputError
from holdfast.response.faults.distributions import exponential_quantile
from holdfast.response.faults.entry import Fault
from holdfast.response.faults.events import FaultEvent
from holdfast.response.faults.kind import find_kind

_SECONDS_PER_HOUR = 3600.0
_WORDS_PER_ENTRY = 8  # of an entry before its dwell times
_MAX_INTERVALS = 10_000  # times that a fault comes and goes in an episode


def generate_uniforms(seed: int, episode: int, entry: int) -> Iterator[float]:
    """Yield uniform numbers of [0, 1), of 53 bits, for one entry of one episode, without end."""
    key = np.array([seed % 2**64, (65536 * episode + entry) % 2**64], dtype=np.uint64)
    generator = np.random.Philox(key=key, counter=0)
    while True:
        for word in generator.random_raw(_WORDS_PER_ENTRY).tolist():
            yield (word >> 11) * 2.0**-53


def draw_events(
    entry: Fault, joints: Sequence[str], *, seed: int, episode: int, entry_index: int, horizon: float = math.inf
) -> list[FaultEvent]:
    """Draw the events of one entry in one episode.

    Args:
        entry: The family.
        joints: Names of all joints.
        seed: Of all draws.
        episode: From 0.
        entry_index: Of the entry, from 0.
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
