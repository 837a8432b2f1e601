"""What is nearest to an arm at one configuration after the other, for loops that cannot wait for a batch."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.clearance.clearance import Clearance

Array = NDArray[np.float64]


class OneRow:
    """As :meth:`Clearance.nearest` of one row, the same bits in a fraction of the time; not for several threads at once.

    Args:
        clearance: What is looked at.
    """

    def __init__(self, clearance: Clearance) -> None:
        self._clearance, seen, alone = clearance, clearance.obstacles, clearance.alone
        self._own = [k.single() for k in (alone._value_kernel, alone._gradient_kernel)] if clearance.pairs else []
        self._blocks = [] if seen is None else seen.single_blocks()
        self._whole = seen is not None and not self._blocks  # with grids, which are NumPy's
        self._n = clearance.arm.n

    def __call__(self, q: Array) -> tuple[float, Array]:
        """Room, m, and its slope (n,) at a finite configuration (n,)."""
        if self._whole:
            rooms, slopes = self._clearance.nearest(q[None])
            return float(rooms[0]), slopes[0]
        room, slope = np.inf, np.zeros(self._n)
        for block in self._blocks:
            block.inputs[: self._n] = q
            found = block.run()
            if found[0] < room:
                room, slope = float(found[0]), found[3:]
        if self._own:
            value, gradient = self._own
            own = float(value(q)[0])
            if own <= room:
                room, slope = own, gradient(q)
        return room, slope
