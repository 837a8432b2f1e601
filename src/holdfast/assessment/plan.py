"""What an assessment computes: everything that defines its rows."""

from __future__ import annotations

import operator
import reprlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.arms.serial import from_dict, to_dict
from holdfast.cell.cell import Cell
from holdfast.clearance.choice import CellLike, chosen_clearance, from_stored, stored
from holdfast.clearance.clearance import Clearance
from holdfast.engine.store import Column, Store
from holdfast.errors import HoldfastError, InputError, StoreError
from holdfast.failures import locks_at
from holdfast.indices.index import Index, by_name
from holdfast.indices.own_file import check_digest, plan_entries
from holdfast.regions.region import Region, Sampling
from holdfast.registry import INDICES
from holdfast.solvers.optimum import default_starts

Array = NDArray[np.float64]
Rows = dict[str, NDArray[Any]]

_POSES = 2000  # unless asked otherwise
_CHUNK_BLOCKS = 8
LOCK_RESTARTS = 20  # starts for a pose after a lock, before it counts as lost
CLEAR_RESTARTS, CLEAR_STEPS = 30, 20  # the same to keep clear: every tenth start takes longer, and costs as much as two others

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
        clearance: Of the arm from itself and its cell: looked at in every configuration, and kept by the best ones; None: not
            looked at.
        margin: Smallest clearance of the best configurations, m; from an object beyond what the cell keeps from it.
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
    def cell(self) -> Cell | None:
        """The objects around the arm."""
        return None if self.clearance is None else self.clearance.cell

    @property
    def others(self) -> list[str]:
        """What the arm may collide with where there is a cell: itself, if that is looked at, and each object."""
        if self.clearance is None or self.cell is None:
            return []
        return ["itself"] * bool(self.clearance.pairs) + [solid.name for solid in self.cell]

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
            **plan_entries(index),
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
        return data if self.clearance is None else data | stored(self.clearance, self.margin)

    @property
    def storable(self) -> bool:
        """False for an index or a region that a folder cannot hold."""
        return INDICES.storable(self.index) and self.region.storable

    def create(self, path: Path) -> Store:
        """A results folder for its rows, or that of a stopped run.

        Raises:
            InputError: It is not storable.
            StoreError: The folder holds something else, or cannot be written.
        """
        own = None
        if not self.region.storable:
            own = f"region '{self.region.name}' has a function of your own"
        elif not self.storable:
            own = f"index '{self.index.name}' is your own function outside a file"
        if own is not None:
            raise InputError(f"{own}, which a folder cannot hold; assess without a store")
        return Store.create(path, self.to_dict(), self.columns(), rows=self.poses, chunk=_CHUNK_BLOCKS * self.region.block)

    @classmethod
    def from_dict(cls, data: dict[str, Any], poses: int) -> Plan:
        """The plan that :meth:`to_dict` wrote; raises KeyError or TypeError if something is missing."""
        arm = from_dict(data["arm"])
        if data["fingerprint"] != arm.fingerprint:
            raise InputError("its fingerprint is not that of its arm, so its rows may be those of another arm")
        task = Task.from_dict(data["task"])
        index = by_name(data["index"], arm, task, failures=[list(f) for f in data["failures"]])
        check_digest(index, data)
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
            from_stored(arm, data),
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
        except StoreError as error:
            raise StoreError(f"'{store.path}' cannot be read: {error}") from error
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
            Column("position", "float64", (("axis", 3),), units="m", about="drawn position of the tool in the world"),
            Column(
                "quaternion", "float64", (("xyzw", 4),), units="1", about="drawn orientation of the tool in the world, x y z w"
            ),
        ]
        best = [
            Column(
                "optimised_q",
                "float64",
                (("joint", n),),
                units="rad or m",
                about="best configuration found; NaN where there is none",
            ),
            Column("optimised_index", "float64", (), units=unit, about=f"{about}, at the best configuration found"),
            Column("optimised_worst", "int16", (), units="1", about="position of the worst failure there; -1 if there is none"),
            Column(
                "agreeing",
                "float64",
                (),
                units="1",
                about="share of the starts followed to the end that reached the best value",
            ),
        ]
        apart = [
            Column(
                "clearance",
                "float64",
                (),
                units="m",
                about="smallest distance between links; below 0: the arm runs through itself",
            )
        ]
        if self.optimise:
            apart += [
                Column(
                    "optimised_status",
                    "uint8",
                    (),
                    units="1",
                    about="as status; 4: every configuration found runs the arm through itself",
                ),
                Column(
                    "blocked",
                    "int8",
                    (),
                    units="1",
                    about="1 if the best configuration without regard to itself runs the arm through itself",
                ),
            ]
        names = ", ".join(self.others)
        around = [
            Column(
                "from_each",
                "float64",
                (("other", len(self.others)),),
                units="m",
                about=f"smallest distance of the arm from {names}; from objects a lower bound",
            )
        ]
        if self.region.kind != "joints":
            about = "1 if a configuration of the pose was found that is clear of all of these, 0 if not, -1 unknown"
            around.append(Column("clear", "int8", (), units="1", about=about))
        if self.optimise:
            about = (
                f"position in {names} of what is nearest at the best configuration without regard to it; -1 if that is clear"
            )
            around.append(Column("blocked_by", "int16", (), units="1", about=about))
        survives = _SURVIVES_AT if self.lock_at else _SURVIVES
        angle = Column(
            "lock_angle", "float64", (("lock", n),), units="rad or m", about="where each joint locked; NaN where none did"
        )
        return [
            *(pose if self.region.kind != "joints" else []),
            *([Column("weight", "float64", (), units="1", about="how much the pose counts")] if self.weighted else []),
            Column("q", "float64", (("joint", n),), units="rad or m", about="configuration; NaN where none was found"),
            Column("status", "uint8", (), units="1", about="0 ok, 1 not found, 3 singular, 255 not computed yet"),
            Column("index", "float64", (), units=unit, about=about),
            Column("by_failure", "float64", (("failure", f),), units=unit, about=f"{self.index.name} for each failure"),
            Column(
                "worst",
                "int16",
                (),
                units="1",
                about="position of the worst failure in the list of failures; -1 if there is none",
            ),
            *(best if self.optimise else []),
            *(apart if self.clearance is not None else []),
            *(around if self.cell is not None else []),
            *([Column("survives", "int8", (("lock", n),), units="1", about=survives), angle] if self.locks else []),
        ]


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
        chosen_clearance(arm, clearance, cell, looks=optimise),
        margin,
    )


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


def _whole(what: str, value: Any, least: int) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        number = least - 1
    if number < least:
        raise InputError(f"{what} is {value}; it must be {least} or more, and whole")
    return number
