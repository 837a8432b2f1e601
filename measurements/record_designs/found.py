"""Result of an evolution strategy: an arm and its value."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.core.typing import FloatArray
from holdfast.model.arm.model import Arm
from holdfast.model.arms.dh_file import format_dh_file
from holdfast.studies.designs.space import DesignSpace


@dataclass(frozen=True, kw_only=True, eq=False)
class EvolvedDesign:
    """Best arm that an evolution strategy found.

    Attributes:
        space: What was varied.
        objective: ``self-motion-size``, in whole turns, or ``tolerant-workspace``, in m^2.
        values: (k,) of the arm, rad and m.
        value: What it is worth.
        given: What the given arm is worth, with its own best configuration or limits.
        bound: No arm of the space has more; for workspaces none whose first joint has no limits.
        q: (n,) rad, a configuration on the curve; None for workspaces.
        winding: (n,) whole turns of each joint on the curve; None for workspaces.
        limits: (n, 2) artificial limits that hold until a joint locks, rad; None for self-motions.
        history: (G,) the best value after each generation.
        seed: Of the search.
        seconds: What it took.
    """

    space: DesignSpace
    objective: str
    values: FloatArray
    value: float
    given: float
    bound: float
    q: FloatArray | None = None
    winding: NDArray[np.int64] | None = None
    limits: FloatArray | None = None
    history: FloatArray
    seed: int
    seconds: float

    @property
    def unit(self) -> str:
        """Unit of the value."""
        return "whole turns" if self.objective == "self-motion-size" else "m^2"

    def arm(self) -> Arm:
        """Return the arm, without inertial data."""
        return self.space.arm_of(self.values)

    def arm_file(self) -> str:
        """Return the arm as a file that every command reads."""
        arm = self.arm()
        return format_dh_file(self.space.table_of(self.values), arm.name, arm.gravity, arm.source)

    def describe(self) -> list[str]:
        """Return the value of the arm, compared with the baseline arm and the upper bound."""
        lines = [
            f"{self.objective}: {self.value:.6g} {self.unit}, the given arm {self.given:.4g}; no arm of these bounds has more "
            f"than {self.bound:.6g} {self.unit}"
        ]
        if self.q is not None and self.winding is not None:
            revolutions = ", ".join(f"{x:+d}" for x in self.winding)
            configuration_text = ", ".join(f"{x:.4f}" for x in self.q)
            lines.append(
                f"on one curve of the pose at q = {configuration_text} rad; whole turns on the way round: {revolutions}"
            )
        if self.limits is not None:
            limits_text = ", ".join(f"{a:.1f} to {b:.1f}" for a, b in np.degrees(self.limits))
            lines.append(
                f"until a joint locks the joints stay within {limits_text} deg; the bound is for arms whose joint 1 "
                f"has no limits"
            )
        return lines
