"""Free swing of a failed joint under gravity until friction stops it, with all other joints locked."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.physics.fall import BrakedDrop, FreeSwing, Outcome
from holdfast.control.physics.surroundings import ContactLog, add_cell_objects
from holdfast.core.errors import ArmError, InputError
from holdfast.core.progress import reports_progress, track
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.formats.mjcf import import_mujoco, silence_mujoco
from holdfast.model.arm.formats.mujoco_spec import build_mujoco_spec
from holdfast.model.arm.machine import Joint
from holdfast.model.arm.model import Arm
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance

DEFAULT_BRAKE_TIMES_MS = (50.0, 100.0, 200.0)  # ms
DEFAULT_DAMPING_RATIO = 0.1  # fraction of critical damping that is used if the arm states less than MIN_DAMPING_RATIO
MIN_DAMPING_RATIO = 0.02  # fraction of critical damping; files have less as a placeholder, which would swing for minutes
REST_AMPLITUDE_RAD = 1e-4  # rad: amplitude of the remaining oscillation
STOP_SPEED = 1e-4  # rad/s or m/s, against a stop
BALANCED_TRAVEL = 1e-6  # rad or m: a smaller displacement counts as none
NEGLIGIBLE_FRACTION = 1e-9  # relative to mass, gravity and length of the swinging part
CHECK_INTERVAL_STEPS = 20  # steps
MIN_DURATION_S = 60.0  # s: bounds of the duration if none is given
MAX_DURATION_S = 300.0
MAX_STEP_S = 0.02  # s


@check_arguments
@silence_mujoco()
@reports_progress("simulating the swing")
def free_swing(
    arm: Arm,
    q: ArrayLike,
    joint: str | int,
    *,
    damping: float | None = None,
    duration: float | None = None,
    brake_after: Sequence[float] = DEFAULT_BRAKE_TIMES_MS,
    step: float = 1e-3,
    limits: bool = False,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
) -> FreeSwing:
    """Simulate the free swing of one failed joint under gravity, on MuJoCo (needs ``holdfast-arms[physics]``).

    From time 0 on the joint transmits no torque except viscous friction. The arm was at rest, and all other joints are held
    exactly. Only the objects of a cell obstruct the motion, and joint limits if ``limits`` is True; a prismatic joint always
    falls to its limit. The impact on a limit has no rebound, and the impact on an object nearly none. The capsules of the
    swinging links slide along an object (a coefficient of friction of 1; a mesh is its convex hull here). From exactly
    upright, rounding decides to which side the joint falls, so its rest angle may have either sign.

    The default friction is the joint's own, if the arm states one above 2 % of the critical damping of the small oscillation
    about its rest position. Many files contain less as a placeholder, with which the joint would swing for minutes. Otherwise
    it is 10 % of the critical damping, with which the joint swings widely (each swing loses about 27 % of its amplitude) and
    still stops. A prismatic joint has its own friction or none. Friction changes the peak, and the drops slightly, but neither
    the rest angle nor the initial acceleration. The motion is integrated by Runge-Kutta of fourth order, or implicitly if
    friction is too stiff for that.

    Args:
        arm: The arm, with inertial data for every link; a link may be massless.
        q: (n,) configuration at the failure, rad or m.
        joint: Name, or index from 0, of the failed joint.
        damping: Viscous friction, N m s/rad or N s/m. None: the default friction described above.
        duration: Longest simulated time, s; the simulation ends earlier if the joint stops (an amplitude below 1e-4 rad
            remains). Default: 60 s, and up to 300 s if the joint swings slowly.
        brake_after: Times from the failure to the brakes, ms.
        step: Time step, s.
        limits: True if the arm's limits stop the joint.
        clearance: Collision model of the arm, used with a cell, which it may contain. None: the default model.
        cell: Objects around the arm, or their file.

    Raises:
        InputError: A wrong joint, configuration or option, a start within an object, or a point cloud.
        ArmError: Inertial data are missing or impossible, the joint carries no mass, or a prismatic joint has no limit on the
            side to which it falls.
        HoldfastError: MuJoCo is not installed.
    """
    joint_number = arm.joint_index(joint)
    start = _check_start(arm, q)
    _check_options(damping, duration, brake_after, step)
    failed_joint = arm.joints[joint_number]
    has_stops = limits or failed_joint.prismatic
    if has_stops and not failed_joint.lower <= start[joint_number] <= failed_joint.upper:
        raise InputError(
            f"q puts joint '{failed_joint.name}' at {start[joint_number]:g} {failed_joint.unit}, outside its limits "
            f"{failed_joint.lower:g} to {failed_joint.upper:g}; start inside them"
        )
    contact_log = ContactLog(chosen_clearance(arm, clearance or False, cell, looks=False))
    model_spec = build_mujoco_spec(arm, start, [joint_number], has_stops, step)
    if contact_log.clearance is not None:
        add_cell_objects(model_spec, contact_log.clearance, step)
    swing = _SwingModel(model_spec.compile(), arm, joint_number, contact_log)
    contact_log.require_collision_free(swing.model)
    if failed_joint.prismatic and not swing.is_balanced:
        _require_stop(failed_joint, swing.acceleration > 0)
    friction = swing.choose_damping(damping, failed_joint)
    brakes = [float(brake_time) for brake_time in brake_after]
    last_brake = max(brakes, default=0.0) / 1000
    time, angle, velocity, tool_positions, outcome = swing.run(duration or swing.estimate_duration(friction), last_brake)
    return FreeSwing(
        arm=arm,
        q=start,
        joint=joint_number,
        damping=friction,
        time=time,
        angle=angle,
        velocity=velocity,
        tool_position=tool_positions,
        rest_angle=float("nan") if outcome == "moving" else float(angle[-1]),
        peak=float(np.abs(angle).max()),
        initial_acceleration=swing.acceleration,
        outcome=outcome,
        drops=tuple(_measure_drop(brake_time, time, angle, velocity, tool_positions, arm.gravity) for brake_time in brakes),
        cell=contact_log.cell,
        contacts=contact_log.list_contacts(),
    )


# ---- input -------------------------------------------------------------------------------------------------------


def _check_start(arm: Arm, q: ArrayLike) -> FloatArray:
    start = arm.check_configurations(q)
    if start.ndim != 1:
        raise InputError(f"q has shape {start.shape}; a free swing starts from one configuration, ({arm.n},)")
    if not np.isfinite(start).all():
        raise InputError(f"q for '{arm.name}' holds NaN or infinity; give {arm.n} finite numbers")
    return start


def _check_options(damping: float | None, duration: float | None, brake_after: Sequence[float], step: float) -> None:
    if damping is not None and not (np.isfinite(damping) and damping >= 0):
        raise InputError(f"damping is {damping:g}; it must be a finite number of 0 or more, N m s/rad or N s/m")
    if duration is not None and not (np.isfinite(duration) and duration > 0):
        raise InputError(f"duration is {duration:g} s; it must be a finite number above 0")
    if not 0 < step <= MAX_STEP_S:
        raise InputError(f"step is {step:g} s; it must be above 0 and at most {MAX_STEP_S:g} s")
    if duration is not None and duration < step:
        raise InputError(f"duration is {duration:g} s, shorter than one step of {step:g} s; make it longer")
    for brake_time in brake_after:
        if not (np.isfinite(brake_time) and brake_time >= 0):
            raise InputError(f"brake_after holds {brake_time:g}; every brake time must be a finite number of 0 or more, ms")
        longest = MAX_DURATION_S if duration is None else duration
        if brake_time / 1000 > longest * (1 + 1e-12):
            raise InputError(
                f"brake_after holds {brake_time:g} ms, which is after the end of the simulation at {longest:g} s; brake earlier"
                + ("" if duration is None else " or give a longer duration")
            )


def _require_stop(joint: Joint, upwards: bool) -> None:
    side_name, limit = ("upper", joint.upper) if upwards else ("lower", joint.lower)
    if not np.isfinite(limit):
        raise ArmError(
            f"prismatic joint '{joint.name}' has no {side_name} limit, towards which gravity moves it, so it would fall "
            "forever; give it that limit in m"
        )


# ---- the motion --------------------------------------------------------------------------------------------------


class _SwingModel:
    """MuJoCo model with one free joint at the moment of failure, and the motion that follows from the torque at that moment."""

    def __init__(self, model: Any, arm: Arm, joint: int, contact_log: ContactLog) -> None:
        self.mujoco, self.contact_log = import_mujoco(), contact_log
        self.model, self.data = model, self.mujoco.MjData(model)
        self.prismatic = bool(arm.prismatic[joint])
        label = f"arm '{arm.name}', joint '{arm.joint_names[joint]}'"
        mass = float(model.body_subtreemass[joint + 1])
        offsets = model.body_pos[joint + 2 : arm.n + 1], model.body_ipos[joint + 1 : arm.n + 1]
        length = float(sum(np.linalg.norm(part, axis=1).sum() for part in offsets))  # upper bound of the swinging length
        start_torque = self._holding_torque(0.0)
        inertia = np.zeros(1)
        self.mujoco.mj_mulM(model, self.data, inertia, np.ones(1))
        self.inertia = float(inertia[0])
        self.acceleration = float(self.data.qacc_smooth[0])
        weight = mass * float(np.linalg.norm(arm.gravity))
        if self.prismatic:
            self.stiffness, self.rest_angle = 0.0, 0.0
            self.is_balanced = abs(start_torque) <= NEGLIGIBLE_FRACTION * weight
        else:
            if self.inertia <= NEGLIGIBLE_FRACTION * mass * length**2:
                raise ArmError(
                    f"{label}: everything that it carries lies on its axis and has no inertia about it, so its acceleration is "
                    "not defined; give the links their inertia or the joint its armature"
                )
            # For one rigid body about one axis the torque is a sine of the angle, so two values determine it.
            quarter_torque = self._holding_torque(np.pi / 2)
            self.stiffness = float(np.hypot(start_torque, quarter_torque))
            self.rest_angle = float(-np.arctan2(start_torque, quarter_torque))
            self.is_balanced = self.stiffness <= NEGLIGIBLE_FRACTION * weight * length
        if self.is_balanced:
            self.acceleration = 0.0

    def _holding_torque(self, angle: float) -> float:
        """Return the actuator torque that holds the joint at an angle, N m or N."""
        self.mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[0] = angle
        self.mujoco.mj_forward(self.model, self.data)
        return float(self.data.qfrc_bias[0])

    def choose_damping(self, requested: float | None, joint: Joint) -> float:
        """Choose the friction, set it in the model, and return it."""
        if requested is not None:
            damping = float(requested)
        else:
            critical = 2 * float(np.sqrt(self.stiffness * self.inertia))
            damping = joint.friction if joint.friction > MIN_DAMPING_RATIO * critical else DEFAULT_DAMPING_RATIO * critical
        self.model.dof_damping[0] = damping
        if damping * self.model.opt.timestep > self.inertia:
            # Runge-Kutta would diverge; a motion with this friction is slow enough for a first-order method.
            self.model.opt.integrator = self.mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        return damping

    def estimate_duration(self, friction: float) -> float:
        """Estimate the time in which the joint comes to rest, s."""
        if self.is_balanced:
            return 1.0
        if friction == 0 or self.stiffness == 0:
            return MIN_DURATION_S
        frequency = np.sqrt(self.stiffness / self.inertia)
        ratio = friction / (2 * np.sqrt(self.stiffness * self.inertia))  # of critical damping
        slowest_rate = frequency * (ratio if ratio <= 1 else 1 / (ratio + np.sqrt(ratio**2 - 1)))
        return float(np.clip(15 / slowest_rate, MIN_DURATION_S, MAX_DURATION_S))

    def run(self, duration: float, min_duration: float) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, Outcome]:
        """Simulate the swing, and return times (T,), angles (T,), velocities (T,), tool positions (T, 3), and the outcome."""
        mujoco, model, data = self.mujoco, self.model, self.data
        step = float(model.opt.timestep)
        self._holding_torque(0.0)
        tool_site = model.site("tool").id
        samples = [(0.0, 0.0, *data.site_xpos[tool_site])]
        outcome: Outcome = "moving"
        last_step = int(np.ceil(max(duration, min_duration) / step - 1e-9))
        for step_number in track("time steps", range(1, last_step + 1), most=True, every=CHECK_INTERVAL_STEPS):
            mujoco.mj_step(model, data)
            if data.ncon:
                self.contact_log.record_contacts(model, data, step_number * step)
            mujoco.mj_kinematics(model, data)
            samples.append((data.qpos[0], data.qvel[0], *data.site_xpos[tool_site]))
            if step_number % CHECK_INTERVAL_STEPS == 0 and step_number * step >= min_duration:
                outcome = self._classify_state()
                if outcome != "moving":
                    break
        table: FloatArray = np.array(samples, dtype=np.float64)
        if np.abs(table[:, 0]).max() < BALANCED_TRAVEL and outcome == "moving":
            outcome = "balanced"
        time = step * np.arange(len(table), dtype=np.float64)
        return time, table[:, 0].copy(), table[:, 1].copy(), table[:, 2:].copy(), outcome

    def _classify_state(self) -> Outcome:
        """Classify the present state, which is moving unless nothing can move the joint any more."""
        data = self.data
        angle, velocity = float(data.qpos[0]), float(data.qvel[0])
        if self.is_balanced:
            return "balanced"
        self.mujoco.mj_forward(self.model, data)
        is_supported = data.nefc > 0 and abs(data.qacc[0]) < 1e-3 * abs(data.qacc_smooth[0])
        if is_supported and abs(velocity) < STOP_SPEED:
            return "contact" if data.ncon else "stop"
        if self.prismatic:
            return "moving"
        deviation, swing_time = angle - self.rest_angle, np.sqrt(self.inertia / self.stiffness)
        amplitude = np.hypot(np.arctan2(np.sin(deviation), np.cos(deviation)), velocity * swing_time)
        return "rest" if amplitude < REST_AMPLITUDE_RAD else "moving"


def _measure_drop(
    after_ms: float, time: FloatArray, angle: FloatArray, velocity: FloatArray, tool: FloatArray, gravity: FloatArray
) -> BrakedDrop:
    brake_time = after_ms / 1000
    displacement = np.array([np.interp(brake_time, time, tool[:, axis]) for axis in range(3)]) - tool[0]
    gravity_norm = float(np.linalg.norm(gravity))
    return BrakedDrop(
        after_ms=after_ms,
        angle=float(np.interp(brake_time, time, angle)),
        speed=float(np.interp(brake_time, time, velocity)),
        drop=float(displacement @ gravity) / gravity_norm if gravity_norm > 0 else 0.0,
        distance=float(np.linalg.norm(displacement)),
    )
