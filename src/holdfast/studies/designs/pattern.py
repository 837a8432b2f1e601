"""Search for a design by a measure that is not smooth, with Sobol screening, designs of equal lengths, and pattern search."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.studies.designs.space import DesignSpace

MeasureFunction = Callable[[FloatArray], dict[str, FloatArray]]

# First and last step of the pattern search, as fractions of the width of the bounds.
_FIRST_STEP = 1 / 8
_LAST_STEP = 1 / 128
_BOUND_TOLERANCE = 1e-9
_MAX_DRAW_FACTOR = 64  # largest ratio of sampled to requested designs with a fixed sum


@dataclass(frozen=True, eq=False)
class DesignBounds:
    """Bounds of the admissible designs and, optionally, a fixed sum of the lengths.

    Attributes:
        space: Parameters and their bounds.
        length_sum: Fixed sum of the lengths, m; None without one.
    """

    space: DesignSpace
    length_sum: float | None

    @classmethod
    def from_space(cls, space: DesignSpace, keep_reach: bool) -> DesignBounds:
        """Return the bounds of a space, with the sum of the lengths of the baseline arm if ``keep_reach`` is true.

        Raises:
            InputError: The sum cannot be kept.
        """
        bounds = cls(space, float(space.start.sum()) if keep_reach else None)
        if keep_reach and (bounds.is_length.sum() < 2 or not bounds.is_length.all()):
            raise InputError("keep_reach needs two or more varied link lengths, and nothing else varied")
        return bounds

    @property
    def size(self) -> int:
        """Number of parameters."""
        return len(self.space.parameters)

    @property
    def is_length(self) -> NDArray[np.bool_]:
        """(k,) True for parameters that are link lengths."""
        return np.array([parameter.kind == "a" for parameter in self.space.parameters])

    def contains(self, values: FloatArray) -> NDArray[np.bool_]:
        """Return a mask (N,) of the designs (N, k) within the bounds."""
        return np.asarray(
            ((values >= self.space.lower - _BOUND_TOLERANCE) & (values <= self.space.upper + _BOUND_TOLERANCE)).all(axis=1)
        )

    def sample_designs(self, count: int, seed: int) -> FloatArray:
        """Return designs (count, k) of a scrambled Sobol sequence; with a fixed sum the last length follows from the others."""
        from scipy.stats import qmc

        if self.length_sum is None:
            return self.space.draw(count, seed)
        lower, width = self.space.lower[:-1], (self.space.upper - self.space.lower)[:-1]
        engine = qmc.Sobol(self.size - 1, rng=np.random.default_rng(seed))
        designs = np.empty((0, self.size))
        for _ in range(_MAX_DRAW_FACTOR):
            values = lower + engine.random(1 << (max(count, 2) - 1).bit_length()) * width
            values = np.column_stack([values, self.length_sum - values.sum(axis=1)])
            designs = np.concatenate([designs, values[self.contains(values)]])[:count]
            if len(designs) == count:
                break
        return designs

    def equalise_lengths(self, values: FloatArray) -> FloatArray:
        """Return the designs (M, k) within the bounds in which two lengths of designs (N, k) are replaced by their mean."""
        equalised = [np.empty((0, self.size))]
        for i, j in combinations(np.flatnonzero(self.is_length).tolist(), 2):
            changed = values.copy()
            changed[:, [i, j]] = values[:, [i, j]].mean(axis=1, keepdims=True)
            equalised.append(changed)
        designs = np.concatenate(equalised)
        return designs[self.contains(designs)]

    def list_directions(self) -> FloatArray:
        """Return the directions (M, k) of the pattern search: one number up or down, or two in equal or opposite directions."""
        dimension = self.size
        directions = [] if self.length_sum is not None else [sign * unit for unit in np.eye(dimension) for sign in (1, -1)]
        for i, j in combinations(range(dimension), 2):
            for a, b in ((1, -1), (-1, 1)) if self.length_sum is not None else ((1, -1), (-1, 1), (1, 1), (-1, -1)):
                direction = np.zeros(dimension)
                direction[i], direction[j] = a, b
                directions.append(direction)
        if self.length_sum is not None:
            # Two equal lengths stay equal, and the third compensates.
            for i, j in combinations(range(dimension), 2):
                for third in set(range(dimension)) - {i, j}:
                    direction = np.zeros(dimension)
                    direction[[i, j]], direction[third] = 0.5, -1.0
                    directions += [direction, -direction]
        return np.array(directions)


def search_patterns(
    bounds: DesignBounds,
    measure: MeasureFunction,
    priorities: Sequence[str],
    designs: int,
    local_searches: int,
    seed: int,
    progress: Callable[[int, int], None] | None = None,
) -> tuple[FloatArray, dict[str, FloatArray]]:
    """Screen designs, then improve the best of them by pattern search.

    Args:
        bounds: Bounds of the designs.
        measure: Function from designs (N, k) to measures (N,) by name, which are better when larger.
        priorities: Names of measures; the first decides, the next ones decide between equals.
        designs: Number of designs in the screening.
        local_searches: Number of designs to improve.
        seed: Seed of the screening.
        progress: Function that is called with (designs done, designs expected in all).

    Returns:
        All evaluated designs, the baseline arm first, and their measures.
    """
    sampled = bounds.sample_designs(designs, seed)
    values = np.concatenate([bounds.space.start[None], sampled, bounds.equalise_lengths(sampled)])
    expected = len(values) + local_searches * len(bounds.list_directions()) * 6
    measures = measure(values)
    if progress is not None:
        progress(len(values), max(expected, len(values)))

    def score_design(number: int) -> tuple[float, ...]:
        return tuple(round(float(measures[name][number]), 4 if name != priorities[-1] else 9) for name in priorities)

    leaders = sorted(range(len(values)), key=score_design, reverse=True)[: max(local_searches, 0)]
    for leader in leaders:
        current, step_size = leader, _FIRST_STEP
        while step_size >= _LAST_STEP:
            # Lengths have equal steps, so that their sum is kept; other numbers have steps in proportion to their bounds.
            width = bounds.space.upper - bounds.space.lower
            width = np.where(bounds.is_length, width[bounds.is_length].min(initial=np.inf), width)
            trials = values[current] + step_size * width * bounds.list_directions()
            trials = np.concatenate([trials, bounds.equalise_lengths(values[[current]])])
            trials = trials[bounds.contains(trials)]
            if not len(trials):
                step_size /= 2
                continue
            trial_measures = measure(trials)
            first_trial = len(values)
            values = np.concatenate([values, trials])
            measures = {name: np.concatenate([measures[name], trial_measures[name]]) for name in measures}
            best = max(range(first_trial, len(values)), key=score_design)
            if score_design(best) > score_design(current):
                current = best
            else:
                step_size /= 2
            if progress is not None:
                progress(len(values), max(expected, len(values)))
    return values, measures
