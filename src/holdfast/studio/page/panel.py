"""The controls and numbers of one window."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.registry import INDICES, LAWS, SUSCEPTIBILITIES, Registry
from holdfast.studio.page.upload import ARMS, MOTIONS
from holdfast.studio.scene.bars import bars_html, losses_html
from holdfast.studio.scene.machine import Machine, Reading
from holdfast.studio.state import CONDITIONS, State
from holdfast.studio.watching import KINDS, LATEST, Watched, watched_html

Array = NDArray[np.float64]
Handler = Callable[[Any], None]
MARK = "✓ "  # before the state that a joint is in: the page shows that button as pressed
WELCOME = "Drag the handle at the end effector, lock a joint, or drop a file of your own arm here."
ALWAYS = ("skip", "png", "svg", "cell-file", "file", "results")  # what can be done before anything is known
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
        self.buttons: dict[str, list[Any]] = {}
        self.message = gui.add_html(_line(f"{arm.name}. {WELCOME}"))
        self.tour = gui.add_html("", visible=False)
        self._button("Take the 60-second tour", "tour")
        self._button("Next", "next", visible=False)
        self._button("End the tour", "skip", visible=False, color="gray")
        self.near = gui.add_html("", visible=machine.cell is not None)
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
        with tabs.add_tab("Watch"):
            self._watch_tab(arm, state)
        with tabs.add_tab("Region"):
            self._region_tab(state)
        with tabs.add_tab("File"):
            self._file_tab(state)

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
        self.buttons["slide"] = [self.slide]
        self._on(self.slide.on_update, "slide", lambda h: h.value)
        ways = max(arm.n - self.machine.task.m, 1)
        self.way = self.gui.add_dropdown(
            "direction", tuple(str(k + 1) for k in range(ways)), visible=ways > 1, hint="Which of several self-motions."
        )
        self._on(self.way.on_update, "way", lambda h: int(_chosen(h)) - 1)
        self._button("Back to the start", "home")

    def _fail_tab(self, arm: Arm, state: State) -> None:
        self.gui.add_html(_line("Locked: cannot move. Free: swings under gravity. Or click a joint in the scene."))
        self.conditions = []
        for k, joint in enumerate(arm.joints):
            group = self.gui.add_button_group(joint.name, _marked(state.conditions[k]))
            self._on(group.on_click, "fail", partial(_pressed, k))
            self.conditions.append(group)
        self._button("All healthy", "heal")
        self._button("Let the free joint swing", "swing")
        self.susceptibility = self.gui.add_dropdown(
            "susceptibility", self._menu(state.susceptibility, SUSCEPTIBILITIES), initial_value=state.susceptibility
        )
        self._on(self.susceptibility.on_update, "susceptibility", _chosen)
        self.weights = self.gui.add_html("")

    def _choose_tab(self, state: State) -> None:
        self.index = self.gui.add_dropdown("bars show", self._menu(state.index, INDICES), initial_value=state.index)
        self._on(self.index.on_update, "index", _chosen)
        objectives = self._menu(state.objective, INDICES, SUSCEPTIBILITIES)
        self.objective = self.gui.add_dropdown("choose by", objectives, initial_value=state.objective)
        self._on(self.objective.on_update, "objective", _chosen)
        self._button("Best and worst of this pose", "best-worst")
        self._button("Take the green one", "take0")
        self._button("Take the orange one", "take1")
        self._button("Clear", "clear")

    def _motion_tab(self, state: State) -> None:
        self.laws = [
            self.gui.add_dropdown(f"{c} law", self._menu(law, LAWS, more=MORE_LAWS), initial_value=law)
            for c, law in zip(("green", "orange"), state.laws, strict=True)
        ]
        for handle in self.laws:
            self._on(handle.on_update, "laws", lambda h: (_chosen(self.laws[0]), _chosen(self.laws[1])))
        self._button("Choose a target", "target")
        self._button("Move under both laws", "laws")
        if state.file is not None:
            self._button(f"Open {Path(state.file).name}", "file")
        self.gui.add_html(_line("A motion that follow, simulate or recover wrote (CSV) is opened in the tab File."))
        self.time = self.gui.add_slider("time", 0.0, 1.0, 0.001, 0.0, disabled=True)
        self._on(self.time.on_update, "time", lambda h: h.value)
        self._button("Play", "play")
        self.play = self.buttons["play"][0]
        self._button("Clear", "clear")

    def _watch_tab(self, arm: Arm, state: State) -> None:
        self.gui.add_html(
            _line("A joint fails while the arm moves to the target: what does a monitor make of it? Time is in the tab Motion.")
        )
        kind = self.gui.add_dropdown("fault", tuple(KINDS), initial_value=state.fault[0])
        joint = self.gui.add_dropdown("of joint", arm.joint_names, initial_value=state.fault[1])
        onset = self.gui.add_slider("begins after, s", 0.0, LATEST, 0.1, state.fault[2])
        for handle in (kind, joint, onset):
            self._on(handle.on_update, "fault", lambda _: (_chosen(kind), _chosen(joint), float(onset.value)))
        self._button("Move, fail and watch", "watch")
        self._button("Inject the fault now", "inject")
        self.watched, self.record = self.gui.add_html("", visible=False), self.gui.add_html("")
        self._button("Clear", "clear")

    def _region_tab(self, state: State) -> None:
        self._button("Assess around the tool", "region")
        if state.region is not None:
            self._button(f"Open {Path(state.region).name}", "results")
        self.gui.add_html(
            _line(
                "Poses around the tool, coloured by the index: click one to see the configuration behind it. "
                "Results of holdfast assess: start the studio with --region FOLDER."
            )
        )
        self._button("Clear", "clear")

    def _file_tab(self, state: State) -> None:
        endings = ",".join((*ARMS, *MOTIONS))
        self.upload = self.gui.add_upload_button("Open an arm or a motion", mime_type=endings)
        self._on(self.upload.on_upload, "open", lambda h: (h.value.name, h.value.content))
        self.gui.add_html(
            _line(
                "An arm as URDF or DH table, or a motion as CSV, of at most 4 MiB; or drop it anywhere on the page. "
                "With meshes: holdfast studio FILE."
            )
        )
        self._button("PNG of the scene", "png")
        self._button("SVG drawing, side and top view", "svg")
        self._button("Save the cell", "cell-file", visible=self.machine.cell is not None)
        for label, what in (("ellipsoids and lost directions", "losses"), ("names of the joints", "labels")):
            self._on(self.gui.add_checkbox(label, True).on_update, what, lambda h: h.value)
        self.gui.add_html(_line("This command line brings the view back:"))
        self.command = self.gui.add_html(command_html(state))

    # ---- reading ---------------------------------------------------------------------------------------------------

    def say(self, text: str, bad: bool = False) -> None:
        """The line at the top."""
        content = _line(text, bad)
        if self.message.content != content:
            self.message.content = content

    def tell_nearest(self, text: str, bad: bool) -> None:
        """What of the cell is nearest to the arm."""
        content = _line(text, bad)
        if self.near.content != content:
            self.near.content = content

    def tell_watched(self, found: Watched | None, state: State) -> None:
        """What a monitor saw until the time of the state."""
        content = "" if found is None else watched_html(found, state.names, state.time)
        if self.watched.content != content:
            self.watched.content, self.watched.visible = content, content != ""
        record = "" if found is None else found.record
        if self.record.content != record:
            self.record.content = record

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

    def fail(self, conditions: Sequence[str]) -> None:
        """A joint shows what has become of it, and cannot be moved once it has failed."""
        for slider, group, condition in zip(self.sliders, self.conditions, conditions, strict=True):
            wanted = condition != "healthy"
            if slider.disabled != wanted:
                slider.disabled = wanted
            if group.options != _marked(condition):
                group.options = _marked(condition)

    def enable(self, possible: Mapping[str, bool]) -> None:
        """Buttons and sliders that can do something now, by what they ask for; all others are as they were."""
        for what, can in possible.items():
            for handle in self.buttons.get(what, ()):
                if handle.disabled is can:
                    handle.disabled = not can

    def guide(self, text: str, after: str = "") -> None:
        """A step of the tour, HTML, and what comes after it; an empty text: no tour is under way."""
        if self.tour.content != text:
            self.tour.content = text
        begin, on, end = (self.buttons[what][0] for what in ("tour", "next", "skip"))
        for handle, visible in ((self.tour, text != ""), (begin, text == ""), (on, text != ""), (end, text != "")):
            if handle.visible is not visible:
                handle.visible = visible
        if after and on.label != after:
            on.label = after

    def time_range(self, end: float, now: float, label: str) -> None:
        """The scrubber of a motion; an end of 0 switches it off."""
        self.time.disabled = self.play.disabled = end <= 0
        if end > 0:
            self.time.min, self.time.max, self.time.step = 0.0, end, end / 1000
            self.time.value = min(now, end)
            self.time.label = label

    def _menu(self, now: str, *kinds: Registry, more: Sequence[str] = ()) -> tuple[str, ...]:
        """What can be chosen, and what is chosen now."""
        known = [label for kind in kinds for label in kind.labels(self.machine.arm, self.machine.task)]
        return tuple(dict.fromkeys([*known, *more, now]))

    # ---- what a person does ----------------------------------------------------------------------------------------

    def _button(self, label: str, what: str, visible: bool = True, color: str | None = None) -> None:
        button = self.gui.add_button(label, visible=visible, color=color, disabled=what not in ALWAYS)
        self.buttons.setdefault(what, []).append(button)
        self._on(button.on_click, what, lambda h: None)

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


def _chosen(menu: Any) -> str:
    """What is chosen of a menu. A client may send anything, and a label may name a file."""
    return str(menu.value if menu.value in menu.options else menu.options[0])


def _pressed(k: int, handle: Any) -> tuple[int, str]:
    return k, _chosen(handle).removeprefix(MARK)


def _marked(condition: str) -> tuple[str, ...]:
    return tuple(f"{MARK}{x}" if x == condition else x for x in CONDITIONS)


def command_html(state: State) -> str:
    """The command line, to be copied."""
    return f'<div class="hf-command" data-command>{escape(state.to_command())}</div>'


def _line(text: str, bad: bool = False) -> str:
    return f'<div data-message class="hf-line"{" data-bad" if bad else ""}>{escape(text)}</div>'
