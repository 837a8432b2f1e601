"""Tangent cells along the motion of a locked arm near its singularities, for many slabs in parallel."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.tool_paths.cells import PATH_CENTER_UNIT, SEGMENT_INSTANTS, LockSlab, PathCellBatch, PathFormBatch
from holdfast.certificates.tool_paths.forms import LockedTrackingEnclosure
from holdfast.core.typing import IndexArray

TangentPassage = tuple[list[int], list[IndexArray], PathFormBatch]  # ends, centres, and what is found in the last cell

MIN_SINGULAR_HALVINGS = 2  # halvings of a slab before its cells are turned
_MAX_TANGENT_CELLS = 24  # cells in a row
_CENTER_STEP = 0.8  # the middle of one, in half widths ahead
_HALF_WIDTHS = 0.5 * 0.5 ** np.arange(16)  # half widths


def march_through_singularity(enclosure: LockedTrackingEnclosure, slabs: Sequence[LockSlab]) -> list[TangentPassage | None]:
    """March slabs through a singularity by tangent cells and one plain cell behind them; None for a slab without such a
    passage.
    """
    passages: list[TangentPassage | None] = [None] * len(slabs)
    if not slabs:
        return passages
    begin, stop, reached = (np.array([getattr(slab, key) for slab in slabs]) for key in ("begin", "stop", "at"))
    segment_starts, is_first = reached // SEGMENT_INSTANTS * SEGMENT_INSTANTS, np.array([not slab.ends for slab in slabs])
    previous = PathFormBatch.concatenate([slab.last_form or enclosure.empty_form for slab in slabs])
    q, path_position = enclosure.cell_end_configurations(previous)
    q[is_first] = enclosure.healthy_joints_and_rates(begin + stop, stop)[0][is_first]
    path_position[is_first] = ((begin + stop) / (2 * SEGMENT_INSTANTS))[is_first]
    cell_lists = [(list[int](), list[IndexArray]()) for _ in slabs]
    active = np.arange(len(slabs))
    for _ in range(_MAX_TANGENT_CELLS):
        owners, step_widths = np.repeat(active, len(_HALF_WIDTHS)), np.tile(_HALF_WIDTHS, len(active))
        middles, instants = enclosure.step_along_tangent(
            q[owners], path_position[owners], segment_starts[owners], _CENTER_STEP * step_widths
        )
        inside = np.flatnonzero((instants > segment_starts[owners]) & (instants <= segment_starts[owners] + SEGMENT_INSTANTS))
        owners, middles, instants = owners[inside], middles[inside], instants[inside]
        half_widths = np.rint(step_widths[inside] / PATH_CENTER_UNIT).astype(np.int64)
        cells = PathCellBatch(begin[owners], stop[owners], instants, instants, half_widths)
        forms = enclosure.enclose_cell_motions(enclosure.set_driven_joints(middles, cells), cells)
        accepted = np.flatnonzero(enclosure.continue_motion(is_first[owners], previous.select(owners), forms, cells))
        active, widest = np.unique(owners[accepted], return_index=True)
        if not active.size:
            break
        chosen = accepted[widest]
        chosen_forms = forms.select(chosen)
        previous, is_first[active] = previous.replace_rows(active, chosen_forms), False
        for slab_index, row in zip(active.tolist(), chosen.tolist(), strict=True):
            center = _encode_center(enclosure, forms.q[row], int(instants[row] - segment_starts[slab_index]))
            cell_lists[slab_index][0].append(-int(half_widths[row]))
            cell_lists[slab_index][1].append(center)
        plain_cells = _find_nontangent_cells(enclosure, (begin[active], stop[active]), segment_starts[active], chosen_forms)
        for slab_index, plain_cell in zip(active.tolist(), plain_cells, strict=True):
            if plain_cell is not None:
                (form, start, end), (ends, centers) = plain_cell, cell_lists[slab_index]
                center = _encode_center(enclosure, form.q[0], start - int(segment_starts[slab_index]))
                passages[slab_index] = [*ends, end], [*centers, center], form
        active = np.array([slab_index for slab_index in active.tolist() if passages[slab_index] is None], dtype=np.int64)
        q, path_position = enclosure.cell_end_configurations(previous)
    return passages


def _find_nontangent_cells(
    enclosure: LockedTrackingEnclosure,
    slab_bounds: tuple[IndexArray, IndexArray],
    segment_starts: IndexArray,
    previous: PathFormBatch,
) -> list[tuple[PathFormBatch, int, int] | None]:
    """Return the longest plain cells behind tangent cells, with their starts and ends; None where there is none."""
    q, path_position = enclosure.cell_end_configurations(previous)
    response, half = np.abs(previous.own[:, -1]), previous.half
    spread = response[:, 0] * half[:, 0] + (response[:, 2:] * half[:, 2:]).sum(axis=1)
    lower = np.floor((path_position - 1.01 * spread) * SEGMENT_INSTANTS).astype(np.int64)
    upper = np.floor((path_position + 1.01 * spread) * SEGMENT_INSTANTS).astype(np.int64) + 1
    starts, owners, ends = np.maximum(lower - 1, segment_starts), list[int](), list[int]()
    for index, (a, b, segment_end) in enumerate(
        zip(lower.tolist(), upper.tolist(), (segment_starts + SEGMENT_INSTANTS).tolist(), strict=True)
    ):
        candidates = {min((b >> d) + 1 << d, segment_end) for d in range(max(1, (b - a).bit_length() - 1), 20)}
        valid_ends = sorted(end for end in candidates if end > b)
        owners, ends = owners + [index] * len(valid_ends), ends + valid_ends
    plain_cells: list[tuple[PathFormBatch, int, int] | None] = [None] * len(lower)
    if owners:
        rows = np.array(owners)
        begin, stop = (bounds[rows] for bounds in slab_bounds)
        cells = PathCellBatch(begin, stop, starts[rows], np.array(ends), np.zeros_like(rows))
        forms = enclosure.enclose_cell_motions(enclosure.solve_centers(q[rows], cells), cells)
        is_first = np.zeros(len(rows), dtype=bool)
        for index in np.flatnonzero(enclosure.continue_motion(is_first, previous.select(rows), forms, cells)).tolist():
            plain_cells[owners[index]] = forms.select(np.array([index])), int(starts[owners[index]]), ends[index]
    return plain_cells


def _encode_center(enclosure: LockedTrackingEnclosure, q: NDArray[np.float64], instant: int) -> IndexArray:
    """Return a center in units of the file."""
    row = np.round(q / PATH_CENTER_UNIT).astype(np.int64)
    row[enclosure.driven] = 0
    row[enclosure.driven[0]] = instant
    return np.asarray(row)
