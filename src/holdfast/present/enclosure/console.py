"""All configurations of a pose, in numbers and words."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.enclosure.search import Configurations
from holdfast.present.printing import Rows, alike


def to_dict(found: Configurations) -> dict[str, Any]:
    """What is known, the configurations, and how much was looked at; rad and m."""
    names = ("pose", "lower", "upper", "q", "boxes", "open", "widest", "seconds")
    known = {"task": found.task.name, "finding": found.finding.name.lower(), "sentence": found.finding.sentence}
    return {**found.arm.entry(), **known, **{name: getattr(found, name) for name in names}}


def next_steps(found: Configurations, name: str) -> list[str]:
    """What it is drawn with."""
    return [f"{name}.arm.show({name}.q[0])"] if len(found.q) else [f"{name}.none  # True only if that is proved"]


def tables(found: Configurations) -> list[Rows]:
    """A row for each configuration."""
    prismatic = found.arm.prismatic
    head = ["", *(f"{name}, {'m' if slides else 'deg'}" for name, slides in zip(found.arm.joint_names, prismatic, strict=True))]
    shown = np.where(prismatic, found.q, np.rad2deg(found.q))
    return [Rows(head, [[str(k + 1), *alike(q)] for k, q in enumerate(shown)])] if len(shown) else []


def key_table(found: Configurations) -> Rows:
    """The configurations."""
    return (tables(found) or [Rows(["finding"], [[found.finding.sentence]])])[0]
