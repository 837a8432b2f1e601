"""Arms from MJCF files: MuJoCo reads and compiles the file, one chain of its tree of bodies is the arm.

What MuJoCo adds to the format (defaults, includes, inertia from shapes, degrees) is therefore as MuJoCo means it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm import mjcf_limits
from holdfast.arm.machine import Link, Machine, snapped
from holdfast.arm.tree import Held, Tree, TreeJoint, chain, check_ends
from holdfast.errors import ArmError, HoldfastError
from holdfast.words import list_names

Array = NDArray[np.float64]
UNNAMED_MODEL = "MuJoCo Model"


def import_mujoco() -> ModuleType:
    """MuJoCo, which is not one of the packages that holdfast always brings.

    Raises:
        HoldfastError: It is not installed.
    """
    try:
        import mujoco
    except ImportError as error:
        raise HoldfastError(
            "MuJoCo is needed here and is not installed; install holdfast[physics] (pip install 'holdfast[physics]')"
        ) from error
    return mujoco  # type: ignore[no-any-return, unused-ignore]


@contextmanager
def quiet() -> Iterator[None]:
    """Keep MuJoCo from writing its warnings to stdout and to MUJOCO_LOG.TXT in the working folder."""
    mujoco = import_mujoco()
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(lambda _: None)
    try:
        yield
    finally:
        mujoco.set_mju_user_warning(before)


@checked
def load(
    path: str | Path,
    base: str | None = None,
    tip: str | None = None,
    hold: Mapping[str, float] | None = None,
    name: str | None = None,
) -> Machine:
    """The serial arm from body ``base`` down to body or site ``tip`` of an MJCF file (needs ``holdfast[physics]``).

    As :func:`holdfast.arm.urdf.load` does it: bodies without a joint are folded away, and what hangs on the chain without
    being part of it becomes part of the body it hangs on, its own joints held where the file puts them. Hinges are
    revolute with a range and continuous without one, slides are prismatic. Several joints of one body become joints with
    massless links in between. ``links[i]`` is given in a frame with the axes of the body and the anchor of joint i as
    origin; ``tool`` is the frame of ``tip``; joint values are MuJoCo's, so a ``ref`` is kept.

    Read are ``range``, ``armature``, ``damping`` (the friction), gravity, and as effort the joint's ``actuatorfrcrange`` or
    else the sum of what its actuators can do. An Arm has no springs, dry friction, gravity compensation or contacts: they are
    left out. Keyframes with a name become ``states``.

    Args:
        path: The file, with the files that it names beside it.
        base: Name of the body on which the arm is mounted; ``world`` if not given.
        tip: Name of the body, or else of the site, whose frame is the tool; may be left out as for a URDF file.
        hold: Value, rad or m, at which joints are held, on the chain or beside it; those on the chain are then no joints of the
            arm. By default all on the chain move, and those beside it are held where the file's initial pose puts them.
        name: Name of the arm; the file's model name if not given.

    Returns:
        What :meth:`holdfast.Arm.from_mjcf` makes an arm of; its ``base`` is the pose of the base body in MuJoCo's
        world, its ``source`` the name of the file.

    Raises:
        ArmError: MuJoCo cannot read the file, there is no single serial chain of hinges and slides from base to tip, or an
            equality or tendon closes a loop over it or ties it.
        HoldfastError: MuJoCo is not installed.
    """
    path = Path(path)
    mujoco = import_mujoco()
    try:
        model, label = _compiled(mujoco, path)
        if not model.njnt:
            raise ArmError("the model has no joint; an arm needs at least one")
        tree = _tree(mujoco, model, label, tip)
        arm = _arm(mujoco, model, tree, base, tip, dict(hold or {}), name or label, path.name)
        return replace(arm, chain=arm.chain and replace(arm.chain, file=str(path.absolute())))
    except ArmError as error:
        raise ArmError(f"{path.name}: {error}", tip=error.tip) from error


def compiled_tree(path: Path) -> tuple[Any, Tree]:
    """The model of a file as MuJoCo compiles it, and its bodies and joints.

    Raises:
        ArmError: MuJoCo cannot read the file.
        HoldfastError: MuJoCo is not installed.
    """
    mujoco = import_mujoco()
    model, label = _compiled(mujoco, path)
    return model, _tree(mujoco, model, label, None)


def body_name(model: Any, body: int) -> str:
    """What the tree calls a body of the model."""
    return model.body(body).name or f"body{body}"


def _compiled(mujoco: ModuleType, path: Path) -> tuple[Any, str]:
    text = mjcf_limits.check(path)
    try:
        with quiet():
            if path.suffix.lower() == ".xml":
                spec = mujoco.MjSpec.from_file(str(path))
            else:  # MuJoCo goes by the ending
                spec = mujoco.MjSpec.from_string(text)
                spec.modelfiledir = str(path.parent)
            model = spec.compile()
    except ValueError as error:
        reason = " ".join(str(error).split())
        raise ArmError(f"MuJoCo cannot read this ({reason}); give a valid MJCF file, with the files that it names") from error
    named = spec.modelname
    return model, named if named and named != UNNAMED_MODEL else path.stem


# ---- the tree ----------------------------------------------------------------------------------------------------


def pose_of(position: ArrayLike, wxyz: ArrayLike) -> Array:
    """(4, 4) from a position, m, and a unit quaternion, w first."""
    w, x, y, z = np.asarray(wxyz, dtype=np.float64)
    pose = np.eye(4)
    pose[:3, :3] = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    pose[:3, :3] = snapped(pose[:3, :3])
    pose[:3, 3] = position
    return pose


def _names(count: int, accessor: Callable[[int], Any], word: str, start: int) -> list[str]:
    """Names of all bodies or joints; what has none gets its number, counted from ``start``."""
    given = [str(accessor(k).name) for k in range(count)]
    return [name or f"{word}{k + start}" for k, name in enumerate(given)]


def _tree(mujoco: ModuleType, model: Any, label: str, tip: str | None) -> Tree:
    bodies = _names(model.nbody, model.body, "body", 0)
    joint_names = _names(model.njnt, model.joint, "joint", 1)
    kinds = {
        int(mujoco.mjtJoint.mjJNT_HINGE): "hinge",
        int(mujoco.mjtJoint.mjJNT_SLIDE): "prismatic",
        int(mujoco.mjtJoint.mjJNT_BALL): "ball",
        int(mujoco.mjtJoint.mjJNT_FREE): "free",
    }
    links: dict[str, Link | None] = {bodies[0]: None}
    joints: dict[str, TreeJoint] = {}
    for b in range(1, model.nbody):
        body, link = bodies[b], bodies[int(model.body_parentid[b])]
        pending = pose_of(model.body_pos[b], model.body_quat[b])  # of the body, in the link reached so far
        first, count = int(model.body_jntadr[b]), int(model.body_jntnum[b])
        for j in range(first, first + count):
            anchor = np.eye(4)
            anchor[:3, 3] = model.jnt_pos[j]
            last_here = j == first + count - 1 and not model.jnt_pos[j].any()
            child = body if last_here else f"{body} at {joint_names[j]}"
            joint = _joint(mujoco, model, j, joint_names[j], kinds[int(model.jnt_type[j])])
            # At its reference value, not at 0, the joint leaves the body where the file puts it.
            joint = replace(joint, parent=link, child=child, origin=pending @ anchor)
            joints[joint.name] = replace(joint, origin=joint.at(-joint.rest))
            links[child] = Link(0.0, np.zeros(3), np.zeros((3, 3)), name=child)
            link, pending = child, np.asarray(np.linalg.inv(anchor), dtype=np.float64)
        links[body] = _body(model, b, body)
        if link != body:
            joints[f"{body} (fixed)"] = _fixed(body, link, pending)
    if tip is not None and tip not in links:
        for k in range(model.nsite):
            if model.site(k).name == tip:
                carrier = bodies[int(model.site_bodyid[k])]
                links[tip] = None
                joints[f"{tip} (fixed)"] = _fixed(tip, carrier, pose_of(model.site_pos[k], model.site_quat[k]))
    tied = frozenset(joint_names[j] for _, _, those, _ in _ties(mujoco, model) if len(those) > 1 for j in those)
    return Tree(label, links, joints, limits_required=False, tied=tied)


def _fixed(child: str, parent: str, origin: Array) -> TreeJoint:
    none = np.inf
    return TreeJoint(f"{child} (fixed)", "fixed", parent, child, origin, np.zeros(3), -none, none, none, none, 0.0)


def _body(model: Any, b: int, name: str) -> Link | None:
    mass, moments = float(model.body_mass[b]), np.array(model.body_inertia[b])
    if mass == 0 and not moments.any():
        return None
    return Link(mass, np.zeros(3), np.diag(moments), name=name).moved(pose_of(model.body_ipos[b], model.body_iquat[b]))


def _joint(mujoco: ModuleType, model: Any, j: int, name: str, kind: str) -> TreeJoint:
    """A joint without its place in the tree."""
    reference = float(model.qpos0[model.jnt_qposadr[j]]) if kind in ("hinge", "prismatic") else 0.0
    limited = bool(model.jnt_limited[j])
    lower, upper = (float(x) for x in model.jnt_range[j]) if limited else (-np.inf, np.inf)
    if kind == "hinge":
        kind = "revolute" if limited else "continuous"
    dof = int(model.jnt_dofadr[j])
    return TreeJoint(
        name=name,
        type=kind,
        parent="",
        child="",
        origin=np.eye(4),
        axis=np.array(model.jnt_axis[j]),
        lower=lower,
        upper=upper,
        velocity=np.inf,
        effort=_effort(mujoco, model, j),
        friction=float(model.dof_damping[dof]),
        armature=float(model.dof_armature[dof]),
        rest=reference,
    )


def _effort(mujoco: ModuleType, model: Any, j: int) -> float:
    """Largest torque or force of the actuators of a joint; infinite if not given."""
    if model.jnt_actfrclimited[j]:
        return float(np.abs(model.jnt_actfrcrange[j]).max())
    total, found = 0.0, False
    direct = (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT))
    for a in range(model.nu):
        if int(model.actuator_trntype[a]) not in direct or int(model.actuator_trnid[a, 0]) != j:
            continue
        gear, found = abs(float(model.actuator_gear[a, 0])), True
        fixed = int(model.actuator_gaintype[a]) == int(mujoco.mjtGain.mjGAIN_FIXED)
        motor = fixed and int(model.actuator_biastype[a]) == int(mujoco.mjtBias.mjBIAS_NONE)
        if model.actuator_forcelimited[a]:
            total += gear * float(np.abs(model.actuator_forcerange[a]).max())
        elif motor and model.actuator_ctrllimited[a]:
            total += gear * abs(float(model.actuator_gainprm[a, 0])) * float(np.abs(model.actuator_ctrlrange[a]).max())
        else:
            return np.inf
    return total if found and total > 0 else np.inf


# ---- the arm -----------------------------------------------------------------------------------------------------


def _arm(
    mujoco: ModuleType,
    model: Any,
    tree: Tree,
    base: str | None,
    tip: str | None,
    hold: dict[str, float],
    name: str,
    source: str,
) -> Machine:
    base, tip = check_ends(tree, base, tip)
    on_chain = {joint.name for joint in tree.path(base, tip) if not tree.stands(joint, hold)}
    _refuse_ties(mujoco, model, tree, on_chain)
    mount = Held(tree, on_chain, hold).pose(base)
    weightless = bool(model.opt.disableflags & int(mujoco.mjtDisableBit.mjDSBL_GRAVITY))
    gravity = np.zeros(3) if weightless else np.array(model.opt.gravity)
    arm = chain(tree, base, tip, hold, name, gravity.tolist(), source, mount)
    joints = _names(model.njnt, model.joint, "joint", 1)
    at = [int(model.jnt_qposadr[joints.index(joint)]) for joint in arm.joint_names]
    return replace(arm, states={str(model.key(k).name): model.key_qpos[k][at] for k in range(model.nkey) if model.key(k).name})


def _refuse_ties(mujoco: ModuleType, model: Any, tree: Tree, on_chain: set[str]) -> None:
    """No equality and no tendon may act on the chain; between bodies that do not move against each other they do nothing."""
    joints = _names(model.njnt, model.joint, "joint", 1)
    bodies = _names(model.nbody, model.body, "body", 0)

    def carrier(body: int) -> str:
        """The joint of the chain that carries a body, or nothing."""
        link = bodies[body]
        while link in tree.above and tree.above[link].name not in on_chain:
            link = tree.above[link].parent
        return tree.above[link].name if link in tree.above else ""

    for kind, name, tied_joints, tied_bodies in _ties(mujoco, model):
        if kind == "tendon" and len(tied_joints) == 1 and not tied_bodies:
            continue  # it carries a motor or a spring of this joint and ties it to nothing
        caught = [joints[j] for j in tied_joints if joints[j] in on_chain]
        if caught:
            raise ArmError(
                f"{kind} '{name}' ties joint {list_names(caught)} of the chain, which is then no degree of freedom of its own; "
                "a serial arm needs independent joints, so remove it or choose another base and tip"
            )
        carriers = {carrier(b) for b in tied_bodies}
        if len(carriers) > 1:
            raise ArmError(
                f"{kind} '{name}' ties the bodies {list_names([bodies[b] for b in tied_bodies])}, which closes a loop over "
                "joints of the chain; a serial arm has no loops, so remove it or choose another base and tip"
            )


def _ties(mujoco: ModuleType, model: Any) -> Iterator[tuple[str, str, list[int], list[int]]]:
    """Word, name, joints and bodies of every active equality and every tendon."""
    eq, wrap, obj = mujoco.mjtEq, mujoco.mjtWrap, mujoco.mjtObj
    for k in range(model.neq):
        if not model.eq_active0[k]:
            continue
        name, ends = model.equality(k).name or f"{k + 1}", [int(model.eq_obj1id[k]), int(model.eq_obj2id[k])]
        kind = int(model.eq_type[k])
        if kind == int(eq.mjEQ_JOINT):
            yield "equality", name, [x for x in ends if x >= 0], []
        elif kind in (int(eq.mjEQ_CONNECT), int(eq.mjEQ_WELD)):
            at_sites = int(model.eq_objtype[k]) == int(obj.mjOBJ_SITE)
            yield "equality", name, [], [int(model.site_bodyid[x]) if at_sites else max(x, 0) for x in ends]
    for k in range(model.ntendon):
        first, tied_joints, tied_bodies = int(model.tendon_adr[k]), [], []
        for w in range(first, first + int(model.tendon_num[k])):
            kind, thing = int(model.wrap_type[w]), int(model.wrap_objid[w])
            if kind == int(wrap.mjWRAP_JOINT):
                tied_joints.append(thing)
            elif kind == int(wrap.mjWRAP_SITE):
                tied_bodies.append(int(model.site_bodyid[thing]))
            elif kind in (int(wrap.mjWRAP_SPHERE), int(wrap.mjWRAP_CYLINDER)):
                tied_bodies.append(int(model.geom_bodyid[thing]))
        yield "tendon", model.tendon(k).name or f"{k + 1}", tied_joints, tied_bodies
