"""The report of a search of designs: one HTML file that begins with what to build and what that gains."""

from __future__ import annotations

import math
import shlex
from pathlib import Path

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from holdfast import arms
from holdfast.arms.dh_file import text as table_text
from holdfast.assessment.rows import provenance
from holdfast.designs.choice import SAME, farther
from holdfast.designs.designs import Checked, Designs
from holdfast.designs.space import DesignSpace, Parameter
from holdfast.failures import failure_sets
from holdfast.present.commands import failures_option, region_file, region_files, task_option
from holdfast.present.designs.figures import arms_figure, front_figure
from holdfast.probability.intervals import Interval
from holdfast.report import figures, page
from holdfast.report.figures import Curve, Mark
from holdfast.report.page import Block, Callout, Cell, Code, Page, Picture, Section, Table, Text
from holdfast.words import article, as_given, counted, either, number, percent

Array = NDArray[np.float64]

ARM_FILE = "best-arm.yaml"
_MOST_FRONT = 10  # designs of the front in the table
_AT_BOUND = 1e-6  # of the width between the bounds
_WORDS = {
    "a": "length of link {row} (a)",
    "alpha": "twist of link {row} (alpha)",
    "d": "offset of joint {row} (d)",
    "theta": "angle of joint {row} at 0 (theta)",
    "lower": "lower limit of joint {row}",
    "upper": "upper limit of joint {row}",
    "x": "tool point, x",
    "y": "tool point, y",
    "z": "tool point, z",
    "roll": "tool, roll",
    "pitch": "tool, pitch",
    "yaw": "tool, yaw",
}


def write(designs: Designs, path: str | Path) -> Path:
    """Write the report as one HTML file that needs nothing else.

    Raises:
        StoreError: The file cannot be written; what was there is as it was.
    """
    return page.write(build(designs), path)


def build(designs: Designs) -> Page:
    """The report as blocks, before it becomes HTML."""
    d = designs
    sections = [
        Section("", _remarks(d)),
        Section("What to build", [parameters_table(d.space, d.values[d.best])]),
        Section("Before and after", [] if d.best_is_start else _arms(d)),
        Section("What is guaranteed against how far the arm reaches", _front(d)),
        Section("How the index is distributed, before and after", _distributions(d)),
        Section("The best arm as a file", _file(d)),
        Section("How it was computed", _method(d)),
    ]
    return Page(
        f"Designs of {d.space.arm.name}",
        headline(d),
        [s for s in sections if s.blocks],
        f"{d.region.name}; {', '.join(d.space.names)}",
        footer="Written by holdfast. This file needs no network and no other file.",
    )


def headline(d: Designs) -> str:
    """The answer in one or two sentences."""
    given, best = d.checked.given, d.checked.best
    name, share = d.index.name, _share(d.level)
    if not best.guaranteed.value > 0 and not given.guaranteed.value > 0:
        return (
            f"No design within these bounds guarantees any {name} for {share} of the poses of the region: too many poses are "
            "not reached, or a joint whose lock ends the task remains. Widen the bounds, or give a smaller region or level."
        )
    more = farther(d.guaranteed, d.reach, d.best)
    if d.best_is_start:
        text = (
            f"Nothing that guarantees more than the given arm was found: for {share} of the poses of the region its {name} is "
            f"at least {_interval(given.guaranteed)}, {_failures(d)}."
        )
        return f"{text} {more}".rstrip()
    if d.guaranteed[d.best] <= (1 + SAME) * d.start_guaranteed:
        return (
            f"No design guarantees more than the given arm, but the best one guarantees as much, {_interval(best.guaranteed)} "
            f"for {share} of the poses (the given arm {_interval(given.guaranteed)}), and reaches {d.reach[d.best]:.3f} m "
            f"instead of {d.start_reach:.3f} m. {more}"
        ).rstrip()
    if best.guaranteed.value <= given.guaranteed.value:
        return (
            f"No gain that lasts was found: on the {counted(d.poses, 'pose')} of the search the best design guarantees a "
            f"{name} of {number(float(d.guaranteed[d.best]))}, but on fresh ones {_interval(best.guaranteed)}, and the given "
            f"arm {_interval(given.guaranteed)}. Search with more poses."
        )
    reaches = f"The reach goes from {d.start_reach:.3f} m to {d.reach[d.best]:.3f} m."
    return (
        f"For {share} of the poses of the region the best design keeps {article(name)} {name} of at least "
        f"{_interval(best.guaranteed)}, {_failures(d)}; the given arm {_interval(given.guaranteed)}. {reaches} {more}"
    ).rstrip()


# ---- what to build -------------------------------------------------------------------------------------------------------


def _share(x: float) -> str:
    """A share that somebody chose."""
    return f"{100 * x:.4g} %"


def _interval(p: Interval) -> str:
    return f"{number(p.value)} ({number(p.low)} to {number(p.high)}, {100 * p.confidence:.4g} %)"


def _failures(d: Designs) -> str:
    sizes = {len(f) for f in d.index.failures}
    if len(sizes) > 1 or len(d.index.failures) != math.comb(d.space.arm.n, min(sizes)):
        return "after any of the failures considered"
    return "whichever joint locks" if sizes == {1} else f"whichever {min(sizes)} joints lock together"


def at_bound(p: Parameter, value: float) -> str:
    """``lower`` or ``upper`` if a value is at that bound, else nothing."""
    slack = _AT_BOUND * (p.upper - p.lower)
    return "lower" if value <= p.lower + slack else "upper" if value >= p.upper - slack else ""


def bounds_callout(space: DesignSpace, best: Array) -> list[Block]:
    """Numbers of the best design (k,) that are at their bounds, if any are."""
    stuck = [f"{p.name} ({p.text(x)})" for p, x in zip(space.parameters, best.tolist(), strict=True) if at_bound(p, x)]
    if not stuck:
        return []
    what = "is at its bound" if len(stuck) == 1 else "are at their bounds"
    text = f"{', '.join(stuck)} of the best design {what}: wider ones may give more, if that can be built."
    return [Callout(text, title="Bounds")]


def _remarks(d: Designs) -> list[Block]:
    blocks: list[Block] = []
    if d.best_is_start:
        return blocks
    blocks += bounds_callout(d.space, d.values[d.best])
    lost, lost_before = (c.distribution.unreached_share for c in (d.checked.best, d.checked.given))
    if lost > lost_before + 0.005:
        blocks.append(
            Callout(
                f"The best design does not reach {percent(lost)} of the poses of the region, the given arm "
                f"{percent(lost_before)}. They count as index 0.",
                "bad",
                "Poses that are lost",
            )
        )
    return blocks


def parameters_table(space: DesignSpace, best: Array) -> Table:
    """The numbers of the given arm and of the best design (k,)."""
    rows: list[list[Cell]] = []
    for p, before, after in zip(space.parameters, space.start.tolist(), best.tolist(), strict=True):
        factor, unit = p.shown
        row = None if p.row is None else p.row + 1
        side = at_bound(p, after)
        rows.append(
            [
                p.name,
                _WORDS[p.kind].format(row=row),
                _value(before * factor),
                Markup("<strong>{}</strong>").format(_value(after * factor)),
                unit,
                f"{_value(p.lower * factor)} to {_value(p.upper * factor)}",
                f"at the {side} bound" if side else "",
            ]
        )
    head = ["Parameter", "what it is", "given arm", "best design", "unit", "bounds", ""]
    caption = (
        "Rows and joints are numbered from the base, in the standard Denavit-Hartenberg table of the arm; the tool is in the "
        "frame of the last row, roll, pitch and yaw as in URDF."
    )
    return Table(rows, head, frozenset({2, 3, 5}), caption=caption, wide=True)


def _value(x: float) -> str:
    return f"{round(x, 4) + 0.0:.6g}".replace("-", "−")


def _arms(d: Designs) -> list[Block]:
    given, best = d.space.arm, d.arm(d.best)
    figure = arms_figure(given, best, d.index.task, d.region, d.seed)
    text = (
        "Each arm with its tool at the middle of the region (dashed), or in the middle of its joint limits if it does not get "
        "there. Circles are joints, squares sliding joints; the orange diamond is the tool point. Equal scales."
    )
    return [Picture(figures.svg(figure, "arms", "The given arm and the best design"), text)]


# ---- why -----------------------------------------------------------------------------------------------------------------


def _label(d: Designs) -> str:
    return figures.plain(f"guaranteed {d.index.name} ({_share(d.level)} of the poses)")


def _front(d: Designs) -> list[Block]:
    start = (d.start_reach, d.start_guaranteed)
    figure = front_figure(d.reach, d.guaranteed, d.front.tolist(), d.best, start, _label(d), d.index.bound)
    text = (
        f"Guaranteed: the worst-case {d.index.name} that {_share(d.level)} of the {counted(d.poses, 'pose')} of the search "
        "have at least, each at its best configuration; a pose that is not reached counts as 0. Reach: the largest distance of "
        "the tool point from the base frame's origin within the joint limits. These are the poses on which designs were "
        "chosen; see below for fresh ones."
    )
    picked = _spread(d.front, d.best)
    rows: list[list[Cell]] = []
    for k in picked:
        cells: list[Cell] = ["best" if k == d.best else "", f"{d.reach[k]:.3f}", number(float(d.guaranteed[k]))]
        cells.append(percent(float(d.reached[k])))
        cells += [_value(x * p.shown[0]) for p, x in zip(d.space.parameters, d.values[k].tolist(), strict=True)]
        rows.append(cells)
    head: list[Cell] = ["", "reach, m", "guaranteed", "poses reached"]
    head += [f"{p.name}, {p.shown[1]}" for p in d.space.parameters]
    shown = "all of them" if len(picked) == len(d.front) else f"{len(picked)} of {len(d.front)}, spread over the reach"
    caption = f"Designs of the front by reach ({shown}): none that was found has more of both."
    return [
        Picture(figures.svg(figure, "front", "Guaranteed index against reach of all designs"), text),
        Table(rows, head, frozenset(range(1, len(head))), caption=caption, wide=True),
    ]


def _spread(front: NDArray[np.int64], best: int) -> list[int]:
    """A few numbers of the front, its ends and the best among them."""
    if len(front) <= _MOST_FRONT:
        return [int(k) for k in front]
    places = set(np.round(np.linspace(0, len(front) - 1, _MOST_FRONT)).astype(int).tolist())
    places |= {int(k) for k in np.flatnonzero(front == best)}
    return [int(front[k]) for k in sorted(places)]


def _distributions(d: Designs) -> list[Block]:
    given, best = d.checked.given, d.checked.best
    ends = [x for c in (given, best) if c.distribution.reached for x in (c.distribution.highest,) if np.isfinite(x)]
    if not ends:
        return [Text("Neither arm reaches a pose of the region.")]
    marks = [Mark(d.index.bound, f"no configuration can exceed {d.index.bound:.3f}", "bound")] if d.index.bound else []
    axis = np.linspace(0.0, 1.04 * max(*ends, *[m.x for m in marks]), 801)
    curves = [
        Curve(
            axis, c.distribution.cdf(axis), f"{figures.plain(name, 40)}, 95 % band ±{c.distribution.band():.3f}", second, band
        )
        for c, name, second in ((best, "best design", False), (given, "given arm", True))
        for band in (c.distribution.band(),)
    ]
    unit = "" if d.index.unit == "1" else f", {d.index.unit}"
    label = figures.plain(f"worst-case {d.index.name}{unit}")
    figure = figures.cdf_figure(curves, marks, label, "share of poses with a smaller value, F", width=8.0)
    samples = d.checked.best.distribution.samples
    seen, fresh = float(d.guaranteed[d.best]), best.guaranteed
    text = (
        f"{samples:,} fresh poses of the region, which had no part in the search, each at its best configuration; a pose that "
        f"is not reached counts as 0. Where a curve crosses {_share(1 - d.level)} is the guaranteed value."
    )
    rows: list[list[Cell]] = [
        [name, _interval(c.guaranteed), number(float(c.distribution.quantile(0.5, reachable_only=False))), _reached(c)]
        for name, c in (("given arm", given), ("best design", best))
    ]
    head = ["", f"guaranteed for {_share(d.level)} of the poses", "median", "poses reached"]
    honest = (
        f"On the {counted(d.poses, 'pose')} on which it was chosen the best design guarantees {number(seen)}; on fresh ones "
        f"{number(fresh.value)}. The difference, {number(seen - fresh.value)}, is what choosing flatters."
    )
    return [
        Picture(figures.svg(figure, "cdf", "Cumulative distributions of the given arm and the best design"), text),
        Table(rows, head, frozenset({1, 2, 3})),
        Text(honest),
    ]


def _reached(checked: Checked) -> str:
    return percent(1 - checked.distribution.unreached_share)


# ---- to take along -------------------------------------------------------------------------------------------------------


def arm_file(d: Designs) -> str:
    """The best arm as a file that every command takes."""
    arm = d.arm(d.best)
    return table_text(d.space.table_of(d.values[d.best]), arm.name, arm.gravity, arm.source)


def files(d: Designs, table: str) -> dict[str, str]:
    """Names and texts of what lies beside the report: the best arm, the designs, and the region if it can be stored."""
    texts = {ARM_FILE: arm_file(d), "designs.csv": table}
    if d.region.storable:
        texts["region.yaml"] = region_file(d.region) + "\n"
        if d.region.listed is not None:
            texts["poses.csv"] = d.region.listed.table()
    return texts


def _file(d: Designs) -> list[Block]:
    label = Markup("<code>{}</code>, which every command takes as ARM:").format(ARM_FILE)
    check = f"holdfast assess {ARM_FILE} --region region.yaml --task {_task(d)} --optimise --out check"
    return [
        Code(arm_file(d).rstrip(), label),
        Text("Masses are not in it: those of links of other lengths are not known.", quiet=True),
        Code(check, "Its own report over the same region:"),
    ]


def _task(d: Designs) -> str:
    return shlex.quote(task_option(d.space.arm, d.index.task) or "TASK")


def command(d: Designs) -> tuple[str, str]:
    """The command that makes the search again, and a remark."""
    space = d.space
    spec, words, remark = arms.command_words(space.arm)
    words += [f"--vary {shlex.quote(p.written)}" for p in space.parameters]
    words += [f"--maximise {d.index.label}", "--region region.yaml", f"--task {_task(d)}"]
    if d.index.task.length != 1.0:
        words.append(f"--length {d.index.task.length!r}")
    if d.index.failures != failure_sets(space.arm, "single"):
        words.append(f"--failures {shlex.quote(failures_option(space.arm, d.index.failures))}")
    words += [f"--level {as_given(d.level)}", f"--poses {d.poses}", f"--designs {d.screened}", f"--climbs {d.climbs}"]
    words += [f"--fresh {d.checked.best.distribution.samples}", f"--seed {d.seed}"]
    lines = [f"holdfast design {shlex.quote(spec)}"]
    for word in words:
        if len(lines[-1]) + len(word) > 90:
            lines[-1] += " \\"
            lines.append("    " + word)
        else:
            lines[-1] += " " + word
    return "\n".join(lines), remark


def _method(d: Designs) -> list[Block]:
    joints = either([d.space.arm.joint_names[k] for k in sorted({k for f in d.index.failures for k in f})])
    facts: list[tuple[str, Cell]] = [
        ("Given arm", f"{d.space.arm.name}: {d.space.arm.provenance}"),
        ("Index", f"worst-case {d.index.name} over the lock of {joints}; larger is better"),
        ("Task", d.index.task.name),
        ("Region", f"{d.region.name}: {d.region.describe()}; the same for all designs"),
        (
            "Guaranteed",
            f"the {_share(1 - d.level)} quantile, over the poses of the region, of the index at the best configuration of "
            "each pose; a pose that is not reached counts as 0",
        ),
        *d.method,
        ("Seed", str(d.seed)),
    ]
    p = provenance(d.seconds)
    if d.seconds is not None:
        facts.append(("Time", f"{d.seconds:.0f} s"))
    found = p["versions"]
    facts.append(("Versions", ", ".join([*(f"{k} {v}" for k, v in found.items()), f"Python {p['python']}", str(p["machine"])])))
    facts.append(("Fingerprint of the given arm", Markup("<code>{}</code>").format(d.space.arm.fingerprint)))
    line, remark = command(d)
    blocks: list[Block] = [Table([[k, v] for k, v in facts])]
    blocks.append(Code(line, "The same search again" + (f" ({remark}):" if remark else ":")))
    return [*blocks, *(region_files(d.region) if d.region.storable else [])]
