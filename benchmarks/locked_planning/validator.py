"""Validator: decide whether a path solves a problem, in plain NumPy that shares no code with any planner.

A robot is a dictionary: ``lower`` and ``upper`` (7,) in rad, ``joint_origins`` (7, 4, 4), each in the frame of the previous
link at angle 0 and with the joint axis along its z axis, ``tool`` (4, 4) in the frame of the last link, ``spheres`` with
``link`` (0 is the base), ``center``, and ``radius`` in m, and ``self_pairs``, the pairs of links that must not touch.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Json = dict[str, Any]

MAX_JOINT_STEP_RAD = 2e-3
LOCK_TOLERANCE_RAD = 1e-9
LIMIT_TOLERANCE_RAD = 1e-9
POSITION_TOLERANCE_M = 1e-3
ORIENTATION_TOLERANCE_RAD = np.deg2rad(0.5)
BATCH_CONFIGURATIONS = 2048


@dataclass(frozen=True)
class Verdict:
    """Verdict about a path.

    Attributes:
        kind: First violation in the order ``path``, ``start``, ``limits``, ``lock``, ``goal``, ``contact``; empty if accepted.
        sentence: Verdict in one sentence.
    """

    kind: str
    sentence: str

    @property
    def is_accepted(self) -> bool:
        """Return True if the path solves the problem."""
        return not self.kind


def forward_kinematics(robot: Json, q: Floats) -> tuple[Floats, Floats]:
    """Return the poses of the links (N, 8, 4, 4), the base first, and of the tool (N, 4, 4), m, at angles (N, 7), rad."""
    poses = np.empty((len(q), len(robot["joint_origins"]) + 1, 4, 4))
    poses[:, 0] = np.eye(4)
    for joint, origin in enumerate(np.asarray(robot["joint_origins"])):
        placed = poses[:, joint] @ origin
        cosine, sine = np.cos(q[:, joint, None]), np.sin(q[:, joint, None])
        poses[:, joint + 1] = placed
        poses[:, joint + 1, :, 0] = cosine * placed[..., 0] + sine * placed[..., 1]
        poses[:, joint + 1, :, 1] = cosine * placed[..., 1] - sine * placed[..., 0]
    return poses, poses[:, -1] @ np.asarray(robot["tool"])


def rotation_matrix(quaternion_xyzw: Floats) -> Floats:
    """Return the rotation (3, 3) of a quaternion of any length above 0."""
    x, y, z, w = np.asarray(quaternion_xyzw) / np.linalg.norm(quaternion_xyzw)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def signed_distances(shape: Json, points: Floats) -> Floats:
    """Return the exact signed distances (...) of points (..., 3) to an object, m; negative inside."""
    kind = shape["kind"]
    local = (points - np.asarray(shape["position"])) @ rotation_matrix(shape["quaternion_xyzw"])
    if kind == "box":
        excess = np.abs(local) - np.asarray(shape["size"]) / 2
    elif kind == "cylinder":
        radial = np.hypot(local[..., 0], local[..., 1]) - shape["radius"]
        excess = np.stack([radial, np.abs(local[..., 2]) - shape["length"] / 2], axis=-1)
    elif kind in ("capsule", "sphere"):  # the length of a capsule is that between the centers of its caps
        half_length = shape["length"] / 2 if kind == "capsule" else 0.0
        local[..., 2] -= np.clip(local[..., 2], -half_length, half_length)
        return np.asarray(np.linalg.norm(local, axis=-1) - shape["radius"])
    else:
        raise ValueError(f"the kind of object '{shape['name']}' is {kind}; it must be box, cylinder, capsule, or sphere")
    return np.asarray(np.linalg.norm(np.maximum(excess, 0.0), axis=-1) + np.minimum(excess.max(axis=-1), 0.0))


class SphereContacts:
    """Contacts of a sphere robot with objects and with itself.

    A bounding sphere per link is tested first; the spheres of a link are tested only where its bounding sphere is too close.
    """

    def __init__(self, robot: Json, objects: list[Json]) -> None:
        self.robot, self.objects = robot, objects
        links = np.array([sphere["link"] for sphere in robot["spheres"]])
        centers = np.array([sphere["center"] for sphere in robot["spheres"]], dtype=float)
        radii = np.array([sphere["radius"] for sphere in robot["spheres"]], dtype=float)
        self.links = sorted({int(link) for link in links})
        self.centers = {link: centers[links == link] for link in self.links}
        self.radii = {link: radii[links == link] for link in self.links}
        self.middle = {link: self.centers[link].mean(axis=0) for link in self.links}
        self.reach = {
            link: float((np.linalg.norm(self.centers[link] - self.middle[link], axis=1) + self.radii[link]).max())
            for link in self.links
        }

    def distances(self, q: Floats) -> tuple[Floats, list[str]]:
        """Return the smallest distance (N,) at each configuration (N, 7), m, and the names of the closest parts.

        The distance is exact where it is below 0, and a lower bound of the distance elsewhere.
        """
        poses, _ = forward_kinematics(self.robot, q)
        smallest, names = np.full(len(q), np.inf), [""] * len(q)

        def keep(rows: NDArray[np.intp], values: Floats, name: str) -> None:
            closer = values < smallest[rows]
            smallest[rows[closer]] = values[closer]
            for row in rows[closer]:
                names[row] = name

        def place(link: int, points: Floats, rows: Any = slice(None)) -> Floats:
            return np.asarray(points @ poses[rows, link, :3, :3].swapaxes(-1, -2) + poses[rows, link, None, :3, 3])

        every = np.arange(len(q))
        middles = {link: place(link, self.middle[link][None]) for link in self.links}
        for link in self.links:
            for shape in self.objects:
                bound = signed_distances(shape, middles[link][:, 0]) - self.reach[link]
                near = np.flatnonzero(bound < 0)
                keep(every[bound >= 0], bound[bound >= 0], f"link {link} and '{shape['name']}'")
                if len(near):
                    exact = signed_distances(shape, place(link, self.centers[link], near)) - self.radii[link]
                    keep(near, exact.min(axis=1), f"link {link} and '{shape['name']}'")
        for first, second in self.robot["self_pairs"]:
            gap = np.linalg.norm(middles[first][:, 0] - middles[second][:, 0], axis=-1)
            bound = gap - self.reach[first] - self.reach[second]
            near = np.flatnonzero(bound < 0)
            keep(every[bound >= 0], bound[bound >= 0], f"link {first} and link {second}")
            if len(near):
                one, other = place(first, self.centers[first], near), place(second, self.centers[second], near)
                gaps = np.linalg.norm(one[:, :, None] - other[:, None], axis=-1)
                exact = gaps - self.radii[first][:, None] - self.radii[second]
                keep(near, exact.min(axis=(1, 2)), f"link {first} and link {second}")
        return smallest, names


def interpolate(path: Floats) -> tuple[Floats, Floats]:
    """Return configurations along a path at steps of at most 2 mrad of a joint, and the fractional waypoint index of each."""
    counts = np.maximum(np.ceil(np.abs(np.diff(path, axis=0)).max(axis=1, initial=0.0) / MAX_JOINT_STEP_RAD), 1).astype(int)
    parts = [index + np.arange(count) / count for index, count in enumerate(counts)]
    index = np.concatenate([*parts, [len(path) - 1.0]])
    return np.stack([np.interp(index, np.arange(len(path)), column) for column in path.T], axis=1), index


def validate(
    robot: Json, problem: Json, path: Any, make_contacts: Callable[[Json, list[Json]], Any] = SphereContacts
) -> Verdict:
    """Return the verdict about a path (K, 7), rad, with straight lines in joint space between its waypoints.

    Args:
        robot: Robot as numbers, see the module.
        problem: ``start`` (7,), ``goal`` (4, 4), ``objects``, and ``lock``, which is None or has ``joint`` and ``value``.
        path: Waypoints.
        make_contacts: Class of the contacts; the track *meshes* has its own.
    """
    try:
        waypoints = np.array(path, dtype=float)
    except (TypeError, ValueError):
        return Verdict("path", "refused: the path is not a list of rows of numbers")
    size = len(robot["lower"])
    if waypoints.ndim != 2 or waypoints.shape[1] != size or not len(waypoints) or not np.isfinite(waypoints).all():
        return Verdict("path", f"refused: the path has shape {waypoints.shape}; it must be rows of {size} finite numbers")
    if (miss := float(np.abs(waypoints[0] - problem["start"]).max())) > LOCK_TOLERANCE_RAD:
        return Verdict("start", f"refused: the path begins {miss:.3g} rad from the start configuration")
    excess = np.maximum(np.asarray(robot["lower"]) - waypoints, waypoints - np.asarray(robot["upper"]))
    if (worst := float(excess.max())) > LIMIT_TOLERANCE_RAD:
        row, joint = divmod(int(excess.argmax()), size)
        return Verdict("limits", f"refused: joint {joint + 1} is {worst:.3g} rad outside its limits at waypoint {row}")
    lock = problem.get("lock")
    if lock and (moved := float(np.abs(waypoints[:, lock["joint"]] - lock["value"]).max())) > LOCK_TOLERANCE_RAD:
        return Verdict("lock", f"refused: the locked joint {lock['joint'] + 1} is {moved:.3g} rad from its value")
    tool, goal = forward_kinematics(robot, waypoints[-1:])[1][0], np.asarray(problem["goal"])
    position = float(np.linalg.norm(tool[:3, 3] - goal[:3, 3]))
    turn = tool[:3, :3].T @ goal[:3, :3]
    sine = np.linalg.norm([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
    angle = float(np.arctan2(sine, (np.trace(turn) - 1) / 2))
    if position > POSITION_TOLERANCE_M or angle > ORIENTATION_TOLERANCE_RAD:
        return Verdict("goal", f"refused: the tool ends {1e3 * position:.3g} mm and {np.rad2deg(angle):.3g} deg from the goal")
    q, index = interpolate(waypoints)
    contacts = make_contacts(robot, problem["objects"])
    for begin in range(0, len(q), BATCH_CONFIGURATIONS):
        distances, names = contacts.distances(q[begin : begin + BATCH_CONFIGURATIONS])
        if (distances < 0).any():
            first = int(np.argmax(distances < 0))
            place = f"at waypoint {index[begin + first]:.3f} of {len(waypoints) - 1}"
            return Verdict("contact", f"refused: {names[first]} overlap by {-1e3 * distances[first]:.3g} mm {place}")
    return Verdict("", f"accepted: {len(q)} configurations are free of contact")
