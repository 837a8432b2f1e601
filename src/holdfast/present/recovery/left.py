"""What is left of the workspace: numbers, and maps."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from holdfast.present.printing import Rows

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.recovery.remainder import WhatIsLeft


def to_dict(left: WhatIsLeft) -> dict[str, Any]:
    """How many targets were reached before, and how many still are."""
    fractions = {
        "fraction_left": left.left,
        "fraction_of_region": left.of_region,
        "healthy_fraction_of_region": left.healthy_of_region,
    }
    return {
        "what": left.region,
        "rows": left.rows,
        "targets": len(left.healthy),
        "reached_healthy": left.healthy.sum(),
        "still_reached": left.locked.sum(),
        **{name: None if found is None else asdict(found) for name, found in fractions.items()},
        "starts": left.starts,
    }


def key_table(left: WhatIsLeft) -> Rows:
    """How many targets were reached before, and how many still are."""
    told = [["targets", f"{len(left.healthy):,}"], ["the healthy arm reaches", f"{int(left.healthy.sum()):,}"]]
    return Rows(["", ""], [*told, ["the failed arm still reaches", f"{int(left.locked.sum()):,}"]])


def next_steps(left: WhatIsLeft, name: str) -> list[str]:
    """The whole report."""
    del left
    return [f'{name}.report("left.html")']


def figures(left: WhatIsLeft) -> dict[str, Figure]:
    """Maps of the fraction of targets that the healthy and the failed arm reach; none where the healthy arm reaches none."""
    from holdfast.present.assessment.sections.survival import before_and_after_figure
    from holdfast.report.views import SIDE, sides

    if not left.healthy.any():
        return {}
    view = (sides(left.position) or [SIDE])[0]
    return {"left": before_and_after_figure(left.position, left.healthy, left.locked, view, ", ".join(left.joints))}
