"""Known failures of an arm: locked joints, and joints with a reduced range or speed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.caching import cached_property
from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.files import output
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_arguments, require_real_numbers

if TYPE_CHECKING:
    from holdfast.model.arm.model import Arm


@dataclass(frozen=True, eq=False, init=False)
class Degraded:
    """Arm with joints that are locked, have a reduced range, or are slower than specified.

    It consists of position and speed limits, and ``locked=`` arguments accept it. In a file (:meth:`load`)::

        locked: {panda_joint4: -1.2}              # rad or m; or [panda_joint4], locked at its present value
        range: {panda_joint2: [-0.5, 0.8]}        # reduced range
        speed: {panda_joint1: 0.3}                # remaining fraction of its velocity limit

    Attributes:
        arm: Healthy arm.
        locked: ``{name: value}`` of locked joints, rad or m; None means the present value.
        ranges: ``{name: (low, high)}`` of joints that move only within this range, rad or m.
        speeds: ``{name: fraction}`` of the velocity limit, above 0 and at most 1.
    """

    arm: Arm
    _: KW_ONLY
    locked: Mapping[str, float | None]
    ranges: Mapping[str, tuple[float, float]]
    speeds: Mapping[str, float]

    @check_arguments
    def __init__(
        self,
        arm: Arm,
        *,
        locked: Locked = (),
        ranges: Mapping[Any, ArrayLike] | None = None,
        speeds: Mapping[Any, float] | None = None,
    ) -> None:
        """Describe the failures of an arm, with joints by name or index from 0.

        Args:
            arm: Healthy arm.
            locked: ``{joint: value}``, rad or m; ``{joint: None}``, or only the joints, for locks at the present value.
            ranges: ``{joint: (low, high)}``, rad or m.
            speeds: ``{joint: fraction}`` of the velocity limit, above 0 and at most 1.

        Raises:
            InputError: There is no such joint; a joint is given twice, or is locked and moves; a range is reversed or outside
                the joint's limits; a fraction is out of bounds, or its joint has no velocity limit; or no failure is given.
        """
        stands = {arm.joint_names[k]: value for k, value in sorted(read_locks(arm, locked).items())}
        left = {name: _check_range(arm, name, ends) for name, ends in _values_by_name(arm, ranges or {}, "ranges").items()}
        speeds_by_name = _values_by_name(arm, speeds or {}, "speeds")
        slow = {name: _check_speed_fraction(arm, name, value) for name, value in speeds_by_name.items()}
        if not (stands or left or slow):
            raise InputError(f"nothing of '{arm.name}' is degraded; give locked, ranges or speeds")
        for name in [*left, *slow]:
            if name in stands:
                raise InputError(f"joint '{name}' is locked and has a range or a speed; a locked joint does not move")
        for what, value in (("arm", arm), ("locked", stands), ("ranges", left), ("speeds", slow)):
            object.__setattr__(self, what, value)

    @property
    def lo(self) -> FloatArray:
        """Lower limits (n,) in force, rad or m; for a locked joint its value, NaN if that is not known (see :meth:`at`)."""
        return self._lower_or_upper_limits(0)

    @property
    def hi(self) -> FloatArray:
        """Upper limits (n,) in force, rad or m; for a locked joint its value, NaN if that is not known."""
        return self._lower_or_upper_limits(1)

    @property
    def v(self) -> FloatArray:
        """Velocity limits (n,) in force, rad/s or m/s, infinite for no limit; 0 for locked joints."""
        return np.array([0.0 if j.name in self.locked else j.velocity for j in self.limited.joints], dtype=np.float64)

    @property
    def moves(self) -> BoolArray:
        """Flags (n,) of the joints that are not locked."""
        return np.array([name not in self.locked for name in self.arm.joint_names])

    @cached_property
    def limited(self) -> Arm:
        """Arm with the limits and speeds in force; locked joints as if healthy."""
        if not self.ranges and not self.speeds:
            return self.arm
        joints = []
        for joint in self.arm.joints:
            if joint.name in self.ranges:
                low, high = self.ranges[joint.name]
                joint = replace(joint, type="prismatic" if joint.prismatic else "revolute", lower=low, upper=high)
            if joint.name in self.speeds:
                joint = replace(joint, velocity=joint.velocity * self.speeds[joint.name])
            joints.append(joint)
        return replace(self.arm, joints=tuple(joints))

    def at(self, q: ArrayLike) -> Degraded:
        """Return the same failures, with present values taken from the configuration ``q`` (n,), rad and m."""
        here = self.arm.check_configurations(q)
        if None not in self.locked.values():
            return self
        return replace(self, locked={self.arm.joint_names[k]: x for k, x in locks_at(self.arm, self.locked, here).items()})

    def require_values(self) -> Degraded:
        """Return the object itself, or raise :class:`holdfast.InputError` if a joint is locked without a value."""
        unknown = [repr(name) for name, value in self.locked.items() if value is None]
        if unknown:
            raise InputError(f"locked gives no value for {' and '.join(unknown)}; give {{joint: value}}, rad or m")
        return self

    def require_arm(self, arm: Arm) -> Degraded:
        """Return the object itself, or raise :class:`holdfast.InputError` if it does not belong to ``arm``."""
        if self.arm.fingerprint != arm.fingerprint:
            raise InputError(f"these failures belong to '{self.arm.name}', not to '{arm.name}'; make them with this arm")
        return self

    def _lower_or_upper_limits(self, side: int) -> FloatArray:
        bounds: FloatArray = np.stack([self.limited.lower, self.limited.upper])[side]
        for name, value in self.locked.items():
            bounds[self.arm.joint_index(name)] = np.nan if value is None else value
        return bounds

    @classmethod
    @check_arguments
    def load(cls, path: str | Path, arm: Arm) -> Degraded:
        """Read the failures of ``arm`` from the YAML file ``path``.

        Raises:
            InputError: The file cannot be read, or an entry is wrong; the message names it.
        """
        from pydantic import ValidationError

        from holdfast.core.files.yaml import Number, Strict, describe_validation_error, read_mapping

        class File(Strict):
            locked: list[str] | dict[str, Number | None] | None = None
            range: dict[str, list[Number]] | None = None
            speed: dict[str, Number] | None = None

        try:
            file_content = File.model_validate(read_mapping(Path(path), "holdfast.Degraded", "locked, range or speed"))
            return cls(arm, locked=file_content.locked or (), ranges=file_content.range, speeds=file_content.speed)
        except ValidationError as error:
            raise InputError(f"failure file '{path}': {describe_validation_error(error, File)}") from error
        except HoldfastError as error:
            raise InputError(f"failure file '{path}': {error}") from error

    def to_dict(self) -> dict[str, Any]:
        """Return the keys and values of a file."""
        said = {"locked": self.locked, "range": {k: list(x) for k, x in self.ranges.items()}, "speed": self.speeds}
        return {key: dict(values) for key, values in said.items() if values}

    @check_arguments
    def save(self, path: str | Path) -> Path:
        """Write the YAML file ``path``, which :meth:`load` reads, with all digits.

        Raises:
            StoreError: The file cannot be written.
        """
        import yaml

        output.replace_file(Path(path), yaml.safe_dump(self.to_dict(), sort_keys=False, allow_unicode=True), "failure")
        return Path(path)

    def mark(self, joint: str) -> str:
        """Return the mark of the joint named ``joint`` in a table: ``locked``, ``less range``, ``slower``, or nothing."""
        marks = ("locked", self.locked), ("less range", self.ranges), ("slower", self.speeds)
        return ", ".join(word for word, names in marks if joint in names)

    def describe(self) -> str:
        """Return the failures in one phrase: ``panda_joint4 locked at -68.8 deg and panda_joint1 at 30 % of its speed``."""
        phrases = []
        for name in self.arm.joint_names:
            factor, unit = self.arm.joints[self.arm.joint_index(name)].display_unit
            if name in self.locked:
                value = self.locked[name]
                phrases.append(f"{name} locked" + ("" if value is None else f" at {factor * value:.4g} {unit}"))
            if name in self.ranges:
                low, high = self.ranges[name]
                phrases.append(f"{name} within {factor * low:.4g} to {factor * high:.4g} {unit}")
            if name in self.speeds:
                phrases.append(f"{name} at {100 * self.speeds[name]:.4g} % of its speed")
        return " and ".join(phrases)


# {joint: value}, rad or m; {joint: None}, or only the joints, for present values. Joints by name or index from 0.
_At = Mapping[str, float] | Mapping[int, float] | Mapping[str | int, float]
LockedAt = _At | Degraded
LockedValues = Mapping[str, ArrayLike] | Mapping[int, ArrayLike] | Mapping[str | int, ArrayLike] | Degraded  # (N,) of each
LockedAnywhere = str | int | Sequence[str | int] | Mapping[str, None] | Mapping[int, None] | Mapping[str | int, None]
_Mapping = Mapping[str, float | None] | Mapping[int, float | None] | Mapping[str | int, float | None]
Locked = _Mapping | str | int | Iterable[str | int] | Degraded


def _values_by_name(arm: Arm, values_by_joint: Mapping[Any, Any], quantity: str) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for joint, value in values_by_joint.items():
        name = arm.joint_names[arm.joint_index(joint)]
        if name in values:
            raise InputError(f"{quantity} gives joint '{name}' twice; give each joint once")
        values[name] = value
    return values


def _check_range(arm: Arm, name: str, ends_given: ArrayLike) -> tuple[float, float]:
    joint = arm.joints[arm.joint_index(name)]
    ends = require_real_numbers(ends_given, f"the range of '{name}'", f"(low, high), {joint.unit}")
    if ends.shape != (2,) or not np.isfinite(ends).all():
        raise InputError(f"the range of '{name}' is {ends_given!r}; give (low, high), two finite numbers, {joint.unit}")
    low, high = ends.tolist()
    if not low < high:
        advice = "swap them" if low > high else "a joint that cannot move is locked"
        raise InputError(f"the range of '{name}' is {low:g} to {high:g} {joint.unit}; {advice}")
    if low < joint.lower or high > joint.upper:
        raise InputError(
            f"the range of '{name}', {low:g} to {high:g} {joint.unit}, is not within its limits, {joint.lower:g} to "
            f"{joint.upper:g}"
        )
    return low, high


def _check_speed_fraction(arm: Arm, name: str, given: Any) -> float:
    number = require_real_numbers(given, f"the speed of '{name}'", "a fraction of its velocity limit")
    if number.ndim or not 0 < number <= 1:
        raise InputError(f"the speed of '{name}' is {given!r}; give a fraction of its velocity limit, above 0 and at most 1")
    if not np.isfinite(arm.joints[arm.joint_index(name)].velocity):
        raise InputError(f"joint '{name}' has no velocity limit, so there is no fraction of it; leave its speed out")
    return float(number)


def degraded_at(arm: Arm, locked: Locked, at: FloatArray) -> Degraded | None:
    """Return the failures of ``arm`` with joints ``locked`` at given values or those in ``at`` (n,); None if there are none.

    Raises:
        InputError: As for :func:`read_locks`; a :class:`Degraded` of another arm.
    """
    if isinstance(locked, Degraded):
        return locked.require_arm(arm).at(at)
    stands = locks_at(arm, locked, at)
    return Degraded(arm, locked=stands) if stands else None


def read_locks(arm: Arm, locked: Locked) -> dict[int, float | None]:
    """Return the ``locked`` joints of ``arm`` by index in the given order, with values in rad or m, or None (present value).

    Raises:
        InputError: There is no such joint, one is given twice, a value is not finite, or ``locked`` has ranges or speeds.
    """
    if isinstance(locked, Degraded):
        others = [f"a range of '{name}'" for name in locked.ranges] + [f"a speed of '{name}'" for name in locked.speeds]
        if others:
            raise InputError(
                f"only locked joints count here, but the failures include {others[0]}; leave it out, or see recover"
            )
        locked = locked.require_arm(arm).locked
    if isinstance(locked, (str, int)) or getattr(locked, "ndim", 1) == 0:
        locked = [locked if isinstance(locked, str) else int(np.asarray(locked))]
    if not isinstance(locked, Iterable):
        raise InputError(f"locked is {locked!r}; it must be a joint, joints, or {{joint: value}}")
    given = list(locked.items()) if isinstance(locked, Mapping) else [(joint, None) for joint in locked]
    locks: dict[int, float | None] = {}
    for joint, value in given:
        k = arm.joint_index(joint)
        name, unit = arm.joint_names[k], arm.joints[k].unit
        if k in locks:
            raise InputError(f"joint '{name}' is locked twice; give each joint once")
        locks[k] = None
        if value is not None:
            number = require_real_numbers(value, f"the lock of '{name}'", f"a number, {unit}")
            if number.ndim or not np.isfinite(number):
                raise InputError(f"joint '{name}' is locked at {value}; give a finite number, {unit}")
            locks[k] = float(number)
    return locks


def locks_at(arm: Arm, locked: Locked, at: FloatArray) -> dict[int, float]:
    """Return the locks of :func:`read_locks` (``arm``, ``locked``) in the arm's order, by default at values in ``at`` (n,)."""
    return {k: float(at[k]) if value is None else value for k, value in sorted(read_locks(arm, locked).items())}


def locks_with_values(arm: Arm, locked: Locked) -> tuple[tuple[int, ...], FloatArray]:
    """Return the ``locked`` joints (k,) of ``arm`` in the given order and their values (k,), rad or m.

    Every joint needs a value, and at least one joint must be free.

    Raises:
        InputError: As for :func:`read_locks`; a joint has no value; no joint or every joint is locked.
    """
    locks = read_locks(arm, locked)
    if not 1 <= len(locks) < arm.n:
        raise InputError(f"locked names {len(locks)} joints of '{arm.name}'; give 1 to {arm.n - 1}")
    unknown = [repr(arm.joint_names[k]) for k, value in locks.items() if value is None]
    if unknown:
        raise InputError(f"locked gives no value for {' and '.join(unknown)}; give {{joint: value}}, rad or m")
    return tuple(locks), np.array(list(locks.values()), dtype=np.float64)
