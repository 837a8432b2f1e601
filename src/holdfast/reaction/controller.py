"""What a controller does when a monitor names a joint: brake it, leave it out of the law, slow down, or plan anew.

Source: derived here; braking turns a free-swinging joint into a locked one, English and Maciejewski 2001.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.poses import rotation_vectors
from holdfast.diagnosis.bounds import Bounds
from holdfast.diagnosis.kinds import Verdict
from holdfast.failures import Degraded
from holdfast.reaction.detour import better_posture
from holdfast.reaction.masked import NEARER, PATIENCE, MaskedLaw
from holdfast.reaction.plan import ACCELERATION, Planned, planned
from holdfast.reaction.run import Action, React, What

Array = NDArray[np.float64]

AT_ONCE = 0.020  # s after the alarm: a joint that does not move, or runs away, is braked before its kind is known
STILL, RUNS, FASTER = 0.02, 0.2, 0.3  # rad/s or m/s: no motion; a motion, and so much off its reference
BEHIND, FAR_OFF = 1.5, 8.0  # of the bound of tracking; a servo at its effort is not far off a joint that falls
SLOW, HALF = 0.3, 0.5  # of the commanded speed
TRIAL = 0.2  # of the speed of a route, with a joint that may do more than was thought
EASE = 0.8  # of the speed that such a joint has where it falls behind
QUIET = 1.0  # s after which a contact is over
SPARE = 1.2  # a weak motor must carry gravity so many times
SETTLED, SAMPLES = 0.05, 10  # s after braking; measured poses that tell where the joint is
LATER = 0.5  # s more, for measured poses that come more slowly
NAMED = 2.0  # s after the alarm by which the joint must be known
FINAL = 0.6  # s after the alarm; a verdict may be revised before, when the tool's pose tells more
SLACK = 1e-3  # rad or m: a sensor is believed where the tool's pose agrees so far
RAMP = 5.0  # 1/s, of the pace: from standstill to the commanded speed, and back, in 0.2 s
LEAST = 0.1  # rad/s or m/s: a joint that calibration has hardly moved may be so fast
IDLE = 1e-3  # rad/s and m/s: a law that commands less is at its end
_EASED = frozenset({"weak", "friction", "sluggish"})


class Brakes(Protocol):
    """What stops joints."""

    def brake(self, joint: str) -> None:
        """Stop one where it is."""
        ...

    def release(self, joint: str) -> None:
        """Release it again."""
        ...


class Watch(Protocol):
    """What sees faults."""

    def rearm(self) -> None:
        """Watch on after an alarm."""
        ...

    def leave_out(self, joint: str) -> None:
        """Watch on, but not this joint."""
        ...


class Controller:
    """A law, and what it becomes: with one joint less after each fault that is found.

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
        self, law: MaskedLaw, *, bounds: Bounds | None, brakes: Brakes, watch: Watch | None, react: React, plan: bool
    ) -> None:
        self.law, self.arm = law, law.arm
        self._bounds, self._brakes, self._watch, self._react, self._plans = bounds, brakes, watch, react, plan
        self.pace, self.over, self.actions, self.verdicts = 1.0, False, list[Action](), list[Verdict]()
        self._pace = self._time = self._since = 0.0
        self._nearest = np.inf
        self._alarm = self._settled = self._quiet = np.inf
        self._usual = 1.0  # pace with what has failed so far
        self._named: str | None = None  # the joint that the alarm is about, once something is done about it
        self._braked = -1  # the last joint that was
        self._tries = list[What]()  # ways round that are left after a brake
        self._looked = False  # whether the law was followed ahead since
        self._true: dict[int, float] = {}  # of braked joints whose sensor is not believed
        self._poses, self._seen = list[tuple[Array, Array]](), False
        self._planned: Planned | None = None
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
        """What is left of the arm, as the controller knows it."""
        held = {int(j): float(self._last[j]) for j in np.flatnonzero(self.law.mask == 0)}
        cut = np.flatnonzero((self._lower > self.arm.lower) | (self._upper < self.arm.upper))
        ranges = {int(j): (self._lower[j], self._upper[j]) for j in cut if j not in held}
        return Degraded(self.arm, locked=held, ranges=ranges) if held or ranges else None

    def believed(self, told: Array) -> Array:
        """Where the joints are, by sensors that are believed."""
        if not self._true:
            return told
        q = told.copy()
        for j, value in self._true.items():
            q[j] = value
        return q

    def rates(self, time: float, told: Array) -> Array:
        """Commanded rates (n,), rad/s and m/s: smooth, within the velocity limits, and slower towards the ends of the range."""
        q, dt = self.believed(told), time - self._time
        wanted = self._wanted(time, told)
        if not np.isfinite(wanted).all():
            wanted = np.zeros(self.arm.n)
        wanted = wanted / max(1.0, float((np.abs(wanted) / self._most).max()))
        low, high = (np.sqrt(2 * ACCELERATION * np.maximum(room, 0.0)) for room in (q - self._lower, self._upper - q))
        wanted = np.minimum(np.maximum(wanted, -low), high)
        change = ACCELERATION * dt
        self._commanded = self.law.mask * np.clip(wanted, self._commanded - change, self._commanded + change)
        return self._commanded

    def _wanted(self, time: float, told: Array) -> Array:
        """What the law or the route asks for."""
        q = self._last = self.believed(told)
        dt = time - self._time
        self._time, self._pace = time, self._pace + min(max(self.pace - self._pace, -RAMP * dt), RAMP * dt)
        if self._planned is not None:
            if not self._planned.over:
                return self._planned.rates(q, pace=self._pace, dt=dt)
            self._planned, self._since, self._nearest, self._looked = None, time, np.inf, False
        rates = self.law.rates(q)
        if self._waits(time):
            self._pace, self._since, self._nearest = 0.0, time, np.inf  # the arm waits until it knows where that joint is
        elif self._ends_elsewhere(time, q, rates):
            return self._way_round(time, q)
        return self._pace * rates

    def _waits(self, time: float) -> bool:
        later = LATER if 0 < len(self._poses) < SAMPLES else 0.0
        return bool(np.isfinite(self._settled) and time <= self._settled + later)

    def _ends_elsewhere(self, time: float, q: Array, rates: Array) -> bool:
        """What is left of the law does not lead to its target: too near something, followed ahead, or at its end."""
        if self.over or self.law.mask.min() > 0:
            return False
        if not self.law.clear(q + self._commanded * np.abs(self._commanded) / ACCELERATION):  # twice the way it takes to stop
            return True
        if not self._tries:
            return False
        if not self._looked:
            self._looked = True
            if not np.isfinite(self.law.ahead(q[None], most=self._most)[0]):
                return True
        off = self.law.miss + self.law.turn
        if off < self._nearest - NEARER:
            self._nearest, self._since = off, time
        slow = not np.isfinite(rates).all() or float(np.abs(rates).max()) < IDLE
        return slow or time - self._since > PATIENCE

    def idle(self, rates: Array) -> bool:
        """Nothing more is to come."""
        return self._planned is None and self._pace == self.pace and float(np.abs(rates).max()) < IDLE

    # ---- what the monitor says ---------------------------------------------------------------------------------------

    def hear(self, time: float, verdict: Verdict, *, behind: Array, v: Array, wanted: Array, gravity: Array) -> None:
        """React to a verdict.

        Args:
            time: s.
            verdict: Of the monitor, now.
            behind: (n,) distances from the references, rad and m.
            v: (n,) measured rates, rad/s and m/s.
            wanted: (n,) commanded ones.
            gravity: (n,) torques, N m and N.
        """
        if self.over or self._waits(time):
            return
        if self._trial is not None:
            assert self._bounds is not None
            j = self._trial
            y, off = abs(behind[j]) / self._bounds.tracking[j], wanted[j] - v[j]
            follows = y < BEHIND or abs(off) < max(STILL, HALF * abs(wanted[j]))
            # Where its motor is at its effort its reference does not go ahead, so what it should have done is summed up.
            self._lost = 0.0 if follows else self._lost + off * (time - self._heard)
            self._heard = time
            if y > BEHIND and LEAST < v[j] * np.sign(wanted[j]) < abs(wanted[j]):  # it may not be faster
                self.pace = self._usual = min(self.pace, EASE * self._pace * float(v[j] / wanted[j]))
            if max(y, abs(self._lost) / self._bounds.tracking[j]) > FAR_OFF:
                self._trial = None
                self._brake(time, self.arm.joint_names[j], "it does not follow")
                self._stop(time, "what is left does not reach the target")
                return
        if self._named is not None and self.law.mask[self.arm.joint_index(self._named)] == 0:
            self._go_on()
            return
        if time > self._quiet:
            self._act(time, "resume", "no joint was named")
            self._go_on()
            return
        if not verdict.alarm:
            return
        if np.isinf(self._alarm):
            self._alarm = time
            self.verdicts.append(verdict)
            self._act(time, "alarm", "something is outside its bounds")
            if self._react == "stop":
                self._stop(time, "every joint, at the first alarm")
                return
        self.verdicts[-1] = verdict
        if verdict.joint is None:
            if verdict.kind == "contact":
                if np.isinf(self._quiet):
                    self._quiet, self.pace = time + QUIET, SLOW
                    self._act(time, "slow", "something pushes the arm, and no joint is to blame")
            elif time > self._alarm + NAMED:
                self._stop(time, "the joint is not known")
            return
        i = self.arm.joint_index(verdict.joint)
        self._doubted = verdict.kind != "sensor"
        self._way = float(np.sign(wanted[i]))
        if verdict.kind in _EASED:
            if self._named == verdict.joint:
                if time > self._alarm + FINAL:
                    self._go_on()
                return
            left = (1 - verdict.loss) * self._effort[i]  # not a number where no loss is told
            if left < SPARE * abs(gravity[i]):
                self._brake(time, verdict.joint, "what its motor still gives does not carry the arm")
            else:
                self.pace, self._named = min(self._usual, HALF), verdict.joint
                self._act(time, "slow", f"its fault: {verdict.kind}", joint=verdict.joint)
        elif verdict.kind != "unknown" or verdict.candidates:
            self._brake(time, verdict.joint, f"its fault: {verdict.kind}")
        elif time >= self._alarm + AT_ONCE:
            self._at_once(time, verdict.joint, float(behind[i]), float(v[i]), float(wanted[i]))

    def _go_on(self) -> None:
        """Watch on: without the joint that was named, and at the pace that what has failed leaves."""
        assert self._watch is not None
        if self._named is None:
            self._watch.rearm()
        else:
            self._watch.leave_out(self._named)
            if self.law.mask[self.arm.joint_index(self._named)] > 0:
                self._usual = min(self._usual, HALF)
        self.pace, self._alarm, self._quiet, self._named = self._usual, np.inf, np.inf, None

    def know(self, time: float, kind: str, joint: str, true: float) -> None:
        """React to a fault that is known at once, with the joint's true place, rad or m."""
        if self.arm.joint_index(joint) in self._true or self.law.mask[self.arm.joint_index(joint)] == 0:
            return
        if kind in ("locked", "limp", "slipping_clutch") or kind.startswith("sensor"):
            self._act(time, "alarm", f"its fault is known: {kind}", joint=joint)
            self._brake(time, joint, f"its fault: {kind}")
            self._true[self.arm.joint_index(joint)] = true
            self._settled = np.inf

    def feel(self, time: float, told: Array, pose: Array) -> None:
        """A measured pose of the tool (4, 4): after braking it tells whether the joint's sensor can be believed."""
        self._seen = True
        if not self._waits(time) or time <= self._settled - SAMPLES / 100 or len(self._poses) == SAMPLES:
            return
        self._poses.append((self.believed(told).copy(), pose))
        if len(self._poses) == SAMPLES:
            self._measure(time)

    # ---- what it does ------------------------------------------------------------------------------------------------

    def _act(self, time: float, what: What, why: str, *, joint: str | None = None) -> None:
        self.actions.append(Action(time, what, why, joint=joint))

    def _stop(self, time: float, why: str) -> None:
        self.over, self.pace = True, 0.0
        self._act(time, "stop", why)

    def _at_once(self, time: float, joint: str, behind: float, v: float, wanted: float) -> None:
        assert self._bounds is not None
        y = abs(behind) / self._bounds.tracking[self.arm.joint_index(joint)]
        if abs(v) < STILL and y > BEHIND:
            self._brake(time, joint, "it does not move")
        elif y > (BEHIND if behind * v < 0 else FAR_OFF) and abs(v - wanted) > FASTER and abs(v) > RUNS:
            self._brake(time, joint, "it runs away")
        elif self.pace > SLOW:
            self.pace = SLOW
            self._act(time, "slow", "its fault is not known yet", joint=joint)

    def _brake(self, time: float, joint: str, why: str) -> None:
        j = self.arm.joint_index(joint)
        self._brakes.brake(joint)
        self.law.mask[j], self.pace, self._named, self._braked = 0.0, self._usual, joint, j
        self._planned, self._looked = None, False
        self._tries = ["detour", "plan"] if self._plans else ["detour"]
        if self._bounds is not None:
            self._most = calibrated(self.arm, self._bounds)
        self._settled, self._poses = time + SETTLED + (SAMPLES / 100 if self._seen else 0.0), []
        self._act(time, "brake", why, joint=joint)

    def _measure(self, time: float) -> None:
        """Where a braked joint is by the tool's pose, ``b = sum J_i' c / sum J_i' J_i``; metres and radians weighted alike."""
        j = self._braked
        rows = np.array([q for q, _ in self._poses])
        measured = np.array([pose for _, pose in self._poses])
        for _ in range(3):
            poses, along = self.arm.forward_kinematics(rows), self.arm.jacobian(rows)[:, :, j]
            turns = rotation_vectors(measured[:, :3, :3] @ poses[:, :3, :3].transpose(0, 2, 1))
            c = np.concatenate([measured[:, :3, 3] - poses[:, :3, 3], turns], axis=1)
            rows[:, j] += (c * along).sum() / max(float((along**2).sum()), 1e-12)
        off = float(np.mean([row[j] - q[j] for row, (q, _) in zip(rows, self._poses, strict=True)]))
        if abs(off) > SLACK:
            self._true[j] = float(rows[:, j].mean())  # it stands, whatever its sensor does
            factor, unit = self.arm.joints[j].shown
            why = f"by the tool's pose it is {factor * off:.3g} {unit} off what its sensor says"
            self._act(time, "measure", why, joint=self.arm.joint_names[j])

    def _way_round(self, time: float, q: Array) -> Array:
        """By way of another posture, else along a route; else the arm stops, or follows the law where no route is asked for."""
        left, apart = self.degraded, self.law.clearance
        assert left is not None
        why = last = "the law would not get there" + ("" if apart is None else f" clear of {apart.others}")
        while self._tries:
            way = self._tries.pop(0)
            found = self._by_posture(q, left) if way == "detour" else self._by_route(time, q, left)
            if not isinstance(found, str):
                self._planned, self._pace = found, 0.0
                what = "another posture first, which" if way == "detour" else f"a route of {found.waypoints} waypoints"
                self._act(time, way, f"{why}; {what} takes {found.duration:.3g} s")
                return np.zeros(self.arm.n)
            last = found
        if self._plans or apart is not None:
            self._stop(time, last)
        return np.zeros(self.arm.n)

    def _by_posture(self, q: Array, left: Degraded) -> Planned | str:
        via = better_posture(self.law, q, most=self._most, fastest=self.law.whole.speed_limit)
        return "no other posture helps" if via is None else planned(self.law, q, via, left, most=self._most)

    def _by_route(self, time: float, q: Array, left: Degraded) -> Planned | str:
        found = planned(self.law, q, self.law.pose, left, most=self._most)
        return self._tried(time, q) or found if isinstance(found, str) else found

    def _tried(self, time: float, q: Array) -> Planned | None:
        """A slow route for the braked joint too: at a stop, or slow, it looks as a joint does that drives nothing.

        It is not sent on the way that it was to go, if there is a route without. Nothing is lost: else the arm stops here.
        """
        braked = np.flatnonzero(self.law.mask == 0)
        alone = len(braked) == 1 and self._trial is None and int(braked[0]) not in self._true
        if self._react != "chain" or not self._doubted or not alone:
            return None
        j, joint = int(braked[0]), self.arm.joint_names[int(braked[0])]
        ends = max(self.arm.lower[j], q[j] - 2 * np.pi), min(self.arm.upper[j], q[j] + 2 * np.pi)
        for way in dict.fromkeys((self._way, 0.0)):
            low, high = q[j] if way < 0 else ends[0], q[j] if way > 0 else ends[1]
            if not ends[0] <= low < high <= ends[1]:
                continue
            left = Degraded(self.arm, ranges={j: (low, high)})
            found = planned(self.law, q, self.law.pose, left, most=self._most)
            if not isinstance(found, str):
                if self._named == joint:  # or what was heard of it before the release would brake it again
                    self._go_on()
                self._trial, self.law.mask[j], self.pace, self._usual = j, 1.0, TRIAL, TRIAL
                self._lost, self._heard = 0.0, time
                self._lower[j], self._upper[j] = low, high
                self._brakes.release(joint)
                why = "there is no route without it; slowly, as far as it follows"
                self._act(time, "release", why, joint=joint)
                return found
        return None


def calibrated(arm: Arm, bounds: Bounds) -> Array:
    """(n,) rates that bounds hold for, rad/s and m/s, within the limits; faster joints would alarm for no reason."""
    limits = np.array([joint.velocity for joint in arm.joints])
    return np.asarray(np.minimum(np.maximum(bounds.speed, LEAST), limits))
