"""The report of a search of designs: one HTML file that begins with what to build and what that gains."""

from __future__ import annotations

import csv
import io
import shlex
from pathlib import Path

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast import arms
from holdfast.arms.dh_file import text as table_text
from holdfast.designs.designs import Checked, Designs, chosen, interval_text
from holdfast.designs.space import DesignSpace
from holdfast.failures import failure_sets
from holdfast.files.output import put
from holdfast.notice import says
from holdfast.present.commands import failures_option, on_lines, region_file, region_files, task_option
from holdfast.present.designs.console import at_bound
from holdfast.present.designs.figures import arms_figure, front_figure
from holdfast.present.story import how
from holdfast.report import figures as drawing
from holdfast.report import page
from holdfast.report.figures import Curve, Mark
from holdfast.report.page import Block, Callout, Cell, Code, Page, Picture, Section, Table, Text
from holdfast.words import as_given, capitalised, counted, either, number, percent

Array = NDArray[np.float64]

ARM_FILE = "best-arm.yaml"
_MOST_FRONT = 10  # designs of the front in the table
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


@says("drawing the report")
def write(designs: Designs, path: Path) -> Path:
    """What to build, what that gains, and what it costs in reach, as a page."""
    return page.write(build(designs), path)


@says("writing the results")
def save(d: Designs, folder: Path) -> list[Path]:
    """report.html, best-arm.yaml, designs.csv and, for what comes next, region.yaml if the region can be stored."""
    texts = {ARM_FILE: arm_file(d), "designs.csv": _table(d)}
    if d.region.storable:
        texts["region.yaml"] = region_file(d.region) + "\n"
        if d.region.listed is not None:
            texts["poses.csv"] = d.region.listed.table()
    files = put(folder, texts)
    return [d.report(folder / "report.html"), *files]


def _table(d: Designs) -> str:
    """All designs as CSV, rad and m."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    names = [f"{p.name} ({p.unit})" for p in d.space.parameters]
    writer.writerow(["design", *names, "guaranteed", "reach (m)", "reached", "on the front"])
    front = set(d.front.tolist())
    columns = (d.guaranteed, d.reach, d.reached)
    for k, values in enumerate(d.values.tolist()):
        writer.writerow([k, *values, *(float(c[k]) for c in columns), int(k in front)])
    return out.getvalue()


def figures(d: Designs) -> dict[str, Figure]:
    """All designs by reach and quantile of the index; the given arm and the best design, unless that is the same."""
    start = (d.start_reach, d.start_guaranteed)
    drawn = {"front": front_figure(d.reach, d.guaranteed, d.front.tolist(), d.best, start, _label(d), d.index.bound)}
    if not d.best_is_start:
        drawn["arms"] = arms_figure(d.space.arm, d.arm(d.best), d.index.task, d.region, d.seed)
    return drawn


def build(designs: Designs) -> Page:
    """The report as blocks, before it becomes HTML."""
    d, drawn = designs, figures(designs)
    sections = [
        Section("", _remarks(d)),
        Section("What to build", [parameters_table(d.space, d.values[d.best])]),
        Section("Before and after", [] if d.best_is_start else _arms(drawn["arms"])),
        Section("Index quantile against reach", _front(d, drawn["front"])),
        Section("How the index is distributed, before and after", _distributions(d)),
        Section("The best arm as a file", _file(d)),
    ]
    return Page(
        f"Designs of {d.space.arm.name}",
        d.headline,
        sections,
        subtitle=f"{d.region.name}; {', '.join(d.space.names)}",
        facts=_facts(d),
        method=_method(d),
        again=_again(d),
    )


def _facts(d: Designs) -> list[tuple[Cell, Cell]]:
    """Index quantile before and after, on fresh poses, and the change of reach."""
    given, best = d.checked.given, d.checked.best
    often = f"least index at {chosen(d.level)} of fresh poses"
    found: list[tuple[Cell, Cell]] = []
    if best.guaranteed.value:
        found.append((number(best.guaranteed.value), f"{often}, {'the given arm' if d.best_is_start else 'the best design'}"))
    if given.guaranteed.value and not d.best_is_start:
        found.append((number(given.guaranteed.value), f"{often}, the given arm"))
    found.append(
        (number(float(best.distribution.quantile(0.5, reachable_only=False))), "median of the fresh poses, best design")
    )
    found.append((f"{number(float(d.reach[d.best]))} m", f"reach of the best design; the given arm: {number(d.start_reach)} m"))
    return [x for x in found if x[0] != "0"]


# ---- what to build -------------------------------------------------------------------------------------------------------


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


def _arms(figure: Figure) -> list[Block]:
    text = (
        "Each arm with its tool at the middle of the region (dashed), or in the middle of its joint limits if it does not get "
        "there. Circles are joints, squares prismatic joints; the orange diamond is the tool point. Equal scales."
    )
    return [Picture(drawing.svg(figure, "arms", "The given arm and the best design"), text)]


# ---- why -----------------------------------------------------------------------------------------------------------------


def _label(d: Designs) -> str:
    return drawing.plain(f"{d.index.name}, least at {chosen(d.level)} of the poses")


def _front(d: Designs, figure: Figure) -> list[Block]:
    text = (
        f"Guaranteed: the worst-case {d.index.name} that {chosen(d.level)} of the {counted(d.poses, 'pose')} of the search "
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
    head: list[Cell] = ["", "reach, m", f"least at {chosen(d.level)} of the poses", "poses reached"]
    head += [f"{p.name}, {p.shown[1]}" for p in d.space.parameters]
    shown = "all of them" if len(picked) == len(d.front) else f"{len(picked)} of {len(d.front)}, spread over the reach"
    caption = f"Designs of the front by reach ({shown}): none that was found has more of both."
    return [
        Picture(drawing.svg(figure, "front", "Guaranteed index against reach of all designs"), text),
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
            axis,
            c.distribution.cdf(axis),
            f"{drawing.plain(name, 40)}, 95 % band ±{c.distribution.band():.3f}",
            second=second,
            band=band,
        )
        for c, name, second in ((best, "best design", False), (given, "given arm", True))
        for band in (c.distribution.band(),)
    ]
    unit = "" if d.index.unit == "1" else f", {d.index.unit}"
    label = drawing.plain(f"worst-case {d.index.name}{unit}")
    figure = drawing.cdf_figure(curves, marks, label, ylabel="fraction of poses with a smaller value, F", width=8.0)
    samples = d.checked.best.distribution.samples
    seen, fresh = float(d.guaranteed[d.best]), best.guaranteed
    text = (
        f"{samples:,} fresh poses of the region, which had no part in the search, each at its best configuration; a pose that "
        f"is not reached counts as 0. A curve crosses {chosen(1 - d.level)} at the quantile in the table."
    )
    rows: list[list[Cell]] = [
        [name, interval_text(c.guaranteed), number(float(c.distribution.quantile(0.5, reachable_only=False))), _reached(c)]
        for name, c in (("given arm", given), ("best design", best))
    ]
    head = ["", f"least at {chosen(d.level)} of the poses", "median", "poses reached"]
    honest = (
        f"On the {counted(d.poses, 'pose')} on which it was chosen the best design keeps {number(seen)}; on fresh ones "
        f"{number(fresh.value)}. The difference, {number(seen - fresh.value)}, is the optimism of choosing on them."
    )
    return [
        Picture(drawing.svg(figure, "cdf", "Cumulative distributions of the given arm and the best design"), text),
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


def _file(d: Designs) -> list[Block]:
    label = Markup("<code>{}</code>, which every command takes as ARM:").format(ARM_FILE)
    check = f"holdfast assess {ARM_FILE} --region region.yaml --task {_task(d)} --optimise --out check"
    return [
        Code(arm_file(d).rstrip(), label),
        Text("It has no masses: those of links of other lengths are not known.", quiet=True),
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
    return on_lines(f"holdfast design {shlex.quote(spec)}", words), remark


def _method(d: Designs) -> list[Block]:
    joints = either([d.space.arm.joint_names[k] for k in sorted({k for f in d.index.failures for k in f})])
    facts: list[tuple[str, Cell]] = [
        ("Index", f"worst-case {d.index.name} over the lock of {joints}; larger is better"),
        ("Task", d.index.task.name),
        ("Region", f"{d.region.name}: {d.region.describe()}; the same for all designs"),
        (
            "Guaranteed",
            f"the {chosen(1 - d.level)} quantile, over the poses of the region, of the index at the best configuration of "
            "each pose; a pose that is not reached counts as 0",
        ),
        *d.method,
        ("Seed", str(d.seed)),
    ]
    if d.seconds is not None:
        facts.append(("Time", f"{d.seconds:.0f} s"))
    return how(d.space.arm, *facts, called="given arm")


def _again(d: Designs) -> list[Block]:
    line, remark = command(d)
    return [Code(line, remark and f"{capitalised(remark)}:"), *(region_files(d.region) if d.region.storable else [])]
