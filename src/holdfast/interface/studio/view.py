"""Scene and controls of one client, as determined by a state."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from importlib.util import find_spec
from typing import Any

import numpy as np

from holdfast.core.errors import HoldfastError
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.body import MeshPart
from holdfast.interface.studio.monitor_demo import MonitorDemo
from holdfast.interface.studio.page.guide import TourGuide
from holdfast.interface.studio.page.panel import ControlPanel
from holdfast.interface.studio.player import Player
from holdfast.interface.studio.scene.cloud import RegionCloud
from holdfast.interface.studio.scene.machine import REACH_TOLERANCE, CompiledArm, LiveReading, describe_error
from holdfast.interface.studio.scene.objects import CellObjects
from holdfast.interface.studio.scene.stage import Stage
from holdfast.interface.studio.state import State
from holdfast.interface.studio.work import TICK_S, Clock, LatestRequests
from holdfast.model.arm.poses import pose_from_quaternion


class StudioView:
    """Scene and controls of one client, and the state that they show.

    Args:
        client: Client of viser.
        machine: Compiled arm.
        state: Initial state.
        parts: Meshes of the arm.
        request_action: Function ``ask(what, value)`` that is called for every action of the user.
    """

    def __init__(
        self, client: Any, machine: CompiledArm, state: State, parts: list[MeshPart], request_action: Callable[[str, Any], None]
    ) -> None:
        self.client, self.machine, self.state = client, machine, state
        self._initial_state = state
        self.updates = 0  # number of pictures that were sent
        self.dragged: str | int | None = None  # control that the user drags: the end effector, or a slider
        self.cloud: RegionCloud | None = None
        self.monitor_demo: MonitorDemo | None = None
        self._reading: LiveReading | None = None
        self._is_busy = self._is_closed = False
        self.live = LatestRequests(self._show_error)
        self._clock = Clock(self.live, TICK_S)
        with client.atomic():
            self.stage = Stage(client.scene, machine, parts)
            self.stage.move_arm(machine.arm.frames(self.q), moves_gizmo=True)
            self.panel = ControlPanel(client.gui, machine, state, request_action)
            self.objects = None if machine.cell is None else CellObjects(client.scene, machine, state.moved, request_action)
        self.player = Player(self.stage, self.panel, self._clock, self._show_motion_time)
        self._guide = TourGuide(request_action, self.panel.show_tour)

    @property
    def q(self) -> FloatArray:
        """Configuration (n,) of the arm, rad and m."""
        return np.array(self.state.q)

    def _set_configuration(self, q: FloatArray) -> None:
        self.state = replace(self.state, q=tuple(float(value) for value in q))
        self._refresh()

    def _refresh(self) -> None:
        """Show the state: the arm at once, then the effect of a failure."""
        q, state = self.q, self.state
        frames = self.machine.arm.frames(q)
        with self.client.atomic():
            self.stage.move_arm(frames, moves_gizmo=self.dragged != "hand")
            self.panel.move_sliders(q, self.dragged if isinstance(self.dragged, int) else None)
        reading = self._reading = self.machine.evaluate_live_reading(
            q, state.failed_joints, state.index, state.susceptibility, state.powerless, state.friction
        )
        with self.client.atomic():
            self.stage.show_reading(reading, frames[-1])
            self.panel.show_reading(reading, state)
            self.panel.enable_controls(self._find_enabled_actions(reading))
            self.panel.show_monitor(self.monitor_demo if state.show == "watch" else None, state)
            if self.objects is not None:
                self.panel.show_nearest(*self.objects.draw_shortest_distance(q))
            self._guide.show_step(reading, state.names, self._is_busy)
        self.updates += 1

    def _find_enabled_actions(self, reading: LiveReading) -> dict[str, bool]:
        """Return for each button True if it has an effect now."""
        state, machine = self.state, self.machine
        ghosts = len(self.player.ghosts) if state.show in ("best-worst", "laws") else 0
        has_extras = state.show != "arm" or state.target is not None or bool(self.player.ghosts) or self.cloud is not None
        return {
            "home": state.q != self._initial_state.q,
            "heal": bool(state.failed_joints),
            "fall": bool(state.powerless) and machine.has_masses,
            "best-worst": not isinstance(machine.get_objectives(state.objective), str),
            "take0": ghosts > 0,
            "take1": ghosts > 1,
            "target": state.target is None,
            "laws": state.target is not None and not self._is_at_target(),
            "region": not isinstance(reading.bars, str),
            "watch": machine.has_masses and find_spec("mujoco") is not None and not state.failed_joints,
            "inject": state.show == "watch" and self.monitor_demo is not None and not self._is_busy,
            "clear": has_extras or self._is_busy,
            "tour": True,
            "next": not self._is_busy,
            "slide": len(machine.self_motion_directions(self.q, state.failed_joints)) > 0,
        }

    def show_refusal(self, text: str) -> None:
        """Show that an input was rejected."""
        self.live.submit("refuse", lambda: self.panel.show_message(text, is_error=True))

    def _show_saved(self, text: str) -> None:
        self.live.submit("saved", lambda: self.panel.show_message(text))

    def _show_error(self, error: BaseException) -> None:
        if self._is_closed:
            return
        if not isinstance(error, HoldfastError):
            import traceback

            traceback.print_exception(error)
        self.panel.show_message(describe_error(error), is_error=True)
        if self._is_busy:
            self._is_busy = False
            self.live.submit("refresh", self._refresh)

    def _on_pick(self, name: str) -> None:
        if self.objects is not None:
            self.objects.toggle_handle(name)
            self.panel.show_message(f"Drag {name} by its handle. Click it again to hide the handle.")

    def _on_object(self, value: tuple[str, tuple[float, ...]]) -> None:
        if self.objects is not None:
            self.objects.move_object(*value, self.state.moved)
            self.state = self.state.with_object(*value)
            self._refresh()

    def _show_motion_time(self, time: float, q: FloatArray | None) -> None:
        self.state = replace(self.state, time=time)
        if q is None:
            self._refresh()
        else:
            self._set_configuration(q)

    def _on_time(self, value: float) -> None:
        self.player.pause()  # dragging the slider stops the playback
        self.player.show_motions_at(value)

    def _on_play(self, _: Any) -> None:
        self.player.toggle_play()

    def _on_labels(self, value: bool) -> None:
        self.stage.show_labels(value)

    def _on_losses(self, value: bool) -> None:
        self.stage.show_losses(value)
        self._refresh()

    def _show_target(self) -> None:
        numbers = self.state.target or ()
        self.stage.target.position = numbers[:3]
        self.stage.target.wxyz = (numbers[6], *numbers[3:6])
        self.stage.target.visible = True

    def _is_at_target(self) -> bool:
        """Return True if the end effector is at the target, by the rows of the task."""
        target = self.state.target
        return (
            target is not None
            and self.machine.pose_error_norm(self.q, pose_from_quaternion(target[:3], target[3:])) < REACH_TOLERANCE
        )
