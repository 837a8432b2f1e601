"""Gain from choosing the best configurations: distributions before and after optimisation, and the gain of each pose."""

from __future__ import annotations

import numpy as np

from holdfast.core.formatting import format_count, format_half_width
from holdfast.core.probability.distribution import Distribution
from holdfast.interface import report
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.report.page import Block, Picture, Text

_MAX_DOTS = 20_000


def blocks(facts: AssessmentFacts) -> list[Block]:
    """Compare the index before and after optimisation, if the run was optimised; Abdi et al. 2012, Figs. 5 to 7."""
    optimised = facts.assessment.optimised
    if optimised is None or not optimised.reached:
        return []
    blocks: list[Block] = [
        Text(
            f"After: the best configuration found of each pose, subject to the pose{_describe_constraints(facts)}. "
            "A local search from several starts found it, so its index is a lower bound on the best possible value."
        )
    ]
    if facts.has_finite_values:
        figure = draw_gain(facts, optimised)
        blocks.append(
            Picture(
                report.svg(figure, "gain", "Distribution of the index before and after choosing the best configurations"),
                f"{facts.distribution.samples:,} poses. Right: the {facts.distribution.reached:,} reached poses, "
                "sorted by the index before. The gain of a pose is the height of its dot above the line."
                + _describe_blocked_poses(facts),
            )
        )
    return blocks


def _describe_constraints(facts: AssessmentFacts) -> str:
    """Describe the constraints of the best configurations in addition to the pose."""
    clearance, margin = facts.assessment.plan.clearance, facts.assessment.plan.margin
    if clearance is None:
        return " and the joint limits; self-collision is not checked"
    obstacles = f"no collision of the arm with {facts.avoided_objects}"
    clearance_text = f"a clearance of at least {margin:g} m" if margin else obstacles
    return f", the joint limits and {clearance_text} ({clearance.capsules.describe(facts.assessment.arm)})"


def _describe_blocked_poses(facts: AssessmentFacts) -> str:
    blocked = facts.assessment.collisions.hopeless if facts.assessment.collisions is not None else 0
    reason = "no dot because no configuration with the required clearance was found"
    return f" {format_count(blocked, 'pose')} {'has' if blocked == 1 else 'have'} {reason}." if blocked else ""


def draw_gain(facts: AssessmentFacts, best: Distribution) -> report.Figure:
    """Draw the cumulative distributions before and after (left), and both values of each pose (right; Figs. 6 and 7)."""
    curves = build_gain_curves(facts, best)
    with report.styled_figure(report.WIDTH_IN, 3.9) as figure:
        cdf_axes, pose_axes = figure.subplots(1, 2)
        _draw_cdf(cdf_axes, facts, curves)
        cdf_axes.set_title(f"Cumulative (CDF), {facts.distribution.samples:,} poses")
        poses = facts.poses
        if poses is None:
            pose_axes.set_axis_off()
        else:
            before = poses.value[poses.reached]
            after = facts.assessment.columns["optimised_index"][:][: len(poses.reached)][poses.reached]
            order = np.argsort(before)
            chosen = order if len(order) <= _MAX_DOTS else order[:: -(-len(order) // _MAX_DOTS)]
            ranks = np.searchsorted(np.sort(before), before[chosen]) + 1
            pose_axes.plot(ranks, after[chosen], ".", color=report.BLUE, markersize=2.2, rasterized=True)
            pose_axes.plot(ranks, before[chosen], color=report.ORANGE, linewidth=1.6)
            pose_axes.set(xlabel="reached poses, sorted by the index before", ylabel=facts.axis_label, ylim=(0, None))
            if facts.is_logarithmic:
                pose_axes.set(yscale="log", ylim=(None, None))
            pose_axes.set_title("Each pose before (line) and after (dots)")
        report.legend_below(figure, cdf_axes)
    return figure


def _draw_cdf(axes: report.Axes, facts: AssessmentFacts, curves: list[report.Curve]) -> None:
    """Draw cumulative distributions with the marks that are not beyond the end of their axis."""
    marks, label = [mark for mark in facts.marks if mark.x <= curves[0].x[-1]], "fraction with a smaller value, F"
    report.draw_cdf(axes, curves, marks, xlabel=facts.axis_label, ylabel=label, log=facts.is_logarithmic)


def build_gain_curves(facts: AssessmentFacts, best: Distribution) -> list[report.Curve]:
    """Return the distributions after and before optimisation over one axis, each with its 95 % band."""
    extremes = [
        value
        for distribution in (facts.distribution, best)
        for value in (distribution.lowest, distribution.highest)
        if np.isfinite(value)
    ]
    lower = min(0.0, *extremes) if not facts.is_logarithmic else min(extremes)
    axis_values = (np.geomspace if facts.is_logarithmic else np.linspace)(lower, max(extremes) * 1.02, 400)
    samples = ((best, "after: best configurations", False), (facts.distribution, "before: found by inverse kinematics", True))
    return [
        report.Curve(
            axis_values,
            distribution.cdf(axis_values),
            f"{label}, 95 % band {format_half_width(distribution.band())}",
            second=second,
            band=distribution.band(),
        )
        for distribution, label, second in samples
    ]


def draw_cdf_figure(facts: AssessmentFacts) -> report.Figure:
    """Draw the cumulative distribution with its 95 % band; before and after optimisation if the run was optimised."""
    optimised = facts.assessment.optimised
    curves = facts.curves if optimised is None or not optimised.reached else build_gain_curves(facts, optimised)
    with report.styled_figure(7.2, 4.8) as figure:
        axes = figure.subplots()
        _draw_cdf(axes, facts, curves)
        unreached_text = f", {facts.distribution.unreached:,} of them not reached" if facts.distribution.unreached else ""
        axes.set_title(
            f"{report.format_label(facts.assessment.arm.name, 30)}: {facts.distribution.samples:,} "
            f"{facts.noun}s{unreached_text}"
        )
        report.legend_below(figure, axes, 1)
    return figure
