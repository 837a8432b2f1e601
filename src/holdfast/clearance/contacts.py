"""When a motion first touches what an arm should keep clear of: looked for between its instants, not at them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.clearance.clearance import Clearance
from holdfast.clearance.exact.engines import installed

Array = NDArray[np.float64]

SPACING = 0.05  # rad and m: how far a joint goes between two instants at most before anything is said
FINEST = 5e-4  # m: between instants with less change than this nothing more is looked for
SOONEST = 1e-9  # of the duration: how well the time of a contact is known
_MOST = 60  # halvings
_HALVINGS = 12  # of half a millimetre, for when the bodies touch
_AT_ONCE = 64  # instants


@dataclass(frozen=True, kw_only=True)
class Contact:
    """The first touch of a link and an object, or of two links, on a motion.

    Attributes:
        run: Which of several motions, from 0.
        time: When, in the unit of the motion's time: the bound of the distance is 0 there for the first time.
        link: By the joint that moves it, with the number of the capsule where two links meet and one has several.
        object: Of the cell; or the other link.
        depth: How far below 0 the bound goes on the motion, m, to half a millimetre: the arm is no deeper in the object.
        exact_time: When the bodies themselves first touch, by an exact library: infinite if they do not on the motion; None
            where none is installed.
    """

    run: int = 0
    time: float
    link: str
    object: str
    depth: float
    exact_time: float | None = None

    def sentence(self, unit: str = "s") -> str:
        """What happened, for people; the unit is that of the time."""
        return f"{_moment(self.time, unit)} {self.link} touches {self.object}{self.confirmation(unit)}"

    def confirmation(self, unit: str = "s") -> str:
        """What the exact library says of it, where one was asked: what follows the sentence."""
        if self.exact_time is None:
            return ""
        if np.isinf(self.exact_time):
            return ", by the bound; exactly, it does not"
        moments = [_moment(t, unit) for t in (self.time, self.exact_time)]
        return ", exactly" if moments[0] == moments[1] else f", by the bound; exactly, {moments[1]}"


def _moment(time: float, unit: str) -> str:
    return f"in cycle {int(time) + 1}" if unit == "cycles" else f"at {time:.4g} {unit}"


def first_contacts(clearance: Clearance, time: Array, q: Array, at: Callable[[Array], Array] | None = None) -> list[Contact]:
    """The first contact of every pair that touches on a motion, in order of time.

    The motion is taken to be straight in joint space between instants at most 0.05 rad or m apart. A pair that is d_1 and d_2
    away at two of them comes no closer between them than ``(d_1 + d_2 - L) / 2``, L the most that its distance can change on
    the way (:meth:`Clearance.changes`). Where that is below 0 the instant in the middle is looked at too, until L is below half
    a millimetre: a touch that is less than a quarter of a millimetre deep may go unseen, no other. Depths are known to half a
    millimetre in the same way.

    Args:
        clearance: What is looked at; margins are not contacts.
        time: (T,) ascending.
        q: (T, n) the motion then, rad and m, finite.
        at: The motion (N, n) at other times (N,); straight lines if not given.
    """
    if not clearance.pair_names:
        return []
    found = at if at is not None else lambda when: np.stack([np.interp(when, time, column) for column in q.T], axis=1)
    time, q = _spaced(time, q, found)
    low, high = finite_limits(clearance.arm)
    slopes = clearance.changes(np.minimum(low, q.min(axis=0)), np.maximum(high, q.max(axis=0)))
    gaps = clearance.by_pair(q)
    while True:
        most = np.abs(np.diff(q, axis=0)) @ slopes.T
        untouched = np.minimum.accumulate(gaps, axis=0)[1:] >= 0
        least, between = gaps.min(axis=0), (gaps[:-1] + gaps[1:] - most) / 2
        deeper = (least < 0) & (between < least - FINEST)
        open_ = (untouched & (between < 0) & (most >= FINEST) | deeper).any(axis=1)
        if not open_.any():
            break
        rows = np.flatnonzero(open_) + 1
        middle = (time[rows - 1] + time[rows]) / 2
        new = found(middle)
        time, q = np.insert(time, rows, middle), np.insert(q, rows, new, axis=0)
        gaps = np.insert(gaps, rows, clearance.by_pair(new), axis=0)
    touch = gaps < 0
    contacts = []
    for pair in np.flatnonzero(touch.any(axis=0)):
        first = int(touch[:, pair].argmax())
        when = float(time[0]) if not first else _crossing(clearance, int(pair), time[first - 1 : first + 1], found)
        exact = None
        if installed():
            near = np.flatnonzero((gaps[:-1, pair] + gaps[1:, pair] < most[:, pair]) & (time[1:] > when))
            steps = np.ceil(most[near, pair] / FINEST).astype(np.int64)
            instants = [np.linspace(time[k], time[k + 1], n, endpoint=False) for k, n in zip(near, steps, strict=True) if n]
            exact = _exact_time(clearance, int(pair), np.concatenate([*instants, time[-1:]]), when, found)
        link, _, thing = clearance.pair_names[pair].partition(" & ")
        contacts.append(Contact(time=when, link=link, object=thing, depth=float(-gaps[:, pair].min()), exact_time=exact))
    return sorted(contacts, key=lambda contact: contact.time)


def _spaced(time: Array, q: Array, at: Callable[[Array], Array]) -> tuple[Array, Array]:
    """The instants, and more of them where joints go far from one to the next."""
    for _ in range(_MOST):
        rows = np.flatnonzero(np.abs(np.diff(q, axis=0)).max(axis=1) > SPACING) + 1
        if not rows.size:
            break
        middle = (time[rows - 1] + time[rows]) / 2
        time, q = np.insert(time, rows, middle), np.insert(q, rows, at(middle), axis=0)
    return time, q


def _exact_time(clearance: Clearance, pair: int, instants: Array, after: float, at: Callable[[Array], Array]) -> float:
    """When the bodies of a pair first touch at one of some instants, or between it and the one before; infinite if at none."""
    instants = np.concatenate([[after], instants[instants > after]])
    for start in range(0, len(instants), _AT_ONCE):
        when = instants[start : start + _AT_ONCE]
        hits = clearance.exactness.touches(at(when), pair)
        if hits.any():
            k = start + int(hits.argmax())
            clear, touching = float(instants[max(k - 1, 0)]), float(instants[k])
            for _ in range(_HALVINGS if k else 0):
                middle = (clear + touching) / 2
                if clearance.exactness.touches(at(np.array([middle])), pair)[0]:
                    touching = middle
                else:
                    clear = middle
            return touching
    return float("inf")


def _crossing(clearance: Clearance, pair: int, between: Array, at: Callable[[Array], Array]) -> float:
    """When a pair that is clear at the first of two times and touches at the second first touches, by halving."""
    clear, touching = map(float, between)
    tolerance = SOONEST * max(abs(touching), 1e-12)
    for _ in range(_MOST):
        if touching - clear <= tolerance:
            break
        middle = (clear + touching) / 2
        if clearance.by_pair(at(np.array([middle])))[0, pair] < 0:
            touching = middle
        else:
            clear = middle
    return touching
