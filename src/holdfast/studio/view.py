"""What one client sees: the scene and the controls, as a state says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.poses import pose_of
from holdfast.errors import HoldfastError
from holdfast.present.arm.body import Part
from holdfast.studio.page.guide import Guide
from holdfast.studio.page.panel import Panel
from holdfast.studio.player import Player
from holdfast.studio.scene.cloud import Cloud
from holdfast.studio.scene.machine import TOLERANCE, Machine, Reading, sentence
from holdfast.studio.scene.objects import Objects
from holdfast.studio.scene.stage import Stage
from holdfast.studio.state import State
from holdfast.studio.watching import Watched
from holdfast.studio.work import TICK, Clock, Latest

Array = NDArray[np.float64]


class View:
    """The scene and the controls of one client, and the state that they show.

    Args:
        client: Of viser.
        machine: The arm.
        state: What is shown at first.
        parts: What the arm is made of.
        ask: ``ask(what, value)`` is told of everything that a person does.
    """

    def __init__(self, client: Any, machine: Machine, state: State, parts: list[Part], ask: Callable[[str, Any], None]) -> None:
        self.client, self.machine, self.state = client, machine, state
        self._start = state
        self.updates = 0  # pictures sent
        self.held: str | int | None = None  # what a person holds: the end effector, or a slider
        self.cloud: Cloud | None = None
        self.watched: Watched | None = None
        self._reading: Reading | None = None
        self._busy = self._closed = False
        self.live = Latest(self._complain)
        self._clock = Clock(self.live, TICK)
        with client.atomic():
            self.stage = Stage(client.scene, machine, parts)
            self.stage.move(machine.arm.frames(self.q), gizmo=True)
            self.panel = Panel(client.gui, machine, state, ask)
            self.objects = None if machine.cell is None else Objects(client.scene, machine, state.moved, ask)
        self.player = Player(self.stage, self.panel, self._clock, self._moved)
        self._guide = Guide(ask, self.panel.guide)

    @property
    def q(self) -> Array:
        """(n,) where the arm is, rad and m."""
        return np.array(self.state.q)

    def _place(self, q: Array) -> None:
        self.state = replace(self.state, q=tuple(float(x) for x in q))
        self._refresh()

    def _refresh(self) -> None:
        """Show the state: the arm at once, and what a failure takes."""
        q, state = self.q, self.state
        frames = self.machine.arm.frames(q)
        with self.client.atomic():
            self.stage.move(frames, gizmo=self.held != "hand")
            self.panel.follow(q, self.held if isinstance(self.held, int) else None)
        reading = self._reading = self.machine.read(q, state.failed, state.index, state.susceptibility)
        with self.client.atomic():
            self.stage.read(reading, frames[-1])
            self.panel.read(reading, state)
            self.panel.enable(self._possible(reading))
            self.panel.tell_watched(self.watched if state.show == "watch" else None, state)
            if self.objects is not None:
                self.panel.tell_nearest(*self.objects.read(q))
            self._guide.tell(reading, state.names, self._busy)
        self.updates += 1

    def _possible(self, reading: Reading) -> dict[str, bool]:
        """Which buttons can do something now."""
        state, machine = self.state, self.machine
        ghosts = len(self.player.ghosts) if state.show in ("best-worst", "laws") else 0
        beside = state.show != "arm" or state.target is not None or bool(self.player.ghosts) or self.cloud is not None
        return {
            "home": state.q != self._start.q,
            "heal": bool(state.failed),
            "swing": bool(state.free) and machine.swings,
            "best-worst": not isinstance(machine.objectives(state.objective), str),
            "take0": ghosts > 0,
            "take1": ghosts > 1,
            "target": state.target is None,
            "laws": state.target is not None and not self._arrived(),
            "region": not isinstance(reading.bars, str),
            "watch": machine.swings and not state.failed,
            "inject": state.show == "watch" and self.watched is not None and not self._busy,
            "clear": beside or self._busy,
            "tour": True,
            "next": not self._busy,
            "slide": len(machine.self_motions(self.q, state.failed)) > 0,
        }

    def refuse(self, text: str) -> None:
        """Say that something was not taken."""
        self.live.put("refuse", lambda: self.panel.say(text, bad=True))

    def _saved(self, text: str) -> None:
        self.live.put("saved", lambda: self.panel.say(text))

    def _complain(self, error: BaseException) -> None:
        if self._closed:
            return
        if not isinstance(error, HoldfastError):
            import traceback

            traceback.print_exception(error)
        self.panel.say(sentence(error), bad=True)
        if self._busy:
            self._busy = False
            self.live.put("refresh", self._refresh)

    def _on_pick(self, name: str) -> None:
        if self.objects is not None:
            self.objects.pick(name)
            self.panel.say(f"Drag {name} by its handle; click it again to leave it there.")

    def _on_object(self, value: tuple[str, tuple[float, ...]]) -> None:
        if self.objects is not None:
            self.objects.move(*value, self.state.moved)
            self.state = self.state.with_object(*value)
            self._refresh()

    def _moved(self, time: float, q: Array | None) -> None:
        self.state = replace(self.state, time=time)
        if q is None:
            self._refresh()
        else:
            self._place(q)

    def _on_time(self, value: float) -> None:
        self.player.pause()  # who takes the slider stops what plays
        self.player.seek(value)

    def _on_play(self, _: Any) -> None:
        self.player.play()

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

    def _arrived(self) -> bool:
        """The end effector is where the target says, as far as the task looks."""
        target = self.state.target
        return target is not None and self.machine.apart(self.q, pose_of(target[:3], target[3:])) < TOLERANCE
