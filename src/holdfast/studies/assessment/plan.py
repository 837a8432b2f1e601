"""Plan of an assessment, which defines its rows."""

from __future__ import annotations

import operator
import reprlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.errors import HoldfastError, InputError, StoreError
from holdfast.core.registry import INDEX_REGISTRY
from holdfast.core.sweeps.samples import Column
from holdfast.core.sweeps.store import Store
from holdfast.kinematics.indices.index import Index, by_name
from holdfast.kinematics.indices.own_file import check_function_digest, plan_entries
from holdfast.kinematics.regions.region import Region, Sampling
from holdfast.kinematics.solvers.optimum import default_starts
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task
from holdfast.model.arms.serial import from_dict, to_dict
from holdfast.model.cell.cell import Cell
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance, decode_clearance, encode_clearance
from holdfast.model.failure_modes import locks_at

_DEFAULT_POSES = 2000
_CHUNK_BLOCKS = 8
LOCK_RESTARTS = 20  # starts after which a pose counts as lost after a lock
# Starts and steps of the search for collision-free configurations; every tenth start takes as long as two others.
CLEAR_RESTARTS = 30
CLEAR_STEPS = 20

_SURVIVES_TEXT = (
    "1 if the pose can still be reached once the joint has locked where it was at another pose, 0 if not found, -1 unknown"
)
_SURVIVES_AT_TEXT = (
    "1 if the pose can still be reached once the joint has locked at the angle that the plan gives, or where it was at another "
    "pose, 0 if not found, -1 unknown or not asked"
)
_AGREEING_TEXT = "share of the starts followed to the end that reached the best value"
_CLEARANCE_TEXT = "smallest distance between links; below 0: the arm runs through itself"
_OPTIMISED_STATUS_TEXT = "as status; 4: every configuration found runs the arm through itself"
_BLOCKED_TEXT = "1 if the best configuration without regard to itself runs the arm through itself"
_FROM_EACH_TEXT = "smallest distance of the arm from {}; from objects a lower bound"
_CLEAR_TEXT = "1 if a configuration of the pose was found that is clear of all of these, 0 if not, -1 unknown"
_BLOCKED_BY_TEXT = "position in {} of what is nearest at the best configuration without regard to it; -1 if that is clear"


@dataclass(frozen=True)
class AssessmentPlan:
    """Plan of a run; two runs with equal plans have equal rows.

    Attributes:
        region: Region of the poses, or of the configurations.
        index: Index to evaluate, with the arm, the task and the failures.
        poses: Number of poses.
        seed: Seed of all random numbers.
        sampling: ``random`` or ``sobol``.
        restarts: Number of random starts after which a pose counts as not found.
        optimise: True to search also for the best configuration of each pose.
        after_lock: True to test for each pose and joint whether the pose can still be reached after the joint has locked.
        clearance: Collision model of the arm and its cell, with which every configuration is checked; the best ones are
            collision-free. None: no check.
        margin: Smallest clearance of the best configurations, m; for an object, in addition to the margin of the cell.
        lock_at: Indices from 0 of joints that lock at a given value, and this value, rad or m, with or without ``after_lock``.
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
        for option, minimum in (("poses", 1), ("seed", 0), ("restarts", 1)):
            object.__setattr__(self, option, _require_whole(option, getattr(self, option), minimum))
        if self.sampling not in ("random", "sobol"):
            raise InputError(f"sampling '{self.sampling}' is not known; use 'random' or 'sobol'")
        if self.region.kind == "sampler" and self.sampling != "random":
            raise InputError(f"sampling is '{self.sampling}'; for region '{self.region.name}' it must be 'random'")
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
        """Arm of the index."""
        return self.index.arm

    @property
    def locks(self) -> dict[int, float | None]:
        """Locked value of each joint that locks individually, by index from 0; None for a value used at another pose."""
        requested = dict(self.lock_at)
        return {joint: requested.get(joint) for joint in range(self.arm.n) if self.after_lock or joint in requested}

    @property
    def cell(self) -> Cell | None:
        """Objects around the arm."""
        return None if self.clearance is None else self.clearance.cell

    @property
    def collision_partners(self) -> list[str]:
        """Possible collision partners of the arm in a cell: the arm itself, if that is checked, and each object."""
        if self.clearance is None or self.cell is None:
            return []
        return ["itself"] * bool(self.clearance.pairs) + [solid.name for solid in self.cell]

    @property
    def has_weights(self) -> bool:
        """True if rows have weights."""
        return self.region.has_weights(self.poses)

    # ---- files -----------------------------------------------------------------------------------------------------

    def to_dict(self) -> dict[str, Any]:
        """Return JSON data that :meth:`from_dict` reads if the plan is storable; the folder stores ``poses``."""
        index, task = self.index, self.index.task
        data: dict[str, Any] = {
            "kind": "assess",
            "arm": to_dict(self.arm),
            "fingerprint": self.arm.fingerprint,
            "region": self.region.to_dict(),
            **plan_entries(index),
            "task": task.to_dict(),
            "failures": [[self.arm.joint_names[joint] for joint in failed] for failed in index.failures],
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
            angles = {self.arm.joint_names[joint]: angle for joint, angle in self.lock_at}
            data["lock_at"] = {"angles": angles, "restarts": LOCK_RESTARTS}
        return data if self.clearance is None else data | encode_clearance(self.clearance, self.margin)

    @property
    def is_storable(self) -> bool:
        """False for an index or a region that cannot be stored in a folder."""
        return INDEX_REGISTRY.is_storable(self.index) and self.region.storable

    def create_store(self, path: Path) -> Store:
        """Create a results folder for the rows of the plan, or open that of a stopped run.

        Raises:
            InputError: The plan is not storable.
            StoreError: The folder contains other files, or cannot be written.
        """
        reason = None
        if not self.region.storable:
            reason = f"region '{self.region.name}' has a custom function"
        elif not self.is_storable:
            reason = f"index '{self.index.name}' is a custom function outside a file"
        if reason is not None:
            raise InputError(f"{reason}, which cannot be stored in a folder; assess without a store")
        return Store.create(path, self.to_dict(), self.columns(), rows=self.poses, chunk=_CHUNK_BLOCKS * self.region.block)

    @classmethod
    def from_dict(cls, data: dict[str, Any], poses: int) -> AssessmentPlan:
        """Return the plan that :meth:`to_dict` wrote; raise KeyError or TypeError if something is missing."""
        arm = from_dict(data["arm"])
        if data["fingerprint"] != arm.fingerprint:
            raise InputError("its fingerprint is not that of its arm, so its rows may be those of another arm")
        task = Task.from_dict(data["task"])
        index = by_name(data["index"], arm, task, failures=[list(failed) for failed in data["failures"]])
        check_function_digest(index, data)
        region = Region.from_dict(data["region"])
        clearance_entry = data.get("clearance")
        return cls(
            region,
            index,
            poses,
            data["seed"],
            data["sampling"],
            data["restarts"],
            "optimise" in data,
            "after_lock" in data,
            _read_lock_angles(arm, data["lock_at"]["angles"] if "lock_at" in data else {}),
            decode_clearance(arm, data),
            0.0 if clearance_entry is None else clearance_entry["margin"],
        )

    @classmethod
    def from_store(cls, store: Store, poses: int, rows: bool = True) -> AssessmentPlan:
        """Return the plan of a results folder with ``poses`` poses and, if ``rows``, check that it contains all columns.

        Raises:
            StoreError: The folder does not contain the plan of an assessment, or is damaged.
        """
        try:
            plan = cls.from_dict(store.plan, poses)
        except StoreError as error:
            raise StoreError(f"'{store.path}' cannot be read: {error}") from error
        except HoldfastError as error:
            raise StoreError(f"'{store.path}' is damaged: {error}; start the run again in a new folder") from error
        except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError) as error:
            reason = f"lacks {error}" if isinstance(error, KeyError) else f"cannot be read ({reprlib.repr(str(error))})"
            raise StoreError(f"'{store.path}' is damaged: its plan {reason}; start the run again in a new folder") from error
        expected = {column.name: column.dims for column in plan.columns()} if rows else {}
        lacking = expected.keys() - {column.name for column in store.columns}
        if lacking:
            raise StoreError(
                f"'{store.path}' is damaged: its column '{min(lacking)}' is lost; start the run again in a new folder"
            )
        for column in store.columns:
            if column.dims != expected.get(column.name, column.dims):
                raise StoreError(
                    f"'{store.path}' is damaged: its column '{column.name}' does not fit its plan; run it again in a new folder"
                )
        return plan

    def columns(self) -> list[Column]:
        """Return the columns of each row."""
        n, unit, index_text = self.arm.n, self.index.unit, self.index.describe()
        has_poses, failures, partner_names = self.region.kind != "joints", len(self.index.failures), self.collision_partners
        joint, lock, axis, xyzw = ("joint", n), ("lock", n), ("axis", 3), ("xyzw", 4)
        other, partners = ("other", len(partner_names)), ", ".join(partner_names)
        in_clearance, in_cell = self.clearance is not None, self.cell is not None
        survives_text = _SURVIVES_AT_TEXT if self.lock_at else _SURVIVES_TEXT
        table: list[tuple[bool, str, str, tuple[tuple[str, int], ...], str, str]] = [
            (has_poses, "position", "float64", (axis,), "m", "drawn position of the tool in the world"),
            (has_poses, "quaternion", "float64", (xyzw,), "1", "drawn orientation of the tool in the world, x y z w"),
            (self.has_weights, "weight", "float64", (), "1", "how much the pose counts"),
            (True, "q", "float64", (joint,), "rad or m", "configuration; NaN where none was found"),
            (True, "status", "uint8", (), "1", "0 ok, 1 not found, 3 singular, 255 not computed yet"),
            (True, "index", "float64", (), unit, index_text),
            (True, "by_failure", "float64", (("failure", failures),), unit, f"{self.index.name} for each failure"),
            (True, "worst", "int16", (), "1", "position of the worst failure in the list of failures; -1 if there is none"),
            (
                self.optimise,
                "optimised_q",
                "float64",
                (joint,),
                "rad or m",
                "best configuration found; NaN where there is none",
            ),
            (self.optimise, "optimised_index", "float64", (), unit, f"{index_text}, at the best configuration found"),
            (self.optimise, "optimised_worst", "int16", (), "1", "position of the worst failure there; -1 if there is none"),
            (self.optimise, "agreeing", "float64", (), "1", _AGREEING_TEXT),
            (in_clearance, "clearance", "float64", (), "m", _CLEARANCE_TEXT),
            (in_clearance and self.optimise, "optimised_status", "uint8", (), "1", _OPTIMISED_STATUS_TEXT),
            (in_clearance and self.optimise, "blocked", "int8", (), "1", _BLOCKED_TEXT),
            (in_cell, "from_each", "float64", (other,), "m", _FROM_EACH_TEXT.format(partners)),
            (in_cell and has_poses, "clear", "int8", (), "1", _CLEAR_TEXT),
            (in_cell and self.optimise, "blocked_by", "int16", (), "1", _BLOCKED_BY_TEXT.format(partners)),
            (bool(self.locks), "survives", "int8", (lock,), "1", survives_text),
            (bool(self.locks), "lock_angle", "float64", (lock,), "rad or m", "where each joint locked; NaN where none did"),
        ]
        return [Column(name, kind, dims, units=unit, about=about) for kept, name, kind, dims, unit, about in table if kept]


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
    cell: CellLike | None = None,
) -> AssessmentPlan:
    """Return the plan of :func:`assess`, or raise the errors that :func:`assess` raises before it computes anything."""
    if index.arm.fingerprint != arm.fingerprint:
        raise InputError(f"the index belongs to '{index.arm.name}', not to '{arm.name}'; make it with the arm you assess")
    if poses is None:
        poses = _DEFAULT_POSES if region.listed is None else len(region.listed)
    return AssessmentPlan(
        region,
        index,
        poses,
        seed,
        sampling,
        restarts,
        optimise,
        after_lock,
        _read_lock_angles(arm, locked or {}),
        chosen_clearance(arm, clearance, cell, looks=optimise),
        margin,
    )


def _read_lock_angles(arm: Arm, locked: Mapping[Any, float]) -> tuple[tuple[int, float], ...]:
    """Return the locked values of joints as a plan stores them, in the order of the joints.

    Raises:
        InputError: A joint is not known or given twice, or a value is not finite or exceeds the joint's limits.
    """
    locks = locks_at(arm, locked, np.full(arm.n, np.nan))
    for joint, value in locks.items():
        name, unit, lower, upper = arm.joint_names[joint], arm.joints[joint].unit, arm.lower[joint], arm.upper[joint]
        if not lower <= value <= upper:
            raise InputError(f"joint '{name}' cannot lock at {value:g} {unit}: its limits are {lower:g} to {upper:g} {unit}")
    return tuple(locks.items())


def _require_whole(option: str, value: Any, minimum: int) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        number = minimum - 1
    if number < minimum:
        raise InputError(f"{option} is {value}; it must be {minimum} or more, and whole")
    return number
