"""Result of the falls of an arm that lost its power."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Self, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.control.falls.brakes import Brakes
from holdfast.control.falls.contact import FallContacts
from holdfast.control.falls.drop_points import DropOf
from holdfast.control.falls.simulator import FallSimulator, FallStates
from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.result import Result
from holdfast.core.status import SentenceEnum, require_ok
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.model.arm.friction import JointFriction
from holdfast.model.arm.model import Arm
from holdfast.model.cell.cell import Cell
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance

if TYPE_CHECKING:
    from holdfast.control.falls.physical import PhysicalFall
    from holdfast.control.falls.sweep import Sweep

FallMeasure = Literal["drop", "released", "impact_speed", "impact_energy"]
MEASURE_UNITS: dict[str, str] = {"drop": "m", "released": "J", "impact_speed": "m/s", "impact_energy": "J"}
MAX_STEP_S = 0.02  # s, of all simulations of falls
SWEEP_INSTANTS = 2001
Falls = TypeVar("Falls", "PowerLoss", FallContacts)


class FallOutcome(SentenceEnum):
    """Outcome of one fall."""

    HOLDS = 0, "holds: nothing moves"
    REST = 1, "falls and then lies still"
    MOVING = 2, "still moves at the end of the simulated time"
    UNKNOWN = 3, "was not simulated, or not to the end: see the status"
    CONTACT = 4, "touches an object or itself, where the simulation ends"


_OUTCOME_NAMES = np.array([outcome.name.lower() for outcome in FallOutcome])


@dataclass(frozen=True, kw_only=True)
class PowerLoss(Result):
    """Falls of an arm of which some or all joints lost their torque, from N states; for a single state arrays lack the axis N.

    All joints in ``free`` move under gravity, inertia, friction, stops, and brakes; all others are held exactly. A fall
    with a contact ends there, so its values at the end are those at the contact, and its ``drop`` is a lower bound.

    Attributes:
        arm: The arm.
        q: (N, n) configurations at the power loss, rad and m.
        rates: (N, n) joint rates at the power loss, rad/s and m/s.
        free: Indices from 0 of the joints that lost their torque.
        friction: Friction of each joint.
        brakes: Brakes; None without.
        restitution: Ratio of the speeds after and before the impact of a joint on its stop.
        stops: True if the limits of the arm stop its joints.
        duration: Simulated time, s.
        step: (N,) longest time step, s.
        q_final: (N, n) configurations at the end, rad and m.
        rates_final: (N, n) joint rates at the end, rad/s and m/s.
        of: ``tool``, or ``any point`` of the arm, whose drop was computed.
        drop: (N,) largest displacement of the tool point, or of any point, along gravity within the duration, m.
        released: (N,) energy released, J: potential and kinetic energy at the power loss, minus the potential energy at the
            end. The part that is not kinetic energy at the end was dissipated.
        rest_time: (N,) time from which on all joints are at rest, s; NaN if a joint still moves.
        code: (N,) :class:`holdfast.control.falls.FallOutcome` of each fall.
        status: (N,) :class:`holdfast.Status` of each fall.
        residual: (N,) largest torque or force by which a step contradicts the laws of friction and contact, N m or N; 0 if none
            does.
        contacts: First contacts; None if they were not searched for.
        clearance: Collision model of these contacts, with its cell; None if they were not searched for.
    """

    arm: Arm
    q: FloatArray
    rates: FloatArray
    free: tuple[int, ...]
    friction: JointFriction
    brakes: Brakes | None
    restitution: float
    stops: bool
    duration: float
    of: DropOf
    step: FloatArray
    q_final: FloatArray
    rates_final: FloatArray
    drop: FloatArray
    released: FloatArray
    rest_time: FloatArray
    code: NDArray[np.uint8]
    status: NDArray[np.uint8]
    residual: FloatArray
    contacts: FallContacts | None
    clearance: Clearance | None
    _simulator: FallSimulator = field(repr=False, compare=False)

    def __len__(self) -> int:
        return int(np.size(self.code))

    @property
    def outcome(self) -> NDArray[np.str_]:
        """(N,) outcome of each fall as text: ``holds``, ``rest``, ``moving``, ``contact`` or ``unknown``."""
        return np.asarray(_OUTCOME_NAMES[self.code])

    @property
    def cell(self) -> Cell | None:
        """Objects with which contacts were searched for."""
        return None if self.clearance is None else self.clearance.cell

    @cached_property
    def error(self) -> FloatArray:
        """(N,) estimated error of the tool point at the end, m.

        This is twice the distance from the result of a second simulation to the same time, whose steps are twice as long. It
        runs when the error is first read.
        """
        tool = self._evaluate_at(self.duration, lambda states: states.tool, step_ratio=2.0)
        final = self._simulator.tool_points(np.atleast_2d(self.q_final)).reshape(tool.shape)
        return np.asarray(2 * np.linalg.norm(final - tool, axis=-1))

    def q_at(self, time: ArrayLike) -> FloatArray:
        """Return the configurations (N, n), rad and m, at a time since the power loss, s; (N, T, n) for times (T,)."""
        return self._evaluate_at(time, lambda states: states.q)

    def rates_at(self, time: ArrayLike) -> FloatArray:
        """Return the joint rates (N, n), rad/s and m/s, at a time since the power loss, s; (N, T, n) for times (T,)."""
        return self._evaluate_at(time, lambda states: states.rates)

    def tool_at(self, time: ArrayLike) -> FloatArray:
        """Return the tool points (N, 3) in the world, m, at a time since the power loss, s; (N, T, 3) for times (T,)."""
        return self._evaluate_at(time, lambda states: states.tool)

    def drop_at(self, time: ArrayLike) -> FloatArray:
        """Return the displacements (N,) along gravity, m, of the tool or of any point at a time, s; (N, T) for times (T,).

        The displacement is negative where the point is above its initial position.
        """
        q, points = self.q_at(time), self._simulator.points
        return points.drops(self.arm, self.q.reshape(*self.q.shape[:-1], *[1] * np.ndim(time), self.arm.n), q)

    def to_csv(self, file: str | Path) -> Path:
        """Write the motion of a single fall to ``file`` as rows every 10 ms, with the columns of a physical fall.

        Raises:
            InputError: There are several falls.
            StoreError: The file cannot be written.
        """
        from holdfast.control.falls.physical import write_fall

        if self.q.ndim > 1:
            raise InputError(f"a file holds one fall, and there are {len(self)}; simulate one of them alone")
        time = np.linspace(0.0, self.duration, 1 + max(1, round(100 * self.duration)))
        return write_fall(file, self.arm, time, self.q_at(time), self.rates_at(time), self.tool_at(time))

    @check_arguments
    def physical(
        self,
        row: int | None = None,
        *,
        clearance: Clearance | bool | None = None,
        cell: CellLike | None = None,
        step: float = 1e-3,
    ) -> PhysicalFall:
        """Simulate one fall in MuJoCo, with all contacts of the arm with itself and with a cell.

        Friction, brakes, and stops are as in this fall, but MuJoCo's constraints are soft, and a joint does not rebound from
        its stop. Contacts are as stiff as the step allows, critically damped, and have a coefficient of friction of 1. A mesh
        is its convex hull. Links that overlap at the power loss do not touch each other. The simulation ends early if no joint
        has moved by 1e-4 rad or m in the last 0.5 s. It needs ``holdfast-arms[physics]``.

        Args:
            row: Number of the fall, from 0. Default: the only one.
            clearance: Collision model of the arm, which may contain a cell. True also checks the links of a planar arm against
                each other, and False no links. Default: that of this fall, or the default model.
            cell: Objects around the arm, or their file.
            step: Time step, s, at most 0.02 s.

        Raises:
            InputError: A wrong row or step, a start within an object, a point cloud, or a simulation that becomes unstable.
            ArmError: Inertial data are missing or impossible, or a joint carries no mass.
            HoldfastError: MuJoCo is not installed.
        """
        from holdfast.control.falls.physical import simulate_contacts

        if not 0 < step <= MAX_STEP_S:
            raise InputError(f"step is {step:g} s; it must be above 0 and at most {MAX_STEP_S:g} s")
        fall = self._select_row(row)
        return simulate_contacts(
            self.arm,
            fall.q,
            fall.rates,
            free=self.free,
            friction=self.friction,
            brakes=self.brakes,
            stops=self.stops,
            duration=self.duration,
            clearance=chosen_clearance(self.arm, self.clearance if clearance is None else clearance, cell),
            step=step,
            of=self.of,
            points=self._simulator.points,
        )

    @check_arguments
    def sweep(self, row: int | None = None, *, voxel: float = 5e-3) -> Sweep:
        """Compute the space that the moving links sweep during one fall, until its first contact if contacts were searched for.

        Args:
            row: Number of the fall, from 0. Default: the only one.
            voxel: Size of the voxels, m.

        Returns:
            A :class:`holdfast.control.falls.Sweep`.

        Raises:
            InputError: A wrong row or voxel, or a collision model without moving links.
        """
        from holdfast.control.falls.sweep import sweep_spheres
        from holdfast.model.collision.cover import choose_capsules

        fall = self._select_row(row)
        contact_time = np.nan if fall.contacts is None else fall.contacts.time
        q = fall.q_at(np.linspace(0.0, np.nanmin([self.duration, fall.rest_time, contact_time]), SWEEP_INSTANTS))
        if not np.isfinite(q).all():
            raise InputError(f"the fall in row {row or 0} could not be simulated, so its sweep is unknown; choose another row")
        capsules = choose_capsules(self.arm) if self.clearance is None else self.clearance.capsules
        return sweep_spheres(self.arm, capsules, q, voxel)

    def _select_row(self, row: int | None) -> PowerLoss:
        """Return the fall of one row, which has a finite state."""
        rows = len(self)
        if not (row is None and rows == 1) and not (row is not None and 0 <= row < rows):
            raise InputError(f"row is {row}; give the number of one fall, from 0 to {rows - 1}")
        fall = self if self.q.ndim == 1 else _take_row(self, row or 0)
        if not np.isfinite([fall.q, fall.rates]).all():
            raise InputError(
                f"the state in row {row or 0} holds NaN or infinity, so it cannot be simulated; choose another row"
            )
        return fall

    def energies_at(self, time: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Return the energy released and the kinetic energy (T,), J, of a single fall at times (T,), s."""
        initial, kinetic = self._simulator.energies(np.atleast_2d(self.q), np.atleast_2d(self.rates))
        potential, current = self._simulator.energies(self.q_at(time), self.rates_at(time))
        return initial[0] + kinetic[0] - potential, current

    def require_ok(self) -> Self:
        """Return the result itself, or raise :class:`holdfast.HoldfastError` that names the first fall without an answer."""
        require_ok(self.status, "power loss")
        return self

    def _evaluate_at(self, time: ArrayLike, select: Callable[[FallStates], FloatArray], step_ratio: float = 1.0) -> FloatArray:
        """Simulate all falls again up to each time, so that the steps before it are those of the whole fall, times a ratio."""
        times = require_real_numbers(time, "time")
        if times.ndim > 1 or not ((times >= 0) & (times <= self.duration)).all():
            raise InputError(f"time is {time!r}; give one time or a list of times from 0 to the duration, {self.duration:g} s")
        q, rates = np.atleast_2d(self.q), np.atleast_2d(self.rates)
        rows = np.isfinite(q).all(axis=1) & np.isfinite(rates).all(axis=1)
        ends = np.full(len(q), self.duration if self.contacts is None else self.contacts.time)
        all_times = np.fmin(np.atleast_1d(times), ends[rows, None])  # a fall remains where its contact is
        count, repeat = all_times.shape
        states = self._simulator.run(
            np.repeat(q[rows], repeat, axis=0),
            np.repeat(rates[rows], repeat, axis=0),
            all_times.ravel(),
            np.repeat(step_ratio * np.atleast_1d(self.step)[rows], repeat),
        )
        selected = select(states)
        values = np.full((len(q), repeat, selected.shape[1]), np.nan)
        values[rows] = selected.reshape(count, repeat, selected.shape[1])
        return values.reshape(*self.q.shape[:-1], *times.shape, selected.shape[1])


def measure_fall(fall: PowerLoss, measure: FallMeasure) -> FloatArray:
    """Return a measure (N,) of each fall: its drop, its released energy, or the speed or energy of its first contact.

    Speed and energy are NaN for a fall without contact.
    """
    if measure in ("drop", "released"):
        return np.asarray(getattr(fall, measure))
    if fall.contacts is None:
        return np.full(np.shape(fall.drop), np.nan)
    return fall.contacts.normal_speed if measure == "impact_speed" else fall.contacts.energy_lost


def _take_row(falls: Falls, row: int) -> Falls:
    """Return the part of a result, or of its contacts, that belongs to one fall."""
    values = {each.name: getattr(falls, each.name) for each in fields(falls)}
    parts: dict[str, Any] = {name: value[row] for name, value in values.items() if isinstance(value, np.ndarray)}
    if isinstance(falls, PowerLoss) and falls.contacts is not None:
        parts["contacts"] = _take_row(falls.contacts, row)
    return replace(falls, **parts)
