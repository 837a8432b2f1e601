"""The study, and RESULTS.md."""

from __future__ import annotations

import argparse
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

import holdfast as hf
from measurements.stuck_panda import figures
from measurements.stuck_panda.study import (
    ANGLES,
    ARM,
    ELBOW,
    SEED,
    SHOWN,
    STARTS,
    TASKS,
    TIME_LIMIT,
    Elbow,
    against,
    arm,
    choose,
    elbow,
    open_share,
    target,
)

HERE = Path(__file__).parent
SIZES = {"position": 80, "pose": 40}  # places
CONFIGURATIONS = 2
MOST = 5  # errors of continua that are told
WORDS = ("converged", "stuck", "moving", "undecided", "trapped")


def run(sizes: Mapping[str, int], folder: Path, angles: Sequence[float] = ANGLES, starts: int = STARTS) -> list[str]:
    """All of it, the figures, and the lines of RESULTS.md."""
    place = folder / "figures"
    place.mkdir(parents=True, exist_ok=True)
    begun = time.process_time()
    choices = {task: choose(task, places, CONFIGURATIONS) for task, places in sizes.items()}
    found = [elbow(task, name, angle, starts) for task in sizes for name in SHOWN[:2] for angle in angles]
    for task, choice in choices.items():
        figures.draw_joints(task, choice, place / f"joints-{task}.png")
        figures.draw_map(task, choice, target(), place / f"map-{task}.png")
    figures.draw_laws(choices, place / "laws.png")
    figures.draw_elbow(found, place / "elbow.png")
    lines = results(choices, found, time.process_time() - begun)
    (folder / "RESULTS.md").write_text("\n".join(lines), encoding="utf-8")
    return lines


def percent(share: float) -> str:
    """With one digit."""
    return f"{100 * share:.1f}"


def results(choices: Mapping[str, hf.LawChoice], found: Sequence[Elbow], seconds: float) -> list[str]:
    """RESULTS.md."""
    goal = target()[:3, 3]
    sizes = "; ".join(
        f"task {task}: {len(c.maps[0].places)} places, {int(c.maps[0].has_configuration.sum())} motions, "
        f"{int(c.maps[0].has_configuration.sum()) * (arm().n + 1)} runs under each of {len(c.names)} laws"
        for task, c in choices.items()
    )
    limits = [np.mean([m.limits_passed[m.has_configuration][:, :-1].mean() for m in c.maps]) for c in choices.values()]
    return [
        "# Where does a Panda get stuck when its elbow locks and nobody notices?",
        "",
        f"Written by `python -m measurements.stuck_panda`, seed {SEED}. All numbers are measured here; no paper has them.",
        "",
        f"The `{ARM}`, seven joints, should bring its end effector to the pose it has in its home configuration, at "
        f"({goal[0]:.3f}, {goal[1]:.3f}, {goal[2]:.3f}) m and pointing down; task *position* asks for the place alone. One "
        "joint "
        "is locked from the start and the controller goes on as if nothing had happened. Motions start from random places of "
        "the "
        f"hand (those of configurations uniform within the limits), in {CONFIGURATIONS} random configurations of each; "
        f"{sizes}. "
        f"Runs are given {TIME_LIMIT:g}/Ke. Joint limits are not heeded: on average {' and '.join(map(percent, limits))} "
        "percent of "
        "the runs pass one. *Trapped*: did not reach it although some configuration on the target was found with the joint "
        "where it "
        "stands. Intervals are of 95 %, over the places.",
        "",
        "## In short",
        "",
        *[f"- {line}" for line in answers(choices, found)],
        "",
        "## How motions end, by locked joint",
        "",
        *joint_tables(choices),
        "",
        *[f"![Task {task}, by locked joint](figures/joints-{task}.png)" for task in choices],
        "",
        "## Where they start from, joint 4 locked",
        "",
        *[f"![Task {task}, places of the start](figures/map-{task}.png)" for task in choices],
        "",
        "## Which law, and which pre-failure error",
        "",
        "Every joint as likely to lock as any other, the same failures under every law. The last column is where the "
        "difference "
        "could end up if all undecided runs with the target in reach arrived under the one law and none under the other.",
        "",
        *law_table(choices),
        "",
        "![Outcomes by law](figures/laws.png)",
        "",
        "## Stationary points with joint 4 locked",
        "",
        "Found by Newton's method from random starts, before any run; then "
        f"{sum(found[0].outcomes.values())} runs from random configurations with joint 4 at the same angle. *Continuum*: "
        "points that "
        "are not isolated, as the Panda can turn its spherical shoulder about the line from there to the target without moving "
        "joint 4; those with a star repel in no direction. A stuck run is explained if it ended within 0.01 rad of an "
        "isolated point, or with the error (to 1e-4) of a "
        "continuum that attracts.",
        "",
        *elbow_table(found),
        "",
        "![Errors at rest over the angle of joint 4](figures/elbow.png)",
        "",
        "## How far to believe it",
        "",
        "- One target. Another one has other numbers; `holdfast` makes the same tables for any arm, task and target "
        "(`hf.convergence_map`, `hf.compare_laws`, `hf.stationary_points`).",
        "- *In reach* means that inverse kinematics found a configuration within the limits; what it misses is counted as out "
        "of "
        "reach. Runs themselves do not heed limits, and may arrive where the other would not.",
        "- Undecided runs were still creeping when time was up, or met a singular configuration. They count as not arrived.",
        "- Stationary points are those that random starts found; with the failure-tolerant law they were not looked for.",
        f"- {seconds:.0f} s of processor time, all threads.",
        "",
    ]


def answers(choices: Mapping[str, hf.LawChoice], found: Sequence[Elbow]) -> list[str]:
    """What the numbers say, in sentences that are made from them."""
    lines = []
    name = arm().joint_names[ELBOW]
    for task, c in choices.items():
        m = c.map_of(SHOWN[0])
        share = {word: m.shares(word)[name] for word in (*WORDS, "in_reach")}
        arrives = share["converged"]
        lines.append(
            f"Task {task}, joint 4 locked, pseudoinverse: {percent(arrives.value)} % arrive ({percent(arrives.low)} to "
            f"{percent(arrives.high)}), {percent(share['stuck'].value)} % get stuck, {percent(share['moving'].value)} % keep "
            "moving, "
            f"{percent(share['undecided'].value)} % are undecided; the target is in reach of "
            f"{percent(share['in_reach'].value)} %, and "
            f"{percent(share['trapped'].value)} % ({percent(share['trapped'].low)} to {percent(share['trapped'].high)}) are "
            "trapped."
        )
    for task in choices:
        arcs = hf.joint_bounds(arm(), target(), task, seed=SEED)[ELBOW]
        where = ", ".join(f"{np.degrees(low):.1f} to {np.degrees(high):.1f}" for low, high in arcs)
        lines.append(f"Task {task}: the target can be reached within the limits with joint 4 at {where} deg and nowhere else.")
        mine = [e for e in found if e.task == task]
        stuck = sum(e.outcomes["stuck"] for e in mine)
        alone, level, other = (sum(getattr(e, x) for e in mine) for x in ("isolated", "continuum", "elsewhere"))
        errors, excess = (np.concatenate([getattr(e, x) for e in mine]) for x in ("errors", "excess"))
        size = "m" if task == "position" else "m and rad"
        astray = (
            f"; their error is {np.median(errors):.3f} {size} in the median, where {np.median(errors - excess):.3f} could be "
            "had "
            "with the joint where it is"
            if stuck
            else ""
        )
        lines.append(
            f"Task {task}: of {stuck} stuck runs with joint 4 locked {alone} ended at an isolated stationary point and {level} "
            "on a "
            f"continuum that had been found before, {other} elsewhere{astray}."
        )
    for task, c in choices.items():
        best = c.best
        others = {n: against(c, n, best) for n in c.names if n != best}
        worse = [n for n, d in others.items() if d.high < 0]
        sure = [n for n, d in others.items() if d.high < 0 and d.best < 0]
        first = c.share(best)
        lines.append(
            f"Task {task}: {best} lets most failures arrive, {percent(first.value)} % ({percent(first.low)} to "
            f"{percent(first.high)}); with undecided runs counted as lost, "
            + (f"significantly more than {', '.join(worse)}" if worse else "no other law differs significantly")
            + (f"; whatever becomes of the undecided runs, than {', '.join(sure) or 'none'}." if worse else ".")
        )
    return lines


def joint_tables(choices: Mapping[str, hf.LawChoice]) -> list[str]:
    """Outcomes by joint and law."""
    lines = [
        "| task | joint locked | law | arrives, % (interval) | stuck | moving | undecided | in reach | trapped, % (interval) |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for task, c in choices.items():
        for k, joint in enumerate(c.maps[0].columns):
            for law in SHOWN:
                m = c.map_of(law)
                s = {word: m.shares(word)[joint] for word in (*WORDS, "in_reach")}
                spans = [
                    f"{percent(s[w].value)} ({percent(s[w].low)} to {percent(s[w].high)})" for w in ("converged", "trapped")
                ]
                middle = [percent(s[w].value) for w in ("stuck", "moving", "undecided", "in_reach")]
                number = str(k + 1) if k < arm().n else "none"
                lines.append(f"| {task} | {number} | {law} | {spans[0]} | {' | '.join(middle)} | {spans[1]} |")
    return lines


def law_table(choices: Mapping[str, hf.LawChoice]) -> list[str]:
    """Laws in order, against the best."""
    lines = [
        "| task | law | arrives after, % of the failures (interval) | undecided, in reach, % | against the best, points "
        "(interval) "
        "| at worst to at best |",
        "|---|---|---|---|---|---|",
    ]
    for task, c in choices.items():
        for law in c.ranking:
            s = c.share(law)
            cells = [task, law, f"{percent(s.value)} ({percent(s.low)} to {percent(s.high)})", percent(open_share(c, law))]
            if law == c.best:
                cells += ["best", ""]
            else:
                d = against(c, law, c.best)
                cells.append(f"{100 * d.value:+.1f} ({100 * d.low:+.1f} to {100 * d.high:+.1f})")
                cells.append(f"{100 * d.worst:+.1f} to {100 * d.best:+.1f}")
            lines.append(f"| {' | '.join(cells)} |")
    return lines


def elbow_table(found: Sequence[Elbow]) -> list[str]:
    """Stationary points and runs by angle."""
    lines = [
        "| task | law | joint 4 at, deg | isolated erroneous points | continua, by error | runs: arrive, stuck, moving, "
        "undecided "
        "| stuck: isolated, continuum, elsewhere | error of stuck runs, m or m and rad |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for e in found:
        kinds = ", ".join(f"{n} {kind}{'s' if n > 1 else ''}" for kind, n in e.isolated_kinds.items()) or "none"
        every, attracting = e.levels
        continua = ", ".join(f"{x:.3f}{'*' if x in attracting else ''}" for x in every[:MOST]) or "none"
        continua += f" and {len(every) - MOST} more" if len(every) > MOST else ""
        cells = [e.task, e.law, f"{e.angle:g}", kinds, continua]
        reasons = ", ".join(f"{count} {reason}" for reason, count in e.reasons.items())
        cells.append(", ".join(str(e.outcomes[o]) for o in figures.OUTCOMES) + (f" ({reasons})" if reasons else ""))
        cells.append(f"{e.isolated}, {e.continuum}, {e.elsewhere}")
        cells.append(f"{e.errors.min():.3f} to {e.errors.max():.3f}" if len(e.errors) else "-")
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def main() -> None:
    """Run everything and write RESULTS.md."""
    parser = argparse.ArgumentParser(prog="python -m measurements.stuck_panda", description=__doc__)
    for task in TASKS:
        parser.add_argument(f"--{task}", type=int, default=SIZES[task], help=f"places, task {task} (default {SIZES[task]})")
    parser.add_argument("--out", type=Path, default=HERE, help="folder of RESULTS.md and figures")
    given = parser.parse_args()
    print("\n".join(run({task: getattr(given, task) for task in TASKS}, given.out)))


if __name__ == "__main__":
    main()
