"""Falls by events: DOP853 between located events, Pinocchio's dynamics, and sets of sticking joints by trying all of them.

None of it is shared with the package: no fixed steps, no active set that is carried along, no compiled kernels.
"""

from __future__ import annotations

from itertools import product

import numpy as np
import pinocchio as pin
from scipy.integrate import solve_ivp

import dynamics
import holdfast as hf

TINY = 1e-10
# Without these two, rebounds from a stop and restarts beside it follow each other in ever shorter times, without an end.
SLOWEST_REBOUND = 1e-5  # rad/s or m/s
BESIDE_STOP = 1e-10  # rad or m


class Reference:
    """Falls of one arm; ``coulomb``, ``stiction``, ``load``, ``viscous`` are (n,), ``brake`` is (time, torque, damping)."""

    def __init__(
        self, arm: hf.Arm, *, coulomb=0.0, stiction=None, load=0.0, viscous=0.0, restitution=0.0, stops=True, brake=None
    ):
        self.model, self.data, self.tool = dynamics.to_pinocchio(arm)
        n = self.n = arm.n
        fill = lambda x: np.broadcast_to(np.asarray(x, dtype=float), n)  # noqa: E731
        self.coulomb, self.load, self.viscous = fill(coulomb), fill(load), fill(viscous)
        self.stiction = self.coulomb if stiction is None else fill(stiction)
        self.restitution = restitution
        self.lower = arm.lower if stops else np.full(n, -np.inf)
        self.upper = arm.upper if stops else np.full(n, np.inf)
        self.brake_time, torque, damping = (np.inf, 0.0, 0.0) if brake is None else brake
        self.brake_torque, self.brake_damping, self.braked = fill(torque), fill(damping), False

    def inertia(self, q):
        m = pin.crba(self.model, self.data, q)
        return np.triu(m) + np.triu(m, 1).T

    def terms(self, q, v):
        """Inertia, bias with viscous friction, and the two dry frictions."""
        viscous = self.viscous + (self.brake_damping if self.braked else 0)
        bias = pin.nonLinearEffects(self.model, self.data, q, v) + viscous * v
        more = self.brake_torque if self.braked else np.zeros(self.n)
        if self.load.any():
            more = more + self.load * np.abs(pin.computeGeneralizedGravity(self.model, self.data, q))
        return self.inertia(q), bias, self.coulomb + more, self.stiction + more

    def accelerate(self, q, v, sign):
        """(n,) accelerations and multipliers, with joints of sign 0 at rest and the others sliding."""
        m, bias, sliding, _ = self.terms(q, v)
        a, moving = np.zeros(self.n), sign != 0
        a[moving] = np.linalg.solve(m[np.ix_(moving, moving)], (-bias - sliding * sign)[moving])
        return a, m @ a + bias

    def choose_signs(self, q, v, loosened):
        """Signs of all joints: joints with a rate have its sign; the others by trying all sets.

        The joint that an event has just loosened has less stiction, so that rounding cannot hold it again.
        """
        m, bias, sliding, resting = self.terms(q, v)
        if loosened is not None:
            resting = resting * np.where(np.arange(self.n) == loosened, 1 - 1e-7, 1.0) - 1e-9 * (np.arange(self.n) == loosened)
        sign = np.where(np.abs(v) > TINY, np.sign(v), 0.0)
        at_rest = np.flatnonzero(sign == 0)
        loose = np.zeros(self.n, dtype=bool)
        while True:
            beta = np.where((sign != 0) | loose, sliding, resting)
            best, found = np.inf, None
            for choice in product((0.0, 1.0, -1.0), repeat=len(at_rest)):
                trial = sign.copy()
                trial[at_rest] = choice
                moving, a = trial != 0, np.zeros(self.n)
                a[moving] = np.linalg.solve(m[np.ix_(moving, moving)], (-bias - beta * trial)[moving])
                force, violation = m @ a + bias, 0.0
                for i in at_rest:
                    if trial[i]:
                        into = q[i] <= self.lower[i] if trial[i] < 0 else q[i] >= self.upper[i]
                        violation += np.inf if into else max(-a[i] * trial[i], 0.0)
                    else:
                        violation += max(-force[i] - beta[i], 0.0) if q[i] < self.upper[i] else 0.0
                        violation += max(force[i] - beta[i], 0.0) if q[i] > self.lower[i] else 0.0
                if violation < best:
                    best, found = violation, trial
            new = (found != 0) & (sign == 0) & ~loose & (resting > sliding)
            if not new.any():
                return found
            loose |= new

    def impact(self, q, v):
        """Rates after the impact of all joints that touch a stop: the least change of kinetic energy, by trying all sets."""
        m = self.inertia(q)
        side = np.where(q <= self.lower, 1.0, 0.0) - np.where(q >= self.upper, 1.0, 0.0)
        touching = np.flatnonzero(side)
        least = np.where(side * v < -SLOWEST_REBOUND, -self.restitution * v, 0.0)
        best, found = np.inf, v
        for choice in product((False, True), repeat=len(touching)):
            fixed = np.zeros(self.n, dtype=bool)
            fixed[touching] = choice
            w = v.copy()
            w[fixed] = least[fixed]
            if fixed.any():
                others = ~fixed
                pull = m[np.ix_(others, fixed)] @ (w - v)[fixed]
                w[others] = v[others] - np.linalg.solve(m[np.ix_(others, others)], pull)
            cost = (w - v) @ m @ (w - v) / 2
            if all(side[i] * (w[i] - least[i]) >= -1e-12 for i in touching) and cost < best:
                best, found = cost, w
        return found

    def run(self, q, v, times, tolerance=1e-10):
        """q and v at sorted times, (T, n) each."""
        q, v, t, out, loosened = np.array(q, float), np.array(v, float), 0.0, [], None
        self.braked = self.brake_time <= 0
        for until in sorted({*times, *([self.brake_time] if self.brake_time < max(times) else [])}):
            while t < until:
                q = np.where(q < self.lower + BESIDE_STOP, self.lower, np.where(q > self.upper - BESIDE_STOP, self.upper, q))
                v = self.impact(q, v)
                v[np.abs(v) < TINY] = 0.0
                sign = self.choose_signs(q, v, loosened)
                if not sign.any():
                    t = until
                    break
                t, q, v, loosened = self.segment(q, v, sign, t, until, tolerance)
            self.braked = t >= self.brake_time
            if until in times:
                out.append((q.copy(), v.copy()))
        return np.array([q for q, _ in out]), np.array([v for _, v in out])

    def segment(self, q, v, sign, t, until, tolerance):
        n, held = self.n, sign == 0
        start = (q.copy(), v.copy())

        def rates(_, y):
            return np.concatenate([np.where(held, 0.0, y[n:]), self.accelerate(y[:n], y[n:], sign)[0]])

        events, kinds = [], []
        for i in range(n):
            if held[i]:
                at_lower, at_upper = start[0][i] <= self.lower[i], start[0][i] >= self.upper[i]
                if not at_upper:  # a multiplier below -stiction lets the joint go upwards
                    events.append(lambda s, y, i=i: self.accelerate(y[:n], y[n:], sign)[1][i] + self.terms(y[:n], y[n:])[3][i])
                    kinds.append(("loose", i))
                if not at_lower:
                    events.append(lambda s, y, i=i: self.terms(y[:n], y[n:])[3][i] - self.accelerate(y[:n], y[n:], sign)[1][i])
                    kinds.append(("loose", i))
                continue
            if self.coulomb[i] + self.load[i] + self.braked * self.brake_torque[i] > 0:
                events.append(lambda s, y, i=i: sign[i] * y[n + i] + 1e-13)  # above 0 also for a joint that has just started
                kinds.append(("rest", i))
            for limit, out in ((self.lower[i], -1), (self.upper[i], 1)):
                if np.isfinite(limit):
                    # Above 0 also for a joint that leaves its stop, so that its return is found instead of its start.
                    events.append(lambda s, y, limit=limit, out=out, i=i: out * (limit - y[i]) + 1e-13)
                    kinds.append((limit, i))
        for event in events:
            event.terminal, event.direction = True, -1
        made = solve_ivp(rates, (t, until), np.concatenate([q, v]), "DOP853", rtol=tolerance, atol=tolerance, events=events)
        q, v = made.y[:n, -1].copy(), made.y[n:, -1].copy()
        q[held], v[held] = start[0][held], 0.0
        loosened = None
        if made.status == 1:
            for (kind, i), hits in zip(kinds, made.t_events, strict=True):
                if len(hits) and kind == "rest":
                    v[i] = 0.0
                elif len(hits) and kind == "loose":
                    loosened = i
                elif len(hits):
                    q[i] = kind
        return made.t[-1], q, v, loosened

    def tool_at(self, q):
        pin.framesForwardKinematics(self.model, self.data, q)
        return self.data.oMf[self.tool].translation.copy()
