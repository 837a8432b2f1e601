"""Poses, Jacobians, and gravity torques of a chain of a robot file, computed by Pinocchio or MuJoCo."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib import import_module
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Answers:
    """What a library computes for N configurations of a chain of n joints.

    Attributes:
        poses: (N, 4, 4) poses of the tip, m, in the frame of the base (Pinocchio) or of the world (MuJoCo).
        jacobians: (N, 6, n) geometric Jacobians at the tip, linear velocity first, in the same frame.
        torques: (N, n) torques and forces that hold the chain still, N m and N.
    """

    poses: Array
    jacobians: Array
    torques: Array


@dataclass(frozen=True)
class ChainQuestion:
    """Chain of a file.

    Attributes:
        base: Link or body on which the chain is mounted.
        tip: Link, body, or site whose pose is asked for.
        joints: (n,) names of the joints.
        hold: Values of joints that the reader was told to hold, rad and m.
    """

    base: str
    tip: str
    joints: tuple[str, ...]
    hold: Mapping[str, float]


# ---- Pinocchio ---------------------------------------------------------------------------------------------------


def answer_with_pinocchio(
    file: Path, chain: ChainQuestion, configurations: Array, exact_quarter_turns: bool = False
) -> Answers:
    """Return Pinocchio's answers for a URDF file, with all other joints held as holdfast documents it.

    Args:
        file: URDF file.
        chain: Chain of the file.
        configurations: (N, n) joint values, rad and m.
        exact_quarter_turns: Angles within 1e-9 rad of a quarter turn become exact first, as holdfast documents it.

    Raises:
        ValueError: Pinocchio cannot read the file.
    """
    pin = import_module("pinocchio")
    text = strip_shapes(file.read_text(encoding="utf-8", errors="replace").lstrip())
    if exact_quarter_turns:
        text = re.sub(r'(?<=rpy=")[^"]*', round_angles, text)
    model = pin.buildModelFromXML(text)
    data = model.createData()
    q = pin.neutral(model)
    for name, value in held_values(text, chain).items():
        set_joint(model, q, name, value)
    base, tip = (model.getFrameId(link, pin.FrameType.BODY) for link in (chain.base, chain.tip))
    columns = [model.joints[model.getJointId(name)].idx_v for name in chain.joints]
    poses, jacobians, torques = [], [], []
    for row in configurations:
        for name, value in zip(chain.joints, row, strict=True):
            set_joint(model, q, name, float(value))
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        to_base = data.oMf[base].rotation.T
        jacobian = pin.getFrameJacobian(model, data, tip, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)[:, columns]
        poses.append((data.oMf[base].inverse() * data.oMf[tip]).homogeneous)
        jacobians.append(np.vstack([to_base @ jacobian[:3], to_base @ jacobian[3:]]))
        torques.append(pin.computeGeneralizedGravity(model, data, q)[columns].copy())
    return Answers(np.array(poses), np.array(jacobians), np.array(torques))


def round_angles(angles: re.Match[str]) -> str:
    """Return angles of a URDF text, rad, with those within 1e-9 of a quarter turn made exact."""
    values = [float(word) for word in angles.group().split()]
    turns = [round(value / (np.pi / 2)) * (np.pi / 2) for value in values]
    return " ".join(repr(turn if abs(value - turn) < 1e-9 else value) for value, turn in zip(values, turns, strict=True))


def set_joint(model: Any, q: Array, name: str, value: float) -> None:
    """Write the value of a joint, rad or m, into a configuration of Pinocchio; floating and planar joints stay neutral."""
    joint = model.joints[model.getJointId(name)]
    if (joint.nq, joint.nv) == (1, 1):
        q[joint.idx_q] = value
    elif (joint.nq, joint.nv) == (2, 1):
        q[joint.idx_q : joint.idx_q + 2] = np.cos(value), np.sin(value)


def strip_shapes(text: str) -> str:
    """Return a URDF text with its links and joints alone.

    The parser of Pinocchio refuses some shapes, and files without a name, effort, or velocity. None of these matters here.
    """
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError:  # undeclared prefixes
        root = ElementTree.fromstring(re.sub(r"(?<=[\s</])(\w+):(?=\w+[\s=/>])", r"\1_", text))
    root.set("name", root.get("name") or "robot")
    for element in list(root):
        if element.tag not in ("link", "joint"):
            root.remove(element)
        for shape in (*element.findall("visual"), *element.findall("collision")):
            element.remove(shape)
        for limit in element.findall("limit"):
            limit.attrib.update({key: limit.get(key, "0") for key in ("effort", "velocity")})
    return ElementTree.tostring(root, encoding="unicode")


def held_values(text: str, chain: ChainQuestion) -> dict[str, float]:
    """Return the values of all joints that are not on the chain: 0, or the limit nearest to it, or what they mimic."""
    elements = {
        joint.get("name", ""): joint
        for joint in ElementTree.fromstring(text).findall("joint")
        if joint.get("type") in ("revolute", "continuous", "prismatic")
    }

    def value_of(name: str) -> float:
        if name in chain.hold:
            return chain.hold[name]
        element = elements[name]
        mimic, limit = element.find("mimic"), element.find("limit")
        if mimic is not None:
            return float(mimic.get("multiplier", 1)) * value_of(mimic.get("joint", "")) + float(mimic.get("offset", 0))
        if limit is None or element.get("type") == "continuous" or not {"lower", "upper"} & set(limit.attrib):
            return 0.0
        return min(max(0.0, float(limit.get("lower", 0))), float(limit.get("upper", 0)))

    return {name: value_of(name) for name in elements if name not in chain.joints}


# ---- MuJoCo ------------------------------------------------------------------------------------------------------


def complete_names(names: list[str]) -> list[str]:
    """Return names in which each made-up one, marked by a blank at its end, gets an underscore if the file uses it."""
    return [name if name.strip() == name else name.strip() + "_" * (name.strip() in names) for name in names]


@lru_cache(maxsize=1)
def compile_mujoco_model(file: Path) -> Any:
    """Return the model of an MJCF file; the chains of one file share it, because meshes take long."""
    mujoco = import_module("mujoco")
    return mujoco.MjModel.from_xml_path(str(file))


def answer_with_mujoco(file: Path, chain: ChainQuestion, configurations: Array) -> Answers:
    """Return MuJoCo's answers for an MJCF file, with all other joints held at the file's initial pose.

    Raises:
        ValueError: MuJoCo cannot read the file.
    """
    mujoco = import_module("mujoco")
    model = compile_mujoco_model(file)
    data = mujoco.MjData(model)
    names = complete_names([model.joint(k).name or f"joint{k + 1} " for k in range(model.njnt)])
    bodies = complete_names([model.body(k).name or f"body{k} " for k in range(model.nbody)])
    for k, name in enumerate(names):
        if int(model.jnt_type[k]) in (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE)):
            value = chain.hold.get(name, data.qpos[model.jnt_qposadr[k]])
            data.qpos[model.jnt_qposadr[k]] = np.clip(value, *model.jnt_range[k]) if model.jnt_limited[k] else value
    joints = [names.index(name) for name in chain.joints]
    columns = model.jnt_dofadr[joints]
    poses, jacobians, torques = [], [], []
    for row in configurations:
        data.qpos[model.jnt_qposadr[joints]] = row
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_comVel(model, data)
        linear, angular, torque = np.zeros((3, model.nv)), np.zeros((3, model.nv)), np.zeros(model.nv)
        if chain.tip in bodies:
            frame = data.body(bodies.index(chain.tip))
            mujoco.mj_jacBody(model, data, linear, angular, bodies.index(chain.tip))
        else:
            frame = data.site(chain.tip)
            mujoco.mj_jacSite(model, data, linear, angular, model.site(chain.tip).id)
        mujoco.mj_rne(model, data, 0, torque)  # at rest: qfrc_bias, without springs, friction, and gravcomp
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = frame.xmat.reshape(3, 3), frame.xpos
        poses.append(pose)
        jacobians.append(np.vstack([linear, angular])[:, columns])
        torques.append(torque[columns])
    return Answers(np.array(poses), np.array(jacobians), np.array(torques))
