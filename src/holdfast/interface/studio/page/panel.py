"""Controls and live numbers of one window."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.registry import INDEX_REGISTRY, LAW_REGISTRY, SUSCEPTIBILITY_REGISTRY, Registry
from holdfast.core.typing import FloatArray
from holdfast.interface.studio.monitor_demo import FAULT_PARAMETERS, LATEST_ONSET_S, MonitorDemo, monitor_html
from holdfast.interface.studio.page.upload import ARM_SUFFIXES, MOTION_SUFFIXES
from holdfast.interface.studio.scene.bars import bars_html, losses_html
from holdfast.interface.studio.scene.machine import CompiledArm, LiveReading
from holdfast.interface.studio.state import JOINT_CONDITIONS, State
from holdfast.model.arm.model import Arm

Handler = Callable[[Any], None]
PRESSED_PREFIX = "✓ "  # precedes the present condition of a joint, so that the page shows its button as pressed
WELCOME_TEXT = "Drag the handle at the end effector, lock a joint, or drop a file of your own arm here."
ALWAYS_ENABLED = ("skip", "png", "svg", "cell-file", "file", "results")  # actions that need no computed result
MORE_LAWS = ("failure-tolerant:0.1", "failure-tolerant:0.9")


class ControlPanel:
    """Controls of one window.

    Args:
        gui: Viser GUI of the window.
        machine: Compiled arm.
        state: Initial state.
        request_action: Function ``ask(what, value)`` that is called for every action of the user and must return at once.
    """

    def __init__(self, gui: Any, machine: CompiledArm, state: State, request_action: Callable[[str, Any], None]) -> None:
        self.gui, self.machine, self._request_action = gui, machine, request_action
        arm = machine.arm
        self.buttons: dict[str, list[Any]] = {}
        self.message = gui.add_html(_message_html(f"{arm.name}. {WELCOME_TEXT}"))
        self.tour = gui.add_html("", visible=False)
        self._add_button("Take the 60-second tour", "tour")
        self._add_button("Next", "next", visible=False)
        self._add_button("End the tour", "skip", visible=False, color="gray")
        self.nearest = gui.add_html("", visible=machine.cell is not None)
        self.bars = gui.add_html("")
        self.losses = gui.add_html("")
        tabs = gui.add_tab_group()
        with tabs.add_tab("Move"):
            self._add_move_tab(arm, state)
        with tabs.add_tab("Fail"):
            self._add_fail_tab(arm, state)
        with tabs.add_tab("Choose"):
            self._add_choose_tab(state)
        with tabs.add_tab("Motion"):
            self._add_motion_tab(state)
        with tabs.add_tab("Watch"):
            self._add_monitor_tab(arm, state)
        with tabs.add_tab("Region"):
            self._add_region_tab(state)
        with tabs.add_tab("File"):
            self._add_file_tab(state)

    # ---- tabs ------------------------------------------------------------------------------------------------------

    def _add_move_tab(self, arm: Arm, state: State) -> None:
        self.sliders = []
        for index, joint in enumerate(arm.joints):
            factor, unit = joint.display_unit
            step, digits = (0.001, 3) if joint.prismatic else (0.1, 1)
            lower, upper = (round(factor * limit, digits) for limit in slider_range(arm, index, self.machine.size))
            value = round(float(np.clip(factor * state.q[index], lower, upper)), digits)
            slider = self.gui.add_slider(f"{joint.name}, {unit}", lower, upper, step, value)
            self._attach_action(slider.on_update, "joint", partial(_read_slider, index, factor))
            self.sliders.append(slider)
        self.slide = self.gui.add_slider(
            "self-motion", -1.0, 1.0, 0.01, 0.0, hint="Speed along the self-motion of this pose while the slider is held."
        )
        self.buttons["slide"] = [self.slide]
        self._attach_action(self.slide.on_update, "slide", lambda h: h.value)
        direction_count = max(arm.n - self.machine.task.m, 1)
        self.direction = self.gui.add_dropdown(
            "direction",
            tuple(str(index + 1) for index in range(direction_count)),
            visible=direction_count > 1,
            hint="Number of the self-motion, if there are several.",
        )
        self._attach_action(self.direction.on_update, "way", lambda h: int(_read_choice(h)) - 1)
        self._add_button("Back to the start", "home")

    def _add_fail_tab(self, arm: Arm, state: State) -> None:
        self.gui.add_html(
            _message_html("A locked joint cannot move; a free joint has no torque. You can also click a joint in the scene.")
        )
        self.conditions = []
        for index, joint in enumerate(arm.joints):
            group = self.gui.add_button_group(joint.name, _label_condition_buttons(state.conditions[index]))
            self._attach_action(group.on_click, "fail", partial(_read_condition, index))
            self.conditions.append(group)
        self._add_button("All healthy", "heal")
        stated_friction = max(joint.coulomb_friction for joint in arm.joints)
        friction = self.gui.add_number(
            "dry friction, N m", stated_friction, min=0.0, step=0.1, hint="Friction of every joint in a power loss."
        )
        self._attach_action(friction.on_update, "friction", lambda h: max(float(h.value), 0.0))
        self._add_button("Cut the power", "fall")
        self.power_loss = self.gui.add_html("")
        self.susceptibility = self.gui.add_dropdown(
            "susceptibility",
            self._list_choices(state.susceptibility, SUSCEPTIBILITY_REGISTRY),
            initial_value=state.susceptibility,
        )
        self._attach_action(self.susceptibility.on_update, "susceptibility", _read_choice)
        self.weights = self.gui.add_html("")

    def _add_choose_tab(self, state: State) -> None:
        self.index = self.gui.add_dropdown(
            "bars show", self._list_choices(state.index, INDEX_REGISTRY), initial_value=state.index
        )
        self._attach_action(self.index.on_update, "index", _read_choice)
        objectives = self._list_choices(state.objective, INDEX_REGISTRY, SUSCEPTIBILITY_REGISTRY)
        self.objective = self.gui.add_dropdown("choose by", objectives, initial_value=state.objective)
        self._attach_action(self.objective.on_update, "objective", _read_choice)
        self._add_button("Best and worst of this pose", "best-worst")
        self._add_button("Take the green one", "take0")
        self._add_button("Take the orange one", "take1")
        self._add_button("Clear", "clear")

    def _add_motion_tab(self, state: State) -> None:
        self.laws = [
            self.gui.add_dropdown(f"{color} law", self._list_choices(law, LAW_REGISTRY, more=MORE_LAWS), initial_value=law)
            for color, law in zip(("green", "orange"), state.laws, strict=True)
        ]
        for handle in self.laws:
            self._attach_action(handle.on_update, "laws", lambda h: (_read_choice(self.laws[0]), _read_choice(self.laws[1])))
        self._add_button("Choose a target", "target")
        self._add_button("Move under both laws", "laws")
        if state.file is not None:
            self._add_button(f"Open {Path(state.file).name}", "file")
        self.gui.add_html(_message_html("Open the CSV file of a motion of follow, simulate or recover in the tab File."))
        self.time = self.gui.add_slider("time", 0.0, 1.0, 0.001, 0.0, disabled=True)
        self._attach_action(self.time.on_update, "time", lambda h: h.value)
        self._add_button("Play", "play")
        self.play = self.buttons["play"][0]
        self._add_button("Clear", "clear")

    def _add_monitor_tab(self, arm: Arm, state: State) -> None:
        self.gui.add_html(
            _message_html(
                "A joint fails while the arm moves to the target, and a monitor diagnoses it. The time slider is in the tab "
                "Motion."
            )
        )
        kind = self.gui.add_dropdown("fault", tuple(FAULT_PARAMETERS), initial_value=state.fault[0])
        joint = self.gui.add_dropdown("joint", arm.joint_names, initial_value=state.fault[1])
        onset = self.gui.add_slider("onset, s", 0.0, LATEST_ONSET_S, 0.1, state.fault[2])
        for handle in (kind, joint, onset):
            self._attach_action(
                handle.on_update, "fault", lambda _: (_read_choice(kind), _read_choice(joint), float(onset.value))
            )
        self._add_button("Move, fail and watch", "watch")
        self._add_button("Inject the fault now", "inject")
        self.monitor = self.gui.add_html("", visible=False)
        self._add_button("Clear", "clear")

    def _add_region_tab(self, state: State) -> None:
        self._add_button("Assess around the tool", "region")
        if state.region is not None:
            self._add_button(f"Open {Path(state.region).name}", "results")
        self.gui.add_html(
            _message_html(
                "Poses around the tool, coloured by the index. Click one to see its configuration. "
                "To show results of holdfast assess, start the studio with --region FOLDER."
            )
        )
        self._add_button("Clear", "clear")

    def _add_file_tab(self, state: State) -> None:
        endings = ",".join((*ARM_SUFFIXES, *MOTION_SUFFIXES))
        self.upload = self.gui.add_upload_button("Open an arm or a motion", mime_type=endings)
        self._attach_action(self.upload.on_upload, "open", lambda h: (h.value.name, h.value.content))
        self.gui.add_html(
            _message_html(
                "An arm as URDF or DH table, or a motion as CSV, of at most 4 MiB. You can also drop the file on the page. "
                "For an arm with meshes, use holdfast studio FILE."
            )
        )
        self._add_button("PNG of the scene", "png")
        self._add_button("SVG drawing, side and top view", "svg")
        self._add_button("Save the cell", "cell-file", visible=self.machine.cell is not None)
        for label, action in (("ellipsoids and lost directions", "losses"), ("names of the joints", "labels")):
            self._attach_action(self.gui.add_checkbox(label, True).on_update, action, lambda h: h.value)
        self.gui.add_html(_message_html("This command restores the view:"))
        self.command = self.gui.add_html(command_html(state))

    # ---- display ---------------------------------------------------------------------------------------------------

    def show_message(self, text: str, is_error: bool = False) -> None:
        """Show a message in the line at the top."""
        content = _message_html(text, is_error)
        if self.message.content != content:
            self.message.content = content

    def show_nearest(self, text: str, is_error: bool) -> None:
        """Show the object of the cell that is nearest to the arm."""
        content = _message_html(text, is_error)
        if self.nearest.content != content:
            self.nearest.content = content

    def show_monitor(self, demo: MonitorDemo | None, state: State) -> None:
        """Show the residuals and findings of the monitor until the time of the state."""
        content = "" if demo is None else monitor_html(demo, state.names, state.time)
        if self.monitor.content != content:
            self.monitor.content, self.monitor.visible = content, content != ""

    def show_reading(self, reading: LiveReading, state: State) -> None:
        """Show the live numbers."""
        names, arm = state.names, self.machine.arm
        pieces = (
            (self.bars, bars_html(reading.bars, "if the joint locks", names, state.conditions)),
            (self.losses, losses_html(arm, self.machine.task, reading, state.failed_joints)),
            (self.weights, bars_html(reading.weights, "if the joint swings free", names, state.conditions)),
            (self.power_loss, _message_html(reading.power_loss)),
            (self.command, command_html(state)),
        )
        for handle, content in pieces:
            if handle.content != content:
                handle.content = content

    def move_sliders(self, q: FloatArray, dragged_joint: int | None) -> None:
        """Move the sliders to the configuration q (n,), except the one that is being dragged."""
        for index, (slider, joint) in enumerate(zip(self.sliders, self.machine.arm.joints, strict=True)):
            value = round(float(np.clip(joint.display_unit[0] * q[index], slider.min, slider.max)), 3 if joint.prismatic else 1)
            if index != dragged_joint and abs(slider.value - value) > 0.5 * slider.step:
                slider.value = value

    def show_conditions(self, conditions: Sequence[str]) -> None:
        """Show the condition of each joint, and disable the sliders of failed joints."""
        for slider, group, condition in zip(self.sliders, self.conditions, conditions, strict=True):
            is_failed = condition != "healthy"
            if slider.disabled != is_failed:
                slider.disabled = is_failed
            if group.options != _label_condition_buttons(condition):
                group.options = _label_condition_buttons(condition)

    def enable_controls(self, possible: Mapping[str, bool]) -> None:
        """Enable or disable the buttons and sliders of the listed actions, and leave the others unchanged."""
        for action, is_possible in possible.items():
            for handle in self.buttons.get(action, ()):
                if handle.disabled is is_possible:
                    handle.disabled = not is_possible

    def show_tour(self, text: str, next_label: str = "") -> None:
        """Show a step of the tour, HTML, and the label of the next button; an empty text hides the tour."""
        if self.tour.content != text:
            self.tour.content = text
        begin_button, next_button, end_button = (self.buttons[action][0] for action in ("tour", "next", "skip"))
        for handle, visible in (
            (self.tour, text != ""),
            (begin_button, text == ""),
            (next_button, text != ""),
            (end_button, text != ""),
        ):
            if handle.visible is not visible:
                handle.visible = visible
        if next_label and next_button.label != next_label:
            next_button.label = next_label

    def set_time_range(self, end: float, current: float, label: str) -> None:
        """Set the range of the time slider of a motion; an end of 0 disables it."""
        self.time.disabled = self.play.disabled = end <= 0
        if end > 0:
            self.time.min, self.time.max, self.time.step = 0.0, end, end / 1000
            self.time.value = min(current, end)
            self.time.label = label

    def _list_choices(self, current: str, *kinds: Registry, more: Sequence[str] = ()) -> tuple[str, ...]:
        """List the available choices, including the current one."""
        known = [label for kind in kinds for label in kind.labels(self.machine.arm, self.machine.task)]
        return tuple(dict.fromkeys([*known, *more, current]))

    # ---- user actions ----------------------------------------------------------------------------------------------

    def _add_button(self, label: str, action: str, visible: bool = True, color: str | None = None) -> None:
        button = self.gui.add_button(label, visible=visible, color=color, disabled=action not in ALWAYS_ENABLED)
        self.buttons.setdefault(action, []).append(button)
        self._attach_action(button.on_click, action, lambda h: None)

    def _attach_action(self, attach: Callable[..., Any], action: str, value: Callable[[Any], Any]) -> None:
        # A coroutine runs in order on the event loop, and only queues a request. Changes by the program itself have no client.
        async def forward_event(event: Any) -> None:
            if event.client is not None:
                self._request_action(action, value(event.target))

        attach(forward_event)


def slider_range(arm: Arm, index: int, size: float) -> tuple[float, float]:
    """Return the ends of a joint's slider, rad or m: a full revolution or the arm's length where there is no limit."""
    joint, default_limit = arm.joints[index], size if arm.joints[index].prismatic else np.pi
    return (joint.lower if np.isfinite(joint.lower) else -default_limit), (
        joint.upper if np.isfinite(joint.upper) else default_limit
    )


def _read_slider(joint: int, factor: float, handle: Any) -> tuple[int, float]:
    return joint, handle.value / factor


def _read_choice(menu: Any) -> str:
    """Return the choice of a menu; a client may send anything, so an unknown choice becomes the first option."""
    return str(menu.value if menu.value in menu.options else menu.options[0])


def _read_condition(joint: int, handle: Any) -> tuple[int, str]:
    return joint, _read_choice(handle).removeprefix(PRESSED_PREFIX)


def _label_condition_buttons(condition: str) -> tuple[str, ...]:
    return tuple(f"{PRESSED_PREFIX}{option}" if option == condition else option for option in JOINT_CONDITIONS)


def command_html(state: State) -> str:
    """Format the command line as HTML that can be copied."""
    return f'<div class="hf-command" data-command>{escape(state.to_command())}</div>'


def _message_html(text: str, is_error: bool = False) -> str:
    return f'<div data-message class="hf-line"{" data-bad" if is_error else ""}>{escape(text)}</div>'
