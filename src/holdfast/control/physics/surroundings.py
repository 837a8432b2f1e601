"""Objects of a cell and links of an arm in a MuJoCo model, which can touch each other, and their contacts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.model.arm.formats.mjcf import import_mujoco
from holdfast.model.arm.formats.mujoco_spec import to_quaternion
from holdfast.model.cell.cell import Cell
from holdfast.model.cell.meshes import Mesh
from holdfast.model.cell.solids import Box, HalfSpace, PrimitiveSolid, Solid, Sphere
from holdfast.model.collision.capsules import BASE_LINK, LinkCapsule, link_name
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.contacts import Contact

_ARM_CONTACT_BIT = 1  # the arm touches the cell, and itself only by explicit pairs; the cell does not touch itself
_CELL_CONTACT_BIT = 2
_LEAST_GAP_M = 1e-6  # m: links that are closer at the start do not touch each other


def add_cell_objects(spec: Any, clearance: Clearance, step: float) -> None:
    """Add the objects of a cell, and massless capsules of the arm's links, to the spec of an arm.

    Contacts are as stiff as the step allows and critically damped, with MuJoCo's default friction (a coefficient of 1). A mesh
    is its convex hull here.

    Args:
        spec: Spec of :func:`holdfast.model.arm.formats.mujoco_spec.build_mujoco_spec` for the arm.
        clearance: Collision model of the arm, with the cell. Welded links touch nothing, and the arm does not touch itself.
        step: Time step, s.

    Raises:
        InputError: The cell contains a point cloud.
    """
    mujoco, arm = import_mujoco(), clearance.arm
    contact_options = {**_contact_stiffness(step), "mass": 0.0}
    links = spec.bodies[1 : arm.n + 1]
    for index, body in enumerate(links):
        body.name = f"link {index}"
    arm_bits = {"contype": _ARM_CONTACT_BIT, "conaffinity": _CELL_CONTACT_BIT}
    for number, capsule in enumerate(clearance.capsules):
        if capsule.link != BASE_LINK:
            shape = _capsule_geom_options(mujoco, capsule)
            links[capsule.link].add_geom(name=f"part {number}", **arm_bits, **shape, **contact_options)
    cell = clearance.cell or Cell(())
    cell_bits = {"contype": _CELL_CONTACT_BIT, "conaffinity": _ARM_CONTACT_BIT}
    for number, solid in enumerate(cell):
        name, quaternion = f"object {number}", to_quaternion(mujoco, solid.pose[:3, :3])
        body = spec.worldbody.add_body(name=name, pos=solid.pose[:3, 3], quat=quaternion)
        body.add_geom(name=name, **cell_bits, **_solid_geom_options(mujoco, spec, solid, number), **contact_options)
    object_names = [solid.name for solid in cell]
    for object_name, link in cell.may_touch:
        if link in arm.joint_names:
            body_names = f"link {arm.joint_names.index(link)}", f"object {object_names.index(object_name)}"
            spec.add_exclude(bodyname1=body_names[0], bodyname2=body_names[1])


def add_link_contacts(spec: Any, clearance: Clearance, q: FloatArray, free: Sequence[int], step: float) -> None:
    """Let the links touch each other, in a spec after :func:`add_cell_objects`.

    Only the pairs that the clearance checks touch each other, and of these only pairs that the free joints move and that are
    apart at the start.

    Args:
        spec: Spec of the arm.
        clearance: Collision model of the arm.
        q: (n,) configuration at the start, rad and m.
        free: Indices from 0 of the joints that move.
        step: Time step, s.
    """
    mujoco, base = import_mujoco(), clearance.arm.base
    for number, capsule in enumerate(clearance.capsules):
        if capsule.link == BASE_LINK:
            start, end = (base[:3, :3] @ point + base[:3, 3] for point in (capsule.start, capsule.end))
            shape = _capsule_geom_options(mujoco, replace(capsule, start=tuple(start), end=tuple(end)))
            spec.worldbody.add_geom(name=f"part {number}", contype=0, conaffinity=0, **shape)
    distances = clearance.self_only.by_pair(q) if clearance.pairs else ()
    for (first, second), distance in zip(clearance.pairs, distances, strict=True):
        links = clearance.capsules.parts[first].link, clearance.capsules.parts[second].link
        if distance > _LEAST_GAP_M and any(links[0] < joint <= links[1] for joint in free):
            spec.add_pair(geomname1=f"part {first}", geomname2=f"part {second}", **_contact_stiffness(step))


def _contact_stiffness(step: float) -> dict[str, Any]:
    """Return options of a contact that is as stiff as the step allows, and critically damped."""
    return {"solref": [2 * step, 1.0], "solimp": [0.99, 0.999, 1e-3, 0.5, 2.0]}


def _capsule_geom_options(mujoco: Any, capsule: LinkCapsule) -> dict[str, Any]:
    if capsule.length == 0:
        return {"type": mujoco.mjtGeom.mjGEOM_SPHERE, "size": [capsule.radius, 0, 0], "pos": capsule.start}
    return {"type": mujoco.mjtGeom.mjGEOM_CAPSULE, "size": [capsule.radius, 0, 0], "fromto": [*capsule.start, *capsule.end]}


def _solid_geom_options(mujoco: Any, spec: Any, solid: Solid, number: int) -> dict[str, Any]:
    geom_types = mujoco.mjtGeom
    if isinstance(solid, Mesh):
        mesh = spec.add_mesh(name=f"mesh {number}")
        mesh.uservert, mesh.userface = solid.surface.vertices.ravel(), solid.surface.faces.ravel()
        return {"type": geom_types.mjGEOM_MESH, "meshname": mesh.name}
    if not isinstance(solid, PrimitiveSolid):
        raise InputError(
            f"object '{solid.name}' is a point cloud, for which MuJoCo has no body; remove it from the cell of a physical run, "
            "or replace it by boxes or a mesh"
        )
    if isinstance(solid, Box):
        return {"type": geom_types.mjGEOM_BOX, "size": solid.size / 2}
    if isinstance(solid, HalfSpace):
        return {"type": geom_types.mjGEOM_PLANE, "size": [0, 0, 1]}
    if isinstance(solid, Sphere):
        return {"type": geom_types.mjGEOM_SPHERE, "size": [solid.radius, 0, 0]}
    geom_type = getattr(geom_types, f"mjGEOM_{type(solid).__name__.upper()}")  # a cylinder or a capsule
    return {"type": geom_type, "size": [solid.radius, solid.length / 2, 0]}  # type: ignore[attr-defined]


class ContactLog:
    """Log of the contacts in a model of :func:`add_cell_objects`.

    Args:
        clearance: Collision model of the arm, with the cell.
        itself: Record contacts between links, too; without a cell and without this option no contacts are recorded.

    Attributes:
        cell: Objects around the arm; None without a cell.
        clearance: The same clearance; None if no contacts are recorded.
    """

    def __init__(self, clearance: Clearance | None, *, itself: bool = False) -> None:
        self.cell = None if clearance is None else clearance.cell
        self.clearance = None if self.cell is None and not itself else clearance
        self._contact_by_pair: dict[tuple[str, str], tuple[float, float]] = {}

    def record_contacts(self, model: Any, data: Any, time: float) -> None:
        """Record the contacts at a time in s."""
        for index in range(data.ncon):
            contact = data.contact[index]
            pair = self._identify_pair(model, contact)
            first_time, depth = self._contact_by_pair.get(pair, (time, 0.0))
            self._contact_by_pair[pair] = first_time, max(depth, -float(contact.dist))

    def require_collision_free(self, model: Any) -> None:
        """Reject a start within an object, from which the physics would eject the arm.

        Raises:
            InputError: A link lies within an object.
        """
        mujoco = import_mujoco()
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        deepest = min((data.contact[index] for index in range(data.ncon)), key=lambda candidate: candidate.dist, default=None)
        if deepest is not None and deepest.dist < 0:
            touching_link, object_name = self._identify_pair(model, deepest)
            raise InputError(
                f"q puts {touching_link} {-deepest.dist:.3g} m into object '{object_name}' of the cell; start at a "
                f"collision-free configuration"
            )

    def _identify_pair(self, model: Any, contact: Any) -> tuple[str, str]:
        """Return the names of the link and of the object, or of both links, of a contact."""
        assert self.clearance is not None
        links, objects = [], []
        for geom_id in contact.geom:
            kind, number = model.geom(int(geom_id)).name.split()
            if kind == "part":
                links.append(self.clearance.capsules.parts[int(number)].link)
            elif self.cell is not None:
                objects.append(self.cell.objects[int(number)].name)
        first, second = [*(link_name(self.clearance.arm, link) for link in sorted(links)), *objects]
        return first, second

    def list_contacts(self) -> tuple[Contact, ...] | None:
        """Return the first contact of each pair, in order of time; None if none were checked."""
        if self.clearance is None:
            return None
        records = sorted((time, *pair, depth) for pair, (time, depth) in self._contact_by_pair.items())
        return tuple(Contact(time=time, link=link, object=name, depth=depth) for time, link, name, depth in records)
