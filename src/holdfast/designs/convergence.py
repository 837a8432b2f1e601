"""Which arm to build so that it still reaches its targets when a joint locks and its controller does not know."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arms.serial import to_dict
from holdfast.control.law import Law
from holdfast.convergence.places import read_places
from holdfast.designs.failures import Convergences, Failures
from holdfast.designs.joints import DesignJoints, LawOfDesigns
from holdfast.designs.pattern import Box, improved
from holdfast.designs.planar import PlanarRest, Radial
from holdfast.designs.space import DesignSpace, Vary, design_space
from holdfast.engine.memory import Memory, Parts
from holdfast.errors import InputError
from holdfast.notice import says
from holdfast.probability.intervals import Difference, Interval
from holdfast.registry import LAWS
from holdfast.result import Result

Array = NDArray[np.float64]
Progress = Callable[[int, int], None]
Aim = Literal["guaranteed", "converged"]

RINGS = 40
TARGETS, FAILURES = 12, 2  # of a sampled search; each failure is one of every joint
_CHUNK = 16  # designs that are looked at, and remembered, together
_FRESH = 8  # times as many targets in the check of a sampled search


@dataclass(frozen=True, eq=False, kw_only=True)
class ConvergenceDesigns(Result):
    """Designs of an arm by how often they converge after an unidentified lock; design 0 is the given arm.

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
    values: Array
    measures: dict[str, Array]
    objective: Aim
    exact: bool
    best: int
    checked: tuple[Interval, Interval, Difference] | None
    searched: dict[str, Any] = field(default_factory=dict)
    _rest: PlanarRest | None = field(repr=False, default=None)
    _rings: Array | None = field(repr=False, default=None)

    def arm(self, design: int | None = None) -> Arm:
        """The arm of a design, the best one if none is given, without inertial data."""
        return self.space.arm_of(self.values[self.best if design is None else design])

    def radial(self, design: int | None = None) -> Radial:
        """Of a design, the best one if none is given: what locks leave of targets at every distance (exact only).

        Raises:
            InputError: The search was by sampling.
        """
        if self._rest is None or self._rings is None:
            raise InputError("only designs of planar arms with three joints are known by distance; these were sampled")
        chosen = self.values[[self.best if design is None else design]]
        return self._rest.radial(_lengths(self._rest, self.space, chosen), self._rings)

    def describe(self) -> list[str]:
        """A few sentences for people."""
        how = "from its stationary sets" if self.exact else "by simulation"
        lines = [f"{self.law.arm.title} under {self.law.describe()}: {len(self.values)} designs, {how}"]
        for word, k in (("given", 0), ("best", self.best)):
            numbers = ", ".join(f"{p.name} {p.text(x)}" for p, x in zip(self.space.parameters, self.values[k], strict=True))
            told = ", ".join(f"{name} {100 * m[k]:.1f} %" for name, m in self.measures.items())
            lines.append(f"{word}: {numbers}: {told}")
        if self.checked is not None:
            given, best, apart = self.checked
            lines.append(
                f"on fresh failures: given {100 * given.value:.1f} % ({100 * given.low:.1f} to {100 * given.high:.1f}), best "
                f"{100 * best.value:.1f} % ({100 * best.low:.1f} to {100 * best.high:.1f}), difference "
                f"{100 * apart.value:+.1f} points ({100 * apart.low:+.1f} to {100 * apart.high:+.1f})"
            )
        return lines

    def arm_file(self) -> str:
        """The best arm as a file that every command takes."""
        from holdfast.arms.dh_file import text

        arm = self.arm()
        return text(self.space.table_of(self.values[self.best]), arm.name, arm.gravity, arm.source)


@checked
@says("searching designs")
def design_for_convergence(
    law: Law,
    vary: Vary,
    targets: ArrayLike | int | None = None,
    *,
    objective: Aim = "guaranteed",
    designs: int = 256,
    climbs: int = 4,
    keep_reach: bool = False,
    exact: bool | None = None,
    failures: int = FAILURES,
    seed: int = 0,
    progress: Progress | None = None,
    store: str | Path | None = None,
) -> ConvergenceDesigns:
    """Search for the arm that most surely reaches its targets with a joint locked that its controller does not know of.

    **Planar arms of three joints** (pseudoinverse, weighted by joint, damped): exact, up to a grid of 1.5 deg in one angle.
    Where the arm can stop away from the target is known for all targets at once, and so, for every distance of the
    target, at which locked angles that leave it within reach there is a sink, or a singular configuration that draws the arm
    in. No sink and no trap does not exclude limit cycles, of which one is known; see :func:`holdfast.equilibria.orbit`.

    **Any other arm, task or law**: by simulation of the same random failures for all designs. A joint locks where it is in
    some configuration at the target, so that the target stays within reach, and the arm starts anywhere.

    Neither measure is smooth in the design. A scrambled Sobol sequence screens the bounds, together with designs in which two
    varied lengths are made equal, as coincidences matter here; the best are improved by pattern search. What is found is
    good, and not proved to be best.

    Args:
        law: The law, with the given arm and the task; every design is driven by the same.
        vary: What is varied, and between which bounds, m and rad: ``{"a2": (0.5, 1.5), "tool.z": (0.0, 0.2)}``, or whatever
            else :func:`holdfast.designs.design_space` takes; not joint limits.
        targets: Exact: the range of distances from the first joint, m; from 0 to the reach of the given arm if not given.
            Sampled: (T, m) positions, (T, 4, 4) poses, or how many random places of the given arm's tool; 12 if not given.
        objective: ``guaranteed`` (exact): the share of the targets that are guaranteed; of equal ones, the share of locks, then
            ``converged``. ``converged``: see :class:`holdfast.ConvergenceDesigns`. Sampled searches maximise ``converged``.
        designs: Of the screening.
        climbs: Of the best of them, so many are improved.
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
    for what, number, least in (("designs", designs, 1), ("climbs", climbs, 0), ("failures", failures, 1)):
        if number < least:
            raise InputError(f"{what} is {number}; it must be {least} or more")
    space = design_space(law.arm, vary)
    box = Box.read(space, keep_reach)
    rest = None
    if exact is not False:
        try:
            rest = _planar(law, space)
        except InputError:
            if exact:
                raise
    if rest is not None:
        if space.lower.min() <= 0:
            raise InputError("a link cannot have length 0 or less; give bounds above 0")
        return _exact(rest, box, _rings(rest, targets), objective, designs, climbs, seed, progress)
    if keep_reach:
        raise InputError("keep_reach belongs to the exact search for planar arms of three joints; leave it out")
    return _sampled(law, box, targets, designs, climbs, failures, seed, progress, store)


def _planar(law: Law, space: DesignSpace) -> PlanarRest:
    rest = PlanarRest(law)
    other = [name for name in space.names if name not in ("a1", "a2", "a3")]
    if other:
        raise InputError(f"'{other[0]}' is not a link length; exact sets are known for a1, a2 and a3, or sample: exact=False")
    return rest


def _rings(rest: PlanarRest, targets: ArrayLike | int | None) -> Array:
    ends = np.asarray([0.0, rest.lengths.sum()] if targets is None else targets, dtype=np.float64)
    if ends.shape != (2,) or not np.isfinite(ends).all() or not 0 <= ends[0] < ends[1]:
        raise InputError(
            f"targets are {np.array2string(ends, precision=4)}; give the least and the greatest distance from the first "
            "joint, m"
        )
    return np.asarray(np.linspace(float(ends[0]), float(ends[1]), RINGS + 1))


def _lengths(rest: PlanarRest, space: DesignSpace, values: Array) -> Array:
    out = np.tile(rest.lengths, (len(values), 1))
    out[:, [int(name[1:]) - 1 for name in space.names]] = values
    return out


def _exact(
    rest: PlanarRest,
    box: Box,
    rings: Array,
    objective: Aim,
    designs: int,
    climbs: int,
    seed: int,
    progress: Progress | None,
) -> ConvergenceDesigns:
    def measured(values: Array) -> dict[str, Array]:
        return planar_measures(rest.radial(_lengths(rest, box.space, values), rings))

    order = ("guaranteed", "free", "converged") if objective == "guaranteed" else ("converged",)
    values, measures = improved(box, measured, order, designs, climbs, seed, progress)
    best = _best(measures, order)
    searched = {"designs": designs, "climbs": climbs, "seed": seed, "keep_reach": box.total is not None}
    return ConvergenceDesigns(
        law=rest.law,
        space=box.space,
        values=values,
        measures=measures,
        objective=objective,
        exact=True,
        best=best,
        checked=None,
        searched=searched,
        _rest=rest,
        _rings=rings,
    )


def planar_measures(radial: Radial) -> dict[str, Array]:
    """The measures of :class:`holdfast.ConvergenceDesigns`, (D,) each, over the area of the rings."""
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


def _best(measures: dict[str, Array], order: tuple[str, ...]) -> int:
    # Of measures that differ by less than 0.1 % the next one decides.
    keys = [np.round(measures[name], 3) for name in order[:-1]] + [measures[order[-1]]]
    return int(np.lexsort([-k for k in reversed(keys)])[0])


def _sampled(
    law: Law,
    box: Box,
    targets: ArrayLike | int | None,
    designs: int,
    climbs: int,
    failures: int,
    seed: int,
    progress: Progress | None,
    store: str | Path | None,
) -> ConvergenceDesigns:
    if store is not None:
        LAWS.label(law)  # says so where there is none
    moved = LawOfDesigns(law, DesignJoints.of(box.space))
    search, check = np.random.SeedSequence(seed).spawn(2)
    given = TARGETS if targets is None else targets
    places = read_places(law.arm, law.task, given, np.random.default_rng(search))
    seen = Failures(moved, places.poses, failures, seed)
    searched = {"designs": designs, "climbs": climbs, "seed": seed, "failures": failures, "targets": len(places)}
    listed = None if isinstance(given, (int, np.integer)) else places.poses.tolist()
    memory = None
    if store is not None:
        task = [law.task.rows.tolist(), law.task.frame, law.task.length]
        formerly = law.formerly([law.label, law.describe()], task)
        memory = Memory(store, _plan(law, box.space, {**searched, "places": listed}), formerly)
    parts = count(1)

    def part(name: str, make: Callable[[], Parts]) -> Parts:
        return make() if memory is None else memory.part(name, make)

    def looked(values: Array) -> Parts:
        a = seen.of(values)
        with np.errstate(invalid="ignore"):
            free = a.converged.sum(axis=(1, 2, 3)) / (a.known.sum(axis=(1, 2)) * law.arm.n)
        return {"free": free, "arrival": a.overall, "reached": a.reached}

    def measured(values: Array) -> dict[str, Array]:
        # What a design is worth does not depend on its company, so that a stopped search loses little.
        chunks = [values[k : k + _CHUNK] for k in range(0, len(values), _CHUNK)]
        found = [part(f"designs {next(parts)}", lambda c=c: looked(c)) for c in chunks]  # type: ignore[misc]
        named = {"arrival": "converged"}  # stored under its former name
        return {named.get(name, name): np.concatenate([f[name] for f in found]) for name in found[0]}

    values, measures = improved(box, measured, ("converged",), designs, climbs, seed, progress)
    best = _best(measures, ("converged",))
    # What was chosen for doing well on some failures is judged by others; targets that were given stay what they are.
    more = _FRESH * len(places) if isinstance(given, (int, np.integer)) else given
    fresh = read_places(law.arm, law.task, more, np.random.default_rng(check))
    judged = part("check", lambda: vars(Failures(moved, fresh.poses, failures, seed + 1).of(values[[0, best]])))
    compared = _compared(Convergences(**judged))
    return ConvergenceDesigns(
        law=law,
        space=box.space,
        values=values,
        measures=measures,
        objective="converged",
        exact=False,
        best=best,
        checked=compared,
        searched=searched,
    )


def _plan(law: Law, space: DesignSpace, searched: dict[str, Any]) -> dict[str, Any]:
    """What defines a sampled search, as JSON data."""
    return {
        "kind": "design for convergence",
        "arm": to_dict(law.arm),
        **law.stored(),
        "vary": [p.written for p in space.parameters],
        **searched,
    }


def _compared(found: Convergences) -> tuple[Interval, Interval, Difference] | None:
    """Of two designs: mean shares over the targets with their intervals, and of the difference."""
    shares = np.nan_to_num(found.by_target)
    if shares.shape[1] < 2:
        return None
    given, best = (Interval.of_fractions(x) for x in shares)
    return given, best, Difference.of_fractions(shares[1] - shares[0])
