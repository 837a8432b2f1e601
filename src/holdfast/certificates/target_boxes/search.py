"""Search for the provable part of a box of targets and locked angles: cells are bisected until one configuration
proves each.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from heapq import heappop, heappush
from time import monotonic
from typing import Any

import numpy as np

from holdfast.certificates.target_boxes.pool import ConfigurationPool, step_self_motion
from holdfast.certificates.taylor import CENTER_UNIT, ReachSolver, TaylorForm
from holdfast.certificates.tree import PROVED_TOKEN, BisectionTree, CellBatch, SearchState
from holdfast.core.typing import BoolArray, FloatArray, IndexArray

_POOL_TRIALS = 3, 6  # configurations of the pool that are tried for a cell, and for a smallest cell
_SELF_MOTION_TRIALS = 4  # configurations along self-motions that are tried
_BATCH_CELLS = 4096
_ORIENTATION_SLACK_RAD = 1e-3  # rad: a smaller orientation error can still be corrected
_HOPELESS_FRACTION = 0.35  # proved fraction of a cell below which other configurations are tried
_RECENTER_FRACTION = 14 / 16  # proved fraction of a cell above which the configuration is moved to prove the whole cell
_PROMISING_FRACTION = 0.5  # proved fraction of a cell above which others on the self-motion are tried
_MIN_FRACTION = 1 / 32  # fraction that stands for none in the priority of a cell

_SMALL_CELL_FRACTION = 0.75  # fraction of all halvings from which a cell is small
_DEPTH_BONUS = 0.25  # priority of a smaller cell, in halvings
_MAX_RETRY_FRACTION = 0.01  # fraction of the root up to which abandoned cells are examined again at the end
_FIRST_RETRY_CELLS = 16  # abandoned cells in the first such attempt


class TargetBoxSearch:
    """Search over one root box, which can be resumed any number of times.

    Args:
        reach: Solver for configurations at targets.
        root: (A, 2) range of targets along each axis, m, then of the locked value, rad.
        halvings: Largest number of bisections of each axis: one number, or (A,).
        seed: Seed of all random samples.
        deadline: Monotonic time at which the pool must be complete, s.

    Attributes:
        tree: Bisection tree with the result.
        pool: Pool of configurations from which the search began.
        nodes: Number of examined cells.
        open_fraction, proved_fraction: Fractions of the root that are not examined yet, and proved.
        split_axes, refusal: Those of :class:`holdfast.certificates.target_boxes.jobs.TargetBoxResult`.
        is_settled: True if this job does not search.
        warning: Warning on targets without a configuration.
    """

    def __init__(
        self, reach: ReachSolver, root: FloatArray, halvings: int | IndexArray, seed: int | list[int], deadline: float = np.inf
    ) -> None:
        self.reach, self.root, self.halvings = reach, root, np.broadcast_to(halvings, len(root))
        self.rng, self.tree, self.nodes = np.random.default_rng(seed), BisectionTree(), 0
        self.split_axes, self.refusal, self.warning, self.is_settled = tuple[int, ...](), "", "", False
        self._centers = dict[int, IndexArray]()  # center of each proved node, in units of 2^-24 rad
        self.width = root[:, 1] - root[:, 0]
        self.pool = ConfigurationPool(reach, root, self.rng, deadline)
        self.open_fraction = self.proved_fraction = 0.0
        self._open_cells: list[tuple[float, int, IndexArray, IndexArray, FloatArray, int]] = []
        self._abandoned_cells: list[CellBatch] = []
        self._retry_goal: float | None = None  # fraction of the root that must be proved by the end of a retry
        start = self.pool.q[:1] if len(self.pool.q) else np.clip(np.zeros((1, reach.n)), *reach.limits.T)
        root_index = np.zeros((1, len(root)), dtype=np.int64)
        zeros = np.zeros(1, dtype=np.int64)
        self._enqueue_cells(CellBatch(root_index, root_index, zeros, start, zeros), np.ones(1))

    @property
    def state(self) -> SearchState:
        """Progress, as fractions of the root."""
        open_fraction = min(max(self.open_fraction, 0.0), 1.0)
        remainder = max(1 - open_fraction - self.proved_fraction, 0.0)
        return SearchState(
            proved=self.proved_fraction, undecided=remainder, open=open_fraction, nodes=self.nodes, warning=self.warning
        )

    @property
    def centers(self) -> IndexArray:
        """Centers (leaves, n) of the proved nodes, in pre-order."""
        nodes = [node for node in self.tree.preorder_nodes() if self.tree.tokens[node] == PROVED_TOKEN]
        return np.array([self._centers[node] for node in nodes], dtype=np.int64).reshape(-1, self.reach.n)

    def run(
        self,
        deadline: float = np.inf,
        should_stop: Callable[[], bool] = lambda: False,
        report_progress: Callable[[], None] = lambda: None,
    ) -> bool:
        """Search down to the smallest cells, the most promising first, until a monotonic time or a stop request.

        Args:
            deadline: Monotonic time, s.
            should_stop: Function that is called before each batch of cells.
            report_progress: Function that is called after each batch of cells.

        Returns:
            True if the search is complete.
        """
        if self.pool.pending_rounds:
            self.pool.sample_pending_targets((monotonic() + deadline) / 2)
        while (
            (self._open_cells or (self._abandoned_cells and self._retry_abandoned(deadline)))
            and monotonic() < deadline
            and not should_stop()
        ):
            batch = [heappop(self._open_cells) for _ in range(min(_BATCH_CELLS, len(self._open_cells)))]
            _, node_ids, *columns, barren = map(np.array, zip(*batch, strict=True))
            self._process_cells(CellBatch(columns[0], columns[1], node_ids, columns[2], barren))
            report_progress()
        return not self._open_cells

    def _retry_abandoned(self, deadline: float) -> bool:
        """Examine abandoned cells again, first a few and then all, as long as more than half of them is proved.

        Return True if any remain to be examined. Either they cannot be proved, or the configurations near them were bad, so
        configurations are sampled for these cells alone.
        """
        cells = self.tree.merge_undecided_siblings(CellBatch.concatenate(self._abandoned_cells))
        order = self.rng.permutation(len(cells.name))
        retry_count = _FIRST_RETRY_CELLS if self._retry_goal is None else len(cells.name)
        if cells.root_fraction > _MAX_RETRY_FRACTION if self._retry_goal is None else self.proved_fraction <= self._retry_goal:
            self._abandoned_cells = [cells]
            return False
        self._abandoned_cells = [cells.select(order[retry_count:])] if retry_count < len(order) else []
        cells = cells.select(order[:retry_count])
        self._retry_goal = self.proved_fraction + cells.root_fraction / 2
        width = self.width * 0.5**cells.depth
        self.pool.sample_in_cells(self.root[:, 0] + width * cells.place, width, deadline)
        cells.barren[:] = 0
        self._enqueue_cells(cells, np.ones(len(cells.name)))
        return True

    def _enqueue_cells(self, cells: CellBatch, proved_fractions: FloatArray) -> None:
        """Queue cells with the fractions (N,), by width, of the enclosing cells that one configuration proved.

        A cell needs as many configurations as such parts fill it. A configuration proves about the same part in cells of all
        sizes, so smaller cells, which are closer to being proved, have a slightly higher priority.
        """
        self.open_fraction += cells.root_fraction
        axis_count, halvings = int((self.width > 0).sum()), cells.depth.sum(axis=1)
        priority = (_DEPTH_BONUS - 1) * halvings + axis_count * np.log2(np.maximum(proved_fractions, _MIN_FRACTION))
        sort_keys = (-priority).tolist(), cells.name.tolist()
        for entry in zip(*sort_keys, cells.place, cells.depth, cells.q, cells.barren.tolist(), strict=True):
            heappush(self._open_cells, entry)

    # ---- a batch of cells --------------------------------------------------------------------------------------

    def _process_cells(self, cells: CellBatch) -> None:
        """Examine a batch of cells: proved cells become leaves, the others are halved and queued."""
        self.nodes += len(cells.name)
        self.open_fraction -= cells.root_fraction
        scale, has_width = 0.5 ** (cells.depth + 1), self.width > 0
        half, center = self.width * scale, self.root[:, 0] + self.width * (2 * cells.place + 1) * scale
        is_smallest = np.asarray((cells.depth >= self.halvings)[:, has_width].all(axis=1))
        trials = _CellTrials(center, half, is_smallest, *self._test_configurations(cells.q, center, half))
        self._try_pool(trials)
        self._try_self_motions(trials)
        q, is_proved, fractions = trials.q, trials.is_proved, trials.fractions
        center_units = np.round(q / CENTER_UNIT).astype(np.int64)
        center_units[:, ~self.reach.free] = 0
        self.proved_fraction += cells.select(np.flatnonzero(is_proved)).root_fraction
        self.tree.tokens[cells.name[is_proved]] = PROVED_TOKEN
        self._centers |= zip(cells.name[is_proved].tolist(), center_units[is_proved], strict=True)
        self.pool.add_configurations(center[is_proved], q[is_proved])
        # If no configuration comes closer to the middle than the width of the cell, and none is known for another part of it,
        # its parts are not searched.
        distances, orientation_errors = self.reach.measure_pose_error(q, center[:, : self.reach.axes]).T
        extents = np.linalg.norm(half[:, : self.reach.linear], axis=1)
        extents = extents + half[:, self.reach.axes :].sum(axis=1) * self.reach.max_lock_displacement_rate
        is_unreachable = distances > 2 * extents
        is_unreachable |= orientation_errors > 2 * half[:, self.reach.linear :].sum(axis=1) + _ORIENTATION_SLACK_RAD
        is_unreachable[is_unreachable] = ~self.pool.has_configuration_nearby(center[is_unreachable], half[is_unreachable])
        # Nor are small cells, if nothing was proved of as many consecutive enclosing cells as there are axes.
        barren = np.where(fractions > 0, 0, cells.barren + 1)
        is_small = cells.depth.sum(axis=1) >= _SMALL_CELL_FRACTION * self.halvings[has_width].sum()
        is_unreachable |= (barren >= has_width.sum()) & is_small
        split_rows = np.flatnonzero(~is_proved & ~is_smallest & ~is_unreachable)
        if (abandoned := np.flatnonzero(~is_proved & (is_smallest | is_unreachable))).size:
            self._abandoned_cells.append(cells.select(abandoned))
        remaining = replace(cells.select(split_rows), q=q[split_rows], barren=barren[split_rows])
        form = TaylorForm.expand_at(self.reach, remaining.q, center[split_rows, : self.reach.axes])
        axis = form.choose_split_axis(half[split_rows], (remaining.depth < self.halvings) & has_width)
        self._enqueue_cells(self.tree.halve_cells(remaining, axis), np.repeat(fractions[split_rows], 2))

    def _try_pool(self, trials: _CellTrials) -> None:
        """Try the configurations that prove most near each cell, and for weak cells also the nearest ones of the pool."""
        open_rows = np.flatnonzero(~trials.is_proved)
        best = self.pool.find_best_configurations(trials.center[open_rows])
        if len(best):
            self._replace_weaker_configurations(trials, open_rows, best)
        weak_rows = np.flatnonzero(~trials.is_proved & ((trials.fractions < _HOPELESS_FRACTION) | trials.is_smallest))
        candidates = self.pool.find_nearest_configurations(trials.center[weak_rows], _POOL_TRIALS[1])
        for rank in range(candidates.shape[1]):
            is_weak = (trials.fractions[weak_rows] < _HOPELESS_FRACTION) & (rank < _POOL_TRIALS[0])
            remaining = ~trials.is_proved[weak_rows] & (is_weak | trials.is_smallest[weak_rows])
            if remaining.any():
                self._replace_weaker_configurations(trials, weak_rows[remaining], candidates[remaining, rank])

    def _try_self_motions(self, trials: _CellTrials) -> None:
        """Try configurations on the self-motions of cells that are nearly proved, not proved at all, or smallest."""
        for _ in range(_SELF_MOTION_TRIALS * self.reach.is_redundant):
            is_tried = (trials.fractions > _PROMISING_FRACTION) | trials.is_smallest | (trials.fractions == 0)
            open_rows = np.flatnonzero(~trials.is_proved & is_tried)
            if not open_rows.size:
                break
            self._replace_weaker_configurations(trials, open_rows, step_self_motion(self.reach, trials.q[open_rows], self.rng))

    def _replace_weaker_configurations(self, trials: _CellTrials, rows: IndexArray, initial: FloatArray) -> None:
        """Replace the configurations of cells for which other starting points prove more."""
        minimum = np.minimum(trials.fractions[rows], _RECENTER_FRACTION)
        q, is_proved, fractions = self._test_configurations(initial, trials.center[rows], trials.half[rows], minimum)
        improved = is_proved | (fractions > trials.fractions[rows])
        trials.q[rows[improved]], trials.is_proved[rows[improved]] = q[improved], is_proved[improved]
        trials.fractions[rows[improved]] = fractions[improved]

    def _test_configurations(
        self, q: FloatArray, center: FloatArray, half: FloatArray, minimum: FloatArray | None = None
    ) -> tuple[FloatArray, BoolArray, FloatArray]:
        """Return rounded configurations near q (N, n), a mask of the cells that they prove, and the other proved fractions.

        Fractions are by width. Fractions below ``minimum`` (N,) are reported as the minimum.
        """
        reach, targets = self.reach, center[:, : self.reach.axes]

        def solve_and_round(q: FloatArray, rows: Any, *options: Any) -> FloatArray:
            q = reach.solve_inverse_kinematics(q, targets[rows], *options)
            return reach.set_nonfree_joints(np.round(q / CENTER_UNIT) * CENTER_UNIT, center[rows])

        q = solve_and_round(reach.set_nonfree_joints(q, center), slice(None))
        form = TaylorForm.expand_at(reach, q, targets)
        is_proved = form.is_cell_proved(half)
        fractions = is_proved.astype(float)
        open_rows = np.flatnonzero(~is_proved)
        if open_rows.size:
            fractions[open_rows] = form.select(open_rows).find_provable_width_fraction(
                half[open_rows], None if minimum is None else minimum[open_rows]
            )
            # The error at the middle can cancel half of the curvature.
            rows = open_rows[fractions[open_rows] > _RECENTER_FRACTION]
            form = form.select(rows)
            upper_error, lower_error, _ = form.bound_error_and_travel(half[rows], np.zeros((rows.size, reach.m)))
            upper_error, lower_error, _ = form.bound_error_and_travel(half[rows], np.maximum(upper_error, lower_error))
            recentered = solve_and_round(q[rows], rows, 3, (lower_error - upper_error) / 2)
            now_proved = TaylorForm.expand_at(reach, recentered, targets[rows]).is_cell_proved(half[rows])
            rows = rows[now_proved]
            q[rows], is_proved[rows], fractions[rows] = recentered[now_proved], True, 1.0
        return q, is_proved, fractions


@dataclass(eq=False)
class _CellTrials:
    """Batch of N cells with the best configurations that were tried.

    Attributes:
        center, half: (N, A) middles and half widths.
        is_smallest: (N,) True if no axis may be halved.
        q: (N, n) configurations, rad and m.
        is_proved: (N,) True if the configuration proves the cell.
        fractions: (N,) proved fractions, by width.
    """

    center: FloatArray
    half: FloatArray
    is_smallest: BoolArray
    q: FloatArray
    is_proved: BoolArray
    fractions: FloatArray
