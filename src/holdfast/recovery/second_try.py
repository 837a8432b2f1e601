"""Repeat a search with exact distances where the conservative bound of the clearance leaves no route, as in narrow gaps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from holdfast.clearance.clearance import Clearance
from holdfast.clearance.exact.sharper import with_exact_distances
from holdfast.recovery.recovery import Recovery, RecoveryOutcome

_RETRIED_OUTCOMES = (
    RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS,
    RecoveryOutcome.PATH_UNFINISHED,
    RecoveryOutcome.NO_ROUTE_FOUND,
    RecoveryOutcome.NOTHING_FOUND,
    RecoveryOutcome.START_TOO_CLOSE,
)


def retry_with_exact_distances(recovery: Recovery, search_again: Callable[[Clearance], Recovery]) -> Recovery:
    """Return the recovery that was found, or that of a repeated search with exact distances where it is better.

    Not where the goal, or the tool path, is proved infeasible and a motion without some of its rows was found.

    Args:
        recovery: By the bound.
        search_again: The same search with another clearance.
    """
    is_proved = recovery.proof_kind in ("reach bound", "boxes", "a pose of the path") and recovery.relaxed is not None
    is_settled = is_proved or recovery.proof_kind in ("start", "disconnected")
    exact_clearance = (
        with_exact_distances(recovery.clearance, recovery.margin)
        if recovery.ending in _RETRIED_OUTCOMES and not is_settled
        else None
    )
    if exact_clearance is None:
        return recovery
    exact_recovery = search_again(exact_clearance)
    if _rank_recovery(exact_recovery) < _rank_recovery(recovery):
        return exact_recovery
    return replace(
        recovery, reason=f"{recovery.reason}; nor is there more by exact distances ({exact_clearance.exact_by})".lstrip("; ")
    )


def _rank_recovery(recovery: Recovery) -> tuple[float, int, float]:
    """Return the unmet part of the request as a sort key: the outcome, the number of relaxed rows, and the missing path."""
    relaxed, rest = recovery.relaxed, recovery.rest
    outcome_rank = (
        RecoveryOutcome.NO_ROUTE_FOUND - 0.5 if recovery.ending == RecoveryOutcome.PROVED_DISCONNECTED else recovery.ending
    )
    return outcome_rank, 0 if relaxed is None else len(relaxed.names), 0.0 if rest is None else -rest.furthest
