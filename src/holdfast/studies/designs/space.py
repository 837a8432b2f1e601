"""Design space of a search: the varied parameters of an arm, and their bounds."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import KW_ONLY, dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.model.arm.formats.urdf import rpy_rotation
from holdfast.model.arm.machine import Link
from holdfast.model.arm.model import Arm
from holdfast.model.arms.dh_rows import DHTable, dh_table

ROW_PARAMETERS = ("a", "alpha", "d", "theta", "lower", "upper")
TOOL_PARAMETERS = ("x", "y", "z", "roll", "pitch", "yaw")
_ANGLE_KINDS = ("alpha", "theta", "roll", "pitch", "yaw")
_PARAMETER_EXAMPLES = "a3 (also alpha, d, theta, lower and upper of a row) or tool.z (also x, y, roll, pitch and yaw)"
_UNIT_FACTORS = {"m": (1.0, "m"), "mm": (1e-3, "m"), "rad": (1.0, "rad"), "deg": (np.pi / 180, "rad")}


@dataclass(frozen=True)
class DesignParameter:
    """Parameter of an arm that a search may change.

    Attributes:
        name: ``a3``, ``alpha3``, ``d3``, ``theta3`` (row 3 of the arm's standard Denavit-Hartenberg table, rows counted from
            1), ``lower3``, ``upper3`` (limits of joint 3), or ``tool.x``, ``tool.y``, ``tool.z``, ``tool.roll``,
            ``tool.pitch``, ``tool.yaw`` (tool in the frame of the last row, with roll, pitch and yaw as in URDF).
        lower: Lower bound, rad or m.
        upper: Upper bound, rad or m.
        unit: ``rad`` or ``m``. Default: the unit of the name, for limits rad.
    """

    name: str
    lower: float
    upper: float
    _: KW_ONLY
    unit: Literal["rad", "m"] | None = None

    def __post_init__(self) -> None:
        kind, _ = _parse_parameter_name(self.name)
        if self.unit is None:
            object.__setattr__(self, "unit", "rad" if kind in (*_ANGLE_KINDS, "lower", "upper") else "m")
        lower, upper = float(self.lower), float(self.upper)
        if not (np.isfinite(lower) and np.isfinite(upper)):
            raise InputError(f"bounds of {self.name} are {lower:g} and {upper:g}; they must be finite numbers")
        if lower > upper:
            raise InputError(f"bounds of {self.name} are reversed: {self.text(lower)} is above {self.text(upper)}; swap them")
        if lower == upper:
            raise InputError(
                f"both bounds of {self.name} are {self.text(lower)}; give different bounds, or leave it out to keep its value"
            )
        object.__setattr__(self, "lower", lower)
        object.__setattr__(self, "upper", upper)

    @property
    def kind(self) -> str:
        """Kind of the parameter: ``a``, ``alpha``, ``d``, ``theta``, ``lower``, ``upper``, ``x``, ..., or ``yaw``."""
        return _parse_parameter_name(self.name)[0]

    @property
    def row(self) -> int | None:
        """Index of the row from 0; None for the tool."""
        return _parse_parameter_name(self.name)[1]

    @property
    def display_unit(self) -> tuple[float, str]:
        """Factor and unit for display, which are (1, "m") or (180/pi, "deg")."""
        return (1.0, "m") if self.unit == "m" else (180 / np.pi, "deg")

    def text(self, value: float) -> str:
        """Return ``value``, rad or m, as text for display, such as ``0.45 m`` or ``-90 deg``."""
        factor, unit = self.display_unit
        return f"{value * factor:.6g} {unit}"

    @property
    def option_text(self) -> str:
        """Text for ``--vary``, such as ``alpha4=-90..90deg``."""
        factor, unit = self.display_unit
        return f"{self.name}={self.lower * factor:.10g}..{self.upper * factor:.10g}{unit}"


@dataclass(frozen=True, eq=False)
class DesignSpace:
    """Arm and its k varied parameters; a design is a vector (k,) with one value per parameter, rad or m.

    Attributes:
        arm: The baseline arm. Its values must lie within the bounds, so that it can be compared with the results.
        parameters: Varied parameters, at least one.

    Raises:
        InputError: There is no parameter, one is given twice, the arm does not have a row or limit, a value of the baseline arm
            lies outside the bounds, or the limits of a joint can cross within the bounds.
    """

    arm: Arm
    parameters: tuple[DesignParameter, ...]

    def __post_init__(self) -> None:
        if not self.parameters:
            raise InputError(f"no parameter of '{self.arm.name}' is varied; give at least one of {_PARAMETER_EXAMPLES}")
        names = [parameter.name for parameter in self.parameters]
        for name in names:
            if names.count(name) > 1:
                raise InputError(f"{name} is varied twice; give its bounds once")
        object.__setattr__(self, "parameters", tuple(self._add_unit(parameter) for parameter in self.parameters))
        for parameter, value in zip(self.parameters, self.start, strict=True):
            if not parameter.lower <= value <= parameter.upper:
                raise InputError(
                    f"{parameter.name} of '{self.arm.name}' is {parameter.text(value)}, outside the bounds "
                    f"{parameter.text(parameter.lower)} to "
                    f"{parameter.text(parameter.upper)}; widen them, so that the arm can be compared with the results"
                )
        self._check_limits_cannot_cross()

    def _add_unit(self, parameter: DesignParameter) -> DesignParameter:
        """Return the parameter with its unit, after checking that the arm has it."""
        if parameter.row is None:
            return parameter
        if parameter.row >= self.arm.n:
            raise InputError(
                f"{parameter.name}: '{self.arm.name}' has no row {parameter.row + 1}; its Denavit-Hartenberg table has "
                f"rows 1 to {self.arm.n}"
            )
        if parameter.kind not in ("lower", "upper"):
            return parameter
        joint = self.arm.joints[parameter.row]
        if not np.isfinite(getattr(joint, parameter.kind)):
            raise InputError(
                f"{parameter.name}: joint '{joint.name}' of '{self.arm.name}' has no {parameter.kind} limit; give it one in "
                "the arm's file before it can be varied"
            )
        return replace(parameter, unit="m" if joint.prismatic else "rad")

    def _check_limits_cannot_cross(self) -> None:
        lower, upper = self.arm.lower.copy(), self.arm.upper.copy()
        for parameter in self.parameters:
            if parameter.kind == "lower" and parameter.row is not None:
                lower[parameter.row] = parameter.upper
            elif parameter.kind == "upper" and parameter.row is not None:
                upper[parameter.row] = parameter.lower
        for joint in {
            parameter.row for parameter in self.parameters if parameter.kind in ("lower", "upper") and parameter.row is not None
        }:
            if lower[joint] >= upper[joint]:
                factor, unit = self.arm.joints[joint].display_unit
                raise InputError(
                    f"the limits of joint '{self.arm.joints[joint].name}' can cross: lower{joint + 1} may be as high as "
                    f"{lower[joint] * factor:.6g} {unit} and upper{joint + 1} as low as {upper[joint] * factor:.6g} {unit}; "
                    "keep the bounds apart"
                )

    # ---- designs -----------------------------------------------------------------------------------------------

    @cached_property
    def table(self) -> DHTable:
        """Standard Denavit-Hartenberg table of the baseline arm."""
        return dh_table(self.arm)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return tuple(parameter.name for parameter in self.parameters)

    @cached_property
    def lower(self) -> FloatArray:
        """(k,) lower bounds, rad or m."""
        return np.array([parameter.lower for parameter in self.parameters])

    @cached_property
    def upper(self) -> FloatArray:
        """(k,) upper bounds, rad or m."""
        return np.array([parameter.upper for parameter in self.parameters])

    @cached_property
    def start(self) -> FloatArray:
        """(k,) values of the baseline arm; an angle is given by the equivalent angle within its bounds."""
        values = []
        rpy = dict(zip(TOOL_PARAMETERS[3:], _compute_roll_pitch_yaw(self.table.tool[:3, :3]), strict=True))
        for parameter in self.parameters:
            if parameter.row is not None:
                value = float(getattr(self.table.rows[parameter.row], parameter.kind))
            elif parameter.kind in rpy:
                value = rpy[parameter.kind]
            else:
                value = float(self.table.tool[TOOL_PARAMETERS.index(parameter.kind), 3])
            if parameter.kind in _ANGLE_KINDS:
                value = next(
                    (
                        candidate
                        for candidate in (value, value + 2 * np.pi, value - 2 * np.pi)
                        if parameter.lower <= candidate <= parameter.upper
                    ),
                    value,
                )
            values.append(value)
        return np.array(values)

    def check(self, values: ArrayLike) -> FloatArray:
        """Return the designs ``values``, (k,) or (D, k), rad and m, as float64 after checking them.

        Raises:
            InputError: The number of values is wrong, or a value is not a number or outside its bounds.
        """
        try:
            designs = np.asarray(values, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise InputError(f"a design must be {len(self.parameters)} numbers, {', '.join(self.names)}") from error
        if designs.ndim not in (1, 2) or designs.shape[-1] != len(self.parameters):
            value_count = designs.shape[-1] if designs.ndim else 0
            raise InputError(f"a design has {value_count} values; it must have {len(self.parameters)}, {', '.join(self.names)}")
        # Bounds that were converted from degrees may differ in the last digit.
        slack = 1e-12 * np.maximum(1.0, np.abs(designs))
        inside = (designs >= self.lower - slack) & (designs <= self.upper + slack)
        if not inside.all():
            position = tuple(np.argwhere(~inside)[0])
            parameter = self.parameters[position[-1]]
            raise InputError(
                f"{parameter.name} is {parameter.text(float(designs[position]))}; it must lie within its bounds, "
                f"{parameter.text(parameter.lower)} to {parameter.text(parameter.upper)}"
            )
        return designs

    def table_of(self, values: ArrayLike) -> DHTable:
        """Return the Denavit-Hartenberg table of the design ``values`` (k,), rad and m.

        Raises:
            InputError: The design is not valid; see :meth:`check`.
        """
        design = self.check(values)
        if design.ndim != 1:
            raise InputError(f"the design has shape {design.shape}; one design has the shape ({len(self.parameters)},)")
        rows, tool = list(self.table.rows), self.table.tool.copy()
        rpy = dict(zip(TOOL_PARAMETERS[3:], _compute_roll_pitch_yaw(tool[:3, :3]), strict=True))
        is_rotated = False
        for parameter, value in zip(self.parameters, design.tolist(), strict=True):
            if parameter.row is not None:
                change: dict[str, Any] = {parameter.kind: value}
                rows[parameter.row] = replace(rows[parameter.row], **change)
            elif parameter.kind in rpy:
                rpy[parameter.kind], is_rotated = value, True
            else:
                tool[TOOL_PARAMETERS.index(parameter.kind), 3] = value
        if is_rotated:
            tool[:3, :3] = rpy_rotation([rpy[kind] for kind in TOOL_PARAMETERS[3:]])
        return DHTable(tuple(rows), self.table.base, tool)

    def arm_of(self, values: ArrayLike, name: str | None = None) -> Arm:
        """Return the arm of a design (k,) with geometry, limits, gravity, and the known masses.

        The payload, and every link without varied ``a``, ``alpha`` or ``d``, are those of the baseline arm. The mass of any
        other link is not known, so it is None.

        Args:
            values: (k,) design within the bounds, rad or m.
            name: Name of the arm. Default: the name of the baseline arm with the suffix ``-design``.

        Raises:
            InputError: The design is not valid; see :meth:`check`.
        """
        table = self.table_of(values)
        values_text = ", ".join(
            f"{parameter.name} {parameter.text(value)}"
            for parameter, value in zip(self.parameters, np.asarray(values).tolist(), strict=True)
        )
        new_arm = table.arm(
            name=name or f"{self.arm.name}-design", gravity=self.arm.gravity, source=f"design of {self.arm.name}: {values_text}"
        )
        reshaped = {parameter.row for parameter in self.parameters if parameter.kind in ("a", "alpha", "d")}
        bodies, payload = self._links_in_table_frames
        links = tuple(None if index in reshaped else link for index, link in enumerate(bodies))
        return replace(new_arm, links=links).with_payload(payload)

    @cached_property
    def _links_in_table_frames(self) -> tuple[list[Link | None], Link | None]:
        """Links of the baseline arm in the moving frames of the table's joints, and the payload in that of the last row."""
        table_arm = self.table.arm()
        frames = [
            np.linalg.inv(a) @ b for a, b in zip(table_arm.frames_at_zero[:-1], self.arm.frames_at_zero[:-1], strict=True)
        ]
        links = [None if link is None else link.in_frame(frame) for link, frame in zip(self.arm.links, frames, strict=True)]
        payload = self.arm.payload
        return links, None if payload is None else payload.in_frame(np.linalg.inv(table_arm.flange) @ frames[-1])

    def draw(self, count: int, seed: int = 0) -> FloatArray:
        """Return ``count`` designs (count, k), rad and m, spread over the bounds by a Sobol sequence scrambled with ``seed``.

        A larger count begins with the designs of a smaller one.
        """
        from scipy.stats import qmc

        if count < 1:
            raise InputError(f"count is {count}; it must be 1 or more")
        engine = qmc.Sobol(len(self.parameters), scramble=True, rng=np.random.default_rng(seed))
        fractions = engine.random_base2(max(0, int(np.ceil(np.log2(count)))))[:count]
        return np.asarray(self.lower + fractions * (self.upper - self.lower))


Vary = DesignSpace | Iterable["DesignParameter | str"] | Mapping[str, Any]


def design_space(arm: Arm, vary: Vary) -> DesignSpace:
    """Return the design space that ``vary`` describes.

    Args:
        arm: The baseline arm.
        vary: A design space, which is returned unchanged; bounds by name, rad and m, for example ``{"a3": (0.2, 0.6)}``;
            parameters; or texts for :func:`holdfast.studies.designs.parse_vary`.

    Raises:
        InputError: ``vary`` is not valid; see :class:`holdfast.DesignSpace` and :func:`holdfast.studies.designs.parse_vary`.
    """
    if isinstance(vary, DesignSpace):
        return vary
    if isinstance(vary, Mapping):
        return DesignSpace(arm, tuple(_make_parameter(name, bounds) for name, bounds in vary.items()))
    entries = [vary] if isinstance(vary, str) else list(vary)
    if not all(isinstance(entry, (str, DesignParameter)) for entry in entries):
        raise InputError(f"vary is {vary!r}; give names with bounds, parameters, or texts such as 'a3=0.2..0.6'")
    return DesignSpace(arm, tuple(entry if isinstance(entry, DesignParameter) else parse_vary(entry, arm) for entry in entries))


def parse_vary(text: str, arm: Arm, option: str = "--vary") -> DesignParameter:
    """Parse ``a3=0.2..0.6``, ``d1=300..400mm``, ``alpha4=-90..90deg`` or ``lower2=-1.5..-0.5rad`` as a parameter.

    Lengths without a unit are in metres; angles must have a unit.

    Args:
        text: Text of the user.
        arm: Arm whose joints determine whether a limit is a length or an angle.
        option: Name of the option for error messages.

    Raises:
        InputError: The text is not valid.
    """
    name, equals, bounds = (piece.strip() for piece in text.partition("="))
    lower_text, dots, upper_text = (piece.strip() for piece in bounds.partition(".."))
    if not (equals and dots):
        raise InputError(f"{option} '{text}' cannot be read; write NAME=LOWER..UPPER, as a3=0.2..0.6 or alpha4=-90..90deg")
    kind, row = _parse_parameter_name(name, f"{option} ")
    is_prismatic = row is not None and row < arm.n and arm.joints[row].prismatic
    expected_unit = "rad" if kind in _ANGLE_KINDS or (kind in ("lower", "upper") and not is_prismatic) else "m"
    lower_number, lower_unit = _parse_quantity(lower_text, option, text)
    upper_number, upper_unit = _parse_quantity(upper_text, option, text)
    unit = upper_unit or ("m" if expected_unit == "m" else "")
    if not unit:
        raise InputError(
            f"{option} '{text}': bounds of an angle need their unit; write {name}={lower_text}..{upper_text}deg, or rad "
            f"for radians"
        )
    if lower_unit not in ("", unit):
        raise InputError(
            f"{option} '{text}' has two units, {lower_unit} and {unit}; give both bounds in one, {unit} at the end"
        )
    factor, base_unit = _UNIT_FACTORS[unit]
    if base_unit != expected_unit:
        valid_units = "m or mm" if expected_unit == "m" else "deg or rad"
        raise InputError(
            f"{option} '{text}': {name} is {'a length' if expected_unit == 'm' else 'an angle'}; give {valid_units}, not {unit}"
        )
    return DesignParameter(name, lower_number * factor, upper_number * factor, unit="m" if expected_unit == "m" else "rad")


def _parse_quantity(text: str, option: str, full_text: str) -> tuple[float, str]:
    match = re.fullmatch(r"(.*?[\d.])\s*([a-zA-Z]*)", text)
    try:
        value = float(match[1]) if match else float("nan")
    except ValueError:
        value = float("nan")
    if match is None or not np.isfinite(value):
        raise InputError(f"{option} '{full_text}': '{text}' is not a number with its unit; write it as 0.2, 200mm or 90deg")
    if match[2] and match[2] not in _UNIT_FACTORS:
        raise InputError(f"{option} '{full_text}': the unit '{match[2]}' is not known; use m, mm, deg or rad")
    return value, match[2]


def _make_parameter(name: str, bounds: Any) -> DesignParameter:
    try:
        lower, upper = (float(x) for x in bounds)
    except (TypeError, ValueError) as error:
        raise InputError(f"bounds of {name} are {bounds!r}; they must be two numbers, (lower, upper), rad or m") from error
    return DesignParameter(name, lower, upper)


def _parse_parameter_name(name: str, prefix: str = "") -> tuple[str, int | None]:
    """Parse the name of a parameter into kind and row from 0, or kind and None for the tool."""
    match = re.fullmatch(rf"({'|'.join(ROW_PARAMETERS)})([1-9]\d*)", name)
    if match:
        return match[1], int(match[2]) - 1
    owner, _, kind = name.partition(".")
    if owner == "tool" and kind in TOOL_PARAMETERS:
        return kind, None
    raise InputError(f"{prefix}'{name}' is not a parameter of an arm; write {_PARAMETER_EXAMPLES}")


def _compute_roll_pitch_yaw(rotation: FloatArray) -> tuple[float, float, float]:
    """Return roll, pitch, and yaw, rad; at a pitch of 90 deg, which determines only a sum of roll and yaw, yaw is 0."""
    pitch = np.arctan2(-rotation[2, 0], np.hypot(rotation[0, 0], rotation[1, 0]))
    if np.hypot(rotation[0, 0], rotation[1, 0]) < 1e-12:
        return float(np.arctan2(-rotation[1, 2], rotation[1, 1])), float(pitch), 0.0
    roll = np.arctan2(rotation[2, 1], rotation[2, 2])
    return float(roll), float(pitch), float(np.arctan2(rotation[1, 0], rotation[0, 0]))
