"""Format numbers and words for the console and for HTML reports."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Collection, Sequence
from typing import Any, Protocol

import numpy as np

_ROUNDED_TO_ZERO = 1e-9
_ROUNDED_TO_ZERO_IN_TABLES = 1e-12
_SPACE_BEFORE_UNIT = re.compile(r" (?=(?:%|°|(?:N m|[kcmµ]?m|m?s|min|h|rad|deg|k?N|k?g|k?Hz|W|J|[kMG]?B|px)(?![\w-])))")
_NUMBER_ENDS = frozenset("0123456789∞–")  # characters that end a number
_NEGATIVE_EXPONENT = re.compile(r"(?<![\w.])(\d[\d.]*e)-(?=\d)")  # a browser breaks lines after a hyphen
_HTML_PIECE = re.compile(r"(<code\b.*?</code>|<pre\b.*?</pre>|<[^>]*>)", re.DOTALL)


class Probability(Protocol):
    """Value with its confidence interval."""

    @property
    def value(self) -> float:
        """The estimate."""

    @property
    def low(self) -> float:
        """Lower limit."""

    @property
    def high(self) -> float:
        """Upper limit."""

    @property
    def confidence(self) -> float:
        """Confidence level of the interval, 0 to 1."""


def capitalise_first(text: str) -> str:
    """Return the text with a capital first letter and the others unchanged."""
    return text[:1].upper() + text[1:]


def format_seconds(time: float) -> str:
    """Return a time in seconds with four digits, and never with less precision than tenths of a second."""
    return f"{time:.4g} s" if abs(time) < 1000 else f"{time:.1f} s"


def format_number(x: float | np.floating[Any], digits: int | None = None) -> str:
    """Format a number for people; rounding errors print as 0.

    Args:
        x: The number.
        digits: Significant digits, for tables and the console. Default: about three digits with a typographic minus sign, for
            sentences of HTML reports.
    """
    x = float(x)
    if digits is not None:
        if not math.isfinite(x):
            return "infinite" if math.isinf(x) else "none"
        return "0" if abs(x) < _ROUNDED_TO_ZERO_IN_TABLES else f"{x:.{digits}g}"
    if np.isnan(x):
        return "–"
    if np.isinf(x):
        return "∞" if x > 0 else "−∞"
    size = abs(x)
    if size < _ROUNDED_TO_ZERO:
        return "0"
    if size < 1e-3 or size >= 1e7:
        mantissa, exponent = f"{x:.1e}".split("e")
        text = f"{mantissa}e{int(exponent)}"
    else:
        text = f"{x:.3f}" if size < 10 else f"{x:,.1f}" if size < 1000 else f"{x:,.0f}"
    return text.replace("-", "−")


def format_decimals(x: float, digits: int) -> str:
    """Format a number with a fixed count of decimals and no minus sign before zeros."""
    return f"{round(float(x), digits) + 0.0:.{digits}f}".replace("-", "−")


def format_as_given(x: float) -> str:
    """Format a number with at most six significant digits, as users enter numbers."""
    return f"{x:.6g}".replace("-", "−")


def format_percent(fraction: float) -> str:
    """Format a fraction with one decimal; 0 % and 100 % appear only for exactly 0 and 1."""
    value = 100 * fraction
    if 0 < value < 0.05:
        return "<0.1 %"
    if 99.95 <= value < 100:
        return ">99.9 %"
    return f"{value:.0f} %" if value in (0, 100) else f"{value:.1f} %"


def format_interval(p: Probability) -> str:
    """Format an estimate as ``0.49 (0.47 to 0.51, 95 %)`` with as many digits as its interval supports."""
    half = max((p.high - p.low) / 2, 1e-6)
    digits = int(np.clip(math.ceil(0.3 - math.log10(half)), 2, 6))
    return f"{p.value:.{digits}f} ({p.low:.{digits}f} to {p.high:.{digits}f}, {100 * p.confidence:.4g} %)"


def format_half_width(half: float) -> str:
    """Format half the width of a band as ``±0.031``, with at least two nonzero digits."""
    return f"±{half:.{int(np.clip(math.ceil(1 - math.log10(max(half, 1e-9))), 3, 9))}f}"


def format_share(count: int, total: int) -> str:
    """Format a count with its fraction of the total and the 95 % Clopper-Pearson interval of that fraction."""
    if not total:
        return f"{count:,}"
    from holdfast.core.probability.intervals import Interval

    limits = Interval.from_counts(count, total)
    low, high = (format_percent(round(x, 9)) for x in (limits.low, limits.high))
    return f"{count:,} ({format_percent(count / total)}, 95 % interval {low.removesuffix(' %')} to {high})"


def shorten_to_one_line(text: str, max_length: int = 60) -> str:
    """Return the printable part of a text on one line, shortened to ``max_length`` characters."""
    line = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return line if len(line) <= max_length else line[: max_length - 1] + "…"


def format_count(count: int, noun: str) -> str:
    """Return a count with its noun: ``1 pose``, ``2 poses``, ``2 boxes``."""
    return f"{count:,} {noun}" + ("" if count == 1 else "es" if noun.endswith(("x", "sh")) else "s")


def insert_nonbreaking_spaces(text: str, html: bool = False) -> str:
    """Return the text with no-break spaces between numbers and units, so that no line breaks between them.

    Args:
        text: Text for people.
        html: The text is HTML; tags and text that is meant to be copied stay unchanged.
    """
    if html:
        pieces = _HTML_PIECE.split(text)  # each second piece stays unchanged
        return "".join(part if k % 2 else insert_nonbreaking_spaces(part) for k, part in enumerate(pieces))
    joined = _SPACE_BEFORE_UNIT.sub(lambda space: "\u00a0" if text[max(space.start() - 1, 0)] in _NUMBER_ENDS else " ", text)
    return _NEGATIVE_EXPONENT.sub(r"\1−", joined.replace("\u00a0N m", "\u00a0N\u00a0m"))


def format_duration(seconds: float) -> str:
    """Format a duration: ``4.2 s``, ``12 min``, ``3.0 h``, ``2.5 days`` or ``40 years``."""
    if seconds < 60:
        return f"{seconds:.2g} s" if seconds < 10 else f"{seconds:.0f} s"
    if seconds < 5400:
        return f"{seconds / 60:.0f} min"
    if seconds < 172_800:
        return f"{seconds / 3600:.1f} h"
    return f"{seconds / 86_400:.1f} days" if seconds < 1e8 else f"{seconds / 31_557_600:.2g} years"


def indefinite_article(word: str) -> str:
    """Return ``a`` or ``an`` for a word."""
    return "an" if word[:1].lower() in "aeiou" else "a"


def list_alternatives(words: list[str]) -> str:
    """Return ``a, b or c``."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} or {words[-1]}"


def list_names(names: Sequence[str], max_names: int = 60) -> str:
    """Return at most ``max_names`` quoted names for a sentence."""
    more = f" and {len(names) - max_names} more" if len(names) > max_names else ""
    return ", ".join(f"'{x}'" for x in names[:max_names]) + more


def suggest_name(name: str, known: Collection[str]) -> str:
    """Return ``did you mean ...?`` for a sentence, or an empty text if no known name is similar."""
    close = difflib.get_close_matches(name, known, n=1, cutoff=0.6)
    return f"did you mean '{close[0]}'? " if close else ""
