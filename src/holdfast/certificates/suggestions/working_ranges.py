"""Sampling search for working ranges within which a box of targets stays reachable after a lock of one joint."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import ArrayLike

from holdfast.certificates.claims import TolerantClaim, narrow_limits, tolerant_claim
from holdfast.certificates.suggestions.box_samples import sample_box_poses
from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.solvers.inverse_kinematics import solver
from holdfast.kinematics.workspace import samples
from holdfast.model.arm.configurations import replace_infinite_limits, sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task
from holdfast.model.failure_modes.sets import FailureSpec, single_joints

_BISECTION_STEPS = 10  # bisections between a grid value that passes and its neighbour that fails
_MAX_CANDIDATES = 20  # combinations of intervals for which the healthy arm is tested
_RETRY_FRACTION = 0.8  # if this fraction of the targets is reached, the others are tried again
_MORE_RESTARTS = 400
_MAX_SHORTENINGS = 4  # how often a held-out sample may shorten ranges


@dataclass(frozen=True, eq=False, kw_only=True)
class WorkingRanges(Result):
    """Working ranges for a failure-tolerant box that were found by sampling; :func:`holdfast.certify` can prove them.

    Attributes:
        claim: The claim that the box is failure-tolerant with these ranges.
        targets: Number of targets in the held-out sample, none of which was used to find the ranges.
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
    lost: IndexArray
    passed: int
    seconds: float

    @property
    def ok(self) -> bool:
        """True if every target of the sample passes."""
        return self.passed == self.targets

    @property
    def ranges(self) -> FloatArray:
        """Working ranges (n, 2), rad and m."""
        return self.claim.working_ranges

    @property
    def relative_widths(self) -> FloatArray:
        """Width of each range (n,) as a fraction of the width of the joint's limits, or of a full turn if that is smaller."""
        return _relative_widths(self.claim.arm, self.ranges)

    @property
    def limiting_joint(self) -> str:
        """Name of the joint whose locks lose most targets, or of the joint with the smallest relative width if none is lost."""
        locks, arm = list(self.claim.locks), self.claim.arm
        lost_counts, widths = self.lost[locks], self.relative_widths[locks]
        return arm.joint_names[locks[int(np.lexsort([widths, -lost_counts])[0])]]

    @property
    def options(self) -> list[str]:
        """Option ``JOINT=LOW..HIGH`` for ``--range``, in degrees or m, for each range that is narrower than the limits."""
        arm, options = self.claim.arm, []
        for index, joint in enumerate(arm.joints):
            if (self.ranges[index] != [joint.lower, joint.upper]).any():
                lower, upper = (f"{round(joint.display_unit[0] * limit, 10) + 0.0:.12g}" for limit in self.ranges[index])
                options.append(f"{joint.name}={lower}..{upper}")
        return options


@check_arguments
@reports_progress("searching for working ranges")
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
    """Find wide working ranges within which a box of targets stays reachable for every value at which one joint locks.

    After a lock the other joints use their full limits, so the intervals in which one joint may lock do not depend on the
    ranges of the others. These intervals are found on a grid of locked values, and their ends by bisection. Only the healthy
    arm, which stays within all of its ranges, couples the joints. Among the combinations of intervals within which it reaches
    every target, the search chooses the one with the largest minimum of the relative widths, then the one with the largest sum.
    If there is none, it maximises the number of targets by coordinate ascent, as :func:`holdfast.tolerant_workspace` does.

    Args:
        arm: The arm.
        centre: (3,) centre of the box of targets in the base frame, m; (2,) for an arm that moves in a plane.
        size: Edge lengths of the box, m: one number, or one for each axis. A length may be 0.
        rotation: (3, 3) rotation of the tool in the base frame at every target. None: the orientation is free.
        rpy: (3, 2) lowest and highest roll, pitch and yaw, rad, or (2,) yaw, as in :func:`holdfast.certificates.reach_claim`.
        task: ``pointing`` if only the direction of the tool's z axis matters. Default: the task that the others imply.
        working_ranges: Ranges in which to search, as ``{joint: (low, high)}``, rad or m. Default: the joint's limits, or a full
            turn, or 1 m to either side, if there are none.
        failures: Joints that may lock, one at a time: ``"single"``, or a list of joints by name or index from 0. The other
            joints keep their given ranges.
        targets: Number of targets inside the box, in addition to its corners.
        values: Number of locked values of each joint; more are used for joints with more than one turn.
        margin: Fraction of an interval that is removed at each end at which some target is lost. Near this end the arm is
            stretched or at a limit, so that little can be proved.
        seed: Seed of all random samples.

    Returns:
        The working ranges, with a ``claim`` for :func:`holdfast.certify`.

    Raises:
        InputError: The box, a joint, or a range is invalid, or a number is out of range.
        TaskError: There is no failure, or a failure of several joints at once.

    Source: Lewis and Maciejewski 1997 for the ranges (their artificial joint limits); the search is derived here.
    """
    start_time = perf_counter()
    if targets < 1 or values < 2 or not 0 <= margin < 0.5:
        raise InputError(
            f"targets is {targets}, values {values}, and margin {margin:g}; targets must be 1 or more, values 2 or more, and "
            "margin from 0 to below 0.5"
        )
    locks, bounds = single_joints(arm, failures), narrow_limits(arm, working_ranges or {})
    bounds[locks] = np.stack(replace_infinite_limits(bounds[locks, 0], bounds[locks, 1], arm.prismatic[locks]), axis=1)
    narrowed_joints = {*locks, *map(arm.joint_index, working_ranges or {})}

    def make_claim(ranges: FloatArray) -> TolerantClaim:
        pairs = dict[str | int, tuple[float, float]]({joint: tuple(ranges[joint].tolist()) for joint in narrowed_joints})
        return tolerant_claim(arm, centre, size, rotation=rotation, rpy=rpy, task=task, working_ranges=pairs, failures=failures)

    search = _RangeSearch(make_claim(bounds), bounds, targets, values, seed)
    ranges, all_pass = search.find_widest(margin)
    for sample in range(1, _MAX_SHORTENINGS + 1):
        healthy, survives = search.evaluate_ranges(ranges, sample)
        if not all_pass or sample == _MAX_SHORTENINGS:
            break
        if not healthy.all():
            search.add_sample(sample)
            ranges, all_pass = search.find_widest(margin)
        elif not search.shorten_ranges(ranges, survives):
            break
    retained = np.stack([table.all(axis=1) for table, _ in survives], axis=1)
    return WorkingRanges(
        claim=make_claim(ranges), targets=len(healthy), values=values, healthy=int(healthy.sum()),
        lost=(~retained).sum(axis=0), passed=int((healthy & retained.all(axis=1)).sum()), seconds=perf_counter() - start_time,
    )  # fmt: skip


class _RangeSearch:
    """Search for the ranges that samples of the box of a claim allow.

    Args:
        claim: Claim with the widest ranges.
        bounds: (n, 2) widest ranges, rad and m.
        targets: Number of targets in each sample, in addition to the corners.
        values: Number of locked values of each joint.
        seed: Seed of all random samples.
    """

    def __init__(self, claim: TolerantClaim, bounds: FloatArray, targets: int, values: int, seed: int) -> None:
        self._claim, self._arm, self._bounds, self._seed = claim, claim.arm, bounds, seed
        self._targets, self._values = targets, values
        self._task: Task = as_task(claim.arm, claim.task)
        self._poses = sample_box_poses(self._claim, self._targets, self._seed, 0)
        locks = np.isin(np.arange(claim.arm.n), claim.locks)
        width = bounds[:, 1] - bounds[:, 0]
        self._is_periodic = locks & joint_space.is_unlimited(claim.arm) & (width >= 2 * np.pi - 1e-9)
        turns = np.where(claim.arm.prismatic | ~locks, 1, np.maximum(np.nan_to_num(width) / (2 * np.pi), 1))
        counts = np.where(locks, np.ceil(values * turns), 0).astype(int).tolist()
        self._grids = [
            np.linspace(lower, upper, count + is_periodic)[:count] if count else np.empty(0)
            for (lower, upper), count, is_periodic in zip(bounds, counts, self._is_periodic, strict=True)
        ]

    def add_sample(self, sample: int) -> None:
        """Add a sample to the poses for which ranges are searched."""
        self._poses = np.concatenate([self._poses, sample_box_poses(self._claim, self._targets, self._seed, sample)])

    def _check_survival(self, values: list[FloatArray], poses: FloatArray, sample: int) -> list[BoolArray]:
        """Return an array (N, K) for each joint, True if a pose is reached with the joint locked at one of its values (K,)."""
        table = samples.check_survival(self._arm, self._task, poses, values, self._seed + sample)
        for joint, (each, column) in enumerate(zip(table, values, strict=True)):
            lost_pose, lost_value = np.nonzero(~each & (each.mean(axis=0) >= _RETRY_FRACTION))
            if len(lost_pose):
                locks, random_seed = np.full(len(lost_pose), joint), np.random.SeedSequence([self._seed + sample, joint, 1])
                engine = solver(self._arm, self._task)
                each[lost_pose, lost_value] = engine.is_reachable_with_lock(
                    poses[lost_pose], locks, column[lost_value], random_seed, _MORE_RESTARTS, samples.TARGET_TOLERANCE
                )
        return table

    def _check_healthy(self, ranges: FloatArray, poses: FloatArray) -> BoolArray:
        """Return a mask (N,) of the poses that the healthy arm reaches within the ranges."""
        limited_arm = samples.with_artificial_limits(self._arm, ranges)
        reached = samples.find_reached_poses(limited_arm, self._task, poses, self._seed)
        if _RETRY_FRACTION <= reached.mean() < 1:
            random_seed = np.random.SeedSequence([self._seed, 1])
            engine = solver(limited_arm, self._task)
            retried = engine.solve(poses[~reached], random_seed, _MORE_RESTARTS, samples.TARGET_TOLERANCE)
            reached[~reached] = retried.success
        return reached

    def find_widest(self, margin: float) -> tuple[FloatArray, bool]:
        """Return ranges (n, 2), and whether all targets pass."""
        table = self._check_survival(self._grids, self._poses, 0)
        intervals = [self._find_intervals(index, each) for index, each in enumerate(table)]
        limited_arm = samples.with_artificial_limits(self._arm, self._bounds)
        q = samples.find_solutions_per_pose(limited_arm, self._task, self._poses, np.random.default_rng([self._seed, 99]))
        if all(map(len, intervals)):
            for chosen in self._combine_intervals(intervals, q):
                for trimmed_fraction in (margin, margin / 4, 0.0):
                    ranges = np.array([self._trim_interval(index, pair, trimmed_fraction) for index, pair in enumerate(chosen)])
                    if self._check_healthy(ranges, self._poses).all():
                        return ranges, True
        return self._choose_ranges(table, q), False

    def _find_intervals(self, joint: int, table: BoolArray) -> FloatArray:
        """Find the widest intervals (C, 2) of a joint in which no target is lost; its bounds if it does not lock."""
        grid, survives = self._grids[joint], np.asarray(table.all(axis=0))
        if survives.all():
            return np.asarray(self._bounds[joint][None])
        if self._is_periodic[joint]:  # one turn, from a value that fails back to itself
            first = int(np.argmin(survives))
            grid = np.append(grid[first:], grid[: first + 1] + 2 * np.pi)
            survives = np.append(survives[first:], survives[: first + 1])
        if not survives.any():
            best = int(np.argmax(table.mean(axis=0)))
            grid = np.linspace(grid[max(best - 1, 0)], grid[min(best + 1, len(grid) - 1)], self._values)
            survives = self._check_values(joint, grid)
        runs = _find_runs(survives)
        inner, outer = grid[runs], grid[np.clip(runs + np.array([-1, 1]), 0, len(grid) - 1)]
        for _ in range(_BISECTION_STEPS if len(runs) else 0):
            middle = (inner + outer) / 2
            passed = self._check_values(joint, middle.ravel()).reshape(-1, 2)
            inner, outer = np.where(passed, middle, inner), np.where(passed, outer, middle)
        return np.asarray(inner)

    def _check_values(self, joint: int, values: FloatArray) -> BoolArray:
        """Return a mask of the values (K,) of a locked joint at which no target is lost."""
        value_lists = [values if other == joint else np.empty(0) for other in range(self._arm.n)]
        return np.asarray(self._check_survival(value_lists, self._poses, 0)[joint].all(axis=0), dtype=bool)

    def _combine_intervals(self, intervals: list[FloatArray], q: FloatArray) -> list[list[FloatArray]]:
        """Choose one interval of each joint, for combinations in which configurations q (H, S, n) lie, the best first."""
        configurations = q.reshape(-1, self._arm.n)
        interval_index = np.full(configurations.shape, -1)
        for index, pairs in enumerate(intervals):
            values = configurations[:, index, None]
            if self._is_periodic[index]:
                values = pairs[:, 0] + np.mod(values - pairs[:, 0], 2 * np.pi)
            inside = (values >= pairs[:, 0]) & (values <= pairs[:, 1])
            interval_index[:, index] = np.where(inside.any(axis=1), inside.argmax(axis=1), -1)
        tuples = np.unique(interval_index[(interval_index >= 0).all(axis=1)], axis=0)
        chosen = [[intervals[index][interval] for index, interval in enumerate(row)] for row in tuples]
        widths = [np.sort(_relative_widths(self._arm, np.array(pairs))[list(self._claim.locks)]) for pairs in chosen]
        order = sorted(range(len(chosen)), key=lambda rank: (-widths[rank][0], -widths[rank].sum()))
        return [chosen[rank] for rank in order[:_MAX_CANDIDATES]]

    def _choose_ranges(self, table: list[BoolArray], q: FloatArray) -> FloatArray:
        """Choose ranges (n, 2) that most targets with configurations q (H, S, n) pass."""
        choices = []
        for joint, (grid, is_periodic, survives) in enumerate(zip(self._grids, self._is_periodic, table, strict=True)):
            lower, upper = self._bounds[joint]
            if len(grid) and lower < upper:
                thinned = slice(None, None, -(-len(grid) // self._values))  # of several turns
                tables = survives[:, thinned], q[:, :, joint]
                choices.append(samples.LimitChoices.from_table(grid[thinned], bool(is_periodic), *tables))
            else:
                inside = (q[None, :, :, joint] >= lower) & (q[None, :, :, joint] <= upper)
                choices.append(samples.LimitChoices(self._bounds[joint][None], np.array([survives.all(axis=1)]), inside))
        contained = np.all([(choice.survives[..., None] & choice.holds).any(axis=0) for choice in choices], axis=0)
        start_q = np.where(contained[..., None], q, np.nan) if contained.any() else q
        ranges = samples.choose_limits(choices, start_q, np.random.default_rng([self._seed, 98]))
        if ranges is None:
            return self._bounds
        return np.array([self._round_interval(joint, pair) for joint, pair in enumerate(ranges)])

    def _trim_interval(self, joint: int, pair: FloatArray, fraction: float) -> FloatArray:
        """Trim an interval by a margin at the ends at which targets are lost."""
        bounds = self._bounds[joint]
        shift = fraction * (pair[1] - pair[0]) * np.array([1, -1])
        return self._round_interval(joint, np.where(pair == bounds, pair, pair + shift))

    def _round_interval(self, index: int, pair: FloatArray) -> FloatArray:
        """Round an interval inwards to the digits of :attr:`WorkingRanges.options`; limits of the arm are not rounded."""
        joint, (lower, upper) = self._arm.joints[index], self._bounds[index]
        digits, factor = 4 if joint.prismatic else 2, joint.display_unit[0]
        if (pair == [joint.lower, joint.upper]).all() or factor * (pair[1] - pair[0]) < 3 * 10**-digits:
            return pair
        unit = 1.0 if joint.prismatic else np.pi / 180  # as the command line reads degrees

        def round_end(bound: float, inward: int) -> float:
            scaled = np.ceil(inward * bound * factor * 10**digits - 1e-6)
            value = unit * float(f"{inward * scaled / 10**digits:.{digits}f}")
            beyond = not self._is_periodic[index] and not lower <= value <= upper
            return unit * float(f"{inward * (scaled + 1) / 10**digits:.{digits}f}") if beyond else value

        return np.array([round_end(pair[0], 1), round_end(pair[1], -1)])

    def evaluate_ranges(self, ranges: FloatArray, sample: int) -> tuple[BoolArray, list[tuple[BoolArray, FloatArray]]]:
        """Return flags (N,) of held-out targets reached within the ranges, and for each joint flags (N, K) after its locks.

        A joint is locked at K values: the ends of its range, and one value in each of equal parts of it.
        """
        poses = sample_box_poses(self._claim, self._targets, self._seed, sample)
        parts, generator = max(self._values - 2, 1), np.random.default_rng([self._seed, sample, 1])
        between = (np.arange(parts) + generator.random(parts)) / parts
        values = [
            lower + (upper - lower) * np.concatenate([[0], between, [1]]) if joint in self._claim.locks else np.empty(0)
            for joint, (lower, upper) in enumerate(ranges)
        ]
        return self._check_healthy(ranges, poses), list(zip(self._check_survival(values, poses, sample), values, strict=True))

    def shorten_ranges(self, ranges: FloatArray, survives: list[tuple[BoolArray, FloatArray]]) -> bool:
        """Shorten ranges in place to the longest run of values that lose no target; return whether any was shortened."""
        changed = False
        for joint, (table, values) in enumerate(survives):
            survives_lock = np.asarray(table.all(axis=0))
            if survives_lock.all() or not survives_lock.any():
                continue
            runs = _find_runs(survives_lock)
            first, last = runs[int(np.argmax(values[runs[:, 1]] - values[runs[:, 0]]))]
            ranges[joint], changed = self._round_interval(joint, values[[first, last]]), True
        return changed


def _find_runs(flags: BoolArray) -> IndexArray:
    """Return the first and last index (R, 2) of each run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], flags.astype(np.int64), [0]])))
    return np.asarray(edges.reshape(-1, 2) - [0, 1], dtype=np.int64)


def _relative_widths(arm: Arm, ranges: FloatArray) -> FloatArray:
    lower, upper = sampling_limits(arm)
    limit_widths = np.where(arm.prismatic, upper - lower, np.minimum(upper - lower, 2 * np.pi))
    has_width = limit_widths > 0
    return np.minimum(ranges[:, 1] - ranges[:, 0], limit_widths) / np.where(has_width, limit_widths, 1.0) + ~has_width
