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

_PROBABILITY_TOLERANCE = 1e-9  # of a probability: less is rounding
_MAX_FINE_CHOICES = 3  # choices of joints that are held, of which the motion is looked for on the whole grid
_FIRST_CONFIGURATIONS = 3  # configurations of the first pose that are tried
_FIRST_POSE_STARTS = 64  # random starts of the search for them
_RANK_TOLERANCE = 1e-6  # of the largest singular value
_MAX_CONE_AXES = 2  # along which the tool is held in a cone; its middle is where many arms are singular


@check_arguments
@reports_progress("looking for the motion that survives most locks")
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
    """Plan the motion along a path for which most locks, of any joint at any time, leave the rest of the path feasible.

    With one degree of redundancy every configuration of every pose is looked at (its self-motion curves, at points ``spacing``
    apart), with the question whether the path can be finished if joint i locks there. Dynamic programming then finds the
    motion over these points that survives most: the best there is, up to the grid. Of motions that are equal it takes the
    shortest, and smooths it where that costs nothing. A motion within the velocity limits comes first.

    With more redundancy the result is a lower bound: of the motions only those are looked at that hold further joints where
    they are, or the axis that is kept in a cone, and of a failed arm only the ways on that do; which joints, and where, is
    drawn and tried.

    Args:
        arm: The arm.
        path: Where the tool is to be, and when.
        rates: How often each joint locks, (n,) or by joint: relative weights. Default: all alike.
        per_second: The rates are in 1/s: an instant then counts by the probability that nothing has failed before.
        mode: ``on-path``: after a lock the tool follows its path without leaving it, at its own pace. ``detour``: it may
            leave it and come back. That only asks for the locked joint's value at every pose still to come: without obstacles
            the straight way to a configuration that has it lies within the joint limits. Among obstacles it is an upper bound.
            With more than one degree of redundancy inverse kinematics looks for these configurations.
        task: Rows of the poses to keep. Default: ``position`` for a path of positions, else ``pose``; of an arm that moves in a
            plane those in it.
        samples: Poses, evenly spaced in time.
        spacing: Of the points on the self-motion curves, rad.
        start: (n,) where the motion must begin, on the first pose. Default: anywhere.
        seed: Of the search for the curves; see :func:`holdfast.kinematics.solvers.fibres`.
        starts: Random starts of inverse kinematics per pose.
        clearance: Keep the links of the arm apart; not looked at if not given. See :func:`holdfast.follow`.
        cell: Objects around the arm, or their file, to keep clear of before the lock and after it, at every sample.
        margin: m; from an object beyond what the cell keeps from it.
        keep: What the tool keeps at every sample, before the lock and after it:
            :func:`holdfast.kinematics.tool_constraints.upright`, :func:`holdfast.kinematics.tool_constraints.rail`,
            :func:`holdfast.kinematics.tool_constraints.plane`, a label (``"upright:10deg"``), or several. Rows that the task
            prescribes are those of the path, and it is checked that they keep it. Of the others a cone limits what the arm may
            do; an axis kept exactly along a path of positions becomes two rows of the task.
        compare: Motions along the same path that the result is to be compared with: ``least-norm``, and for every index or
            susceptibility the motion by gradient projection and the best continuous one at every pose (:func:`holdfast.follow`
            with ``best``).

    Returns:
        A :class:`holdfast.response.lock_survival.LockSurvival` with the motion, its survival, the bound and the interval of the
        grid.

    Raises:
        InputError: Rates, a start or options that do not fit, a path that breaks what is kept, or a row kept exactly that the
            task leaves free.
        TaskError: No redundancy, or more than one degree of it and detours among obstacles or with something kept.
        HoldfastError: A pose without a (clear) configuration, or no continuous motion along the path.

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
        survival_interval: What the best of them survives, of those within the velocity limits, and with the spacing on top;
            NaN: none.
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
            raise InputError(f"the path itself breaks what is kept: at {violation_time:.4g} s the tool is {violation}")
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
            ):  # smoothing may have cost something
                unsmoothed = LockSurvival.for_motion(requested, q, survives=find_survived_locks(requested, q), found=bounds)
                result = max(result, unsmoothed, key=_rank_result)
            results.append(result)
        return max(results, key=_rank_result)  # of equals the first


def _search_fixed_joints(problem: SurvivalProblem, q_start: FloatArray | None) -> LockSurvival:
    """Return the best of motions that fix all joints except those that leave one degree of redundancy.

    Which joints, and where, is looked for on a coarse grid; the best few are then looked at on the grid that was asked for.
    """
    attempts = []
    for variant, q in track("configurations of the first pose", list(_list_starts(problem, q_start))):
        coarse = variant.with_coarse_grid()
        for joints in variant.fixed_joint_sets:
            if not _leaves_one_redundancy(variant, q, joints):  # no curves, and their tracing has no end
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
            f"no continuous motion along the path was found that holds {problem.redundancy - 1} joints: slow the path "
            "down, or give another start"
        )
    attempts.sort(key=lambda attempt: attempt[:2], reverse=True)
    results, last_error = [], None
    for _, _, variant, values in attempts[:_MAX_FINE_CHOICES]:
        try:
            results.append(_CurveSearch(variant.with_fixed_joints(values), q_start).find_best_motion(variant))
        except HoldfastError as error:  # the finer grid of poses holds one that the coarse one had not
            last_error = error
    if not results:
        assert last_error is not None
        raise last_error
    best = max(results, key=_rank_result)
    if not problem.conditions.left_to_arm:
        return best
    # Maybe a narrower one's.
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

    More are left where one of them could not move anyway, such as a roll joint that the tool's axis sets.
    """
    mobile = [joint for joint in range(problem.arm.n) if joint not in problem.immobile_joints and joint not in fixed_joints]
    singular_values = np.linalg.svd(compute_task_jacobian(problem.arm, problem.task, q[None])[0][:, mobile], compute_uv=False)
    return bool(singular_values[-1] > _RANK_TOLERANCE * singular_values[0])


def _project_start_to_path(problem: SurvivalProblem, start: ArrayLike) -> FloatArray:
    """Return the start (n,) brought to the first pose."""
    arm, first_pose = problem.arm, problem.lock.poses[:1]
    q = arm.check_configurations(start)
    if q.ndim != 1 or not np.isfinite(q).all():
        raise InputError(f"the start of '{arm.name}' must be one configuration of {arm.n} finite numbers")
    if not solver(arm, problem.task).check_solutions(q[None], first_pose, PATH_TOLERANCE)[0]:
        raise InputError(
            "the start is not on the first pose of the path, or outside the joint limits; leave it out to have one"
        )
    required_clearance = problem.conditions.required_clearance
    if required_clearance is not None and float(required_clearance[0].margin_left(q)) < required_clearance[1]:
        raise InputError(
            f"at the start the arm {required_clearance[0].too_close(required_clearance[1], q)}; leave it out to have one"
        )
    violation = problem.conditions.find_violation(q[None])
    if violation is not None:
        raise InputError(f"at the start the tool is {violation[1]}; leave it out to have one")
    on_pose: FloatArray = problem.lock.tracer.project_onto_poses(q[None], first_pose)[0][0]
    return on_pose
