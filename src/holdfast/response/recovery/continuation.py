"""Search for one continuous motion that finishes the rest of a tool path with joints locked."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from holdfast.core.progress import track
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.model.arm.poses import rotation_vectors
from holdfast.response.recovery.goals import PoseSearch, RelaxedRows, find_goal_configurations
from holdfast.response.recovery.ladder_graph import MAX_JOINT_STEP, follow_path_furthest, search_ladder_graph
from holdfast.response.recovery.routes import find_reachable_goals
from holdfast.response.recovery.task_rows import RowSolver, list_subsets, relaxed_rows_sort_key
from holdfast.response.recovery.timing.motion import PATH_TOLERANCE

if TYPE_CHECKING:
    from holdfast.kinematics.paths.path import Path


_SAMPLE_SPACING = 0.01  # distance of the end effector between samples, m or rad
_MIN_SAMPLES = 20  # smallest number of samples of a path
_MAX_SAMPLES = 400  # largest number of samples of a path
_STARTS_PER_SET = 12
_REFINEMENT_FACTOR = 8  # ratio of the number of samples where joints move so fast that one motion seems to jump
_INNER_FRACTIONS = np.array([0.25, 0.5, 0.75])  # points between two waypoints at which the motion is checked
_MAX_WAYPOINT_BISECTIONS = 8  # bisections of the segment between two waypoints until it is near the path


@dataclass(frozen=True, kw_only=True)
class RestOfPath:
    """Result of the search for a motion along the rest of a tool path.

    Attributes:
        furthest: Fraction of the path, 0 to 1, to 0.001, that a motion completes with every row met. The motion begins in a
            configuration of the first pose to which a motion of the arm was found.
        begin: (n,) first configuration of that motion, rad and m; None if none was found.
        share: (S,) samples of the path, 0 to 1.
        found: (S,) True where a configuration of that pose was found, independently of the other samples.
        q: (S, n) motion along the path, without the relaxed rows if there are any, rad and m; (0, n) if none was found.
        deviation: Largest error of the met rows half-way between waypoints, m and rad.
        given_up: Rows relaxed over the whole path, with their largest errors; None if all are met.
        starts: Configurations of the first pose from which the path was followed.
        cut_off: True if configurations of the first pose were found, but no route to any of them; ``q`` is then empty.
        graph: Number of configurations of the graph through all poses that is searched if every motion from the first pose ends
            early; 0 if no graph was needed, or if the arm has no self-motion left.
    """

    furthest: float
    share: FloatArray
    found: BoolArray
    q: FloatArray
    deviation: float
    given_up: RelaxedRows | None
    starts: int
    begin: FloatArray | None = None
    cut_off: bool = False
    graph: int = 0

    @property
    def finished(self) -> bool:
        """True if a continuous motion was found that keeps every row from beginning to end."""
        return len(self.q) > 0 and self.given_up is None

    @property
    def first_lost(self) -> float | None:
        """First sample, 0 to 1, without a configuration; None if a configuration was found for every sample."""
        unreached = self.share[~self.found]
        return float(unreached[0]) if unreached.size else None

    @property
    def why(self) -> str:
        """Reason why the path was not finished, a phrase."""
        if self.cut_off:
            return "configurations of its first pose exist, but no route from here to any of them was found"
        if self.first_lost is not None:
            return f"no configuration was found at {100 * self.first_lost:.1f} % of it, which proves nothing"
        graph_text = f" among {self.graph:,} configurations connected from pose to pose" if self.graph else ""
        return f"each of its poses has a configuration, but no continuous motion through all of them was found{graph_text}"

    def describe(self) -> str:
        """Return the result in one or two sentences."""
        if self.finished:
            return (
                f"The rest of the tool path can be finished: {len(self.q)} waypoints, off the path by at most "
                f"{self.deviation:.2g} (m and rad) between them."
            )
        text = f"The rest of the tool path was not finished: {self.why}; the best motion completes {100 * self.furthest:.1f} %"
        if self.begin is not None:
            text += f" of it, from the configuration ({', '.join(f'{angle:.4g}' for angle in self.begin)}) of its first pose"
        text += "."
        if self.given_up is not None:
            text += f" It can be followed if these rows are relaxed, with these largest errors: {self.given_up}."
        return text


def follow_rest_of_path(
    search: PoseSearch, path: Path, q_start: FloatArray, start_count: int, rng: np.random.Generator
) -> tuple[RestOfPath, list[FloatArray]]:
    """Follow a path from configurations of its first pose; also return every motion (S, n) found, the shortest first."""
    fractions = _sample_fractions(path)
    poses = path.pose(fractions)
    is_reached = np.array(
        [
            not search.space.is_time_over and _is_reachable(search, pose, q_start, rng)
            for pose in track("poses of the path", poses)
        ]
    )
    first_configurations = find_goal_configurations(search, poses[0], q_start, start_count, rng)
    rest = RestOfPath(
        furthest=0.0,
        share=fractions,
        found=is_reached,
        q=np.zeros((0, search.solver.arm.n)),
        deviation=0.0,
        given_up=None,
        starts=len(first_configurations),
    )
    rest, motions = _follow_samples(rest, search, path, first_configurations)
    if not motions and _all_reached_on_retry(search, poses, rest.found, q_start, start_count, rng):
        if search.space.free.sum() > search.solver.rows.m:
            graph = search_ladder_graph(search, poses, first_configurations, q_start, start_count, rng)
            furthest = max(rest.furthest, float(fractions[graph.last_sample]))
            rest, motions = replace(rest, furthest=furthest, graph=graph.configuration_count), graph.motions
        if not motions:
            rest, motions = _follow_samples(rest, search, path, first_configurations, _REFINEMENT_FACTOR)
    return (add_motion_with_deviation(rest, search.solver, path, motions[0]) if motions else rest), motions


def follow_to_furthest_point(
    rest: RestOfPath, search: PoseSearch, path: Path, q_start: FloatArray, start_count: int, rng: np.random.Generator
) -> tuple[RestOfPath, list[FloatArray]]:
    """Continue an unfinished path to its furthest reachable point; also return the motion if it reaches the end.

    Motions start from all configurations of the first pose that were found and that a motion of the arm reaches.
    """
    rest = replace(rest, furthest=0.0)
    pose = path.pose(rest.share[:1])[0]
    first_configurations = np.concatenate(
        [
            find_goal_configurations(search, pose, q_start, start_count, rng),
            search.solve_pose(pose, search.solver.sample_configurations(start_count, q_start, search.space.free, rng)),
        ]
    )
    first_configurations = q_start + search.space.shortest_difference(first_configurations, q_start)
    if not len(first_configurations):
        return rest, []
    first_configurations = first_configurations[
        find_reachable_goals(search.space, search.metric, q_start, first_configurations, rng)
    ]
    if not len(first_configurations):
        return replace(rest, cut_off=True), []
    stride = float(np.diff(rest.share).max())
    continuation = follow_path_furthest(search, path, first_configurations, max_path_step=stride, rng=rng)
    fractions, motion = continuation.fractions, continuation.q
    rest = replace(rest, begin=motion[0], graph=max(rest.graph, continuation.configuration_count), cut_off=False)
    furthest = float(fractions[-1])
    if furthest == 1:
        all_reached = replace(rest, furthest=1.0, share=fractions, found=np.ones(len(fractions), dtype=bool))
        refinement = refine_waypoints(all_reached, search, path, motion)
        if refinement is not None:
            return refinement[0], [refinement[1]]
        for segment in _find_deviating_segments(search, path, fractions, motion).tolist():  # one of them skips poses
            ends = slice(segment, segment + 2)
            piece = replace(all_reached, share=fractions[ends], found=all_reached.found[ends])
            if refine_waypoints(piece, search, path, motion[ends]) is None:
                furthest = float(fractions[segment])
                break
    return replace(rest, furthest=furthest, found=rest.found | (rest.share <= furthest)), []


def _follow_samples(
    rest: RestOfPath, search: PoseSearch, path: Path, first_configurations: FloatArray, refinement: int = 1
) -> tuple[RestOfPath, list[FloatArray]]:
    """Follow the path from configurations (R, n) of its first pose, with ``refinement`` times as many samples."""
    positions = np.arange((len(rest.share) - 1) * refinement + 1) / refinement
    fractions = np.interp(positions, np.arange(len(rest.share)), rest.share)
    row_masks = search.make_row_masks(len(first_configurations))
    q, last_samples = _track_poses(search, path.pose(fractions), first_configurations, row_masks)
    furthest = max(rest.furthest, float(fractions[last_samples.max(initial=0)]))
    complete = np.flatnonzero(last_samples == len(fractions) - 1)
    if complete.size:
        rest = replace(rest, share=fractions, found=np.ones(len(fractions), dtype=bool))
    # A pose that a motion passes counts as found.
    rest = replace(rest, furthest=furthest, found=rest.found | (rest.share <= furthest) & (last_samples.max(initial=-1) >= 0))
    motions = [q[:, index] for index in complete]
    return rest, sorted(motions, key=lambda motion: float(search.metric.cumulative_length(motion)[-1]))


def follow_with_relaxed_rows(
    rest: RestOfPath, search: PoseSearch, path: Path, q_start: FloatArray, rng: np.random.Generator
) -> tuple[RestOfPath, list[FloatArray]]:
    """Follow the path with as few rows relaxed as possible; also return the motion (S, n) if there is one."""
    solver, poses = search.solver, path.pose(rest.share)
    for size in range(1, solver.rows.m):
        row_sets = [] if search.space.is_time_over else list_subsets(solver.rows.m, size, [])
        solution = _find_best_relaxation(search, poses, q_start, row_sets, rng) if row_sets else None
        if solution:
            relaxed_rows, motion = solution
            row_mask = search.make_row_masks(1, relaxed_rows)[0]
            relaxed_rows = tuple(np.flatnonzero(search.solver.find_violated_rows(motion, poses).any(axis=0)).tolist())
            if not relaxed_rows:  # a row that is met along the whole path is not relaxed
                return add_motion_with_deviation(rest, search.solver, path, motion), [motion]
            row_errors = np.abs(solver.compute_errors(motion, poses)).max(axis=0)[list(relaxed_rows)]
            names, units = (
                [labels[i] for i in relaxed_rows] for labels in (search.solver.rows.names, search.solver.rows.units)
            )
            relaxed = RelaxedRows(tuple(names), tuple(row_errors.tolist()), tuple(units))
            return replace(add_motion_with_deviation(rest, search.solver, path, motion, row_mask), given_up=relaxed), [motion]
    return rest, []


def _sample_fractions(path: Path) -> FloatArray:
    rotations = path.pose(np.linspace(0, 1, 65))[:, :3, :3]
    rotation_steps = rotation_vectors(rotations[1:] @ rotations[:-1].transpose(0, 2, 1))
    total_rotation = float(np.linalg.norm(rotation_steps, axis=1).sum()) if path.oriented else 0.0
    count = int(np.clip(np.ceil(max(path.length, total_rotation) / _SAMPLE_SPACING), _MIN_SAMPLES, _MAX_SAMPLES))
    return np.unique(np.concatenate([np.linspace(0, 1, count + 1), path.bounds]))


def _all_reached_on_retry(
    search: PoseSearch,
    poses: FloatArray,
    is_reached: BoolArray,
    q_start: FloatArray,
    start_count: int,
    rng: np.random.Generator,
) -> bool:
    """Search longer for each pose without a configuration, up to the first failure; return True if every pose has one."""
    for sample in np.flatnonzero(~is_reached):
        is_reached[sample] = not search.space.is_time_over and _is_reachable(search, poses[sample], q_start, rng, start_count)
        if not is_reached[sample]:
            return False
    return not search.space.is_time_over


def _is_reachable(
    search: PoseSearch, pose: FloatArray, q_start: FloatArray, rng: np.random.Generator, start_count: int = 15
) -> bool:
    return len(search.solve_pose(pose, search.sample_starts(q_start, start_count, rng))) > 0


def _track_poses(
    search: PoseSearch, poses: FloatArray, first_configurations: FloatArray, row_masks: FloatArray
) -> tuple[FloatArray, IndexArray]:
    """Return motions (S, R, n) from configurations (R, n) of the first pose, NaN once lost, and their last samples (R,)."""
    q = np.full((len(poses), *first_configurations.shape), np.nan)
    q[0] = first_configurations
    last_samples = np.zeros(len(first_configurations), dtype=np.int64)
    active = np.arange(len(first_configurations))
    for sample in track("waypoints", range(1, len(poses)), most=True):
        if not active.size or search.space.is_time_over:
            break
        before = q[sample - 1, active]
        targets = np.repeat(poses[sample][None], len(active), axis=0)
        after = search.solver.solve_required_rows(before, targets, row_masks[active], search.space.free)
        is_jump = np.abs(after - before).max(axis=1) > MAX_JOINT_STEP
        if is_jump.any():  # relaxed rows must not pull the others to another branch
            after[is_jump] = search.solver.solve(
                before[is_jump], targets[is_jump], row_masks[active][is_jump], search.space.free
            )
        after = search.project(after, targets, row_masks[active])
        is_valid = search.meets_rows(after, targets, row_masks[active])
        is_valid &= np.abs(after - before).max(axis=1) <= MAX_JOINT_STEP
        indices = np.flatnonzero(is_valid)
        is_valid[indices] = search.space.are_segments_valid(before[indices], after[indices])
        active, after = active[is_valid], after[is_valid]
        q[sample, active], last_samples[active] = after, sample
    return q, last_samples


def _find_best_relaxation(
    search: PoseSearch, poses: FloatArray, q_start: FloatArray, row_sets: list[tuple[int, ...]], rng: np.random.Generator
) -> tuple[tuple[int, ...], FloatArray] | None:
    """Return the preferred set of rows without which the path is followed, and the motion with the least errors."""
    starts = search.sample_starts(q_start, _STARTS_PER_SET - 1, rng)
    set_indices = np.repeat(np.arange(len(row_sets)), len(starts))
    row_masks = np.concatenate([search.make_row_masks(len(starts), row_set) for row_set in row_sets])
    targets = np.repeat(poses[:1], len(set_indices), axis=0)
    repeated_starts = np.tile(starts, (len(row_sets), 1))
    first_configurations = search.solver.solve_required_rows(repeated_starts, targets, row_masks, search.space.free)
    first_configurations = search.project(first_configurations, targets, row_masks)
    is_valid = search.are_valid(first_configurations, targets, row_masks)
    q, last_samples = _track_poses(search, poses, first_configurations[is_valid], row_masks[is_valid])
    complete = np.flatnonzero(last_samples == len(poses) - 1)
    if not complete.size:
        return None
    motion_errors = [float(np.linalg.norm(search.solver.compute_errors(q[:, k], poses), axis=1).max()) for k in complete]
    sort_keys = [
        (*relaxed_rows_sort_key(search.solver.rows, row_sets[set_indices[is_valid][index]]), motion_error)
        for index, motion_error in zip(complete, motion_errors, strict=True)
    ]
    best = complete[min(range(len(sort_keys)), key=sort_keys.__getitem__)]
    return row_sets[set_indices[is_valid][best]], q[:, best]


def add_motion_with_deviation(
    rest: RestOfPath, solver: RowSolver, path: Path, q: FloatArray, mask: FloatArray | float = 1.0
) -> RestOfPath:
    """Return the result with the motion q (S, n) and its deviation between waypoints, of the rows whose ``mask`` is 1."""
    middle_poses = path.pose((rest.share[1:] + rest.share[:-1]) / 2)
    deviation = np.abs(solver.compute_errors((q[1:] + q[:-1]) / 2, middle_poses) * mask).max()
    return replace(rest, q=q, deviation=float(deviation))


def _find_deviating_segments(search: PoseSearch, path: Path, fractions: FloatArray, q: FloatArray) -> IndexArray:
    """Return the segments (K,) of the motion q (S, n) between whose ends it deviates from the path by more than allowed."""
    tolerances = np.where(
        np.array(search.solver.rows.units) == "m",
        PATH_TOLERANCE[0] * max(search.solver.arm.length_unit, 1.0),
        PATH_TOLERANCE[1],
    )
    inner_configurations = q[:-1, None] + _INNER_FRACTIONS[:, None] * np.diff(q, axis=0)[:, None]
    inner_fractions = fractions[:-1, None] + _INNER_FRACTIONS * np.diff(fractions)[:, None]
    path_errors = np.abs(
        search.solver.compute_errors(inner_configurations.reshape(-1, q.shape[1]), path.pose(inner_fractions.ravel()))
    ).reshape(*inner_fractions.shape, search.solver.rows.m)
    return np.flatnonzero((path_errors > tolerances).any(axis=(1, 2)))


def refine_waypoints(rest: RestOfPath, search: PoseSearch, path: Path, q: FloatArray) -> tuple[RestOfPath, FloatArray] | None:
    """Add waypoints to the motion q (S, n) wherever it deviates from the path between two; None if this fails.

    Near a singular configuration joints move fast, and straight lines in joint space are not straight lines of the tool.
    """
    fractions, is_reached = rest.share, rest.found
    for _ in range(_MAX_WAYPOINT_BISECTIONS):
        segments = _find_deviating_segments(search, path, fractions, q)
        if not segments.size:
            return replace(
                add_motion_with_deviation(replace(rest, share=fractions, found=is_reached), search.solver, path, q), q=q
            ), q
        middle_fractions, midpoints = (fractions[segments] + fractions[segments + 1]) / 2, (q[segments] + q[segments + 1]) / 2
        poses, row_masks = path.pose(middle_fractions), search.make_row_masks(len(segments))
        new_waypoints = search.solve(midpoints, poses, row_masks)
        is_valid = search.meets_rows(new_waypoints, poses, row_masks)
        # Otherwise the motion is on another branch.
        is_valid &= np.abs(new_waypoints - midpoints).max(axis=1) <= np.abs(q[segments + 1] - q[segments]).max(axis=1)
        if not (
            is_valid.all()
            and search.space.are_segments_valid(q[segments], new_waypoints).all()
            and search.space.are_segments_valid(new_waypoints, q[segments + 1]).all()
        ):
            return None
        q = np.insert(q, segments + 1, new_waypoints, axis=0)
        fractions = np.insert(fractions, segments + 1, middle_fractions)
        is_reached = np.insert(is_reached, segments + 1, True)
    return None
