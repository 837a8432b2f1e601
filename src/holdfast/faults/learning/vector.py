"""Many arms in the kinematic closed loop with drawn faults, as an environment of Gymnasium's vector API."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.control.law import Law
from holdfast.errors import HoldfastError, InputError
from holdfast.faults.batch import batch_of
from holdfast.faults.entry import KINDS
from holdfast.faults.events import FaultEvents
from holdfast.faults.learning.stepping import NEVER, STATE, kernel_rows, step_kernel
from holdfast.faults.scheme import Faults

try:
    from gymnasium.vector import VectorEnv
except ImportError:  # said when one is made, so that the rest can be imported
    VectorEnv = object

Array = NDArray[np.float64]
Goals = Callable[[np.random.Generator, int], Array]
UNLIMITED = 2 * np.pi  # rad/s or m/s of a joint without a velocity limit
ROOM = 0.05  # of a joint's range, kept from its limits at the start and by the goals that are drawn


class FaultVectorEnv(VectorEnv):  # type: ignore[misc]
    """N arms with a control law each, whose joints fail while they move to their targets (needs ``holdfast[learn]``).

    The loop is kinematic: joints do what they are told, within limits and speeds. A step of all arms is one call of one
    kernel. The action, (N, n) in -1 to 1, is added to the law's joint rates, in units of the velocity limits: with an action
    of zeros the law alone moves the arms, and knows of no failure. An observation holds what the joint sensors tell (n,),
    the error of the task's rows by that (m,), m and rad, and the last commanded rates (n,). The reward is minus the true
    tool's distance from its target, m and rad. An episode is terminated where that is within the tolerance, and truncated at
    the horizon; the arm starts anew with the next step (``AutoresetMode.NEXT_STEP``).

    Row i has the episodes i, i + N, ... of the fault model; their kinds are locks, ranges, speeds, sensors, dropouts and
    clutches: rates have no torque that could fail. Of each joint the first fault of an episode counts. What has failed is in
    ``info["fault"]``: ``kind`` (N, n) as in :class:`holdfast.faults.FaultBatch`, ``active`` (N, n), ``id`` (N,).

    Args:
        law: The law, with its arm, task, gain and speed limit.
        num_envs: N.
        faults: A fault model; None: nothing fails.
        period: s, of a step.
        horizon: s, of an episode.
        goals: ``goals(generator, count) -> (count, 4, 4)`` tool poses in the world, m; of random configurations if not given.
        start: (n,) where each episode begins; random if not given.
        tolerance: m and rad.
        reveal: False: ``info`` says nothing of the faults, and only ``env.fault`` does, which no policy sees.

    Attributes:
        fault: What ``info["fault"]`` tells.

    Raises:
        InputError: A fault that a loop of rates does not have, or numbers that are not above 0.
        HoldfastError: Gymnasium is not installed.
    """

    def __init__(
        self,
        law: Law,
        num_envs: int,
        faults: Faults | None = None,
        *,
        period: float = 0.02,
        horizon: float = 10.0,
        goals: Goals | None = None,
        start: Array | None = None,
        tolerance: tuple[float, float] = (5e-3, np.deg2rad(1.0)),
        reveal: bool = True,
    ) -> None:
        if VectorEnv is object:
            raise HoldfastError("Gymnasium is not installed; pip install 'holdfast[learn]'")
        from gymnasium.spaces import Box
        from gymnasium.vector import AutoresetMode
        from gymnasium.vector.utils import batch_space

        if num_envs < 1 or not 0 < period <= horizon < np.inf:
            raise InputError(
                f"there are {num_envs} arms, steps of {period:g} s and a horizon of {horizon:g} s; give an arm or more, and a "
                "period above 0 and at most the horizon"
            )
        self.law, self.num_envs, self.faults = law, int(num_envs), Faults([]) if faults is None else faults
        self.period, self.horizon, self.tolerance, self._reveal = float(period), float(horizon), tolerance, reveal
        arm, n = law.arm, law.arm.n
        self._lower = np.where(np.isfinite(arm.lower), arm.lower, -np.pi)
        self._upper = np.where(np.isfinite(arm.upper), arm.upper, np.pi)
        speeds = np.array([joint.velocity for joint in arm.joints])
        speeds = np.where(np.isfinite(speeds), speeds, UNLIMITED)
        finite = [np.clip(limit, -NEVER, NEVER) for limit in (arm.lower, arm.upper)]
        self._limits = np.tile(np.concatenate([*finite, speeds]), (self.num_envs, 1))
        self._goals, self._start = goals or self._random_goals, None if start is None else arm.check_configurations(start)
        self._kernel = step_kernel(law)
        self.metadata = {"autoreset_mode": AutoresetMode.NEXT_STEP, "render_modes": []}
        self.single_action_space = Box(-1.0, 1.0, (n,), np.float64)
        self.single_observation_space = Box(-np.inf, np.inf, (2 * n + law.task.m,), np.float64)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self._allocate()

    def _allocate(self) -> None:
        rows, n = self.num_envs, self.law.arm.n
        self._state, self._time = np.zeros((rows, len(STATE) * n)), np.zeros(rows)
        self._place, self._rotation = np.zeros((rows, 3)), np.zeros((rows, 3, 3))
        self._code, self._onset, self._end = np.full((rows, n), -1.0), np.full((rows, n), NEVER), np.full((rows, n), NEVER)
        self._parameters, self._error = np.zeros((rows, 3 * n)), np.zeros((rows, self.law.task.m))
        self._episode, self._ids = np.arange(rows) - rows, np.full(rows, FaultEvents().id)
        self._over = np.ones(rows, dtype=bool)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Array, dict[str, Any]]:
        """All arms anew; with a seed also the episodes of the faults from the first one on."""
        if seed is not None:
            self._np_random, self._np_random_seed = np.random.default_rng(seed), seed
            self._allocate()
        self._begin(np.arange(self.num_envs))
        del options
        return self._observed(), self._told()

    def step(self, actions: Array) -> tuple[Array, Array, NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """One period of all arms. Those whose episode was over begin the next one; their action is passed over.

        Raises:
            InputError: Actions of another shape.
        """
        given = np.asarray(actions, dtype=np.float64)
        if given.shape != self.action_space.shape:
            raise InputError(f"actions have shape {given.shape}; they must be {self.action_space.shape}, a row for each arm")
        anew = np.flatnonzero(self._over)
        state, error, off = self._advance(np.clip(given, -1.0, 1.0), self.period)
        self._state, self._error, self._time = state, error, self._time + self.period
        there = (off[:, 0] <= self.tolerance[0]) & (off[:, 1] <= self.tolerance[1])
        late = ~there & (self._time >= self.horizon - 1e-9)
        reward = -off.sum(axis=1)
        if anew.size:
            self._begin(anew)
            there[anew] = late[anew] = False
            reward[anew] = 0.0
        self._over = there | late
        return self._observed(), reward, there, late, self._told()

    @property
    def q(self) -> Array:
        """(N, n) where the joints are, rad and m, whatever their sensors tell."""
        return np.asarray(self._state[:, : self.law.arm.n])

    # ---- inside ------------------------------------------------------------------------------------------------------

    def _advance(self, actions: Array, period: float, *, rows: NDArray[np.int64] | slice = slice(None)) -> tuple[Array, ...]:
        """States, errors and distances of all rows, or of some, after a time."""
        clock = np.stack([self._time[rows], np.full(len(actions), period)], axis=1)
        noisy = (self._code[rows] == KINDS.index("sensor_noise")).any()
        noise = self.np_random.standard_normal(actions.shape) if noisy else np.zeros(actions.shape)
        given = (self._code, self._onset, self._end, self._parameters, self._limits)
        where = (self._state[rows], clock, self._place[rows], self._rotation[rows])
        out = self._kernel(*where, actions, noise, *(part[rows] for part in given))
        return tuple(np.ascontiguousarray(part) for part in out)

    def _begin(self, rows: NDArray[np.int64]) -> None:
        """New episodes for some rows."""
        arm, count = self.law.arm, len(rows)
        self._episode[rows] += self.num_envs
        room = ROOM * (self._upper - self._lower)
        drawn = self.np_random.uniform(self._lower + room, self._upper - room, (count, arm.n))
        q = drawn if self._start is None else np.broadcast_to(self._start, (count, arm.n))
        goals = np.asarray(self._goals(self.np_random, count), dtype=np.float64)
        if goals.shape != (count, 4, 4):
            raise InputError(f"goals gave an array of shape {goals.shape}; they must be tool poses ({count}, 4, 4), m")
        self._place[rows], self._rotation[rows] = goals[:, :3, 3], goals[:, :3, :3]
        events = [self.faults.draw(arm, episode=int(k), horizon=self.horizon) for k in self._episode[rows]]
        batch = batch_of(arm.joint_names, events, seed=self.faults.seed, first=0)
        self._code[rows], self._onset[rows], self._end[rows], self._parameters[rows] = kernel_rows(batch)
        self._ids[rows] = [each.id for each in events]
        self._state[rows] = np.concatenate([q, q, q, q, np.zeros(q.shape)], axis=1)
        self._time[rows], self._over[rows] = 0.0, False
        # A step of no time: what is told, and the error, at the beginning.
        state, error, _ = self._advance(np.zeros((count, arm.n)), 0.0, rows=rows)
        self._error[rows] = error
        self._state[rows, arm.n : 2 * arm.n] = state[:, arm.n : 2 * arm.n]

    def _random_goals(self, generator: np.random.Generator, count: int) -> Array:
        room = ROOM * (self._upper - self._lower)
        q = generator.uniform(self._lower + room, self._upper - room, (count, self.law.arm.n))
        return self.law.arm.forward_kinematics(q)

    def _observed(self) -> Array:
        n = self.law.arm.n
        return np.concatenate([self._state[:, n : 2 * n], self._error, self._state[:, -n:]], axis=1)

    def _told(self) -> dict[str, Any]:
        time = self._time[:, None]
        active = (self._code >= 0) & (self._onset <= time + 1e-9) & (time < self._end - 1e-9)
        self.fault = {
            "kind": self._code.astype(np.int64),
            "active": active,
            "id": self._ids.copy(),
        }
        return {"fault": self.fault, "_fault": np.ones(self.num_envs, dtype=bool)} if self._reveal else {}
