"""Controller response to a named joint: brake it, exclude it from the control law, slow down, or plan a new motion.

Source: derived here; braking turns a free-swinging joint into a locked one, English and Maciejewski 2001.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np

from holdfast.arm.model import Arm
from holdfast.arm.poses import rotation_vectors
from holdfast.diagnosis.bounds import Bounds
from holdfast.diagnosis.kinds import FaultVerdict
from holdfast.failures import Degraded
from holdfast.faults.kind import find_kind
from holdfast.reaction.detour import choose_posture
from holdfast.reaction.masked import MIN_PROGRESS, PROGRESS_TIMEOUT_S, MaskedLaw
from holdfast.reaction.plan import ACCELERATION_LIMIT, RouteFollower, plan_route
from holdfast.reaction.run import Action, React, What
from holdfast.typing import FloatArray

EARLY_BRAKE_DELAY_S = 0.020  # s after the alarm: a joint that does not move, or runs away, is braked before its kind is known
# STILL_SPEED, MOVING_SPEED and RUNAWAY_SPEED_ERROR: rad/s or m/s: no motion; a motion, and so much off its reference
STILL_SPEED = 0.02
MOVING_SPEED = 0.2
RUNAWAY_SPEED_ERROR = 0.3
LAGGING_TRACKING_RATIO = 1.5  # of the bound of tracking
RUNAWAY_TRACKING_RATIO = 8.0  # a servo at its effort is not far off a joint that falls
# SLOW_PACE and REDUCED_PACE: of the commanded speed
SLOW_PACE = 0.3
REDUCED_PACE = 0.5
TRIAL_PACE = 0.2  # of the speed of a route, with a joint that may do more than was thought
TRIAL_SPEED_FRACTION = 0.8  # of the speed that such a joint has where it falls behind
CONTACT_END_S = 1.0  # s after which a contact is over
GRAVITY_SAFETY_FACTOR = 1.2  # a weak motor must carry gravity so many times
SETTLING_TIME_S = 0.05  # s after braking
MIN_POSE_SAMPLES = 10  # measured poses that tell where the joint is
LATE_SAMPLES_WAIT_S = 0.5  # s more, for measured poses that come more slowly
NAMING_DEADLINE_S = 2.0  # s after the alarm by which the joint must be known
VERDICT_DEADLINE_S = 0.6  # s after the alarm; a verdict may be revised before, when the tool's pose tells more
SENSOR_TOLERANCE = 1e-3  # rad or m: a sensor is believed where the tool's pose agrees so far
PACE_RATE_PER_S = 5.0  # 1/s, of the pace: from standstill to the commanded speed, and back, in 0.2 s
MIN_CALIBRATED_SPEED = 0.1  # rad/s or m/s: a joint that calibration has hardly moved may be so fast
IDLE_SPEED = 1e-3  # rad/s and m/s: a law that commands less is at its end
_SLOWING_KINDS = frozenset({"weak", "friction", "sluggish"})


class Brakes(Protocol):
    """Interface of the joint brakes."""

    def brake(self, joint: str) -> None:
        """Stop a joint at its present position."""
        ...

    def release(self, joint: str) -> None:
        """Release the brake of a joint."""
        ...


class FaultMonitor(Protocol):
    """Interface of the fault monitor."""

    def rearm(self) -> None:
        """Resume monitoring after an alarm."""
        ...

    def exclude(self, joint: str) -> None:
        """Resume monitoring without one joint."""
        ...


class Controller:
    """Control law that loses one joint after each fault that is found.

    Args:
        law: The law, masked by this class.
        bounds: Of the monitor; None without one.
        brakes: Of the joints.
        watch: The monitor; None without one.
        react: Who notices.
        plan: Whether a route is planned where the masked law ends off the target, from every posture that is tried.

    Attributes:
        pace: Fraction of the commanded speed that is aimed at.
        actions: What was done so far.
        verdicts: What each alarm came to.
        over: The controller has given up.
    """

    def __init__(
        self, law: MaskedLaw, *, bounds: Bounds | None, brakes: Brakes, watch: FaultMonitor | None, react: React, plan: bool
    ) -> None:
        self.law, self.arm = law, law.arm
        self._bounds, self._brakes, self._watch, self._react, self._plans = bounds, brakes, watch, react, plan
        self.pace, self.over, self.actions, self.verdicts = 1.0, False, list[Action](), list[FaultVerdict]()
        self._pace = self._time = self._since = 0.0
        self._nearest = np.inf
        self._alarm = self._settled = self._quiet = np.inf
        self._usual = 1.0  # pace with what has failed so far
        self._named: str | None = None  # the joint that the alarm is about, once something is done about it
        self._braked = -1  # the last joint that was
        self._tries = list[What]()  # ways round that are left after a brake
        self._looked = False  # whether the law was followed ahead since
        self._true: dict[int, float] = {}  # of braked joints whose sensor is not believed
        self._poses, self._seen = list[tuple[FloatArray, FloatArray]](), False
        self._planned: RouteFollower | None = None
        self._way = 0.0  # 1 or -1: the joint that was braked was to go up or down
        self._doubted = True  # what is wrong with it may be less than was thought
        self._trial: int | None = None  # a joint whose brake was released again
        self._lost, self._heard = 0.0, 0.0  # rad or m that it went otherwise than it was told, until when, s
        self._lower, self._upper = self.arm.lower.copy(), self.arm.upper.copy()
        self._effort = np.array([joint.effort for joint in self.arm.joints])
        self._most = np.array([joint.velocity for joint in self.arm.joints])
        self._commanded = np.zeros(self.arm.n)

    @property
    def degraded(self) -> Degraded | None:
        """Failures of the arm that the controller knows; None if there are none."""
        locked = {int(j): float(self._last[j]) for j in np.flatnonzero(self.law.mask == 0)}
        range_limited = np.flatnonzero((self._lower > self.arm.lower) | (self._upper < self.arm.upper))
        ranges = {int(j): (self._lower[j], self._upper[j]) for j in range_limited if j not in locked}
        return Degraded(self.arm, locked=locked, ranges=ranges) if locked or ranges else None

    def trusted_positions(self, q_measured: FloatArray) -> FloatArray:
        """Return the joint positions (n,), replacing those of sensors that are not trusted."""
        if not self._true:
            return q_measured
        q = q_measured.copy()
        for j, value in self._true.items():
            q[j] = value
        return q

    def rates(self, time: float, q_measured: FloatArray) -> FloatArray:
        """Commanded rates (n,), rad/s and m/s: smooth, within the velocity limits, and slower towards the ends of the range."""
        q, dt = self.trusted_positions(q_measured), time - self._time
        requested = self._requested_rates(time, q_measured)
        if not np.isfinite(requested).all():
            requested = np.zeros(self.arm.n)
        requested = requested / max(1.0, float((np.abs(requested) / self._most).max()))
        low, high = (np.sqrt(2 * ACCELERATION_LIMIT * np.maximum(margin, 0.0)) for margin in (q - self._lower, self._upper - q))
        requested = np.minimum(np.maximum(requested, -low), high)
        change = ACCELERATION_LIMIT * dt
        self._commanded = self.law.mask * np.clip(requested, self._commanded - change, self._commanded + change)
        return self._commanded

    def _requested_rates(self, time: float, q_measured: FloatArray) -> FloatArray:
        """Return the rates that the control law or the route requests."""
        q = self._last = self.trusted_positions(q_measured)
        dt = time - self._time
        self._time, self._pace = (
            time,
            self._pace + min(max(self.pace - self._pace, -PACE_RATE_PER_S * dt), PACE_RATE_PER_S * dt),
        )
        if self._planned is not None:
            if not self._planned.is_finished:
                return self._planned.rates(q, pace=self._pace, dt=dt)
            self._planned, self._since, self._nearest, self._looked = None, time, np.inf, False
        rates = self.law.rates(q)
        if self._is_waiting(time):
            self._pace, self._since, self._nearest = 0.0, time, np.inf  # the arm waits until it knows where that joint is
        elif self._misses_target(time, q, rates):
            return self._replan(time, q)
        return self._pace * rates

    def _is_waiting(self, time: float) -> bool:
        extra_wait = LATE_SAMPLES_WAIT_S if 0 < len(self._poses) < MIN_POSE_SAMPLES else 0.0
        return bool(np.isfinite(self._settled) and time <= self._settled + extra_wait)

    def _misses_target(self, time: float, q: FloatArray, rates: FloatArray) -> bool:
        """Return whether the remaining control law fails to reach its target, by forward simulation or at its end."""
        if self.over or self.law.mask.min() > 0:
            return False
        if not self.law.is_collision_free(
            q + self._commanded * np.abs(self._commanded) / ACCELERATION_LIMIT
        ):  # twice the way it takes to stop
            return True
        if not self._tries:
            return False
        if not self._looked:
            self._looked = True
            if not np.isfinite(self.law.predict_time_to_target(q[None], max_speeds=self._most)[0]):
                return True
        error = self.law.position_error + self.law.orientation_error
        if error < self._nearest - MIN_PROGRESS:
            self._nearest, self._since = error, time
        is_slow = not np.isfinite(rates).all() or float(np.abs(rates).max()) < IDLE_SPEED
        return is_slow or time - self._since > PROGRESS_TIMEOUT_S

    def is_idle(self, rates: FloatArray) -> bool:
        """Return whether no further motion is expected."""
        return self._planned is None and self._pace == self.pace and float(np.abs(rates).max()) < IDLE_SPEED

    # ---- what the monitor says ---------------------------------------------------------------------------------------

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
            time: s.
            verdict: Of the monitor, now.
            tracking_error: (n,) distances from the references, rad and m.
            v: (n,) measured rates, rad/s and m/s.
            commanded_rates: (n,) commanded ones.
            gravity: (n,) torques, N m and N.
        """
        if self.over or self._is_waiting(time):
            return
        if self._trial is not None:
            assert self._bounds is not None
            trial_joint = self._trial
            tracking_ratio, rate_error = (
                abs(tracking_error[trial_joint]) / self._bounds.tracking[trial_joint],
                commanded_rates[trial_joint] - v[trial_joint],
            )
            follows = tracking_ratio < LAGGING_TRACKING_RATIO or abs(rate_error) < max(
                STILL_SPEED, REDUCED_PACE * abs(commanded_rates[trial_joint])
            )
            # Where its motor is at its effort its reference does not go ahead, so what it should have done is summed up.
            self._lost = 0.0 if follows else self._lost + rate_error * (time - self._heard)
            self._heard = time
            if tracking_ratio > LAGGING_TRACKING_RATIO and MIN_CALIBRATED_SPEED < v[trial_joint] * np.sign(
                commanded_rates[trial_joint]
            ) < abs(commanded_rates[trial_joint]):  # it may not be faster
                self.pace = self._usual = min(
                    self.pace, TRIAL_SPEED_FRACTION * self._pace * float(v[trial_joint] / commanded_rates[trial_joint])
                )
            if max(tracking_ratio, abs(self._lost) / self._bounds.tracking[trial_joint]) > RUNAWAY_TRACKING_RATIO:
                self._trial = None
                self._brake(time, self.arm.joint_names[trial_joint], "it does not follow")
                self._stop(time, "what is left does not reach the target")
                return
        if self._named is not None and self.law.mask[self.arm.joint_index(self._named)] == 0:
            self._resume()
            return
        if time > self._quiet:
            self._log_action(time, "resume", "no joint was named")
            self._resume()
            return
        if not verdict.alarm:
            return
        if np.isinf(self._alarm):
            self._alarm = time
            self.verdicts.append(verdict)
            self._log_action(time, "alarm", "something is outside its bounds")
            if self._react == "stop":
                self._stop(time, "every joint, at the first alarm")
                return
        self.verdicts[-1] = verdict
        if verdict.joint is None:
            if verdict.kind == "contact":
                if np.isinf(self._quiet):
                    self._quiet, self.pace = time + CONTACT_END_S, SLOW_PACE
                    self._log_action(time, "slow", "something pushes the arm, and no joint is to blame")
            elif time > self._alarm + NAMING_DEADLINE_S:
                self._stop(time, "the joint is not known")
            return
        joint = self.arm.joint_index(verdict.joint)
        self._doubted = verdict.kind != "sensor"
        self._way = float(np.sign(commanded_rates[joint]))
        if verdict.kind in _SLOWING_KINDS:
            if self._named == verdict.joint:
                if time > self._alarm + VERDICT_DEADLINE_S:
                    self._resume()
                return
            torque_left = (1 - verdict.loss) * self._effort[joint]  # not a number where no loss is told
            if torque_left < GRAVITY_SAFETY_FACTOR * abs(gravity[joint]):
                self._brake(time, verdict.joint, "what its motor still gives does not carry the arm")
            else:
                self.pace, self._named = min(self._usual, REDUCED_PACE), verdict.joint
                self._log_action(time, "slow", f"its fault: {verdict.kind}", joint=verdict.joint)
        elif verdict.kind != "unknown" or verdict.candidates:
            self._brake(time, verdict.joint, f"its fault: {verdict.kind}")
        elif time >= self._alarm + EARLY_BRAKE_DELAY_S:
            self._brake_early(time, verdict.joint, float(tracking_error[joint]), float(v[joint]), float(commanded_rates[joint]))

    def _resume(self) -> None:
        """Resume monitoring without the named joint, at the pace that the failures allow."""
        assert self._watch is not None
        if self._named is None:
            self._watch.rearm()
        else:
            self._watch.exclude(self._named)
            if self.law.mask[self.arm.joint_index(self._named)] > 0:
                self._usual = min(self._usual, REDUCED_PACE)
        self.pace, self._alarm, self._quiet, self._named = self._usual, np.inf, np.inf, None

    def on_known_fault(self, time: float, kind: str, joint: str, true_position: float) -> None:
        """Respond to a fault that is known at once, with the joint's true position in rad or m."""
        if self.arm.joint_index(joint) in self._true or self.law.mask[self.arm.joint_index(joint)] == 0:
            return
        if find_kind(kind).needs_brake:
            self._log_action(time, "alarm", f"its fault is known: {kind}", joint=joint)
            self._brake(time, joint, f"its fault: {kind}")
            self._true[self.arm.joint_index(joint)] = true_position
            self._settled = np.inf

    def on_tool_pose(self, time: float, q_measured: FloatArray, pose: FloatArray) -> None:
        """Use a measured tool pose (4, 4): after braking it shows whether the joint's sensor can be trusted."""
        self._seen = True
        if not self._is_waiting(time) or time <= self._settled - MIN_POSE_SAMPLES / 100 or len(self._poses) == MIN_POSE_SAMPLES:
            return
        self._poses.append((self.trusted_positions(q_measured).copy(), pose))
        if len(self._poses) == MIN_POSE_SAMPLES:
            self._estimate_braked_joint(time)

    # ---- what it does ------------------------------------------------------------------------------------------------

    def _log_action(self, time: float, what: What, why: str, *, joint: str | None = None) -> None:
        self.actions.append(Action(time, what, why, joint=joint))

    def _stop(self, time: float, why: str) -> None:
        self.over, self.pace = True, 0.0
        self._log_action(time, "stop", why)

    def _brake_early(self, time: float, joint: str, tracking_error: float, v: float, commanded_rate: float) -> None:
        assert self._bounds is not None
        tracking_ratio = abs(tracking_error) / self._bounds.tracking[self.arm.joint_index(joint)]
        if abs(v) < STILL_SPEED and tracking_ratio > LAGGING_TRACKING_RATIO:
            self._brake(time, joint, "it does not move")
        elif (
            tracking_ratio > (LAGGING_TRACKING_RATIO if tracking_error * v < 0 else RUNAWAY_TRACKING_RATIO)
            and abs(v - commanded_rate) > RUNAWAY_SPEED_ERROR
            and abs(v) > MOVING_SPEED
        ):
            self._brake(time, joint, "it runs away")
        elif self.pace > SLOW_PACE:
            self.pace = SLOW_PACE
            self._log_action(time, "slow", "its fault is not known yet", joint=joint)

    def _brake(self, time: float, joint: str, why: str) -> None:
        index = self.arm.joint_index(joint)
        self._brakes.brake(joint)
        self.law.mask[index], self.pace, self._named, self._braked = 0.0, self._usual, joint, index
        self._planned, self._looked = None, False
        self._tries = ["detour", "plan"] if self._plans else ["detour"]
        if self._bounds is not None:
            self._most = calibrated_speeds(self.arm, self._bounds)
        self._settled, self._poses = time + SETTLING_TIME_S + (MIN_POSE_SAMPLES / 100 if self._seen else 0.0), []
        self._log_action(time, "brake", why, joint=joint)

    def _estimate_braked_joint(self, time: float) -> None:
        """Estimate a braked joint's position from the tool poses, ``b = sum J_i' c / sum J_i' J_i``; metres and radians weigh
        equally.
        """
        joint = self._braked
        rows = np.array([q for q, _ in self._poses])
        measured = np.array([pose for _, pose in self._poses])
        for _ in range(3):
            poses, columns = self.arm.forward_kinematics(rows), self.arm.jacobian(rows)[:, :, joint]
            rotations = rotation_vectors(measured[:, :3, :3] @ poses[:, :3, :3].transpose(0, 2, 1))
            c = np.concatenate([measured[:, :3, 3] - poses[:, :3, 3], rotations], axis=1)
            rows[:, joint] += (c * columns).sum() / max(float((columns**2).sum()), 1e-12)
        position_error = float(np.mean([row[joint] - q[joint] for row, (q, _) in zip(rows, self._poses, strict=True)]))
        if abs(position_error) > SENSOR_TOLERANCE:
            self._true[joint] = float(rows[:, joint].mean())  # it stands, whatever its sensor does
            factor, unit = self.arm.joints[joint].display_unit
            reason = f"by the tool's pose it is {factor * position_error:.3g} {unit} off what its sensor says"
            self._log_action(time, "measure", reason, joint=self.arm.joint_names[joint])

    def _replan(self, time: float, q: FloatArray) -> FloatArray:
        """Return rates towards an intermediate configuration, else along a route; else the arm stops, or follows the law
        without routes.
        """
        failures, clearance = self.degraded, self.law.clearance
        assert failures is not None
        reason = last_reason = "the law would not get there" + ("" if clearance is None else f" clear of {clearance.others}")
        while self._tries:
            attempt = self._tries.pop(0)
            follower = self._plan_posture_change(q, failures) if attempt == "detour" else self._plan_route(time, q, failures)
            if not isinstance(follower, str):
                self._planned, self._pace = follower, 0.0
                action_text = (
                    "another posture first, which" if attempt == "detour" else f"a route of {follower.waypoints} waypoints"
                )
                self._log_action(time, attempt, f"{reason}; {action_text} takes {follower.duration:.3g} s")
                return np.zeros(self.arm.n)
            last_reason = follower
        if self._plans or clearance is not None:
            self._stop(time, last_reason)
        return np.zeros(self.arm.n)

    def _plan_posture_change(self, q: FloatArray, failures: Degraded) -> RouteFollower | str:
        posture = choose_posture(self.law, q, max_speeds=self._most, max_tool_speed=self.law.whole.speed_limit)
        return (
            "no other posture helps" if posture is None else plan_route(self.law, q, posture, failures, max_speeds=self._most)
        )

    def _plan_route(self, time: float, q: FloatArray, failures: Degraded) -> RouteFollower | str:
        follower = plan_route(self.law, q, self.law.pose, failures, max_speeds=self._most)
        return self._plan_trial(time, q) or follower if isinstance(follower, str) else follower

    def _plan_trial(self, time: float, q: FloatArray) -> RouteFollower | None:
        """Plan a slow route with the braked joint too, because a joint at a stop or a slow joint looks like one without torque.

        It is not sent on the way that it was to go, if there is a route without. Nothing is lost: else the arm stops here.
        """
        braked = np.flatnonzero(self.law.mask == 0)
        is_single = len(braked) == 1 and self._trial is None and int(braked[0]) not in self._true
        if self._react != "chain" or not self._doubted or not is_single:
            return None
        index, joint = int(braked[0]), self.arm.joint_names[int(braked[0])]
        limits = max(self.arm.lower[index], q[index] - 2 * np.pi), min(self.arm.upper[index], q[index] + 2 * np.pi)
        for direction in dict.fromkeys((self._way, 0.0)):
            low, high = q[index] if direction < 0 else limits[0], q[index] if direction > 0 else limits[1]
            if not limits[0] <= low < high <= limits[1]:
                continue
            failures = Degraded(self.arm, ranges={index: (low, high)})
            follower = plan_route(self.law, q, self.law.pose, failures, max_speeds=self._most)
            if not isinstance(follower, str):
                if self._named == joint:  # or what was heard of it before the release would brake it again
                    self._resume()
                self._trial, self.law.mask[index], self.pace, self._usual = index, 1.0, TRIAL_PACE, TRIAL_PACE
                self._lost, self._heard = 0.0, time
                self._lower[index], self._upper[index] = low, high
                self._brakes.release(joint)
                reason = "there is no route without it; slowly, as far as it follows"
                self._log_action(time, "release", reason, joint=joint)
                return follower
        return None


def calibrated_speeds(arm: Arm, bounds: Bounds) -> FloatArray:
    """Return the rates (n,) for which the monitor is calibrated, rad/s and m/s, within the limits; faster motion would raise
    alarms.
    """
    limits = np.array([joint.velocity for joint in arm.joints])
    return np.asarray(np.minimum(np.maximum(bounds.speed, MIN_CALIBRATED_SPEED), limits))
