"""Arm in the scene of a window: a frame for each link, with its bodies as children."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.body import JOINT_COLOR_RGB, Color, MeshPart

LOCKED_RGB = (200, 80, 10)
FREE_RGB = (168, 73, 127)


def to_quaternions(rotations: FloatArray) -> FloatArray:
    """Convert rotations (N, 3, 3) to quaternions (N, 4), w, x, y, z."""
    from viser.transforms import SO3  # SciPy's rotations would double the time to the first picture

    return np.asarray(SO3.from_matrix(rotations).wxyz)


class ArmFigure:
    """Arm in a scene: one frame per link, with its parts as children.

    Args:
        scene: Viser scene.
        root: Name of the arm's branch in the scene.
        parts: Meshes of the arm.
        frames: Number of frames of the arm.
        tint: RGB colour that replaces the parts' own colours, for ghosts.
        opacity: Opacity, below 1 for ghosts.
    """

    def __init__(
        self, scene: Any, root: str, parts: list[MeshPart], frames: int, tint: Color | None = None, opacity: float | None = None
    ) -> None:
        self.companions: list[ArmFigure] = []  # further figures that move with this one
        self._root = scene.add_frame(root, show_axes=False)
        self._frames = [scene.add_frame(f"{root}/{link}", show_axes=False) for link in range(frames)]
        self.joints: dict[int, list[Any]] = {}
        self._last_frames: FloatArray | None = None
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

    def move_links(self, frames: FloatArray) -> None:
        """Move the links to their frames (F, 4, 4); only changed frames are sent."""
        orientations = to_quaternions(frames[:, :3, :3])
        for link, handle in enumerate(self._frames):
            if self._last_frames is None or not np.array_equal(self._last_frames[link], frames[link]):
                handle.wxyz, handle.position = orientations[link], frames[link, :3, 3]
        self._last_frames = frames.copy()
        for figure in self.companions:
            figure.move_links(frames)

    def paint_joint(self, joint: int, condition: str) -> None:
        """Show a joint as healthy, locked or free."""
        color = {"locked": LOCKED_RGB, "free": FREE_RGB}.get(condition, JOINT_COLOR_RGB)
        for handle in self.joints.get(joint, []):
            if tuple(handle.color) != color:
                handle.color = color

    def remove(self) -> None:
        """Remove the arm from the scene."""
        self._root.remove()
