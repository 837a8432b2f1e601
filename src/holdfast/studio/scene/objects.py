"""The cell in the scene of a window: objects that can be dragged, and where the arm comes nearest to one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.poses import pose_of
from holdfast.errors import InputError
from holdfast.present.cell.bodies import NEAREST, OBJECT, body
from holdfast.studio.scene.body import quaternions
from holdfast.studio.scene.machine import Machine, sentence

Array = NDArray[np.float64]
Moved = Sequence[tuple[str, Sequence[float]]]


class Objects:
    """The objects of one window.

    Args:
        scene: The window's viser scene.
        machine: The arm and its cell.
        moved: Objects that are elsewhere, with x, y, z and quaternion x, y, z, w.
        ask: ``ask("pick", name)`` when an object is clicked, ``ask("object", (name, numbers))`` when it is dragged.
    """

    def __init__(self, scene: Any, machine: Machine, moved: Moved, ask: Callable[[str, Any], None]) -> None:
        assert machine.cell is not None
        self._machine, self._picked = machine, ""
        self._clear = machine.clearance(moved)
        self._handles: dict[str, Any] = {}
        self._poses: dict[str, Array] = {}
        for number, solid in enumerate(machine.cell):
            vertices, faces = body(solid, machine.size)
            handle = scene.add_mesh_simple(
                f"/cell/{number}", vertices, faces, color=OBJECT, side="double", cast_shadow=False, receive_shadow=False
            )
            scene.add_label(f"/cell/{number}/name", solid.name, font_screen_scale=0.85)
            self._handles[solid.name] = handle
            self._put(solid.name, solid.pose)
            self._when_clicked(handle, solid.name, ask)
        for name, numbers in moved:
            self._put(name, pose_of(np.array(numbers[:3]), np.array(numbers[3:])))
        self.gizmo = scene.add_transform_controls("/drag", scale=0.2 * machine.size, depth_test=False, visible=False)
        self._when_dragged(ask)
        self._line = scene.add_line_segments("/nearest", np.zeros((1, 2, 3)), NEAREST, thickness=0.008 * machine.size)

    def _when_clicked(self, handle: Any, name: str, ask: Callable[[str, Any], None]) -> None:
        async def told(_: Any) -> None:
            ask("pick", name)

        handle.on_click(told)

    def _when_dragged(self, ask: Callable[[str, Any], None]) -> None:
        async def told(event: Any) -> None:
            if event.client is not None and self._picked:
                w, x, y, z = (float(v) for v in event.target.wxyz)
                ask("object", (self._picked, (*(float(v) for v in event.target.position), x, y, z, w)))

        self.gizmo.on_update(told)

    def _put(self, name: str, pose: Array) -> None:
        handle, self._poses[name] = self._handles[name], pose
        handle.position, handle.wxyz = pose[:3, 3], quaternions(pose[None, :3, :3])[0]

    def pick(self, name: str) -> None:
        """Show the handle of an object, or hide it where it is shown."""
        self._picked = "" if name == self._picked else name
        self.gizmo.visible = bool(self._picked)
        if self._picked:
            pose = self._poses[name]
            self.gizmo.position, self.gizmo.wxyz = pose[:3, 3], quaternions(pose[None, :3, :3])[0]

    def move(self, name: str, numbers: Sequence[float], moved: Moved) -> None:
        """Put an object elsewhere; ``moved`` are those that were before."""
        self._put(name, pose_of(np.array(numbers[:3]), np.array(numbers[3:])))
        try:
            self._clear = self._machine.clearance([*(x for x in moved if x[0] != name), (name, numbers)])
            self._wrong = ""
        except InputError as error:
            self._wrong = sentence(error)

    _wrong = ""

    def read(self, q: Array) -> tuple[str, bool]:
        """What is nearest at q (n,), in words, and whether it is too near; the scene shows where."""
        if self._wrong or self._clear is None or self._clear.obstacles is None:
            self._line.visible = False
            return self._wrong or "The cell is empty.", bool(self._wrong)
        seen = self._clear.obstacles
        gap = seen.gap(q)
        blocked, name = gap.room < 0, seen.names[gap.pair]
        nearest = self._clear.cell.objects[seen.pairs[gap.pair][1]].name if self._clear.cell is not None else ""
        for other, handle in self._handles.items():
            color = NEAREST if blocked and other == nearest else OBJECT
            if tuple(handle.color) != color:
                handle.color = color
        self._line.points = np.array([[gap.on_arm, gap.on_object]], dtype=np.float32)
        self._line.visible = not blocked
        if gap.distance < 0:
            return f"In the way: {name}; what covers the arm is {-gap.distance:.3g} m inside.", True
        margin = f", nearer than the margin of {gap.distance - gap.room:.3g} m" if blocked else ""
        return f"Nearest (red line): {name}, at least {gap.distance:.3g} m{margin}.", blocked
