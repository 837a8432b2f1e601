"""Numbers and words as people read them."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Collection, Sequence
from typing import Protocol

import numpy as np

_ZERO = 1e-9
_UNIT = re.compile(r" (?=(?:%|°|(?:N m|[kcmµ]?m|m?s|min|h|rad|deg|k?N|k?g|k?Hz|W|J|[kMG]?B|px)(?![\w-])))")
_ENDS = frozenset("0123456789∞–")  # what a number ends with
_SMALL = re.compile(r"(?<![\w.])(\d[\d.]*e)-(?=\d)")  # a browser breaks lines behind a hyphen
_PIECE = re.compile(r"(<code\b.*?</code>|<pre\b.*?</pre>|<[^>]*>)", re.DOTALL)


class Probability(Protocol):
    """A value with its confidence interval."""

    @property
    def value(self) -> float:
        """The estimate."""

    @property
    def low(self) -> float:
        """Lower end."""

    @property
    def high(self) -> float:
        """Upper end."""

    @property
    def confidence(self) -> float:
        """Of the interval, 0 to 1."""


def capitalised(text: str) -> str:
    """The first letter large, the others as they are."""
    return text[:1].upper() + text[1:]


def format_seconds(time: float) -> str:
    """Return an instant in seconds: four digits, and never less than tenths of a second."""
    return f"{time:.4g} s" if abs(time) < 1000 else f"{time:.1f} s"


def number(x: float) -> str:
    """Three digits or so, alike in a column of values of one kind; what is below 1e-9 is rounding and reads 0."""
    if np.isnan(x):
        return "–"
    if np.isinf(x):
        return "∞" if x > 0 else "−∞"
    size = abs(x)
    if size < _ZERO:
        return "0"
    if size < 1e-3 or size >= 1e7:
        digits, exponent = f"{x:.1e}".split("e")
        text = f"{digits}e{int(exponent)}"
    else:
        text = f"{x:.3f}" if size < 10 else f"{x:,.1f}" if size < 1000 else f"{x:,.0f}"
    return text.replace("-", "−")


def fixed(x: float, digits: int) -> str:
    """So many decimals, and no minus in front of zeros."""
    return f"{round(float(x), digits) + 0.0:.{digits}f}".replace("-", "−")


def as_given(x: float) -> str:
    """A number as it was given."""
    return f"{x:.6g}".replace("-", "−")


def percent(share: float) -> str:
    """A share: one decimal, and 0 % or 100 % only if it is."""
    value = 100 * share
    if 0 < value < 0.05:
        return "<0.1 %"
    if 99.95 <= value < 100:
        return ">99.9 %"
    return f"{value:.0f} %" if value in (0, 100) else f"{value:.1f} %"


def interval(p: Probability) -> str:
    """``0.49 (0.47 to 0.51, 95 %)`` with as many digits as it deserves."""
    half = max((p.high - p.low) / 2, 1e-6)
    digits = int(np.clip(math.ceil(0.3 - math.log10(half)), 2, 6))
    return f"{p.value:.{digits}f} ({p.low:.{digits}f} to {p.high:.{digits}f}, {100 * p.confidence:.4g} %)"


def half_width(half: float) -> str:
    """Write half the width of a band as ``±0.031``, with at least two digits that are not 0."""
    return f"±{half:.{int(np.clip(math.ceil(1 - math.log10(max(half, 1e-9))), 3, 9))}f}"


def share(count: int, whole: int) -> str:
    """A count with its share of the whole and the exact 95 % interval of that."""
    if not whole:
        return f"{count:,}"
    from holdfast.probability.intervals import Interval

    limits = Interval.of(count, whole)
    low, high = (percent(round(x, 9)) for x in (limits.low, limits.high))
    return f"{count:,} ({percent(count / whole)}, 95 % interval {low.removesuffix(' %')} to {high})"


def on_one_line(text: str, most: int = 60) -> str:
    """What can be printed of a text, on one line, shortened to ``most`` characters."""
    line = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return line if len(line) <= most else line[: most - 1] + "…"


def counted(count: int, noun: str) -> str:
    """``1 pose``, ``2 poses``, ``2 boxes``."""
    return f"{count:,} {noun}" + ("" if count == 1 else "es" if noun.endswith(("x", "sh")) else "s")


def together(text: str, html: bool = False) -> str:
    """The text with no-break spaces between numbers and their units, so that no line ends there or within a number: for pages.

    Args:
        text: For people.
        html: It is HTML; what is in tags, or to be copied, stays as it is.
    """
    if html:
        parts = _PIECE.split(text)  # each second one is to stay
        return "".join(part if k % 2 else together(part) for k, part in enumerate(parts))
    found = _UNIT.sub(lambda space: "\u00a0" if text[max(space.start() - 1, 0)] in _ENDS else " ", text)
    return _SMALL.sub(r"\1−", found.replace("\u00a0N m", "\u00a0N\u00a0m"))


def duration(seconds: float) -> str:
    """``4.2 s``, ``12 min``, ``3.0 h``, ``2.5 days`` or ``40 years``."""
    if seconds < 60:
        return f"{seconds:.2g} s" if seconds < 10 else f"{seconds:.0f} s"
    if seconds < 5400:
        return f"{seconds / 60:.0f} min"
    if seconds < 172_800:
        return f"{seconds / 3600:.1f} h"
    return f"{seconds / 86_400:.1f} days" if seconds < 1e8 else f"{seconds / 31_557_600:.2g} years"


def article(word: str) -> str:
    """``a`` or ``an``."""
    return "an" if word[:1].lower() in "aeiou" else "a"


def either(words: list[str]) -> str:
    """``a, b or c``."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} or {words[-1]}"


def list_names(names: Sequence[str], most: int = 60) -> str:
    """Return quoted names for a sentence, ``most`` of them."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(f"'{x}'" for x in names[:most]) + more


def suggest_name(name: str, known: Collection[str]) -> str:
    """Return ``did you mean ...?`` for a sentence, or nothing where no known name is close."""
    close = difflib.get_close_matches(name, known, n=1, cutoff=0.6)
    return f"did you mean '{close[0]}'? " if close else ""
