"""Text, tables, and JSON of a recovery."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.formatting import capitalise_first, format_count
from holdfast.interface.presentation.collision.shape import describe_shape, summarize_shape
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable, format_column, format_significant
from holdfast.response.recovery.recovery import RecoveryOutcome

_VIEW_FRAMES = 121
TIMING_CAPTION = ("The timing", "Rates and accelerations of the joints, each in parts of its limit, over time.")
_OUTCOME_ANSWERS = {
    RecoveryOutcome.GOAL_REACHED: "the whole goal is met",
    RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS: "the goal is not met as a whole; a motion was found that gives rows up",
    RecoveryOutcome.PATH_UNFINISHED: "the rest of the tool path is not finished",
    RecoveryOutcome.NO_ROUTE_FOUND: "configurations of the goal were found, but no motion to any of them",
    RecoveryOutcome.NOTHING_FOUND: "no configuration of the goal was found, not even with rows given up",
    RecoveryOutcome.PROVED_UNREACHABLE: "the goal is proved out of reach, and no configuration was found with rows given up",
    RecoveryOutcome.START_OUTSIDE_LIMITS: "there is no motion: the arm is outside its limits",
    RecoveryOutcome.START_TOO_CLOSE: "there is no motion: the arm, or what covers it, is already too close to itself "
    "or its cell",
    RecoveryOutcome.LOCK_MISMATCH: "there is no motion: a joint is not where it is said to be locked",
    RecoveryOutcome.START_VIOLATES_CONSTRAINTS: "there is no motion: where the arm is breaks a row that must be kept "
    "all the way",
    RecoveryOutcome.PROVED_DISCONNECTED: "configurations of the goal exist, and no motion leads to any of them",
}

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.response.recovery.goals import RelaxedRows
    from holdfast.response.recovery.recovery import Recovery
    from holdfast.response.recovery.timing.motion import TimedMotion


def to_dict(recovery: Recovery) -> dict[str, Any]:
    """Return the outcome, the motion, its check, the remaining workspace, and the relaxed rows."""
    path_rest, timed_motion = recovery.rest, recovery.timed
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
        "given_up": _relaxed_misses(recovery.relaxed),
        "choices": [_relaxed_misses(choice) for choice in recovery.choices],
        "verdict": {"answer": recovery.verdict.answer, "why": recovery.verdict.why, "kind": recovery.verdict.kind or None},
        "verified": None
        if recovery.verified is None
        else {
            "ok": recovery.verified.ok,
            "faults": recovery.verified.faults,
            "exact_by": recovery.verified.exact_by,
            "goal_miss": recovery.verified.goal_miss,
            "path_miss": recovery.verified.path_miss,
            "kept": [{"off": deviation, "turned": tilt} for deviation, tilt in recovery.verified.kept],
        },
        "proof": recovery.proof,
        "goal_configurations_found": recovery.found,
        "starts": recovery.starts,
        "metric": recovery.metric,
        "unit": recovery.unit,
        "length": recovery.length,
        "lower_bound": recovery.lower_bound,
        "legs": [
            {"name": leg.name, "first": leg.first, "last": leg.last, "length": leg.length, "lower_bound": leg.lower_bound}
            for leg in recovery.legs
        ],
        "joints": recovery.arm.joint_names,
        "waypoints": recovery.q,
        "timed": None
        if timed_motion is None
        else {
            "duration_s": timed_motion.duration,
            "without_accelerations_s": timed_motion.without,
            "accelerations": timed_motion.accelerations,
            "stops": timed_motion.stops,
            "rows": len(timed_motion.time),
            "period_s": timed_motion.period,
        },
        "check": recovery.check().to_dict() if len(recovery.q) else None,
        "clearance": None if recovery.clearance is None else summarize_shape(recovery.clearance, recovery.margin),
        "keep": [constraint.to_dict() for constraint in recovery.keep],
        "left": None if recovery.left is None else recovery.left.to_dict(),
        "rest_of_path": None
        if path_rest is None
        else {
            "finished": path_rest.finished,
            "furthest": path_rest.furthest,
            "first_lost": path_rest.first_lost,
            "deviation": path_rest.deviation,
            "given_up": _relaxed_misses(path_rest.given_up),
        },
        "seed": recovery.seed,
    }


def key_table(recovery: Recovery) -> TextTable:
    """Tabulate the outcome, the length of the motion, and the remaining workspace."""
    rows = [
        ["goal", recovery.goal],
        ["ending", recovery.ending.phrase],
        ["verdict", recovery.verdict.answer],
        ["waypoints", str(len(recovery.q))],
    ]
    if recovery.legs:
        rows.append(
            [
                "length",
                f"{format_significant(recovery.length)} {recovery.unit} (at least {format_significant(recovery.lower_bound)})",
            ]
        )
    if recovery.timed is not None:
        rows.append(["takes", f"{format_significant(recovery.timed.duration)} s within accelerations"])
    if recovery.left is not None and recovery.left.left is not None:
        rows.append(["of the workspace is left", str(recovery.left.left)])
    return TextTable(["", ""], rows)


def story(recovery: Recovery) -> PageContent:
    """Compose the report: whether the goal is met with the locked joints, the length of the motion, and the remaining
    workspace.
    """
    from holdfast.interface.presentation.recovery.remaining_workspace import FIGURE_CAPTIONS
    from holdfast.interface.presentation.recovery.remaining_workspace import story as left_story

    request, _, *remarks = recovery.describe()
    arm, ending, remainder = recovery.arm, recovery.ending, recovery.left
    has_motion, length = len(recovery.q) > 1, f"{format_significant(recovery.length)} {recovery.unit}"
    answer = f"With {recovery.degraded.describe()} {_OUTCOME_ANSWERS[ending]}"
    if recovery.relaxed is not None:
        answer += f": {recovery.relaxed}"
    if has_motion:
        is_shortest = recovery.length <= recovery.lower_bound * (1 + 1e-9)
        bound = (
            "no route to any configuration found is shorter"
            if is_shortest
            else f"at least {format_significant(recovery.lower_bound)} are needed"
        )
        answer += f", by a motion of {format_count(len(recovery.q), 'waypoint')} and {length}; {bound}"
    elif ending == RecoveryOutcome.GOAL_REACHED:
        answer += "; the arm is there already"
    answer += "."
    if not recovery.ok:
        kind = f" ({recovery.verdict.kind})" if recovery.verdict.kind else ""
        answer += f" What was asked for as a whole is {recovery.verdict.answer}{kind}."
    facts = [(length, "length of the motion" if recovery.unit == "rad" else "duration of the motion")] if has_motion else []
    if has_motion:
        facts.append((f"{len(recovery.q)}", "waypoints, with straight lines in joint space between them"))
    if has_motion and recovery.timed is not None:
        facts.append((f"{format_significant(recovery.timed.duration)} s", "it takes within the accelerations given"))
    if recovery.found:
        facts.append((f"{recovery.found:,}", "configurations of the goal were found"))
    if remainder is not None and remainder.left is not None:
        workspace_report = left_story(remainder)
        answer += f" {workspace_report.answer}"
        facts += workspace_report.facts[:1]
    configurations = recovery.q if has_motion else recovery.at[None]
    rows = [
        [
            joint.name,
            *(
                f"{format_significant(joint.display_unit[0] * position)} {joint.display_unit[1]}"
                for position in (configurations[0, joint_index], configurations[-1, joint_index])
            ),
            recovery.degraded.mark(joint.name),
        ]
        for joint_index, joint in enumerate(arm.joints)
    ]
    if len(recovery.q):
        remarks += [f"independent replay: {remark}" for remark in list_replay_results(recovery)]
    return PageContent(
        f"{arm.name} after a known failure",
        answer,
        about=capitalise_first(request),
        facts=facts,
        lines=[
            f"{capitalise_first(remark).rstrip('.')}."
            for remark in remarks
            if remainder is None or remark not in remainder.describe()
        ],
        views=_animate_recovery(recovery),
        figures={"motion": None, **({} if recovery.timed is None else {"timing": TIMING_CAPTION}), **FIGURE_CAPTIONS},
        tables=[TextTable(["joint", "start", "end", ""], rows, "Where the joints begin and end")],
        method=[
            ("Goal", recovery.goal),
            ("Task", recovery.task.describe()),
            ("Search", f"{recovery.starts} random starts for configurations of the goal, seed {recovery.seed}"),
            (
                "Shortest",
                "in joint space, 1 m of a slide as 1 rad" if recovery.unit == "rad" else "in time, within the velocity limits",
            ),
            *([] if recovery.timed is None else [("Timing", _describe_timing(recovery.timed))]),
            *(("Kept all the way", str(constraint)) for constraint in recovery.keep),
            ("Verified", "there is no motion" if recovery.verified is None else str(recovery.verified)),
            (
                "Clearance",
                "not looked at" if recovery.clearance is None else describe_shape(recovery.clearance, recovery.margin),
            ),
        ],
        arm=arm,
    )


def _animate_recovery(recovery: Recovery) -> list[tuple[str, list[Any]]]:
    from holdfast.interface.presentation.arm.view import scene
    from holdfast.interface.report.page import Picture

    goals = [] if recovery.goal_pose is None else [recovery.goal_pose]
    locked = list(recovery.locked)
    if len(recovery.q) < 2:
        caption = "Where the arm is and stays, with the directions that the lock takes."
        return [
            (
                "Where the arm is",
                [
                    Picture(
                        scene(
                            recovery.arm, recovery.at, locked=locked, task=recovery.task, targets=goals, cell=recovery.cell
                        ).to_html("motion", caption),
                        caption,
                    )
                ],
            )
        ]
    q, time = resample_path(recovery.q, _VIEW_FRAMES), np.linspace(0.0, 100.0, _VIEW_FRAMES)
    readings, speed_text = [f"{progress:.0f} % of the way" for progress in time], "at one speed in joint space"
    if recovery.timed is not None:
        timed_motion, time = recovery.timed, np.linspace(0.0, recovery.timed.time[-1], _VIEW_FRAMES)
        q = np.stack([np.interp(time, timed_motion.time, column) for column in timed_motion.q.T], axis=1)
        readings, speed_text = [f"{instant:.2f} s" for instant in time], "as it is timed within accelerations"
    motion_scene = scene(recovery.arm, q, locked=locked, targets=goals, time=time, readings=readings, cell=recovery.cell)
    caption = f"The motion with what is locked, {speed_text}." + " The target of the end effector is marked." * bool(goals)
    return [("The motion", [Picture(motion_scene.to_html("motion", caption), caption)])]


def _describe_timing(timed_motion: TimedMotion) -> str:
    moving_joints = np.flatnonzero(timed_motion.accelerations)
    limits = ", ".join(
        dict.fromkeys(
            f"{format_significant(timed_motion.accelerations[joint])} {timed_motion.arm.joints[joint].unit}/s²"
            for joint in moving_joints
        )
    )
    return (
        f"as fast as the speed limits and accelerations of {limits} allow, corners rounded where that is proved, by parabolas; "
        f"rows every {format_significant(timed_motion.period)} s"
    )


def resample_path(waypoints: Any, count: int) -> Any:
    """Resample the path (K, n) at ``count`` equal fractions of its length: configurations (count, n)."""
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(waypoints, axis=0), axis=1))])
    samples = np.linspace(0, lengths[-1], count)
    return np.stack([np.interp(samples, lengths, column) for column in waypoints.T], axis=1)


def _relaxed_misses(relaxed_rows: RelaxedRows | None) -> dict[str, float] | None:
    """Return the errors of the relaxed rows by name with their unit."""
    if relaxed_rows is None:
        return None
    return {
        f"{name}_{unit}": residual
        for name, unit, residual in zip(relaxed_rows.names, relaxed_rows.units, relaxed_rows.misses, strict=True)
    }


def show(recovery: Recovery, out: Console) -> None:
    """Print the sentences, the results of the replay, and the joint positions at start and end."""
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    headline, verdict, *remarks = recovery.describe()
    out.print(escape(headline), soft_wrap=True)
    out.print(f"[{'bold' if recovery.ok else 'bold red'}]{escape(verdict)}[/]", soft_wrap=True)
    for remark in remarks:
        out.print(escape(capitalise_first(remark)), soft_wrap=True)
    if not len(recovery.q):
        return
    for remark in list_replay_results(recovery):
        out.print(escape(f"check: {remark}"), soft_wrap=True)
    table = BandedTable("joint", "start", "end", "")
    factors, units = zip(*(joint.display_unit for joint in recovery.arm.joints), strict=True)
    for name, *cells in zip(
        recovery.arm.joint_names,
        *(format_column(factors * configuration, units) for configuration in recovery.q[[0, -1]]),
        strict=True,
    ):
        table.add_row(escape(name), *cells, recovery.degraded.mark(name))
    out.print(table)


def list_replay_results(recovery: Recovery) -> list[str]:
    """Return the results of the replay of the motion as sentences."""
    shape_note = "" if recovery.clearance is None else f" ({describe_shape(recovery.clearance, recovery.margin)})"
    return [sentence + shape_note * sentence.startswith("least") for sentence in recovery.check().describe()]
