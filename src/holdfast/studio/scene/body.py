"""An arm in the scene of a window: a frame for each link, with what is drawn of it below."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.present.arm.body import JOINT, Color, Part

Array = NDArray[np.float64]

LOCKED, FREE = (200, 80, 10), (168, 73, 127)


def quaternions(rotations: Array) -> Array:
    """(N, 4) w, x, y, z of rotations (N, 3, 3)."""
    from viser.transforms import SO3  # SciPy's rotations would double the time to the first picture

    return np.asarray(SO3.from_matrix(rotations).wxyz)


class Figure:
    """An arm in a scene: one frame per link, with its parts below.

    Args:
        scene: A viser scene.
        root: Name of its branch.
        parts: What it is made of.
        frames: How many frames it has.
        tint: RGB in place of the parts' own colours, for ghosts.
        opacity: Below 1 for ghosts.
    """

    def __init__(
        self, scene: Any, root: str, parts: list[Part], frames: int, tint: Color | None = None, opacity: float | None = None
    ) -> None:
        self.companions: list[Figure] = []  # they move along
        self._root = scene.add_frame(root, show_axes=False)
        self._frames = [scene.add_frame(f"{root}/{k}", show_axes=False) for k in range(frames)]
        self.joints: dict[int, list[Any]] = {}
        self._last: Array | None = None
        for number, part in enumerate(parts):
            handle = scene.add_mesh_simple(
                f"{root}/{part.frame}/{number}",
                part.vertices,
                part.faces,
                color=tint or part.color,
                opacity=opacity,
                side="double",
                cast_shadow=False,
                receive_shadow=False,
            )
            if part.joint is not None:
                self.joints.setdefault(part.joint, []).append(handle)

    def move(self, frames: Array) -> None:
        """Put the links where frames (F, 4, 4) say; only those that changed are sent."""
        turns = quaternions(frames[:, :3, :3])
        for k, handle in enumerate(self._frames):
            if self._last is None or not np.array_equal(self._last[k], frames[k]):
                handle.wxyz, handle.position = turns[k], frames[k, :3, 3]
        self._last = frames.copy()
        for figure in self.companions:
            figure.move(frames)

    def paint(self, joint: int, condition: str) -> None:
        """Show a joint as healthy, locked or free."""
        color = {"locked": LOCKED, "free": FREE}.get(condition, JOINT)
        for handle in self.joints.get(joint, []):
            if tuple(handle.color) != color:
                handle.color = color

    def remove(self) -> None:
        """Take it out of the scene."""
        self._root.remove()
