"""What is left of the region once a joint has locked."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.assessment.plan import LOCK_RESTARTS
from holdfast.clearance.exact.sharper import Sharper
from holdfast.present.assessment.facts import Facts
from holdfast.report import figures, maps
from holdfast.report.page import Block, Picture, Table, Text
from holdfast.report.views import View, sides
from holdfast.words import as_given, fixed, interval, percent

TITLE = "What survives a locked joint"
Array = NDArray[np.float64]

_LEAST_FOR_MAP = 200


def blocks(f: Facts) -> list[Block]:
    """Fraction of the region that each lock leaves, if the run asked for it."""
    survivors = f.a.survivors
    if survivors is None or not f.d.samples:
        return []
    shares, locks = f.a.survival(), f.a.plan.locks
    worst = min(shares, key=lambda name: shares[name].value)
    rules = {f.a.arm.joint_names[k]: _rule(f, k, angle) for k, angle in locks.items()}
    names = [
        f"{k + 1} {f.a.arm.joint_names[k]}{'' if angle is None else f' {_angle(f, k, angle)}'}" for k, angle in locks.items()
    ]
    what = f"{'weight of ' if f.d.weighted else ''}poses still reached once the joint has locked"
    figure = figures.bar_figure(names, survivors[list(locks)].tolist(), what, total=_whole(f), stress="least")
    given = [angle is not None for angle in locks.values()]
    where = "where it was at another pose of the region, drawn at random"
    if all(given):
        where = "at the angle that was given"
    elif any(given):
        where = f"at the angle that was given for it, else {where}"
    blocks: list[Block] = [
        Text(
            f"Healthy, the arm reaches {percent(1 - f.d.unreached_share)} of {'the weight of ' if f.d.weighted else ''}the "
            f"{f.d.samples:,} poses{_clear(f)}. The lock that costs most is that of {worst}, {rules[worst]}: "
            f"{interval(shares[worst])} of the poses are left."
        ),
        Picture(
            figures.svg(figure, "survival", "Poses still reached once each joint has locked"),
            f"Each joint is locked {where}. A pose counts as left if one of {LOCK_RESTARTS} starts reaches it with that joint "
            f"held there{_and_clear(f)}; so the fractions are lower bounds.",
        ),
    ]
    blocks += _before_and_after(f, f.a.arm.joint_index(worst), rules[worst])
    blocks.append(
        Table(
            [[name, rules[name], interval(share)] for name, share in shares.items()],
            ["Once it has locked", "where", "fraction of the poses still reached"],
            frozenset({2}),
        )
    )
    return blocks


def _clear(f: Facts) -> str:
    """The same where only configurations clear of the cell count, if there is one."""
    return "" if f.a.clear is None else f" and at least {interval(f.a.reached_clear())} of all clear of {f.everything}"


def _and_clear(f: Facts) -> str:
    clearance = f.a.plan.clearance
    if f.a.clear is None or clearance is None:
        return ""
    known = f"exact where small, {clearance.exact_by}" if isinstance(clearance, Sharper) else "lower bounds"
    return f", clear of {f.everything} (distances: {known})"


def _whole(f: Facts) -> float:
    return f.d.total_weight() if f.d.weighted else f.d.samples


def _angle(f: Facts, joint: int, angle: float) -> str:
    """In degrees, or metres."""
    return f"at {as_given(angle)} m" if f.a.arm.prismatic[joint] else f"at {fixed(np.rad2deg(angle), 1)} deg"


def _rule(f: Facts, joint: int, angle: float | None) -> str:
    """Where the joint is locked."""
    if angle is None:
        return "where it was at another pose"
    return _angle(f, joint, angle) + ("" if f.a.arm.prismatic[joint] else f" ({as_given(angle)} rad)")


def _before_and_after(f: Facts, joint: int, rule: str) -> list[Block]:
    """Where the healthy arm reaches, and where it still does after the lock that costs most."""
    rows = f.rows
    if rows is None or len(rows.reached) < _LEAST_FOR_MAP:
        return []
    views = sides(rows.position, ("seen from the side", "seen from above"))
    if not views:
        return []
    view = views[0]
    left = f.a.columns["survives"][:][rows.number, joint] == 1
    healthy = rows.reached if f.a.clear is None else f.a.columns["clear"][:][rows.number] == 1
    name = f.a.arm.joint_names[joint]
    figure = before_and_after_figure(rows.position, healthy, left, view, f"{name} locked", rows.weight)
    total = len(left)
    text = (
        f"Fraction of the poses in each cell that are reached, over the whole depth of the region {view.title}, and below it "
        f"how many poses the cell holds. Left: the healthy arm reaches {int(healthy.sum()):,} of {total:,} poses"
        f"{_and_clear(f)}. Right: with {name} locked {rule}, {int(left.sum()):,} of {total:,}."
    )
    if f.d.weighted:
        text += " Fractions count by weight, these numbers do not."
    return [Picture(figures.svg(figure, "survival-map", f"Where poses are reached before and after {name} locks"), text)]


def before_and_after_figure(
    position: Array, healthy: NDArray[np.bool_], locked: NDArray[np.bool_], view: View, after: str, weights: Array | None = None
) -> Figure:
    """Maps of the fraction of poses (N, 3), m, reached (N,) before and after a failure, by weight (N,) if there is one."""
    panels = [("Healthy", healthy), (figures.plain(after, 37), locked)]
    return maps.share_figure(position, panels, view, label="fraction of the poses reached", weights=weights)
