"""Every task, and the joints that it cannot lose."""

from __future__ import annotations

from markupsafe import Markup

from holdfast.present.assessment.facts import Facts
from holdfast.report.page import Block, Table, Text
from holdfast.words import number

TITLE = "Single points of failure by structure"


def blocks(f: Facts) -> list[Block]:
    """Every task and the joints it cannot lose."""
    own, everything = f.structures
    names = f.a.arm.joint_names
    rows: list[list[str | Markup]] = []
    for s in everything:
        cells: list[str | Markup] = [Markup("{} {}").format(s.task, "(this run)") if s is own else s.task, str(s.redundancy)]
        little = dict(s.nearly)
        for k in range(len(names)):
            bad = k in s.fatal or s.never
            said = Markup('<span class="fatal">fatal</span>') if bad else Markup('<span class="ok">–</span>')
            cells.append(Markup('<span class="fatal">≤ {}</span>').format(number(little[k])) if k in little else said)
        verdict = (
            "never possible"
            if s.never
            else "not redundant"
            if s.redundancy <= 0
            else "single point of failure"
            if s.fatal
            else "all but one"
            if s.nearly
            else "none"
        )
        rows.append([*cells, verdict])
    head = ["Task", "Redundancy", *[str(k + 1) for k in range(len(names))], "Single point of failure"]
    joints = "; ".join(f"{k + 1} {n}" for k, n in enumerate(names))
    return [
        Text(
            "A joint is fatal if the task is singular in every configuration once it locks: no choice of configuration helps. "
            "A number is the most of the manipulability that the lock was found to leave, where that is next to nothing."
        ),
        Table(rows, head, frozenset({1}), marks=frozenset(range(2, len(names) + 2)), wide=True, sortable=False),
        Text(f"Joints: {joints}. Redundancy: joints minus rows of the task.", quiet=True),
    ]
