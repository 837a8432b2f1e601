"""Tracking of a path by the end effector while the self-motion serves an objective."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.progress import reports_progress
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.indices.objective import Objective
from holdfast.kinematics.path_following.clearance_limits import ClearanceRateLimit
from holdfast.kinematics.path_following.events import Curvature, MotionHistory, find_events
from holdfast.kinematics.path_following.integration import integrate_law
from holdfast.kinematics.path_following.redundancy import AugmentedJacobian, ExtendedJacobian, GradientProjection
from holdfast.kinematics.path_following.resolution import Resolution, choose_task
from holdfast.kinematics.path_following.trajectory import Trajectory
from holdfast.kinematics.paths.timed_path import TimedPath
from holdfast.kinematics.solvers.fibre_paths import best_path
from holdfast.kinematics.solvers.inverse_kinematics import solve_ik, solver
from holdfast.kinematics.solvers.optima import optimise
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance

Method = Literal["gradient-projection", "extended-jacobian", "augmented-jacobian", "none"]
OPTIMUM_METHODS = ("gradient-projection", "extended-jacobian")  # methods that stay at a local best
METHOD_NAMES = ("gradient-projection", "extended-jacobian", "augmented-jacobian", "none")

_MIN_CONTROL_STEPS = 20_000  # minimum number of control steps, because the end effector errs by the square of a step
_SETTLING_STEPS = 10  # steps: time constant of the default gain
_MAX_SELF_MOTION_STEP = 0.02  # rad (and m) of self-motion in one step: more would take the end effector off its path
_GAIN_PROBES = 64
_LIMIT_TOLERANCE = 1e-6  # rad and m from a limit
_APPROACH_STEPS = 100  # steps: time constant with which the distance to a nearby object may shrink
_TRACED_POSES = 101  # poses whose whole manifold is traced


@check_arguments
@reports_progress("following the path")
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
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    margin: float = 0.0,
) -> Trajectory:
    """Compute the joint motion along a timed path of the end effector, with redundancy resolution.

    Args:
        arm: Arm model.
        path: Timed path of the end effector.
        minimise: Objective that the self-motion minimises, for example a susceptibility; give either this or ``maximise``.
        maximise: Objective that the self-motion maximises.
        method: ``gradient-projection`` follows the gradient, ``extended-jacobian`` stays at an extremum, ``augmented-jacobian``
            keeps the value ``wanted``, ``none`` uses least-norm rates and only reports the objective.
        q: (n,) start configuration on the first pose, rad and m. Default: the best configuration of the first pose.
        gain: Gain of the law; for gradient projection rad/s per unit of the objective and rad, otherwise 1/s. Default: chosen
            from the curvature of the objective on the path so that the self-motion settles within about 0.05 % of the duration.
            It then hardly lags, and its rates show what staying at the best requires.
        wanted: Value that the augmented Jacobian keeps, in the unit of the objective. Default: the value at the start.
        rate_cap: Largest norm of the joint rates, rad/s; it slows the self-motion only. Default: the rate that
            20,000 steps of 0.02 rad resolve.
        task: Rows of the poses to keep. Default: the objective's task, or ``position`` for a path of positions, or ``pose``.
        samples: Number of samples, evenly spaced in time.
        limits: Keep the joints within their position and velocity limits.
        damping: Damping factor near singularities; see :class:`holdfast.kinematics.path_following.Resolution`.
        seed: Seed of the search for a start and of the manifolds.
        best: Also find the best value of each pose over its whole self-motion manifold, and the best continuous motion through
            these manifolds, by dynamic programming; for one or two degrees of redundancy. The velocity limits of the joints, if
            all have one, and the rate cap for each joint limit the motion from one manifold to the next.
        spacing: Distance of the points on these manifolds, rad.
        torque_bound: Bound in N m and N; the result then reports how slow the motion must be for its torques to stay this close
            to gravity's; see :meth:`Trajectory.slowness`.
        clearance: Collision model; self-motion then keeps the links apart. True: capsules with an assumed radius. Default: not
            checked.
        cell: Environment, or its file, to avoid by self-motion. The links are then kept apart as well, except for a planar arm
            and with ``clearance=False``.
        margin: Smallest clearance, m, in addition to the distances that the cell requires. The remaining distance to the
            nearest pair may shrink at most to 1/e within 0.5 % of the duration. If no self-motion can respect this limit, the
            end effector is slowed, and stops.

    Raises:
        ArmError: A torque_bound is given for an arm without inertial data.
        InputError: Not exactly one objective; a start that is not on the first pose or collides; an option out of range.
        TaskError: There is no redundancy, or the objective has another task.
        HoldfastError: No configuration of the first pose was found.

    Source: English and Maciejewski 1998, sections II and VI.
    """
    objective = _read_objective(minimise, maximise)
    resolved_task = choose_task(arm, objective, task, "pose" if path.path.oriented else "position")
    if samples < 3:
        raise InputError(f"samples is {samples}; it must be 3 or more")
    if method not in METHOD_NAMES:
        raise InputError(f"method '{method}' is not known; use one of {', '.join(METHOD_NAMES)}")
    if rate_cap is not None and not rate_cap > 0:
        raise InputError(f"rate_cap is {rate_cap:g}; it must be above 0, or None")
    if not np.isfinite(margin):
        raise InputError(f"margin is {margin:g}; it must be a finite number of metres")
    resolved_clearance = chosen_clearance(arm, clearance, cell, looks=False)
    if resolved_clearance is None and margin:
        raise InputError("margin has no effect, because no clearance is checked; give a cell, or a clearance")
    time = np.linspace(0.0, path.duration, samples)
    poses = path.pose(time)
    start = _find_start(arm, objective, resolved_task, poses[0], q, seed, resolved_clearance, margin)
    curvature = Curvature(objective, resolved_task)
    substeps = -(-_MIN_CONTROL_STEPS // (samples - 1))
    step = path.duration / (samples - 1) / substeps
    if method == "none":
        gain = 0.0
    elif gain is None:
        gain = _choose_gain(method, curvature, poses, step, seed)
    law: Resolution
    period = step if limits else None
    finest_cap = _MAX_SELF_MOTION_STEP / step
    cap = finest_cap if rate_cap is None else min(rate_cap, finest_cap)
    target_value: float | None = None
    if method == "extended-jacobian":
        law = ExtendedJacobian(arm, objective, gain, task=resolved_task, rate_cap=cap, period=period, damping=damping)
    elif method == "augmented-jacobian":
        target_value = float(objective(start)) if wanted is None else wanted
        law = AugmentedJacobian(
            arm, objective, target_value, gain=gain, task=resolved_task, rate_cap=cap, period=period, damping=damping
        )
    else:
        law = GradientProjection(arm, objective, gain, task=resolved_task, rate_cap=cap, period=period, damping=damping)
    if wanted is not None and target_value is None:
        raise InputError(f"wanted is for the augmented Jacobian, not for {method}; leave it out")
    settle = q is None and method in OPTIMUM_METHODS
    rate_limit = (
        None if resolved_clearance is None else ClearanceRateLimit(resolved_clearance, margin, 1 / (_APPROACH_STEPS * step))
    )
    joints, rates, fractions = integrate_law(law, path, start, (samples - 1) * substeps, step, limits, settle, rate_limit)
    history = _motion_history(arm, objective, curvature, path.duration, joints, rates, fractions, limits)
    cap_phrase = f"the rate cap of {cap:.4g} rad/s" if cap == rate_cap else f"the finest step of {_MAX_SELF_MOTION_STEP:g} rad"
    clearance_history = None if rate_limit is None else rate_limit.trace_clearance(joints)
    events = find_events(objective, history, method in OPTIMUM_METHODS, target_value, cap_phrase, clearance_history)
    peak_index = int(history.rate_norm.argmax())
    sampled = slice(None, None, substeps)
    position_error, rotation_error = solver(arm, resolved_task).position_and_rotation_errors(joints[sampled], poses)
    best_value, best_q = (
        _find_best_motion(arm, objective, resolved_task, poses, time, rate_cap, spacing, seed, resolved_clearance, margin)
        if best
        else (None, None)
    )
    plain_options: dict[str, Any] = {"minimise": minimise, "maximise": maximise, "rate_cap": rate_cap, "task": resolved_task}
    plain_options |= {"q": start, "samples": samples, "limits": limits, "damping": damping, "seed": seed}
    plain_options |= {"clearance": resolved_clearance, "margin": margin}
    trajectory = Trajectory(
        arm=arm,
        task=resolved_task,
        objective=objective,
        method=law.name if method != "none" else "least-norm rates",
        gain=gain,
        seed=seed,
        rate_cap=rate_cap,
        time=time,
        q=joints[sampled],
        qd=rates[sampled],
        qdd=np.gradient(rates[sampled], time, axis=0, edge_order=2),
        poses=poses,
        position_error=position_error,
        rotation_error=rotation_error,
        value=history.value[sampled],
        curvature=history.curvature[sampled],
        self_motion=fractions[sampled, 0],
        task_share=fractions[sampled, 1],
        damping=fractions[sampled, 2],
        steps=len(joints) - 1,
        peak_rate=float(history.rate_norm[peak_index]),
        peak_time=float(history.time[peak_index]),
        events=events,
        best_value=best_value,
        best_path=best_q,
        torque_bound=torque_bound,
        clear_of=resolved_clearance,
        margin=margin,
        _plain=None if method == "none" else partial(follow, arm, path, method="none", **plain_options),
    )
    if torque_bound is not None:
        trajectory.slowness(torque_bound)  # raises an error for invalid bounds
    return trajectory


def _motion_history(
    arm: Arm,
    objective: Objective,
    curvature: Curvature,
    duration: float,
    joints: FloatArray,
    rates: FloatArray,
    fractions: FloatArray,
    limits: bool,
) -> MotionHistory:
    at_limit = {
        joint.name: limits
        & ((joints[:, index] <= joint.lower + _LIMIT_TOLERANCE) | (joints[:, index] >= joint.upper - _LIMIT_TOLERANCE))
        for index, joint in enumerate(arm.joints)
    }
    return MotionHistory(
        np.linspace(0.0, duration, len(joints)),
        np.asarray(objective(joints)),
        curvature.smallest(joints),
        np.linalg.norm(rates, axis=1),
        fractions[:, 0],
        fractions[:, 1],
        fractions[:, 2],
        at_limit,
    )


def _read_objective(minimise: Objective | None, maximise: Objective | None) -> Objective:
    if (minimise is None) == (maximise is None):
        raise InputError("give exactly one of minimise and maximise")
    if minimise is not None:
        return minimise if minimise.better == "smaller" else minimise.reversed()
    assert maximise is not None
    return maximise if maximise.better == "larger" else maximise.reversed()


def _find_start(
    arm: Arm,
    objective: Objective,
    task: Task,
    first_pose: FloatArray,
    q: ArrayLike | None,
    seed: int,
    clearance: Clearance | None,
    margin: float,
) -> FloatArray:
    """Return the start configuration: the given one, or the best configuration of the first pose."""
    if q is None:
        optimum = optimise(arm, first_pose, objective, seed=seed, task=task, clearance=clearance, margin=margin)
        if not optimum.success and clearance is not None:
            optimum.require_ok()
        if not optimum.success:
            raise HoldfastError(
                f"no configuration of '{arm.name}' was found for the first pose of the path, within its joint limits: move the "
                "path, prescribe fewer rows, or widen the limits"
            )
        return optimum.q
    start = arm.check_configurations(q)
    if start.ndim != 1 or not np.isfinite(start).all():
        raise InputError(f"the start q of '{arm.name}' must be one configuration of {arm.n} finite numbers")
    engine = solver(arm, task)
    position_error, rotation_error = (
        float(error[0]) for error in engine.position_and_rotation_errors(start[None], first_pose[None])
    )
    if not engine.check_solutions(start[None], first_pose[None], 1e-3)[0]:
        raise InputError(
            f"the start q is {position_error:.3g} m and {rotation_error:.3g} rad from the first pose of the path, or outside "
            "the joint limits; leave it out to have one found"
        )
    if clearance is not None and float(clearance.margin_left(start)) < margin:
        raise InputError(f"at the start q the arm {clearance.too_close(margin, start)}; leave it out to have one found")
    return start


def _choose_gain(method: str, curvature: Curvature, poses: FloatArray, step: float, seed: int) -> float:
    """Choose a gain with which the self-motion settles in a few steps, without overshooting."""
    rate = 1 / (_SETTLING_STEPS * step)
    if method != "gradient-projection":
        return rate
    probed_poses = poses[np.linspace(0, len(poses) - 1, _GAIN_PROBES).astype(int)]
    solutions = solve_ik(curvature.objective.arm, probed_poses, seed, task=curvature.task, restarts=20)
    configurations = solutions.q[solutions.success]
    if not len(configurations):
        return 0.0
    matrices = curvature(configurations)[1]
    curvatures = np.abs(np.linalg.eigvalsh(matrices[np.isfinite(matrices).all(axis=(1, 2))])).max(axis=1, initial=0.0)
    typical = float(np.quantile(curvatures, 0.9)) if curvatures.size else 0.0
    return rate / typical if typical > 0 else 0.0


def _find_best_motion(
    arm: Arm,
    objective: Objective,
    task: Task,
    poses: FloatArray,
    time: FloatArray,
    rate_cap: float | None,
    spacing: float,
    seed: int,
    clearance: Clearance | None,
    margin: float,
) -> tuple[FloatArray, FloatArray]:
    """Return the best value of each pose and the best continuous motion, interpolated from a coarser grid of poses.

    If a clearance is given, only collision-free configurations count.
    """
    sign = -1.0 if objective.better == "larger" else 1.0
    grid_index = np.unique(np.linspace(0, len(poses) - 1, min(len(poses), _TRACED_POSES)).astype(int))
    velocity_limits = np.array([joint.velocity for joint in arm.joints])
    if rate_cap is not None:
        velocity_limits = np.minimum(velocity_limits, rate_cap)
    # If a joint has no limit, the default of the path search defines continuity.
    rate_limit = velocity_limits * float(np.diff(time[grid_index]).max()) if np.isfinite(velocity_limits).all() else None

    def evaluate_cost(q: FloatArray) -> FloatArray:
        value = sign * np.asarray(objective(q))
        return value if clearance is None else np.where(clearance.margin_left(q) >= margin, value, np.nan)

    fibre_path = best_path(arm, poses[grid_index], evaluate_cost, task=task, spacing=spacing, rate_limit=rate_limit, seed=seed)
    values = np.interp(time, time[grid_index], sign * fibre_path.global_value)
    motion = np.stack([np.interp(time, time[grid_index], column) for column in fibre_path.q.T], axis=1)
    return values, motion
