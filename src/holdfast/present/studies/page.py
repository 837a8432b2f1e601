"""A study as one HTML page: who keeps what, under which law, and how it was computed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from markupsafe import Markup

from holdfast.assessment.plan import Plan
from holdfast.assessment.single_points import Structure, explain, structure
from holdfast.engine.study import Study
from holdfast.errors import StoreError
from holdfast.notice import says
from holdfast.present.studies.answer import facts, headline
from holdfast.present.studies.designs import sentence, sweep
from holdfast.probability.intervals import Interval
from holdfast.report import figures, page
from holdfast.report.figures import Curve, Mark
from holdfast.report.outcomes import Gains, Stack, share_figure, stack_figure
from holdfast.report.page import Block, Callout, Cell, Code, Page, Picture, Section, Table, Text
from holdfast.studies import results
from holdfast.studies.ranking import Ended, Key, Standing, counted_range, place, row_of, said, standings
from holdfast.studies.results import Assessed, Driven
from holdfast.studies.study_file import thresholds
from holdfast.words import as_given, counted, duration, either, half_width, number, percent

T = TypeVar("T")

_ENDS = ("reaches the target", "stops elsewhere", "keeps moving", "undecided")


@says("drawing the report")
def write(study: Study, path: str | Path, command: str = "") -> Path:
    """Write the report of a study, also of one that is not complete; it says itself how it is made again.

    Raises:
        StoreError: Nothing is computed, a chunk is damaged, or the file cannot be written.
    """
    del command
    return page.write(build(study), path)


def build(study: Study) -> Page:
    """The report as blocks."""
    cells = study.status()
    done, total = sum(s.chunks_done for s in cells), sum(s.chunks for s in cells)
    if not done:
        raise StoreError(f"nothing of '{study.path}' is computed yet; run the study first")
    found = _of(study, "assess", results.assessed)
    laws = [d for d in _of(study, "convergence", results.driven) if d is not None]
    asked = _thresholds(study, found)
    alerts = []
    if done < total:
        missing = f"{done:,} of {total:,} chunks are computed; run the same command again to resume."
        alerts.append(Callout(missing, "bad", "Not complete."))
    sweeps = [s for s in _of(study, "designs", results.swept) if s is not None]
    own = _structures(found)
    stand = standings(found, laws, asked, {key: _joints(plan, s) for key, (plan, s) in own.items()})
    sections = [
        Section("Which arm for what", _standings(stand)),
        Section("Single points of failure by structure", _structure(own)),
        *[Section(f"Designs of {s.labels['arm']}", sweep(s, n)) for n, s in enumerate(sweeps)],
        Section("Arms, indices and laws", _table(found, laws, asked)),
        Section("How the indices are distributed", _distributions(found, asked)),
        Section("Which joint is the worst to lose", _worst(found)),
        Section("Reaching the target with a locked joint that nobody has noticed", _laws(laws)),
        Section("Starts that still reach the target", _others(study, "workspace", results.workspace, "starts", "percent")),
        Section("Tasks that the computer drives", _others(study, "bank", results.bank, "sets of tasks", "percent, or cycles")),
    ]
    arms = list(dict.fromkeys(c["labels"]["arm"] for c in study.cells))
    return Page(
        study.name,
        " ".join([*([headline(stand)] if found or laws or not sweeps else []), *map(sentence, sweeps)]),
        sections,
        facts=facts(stand),
        subtitle=f"A study of {counted(len(arms), 'arm')}: {', '.join(arms)}",
        warnings=alerts,
        method=_provenance(study, found),
        again=_again(study),
    )


def _of(study: Study, job: str, read: Callable[[Study, int], T]) -> list[T]:
    mine = [k for k in range(len(study.cells)) if results.labels_of(study, k)["job"] == job]
    return [read(study, k) for k in mine if study.folder(k).exists()]


def _thresholds(study: Study, found: Sequence[Assessed]) -> dict[Key, float]:
    """Of each index and task."""
    given = thresholds(study.source)
    groups: dict[Key, list[Assessed]] = {}
    for a in found:
        groups.setdefault(_key(a), []).append(a)
    return {key: given.get(key[0], results.threshold(some)) for key, some in groups.items()}


def _key(a: Assessed) -> Key:
    return a.labels["index"], a.labels["task"]


def _row(labels: dict[str, Any]) -> tuple[str, ...]:
    """What makes a row of the table: the arm, and where and with which failures it is looked at."""
    return labels["arm"], labels.get("region", ""), labels.get("failures", "single")


# ---- the answer --------------------------------------------------------------------------------------------------------


def _standings(stand: Sequence[Standing]) -> list[Block]:
    """The first page of a study of several arms: a figure of all questions, and who leads at each."""
    names = list(dict.fromkeys(name for s in stand for name, _ in s.entries))
    if len(names) < 2:
        return []
    shares = []
    for name in names:
        ends = [dict(s.entries).get(name) for s in stand]
        value, low, high = (np.array([np.nan if p is None else getattr(p, x) for p in ends]) for x in ("value", "low", "high"))
        shares.append(Gains(label=name, value=value, low=low, high=high))
    figure = share_figure([s.question for s in stand], shares, "fraction of the poses, or of the motions; bars: 95 % interval")
    rows: list[list[Cell]] = []
    for s in stand:
        (name, p), *rest = s.ranked
        level = s.level[1:]
        alone = "clearly ahead" if p.low > 0 else "perhaps 0 as well"  # the others may be 0 for certain
        sure = "–" if not rest else f"level with {', '.join(level)}" if level else alone
        sure += "".join(f"; {arm}: 0 by structure" for arm in s.ended)
        after: Cell = "–" if not rest else _stacked([rest[0][0], f"{rest[0][1].value:.3f}"])
        question = _stacked([s.question, *[f"in {s.unit}"] * bool(s.unit)])
        rows.append([question, _whole(name), _share(p), after, sure, s.about])
    about = (
        "Of each question the arm with the largest fraction. Clearly ahead: its 95 % interval lies above those of all others; "
        "level: the intervals overlap, and more samples would be needed to tell them apart. Poses: those at which the "
        "index meets the threshold whatever single failure happens. Converges: the arm reaches its target with a locked "
        "joint that its controller does not know of."
    )
    head = ["Question", "first", "fraction, with 95 % interval", "next", "how sure", "of each arm"]
    return [
        Picture(figures.svg(figure, "standings", "Fractions of all arms for every question"), "More is better in every row."),
        Table(rows, head, frozenset({2}), caption=about, wide=True),
    ]


def _structures(found: Sequence[Assessed]) -> dict[Ended, tuple[Plan, Structure]]:
    """Of each arm and task that a lock ends in every configuration: why nothing is left there, whatever the samples."""
    out: dict[Ended, tuple[Plan, Structure]] = {}
    known: dict[tuple[str, str], Structure] = {}
    for a in found:
        if a.labels.get("failures", "single") == "single":
            plan, key = a.plan, (a.plan.arm.fingerprint, a.plan.index.task.name)
            if key not in known:
                known[key] = structure(plan.arm, plan.index.task)
            if not known[key].survives:
                out.setdefault(row_of(a), (plan, known[key]))
    return out


def _structure(own: dict[Ended, tuple[Plan, Structure]]) -> list[Block]:
    return [Callout(explain(plan.arm, s, []), "bad") for plan, s in own.values()]


def _joints(plan: Plan, s: Structure) -> str:
    """The joints whose lock ends a task in every configuration."""
    return either([plan.arm.joint_names[k] for k in s.fatal]) if s.fatal else "any joint"


def _table(found: Sequence[Assessed], laws: Sequence[Driven], asked: dict[Key, float]) -> list[Block]:
    rows = list(dict.fromkeys([*(_row(a.labels) for a in found)] or [_row(d.labels) for d in laws]))
    keys, names = list(asked), list(dict.fromkeys((d.labels["law"], d.labels["task"]) for d in laws))
    if not rows or not (keys or names):
        return []
    regions = len({r[1:] for r in rows if r[0] == rows[0][0]}) > 1
    tasks = len({t for _, t in keys}) > 1
    head: list[Cell] = ["Arm"]
    for index, task in keys:
        measure = next(a for a in found if _key(a) == (index, task)).plan.index
        larger = measure.better == "larger"
        asks = f"{'≥' if larger else '≤'} {as_given(asked[index, task])}"
        head.append(_stacked([measure.name, f"{task}: {asks}" if tasks else asks]))
    head += [_stacked([law, "converges"]) for law, _ in names]
    body: list[list[Cell]] = []
    for row in rows:
        cells: list[Cell] = [_stacked([row[0], f"{row[1]}, {row[2]}"]) if regions else _whole(row[0])]
        for key in keys:
            mine = [a for a in found if _key(a) == key and _row(a.labels) == row]
            cells.append(_assessed(mine[0], asked[key]) if mine else "–")
        for law in names:
            there = [d for d in laws if (d.labels["law"], d.labels["task"]) == law and d.labels["arm"] == row[0]]
            cells.append(_share(there[0].any) if there else "–")
        body.append(cells)
    caption = ""
    if keys:
        caption += (
            "Fraction of the poses of the region whose index meets the threshold whatever single failure happens, with "
            "its 95 % "
            "interval; opt.: at the best configuration of each pose. Thresholds are one for all arms. "
        )
        if any(a.labels["region"] == "default region" for a in found):
            caption += "Default regions are around the home of each arm, sized by its reach, or the paper's. "
    if names:
        caption += (
            "Converges: fraction of random motions that reach their target with one joint locked from the start and a "
            "controller that does not know it, mean over the joints; every law has the same motions of an arm."
        )
    return [Table(body, head, frozenset(range(1, len(head))), caption=caption, wide=True)]


def _assessed(a: Assessed, h: float) -> Cell:
    parts = [a.interval(h, optimised) for optimised in (False, True)]
    if parts[0] is None:
        return "–"
    lines = [_share(parts[0])]
    if parts[1] is not None:
        lines.append(Markup("opt. {}").format(_share(parts[1])))
    return Markup("<br>").join(lines)


def _share(p: Interval) -> Markup:
    return Markup('{:.3f} <span class="quiet">{:.3f} to {:.3f}</span>').format(p.value, p.low, p.high)


def _whole(text: str) -> Markup:
    """Not broken into lines."""
    return Markup('<span style="white-space: nowrap">{}</span>').format(text)


def _stacked(lines: Sequence[str]) -> Markup:
    more = [Markup('<br><span class="quiet">{}</span>').format(x) for x in lines[1:]]
    return Markup("").join([Markup("{}").format(lines[0]), *more])


# ---- why ---------------------------------------------------------------------------------------------------------------


def _distributions(found: Sequence[Assessed], asked: dict[Key, float]) -> list[Block]:
    """A figure of each index and task, with a curve of each arm."""
    blocks: list[Block] = []
    for number_, (key, h) in enumerate(asked.items()):
        mine = [a for a in found if _key(a) == key and a.plain is not None]
        samples = [("As inverse kinematics found them", [(a, a.plain) for a in mine])]
        if any(a.optimised is not None for a in mine):
            samples.append(("At the best configurations", [(a, a.optimised) for a in mine if a.optimised is not None]))
        ends = [x for _, some in samples for _, d in some if d is not None for x in (d.lowest, d.highest) if np.isfinite(x)]
        if not ends:
            continue
        index = mine[0].plan.index
        log = index.better == "smaller" and min(ends) > 0 and max(ends) > 20 * min(ends)
        low, high = min(*ends, h), max(*ends, h)
        axis = np.geomspace(low, high, 801) if log else np.linspace(min(0.0, low), 1.04 * max(0.0, high), 801)
        panels = [
            (title, [Curve(axis, d.cdf(axis), _name(a, mine)) for a, d in some if d is not None]) for title, some in samples
        ]
        unit = said(index.unit, ", ")
        figure = figures.compare_cdf_figure(
            panels,
            [Mark(h, f"threshold {as_given(h)}{said(index.unit)}")],
            f"worst-case {index.name}{unit}",
            ylabel="fraction with a smaller value, F",
            log=log,
        )
        poses = counted_range([d.samples for _, some in samples for _, d in some if d is not None])
        band = max(d.band() for _, some in samples for _, d in some if d is not None)
        text = (
            f"Cumulative distributions of the worst-case {index.name} (task {key[1]}) over {poses} poses of each arm; the 95 % "
            f"band of each curve is {half_width(band)}. A pose without a configuration counts as "
            f"{'0' if index.better == 'larger' else 'infinite'}."
        )
        about = f"Cumulative distributions of the {index.name} of all arms"
        blocks.append(Picture(figures.svg(figure, f"cdf{number_}", about), text))
    return blocks


def _name(a: Assessed, among: Sequence[Assessed]) -> str:
    return place(a.labels, [x.labels for x in among])


def _worst(found: Sequence[Assessed]) -> list[Block]:
    rows: list[list[Cell]] = []
    for a in found:
        if a.plain is None:
            continue
        lost = percent(a.plain.unreached_share)
        medians = [number(float(d.quantile(0.5))) if d.reached else "–" for d in (a.plain, a.optimised) if d is not None]
        worst = "–" if a.worst is None else f"{a.worst[0]} ({percent(a.worst[1])})"
        bound = "not known" if a.plan.index.bound is None else number(a.plan.index.bound)
        left = "–" if a.left is None else number(a.left)
        name, index = _name(a, [x for x in found if _key(x) == _key(a)]), a.plan.index.name
        rows.append([name, index, " → ".join(medians), bound, worst, lost, left])
    if not rows:
        return []
    head = ["Arm", "index", "median", "bound", "worst failure", "poses not reached", "left after a lock"]
    caption = (
        "Median over the reached poses, → at the best configurations; the bound is what no configuration can exceed; the worst "
        "failure is the one that most often leaves the least."
    )
    keep = range(7 if any(a.left is not None for a in found) else 6)
    return [Table([[r[k] for k in keep] for r in rows], [head[k] for k in keep], frozenset({2, 3, 5, 6}), caption=caption)]


def _laws(laws: Sequence[Driven]) -> list[Block]:
    if not laws:
        return []
    stacks = []
    arms = list(dict.fromkeys(d.labels["arm"] for d in laws))
    for arm in arms:
        mine = [d for d in laws if d.labels["arm"] == arm]
        shares = np.stack([d.ends[:-1].mean(axis=0) for d in mine])
        low, high = (np.array([getattr(d.any, end) for d in mine]) for end in ("low", "high"))
        stacks.append(Stack(name=arm, bars=[d.labels["law"] for d in mine], shares=shares, low=low, high=high))
    told = counted_range([d.motions for d in laws])
    figure = stack_figure(stacks, _ENDS, "fraction of the runs, mean over the joint that is locked")
    blocks: list[Block] = [
        Picture(
            figures.svg(figure, "laws", "How motions with a locked joint end, for each arm and law"),
            f"{told} random motions of each arm, between places of the end effector at random configurations, each "
            f"with every joint "
            "locked in turn from the start. Not every target is in reach with a joint locked; undecided: at the time limit, or "
            "next to a singular configuration.",
        )
    ]
    rows: list[list[Cell]] = []
    for d in laws:
        first = next(x for x in laws if x.labels["arm"] == d.labels["arm"] and x.labels["task"] == d.labels["task"])
        better = None if d is first else results.gain(first, d)
        more = "–" if better is None else f"{better.value:+.3f} ({better.low:+.3f} to {better.high:+.3f})".replace("-", "−")
        k = int(np.argmin([p.value for p in d.reaches[:-1]]))
        worst = f"{d.joints[k] if k < len(d.joints) else k + 1}: {d.reaches[k].value:.3f}"
        cells: list[Cell] = [_share(d.any), more, worst, _share(d.reaches[-1]), percent(d.in_reach)]
        cells += [] if laws[0].touched is None else [percent(d.touched or 0.0)]
        rows.append([_whole(d.labels["arm"]), _whole(d.labels["law"]), d.labels["task"], *cells])
    head = ["Arm", "law", "task", "converges", "gain over the first law", "worst joint", "converges, none locked", "in reach"]
    head += [] if laws[0].touched is None else ["touches something, at most"]
    caption = (
        "95 % intervals. The gain is paired: both laws have the same motions. In reach: runs with a locked joint in which a "
        "configuration at the target exists."
    )
    return [*blocks, Table(rows, head, frozenset({3, 4, 6, 7, 8}), caption=caption, wide=True)]


def _others(study: Study, job: str, read: Callable[[Study, int], results.Table | None], noun: str, unit: str) -> list[Block]:
    found = [t for t in _of(study, job, read) if t is not None]
    if not found:
        return []
    names = list(found[0].values)
    rows: list[list[Cell]] = []
    for t in found:
        cells: list[Cell] = [_whole(t.labels["arm"]), _whole(t.labels["law"]), f"{t.samples:,}"]
        for name in names:
            value, low, high = t.values[name]
            sure = "" if np.isnan(low) else f"{low:.1f} to {high:.1f}"
            cells.append(_stacked(["–" if np.isnan(value) else f"{value:.1f}", *[sure] * bool(sure)]))
        rows.append(cells)
    caption = f"{unit.capitalize()}, with 95 % intervals; of an arbitrary joint."
    return [Table(rows, ["Arm", "law", noun, *names], frozenset(range(2, 3 + len(names))), caption=caption, wide=True)]


# ---- how ---------------------------------------------------------------------------------------------------------------


def _provenance(study: Study, found: Sequence[Assessed]) -> list[Block]:
    cells = study.status()
    samples = sum(s.rows_done for s in cells)
    spent, wall = sum(s.seconds for s in cells), sum(r["seconds"] for r in study.runs)
    size = sum(results.store_size(study.store(k)) for k in range(len(cells)) if study.folder(k).exists())
    facts = [
        ("Study", f"{study.name}, seed {study.seed}, digest {study.digest}"),
        ("Cells", f"{len(cells):,}, {sum(s.chunks_done for s in cells):,} of {sum(s.chunks for s in cells):,} chunks"),
        ("Samples", f"{samples:,} rows (poses, motions, starts) in all"),
        ("Time", f"{duration(spent)} of processor time to compute; runs that ended took {duration(wall)}"),
        ("On the disk", f"{size / 1e6:.3g} MB"),
    ]
    for n, run in enumerate(study.runs[-5:]):
        when = f"{run['started']}: {run['chunks']:,} chunks in {duration(run['seconds'])} on {run['on']}"
        facts.append(("Runs" if not n else "", when))
    for n, maker in enumerate(study.makers):
        versions = ", ".join(f"{k} {v}" for k, v in maker["versions"].items())
        facts.append(("Computed on" if not n else "", f"{maker['processor']}; Python {maker['python']}, {versions}"))
    if len(study.makers) > 1:
        facts.append(("Agreement", "computed on one of these alone, values agree to 1e-12; on one kind, in every bit"))
    for region in dict.fromkeys((a.labels["arm"], a.plan.region.describe()) for a in found):
        facts.append((f"Region of {region[0]}", region[1]))
    facts.append(
        ("Intervals", "95 %: exact (Clopper-Pearson) for fractions of poses; betting for means over motions; DKW for curves")
    )
    return [Table([[k, v] for k, v in facts])]


def _again(study: Study) -> list[Block]:
    blocks: list[Block] = [Text("Same file, same versions, same kind of processor: the same bits.", quiet=True)]
    if study.source:
        lines = [x for x in study.source.splitlines() if x.strip() and not x.lstrip().startswith("#")]
        files = [
            Code("holdfast study run study.yaml --out DIR"),
            Code("\n".join(lines), Markup("with <code>study.yaml</code>:")),
        ]
        return [*files, *blocks]
    return blocks
