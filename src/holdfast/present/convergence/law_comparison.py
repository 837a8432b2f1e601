"""What a comparison of laws writes: one HTML file, figures, and tables as CSV."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.convergence.law_comparison import ANY, HEALTHY, LawComparison
from holdfast.files.output import made, writing
from holdfast.files.spreadsheet import cell
from holdfast.probability.intervals import Difference
from holdfast.provenance import versions
from holdfast.report import figures, page
from holdfast.report.figures import Curve
from holdfast.report.outcomes import Gains, Spread, Stack, gain_figure, spread_figure, stack_figure
from holdfast.report.page import Block, Callout, Cell, Code, Page, Picture, Section, Table, Text
from holdfast.simulation.runs import Outcome
from holdfast.words import counted, fixed, number, percent

Array = NDArray[np.float64]

_OUTCOMES = [o.name.lower() for o in Outcome]
_COSTS = (
    ("deviation", "off the straight line, m", 1.0),
    ("angle", "largest angle to the command, deg", 180 / np.pi),
    ("time", "until within 1e-3 of the target (of the arm's length, and rad), {unit}", 1.0),
)


def write(c: LawComparison, path: Path, command: str, about: str) -> Path:
    """See :meth:`LawComparison.report`."""
    return page.write(build(c, command, about), path)


def build(c: LawComparison, command: str = "", about: str = "") -> Page:
    """The report as blocks, before it becomes HTML."""
    sections = [
        Section("Who arrives", _outcomes(c)),
        Section(f"What the others gain over {c.names[0]}", _gains(c)),
        Section("How far astray", _errors(c)),
        Section("What it costs while nothing has failed", _healthy(c)),
        Section("How it was computed", _method(c, command, about)),
    ]
    return Page(
        f"Control laws after a lock that nobody has noticed: {c.arm.name}",
        headline(c),
        [s for s in sections if s.blocks],
        about or f"{counted(len(c), 'motion')}, task {c.laws[0].task.describe()}",
        _alerts(c),
        "Written by holdfast. This file needs no network and no other file.",
    )


def headline(c: LawComparison) -> str:
    """The answer in two sentences."""
    if not c.joints:
        return f"Healthy, {_listed([f'{percent(_share(c, n, HEALTHY))} arrive with {n}' for n in c.names])}."
    shares = _listed([f"{percent(c.share_any(n).value)} with {n}" for n in c.names])
    text = f"With one joint locked and nobody aware of it, the hand arrives in {shares} of the motions"
    text += f" ({percent(_within_reach(c))} of the targets are still within reach)."
    for name in c.names[1:]:
        text += f" {_verdict(c, name)}"
    return text


def _verdict(c: LawComparison, name: str) -> str:
    if len(c) < 2:
        return ""
    gain, nearer = c.gain(name), c.change(name, "error")
    first = c.names[0]
    if gain.low > 0 and c.gain(name, undecided="against").low > 0:
        text = f"With {name} more arrive than with {first}, by {_points(gain.value)}"
    elif gain.high < 0 and c.gain(name, undecided="for").high < 0:
        text = f"With {name} fewer arrive than with {first}, by {_points(-gain.value)}"
    else:
        text = f"It cannot be told whether more or fewer arrive with {name} than with {first}"
    if nearer.high < 0 or nearer.low > 0:
        size = "" if c.laws[0].task.angular else " m"
        way = "nearer to" if nearer.value < 0 else "farther from"
        text += f"; on average its runs end {number(abs(nearer.value))}{size} {way} the target"
    return f"{text}."


def _points(share: float) -> str:
    return f"{100 * share:.1f} percentage points"


def _listed(parts: Sequence[str]) -> str:
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"


def _share(c: LawComparison, law: str, failure: str) -> float:
    share = c.case(law, failure).share()
    return share.value if share else 0.0


def _within_reach(c: LawComparison) -> float:
    return float(np.mean([c.case(c.names[0], joint).reachable.mean() for joint in c.joints]))


def _alerts(c: LawComparison) -> list[Callout]:
    found = []
    undecided = max(float((r.code == Outcome.UNDECIDED).mean()) for r in c.runs)
    if undecided > 0.05:
        found.append(
            Callout(
                f"Up to {percent(undecided)} of the runs of a law are undecided and count as not arrived; read shares with "
                "that in mind.",
                title="Undecided runs",
            )
        )
    past = max(float(r.limits_passed.any(axis=1).mean()) for r in c.runs)
    if past > 0:
        found.append(
            Callout(
                f"Joint limits are reported, not enforced: up to {percent(past)} of the runs of a law pass one, where a real "
                "arm would stop.",
                title="Joint limits",
            )
        )
    return found


# ---- figures -----------------------------------------------------------------------------------------------------


def outcome_figure(c: LawComparison, failures: Sequence[str] | None = None) -> Figure:
    """Stacked bars of outcomes, a group per failure and a bar per law."""
    stacks = []
    for failure in failures or c.failures:
        cases = [c.case(name, failure) for name in c.names]
        shares = np.array([[case.ended(o).mean() for o in _OUTCOMES] for case in cases])
        ends = [case.share() for case in cases]
        low, high = (np.array([getattr(e, end) if e else np.nan for e in ends]) for end in ("low", "high"))
        stacks.append(Stack(failure, c.names, shares, low, high, float(cases[0].reachable.mean())))
    return stack_figure(
        stacks,
        _OUTCOMES,
        f"share of {len(c):,} motions, each law and failure",
        "targets still within reach",
    )


def gains_figure(c: LawComparison) -> Figure:
    """Paired differences to the first law, by joint."""
    cases = [*c.joints, ANY]
    size = "m and rad" if c.laws[0].task.angular else "m"

    def of(name: str, differences: list[Difference]) -> Gains:
        value, low, high = (np.array([getattr(d, x) for d in differences]) for x in ("value", "low", "high"))
        return Gains(name, value, low, high)

    more = [of(name, [c.gain(name, j) for j in cases]) for name in c.names[1:]]
    nearer = [of(name, [c.change(name, "error", j) for j in cases]) for name in c.names[1:]]
    first = c.names[0]
    return gain_figure(
        cases,
        [(f"share that arrives, minus that with {first}", more), (f"mean end error minus that with {first}, {size}", nearer)],
    )


def error_figure(c: LawComparison) -> Figure:
    """Cumulative distributions of the end error, and of what it exceeds the least by, over all joints."""
    panels = []
    every = {of: [c.pooled(name, of).ravel() for name in c.names] for of in ("error", "excess")}
    top = max(float(np.nanmax(v, initial=1e-3)) for values in every.values() for v in values)
    axis = np.geomspace(1e-5, 1.2 * top, 400)
    for of, title in (("error", "Error at the end"), ("excess", "What it exceeds the least by")):
        curves = []
        for name, values in zip(c.names, every[of], strict=True):
            finite = np.sort(values[np.isfinite(values)])
            curves.append(Curve(axis, np.searchsorted(finite, axis, side="right") / max(len(values), 1), name))
        panels.append((title, curves))
    size = "m and rad" if c.laws[0].task.angular else "m"
    return figures.compare_cdf_figure(panels, [], f"error, {size}", "share of runs with at most that", log=True)


def healthy_figure(c: LawComparison) -> Figure:
    """Quantiles of what each law costs the healthy arm."""
    unit = "cycles" if c.runs[0].cycles else "s"
    spreads = []
    for of, label, factor in _COSTS:
        quantiles = factor * np.array([c.cost(name, of) for name in c.names])  # type: ignore[arg-type]
        spreads.append(Spread(label.format(unit=unit), quantiles))
    return spread_figure(c.names, spreads)


# ---- sections ----------------------------------------------------------------------------------------------------


def _outcomes(c: LawComparison) -> list[Block]:
    rows: list[list[Cell]] = []
    for r in c.table:
        rows.append(
            [
                r["law"],
                r["failure"],
                percent(r["converged"]),
                f"{percent(r['converged_low'])} to {percent(r['converged_high'])}",
                *[percent(r[o]) for o in _OUTCOMES[1:]],
                percent(r["reachable"]),
                "–" if r["converged_reachable"] is None else percent(r["converged_reachable"]),
                percent(r["converged_within_limits"]),
                percent(r["past_limits"]),
            ]
        )
    head = [
        "law",
        "locked",
        "converged",
        "95 % interval",
        *_OUTCOMES[1:],
        "within reach",
        "converged of these",
        "converged within limits",
        "past a limit",
    ]
    caption = (
        f"{counted(len(c), 'motion')} each; exact intervals. Within reach: some configuration of the failed arm has the "
        "hand at the target (found by search, joint limits aside). Past a limit: a joint left its range on the way."
    )
    image = figures.svg(outcome_figure(c), "outcomes", "Stacked bars of how the runs ended, by joint and law")
    return [
        Picture(
            image,
            f"How {counted(len(c), 'motion')} ended under each law, healthy and with each joint locked from the start. Bars "
            "end at 1; converged is at the target, stuck is at rest elsewhere, moving never comes to rest.",
        ),
        Table(rows, head, frozenset(range(2, len(head))), caption=caption, wide=True),
    ]


def _gains(c: LawComparison) -> list[Block]:
    if not pairs(c):
        return []
    rows: list[list[Cell]] = []
    size = "m and rad" if c.laws[0].task.angular else "m"
    for r in gain_rows(c):
        rows.append(
            [
                r["law"],
                r["failure"],
                f"{100 * r['gain']:+.1f} ({100 * r['gain_low']:+.1f} to {100 * r['gain_high']:+.1f})",
                f"{r['gain_p_value']:.2g}",
                f"{r['error']:+.4f} ({r['error_low']:+.4f} to {r['error_high']:+.4f})",
                f"{r['excess']:+.4f} ({r['excess_low']:+.4f} to {r['excess_high']:+.4f})",
            ]
        )
    head = ["law", "locked", "arrive, percentage points", "p", f"mean end error, {size}", f"mean excess error, {size}"]
    caption = (
        f"Differences to {c.names[0]} over the same motions, with 95 % intervals: paired by Newcombe's method with exact "
        "limits and McNemar's test for a joint; for any joint from the mean over the joints of each motion, by betting, "
        "which always covers. "
        "Of errors by Student's t, which may cover less than 95 % of few motions when a few of them differ much. Excess: above "
        "the least error that the failed arm could have. Undecided runs count as not arrived. Many comparisons at once: one in "
        "twenty looks significant by chance."
    )
    image = figures.svg(gains_figure(c), "gains", "Paired differences to the first law, by joint")
    return [
        Picture(image, f"Paired differences to {c.names[0]}, {counted(len(c), 'motion')}; lines are 95 % intervals."),
        Table(rows, head, frozenset(range(2, 6)), caption=caption, wide=True),
    ]


def _errors(c: LawComparison) -> list[Block]:
    if not c.joints:
        return []
    rows: list[list[Cell]] = []
    for r in c.table:
        if r["failure"] == HEALTHY:
            continue
        cells = [r["error_50"], r["error_75"], r["error_95"], r["excess_95"], r["astray"], r["closest"]]
        more = [r["path_ratio"], r["excursion"]]
        rows.append([r["law"], r["failure"], *["–" if x is None else number(x) for x in (*cells, *more)]])
    size = "m and rad" if c.laws[0].task.angular else "m"
    head = ["law", "locked", "end error: median", "75 %", "95 %", "excess: 95 %", "astray", "closest", "path", "joints"]
    caption = (
        f"Quantiles over all runs, {size}. Astray: median end error of the runs that did not converge. Closest: median of the "
        "least error on the way. Path: median of the tool's way by the straight one. Joints: median of the sum of the ranges "
        "they went through, rad (and m)."
    )
    image = figures.svg(error_figure(c), "errors", "Distribution of the end error by law")
    count = len(c) * len(c.joints)
    return [
        Picture(image, f"{counted(count, 'run')} of each law, every joint alike. Below 1e-5 a run has arrived."),
        Table(rows, head, frozenset(range(2, len(head))), caption=caption, wide=True),
    ]


def _healthy(c: LawComparison) -> list[Block]:
    if not c.comparable.any():
        return [Text("No motion converges under every law while the arm is healthy, so there is nothing to compare.")]
    rows: list[list[Cell]] = []
    for r in healthy_rows(c):
        rows.append([r["law"], *["–" if np.isnan(r[k]) else fixed(r[k], 3) for k in list(r)[1:]]])
    unit = "cycles" if c.runs[0].cycles else "s"
    head = ["law", "off the line: median, m", "95 %", "angle: median, deg", "95 %", f"time: median, {unit}", "95 %"]
    image = figures.svg(healthy_figure(c), "healthy", "Quantiles of what each law costs the healthy arm")
    caption = (
        f"Over the {counted(int(c.comparable.sum()), 'motion')} that converge under every law with no joint locked, each at 65 "
        "samples."
    )
    return [Picture(image, caption), Table(rows, head, frozenset(range(1, 7)))]


def _method(c: LawComparison, command: str, about: str) -> list[Block]:
    found = versions("holdfast", "numpy", "scipy", "casadi", "llvmlite")
    first = c.runs[0]
    facts: list[tuple[Cell, Cell]] = [("Motions", about or "as they were given")]
    facts += [(name, law.describe()) for name, law in zip(c.names, c.laws, strict=True)]
    facts += [
        ("Failures", f"each alone, from the start: {', '.join(c.joints) or 'none'}; the controller does not know"),
        (
            "Time",
            f"control cycles, at most {first._setting.limit:g}" if first.cycles else f"at most {first._setting.limit:g} s",
        ),
        ("Arrived", f"error at most {c.arrives:g} {'as a cycle begins' if first.cycles else 'at rest'}"),
        ("Undecided", "; ".join(f"{n}: {_reasons(c, n)}" for n in c.names)),
        ("Arm", c.arm.provenance),
        ("Fingerprint of the arm", c.arm.fingerprint),
        ("Versions", ", ".join(f"{k} {v}" for k, v in found.items())),
    ]
    blocks: list[Block] = [Table([[a, b] for a, b in facts])]
    if command:
        blocks.append(Code(command, "The same comparison again:"))
    return blocks


def _reasons(c: LawComparison, name: str) -> str:
    return ", ".join(f"{count} {reason}" for reason, count in c.reasons(name).items()) or "none"


# ---- tables ------------------------------------------------------------------------------------------------------


def pairs(c: LawComparison) -> bool:
    """Whether there is anything to compare: two laws, a failure and two motions."""
    return len(c.names) > 1 and bool(c.joints) and len(c) > 1


def gain_rows(c: LawComparison) -> list[dict[str, Any]]:
    """Of each law but the first and each joint: paired differences to the first law, with their intervals."""
    rows = []
    for name in c.names[1:]:
        for failure in [*c.joints, ANY]:
            row: dict[str, Any] = {"law": name, "than": c.names[0], "failure": failure}
            gain = c.gain(name, failure)
            row |= {"gain": gain.value, "gain_low": gain.low, "gain_high": gain.high, "gain_p_value": gain.p_value}
            for of in ("error", "excess"):
                d = c.change(name, of, failure)
                row |= {of: d.value, f"{of}_low": d.low, f"{of}_high": d.high}
            rows.append(row)
    return rows


def healthy_rows(c: LawComparison) -> list[dict[str, Any]]:
    """Of each law: medians and 95 % quantiles of what it costs the healthy arm; m, deg, and s or cycles."""
    rows = []
    for name in c.names:
        row: dict[str, Any] = {"law": name}
        for of, unit, factor in (("deviation", "m", 1.0), ("angle", "deg", 180 / np.pi), ("time", "", 1.0)):
            middle, most = factor * c.cost(name, of, (0.5, 0.95))  # type: ignore[arg-type]
            row |= {"_".join(x for x in (of, part, unit) if x): v for part, v in (("50", middle), ("95", most))}
        rows.append(row)
    return rows


def _run_rows(c: LawComparison) -> list[dict[str, Any]]:
    rows = []
    for name in c.names:
        for failure in c.failures:
            case = c.case(name, failure)
            for k in range(len(c)):
                rows.append(
                    {
                        "law": name,
                        "failure": failure,
                        "motion": k,
                        "outcome": _OUTCOMES[case.code[k]],
                        "reachable": int(case.reachable[k]),
                        **{
                            of: f"{getattr(case, of)[k]:.9g}"
                            for of in ("error", "excess", "closest", "path_length", "path_ratio", "excursion", "time")
                        },
                        "past_limits": int(case.past_limits[k]),
                    }
                )
    return rows


def save(c: LawComparison, folder: Path) -> list[Path]:
    """See :meth:`LawComparison.save`."""
    tables = {"outcomes": c.table, "healthy": healthy_rows(c), "runs": _run_rows(c)}
    if pairs(c):
        tables["gains"] = gain_rows(c)
    written = []
    made(folder)
    for name, rows in tables.items():
        file = folder / f"{name}.csv"
        with writing(file) as stream:
            writer = csv.writer(stream)
            writer.writerow(map(cell, rows[0]))
            writer.writerows([cell(row[name]) for name in rows[0]] for row in rows)
        written.append(file)
    return written
