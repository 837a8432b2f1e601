"""Search for a design by a measure that is not smooth: Sobol screening, designs with equal lengths, pattern search."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from holdfast.designs.space import DesignSpace
from holdfast.errors import InputError

Array = NDArray[np.float64]
Measured = Callable[[Array], dict[str, Array]]

_FIRST, _LAST = 1 / 8, 1 / 128  # steps of the pattern search, of the width of the bounds
_SAME = 1e-9
_DRAWS = 64  # times as many drawn as wanted, at most, where the sum is kept


@dataclass(frozen=True, eq=False)
class Box:
    """The designs that are allowed.

    Attributes:
        space: Parameters and their bounds.
        total: Sum that lengths keep; None: none.
    """

    space: DesignSpace
    total: float | None

    @classmethod
    def read(cls, space: DesignSpace, keep_reach: bool) -> Box:
        """With the sum of the lengths of the given arm, if that is to be kept.

        Raises:
            InputError: A sum that cannot be kept.
        """
        box = cls(space, float(space.start.sum()) if keep_reach else None)
        if keep_reach and (box.lengths.sum() < 2 or not box.lengths.all()):
            raise InputError("keep_reach needs two or more varied link lengths, and nothing else varied")
        return box

    @property
    def size(self) -> int:
        """K."""
        return len(self.space.parameters)

    @property
    def lengths(self) -> NDArray[np.bool_]:
        """(k,) which parameters are link lengths."""
        return np.array([p.kind == "a" for p in self.space.parameters])

    def holds(self, values: Array) -> NDArray[np.bool_]:
        """(N,) whether designs (N, k) are within the bounds."""
        return np.asarray(((values >= self.space.lower - _SAME) & (values <= self.space.upper + _SAME)).all(axis=1))

    def draw(self, count: int, seed: int) -> Array:
        """(count, k) designs of a scrambled Sobol sequence; where a sum is kept, the last one follows from the others."""
        from scipy.stats import qmc

        if self.total is None:
            return self.space.draw(count, seed)
        low, width = self.space.lower[:-1], (self.space.upper - self.space.lower)[:-1]
        engine = qmc.Sobol(self.size - 1, rng=np.random.default_rng(seed))
        found = np.empty((0, self.size))
        for _ in range(_DRAWS):
            values = low + engine.random(1 << (max(count, 2) - 1).bit_length()) * width
            values = np.column_stack([values, self.total - values.sum(axis=1)])
            found = np.concatenate([found, values[self.holds(values)]])[:count]
            if len(found) == count:
                break
        return found

    def levelled(self, values: Array) -> Array:
        """Designs (N, k) with two lengths made equal to their mean, for every pair: (M, k), those within the bounds."""
        made = [np.empty((0, self.size))]
        for i, j in combinations(np.flatnonzero(self.lengths).tolist(), 2):
            level = values.copy()
            level[:, [i, j]] = values[:, [i, j]].mean(axis=1, keepdims=True)
            made.append(level)
        every = np.concatenate(made)
        return every[self.holds(every)]

    def moves(self) -> Array:
        """(M, k) directions of the pattern search: one number up or down, two together or against each other."""
        k = self.size
        steps = [] if self.total is not None else [s * e for e in np.eye(k) for s in (1, -1)]
        for i, j in combinations(range(k), 2):
            for a, b in ((1, -1), (-1, 1)) if self.total is not None else ((1, -1), (-1, 1), (1, 1), (-1, -1)):
                step = np.zeros(k)
                step[i], step[j] = a, b
                steps.append(step)
        if self.total is not None:
            # Two equal ones stay equal while the third gives way.
            for i, j in combinations(range(k), 2):
                for other in set(range(k)) - {i, j}:
                    step = np.zeros(k)
                    step[[i, j]], step[other] = 0.5, -1.0
                    steps += [step, -step]
        return np.array(steps)


def improved(
    box: Box,
    measured: Measured,
    order: Sequence[str],
    designs: int,
    climbs: int,
    seed: int,
    progress: Callable[[int, int], None] | None = None,
) -> tuple[Array, dict[str, Array]]:
    """Screen, then improve the best.

    Args:
        box: The designs.
        measured: From designs (N, k) to measures (N,) by name, the greater the better.
        order: Names of measures, the first decides, the next of equals.
        designs: Of the screening.
        climbs: Designs to improve.
        seed: Of the screening.
        progress: Called with (designs done, designs expected in all).

    Returns:
        All designs that were looked at, the given one first, and their measures.
    """
    drawn = box.draw(designs, seed)
    values = np.concatenate([box.space.start[None], drawn, box.levelled(drawn)])
    expected = len(values) + climbs * len(box.moves()) * 6
    seen = measured(values)
    if progress is not None:
        progress(len(values), max(expected, len(values)))

    def score(k: int) -> tuple[float, ...]:
        return tuple(round(float(seen[name][k]), 4 if name != order[-1] else 9) for name in order)

    leaders = sorted(range(len(values)), key=score, reverse=True)[: max(climbs, 0)]
    for leader in leaders:
        at, step = leader, _FIRST
        while step >= _LAST:
            # Lengths are moved alike, so that a sum is kept; other numbers by their own width.
            width = box.space.upper - box.space.lower
            width = np.where(box.lengths, width[box.lengths].min(initial=np.inf), width)
            trial = values[at] + step * width * box.moves()
            trial = np.concatenate([trial, box.levelled(values[[at]])])
            trial = trial[box.holds(trial)]
            if not len(trial):
                step /= 2
                continue
            found = measured(trial)
            first = len(values)
            values = np.concatenate([values, trial])
            seen = {name: np.concatenate([seen[name], found[name]]) for name in seen}
            best = max(range(first, len(values)), key=score)
            if score(best) > score(at):
                at = best
            else:
                step /= 2
            if progress is not None:
                progress(len(values), max(expected, len(values)))
    return values, seen
