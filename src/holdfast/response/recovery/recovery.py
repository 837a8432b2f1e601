"""The result of a recovery."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from holdfast.core.errors import HoldfastError, InputError, StoreError
from holdfast.core.result import Result
from holdfast.core.status import SentenceEnum
from holdfast.core.typing import FloatArray
from holdfast.kinematics.tool_constraints.constraint import ToolConstraint
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task
from holdfast.model.cell.cell import Cell
from holdfast.model.collision.clearance import Clearance
from holdfast.model.failure_modes import Degraded
from holdfast.response.recovery.continuation import RestOfPath
from holdfast.response.recovery.goals import RelaxedRows
from holdfast.response.recovery.space import MetricName
from holdfast.response.recovery.timing.motion import TimedMotion
from holdfast.response.recovery.verification import Verification
from holdfast.response.recovery.waypoints import WaypointCheck, check_waypoints, write_waypoints
from holdfast.response.recovery.workspace_after_failure import RemainingWorkspace

if TYPE_CHECKING:
    from holdfast.certificates.joint_boxes.refutations import Refutation

Answer = Literal["solved", "proved infeasible", "argued infeasible", "undecided"]
ProofKind = Literal["start", "limits", "reach bound", "boxes", "a pose of the path", "rows kept", "disconnected"]


@dataclass(frozen=True)
class RecoveryVerdict:
    """Feasibility of everything that was requested, and its justification.

    Attributes:
        answer: ``is_solved``: a motion was found and verified by other code. ``proved infeasible``: none does it, up to
            floating point. ``argued infeasible``: every configuration that the search found is blocked, or none was found,
            which proves nothing. ``undecided``: the search was spent, or what it found was not verified.
        why: The proof, what was searched, or at which level the search was spent; empty if solved.
        kind: Of the proof: ``start``, ``limits`` (of a joint that the goal itself names), ``reach bound``, ``boxes``, ``a pose
            of the path``, ``rows kept`` (all the way, which the goal itself breaks), ``disconnected`` (the goal from the
            start, or the end of a tool path from its beginning); empty if there is none.
    """

    answer: Answer
    why: str = ""
    kind: ProofKind | Literal[""] = ""

    @property
    def is_solved(self) -> bool:
        """True if the motion does everything that was requested, confirmed by independent code."""
        return self.answer == "solved"

    def __str__(self) -> str:
        answer_text = f"{self.answer} ({self.kind})" if self.kind else self.answer
        return f"{answer_text}: {self.why}" if self.why else answer_text


class RecoveryOutcome(SentenceEnum):
    """Outcome of a recovery as one answer; rows of batches have a :class:`holdfast.Status`.

    Only ``GOAL_REACHED`` is success: all that was asked for, nothing dropped.
    """

    GOAL_REACHED = 0, "the whole goal is met, within limits, locks and clearance"
    GOAL_REACHED_WITH_RELAXED_ROWS = (
        1,
        "the goal is NOT met as a whole: a motion was found to a configuration that gives rows up",
    )
    PATH_UNFINISHED = 2, "the rest of the tool path is NOT finished; if a goal was given too, it is met"
    NO_ROUTE_FOUND = (
        3,
        "configurations of the goal were found, but NO motion to any of them; this does not prove that there is none: give more"
        " tries",
    )
    NOTHING_FOUND = (
        4,
        "NO configuration of the goal was found, not even with rows given up; this does not prove that there is none: give more"
        " starts",
    )
    PROVED_UNREACHABLE = 5, "the goal is PROVED out of reach, and no configuration was found with rows given up"
    START_OUTSIDE_LIMITS = 6, "no motion: the arm is outside its limits"
    START_TOO_CLOSE = (
        7,
        "no motion: the arm, or what covers it, is already closer to itself or its cell than the clearance that must be kept",
    )
    LOCK_MISMATCH = 8, "no motion: a joint is not where it is said to be locked"
    START_VIOLATES_CONSTRAINTS = 9, "no motion: where the arm is breaks a row that must be kept all the way"
    PROVED_DISCONNECTED = 10, "configurations of the goal exist, and NO motion leads to any of them, which is PROVED"

    @property
    def phrase(self) -> str:
        """Name of the outcome in words."""
        return self.name.lower().replace("_", " ")


_NO_CERTIFICATE_REASONS = {  # why a proof has no certificate, by its kind
    "": "nothing is proved to be out of reach",
    "start": "the proof is about where the arm is, which its file and its limits tell",
    "limits": "the goal names joints beyond what is left of their limits, which needs no proof",
    "rows kept": "the goal breaks what must be kept all the way, and certificates are about where the tool can be",
    "disconnected": "the proof is about a way between configurations, and certificates are about where the tool can be",
}


@dataclass(frozen=True, kw_only=True)
class Leg:
    """A part of the motion.

    Attributes:
        name: ``to the path``, ``along the path`` or ``to the goal``.
        first, last: Of its waypoints.
        length: Of the metric.
        lower_bound: No route to any of the configurations found of its goal is shorter; more configurations may exist.
        straight: It is one straight line in joint space.
    """

    name: str
    first: int
    last: int
    length: float
    lower_bound: float
    straight: bool


@dataclass(frozen=True, kw_only=True)
class Recovery(Result):
    """Remaining capabilities of an arm with joints known to be locked; see :func:`holdfast.recover`.

    Attributes:
        degraded: What is left of the arm: each locked joint with its value, reduced ranges and speeds.
        at: (n,) where the arm is, rad and m.
        goal: What was asked for, for people.
        goal_pose: (4, 4) of the end effector, m, world: of several the one that the motion leads to, else the first; None if
            only a tool path was asked for.
        task: Whose rows the end effector must meet.
        within: Angle in rad by which the tool's z axis may be off that of the goal's pose, any turn about it allowed; None: the
            orientation counts as in ``task``.
        ending: :class:`holdfast.response.recovery.RecoveryOutcome`.
        reason: What is in the way, a sentence; empty if nothing is.
        q: (K, n) waypoints, rad and m, joints moving in straight lines between them; (0, n) if there is no motion.
        timed: The same motion within accelerations, its corners rounded; None if none were given, or if there is no motion.
        legs: The parts of the motion, in order.
        relaxed: Rows of the goal that the motion gives up, with what they miss; None if it gives up none.
        choices: Every minimal set of rows found to give up, best first; empty where the goal is met.
        unknown: What is not known of the arm's shape, a sentence, where only a cover or an assumption is in the way of what was
            asked for; empty if nothing depends on that.
        proof: Why not everything that was asked for can be done, if that is proved; else None.
        proof_kind: Of the proof; see :class:`holdfast.response.recovery.RecoveryVerdict`.
        proved_pose: (4, 4) of the end effector, m, world: the pose of the tool path that is proved to have no configuration.
        closed_in: ``start`` or ``goal`` if what was searched from there along the rows kept could not grow any more.
        stopped: At which level the time limit was spent; empty if it was not.
        verified: What other code finds of the motion; None if there is none.
        left: What is left of the workspace, if asked for.
        rest: What became of the tool path, if one was given.
        starts: Random starts of the search for configurations of the goal.
        found: Configurations of the goal that were found and are clear.
        metric: ``travel`` or ``time``.
        unit: Of lengths: ``rad`` (1 m of a slide counts as 1 rad) or ``s``.
        clearance: Whose room was kept at least at ``margin``, of the arm from itself and its cell, or None. With a cell it is
            the bound, or where that leaves less exact distances.
        margin: m.
        keep: What is kept along the whole motion.
        tolerance: m and rad by which the goal or the tool path may be missed, if that was said.
        proved_within: The proof holds, too, for all that misses the goal or the tool path by no more.
        seed: The same seed gives the same result.
    """

    degraded: Degraded
    at: FloatArray
    goal: str
    goal_pose: FloatArray | None
    task: Task
    within: float | None = None
    ending: RecoveryOutcome = RecoveryOutcome.GOAL_REACHED
    reason: str = ""
    q: FloatArray
    timed: TimedMotion | None = None
    legs: tuple[Leg, ...] = ()
    relaxed: RelaxedRows | None = None
    choices: tuple[RelaxedRows, ...] = ()
    unknown: str = ""
    proof: str | None = None
    proof_kind: ProofKind | Literal[""] = ""
    proved_pose: FloatArray | None = None
    closed_in: Literal["", "start", "goal"] = ""
    stopped: str = ""
    verified: Verification | None = None
    left: RemainingWorkspace | None = None
    rest: RestOfPath | None = None
    starts: int
    found: int = 0
    metric: MetricName
    unit: str
    clearance: Clearance | None
    margin: float
    keep: tuple[ToolConstraint, ...] = ()
    tolerance: tuple[float, float] | None = None
    proved_within: bool = False
    seed: int

    @property
    def arm(self) -> Arm:
        """Healthy arm."""
        return self.degraded.arm

    @property
    def locked(self) -> dict[str, float]:
        """Value of each locked joint by name, rad or m."""
        return {name: value for name, value in self.degraded.locked.items() if value is not None}

    @property
    def cell(self) -> Cell | None:
        """Objects around the arm."""
        return None if self.clearance is None else self.clearance.cell

    @property
    def ok(self) -> bool:
        """True only if everything that was requested is met, confirmed by independent code."""
        return self.verdict.is_solved

    @property
    def verdict(self) -> RecoveryVerdict:
        """Feasibility of everything that was requested, and its justification."""
        if self.ending == RecoveryOutcome.GOAL_REACHED:
            if self.verified is None or self.verified.ok:
                return RecoveryVerdict("solved")
            return RecoveryVerdict("undecided", f"a motion was found, and {self.verified}; please report this")
        if self.proof_kind and self.proof_kind != "start":
            return RecoveryVerdict("proved infeasible", f"{self.proof or ''}{self._tolerance_text}", self.proof_kind)
        if self.proof_kind == "start":
            return RecoveryVerdict("proved infeasible", self.reason, "start")
        if self.unknown:
            return RecoveryVerdict("undecided", self.unknown)
        if self.closed_in:
            missing_end = "the goal" if self.closed_in == "start" else "the start"
            return RecoveryVerdict(
                "argued infeasible",
                f"searched along the rows kept, what the {self.closed_in} is joined to grows no more, without {missing_end}",
            )
        if self.stopped:
            return RecoveryVerdict("undecided", f"the time limit was spent {self.stopped}")
        if self.ending == RecoveryOutcome.NO_ROUTE_FOUND or (self.rest is not None and self.rest.cut_off):
            return RecoveryVerdict("undecided", "configurations were found, and the searches for a motion to them are spent")
        if self.rest is not None and not self.rest.finished:
            return RecoveryVerdict("argued infeasible", self.rest.why)
        return RecoveryVerdict("argued infeasible", self.reason)

    @property
    def _tolerance_text(self) -> str:
        """Tolerance for which the proof holds, as text."""
        if self.tolerance is None:
            return ""
        tolerance_values = f"{1e3 * self.tolerance[0]:.4g} mm and {np.rad2deg(self.tolerance[1]):.4g} deg"
        return f"; {'so is' if self.proved_within else 'not proved of'} what misses it by {tolerance_values}"

    def require_ok(self) -> Recovery:
        """Return the recovery, or raise :class:`holdfast.HoldfastError` with the reason if anything was dropped."""
        if not self.ok:
            raise HoldfastError(f"recovery: {self.ending.sentence}{f' ({self.reason})' if self.reason else ''}")
        return self

    @property
    def length(self) -> float:
        """Length of the whole motion, in ``unit``; 0 if there is none."""
        return sum(leg.length for leg in self.legs)

    @property
    def lower_bound(self) -> float:
        """Sum of the lower bounds of the legs, in ``unit``: no motion between the chosen ends is shorter."""
        return sum(leg.lower_bound for leg in self.legs)

    def certificate(self, *, time_limit: float | None = 60.0) -> Refutation:
        """Return the proof that the goal has no configuration, as a certificate for the verifier: ``.write(file)``.

        It is searched for anew, with the joints that are locked at equal limits. Proofs about boxes of joints and about the
        arm's length have one, of a goal and of a pose of a tool path; others say why they have none.

        Args:
            time_limit: s.

        Raises:
            InputError: A proof of another kind, or none, a goal of several poses, or nothing proved of the arm alone.
        """
        from holdfast.response.recovery.proofs.refuted_poses import certify_unreachable_pose

        pose = self.proved_pose if self.proof_kind == "a pose of the path" else self.goal_pose
        if self.proof_kind not in ("reach bound", "boxes", "a pose of the path") or pose is None:
            raise InputError(
                f"there is no certificate: {_NO_CERTIFICATE_REASONS.get(self.proof_kind, _NO_CERTIFICATE_REASONS['rows kept'])}"
            )
        if self.proof_kind != "a pose of the path" and self.goal.startswith("any of"):
            raise InputError("a certificate is about one pose, and the goal is several; ask for each of them")
        return certify_unreachable_pose(self.degraded, self.task, pose, time_limit)

    def to_csv(self, file: str | Path) -> Path:
        """Write the waypoints, or the timed motion; see :func:`holdfast.response.recovery.read_waypoints`.

        Raises:
            StoreError: There is no motion, or the file cannot be written.
        """
        if not len(self.q):
            raise StoreError(f"there are no waypoints to write: {self.ending.sentence}")
        if self.timed is not None:
            return self.timed.to_csv(file)
        return write_waypoints(self.degraded.limited, self.q, file)

    def check(self) -> WaypointCheck:
        """Replay the waypoints in small steps, or the timed motion; see :func:`holdfast.response.recovery.check_waypoints`.

        Raises:
            InputError: There is no motion.
        """
        timed = self.timed
        return check_waypoints(
            self.arm,
            self.q if timed is None else timed.q,
            self.degraded,
            clearance=self.clearance,
            margin=self.margin,
            keep=self.keep,
            time=None if timed is None else timed.time,
            accelerations=None if timed is None else timed.accelerations,
        )
