"""What an assessment computes: everything that defines its rows, and the rows of one block."""

from __future__ import annotations

import operator
import reprlib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.arms.serial import from_dict, to_dict
from holdfast.clearance.capsules import Capsules
from holdfast.clearance.clearance import Clearance
from holdfast.engine.store import Column, Store
from holdfast.errors import HoldfastError, InputError, StoreError
from holdfast.failures import locks_at
from holdfast.indices.index import Evaluation, Index, WorstCase, by_name
from holdfast.regions.region import Region, Sampling
from holdfast.registry import INDICES
from holdfast.solvers.inverse_kinematics import solver
from holdfast.solvers.optimum import Ascent, default_starts, objective_ascent
from holdfast.status import Status

Array = NDArray[np.float64]
Rows = dict[str, NDArray[Any]]

_POSES = 2000  # unless asked otherwise
TOLERANCE = 1e-6  # of the pose, m and rad
LOCK_RESTARTS = 20  # starts for a pose after a lock, before it counts as lost

_SURVIVES = (
    "1 if the pose can still be reached once the joint has locked where it was at another pose, 0 if not found, -1 unknown"
)
_SURVIVES_AT = (
    "1 if the pose can still be reached once the joint has locked at the angle that the plan gives, or where it was at another "
    "pose, 0 if not found, -1 unknown or not asked"
)


@dataclass(frozen=True)
class Plan:
    """A run: two runs with equal plans have equal rows.

    Attributes:
        region: Which poses, or configurations.
        index: An index; it holds the arm, the task and the failures.
        poses: Number of poses.
        seed: Of everything random.
        sampling: ``random`` or ``sobol``.
        restarts: Random starts per pose before it counts as not found.
        optimise: Also look for the best configuration of each pose.
        after_lock: Also ask for each pose and joint whether the pose can still be reached once the joint has locked.
        clearance: Of the arm from itself: looked at in every configuration, and kept by the best ones; None: not looked at.
        margin: Smallest clearance of the best configurations, m.
        lock_at: Joints, indices from 0, that lock at a given angle (rad or m) instead of one in use. They are asked for with
            or without ``after_lock``.
    """

    region: Region
    index: Index
    poses: int
    seed: int
    sampling: Sampling
    restarts: int
    optimise: bool
    after_lock: bool = False
    lock_at: tuple[tuple[int, float], ...] = ()
    clearance: Clearance | None = None
    margin: float = 0.0

    def __post_init__(self) -> None:
        for what, least in (("poses", 1), ("seed", 0), ("restarts", 1)):
            object.__setattr__(self, what, _whole(what, getattr(self, what), least))
        if self.sampling not in ("random", "sobol"):
            raise InputError(f"sampling '{self.sampling}' is not known; use 'random' or 'sobol'")
        if self.region.kind == "sampler" and self.sampling != "random":
            raise InputError(f"region '{self.region.name}' draws its poses itself; use sampling 'random'")
        if self.clearance is not None and self.clearance.arm.fingerprint != self.arm.fingerprint:
            raise InputError(
                f"the clearance belongs to '{self.clearance.arm.name}', not to '{self.arm.name}'; make it with the same arm"
            )
        if not np.isfinite(self.margin):
            raise InputError(f"margin is {self.margin:g}; it must be a finite number of metres")
        if self.region.kind == "joints":
            if len(self.region.center) != self.arm.n:
                raise InputError(
                    f"the region has {len(self.region.center)} joints, '{self.arm.name}' has {self.arm.n}; they must agree"
                )
            if self.optimise:
                raise InputError("a region of joints fixes the configurations, so there is nothing to optimise; give a box")
            if self.locks:
                raise InputError("a region of joints has no poses to reach after a lock; give a box")

    @property
    def arm(self) -> Arm:
        """The arm of the index."""
        return self.index.arm

    @property
    def locks(self) -> dict[int, float | None]:
        """What locks of its own: joints, indices from 0, with the angle, or None for one in use at another pose."""
        given = dict(self.lock_at)
        return {k: given.get(k) for k in range(self.arm.n) if self.after_lock or k in given}

    @property
    def weighted(self) -> bool:
        """True if rows have weights."""
        return self.region.weighted(self.poses)

    # ---- files -----------------------------------------------------------------------------------------------------

    def to_dict(self) -> dict[str, Any]:
        """JSON data that :meth:`from_dict` reads if the plan is storable; ``poses`` is kept by the folder."""
        index, task = self.index, self.index.task
        data: dict[str, Any] = {
            "kind": "assess",
            "arm": to_dict(self.arm),
            "fingerprint": self.arm.fingerprint,
            "region": self.region.to_dict(),
            "index": index.label,
            "task": task.to_dict(),
            "failures": [[self.arm.joint_names[k] for k in f] for f in index.failures],
            "seed": self.seed,
            "sampling": self.sampling,
            "restarts": self.restarts,
            "seeds": "poses of block b: SeedSequence(seed, spawn_key=(0, b)); starts of block b: (1, b), of its optimisation "
            f"(2, b), of its locks (3, b); {self.region.block} poses per block",
        }
        if self.optimise:
            data["optimise"] = default_starts(self.arm, task)
        if self.after_lock:
            data["after_lock"] = LOCK_RESTARTS
        if self.lock_at:
            angles = {self.arm.joint_names[k]: angle for k, angle in self.lock_at}
            data["lock_at"] = {"angles": angles, "restarts": LOCK_RESTARTS}
        if self.clearance is not None:
            data["clearance"] = {"capsules": self.clearance.capsules.to_dict(self.arm), "margin": self.margin}
        return data

    @property
    def storable(self) -> bool:
        """False for an index or a region that a folder cannot hold."""
        return INDICES.storable(self.index) and self.region.storable

    @classmethod
    def from_dict(cls, data: dict[str, Any], poses: int) -> Plan:
        """The plan that :meth:`to_dict` wrote; raises KeyError or TypeError if something is missing."""
        arm = from_dict(data["arm"])
        task = Task.from_dict(data["task"])
        index = by_name(data["index"], arm, task, [list(f) for f in data["failures"]])
        region = Region.from_dict(data["region"])
        apart = data.get("clearance")
        return cls(
            region,
            index,
            poses,
            data["seed"],
            data["sampling"],
            data["restarts"],
            "optimise" in data,
            "after_lock" in data,
            _lock_angles(arm, data["lock_at"]["angles"] if "lock_at" in data else {}),
            None if apart is None else Clearance(arm, Capsules.from_dict(apart["capsules"], arm)),
            0.0 if apart is None else apart["margin"],
        )

    @classmethod
    def stored(cls, store: Store, poses: int, rows: bool = True) -> Plan:
        """The plan of a results folder of ``poses`` poses, with a row of all columns for each of them or without ``rows``.

        Raises:
            StoreError: It is not the plan of an assessment.
        """
        try:
            plan = cls.from_dict(store.plan, poses)
        except HoldfastError as error:
            raise StoreError(f"'{store.path}' is damaged: {error}; start the run again in a new folder") from error
        except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError) as error:
            reason = f"lacks {error}" if isinstance(error, KeyError) else f"cannot be read ({reprlib.repr(str(error))})"
            raise StoreError(f"'{store.path}' is damaged: its plan {reason}; start the run again in a new folder") from error
        wanted = {c.name: c.dims for c in plan.columns()} if rows else {}
        lacking = wanted.keys() - {c.name for c in store.columns} - {"lock_angle"}  # of which older folders know nothing
        if lacking:
            raise StoreError(
                f"'{store.path}' is damaged: its column '{min(lacking)}' is lost; start the run again in a new folder"
            )
        for c in store.columns:
            if c.dims != wanted.get(c.name, c.dims):
                raise StoreError(
                    f"'{store.path}' is damaged: its column '{c.name}' does not fit its plan; run it again in a new folder"
                )
        return plan

    def columns(self) -> list[Column]:
        """What each row holds."""
        n, f, unit, about = self.arm.n, len(self.index.failures), self.index.unit, self.index.describe()
        pose = [
            Column("position", "float64", (("axis", 3),), "m", "drawn position of the tool in the world"),
            Column("quaternion", "float64", (("xyzw", 4),), "1", "drawn orientation of the tool in the world, x y z w"),
        ]
        best = [
            Column("optimised_q", "float64", (("joint", n),), "rad or m", "best configuration found; NaN where there is none"),
            Column("optimised_index", "float64", (), unit, f"{about}, at the best configuration found"),
            Column("optimised_worst", "int16", (), "1", "position of the worst failure there; -1 if there is none"),
            Column("agreeing", "float64", (), "1", "share of the starts followed to the end that reached the best value"),
        ]
        apart = [
            Column("clearance", "float64", (), "m", "smallest distance between links; below 0: the arm runs through itself")
        ]
        if self.optimise:
            apart += [
                Column(
                    "optimised_status", "uint8", (), "1", "as status; 4: every configuration found runs the arm through itself"
                ),
                Column(
                    "blocked",
                    "int8",
                    (),
                    "1",
                    "1 if the best configuration without regard to itself runs the arm through itself",
                ),
            ]
        survives = _SURVIVES_AT if self.lock_at else _SURVIVES
        angle = Column("lock_angle", "float64", (("lock", n),), "rad or m", "where each joint locked; NaN where none did")
        return [
            *(pose if self.region.kind != "joints" else []),
            *([Column("weight", "float64", (), "1", "how much the pose counts")] if self.weighted else []),
            Column("q", "float64", (("joint", n),), "rad or m", "configuration; NaN where none was found"),
            Column("status", "uint8", (), "1", "0 ok, 1 not found, 3 singular, 255 not computed yet"),
            Column("index", "float64", (), unit, about),
            Column("by_failure", "float64", (("failure", f),), unit, f"{self.index.name} for each failure"),
            Column("worst", "int16", (), "1", "position of the worst failure in the list of failures; -1 if there is none"),
            *(best if self.optimise else []),
            *(apart if self.clearance is not None else []),
            *([Column("survives", "int8", (("lock", n),), "1", survives), angle] if self.locks else []),
        ]

    # ---- rows ------------------------------------------------------------------------------------------------------

    def compile(self) -> None:
        """Compile in this thread, once, instead of in every worker at the same time."""
        self.index.evaluate(np.zeros((1, self.arm.n)))
        if self.region.kind != "joints":
            solver(self.arm, self.index.task)
        if self.optimise:
            self._ascent()
        if self.clearance is not None:
            self.clearance(np.zeros((1, self.arm.n)))

    def _ascent(self) -> Ascent:
        return objective_ascent(self.index, None, self.clearance, self.margin)

    def evaluate(self, samples: Array, number: int) -> Rows:
        """The rows of block ``number``."""
        from scipy.spatial.transform import Rotation

        count = len(samples)
        if self.region.kind == "joints":
            result = self.index.evaluate(samples)
            direct: Rows = {
                "q": samples,
                "status": result.status,
                "index": result.value,
                "by_failure": result.by_failure,
                "worst": _worst(result),
            }
            if self.clearance is not None:
                direct["clearance"] = self.clearance(samples)
            return direct
        poses = self.region.poses(samples)
        engine = solver(self.arm, self.index.task)
        drawn = np.random.SeedSequence(self.seed, spawn_key=(1, number))
        reach = engine.solve(poses, drawn, self.restarts, engine.within(TOLERANCE))
        ok = np.flatnonzero(reach.success)
        value, by_failure = np.full(count, np.nan), np.full((count, len(self.index.failures)), np.nan)
        worst, status = np.full(count, -1, dtype=np.int16), reach.status.copy()
        if ok.size:
            result = self.index.evaluate(reach.q[ok])
            value[ok], by_failure[ok], worst[ok], status[ok] = result.value, result.by_failure, _worst(result), result.status
        rows: Rows = {
            "position": poses[:, :3, 3],
            "quaternion": Rotation.from_matrix(poses[:, :3, :3]).as_quat(),
            "q": np.where(reach.success[:, None], reach.q, np.nan),
            "status": status,
            "index": value,
            "by_failure": by_failure,
            "worst": worst,
        }
        if self.optimise:
            others = np.random.SeedSequence(self.seed, spawn_key=(2, number))
            starts = default_starts(self.arm, self.index.task)
            best = self._ascent().solve(poses, reach, others, starts, engine.within(TOLERANCE))
            best_worst = np.full(count, -1, dtype=np.int16)
            good = np.flatnonzero(best.success)
            if good.size:
                best_worst[good] = _worst(self.index.evaluate(best.q[good]))
            rows |= {
                "optimised_q": best.q,
                "optimised_index": best.value,
                "optimised_worst": best_worst,
                "agreeing": best.agreeing,
            }
            if self.clearance is not None:
                rows |= {"optimised_status": best.status, "blocked": best.blocked.astype(np.int8)}
        if self.clearance is not None:
            rows["clearance"] = self.clearance(rows["q"])
        if self.weighted:
            rows["weight"] = self.region.weights(samples)
        if self.locks:
            rows["survives"], rows["lock_angle"] = self._survival(poses, reach.q, reach.success, number)
        return rows

    def worst_cases(self, configurations: Array) -> Rows:
        """Of a region of joints, from the rows of :meth:`evaluate`, only those that are counted: no failure but the worst."""
        found = self.index.worst_case(configurations)
        return {"status": found.status, "index": found.value, "worst": _worst(found)}

    def _survival(self, poses: Array, q: Array, reached: NDArray[np.bool_], number: int) -> tuple[NDArray[np.int8], Array]:
        """For each reached pose and each joint asked for: is it still reached once the joint has locked, and where it locked.

        It locks at the angle given, or at one drawn from those in use: where it was at another reached pose of the block.
        """
        n = self.arm.n
        result, where = np.full((len(poses), n), -1, dtype=np.int8), np.full((len(poses), n), np.nan)
        rows = np.flatnonzero(reached)
        if not rows.size:
            return result, where
        seed = np.random.SeedSequence(self.seed, spawn_key=(3, number))
        draw, starts = seed.spawn(2)
        generator = np.random.default_rng(draw)
        angles = np.stack([q[rows[generator.integers(rows.size, size=rows.size)], k] for k in range(n)], axis=1)
        for k, angle in self.lock_at:
            angles[:, k] = angle
        asked = np.array(list(self.locks))
        locked = np.tile(asked, rows.size)
        engine = solver(self.arm, self.index.task)
        found = engine.reaches_locked(
            poses[np.repeat(rows, asked.size)], locked, angles[:, asked].ravel(), starts, LOCK_RESTARTS, TOLERANCE
        )
        result[np.ix_(rows, asked)] = found.reshape(-1, asked.size)
        where[np.ix_(rows, asked)] = angles[:, asked]
        return result, where


def make_plan(
    arm: Arm,
    region: Region,
    index: Index,
    poses: int | None,
    seed: int,
    sampling: Sampling,
    restarts: int,
    optimise: bool,
    after_lock: bool,
    locked: Mapping[str | int, float] | None = None,
    clearance: Clearance | bool | None = None,
    margin: float = 0.0,
) -> Plan:
    """What :func:`assess` would compute; raises what it would raise, before anything is computed."""
    if index.arm.fingerprint != arm.fingerprint:
        raise InputError(f"the index belongs to '{index.arm.name}', not to '{arm.name}'; make it with the arm you assess")
    if poses is None:
        poses = _POSES if region.listed is None else len(region.listed)
    return Plan(
        region,
        index,
        poses,
        seed,
        sampling,
        restarts,
        optimise,
        after_lock,
        _lock_angles(arm, locked or {}),
        _apart(arm, clearance, optimise),
        margin,
    )


def _apart(arm: Arm, clearance: Clearance | bool | None, optimise: bool) -> Clearance | None:
    if clearance is None:
        return Clearance.by_default(arm) if optimise else None
    return Clearance(arm) if clearance is True else clearance or None


def _lock_angles(arm: Arm, locked: Mapping[Any, float]) -> tuple[tuple[int, float], ...]:
    """Where joints lock, as a plan holds it: in the order of the joints.

    Raises:
        InputError: No such joint, one given twice, or a value that is not finite or beyond the joint's limits.
    """
    found = locks_at(arm, locked, np.full(arm.n, np.nan))
    for k, value in found.items():
        name, unit, low, high = arm.joint_names[k], arm.joints[k].unit, arm.lower[k], arm.upper[k]
        if not low <= value <= high:
            raise InputError(f"joint '{name}' cannot lock at {value:g} {unit}: its limits are {low:g} to {high:g} {unit}")
    return tuple(found.items())


def _worst(result: Evaluation | WorstCase) -> NDArray[np.int16]:
    """Worst failure; none at a singular configuration, where all are equally bad."""
    worst = result.worst.astype(np.int16)
    worst[result.status != Status.OK] = -1
    return worst


def _whole(what: str, value: Any, least: int) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        number = least - 1
    if number < least:
        raise InputError(f"{what} is {value}; it must be {least} or more, and whole")
    return number
