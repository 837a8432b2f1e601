"""What became of a joint motion with bodies and motors: where the tool got to, what was kept, whether it is at rest."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.poses import rotation_vectors
from holdfast.caching import cached_property
from holdfast.cell.cell import Cell
from holdfast.clearance.contacts import Contact
from holdfast.errors import HoldfastError
from holdfast.failures import Degraded
from holdfast.files.output import write_table
from holdfast.keep.kept import WITHIN, Kept
from holdfast.paths.joint_table import joint_columns
from holdfast.physics.servos import Servos, lag, time_at_effort
from holdfast.result import Result

Array = NDArray[np.float64]
Ended = Literal["finished", "stopped", "moving", "unstable"]

BEYOND = 1e-3  # rad or m past a limit of position that servos may take
_HARDLY = 1e-3  # mm or deg
FASTER = 0.01  # of a speed limit: servos may be so much above it


@dataclass(frozen=True, eq=False, kw_only=True)
class Execution(Result):
    """One run of :func:`holdfast.execute`, T control cycles.

    Attributes:
        arm: The arm, healthy.
        degraded: What is left of it at the end, joints that locked on the way with their values; None if nothing failed.
        servos: The joint servos.
        stiffness, damping: (n,) their gains, N m/rad and N m s/rad (N/m and N s/m for prismatic joints).
        lock_time: (n,) when each joint locked, s; infinite for those that did not.
        noticed: When the controller noticed, s; infinite if it did not before the motion was over.
        outcome: ``finished``: the motion was carried out to its end; ``stopped``: slowed to a standstill, since the lock was
            noticed; ``moving``: not at rest when the time was over; ``unstable``: the physics left all bounds.
        time: (T,) s.
        q: (T, n) measured configuration, rad and m.
        rates: (T, n) measured, rad/s and m/s.
        reference: (T, n) what the servos are to follow, rad and m.
        planned: (T, n) where the motion has the joints, rad and m; slowed down once a lock is noticed.
        torque: (T, n) of the motors of healthy joints, gravity compensation included, N m and N; 0 for a locked joint.
        goal: (4, 4) or (3,) where the tool should be at the end, m, world; None if nothing was asked for.
        keep: What should be kept at every instant.
        contacts: First of each link with each object of the cell, in order of time; None without a cell.
        cell: The objects around the arm; None without.
        error_limit: Largest allowed distance of a joint from the motion, rad and m; None: none was given.
    """

    arm: Arm
    degraded: Degraded | None
    servos: Servos
    stiffness: Array
    damping: Array
    lock_time: Array
    noticed: float
    outcome: Ended
    time: Array
    q: Array
    rates: Array
    reference: Array
    planned: Array
    torque: Array
    goal: Array | None = None
    keep: tuple[Kept, ...] = ()
    contacts: tuple[Contact, ...] | None = None
    cell: Cell | None = None
    error_limit: tuple[float, float] | None = None

    @property
    def at(self) -> Array:
        """(n,) where the arm is at the end, rad and m; with ``degraded`` what :func:`holdfast.recover` begins with."""
        return np.asarray(self.q[-1])

    @cached_property
    def poses(self) -> Array:
        """(T, 4, 4) of the end effector, m, world."""
        return self.arm.forward_kinematics(self.q)

    @property
    def goal_distance(self) -> float | None:
        """Between the tool point at the end and the goal, m; None without a goal."""
        if self.goal is None:
            return None
        wanted = self.goal[:3, 3] if self.goal.ndim == 2 else self.goal
        return float(np.linalg.norm(self.poses[-1, :3, 3] - wanted))

    @property
    def goal_turn(self) -> float | None:
        """Angle between the tool at the end and the goal, rad; None without a goal that has an orientation."""
        if self.goal is None or self.goal.ndim == 1:
            return None
        return float(np.linalg.norm(rotation_vectors(self.poses[-1, :3, :3] @ self.goal[:3, :3].T)))

    @property
    def there(self) -> bool:
        """The tool is at the goal, within 1 mm and 0.5 deg; True without one."""
        return (self.goal_distance or 0.0) <= WITHIN[0] and (self.goal_turn or 0.0) <= WITHIN[1]

    @cached_property
    def kept(self) -> tuple[tuple[float, float], ...]:
        """Of each thing in ``keep`` how far off, m, and how far turned away, rad, the tool was at most."""
        return tuple(one.farthest(self.poses) for one in self.keep)

    @cached_property
    def broken(self) -> tuple[str, ...]:
        """By how much what should be kept was broken, a phrase each; none if it was kept."""
        return tuple(trouble for one in self.keep if (trouble := one.trouble(self.poses)))

    @cached_property
    def beyond_limits(self) -> dict[str, float]:
        """Joints that were outside the limits in force by more than 1 mrad or 1 mm, by name, with the most, rad or m."""
        over = np.zeros(self.arm.n)
        for arm, part in self._in_force:
            q = self.q[part]
            over = np.maximum(over, np.maximum(arm.lower - q, q - arm.upper).max(axis=0, initial=0.0))
        return {self.arm.joint_names[k]: float(over[k]) for k in np.flatnonzero(over > BEYOND)}

    @cached_property
    def too_fast(self) -> dict[str, float]:
        """Joints that were more than 1 % above the speed limit in force, by name, with their highest speed, rad/s or m/s."""
        found: dict[str, float] = {}
        for arm, part in self._in_force:
            most = np.abs(self.rates[part]).max(axis=0, initial=0.0)
            for joint, speed in zip(arm.joints, most, strict=True):
                if speed > joint.velocity * (1 + FASTER):
                    found[joint.name] = max(float(speed), found.get(joint.name, 0.0))
        return found

    @property
    def _in_force(self) -> list[tuple[Arm, slice]]:
        """Arms with the limits in force, and in which rows: what is degraded is so from the first lock on."""
        if self.degraded is None:
            return [(self.arm, slice(None))]
        first = float(self.lock_time.min())
        k = int(np.searchsorted(self.time, first - 1e-9)) if np.isfinite(first) else 0
        return [(self.arm, slice(k)), (self.degraded.limited, slice(k, None))]

    @cached_property
    def locked(self) -> NDArray[np.bool_]:
        """(T, n) True where a joint is locked."""
        return np.asarray(self.time[:, None] >= self.lock_time - 1e-9)

    @property
    def tracking_error(self) -> Array:
        """(n,) largest distance of each joint from its reference while it was healthy, rad or m."""
        return lag(self.q, self.reference, self.locked)

    @cached_property
    def following_error(self) -> Array:
        """(T, n) distance of each joint from the motion, rad or m, locked joints too."""
        return np.abs(self.q - self.planned)

    @cached_property
    def exceeded(self) -> tuple[str, float] | None:
        """The joint that first exceeds the limit of the following error, by name, and when, s; None if none does."""
        if self.error_limit is None:
            return None
        share = self.following_error / np.where(self.arm.prismatic, self.error_limit[1], self.error_limit[0])
        late = np.flatnonzero((share > 1).any(axis=1))
        return (self.arm.joint_names[int(share[late[0]].argmax())], float(self.time[late[0]])) if late.size else None

    @cached_property
    def tool_error(self) -> tuple[Array, Array]:
        """Distance (T,) between the measured and the planned tool point, m, and the angle (T,) between the two tools, rad."""
        planned = self.arm.forward_kinematics(self.planned)
        turned = rotation_vectors(self.poses[:, :3, :3] @ planned[:, :3, :3].transpose(0, 2, 1))
        return np.linalg.norm(self.poses[:, :3, 3] - planned[:, :3, 3], axis=1), np.linalg.norm(turned, axis=1)

    @property
    def saturated(self) -> Array:
        """(n,) share of the time for which the motor of each joint was at its effort while the joint was healthy."""
        return time_at_effort(self.arm, self.torque, self.locked)

    @property
    def ok(self) -> bool:
        """The motion was finished, the tool is at the goal, everything was kept, limits too, and nothing was touched."""
        whole = self.outcome == "finished" and self.there and not self.broken
        return whole and not self.beyond_limits and not self.too_fast and not self.contacts and self.exceeded is None

    def require_ok(self) -> Execution:
        """Itself, or :class:`holdfast.HoldfastError` with what went wrong."""
        if not self.ok:
            raise HoldfastError(f"execution: {'; '.join(self.faults())}")
        return self

    def faults(self) -> list[str]:
        """What keeps it from being ``ok``, a phrase each."""
        found = [] if self.outcome == "finished" else [_ENDS[self.outcome]]
        if not self.there:
            found.append(f"the tool is {self._miss()} off the goal")
        found += [f"the tool was {trouble}" for trouble in self.broken]
        found += [f"{name} was {x:.3g} {self._unit(name)} outside its limits" for name, x in self.beyond_limits.items()]
        found += [f"{name} moved at {x:.4g} {self._unit(name)}/s, too fast" for name, x in self.too_fast.items()]
        if self.exceeded is not None and self.error_limit is not None:
            joint = self.arm.joints[self.arm.joint_index(self.exceeded[0])]
            factor, unit = joint.shown
            limit = factor * self.error_limit[joint.prismatic]
            found.append(f"the following error first exceeds {limit:.4g} {unit} at {self.exceeded[1]:.4g} s, in {joint.name}")
        return found + [contact.sentence() for contact in self.contacts or ()]

    def describe(self) -> list[str]:
        """A few sentences for people."""
        lines = [f"{self.arm.title}, {self.servos.describe()}, on MuJoCo: {_ENDS[self.outcome]} after {self.time[-1]:.3g} s"]
        for k in np.flatnonzero(np.isfinite(self.lock_time) & (self.lock_time <= self.time[-1])):
            joint, when = self.arm.joints[k], self.lock_time[k]
            factor, unit = joint.shown
            since = f"locked at {when:.4g} s" if when > 0 else "locked"
            lines.append(f"{joint.name} {since}, at {factor * self.at[k]:.4g} {unit}")
        if self.noticed <= self.time[-1]:
            lines.append(f"the controller noticed at {self.noticed:.4g} s and slowed down")
        if self.goal is not None:
            lines.append(f"the tool is {self._miss()} off the goal")
        away, angle = (np.stack([error.max(), error[-1]]) for error in self.tool_error)
        most, last = (f"{hardly(1000 * away[k])} mm and {hardly(np.rad2deg(angle[k]))} deg" for k in (0, 1))
        lines.append(f"the tool is at most {most} off the motion, at the end {last}")
        if self.error_limit is not None and self.exceeded is None:
            lines.append("the following error keeps its limit in every joint")
        for one, (off, turned) in zip(self.keep, self.kept, strict=True):
            said = [f"{1000 * off:.3g} mm off"] * bool(len(one.normals))
            said += [f"{np.rad2deg(turned):.3g} deg turned away"] * bool(np.isfinite(one.widest))
            lines.append(f"{one}: at most {' and '.join(said)}")
        if not self.beyond_limits and not self.too_fast:
            lines.append("the joints kept within their limits and speeds")
        return lines + [fault for fault in self.faults() if "off the goal" not in fault and fault != _ENDS[self.outcome]]

    def _miss(self) -> str:
        turned = "" if self.goal_turn is None else f" and {hardly(np.rad2deg(self.goal_turn))} deg"
        return f"{hardly(1000 * (self.goal_distance or 0.0))} mm{turned}"

    def _unit(self, name: str) -> str:
        return self.arm.joints[self.arm.joint_index(name)].unit

    def to_csv(self, file: str | Path) -> Path:
        """Write the motion as rows over time: the measured joints, rad and m, and the tool point, m.

        Raises:
            StoreError: It cannot be written.
        """
        header = ["time_s", *joint_columns(self.arm), "tool_x_m", "tool_y_m", "tool_z_m"]
        return write_table(file, "motion", header, np.column_stack([self.time, self.q, self.poses[:, :3, 3]]))


def hardly(value: float) -> str:
    """A number of 0 or more; one too small to matter in mm or deg only as such."""
    return f"{value:.3g}" if value >= _HARDLY or value == 0 else f"less than {_HARDLY:g}"


_ENDS = {
    "finished": "the motion was carried out to its end",
    "stopped": "the arm stopped on the way",
    "moving": "the arm was still moving at the end",
    "unstable": "the physics left all bounds; make the servos softer or their rate higher",
}
