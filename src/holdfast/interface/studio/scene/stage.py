"""Contents of the 3-D scene of one window, and their motion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.body import LINK_RADIUS_FRACTION, Color, MeshPart, build_stick_parts, mesh_sphere
from holdfast.interface.studio.scene.body import ArmFigure, to_quaternions
from holdfast.interface.studio.scene.cloud import RegionCloud
from holdfast.interface.studio.scene.machine import CompiledArm, LiveReading
from holdfast.kinematics.indices.lost_directions import DirectionLoss, Ellipsoid

BLUE_RGB = (10, 92, 158)
ORANGE_RGB = (200, 80, 10)
GREEN_RGB = (0, 122, 94)
PURPLE_RGB = (168, 73, 127)
GRID_RGB = (150, 157, 164)  # visible on white and on black
GHOST_COLORS: tuple[Color, ...] = (GREEN_RGB, ORANGE_RGB, BLUE_RGB, PURPLE_RGB)
LABEL_ANCHORS: tuple[Any, ...] = ("bottom-right", "top-left")  # so that the labels of two ghosts in one place do not overlap
ELLIPSOID_TIME_S = 0.22  # an ellipsoid shows the translation of the tool in this time at joint rates of norm 1
MAX_MARKED_FRACTION = 0.99  # a direction with a larger remaining fraction is not marked
_MAX_MARKS = 2  # largest number of marked directions
_RING_SEGMENTS = 24


class Stage:
    """3-D scene of one window.

    Args:
        scene: Viser scene of the window.
        machine: Compiled arm.
        parts: Meshes of the arm.
    """

    def __init__(self, scene: Any, machine: CompiledArm, parts: list[MeshPart]) -> None:
        self.scene, self.machine, self.parts = scene, machine, parts
        size, arm = machine.size, machine.arm
        scene.add_grid(
            "/floor",
            2.4 * size,
            2.4 * size,
            cell_size=0.1 * size,
            section_size=0.4 * size,
            cell_color=GRID_RGB,
            section_color=GRID_RGB,
            cell_thickness=0.5,
            position=arm.base[:3, 3] - [0.0, 0.0, 0.004 * size],
            shadow_opacity=0,
        )
        self.figure = ArmFigure(scene, "/arm", parts, arm.n + 2)
        if len(self.figure.joints) < arm.n:
            # Meshes hide the joints; knobs show the failed ones and can be clicked.
            self._add_joint_knobs()
        self._joint_labels = [
            scene.add_label(
                f"/arm/{number + 1}/name",
                name,
                position=2.2
                * LINK_RADIUS_FRACTION
                * size
                * arm.joints[number].axis,  # joints may share an origin, but not an axis
                anchor="center-left",
                font_screen_scale=0.85,
            )
            for number, name in enumerate(shorten_names(arm.joint_names))
        ]
        vertices, faces = mesh_sphere()
        self.before = scene.add_mesh_simple("/before", vertices, faces, color=BLUE_RGB, wireframe=True, opacity=0.25)
        self.after = scene.add_mesh_simple("/after", vertices, faces, color=ORANGE_RGB, opacity=0.5, cast_shadow=False)
        empty = np.zeros((1, 2, 3))
        line_width = 0.006 * size
        self._loss_lines = [
            scene.add_line_segments(
                f"/lost/{number}", np.repeat(empty, _RING_SEGMENTS + 3, axis=0), ORANGE_RGB, thickness=line_width
            )
            for number in range(_MAX_MARKS)
        ]
        self.ghosts: list[ArmFigure] = []
        self._ghost_labels: list[Any] = []
        self.cloud: Any = None
        self.chosen: Any = None
        linear_rows = machine.task.rows[:, :3]
        planar = not machine.task.angular and len(linear_rows) == 2 and machine.task.frame == "base"
        axes = tuple(bool(np.abs(linear_rows[:, number]).max() > 1e-9) for number in range(3)) if planar else (True, True, True)
        self.gizmo = scene.add_transform_controls(
            "/hand", scale=0.17 * size, active_axes=axes, disable_rotations=not machine.task.angular, depth_test=False
        )
        self.target = scene.add_transform_controls("/target", scale=0.13 * size, opacity=0.6, depth_test=False, visible=False)
        self._losses_visible = True

    def _add_joint_knobs(self) -> None:
        arm, knob_size = self.machine.arm, 1.15 * self.machine.size
        joints = [
            part
            for part in build_stick_parts(arm, knob_size)
            if part.joint is not None and part.joint not in self.figure.joints
        ]
        figure = ArmFigure(self.scene, "/knobs", joints, arm.n + 2, opacity=0.5)
        self.figure.companions.append(figure)
        self.figure.joints |= figure.joints

    def paint_joint(self, joint: int, condition: str) -> None:
        """Show a joint as healthy, locked or free, by its colour and in its label."""
        self.figure.paint_joint(joint, condition)
        name = shorten_names(self.machine.arm.joint_names)[joint]
        self._joint_labels[joint].text = name if condition == "healthy" else f"{name} {condition}"

    def show_labels(self, visible: bool) -> None:
        """Show or hide the names of the joints."""
        for label in self._joint_labels:
            label.visible = visible

    # ---- live ------------------------------------------------------------------------------------------------------

    def move_arm(self, frames: FloatArray, moves_gizmo: bool) -> None:
        """Move the arm to its frames (n + 2, 4, 4), and the handle to the end effector unless the user drags it."""
        self.figure.move_links(frames)
        if moves_gizmo:
            self.gizmo.position = frames[-1, :3, 3]
            self.gizmo.wxyz = to_quaternions(frames[-1:, :3, :3])[0]

    def show_reading(self, reading: LiveReading, tool_pose: FloatArray) -> None:
        """Show the effect of a failure at the end effector (4, 4)."""
        self._place_ellipsoid(self.before, reading.healthy_ellipsoid, tool_pose[:3, 3])
        self._place_ellipsoid(self.after, reading.failed_ellipsoid, tool_pose[:3, 3])
        self.after.visible = self._losses_visible and bool(reading.failure_joints)
        for number, line in enumerate(self._loss_lines):
            loss = reading.losses[number] if number < len(reading.losses) else None
            if loss is None or loss.kept > MAX_MARKED_FRACTION:
                line.visible = False
                continue
            line.points = self._loss_segments(loss, tool_pose).astype(np.float32)
            line.visible = self._losses_visible

    def show_losses(self, visible: bool) -> None:
        """Show or hide ellipsoids and lost directions."""
        self._losses_visible = visible
        self.before.visible = self.after.visible = visible
        for line in self._loss_lines:
            line.visible = visible

    def _place_ellipsoid(self, handle: Any, shape: Ellipsoid, center: FloatArray) -> None:
        min_radius = 2e-3 * self.machine.size
        handle.scale = tuple(float(max(ELLIPSOID_TIME_S * radius, min_radius)) for radius in shape.radii)
        handle.wxyz = to_quaternions(shape.axes[None])[0]
        handle.position = center

    def _loss_segments(self, loss: DirectionLoss, tool_pose: FloatArray) -> FloatArray:
        """Return segments (_RING_SEGMENTS + 3, 2, 3): a line through the end effector, and a ring about the rotation axis."""
        twist = self.machine.task.world_rows(tool_pose[:3, :3]).T @ loss.direction
        linear, angular = twist[:3], twist[3:]
        half_length, center = 0.24 * self.machine.size, tool_pose[:3, 3]
        segments = np.tile(center, (_RING_SEGMENTS + 3, 2, 1))
        segments[0] = [center - half_length * linear, center + half_length * linear]
        angular_norm = float(np.linalg.norm(angular))
        if angular_norm > 0.05:
            axis = angular / angular_norm
            first_axis = np.cross(axis, np.eye(3)[int(np.abs(axis).argmin())])
            first_axis /= np.linalg.norm(first_axis)
            angle = np.linspace(0, 2 * np.pi, _RING_SEGMENTS + 1)
            ring = (
                0.5
                * half_length
                * angular_norm
                * (np.cos(angle)[:, None] * first_axis + np.sin(angle)[:, None] * np.cross(axis, first_axis))
            )
            segments[3:, 0], segments[3:, 1] = center + ring[:-1], center + ring[1:]
            segments[1] = [center - 0.3 * half_length * axis * angular_norm, center + 0.3 * half_length * axis * angular_norm]
        return segments

    # ---- next to the arm -------------------------------------------------------------------------------------------

    def add_ghosts(self, labels: Sequence[str], colors: Sequence[Color] = GHOST_COLORS) -> None:
        """Add ghost arms to the scene, one for each label, which replace the present ones."""
        self.remove_ghosts()
        moving_parts = [part for part in self.parts if part.frame]
        for number, (text, color) in enumerate(zip(labels, colors, strict=False)):
            figure = ArmFigure(self.scene, f"/ghost{number}", moving_parts, self.machine.arm.n + 2, tint=color, opacity=0.45)
            self.ghosts.append(figure)
            self._ghost_labels.append(self.scene.add_label(f"/name{number}", text, anchor=LABEL_ANCHORS[number % 2]))

    def move_ghosts(self, frames: Sequence[FloatArray]) -> None:
        """Move the ghosts to their frames (n + 2, 4, 4)."""
        for figure, label, ghost_frames in zip(self.ghosts, self._ghost_labels, frames, strict=True):
            figure.move_links(ghost_frames)
            label.position = ghost_frames[len(ghost_frames) // 2, :3, 3]  # at the elbow, because the tools often coincide

    def remove_ghosts(self) -> None:
        """Remove the ghosts from the scene."""
        for figure in self.ghosts:
            figure.remove()
        for label in self._ghost_labels:
            label.remove()
        self.ghosts, self._ghost_labels = [], []

    def draw_cloud(self, cloud: RegionCloud | None, on_point: Callable[[int], None]) -> None:
        """Show a region as points that can be clicked; None removes it."""
        for handle in (self.cloud, self.chosen):
            if handle is not None:
                handle.remove()
        self.cloud = self.chosen = None
        if cloud is None or not len(cloud.points):
            return
        vertices, faces = mesh_sphere(3)
        self.cloud = self.scene.add_batched_meshes_simple(
            "/region",
            vertices * 0.009 * self.machine.size,
            faces,
            np.tile([1.0, 0, 0, 0], (len(cloud.points), 1)),
            cloud.points,
            batched_colors=cloud.colors,
            lod="off",
            cast_shadow=False,
            receive_shadow=False,
        )

        async def on_click(event: Any) -> None:
            if event.instance_index is not None:
                on_point(int(event.instance_index))

        self.cloud.on_click(on_click)

    def mark_point(self, point: FloatArray) -> None:
        """Mark the chosen point of the region."""
        if self.chosen is not None:
            self.chosen.remove()
        vertices, faces = mesh_sphere(6)
        size = 0.02 * self.machine.size
        self.chosen = self.scene.add_mesh_simple("/chosen", vertices * size, faces, color=ORANGE_RGB, position=point)


def shorten_names(names: Sequence[str]) -> list[str]:
    """Remove the common prefix from the names of joints: 4 for panda_joint4."""
    prefix_length = next(
        (position for position, letters in enumerate(zip(*names, strict=False)) if len(set(letters)) > 1), min(map(len, names))
    )
    return (
        [name[prefix_length:] for name in names]
        if len(names) > 1 and all(len(name) > prefix_length for name in names)
        else list(names)
    )
