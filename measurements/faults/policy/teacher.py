"""A controller that pushes the object to the goal, and may know what has failed: what a policy is to learn from.

It knows the true state. A part of the fork is led behind the object, seen from the goal, down to the table, and into the
object: the rates are those of a damped pseudoinverse without the joints that do not answer, the torques follow by the
inertia matrix. Derived here.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.response.faults import FaultWrapper
from measurements.faults.policy.task import LIMIT

Array = NDArray[np.float64]

# Parts of the fork that can push: place in the frame of its body, m, and the fork's heading against the push, rad.
PARTS = ((0.0, 0.0, 0.0), (0.05, -0.1, -np.pi / 2), (0.05, 0.1, np.pi / 2))
ASKEW = 1.3  # rad that the fork may head away from straight outward before a prong pushes rather than the bar
TABLE, LOW, CLEAR = -0.272, -0.24, -0.17  # m: height of a push, below which it is one, and to pass above the object
BEHIND, DEEP = 0.1, 0.02  # m before the object's centre: to come down, and in a push (contacts are soft)
THERE = 0.015  # m off the goal where it rests
SPEED, ANGULAR, JOINT = 2.0, 1.5, 2.0  # m/s, rad/s, rad/s
ROTATION = 0.15  # m/rad, weight of the fork's orientation
DAMPING, CENTRING, RESPONSE, ROOM = 0.02, 0.3, 0.1, 0.03  # m; 1/s; s; rad from a joint's limit
BASE = (0.0, -0.6)  # m
DEAD = frozenset({"locked", "slipping_clutch", "limp", "command_dropout"})
N = 7


class Teacher:
    """``knows``: the joints that fail, and how, from the moment they do. ``part``: which one pushes, always.

    ``rotation``, m/rad: the weight of the fork's orientation against its place.
    """

    def __init__(self, env: FaultWrapper, *, knows: bool, part: int | None = None, rotation: float = ROTATION) -> None:
        import mujoco

        self._mujoco, self._env, self._knows, self._given, self._weight = mujoco, env, knows, part, rotation
        model = env.unwrapped.model
        self._body = model.body("tips_arm").id
        self._healthy = (*model.jnt_range[:N].T.copy(), model.dof_damping[:N].copy(), np.zeros(N))
        self._moving, self._rotating = np.zeros((2, 3, model.nv))
        self._mass = np.zeros((model.nv, model.nv))

    def __call__(self, observation: Any = None) -> Array:
        """(7,) torques, N m."""
        model, data = self._env.unwrapped.model, self._env.unwrapped.data
        thing, goal = data.body("object").xpos, data.body("goal").xpos
        way = (goal - thing)[:2]
        left = float(np.linalg.norm(way))
        way = way / max(left, 1e-3)
        place, turn = self._part(way, thing)
        wrist, frame = data.xpos[self._body], data.xmat[self._body].reshape(3, 3)
        tip = wrist + frame @ place
        self._mujoco.mj_jac(model, data, self._moving, self._rotating, tip, self._body)
        self._mujoco.mj_fullM(model, data, self._mass)
        v = data.qvel[:N]
        if left < THERE and tip[2] < LOW:
            wanted = np.zeros(N)
        else:
            target, gain = _target(tip, thing, way)
            heading = np.arctan2(way[1], way[0]) + turn
            ahead = np.array([np.cos(heading), np.sin(heading), 0.0])
            twist = np.cross(frame[:, 0], ahead) - frame[:, 0] * frame[2, 1]
            wanted = self._rates(_at_most(gain * (target - tip), SPEED), _at_most(2 * twist, ANGULAR))
        _, _, damping, friction = self._limits()
        torque = damping * wanted + friction * np.sign(wanted) + self._mass[:N, :N] @ (wanted - v) / RESPONSE
        return np.asarray(np.clip(torque / self._gains(), -LIMIT, LIMIT))

    def _part(self, way: Array, thing: Array) -> tuple[Array, float]:
        """The bar, or the prong with which the fork heads most nearly outward; or the one that was given."""
        outward = np.arctan2(thing[1] - BASE[1], thing[0] - BASE[0])
        heading = np.arctan2(way[1], way[0])
        askew = [abs((heading + turn - outward + np.pi) % (2 * np.pi) - np.pi) for _, _, turn in PARTS]
        best = 0 if askew[0] < ASKEW else 1 + int(np.argmin(askew[1:]))
        x, y, turn = PARTS[best if self._given is None else self._given]
        return np.array([x, y, 0.0]), turn

    def _rates(self, linear: Array, angular: Array) -> Array:
        """(7,) rates, rad/s, of joints that answer and stay within limits."""
        q, (low, high, _, _) = self._env.unwrapped.data.qpos[:N], self._limits()
        jacobian = np.vstack([self._moving[:, :N], self._weight * self._rotating[:, :N]])
        twist = np.concatenate([linear, self._weight * angular])
        free, centring = ~self._dead(), CENTRING * ((low + high) / 2 - q)
        while True:
            some = jacobian * free
            own = centring * free
            rates = own + some.T @ np.linalg.solve(some @ some.T + DAMPING**2 * np.eye(6), twist - some @ own)
            beyond = free & (((q < low + ROOM) & (rates < 0)) | ((q > high - ROOM) & (rates > 0)))
            if not beyond.any():
                break
            free &= ~beyond
        return np.asarray(rates * min(1.0, float((self._speeds() / np.maximum(np.abs(rates), 1e-9)).min())))

    # ---- what is known of faults -------------------------------------------------------------------------------------

    def _active(self, *kinds: str) -> list[tuple[int, Any]]:
        if not self._knows:
            return []
        injector = self._env.injector
        return [(injector.joints.index(e.joint), e.parameters) for e in injector.active if e.kind in kinds]

    def _dead(self) -> NDArray[np.bool_]:
        dead = np.zeros(N, dtype=np.bool_)
        dead[[j for j, _ in self._active(*DEAD)]] = True
        return dead

    def _gains(self) -> Array:
        gains = np.ones(N)
        for j, numbers in self._active("weak"):
            gains[j] = numbers["gain"]
        return gains

    def _speeds(self) -> Array:
        speeds = np.full(N, JOINT)
        for j, numbers in self._active("reduced_speed"):
            speeds[j] = 0.5 * numbers["velocity"]
        return speeds

    def _limits(self) -> tuple[Array, Array, Array, Array]:
        """Lower, upper, rad, damping, N m s/rad, and dry friction, N m, of the joints."""
        if not self._active("friction", "reduced_range"):
            return self._healthy
        model, injector = self._env.unwrapped.model, self._env.injector
        injector.insert()
        limits = (*model.jnt_range[:N].T.copy(), model.dof_damping[:N].copy(), model.dof_frictionloss[:N].copy())
        injector.restore()
        return limits


def _target(tip: Array, thing: Array, way: Array) -> tuple[Array, float]:
    """Where the part of the fork should be, m, and how soon, 1/s."""
    along, across = (tip - thing)[:2] @ way, (tip - thing)[:2] @ np.array([-way[1], way[0]])
    if tip[2] < LOW and along < -0.005 and abs(across) < 0.05:
        return np.array([*(thing[:2] - DEEP * way), TABLE]), 6.0
    down = along < -0.06 or np.hypot(along + BEHIND, across) < 0.035
    return np.array([*(thing[:2] - BEHIND * way), TABLE if down else CLEAR]), 4.0


def _at_most(x: Array, most: float) -> Array:
    return x * min(1.0, most / max(float(np.linalg.norm(x)), 1e-9))
