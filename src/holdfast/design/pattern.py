"""Search for a design by a measure that is not smooth: Sobol screening, designs with equal lengths, pattern search."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from holdfast.design.design_joints import DesignJoints
from holdfast.errors import InputError

Array = NDArray[np.float64]
Measured = Callable[[Array], dict[str, Array]]

_FIRST, _LAST = 1 / 8, 1 / 256  # steps of the pattern search, of the width of the bounds
_SAME = 1e-9
_DRAWS = 64  # times as many drawn as wanted, at most, where the sum is kept


@dataclass(frozen=True, eq=False)
class Box:
    """What designs there are.

    Attributes:
        start: (k,) the given arm.
        lower, upper: (k,) bounds; the given arm need not be within.
        total: Sum that lengths keep; None: none.
        lengths: (k,) which are link lengths.
    """

    start: Array
    lower: Array
    upper: Array
    total: float | None
    lengths: NDArray[np.bool_]

    @classmethod
    def read(cls, joints: DesignJoints, vary: Mapping[str, tuple[float, float]], keep_reach: bool) -> Box:
        """From bounds as people give them.

        Raises:
            InputError: Bounds that are none, or a sum that cannot be kept.
        """
        for name, bounds in vary.items():
            ends = np.asarray(bounds, dtype=np.float64)
            if ends.shape != (2,) or not np.isfinite(ends).all() or ends[0] >= ends[1]:
                raise InputError(f"bounds of {name} are {bounds}; give (lower, upper), finite, the lower one first")
        lower, upper = (np.array([float(vary[name][k]) for name in joints.names]) for k in (0, 1))
        lengths = np.array([name[0] == "a" and name[1:].isdecimal() for name in joints.names])
        total = float(joints.given.sum()) if keep_reach else None
        if keep_reach and (lengths.sum() < 2 or not lengths.all()):
            raise InputError("keep_reach needs two or more varied link lengths, and nothing else varied")
        if total is not None and not lower.sum() < total < upper.sum():
            raise InputError(
                f"the varied lengths of the given arm add up to {total:g} m, which the bounds do not allow; widen them"
            )
        return cls(joints.given, lower, upper, total, lengths)

    def holds(self, values: Array) -> NDArray[np.bool_]:
        """(N,) whether designs (N, k) are within the bounds."""
        return np.asarray(((values >= self.lower - _SAME) & (values <= self.upper + _SAME)).all(axis=1))

    def draw(self, count: int, seed: int) -> Array:
        """(count, k) designs of a scrambled Sobol sequence; where a sum is kept, the last one follows from the others."""
        from scipy.stats import qmc

        free = self.start.size - (self.total is not None)
        engine = qmc.Sobol(free, seed=seed)
        found = np.empty((0, self.start.size))
        for _ in range(_DRAWS):
            values = self.lower[:free] + engine.random(1 << (max(count, 2) - 1).bit_length()) * (self.upper - self.lower)[:free]
            if self.total is not None:
                values = np.column_stack([values, self.total - values.sum(axis=1)])
            found = np.concatenate([found, values[self.holds(values)]])[:count]
            if len(found) == count:
                break
        return found

    def levelled(self, values: Array) -> Array:
        """Designs (N, k) with two lengths made equal to their mean, for every pair: (M, k), those within the bounds."""
        made = [np.empty((0, self.start.size))]
        for i, j in combinations(np.flatnonzero(self.lengths).tolist(), 2):
            level = values.copy()
            level[:, [i, j]] = values[:, [i, j]].mean(axis=1, keepdims=True)
            made.append(level)
        every = np.concatenate(made)
        return every[self.holds(every)]

    def moves(self) -> Array:
        """(M, k) directions of the pattern search: one number up or down, two together or against each other."""
        k = self.start.size
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
    expected = 1 + 2 * len(drawn) + climbs * len(box.moves()) * 6
    values = np.concatenate([box.start[None], drawn])
    values = np.concatenate([values, box.levelled(drawn)[: len(drawn)]])
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
            width = np.where(box.lengths, (box.upper - box.lower)[box.lengths].min(initial=np.inf), box.upper - box.lower)
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
