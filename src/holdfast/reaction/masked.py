"""A control law that is told which joints no longer follow."""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm import kinematics
from holdfast.arm.configurations import finite_limits
from holdfast.arm.task import target_poses
from holdfast.clearance.clearance import Clearance
from holdfast.clearance.exact.sharper import sharpened
from holdfast.control.law import Law
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.recall import recalled
from holdfast.solvers.inverse_kinematics import task_error

Array = NDArray[np.float64]

NEAR = 2e-3  # rad or m: a joint so near to its limit is at it, whatever the noise
NEARER, PATIENCE = 1e-3, 1.5  # m and rad, s: a law that does not bring the tool so much nearer in this time is at its end
THERE = 2e-3  # m and rad: a law that would come so near to its target reaches it
AHEAD, STEP = 12.0, 0.05  # s: how far ahead a law is followed, and in which steps


@recalled
def masked_kernel(law: Law) -> Kernel:
    """``(q, p, R, mask, pull) -> rates, miss, turn``: joint rates (n,) of the law with the columns of masked joints left out.

    ``pull`` (n,) are rates that an objective would like; what of them moves no row of the task is added. ``miss`` and
    ``turn`` are the norms of the error's linear part, m, and of its angular part, rad.
    """
    arm, task = law.arm, law.task
    q, mask, pull = kinematics.joint_symbols(arm), ca.SX.sym("mask", arm.n), ca.SX.sym("pull", arm.n)
    place, rotation = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
    error, _ = task_error(arm, task, q, place, rotation)
    jacobian, wish = law.jacobian(q) @ ca.diag(mask), mask * pull
    rates = mask * (law.inverse(jacobian, law.scaled(law.command(error)) - jacobian @ wish) + wish)
    parts = [ca.norm_2(ca.SX(ca.DM(task.rows[:, some].T)) @ error) for some in (slice(0, 3), slice(3, 6))]
    return Kernel("law with a mask", [q, place, rotation, mask, pull], [ca.vertcat(rates, *parts)])


class MaskedLaw:
    """One step after the other towards a target.

    Args:
        law: The law.
        target: (4, 4) pose, or the task's rows (m,), m.
        centring: 1/s, at which joints with two limits are drawn to their middle as far as the task leaves it open.
        clearance: What the arm keeps clear of where the law is followed ahead; None: of nothing.

    Attributes:
        whole: The law, of all joints.
        arm: The law's.
        clearance: As given.
        pose: (4, 4) of the target.
        mask: (n,) 1 for joints that follow, 0 for the others.
        miss, turn: Of the last step: how far the tool was from its target, m and rad.
    """

    def __init__(self, law: Law, target: ArrayLike, *, centring: float, clearance: Clearance | None = None) -> None:
        poses, rows = target_poses(law.task, target)
        self.arm, arm, n = law.arm, law.arm, law.arm.n
        self.whole, self.clearance = law, clearance
        self._apart = sharpened(clearance) or clearance  # routes are proved by it where the bound finds none
        self.pose = np.eye(4)
        if rows is None:
            self.pose = np.asarray(poses[0])
        else:
            self.pose[:3, 3] = rows[0] @ law.task.rows[:, :3]
        self.mask, self.miss, self.turn = np.ones(n), np.inf, np.inf
        bounded = np.isfinite(arm.lower) & np.isfinite(arm.upper)
        self._middle = np.mean(finite_limits(arm), axis=0)
        self._pull, self._n, self._rows = np.where(bounded, centring, 0.0), n, law.task.m
        self._lower, self._upper = arm.lower + NEAR, arm.upper - NEAR
        self._kernel, self._gain = masked_kernel(law), law.gain
        self._run = self._kernel.single()
        self._row = np.concatenate([np.zeros(n), self.pose[:3, 3], self.pose[:3, :3].ravel(), np.ones(n), np.zeros(n)])

    def rates(self, q: Array, *, mask: Array | None = None) -> Array:
        """Commanded rates (n,) at a configuration (n,), rad/s and m/s. A joint at its limit is not told to pass it."""
        n, row = self._n, self._row
        follow = self.mask if mask is None else mask
        # Where no redundancy is left nothing is open: damped, the pull would only hold the tool off its target.
        pull = self._pull * (self._middle - q) if follow.sum() > self._rows else 0.0
        row[:n], row[n + 12 : 2 * n + 12], row[2 * n + 12 :] = q, follow, pull
        out = self._run(row)
        rates = out[:n].copy()
        if mask is None:
            self.miss, self.turn = float(out[n]), float(out[n + 1])
        passing = ((q <= self._lower) & (rates < 0)) | ((q >= self._upper) & (rates > 0))
        if passing.any():
            rates = self.rates(q, mask=np.where(passing, 0.0, follow))
        return rates

    def distance(self, q: Array) -> tuple[float, float]:
        """Of the tool from its target at a configuration (n,), m and rad."""
        self._row[: self._n] = q
        out = self._run(self._row)
        return float(out[self._n]), float(out[self._n + 1])

    def clear(self, q: Array) -> NDArray[np.bool_]:
        """Whether the arm is as far from everything as it must be, (N,) for configurations (N, n), or a scalar for one."""
        return np.ones(q.shape[:-1], dtype=bool) if self._apart is None else self._apart.room(q) >= 0

    def ahead(self, q: Array, *, most: Array) -> Array:
        """(N,) s after which the law would be at its target from configurations (N, n); infinite where it ends elsewhere.

        Joints are taken to follow at once, at rates (n,) of at most ``most``, rad/s and m/s. Infinite also where the arm comes
        too close to something at one of the instants, at most 50 ms apart, that are looked at.
        """
        step = min(STEP, 0.2 / self._gain)
        q, going, takes = q.copy(), np.arange(len(q)), np.full(len(q), np.inf)
        nearest, since = np.full(len(q), np.inf), np.zeros(len(q))
        for time in step * np.arange(round(AHEAD / step)):
            rates, off = self._many(q[going])
            nearer = off < nearest[going] - NEARER
            nearest[going[nearer]], since[going[nearer]] = off[nearer], time
            takes[going[off < THERE]] = time
            on = (off >= THERE) & (time - since[going] <= PATIENCE) & np.isfinite(rates).all(axis=1)
            near = ~self.clear(q[going])
            takes[going[near]], on[near] = np.inf, False
            going, rates = going[on], rates[on]
            if not going.size:
                break
            slower = np.maximum(1.0, (np.abs(rates) / most).max(axis=1))
            q[going] = np.clip(q[going] + step * rates / slower[:, None], self._lower, self._upper)
        return takes

    def _many(self, q: Array) -> tuple[Array, Array]:
        """Rates (N, n) as :meth:`rates` has them, and how far the tool is from its target (N,), m and rad."""
        follow, place, turn = np.tile(self.mask, (len(q), 1)), self.pose[:3, 3], self.pose[:3, :3]
        while True:
            pull = np.where(follow.sum(axis=1, keepdims=True) > self._rows, self._pull * (self._middle - q), 0.0)
            out = self._kernel.rows(q, place, turn, follow, pull)
            rates, off = out[:, : self._n], out[:, self._n] + out[:, self._n + 1]
            passing = ((q <= self._lower) & (rates < 0)) | ((q >= self._upper) & (rates > 0))
            if not passing.any():
                return rates, off
            follow[passing] = 0.0
