"""Sections of the report of an assessment, and the overview figure."""

from __future__ import annotations

from importlib import import_module

import numpy as np

from holdfast.core.formatting import format_interval, format_percent, list_alternatives
from holdfast.interface import report
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.presentation.assessment.sections import gain
from holdfast.interface.report.page import Callout, Section
from holdfast.studies.assessment.single_points import explain

SMALL_REACH_FRACTION = 0.1  # fraction of the poses that the healthy arm reaches

# Titles of the sections in order, by module of `sections` with a function blocks(facts) -> list[Block]; empty ones are omitted.
SECTION_TITLES = {
    "structure": "Single points of failure by structure",
    "views": "The arm and the region",
    "distribution": "Distribution of the index",
    "gain": "Gain from choosing the best configurations",
    "collisions": "Collisions of the arm with {others}",
    "survival": "Poses still reached after a lock",
    "worst": "Index after each failure",
    "upgrades": "Gain from a redundant motor or brake",
    "places": "Worst {noun}s, and map of the index",
}


def build_sections(facts: AssessmentFacts) -> list[Section]:
    """Build the sections of the report."""
    return [
        Section("", [_describe_single_points(facts)]),
        *[
            Section(
                title.format(noun=facts.noun, others=facts.collision_objects),
                import_module(f"holdfast.interface.presentation.assessment.sections.{name}").blocks(facts),
            )
            for name, title in SECTION_TITLES.items()
        ],
    ]


def _describe_single_points(facts: AssessmentFacts) -> Callout:
    """Describe the single points of failure: in red if the task becomes singular everywhere, in amber if nearly so."""
    run_structure, all_structures = facts.task_structures
    text = explain(facts.assessment.arm, run_structure, all_structures)
    if run_structure.never:
        return Callout(text, "bad", "The task is impossible for this arm")
    if not run_structure.survives:
        return Callout(
            text, "bad", f"A single locked joint {'' if run_structure.fatal else 'nearly '}ends this task in all configurations"
        )
    names = [facts.assessment.arm.joint_names[weakness.joint] for weakness in run_structure.weak]
    fractions = (
        {}
        if facts.assessment.survivors is None or not facts.distribution.reached
        else {name: estimate.value for name, estimate in facts.assessment.survival().items()}
    )
    costly_joints = [
        name
        for name, fraction in fractions.items()
        if fraction <= SMALL_REACH_FRACTION * (1 - facts.distribution.unreached_share)
    ]
    for name in dict.fromkeys([*names, *costly_joints]):
        if name in fractions:
            text += f" Once {name} has locked, {format_percent(fractions[name])} of the poses of this region are still reached."
        else:
            text += f" A run with --after-lock computes the fraction of the region that remains after a lock of {name}."
    if names:
        return Callout(text, "warn", f"A lock of {list_alternatives(names)} nearly ends this task")
    if costly_joints:
        return Callout(text, "warn", f"A lock of {list_alternatives(costly_joints)} leaves little of the region within reach")
    return Callout(text, "good")


def draw_overview(facts: AssessmentFacts) -> report.Figure:
    """Draw the arm and the region on the left and the distribution on the right; 1200 x 520 px at 100 dpi."""
    view = facts.views[0]
    with report.styled_figure(12, 5.2) as figure:
        scene_axes, cdf_axes = figure.subplots(1, 2, width_ratios=[1.08, 1])
        scene, _ = facts.scene
        spans, _ = report.scenes.fit_view_spans(scene.extent, [view], 5.0, 4.1, 4.1)
        report.scenes.draw_view(
            scene_axes, scene, view, facts.color_scale, report.scenes.choose_dot_area(scene, [view], 5.0 / spans[0]), spans, 5.0
        )
        scene_axes.set_title(f"{report.format_label(facts.assessment.arm.name, 30)} and the region, {view.title.lower()}")
        if np.isfinite(scene.values).any():
            report.scenes.add_color_bar(figure, scene, facts.color_scale, [scene_axes], facts.axis_label)
        if facts.has_finite_values:
            optimised = facts.assessment.optimised
            report.draw_cdf(
                cdf_axes,
                facts.curves if optimised is None or not optimised.reached else gain.build_gain_curves(facts, optimised),
                facts.marks,
                xlabel=facts.axis_label,
                ylabel=f"fraction of {facts.noun}s below",
                log=facts.is_logarithmic,
            )
            cdf_axes.set_title(f"P({facts.condition}) = {format_interval(facts.probability)}" if facts.has_threshold else "")
            report.legend_below(figure, cdf_axes, 2)
        else:
            message = "the index is infinite everywhere" if facts.distribution.reached else "no configuration found"
            cdf_axes.text(0.5, 0.5, message, ha="center", va="center", color=report.SOFT)
            cdf_axes.set_axis_off()
    return figure
