"""Read and write arms as YAML files with a Denavit-Hartenberg table.

An example with every key; only ``rows``, and ``a`` and ``alpha`` in each row, are required::

    name: my arm              # default: the file's name
    convention: standard      # or modified; see holdfast.model.arm.dh.DH
    angles: deg               # unit of alpha, theta, urdf_rpy and of revolute limits and velocities; default rad
    rows:
      - {a: 0, alpha: -90, d: 0.3, lower: -170, upper: 170, name: shoulder, velocity: 90, effort: 120}
      - {a: 0.5, alpha: 0, theta: 90, friction: 0.1, armature: 0.02, coulomb_friction: 0.3}   # no lower and upper: no limits
      - {a: 0, alpha: 0, type: prismatic, lower: 0, upper: 0.4}          # always in metres
    base: {xyz: [0, 0, 0.8], urdf_rpy: [0, 0, 180]}   # in the world; roll, pitch, yaw as URDF: Rz(yaw) Ry(pitch) Rx(roll)
    tool:                                        # pose of the tool in the last row's frame; base and tool accept both forms
      - [1, 0, 0, 0]
      - [0, 1, 0, 0]
      - [0, 0, 1, 0.1]
      - [0, 0, 0, 1]
    gravity: [0, 0, -9.81]    # in the world, m/s^2
    links:                    # one per row, each in the frame of its row; null if unknown
      - {name: upper arm, mass: 4, com: [0, 0.1, 0], inertia: [0.02, 0.01, 0.02, 0, 0, 0]}   # xx, yy, zz, xy, xz, yz
      - {mass: 2, com: [-0.25, 0, 0], inertia: [[0.01, 0, 0], [0, 0.05, 0], [0, 0, 0.05]]}   # about com, kg m^2
      - null
    payload: {mass: 1, com: [0, 0, 0.1], inertia: [0.001, 0.001, 0.001, 0, 0, 0]}           # in the last row's frame
    source: Where the numbers come from.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
import yaml
from numpy.typing import ArrayLike
from pydantic import BeforeValidator, Discriminator, Field, Tag, ValidationError

from holdfast.core.errors import ArmError, InputError
from holdfast.core.files.yaml import Four, Number, Strict, Three, describe_validation_error, read_mapping
from holdfast.core.progress import print_warning
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.dh import DH
from holdfast.model.arm.formats.urdf import rpy_rotation
from holdfast.model.arm.machine import DRY_FRICTION, GRAVITY, Link
from holdfast.model.arm.model import Arm
from holdfast.model.arms.dh_rows import DHTable

_MAX_PLAUSIBLE_ANGLE_RAD = 2 * np.pi  # rad: a larger angle is probably in degrees


@check_arguments
def load_dh_file(path: str | Path) -> Arm:
    """Return the arm of a YAML file in the format of this module.

    Args:
        path: YAML file.

    Returns:
        The arm, in rad and m.

    Raises:
        ArmError: The file cannot be read, or an entry is wrong; the message names the entry, such as ``rows[2].alpha``.
    """
    path = Path(path)
    try:
        return build_arm(ArmFile.model_validate(read_mapping(path, "holdfast.model.arms.dh_file", "rows")), path)
    except ValidationError as error:
        raise ArmError(f"{path.name}: {describe_validation_error(error, ArmFile, POSE_TAGS)}") from error
    except (ArmError, InputError) as error:
        raise ArmError(f"{path.name}: {error}") from error


def format_dh_file(
    table: DHTable,
    name: str,
    gravity: ArrayLike = GRAVITY,
    source: str = "",
    *,
    links: Sequence[Link | None] = (),
    payload: Link | None = None,
) -> str:
    """Return a table as a file in the format of this module, in m and degrees.

    Args:
        table: Rows with their limits, base and tool.
        name: Name of the arm.
        gravity: (3,) acceleration in the world, m/s^2.
        source: Origin of the numbers.
        links: One body per row, each in its row's frame, None if unknown; without links no masses are written.
        payload: Body held by the end effector, in the last row's frame.

    Returns:
        YAML text that gives the numbers of the table to 1e-14 when it is read back.
    """
    source_line = [f"source: {_format_scalar(source)}"] if source else []
    lines = [f"name: {_format_scalar(name)}", *source_line, "angles: deg", "rows:"]
    row_entries = [", ".join(f"{key}: {_format_scalar(entry)}" for key, entry in _format_row(row)) for row in table.rows]
    lines += [f"  - {{{entries}}}" for entries in row_entries]
    for key, pose in (("base", table.base), ("tool", table.tool)):
        if not np.array_equal(pose, np.eye(4)):
            matrix_rows = [", ".join(map(_format_scalar, row)) for row in (pose + 0.0).tolist()]
            lines += [f"{key}:", *(f"  - [{row}]" for row in matrix_rows)]
    if not np.array_equal(gravity, GRAVITY):
        lines.append(f"gravity: [{', '.join(_format_scalar(float(number)) for number in np.asarray(gravity))}]")
    if any(link is not None for link in links):
        lines += ["links:", *[f"  - {_format_body(link)}" for link in links]]
    lines += [f"payload: {_format_body(payload)}"] * (payload is not None)
    return "\n".join(lines) + "\n"


def _format_body(link: Link | None) -> str:
    """Format a body as one line of YAML with all digits, because a small inertia has as many digits as a large one."""
    if link is None:
        return "null"
    inertia = link.inertia
    inertia_entries = (inertia[0, 0], inertia[1, 1], inertia[2, 2], inertia[0, 1], inertia[0, 2], inertia[1, 2])
    numbers = [", ".join(repr(float(number)) for number in values) for values in (link.com, inertia_entries)]
    name_entry = f"name: {_format_scalar(link.name)}, " if link.name else ""
    return f"{{{name_entry}mass: {float(link.mass)!r}, com: [{numbers[0]}], inertia: [{numbers[1]}]}}"


def _format_row(row: DH) -> list[tuple[str, str | float]]:
    """Return the entries of a row in m and degrees, without entries that have their default."""
    cells: list[tuple[str, str | float]] = [("a", row.a), ("alpha", _to_clean_degrees(row.alpha))]
    cells += [("d", row.d)] * (row.d != 0) + [("theta", _to_clean_degrees(row.theta))] * (row.theta != 0)
    is_prismatic = row.type == "prismatic"
    if is_prismatic:
        cells.append(("type", row.type))
    for key in ("lower", "upper", "velocity"):
        value = getattr(row, key)
        if value is not None:
            cells.append((key, value if is_prismatic else _to_clean_degrees(value)))
    cells += [("effort", row.effort)] if row.effort is not None else []
    cells += [(key, getattr(row, key)) for key in ("friction", "armature", *DRY_FRICTION) if getattr(row, key)]
    return [*cells, ("name", row.name)] if row.name else cells


def _to_clean_degrees(angle: float) -> float:
    exact = float(np.rad2deg(angle))
    rounded = round(exact, 10)
    return rounded if abs(np.deg2rad(rounded) - angle) < 1e-15 else exact


def _format_scalar(value: str | float) -> str:
    """Format one YAML value; whole numbers have no decimal point."""
    if isinstance(value, str):
        quoted: str = yaml.safe_dump([value], default_flow_style=True, width=10_000, allow_unicode=True)
        return quoted.strip()[1:-1]  # as it is between braces
    rounded = round(value, 13)
    value = rounded if abs(value - rounded) < 1e-15 else value
    return f"{value:.0f}" if value == round(value) and abs(value) < 1e15 else repr(float(value))


# ---- the format --------------------------------------------------------------------------------------------------


def _expand_inertia(value: Any) -> Any:
    if isinstance(value, list) and not any(isinstance(entry, list) for entry in value):
        if len(value) != 6:
            raise ValueError("it must be 6 numbers (xx, yy, zz, xy, xz, yz) or 3 rows of 3")
        xx, yy, zz, xy, xz, yz = value
        return [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
    return value


class _RowEntry(Strict):
    a: Number
    alpha: Number
    d: Number = 0.0
    theta: Number = 0.0
    type: Literal["revolute", "prismatic"] = "revolute"
    lower: Number | None = None
    upper: Number | None = None
    name: str | None = None
    velocity: Number | None = None
    effort: Number | None = None
    friction: Number = 0.0
    armature: Number = 0.0
    coulomb_friction: Number = 0.0
    stiction: Number = 0.0


class _BodyEntry(Strict):
    mass: Number
    com: Three
    inertia: Annotated[list[Three], Field(min_length=3, max_length=3), BeforeValidator(_expand_inertia)]
    name: str | None = None


class _PlacementEntry(Strict):
    xyz: Three = Field(default_factory=lambda: [0.0, 0.0, 0.0])
    urdf_rpy: Three = Field(default_factory=lambda: [0.0, 0.0, 0.0])


POSE_TAGS = ("as rows", "as xyz and urdf_rpy")
_Pose = Annotated[
    Annotated[list[Four], Field(min_length=4, max_length=4), Tag(POSE_TAGS[0])] | Annotated[_PlacementEntry, Tag(POSE_TAGS[1])],
    Discriminator(lambda value: POSE_TAGS[0] if isinstance(value, list) else POSE_TAGS[1]),
]


class ArmFile(Strict):
    """Keys of an arm file with a Denavit-Hartenberg table."""

    rows: Annotated[list[_RowEntry], Field(min_length=1)]
    name: str | None = None
    convention: Literal["standard", "modified"] = "standard"
    angles: Literal["rad", "deg"] = "rad"
    base: _Pose | None = None
    tool: _Pose | None = None
    gravity: Three = Field(default_factory=lambda: list(GRAVITY))
    links: list[_BodyEntry | None] | None = None
    payload: _BodyEntry | None = None
    source: str = ""

    @property
    def tool_point(self) -> list[float]:
        """Tool point in the last row's frame, m."""
        if isinstance(self.tool, _PlacementEntry):
            return self.tool.xyz
        return [0.0, 0.0, 0.0] if self.tool is None else [row[3] for row in self.tool[:3]]


# ---- the arm -----------------------------------------------------------------------------------------------------


def build_arm(table: ArmFile, path: Path) -> Arm:
    """Build the arm of these keys; without a name it is named after the file.

    Raises:
        ArmError: A row, body or pose is wrong.
    """
    radians_per_unit = np.pi / 180 if table.angles == "deg" else 1.0
    for number, row in enumerate(table.rows if table.angles == "rad" else (), start=1):
        for key, angle in (("alpha", row.alpha), ("theta", row.theta)):
            if abs(angle) > _MAX_PLAUSIBLE_ANGLE_RAD:
                print_warning(
                    f"{path.name}: {key} of row {number} is {angle:g} rad, {abs(angle) / (2 * np.pi):.3g} turns; if it is in "
                    "degrees, add 'angles: deg'"
                )
    links = table.links
    return Arm.from_dh(
        [_build_row(row, radians_per_unit) for row in table.rows],
        None
        if links is None
        else [None if body is None else _build_link(body, f"link{index + 1}") for index, body in enumerate(links)],
        table.convention,
        base=_build_pose(table.base, radians_per_unit),
        tool=_build_pose(table.tool, radians_per_unit),
        gravity=table.gravity,
        payload=None if table.payload is None else _build_link(table.payload, "payload"),
        name=table.name or path.stem,
        source=table.source or path.name,
    )


def _build_row(row: _RowEntry, unit: float) -> DH:
    joint_unit = 1.0 if row.type == "prismatic" else unit
    in_joint_unit = {
        key: None if (value := getattr(row, key)) is None else value * joint_unit for key in ("lower", "upper", "velocity")
    }
    return DH(**{**row.model_dump(), **in_joint_unit, "alpha": row.alpha * unit, "theta": row.theta * unit})


def _build_link(body: _BodyEntry, label: str) -> Link:
    return Link(body.mass, np.array(body.com), np.array(body.inertia), name=body.name or label)


def _build_pose(pose: list[list[float]] | _PlacementEntry | None, unit: float) -> FloatArray | None:
    if not isinstance(pose, _PlacementEntry):
        return None if pose is None else np.array(pose)
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rpy_rotation([angle * unit for angle in pose.urdf_rpy]), pose.xyz
    return matrix
