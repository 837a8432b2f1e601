"""Joystick: from its deflection to the commanded velocity."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray


@dataclass(frozen=True)
class Joystick:
    """Joystick for rate control: outside a dead zone, the commanded velocity is proportional to the deflection.

    Velocities outside the dead zone are not rescaled.

    Attributes:
        limit: Speed at full deflection, m/cycle.
        dead_zone: Radius of the dead zone, m/cycle; slower commands become 0.

    Raises:
        InputError: The limit is not above 0, or the dead zone is negative or not below the limit.

    Source: Goel et al. 2003, section 4.
    """

    limit: float = 0.05
    dead_zone: float = 0.005

    def __post_init__(self) -> None:
        if not (np.isfinite(self.limit) and self.limit > 0):
            raise InputError(f"the joystick's limit is {self.limit:g} m/cycle; it must be above 0")
        if not 0 <= self.dead_zone < self.limit:
            raise InputError(
                f"the dead zone is {self.dead_zone:g} m/cycle; it must be 0 or more, and below the limit of {self.limit:g}"
            )

    def command_velocity(self, deflection: ArrayLike) -> FloatArray:
        """Return the commanded velocity (..., m), m/cycle, of a ``deflection`` (..., m) from -1 to 1, 0 in the middle."""
        return self.limit_velocity(self.limit * np.asarray(deflection, dtype=np.float64))

    def limit_velocity(self, velocity: ArrayLike) -> FloatArray:
        """Apply dead zone and limit to a ``velocity`` (..., m), m/cycle."""
        v = np.asarray(velocity, dtype=np.float64)
        speed = np.linalg.norm(v, axis=-1, keepdims=True)
        factor = np.where(speed > self.limit, self.limit / np.maximum(speed, self.limit), 1.0)
        return np.asarray(np.where(speed < self.dead_zone, 0.0, v * factor))
