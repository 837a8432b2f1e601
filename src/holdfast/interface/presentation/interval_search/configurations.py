"""Presentation of all configurations of a pose."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.interface.presentation.presentation import Fact, Presentation, TableSpec
from holdfast.kinematics.interval_search.search import Configurations


def to_dict(configurations: Configurations) -> dict[str, Any]:
    """Return the finding, the configurations, and the search effort; rad and m."""
    names = ("pose", "lower", "upper", "q", "boxes", "open", "widest", "seconds")
    known = {
        "task": configurations.task.name,
        "finding": configurations.finding.name.lower(),
        "sentence": configurations.finding.sentence,
    }
    return {**configurations.arm.entry(), **known, **{name: getattr(configurations, name) for name in names}}


def present(configurations: Configurations) -> Presentation:
    """Present the number of configurations, whether these are all, and the search effort."""
    arm, found = configurations.arm, configurations
    joints = list(zip(arm.joint_names, arm.prismatic, strict=True))
    columns = ["", *[f"{name}, {'m' if slides else 'deg'}" for name, slides in joints]]
    rows = [(index, *q) for index, q in enumerate(np.where(arm.prismatic, found.q, np.rad2deg(found.q)).tolist(), 1)]
    open_phrase = f", {found.open:,} of them undecided and up to {2 * found.widest:.2g} wide" if found.open else ""
    blocked_phrase = f", {found.blocked:,} of them blocked and excluded" if found.blocked else ""
    return Presentation(
        f"All configurations of {arm.name} for one pose",
        f"{len(found.q)} configurations of '{arm.name}', task {found.task.name}: {found.finding.sentence}.",
        lines=[
            f"The search examined {found.boxes:,} boxes of joint values{blocked_phrase}{open_phrase}, in {found.seconds:.2g} s."
        ],
        facts=[] if rows else [Fact("finding", found.finding.sentence)],
        tables=[TableSpec("Configurations", columns, rows)] if rows else [],
        arm=arm,
    )
