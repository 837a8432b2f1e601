"""What one configuration is worth after a failure: locked-joint indices and free-swinging susceptibilities, with gradients.

Free-swinging joints are in :mod:`holdfast.indices.susceptibility`. Every constructor of an index takes
``(arm, task="pose", failures="single", length=None)``, and what it needs besides, and returns an :class:`Index`.
"""

from holdfast.indices import susceptibility
from holdfast.indices.custom import CustomIndex, FormulaIndex
from holdfast.indices.index import SINGULAR_RATIO, Evaluation, Index, WorstCase, by_name
from holdfast.indices.objective import Objective, Opposite, Part, WeightedSum
from holdfast.indices.relative import Manipulability, RelativeManipulability, manipulability, relative_manipulability
from holdfast.indices.spectral import (
    SpectralIndex,
    condition_number,
    geometric_mean_singular_value,
    mean_singular_value,
    minimum_singular_value,
)
from holdfast.indices.velocity import DirectionalVelocity, directional_velocity

__all__ = [
    "SINGULAR_RATIO",
    "CustomIndex",
    "DirectionalVelocity",
    "Evaluation",
    "FormulaIndex",
    "Index",
    "Manipulability",
    "Objective",
    "Opposite",
    "Part",
    "RelativeManipulability",
    "SpectralIndex",
    "WeightedSum",
    "WorstCase",
    "by_name",
    "condition_number",
    "directional_velocity",
    "geometric_mean_singular_value",
    "manipulability",
    "mean_singular_value",
    "minimum_singular_value",
    "relative_manipulability",
    "susceptibility",
]
