"""Simulated people who operate the joystick; every result made with them states that it is simulated.

The parameters are a plausible population and were never fitted to the paper's statistics. Without a source they are assumed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass, fields

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.teleop.trials.driving import Operator
from holdfast.teleop.trials.stick import Joystick

# _STOP_RADIUS_FRACTION and _RESTART_RADIUS_FRACTION: fractions of the circle's radius at which the joystick is released, and at
# which it is used again
_STOP_RADIUS_FRACTION = 0.6
_RESTART_RADIUS_FRACTION = 0.9
_NOISE_MEMORY_S = 0.2  # correlation time of the noise, s
_DETOUR_DURATION_S = 1.5  # time for which another direction is tried, s
_LOST_DISTANCE_M = 0.05  # increase of the distance to the target over one look-back that counts as moving away, m


@dataclass(frozen=True)
class Person:
    """Steering parameters of one simulated person.

    Attributes:
        delay: Delay from a visual stimulus to the motion of the end effector, s. About 0.24 s for a simple reaction: Card,
            Moran, Newell 1983, the model human processor.
        lag: Time constant of hand and joystick, s, a first-order lag; 0.1 to 0.2 s: McRuer and Jex 1967.
        noise: Standard deviation of the command, as a fraction of its size: Harris and Wolpert 1998, noise grows with the
            signal.
        bias: Angle by which the direction is misjudged throughout a trial, rad; its sign is random in each trial.
        slowing: Time, s, that divides the distance to go to give the speed, within the limit of the joystick.
        look_back: Time over which progress is observed, s. If the end effector moved away from the target or was still, the
            operator leaves the straight path.
        turn: Angle between the straight and the new direction, rad; left and right alternately, larger each time.
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


_PARAMETER_SPREAD = {
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


def sample_people(count: int, seed: int = 0, middle: Person | None = None) -> list[Person]:
    """Sample a number (``count``) of simulated people with a ``seed``.

    Every parameter has a log-normal distribution around that of ``middle`` (default: ``Person()``).

    Raises:
        InputError: ``count`` is below 1.
    """
    if count < 1:
        raise InputError(f"{count} simulated operators are requested; give 1 or more")
    typical = Person() if middle is None else middle
    generator = np.random.default_rng(seed)
    factors = {name: np.exp(generator.normal(0.0, spread, count)) for name, spread in _PARAMETER_SPREAD.items()}
    return [
        Person(**{name: float(getattr(typical, name) * factor[k]) for name, factor in factors.items()}) for k in range(count)
    ]


class SimulatedPeople(Operator):
    """Operator with one simulated person for each trial of a batch.

    Args:
        people: (N,) person who does each trial.
        rate: Control cycles per second, Hz.
        stick: Joystick, whose limit the people know.
        radius: Radius of the target circle, m.
        seed: Seed of the noise and of misjudged directions.
    """

    def __init__(self, people: Sequence[Person], rate: float, stick: Joystick, *, radius: float, seed: int = 0) -> None:
        self._people, self._rate, self._stick, self._radius = list(people), rate, stick, radius
        self._generator = np.random.default_rng(seed)

    def begin(self, x: FloatArray, target: FloatArray) -> None:
        """See :meth:`Operator.begin`."""
        count, m = x.shape
        if count != len(self._people):
            raise InputError(f"there are {len(self._people)} simulated people for {count} trials; give one for each")
        parameters = {
            field.name: np.array([getattr(person, field.name) for person in self._people]) for field in fields(Person)
        }
        self._delay, self._look_back = parameters["delay"] * self._rate, np.maximum(parameters["look_back"] * self._rate, 1.0)
        self._follow_gain = 1 - np.exp(-1 / np.maximum(parameters["lag"] * self._rate, 1e-9))
        self._noise, self._detour_angle = parameters["noise"], parameters["turn"]
        self._slowing, self._give_up_cycles = (
            np.maximum(parameters["slowing"] * self._rate, 1.0),
            parameters["gives_up"] * self._rate,
        )
        self._bias = parameters["bias"] * self._generator.normal(size=count)
        self._bias_direction = self._generator.normal(size=(count, m))  # the plane in which a spatial direction is misjudged
        self._wobble = np.zeros((count, m))
        self._hand = np.zeros((count, m))
        self._stopped = np.zeros(count, dtype=bool)
        self._detour_until, self._detours = np.full(count, -1.0), np.zeros(count, dtype=np.int64)
        self._calm_until = np.zeros(count)
        self._side = np.where(self._generator.random(count) < 0.5, -1.0, 1.0)
        # Values of the last cycles.
        self._seen_positions = np.zeros((3 + int(np.ceil((self._delay + self._look_back).max())), count, m))

    def command_velocity(self, rows: IndexArray, cycle: int, x: FloatArray, *, target: FloatArray) -> FloatArray:
        """See :meth:`Operator.command_velocity`."""
        self._seen_positions[cycle % len(self._seen_positions), rows] = x
        self._update_correlated_noise()
        seen_cycle = cycle - self._delay[rows]
        seen = self._interpolate_seen_positions(rows, seen_cycle)
        earlier = self._interpolate_seen_positions(rows, seen_cycle - self._look_back[rows])
        target_offset = target - seen
        distance = np.linalg.norm(target_offset, axis=1)
        retreat = distance - np.linalg.norm(target - earlier, axis=1)
        self._start_detours(rows, cycle, np.linalg.norm(seen - earlier, axis=1), retreat)
        self._stopped[rows] = np.where(
            self._stopped[rows],
            distance < _RESTART_RADIUS_FRACTION * self._radius,
            distance < _STOP_RADIUS_FRACTION * self._radius,
        )
        detour = np.where(
            cycle < self._detour_until[rows], self._side[rows] * self._detour_angle[rows] * self._detours[rows], 0.0
        )
        direction = _rotate_direction(
            target_offset / np.maximum(distance, 1e-12)[:, None], self._bias[rows] + detour, self._bias_direction[rows]
        )
        speed = np.minimum(self._stick.limit, distance / self._slowing[rows])
        is_steering = (cycle >= self._delay[rows]) & ~self._stopped[rows]
        aimed_velocity = np.where(is_steering[:, None], speed[:, None] * direction, 0.0)
        hand_velocity = self._hand[rows] + self._follow_gain[rows, None] * (aimed_velocity - self._hand[rows])
        self._hand[rows] = hand_velocity
        hand_speed = np.linalg.norm(hand_velocity, axis=1, keepdims=True)
        return np.asarray(hand_velocity + hand_speed * self._noise[rows, None] * self._wobble[rows])

    def gives_up(self, rows: IndexArray, cycle: int) -> NDArray[np.bool_]:
        """See :meth:`Operator.gives_up`."""
        return np.asarray(cycle >= self._give_up_cycles[rows])

    def _interpolate_seen_positions(self, rows: IndexArray, time: FloatArray) -> FloatArray:
        """Return the positions seen at times (K,), in cycles; for times before the start, the start."""
        clipped = np.maximum(time, 0.0)
        cycle_before = np.floor(clipped).astype(np.int64)
        fraction = (clipped - cycle_before)[:, None]
        length = len(self._seen_positions)
        # The fraction is 0 if there is no later cycle yet.
        return np.asarray(
            (1 - fraction) * self._seen_positions[cycle_before % length, rows]
            + fraction * self._seen_positions[(cycle_before + 1) % length, rows]
        )

    def _update_correlated_noise(self) -> None:
        """Update the correlated noise of unit variance for all trials, including those that are over."""
        decay = float(np.exp(-1 / (self._rate * _NOISE_MEMORY_S)))
        innovation = self._generator.normal(size=self._wobble.shape)
        self._wobble = decay * self._wobble + np.sqrt(1 - decay * decay) * innovation

    def _start_detours(self, rows: IndexArray, cycle: int, moved: FloatArray, retreat: FloatArray) -> None:
        """Start a detour in another direction where the straight one makes no progress or leads away from the target.

        Args:
            rows: (K,) indices of the trials in progress.
            cycle: Index of the current cycle.
            moved: (K,) distance of the end effector from its position one look-back ago, m.
            retreat: (K,) increase of the distance to the target since then, m.
        """
        is_established = cycle - self._delay[rows] >= self._look_back[rows]
        may_detour = is_established & (cycle >= self._calm_until[rows]) & ~self._stopped[rows]
        is_lost = may_detour & ((retreat > _LOST_DISTANCE_M) | (moved < 0.1 * _LOST_DISTANCE_M))
        detouring = rows[is_lost]
        self._detours[detouring] += 1
        self._side[detouring] *= -1
        self._detour_until[detouring] = cycle + _DETOUR_DURATION_S * self._rate
        self._calm_until[detouring] = self._detour_until[detouring] + self._look_back[detouring]


def _rotate_direction(direction: FloatArray, angle: FloatArray, reference: FloatArray) -> FloatArray:
    """Rotate unit vectors (K, m) by angles (K,), rad: to the left in the plane, towards ``reference`` in space."""
    if direction.shape[1] == 2:
        normal = np.stack([-direction[:, 1], direction[:, 0]], axis=1)
    else:
        normal = reference - np.einsum("ij,ij->i", reference, direction)[:, None] * direction
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    return np.asarray(np.cos(angle)[:, None] * direction + np.sin(angle)[:, None] * normal)


def rate_comfort(time: ArrayLike, ideal: ArrayLike, steps: int = 4, *, seed: int = 0) -> NDArray[np.int64]:
    """Rate the comfort of trials like a simulated person, from the ratio of their time to the ideal time.

    The first step ends at a ratio of 1.5, and each further step at a ratio that is larger by a factor of 1.6 (with four steps:
    1.5, 2.4, 3.8). All ratios are blurred by a factor of 1.2 up or down (one standard deviation). Assumed, and not fitted.

    Args:
        time: (N,) completion times, any unit; NaN for trials that were not completed, which get the last step.
        ideal: (N,) times of straight motion at full speed, same unit.
        steps: Number of steps of the rating.
        seed: Seed of the blur.

    Returns:
        (N,) ratings, from 0.
    """
    durations, ideal_durations = np.broadcast_arrays(np.asarray(time, dtype=np.float64), np.asarray(ideal, dtype=np.float64))
    noise = np.random.default_rng(seed).normal(0.0, np.log(1.2), durations.shape)
    limits = np.log(1.5) + np.arange(steps - 1) * np.log(1.6)
    with np.errstate(invalid="ignore"):
        log_ratios = np.log(durations / ideal_durations) + noise
        ratings = (log_ratios[..., None] > limits).sum(axis=-1)
    return np.where(np.isnan(log_ratios), steps - 1, ratings)
