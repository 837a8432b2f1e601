"""Coefficients of the Runge-Kutta methods."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

Weights = tuple[float, ...]


@dataclass(frozen=True)
class Tableau:
    """Runge-Kutta method whose last stage is the new state, so that its derivative also serves the next step."""

    name: str  # name in texts
    rows: tuple[Weights, ...]  # row i contains the weights of the derivatives before stage i + 1; the last row is the step
    longest_step: float  # longest step, 1/Ke, well within the stability limit for the decay rate Ke of the error
    # Weights of the error estimates of orders 5 and 3, which the method combines into one of order 7; None for a fixed step.
    errors: tuple[Weights, Weights] | None = None
    # Weights of all derivatives, including the last one, for the displacement and the derivative at the middle of a step.
    middle: tuple[Weights, Weights] | None = None


def _read_weights(file: str) -> dict[str, Any]:
    """Return the weights ``rows``, ``errors`` and ``middle`` from a JSON file of this folder."""
    weights = json.loads(Path(__file__).with_name(file).read_text(encoding="utf-8"))
    return {key: tuple(map(tuple, rows)) for key, rows in weights.items()}


# Hairer, Norsett, Wanner 1993, section II.5 and their program DOP853 (Prince and Dormand's order 8, 12 stages). The middle is
# ours: the least weights that satisfy the conditions of order 6 (trees of up to six nodes) for half a step.
DOP853 = Tableau("DOP853", longest_step=3.0, **_read_weights("dop853.json"))
CLASSIC_RK4 = Tableau("Runge-Kutta 4", ((1 / 2,), (0.0, 1 / 2), (0.0, 0.0, 1.0), (1 / 6, 1 / 3, 1 / 3, 1 / 6)), 2.5)
