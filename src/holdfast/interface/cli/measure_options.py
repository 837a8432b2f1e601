"""Options that name an index or an objective."""

from __future__ import annotations

from typing import Annotated

from holdfast.core.registry import INDEX_REGISTRY, OWN_INDEX, SUSCEPTIBILITY_REGISTRY

IndexOption = Annotated[str, f"{INDEX_REGISTRY.usage}; {OWN_INDEX}."]
OBJECTIVES_HELP = (
    f"{', '.join(SUSCEPTIBILITY_REGISTRY)} (each may take weights: torque:effort, torque:worst-case, torque:0,1,0, "
    f"torque:joint2 for one joint alone), or an index: {', '.join(e.usage for e in INDEX_REGISTRY.values())}, {OWN_INDEX}"
)
