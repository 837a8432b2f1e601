"""A control law, as a notebook shows it."""

from __future__ import annotations

from holdfast.control.law import Law
from holdfast.present.printing import Rows


def key_table(law: Law) -> Rows:
    """What it commands, and where that is from."""
    limit = "none" if law.speed_limit is None else f"{law.speed_limit:g} m/s"
    rows = [
        ["arm", law.arm.title],
        ["task", law.task.describe()],
        ["label", law.label],
        ["gain", f"{law.gain:g}/s"],
        ["speed limit", limit],
        ["source", law.source or "not given"],
    ]
    return Rows(["", ""], rows)


def next_steps(law: Law, name: str) -> list[str]:
    """How often it reaches its target with a joint locked, and its C code."""
    return [
        f"hf.convergence_map({name}, 5, 4, configurations=1)  # how often it reaches its target after a lock",
        f'{name}.export_c("controller")  # for the robot\'s own controller',
    ]
