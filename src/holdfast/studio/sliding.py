"""Moving along the self-motion of a pose while a slider is held away from 0."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from holdfast.studio.page.panel import Panel
from holdfast.studio.scene.machine import SLIDE, Machine
from holdfast.studio.work import TICK, Clock

Array = NDArray[np.float64]
SPEED = 0.8  # rad/s at the end of the slider


class Sliding:
    """The slider of one window.

    Args:
        machine: The arm.
        panel: The controls.
        clock: What moves it on; nothing else uses it at the same time.
        where: The configuration (n,) and the failed joints now.
        place: Is told every new configuration (n,).
    """

    def __init__(
        self,
        machine: Machine,
        panel: Panel,
        clock: Clock,
        *,
        where: Callable[[], tuple[Array, Sequence[int]]],
        place: Callable[[Array], None],
    ) -> None:
        self._machine, self._panel, self._clock, self._where, self._place = machine, panel, clock, where, place
        self._rate, self._way = 0.0, 0
        self._along = np.zeros(machine.arm.n)

    def start(self, rate: float) -> None:
        """Move on at a rate from -1 to 1; stop at 0."""
        self._rate = rate
        if rate:
            self._clock.start(self._on)

    def turn(self, way: int | None = None) -> None:
        """Look for the direction anew, the one of several if a number is given: another joint has failed, or a person chose."""
        self._way, self._along = self._way if way is None else way, np.zeros(self._machine.arm.n)

    def _on(self) -> None:
        if self._rate == 0.0:
            self._clock.stop()
            return
        q, failed = self._where()
        ways = self._machine.self_motions(q, failed)
        if not len(ways):
            self._end("There is no self-motion here: every joint that is left is needed to hold the tool.")
            return
        if not np.any(self._along):
            along = ways[min(self._way, len(ways) - 1)]
            # Always the same way at the same place: the largest part counts up.
            self._along = along * np.sign(along[int(np.abs(along).argmax())])
        length = min(abs(self._rate) * SPEED * TICK, SLIDE)
        sign = np.sign(self._rate)
        new, direction = self._machine.slide(q, sign * length * self._along, failed)
        if not np.any(direction):
            self.turn()
            self._end("The self-motion ends here, at a joint limit.")
            return
        self._along = sign * direction
        self._panel.say("Sliding along the self-motion: the end effector is still.")
        self._place(new)

    def _end(self, why: str) -> None:
        self._clock.stop()
        self._panel.slide.value = self._rate = 0.0
        self._panel.say(why, bad=True)
