"""Notebook view of a control law."""

from __future__ import annotations

from holdfast.control.laws.law import Law
from holdfast.interface.presentation.presentation import Fact, Presentation


def present(law: Law) -> Presentation:
    """Present the law with its arm, task, gain, speed limit, and source."""
    return Presentation(
        law.name,
        law.describe(),
        facts=[
            Fact("arm", law.arm.title),
            Fact("task", law.task.describe()),
            Fact("label", law.label),
            Fact("gain", f"{law.gain:g}/s"),
            Fact("speed limit", "none" if law.speed_limit is None else f"{law.speed_limit:g} m/s"),
            Fact("source", law.source or "not given"),
        ],
    )
