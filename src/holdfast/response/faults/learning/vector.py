"""Environment of Gymnasium's vector API with many arms in the kinematic closed loop and random faults."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.control.laws.law import Law
from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.typing import FloatArray
from holdfast.response.faults.batch import make_batch
from holdfast.response.faults.events import FaultEvents
from holdfast.response.faults.fault_model import FaultModel
from holdfast.response.faults.kind import fault_kinds
from holdfast.response.faults.learning.stepping import GOAL_NUMBERS, STATE_PARTS, build_step_kernel, make_fault_rows
from holdfast.response.faults.step_symbols import KERNEL_INFINITY

try:
    from gymnasium.vector import VectorEnv
except ImportError:  # reported when an environment is created, so that the other names can be imported
    VectorEnv = object

Goals = Callable[[np.random.Generator, int], FloatArray]
UNLIMITED_SPEED_RAD_S = 2 * np.pi  # rad/s or m/s of a joint without a velocity limit
LIMIT_MARGIN_FRACTION = 0.05  # of a joint's range: distance of starts and random goals from the limits


class FaultVectorEnv(VectorEnv):  # type: ignore[misc]
    """N arms with a control law each, whose joints fail while they move to their targets (needs ``holdfast-arms[learn]``).

    The loop is kinematic: joints execute their commands exactly, within position and velocity limits. A step of all arms is one
    call of one kernel. The action, (N, n) in -1 to 1, is added to the law's joint rates, in units of the velocity limits. With
    an action of zeros the law alone moves the arms, without information about failures. An observation contains the readings of
    the joint sensors (n,), the resulting error of the task's rows (m,), m and rad, and the last commanded rates (n,). The
    reward is minus the distance of the true tool pose from its target, m and rad. An episode is terminated if this distance is
    within the tolerance, and truncated at the horizon; the arm restarts with the next step (``AutoresetMode.NEXT_STEP``).

    Row i has the episodes i, i + N, ... of the fault model. Possible kinds are locks, ranges, speeds, sensors, dropouts and
    clutches, because rates have no torque that could fail. Only the first fault of a joint in an episode counts.
    ``info["fault"]`` contains the faults: ``kind`` (N, n) as in :class:`holdfast.response.faults.FaultBatch`, ``active`` (N,
    n), ``id`` (N,).

    Arrays are NumPy arrays. On a GPU (``hf.set_backend("cuda")`` before the environment is created) observations, rewards and
    both end flags, 0 or 1, are arrays of doubles on the GPU, for ``from_dlpack`` of PyTorch, JAX or CuPy without a copy.
    Actions may be such arrays, and the state remains on the GPU. Per step, only one number per arm, the end flag of its
    episode, is copied back with the next step, and the numbers of new episodes are copied to the GPU.

    Args:
        law: Control law, with its arm, task, gain and speed limit.
        num_envs: Number N of arms.
        faults: Fault model. None: no faults.
        period: Duration of a step, s.
        horizon: Duration of an episode, s.
        goals: ``goals(generator, count) -> (count, 4, 4)`` tool poses in the world, m. Default: poses of random configurations.
        start: (n,) configuration at which each episode begins, rad and m. Default: random.
        tolerance: Distances from the goal that count as success, m and rad.
        reveal: False: ``info`` contains no faults; they are only in ``env.fault``, which policies do not see.
        stream: Handle of the GPU stream; 1 is the default stream.

    Attributes:
        fault: Content of ``info["fault"]``.

    Raises:
        InputError: A loop of rates cannot represent a fault, or a number is not above 0.
        HoldfastError: Gymnasium is not installed.
    """

    def __init__(
        self,
        law: Law,
        num_envs: int,
        faults: FaultModel | None = None,
        *,
        period: float = 0.02,
        horizon: float = 10.0,
        goals: Goals | None = None,
        start: FloatArray | None = None,
        tolerance: tuple[float, float] = (5e-3, np.deg2rad(1.0)),
        reveal: bool = True,
        stream: int = 1,
    ) -> None:
        if VectorEnv is object:
            raise HoldfastError("Gymnasium is not installed; pip install 'holdfast-arms[learn]'")
        from gymnasium.spaces import Box
        from gymnasium.vector import AutoresetMode
        from gymnasium.vector.utils import batch_space

        if num_envs < 1 or not 0 < period <= horizon < np.inf:
            raise InputError(
                f"there are {num_envs} arms, steps of {period:g} s and a horizon of {horizon:g} s; give at least one arm, and "
                "a period above 0 and at most the horizon"
            )
        self.law, self.num_envs, self.faults = law, int(num_envs), FaultModel([]) if faults is None else faults
        self.period, self.horizon, self.tolerance, self._reveal = float(period), float(horizon), tolerance, reveal
        self.stream = stream
        arm, n = law.arm, law.arm.n
        self._lower = np.where(np.isfinite(arm.lower), arm.lower, -np.pi)
        self._upper = np.where(np.isfinite(arm.upper), arm.upper, np.pi)
        speeds = np.array([joint.velocity for joint in arm.joints])
        speeds = np.where(np.isfinite(speeds), speeds, UNLIMITED_SPEED_RAD_S)
        finite_limits = [np.clip(limit, -KERNEL_INFINITY, KERNEL_INFINITY) for limit in (arm.lower, arm.upper)]
        self._limits = np.concatenate([*finite_limits, speeds])
        self._goals, self._start = goals, None if start is None else arm.check_configurations(start)
        self._kernel = build_step_kernel(law).current()
        self._on_gpu = self._kernel.backend.startswith("cuda")
        self.metadata = {"autoreset_mode": AutoresetMode.NEXT_STEP, "render_modes": []}
        self.single_action_space = Box(-1.0, 1.0, (n,), np.float64)
        self.single_observation_space = Box(-np.inf, np.inf, (2 * n + law.task.m,), np.float64)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self._allocate_arrays()

    def _allocate_arrays(self) -> None:
        row_count, n = self.num_envs, self.law.arm.n
        self._episodes, self._time = np.zeros((row_count, GOAL_NUMBERS + 7 * n)), np.zeros(row_count)
        self._fault_codes, self._onset, self._end = (self._episodes[:, GOAL_NUMBERS + part * n :][:, :n] for part in (1, 2, 3))
        self._fault_codes[:] = -1.0
        self._episode_numbers, self._event_ids = np.arange(row_count) - row_count, np.full(row_count, FaultEvents().id)
        self._is_over, self._has_begun = self._upload(np.ones(row_count)), False
        # Arrays that stay on a GPU from step to step.
        state, setting = np.zeros((row_count, len(STATE_PARTS) * n + 1)), np.array([self.period, self.horizon, *self.tolerance])
        device_arrays = map(self._upload, [self._episodes, state, np.zeros(n), self._limits, setting])
        self._episode_table, self._state, self._no_noise, *self._setting = device_arrays

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Reset all arms; with ``seed``, also restart the fault episodes with the first one. ``options`` are ignored."""
        if seed is not None:
            self._np_random, self._np_random_seed = np.random.default_rng(seed), seed
            self._allocate_arrays()
        all_rows = np.arange(self.num_envs)
        self._begin_episodes(all_rows)
        self._is_over = self._upload(np.ones(self.num_envs))
        self._call_kernel(self._no_noise, self._draw_noise(all_rows))
        self._time[:] = 0.0
        del options
        return self._results[0], self._make_info()

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """Step all arms by one period. Rows whose episode was over begin the next one, and their action is ignored.

        Args:
            actions: (N, n) additional joint rates in units of the velocity limits, -1 to 1.

        Raises:
            InputError: Actions have another shape or contain NaN (for arrays on a GPU, raised by the next step).
        """
        if tuple(np.shape(actions)) != self.action_space.shape:
            expected_text = f"they must be {self.action_space.shape}, a row for each arm"
            raise InputError(f"actions have shape {tuple(np.shape(actions))}; {expected_text}")
        is_over = np.asarray(self._is_over)
        if np.isnan(is_over).any():
            raise InputError(
                f"{_describe_invalid_action(is_over)} in the last step, so the state of that arm is lost; reset the environment"
            )
        if not self._on_gpu or _is_on_host(actions):
            clipped_actions = np.where(is_over[:, None] > 0, 0.0, np.clip(np.asarray(actions, dtype=np.float64), -1.0, 1.0))
            if np.isnan(clipped_actions).any():
                raise InputError(f"{_describe_invalid_action(clipped_actions.sum(axis=1))}; give numbers from -1 to 1")
            actions = self._upload(clipped_actions)
        noise, new_rows = self._draw_noise(np.arange(self.num_envs)), np.flatnonzero(is_over > 0)
        if new_rows.size:
            if not self._has_begun:
                self._begin_episodes(new_rows)
            noise[new_rows] = self._draw_noise(new_rows)
        self._call_kernel(actions, noise)
        self._time = np.where(is_over > 0, 0.0, self._time + self.period)
        observation, reward, terminated, truncated = self._results
        if not self._on_gpu:
            terminated, truncated = terminated > 0, truncated > 0
        return observation, reward, terminated, truncated, self._make_info()

    @property
    def q(self) -> FloatArray:
        """True joint positions (N, n), rad and m, independent of the sensors."""
        return np.asarray(self._state)[:, : self.law.arm.n]

    # ---- internal ----------------------------------------------------------------------------------------------------

    def _upload(self, array: FloatArray) -> Any:
        return self._kernel.upload(array, self.stream) if self._on_gpu else array

    def _draw_noise(self, rows: NDArray[np.int64]) -> FloatArray:
        """Sample the sensor noise (R, n) of some rows; zeros where no sensor is noisy."""
        shape = len(rows), self.law.arm.n
        is_noisy = np.isin(self._fault_codes[rows], [kind.code for kind in fault_kinds().values() if kind.draws_noise]).any()
        return self.np_random.standard_normal(shape) if is_noisy else np.zeros(shape)

    def _call_kernel(self, actions: Any, noise: FloatArray) -> None:
        """Advance all rows by one call of the kernel."""
        device_noise = self._upload(noise) if noise.any() else self._no_noise
        inputs = self._state, self._is_over, self._episode_table, actions, device_noise, *self._setting
        # On a GPU, freeing the inputs would wait for this step, so they are kept until the next one.
        self._last_inputs = inputs
        outputs = self._kernel.exchange(*inputs, stream=self.stream) if self._on_gpu else self._kernel(*inputs)
        self._state, self._is_over, *self._results = outputs
        self._has_begun = False

    def _begin_episodes(self, rows: NDArray[np.int64]) -> None:
        """Sample the next episodes of some rows."""
        arm, count = self.law.arm, len(rows)
        sampled_q = self._sample_configurations(self.np_random, count)
        q_start = sampled_q if self._start is None else np.broadcast_to(self._start, (count, arm.n))
        sample_goals = self._goals or (lambda *options: arm.forward_kinematics(self._sample_configurations(*options)))
        goals = np.asarray(sample_goals(self.np_random, count), dtype=np.float64)
        if goals.shape != (count, 4, 4) or not np.isfinite(goals).all():
            raise InputError(f"goals returned an array of shape {goals.shape}; it must be finite tool poses ({count}, 4, 4), m")
        episodes = self._episode_numbers[rows] + self.num_envs
        events = [self.faults.draw(arm, episode=int(episode), horizon=self.horizon) for episode in episodes]
        faults = make_fault_rows(make_batch(arm.joint_names, events, seed=self.faults.seed, first=0))
        positions, rotations = goals[:, :3, 3], goals[:, :3, :3].reshape(count, 9)
        self._episodes[rows] = np.concatenate([q_start, positions, rotations, faults], axis=1)
        if self._on_gpu:
            self._episode_table.upload_rows(rows, self._episodes)
        self._event_ids[rows] = [episode_events.id for episode_events in events]
        self._episode_numbers[rows], self._has_begun = episodes, True

    def _sample_configurations(self, generator: np.random.Generator, count: int) -> FloatArray:
        limit_margins = LIMIT_MARGIN_FRACTION * (self._upper - self._lower)
        return generator.uniform(self._lower + limit_margins, self._upper - limit_margins, (count, self.law.arm.n))

    def _make_info(self) -> dict[str, Any]:
        time = self._time[:, None]
        active = (self._fault_codes >= 0) & (self._onset <= time + 1e-9) & (time < self._end - 1e-9)
        self.fault = {"kind": self._fault_codes.astype(np.int64), "active": active, "id": self._event_ids.copy()}
        return {"fault": self.fault, "_fault": np.ones(self.num_envs, dtype=bool)} if self._reveal else {}


def _describe_invalid_action(rows: FloatArray) -> str:
    return f"the action of arm {int(np.flatnonzero(np.isnan(rows))[0])} is not a number"


def _is_on_host(array: Any) -> bool:
    return not hasattr(array, "__dlpack_device__") or int(array.__dlpack_device__()[0]) == 1  # kDLCPU
