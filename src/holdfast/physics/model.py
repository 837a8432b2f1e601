"""An arm as a MuJoCo model: the same frames, bodies, friction, rotor inertia and gravity, and nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.machine import Joint, Link
from holdfast.arm.mjcf import import_mujoco
from holdfast.arm.model import Arm
from holdfast.arm.soundness import require_possible_inertia
from holdfast.errors import ArmError

Array = NDArray[np.float64]
FAR = 1e9  # rad or m: a limit where there is none; MuJoCo's ranges are finite
LEAST_SHARE = 1e-9  # of the largest principal moment
LEAST_MOMENT = 1e-12  # kg m^2


def compiled(spec: Any, arm: Arm, free: Sequence[int]) -> Any:
    """The model of a spec of :func:`mujoco_spec`, with the joints' friction."""
    model = spec.compile()
    # In the compiled model, because a spec takes it as one number or as three, by the version of MuJoCo.
    model.dof_damping[:] = [arm.joints[k].friction for k in sorted(free)]
    return model


def mujoco_spec(arm: Arm, q: Array, free: Sequence[int], stops: bool = False, step: float = 1e-3) -> Any:
    """The arm as an ``mujoco.MjSpec`` in which the joints ``free`` move and all others are welded at ``q``.

    The model's ``qpos`` counts from ``q``: it is 0 there, in rad or m. Body k + 1 is the moving frame of joint k, joints have
    the arm's names, the site ``tool`` is the tool, the world is the arm's. The payload is part of the last body. MuJoCo wants
    principal moments above 0: those of rods and points are lifted to 1e-9 of the body's largest and at least 1e-12 kg m^2.

    Args:
        arm: Every link known; a link may be massless as long as those behind it are not.
        q: (n,) rad or m.
        free: Indices from 0 of the joints that move.
        stops: Whether the arm's limits stop the free joints, without rebound.
        step: s.

    Raises:
        ArmError: A link has no inertial data, or an inertia that no body can have, or a free joint carries no mass.
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
    for k, (joint, link) in enumerate(zip(arm.joints, arm.links, strict=True)):
        pose = frame @ joint.origin @ joint.motion(float(q[k]))
        body = body.add_body(pos=pose[:3, 3], quat=quaternion(mujoco, pose[:3, :3]))
        held = [x for x in (link, arm.payload if k == arm.n - 1 else None) if x is not None]
        _fill(mujoco, body, Link.joined(held))
        if k in free:
            _add_joint(mujoco, body, joint, float(q[k]), stops, step)
        frame = np.eye(4)
    body.add_site(name="tool", pos=arm.tool[:3, 3], quat=quaternion(mujoco, arm.tool[:3, :3]))
    return spec


def _require_mass(arm: Arm, free: Sequence[int]) -> None:
    """What moves with a free joint up to the next one must weigh something."""
    mass = [0.0 if link is None else link.mass for link in arm.links]
    mass[-1] += 0.0 if arm.payload is None else arm.payload.mass
    for k, after in pairwise([*free, arm.n]):
        if sum(mass[k:after]) <= 0:
            raise ArmError(
                f"arm '{arm.name}', joint '{arm.joint_names[k]}': nothing that it carries has mass, so gravity has nothing to "
                "move; give the links their masses"
            )


def quaternion(mujoco: ModuleType, rotation: Array) -> Array:
    """(4,) w, x, y, z of a rotation (3, 3)."""
    wxyz = np.zeros(4)
    mujoco.mju_mat2Quat(wxyz, np.ascontiguousarray(rotation).ravel())
    return wxyz


def _fill(mujoco: ModuleType, body: Any, link: Link) -> None:
    moments, axes = np.linalg.eigh(link.inertia)
    if np.linalg.det(axes) < 0:
        axes[:, 0] = -axes[:, 0]
    if link.mass > 0:
        moments = np.maximum(moments, max(LEAST_SHARE * moments[2], LEAST_MOMENT))
        moments[0] = max(moments[0], moments[2] - moments[1])  # the triangle inequality, exactly
    body.explicitinertial = True
    body.mass, body.ipos = link.mass, link.com
    body.inertia, body.iquat = moments, quaternion(mujoco, axes)


def _add_joint(mujoco: ModuleType, body: Any, joint: Joint, at: float, stops: bool, step: float) -> None:
    kind = mujoco.mjtJoint.mjJNT_SLIDE if joint.prismatic else mujoco.mjtJoint.mjJNT_HINGE
    made = body.add_joint(name=joint.name, type=kind, axis=joint.axis, armature=joint.armature)
    made.limited = mujoco.mjtLimited.mjLIMITED_FALSE
    if stops and (np.isfinite(joint.lower) or np.isfinite(joint.upper)):
        lower, upper = max(joint.lower - at, -FAR), min(joint.upper - at, FAR)
        made.limited = mujoco.mjtLimited.mjLIMITED_TRUE
        made.range = [lower, max(upper, lower + 1e-9)]
        # As stiff as the step allows, critically damped: the joint stays where it hits.
        made.solref_limit = [2 * step, 1.0]
        made.solimp_limit = [0.99, 0.999, 1e-3, 0.5, 2.0]
