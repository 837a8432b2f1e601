"""Maps of how failed arms end, by sampling: for any arm and task, over places of starts or of targets."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.configurations import as_configurations
from holdfast.clearance.choice import CellLike, chosen_clearance
from holdfast.clearance.clearance import Clearance
from holdfast.control.law import Law
from holdfast.convergence.places import Places, picked_at, read_places
from holdfast.errors import InputError
from holdfast.notice import says
from holdfast.probability.intervals import Interval, check_confidence
from holdfast.result import Result
from holdfast.simulation.closed_loop import simulate
from holdfast.simulation.runs import UNDECIDED, Outcome, Reason
from holdfast.solvers.inverse_kinematics import solver

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Over = Literal["starts", "targets"]
Progress = Callable[[int, int], None]

TIME_CONSTANTS = 500.0  # 1/Ke
TOLERANCE = 1e-8
NONE = 255  # no configuration was found there
RESTARTS, REACHED = 20, 1e-4  # starts that look for the target with the joint locked; m and rad
_SLICE = 1 << 16  # runs side by side; no result depends on it
_BY_LOCK = ("code", "reason", "in_reach", "limits_passed")
_OUTCOMES = {o.name.lower(): o for o in Outcome}


@dataclass(frozen=True, eq=False, kw_only=True)
class ConvergenceMap(Result):
    """How P x C motions ended with each joint locked from the start, and with none: the last column.

    Attributes:
        law: The law of the controller.
        places: The P places of the map, a :class:`holdfast.convergence.Places`.
        over: Whether these are the ``starts`` or the ``targets`` of the motions.
        q0: (P, C, n) configurations at the start, rad and m; NaN where none was found.
        target: (P, C, 4, 4) tool poses.
        code: (P, C, n + 1) :class:`holdfast.simulation.Outcome`, 255 where there was no configuration.
        reason: (P, C, n + 1) :class:`holdfast.simulation.Reason`: why a run is undecided.
        in_reach: (P, C, n + 1) True where the end effector reached the target, or could within the limits with the joint locked
            as it does: a configuration was found.
        limits_passed: (P, C, n + 1) True where a joint left its limits on the way; the motion does not heed them.
        seed: Of places, configurations and targets.
        clearance: What the runs were looked at for touching, or None: nobody looked. It changes no run.
        touched: (P, C, n + 1) True where the arm touches something on the way, at most: distances are bounds; None if nobody
            looked.
    """

    law: Law
    places: Places
    over: Over
    q0: Array
    target: Array
    code: NDArray[np.uint8]
    reason: NDArray[np.uint8]
    in_reach: Flags
    limits_passed: Flags
    seed: int
    clearance: Clearance | None = None
    touched: Flags | None = None

    @property
    def columns(self) -> tuple[str, ...]:
        """Locked joints by name, and ``none``."""
        return (*self.law.arm.joint_names, "none")

    @property
    def words(self) -> tuple[str, ...]:
        """What :meth:`happened` knows: ``converged`` and so on."""
        return (*_OUTCOMES, "in_reach", "trapped", *(() if self.touched is None else ("touched",)))

    @property
    def known(self) -> Flags:
        """(P, C) True where there was a configuration to start from."""
        return np.asarray(self.code[..., 0] != NONE)

    def happened(self, outcome: str) -> Flags:
        """(P, C, n + 1) True where a run ended so.

        Args:
            outcome: ``converged``, ``stuck``, ``moving`` or ``undecided``; ``in_reach``: it converged, or could have;
                ``trapped``: it did not converge although the target was in reach; or, where somebody looked, ``touched``.

        Raises:
            InputError: Another word.
        """
        if outcome == "touched" and self.touched is not None:
            return self.touched
        if outcome == "trapped":
            return np.asarray(self.known[..., None] & (self.code != Outcome.CONVERGED) & self.in_reach)
        if outcome == "in_reach":
            return self.in_reach
        if outcome not in _OUTCOMES:
            raise InputError(f"outcome '{outcome}' is not known; use {', '.join(self.words)}")
        return np.asarray(self.code == _OUTCOMES[outcome])

    def values(self, outcome: str = "converged") -> Array:
        """(P, n + 1) share of the motions of each place that ended so; NaN where there are none."""
        count = self.known.sum(axis=1)
        with np.errstate(invalid="ignore"):
            return np.asarray(self.happened(outcome).sum(axis=1) / np.where(count > 0, count, np.nan)[:, None])

    def shares(self, outcome: str = "converged", confidence: float = 0.95) -> dict[str, Interval]:
        """Share of the places' motions that ended so, for each locked joint by name and for ``none``.

        Every place counts alike. The motions of one place resemble each other, so the unit is the place: with one motion each
        the interval is that of a share (:meth:`holdfast.probability.Interval.of`), with several that of a mean of fractions
        (:meth:`holdfast.probability.Interval.of_fractions`). Both always cover, for places that are a random sample.
        """
        check_confidence(confidence)
        values, each = self.values(outcome), int(self.known.sum(axis=1).max(initial=0))
        return {name: shared(values[:, k], each, confidence) for k, name in enumerate(self.columns)}

    def to_xarray(self) -> xr.Dataset:
        """Of each motion from or to each place: where it starts and should go, and how it ended with each joint locked."""
        each = ("place", "motion")
        names = (*_BY_LOCK, *(() if self.touched is None else ("touched",)))
        values: dict[str, Any] = {name: ((*each, "locked"), getattr(self, name)) for name in names}
        values |= {"q0": ((*each, "joint"), self.q0), "target": ((*each, "row", "column"), self.target)}
        return self.places.dataset(values, locked=self.columns, joint=self.law.arm.joint_names)

    def describe(self) -> list[str]:
        """A few sentences for people."""
        runs = int(self.known.sum())
        lines = [
            f"{self.law.describe()} on {self.law.arm.title}: {int(self.known.any(axis=1).sum())} of {len(self.places)} "
            f"{self.over} with {runs} motions, {runs * len(self.columns)} runs, seed {self.seed}"
        ]
        if runs:
            converged, trapped = self.shares("converged"), self.shares("trapped")
            name = min(self.columns[:-1], key=lambda name: converged[name].value)
            worst = converged[name]
            lines.append(
                f"with {name} locked fewest converge: {100 * worst.value:.1f} % (95 % interval {100 * worst.low:.1f} to "
                f"{100 * worst.high:.1f} %); {100 * trapped[name].value:.1f} % do not, though the target is in reach"
            )
        counts = self.undecided()
        if sum(counts.values()):
            told = ", ".join(f"{count} {name.replace('_', ' ')}" for name, count in counts.items() if count)
            lines.append(f"undecided runs: {told}")
        return lines

    def undecided(self) -> dict[str, int]:
        """How many runs are undecided, by the name of the :class:`holdfast.simulation.Reason` in small letters."""
        return {r.name.lower(): int((self.reason == r).sum()) for r in UNDECIDED}


def shared(values: Array, each: int, confidence: float) -> Interval:
    """Mean of the shares (P,) of independent places, NaN left out, with its interval; of one motion each, or of several.

    Raises:
        InputError: No place has a share.
    """
    values = values[~np.isnan(values)]
    if not values.size:
        raise InputError("no configuration was found at any place, so there are no shares; choose places within reach")
    if each == 1:
        return Interval.of(int(values.sum()), values.size, confidence)
    return Interval.of_fractions(values, confidence)


@checked
@says("simulating failures")
def convergence_map(
    law: Law,
    targets: ArrayLike | str | int | Places,
    starts: ArrayLike | str | int | Places = 1000,
    *,
    configurations: int = 20,
    over: Over = "starts",
    q0: ArrayLike | None = None,
    time_limit: float | None = None,
    tolerance: float = TOLERANCE,
    seed: int = 0,
    progress: Progress | None = None,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
) -> ConvergenceMap:
    """How motions end when a joint is locked from the start and the controller does not know it, for each joint.

    Over ``starts``: from every place the arm starts in ``configurations`` configurations (with one degree of redundancy
    picked at random from points equally far apart on its self-motion, else random ones), towards the target, or one of the
    targets at random. Over ``targets``: towards every place it starts from ``configurations`` configurations picked at
    random from those of the starts, or from ``q0`` (all of them where they are fewer). Each motion is simulated with each
    joint locked, and with none.

    Args:
        law: The control law; of any arm, task and redundancy.
        targets: Where the end effector should go: one position (m,) or pose (4, 4), several, a number of random ones (the end
            effector's places at random configurations within the limits), or ``"grid:52"``, see :func:`holdfast.workspace`.
        starts: Where the end effector is when the joint locks, in the same forms.
        configurations: Motions for each place.
        over: Which of the two is the map.
        q0: (n,) or (Q, n) configurations to start from, in place of ``starts``; only over targets.
        time_limit: s; 500/Ke if not given.
        tolerance: Of the simulation's steps, rad.
        seed: Of everything random.
        progress: Called with (runs done, runs in all).
        clearance: As for :func:`holdfast.simulation.simulate`, and so ``cell``: every run is looked at, one after the
            other, for what it touches; that changes none, and takes longer than the runs themselves.
        cell: Objects around the arm, or their file.

    Raises:
        InputError: Wrong shapes or options.
        TaskError: A lattice for a task that has none.

    Source: the question is that of Goel, Maciejewski, Balakrishnan 2005; maps by sampling are ours.
    """
    if over not in ("starts", "targets"):
        raise InputError(f"over '{over}' is not known; use starts or targets")
    if configurations < 1:
        raise InputError(f"configurations is {configurations}; it must be 1 or more")
    if q0 is not None and over == "starts":
        raise InputError("q0 are fixed starts, so the map is one over='targets'; or leave out q0")
    arm, task = law.arm, law.task
    looked = chosen_clearance(arm, clearance or False, cell, looks=False)
    first, second, third = (np.random.default_rng(s) for s in np.random.SeedSequence(seed).spawn(3))
    goals = read_places(arm, task, targets, first)
    if over == "starts":
        places = read_places(arm, task, starts, second)
        q = _picked(law, places, configurations, seed, third)
        target = goals.poses[third.integers(0, len(goals), q.shape[:2])]
    else:
        places = goals
        if q0 is None:
            begin = read_places(arm, task, starts, second)
            pool = _picked(law, begin, configurations, seed, third).reshape(-1, arm.n)
            pool = pool[np.isfinite(pool).all(axis=1)]
        else:
            pool = as_configurations(arm, q0)[0]
        if not len(pool) or not np.isfinite(pool).all():
            raise InputError("there is no configuration to start from; choose starts within reach, or finite q0")
        # Few are all used, and none twice.
        each = min(configurations, len(pool))
        chosen = np.argsort(third.random((len(places), len(pool))), axis=1)[:, :each]
        q = pool[chosen]
        target = np.broadcast_to(places.poses[:, None], (*q.shape[:2], 4, 4))
    code, reason, in_reach, passed, touched = _run(law, q, target, time_limit, tolerance, seed, progress, looked)
    return ConvergenceMap(
        law=law,
        places=places,
        over=over,
        q0=q,
        target=np.asarray(target),
        code=code,
        reason=reason,
        in_reach=in_reach,
        limits_passed=passed,
        seed=seed,
        clearance=looked,
        touched=None if looked is None else touched,
    )


def _picked(law: Law, places: Places, count: int, seed: int, generator: np.random.Generator) -> Array:
    """(P, count, n) configurations of places, NaN where there are none."""
    q = np.full((len(places), count, law.arm.n), np.nan)
    owner, rank, found = picked_at(law.arm, law.task, places.poses, count, seed, generator)
    q[owner, rank] = found
    return q


def _run(
    law: Law,
    q: Array,
    target: Array,
    time_limit: float | None,
    tolerance: float,
    seed: int,
    progress: Progress | None,
    clearance: Clearance | None,
) -> tuple[NDArray[np.uint8], NDArray[np.uint8], Flags, Flags, Flags]:
    """Codes, reasons, and whether the target was in reach, limits were passed and something touched, (P, C, n + 1) each."""
    n = law.arm.n
    limit = TIME_CONSTANTS / law.gain if time_limit is None else float(time_limit)
    known = np.isfinite(q).all(axis=-1)
    start, pose = np.repeat(q[known], n + 1, axis=0), np.repeat(target[known], n + 1, axis=0)
    locked = np.tile([*range(n), -1], int(known.sum()))
    code, reason = (np.zeros(len(locked), dtype=np.uint8) for _ in range(2))
    passed, near, touched = (np.zeros(len(locked), dtype=bool) for _ in range(3))
    for at in range(0, len(locked), _SLICE):
        rows = slice(at, at + _SLICE)
        setting: dict[str, Any] = {"time_limit": limit, "tolerance": tolerance, "clearance": clearance}
        runs = simulate(law, start[rows], pose[rows], locked=locked[rows], **setting)
        touched[rows] = [contact is not None for contact in runs.first_contacts]
        code[rows], reason[rows], passed[rows] = runs.code, runs.reason, runs.limits_passed.any(axis=1)
        near[rows] = _in_reach(law, runs.code, start[rows], pose[rows], locked[rows], seed)
        if progress is not None:
            progress(min(at + _SLICE, len(locked)), len(locked))
    shape = (*known.shape, n + 1)
    results: list[Any] = []
    for values, fill in ((code, NONE), (reason, Reason.NONE), (near, False), (passed, False), (touched, False)):
        out = np.full(shape, fill, dtype=values.dtype)
        out[known] = values.reshape(-1, n + 1)
        results.append(out)
    return results[0], results[1], results[2], results[3], results[4]


def _in_reach(law: Law, code: NDArray[np.uint8], q: Array, pose: Array, locked: NDArray[np.int64], seed: int) -> Flags:
    """(N,) True where the target was reached, or a configuration on it is found with the joint locked."""
    found = np.asarray(code == Outcome.CONVERGED)
    engine = solver(law.arm.without_idle_limits, law.task)
    rows = np.flatnonzero(~found)
    standing = rows[locked[rows] >= 0]
    joints = locked[standing]
    if standing.size:
        angles = q[standing, joints]
        source = np.random.SeedSequence([seed, 1])
        found[standing] = engine.reaches_locked(pose[standing], joints, angles, source, RESTARTS, REACHED)
    healthy = rows[locked[rows] < 0]
    if healthy.size:
        found[healthy] = engine.solve(pose[healthy], np.random.SeedSequence([seed, 2]), RESTARTS, REACHED).success
    return found
