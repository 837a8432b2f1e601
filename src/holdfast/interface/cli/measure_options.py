"""Options that name an index or an objective."""

from __future__ import annotations

from typing import Annotated

from holdfast.core.registry import INDEX_REGISTRY, OWN_INDEX, SUSCEPTIBILITY_REGISTRY

IndexOption = Annotated[str, f"Index: {INDEX_REGISTRY.usage}; {OWN_INDEX}. ceiling-fraction: share of the best known value."]
OBJECTIVES_HELP = (
    f"{', '.join(SUSCEPTIBILITY_REGISTRY)} (with optional weights: torque:effort, torque:worst-case, torque:0,1,0, or "
    f"torque:joint2 for a single joint; release:2,4 or tool-drop:2,4 for joints that fail together); or an index: "
    f"{', '.join(e.usage for e in INDEX_REGISTRY.values())}; {OWN_INDEX}"
)
MinimiseOption = Annotated[
    str | None, f"Objective to minimise: {OBJECTIVES_HELP}; or a sum such as '0.5*torque:effort + 0.1*acceleration'."
]
MaximiseOption = Annotated[
    str | None, "Objective to maximise, as for --minimise. Maximising a torque or minimising an index gives the worst case."
]
