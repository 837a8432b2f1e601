"""Notebook view of a control law."""

from __future__ import annotations

from holdfast.control.laws.law import Law
from holdfast.interface.presentation.printing import TextTable


def key_table(law: Law) -> TextTable:
    """Tabulate the law with its arm, task, gain, speed limit, and source."""
    limit = "none" if law.speed_limit is None else f"{law.speed_limit:g} m/s"
    rows = [
        ["arm", law.arm.title],
        ["task", law.task.describe()],
        ["label", law.label],
        ["gain", f"{law.gain:g}/s"],
        ["speed limit", limit],
        ["source", law.source or "not given"],
    ]
    return TextTable(["", ""], rows)
