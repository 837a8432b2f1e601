"""Numbers to reproduce: ours, and in parentheses how far they are from those of a specification."""

from __future__ import annotations


def beside(ours: float, expected: float, digits: int = 6, unit: str = "") -> str:
    """``ours (difference)``; a difference below half a unit of the expected number's last digit is rounding, written 0."""
    difference = ours - expected
    told = "0" if abs(difference) <= 0.5001 * 10.0**-digits else f"{difference:+.1g}"
    return f"{round(ours, digits) + 0.0:.{digits}f}{unit} ({told})"


def share(ours: float, expected: float, digits: int = 1) -> str:
    """Shares in per cent, the difference in percentage points."""
    return f"{ours:.{digits}%} ({100 * (ours - expected):+.{digits}f})"
