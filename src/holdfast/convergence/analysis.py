"""The analysis of a workspace for one target: the motions from every start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.control.law import Law
from holdfast.convergence.healthy_motion import healthy_paths
from holdfast.convergence.measures import NAMES, Arcs, Flags, Index, Measures, averaged, spaced, within
from holdfast.convergence.places import Places, configurations_at, in_a_plane, picked_at, read_places
from holdfast.convergence.slow_endings import arriving
from holdfast.engine.store import Column
from holdfast.equilibria.search import stationary_points
from holdfast.errors import InputError, TaskError
from holdfast.reach.bounds import joint_bounds
from holdfast.simulation.closed_loop import simulate
from holdfast.simulation.runs import Reason

Array = NDArray[np.float64]
Method = Literal["brute", "procedure", "sampled"]
RelativeTo = Literal["inside", "whole"]

TIME_CONSTANTS = 2000.0  # 1/Ke
TOLERANCE = 1e-8
CELLS = 100  # of a way
CYCLES = 0.02  # rad on either side of a Hopf point, where limit cycles were seen within 0.005
BESIDE = 1e-3  # rad: locked angles this near to a sink or a degenerate angle are simulated too
ENDS = ("converged", "stuck", "moving", "undecided", "arriving", "no_sink")  # the first four as Outcome has them
ENDS_IN_WORDS = (*ENDS[:4], "undecided next to the target", "not simulated (no sink)")
ARRIVING, NO_SINK = 4, 5
_REACHED = np.array([1.0, 0.0, 0.0, np.nan, 1.0, 1.0])


class Beginnings:
    """Configurations at the starts, found when they are asked for and kept: one set serves many targets."""

    def __init__(self, law: Law, places: Places, configurations: int, method: Method, seed: int) -> None:
        self._law, self.places, self._count, self._sampled, self._seed = law, places, configurations, method == "sampled", seed
        self._known: dict[tuple[int, int], tuple[Index, Array]] = {}

    def of(self, first: int, stop: int) -> tuple[Index, Array]:
        """Of the places from ``first`` up to ``stop``: which of them each belongs to (R,), from 0, and they (R, n)."""
        if (first, stop) not in self._known:
            arm, task, poses = self._law.arm, self._law.task, self.places.poses[first:stop]
            if self._sampled:
                generator = np.random.default_rng(np.random.SeedSequence([self._seed, first]))
                owner, _, q = picked_at(arm, task, poses, self._count, self._seed, generator)
            else:
                owner, q = configurations_at(arm, task, poses, count=self._count, seed=self._seed)
            self._known[first, stop] = owner, q
        return self._known[first, stop]


def usual_method(law: Law) -> Method:
    """``brute`` for a task in a plane, where starts are a lattice, else ``sampled``."""
    return "brute" if in_a_plane(law.task) else "sampled"


@dataclass(frozen=True, eq=False)
class Job:
    """One target, and how the motions to it are analysed; the options are those of :func:`holdfast.workspace`."""

    law: Law
    pose: Array
    bounds: tuple[tuple[tuple[float, float], ...], ...]
    configurations: int
    points: int
    method: Method
    cells: int
    limit: float
    tolerance: float
    relative_to: RelativeTo
    sinks: Mapping[int, Arcs] | None
    seed: int

    names = (*NAMES, "configurations", "lost", "ends")

    @property
    def reached(self) -> bool:
        """A configuration was found at the target."""
        return any(self.bounds)

    def plan(self, places: Places) -> dict[str, Any]:
        """What defines the results, for a store."""
        return {
            "kind": "workspace",
            "arm": self.law.arm.fingerprint,
            **self.law.stored(),
            "target": self.pose.tolist(),
            "starts": places.poses[:, :3].tolist(),
            "configurations": self.configurations,
            "points": self.points,
            "method": self.method,
            "cells": self.cells,
            "time_limit": self.limit,
            "tolerance": self.tolerance,
            "relative_to": self.relative_to,
            "sinks": None if self.sinks is None else {str(k): [list(a) for a in arcs] for k, arcs in self.sinks.items()},
            "seed": self.seed,
        }

    def store_columns(self) -> list[Column]:
        """What a store holds of each start."""
        joints = (("joint_or_any", self.law.arm.n + 1),)
        return [
            *(Column(name, "float64", joints, units="percent", about=name) for name in NAMES),
            Column("configurations", "int64", (), units="1", about="starting configurations"),
            Column("lost", "int64", (), units="1", about="of them, lost at singular configurations"),
            Column("ends", "int64", (("end", len(ENDS)),), units="1", about=", ".join(ENDS)),
        ]

    def analyse(self, owner: Index, q0: Array, count: int) -> dict[str, NDArray[Any]]:
        """All results of ``count`` starts, from configurations q0 (R, n) of the starts ``owner`` (R,)."""
        arm = self.law.arm
        paths = healthy_paths(self.law)
        target = np.broadcast_to(self.pose, (len(q0), 4, 4))
        q = np.empty((self.cells, len(q0), arm.n))
        for k, there in enumerate(paths.cells(q0, target, self.cells)):
            q[k] = there
        kept: Flags = np.asarray(np.isfinite(q[-1]).all(axis=1))
        lost = np.bincount(owner[~kept], minlength=count)
        tried = np.bincount(owner, minlength=count)
        owner, q = owner[kept], q[:, kept]
        inside = np.stack([within(q[..., j], self.bounds[j], not arm.prismatic[j]) for j in range(arm.n)])
        inside = np.concatenate([inside, inside.all(axis=0, keepdims=True)])  # (n + 1, K, R)
        length = inside.mean(axis=1).T
        share, ends = self._finishes(q, inside, owner, count)
        if self.relative_to == "whole":
            share = np.where(length > 0, share * length, 0.0 if self.points else np.nan)
        measures = (*Measures.of(length, owner, count).parts, *Measures.of(share, owner, count).parts)
        values: list[NDArray[Any]] = [*measures, tried, lost, ends]
        return dict(zip(self.names, values, strict=True))

    def _finishes(self, q: Array, inside: Flags, owner: Index, starts: int) -> tuple[Array, NDArray[np.int64]]:
        """Share (R, n + 1) of the part inside from which the failed arm converges, and how failures ended (starts, 6)."""
        n, rows = self.law.arm.n, q.shape[1]
        share, ends = np.full((rows, n + 1), np.nan), np.zeros((starts, len(ENDS)), dtype=np.int64)
        if not self.points or not rows:
            return share, ends
        count = inside.sum(axis=1)  # (n + 1, R) cells
        every = spaced(inside[n], np.full(rows, self.points))
        groups = [(*every, j) for j in range(n)]
        for j in range(n):
            alone = inside[j] & ~inside[n]
            part = alone.sum(axis=0) / np.maximum(count[j], 1)
            groups.append((*spaced(alone, np.ceil(self.points * part).astype(np.int64)), j))
        row = np.concatenate([g[0] for g in groups])
        cell = np.concatenate([g[1] for g in groups])
        joint = np.repeat([g[2] for g in groups], [len(g[0]) for g in groups])
        ended = self._ends(q[cell, row], joint)
        np.add.at(ends, (owner[row], ended), 1)
        reached = _REACHED[ended]
        parts = np.split(reached, np.cumsum([len(g[0]) for g in groups])[:-1])
        both = count[n] / np.maximum(count[:n], 1)  # (n, R) how much of the part of a joint is inside for all
        for j in range(n):
            shared, alone = averaged(parts[j], every[0], rows), averaged(parts[n + j], groups[n + j][0], rows)
            shared, alone = np.where(np.isnan(shared), alone, shared), np.where(np.isnan(alone), shared, alone)
            share[:, j] = both[j] * shared + (1 - both[j]) * alone
        together = np.stack(parts[:n])
        failed = (together == 0).any(axis=0)
        share[:, n] = averaged(np.where(failed, 0.0, together.sum(axis=0) / n), every[0], rows)
        return share, ends

    def _ends(self, q: Array, joint: NDArray[np.int64]) -> NDArray[np.int64]:
        """(N,) how failures of joints (N,) at configurations (N, n) end, as numbered by ``ENDS``."""
        ended = np.full(len(q), NO_SINK)
        wanted = np.ones(len(q), dtype=bool)
        if self.sinks is not None:
            for j, arcs in self.sinks.items():
                mine = joint == j
                wide = [(lower - BESIDE, upper + BESIDE) for lower, upper in arcs]
                wanted[mine] = within(q[mine, j], wide, not self.law.arm.prismatic[j])
        if wanted.any():
            runs = simulate(
                self.law, q[wanted], self.pose, locked=joint[wanted], time_limit=self.limit, tolerance=self.tolerance
            )
            code = runs.code.astype(np.int64)
            slow = np.flatnonzero(runs.reason == Reason.TIME_LIMIT)
            code[slow[arriving(self.law, runs.q_final[slow], self.pose, joint[wanted][slow])]] = ARRIVING
            ended[wanted] = code
        return ended


def prepared(
    law: Law,
    target: ArrayLike,
    configurations: int,
    points: int,
    method: Method,
    cells: int = CELLS,
    time_limit: float | None = None,
    tolerance: float = TOLERANCE,
    relative_to: RelativeTo = "inside",
    sinks: Mapping[int, Arcs] | None = None,
    seed: int = 0,
) -> Job:
    """The job of a target; it has no bounds where the target is not ``reached``.

    Raises:
        InputError: Wrong shapes or options, or a procedure for a target with surfaces of stationary points.
        TaskError: An arm without redundancy for the task.
    """
    arm, task = law.arm, law.task
    if arm.n <= task.m:
        raise TaskError(
            f"'{arm.name}' has {arm.n} joints and the task '{task.name}' {task.m} rows: without redundancy no joint may lock; "
            "choose a task with fewer rows"
        )
    for what, number, least in (("configurations", configurations, 1), ("points", points, 0), ("cells", cells, 1)):
        if number < least:
            raise InputError(f"{what} is {number}; it must be {least} or more")
    if method not in ("brute", "procedure", "sampled"):
        raise InputError(f"method '{method}' is not known; use brute, procedure or sampled")
    if relative_to not in ("inside", "whole"):
        raise InputError(f"relative_to '{relative_to}' is not known; use inside or whole")
    if sinks is not None and method != "procedure":
        raise InputError(f"sinks belong to method='procedure'; '{method}' simulates every failure")
    limit = TIME_CONSTANTS / law.gain if time_limit is None else float(time_limit)
    targets = read_places(arm, task, target, np.random.default_rng(seed))
    if len(targets) != 1:
        raise InputError(f"there are {len(targets)} targets; a workspace is that of one, see target_measures for more")
    pose = targets.poses[0]
    bounds = tuple(tuple(arcs) for arcs in joint_bounds(arm.without_idle_limits, pose, task, seed=seed))
    arcs = None
    if method == "procedure" and any(bounds):
        arcs = _sinks(law, pose) if sinks is None else {k: list(sinks.get(k, ())) for k in range(arm.n)}
    return Job(law, pose, bounds, configurations, points, method, cells, limit, tolerance, relative_to, arcs, seed)


def _sinks(law: Law, pose: Array) -> dict[int, Arcs]:
    """Of each joint, the locked values with a sink, and those beside which motions may circle or creep."""
    found: dict[int, Arcs] = {}
    for j in range(law.arm.n):
        curves = stationary_points(law, pose, {j: None})
        if len(curves.loose):
            raise InputError(
                f"with {law.arm.joint_names[j]} locked the stationary points form surfaces, which were only sampled, so the "
                "procedure could miss sinks; use method='sampled' or 'brute'"
            )
        circling = [(x - CYCLES, x + CYCLES) for c in curves.curves for x in c.locked[c.hopf_points].tolist()]
        found[j] = [*curves.sink_arcs, *((x, x) for x in curves.degenerate_angles), *circling]
    return found
