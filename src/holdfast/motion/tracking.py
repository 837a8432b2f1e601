"""Follow a path with the end effector while the self-motion serves an objective."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any, Literal

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm import kinematics
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.errors import HoldfastError, InputError
from holdfast.indices.objective import Objective
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.recall import recalled
from holdfast.motion.events import Course, Curvature, find_events
from holdfast.motion.redundancy import AugmentedJacobian, ExtendedJacobian, GradientProjection
from holdfast.motion.resolution import Resolution, chosen_task
from holdfast.motion.trajectory import Trajectory
from holdfast.notice import Count, says
from holdfast.paths.timed_path import TimedPath
from holdfast.solvers.fibre_paths import best_path
from holdfast.solvers.inverse_kinematics import clipped, solve_ik, solver, tool_error
from holdfast.solvers.optima import optimise

Array = NDArray[np.float64]
Method = Literal["gradient-projection", "extended-jacobian", "augmented-jacobian", "none"]
TRACKING = ("gradient-projection", "extended-jacobian")  # these stay at a local best
METHODS = ("gradient-projection", "extended-jacobian", "augmented-jacobian", "none")

_STEPS = 20_000  # of control, at least: the end effector is off by the square of a step
_SETTLING = 400  # steps before the first
_SETTLE = 10  # steps: time constant of the gain that is chosen if none is given
_FARTHEST = 0.02  # rad (and m) of self-motion in one step: more would take the end effector off its path
_PROBES = 64
_CATCH_UP = 3.0  # times the largest twist of the path
_BLOCK = 500  # steps after which somebody is told of them
_AT = 1e-6  # rad and m from a limit
_GRID = 101  # poses whose whole manifold is traced


@checked
@says("following the path")
def follow(
    arm: Arm,
    path: TimedPath,
    minimise: Objective | None = None,
    *,
    maximise: Objective | None = None,
    method: Method = "gradient-projection",
    q: ArrayLike | None = None,
    gain: float | None = None,
    wanted: float | None = None,
    rate_cap: float | None = None,
    task: str | Task | Sequence[str] | None = None,
    samples: int = 501,
    limits: bool = True,
    damping: float = 0.05,
    seed: int = 0,
    best: bool = False,
    spacing: float = 0.05,
    torque_bound: float | None = None,
) -> Trajectory:
    """Joint motion along a timed path of the end effector, with redundancy resolution.

    Args:
        arm: The arm.
        path: Where the end effector is to be, and when.
        minimise: What the self-motion makes small, for example a susceptibility; either this or ``maximise``.
        maximise: What it makes large.
        method: ``gradient-projection`` follows the gradient, ``extended-jacobian`` stays at an extremum, ``augmented-jacobian``
            keeps the value ``wanted``, ``none`` moves as little as possible (least-norm rates) and only reports.
        q: (n,) where to start, on the first pose. Default: the best configuration of the first pose.
        gain: Of the law; for gradient projection rad/s per unit of the objective and rad, otherwise 1/s. Default: chosen so
            that the self-motion settles within about 0.05 % of the duration, from the curvature of the objective on the path:
            it hardly lags, and shows the rates that staying at the best takes.
        wanted: Value that the augmented Jacobian keeps. Default: that of the start.
        rate_cap: Largest norm of the joint rates, rad/s; slows the self-motion only. Without it that is still kept to what
            20,000 steps resolve: 0.02 rad each.
        task: Rows of the poses to keep. Default: the objective's, or ``position`` for a path of positions, or ``pose``.
        samples: Number of samples, evenly spaced in time.
        limits: Keep the joints within their position and velocity limits.
        damping: Near singularities; see :class:`holdfast.motion.Resolution`.
        seed: Of the search for a start and of the manifolds.
        best: Also find the best value of each pose over its whole self-motion manifold, and the best continuous motion
            through these, by dynamic programming; for one or two degrees of redundancy. How fast it may move from one
            manifold to the next is the velocity limits of the joints, and the rate cap for each of them, if all have one.
        spacing: Of the points on these manifolds, rad.
        torque_bound: If given, N m and N, the result says how slow the motion must be for its torques to stay this close to
            gravity's; see :meth:`Trajectory.slowness`.

    Raises:
        ArmError: A torque_bound for an arm without inertial data.
        InputError: Not exactly one objective, a start that is not on the first pose, options out of range.
        TaskError: No redundancy, or an objective of another task.
        HoldfastError: No configuration of the first pose was found.

    Source: English and Maciejewski 1998, sections II and VI.
    """
    objective = _objective(minimise, maximise)
    chosen = chosen_task(arm, objective, task, "pose" if path.path.oriented else "position")
    if samples < 3:
        raise InputError(f"samples is {samples}; it must be 3 or more")
    if method not in METHODS:
        raise InputError(f"method '{method}' is not known; use one of {', '.join(METHODS)}")
    if rate_cap is not None and not rate_cap > 0:
        raise InputError(f"rate_cap is {rate_cap:g}; it must be above 0, or None")
    time = np.linspace(0.0, path.duration, samples)
    poses = path.pose(time)
    start = _start(arm, objective, chosen, poses[0], q, seed)
    curvature = Curvature(objective, chosen)
    substeps = -(-_STEPS // (samples - 1))
    step = path.duration / (samples - 1) / substeps
    if method == "none":
        gain = 0.0
    elif gain is None:
        gain = _gain(method, curvature, poses, step, seed)
    law: Resolution
    period = step if limits else None
    finest = _FARTHEST / step
    cap = finest if rate_cap is None else min(rate_cap, finest)
    keep: float | None = None
    if method == "extended-jacobian":
        law = ExtendedJacobian(arm, objective, gain, task=chosen, rate_cap=cap, period=period, damping=damping)
    elif method == "augmented-jacobian":
        keep = float(objective(start)) if wanted is None else wanted
        law = AugmentedJacobian(arm, objective, keep, gain=gain, task=chosen, rate_cap=cap, period=period, damping=damping)
    else:
        law = GradientProjection(arm, objective, gain, task=chosen, rate_cap=cap, period=period, damping=damping)
    if wanted is not None and keep is None:
        raise InputError(f"wanted is what the augmented Jacobian keeps; {method} does not, leave it out")
    settle = q is None and method in TRACKING
    joints, rates, shares = _integrate(law, path, start, (samples - 1) * substeps, step, limits, settle)
    course = _course(arm, objective, curvature, path.duration, joints, rates, shares, limits)
    limited = f"the rate cap of {cap:.4g} rad/s" if cap == rate_cap else f"the finest step of {_FARTHEST:g} rad"
    happened = find_events(objective, course, method in TRACKING, keep, limited)
    fastest = int(course.rate_norm.argmax())
    few = slice(None, None, substeps)
    position_error, rotation_error = solver(arm, chosen).errors(joints[few], poses)
    best_value, best_q = _best(arm, objective, chosen, poses, time, rate_cap, spacing, seed) if best else (None, None)
    alike: dict[str, Any] = {"minimise": minimise, "maximise": maximise, "rate_cap": rate_cap, "task": chosen, "q": start}
    alike |= {"samples": samples, "limits": limits, "damping": damping, "seed": seed}
    found = Trajectory(
        arm=arm,
        task=chosen,
        objective=objective,
        method=law.name if method != "none" else "least-norm rates",
        gain=gain,
        seed=seed,
        rate_cap=rate_cap,
        time=time,
        q=joints[few],
        qd=rates[few],
        qdd=np.gradient(rates[few], time, axis=0, edge_order=2),
        poses=poses,
        position_error=position_error,
        rotation_error=rotation_error,
        value=course.value[few],
        curvature=course.curvature[few],
        self_motion=shares[few, 0],
        task_share=shares[few, 1],
        damping=shares[few, 2],
        steps=len(joints) - 1,
        peak_rate=float(course.rate_norm[fastest]),
        peak_time=float(course.time[fastest]),
        events=happened,
        best_value=best_value,
        best_path=best_q,
        torque_bound=torque_bound,
        _plain=None if method == "none" else partial(follow, arm, path, method="none", **alike),
    )
    if torque_bound is not None:
        found.slowness(torque_bound)  # it may be refused
    return found


def _course(
    arm: Arm,
    objective: Objective,
    curvature: Curvature,
    duration: float,
    joints: Array,
    rates: Array,
    shares: Array,
    limits: bool,
) -> Course:
    at_limit = {
        joint.name: limits & ((joints[:, k] <= joint.lower + _AT) | (joints[:, k] >= joint.upper - _AT))
        for k, joint in enumerate(arm.joints)
    }
    return Course(
        np.linspace(0.0, duration, len(joints)),
        np.asarray(objective(joints)),
        curvature.smallest(joints),
        np.linalg.norm(rates, axis=1),
        shares[:, 0],
        shares[:, 1],
        shares[:, 2],
        at_limit,
    )


def _objective(minimise: Objective | None, maximise: Objective | None) -> Objective:
    if (minimise is None) == (maximise is None):
        raise InputError("give exactly one of minimise and maximise")
    if minimise is not None:
        return minimise if minimise.better == "smaller" else minimise.reversed()
    assert maximise is not None
    return maximise if maximise.better == "larger" else maximise.reversed()


def _start(arm: Arm, objective: Objective, task: Task, first: Array, q: ArrayLike | None, seed: int) -> Array:
    """Where to start: given, or the best configuration of the first pose."""
    if q is None:
        found = optimise(arm, first, objective, seed=seed, task=task)
        if not found.success:
            raise HoldfastError(
                f"no configuration of '{arm.name}' was found for the first pose of the path, within its joint limits: move the "
                "path, prescribe fewer rows, or widen the limits"
            )
        return found.q
    start = arm.check_configurations(q)
    if start.ndim != 1 or not np.isfinite(start).all():
        raise InputError(f"the start q of '{arm.name}' must be one configuration of {arm.n} finite numbers")
    engine = solver(arm, task)
    position, rotation = (float(x[0]) for x in engine.errors(start[None], first[None]))
    if not engine.verdict(start[None], first[None], 1e-3)[0]:
        raise InputError(
            f"the start q is {position:.3g} m and {rotation:.3g} rad from the first pose of the path, or outside the joint "
            "limits; leave it out to have one found"
        )
    return start


def _gain(method: str, curvature: Curvature, poses: Array, step: float, seed: int) -> float:
    """A gain with which the self-motion settles in a few steps, without overshooting."""
    rate = 1 / (_SETTLE * step)
    if method != "gradient-projection":
        return rate
    chosen = poses[np.linspace(0, len(poses) - 1, _PROBES).astype(int)]
    reach = solve_ik(curvature.objective.arm, chosen, seed, task=curvature.task, restarts=20)
    some = reach.q[reach.success]
    if not len(some):
        return 0.0
    matrices = curvature(some)[1]
    size = np.abs(np.linalg.eigvalsh(matrices[np.isfinite(matrices).all(axis=(1, 2))])).max(axis=1, initial=0.0)
    typical = float(np.quantile(size, 0.9)) if size.size else 0.0
    return rate / typical if typical > 0 else 0.0


def _integrate(
    law: Resolution, path: TimedPath, start: Array, count: int, step: float, limits: bool, settle: bool
) -> tuple[Array, Array, Array]:
    """Joints (N + 1, n), rates (N + 1, n) and shares (N + 1, 3) at N steps and the end: see :class:`holdfast.motion.Rates`.

    In each step the end effector is sent to where the path is at its end, so that errors do not add up.
    """
    # An end effector that limits kept off its path comes back to it at a few times the speed of the path, not within one step.
    fastest = float(np.linalg.norm(path.twist((np.arange(count) + 0.5) * step), axis=1).max())
    kernel = _step_kernel(law, step, limits, _CATCH_UP * fastest * step)
    if settle:  # what a search left open would be made up for at once, with rates that no motion needs
        start = _run(kernel, start, np.broadcast_to(path.pose(0.0), (_SETTLING, 4, 4)), step)[0][-1]
    joints, rates, shares = _run(kernel, start, path.pose(np.arange(1, count + 1) * step), step)
    n = law.arm.n
    last = kernel.rows(joints[-1], np.zeros(3), np.eye(3), path.twist(path.duration), 1.0)[0]
    return joints, np.vstack([rates, last[n : 2 * n]]), np.vstack([shares, last[2 * n :]])


def _run(kernel: Kernel, start: Array, targets: Array, step: float) -> tuple[Array, Array, Array]:
    """Joints (N + 1, n), rates (N, n) and shares (N, 3) from a start (n,) after targets (N, 4, 4)."""
    count, n = len(targets), len(start)
    data = np.concatenate([targets[:, :3, 3], targets[:, :3, :3].reshape(count, 9)], axis=1)[:, :, None]
    columns = np.zeros((n + 19, kernel.lanes))
    out = np.zeros((2 * n + 3, kernel.lanes))
    once, steps = kernel.bound(columns, out), np.empty((count, len(out)))
    columns[:n] = start[:, None]
    with Count("steps of the motion", count) as tell:
        for first in range(0, count, _BLOCK):
            last = min(first + _BLOCK, count)
            for k in range(first, last):
                columns[n : n + 12] = data[k]
                once()
                steps[k] = out[:, 0]
                columns[:n] = out[:n]
            tell(last - first)
    broken = ~np.isfinite(steps).all(axis=1)
    if broken.any():
        raise HoldfastError(
            f"the motion breaks down at {broken.argmax() * step:.4g} s: the arm is exactly singular there; start elsewhere"
        )
    return np.vstack([start, steps[:, :n]]), steps[:, n : 2 * n], steps[:, 2 * n :]


@recalled
def _step_kernel(law: Resolution, step: float, limits: bool, farthest: float) -> Kernel:
    """From q and a target pose, or a twist if ``given`` is 1, to the next q, the rates to it, and the shares."""
    arm = law.arm
    q, p, r = kinematics.joint_symbols(arm), ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
    twist, given = ca.SX.sym("twist", 6), ca.SX.sym("given")
    chain = kinematics.chain(arm, q)
    error = tool_error(law.task, chain.position, chain.rotation, p, r)
    size = ca.sqrt(ca.sumsqr(law.task.error(error, chain.rotation)) + 1e-30)  # of the rows that are prescribed
    out = law.expression(q, ca.if_else(given, twist, error * ca.if_else(size > farthest, farthest / size, 1) / step))
    following = q + step * out[: arm.n]
    if limits:
        following = clipped(arm, ca.vertsplit(following))
    return Kernel(f"step of {law.name}", [q, p, r, twist, given], [ca.vertcat(following, out)])


def _best(
    arm: Arm,
    objective: Objective,
    task: Task,
    poses: Array,
    time: Array,
    rate_cap: float | None,
    spacing: float,
    seed: int,
) -> tuple[Array, Array]:
    """Best value of each pose and the best continuous motion, on a coarser grid of poses, brought back to all samples."""
    sign = -1.0 if objective.better == "larger" else 1.0
    few = np.unique(np.linspace(0, len(poses) - 1, min(len(poses), _GRID)).astype(int))
    fastest = np.array([j.velocity for j in arm.joints])
    if rate_cap is not None:
        fastest = np.minimum(fastest, rate_cap)
    # Where a joint has no limit, the path's own default says what counts as continuous.
    limit = fastest * float(np.diff(time[few]).max()) if np.isfinite(fastest).all() else None
    found = best_path(arm, poses[few], lambda q: sign * objective(q), task=task, spacing=spacing, rate_limit=limit, seed=seed)
    values = np.interp(time, time[few], sign * found.global_value)
    motion = np.stack([np.interp(time, time[few], column) for column in found.q.T], axis=1)
    return values, motion
