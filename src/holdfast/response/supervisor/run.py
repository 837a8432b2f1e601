"""Result of a closed-loop run with faults: events, detections, and responses."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from holdfast.control.physics.body import Body
from holdfast.control.physics.servos import Servos
from holdfast.core.caching import cached_property
from holdfast.core.errors import HoldfastError
from holdfast.core.files.output import write_table
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.kinematics.paths.joint_table import joint_columns
from holdfast.model.collision.contacts import Contact, find_first_contacts
from holdfast.model.failure_modes import Degraded
from holdfast.response.faults.events import FaultEvents
from holdfast.response.faults.log import Log

if TYPE_CHECKING:
    from holdfast.control.laws.law import Law
    from holdfast.model.arm.model import Arm
    from holdfast.model.collision.clearance import Clearance
    from holdfast.response.diagnosis.kinds import FaultVerdict

React = Literal["none", "stop", "chain", "known"]
FaultRunOutcome = Literal["reached", "stopped", "missed", "unstable"]
ActionKind = Literal["alarm", "slow", "resume", "brake", "release", "measure", "detour", "plan", "stop"]

OUTCOME_PHRASES = {
    "reached": "the tool reached its target",
    "stopped": "the controller stopped the arm before the target",
    "missed": "the tool did not reach its target",
    "unstable": "the simulation diverged; make the servos softer or their rate higher",
}


@dataclass(frozen=True)
class Action:
    """Action of the controller.

    Attributes:
        time: Time of the action, s.
        what: ``alarm``, ``slow``, ``resume``, ``brake`` (and exclude the joint from the law), ``release`` (of a brake, as a
            test), ``measure`` (the position of a braked joint, by the tool pose), ``detour`` (by an intermediate
            configuration), ``plan`` (a route) or ``stop``.
        why: Reason, a phrase.
        joint: Name of the joint; None if the action concerns no single joint.
    """

    time: float
    what: ActionKind
    why: str
    _: KW_ONLY
    joint: str | None = None

    def sentence(self) -> str:
        """Return the action as text: ``1.234 s: brake panda_joint4: it is locked``."""
        return f"{self.time:.3f} s: {self.what}{f' {self.joint}' if self.joint else ''}: {self.why}"


@dataclass(frozen=True, eq=False, kw_only=True)
class FaultRun(Result):
    """Run of :func:`holdfast.simulate_faults` with T control cycles of n joints. All of its values are simulated.

    Attributes:
        law: Control law.
        servos: Servos of the joints.
        body: Differences of the robot from the arm's model.
        target: (4, 4) target pose of the tool, m, world; the task of the law decides which of its rows count.
        react: Response to faults: ``none``, ``stop``, ``chain`` or ``known``.
        events: Faults of the episode.
        places: (n,) position of each joint when its first fault began, rad and m; NaN without a fault.
        actions: Actions of the controller, in order of time.
        verdicts: Last verdict of each alarm.
        degraded: Failures that the controller knows: braked joints with their positions; None if no joint was braked.
        outcome: ``reached``: within 5 mm and 1 deg of its target for 0.2 s; ``stopped``, ``missed`` or ``unstable``.
        clearance: Clearance that the arm had to keep; None without one.
        time: (T,) times in s.
        q: (T, n) true joint positions, rad and m.
        q_measured: (T, n) measured joint positions, rad and m.
        reference: (T, n) references of the servos, rad and m.
        torque: (T, n) commanded torques, N m and N, with measurement noise.
        x: (T, 3) measured tool position, m; NaN in cycles without a sample.
        quat: (T, 4) measured tool orientation x, y, z, w; NaN in cycles without a sample.
        position_error: (T,) distance of the tool from its target, m, of the last sample at 100 Hz.
        orientation_error: (T,) angle between the tool and its target in the task, rad, of the last sample at 100 Hz.
    """

    law: Law
    servos: Servos
    body: Body
    target: FloatArray
    react: React
    events: FaultEvents
    places: FloatArray
    actions: tuple[Action, ...]
    verdicts: tuple[FaultVerdict, ...]
    degraded: Degraded | None
    outcome: FaultRunOutcome
    clearance: Clearance | None = None
    time: FloatArray
    q: FloatArray
    q_measured: FloatArray
    reference: FloatArray
    torque: FloatArray
    x: FloatArray
    quat: FloatArray
    position_error: FloatArray
    orientation_error: FloatArray

    @property
    def arm(self) -> Arm:
        """Healthy arm."""
        return self.law.arm

    @property
    def ok(self) -> bool:
        """True if the tool reached its target."""
        return self.outcome == "reached"

    def require_ok(self) -> FaultRun:
        """Return the run itself, or raise :class:`holdfast.HoldfastError` with its outcome."""
        if not self.ok:
            raise HoldfastError(f"run with faults: {OUTCOME_PHRASES[self.outcome]}")
        return self

    @property
    def detection_time(self) -> float:
        """Time of the first alarm, s; infinite if there was none."""
        return next((action.time for action in self.actions if action.what == "alarm"), float("inf"))

    @property
    def delay(self) -> float:
        """Time from the first fault to the alarm, s; infinite without an alarm, negative for a false alarm."""
        first = min((event.onset for event in self.events), default=float("inf"))
        return self.detection_time - first if self.detection_time < float("inf") else self.detection_time

    @property
    def false_alarm(self) -> bool:
        """True if an alarm was raised before any fault."""
        return self.delay < 0

    @cached_property
    def poses(self) -> FloatArray:
        """(T, 4, 4) poses of the end effector in the world, m."""
        return self.arm.forward_kinematics(self.q)

    @cached_property
    def contacts(self) -> tuple[Contact, ...] | None:
        """Contacts of the arm, the first of each pair, in order of time; None if contacts were not checked."""
        if self.clearance is None:
            return None
        rows = np.unique(np.r_[: len(self.time) : round(self.servos.rate / 100) or 1, len(self.time) - 1])
        return tuple(find_first_contacts(self.clearance, self.time[rows], self.q[rows]))

    def log(self) -> Log:
        """Return the log of a robot, for :func:`holdfast.response.diagnosis.calibrate` and ``diagnose``."""
        return Log(t=self.time, q_ref=self.reference, q=self.q_measured, tau=self.torque, x=self.x, quat=self.quat)

    def to_csv(self, file: str | Path) -> Path:
        """Write the joints, rad and m, and the tool point, m, of each cycle to the CSV file ``file``; return its path.

        Raises:
            StoreError: The file cannot be written.
        """
        header = ["time_s", *joint_columns(self.arm), "tool_x_m", "tool_y_m", "tool_z_m"]
        return write_table(file, "motion", header, np.column_stack([self.time, self.q, self.poses[:, :3, 3]]))
