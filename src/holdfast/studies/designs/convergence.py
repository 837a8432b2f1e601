"""Search for the arm that most often reaches its targets after an unidentified lock."""

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
DEFAULT_TARGETS = 12  # of a sampled search
FAILURES_PER_JOINT = 2  # each failure is one of every joint
_CHUNK_DESIGNS = 16  # designs that are looked at, and remembered, together
_CHECK_TARGET_FACTOR = 8  # times as many targets in the check of a sampled search


@dataclass(frozen=True, eq=False, kw_only=True)
class ConvergenceDesigns(Result):
    """Designs of an arm by how often they converge after an unidentified lock; design 0 is the baseline arm.

    Attributes:
        law: The law, of the given arm.
        space: What is varied.
        values: (D, k) of all designs that were looked at, m and rad.
        measures: By name, (D,) each. ``guaranteed``: share of the targets (of the area, for planar arms) that whatever lock
            leaves within reach the arm converges to, as far as no sink and no singular trap holds it (exact only);
            ``free``: share of the locks that leave the target within reach after which nothing can hold the arm (exact), or it
            converged (sampled), every joint alike; ``converged``: share of all locks after which the target is in reach and
            nothing can hold the arm (exact); mean over the targets of the share of failures after which it converged, 0 for
            targets out of reach (sampled); ``reached``: share of the targets that the healthy arm reaches.
        objective: What was maximised.
        exact: From the stationary sets, not from simulations.
        best: Index of the best design.
        checked: Sampled only: shares of the given and of the best arm on targets and failures that the search did not see,
            and their difference.
        searched: How it was searched, by the names of the options.
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
        """Return the arm of a design, by default the best one, without inertial data."""
        return self.space.arm_of(self.values[self.best if design is None else design])

    def radial(self, design: int | None = None) -> Radial:
        """Return the effect of locks on targets at every distance for a design, by default the best one (exact only).

        Raises:
            InputError: The search was by sampling.
        """
        if self._rest is None or self._rings is None:
            raise InputError("only designs of planar arms with three joints are known by distance; these were sampled")
        chosen = self.values[[self.best if design is None else design]]
        return self._rest.radial(_make_link_lengths(self._rest, self.space, chosen), self._rings)

    def arm_file(self) -> str:
        """Return the best arm as a file that every command reads."""
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
    """Search for the arm that most often reaches its targets after a lock that its controller has not identified.

    **Planar arms of three joints** (pseudoinverse, weighted by joint, damped): exact, up to a grid of 1.5 deg in one angle.
    Where the arm can stop away from the target is known for all targets at once, and so, for every distance of the
    target, at which locked angles that leave it within reach there is a sink, or a singular configuration that draws the arm
    in. No sink and no trap does not exclude limit cycles, of which one is known; see :func:`holdfast.control.equilibria.orbit`.

    **Any other arm, task or law**: by simulation of the same random failures for all designs. A joint locks where it is in
    some configuration at the target, so that the target stays within reach, and the arm starts anywhere.

    Neither measure is smooth in the design. A scrambled Sobol sequence screens the bounds, together with designs in which two
    varied lengths are made equal, as coincidences matter here; the best are improved by pattern search. What is found is
    good, and not proved to be best.

    Args:
        law: The law, with the given arm and the task; every design is driven by the same.
        vary: What is varied, and between which bounds, m and rad: ``{"a2": (0.5, 1.5), "tool.z": (0.0, 0.2)}``, or whatever
            else :func:`holdfast.studies.designs.design_space` takes; not joint limits.
        targets: Exact: the range of distances from the first joint, m; from 0 to the reach of the given arm if not given.
            Sampled: (T, m) positions, (T, 4, 4) poses, or how many random places of the given arm's tool; 12 if not given.
        objective: ``guaranteed`` (exact): the share of the targets that are guaranteed; of equal ones, the share of locks, then
            ``converged``. ``converged``: see :class:`holdfast.ConvergenceDesigns`. Sampled searches maximise ``converged``.
        designs: Of the screening.
        local_searches: Of the best of them, so many are improved.
        keep_reach: The varied link lengths keep their sum.
        exact: False: simulate where the exact sets are known, too.
        failures: Of each joint for each target (sampled).
        seed: Of the designs, and of all random numbers of a sampled search.
        progress: Called with (designs done, designs expected in all).
        store: Folder from which a stopped sampled search resumes; an exact one takes seconds.

    Raises:
        InputError: Names, bounds or options that do not fit; a law or an arm without exact sets, if ``exact`` is True.
        StoreError: The folder holds something else, or cannot be written.

    Source: Goel, Maciejewski, Balakrishnan 2005, footnote 11, say that their analysis can be extended to design such arms, and
    not how. Measures and search are ours.
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
            raise InputError("a link cannot have length 0 or less; give bounds above 0")
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
            f"'{other_names[0]}' is not a link length; exact sets are known for a1, a2 and a3, or sample: exact=False"
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
    """Return the measures of :class:`holdfast.ConvergenceDesigns`, (D,) each, weighted by the areas of the rings."""
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
    # Of measures that differ by less than 0.1 % the next one decides.
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
        LAW_REGISTRY.label(law)  # says so where there is none
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
        # What a design is worth does not depend on its company, so that a stopped search loses little.
        chunks = [values[start : start + _CHUNK_DESIGNS] for start in range(0, len(values), _CHUNK_DESIGNS)]
        results = [recall_part(f"designs {next(part_numbers)}", lambda c=c: evaluate_chunk(c)) for c in chunks]  # type: ignore[misc]
        return {name: np.concatenate([result[name] for result in results]) for name in results[0]}

    values, measures = search_patterns(bounds, measure_designs, ("converged",), designs, local_searches, seed, progress)
    best = _choose_best(measures, ("converged",))
    # What was chosen for doing well on some failures is judged by others; targets that were given stay what they are.
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
