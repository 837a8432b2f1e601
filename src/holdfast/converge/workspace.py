"""Over a workspace: from where does the hand still come to a target when a joint locks on the way and nobody knows?"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.configurations import without_idle_limits
from holdfast.control.law import Law
from holdfast.converge.arriving import arriving
from holdfast.converge.bounds import joint_bounds
from holdfast.converge.healthy_paths import healthy_paths
from holdfast.converge.measures import Arcs, Flags, Index, Measures, averaged, spaced, within
from holdfast.converge.starts import Places, configurations_at, read_places
from holdfast.converge.stationary import stationary
from holdfast.errors import InputError, TaskError
from holdfast.simulate import Outcome, Reason, simulate
from holdfast.study import Column, Store

Array = NDArray[np.float64]
Method = Literal["brute", "procedure"]
RelativeTo = Literal["inside", "whole"]
Progress = Callable[[int, int], None]

TIME_CONSTANTS = 2000.0  # 1/Ke
TOLERANCE = 1e-8
CYCLES = 0.02  # rad on either side of a Hopf point, where limit cycles were seen within 0.005
BESIDE = 1e-3  # rad: locked angles this near to a sink or a degenerate angle are simulated too
_CHUNK = 128  # starts analysed together and stored as one; no result depends on it
ENDS = ("converged", "stuck", "moving", "undecided", "arriving", "no_sink")  # the first four as Outcome has them
ARRIVING, NO_SINK = 4, 5
_ARRIVES = np.array([1.0, 0.0, 0.0, np.nan, 1.0, 1.0])


@dataclass(frozen=True, eq=False)
class Workspace:
    """Measures of the paper for P starts; the last column of each (P, n + 1) array is for an arbitrary joint.

    Attributes:
        law: The law of the controller.
        target: (4, 4) tool pose; only the rows of the task count.
        places: Where the hand starts, a :class:`holdfast.converge.Places`.
        bounds: Of each joint the arcs (lower, upper), rad, in which it may lock and the target stays in reach.
        method: ``brute`` or ``procedure``.
        relative_to: What ``finish`` is a share of: the part of a motion ``inside`` the bounds, or the ``whole``.
        configurations: (P,) starting configurations that were looked at; 0 where the place is out of reach.
        lost: (P,) of them, those whose healthy motion ran into a singular configuration; left out of everything.
        reach: R100, Ravg, Rsens: of the share of a motion from which the target stays in reach, percent.
        finish: F100, Favg, Fsens: of the share of it from which the failed arm arrives, percent; undecided runs left out.
        ends: (P, 6) how the failures ended: converged, stuck, moving, undecided; arriving, which is undecided at the time
            limit but next to a solution that attracts; and not simulated because the joint locked where there is no sink.
    """

    law: Law
    target: Array
    places: Places
    bounds: tuple[tuple[tuple[float, float], ...], ...]
    method: Method
    relative_to: RelativeTo
    configurations: NDArray[np.int64]
    lost: NDArray[np.int64]
    reach: Measures
    finish: Measures
    ends: NDArray[np.int64]

    @property
    def columns(self) -> tuple[str, ...]:
        """What the columns of the measures are: the joints by name, and ``any``, an arbitrary one."""
        return (*self.law.arm.joint_names, "any")

    @property
    def measures(self) -> dict[str, Array]:
        """R100, Ravg, Rsens, F100, Favg and Fsens by name, (P, n + 1) each, percent."""
        r, f = self.reach, self.finish
        return {"R100": r.full, "Ravg": r.average, "Rsens": r.spread, "F100": f.full, "Favg": f.average, "Fsens": f.spread}

    @property
    def simulated(self) -> int:
        """Failures that were simulated."""
        return int(self.ends[:, :NO_SINK].sum())

    @property
    def undecided(self) -> float:
        """Share of the simulated failures that were undecided at the time limit, arriving or not; NaN if there is none."""
        return float(self.ends[:, [Outcome.UNDECIDED, ARRIVING]].sum() / self.simulated) if self.simulated else float("nan")

    @property
    def saved(self) -> float:
        """Share of the failures that did not have to be simulated, because the joint locked where there is no sink."""
        every = int(self.ends.sum())
        return float(self.ends[:, NO_SINK].sum() / every) if every else float("nan")

    def means(self) -> dict[str, Array]:
        """Mean of every measure over the starts that have it, (n + 1,) each, percent."""
        return {name: _mean(values) for name, values in self.measures.items()}

    def describe(self) -> list[str]:
        """A few sentences for people."""
        reached = int((self.configurations > 0).sum())
        lines = [
            f"{self.law.describe()} on '{self.law.arm.name}': {reached} of {len(self.places)} starts in reach, "
            f"{int(self.configurations.sum())} configurations, {int(self.lost.sum())} lost at singular configurations"
        ]
        ends = dict(zip(ENDS, self.ends.sum(axis=0).tolist(), strict=True))
        if self.ends.sum():
            told = ", ".join(f"{ends[name]} {name}" for name in ENDS[:3])
            share = f" ({100 * self.undecided:.2f} %)" if self.simulated else ""
            lines.append(
                f"{self.simulated} failures simulated: {told}, {ends['undecided'] + ends['arriving']} undecided at the time "
                f"limit{share}, of which {ends['arriving']} next to a solution that attracts, counted as arriving"
            )
        if self.method == "procedure":
            lines.append(
                f"{ends['no_sink']} more were not simulated ({100 * self.saved:.2f} %): the joint locked where no sink is, "
                "which makes arrival very likely and does not prove it"
            )
        return lines


def workspace(
    law: Law,
    target: ArrayLike,
    starts: ArrayLike | str | int | Places = "grid",
    configurations: int = 36,
    points: int = 10,
    method: Method = "brute",
    cells: int = 100,
    time_limit: float | None = None,
    tolerance: float = TOLERANCE,
    relative_to: RelativeTo = "inside",
    sinks: Mapping[int, Arcs] | None = None,
    seed: int = 0,
    store: str | Path | None = None,
    progress: Progress | None = None,
) -> Workspace:
    """From where the hand still comes to a target when a joint locks on the way and the controller does not know.

    From every start the arm moves to the target from configurations equally far apart along its self-motion, in joint
    space; the way is cut into ``cells`` of equal length of the hand's path, looked at in their middle. A joint that locks
    where its value is in the range of the target's self-motion (:func:`holdfast.joint_bounds`) leaves the target in reach:
    R100 is the share of the configurations for which that holds on the whole way, Ravg the mean share of the way, Rsens its
    greatest minus its least value. At ``points`` of the part inside, for each joint, the failure is simulated
    (:func:`holdfast.simulate`): F100, Favg and Fsens are the same of the share of that part from which the failed arm
    arrives. *Any* joint: all joints must be inside, and the arm must arrive whichever fails.

    Near the very ends of a range the arm comes to the target ever more slowly. A failure that is undecided at the time limit
    counts as arriving if it stands next to a solution all of whose eigenvalues attract; else it is left out of F. Both are
    counted in ``ends``.

    Of the part inside for a joint, the piece that is inside for all joints is sampled with ``points`` points and the rest
    in proportion; both are weighted by their lengths.

    Args:
        law: The control law.
        target: (m,) position, or (4, 4) pose, as in :func:`holdfast.simulate`.
        starts: ``"grid:52"``, a lattice of 52 points along the edge of the square about the workspace (planar arms; 2032
            places, as in the paper); a number of random places; or (P, m) positions or (P, 4, 4) poses.
        configurations: On each curve of the self-motion of a start; of each start, with more than one degree of redundancy.
        points: Failures of each joint on each motion, at most; 0 leaves F out.
        method: ``brute`` simulates every failure; ``procedure`` only those that lock where there is a sink.
        cells: Of the way.
        time_limit: s; 2000/Ke if not given.
        tolerance: Of the simulation's steps, rad.
        relative_to: ``inside``: F of the part inside, as in the paper; configurations without any are left out. ``whole``:
            of the whole way.
        sinks: For the procedure, of joints (from 0), the arcs of locked values at which failures are simulated, rad. If not
            given: where :func:`holdfast.stationary` finds sinks and whole curves of rest points, and 0.02 rad on either side of
            Hopf points, beside which limit cycles live.
        seed: Of the search for configurations, and of random starts.
        store: A folder to keep the results in; a stopped analysis goes on there.
        progress: Called with (starts done, starts in all).

    Raises:
        InputError: Wrong shapes or options, or a target out of reach.
        TaskError: An arm without redundancy for the task.
        StoreError: A folder of another analysis, or one that cannot be written.

    Source: Goel, Maciejewski, Balakrishnan 2005, section on the analysis of a workspace. A way's length is that of the hand's
    path: the paper does not define it.
    """
    job = _job(law, target, configurations, points, method, cells, time_limit, tolerance, relative_to, sinks, seed)
    places = read_places(law.arm, law.task, starts, np.random.default_rng(seed))
    count = len(places)
    ranges = [(k, min(k + _CHUNK, count)) for k in range(0, count, _CHUNK)]
    folder = None
    if store is not None:
        folder = Store.create(store, job.plan(places), job.store_columns(), count, _CHUNK)
    chunks: list[dict[str, NDArray[Any]]] = []
    for k, (first, stop) in enumerate(ranges):
        if folder is not None and k in folder.done:
            rows = folder.read(k, job.names)
        else:
            rows = job.analyse(places.poses[first:stop])
            if folder is not None:
                with folder.writing():
                    folder.write(k, rows)
        chunks.append(rows)
        if progress is not None:
            progress(stop, count)
    found = {name: np.concatenate([rows[name] for rows in chunks]) for name in job.names}
    return Workspace(
        law=law,
        target=job.pose,
        places=places,
        bounds=job.bounds,
        method=job.method,
        relative_to=job.relative_to,
        configurations=found["configurations"],
        lost=found["lost"],
        reach=Measures(found["R100"], found["Ravg"], found["Rsens"]),
        finish=Measures(found["F100"], found["Favg"], found["Fsens"]),
        ends=found["ends"],
    )


def _job(
    law: Law,
    target: ArrayLike,
    configurations: int,
    points: int,
    method: Method,
    cells: int,
    time_limit: float | None,
    tolerance: float,
    relative_to: RelativeTo,
    sinks: Mapping[int, Arcs] | None,
    seed: int,
) -> _Job:
    arm, task = law.arm, law.task
    if arm.n <= task.m:
        raise TaskError(
            f"'{arm.name}' has {arm.n} joints and the task '{task.name}' {task.m} rows: without redundancy no joint may lock; "
            "choose a task with fewer rows"
        )
    for what, number, least in (("configurations", configurations, 1), ("points", points, 0), ("cells", cells, 1)):
        if number < least:
            raise InputError(f"{what} is {number}; it must be {least} or more")
    if method not in ("brute", "procedure"):
        raise InputError(f"method '{method}' is not known; use brute or procedure")
    if relative_to not in ("inside", "whole"):
        raise InputError(f"relative_to '{relative_to}' is not known; use inside or whole")
    if sinks is not None and method == "brute":
        raise InputError("sinks belong to method='procedure'; brute force simulates every failure")
    limit = TIME_CONSTANTS / law.gain if time_limit is None else float(time_limit)
    targets = read_places(arm, task, target, np.random.default_rng(seed))
    if len(targets) != 1:
        raise InputError(f"there are {len(targets)} targets; a workspace is that of one, see convergence_map for more")
    pose = targets.poses[0]
    bounds = tuple(tuple(arcs) for arcs in joint_bounds(without_idle_limits(arm), pose, task, seed))
    if not any(bounds):
        place = ", ".join(f"{x:g}" for x in pose[:3, 3])
        raise InputError(f"no configuration of '{arm.name}' was found at the target ({place}) m; choose one within its reach")
    arcs = None
    if method == "procedure":
        arcs = _sinks(law, pose) if sinks is None else {k: list(sinks.get(k, ())) for k in range(arm.n)}
    return _Job(law, pose, bounds, configurations, points, method, cells, limit, tolerance, relative_to, arcs, seed)


@dataclass(frozen=True, eq=False)
class _Job:
    """What is done with every start."""

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

    names = ("R100", "Ravg", "Rsens", "F100", "Favg", "Fsens", "configurations", "lost", "ends")

    def plan(self, places: Places) -> dict[str, Any]:
        """What defines the results, for a store."""
        return {
            "kind": "workspace",
            "arm": self.law.arm.fingerprint,
            "law": self.law.describe(),
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
        measures = [Column(name, "float64", joints, "percent", name) for name in self.names[:6]]
        return [
            *measures,
            Column("configurations", "int64", (), "1", "starting configurations"),
            Column("lost", "int64", (), "1", "of them, lost at singular configurations"),
            Column("ends", "int64", (("end", len(ENDS)),), "1", ", ".join(ENDS)),
        ]

    def analyse(self, poses: Array) -> dict[str, NDArray[Any]]:
        """All results of starts (P, 4, 4)."""
        arm, count = self.law.arm, len(poses)
        owner, q0 = configurations_at(arm, self.law.task, poses, self.configurations, self.seed)
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
        reach, finish = Measures.of(length, owner, count), Measures.of(share, owner, count)
        measures = (reach.full, reach.average, reach.spread, finish.full, finish.average, finish.spread)
        values: list[NDArray[Any]] = [*measures, tried, lost, ends]
        return dict(zip(self.names, values, strict=True))

    def _finishes(self, q: Array, inside: Flags, owner: Index, starts: int) -> tuple[Array, NDArray[np.int64]]:
        """Share (R, n + 1) of the part inside from which the failed arm arrives, and how failures ended (starts, 6)."""
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
        arrives = _ARRIVES[ended]
        parts = np.split(arrives, np.cumsum([len(g[0]) for g in groups])[:-1])
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
            slow = np.flatnonzero(runs.reason == Reason.SLOW)
            code[slow[arriving(self.law, runs.q_final[slow], self.pose, joint[wanted][slow])]] = ARRIVING
            ended[wanted] = code
        return ended


def _mean(values: Array) -> Array:
    known = ~np.isnan(values)
    count = known.sum(axis=0)
    return np.where(count > 0, np.where(known, values, 0.0).sum(axis=0) / np.maximum(count, 1), np.nan)


def _sinks(law: Law, pose: Array) -> dict[int, Arcs]:
    """Of each joint, the locked values with a sink, and those beside which motions may circle or creep."""
    found: dict[int, Arcs] = {}
    for j in range(law.arm.n):
        curves = stationary(law, pose, locked=j)
        circling = [(x - CYCLES, x + CYCLES) for c in curves.curves for x in c.locked[c.hopf_points].tolist()]
        found[j] = [*curves.sink_arcs, *((x, x) for x in curves.degenerate_angles), *circling]
    return found
