"""Write an arm of an MJCF file as a URDF file of the package, with capsules instead of its collision meshes.

Usage: python -m tools.mjcf_to_urdf IN.xml OUT.urdf NAME BASE TIP LICENCE [BODY | JOINT=EFFORT,VELOCITY ...]

The file has the joints with their limits, efforts, viscous and Coulomb friction, and the inertials, but no armatures and no
meshes; `builtin.py` adds armatures. Each JOINT gets this effort, N m, and velocity, rad/s; ``inf`` means unknown. Each BODY is
left out, with all that it carries. A TIP such as site=0,0,0.1 moves this site in its body first, m. All geoms of group 3 count
as collision geoms, also where the file lets them collide with nothing. Prints the SHA-256 of both files.
"""

from __future__ import annotations

import hashlib
import sys
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from xml.etree import ElementTree

import mujoco
import numpy as np

import holdfast as hf
from holdfast.model.collision.cover import MAX_MEAN_EXCESS_M, fit_capsules
from holdfast.model.collision.shape import CollisionModel
from tools.strip_urdf import strip

COLLISION_GROUP = 3
CONTACT_POINT_M = 1e-3  # radius: smaller spheres are points on other geoms at which MuJoCo finds contacts


def load(source: Path, base: str, tip: str, without: list[str]) -> tuple[hf.Arm, list[list]]:
    """The arm, and rows (joint, start, end, radius, ...) of the capsules around its collision geoms."""
    spec = mujoco.MjSpec.from_file(str(source))
    spec.meshdir = str((source.parent / (spec.meshdir or "")).resolve())
    for name in without:
        spec.delete(spec.body(name))
    tip, _, position = tip.partition("=")
    if position:
        spec.site(tip).pos = [float(number) for number in position.split(",")]
    for geom in list(spec.geoms):
        if geom.type == mujoco.mjtGeom.mjGEOM_SPHERE and 0 < geom.size[0] < CONTACT_POINT_M:
            spec.delete(geom)
        elif geom.group == COLLISION_GROUP:
            geom.contype = geom.conaffinity = 1
    with TemporaryDirectory() as folder:
        file = Path(folder) / "arm.mjb"  # an XML file would have six digits
        mujoco.mj_saveModel(spec.compile(), str(file))
        arm = hf.Arm.from_mjcf(file, base=base, tip=tip)
        rows, mean, largest = fit_capsules(CollisionModel.from_arm(arm), MAX_MEAN_EXCESS_M)
    print(f"{len(rows)} capsules, {1e3 * mean:.0f} mm beyond the hulls on average, {1e3 * largest:.0f} mm at most")
    return arm, rows


def add_capsule(link: ElementTree.Element, start: np.ndarray, end: np.ndarray, radius: float) -> None:
    """A capsule along z from start to end, rounded up to a tenth of a millimetre."""
    length = float(np.linalg.norm(end - start))
    x, y, z = (end - start) / length if length else (0.0, 0.0, 1.0)
    center, rotation = (start + end) / 2, (0.0, np.arctan2(np.hypot(x, y), z), np.arctan2(y, x))
    collision = ElementTree.SubElement(link, "collision")
    numbers = {"xyz": center, "rpy": rotation}
    ElementTree.SubElement(collision, "origin", {k: " ".join(f"{v:.5f}" for v in values) for k, values in numbers.items()})
    geometry = ElementTree.SubElement(collision, "geometry")
    size = {"radius": f"{radius + 1e-4:.4f}", "length": f"{length:.4f}"}
    ElementTree.SubElement(geometry, "capsule", size)


def main(arguments: list[str]) -> int:
    """Command line."""
    if len(arguments) < 6:
        print(__doc__)
        return 2
    source, target, (name, base, tip, licence) = Path(arguments[0]), Path(arguments[1]), arguments[2:6]
    motors = {joint: numbers.split(",") for joint, _, numbers in (word.partition("=") for word in arguments[6:]) if numbers}
    arm, capsules = load(source, base, tip, [word for word in arguments[6:] if "=" not in word])
    joints = []
    for joint in arm.joints:
        effort, velocity = map(float, motors.get(joint.name, (joint.effort, joint.velocity)))
        joints.append(replace(joint, effort=effort, velocity=velocity, armature=0.0))
    robot = ElementTree.fromstring(strip(replace(arm, name=name, joints=tuple(joints)).to_urdf()))
    links = {element.get("name"): element for element in robot.iter("link")}
    for joint, start, end, radius, _ in capsules:
        add_capsule(links["mount" if joint < 0 else f"{arm.joint_names[joint]}_link"], np.array(start), np.array(end), radius)
    ElementTree.indent(robot)
    head = f'<?xml version="1.0"?>\n<!-- {licence}. Converted for holdfast from MJCF; see provenance.yaml. -->\n'
    target.write_text(head + ElementTree.tostring(robot, encoding="unicode") + "\n", encoding="utf-8")
    for path in (source, target):
        print(hashlib.sha256(path.read_bytes()).hexdigest(), path.name)
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
