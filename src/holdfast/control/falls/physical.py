"""One fall in MuJoCo, with all contacts of the arm with itself and with a cell."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.falls.brakes import Brakes
from holdfast.control.falls.drop_points import DropOf, DropPoints
from holdfast.control.physics.surroundings import ContactLog, add_cell_objects, add_link_contacts
from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.files.output import write_table
from holdfast.core.progress import reports_progress, track
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.core.validation import require_real_numbers
from holdfast.kinematics.paths.joint_table import motion_column_names
from holdfast.model.arm.formats.mjcf import import_mujoco, silence_mujoco
from holdfast.model.arm.formats.mujoco_spec import build_mujoco_spec
from holdfast.model.arm.friction import JointFriction
from holdfast.model.arm.model import Arm
from holdfast.model.cell.cell import Cell
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.contacts import Contact

REST_WINDOW_S = 0.5
REST_TRAVEL = 1e-4  # rad or m: an arm whose joints move less within the window is at rest
STICTION_SPEED = 1e-3  # rad/s or m/s: a slower joint has the friction of a joint at rest


@dataclass(frozen=True, kw_only=True)
class PhysicalFall(Result):
    """Fall of an arm without power in MuJoCo, over T time steps.

    Attributes:
        arm: The arm.
        free: Indices from 0 of the joints that lost their torque.
        friction: Friction of each joint.
        brakes: Brakes; None without.
        of: ``tool``, or ``any point`` of the arm, whose drop is computed.
        time: (T,) time since the power loss, s.
        q: (T, n) configurations, rad and m.
        rates: (T, n) joint rates, rad/s and m/s.
        outcome: ``rest`` if no joint moved by 1e-4 rad or m in the last 0.5 s, else ``moving``.
        cell: Objects around the arm; None without a cell.
        contacts: First contact of each link with each object and each other link, in order of time; None if none were
            checked.
    """

    arm: Arm
    free: tuple[int, ...]
    friction: JointFriction
    brakes: Brakes | None
    of: DropOf
    time: FloatArray
    q: FloatArray
    rates: FloatArray
    outcome: Literal["rest", "moving"]
    cell: Cell | None
    contacts: tuple[Contact, ...] | None
    _points: DropPoints = field(repr=False, compare=False)

    @cached_property
    def tool_position(self) -> FloatArray:
        """(T, 3) tool point in the world, m."""
        return np.ascontiguousarray(self.arm.forward_kinematics(self.q)[:, :3, 3])

    @cached_property
    def drops(self) -> FloatArray:
        """(T,) displacement of the tool point, or of any point, along gravity since the power loss, m."""
        return self._points.drops(self.arm, self.q[:1], self.q)

    @property
    def drop(self) -> float:
        """Largest displacement of the tool point, or of any point, along gravity, m."""
        return float(self.drops.max())

    def drop_at(self, time: ArrayLike) -> FloatArray:
        """Return the displacement of ``drops``, m, at a time, s; (T,) for times (T,).

        After the end of the simulation, the displacement is that of the last time step.
        """
        times = require_real_numbers(time, "time")
        if not (times >= 0).all():
            raise InputError(f"time is {time!r}; give times of 0 or more, s")
        return np.asarray(np.interp(times, self.time, self.drops))

    def to_csv(self, file: str | Path) -> Path:
        """Write the motion to ``file`` as rows over time: configuration, joint rates, and tool point, m.

        Raises:
            StoreError: The file cannot be written.
        """
        return write_fall(file, self.arm, self.time, self.q, self.rates, self.tool_position)


def write_fall(file: str | Path, arm: Arm, time: FloatArray, q: FloatArray, rates: FloatArray, tool: FloatArray) -> Path:
    """Write a fall over times (T,) as a CSV file: configurations (T, n), joint rates (T, n), and tool points (T, 3)."""
    positions, speeds, _ = motion_column_names(arm)
    header = ["time_s", *positions, *speeds, "tool_x_m", "tool_y_m", "tool_z_m"]
    return write_table(file, "motion", header, np.column_stack([time, q, rates, tool]))


@silence_mujoco()
@reports_progress("simulating a fall in MuJoCo")
def simulate_contacts(
    arm: Arm,
    q: FloatArray,
    rates: FloatArray,
    *,
    free: Sequence[int],
    friction: JointFriction,
    brakes: Brakes | None,
    stops: bool,
    duration: float,
    clearance: Clearance | None,
    step: float,
    of: DropOf,
    points: DropPoints,
) -> PhysicalFall:
    """Simulate the fall from one state in MuJoCo; see :meth:`holdfast.PowerLoss.physical` for the arguments and errors."""
    mujoco, joints = import_mujoco(), sorted(free)
    spec = build_mujoco_spec(arm, q, joints, stops, step)
    brake_torque, brake_damping = (
        (np.zeros(len(joints)),) * 2 if brakes is None else (numbers[joints] for numbers in brakes.of_joints(arm).values())
    )
    log = ContactLog(clearance, itself=True)
    if log.clearance is not None:
        add_cell_objects(spec, log.clearance, step)
        add_link_contacts(spec, log.clearance, q, joints, step)
    model = spec.compile()
    log.require_collision_free(model)
    # Stiff constraints, because the default ones let a joint creep that friction holds.
    model.dof_solref[:], model.dof_solimp[:] = [2 * step, 1.0], [0.9999, 0.9999, 1e-3, 0.5, 2.0]
    if ((friction.viscous[joints] + brake_damping) * model.dof_invweight0 * step > 1).any():  # Runge-Kutta would diverge
        model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    data = mujoco.MjData(model)
    data.qvel[:] = rates[joints]
    positions, speeds = [data.qpos.copy()], [data.qvel.copy()]
    window, outcome = max(1, round(REST_WINDOW_S / step)), "moving"
    for index in track("time steps", range(int(np.ceil(duration / step - 1e-9))), most=True, every=window):
        is_braked = brakes is not None and index * step >= brakes.after - step / 2
        load = friction.load[joints] * np.abs(arm.gravity_torque(_configuration(q, joints, data.qpos))[joints])
        dry = np.where(np.abs(data.qvel) < STICTION_SPEED, friction.stiction[joints], friction.coulomb[joints])
        model.dof_frictionloss[:] = dry + load + is_braked * brake_torque
        model.dof_damping[:] = friction.viscous[joints] + is_braked * brake_damping
        mujoco.mj_step(model, data)
        if data.ncon:
            log.record_contacts(model, data, (index + 1) * step)
        positions.append(data.qpos.copy())
        speeds.append(data.qvel.copy())
        if (is_braked or brakes is None) and index >= window and np.ptp(positions[-window:], axis=0).max() < REST_TRAVEL:
            outcome = "rest"
            break
    if any(warning.number for warning in data.warning) or not np.isfinite(positions).all():
        raise InputError(f"the simulation in MuJoCo with a step of {step:g} s became unstable; make the step shorter")
    motion_rates = np.zeros((len(speeds), arm.n))
    motion_rates[:, joints] = speeds
    return PhysicalFall(
        arm=arm,
        free=tuple(joints),
        friction=friction,
        brakes=brakes,
        of=of,
        time=step * np.arange(len(positions), dtype=np.float64),
        q=_configuration(q, joints, np.array(positions)),
        rates=motion_rates,
        outcome=outcome,  # type: ignore[arg-type]
        cell=log.cell,
        contacts=log.list_contacts(),
        _points=points,
    )


def _configuration(q: FloatArray, joints: Sequence[int], displacement: FloatArray) -> FloatArray:
    """Return the configurations (..., n) after displacements (..., F) of the F joints from q (n,)."""
    moved = np.broadcast_to(q, (*displacement.shape[:-1], len(q))).copy()
    moved[..., joints] += displacement
    return moved
