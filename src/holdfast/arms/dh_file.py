"""Arms from YAML files that hold a Denavit-Hartenberg table.

An example with every key; only ``rows``, and ``a`` and ``alpha`` in each row, must be there::

    name: my arm              # default: the file's name
    convention: standard      # or modified; see holdfast.arm.dh.DH
    angles: deg               # unit of alpha, theta, urdf_rpy and of revolute limits and velocities; default rad
    rows:
      - {a: 0, alpha: -90, d: 0.3, lower: -170, upper: 170, name: shoulder, velocity: 90, effort: 120}
      - {a: 0.5, alpha: 0, theta: 90, friction: 0.1, armature: 0.02}     # no lower and upper: no limits
      - {a: 0, alpha: 0, type: prismatic, lower: 0, upper: 0.4}          # metres, whatever the angles are in
    base: {xyz: [0, 0, 0.8], urdf_rpy: [0, 0, 180]}   # in the world; roll, pitch, yaw as URDF: Rz(yaw) Ry(pitch) Rx(roll)
    tool:                                        # pose of the tool in the last row's frame; either form serves for both
      - [1, 0, 0, 0]
      - [0, 1, 0, 0]
      - [0, 0, 1, 0.1]
      - [0, 0, 0, 1]
    gravity: [0, 0, -9.81]    # in the world, m/s^2
    links:                    # one per row, each in its row's frame; null where nothing is known
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
from numpy.typing import ArrayLike, NDArray
from pydantic import BeforeValidator, Discriminator, Field, Tag, ValidationError

from holdfast.arguments import checked
from holdfast.arm.dh import DH
from holdfast.arm.machine import GRAVITY, Link
from holdfast.arm.model import Arm
from holdfast.arm.urdf import rpy_rotation
from holdfast.arms.dh_rows import DHTable
from holdfast.errors import ArmError, InputError
from holdfast.files.yaml import Four, Number, Strict, Three, content, sentence
from holdfast.notice import aside

Array = NDArray[np.float64]
_LARGEST_ANGLE = 2 * np.pi  # rad: an angle of more than a turn is probably in degrees


@checked
def load(path: str | Path) -> Arm:
    """The arm of a YAML file in the format of this module.

    Args:
        path: The file.

    Returns:
        The arm, in rad and m.

    Raises:
        ArmError: The file cannot be read, or an entry is wrong; the sentence names its place, as in ``rows[2].alpha``.
    """
    path = Path(path)
    try:
        return built(ArmFile.model_validate(content(path, "holdfast.arms.dh_file", "rows")), path)
    except ValidationError as error:
        raise ArmError(f"{path.name}: {sentence(error, ArmFile, TAGS)}") from error
    except (ArmError, InputError) as error:
        raise ArmError(f"{path.name}: {error}") from error


def text(
    table: DHTable,
    name: str,
    gravity: ArrayLike = GRAVITY,
    source: str = "",
    *,
    links: Sequence[Link | None] = (),
    payload: Link | None = None,
) -> str:
    """A table as a file in the format of this module, in m and degrees.

    Args:
        table: The rows with their limits, the base and the tool.
        name: Of the arm.
        gravity: (3,) in the world, m/s^2.
        source: Where the numbers come from.
        links: One per row, each in its row's frame, None where nothing is known; no masses are written if there are none.
        payload: In the last row's frame.

    Returns:
        YAML. What is read from it again has the numbers of the table to 1e-14.
    """
    lines = [f"name: {_scalar(name)}", *([f"source: {_scalar(source)}"] if source else []), "angles: deg", "rows:"]
    lines += [f"  - {{{', '.join(f'{key}: {_scalar(x)}' for key, x in _cells(row))}}}" for row in table.rows]
    for key, pose in (("base", table.base), ("tool", table.tool)):
        if not np.array_equal(pose, np.eye(4)):
            lines += [f"{key}:", *[f"  - [{', '.join(_scalar(x) for x in line)}]" for line in (pose + 0.0).tolist()]]
    if not np.array_equal(gravity, GRAVITY):
        lines.append(f"gravity: [{', '.join(_scalar(float(x)) for x in np.asarray(gravity))}]")
    if any(link is not None for link in links):
        lines += ["links:", *[f"  - {_body(link)}" for link in links]]
    lines += [f"payload: {_body(payload)}"] * (payload is not None)
    return "\n".join(lines) + "\n"


def _body(link: Link | None) -> str:
    """A body as one line of YAML; with all digits, because a small inertia is not a small number of digits."""
    if link is None:
        return "null"
    i = link.inertia
    upper = (i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[0, 2], i[1, 2])
    numbers = [", ".join(repr(float(x)) for x in values) for values in (link.com, upper)]
    name = f"name: {_scalar(link.name)}, " if link.name else ""
    return f"{{{name}mass: {float(link.mass)!r}, com: [{numbers[0]}], inertia: [{numbers[1]}]}}"


def _cells(row: DH) -> list[tuple[str, str | float]]:
    """What a row says in m and degrees, without what it need not say."""
    cells: list[tuple[str, str | float]] = [("a", row.a), ("alpha", _degrees(row.alpha))]
    cells += [("d", row.d)] * (row.d != 0) + [("theta", _degrees(row.theta))] * (row.theta != 0)
    sliding = row.type == "prismatic"
    if sliding:
        cells.append(("type", row.type))
    for key in ("lower", "upper", "velocity"):
        value = getattr(row, key)
        if value is not None:
            cells.append((key, value if sliding else _degrees(value)))
    cells += [("effort", row.effort)] if row.effort is not None else []
    cells += [(key, getattr(row, key)) for key in ("friction", "armature") if getattr(row, key)]
    return [*cells, ("name", row.name)] if row.name else cells


def _degrees(angle: float) -> float:
    exact = float(np.rad2deg(angle))
    near = round(exact, 10)
    return near if abs(np.deg2rad(near) - angle) < 1e-15 else exact


def _scalar(value: str | float) -> str:
    """One YAML value; numbers that are whole without their point."""
    if isinstance(value, str):
        listed: str = yaml.safe_dump([value], default_flow_style=True, width=10_000, allow_unicode=True)
        return listed.strip()[1:-1]  # as it is between braces
    near = round(value, 13)
    value = near if abs(value - near) < 1e-15 else value
    return f"{value:.0f}" if value == round(value) and abs(value) < 1e15 else repr(float(value))


# ---- the format --------------------------------------------------------------------------------------------------


def _full_inertia(value: Any) -> Any:
    if isinstance(value, list) and not any(isinstance(x, list) for x in value):
        if len(value) != 6:
            raise ValueError("it must be 6 numbers (xx, yy, zz, xy, xz, yz) or 3 rows of 3")
        xx, yy, zz, xy, xz, yz = value
        return [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
    return value


class _Row(Strict):
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


class _Body(Strict):
    mass: Number
    com: Three
    inertia: Annotated[list[Three], Field(min_length=3, max_length=3), BeforeValidator(_full_inertia)]
    name: str | None = None


class _Placement(Strict):
    xyz: Three = Field(default_factory=lambda: [0.0, 0.0, 0.0])
    urdf_rpy: Three = Field(default_factory=lambda: [0.0, 0.0, 0.0])


TAGS = ("as rows", "as xyz and urdf_rpy")
_Pose = Annotated[
    Annotated[list[Four], Field(min_length=4, max_length=4), Tag(TAGS[0])] | Annotated[_Placement, Tag(TAGS[1])],
    Discriminator(lambda value: TAGS[0] if isinstance(value, list) else TAGS[1]),
]


class ArmFile(Strict):
    """The keys of such a file."""

    rows: Annotated[list[_Row], Field(min_length=1)]
    name: str | None = None
    convention: Literal["standard", "modified"] = "standard"
    angles: Literal["rad", "deg"] = "rad"
    base: _Pose | None = None
    tool: _Pose | None = None
    gravity: Three = Field(default_factory=lambda: list(GRAVITY))
    links: list[_Body | None] | None = None
    payload: _Body | None = None
    source: str = ""

    @property
    def tool_point(self) -> list[float]:
        """The tool point in the last row's frame, m."""
        if isinstance(self.tool, _Placement):
            return self.tool.xyz
        return [0.0, 0.0, 0.0] if self.tool is None else [row[3] for row in self.tool[:3]]


# ---- the arm -----------------------------------------------------------------------------------------------------


def built(table: ArmFile, path: Path) -> Arm:
    """The arm of such keys, named after the file where they give no name.

    Raises:
        ArmError: A row, body or pose is wrong.
    """
    unit = np.pi / 180 if table.angles == "deg" else 1.0
    for number, row in enumerate(table.rows if table.angles == "rad" else (), start=1):
        for key, angle in (("alpha", row.alpha), ("theta", row.theta)):
            if abs(angle) > _LARGEST_ANGLE:
                aside(
                    f"{path.name}: {key} of row {number} is {angle:g} rad, {abs(angle) / (2 * np.pi):.3g} turns; if it is in "
                    "degrees, add 'angles: deg'"
                )
    links = table.links
    return Arm.from_dh(
        [_row(row, unit) for row in table.rows],
        None if links is None else [None if x is None else _link(x, f"link{k + 1}") for k, x in enumerate(links)],
        table.convention,
        base=_pose(table.base, unit),
        tool=_pose(table.tool, unit),
        gravity=table.gravity,
        payload=None if table.payload is None else _link(table.payload, "payload"),
        name=table.name or path.stem,
        source=table.source or path.name,
    )


def _row(row: _Row, unit: float) -> DH:
    moved = 1.0 if row.type == "prismatic" else unit
    in_joint_unit = {key: None if (x := getattr(row, key)) is None else x * moved for key in ("lower", "upper", "velocity")}
    return DH(**{**row.model_dump(), **in_joint_unit, "alpha": row.alpha * unit, "theta": row.theta * unit})


def _link(body: _Body, label: str) -> Link:
    return Link(body.mass, np.array(body.com), np.array(body.inertia), name=body.name or label)


def _pose(pose: list[list[float]] | _Placement | None, unit: float) -> Array | None:
    if not isinstance(pose, _Placement):
        return None if pose is None else np.array(pose)
    out = np.eye(4)
    out[:3, :3], out[:3, 3] = rpy_rotation([angle * unit for angle in pose.urdf_rpy]), pose.xyz
    return out
