"""Record designs in one file each, and the check of their claims."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, ValidationError

from holdfast.core.errors import InputError
from holdfast.core.files import yaml
from holdfast.core.files.yaml import Number, Strict, describe_validation_error
from holdfast.core.formatting import format_percent
from holdfast.core.labels import TASK_SIZES
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.kinematics.index_bounds.manipulability_bounds import UpperBound, bound_table, upper_bound
from holdfast.kinematics.solvers.self_motions import self_motion
from holdfast.model.arm.model import Arm
from holdfast.model.arms import dh_file, load, names
from holdfast.studies.designs.record_book.measuring import (
    approximate_jacobian,
    compute_jacobian,
    compute_null_space,
    compute_worst_manipulability,
)
from holdfast.studies.designs.record_book.workspaces import compute_exact_area, estimate_area_by_grid

_ORTHONORMALITY_TOLERANCE = 1e-12
_TRACE_SPACING_RAD = 0.01  # rad
_TRACE_STARTS = 32  # random starts of the trace of a self-motion
_GRID_AREA_TOLERANCE = 2e-3  # relative tolerance of an area that is measured by a grid
_LENGTH_TOLERANCE = 1e-9  # m, and fraction of all links
_ONE_CONFIGURATION = "one configuration"
TOTAL_LINK_LENGTH_M = 3.0  # m, sum of all link lengths, which makes areas comparable
_DATA_FOLDER = Path(__file__).parent / "data"


class _RecordClass(Strict):
    task: Literal["planar", "position", "pose"] | None = None
    rows: int
    joints: int
    failures: int
    quantity: Literal["relative-manipulability", "self-motion-size", "tolerant-workspace"]
    of: str | None = None
    least_link: Annotated[Number, Field(ge=0, lt=0.5)] = 0.0
    conditions: list[str]


class _ProvenBound(Strict):
    value: Number
    by: str


class _Discovery(Strict):
    by: str
    date: str
    how: str


class _CheckCommand(Strict):
    command: str
    tolerance: Annotated[Number, Field(gt=0, le=1e-4)]


class RecordFile(Strict):
    """Content of the file of a record, by key."""

    id: str
    kind: _RecordClass = Field(alias="class")
    value: Annotated[Number, Field(gt=0)]
    proven_bound: _ProvenBound
    found: _Discovery
    arm: dh_file.ArmFile | None = None
    null_space: list[list[Number]] | None = None
    limits: list[tuple[Number, Number] | None] | None = None
    at: Literal["home"] | list[Number] = "home"
    check: _CheckCommand
    beaten_by: str | None = None
    licence: str
    digest: str | None = None


def digest_record_text(text: str) -> str:
    """Return the digest of all characters of a record file, including insignificant digits, without spaces and digest line."""
    return sha256(re.sub(r"(?m)^digest:.*$|\s+", "", text).encode()).hexdigest()[:16]


@dataclass(frozen=True, kw_only=True, eq=False)
class DesignRecord(Result):
    """Best known design of its class, which is an arm at one configuration, or only a null space.

    Attributes:
        id: Class and number, which are never reused.
        data: Content of the file.
        text: Text of the file, in YAML.
    """

    id: str
    data: RecordFile
    text: str

    @property
    def proven(self) -> tuple[float, str]:
        """Proven upper bound and its source; in full revolutions of all joints for a self-motion, in m^2 for a workspace."""
        record_class = self.data.kind
        if record_class.quantity == "self-motion-size":
            return float(record_class.joints), "definition"
        if record_class.quantity == "tolerant-workspace":
            return (
                (np.pi * TOTAL_LINK_LENGTH_M**2 / 3, "W1")
                if record_class.joints == 3
                else (np.pi * TOTAL_LINK_LENGTH_M**2 * (1 - 2 * record_class.least_link) ** 2, "W2")
            )
        bound = upper_bound(n=record_class.joints, m=record_class.rows, k=record_class.failures)
        return bound.bound, bound.bound_by

    @property
    def amount(self) -> str:
        """Value with its unit, for tables."""
        unit_text = {"self-motion-size": " turns", "tolerant-workspace": " m²"}.get(self.data.kind.quantity, "")
        return f"{self.data.value:.8g}{unit_text}"

    @property
    def gap(self) -> float:
        """Relative amount by which the proven bound exceeds the value."""
        return self.data.proven_bound.value / self.data.value - 1

    @property
    def arm(self) -> Arm | None:
        """Arm of the record, or the built-in arm to which the record refers; None if there is only a null space."""
        if self.data.kind.of is not None:
            return load(self.data.kind.of)
        return None if self.data.arm is None else dh_file.build_arm(self.data.arm, Path(f"{self.id}.yaml"))

    def urdf(self) -> str:
        """Return the arm as a URDF file.

        Raises:
            InputError: The record has only a null space.
        """
        if self.arm is None:
            raise InputError(f"'{self.id}' has only a null space; measurements/synthesis in the repository makes arms from it")
        return self.arm.to_urdf()

    @property
    def q(self) -> FloatArray:
        """Configuration (n,), rad."""
        return np.zeros(self.data.kind.joints) if self.data.at == "home" else np.array(self.data.at)

    def check(self) -> RecordCheck:
        """Measure all claims again with code that is independent of the search."""
        record_class, claimed, claims = self.data.kind, self.data, list[tuple[str, bool]]()
        if claimed.digest is not None:
            digest = digest_record_text(self.text)
            claims.append((f"digest {claimed.digest} of the file as it was written, now {digest}", digest == claimed.digest))
        if record_class.quantity == "relative-manipulability":
            value = self._measure_manipulability(claims)
        else:
            value = self._measure_revolutions() if record_class.quantity == "self-motion-size" else self._measure_area(claims)
        if value is not None:
            near_enough = abs(value - claimed.value) <= claimed.check.tolerance * value
            claims.append((f"value {claimed.value!r}, measured {value!r}", near_enough))
        bound, _ = self.proven
        claimed_bound = claimed.proven_bound.value
        claims.append(
            (
                f"bound {claimed_bound!r} by {claimed.proven_bound.by}, proven {bound!r}",
                abs(claimed_bound - bound) <= 1e-9 * bound,
            )
        )
        is_below = claimed.value <= bound * (1 + 1e-9)
        claims.append(
            ("the value is below the bound" if is_below else "the value beats a proven bound: one of them is wrong", is_below)
        )
        return RecordCheck(record=self, claims=claims)

    def _measure_revolutions(self) -> float | None:
        """Return the full revolutions of all joints on one self-motion curve, traced again with half the spacing."""
        arm = self.arm
        if arm is None or self.data.kind.task is None or arm.n - self.data.kind.rows != 1:
            return None
        motion = self_motion(
            arm, arm.forward_kinematics(self.q), self.data.kind.task, spacing=_TRACE_SPACING_RAD, starts=_TRACE_STARTS
        )
        return motion.size / (2 * np.pi)

    def _measure_area(self, claims: list[tuple[str, bool]]) -> float | None:
        """Return the area of the failure-tolerant workspace, m^2, in closed form, and compare it with that of a grid."""
        record_class, arm_file, limits = self.data.kind, self.data.arm, self.data.limits
        rows = [] if arm_file is None else arm_file.rows
        is_planar = all(row.type == "revolute" and (row.alpha, row.d, row.theta) == (0, 0, 0) and row.a >= 0 for row in rows)
        is_suitable = (
            arm_file is not None and not any(arm_file.tool_point) and limits is not None and record_class.task == "planar"
        )
        is_suitable = is_suitable and is_planar and len(rows) == len(limits or []) == record_class.joints >= 3
        claims.append((f"{len(rows)} links in a plane, the tool at the end of the last, limits of each joint", is_suitable))
        if not is_suitable or limits is None:
            return None
        lengths = np.array([row.a for row in rows])
        shortest_fraction = float(lengths.min() / lengths.sum())
        lengths_agree = bool(
            abs(lengths.sum() - TOTAL_LINK_LENGTH_M) <= _LENGTH_TOLERANCE
            and shortest_fraction >= record_class.least_link - _LENGTH_TOLERANCE
        )
        claims.append(
            (
                f"{lengths.sum():.6f} m in all, the least link {format_percent(shortest_fraction)}, said "
                f"{format_percent(record_class.least_link)}",
                lengths_agree,
            )
        )
        only_last_limited = all(pair is None for pair in limits[:-1])
        claims.append(("no joint but the last has artificial limits", only_last_limited))
        if not only_last_limited:
            return None
        area = compute_exact_area(lengths, limits[-1])
        grid_area = estimate_area_by_grid(lengths, np.array([pair or (-np.pi, np.pi) for pair in limits[1:]]))
        claims.append(
            (f"in closed form {area:.6f} m^2, by a grid {grid_area:.6f}", abs(grid_area - area) <= _GRID_AREA_TOLERANCE * area)
        )
        return area

    def _measure_manipulability(self, claims: list[tuple[str, bool]]) -> float | None:
        null_space = self._compute_null_space(claims)
        return None if null_space is None else compute_worst_manipulability(null_space, self.data.kind.failures)

    def _compute_null_space(self, claims: list[tuple[str, bool]]) -> FloatArray | None:
        record_class = self.data.kind
        if self.data.null_space is not None:
            if [len(row) for row in self.data.null_space] != [record_class.joints - record_class.rows] * record_class.joints:
                claims.append((f"{record_class.joints} rows of {record_class.joints - record_class.rows} numbers", False))
                return None
            null_space = np.array(self.data.null_space)
            deviation = float(abs(null_space.T @ null_space - np.eye(null_space.shape[1])).max())
            claim = f"null space {null_space.shape}, orthonormal to {deviation:.1e}"
            claims.append((claim, deviation <= _ORTHONORMALITY_TOLERANCE))
            return null_space
        if record_class.of is not None:
            return self._compute_built_in_null_space(claims)
        arm_file = self.data.arm
        assert arm_file is not None
        revolute = arm_file.convention == "standard" and all(joint_row.type == "revolute" for joint_row in arm_file.rows)
        is_suitable = (
            len(arm_file.rows) == len(self.q) == record_class.joints
            and record_class.task is not None
            and TASK_SIZES[record_class.task] == record_class.rows
            and revolute
        )
        claim = (
            f"{len(arm_file.rows)} joints in a standard table, each revolute; task {record_class.task} of "
            f"{record_class.rows} rows"
        )
        claims.append((claim, is_suitable))
        if not is_suitable:
            return None
        unit = np.pi / 180 if arm_file.angles == "deg" else 1.0
        rows = [(joint_row.a, joint_row.alpha * unit, joint_row.d, joint_row.theta * unit) for joint_row in arm_file.rows]
        return compute_null_space(compute_jacobian(rows, arm_file.tool_point, self.q)[: record_class.rows])

    def _compute_built_in_null_space(self, claims: list[tuple[str, bool]]) -> FloatArray | None:
        """Return the null space of a built-in arm at its configuration, by differences of its forward kinematics."""
        record_class, arm = self.data.kind, self.arm
        assert arm is not None
        is_suitable = (
            len(self.q) == arm.n == record_class.joints
            and record_class.task is not None
            and TASK_SIZES[record_class.task] == record_class.rows
        )
        claims.append((f"{arm.n} joints of {arm.name}, task {record_class.task} of {record_class.rows} rows", is_suitable))
        if not is_suitable:
            return None
        is_within_limits = bool(
            (self.q >= arm.lower - _LENGTH_TOLERANCE).all() and (self.q <= arm.upper + _LENGTH_TOLERANCE).all()
        )
        claims.append(("the configuration is within its limits", is_within_limits))
        return compute_null_space(approximate_jacobian(arm.forward_kinematics, self.q)[: record_class.rows])


@dataclass(frozen=True, kw_only=True, eq=False)
class RecordCheck(Result):
    """Result of the check of a record.

    Attributes:
        record: The record.
        claims: Each claim with its measured value, and True if it holds.
    """

    record: DesignRecord
    claims: list[tuple[str, bool]]

    @property
    def ok(self) -> bool:
        """True if every claim holds."""
        return all(holds for _, holds in self.claims)


class RecordBook(dict[str, DesignRecord], Result):
    """All records by their id."""


def record_designs() -> RecordBook:
    """Return all records: the arms of the book, and the best null space of each stored upper bound."""
    entries = [load_record_file(path) for path in sorted(_DATA_FOLDER.glob("*.yaml"))]
    return RecordBook({entry.id: entry for entry in [*entries, *map(_make_null_space_record, bound_table().ceilings)]})


def record_design(name: str) -> DesignRecord:
    """Return the record with the id ``name``, or the record in the file with this path.

    Raises:
        InputError: There is no such record, or the file cannot be read or is not a record.
    """
    if name.endswith((".yaml", ".yml")) or Path(name).is_file():
        return load_record_file(Path(name))
    entries = record_designs()
    if name not in entries:
        raise InputError(
            f"there is no record '{name}'; `holdfast record-designs list` shows all, and the name of a file ends in .yaml"
        )
    return entries[name]


def find_best_record(record_class: Any) -> DesignRecord | None:
    """Return the best record of the same class."""
    candidates = [
        entry
        for entry in record_designs().values()
        if entry.data.kind.model_copy(update={"conditions": []}) == record_class.model_copy(update={"conditions": []})
    ]
    return max(candidates, key=lambda entry: entry.data.value, default=None)


def load_record_file(path: Path) -> DesignRecord:
    """Read the record in a file.

    Raises:
        InputError: The file cannot be read, is not a record, or contains neither an arm nor a null space.
    """
    return parse_record(
        yaml.read_mapping(path, "holdfast.studies.designs.record_book.entries", "id"),
        path.read_text(encoding="utf-8"),
        path.name,
    )


def parse_record(content: Any, text: str, name: str) -> DesignRecord:
    """Return the record with the given file content, text, and name for messages.

    Raises:
        InputError: The content is not a record.
    """
    try:
        data = RecordFile.model_validate(content)
    except ValidationError as error:
        raise InputError(f"{name}: {describe_validation_error(error, RecordFile, dh_file.POSE_TAGS)}") from error
    if [data.arm is None, data.null_space is None, data.kind.of is None].count(False) != 1:
        raise InputError(f"{name}: a record must have exactly one of arm, null_space, and `of` in its class")
    if data.kind.of is not None and data.kind.of not in names():
        raise InputError(f"{name}: there is no built-in arm '{data.kind.of}'")
    return DesignRecord(id=data.id, data=data, text=text)


def _make_null_space_record(bound: UpperBound) -> DesignRecord:
    """Return the record of a stored null space, which is not that of a particular kind of arm."""
    assert bound.null_space is not None
    record_id = f"jacobian-{bound.n}-{bound.m}-{bound.k}-001"
    record_class = {
        "rows": bound.m,
        "joints": bound.n,
        "failures": bound.k,
        "quantity": "relative-manipulability",
        "conditions": [_ONE_CONFIGURATION],
    }
    content = {
        "id": record_id,
        "class": record_class,
        "value": bound.best_known,
        "proven_bound": {"value": bound.bound, "by": bound.bound_by},
        "found": {"by": "holdfast", "date": "2026-11-25", "how": "python -m measurements.upper_bounds.null_spaces"},
        "null_space": bound.null_space.tolist(),
        "check": {"command": f"holdfast record-designs check {record_id}", "tolerance": 1e-9},
        "licence": "CC0-1.0",
    }
    return parse_record(content, "".join(f"{key}: {json.dumps(value)}\n" for key, value in content.items()), record_id)
