"""Monitor that compares a log, or one control cycle after another, with the detection thresholds of a healthy arm."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import rotations_of_quaternions
from holdfast.response.diagnosis.answer import Diagnosis
from holdfast.response.diagnosis.bounds import Bounds
from holdfast.response.diagnosis.decision import CLASSIFICATION_TIME_S, ISOLATION_TIME_S, UNSURE, AlarmDecision
from holdfast.response.diagnosis.gaps import MAX_BRIDGED_GAP_S, count_cycles
from holdfast.response.diagnosis.kinds import FaultVerdict
from holdfast.response.diagnosis.observer import (
    FILTER_BANDWIDTH_RAD_S,
    LEVEL_BANDWIDTH_RAD_S,
    OBSERVER_GAIN_PER_S,
    friction_torque,
    momentum_kernel,
    slow_residual_component,
)
from holdfast.response.diagnosis.plausibility import prepare_log
from holdfast.response.diagnosis.sensors import Sensors
from holdfast.response.diagnosis.signals import (
    CALM_TIME_S,
    EXCESS_LIMITS_S,
    MAX_SLOW_RATE,
    SMOOTHING_SAMPLES,
    ScaledResiduals,
    Signals,
    compute_signals,
    tool_residual,
)
from holdfast.response.faults.log import Log


@check_arguments
def diagnose(arm: Arm, log: Log, bounds: Bounds, *, sensors: Sensors | None = None) -> Diagnosis:
    """Diagnose a log: find the first alarm, the faulty joint, its kind of fault, and the inconclusive joints.

    Args:
        arm: Arm that was recorded.
        log: Log to diagnose.
        bounds: Detection thresholds of the healthy arm, from :func:`holdfast.response.diagnosis.calibrate`.
        sensors: Accuracy of the sensors. Default: ``Sensors()``.

    Returns:
        The verdict, with the residuals and the joints that moved too little for a conclusion.

    Raises:
        InputError: The thresholds are of another arm or rate, or the log is of another arm.
        ArmError: Torques were recorded, and the arm's inertial data are missing or impossible.
    """
    return Monitor(arm, bounds, sensors=sensors).run(log)


class Monitor:
    """Fault monitor of an arm: call :meth:`step` in a control loop, or :meth:`run` for a log.

    Args:
        arm: Arm to monitor.
        bounds: Detection thresholds of the healthy arm; their rate is that of the control loop.
        sensors: Accuracy of the sensors. Default: ``Sensors()``.

    Raises:
        InputError: The thresholds are of another arm.
        ArmError: The thresholds include torques, and the arm's inertial data are missing or impossible.
    """

    def __init__(self, arm: Arm, bounds: Bounds, *, sensors: Sensors | None = None) -> None:
        bounds.require(arm, bounds.rate)
        self.arm, self.bounds, self.sensors = arm, bounds, sensors or Sensors()
        self._period = 1 / bounds.rate
        self._latency_cycles = round(self.sensors.latency * bounds.rate)
        self._max_gap_cycles, *self._decision_cycles = (
            count_cycles(seconds, self._period)
            for seconds in (MAX_BRIDGED_GAP_S, ISOLATION_TIME_S, ISOLATION_TIME_S + CLASSIFICATION_TIME_S)
        )
        self._momentum_kernel = momentum_kernel(bounds.body(arm)).single_row() if np.isfinite(bounds.torque).all() else None
        self.reset()

    # ---- a log -------------------------------------------------------------------------------------------------------

    def run(self, log: Log) -> Diagnosis:
        """Diagnose a log as repeated calls of :meth:`step` would; missing rows count as rows of NaN.

        Args:
            log: Log of the arm, at the rate of the thresholds.

        Raises:
            InputError: The log has another rate or number of joints, or no row in which every signal has a value.
        """
        bounds = self.bounds
        bounds.require(self.arm, log.rate)
        fitted_arm = bounds.body(self.arm)
        log = prepare_log(self.arm, log)
        signals = compute_signals(self.arm, log, coulomb=bounds.coulomb, viscous=bounds.viscous, body=fitted_arm)
        scaled = signals.scale_by_bounds(bounds.torque, bounds.tracking, bounds.position, bounds.angle)
        verdict = FaultVerdict(False) if scaled.alarm is None else self._decide_from_log(log, signals, scaled, *scaled.alarm)
        return Diagnosis(arm=self.arm, log=log, bounds=bounds, signals=signals, scaled=scaled, verdict=verdict)

    def _start_decision(
        self, time: float, available_signals: tuple[str, ...], alarmed: tuple[str, ...], initial_level: FloatArray
    ) -> AlarmDecision:
        available = {"torques": "torque" in available_signals, "tool": "tool" in available_signals}
        return AlarmDecision(
            self.arm,
            self.bounds,
            self.sensors,
            time=time,
            level=initial_level,
            joints=self._is_monitored,
            **available,
            tool_alone=alarmed == ("tool",),
        )

    def _decide_from_log(
        self, log: Log, signals: Signals, scaled: ScaledResiduals, row: int, alarmed: tuple[str, ...]
    ) -> FaultVerdict:
        """Return the verdict on a log from the cycles after its alarm."""
        is_calm_row = (scaled.torque[: row + 1] < UNSURE).all(axis=1)
        level_before = slow_residual_component(
            np.concatenate([np.zeros((1, log.n)), signals.torque[: row + 1][is_calm_row]]), signals.dt
        )[-1]
        decision = self._start_decision(float(log.t[row]), signals.levels, alarmed, level_before)
        rows = row + np.flatnonzero(signals.seen[row:])[: decision.end_cycle]
        signal_arrays = (signals.v, signals.torque, signals.asked, signals.gravity, scaled.torque, scaled.tracking)
        signal_parts, positions, reference = [signal[rows] for signal in signal_arrays], log.q[rows], log.q_ref[rows]
        has_pose = np.asarray(np.isfinite(signals.tool[rows]).all(axis=1))
        if log.x is not None and log.quat is not None and has_pose.any():
            rotations = rotations_of_quaternions(log.quat[rows][has_pose])
            residual = tool_residual(self.arm, positions[has_pose], log.x[rows][has_pose], rotations)
            pose_samples = iter(zip(residual, self.arm.jacobian(positions[has_pose]), strict=True))
        for index in range(len(positions)):
            rates, residual_torque, torque, gravity, scaled_torque, scaled_tracking = (signal[index] for signal in signal_parts)
            decision.add_cycle(
                positions[index], reference[index], (rates, residual_torque, torque, gravity), scaled_torque, scaled_tracking
            )
            if has_pose[index]:
                decision.add_tool_pose(float(scaled.tool[rows[index]]), *next(pose_samples))
        return decision.current_verdict(last=True)

    # ---- a control cycle ---------------------------------------------------------------------------------------------

    def reset(self) -> None:
        """Reset the monitor, so that the next step is the first one."""
        self._cycle_count, self._last_fast_cycle, self._pose_count, self._last_pose_cycle = 0, 0, 0, 0
        self._filtered_rates = self._residual = self._last_momentum = self._gravity_torque = self._filtered_torque = (
            self._twice_filtered_torque
        ) = self._residual_level = np.zeros(self.arm.n)
        self._last_q: FloatArray | None = None
        self._skipped_torque_sum = np.zeros(self.arm.n)  #  torques of skipped cycles
        self._skipped_cycles = self._skipped_with_torque = self._settling_cycles = 0
        self._past_positions = np.full((self._latency_cycles + 1, self.arm.n), np.nan)
        self._last_reference: FloatArray | None = None
        self._pose_residuals = np.zeros((SMOOTHING_SAMPLES, 6))
        self._is_monitored = np.ones(self.arm.n, dtype=bool)
        self.rearm()

    def rearm(self) -> None:
        """Clear the alarm and its accumulated excess while the arm keeps moving; time and filter states are kept."""
        self._torque_excess, self._tracking_excess, self._tool_excess = np.zeros(self.arm.n), np.zeros(self.arm.n), 0.0
        self._alarm_decision: AlarmDecision | None = None
        self.verdict = FaultVerdict(False)

    def exclude(self, joint: str) -> None:
        """Exclude a stopped joint from monitoring until :meth:`reset`, and clear the alarm.

        The torques of this joint are those of its brake, and its position may be better known than from its sensor.
        Therefore, the observer restarts, and the torques of all joints are ignored for 50 ms.

        Args:
            joint: Name of the stopped joint.

        Raises:
            InputError: The arm has no joint of this name.
        """
        self._is_monitored[self.arm.joint_index(joint)] = False
        self._restart_observer()
        self._past_positions[:], self._pose_residuals[:], self._pose_count = np.nan, 0.0, 0
        self.rearm()

    def _restart_observer(self) -> None:
        self._last_q, self._residual, self._settling_cycles = None, np.zeros(self.arm.n), self._max_gap_cycles + 1

    def step(
        self, q: ArrayLike, reference: ArrayLike, torque: ArrayLike | None = None, *, pose: ArrayLike | None = None
    ) -> FaultVerdict:
        """Process one control cycle and return the current verdict.

        Args:
            q: (n,) measured joint positions, rad and m. A cycle with NaN is skipped and raises no alarm.
            reference: (n,) references of the servos, rad and m.
            torque: (n,) commanded torques, N m and N. None: torques are not monitored.
            pose: (4, 4) measured tool pose, taken ``sensors.latency`` ago. None or NaN: no sample in this cycle.
        """
        position, reference_position = np.asarray(q, dtype=np.float64), np.asarray(reference, dtype=np.float64)
        commanded_torque = None if torque is None or self._momentum_kernel is None else np.asarray(torque, dtype=np.float64)
        self._cycle_count += 1
        self._past_positions[self._cycle_count % len(self._past_positions)] = position
        if not np.isfinite(position + reference_position).all() or (
            commanded_torque is not None and not np.isfinite(commanded_torque).all()
        ):
            self._skipped_cycles += 1
            if commanded_torque is not None and np.isfinite(commanded_torque).all():
                self._skipped_torque_sum = self._skipped_torque_sum + commanded_torque
                self._skipped_with_torque += 1
            return self.verdict
        elapsed = (self._skipped_cycles + 1) * self._period  # longer after skipped cycles
        self._bridge_skipped_cycles(position, commanded_torque)
        self._update_observer(position, commanded_torque)
        scaled_torque = np.where(self._is_monitored, np.abs(self._residual) / self.bounds.torque, 0.0)
        tracking = self._scaled_tracking(reference_position, position, elapsed, alone=commanded_torque is None)
        scaled_tracking = np.where(self._is_monitored, tracking, 0.0)
        self._torque_excess = np.maximum(0.0, self._torque_excess + (scaled_torque - 1) * self._period)
        self._tracking_excess = np.maximum(0.0, self._tracking_excess + np.nan_to_num(scaled_tracking - 1) * self._period)
        past_position = self._past_positions[(self._cycle_count + 1) % len(self._past_positions)]
        pose_sample = None if pose is None else self._add_pose_sample(past_position, np.asarray(pose, dtype=np.float64))
        if self._alarm_decision is None:
            if (scaled_torque < UNSURE).all():
                self._residual_level = self._filter(self._residual_level, self._residual, LEVEL_BANDWIDTH_RAD_S)
            largest_excess = self._torque_excess.max(), self._tracking_excess.max(), self._tool_excess
            excess_times = dict(zip(("torque", "tracking", "tool"), largest_excess, strict=True))
            alarmed = tuple(name for name in excess_times if excess_times[name] > EXCESS_LIMITS_S[name])
            if alarmed:
                time = (self._cycle_count - 1) * self._period
                levels = ("tracking", *["torque"] * (commanded_torque is not None), *["tool"] * (self._pose_count > 0))
                self._alarm_decision = self._start_decision(time, levels, alarmed, self._residual_level)
                self.verdict = FaultVerdict(True, time)
        if self._alarm_decision is not None and self._alarm_decision.count < self._alarm_decision.end_cycle:
            signals = self._filtered_rates, self._residual, self._twice_filtered_torque, self._gravity_torque
            self._alarm_decision.add_cycle(position, reference_position, signals, scaled_torque, scaled_tracking)
            if pose_sample is not None:
                self._alarm_decision.add_tool_pose(*pose_sample, self.arm.jacobian(past_position))
            if pose_sample is not None or self._alarm_decision.count in self._decision_cycles:
                self.verdict = self._alarm_decision.current_verdict()
        return self.verdict

    @property
    def stale(self) -> tuple[str, ...]:
        """Signals without a value for 50 ms: ``joints`` (positions, references, torques), or ``tool`` after its first pose."""
        is_tool_stale = self._pose_count > 0 and self._cycle_count - self._last_pose_cycle > self._max_gap_cycles
        return ("joints",) * (self._skipped_cycles > self._max_gap_cycles) + ("tool",) * is_tool_stale

    def _bridge_skipped_cycles(self, q: FloatArray, tau: FloatArray | None) -> None:
        """Interpolate linearly over skipped cycles; after too many, restart the observer and wait until the filters settle."""
        if self._last_q is not None and self._skipped_cycles > self._max_gap_cycles:
            self._restart_observer()
        elif self._last_q is not None and self._skipped_cycles:
            start_position, position_step = self._last_q, (q - self._last_q) / (self._skipped_cycles + 1)
            torque = (
                self._skipped_torque_sum / self._skipped_with_torque
                if self._skipped_with_torque == self._skipped_cycles
                else self._filtered_torque
            )
            for skipped in range(1, self._skipped_cycles + 1):
                self._update_observer(start_position + skipped * position_step, None if tau is None else torque)
        self._skipped_cycles, self._skipped_with_torque, self._skipped_torque_sum = 0, 0, np.zeros(len(q))

    def _scaled_tracking(self, reference: FloatArray, q: FloatArray, elapsed: float, *, alone: bool) -> FloatArray:
        """Return tracking errors in units of their thresholds; without torques, NaN unless all references were slow lately."""
        if self._last_reference is not None and (np.abs(reference - self._last_reference) >= MAX_SLOW_RATE * elapsed).any():
            self._last_fast_cycle = self._cycle_count
        self._last_reference = reference
        if alone and self._cycle_count - self._last_fast_cycle < count_cycles(CALM_TIME_S, self._period):
            return np.full(len(q), np.nan)
        return np.asarray(np.abs(reference - q) / self.bounds.tracking)

    def _add_pose_sample(self, q: FloatArray, pose: FloatArray) -> tuple[float, FloatArray] | None:
        """Return the smoothed residual of a tool pose sample in units of the thresholds, and the residual of this sample."""
        if not (np.isfinite(pose).all() and np.isfinite(q).all()):
            return None
        residual = tool_residual(self.arm, q[None], pose[None, :3, 3], pose[None, :3, :3])[0]
        self._pose_residuals[self._pose_count % SMOOTHING_SAMPLES] = residual
        mean_residual = self._pose_residuals[: self._pose_count + 1].sum(axis=0) / min(self._pose_count + 1, SMOOTHING_SAMPLES)
        position_error, angle_error = (float(np.linalg.norm(part)) for part in (mean_residual[:3], mean_residual[3:]))
        scaled_residual = max(position_error / self.bounds.position, angle_error / self.bounds.angle)
        if self._pose_count:  # one sample after a long gap is no evidence
            cycles_since = min(self._cycle_count - self._last_pose_cycle, self._max_gap_cycles)
            self._tool_excess = max(0.0, self._tool_excess + (scaled_residual - 1) * cycles_since * self._period)
        self._pose_count, self._last_pose_cycle = self._pose_count + 1, self._cycle_count
        return scaled_residual, residual

    def _update_observer(self, q: FloatArray, tau: FloatArray | None) -> None:
        period, is_settling = self._period, self._last_q is None or self._settling_cycles > 0
        if self._last_q is not None:  # after a restart, the arm is already moving: its first rate is not filtered
            bandwidth = np.inf if self._settling_cycles > self._max_gap_cycles else FILTER_BANDWIDTH_RAD_S
            self._filtered_rates = self._filter(self._filtered_rates, (q - self._last_q) / period, bandwidth)
            self._settling_cycles = max(0, self._settling_cycles - 1)
        elif tau is not None:
            self._filtered_torque = self._twice_filtered_torque = tau
        self._last_q = q
        if tau is None or self._momentum_kernel is None:
            return
        self._filtered_torque = self._filter(self._filtered_torque, tau, FILTER_BANDWIDTH_RAD_S)
        self._twice_filtered_torque = self._filter(self._twice_filtered_torque, self._filtered_torque, OBSERVER_GAIN_PER_S)
        terms = self._momentum_kernel(np.concatenate((q, self._filtered_rates)))
        momentum, energy, self._gravity_torque = terms.reshape(3, self.arm.n)
        if not is_settling:
            friction = friction_torque(self._filtered_rates, self.bounds.coulomb, self.bounds.viscous)
            known_torque = self._filtered_torque + energy - self._gravity_torque - friction
            unexplained = momentum - self._last_momentum - period * known_torque
            self._residual = (1 - OBSERVER_GAIN_PER_S * period) * self._residual + OBSERVER_GAIN_PER_S * unexplained
        self._last_momentum = momentum

    def _filter(self, value: FloatArray, target: FloatArray, bandwidth: float) -> FloatArray:
        """Return a filtered value one cycle later, which approaches its target with a bandwidth in rad/s."""
        return value + min(1.0, bandwidth * self._period) * (target - value)
