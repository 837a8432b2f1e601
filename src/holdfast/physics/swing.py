"""Free swing of a failed joint: it swings under gravity until friction stops it, all others held."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.machine import Joint
from holdfast.arm.mjcf import import_mujoco, quiet
from holdfast.arm.model import Arm
from holdfast.clearance.choice import CellLike, chosen_clearance
from holdfast.clearance.clearance import Clearance
from holdfast.errors import ArmError, InputError
from holdfast.notice import each, says
from holdfast.physics.fall import BrakedDrop, FreeSwing, Outcome
from holdfast.physics.model import compiled, mujoco_spec
from holdfast.physics.surroundings import Touches, surround

Array = NDArray[np.float64]
BRAKES = (50.0, 100.0, 200.0)  # ms
DAMPING_SHARE = 0.1  # of critical damping, where the arm states no friction to speak of
LEAST_SHARE = 0.02  # of critical damping; files carry less as a placeholder, and the joint would swing for minutes
AT_REST = 1e-4  # rad: amplitude of the oscillation that is left
STOPPED = 1e-4  # rad/s or m/s, against a stop
STILL = 1e-6  # rad or m: has not moved
NEGLIGIBLE = 1e-9  # relative to mass, gravity and length of what swings
CHECK_EVERY = 20  # steps
SHORTEST, LONGEST = 60.0, 300.0  # s, of the time allowed when none is given
LONGEST_STEP = 0.02  # s


@checked
@quiet()
@says("simulating the swing")
def free_swing(
    arm: Arm,
    q: ArrayLike,
    joint: str | int,
    *,
    damping: float | None = None,
    duration: float | None = None,
    brake_after: Sequence[float] = BRAKES,
    step: float = 1e-3,
    limits: bool = False,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
) -> FreeSwing:
    """Simulate the free swing of one failed joint under gravity, on MuJoCo (needs ``holdfast[physics]``).

    The joint transmits no torque from time 0 on except viscous friction; the arm was at rest; all other joints are held
    exactly. Nothing is in the way but the objects of a cell, and no limit unless ``limits``; a prismatic joint always falls to
    its limit. A stop takes the impact without rebound; an object does nearly, and the capsules of the links that swing slide
    along it (a coefficient of friction of 1; a mesh is its convex hull here). From exactly upright, rounding decides to which
    side it falls, so its rest angle may have either sign.

    Friction, if ``damping`` is not given: the joint's own, if the arm states one above 2 % of the critical damping of the
    small oscillation about its rest position (less is a placeholder in many files, and the joint would swing for minutes); else
    10 % of it, so that the joint swings widely (each swing loses about 27 % of its amplitude) and still stops; for a
    prismatic joint its own, or none. It changes the peak and a little the drops, but neither the rest angle nor the initial
    acceleration. The motion is integrated by Runge-Kutta of fourth order, or implicitly where friction is too stiff for that.

    Args:
        arm: With inertial data for every link; a link may be massless.
        q: (n,) configuration at the failure, rad or m.
        joint: Name, or index from 0, of the failed joint.
        damping: Viscous friction, N m s/rad or N s/m.
        duration: Longest time, s; it ends sooner where the joint has stopped (an amplitude below 1e-4 rad is left). If not
            given, 60 s, and up to 300 s where it swings slowly.
        brake_after: Times from the failure to the brakes, ms.
        step: Time step, s.
        limits: Whether the arm's limits stop the joint.
        clearance: The shape of the arm, with a cell or beside one.
        cell: Objects around the arm, or their file.

    Raises:
        InputError: A wrong joint, configuration or option, a start within an object, or a cloud of points.
        ArmError: Inertial data are missing or impossible, nothing heavy hangs on the joint, or a prismatic joint has no limit
            on the side to which it falls.
        HoldfastError: MuJoCo is not installed.
    """
    k = arm.joint_index(joint)
    start = _configuration(arm, q)
    _check(damping, duration, brake_after, step)
    failed = arm.joints[k]
    stops = limits or failed.prismatic
    if stops and not failed.lower <= start[k] <= failed.upper:
        raise InputError(
            f"q puts joint '{failed.name}' at {start[k]:g} {failed.unit}, outside its limits {failed.lower:g} to "
            f"{failed.upper:g}; start inside them"
        )
    looked = chosen_clearance(arm, clearance or False, cell, looks=False)
    around = None if looked is None or looked.cell is None else looked
    spec = mujoco_spec(arm, start, [k], stops, step)
    if around is not None:
        surround(spec, around, step)
    touches = Touches(around)
    swing = _Swing(compiled(spec, arm, [k]), arm, k, touches)
    touches.require_clear(swing.model)
    if failed.prismatic and not swing.flat:
        _require_stop(failed, swing.acceleration > 0)
    friction = swing.choose_damping(damping, failed)
    brakes = [float(t) for t in brake_after]
    last_brake = max(brakes, default=0.0) / 1000
    time, angle, velocity, tool, outcome = swing.run(duration or swing.patience(friction), last_brake)
    return FreeSwing(
        arm=arm,
        q=start,
        joint=k,
        damping=friction,
        time=time,
        angle=angle,
        velocity=velocity,
        tool_position=tool,
        rest_angle=float("nan") if outcome == "moving" else float(angle[-1]),
        peak=float(np.abs(angle).max()),
        initial_acceleration=swing.acceleration,
        outcome=outcome,
        drops=tuple(_drop(t, time, angle, velocity, tool, arm.gravity) for t in brakes),
        cell=None if around is None else around.cell,
        contacts=touches.contacts(),
    )


# ---- input -------------------------------------------------------------------------------------------------------


def _configuration(arm: Arm, q: ArrayLike) -> Array:
    start = arm.check_configurations(q)
    if start.ndim != 1:
        raise InputError(f"q has shape {start.shape}; a free swing starts from one configuration, ({arm.n},)")
    if not np.isfinite(start).all():
        raise InputError(f"q for '{arm.name}' holds NaN or infinity; give {arm.n} finite numbers")
    return start


def _check(damping: float | None, duration: float | None, brake_after: Sequence[float], step: float) -> None:
    if damping is not None and not (np.isfinite(damping) and damping >= 0):
        raise InputError(f"damping is {damping:g}; it must be a finite number of 0 or more, N m s/rad or N s/m")
    if duration is not None and not (np.isfinite(duration) and duration > 0):
        raise InputError(f"duration is {duration:g} s; it must be a finite number above 0")
    if not 0 < step <= LONGEST_STEP:
        raise InputError(f"step is {step:g} s; it must be above 0 and at most {LONGEST_STEP:g} s")
    if duration is not None and duration < step:
        raise InputError(f"duration is {duration:g} s, shorter than one step of {step:g} s; make it longer")
    for t in brake_after:
        if not (np.isfinite(t) and t >= 0):
            raise InputError(f"brake_after holds {t:g}; every brake time must be a finite number of 0 or more, ms")
        longest = LONGEST if duration is None else duration
        if t / 1000 > longest * (1 + 1e-12):
            raise InputError(
                f"brake_after holds {t:g} ms, which is after the end of the simulation at {longest:g} s; brake earlier"
                + ("" if duration is None else " or give a longer duration")
            )


def _require_stop(joint: Joint, upwards: bool) -> None:
    side, limit = ("upper", joint.upper) if upwards else ("lower", joint.lower)
    if not np.isfinite(limit):
        raise ArmError(
            f"joint '{joint.name}' slides and has no {side} limit, where gravity takes it, so it would fall forever; "
            "give it that limit in m"
        )


# ---- the motion --------------------------------------------------------------------------------------------------


class _Swing:
    """A MuJoCo model with one joint, at the moment of failure, and what its torque there says about the motion."""

    def __init__(self, model: Any, arm: Arm, k: int, touches: Touches) -> None:
        self.mujoco, self.touches = import_mujoco(), touches
        self.model, self.data = model, self.mujoco.MjData(model)
        self.prismatic = bool(arm.prismatic[k])
        label = f"arm '{arm.name}', joint '{arm.joint_names[k]}'"
        mass = float(model.body_subtreemass[k + 1])
        # What swings is no longer than this.
        length = float(
            np.linalg.norm(model.body_pos[k + 2 : arm.n + 1], axis=1).sum()
            + np.linalg.norm(model.body_ipos[k + 1 : arm.n + 1], axis=1).sum()
        )
        here = self._torque(0.0)
        inertia = np.zeros(1)
        self.mujoco.mj_mulM(model, self.data, inertia, np.ones(1))
        self.inertia = float(inertia[0])
        self.acceleration = float(self.data.qacc_smooth[0])
        weight = mass * float(np.linalg.norm(arm.gravity))
        if self.prismatic:
            self.stiffness, self.rest = 0.0, 0.0
            self.flat = abs(here) <= NEGLIGIBLE * weight
        else:
            if self.inertia <= NEGLIGIBLE * mass * length**2:
                raise ArmError(
                    f"{label}: all that it carries lies on its axis and has no inertia about it, so its acceleration is not "
                    "defined; give the links their inertia or the joint its armature"
                )
            # One rigid body about one axis: the torque is a sine of the angle, so two values give it all.
            quarter = self._torque(np.pi / 2)
            self.stiffness = float(np.hypot(here, quarter))
            self.rest = float(-np.arctan2(here, quarter))
            self.flat = self.stiffness <= NEGLIGIBLE * weight * length
        if self.flat:
            self.acceleration = 0.0

    def _torque(self, angle: float) -> float:
        """What the actuator must give to hold the joint there, N m or N."""
        self.mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[0] = angle
        self.mujoco.mj_forward(self.model, self.data)
        return float(self.data.qfrc_bias[0])

    def choose_damping(self, wanted: float | None, joint: Joint) -> float:
        """The friction to use, set in the model."""
        if wanted is not None:
            value = float(wanted)
        else:
            critical = 2 * float(np.sqrt(self.stiffness * self.inertia))
            value = joint.friction if joint.friction > LEAST_SHARE * critical else DAMPING_SHARE * critical
        self.model.dof_damping[0] = value
        if value * self.model.opt.timestep > self.inertia:
            # Runge-Kutta would blow up; motion this viscous is slow enough for a method of first order.
            self.model.opt.integrator = self.mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        return value

    def patience(self, friction: float) -> float:
        """Time that should be enough to stop, s."""
        if self.flat:
            return 1.0
        if friction == 0 or self.stiffness == 0:
            return SHORTEST
        frequency = np.sqrt(self.stiffness / self.inertia)
        ratio = friction / (2 * np.sqrt(self.stiffness * self.inertia))
        slowest = frequency * (ratio if ratio <= 1 else 1 / (ratio + np.sqrt(ratio**2 - 1)))
        return float(np.clip(15 / slowest, SHORTEST, LONGEST))

    def run(self, duration: float, at_least: float) -> tuple[Array, Array, Array, Array, Outcome]:
        """Times (T,), angles (T,), velocities (T,), tool positions (T, 3), and how it ended."""
        mujoco, model, data = self.mujoco, self.model, self.data
        step = float(model.opt.timestep)
        self._torque(0.0)
        tool = model.site("tool").id
        rows = [(0.0, 0.0, *data.site_xpos[tool])]
        outcome: Outcome = "moving"
        last = int(np.ceil(max(duration, at_least) / step - 1e-9))
        for k in each("time steps", range(1, last + 1), most=True, every=CHECK_EVERY):
            mujoco.mj_step(model, data)
            if data.ncon:
                self.touches.note(model, data, k * step)
            mujoco.mj_kinematics(model, data)
            rows.append((data.qpos[0], data.qvel[0], *data.site_xpos[tool]))
            if k % CHECK_EVERY == 0 and k * step >= at_least and (outcome := self._outcome()) != "moving":
                break
        table: Array = np.array(rows, dtype=np.float64)
        if np.abs(table[:, 0]).max() < STILL and outcome == "moving":
            outcome = "balanced"
        time = step * np.arange(len(table), dtype=np.float64)
        return time, table[:, 0].copy(), table[:, 1].copy(), table[:, 2:].copy(), outcome

    def _outcome(self) -> Outcome:
        """How it is now: moving unless nothing can move it any more."""
        data = self.data
        angle, velocity = float(data.qpos[0]), float(data.qvel[0])
        if self.flat:
            return "balanced"
        self.mujoco.mj_forward(self.model, data)
        held = data.nefc > 0 and abs(data.qacc[0]) < 1e-3 * abs(data.qacc_smooth[0])
        if held and abs(velocity) < STOPPED:
            return "contact" if data.ncon else "stop"
        if self.prismatic:
            return "moving"
        off = angle - self.rest
        amplitude = np.hypot(np.arctan2(np.sin(off), np.cos(off)), velocity * np.sqrt(self.inertia / self.stiffness))
        return "rest" if amplitude < AT_REST else "moving"


def _drop(after_ms: float, time: Array, angle: Array, velocity: Array, tool: Array, gravity: Array) -> BrakedDrop:
    t = after_ms / 1000
    moved = np.array([np.interp(t, time, tool[:, axis]) for axis in range(3)]) - tool[0]
    pull = float(np.linalg.norm(gravity))
    return BrakedDrop(
        after_ms=after_ms,
        angle=float(np.interp(t, time, angle)),
        speed=float(np.interp(t, time, velocity)),
        drop=float(moved @ gravity) / pull if pull > 0 else 0.0,
        distance=float(np.linalg.norm(moved)),
    )
