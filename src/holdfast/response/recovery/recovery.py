"""Result of a recovery."""

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
        answer: ``solved``: a motion was found and verified by independent code. ``proved infeasible``: no motion meets the
            request, up to floating point. ``argued infeasible``: every configuration that the search found is blocked, or none
            was found, which proves nothing. ``undecided``: the search ended, or its result was not verified.
        why: Proof, extent of the search, or stage at which the search ended; empty if solved.
        kind: Kind of the proof: ``start``, ``limits`` (of a joint that the goal itself names), ``reach bound``, ``boxes``, ``a
            pose of the path``, ``rows kept`` (a path constraint that the goal itself violates), ``disconnected`` (the goal
            from the start, or the end of a tool path from its beginning); empty without a proof.
    """

    answer: Answer
    why: str = ""
    kind: ProofKind | Literal[""] = ""

    @property
    def is_solved(self) -> bool:
        """True if the motion meets everything that was requested, confirmed by independent code."""
        return self.answer == "solved"

    def __str__(self) -> str:
        answer_text = f"{self.answer} ({self.kind})" if self.kind else self.answer
        return f"{answer_text}: {self.why}" if self.why else answer_text


class RecoveryOutcome(SentenceEnum):
    """Outcome of a recovery as one answer; rows of batches have a :class:`holdfast.Status`.

    Only ``GOAL_REACHED`` is success: the whole request is met, and nothing is relaxed.
    """

    GOAL_REACHED = 0, "the whole goal is met, within limits, locks and clearance"
    GOAL_REACHED_WITH_RELAXED_ROWS = (
        1,
        "the goal is NOT met as a whole; the motion leads to a configuration with relaxed rows",
    )
    PATH_UNFINISHED = 2, "the rest of the tool path is NOT finished; if a goal was given too, it is met"
    NO_ROUTE_FOUND = (
        3,
        "configurations of the goal were found, but NO motion to any of them; this does not prove that there is none; increase"
        " tries",
    )
    NOTHING_FOUND = (
        4,
        "NO configuration of the goal was found, not even with relaxed rows; this does not prove that there is none; increase"
        " starts",
    )
    PROVED_UNREACHABLE = 5, "the goal is PROVED unreachable, and no configuration was found with relaxed rows"
    START_OUTSIDE_LIMITS = 6, "no motion: the arm is outside its limits"
    START_TOO_CLOSE = (
        7,
        "no motion: the arm, or its collision model, is already closer to itself or its cell than the required clearance",
    )
    LOCK_MISMATCH = 8, "no motion: a joint does not have the value at which it is given as locked"
    START_VIOLATES_CONSTRAINTS = 9, "no motion: the start violates a constraint that holds along the whole motion"
    PROVED_DISCONNECTED = 10, "configurations of the goal exist, and NO motion leads to any of them, which is PROVED"

    @property
    def phrase(self) -> str:
        """Name of the outcome in words."""
        return self.name.lower().replace("_", " ")


_NO_CERTIFICATE_REASONS = {  # reason why a proof has no certificate, by its kind
    "": "nothing is proved to be unreachable",
    "start": "the proof is about the start, which follows from the arm's configuration and limits",
    "limits": "the goal names joints beyond their remaining limits, which needs no proof",
    "rows kept": "the goal violates a constraint of the motion, and certificates are about tool poses",
    "disconnected": "the proof is about motions between configurations, and certificates are about tool poses",
}


@dataclass(frozen=True, kw_only=True)
class Leg:
    """Part of the motion.

    Attributes:
        name: ``to the path``, ``along the path`` or ``to the goal``.
        first, last: Indices of its first and last waypoint.
        length: Length in the metric of the recovery, rad or s.
        lower_bound: Lower bound on the length of routes to the configurations found of its goal; there may be more of them.
        straight: True if the leg is one straight line in joint space.
    """

    name: str
    first: int
    last: int
    length: float
    lower_bound: float
    straight: bool


@dataclass(frozen=True, kw_only=True)
class Recovery(Result):
    """Motion and remaining capabilities of an arm with joints known to be locked; see :func:`holdfast.recover`.

    Attributes:
        degraded: Failed arm: each locked joint with its value, reduced ranges and speeds.
        at: (n,) start configuration, rad and m.
        goal: Goal as text.
        goal_pose: (4, 4) pose of the end effector in the world, m; of several poses the one to which the motion leads, else the
            first. None if only a tool path was requested.
        task: Task whose rows the end effector must meet.
        within: Angle in rad by which the tool's z axis may deviate from that of the goal's pose, with any rotation about it.
            None: the orientation rows of ``task`` apply.
        ending: Outcome, a :class:`holdfast.response.recovery.RecoveryOutcome`.
        reason: Obstacle to the goal, one sentence; empty if there is none.
        q: (K, n) waypoints, rad and m, with straight lines in joint space between them; (0, n) if there is no motion.
        timed: Timed motion within acceleration limits, with rounded corners; None without limits or without a motion.
        legs: Parts of the motion, in order.
        relaxed: Rows of the goal that the motion does not meet, with their errors; None if it meets all rows.
        choices: All minimal sets of rows that were found to relax, best first; empty if the goal is met.
        unknown: Unknown property of the arm's shape, one sentence, if only the collision model or an assumption prevents the
            requested motion; empty if nothing depends on it.
        proof: Proof that the request is infeasible, one sentence; else None.
        proof_kind: Kind of the proof; see :class:`holdfast.response.recovery.RecoveryVerdict`.
        proved_pose: (4, 4) pose of the tool path in the world, m, that is proved to have no configuration.
        closed_in: ``start`` or ``goal`` if the search along the constraint exhausted everything connected to this end.
        stopped: Stage at which the time limit ended the search; empty if it did not.
        verified: Independent verification of the motion; None without a motion.
        left: Remaining workspace, if requested.
        rest: Result along the tool path, if one was given.
        starts: Random starts of the search for configurations of the goal.
        found: Number of collision-free configurations of the goal that were found.
        metric: ``travel`` or ``time``.
        unit: Unit of lengths: ``rad`` (1 m of a prismatic joint counts as 1 rad) or ``s``.
        clearance: Collision model that kept at least ``margin`` to the arm itself and its cell, or None. With a cell it uses
            lower bounds of distances, or exact distances where the bounds find no motion.
        margin: Smallest clearance, m.
        keep: Tool constraints along the whole motion.
        tolerance: Allowed errors of the goal or the tool path, m and rad, if given.
        proved_within: True if the proof also holds for everything that misses the goal or the tool path by ``tolerance``.
        seed: Seed of the search; the same seed gives the same result.
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
            return RecoveryVerdict("undecided", f"a motion was found, but {self.verified}; please report this")
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
                f"the search along the constraint exhausted all that is connected to the {self.closed_in}, not {missing_end}",
            )
        if self.stopped:
            return RecoveryVerdict("undecided", f"the time limit ended the search {self.stopped}")
        if self.ending == RecoveryOutcome.NO_ROUTE_FOUND or (self.rest is not None and self.rest.cut_off):
            return RecoveryVerdict("undecided", "configurations were found, but all searches for a motion to them failed")
        if self.rest is not None and not self.rest.finished:
            return RecoveryVerdict("argued infeasible", self.rest.why)
        return RecoveryVerdict("argued infeasible", self.reason)

    @property
    def _tolerance_text(self) -> str:
        """Tolerance for which the proof holds, as text."""
        if self.tolerance is None:
            return ""
        tolerance_values = f"{1e3 * self.tolerance[0]:.4g} mm and {np.rad2deg(self.tolerance[1]):.4g} deg"
        return f"; {'this also holds' if self.proved_within else 'not proved'} for misses of up to {tolerance_values}"

    def require_ok(self) -> Recovery:
        """Return the recovery, or raise :class:`holdfast.HoldfastError` with the reason if the request is not met."""
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

        The proof is searched again, with equal limits for locked joints. Proofs about boxes of joints and about the arm's
        length have a certificate, for a goal or a pose of a tool path; for others the error states why there is none.

        Args:
            time_limit: Time limit of the search, s.

        Raises:
            InputError: There is no proof or one of another kind, the goal has several poses, or the proof needs the objects.
        """
        from holdfast.response.recovery.proofs.refuted_poses import certify_unreachable_pose

        pose = self.proved_pose if self.proof_kind == "a pose of the path" else self.goal_pose
        if self.proof_kind not in ("reach bound", "boxes", "a pose of the path") or pose is None:
            raise InputError(
                f"there is no certificate: {_NO_CERTIFICATE_REASONS.get(self.proof_kind, _NO_CERTIFICATE_REASONS['rows kept'])}"
            )
        if self.proof_kind != "a pose of the path" and self.goal.startswith("any of"):
            raise InputError("a certificate is about one pose, and the goal has several; request each of them alone")
        return certify_unreachable_pose(self.degraded, self.task, pose, time_limit)

    def to_csv(self, file: str | Path) -> Path:
        """Write the waypoints, or the timed motion, to the CSV file ``file``, and return its path.

        :func:`holdfast.response.recovery.read_waypoints` reads the file.

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
