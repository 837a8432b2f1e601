"""Comparison of assessments of one region: arms, tasks, or tool attachments."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError, StoreError
from holdfast.core.files.digest import seal_document
from holdfast.core.files.output import replace_file
from holdfast.core.files.sealed import read_sealed
from holdfast.core.probability.intervals import Interval
from holdfast.core.result import Result
from holdfast.core.sweeps.folder import is_valid_folder_name
from holdfast.core.validation import check_arguments
from holdfast.kinematics.regions.region import Region
from holdfast.model.failure_modes import failure_sets
from holdfast.studies.assessment.assessment import Assessment
from holdfast.studies.assessment.run import load
from holdfast.studies.assessment.single_points import structure
from holdfast.studies.assessment.upgrade import Upgrade

COMPARISON_FILE = "comparison.json"  # lists the compared folders


@dataclass(frozen=True, kw_only=True)
class Comparison(Result):
    """Assessments of one region with one index and equal numbers of poses; see :func:`holdfast.compare_assessments`.

    Attributes:
        assessments: Assessments of the candidates.
        names: Names of the candidates.
        threshold: Value of the index that the task needs.
        chosen: True if the threshold was given.
        tools: Names of the candidates' tool attachments; None for the tool of the arm.
    """

    assessments: tuple[Assessment, ...]
    names: tuple[str, ...]
    threshold: float
    chosen: bool
    tools: tuple[str | None, ...]

    @cached_property
    def table(self) -> list[dict[str, Any]]:
        """Table with one dictionary per candidate; fractions refer to all poses, and intervals have 95 % confidence.

        The keys are ``name, arm, joints, task, redundancy`` (joints minus rows of the task), ``poses``, ``reached``,
        ``probability`` (that the index meets the threshold), ``median`` (over the reached poses), ``gap`` (from the median to
        the bound), ``worst_joint`` (or set of joints) and ``worst_fraction`` of the reached, non-singular poses; the same at
        the best configurations with the prefix ``optimised_``; ``expected_survival`` (fraction of the poses that remain after a
        lock, if each computed joint is equally likely to fail), ``single_points_of_failure`` by structure; ``upgrade``, the
        joint that gains most if it never fails, and ``upgrade_gain``. ``_low`` and ``_high`` are ends of intervals. Joints
        appear by name, and quantities that a run did not compute are None.
        """
        return [self._candidate_row(name, assessment) for name, assessment in zip(self.names, self.assessments, strict=True)]

    def _candidate_row(self, name: str, assessment: Assessment) -> dict[str, Any]:
        task = assessment.index.task
        task_structure = structure(assessment.arm, task)
        row: dict[str, Any] = {
            "name": name,
            "arm": assessment.arm.name,
            "joints": assessment.arm.n,
            "task": task.name,
            "redundancy": assessment.arm.n - task.m,
            "poses": assessment.distribution.samples,
        }
        row |= _make_interval_entries("reached", _reached_fraction_interval(assessment))
        for optimised, prefix in ((False, ""), (True, "optimised_")):
            is_computed = not optimised or assessment.optimised is not None
            row |= _make_interval_entries(f"{prefix}probability", self.interval(assessment, optimised) if is_computed else None)
            has_values = is_computed and assessment.distribution_of(optimised).reached > 0
            row[f"{prefix}median"] = float(assessment.distribution_of(optimised).quantile(0.5)) if has_values else None
            row[f"{prefix}gap"] = assessment.gap(optimised) if has_values else None
            counts = assessment.optimised_worst_counts if optimised else assessment.worst_counts
            row |= {f"{prefix}worst_joint": None, f"{prefix}worst_fraction": None}
            if counts is not None and counts.sum() > 0:
                row[f"{prefix}worst_joint"] = assessment.index.failure_names[int(counts.argmax())]
                row[f"{prefix}worst_fraction"] = float(counts.max() / counts.sum())
        fractions = None if assessment.survivors is None else [interval.value for interval in assessment.survival().values()]
        row["expected_survival"] = None if fractions is None else float(np.mean(fractions))
        fatal = range(assessment.arm.n) if task_structure.never or task_structure.redundancy <= 0 else task_structure.fatal
        row["single_points_of_failure"] = [assessment.arm.joint_names[joint] for joint in fatal]
        upgrades = self.upgrades(name) if assessment.has_rows else []
        row["upgrade"] = upgrades[0].joint if upgrades and upgrades[0].gain > 0 else None
        row["upgrade_gain"] = upgrades[0].gain if upgrades else None
        return row

    def interval(self, candidate: str | Assessment, optimised: bool = False) -> Interval:
        """Return the probability that the index of ``candidate``, an assessment or its name, meets the threshold.

        The result has a confidence interval. ``optimised`` selects the best configurations.
        """
        assessment = self.assessment(candidate) if isinstance(candidate, str) else candidate
        condition = {"at_least" if assessment.index.better == "larger" else "at_most": self.threshold}
        return assessment.interval(optimised=optimised, **condition)  # type: ignore[arg-type]

    def assessment(self, name: str) -> Assessment:
        """Return the assessment of the candidate ``name``.

        Raises:
            InputError: There is no candidate of this name.
        """
        if name not in self.names:
            raise InputError(f"candidate '{name}' is not known; use {', '.join(self.names)}")
        return self.assessments[self.names.index(name)]

    def best(self, task: str | None = None, optimised: bool = False) -> str:
        """Return the name of the candidate with the largest probability of meeting the threshold, then the largest median.

        Args:
            task: Name of the task of the candidates to consider. Default: all candidates.
            optimised: True for the best configurations.

        Raises:
            InputError: No candidate has the task, or a run was not optimised.
        """
        return self.ranking(task, optimised)[0]

    def ranking(self, task: str | None = None, optimised: bool = False) -> list[str]:
        """Return the names of the candidates, the best first, with ``task`` and ``optimised`` as in :meth:`best`."""
        candidates = [
            n for n, assessment in zip(self.names, self.assessments, strict=True) if task in (None, assessment.index.task.name)
        ]
        if not candidates:
            task_names = sorted({assessment.index.task.name for assessment in self.assessments})
            raise InputError(f"no candidate has task '{task}'; use {', '.join(task_names)}")

        def rank_key(name: str) -> tuple[float, float]:
            assessment = self.assessment(name)
            median = (
                float(assessment.distribution_of(optimised).quantile(0.5))
                if assessment.distribution_of(optimised).reached
                else np.nan
            )
            median = median if assessment.index.better == "larger" else -median
            return self.interval(assessment, optimised).value, median if np.isfinite(median) else -np.inf

        return sorted(candidates, key=rank_key, reverse=True)

    def upgrades(self, candidate: str, optimised: bool = False) -> list[Upgrade]:
        """Return the gain of the candidate of a name for each joint if it could never fail; see :meth:`Assessment.upgrades`.

        ``candidate`` is the name, and ``optimised`` selects the best configurations.
        """
        return self.assessment(candidate).upgrades(self.threshold, optimised)

    @cached_property
    def notes(self) -> list[str]:
        """Differences between the candidates that matter for the comparison, one sentence each."""
        runs = self.assessments
        first = runs[0]
        sentences = []
        tasks = list(dict.fromkeys(run.index.task.name for run in runs))
        if len(tasks) > 1:
            sentences.append(
                f"The tasks differ ({', '.join(tasks)}): the {first.index.name} of different tasks is a different quantity, so "
                "compare such candidates by what the work needs, not by the number alone."
            )
        elif any(run.index.task.m != first.index.task.m for run in runs):
            sentences.append("Tasks of the same name have different rows: their indices are different quantities.")
        lengths = sorted({run.index.task.length for run in runs})
        if len(lengths) > 1:
            sentences.append(
                f"The characteristic lengths differ ({', '.join(f'{value:g}' for value in lengths)} m), and the "
                f"index with them."
            )
        if len({_describe_failures(run) for run in runs}) > 1:
            kinds = "; ".join(f"{name}: {_describe_failures(run)}" for name, run in zip(self.names, runs, strict=True))
            sentences.append(f"The failures considered differ ({kinds}).")
        bounds = sorted({run.index.bound for run in runs if run.index.bound is not None})
        if len(bounds) > 1:
            values = ", ".join(f"{value:.3f}" for value in bounds)
            sentences.append(
                f"The upper bounds of the index differ ({values}): one threshold asks more of some than of others."
            )
        if len({(run.seed, run.sampling) for run in runs}) > 1:
            sentences.append("Seeds or sampling differ, so the candidates were tried at different poses of the region.")
        if len({run.restarts for run in runs}) > 1:
            sentences.append("The numbers of restarts differ, so 'not found' was decided with unequal effort.")
        if len({run.optimised is None for run in runs}) > 1:
            sentences.append("Only some candidates were optimised.")
        optimised_plans = [run.plan for run in runs if run.optimised is not None]
        if len({(plan.clearance is None, plan.margin) for plan in optimised_plans}) > 1:
            sentences.append(
                "The best configurations are not equally clear of the arm itself: the clearances asked for differ."
            )
        if len({None if run.plan.cell is None else run.plan.cell.digest for run in runs}) > 1:
            sentences.append("The candidates are not in the same cell.")
        return sentences

    def save(self, folder: str | Path) -> list[Path]:
        """Write ``folder`` with a subfolder for each candidate, and a report.

        ``holdfast report`` and :func:`holdfast.studies.assessment.load_comparison` read the folder again.

        Returns:
            Paths of ``comparison.json``, which lists the candidates, and ``report.html``.

        Raises:
            StoreError: A folder contains other files, or cannot be written.
            InputError: The rows of a candidate were not kept, or its name is not a valid folder name.
        """
        target = Path(folder)
        for name in self.names:
            if not is_valid_folder_name(name):
                raise InputError(f"candidate '{name}' is not a valid folder name; give names without / and \\")
        for name, run in zip(self.names, self.assessments, strict=True):
            run.save(target / name, self.threshold)
        candidates = [{"name": name, "tool": tool} for name, tool in zip(self.names, self.tools, strict=True)]
        replace_file(target / COMPARISON_FILE, seal_document({"format": "holdfast-comparison", "candidates": candidates}))
        return [target / COMPARISON_FILE, self.report(target / "report.html")]


@check_arguments
def compare_assessments(
    assessments: Sequence[Assessment],
    names: Sequence[str] | None = None,
    threshold: float | None = None,
    *,
    tools: Sequence[str | None] | None = None,
) -> Comparison:
    """Compare assessments of one region: arms, tasks, or tool attachments.

    Args:
        assessments: Two or more runs with one region, index and number of poses. With one seed they have the same poses.
        names: Names of the candidates. Default: the names of the arms, with those of the tasks if needed.
        threshold: Value of the index that the task needs. Default: half of the smallest bound, or about the middle of the
            candidates' medians for an index without bound.
        tools: Names of the tool attachments; None for the tool of the arm.

    Raises:
        InputError: There are fewer than two runs, the runs cannot be compared, or the names are not unique.
    """
    runs = tuple(assessments)
    if len(runs) < 2:
        raise InputError(f"a comparison needs two assessments or more; there {'is 1' if runs else 'are none'}")
    labels = _make_default_names(runs) if names is None else tuple(names)
    if len(labels) != len(runs):
        raise InputError(f"there are {len(labels)} names for {len(runs)} assessments; give one for each")
    check_names(labels)
    first, first_label = runs[0], labels[0]
    for other, label in zip(runs[1:], labels[1:], strict=True):
        if not _is_same_region(other.region, first.region):
            raise InputError(f"'{label}' was assessed over another region than '{first_label}'; assess both over the same one")
        if (other.index.name, other.index.better) != (first.index.name, first.index.better):
            raise InputError(
                f"'{label}' has the {other.index.name}, '{first_label}' the {first.index.name}; assess both with one index"
            )
        if other.distribution.samples != first.distribution.samples:
            raise InputError(
                f"'{label}' has {other.distribution.samples} computed poses, '{first_label}' has {first.distribution.samples}; "
                "assess both with the same number and to the end"
            )
    if not first.distribution.samples:
        raise InputError("nothing is computed yet, so there is nothing to compare; run the assessments first")
    if threshold is not None and not np.isfinite(threshold):
        raise InputError(f"threshold is {threshold:g}; it must be a finite number")
    attached = (None,) * len(runs) if tools is None else tuple(tools)
    if len(attached) != len(runs):
        raise InputError(f"there are {len(attached)} tools for {len(runs)} assessments; give one for each, or None")
    return Comparison(
        assessments=runs,
        names=labels,
        threshold=_choose_threshold(runs) if threshold is None else float(threshold),
        chosen=threshold is not None,
        tools=attached,
    )


@check_arguments
def load_comparison(path: str | Path, threshold: float | None = None) -> Comparison:
    """Read the comparison in a folder that :meth:`Comparison.save` or ``holdfast assess A B --out`` wrote.

    Args:
        path: Path of the folder.
        threshold: Value of the index that the task needs. Default: the stored threshold.

    Raises:
        StoreError: The folder is damaged.
        InputError: The assessments cannot be compared; see :func:`holdfast.compare_assessments`.
    """
    folder = Path(path)
    damage_message = f"'{folder / COMPARISON_FILE}' is damaged; give the same command to 'holdfast assess' again"
    try:
        candidates = [
            (candidate["name"], candidate["tool"]) for candidate in read_sealed(folder / COMPARISON_FILE)["candidates"]
        ]
    except (OSError, ValueError, KeyError, TypeError, InputError) as error:
        raise StoreError(damage_message) from error
    if not all(is_valid_folder_name(name) and (tool is None or isinstance(tool, str)) for name, tool in candidates):
        raise StoreError(damage_message)
    runs = [load(folder / name) for name, _ in candidates]
    return compare_assessments(runs, [name for name, _ in candidates], threshold, tools=[tool for _, tool in candidates])


def check_names(names: Sequence[str]) -> None:
    """Raise :class:`InputError` if two candidates have the same name.

    Raises:
        InputError: A name is empty or given twice.
    """
    for name in names:
        if not name:
            raise InputError("a candidate has an empty name; give each candidate a name")
        if list(names).count(name) > 1:
            raise InputError(f"two candidates have the name '{name}'; give each a different name")


def _make_default_names(runs: tuple[Assessment, ...]) -> tuple[str, ...]:
    names = [run.arm.name for run in runs]
    if len(set(names)) < len(names):
        names = [f"{run.arm.name}, {run.index.task.name}" for run in runs]
    return tuple(names)


def _choose_threshold(runs: tuple[Assessment, ...]) -> float:
    if all(run.index.bound is not None for run in runs):
        return min(run.default_threshold() for run in runs)
    return float(f"{np.median([run.default_threshold() for run in runs]):.2g}")


def _is_same_region(first: Region, second: Region) -> bool:
    """Return whether two regions sample the same poses; their names do not matter."""
    contents = [{key: value for key, value in region.to_dict().items() if key != "name"} for region in (first, second)]
    return contents[0] == contents[1] and (first.draw, first.weight) == (second.draw, second.weight)


def _describe_failures(assessment: Assessment) -> str:
    failures = assessment.index.failures
    size = len(failures[0])
    if size < assessment.arm.n and failures == failure_sets(assessment.arm, size):
        return "each joint alone" if size == 1 else f"every {size} joints together"
    return ", ".join(assessment.index.failure_names)


def _reached_fraction_interval(assessment: Assessment) -> Interval:
    distribution = assessment.distribution
    return (
        Interval.of_share(1 - distribution.unreached_share, distribution.effective())
        if distribution.has_weights
        else Interval.from_counts(distribution.reached, distribution.samples)
    )


def _make_interval_entries(name: str, interval: Interval | None) -> dict[str, float | None]:
    if interval is None:
        return {name: None, f"{name}_low": None, f"{name}_high": None}
    return {name: interval.value, f"{name}_low": interval.low, f"{name}_high": interval.high}
