"""Arms that come with holdfast: textbook arms in code, real ones as stripped URDF files with their provenance."""

from __future__ import annotations

import difflib
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from importlib import resources
from typing import Any, Literal

import numpy as np
import yaml

from holdfast.arguments import checked
from holdfast.arm.dh import DH
from holdfast.arm.machine import Joint, Link
from holdfast.arm.model import Arm
from holdfast.errors import ArmError

DATA = resources.files("holdfast.arms").joinpath("data")


@dataclass(frozen=True, kw_only=True)
class Builtin:
    """What is known about a built-in arm without loading it.

    Attributes:
        name: As in :func:`load`.
        n: Number of joints.
        summary: One line for lists.
        source: Where its numbers come from, and what is assumed.
        licence: SPDX identifier of the file it is read from; ``MIT``, holdfast's own, for arms in code.
        home: (n,) a configuration inside the limits and away from singularities, rad or m.
        task: The task that suits the arm, ``pose`` or ``planar``; see :func:`holdfast.arm.as_task`.
    """

    name: str
    n: int
    summary: str
    source: str
    licence: str
    home: tuple[float, ...]
    task: Literal["pose", "planar"] = "pose"


def names() -> list[str]:
    """Names of the built-in arms, textbook arms first."""
    return list(_entries())


@checked
def about(name: str) -> Builtin:
    """What is known about a built-in arm.

    Raises:
        ArmError: There is no such arm; the message lists those there are.
    """
    return _entry(name)[0]


@checked
@cache
def load(name: str) -> Arm:
    """A built-in arm; the same object each time.

    Raises:
        ArmError: There is no such arm; the message lists those there are.
    """
    entry, make = _entry(name)
    return replace(make(), name=name, source=entry.source, states={"home": np.array(entry.home)})


def _entry(name: str) -> tuple[Builtin, Callable[[], Arm]]:
    entries = _entries()
    if name not in entries:
        close = difflib.get_close_matches(name.lower(), entries, n=1, cutoff=0.5)
        guess = f"did you mean '{close[0]}'? " if close else ""
        raise ArmError(f"there is no built-in arm '{name}'; {guess}the built-in arms are {', '.join(entries)}")
    return entries[name]


@cache
def _entries() -> dict[str, tuple[Builtin, Callable[[], Arm]]]:
    origins: dict[str, dict[str, Any]] = yaml.safe_load(DATA.joinpath("provenance.yaml").read_text(encoding="utf-8"))

    def in_code(
        name: str,
        make: Callable[[], Arm],
        home_deg: tuple[float, ...],
        summary: str,
        source: str,
        task: Literal["pose", "planar"],
    ) -> tuple[Builtin, Callable[[], Arm]]:
        return Builtin(
            name=name, n=len(home_deg), summary=summary, source=source, licence="MIT", home=_rad(home_deg), task=task
        ), make

    def from_file(
        name: str, base: str, tip: str, home: tuple[float, ...], summary: str, remark: str = ""
    ) -> tuple[Builtin, Callable[[], Arm]]:
        o = origins[name]
        source = f"{o['upstream']}; {o['original']} of {o['package']} {o['version']}, stripped to inertials and joints{remark}"
        return Builtin(name=name, n=len(home), summary=summary, source=source, licence=o["licence"], home=home), lambda: _file(
            o["file"], base, tip
        )

    rods = (
        "textbook arm: links of 1 m and 1 kg, uniform thin rods (inertia m l^2/12 about the two axes across the rod, 0 about "
        "the rod), moving in the world's x-y plane with gravity along -y, limits +-180 deg"
    )
    ur5 = from_file("ur5", "base_link", "tool0", _rad((0, -90, 90, -45, -90, 0)), "Universal Robots UR5, not redundant")
    entries = [
        in_code("planar-2r", lambda: _planar(2), (30, 60), "planar arm, two unit links", rods, "planar"),
        in_code("planar-3r", lambda: _planar(3), (30, 45, 60), "planar arm, three unit links", rods, "planar"),
        in_code(
            "pa10-7dof",
            _pa10_7,
            (0, 30, 0, 90, 0, 60, 0),
            "Mitsubishi PA10-7C, kinematics only",
            "link lengths as in the first joints of Table I of Abdi, Maciejewski and Nahavandi (2012), with the PA10's own "
            "last row; limits from the maker's general specification of the PA10-7C as commonly published, not from the "
            "paper; no inertials",
            "pose",
        ),
        in_code(
            "pa10-9dof",
            _pa10_9,
            (0, 30, 0, 90, 0, 18, 0, 36, 0),
            "Mitsubishi PA10 with two joints added, kinematics only",
            "Abdi, Maciejewski and Nahavandi (2012), Table I; no inertials",
            "pose",
        ),
        from_file(
            "panda",
            "panda_link0",
            "panda_hand_tcp",
            _rad((0, -45, 0, -135, 0, 90, 45)),
            "Franka Emika Panda with hand, fingers shut",
            ", collision shapes kept",
        ),
        from_file("xarm7", "link_base", "link_eef", _rad((0, -20, 0, 50, 0, 70, 0)), "UFACTORY xArm7"),
        from_file(
            "iiwa14",
            "lbr_iiwa_link_0",
            "lbr_iiwa_link_7",
            _rad((0, 30, 0, -75, 0, 75, 0)),
            "KUKA LBR iiwa 14 R820",
            "; its masses, inertias, efforts (300 N m) and speeds (10 rad/s) are round placeholders, not the maker's",
        ),
        ur5,
        (
            Builtin(
                name="ur5-rail",
                n=7,
                summary="Universal Robots UR5 on a 2 m rail",
                source=f"{ur5[0].source}; the rail along y and its carriage with the robot's foot are assumed: range 0 to 2 m, "
                "1 m/s, 500 N, 24 kg, a uniform box of 0.4 x 0.4 x 0.1 m",
                licence=ur5[0].licence,
                home=(1.0, *ur5[0].home),
            ),
            _ur5_rail,
        ),
        from_file(
            "kinova-j2s6s200",
            "base",
            "j2s6s200_end_effector",
            _rad((275, 165, 60, 240, 85, 75)),
            "Kinova Jaco 2 (j2s6s200), three joints without limits, not redundant",
        ),
    ]
    return {entry.name: (entry, make) for entry, make in entries}


def _rad(degrees: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(np.deg2rad(degrees).tolist())


def _file(file: str, base: str, tip: str) -> Arm:
    with resources.as_file(DATA.joinpath(file)) as path:
        return Arm.from_urdf(path, base, tip)


def _planar(n: int) -> Arm:
    rod = Link(1.0, np.array([-0.5, 0, 0]), np.diag([0, 1 / 12, 1 / 12]), name="rod")
    rows = [DH(a=1.0, alpha=0.0, lower=-np.pi, upper=np.pi) for _ in range(n)]
    return Arm.from_dh(rows, [replace(rod, name=f"rod{k + 1}") for k in range(n)], gravity=(0, -9.81, 0))


def _pa10(d: tuple[float, ...], lower_deg: tuple[float, ...], upper_deg: tuple[float, ...]) -> Arm:
    last = len(d) - 1
    twist = [0.0 if k == last else (-1) ** (k + 1) * np.pi / 2 for k in range(len(d))]
    limits = zip(np.deg2rad(lower_deg), np.deg2rad(upper_deg), strict=True)
    return Arm.from_dh([DH(0.0, t, x, lower=lo, upper=up) for t, x, (lo, up) in zip(twist, d, limits, strict=True)])


def _pa10_7() -> Arm:
    limits = (177, 94, 174, 137, 255, 165, 360)
    return _pa10((0.315, 0, 0.45, 0, 0.5, 0, 0.08), tuple(-x for x in limits), limits)


def _pa10_9() -> Arm:
    return _pa10(
        (0.315, 0, 0.45, 0, 0.5, 0, 0.45, 0, 0.08),
        (-45, -15, -45, 45, -45, -27, -45, -9, -45),
        (45, 75, 45, 135, 45, 63, 45, 81, 45),
    )


def _ur5_rail() -> Arm:
    ur5 = load("ur5")
    rail = Joint(
        "rail", "prismatic", np.eye(4), axis=np.array([0.0, 1.0, 0.0]), lower=0.0, upper=2.0, velocity=1.0, effort=500.0
    )
    x, y, z, mass = 0.4, 0.4, 0.1, 24.0
    box = mass / 12 * np.diag([y * y + z * z, x * x + z * z, x * x + y * y])
    carriage = Link(mass, np.array([0, 0, -z / 2]), box, name="carriage")
    return replace(ur5, joints=(rail, *ur5.joints), links=(carriage, *ur5.links), chain=None)
