"""What a reader may ask of a distribution: a threshold to move, with the probability of meeting it and what prevents it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.present.assessment.facts import Facts
from holdfast.report.figures import frame
from holdfast.report.page import Block, Extra
from holdfast.words import as_given, half_width, interval, together

Array = NDArray[np.float64]

_STEPS = 100  # about so many, at round numbers
_MOST_FAILURES = 10

_HTML = Markup("""\
<p><label>Move the threshold: index {sign} <strong class="asked">{asked}</strong>{unit}
<input type="range" min="0" max="{last}" value="{start}" step="1"></label></p>
<dl class="answers">{answers}</dl>
<p class="quiet">An interval is that of one threshold, chosen beforehand; for all at once
the band of {curve} holds, {band}.</p>
{bars}""")

_BAR = Markup("""\
<li><span class="name"></span><span class="track"><span class="bar"></span></span><span class="part"></span></li>""")


def steps(axis: Array, log: bool, threshold: float) -> Array:
    """Thresholds (K,) from one end of an axis to the other at round numbers, that of the report among them."""
    low, high = float(axis[0]), float(axis[-1])
    if log:
        some = np.geomspace(low, high, _STEPS)
        digits = 2 - np.floor(np.log10(some)).astype(int)
        some = np.array([round(x, k) for x, k in zip(some.tolist(), digits.tolist(), strict=True)])
    else:
        least = (high - low) / _STEPS
        size = 10.0 ** np.floor(np.log10(least))
        size *= next(k for k in (1, 2, 5, 10) if k * size >= least * (1 - 1e-9))
        some = np.round(np.arange(np.ceil(low / size), np.floor(high / size) + 1) * size, 12)
    return np.unique([*some.tolist(), threshold])


def blocks(f: Facts, figure: Figure) -> list[Block]:
    """The slider, for the figure of the distribution just before it."""
    if not f.decided:
        return []
    asked = steps(f.axis, f.log, f.threshold)
    option = "at_least" if f.larger else "at_most"
    samples = [("at the configurations found" if f.a.region.kind != "joints" else f"of all {f.noun}s", False)]
    samples += [("at the best configuration of each pose", True)] * (f.a.optimised is not None)
    answers = {
        f"Probability {label}": [interval(f.a.interval(**{option: x}, optimised=o)) for x in asked.tolist()]
        for label, o in samples
    }
    names, missed = _missed(f, asked)
    many = min(len(names), _MOST_FAILURES)
    some = f", the worst {many}" if many < len(names) else ""
    told = f"How often the threshold is missed once this locks{some}, of the {f.reached}:"
    seen = Markup('<p class="quiet">{}</p>\n<ul class="bars">{}</ul>').format(told, _BAR * many) if many else ""
    return [slider(f, asked, answers, figure, "the curve", f.a.distribution.band(), (names, missed, seen))]


def slider(
    f: Facts,
    asked: Array,
    answers: Mapping[str, Sequence[str]],
    figure: Figure,
    curve: str,
    band: float,
    bars: tuple[list[str], Array, str | Markup] = ([], np.zeros((0, 0)), ""),
) -> Extra:
    """A threshold that moves over a figure, with what is written here for each of its steps.

    Args:
        f: What the index is called, which way it is good, and the threshold with which it begins.
        asked: (K,) thresholds, that one among them.
        answers: Of each row by name its text at each threshold.
        figure: The one just before it, whose axes show the threshold.
        curve: What the band belongs to.
        band: Half its width.
        bars: Names (F,), fractions (F, K), and where they are seen.
    """
    start = int(np.flatnonzero(asked == f.threshold)[0])
    names, missed, seen = bars
    answers = {label: [together(text) for text in texts] for label, texts in answers.items()}
    data = {
        "values": asked.tolist(),
        "thresholds": [as_given(x) for x in asked.tolist()],
        "answers": list(answers.values()),
        "failures": names,
        "missed": np.round(missed, 4).tolist(),
        "frames": [frame(axes) for axes in figure.axes],
    }
    rows = Markup("").join(
        Markup("<div><dt>{}</dt><dd><output data-row>{}</output></dd></div>").format(label, texts[start])
        for label, texts in answers.items()
    )
    html = _HTML.format(
        sign="≥" if f.larger else "≤",
        asked=as_given(f.threshold),
        unit=f.unit,
        last=len(asked) - 1,
        start=start,
        answers=rows,
        curve=curve,
        band=half_width(band),
        bars=seen,
    )
    return Extra("threshold", data, html, label="Probability of a threshold of one's own")


def _missed(f: Facts, asked: Array) -> tuple[list[str], Array]:
    """Of each failure (F,) the fraction (F, K) of the reached poses that miss each threshold after it; none without rows."""
    rows = f.rows
    if rows is None or not rows.reached.any():
        return [], np.zeros((0, len(asked)))
    values = rows.by_failure[rows.reached]
    weight = np.ones(len(values)) if rows.weight is None else rows.weight[rows.reached]
    found = np.zeros((values.shape[1], len(asked)))
    for k, column in enumerate(values.T):
        order = np.argsort(column)
        below = np.r_[0.0, np.cumsum(weight[order])] / (weight.sum() or 1.0)
        if f.larger:
            found[k] = below[np.searchsorted(column[order], asked, side="left")]
        else:
            found[k] = 1 - below[np.searchsorted(column[order], asked, side="right")]
    return f.failure_labels, found
