"""March through slabs of lock instants by cells from the lock to the end of the path, in which one motion continues."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from time import monotonic

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.tool_paths.cells import PATH_CENTER_UNIT, SEGMENT_INSTANTS, LockSlab, PathCellBatch, PathFormBatch
from holdfast.certificates.tool_paths.forms import LockedTrackingEnclosure
from holdfast.certificates.tool_paths.loop_closure import LoopClosureExclusion, RefutedInterval
from holdfast.certificates.tree import SearchState
from holdfast.core.typing import IndexArray

TangentPassage = tuple[list[int], list[IndexArray], PathFormBatch]  # ends, centers, and form of the last cell

MIN_SINGULAR_HALVINGS = 2  # bisections of a slab before its cells are turned
_MAX_TANGENT_CELLS = 24  # consecutive turned cells
_CENTER_STEP = 0.8  # distance to the middle of the next turned cell, in half widths
_HALF_WIDTHS = 0.5 * 0.5 ** np.arange(16)  # half widths that are tried
_MAX_ACTIVE_SLABS = 64  # slabs that march in parallel


def march_through_singularity(enclosure: LockedTrackingEnclosure, slabs: Sequence[LockSlab]) -> list[TangentPassage | None]:
    """March slabs through a singularity by tangent cells and one plain cell after them; None for a slab without a passage."""
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
    """Return the longest plain cells after tangent cells, with their starts and ends; None if there is none."""
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


class LockSlabSearch:
    """Search for proofs of the slabs of one lock.

    Args:
        enclosure: Enclosure of the locked arm on the path.
        slabs: Slabs of lock instants.
        halvings: Largest number of bisections of a slab.
        max_nodes: Number of examined cells after which no further slab begins.
        exclusion: Test that refutes slabs without a motion; None for no test.
        claimed_instants: Number of instants in the claim, to which the fractions of the state refer.

    Attributes:
        proved: Proved slabs, not sorted.
        refuted: Refuted slabs, not sorted.
        nodes: Number of examined cells and boxes.
        closed_instants: Number of instants in finished slabs.
    """

    def __init__(
        self,
        enclosure: LockedTrackingEnclosure,
        slabs: Sequence[LockSlab],
        halvings: int,
        max_nodes: float = np.inf,
        exclusion: LoopClosureExclusion | None = None,
        claimed_instants: int = 1,
    ) -> None:
        self.enclosure, self._max_halvings, self._max_nodes, self._exclusion = enclosure, halvings, max_nodes, exclusion
        self._path_end = (len(enclosure.knots) - 1) * SEGMENT_INSTANTS
        self.proved, self.refuted = list[LockSlab](), list[RefutedInterval]()
        self.nodes, self.closed_instants, self._claimed_instants = 0, 0, claimed_instants
        self._waiting = deque(slab.restarted_slab for slab in slabs)
        self._active, self._failed, self._hopeless = list[LockSlab](), list[LockSlab](), list[LockSlab]()
        self._previous = enclosure.empty_form.select(np.empty(0, dtype=np.int64))

    def run(self, deadline: float, should_stop: Callable[[], bool], report_progress: Callable[[], None]) -> bool:
        """Search until a monotonic time or a stop request; return True if only slabs that were not started remain."""
        while monotonic() < deadline and not should_stop():
            if self.nodes < self._max_nodes:
                self._activate_slabs()
            if self._hopeless:  # this takes little time
                self._refute_or_halve_slab(self._hopeless.pop())
            elif self._active:
                self._try_next_cells()
            elif self._failed:
                self._pass_or_split_failed()
            else:
                break
            report_progress()
        return not (self._active or self._failed or self._hopeless or (self._waiting and self.nodes < self._max_nodes))

    @property
    def deferred_slabs(self) -> tuple[LockSlab, ...]:
        """Slabs that were not started, in order."""
        return tuple(slab.restarted_slab for slab in sorted(self._waiting, key=lambda slab: slab.begin))

    @property
    def state(self) -> SearchState:
        """Progress, as fractions of the lock instants of one joint."""
        proved, refuted = (sum(span.stop - span.begin for span in spans) for spans in (self.proved, self.refuted))
        total = self._claimed_instants
        return SearchState(
            proved=proved / total,
            refuted=refuted / total,
            undecided=(self.closed_instants - proved - refuted) / total,
            open=1 - self.closed_instants / total,
            nodes=self.nodes,
        )

    def _activate_slabs(self) -> None:
        """Activate waiting slabs while there is capacity."""
        new_slabs = [self._waiting.popleft() for _ in range(min(_MAX_ACTIVE_SLABS - len(self._active), len(self._waiting)))]
        self._active += new_slabs
        forms = [slab.last_form or self.enclosure.empty_form for slab in new_slabs]
        self._previous = PathFormBatch.concatenate([self._previous, *forms])
        for slab in new_slabs:
            slab.last_form = None

    def _try_next_cells(self) -> None:
        """Try the next cell of each active slab, and accept it, halve its length, or abandon the slab."""
        enclosure, slabs, previous = self.enclosure, self._active, self._previous
        begin, stop, start, end = (np.array([getattr(slab, key) for slab in slabs]) for key in ("begin", "stop", "at", "next"))
        cells = PathCellBatch(begin, stop, start, end, np.zeros(len(slabs), dtype=np.int64))
        is_first = np.array([not slab.ends for slab in slabs])
        distances = previous.half[:, 1] + cells.half_widths[:, 1]
        q = enclosure.predict_cell_centers(previous, cells, distances)
        q[is_first] = enclosure.healthy_joints_and_rates(cells.start + cells.end, cells.end)[0][is_first]
        q = enclosure.solve_centers(q, cells)
        center_units = np.round(q / PATH_CENTER_UNIT).astype(np.int64)
        center_units[:, enclosure.driven] = 0
        forms = enclosure.enclose_cell_motions(q, cells)
        self.nodes += len(slabs)
        accepted, active_rows = enclosure.continue_motion(is_first, previous, forms, cells), []
        for index, slab in enumerate(slabs):
            if accepted[index]:
                slab.ends.append(slab.next)
                slab.centers.append(center_units[index])
                slab.lengthen_step()
            elif not slab.has_shortest_step:
                slab.step //= 2
            else:
                slab.last_form = previous.select(np.array([index]))
                self._failed.append(slab)
                continue
            if slab.at < self._path_end:
                active_rows.append(index)
            else:
                self._record_proved(slab)
        rows = np.flatnonzero(accepted)
        self._previous = previous.replace_rows(rows, forms.select(rows)).select(np.array(active_rows, dtype=np.int64))
        self._active = [slabs[index] for index in active_rows]

    def _record_proved(self, slab: LockSlab) -> None:
        """Record a slab as proved."""
        self.proved.append(slab)
        self.closed_instants += slab.stop - slab.begin

    def _pass_singularities(self, slabs: list[LockSlab]) -> list[LockSlab]:
        """March slabs through singularities by tangent cells and one plain cell; return the slabs that fail."""
        enclosure = self.enclosure
        candidates = [] if len(enclosure.tube) else [slab for slab in slabs if slab.halvings >= MIN_SINGULAR_HALVINGS]
        for slab, passage in zip(candidates, march_through_singularity(enclosure, candidates), strict=True):
            if passage is None:
                continue
            ends, centers, slab.last_form = passage
            slabs = [other for other in slabs if other is not slab]
            self.nodes += len(ends)
            slab.ends += ends
            slab.centers += centers
            slab.step = slab.at & -slab.at
            slab.lengthen_step()
            if slab.at < self._path_end:
                self._waiting.append(slab)
            else:
                self._record_proved(slab)
        return slabs

    def _pass_or_split_failed(self) -> None:
        """Continue failed slabs by tangent cells, or split them, if single lock instants can be followed to the end."""
        slabs, self._failed = self._failed, []
        locks = np.array([(slab.begin, (slab.begin + slab.stop) // 2, slab.stop) for slab in slabs])
        finishes = np.asarray(self.enclosure.can_finish_path(locks.ravel())).reshape(-1, 3)
        followed = [slab for slab, reached in zip(slabs, finishes, strict=True) if reached.all()]
        unsolved_ids = {id(slab) for slab in self._pass_singularities(followed)}
        for slab, reached in zip(slabs, finishes, strict=True):
            if reached.all() and id(slab) not in unsolved_ids:
                continue
            if not reached.any():
                self._hopeless.append(slab)
            elif slab.halvings == self._max_halvings:
                self.closed_instants += slab.stop - slab.begin
            else:
                self._waiting += slab.halves

    def _refute_or_halve_slab(self, slab: LockSlab) -> None:
        """Refute a slab without a motion from any examined instant, or queue its halves."""
        interval, may_split, nodes = (
            (None, False, 0) if self._exclusion is None else self._exclusion.refute_lock_interval(slab.begin, slab.stop)
        )
        self.nodes += nodes
        if interval is None and may_split and slab.halvings < self._max_halvings:
            self._hopeless += slab.halves
            return
        self.refuted += [] if interval is None else [interval]
        self.closed_instants += slab.stop - slab.begin
