"""Read arms from MJCF files: MuJoCo compiles the file, and one chain of its tree of bodies is the arm.

Features of the format (defaults, includes, inertia from shapes, degrees) therefore have MuJoCo's meaning.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import ArmError
from holdfast.core.extras import import_extra
from holdfast.core.formatting import list_names
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.formats import mjcf_limits
from holdfast.model.arm.formats.tree import LinkTree, TreeJoint, build_chain, fixed_joint, resolve_base_and_tip
from holdfast.model.arm.machine import ArmData, Link, snap_rounding_noise

UNNAMED_MODEL = "MuJoCo Model"


def import_mujoco() -> ModuleType:
    """Import MuJoCo, which is an optional dependency of holdfast.

    Raises:
        HoldfastError: MuJoCo is not installed.
    """
    module: ModuleType = import_extra("mujoco", "physics", "MuJoCo")
    return module


@contextmanager
def silence_mujoco() -> Iterator[None]:
    """Keep MuJoCo from writing its warnings to stdout and to MUJOCO_LOG.TXT in the working folder."""
    mujoco = import_mujoco()
    previous_handler = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(lambda _: None)
    try:
        yield
    finally:
        mujoco.set_mju_user_warning(previous_handler)


@check_arguments
def load_mjcf(
    path: str | Path,
    base: str | None = None,
    tip: str | None = None,
    hold: Mapping[str, float] | None = None,
    name: str | None = None,
    label: str | None = None,
) -> ArmData:
    """Return the serial arm from body ``base`` down to body or site ``tip`` of an MJCF file (needs ``holdfast-arms[physics]``).

    As in :func:`holdfast.model.arm.formats.urdf.load_urdf`, bodies without a joint are merged into their parent. A body that is
    attached to the chain without being part of it is merged as well, with its joints held at the values of the file. Hinges
    become revolute joints if they have a range and continuous joints otherwise, slides become prismatic joints. Several joints
    of one body become joints with massless links in between. ``links[i]`` is given in a frame with the axes of the body and the
    anchor of joint i as origin; ``tool`` is the frame of ``tip``; joint values are MuJoCo's, including ``ref``.

    The arm takes ``range``, ``armature``, ``damping`` (the viscous friction), ``frictionloss`` (the Coulomb friction), gravity,
    and as effort the joint's ``actuatorfrcrange`` or else the total capacity of its actuators. Springs, gravity compensation
    (``gravcomp``), contacts, and equalities with mocap bodies are left out, because an Arm has none. Named keyframes become
    ``states``.

    Args:
        path: MJCF file; files that it names are searched next to it.
        base: Name of the body on which the arm is mounted; default: ``world``.
        tip: Name of the body, or else of the site, whose frame is the tool; optional as for a URDF file.
        hold: Values, rad or m, of joints that are held, on the chain or next to it; held joints on the chain are no joints of
            the arm. By default all joints on the chain move, and those next to it are held at the file's initial pose, within
            their limits.
        name: Name of the arm; default: the model name in the file.
        label: Name of the source in error messages and reports; default: the name of the file.

    Returns:
        Data for :meth:`holdfast.Arm.from_mjcf`; ``base`` is the pose of the base body in MuJoCo's world, ``source`` the name of
        the file.

    Raises:
        ArmError: MuJoCo cannot read the file, there is no single serial chain of hinges and slides from base to tip, or an
            equality or tendon couples joints of the chain.
        HoldfastError: MuJoCo is not installed.
    """
    path = Path(path)
    mujoco, source = import_mujoco(), label or path.name
    try:
        model, tree = compile_tree(path, tip)
        if not model.njnt:
            raise ArmError("the model has no joint; an arm needs at least one")
        arm = _build_arm(mujoco, model, tree, base, tip, dict(hold or {}), name or tree.name, source)
        return replace(arm, chain=arm.chain and replace(arm.chain, file=str(path.absolute())))
    except ArmError as error:
        raise ArmError(f"{source}: {error}", tip=error.tip) from error


def compile_tree(path: Path, tip: str | None = None) -> tuple[Any, LinkTree]:
    """Return the model of a file as MuJoCo compiles it, and the tree of its bodies and joints, with the site ``tip`` if any.

    Raises:
        ArmError: MuJoCo cannot read the file.
        HoldfastError: MuJoCo is not installed.
    """
    mujoco = import_mujoco()
    model = mujoco.MjModel.from_binary_path(str(path)) if path.suffix == ".mjb" else _compile_model(mujoco, path)
    return model, _read_tree(mujoco, model, model_name(model) or path.stem, tip)


def model_name(model: Any) -> str:
    """Return the name of a compiled model; empty if the file gives it none."""
    name: str = model.names.partition(b"\0")[0].decode()
    return "" if name == UNNAMED_MODEL else name


def body_name(model: Any, body: int) -> str:
    """Return the name of a body of the model in the tree."""
    return model.body(body).name or _names_or_numbers(model.nbody, model.body, "body", 0)[body]


def _compile_model(mujoco: ModuleType, path: Path) -> Any:
    text = mjcf_limits.read_checked_model(path)
    try:
        with silence_mujoco():
            if path.suffix.lower() == ".xml":
                spec = mujoco.MjSpec.from_file(str(path))
            else:  # MuJoCo decides by the file ending
                spec = mujoco.MjSpec.from_string(text)
                spec.modelfiledir = str(path.parent)
            return spec.compile()
    except ValueError as error:
        reason = " ".join(str(error).split())
        raise ArmError(f"MuJoCo cannot read this ({reason}); give a valid MJCF file, with the files that it names") from error


# ---- the tree ----------------------------------------------------------------------------------------------------


def pose_from_wxyz(position: ArrayLike, wxyz: ArrayLike) -> FloatArray:
    """Return the pose (4, 4) of a position, m, and a unit quaternion, w first."""
    w, x, y, z = np.asarray(wxyz, dtype=np.float64)
    pose = np.eye(4)
    pose[:3, :3] = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    pose[:3, :3] = snap_rounding_noise(pose[:3, :3])
    pose[:3, 3] = position
    return pose


def _names_or_numbers(count: int, accessor: Callable[[int], Any], kind: str, start: int) -> list[str]:
    """Return unique names of all bodies or joints; an unnamed one gets its number, counted from ``start``."""
    names = [str(accessor(k).name) for k in range(count)]
    for k in range(count):
        label = f"{kind}{k + start}"
        while not names[k]:
            names[k] = "" if label in names else label
            label += "_"
    return names


def _read_tree(mujoco: ModuleType, model: Any, label: str, tip: str | None) -> LinkTree:
    bodies = _names_or_numbers(model.nbody, model.body, "body", 0)
    joint_names = _names_or_numbers(model.njnt, model.joint, "joint", 1)
    kinds = {
        int(mujoco.mjtJoint.mjJNT_HINGE): "hinge",
        int(mujoco.mjtJoint.mjJNT_SLIDE): "prismatic",
        int(mujoco.mjtJoint.mjJNT_BALL): "ball",
        int(mujoco.mjtJoint.mjJNT_FREE): "free",
    }
    links: dict[str, Link | None] = {bodies[0]: None}
    joints: dict[str, TreeJoint] = {}
    for body_index in range(1, model.nbody):
        body, link = bodies[body_index], bodies[int(model.body_parentid[body_index])]
        # pose of the body in the current link
        pending = pose_from_wxyz(model.body_pos[body_index], model.body_quat[body_index])
        first, count = int(model.body_jntadr[body_index]), int(model.body_jntnum[body_index])
        for joint_index in range(first, first + count):
            anchor = np.eye(4)
            anchor[:3, 3] = model.jnt_pos[joint_index]
            last_here = joint_index == first + count - 1 and not model.jnt_pos[joint_index].any()
            child = body if last_here else f"{body} at {joint_names[joint_index]}"
            joint = _read_joint(mujoco, model, joint_index, joint_names[joint_index], kinds[int(model.jnt_type[joint_index])])
            # At its reference value, not at 0, the joint leaves the body where the file puts it.
            joint = replace(joint, parent=link, child=child, origin=pending @ anchor)
            joints[joint.name] = replace(joint, origin=joint.child_pose(-joint.rest))
            links[child] = Link(0.0, np.zeros(3), np.zeros((3, 3)), name=child)
            link, pending = child, np.asarray(np.linalg.inv(anchor), dtype=np.float64)
        links[body] = _read_body(model, body_index, body)
        if link != body:
            joints[f"{body} (fixed)"] = fixed_joint(body, link, pending)
    if tip is not None and tip not in links:
        for site_index in range(model.nsite):
            if model.site(site_index).name == tip:
                carrier = bodies[int(model.site_bodyid[site_index])]
                links[tip] = None
                joints[f"{tip} (fixed)"] = fixed_joint(
                    tip, carrier, pose_from_wxyz(model.site_pos[site_index], model.site_quat[site_index])
                )
    tied: set[str] = set()
    looped: set[str] = set()
    for _, _, coupled_joints, coupled_bodies in _iterate_couplings(mujoco, model):
        tied.update(joint_names[k] for k in coupled_joints if len(coupled_joints) > 1)
        carriers = [{joint_names[k] for k in _joints_above(model, body)} for body in coupled_bodies]
        if carriers:
            looped |= carriers[0].union(*carriers) - carriers[0].intersection(*carriers)
    return LinkTree(label, links, joints, limits_required=False, tied=frozenset(tied), looped=frozenset(looped))


def _joints_above(model: Any, body: int) -> Iterator[int]:
    """Yield the joints that move a body."""
    while body:
        first = int(model.body_jntadr[body])
        yield from range(first, first + int(model.body_jntnum[body]))
        body = int(model.body_parentid[body])


def _read_body(model: Any, body_index: int, name: str) -> Link | None:
    mass, moments = float(model.body_mass[body_index]), np.array(model.body_inertia[body_index])
    if mass == 0 and not moments.any():
        return None
    return Link(mass, np.zeros(3), np.diag(moments), name=name).in_frame(
        pose_from_wxyz(model.body_ipos[body_index], model.body_iquat[body_index])
    )


def _read_joint(mujoco: ModuleType, model: Any, joint_index: int, name: str, kind: str) -> TreeJoint:
    """Read a joint without its position in the tree."""
    reference = float(model.qpos0[model.jnt_qposadr[joint_index]]) if kind in ("hinge", "prismatic") else 0.0
    limited = bool(model.jnt_limited[joint_index])
    lower, upper = (float(limit) for limit in model.jnt_range[joint_index]) if limited else (-np.inf, np.inf)
    if kind == "hinge":
        kind = "revolute" if limited else "continuous"
    dof_address = int(model.jnt_dofadr[joint_index])
    return TreeJoint(
        name=name,
        type=kind,
        parent="",
        child="",
        origin=np.eye(4),
        axis=np.array(model.jnt_axis[joint_index]),
        lower=lower,
        upper=upper,
        velocity=np.inf,
        effort=_actuator_effort(mujoco, model, joint_index),
        friction=float(model.dof_damping[dof_address]),
        armature=float(model.dof_armature[dof_address]),
        coulomb_friction=float(model.dof_frictionloss[dof_address]),
        rest=reference,
    )


def _actuator_effort(mujoco: ModuleType, model: Any, joint_index: int) -> float:
    """Return the largest torque or force of the actuators of a joint; infinite if not given."""
    if model.jnt_actfrclimited[joint_index]:
        return float(np.abs(model.jnt_actfrcrange[joint_index]).max())
    total, has_actuator = 0.0, False
    joint_transmissions = (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT))
    for actuator in range(len(model.actuator_trntype)):
        if (
            int(model.actuator_trntype[actuator]) not in joint_transmissions
            or int(model.actuator_trnid[actuator, 0]) != joint_index
        ):
            continue
        # From MuJoCo 4 on, an actuator may have several controls and outputs.
        control, output = (
            int(getattr(model, key)[actuator]) if hasattr(model, key) else actuator
            for key in ("actuator_ctrladr", "actuator_outadr")
        )
        gear, has_actuator = abs(float(model.actuator_gear[output, 0])), True
        has_fixed_gain = int(model.actuator_gaintype[actuator]) == int(mujoco.mjtGain.mjGAIN_FIXED)
        is_motor = has_fixed_gain and int(model.actuator_biastype[actuator]) == int(mujoco.mjtBias.mjBIAS_NONE)
        if model.actuator_forcelimited[actuator]:
            total += gear * float(np.abs(model.actuator_forcerange[actuator]).max())
        elif is_motor and model.actuator_ctrllimited[control]:
            total += (
                gear * abs(float(model.actuator_gainprm[actuator, 0])) * float(np.abs(model.actuator_ctrlrange[control]).max())
            )
        else:
            return np.inf
    return total if has_actuator and total > 0 else np.inf


# ---- the arm -----------------------------------------------------------------------------------------------------


def _build_arm(
    mujoco: ModuleType,
    model: Any,
    tree: LinkTree,
    base: str | None,
    tip: str | None,
    hold: dict[str, float],
    name: str,
    source: str,
) -> ArmData:
    base, tip = resolve_base_and_tip(tree, base, tip)
    on_chain = {joint.name for joint in tree.joint_path(base, tip) if not tree.is_fixed(joint, hold)}
    _reject_coupled_chain(mujoco, model, tree, on_chain)
    weightless = bool(model.opt.disableflags & int(mujoco.mjtDisableBit.mjDSBL_GRAVITY))
    gravity = np.zeros(3) if weightless else np.array(model.opt.gravity)
    arm = build_chain(tree, base, tip, hold, name, gravity.tolist(), source, in_world=True)
    joints = _names_or_numbers(model.njnt, model.joint, "joint", 1)
    addresses = [int(model.jnt_qposadr[joints.index(joint)]) for joint in arm.joint_names]
    return replace(
        arm, states={str(model.key(k).name): model.key_qpos[k][addresses] for k in range(model.nkey) if model.key(k).name}
    )


def _reject_coupled_chain(mujoco: ModuleType, model: Any, tree: LinkTree, on_chain: set[str]) -> None:
    """Reject equalities and tendons on the chain; between bodies at rest relative to each other they have no effect."""
    joints = _names_or_numbers(model.njnt, model.joint, "joint", 1)
    bodies = _names_or_numbers(model.nbody, model.body, "body", 0)

    def carrying_joint(body: int) -> str:
        """Return the name of the joint of the chain that carries a body, or an empty text."""
        link = bodies[body]
        while link in tree.joint_above and tree.joint_above[link].name not in on_chain:
            link = tree.joint_above[link].parent
        return tree.joint_above[link].name if link in tree.joint_above else ""

    for kind, name, tied_joints, tied_bodies in _iterate_couplings(mujoco, model):
        if kind == "tendon" and len(tied_joints) == 1 and not tied_bodies:
            continue  # it carries a motor or spring of this joint and couples no other
        tied_names = [joints[joint] for joint in tied_joints if joints[joint] in on_chain]
        if tied_names:
            raise ArmError(
                f"{kind} '{name}' ties joint {list_names(tied_names)} of the chain, which is then no degree of freedom of its "
                "own; a serial arm needs independent joints, so remove it or choose another base and tip"
            )
        carriers = {carrying_joint(b) for b in tied_bodies}
        if len(carriers) > 1:
            raise ArmError(
                f"{kind} '{name}' ties the bodies {list_names([bodies[b] for b in tied_bodies])}, which closes a loop over "
                "joints of the chain; a serial arm has no loops, so remove it or choose another base and tip"
            )


def _iterate_couplings(mujoco: ModuleType, model: Any) -> Iterator[tuple[str, str, list[int], list[int]]]:
    """Yield word, name, joints, and bodies of every active equality and every tendon."""
    equality_types, wrap_types, object_types = mujoco.mjtEq, mujoco.mjtWrap, mujoco.mjtObj
    for index in range(model.neq):
        if not model.eq_active0[index]:
            continue
        name, ends = model.equality(index).name or f"{index + 1}", [int(model.eq_obj1id[index]), int(model.eq_obj2id[index])]
        kind = int(model.eq_type[index])
        if kind == int(equality_types.mjEQ_JOINT):
            yield "equality", name, [object_id for object_id in ends if object_id >= 0], []
        elif kind in (int(equality_types.mjEQ_CONNECT), int(equality_types.mjEQ_WELD)):
            at_sites = int(model.eq_objtype[index]) == int(object_types.mjOBJ_SITE)
            bodies = [int(model.site_bodyid[object_id]) if at_sites else max(object_id, 0) for object_id in ends]
            if not any(model.body_mocapid[body] >= 0 for body in bodies):  # a mocap body pulls the arm; it is no part of it
                yield "equality", name, [], bodies
    for index in range(model.ntendon):
        first_wrap, tied_joints, tied_bodies = int(model.tendon_adr[index]), [], []
        for wrap_index in range(first_wrap, first_wrap + int(model.tendon_num[index])):
            kind, wrapped_id = int(model.wrap_type[wrap_index]), int(model.wrap_objid[wrap_index])
            if kind == int(wrap_types.mjWRAP_JOINT):
                tied_joints.append(wrapped_id)
            elif kind == int(wrap_types.mjWRAP_SITE):
                tied_bodies.append(int(model.site_bodyid[wrapped_id]))
            elif kind in (int(wrap_types.mjWRAP_SPHERE), int(wrap_types.mjWRAP_CYLINDER)):
                tied_bodies.append(int(model.geom_bodyid[wrapped_id]))
        yield "tendon", model.tendon(index).name or f"{index + 1}", tied_joints, tied_bodies
