"""The space of a search: which numbers of an arm vary, and between which bounds."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import KW_ONLY, dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.machine import Link
from holdfast.arm.model import Arm
from holdfast.arm.urdf import rpy_rotation
from holdfast.arms.dh_rows import DHTable, dh_table
from holdfast.caching import cached_property
from holdfast.errors import InputError

Array = NDArray[np.float64]

OF_ROW = ("a", "alpha", "d", "theta", "lower", "upper")
OF_TOOL = ("x", "y", "z", "roll", "pitch", "yaw")
_ANGLES = ("alpha", "theta", "roll", "pitch", "yaw")
_EXAMPLE = "a3 (also alpha, d, theta, lower and upper of a row) or tool.z (also x, y, roll, pitch and yaw)"
_UNITS = {"m": (1.0, "m"), "mm": (1e-3, "m"), "rad": (1.0, "rad"), "deg": (np.pi / 180, "rad")}


@dataclass(frozen=True)
class Parameter:
    """One number of an arm that a search may change.

    Attributes:
        name: ``a3``, ``alpha3``, ``d3``, ``theta3`` (row 3 of the arm's standard Denavit-Hartenberg table, rows counted from
            1), ``lower3``, ``upper3`` (limits of joint 3), or ``tool.x``, ``tool.y``, ``tool.z``, ``tool.roll``,
            ``tool.pitch``, ``tool.yaw`` (tool in the last row's frame, roll, pitch and yaw as URDF).
        lower, upper: Bounds, rad or m.
        unit: ``rad`` or ``m``; if not given that of the name, rad for limits.
    """

    name: str
    lower: float
    upper: float
    _: KW_ONLY
    unit: Literal["rad", "m"] | None = None

    def __post_init__(self) -> None:
        kind, _ = _parts(self.name)
        if self.unit is None:
            object.__setattr__(self, "unit", "rad" if kind in (*_ANGLES, "lower", "upper") else "m")
        low, high = float(self.lower), float(self.upper)
        if not (np.isfinite(low) and np.isfinite(high)):
            raise InputError(f"bounds of {self.name} are {low:g} and {high:g}; they must be finite numbers")
        if low > high:
            raise InputError(f"bounds of {self.name} are reversed: {self.text(low)} is above {self.text(high)}; swap them")
        if low == high:
            raise InputError(
                f"both bounds of {self.name} are {self.text(low)}; give it room, or leave it out: then it stays as it is"
            )
        object.__setattr__(self, "lower", low)
        object.__setattr__(self, "upper", high)

    @property
    def kind(self) -> str:
        """What it is of a row or of the tool: ``a``, ``alpha``, ``d``, ``theta``, ``lower``, ``upper``, ``x``, ..., ``yaw``."""
        return _parts(self.name)[0]

    @property
    def row(self) -> int | None:
        """Index from 0 of its row; None for the tool."""
        return _parts(self.name)[1]

    @property
    def shown(self) -> tuple[float, str]:
        """Factor and unit in which people read it: (1, "m") or (180/pi, "deg")."""
        return (1.0, "m") if self.unit == "m" else (180 / np.pi, "deg")

    def text(self, value: float) -> str:
        """A value as people read it, as ``0.45 m`` or ``-90 deg``."""
        factor, unit = self.shown
        return f"{value * factor:.6g} {unit}"

    @property
    def written(self) -> str:
        """As ``--vary`` takes it: ``alpha4=-90..90deg``."""
        factor, unit = self.shown
        return f"{self.name}={self.lower * factor:.10g}..{self.upper * factor:.10g}{unit}"


@dataclass(frozen=True, eq=False)
class DesignSpace:
    """An arm and the numbers of it that vary. A design is a vector (k,), one value per parameter, rad or m.

    Attributes:
        arm: The given arm. Its own values must lie within the bounds, so that before and after can be compared.
        parameters: What is open; at least one.

    Raises:
        InputError: No parameter, one given twice, a row or limit that the arm has not, an own value outside the bounds, or
            bounds within which the lower limit of a joint can pass its upper one.
    """

    arm: Arm
    parameters: tuple[Parameter, ...]

    def __post_init__(self) -> None:
        if not self.parameters:
            raise InputError(f"nothing of '{self.arm.name}' is to be varied; give at least one of {_EXAMPLE}")
        names = [p.name for p in self.parameters]
        for name in names:
            if names.count(name) > 1:
                raise InputError(f"{name} is to be varied twice; give its bounds once")
        object.__setattr__(self, "parameters", tuple(self._in_unit(p) for p in self.parameters))
        for p, value in zip(self.parameters, self.start, strict=True):
            if not p.lower <= value <= p.upper:
                raise InputError(
                    f"{p.name} of '{self.arm.name}' is {p.text(value)}, outside the bounds {p.text(p.lower)} to "
                    f"{p.text(p.upper)}; widen them, so that the arm can be compared with what is found"
                )
        self._check_limits()

    def _in_unit(self, p: Parameter) -> Parameter:
        """The parameter with its unit, once it is clear that the arm has it."""
        if p.row is None:
            return p
        if p.row >= self.arm.n:
            raise InputError(
                f"{p.name}: '{self.arm.name}' has no row {p.row + 1}; its Denavit-Hartenberg table has rows 1 to {self.arm.n}"
            )
        if p.kind not in ("lower", "upper"):
            return p
        joint = self.arm.joints[p.row]
        if not np.isfinite(getattr(joint, p.kind)):
            raise InputError(
                f"{p.name}: joint '{joint.name}' of '{self.arm.name}' has no {p.kind} limit; give it one in the arm's file "
                "before it can be varied"
            )
        return replace(p, unit="m" if joint.prismatic else "rad")

    def _check_limits(self) -> None:
        low, high = self.arm.lower.copy(), self.arm.upper.copy()
        for p in self.parameters:
            if p.kind == "lower" and p.row is not None:
                low[p.row] = p.upper
            elif p.kind == "upper" and p.row is not None:
                high[p.row] = p.lower
        for k in {p.row for p in self.parameters if p.kind in ("lower", "upper") and p.row is not None}:
            if low[k] >= high[k]:
                factor, unit = self.arm.joints[k].shown
                raise InputError(
                    f"the limits of joint '{self.arm.joints[k].name}' can cross: lower{k + 1} may be as high as "
                    f"{low[k] * factor:.6g} {unit} and upper{k + 1} as low as {high[k] * factor:.6g} {unit}; keep the bounds "
                    "apart"
                )

    # ---- designs -----------------------------------------------------------------------------------------------

    @cached_property
    def table(self) -> DHTable:
        """The given arm's standard Denavit-Hartenberg table."""
        return dh_table(self.arm)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return tuple(p.name for p in self.parameters)

    @cached_property
    def lower(self) -> Array:
        """(k,) lower bounds, rad or m."""
        return np.array([p.lower for p in self.parameters])

    @cached_property
    def upper(self) -> Array:
        """(k,) upper bounds, rad or m."""
        return np.array([p.upper for p in self.parameters])

    @cached_property
    def start(self) -> Array:
        """(k,) values of the given arm; an angle by the turn that lies within its bounds."""
        out = []
        rpy = dict(zip(OF_TOOL[3:], _rpy(self.table.tool[:3, :3]), strict=True))
        for p in self.parameters:
            if p.row is not None:
                value = float(getattr(self.table.rows[p.row], p.kind))
            elif p.kind in rpy:
                value = rpy[p.kind]
            else:
                value = float(self.table.tool[OF_TOOL.index(p.kind), 3])
            if p.kind in _ANGLES:
                value = next((x for x in (value, value + 2 * np.pi, value - 2 * np.pi) if p.lower <= x <= p.upper), value)
            out.append(value)
        return np.array(out)

    def check(self, values: ArrayLike) -> Array:
        """Designs as float64, (k,) or (D, k).

        Raises:
            InputError: Wrong number of values, not numbers, or a value outside its bounds.
        """
        try:
            a = np.asarray(values, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise InputError(f"a design must be {len(self.parameters)} numbers, {', '.join(self.names)}") from error
        if a.ndim not in (1, 2) or a.shape[-1] != len(self.parameters):
            got = a.shape[-1] if a.ndim else 0
            raise InputError(f"a design has {got} values; it must have {len(self.parameters)}, {', '.join(self.names)}")
        # Bounds that went through degrees may differ in the last digit.
        slack = 1e-12 * np.maximum(1.0, np.abs(a))
        inside = (a >= self.lower - slack) & (a <= self.upper + slack)
        if not inside.all():
            where = tuple(np.argwhere(~inside)[0])
            p = self.parameters[where[-1]]
            raise InputError(
                f"{p.name} is {p.text(float(a[where]))}; it must lie within its bounds, {p.text(p.lower)} to {p.text(p.upper)}"
            )
        return a

    def table_of(self, values: ArrayLike) -> DHTable:
        """The table of a design (k,).

        Raises:
            InputError: As :meth:`check`.
        """
        design = self.check(values)
        if design.ndim != 1:
            raise InputError(f"one design is ({len(self.parameters)},) numbers; this is an array of shape {design.shape}")
        rows, tool = list(self.table.rows), self.table.tool.copy()
        rpy = dict(zip(OF_TOOL[3:], _rpy(tool[:3, :3]), strict=True))
        turned = False
        for p, value in zip(self.parameters, design.tolist(), strict=True):
            if p.row is not None:
                change: dict[str, Any] = {p.kind: value}
                rows[p.row] = replace(rows[p.row], **change)
            elif p.kind in rpy:
                rpy[p.kind], turned = value, True
            else:
                tool[OF_TOOL.index(p.kind), 3] = value
        if turned:
            tool[:3, :3] = rpy_rotation([rpy[x] for x in OF_TOOL[3:]])
        return DHTable(tuple(rows), self.table.base, tool)

    def arm_of(self, values: ArrayLike, name: str | None = None) -> Arm:
        """The arm of a design (k,): geometry, limits, gravity, and the masses that are known.

        A link of which neither ``a``, ``alpha`` nor ``d`` is varied is the given arm's, and so is the payload. The mass of a
        link of another shape is not known: None.

        Args:
            values: (k,) rad or m, within the bounds.
            name: Of the arm; the given arm's with ``-design`` behind it if not given.

        Raises:
            InputError: As :meth:`check`.
        """
        table = self.table_of(values)
        told = ", ".join(f"{p.name} {p.text(x)}" for p, x in zip(self.parameters, np.asarray(values).tolist(), strict=True))
        made = table.arm(
            name=name or f"{self.arm.name}-design", gravity=self.arm.gravity, source=f"design of {self.arm.name}: {told}"
        )
        reshaped = {p.row for p in self.parameters if p.kind in ("a", "alpha", "d")}
        moved, payload = self._bodies
        links = tuple(None if k in reshaped else link for k, link in enumerate(moved))
        return replace(made, links=links).with_payload(payload)

    @cached_property
    def _bodies(self) -> tuple[list[Link | None], Link | None]:
        """The given arm's links, each in the moving frame of its joint of the table, and its payload in the last row's."""
        same = self.table.arm()
        frames = [np.linalg.inv(a) @ b for a, b in zip(same.frames_at_zero[:-1], self.arm.frames_at_zero[:-1], strict=True)]
        links = [None if link is None else link.moved(frame) for link, frame in zip(self.arm.links, frames, strict=True)]
        held = self.arm.payload
        return links, None if held is None else held.moved(np.linalg.inv(same.flange) @ frames[-1])

    def draw(self, count: int, seed: int = 0) -> Array:
        """Designs spread over the bounds, (count, k): a scrambled Sobol sequence; more of them begin with the same ones."""
        from scipy.stats import qmc

        if count < 1:
            raise InputError(f"{count} designs cannot be drawn; draw at least 1")
        engine = qmc.Sobol(len(self.parameters), scramble=True, rng=np.random.default_rng(seed))
        unit = engine.random_base2(max(0, int(np.ceil(np.log2(count)))))[:count]
        return np.asarray(self.lower + unit * (self.upper - self.lower))


Vary = DesignSpace | Iterable["Parameter | str"] | Mapping[str, Any]


def design_space(arm: Arm, vary: Vary) -> DesignSpace:
    """The space that ``vary`` describes.

    Args:
        arm: The given arm.
        vary: A space as it is; bounds by name, ``{"a3": (0.2, 0.6)}``, rad and m; parameters; or texts as
            :func:`holdfast.designs.parse_vary` reads them.

    Raises:
        InputError: As :class:`holdfast.DesignSpace` and :func:`holdfast.designs.parse_vary`.
    """
    if isinstance(vary, DesignSpace):
        return vary
    if isinstance(vary, Mapping):
        return DesignSpace(arm, tuple(_bounded(name, bounds) for name, bounds in vary.items()))
    listed = [vary] if isinstance(vary, str) else list(vary)
    if not all(isinstance(x, (str, Parameter)) for x in listed):
        raise InputError(f"vary is {vary!r}; give names with bounds, parameters, or texts such as 'a3=0.2..0.6'")
    return DesignSpace(arm, tuple(x if isinstance(x, Parameter) else parse_vary(x, arm) for x in listed))


def parse_vary(text: str, arm: Arm, option: str = "--vary") -> Parameter:
    """``a3=0.2..0.6``, ``d1=300..400mm``, ``alpha4=-90..90deg`` or ``lower2=-1.5..-0.5rad`` as a parameter.

    Lengths are metres if they have no unit; angles must have theirs.

    Args:
        text: What a person wrote.
        arm: Says whether a limit is of a prismatic joint.
        option: What an error calls it.

    Raises:
        InputError: What is wrong with the text.
    """
    name, equals, bounds = (x.strip() for x in text.partition("="))
    low, dots, rest = (x.strip() for x in bounds.partition(".."))
    if not (equals and dots):
        raise InputError(f"{option} '{text}' cannot be read; write NAME=LOWER..UPPER, as a3=0.2..0.6 or alpha4=-90..90deg")
    kind, row = _parts(name, f"{option} ")
    sliding = row is not None and row < arm.n and arm.joints[row].prismatic
    wanted = "rad" if kind in _ANGLES or (kind in ("lower", "upper") and not sliding) else "m"
    low_number, low_unit = _quantity(low, option, text)
    high_number, high_unit = _quantity(rest, option, text)
    unit = high_unit or ("m" if wanted == "m" else "")
    if not unit:
        raise InputError(
            f"{option} '{text}': bounds of an angle need their unit; write {name}={low}..{rest}deg, or rad for radians"
        )
    if low_unit not in ("", unit):
        raise InputError(f"{option} '{text}' has two units, {low_unit} and {unit}; give both bounds in one, {unit} at the end")
    factor, measured = _UNITS[unit]
    if measured != wanted:
        fit = "m or mm" if wanted == "m" else "deg or rad"
        raise InputError(f"{option} '{text}': {name} is {'a length' if wanted == 'm' else 'an angle'}; give {fit}, not {unit}")
    return Parameter(name, low_number * factor, high_number * factor, unit="m" if wanted == "m" else "rad")


def _quantity(text: str, option: str, whole: str) -> tuple[float, str]:
    found = re.fullmatch(r"(.*?[\d.])\s*([a-zA-Z]*)", text)
    try:
        value = float(found[1]) if found else float("nan")
    except ValueError:
        value = float("nan")
    if found is None or not np.isfinite(value):
        raise InputError(f"{option} '{whole}': '{text}' is not a number with its unit; write it as 0.2, 200mm or 90deg")
    if found[2] and found[2] not in _UNITS:
        raise InputError(f"{option} '{whole}': the unit '{found[2]}' is not known; use m, mm, deg or rad")
    return value, found[2]


def _bounded(name: str, bounds: Any) -> Parameter:
    try:
        low, high = (float(x) for x in bounds)
    except (TypeError, ValueError) as error:
        raise InputError(f"bounds of {name} are {bounds!r}; they must be two numbers, (lower, upper), rad or m") from error
    return Parameter(name, low, high)


def _parts(name: str, before: str = "") -> tuple[str, int | None]:
    """What a name says: kind and row from 0, or kind and None for the tool."""
    found = re.fullmatch(rf"({'|'.join(OF_ROW)})([1-9]\d*)", name)
    if found:
        return found[1], int(found[2]) - 1
    place, _, kind = name.partition(".")
    if place == "tool" and kind in OF_TOOL:
        return kind, None
    raise InputError(f"{before}'{name}' is not a parameter of an arm; write {_EXAMPLE}")


def _rpy(rotation: Array) -> tuple[float, float, float]:
    """Roll, pitch and yaw, rad; where pitch is a right angle yaw is 0, as only roll and yaw together are known."""
    pitch = np.arctan2(-rotation[2, 0], np.hypot(rotation[0, 0], rotation[1, 0]))
    if np.hypot(rotation[0, 0], rotation[1, 0]) < 1e-12:
        return float(np.arctan2(-rotation[1, 2], rotation[1, 1])), float(pitch), 0.0
    roll = np.arctan2(rotation[2, 1], rotation[2, 2])
    return float(roll), float(pitch), float(np.arctan2(rotation[1, 0], rotation[0, 0]))
