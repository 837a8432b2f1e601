"""A cell in a MuJoCo model: objects that do not move, which an arm can touch and is not heavier for it."""

from __future__ import annotations

from typing import Any

from holdfast.arm.mjcf import import_mujoco
from holdfast.cell.cell import Cell
from holdfast.cell.meshes import Mesh
from holdfast.cell.solids import Box, HalfSpace, Primitive, Solid, Sphere
from holdfast.clearance.capsules import BASE, Capsule, link_name
from holdfast.clearance.clearance import Clearance
from holdfast.clearance.contacts import Contact
from holdfast.errors import InputError
from holdfast.physics.model import quaternion

_ARM, _CELL = 1, 2  # bits of what touches what: the arm the cell, and nothing itself


def surround(spec: Any, clearance: Clearance, step: float) -> None:
    """Put the objects of a cell into the spec of an arm, and the capsules of the arm's links, without mass.

    Contacts are as stiff as the step allows, critically damped, with MuJoCo's own friction (a coefficient of 1). A mesh is its
    convex hull here.

    Args:
        spec: Of :func:`holdfast.physics.model.mujoco_spec`, for the same arm.
        clearance: With the cell. Links that are welded touch nothing, nor does the arm itself.
        step: s.

    Raises:
        InputError: The cell holds a cloud of points.
    """
    mujoco, arm = import_mujoco(), clearance.arm
    alike = {"solref": [2 * step, 1.0], "solimp": [0.99, 0.999, 1e-3, 0.5, 2.0], "mass": 0.0}
    links = spec.bodies[1 : arm.n + 1]
    for k, body in enumerate(links):
        body.name = f"link {k}"
    for number, part in enumerate(clearance.capsules):
        if part.link != BASE:
            size = _size_of_part(mujoco, part)
            name = f"part {number}"
            links[part.link].add_geom(name=name, contype=_ARM, conaffinity=_CELL, **size, **alike)
    cell = clearance.cell or Cell(())
    for number, solid in enumerate(cell):
        body = spec.worldbody.add_body(
            name=f"object {number}", pos=solid.pose[:3, 3], quat=quaternion(mujoco, solid.pose[:3, :3])
        )
        shape = _shape(mujoco, spec, solid, number)
        body.add_geom(name=f"object {number}", contype=_CELL, conaffinity=_ARM, **shape, **alike)
    names = [solid.name for solid in cell]
    for thing, link in cell.may_touch:
        if link in arm.joint_names:
            spec.add_exclude(bodyname1=f"link {arm.joint_names.index(link)}", bodyname2=f"object {names.index(thing)}")


def _size_of_part(mujoco: Any, part: Capsule) -> dict[str, Any]:
    if part.length == 0:
        return {"type": mujoco.mjtGeom.mjGEOM_SPHERE, "size": [part.radius, 0, 0], "pos": part.start}
    return {"type": mujoco.mjtGeom.mjGEOM_CAPSULE, "size": [part.radius, 0, 0], "fromto": [*part.start, *part.end]}


def _shape(mujoco: Any, spec: Any, solid: Solid, number: int) -> dict[str, Any]:
    kinds = mujoco.mjtGeom
    if isinstance(solid, Mesh):
        made = spec.add_mesh(name=f"mesh {number}")
        made.uservert, made.userface = solid.surface.vertices.ravel(), solid.surface.faces.ravel()
        return {"type": kinds.mjGEOM_MESH, "meshname": made.name}
    if not isinstance(solid, Primitive):
        raise InputError(
            f"object '{solid.name}' is a cloud of points, for which MuJoCo has no body; for a physical run leave it out of the "
            "cell, or put boxes or a mesh in its place"
        )
    if isinstance(solid, Box):
        return {"type": kinds.mjGEOM_BOX, "size": solid.size / 2}
    if isinstance(solid, HalfSpace):
        return {"type": kinds.mjGEOM_PLANE, "size": [0, 0, 1]}
    if isinstance(solid, Sphere):
        return {"type": kinds.mjGEOM_SPHERE, "size": [solid.radius, 0, 0]}
    kind = getattr(kinds, f"mjGEOM_{type(solid).__name__.upper()}")  # a cylinder or a capsule
    return {"type": kind, "size": [solid.radius, solid.length / 2, 0]}  # type: ignore[attr-defined]


class Touches:
    """What has touched so far in a model of :func:`surround`.

    Args:
        clearance: As for :func:`surround`; None: nothing is looked at.
    """

    def __init__(self, clearance: Clearance | None) -> None:
        self._clearance = clearance
        self._found: dict[tuple[str, str], tuple[float, float]] = {}

    def note(self, model: Any, data: Any, time: float) -> None:
        """Look at the contacts of a moment, at a time in s."""
        for k in range(data.ncon):
            contact = data.contact[k]
            pair = self._named(model, contact)
            first, depth = self._found.get(pair, (time, 0.0))
            self._found[pair] = first, max(depth, -float(contact.dist))

    def require_clear(self, model: Any) -> None:
        """Refuse a start within an object: the physics would throw the arm out.

        Raises:
            InputError: Which link is in what, and how deep.
        """
        mujoco = import_mujoco()
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        deepest = min((data.contact[k] for k in range(data.ncon)), key=lambda c: c.dist, default=None)
        if deepest is not None and deepest.dist < 0:
            link, thing = self._named(model, deepest)
            raise InputError(
                f"q puts {link} {-deepest.dist:.3g} m into object '{thing}' of the cell; start where the arm is clear of it"
            )

    def _named(self, model: Any, contact: Any) -> tuple[str, str]:
        """The link and the object of a contact."""
        assert self._clearance is not None
        assert self._clearance.cell is not None
        numbers = {}
        for geom in contact.geom:
            what, number = model.geom(int(geom)).name.split()
            numbers[what] = int(number)
        link = self._clearance.capsules.parts[numbers["part"]].link
        return link_name(self._clearance.arm, link), self._clearance.cell.objects[numbers["object"]].name

    def contacts(self) -> tuple[Contact, ...] | None:
        """The first of each pair, in order of time; None if nothing was looked at."""
        if self._clearance is None:
            return None
        rows = sorted((time, link, thing, depth) for (link, thing), (time, depth) in self._found.items())
        return tuple(Contact(time=time, link=link, object=thing, depth=depth) for time, link, thing, depth in rows)
