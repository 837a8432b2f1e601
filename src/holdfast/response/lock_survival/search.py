"""Search for the motion along a path that survives the most single locks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.progress import reports_progress, track
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.indices.objective import Objective
from holdfast.kinematics.paths.timed_path import TimedPath
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.solvers.best_paths import BestPathTable
from holdfast.kinematics.solvers.inverse_kinematics import solver
from holdfast.kinematics.solvers.self_motions import TRACING_STARTS
from holdfast.kinematics.tool_constraints.labels import KeepLike
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike
from holdfast.response.lock_survival import tables
from holdfast.response.lock_survival.conditions import compute_task_jacobian
from holdfast.response.lock_survival.dynamic_program import SearchBounds, advance_tables, smooth_motion
from holdfast.response.lock_survival.given_motion import with_baselines
from holdfast.response.lock_survival.grid import CurveNodes, make_nodes
from holdfast.response.lock_survival.lock_evaluation import PATH_TOLERANCE, find_survived_locks, is_off_path
from holdfast.response.lock_survival.planning import LockSurvival
from holdfast.response.lock_survival.problem import Mode, SurvivalProblem, make_problem
from holdfast.response.lock_survival.rates import FailureRates, RatesLike

_PROBABILITY_TOLERANCE = 1e-9  # differences of probabilities below this are rounding errors
_MAX_FINE_CHOICES = 3  # choices of fixed joints for which the motion is searched on the full grid
_FIRST_CONFIGURATIONS = 3  # configurations of the first pose that are tried
_FIRST_POSE_STARTS = 64  # random starts of the search for them
_RANK_TOLERANCE = 1e-6  # of the largest singular value
_MAX_CONE_AXES = 2  # axes along which the tool is fixed in a cone; many arms are singular at its middle


@check_arguments
@reports_progress("searching for the motion that survives most locks")
def plan_motion(
    arm: Arm,
    path: TimedPath,
    *,
    rates: RatesLike | FailureRates | None = None,
    per_second: bool = False,
    mode: Mode = "on-path",
    task: str | Task | Sequence[str] | None = None,
    samples: int = 101,
    spacing: float = 0.05,
    start: ArrayLike | None = None,
    seed: int = 0,
    starts: int = TRACING_STARTS,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    margin: float = 0.0,
    keep: KeepLike | None = None,
    compare: Sequence[Objective | str] = (),
) -> LockSurvival:
    """Plan the motion along a path after most of whose possible locks, of any joint at any time, the arm can finish the path.

    With one degree of redundancy, all configurations of every pose are evaluated (points on the self-motion curves, ``spacing``
    apart): can the path be finished if joint i locks there? Dynamic programming then finds the motion over these points with
    the highest survival, which is the optimum up to the grid. Among equal motions the shortest is chosen, and smoothed as far
    as this costs no survival. A motion within the velocity limits is preferred.

    With more redundancy the result is a lower bound. The search considers only motions that keep further joints fixed, or the
    axis in a cone, and only such continuations of a failed arm. It samples and tries these joints and their values.

    Args:
        arm: Arm that executes the motion.
        path: Pose of the tool as a function of time.
        rates: Failure rates, (n,) or by joint name, as relative weights. Default: all equal.
        per_second: True if the rates are in 1/s. A time is then weighted by the probability of no earlier failure.
        mode: ``on-path``: after a lock the tool follows its path without leaving it, at its own pace. ``detour``: it may leave
            the path and return. A detour only needs a configuration with the locked value at every remaining pose, because
            without obstacles the straight line to it stays within the joint limits. Among obstacles it is an upper bound.
            With more than one degree of redundancy inverse kinematics searches for these configurations.
        task: Task whose rows the tool follows. Default: ``position`` for a path of positions, else ``pose``; for planar arms
            the rows of their plane.
        samples: Number of poses, evenly spaced in time.
        spacing: Distance of the points on the self-motion curves, rad.
        start: (n,) first configuration, on the first pose, rad and m. Default: any.
        seed: Seed of the search for the curves; see :func:`holdfast.kinematics.solvers.fibres`.
        starts: Random starts of inverse kinematics per pose.
        clearance: Self-collision model of the arm; see :func:`holdfast.follow`. None: self-collisions are not checked.
        cell: Objects around the arm, or their file, to avoid before and after the lock, at every sample.
        margin: Smallest distance of the links, m; from an object, in addition to the margin that the cell states for it.
        keep: Tool constraints at every sample, before and after the lock:
            :func:`holdfast.kinematics.tool_constraints.upright`, :func:`holdfast.kinematics.tool_constraints.rail`,
            :func:`holdfast.kinematics.tool_constraints.plane`, a label (``"upright:10deg"``), or several. Rows of the task are
            set by the path, which must meet the constraint. Of the other rows, a cone limits the arm, and an exact axis along
            a path of positions becomes two rows of the task.
        compare: Other motions along the path for comparison: ``least-norm``, and for every index or susceptibility the motions
            by gradient projection and by the best continuous value at every pose (:func:`holdfast.follow` with ``best``).

    Returns:
        A :class:`holdfast.response.lock_survival.LockSurvival` with the motion, its survival, the bound and the interval of the
        grid.

    Raises:
        InputError: Rates, the start or an option are invalid, the path violates a constraint, or an exact constraint is on a
            row that the task leaves free.
        TaskError: The arm is not redundant; or it has more than one degree of redundancy, and ``detour`` is combined with
            obstacles or constraints.
        HoldfastError: A pose has no (collision-free) configuration, or there is no continuous motion along the path.

    Source: sets of values that a joint may be locked at, Lewis and Maciejewski 1997; survival over a whole path, its optimum
    and its bound are ours.
    """
    problem = make_problem(
        arm,
        path,
        rates,
        per_second,
        mode,
        task,
        samples,
        clearance,
        cell,
        margin,
        keep=keep,
        spacing=spacing,
        seed=seed,
        starts=starts,
    )
    q_start = None if start is None else _project_start_to_path(problem, start)
    if problem.redundancy == 1:
        best = _CurveSearch(problem, q_start).find_best_motion(problem)
    else:
        best = _search_fixed_joints(problem, q_start)
    return best if not compare else with_baselines(problem, best, compare, seed)


class _CurveSearch:
    """Search for motions over the self-motion curves of every pose, for one remaining degree of redundancy.

    Attributes:
        survival_interval: Largest survival of motions within the velocity limits, and with the spacing added to the limits;
            NaN: no such motion.
    """

    def __init__(self, problem: SurvivalProblem, q_start: FloatArray | None) -> None:
        self._problem, self._start_is_fixed = problem, q_start is not None
        arm, follower = problem.arm, problem.lock
        self._self_motions = problem.self_motions
        for time, self_motion in zip(problem.time, self._self_motions, strict=True):
            if not len(self_motion.q):
                reason = problem.conditions.explain_infeasible(self_motion)
                raise HoldfastError(f"the path cannot be followed at {time:.4g} s: {reason}")
        self._nodes = make_nodes(arm, self._self_motions)
        path_violation = problem.conditions.find_path_violation(np.array([pose_nodes.q[0] for pose_nodes in self._nodes]))
        if path_violation is not None:
            violation_time, violation = problem.time[path_violation[0]], path_violation[1]
            raise InputError(f"the path itself violates a constraint: at {violation_time:.4g} s the tool is {violation}")
        if q_start is not None:
            self._nodes[0] = CurveNodes.from_configuration(arm, q_start, problem.spacing)
        stays_on_path = problem.mode == "on-path"
        self._lock_tables = (
            tables.compute_path_tables(follower, self._nodes)
            if stays_on_path
            else tables.compute_detour_tables(self._nodes, self._self_motions)
        )
        weights = problem.rates.weights(problem.time)
        self._gains = [
            weight * table.survives @ problem.rates.each for weight, table in zip(weights, self._lock_tables, strict=True)
        ]
        max_steps = np.array([joint.velocity for joint in arm.joints]) * float(np.diff(problem.time).max())
        self._total_weight = float(weights.sum()) * problem.rates.total
        nearby_gains = [
            weight * lock_table.maximize_survived_rates(pose_nodes, problem.rates.each)
            for weight, lock_table, pose_nodes in zip(weights, self._lock_tables, self._nodes, strict=True)
        ]
        self._path_tables = BestPathTable(self._gains), BestPathTable(self._gains, problem.spacing)
        bound_table = BestPathTable(nearby_gains, problem.spacing)
        advance_tables(arm, self._nodes, max_steps, (*self._path_tables, bound_table))
        if bound_table.last_pose is not None:
            raise HoldfastError(
                f"no continuous motion along the path was found: it ends at {problem.time[bound_table.last_pose]:.4g} s; "
                "slow the path down, take more samples, or prescribe fewer rows"
            )
        self._bound = bound_table.best_total / self._total_weight
        within_limits, relaxed = (path_table.best_total / self._total_weight for path_table in self._path_tables)
        self.survival_interval = within_limits, relaxed

    def find_best_motion(self, requested: SurvivalProblem) -> LockSurvival:
        """Return the best motion, smoothed and evaluated for the requested problem."""
        problem, nodes, lock_tables = self._problem, self._nodes, self._lock_tables
        arm, follower = problem.arm, problem.lock
        bounds = SearchBounds(
            bound=self._bound,
            interval=self.survival_interval,
            spacing=problem.spacing,
            nodes=[entry.q for entry in nodes],
            curve=[entry.curve for entry in nodes],
            survives=[lock_table.survives for lock_table in lock_tables],
            moved=np.max(
                [np.ptp(component.q, axis=0) for self_motion in self._self_motions for component in self_motion.components],
                axis=0,
            ),
            held={
                arm.joint_names[index]: entry
                for index, entry in follower.tracer.fixed_joints.items()
                if index not in problem.immobile_joints
            },
        )
        results = []
        for path_table, expected_survival in zip(self._path_tables, self.survival_interval, strict=True):
            if path_table.last_pose is not None:
                continue
            chosen = path_table.trace_best_motion()
            q = np.array([entry.q[index] for entry, index in zip(nodes, chosen, strict=True)])
            # Unlimited revolute joints take the shorter direction from pose to pose.
            q = np.concatenate([q[:1], q[0] + np.cumsum(joint_space.joint_difference(arm, q[1:], q[:-1]), axis=0)])
            smooth = smooth_motion(
                follower.tracer, nodes, lock_tables, self._gains, chosen, q, follower.poses, start_is_fixed=self._start_is_fixed
            )
            result = LockSurvival.for_motion(requested, smooth, survives=find_survived_locks(requested, smooth), found=bounds)
            if (
                result.survival < expected_survival - _PROBABILITY_TOLERANCE or result.speed > 1 + _PROBABILITY_TOLERANCE
            ):  # smoothing may have reduced the survival
                unsmoothed = LockSurvival.for_motion(requested, q, survives=find_survived_locks(requested, q), found=bounds)
                result = max(result, unsmoothed, key=_rank_result)
            results.append(result)
        return max(results, key=_rank_result)  # the first one of equal results


def _search_fixed_joints(problem: SurvivalProblem, q_start: FloatArray | None) -> LockSurvival:
    """Return the best of motions that fix all joints except those that leave one degree of redundancy.

    The joints and their values are searched on a coarse grid; the best few are then evaluated on the requested grid.
    """
    attempts = []
    for variant, q in track("configurations of the first pose", list(_list_starts(problem, q_start))):
        coarse = variant.with_coarse_grid()
        for joints in variant.fixed_joint_sets:
            if not _leaves_one_redundancy(variant, q, joints):  # more redundancy has no curves, and tracing would not end
                continue
            values = {joint: float(q[joint]) for joint in joints}
            try:
                survival, relaxed_survival = _CurveSearch(coarse.with_fixed_joints(values), q_start).survival_interval
            except InputError:
                raise
            except HoldfastError:
                continue
            attempts.append((not np.isnan(survival), relaxed_survival if np.isnan(survival) else survival, variant, values))
    if not attempts:
        raise HoldfastError(
            f"no continuous motion along the path was found that keeps {problem.redundancy - 1} joints fixed; slow the "
            "path down, or give another start"
        )
    attempts.sort(key=lambda attempt: attempt[:2], reverse=True)
    results, last_error = [], None
    for _, _, variant, values in attempts[:_MAX_FINE_CHOICES]:
        try:
            results.append(_CurveSearch(variant.with_fixed_joints(values), q_start).find_best_motion(variant))
        except HoldfastError as error:  # the finer grid has a pose without a solution, which the coarse grid lacks
            last_error = error
    if not results:
        assert last_error is not None
        raise last_error
    best = max(results, key=_rank_result)
    if not problem.conditions.left_to_arm:
        return best
    # The result may be one of a problem with a fixed axis.
    return LockSurvival.for_motion(problem, best.q, survives=find_survived_locks(problem, best.q), found=best.found)


def _list_starts(problem: SurvivalProblem, q_start: FloatArray | None) -> Iterator[tuple[SurvivalProblem, FloatArray]]:
    """Yield the problem, and narrower ones with a cone's axis fixed, each with the first q (n,) of its motions."""
    if q_start is not None:
        narrower = problem.with_axis_at(q_start)
        yield from ((variant, q_start) for variant in (problem, narrower) if variant is not None)
        return
    first_configurations = _find_first_configurations(problem)
    yield from ((problem, q) for q in first_configurations)
    for narrower in map(problem.with_axis_at, first_configurations[:_MAX_CONE_AXES]):
        if narrower is not None:
            yield from ((narrower, q) for q in _find_first_configurations(narrower))


def _rank_result(result: LockSurvival) -> tuple[bool, float]:
    """Return the sort key of a result: feasible joint speeds first, then survival."""
    return result.speed <= 1 + _PROBABILITY_TOLERANCE, round(result.survival, 9)


def _find_first_configurations(problem: SurvivalProblem) -> FloatArray:
    """Return a few configurations (K, n) of the first pose, far apart."""
    q = problem.lock.tracer.find_seeds(problem.lock.poses[:1], np.zeros(1, dtype=np.intp), problem.seed, _FIRST_POSE_STARTS)[1]
    q = problem.conditions.project_configurations(q, np.broadcast_to(problem.lock.poses[0], (len(q), 4, 4)))
    q = q[~is_off_path(problem, q, problem.lock.poses[:1]) & problem.conditions.are_met(q)]
    chosen = [0] * bool(len(q))
    while 0 < len(chosen) < min(_FIRST_CONFIGURATIONS, len(q)):
        distances = np.min([np.linalg.norm(joint_space.joint_difference(problem.arm, q, q[k]), axis=1) for k in chosen], axis=0)
        chosen.append(int(distances.argmax()))
    return np.asarray(q[chosen])


def _leaves_one_redundancy(problem: SurvivalProblem, q: FloatArray, fixed_joints: Sequence[int]) -> bool:
    """Return True if one degree of redundancy remains at q (n,) if other joints are fixed there.

    More remain if one of these joints could not move anyway, such as a roll joint that the tool axis determines.
    """
    mobile = [joint for joint in range(problem.arm.n) if joint not in problem.immobile_joints and joint not in fixed_joints]
    singular_values = np.linalg.svd(compute_task_jacobian(problem.arm, problem.task, q[None])[0][:, mobile], compute_uv=False)
    return bool(singular_values[-1] > _RANK_TOLERANCE * singular_values[0])


def _project_start_to_path(problem: SurvivalProblem, start: ArrayLike) -> FloatArray:
    """Return the start (n,) projected to the first pose."""
    arm, first_pose = problem.arm, problem.lock.poses[:1]
    q = arm.check_configurations(start)
    if q.ndim != 1 or not np.isfinite(q).all():
        raise InputError(f"the start of '{arm.name}' must be one configuration of {arm.n} finite numbers")
    if not solver(arm, problem.task).check_solutions(q[None], first_pose, PATH_TOLERANCE)[0]:
        raise InputError(
            "the start is not on the first pose of the path, or outside the joint limits; leave it out for an automatic start"
        )
    required_clearance = problem.conditions.required_clearance
    if required_clearance is not None and float(required_clearance[0].margin_left(q)) < required_clearance[1]:
        raise InputError(
            f"at the start the arm {required_clearance[0].too_close(required_clearance[1], q)}; choose another start or none"
        )
    violation = problem.conditions.find_violation(q[None])
    if violation is not None:
        raise InputError(f"at the start the tool is {violation[1]}; choose another start or none")
    on_pose: FloatArray = problem.lock.tracer.project_onto_poses(q[None], first_pose)[0][0]
    return on_pose
