"""The study on real arms, and RESULTS.md."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.interface.report import Gains, Spread, Stack, gain_figure, save_png, spread_figure, stack_figure
from measurements.seven_dof.study import ARMS, COSTS, DAMPING, PRE_FAILURE, SEED, TASKS, TIME_LIMIT, part

HERE = Path(__file__).parent
SIZES = {"position": 1000, "pose": 150}  # motions of each arm: about ten minutes on two cores
ANY = "any joint"
OUTCOMES = ("converged", "stuck", "moving", "undecided")

Part = dict[str, Any]


def run(sizes: dict[str, int], arms: Sequence[str], folder: Path, parts: Path) -> list[str]:
    """All parts, the figures, and the lines of RESULTS.md; so many motions of each arm for each task."""
    figures = folder / "figures"
    figures.mkdir(parents=True, exist_ok=True)
    found = [part(arm, task, motions, parts) for task, motions in sizes.items() for arm in arms]
    for p in found:
        draw_outcomes(p, figures / f"{p['arm']}-{p['task']}.png")
    draw_gains(found, figures / "gains.png")
    for task in sizes:
        draw_costs([p for p in found if p["task"] == task], figures / f"healthy-{task}.png")
    lines = results(found)
    (folder / "RESULTS.md").write_text("\n".join(lines), encoding="utf-8")
    return lines


def title(p: Part) -> str:
    """Arm and task."""
    return f"{p['arm']}, {p['task']}"


def tasks(parts: Sequence[Part]) -> list[str]:
    """Their tasks, each once."""
    return list(dict.fromkeys(p["task"] for p in parts))


def size(p: Part) -> str:
    """Unit of errors."""
    return "m" if p["task"] == "position" else "m and rad"


def gains(p: Part, name: str, failure: str = ANY) -> dict[str, Any]:
    """Paired differences of a law to the pseudoinverse."""
    return next(dict(g) for g in p["gains"] if g["law"] == name and g["failure"] == failure)


# ---- figures -----------------------------------------------------------------------------------------------------


def draw_outcomes(p: Part, file: Path) -> None:
    """How the motions of one arm and task ended, by joint and law."""
    stacks = []
    for failure in dict.fromkeys(r["failure"] for r in p["outcomes"]):
        rows = [r for r in p["outcomes"] if r["failure"] == failure]
        shares = np.array([[r[o] for o in OUTCOMES] for r in rows])
        low, high = (np.array([r[f"converged_{end}"] for r in rows]) for end in ("low", "high"))
        stacks.append(Stack(name=failure, bars=p["names"], shares=shares, low=low, high=high, level=rows[0]["reachable"]))
    label = f"share of {p['motions']} motions, each law and failure; {title(p)}"
    save_png(stack_figure(stacks, OUTCOMES, label, level="targets still within reach"), file, dpi=80)


def draw_gains(parts: Sequence[Part], file: Path) -> None:
    """What the laws gain over the pseudoinverse, every joint as likely to lock as any other."""
    panels = []
    for of, label in (
        ("gain", "share that arrives, minus that with the pseudoinverse"),
        ("error", "mean end error minus that with the pseudoinverse, m and rad"),
    ):
        every = []
        for name in parts[0]["names"][1:]:
            rows = [gains(p, name) for p in parts]
            value, low, high = (np.array([r[f"{of}{end}"] for r in rows]) for end in ("", "_low", "_high"))
            every.append(Gains(label=name, value=value, low=low, high=high))
        panels.append((label, every))
    save_png(gain_figure([title(p) for p in parts], panels), file, dpi=80)


def draw_costs(parts: Sequence[Part], file: Path) -> None:
    """What each law costs the healthy arm."""
    names = [f"{p['arm']}, {name}" for p in parts for name in p["names"]]
    labels = ("off the straight line, m", "largest angle to the command, deg", "until within 1e-3 of the target, 1/Ke")
    spreads = []
    for of, label, factor in zip(COSTS, labels, (1, 180 / np.pi, 1), strict=True):
        spreads.append(Spread(label, factor * np.array([p["cost"][name][of] for p in parts for name in p["names"]])))
    save_png(spread_figure(names, spreads), file, dpi=80)


# ---- words -------------------------------------------------------------------------------------------------------


def results(parts: Sequence[Part]) -> list[str]:
    """RESULTS.md."""
    lacking = [task for task in TASKS if task not in tasks(parts)]
    missing = f" This run is without task {' and '.join(lacking)}." if lacking else ""
    healthy = [r["past_limits"] for p in parts for r in p["outcomes"] if r["failure"] == "healthy"]
    limits = max(p["any"][n]["past_limits"] for p in parts for n in p["names"])
    fewest = min(p["any"][n]["past_limits"] for p in parts for n in p["names"])
    return [
        "# A lock that nobody has noticed, on real seven-joint arms",
        "",
        f"Written by `python -m measurements.seven_dof`, seed {SEED}. All numbers are measured here; no paper has them."
        + missing,
        "",
        "One joint is locked from the start, each in turn, and the controller goes on as if nothing had happened. Motions from "
        "point to point: start and target are configurations drawn uniformly within the joint limits, the target as the pose "
        "of the tool there (of which task *position* asks for the place alone). Every law makes the same motions: "
        + "; ".join(f"{title(p)}: {p['motions']} motions, {p['distance'][1]:.2f} m long in the median" for p in parts)
        + f". Damping {DAMPING:g} of the damped inverse, pre-failure error {PRE_FAILURE:g} of the failure-tolerant one, "
        f"characteristic length 1 m; runs are given {TIME_LIMIT:g}/Ke.",
        "",
        "## In short",
        "",
        *[f"- {line}" for line in answers(parts)],
        "",
        "## Who arrives, every joint as likely to lock as any other",
        "",
        "In percent of the runs. Within reach: the failed arm has some configuration with the end effector at the "
        "target, as far as "
        "was found and joint limits left aside. Astray: median, and 90 % quantile, of the end error of the runs that do not "
        "arrive (m, or m and rad).",
        "",
        "| arm, task | law | arrives (95 % interval) | within reach | arrives of these | stuck | moving | undecided | astray "
        "| arrives within limits |",
        "|---|---|---|---|---|---|---|---|---|---|",
        *[_row(p, name) for p in parts for name in p["names"]],
        "",
        "## What the other laws gain over the pseudoinverse",
        "",
        "Paired over the same motions, 95 % intervals (of shares: of the motions' means, by betting; of errors: Student's "
        "t). The last column is how "
        "wide the interval becomes with the undecided runs whose target is within reach: from its lower end if all of the "
        "pseudoinverse's arrived and none of this law's, to its upper end the other way round.",
        "",
        "| arm, task | law | arrive, percentage points | mean end error | mean excess error | points, at worst to at best |",
        "|---|---|---|---|---|---|",
        *[_gain_row(p, name) for p in parts for name in p["names"][1:]],
        "",
        "![Gains over the pseudoinverse](figures/gains.png)",
        "",
        "## What a law costs while nothing has failed",
        "",
        "Medians and 95 % quantiles over the motions that converge under every law. Off the line: of the tool, largest "
        "distance from the straight line; angle: largest between the commanded velocity of the task and the actual one; time: "
        "until the error is below 1e-3, in 1/Ke. The pseudoinverse does exactly what it is told, whatever that takes.",
        "",
        "| arm, task | law | motions | off the line, m | angle, deg | time, 1/Ke |",
        "|---|---|---|---|---|---|",
        *[_cost_row(p, name) for p in parts for name in p["names"]],
        "",
        *[f"![Cost while healthy, task {task}](figures/healthy-{task}.png)" for task in tasks(parts)],
        "",
        "## Joint by joint",
        "",
        "Share that arrives under each law with this joint locked, and in parentheses the share of targets that are still "
        "within reach.",
        "",
        *_joint_tables(parts),
        "",
        "## How far to believe it",
        "",
        f"- Joint limits are not enforced, only reported: with a joint locked {percent(fewest)} to {percent(limits)} of the "
        "runs pass one (by arm, task and law). A real arm would stop there. The column *arrives within limits* counts the runs "
        f"that reach the target without passing any: that is what is left for sure. Of the healthy runs "
        f"{_span(healthy)} pass a limit: "
        "these laws do not look at limits at all.",
        "- Nor do the arms collide with themselves, nor do drives saturate; rates are unlimited.",
        "- Starts and targets are spread over all joint values, also folded and nearly singular ones, which no task planner "
        "would choose.",
        "- Undecided runs (still creeping when time was up, caught beside a singularity, or at one) count as not arrived: "
        + "; ".join(f"{title(p)}: {_reasons(p)}" for p in parts)
        + ".",
        f"- Arrived means an error below 1e-5 at rest. Seconds of the runs: {sum(p['seconds'] for p in parts):.0f} in all.",
        "",
        *[f"![Outcomes, {title(p)}](figures/{p['arm']}-{p['task']}.png)" for p in parts],
        "",
    ]


def answers(parts: Sequence[Part]) -> list[str]:
    """What the numbers say, in sentences that are made from them."""
    lines = []
    tolerant = parts[0]["names"][-1]
    for task in tasks(parts):
        some = [p for p in parts if p["task"] == task]
        shares = _span([p["any"]["pseudoinverse"]["converged"] for p in some])
        reach = _span([p["any"]["pseudoinverse"]["reachable"] for p in some])
        of_these = _span([p["any"]["pseudoinverse"]["of_reachable"] for p in some])
        lines.append(
            f"Task {task}, pseudoinverse: {shares} of the motions arrive although a joint is locked and nobody knows; the "
            f"target is still within reach in {reach}, and of these {of_these} arrive."
        )
        lines.append(f"Task {task}, {tolerant} against the pseudoinverse: {_verdict(some, tolerant)}")
        healthy = [p["cost"][tolerant] for p in some]
        longer = [p["cost"][tolerant]["time"][2] / p["cost"]["pseudoinverse"]["time"][2] for p in some]
        lines.append(
            f"Task {task}, {tolerant} while healthy: in the median {_numbers([h['deviation'][2] for h in healthy])} m off the "
            f"straight line, {_numbers([np.rad2deg(h['angle'][2]) for h in healthy], 0)} deg off the command at the worst "
            f"moment, and {_numbers(longer)} times as long on the way."
        )
    return lines


def _verdict(parts: Sequence[Part], name: str) -> str:
    words = []
    for p in parts:
        low, high = p["bounds"][name]
        g = gains(p, name)
        if (g["gain_low"] > 0 and low > 0) or (g["gain_high"] < 0 and high < 0):
            arrive = f"{100 * g['gain']:+.1f} points arrive"
        else:
            arrive = f"no difference in arriving that can be told ({100 * g['gain']:+.1f} points)"
        clear = g["error_low"] > 0 or g["error_high"] < 0
        error = f"mean end error {g['error']:+.3f} {size(p)}" if clear else "end error alike"
        before, after = (p["any"][n]["astray"] for n in (p["names"][0], name))
        errors = f"{before:.2f} with the pseudoinverse and {after:.2f} {size(p)} with it"
        astray = f"median error of those that do not reach the target {errors}"
        words.append(f"{p['arm']}: {arrive}, {error}, {astray}")
    return f"{'; '.join(words)}."


def percent(share: float) -> str:
    """A share with one decimal, and 0 % or 100 % only if it is."""
    value = 100 * share
    return f"{value:.0f} %" if value in (0, 100) else f"{value:.1f} %"


def _span(values: Sequence[float]) -> str:
    low, high = percent(min(values)), percent(max(values))
    return low if low == high else f"{low.removesuffix(' %')} to {high}"


def _numbers(values: Sequence[float], digits: int = 2) -> str:
    low, high = f"{min(values):.{digits}f}", f"{max(values):.{digits}f}"
    return low if low == high else f"{low} to {high}"


def _row(p: Part, name: str) -> str:
    a = p["any"][name]
    cells = [title(p), name, f"{100 * a['converged']:.1f} ({100 * a['low']:.1f} to {100 * a['high']:.1f})"]
    cells += [f"{100 * a[k]:.1f}" for k in ("reachable", "of_reachable", "stuck", "moving", "undecided")]
    cells += [f"{a['astray']:.3f}, {a['astray_90']:.3f}", f"{100 * a['within_limits']:.1f}"]
    return f"| {' | '.join(cells)} |"


def _gain_row(p: Part, name: str) -> str:
    g, (low, high) = gains(p, name), p["bounds"][name]
    cells = [title(p), name, _signed(g, "gain", 100, 1)]
    cells += [f"{_signed(g, of, 1, 3)} {size(p)}" for of in ("error", "excess")]
    return f"| {' | '.join(cells)} | {100 * low:+.1f} to {100 * high:+.1f} |"


def _signed(g: dict[str, Any], of: str, factor: float, digits: int) -> str:
    value, low, high = (f"{factor * g[f'{of}{end}']:+.{digits}f}" for end in ("", "_low", "_high"))
    return f"{value} ({low} to {high})"


def _cost_row(p: Part, name: str) -> str:
    cost = p["cost"][name]
    cells = [title(p), name, str(p["comparable"])]
    for of, factor, digits in (("deviation", 1.0, 3), ("angle", 180 / np.pi, 1), ("time", 1.0, 1)):
        cells.append(f"{factor * cost[of][2]:.{digits}f}, {factor * cost[of][4]:.{digits}f}")
    return f"| {' | '.join(cells)} |"


def _joint_tables(parts: Sequence[Part]) -> list[str]:
    most = max(len(p["joints"]) for p in parts)
    lines = [
        f"| arm, task | law | {' | '.join(f'joint {k + 1}' for k in range(most))} |",
        "|---|---|" + "---|" * most,
    ]
    for p in parts:
        for name in p["names"]:
            rows = {r["failure"]: r for r in p["outcomes"] if r["law"] == name}
            cells = [f"{100 * rows[j]['converged']:.0f} ({100 * rows[j]['reachable']:.0f})" for j in p["joints"]]
            lines.append(f"| {title(p)} | {name} | {' | '.join(cells)} |")
    return lines


def _reasons(p: Part) -> str:
    every: dict[str, int] = {}
    for counts in p["reasons"].values():
        for reason, count in counts.items():
            every[reason] = every.get(reason, 0) + count
    runs = p["motions"] * (len(p["joints"]) + 1) * len(p["names"])
    return f"{', '.join(f'{count} {reason}' for reason, count in every.items()) or 'none'} of {runs}"


def main() -> None:
    """Run everything and write RESULTS.md."""
    parser = argparse.ArgumentParser(prog="python -m measurements.seven_dof", description=__doc__)
    for task, motions in SIZES.items():
        parser.add_argument(
            f"--{task}", type=int, default=motions, help=f"motions of each arm, task {task} (default {motions})"
        )
    parser.add_argument("--arms", nargs="+", default=list(ARMS), help="built-in arms")
    parser.add_argument("--out", type=Path, default=HERE, help="folder of RESULTS.md and figures")
    parser.add_argument("--parts", type=Path, default=HERE / "parts", help="folder of the parts that are done")
    given = parser.parse_args()
    lines = run({task: getattr(given, task) for task in TASKS}, given.arms, given.out, given.parts)
    print("\n".join(lines))


if __name__ == "__main__":
    main()
