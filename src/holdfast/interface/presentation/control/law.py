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


def next_steps(law: Law, name: str) -> list[str]:
    """Suggest a convergence map with a joint locked, and the C code of the law."""
    return [
        f"hf.convergence_map({name}, 5, 4, configurations=1)  # how often it reaches its target after a lock",
        f'{name}.export_c("controller")  # for the robot\'s own controller',
    ]
