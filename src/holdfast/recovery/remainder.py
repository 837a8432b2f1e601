"""Which part of the workspace is left once joints are locked."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.clearance.clearance import Clearance
from holdfast.failures import Degraded
from holdfast.notice import Count
from holdfast.probability.intervals import Interval, Sums
from holdfast.recovery.rows import RowSolver
from holdfast.regions.region import Region
from holdfast.result import Result

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

STARTS = 48  # per target


@dataclass(frozen=True, kw_only=True)
class WhatIsLeft(Result):
    """The share of targets that are still reached with joints locked.

    A target counts as left if a configuration is found in ``starts`` random starts, so the share is a lower bound.

    Attributes:
        left: Share of the targets that the healthy arm reaches, with its exact 95 % interval; None if it reaches none.
        of_region: Share of all poses of the region that are left; None without a region.
        healthy_of_region: The same of the healthy arm; None without a region.
        region: What was sampled, for people.
        degraded: What is locked, or has lost a part of its range.
        rows: The rows of the target that count.
        position: (N, 3) of the targets, m, world.
        healthy: (N,) True where the healthy arm reaches them.
        locked: (N,) True where the degraded arm does.
        starts: Random starts per target.
    """

    left: Interval | None
    of_region: Interval | None
    healthy_of_region: Interval | None
    region: str
    degraded: Degraded
    rows: tuple[str, ...]
    position: Array
    healthy: Flags
    locked: Flags
    starts: int

    def describe(self) -> list[str]:
        """One sentence for people."""
        if self.left is None:
            return [
                f"No configuration of the healthy arm was found for any of the {len(self.healthy):,} targets ({self.region})"
            ]
        return [
            f"Of {int(self.healthy.sum()):,} targets that the healthy arm reaches ({self.region}; {len(self.rows)} rows: "
            f"{', '.join(self.rows)}) the failed arm still reaches {self.left} in {self.starts} starts each"
        ]


def what_is_left(
    solver: RowSolver,
    degraded: Degraded,
    clearance: Clearance | None,
    margin: float,
    region: Region | None,
    samples: int,
    seed: int,
) -> WhatIsLeft:
    """Sample targets and see which are still reached.

    Args:
        solver: Of the rows that count, within the limits in force.
        degraded: What is left of the arm.
        clearance: Whose room is kept at least at ``margin``, if given.
        margin: m.
        region: Of targets; without one they are the poses of random configurations of the healthy arm.
        samples: How many.
        seed: Of the run.
    """
    arm, free = degraded.arm, degraded.moves
    failed, solver = solver, solver.within(arm)
    at = np.where(free, 0.0, degraded.lo)
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(1,)))
    weights, heaviest = np.ones(samples), 0.0 if region is None else region.heaviest
    if region is None:
        poses = arm.forward_kinematics(_healthy(solver, clearance, margin, samples, rng))
        healthy, name = np.ones(len(poses), dtype=bool), "poses of random configurations"
        weights = weights[: len(poses)]
    else:
        drawn = _drawn(region, samples, seed)
        if region.kind == "joints":
            poses = arm.forward_kinematics(drawn)
        else:
            poses, weights = region.poses(drawn), region.weights(drawn)
        healthy = _reached(solver, poses, at, np.ones(arm.n, dtype=bool), clearance, margin, rng)
        name = region.name
    locked = healthy.copy()
    locked[healthy] = _reached(failed, poses[healthy], at, free, clearance, margin, rng)
    return WhatIsLeft(
        left=_share(weights[healthy], locked[healthy], heaviest) if healthy.any() else None,
        of_region=None if region is None else _share(weights, locked, heaviest),
        healthy_of_region=None if region is None else _share(weights, healthy, heaviest),
        region=name,
        degraded=degraded,
        rows=solver.rows.names,
        position=poses[:, :3, 3],
        healthy=healthy,
        locked=locked,
        starts=STARTS,
    )


def _share(weights: Array, hits: Flags, heaviest: float) -> Interval:
    if (weights == weights[0]).all():
        return Interval.of(int(hits.sum()), len(hits))
    sums = Sums(largest=heaviest)
    sums.add(weights)
    share = min(float(weights[hits].sum() / sums.weight), 1.0)
    return Interval.of_share(share, sums.effective)


def _healthy(solver: RowSolver, clearance: Clearance | None, margin: float, samples: int, rng: np.random.Generator) -> Array:
    """Configurations of the healthy arm, clear ones if that is asked; fewer than ``samples`` if hardly any is."""
    everything = np.ones(solver.arm.n, dtype=bool)
    found = np.zeros((0, solver.arm.n))
    for _ in range(20):
        q = solver.starts(samples, np.zeros(solver.arm.n), everything, rng)
        found = np.concatenate([found, q if clearance is None else q[clearance.room(q) >= margin]])
        if len(found) >= samples:
            break
    return found[:samples]


def _drawn(region: Region, samples: int, seed: int) -> Array:
    parts, count = [], 0
    for block in region.blocks(0, seed, count=samples):
        parts.append(block.copy())
        count += len(block)
        if count >= samples:
            break
    return np.concatenate(parts)[:samples]


def _reached(
    solver: RowSolver,
    poses: Array,
    at: Array,
    free: Flags,
    clearance: Clearance | None,
    margin: float,
    rng: np.random.Generator,
) -> Flags:
    """(N,) True where one of the starts leads to a configuration of the pose that keeps limits and clearance."""
    done = np.zeros(len(poses), dtype=bool)
    used, wave = 0, 2
    with Count("starts of each pose", STARTS, most=True) as tell:
        while used < STARTS and not done.all():
            left = np.flatnonzero(~done)
            many = np.repeat(left, wave)
            kept = np.ones((len(many), solver.rows.m))
            q = solver.run(solver.starts(len(many), at, free, rng), poses[many], kept, free)
            good = solver.meets(q, poses[many], kept, free)
            if clearance is not None:
                some = np.flatnonzero(good)
                good[some] = clearance.room(q[some]) >= margin
            done[many[good]] = True
            used += wave
            tell(wave)
            wave = min(2 * wave, STARTS - used)
    return done
