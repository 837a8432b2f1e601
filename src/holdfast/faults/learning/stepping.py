"""One step of many arms in the kinematic closed loop with faults: a kernel in which each row has the faults of its episode.

The faults are in the program, not around it, so that rows with different faults make one call, on the processor or on a GPU.
"""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.control.law import Law
from holdfast.errors import InputError
from holdfast.faults.batch import FaultBatch
from holdfast.faults.entry import KINDS, TORQUE
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.solvers.inverse_kinematics import task_error

Array = NDArray[np.float64]

NEVER = 1e300  # kernels turn infinity into NaN
EARLY = 1e-9  # s: what begins at a step's time is there
STATE = ("q", "told", "place", "shown", "command")  # (n,) each, see `step_kernel`
EPISODE = 12  # numbers of an episode besides 7 n: its goal


@recalled
def step_kernel(law: Law) -> Kernel:
    """``(state, over, episode, action, noise, limits, setting) -> state, over, observation, reward, terminated, truncated``.

    A state holds where the joints are, what their sensors tell, where each was when its fault began, what the sensor before
    a slipping clutch shows, the command of the last step, and the time. The law sees what is told; the action, (n,) rates in
    units of the velocity limits, is added to its rates. An episode is where it starts, its goal, place before rotation, and its
    faults; where ``over`` is 1 the row begins that in place of a step. ``limits`` are lower, upper and velocity, (3 n,);
    ``setting`` is period, horizon and the two tolerances.
    """
    arm, task, n = law.arm, law.task, law.arm.n
    state, over, episode = ca.SX.sym("state", len(STATE) * n + 1), ca.SX.sym("over"), ca.SX.sym("episode", EPISODE + 7 * n)
    action, noise = ca.SX.sym("action", n), ca.SX.sym("noise", n)
    limits, setting = ca.SX.sym("limits", 3 * n), ca.SX.sym("setting", 4)
    period, horizon, near, aligned = ca.vertsplit(setting)
    start, p, r, code, onset, end, parameters = ca.vertsplit(episode, np.cumsum([0, n, 3, 9, n, n, n, 3 * n]).tolist())
    r = ca.reshape(r, 3, 3).T
    first, second, third = (parameters[k::3] for k in range(3))
    lower, upper, most = (limits[k * n : (k + 1) * n] for k in range(3))
    fresh = over > 0
    *places, last = (state[k * n : (k + 1) * n] for k in range(len(STATE)))
    q, told, place, shown = (ca.if_else(fresh, start, x) for x in places)
    now, last, step = (ca.if_else(fresh, 0.0, x) for x in (state[-1], last, period))
    after = now + step

    def there(kind: str, time: SX) -> SX:
        """(n,) 1 where a fault of the kind is there."""
        return _all(code == KINDS.index(kind), onset <= time + EARLY, time < end - EARLY)

    error, _ = task_error(arm, task, told, p, r)
    rates = law.inverse(law.jacobian(told), law.scaled(law.command(error)))
    rates = ca.if_else(ca.sumsqr(rates) < NEVER, rates, ca.SX.zeros(n))  # where the law has no answer: none
    wanted = _within(rates + _within(action, -1.0, 1.0) * most, -most, most)
    command = ca.if_else(ca.logic_or(there("command_dropout", now), fresh), last, wanted)
    slow = ca.if_else(there("reduced_speed", now), _lesser(first, most), most)
    held = there("locked", now) + there("slipping_clutch", now)
    moved = q + step * ca.if_else(held > 0, 0.0, _within(command, -slow, slow))
    reduced = there("reduced_range", now)
    low = ca.if_else(first < 0, place + first, _lesser(second, place))
    high = ca.if_else(_all(first > 0, first < NEVER), place + first, _greater(third, place))
    low, high = (ca.if_else(reduced, a, b) for a, b in ((_greater(low, lower), lower), (_lesser(high, upper), upper)))
    moved = ca.if_else(fresh, q, _within(moved, low, high))

    begins = _all(onset > now + EARLY, onset <= after + EARLY)
    place = ca.if_else(begins, moved, place)
    shown = ca.if_else(begins, moved, shown + step * command)
    told = moved + ca.if_else(there("sensor_bias", after), first, 0.0)
    told += ca.if_else(there("sensor_drift", after), first * (after - onset), 0.0)
    told += ca.if_else(there("sensor_noise", after), first * noise, 0.0)
    told = ca.if_else(there("sensor_freeze", after), place, told)
    told = ca.if_else(there("slipping_clutch", after), shown, told)
    seen, _ = task_error(arm, task, told, p, r)
    true, _ = task_error(arm, task, moved, p, r)
    miss, turn = (ca.norm_2(ca.SX(ca.DM(task.rows[:, some].T)) @ true) for some in (slice(0, 3), slice(3, 6)))
    terminated = _all(over <= 0, miss <= near, turn <= aligned)
    truncated = _all(over <= 0, ca.logic_not(terminated), after >= horizon - EARLY)
    reward = ca.if_else(fresh, 0.0, -(miss + turn))
    return Kernel(
        "step with faults",
        [state, over, episode, action, noise, limits, setting],
        [
            ca.vertcat(moved, told, place, shown, command, after),
            ca.logic_or(terminated, truncated),
            ca.vertcat(told, seen, command),
            reward,
            terminated,
            truncated,
        ],
    )


def kernel_rows(batch: FaultBatch) -> Array:
    """(N, 6 n) code, onset, end and parameters of episodes, as the kernel takes them.

    Raises:
        InputError: A fault of a motor's torque, or a lock at an angle, which a loop of rates alone does not have.
    """
    for events in batch.episodes:
        for event in events:
            if event.kind in TORQUE or event.parameters.get("at", "here") != "here":
                raise InputError(
                    f"'{event.sentence()}' needs bodies and motors, and this loop has rates alone; use "
                    "holdfast.simulate_faults or a FaultWrapper"
                )
    parameter = batch.parameter.copy()
    ranges = batch.kind == KINDS.index("reduced_range")
    fill = np.array([NEVER, -NEVER, NEVER])  # no travel, no lower, no upper stop
    parameter = np.where(np.isnan(parameter), np.where(ranges[..., None], fill, 0.0), parameter)
    onset, end = (np.where(np.isfinite(x), x, NEVER) for x in (batch.onset, batch.end))
    return np.concatenate([batch.kind, onset, end, parameter.reshape(len(batch), -1)], axis=1)


def _all(*conditions: SX) -> SX:
    found = conditions[0]
    for condition in conditions[1:]:
        found = ca.logic_and(found, condition)
    return found


def _lesser(a: SX, b: SX) -> SX:
    return ca.if_else(a < b, a, b)


def _greater(a: SX, b: SX) -> SX:
    return ca.if_else(a > b, a, b)


def _within(value: SX, low: SX, high: SX) -> SX:
    return _lesser(_greater(value, low), high)
