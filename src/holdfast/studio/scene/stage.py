"""What is in the 3-D scene of one window, and how it is moved."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.indices.lost_directions import Ellipsoid, Loss
from holdfast.present.arm.body import THIN, Color, Part, ball, stick_parts
from holdfast.studio.scene.body import Figure, quaternions
from holdfast.studio.scene.cloud import Cloud
from holdfast.studio.scene.machine import Machine, Reading

Array = NDArray[np.float64]

BLUE, ORANGE, GREEN, PURPLE = (10, 92, 158), (200, 80, 10), (0, 122, 94), (168, 73, 127)
GRID = (150, 157, 164)  # to be seen on white and on black
GHOSTS: tuple[Color, ...] = (GREEN, ORANGE, BLUE, PURPLE)
ANCHORS: tuple[Any, ...] = ("bottom-right", "top-left")  # names of two ghosts that meet stay apart
SECONDS = 0.22  # an ellipsoid is drawn as how far the tool gets in this time at joint rates of norm 1
SHOWN = 0.99  # a direction in which at least this share is left is not marked
_MARKS = 2  # directions that are marked
_RING = 24


class Stage:
    """The scene of one window.

    Args:
        scene: The window's viser scene.
        machine: The arm.
        parts: What it is made of.
    """

    def __init__(self, scene: Any, machine: Machine, parts: list[Part]) -> None:
        self.scene, self.machine, self.parts = scene, machine, parts
        size, arm = machine.size, machine.arm
        scene.add_grid(
            "/floor",
            2.4 * size,
            2.4 * size,
            cell_size=0.1 * size,
            section_size=0.4 * size,
            cell_color=GRID,
            section_color=GRID,
            cell_thickness=0.5,
            position=arm.base[:3, 3] - [0.0, 0.0, 0.004 * size],
            shadow_opacity=0,
        )
        self.figure = Figure(scene, "/arm", parts, arm.n + 2)
        if len(self.figure.joints) < arm.n:
            # Meshes hide the joints; knobs show which have failed and can be clicked.
            self._knobs()
        self._names = [
            scene.add_label(
                f"/arm/{k + 1}/name",
                name,
                position=2.2 * THIN * size * arm.joints[k].axis,  # joints may share an origin, but not an axis
                anchor="center-left",
                font_screen_scale=0.85,
            )
            for k, name in enumerate(short_names(arm.joint_names))
        ]
        vertices, faces = ball()
        self.before = scene.add_mesh_simple("/before", vertices, faces, color=BLUE, wireframe=True, opacity=0.25)
        self.after = scene.add_mesh_simple("/after", vertices, faces, color=ORANGE, opacity=0.5, cast_shadow=False)
        empty = np.zeros((1, 2, 3))
        thick = 0.006 * size
        self._lines = [
            scene.add_line_segments(f"/lost/{k}", np.repeat(empty, _RING + 3, axis=0), ORANGE, thickness=thick)
            for k in range(_MARKS)
        ]
        self.ghosts: list[Figure] = []
        self._labels: list[Any] = []
        self.cloud: Any = None
        self.chosen: Any = None
        flat = machine.task.rows[:, :3]
        planar = not machine.task.angular and len(flat) == 2 and machine.task.frame == "base"
        axes = tuple(bool(np.abs(flat[:, k]).max() > 1e-9) for k in range(3)) if planar else (True, True, True)
        self.gizmo = scene.add_transform_controls(
            "/hand", scale=0.17 * size, active_axes=axes, disable_rotations=not machine.task.angular, depth_test=False
        )
        self.target = scene.add_transform_controls("/target", scale=0.13 * size, opacity=0.6, depth_test=False, visible=False)
        self._shown = True

    def _knobs(self) -> None:
        arm, thick = self.machine.arm, 1.15 * self.machine.size
        joints = [p for p in stick_parts(arm, thick) if p.joint is not None and p.joint not in self.figure.joints]
        figure = Figure(self.scene, "/knobs", joints, arm.n + 2, opacity=0.5)
        self.figure.companions.append(figure)
        self.figure.joints |= figure.joints

    def paint(self, joint: int, condition: str) -> None:
        """Show a joint as healthy, locked or free, by its colour and beside its name."""
        self.figure.paint(joint, condition)
        name = short_names(self.machine.arm.joint_names)[joint]
        self._names[joint].text = name if condition == "healthy" else f"{name} {condition}"

    def show_labels(self, visible: bool) -> None:
        """Show or hide the names of the joints."""
        for label in self._names:
            label.visible = visible

    # ---- live ------------------------------------------------------------------------------------------------------

    def move(self, frames: Array, gizmo: bool) -> None:
        """Put the arm where its frames (n + 2, 4, 4) say, and the handle into its end effector unless someone holds it."""
        self.figure.move(frames)
        if gizmo:
            self.gizmo.position = frames[-1, :3, 3]
            self.gizmo.wxyz = quaternions(frames[-1:, :3, :3])[0]

    def read(self, reading: Reading, hand: Array) -> None:
        """Show what a failure takes at the end effector (4, 4)."""
        self._ellipsoid(self.before, reading.before, hand[:3, 3])
        self._ellipsoid(self.after, reading.after, hand[:3, 3])
        self.after.visible = self._shown and bool(reading.hit)
        for k, line in enumerate(self._lines):
            loss = reading.losses[k] if k < len(reading.losses) else None
            if loss is None or loss.kept > SHOWN:
                line.visible = False
                continue
            line.points = self._mark(loss, hand).astype(np.float32)
            line.visible = self._shown

    def show_losses(self, visible: bool) -> None:
        """Show or hide ellipsoids and lost directions."""
        self._shown = visible
        self.before.visible = self.after.visible = visible
        for line in self._lines:
            line.visible = visible

    def _ellipsoid(self, handle: Any, shape: Ellipsoid, place: Array) -> None:
        least = 2e-3 * self.machine.size
        handle.scale = tuple(float(max(SECONDS * r, least)) for r in shape.radii)
        handle.wxyz = quaternions(shape.axes[None])[0]
        handle.position = place

    def _mark(self, loss: Loss, hand: Array) -> Array:
        """Segments (_RING + 3, 2, 3): a line through the end effector both ways, and a ring about the axis of the turn."""
        task = self.machine.task
        twist = task.rows.T @ loss.direction
        turn = hand[:3, :3] if task.frame == "tool" else np.eye(3)
        linear, angular = turn @ twist[:3], turn @ twist[3:]
        reach, centre = 0.24 * self.machine.size, hand[:3, 3]
        out = np.tile(centre, (_RING + 3, 2, 1))
        out[0] = [centre - reach * linear, centre + reach * linear]
        size = float(np.linalg.norm(angular))
        if size > 0.05:
            axis = angular / size
            first = np.cross(axis, np.eye(3)[int(np.abs(axis).argmin())])
            first /= np.linalg.norm(first)
            angle = np.linspace(0, 2 * np.pi, _RING + 1)
            ring = 0.5 * reach * size * (np.cos(angle)[:, None] * first + np.sin(angle)[:, None] * np.cross(axis, first))
            out[3:, 0], out[3:, 1] = centre + ring[:-1], centre + ring[1:]
            out[1] = [centre - 0.3 * reach * axis * size, centre + 0.3 * reach * axis * size]
        return out

    # ---- beside the arm --------------------------------------------------------------------------------------------

    def haunt(self, labels: Sequence[str], colors: Sequence[Color] = GHOSTS) -> None:
        """Put ghost arms into the scene, one for each label, in place of those that are there."""
        self.lay()
        moving = [p for p in self.parts if p.frame]
        for k, (text, color) in enumerate(zip(labels, colors, strict=False)):
            figure = Figure(self.scene, f"/ghost{k}", moving, self.machine.arm.n + 2, tint=color, opacity=0.45)
            self.ghosts.append(figure)
            self._labels.append(self.scene.add_label(f"/name{k}", text, anchor=ANCHORS[k % 2]))

    def move_ghosts(self, frames: Sequence[Array]) -> None:
        """Put the ghosts where their frames (n + 2, 4, 4) say."""
        for figure, label, place in zip(self.ghosts, self._labels, frames, strict=True):
            figure.move(place)
            label.position = place[len(place) // 2, :3, 3]  # at the elbow: tools often meet

    def lay(self) -> None:
        """Take the ghosts out of the scene."""
        for figure in self.ghosts:
            figure.remove()
        for label in self._labels:
            label.remove()
        self.ghosts, self._labels = [], []

    def draw_cloud(self, cloud: Cloud | None, clicked: Callable[[int], None]) -> None:
        """Show a region as points that can be clicked; None: none."""
        for handle in (self.cloud, self.chosen):
            if handle is not None:
                handle.remove()
        self.cloud = self.chosen = None
        if cloud is None or not len(cloud.points):
            return
        vertices, faces = ball(3)
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

        async def told(event: Any) -> None:
            if event.instance_index is not None:
                clicked(int(event.instance_index))

        self.cloud.on_click(told)

    def mark_point(self, point: Array) -> None:
        """Show which point of the region was chosen."""
        if self.chosen is not None:
            self.chosen.remove()
        vertices, faces = ball(6)
        size = 0.02 * self.machine.size
        self.chosen = self.scene.add_mesh_simple("/chosen", vertices * size, faces, color=ORANGE, position=point)


def short_names(names: Sequence[str]) -> list[str]:
    """Names of joints without what they all begin with: 4 for panda_joint4."""
    start = next((k for k, same in enumerate(zip(*names, strict=False)) if len(set(same)) > 1), min(map(len, names)))
    return [name[start:] for name in names] if len(names) > 1 and all(len(name) > start for name in names) else list(names)
