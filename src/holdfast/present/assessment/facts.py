"""What a report says, computed once: threshold, headline, rows, scene, curves."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.poses import rotations_of_quaternions
from holdfast.assessment.answer import ZERO, Answer
from holdfast.assessment.assessment import Assessment
from holdfast.assessment.rows import provenance
from holdfast.assessment.upgrade import sample
from holdfast.caching import cached_property
from holdfast.probability.distribution import Distribution
from holdfast.report import figures
from holdfast.report.figures import Bin, Curve, Mark
from holdfast.report.scenes import Scale, Scene
from holdfast.report.views import SIDE, View, sides
from holdfast.solvers.inverse_kinematics import solver
from holdfast.words import as_given, half_width, number

Array = NDArray[np.float64]

_MOST_DOTS = 20_000
_WIDEST_AXIS = 4.0  # times the largest value: beyond it a bound would flatten the curve


@dataclass(frozen=True)
class Rows:
    """The poses that were computed, with tool poses also for a region of joints."""

    number: NDArray[np.int64]
    position: Array
    rotation: Array
    q: Array
    reached: NDArray[np.bool_]
    value: Array
    by_failure: Array
    worst: NDArray[np.int64]
    weight: Array | None


class Facts(Answer):
    """Everything the report says and draws, computed once."""

    a: Assessment

    def __init__(self, assessment: Assessment, threshold: float | None) -> None:
        super().__init__(assessment, threshold)

    @property
    def others(self) -> str:
        """What the arm may collide with: itself, the cell, or both."""
        clearance = self.a.plan.clearance
        return "itself" if clearance is None else clearance.others

    @property
    def everything(self) -> str:
        """The same with ``and``."""
        clearance = self.a.plan.clearance
        return "itself" if clearance is None else clearance.everything

    @property
    def drawable(self) -> bool:
        """There are finite values."""
        return self.d.reached > self.d.infinite

    @property
    def axis_label(self) -> str:
        """What an axis of index values says."""
        return figures.plain(f"worst-case {self.index.name}{self.unit and ','}{self.unit}")

    @property
    def failure_labels(self) -> list[str]:
        """Numbers from 1 and names: ``4 elbow``, ``2+4 shoulder+elbow``."""
        pairs = zip(self.index.failures, self.index.failure_names, strict=True)
        return [f"{'+'.join(str(k + 1) for k in s)}  {name}" for s, name in pairs]

    # ---- rows ------------------------------------------------------------------------------------------------------

    @cached_property
    def rows(self) -> Rows | None:
        """Every pose that was computed; None if the rows were not kept."""
        if not self.d.samples or not self.a.kept:
            return None
        s = sample(self.a.index, self.a.columns, optimised=False)
        if self.a.region.kind == "joints":
            pose = self.a.arm.forward_kinematics(s.q)
            position, rotation = pose[:, :3, 3], pose[:, :3, :3]
        else:
            columns = self.a.columns
            position = columns["position"][:][s.number]
            rotation = rotations_of_quaternions(columns["quaternion"][:][s.number])
        return Rows(s.number, position, rotation, s.q, s.reached, s.value, s.by_failure, s.worst, s.weight)

    @cached_property
    def best_rows(self) -> Rows | None:
        """The same poses at their best configurations; None if the run was not optimised or the rows were not kept."""
        if self.rows is None or self.a.optimised is None:
            return None
        s = sample(self.a.index, self.a.columns, optimised=True)
        return replace(self.rows, q=s.q, reached=s.reached, value=s.value, by_failure=s.by_failure, worst=s.worst)

    @property
    def samples(self) -> list[tuple[str, Distribution, Rows | None]]:
        """The samples of the run: what each is, its distribution, its rows."""
        first = ("found by inverse kinematics", self.d, self.rows)
        return [first] if self.a.optimised is None else [first, ("after optimisation", self.a.optimised, self.best_rows)]

    @cached_property
    def provenance(self) -> dict[str, object]:
        """When, how long, and with which versions; of this report where the run did not note it."""
        notes = self.a.store.notes if self.a.store is not None else {}
        return notes if "versions" in notes else provenance(self.a.seconds)

    # ---- figures ---------------------------------------------------------------------------------------------------

    @cached_property
    def representative(self) -> tuple[Array, str]:
        """A configuration to draw, and what it is."""
        a, rows = self.a, self.rows
        if rows is not None and rows.reached.any():
            some = np.flatnonzero(rows.reached)
            k = some[np.argsort(rows.value[some], kind="stable")[(len(some) - 1) // 2]]
            what = (
                "the only one there is" if len(some) == 1 else f"the one with the median index, {number(float(rows.value[k]))}"
            )
            return rows.q[k], f"at {self.noun} {rows.number[k] + 1:,}, {what}"
        center = np.array(a.region.center)
        if a.region.kind == "joints":
            return center, "in the middle of the region"
        if self.d.reached and a.region.kind == "box":
            reach = solver(a.arm, self.index.task).solve(
                a.region.poses(center[None]), np.random.SeedSequence(a.seed), a.restarts, 1e-6
            )
            if reach.success[0]:
                return reach.q[0], "at the middle of the region"
        low = np.where(np.isfinite(a.arm.lower), a.arm.lower, -np.pi / 2)
        high = np.where(np.isfinite(a.arm.upper), a.arm.upper, np.pi / 2)
        return (low + high) / 2, "in the middle of its joint limits"

    @cached_property
    def scene(self) -> tuple[Scene, int]:
        """What the views show, and how many poses are drawn."""
        a, rows = self.a, self.rows
        posture = a.arm.frames(self.representative[0])[:, :3, 3]
        none = np.zeros((0, 3))
        points, values, missing, drawn = none, np.zeros(0), none, 0
        if rows is not None:
            chosen = np.arange(len(rows.value))
            if len(chosen) > _MOST_DOTS:
                chosen = np.sort(np.random.default_rng(0).choice(len(chosen), _MOST_DOTS, replace=False))
            ok = rows.reached[chosen]
            points, values, missing = rows.position[chosen[ok]], rows.value[chosen[ok]], rows.position[chosen[~ok]]
            drawn = len(chosen)
        box = None
        if a.region.kind == "box":
            c, s = np.array(a.region.center[:3]), np.array(a.region.size[:3])
            box = np.array([c - s / 2, c + s / 2])
        return Scene(points, values, missing, chain=posture, nodes=posture[1:-1], square=a.arm.prismatic, box=box), drawn

    @cached_property
    def views(self) -> list[View]:
        """Side and top view; only one of them if everything lies in its plane."""
        return sides(self.scene[0].extent) or [SIDE]

    @property
    def side(self) -> View:
        """The first view."""
        return self.views[0]

    @cached_property
    def log(self) -> bool:
        """Values spread over decades and none is 0: show them on a log scale."""
        return not self.larger and self.d.lowest > 0 and self.d.highest > 20 * self.d.lowest

    @cached_property
    def scale(self) -> Scale:
        """Colours of the dots."""
        values = self.scene[0].values
        if self.nothing and self.larger:
            return Scale(0.0, self.index.bound or 1.0)
        return Scale.of(values, self.log, not self.larger)

    @cached_property
    def axis(self) -> Array:
        """Values of the index at which the CDF is drawn."""
        d, marks = self.d, [m.x for m in self.marks]
        if self.log:
            return np.geomspace(min(d.lowest, *marks) / 1.15, max(d.highest, *marks) * 1.15, 1601)
        finite = [x for x in (d.lowest, d.highest) if np.isfinite(x)]
        high = max([0.0, *finite, *marks])
        low = min([0.0, *finite, *marks])
        return np.linspace(low, high + 0.04 * ((high - low) or 1.0), 1601)

    @cached_property
    def marks(self) -> list[Mark]:
        """Lines at the threshold and at the bound, unless they are far beyond all values."""
        found = [Mark(self.threshold, f"threshold {as_given(self.threshold)}{self.unit}")] if self.decided else []
        if self.index.bound is not None:
            found.append(Mark(self.index.bound, f"no configuration can exceed {self.index.bound:.3f}", "bound"))
        highest = max((x.highest for x in (self.d, self.a.optimised) if x is not None and x.reached), default=0.0)
        chosen = self.chosen or self.index.bound is None or highest <= ZERO
        return found if chosen else [mark for mark in found if mark.x <= _WIDEST_AXIS * highest]

    @cached_property
    def curves(self) -> list[Curve]:
        """The cumulative distribution, over all poses and over the reached ones."""
        band = self.a.distribution.band()
        lost = f" (not found counts as {'0' if self.larger else 'infinite'})" if self.d.unreached else ""
        every = "" if not self.d.unreached else f"all {self.d.samples:,} poses{lost}, "
        first = Curve(
            self.axis,
            self.a.cdf(self.axis),
            f"{every or f'all {self.d.samples:,} {self.noun}s, '}95 % band {half_width(band)}",
            band=band,
        )
        if not self.d.unreached:
            return [first]
        return [
            first,
            Curve(
                self.axis, self.a.cdf(self.axis, reachable_only=True), f"the {self.d.reached:,} reached poses only", second=True
            ),
        ]

    @cached_property
    def histogram(self) -> Bin:
        """Density over the reached poses, from the CDF, so that it also works for binned distributions."""
        count = int(np.clip(2 * self.d.reached ** (1 / 3), 8, 40)) if self.d.values is not None else 40
        edges = (np.geomspace if self.log else np.linspace)(self.axis[0], self.axis[-1], count + 1)
        share = np.diff(self.a.cdf(edges, reachable_only=True))
        width = np.diff(np.log10(edges)) if self.log else np.diff(edges)
        per = "per decade" if self.log else self.unit and f"per{self.unit}"
        return Bin(edges, share / width, "", ylabel=f"probability density {per}".strip())
