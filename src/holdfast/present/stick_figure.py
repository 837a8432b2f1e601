"""How an arm is seen."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import plane_normal
from holdfast.report.views import SIDE, View, onto_plane, sides


def views_of(arm: Arm, points: NDArray[np.float64]) -> list[View]:
    """Side and top view of points (..., 3) of an arm; of one that moves in a plane, that plane."""
    normal = plane_normal(arm)
    return sides(points) or [SIDE] if normal is None else [onto_plane(normal, -arm.gravity)]
