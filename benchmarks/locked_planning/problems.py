"""Problems: MotionBenchMaker's Panda problems, healthy and with every joint locked at two values."""

from __future__ import annotations

import csv
import json
import os
import re
import tarfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from benchmarks.locked_planning.validator import forward_kinematics
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Json = dict[str, Any]

SOURCE_VARIABLE = "MOTIONBENCHMAKER_PANDA"  # path of the archive, or of its problems as JSON
STARTS_IN_CONTACT = ("table_pick/0041",)  # everybody skips this problem
JOINTS = [f"panda_joint{number}" for number in range(1, 8)]
LOCKS_FILE = Path(__file__).with_name("locks.csv")
DRAW_SEED = 52
LOCKED_COUNT = 700  # problems of the fixed draw, out of 9,786


@dataclass(frozen=True, eq=False)
class Problem:
    """One planning problem.

    Attributes:
        name: Scene and number, ``box/0007``; with a lock also the joint and the kind of its value, ``box/0007/j4/start``.
        start: (7,) start configuration, rad; the locked joint is at its value.
        goal_pose: (4, 4) pose of the tool to reach, m.
        objects: Boxes, cylinders, capsules, and spheres as in the archive, m.
        joint: Index of the locked joint from 0, or None.
        value: Value of the locked joint, rad.
        goal: (7,) a configuration with this pose, rad, if the joints are healthy.
    """

    name: str
    start: Floats
    goal_pose: Floats
    objects: list[Json]
    joint: int | None = None
    value: float = 0.0
    goal: Floats | None = None

    @property
    def kind(self) -> str:
        """Return ``healthy`` or ``locked``."""
        return "healthy" if self.joint is None else "locked"

    def to_dict(self) -> Json:
        """Return the problem as the validator and the format page describe it."""
        lock = None if self.joint is None else {"joint": self.joint, "value": self.value}
        return {"start": self.start.tolist(), "goal": self.goal_pose.tolist(), "lock": lock, "objects": self.objects}


def find_source(path: str | Path | None) -> Path:
    """Return the path of the problems: the argument, or the environment variable.

    Raises:
        FileNotFoundError: Neither is given, or the file does not exist.
    """
    given = path or os.environ.get(SOURCE_VARIABLE)
    if not given:
        raise FileNotFoundError(
            f"no problems are given; give --problems or set {SOURCE_VARIABLE} to MotionBenchMaker's archive, "
            "resources/panda/problems.tar.bz2 of https://github.com/KavrakiLab/vamp"
        )
    if not Path(given).is_file():
        raise FileNotFoundError(f"the file of the problems, {given}, does not exist")
    return Path(given)


def read_problems(path: str | Path | None = None) -> list[Json]:
    """Return the 700 healthy problems as JSON data, sorted by name, from the archive or from a converted JSON file."""
    source = find_source(path)
    problems = json.loads(source.read_text()) if source.suffix == ".json" else _read_archive(source)
    return sorted(problems, key=lambda problem: str(problem["id"]))


def _read_archive(path: Path) -> list[Json]:
    import yaml

    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    parts: dict[str, Json] = {}
    with tarfile.open(path) as archive:
        for member in archive:
            match = re.fullmatch(r".*?(\w+)_panda/(scene|request)(\d{4})\.yaml", member.name)
            content = archive.extractfile(member) if match else None
            if match and content:
                scene, part, number = match.groups()
                data = yaml.load(content.read(), Loader=loader)
                entry = parts.setdefault(f"{scene}/{number}", {"id": f"{scene}/{number}", "scene": scene})
                entry.update(_read_request(data) if part == "request" else {"objects": _read_scene(data)})
    return list(parts.values())


def _read_request(data: Json) -> Json:
    state = data["start_state"]["joint_state"]
    start = dict(zip(state["name"], state["position"], strict=True))
    goal = {entry["joint_name"]: entry["position"] for entry in data["goal_constraints"][0]["joint_constraints"]}
    return {"start": [round(start[name], 12) for name in JOINTS], "goal": [round(goal[name], 12) for name in JOINTS]}


def _read_scene(data: Json) -> list[Json]:
    """Return the objects of a scene; every object of the archive is one primitive."""
    objects = []
    for entry in data["world"]["collision_objects"]:
        (primitive,), (pose,) = entry["primitives"], entry["primitive_poses"]
        kind, sizes = primitive["type"], primitive["dimensions"]
        shape = {"box": {"size": sizes}, "cylinder": dict(zip(("length", "radius"), sizes, strict=False))}[kind]
        where = {"position": [round(x, 12) for x in pose["position"]], "quaternion_xyzw": pose["orientation"]}
        where["quaternion_xyzw"] = [round(float(x), 12) for x in where["quaternion_xyzw"]]
        objects.append({"name": entry["id"], "kind": kind, **shape, **where})
    return objects


def make_healthy(data: list[Json], robot: Json) -> list[Problem]:
    """Return the healthy problems, 699 of the archive's 700."""
    return [
        Problem(
            entry["id"],
            np.array(entry["start"], dtype=float),
            forward_kinematics(robot, np.array([entry["goal"]]))[1][0],
            entry["objects"],
            goal=np.array(entry["goal"], dtype=float),
        )
        for entry in data
        if entry["id"] not in STARTS_IN_CONTACT
    ]


def make_locked(healthy: list[Problem]) -> list[Problem]:
    """Return the locked problems, 14 per healthy problem: each joint at its start value and at a random value.

    The random values were drawn uniformly within the joint limits until the start configuration of the spheres was free of
    contact. ``locks.csv`` contains them, so that they do not depend on a random number generator.
    """
    with LOCKS_FILE.open(newline="") as lines:
        random_values = {row[0]: [float(value) for value in row[1:]] for row in csv.reader(lines)}
    locked = []
    for problem in healthy:
        for joint in range(7):
            for kind, value in (("start", float(problem.start[joint])), ("random", random_values[problem.name][joint])):
                start = problem.start.copy()
                start[joint] = value
                name = f"{problem.name}/j{joint + 1}/{kind}"
                locked.append(Problem(name, start, problem.goal_pose, problem.objects, joint, value))
    return locked


def draw(problems: list[Problem]) -> list[Problem]:
    """Return the problems of the benchmark in their fixed random order: all healthy ones, or 700 of the locked ones.

    The first N of a draw are a random sample, too.
    """
    order = np.random.default_rng(DRAW_SEED).permutation(len(problems))
    return [problems[index] for index in order][: LOCKED_COUNT if problems[0].joint is not None else None]
