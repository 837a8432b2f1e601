"""The sections of a report, one function each."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from holdfast import grammar
from holdfast.assessment.assessment import Assessment
from holdfast.assessment.single_points import explain
from holdfast.failures import failure_sets
from holdfast.present.assessment import collisions_section as collisions
from holdfast.present.assessment.facts import Facts
from holdfast.present.commands import capsule_files, command_line, region_files
from holdfast.registry import INDICES
from holdfast.report import figures, scenes
from holdfast.report.page import Block, Callout, Code, Picture, Table, Text
from holdfast.words import as_given, counted, interval, number, percent

Array = NDArray[np.float64]

_ZERO = 1e-9  # values that a structural failure leaves behind are rounding noise
_MOST_DOTS = 20_000
_MOST_ROWS = 40
_LEAST_FOR_MAP = 200


def alerts(f: Facts) -> list[Callout]:
    """What the reader must know before anything else."""
    if f.a.complete:
        return []
    text = f"{f.d.samples:,} of {f.a.poses:,} {f.noun}s are computed; everything below is about these."
    return [Callout(text + " Run the same command again to go on.", "bad", "This run is not complete.")]


def structure_callout(f: Facts) -> list[Block]:
    """Single points of failure by structure, said at once."""
    own, everything = f.structures
    text = explain(f.a.arm, own, everything)
    fatal = not own.survives
    title = "A single locked joint ends this task everywhere" if fatal else ""
    if own.never:
        title = "The task is impossible for this arm"
    return [Callout(text, "bad" if fatal else "good", title)]


def key_numbers(f: Facts) -> list[Block]:
    """The table of key numbers."""
    a, d, index = f.a, f.d, f.index
    facts: list[tuple[str, str | Markup]] = [
        ("Arm", f"{a.arm.name}, {a.arm.n} joints"),
        ("Task", index.task.describe()),
        ("Index", f"worst-case {index.name}{f.unit and f', unit{f.unit}'}; {'larger' if f.larger else 'smaller'} is better"),
        ("Failures", f"{len(index.failures)} considered: {_failure_kinds(f)}"),
        ("Region", f"{a.region.name}: {a.region.describe()}"),
        (f"{f.noun.capitalize()}s drawn", f"{d.samples:,}" + ("" if a.complete else f" of {a.poses:,} planned")),
    ]
    if a.region.kind != "joints":
        facts.append(("Reached", f.share(d.reached)))
        facts.append(("No configuration found", f.share(d.unreached)))
    if d.weighted and d.samples:
        facts.append(("Weights", f.weights))
    facts.append(("Singular", f.share(d.singular) + (f"; count as {'0' if f.larger else 'infinite'}" if d.singular else "")))
    if d.infinite:
        facts.append(("Infinite", f.share(d.infinite) + ", of those with a configuration"))
    through = collisions.summary(f)
    if through:
        facts.append(("Runs through itself", through))
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
        parts = []
        for name, which, _ in f.samples:
            if not which.reached:
                continue
            median, best = (0.0 if f.nothing else x for x in (float(which.quantile(0.5)), which.highest))
            parts.append(
                f"{name + ', ' if len(f.samples) > 1 else ''}the "
                f"median of the {f.reached} is {percent(median / index.bound)} of it "
                f"(gap {number(index.bound - median)}), the best one {percent(best / index.bound)}"
            )
        what = "Upper bound" if index.bound_note else "Largest possible value"
        noted = f"{index.bound:.4f}" + (f" ({index.bound_note})" if index.bound_note else "")
        facts.append((what, "; ".join([noted, *parts])))
    blocks: list[Block] = [Table([[k, v] for k, v in facts])]
    if d.reached:
        blocks.append(_quantiles(f))
    return blocks


def _failure_kinds(f: Facts) -> str:
    if f.index.failures == failure_sets(f.a.arm, "single"):
        return "each joint locked alone"
    names = f.index.failure_names
    return ", ".join(names) if len(names) <= 12 else f"{', '.join(names[:12])} and {len(names) - 12} more"


def _why(f: Facts) -> str:
    if f.chosen:
        return "the threshold was given"
    if f.index.bound is not None:
        return f"the threshold is half of the {'upper bound' if f.index.bound_note else 'largest possible value'}"
    return f"the threshold is about the median of the {f.reached}, because this index has no known bound"


def _quantiles(f: Facts) -> Table:
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
        mean = d.total / d.total_weight() if f.larger else np.inf
        label = f"all {d.samples:,}, not found counts as {'0' if f.larger else 'infinite'}"
        rows.append([label, *[number(float(x)) for x in d.quantile(steps, reachable_only=False)], number(mean), number(best)])
    return Table(rows, head, frozenset(range(1, 8)), wide=True)


def structure_table(f: Facts) -> list[Block]:
    """Every task and the joints it cannot lose."""
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


def views(f: Facts) -> list[Block]:
    """The arm and the region, from the side and from above."""
    scene, drawn = f.scene
    d = f.d
    dots = f"{f.noun} drawn" if f.a.region.kind != "joints" else "tool position of a configuration drawn"
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


def distribution(f: Facts) -> list[Block]:
    """Density and cumulative distribution."""
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


def method(f: Facts) -> list[Block]:
    """How it was computed, and the command that does it again."""
    a, index = f.a, f.index
    p = f.provenance
    entry = INDICES.get(index.slug) if INDICES.storable(index) else None
    formula = entry.formula if entry else ""
    worst = "smallest" if f.larger else "largest"
    definition = Markup("the {} value over the failures S").format(worst)
    if formula:
        definition = Markup(
            "the {} over the failures S of {}, where <sup>S</sup>J is the task Jacobian J without the columns of S"
        ).format(worst, Markup(formula))
        if "σ" in formula:
            definition += Markup(" and <sup>S</sup>σ<sub>1</sub> ≥ … ≥ <sup>S</sup>σ<sub>m</sub> are its singular values")
    for name, value in index.settings.items() if formula else ():
        definition += Markup("; {} {}").format(name, grammar.written(value))
    if index.source:
        definition += Markup(". Source: {}").format(index.source)
    box = a.region.kind != "joints"
    facts: list[tuple[str, str | Markup]] = []
    nothing = "0" if f.larger else "infinite"
    if box:
        solved = f"damped least squares from up to {a.restarts:,} random starts within the joint limits"
        facts += [
            (
                "Method",
                f"{f.drawn}; inverse kinematics of each ({solved}); what it finds is evaluated as it is",
            ),
            (
                "Not optimised",
                "configurations are what inverse kinematics happened to find, not the most tolerant ones for their pose (the "
                "non-optimised sample of Abdi et al. 2012): choosing better ones by the redundancy improves these numbers"
                + ("; see what that gains above" if a.optimised is not None else ""),
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
        ("Intervals", "95 %: Clopper-Pearson (exact) for a probability, Dvoretzky-Kiefer-Wolfowitz for a whole CDF"),
        ("Region", f"{a.region.name}: {a.region.describe()}{_ranges(a)}"),
        ("Arm", a.arm.provenance),
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
    return [*blocks, *region_files(a.region), *capsule_files(a)]


def _ranges(a: Assessment) -> str:
    """Of a region of joints, in degrees and metres."""
    if a.region.kind != "joints":
        return ""
    parts = []
    for joint, c, s in zip(a.arm.joints, a.region.center, a.region.size, strict=True):
        scale, unit = joint.shown
        parts.append(f"{joint.name} {as_given(scale * (c - s / 2))} to {as_given(scale * (c + s / 2))} {unit}")
    return ": " + ", ".join(parts)


def _versions(provenance: dict[str, object]) -> str:
    found = provenance.get("versions")
    parts = [f"{name} {v}" for name, v in found.items()] if isinstance(found, dict) else []
    return ", ".join([*parts, f"Python {provenance.get('python', '')}", str(provenance.get("machine", ""))])
