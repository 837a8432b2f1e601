"""Clearance along a motion: limits of the joint rates at every step, and the nearest pair along the whole motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import FloatArray, IndexArray
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.objects.one_row import SingleConfigurationClearance

ENFORCED_LIMITS = 2  # limits that a step respects: the nearest pair now, and one from a moment ago
_NO_LIMIT_RATE = -1e9  # m/s: less than any rate changes a distance
_GRADIENT_RANGE = 0.05  # rad and m: distance within which a slope is assumed to hold
_SIMILARITY_FRACTION = 0.05  # of a slope: closer slopes belong to the same object
_MEMORY_SIZE = 6  # number of stored slopes
_DISTANCE_SLACK_M = 2e-5  # m: a step along a round object errs by its square, and the next step corrects this
_STEP_FRACTIONS = (1.0, 0.5)  # fractions of a step that are tried before a stop


@dataclass(frozen=True, eq=False)
class ClearanceHistory:
    """Distances of a motion to obstacles and links at N instants.

    Attributes:
        margin: (N,) smallest distance beyond the required distance, m.
        nearest_pair: (N,) position in ``pair_names`` of the pair with this distance.
        pair_names: Names of the pairs, ``joint3 & table``.
        min_distances: (P,) required distance of each pair, m.
    """

    margin: FloatArray
    nearest_pair: IndexArray
    pair_names: list[str]
    min_distances: FloatArray


class ClearanceRateLimit:
    """Clearance of a motion above the required margin, and the rate at which it may shrink.

    Only one pair is the nearest, and its slope jumps when another pair becomes the nearest. In a corner the motion would
    oscillate between the two. Therefore the slopes of the last moments are stored, and each is a limit as long as the arm is
    nearby.

    Args:
        clearance: Clearance model of the arm.
        margin: Required distance in addition to the model's own margins, m.
        rate: Fraction of the remaining distance by which it may shrink in a second, 1/s.
    """

    def __init__(self, clearance: Clearance, margin: float, rate: float) -> None:
        self.clearance, self.margin, self.rate = clearance, margin, rate
        self._nearest = SingleConfigurationClearance(clearance)
        self._gradient_bounds = clearance.lipschitz_bounds(*sampling_limits(clearance.arm)).max(axis=0, initial=0.0)
        self._samples: list[tuple[FloatArray, float, FloatArray]] = []

    def _clearance_and_gradient(self, q: FloatArray) -> tuple[FloatArray, float, FloatArray]:
        """Return the configuration (n,), its clearance and the gradient (n,), and store them, the latest first."""
        if self._samples and np.array_equal(self._samples[0][0], q):
            return self._samples[0]
        clearance, gradient = self._nearest(q)
        sample = (q.copy(), clearance - self.margin, gradient)
        nearby = [other for other in self._samples if np.abs(other[0] - q).max() < _GRADIENT_RANGE]
        others = [other for other in nearby if not _are_similar(other[2], sample[2])]
        self._samples = [sample, *others[: _MEMORY_SIZE - 1]]
        return sample

    def is_inactive(self, q: FloatArray, rates: FloatArray) -> bool:
        """Return True if no stored pair can be near enough to limit the rates (n,), so that no distance is computed."""
        if not self._samples:
            return False
        sample_q, clearance, _ = self._samples[0]
        smallest_clearance = clearance - float(self._gradient_bounds @ np.abs(q - sample_q))
        return float(self._gradient_bounds @ np.abs(rates)) < self.rate * smallest_clearance

    def rate_limits(self, q: FloatArray) -> FloatArray:
        """Return limits (K, n + 1) at a configuration (n,): gradients, each with the least product with the rates, m/s.

        The first limit is the nearest pair, and the second is the nearest of the pairs of a moment ago. At least one belongs to
        an object; gradients of 0 limit nothing.
        """
        latest = self._clearance_and_gradient(q)
        around = sorted(
            ((clearance + float(gradient @ (q - sample_q)), gradient) for sample_q, clearance, gradient in self._samples[1:]),
            key=lambda entry: entry[0],
        )
        entries = [(latest[1], latest[2]), *around, (np.inf, np.zeros(len(q)))]
        return np.array([np.append(gradient, max(-self.rate * clearance, _NO_LIMIT_RATE)) for clearance, gradient in entries])

    def allowed_fraction(self, q: FloatArray, step_end: FloatArray) -> float:
        """Return the fraction of a step between configurations (n,) that the clearance allows: 1 unless it is used up."""
        step_start = self._clearance_and_gradient(q)
        for fraction in _STEP_FRACTIONS:
            if self._clearance_and_gradient(q + fraction * (step_end - q))[1] >= min(step_start[1], -_DISTANCE_SLACK_M):
                return fraction
        self._samples = [step_start, *self._samples[: _MEMORY_SIZE - 1]]
        return 0.0

    def trace_clearance(self, q: FloatArray) -> ClearanceHistory:
        """Return the nearest pairs at configurations (N, n)."""
        clearance = self.clearance
        return ClearanceHistory(
            clearance.margin_left(q) - self.margin,
            clearance.closest_pair(q),
            clearance.pair_names,
            clearance.margins + self.margin,
        )


def _are_similar(gradient: FloatArray, reference: FloatArray) -> bool:
    return float(np.linalg.norm(gradient - reference)) <= _SIMILARITY_FRACTION * float(np.linalg.norm(reference))
