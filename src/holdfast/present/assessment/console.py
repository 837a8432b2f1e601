"""An assessment in numbers and words."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.assessment.answer import ZERO, Answer
from holdfast.assessment.upgrade import MOST_OPTIMISED_AGAIN
from holdfast.errors import InputError
from holdfast.present.assessment.explanations import explain_index
from holdfast.present.clearance.shape import shape_summary, shape_text
from holdfast.present.printing import Rows, number, plain
from holdfast.words import counted

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.assessment.assessment import Assessment
    from holdfast.assessment.upgrade import Upgrade
    from holdfast.probability.distribution import Distribution

Thresholds = Sequence[float] | None
_USUAL_THRESHOLDS = (0.05, 0.1, 0.2, 0.3)  # of an index with a bound


def key_table(result: Assessment) -> Rows:
    """How many poses are reached, how the index is distributed over them, and which failure is most often the worst."""
    d, counts = result.distribution, result.worst_counts
    rows = [["poses reached", f"{d.reached:,} of {d.samples:,}"]]
    for which, when in ((d, "as found"), (result.optimised, "at the best configurations")):
        if which is not None and which.reached:
            low, middle, high = map(number, which.quantile([0.05, 0.5, 0.95]).tolist())
            rows.append([f"{result.index.name} {when}: median (5 to 95 %)", f"{middle} ({low} to {high})"])
    if result.index.bound is not None:
        rows.append(["no configuration can exceed", number(result.index.bound)])
    if counts.sum() > 0:
        k = int(counts.argmax())
        rows.append(
            [
                "most often the worst failure",
                f"{result.index.failure_names[k]} ({100 * counts[k] / counts.sum():.0f} % of them)",
            ]
        )
    return Rows(["", ""], rows)


def next_steps(result: Assessment, name: str) -> list[str]:
    """What would help most, and the whole report."""
    steps = [f"{name}.upgrades()[0]  # the joint that deserves a redundant motor or brake"] if result.kept else []
    if result.optimised is None and result.region.kind != "joints":
        again = f"hf.assess({name}.arm, {name}.region, {name}.index, poses=200, optimise=True)"
        steps.append(f"{again}  # what choosing configurations gains")
    if result.region.kind == "box" and result.index.task.name in ("position", "pose") and not result.distribution.unreached:
        steps.append(f"hf.certify({name}.claim())  # that every pose of the region is reached, not only a sample")
    return [*steps, f'{name}.report("report.html")']


def to_dict(
    result: Assessment,
    thresholds: Thresholds = None,
    rates: Mapping[str | int, float] | None = None,
    report: Path | None = None,
) -> dict[str, Any]:
    """See :meth:`Assessment.to_dict`."""
    return {**numbers(result, thresholds, rates), "report": None if report is None else str(report)}


def numbers(result: Assessment, thresholds: Thresholds, rates: Mapping[str | int, float] | None = None) -> dict[str, Any]:
    """All of it but where its report is."""
    d = result.distribution
    reached = d.reached > 0
    found: dict[str, Any] = plain(
        {
            **result.arm.entry(),
            "fingerprint": result.arm.fingerprint,
            "index": result.index.label,
            "unit": result.index.unit,
            "better": result.index.better,
            "bound": result.index.bound,
            "bound_note": result.index.bound_note,
            "best_known": result.index.best_known,
            "task": result.index.task.name,
            "characteristic_length_m": result.index.task.length,
            "region": result.region.to_dict(),
            "poses": result.poses,
            "seed": result.seed,
            "sampling": result.sampling,
            "restarts": result.restarts,
            "complete": result.complete,
            "evaluated": d.samples,
            "reached": d.reached,
            "not_found": d.unreached,
            "singular": d.singular,
            "effective_sample_size": d.effective() if d.weighted and d.samples else None,
            "mean": d.mean if reached else None,
            "quantiles": _quantiles(d) if reached else None,
            "band_95": d.band() if d.samples else None,
            "probability": [_probability(result, h) for h in _thresholds(result, thresholds)] if d.samples else [],
            "gap": result.gap(),
            "worst_counts": dict(zip(result.index.failure_names, result.worst_counts.tolist(), strict=True)),
            "upgrades": _upgrades(result, thresholds),
            "optimised": _optimised(result, thresholds),
            "clearance": _clearance(result),
            "after_lock": _after_lock(result),
            "expected_survival": result.expected_survival(rates) if rates and d.samples else None,
            "seconds": result.seconds,
        }
    )
    return found


def _quantiles(d: Distribution) -> dict[str, float]:
    return dict(zip(["0.05", "0.5", "0.95"], d.quantile([0.05, 0.5, 0.95]).tolist(), strict=True))


def _optimised(result: Assessment, thresholds: Thresholds) -> dict[str, Any] | None:
    d, counts = result.optimised, result.optimised_worst_counts
    if d is None or counts is None or not d.reached:
        return None
    return {
        "mean": d.mean,
        "quantiles": _quantiles(d),
        "probability": [_probability(result, h, optimised=True) for h in _thresholds(result, thresholds)],
        "gap": result.gap(optimised=True),
        "worst_counts": dict(zip(result.index.failure_names, counts.tolist(), strict=True)),
        "upgrades": _upgrades(result, thresholds, optimised=True),
    }


def _clearance(result: Assessment) -> dict[str, Any] | None:
    """How often the arm collides with itself or its cell; None if that was not looked at."""
    found, clearance = result.collisions, result.plan.clearance
    if found is None or clearance is None:
        return None
    chosen = result.optimised is not None
    counts = {
        "found": found.found,
        "best_without_regard": found.blocked if chosen else None,
        "none_clear": found.hopeless if chosen else None,
    }
    shares = {f"{name}_fraction": n / found.reached if n is not None and found.reached else None for name, n in counts.items()}
    clear = None if result.clear is None or not result.distribution.samples else result.reached_clear()
    around = {
        "found_with": found.with_each or None,
        "best_barred_by": found.blocked_by if found.blocked_by and chosen else None,
        "reached_clear": None if clear is None else {"value": clear.value, "low": clear.low, "high": clear.high},
    }
    return {"reached": found.reached, **counts, **shares, **around, **shape_summary(clearance, found.margin)}


def _upgrades(result: Assessment, thresholds: Thresholds, optimised: bool = False) -> dict[str, Any] | None:
    """What joints that never fail would gain at the first threshold; None if the rows were not kept."""
    if not result.kept or not result.distribution.samples:
        return None
    threshold = thresholds[0] if thresholds else result.default_threshold()
    found = best_upgrades(result, threshold) if optimised else result.upgrades(threshold)
    return {"threshold": threshold, "joints": [asdict(u) for u in found]}


def best_upgrades(result: Assessment, threshold: float) -> list[Upgrade]:
    """Gains at configurations optimised again without each joint; none where the run or its index does not allow that."""
    try:
        return [] if result.optimised is None else result.upgrades(threshold, optimised=True)
    except InputError:  # an index of a class of the user's own cannot be built again for fewer failures
        return []


def _after_lock(result: Assessment) -> dict[str, Any] | None:
    if result.survivors is None or not result.distribution.samples:
        return None
    locks = result.locks
    return {
        name: {"value": p.value, "low": p.low, "high": p.high, "locked_at": locks[name]}
        for name, p in result.survival().items()
    }


def _thresholds(result: Assessment, given: Thresholds) -> Sequence[float]:
    if given:
        return given
    samples = [d for d in (result.distribution, result.optimised) if d is not None and d.reached]
    highest = max((d.highest for d in samples), default=np.inf)
    if result.index.bound is not None:
        usual = [h for h in _USUAL_THRESHOLDS if h < result.index.bound]
        some = [h for h in usual if h <= highest]
        if len(some) > 1 or highest <= ZERO or not samples:
            return some or usual
    return sorted({float(f"{x:.3g}") for d in samples for x in d.quantile([0.25, 0.5, 0.75]).tolist()})


def _probability(result: Assessment, h: float, optimised: bool = False) -> dict[str, Any]:
    key = "at_least" if result.index.better == "larger" else "at_most"
    p = result.interval(optimised=optimised, **{key: h})  # type: ignore[arg-type]
    return {key: h, "value": p.value, "low": p.low, "high": p.high, "confidence": p.confidence}


def show(
    result: Assessment,
    out: Console,
    thresholds: Thresholds = None,
    rates: Mapping[str | int, float] | None = None,
    report: Path | None = None,
) -> None:
    """What was asked, how the index is distributed, which failure is the worst, and what a lock leaves."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    del report  # is named with the files that were written
    d = result.distribution
    if d.samples:
        out.print(f"[bold]{escape(Answer(result, thresholds[0] if thresholds else None).headline)}[/]", soft_wrap=True)
    out.print(f"{escape(result.arm.title)}: {escape(result.index.describe())}", soft_wrap=True)
    explanation = explain_index(result.index)
    if explanation:
        out.print(f"{escape(result.index.name)}: {escape(explanation)}", soft_wrap=True)
    out.print(f"{escape(result.region.name)}: {escape(result.region.describe())}", soft_wrap=True)
    if not result.complete:
        out.print(
            f"[yellow]not finished: {d.samples} of {result.poses} poses; the same 'holdfast assess' command resumes[/]",
            soft_wrap=True,
        )
    lost = f"{d.unreached_share if d.samples else 0:.1%}{' of the weight' if d.weighted else ''}"
    out.print(
        f"{d.samples} poses, seed {result.seed}: {d.reached} reached, {d.unreached} not found within the limits "
        f"({lost}, counted as failed), {d.singular} singular",
        soft_wrap=True,
    )
    if not d.samples:
        return
    if d.weighted:
        text = f"poses count by weight: effective sample size {d.effective():.4g} (total over largest), which intervals go by"
        out.print(text, soft_wrap=True)
    both = [(result.distribution, "as inverse kinematics found them")]
    if result.optimised is not None:
        both.append((result.optimised, "best configurations found"))
    if d.reached:
        some = [(which, name) for which, name in both if which.reached]
        for which, name in some:
            low, middle, high = which.quantile([0.05, 0.5, 0.95]).tolist()
            spread = f"median {number(middle)}, 5 % {number(low)}, 95 % {number(high)}, mean {number(which.mean)}"
            out.print(f"over reached poses, {name}: {spread}", soft_wrap=True)
        if result.index.bound is not None:
            gaps = [f"{number(result.index.bound - float(which.quantile(0.5)))} ({name})" for which, name in some]
            below = f"the median is below that by {', '.join(gaps)}"
            note = f" ({result.index.bound_note})" if result.index.bound_note else ""
            out.print(f"no configuration can beat {number(result.index.bound)}{note}; {below}", soft_wrap=True)
    _show_clearance(result, out)
    sign = "at least" if result.index.better == "larger" else "at most"
    after = ["optimised", "95 % interval"] if result.optimised is not None else []
    table = Grid(result.index.name, "probability", "95 % interval", *after)
    for h in _thresholds(result, thresholds):
        cells = []
        for optimised in (False, True)[: len(both)]:
            p = _probability(result, h, optimised)
            cells += [f"{p['value']:.4f}", f"{p['low']:.4f} to {p['high']:.4f}"]
        table.add_row(f"{sign} {h:g}", *cells)
    out.print(table)
    columns = [result.worst_counts, *([] if result.optimised_worst_counts is None else [result.optimised_worst_counts])]
    if any(c.sum() for c in columns):
        head = "is the worst in" + (" weight" if d.weighted else "")
        table = Grid("failure", head, *["optimised"][: len(columns) - 1])
        for k, name in enumerate(result.index.failure_names):
            if any(c[k] for c in columns):
                table.add_row(
                    escape(name), *[f"{c[k]:{'.4g' if d.weighted else 'd'}} ({c[k] / (c.sum() or 1):.1%})" for c in columns]
                )
        out.print(table)
    _show_upgrades(result, thresholds, out)
    if result.survivors is not None:
        table = Grid("once it has locked", "where", "poses still reached", "95 % interval")
        for name, share in result.survival().items():
            where = _where(result, name)
            table.add_row(escape(name), where, f"{share.value:.4f}", f"{share.low:.4f} to {share.high:.4f}")
        out.print(table)
        if rates:
            left = result.expected_survival(rates)
            out.print(f"after a failure, by how often each joint fails: {left:.4f} of the poses still reached", soft_wrap=True)


def _where(result: Assessment, joint: str) -> str:
    """Where a joint locks, in degrees or metres."""
    angle = result.locks[joint]
    if angle is None:
        return "as at another pose"
    prismatic = result.arm.prismatic[result.arm.joint_index(joint)]
    return f"{angle:.4g} m" if prismatic else f"{math.degrees(angle):.4g} deg"


def _show_clearance(result: Assessment, out: Console) -> None:
    """How often the arm collides with itself or its cell."""
    from rich.markup import escape

    found, clearance = result.collisions, result.plan.clearance
    if found is None or clearance is None or not found.reached:
        return
    whole = found.reached
    most = "at most " * (clearance.cell is not None)
    text = f"the arm collides with {clearance.others} in {most}{found.found / whole:.1%} of the {whole} configurations found"
    hit = sorted((item for item in found.with_each.items() if item[1]), key=lambda item: -item[1])
    text += f" ({', '.join(f'{name} {count / whole:.1%}' for name, count in hit)})" if hit else ""
    if result.clear is not None:
        text += f"; at least {result.reached_clear().value:.1%} of the poses are reached by a clear one"
    if result.optimised is not None:
        close = clearance.too_close(found.margin)
        text += f"; at the best configuration of {found.blocked / whole:.1%} of the reached poses it {close}"
        text += ", so one that is clear was chosen instead" if found.blocked else ""
        if found.hopeless:
            text += f", but {found.hopeless} ({found.hopeless / whole:.1%}) have no clear one and count as failed"
    out.print(escape(f"{text} ({shape_text(clearance, found.margin)})"), soft_wrap=True)


def _show_upgrades(result: Assessment, thresholds: Thresholds, out: Console) -> None:
    """Which joint deserves a redundant motor or brake, at the first threshold."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    if not result.kept:
        out.print("the poses were not kept, so it is not known which joint deserves a redundant motor or brake", soft_wrap=True)
        return
    threshold = thresholds[0] if thresholds else result.default_threshold()
    ranked = result.upgrades(threshold)
    best = {u.joint: u for u in best_upgrades(result, threshold)}
    some = [u for u in ranked if u.gain > 0 or (u.joint in best and best[u.joint].gain > 0)]
    condition = f"{'at least' if result.index.better == 'larger' else 'at most'} {threshold:g}"
    if not some:
        if ranked:
            out.print(f"no single joint that never fails would raise the probability of {condition}", soft_wrap=True)
        return
    after = ["optimised", "gain", "95 % interval"] if best else []
    table = Grid("if it never failed", f"probability of {condition}", "gain", "95 % interval", *after)
    for u in some:
        table.add_row(escape(u.joint), *_gain(u), *(_gain(best[u.joint]) if best else []))
    out.print(table)
    if best:
        count = min(result.distribution.samples, MOST_OPTIMISED_AGAIN)
        now = next(iter(best.values())).before
        out.print(
            f"optimised: configurations of {counted(count, 'pose')} optimised again without that joint; with it {now:.4f}",
            soft_wrap=True,
        )


def _gain(u: Upgrade) -> list[str]:
    return [f"{u.after:.4f}", f"{u.gain:+.4f}", f"{u.low:.4f} to {u.high:.4f}"]
