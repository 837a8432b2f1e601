"""States of the fault-tolerant controller, and the table of the transitions between them.

The controller is three state machines side by side. The *motion* decides where the commanded rates come from, the
*supervision* decides how the next verdict of the monitor is answered, and the *trial* records whether a released joint must
prove that it follows. Each state is a dataclass of the facts that matter only in that state.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Generic, Literal, NamedTuple, TypeVar

import numpy as np

from holdfast.core.errors import HoldfastError
from holdfast.core.typing import FloatArray
from holdfast.response.supervisor.condition import JointMotion
from holdfast.response.supervisor.masked_law import MIN_PROGRESS
from holdfast.response.supervisor.replanning import RouteFollower
from holdfast.response.supervisor.thresholds import LATE_SAMPLES_WAIT_S, MIN_POSE_SAMPLES, RUNAWAY_TRACKING_RATIO

Attempt = Literal["detour", "plan"]
Machine = Literal["motion", "supervision", "trial"]


# ---- motion ----------------------------------------------------------------------------------------------------------


@dataclass
class FollowingLaw:
    """The control law, without the braked joints, commands the rates."""

    # ways of replanning that remain after the last brake, in their order; empty for a healthy arm
    attempts: list[Attempt] = field(default_factory=list)
    is_predicted: bool = False  # True once the law has been simulated forward from here
    nearest_error: float = np.inf  # smallest error so far, m and rad added; infinite before the first cycle after a brake
    progress_time: float = 0.0  # time in s at which the error last became smaller

    def add_cycle(self, time: float, error: float) -> None:
        """Add a control cycle at a time in s with an error in m and rad, which is progress if the error became smaller."""
        if error < self.nearest_error - MIN_PROGRESS:
            self.nearest_error, self.progress_time = error, time


@dataclass
class Waiting:
    """A joint was braked; the arm is at rest until it has settled and enough tool poses are measured."""

    joint: int  # index of the braked joint
    end_time: float  # time in s at which the arm has settled
    attempts: list[Attempt]  # ways of replanning for the law that follows
    # joint positions (n,) in rad and m with the tool pose (4, 4) measured there
    pose_samples: list[tuple[FloatArray, FloatArray]] = field(default_factory=list)

    def is_over(self, time: float) -> bool:
        """Return whether the wait is over at a time in s; a wait with too few tool poses lasts longer."""
        extra_wait = LATE_SAMPLES_WAIT_S if 0 < len(self.pose_samples) < MIN_POSE_SAMPLES else 0.0
        return time > self.end_time + extra_wait


@dataclass
class OnRoute:
    """A route, or a motion to an intermediate configuration, commands the rates."""

    route: RouteFollower  # the timed motion and the position along it
    law: FollowingLaw  # state of the law before the route; its remaining attempts are kept for the law after the route


# ---- supervision -----------------------------------------------------------------------------------------------------


@dataclass
class Watching:
    """The monitor has raised no alarm since it was last armed."""


@dataclass
class Alarmed:
    """The monitor has raised an alarm; the arm may have been slowed, but no joint has been braked for this alarm."""

    start_time: float  # time of the alarm in s
    contact_end: float = np.inf  # time in s at which a contact is considered over; infinite if there was no contact
    slowed_joint: str | None = None  # name of the joint for which the arm was slowed; None if there is none


@dataclass
class Braked:
    """The alarm was answered by a brake; once the arm has settled the monitor continues without the joint."""

    joint: str  # name of the joint


@dataclass
class Stopped:
    """The controller has given up; it ignores verdicts, and the arm slows down to a standstill."""


# ---- trial -----------------------------------------------------------------------------------------------------------


@dataclass
class NoTrial:
    """No joint is on trial."""


@dataclass
class OnTrial:
    """The brake of a joint was released because no route exists without the joint."""

    joint: int  # index of the joint
    verdict_time: float  # time of the last verdict in s
    lost_motion: float = 0.0  # commanded minus measured motion in rad or m, summed while the joint did not follow

    def add_cycle(self, time: float, joint_motion: JointMotion) -> None:
        """Add a control cycle at a time in s; the reference of a joint at its effort limit waits, so lost motion is summed."""
        lost = (joint_motion.commanded_rate - joint_motion.v) * (time - self.verdict_time)
        self.lost_motion = 0.0 if joint_motion.is_following() else self.lost_motion + lost
        self.verdict_time = time

    def is_failed(self, joint_motion: JointMotion) -> bool:
        """Return whether the joint is too far from its command, in this cycle or in sum."""
        lost_ratio = abs(self.lost_motion) / joint_motion.tracking_bound
        return max(joint_motion.tracking_ratio, lost_ratio) > RUNAWAY_TRACKING_RATIO


# ---- transitions -----------------------------------------------------------------------------------------------------

MotionState = FollowingLaw | Waiting | OnRoute
SupervisionState = Watching | Alarmed | Braked | Stopped
TrialState = NoTrial | OnTrial


class Transition(NamedTuple):
    """Row of the transition table: a machine, the name of a state, an event, and the name of the state after it."""

    machine: Machine
    source: str
    event: str
    target: str


TRANSITION_TABLE = (
    Transition("motion", "FollowingLaw", "joint braked", "Waiting"),
    Transition("motion", "OnRoute", "joint braked", "Waiting"),
    Transition("motion", "Waiting", "arm settled", "FollowingLaw"),
    Transition("motion", "FollowingLaw", "motion planned", "OnRoute"),
    Transition("motion", "OnRoute", "route finished", "FollowingLaw"),
    Transition("motion", "FollowingLaw", "known fault", "FollowingLaw"),
    Transition("motion", "OnRoute", "known fault", "FollowingLaw"),
    Transition("supervision", "Watching", "alarm raised", "Alarmed"),
    Transition("supervision", "Alarmed", "contact over", "Watching"),
    Transition("supervision", "Alarmed", "verdict final", "Watching"),
    Transition("supervision", "Alarmed", "joint braked", "Braked"),
    Transition("supervision", "Braked", "arm settled", "Watching"),
    Transition("supervision", "Watching", "arm stopped", "Stopped"),
    Transition("supervision", "Alarmed", "arm stopped", "Stopped"),
    Transition("supervision", "Braked", "arm stopped", "Stopped"),
    Transition("trial", "NoTrial", "brake released", "OnTrial"),
    Transition("trial", "OnTrial", "joint not following", "NoTrial"),
)

State = TypeVar("State")


class StateMachine(Generic[State]):
    """State machine that takes only the transitions of :data:`TRANSITION_TABLE`.

    Args:
        machine: Name of the machine in the table.
        state: Initial state.

    Attributes:
        state: Present state, with its facts.
    """

    def __init__(self, machine: Machine, state: State) -> None:
        self.machine, self.state = machine, state

    def enter(self, state: State, event: str) -> None:
        """Take the transition to a state.

        Raises:
            HoldfastError: The table has no such transition.
        """
        transition = Transition(self.machine, type(self.state).__name__, event, type(state).__name__)
        if transition not in TRANSITION_TABLE:
            raise HoldfastError(
                f"the controller has no transition {transition}; see holdfast.response.supervisor.TRANSITION_TABLE"
            )
        self.state = state
