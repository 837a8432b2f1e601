"""Over a workspace: from which starts a target is still reached when a joint locks on the way and nobody knows."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.control.law import Law
from holdfast.convergence.analysis import (
    ARRIVING,
    CELLS,
    ENDS,
    NO_SINK,
    TOLERANCE,
    Beginnings,
    Job,
    Method,
    RelativeTo,
    prepared,
    usual_method,
)
from holdfast.convergence.measures import FINISH, NAMES, REACH, Arcs, Measures
from holdfast.convergence.places import Places, read_places
from holdfast.engine.store import Store
from holdfast.errors import InputError
from holdfast.notice import says
from holdfast.probability.intervals import Interval, check_confidence
from holdfast.registry import LAWS
from holdfast.result import Result
from holdfast.simulation.runs import Outcome

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
Progress = Callable[[int, int], None]

LATTICE: tuple[str | int, int, int] = ("grid", 36, 10)  # starts, configurations and points where starts are a lattice
SAMPLE: tuple[str | int, int, int] = (100, 8, 3)  # and where they are sampled
_CHUNK = 128  # starts analysed together and stored as one; no result depends on it


@dataclass(frozen=True, eq=False, kw_only=True)
class Workspace(Result):
    """Measures of the paper for P starts; the last column of each (P, n + 1) array is for an arbitrary joint.

    Attributes:
        law: The law of the controller.
        target: (4, 4) tool pose; only the rows of the task count.
        places: Where the end effector starts, a :class:`holdfast.convergence.Places`.
        bounds: Of each joint the arcs (lower, upper), rad, in which it may lock and the target stays in reach.
        method: ``brute``, ``procedure`` or ``sampled``.
        relative_to: What ``finish`` is a share of: the part of a motion ``inside`` the bounds, or the ``whole``.
        configurations: (P,) starting configurations that were looked at; 0 where the place is out of reach.
        lost: (P,) of them, those whose healthy motion ran into a singular configuration; left out of everything.
        reach: R100, Ravg, Rsens: of the share of a motion from which the target stays in reach, percent.
        finish: F100, Favg, Fsens: of the share of it from which the failed arm reaches the target, percent; undecided runs left
            out.
        ends: (P, 6) how the failures ended: converged, stuck, moving, undecided; arriving, which is undecided at the time
            limit but next to a solution that attracts; and not simulated because the joint locked where there is no sink.
    """

    law: Law
    target: Array
    places: Places
    bounds: tuple[tuple[tuple[float, float], ...], ...]
    method: Method
    relative_to: RelativeTo
    configurations: NDArray[np.int64]
    lost: NDArray[np.int64]
    reach: Measures
    finish: Measures
    ends: NDArray[np.int64]

    @property
    def columns(self) -> tuple[str, ...]:
        """What the columns of the measures are: the joints by name, and ``any``, an arbitrary one."""
        return (*self.law.arm.joint_names, "any")

    @property
    def measures(self) -> dict[str, Array]:
        """R100, Ravg, Rsens, F100, Favg and Fsens by name, (P, n + 1) each, percent."""
        return dict(zip(NAMES, (*self.reach.parts, *self.finish.parts), strict=True))

    @property
    def simulated(self) -> int:
        """Failures that were simulated."""
        return int(self.ends[:, :NO_SINK].sum())

    @property
    def undecided(self) -> float:
        """Share of the simulated failures that were undecided at the time limit; NaN if there is none."""
        return float(self.ends[:, [Outcome.UNDECIDED, ARRIVING]].sum() / self.simulated) if self.simulated else float("nan")

    @property
    def saved(self) -> float:
        """Share of the failures that did not have to be simulated, because the joint locked where there is no sink."""
        every = int(self.ends.sum())
        return float(self.ends[:, NO_SINK].sum() / every) if every else float("nan")

    def means(self) -> dict[str, Array]:
        """Mean of every measure over the starts that have it, (n + 1,) each, percent."""
        return {name: mean_over(values, 0) for name, values in self.measures.items()}

    def intervals(self, confidence: float = 0.95) -> dict[str, Array]:
        """How sure the means are for starts that are a random sample: (n + 1, 2) each, lower and upper end, percent.

        The unit is the start: configurations and failures of one start are alike, and however many there are, they only
        make its own value more exact. The intervals always cover, and are wide for few starts
        (:meth:`holdfast.probability.Interval.of_fractions`). NaN where no start has a value.
        """
        check_confidence(confidence)
        return {name: mean_intervals(values, confidence) for name, values in self.measures.items()}

    def throughout(self, name: str = "R100", confidence: float = 0.95) -> tuple[Interval, ...]:
        """Share of the starts, for each column, at which R100 (or F100) is 100: whatever their configuration.

        Only the configurations that were looked at are known, so that this is an upper bound of the share of starts at which
        it holds for every configuration of the self-motion. The interval is exact; NaN where no start has the measure.

        Raises:
            InputError: Another name.
        """
        check_confidence(confidence)
        if name not in (REACH[0], FINISH[0]):
            raise InputError(f"'{name}' is not known; use R100 or F100")
        values = self.measures[name]
        known = (~np.isnan(values)).sum(axis=0).tolist()
        hits = (values >= 100 - 1e-9).sum(axis=0).tolist()
        none = Interval(value=np.nan, low=np.nan, high=np.nan, confidence=confidence)
        return tuple(Interval.of(h, k, confidence) if k else none for h, k in zip(hits, known, strict=True))

    def to_xarray(self) -> xr.Dataset:
        """The measures, percent, by start and joint (the last is ``any``), and of each start its place and its counts."""
        values: dict[str, Any] = {name: (("place", "joint"), v, {"units": "percent"}) for name, v in self.measures.items()}
        values |= {"configurations": ("place", self.configurations), "lost": ("place", self.lost)}
        values["ends"] = (("place", "ending"), self.ends)
        return self.places.dataset(values, joint=self.columns, ending=ENDS)

    def describe(self) -> list[str]:
        """A few sentences for people."""
        reached = int((self.configurations > 0).sum())
        lines = [
            f"{self.law.describe()} on {self.law.arm.title}: {reached} of {len(self.places)} starts in reach, "
            f"{int(self.configurations.sum())} configurations, {int(self.lost.sum())} lost at singular configurations"
        ]
        ends = dict(zip(ENDS, self.ends.sum(axis=0).tolist(), strict=True))
        if self.ends.sum():
            told = ", ".join(f"{ends[name]} {name}" for name in ENDS[:3])
            share = f" ({100 * self.undecided:.2f} %)" if self.simulated else ""
            lines.append(
                f"{self.simulated} failures simulated: {told}, {ends['undecided'] + ends['arriving']} undecided at the time "
                f"limit{share}, of which {ends['arriving']} next to a solution that attracts, counted as converged"
            )
        if self.method == "procedure":
            lines.append(
                f"{ends['no_sink']} more were not simulated ({100 * self.saved:.2f} %): the joint locked away from every sink, "
                "which makes convergence very likely but does not prove it"
            )
        return lines


@checked
@says("simulating failures")
def workspace(
    law: Law,
    target: ArrayLike,
    starts: ArrayLike | str | int | Places | None = None,
    *,
    configurations: int | None = None,
    points: int | None = None,
    method: Method | None = None,
    cells: int = CELLS,
    time_limit: float | None = None,
    tolerance: float = TOLERANCE,
    relative_to: RelativeTo = "inside",
    sinks: Mapping[int, Arcs] | None = None,
    seed: int = 0,
    store: str | Path | None = None,
    progress: Progress | None = None,
) -> Workspace:
    """From which starts a target is still reached when a joint locks on the way and the controller does not know it.

    From every start the arm moves to the target from configurations equally far apart along its self-motion, in joint
    space; the way is cut into ``cells`` of equal length of the end effector's path, looked at in their middle. A joint that
    locks where its value is in the range of the target's self-motion (:func:`holdfast.joint_bounds`) leaves the target in
    reach: R100 is the share of the configurations for which that holds on the whole way, Ravg the mean share of the way, Rsens
    its greatest minus its least value. At ``points`` of the part inside, for each joint, the failure is simulated
    (:func:`holdfast.simulation.simulate`): F100, Favg and Fsens are the same of the share of that part from which the failed
    arm reaches the target. *Any* joint: all joints must be inside, and the arm must reach the target whichever fails.

    Near the very ends of a range the arm converges ever more slowly. A failure that is undecided at the time limit
    counts as converged if it is next to a solution all of whose eigenvalues attract; else it is left out of F. Both are
    counted in ``ends``.

    Of the part inside for a joint, the piece that is inside for all joints is sampled with ``points`` points and the rest
    in proportion; both are weighted by their lengths.

    **By sampling** (``method="sampled"``), for any redundant arm and task: of every start up to
    ``configurations`` random configurations, with one degree of redundancy from points equally far apart on its curves, with
    more those at which inverse kinematics converges from random starts, which are not spread evenly over the manifold. The
    measures are the same, with the configurations that were drawn in place of all: Rsens and Fsens are then too small rather
    than too great, R100 and F100 of a start are estimates of shares, and that they are 100 is necessary, not sufficient, for
    every configuration to do (:meth:`holdfast.Workspace.throughout`). How sure the means over random starts are is told by
    :meth:`holdfast.Workspace.intervals`.

    Args:
        law: The control law.
        target: (m,) position, or (4, 4) pose, as in :func:`holdfast.simulation.simulate`.
        starts: ``"grid:52"``, a lattice of 52 points along the edge of the square about the workspace (tasks in a plane; 2032
            places, as in the paper); a number of random places (where the end effector is at random configurations); or (P, m)
            positions or (P, 4, 4) poses. If not given: the lattice, or 100 random ones where there is none.
        configurations: On each curve of the self-motion of a start; of each start, by sampling or with more than one degree
            of redundancy. 36 on a lattice, else 8, if not given.
        points: Failures of each joint on each motion, at most; 0 leaves F out. 10, or 3, if not given.
        method: ``brute`` simulates every failure; ``procedure`` only those that lock where there is a sink; ``sampled`` every
            failure of random configurations. If not given: ``brute`` for a task in a plane, else ``sampled``.
        cells: Of the way.
        time_limit: s; 2000/Ke if not given.
        tolerance: Of the simulation's steps, rad.
        relative_to: ``inside``: F of the part inside, as in the paper; configurations without any are left out. ``whole``:
            of the whole way.
        sinks: For the procedure, of joints (from 0), the arcs of locked values at which failures are simulated, rad. If not
            given: where :func:`holdfast.stationary_points` finds sinks and whole curves of stationary points, and 0.02 rad on
            either side of Hopf points, beside which limit cycles live.
        seed: Of the search for configurations, and of random starts.
        store: A folder to keep the results in; a stopped analysis resumes there.
        progress: Called with (starts done, starts in all).

    Raises:
        InputError: Wrong shapes or options, a target out of reach, or the procedure where stationary points form surfaces.
        TaskError: An arm without redundancy for the task.
        StoreError: A folder of another analysis, or one that cannot be written.

    Source: Goel, Maciejewski, Balakrishnan 2005, section on the analysis of a workspace. A way's length is that of the end
    effector's
    path: the paper does not define it. Sampling and its intervals are ours.
    """
    if store is not None:
        LAWS.label(law)  # says so where there is none
    chosen = usual_method(law) if method is None else method
    usual = LATTICE if usual_method(law) == "brute" else SAMPLE
    each = usual[1] if configurations is None else configurations
    failures = usual[2] if points is None else points
    places = read_places(law.arm, law.task, usual[0] if starts is None else starts, np.random.default_rng(seed))
    job = prepared(law, target, each, failures, chosen, cells, time_limit, tolerance, relative_to, sinks, seed)
    if not job.reached:
        place = ", ".join(f"{x:g}" for x in job.pose[:3, 3])
        raise InputError(
            f"no configuration of '{law.arm.name}' was found at the target ({place}) m; choose one within its reach"
        )
    return analysed(job, Beginnings(law, places, each, chosen, seed), store, progress)


def analysed(job: Job, begin: Beginnings, store: str | Path | None = None, progress: Progress | None = None) -> Workspace:
    """The analysis of one target, some starts at a time."""
    places, count = begin.places, len(begin.places)
    folder = None
    if store is not None:
        folder = Store.create(
            store,
            job.plan(places),
            job.store_columns(),
            rows=count,
            chunk=_CHUNK,
            formerly=job.law.formerly(job.law.describe()),
        )
    chunks: list[dict[str, NDArray[Any]]] = []
    for k, first in enumerate(range(0, count, _CHUNK)):
        stop = min(first + _CHUNK, count)
        if folder is not None and k in folder.done:
            rows = folder.read(k, job.names)
        else:
            rows = job.analyse(*begin.of(first, stop), stop - first)
            if folder is not None:
                with folder.writing():
                    folder.write(k, rows)
        chunks.append(rows)
        if progress is not None:
            progress(stop, count)
    found = {name: np.concatenate([rows[name] for rows in chunks]) for name in job.names}
    return Workspace(
        law=job.law,
        target=job.pose,
        places=places,
        bounds=job.bounds,
        method=job.method,
        relative_to=job.relative_to,
        configurations=found["configurations"],
        lost=found["lost"],
        reach=Measures(*(found[name] for name in REACH)),
        finish=Measures(*(found[name] for name in FINISH)),
        ends=found["ends"],
    )


def mean_intervals(values: Array, confidence: float) -> Array:
    """(C, 2) ends of the intervals of the means of the columns of values (P, C), percent, of P independent places."""
    out = np.full((values.shape[1], 2), np.nan)
    for k, column in enumerate(values.T):
        if not np.isnan(column).all():
            one = Interval.of_fractions(np.clip(column[~np.isnan(column)] / 100, 0.0, 1.0), confidence)
            out[k] = 100 * one.low, 100 * one.high
    return out


def mean_over(values: Array, axis: int) -> Array:
    """Mean along an axis of the values that are not NaN; NaN where there is none."""
    known = ~np.isnan(values)
    count = known.sum(axis=axis)
    return np.where(count > 0, np.where(known, values, 0.0).sum(axis=axis) / np.maximum(count, 1), np.nan)
