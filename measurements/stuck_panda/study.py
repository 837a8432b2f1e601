"""What is computed: maps of outcomes under several laws, and stationary points with the elbow locked."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

import holdfast as hf
from holdfast.control import Law
from holdfast.control.equilibria import Kind, StationaryPoints, idle_joints
from holdfast.control.simulation import Reason, RunOutcome

Array = NDArray[np.float64]

ARM = "panda"
ELBOW = 3  # joint 4
TASKS = ("position", "pose")
DAMPING = 0.1
PRE_FAILURE = (0.1, 0.5, 0.9)  # each is a law of its own to compile, on the pose task for half a minute
SHOWN = ("pseudoinverse", f"damped {DAMPING:g}", "tolerant 0.5")  # joint by joint
TIME_LIMIT = 500.0  # 1/Ke
SEED = 1
ANGLES = (-165.0, -140.0, -115.0, -90.0, -65.0, -40.0, -15.0)  # of the elbow, deg
STARTS = 100  # random ones for each of them
SAME, LEVEL = 1e-2, 1e-4  # rad (an end is at a point), m and rad (or has the error of a continuum)


@cache
def arm() -> hf.Arm:
    """The arm."""
    return hf.arms.load(ARM)


def target() -> Array:
    """(4, 4) pose of the tool at the arm's home configuration: in front of it, pointing down."""
    return np.asarray(arm().forward_kinematics(np.array(hf.arms.about(ARM).home)))


def laws(task: str) -> dict[str, Law]:
    """The laws compared, by name."""
    found: dict[str, Law] = {
        SHOWN[0]: hf.control.pseudoinverse(arm(), task),
        SHOWN[1]: hf.control.damped(arm(), DAMPING, task),
    }
    return found | {f"tolerant {e:g}": hf.control.failure_tolerant(arm(), task, e) for e in PRE_FAILURE}


def choose(task: str, places: int, configurations: int = 2) -> hf.LawChoice:
    """Every law on the same motions to the target: from random places, with each joint locked, and with none."""
    return hf.compare_laws(
        laws(task), places, target(), best=True, configurations=configurations, time_limit=TIME_LIMIT, seed=SEED
    )


@dataclass(frozen=True)
class Against:
    """One law against another: paired difference of the share that arrives, its interval, and how far undecided runs could "
    "move it.

    Attributes:
        value, low, high: Of the shares over all joints, with undecided runs counted as not arrived; 95 % interval.
        worst, best: The value if all undecided runs with the target in reach arrived under the other law and none under this,
            and the other way round.
    """

    value: float
    low: float
    high: float
    worst: float
    best: float


def against(choice: hf.LawChoice, name: str, other: str) -> Against:
    """See :class:`Against`."""
    d = choice.difference(name, other)
    return Against(d.value, d.low, d.high, d.value - open_share(choice, other), d.value + open_share(choice, name))


def open_share(choice: hf.LawChoice, name: str) -> float:
    """Share of the failures that were undecided though the target was in reach."""
    m = choice.map_of(name)
    return float(((m.code == RunOutcome.UNDECIDED) & m.in_reach)[m.has_configuration][:, :-1].mean())


# ---- stationary points with the elbow locked ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class Elbow:
    """Stationary points with the elbow at an angle, and what random starts did.

    Attributes:
        task, law: Of the controller, by name.
        angle: Of the elbow, deg.
        points: Found from random starts of Newton's method.
        outcomes: Of the runs.
        reasons: Of the undecided ones.
        isolated, continuum, elsewhere: Stuck runs that ended at an isolated point found before; with the error of an attracting
            continuum; and neither.
        errors: (S,) of the stuck runs at their end, m and rad.
        excess: (S,) of these, how much less it could have been.
    """

    task: str
    law: str
    angle: float
    points: StationaryPoints
    outcomes: Counter[str]
    reasons: Counter[str]
    isolated: int
    continuum: int
    elsewhere: int
    errors: Array
    excess: Array

    @property
    def isolated_kinds(self) -> Counter[str]:
        """Kinds of the isolated erroneous points."""
        p = self.points
        return Counter(k for k, loose in zip(p.kinds, p.continuum, strict=True) if not loose and k != Kind.SOLUTION.word)

    @property
    def levels(self) -> tuple[Array, Array]:
        """Errors, to 1e-3, of erroneous continua; and of those of them that attract."""
        p = self.points
        wrong = p.continuum & (p.kind != Kind.SOLUTION)
        every, attracting = (np.unique(np.round(p.error[wrong & rows], 3)) for rows in (wrong, p.attracting))
        return every, attracting


def elbow(task: str, name: str, angle: float, starts: int = STARTS) -> Elbow:
    """With the elbow at an angle, deg, under a law."""
    law = laws(task)[name]
    points = hf.stationary_points(law, target(), {ELBOW: np.deg2rad(angle)}, seed=SEED)
    rng = np.random.default_rng(SEED)
    q0 = rng.uniform(arm().lower, arm().upper, (starts, arm().n))
    q0[:, ELBOW] = np.deg2rad(angle)
    runs = hf.simulate(law, q0, target(), locked=[ELBOW], time_limit=TIME_LIMIT)
    stuck = runs.code == RunOutcome.STUCK
    alone, level = explained(points, runs.q_final[stuck], runs.error[stuck])
    return Elbow(
        task,
        name,
        angle,
        points,
        Counter(map(str, runs.outcome)),
        Counter(Reason(r).name.lower() for r in runs.reason[runs.code == RunOutcome.UNDECIDED]),
        int(alone.sum()),
        int(level.sum()),
        int((~alone & ~level).sum()),
        runs.error[stuck],
        runs.excess_error[stuck],
    )


def explained(points: StationaryPoints, q: Array, error: Array) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Of ends (S, n) with errors (S,): at an isolated point; else, with the error of a continuum that attracts."""
    q = q.copy()
    q[:, list(idle_joints(points.law))] = 0.0  # as stationary points have them
    wrong = points.kind != Kind.SOLUTION
    alone = np.zeros(len(q), dtype=bool)
    among = points.q[wrong & ~points.continuum]
    if len(among) and len(q):
        apart = (q[:, None] - among + np.pi) % (2 * np.pi) - np.pi
        alone = np.asarray(np.linalg.norm(apart, axis=2).min(axis=1) < SAME)
    levels = points.error[wrong & points.continuum & points.attracting]
    level = (np.abs(error[:, None] - levels) < LEVEL).any(axis=1)
    return alone, np.asarray(level & ~alone)
