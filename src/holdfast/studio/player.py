"""Ghost arms beside the arm, and motions that move them, or the arm itself."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.studio.motions import Motion
from holdfast.studio.page.panel import Panel
from holdfast.studio.scene.stage import GHOSTS, Stage
from holdfast.studio.work import TICK, Clock

Array = NDArray[np.float64]


class Player:
    """The ghosts beside the arm of one window, and what moves them.

    Args:
        stage: The scene.
        panel: The controls.
        clock: What plays; nothing else uses it at the same time.
        moved: Is told the time of the motion and, where no ghost shows it, the configuration (n,) of the arm itself.
    """

    def __init__(self, stage: Stage, panel: Panel, clock: Clock, moved: Callable[[float, Array | None], None]) -> None:
        self._stage, self._panel, self._clock, self._moved = stage, panel, clock, moved
        self._arm = stage.machine.arm
        self._motions: list[Motion] = []
        self.ghosts: list[Array] = []
        self.playing = False
        self._now = 0.0

    def place(self, configurations: list[Array], labels: Sequence[str]) -> None:
        """Put ghosts at configurations (n,)."""
        self.stop()
        self.ghosts = configurations
        self._stage.haunt(labels)
        self._stage.move_ghosts([self._arm.frames(q) for q in configurations])

    def show(self, motions: list[Motion], colors: tuple[Any, ...], time: float) -> None:
        """Show motions, each by a ghost of its colour, or the first by the arm itself where there are no colours.

        What was asked for moves at once; a view that a command line brought back (at a time above 0) stays where it was.
        """
        self.stop()
        self._motions = motions
        self._stage.haunt([m.label.partition(":")[0] for m in motions] if colors else [], colors or GHOSTS)
        end = max(float(m.time[-1]) for m in motions)
        begin = min(time, end) if time > 0 else 0.0
        self._panel.time_range(end, begin, f"time, {motions[0].unit}" if motions[0].unit != "rad" else "travel, rad")
        self.seek(begin)
        if colors and end > 0 and not begin:
            self.play()

    def clear(self) -> None:
        """Take ghosts and motions away."""
        self.stop()
        self._stage.lay()
        self.ghosts = []

    def stop(self) -> None:
        """Forget the motions; ghosts stay where they are."""
        self.pause()
        self._motions = []
        self._panel.time_range(0.0, 0.0, "")

    def seek(self, time: float) -> None:
        """Show the motions at a time."""
        if not self._motions:
            return
        self._now = float(time)
        if abs(self._panel.time.value - time) > self._panel.time.step:
            self._panel.time.value = self._now
        shown = [m.at(time) for m in self._motions]
        if self._stage.ghosts:
            self.ghosts = shown
            self._stage.move_ghosts([self._arm.frames(q) for q in shown])
            self._moved(self._now, None)
        else:
            self._moved(self._now, shown[0])

    def pause(self) -> None:
        """Stop playing."""
        if self.playing:
            self.playing = False
            self._clock.stop()
            self._panel.play.label = "Play"

    def play(self) -> None:
        """Play on, or from the start if it has ended; stop if it plays."""
        if self.playing or not self._motions:
            self.pause()
            return
        self.playing, self._panel.play.label = True, "Stop"
        end = max(float(m.time[-1]) for m in self._motions)
        if self._now >= end * (1 - 1e-9):
            self._now = 0.0
        # What takes longer than ten seconds is played in ten; a swing in real time shows best.
        pace = max(end / 10.0, 1.0) if self._motions[0].unit == "s" else end / 10.0

        def on() -> None:
            now = self._now + TICK * pace
            self.seek(min(now, end))
            if now >= end:
                self.pause()

        self._clock.start(on)
