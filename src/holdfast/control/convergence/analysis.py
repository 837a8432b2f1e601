"""Analysis of a workspace for one target, with the motions from every start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.control.convergence.healthy_motion import compiled_healthy_paths
from holdfast.control.convergence.late_convergence import is_near_attracting_solution
from holdfast.control.convergence.measures import MEASURE_NAMES, Arcs, Measures, is_in_arcs, mean_by_row, select_spaced
from holdfast.control.convergence.places import Places, configurations_at, is_planar_position, pick_configurations, read_places
from holdfast.control.equilibria.search import stationary_points
from holdfast.control.laws.law import Law
from holdfast.control.simulation.closed_loop import simulate
from holdfast.control.simulation.runs import Reason
from holdfast.core.errors import InputError, TaskError
from holdfast.core.sweeps.samples import Column
from holdfast.core.typing import BoolArray, FloatArray, IndexArray, Rows
from holdfast.kinematics.workspace.bounds import joint_bounds

Method = Literal["brute", "procedure", "sampled"]
RelativeTo = Literal["inside", "whole"]

TIME_CONSTANTS = 2000.0  # 1/Ke
RUN_TOLERANCE = 1e-8
PATH_CELLS = 100  # cells of a path
HOPF_MARGIN_RAD = 0.02  # rad on either side of a Hopf point, where limit cycles were seen within 0.005
SINK_MARGIN_RAD = 1e-3  # rad: locked angles this close to a sink or a degenerate angle are simulated too
FAILURE_ENDS = ("converged", "stuck", "moving", "undecided", "arriving", "no_sink")  # the first four as Outcome has them
FAILURE_END_TEXTS = (*FAILURE_ENDS[:4], "undecided next to the target", "not simulated (no sink)")
END_ARRIVING = 4
END_NO_SINK = 5
_REACH_VALUES = np.array([1.0, 0.0, 0.0, np.nan, 1.0, 1.0])


class StartConfigurations:
    """Cache of configurations at the starts, computed on request, so that one set serves many targets."""

    def __init__(self, law: Law, places: Places, configurations: int, method: Method, seed: int) -> None:
        self._law = law
        self.places = places
        self._count = configurations
        self._is_sampled = method == "sampled"
        self._seed = seed
        self._cached_blocks: dict[tuple[int, int], tuple[IndexArray, FloatArray]] = {}

    def find_configurations(self, first: int, stop: int) -> tuple[IndexArray, FloatArray]:
        """Return the index from 0 of the place (R,), and configurations (R, n), for places from ``first`` up to ``stop``."""
        if (first, stop) not in self._cached_blocks:
            arm, task, poses = self._law.arm, self._law.task, self.places.poses[first:stop]
            if self._is_sampled:
                generator = np.random.default_rng(np.random.SeedSequence([self._seed, first]))
                owner, _, q = pick_configurations(arm, task, poses, self._count, self._seed, generator)
            else:
                owner, q = configurations_at(arm, task, poses, count=self._count, seed=self._seed)
            self._cached_blocks[first, stop] = owner, q
        return self._cached_blocks[first, stop]


def choose_method(law: Law) -> Method:
    """Return ``brute`` for a task in a plane, whose starts form a lattice, else ``sampled``."""
    return "brute" if is_planar_position(law.task) else "sampled"


@dataclass(frozen=True, eq=False)
class TargetAnalysis:
    """Analysis of the motions to one target with the options of :func:`holdfast.workspace`."""

    law: Law
    pose: FloatArray
    bounds: tuple[tuple[tuple[float, float], ...], ...]
    configurations: int
    points: int
    method: Method
    cells: int
    time_limit: float
    tolerance: float
    relative_to: RelativeTo
    sinks: Mapping[int, Arcs] | None
    seed: int

    names = (*MEASURE_NAMES, "configurations", "lost", "ends")

    @property
    def is_reached(self) -> bool:
        """True if a configuration was found at the target."""
        return any(self.bounds)

    def plan(self, places: Places) -> dict[str, Any]:
        """Return the values that define the results, for a store."""
        return {
            "kind": "workspace",
            "arm": self.law.arm.fingerprint,
            **self.law.to_stored(),
            "target": self.pose.tolist(),
            "starts": places.poses[:, :3].tolist(),
            "configurations": self.configurations,
            "points": self.points,
            "method": self.method,
            "cells": self.cells,
            "time_limit": self.time_limit,
            "tolerance": self.tolerance,
            "relative_to": self.relative_to,
            "sinks": None
            if self.sinks is None
            else {str(joint): [list(arc) for arc in arcs] for joint, arcs in self.sinks.items()},
            "seed": self.seed,
        }

    def store_columns(self) -> list[Column]:
        """Return the columns of a store, which contain the results of each start."""
        joints = (("joint_or_any", self.law.arm.n + 1),)
        return [
            *(Column(name, "float64", joints, units="percent", about=name) for name in MEASURE_NAMES),
            Column("configurations", "int64", (), units="1", about="starting configurations"),
            Column("lost", "int64", (), units="1", about="of them, lost at singular configurations"),
            Column("ends", "int64", (("end", len(FAILURE_ENDS)),), units="1", about=", ".join(FAILURE_ENDS)),
        ]

    def analyse(self, start_index: IndexArray, q0: FloatArray, count: int) -> Rows:
        """Analyse ``count`` starts from configurations q0 (R, n) of the starts ``start_index`` (R,), and return all results."""
        arm = self.law.arm
        paths = compiled_healthy_paths(self.law)
        target = np.broadcast_to(self.pose, (len(q0), 4, 4))
        q = np.empty((self.cells, len(q0), arm.n))
        for cell, configurations in enumerate(paths.iterate_cell_midpoints(q0, target, self.cells)):
            q[cell] = configurations
        is_finite: BoolArray = np.asarray(np.isfinite(q[-1]).all(axis=1))
        lost_counts = np.bincount(start_index[~is_finite], minlength=count)
        tried_counts = np.bincount(start_index, minlength=count)
        start_index, q = start_index[is_finite], q[:, is_finite]
        inside = np.stack([is_in_arcs(q[..., joint], self.bounds[joint], not arm.prismatic[joint]) for joint in range(arm.n)])
        inside = np.concatenate([inside, inside.all(axis=0, keepdims=True)])  # (n + 1, K, R)
        inside_fraction = inside.mean(axis=1).T
        fractions, ends = self._compute_converging_fractions(q, inside, start_index, count)
        if self.relative_to == "whole":
            fractions = np.where(inside_fraction > 0, fractions * inside_fraction, 0.0 if self.points else np.nan)
        measures = (
            *Measures.from_fractions(inside_fraction, start_index, count).parts,
            *Measures.from_fractions(fractions, start_index, count).parts,
        )
        values: list[NDArray[Any]] = [*measures, tried_counts, lost_counts, ends]
        return dict(zip(self.names, values, strict=True))

    def _compute_converging_fractions(
        self, q: FloatArray, inside: BoolArray, owner: IndexArray, starts: int
    ) -> tuple[FloatArray, IndexArray]:
        """Return the fraction (R, n + 1) of the part inside from which the failed arm converges, and counts of failure ends.

        The counts have the shape (starts, 6).
        """
        n, row_count = self.law.arm.n, q.shape[1]
        fractions, ends = np.full((row_count, n + 1), np.nan), np.zeros((starts, len(FAILURE_ENDS)), dtype=np.int64)
        if not self.points or not row_count:
            return fractions, ends
        inside_counts = inside.sum(axis=1)  # (n + 1, R) cells
        shared_cells = select_spaced(inside[n], np.full(row_count, self.points))
        groups = [(*shared_cells, joint_index) for joint_index in range(n)]
        for joint_index in range(n):
            inside_alone = inside[joint_index] & ~inside[n]
            alone_fraction = inside_alone.sum(axis=0) / np.maximum(inside_counts[joint_index], 1)
            groups.append((*select_spaced(inside_alone, np.ceil(self.points * alone_fraction).astype(np.int64)), joint_index))
        rows_of_cells = np.concatenate([group[0] for group in groups])
        cell_indices = np.concatenate([group[1] for group in groups])
        joint = np.repeat([group[2] for group in groups], [len(group[0]) for group in groups])
        failure_ends = self._classify_failure_ends(q[cell_indices, rows_of_cells], joint)
        np.add.at(ends, (owner[rows_of_cells], failure_ends), 1)
        reach_values = _REACH_VALUES[failure_ends]
        parts = np.split(reach_values, np.cumsum([len(group[0]) for group in groups])[:-1])
        # (n, R) fraction of the part inside for a joint that is inside for all joints.
        shared_fraction = inside_counts[n] / np.maximum(inside_counts[:n], 1)
        for joint_index in range(n):
            shared_mean = mean_by_row(parts[joint_index], shared_cells[0], row_count)
            inside_alone = mean_by_row(parts[n + joint_index], groups[n + joint_index][0], row_count)
            shared_mean, inside_alone = (
                np.where(np.isnan(shared_mean), inside_alone, shared_mean),
                np.where(np.isnan(inside_alone), shared_mean, inside_alone),
            )
            fractions[:, joint_index] = (
                shared_fraction[joint_index] * shared_mean + (1 - shared_fraction[joint_index]) * inside_alone
            )
        reached_jointly = np.stack(parts[:n])
        has_failed = (reached_jointly == 0).any(axis=0)
        fractions[:, n] = mean_by_row(np.where(has_failed, 0.0, reached_jointly.sum(axis=0) / n), shared_cells[0], row_count)
        return fractions, ends

    def _classify_failure_ends(self, q: FloatArray, joint: IndexArray) -> IndexArray:
        """Return the ends (N,) of failures of joints (N,) at configurations (N, n), as indices of ``FAILURE_ENDS``."""
        failure_ends = np.full(len(q), END_NO_SINK)
        needs_run = np.ones(len(q), dtype=bool)
        if self.sinks is not None:
            for sink_joint, arcs in self.sinks.items():
                is_joint = joint == sink_joint
                wide_arcs = [(lower - SINK_MARGIN_RAD, upper + SINK_MARGIN_RAD) for lower, upper in arcs]
                needs_run[is_joint] = is_in_arcs(q[is_joint, sink_joint], wide_arcs, not self.law.arm.prismatic[sink_joint])
        if needs_run.any():
            runs = simulate(
                self.law, q[needs_run], self.pose, locked=joint[needs_run], time_limit=self.time_limit, tolerance=self.tolerance
            )
            code = runs.code.astype(np.int64)
            slow_runs = np.flatnonzero(runs.reason == Reason.TIME_LIMIT)
            code[
                slow_runs[
                    is_near_attracting_solution(self.law, runs.q_final[slow_runs], self.pose, joint[needs_run][slow_runs])
                ]
            ] = END_ARRIVING
            failure_ends[needs_run] = code
        return failure_ends


def prepare_analysis(
    law: Law,
    target: ArrayLike | str | int | Places,
    configurations: int,
    points: int,
    method: Method,
    cells: int = PATH_CELLS,
    time_limit: float | None = None,
    tolerance: float = RUN_TOLERANCE,
    relative_to: RelativeTo = "inside",
    sinks: Mapping[int, Arcs] | None = None,
    seed: int = 0,
) -> TargetAnalysis:
    """Prepare the analysis of a target; it has no bounds if the target is not reached.

    Raises:
        InputError: Wrong shapes or options, or a procedure for a target with surfaces of stationary points.
        TaskError: The arm has no redundancy for the task.
    """
    arm, task = law.arm, law.task
    if arm.n <= task.m:
        raise TaskError(
            f"'{arm.name}' has {arm.n} joints and the task '{task.name}' {task.m} rows: without redundancy no joint may lock; "
            "choose a task with fewer rows"
        )
    for option_name, number, minimum in (("configurations", configurations, 1), ("points", points, 0), ("cells", cells, 1)):
        if number < minimum:
            raise InputError(f"{option_name} is {number}; it must be {minimum} or more")
    if method not in ("brute", "procedure", "sampled"):
        raise InputError(f"method '{method}' is not known; use brute, procedure or sampled")
    if relative_to not in ("inside", "whole"):
        raise InputError(f"relative_to '{relative_to}' is not known; use inside or whole")
    if sinks is not None and method != "procedure":
        raise InputError(f"sinks belong to method='procedure'; '{method}' simulates every failure")
    run_limit = TIME_CONSTANTS / law.gain if time_limit is None else float(time_limit)
    targets = read_places(arm, task, target, np.random.default_rng(seed))
    if len(targets) != 1:
        raise InputError(f"there are {len(targets)} targets; give one, or over='targets' for several")
    target_pose = targets.poses[0]
    bounds = tuple(tuple(arcs) for arcs in joint_bounds(arm.without_idle_limits, target_pose, task, seed=seed))
    arcs = None
    if method == "procedure" and any(bounds):
        arcs = _find_sinks(law, target_pose) if sinks is None else {joint: list(sinks.get(joint, ())) for joint in range(arm.n)}
    return TargetAnalysis(
        law, target_pose, bounds, configurations, points, method, cells, run_limit, tolerance, relative_to, arcs, seed
    )


def _find_sinks(law: Law, pose: FloatArray) -> dict[int, Arcs]:
    """Return the locked values of each joint with a sink, and those near which motions may cycle or converge slowly."""
    sink_arcs: dict[int, Arcs] = {}
    for joint in range(law.arm.n):
        curves = stationary_points(law, pose, {joint: None})
        if len(curves.loose):
            raise InputError(
                f"with {law.arm.joint_names[joint]} locked the stationary points form surfaces, which were only sampled, so "
                "the procedure could miss sinks; use method='sampled' or 'brute'"
            )
        hopf_arcs = [
            (value - HOPF_MARGIN_RAD, value + HOPF_MARGIN_RAD)
            for curve in curves.curves
            for value in curve.locked_values[curve.hopf_points].tolist()
        ]
        sink_arcs[joint] = [*curves.sink_arcs, *((value, value) for value in curves.degenerate_angles), *hopf_arcs]
    return sink_arcs
