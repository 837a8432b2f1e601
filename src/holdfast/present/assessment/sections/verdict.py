"""Single points of failure by structure, said at once."""

from __future__ import annotations

from holdfast.assessment.single_points import explain
from holdfast.present.assessment.facts import Facts
from holdfast.report.page import Block, Callout

TITLE = ""


def blocks(f: Facts) -> list[Block]:
    """Single points of failure by structure, said at once."""
    own, everything = f.structures
    text = explain(f.a.arm, own, everything)
    fatal = not own.survives
    title = "A single locked joint ends this task everywhere" if fatal else ""
    if own.never:
        title = "The task is impossible for this arm"
    return [Callout(text, "bad" if fatal else "good", title)]
