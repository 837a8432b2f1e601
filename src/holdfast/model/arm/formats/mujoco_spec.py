"""Translation of an arm to a MuJoCo model with the same frames, bodies, friction, rotor inertia and gravity."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from types import ModuleType
from typing import Any

import numpy as np

from holdfast.core.errors import ArmError
from holdfast.core.typing import FloatArray
from holdfast.model.arm.formats.mjcf import import_mujoco
from holdfast.model.arm.machine import ArmData, Joint, Link
from holdfast.model.arm.soundness import require_possible_inertia

NO_LIMIT_RANGE = 1e9  # rad or m: stands for no limit, because MuJoCo's ranges are finite
MIN_MOMENT_FRACTION = 1e-9  # fraction of the largest principal moment
MIN_MOMENT_KG_M2 = 1e-12  # kg m^2


def build_mujoco_spec(arm: ArmData, q: FloatArray, free: Sequence[int], stops: bool = False, step: float = 1e-3) -> Any:
    """Build the ``mujoco.MjSpec`` of an arm in which the joints ``free`` move and all others are welded at ``q``.

    The model's ``qpos`` is 0 at ``q``, in rad or m. Body k + 1 is the moving frame of joint k, joints have the arm's names, the
    site ``tool`` is the tool, and the world is the arm's world. The payload is part of the last body. MuJoCo requires principal
    moments above 0, so those of rods and points are raised to 1e-9 of the body's largest and at least 1e-12 kg m^2.

    Args:
        arm: The arm, with inertial data for every link; a link may be massless as long as a link behind it is not.
        q: (n,) configuration, rad or m.
        free: Indices from 0 of the joints that move.
        stops: True if the arm's limits stop the free joints, without rebound.
        step: Time step, s.

    Raises:
        ArmError: A link has no inertial data or a physically impossible inertia, or a free joint carries no mass.
        HoldfastError: MuJoCo is not installed.
    """
    mujoco = import_mujoco()
    require_possible_inertia(arm)
    _require_mass(arm, sorted(free))
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.gravity = arm.gravity
    spec.option.timestep = step
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_RK4
    body, frame = spec.worldbody, arm.base
    for index, (joint, link) in enumerate(zip(arm.joints, arm.links, strict=True)):
        pose = frame @ joint.origin @ joint.motion(float(q[index]))
        body = body.add_body(pos=pose[:3, 3], quat=to_quaternion(mujoco, pose[:3, :3]))
        attached_links = [part for part in (link, arm.payload if index == arm.n - 1 else None) if part is not None]
        _set_inertia(mujoco, body, Link.merge(attached_links))
        if index in free:
            _add_joint(mujoco, body, joint, float(q[index]), stops, step)
        frame = np.eye(4)
    body.add_site(name="tool", pos=arm.tool[:3, 3], quat=to_quaternion(mujoco, arm.tool[:3, :3]))
    return spec


def build_whole_spec(arm: ArmData) -> Any:
    """Return the ``mujoco.MjSpec`` of an arm in which all joints move; see :meth:`holdfast.Arm.to_mujoco`."""
    mujoco = import_mujoco()
    spec = build_mujoco_spec(arm, np.zeros(arm.n), range(arm.n), stops=True)
    spec.modelname = arm.name
    for joint, spec_joint in zip(arm.joints, spec.joints, strict=True):
        spec_joint.frictionloss = joint.coulomb_friction
        if np.isfinite(joint.effort):
            spec_joint.actfrclimited = mujoco.mjtLimited.mjLIMITED_TRUE
            spec_joint.actfrcrange = [-joint.effort, joint.effort]
    for name, q in arm.states.items():
        spec.add_key(name=name, qpos=q)
    return spec


def _require_mass(arm: ArmData, free: Sequence[int]) -> None:
    """Require that the links between a free joint and the next one have mass."""
    masses = [0.0 if link is None else link.mass for link in arm.links]
    masses[-1] += 0.0 if arm.payload is None else arm.payload.mass
    for joint, next_joint in pairwise([*free, arm.n]):
        if sum(masses[joint:next_joint]) <= 0:
            raise ArmError(
                f"arm '{arm.name}', joint '{arm.joint_names[joint]}': nothing that it carries has mass, so gravity has nothing "
                "to move; give the links their masses"
            )


def to_quaternion(mujoco: ModuleType, rotation: FloatArray) -> FloatArray:
    """Return the quaternion (4,), w, x, y, z, of a rotation (3, 3)."""
    wxyz = np.zeros(4)
    mujoco.mju_mat2Quat(wxyz, np.ascontiguousarray(rotation).ravel())
    return wxyz


def _set_inertia(mujoco: ModuleType, body: Any, link: Link) -> None:
    moments, axes = np.linalg.eigh(link.inertia)
    if np.linalg.det(axes) < 0:
        axes[:, 0] = -axes[:, 0]
    if link.mass > 0:
        moments = np.maximum(moments, max(MIN_MOMENT_FRACTION * moments[2], MIN_MOMENT_KG_M2))
        moments[0] = max(moments[0], moments[2] - moments[1])  # the triangle inequality, exactly
    body.explicitinertial = True
    body.mass, body.ipos = link.mass, link.com
    body.inertia, body.iquat = moments, to_quaternion(mujoco, axes)


def _add_joint(mujoco: ModuleType, body: Any, joint: Joint, position: float, stops: bool, step: float) -> None:
    joint_type = mujoco.mjtJoint.mjJNT_SLIDE if joint.prismatic else mujoco.mjtJoint.mjJNT_HINGE
    added_joint = body.add_joint(name=joint.name, type=joint_type, axis=joint.axis, armature=joint.armature)
    # MuJoCo 4 takes the coefficients of a cubic, MuJoCo 3 one number.
    added_joint.damping = joint.friction if np.ndim(added_joint.damping) == 0 else [joint.friction, 0.0, 0.0]
    added_joint.limited = mujoco.mjtLimited.mjLIMITED_FALSE
    if stops and (np.isfinite(joint.lower) or np.isfinite(joint.upper)):
        lower, upper = max(joint.lower - position, -NO_LIMIT_RANGE), min(joint.upper - position, NO_LIMIT_RANGE)
        added_joint.limited = mujoco.mjtLimited.mjLIMITED_TRUE
        added_joint.range = [lower, max(upper, lower + 1e-9)]
        # As stiff as the step allows and critically damped, so that the joint stays at the limit that it hits.
        added_joint.solref_limit = [2 * step, 1.0]
        added_joint.solimp_limit = [0.99, 0.999, 1e-3, 0.5, 2.0]
