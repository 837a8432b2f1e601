"""The tour: six steps in a minute. Each says what is to be seen, and does it in the page itself."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from html import escape
from typing import Any

from holdfast.indices.lost_directions import manipulability_kept
from holdfast.studio.scene.bars import percent
from holdfast.studio.scene.machine import Reading

Ask = tuple[str, Any]


@dataclass(frozen=True)
class Sight:
    """What a step may speak of.

    Attributes:
        arm: The name of the arm.
        worst: The joint whose lock cost most when the tour began.
        kept: What is left of the manipulability now, if the worst joint locks or with what has failed.
        before: The same when the tour began.
        redundant: Whether a joint may lock without a direction being lost for ever.
        busy: Something is being computed.
    """

    arm: str
    worst: str
    kept: str
    before: str
    redundant: bool
    busy: bool


@dataclass(frozen=True)
class Step:
    """One step.

    Attributes:
        title: Its title.
        text: What it says, from what is to be seen.
        do: What it asks of the window; ``worst`` in place of a joint is the worst one.
        after: What the button for the next step says.
    """

    title: str
    text: Callable[[Sight], str]
    do: tuple[Ask, ...]
    after: str


def _optimised(sight: Sight) -> str:
    if not sight.redundant:
        return (
            f"{sight.arm} has no joint more than the task needs, so every configuration loses a direction with every joint. "
            "A task with fewer directions would leave it some: start the studio with --task."
        )
    if sight.busy:
        return "The same tool pose can be held in many configurations. Looking for the best and the worst ..."
    return "Same tool pose, two other configurations: if its worst joint locks, the green ghost loses least, the orange most."


def _compared(sight: Sight) -> str:
    if not sight.redundant:
        return f"{sight.worst} is locked again: {sight.kept} of the manipulability is left, here as anywhere."
    return (
        f"The arm took the green configuration without moving the tool, and {sight.worst} is locked again: {sight.kept} of the "
        f"manipulability is left, where it was {sight.before}."
    )


def _driven(sight: Sight) -> str:
    if sight.busy:
        return "Two controllers that know nothing of the lock bring the tool to the second handle. Compiling and simulating ..."
    return "Two controllers that know nothing of the lock, side by side. The line on top says where each of them ends."


STEPS = (
    Step(
        "Which joint matters most",
        lambda s: f"A bar is what is left of the manipulability of the tool if that joint locks. Here {s.worst} costs most.",
        (),
        "Next: lock it",
    ),
    Step(
        "A joint locks",
        lambda s: (
            f"{s.worst} is locked: {s.kept} of the manipulability is left. The blue wire is how fast the tool could go, "
            "the orange body how fast it still can. The orange line and ring are the motion that loses most."
        ),
        (("fail", ("worst", "locked")),),
        "Next: a better configuration",
    ),
    Step("Optimise before it fails", _optimised, (("heal", None), ("best-worst", None)), "Next: compare"),
    Step("Compare", _compared, (("take0", None), ("fail", ("worst", "locked"))), "Next: move"),
    Step("Move without knowing", _driven, (("target", None), ("laws", None)), "Next: your own arm"),
    Step(
        "Your turn",
        lambda s: "Drag the handle, click joints, or drop the URDF file or DH table of your own arm on the page.",
        (("clear", None), ("heal", None), ("home", None)),
        "Done",
    ),
)


class Guide:
    """Where the tour of one window is.

    Args:
        ask: ``ask(what, value)`` does something in the window.
        show: Is given the HTML of a step and the label of the button after it; an empty text ends the tour.
    """

    def __init__(self, ask: Callable[[str, Any], None], show: Callable[[str, str], None]) -> None:
        self._ask, self._show = ask, show
        self._step: int | None = None
        self._worst, self._before = 0, ""

    @property
    def under_way(self) -> bool:
        """Whether a step is shown."""
        return self._step is not None

    def begin(self, reading: Reading) -> None:
        """Show the first step, about the joint that is the worst one now."""
        bars = reading.bars
        self._worst = bars.worst if not isinstance(bars, str) else 0
        self._before = ""
        self._go(0)

    def next(self) -> None:
        """Show the next step; after the last the tour has ended."""
        if self._step is not None:
            self._go(self._step + 1)

    def end(self) -> None:
        """No step is shown any more; what was done stays."""
        self._step = None
        self._show("", "")

    def _go(self, step: int) -> None:
        if step >= len(STEPS):
            self.end()
            return
        self._step = step
        for what, value in STEPS[step].do:
            self._ask(what, (self._worst, value[1]) if what == "fail" else value)

    def tell(self, reading: Reading, arm: str, names: tuple[str, ...], *, redundant: bool, busy: bool) -> None:
        """Say what the present step has to say about what is shown now."""
        if self._step is None:
            return
        kept = percent(manipulability_kept(reading.losses))
        if self._step == 1:
            self._before = kept
        step = STEPS[self._step]
        text = step.text(Sight(arm, names[self._worst], kept, self._before, redundant, busy))
        head = f"<b>{self._step + 1} of {len(STEPS)}: {step.title}</b><br>"
        self._show(f'<div class="hf-tour" data-tour="{self._step + 1}" role="status">{head}{escape(text)}</div>', step.after)
