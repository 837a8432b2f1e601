"""Views of an arm for figures."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.interface.report.views import SIDE_VIEW, View, choose_side_and_top_views, view_onto_plane
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import plane_normal


def choose_views(arm: Arm, points: NDArray[np.float64]) -> list[View]:
    """Return side and top view of points (..., 3) of an arm; for an arm that moves in a plane the view of that plane."""
    normal = plane_normal(arm)
    return choose_side_and_top_views(points) or [SIDE_VIEW] if normal is None else [view_onto_plane(normal, -arm.gravity)]
