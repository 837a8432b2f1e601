"""Sampled maps of the outcomes of failed arms over the positions of starts or of targets, for any arm and task."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.control.convergence.places import Places, pick_configurations, read_places
from holdfast.control.laws.law import Law
from holdfast.control.simulation.closed_loop import simulate
from holdfast.control.simulation.runs import UNDECIDED_REASONS, Reason, RunOutcome
from holdfast.core.errors import InputError
from holdfast.core.probability.intervals import Interval, check_confidence
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.solvers.inverse_kinematics import solver
from holdfast.model.arm.configurations import as_configurations
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance

if TYPE_CHECKING:
    import xarray as xr

Over = Literal["starts", "targets"]
Progress = Callable[[int, int], None]

TIME_CONSTANTS = 500.0  # 1/Ke
RUN_TOLERANCE = 1e-8
NO_CONFIGURATION = 255  # code of a motion for which no configuration was found
REACH_RESTARTS = 20  # random starts of the search for the target with the joint locked
REACH_TOLERANCE = 1e-4  # m and rad
_SLICE_RUNS = 1 << 16  # runs that are simulated together; no result depends on it
_BY_LOCK = ("code", "reason", "in_reach", "limits_passed")
_OUTCOME_BY_NAME = {o.name.lower(): o for o in RunOutcome}


@dataclass(frozen=True, eq=False, kw_only=True)
class ConvergenceMap(Result):
    """Outcomes of C motions at each of P places with each joint locked from the start, and without failure (last column).

    Attributes:
        law: The control law.
        places: The P places of the map.
        over: ``starts`` or ``targets``, depending on which end of the motions lies at the places.
        q0: (P, C, n) configurations at the start, rad and m; NaN if none was found.
        target: (P, C, 4, 4) tool poses of the targets.
        code: (P, C, n + 1) :class:`holdfast.control.simulation.RunOutcome`, or 255 if there was no configuration.
        reason: (P, C, n + 1) :class:`holdfast.control.simulation.Reason` of undecided runs.
        in_reach: (P, C, n + 1) True if the end effector reached the target, or if a configuration at the target was found
            within the limits with the joint at its locked value.
        limits_passed: (P, C, n + 1) True if a joint left its limits during the motion, which does not enforce them.
        seed: Seed of places, configurations and targets.
        clearance: Collision model with which the runs were checked for contacts; None if they were not. It changes no run.
        touched: (P, C, n + 1) True if the arm has a contact during the motion; an upper bound, because distances are lower
            bounds. None if contacts were not checked.
    """

    law: Law
    places: Places
    over: Over
    q0: FloatArray
    target: FloatArray
    code: NDArray[np.uint8]
    reason: NDArray[np.uint8]
    in_reach: BoolArray
    limits_passed: BoolArray
    seed: int
    clearance: Clearance | None = None
    touched: BoolArray | None = None

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the locked joint in each column, with ``none`` for the last."""
        return (*self.law.arm.joint_names, "none")

    @property
    def words(self) -> tuple[str, ...]:
        """Outcomes that :meth:`has_outcome` accepts, for example ``converged``."""
        return (*_OUTCOME_BY_NAME, "in_reach", "trapped", *(() if self.touched is None else ("touched",)))

    @property
    def has_configuration(self) -> BoolArray:
        """(P, C) array that is True for motions with a configuration to start from."""
        return np.asarray(self.code[..., 0] != NO_CONFIGURATION)

    def has_outcome(self, outcome: str) -> BoolArray:
        """Return a mask (P, C, n + 1) of the runs with an outcome.

        Args:
            outcome: ``converged``, ``stuck``, ``moving`` or ``undecided``; ``in_reach``, if the run converged or could have;
                ``trapped``, if it did not converge although the target was in reach; or, if contacts were checked, ``touched``.

        Raises:
            InputError: The outcome is not known.
        """
        if outcome == "touched" and self.touched is not None:
            return self.touched
        if outcome == "trapped":
            return np.asarray(self.has_configuration[..., None] & (self.code != RunOutcome.CONVERGED) & self.in_reach)
        if outcome == "in_reach":
            return self.in_reach
        if outcome not in _OUTCOME_BY_NAME:
            raise InputError(f"outcome '{outcome}' is not known; use {', '.join(self.words)}")
        return np.asarray(self.code == _OUTCOME_BY_NAME[outcome])

    def values(self, outcome: str = "converged") -> FloatArray:
        """Return the fraction (P, n + 1) of the motions of each place with an ``outcome`` of :meth:`has_outcome`, or NaN."""
        motion_counts = self.has_configuration.sum(axis=1)
        with np.errstate(invalid="ignore"):
            return np.asarray(
                self.has_outcome(outcome).sum(axis=1) / np.where(motion_counts > 0, motion_counts, np.nan)[:, None]
            )

    def shares(self, outcome: str = "converged", confidence: float = 0.95) -> dict[str, Interval]:
        """Return the fraction of motions with an outcome, for each locked joint by name and for ``none``, with its interval.

        Every place has the same weight. The motions of one place are correlated, so the sampling unit is the place. With one
        motion for each place the interval is that of a fraction (:meth:`holdfast.core.probability.Interval.from_counts`), with
        several that of a mean of fractions (:meth:`holdfast.core.probability.Interval.of_fractions`). Both always cover if the
        places are a random sample.

        Args:
            outcome: Outcome of :meth:`has_outcome`.
            confidence: Confidence level of the intervals.
        """
        check_confidence(confidence)
        values, motions_per_place = self.values(outcome), int(self.has_configuration.sum(axis=1).max(initial=0))
        return {
            name: average_fraction(values[:, column], motions_per_place, confidence) for column, name in enumerate(self.columns)
        }

    def to_xarray(self) -> xr.Dataset:
        """Return the start, the target, and the outcome with each joint locked of each motion from or to each place."""
        dimensions = ("place", "motion")
        names = (*_BY_LOCK, *(() if self.touched is None else ("touched",)))
        values: dict[str, Any] = {name: ((*dimensions, "locked"), getattr(self, name)) for name in names}
        values |= {"q0": ((*dimensions, "joint"), self.q0), "target": ((*dimensions, "row", "column"), self.target)}
        return self.places.dataset(values, locked=self.columns, joint=self.law.arm.joint_names)

    def count_undecided(self) -> dict[str, int]:
        """Return the number of undecided runs, by the name of the :class:`holdfast.control.simulation.Reason` in lower case."""
        return {cause.name.lower(): int((self.reason == cause).sum()) for cause in UNDECIDED_REASONS}


def average_fraction(values: FloatArray, motions_per_place: int, confidence: float) -> Interval:
    """Return the mean, with its interval, of the fractions (P,) of independent places with one or several motions each.

    Raises:
        InputError: All fractions are NaN.
    """
    values = values[~np.isnan(values)]
    if not values.size:
        raise InputError("no configuration was found at any place, so there are no fractions; choose places within reach")
    if motions_per_place == 1:
        return Interval.from_counts(int(values.sum()), values.size, confidence)
    return Interval.of_fractions(values, confidence)


@check_arguments
@reports_progress("simulating failures")
def convergence_map(
    law: Law,
    targets: ArrayLike | str | int | Places,
    starts: ArrayLike | str | int | Places = 1000,
    *,
    configurations: int = 20,
    over: Over = "starts",
    q0: ArrayLike | None = None,
    time_limit: float | None = None,
    tolerance: float = RUN_TOLERANCE,
    seed: int = 0,
    progress: Progress | None = None,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
) -> ConvergenceMap:
    """Map the outcomes of motions with each joint locked from the start, of which the controller has no information.

    Over ``starts``, the arm starts at every place in ``configurations`` configurations and moves towards the target, or towards
    a random one of the targets. With one degree of redundancy the configurations are sampled from equally spaced points on the
    self-motion; otherwise they are random. Over ``targets``, the arm moves towards every place from ``configurations``
    configurations sampled from those of the starts or from ``q0`` (all of them if there are fewer). Each motion is simulated
    with each joint locked, and without failure.

    Args:
        law: The control law, for any arm, task and redundancy.
        targets: Targets of the end effector: one or several positions (m,), m, or poses (4, 4); a number of random ones (tool
            poses at random configurations within the limits); or ``"grid:52"``, see :func:`holdfast.workspace`.
        starts: Places of the end effector when the joint locks, in the same forms.
        configurations: Number of motions for each place.
        over: ``starts`` or ``targets``, the places of the map.
        q0: (n,) or (Q, n) configurations to start from, rad and m, in place of ``starts``; only over targets.
        time_limit: Time limit of each run, s. Default: 500/Ke.
        tolerance: Local error of a step of the simulation, rad (and m).
        seed: Seed of all random choices.
        progress: Function that is called with (runs done, runs in all).
        clearance: Collision model of the arm, used with a cell, which it may contain. None: the default model. Every run is
            then checked for contacts, which changes no run and takes longer than the runs themselves.
        cell: Objects around the arm, or their file.

    Raises:
        InputError: Wrong shapes or options.
        TaskError: A lattice was requested for a task that has none.

    Source: The question is that of Goel, Maciejewski, Balakrishnan 2005; sampled maps are ours.
    """
    if over not in ("starts", "targets"):
        raise InputError(f"over '{over}' is not known; use starts or targets")
    if configurations < 1:
        raise InputError(f"configurations is {configurations}; it must be 1 or more")
    if q0 is not None and over == "starts":
        raise InputError(f"q0 is given with over='{over}'; give over='targets' with fixed starts q0, or leave out q0")
    arm, task = law.arm, law.task
    checked_clearance = chosen_clearance(arm, clearance or False, cell, looks=False)
    target_generator, start_generator, choice_generator = (
        np.random.default_rng(child_seed) for child_seed in np.random.SeedSequence(seed).spawn(3)
    )
    goals = read_places(arm, task, targets, target_generator)
    if over == "starts":
        places = read_places(arm, task, starts, start_generator)
        q = _pick_configurations(law, places, configurations, seed, choice_generator)
        target = goals.poses[choice_generator.integers(0, len(goals), q.shape[:2])]
    else:
        places = goals
        if q0 is None:
            start_places = read_places(arm, task, starts, start_generator)
            start_pool = _pick_configurations(law, start_places, configurations, seed, choice_generator).reshape(-1, arm.n)
            start_pool = start_pool[np.isfinite(start_pool).all(axis=1)]
        else:
            start_pool = as_configurations(arm, q0)[0]
        if not len(start_pool) or not np.isfinite(start_pool).all():
            raise InputError("there is no configuration to start from; choose starts within reach, or finite q0")
        # If there are fewer than requested, each is used once.
        motion_count = min(configurations, len(start_pool))
        chosen_rows = np.argsort(choice_generator.random((len(places), len(start_pool))), axis=1)[:, :motion_count]
        q = start_pool[chosen_rows]
        target = np.broadcast_to(places.poses[:, None], (*q.shape[:2], 4, 4))
    code, reason, in_reach, limits_passed, touched = _simulate_motions(
        law, q, target, time_limit, tolerance, seed, progress, checked_clearance
    )
    return ConvergenceMap(
        law=law,
        places=places,
        over=over,
        q0=q,
        target=np.asarray(target),
        code=code,
        reason=reason,
        in_reach=in_reach,
        limits_passed=limits_passed,
        seed=seed,
        clearance=checked_clearance,
        touched=None if checked_clearance is None else touched,
    )


def _pick_configurations(law: Law, places: Places, count: int, seed: int, generator: np.random.Generator) -> FloatArray:
    """Return configurations (P, count, n) of places, filled up with NaN."""
    q = np.full((len(places), count, law.arm.n), np.nan)
    owner, rank, configurations = pick_configurations(law.arm, law.task, places.poses, count, seed, generator)
    q[owner, rank] = configurations
    return q


def _simulate_motions(
    law: Law,
    q: FloatArray,
    target: FloatArray,
    time_limit: float | None,
    tolerance: float,
    seed: int,
    progress: Progress | None,
    clearance: Clearance | None,
) -> tuple[NDArray[np.uint8], NDArray[np.uint8], BoolArray, BoolArray, BoolArray]:
    """Return codes, reasons, and flags for targets in reach, passed limits, and contacts, (P, C, n + 1) each."""
    n = law.arm.n
    run_limit = TIME_CONSTANTS / law.gain if time_limit is None else float(time_limit)
    is_known = np.isfinite(q).all(axis=-1)
    start, pose = np.repeat(q[is_known], n + 1, axis=0), np.repeat(target[is_known], n + 1, axis=0)
    locked = np.tile([*range(n), -1], int(is_known.sum()))
    code, reason = (np.zeros(len(locked), dtype=np.uint8) for _ in range(2))
    passed, in_reach, touched = (np.zeros(len(locked), dtype=bool) for _ in range(3))
    for first in range(0, len(locked), _SLICE_RUNS):
        rows = slice(first, first + _SLICE_RUNS)
        options: dict[str, Any] = {"time_limit": run_limit, "tolerance": tolerance, "clearance": clearance}
        runs = simulate(law, start[rows], pose[rows], locked=locked[rows], **options)
        touched[rows] = [contact is not None for contact in runs.first_contacts]
        code[rows], reason[rows], passed[rows] = runs.code, runs.reason, runs.limits_passed.any(axis=1)
        in_reach[rows] = _is_in_reach(law, runs.code, start[rows], pose[rows], locked[rows], seed)
        if progress is not None:
            progress(min(first + _SLICE_RUNS, len(locked)), len(locked))
    shape = (*is_known.shape, n + 1)
    results: list[Any] = []
    for values, fill_value in (
        (code, NO_CONFIGURATION),
        (reason, Reason.NONE),
        (in_reach, False),
        (passed, False),
        (touched, False),
    ):
        result = np.full(shape, fill_value, dtype=values.dtype)
        result[is_known] = values.reshape(-1, n + 1)
        results.append(result)
    return results[0], results[1], results[2], results[3], results[4]


def _is_in_reach(
    law: Law, code: NDArray[np.uint8], q: FloatArray, pose: FloatArray, locked: IndexArray, seed: int
) -> BoolArray:
    """Return a mask (N,) of runs that reached the target, or for which a configuration at the target is found."""
    is_found = np.asarray(code == RunOutcome.CONVERGED)
    engine = solver(law.arm.without_idle_limits, law.task)
    open_rows = np.flatnonzero(~is_found)
    locked_rows = open_rows[locked[open_rows] >= 0]
    joints = locked[locked_rows]
    if locked_rows.size:
        angles = q[locked_rows, joints]
        source = np.random.SeedSequence([seed, 1])
        is_found[locked_rows] = engine.is_reachable_with_lock(
            pose[locked_rows], joints, angles, source, REACH_RESTARTS, REACH_TOLERANCE
        )
    healthy = open_rows[locked[open_rows] < 0]
    if healthy.size:
        is_found[healthy] = engine.solve(
            pose[healthy], np.random.SeedSequence([seed, 2]), REACH_RESTARTS, REACH_TOLERANCE
        ).success
    return is_found
