"""Proofs that no motion leads to the goal, by a flood fill over cells of all or some of the moving joints.

A cell is a box of joints. It is certainly blocked if a ball within a link, at the middle of the cell, is deeper in an object
than it can move within the cell, if the same is true of two links, or if a constraint is violated by more than it can change.
Other cells may be free. If those that are connected to the start through their faces contain no configuration of the goal, no
motion leads to it: a motion through a corner is free there, so none of the cells at this corner is blocked, and they are
connected through faces. Otherwise the cells are bisected.

A few of many joints suffice where these alone decide which cells are blocked, for example an elbow that is caught between two
objects for every angle of the wrist, or a gripper next to a forearm. The other joints may have any value within their limits.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice, product

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kinematics.interval_search.boxes import Blocked
from holdfast.kinematics.solvers import joint_space
from holdfast.model.collision.clearance import Clearance
from holdfast.response.recovery.proofs.blocked_cells import BlockedCells
from holdfast.response.recovery.space import FreeSpace

_MAX_JOINTS = 3  # largest number of moving joints
_INITIAL_CELLS_PER_JOINT = 8  # cells of each joint at first
_MAX_CELLS = {1: 20_000, 2: 80_000, 3: 120_000}  # evaluated cells, by the number of joints
_ROUNDING_SLACK = 1e-9  # rounding error, m and rad
_CHUNK_ROWS = 4096
_MAX_CONFINED_CELLS = 25_000  # evaluated cells over some of more than three joints
_MAX_CONFINED_JOINTS = 2  # joints of a flood in which the other joints may have any value
_MAX_CONFINED_FLOODS = 2  # such floods over the same joints
_MAX_CONSTRAINED_JOINTS = 4  # joints of a flood of all configurations that meet the tool constraints
_MAX_CONSTRAINED_CELLS = 1_500_000  # evaluated cells of such a flood, which take 2 s


def find_confined_regions(space: FreeSpace, start: FloatArray, known_goals: FloatArray) -> Iterator[ConnectedCells]:
    """Yield floods from a start (n,) that contain none of the known configurations (K, n) of the goal, at most two per set.

    They are over all moving joints, if there are at most three. Else they are over sets of joints that are confined for any
    values of the other joints: over those that change the errors of tool constraints, over one or two joints between two links
    that may touch each other, and over the first two, whose links touch objects.
    """
    if space.manifold is None and space.clearance is None:
        return
    blocked, joints = BlockedCells(space), np.flatnonzero(space.free)
    attempts: list[tuple[IndexArray, Blocked, int]] = []
    if len(joints) <= _MAX_JOINTS:
        attempts.append((joints, blocked, _MAX_CELLS[len(joints)]))
    else:
        constrained_joints = joints[:0] if space.manifold is None else np.flatnonzero(space.manifold.changing_joints)
        if 0 < len(constrained_joints) <= _MAX_CONSTRAINED_JOINTS:
            attempts.append((constrained_joints, blocked.are_blocked_without_objects, _MAX_CONSTRAINED_CELLS))
        if space.clearance is not None and blocked.self_blocked is not None:
            attempts += [
                (flood_joints, blocked.self_blocked.are_boxes_self_colliding, _MAX_CONFINED_CELLS)
                for flood_joints in _joint_sets_between_links(space.clearance, joints)
            ]
            first_joints = joints[:_MAX_CONFINED_JOINTS]
            attempts.append((first_joints, blocked.restrict_to_joints(first_joints), _MAX_CONFINED_CELLS))
    for flood_joints, is_blocked, max_cells in attempts:
        floods = _generate_connected_regions(space, start, flood_joints, is_blocked, max_cells)
        yield from islice(
            (flood for flood in floods if flood.excludes_boxes(known_goals, np.zeros_like(known_goals)).all()),
            _MAX_CONFINED_FLOODS,
        )


def _joint_sets_between_links(clearance: Clearance, joints: IndexArray) -> list[IndexArray]:
    """Return the sets of one or two joints between two links that may touch each other, the smallest first."""
    link_pairs = {tuple(sorted(clearance.capsules.parts[part].link for part in pair)) for pair in clearance.pairs}
    joint_sets = {
        tuple(joints[(joints > first_link) & (joints <= second_link)].tolist()) for first_link, second_link in link_pairs
    }
    return [
        np.array(joint_set)
        for joint_set in sorted(joint_sets, key=lambda joint_set: (len(joint_set), joint_set))
        if 0 < len(joint_set) <= _MAX_CONFINED_JOINTS
    ]


@dataclass(frozen=True, eq=False)
class ConnectedCells:
    """Cells of a flood that may be connected to the start.

    Attributes:
        names: Names of the f joints of the cells.
        joints, lower, cell_widths: (f,) joint indices, lower end of the first cell, and cell width, rad and m.
        is_unlimited: (f,) True for unlimited revolute joints.
        cells_per_joint: Number of cells of each joint.
        cells: (N, f) indices of the connected cells.
        checked_cells: Number of cells evaluated so far.
    """

    names: list[str]
    joints: IndexArray
    lower: FloatArray
    cell_widths: FloatArray
    is_unlimited: BoolArray
    cells_per_joint: int
    cells: IndexArray
    checked_cells: int

    @property
    def proof_sentence(self) -> str:
        """Sentence that these cells hold no configuration of the goal."""
        return (
            f"the values of {' and '.join(self.names)} that are connected to the start contain no configuration of the goal, "
            f"by a flood fill over {self.checked_cells:,} cells, up to {self.cells_per_joint} per joint, up to floating point"
        )

    @cached_property
    def _codes_by_level(self) -> list[IndexArray]:
        """Sorted codes of the connected cells, of the groups of 2 cells per joint that contain any, of 4, and so on."""
        levels = range(self.cells_per_joint.bit_length())
        return [np.unique(self._encode_cells(self.cells >> level)) for level in levels]

    def _encode_cells(self, cells: IndexArray) -> IndexArray:
        """Return a number for each of cells (N, f)."""
        return np.asarray(np.ravel_multi_index(tuple(cells.T), (self.cells_per_joint,) * cells.shape[1]))

    def excludes_boxes(self, q: FloatArray, half_widths: FloatArray) -> BoolArray:
        """Return (N,) True where no configuration within ``half_widths`` (N, n) of q (N, n) is in a connected cell.

        A box is compared with the cells, or with the smallest groups of cells of which it meets at most two per joint.
        """
        positions, widths = q[:, self.joints], half_widths[:, self.joints]
        positions = np.where(self.is_unlimited, np.arctan2(np.sin(positions), np.cos(positions)), positions)
        first_cells = np.floor((positions - widths - self.lower - _ROUNDING_SLACK) / self.cell_widths).astype(np.int64)
        last_cells = np.floor((positions + widths - self.lower + _ROUNDING_SLACK) / self.cell_widths).astype(np.int64)
        # Beyond a full revolution, any value is possible.
        last_cell = self.cells_per_joint - 1
        wraps_around = self.is_unlimited & ((first_cells < 0) | (last_cells > last_cell))
        first_cells, last_cells = np.where(wraps_around, 0, first_cells), np.where(wraps_around, last_cell, last_cells)
        is_excluded = np.asarray(((last_cells < 0) | (first_cells > last_cell)).any(axis=1))
        first_cells, last_cells = np.clip(first_cells, 0, last_cell), np.clip(last_cells, 0, last_cell)
        levels = np.ceil(np.log2(np.maximum((last_cells - first_cells).max(axis=1), 1))).astype(np.int64)
        for level in np.unique(levels[~is_excluded]):
            boxes = np.flatnonzero(~is_excluded & (levels == level))
            meets_any = np.zeros(len(boxes), dtype=bool)
            for corner in product((False, True), repeat=len(self.joints)):
                cells = np.where(corner, last_cells[boxes], first_cells[boxes]) >> level
                meets_any |= np.isin(self._encode_cells(cells), self._codes_by_level[level])
            is_excluded[boxes] = ~meets_any
        return is_excluded


def _generate_connected_regions(
    space: FreeSpace, start: FloatArray, joints: IndexArray, blocked: Blocked, max_cells: int
) -> Iterator[ConnectedCells]:
    """Yield floods from a start (n,) with repeatedly bisected cells; the other joints may have any value in their limits."""
    box = _bound_joints(space, joints)
    if box is None:
        return
    lower, upper, is_unlimited = box
    start_position = np.where(is_unlimited, np.arctan2(np.sin(start[joints]), np.cos(start[joints])), start[joints])
    cells_per_joint, checked_cells = _INITIAL_CELLS_PER_JOINT, 0
    cells = np.array(list(product(range(cells_per_joint), repeat=len(joints))), dtype=np.int64)
    center, half_widths = (space.low + space.high) / 2, (space.high - space.low) / 2
    while checked_cells + len(cells) <= max_cells and not space.is_time_over:
        half_widths = half_widths.copy()
        half_widths[joints] = (upper - lower) / (2 * cells_per_joint)
        middle = np.tile(center, (len(cells), 1))
        middle[:, joints] = lower + (2 * cells + 1) * half_widths[joints]
        checked_cells += len(cells)
        is_open = ~np.concatenate(
            [
                blocked(chunk, np.broadcast_to(half_widths, chunk.shape))
                for chunk in np.split(middle, range(_CHUNK_ROWS, len(cells), _CHUNK_ROWS))
            ]
        )
        cells, middle = cells[is_open], middle[is_open]
        distances = np.abs(middle[:, joints] - start_position)
        distances = np.where(is_unlimited, np.minimum(distances, 2 * np.pi - distances), distances)
        holds_start = (distances <= half_widths[joints] + _ROUNDING_SLACK).all(axis=1)
        if not holds_start.any():
            return  # the start is collision-free, so this cannot be
        is_connected = _connect_cells(cells, holds_start, cells_per_joint, is_unlimited)
        cells = cells[is_connected]
        yield ConnectedCells(
            [space.arm.joint_names[index] for index in joints],
            joints,
            lower,
            (upper - lower) / cells_per_joint,
            is_unlimited,
            cells_per_joint,
            cells,
            checked_cells,
        )
        cells = (2 * cells[:, None] + np.array(list(product((0, 1), repeat=len(joints))))).reshape(-1, len(joints))
        cells_per_joint *= 2


def _bound_joints(space: FreeSpace, free: IndexArray) -> tuple[FloatArray, FloatArray, BoolArray] | None:
    """Return the bounds of the free joints and which of them are unlimited; None if the bounds are not known."""
    lower, upper = space.arm.lower[free], space.arm.upper[free]
    is_unlimited = joint_space.is_unlimited(space.arm)[free]
    lower, upper = np.where(is_unlimited, -np.pi, lower), np.where(is_unlimited, np.pi, upper)
    return (lower, upper, is_unlimited) if np.isfinite([lower, upper]).all() and (upper > lower).all() else None


def _connect_cells(cells: IndexArray, holds_start: BoolArray, cells_per_joint: int, is_unlimited: BoolArray) -> BoolArray:
    """Return (N,) True for cells (N, f) connected to a start cell through faces, also around unlimited joints."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    dimensions = (cells_per_joint,) * cells.shape[1]
    codes = np.ravel_multi_index(tuple(cells.T), dimensions)
    order = np.argsort(codes)
    sorted_codes = codes[order]
    first_cells, second_cells = [], []
    for joint in range(cells.shape[1]):
        neighbors = cells.copy()
        neighbors[:, joint] += 1
        if is_unlimited[joint]:
            neighbors[:, joint] %= cells_per_joint
        inside = np.flatnonzero(neighbors[:, joint] < cells_per_joint)
        neighbor_codes = np.ravel_multi_index(tuple(neighbors[inside].T), dimensions)
        positions = np.minimum(np.searchsorted(sorted_codes, neighbor_codes), len(sorted_codes) - 1)
        is_found = sorted_codes[positions] == neighbor_codes
        first_cells.append(inside[is_found])
        second_cells.append(order[positions[is_found]])
    row_indices, column_indices = np.concatenate(first_cells), np.concatenate(second_cells)
    _, labels = connected_components(
        coo_array((np.ones(len(row_indices)), (row_indices, column_indices)), shape=(len(cells),) * 2), directed=False
    )
    return np.isin(labels, labels[holds_start])
