"""Choice of the control law that reaches the target most often after a failure: several laws on the same failures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.convergence.maps import ConvergenceMap, Progress, average_fraction, convergence_map
from holdfast.control.convergence.places import Places
from holdfast.control.laws.law import Law
from holdfast.core.errors import InputError
from holdfast.core.probability.intervals import Difference, Interval, check_confidence
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray


@dataclass(frozen=True, eq=False)
class LawChoice(Result):
    """Outcomes of several control laws for the same starts, targets and locked joints.

    Attributes:
        names: Names of the laws.
        maps: Convergence map of each law.
    """

    names: tuple[str, ...]
    maps: tuple[ConvergenceMap, ...]

    def map_of(self, name: str) -> ConvergenceMap:
        """Return the convergence map of the law ``name``.

        Raises:
            InputError: There is no law of this name.
        """
        if name not in self.names:
            raise InputError(f"law '{name}' is not known; use {', '.join(self.names)}")
        return self.maps[self.names.index(name)]

    def share(
        self, name: str, joint: str | int | None = None, confidence: float = 0.95, *, outcome: str = "converged"
    ) -> Interval:
        """Return the fraction of the failures after which the arm converges under a law, for one joint or for all joints.

        Args:
            name: Name of the law.
            joint: Name, or index from 0, of the locked joint. None: all joints with equal weights.
            confidence: Confidence level of the interval.
            outcome: Outcome of :meth:`holdfast.ConvergenceMap.has_outcome` to count; in a cell also ``touched``, for a contact
                on the way.

        Raises:
            InputError: The law, joint or outcome is not known.
        """
        check_confidence(confidence)
        law_map = self.map_of(name)
        motion_count = int(law_map.has_configuration.sum(axis=1).max(initial=0)) * (law_map.law.arm.n if joint is None else 1)
        return average_fraction(self._fractions_by_place(name, joint, outcome), motion_count, confidence)

    def difference(self, name: str, other: str, joint: str | int | None = None, *, confidence: float = 0.95) -> Difference:
        """Return the difference between the fractions of failures after which two laws converge, with its interval.

        The interval uses the differences by place, because places are independent and the motions of one place are not. It
        always covers (:meth:`holdfast.core.probability.Difference.of_fractions`).

        Args:
            name: Name of the law.
            other: Name of the law whose fraction is subtracted.
            joint: Name, or index from 0, of the locked joint. None: all joints with equal weights.
            confidence: Confidence level of the interval.

        Raises:
            InputError: A law or joint is not known, or no place has a motion.
        """
        check_confidence(confidence)
        differences = self._fractions_by_place(name, joint) - self._fractions_by_place(other, joint)
        differences = differences[~np.isnan(differences)]
        if not differences.size:
            raise InputError("no place has a motion; choose places within reach")
        return Difference.of_fractions(differences, confidence)

    @property
    def ranking(self) -> list[str]:
        """Names of the laws by the fraction of failures after which the target is reached, the largest first."""
        return sorted(self.names, key=lambda name: -float(np.nanmean(self._fractions_by_place(name, None))))

    @property
    def best(self) -> str:
        """Name of the first law in the ranking; :meth:`difference` quantifies how certain this choice is."""
        return self.ranking[0]

    def _fractions_by_place(self, name: str, joint: str | int | None, outcome: str = "converged") -> FloatArray:
        law_map = self.map_of(name)
        values = law_map.values(outcome)[:, :-1]
        return values.mean(axis=1) if joint is None else values[:, law_map.law.arm.joint_index(joint)]


@reports_progress("simulating failures")
def rank_laws(
    laws: Mapping[str, Law],
    targets: ArrayLike | str | int | Places,
    starts: ArrayLike | str | int | Places,
    progress: Progress | None,
    **options: Any,
) -> LawChoice:
    """Return the outcomes of laws, given by name, for the same failures; see :func:`holdfast.compare_laws`."""
    if len(laws) < 2:
        raise InputError(f"there is {len(laws)} law; give two or more different ones to find the best")
    maps = []
    for number, law in enumerate(laws.values()):

        def report(done: int, total: int, number: int = number) -> None:
            if progress is not None:
                progress(number * total + done, len(laws) * total)

        maps.append(convergence_map(law, targets, starts, progress=report, **options))
    return LawChoice(tuple(laws), tuple(maps))
