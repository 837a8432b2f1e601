"""Closed loop of an arm with faults: the body in MuJoCo, the monitor, and the controller's response."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import get_args

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.laws.law import Law
from holdfast.control.physics.body import Body
from holdfast.control.physics.robot import MAX_PHYSICAL_SPEED, SimulatedRobots, split_tool_poses
from holdfast.control.physics.servos import Servos
from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress, track
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.formats.mjcf import silence_mujoco
from holdfast.model.arm.model import Arm
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance
from holdfast.response.diagnosis.monitor import Monitor
from holdfast.response.faults.events import FaultEvent
from holdfast.response.faults.fault_model import FaultModel
from holdfast.response.faults.injector import FaultInjector
from holdfast.response.supervisor.controller import Controller
from holdfast.response.supervisor.masked_law import MaskedLaw
from holdfast.response.supervisor.run import FaultRun, FaultRunOutcome, React

CONTROL_RATE_HZ = 1000.0  # control cycles without a monitor
DEFAULT_TIME_LIMIT_S = 12.0
POSITION_TOLERANCE_M = 5e-3  # distance to a reached target
ORIENTATION_TOLERANCE_RAD = np.deg2rad(1.0)  # angle to a reached target
DWELL_S = 0.2  # time at the target after which it counts as reached
POSE_RATE_HZ = 100.0  # measured tool poses
IDLE_END_S = 0.5  # time at rest after which no further motion is expected


@check_arguments
@silence_mujoco()
@reports_progress("simulating the faults")
def simulate_faults(
    law: Law,
    q0: ArrayLike,
    target: ArrayLike,
    *,
    faults: FaultModel | Sequence[FaultEvent] = (),
    episode: int = 0,
    monitor: Monitor | None = None,
    react: React | None = None,
    plan: bool = True,
    body: Body | None = None,
    servos: Servos | None = None,
    centring: float = 0.0,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    pose: bool = True,
    time_limit: float = DEFAULT_TIME_LIMIT_S,
    seed: int = 0,
) -> FaultRun:
    """Simulate a run in MuJoCo in which joints fail and the task continues (needs ``holdfast-arms[physics]``).

    In every control cycle the law reads the joint sensors. Its rates, limited by the joint limits, the velocity limits and
    10 rad/s^2, are commanded to the servos, whose torques move a body that differs from the arm's model. Faults begin and end
    as the fault model states. A monitor reads the signals of a robot: joint sensors, references, commanded torques, and the
    tool pose 100 times a second. With ``react="chain"`` the controller responds to the monitor:

    * A joint that does not move while its reference does, or that runs away, is braked 20 ms after the alarm and excluded from
      the law. So is a joint that is locked, free-swinging, has a faulty sensor, or has a fault of an unknown kind. The arm then
      waits for 0.05 s, and for 0.1 s more if the tool pose is measured, which shows whether the joint sensor can be trusted.
    * With a partial torque loss or more friction the arm continues at half the speed. A joint whose motor cannot carry 1.2
      times the weight of the arm is braked.
    * During a contact the arm continues at 0.3 of the speed, and after 1 s as before.
    * After each brake the remaining law is simulated forward. If it would miss the target, or has stopped short of it, the arm
      first moves to an intermediate configuration from which the law converges: all joints nearer to the middle of their
      ranges, or one joint mirrored about its middle. If there is none, :func:`holdfast.recover` plans a route. Neither takes
      simulated time. If there is no route, but one with the braked joint, the brake is released, once, and the arm follows that
      route as slowly as the joint requires, because a joint at a stop, or with a slow motor, looks like one without torque. If
      the joint does not follow it is braked again, and the arm stops.
    * With a cell, or a clearance, the forward simulation of the law must also be collision-free, and the arm leaves the law
      while it can still stop. Other configurations and routes are proved to be collision-free (:func:`holdfast.recover`), and
      if there is none the arm stops, even without ``plan``. The controller does not check for collisions before the first
      brake. ``contacts`` has the collisions of the run.

    A brake stops its joint at once. From then on the monitor excludes that joint and monitors the others, and the controller
    responds to a second fault in the same way, with the joints that remain. Nothing is monitored from a brake to the end of the
    wait.

    Args:
        law: Control law, with its arm, task, gain and speed limit. The arm needs inertial data.
        q0: (n,) configuration at the start, rad and m, at rest.
        target: (m,) or (4, 4), as for :func:`holdfast.simulate`.
        faults: Fault model, or the events of the run.
        episode: Index of the episode in the fault model, from 0.
        monitor: Monitor of the arm, with its detection thresholds; it is reset.
        react: Response to faults: ``chain``, the default with a monitor; ``none``, the default without one; ``stop``, where
            everything stops at the first alarm; ``known``, where each fault is known when it begins, without a monitor.
        plan: True if a route may be planned where no intermediate configuration helps; else the arm follows the law to its end.
        body: Differences of the robot from the arm's model; default: :class:`holdfast.Body`.
        servos: Servos of the joints; default: :class:`holdfast.Servos` at the rate of the monitor.
        centring: Rate in 1/s at which the law moves joints to the middle of their range, in the null space of the task.
        clearance: Collision model of the arm, with or without a cell; True: self-collisions by capsules of an assumed radius.
            None: self-collisions are not avoided.
        cell: Objects around the arm, or their file. None: no objects.
        pose: True if the tool pose is measured.
        time_limit: Time limit in s; the run ends earlier if the target is reached, or if nothing moves any more.
        seed: Seed of the sensor noise.

    Raises:
        InputError: A shape or an option is invalid, the arm cannot have a fault, or the monitor is of another arm or rate.
        ArmError: Inertial data are missing or impossible, or a joint carries no mass.
        HoldfastError: MuJoCo is not installed.
    """
    if not 0 < time_limit < np.inf:
        raise InputError(f"time_limit is {time_limit:g}; it must be a finite number of seconds above 0")
    if not 0 <= centring < np.inf:
        raise InputError(f"centring is {centring:g}; it must be a finite number of 0 or more, 1/s")
    if react is not None and react not in get_args(React):
        raise InputError(f"react '{react}' is not known; use {', '.join(get_args(React))}")
    response: React = react or ("none" if monitor is None else "chain")
    if response in ("stop", "chain") and monitor is None:
        raise InputError(f"react='{response}' needs a monitor; create one with holdfast.response.diagnosis.Monitor")
    chosen = servos or Servos(rate=CONTROL_RATE_HZ if monitor is None else monitor.bounds.rate)
    if monitor is not None:
        monitor.bounds.require(law.arm, chosen.rate)
        monitor.reset()
    start = law.arm.check_configurations(q0)
    if start.ndim != 1 or not np.isfinite(start).all():
        raise InputError(f"q0 has shape {start.shape}; it must be one configuration of finite numbers, ({law.arm.n},)")
    looked = chosen_clearance(law.arm, clearance or False, cell, looks=False)
    robot_body = Body() if body is None else body
    masked = MaskedLaw(law, target, centring=centring, clearance=looked)
    robot = _MonitoredRobot(
        law.arm, start, robot_body, chosen, faults=faults, episode=episode, horizon=time_limit, seed=seed, pose=pose
    )
    bounds = None if monitor is None else monitor.bounds
    controller = Controller(masked, bounds=bounds, brakes=robot.injector, monitor=monitor, react=response, plan=plan)
    outcome = _run_cycles(robot, controller, masked, monitor if response in ("stop", "chain") else None, response, time_limit)
    places = np.full(law.arm.n, np.nan)
    for event, position in robot.began.items():
        joint = law.arm.joint_index(event.joint)
        places[joint] = position if np.isnan(places[joint]) else places[joint]
    return FaultRun(
        law=law,
        servos=chosen,
        body=robot_body,
        target=masked.pose,
        react=response,
        events=robot.injector.events,
        places=places,
        actions=tuple(controller.actions),
        verdicts=tuple(controller.verdicts),
        degraded=controller.degraded,
        outcome=outcome,
        clearance=looked,
        **robot.recorded_arrays(),
    )


class _MonitoredRobot:
    """One simulated robot with faults whose servos follow commanded rates, and its log so far."""

    def __init__(
        self,
        arm: Arm,
        start: FloatArray,
        body: Body,
        servos: Servos,
        *,
        faults: FaultModel | Sequence[FaultEvent],
        episode: int,
        horizon: float,
        seed: int,
        pose: bool,
    ) -> None:
        self.arm, self.body, self._measures_pose, self.dt = arm, body, pose, 1 / servos.rate
        self.robots = SimulatedRobots(arm, [body], start[None], servos)
        (model,), (self.data,) = self.robots.models, self.robots.data
        self.injector = FaultInjector(model, self.data, arm, faults=faults, horizon=horizon)
        self.injector.reset(episode)
        self.robots.faults = [self.injector]
        self.rng, self.cycles_per_pose = np.random.default_rng([2, seed]), round(servos.rate / POSE_RATE_HZ) or 1
        self.reference = start.copy()
        self.began: dict[FaultEvent, float] = {}
        self.rows: list[tuple[FloatArray, ...]] = []

    def measure_joints_and_pose(self, cycle: int) -> tuple[FloatArray, FloatArray | None]:
        """Return the measured joint positions in a cycle and the measured tool pose, None without a sample."""
        noise = self.rng.normal(0, self.body.joint, (1, self.arm.n))
        (q_measured,) = self.robots.measure(cycle * self.dt, self.reference[None], noise)
        for event, position in self.injector.places.items():
            self.began.setdefault(event, position)
        if not self._measures_pose or cycle % self.cycles_per_pose:
            return q_measured, None
        return q_measured, self.body.measure_poses(self.arm.forward_kinematics(self.robots.q), self.rng)[0]

    @property
    def v(self) -> FloatArray:
        """(n,) measured rates, rad/s and m/s."""
        return np.asarray(self.data.qvel + self.robots.drives.rate_error[0])

    def advance_cycle(self, q: FloatArray, rates: FloatArray, mask: FloatArray) -> FloatArray:
        """Advance one cycle with commanded rates, the joints assumed at q (n,), and return the recorded motor torques (n,)."""
        (max_lead,), drives = self.robots.max_reference_lead, self.robots.drives
        reference = np.minimum(np.maximum(self.reference + self.dt * rates, q - max_lead), q + max_lead)
        inside = np.clip(reference, np.minimum(self.arm.lower, q), np.maximum(self.arm.upper, q))
        self.reference = np.where(mask > 0, inside, q)
        commands = self.robots.advance(q[None], self.reference[None], rates[None])
        (torque,) = drives.compute_mean_torque(commands, self.robots.read_positions() - self.robots.q)
        return np.asarray(torque + self.rng.normal(0, self.body.torque, self.arm.n))

    def record_cycle(
        self, q_measured: FloatArray, torque: FloatArray, pose: FloatArray | None, errors: tuple[float, float]
    ) -> None:
        """Record a cycle, in which the tool has a position and an orientation error."""
        measured_pose = np.full((4, 4), np.nan) if pose is None else pose
        self.rows.append((self.robots.q[0], q_measured, self.reference, torque, measured_pose, np.array(errors)))

    def recorded_arrays(self) -> dict[str, FloatArray]:
        """Return the fields of :class:`FaultRun` that are rows over time."""
        q, q_measured, reference, torque, poses, errors = (np.array(part) for part in zip(*self.rows, strict=True))
        x, quat = split_tool_poses(poses)
        fields = {"time": np.arange(len(q)) * self.dt, "q": q, "q_measured": q_measured, "reference": reference}
        return fields | {
            "torque": torque,
            "x": x,
            "quat": quat,
            "position_error": errors[:, 0],
            "orientation_error": errors[:, 1],
        }


def _run_cycles(
    robot: _MonitoredRobot, controller: Controller, law: MaskedLaw, monitor: Monitor | None, react: React, limit: float
) -> FaultRunOutcome:
    """Run the control cycles and return the outcome."""
    dt, errors, cycles_at_target, idle_cycles = robot.dt, (math.inf, math.inf), 0, 0
    last_onset = max((event.onset for event in robot.injector.events), default=0.0)
    for cycle in track("control cycles", range(int(np.ceil(limit / dt))), most=True, every=1000):
        time = cycle * dt
        (q_measured, pose), v = robot.measure_joints_and_pose(cycle), robot.v
        if cycle % robot.cycles_per_pose == 0:
            errors = law.target_errors(robot.robots.q[0])
            is_at_target = errors[0] <= POSITION_TOLERANCE_M and errors[1] <= ORIENTATION_TOLERANCE_RAD
            cycles_at_target = cycles_at_target + robot.cycles_per_pose if is_at_target else 0
        if react == "known":
            for event in robot.injector.active:
                controller.on_known_fault(time, event.kind, event.joint, robot.began[event])
        if pose is not None:
            controller.on_tool_pose(time, q_measured, pose)
        rates = controller.rates(time, q_measured)
        q = controller.trusted_positions(q_measured)
        torque = robot.advance_cycle(q, rates, law.mask)
        robot.record_cycle(q_measured, torque, pose, errors)
        if monitor is not None and not controller.is_stopped:
            verdict = monitor.step(q, robot.reference, torque, pose=pose)
            tracking_error, gravity = robot.reference - q, robot.robots.gravity[0]
            controller.on_verdict(time, verdict, tracking_error=tracking_error, v=v, commanded_rates=rates, gravity=gravity)
        speed = float(np.abs(robot.data.qvel).max())
        if not speed < MAX_PHYSICAL_SPEED:
            return "unstable"
        if cycles_at_target * dt >= DWELL_S:
            return "reached"
        idle_cycles = idle_cycles + 1 if controller.is_idle(rates) and speed < 0.05 and time > last_onset else 0
        if idle_cycles * dt > IDLE_END_S:
            break
    return "stopped" if controller.is_stopped else "missed"
