"""What earlier runs have found, so that a long run can be broken off and go on."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import holdfast as hf
from holdfast.core.probability import Interval

COULOMB, VISCOUS = 0.5, 0.3  # N m, N m s/rad: what the records have, within 20 %
PART = 30  # of what is found together
CALIBRATED = 60.0  # s of each robot


class Store:
    """Lines of JSON, one for each thing that was found; without a folder nothing is kept.

    Args:
        folder: For the lines and the bounds; made if it is not there.
        arm: Whose lines these are.
    """

    def __init__(self, folder: Path | None, arm: hf.Arm) -> None:
        self.arm, self._folder = arm, folder
        self._found: dict[str, Any] = {}
        if folder is not None:
            folder.mkdir(parents=True, exist_ok=True)
            self._file = folder / f"{arm.name}.jsonl"
            lines = self._file.read_text(encoding="utf-8").splitlines() if self._file.exists() else []
            self._found = dict(map(json.loads, lines))

    def get(self, key: str, make: Callable[[], Any]) -> Any:
        """What is known under a key, or else what ``make`` returns, which is kept."""
        if key not in self._found:
            print(f"\r{self.arm.name} {key}", end="   ", file=sys.stderr, flush=True)
            self._found[key] = make()
            if self._folder is not None:
                with self._file.open("a", encoding="utf-8") as lines:
                    lines.write(json.dumps([key, self._found[key]]) + "\n")
        return self._found[key]

    def some(self, key: str, count: int, make: Callable[[range], list[Any]]) -> list[Any]:
        """So many things, of which ``make`` finds the ones with the numbers that it is given."""
        parts = (range(k, min(k + PART, count)) for k in range(0, count, PART))
        return [x for part in parts for x in self.get(f"{key} {part[0]}-{part[-1]}", partial(make, part))]

    def bounds(self, robots: int) -> hf.diagnosis.Bounds:
        """Over many robots of one kind."""
        file = None if self._folder is None else self._folder / f"{self.arm.name}-bounds-{robots}.json"
        if file is not None and file.exists():
            return hf.diagnosis.load(file)
        arm = self.arm
        logs = hf.diagnosis.simulate_logs(arm, CALIBRATED, seeds=range(robots))
        found = hf.diagnosis.calibrate(arm, logs, coulomb=np.full(arm.n, COULOMB), viscous=np.full(arm.n, VISCOUS))
        if file is not None:
            found.to_json(file)
        return found


def of(hits: int, size: int) -> str:
    """``hits of size`` with the exact 95 % interval of Clopper and Pearson."""
    if not size:
        return "-"
    return f"{hits} of {size} ({limits(hits, size)} %)"


def limits(hits: int, size: int) -> str:
    """The exact 95 % interval of Clopper and Pearson in per cent, to four digits: an upper end of 99.69 is not 100."""
    interval = Interval.from_counts(hits, size)
    return f"{100 * interval.low:.4g} to {100 * interval.high:.4g}"
