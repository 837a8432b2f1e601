"""Threshold slider of a distribution, with the probability of meeting the threshold and the failures that prevent it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from markupsafe import Markup

from holdfast.core.formatting import format_as_given, format_half_width, format_interval, insert_nonbreaking_spaces
from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.report.page import Block, Extra

_STEP_COUNT = 100  # approximate number of steps, at round numbers
_MAX_FAILURES = 10

_HTML_TEMPLATE = Markup("""\
<p><label>Move the threshold: index {sign} <strong class="asked">{asked}</strong>{unit}
<input type="range" min="0" max="{last}" value="{start}" step="1"></label></p>
<dl class="answers">{answers}</dl>
<p class="quiet">Each interval is valid for one threshold that was chosen beforehand. The band
of {curve}, {band}, is valid for all thresholds simultaneously.</p>
{bars}""")

_BAR_TEMPLATE = Markup("""\
<li><span class="name"></span><span class="track"><span class="bar"></span></span><span class="part"></span></li>""")


def choose_thresholds(axis: FloatArray, is_logarithmic: bool, threshold: float) -> FloatArray:
    """Choose thresholds (K,) at round numbers along an axis, including the threshold of the report."""
    lower, upper = float(axis[0]), float(axis[-1])
    if is_logarithmic:
        candidates = np.geomspace(lower, upper, _STEP_COUNT)
        digits = 2 - np.floor(np.log10(candidates)).astype(int)
        candidates = np.array([round(candidate, k) for candidate, k in zip(candidates.tolist(), digits.tolist(), strict=True)])
    else:
        min_step = (upper - lower) / _STEP_COUNT
        step_size = 10.0 ** np.floor(np.log10(min_step))
        step_size *= next(k for k in (1, 2, 5, 10) if k * step_size >= min_step * (1 - 1e-9))
        candidates = np.round(np.arange(np.ceil(lower / step_size), np.floor(upper / step_size) + 1) * step_size, 12)
    return np.unique([*candidates.tolist(), threshold])


def blocks(facts: AssessmentFacts, figure: report.Figure) -> list[Block]:
    """Build the threshold slider for the figure of the distribution just before it."""
    if not facts.has_threshold:
        return []
    threshold_values = choose_thresholds(facts.axis_values, facts.is_logarithmic, facts.threshold)
    option = "at_least" if facts.larger_is_better else "at_most"
    samples = [("over all configurations" if facts.noun == "configuration" else "at the configurations found", False)]
    samples += [("at the best configuration of each pose", True)] * (facts.assessment.optimised is not None)
    answers = {
        f"Probability {label}": [
            format_interval(facts.assessment.interval(**{option: threshold}, optimised=optimised))
            for threshold in threshold_values.tolist()
        ]
        for label, optimised in samples
    }
    failure_names, miss_fractions = _compute_miss_fractions(facts, threshold_values)
    shown_count = min(len(failure_names), _MAX_FAILURES)
    remark = f", the worst {shown_count}" if shown_count < len(failure_names) else ""
    caption = f"Fraction of the {facts.reached_noun} that miss the threshold after each failure{remark}:"
    bar_list = (
        Markup('<p class="quiet">{}</p>\n<ul class="bars">{}</ul>').format(caption, _BAR_TEMPLATE * shown_count)
        if shown_count
        else ""
    )
    return [
        build_slider(
            facts,
            threshold_values,
            answers,
            figure,
            "the curve",
            facts.assessment.distribution.band(),
            (failure_names, miss_fractions, bar_list),
        )
    ]


def build_slider(
    facts: AssessmentFacts,
    threshold_values: FloatArray,
    answers: Mapping[str, Sequence[str]],
    figure: report.Figure,
    curve_name: str,
    half_band: float,
    bars: tuple[list[str], FloatArray, str | Markup] = ([], np.zeros((0, 0)), ""),
) -> Extra:
    """Build a slider that moves a threshold over a figure, with a text for each step.

    Args:
        facts: Contents of the assessment: name and better direction of the index, and the initial threshold.
        threshold_values: (K,) thresholds, including the initial one.
        answers: Text of each row at each of the K thresholds, by the name of the row.
        figure: Figure directly before the slider, in whose axes the threshold is drawn.
        curve_name: Name of the curve to which the band belongs.
        half_band: Half width of the band, a fraction from 0 to 1.
        bars: Names of the failures (F,), fractions of poses that miss each threshold (F, K), and the HTML of the bars.
    """
    start_step = int(np.flatnonzero(threshold_values == facts.threshold)[0])
    failure_names, miss_fractions, bar_list = bars
    answers = {label: [insert_nonbreaking_spaces(text) for text in texts] for label, texts in answers.items()}
    data = {
        "values": threshold_values.tolist(),
        "thresholds": [format_as_given(threshold) for threshold in threshold_values.tolist()],
        "answers": list(answers.values()),
        "failures": failure_names,
        "missed": np.round(miss_fractions, 4).tolist(),
        "frames": [report.locate_axes(axes) for axes in figure.axes],
    }
    answer_rows = Markup("").join(
        Markup("<div><dt>{}</dt><dd><output data-row>{}</output></dd></div>").format(label, texts[start_step])
        for label, texts in answers.items()
    )
    html = _HTML_TEMPLATE.format(
        sign="≥" if facts.larger_is_better else "≤",
        asked=format_as_given(facts.threshold),
        unit=facts.unit_suffix,
        last=len(threshold_values) - 1,
        start=start_step,
        answers=answer_rows,
        curve=curve_name,
        band=format_half_width(half_band),
        bars=bar_list,
    )
    return Extra("threshold", data, html, label="Probability of meeting a threshold of your choice")


def _compute_miss_fractions(facts: AssessmentFacts, threshold_values: FloatArray) -> tuple[list[str], FloatArray]:
    """Compute the fraction (F, K) of reached poses that miss each threshold after each failure (F,); empty without poses."""
    poses = facts.poses
    if poses is None or not poses.reached.any():
        return [], np.zeros((0, len(threshold_values)))
    values = poses.by_failure[poses.reached]
    weights = np.ones(len(values)) if poses.weight is None else poses.weight[poses.reached]
    fractions = np.zeros((values.shape[1], len(threshold_values)))
    for failure, column in enumerate(values.T):
        order = np.argsort(column)
        cumulative = np.r_[0.0, np.cumsum(weights[order])] / (weights.sum() or 1.0)
        if facts.larger_is_better:
            fractions[failure] = cumulative[np.searchsorted(column[order], threshold_values, side="left")]
        else:
            fractions[failure] = 1 - cumulative[np.searchsorted(column[order], threshold_values, side="right")]
    return facts.failure_labels, fractions
