"""Ghost arms next to the arm, and the playback of motions by the ghosts or by the arm itself."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from holdfast.core.typing import FloatArray
from holdfast.interface.studio.motions import PlayedMotion
from holdfast.interface.studio.page.panel import ControlPanel
from holdfast.interface.studio.scene.stage import GHOST_COLORS, Stage
from holdfast.interface.studio.work import TICK_S, Clock


class Player:
    """Ghosts of one window, and the playback of motions.

    Args:
        stage: Scene of the window.
        panel: Controls of the window.
        clock: Clock of the playback, which nothing else uses at the same time.
        on_moved: Function that is called with the time of the motion and, if no ghost shows it, the configuration (n,).
    """

    def __init__(
        self, stage: Stage, panel: ControlPanel, clock: Clock, on_moved: Callable[[float, FloatArray | None], None]
    ) -> None:
        self._stage, self._panel, self._clock, self._on_moved = stage, panel, clock, on_moved
        self._arm = stage.machine.arm
        self._motions: list[PlayedMotion] = []
        self.ghosts: list[FloatArray] = []
        self.is_playing = False
        self._current_time = 0.0

    def place_ghosts(self, configurations: list[FloatArray], labels: Sequence[str]) -> None:
        """Place ghosts at configurations (n,), with one label each."""
        self.discard_motions()
        self.ghosts = configurations
        self._stage.add_ghosts(labels)
        self._stage.move_ghosts([self._arm.frames(q) for q in configurations])

    def show_motions(self, motions: list[PlayedMotion], colors: tuple[Any, ...], time: float) -> None:
        """Show motions, each by a ghost of its colour, or the first one by the arm itself if there are no colours.

        A requested motion starts at once; a view that a command line restored (at a time above 0) stays at its time.
        """
        self.discard_motions()
        self._motions = motions
        self._stage.add_ghosts([motion.label.partition(":")[0] for motion in motions] if colors else [], colors or GHOST_COLORS)
        end = max(float(motion.time[-1]) for motion in motions)
        begin = min(time, end) if time > 0 else 0.0
        self._panel.set_time_range(end, begin, f"time, {motions[0].unit}" if motions[0].unit != "rad" else "travel, rad")
        self.show_motions_at(begin)
        if colors and end > 0 and not begin:
            self.toggle_play()

    def remove_ghosts(self) -> None:
        """Remove ghosts and motions."""
        self.discard_motions()
        self._stage.remove_ghosts()
        self.ghosts = []

    def discard_motions(self) -> None:
        """Discard the motions; the ghosts stay in place."""
        self.pause()
        self._motions = []
        self._panel.set_time_range(0.0, 0.0, "")

    def show_motions_at(self, time: float) -> None:
        """Show the motions at a time, in their unit."""
        if not self._motions:
            return
        self._current_time = float(time)
        if abs(self._panel.time.value - time) > self._panel.time.step:
            self._panel.time.value = self._current_time
        configurations = [motion.configuration_at(time) for motion in self._motions]
        if self._stage.ghosts:
            self.ghosts = configurations
            self._stage.move_ghosts([self._arm.frames(q) for q in configurations])
            self._on_moved(self._current_time, None)
        else:
            self._on_moved(self._current_time, configurations[0])

    def pause(self) -> None:
        """Pause the playback."""
        if self.is_playing:
            self.is_playing = False
            self._clock.stop()
            self._panel.play.label = "Play"

    def toggle_play(self) -> None:
        """Continue the playback, from the start after its end, or pause it if it is running."""
        if self.is_playing or not self._motions:
            self.pause()
            return
        self.is_playing, self._panel.play.label = True, "Stop"
        end = max(float(motion.time[-1]) for motion in self._motions)
        if self._current_time >= end * (1 - 1e-9):
            self._current_time = 0.0
        # Motions longer than ten seconds are played in ten seconds; a fall is clearest in real time.
        pace = max(end / 10.0, 1.0) if self._motions[0].unit == "s" else end / 10.0

        def advance() -> None:
            next_time = self._current_time + TICK_S * pace
            self.show_motions_at(min(next_time, end))
            if next_time >= end:
                self.pause()

        self._clock.start(advance)
