"""Presentation of the lock survival of a motion: the locks it survives, and an upper bound for every motion."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np

from holdfast.core.formatting import capitalise_first, format_count, format_number, format_percent
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.view import build_view_section
from holdfast.interface.presentation.lock_survival.figures import draw_jump, draw_map, draw_survival
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Presentation, TableSpec, make_headers
from holdfast.interface.presentation.renderers import write_json
from holdfast.interface.report.page import Section
from holdfast.response.lock_survival.injection import LockTests
from holdfast.response.lock_survival.planning import LockSurvival

_NEGLIGIBLE_SPEED_M_S = 1e-9  # m/s
_SMALL_MOTION = 0.3  # rad and m along a whole curve
_STANDSTILL_TOLERANCE = 1e-6  # rad and m along a whole curve
_PROBABILITY_TOLERANCE = 1e-9  # smaller differences of probabilities are rounding
_KIND_PREFIXES = {"exact": "", "upper bound": "at most ", "lower bound": "at least "}


def to_dict(survival: LockSurvival) -> dict[str, Any]:
    """Return the survival with its bounds, over time and by joint."""
    names = survival.arm.joint_names
    lower, upper = survival.interval or (None, None)
    worst_time, worst_survival = survival.worst
    return {
        **survival.arm.entry(),
        "task": survival.task.name,
        "mode": survival.mode,
        "kind": survival.kind,
        "keep": [constraint.to_dict() for constraint in survival.keep],
        "rates": dict(zip(names, survival.rates.each, strict=True)),
        "rates_per_second": survival.rates.per_second,
        "survival": survival.survival,
        "bound": survival.survival_bound,
        "gap": survival.gap,
        "best_within_velocity_limits": lower,
        "best_with_spacing_on_top": upper,
        "guaranteed": survival.survives_all_locks,
        "lost": survival.loss_probability,
        "safe_from_s": survival.safe_from,
        "safe_until_s": survival.safe_until,
        "worst": {"at_s": worst_time, "survival": worst_survival},
        "never": None if survival.never is None else {"at_s": survival.never[0], "joint": survival.never[1]},
        "by_joint": survival.by_joint,
        "fraction_of_velocity_limits": survival.speed,
        "velocity_jump": {
            "most_linear_m_per_s": survival.jump.most_linear,
            "most_angular_rad_per_s": survival.jump.most_angular,
            "mean_linear_m_per_s": survival.jump.mean_linear,
            "mean_angular_rad_per_s": survival.jump.mean_angular,
            "linear_m_per_s": survival.jump.linear,
            "angular_rad_per_s": survival.jump.angular,
        },
        "beside": {baseline.name: baseline.survival for baseline in survival.comparisons},
        "injected": None if survival.injected is None else _lock_test_entries(survival.injected),
        "time_s": survival.time,
        "survival_at": survival.curve(),
        "q": survival.q,
    }


def _lock_test_entries(lock_tests: LockTests) -> dict[str, Any]:
    interval = lock_tests.interval
    return {
        "locks": len(lock_tests.time),
        "survived": interval.value,
        "low": interval.low,
        "high": interval.high,
        "confidence": interval.confidence,
        "alike": lock_tests.agreement,
        "told": int(lock_tests.told.sum()),
        "disagreements": lock_tests.disagreements,
    }


def present(survival: LockSurvival) -> Presentation:
    """Present the survival of the motion, the largest one possible, and the joints whose lock ends the motion."""
    arm, worst_time, worst_survival = survival.arm, *survival.worst
    verb, prefix = "may be" if survival.kind == "upper bound" else "is", _KIND_PREFIXES[survival.kind]
    bound = "" if survival.kind == "exact" else f" ({survival.kind})"
    facts = [Fact("locks survived", survival.survival, phrase=f"of the locks on the way are survived{bound}", style="percent")]
    if survival.survival_bound is not None:
        phrase = "is the most that any motion can survive, up to the grid"
        facts.append(Fact("no motion survives more than", survival.survival_bound, phrase=phrase, style="percent"))
    start = f"{format_number(survival.safe_from)} s"
    phrase = f"from then on every lock {verb} survived" if 0 < survival.safe_from < survival.time[-1] else ""
    facts += [
        Fact(f"every lock {verb} survived from", start, phrase=phrase),
        Fact("survived at the worst instant", f"{prefix}{format_percent(worst_survival)}, at {format_number(worst_time)} s"),
        Fact("largest loss of tool velocity at a lock", f"{format_number(survival.jump.most_linear)} m/s"),
    ]
    figures = {
        "survival": FigureSpec(
            partial(draw_survival, survival),
            "Survival over time",
            "Probability that the rest of the path can be followed if a joint locks now.",
        )
    }
    if survival.found is not None:
        held = f" All of them keep {' and '.join(survival.found.held)} fixed, like the motion." if survival.found.held else ""
        figures["map"] = FigureSpec(
            partial(draw_map, survival),
            "Survivable locks by configuration",
            "Configurations found for every pose, by the position of the joint that the self-motion moves most; where several "
            "share a position, the best is shown. The line is the motion. The first map shows the fraction of all locks that "
            f"is survivable, the others whether the lock of one joint is (yellow).{held}",
        )
    figures["jump"] = FigureSpec(
        partial(draw_jump, survival),
        "Loss of tool velocity at a lock",
        "Velocity that the tool point loses when a joint stops instantly, for each joint.",
    )
    return Presentation(
        "Locks that a motion survives",
        _compose_answer(survival),
        about=f"{arm.title}, task {survival.task.name}, {survival.path.describe()}, "
        + ("without leaving the path" if survival.mode == "on-path" else "with detours"),
        lines=[f"{capitalise_first(line)}." for line in _list_reasons(survival)],
        facts=[fact for fact in facts if not fact.phrase or fact.text != "0 %"],
        tables=_build_tables(survival),
        figures=figures,
        sections=partial(_build_sections, survival),
        method=[
            ("Failure", "one joint locks at a random time and stays locked; later locks are not considered"),
            ("Mode", survival.mode),
            *(("Path constraint before and after a lock", str(constraint)) for constraint in survival.keep),
            ("Rates", "per second" if survival.rates.per_second else "relative"),
            ("Poses", f"{len(survival.time)}, evenly spaced in time"),
        ],
        arm=arm,
        exports={"endurance.json": partial(write_json, survival), "motion.csv": survival.to_csv},
    )


def _compose_answer(survival: LockSurvival) -> str:
    if survival.survives_all_locks:
        return "The motion survives a lock of any one joint at any sample of the path."
    share = f"{_KIND_PREFIXES[survival.kind]}{format_percent(survival.survival)}"
    text = f"The motion survives {share} of all single-joint locks on the way"
    if survival.survival_bound is not None:
        text += f"; no motion along this path survives more than {format_percent(survival.survival_bound)}"
    if survival.comparisons:
        best_baseline = max(survival.comparisons, key=lambda baseline: baseline.survival)
        text += f"; of the other motions, {best_baseline.name} survives most ({format_percent(best_baseline.survival)})"
    return f"{text}."


def _list_reasons(survival: LockSurvival) -> list[str]:
    """List the kind of the bound, the constraints, the injected locks, and the joints whose lock no motion survives."""
    lines, conditions, redundancy = [], survival.conditions, survival.redundancy
    if survival.kind == "lower bound":
        cone_text = ", or the axis of the cone and fewer joints" if conditions.left_to_arm else ""
        lines.append(
            "this is a lower bound: after a lock the arm is still redundant, and the search considers only continuations that "
            f"keep {format_count(redundancy - 1, 'further joint')} fixed{cone_text}"
            if survival.mode == "on-path"
            else "this is a lower bound: of the later poses, only those that inverse kinematics reached with the lock count"
        )
    elif survival.found is not None:
        lower, upper = survival.found.interval
        best = "no motion was found" if np.isnan(lower) else f"the best motion survives {format_percent(lower)}"
        lines.append(
            f"the bound for every motion holds up to the grid of {len(survival.time)} poses and {survival.found.spacing:g} "
            f"rad; on its nodes, {best} within the velocity limits, and {format_percent(upper)} with one spacing added to them"
        )
    if survival.kept is not None and survival.kind != "lower bound":
        lines.append("clearance is computed with shapes that enclose the links; the real arm is smaller and may survive more")
    if survival.keep:
        task_text = "" if conditions.left_to_arm else ", determined by the path alone"
        lines.append(f"path constraints before and after a lock{task_text}: {'; '.join(map(str, survival.keep))}")
    if survival.injected is not None:
        interval = survival.injected.interval
        lines.append(
            f"{format_percent(interval.value)} of {len(survival.injected.time)} locks injected at random times were survived "
            f"({format_percent(interval.low)} to {format_percent(interval.high)}, 95 %); "
            f"{format_percent(survival.injected.agreement)} of the outcomes agree with the prediction"
        )
    if survival.never is not None:
        time, name = survival.never
        lines.append(
            f"no motion survives every lock: at {format_number(time, 4)} s no configuration does, and the fewest survive "
            f"that of {name}"
        )
    lines += _explain_pose_limits(survival)
    if survival.speed > 1 + _PROBABILITY_TOLERANCE:
        lines.append(f"the motion needs {survival.speed:.3g} times the velocity limit of a joint; slow the path down")
    if survival.loss_probability is not None:
        lines.append(f"probability that a lock prevents the arm from finishing the path: {survival.loss_probability:.3g}")
    if survival.kind == "upper bound":
        condition_text = "with the path constraints" if survival.keep else "among obstacles"
        lines.append(f"every probability is an upper bound, because detours {condition_text} were not searched")
    jump = survival.jump
    lines.append(
        f"when a joint stops instantly, the tool loses at most {jump.most_linear:.3g} m/s and {jump.most_angular:.3g} rad/s, "
        f"and on average {jump.mean_linear:.3g} m/s and {jump.mean_angular:.3g} rad/s"
    )
    return lines


def _explain_pose_limits(survival: LockSurvival) -> list[str]:
    """Explain why hardly any motion survives some locks; for full poses this is mostly the lock of an elbow."""
    if survival.found is None or survival.kind == "lower bound":
        return []
    is_fixed = (survival.found.moved <= _SMALL_MOTION) & (survival.rates.each > 0) & ~survival.survives.all(axis=0)
    lines = []
    for index in np.flatnonzero(is_fixed):
        joint, motion_range = survival.arm.joints[index], survival.found.moved[index]
        range_text = f" by more than {motion_range:.3g} {joint.unit}" if motion_range > _STANDSTILL_TOLERANCE else ""
        lines.append(
            f"no self-motion moves {joint.name}{range_text}, because the pose determines it (for an elbow between a spherical "
            "shoulder and wrist, their distance does); its lock is survived only while this value hardly changes"
        )
    return lines


def _build_tables(survival: LockSurvival) -> list[TableSpec]:
    """Tabulate the survival of each joint, and that of other motions."""
    lock_fractions = survival.rates.each / survival.rates.total
    joint_results = zip(survival.by_joint.items(), lock_fractions, survival.jump.linear.T, strict=True)
    fractions = make_headers("fraction of all locks", "of its locks survived", style="percent")
    joints = TableSpec(
        "Survival by joint",
        ["joint", *fractions, "largest loss of tool velocity"],
        [
            [name, float(fraction), survived, _format_largest(velocity_loss, survival.time)]
            for (name, survived), fraction, velocity_loss in joint_results
        ],
    )
    motion_name = "most locks survived" if survival.found is not None else "this motion"
    motions = TableSpec(
        "Other motions along the path",
        ["motion", *make_headers("locks survived", "samples off the path", style="percent")],
        [
            [motion_name, survival.survival, 0.0],
            *([baseline.name, baseline.survival, baseline.off] for baseline in survival.comparisons),
        ],
    )
    return [joints, motions] if survival.comparisons else [joints]


def _format_largest(values: FloatArray, time: FloatArray) -> str:
    """Format the largest of the speeds (T,) with its time; rounding errors become 0."""
    largest = float(values.max())
    if largest <= _NEGLIGIBLE_SPEED_M_S:
        return "0 m/s"
    return f"{format_number(largest)} m/s, at {format_number(time[values.argmax()])} s"


def _build_sections(survival: LockSurvival) -> Sequence[Section]:
    """Animate the arm along its path."""
    section = build_view_section(
        "The motion",
        survival.arm,
        survival.q,
        "The arm on its path (orange).",
        label=f"{survival.arm.name} moving along its path",
        time=np.linspace(0.0, survival.time[-1], len(survival.time)),
        path=survival.poses[:, :3, 3],
        readings=[
            f"{instant:.2f} s, {format_percent(survived)} of the locks survived"
            for instant, survived in zip(survival.time, survival.curve(), strict=True)
        ],
        cell=None if survival.kept is None else survival.kept[0].cell,
    )
    return [section]
