"""Text, tables, and JSON of the lock survival of a motion."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.formatting import capitalise_first, format_number, format_percent
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable

if TYPE_CHECKING:
    from holdfast.response.lock_survival.injection import LockTests
    from holdfast.response.lock_survival.planning import LockSurvival


_NEGLIGIBLE_SPEED_M_S = 1e-9  # m/s


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


def key_table(survival: LockSurvival) -> TextTable:
    """Tabulate the survival, its bounds, and its worst instant."""
    worst_time, worst_survival = survival.worst
    label_by_kind = {
        "exact": "locks survived",
        "upper bound": "locks survived, at most",
        "lower bound": "locks survived, at least",
    }
    rows = [[label_by_kind[survival.kind], format_percent(survival.survival)]]
    if survival.survival_bound is not None:
        rows.append(["no motion survives more than", format_percent(survival.survival_bound)])
    rows += [
        ["at the worst instant", f"{format_percent(worst_survival)}, at {format_number(worst_time)} s"],
        [f"every lock {_survival_verb(survival)} survived from", f"{format_number(survival.safe_from)} s on"],
        ["largest loss of tool velocity at a lock", f"{format_number(survival.jump.most_linear)} m/s"],
    ]
    return TextTable(["", ""], rows)


def tables(survival: LockSurvival) -> list[TextTable]:
    """Tabulate the survival of each joint, and that of other motions."""
    lock_fractions = survival.rates.each / survival.rates.total
    joint_results = zip(survival.by_joint.items(), lock_fractions, survival.jump.linear.T, strict=True)
    rows = [
        [name, format_percent(fraction), format_percent(survived), _format_largest(velocity_loss, survival.time)]
        for (name, survived), fraction, velocity_loss in joint_results
    ]
    header = ["joint", "part of all locks", "of its locks survived", "largest loss of tool velocity"]
    result_tables = [TextTable(header, rows, "Survival by joint")]
    if survival.comparisons:
        motion_name = "most locks survived" if survival.found is not None else "this motion"
        baseline_rows = [
            [baseline.name, format_percent(baseline.survival), format_percent(baseline.off)]
            for baseline in survival.comparisons
        ]
        motion_rows = [[motion_name, format_percent(survival.survival), format_percent(0.0)], *baseline_rows]
        result_tables.append(
            TextTable(["motion", "locks survived", "off the path"], motion_rows, "Other motions along the path")
        )
    return result_tables


def story(survival: LockSurvival) -> PageContent:
    """Compose the report: the survival of the motion, and the largest one possible."""
    _, *lines = map(capitalise_first, survival.describe())
    answer = f"{capitalise_first(survival.headline)}"
    if survival.comparisons:
        best_baseline = max(survival.comparisons, key=lambda baseline: baseline.survival)
        answer += f"; of the motions beside it {best_baseline.name} survives most, {format_percent(best_baseline.survival)}"
    bound = "" if survival.kind == "exact" else f" ({survival.kind})"
    facts = [(format_percent(survival.survival), f"of the locks on the way are survived{bound}")]
    if survival.survival_bound is not None:
        facts.append((format_percent(survival.survival_bound), "is the most that any motion could survive, up to the grid"))
    if survival.safe_from < survival.time[-1] and survival.safe_from > 0:
        facts.append((f"{format_number(survival.safe_from)} s", f"from then on every lock {_survival_verb(survival)} survived"))
    about = f"{survival.arm.title}, task {survival.task.name}, {survival.path.describe()}"
    return PageContent(
        "Which locks a motion survives",
        f"{answer}.",
        about=about,
        facts=[fact for fact in facts if fact[0] != "0 %"],
        lines=[f"{line}." for line in lines],
        views=_animate_motion(survival),
        figures={
            "survival": ("Survival over time", "Probability that the rest of the path can be followed if a joint locks now."),
            "map": (
                "Which locks are survivable where",
                "Configurations found of every pose, by the joint that self-motion moves most; of several with the same "
                "value the best. Line: the motion. First the part of all locks that is survivable there, then for each joint "
                f"whether its lock is (yellow).{_describe_constraints(survival)}",
            ),
            "jump": (
                "What a lock takes from the tool",
                "Velocity of the tool point that is lost when a joint stops at once, for each joint.",
            ),
        },
        tables=[key_table(survival), *tables(survival)],
        method=[
            ("Failure", "one joint locks, at a random time, and stays; later locks are not counted"),
            ("Mode", survival.mode),
            *(("Kept before a lock and after it", str(constraint)) for constraint in survival.keep),
            ("Rates", "per second" if survival.rates.per_second else "relative"),
            ("Poses", f"{len(survival.time)}, evenly spaced in time"),
        ],
        arm=survival.arm,
    )


def _format_largest(values: FloatArray, time: FloatArray) -> str:
    """Format the largest of speeds (T,) with its time; 0 where it is rounding."""
    largest = float(values.max())
    return (
        f"{format_number(largest)} m/s, at {format_number(time[values.argmax()])} s"
        if largest > _NEGLIGIBLE_SPEED_M_S
        else "0 m/s"
    )


def _survival_verb(survival: LockSurvival) -> str:
    return "may be" if survival.kind == "upper bound" else "is"


def _describe_constraints(survival: LockSurvival) -> str:
    """Return a sentence with the constraints that all configurations of the map satisfy."""
    if survival.found is None or not survival.found.held:
        return ""
    return f" All of them hold {' and '.join(survival.found.held)}, as the motion does."


def _animate_motion(survival: LockSurvival) -> list[tuple[str, list[Any]]]:
    """Animate the arm along its path."""
    from holdfast.interface.presentation.arm.view import scene
    from holdfast.interface.report.page import Picture

    curve = survival.curve()
    motion_scene = scene(
        survival.arm,
        survival.q,
        time=np.linspace(0.0, survival.time[-1], len(survival.time)),
        path=survival.poses[:, :3, 3],
        readings=[
            f"{instant:.2f} s, {format_percent(survived)} of the locks survived"
            for instant, survived in zip(survival.time, curve, strict=True)
        ],
        cell=None if survival.kept is None else survival.kept[0].cell,
    )
    picture = Picture(
        motion_scene.to_html("motion", f"{survival.arm.name} moving along its path"), "The arm on its path (orange)."
    )
    return [("The motion", [picture])]
