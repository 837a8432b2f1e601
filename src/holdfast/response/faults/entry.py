"""Entry of a fault model: a family of faults with its joints, times, and parameters, which may be random."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field
from typing import Any, TypedDict

from holdfast.core.errors import InputError
from holdfast.response.faults.kind import FaultParameter, find_kind

DISTRIBUTION_LAWS = ("uniform", "loguniform", "exponential", "choice")
_ACCEPTED_FORMS = "a number, uniform: [a, b], loguniform: [a, b], exponential: MEAN or choice: [a, b, ...]"


@dataclass(frozen=True)
class ParameterDistribution:
    """Fixed number, or the distribution from which it is sampled."""

    law: str  # ``number`` or one of :data:`DISTRIBUTION_LAWS`
    numbers: tuple[float, ...]  # the number; both ends; the mean; the choices

    @classmethod
    def from_value(cls, value: Any, quantity_name: str) -> ParameterDistribution:
        """Return the distribution from a number, two numbers in a tuple (uniform), or ``{law: numbers}``.

        Args:
            value: Number, tuple, or mapping from a caller or a file.
            quantity_name: Name of the quantity in error messages.

        Raises:
            InputError: The value has another form, a number is not finite, or the ends are reversed.
        """
        if isinstance(value, ParameterDistribution):
            return value
        law, content = "number", value
        if isinstance(value, Mapping):
            if len(value) != 1 or next(iter(value)) not in DISTRIBUTION_LAWS:
                raise InputError(
                    f"{quantity_name} has the keys {', '.join(map(str, value)) or 'of nothing'}; it must be {_ACCEPTED_FORMS}"
                )
            ((law, content),) = value.items()
        elif isinstance(value, tuple):
            law = "uniform"
        has_one_number = law in ("number", "exponential")
        if not has_one_number and (not isinstance(content, Sequence) or isinstance(content, str)):
            raise InputError(f"{quantity_name} is {value!r}; it must be {_ACCEPTED_FORMS}")
        numbers = tuple(_parse_number(item, quantity_name) for item in ([content] if has_one_number else content))
        if law in ("uniform", "loguniform"):
            if len(numbers) != 2:
                raise InputError(f"{quantity_name} has {len(numbers)} numbers for '{law}'; give both ends, the lower one first")
            if numbers[0] > numbers[1]:
                raise InputError(f"{quantity_name} is from {numbers[0]:g} to {numbers[1]:g}; give the lower end first")
            if law == "loguniform" and numbers[0] <= 0:
                raise InputError(f"{quantity_name} is loguniform from {numbers[0]:g}; both ends must be above 0")
        if law == "exponential" and numbers[0] <= 0:
            raise InputError(f"{quantity_name} has the mean {numbers[0]:g}; the mean of an exponential law must be above 0")
        if not numbers:
            raise InputError(f"{quantity_name} has nothing to choose from; give at least one number")
        return cls(law, numbers)

    @property
    def ends(self) -> tuple[float, float]:
        """Smallest and largest number that may be sampled."""
        return (0.0, math.inf) if self.law == "exponential" else (min(self.numbers), max(self.numbers))

    def at(self, uniform_value: float) -> float:
        """Return the sample that belongs to a uniform number of [0, 1)."""
        lower, upper = self.numbers[0], self.numbers[-1]
        match self.law:
            case "uniform":
                return lower + (upper - lower) * uniform_value
            case "loguniform":
                return float(lower * (upper / lower) ** uniform_value)
            case "exponential":
                return exponential_quantile(lower, uniform_value)
            case _:
                return self.numbers[int(uniform_value * len(self.numbers))]

    def stored(self) -> Any:
        """Return the distribution as files store it."""
        if self.law == "number":
            return self.numbers[0]
        return {self.law: self.numbers[0] if self.law == "exponential" else list(self.numbers)}


def exponential_quantile(mean: float, uniform_value: float) -> float:
    """Return the sample of the exponential distribution that belongs to a uniform number of [0, 1)."""
    return -mean * math.log1p(-uniform_value)


def _parse_number(value: Any, quantity_name: str) -> float:
    try:
        if isinstance(value, bool):
            raise ValueError
        number = float(value)  # accepts text, because YAML 1.1 reads 1e-3 as text
    except OverflowError as error:  # integers of Python may have any number of digits
        raise InputError(f"{quantity_name} is a whole number beyond 1e308; it must be finite") from error
    except (TypeError, ValueError) as error:
        raise InputError(f"{quantity_name} is {value!r}; it must be {_ACCEPTED_FORMS}") from error
    if not math.isfinite(number):
        raise InputError(f"{quantity_name} is {number:g}; it must be finite")
    return number


Joints = str | Sequence[str] | None
Value = float | tuple[float, float] | Mapping[str, float | Sequence[float]] | ParameterDistribution
_TIME_PARAMETERS = {name: FaultParameter(name, 0.0) for name in ("onset", "duration")}


class FaultTiming(TypedDict, total=False):
    """Options that every kind of fault accepts."""

    weights: Sequence[float] | None
    probability: float
    onset: Value | None
    duration: Value | None
    rate_per_hour: float | None
    together: int
    on: float | None
    off: float | None


@dataclass(frozen=True)
class Fault:
    """Entry of a fault model: a family of faults. Functions such as :func:`holdfast.response.faults.locked` create one.

    A number may be random, with a new sample in every episode. A tuple ``(a, b)`` and ``{"uniform": [a, b]}`` are uniform
    between a and b, ``{"loguniform": [a, b]}`` is uniform in the logarithm, ``{"exponential": mean}`` is exponential, and
    ``{"choice": [a, b, ...]}`` takes one of the numbers.

    Attributes:
        kind: Name of the kind of fault; see :func:`holdfast.response.faults.locked` and the others.
        parameters: Parameters of the kind by name, in rad, N m, rad/s (m, N, m/s for prismatic joints).
        joints: Name or names of the joints that can have the fault. None: any joint.
        weights: Relative probability of each of ``joints``. None: all equal.
        probability: Probability of the fault in an episode.
        onset: Time of the onset, s.
        duration: Duration of the fault, s. None: permanent.
        rate_per_hour: Constant failure rate, 1/h, instead of ``onset``.
        together: Number of joints that have the fault at once.
        on, off: Mean times with and without an intermittent fault, s. None: not intermittent.

    Raises:
        InputError: A kind, parameter or distribution is unknown, a number is out of bounds, or options exclude each other.
    """

    kind: str
    parameters: Mapping[str, Any] = field(default_factory=dict)
    joints: Sequence[str] | str | None = None
    _: KW_ONLY
    weights: Sequence[float] | None = None
    probability: float = 1.0
    onset: Any = None
    duration: Any = None
    rate_per_hour: float | None = None
    together: int = 1
    on: float | None = None
    off: float | None = None

    def __post_init__(self) -> None:
        find_kind(self.kind)
        self._assign_field("joints", (self.joints,) if isinstance(self.joints, str) else self.joints and tuple(self.joints))
        self._assign_field("weights", self.weights and tuple(map(float, self.weights)))
        self._check_joints()
        self._assign_field("parameters", self._read_parameters())
        self._check_time()

    def _assign_field(self, name: str, value: Any) -> None:
        object.__setattr__(self, name, value)

    def _check_joints(self) -> None:
        if self.joints is not None and not (self.joints and len(set(self.joints)) == len(self.joints)):
            raise InputError(f"joints of '{self.kind}' are {list(self.joints)}; name each once, or leave them out for all")
        if self.weights is not None:
            if self.joints is None or len(self.weights) != len(self.joints):
                raise InputError(f"'{self.kind}' has {len(self.weights)} weights; give one for each of its joints, by name")
            if not all(math.isfinite(weight) and weight >= 0 for weight in self.weights) or not any(self.weights):
                raise InputError(f"weights of '{self.kind}' are {list(self.weights)}; they must be 0 or more, one above 0")
        max_joints = len(self.joints) if self.joints else math.inf
        if self.weights:
            max_joints = sum(weight > 0 for weight in self.weights)
        if isinstance(self.together, bool) or self.together != int(self.together) or not 1 <= self.together <= max_joints:
            raise InputError(f"together of '{self.kind}' is {self.together}; it is a whole number, 1 to that of its joints")

    def _read_parameters(self) -> dict[str, Any]:
        given = {name: value for name, value in self.parameters.items() if value is not None}
        kind = find_kind(self.kind)
        known = kind.parameters_by_name
        for name in given:
            if name not in known:
                allowed_text = f"takes {', '.join(known)}" if known else "takes no parameter"
                raise InputError(f"'{self.kind}' has no parameter '{name}'; it {allowed_text}")
        given = {name: parameter.word for name, parameter in known.items() if parameter.word is not None} | given
        alternatives = [[parameter.name for parameter in alternative] for alternative in kind.parameters]
        if alternatives and not any(given and set(given) <= set(names) for names in alternatives):
            raise InputError(f"'{self.kind}' must have {' or '.join(' and '.join(names) for names in alternatives)}")
        # In the order of the kind, so that the random numbers do not depend on the order of the caller.
        return {
            name: parameter.word if given[name] == parameter.word else self._parse_bounded(parameter, given[name])
            for name, parameter in known.items()
            if name in given
        }

    def _parse_bounded(self, parameter: FaultParameter, value: Any) -> ParameterDistribution:
        name, minimum, maximum = parameter.name, parameter.low, parameter.high
        distribution = ParameterDistribution.from_value(value, f"{name} of '{self.kind}'")
        lower, upper = distribution.ends
        is_inside = minimum < lower and (upper < maximum or math.isinf(maximum))
        if parameter.includes_ends:
            is_inside = minimum <= lower and upper <= maximum
        if distribution.law == "exponential":
            is_inside = math.isinf(maximum)
        if not is_inside:
            expected_text = "0 or more" if parameter.includes_ends else f"above {minimum:g}"
            if math.isfinite(maximum):
                expected_text = f"between {minimum:g} and {maximum:g}"
            sign_text = "; its sign is random" if parameter.has_random_sign else ""
            range_text = f"{lower:g}" if lower == upper else f"from {lower:g} to {upper:g}"
            raise InputError(f"{name} of '{self.kind}' is {range_text}; it must be {expected_text}{sign_text}")
        return distribution

    def _check_time(self) -> None:
        if not (isinstance(self.probability, (int, float)) and 0 <= self.probability <= 1):
            raise InputError(f"probability of '{self.kind}' is {self.probability}; it must be between 0 and 1")
        for name in ("rate_per_hour", "on", "off"):
            value = getattr(self, name)
            if value is not None and not (math.isfinite(value) and value > 0):
                raise InputError(f"{name} of '{self.kind}' is {value:g}; it must be a finite number above 0")
        if self.rate_per_hour is not None and self.onset is not None:
            raise InputError(f"'{self.kind}' has both onset and rate_per_hour; give one of them, as the rate sets the onset")
        if (self.on is None) != (self.off is None):
            raise InputError(f"'{self.kind}' has only one of on and off; a fault that comes and goes has both")
        onset = 0.0 if self.onset is None else self.onset
        self._assign_field("onset", None if self.rate_per_hour else self._parse_bounded(_TIME_PARAMETERS["onset"], onset))
        if self.duration is not None:
            self._assign_field("duration", self._parse_bounded(_TIME_PARAMETERS["duration"], self.duration))

    def to_stored(self) -> dict[str, Any]:
        """Return the entry as files store it, without default values."""
        data: dict[str, Any] = {"kind": self.kind}
        has_onset = self.onset is not None and self.onset != ParameterDistribution("number", (0.0,))
        values = {
            "joints": self.joints and list(self.joints),
            "weights": self.weights and list(self.weights),
            "probability": None if self.probability == 1 else self.probability,
            "together": None if self.together == 1 else self.together,
            "rate_per_hour": self.rate_per_hour,
            "onset": self.onset.stored() if has_onset else None,
            "duration": self.duration and self.duration.stored(),
            "on": self.on,
            "off": self.off,
            **{name: value.stored() for name, value in self.parameters.items() if not isinstance(value, str)},
        }
        return data | {name: value for name, value in values.items() if value is not None}
