"""First contacts of a motion with obstacles and links, also between its instants."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.exact.engines import is_library_installed

MAX_JOINT_SPACING = 0.05  # rad and m: largest motion of a joint between two instants
MIN_DISTANCE_CHANGE_M = 5e-4  # m: instants with a smaller possible change between them are not refined
TIME_TOLERANCE = 1e-9  # of the duration: accuracy of the time of a contact
_MAX_BISECTIONS = 60  # maximum number of bisections
_EXACT_BISECTIONS = 12  # bisections of half a millimetre, for the time at which the bodies touch
_BATCH_INSTANTS = 64  # instants


@dataclass(frozen=True, kw_only=True)
class Contact:
    """First contact of a link and an object, or of two links, on a motion.

    Attributes:
        run: Number of the motion, from 0.
        time: Time in the unit of the motion, at which the lower bound of the distance is 0 for the first time.
        link: Joint that moves the link, with the number of the capsule if two links meet and one has several.
        object: Name of the object of the cell, or of the other link.
        depth: Largest amount by which the bound is below 0 on the motion, m, to half a millimetre; the arm is no deeper.
        exact_time: Time, in the same unit, at which the bodies themselves first touch, by an exact library: infinite if they
            do not touch on the motion; None without a library.
    """

    run: int = 0
    time: float
    link: str
    object: str
    depth: float
    exact_time: float | None = None

    def sentence(self, unit: str = "s") -> str:
        """Return a sentence on the contact; ``unit`` is the unit of the time, such as ``s``."""
        return f"{_format_instant(self.time, unit)} {self.link} touches {self.object}{self.confirmation(unit)}"

    def confirmation(self, unit: str = "s") -> str:
        """Return the phrase on the exact contact after the sentence, with times in ``unit``; empty without an exact library."""
        if self.exact_time is None:
            return ""
        if np.isinf(self.exact_time):
            return ", by the lower bound; by exact distances there is no contact"
        moments = [_format_instant(instant, unit) for instant in (self.time, self.exact_time)]
        exact_phrase = ", by exact distances"
        return exact_phrase if moments[0] == moments[1] else f", by the lower bound;{exact_phrase[1:]} {moments[1]}"


def _format_instant(time: float, unit: str) -> str:
    return f"in cycle {int(time) + 1}" if unit == "cycles" else f"at {time:.4g} {unit}"


def find_first_contacts(
    clearance: Clearance, time: FloatArray, q: FloatArray, evaluate: Callable[[FloatArray], FloatArray] | None = None
) -> list[Contact]:
    """Find the first contact of every pair that touches on a motion, in order of time.

    The motion is assumed to be straight in joint space between instants at most 0.05 rad or m apart. A pair whose distances at
    two instants are d_1 and d_2 comes no closer between them than ``(d_1 + d_2 - L) / 2``, where L bounds the change of its
    distance (:meth:`Clearance.lipschitz_bounds`). If this is below 0, the instant in the middle is checked as well, until L is
    below half a millimetre. Only a contact that is less than a quarter of a millimetre deep may be missed. Depths are known to
    half a millimetre in the same way.

    Args:
        clearance: Collision model; margins are not contacts.
        time: (T,) ascending times.
        q: (T, n) configurations of the motion, rad and m, finite.
        evaluate: Function that returns the motion (N, n) at other times (N,); default: straight lines.
    """
    if not clearance.pair_names:
        return []
    evaluate_motion = (
        evaluate
        if evaluate is not None
        else lambda instant: np.stack([np.interp(instant, time, column) for column in q.T], axis=1)
    )
    time, q = _refine_instants(time, q, evaluate_motion)
    lower, upper = sampling_limits(clearance.arm)
    change_bounds = clearance.lipschitz_bounds(np.minimum(lower, q.min(axis=0)), np.maximum(upper, q.max(axis=0)))
    distances = clearance.by_pair(q)
    while True:
        max_changes = np.abs(np.diff(q, axis=0)) @ change_bounds.T
        untouched = np.minimum.accumulate(distances, axis=0)[1:] >= 0
        smallest, lower_bounds = distances.min(axis=0), (distances[:-1] + distances[1:] - max_changes) / 2
        deeper = (smallest < 0) & (lower_bounds < smallest - MIN_DISTANCE_CHANGE_M)
        undecided = (untouched & (lower_bounds < 0) & (max_changes >= MIN_DISTANCE_CHANGE_M) | deeper).any(axis=1)
        if not undecided.any():
            break
        rows = np.flatnonzero(undecided) + 1
        middle = (time[rows - 1] + time[rows]) / 2
        middle_q = evaluate_motion(middle)
        time, q = np.insert(time, rows, middle), np.insert(q, rows, middle_q, axis=0)
        distances = np.insert(distances, rows, clearance.by_pair(middle_q), axis=0)
    is_touching = distances < 0
    contacts = []
    for pair in np.flatnonzero(is_touching.any(axis=0)):
        first_index = int(is_touching[:, pair].argmax())
        instant = (
            float(time[0])
            if not first_index
            else _bisect_contact(clearance, int(pair), time[first_index - 1 : first_index + 1], evaluate_motion)
        )
        exact_time = None
        if is_library_installed():
            candidates = np.flatnonzero(
                (distances[:-1, pair] + distances[1:, pair] < max_changes[:, pair]) & (time[1:] > instant)
            )
            steps = np.ceil(max_changes[candidates, pair] / MIN_DISTANCE_CHANGE_M).astype(np.int64)
            instants = [
                np.linspace(time[index], time[index + 1], count, endpoint=False)
                for index, count in zip(candidates, steps, strict=True)
                if count
            ]
            exact_time = _exact_contact_time(
                clearance, int(pair), np.concatenate([*instants, time[-1:]]), instant, evaluate_motion
            )
        link, _, obstacle = clearance.pair_names[pair].partition(" & ")
        contacts.append(
            Contact(time=instant, link=link, object=obstacle, depth=float(-distances[:, pair].min()), exact_time=exact_time)
        )
    return sorted(contacts, key=lambda contact: contact.time)


def _refine_instants(
    time: FloatArray, q: FloatArray, evaluate: Callable[[FloatArray], FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Add instants where joints move far between two instants."""
    for _ in range(_MAX_BISECTIONS):
        rows = np.flatnonzero(np.abs(np.diff(q, axis=0)).max(axis=1) > MAX_JOINT_SPACING) + 1
        if not rows.size:
            break
        middle = (time[rows - 1] + time[rows]) / 2
        time, q = np.insert(time, rows, middle), np.insert(q, rows, evaluate(middle), axis=0)
    return time, q


def _exact_contact_time(
    clearance: Clearance, pair: int, instants: FloatArray, after: float, evaluate: Callable[[FloatArray], FloatArray]
) -> float:
    """Return when the bodies of a pair first touch at one of some instants, or since the previous one; infinite if never."""
    instants = np.concatenate([[after], instants[instants > after]])
    for start in range(0, len(instants), _BATCH_INSTANTS):
        batch = instants[start : start + _BATCH_INSTANTS]
        hits = clearance.exactness.check_pair_contact(evaluate(batch), pair)
        if hits.any():
            index = start + int(hits.argmax())
            separated, touching = float(instants[max(index - 1, 0)]), float(instants[index])
            for _ in range(_EXACT_BISECTIONS if index else 0):
                middle = (separated + touching) / 2
                if clearance.exactness.check_pair_contact(evaluate(np.array([middle])), pair)[0]:
                    touching = middle
                else:
                    separated = middle
            return touching
    return float("inf")


def _bisect_contact(
    clearance: Clearance, pair: int, between: FloatArray, evaluate: Callable[[FloatArray], FloatArray]
) -> float:
    """Find by bisection when a pair first touches that is separated at the first of two times and touches at the second."""
    separated, touching = map(float, between)
    tolerance = TIME_TOLERANCE * max(abs(touching), 1e-12)
    for _ in range(_MAX_BISECTIONS):
        if touching - separated <= tolerance:
            break
        middle = (separated + touching) / 2
        if clearance.by_pair(evaluate(np.array([middle])))[0, pair] < 0:
            touching = middle
        else:
            separated = middle
    return touching
