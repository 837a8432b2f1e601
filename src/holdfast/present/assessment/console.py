"""What ``holdfast assess`` and ``holdfast report`` print: tables for people, JSON for machines."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from holdfast.present.clearance.shape import shape_summary, shape_text
from holdfast.present.printing import console, number

if TYPE_CHECKING:
    from holdfast.assessment.assessment import Assessment
    from holdfast.assessment.comparison import Comparison
    from holdfast.assessment.upgrade import Upgrade


def summary(result: Assessment, at_least: list[float] | None, rates: dict[str | int, float]) -> dict[str, Any]:
    """An assessment for machines; ``rates`` are how often each joint fails, if that was given."""
    d = result.distribution
    names = result.index.failure_names
    reached = d.reached > 0
    return {
        **result.arm.entry(),
        "fingerprint": result.arm.fingerprint,
        "index": result.index.label,
        "unit": result.index.unit,
        "better": result.index.better,
        "bound": result.index.bound,
        "bound_note": result.index.bound_note,
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
        "quantiles": dict(zip(["0.05", "0.5", "0.95"], d.quantile([0.05, 0.5, 0.95]).tolist(), strict=True))
        if reached
        else None,
        "band_95": d.band() if d.samples else None,
        "probability": [_probability(result, h) for h in _thresholds(result, at_least)] if d.samples else [],
        "gap": result.gap(),
        "worst_counts": dict(zip(names, result.worst_counts.tolist(), strict=True)),
        "upgrades": _upgrades(result, at_least),
        "optimised": _optimised(result, at_least),
        "clearance": _clearance(result),
        "after_lock": _after_lock(result),
        "expected_survival": result.expected_survival(rates) if rates and d.samples else None,
        "seconds": result.seconds,
    }


def _optimised(result: Assessment, at_least: list[float] | None) -> dict[str, Any] | None:
    d, counts = result.optimised, result.optimised_worst_counts
    if d is None or counts is None or not d.reached:
        return None
    return {
        "mean": d.mean,
        "quantiles": dict(zip(["0.05", "0.5", "0.95"], d.quantile([0.05, 0.5, 0.95]).tolist(), strict=True)),
        "probability": [_probability(result, h, optimised=True) for h in _thresholds(result, at_least)],
        "gap": result.gap(optimised=True),
        "worst_counts": dict(zip(result.index.failure_names, counts.tolist(), strict=True)),
        "upgrades": _upgrades(result, at_least, optimised=True),
    }


def _clearance(result: Assessment) -> dict[str, Any] | None:
    """How often the arm runs through itself; None if that was not looked at."""
    found, clearance = result.collisions, result.plan.clearance
    if found is None or clearance is None:
        return None
    chosen = result.optimised is not None
    counts = {
        "found": found.found,
        "best_without_regard": found.blocked if chosen else None,
        "none_clear": found.hopeless if chosen else None,
    }
    shares = {f"{name}_share": n / found.reached if n is not None and found.reached else None for name, n in counts.items()}
    return {"reached": found.reached, **counts, **shares, **shape_summary(clearance, found.margin)}


def _upgrades(result: Assessment, at_least: list[float] | None, optimised: bool = False) -> dict[str, Any] | None:
    """What joints that never fail would gain at the first threshold; None if the rows were not kept."""
    if not result.kept or not result.distribution.samples:
        return None
    threshold = at_least[0] if at_least else result.default_threshold()
    return {"threshold": threshold, "joints": [asdict(u) for u in result.upgrades(threshold, optimised)]}


def _after_lock(result: Assessment) -> dict[str, Any] | None:
    if result.survivors is None or not result.distribution.samples:
        return None
    locks = result.locks
    return {
        name: {"value": p.value, "low": p.low, "high": p.high, "locked_at": locks[name]}
        for name, p in result.survival().items()
    }


def _thresholds(result: Assessment, given: list[float] | None) -> list[float]:
    if given:
        return given
    if result.index.bound is not None:
        return [h for h in (0.05, 0.1, 0.2, 0.3) if h < result.index.bound]
    if not result.distribution.reached:
        return []
    return [float(f"{x:.3g}") for x in result.distribution.quantile([0.25, 0.5, 0.75]).tolist()]


def _probability(result: Assessment, h: float, optimised: bool = False) -> dict[str, Any]:
    key = "at_least" if result.index.better == "larger" else "at_most"
    p = result.interval(optimised=optimised, **{key: h})  # type: ignore[arg-type]
    return {key: h, "value": p.value, "low": p.low, "high": p.high, "confidence": p.confidence}


def print_assessment(result: Assessment, at_least: list[float] | None, rates: dict[str | int, float]) -> None:
    """An assessment for people."""
    from rich.markup import escape
    from rich.table import Table

    out = console()
    d = result.distribution
    out.print(f"[bold]{escape(result.arm.title)}[/]: {escape(result.index.describe())}", soft_wrap=True)
    out.print(f"{escape(result.region.name)}: {escape(result.region.describe())}", soft_wrap=True)
    if not result.complete:
        out.print(
            f"[yellow]not finished: {d.samples} of {result.poses} poses; the same 'holdfast assess' command goes on[/]",
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
    _print_clearance(result)
    sign = "at least" if result.index.better == "larger" else "at most"
    after = ["optimised", "95 % interval"] if result.optimised is not None else []
    table = Table(result.index.name, "probability", "95 % interval", *after, box=None, pad_edge=False)
    for h in _thresholds(result, at_least):
        cells = []
        for optimised in (False, True)[: len(both)]:
            p = _probability(result, h, optimised)
            cells += [f"{p['value']:.4f}", f"{p['low']:.4f} to {p['high']:.4f}"]
        table.add_row(f"{sign} {h:g}", *cells)
    out.print(table)
    columns = [result.worst_counts, *([] if result.optimised_worst_counts is None else [result.optimised_worst_counts])]
    if any(c.sum() for c in columns):
        head = "is the worst in" + (" weight" if d.weighted else "")
        table = Table("failure", head, *["optimised"][: len(columns) - 1], box=None, pad_edge=False)
        for k, name in enumerate(result.index.failure_names):
            if any(c[k] for c in columns):
                table.add_row(
                    escape(name), *[f"{c[k]:{'.4g' if d.weighted else 'd'}} ({c[k] / (c.sum() or 1):.1%})" for c in columns]
                )
        out.print(table)
    _print_upgrades(result, at_least)
    if result.survivors is not None:
        table = Table("once it has locked", "where", "poses still reached", "95 % interval", box=None, pad_edge=False)
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


def _print_clearance(result: Assessment) -> None:
    """How often the arm runs through itself."""
    from rich.markup import escape

    from holdfast.clearance.clearance import too_close

    found, clearance = result.collisions, result.plan.clearance
    if found is None or clearance is None or not found.reached:
        return
    whole = found.reached
    text = f"the arm runs through itself in {found.found / whole:.1%} of the {whole} configurations found"
    if result.optimised is not None:
        text += f"; at the best configuration of {found.blocked / whole:.1%} of the reached poses it {too_close(found.margin)}"
        text += ", so a clear one was chosen instead" if found.blocked else ""
        if found.hopeless:
            text += f", but {found.hopeless} ({found.hopeless / whole:.1%}) have no clear one and count as failed"
    console().print(escape(f"{text} ({shape_text(clearance, found.margin)})"), soft_wrap=True)


def _print_upgrades(result: Assessment, at_least: list[float] | None) -> None:
    """Which joint deserves the redundant motor or brake, at the first threshold."""
    from rich.markup import escape
    from rich.table import Table

    out = console()
    if not result.kept:
        out.print("the poses were not kept, so which joint deserves a redundant motor or brake is not known", soft_wrap=True)
        return
    threshold = at_least[0] if at_least else result.default_threshold()
    ranked = result.upgrades(threshold)
    best = {u.joint: u for u in result.upgrades(threshold, optimised=True)} if result.optimised is not None else {}
    some = [u for u in ranked if u.gain > 0 or (u.joint in best and best[u.joint].gain > 0)]
    condition = f"{'at least' if result.index.better == 'larger' else 'at most'} {threshold:g}"
    if not some:
        if ranked:
            out.print(f"no single joint that never fails would raise the probability of {condition}", soft_wrap=True)
        return
    after = ["optimised", "gain", "95 % interval"] if best else []
    table = Table(
        "if it never failed", f"probability of {condition}", "gain", "95 % interval", *after, box=None, pad_edge=False
    )
    for u in some:
        table.add_row(escape(u.joint), *_gain(u), *(_gain(best[u.joint]) if best else []))
    out.print(table)


def _gain(u: Upgrade) -> list[str]:
    return [f"{u.after:.4f}", f"{u.gain:+.4f}", f"{u.low:.4f} to {u.high:.4f}"]


# ---- several -----------------------------------------------------------------------------------------------------------


def comparison_summary(
    comparison: Comparison, tools: Sequence[str | None], at_least: list[float] | None, page: Path | None
) -> dict[str, Any]:
    """A comparison for machines: every candidate as an assessment alone, and the table."""
    optimised = all(a.optimised is not None for a in comparison.assessments)
    each = zip(comparison.names, tools, comparison.assessments, strict=True)
    return {
        "candidates": [{"name": n, "tool": t, **summary(a, at_least or [comparison.threshold], {})} for n, t, a in each],
        "comparison": {
            "threshold": comparison.threshold,
            "table": comparison.table,
            "ranking": comparison.ranking(),
            "optimised_ranking": comparison.ranking(optimised=True) if optimised else None,
            "notes": comparison.notes,
            "report": None if page is None else str(page),
        },
    }


def print_comparison(comparison: Comparison) -> None:
    """A comparison for people."""
    from rich.markup import escape
    from rich.table import Table

    out = console()
    first = comparison.assessments[0]
    out.print(f"{escape(first.region.name)}: {escape(first.region.describe())}", soft_wrap=True)
    out.print(f"{first.distribution.samples} poses of each candidate; worst-case {escape(first.index.name)}", soft_wrap=True)
    for note in comparison.notes:
        out.print(f"[yellow]{escape(note)}[/]", soft_wrap=True)
    rows = comparison.table
    optimised = any(r["optimised_probability"] is not None for r in rows)
    survival = any(r["expected_survival"] is not None for r in rows)
    sign = "at least" if first.index.better == "larger" else "at most"
    samples = ("", "optimised_")[: 1 + optimised]
    titles = ["candidate", "task", "reached", f"{sign} {comparison.threshold:g}", "95 % interval"]
    titles += ["optimised", "95 % interval"] * optimised + ["median", *["optimised"] * optimised]
    numbers = Table(*titles, *["left after a lock"] * survival, box=None, pad_edge=False)
    titles = ["candidate", "worst failure", *["optimised"] * optimised, "single point of failure", "protect first", "gain"]
    joints = Table(*titles, box=None, pad_edge=False)
    for r in rows:
        cells = [escape(r["name"]), escape(r["task"]), _cell(r["reached"])]
        for b in samples:
            low, high = _cell(r[f"{b}probability_low"]), _cell(r[f"{b}probability_high"])
            cells += [_cell(r[f"{b}probability"]), f"{low} to {high}"]
        cells += ["none" if r[f"{b}median"] is None else number(r[f"{b}median"], 3) for b in samples]
        numbers.add_row(*cells, *[_cell(r["expected_survival"])] * survival)
        worst = [
            "none" if not r[f"{b}worst_joint"] else f"{r[f'{b}worst_joint']} ({r[f'{b}worst_share']:.0%})" for b in samples
        ]
        names = [*worst, ", ".join(r["single_points_of_failure"]) or "none", r["upgrade"] or "none"]
        gain = "" if r["upgrade"] is None else f"{r['upgrade_gain']:+.3f}"
        joints.add_row(escape(r["name"]), *map(escape, names), gain)
    out.print(numbers)
    out.print(joints)
    out.print("protect first: the joint that gains most if it never fails, by a redundant motor or brake", soft_wrap=True)


def _cell(x: float | None) -> str:
    return "none" if x is None else f"{x:.3f}"
