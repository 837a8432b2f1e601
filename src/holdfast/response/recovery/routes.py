"""Search for a short route through joint space: a straight line if it is free, else two growing trees, then shortcuts."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from holdfast.core.progress import track
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kinematics.solvers import joint_space
from holdfast.model.collision.compiled.edges import RouteSearch
from holdfast.response.recovery.space import FreeSpace, JointMetric

_BATCH_SAMPLES = 48  # samples per round
MAX_ROUNDS = 200
BRIEF_ROUNDS = 16  # of a search along constraints before a proof is tried; 52 of 54 measured searches that succeeded took fewer
# Largest possible motion between checked configurations and room in addition to what is required, m, and number of samples.
_SEARCH_LEVELS = ((0.05, 2e-3, 5000), (0.02, 1e-3, 10_000), (0.005, 0.0, 10_000))
_EXACT_SEARCH_LEVELS = tuple((0.02, room, 5000) for room in (1e-3, 0.0, 0.0, -2e-3, -5e-3, -0.01, -0.02, -0.04))
_FINAL_SHORTENING = (0.01, 2e-4, 200)  # the same two lengths, and shortcuts in a row that do not help
_MAX_NODES = 12_000  # nodes of both trees together
_STEP_FRACTION = 0.15  # of the diagonal of the box: length of one step of a tree
_NODE_SPACING_STEPS = 5  # pieces of an extension from one node to the next
_SHORTCUTS_PER_ROUND = 64  # shortcuts tried per round
_SHORTCUT_WALKS = 24  # the same if constraints hold exactly
_STAGNANT_ROUNDS = 20  # rounds in which hardly any extension reaches a new region, after which a tree is exhausted
_NEW_REGION_FRACTION = 0.2  # of the reach: distance from every node of its tree at which an end is in a new region
_MAX_NEW_REGION_WALKS = 4  # extensions to new regions in these rounds, of 960
_MAX_GOAL_SEARCHES = 8  # goals that are searched for one by one
_MAX_IDLE_ROUNDS = 8  # rounds without improvement before the path counts as short


@dataclass(frozen=True)
class Route:
    """Route from a configuration to one of several goals, straight in joint space from waypoint to waypoint.

    Attributes:
        q: (K, n) waypoints, rad and m.
        length: Length in the metric, in its unit ``s`` or ``rad``.
        lower_bound: Lower bound on the length of any route to a goal: the straight line to the nearest one.
        goal: Index of the goal at its end.
        straight: True if the route is one straight line.
    """

    q: FloatArray
    length: float
    lower_bound: float
    goal: int
    straight: bool


def find_route(
    space: FreeSpace,
    metric: JointMetric,
    start: FloatArray,
    goals: FloatArray,
    search_count: int,
    rng: np.random.Generator,
    *,
    max_failures: int | None = None,
    max_rounds: int = MAX_ROUNDS,
    is_shortened: bool = True,
) -> Route | None:
    """Return the shortest route found from start (n,) to any of the goals (G, n), or None; all of them must be valid.

    Straight lines to all goals are tried first. Goals that could be nearer than the nearest one with a free line are then
    searched by trees that grow from both sides (RRT-Connect, Kuffner and LaValle 2000, here in batches), several times, and
    the results are shortened. With constraints, every line is an extension along them (:meth:`FreeSpace.extend_paths`), as in
    CBiRRT (Berenson, Srinivasa, Ferguson and Kuffner 2009). If a tree is exhausted twice without a route,
    :attr:`FreeSpace.closed_in` is its end. The search stops after ``max_failures`` failed searches, if given. Searches that are
    not compiled end after ``max_rounds`` rounds. If only reachability matters, the route need not be shortened.
    """
    goals = start + space.shortest_difference(goals, start)
    direct_lengths = metric.measure_length(goals - start)
    lower_bound = float(direct_lengths.min())
    order = np.argsort(direct_lengths, kind="stable")
    free_goals = np.flatnonzero(space.are_segments_valid(np.repeat(start[None], len(goals), axis=0), goals)[order])
    best_route: Route | None = None
    closed_in, failure_count = list[str](), 0
    compiled_search = space.compiled_search(metric, np.concatenate([start[None], goals]))
    if free_goals.size:
        nearest = int(order[free_goals[0]])
        best_route = Route(np.stack([start, goals[nearest]]), float(direct_lengths[nearest]), lower_bound, nearest, True)
    elif space.manifold is not None:
        extensions, has_arrived = space.extend_paths(metric, np.repeat(start[None], len(goals), axis=0), goals - start)
        candidates = [(np.concatenate([start[None], extensions[goal]]), goal) for goal in np.flatnonzero(has_arrived).tolist()]
        if candidates:
            q, goal = min(candidates, key=lambda candidate: float(metric.cumulative_length(candidate[0])[-1]))
            q = shorten_path(space, metric, q, rng) if is_shortened else q
            best_route = Route(q, float(metric.cumulative_length(q)[-1]), lower_bound, goal, False)
    for _ in track("searches for a route", range(search_count), most=True):
        length = np.inf if best_route is None else best_route.length
        closer_goals = np.flatnonzero(direct_lengths < length * (1 - 1e-9))
        if not closer_goals.size or space.is_time_over or (best_route is not None and space.manifold is not None):
            break  # along constraints a search takes long, and the bound hardly limits the possible improvement
        if failure_count == max_failures:
            break
        connection = None
        if compiled_search is not None:
            connection = _search_compiled(compiled_search, space, start, goals[closer_goals], rng)
        is_short = connection is not None
        # With exact distances, trees in Python are only worth their time while there is no route.
        needs_trees = compiled_search is None or (space.edges is None and best_route is None)
        if connection is None and needs_trees:
            connection = _search_bidirectional_trees(space, metric, start, goals[closer_goals], rng, max_rounds)
            closed_in.append(space.closed_in)
            if all(closed_in[-2:]) and len(closed_in) > 1:
                return None
        if connection is None:
            failure_count += 1
            continue
        q, goal = connection
        if is_shortened and not is_short:
            q = shorten_path(space, metric, q, rng)
        new_length = float(metric.cumulative_length(q)[-1])
        if new_length < length:
            best_route = Route(q, new_length, lower_bound, int(closer_goals[goal]), len(q) == 2)
    space.closed_in = ""
    if is_shortened and best_route is not None and not best_route.straight and compiled_search is not None:
        q = _shorten_compiled(compiled_search, space, best_route.q, rng)
        best_route = replace(best_route, q=q, length=float(metric.cumulative_length(q)[-1]), straight=len(q) == 2)
    return best_route


def find_reachable_goals(
    space: FreeSpace, metric: JointMetric, start: FloatArray, goals: FloatArray, rng: np.random.Generator
) -> BoolArray:
    """Return (G,) True for the goals (G, n) to which a motion from start (n,) was found, straight or by one search each."""
    goals = start + space.shortest_difference(goals, start)
    is_reached = space.extend_paths(metric, np.repeat(start[None], len(goals), axis=0), goals - start)[1]
    for _ in range(_MAX_GOAL_SEARCHES):
        is_new = is_reached.copy()
        while is_new.any() and not is_reached.all():  # goals that are reachable from those just found
            unreached = np.flatnonzero(~is_reached)
            nearest = metric.measure_length(goals[unreached, None] - goals[is_new][None]).argmin(axis=1)
            sources = goals[is_new][nearest]
            is_new = np.zeros_like(is_reached)
            is_new[unreached] = space.extend_paths(metric, sources, goals[unreached] - sources)[1]
            is_reached |= is_new
        if is_reached.all() or space.is_time_over:
            break
        route = find_route(space, metric, start, goals[~is_reached], 1, rng, is_shortened=False)
        if route is None:
            break
        is_reached[np.flatnonzero(~is_reached)[route.goal]] = True
    return is_reached


def _search_compiled(
    search: RouteSearch, space: FreeSpace, start: FloatArray, goals: FloatArray, rng: np.random.Generator
) -> tuple[FloatArray, int] | None:
    """Return a short route from start (n,) to one of the goals (G, n) and the index of the goal, or None if none is proved.

    A route is searched with additional room and few checks. If its proof fails, the next search has less room and more
    checks. With exact distances, the spheres around the arm may overlap objects, by more in each search.
    """
    for spacing, room, sample_count in _EXACT_SEARCH_LEVELS if space.edges is None else _SEARCH_LEVELS:
        ends = np.concatenate([start[None], goals])
        has_room = search.edges.check_edges(ends, np.zeros_like(ends), room)
        if space.is_time_over or not (has_room[0] and has_room[1:].any()):
            continue
        seed = int(rng.integers(1 << 62))
        connection = search.search(start, goals, seed, max_rounds=sample_count, spacing=spacing, room=room)
        if connection is None:
            continue
        q, goal = connection
        # The trees may meet a full revolution apart from the goal that was given.
        q = _replace_ends(space, q, start, q[-1] + space.shortest_difference(goals[goal], q[-1]))
        if space.are_segments_valid(q[:-1], q[1:]).all():
            return q, goal
    return None


def _shorten_compiled(search: RouteSearch, space: FreeSpace, q: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Return a shorter route between the ends of q (K, n), or ``q`` if none is proved."""
    spacing, room, max_failures = _FINAL_SHORTENING
    shorter = search.shorten(q, int(rng.integers(1 << 62)), max_failures=max_failures, spacing=spacing, room=room)
    shorter = _replace_ends(space, shorter, q[0], q[-1])
    return shorter if space.are_segments_valid(shorter[:-1], shorter[1:]).all() else q


def _replace_ends(space: FreeSpace, q: FloatArray, first: FloatArray, last: FloatArray) -> FloatArray:
    """Return waypoints q (K, n) of single precision with exact ends, and exact values of the joints that do not move."""
    exact = space.clip_to_limits(q)
    exact[0], exact[-1] = first, last
    return np.where(space.free, exact, first)


class _RouteTree:
    """Configurations that can be reached from the roots, with the parent of each."""

    def __init__(self, space: FreeSpace, metric: JointMetric, roots: FloatArray) -> None:
        self._space, self._metric = space, metric
        self._is_unlimited = joint_space.is_unlimited(space.arm) & space.free
        self.nodes = roots.copy()
        self.parent = np.full(len(roots), -1)
        self._inner_points: dict[int, FloatArray] = {}
        self._embedded_nodes = self._embed_configurations(roots)

    def _embed_configurations(self, q: FloatArray) -> FloatArray:
        """Return points (N, e) whose distances order configurations about as the metric does: a revolute joint is a circle."""
        linear_part = (q * self._metric.scale)[:, self._space.free & ~self._is_unlimited]
        scales = self._metric.scale[self._is_unlimited]
        angles = q[:, self._is_unlimited]
        return np.concatenate([linear_part, scales * np.cos(angles), scales * np.sin(angles)], axis=1)

    def add_paths(self, extensions: list[FloatArray], parents: IndexArray) -> IndexArray:
        """Add paths (k, n) from parents, except empty ones, and return the last nodes of the others."""
        nodes, parent_nodes, last_nodes = list[FloatArray](), list[int](), list[int]()
        for extension, parent in zip(extensions, parents.tolist(), strict=True):
            for first in range(0, len(extension), _NODE_SPACING_STEPS):
                piece = extension[first : first + _NODE_SPACING_STEPS]
                node = len(self.nodes) + len(nodes)
                if len(piece) > 1:
                    self._inner_points[node] = piece[:-1]
                nodes.append(piece[-1])
                parent_nodes.append(parent)
                parent = node
            if len(extension):
                last_nodes.append(parent)
        if nodes:
            self.nodes = np.concatenate([self.nodes, nodes])
            self.parent = np.concatenate([self.parent, parent_nodes])
            self._embedded_nodes = np.concatenate([self._embedded_nodes, self._embed_configurations(np.stack(nodes))])
        return np.array(last_nodes, dtype=np.intp)

    def find_nearest(self, q: FloatArray) -> tuple[IndexArray, FloatArray]:
        """Return the node nearest to each q (N, n), and ``q`` minus that node (N, n)."""
        points, node_points = self._embed_configurations(q), self._embedded_nodes
        indices = ((node_points**2).sum(axis=1) - 2 * points @ node_points.T).argmin(axis=1)
        return indices, self._space.shortest_difference(q, self.nodes[indices])

    def trace_to_root(self, node: int) -> tuple[FloatArray, int]:
        """Return the configurations (K, n) from a node back to its root, and that root."""
        pieces, root = [], node
        while node >= 0:
            pieces += [self.nodes[node][None], self._inner_points.get(node, self.nodes[:0])[::-1]]
            root, node = node, int(self.parent[node])
        return np.concatenate(pieces), root


def _search_bidirectional_trees(
    space: FreeSpace, metric: JointMetric, start: FloatArray, goals: FloatArray, rng: np.random.Generator, max_rounds: int
) -> tuple[FloatArray, int] | None:
    """Return a route from start (n,) to one of the goals (G, n) and the index of the goal, or None after the last round."""
    start_tree, goal_tree = _RouteTree(space, metric, start[None]), _RouteTree(space, metric, goals)
    max_step = _STEP_FRACTION * float(metric.measure_length(np.where(space.free, space.high - space.low, 0.0)))
    space.closed_in = ""
    from_start, new_end_counts = True, {id(start_tree): list[int](), id(goal_tree): list[int]()}
    for _ in track("rounds of a search for a route", range(max_rounds), most=True):
        if len(start_tree.nodes) + len(goal_tree.nodes) > _MAX_NODES or space.is_time_over:
            break
        growing_tree, other_tree = (start_tree, goal_tree) if from_start else (goal_tree, start_tree)
        nearest_nodes, differences = growing_tree.find_nearest(space.sample(_BATCH_SAMPLES, rng))
        extensions, _ = space.extend_paths(
            metric, growing_tree.nodes[nearest_nodes], _limit_step(metric, differences, max_step)
        )
        if space.manifold is not None:
            counts = new_end_counts[id(growing_tree)]
            counts.append(_count_new_ends(metric, growing_tree, extensions, max_step))
            if len(counts) >= _STAGNANT_ROUNDS and sum(counts[-_STAGNANT_ROUNDS:]) <= _MAX_NEW_REGION_WALKS:
                space.closed_in = "start" if from_start else "goal"
                break
        new_nodes = growing_tree.add_paths(extensions, nearest_nodes)
        meeting_nodes = _grow_tree_to_nodes(space, metric, growing_tree, other_tree, new_nodes, max_step)
        if meeting_nodes is not None:
            return _join_branches(space, start_tree, goal_tree, meeting_nodes if from_start else meeting_nodes[::-1])
        from_start = not from_start
    return None


def _count_new_ends(metric: JointMetric, tree: _RouteTree, extensions: list[FloatArray], max_step: float) -> int:
    """Count the extensions that end far from every node of the tree."""
    ends = [extension[-1] for extension in extensions if len(extension)]
    lengths = metric.measure_length(tree.find_nearest(np.stack(ends))[1]) if ends else np.zeros(0)
    return int((lengths > _NEW_REGION_FRACTION * max_step).sum())


def _limit_step(metric: JointMetric, differences: FloatArray, max_step: float) -> FloatArray:
    lengths = metric.measure_length(differences)
    return np.asarray(differences * np.minimum(1.0, max_step / np.maximum(lengths, 1e-12))[:, None])


def _grow_tree_to_nodes(
    space: FreeSpace,
    metric: JointMetric,
    growing_tree: _RouteTree,
    other_tree: _RouteTree,
    new_nodes: IndexArray,
    max_step: float,
) -> tuple[int, int] | None:
    """Grow the other tree towards new nodes step by step, and return the two nodes where the trees meet."""
    targets, is_constrained = new_nodes, space.manifold is not None
    while targets.size:
        nearest_nodes, differences = other_tree.find_nearest(growing_tree.nodes[targets])
        extensions, has_arrived = space.extend_paths(
            metric,
            other_tree.nodes[nearest_nodes],
            differences if is_constrained else _limit_step(metric, differences, max_step),
        )
        arrived = has_arrived if is_constrained else has_arrived & (metric.measure_length(differences) <= max_step)
        if arrived.any():
            index = int(np.flatnonzero(arrived)[0])
            last_nodes = other_tree.add_paths([extensions[index][:-1]], nearest_nodes[index : index + 1])
            return int(targets[index]), int(last_nodes[0] if last_nodes.size else nearest_nodes[index])
        other_tree.add_paths(extensions, nearest_nodes)
        targets = targets[:0] if is_constrained else targets[has_arrived]
    return None


def _join_branches(
    space: FreeSpace, start_tree: _RouteTree, goal_tree: _RouteTree, meeting_nodes: tuple[int, int]
) -> tuple[FloatArray, int]:
    (start_branch, _) = start_tree.trace_to_root(meeting_nodes[0])
    (goal_branch, root) = goal_tree.trace_to_root(meeting_nodes[1])
    # The trees may meet a full revolution apart: the rest of the path is shifted by full revolutions.
    shift = start_branch[0] + space.shortest_difference(goal_branch[0], start_branch[0]) - goal_branch[0]
    return np.concatenate([start_branch[::-1], goal_branch + shift]), root


def shorten_path(space: FreeSpace, metric: JointMetric, q: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Shorten the path q (K, n) by straight segments between random points of it, until this no longer helps."""
    if space.manifold is not None and space.manifold.has_equalities:
        return _remove_waypoints(space, _shorten_on_constraints(space, metric, q, rng))
    idle_rounds = 0
    while len(q) > 2 and idle_rounds < _MAX_IDLE_ROUNDS and not space.is_time_over:
        lengths = metric.cumulative_length(q)
        ends = np.sort(rng.uniform(0, lengths[-1], (_SHORTCUTS_PER_ROUND, 2)), axis=1)
        # Whole segments from waypoint to waypoint are tried as well.
        ends[: _SHORTCUTS_PER_ROUND // 4] = np.sort(rng.choice(lengths, (_SHORTCUTS_PER_ROUND // 4, 2)), axis=1)
        cut_starts, cut_ends = (np.stack([np.interp(cuts, lengths, column) for column in q.T], axis=1) for cuts in ends.T)
        gains = ends[:, 1] - ends[:, 0] - metric.measure_length(cut_ends - cut_starts)
        useful = np.flatnonzero(gains > 1e-6 * lengths[-1])
        useful = useful[space.are_segments_valid(cut_starts[useful], cut_ends[useful])]
        if not useful.size:
            idle_rounds += 1
            continue
        best = useful[gains[useful].argmax()]
        idle_rounds = idle_rounds + 1 if gains[best] < 1e-4 * lengths[-1] else 0
        is_before, is_after = lengths < ends[best, 0] - 1e-12, lengths > ends[best, 1] + 1e-12
        q = np.concatenate([q[is_before], cut_starts[best][None], cut_ends[best][None], q[is_after]])
        q = q[np.concatenate([[True], metric.measure_length(np.diff(q, axis=0)) > 1e-12])]
    return _remove_waypoints(space, q)


def _shorten_on_constraints(space: FreeSpace, metric: JointMetric, q: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Shorten a path on which constraints hold exactly, by extensions along them from waypoint to waypoint."""
    idle_rounds = 0
    while len(q) > 2 and idle_rounds < _MAX_IDLE_ROUNDS and not space.is_time_over:
        lengths = metric.cumulative_length(q)
        first_points, last_points = np.sort(rng.integers(0, len(q), (_SHORTCUT_WALKS, 2)), axis=1).T
        extensions, has_arrived = space.extend_paths(metric, q[first_points], q[last_points] - q[first_points])
        gains = np.zeros(_SHORTCUT_WALKS)
        for index in np.flatnonzero(has_arrived).tolist():
            gains[index] = (
                lengths[last_points[index]]
                - lengths[first_points[index]]
                - metric.cumulative_length(np.concatenate([q[first_points[index]][None], extensions[index]]))[-1]
            )
        index = int(gains.argmax())
        idle_rounds = idle_rounds + 1 if gains[index] < 1e-3 * lengths[-1] else 0
        if gains[index] > 1e-6 * lengths[-1]:
            q = np.concatenate([q[: first_points[index] + 1], extensions[index], q[last_points[index] + 1 :]])
    return q


def _remove_waypoints(space: FreeSpace, q: FloatArray) -> FloatArray:
    """Remove waypoints that are not needed, where the path without one of them is proved free and not longer."""
    index = 1
    while index < len(q) - 1:
        if space.are_segments_valid(q[index - 1][None], q[index + 1][None])[0]:
            q = np.delete(q, index, axis=0)
        else:
            index += 1
    return q
