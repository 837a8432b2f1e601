"""What the cells of a study found, read a chunk at a time, whatever their number."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.assessment.answer import ZERO
from holdfast.assessment.bins import add_chunks
from holdfast.assessment.plan import Plan
from holdfast.assessment.rows import Tally
from holdfast.convergence.maps import NONE, shared
from holdfast.convergence.origins import mean_intervals, mean_over
from holdfast.engine.store import Store
from holdfast.engine.study import Study
from holdfast.errors import StoreError
from holdfast.probability.distribution import Distribution
from holdfast.probability.intervals import Difference, Interval
from holdfast.simulation.runs import Outcome
from holdfast.teleop.trials.recordings import End

Array = NDArray[np.float64]
Rows = dict[str, NDArray[Any]]


def chunks(study: Study, cell: int) -> Iterator[Rows]:
    """The committed chunks of a cell, each checked against its checksum.

    Raises:
        StoreError: A chunk is damaged.
    """
    if not study.folder(cell).exists():
        return
    store = study.store(cell)
    for k in store.done:
        try:
            rows = store.checked(k)
        except StoreError as error:
            raise StoreError(
                f"chunk {k + 1} of cell '{study.cells[cell]['name']}' in '{study.path}' is damaged ({error}); give "
                f"'holdfast study verify {study.path}', then the run again"
            ) from error
        yield rows


_SWEPT = ("index", "task", "region", "failures")
_LABELS = {"assess": (*_SWEPT, "keep"), "designs": _SWEPT}


def labels_of(study: Study, cell: int) -> dict[str, Any]:
    """What a cell is in the sweep.

    Raises:
        StoreError: A label is missing.
    """
    found: dict[str, Any] = study.cells[cell]["labels"]
    for name in ("job", "arm", *_LABELS.get(str(found.get("job")), ("law", "task"))):
        if not isinstance(found.get(name), str):
            raise StoreError(
                f"'{study.path}' is damaged: cell '{study.cells[cell]['name']}' has no label '{name}'; give the study file to "
                "'holdfast study run' again, which writes it anew"
            )
    return found


@dataclass(frozen=True)
class Assessed:
    """An index over a region.

    Attributes:
        labels: Of the cell.
        plan: What was computed.
        plain, optimised: Distributions; None where nothing is computed, or was not asked for.
        worst: Name of the failure that is the worst most often, and its share; None if there is none.
        left: Share of the poses left after a lock, mean over the joints; None if not asked for.
    """

    labels: dict[str, Any]
    plan: Plan
    plain: Distribution | None
    optimised: Distribution | None
    worst: tuple[str, float] | None
    left: float | None

    def interval(self, threshold: float, optimised: bool) -> Interval | None:
        """Probability that the index meets a threshold."""
        d = self.optimised if optimised else self.plain
        if d is None or not d.samples:
            return None
        larger = self.plan.index.better == "larger"
        return d.interval(at_least=threshold) if larger else d.interval(at_most=threshold)


def assessed(study: Study, cell: int) -> Assessed:
    """The result of an assessment."""
    labels = labels_of(study, cell)
    store = study.store(cell)
    plan = Plan.stored(store, study.cells[cell]["rows"], rows=labels["keep"] == "rows")
    if labels["keep"] == "counts":
        return _from_counts(study, cell, labels, plan)
    tally, some = Tally(plan), False
    for rows in chunks(study, cell):
        tally.add(rows)
        some = True
    plain = tally.found.finish() if some else None
    best = tally.optimised.finish() if some and tally.optimised is not None else None
    left = None
    if some and tally.survivors is not None and plain is not None:
        left = float(np.mean(tally.survivors) / plain.total_weight())
    return Assessed(labels, plan, plain, best, _worst(plan, tally.found.worst), left)


def _from_counts(study: Study, cell: int, labels: dict[str, Any], plan: Plan) -> Assessed:
    parts = add_chunks(plan.index, plan.optimise, chunks(study, cell))
    found = [counts.finish() if counts.facts[:2].any() else None for counts, _ in parts]
    return Assessed(labels, plan, found[0], found[1] if plan.optimise else None, _worst(plan, parts[0][1]), None)


def _worst(plan: Plan, counts: NDArray[Any]) -> tuple[str, float] | None:
    if not counts.sum() > 0:
        return None
    return plan.index.failure_names[int(counts.argmax())], float(counts.max() / counts.sum())


def threshold(found: list[Assessed]) -> float:
    """One for several arms where none is given: half of the smallest bound, or about the middle of the medians."""
    bounds = [a.plan.index.bound for a in found]
    some = [b for b in bounds if b is not None]
    if some and len(some) == len(bounds):
        return float(f"{min(some) / 2:.2g}")
    medians = [float(a.plain.quantile(0.5)) for a in found if a.plain is not None and a.plain.reached]
    medians = [m for m in medians if np.isfinite(m) and abs(m) > ZERO]
    return float(f"{np.median(medians):.2g}") if medians else 1.0


@dataclass(frozen=True)
class Driven:
    """Motions under a law; shares are over the motions, each the mean over the joints that may have locked.

    Attributes:
        labels: Of the cell.
        joints: Names.
        motions: Those that had a configuration to start from.
        ends: Shares of converged, stuck, moving and undecided, of each locked joint and of none, (n + 1, 4).
        reaches: (n + 1,) fractions that reach the target, with intervals.
        each: (R,) of every motion the share of the joints with which it reaches the target; NaN where there was no start.
        any: Its mean, with its interval.
        in_reach: Share of the runs with a locked joint in which the target was in reach.
        touched: Share of them in which something is touched on the way, at most; None if nobody looked.
    """

    labels: dict[str, Any]
    joints: tuple[str, ...]
    motions: int
    ends: Array
    reaches: tuple[Interval, ...]
    each: Array
    any: Interval
    in_reach: float
    touched: float | None = None


def driven(study: Study, cell: int) -> Driven | None:
    """The result of a map of convergence; None where there is none."""
    store = study.store(cell)
    parts = [(rows["code"], rows["in_reach"], rows.get("touched")) for rows in chunks(study, cell)]
    if not parts:
        return None
    code, reach = (np.concatenate([part[k] for part in parts]) for k in (0, 1))
    looked = [part[2] for part in parts if part[2] is not None]
    known = code[:, 0] != NONE
    runs = int(known.sum())
    if not runs:
        return None
    ends = np.stack([(code[known] == k).mean(axis=0) for k in Outcome], axis=1)
    there = code == Outcome.CONVERGED
    each = np.where(known, there[:, :-1].mean(axis=1), np.nan)
    reaches = tuple(Interval.of(int(there[known, k].sum()), runs) for k in range(code.shape[1]))
    joints = tuple(j["name"] for j in store.plan["arm"]["joints"] if j["type"] != "fixed")
    whole = shared(each, code.shape[1] - 1, 0.95)
    labels = labels_of(study, cell)
    near = float(reach[known, :-1].mean())
    touched = float(np.concatenate(looked)[known, :-1].mean()) if looked else None
    return Driven(labels, joints, runs, ends, reaches, each, whole, near, touched)


def gain(first: Driven, second: Driven) -> Difference | None:
    """What the second law gains over the first, on the same motions."""
    both = ~np.isnan(first.each) & ~np.isnan(second.each) if first.each.shape == second.each.shape else np.zeros(1, bool)
    return Difference.of_fractions(second.each[both] - first.each[both]) if both.any() else None


@dataclass(frozen=True)
class Table:
    """What else was computed: names of quantities, with values and ends of intervals as text.

    Attributes:
        labels: Of the cell.
        samples: Starts, or sets of tasks.
        values: (value, low, high) by name; NaN where there is none.
    """

    labels: dict[str, Any]
    samples: int
    values: dict[str, tuple[float, float, float]]


def workspace(study: Study, cell: int) -> Table | None:
    """Means over the starts of the measures of a workspace, for an arbitrary joint, percent."""
    parts = list(chunks(study, cell))
    if not parts:
        return None
    found = {}
    for name in ("R100", "Ravg", "F100", "Favg"):
        column = np.concatenate([p[name][:, -1] for p in parts])
        low, high = mean_intervals(column[:, None], 0.95)[0]
        found[name] = (float(mean_over(column[:, None], 0)[0]), float(low), float(high))
    return Table(labels_of(study, cell), sum(len(p["lost"]) for p in parts), found)


def bank(study: Study, cell: int) -> Table | None:
    """Shares of the tasks that the computer completes, healthy and failed, and the median time, cycles."""
    parts = list(chunks(study, cell))
    if not parts:
        return None
    end = np.concatenate([p["end"] for p in parts])
    cycles = np.concatenate([p["measures"][..., 0] for p in parts])
    found = {}
    for k, case in enumerate(("healthy", "failed")):
        there = end[..., k] == End.ARRIVED
        share = Interval.of(int(there.sum()), there.size)
        found[f"reached, {case}"] = (100 * share.value, 100 * share.low, 100 * share.high)
        middle = float(np.median(cycles[..., k][there])) if there.any() else np.nan
        found[f"time, {case}"] = (middle, np.nan, np.nan)
    return Table(labels_of(study, cell), len(end), found)


@dataclass(frozen=True)
class Swept:
    """Designs of one arm, the given arm first if it is computed.

    Attributes:
        labels: Of the cell.
        plan: What was computed.
        values: (D, k) rad or m.
        guaranteed, median: (D,) of the index over the poses.
        reached: (D,) share of the poses.
        reach: (D,) m.
        start: The row of the given arm; None if it is not computed yet.
    """

    labels: dict[str, Any]
    plan: Mapping[str, Any]
    values: Array
    guaranteed: Array
    median: Array
    reached: Array
    reach: Array
    start: int | None


def swept(study: Study, cell: int) -> Swept | None:
    """The result of a sweep of designs; None where there is none."""
    parts = list(chunks(study, cell))
    if not parts:
        return None
    names = ("design", "guaranteed", "median", "reached", "reach")
    values, guaranteed, median, reached, reach = (np.concatenate([p[name] for p in parts]) for name in names)
    store = study.store(cell)
    start = 0 if 0 in store.done else None
    return Swept(labels_of(study, cell), store.plan, values, guaranteed, median, reached, reach, start)


def store_size(store: Store) -> int:
    """Bytes of the committed chunks of a store."""
    return sum(e.size for e in store.entries.values())
