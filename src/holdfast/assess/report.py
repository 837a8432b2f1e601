"""The report of an assessment: one HTML file that begins with the answer, and a picture for other pages."""

from __future__ import annotations

import math
import shlex
import warnings
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import yaml
from markupsafe import Markup
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from holdfast import arms
from holdfast.arm.model import Arm
from holdfast.arm.task import NAMES, ROWS, Task, as_task
from holdfast.assess.assess import Assessment, _provenance
from holdfast.assess.distribution import Interval
from holdfast.assess.region import Region, rpy_from_rotation
from holdfast.assess.structure import Structure, explain, structure, structures
from holdfast.errors import InputError
from holdfast.failures import FailureSets, failure_sets
from holdfast.indices import BY_NAME
from holdfast.report import figures, page, scenes
from holdfast.report.figures import Bin, Curve, Mark
from holdfast.report.page import Block, Callout, Code, Page, Picture, Section, Table, Text
from holdfast.report.scenes import Scale, Scene, View
from holdfast.report.words import article, as_given, counted, either, fixed, interval, number, percent, share
from holdfast.solve import solver
from holdfast.status import Status

Array = NDArray[np.float64]

_ZERO = 1e-9  # values that a structural failure leaves behind are rounding noise
_MOST_DOTS = 20_000
_MOST_ROWS = 40
_LEAST_FOR_MAP = 200

_FORMULAS = {
    "relative-manipulability": "ρ<sub>S</sub> = √( det(<sup>S</sup>J <sup>S</sup>Jᵀ) / det(J Jᵀ) )",
    "manipulability": "<sup>S</sup>r = √det(<sup>S</sup>J <sup>S</sup>Jᵀ)",
    "mean-singular-value": "(<sup>S</sup>σ<sub>1</sub> + … + <sup>S</sup>σ<sub>m</sub>) / m",
    "geometric-mean-singular-value": "(<sup>S</sup>σ<sub>1</sub> · … · <sup>S</sup>σ<sub>m</sub>)<sup>1/m</sup>",
    "minimum-singular-value": "<sup>S</sup>σ<sub>m</sub>",
    "condition-number": "<sup>S</sup>σ<sub>1</sub> / <sup>S</sup>σ<sub>m</sub>",
}


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
    facts = _Facts(assessment, threshold)
    sections = [
        Section("", [*_structure_callout(facts)]),
        Section("Key numbers", _key_numbers(facts)),
        Section("Single points of failure by structure", _structure_table(facts)),
        Section("The arm and the region", _views(facts)),
        Section("How the index is distributed", _distribution(facts)),
        Section("Which failure is the worst", _worst_failures(facts)),
        Section(f"The worst {facts.noun}s, and where tolerance is low", _places(facts)),
        Section("How it was computed", _method(facts)),
    ]
    a = assessment
    return Page(
        f"Fault tolerance of {a.arm.name}",
        facts.headline,
        [s for s in sections if s.blocks],
        a.region.name,
        _warnings(facts),
        "Written by holdfast. This file needs no network and no other file.",
    )


def overview_figure(assessment: Assessment, threshold: float | None = None) -> Figure:
    """The arm and the region on the left, the distribution on the right; 1200 x 520 px at 100 dpi."""
    facts = _Facts(assessment, threshold)
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


# ---- what is known -----------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Rows:
    """The poses that were computed, with tool poses also for a region of joints."""

    number: NDArray[np.int64]
    position: Array
    rotation: Array
    q: Array
    reached: NDArray[np.bool_]
    value: Array
    by_failure: Array
    worst: NDArray[np.int64]


class _Facts:
    """Everything the report says, computed once."""

    def __init__(self, assessment: Assessment, threshold: float | None) -> None:
        if threshold is not None and not np.isfinite(threshold):
            raise InputError(f"threshold is {threshold:g}; it must be a finite number")
        self.a = assessment
        self.d = assessment.distribution
        self.index = assessment.index
        self.larger = self.index.better == "larger"
        self.noun = "configuration" if assessment.region.kind == "joints" else "pose"
        self.reached = f"{self.noun}s" if assessment.region.kind == "joints" else "reached poses"
        self.chosen = threshold is not None
        self.threshold = self._threshold() if threshold is None else float(threshold)

    def _threshold(self) -> float:
        if self.index.bound is not None:
            return float(f"{self.index.bound / 2:.2g}")
        values = [float(self.d.quantile(p)) for p in (0.5, 0.25)] if self.d.reached else []
        for v in [*values, self.d.highest]:
            if np.isfinite(v) and abs(v) > _ZERO:
                return float(f"{v:.2g}")
        return 1.0

    @property
    def nothing(self) -> bool:
        """The index is at its worst at every reached pose, up to rounding."""
        if self.larger:
            return self.d.reached > 0 and self.d.highest <= _ZERO
        return self.d.reached > 0 and self.d.infinite == self.d.reached

    @property
    def decided(self) -> bool:
        """There is a threshold that means something."""
        return self.chosen or self.index.bound is not None or (self.d.reached > 0 and not self.nothing)

    @property
    def drawable(self) -> bool:
        """There are finite values."""
        return self.d.reached > self.d.infinite

    @cached_property
    def answer(self) -> Interval:
        """Probability that a pose of the region meets the threshold."""
        t = self.threshold
        return self.a.interval(at_least=t) if self.larger else self.a.interval(at_most=t)

    @property
    def condition(self) -> str:
        return f"index {'≥' if self.larger else '≤'} {as_given(self.threshold)}{self.unit}"

    @property
    def axis_label(self) -> str:
        return figures.plain(f"worst-case {self.index.name}{self.unit and ','}{self.unit}")

    @property
    def failures(self) -> str:
        """``whichever joint locks`` and the like."""
        sizes = {len(s) for s in self.index.failures}
        size = sizes.pop() if len(sizes) == 1 else 0
        if size and len(self.index.failures) == math.comb(self.a.arm.n, size):
            return "whichever joint locks" if size == 1 else f"whichever {size} joints lock together"
        count = len(self.index.failures)
        return f"if {either(self.index.failure_names)} locks" if count == 1 else f"after any of the {count} failures considered"

    @cached_property
    def headline(self) -> str:
        """The answer in one sentence."""
        d, name, noun = self.d, self.index.name, self.noun
        if not d.samples:
            return "Nothing has been computed yet."
        if not d.reached:
            return (
                f"No configuration within the joint limits was found for any of the {d.samples:,} poses of the region: "
                "move the region, widen the joint limits or give more restarts."
            )
        lost = (
            f"; for {percent(d.unreached / d.samples)} of poses no configuration within the joint limits was found"
            if d.unreached
            else ""
        )
        if self.nothing:
            worst = "0" if self.larger else "infinite"
            verdict = f"the worst-case {name} is {worst} at each {noun} reached{lost}."
            return f"No {noun} of the region tolerates every failure: {verdict}"
        bound = f"at {'least' if self.larger else 'most'} {as_given(self.threshold)}{self.unit}"
        kept = f"keeps {article(name)} {name} of {bound} {self.failures}{lost}."
        return f"With probability {interval(self.answer)} a {noun} of the region {kept}"

    @property
    def unit(self) -> str:
        """With a space in front, or nothing."""
        return "" if self.index.unit == "1" else f" {self.index.unit}".replace("^2", "²").replace("^3", "³")

    # ---- structure -------------------------------------------------------------------------------------------------

    @cached_property
    def structures(self) -> tuple[Structure, list[Structure]]:
        """Of the task of the run, and of all tasks with that one among them."""
        everything = structures(self.a.arm)
        task = self.index.task
        for s in everything:
            standard = as_task(self.a.arm, s.task)
            if s.task == task.name and standard.rows.shape == task.rows.shape and np.allclose(standard.rows, task.rows):
                return s, everything
        own = structure(self.a.arm, task)
        return own, [own, *everything]

    # ---- rows ------------------------------------------------------------------------------------------------------

    @cached_property
    def rows(self) -> _Rows | None:
        if not self.d.samples or (self.a._rows is None and self.a.store is None):
            return None
        data = self.a.dataset
        status = data["status"].values
        keep = np.flatnonzero(status != Status.NOT_COMPUTED)
        q = data["q"].values[keep]
        if self.a.region.kind == "joints":
            pose = self.a.arm.forward_kinematics(q)
            position, rotation = pose[:, :3, 3], pose[:, :3, :3]
        else:
            position = data["position"].values[keep]
            rotation = Rotation.from_quat(data["quaternion"].values[keep]).as_matrix()
        reached = np.isin(status[keep], (Status.OK, Status.SINGULAR))
        return _Rows(
            keep,
            position,
            rotation,
            q,
            reached,
            data["index"].values[keep],
            data["by_failure"].values[keep],
            data["worst"].values[keep].astype(np.int64),
        )

    @cached_property
    def provenance(self) -> dict[str, object]:
        """When, how long, and with which versions; of this report where the run did not note it."""
        notes = self.a.store.notes if self.a.store is not None else {}
        return notes if "versions" in notes else _provenance(self.a.seconds)

    # ---- figures ---------------------------------------------------------------------------------------------------

    @cached_property
    def representative(self) -> tuple[Array, str]:
        """A configuration to draw, and what it is."""
        a, rows = self.a, self.rows
        if rows is not None and rows.reached.any():
            some = np.flatnonzero(rows.reached)
            k = some[np.argsort(rows.value[some], kind="stable")[(len(some) - 1) // 2]]
            what = (
                "the only one there is" if len(some) == 1 else f"the one with the median index, {number(float(rows.value[k]))}"
            )
            return rows.q[k], f"at {self.noun} {rows.number[k] + 1:,}, {what}"
        center = np.array(a.region.center)
        if a.region.kind == "joints":
            return center, "in the middle of the region"
        if self.d.reached:
            reach = solver(a.arm, self.index.task).solve(
                a.region.poses(center[None]), np.random.SeedSequence(a.seed), a.restarts, 1e-6
            )
            if reach.success[0]:
                return reach.q[0], "at the middle of the region"
        low = np.where(np.isfinite(a.arm.lower), a.arm.lower, -np.pi / 2)
        high = np.where(np.isfinite(a.arm.upper), a.arm.upper, np.pi / 2)
        return (low + high) / 2, "in the middle of its joint limits"

    @cached_property
    def scene(self) -> tuple[Scene, int]:
        """What the views show, and how many poses are drawn."""
        a, rows = self.a, self.rows
        origins, tool = joint_positions(a.arm, self.representative[0])
        chain = np.vstack([a.arm.base[:3, 3], origins, tool])
        none = np.zeros((0, 3))
        points, values, missing, drawn = none, np.zeros(0), none, 0
        if rows is not None:
            chosen = np.arange(len(rows.value))
            if len(chosen) > _MOST_DOTS:
                chosen = np.sort(np.random.default_rng(0).choice(len(chosen), _MOST_DOTS, replace=False))
            ok = rows.reached[chosen]
            points, values, missing = rows.position[chosen[ok]], rows.value[chosen[ok]], rows.position[chosen[~ok]]
            drawn = len(chosen)
        box = None
        if a.region.kind == "box":
            c, s = np.array(a.region.center[:3]), np.array(a.region.size[:3])
            box = np.array([c - s / 2, c + s / 2])
        return Scene(points, values, missing, chain, origins, a.arm.prismatic, box), drawn

    @cached_property
    def views(self) -> list[View]:
        """Side and top view; only one of them if everything lies in its plane."""
        size = np.diff(self.scene[0].extent, axis=0)[0]
        flat = size < 1e-6 * size.max()
        found = [View(0, 2, "Side view"), View(0, 1, "Top view")]
        if size[1] > 1.5 * size[0]:
            found[0] = View(1, 2, "Side view")
        return [v for v in found if not (flat[v.right] or flat[v.up])] or found

    @property
    def side(self) -> View:
        return self.views[0]

    @cached_property
    def log(self) -> bool:
        """Values spread over decades and none is 0: show them on a log scale."""
        return not self.larger and self.d.lowest > 0 and self.d.highest > 20 * self.d.lowest

    @cached_property
    def scale(self) -> Scale:
        """Colours of the dots."""
        values = self.scene[0].values
        if self.nothing and self.larger:
            return Scale(0.0, self.index.bound or 1.0)
        return Scale.of(values, self.log, not self.larger)

    @cached_property
    def axis(self) -> Array:
        """Values of the index at which the CDF is drawn."""
        d, marks = self.d, [m.x for m in self.marks]
        if self.log:
            return np.geomspace(min(d.lowest, *marks) / 1.15, max(d.highest, *marks) * 1.15, 1601)
        finite = [x for x in (d.lowest, d.highest) if np.isfinite(x)]
        high = max([0.0, *finite, *marks])
        low = min([0.0, *finite, *marks])
        return np.linspace(low, high + 0.04 * ((high - low) or 1.0), 1601)

    @cached_property
    def marks(self) -> list[Mark]:
        found = [Mark(self.threshold, f"threshold {as_given(self.threshold)}{self.unit}")] if self.decided else []
        if self.index.bound is not None:
            found.append(Mark(self.index.bound, f"no configuration can exceed {self.index.bound:.3f}", "bound"))
        return found

    @cached_property
    def curves(self) -> list[Curve]:
        band = self.a.distribution.band()
        lost = f" (not found counts as {'0' if self.larger else 'infinite'})" if self.d.unreached else ""
        every = "" if not self.d.unreached else f"all {self.d.samples:,} poses{lost}, "
        first = Curve(
            self.axis,
            self.a.cdf(self.axis),
            f"{every or f'all {self.d.samples:,} {self.noun}s, '}95 % band ±{band:.3f}",
            band=band,
        )
        if not self.d.unreached:
            return [first]
        return [first, Curve(self.axis, self.a.cdf(self.axis, True), f"the {self.d.reached:,} reached poses only", second=True)]

    @cached_property
    def histogram(self) -> Bin:
        """Density over the reached poses, from the CDF, so that it also works for binned distributions."""
        count = int(np.clip(2 * self.d.reached ** (1 / 3), 8, 40)) if self.d.values is not None else 40
        edges = (np.geomspace if self.log else np.linspace)(self.axis[0], self.axis[-1], count + 1)
        share = np.diff(self.a.cdf(edges, True))
        width = np.diff(np.log10(edges)) if self.log else np.diff(edges)
        per = "per decade" if self.log else self.unit and f"per{self.unit}"
        return Bin(edges, share / width, "", f"probability density {per}".strip())


# ---- sections ----------------------------------------------------------------------------------------------------------


def _warnings(f: _Facts) -> list[Callout]:
    if f.a.complete:
        return []
    text = f"{f.d.samples:,} of {f.a.poses:,} {f.noun}s are computed; everything below is about these."
    return [Callout(text + " Run the same command again to go on.", "bad", "This run is not complete.")]


def _structure_callout(f: _Facts) -> list[Block]:
    own, everything = f.structures
    text = explain(f.a.arm, own, everything)
    fatal = not own.survives
    title = "A single locked joint ends this task everywhere" if fatal else ""
    if own.never:
        title = "The task is impossible for this arm"
    return [Callout(text, "bad" if fatal else "good", title)]


def _key_numbers(f: _Facts) -> list[Block]:
    a, d, index = f.a, f.d, f.index
    facts: list[tuple[str, str | Markup]] = [
        ("Arm", f"{a.arm.name}, {a.arm.n} joints"),
        ("Task", index.task.describe()),
        ("Index", f"worst-case {index.name}{f.unit and f', unit{f.unit}'}; {'larger' if f.larger else 'smaller'} is better"),
        ("Failures", f"{len(index.failures)} considered: {_failure_kinds(f)}"),
        ("Region", f"{a.region.name}: {a.region.describe()}"),
        (f"{f.noun.capitalize()}s drawn", f"{d.samples:,}" + ("" if a.complete else f" of {a.poses:,} planned")),
    ]
    if a.region.kind == "box":
        facts.append(("Reached", share(d.reached, d.samples)))
        facts.append(("No configuration found", share(d.unreached, d.samples)))
    facts.append(
        ("Singular", share(d.singular, d.samples) + (f"; count as {'0' if f.larger else 'infinite'}" if d.singular else ""))
    )
    if d.infinite:
        facts.append(("Infinite", share(d.infinite, d.samples) + ", of those with a configuration"))
    if d.samples and f.decided:
        facts.append((f"P({f.condition})", f"{interval(f.answer)}; {_why(f)}"))
        if d.unreached and d.reached:
            t = f.threshold
            only = a.interval(at_least=t, reachable_only=True) if f.larger else a.interval(at_most=t, reachable_only=True)
            facts.append(("The same, reached poses only", interval(only)))
    if d.samples:
        facts.append(
            (
                "Error of the CDF",
                f"at most ±{d.band():.3f} everywhere at once, with 95 % confidence (Dvoretzky-Kiefer-Wolfowitz)",
            )
        )
    if index.bound is not None and d.reached:
        median, best = (0.0 if f.nothing else x for x in (float(d.quantile(0.5)), d.highest))
        facts.append(
            (
                "Largest possible value",
                f"{index.bound:.4f}; the median of the {f.reached} is {percent(median / index.bound)} of it "
                f"(gap {number(index.bound - median)}), the best one found {percent(best / index.bound)}",
            )
        )
    blocks: list[Block] = [Table([[k, v] for k, v in facts])]
    if d.reached:
        blocks.append(_quantiles(f))
    return blocks


def _failure_kinds(f: _Facts) -> str:
    if f.index.failures == failure_sets(f.a.arm, "single"):
        return "each joint locked alone"
    names = f.index.failure_names
    return ", ".join(names) if len(names) <= 12 else f"{', '.join(names[:12])} and {len(names) - 12} more"


def _why(f: _Facts) -> str:
    if f.chosen:
        return "the threshold was given"
    if f.index.bound is not None:
        return "the threshold is half of the largest possible value"
    return f"the threshold is about the median of the {f.reached}, because this index has no known bound"


def _quantiles(f: _Facts) -> Table:
    d = f.d
    steps = (0.05, 0.25, 0.5, 0.75, 0.95)
    finite = " of finite values" if d.infinite else ""
    head = [f"Index over … {f.noun}s", "5 %", "25 %", "median", "75 %", "95 %", f"mean{finite}", "best"]
    best = d.highest if f.larger else d.lowest
    rows = [
        [
            f"the {d.reached:,} reached" if d.unreached else f"all {d.samples:,}",
            *[number(float(x)) for x in d.quantile(steps)],
            number(d.mean),
            number(best),
        ]
    ]
    if d.unreached:
        mean = d.total / d.samples if f.larger else np.inf
        label = f"all {d.samples:,}, not found counts as {'0' if f.larger else 'infinite'}"
        rows.append([label, *[number(float(x)) for x in d.quantile(steps, reachable_only=False)], number(mean), number(best)])
    return Table(rows, head, frozenset(range(1, 8)), wide=True)


def _structure_table(f: _Facts) -> list[Block]:
    own, everything = f.structures
    names = f.a.arm.joint_names
    rows: list[list[str | Markup]] = []
    for s in everything:
        cells: list[str | Markup] = [Markup("{} {}").format(s.task, "(this run)") if s is own else s.task, str(s.redundancy)]
        for k in range(len(names)):
            bad = k in s.fatal or s.never
            cells.append(Markup('<span class="fatal">fatal</span>') if bad else Markup('<span class="ok">–</span>'))
        verdict = (
            "never possible"
            if s.never
            else "not redundant"
            if s.redundancy <= 0
            else "single point of failure"
            if s.fatal
            else "none"
        )
        rows.append([*cells, verdict])
    head = ["Task", "Redundancy", *[str(k + 1) for k in range(len(names))], "Single point of failure"]
    joints = "; ".join(f"{k + 1} {n}" for k, n in enumerate(names))
    return [
        Text(
            "A joint is fatal if the task is singular in every configuration once it locks: no choice of configuration helps."
        ),
        Table(rows, head, frozenset({1}), frozenset(range(2, len(names) + 2)), wide=True),
        Text(f"Joints: {joints}. Redundancy: joints minus rows of the task.", quiet=True),
    ]


def _views(f: _Facts) -> list[Block]:
    scene, drawn = f.scene
    d = f.d
    dots = f"{f.noun} drawn" if f.a.region.kind == "box" else "tool position of a configuration drawn"
    legend = [("base", "base"), ("joint", "joints, numbered from the base"), ("tool", "tool")]
    if f.a.arm.prismatic.any():
        legend.insert(2, ("slide", "sliding joint"))
    if len(scene.points):
        legend.append(("dot", dots))
    if len(scene.missing):
        legend.append(("cross", "no configuration found"))
    if scene.box is not None:
        legend.append(("box", "positions of the region"))
    image = figures.svg(
        scenes.view_figure(scene, f.views, f.scale, f.axis_label, legend),
        "views",
        f"The arm and the {f.noun}s of the region, by index",
    )
    text = f"The arm is drawn {f.representative[1]}."
    if not drawn and d.samples:
        text += f" The {f.noun}s of this run were not kept, so none are drawn."
    elif drawn < d.samples:
        text += f" Of {d.samples:,} {f.noun}s a random {drawn:,} are drawn"
    elif drawn:
        text += f" All {counted(drawn, f.noun)} are drawn"
    if drawn:
        text += "; colour is the index." if len(scene.points) else "."
    if drawn and d.infinite:
        text += " Infinite values have the darkest colour."
    return [Picture(image, text)]


def _distribution(f: _Facts) -> list[Block]:
    d = f.d
    if not f.drawable:
        return [Text(f"The index is infinite at each of the {counted(d.reached, f.noun)} reached.")] if d.reached else []
    titles = (
        f"Density (PDF), {d.reached:,} {'reached ' if d.unreached else ''}{f.noun}s",
        f"Cumulative (CDF), {d.samples:,} {f.noun}s",
    )
    figure = figures.distribution_figure(
        f.histogram, f.curves, f.marks, f.axis_label, "share with a smaller value, F", titles, f.log
    )
    meets = "1 − F" if f.larger else "F"
    text = f"The probability of meeting a threshold is {meets} there"
    text += f": {interval(f.answer)} at {as_given(f.threshold)}{f.unit}." if f.decided else "."
    if d.unreached:
        text += f" The dashed curve leaves out the {counted(d.unreached, 'pose')} for which no configuration was found."
    over = "the reached poses" if d.unreached else f"all {f.noun}s"
    total = f"the {percent(1 - d.infinite / d.reached)} with a finite value" if d.infinite else "1"
    text += f" The density is a histogram of {len(f.histogram.heights)} bins over {over} and adds up to {total}."
    return [Picture(figures.svg(figure, "distribution", "Density and cumulative distribution of the index"), text)]


def _worst_failures(f: _Facts) -> list[Block]:
    names, counts = _failure_labels(f), f.a.worst_counts
    if not f.d.reached:
        return []
    blocks: list[Block] = []
    total = int(counts.sum())
    chosen = np.arange(len(names))
    note = ""
    if len(names) > _MOST_ROWS // 2:
        chosen = np.argsort(-counts, kind="stable")[: _MOST_ROWS // 2]
        note = f" The {len(chosen)} most frequent of {len(names)} failures are shown."
    if total:
        figure = figures.bar_figure(
            [names[k] for k in chosen], [int(counts[k]) for k in chosen], f"{f.noun}s at which this failure is the worst", total
        )
        text = f"Of {total:,} {f.reached} that are not singular; where several failures are equally bad, the first counts."
        blocks.append(Picture(figures.svg(figure, "worst", "How often each failure is the worst"), text + note))
    else:
        blocks.append(Text(f"Every {f.noun} reached is singular, so no failure is worse than another."))
    blocks.append(_failure_table(f, names, counts))
    return blocks


def _failure_labels(f: _Facts) -> list[str]:
    """Numbers from 1 and names: ``4 elbow``, ``2+4 shoulder+elbow``."""
    pairs = zip(f.index.failures, f.index.failure_names, strict=True)
    return [f"{'+'.join(str(k + 1) for k in s)}  {name}" for s, name in pairs]


def _failure_table(f: _Facts, names: list[str], counts: NDArray[np.int64]) -> Block:
    rows = f.rows
    total = max(int(counts.sum()), 1)
    if rows is None:
        return Text(
            "The values after each failure were not kept; assess again with a store or with keep=True for them.", quiet=True
        )
    values = rows.by_failure[rows.reached]
    bad = 0.05 if f.larger else 0.95
    middle, low = np.quantile(values, [0.5, bad], axis=0, method="inverted_cdf")
    met = (values >= f.threshold if f.larger else values <= f.threshold).mean(axis=0)
    chosen = np.arange(len(names))
    if len(chosen) > _MOST_ROWS:
        chosen = np.sort(np.argsort(-counts, kind="stable")[:_MOST_ROWS])
    cells = [
        [names[k], number(float(middle[k])), number(float(low[k])), percent(counts[k] / total), f"{met[k]:.3f}"] for k in chosen
    ]
    sign = "≥" if f.larger else "≤"
    head = ["If this locks", "median", f"{100 * bad:.0f} % quantile", "worst of all", f"P({sign} {as_given(f.threshold)})"]
    if not f.decided:
        head, cells = head[:-1], [c[:-1] for c in cells]
    caption = f"The {f.index.name} after each failure, over {len(values):,} {f.reached}."
    return Table(cells, head, frozenset(range(1, 5)), caption=caption, wide=True)


def _places(f: _Facts) -> list[Block]:
    rows = f.rows
    if rows is None and not f.d.reached:
        return []
    if rows is None:
        return [Text(f"The {f.noun}s of this run were not kept (keep=False), so the report cannot list or map them.")]
    if not rows.reached.any():
        return []
    if f.nothing:
        return [Text(f"Every {f.noun} reached is equally bad, so there is nothing to list or map.")]
    blocks: list[Block] = [_worst_table(f, rows)]
    low, high = rows.position.min(axis=0), rows.position.max(axis=0)
    flat = (high - low) < 1e-6 * max(float((high - low).max()), 1e-6)
    views = [v for v in (View(0, 2, "Seen from the side"), View(0, 1, "Seen from above")) if not (flat[v.right] or flat[v.up])]
    if int(rows.reached.sum()) < _LEAST_FOR_MAP or not views:
        return blocks
    average = "Mean" if f.larger else "Median"
    ok = rows.reached
    figure = scenes.map_figure(
        rows.position[ok],
        rows.value[ok],
        rows.position[~ok],
        views,
        f.log,
        not f.larger,
        figures.plain(f"{average.lower()} {f.index.name}"),
    )
    text = (
        f"{average} index of the {f.reached} in each cell, over the whole depth of the region, and below it how many "
        f"{'poses were reached of how many drawn' if f.d.unreached else f'{f.noun}s there are'}; {len(rows.value):,} in all."
    )
    if f.a.region.kind == "joints":
        text += " Positions are those of the tool."
    return [*blocks, Picture(figures.svg(figure, "map", "Average index over the region"), text)]


def _worst_table(f: _Facts, rows: _Rows) -> Table:
    some = np.flatnonzero(rows.reached)
    order = np.argsort(rows.value[some] if f.larger else -rows.value[some], kind="stable")
    labels = _failure_labels(f)
    chosen = some[order[:10]]
    angles = np.rad2deg(_angles(rows.rotation[chosen], f.a.region))
    cells = []
    for k, rpy in zip(chosen, angles, strict=True):
        worst = labels[rows.worst[k]] if rows.worst[k] >= 0 else "singular"
        place = [*(fixed(x, 3) for x in rows.position[k]), *(fixed(x, 1) for x in rpy)]
        cells.append([f"{rows.number[k] + 1:,}", *place, number(float(rows.value[k])), worst])
    head = [f.noun.capitalize(), "x, m", "y, m", "z, m", "roll, deg", "pitch, deg", "yaw, deg", "index", "worst failure"]
    caption = f"The {len(chosen)} worst of {len(some):,} {f.reached}; R = Rz(roll) Ry(pitch) Rx(yaw)."
    if f.d.unreached:
        caption += f" The {counted(f.d.unreached, 'pose')} without one count as worse still and are not listed."
    return Table(cells, head, frozenset(range(8)), caption=caption, wide=True)


def _angles(rotations: Array, region: Region) -> Array:
    """Roll, pitch, yaw: of the two triples of a rotation, and their turns, the one next to the middle of the region."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # at pitch +-90 degrees one of many triples is as good as another
        first = rpy_from_rotation(rotations)
    center = np.array(region.center[3:]) if region.kind == "box" else np.zeros(3)
    second = np.stack([first[:, 0] + np.pi, np.pi - first[:, 1], first[:, 2] + np.pi], axis=1)
    both = np.stack([first, second])
    both = center + (both - center + np.pi) % (2 * np.pi) - np.pi
    nearest = np.linalg.norm(both - center, axis=2).argmin(axis=0)
    return np.asarray(both[nearest, np.arange(len(nearest))])


def _method(f: _Facts) -> list[Block]:
    a, index = f.a, f.index
    p = f.provenance
    formula = _FORMULAS.get(index.slug)
    worst = "smallest" if f.larger else "largest"
    definition = Markup("the {} value over the failures S").format(worst)
    if formula is not None:
        definition = Markup(
            "the {} over the failures S of {}, where <sup>S</sup>J is the task Jacobian J without the columns of S"
        ).format(worst, Markup(formula))
        if "σ" in formula:
            definition += Markup(" and <sup>S</sup>σ<sub>1</sub> ≥ … ≥ <sup>S</sup>σ<sub>m</sub> are its singular values")
    if index.source:
        definition += Markup(". Source: {}").format(index.source)
    box = a.region.kind == "box"
    facts: list[tuple[str, str | Markup]] = []
    nothing = "0" if f.larger else "infinite"
    if box:
        solved = f"damped least squares from up to {a.restarts:,} random starts within the joint limits"
        facts += [
            (
                "Method",
                f"{a.sampling} poses of the region; inverse kinematics of each ({solved}); what it finds is evaluated as it is",
            ),
            (
                "Not optimised",
                "configurations are what inverse kinematics happened to find, not the most tolerant ones for their pose (the "
                "non-optimised sample of Abdi et al. 2012): choosing better ones by the redundancy improves these numbers",
            ),
            (
                "Not found",
                f"none of {a.restarts:,} starts led to a configuration within the joint limits; this does not prove that there "
                f"is none. Such a pose counts as {nothing} unless 'reached only' is said",
            ),
        ]
        if index.task.m < 6:
            free = (
                f"task '{index.task.name}' fixes {index.task.m} of 6 directions; the others of a drawn pose are not asked for"
            )
            facts.append(("Free directions", free))
    else:
        facts.append(("Method", f"{a.sampling} configurations of the region, evaluated directly, without inverse kinematics"))
    if a.sampling == "sobol":
        bars = "intervals and the band assume independent samples; for scrambled Sobol points they are conservative in practice"
        facts.append(("Error bars", bars))
    facts += [
        ("Index", definition),
        (
            "Singular",
            "smallest singular value of J at most 1e-12 times the largest; the index is then "
            f"{'0' if f.larger else 'infinite'} by convention",
        ),
        ("Failures", "a locked joint stands still where it failed"),
        ("Intervals", "95 %: Wilson score for a probability, Dvoretzky-Kiefer-Wolfowitz for a whole CDF"),
        ("Region", f"{a.region.name}: {a.region.describe()}{_ranges(a)}"),
        ("Arm", a.arm.source or "no source given"),
        ("Fingerprint of the arm", Markup("<code>{}</code>").format(a.arm.fingerprint)),
        (
            "Seed, samples",
            f"seed {a.seed}, {a.poses:,} {f.noun}s, {a.sampling} sampling" + (f", {a.restarts:,} restarts" if box else ""),
        ),
        ("Time", f"{p['seconds']:.1f} s" if isinstance(p.get("seconds"), (int, float)) else "not noted"),
        ("Versions", _versions(p)),
    ]
    blocks: list[Block] = [Table([[k, v] for k, v in facts])]
    command, note = command_line(a)
    if command is None:
        return [*blocks, Text(note)]
    blocks.append(Code(command, "The same run again" + (f" ({note}):" if note else ":")))
    blocks.append(Code(region_file(a.region), Markup("with <code>region.yaml</code>:")))
    return blocks


def _ranges(a: Assessment) -> str:
    """Of a region of joints, in degrees and metres."""
    if a.region.kind != "joints":
        return ""
    parts = []
    for joint, c, s in zip(a.arm.joints, a.region.center, a.region.size, strict=True):
        unit, scale = ("m", 1.0) if joint.prismatic else ("deg", 180 / np.pi)
        parts.append(f"{joint.name} {as_given(scale * (c - s / 2))} to {as_given(scale * (c + s / 2))} {unit}")
    return ": " + ", ".join(parts)


def _versions(provenance: dict[str, object]) -> str:
    found = provenance.get("versions")
    parts = [f"{name} {v}" for name, v in found.items()] if isinstance(found, dict) else []
    return ", ".join([*parts, f"Python {provenance.get('python', '')}", str(provenance.get("machine", ""))])


# ---- the same run again ------------------------------------------------------------------------------------------------


def command_line(a: Assessment) -> tuple[str | None, str]:
    """The command that makes the run again from ``region.yaml``, or None, and a remark."""
    index, task = a.index, a.index.task
    if index.slug not in BY_NAME:
        return None, "The index is a function of your own, so no command line makes this run again; keep the script."
    asked = _task_option(a.arm, task)
    if asked is None:
        return None, "The task is of your own making, so no command line makes this run again; keep the script."
    remark = ""
    if a.arm.name in arms.names() and arms.load(a.arm.name).fingerprint == a.arm.fingerprint:
        spec = a.arm.name
    else:
        known = a.arm.source.lower().endswith((*arms.URDF_ENDINGS, *arms.TABLE_ENDINGS)) and "\n" not in a.arm.source
        spec = a.arm.source if known else "ARM"
        what = "the file of the arm where you have it" if known else "ARM is the file of the arm"
        remark = f"{what}; for a URDF file also its --base and --tip, if any"
    options = {"region": "region.yaml", "index": index.slug, "task": asked}
    if task.length != 1.0:
        options["length"] = repr(task.length)
    if index.failures != failure_sets(a.arm, "single"):
        options["failures"] = _failures_option(a.arm, index.failures)
    options |= {"poses": str(a.poses), "seed": str(a.seed), "sampling": a.sampling}
    if a.region.kind == "box":
        options["restarts"] = str(a.restarts)
    lines = [f"holdfast assess {shlex.quote(spec)}"]
    for name, value in options.items():
        word = f"--{name} {shlex.quote(value)}"
        if len(lines[-1]) + len(word) > 90:
            lines[-1] += " \\"
            lines.append("    " + word)
        else:
            lines[-1] += " " + word
    return "\n".join(lines), remark


def _task_option(arm: Arm, task: Task) -> str | None:
    """What ``--task`` says for a task, if it can."""
    if task.name in NAMES:
        standard = as_task(arm, task.name, task.length)
        return task.name if standard.frame == task.frame and np.array_equal(standard.rows, task.rows) else None
    picked = task.rows.argmax(axis=1)
    return f"{task.frame}:{','.join(ROWS[k] for k in picked)}" if np.array_equal(np.eye(6)[picked], task.rows) else None


def _failures_option(arm: Arm, failures: FailureSets) -> str:
    """What ``--failures`` says: how many joints fail together, or the sets."""
    size = len(failures[0])
    if size < arm.n and failures == failure_sets(arm, size):
        return str(size)
    plain = not any(c in name for name in arm.joint_names for c in "+;")
    text = "; ".join("+".join(arm.joint_names[k] if plain else str(k + 1) for k in f) for f in failures)
    return text + ";" if text.isdigit() else text  # a lone number would be how many


def region_file(region: Region) -> str:
    """The region as the YAML text that :meth:`Region.load` reads, with every digit."""
    center, size = list(region.center), list(region.size)
    data: dict[str, object] = {"name": region.name, "angles": "rad"}
    if region.kind == "box":
        data["box"] = {"center": center[:3], "size": size[:3], "rpy_center": center[3:], "rpy_size": size[3:]}
    else:
        low = [c - s / 2 for c, s in zip(center, size, strict=True)]
        data["joints"] = {"lower": low, "upper": [c + s / 2 for c, s in zip(center, size, strict=True)]}
    text: str = yaml.safe_dump(data, sort_keys=False, allow_unicode=True, default_flow_style=None, width=100)
    return text.rstrip()


# ---- the arm in space --------------------------------------------------------------------------------------------------


def joint_positions(arm: Arm, q: Array) -> tuple[Array, Array]:
    """Origins (n, 3) of the joint frames, and the tool point (3,), in the world, m, at one configuration (n,)."""
    t = np.array(arm.base)
    origins = np.empty((arm.n, 3))
    for k, joint in enumerate(arm.joints):
        t = t @ joint.origin
        moved = np.eye(4)
        if joint.prismatic:
            moved[:3, 3] = q[k] * joint.axis
            t = t @ moved  # the slider is drawn where it is, not where its rail begins
            origins[k] = t[:3, 3]
        else:
            origins[k] = t[:3, 3]
            moved[:3, :3] = Rotation.from_rotvec(q[k] * joint.axis).as_matrix()
            t = t @ moved
    return origins, (t @ arm.tool)[:3, 3]
