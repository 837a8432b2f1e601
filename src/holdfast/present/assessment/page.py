"""The report of an assessment: one HTML file that begins with the answer, and a picture for other pages."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from holdfast.assessment.assessment import Assessment
from holdfast.present.assessment import places_section as places
from holdfast.present.assessment import sections
from holdfast.present.assessment import worst_section as worst
from holdfast.present.assessment.collisions_section import collisions
from holdfast.present.assessment.facts import Facts
from holdfast.present.assessment.gain_section import gain
from holdfast.present.assessment.survival_section import survival
from holdfast.report import figures, page, scenes
from holdfast.report.page import Page, Section
from holdfast.words import interval


def write(assessment: Assessment, path: Path, threshold: float | None = None) -> Path:
    """Write the report as one HTML file that needs nothing else.

    Args:
        assessment: What to report.
        path: The file; it is replaced in one step.
        threshold: The value of the index that the task needs. Half of the largest possible value if there is one, else
            the median over the reached poses.

    Raises:
        StoreError: The file cannot be written; what was there is as it was.
        InputError: The threshold is not a finite number.
    """
    return page.write(build(assessment, threshold), path)


def build(assessment: Assessment, threshold: float | None = None) -> Page:
    """The report as blocks, before it becomes HTML; see :func:`write`."""
    facts = Facts(assessment, threshold)
    parts = [
        Section("", [*sections.structure_callout(facts)]),
        Section("Key numbers", sections.key_numbers(facts)),
        Section("Single points of failure by structure", sections.structure_table(facts)),
        Section("The arm and the region", sections.views(facts)),
        Section("How the index is distributed", sections.distribution(facts)),
        Section("What choosing configurations gains", gain(facts)),
        Section("Does the arm run through itself?", collisions(facts)),
        Section("What survives a locked joint", survival(facts)),
        Section("Which failure is the worst", worst.worst_failures(facts)),
        Section("Which joint deserves the redundant motor or brake", worst.upgrades(facts)),
        Section(f"The worst {facts.noun}s, and where tolerance is low", places.places(facts)),
        Section("How it was computed", sections.method(facts)),
    ]
    a = assessment
    return Page(
        f"Fault tolerance of {a.arm.name}",
        facts.headline,
        [s for s in parts if s.blocks],
        a.region.name,
        sections.alerts(facts),
        "Written by holdfast. This file needs no network and no other file.",
    )


def overview_figure(assessment: Assessment, threshold: float | None = None) -> Figure:
    """The arm and the region on the left, the distribution on the right; 1200 x 520 px at 100 dpi."""
    facts = Facts(assessment, threshold)
    view = facts.side
    with figures.style():
        figure = Figure(figsize=(12, 5.2))
        left, right = figure.subplots(1, 2, width_ratios=[1.08, 1])
        scene, _ = facts.scene
        spans, _ = scenes.view_spans(scene, [view], 5.0, 4.1, 4.1)
        scenes.draw_view(left, scene, view, facts.scale, scenes.dot_size(scene, [view], 5.0 / spans[0]), spans, 5.0)
        left.set_title(f"{figures.plain(facts.a.arm.name, 30)} and the region, {view.title.lower()}")
        if np.isfinite(scene.values).any():
            scenes.color_bar(figure, scene, facts.scale, [left], facts.axis_label)
        if facts.drawable:
            figures.draw_cdf(right, facts.curves, facts.marks, facts.axis_label, f"share of {facts.noun}s below", facts.log)
            right.set_title(f"P({facts.condition}) = {interval(facts.answer)}" if facts.decided else "")
            figures.legend_below(figure, right, 4)
        else:
            what = "the index is infinite everywhere" if facts.d.reached else "no configuration found"
            right.text(0.5, 0.5, what, ha="center", va="center", color=figures.SOFT)
            right.set_axis_off()
        return figures.finished(figure)
