"""The points within reach before and after any joint locks, with artificial joint limits that enlarge this region."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task
from holdfast.errors import InputError, TaskError
from holdfast.notice import Count, each, says
from holdfast.probability.intervals import Interval, check_confidence
from holdfast.reach import closed_form as tolerant_planar
from holdfast.reach import samples as tolerant_sampled
from holdfast.reach.closed_form import ThreeLinks
from holdfast.reach.suggested import box_inside
from holdfast.result import Result

if TYPE_CHECKING:
    import xarray as xr

    from holdfast.certificates.claims import TolerantClaim

Array = NDArray[np.float64]
Limits = ArrayLike | Mapping[str | int, tuple[float, float]] | Mapping[int, tuple[float, float]]

POINTS, ANGLES = 1000, 24
_GRID = 161  # points along each edge of the map of the exact region
_RADII = 1600
_SEARCH_RADII, _POLISH_RADII = 32, 160
_SEARCH_POINTS = 250  # at most, of which the limits are chosen
_GENERATIONS = 60  # of a search for limits at most


@dataclass(frozen=True, eq=False, kw_only=True)
class TolerantWorkspace(Result):
    """The failure-tolerant workspace of an arm under artificial joint limits.

    Attributes:
        arm: The arm, with its own limits.
        task: What must be met at each point.
        limits: (n, 2) artificial limits that hold until a joint locks, rad and m.
        size: Area (m^2) or volume (m^3) of the region.
        size_interval: Between which it lies: the confidence interval of the sample; for the exact region the error of the
            integral.
        healthy_size: The same for all points that the healthy arm reaches within its own limits.
        points: (N, 3) m, world: the sample, or the points of a map of the exact region.
        healthy: (N,) points that the healthy arm reaches within its own limits.
        within: (N,) those that it reaches within the artificial limits.
        survives: (N, n) those of ``within`` that it reaches wherever joint k locks within its artificial limits.
        inside: (N,) the region: ``within`` and all of ``survives``.
        exact: In closed form, for planar arms of three revolute joints that turn all the way.
        angles: Locked values per joint that were tried; 0 where the region is exact.
        optimised: The limits were looked for, not given.
        confidence: Of the interval; 1 where the region is exact.
    """

    arm: Arm
    task: Task
    limits: Array
    size: float
    size_interval: tuple[float, float]
    healthy_size: float
    points: Array
    healthy: NDArray[np.bool_]
    within: NDArray[np.bool_]
    survives: NDArray[np.bool_]
    inside: NDArray[np.bool_]
    exact: bool
    angles: int
    optimised: bool
    confidence: float

    @property
    def unit(self) -> str:
        """``m^2`` or ``m^3``."""
        return "m^2" if np.linalg.matrix_rank(self.task.rows[:, :3], tol=1e-9) == 2 else "m^3"

    @property
    def share(self) -> float:
        """Of what the healthy arm reaches; NaN if that is nothing."""
        return self.size / self.healthy_size if self.healthy_size > 0 else float("nan")

    @property
    def lost_to(self) -> Array:
        """(n,) of the points within the artificial limits, the share that some lock of each joint loses; NaN if none is."""
        size = int(self.within.sum())
        return 1 - self.survives.sum(axis=0) / size if size else np.full(self.arm.n, np.nan)

    def claim(self) -> TolerantClaim:
        """The claim that a box of points inside is failure-tolerant: :func:`holdfast.certify` proves it for every point.

        The box is a large one without a point outside; the artificial limits are its working ranges.

        Raises:
            InputError: The task is not position, nor planar in the xy plane, or too few points are inside.
        """
        from holdfast.certificates import tolerant_claim

        rows = self.task.rows
        if rows.shape[0] not in (2, 3) or not np.array_equal(rows, np.eye(6)[: len(rows)]):
            raise InputError(f"certificates of boxes are for tasks position and planar, not {self.task.name}")
        box = box_inside(self.points[:, : len(rows)], self.inside)
        if box is None:
            raise InputError("too few points are inside to suggest a box; sample more")
        ranges: dict[str | int, tuple[float, float]] = {k: (float(a), float(b)) for k, (a, b) in enumerate(self.limits)}
        return tolerant_claim(self.arm, box.mean(axis=1), box[:, 1] - box[:, 0], working_ranges=ranges)

    def describe(self) -> list[str]:
        """A few sentences for people: how large the region is, and what the locks of each joint lose."""
        low, high = self.size_interval
        how = (
            "in closed form for each radius"
            if self.exact
            else f"{len(self.points)} points, {self.angles} locked values per joint, {self.confidence:.0%} interval "
            f"{low:.3g} to {high:.3g}"
        )
        size = f"{self.size:.4g} {self.unit} of {self.healthy_size:.4g} {self.unit} ({how})"
        lines = [f"{self.arm.title}, task {self.task.name}: {size}"]
        for joint, (least, most), lost in zip(self.arm.joints, self.limits, self.lost_to, strict=True):
            factor, shown = joint.shown
            ranged = f"{factor * least:.2f} to {factor * most:.2f} {shown}"
            lines.append(f"{joint.name} within {ranged}: its locks lose {lost:.1%} of the points within the artificial limits")
        return lines

    def to_xarray(self) -> xr.Dataset:
        """What is reached at each point: over ``v`` and ``u`` (m, in the plane) of an exact region, else ``point``."""
        import xarray as xr

        count = round(np.sqrt(len(self.points)))
        shape, at = ((count, count), ["v", "u"]) if self.exact else ((len(self.points),), ["point"])
        reached = {name: (at, getattr(self, name).reshape(shape)) for name in ("healthy", "within", "inside")}
        found = xr.Dataset(
            {
                **reached,
                "survives": ([*at, "joint"], self.survives.reshape(*shape, -1)),
                "limits": (["joint", "end"], self.limits),
            },
            {
                "position": ([*at, "axis"], self.points.reshape(*shape, 3), {"units": "m"}),
                "joint": list(self.arm.joint_names),
                "end": ["lower", "upper"],
                "axis": list("xyz"),
            },
            {"arm": self.arm.name, "task": self.task.name, "size": self.size, "unit": self.unit, "exact": int(self.exact)},
        )
        if self.exact:
            plane = (self.points @ self.task.rows[:, :3].T).reshape(count, count, 2)
            found = found.assign_coords(u=("u", plane[0, :, 0], {"units": "m"}), v=("v", plane[:, 0, 1], {"units": "m"}))
        return found


@checked
@says("measuring the failure-tolerant workspace")
def tolerant_workspace(
    arm: Arm,
    task: str | Task | Sequence[str] = "position",
    limits: Limits | None = None,
    *,
    optimise: bool = False,
    rotation: ArrayLike | None = None,
    points: int = POINTS,
    angles: int = ANGLES,
    seed: int = 0,
    confidence: float = 0.95,
) -> TolerantWorkspace:
    """The points that the arm is guaranteed to reach before and after any single joint locks.

    Artificial joint limits hold until a joint locks. A point is in the region if the healthy arm reaches it within them and,
    for each joint and every value within its artificial limits, the arm with the joint locked there reaches it, the other
    joints within the arm's own limits. Narrow limits leave fewer values to lock at, but less to reach before.

    For planar arms of three revolute joints that turn all the way (task ``planar``) the region is known in closed form for
    each radius: with joint 2 or 3 locked the arm reaches an annulus about its foot, with joint 1 locked one about its elbow,
    and the directions that the healthy arm reaches end at twelve critical ones. For other arms points are drawn in a box about
    what the arm reaches and tried with inverse kinematics, each joint locked at ``angles`` equally spaced values of its
    range. Then values between those are not tried, which makes the region look larger, and configurations that inverse
    kinematics misses make it look smaller; neither is in the interval.

    Args:
        arm: The arm.
        task: What must be met at each point; with angular rows the tool has the ``rotation`` given.
        limits: (n, 2) artificial limits, rad and m, or a mapping from joints (names or indices) to pairs; the arm's own, or a
            whole turn, for joints that are not given.
        optimise: Look for the limits that make the region largest: by differential evolution and a simplex where it is
            exact, else by coordinate ascent on a sample of its own of at most 250 points. Nothing proves that they are the
            best.
        rotation: (3, 3) of the end effector, for tasks with angular rows; the identity if not given.
        points: In the sample.
        angles: Per joint; also the grid of limits that are tried.
        seed: Of all draws.
        confidence: Of the interval.

    Raises:
        InputError: Limits that are reversed or beyond those of the arm, or options out of range.
        TaskError: The arm has no redundancy for the task, or the task does not hold a point of space or of a plane.

    Source: Lewis and Maciejewski 1997; Hoover et al. 2015; Bader and Maciejewski 2020 for optimal limits of planar arms.
    """
    rows = as_task(arm, task)
    if arm.n <= rows.m:
        raise TaskError(
            f"'{arm.name}' has {arm.n} joints and the task '{rows.name}' {rows.m} rows: without redundancy no region survives "
            "a lock; choose a task with fewer rows"
        )
    check_confidence(confidence)
    if points < 1 or angles < 2:
        raise InputError(f"points is {points} and angles {angles}; give at least 1 point and 2 angles")
    turn = np.eye(3) if rotation is None else np.asarray(rotation, dtype=np.float64)
    if turn.shape != (3, 3) or not np.allclose(turn @ turn.T, np.eye(3), atol=1e-6) or np.linalg.det(turn) < 0:
        raise InputError("rotation must be a (3, 3) rotation matrix: orthonormal, with determinant +1")
    if optimise and limits is not None:
        raise InputError("give limits, or optimise=True to look for them, not both")
    three = ThreeLinks.of(arm, rows)
    if three is not None:
        found = _best_exact(arm, three, seed) if optimise else _read_limits(arm, limits)
        return _exact(arm, rows, three, found, optimise)
    space = tolerant_sampled.Space.of(arm, rows, turn)
    if optimise:
        found = tolerant_sampled.best_limits(arm, rows, space, min(points, _SEARCH_POINTS), angles, seed)
    else:
        found = _read_limits(arm, limits)
    # Limits are judged by other points than those they were chosen for.
    return _sampled(arm, rows, space, found, optimise, points, angles, seed + 1 if optimise else seed, confidence)


def _read_limits(arm: Arm, limits: Limits | None) -> Array:
    made = np.stack(finite_limits(arm), axis=1)
    if limits is None:
        return made
    if isinstance(limits, Mapping):
        for name, pair in limits.items():
            made[arm.joint_index(name)] = pair
    else:
        given = np.asarray(limits, dtype=np.float64)
        if given.shape != (arm.n, 2):
            raise InputError(f"limits have shape {given.shape}; they must be ({arm.n}, 2), lower and upper of each joint")
        made = given.copy()
    for k, (low, high) in enumerate(made):
        joint = arm.joints[k]
        if not (np.isfinite([low, high]).all() and low <= high):
            raise InputError(f"limits of joint '{joint.name}' are {low:g} to {high:g}; give finite ones, the lower first")
        if low < joint.lower - 1e-9 or high > joint.upper + 1e-9:
            raise InputError(
                f"limits of joint '{joint.name}' are {low:g} to {high:g}, beyond the arm's own, {joint.lower:g} to "
                f"{joint.upper:g} {joint.unit}"
            )
    return made


# ---- any arm -----------------------------------------------------------------------------------------------------


def _sampled(
    arm: Arm,
    task: Task,
    space: tolerant_sampled.Space,
    limits: Array,
    optimised: bool,
    points: int,
    angles: int,
    seed: int,
    confidence: float,
) -> TolerantWorkspace:
    poses = space.draw(points, seed)
    healthy = tolerant_sampled.reached(arm, task, poses, seed)
    within = healthy.copy()
    within[healthy] = tolerant_sampled.reached(tolerant_sampled.limited(arm, limits), task, poses[healthy], seed)
    values = [np.linspace(low, high, angles) for low, high in limits]
    survives = np.zeros((points, arm.n), dtype=bool)
    table = tolerant_sampled.survival(arm, task, poses[within], values, seed)
    survives[within] = np.stack([t.all(axis=1) for t in table], axis=1)
    inside = np.asarray(survives.all(axis=1))
    share = Interval.of(int(inside.sum()), points, confidence)
    return TolerantWorkspace(
        arm=arm,
        task=task,
        limits=limits,
        size=space.size * share.value,
        size_interval=(space.size * share.low, space.size * share.high),
        healthy_size=space.size * float(healthy.mean()),
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


def _exact(arm: Arm, task: Task, three: ThreeLinks, limits: Array, optimised: bool) -> TolerantWorkspace:
    links = three.link_limits(limits)
    links[:, 1] = np.minimum(links[:, 1], links[:, 0] + tolerant_planar.FULL)
    value, coarse = (float(tolerant_planar.area(three, links[None], radii)[0]) for radii in (_RADII, _RADII // 2))
    error = abs(value - coarse)
    most, least = _reach(three)
    across = np.linspace(-most, most, _GRID)
    flat = np.stack(np.meshgrid(across, across), axis=-1).reshape(-1, 2)
    radius = np.hypot(*flat.T)
    healthy = (radius <= most) & (radius >= least)
    parts = tolerant_planar.parts(three, links, flat + three.centre)
    normal = np.cross(*task.rows[:, :3])
    lift = normal * float(normal @ arm.forward_kinematics(np.zeros(arm.n))[:3, 3])
    return TolerantWorkspace(
        arm=arm,
        task=task,
        limits=limits,
        size=value,
        size_interval=(max(value - error, 0.0), value + error),
        healthy_size=float(np.pi * (most**2 - least**2)),
        points=(flat + three.centre) @ task.rows[:, :3] + lift,
        healthy=healthy,
        within=parts[0],
        survives=np.stack(parts[1:], axis=1) & parts[0][:, None],
        inside=np.asarray(np.stack(parts).all(axis=0)),
        exact=True,
        angles=0,
        optimised=optimised,
        confidence=1.0,
    )


def _reach(three: ThreeLinks) -> tuple[float, float]:
    total = float(three.lengths.sum())
    return total, max(0.0, 2 * float(three.lengths.max()) - total)


def _best_exact(arm: Arm, three: ThreeLinks, seed: int) -> Array:
    """Limits (3, 2) of the largest region; joint 1 about 0, because the region turns with it."""
    from scipy import optimize

    search: Any = optimize.differential_evolution  # its stubs know no vectorized cost
    polish: Any = optimize.minimize

    own = np.stack([arm.lower, arm.upper], axis=1)

    def limits(x: Array) -> Array:
        """(P, 3, 2) from the halves of the ranges of the joints and the middles of the last two (P, 5)."""
        half, middle = np.abs(x[:, [0, 2, 4]]), np.stack([np.zeros(len(x)), x[:, 1], x[:, 3]], axis=1)
        return np.stack([middle - half, middle + half], axis=2)

    def cost(x: Array, radii: int) -> Array:
        joints = limits(x)
        beyond = ((joints[..., 0] < own[:, 0]) | (joints[..., 1] > own[:, 1])).any(axis=1)
        links = np.array([three.link_limits(j) for j in joints])
        return np.where(beyond, 0.0, -tolerant_planar.area(three, links, radii))

    with Count("generations", _GENERATIONS, most=True) as tell:
        found = search(
            lambda x: cost(x.T, _SEARCH_RADII),
            # The mirror image of a region is as large: the middle of joint 2 may as well be positive.
            [(0, np.pi), (0, np.pi), (0, np.pi), (-np.pi, np.pi), (0, np.pi)],
            vectorized=True,
            updating="deferred",
            popsize=12,
            maxiter=_GENERATIONS,
            callback=lambda x, convergence: tell(1),
            rng=np.random.default_rng(seed),
            polish=False,
        ).x
    for _ in each("simplex searches", range(3)):  # a simplex that has shrunk onto a ridge starts again
        found = polish(
            lambda x: float(cost(x[None], _POLISH_RADII)[0]),
            found,
            method="Nelder-Mead",
            options={"xatol": 1e-5, "fatol": 1e-8, "initial_simplex": found + np.vstack([np.zeros(5), 0.05 * np.eye(5)])},
        ).x
    return np.asarray(np.clip(limits(found[None])[0], own[:, :1], own[:, 1:]))
