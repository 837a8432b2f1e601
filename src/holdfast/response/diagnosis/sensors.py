"""Accuracy of the sensors of an arm."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass

from holdfast.core.errors import InputError
from holdfast.core.validation import check_constructor


@check_constructor
@dataclass(frozen=True)
class Sensors:
    """Accuracy of the sensors of an arm.

    Attributes:
        position: Standard deviation of the measured tool point, m.
        angle: Standard deviation of the measured tool orientation, rad.
        joint: Standard deviation of a joint sensor, rad or m.
        latency: Delay from the measurement of a tool pose to its arrival at the monitor, s. In a log, a pose is instead in
            the row of the time at which it was taken.

    Raises:
        InputError: A deviation is not above 0, or the latency is not between 0 and 1 s.
    """

    position: float = 0.5e-3
    angle: float = 1e-3
    _: KW_ONLY
    joint: float = 2e-5
    latency: float = 0.0

    def __post_init__(self) -> None:
        for name in ("position", "angle", "joint"):
            if not getattr(self, name) > 0:
                raise InputError(f"the deviation of '{name}' is {getattr(self, name):g}; it must be above 0")
        if not 0 <= self.latency <= 1:
            raise InputError(f"latency is {self.latency:g} s; it must be 0 to 1 s")
