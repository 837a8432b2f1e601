"""A comparison of laws in numbers and words."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.convergence.law_comparison import ANY, HEALTHY, LawComparison
from holdfast.present.clearance.shape import shape_summary, shape_text
from holdfast.present.printing import Rows, number, print_rows
from holdfast.simulation.errors import ErrorKind, error_kinds
from holdfast.simulation.runs import Outcome
from holdfast.words import fixed, percent

if TYPE_CHECKING:
    from rich.console import Console

OUTCOMES = [o.name.lower() for o in Outcome]
_OF_A_RUN = ("path_length", "path_ratio", "excursion", "time")
OUTCOME_HEAD = ["law", "locked", "converged", "95 % interval", *OUTCOMES[1:], "within reach"]


def to_dict(c: LawComparison) -> dict[str, Any]:
    """Outcomes, gains over the first law, and what each law costs the healthy arm."""
    data: dict[str, Any] = {
        **c.arm.entry(),
        "task": c.laws[0].task.name,
        "motions": len(c),
        "about": c.about,
        "laws": {name: law.describe() for name, law in zip(c.names, c.laws, strict=True)},
        "outcomes": c.table,
        "healthy": healthy_rows(c),
        "undecided": {name: c.reasons(name) for name in c.names},
    }
    if pairs(c):
        data["gains"] = gain_rows(c)
    if c.clearance is not None:
        data["clearance"] = shape_summary(c.clearance, 0.0)
    return data


def key_table(c: LawComparison) -> Rows:
    """How often each law converges with each joint locked."""
    rows = [[r["law"], r["failure"], *outcome_cells(r)[2:4]] for r in c.table]
    return Rows(["law", "locked", "converged", "95 % interval"], rows)


def next_steps(c: LawComparison, name: str) -> list[str]:
    """What is gained, and the whole report."""
    steps = [f"{name}.gain({c.names[1]!r})  # over {c.names[0]}, on the same motions"] if pairs(c) else []
    return [*steps, f'{name}.report("laws.html")']


def show(c: LawComparison, out: Console) -> None:
    """The headline and the tables."""
    from rich.markup import escape

    kinds = error_kinds(c.laws[0])
    out.print(f"Arm {escape(c.arm.title)}, task {escape(c.laws[0].task.describe())}; {escape(c.about)}", soft_wrap=True)
    out.print(f"[bold]{escape(headline(c))}[/]", soft_wrap=True)
    rows = [[*outcome_cells(r), *(error_cell(r, kind, "astray", "") for kind in kinds)] for r in c.table]
    print_rows(out, Rows([*OUTCOME_HEAD, *(f"astray, {kind.unit}" for kind in kinds)], rows))
    names = " and ".join(kind.text for kind in kinds)
    out.print(f"astray: median {names} of the runs that do not converge; joint limits are not enforced", soft_wrap=True)
    if pairs(c):
        rows = [
            [r["law"], r["failure"], f"{signed(r, 'gain', 100.0, 1)} points", *(signed_error(r, kind) for kind in kinds)]
            for r in gain_rows(c)
        ]
        titles = [f"{kind.text}, {kind.unit}" for kind in kinds]
        print_rows(out, Rows(["law", "locked", f"converge, more than with {c.names[0]}", *titles], rows))
    if c.clearance is not None:
        print_rows(out, touch_rows(c))
        out.print(f"contacts are reported, not enforced; {shape_text(c.clearance, 0.0)}", soft_wrap=True)
    if c.comparable.any():
        shown = (("deviation", "_m", "m", 3), ("angle", "_deg", "deg", 1), ("time", "", time_unit(c), 2))
        rows = [
            [r["law"], *(f"{fixed(r[f'{of}_50{end}'], digits)} {unit}" for of, end, unit, digits in shown)]
            for r in healthy_rows(c)
        ]
        head = ["while healthy", "off the straight line", "largest angle to the command", "to the target"]
        print_rows(out, Rows(head, rows))
        out.print("medians over the motions that converge with every law", soft_wrap=True)


def outcome_cells(row: dict[str, Any]) -> list[str]:
    """Of a row of the table, what is below ``OUTCOME_HEAD``."""
    interval = f"{percent(row['converged_low'])} to {percent(row['converged_high'])}"
    return [
        row["law"],
        row["failure"],
        percent(row["converged"]),
        interval,
        *(percent(row[x]) for x in (*OUTCOMES[1:], "reachable")),
    ]


def touch_rows(c: LawComparison) -> Rows:
    """Of each law and failure: how many runs touch something, how many converge and do not, and what is touched first."""
    rows = []
    for r in c.table:
        first = Counter(x.object for x in c.case(r["law"], r["failure"]).contacts or () if x is not None).most_common(2)
        things = ", ".join(f"{thing} ({percent(count / len(c))})" for thing, count in first)
        interval = f"{percent(r['touched_low'])} to {percent(r['touched_high'])}"
        rows.append(
            [r["law"], r["failure"], percent(r["touched"]), interval, percent(r["converged_clear"]), things or "nothing"]
        )
    return Rows(["law", "locked", "touch something", "95 % interval", "converge and touch nothing", "touched first"], rows)


def signed(row: dict[str, Any], of: str, factor: float, digits: int) -> str:
    """A difference with its interval."""
    value, low, high = (f"{factor * row[name]:+.{digits}f}" for name in (of, f"{of}_low", f"{of}_high"))
    return f"{value} ({low} to {high})"


def signed_error(row: dict[str, Any], kind: ErrorKind) -> str:
    """Return the change of one error with its interval, in the unit for people."""
    return signed(row, kind.key, kind.factor, 1)


def error_cell(row: dict[str, Any], kind: ErrorKind, of: str, none: str) -> str:
    """Return one error of a row of the table in the unit for people; ``of`` is a quantile such as 50, or astray."""
    value = row[f"{kind.key}_{of}"]
    return none if value is None else number(kind.factor * value)


def time_unit(c: LawComparison) -> str:
    """Of the time of a run."""
    return "cycles" if c.runs[0].cycles else "s"


def headline(c: LawComparison) -> str:
    """The answer in two sentences."""
    if not c.joints:
        return f"Healthy, {_listed([f'{percent(_share(c, n, HEALTHY))} converge with {n}' for n in c.names])}."
    text = "With one joint locked and nobody aware of it, the end effector "
    if any(c.share_any(n).value for n in c.names):
        shares = [f"{percent(p.value) if p.value else 'none'} with {n}" for n in c.names for p in [c.share_any(n)]]
        text += f"reaches its target in {_listed(shares)} of the motions"
    else:
        text += f"never reaches its target, whichever of the {len(c.names)} laws commands it"
    within = within_reach(c)
    text += f" ({percent(within) if within else 'none'} of the targets are still within reach)."
    for name in c.names[1:]:
        text += f" {_verdict(c, name)}"
    return text


def _verdict(c: LawComparison, name: str) -> str:
    if len(c) < 2:
        return ""
    gain = c.gain(name)
    first = c.names[0]
    if gain.low > 0 and c.gain(name, undecided="against").low > 0:
        text = f"With {name} more converge than with {first}, by {_points(gain.value)}"
    elif gain.high < 0 and c.gain(name, undecided="for").high < 0:
        text = f"With {name} fewer converge than with {first}, by {_points(-gain.value)}"
    else:
        text = f"It cannot be told whether more or fewer converge with {name} than with {first}"
    parts = []
    for kind in error_kinds(c.laws[0]):
        change = c.change(name, kind.name)
        if change.high < 0 or change.low > 0:
            way = "nearer to" if change.value < 0 else "farther from"
            parts.append(f"{number(kind.factor * abs(change.value), 3)} {kind.unit} {way} {kind.whole}")
    return f"{text}{'; on average its runs end ' * bool(parts)}{' and '.join(parts)}."


def _points(share: float) -> str:
    return f"{100 * share:.1f} percentage points"


def _listed(parts: Sequence[str]) -> str:
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"


def _share(c: LawComparison, law: str, failure: str) -> float:
    share = c.case(law, failure).share()
    return share.value if share else 0.0


def within_reach(c: LawComparison) -> float:
    """Fraction of the targets that are within reach once a joint has locked, every joint alike."""
    return float(np.mean([c.case(c.names[0], joint).reachable.mean() for joint in c.joints]))


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
            for kind in error_kinds(c.laws[0]):
                d = c.change(name, kind.name, failure)
                row |= {kind.key: d.value, f"{kind.key}_low": d.low, f"{kind.key}_high": d.high}
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


def run_rows(c: LawComparison) -> list[dict[str, Any]]:
    """Of each law, failure and motion: how the run ended."""
    rows: list[dict[str, Any]] = []
    for case in (c.case(name, failure) for name in c.names for failure in c.failures):
        for k in range(len(c)):
            row: dict[str, Any] = {"law": case.law, "failure": case.failure, "motion": k, "outcome": OUTCOMES[case.code[k]]}
            row["reachable"] = int(case.reachable[k])
            row |= {kind.key: f"{getattr(case, kind.name)[k]:.9g}" for kind in error_kinds(c.laws[0])}
            row |= {of: f"{getattr(case, of)[k]:.9g}" for of in _OF_A_RUN}
            row["past_limits"] = int(case.past_limits[k])
            if case.contacts is not None:
                touch = case.contacts[k]
                row |= {"touched_at": "", "link": "", "object": ""}
                row |= {} if touch is None else {"touched_at": f"{touch.time:.9g}", "link": touch.link, "object": touch.object}
            rows.append(row)
    return rows
