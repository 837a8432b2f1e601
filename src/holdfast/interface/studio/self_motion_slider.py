"""Motion along the self-motion of a pose while a slider is dragged away from 0."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.interface.studio.page.panel import ControlPanel
from holdfast.interface.studio.scene.machine import MAX_SLIDE_STEP, CompiledArm
from holdfast.interface.studio.work import TICK_S, Clock

MAX_SLIDE_SPEED_RAD_S = 0.8  # speed at the end of the slider, rad/s


class SelfMotionSlider:
    """Self-motion slider of one window.

    Args:
        machine: Compiled arm.
        panel: Controls of the window.
        clock: Clock of the motion, which nothing else uses at the same time.
        current_state: Function that returns the present configuration (n,) and the failed joints.
        set_configuration: Function that is called with every new configuration (n,).
    """

    def __init__(
        self,
        machine: CompiledArm,
        panel: ControlPanel,
        clock: Clock,
        *,
        current_state: Callable[[], tuple[FloatArray, Sequence[int]]],
        set_configuration: Callable[[FloatArray], None],
    ) -> None:
        self._machine = machine
        self._panel = panel
        self._clock = clock
        self._current_state = current_state
        self._set_configuration = set_configuration
        self._rate, self._direction_number = 0.0, 0
        self._direction = np.zeros(machine.arm.n)

    def start(self, rate_fraction: float) -> None:
        """Move at a fraction, from -1 to 1, of the largest speed; 0 stops the motion."""
        self._rate = rate_fraction
        if rate_fraction:
            self._clock.start(self._step_self_motion)

    def reset_direction(self, direction_number: int | None = None) -> None:
        """Choose the direction again after a failure, or by its number if one is given."""
        self._direction_number, self._direction = (
            self._direction_number if direction_number is None else direction_number,
            np.zeros(self._machine.arm.n),
        )

    def _step_self_motion(self) -> None:
        if self._rate == 0.0:
            self._clock.stop()
            return
        q, failed = self._current_state()
        directions = self._machine.self_motion_directions(q, failed)
        if not len(directions):
            self._stop_with_reason("There is no self-motion here, because holding the tool pose needs every healthy joint.")
            return
        if not np.any(self._direction):
            chosen_direction = directions[min(self._direction_number, len(directions) - 1)]
            # The direction is the same at the same configuration: its largest component increases.
            self._direction = chosen_direction * np.sign(chosen_direction[int(np.abs(chosen_direction).argmax())])
        length = min(abs(self._rate) * MAX_SLIDE_SPEED_RAD_S * TICK_S, MAX_SLIDE_STEP)
        sign = np.sign(self._rate)
        q_next, direction = self._machine.step_self_motion(q, sign * length * self._direction, failed)
        if not np.any(direction):
            self.reset_direction()
            self._stop_with_reason("The self-motion ends here, at a joint limit.")
            return
        self._direction = sign * direction
        self._panel.show_message("Moving along the self-motion; the end effector does not move.")
        self._set_configuration(q_next)

    def _stop_with_reason(self, reason: str) -> None:
        self._clock.stop()
        self._panel.slide.value = self._rate = 0.0
        self._panel.show_message(reason, is_error=True)
