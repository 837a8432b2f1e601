"""Which control law reaches the target most often after a failure: several laws on the same failures."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.control.law import Law
from holdfast.convergence.maps import ConvergenceMap, convergence_map, shared
from holdfast.convergence.places import Places
from holdfast.errors import InputError
from holdfast.notice import says
from holdfast.probability.intervals import Difference, Interval, check_confidence
from holdfast.result import Result

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class LawChoice(Result):
    """Laws on the same failures: the same starts, targets and locked joints.

    Attributes:
        names: Of the laws.
        maps: What happened, a :class:`holdfast.ConvergenceMap` each.
    """

    names: tuple[str, ...]
    maps: tuple[ConvergenceMap, ...]

    def map_of(self, name: str) -> ConvergenceMap:
        """What happened under one law.

        Raises:
            InputError: No such law.
        """
        if name not in self.names:
            raise InputError(f"there is no law '{name}'; there are {', '.join(self.names)}")
        return self.maps[self.names.index(name)]

    def share(
        self, name: str, joint: str | int | None = None, confidence: float = 0.95, *, outcome: str = "converged"
    ) -> Interval:
        """Share of the failures after which the arm converges under a law: of one joint, or of all joints alike.

        Args:
            name: Of the law.
            joint: By name or index from 0; None: all alike.
            confidence: Of the interval.
            outcome: Another one of :meth:`holdfast.ConvergenceMap.happened`; in a cell ``touched``: something is touched on the
                way.

        Raises:
            InputError: No such law, joint or outcome.
        """
        check_confidence(confidence)
        one = self.map_of(name)
        each = int(one.known.sum(axis=1).max(initial=0)) * (one.law.arm.n if joint is None else 1)
        return shared(self._by_place(name, joint, outcome), each, confidence)

    def difference(self, name: str, other: str, joint: str | int | None = None, *, confidence: float = 0.95) -> Difference:
        """How much more often one law converges than another, on the same failures.

        The interval is of the differences of the places, which are independent; the motions of one are not. It always covers
        (:meth:`holdfast.probability.Difference.of_fractions`).

        Raises:
            InputError: No such law or joint, or no place with a motion.
        """
        check_confidence(confidence)
        apart = self._by_place(name, joint) - self._by_place(other, joint)
        apart = apart[~np.isnan(apart)]
        if not apart.size:
            raise InputError("no place has a motion; choose places within reach")
        return Difference.of_fractions(apart, confidence)

    @property
    def ranking(self) -> list[str]:
        """Names of the laws by the share of failures after which the target is reached, the greatest first."""
        return sorted(self.names, key=lambda name: -float(np.nanmean(self._by_place(name, None))))

    @property
    def best(self) -> str:
        """The first of the ranking; :meth:`difference` says how sure that is."""
        return self.ranking[0]

    def describe(self) -> list[str]:
        """A few sentences for people."""
        first, best = self.maps[0], self.best
        lines = [
            f"{len(self.names)} laws on {first.law.arm.title}, task {first.law.task.describe()}: the same "
            f"{int(first.known.sum()) * first.law.arm.n} failures, {int(first.known.any(axis=1).sum())} {first.over}"
        ]
        for name in self.ranking:
            s = self.share(name)
            line = f"{name}: converges after {100 * s.value:.1f} % of the failures ({100 * s.low:.1f} to {100 * s.high:.1f} %)"
            if name != best:
                d = self.difference(name, best)
                line += f", {100 * d.value:+.1f} points against the best ({100 * d.low:+.1f} to {100 * d.high:+.1f})"
            if first.touched is not None:
                line += f"; something is touched on the way in {100 * self.share(name, outcome='touched').value:.1f} % at most"
            lines.append(line)
        return lines

    def _by_place(self, name: str, joint: str | int | None, outcome: str = "converged") -> Array:
        one = self.map_of(name)
        values = one.values(outcome)[:, :-1]
        return values.mean(axis=1) if joint is None else values[:, one.law.arm.joint_index(joint)]


@checked
@says("simulating failures")
def best_law(
    laws: Mapping[str, Law] | Sequence[Law],
    targets: ArrayLike | str | int | Places,
    starts: ArrayLike | str | int | Places = 300,
    *,
    progress: Callable[[int, int], None] | None = None,
    **options: Any,
) -> LawChoice:
    """Which of several laws most often reaches the target with a joint locked that the controller does not know of.

    Every law meets the same failures: :func:`holdfast.convergence_map` with the same places, configurations and seed. To
    find the best pre-failure error, give the failure-tolerant law with several.

    Args:
        laws: Two or more of one arm and task, by name; a sequence is named by :meth:`holdfast.control.Law.phrase`, without
            the task.
        targets: As for :func:`holdfast.convergence_map`.
        starts: Likewise.
        progress: Called with (runs done, runs in all).
        options: Everything else that :func:`holdfast.convergence_map` takes; with ``cell`` it is said how often each law leads
            into something, which does not change the ranking.

    Raises:
        InputError: Fewer than two laws, laws of different arms or tasks, or as :func:`holdfast.convergence_map`.
    """
    named = dict(laws) if isinstance(laws, Mapping) else {_name(law): law for law in laws}
    if len(named) < 2 or len(named) != len(laws):
        raise InputError(f"there are {len(named)} different laws; give two or more, or name them yourself: {{'a': law, ...}}")
    first = next(iter(named.values()))
    for name, law in named.items():
        if law.arm.fingerprint != first.arm.fingerprint or not law.task.same_rows(first.task):
            raise InputError(f"the law '{name}' has another arm or task than the first; compare laws of one arm and task")

    maps = []
    for k, law in enumerate(named.values()):
        step = None if progress is None else _shifted(progress, k, len(named))
        maps.append(convergence_map(law, targets, starts, progress=step, **options))
    return LawChoice(tuple(named), tuple(maps))


def _name(law: Law) -> str:
    return law.phrase().replace(f", task {law.task.describe()}", "")


def _shifted(progress: Callable[[int, int], None], number: int, laws: int) -> Callable[[int, int], None]:
    return lambda done, total: progress(number * total + done, laws * total)
