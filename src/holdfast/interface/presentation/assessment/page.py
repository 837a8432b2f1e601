"""HTML report of an assessment, which begins with the answer, and a figure for other pages."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from importlib import import_module
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from holdfast.core.formatting import format_interval, format_number, format_percent, list_alternatives
from holdfast.interface.presentation.assessment import method
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.presentation.assessment.sections import gain
from holdfast.interface.report import figures as drawing
from holdfast.interface.report import page, scenes
from holdfast.interface.report.page import Callout, Cell, Page, Section
from holdfast.studies.assessment.assessment import Assessment
from holdfast.studies.assessment.single_points import explain

SMALL_REACH_FRACTION = 0.1  # of the poses that the healthy arm reaches

# Titles of the sections in order, by files of `sections` with a function blocks(facts) -> list[Block]; empty ones are omitted.
SECTION_TITLES = {
    "key_numbers": "Key numbers",
    "structure": "Single points of failure by structure",
    "views": "The arm and the region",
    "distribution": "How the index is distributed",
    "gain": "What choosing configurations gains",
    "collisions": "Does the arm collide with {others}?",
    "survival": "What survives a locked joint",
    "worst": "Which failure is the worst",
    "upgrades": "Which joint deserves a redundant motor or brake",
    "places": "The worst {noun}s, and where tolerance is low",
}


def write(assessment: Assessment, path: Path, threshold: float | None = None) -> Path:
    """Write the HTML report of an assessment. See :meth:`holdfast.Assessment.report`."""
    return page.write(build(assessment, threshold), path)


def build(assessment: Assessment, threshold: float | None = None) -> Page:
    """Build the report as blocks, before it becomes HTML. See :func:`write`."""
    facts = AssessmentFacts(assessment, threshold)
    sections = [Section("", [_describe_single_points(facts)])]
    sections += [
        Section(
            title.format(noun=facts.noun, others=facts.collision_objects),
            import_module(f"holdfast.interface.presentation.assessment.sections.{name}").blocks(facts),
        )
        for name, title in SECTION_TITLES.items()
    ]
    run = assessment
    return Page(
        f"Fault tolerance of {run.arm.name}",
        facts.headline,
        sections,
        subtitle=run.region.name,
        warnings=_list_alerts(facts),
        facts=_list_answer_numbers(facts),
        method=method.blocks(facts),
        again=method.build_rerun_blocks(run),
    )


def _describe_single_points(facts: AssessmentFacts) -> Callout:
    """Describe the single points of failure: exact ones in red, near ones in amber."""
    run_structure, all_structures = facts.task_structures
    text = explain(facts.assessment.arm, run_structure, all_structures)
    if run_structure.never:
        return Callout(text, "bad", "The task is impossible for this arm")
    if not run_structure.survives:
        return Callout(
            text, "bad", f"A single locked joint {'' if run_structure.fatal else 'all but '}ends this task everywhere"
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
            text += f" A run with --after-lock computes how much of the region the lock of {name} leaves."
    if names:
        return Callout(text, "warn", f"The lock of {list_alternatives(names)} nearly ends this task")
    if costly_joints:
        return Callout(text, "warn", f"The lock of {list_alternatives(costly_joints)} leaves little of the region")
    return Callout(text, "good")


def _list_answer_numbers(facts: AssessmentFacts) -> list[tuple[Cell, Cell]]:
    """List the few numbers that answer the question; a number is never only a zero."""
    assessment, distribution = facts.assessment, facts.distribution
    if not distribution.reached:
        return []
    entries: list[tuple[Cell, Cell]] = []
    fatal = facts.task_structures[0].fatal
    if fatal:
        names = list_alternatives([assessment.arm.joint_names[index] for index in fatal])
        entries.append(
            (names if len(fatal) < 4 else f"{len(fatal)} joints", "whose lock ends the task everywhere, by structure")
        )
    if facts.has_threshold and facts.probability.value:
        probability = facts.probability
        label = (
            f"of the {facts.noun}s have an {facts.condition}; {format_percent(probability.low)} to "
            f"{format_percent(probability.high)}, 95 %"
        )
        entries.append((format_percent(probability.value), label))
    if not facts.is_worst_everywhere:
        bound = "" if facts.index.bound is None else f", of at most {facts.index.bound:.3f}"
        entries.append((format_number(float(distribution.quantile(0.5))), f"median index of the {facts.reached_noun}{bound}"))
    optimised = assessment.optimised
    if optimised is not None and optimised.reached and not facts.is_worst_everywhere:
        side = "at_least" if facts.larger_is_better else "at_most"
        probability = assessment.interval(**{side: facts.threshold}, optimised=True)  # type: ignore[arg-type]
        label = (
            f"median at the best configurations; {format_percent(probability.value)} of the {facts.noun}s have an "
            f"{facts.condition}"
        )
        entries.append((format_number(float(optimised.quantile(0.5))), label))
    if facts.costliest_lock is not None:
        name, fraction = facts.costliest_lock
        entries.append(
            (format_percent(fraction), f"of the poses are still reached once {name} has locked, the lock that costs most")
        )
    if assessment.worst_counts.sum() > 0:
        index = int(assessment.worst_counts.argmax())
        frequency = format_percent(float(assessment.worst_counts[index] / assessment.worst_counts.sum()))
        entries.append(
            (facts.index.failure_names[index], f"whose lock is the worst failure at {frequency} of the {facts.reached_noun}")
        )
    return entries


def _list_alerts(facts: AssessmentFacts) -> list[Callout]:
    """Warn about a run that is not complete."""
    if facts.assessment.complete:
        return []
    message = (
        f"{facts.distribution.samples:,} of {facts.assessment.poses:,} {facts.noun}s are computed; everything below "
        f"is about these."
    )
    return [Callout(message + " Run the same command again to resume.", "bad", "This run is not complete.")]


def drawings(assessment: Assessment, threshold: float | None = None) -> dict[str, Callable[[], Figure]]:
    """Return functions that draw the arm with the region and, where there are finite values, the cumulative distribution."""
    facts = AssessmentFacts(assessment, threshold)
    distribution = {"cdf": partial(gain.draw_cdf_figure, facts)} if facts.has_finite_values else {}
    return {"overview": partial(draw_overview, facts), **distribution}


def draw_overview(facts: AssessmentFacts) -> Figure:
    """Draw the arm and the region on the left and the distribution on the right; 1200 x 520 px at 100 dpi."""
    view = facts.main_view
    with drawing.style():
        figure = Figure(figsize=(12, 5.2))
        scene_axes, cdf_axes = figure.subplots(1, 2, width_ratios=[1.08, 1])
        scene, _ = facts.scene
        spans, _ = scenes.fit_view_spans(scene, [view], 5.0, 4.1, 4.1)
        scenes.draw_view(
            scene_axes, scene, view, facts.color_scale, scenes.choose_dot_area(scene, [view], 5.0 / spans[0]), spans, 5.0
        )
        scene_axes.set_title(f"{drawing.format_label(facts.assessment.arm.name, 30)} and the region, {view.title.lower()}")
        if np.isfinite(scene.values).any():
            scenes.add_color_bar(figure, scene, facts.color_scale, [scene_axes], facts.axis_label)
        if facts.has_finite_values:
            optimised = facts.assessment.optimised
            drawing.draw_cdf(
                cdf_axes,
                facts.curves if optimised is None or not optimised.reached else gain.build_gain_curves(facts, optimised),
                facts.marks,
                xlabel=facts.axis_label,
                ylabel=f"fraction of {facts.noun}s below",
                log=facts.is_logarithmic,
            )
            cdf_axes.set_title(f"P({facts.condition}) = {format_interval(facts.probability)}" if facts.has_threshold else "")
            drawing.legend_below(figure, cdf_axes, 2)
        else:
            message = "the index is infinite everywhere" if facts.distribution.reached else "no configuration found"
            cdf_axes.text(0.5, 0.5, message, ha="center", va="center", color=drawing.SOFT)
            cdf_axes.set_axis_off()
        return drawing.settle_layout(figure)
