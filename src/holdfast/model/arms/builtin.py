"""Built-in arms: textbook arms in code, and real arms as stripped URDF files with their provenance."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from importlib import resources
from typing import Any, Literal

import numpy as np
import yaml

from holdfast.core.errors import ArmError
from holdfast.core.validation import check_arguments
from holdfast.model.arm.dh import DH
from holdfast.model.arm.machine import Joint, Link
from holdfast.model.arm.model import Arm

DATA_FOLDER = resources.files("holdfast.model.arms").joinpath("data")


@dataclass(frozen=True, kw_only=True)
class Builtin:
    """Facts about a built-in arm that are available without loading it.

    Attributes:
        name: Name for :func:`holdfast.model.arms.load`.
        n: Number of joints.
        summary: One line for lists.
        source: Origin of the numbers, and assumptions.
        licence: SPDX identifier of the file; ``MIT``, holdfast's own, for arms in code.
        home: (n,) configuration inside the limits and away from singularities, rad or m.
        task: Default task of the arm, ``pose``, ``position`` or ``planar``; see :func:`holdfast.model.arm.as_task`.
    """

    name: str
    n: int
    summary: str
    source: str
    licence: str
    home: tuple[float, ...]
    task: Literal["pose", "position", "planar"] = "pose"


def names() -> list[str]:
    """Return the names of the built-in arms, textbook arms first."""
    return list(_builtin_entries())


@check_arguments
def about(name: str) -> Builtin:
    """Return the facts about the built-in arm with this ``name``.

    Raises:
        ArmError: There is no such arm; the message lists all built-in arms.
    """
    return _find_entry(name)[0]


@check_arguments
@cache
def load_builtin(name: str) -> Arm:
    """Return the built-in arm with this ``name``, the same object each time.

    Raises:
        ArmError: There is no such arm; the message lists all built-in arms.
    """
    entry, make = _find_entry(name)
    return replace(make(), name=name, source=entry.source, states={"home": np.array(entry.home)})


def _find_entry(name: str) -> tuple[Builtin, Callable[[], Arm]]:
    entries = _builtin_entries()
    if name not in entries:
        close_names = difflib.get_close_matches(name.lower(), entries, n=1, cutoff=0.5)
        suggestion = f"did you mean '{close_names[0]}'? " if close_names else ""
        raise ArmError(f"there is no built-in arm '{name}'; {suggestion}the built-in arms are {', '.join(entries)}")
    return entries[name]


@cache
def _builtin_entries() -> dict[str, tuple[Builtin, Callable[[], Arm]]]:
    origins: dict[str, dict[str, Any]] = yaml.safe_load(DATA_FOLDER.joinpath("provenance.yaml").read_text(encoding="utf-8"))

    def make_code_entry(
        name: str,
        make: Callable[[], Arm],
        home_deg: tuple[float, ...],
        summary: str,
        source: str,
        task: Literal["pose", "planar"],
    ) -> tuple[Builtin, Callable[[], Arm]]:
        return Builtin(
            name=name, n=len(home_deg), summary=summary, source=source, licence="MIT", home=_to_radians(home_deg), task=task
        ), make

    rod_source = (
        "textbook arm: links of 1 m and 1 kg, uniform thin rods (inertia m l^2/12 about the two axes across the rod, 0 about "
        "the rod), moving in the world's x-y plane with gravity along -y, limits +-180 deg"
    )
    entries = [
        make_code_entry("planar-2r", lambda: _planar_arm(2), (30, 60), "planar arm, two unit links", rod_source, "planar"),
        make_code_entry(
            "planar-3r", lambda: _planar_arm(3), (30, 45, 60), "planar arm, three unit links", rod_source, "planar"
        ),
        make_code_entry(
            "pa10-7dof",
            _pa10_seven_joints,
            (0, 30, 0, 90, 0, 60, 0),
            "Mitsubishi PA10-7C, kinematics only",
            "link lengths as in the first joints of Table I of Abdi, Maciejewski and Nahavandi (2012), with the PA10's own "
            "last row; limits from the maker's general specification of the PA10-7C as commonly published, not from the "
            "paper; no inertials",
            "pose",
        ),
        make_code_entry(
            "pa10-9dof",
            _pa10_nine_joints,
            (0, 30, 0, 90, 0, 18, 0, 36, 0),
            "Mitsubishi PA10 with two joints added, kinematics only",
            "Abdi, Maciejewski and Nahavandi (2012), Table I; no inertials",
            "pose",
        ),
    ]
    for name, origin in origins.items():
        entry = _read_file_entry(name, origin)
        entries.append((entry, partial(_load_data_file, origin)))
        if name == "ur5":
            entries.append((_put_on_rail(entry), _ur5_on_rail))
    return {entry.name: (entry, make) for entry, make in entries}


def _to_radians(degrees: Sequence[float]) -> tuple[float, ...]:
    return tuple(np.deg2rad(degrees).tolist())


def _read_file_entry(name: str, origin: Mapping[str, Any]) -> Builtin:
    """Return the facts about an arm whose file has an entry in ``provenance.yaml``."""
    home = tuple(origin["home_rad"]) if "home_rad" in origin else _to_radians(origin["home_deg"])
    source = (
        f"{origin['upstream']}; {origin['original']} of {origin['package']} {origin['version']}, stripped to "
        f"inertials and joints{origin.get('remark', '')}"
    )
    facts = {"summary": origin["summary"], "licence": origin["licence"], "task": origin.get("task", "pose")}
    return Builtin(name=name, n=len(home), source=source, home=home, **facts)


def _put_on_rail(ur5: Builtin) -> Builtin:
    return Builtin(
        name="ur5-rail",
        n=7,
        summary="Universal Robots UR5 on a 2 m rail",
        source=f"{ur5.source}; the rail along y and its carriage with the robot's foot are assumed: range 0 to 2 m, "
        "1 m/s, 500 N, 24 kg, a uniform box of 0.4 x 0.4 x 0.1 m",
        licence=ur5.licence,
        home=(1.0, *ur5.home),
    )


def _load_data_file(origin: Mapping[str, Any]) -> Arm:
    with resources.as_file(DATA_FOLDER.joinpath(origin["file"])) as path:
        arm = Arm.from_urdf(path, origin["base"], origin["tip"])
    if "armature" not in origin:
        return arm
    pairs = zip(arm.joints, origin["armature"], strict=True)
    return replace(arm, joints=tuple(replace(joint, armature=value) for joint, value in pairs))


def _planar_arm(n: int) -> Arm:
    rod = Link(1.0, np.array([-0.5, 0, 0]), np.diag([0, 1 / 12, 1 / 12]), name="rod")
    rows = [DH(a=1.0, alpha=0.0, lower=-np.pi, upper=np.pi) for _ in range(n)]
    return Arm.from_dh(rows, [replace(rod, name=f"rod{index + 1}") for index in range(n)], gravity=(0, -9.81, 0))


def _pa10_arm(d: tuple[float, ...], lower_deg: tuple[float, ...], upper_deg: tuple[float, ...]) -> Arm:
    last_row = len(d) - 1
    twists = [0.0 if k == last_row else (-1) ** (k + 1) * np.pi / 2 for k in range(len(d))]
    limits = zip(np.deg2rad(lower_deg), np.deg2rad(upper_deg), strict=True)
    return Arm.from_dh(
        [
            DH(0.0, alpha, offset, lower=lower, upper=upper)
            for alpha, offset, (lower, upper) in zip(twists, d, limits, strict=True)
        ]
    )


def _pa10_seven_joints() -> Arm:
    limits = (177, 94, 174, 137, 255, 165, 360)
    return _pa10_arm((0.315, 0, 0.45, 0, 0.5, 0, 0.08), tuple(-limit for limit in limits), limits)


def _pa10_nine_joints() -> Arm:
    return _pa10_arm(
        (0.315, 0, 0.45, 0, 0.5, 0, 0.45, 0, 0.08),
        (-45, -15, -45, 45, -45, -27, -45, -9, -45),
        (45, 75, 45, 135, 45, 63, 45, 81, 45),
    )


def _ur5_on_rail() -> Arm:
    ur5 = load_builtin("ur5")
    rail = Joint(
        "rail", "prismatic", np.eye(4), axis=np.array([0.0, 1.0, 0.0]), lower=0.0, upper=2.0, velocity=1.0, effort=500.0
    )
    x, y, z, mass = 0.4, 0.4, 0.1, 24.0
    box_inertia = mass / 12 * np.diag([y * y + z * z, x * x + z * z, x * x + y * y])
    carriage = Link(mass, np.array([0, 0, -z / 2]), box_inertia, name="carriage")
    return replace(ur5, joints=(rail, *ur5.joints), links=(carriage, *ur5.links), chain=None)
