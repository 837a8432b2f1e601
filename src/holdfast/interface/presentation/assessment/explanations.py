"""One-line explanations of the indices, which state the values that are good."""

from __future__ import annotations

from holdfast.kinematics.indices.index import Index

_ZERO_EXPLANATION = "0 means that some direction of the task is lost"
_INDEX_EXPLANATIONS = {
    "relative-manipulability": f"fraction of the manipulability that remains after the worst failure; 1 means no loss, "
    f"{_ZERO_EXPLANATION}",
    "manipulability": f"volume of tool velocities at joint rates of norm 1 after the worst failure; {_ZERO_EXPLANATION}",
    "ceiling-fraction": f"relative manipulability after the worst failure as a fraction of the best known value for this "
    f"number of joints; 1 means as good as the best known arm, {_ZERO_EXPLANATION}",
    "mean-singular-value": "mean tool speed over the directions of the task at joint rates of norm 1 after the worst failure",
    "geometric-mean-singular-value": "geometric mean of the tool speeds over the directions of the task at joint rates "
    f"of norm 1 after the worst failure; {_ZERO_EXPLANATION}",
    "minimum-singular-value": f"tool speed in the slowest direction at joint rates of norm 1 after the worst failure; "
    f"{_ZERO_EXPLANATION}",
    "condition-number": "tool speed in the fastest direction over that in the slowest one after the worst failure; 1 is best, "
    "and infinite means that some direction of the task is lost",
    "directional-velocity": "largest tool speed in that direction at joint rates of norm 1 after the worst failure; 0 means "
    "that the direction is lost",
}


def explain_index(index: Index) -> str:
    """Explain which values of an index are good; empty for a custom index."""
    return _INDEX_EXPLANATIONS.get(index.label.partition(":")[0], "")
