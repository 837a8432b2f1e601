"""The report of an assessment: one HTML file that begins with the answer, and a picture for other pages."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from importlib import import_module
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from holdfast.assessment.assessment import Assessment
from holdfast.assessment.single_points import explain
from holdfast.present.assessment import method
from holdfast.present.assessment.facts import Facts
from holdfast.present.assessment.sections import gain
from holdfast.report import figures as drawing
from holdfast.report import page, scenes
from holdfast.report.page import Callout, Cell, Page, Section
from holdfast.words import either, interval, number, percent

LITTLE_REACH = 0.1  # of the poses that the healthy arm reaches

# The sections, in order: files of `sections` with a TITLE and blocks(facts: Facts) -> list[Block]; one without is left out.
SECTIONS = (
    "key_numbers",
    "structure",
    "views",
    "distribution",
    "gain",
    "collisions",
    "survival",
    "worst",
    "upgrades",
    "places",
)


def write(assessment: Assessment, path: Path, threshold: float | None = None) -> Path:
    """See :meth:`holdfast.Assessment.report`."""
    return page.write(build(assessment, threshold), path)


def build(assessment: Assessment, threshold: float | None = None) -> Page:
    """The report as blocks, before it becomes HTML; see :func:`write`."""
    facts = Facts(assessment, threshold)
    found = [import_module(f"holdfast.present.assessment.sections.{name}") for name in SECTIONS]
    parts = [Section("", [_verdict(facts)])]
    parts += [Section(each.TITLE.format(noun=facts.noun, others=facts.others), each.blocks(facts)) for each in found]
    a = assessment
    return Page(
        f"Fault tolerance of {a.arm.name}",
        facts.headline,
        parts,
        subtitle=a.region.name,
        warnings=_alerts(facts),
        facts=_numbers(facts),
        method=method.blocks(facts),
        again=method.again(a),
    )


def _verdict(f: Facts) -> Callout:
    """Describe the single points of failure: exact ones in red, near ones in amber."""
    own, everything = f.structures
    text = explain(f.a.arm, own, everything)
    if own.never:
        return Callout(text, "bad", "The task is impossible for this arm")
    if not own.survives:
        return Callout(text, "bad", f"A single locked joint {'' if own.fatal else 'all but '}ends this task everywhere")
    names = [f.a.arm.joint_names[w.joint] for w in own.weak]
    left = {} if f.a.survivors is None or not f.d.reached else {name: p.value for name, p in f.a.survival().items()}
    few = [name for name, share in left.items() if share <= LITTLE_REACH * (1 - f.d.unreached_share)]
    for name in dict.fromkeys([*names, *few]):
        if name in left:
            text += f" Once {name} has locked, {percent(left[name])} of the poses of this region are still reached."
        else:
            text += f" A run with --after-lock computes how much of the region the lock of {name} leaves."
    if names:
        return Callout(text, "warn", f"The lock of {either(names)} nearly ends this task")
    if few:
        return Callout(text, "warn", f"The lock of {either(few)} leaves little of the region")
    return Callout(text, "good")


def _numbers(f: Facts) -> list[tuple[Cell, Cell]]:
    """The answer in a few numbers: never only a zero."""
    a, d = f.a, f.d
    if not d.reached:
        return []
    found: list[tuple[Cell, Cell]] = []
    fatal = f.structures[0].fatal
    if fatal:
        names = either([a.arm.joint_names[k] for k in fatal])
        found.append((names if len(fatal) < 4 else f"{len(fatal)} joints", "whose lock ends the task everywhere, by structure"))
    if f.decided and f.answer.value:
        p = f.answer
        said = f"of the {f.noun}s have an {f.condition}; {percent(p.low)} to {percent(p.high)}, 95 %"
        found.append((percent(p.value), said))
    if not f.nothing:
        bound = "" if f.index.bound is None else f", of at most {f.index.bound:.3f}"
        found.append((number(float(d.quantile(0.5))), f"median index of the {f.reached}{bound}"))
    best = a.optimised
    if best is not None and best.reached and not f.nothing:
        p = a.interval(**{f"at_{'least' if f.larger else 'most'}": f.threshold}, optimised=True)  # type: ignore[arg-type]
        said = f"median at the best configurations; {percent(p.value)} of the {f.noun}s have an {f.condition}"
        found.append((number(float(best.quantile(0.5))), said))
    if f.costliest is not None:
        name, left = f.costliest
        found.append((percent(left), f"of the poses are still reached once {name} has locked, the lock that costs most"))
    if a.worst_counts.sum() > 0:
        k = int(a.worst_counts.argmax())
        often = percent(float(a.worst_counts[k] / a.worst_counts.sum()))
        found.append((f.index.failure_names[k], f"whose lock is the worst failure at {often} of the {f.reached}"))
    return found


def _alerts(f: Facts) -> list[Callout]:
    """What the reader must know before anything else."""
    if f.a.complete:
        return []
    text = f"{f.d.samples:,} of {f.a.poses:,} {f.noun}s are computed; everything below is about these."
    return [Callout(text + " Run the same command again to resume.", "bad", "This run is not complete.")]


def drawings(assessment: Assessment, threshold: float | None = None) -> dict[str, Callable[[], Figure]]:
    """The arm with the region, and the cumulative distribution where there are finite values."""
    facts = Facts(assessment, threshold)
    distribution = {"cdf": partial(gain.cdf_figure, facts)} if facts.drawable else {}
    return {"overview": partial(overview, facts), **distribution}


def overview(facts: Facts) -> Figure:
    """The arm and the region on the left, the distribution on the right; 1200 x 520 px at 100 dpi."""
    view = facts.side
    with drawing.style():
        figure = Figure(figsize=(12, 5.2))
        left, right = figure.subplots(1, 2, width_ratios=[1.08, 1])
        scene, _ = facts.scene
        spans, _ = scenes.view_spans(scene, [view], 5.0, 4.1, 4.1)
        scenes.draw_view(left, scene, view, facts.scale, scenes.dot_size(scene, [view], 5.0 / spans[0]), spans, 5.0)
        left.set_title(f"{drawing.plain(facts.a.arm.name, 30)} and the region, {view.title.lower()}")
        if np.isfinite(scene.values).any():
            scenes.color_bar(figure, scene, facts.scale, [left], facts.axis_label)
        if facts.drawable:
            best = facts.a.optimised
            drawing.draw_cdf(
                right,
                facts.curves if best is None or not best.reached else gain.gain_curves(facts, best),
                facts.marks,
                xlabel=facts.axis_label,
                ylabel=f"fraction of {facts.noun}s below",
                log=facts.log,
            )
            right.set_title(f"P({facts.condition}) = {interval(facts.answer)}" if facts.decided else "")
            drawing.legend_below(figure, right, 2)
        else:
            what = "the index is infinite everywhere" if facts.d.reached else "no configuration found"
            right.text(0.5, 0.5, what, ha="center", va="center", color=drawing.SOFT)
            right.set_axis_off()
        return drawing.finished(figure)
