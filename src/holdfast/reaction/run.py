"""What became of an arm with faults: what happened, what was noticed, and what was done about it."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from holdfast.caching import cached_property
from holdfast.clearance.contacts import Contact, first_contacts
from holdfast.errors import HoldfastError
from holdfast.failures import Degraded
from holdfast.faults.events import FaultEvents
from holdfast.faults.log import Log
from holdfast.files.output import write_table
from holdfast.paths.joint_table import joint_columns
from holdfast.physics.body import Body
from holdfast.physics.servos import Servos
from holdfast.result import Result

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.clearance.clearance import Clearance
    from holdfast.control.law import Law
    from holdfast.diagnosis.kinds import Verdict

Array = NDArray[np.float64]
React = Literal["none", "stop", "chain", "known"]
Ended = Literal["reached", "stopped", "missed", "unstable"]
What = Literal["alarm", "slow", "resume", "brake", "release", "measure", "detour", "plan", "stop"]

_ENDS = {
    "reached": "the tool reached its target",
    "stopped": "the controller stopped the arm before the target",
    "missed": "the tool did not reach its target",
    "unstable": "the physics left all bounds; make the servos softer or their rate higher",
}
_REACTS = {
    "none": "nobody notices",
    "stop": "everything stops at an alarm",
    "chain": "the controller reacts to what the monitor names",
    "known": "every fault is known at once",
}


@dataclass(frozen=True)
class Action:
    """One thing that the controller did.

    Attributes:
        time: s.
        what: ``alarm``, ``slow``, ``resume``, ``brake`` (and leave the joint out of the law), ``release`` (it is tried again),
            ``measure`` (where a braked joint is, by the tool), ``detour`` (by another posture), ``plan`` (a route) or ``stop``.
        why: A phrase.
        joint: Its name; None where it is not of one joint.
    """

    time: float
    what: What
    why: str
    _: KW_ONLY
    joint: str | None = None

    def sentence(self) -> str:
        """For people: ``1.234 s: brake panda_joint4: it is locked``."""
        return f"{self.time:.3f} s: {self.what}{f' {self.joint}' if self.joint else ''}: {self.why}"


@dataclass(frozen=True, eq=False, kw_only=True)
class FaultRun(Result):
    """One run of :func:`holdfast.simulate_faults`, T control cycles of n joints. Everything in it is simulated.

    Attributes:
        law: Of the controller.
        servos: Of the joints.
        body: What of the robot differs from the arm's model.
        target: (4, 4) where the tool should be, m, world; its rows are those of the law's task.
        react: Who notices: ``none``, ``stop``, ``chain`` or ``known``.
        events: The faults of the episode.
        places: (n,) where each joint was when its first fault began, rad and m; NaN where none did.
        actions: What the controller did, in order of time.
        verdicts: What each alarm came to.
        degraded: What is left of the arm: joints that were braked, with where they are; None if none was.
        outcome: ``reached``: within 5 mm and 1 deg of its target for 0.2 s; ``stopped``, ``missed`` or ``unstable``.
        clearance: What the arm was to keep clear of; None: nothing.
        time: (T,) s.
        q: (T, n) where the joints were, rad and m.
        told: (T, n) what their sensors told.
        reference: (T, n) what the servos followed.
        torque: (T, n) commanded, N m and N, with the noise of a record.
        x: (T, 3) measured tool point, m, and
        quat: (T, 4) orientation x, y, z, w; NaN where there is no sample.
        miss: (T,) distance of the tool from its target, m, and
        turn: (T,) angle, rad, of what the task asks for; of the last sample at 100 Hz.
    """

    law: Law
    servos: Servos
    body: Body
    target: Array
    react: React
    events: FaultEvents
    places: Array
    actions: tuple[Action, ...]
    verdicts: tuple[Verdict, ...]
    degraded: Degraded | None
    outcome: Ended
    clearance: Clearance | None = None
    time: Array
    q: Array
    told: Array
    reference: Array
    torque: Array
    x: Array
    quat: Array
    miss: Array
    turn: Array

    @property
    def arm(self) -> Arm:
        """The arm, healthy."""
        return self.law.arm

    @property
    def ok(self) -> bool:
        """The tool reached its target."""
        return self.outcome == "reached"

    def require_ok(self) -> FaultRun:
        """Itself, or :class:`holdfast.HoldfastError` with how it ended."""
        if not self.ok:
            raise HoldfastError(f"run with faults: {_ENDS[self.outcome]}")
        return self

    @property
    def noticed(self) -> float:
        """When the first alarm was, s; infinite if there was none."""
        return next((action.time for action in self.actions if action.what == "alarm"), float("inf"))

    @property
    def delay(self) -> float:
        """From the first fault to the alarm, s; infinite if nothing was noticed, negative for a false alarm."""
        first = min((event.onset for event in self.events), default=float("inf"))
        return self.noticed - first if self.noticed < float("inf") else self.noticed

    @property
    def false_alarm(self) -> bool:
        """Whether something was noticed before anything had failed."""
        return self.delay < 0

    @cached_property
    def poses(self) -> Array:
        """(T, 4, 4) of the end effector, m, world."""
        return self.arm.forward_kinematics(self.q)

    @cached_property
    def contacts(self) -> tuple[Contact, ...] | None:
        """What the arm touched, the first time of each pair, in order of time; None if nobody looked."""
        if self.clearance is None:
            return None
        rows = np.unique(np.r_[: len(self.time) : round(self.servos.rate / 100) or 1, len(self.time) - 1])
        return tuple(first_contacts(self.clearance, self.time[rows], self.q[rows]))

    def log(self) -> Log:
        """What a robot would have recorded: for :func:`holdfast.diagnosis.calibrate` and ``diagnose``."""
        return Log(t=self.time, q_ref=self.reference, q=self.told, tau=self.torque, x=self.x, quat=self.quat)

    def describe(self) -> list[str]:
        """How it ended, what happened, and what was done."""
        lines = [
            f"{_ENDS[self.outcome]} ({_REACTS[self.react]}), {1e3 * self.miss[-1]:.3g} mm"
            + (f" and {np.rad2deg(self.turn[-1]):.3g} deg" if self.law.task.angular else "")
            + f" off after {self.time[-1]:.4g} s"
        ]
        lines += [event.sentence() for event in self.events] or ["no fault in this episode"]
        lines += [action.sentence() for action in self.actions]
        if not self.actions and self.react != "none":
            lines.append("nothing was noticed")
        if self.contacts is not None:
            lines += [contact.sentence() for contact in self.contacts] or ["it touched nothing"]
        if self.false_alarm:
            lines.append("the first alarm is false, nothing had failed: the bounds do not hold for this motion")
        return lines

    def to_csv(self, file: str | Path) -> Path:
        """Write the motion as rows over time: the joints, rad and m, and the tool point, m.

        Raises:
            StoreError: It cannot be written.
        """
        header = ["time_s", *joint_columns(self.arm), "tool_x_m", "tool_y_m", "tool_z_m"]
        return write_table(file, "motion", header, np.column_stack([self.time, self.q, self.poses[:, :3, 3]]))
