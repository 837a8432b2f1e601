"""Options that name an index, or what a configuration is chosen by."""

from __future__ import annotations

from typing import Annotated

from holdfast.registry import INDICES, OWN_INDEX, SUSCEPTIBILITIES

IndexOption = Annotated[str, f"{INDICES.usage}; {OWN_INDEX}."]
OBJECTIVES = (
    f"{', '.join(SUSCEPTIBILITIES)} (each may take weights: torque:effort, torque:worst-case, torque:0,1,0, torque:joint2 for "
    f"one joint alone), or an index: {', '.join(e.usage for e in INDICES.values())}, {OWN_INDEX}"
)
