"""The controls and numbers of one window."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from html import escape
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.registry import INDICES, LAWS, SUSCEPTIBILITIES, Registry
from holdfast.studio.scene.bars import bars_html, losses_html
from holdfast.studio.scene.machine import Machine, Reading
from holdfast.studio.state import State

Array = NDArray[np.float64]
Handler = Callable[[Any], None]
BUTTONS = ("healthy", "lock", "free")
MORE_LAWS = ("failure-tolerant:0.1", "failure-tolerant:0.9")


class Panel:
    """The controls of one window.

    Args:
        gui: The window's viser GUI.
        machine: The arm.
        state: What is shown at first.
        ask: ``ask(what, value)`` is told of everything that a person does; it must return at once.
    """

    def __init__(self, gui: Any, machine: Machine, state: State, ask: Callable[[str, Any], None]) -> None:
        self.gui, self.machine, self._ask = gui, machine, ask
        arm = machine.arm
        self.message = gui.add_html(_line(f"{arm.name}: drag the handle at the end effector"))
        self.bars = gui.add_html("")
        self.losses = gui.add_html("")
        tabs = gui.add_tab_group()
        with tabs.add_tab("Move"):
            self._move_tab(arm, state)
        with tabs.add_tab("Fail"):
            self._fail_tab(arm, state)
        with tabs.add_tab("Choose"):
            self._choose_tab(state)
        with tabs.add_tab("Motion"):
            self._motion_tab(state)
        with tabs.add_tab("Region"):
            self._region_tab(state)
        with tabs.add_tab("Save"):
            self._save_tab(state)

    # ---- tabs ------------------------------------------------------------------------------------------------------

    def _move_tab(self, arm: Arm, state: State) -> None:
        self.sliders = []
        for k, joint in enumerate(arm.joints):
            factor, unit = joint.shown
            step, digits = (0.001, 3) if joint.prismatic else (0.1, 1)
            low, high = (round(factor * x, digits) for x in slider_range(arm, k, self.machine.size))
            value = round(float(np.clip(factor * state.q[k], low, high)), digits)
            slider = self.gui.add_slider(f"{joint.name}, {unit}", low, high, step, value)
            self._on(slider.on_update, "joint", partial(_slid, k, factor))
            self.sliders.append(slider)
        self.slide = self.gui.add_slider(
            "self-motion", -1.0, 1.0, 0.01, 0.0, hint="How fast the arm slides along the self-motion of this pose while held."
        )
        self._on(self.slide.on_update, "slide", lambda h: h.value)
        ways = max(arm.n - self.machine.task.m, 1)
        self.way = self.gui.add_dropdown(
            "direction", tuple(str(k + 1) for k in range(ways)), visible=ways > 1, hint="Which of several self-motions."
        )
        self._on(self.way.on_update, "way", lambda h: int(h.value) - 1)
        self._button("Back to the start", "home", "The configuration with which this window opened.")

    def _fail_tab(self, arm: Arm, state: State) -> None:
        for k, joint in enumerate(arm.joints):
            group = self.gui.add_button_group(joint.name, BUTTONS, hint="Locked: cannot move. Free: swings under gravity.")
            self._on(group.on_click, "fail", partial(_pressed, k))
        self._button("All healthy", "heal", "No joint has failed.")
        self._button(
            "Let the free joint swing",
            "swing",
            "From the physics, all other joints held (needs holdfast[physics]). Scrub it in the tab Motion.",
        )
        self.susceptibility = self.gui.add_dropdown(
            "susceptibility", self._menu(state.susceptibility, SUSCEPTIBILITIES), initial_value=state.susceptibility
        )
        self._on(self.susceptibility.on_update, "susceptibility", lambda h: h.value)
        self.weights = self.gui.add_html("")

    def _choose_tab(self, state: State) -> None:
        self.index = self.gui.add_dropdown("bars show", self._menu(state.index, INDICES), initial_value=state.index)
        self._on(self.index.on_update, "index", lambda h: h.value)
        objectives = self._menu(state.objective, INDICES, SUSCEPTIBILITIES)
        self.objective = self.gui.add_dropdown("choose by", objectives, initial_value=state.objective)
        self._on(self.objective.on_update, "objective", lambda h: h.value)
        self._button("Best and worst of this pose", "best-worst", "Ghost arms: green the best, orange the worst.")
        self._button("Take the green one", "take0", "The arm goes where the green ghost is.")
        self._button("Take the orange one", "take1", "The arm goes where the orange ghost is.")
        self._button("Clear", "clear", "Remove the ghosts.")

    def _motion_tab(self, state: State) -> None:
        self.laws = [
            self.gui.add_dropdown(f"{c} law", self._menu(law, LAWS, more=MORE_LAWS), initial_value=law)
            for c, law in zip(("green", "orange"), state.laws, strict=True)
        ]
        for handle in self.laws:
            self._on(handle.on_update, "laws", lambda h: (self.laws[0].value, self.laws[1].value))
        self._button("Choose a target", "target", "Shows a second handle: drag it to where the end effector should go.")
        self._button("Move under both laws", "laws", "Failed joints are locked; the controller does not know.")
        self.file = self.gui.add_text("file", state.file or "", hint="CSV or folder that follow, simulate or recover wrote.")
        self._button("Open the motion", "file", "Scrub or play it with the slider below.")
        self._player()
        self._button("Clear", "clear", "Remove the motion.")

    def _player(self) -> None:
        self.time = self.gui.add_slider("time", 0.0, 1.0, 0.001, 0.0, disabled=True)
        self._on(self.time.on_update, "time", lambda h: h.value)
        self.play = self.gui.add_button("Play", disabled=True)
        self._on(self.play.on_click, "play", lambda h: None)

    def _region_tab(self, state: State) -> None:
        self._button("Assess around the tool", "region", "Poses around the tool, coloured by the index: click one.")
        self.folder = self.gui.add_text("results folder", state.region or "", hint="A folder that holdfast assess wrote.")
        self._button("Open the results", "results", "Poses of the region, coloured by the index: click one.")
        self.gui.add_html(_line("Click a point to see the configuration behind it."))
        self._button("Clear", "clear", "Remove the points.")

    def _save_tab(self, state: State) -> None:
        self._button("PNG of the scene", "png", "As this window shows it.")
        self._button("SVG drawing", "svg", "Side and top view of arm and ghosts, with failed joints marked.")
        shown = self.gui.add_checkbox("ellipsoids and lost directions", True)
        self._on(shown.on_update, "losses", lambda h: h.value)
        self.gui.add_html(_line("This command line brings the view back:"))
        self.command = self.gui.add_html(command_html(state))

    # ---- reading ---------------------------------------------------------------------------------------------------

    def say(self, text: str, bad: bool = False) -> None:
        """The line at the top."""
        content = _line(text, bad)
        if self.message.content != content:
            self.message.content = content

    def read(self, reading: Reading, state: State) -> None:
        """The live numbers."""
        names, arm = state.names, self.machine.arm
        pieces = (
            (self.bars, bars_html(reading.bars, "if the joint locks", names, state.conditions)),
            (self.losses, losses_html(arm, self.machine.task, reading, state.failed)),
            (self.weights, bars_html(reading.weights, "if the joint swings free", names, state.conditions)),
            (self.command, command_html(state)),
        )
        for handle, content in pieces:
            if handle.content != content:
                handle.content = content

    def follow(self, q: Array, held: int | None) -> None:
        """Sliders where the arm is, but for the one that is held."""
        for k, (slider, joint) in enumerate(zip(self.sliders, self.machine.arm.joints, strict=True)):
            value = round(float(np.clip(joint.shown[0] * q[k], slider.min, slider.max)), 3 if joint.prismatic else 1)
            if k != held and abs(slider.value - value) > 0.5 * slider.step:
                slider.value = value

    def disable(self, conditions: Sequence[str]) -> None:
        """A joint that failed cannot be moved."""
        for slider, condition in zip(self.sliders, conditions, strict=True):
            wanted = condition != "healthy"
            if slider.disabled != wanted:
                slider.disabled = wanted

    def time_range(self, end: float, now: float, label: str) -> None:
        """The scrubber of a motion; an end of 0 switches it off."""
        off = end <= 0
        self.time.disabled = self.play.disabled = off
        if not off:
            self.time.min, self.time.max, self.time.step = 0.0, end, end / 1000
            self.time.value = min(now, end)
            self.time.label = label

    def _menu(self, now: str, *kinds: Registry, more: Sequence[str] = ()) -> tuple[str, ...]:
        """What can be chosen, and what is chosen now."""
        known = [label for kind in kinds for label in kind.labels(self.machine.arm, self.machine.task)]
        return tuple(dict.fromkeys([*known, *more, now]))

    # ---- what a person does ----------------------------------------------------------------------------------------

    def _button(self, label: str, what: str, hint: str) -> None:
        self._on(self.gui.add_button(label, hint=hint).on_click, what, lambda h: None)

    def _on(self, attach: Callable[..., Any], what: str, value: Callable[[Any], Any]) -> None:
        # A coroutine runs in order on the event loop; it only leaves a note. What the program itself sets has no client.
        async def told(event: Any) -> None:
            if event.client is not None:
                self._ask(what, value(event.target))

        attach(told)


def slider_range(arm: Arm, k: int, size: float) -> tuple[float, float]:
    """Ends of a joint's slider, rad or m; a whole turn or the arm's length where there is no limit."""
    joint, far = arm.joints[k], size if arm.joints[k].prismatic else np.pi
    return (joint.lower if np.isfinite(joint.lower) else -far), (joint.upper if np.isfinite(joint.upper) else far)


def _slid(k: int, factor: float, handle: Any) -> tuple[int, float]:
    return k, handle.value / factor


def _pressed(k: int, handle: Any) -> tuple[int, str]:
    return k, "locked" if handle.value == "lock" else handle.value


def command_html(state: State) -> str:
    """The command line, to be copied."""
    return (
        '<div style="font:11px/1.4 ui-monospace,monospace;padding:2px 12px 8px;overflow-wrap:anywhere;user-select:all" '
        f"data-command>{escape(state.to_command())}</div>"
    )


def _line(text: str, bad: bool = False) -> str:
    color = "#c8500a" if bad else "#59636e"
    return (
        f'<div data-message style="font:12px/1.35 system-ui,sans-serif;color:{color};padding:4px 12px 2px">{escape(text)}</div>'
    )
