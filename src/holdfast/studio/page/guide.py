"""The tour: at most six steps in a minute. Each says what is to be seen, and does it in the page itself."""

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
        worst: The joint whose lock cost most when the tour began.
        kept: What is left of the manipulability now, if the worst joint locks or with what has failed.
        before: The same when the joint was locked first.
        hopeless: A direction is lost with that joint in every configuration.
        busy: Something is being computed.
    """

    worst: str
    kept: str
    before: str
    hopeless: bool
    busy: bool


@dataclass(frozen=True)
class Step:
    """One step.

    Attributes:
        title: Its title.
        text: What it says, from what is to be seen.
        do: What it asks of the window; ``worst`` in place of a joint is the worst one.
        after: What the button for the next step says.
        always: It makes sense where no configuration is better than another.
    """

    title: str
    text: Callable[[Sight], str]
    do: tuple[Ask, ...]
    after: str
    always: bool = True


def _first(sight: Sight) -> str:
    if sight.hopeless:
        return f"No configuration makes up for every joint: when {sight.worst} locks, a direction of motion is lost for ever."
    return f"A bar is what is left of the manipulability of the tool if that joint locks. Here {sight.worst} costs most."


def _locked(sight: Sight) -> str:
    return (
        f"{sight.worst} is locked: {sight.kept} of the manipulability is left. The blue wire is how fast the tool could go, "
        "the orange body how fast it still can. The orange line and ring are the motion that loses most."
    )


def _optimised(sight: Sight) -> str:
    if sight.busy:
        return "The same tool pose can be held in many configurations. Looking for the best and the worst ..."
    return "Same tool pose, two other configurations: if its worst joint locks, the green ghost loses least, the orange most."


def _compared(sight: Sight) -> str:
    return (
        f"The arm took the green configuration without moving the tool, and {sight.worst} is locked again: {sight.kept} of the "
        f"manipulability is left, where it was {sight.before}."
    )


def _driven(sight: Sight) -> str:
    if sight.busy:
        return "Two controllers that know nothing of the lock bring the tool to the second handle. Compiling and simulating ..."
    return "Two controllers that know nothing of the lock, side by side. The line on top says where each of them ends."


def _last(_: Sight) -> str:
    return "Drag the handle, click joints, or drop the URDF file or DH table of your own arm on the page."


STEPS = (
    Step("Which joint matters most", _first, (), "Next: lock it"),
    Step("A joint locks", _locked, (("fail", ("worst", "locked")),), "Next"),
    Step("Optimise before it fails", _optimised, (("heal", None), ("best-worst", None)), "Next: compare", always=False),
    Step("Compare", _compared, (("take0", None), ("fail", ("worst", "locked"))), "Next: move", always=False),
    Step("Move without knowing", _driven, (("target", None), ("laws", None)), "Next: your own arm"),
    Step("Your turn", _last, (("clear", None), ("heal", None), ("home", None)), "Done"),
)
NOTHING = 1e-6  # of the manipulability: what is left of a direction that is lost


class Guide:
    """Where the tour of one window is.

    Args:
        ask: ``ask(what, value)`` does something in the window.
        show: Is given the HTML of a step and the label of the button after it; an empty text ends the tour.
    """

    def __init__(self, ask: Callable[[str, Any], None], show: Callable[[str, str], None]) -> None:
        self._ask, self._show = ask, show
        self._steps: tuple[Step, ...] = ()
        self._step: int | None = None
        self._worst, self._before, self._hopeless = 0, "", False

    def begin(self, reading: Reading) -> None:
        """Show the first step, about the joint that is the worst one now; steps that could show nothing are left out."""
        bars = reading.bars
        self._hopeless = isinstance(bars, str) or bool(bars.values[bars.worst] < NOTHING)
        self._worst = 0 if isinstance(bars, str) else bars.worst
        self._steps = tuple(step for step in STEPS if step.always or not self._hopeless)
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
        if step >= len(self._steps):
            self.end()
            return
        self._step = step
        for what, value in self._steps[step].do:
            self._ask(what, (self._worst, value[1]) if what == "fail" else value)

    def tell(self, reading: Reading, names: tuple[str, ...], busy: bool) -> None:
        """Say what the present step has to say about what is shown now."""
        if self._step is None:
            return
        kept = percent(manipulability_kept(reading.losses))
        if self._step == 1:
            self._before = kept
        step = self._steps[self._step]
        text = step.text(Sight(names[self._worst], kept, self._before, self._hopeless, busy))
        head = f"<b>{self._step + 1} of {len(self._steps)}: {step.title}</b><br>"
        self._show(f'<div class="hf-tour" data-tour="{self._step + 1}" role="status">{head}{escape(text)}</div>', step.after)
