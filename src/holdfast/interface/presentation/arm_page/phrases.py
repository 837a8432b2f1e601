"""Texts and numbers of the page of an arm as ``page/src/arm_page/phrases.ts`` writes them."""

from __future__ import annotations

import re
from functools import cache

import yaml

from holdfast.interface.report.viewer import read_template
from holdfast.model.arm.model import Arm


@cache
def read_texts() -> dict[str, str]:
    """Return the texts of the page by key, from ``arm_page.yaml``."""
    texts: dict[str, str] = yaml.safe_load(read_template("arm_page.yaml"))
    return texts


def format_percent(fraction: float) -> str:
    """Return a fraction as a percentage with one decimal place below 10 %."""
    percent = 100 * fraction
    if percent >= 9.95:
        return f"{percent:.0f}\N{NO-BREAK SPACE}%"
    if percent >= 0.05:
        return f"{percent:.1f}\N{NO-BREAK SPACE}%"
    return "< 0.1 %".replace(" ", "\N{NO-BREAK SPACE}") if percent > 1e-7 else "0\N{NO-BREAK SPACE}%"


def label_joints(arm: Arm) -> list[str]:
    """Return how a sentence names each joint: "joint 4" if the names end with the number, otherwise the name itself."""
    numbered = all(re.search(rf"(^|\D){k + 1}$", name) for k, name in enumerate(arm.joint_names))
    return [f"joint {k + 1}" for k in range(arm.n)] if numbered else list(arm.joint_names)
