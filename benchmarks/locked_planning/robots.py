"""Robot models of the two tracks as numbers, and as URDF, SRDF, and STL files for planners that read files."""

from __future__ import annotations

import json
import os
import xml.etree.ElementTree as ET
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Json = dict[str, Any]

ROBOT_VARIABLE = "VAMP_PANDA_SPHERES"  # path of VAMP's panda_spherized.urdf, or of a robot as JSON
BASE, LAST_LINK, TOOL = "panda_link0", "panda_link7", "panda_grasptarget"
SELF_PAIRS = [[0, 5], [0, 6], [0, 7], [1, 5], [1, 6], [1, 7], [2, 5], [2, 7], [5, 7]]  # of the archive's collision matrix
FINGER_POSITION_M = 0.065  # of the archive and the sphere model, further apart than the real gripper opens (0.04)


def load_robot(track: str, path: str | Path | None = None) -> Json:
    """Return the robot of a track as the dictionary of :mod:`validator`; with ``meshes`` it has ``pieces``, not ``spheres``.

    Both tracks need the sphere robot, because its kinematics and limits define the problems.

    Raises:
        FileNotFoundError: No file of the sphere robot is given, or it does not exist.
    """
    given = path or os.environ.get(ROBOT_VARIABLE)
    if not given or not Path(given).is_file():
        reason = f"the file of the robot, {given}, does not exist" if given else "no file of the robot is given"
        raise FileNotFoundError(
            f"{reason}; give --robot or set {ROBOT_VARIABLE} to resources/panda/panda_spherized.urdf of "
            "https://github.com/KavrakiLab/vamp"
        )
    text = Path(given).read_text()
    robot = _read_json(json.loads(text)) if str(given).endswith(".json") else _read_urdf(text)
    if track == "meshes":
        del robot["spheres"]
        robot["pieces"] = _mesh_pieces(np.asarray(robot["tool"])[:3, 1])
    return robot


def _read_json(data: Json) -> Json:
    spheres = [
        {"link": entry["link"], "center": entry.get("center", entry.get("centre")), "radius": entry["radius"]}
        for entry in data["spheres"]
    ]
    kept = {key: data[key] for key in ("lower", "upper", "joint_origins", "tool")}
    return {**kept, "spheres": spheres, "self_pairs": SELF_PAIRS}


def _read_urdf(text: str) -> Json:
    """Return the chain from the base to the last link; fixed links beyond it belong to the last link."""
    root = ET.fromstring(text)
    joints = {_get(joint, "child", "link"): joint for joint in root.iter("joint") if joint.find("child") is not None}
    robot: Json = {"lower": [], "upper": [], "joint_origins": [], "self_pairs": SELF_PAIRS, "spheres": []}
    chain: list[ET.Element] = []
    name = LAST_LINK
    while name != BASE:
        chain.insert(0, joints[name])
        name = _get(joints[name], "parent", "link")
    for joint in chain:
        robot["joint_origins"].append(_origin(joint).tolist())
        for side in ("lower", "upper"):
            robot[side].append(float(_get(joint, "limit", side)))
    links = {BASE: 0} | {_get(joint, "child", "link"): index + 1 for index, joint in enumerate(chain)}

    def place(name: str) -> tuple[int, Floats]:
        if name in links:
            return links[name], np.eye(4)
        link, pose = place(_get(joints[name], "parent", "link"))
        return link, pose @ _origin(joints[name])

    robot["tool"] = place(TOOL)[1].tolist()
    for element in root.iter("link"):
        for collision in element.iter("collision"):
            link, pose = place(element.attrib["name"])
            center = (pose @ _origin(collision))[:3, 3].tolist()
            radius = float(_get(collision, "geometry/sphere", "radius"))
            robot["spheres"].append({"link": link, "center": center, "radius": radius})
    robot["spheres"].sort(key=lambda sphere: sphere["link"])
    return robot


def _get(element: ET.Element, path: str, key: str) -> str:
    child = element.find(path)
    if child is None:
        raise ValueError(f"<{element.tag}> of the robot's URDF has no <{path}>")
    return child.attrib[key]


def _origin(element: ET.Element) -> Floats:
    origin = element.find("origin")
    xyz, rpy = (
        [float(x) for x in (origin.get(key, "0 0 0") if origin is not None else "0 0 0").split()] for key in ("xyz", "rpy")
    )
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    pose = np.eye(4)
    pose[:3, :3] = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    pose[:3, 3] = xyz
    return pose


def _mesh_pieces(finger_axis: Floats) -> list[Json]:
    """Return the collision meshes and boxes of holdfast's built-in Panda, in the frames of the links that they move with.

    The fingers move along the axis, a unit vector in the frame of the last link.
    """
    import holdfast as hf

    panda, cell = hf.arms.load("panda"), hf.Cell([], shape="meshes", hold={"panda_finger_joint1": 0.0})
    pieces = []
    shape = hf.Clearance(panda, cell=cell).capsules.shape
    for piece in [] if shape is None else shape.pieces:
        vertices, faces = _box_mesh(piece.size) if piece.kind == "box" else (piece.vertices, piece.faces)
        pose = np.array(piece.pose)
        sign = {"panda_leftfinger": 1.0, "panda_rightfinger": -1.0}.get(piece.owner, 0.0)
        pose[:3, 3] += sign * FINGER_POSITION_M * finger_axis
        placed = np.asarray(vertices) @ pose[:3, :3].T + pose[:3, 3]
        pieces.append({"link": piece.link + 1, "vertices": placed, "faces": np.asarray(faces, dtype=int)})
    return pieces


def _box_mesh(size: Any) -> tuple[Floats, NDArray[np.int64]]:
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * np.asarray(size) / 2
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]  # outward normals
    return corners, np.array([[a, *pair] for a, b, c, d in quads for pair in ((b, c), (c, d))])


def write_files(robot: Json, folder: Path) -> Path:
    """Write ``robot.urdf``, ``robot.srdf``, and the meshes of a robot into a folder, and return the path of the URDF file."""
    folder.mkdir(parents=True, exist_ok=True)
    collisions = [""] * 8
    for sphere in robot.get("spheres", []):
        collisions[sphere["link"]] += _collision(f'<sphere radius="{float(sphere["radius"])!r}"/>', sphere["center"])
    for index, piece in enumerate(robot.get("pieces", [])):
        file = folder / f"piece{index}.stl"
        _write_stl(file, piece["vertices"][piece["faces"]])
        collisions[piece["link"]] += _collision(f'<mesh filename="{file}"/>', (0, 0, 0))
    parts = [f'<link name="link{index}">{content}</link>' for index, content in enumerate(collisions)]
    for index, pose in enumerate(np.asarray(robot["joint_origins"])):
        lower, upper = (float(robot[side][index]) for side in ("lower", "upper"))
        limit = f'<axis xyz="0 0 1"/><limit lower="{lower!r}" upper="{upper!r}" velocity="2" effort="87"/>'
        parts.append(_joint(f"joint{index + 1}", "revolute", f"link{index}", f"link{index + 1}", pose, limit))
    parts += ['<link name="tool"/>', _joint("tool_joint", "fixed", "link7", "tool", np.asarray(robot["tool"]), "")]
    (folder / "robot.urdf").write_text('<robot name="panda">' + "\n".join(parts) + "</robot>\n")
    ignored = [pair for pair in combinations(range(8), 2) if list(pair) not in robot["self_pairs"]]
    rows = [f'<disable_collisions link1="link{one}" link2="link{other}" reason="Benchmark"/>' for one, other in ignored]
    (folder / "robot.srdf").write_text('<robot name="panda">' + "\n".join(rows) + "</robot>\n")
    return folder / "robot.urdf"


def _collision(shape: str, xyz: Any) -> str:
    return f'<collision><origin xyz="{_words(xyz)}"/><geometry>{shape}</geometry></collision>'


def _joint(name: str, kind: str, parent: str, child: str, pose: Floats, limit: str) -> str:
    pitch = np.arctan2(-pose[2, 0], np.hypot(pose[2, 1], pose[2, 2]))
    rpy = np.arctan2(pose[2, 1], pose[2, 2]), pitch, np.arctan2(pose[1, 0], pose[0, 0])
    ends = f'<parent link="{parent}"/><child link="{child}"/><origin xyz="{_words(pose[:3, 3])}" rpy="{_words(rpy)}"/>'
    return f'<joint name="{name}" type="{kind}">{ends}{limit}</joint>'


def _words(numbers: Any) -> str:
    return " ".join(repr(float(number)) for number in numbers)


def _write_stl(file: Path, triangles: Floats) -> None:
    rows = np.zeros(len(triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    rows["corners"] = triangles
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    rows["normal"] = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    file.write_bytes(bytes(80) + np.uint32(len(rows)).tobytes() + rows.tobytes())
