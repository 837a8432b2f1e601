"""Working ranges under which a box of targets stays reachable wherever one joint locks: a search by samples."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from time import perf_counter

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.configurations import finite_limits, made_finite
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task
from holdfast.arm.urdf import rpy_rotation
from holdfast.certificates.claims import TolerantClaim, narrowed, tolerant_claim
from holdfast.errors import InputError
from holdfast.failures.sets import FailureSpec, single_joints
from holdfast.notice import says
from holdfast.reach import samples
from holdfast.result import Result
from holdfast.solvers import joint_space
from holdfast.solvers.inverse_kinematics import solver
from holdfast.words import percent

Array = NDArray[np.float64]

_HALVINGS = 10  # of the distance between a value that passes and the next one of the grid, which fails
_CANDIDATES = 20  # combinations of intervals for which the healthy arm is tried
_NEARLY_ALL, _MORE_RESTARTS = 0.8, 400  # where so many are reached, the others are tried again from more starts
_ROUNDS = 4  # of ranges that a fresh sample may shorten


@dataclass(frozen=True, eq=False, kw_only=True)
class WorkingRanges(Result):
    """Working ranges for a failure-tolerant box, found by samples. Nothing is proved: :func:`holdfast.certify` does that.

    Attributes:
        claim: The claim that the box is failure-tolerant with these ranges.
        targets: Number of targets in the sample that judges the ranges; none of them was used to find the ranges.
        values: Number of values of each joint at which the joint is locked for each target.
        healthy: Number of these targets that the healthy arm reaches within the ranges.
        lost: (n,) number of these targets that are lost for at least one value at which the joint is locked.
        passed: Number of these targets that the healthy arm reaches and no lock loses.
        seconds: Duration of the search in seconds.
    """

    claim: TolerantClaim
    targets: int
    values: int
    healthy: int
    lost: NDArray[np.int64]
    passed: int
    seconds: float

    @property
    def ok(self) -> bool:
        """True if every target of the sample passes."""
        return self.passed == self.targets

    @property
    def ranges(self) -> Array:
        """(n, 2) rad and m, working ranges."""
        return self.claim.working_ranges

    @property
    def relative_widths(self) -> Array:
        """(n,) width of each range as a fraction of the width of the joint's limits, of which a full turn is enough."""
        return _relative(self.claim.arm, self.ranges)

    @property
    def limiting_joint(self) -> str:
        """Name of the joint whose locks lose most targets; if none is lost, of the joint with the smallest relative width."""
        locks, arm = list(self.claim.locks), self.claim.arm
        lost, width = self.lost[locks], self.relative_widths[locks]
        return arm.joint_names[locks[int(np.lexsort([width, -lost])[0])]]

    @property
    def options(self) -> list[str]:
        """``JOINT=LOW..HIGH`` in degrees or m of each range that is narrower than the limits, as ``--range`` takes it."""
        arm, written = self.claim.arm, []
        for k, joint in enumerate(arm.joints):
            if (self.ranges[k] != [joint.lower, joint.upper]).any():
                low, high = (f"{round(joint.shown[0] * x, 10) + 0.0:.12g}" for x in self.ranges[k])
                written.append(f"{joint.name}={low}..{high}")
        return written

    def describe(self) -> list[str]:
        """Return whether ranges were found, by which sample, and the limiting joint."""
        arm, k = self.claim.arm, self.claim.arm.joint_index(self.limiting_joint)
        factor, unit = arm.joints[k].shown
        span = f"{factor * self.ranges[k, 0]:.4g} to {factor * self.ranges[k, 1]:.4g} {unit}"
        if self.ok:
            return [
                f"Found working ranges: the healthy arm reaches all of {self.targets} sampled targets within them, and so does "
                f"the arm with one joint locked at any of {self.values} sampled values of its range. A sample proves nothing.",
                f"The limiting joint is {arm.joint_names[k]}: its range of {span} is "
                f"{percent(float(self.relative_widths[k]))} of its limits.",
            ]
        why = f"the healthy arm reaches {self.healthy} of them"
        if self.lost[k]:
            why += f", and locks of {arm.joint_names[k]}, whose range is {span}, lose {self.lost[k]}"
        return [
            f"Not found: with the best working ranges {self.passed} of {self.targets} sampled targets "
            f"({percent(self.passed / self.targets)}) are reached whatever locks; {why}."
        ]


@checked
@says("looking for working ranges")
def find_working_ranges(
    arm: Arm,
    centre: ArrayLike,
    size: ArrayLike,
    *,
    rotation: ArrayLike | None = None,
    rpy: ArrayLike | None = None,
    task: str | None = None,
    working_ranges: Mapping[str | int, tuple[float, float]] | None = None,
    failures: FailureSpec = "single",
    targets: int = 100,
    values: int = 48,
    margin: float = 0.05,
    seed: int = 0,
) -> WorkingRanges:
    """Find wide working ranges under which a box of targets stays reachable wherever one joint locks.

    After a lock the other joints use all of their limits, so the intervals at which one joint may lock do not depend on the
    ranges of the others. They are found on a grid of locked values, and their ends by bisection. Only the healthy arm, which
    keeps all of its ranges, couples the joints: of the combinations of intervals within which it reaches every target, the one
    with the largest smallest relative width is taken, then that with the largest sum of relative widths. If there is none,
    the ranges of most targets are looked for by coordinate ascent, as :func:`holdfast.tolerant_workspace` does.

    Args:
        arm: The arm.
        centre: As of :func:`holdfast.certificates.tolerant_claim`.
        size: Likewise.
        rotation: Likewise.
        rpy: Likewise.
        task: Likewise.
        working_ranges: ``{joint: (low, high)}``, rad or m, within which its range is looked for. Default: the joint's limits;
            a full turn, or 1 m to either side, where there are none.
        failures: Which joints may lock, one at a time. The others keep the ranges that are given.
        targets: Number of targets inside the box, besides its corners.
        values: Number of locked values of each joint; more for joints that turn by more than once.
        margin: Fraction of an interval that is cut off at each end at which some target is lost. There the arm with the locked
            joint is stretched or at a limit, so that little can be proved.
        seed: Seed of all random draws.

    Returns:
        Ranges whose ``claim`` :func:`holdfast.certify` proves.

    Raises:
        InputError: A box, joint, or range that makes no claim, or a number out of range.
        TaskError: No failure, or one of several joints at once.

    Source: Lewis and Maciejewski 1997 for the ranges (their artificial joint limits); the search is derived here.
    """
    began = perf_counter()
    if targets < 1 or values < 2 or not 0 <= margin < 0.5:
        raise InputError(
            f"targets is {targets}, values {values}, and margin {margin:g}; targets must be 1 or more, values 2 or more, and "
            "margin from 0 to below 0.5"
        )
    locks, bounds = single_joints(arm, failures), narrowed(arm, working_ranges or {})
    bounds[locks] = np.stack(made_finite(bounds[locks, 0], bounds[locks, 1], arm.prismatic[locks]), axis=1)
    narrow = {*locks, *map(arm.joint_index, working_ranges or {})}

    def claimed(ranges: Array) -> TolerantClaim:
        pairs: dict[str | int, tuple[float, float]] = {k: (float(ranges[k, 0]), float(ranges[k, 1])) for k in narrow}
        return tolerant_claim(arm, centre, size, rotation=rotation, rpy=rpy, task=task, working_ranges=pairs, failures=failures)

    search = _Search(claimed(bounds), bounds, targets, values, seed)
    ranges, found = search.widest(margin)
    for fresh in range(1, _ROUNDS + 1):
        healthy, survives = search.judged(ranges, fresh)
        if not found or fresh == _ROUNDS:
            break
        if not healthy.all():
            search.enlarge(fresh)
            ranges, found = search.widest(margin)
        elif not search.shortened(ranges, survives):
            break
    kept = np.stack([each.all(axis=1) for each, _ in survives], axis=1)
    return WorkingRanges(
        claim=claimed(ranges),
        targets=len(healthy),
        values=values,
        healthy=int(healthy.sum()),
        lost=(~kept).sum(axis=0),
        passed=int((healthy & kept.all(axis=1)).sum()),
        seconds=perf_counter() - began,
    )


class _Search:
    """Samples of the box of a claim, and the ranges that they allow.

    Args:
        claim: Claim with the widest ranges.
        bounds: (n, 2) these, rad and m.
        targets: Number of targets in each sample, besides the corners.
        values: Number of locked values of each joint.
        seed: Seed of all random draws.
    """

    def __init__(self, claim: TolerantClaim, bounds: Array, targets: int, values: int, seed: int) -> None:
        self._claim, self._arm, self._bounds, self._seed = claim, claim.arm, bounds, seed
        self._targets, self._values = targets, values
        self._task: Task = as_task(claim.arm, claim.task)
        self._poses = self._drawn(0)
        locks = np.isin(np.arange(claim.arm.n), claim.locks)
        width = bounds[:, 1] - bounds[:, 0]
        self._circle = locks & joint_space.turning(claim.arm) & (width >= 2 * np.pi - 1e-9)
        turns = np.where(claim.arm.prismatic | ~locks, 1, np.maximum(np.nan_to_num(width) / (2 * np.pi), 1))
        self._grids = [
            np.linspace(low, high, int(np.ceil(values * turn)) + wraps)[: int(np.ceil(values * turn))] if lock else np.empty(0)
            for (low, high), turn, wraps, lock in zip(bounds, turns, self._circle, locks, strict=True)
        ]

    def _drawn(self, sample: int) -> Array:
        """Poses (N, 4, 4) of the corners of the box, and of targets inside."""
        from scipy.stats import qmc

        box = self._claim.box
        axes = box[:, 0] < box[:, 1]
        corners = np.array(list(product(*([low, high] if low < high else [low] for low, high in box))))
        inside = np.tile(box[:, 0], (self._targets if axes.any() else 0, 1))
        if axes.any():
            halton = qmc.Halton(int(axes.sum()), rng=np.random.default_rng([self._seed, sample]))
            inside[:, axes] = qmc.scale(halton.random(len(inside)), *box[axes].T)
        rows = np.vstack([corners, inside])
        linear = 2 if self._claim.task.startswith("planar") else 3
        poses = np.tile(np.eye(4), (len(rows), 1, 1))
        poses[:, :linear, 3] = rows[:, :linear]
        if self._claim.rotation is not None:
            poses[:, :3, :3] = self._claim.rotation
        elif rows.shape[1] > linear:  # of a planar pose yaw alone
            angles = np.zeros((len(rows), 3))
            angles[:, linear - rows.shape[1] :] = rows[:, linear:]
            poses[:, :3, :3] = [rpy_rotation(row.tolist()) for row in angles]
        return poses

    def enlarge(self, sample: int) -> None:
        """Add a sample to that for which ranges are looked for."""
        self._poses = np.concatenate([self._poses, self._drawn(sample)])

    def _survival(self, values: list[Array], poses: Array, sample: int) -> list[NDArray[np.bool_]]:
        """For each joint (N, K) whether each pose is reached with the joint locked at each of its values (K,)."""
        table = samples.survival(self._arm, self._task, poses, values, self._seed + sample)
        for k, (each, column) in enumerate(zip(table, values, strict=True)):
            row, at = np.nonzero(~each & (each.mean(axis=0) >= _NEARLY_ALL))
            if len(row):
                locks, draws = np.full(len(row), k), np.random.SeedSequence([self._seed + sample, k, 1])
                engine = solver(self._arm, self._task)
                each[row, at] = engine.reaches_locked(poses[row], locks, column[at], draws, _MORE_RESTARTS, samples.TOLERANCE)
        return table

    def _healthy(self, ranges: Array, poses: Array) -> NDArray[np.bool_]:
        """(N,) whether the healthy arm reaches each pose within the ranges."""
        arm = samples.limited(self._arm, ranges)
        reached = samples.reached(arm, self._task, poses, self._seed)
        if _NEARLY_ALL <= reached.mean() < 1:
            draws = np.random.SeedSequence([self._seed, 1])
            again = solver(arm, self._task).solve(poses[~reached], draws, _MORE_RESTARTS, samples.TOLERANCE)
            reached[~reached] = again.success
        return reached

    def widest(self, margin: float) -> tuple[Array, bool]:
        """Return ranges (n, 2), and whether all targets pass."""
        table = self._survival(self._grids, self._poses, 0)
        intervals = [self._intervals(k, each) for k, each in enumerate(table)]
        arm = samples.limited(self._arm, self._bounds)
        q = samples.configurations(arm, self._task, self._poses, np.random.default_rng([self._seed, 99]))
        if all(map(len, intervals)):
            for chosen in self._combinations(intervals, q):
                for cut in (margin, margin / 4, 0.0):
                    ranges = np.array([self._trimmed(k, pair, cut) for k, pair in enumerate(chosen)])
                    if self._healthy(ranges, self._poses).all():
                        return ranges, True
        return self._most_held(table, q), False

    def _intervals(self, k: int, table: NDArray[np.bool_]) -> Array:
        """(C, 2) the widest intervals of a joint at whose values no target is lost; its bounds if it does not lock."""
        grid, good = self._grids[k], np.asarray(table.all(axis=0))
        if good.all():
            return np.asarray(self._bounds[k][None])
        if self._circle[k]:  # once round, from a value that fails to itself
            first = int(np.argmin(good))
            grid, good = np.append(grid[first:], grid[: first + 1] + 2 * np.pi), np.append(good[first:], good[: first + 1])
        if not good.any():
            best = int(np.argmax(table.mean(axis=0)))
            grid = np.linspace(grid[max(best - 1, 0)], grid[min(best + 1, len(grid) - 1)], self._values)
            good = self._survives(k, grid)
        runs = _runs(good)
        inner, outer = grid[runs], grid[np.clip(runs + np.array([-1, 1]), 0, len(grid) - 1)]
        for _ in range(_HALVINGS if len(runs) else 0):
            middle = (inner + outer) / 2
            passed = self._survives(k, middle.ravel()).reshape(-1, 2)
            inner, outer = np.where(passed, middle, inner), np.where(passed, outer, middle)
        return np.asarray(inner)

    def _survives(self, k: int, values: Array) -> NDArray[np.bool_]:
        """(K,) whether all targets survive a lock of a joint at each of some values (K,)."""
        each = [values if j == k else np.empty(0) for j in range(self._arm.n)]
        return np.asarray(self._survival(each, self._poses, 0)[k].all(axis=0), dtype=bool)

    def _combinations(self, intervals: list[Array], q: Array) -> list[list[Array]]:
        """One interval of each joint, for combinations within which configurations q (H, S, n) lie, the best first."""
        flat = q.reshape(-1, self._arm.n)
        which = np.full(flat.shape, -1)
        for k, pairs in enumerate(intervals):
            x = flat[:, k, None]
            if self._circle[k]:
                x = pairs[:, 0] + np.mod(x - pairs[:, 0], 2 * np.pi)
            inside = (x >= pairs[:, 0]) & (x <= pairs[:, 1])
            which[:, k] = np.where(inside.any(axis=1), inside.argmax(axis=1), -1)
        tuples = np.unique(which[(which >= 0).all(axis=1)], axis=0)
        chosen = [[intervals[k][c] for k, c in enumerate(row)] for row in tuples]
        widths = [np.sort(_relative(self._arm, np.array(pairs))[list(self._claim.locks)]) for pairs in chosen]
        order = sorted(range(len(chosen)), key=lambda i: (-widths[i][0], -widths[i].sum()))
        return [chosen[i] for i in order[:_CANDIDATES]]

    def _most_held(self, table: list[NDArray[np.bool_]], q: Array) -> Array:
        """Ranges (n, 2) that most targets pass, of which there are configurations q (H, S, n)."""
        choices = []
        for k, (grid, circle, survives) in enumerate(zip(self._grids, self._circle, table, strict=True)):
            low, high = self._bounds[k]
            if len(grid) and low < high:
                some = slice(None, None, -(-len(grid) // self._values))  # of several turns
                choices.append(samples.Choices.of(grid[some], bool(circle), survives[:, some], q[:, :, k]))
            else:
                inside = (q[None, :, :, k] >= low) & (q[None, :, :, k] <= high)
                choices.append(samples.Choices(self._bounds[k][None], np.array([survives.all(axis=1)]), inside))
        kept = np.all([(each.survives[..., None] & each.holds).any(axis=0) for each in choices], axis=0)
        begin = np.where(kept[..., None], q, np.nan) if kept.any() else q
        ranges = samples.most_held(choices, begin, np.random.default_rng([self._seed, 98]))
        return self._bounds if ranges is None else np.array([self._rounded(k, pair) for k, pair in enumerate(ranges)])

    def _trimmed(self, k: int, pair: Array, cut: float) -> Array:
        """An interval without a margin at the ends at which targets are lost."""
        whole = self._bounds[k]
        away = cut * (pair[1] - pair[0]) * np.array([1, -1])
        return self._rounded(k, np.where(pair == whole, pair, pair + away))

    def _rounded(self, k: int, pair: Array) -> Array:
        """An interval rounded inwards to what :attr:`WorkingRanges.options` prints; the limits of the arm are kept."""
        joint, (low, high) = self._arm.joints[k], self._bounds[k]
        digits, factor = 4 if joint.prismatic else 2, joint.shown[0]
        if (pair == [joint.lower, joint.upper]).all() or factor * (pair[1] - pair[0]) < 3 * 10**-digits:
            return pair
        unit = 1.0 if joint.prismatic else np.pi / 180  # as the command line reads degrees

        def end(x: float, inward: int) -> float:
            number = np.ceil(inward * x * factor * 10**digits - 1e-6)
            value = unit * float(f"{inward * number / 10**digits:.{digits}f}")
            beyond = not self._circle[k] and not low <= value <= high
            return unit * float(f"{inward * (number + 1) / 10**digits:.{digits}f}") if beyond else value

        return np.array([end(pair[0], 1), end(pair[1], -1)])

    def judged(self, ranges: Array, sample: int) -> tuple[NDArray[np.bool_], list[tuple[NDArray[np.bool_], Array]]]:
        """Return for a fresh sample (N,) targets within the ranges, and for each joint (N, K) those that survive its locks.

        The values (K,) at which a joint is locked are the ends of its range and one value in each of equal parts of it.
        """
        poses, rng = self._drawn(sample), np.random.default_rng([self._seed, sample, 1])
        parts = max(self._values - 2, 1)
        between = (np.arange(parts) + rng.random(parts)) / parts
        values = [
            low + (high - low) * np.concatenate([[0], between, [1]]) if k in self._claim.locks else np.empty(0)
            for k, (low, high) in enumerate(ranges)
        ]
        return self._healthy(ranges, poses), list(zip(self._survival(values, poses, sample), values, strict=True))

    def shortened(self, ranges: Array, survives: list[tuple[NDArray[np.bool_], Array]]) -> bool:
        """Shorten ranges in place to the longest run of values that lose no target; return whether any was shortened."""
        changed = False
        for k, (table, values) in enumerate(survives):
            good = np.asarray(table.all(axis=0))
            if good.all() or not good.any():
                continue
            runs = _runs(good)
            first, last = runs[int(np.argmax(values[runs[:, 1]] - values[runs[:, 0]]))]
            ranges[k], changed = self._rounded(k, values[[first, last]]), True
        return changed


def _runs(good: NDArray[np.bool_]) -> NDArray[np.int64]:
    """(R, 2) first and last index of each run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], good.astype(np.int64), [0]])))
    return np.asarray(edges.reshape(-1, 2) - [0, 1], dtype=np.int64)


def _relative(arm: Arm, ranges: Array) -> Array:
    low, high = finite_limits(arm)
    whole = np.where(arm.prismatic, high - low, np.minimum(high - low, 2 * np.pi))
    return np.minimum(ranges[:, 1] - ranges[:, 0], whole) / np.where(whole > 0, whole, 1.0) + (whole <= 0)
