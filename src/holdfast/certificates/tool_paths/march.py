"""March through slabs of lock instants: cells from the lock to the end of the path, in which one motion continues."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from time import monotonic

import numpy as np

from holdfast.certificates.tool_paths.cells import PATH_CENTER_UNIT, SEGMENT_INSTANTS, LockSlab, PathCellBatch, PathFormBatch
from holdfast.certificates.tool_paths.forms import LockedTrackingEnclosure
from holdfast.certificates.tool_paths.loop_closure import LoopClosureExclusion, RefutedInterval
from holdfast.certificates.tool_paths.singular_cells import MIN_SINGULAR_HALVINGS, march_through_singularity
from holdfast.certificates.tree import SearchState

_MAX_ACTIVE_SLABS = 64  # slabs that march side by side


@dataclass(frozen=True, kw_only=True)
class LockedPath:
    """Result of the search for the lock of one joint.

    Attributes:
        joint: Index of it.
        followers: Of joints that go on with the healthy motion, as more are left than the task has rows.
        slabs: Intervals of lock instants that are proved, in order, each with its cells.
        refuted_intervals: Those that are refuted, in order.
        proved, refuted: Exact parts of the lock instants.
        nodes: Cells that were looked at.
        finished: False if the search was stopped.
        seconds: Measured.
    """

    joint: int
    followers: tuple[int, ...]
    slabs: tuple[LockSlab, ...]
    refuted_intervals: tuple[RefutedInterval, ...]
    proved: Fraction
    refuted: Fraction
    nodes: int
    finished: bool
    seconds: float

    @property
    def proved_lock_intervals(self) -> list[tuple[int, int]]:
        """Proved intervals of lock instants."""
        return [(slab.begin, slab.stop) for slab in self.slabs]

    @property
    def refuted_lock_intervals(self) -> list[tuple[int, int]]:
        """Refuted intervals of lock instants."""
        return [(interval.begin, interval.stop) for interval in self.refuted_intervals]

    @property
    def undecided(self) -> Fraction:
        """Exact fraction of the lock instants that is neither proved nor refuted."""
        return 1 - self.proved - self.refuted

    @property
    def leaves(self) -> int:
        """Number of cells of proved slabs and of joint boxes that refute others."""
        joint_boxes = sum(1 + len(interval.tree) for interval in self.refuted_intervals) // 2
        return sum(len(slab.ends) for slab in self.slabs) + joint_boxes


class LockSlabSearch:
    """The search for one lock.

    Args:
        enclosure: The locked arm and the path.
        slabs: Of lock instants.
        halvings: Of slabs, at most.
        max_nodes: Cells that are looked at before no more slabs begin.
        exclusion: What refutes slabs that lead nowhere; None: nothing does.
        claimed_instants: Instants of the claim, of which the state tells fractions.

    Attributes:
        proved: Slabs, in no order.
        refuted: Refuted ones, in no order.
        nodes: Cells and boxes that were looked at.
        closed_instants: Instants of slabs that are done with.
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
            if self._hopeless:  # it takes little
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
        instants = {"proved": proved, "refuted": refuted, "undecided": self.closed_instants - proved - refuted}
        fractions = {key: count / self._claimed_instants for key, count in instants.items()}
        return SearchState(**fractions, open=1 - self.closed_instants / self._claimed_instants, nodes=self.nodes)

    def _activate_slabs(self) -> None:
        """Activate waiting slabs while there is capacity."""
        new_slabs = [self._waiting.popleft() for _ in range(min(_MAX_ACTIVE_SLABS - len(self._active), len(self._waiting)))]
        self._active += new_slabs
        forms = [slab.last_form or self.enclosure.empty_form for slab in new_slabs]
        self._previous = PathFormBatch.concatenate([self._previous, *forms])
        for slab in new_slabs:
            slab.last_form = None

    def _try_next_cells(self) -> None:
        """Try the next cell of each active slab: accept it, halve its length, or give the slab up."""
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
        """March slabs through singularities by tangent cells and one plain cell; return the slabs for which that fails."""
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
        """March failed slabs on through tangent cells, or split them, if single lock instants can be followed to the end."""
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
        """Refute a slab from no examined instant of which a motion was found, or queue its halves."""
        interval, may_split, nodes = (
            (None, False, 0) if self._exclusion is None else self._exclusion.refute_lock_interval(slab.begin, slab.stop)
        )
        self.nodes += nodes
        if interval is None and may_split and slab.halvings < self._max_halvings:
            self._hopeless += slab.halves
            return
        self.refuted += [] if interval is None else [interval]
        self.closed_instants += slab.stop - slab.begin
