"""Points that the arm reaches before and after any joint locks, with artificial joint limits that enlarge the region."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError, TaskError
from holdfast.core.extras import import_extra
from holdfast.core.probability.intervals import Interval, check_confidence
from holdfast.core.progress import ProgressCount, reports_progress, track
from holdfast.core.result import Result
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.kinematics.workspace import closed_form as tolerant_planar
from holdfast.kinematics.workspace import samples as tolerant_sampled
from holdfast.kinematics.workspace.closed_form import ThreeLinks
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task

if TYPE_CHECKING:
    import xarray as xr

Limits = ArrayLike | Mapping[str | int, ArrayLike] | Mapping[int, ArrayLike]

DEFAULT_POINTS = 1000
DEFAULT_ANGLES = 24
_GRID_POINTS = 161  # points along each edge of the map of the exact region
_AREA_RADII = 1600
_SEARCH_RADII = 32
_POLISH_RADII = 160
_MAX_SEARCH_POINTS = 250  # maximum number of points for the choice of limits
_MAX_GENERATIONS = 60  # maximum number of generations of a search for limits


@dataclass(frozen=True, eq=False, kw_only=True)
class TolerantWorkspace(Result):
    """Failure-tolerant workspace of an arm under artificial joint limits.

    Attributes:
        arm: Arm model with its own limits.
        task: Task that is met at each point.
        limits: (n, 2) artificial limits that apply until a joint locks, rad and m.
        size: Area (m^2) or volume (m^3) of the region.
        size_interval: Lower and upper limit of the size, in its unit: the confidence interval of the sample, or, for an
            exact region, the error of the integral.
        healthy_size: Area (m^2) or volume (m^3) of all points that the healthy arm reaches within its own limits.
        points: (N, 3) points, m, world: the sample, or the points of a map of the exact region.
        healthy: (N,) True for points that the healthy arm reaches within its own limits.
        within: (N,) True for points that it reaches within the artificial limits.
        survives: (N, n) True for points of ``within`` that it reaches for every lock of joint k within its artificial limits.
        inside: (N,) True for points of the region: ``within`` and all of ``survives``.
        exact: True if the region is in closed form, for planar arms with three revolute joints without limits.
        angles: Number of locked values per joint that were tried; 0 if the region is exact.
        optimised: True if the limits were optimised, not given.
        confidence: Confidence level of the interval, 0 to 1; 1 if the region is exact.
    """

    arm: Arm
    task: Task
    limits: FloatArray
    size: float
    size_interval: tuple[float, float]
    healthy_size: float
    points: FloatArray
    healthy: BoolArray
    within: BoolArray
    survives: BoolArray
    inside: BoolArray
    exact: bool
    angles: int
    optimised: bool
    confidence: float

    @property
    def unit(self) -> str:
        """Unit of the size, ``m^2`` or ``m^3``."""
        return "m^2" if np.linalg.matrix_rank(self.task.rows[:, :3], tol=1e-9) == 2 else "m^3"

    @property
    def share(self) -> float:
        """Fraction of the healthy arm's workspace; NaN if that workspace is empty."""
        return self.size / self.healthy_size if self.healthy_size > 0 else float("nan")

    @property
    def lost_to(self) -> FloatArray:
        """Fraction (n,) of the points within the artificial limits that some lock of each joint loses; NaN without points."""
        count = int(self.within.sum())
        return 1 - self.survives.sum(axis=0) / count if count else np.full(self.arm.n, np.nan)

    def to_xarray(self) -> xr.Dataset:
        """Return the results at each point: over ``v`` and ``u`` (m, in the plane) for an exact region, else over ``point``.

        Raises:
            HoldfastError: xarray is not installed (extra ``xarray``).
        """
        xr = import_extra("xarray", "xarray")

        count = round(np.sqrt(len(self.points)))
        shape, dimensions = ((count, count), ["v", "u"]) if self.exact else ((len(self.points),), ["point"])
        reached = {name: (dimensions, getattr(self, name).reshape(shape)) for name in ("healthy", "within", "inside")}
        dataset = xr.Dataset(
            {
                **reached,
                "survives": ([*dimensions, "joint"], self.survives.reshape(*shape, -1)),
                "limits": (["joint", "end"], self.limits),
            },
            {
                "position": ([*dimensions, "axis"], self.points.reshape(*shape, 3), {"units": "m"}),
                "joint": list(self.arm.joint_names),
                "end": ["lower", "upper"],
                "axis": list("xyz"),
            },
            {"arm": self.arm.name, "task": self.task.name, "size": self.size, "unit": self.unit, "exact": int(self.exact)},
        )
        if self.exact:
            plane = (self.points @ self.task.rows[:, :3].T).reshape(count, count, 2)
            dataset = dataset.assign_coords(u=("u", plane[0, :, 0], {"units": "m"}), v=("v", plane[:, 0, 1], {"units": "m"}))
        return dataset


@check_arguments
@reports_progress("measuring the failure-tolerant workspace")
def tolerant_workspace(
    arm: Arm,
    task: str | Task | Sequence[str] = "position",
    limits: Limits | None = None,
    *,
    optimise: bool = False,
    rotation: ArrayLike | None = None,
    points: int = DEFAULT_POINTS,
    angles: int = DEFAULT_ANGLES,
    seed: int = 0,
    confidence: float = 0.95,
) -> TolerantWorkspace:
    """Compute the points that the arm is guaranteed to reach before and after any single joint locks.

    Artificial joint limits apply until a joint locks. A point is in the region if the healthy arm reaches it within these
    limits, and if, for each joint and every value within its artificial limits, the arm with the joint locked there reaches it,
    with the other joints within the arm's own limits. Narrow limits leave fewer values for a lock, but also fewer points before
    it.

    For planar arms with three revolute joints without limits (task ``planar``) the region is known in closed form for each
    radius. With joint 2 or 3 locked the arm reaches an annulus about its foot, with joint 1 locked one about its elbow, and the
    directions that the healthy arm reaches end at twelve critical ones. For other arms, points are sampled in a box about the
    workspace and tested with inverse kinematics, with each joint locked at ``angles`` equally spaced values of its range.
    Values between those are not tested, which makes the region look larger, and configurations that inverse kinematics misses
    make it look smaller. The interval contains neither error.

    Args:
        arm: Arm model.
        task: Task to be met at each point; for angular rows the tool has the given ``rotation``.
        limits: (n, 2) artificial limits, rad and m, or a mapping from joints (names or indices) to pairs. Default: the arm's
            own limits, or a whole turn.
        optimise: Choose limits that make the region large: by differential evolution and a simplex if it is exact, else by
            coordinate ascent on a separate sample of at most 250 points. The result is not proved to be the best.
        rotation: (3, 3) orientation of the end effector, for tasks with angular rows; default: the identity.
        points: Number of points in the sample.
        angles: Number of locked values per joint, and of grid values for the search of limits.
        seed: Seed of all samples.
        confidence: Confidence level of the interval, 0 to 1.

    Raises:
        InputError: Limits are reversed or beyond those of the arm, or an option is out of range.
        TaskError: The arm has no redundancy for the task, or the task does not prescribe a point in space or in a plane.

    Source: Lewis and Maciejewski 1997; Hoover et al. 2015; Bader and Maciejewski 2020 for optimal limits of planar arms.
    """
    resolved_task = as_task(arm, task)
    if arm.n <= resolved_task.m:
        raise TaskError(
            f"'{arm.name}' has {arm.n} joints and the task '{resolved_task.name}' {resolved_task.m} rows: without redundancy "
            "no region survives a lock; choose a task with fewer rows"
        )
    check_confidence(confidence)
    if points < 1 or angles < 2:
        raise InputError(f"points is {points} and angles {angles}; give at least 1 point and 2 angles")
    orientation = np.eye(3) if rotation is None else np.asarray(rotation, dtype=np.float64)
    if (
        orientation.shape != (3, 3)
        or not np.allclose(orientation @ orientation.T, np.eye(3), atol=1e-6)
        or np.linalg.det(orientation) < 0
    ):
        raise InputError("rotation must be a (3, 3) rotation matrix: orthonormal, with determinant +1")
    if optimise and limits is not None:
        raise InputError("give limits, or optimise=True to look for them, not both")
    planar_arm = ThreeLinks.from_task(arm, resolved_task)
    if planar_arm is not None:
        chosen_limits = _find_best_limits(arm, planar_arm, seed) if optimise else _read_limits(arm, limits)
        return _exact_workspace(arm, resolved_task, planar_arm, chosen_limits, optimise)
    sampling_box = tolerant_sampled.SamplingBox.from_arm(arm, resolved_task, orientation)
    if optimise:
        chosen_limits = tolerant_sampled.find_best_limits(
            arm, resolved_task, sampling_box, min(points, _MAX_SEARCH_POINTS), angles, seed
        )
    else:
        chosen_limits = _read_limits(arm, limits)
    # The limits are evaluated on other points than those from which they were chosen.
    return _sampled_workspace(
        arm, resolved_task, sampling_box, chosen_limits, optimise, points, angles, seed + 1 if optimise else seed, confidence
    )


def _read_limits(arm: Arm, limits: Limits | None) -> FloatArray:
    ranges = np.stack(sampling_limits(arm), axis=1)
    if limits is None:
        return ranges
    if isinstance(limits, Mapping):
        for name, pair in limits.items():
            values = require_real_numbers(pair, f"limits of joint {name}", "two numbers, lower and upper")
            if values.shape != (2,):
                raise InputError(f"limits of joint {name} have shape {values.shape}; give two numbers, lower and upper")
            ranges[arm.joint_index(name)] = values
    else:
        array = np.asarray(limits, dtype=np.float64)
        if array.shape != (arm.n, 2):
            raise InputError(f"limits have shape {array.shape}; they must be ({arm.n}, 2), lower and upper of each joint")
        ranges = array.copy()
    for index, (lower, upper) in enumerate(ranges):
        joint = arm.joints[index]
        if not (np.isfinite([lower, upper]).all() and lower <= upper):
            raise InputError(f"limits of joint '{joint.name}' are {lower:g} to {upper:g}; give finite ones, the lower first")
        if lower < joint.lower - 1e-9 or upper > joint.upper + 1e-9:
            raise InputError(
                f"limits of joint '{joint.name}' are {lower:g} to {upper:g}, beyond the arm's own, {joint.lower:g} to "
                f"{joint.upper:g} {joint.unit}"
            )
    return ranges


# ---- any arm -----------------------------------------------------------------------------------------------------


def _sampled_workspace(
    arm: Arm,
    task: Task,
    sampling_box: tolerant_sampled.SamplingBox,
    limits: FloatArray,
    optimised: bool,
    points: int,
    angles: int,
    seed: int,
    confidence: float,
) -> TolerantWorkspace:
    poses = sampling_box.sample_poses(points, seed)
    healthy = tolerant_sampled.find_reached_poses(arm, task, poses, seed)
    within = healthy.copy()
    within[healthy] = tolerant_sampled.find_reached_poses(
        tolerant_sampled.with_artificial_limits(arm, limits), task, poses[healthy], seed
    )
    values = [np.linspace(lower, upper, angles) for lower, upper in limits]
    survives = np.zeros((points, arm.n), dtype=bool)
    survival_tables = tolerant_sampled.check_survival(arm, task, poses[within], values, seed)
    survives[within] = np.stack([table.all(axis=1) for table in survival_tables], axis=1)
    inside = np.asarray(survives.all(axis=1))
    fraction = Interval.from_counts(int(inside.sum()), points, confidence)
    return TolerantWorkspace(
        arm=arm,
        task=task,
        limits=limits,
        size=sampling_box.size * fraction.value,
        size_interval=(sampling_box.size * fraction.low, sampling_box.size * fraction.high),
        healthy_size=sampling_box.size * float(healthy.mean()),
        points=poses[:, :3, 3],
        healthy=healthy,
        within=within,
        survives=survives,
        inside=inside,
        exact=False,
        angles=angles,
        optimised=optimised,
        confidence=confidence,
    )


# ---- three links in a plane --------------------------------------------------------------------------------------


def _exact_workspace(arm: Arm, task: Task, planar_arm: ThreeLinks, limits: FloatArray, optimised: bool) -> TolerantWorkspace:
    links = planar_arm.link_limits(limits)
    links[:, 1] = np.minimum(links[:, 1], links[:, 0] + tolerant_planar.FULL_TURN_RAD)
    area, coarse = (
        float(tolerant_planar.workspace_area(planar_arm, links[None], radii)[0]) for radii in (_AREA_RADII, _AREA_RADII // 2)
    )
    error = abs(area - coarse)
    outer_radius = float(planar_arm.lengths.sum())
    inner_radius = max(0.0, 2 * float(planar_arm.lengths.max()) - outer_radius)
    coordinates = np.linspace(-outer_radius, outer_radius, _GRID_POINTS)
    plane_points = np.stack(np.meshgrid(coordinates, coordinates), axis=-1).reshape(-1, 2)
    radius = np.hypot(*plane_points.T)
    healthy = (radius <= outer_radius) & (radius >= inner_radius)
    flags = tolerant_planar.classify_points(planar_arm, links, plane_points + planar_arm.center)
    normal = np.cross(*task.rows[:, :3])
    plane_offset = normal * float(normal @ arm.forward_kinematics(np.zeros(arm.n))[:3, 3])
    return TolerantWorkspace(
        arm=arm,
        task=task,
        limits=limits,
        size=area,
        size_interval=(max(area - error, 0.0), area + error),
        healthy_size=float(np.pi * (outer_radius**2 - inner_radius**2)),
        points=(plane_points + planar_arm.center) @ task.rows[:, :3] + plane_offset,
        healthy=healthy,
        within=flags[0],
        survives=np.stack(flags[1:], axis=1) & flags[0][:, None],
        inside=np.asarray(np.stack(flags).all(axis=0)),
        exact=True,
        angles=0,
        optimised=optimised,
        confidence=1.0,
    )


def _find_best_limits(arm: Arm, planar_arm: ThreeLinks, seed: int) -> FloatArray:
    """Find limits (3, 2) of the largest region; joint 1 is centered at 0, because the region rotates with it."""
    from scipy import optimize

    search: Any = optimize.differential_evolution  # its stubs lack the vectorized cost
    polish: Any = optimize.minimize

    arm_limits = np.stack([arm.lower, arm.upper], axis=1)

    def decode_limits(x: FloatArray) -> FloatArray:
        """Return limits (P, 3, 2) from half the ranges of the joints and the middles of the last two (P, 5)."""
        half_range, middle = np.abs(x[:, [0, 2, 4]]), np.stack([np.zeros(len(x)), x[:, 1], x[:, 3]], axis=1)
        return np.stack([middle - half_range, middle + half_range], axis=2)

    def negative_area(x: FloatArray, radii: int) -> FloatArray:
        joints = decode_limits(x)
        beyond = ((joints[..., 0] < arm_limits[:, 0]) | (joints[..., 1] > arm_limits[:, 1])).any(axis=1)
        links = np.array([planar_arm.link_limits(joint_limits) for joint_limits in joints])
        return np.where(beyond, 0.0, -tolerant_planar.workspace_area(planar_arm, links, radii))

    with ProgressCount("generations", _MAX_GENERATIONS, most=True) as advance:
        best = search(
            lambda x: negative_area(x.T, _SEARCH_RADII),
            # The mirror image of a region has the same size, so the middle of joint 2 may be positive.
            [(0, np.pi), (0, np.pi), (0, np.pi), (-np.pi, np.pi), (0, np.pi)],
            vectorized=True,
            updating="deferred",
            popsize=12,
            maxiter=_MAX_GENERATIONS,
            callback=lambda x, convergence: advance(1),
            rng=np.random.default_rng(seed),
            polish=False,
        ).x
    for _ in track("simplex searches", range(3)):  # a simplex that has shrunk onto a ridge starts again
        best = polish(
            lambda x: float(negative_area(x[None], _POLISH_RADII)[0]),
            best,
            method="Nelder-Mead",
            options={"xatol": 1e-5, "fatol": 1e-8, "initial_simplex": best + np.vstack([np.zeros(5), 0.05 * np.eye(5)])},
        ).x
    return np.asarray(np.clip(decode_limits(best[None])[0], arm_limits[:, :1], arm_limits[:, 1:]))
