"""The search: designs spread over the space, then climbs with exact gradients, then a check on fresh poses."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.arms.serial import to_dict
from holdfast.designs.choice import best_design
from holdfast.designs.designs import Check, Checked, Designs
from holdfast.designs.evaluation import Evaluated, Evaluator
from holdfast.designs.family import Family
from holdfast.designs.gradient import sensitivity
from holdfast.designs.quantile import guaranteed, shares
from holdfast.designs.reach import Reaches
from holdfast.designs.space import DesignSpace, Vary, design_space
from holdfast.engine.memory import Memory, Parts
from holdfast.errors import InputError
from holdfast.failures import FailureSpec
from holdfast.indices.own_file import plan_entries
from holdfast.notice import says
from holdfast.regions.region import Region, default_region

Array = NDArray[np.float64]
Progress = Callable[[int, int], None]

_FIRST = 64  # designs that grow from one another; all later ones begin from the nearest of these
_CHUNK = 128
_NEGLIGIBLE = 1e-7  # share of a pose in the smooth quantile below which its gradient is not asked for
_ITERATIONS = 30  # of a climb
_TRAIL = 12  # designs of a climb that the next ones may begin from
_CLIMB_FRESH = 2  # random starts of each pose in every step of a climb
_CLIMB_WORTH = 32  # designs that a climb counts as, for the progress


@checked
@says("searching designs")
def design(
    arm: Arm,
    vary: Vary,
    objective: str = "relative-manipulability",
    *,
    region: Region | None = None,
    task: str | Task | Sequence[str] = "pose",
    level: float = 0.95,
    failures: FailureSpec = "single",
    length: float | None = None,
    poses: int = 256,
    designs: int = 512,
    climbs: int = 8,
    fresh: int = 2000,
    seed: int = 0,
    store: str | Path | None = None,
    progress: Progress | None = None,
) -> Designs:
    """Search for the arm with the largest index quantile over a region after the worst failure.

    What a design is worth is the ``1 - level`` quantile, over the poses of the region, of the index at the best configuration
    of every pose (:func:`holdfast.optimise`); a pose that is not reached counts as 0. Designs spread over the bounds are
    compared first, all of them rows of the same kernels. From the best ones, and from those along the front against reach,
    sequential quadratic programs climb with exact gradients. Links may run through one another; that is not looked at.

    Args:
        arm: The given arm; its values must lie within the bounds.
        vary: What is open and its bounds: ``{"a3": (0.2, 0.6)}``, rad and m, or what
            :func:`holdfast.designs.design_space` reads.
        objective: An index by name, larger is better.
        region: The poses, the same for all designs. Default: that of the given arm, as for :func:`holdfast.assess`.
        task: Rows of the pose to keep.
        level: Share of the poses for which the value is guaranteed.
        failures: Which joints fail.
        length: Characteristic length of the task, m.
        poses: Poses on which designs are compared.
        designs: Designs spread over the bounds.
        climbs: Climbs; the first half for the greatest value, the others for a given reach each, along the front.
        fresh: Poses of the final check.
        seed: The same seed gives the same result, whatever the number of threads.
        store: Folder from which a stopped search resumes.
        progress: Called with (done, in all), in designs.

    Returns:
        A :class:`holdfast.Designs`.

    Raises:
        InputError: Options out of range, or bounds and names that do not fit the arm.
        TaskError: The index cannot be searched by, or the arm is not redundant for the task.
        StoreError: The folder holds something else.

    Source: Abdi et al. 2012, section IV, for the distribution; Harrell and Davis 1982 for the smooth quantile of the climbs.
    """
    begin = time.monotonic()
    if not 0 < level < 1:
        raise InputError(f"level is {level:g}; it must be between 0 and 1, for example 0.95")
    for what, count, least in (("poses", poses, 1), ("designs", designs, 1), ("climbs", climbs, 0), ("fresh", fresh, 1)):
        if count < least:
            raise InputError(f"{what} is {count}; it must be {least} or more")
    space = design_space(arm, vary)
    region = default_region(arm) if region is None else region
    family = Family(space, objective, task, failures=failures, length=length)
    search = _Search(family, region, level, poses, seed)
    plan = {
        "kind": "design",
        "arm": to_dict(arm),
        "vary": [p.written for p in space.parameters],
        **plan_entries(family.index),
        "task": [family.task.rows.tolist(), family.task.frame, family.task.length],
        "failures": [list(f) for f in family.index.failures],
        "region": region.to_dict(),
        "level": level,
        "poses": poses,
        "designs": designs,
        "climbs": climbs,
        "fresh": fresh,
        "seed": seed,
    }
    if store is not None and not region.storable:
        raise InputError(
            f"region '{region.name}' has a function of your own, which a folder cannot hold; search without a store"
        )
    memory = None if store is None else Memory(store, plan)

    def part(name: str, make: Callable[[], Parts]) -> Parts:
        return make() if memory is None else memory.part(name, make)

    total, done = designs + 1 + climbs * _CLIMB_WORTH, 0

    def advance(count: int) -> None:
        nonlocal done
        done += count
        if progress is not None:
            progress(done, total)

    values = np.concatenate([space.start[None], space.draw(designs, seed)])
    found = []
    for number, start in enumerate([0, *range(_FIRST, len(values), _CHUNK)]):
        chunk = values[start : _FIRST if start == 0 else start + _CHUNK]
        found.append(part(f"screen {number}", lambda c=chunk: search.screened(c)))  # type: ignore[misc]
        if start == 0:
            search.begin_near(values[:_FIRST])
        advance(len(chunk))
    table = {name: np.concatenate([f[name] for f in found]) for name in found[0]}
    ends = []
    for number, (begun, far) in enumerate(_beginnings(table["smooth"], table["reach"], values, space, climbs)):
        ends.append(part(f"climb {number + 1}", lambda b=begun, r=far: {"values": search.climb(values[b], r)})["values"])  # type: ignore[misc]
        advance(_CLIMB_WORTH)
    ended = np.array([space.start, *ends])
    deep = part("deep", lambda: search.deepened(ended))
    # The given arm takes the place it had, looked at as closely as the ends of the climbs.
    merged = {name: np.concatenate([deep[name][:1], table[name][1:], deep[name][1:]]) for name in table}
    every = np.concatenate([values, ended[1:]])
    best = best_design(merged["guaranteed"], merged["reach"])
    checks = part(f"check {best}", lambda: search.fresh(every[[0, best]], fresh))
    given, chosen = (
        Checked.of(checks["value"][i], checks["reached"][i], checks["weights"], level=level, heaviest=region.heaviest)
        for i in (0, 1)
    )
    return Designs(
        space=space,
        values=every,
        guaranteed=merged["guaranteed"],
        reach=merged["reach"],
        reached=merged["reached"],
        front=pareto(merged["reach"], merged["guaranteed"]),
        best=best,
        checked=Check(given, chosen, float(merged["guaranteed"][best] - chosen.guaranteed.value)),
        index=family.numeric_index,
        region=region,
        level=level,
        poses=poses,
        screened=designs,
        climbs=len(ends),
        seed=seed,
        seconds=time.monotonic() - begin,
        method=search.method(designs, len(ends), fresh),
    )


def pareto(reach: Array, value: Array) -> NDArray[np.intp]:
    """Numbers of the designs that no other beats in both, by reach from the shortest."""
    order = np.lexsort((-value, -reach))  # from the farthest reach; of equal reach the best value first
    front, top = [], -np.inf
    for i in order:
        if value[i] > top:
            front.append(int(i))
            top = value[i]
    return np.array(front[::-1], dtype=np.intp)


def region_poses(region: Region, count: int, seed: int) -> tuple[Array, Array | None]:
    """The poses (P, 4, 4) on which designs are compared, and their weights (P,), or None if all count alike.

    Low-discrepancy points where the region is a box, else random ones.

    Raises:
        InputError: A region of joints.
    """
    return drawn_poses(region, count, seed, "sobol" if region.kind == "box" else "random")


def drawn_poses(region: Region, count: int, seed: int, sampling: Any = "random") -> tuple[Array, Array | None]:
    """Poses (P, 4, 4) and their weights (P,), or None if all count alike."""
    if region.kind == "joints":
        raise InputError("a region of joints fixes the configurations, so designs have no poses to reach; give a box of poses")
    samples: list[Array] = []
    blocks = region.blocks(0, seed, sampling, count=count)
    while sum(len(s) for s in samples) < count:
        samples.append(next(blocks))
    s = np.concatenate(samples)[:count]
    return region.poses(s), region.weights(s) if region.weighted(count) else None


def _beginnings(smooth: Array, reach: Array, values: Array, space: DesignSpace, climbs: int) -> list[tuple[int, float]]:
    """Where to climb from and the least reach to keep: the best designs that are apart, then the best beyond each reach."""
    unit = (values - space.lower) / (space.upper - space.lower)
    order = np.argsort(-smooth, kind="stable")
    apart: list[int] = []
    for far in (0.5, 0.0):  # of a side of the unit cube, in the mean square
        for i in order:
            if len(apart) == -(-climbs // 2):
                break
            if i not in apart and all(np.sqrt(np.mean((unit[i] - unit[k]) ** 2)) >= far / 2 for k in apart):
                apart.append(int(i))
    found = [(i, -np.inf) for i in apart]
    more = climbs - len(found)
    if more > 0:
        low, high = float(reach[order[0]]), float(reach.max())
        for least in np.linspace(low, high, more + 2)[1:-1]:
            able = np.flatnonzero(reach >= least)
            found.append((int(able[np.argmax(smooth[able])]), float(least)))
    return found


class _Search:
    """Designs of a family at the poses of a region, and what they are worth."""

    def __init__(self, family: Family, region: Region, level: float, poses: int, seed: int) -> None:
        self.family, self.region, self.level, self.seed = family, region, level, seed
        drawn, self._weights = region_poses(region, poses, seed)
        self.evaluator = Evaluator(family, drawn, seed)
        self._reaches = Reaches(family, seed)
        self._begin: Array | None = None
        self._first: Evaluated | None = None

    def begin_near(self, values: Array) -> None:
        """Later designs begin from the configurations of these."""
        self._begin = values

    @property
    def _near(self) -> Evaluated | None:
        """The designs from which others begin; computed once more where a folder, which holds no configurations, went on."""
        if self._first is None and self._begin is not None:
            self._first = self.evaluator(self._begin)
        return None if self._begin is None else self._first

    def screened(self, values: Array) -> Parts:
        """What designs are worth."""
        found = self.evaluator(values, self._near)
        if self._begin is None:
            self._first = found
        return self._facts(found)

    def _facts(self, found: Evaluated) -> Parts:
        extended = found.extended
        weights = np.ones(extended.shape[1]) if self._weights is None else self._weights
        return {
            "smooth": (shares(extended, self.level, self._weights) * extended).sum(axis=1),
            "guaranteed": guaranteed(found.value, self.level, self._weights),
            "reached": found.reached @ weights / weights.sum(),
            "reach": self._reaches(found.values, self.evaluator.finite_limits(found.values))[0],
        }

    def climb(self, start: Array, least: float) -> Array:
        """From a design to the best one near it whose reach is at least so long, (k,)."""
        from scipy.optimize import minimize

        space = self.family.space
        width = space.upper - space.lower
        trail: list[Evaluated] = [self.evaluator(start[None], self._near)]
        seen: dict[bytes, tuple[float, Array, float, Array]] = {}
        tried: list[tuple[float, float, Array]] = []

        def look(u: Array) -> tuple[float, Array, float, Array]:
            """Smooth guaranteed value and reach with their gradients in the unit cube."""
            key = u.tobytes()
            if key not in seen:
                x = np.clip(space.lower + u * width, space.lower, space.upper)
                found = self.evaluator(x[None], Evaluated.joined(trail[:1] + trail[1:][-_TRAIL:]), _CLIMB_FRESH)
                trail.append(found)
                value, slope = self.smooth(found)
                reach, by_design = self._reaches(x[None], self.evaluator.finite_limits(x[None]))
                seen[key] = value, slope * width, float(reach[0]), by_design[0] * width
                tried.append((value, float(reach[0]), x))
            return seen[key]

        long_enough: Any = {"type": "ineq", "fun": lambda u: look(u)[2] - least, "jac": lambda u: look(u)[3]}
        minimize(  # type: ignore[call-overload]
            lambda u: -look(u)[0],
            np.clip((start - space.lower) / width, 0.0, 1.0),
            jac=lambda u: -look(u)[1],
            bounds=[(0.0, 1.0)] * len(width),
            constraints=[long_enough] if np.isfinite(least) else [],
            method="SLSQP",
            options={"maxiter": _ITERATIONS, "ftol": 1e-6},
        )
        kept = [(value, x) for value, reach, x in tried if reach >= least - 1e-6]
        return max(kept, key=lambda entry: entry[0])[1] if kept else start

    def smooth(self, found: Evaluated) -> tuple[float, Array]:
        """The smooth guaranteed value of one design, and its exact gradient (k,)."""
        extended = found.extended[0]
        share = shares(extended[None], self.level, self._weights)[0]
        rows = np.flatnonzero(share > _NEGLIGIBLE)
        slopes = sensitivity(self.evaluator, found, rows)
        extended[rows] = slopes.value
        share = shares(extended[None], self.level, self._weights)[0]
        return float(share @ extended), share[rows] @ slopes.gradient

    def deepened(self, values: Array) -> Parts:
        """What designs are worth, each searched from as many random starts as :func:`holdfast.optimise` takes."""
        near = self.evaluator(values, self._near)
        return self._facts(self.evaluator(values, near, self.evaluator.starts))

    def fresh(self, values: Array, count: int) -> Parts:
        """Designs on poses that played no part, from random starts alone: index (D, P), reached (D, P), weights (P,) if any."""
        seed = int(np.random.SeedSequence(self.seed, spawn_key=(6,)).generate_state(1)[0])
        poses, weights = drawn_poses(self.region, count, seed, "random")
        evaluator = Evaluator(self.family, poses, seed)
        found = Evaluated.joined([evaluator(v[None]) for v in values])
        return {
            "value": found.value,
            "reached": found.reached,
            "weights": np.empty(0) if weights is None else weights,
        }

    def method(self, designs: int, climbs: int, fresh: int) -> list[tuple[str, str]]:
        """How it was computed, for reports."""
        return [
            ("Designs", f"the given arm and {designs:,} scrambled Sobol points within the bounds, one compiled kernel for all"),
            (
                "Configurations",
                "the best found for each design and pose, from the configurations of the two nearest designs and a few random "
                "starts; those of the given arm and of the climbs' ends from many",
            ),
            (
                "Climbs",
                f"{climbs}: sequential quadratic programs (SLSQP) on the Harrell-Davis estimate of the quantile, with exact "
                "gradients; half of them for the greatest value, half for the greatest beyond a given reach",
            ),
            (
                "Poses that are not reached",
                "count as 0; in the climbs as less than 0, by 1 per metre and radian of the nearest miss",
            ),
            ("Check", f"{fresh:,} fresh random poses; interval of the quantile by order statistics"),
            ("Not looked at", "whether links run through one another, and what they weigh"),
        ]
