"""Search for motions along a tool path in a ladder graph: many configurations per pose, connected to those of the next pose."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from holdfast.core.progress import track
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kinematics.solvers.best_paths import trace_back
from holdfast.response.recovery.goals import PoseSearch

if TYPE_CHECKING:
    from holdfast.kinematics.paths.path import Path


MAX_JOINT_STEP = 0.35  # rad or m of one joint from sample to sample; a larger step changes the branch and is no motion
_MAX_LAYER_CONFIGURATIONS = 150  # configurations of a pose
_COPIES_PER_CONFIGURATION = 3  # copies of each configuration that are moved along the self-motion
_PERTURBATION_STD = 0.15  # standard deviation of these moves, rad or m
_DUPLICATE_TOLERANCE = 1e-3  # rad or m: closer configurations count as equal
_SHORTENING_SWEEPS = 40

MIN_PATH_STEP = 2.5e-4  # fraction of a path to which the end of a motion along it is located
_SELF_MOTION_PATH_STEP = 1e-7  # fraction of a path: a step along the self-motion, nearly in place, so that fractions increase
_MAX_CONTINUED_CONFIGURATIONS = 60  # configurations of a pose from which a path is continued
_MIDPOINT_TOLERANCE = 0.25  # of a step: largest distance of its middle from the straight line
_MAX_SPREADS = 8  # spreads along the self-motion before the end counts as reached
_MAX_LAYERS = 4000


@dataclass(frozen=True)
class LadderGraph:
    """Result of the search through the layers of the graph.

    Attributes:
        motions: (S, n) motions, the shortest first, each from another configuration of the first pose; rad and m.
        last_sample: Index of the last sample that any motion reaches.
        configuration_count: Number of configurations in all layers.
    """

    motions: list[FloatArray]
    last_sample: int
    configuration_count: int


def search_ladder_graph(
    search: PoseSearch,
    poses: FloatArray,
    first_configurations: FloatArray,
    q_start: FloatArray,
    start_count: int,
    rng: np.random.Generator,
) -> LadderGraph:
    """Search motions along poses (S, 4, 4) from configurations (R, n) of the first pose and others on its self-motion.

    Each configuration is connected to the nearest of the next pose and to others on its self-motion, by steps that are proved
    collision-free. The configurations of a pose that are furthest apart are kept, so a passage that is narrower than their
    distance may be missed.
    """
    sampled = search.solver.sample_configurations(start_count, q_start, search.space.free, rng)
    first_configurations = np.concatenate([first_configurations, search.solve_pose(poses[0], sampled)])
    first_configurations = q_start + search.space.shortest_difference(first_configurations, q_start)
    costs = search.metric.measure_length(first_configurations - q_start)
    selected = _select_farthest_points(first_configurations, costs, _MAX_LAYER_CONFIGURATIONS)
    layers, sources, costs = [first_configurations[selected]], [np.arange(len(selected))], costs[selected]
    for pose in track("layers", list(poses[1:])):
        after, source, costs_after = _compute_next_layer(
            search, layers[-1], costs, pose, _COPIES_PER_CONFIGURATION, rng, _MAX_LAYER_CONFIGURATIONS
        )
        if not len(after) or search.space.is_time_over:
            break
        layers.append(after)
        sources.append(source)
        costs = costs_after
    configuration_count = sum(map(len, layers))
    if len(layers) < len(poses):
        return LadderGraph([], len(layers) - 1, configuration_count)
    motions: dict[int, FloatArray] = {}
    for last_index in np.argsort(costs, kind="stable"):
        indices = trace_back(sources[1:], int(last_index))
        if int(indices[0]) not in motions:
            motions[int(indices[0])] = np.stack([layer[index] for layer, index in zip(layers, indices, strict=True)])
    return LadderGraph(list(motions.values()), len(poses) - 1, configuration_count)


@dataclass(frozen=True)
class PathContinuation:
    """Furthest motion along a path from configurations of its first pose.

    Attributes:
        fractions: (S,) fractions of the path, 0 to 1, increasing; the last one is where every motion that was found ends.
        q: (S, n) the shortest motion to that point, rad and m.
        configuration_count: Number of configurations at all fractions if self-motion was used; else 0.
    """

    fractions: FloatArray
    q: FloatArray
    configuration_count: int


def follow_path_furthest(
    search: PoseSearch, path: Path, first_configurations: FloatArray, *, max_path_step: float, rng: np.random.Generator
) -> PathContinuation:
    """Follow a path as far as possible from any of the configurations (R, n) of its first pose.

    Where no step continues, steps become shorter, down to ``MIN_PATH_STEP``. If the arm has self-motion, the configurations at
    the last fraction are then spread along it, and the path is tried again from there.

    Args:
        search: Search with the rows that must be met.
        path: Tool path.
        first_configurations: (R, n) configurations of the first pose, at least one, rad and m.
        max_path_step: Largest step, as a fraction of the path.
        rng: Random number generator of the spreading.
    """
    copies = _COPIES_PER_CONFIGURATION if search.space.free.sum() > search.solver.rows.m else 0
    selected = _select_farthest_points(first_configurations, np.zeros(len(first_configurations)), _MAX_CONTINUED_CONFIGURATIONS)
    layers, sources, fractions = [first_configurations[selected]], [selected], [0.0]
    costs, step, spread_count, last_spread = np.zeros(len(selected)), max_path_step, 0, 0.0
    while fractions[-1] < 1 and not search.space.is_time_over and len(layers) < _MAX_LAYERS:
        fraction = min(fractions[-1] + step, 1.0)
        pose = path.pose(np.array([fraction]))[0]
        after, source, total_costs = _compute_next_layer(
            search, layers[-1], costs, pose, copies, rng, _MAX_CONTINUED_CONFIGURATIONS, checks_middle=True
        )
        if len(after):
            layers, sources, fractions, costs = [*layers, after], [*sources, source], [*fractions, fraction], total_costs
            if step == _SELF_MOTION_PATH_STEP:
                step = MIN_PATH_STEP
                continue
            step = min(2 * step, max_path_step)
            if fraction - last_spread > 4 * MIN_PATH_STEP:
                spread_count, last_spread = 0, fraction
        elif step > MIN_PATH_STEP:
            step /= 4
        elif copies and spread_count < _MAX_SPREADS:
            spread_count, step = spread_count + 1, _SELF_MOTION_PATH_STEP
        else:
            break
    indices = trace_back(sources[1:], int(costs.argmin()))
    motion = np.stack([layer[index] for layer, index in zip(layers, indices, strict=True)])
    return PathContinuation(np.array(fractions), motion, sum(map(len, layers)) if copies else 0)


def _compute_next_layer(
    search: PoseSearch,
    before: FloatArray,
    costs: FloatArray,
    pose: FloatArray,
    copies: int,
    rng: np.random.Generator,
    max_count: int,
    *,
    checks_middle: bool = False,
) -> tuple[FloatArray, IndexArray, FloatArray]:
    """Return configurations (K, n) of a pose one step from configurations (N, n), the source of each, and the costs so far.

    With ``checks_middle``, the middle of each step must also be near the straight line, because on another branch it is not.
    """
    source = np.tile(np.arange(len(before)), 1 + copies)
    perturbed = before[source]
    perturbed[len(before) :] += rng.normal(0.0, _PERTURBATION_STD, (copies * len(before), before.shape[1])) * search.space.free
    poses = np.repeat(pose[None], len(source), axis=0)
    after, is_valid = _step_to_poses(search, perturbed, poses, before[source])
    source, after = source[is_valid], after[is_valid]
    total_costs = costs[source] + search.metric.measure_length(after - before[source])
    selected = _select_farthest_points(after, total_costs, 2 * max_count)  # only these need a collision check
    source, after, total_costs = source[selected], after[selected], total_costs[selected]
    is_near = np.ones(len(after), dtype=bool)
    if checks_middle:
        straight_middle = (before[source] + after) / 2
        middle, is_near = _step_to_poses(search, straight_middle, poses[: len(source)], before[source])
        max_error = _MIDPOINT_TOLERANCE * np.abs(after - before[source]).max(axis=1) + 10 * _DUPLICATE_TOLERANCE
        is_near &= np.abs(middle - straight_middle).max(axis=1) <= max_error
    is_near[is_near] = search.space.are_segments_valid(before[source[is_near]], after[is_near])
    source, after, total_costs = source[is_near], after[is_near], total_costs[is_near]
    selected = _select_farthest_points(after, total_costs, max_count)
    return after[selected], source[selected], total_costs[selected]


def _step_to_poses(search: PoseSearch, q: FloatArray, poses: FloatArray, before: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Solve poses (N, 4, 4) from q (N, n); also return which solutions meet their pose and are one step from ``before``."""
    row_masks = search.make_row_masks(len(q))
    after = search.solve(q, poses, row_masks)
    is_near = np.abs(after - before).max(axis=1) <= MAX_JOINT_STEP
    return after, search.meets_rows(after, poses, row_masks) & is_near


def _select_farthest_points(q: FloatArray, costs: FloatArray, max_count: int) -> IndexArray:
    """Return the indices of the cheapest of configurations (N, n), then repeatedly of the one farthest from all selected."""
    if not len(q):
        return np.zeros(0, dtype=np.int64)
    columns = np.ascontiguousarray(q.T)
    selected, distances = [int(np.argmin(costs))], np.full(len(q), np.inf)
    while len(selected) <= max_count:
        distances = np.minimum(distances, np.abs(columns - columns[:, selected[-1:]]).max(axis=0))
        if distances.max() <= _DUPLICATE_TOLERANCE:
            break
        selected.append(int(np.argmax(distances)))
    return np.array(selected[:max_count])


def shorten_along_poses(search: PoseSearch, poses: FloatArray, q: FloatArray) -> FloatArray:
    """Shorten the motion (S, n) along self-motions: each configuration moves towards the middle of its neighbors."""
    space, metric = search.space, search.metric
    q = q.copy()
    for _ in range(_SHORTENING_SWEEPS):
        old_length = float(metric.cumulative_length(q)[-1])
        for parity in (1, 2):
            indices = np.arange(parity, len(q), 2)
            next_indices = np.minimum(indices + 1, len(q) - 1)
            targets = np.where((indices < len(q) - 1)[:, None], (q[indices - 1] + q[next_indices]) / 2, q[indices - 1])
            trial, is_better = _step_to_poses(search, targets, poses[indices], q[indices - 1])
            is_better &= np.abs(trial - q[next_indices]).max(axis=1) <= MAX_JOINT_STEP
            old_lengths = metric.measure_length(q[indices] - q[indices - 1]) + metric.measure_length(
                q[next_indices] - q[indices]
            ) * (next_indices > indices)
            new_lengths = metric.measure_length(trial - q[indices - 1]) + metric.measure_length(q[next_indices] - trial) * (
                next_indices > indices
            )
            is_better &= new_lengths < old_lengths
            is_better[is_better] = space.are_segments_valid(q[indices[is_better] - 1], trial[is_better])
            has_successor = is_better & (next_indices > indices)
            is_better[has_successor] = space.are_segments_valid(trial[has_successor], q[next_indices[has_successor]])
            q[indices[is_better]] = trial[is_better]
        if space.is_time_over or float(metric.cumulative_length(q)[-1]) > old_length * (1 - 1e-4):
            break
    return q
