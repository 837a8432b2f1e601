"""Records: one file each, and the check of what it claims."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, ValidationError

from holdfast.arm.model import Arm
from holdfast.arms import dh_file, load, names
from holdfast.arms.urdf_writing import urdf_text
from holdfast.ceilings.ceiling import Ceiling, look_up, table
from holdfast.designs.book.measuring import jacobian_by_differences, jacobian_of, least_left, null_space_of
from holdfast.designs.book.workspaces import area_by_grid, area_in_closed_form
from holdfast.errors import InputError
from holdfast.files import yaml
from holdfast.files.yaml import Number, Strict, sentence
from holdfast.grammar import TASKS
from holdfast.result import Result
from holdfast.solvers.self_motions import self_motion
from holdfast.words import percent

Array = NDArray[np.float64]

_ORTHONORMAL = 1e-12
_SPACING, _STARTS = 0.01, 32  # rad; of the trace of a self-motion
_GRID, _LENGTH = 2e-3, 1e-9  # relative, of an area by a grid; m, and fraction of all links
_ONE = "one configuration"
LINKS = 3.0  # m, of all links together: so that areas compare
_FOLDER = Path(__file__).parent / "data"


class _Class(Strict):
    task: Literal["planar", "position", "pose"] | None = None
    rows: int
    joints: int
    failures: int
    quantity: Literal["relative-manipulability", "self-motion-size", "tolerant-workspace"]
    of: str | None = None
    least_link: Annotated[Number, Field(ge=0, lt=0.5)] = 0.0
    conditions: list[str]


class _Bound(Strict):
    value: Number
    by: str


class _Found(Strict):
    by: str
    date: str
    how: str


class _Check(Strict):
    command: str
    tolerance: Annotated[Number, Field(gt=0, le=1e-4)]


class RecordFile(Strict):
    """The keys of a record's file."""

    id: str
    kind: _Class = Field(alias="class")
    value: Annotated[Number, Field(gt=0)]
    proven_bound: _Bound
    found: _Found
    arm: dh_file.ArmFile | None = None
    null_space: list[list[Number]] | None = None
    limits: list[tuple[Number, Number] | None] | None = None
    at: Literal["home"] | list[Number] = "home"
    check: _Check
    beaten_by: str | None = None
    licence: str
    digest: str | None = None


def digest_of(text: str) -> str:
    """Of all characters of a file but white space and the line of the digest: digits that no measure depends on count, too."""
    return sha256(re.sub(r"(?m)^digest:.*$|\s+", "", text).encode()).hexdigest()[:16]


@dataclass(frozen=True, kw_only=True, eq=False)
class Record(Result):
    """The best known of its class: an arm at one configuration, or a null space alone.

    Attributes:
        id: Class and number; never used again.
        data: All that the file says.
        text: The file itself, YAML.
    """

    id: str
    data: RecordFile
    text: str

    @property
    def proven(self) -> tuple[float, str]:
        """What no arm can beat, and why: of the size of a self-motion, in whole turns, all joints; of a workspace, in m^2."""
        c = self.data.kind
        if c.quantity == "self-motion-size":
            return float(c.joints), "definition"
        if c.quantity == "tolerant-workspace":
            return (np.pi * LINKS**2 / 3, "W1") if c.joints == 3 else (np.pi * LINKS**2 * (1 - 2 * c.least_link) ** 2, "W2")
        bound = look_up(n=c.joints, m=c.rows, k=c.failures)
        return bound.bound, bound.bound_by

    @property
    def amount(self) -> str:
        """The value with its unit, for tables."""
        unit = {"self-motion-size": " turns", "tolerant-workspace": " m²"}.get(self.data.kind.quantity, "")
        return f"{self.data.value:.8g}{unit}"

    @property
    def gap(self) -> float:
        """Fraction by which the proven bound is above the value."""
        return self.data.proven_bound.value / self.data.value - 1

    @property
    def arm(self) -> Arm | None:
        """Its arm, of a relative record that which it is of; None for a null space alone."""
        if self.data.kind.of is not None:
            return load(self.data.kind.of)
        return None if self.data.arm is None else dh_file.built(self.data.arm, Path(f"{self.id}.yaml"))

    def urdf(self) -> str:
        """Its arm as a URDF file.

        Raises:
            InputError: It is a null space alone.
        """
        if self.arm is None:
            raise InputError(f"'{self.id}' is a null space alone; make an arm that has it: holdfast ceiling --arm")
        return urdf_text(self.arm)

    @property
    def q(self) -> Array:
        """(n,) the configuration, rad."""
        return np.zeros(self.data.kind.joints) if self.data.at == "home" else np.array(self.data.at)

    def describe(self) -> list[str]:
        """Class, value and bound."""
        c, bound = self.data.kind, self.data.proven_bound
        of = {
            "relative-manipulability": f"{c.failures} locked at once",
            "self-motion-size": "whole turns in one self-motion",
            "tolerant-workspace": f"m^2 whichever locks, {LINKS:g} m of links, each at least {percent(c.least_link)} of it",
        }
        alone = "" if c.of is None else f"{c.of}, "
        what = f"{alone}{c.task or f'any task of {c.rows} rows'}, {c.joints} joints, {of[c.quantity]}"
        beaten = f"; beaten by {self.data.beaten_by}" if self.data.beaten_by else ""
        return [f"{self.id}: {what}: {self.data.value:.10g}; no arm can beat {bound.value:.10g} ({bound.by}){beaten}"]

    def check(self) -> RecordCheck:
        """Measure everything again, with code that shares nothing with what found it."""
        c, claimed, claims = self.data.kind, self.data, list[tuple[str, bool]]()
        if claimed.digest is not None:
            found = digest_of(self.text)
            claims.append((f"digest {claimed.digest} of the file as it was written, now {found}", found == claimed.digest))
        if c.quantity == "relative-manipulability":
            value = self._left(claims)
        else:
            value = self._turns() if c.quantity == "self-motion-size" else self._area(claims)
        if value is not None:
            near_enough = abs(value - claimed.value) <= claimed.check.tolerance * value
            claims.append((f"value {claimed.value!r}, measured {value!r}", near_enough))
        bound, _ = self.proven
        said = claimed.proven_bound.value
        claims.append((f"bound {said!r} by {claimed.proven_bound.by}, proven {bound!r}", abs(said - bound) <= 1e-9 * bound))
        below = claimed.value <= bound * (1 + 1e-9)
        claims.append(
            ("the value is below the bound" if below else "the value beats a proven bound: one of both is wrong", below)
        )
        return RecordCheck(record=self, claims=claims)

    def _turns(self) -> float | None:
        """Whole turns of all joints on one curve of the pose, traced anew with half the spacing."""
        arm = self.arm
        if arm is None or self.data.kind.task is None or arm.n - self.data.kind.rows != 1:
            return None
        found = self_motion(arm, arm.forward_kinematics(self.q), self.data.kind.task, spacing=_SPACING, starts=_STARTS)
        return found.size / (2 * np.pi)

    def _area(self, claims: list[tuple[str, bool]]) -> float | None:
        """Of the failure-tolerant workspace, m^2, in closed form; and by a grid."""
        c, given, limits = self.data.kind, self.data.arm, self.data.limits
        rows = [] if given is None else given.rows
        flat = all(r.type == "revolute" and (r.alpha, r.d, r.theta) == (0, 0, 0) and r.a >= 0 for r in rows)
        fits = given is not None and not any(given.tool_point) and limits is not None and c.task == "planar"
        fits = fits and flat and len(rows) == len(limits or []) == c.joints >= 3
        claims.append((f"{len(rows)} links in a plane, the tool at the end of the last, limits of each joint", fits))
        if not fits or limits is None:
            return None
        lengths = np.array([r.a for r in rows])
        least = float(lengths.min() / lengths.sum())
        total = bool(abs(lengths.sum() - LINKS) <= _LENGTH and least >= c.least_link - _LENGTH)
        claims.append((f"{lengths.sum():.6f} m in all, the least link {percent(least)}, said {percent(c.least_link)}", total))
        alone = all(pair is None for pair in limits[:-1])
        claims.append(("no joint but the last has artificial limits", alone))
        if not alone:
            return None
        value = area_in_closed_form(lengths, limits[-1])
        grid = area_by_grid(lengths, np.array([pair or (-np.pi, np.pi) for pair in limits[1:]]))
        claims.append((f"in closed form {value:.6f} m^2, by a grid {grid:.6f}", abs(grid - value) <= _GRID * value))
        return value

    def _left(self, claims: list[tuple[str, bool]]) -> float | None:
        null = self._null_space(claims)
        return None if null is None else least_left(null, self.data.kind.failures)

    def _null_space(self, claims: list[tuple[str, bool]]) -> Array | None:
        c = self.data.kind
        if self.data.null_space is not None:
            if [len(row) for row in self.data.null_space] != [c.joints - c.rows] * c.joints:
                claims.append((f"{c.joints} rows of {c.joints - c.rows} numbers", False))
                return None
            null = np.array(self.data.null_space)
            lack = float(abs(null.T @ null - np.eye(null.shape[1])).max())
            said = f"null space {null.shape}, orthonormal to {lack:.1e}"
            claims.append((said, lack <= _ORTHONORMAL))
            return null
        if c.of is not None:
            return self._null_space_of_arm(claims)
        given = self.data.arm
        assert given is not None
        revolute = given.convention == "standard" and all(r.type == "revolute" for r in given.rows)
        fits = len(given.rows) == len(self.q) == c.joints and c.task is not None and TASKS[c.task] == c.rows and revolute
        said = f"{len(given.rows)} joints in a standard table, each revolute; task {c.task} of {c.rows} rows"
        claims.append((said, fits))
        if not fits:
            return None
        unit = np.pi / 180 if given.angles == "deg" else 1.0
        rows = [(r.a, r.alpha * unit, r.d, r.theta * unit) for r in given.rows]
        return null_space_of(jacobian_of(rows, given.tool_point, self.q)[: c.rows])

    def _null_space_of_arm(self, claims: list[tuple[str, bool]]) -> Array | None:
        """Of an arm that is sold, at its configuration: by differences of its forward kinematics."""
        c, arm = self.data.kind, self.arm
        assert arm is not None
        fits = len(self.q) == arm.n == c.joints and c.task is not None and TASKS[c.task] == c.rows
        claims.append((f"{arm.n} joints of {arm.name}, task {c.task} of {c.rows} rows", fits))
        if not fits:
            return None
        within = bool((self.q >= arm.lower - _LENGTH).all() and (self.q <= arm.upper + _LENGTH).all())
        claims.append(("the configuration is within its limits", within))
        return null_space_of(jacobian_by_differences(arm.forward_kinematics, self.q)[: c.rows])


@dataclass(frozen=True, kw_only=True, eq=False)
class RecordCheck(Result):
    """What the check of a record found.

    Attributes:
        record: The record.
        claims: Each claim with what was measured, and whether it holds.
    """

    record: Record
    claims: list[tuple[str, bool]]

    @property
    def ok(self) -> bool:
        """True where every claim holds."""
        return all(holds for _, holds in self.claims)

    def describe(self) -> list[str]:
        """A line for each claim, and whether a submission beats the current record."""
        lines = [f"{self.record.id}: {'holds' if self.ok else 'does not hold'}"]
        lines += [f"{'ok' if holds else 'NOT SO'}: {said}" for said, holds in self.claims]
        current = best_of(self.record.data.kind)
        if self.ok and current is not None and current.id != self.record.id:
            more = self.record.data.value / current.data.value - 1
            compared = "beats" if more > 1e-9 else "does not beat"
            lines.append(f"{compared} {current.id}: {100 * more:+.2g} %")
        if self.ok and current is None:
            lines.append("the first of its class")
        return lines


class Book(dict[str, Record], Result):
    """All records by their id."""

    def describe(self) -> list[str]:
        """How many, and how many are open."""
        open_ = sum(r.gap > 1e-8 for r in self.values() if r.arm is None)
        return [f"{len(self)} records; of {open_} null spaces the value is below the proven bound: those are open"]


def records() -> Book:
    """All records: the arms of the book, and the best null space of each stored ceiling."""
    found = [read(path) for path in sorted(_FOLDER.glob("*.yaml"))]
    return Book({each.id: each for each in [*found, *map(_bare, table().ceilings)]})


def record(name: str) -> Record:
    """The record of an id, or of a file.

    Raises:
        InputError: There is no such record; the file cannot be read or is no record, and why.
    """
    if name.endswith((".yaml", ".yml")) or Path(name).is_file():
        return read(Path(name))
    known = records()
    if name not in known:
        raise InputError(
            f"there is no record '{name}'; `holdfast records list` shows all, and the name of a file ends in .yaml"
        )
    return known[name]


def best_of(kind: Any) -> Record | None:
    """The best record of the same class."""
    same = [
        r
        for r in records().values()
        if r.data.kind.model_copy(update={"conditions": []}) == kind.model_copy(update={"conditions": []})
    ]
    return max(same, key=lambda r: r.data.value, default=None)


def read(path: Path) -> Record:
    """The record of a file.

    Raises:
        InputError: It cannot be read, is no record, or holds neither an arm nor a null space.
    """
    return of_content(yaml.content(path, "holdfast.designs.book.entries", "id"), path.read_text(encoding="utf-8"), path.name)


def of_content(content: Any, text: str, name: str) -> Record:
    """The record that a file says, from what was read of it, its text, and its name for messages.

    Raises:
        InputError: It is no record.
    """
    try:
        data = RecordFile.model_validate(content)
    except ValidationError as error:
        raise InputError(f"{name}: {sentence(error, RecordFile, dh_file.TAGS)}") from error
    if [data.arm is None, data.null_space is None, data.kind.of is None].count(False) != 1:
        raise InputError(f"{name}: a record has an arm or a null_space, or its class is `of` an arm: one of them")
    if data.kind.of is not None and data.kind.of not in names():
        raise InputError(f"{name}: there is no built-in arm '{data.kind.of}'")
    return Record(id=data.id, data=data, text=text)


def _bare(c: Ceiling) -> Record:
    """The record of a stored null space, which is an arm of no particular kind."""
    assert c.null_space is not None
    name = f"jacobian-{c.n}-{c.m}-{c.k}-001"
    kind = {"rows": c.m, "joints": c.n, "failures": c.k, "quantity": "relative-manipulability", "conditions": [_ONE]}
    content = {
        "id": name,
        "class": kind,
        "value": c.best_known,
        "proven_bound": {"value": c.bound, "by": c.bound_by},
        "found": {"by": "holdfast", "date": "2026-11-25", "how": "holdfast ceiling --search"},
        "null_space": c.null_space.tolist(),
        "check": {"command": f"holdfast records check {name}", "tolerance": 1e-9},
        "licence": "CC0-1.0",
    }
    return of_content(content, "".join(f"{key}: {json.dumps(value)}\n" for key, value in content.items()), name)
