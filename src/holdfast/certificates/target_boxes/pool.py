"""Pool of configurations, spread over the root box, from which a search begins."""

from __future__ import annotations

from time import monotonic, perf_counter
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.taylor import ReachSolver, TaylorForm
from holdfast.core.typing import FloatArray, IndexArray

_INITIAL_TARGETS = 250
_MAX_TARGETS = 1000
_RANDOM_STARTS = 10  # random starts of each target
_CELLS_PER_TARGET = 64  # estimated cells for each target; more cells require more targets
_MAX_SELF_MOTION_STEP_RAD = 0.5  # rad: largest step along self-motions
_LOCAL_SEARCH_STEPS = 10  # steps along self-motions towards a larger proved part
_FINAL_SEARCH_STEPS = 30  # such steps for the best configurations
_TEST_CELL_SCALE = 2.0  # ratio of the width of a test cell to the width that was proved before
_WIDEN_ABOVE_FRACTION = 0.75  # proved fraction of a test cell above which the next one is twice as wide
_CELL_SCALE_RANGE = (2.0**-10, 2.0**10)  # range of the scale of test cells
_ESTIMATE_SAMPLES = 200  # samples of the estimate
_MAX_ESTIMATE_HALVINGS = 60  # bisections of a sample
_TRIALS_PER_CELL = 11  # configurations for each proved cell (measured: cubes for a Panda)
_TARGET_TOLERANCE = 1e-9  # m and rad


def step_self_motion(reach: ReachSolver, q: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Take a random step along the self-motion from each q (N, n)."""
    move = np.nan_to_num(reach.project_self_motion(q, rng.normal(size=q.shape)))
    scale = rng.uniform(0, _MAX_SELF_MOTION_STEP_RAD, len(q)) / np.maximum(np.abs(move).max(axis=1), 1e-9)
    return np.asarray(q + move * scale[:, None])


class ConfigurationPool:
    """Pool of configurations for random targets and locked values of a root box, optimised to prove large cells.

    Args:
        reach: Solver for configurations at targets.
        root: (A, 2) range of targets along each axis, then of the locked value.
        rng: Generator of all random samples.
        deadline: Monotonic time at which sampling stops with the present result, s.

    Attributes:
        q: (N, n) configurations of the first targets, rad or m.
        estimated_cells: Estimated number of cells for the whole box; infinite if unknown.
        estimated_seconds: Estimated time for these cells on this machine, s.
        mean_halvings: (A,) average number of bisections of each axis for these cells.
        pending_rounds: Number of further rounds of targets that the claim needs; larger if there was no time for the first.
        sampled_targets, unreached_targets: Number of the first sampled targets, and of those without a configuration.
    """

    def __init__(self, reach: ReachSolver, root: FloatArray, rng: np.random.Generator, deadline: float) -> None:
        self._reach, self._root, self._rng = reach, root, rng
        self._width = root[:, 1] - root[:, 0]
        self._unit = np.where(self._width > 0, self._width, 1.0)
        self._configurations, self._indexed_count, self._deadline = np.empty((0, reach.n)), 0, deadline
        self._added: list[tuple[FloatArray, FloatArray]] = []
        self._best_batches, self._best_index = list[tuple[FloatArray, FloatArray]](), cast(Any, None)
        self._test_half = np.zeros(len(root))
        self.sampled_targets = self.unreached_targets = 0
        self.q, self._coordinates = self._sample_configurations()
        self.estimated_cells, self.mean_halvings, self.estimated_seconds = self._estimate_cost(self.q, self._coordinates)
        self.pending_rounds = int(monotonic() >= deadline) + max(
            int(min(_MAX_TARGETS, self.estimated_cells / _CELLS_PER_TARGET)) // _INITIAL_TARGETS - 1, 0
        )

    def sample_pending_targets(self, deadline: float) -> None:
        """Add the targets that the claim needs, as far as the monotonic ``deadline`` allows; an estimate does not need them."""
        self._deadline = max(self._deadline, deadline)
        while self.pending_rounds and monotonic() < self._deadline:
            self._sample_configurations()
            self.pending_rounds -= monotonic() < self._deadline

    def sample_in_cells(self, lower: FloatArray, width: FloatArray, deadline: float) -> None:
        """Add configurations for targets and locked values in some of these cells (N, A), until the monotonic ``deadline``."""
        self._deadline, chosen = max(self._deadline, deadline), np.resize(self._rng.permutation(len(lower)), _INITIAL_TARGETS)
        self._sample_configurations(lower[chosen] + self._rng.random(lower[chosen].shape) * width[chosen])

    def _sample_configurations(self, targets: FloatArray | None = None) -> tuple[FloatArray, FloatArray]:
        """Add configurations that are found for more targets, and return them with their targets."""
        reach = self._reach
        if targets is None:
            targets = self._root[:, 0] + self._rng.random((_INITIAL_TARGETS, len(self._root))) * self._width
        coordinates = np.repeat(targets, _RANDOM_STARTS, axis=0)[: None if monotonic() < self._deadline else 0]
        lower, upper = reach.sampling_limits.T
        q = reach.set_nonfree_joints(self._rng.uniform(lower, upper, (len(coordinates), reach.n)), coordinates)
        q = reach.solve_inverse_kinematics(q, coordinates[:, : reach.axes], 40)
        is_reached = (reach.measure_pose_error(q, coordinates[:, : reach.axes]) < _TARGET_TOLERANCE).all(axis=1)
        if not self.sampled_targets:
            self.sampled_targets = len(coordinates) // _RANDOM_STARTS
            self.unreached_targets = int((~is_reached.reshape(-1, _RANDOM_STARTS).any(axis=1)).sum())
        q, coordinates = q[is_reached], coordinates[is_reached]
        if not self._test_half.any():
            self._test_half = _TEST_CELL_SCALE / 2 * self._width * 0.5 ** self._estimate_cost(q, coordinates)[1]
        q, scale, widths = self._search_self_motions(q, coordinates, np.ones(len(q)), _LOCAL_SEARCH_STEPS)
        self.add_configurations(coordinates, q)
        # Cells inherit the configuration of their parent, so only the best one of the several at each target is kept.
        order = np.argsort(-scale, kind="stable")
        best_rows = order[np.unique(coordinates[order], axis=0, return_index=True)[1]]
        improved, _, _ = self._search_self_motions(q[best_rows], coordinates[best_rows], widths[best_rows], _FINAL_SEARCH_STEPS)
        self._best_batches.append((coordinates[best_rows] / self._unit, improved))
        return q, coordinates

    def _search_self_motions(
        self, q: FloatArray, coordinates: FloatArray, widths: FloatArray, steps: int
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Move configurations along self-motions to prove more, and return them with the proved and the tested scales."""
        q, best_scale, targets = q.copy(), np.full(len(q), -1.0), coordinates[:, : self._reach.axes]
        for step in range(1 + steps * self._reach.is_redundant):
            if monotonic() > self._deadline:
                break
            candidates = q
            if step:
                candidates = self._reach.solve_inverse_kinematics(step_self_motion(self._reach, q, self._rng), targets)
            half = np.minimum(self._test_half * widths[:, None], self._width / 2)
            form = TaylorForm.expand_at(self._reach, candidates, targets)
            scale = widths * form.find_provable_width_fraction(half, best_scale / widths if step else None)
            improved = scale > best_scale
            q[improved], best_scale[improved] = candidates[improved], scale[improved]
            narrowed = np.where(best_scale > 0, widths, widths / 2)
            widths = np.where(best_scale > _WIDEN_ABOVE_FRACTION * widths, 2 * widths, narrowed)
            widths = np.clip(widths, *_CELL_SCALE_RANGE)
        return q, best_scale, widths

    def add_configurations(self, center: FloatArray, q: FloatArray) -> None:
        """Add configurations q (N, n) that proved cells around centers (N, A), because cells near them may need the same."""
        self._added.append((center / self._unit, q))

    def _nearest_distances_and_indices(self, center: FloatArray, count: int) -> tuple[FloatArray, IndexArray]:
        """Return distances (N, count), in parts of the root, and indices of the nearest configurations, or of all if fewer."""
        if 2 * self._indexed_count < sum(len(q) for _, q in self._added):  # avoids frequent rebuilding of the tree
            from scipy.spatial import KDTree

            coordinates, self._configurations = (np.concatenate(arrays) for arrays in zip(*self._added, strict=True))
            self._added, self._indexed_count = [(coordinates, self._configurations)], len(coordinates)
            self._nearest_index = KDTree(coordinates)
        count = min(count, self._indexed_count)
        if not count:
            return np.empty((len(center), 0)), np.empty((len(center), 0), dtype=np.int64)
        distances, nearest = self._nearest_index.query(center / self._unit, k=np.arange(1, count + 1), p=np.inf)
        return np.asarray(distances), np.asarray(nearest)

    def find_nearest_configurations(self, center: FloatArray, count: int) -> FloatArray:
        """Return the nearest configurations (N, count, n) by target and locked value for centers (N, A), or all if fewer."""
        _, nearest = self._nearest_distances_and_indices(center, count)
        return np.asarray(self._configurations[nearest])

    def find_best_configurations(self, center: FloatArray) -> FloatArray:
        """Return the configurations (N, n) that prove most at the sampled targets nearest to centers (N, A), or (0, n)."""
        coordinates, q = (np.concatenate(arrays) for arrays in zip(*self._best_batches, strict=True))
        if not len(q):
            return np.empty((0, self._reach.n))
        from scipy.spatial import KDTree

        if self._best_index is None or self._best_index.n != len(q):
            self._best_index = KDTree(coordinates)
        return np.asarray(q[self._best_index.query(center / self._unit, p=np.inf)[1]])

    def has_configuration_nearby(self, center: FloatArray, half: FloatArray) -> NDArray[np.bool_]:
        """Return a mask (N,) of cells (N, A) that contain a configuration, or for elongated cells have one next to them."""
        distances, _ = self._nearest_distances_and_indices(center, 1)
        return np.asarray((distances <= (half / self._unit).max(axis=1, keepdims=True)).any(axis=1))

    def choose_split_axes(self, count: int, max_per_axis: int) -> tuple[int, ...]:
        """Choose the axes of ``count`` halvings of the root, each at most ``max_per_axis`` times, as the search halves them."""
        remaining, axes = self.mean_halvings.copy(), list[int]()
        for _ in range(count):
            axis = int(np.argmax(remaining))
            if remaining[axis] > 0 and axes.count(axis) < max_per_axis:
                axes.append(axis)
            remaining[axis] -= 1
        return tuple(axes)

    def _estimate_cost(self, q: FloatArray, coordinates: FloatArray) -> tuple[float, FloatArray, float]:
        """Estimate the cells, the halvings of each axis, and the seconds, from some configurations (N, n) of targets (N, A).

        The number of cells is the median of 2^k, where k halvings are needed until a configuration proves its cell.
        """
        if not len(q):
            return np.inf, np.zeros(len(self._root)), np.inf
        sample = self._rng.permutation(len(q))[:_ESTIMATE_SAMPLES]
        targets, half = coordinates[sample, : self._reach.axes], np.tile(self._width / 2, (len(sample), 1))
        form = TaylorForm.expand_at(self._reach, q[sample], targets)
        halvings, allowed = np.zeros(half.shape), np.broadcast_to(self._width > 0, half.shape)
        open_rows = np.arange(len(sample))
        for _ in range(_MAX_ESTIMATE_HALVINGS):
            open_rows = open_rows[~form.select(open_rows).is_cell_proved(half[open_rows])]
            if not open_rows.size:
                break
            axis = form.select(open_rows).choose_split_axis(half[open_rows], allowed[open_rows])
            halvings[open_rows, axis] += 1
            half[open_rows, axis] /= 2
        started = perf_counter()
        solutions = self._reach.solve_inverse_kinematics(form.q, targets)
        TaylorForm.expand_at(self._reach, solutions, targets).find_provable_width_fraction(half)
        trial_seconds = (perf_counter() - started) / len(sample)
        finished = np.delete(halvings, open_rows, axis=0)  # a configuration at a limit proves no cell of any size
        if not len(finished):
            return np.inf, np.zeros(len(self._root)), np.inf
        cells = float(2 ** np.median(finished.sum(axis=1)))
        return cells, finished.mean(axis=0), _TRIALS_PER_CELL * trial_seconds * cells
