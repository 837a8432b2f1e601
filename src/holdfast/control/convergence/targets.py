"""The workspace measures over targets instead of starts, which show the targets that a lock puts at risk from any start."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.convergence.analysis import (
    FAILURE_END_TEXTS,
    FAILURE_ENDS,
    Method,
    StartConfigurations,
    choose_method,
    prepare_analysis,
)
from holdfast.control.convergence.measures import MEASURE_NAMES
from holdfast.control.convergence.places import Places, read_places
from holdfast.control.convergence.start_workspace import compute_workspace, mean_ignoring_nan, mean_intervals
from holdfast.control.laws.law import Law
from holdfast.core.probability.intervals import check_confidence
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.core.validation import check_arguments

if TYPE_CHECKING:
    import xarray as xr


LATTICE_DEFAULTS: tuple[str | int, int] = ("grid:12", 8)  # targets and configurations where targets are a lattice
SAMPLE_DEFAULTS: tuple[str | int, int] = (50, 4)  # and where they are sampled
DEFAULT_STARTS = 20
DEFAULT_POINTS = 2


@dataclass(frozen=True, eq=False, kw_only=True)
class TargetMeasures(Result):
    """Measures of T targets over the same S starts; the last of the n + 1 columns is for an arbitrary joint.

    Attributes:
        law: The law of the controller.
        targets: Where the end effector should go.
        starts: Where it begins.
        values: R100, Ravg, Rsens, F100, Favg and Fsens by name, (T, S, n + 1) each, percent; NaN for a target or start out of
            reach, and F where no failure leaves the target in reach.
        configurations: (T, S) starting configurations that were looked at, less those lost at singular configurations.
        ends: (T, 6) how the failures ended, as in :class:`holdfast.Workspace`.
    """

    law: Law
    targets: Places
    starts: Places
    values: dict[str, FloatArray]
    configurations: IndexArray
    ends: IndexArray

    @property
    def measures(self) -> dict[str, FloatArray]:
        """Mean of each measure for each target over the starts that have it, (T, n + 1) each, percent."""
        return {name: mean_ignoring_nan(columns, 1) for name, columns in self.values.items()}

    def means(self) -> dict[str, FloatArray]:
        """Return the mean of every measure over the targets that have it, (n + 1,) each, percent."""
        return {name: mean_ignoring_nan(columns, 0) for name, columns in self.measures.items()}

    def intervals(self, confidence: float = 0.95) -> dict[str, FloatArray]:
        """Return the intervals of :meth:`means` for targets that are a random sample: (n + 1, 2) each, percent, for these very
        starts.

        The unit is the target. NaN where no target has a value.
        """
        check_confidence(confidence)
        return {name: mean_intervals(columns, confidence) for name, columns in self.measures.items()}

    def target_intervals(self, confidence: float = 0.95) -> dict[str, FloatArray]:
        """Return intervals of the ``measures`` of each target for starts that are a random sample: (T, n + 1, 2) each, percent.

        The unit is the start, as in :meth:`holdfast.Workspace.intervals`.
        """
        check_confidence(confidence)
        return {
            name: np.array([mean_intervals(columns, confidence) for columns in values]) for name, values in self.values.items()
        }

    def describe(self) -> list[str]:
        """Return the measures over the targets in a few sentences."""
        end_text = ", ".join(
            f"{count} {word}" for word, count in zip(FAILURE_END_TEXTS, self.ends.sum(axis=0).tolist(), strict=True)
        )
        within = int(np.isfinite(self.measures["Ravg"][:, -1]).sum())
        return [
            f"{self.law.describe()} on {self.law.arm.title}: {within} of {len(self.targets)} targets within reach of motions "
            f"from {len(self.starts)} starts",
            f"failures: {end_text}",
        ]

    def to_xarray(self) -> xr.Dataset:
        """Return the measures, percent, by target, start, and joint (the last is ``any``), and the position of each target."""
        dimensions = ("place", "start")
        values: dict[str, Any] = {
            name: ((*dimensions, "joint"), columns, {"units": "percent"}) for name, columns in self.values.items()
        }
        values |= {"configurations": (dimensions, self.configurations), "ends": (("place", "ending"), self.ends)}
        return self.targets.dataset(values, joint=(*self.law.arm.joint_names, "any"), ending=FAILURE_ENDS)


@check_arguments
@reports_progress("simulating failures")
def target_measures(
    law: Law,
    targets: ArrayLike | str | int | Places | None = None,
    starts: ArrayLike | str | int | Places | None = None,
    *,
    configurations: int | None = None,
    points: int | None = None,
    method: Method | None = None,
    seed: int = 0,
    progress: Callable[[int, int], None] | None = None,
    **options: Any,
) -> TargetMeasures:
    """Compute the measures of :func:`holdfast.workspace` for many targets, over the same starts.

    Args:
        law: The law of the controller, of a redundant arm.
        targets: A lattice (``"grid:14"``, for a task in a plane), a number of random ones, (T, m) positions or (T, 4, 4)
            poses. If not given: the lattice ``"grid:12"``, or 50 random ones where there is none.
        starts: Likewise; 20 random ones if not given.
        configurations: Of each start, as in :func:`holdfast.workspace`; 8 on a lattice, else 4, if not given.
        points: Failures of each joint on each motion; 2 if not given.
        method: As in :func:`holdfast.workspace`.
        seed: Of random places and of the search for configurations.
        progress: Is told how many targets are done, and of how many.
        options: Further ones of :func:`holdfast.workspace`: ``cells``, ``time_limit``, ``tolerance``, ``relative_to``.

    Returns:
        A :class:`holdfast.TargetMeasures`.

    Raises:
        InputError, TaskError: As :func:`holdfast.workspace`.

    Source: the measures are those of Goel, Maciejewski, Balakrishnan 2005, section 5; over targets they are ours.
    """
    chosen = choose_method(law) if method is None else method
    defaults = LATTICE_DEFAULTS if choose_method(law) == "brute" else SAMPLE_DEFAULTS
    configuration_count = defaults[1] if configurations is None else configurations
    failures = DEFAULT_POINTS if points is None else points
    generator = np.random.default_rng(seed)
    target_places = read_places(law.arm, law.task, defaults[0] if targets is None else targets, generator)
    places = read_places(law.arm, law.task, DEFAULT_STARTS if starts is None else starts, generator)
    start_configurations = StartConfigurations(law, places, configuration_count, chosen, seed)
    shape = len(target_places), len(places)
    values = {name: np.full((*shape, law.arm.n + 1), np.nan) for name in MEASURE_NAMES}
    tried_counts = np.zeros(shape, dtype=np.int64)
    ends = np.zeros((len(target_places), len(FAILURE_ENDS)), dtype=np.int64)
    for index, pose in enumerate(target_places.poses):
        job = prepare_analysis(law, pose, configuration_count, failures, chosen, seed=seed, **options)
        if job.is_reached:
            target_workspace = compute_workspace(job, start_configurations)
            for name, columns in target_workspace.measures.items():
                values[name][index] = columns
            tried_counts[index] = target_workspace.configurations - target_workspace.lost
            ends[index] = target_workspace.ends.sum(axis=0)
        if progress is not None:
            progress(index + 1, len(target_places))
    return TargetMeasures(law=law, targets=target_places, starts=places, values=values, configurations=tried_counts, ends=ends)
