"""Proofs that a tool path cannot be followed, from one of its poses or from a straight leg."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import chain
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from holdfast.core.errors import TaskError
from holdfast.kinematics.interval_search import prove_leg_impossible
from holdfast.model.arm.task import Task
from holdfast.model.failure_modes import Degraded
from holdfast.response.recovery.continuation import RestOfPath
from holdfast.response.recovery.goals import PoseSearch
from holdfast.response.recovery.problem import describe_goal_violation
from holdfast.response.recovery.proofs.reach import (
    EXACT_TOLERANCE,
    MAX_BOXES,
    Tolerance,
    make_blocked_boxes,
    prove_unreachable,
    prove_within_tolerance,
    search_pose,
)
from holdfast.response.recovery.recovery import Recovery
from holdfast.response.recovery.space import FreeSpace

if TYPE_CHECKING:
    from holdfast.kinematics.paths.path import Path

_Proof = TypeVar("_Proof")
TriedProofs = dict[tuple[Any, ...], Any]
"""Results of proofs by kind and place on the path; a second search with exact distances does not change them."""

_MAX_PROVED_POSES = 3  # poses of a path without a configuration for which a proof is tried


def prove_path_infeasible(recovery: Recovery, rest: RestOfPath, path: Path, search: PoseSearch, tried: TriedProofs) -> Recovery:
    """Return the recovery with a proof that the path cannot be followed, if there is one, and its validity within the
    tolerance.

    Args:
        recovery: Recovery so far.
        rest: Result along the path.
        path: Tool path.
        search: Solver of the rows that must be met, and the free space of the arm.
        tried: Results of proofs about this path, which are extended.
    """
    solver, space = search.solver, search.space
    fractions, is_reached, poses = rest.share, rest.found, path.pose(rest.share)
    order = list(coarse_to_fine_indices(len(poses)))
    hardest_samples = [sample for sample in order if not is_reached[sample]][:_MAX_PROVED_POSES]
    q_locked = np.where(space.free, recovery.at, recovery.degraded.lo)
    violations = ((sample, describe_goal_violation(recovery.keep, solver.rows, poses[sample])) for sample in order)
    reach_proofs = ((sample, prove_unreachable(solver, space.free, q_locked, poses[sample])) for sample in order)
    simple_proof = next(((sample, text) for sample, text in chain(violations, reach_proofs) if text), None)

    def recall(key: tuple[Any, ...], prove: Callable[[], _Proof]) -> _Proof:
        """Return the proof that was tried before, or else try it now."""
        if key not in tried:
            tried[key] = prove()
        proof: _Proof = tried[key]
        return proof

    def prove_within(sample: int) -> str | None:
        return recall(("within", fractions[sample]), lambda: prove_within_tolerance(recovery, search, poses[sample]))

    def prove_pose(sample: int) -> str | None:
        return recall(
            ("pose", fractions[sample]), lambda: prove_within(sample) or search_pose(recovery, space, poses[sample])[1]
        )

    def prove_leg(tolerance: Tolerance, first_leg: int) -> tuple[int, str] | None:
        request = (recovery.degraded, recovery.task, path, space, tolerance, first_leg)
        return recall(("leg", tolerance, first_leg), lambda: _prove_leg_impossible(*request))

    box_proofs = ((sample, prove_pose(sample)) for sample in hardest_samples)
    found_proof = simple_proof or next(((sample, text) for sample, text in box_proofs if text), None)
    if found_proof is None:
        leg_proof = prove_leg(EXACT_TOLERANCE, 0)
        if leg_proof is None:
            return recovery
        proved_leg, leg_sentence = leg_proof
        within = recovery.tolerance is not None and prove_leg(recovery.tolerance, proved_leg) is not None
        return replace(recovery, proof=leg_sentence, proof_kind="disconnected", proved_within=within)
    proved_sample, sentence = found_proof
    is_violated = bool(describe_goal_violation(recovery.keep, solver.rows, poses[proved_sample]))
    return replace(
        recovery,
        proof=f"at {100 * fractions[proved_sample]:.1f} % of the tool path {sentence}",
        proof_kind="a pose of the path",
        proved_pose=None if is_violated else poses[proved_sample],
        proved_within=any(prove_within(sample) for sample in (proved_sample, *hardest_samples)),
    )


def coarse_to_fine_indices(count: int) -> Iterator[int]:
    """Yield 0 to count - 1, the most informative samples first: the last, the first, the middle, quarters, eighths, ..."""
    yielded, parts = set[int](), 1
    while len(yielded) < count:
        for sample in (
            [count - 1, 0] if parts == 1 else [round(numerator * (count - 1) / parts) for numerator in range(1, parts, 2)]
        ):
            if sample not in yielded:
                yielded.add(sample)
                yield sample
        parts *= 2


def _prove_leg_impossible(
    degraded: Degraded, task: Task, path: Path, space: FreeSpace, tolerance: Tolerance, first_leg: int
) -> tuple[int, str] | None:
    """Prove that no continuous motion follows a straight leg of a tool path, and return the leg and the sentence, or None.

    Each leg from ``first_leg`` gets half of the remaining time.
    """
    limits = degraded.lo, degraded.hi
    if not np.isfinite(limits).all():  # unlimited joints connect ends that the boxes separate
        return None
    is_straight = path.shift.any(axis=1) & ~path.sweep.any(axis=1) & ~path.turn.any(axis=1)
    for leg in (leg for leg in np.flatnonzero(is_straight).tolist() if leg >= first_leg):
        try:
            box_count = prove_leg_impossible(
                degraded.arm,
                task,
                path.starts[leg],
                way=path.shift[leg],
                limits=limits,
                tolerance=tolerance,
                time_limit=space.seconds_left / 2,
                most_boxes=MAX_BOXES,
                blocked=make_blocked_boxes(space),
            )
        except TaskError:
            return None
        if box_count is not None:
            start_percent, end_percent = 100 * path.bounds[leg : leg + 2]
            return leg, (
                f"from {start_percent:.4g} to {end_percent:.4g} % of the tool path no continuous motion leads through its "
                f"poses: {box_count:,} boxes of joints that may contain a configuration do not connect its ends, up to "
                "floating point"
            )
    return None
