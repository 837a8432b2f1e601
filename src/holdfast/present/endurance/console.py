"""What a motion survives in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from holdfast.present.printing import Rows
from holdfast.present.story import Story
from holdfast.words import capitalised, number, percent

if TYPE_CHECKING:
    from holdfast.endurance.endurance import Endurance


def to_dict(e: Endurance) -> dict[str, Any]:
    """The survival with what bounds it, over time and by joint."""
    names = e.arm.joint_names
    low, high = e.interval or (None, None)
    when, least = e.worst
    return {
        **e.arm.entry(),
        "task": e.task.name,
        "mode": e.mode,
        "exact": e.exact,
        "rates": dict(zip(names, e.rates.each, strict=True)),
        "rates_per_second": e.rates.per_second,
        "survival": e.survival,
        "bound": e.bound,
        "gap": e.gap,
        "best_within_velocity_limits": low,
        "best_with_spacing_on_top": high,
        "guaranteed": e.guaranteed,
        "lost": e.lost,
        "safe_from_s": e.safe_from,
        "safe_until_s": e.safe_until,
        "worst": {"at_s": when, "survival": least},
        "never": None if e.never is None else {"at_s": e.never[0], "joint": e.never[1]},
        "by_joint": e.by_joint,
        "fraction_of_velocity_limits": e.speed,
        "velocity_jump": {
            "most_linear_m_per_s": e.jump.most_linear,
            "most_angular_rad_per_s": e.jump.most_angular,
            "mean_linear_m_per_s": e.jump.mean_linear,
            "mean_angular_rad_per_s": e.jump.mean_angular,
        },
        "time_s": e.time,
        "survival_at": e.curve(),
        "q": e.q,
    }


def key_table(e: Endurance) -> Rows:
    """The survival, what bounds it, and when it is least."""
    when, least = e.worst
    rows = [["locks survived", percent(e.survival)]]
    if e.found is not None:
        rows.append(["no motion survives more than", percent(e.found.bound)])
    rows += [
        ["at the worst instant", f"{percent(least)}, at {number(when)} s"],
        ["every lock is survived from", f"{number(e.safe_from)} s on"],
        ["largest loss of tool velocity at a lock", f"{number(e.jump.most_linear)} m/s"],
    ]
    return Rows(["", ""], rows)


def next_steps(e: Endurance, name: str) -> list[str]:
    """The motion as a table, and the page."""
    del e
    return [f'{name}.to_csv("motion.csv")', f'{name}.report("endurance.html")']


def tables(e: Endurance) -> list[Rows]:
    """Survival of each joint."""
    share = e.rates.each / e.rates.total
    rows = [[name, percent(s), percent(x)] for (name, x), s in zip(e.by_joint.items(), share, strict=True)]
    return [Rows(["joint", "part of all locks", "of its locks survived"], rows, "Survival by joint")]


def story(e: Endurance) -> Story:
    """How many locks are survived, and how many could be."""
    first, *others = map(capitalised, e.describe())
    answer = f"{capitalised(e.headline)}"
    if e.found is not None and not e.guaranteed:
        answer += f"; no motion along this path survives more than {percent(e.found.bound)}"
    facts = [(percent(e.survival), "of the locks on the way are survived")]
    if e.found is not None:
        facts.append((percent(e.found.bound), "is the most that any motion could survive, up to the grid"))
    if e.safe_from < e.time[-1] and e.safe_from > 0:
        facts.append((f"{number(e.safe_from)} s", "from then on every lock is survived"))
    about = f"{e.arm.title}, task {e.task.name}, {e.path.describe()}"
    return Story(
        "Which locks a motion survives",
        f"{answer}.",
        about=about,
        facts=[fact for fact in facts if fact[0] != "0 %"],
        lines=[f"{line}." for line in (first, *others)],
        figures={
            "survival": ("Survival over time", "Probability that the rest of the path can be followed if a joint locks now.")
        },
        tables=[key_table(e), *tables(e)],
        method=[
            ("Failure", "one joint locks, at a random time, and stays; later locks are not counted"),
            ("Mode", e.mode),
            ("Rates", "per second" if e.rates.per_second else "relative"),
            ("Poses", f"{len(e.time)}, evenly spaced in time"),
        ],
        arm=e.arm,
    )
