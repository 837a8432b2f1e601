"""Cell in the scene of a window: draggable objects, and the point where the arm is nearest to one of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.cell.bodies import NEAREST_COLOR_RGB, OBJECT_COLOR_RGB, mesh_solid
from holdfast.interface.studio.scene.body import to_quaternions
from holdfast.interface.studio.scene.machine import CompiledArm, describe_error
from holdfast.model.arm.poses import pose_from_quaternion

Moved = Sequence[tuple[str, Sequence[float]]]


class CellObjects:
    """Cell objects of one window.

    Args:
        scene: Viser scene of the window.
        machine: Compiled arm with its cell.
        moved_objects: Objects that were moved, with x, y, z and quaternion x, y, z, w.
        request_action: ``ask("pick", name)`` when an object is clicked, ``ask("object", (name, numbers))`` when it is dragged.
    """

    def __init__(
        self, scene: Any, machine: CompiledArm, moved_objects: Moved, request_action: Callable[[str, Any], None]
    ) -> None:
        assert machine.cell is not None
        self._machine, self._picked = machine, ""
        self._clearance = machine.get_clearance(moved_objects)
        self._handles: dict[str, Any] = {}
        self._poses: dict[str, FloatArray] = {}
        for number, solid in enumerate(machine.cell):
            vertices, faces = mesh_solid(solid, machine.size)
            handle = scene.add_mesh_simple(
                f"/cell/{number}",
                vertices,
                faces,
                color=OBJECT_COLOR_RGB,
                side="double",
                cast_shadow=False,
                receive_shadow=False,
            )
            scene.add_label(f"/cell/{number}/name", solid.name, font_screen_scale=0.85)
            self._handles[solid.name] = handle
            self._set_pose(solid.name, solid.pose)
            self._attach_click(handle, solid.name, request_action)
        for name, numbers in moved_objects:
            self._set_pose(name, pose_from_quaternion(np.array(numbers[:3]), np.array(numbers[3:])))
        self.gizmo = scene.add_transform_controls("/drag", scale=0.2 * machine.size, depth_test=False, visible=False)
        self._attach_drag(request_action)
        self._line = scene.add_line_segments("/nearest", np.zeros((1, 2, 3)), NEAREST_COLOR_RGB, thickness=0.008 * machine.size)

    def _attach_click(self, handle: Any, name: str, request_action: Callable[[str, Any], None]) -> None:
        async def on_click(_: Any) -> None:
            request_action("pick", name)

        handle.on_click(on_click)

    def _attach_drag(self, request_action: Callable[[str, Any], None]) -> None:
        async def on_drag(event: Any) -> None:
            if event.client is not None and self._picked:
                w, x, y, z = (float(component) for component in event.target.wxyz)
                request_action(
                    "object", (self._picked, (*(float(component) for component in event.target.position), x, y, z, w))
                )

        self.gizmo.on_update(on_drag)

    def _set_pose(self, name: str, pose: FloatArray) -> None:
        handle, self._poses[name] = self._handles[name], pose
        handle.position, handle.wxyz = pose[:3, 3], to_quaternions(pose[None, :3, :3])[0]

    def toggle_handle(self, name: str) -> None:
        """Show the drag handle of an object, or hide it if it is shown."""
        self._picked = "" if name == self._picked else name
        self.gizmo.visible = bool(self._picked)
        if self._picked:
            pose = self._poses[name]
            self.gizmo.position, self.gizmo.wxyz = pose[:3, 3], to_quaternions(pose[None, :3, :3])[0]

    def move_object(self, name: str, numbers: Sequence[float], moved_objects: Moved) -> None:
        """Move an object; ``moved_objects`` are the ones moved before."""
        self._set_pose(name, pose_from_quaternion(np.array(numbers[:3]), np.array(numbers[3:])))
        try:
            self._clearance = self._machine.get_clearance(
                [*(entry for entry in moved_objects if entry[0] != name), (name, numbers)]
            )
            self._error_text = ""
        except InputError as error:
            self._error_text = describe_error(error)

    _error_text = ""

    def draw_shortest_distance(self, q: FloatArray) -> tuple[str, bool]:
        """Draw the shortest distance at q (n,); return a text about the nearest object, and True if it is too near."""
        if self._error_text or self._clearance is None or self._clearance.obstacles is None:
            self._line.visible = False
            return self._error_text or "The cell is empty.", bool(self._error_text)
        obstacles = self._clearance.obstacles
        gap = obstacles.find_nearest_gap(q)
        blocked, name = gap.margin < 0, obstacles.names[gap.pair]
        nearest = self._clearance.cell.objects[obstacles.pairs[gap.pair][1]].name if self._clearance.cell is not None else ""
        for object_name, handle in self._handles.items():
            color = NEAREST_COLOR_RGB if blocked and object_name == nearest else OBJECT_COLOR_RGB
            if tuple(handle.color) != color:
                handle.color = color
        self._line.points = np.array([[gap.on_arm, gap.on_object]], dtype=np.float32)
        self._line.visible = not blocked
        if gap.distance < 0:
            return f"In collision: {name}; the collision model of the arm is {-gap.distance:.3g} m inside.", True
        margin = f", closer than the margin of {gap.distance - gap.margin:.3g} m" if blocked else ""
        return f"Closest (red line): {name}, at least {gap.distance:.3g} m{margin}.", blocked
