"""Follow a path with the hand while the self-motion serves an objective."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm import kinematics
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task
from holdfast.control.events import Curvature, events
from holdfast.control.resolution import AugmentedJacobian, ExtendedJacobian, GradientProjection, Resolution
from holdfast.control.trajectory import Trajectory
from holdfast.errors import HoldfastError, InputError
from holdfast.indices import Objective
from holdfast.kernels import Kernel
from holdfast.paths import TimedPath
from holdfast.solve import optimise, solve_ik, solver
from holdfast.solve.fibre_path import best_path
from holdfast.solve.inverse import clipped, hand_error

Array = NDArray[np.float64]
Method = Literal["gradient-projection", "extended-jacobian", "augmented-jacobian", "none"]
METHODS = ("gradient-projection", "extended-jacobian", "augmented-jacobian", "none")

_SUBSTEPS = 10  # of control between two samples: the hand is off by the square of a step
# Time constant of the gain that is chosen if none is given, of the duration, where the objective is curved as it typically
# is; where it is flat the self-motion lags, and at 1 % it was taken for lost on a path that has no algorithmic singularity.
_SETTLE = 0.002
_STEADY = 0.2  # of the way to the extremum in one step, at most
_PROBES = 64
_GRID = 101  # poses whose whole manifold is traced


def follow(
    arm: Arm,
    path: TimedPath,
    minimise: Objective | None = None,
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
) -> Trajectory:
    """Joint motion along a timed path of the hand, with redundancy resolution.

    Args:
        arm: The arm.
        path: Where the hand is to be, and when.
        minimise: What the self-motion makes small, for example a susceptibility; either this or ``maximise``.
        maximise: What it makes large.
        method: ``gradient-projection`` follows the gradient, ``extended-jacobian`` stays at an extremum, ``augmented-jacobian``
            keeps the value ``wanted``, ``none`` moves as little as possible (least-norm rates) and only reports.
        q: (n,) where to start, on the first pose. Default: the best configuration of the first pose.
        gain: Of the law; for gradient projection rad/s per unit of the objective and rad, otherwise 1/s. Default: chosen so
            that the self-motion settles within about 0.2 % of the duration where the objective is curved as it typically is.
        wanted: Value that the augmented Jacobian keeps. Default: that of the start.
        rate_cap: Largest norm of the joint rates, rad/s; slows the self-motion only.
        task: Rows of the poses to keep. Default: the objective's, or ``position`` for a path of positions, or ``pose``.
        samples: Number of samples, evenly spaced in time.
        limits: Keep the joints within their position and velocity limits.
        damping: Near singularities; see :class:`holdfast.control.Resolution`.
        seed: Of the search for a start and of the manifolds.
        best: Also find the best value of each pose over its whole self-motion manifold, and the best continuous motion
            through these, by dynamic programming; for one or two degrees of redundancy. How fast it may move from one
            manifold to the next is the velocity limits of the joints, and the rate cap for each of them, if all have one.
        spacing: Of the points on these manifolds, rad.

    Raises:
        InputError: Not exactly one objective, a start that is not on the first pose, options out of range.
        TaskError: No redundancy, or an objective of another task.
        HoldfastError: No configuration of the first pose was found.

    Source: English and Maciejewski 1998, sections II and VI.
    """
    objective = _objective(minimise, maximise)
    chosen = _task(arm, path, objective, task)
    if samples < 3:
        raise InputError(f"samples is {samples}; it must be 3 or more")
    if method not in METHODS:
        raise InputError(f"method '{method}' is not known; use one of {', '.join(METHODS)}")
    time = np.linspace(0.0, path.duration, samples)
    poses = path.pose(time)
    start = _start(arm, objective, chosen, poses[0], q, seed)
    curvature = Curvature(objective, chosen)
    step = path.duration / (samples - 1) / _SUBSTEPS
    if method == "none":
        gain = 0.0
    elif gain is None:
        gain = _gain(method, curvature, poses, min(1 / (_SETTLE * path.duration), _STEADY / step), seed)
    law: Resolution
    period = step if limits else None
    if method == "extended-jacobian":
        law = ExtendedJacobian(arm, objective, gain, chosen, rate_cap, period, damping)
    elif method == "augmented-jacobian":
        keep = float(objective(start)) if wanted is None else wanted
        law = AugmentedJacobian(arm, objective, keep, gain, chosen, rate_cap, period, damping)
    else:
        law = GradientProjection(arm, objective, gain, chosen, rate_cap, period, damping)
    joints, rates, shares = _integrate(law, path, start, samples, step, limits)
    position_error, rotation_error = solver(arm, chosen).errors(joints, poses)
    found = curvature.smallest(joints)
    value = np.asarray(objective(joints))
    inside = 1e-6
    at_limit = {
        joint.name: limits & ((joints[:, k] <= joint.lower + inside) | (joints[:, k] >= joint.upper - inside))
        for k, joint in enumerate(arm.joints)
    }
    norm = np.linalg.norm(rates, axis=1)
    happened = events(objective, time, value, found, norm, shares[:, 0], shares[:, 1], shares[:, 2], at_limit)
    best_value, best_q = _best(arm, objective, chosen, poses, time, rate_cap, spacing, seed) if best else (None, None)
    return Trajectory(
        arm,
        chosen,
        objective,
        law.name if method != "none" else "least-norm rates",
        time,
        joints,
        rates,
        np.gradient(rates, time, axis=0, edge_order=2),
        poses,
        position_error,
        rotation_error,
        value,
        found,
        shares[:, 0],
        shares[:, 1],
        shares[:, 2],
        happened,
        best_value,
        best_q,
    )


def _objective(minimise: Objective | None, maximise: Objective | None) -> Objective:
    if (minimise is None) == (maximise is None):
        raise InputError("give exactly one of minimise and maximise")
    if minimise is not None:
        return minimise if minimise.better == "smaller" else minimise.reversed()
    assert maximise is not None
    return maximise if maximise.better == "larger" else maximise.reversed()


def _task(arm: Arm, path: TimedPath, objective: Objective, task: str | Task | Sequence[str] | None) -> Task:
    if task is not None:
        return as_task(arm, task)
    if objective.own_task is not None:
        return objective.own_task
    return as_task(arm, "pose" if path.path.oriented else "position")


def _start(arm: Arm, objective: Objective, task: Task, first: Array, q: ArrayLike | None, seed: int) -> Array:
    """Where to start: given, or the best configuration of the first pose."""
    if q is None:
        found = optimise(arm, first, objective, seed, task=task)
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


def _gain(method: str, curvature: Curvature, poses: Array, rate: float, seed: int) -> float:
    """A gain with which the self-motion settles at ``rate``, 1/s, where the curvature is at the 90 % quantile of the path's."""
    if method != "gradient-projection":
        return rate
    chosen = poses[np.linspace(0, len(poses) - 1, _PROBES).astype(int)]
    reach = solve_ik(curvature.objective.arm, chosen, seed, curvature.task, restarts=20)
    some = reach.q[reach.success]
    if not len(some):
        return 0.0
    matrices = curvature(some)[1]
    size = np.abs(np.linalg.eigvalsh(matrices[np.isfinite(matrices).all(axis=(1, 2))])).max(axis=1, initial=0.0)
    typical = float(np.quantile(size, 0.9)) if size.size else 0.0
    return rate / typical if typical > 0 else 0.0


def _integrate(
    law: Resolution, path: TimedPath, start: Array, samples: int, step: float, limits: bool
) -> tuple[Array, Array, Array]:
    """Joints (T, n), rates (T, n) and shares (T, 3): see :class:`holdfast.control.Rates`.

    In each step the hand is sent to where the path is at its end, so that errors do not add up.
    """
    n = law.arm.n
    kernel = _step_kernel(law, step, limits)
    count = (samples - 1) * _SUBSTEPS
    targets = path.pose(np.arange(1, count + 1) * step)
    data = np.concatenate([targets[:, :3, 3], targets[:, :3, :3].reshape(count, 9)], axis=1)
    columns = np.zeros((n + 12, kernel.lanes))
    out = np.zeros((2 * n + 3, kernel.lanes))
    joints, rates, shares = np.empty((samples, n)), np.empty((samples, n)), np.empty((samples, 3))
    columns[:n] = start[:, None]
    for k in range(count):
        if k % _SUBSTEPS == 0:
            joints[k // _SUBSTEPS] = columns[:n, 0]
        columns[n:] = data[k][:, None]
        kernel.evaluate_columns(columns, out)
        if not np.isfinite(out[:, 0]).all():
            raise HoldfastError(
                f"the motion breaks down at {k * step:.4g} s: the arm is exactly singular there; start elsewhere"
            )
        if k % _SUBSTEPS == 0:
            rates[k // _SUBSTEPS], shares[k // _SUBSTEPS] = out[n : 2 * n, 0], out[2 * n :, 0]
        columns[:n] = out[:n]
    joints[-1] = columns[:n, 0]
    last = law.rates(joints[-1], path.twist(path.duration))
    rates[-1], shares[-1] = last.rates, (last.self_motion, last.task, last.damping)
    return joints, rates, shares


def _step_kernel(law: Resolution, step: float, limits: bool) -> Kernel:
    """From q and a target pose to the next q, the rates that lead there, and the shares."""
    arm = law.arm
    q, p, r = kinematics.joint_symbols(arm), ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
    chain = kinematics.chain(arm, q)
    out = law.expression(q, hand_error(law.task, chain.position, chain.rotation, p, r) / step)
    following = q + step * out[: arm.n]
    if limits:
        following = clipped(arm, ca.vertsplit(following))
    return Kernel(f"step of {law.name}", [q, p, r], [ca.vertcat(following, out)])


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
    found = best_path(arm, poses[few], lambda q: sign * objective(q), task, spacing, limit, seed=seed)
    values = np.interp(time, time[few], sign * found.global_value)
    motion = np.stack([np.interp(time, time[few], column) for column in found.q.T], axis=1)
    return values, motion
