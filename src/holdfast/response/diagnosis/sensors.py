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
        angle: Of its orientation, rad.
        joint: Of a joint sensor, rad or m.
        latency: s, by which a pose reaches the monitor after it was taken. Records have it in the row of its time instead.

    Raises:
        InputError: A deviation that is not above 0, or a latency that is not 0 to 1 s.
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
