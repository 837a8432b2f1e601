"""Controller response to a named joint: brake it, exclude it from the control law, slow down, or plan a new motion.

The controller is three state machines (:mod:`holdfast.response.supervisor.states`) with a table of their transitions. Its four
events are a control cycle (``rates``), a verdict of the monitor (``on_verdict``), a measured tool pose (``on_tool_pose``), and,
without a monitor, a fault that is known when it begins (``on_known_fault``).

Source: derived here; braking turns a free-swinging joint into a locked one, English and Maciejewski 2001.
"""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.model.failure_modes import Degraded
from holdfast.response.diagnosis.bounds import Bounds
from holdfast.response.diagnosis.kinds import FaultVerdict
from holdfast.response.diagnosis.monitor import Monitor
from holdfast.response.faults.injector import FaultInjector
from holdfast.response.faults.kind import find_kind
from holdfast.response.supervisor import replanning, thresholds
from holdfast.response.supervisor.condition import ArmCondition, JointMotion, Pace, calibrated_speeds, estimate_joint_position
from holdfast.response.supervisor.masked_law import PROGRESS_TIMEOUT_S, MaskedLaw
from holdfast.response.supervisor.replanning import ACCELERATION_LIMIT, RouteFollower, TrialRoute
from holdfast.response.supervisor.run import Action, ActionKind, React
from holdfast.response.supervisor.states import (
    Alarmed,
    Attempt,
    Braked,
    FollowingLaw,
    MotionState,
    NoTrial,
    OnRoute,
    OnTrial,
    StateMachine,
    Stopped,
    SupervisionState,
    TrialState,
    Waiting,
    Watching,
)


class Controller:
    """Controller that continues a task after joint faults.

    Args:
        law: Control law; the controller masks the braked joints.
        bounds: Detection thresholds of the monitor; None without a monitor.
        brakes: Brakes of the joints, from the fault injector of the simulation.
        monitor: Fault monitor; None without one.
        react: Response, as for :func:`holdfast.simulate_faults`.
        plan: True if a route may be planned where the masked law would miss the target and no intermediate configuration helps.

    Attributes:
        motion: State machine that decides where the rates come from.
        supervision: State machine that decides how the next verdict is answered.
        trial: State machine of the joint whose brake was released.
        condition: Facts about the joints that faults and brakes change.
        actions: Actions so far.
        verdicts: Last verdict of each alarm.
    """

    def __init__(
        self, law: MaskedLaw, *, bounds: Bounds | None, brakes: FaultInjector, monitor: Monitor | None, react: React, plan: bool
    ) -> None:
        self.law, self.arm = law, law.arm
        self._bounds, self._brakes, self._monitor, self._react = bounds, brakes, monitor, react
        self._attempts: tuple[Attempt, ...] = ("detour", "plan") if plan else ("detour",)
        self.motion = StateMachine[MotionState]("motion", FollowingLaw())
        self.supervision = StateMachine[SupervisionState]("supervision", Watching())
        self.trial = StateMachine[TrialState]("trial", NoTrial())
        self.condition = ArmCondition(self.arm)
        self.actions, self.verdicts = list[Action](), list[FaultVerdict]()
        self._pace = Pace()
        self._time, self._q, self._rates = 0.0, np.full(self.arm.n, np.nan), np.zeros(self.arm.n)  # of the last cycle

    @property
    def pace(self) -> float:
        """Fraction of the commanded speed that the arm approaches."""
        return self._pace.target

    @property
    def is_stopped(self) -> bool:
        """True once the controller has given up."""
        return isinstance(self.supervision.state, Stopped)

    @property
    def degraded(self) -> Degraded | None:
        """Failures of the arm that the controller knows; None if there are none."""
        return self.condition.find_failures(self._q, self.law.mask)

    def trusted_positions(self, q_measured: FloatArray) -> FloatArray:
        """Return the joint positions (n,), replacing those of sensors that are not trusted."""
        return self.condition.trusted_positions(q_measured)

    def is_idle(self, rates: FloatArray) -> bool:
        """Return whether no further motion is expected."""
        is_steady = not isinstance(self.motion.state, OnRoute) and self._pace.current == self._pace.target
        return is_steady and float(np.abs(rates).max()) < thresholds.IDLE_SPEED

    # ---- control cycle -----------------------------------------------------------------------------------------------

    def rates(self, time: float, q_measured: FloatArray) -> FloatArray:
        """Commanded rates (n,), rad/s and m/s: smooth, within the velocity limits, and slower towards the ends of the range."""
        q, dt = self.trusted_positions(q_measured), time - self._time
        self._time, self._q = time, q
        self._pace.ramp(dt)
        requested = self._requested_rates(time, q, dt)
        if not np.isfinite(requested).all():
            requested = np.zeros(self.arm.n)
        requested = requested / max(1.0, float((np.abs(requested) / self.condition.max_speeds).max()))
        margins = q - self.condition.lower, self.condition.upper - q
        low, high = (np.sqrt(2 * ACCELERATION_LIMIT * np.maximum(margin, 0.0)) for margin in margins)
        requested = np.minimum(np.maximum(requested, -low), high)
        change = ACCELERATION_LIMIT * dt
        self._rates = self.law.mask * np.clip(requested, self._rates - change, self._rates + change)
        return self._rates

    def _requested_rates(self, time: float, q: FloatArray, dt: float) -> FloatArray:
        """Return the rates that the control law or the route requests."""
        self._end_wait(time)
        motion = self.motion.state
        if isinstance(motion, OnRoute):
            if not motion.route.is_finished:
                return motion.route.rates(q, pace=self._pace.current, dt=dt)
            motion = FollowingLaw(motion.law.attempts, progress_time=time)
            self.motion.enter(motion, "route finished")
        rates = self.law.rates(q)
        if isinstance(motion, Waiting):
            self._pace.current = 0.0  # the arm waits until the controller knows where the braked joint is
        elif self._misses_target(motion, time, q, rates):
            return self._replan(motion, time, q)
        return self._pace.current * rates

    def _end_wait(self, time: float) -> None:
        motion = self.motion.state
        if isinstance(motion, Waiting) and motion.is_over(time):
            self.motion.enter(FollowingLaw(motion.attempts, progress_time=time), "arm settled")

    def _misses_target(self, motion: FollowingLaw, time: float, q: FloatArray, rates: FloatArray) -> bool:
        """Return whether the remaining control law fails to reach its target, by forward simulation or at its end."""
        if self.is_stopped or self.law.mask.min() > 0:
            return False
        commanded = self._rates
        stopping_distance = commanded * np.abs(commanded) / (2 * ACCELERATION_LIMIT)
        if not self.law.is_collision_free(q + 2 * stopping_distance):
            return True
        if not motion.attempts:
            return False
        if not motion.is_predicted:
            motion.is_predicted = True
            if not np.isfinite(self.law.predict_time_to_target(q[None], max_speeds=self.condition.max_speeds)[0]):
                return True
        motion.add_cycle(time, self.law.position_error + self.law.orientation_error)
        is_slow = not np.isfinite(rates).all() or float(np.abs(rates).max()) < thresholds.IDLE_SPEED
        return is_slow or time - motion.progress_time > PROGRESS_TIMEOUT_S

    # ---- events ------------------------------------------------------------------------------------------------------

    def on_verdict(
        self,
        time: float,
        verdict: FaultVerdict,
        *,
        tracking_error: FloatArray,
        v: FloatArray,
        commanded_rates: FloatArray,
        gravity: FloatArray,
    ) -> None:
        """Respond to a verdict of the monitor.

        Args:
            time: Time in s.
            verdict: Present verdict of the monitor.
            tracking_error: (n,) references minus joint positions, rad and m.
            v: (n,) measured rates, rad/s and m/s.
            commanded_rates: (n,) commanded rates, rad/s and m/s.
            gravity: (n,) gravity torques, N m and N.
        """
        self._end_wait(time)
        if self.is_stopped or isinstance(self.motion.state, Waiting):
            return

        def motion_of(joint: int) -> JointMotion:
            assert self._bounds is not None
            columns = tracking_error, self._bounds.tracking, v, commanded_rates
            return JointMotion(*(float(column[joint]) for column in columns))

        trial, supervision = self.trial.state, self.supervision.state
        if isinstance(trial, OnTrial) and self._fails_trial(trial, time, motion_of(trial.joint)):
            self.trial.enter(NoTrial(), "joint not following")
            self._brake_and_wait(time, self.arm.joint_names[trial.joint], "it does not follow")
            self._stop(time, "the remaining joints do not reach the target")
            return
        if isinstance(supervision, Braked):
            self._resume_monitoring(supervision.joint, "arm settled")
            return
        if isinstance(supervision, Alarmed) and time > supervision.contact_end:
            self._log_action(time, "resume", "no joint was named")
            self._resume_monitoring(supervision.slowed_joint, "contact over")
            return
        if not verdict.alarm:
            return
        if not isinstance(supervision, Alarmed):
            supervision = Alarmed(time)
            self.supervision.enter(supervision, "alarm raised")
            self.verdicts.append(verdict)
            self._log_action(time, "alarm", "a signal exceeds its threshold")
            if self._react == "stop":
                self._stop(time, "every joint, at the first alarm")
                return
        self.verdicts[-1] = verdict
        if verdict.joint is None:
            self._answer_without_joint(supervision, time, verdict)
            return
        joint = self.arm.joint_index(verdict.joint)
        self.condition.is_sensor_fault = verdict.kind == "sensor"
        self.condition.named_direction = float(np.sign(commanded_rates[joint]))
        if verdict.kind in thresholds.SLOWING_KINDS:
            self._answer_slow_joint(supervision, time, verdict, verdict.joint, float(gravity[joint]))
        elif verdict.kind != "unknown" or verdict.candidates:
            self._answer_with_brake(time, verdict.joint, f"its fault: {verdict.kind}")
        elif time >= supervision.start_time + thresholds.EARLY_BRAKE_DELAY_S:
            self._answer_unknown_kind(time, verdict.joint, motion_of(joint))

    def on_known_fault(self, time: float, kind: str, joint: str, true_position: float) -> None:
        """Respond to a fault that is known at once, with the joint's true position in rad or m."""
        index = self.arm.joint_index(joint)
        if index in self.condition.true_positions or self.law.mask[index] == 0:
            return
        if find_kind(kind).needs_brake:
            self._log_action(time, "alarm", f"its fault is known: {kind}", joint=joint)
            motion = self.motion.state
            law = motion.law if isinstance(motion, OnRoute) else motion
            assert isinstance(law, FollowingLaw)  # the arm waits only after a verdict
            law = FollowingLaw([*self._attempts], nearest_error=law.nearest_error, progress_time=law.progress_time)
            self.motion.enter(law, "known fault")
            self._brake(time, joint, f"its fault: {kind}")
            self.condition.true_positions[index] = true_position

    def on_tool_pose(self, time: float, q_measured: FloatArray, pose: FloatArray) -> None:
        """Use a measured tool pose (4, 4): after braking it shows whether the joint's sensor can be trusted."""
        self.condition.has_tool_poses = True
        self._end_wait(time)
        motion, sample_count = self.motion.state, thresholds.MIN_POSE_SAMPLES
        if not isinstance(motion, Waiting) or len(motion.pose_samples) == sample_count:
            return
        if time <= motion.end_time - sample_count / 100:
            return
        motion.pose_samples.append((self.trusted_positions(q_measured).copy(), pose))
        if len(motion.pose_samples) == sample_count:
            self._check_sensor(time, motion)

    # ---- answers to a verdict ----------------------------------------------------------------------------------------

    def _answer_without_joint(self, alarm: Alarmed, time: float, verdict: FaultVerdict) -> None:
        if verdict.kind == "contact":
            if np.isinf(alarm.contact_end):
                alarm.contact_end, self._pace.target = time + thresholds.CONTACT_END_S, thresholds.SLOW_PACE
                self._log_action(time, "slow", "an external force acts on the arm, and no joint is faulty")
        elif time > alarm.start_time + thresholds.NAMING_DEADLINE_S:
            self._stop(time, "the joint is not known")

    def _answer_slow_joint(self, alarm: Alarmed, time: float, verdict: FaultVerdict, joint: str, gravity: float) -> None:
        if alarm.slowed_joint == joint:
            if time > alarm.start_time + thresholds.VERDICT_DEADLINE_S:
                self._resume_monitoring(joint, "verdict final")
            return
        remaining_torque = (1 - verdict.loss) * self.condition.max_efforts[self.arm.joint_index(joint)]  # may be NaN
        if remaining_torque < thresholds.GRAVITY_SAFETY_FACTOR * abs(gravity):
            self._answer_with_brake(time, joint, "its remaining motor torque does not carry the arm")
        else:
            self._pace.target, alarm.slowed_joint = min(self._pace.allowed, thresholds.REDUCED_PACE), joint
            self._log_action(time, "slow", f"its fault: {verdict.kind}", joint=joint)

    def _answer_unknown_kind(self, time: float, joint: str, joint_motion: JointMotion) -> None:
        reason = joint_motion.early_brake_reason()
        if reason is not None:
            self._answer_with_brake(time, joint, reason)
        elif self.pace > thresholds.SLOW_PACE:
            self._pace.target = thresholds.SLOW_PACE
            self._log_action(time, "slow", "its fault is not known yet", joint=joint)

    def _answer_with_brake(self, time: float, joint: str, why: str) -> None:
        self._brake_and_wait(time, joint, why)
        self.supervision.enter(Braked(joint), "joint braked")

    def _resume_monitoring(self, joint: str | None, event: str) -> None:
        """Resume monitoring without a joint, or with all joints for None, at the pace that the failures allow."""
        assert self._monitor is not None
        if joint is None:
            self._monitor.rearm()
        else:
            self._monitor.exclude(joint)
            if self.law.mask[self.arm.joint_index(joint)] > 0:
                self._pace.allowed = min(self._pace.allowed, thresholds.REDUCED_PACE)
        self._pace.target = self._pace.allowed
        self.supervision.enter(Watching(), event)

    def _fails_trial(self, trial: OnTrial, time: float, joint_motion: JointMotion) -> bool:
        """Return whether the joint on trial does not follow; a joint that lags behind limits the pace."""
        trial.add_cycle(time, joint_motion)
        speed_fraction = joint_motion.lagging_speed_fraction()
        if speed_fraction is not None:  # the joint may not be able to move faster
            reached_pace = thresholds.TRIAL_SPEED_FRACTION * self._pace.current * speed_fraction
            self._pace.target = self._pace.allowed = min(self._pace.target, reached_pace)
        return trial.is_failed(joint_motion)

    # ---- actions -----------------------------------------------------------------------------------------------------

    def _log_action(self, time: float, what: ActionKind, why: str, *, joint: str | None = None) -> None:
        self.actions.append(Action(time, what, why, joint=joint))

    def _stop(self, time: float, why: str) -> None:
        self.supervision.enter(Stopped(), "arm stopped")
        self._pace.target = 0.0
        self._log_action(time, "stop", why)

    def _brake(self, time: float, joint: str, why: str) -> None:
        """Brake a joint and exclude it from the control law."""
        index = self.arm.joint_index(joint)
        self._brakes.brake(joint)
        self.law.mask[index], self.condition.last_braked = 0.0, index
        self._pace.target = self._pace.allowed
        if self._bounds is not None:
            self.condition.max_speeds = calibrated_speeds(self.arm, self._bounds)
        self._log_action(time, "brake", why, joint=joint)

    def _brake_and_wait(self, time: float, joint: str, why: str) -> None:
        pose_time = thresholds.MIN_POSE_SAMPLES / 100 if self.condition.has_tool_poses else 0.0
        end_time = time + thresholds.SETTLING_TIME_S + pose_time
        self.motion.enter(Waiting(self.arm.joint_index(joint), end_time, [*self._attempts]), "joint braked")
        self._brake(time, joint, why)

    def _check_sensor(self, time: float, wait: Waiting) -> None:
        """Compare the sensor of the braked joint with its position by the tool poses; distrust a sensor that disagrees."""
        position, sensor_error = estimate_joint_position(self.arm, wait.joint, wait.pose_samples)
        if abs(sensor_error) > thresholds.SENSOR_TOLERANCE:
            self.condition.true_positions[wait.joint] = position  # a braked joint stays there
            factor, unit = self.arm.joints[wait.joint].display_unit
            reason = f"by the tool pose it is {factor * sensor_error:.3g} {unit} away from its sensor reading"
            self._log_action(time, "measure", reason, joint=self.arm.joint_names[wait.joint])

    # ---- replanning --------------------------------------------------------------------------------------------------

    def _replan(self, law: FollowingLaw, time: float, q: FloatArray) -> FloatArray:
        """Plan the next motion and return rates of zero; without a plan the arm stops, or else follows the law to its end."""
        failures, clearance = self.degraded, self.law.clearance
        assert failures is not None
        reason = obstacle = "the law would miss the target" + ("" if clearance is None else f" or touch {clearance.others}")
        while law.attempts:
            attempt = law.attempts.pop(0)
            if attempt == "detour":
                route = replanning.plan_intermediate_motion(self.law, q, failures, max_speeds=self.condition.max_speeds)
            else:
                route = self._plan_route(time, q, failures)
            if not isinstance(route, str):
                self.motion.enter(OnRoute(route, law), "motion planned")
                self._pace.current = 0.0
                motion_text = (
                    "another configuration first, which" if attempt == "detour" else f"a route of {route.waypoints} waypoints"
                )
                self._log_action(time, attempt, f"{reason}; {motion_text} takes {route.duration:.3g} s")
                return np.zeros(self.arm.n)
            obstacle = route
        if "plan" in self._attempts or clearance is not None:
            self._stop(time, obstacle)
        return np.zeros(self.arm.n)

    def _plan_route(self, time: float, q: FloatArray, failures: Degraded) -> RouteFollower | str:
        """Plan a route without the braked joints, else one with the braked joint, which may only have reached a stop."""
        route = replanning.plan_target_route(self.law, q, failures, max_speeds=self.condition.max_speeds)
        braked = [int(joint) for joint in np.flatnonzero(self.law.mask == 0)]
        has_trusted_joint = len(braked) == 1 and braked[0] not in self.condition.true_positions
        may_try = self._react == "chain" and not self.condition.is_sensor_fault and isinstance(self.trial.state, NoTrial)
        if not isinstance(route, str) or not has_trusted_joint or not may_try:
            return route
        directions, max_speeds = (self.condition.named_direction, 0.0), self.condition.max_speeds
        trial = replanning.plan_trial_route(self.law, q, braked[0], directions, max_speeds=max_speeds)
        if trial is None:
            return route
        self._release(time, trial)
        return trial.route

    def _release(self, time: float, trial: TrialRoute) -> None:
        """Release the brake of a joint for a slow route that moves the joint too."""
        joint, supervision = self.arm.joint_names[trial.joint], self.supervision.state
        if isinstance(supervision, Braked) and supervision.joint == joint:  # otherwise an older verdict would brake it again
            self._resume_monitoring(joint, "arm settled")
        self.trial.enter(OnTrial(trial.joint, verdict_time=time), "brake released")
        self.law.mask[trial.joint] = 1.0
        self._pace.target = self._pace.allowed = thresholds.TRIAL_PACE
        self.condition.lower[trial.joint], self.condition.upper[trial.joint] = trial.lower, trial.upper
        self._brakes.release(joint)
        self._log_action(time, "release", "no route exists without it; the arm moves as slowly as it follows", joint=joint)
