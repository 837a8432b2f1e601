"""Analysis of a workspace by measures over starts, or over targets, which show the targets that a lock puts at risk."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.convergence.analysis import (
    FAILURE_ENDS,
    PATH_CELLS,
    RUN_TOLERANCE,
    Method,
    RelativeTo,
    StartConfigurations,
    choose_method,
    prepare_analysis,
)
from holdfast.control.convergence.maps import Over
from holdfast.control.convergence.measures import MEASURE_NAMES, Arcs
from holdfast.control.convergence.places import Places, read_places
from holdfast.control.convergence.start_workspace import (
    Progress,
    Workspace,
    compute_workspace,
    mean_ignoring_nan,
    mean_intervals,
)
from holdfast.control.laws.law import Law
from holdfast.core.errors import InputError
from holdfast.core.probability.intervals import check_confidence
from holdfast.core.progress import reports_progress
from holdfast.core.registry import LAW_REGISTRY
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.core.validation import check_arguments

if TYPE_CHECKING:
    import xarray as xr


# Number of starts, configurations and failures, by the places of the map and whether places can form a lattice.
_DEFAULT_SAMPLE_SIZES: dict[tuple[Over, bool], tuple[str | int, int, int]] = {
    ("starts", True): ("grid", 36, 10),
    ("starts", False): (100, 8, 3),
    ("targets", True): (20, 8, 2),
    ("targets", False): (20, 4, 2),
}


@dataclass(frozen=True, eq=False, kw_only=True)
class TargetMeasures(Result):
    """Measures of T targets over the same S starts; the last of the n + 1 columns is for an arbitrary joint.

    Attributes:
        law: The control law.
        targets: Places of the targets.
        starts: Places of the end effector at the start.
        values: Measures R100, Ravg, Rsens, F100, Favg and Fsens by name, (T, S, n + 1) each, percent; NaN if the target or
            start is out of reach, and for F also if no failure leaves the target in reach.
        configurations: (T, S) number of analysed starting configurations without those lost at singular configurations.
        ends: (T, 6) number of failures by outcome, as in :class:`holdfast.Workspace`.
    """

    law: Law
    targets: Places
    starts: Places
    values: dict[str, FloatArray]
    configurations: IndexArray
    ends: IndexArray

    @property
    def measures(self) -> dict[str, FloatArray]:
        """Mean of each measure for each target over the starts with a value, (T, n + 1) each, percent."""
        return {name: mean_ignoring_nan(columns, 1) for name, columns in self.values.items()}

    def means(self) -> dict[str, FloatArray]:
        """Return the mean of every measure over the targets with a value, (n + 1,) each, percent."""
        return {name: mean_ignoring_nan(columns, 0) for name, columns in self.measures.items()}

    def intervals(self, confidence: float = 0.95) -> dict[str, FloatArray]:
        """Return the intervals of :meth:`means` at the level ``confidence``, (n + 1, 2) each, percent.

        They hold for these starts if the targets are a random sample. The sampling unit is the target. They are NaN if no
        target has a value.
        """
        check_confidence(confidence)
        return {name: mean_intervals(columns, confidence) for name, columns in self.measures.items()}

    def target_intervals(self, confidence: float = 0.95) -> dict[str, FloatArray]:
        """Return intervals of the ``measures`` of each target at the level ``confidence``, (T, n + 1, 2) each, percent.

        They hold if the starts are a random sample. The sampling unit is the start, as in :meth:`holdfast.Workspace.intervals`.
        """
        check_confidence(confidence)
        return {
            name: np.array([mean_intervals(columns, confidence) for columns in values]) for name, values in self.values.items()
        }

    def to_xarray(self) -> xr.Dataset:
        """Return the measures, percent, by target, start, and joint (the last is ``any``), and the position of each target."""
        dimensions = ("place", "start")
        values: dict[str, Any] = {
            name: ((*dimensions, "joint"), columns, {"units": "percent"}) for name, columns in self.values.items()
        }
        values |= {"configurations": (dimensions, self.configurations), "ends": (("place", "ending"), self.ends)}
        return self.targets.dataset(values, joint=(*self.law.arm.joint_names, "any"), ending=FAILURE_ENDS)


@overload
def workspace(
    law: Law,
    target: ArrayLike,
    starts: ArrayLike | str | int | Places | None = None,
    *,
    over: Literal["starts"] = "starts",
    configurations: int | None = None,
    points: int | None = None,
    method: Method | None = None,
    cells: int = PATH_CELLS,
    time_limit: float | None = None,
    tolerance: float = RUN_TOLERANCE,
    relative_to: RelativeTo = "inside",
    sinks: Mapping[int, Arcs] | None = None,
    seed: int = 0,
    store: str | Path | None = None,
    progress: Progress | None = None,
) -> Workspace: ...
@overload
def workspace(
    law: Law,
    target: ArrayLike | str | int | Places,
    starts: ArrayLike | str | int | Places | None = None,
    *,
    over: Literal["targets"],
    **options: Any,
) -> TargetMeasures: ...
@check_arguments  # type: ignore[misc]  # the second signature leaves its options to this check
@reports_progress("simulating failures")
def workspace(
    law: Law,
    target: ArrayLike | str | int | Places,
    starts: ArrayLike | str | int | Places | None = None,
    *,
    over: Over = "starts",
    configurations: int | None = None,
    points: int | None = None,
    method: Method | None = None,
    cells: int = PATH_CELLS,
    time_limit: float | None = None,
    tolerance: float = RUN_TOLERANCE,
    relative_to: RelativeTo = "inside",
    sinks: Mapping[int, Arcs] | None = None,
    seed: int = 0,
    store: str | Path | None = None,
    progress: Progress | None = None,
) -> Workspace | TargetMeasures:
    """Compute the starts from which a target is still reached if a joint locks on the way and the lock is not detected.

    From every start the arm moves to the target from configurations that are equally spaced along its self-motion, in joint
    space. The path of the end effector is divided into ``cells`` of equal length, and evaluated at their middle. If a joint
    locks at a value inside the range of the target's self-motion (:func:`holdfast.joint_bounds`), the target stays in reach.
    R100 is the percentage of the configurations for which this holds on the whole path, Ravg the mean fraction of the path,
    and Rsens its largest minus its smallest value. At ``points`` of the part inside, for each joint, the failure is simulated
    (:func:`holdfast.control.simulation.simulate`). F100, Favg and Fsens are the same statistics of the fraction of that part
    from which the failed arm reaches the target. For *any* joint, all joints must be inside, and the arm must reach the
    target for every failed joint.

    Near the ends of a range the arm converges ever more slowly. A failure that is undecided at the time limit counts as
    converged if it is next to a solution all of whose eigenvalues attract; otherwise F excludes it. ``ends`` counts both.

    In the part inside for a joint, the section that is inside for all joints is sampled with ``points`` points, and the rest
    in proportion; both are weighted by their lengths.

    **By sampling** (``method="sampled"``), for any redundant arm and task, every start has up to ``configurations`` random
    configurations. With one degree of redundancy they are sampled from equally spaced points on its curves. With more, they
    are those at which inverse kinematics converges from random starts, which do not cover the manifold evenly. The measures
    use the sampled configurations in place of all. Rsens and Fsens are then too small rather than too large, and R100 and F100
    of a start are estimates; 100 is necessary, but not sufficient, for every configuration to succeed
    (:meth:`holdfast.Workspace.throughout`). :meth:`holdfast.Workspace.intervals` returns the intervals of the means over random
    starts.

    **Over targets** (``over="targets"``), the result contains the measures for each of many targets over the same starts.

    Args:
        law: The control law.
        target: (m,) position, m, or (4, 4) pose, as in :func:`holdfast.control.simulation.simulate`; over targets also several,
            a lattice, or a number of random ones, as for the starts.
        starts: ``"grid:52"``, a lattice of 52 points along the edge of the square around the workspace (tasks in a plane; 2032
            places, as in the paper); a number of random places (tool poses at random configurations); or (P, m) positions, m,
            or (P, 4, 4) poses. Default: the lattice, or 100 random places if there is none; over targets 20 random places.
        over: ``starts`` or ``targets``, the places of the map.
        configurations: Number of configurations on each curve of a start's self-motion; by sampling or with more than one
            degree of redundancy, for each start. Default: 36 on a lattice, else 8; over targets 8 or 4.
        points: Largest number of failures of each joint on each motion; 0 omits F. Default: 10 or 3; over targets 2.
        method: ``brute`` simulates every failure; ``procedure`` only those that lock where there is a sink; ``sampled`` every
            failure of random configurations. Default: ``brute`` for a task in a plane, else ``sampled``.
        cells: Number of cells of the path.
        time_limit: Time limit of each run, s. Default: 2000/Ke.
        tolerance: Local error of a step of the simulation, rad (and m).
        relative_to: Reference of F: ``inside``, the part inside, as in the paper, which excludes configurations without such a
            part; or ``whole``, the whole path.
        sinks: Arcs of locked values, rad, at which ``procedure`` simulates failures, by the index of the joint from 0. Default:
            the values at which :func:`holdfast.stationary_points` finds sinks and whole curves of stationary points, and 0.02
            rad on either side of Hopf points, close to which limit cycles exist.
        seed: Seed of the search for configurations and of random starts.
        store: Folder in which the results are stored, so that a stopped analysis can be resumed. Only over starts.
        progress: Function that is called with (starts done, starts in all), or with numbers of targets over targets.

    Returns:
        A :class:`holdfast.Workspace`, or over targets a :class:`holdfast.TargetMeasures`.

    Raises:
        InputError: Wrong shapes or options, a target out of reach, or the procedure for surfaces of stationary points.
        TaskError: The arm has no redundancy for the task.
        StoreError: The folder contains another analysis, or cannot be written.

    Source: Goel, Maciejewski, Balakrishnan 2005, section on the analysis of a workspace. The paper does not define the length
    of a path; here it is that of the end effector's path. Sampling, its intervals, and the measures over targets are ours.
    """
    if over not in ("starts", "targets"):
        raise InputError(f"over '{over}' is not known; use starts or targets")
    if store is not None:
        if over == "targets":
            raise InputError("store keeps an analysis over starts; leave it out with over='targets'")
        LAW_REGISTRY.label(law)  # raises InputError if the law has no label
    chosen = choose_method(law) if method is None else method
    kind: tuple[Over, bool] = over, choose_method(law) == "brute"
    default_starts, default_configurations, default_points = _DEFAULT_SAMPLE_SIZES[kind]
    count = default_configurations if configurations is None else configurations
    failures = default_points if points is None else points
    settings = (count, failures, chosen, cells, time_limit, tolerance, relative_to, sinks, seed)
    generator = np.random.default_rng(seed)
    targets = read_places(law.arm, law.task, target, generator) if over == "targets" else None
    places = read_places(law.arm, law.task, default_starts if starts is None else starts, generator)
    start_configurations = StartConfigurations(law, places, count, chosen, seed)
    if targets is not None:
        return _measure_targets(law, targets, start_configurations, settings, progress)
    job = prepare_analysis(law, target, *settings)
    if not job.is_reached:
        position = ", ".join(f"{coordinate:g}" for coordinate in job.pose[:3, 3])
        raise InputError(
            f"no configuration of '{law.arm.name}' was found at the target ({position}) m; choose one within its reach"
        )
    return compute_workspace(job, start_configurations, store, progress)


def _measure_targets(
    law: Law, targets: Places, starts: StartConfigurations, settings: tuple[Any, ...], progress: Progress | None
) -> TargetMeasures:
    shape = len(targets), len(starts.places)
    values = {name: np.full((*shape, law.arm.n + 1), np.nan) for name in MEASURE_NAMES}
    tried_counts = np.zeros(shape, dtype=np.int64)
    ends = np.zeros((len(targets), len(FAILURE_ENDS)), dtype=np.int64)
    for index, pose in enumerate(targets.poses):
        job = prepare_analysis(law, pose, *settings)
        if job.is_reached:
            target_workspace = compute_workspace(job, starts)
            for name, columns in target_workspace.measures.items():
                values[name][index] = columns
            tried_counts[index] = target_workspace.configurations - target_workspace.lost
            ends[index] = target_workspace.ends.sum(axis=0)
        if progress is not None:
            progress(index + 1, len(targets))
    return TargetMeasures(law=law, targets=targets, starts=starts.places, values=values, configurations=tried_counts, ends=ends)
