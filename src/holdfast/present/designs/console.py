"""Designs of an arm in numbers and words: those for an index, and those for convergence."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from holdfast.designs.convergence import ConvergenceDesigns
from holdfast.designs.designs import Checked, Designs, chosen, interval_text
from holdfast.designs.space import Parameter
from holdfast.present.printing import Rows
from holdfast.probability.intervals import Difference, Interval
from holdfast.words import percent

if TYPE_CHECKING:
    from rich.console import Console

_AT_BOUND = 1e-6  # of the width between the bounds


def at_bound(p: Parameter, value: float) -> str:
    """``lower`` or ``upper`` if a value is at that bound, else nothing."""
    slack = _AT_BOUND * (p.upper - p.lower)
    return "lower" if value <= p.lower + slack else "upper" if value >= p.upper - slack else ""


def to_dict(d: Designs | ConvergenceDesigns) -> dict[str, Any]:
    """The given arm and the best design, rad, m and fractions."""
    return _of_index(d) if isinstance(d, Designs) else _of_convergence(d)


def _of_index(d: Designs) -> dict[str, Any]:
    def arm(number: int, checked: Checked) -> dict[str, Any]:
        g = checked.guaranteed
        return {
            "values": dict(zip(d.space.names, d.values[number].tolist(), strict=True)),
            "guaranteed_in_search": float(d.guaranteed[number]),
            "guaranteed": {"value": g.value, "low": g.low, "high": g.high, "confidence": g.confidence},
            "median": float(checked.distribution.quantile(0.5, reachable_only=False)),
            "reached": 1 - checked.distribution.unreached_share,
            "reach": float(d.reach[number]),
        }

    return {
        **d.space.arm.entry(),
        "index": d.index.label,
        "task": d.index.task.name,
        "region": d.region.name,
        "level": d.level,
        "bound": d.index.bound,
        "poses": d.poses,
        "fresh_poses": d.checked.best.distribution.samples,
        "designs": len(d.values),
        "given": arm(0, d.checked.given),
        "best": arm(d.best, d.checked.best),
        "optimism": d.checked.optimism,
        "front": [
            {
                "reach": float(d.reach[k]),
                "guaranteed": float(d.guaranteed[k]),
                "values": dict(zip(d.space.names, d.values[k].tolist(), strict=True)),
            }
            for k in d.front.tolist()
        ],
        "seed": d.seed,
    }


def _of_convergence(d: ConvergenceDesigns) -> dict[str, Any]:
    def one(k: int) -> dict[str, Any]:
        values = dict(zip(d.space.names, d.values[k].tolist(), strict=True))
        return {"values": values, **{name: float(m[k]) for name, m in d.measures.items()}}

    out: dict[str, Any] = {
        **d.law.arm.entry(),
        "law": d.law.label,
        "task": d.law.task.name,
        "objective": d.objective,
        "exact": d.exact,
        "designs": len(d.values),
        "given": one(0),
        "best": one(d.best),
    }
    if d.checked is not None:
        given, best, apart = d.checked
        named: dict[str, Interval | Difference] = {"given": given, "best": best, "difference": apart}
        out["fresh"] = {n: {"value": x.value, "low": x.low, "high": x.high} for n, x in named.items()}
    return out


def key_table(d: Designs | ConvergenceDesigns) -> Rows:
    """The given arm and the best design, number by number, and what they are worth."""
    pairs = zip(d.space.parameters, d.space.start.tolist(), d.values[d.best].tolist(), strict=True)
    rows = [[p.name, p.text(before), p.text(after)] for p, before, after in pairs]
    if isinstance(d, Designs):
        given, best = (interval_text(x.guaranteed) for x in (d.checked.given, d.checked.best))
        rows += [
            [f"{d.index.name}, {chosen(d.level)} of poses", given, best],
            ["reach, m", f"{d.start_reach:.3f}", f"{d.reach[d.best]:.3f}"],
        ]
    else:
        rows += [[name, percent(float(m[0])), percent(float(m[d.best]))] for name, m in d.measures.items()]
    return Rows(["", "given arm", "best design"], rows)


def next_steps(d: Designs | ConvergenceDesigns, name: str) -> list[str]:
    """The best arm, and the whole report."""
    del d
    return [f"{name}.arm()  # the best one", f'{name}.report("designs.html")']


def show(d: Designs | ConvergenceDesigns, out: Console) -> None:
    """The answer, and the given arm and the best design number by number."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    lines = d.describe()
    last = lines.pop() if isinstance(d, Designs) else ""
    for line in lines:
        out.print(escape(line), soft_wrap=True)
    table = Grid("parameter", "given arm", "best design", "bounds")
    for p, before, after in zip(d.space.parameters, d.space.start.tolist(), d.values[d.best].tolist(), strict=True):
        side = at_bound(p, after) if isinstance(d, Designs) else ""
        mark = f" (at the {side} bound)" if side else ""
        table.add_row(p.name, p.text(before), p.text(after) + mark, f"{p.text(p.lower)} to {p.text(p.upper)}")
    out.print(table)
    if last:
        out.print(escape(last), soft_wrap=True)
