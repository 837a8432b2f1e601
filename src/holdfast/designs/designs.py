"""What a search of designs found."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.designs.space import DesignSpace
from holdfast.files.output import made, replaced
from holdfast.indices.index import Index
from holdfast.notice import says
from holdfast.probability.distribution import Distribution
from holdfast.probability.intervals import Interval
from holdfast.regions.region import Region
from holdfast.result import Result

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Checked:
    """What an arm guarantees on fresh poses.

    Attributes:
        distribution: Of the index at the best configuration of every pose; one that is not reached counts as 0.
        guaranteed: The quantile, with its 95 % confidence interval.
    """

    distribution: Distribution
    guaranteed: Interval


@dataclass(frozen=True)
class Check:
    """The given arm and the best design on the same fresh poses, which no choice was made on.

    Attributes:
        given, best: Each on those poses.
        optimism: By how much the best design looked better on the poses it was chosen on.
    """

    given: Checked
    best: Checked
    optimism: float


@dataclass(frozen=True)
class Designs(Result):
    """What :func:`holdfast.design` found: D designs, the given arm first.

    Attributes:
        space: What was varied.
        values: (D, k) rad and m.
        guaranteed: (D,) index that a share ``level`` of the poses of the search has at least.
        reach: (D,) largest distance of the tool point from the arm's base within the limits, m.
        reached: (D,) share of the poses with a configuration.
        front: Numbers of the designs that no other one beats in both reach and guaranteed value, by reach.
        best: Number of the design with the greatest guaranteed value; of several within 0.1 % of it the farthest-reaching one.
        checked: The given arm and the best design on fresh poses.
        index: Of the given arm.
        region: The poses; the same for all designs.
        level: Share of the poses for which the value is guaranteed.
        poses: Number of poses of the search.
        screened: Designs spread over the space.
        climbs: Climbs from the best of them.
        seed: Of everything random.
        seconds: Time this call took; less than the search where it went on from a folder. None if not known.
        method: How it was computed, for reports: words and texts.
    """

    space: DesignSpace
    values: Array
    guaranteed: Array
    reach: Array
    reached: Array
    front: NDArray[np.intp]
    best: int
    checked: Check
    index: Index
    region: Region
    level: float
    poses: int
    screened: int
    climbs: int
    seed: int
    seconds: float | None
    method: list[tuple[str, str]]

    @property
    def start_guaranteed(self) -> float:
        """Of the given arm."""
        return float(self.guaranteed[0])

    @property
    def start_reach(self) -> float:
        """Of the given arm, m."""
        return float(self.reach[0])

    @property
    def best_is_start(self) -> bool:
        """True where no design beats the given arm."""
        return self.best == 0

    def arm(self, number: int | None = None) -> Arm:
        """The arm of a design; the best one if no number is given."""
        return self.space.arm_of(self.values[self.best if number is None else number])

    # ---- out -------------------------------------------------------------------------------------------------------

    @says("drawing the report")
    def report(self, path: str | Path) -> Path:
        """Write one HTML file that needs nothing else: what to build, what that gains, and what it costs in reach.

        Raises:
            StoreError: The file cannot be written; what was there is as it was.
        """
        written: Path = self._presented("write", path)
        return written

    @says("writing the results")
    def save(self, folder: str | Path) -> list[Path]:
        """Write ``report.html``, ``best-arm.yaml``, ``designs.csv`` and, for what comes next, ``region.yaml`` into a folder.

        Returns:
            The files.

        Raises:
            StoreError: A file cannot be written.
        """
        texts: dict[str, str] = self._presented("files", self._table())
        place = made(folder)
        for name, text in texts.items():
            replaced(place / name, text)
        return [self.report(place / "report.html"), *(place / name for name in texts)]

    def _table(self) -> str:
        """All designs as CSV, rad and m."""
        out = io.StringIO()
        writer = csv.writer(out, lineterminator="\n")
        names = [f"{p.name} ({p.unit})" for p in self.space.parameters]
        writer.writerow(["design", *names, "guaranteed", "reach (m)", "reached", "on the front"])
        front = set(self.front.tolist())
        columns = (self.guaranteed, self.reach, self.reached)
        for k, values in enumerate(self.values.tolist()):
            writer.writerow([k, *values, *(float(c[k]) for c in columns), int(k in front)])
        return out.getvalue()

    def to_dict(self) -> dict[str, Any]:
        """The answer as JSON types, rad and m."""

        def arm(number: int, checked: Checked) -> dict[str, Any]:
            g = checked.guaranteed
            return {
                "values": dict(zip(self.space.names, self.values[number].tolist(), strict=True)),
                "guaranteed_in_search": float(self.guaranteed[number]),
                "guaranteed": {"value": g.value, "low": g.low, "high": g.high, "confidence": g.confidence},
                "median": float(checked.distribution.quantile(0.5, reachable_only=False)),
                "reached": 1 - checked.distribution.unreached_share,
                "reach": float(self.reach[number]),
            }

        return {
            **self.space.arm.entry(),
            "index": self.index.label,
            "task": self.index.task.name,
            "region": self.region.name,
            "level": self.level,
            "bound": self.index.bound,
            "poses": self.poses,
            "fresh_poses": self.checked.best.distribution.samples,
            "designs": len(self.values),
            "given": arm(0, self.checked.given),
            "best": arm(self.best, self.checked.best),
            "optimism": self.checked.optimism,
            "front": [
                {
                    "reach": float(self.reach[k]),
                    "guaranteed": float(self.guaranteed[k]),
                    "values": dict(zip(self.space.names, self.values[k].tolist(), strict=True)),
                }
                for k in self.front.tolist()
            ],
            "seed": self.seed,
        }
