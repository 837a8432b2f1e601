"""Search for the arm that most often reaches its targets after an undetected lock."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.convergence.places import read_places
from holdfast.control.laws.law import Law
from holdfast.core.errors import InputError
from holdfast.core.probability.intervals import Difference, Interval
from holdfast.core.progress import reports_progress
from holdfast.core.registry import LAW_REGISTRY
from holdfast.core.result import Result
from holdfast.core.sweeps.memory import Parts, SearchMemory
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.model import Arm
from holdfast.model.arms.serial import to_dict
from holdfast.studies.designs.failures import ConvergenceOutcomes, FailureTrials
from holdfast.studies.designs.joints import DesignJoints, LawOfDesigns
from holdfast.studies.designs.pattern import DesignBounds, search_patterns
from holdfast.studies.designs.planar import PlanarStationarySets, Radial
from holdfast.studies.designs.space import DesignSpace, Vary, design_space

Progress = Callable[[int, int], None]
Aim = Literal["guaranteed", "converged"]

RING_COUNT = 40
DEFAULT_TARGETS = 12  # targets of a sampled search
FAILURES_PER_JOINT = 2  # failures of each joint for each target
_CHUNK_DESIGNS = 16  # designs that are evaluated and stored together
_CHECK_TARGET_FACTOR = 8  # ratio of the targets in the check to those in a sampled search


@dataclass(frozen=True, eq=False, kw_only=True)
class ConvergenceDesigns(Result):
    """D designs of an arm with measures of their convergence after an undetected lock; design 0 is the baseline arm.

    Attributes:
        law: Control law of the baseline arm.
        space: Design space.
        values: (D, k) all evaluated designs, m and rad.
        measures: Measures by name, (D,) each, as fractions. ``guaranteed``: targets (by area for planar arms) at which, for
            every lock that leaves them within reach, no sink and no singular trap holds the arm (exact only). ``free``: locks,
            among those that leave the target within reach, after which nothing can hold the arm (exact), or it converged
            (sampled), with equal weights of the joints. ``converged``: locks after which the target is in reach and nothing
            can hold the arm (exact); or mean over the targets of the fraction of failures after which it converged, 0 for
            targets out of reach (sampled). ``reached``: targets that the healthy arm reaches.
        objective: Name of the maximised measure.
        exact: True if the measures come from the stationary sets, not from simulations.
        best: Index of the best design.
        checked: Fractions of the baseline arm and the best arm on held-out targets and failures, and their difference (sampled
            only).
        searched: Options of the search, by name.
    """

    law: Law
    space: DesignSpace
    values: FloatArray
    measures: dict[str, FloatArray]
    objective: Aim
    exact: bool
    best: int
    checked: tuple[Interval, Interval, Difference] | None
    searched: dict[str, Any] = field(default_factory=dict)
    _rest: PlanarStationarySets | None = field(repr=False, default=None)
    _rings: FloatArray | None = field(repr=False, default=None)

    def arm(self, design: int | None = None) -> Arm:
        """Return the arm of the ``design`` with an index, by default the best one, without inertial data."""
        return self.space.arm_of(self.values[self.best if design is None else design])

    def radial(self, design: int | None = None) -> Radial:
        """Return the effect of locks on targets at every distance for a ``design``, by default the best one (exact only).

        Raises:
            InputError: The search was by sampling.
        """
        if self._rest is None or self._rings is None:
            raise InputError("these designs were sampled; effects by distance are known only for exact planar searches")
        chosen = self.values[[self.best if design is None else design]]
        return self._rest.radial(_make_link_lengths(self._rest, self.space, chosen), self._rings)

    def arm_file(self) -> str:
        """Return the best arm as the text of an arm file."""
        from holdfast.model.arms.dh_file import format_dh_file

        arm = self.arm()
        return format_dh_file(self.space.table_of(self.values[self.best]), arm.name, arm.gravity, arm.source)


@check_arguments
@reports_progress("searching designs")
def design_for_convergence(
    law: Law,
    vary: Vary,
    targets: ArrayLike | int | None = None,
    *,
    objective: Aim = "guaranteed",
    designs: int = 256,
    local_searches: int = 4,
    keep_reach: bool = False,
    exact: bool | None = None,
    failures: int = FAILURES_PER_JOINT,
    seed: int = 0,
    progress: Progress | None = None,
    store: str | Path | None = None,
) -> ConvergenceDesigns:
    """Search for the arm that most often reaches its targets after a lock that its controller has not detected.

    For **planar arms of three joints** (pseudoinverse, weighted by joint, damped) the search is exact, up to a grid of 1.5 deg
    in one angle. The configurations at which the arm can stop away from the target are known for all targets at once. This
    gives, for every distance of the target, the locked angles that leave it within reach and at which there is a sink, or a
    singular configuration that attracts the arm. The absence of both does not exclude limit cycles, of which one is known; see
    :func:`holdfast.control.equilibria.orbit`.

    For **any other arm, task or law** the search simulates the same random failures for all designs. A joint locks at its value
    in some configuration at the target, so that the target stays within reach, and the arm starts anywhere.

    Neither measure is smooth in the design. A scrambled Sobol sequence screens the bounds, together with designs in which two
    varied lengths are equal, because such coincidences matter here. Pattern search improves the best designs. The result is
    good, but not proved to be the best.

    Args:
        law: Control law for all designs, with the baseline arm and the task.
        vary: Varied parameters with bounds, m and rad, for example ``{"a2": (0.5, 1.5), "tool.z": (0.0, 0.2)}``, or any other
            form of :func:`holdfast.studies.designs.design_space`; not joint limits.
        targets: Range of distances from the first joint, m, for an exact search. Default: from 0 to the reach of the baseline
            arm. For a sampled search, (T, m) positions, m, (T, 4, 4) poses, or a number of random tool poses of the baseline
            arm. Default: 12.
        objective: ``guaranteed`` (exact) maximises the fraction of guaranteed targets, then that of locks, then ``converged``.
            Sampled searches maximise ``converged``; see :class:`holdfast.ConvergenceDesigns`.
        designs: Number of designs in the screening.
        local_searches: Number of the best designs that are improved.
        keep_reach: True to keep the sum of the varied link lengths.
        exact: False to simulate even if the exact sets are known. None: exact if possible.
        failures: Number of failures of each joint for each target (sampled).
        seed: Seed of the designs and of all random numbers of a sampled search.
        progress: Function that is called with (designs done, designs expected in all).
        store: Folder from which a stopped sampled search can be resumed; an exact one takes seconds.

    Raises:
        InputError: Names, bounds or options do not fit, or ``exact`` is True for a law or an arm without exact sets.
        StoreError: The folder contains other files, or cannot be written.

    Source: Goel, Maciejewski, Balakrishnan 2005, footnote 11, state that their analysis can be extended to design such arms,
    but not how. Measures and search are ours.
    """
    if objective not in ("guaranteed", "converged"):
        raise InputError(f"objective '{objective}' is not known; use guaranteed or converged")
    for option, number, minimum in (("designs", designs, 1), ("local_searches", local_searches, 0), ("failures", failures, 1)):
        if number < minimum:
            raise InputError(f"{option} is {number}; it must be {minimum} or more")
    space = design_space(law.arm, vary)
    bounds = DesignBounds.from_space(space, keep_reach)
    planar_rest = None
    if exact is not False:
        try:
            planar_rest = _make_planar_rest(law, space)
        except InputError:
            if exact:
                raise
    if planar_rest is not None:
        if space.lower.min() <= 0:
            raise InputError("a link length can be 0 or less within the bounds; give bounds above 0")
        return _search_exactly(
            planar_rest, bounds, _make_ring_radii(planar_rest, targets), objective, designs, local_searches, seed, progress
        )
    if keep_reach:
        raise InputError("keep_reach belongs to the exact search for planar arms of three joints; leave it out")
    return _search_by_sampling(law, bounds, targets, designs, local_searches, failures, seed, progress, store)


def _make_planar_rest(law: Law, space: DesignSpace) -> PlanarStationarySets:
    planar_rest = PlanarStationarySets(law)
    other_names = [name for name in space.names if name not in ("a1", "a2", "a3")]
    if other_names:
        raise InputError(
            f"'{other_names[0]}' is not a link length; vary a1, a2 or a3 for exact sets, or sample with exact=False"
        )
    return planar_rest


def _make_ring_radii(planar_rest: PlanarStationarySets, targets: ArrayLike | int | None) -> FloatArray:
    distances = np.asarray([0.0, planar_rest.lengths.sum()] if targets is None else targets, dtype=np.float64)
    if distances.shape != (2,) or not np.isfinite(distances).all() or not 0 <= distances[0] < distances[1]:
        raise InputError(
            f"targets are {np.array2string(distances, precision=4)}; give the least and the greatest distance from the first "
            "joint, m"
        )
    return np.asarray(np.linspace(float(distances[0]), float(distances[1]), RING_COUNT + 1))


def _make_link_lengths(planar_rest: PlanarStationarySets, space: DesignSpace, values: FloatArray) -> FloatArray:
    lengths = np.tile(planar_rest.lengths, (len(values), 1))
    lengths[:, [int(name[1:]) - 1 for name in space.names]] = values
    return lengths


def _search_exactly(
    planar_rest: PlanarStationarySets,
    bounds: DesignBounds,
    radii: FloatArray,
    objective: Aim,
    designs: int,
    local_searches: int,
    seed: int,
    progress: Progress | None,
) -> ConvergenceDesigns:
    def measure_designs(values: FloatArray) -> dict[str, FloatArray]:
        return planar_measures(planar_rest.radial(_make_link_lengths(planar_rest, bounds.space, values), radii))

    priorities = ("guaranteed", "free", "converged") if objective == "guaranteed" else ("converged",)
    values, measures = search_patterns(bounds, measure_designs, priorities, designs, local_searches, seed, progress)
    best = _choose_best(measures, priorities)
    options = {"designs": designs, "climbs": local_searches, "seed": seed, "keep_reach": bounds.length_sum is not None}
    return ConvergenceDesigns(
        law=planar_rest.law,
        space=bounds.space,
        values=values,
        measures=measures,
        objective=objective,
        exact=True,
        best=best,
        checked=None,
        searched=options,
        _rest=planar_rest,
        _rings=radii,
    )


def planar_measures(radial: Radial) -> dict[str, FloatArray]:
    """Return the measures of :class:`holdfast.ConvergenceDesigns`, (D,) each, for ``radial``, weighted by the rings' areas."""
    area = radial.area
    in_reach, stuck = ((area * x).sum(axis=2) for x in (radial.in_reach, radial.stuck))
    with np.errstate(invalid="ignore", divide="ignore"):
        free = 1 - np.where(in_reach > 0, stuck / in_reach, 0.0).mean(axis=1)
    return {
        "guaranteed": (area * radial.guaranteed).sum(axis=1),
        "free": free,
        "converged": (in_reach - stuck).mean(axis=1),
        "reached": (area * radial.reached).sum(axis=1),
    }


def _choose_best(measures: dict[str, FloatArray], priorities: tuple[str, ...]) -> int:
    # If measures differ by less than 0.1 %, the next measure decides.
    keys = [np.round(measures[name], 3) for name in priorities[:-1]] + [measures[priorities[-1]]]
    return int(np.lexsort([-key for key in reversed(keys)])[0])


def _search_by_sampling(
    law: Law,
    bounds: DesignBounds,
    targets: ArrayLike | int | None,
    designs: int,
    local_searches: int,
    failures: int,
    seed: int,
    progress: Progress | None,
    store: str | Path | None,
) -> ConvergenceDesigns:
    if store is not None:
        LAW_REGISTRY.label(law)  # raises InputError if the law has no label
    design_law = LawOfDesigns(law, DesignJoints.from_space(bounds.space))
    search_seed, check_seed = np.random.SeedSequence(seed).spawn(2)
    requested = DEFAULT_TARGETS if targets is None else targets
    search_targets = read_places(law.arm, law.task, requested, np.random.default_rng(search_seed))
    trials = FailureTrials(design_law, search_targets.poses, failures, seed)
    options = {"designs": designs, "climbs": local_searches, "seed": seed, "failures": failures, "targets": len(search_targets)}
    listed_poses = None if isinstance(requested, (int, np.integer)) else search_targets.poses.tolist()
    memory = None
    if store is not None:
        memory = SearchMemory(store, _make_search_plan(law, bounds.space, {**options, "places": listed_poses}))
    part_numbers = count(1)

    def recall_part(name: str, make: Callable[[], Parts]) -> Parts:
        return make() if memory is None else memory.recall_or_compute(name, make)

    def evaluate_chunk(values: FloatArray) -> Parts:
        outcomes = trials.simulate_designs(values)
        with np.errstate(invalid="ignore"):
            free_fraction = outcomes.converged.sum(axis=(1, 2, 3)) / (outcomes.known.sum(axis=(1, 2)) * law.arm.n)
        return {"free": free_fraction, "converged": outcomes.mean_fraction, "reached": outcomes.reached_fraction}

    def measure_designs(values: FloatArray) -> dict[str, FloatArray]:
        # The value of a design does not depend on the other designs, so a stopped search loses little.
        chunks = [values[start : start + _CHUNK_DESIGNS] for start in range(0, len(values), _CHUNK_DESIGNS)]
        results = [recall_part(f"designs {next(part_numbers)}", lambda c=c: evaluate_chunk(c)) for c in chunks]  # type: ignore[misc]
        return {name: np.concatenate([result[name] for result in results]) for name in results[0]}

    values, measures = search_patterns(bounds, measure_designs, ("converged",), designs, local_searches, seed, progress)
    best = _choose_best(measures, ("converged",))
    # The best design was selected on some failures, so it is checked on others; given targets do not change.
    check_targets = _CHECK_TARGET_FACTOR * len(search_targets) if isinstance(requested, (int, np.integer)) else requested
    check_places = read_places(law.arm, law.task, check_targets, np.random.default_rng(check_seed))
    check_data = recall_part(
        "check",
        lambda: vars(FailureTrials(design_law, check_places.poses, failures, seed + 1).simulate_designs(values[[0, best]])),
    )
    comparison = _compare_designs(ConvergenceOutcomes(**check_data))
    return ConvergenceDesigns(
        law=law,
        space=bounds.space,
        values=values,
        measures=measures,
        objective="converged",
        exact=False,
        best=best,
        checked=comparison,
        searched=options,
    )


def _make_search_plan(law: Law, space: DesignSpace, options: dict[str, Any]) -> dict[str, Any]:
    """Return everything that defines a sampled search, as JSON data."""
    return {
        "kind": "design for convergence",
        "arm": to_dict(law.arm),
        **law.to_stored(),
        "vary": [parameter.option_text for parameter in space.parameters],
        **options,
    }


def _compare_designs(outcomes: ConvergenceOutcomes) -> tuple[Interval, Interval, Difference] | None:
    """Return the mean fractions over the targets of two designs with their intervals, and the difference of the means."""
    fractions = np.nan_to_num(outcomes.fraction_by_target)
    if fractions.shape[1] < 2:
        return None
    baseline, best = (Interval.of_fractions(x) for x in fractions)
    return baseline, best, Difference.of_fractions(fractions[1] - fractions[0])
