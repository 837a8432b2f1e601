"""A recovery in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.present.clearance.shape import shape_summary, shape_text
from holdfast.present.printing import Rows, alike, number
from holdfast.present.story import Story
from holdfast.recovery.recovery import Ending
from holdfast.words import capitalised, counted

_FRAMES = 121
TIMING = ("The timing", "Rates and accelerations of the joints, each in parts of its limit, over time.")
_ANSWERS = {
    Ending.HOME: "the whole goal is met",
    Ending.HOME_WITH_ROWS_GIVEN_UP: "the goal is not met as a whole; a motion was found that gives rows up",
    Ending.PATH_UNFINISHED: "the rest of the tool path is not finished",
    Ending.NO_ROUTE_FOUND: "configurations of the goal were found, but no motion to any of them",
    Ending.NOTHING_FOUND: "no configuration of the goal was found, not even with rows given up",
    Ending.PROVED_UNREACHABLE: "the goal is proved out of reach, and no configuration was found with rows given up",
    Ending.START_OUTSIDE_LIMITS: "there is no motion: the arm is outside its limits",
    Ending.START_TOO_CLOSE: "there is no motion: the arm, or what covers it, is already too close to itself or its cell",
    Ending.LOCK_ELSEWHERE: "there is no motion: a joint is not where it is said to be locked",
    Ending.START_BREAKS_ROWS: "there is no motion: where the arm is breaks a row that must be kept all the way",
    Ending.PROVED_DISCONNECTED: "configurations of the goal exist, and no motion leads to any of them",
}

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.recovery.goals import RowsGivenUp
    from holdfast.recovery.recovery import Recovery
    from holdfast.recovery.timing.motion import TimedMotion


def to_dict(recovery: Recovery) -> dict[str, Any]:
    """What came of it: the ending, the motion, its check, what is left and what is given up."""
    rest, timed = recovery.rest, recovery.timed
    return {
        **recovery.arm.entry(),
        "fingerprint": recovery.arm.fingerprint,
        "locked": recovery.locked,
        "degraded": recovery.degraded.to_dict(),
        "goal": recovery.goal,
        "task": recovery.task.name,
        "within": recovery.within,
        "ok": recovery.ok,
        "ending": recovery.ending.name.lower(),
        "sentence": recovery.ending.sentence,
        "reason": recovery.reason,
        "given_up": _rows(recovery.given_up),
        "choices": [_rows(c) for c in recovery.choices],
        "verdict": {"answer": recovery.verdict.answer, "why": recovery.verdict.why, "kind": recovery.verdict.kind or None},
        "verified": None
        if recovery.verified is None
        else {
            "ok": recovery.verified.ok,
            "faults": recovery.verified.faults,
            "exact_by": recovery.verified.exact_by,
            "goal_miss": recovery.verified.goal_miss,
            "path_miss": recovery.verified.path_miss,
            "kept": [{"off": off, "turned": turned} for off, turned in recovery.verified.kept],
        },
        "proof": recovery.proof,
        "goal_configurations_found": recovery.found,
        "starts": recovery.starts,
        "metric": recovery.metric,
        "unit": recovery.unit,
        "length": recovery.length,
        "lower_bound": recovery.lower_bound,
        "legs": [
            {"name": g.name, "first": g.first, "last": g.last, "length": g.length, "lower_bound": g.lower_bound}
            for g in recovery.legs
        ],
        "joints": recovery.arm.joint_names,
        "waypoints": recovery.q,
        "timed": None
        if timed is None
        else {
            "duration_s": timed.duration,
            "without_accelerations_s": timed.without,
            "accelerations": timed.accelerations,
            "stops": timed.stops,
            "rows": len(timed.time),
            "period_s": timed.period,
        },
        "check": recovery.check().to_dict() if len(recovery.q) else None,
        "clearance": None if recovery.clearance is None else shape_summary(recovery.clearance, recovery.margin),
        "keep": [kept.to_dict() for kept in recovery.keep],
        "left": None if recovery.left is None else recovery.left.to_dict(),
        "rest_of_path": None
        if rest is None
        else {
            "finished": rest.finished,
            "furthest": rest.furthest,
            "first_lost": rest.first_lost,
            "deviation": rest.deviation,
            "given_up": _rows(rest.given_up),
        },
        "seed": recovery.seed,
    }


def key_table(recovery: Recovery) -> Rows:
    """What came of it."""
    rows = [
        ["goal", recovery.goal],
        ["ending", recovery.ending.phrase],
        ["verdict", recovery.verdict.answer],
        ["waypoints", str(len(recovery.q))],
    ]
    if recovery.legs:
        rows.append(["length", f"{number(recovery.length)} {recovery.unit} (at least {number(recovery.lower_bound)})"])
    if recovery.timed is not None:
        rows.append(["takes", f"{number(recovery.timed.duration)} s within accelerations"])
    if recovery.left is not None and recovery.left.left is not None:
        rows.append(["of the workspace is left", str(recovery.left.left)])
    return Rows(["", ""], rows)


def story(recovery: Recovery) -> Story:
    """Whether the goal is met with what is locked, at what length, and what is left of the workspace."""
    from holdfast.present.recovery.left import FIGURES
    from holdfast.present.recovery.left import story as left_story

    asked, _, *rest = recovery.describe()
    arm, ending, left = recovery.arm, recovery.ending, recovery.left
    moves, length = len(recovery.q) > 1, f"{number(recovery.length)} {recovery.unit}"
    answer = f"With {recovery.degraded.describe()} {_ANSWERS[ending]}"
    if recovery.given_up is not None:
        answer += f": {recovery.given_up}"
    if moves:
        least = recovery.length <= recovery.lower_bound * (1 + 1e-9)
        bound = (
            "no route to any configuration found is shorter" if least else f"at least {number(recovery.lower_bound)} are needed"
        )
        answer += f", by a motion of {counted(len(recovery.q), 'waypoint')} and {length}; {bound}"
    elif ending == Ending.HOME:
        answer += "; the arm is there already"
    answer += "."
    if not recovery.ok:
        kind = f" ({recovery.verdict.kind})" if recovery.verdict.kind else ""
        answer += f" What was asked for as a whole is {recovery.verdict.answer}{kind}."
    facts = [(length, "length of the motion" if recovery.unit == "rad" else "duration of the motion")] if moves else []
    if moves:
        facts.append((f"{len(recovery.q)}", "waypoints, with straight lines in joint space between them"))
    if moves and recovery.timed is not None:
        facts.append((f"{number(recovery.timed.duration)} s", "it takes within the accelerations given"))
    if recovery.found:
        facts.append((f"{recovery.found:,}", "configurations of the goal were found"))
    if left is not None and left.left is not None:
        told = left_story(left)
        answer += f" {told.answer}"
        facts += told.facts[:1]
    q = recovery.q if moves else recovery.at[None]
    rows = [
        [
            joint.name,
            *(f"{number(joint.shown[0] * x)} {joint.shown[1]}" for x in (q[0, k], q[-1, k])),
            recovery.degraded.mark(joint.name),
        ]
        for k, joint in enumerate(arm.joints)
    ]
    if len(recovery.q):
        rest += [f"independent replay: {line}" for line in checks(recovery)]
    return Story(
        f"{arm.name} after a known failure",
        answer,
        about=capitalised(asked),
        facts=facts,
        lines=[f"{capitalised(line).rstrip('.')}." for line in rest if left is None or line not in left.describe()],
        views=_view(recovery),
        figures={"motion": None, **({} if recovery.timed is None else {"timing": TIMING}), **FIGURES},
        tables=[Rows(["joint", "start", "end", ""], rows, "Where the joints begin and end")],
        method=[
            ("Goal", recovery.goal),
            ("Task", recovery.task.describe()),
            ("Search", f"{recovery.starts} random starts for configurations of the goal, seed {recovery.seed}"),
            (
                "Shortest",
                "in joint space, 1 m of a slide as 1 rad" if recovery.unit == "rad" else "in time, within the velocity limits",
            ),
            *([] if recovery.timed is None else [("Timing", _timing(recovery.timed))]),
            *(("Kept all the way", str(kept)) for kept in recovery.keep),
            ("Verified", "there is no motion" if recovery.verified is None else str(recovery.verified)),
            ("Clearance", "not looked at" if recovery.clearance is None else shape_text(recovery.clearance, recovery.margin)),
        ],
        arm=arm,
    )


def _view(recovery: Recovery) -> list[tuple[str, list[Any]]]:
    from holdfast.present.arm.view import scene
    from holdfast.report.page import Picture

    goal = [] if recovery.goal_pose is None else [recovery.goal_pose]
    locked = list(recovery.locked)
    if len(recovery.q) < 2:
        words = "Where the arm is and stays, with the directions that the lock takes."
        return [
            (
                "Where the arm is",
                [
                    Picture(
                        scene(
                            recovery.arm, recovery.at, locked=locked, task=recovery.task, targets=goal, cell=recovery.cell
                        ).html("motion", words),
                        words,
                    )
                ],
            )
        ]
    q, time = on_the_way(recovery.q, _FRAMES), np.linspace(0.0, 100.0, _FRAMES)
    readings, at = [f"{share:.0f} % of the way" for share in time], "at one speed in joint space"
    if recovery.timed is not None:
        timed, time = recovery.timed, np.linspace(0.0, recovery.timed.time[-1], _FRAMES)
        q = np.stack([np.interp(time, timed.time, column) for column in timed.q.T], axis=1)
        readings, at = [f"{t:.2f} s" for t in time], "as it is timed within accelerations"
    shown = scene(recovery.arm, q, locked=locked, targets=goal, time=time, readings=readings, cell=recovery.cell)
    words = f"The motion with what is locked, {at}." + " The target of the end effector is marked." * bool(goal)
    return [("The motion", [Picture(shown.html("motion", words), words)])]


def _timing(timed: TimedMotion) -> str:
    moving = np.flatnonzero(timed.accelerations)
    limits = ", ".join(dict.fromkeys(f"{number(timed.accelerations[k])} {timed.arm.joints[k].unit}/s²" for k in moving))
    return (
        f"as fast as the speed limits and accelerations of {limits} allow, corners rounded where that is proved, by parabolas; "
        f"rows every {number(timed.period)} s"
    )


def on_the_way(q: Any, count: int) -> Any:
    """Configurations (count, n) at equal shares of the way (K, n)."""
    steps = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(q, axis=0), axis=1))])
    at = np.linspace(0, steps[-1], count)
    return np.stack([np.interp(at, steps, column) for column in q.T], axis=1)


def next_steps(recovery: Recovery, name: str) -> list[str]:
    """The motion for a controller, or why there is none."""
    if not len(recovery.q):
        return [f"{name}.choices  # rows that could be given up"]
    return [f"{name}.check()  # an independent replay", f'{name}.to_csv("waypoints.csv")']


def _rows(rows: RowsGivenUp | None) -> dict[str, float] | None:
    """What rows that are given up miss, by name with its unit."""
    if rows is None:
        return None
    return {f"{name}_{unit}": miss for name, unit, miss in zip(rows.names, rows.units, rows.misses, strict=True)}


def show(recovery: Recovery, out: Console) -> None:
    """The sentences, what the replay of the motion found, and where the joints begin and end."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    first, verdict, *rest = recovery.describe()
    out.print(escape(first), soft_wrap=True)
    out.print(f"[{'bold' if recovery.ok else 'bold red'}]{escape(verdict)}[/]", soft_wrap=True)
    for line in rest:
        out.print(escape(capitalised(line)), soft_wrap=True)
    if not len(recovery.q):
        return
    for line in checks(recovery):
        out.print(escape(f"check: {line}"), soft_wrap=True)
    table = Grid("joint", "start", "end", "")
    factors, units = zip(*(joint.shown for joint in recovery.arm.joints), strict=True)
    for name, *cells in zip(recovery.arm.joint_names, *(alike(factors * x, units) for x in recovery.q[[0, -1]]), strict=True):
        table.add_row(escape(name), *cells, recovery.degraded.mark(name))
    out.print(table)


def checks(recovery: Recovery) -> list[str]:
    """What the replay of its motion found, sentences."""
    shape = "" if recovery.clearance is None else f" ({shape_text(recovery.clearance, recovery.margin)})"
    return [line + shape * line.startswith("least") for line in recovery.check().describe()]
