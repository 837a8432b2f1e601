"""Orthographic projections of 3-D geometry, shared by all figures."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import FloatArray

_SIDE_VIEW_ASPECT = 1.5  # ratio of the extents along y and x above which the side view is along x


@dataclass(frozen=True, eq=False)
class View:
    """Orthographic projection along one direction.

    Attributes:
        right, up: Unit vectors (3,) that point to the right and upward in the figure.
        title: Title of a panel with this projection.
    """

    right: FloatArray
    up: FloatArray
    title: str

    def project(self, points: FloatArray) -> FloatArray:
        """Project points (..., 3) to coordinates (..., 2) to the right and up, m."""
        return np.stack([points @ self.right, points @ self.up], axis=-1)

    @property
    def names(self) -> tuple[str, str]:
        """Labels of the horizontal and the vertical axis, with the unit."""
        return f"{axis_name(self.right)}, m", f"{axis_name(self.up)}, m"


def choose_side_and_top_views(points: FloatArray, titles: tuple[str, str] = ("Side view", "Top view")) -> list[View]:
    """Return the side and top views of points (..., 3), the side view being the wider one, without views that show
    only a line.
    """
    x, y, z = np.eye(3)
    size = np.ptp(points.reshape(-1, 3), axis=0)
    is_flat = size < 1e-6 * max(float(size.max()), 1e-6)
    across = y if size[1] > _SIDE_VIEW_ASPECT * size[0] else x
    views = [View(across, z, titles[0]), View(x, y, titles[1])]
    return [view for view in views if not any(is_flat @ np.abs([view.right, view.up]).T)]


SIDE_VIEW = View(np.eye(3)[0], np.eye(3)[2], "Side view")


def view_onto_plane(normal: FloatArray, up: FloatArray) -> View:
    """Return the view along a normal (3,), with ``up`` (3,) upward, or y or x where ``up`` is parallel to the normal."""
    x, y, _ = np.eye(3)
    upward = up - normal * (normal @ up)
    if np.linalg.norm(upward) < 1e-6 * max(float(np.linalg.norm(up)), 1e-12):
        upward = y - normal * normal[1] if abs(normal[1]) < 0.9 else x - normal * normal[0]
    upward = upward / np.linalg.norm(upward)
    return View(np.cross(upward, normal), upward, "In the plane of the arm")


def axis_name(direction: FloatArray) -> str:
    """Return the name of a direction: a world axis, or its components."""
    for name, axis in zip("xyz", np.eye(3), strict=True):
        if abs(direction @ axis) > 1 - 1e-9:
            return name if direction @ axis > 0 else f"-{name}"
    return "along (" + ", ".join(f"{x:.2f}" for x in direction) + ")"
