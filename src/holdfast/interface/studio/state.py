"""State of a page of the studio as one value that can be written as a command line."""

from __future__ import annotations

import math
import shlex
from dataclasses import KW_ONLY, dataclass
from typing import Literal

from holdfast.core.errors import InputError

Condition = Literal["healthy", "locked", "free"]
Show = Literal["arm", "best-worst", "laws", "fall", "region", "file", "watch"]
JOINT_CONDITIONS: tuple[Condition, ...] = ("healthy", "locked", "free")
DISPLAY_MODES: tuple[Show, ...] = ("arm", "best-worst", "laws", "fall", "region", "file", "watch")


@dataclass(frozen=True)
class State:
    """View of the studio, without its camera position.

    Attributes:
        arm: Arm as given on the command line: a built-in name or a file.
        names: (n,) names of the joints.
        q: (n,) configuration, rad and m.
        task: Task as on the command line.
        base, tip: Links of the file at the ends of the arm. None: automatic.
        hold: Joints of the file that are fixed, with their values, rad or m.
        conditions: (n,) ``healthy``, ``locked`` or ``free`` (swinging) for each joint.
        index: Index of the bars.
        susceptibility: Susceptibility of the bars.
        objective: Index or susceptibility, by name, that defines the best and the worst configuration.
        laws: Two control laws to compare, as ``slug`` or ``slug:setting``.
        target: Target of the end effector under these laws: x, y, z (m) and quaternion x, y, z, w. None: not chosen.
        show: Content in addition to the arm: none (``arm``), ghosts in the ``best-worst`` configuration of this pose, a motion
            under two ``laws``, the ``fall`` after a power loss, the cloud of a ``region``, or the motion of a ``file``.
        file: File of a motion from ``follow``, ``simulate`` or ``recover``, or None.
        region: Results folder of ``assess``. None: a region around the end effector.
        time: Time of the shown motion, s (or the unit of its first column).
        cell: Cell file. None: no objects.
        meshes: Folder that is searched first for meshes of the arm's file, or None.
        fault: Injected fault: kind, joint and onset, s. An empty joint name means the middle joint. The fault is not part of
            the command line.
        friction: Dry friction of every joint in a power loss, N m or N. None: as the arm states. It is not part of the command
            line.
        moved: Objects of the cell that were dragged, each with its name and x, y, z (m) and quaternion x, y, z, w.
    """

    arm: str
    names: tuple[str, ...]
    q: tuple[float, ...]
    _: KW_ONLY
    task: str = "pose"
    base: str | None = None
    tip: str | None = None
    hold: tuple[tuple[str, float], ...] = ()
    conditions: tuple[Condition, ...] = ()
    index: str = "relative-manipulability"
    susceptibility: str = "torque"
    objective: str = "relative-manipulability"
    laws: tuple[str, str] = ("pseudoinverse", "failure-tolerant")
    target: tuple[float, ...] | None = None
    show: Show = "arm"
    file: str | None = None
    region: str | None = None
    time: float = 0.0
    cell: str | None = None
    meshes: str | None = None
    moved: tuple[tuple[str, tuple[float, ...]], ...] = ()
    fault: tuple[str, str, float] = ("locked", "", 1.0)
    friction: float | None = None

    def __post_init__(self) -> None:
        n = len(self.names)
        if len(self.q) != n:
            raise InputError(f"q has {len(self.q)} values; '{self.arm}' has {n} joints, so it must have {n}")
        conditions = self.conditions or ("healthy",) * n
        if len(conditions) != n or any(condition not in JOINT_CONDITIONS for condition in conditions):
            raise InputError(
                f"conditions are {conditions}; give one of {', '.join(JOINT_CONDITIONS)} for each of the {n} joints"
            )
        if self.show not in DISPLAY_MODES:
            raise InputError(f"show is '{self.show}'; use one of {', '.join(DISPLAY_MODES)}")
        poses = [*(() if self.target is None else [("target", self.target)]), *self.moved]
        for name, numbers in poses:
            if len(numbers) != 7 or not any(numbers[3:]):
                raise InputError(f"{name} has the numbers {numbers}; give x,y,z in m and a quaternion x,y,z,w other than 0")
        others = [self.time, self.fault[2], self.friction or 0.0, *(value for _, value in self.hold)]
        if not all(map(math.isfinite, [*self.q, *others, *(number for _, numbers in poses for number in numbers)])):
            raise InputError("a number of the view is infinite or not a number; give finite ones")
        object.__setattr__(self, "conditions", tuple(conditions))
        kind, joint, onset = self.fault
        object.__setattr__(self, "fault", (kind, joint or self.names[n // 2], onset))

    @property
    def failed_joints(self) -> tuple[int, ...]:
        """Indices from 0 of the joints that the controller cannot move: locked, or free until brakes stop them."""
        return tuple(k for k, c in enumerate(self.conditions) if c != "healthy")

    @property
    def free(self) -> tuple[int, ...]:
        """Indices from 0 of the joints that swing freely."""
        return tuple(k for k, c in enumerate(self.conditions) if c == "free")

    @property
    def powerless(self) -> tuple[int, ...]:
        """Indices from 0 of the joints that fall in a power loss: the free ones, or all that are not locked if none is free."""
        return self.free or tuple(k for k, condition in enumerate(self.conditions) if condition != "locked")

    def arguments(self) -> list[str]:
        """Return the arguments of ``holdfast`` that restore this state: q and the differences from the defaults."""
        defaults = State(self.arm, self.names, self.q)
        options = ["studio", self.arm, f"--q={','.join(repr(float(number)) for number in self.q)}", f"--task={self.task}"]
        for option, value in (("base", self.base), ("tip", self.tip)):
            options += [] if value is None else [f"--{option}={value}"]
        options += [f"--hold={name}={value!r}" for name, value in self.hold]
        for name, condition in zip(self.names, self.conditions, strict=True):
            options += [] if condition == "healthy" else [f"--{'lock' if condition == 'locked' else 'free'}={name}"]
        for option in ("index", "susceptibility", "objective", "show"):
            value = getattr(self, option)
            value = defaults.show if value == "watch" else value
            options += [] if value == getattr(defaults, option) else [f"--{option}={value}"]
        if self.laws != defaults.laws:
            options += [f"--law={law}" for law in self.laws]
        if self.target is not None:
            options.append(f"--target={','.join(repr(float(number)) for number in self.target)}")
        for option in ("file", "region", "cell", "meshes"):
            text = getattr(self, option)
            options += [] if text is None else [f"--{option}={text}"]
        options += [f"--move={name}={','.join(repr(float(number)) for number in numbers)}" for name, numbers in self.moved]
        if self.time:
            options.append(f"--time={self.time!r}")
        return options

    def to_command(self) -> str:
        """Return the command line that restores this state."""
        return f"holdfast {shlex.join(self.arguments())}"
