"""The Panda and a cell in MuJoCo and in Pinocchio with coal: kinematics, meshes and collisions all of theirs.

Both take every mesh of the arm for its convex hull, which it is to 0.1 % of its volume.
"""

from __future__ import annotations

import re
from importlib.resources import files
from pathlib import Path

import numpy as np
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

import holdfast as hf
from holdfast.model.cell import Box, Capsule, Cylinder, HalfSpace, Mesh, Points, Sphere

N = 7


def panda_urdf() -> Path:
    return Path(str(files("holdfast.model.arms").joinpath("data", "panda.urdf")))


def pose(x: float, y: float, z: float, turn=(0.0, 0.0, 0.0)) -> np.ndarray:
    out = np.eye(4)
    out[:3, :3], out[:3, 3] = Rotation.from_rotvec(turn).as_matrix(), (x, y, z)
    return out


# ---- cells -----------------------------------------------------------------------------------------------------------


def of_primitives() -> hf.Cell:
    """Eight objects of every kind that a formula describes."""
    return hf.Cell(
        [
            Box("table", [0.8, 1.2, 0.04], pose=pose(0.55, 0, -0.03)),
            Cylinder("post", 0.05, 1.0, pose=pose(0.2, 0.55, 0.5, (0.1, 0, 0))),
            Capsule("pipe", 0.04, 0.6, pose=pose(0.5, -0.5, 0.4, (0, 1.0, 0))),
            Sphere("ball", 0.12, pose=pose(0.45, 0.35, 0.8)),
            HalfSpace("ground", pose=pose(0, 0, -0.4)),
            Box("wall", [0.05, 2.0, 2.0], pose=pose(-0.6, 0, 0.5)),
            Box("shelf", [0.4, 0.4, 0.03], pose=pose(0.6, -0.3, 0.7)),
            Cylinder("can", 0.04, 0.2, pose=pose(0.5, 0.2, 0.1)),
        ],
        name="primitives",
    )


PLACES = np.array(
    [
        [0.55, 0, 0.0],
        [0.2, 0.55, 0.5],
        [0.5, -0.5, 0.4],
        [0.45, 0.35, 0.8],
        [-0.55, 0, 0.6],
        [0.6, -0.3, 0.9],
        [0, -0.6, 0.3],
        [-0.3, -0.3, 1.1],
    ]
)


def of_hulls() -> hf.Cell:
    """Eight convex meshes: hulls of 40 points in ellipsoids."""
    rng = np.random.default_rng(3)
    made = []
    for k, place in enumerate(PLACES):
        points = rng.normal(size=(40, 3))
        points *= rng.uniform(0.05, 0.25, 3) / np.linalg.norm(points, axis=1, keepdims=True)
        shape = points, ConvexHull(points).simplices
        made.append(Mesh(f"hull{k}", shape, solid="hull", pose=pose(*place, rng.normal(size=3))))
    return hf.Cell(made, name="convex meshes")


def channel(length: float, width: float, height: float, wall: float) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and faces of a channel along x, open above: a closed surface that is not convex."""
    a, b, h = width / 2, width / 2 - wall, height
    ring = np.array([[-a, 0], [a, 0], [a, h], [b, h], [b, wall], [-b, wall], [-b, h], [-a, h]])
    n = len(ring)
    corners = np.array([[x, *p] for x in (-length / 2, length / 2) for p in ring])
    end = [[0, 1, 4], [0, 4, 5], [1, 2, 3], [1, 3, 4], [0, 5, 6], [0, 6, 7]]
    sides = [t for i in range(n) for t in ([i, (i + 1) % n, n + (i + 1) % n], [i, n + (i + 1) % n, n + i])]
    caps = [[a, c, b] for a, b, c in end] + [[n + k for k in t] for t in end]
    return corners, np.array([*caps, *sides])


def of_channels() -> hf.Cell:
    """Eight channels: meshes that are not convex."""
    rng = np.random.default_rng(4)
    made = []
    for k, place in enumerate(PLACES):
        size = rng.uniform([0.3, 0.15, 0.1, 0.01], [0.6, 0.4, 0.25, 0.03])
        made.append(Mesh(f"channel{k}", channel(*size), pose=pose(*place, rng.normal(size=3))))
    return hf.Cell(made, name="meshes that are not convex")


# ---- MuJoCo ----------------------------------------------------------------------------------------------------------


class InMujoco:
    """Contacts between the Panda and a cell of primitives and hulls."""

    def __init__(self, cell: hf.Cell) -> None:
        import mujoco

        self._mujoco = mujoco
        urdf = panda_urdf()
        package = urdf.parent / "example-robot-data"
        text = urdf.read_text().replace("package://example-robot-data", str(package))
        settings = '<mujoco><compiler strippath="false" discardvisual="true" fusestatic="true"/></mujoco>'
        spec = mujoco.MjSpec.from_string(re.sub(r"<robot[^>]*>", lambda found: found[0] + settings, text, count=1))
        for geom in spec.geoms:
            geom.contype, geom.conaffinity = 1, 0
        for solid in cell:
            place = {"pos": solid.pose[:3, 3], "quat": Rotation.from_matrix(solid.pose[:3, :3]).as_quat(scalar_first=True)}
            spec.worldbody.add_geom(contype=0, conaffinity=1, **place, **self._shape(spec, solid))
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)

    def _shape(self, spec, solid) -> dict:
        kinds = self._mujoco.mjtGeom
        if isinstance(solid, Box):
            return {"type": kinds.mjGEOM_BOX, "size": solid.size / 2}
        if isinstance(solid, Cylinder):
            return {"type": kinds.mjGEOM_CYLINDER, "size": [solid.radius, solid.length / 2, 0]}
        if isinstance(solid, Capsule):
            return {"type": kinds.mjGEOM_CAPSULE, "size": [solid.radius, solid.length / 2, 0]}
        if isinstance(solid, Sphere):
            return {"type": kinds.mjGEOM_SPHERE, "size": [solid.radius, 0, 0]}
        if isinstance(solid, HalfSpace):
            return {"type": kinds.mjGEOM_PLANE, "size": [0, 0, 1]}
        mesh = spec.add_mesh(name=solid.name, uservert=solid.surface.vertices.ravel(), userface=solid.surface.faces.ravel())
        mesh.inertia = self._mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX
        return {"type": kinds.mjGEOM_MESH, "meshname": solid.name}

    def touches(self, q: np.ndarray) -> np.ndarray:
        """(N,) whether there is a contact."""
        found = np.zeros(len(q), dtype=bool)
        model, data, mujoco = self.model, self.data, self._mujoco
        for k, row in enumerate(q):
            data.qpos[:N] = row
            mujoco.mj_kinematics(model, data)
            mujoco.mj_collision(model, data)
            found[k] = data.ncon > 0
        return found


# ---- Pinocchio and coal ----------------------------------------------------------------------------------------------


class InCoal:
    """Distances between the Panda and a cell; a mesh that is not a hull is its surface."""

    def __init__(self, cell: hf.Cell) -> None:
        import coal
        import pinocchio as pin

        self._coal, self._pin = coal, pin
        urdf = panda_urdf()
        full = pin.buildModelFromUrdf(str(urdf))
        shapes = pin.buildGeomFromUrdf(full, str(urdf), pin.GeometryType.COLLISION, package_dirs=[str(urdf.parent)])
        fingers = [full.getJointId(name) for name in full.names if "finger" in name]
        self.model, self.shapes = pin.buildReducedModel(full, shapes, fingers, pin.neutral(full))
        self.data, self.placed = self.model.createData(), self.shapes.createData()
        self.parts = []
        for k, piece in enumerate(self.shapes.geometryObjects):
            if piece.parentJoint:
                self.parts.append((k, self.hull(piece.geometry)))
        self.objects = [self._object(solid) for solid in cell]

    def hull(self, shape):
        if not isinstance(shape, self._coal.BVHModelBase):
            return shape
        shape.buildConvexHull(True, "Qt")
        return shape.convex

    def _object(self, solid):
        coal = self._coal
        at = coal.Transform3s(solid.pose[:3, :3], solid.pose[:3, 3])
        if isinstance(solid, Box):
            return coal.Box(*solid.size), at
        if isinstance(solid, Cylinder):
            return coal.Cylinder(solid.radius, solid.length), at
        if isinstance(solid, Capsule):
            return coal.Capsule(solid.radius, solid.length), at
        if isinstance(solid, Sphere):
            return coal.Sphere(solid.radius), at
        if isinstance(solid, HalfSpace):
            normal = solid.pose[:3, 2]
            return coal.Halfspace(normal, float(normal @ solid.pose[:3, 3])), coal.Transform3s()
        if isinstance(solid, Points):
            raise NotImplementedError
        made = coal.BVHModelOBBRSS()
        points, faces = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
        for vertex in solid.surface.vertices:
            points.append(vertex)
        for face in solid.surface.faces.tolist():
            faces.append(coal.Triangle(*face))
        made.beginModel(len(faces), len(points))
        made.addSubModel(points, faces)
        made.endModel()
        return self.hull(made) if solid.solid == "hull" else made, at

    def _rows(self, q):
        for row in q:
            self._pin.updateGeometryPlacements(self.model, self.data, self.shapes, self.placed, row)
            for k, part in self.parts:
                at = self.placed.oMg[k]
                yield part, self._coal.Transform3s(at.rotation, at.translation)

    def distances(self, q: np.ndarray) -> np.ndarray:
        """(N,) m, 0 or less where anything touches."""
        coal, ask = self._coal, self._coal.DistanceRequest()
        found = [
            min(coal.distance(part, at, thing, there, ask, coal.DistanceResult()) for thing, there in self.objects)
            for part, at in self._rows(q)
        ]
        return np.array(found).reshape(len(q), -1).min(axis=1)

    def touches(self, q: np.ndarray) -> np.ndarray:
        """(N,) whether anything touches."""
        coal, ask = self._coal, self._coal.CollisionRequest()
        found = [
            any(coal.collide(part, at, thing, there, ask, coal.CollisionResult()) for thing, there in self.objects)
            for part, at in self._rows(q)
        ]
        return np.array(found).reshape(len(q), -1).any(axis=1)


# ---- python-fcl ------------------------------------------------------------------------------------------------------


class InFcl:
    """python-fcl asked about every body and object until something touches; the bodies and where they are are holdfast's."""

    def __init__(self, cell: hf.Cell, clearance: hf.Clearance) -> None:
        import fcl

        from holdfast.model.collision.exact.bodies import body_from_solid
        from holdfast.model.collision.exact.engines import Fcl
        from holdfast.model.collision.exact.narrow_phase import arm_bodies

        self.arm, self.engine = clearance.arm, Fcl()
        self.parts = [part for part in arm_bodies(clearance.arm, clearance.capsules) if part.link >= 0]
        self.made = [self.engine.make_body(part.body) for part in self.parts]
        self.things = []
        for solid in cell:
            if isinstance(solid, HalfSpace):
                normal = solid.pose[:3, 2]
                plane = fcl.Halfspace(normal, float(normal @ solid.pose[:3, 3]))
                self.things.append(fcl.CollisionObject(plane, fcl.Transform()))
                continue
            body = body_from_solid(solid)
            self.things.append(self.engine.make_body(body))
            self.engine.place_body(self.things[-1], body.pose[:3, :3], body.pose[:3, 3])

    def touches(self, q: np.ndarray) -> np.ndarray:
        """(N,) whether anything touches."""
        found, frames = np.zeros(len(q), dtype=bool), self.arm.frames(q)
        for k in range(len(q)):
            for part, body in zip(self.parts, self.made, strict=True):
                at = frames[k, part.link + 1] @ part.body.pose
                self.engine.place_body(body, np.ascontiguousarray(at[:3, :3]), at[:3, 3])
            found[k] = any(self.engine.bodies_touch(body, thing) for body in self.made for thing in self.things)
        return found
