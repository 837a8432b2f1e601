"""Simulated people at the stick. They are no people: every result made with them says "simulated".

The parameters are a plausible population, never fitted to the paper's statistics. Where no source is named they are assumed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass, fields

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.errors import InputError
from holdfast.teleop.trials.driving import Operator
from holdfast.teleop.trials.stick import Stick

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_STOPS, _STARTS_AGAIN = 0.6, 0.9  # of the circle's radius: where the stick is released, and where it is used again
_NOISE_MEMORY = 0.2  # s
_HELD = 1.5  # s: how long another direction is tried
_LOST = 0.05  # m: farther from the target by so much than one look-back ago is "moving away"


@dataclass(frozen=True)
class Person:
    """How one simulated person steers.

    Attributes:
        delay: From what is seen to what the end effector begins to do, s. About 0.24 s for a simple reaction: Card,
            Moran, Newell 1983, the model human processor.
        lag: Time constant of hand and stick, s: a first-order lag; 0.1 to 0.2 s: McRuer and Jex 1967.
        noise: Standard deviation of the command, as a fraction of its size: Harris and Wolpert 1998, noise grows with the
            signal.
        bias: The direction is misjudged by this angle throughout a trial, rad; drawn anew, with its sign, for each trial.
        slowing: The speed is the distance to go divided by this time, s, within the limit of the stick.
        look_back: If the end effector is farther from the target than this long ago, s, or was still, the straight way is
            given up ...
        turn: ... for a while, for one turned away by this angle, rad; left and right by turns, farther each time.
        gives_up: Time after which the trial is aborted, s.
    """

    delay: float = 0.24
    lag: float = 0.15
    noise: float = 0.1
    _: KW_ONLY
    bias: float = 0.09
    slowing: float = 0.8
    look_back: float = 1.0
    turn: float = 0.8
    gives_up: float = 180.0

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if not (np.isfinite(value) and value >= 0):
                raise InputError(f"a simulated person's {field.name} is {value:g}; it must be 0 or more")


_SPREAD = {
    "delay": 0.15,
    "lag": 0.25,
    "noise": 0.3,
    "bias": 0.4,
    "slowing": 0.25,
    "look_back": 0.3,
    "turn": 0.3,
    "gives_up": 0.3,
}
"""Standard deviation of the logarithm of each parameter between people; assumed."""


def population(count: int, seed: int = 0, middle: Person | None = None) -> list[Person]:
    """Simulated people, each different: every parameter is log-normal around that of ``middle``.

    Raises:
        InputError: Fewer than one person.
    """
    if count < 1:
        raise InputError(f"{count} simulated operators were asked for; give 1 or more")
    typical = Person() if middle is None else middle
    generator = np.random.default_rng(seed)
    factors = {name: np.exp(generator.normal(0.0, spread, count)) for name, spread in _SPREAD.items()}
    return [Person(**{name: float(getattr(typical, name) * f[k]) for name, f in factors.items()}) for k in range(count)]


class SimulatedPeople(Operator):
    """One simulated person for each trial of a batch.

    Args:
        people: (N,) who does each trial.
        rate: Control cycles per second.
        stick: Whose limit they know.
        radius: Of the target circle, m.
        seed: Of the noise and of misjudged directions.
    """

    def __init__(self, people: Sequence[Person], rate: float, stick: Stick, *, radius: float, seed: int = 0) -> None:
        self._people, self._rate, self._stick, self._radius = list(people), rate, stick, radius
        self._generator = np.random.default_rng(seed)

    def begin(self, x: Array, target: Array) -> None:
        """See :meth:`Operator.begin`."""
        count, m = x.shape
        if count != len(self._people):
            raise InputError(f"there are {len(self._people)} simulated people for {count} trials; give one for each")
        of = {f.name: np.array([getattr(p, f.name) for p in self._people]) for f in fields(Person)}
        self._delay, self._look_back = of["delay"] * self._rate, np.maximum(of["look_back"] * self._rate, 1.0)
        self._follow = 1 - np.exp(-1 / np.maximum(of["lag"] * self._rate, 1e-9))
        self._noise, self._turn = of["noise"], of["turn"]
        self._slowing, self._most = np.maximum(of["slowing"] * self._rate, 1.0), of["gives_up"] * self._rate
        self._bias = of["bias"] * self._generator.normal(size=count)
        self._aside = self._generator.normal(size=(count, m))  # the plane in which a spatial direction is misjudged
        self._wobble = np.zeros((count, m))
        self._hand = np.zeros((count, m))
        self._stopped = np.zeros(count, dtype=bool)
        self._detour_until, self._detours = np.full(count, -1.0), np.zeros(count, dtype=np.int64)
        self._calm_until = np.zeros(count)
        self._side = np.where(self._generator.random(count) < 0.5, -1.0, 1.0)
        self._seen = np.zeros((3 + int(np.ceil((self._delay + self._look_back).max())), count, m))  # of the last cycles

    def wanted(self, rows: Indices, cycle: int, x: Array, *, target: Array) -> Array:
        """See :meth:`Operator.wanted`."""
        self._seen[cycle % len(self._seen), rows] = x
        self._shake()
        then = cycle - self._delay[rows]
        seen, before = self._at(rows, then), self._at(rows, then - self._look_back[rows])
        to_go = target - seen
        distance = np.linalg.norm(to_go, axis=1)
        lost_ground = distance - np.linalg.norm(target - before, axis=1)
        self._reconsider(rows, cycle, np.linalg.norm(seen - before, axis=1), lost_ground)
        self._stopped[rows] = np.where(
            self._stopped[rows], distance < _STARTS_AGAIN * self._radius, distance < _STOPS * self._radius
        )
        detour = np.where(cycle < self._detour_until[rows], self._side[rows] * self._turn[rows] * self._detours[rows], 0.0)
        direction = _turned(to_go / np.maximum(distance, 1e-12)[:, None], self._bias[rows] + detour, self._aside[rows])
        speed = np.minimum(self._stick.limit, distance / self._slowing[rows])
        begun = (cycle >= self._delay[rows]) & ~self._stopped[rows]
        aim = np.where(begun[:, None], speed[:, None] * direction, 0.0)
        hand = self._hand[rows] + self._follow[rows, None] * (aim - self._hand[rows])
        self._hand[rows] = hand
        size = np.linalg.norm(hand, axis=1, keepdims=True)
        return np.asarray(hand + size * self._noise[rows, None] * self._wobble[rows])

    def gives_up(self, rows: Indices, cycle: int) -> NDArray[np.bool_]:
        """See :meth:`Operator.gives_up`."""
        return np.asarray(cycle >= self._most[rows])

    def _at(self, rows: Indices, time: Array) -> Array:
        """What was to be seen at a time (K,), cycles; from before the start only the start."""
        past = np.maximum(time, 0.0)
        low = np.floor(past).astype(np.int64)
        fraction = (past - low)[:, None]
        length = len(self._seen)
        # The fraction is 0 where there is no later cycle yet.
        return np.asarray((1 - fraction) * self._seen[low % length, rows] + fraction * self._seen[(low + 1) % length, rows])

    def _shake(self) -> None:
        """Noise of unit variance that lasts for a while, for all trials, whether they are over or not."""
        keep = float(np.exp(-1 / (self._rate * _NOISE_MEMORY)))
        fresh = self._generator.normal(size=self._wobble.shape)
        self._wobble = keep * self._wobble + np.sqrt(1 - keep * keep) * fresh

    def _reconsider(self, rows: Indices, cycle: int, moved: Array, lost_ground: Array) -> None:
        """Begin another direction where the straight one leads away, or nowhere.

        Args:
            rows: (K,) trials under way.
            cycle: Now.
            moved: (K,) how far the end effector is from where it was one look-back ago, m.
            lost_ground: (K,) by how much it is farther from the target, m.
        """
        watched = cycle - self._delay[rows] >= self._look_back[rows]
        free = watched & (cycle >= self._calm_until[rows]) & ~self._stopped[rows]
        lost = free & ((lost_ground > _LOST) | (moved < 0.1 * _LOST))
        tired = rows[lost]
        self._detours[tired] += 1
        self._side[tired] *= -1
        self._detour_until[tired] = cycle + _HELD * self._rate
        self._calm_until[tired] = self._detour_until[tired] + self._look_back[tired]


def _turned(direction: Array, angle: Array, aside: Array) -> Array:
    """Unit vectors (K, m) turned by angles (K,): to the left in the plane, towards ``aside`` in space."""
    if direction.shape[1] == 2:
        across = np.stack([-direction[:, 1], direction[:, 0]], axis=1)
    else:
        across = aside - np.einsum("ij,ij->i", aside, direction)[:, None] * direction
        across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-12)
    return np.asarray(np.cos(angle)[:, None] * direction + np.sin(angle)[:, None] * across)


def rate(time: ArrayLike, ideal: ArrayLike, steps: int = 4, *, seed: int = 0) -> NDArray[np.int64]:
    """What a simulated person says about the comfort of trials: by how many times the ideal time they took.

    The first step ends at 1.5 times, each further one 1.6 times later (with four steps: 1.5, 2.4, 3.8), all blurred by a
    factor of 1.2 up or down (one standard deviation). Assumed, and not fitted.

    Args:
        time: (N,) completion times, any unit; NaN where the trial was not completed: the last step.
        ideal: (N,) times straight at full speed.
        steps: Of the rating.
        seed: Of the blur.

    Returns:
        (N,) steps from 0.
    """
    taken, least = np.broadcast_arrays(np.asarray(time, dtype=np.float64), np.asarray(ideal, dtype=np.float64))
    blur = np.random.default_rng(seed).normal(0.0, np.log(1.2), taken.shape)
    limits = np.log(1.5) + np.arange(steps - 1) * np.log(1.6)
    with np.errstate(invalid="ignore"):
        felt = np.log(taken / least) + blur
        level = (felt[..., None] > limits).sum(axis=-1)
    return np.where(np.isnan(felt), steps - 1, level)
