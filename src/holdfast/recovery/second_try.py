"""A second try by exact distances where the bound of the clearance leaves no way: narrow gaps are passable only by them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from holdfast.clearance.clearance import Clearance
from holdfast.clearance.exact.sharper import sharpened
from holdfast.recovery.recovery import Ending, Recovery

_IN_THE_WAY = (
    Ending.HOME_WITH_ROWS_GIVEN_UP,
    Ending.PATH_UNFINISHED,
    Ending.NO_ROUTE_FOUND,
    Ending.NOTHING_FOUND,
    Ending.START_TOO_CLOSE,
)


def bolder(found: Recovery, again: Callable[[Clearance], Recovery]) -> Recovery:
    """What was found by the bound, or what is found once more by exact distances where that is better.

    Not where the goal, or the tool path, is proved infeasible and a motion without some of its rows was found.

    Args:
        found: By the bound.
        again: The same search with another clearance.
    """
    proved = found.proof_kind in ("reach bound", "boxes", "a pose of the path") and found.given_up is not None
    settled = proved or found.proof_kind in ("start", "disconnected")
    sharp = sharpened(found.clearance, found.margin) if found.ending in _IN_THE_WAY and not settled else None
    if sharp is None:
        return found
    other = again(sharp)
    if _lost(other) < _lost(found):
        return other
    return replace(found, reason=f"{found.reason}; nor is there more by exact distances ({sharp.exact_by})".lstrip("; "))


def _lost(recovery: Recovery) -> tuple[float, int, float]:
    """How much of what was asked for is not met: the ending, how many rows are given up, and how much of the path."""
    rows, rest = recovery.given_up, recovery.rest
    ending = Ending.NO_ROUTE_FOUND - 0.5 if recovery.ending == Ending.PROVED_DISCONNECTED else recovery.ending
    return ending, 0 if rows is None else len(rows.names), 0.0 if rest is None else -rest.furthest
