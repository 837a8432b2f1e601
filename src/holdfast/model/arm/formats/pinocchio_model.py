"""Read arms from Pinocchio models, and write arms as Pinocchio models."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import ModuleType
from typing import Any

import numpy as np

from holdfast.core.errors import ArmError
from holdfast.core.extras import import_extra
from holdfast.core.typing import FloatArray
from holdfast.model.arm.formats.tree import LinkTree, TreeJoint, build_chain, fixed_joint
from holdfast.model.arm.machine import ArmData, Link

_NOT_GIVEN = 1e20  # a limit above it, or a speed or effort of 0, means that there is none
_TYPE_NAMES = {"FreeFlyer": "floating", "RevoluteUnaligned": "revolute", "PrismaticUnaligned": "prismatic"}


def import_pinocchio() -> ModuleType:
    """Import Pinocchio, which is an optional dependency of holdfast.

    Raises:
        HoldfastError: Pinocchio is not installed.
    """
    module: ModuleType = import_extra("pinocchio", "pinocchio", "Pinocchio")
    return module


# ---- read --------------------------------------------------------------------------------------------------------


def read_pinocchio_model(
    model: Any,
    base: str | None = None,
    tip: str | None = None,
    hold: Mapping[str, float] | None = None,
    name: str | None = None,
) -> ArmData:
    """Return the serial arm from frame ``base`` to frame ``tip`` of a ``pinocchio.Model``.

    Links are the model's frames of the types body, sensor, and operational frame, and ``universe``. Joints outside
    the chain are held at the model's neutral configuration. The whole inertia of a joint belongs to its first link.

    Args:
        model: The ``pinocchio.Model``.
        base: Frame on which the arm is mounted; default: ``universe``.
        tip: Frame that is the tool; optional as for a URDF file.
        hold: Values, rad or m, of held joints.
        name: Name of the arm; default: that of the model.

    Raises:
        ArmError: There is no single serial chain from base to tip; the message names the joint or frame.
    """
    label = f"Pinocchio model '{model.name}'"
    try:
        tree = _read_tree(model)
        gravity = model.gravity.linear.tolist()
        arm = build_chain(tree, base, tip, hold or {}, name or model.name or "arm", gravity, label, in_world=True)
    except ArmError as error:
        raise ArmError(f"{label}: {error}", tip=error.tip) from error
    states = {state.key(): state.data() for state in model.referenceConfigurations}
    return replace(arm, states={name: _arm_configuration(model, arm, np.asarray(q)) for name, q in states.items()})


def _read_tree(model: Any) -> LinkTree:
    pinocchio = import_pinocchio()
    bodies: dict[str, Link | None] = {"universe": None}
    joints: dict[str, TreeJoint] = {}
    placements = {"universe": np.eye(4)}  # of each link in the frame of the joint that carries it
    carriers = {0: "universe"}  # joint number: its first link
    link_types = (pinocchio.FrameType.BODY, pinocchio.FrameType.OP_FRAME, pinocchio.FrameType.SENSOR)

    def nearest_body(frame_index: int, joint: int) -> str:
        while model.frames[frame_index].parentJoint == joint and frame_index:
            frame = model.frames[frame_index]
            if frame.type == pinocchio.FrameType.BODY:
                return str(frame.name)
            frame_index = frame.parentFrame
        return carriers[joint]

    for index, frame in enumerate(model.frames):
        joint, placement = int(frame.parentJoint), np.array(frame.placement.homogeneous)
        if frame.type == pinocchio.FrameType.JOINT:
            carriers[joint] = _first_link(pinocchio, model, index)
            parent = nearest_body(frame.parentFrame, int(model.parents[joint]))
            origin = np.linalg.inv(placements[parent]) @ model.jointPlacements[joint].homogeneous
            joints[frame.name] = _read_joint(pinocchio, model, joint, parent, carriers[joint], origin)
            bodies[carriers[joint]], placements[carriers[joint]] = _read_body(model, joint, carriers[joint]), np.eye(4)
        elif frame.type in link_types and frame.name not in bodies:
            parent = nearest_body(frame.parentFrame, joint)
            bodies[frame.name], placements[frame.name] = None, placement
            fixed = fixed_joint(frame.name, parent, np.linalg.inv(placements[parent]) @ placement)
            joints[fixed.name] = fixed
    tied = {model.names[joint] for joint in (*model.mimicking_joints, *model.mimicked_joints)}
    return LinkTree(model.name, bodies, joints, limits_required=False, tied=frozenset(tied))


def _first_link(pinocchio: ModuleType, model: Any, joint_frame: int) -> str:
    """Return the name of the body whose frame is that of the joint."""
    for frame in model.frames:
        is_body = frame.type == pinocchio.FrameType.BODY and frame.parentFrame == joint_frame
        if is_body and frame.placement.isIdentity(0.0):
            return str(frame.name)
    return f"{model.frames[joint_frame].name} (link)"


def _read_body(model: Any, joint: int, name: str) -> Link | None:
    inertia = model.inertias[joint]
    if inertia.mass == 0 and not np.any(inertia.inertia):
        return None
    return Link(float(inertia.mass), np.array(inertia.lever), np.array(inertia.inertia), name=name)


def _read_joint(pinocchio: ModuleType, model: Any, joint: int, parent: str, child: str, origin: FloatArray) -> TreeJoint:
    joint_model, name = model.joints[joint], model.names[joint]
    kind, axis = _motion_kind(joint_model, pinocchio.neutral(model))
    lower, upper, velocity, effort, friction, armature, coulomb = -np.inf, np.inf, np.inf, np.inf, 0.0, 0.0, 0.0
    mimic = None
    if joint in model.mimicking_joints:
        master = model.mimicked_joints[list(model.mimicking_joints).index(joint)]
        rule = joint_model.extract()
        mimic, axis = (model.names[master], float(rule.scaling), float(rule.offset)), axis / rule.scaling
    elif joint_model.nv == 1:
        dof, coordinate = joint_model.idx_v, joint_model.idx_q
        if joint_model.nq == 1:
            lower, upper = _finite_or(model.lowerPositionLimit[coordinate]), _finite_or(model.upperPositionLimit[coordinate])
        velocity, effort = _finite_or(model.velocityLimit[dof]) or np.inf, _finite_or(model.effortLimit[dof]) or np.inf
        friction, armature = float(model.damping[dof]), float(model.armature[dof])
        coulomb = float(max(model.upperDryFrictionLimit[dof], -model.lowerDryFrictionLimit[dof]))
        if kind == "revolute" and not np.isfinite([lower, upper]).any():
            kind = "continuous"
    return TreeJoint(
        name=name,
        type=kind,
        parent=parent,
        child=child,
        origin=np.asarray(origin, dtype=np.float64),
        axis=axis,
        lower=lower,
        upper=upper,
        velocity=velocity,
        effort=effort,
        friction=friction,
        mimic=mimic,
        armature=armature,
        coulomb_friction=coulomb,
    )


def _motion_kind(joint_model: Any, neutral: FloatArray) -> tuple[str, FloatArray]:
    """Return the type of a joint and its axis, from the velocity that it gives its link."""
    short_name = joint_model.shortname().removeprefix("JointModel")
    if joint_model.nvExtended != 1:
        return _TYPE_NAMES.get(short_name, short_name.lower()), np.zeros(3)
    joint_data = joint_model.createData()
    joint_model.calc(joint_data, neutral)
    linear, angular = np.split(np.asarray(joint_data.S, dtype=np.float64).ravel(), 2)
    if linear.any() and angular.any():
        return "helical", angular
    return ("prismatic", linear) if linear.any() else ("revolute", angular)


def _finite_or(limit: float) -> float:
    """Return a limit, infinite if the number means that there is none."""
    return float(limit) if abs(limit) < _NOT_GIVEN else float(np.copysign(np.inf, limit))


def _arm_configuration(model: Any, arm: ArmData, q: FloatArray) -> FloatArray:
    """Return the joint values (n,) of a configuration of the model."""
    values = []
    for name in arm.joint_names:
        joint_model = model.joints[model.getJointId(name)]
        coordinates = q[joint_model.idx_q : joint_model.idx_q + joint_model.nq]
        # An unlimited joint is stored as cosine and sine.
        values.append(coordinates[0] if joint_model.nq == 1 else np.arctan2(coordinates[1], coordinates[0]))
    return np.array(values)


# ---- write -------------------------------------------------------------------------------------------------------


def build_pinocchio_model(arm: ArmData) -> Any:
    """Return the arm as a ``pinocchio.Model`` with the same frames, limits, friction, rotor inertia, and gravity.

    Joint values are those of the arm, one number per joint, also for joints without limits. The frame of joint k is named after
    the joint, its link after the link, and the tool is the frame ``tool``. The payload is part of the last body.

    Raises:
        HoldfastError: Pinocchio is not installed.
    """
    pinocchio = import_pinocchio()
    model = pinocchio.Model()
    model.name, model.gravity = arm.name, pinocchio.Motion(arm.gravity, np.zeros(3))
    parent, pose = 0, arm.base
    for index, (joint, link) in enumerate(zip(arm.joints, arm.links, strict=True)):
        make_joint = pinocchio.JointModelPrismaticUnaligned if joint.prismatic else pinocchio.JointModelRevoluteUnaligned
        limits = ([limit] for limit in (joint.effort, joint.velocity, joint.lower, joint.upper))
        placement = pinocchio.SE3(pose @ joint.origin)
        parent = model.addJoint(parent, make_joint(joint.axis), placement, joint.name, *(np.array(limit) for limit in limits))
        model.damping[index], model.armature[index] = joint.friction, joint.armature
        model.upperDryFrictionLimit[index] = joint.coulomb_friction
        model.lowerDryFrictionLimit[index] = -joint.coulomb_friction
        model.addJointFrame(parent)
        attached = [part for part in (link, arm.payload if index == arm.n - 1 else None) if part is not None]
        if attached:
            body = Link.merge(attached)
            inertia = pinocchio.Inertia(body.mass, body.com, body.inertia)
            model.appendBodyToJoint(parent, inertia, pinocchio.SE3.Identity())
        link_name = f"{joint.name} (link)" if link is None or not link.name else link.name
        model.addBodyFrame(link_name, parent, pinocchio.SE3.Identity(), model.getFrameId(joint.name))
        pose = np.eye(4)
    last_frame = model.nframes - 1
    model.addFrame(pinocchio.Frame("tool", parent, last_frame, pinocchio.SE3(arm.tool), pinocchio.FrameType.OP_FRAME))
    for name, q in arm.states.items():
        model.referenceConfigurations[name] = q
    return model
