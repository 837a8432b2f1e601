"""Array types and type variables that the whole package uses in annotations."""

from __future__ import annotations

from typing import Any, ParamSpec, TypeVar

import numpy as np
from numpy.typing import NDArray

P = ParamSpec("P")
T = TypeVar("T")
FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IndexArray = NDArray[np.int64]
Rows = dict[str, NDArray[Any]]
"""Values of the rows of a table by the names of its columns."""
