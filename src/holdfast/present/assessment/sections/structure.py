"""Every task, and the joints that it cannot lose."""

from __future__ import annotations

from markupsafe import Markup

from holdfast.present.assessment.facts import Facts
from holdfast.report.page import Block, Table, Text
from holdfast.words import number, percent

TITLE = "Single points of failure by structure"


def blocks(f: Facts) -> list[Block]:
    """Every task and the joints it cannot lose."""
    own, everything = f.structures
    names = f.a.arm.joint_names
    rows: list[list[str | Markup]] = []
    for s in everything:
        cells: list[str | Markup] = [Markup("{} {}").format(s.task, "(this run)") if s is own else s.task, str(s.redundancy)]
        little = dict(s.nearly)
        weak = {w.joint: w for w in s.weak}
        for k in range(len(names)):
            bad = k in s.fatal or s.never
            said = Markup('<span class="fatal">fatal</span>') if bad else Markup('<span class="ok">–</span>')
            if k in little:
                said = Markup('<span class="fatal">≤ {}</span>').format(number(little[k]))
            elif k in weak:
                said = Markup('<span class="weak">≤ {}</span>').format(percent(weak[k].manipulability_left))
            cells.append(said)
        verdict = (
            "never possible"
            if s.never
            else "not redundant"
            if s.redundancy <= 0
            else "single point of failure"
            if s.fatal
            else "all but one"
            if s.nearly
            else "nearly"
            if s.weak
            else "none"
        )
        rows.append([*cells, verdict])
    head = ["Task", "Redundancy", *[str(k + 1) for k in range(len(names))], "Single point of failure"]
    joints = "; ".join(f"{k + 1} {n}" for k, n in enumerate(names))
    return [
        Text(
            "A joint is fatal if the task is singular in every configuration once it locks: no choice of configuration helps. "
            "A number is the largest relative manipulability found after the lock, where that is next to nothing. A percentage "
            "is the largest manipulability found after the lock, compared with the largest one of the healthy arm."
        ),
        Table(rows, head, frozenset({1}), marks=frozenset(range(2, len(names) + 2)), wide=True, sortable=False),
        Text(f"Joints: {joints}. Redundancy: joints minus rows of the task.", quiet=True),
    ]
