"""What a motion survives in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.present.printing import Rows
from holdfast.present.story import Story
from holdfast.words import capitalised, number, percent

if TYPE_CHECKING:
    from holdfast.endurance.endurance import Endurance
    from holdfast.endurance.injection import Injection

Array = NDArray[np.float64]

_NOTHING = 1e-9  # m/s


def to_dict(e: Endurance) -> dict[str, Any]:
    """The survival with what bounds it, over time and by joint."""
    names = e.arm.joint_names
    low, high = e.interval or (None, None)
    when, least = e.worst
    return {
        **e.arm.entry(),
        "task": e.task.name,
        "mode": e.mode,
        "kind": e.kind,
        "keep": [kept.to_dict() for kept in e.keep],
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
            "linear_m_per_s": e.jump.linear,
            "angular_rad_per_s": e.jump.angular,
        },
        "beside": {other.name: other.survival for other in e.beside},
        "injected": None if e.injected is None else _injected(e.injected),
        "time_s": e.time,
        "survival_at": e.curve(),
        "q": e.q,
    }


def _injected(tried: Injection) -> dict[str, Any]:
    p = tried.interval
    return {
        "locks": len(tried.time),
        "survived": p.value,
        "low": p.low,
        "high": p.high,
        "confidence": p.confidence,
        "alike": tried.alike,
        "told": int(tried.told.sum()),
        "disagreements": tried.disagreements,
    }


def key_table(e: Endurance) -> Rows:
    """The survival, what bounds it, and when it is least."""
    when, least = e.worst
    at = {"exact": "locks survived", "upper bound": "locks survived, at most", "lower bound": "locks survived, at least"}
    rows = [[at[e.kind], percent(e.survival)]]
    if e.bound is not None:
        rows.append(["no motion survives more than", percent(e.bound)])
    rows += [
        ["at the worst instant", f"{percent(least)}, at {number(when)} s"],
        [f"every lock {_is(e)} survived from", f"{number(e.safe_from)} s on"],
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
    lost = zip(e.by_joint.items(), share, e.jump.linear.T, strict=True)
    rows = [[name, percent(s), percent(x), _largest(v, e.time)] for (name, x), s, v in lost]
    header = ["joint", "part of all locks", "of its locks survived", "largest loss of tool velocity"]
    found = [Rows(header, rows, "Survival by joint")]
    if e.beside:
        mine = "most locks survived" if e.found is not None else "this motion"
        others = [[other.name, percent(other.survival), percent(other.off)] for other in e.beside]
        each = [[mine, percent(e.survival), percent(0.0)], *others]
        found.append(Rows(["motion", "locks survived", "off the path"], each, "Other motions along the path"))
    return found


def story(e: Endurance) -> Story:
    """How many locks are survived, and how many could be."""
    _, *lines = map(capitalised, e.describe())
    answer = f"{capitalised(e.headline)}"
    if e.beside:
        other = max(e.beside, key=lambda x: x.survival)
        answer += f"; of the motions beside it {other.name} survives most, {percent(other.survival)}"
    bound = "" if e.kind == "exact" else f" ({e.kind})"
    facts = [(percent(e.survival), f"of the locks on the way are survived{bound}")]
    if e.bound is not None:
        facts.append((percent(e.bound), "is the most that any motion could survive, up to the grid"))
    if e.safe_from < e.time[-1] and e.safe_from > 0:
        facts.append((f"{number(e.safe_from)} s", f"from then on every lock {_is(e)} survived"))
    about = f"{e.arm.title}, task {e.task.name}, {e.path.describe()}"
    return Story(
        "Which locks a motion survives",
        f"{answer}.",
        about=about,
        facts=[fact for fact in facts if fact[0] != "0 %"],
        lines=[f"{line}." for line in lines],
        views=_moving(e),
        figures={
            "survival": ("Survival over time", "Probability that the rest of the path can be followed if a joint locks now."),
            "map": (
                "Which locks are survivable where",
                "Configurations found of every pose, by the joint that self-motion moves most; of several with the same "
                "value the best. Line: the motion. First the part of all locks that is survivable there, then for each joint "
                f"whether its lock is (yellow).{_holding(e)}",
            ),
            "jump": (
                "What a lock takes from the tool",
                "Velocity of the tool point that is lost when a joint stops at once, for each joint.",
            ),
        },
        tables=[key_table(e), *tables(e)],
        method=[
            ("Failure", "one joint locks, at a random time, and stays; later locks are not counted"),
            ("Mode", e.mode),
            *(("Kept before a lock and after it", str(kept)) for kept in e.keep),
            ("Rates", "per second" if e.rates.per_second else "relative"),
            ("Poses", f"{len(e.time)}, evenly spaced in time"),
        ],
        arm=e.arm,
    )


def _largest(values: Array, time: Array) -> str:
    """The largest of speeds (T,) and when it is; 0 where it is rounding."""
    most = float(values.max())
    return f"{number(most)} m/s, at {number(time[values.argmax()])} s" if most > _NOTHING else "0 m/s"


def _is(e: Endurance) -> str:
    return "may be" if e.kind == "upper bound" else "is"


def _holding(e: Endurance) -> str:
    """What all configurations of the map hold, a sentence."""
    if e.found is None or not e.found.held:
        return ""
    return f" All of them hold {' and '.join(e.found.held)}, as the motion does."


def _moving(e: Endurance) -> list[tuple[str, list[Any]]]:
    """The arm on its way."""
    from holdfast.present.arm.view import scene
    from holdfast.report.page import Picture

    curve = e.curve()
    shown = scene(
        e.arm,
        e.q,
        time=np.linspace(0.0, e.time[-1], len(e.time)),
        path=e.poses[:, :3, 3],
        readings=[f"{t:.2f} s, {percent(p)} of the locks survived" for t, p in zip(e.time, curve, strict=True)],
        cell=None if e.kept is None else e.kept[0].cell,
    )
    picture = Picture(shown.html("motion", f"{e.arm.name} moving along its path"), "The arm on its path (orange).")
    return [("The motion", [picture])]
