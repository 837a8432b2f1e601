"""Every task, and the joints that it cannot lose."""

from __future__ import annotations

from markupsafe import Markup

from holdfast.present.assessment.facts import Facts
from holdfast.report.page import Block, Table, Text

TITLE = "Single points of failure by structure"


def blocks(f: Facts) -> list[Block]:
    """Every task and the joints it cannot lose."""
    own, everything = f.structures
    names = f.a.arm.joint_names
    rows: list[list[str | Markup]] = []
    for s in everything:
        cells: list[str | Markup] = [Markup("{} {}").format(s.task, "(this run)") if s is own else s.task, str(s.redundancy)]
        for k in range(len(names)):
            bad = k in s.fatal or s.never
            cells.append(Markup('<span class="fatal">fatal</span>') if bad else Markup('<span class="ok">–</span>'))
        verdict = (
            "never possible"
            if s.never
            else "not redundant"
            if s.redundancy <= 0
            else "single point of failure"
            if s.fatal
            else "none"
        )
        rows.append([*cells, verdict])
    head = ["Task", "Redundancy", *[str(k + 1) for k in range(len(names))], "Single point of failure"]
    joints = "; ".join(f"{k + 1} {n}" for k, n in enumerate(names))
    return [
        Text(
            "A joint is fatal if the task is singular in every configuration once it locks: no choice of configuration helps."
        ),
        Table(rows, head, frozenset({1}), marks=frozenset(range(2, len(names) + 2)), wide=True, sortable=False),
        Text(f"Joints: {joints}. Redundancy: joints minus rows of the task.", quiet=True),
    ]
