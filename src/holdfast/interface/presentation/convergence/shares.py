"""Table cells and facts about the success rates of control laws."""

from __future__ import annotations

from collections.abc import Mapping

from holdfast.core.formatting import format_percent
from holdfast.core.probability.intervals import Difference, Interval
from holdfast.interface.presentation.presentation import Fact


def format_points(difference: Difference) -> str:
    """Format a difference of two fractions in percentage points, with its sign and its interval."""
    value, low, high = (f"{100 * end:+.1f}" for end in (difference.value, difference.low, difference.high))
    return f"{value} ({low} to {high})"


def format_range(interval: Interval) -> str:
    """Format the ends of the interval of a fraction, with the confidence."""
    return f"{100 * interval.confidence:.4g} % interval {format_percent(interval.low)} to {format_percent(interval.high)}"


def rank_successes(shares: Mapping[str, Interval]) -> list[Fact]:
    """Return facts about the success rates of the first laws of a ranking."""
    return [
        Fact("", share.value, phrase=f"of the motions reach the target with {name}; {format_range(share)}", style="percent")
        for name, share in list(shares.items())[:4]
    ]
