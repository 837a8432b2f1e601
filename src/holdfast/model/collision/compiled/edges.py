"""Straight edges in joint space, checked and proved by compiled code, and routes that are made of them."""

from __future__ import annotations

from ctypes import Structure, addressof, byref, c_float, c_int64, c_void_p

import numpy as np
from numpy.typing import NDArray

from holdfast.core.typing import BoolArray, FloatArray
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.compiled.library import list_fields, load_library
from holdfast.model.collision.compiled.scene import MAX_JOINTS, MAX_PARTS, CompiledScene, SceneTables

CHECK_SPACING_M = 0.05  # largest possible motion between the configurations that are checked before a proof
_MAX_WAYPOINTS = 256  # as in route_search.cpp
_MAX_NODES = 20_000  # nodes of each tree
_MAX_SHORTCUT_FAILURES = 40  # shortcuts in a row that do not help, after which the route counts as short
_TREE_STEP = 1.0  # length of a step of a tree if the joints have weight 1, rad


class EdgeChecker:
    """Checks and proofs that straight edges keep their distance from objects and from the arm itself.

    Args:
        clearance: Collision model; see :meth:`supports`.
        margin: Required distance in addition to the margins of objects, m.
        lipschitz_bounds: (P, n) bounds of the change of each pair's distance; see :meth:`Clearance.lipschitz_bounds`.
        overlaps: (P,) length by which each pair may be closer than required, m. None: 0.
    """

    def __init__(
        self, clearance: Clearance, margin: float, lipschitz_bounds: FloatArray, overlaps: FloatArray | None = None
    ) -> None:
        no_overlaps = np.zeros(len(lipschitz_bounds))
        tables = SceneTables.from_clearance(clearance, margin, lipschitz_bounds, no_overlaps if overlaps is None else overlaps)
        self.library = load_library()
        self.single, self.double = CompiledScene(tables, np.float32), CompiledScene(tables, np.float64)

    @staticmethod
    def supports(clearance: Clearance) -> bool:
        """Return whether the clearance has only capsules and objects with a distance formula, and few enough of them."""
        obstacles = clearance.obstacles
        is_small = clearance.arm.n <= MAX_JOINTS and len(clearance.capsules) <= MAX_PARTS
        return type(clearance) is Clearance and is_small and (obstacles is None or obstacles.has_only_formulas)

    def check_edges(self, starts: FloatArray, differences: FloatArray, room: float = 0.0) -> BoolArray:
        """Return (E,) True where no configuration that is checked along the edges (E, n) is in contact; this proves nothing.

        Args:
            starts: (E, n) first configurations, which are not checked.
            differences: (E, n) last minus first configurations.
            room: Distance in addition to the required one, m.
        """
        a, b = (np.ascontiguousarray(values, dtype=np.float32) for values in (starts, differences))
        is_free = np.zeros(len(a), dtype=np.bool_)
        self.library.check_edges(
            self.single.address, a.ctypes.data, b.ctypes.data, len(a), CHECK_SPACING_M, room, is_free.ctypes.data
        )
        return is_free

    def prove_edges(
        self, starts: FloatArray, differences: FloatArray, deviations: FloatArray | None, resolution: float
    ) -> BoolArray:
        """Return (E,) True where edges (E, n), and all configurations within ``deviations`` (E, n) of them, are proved free.

        Args:
            starts: (E, n) first configurations.
            differences: (E, n) last minus first configurations.
            deviations: (E, n) largest deviations of each joint from the edges; None: 0.
            resolution: Change of distances, m, below which a piece that is not proved counts as blocked.
        """
        a, b = np.ascontiguousarray(starts), np.ascontiguousarray(differences)
        c = np.zeros_like(a) if deviations is None else np.ascontiguousarray(deviations)
        is_proved = np.zeros(len(a), dtype=np.bool_)
        self.library.prove_edges(
            self.double.address, *(values.ctypes.data for values in (a, b, c)), len(a), resolution, is_proved.ctypes.data
        )
        return np.asarray(is_proved & np.isfinite(a + b + c).all(axis=1))


class _ProblemAddresses(Structure):
    """Structure ``Problem`` of route_search.cpp."""

    _fields_ = (
        *list_fields(c_void_p, "low high scale revolution"),
        *list_fields(c_int64, "has_largest_joint_metric max_nodes max_rounds max_shortcut_failures"),
        *list_fields(c_void_p, "nodes parents"),
        *list_fields(c_float, "largest_step sample_spacing room"),
    )


class RouteSearch:
    """Search for short routes between configurations by two trees that grow towards each other (RRT-Connect).

    Args:
        edges: Checks of edges.
        low, high: (n,) box of the samples; equal for joints that do not move.
        scale: (n,) scale of each joint in lengths; 0 for joints that do not move.
        is_unlimited: (n,) True for joints without limits.
        has_largest_joint_metric: Length is the largest scaled motion of a joint, instead of the Euclidean norm.
    """

    def __init__(
        self,
        edges: EdgeChecker,
        low: FloatArray,
        high: FloatArray,
        scale: FloatArray,
        is_unlimited: BoolArray,
        has_largest_joint_metric: bool,
    ) -> None:
        self.edges, self._n = edges, len(low)
        self._arrays = [_pad_rows(values) for values in (low, high, scale, np.where(is_unlimited, 2 * np.pi, 0.0))]
        self._nodes = np.empty((2, _MAX_NODES, MAX_JOINTS), dtype=np.float32)
        self._parents = np.empty((2, _MAX_NODES), dtype=np.int32)
        self._problem = _ProblemAddresses(
            *(array.ctypes.data for array in self._arrays),
            has_largest_joint_metric,
            _MAX_NODES,
            0,
            0,
            self._nodes.ctypes.data,
            self._parents.ctypes.data,
            _TREE_STEP * float(scale.max()),
        )

    def search(
        self, start: FloatArray, goals: FloatArray, seed: int, *, max_rounds: int, spacing: float, room: float
    ) -> tuple[FloatArray, int] | None:
        """Return waypoints (K, n) from a start to a goal, and the index of the goal; None if the trees do not meet.

        The edges between the waypoints are checked, not proved. All waypoints except the ends have single precision.

        Args:
            start: (n,) start configuration.
            goals: (G, n) goal configurations, any of which may be reached.
            seed: Seed of the samples.
            max_rounds: Number of samples.
            spacing: Largest possible motion between checked configurations, m.
            room: Distance in addition to the required one, m.
        """
        problem, route, goal = self._problem, np.zeros((_MAX_WAYPOINTS, MAX_JOINTS), dtype=np.float32), c_int64(-1)
        problem.max_rounds, problem.max_shortcut_failures = max_rounds, _MAX_SHORTCUT_FAILURES
        problem.sample_spacing, problem.room = spacing, room
        start_row, goal_rows = _pad_rows(start[None]), _pad_rows(goals)
        count = self.edges.library.search_route(
            self.edges.single.address,
            addressof(problem),
            start_row.ctypes.data,
            goal_rows.ctypes.data,
            len(goals),
            seed,
            route.ctypes.data,
            byref(goal),
        )
        return None if count <= 0 else (route[:count, : self._n].astype(np.float64), goal.value)

    def shorten(self, q: FloatArray, seed: int, *, max_failures: int, spacing: float, room: float) -> FloatArray:
        """Return the waypoints of a shorter route between the ends of ``q`` (K, n), whose edges are checked, not proved.

        Args:
            q: (K, n) waypoints of a route.
            seed: Seed of the shortcuts.
            max_failures: Number of shortcuts in a row that do not help, after which the route counts as short.
            spacing: Largest possible motion between checked configurations, m.
            room: Distance in addition to the required one, m.
        """
        if not 2 < len(q) <= _MAX_WAYPOINTS:
            return q
        problem, route = self._problem, np.zeros((_MAX_WAYPOINTS, MAX_JOINTS), dtype=np.float32)
        problem.max_shortcut_failures, problem.sample_spacing, problem.room = max_failures, spacing, room
        route[: len(q)] = _pad_rows(q)
        count = self.edges.library.shorten(self.edges.single.address, addressof(problem), route.ctypes.data, len(q), seed)
        return route[:count, : self._n].astype(np.float64)


def _pad_rows(values: FloatArray) -> NDArray[np.float32]:
    """Return values (..., n) in single precision, with as many columns as the compiled code has joints."""
    padded = np.zeros((*values.shape[:-1], MAX_JOINTS), dtype=np.float32)
    padded[..., : values.shape[-1]] = values
    return padded
