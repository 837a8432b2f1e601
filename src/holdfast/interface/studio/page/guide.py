"""Guided tour of at most six steps in a minute; each step explains an effect and demonstrates it on the page."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from html import escape
from typing import Any

from holdfast.interface.studio.scene.bars import format_percent
from holdfast.interface.studio.scene.machine import LiveReading
from holdfast.kinematics.indices.lost_directions import remaining_manipulability

Ask = tuple[str, Any]


@dataclass(frozen=True)
class GuideContext:
    """Values that the text of a step can mention.

    Attributes:
        worst: Name of the joint whose lock costs most at the start of the tour.
        remaining: Remaining manipulability now, if the worst joint locks or with the failed joints.
        remaining_before: Remaining manipulability when the joint was first locked.
        is_hopeless: True if a direction is lost with that joint in every configuration.
        is_busy: True during a computation.
    """

    worst: str
    remaining: str
    remaining_before: str
    is_hopeless: bool
    is_busy: bool


@dataclass(frozen=True)
class TourStep:
    """Step of the tour.

    Attributes:
        title: Title of the step.
        text: Function that returns the text of the step.
        actions: Actions in the window; ``worst`` instead of a joint means the worst one.
        button_label: Label of the button for the next step.
        always: True if the step is useful even if no configuration is better than another.
    """

    title: str
    text: Callable[[GuideContext], str]
    actions: tuple[Ask, ...]
    button_label: str
    always: bool = True


def _explain_bars(context: GuideContext) -> str:
    if context.is_hopeless:
        return f"No configuration tolerates every lock: a lock of {context.worst} always removes a direction of motion."
    text = "Each bar is the fraction of the tool's manipulability that remains if this joint locks."
    return f"{text} Here, a lock of {context.worst} costs most."


def _explain_lock(context: GuideContext) -> str:
    return (
        f"{context.worst} is locked, and {context.remaining} of the manipulability remains. The blue wire frame shows how fast "
        "the healthy arm can translate the tool, the orange body how fast it still can. The orange line and ring mark the "
        "motion that loses most speed."
    )


def _explain_optimisation(context: GuideContext) -> str:
    if context.is_busy:
        return "Many configurations hold the same tool pose. Searching for the best and the worst ..."
    return "Two other configurations of this pose: if its worst joint locks, the green one loses least, the orange one most."


def _explain_comparison(context: GuideContext) -> str:
    return (
        f"The arm took the green configuration without moving the tool, and {context.worst} is locked again. Now "
        f"{context.remaining} of the manipulability remains, compared with {context.remaining_before} before."
    )


def _explain_motion(context: GuideContext) -> str:
    if context.is_busy:
        return "Two controllers that are not informed of the lock move to the second handle. Compiling and simulating ..."
    return "Two controllers that are not informed of the lock, side by side. The line at the top gives the result of each."


def _explain_next_steps(_: GuideContext) -> str:
    return "Drag the handle, click joints, or drop the URDF file or DH table of your own arm on the page."


TOUR_STEPS = (
    TourStep("Find the critical joint", _explain_bars, (), "Next: lock it"),
    TourStep("A joint locks", _explain_lock, (("fail", ("worst", "locked")),), "Next"),
    TourStep(
        "Optimise before it fails", _explain_optimisation, (("heal", None), ("best-worst", None)), "Next: compare", always=False
    ),
    TourStep("Compare", _explain_comparison, (("take0", None), ("fail", ("worst", "locked"))), "Next: move", always=False),
    TourStep("Move with an undetected lock", _explain_motion, (("target", None), ("laws", None)), "Next: your own arm"),
    TourStep("Your turn", _explain_next_steps, (("clear", None), ("heal", None), ("home", None)), "Done"),
)
LOST_MANIPULABILITY = 1e-6  # remaining fraction of the manipulability below which a direction is lost


class TourGuide:
    """Progress of the tour in one window.

    Args:
        request_action: Function ``ask(what, value)`` that requests an action in the window.
        show_html: Function that is called with the HTML of a step and the next button label; an empty text ends the tour.
    """

    def __init__(self, request_action: Callable[[str, Any], None], show_html: Callable[[str, str], None]) -> None:
        self._request_action, self._show_html = request_action, show_html
        self._steps: tuple[TourStep, ...] = ()
        self._step: int | None = None
        self._worst, self._before, self._hopeless = 0, "", False

    def begin_tour(self, reading: LiveReading) -> None:
        """Show the first step, about the joint that is the worst now; steps without an effect are left out."""
        bars = reading.bars
        self._hopeless = isinstance(bars, str) or bool(bars.values[bars.worst] < LOST_MANIPULABILITY)
        self._worst = 0 if isinstance(bars, str) else bars.worst
        self._steps = tuple(step for step in TOUR_STEPS if step.always or not self._hopeless)
        self._go_to_step(0)

    def show_next(self) -> None:
        """Show the next step, or end the tour after the last one."""
        if self._step is not None:
            self._go_to_step(self._step + 1)

    def end_tour(self) -> None:
        """Hide the tour; its effects remain."""
        self._step = None
        self._show_html("", "")

    def _go_to_step(self, step: int) -> None:
        if step >= len(self._steps):
            self.end_tour()
            return
        self._step = step
        for action, value in self._steps[step].actions:
            self._request_action(action, (self._worst, value[1]) if action == "fail" else value)

    def show_step(self, reading: LiveReading, names: tuple[str, ...], busy: bool) -> None:
        """Show the text of the present step for the displayed reading."""
        if self._step is None:
            return
        remaining = format_percent(remaining_manipulability(reading.losses))
        if self._step == 1:
            self._before = remaining
        step = self._steps[self._step]
        text = step.text(GuideContext(names[self._worst], remaining, self._before, self._hopeless, busy))
        heading = f"<b>{self._step + 1} of {len(self._steps)}: {step.title}</b><br>"
        self._show_html(
            f'<div class="hf-tour" data-tour="{self._step + 1}" role="status">{heading}{escape(text)}</div>', step.button_label
        )
