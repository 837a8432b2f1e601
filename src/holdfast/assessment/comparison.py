"""Several assessments of one region side by side: arms, tasks, tool attachments."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.arguments import checked
from holdfast.assessment.assessment import Assessment
from holdfast.assessment.run import load
from holdfast.assessment.single_points import structure
from holdfast.assessment.upgrade import Upgrade
from holdfast.caching import cached_property
from holdfast.engine.folder import is_plain
from holdfast.errors import InputError, StoreError
from holdfast.failures import failure_sets
from holdfast.files.digest import seal_document
from holdfast.files.output import replaced
from holdfast.files.sealed import read_sealed
from holdfast.probability.intervals import Interval
from holdfast.regions.region import Region
from holdfast.result import Result
from holdfast.words import interval

LIST = "comparison.json"  # of a folder: which folders in it are compared


@dataclass(frozen=True, kw_only=True)
class Comparison(Result):
    """Assessments of one region with one index and equally many poses; see :func:`holdfast.compare_assessments`.

    Attributes:
        assessments: The candidates.
        names: Of the candidates.
        threshold: Value of the index that the task needs.
        chosen: The threshold was given.
        tools: What the tool attachments of the candidates are called; None for an arm's own.
    """

    assessments: tuple[Assessment, ...]
    names: tuple[str, ...]
    threshold: float
    chosen: bool
    tools: tuple[str | None, ...]

    @cached_property
    def table(self) -> list[dict[str, Any]]:
        """One dictionary per candidate; shares are of all poses, intervals for 95 %, joints are named.

        ``name, arm, joints, task, redundancy`` (joints minus rows of the task), ``poses``, ``reached``, ``probability`` (of
        an index that meets the threshold), ``median`` (over the reached poses), ``gap`` (of the median to the bound),
        ``worst_joint`` (or set of joints) and ``worst_fraction`` of the reached, not singular poses; the same at the best
        configurations with ``optimised_`` in front; ``expected_survival`` (share of the poses left after a lock, every joint
        that was asked for equally likely to fail), ``single_points_of_failure`` by structure, ``upgrade`` and
        ``upgrade_gain``: the joint that gains most if it never fails. ``_low`` and ``_high`` are ends of intervals. What a
        run did not ask for is None.
        """
        return [self._row(name, a) for name, a in zip(self.names, self.assessments, strict=True)]

    def _row(self, name: str, a: Assessment) -> dict[str, Any]:
        task = a.index.task
        found = structure(a.arm, task)
        row: dict[str, Any] = {
            "name": name,
            "arm": a.arm.name,
            "joints": a.arm.n,
            "task": task.name,
            "redundancy": a.arm.n - task.m,
            "poses": a.distribution.samples,
        }
        row |= _ends("reached", _reached(a))
        for optimised, before in ((False, ""), (True, "optimised_")):
            asked = not optimised or a.optimised is not None
            row |= _ends(f"{before}probability", self.interval(a, optimised) if asked else None)
            some = asked and a.of(optimised).reached > 0
            row[f"{before}median"] = float(a.of(optimised).quantile(0.5)) if some else None
            row[f"{before}gap"] = a.gap(optimised) if some else None
            counts = a.optimised_worst_counts if optimised else a.worst_counts
            row |= {f"{before}worst_joint": None, f"{before}worst_fraction": None}
            if counts is not None and counts.sum() > 0:
                row[f"{before}worst_joint"] = a.index.failure_names[int(counts.argmax())]
                row[f"{before}worst_fraction"] = float(counts.max() / counts.sum())
        left = None if a.survivors is None else [x.value for x in a.survival().values()]
        row["expected_survival"] = None if left is None else float(np.mean(left))
        fatal = range(a.arm.n) if found.never or found.redundancy <= 0 else found.fatal
        row["single_points_of_failure"] = [a.arm.joint_names[k] for k in fatal]
        ranked = self.upgrades(name) if a.kept else []
        row["upgrade"] = ranked[0].joint if ranked and ranked[0].gain > 0 else None
        row["upgrade_gain"] = ranked[0].gain if ranked else None
        return row

    def interval(self, candidate: str | Assessment, optimised: bool = False) -> Interval:
        """Probability that the index of a candidate meets the threshold, with its interval."""
        a = self.assessment(candidate) if isinstance(candidate, str) else candidate
        ask = {"at_least" if a.index.better == "larger" else "at_most": self.threshold}
        return a.interval(optimised=optimised, **ask)  # type: ignore[arg-type]

    def assessment(self, name: str) -> Assessment:
        """The assessment of a candidate.

        Raises:
            InputError: No such candidate.
        """
        if name not in self.names:
            raise InputError(f"there is no candidate '{name}'; there are {', '.join(self.names)}")
        return self.assessments[self.names.index(name)]

    def best(self, task: str | None = None, optimised: bool = False) -> str:
        """Name of the candidate with the largest probability of meeting the threshold; the median decides between equals.

        Args:
            task: Among the candidates of this task; among all if not given.
            optimised: At the best configurations.

        Raises:
            InputError: No candidate of that task, or runs that were not optimised.
        """
        return self.ranking(task, optimised)[0]

    def ranking(self, task: str | None = None, optimised: bool = False) -> list[str]:
        """Names of the candidates, the best first; see :meth:`best`."""
        some = [n for n, a in zip(self.names, self.assessments, strict=True) if task in (None, a.index.task.name)]
        if not some:
            known = sorted({a.index.task.name for a in self.assessments})
            raise InputError(f"no candidate has task '{task}'; there are {', '.join(known)}")

        def merit(name: str) -> tuple[float, float]:
            a = self.assessment(name)
            middle = float(a.of(optimised).quantile(0.5)) if a.of(optimised).reached else np.nan
            middle = middle if a.index.better == "larger" else -middle
            return self.interval(a, optimised).value, middle if np.isfinite(middle) else -np.inf

        return sorted(some, key=merit, reverse=True)

    def upgrades(self, candidate: str, optimised: bool = False) -> list[Upgrade]:
        """What each joint of a candidate would gain if it could never fail; see :meth:`Assessment.upgrades`."""
        return self.assessment(candidate).upgrades(self.threshold, optimised)

    @cached_property
    def notes(self) -> list[str]:
        """Differences between the candidates that matter when they are compared, one sentence each."""
        runs = self.assessments
        first = runs[0]
        found = []
        tasks = list(dict.fromkeys(a.index.task.name for a in runs))
        if len(tasks) > 1:
            found.append(
                f"The tasks differ ({', '.join(tasks)}): the {first.index.name} of different tasks is a different quantity, so "
                "compare such candidates by what the work needs, not by the number alone."
            )
        elif any(a.index.task.m != first.index.task.m for a in runs):
            found.append("Tasks of the same name have different rows: their indices are different quantities.")
        lengths = sorted({a.index.task.length for a in runs})
        if len(lengths) > 1:
            found.append(
                f"The characteristic lengths differ ({', '.join(f'{x:g}' for x in lengths)} m), and the index with them."
            )
        if len({_failure_kind(a) for a in runs}) > 1:
            kinds = "; ".join(f"{n}: {_failure_kind(a)}" for n, a in zip(self.names, runs, strict=True))
            found.append(f"The failures considered differ ({kinds}).")
        bounds = sorted({a.index.bound for a in runs if a.index.bound is not None})
        if len(bounds) > 1:
            values = ", ".join(f"{x:.3f}" for x in bounds)
            found.append(f"The upper bounds of the index differ ({values}): one threshold asks more of some than of others.")
        if len({(a.seed, a.sampling) for a in runs}) > 1:
            found.append("Seeds or sampling differ, so the candidates were tried at different poses of the region.")
        if len({a.restarts for a in runs}) > 1:
            found.append("The numbers of restarts differ, so 'not found' was decided with unequal effort.")
        if len({a.optimised is None for a in runs}) > 1:
            found.append("Only some candidates were optimised.")
        chosen = [a.plan for a in runs if a.optimised is not None]
        if len({(p.clearance is None, p.margin) for p in chosen}) > 1:
            found.append("The best configurations are not equally clear of the arm itself: the clearances asked for differ.")
        if len({None if a.plan.cell is None else a.plan.cell.digest for a in runs}) > 1:
            found.append("The candidates do not stand in the same cell.")
        return found

    def describe(self) -> list[str]:
        """The best candidate for each task, and differences that matter when they are compared."""
        sign = "least" if self.assessments[0].index.better == "larger" else "most"
        said = []
        for task in dict.fromkeys(a.index.task.name for a in self.assessments):
            name = self.best(task)
            probability = interval(self.interval(name))
            said.append(f"Task {task}: {name} has the largest probability, {probability}, of at {sign} {self.threshold:g}.")
        return [*said, *self.notes]

    def save(self, folder: str | Path) -> list[Path]:
        """Write a folder with one in it for each candidate, and a report; ``holdfast report`` reads it again.

        :func:`holdfast.assessment.load_comparison` does, too.

        Returns:
            ``comparison.json``, which names the candidates, and ``report.html``.

        Raises:
            StoreError: A folder exists with something else in it, or cannot be written.
            InputError: The rows of a candidate were not kept, or its name is that of no folder.
        """
        target = Path(folder)
        for name in self.names:
            if not is_plain(name):
                raise InputError(f"candidate '{name}' is not the name of a folder; give names without / and \\")
        for name, run in zip(self.names, self.assessments, strict=True):
            run.save(target / name, self.threshold)
        listed = [{"name": name, "tool": tool} for name, tool in zip(self.names, self.tools, strict=True)]
        replaced(target / LIST, seal_document({"format": "holdfast-comparison", "sealed": True, "candidates": listed}))
        return [target / LIST, self.report(target / "report.html")]


@checked
def compare_assessments(
    assessments: Sequence[Assessment],
    names: Sequence[str] | None = None,
    threshold: float | None = None,
    *,
    tools: Sequence[str | None] | None = None,
) -> Comparison:
    """Put assessments of one region side by side: arms, tasks or tool attachments.

    Args:
        assessments: Two or more runs with one region, index and number of poses. With one seed they are of the same poses.
        names: Of the candidates; the names of the arms, with those of the tasks where needed, if not given.
        threshold: Value of the index that the task needs. If not given, half of the smallest bound, or about the middle of
            the candidates' medians where an index has no bound.
        tools: What the tool attachments are called; None for an arm's own.

    Raises:
        InputError: Fewer than two runs, runs that cannot be compared, or names that are not unique; the message says which.
    """
    runs = tuple(assessments)
    if len(runs) < 2:
        raise InputError(f"a comparison needs two assessments or more; there {'is 1' if runs else 'are none'}")
    labels = _default_names(runs) if names is None else tuple(names)
    if len(labels) != len(runs):
        raise InputError(f"there are {len(labels)} names for {len(runs)} assessments; give one each")
    check_names(labels)
    first, name = runs[0], labels[0]
    for a, label in zip(runs[1:], labels[1:], strict=True):
        if not _same_region(a.region, first.region):
            raise InputError(f"'{label}' was assessed over another region than '{name}'; assess both over the same one")
        if (a.index.name, a.index.better) != (first.index.name, first.index.better):
            raise InputError(f"'{label}' has the {a.index.name}, '{name}' the {first.index.name}; assess both with one index")
        if a.distribution.samples != first.distribution.samples:
            raise InputError(
                f"'{label}' has {a.distribution.samples} computed poses, '{name}' has {first.distribution.samples}; "
                "assess both with the same number and to the end"
            )
    if not first.distribution.samples:
        raise InputError("nothing is computed yet, so there is nothing to compare; run the assessments first")
    if threshold is not None and not np.isfinite(threshold):
        raise InputError(f"threshold is {threshold:g}; it must be a finite number")
    attached = (None,) * len(runs) if tools is None else tuple(tools)
    if len(attached) != len(runs):
        raise InputError(f"there are {len(attached)} tools for {len(runs)} assessments; give one each, or None")
    return Comparison(
        assessments=runs,
        names=labels,
        threshold=_threshold(runs) if threshold is None else float(threshold),
        chosen=threshold is not None,
        tools=attached,
    )


@checked
def load_comparison(path: str | Path, threshold: float | None = None) -> Comparison:
    """The comparison in a folder that :meth:`Comparison.save` or ``holdfast assess A B --out`` wrote.

    Raises:
        StoreError: It is damaged.
        InputError: See :func:`holdfast.compare_assessments`.
    """
    folder = Path(path)
    again = f"'{folder / LIST}' is damaged; give the same command to 'holdfast assess' again"
    try:
        listed = [(c["name"], c["tool"]) for c in read_sealed(folder / LIST)["candidates"]]
    except (OSError, ValueError, KeyError, TypeError, InputError) as error:
        raise StoreError(again) from error
    if not all(is_plain(name) and (tool is None or isinstance(tool, str)) for name, tool in listed):
        raise StoreError(again)
    runs = [load(folder / name) for name, _ in listed]
    return compare_assessments(runs, [name for name, _ in listed], threshold, tools=[tool for _, tool in listed])


def check_names(names: Sequence[str]) -> None:
    """Raise :class:`InputError` if two candidates have one name.

    Raises:
        InputError: A name is empty or given twice.
    """
    for name in names:
        if not name:
            raise InputError("a candidate has an empty name; give each a name")
        if list(names).count(name) > 1:
            raise InputError(f"two candidates are called '{name}'; give each its own name")


def _default_names(runs: tuple[Assessment, ...]) -> tuple[str, ...]:
    names = [a.arm.name for a in runs]
    if len(set(names)) < len(names):
        names = [f"{a.arm.name}, {a.index.task.name}" for a in runs]
    return tuple(names)


def _threshold(runs: tuple[Assessment, ...]) -> float:
    if all(a.index.bound is not None for a in runs):
        return min(a.default_threshold() for a in runs)
    return float(f"{np.median([a.default_threshold() for a in runs]):.2g}")


def _same_region(a: Region, b: Region) -> bool:
    """The same poses are drawn, whatever the region is called."""
    plain = [{k: v for k, v in r.to_dict().items() if k != "name"} for r in (a, b)]
    return plain[0] == plain[1] and (a.draw, a.weight) == (b.draw, b.weight)


def _failure_kind(a: Assessment) -> str:
    sets = a.index.failures
    size = len(sets[0])
    if size < a.arm.n and sets == failure_sets(a.arm, size):
        return "each joint alone" if size == 1 else f"every {size} joints together"
    return ", ".join(a.index.failure_names)


def _reached(a: Assessment) -> Interval:
    d = a.distribution
    return Interval.of_share(1 - d.unreached_share, d.effective()) if d.weighted else Interval.of(d.reached, d.samples)


def _ends(name: str, p: Interval | None) -> dict[str, float | None]:
    if p is None:
        return {name: None, f"{name}_low": None, f"{name}_high": None}
    return {name: p.value, f"{name}_low": p.low, f"{name}_high": p.high}
