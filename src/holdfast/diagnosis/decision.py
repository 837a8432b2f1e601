"""Which joint it is and what it has: decided from what follows the alarm, cycle by cycle, with a state that does not grow.

Source: derived here; the thresholds were set on simulated faults other than those that they were measured with.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.diagnosis.bounds import Bounds
from holdfast.diagnosis.gaps import cycles
from holdfast.diagnosis.kinds import SCALE, Kinds, Verdict
from holdfast.diagnosis.observer import SLIP
from holdfast.diagnosis.sensors import Sensors

Array = NDArray[np.float64]

ISOLATE, CLASSIFY = 0.020, 0.100  # s after the alarm, s after that
AGAIN, WATCHED = 0.5, 2.0  # s after the alarm: the tool's pose may still call it a sensor, and may name that
SUSPECT = 1.5  # of the tool's bound: then the joints are not where their sensors say
WORSE = 28.0  # in squares of deviations: another joint explains the tool's pose so much worse
_SAME = 1e-9  # of the largest: a direction in which a force loads no joint
UNSURE = 0.7  # of a torque bound: a level of residuals follows them while all are below; healthy ones are below 1 / factor
PUSHED = 4.0  # likewise a force at the far end of a link explains the torques so much better than one joint


class Decision:
    """What one alarm comes to.

    Args:
        arm: The arm.
        bounds: Of the healthy arm.
        sensors: How good they are.
        time: Of the alarm, s.
        level: (n,) of the residual torques before it, N m and N.
        joints: (n,) those that are watched.
        torques: Whether torques are watched.
        tool: Whether the tool's pose is measured at all.
        tool_alone: Whether nothing but the tool's pose alarmed.
    """

    def __init__(
        self,
        arm: Arm,
        bounds: Bounds,
        sensors: Sensors,
        *,
        time: float,
        level: Array,
        joints: NDArray[np.bool_],
        torques: bool,
        tool: bool,
        tool_alone: bool,
    ) -> None:
        n, dt = arm.n, 1 / bounds.rate
        self._arm, self._bounds, self._noise = arm, bounds, sensors.joint
        self._time, self._level, self._torques, self._tool = time, level, torques, tool
        self._split, self._last = cycles(ISOLATE, dt), cycles(ISOLATE + CLASSIFY, dt)
        self._again, self.ends = cycles(AGAIN, dt), cycles(WATCHED, dt)
        self.count = 0
        self._size, self._residual = np.zeros(n), np.zeros(n)
        self.push = 0.0
        self._kinds: Kinds | None = None
        self._suspect = tool_alone
        self._weight = np.repeat(1 / np.array([sensors.position, sensors.angle]), 3)
        self._left, self._poses = np.where(joints, 0.0, np.inf), 0
        self._scale = np.where(joints, SCALE * bounds.change, np.inf)
        self._told: tuple[int, float] | None = None

    def add(self, q: Array, reference: Array, signals: tuple[Array, Array, Array, Array], z: Array, y: Array) -> None:
        """A control cycle.

        Args:
            q: (n,) rad and m.
            reference: (n,) rad and m.
            signals: (n,) each: rates, residual torques, commanded torques through both filters of these, gravity torques.
            z: (n,) residual torques in units of their bounds.
            y: (n,) tracking likewise.
        """
        self.count += 1
        if self.count <= self._split:
            self._size += np.nan_to_num(np.maximum(z, y) if self._torques else y)
            self._residual += signals[1]
            if self.count == self._split:
                self._isolate(q)
        elif self._kinds is not None and self.count <= self._last:
            i = self._kinds.joint
            v, r, torque, gravity = (float(signal[i]) for signal in signals)
            self._kinds.add(float(q[i]), float(reference[i]), float(np.tanh(v / SLIP)), (r, torque, gravity))

    def see(self, w: float, residual: Array, jacobian: Array) -> None:
        """A sample of the tool's pose in the cycle that :meth:`add` was given last.

        What each joint leaves unexplained, ``c = -J_i b`` with an error of its own for each sample, for a sensor that is
        frozen drifts away.

        Args:
            w: Smoothed residual of the pose, in units of its bounds.
            residual: (6,) of this sample, m and rad.
            jacobian: (6, n) there.
        """
        if self.count <= self._again and w > SUSPECT:
            self._suspect = True
        if self._told is not None and self._told[1] > WORSE:
            return
        scaled, columns = residual * self._weight, jacobian * self._weight[:, None]
        self._left += scaled @ scaled - (scaled @ columns) ** 2 / np.maximum((columns**2).sum(axis=0), 1e-300)
        self._poses += 1
        if self._poses > 1 and self._arm.n > 1:
            best, next_ = np.partition(self._left, 1)[:2]
            self._told = int(self._left.argmin()), float(next_ - best)
        elif self._poses > 1:
            self._told = 0, np.inf

    def _isolate(self, q: Array) -> None:
        """The joint with the largest residuals, unless a force on a link explains the residual torques better than it."""
        if self._torques:
            self.push = _better_by_force(self._arm, q, self._residual / self._split - self._level, self._scale)
        i, bounds = int(self._size.argmax()), self._bounds
        both, healthy = (float(bounds.torque[i]), float(bounds.tracking[i])), float(bounds.torque[i] / bounds.factor)
        dry = float(bounds.coulomb[i])
        self._kinds = Kinds(i, coulomb=dry, bounds=both, largest=healthy, noise=self._noise, torques=self._torques)

    def verdict(self, *, last: bool = False) -> Verdict:
        """What is known now.

        Args:
            last: Nothing will follow: decide from what is there.
        """
        if self._suspect and (self.count >= self._split or last):
            return self._sensor()
        if self.push > PUSHED and not (self._kinds is not None and self._kinds.lost):
            reason = ("a force on a link explains all rows",)
            suspect = self._find_lone_joint()
            return Verdict(True, self._time, kind="contact", candidates=("contact",), suspect=suspect, evidence=reason)
        if self._kinds is None:
            largest = self._arm.joint_names[int(self._size.argmax())]
            return Verdict(True, self._time, joint=largest if last and self.count else None)
        joint = self._arm.joints[self._kinds.joint]
        if self.count < self._last and not last:
            return Verdict(True, self._time, joint=joint.name)
        size = self._size / self._split
        others = np.delete(size, self._kinds.joint).max(initial=0.0)
        reason = (f"its residuals are {size[self._kinds.joint]:.3g} times their bounds, those of the next joint {others:.3g}",)
        found: dict[str, Any] = self._kinds.named(joint.unit, () if self._tool else ("sensor",))
        found["evidence"] = reason + found["evidence"]
        if found["kind"] == "contact":
            return Verdict(True, self._time, suspect=self._find_lone_joint(), **found)
        return Verdict(True, self._time, joint=joint.name, **found)

    def _find_lone_joint(self) -> str | None:
        """Return the joint that alone was above its bound, on average over the cycles that isolate it."""
        above = np.flatnonzero(self._size > self._split)
        return self._arm.joint_names[above[0]] if above.size == 1 else None

    def _sensor(self) -> Verdict:
        """Of which joint the sensor would explain the tool's pose."""
        evidence, joint = ["the measured tool is not where the joints say"], None
        if self._told is not None:
            i, worse = self._told
            if worse > WORSE:
                joint = self._arm.joint_names[i]
                evidence.append(f"the next joint explains its pose worse by {worse:.3g} squared deviations")
            else:
                first, second = np.argsort(self._left)[:2]
                evidence.append(f"{self._arm.joint_names[first]} and {self._arm.joint_names[second]} explain its pose alike")
        candidates, reasons = ("sensor", "slipping_clutch"), tuple(evidence)
        return Verdict(True, self._time, joint=joint, kind="sensor", candidates=candidates, evidence=reasons)


def _better_by_force(arm: Arm, q: Array, change: Array, scale: Array) -> float:
    """By how many squares of deviations a force at the far end of a link explains residual torques better than one joint.

    Args:
        arm: The arm.
        q: (n,) where it is, rad and m.
        change: (n,) N m and N.
        scale: (n,) its deviations.
    """
    ends, jacobian, rows = arm.frames(q)[2:, :3, 3], arm.jacobian(q), change / scale
    least = np.inf
    for k, end in enumerate(ends):
        columns = (jacobian[:3] + np.cross(jacobian[3:].T, end - ends[-1]).T).T / scale[:, None]
        columns[k + 1 :] = 0.0  # what carries the link alone feels it
        force = np.linalg.lstsq(columns, rows, rcond=_SAME)[0]
        least = min(least, float(((rows - columns @ force) ** 2).sum()))
    return float((rows**2).sum() - (rows**2).max() - least)
