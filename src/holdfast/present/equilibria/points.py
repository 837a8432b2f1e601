"""Stationary points in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.equilibria.points import StationaryPoints
from holdfast.equilibria.stability import REACHED
from holdfast.present.printing import Rows, number, print_rows

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.control.law import Law

SHOWN = 12  # points of a kind on the console
MANY = 3  # eigenvalues: of more only the ends of their range


def to_dict(points: StationaryPoints) -> dict[str, Any]:
    """All points by what they are; eigenvalues in units of the gain Ke."""
    arm = points.law.arm
    return {
        **arm.entry(),
        "law": points.law.slug,
        "task": points.law.task.name,
        "locked": {arm.joint_names[k]: x for k, x in zip(points.locked, points.at, strict=True)},
        "starts": points.starts,
        "points": [
            {
                "kind": points.kinds[k],
                "q": dict(zip(arm.joint_names, points.q[k], strict=True)),
                "error": points.error[k],
                "eigenvalues": points.eigenvalues[k],
                "continuum": points.continuum[k],
                "attracting": points.attracting[k],
                "within_limits": points.within_limits[k],
            }
            for k in range(len(points))
        ],
    }


def tables(points: StationaryPoints) -> list[Rows]:
    """A row for each point; joints in degrees or m."""
    joints = points.law.arm.joints
    head = ["kind", *(f"{j.name}, {j.shown[1]}" for j in joints), error_head(points.law), "eigenvalues, Ke", ""]
    rows = []
    attracting = points.attracting
    for k, kind in enumerate(points.kinds):
        loose = points.continuum[k]
        notes = ["one of many"] if loose else []
        notes += ["attracting"] if loose and points.error[k] > REACHED and attracting[k] else []
        notes += [] if points.within_limits[k] else ["beyond limits"]
        values = [f"{j.shown[0] * x:.4f}" for j, x in zip(joints, points.q[k], strict=True)]
        rows.append([kind, *values, number(points.error[k]), _spread(points.eigenvalues[k]), ", ".join(notes)])
    return [Rows(head, rows)]


def next_steps(points: StationaryPoints, name: str) -> list[str]:
    """Which starts end at them."""
    locked = dict(zip(points.locked, points.at.tolist(), strict=True))
    return [f"hf.basins({name}.law, {name}.target, {locked!r}, starts=64).plot()  # which starts end at which point"]


def show(points: StationaryPoints, out: Console) -> None:
    """The sentences, and the first points of each kind."""
    for line in points.describe():
        out.print(line, markup=False, soft_wrap=True)
    (table,) = tables(points)
    kind = points.kind
    shown = [row for k, row in enumerate(table.rows) if (kind[:k] == kind[k]).sum() < SHOWN]
    print_rows(out, table._replace(rows=shown))
    if len(shown) < len(points):
        out.print(f"and {len(points) - len(shown)} more; --json has all", soft_wrap=True)


def error_head(law: Law) -> str:
    """What the norm of the task's error is, with its unit."""
    return "error, m and rad" if law.task.angular else "error, m"


def _spread(values: Any) -> str:
    """Eigenvalues, or of many the ends of their range."""
    few = values if len(values) <= MANY else values[[0, -1]]
    return (", " if len(values) <= MANY else " to ").join(map(_complex, few))


def _complex(value: np.complex128) -> str:
    return number(value.real) if abs(value.imag) < 1e-9 else f"{number(value.real)}{value.imag:+.3g}i"
