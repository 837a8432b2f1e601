"""Collision libraries that compute contacts and distances of two bodies exactly, behind one protocol.

python-fcl comes with the extra ``cell``. Its contacts are right. Its distances of separate bodies are sometimes too large
(measured: 1 in 1,500 pairs, by up to 1.4 mm), and its signed distances raise errors near contact, so they are never requested.
If coal is installed, it computes the distances.

Sources: Pan, Chitta & Manocha 2012, FCL, ICRA; Montaut et al. 2022, Collision detection accelerated, RSS (coal).
"""

from __future__ import annotations

from importlib.metadata import version
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from holdfast.core.errors import HoldfastError
from holdfast.core.typing import FloatArray

if TYPE_CHECKING:
    from holdfast.model.collision.exact.bodies import CollisionBody


CONTACT_DISTANCE_M = 1e-6  # m: closer bodies touch


class CollisionLibrary(Protocol):
    """Interface of a collision library. Two bodies, once made, can be placed and queried repeatedly.

    Attributes:
        name: Name of the library, with its version.
        accuracy: Largest error of its distances, m.
    """

    name: str
    accuracy: float

    def make_body(self, body: CollisionBody) -> Any:
        """Make the library's own body, not placed yet."""

    def place_body(self, library_body: Any, rotation: FloatArray, position: FloatArray) -> None:
        """Place the frame of a body at a rotation (3, 3) and position (3,), m."""

    def bodies_touch(self, a: Any, b: Any) -> bool:
        """Return True if two placed bodies touch; a mesh is only a surface here, without a volume."""

    def body_distance(self, a: Any, b: Any) -> float:
        """Return the distance of two placed bodies, m; 0 or less in contact."""


def contact_library() -> CollisionLibrary:
    """Return the library for contact queries.

    Raises:
        HoldfastError: No library is installed.
    """
    return Fcl() if find_spec("fcl") else Coal() if find_spec("coal") else _raise_missing_library()


def distance_library() -> CollisionLibrary:
    """Return the library for distances of bodies.

    Raises:
        HoldfastError: No library is installed.
    """
    return Coal() if find_spec("coal") else Fcl() if find_spec("fcl") else _raise_missing_library()


def is_library_installed() -> bool:
    """Return True if any collision library is installed."""
    return bool(find_spec("fcl") or find_spec("coal"))


def _raise_missing_library() -> CollisionLibrary:
    raise HoldfastError(
        "exact answers about collisions need python-fcl, which is not installed; install it with: pip install "
        "'holdfast-arms[cell]'"
    )


class Fcl:
    """Collision library python-fcl."""

    accuracy = 2e-3

    def __init__(self) -> None:
        import fcl

        self._fcl = fcl
        self.name = f"python-fcl {version('python-fcl')}"
        self._touch = fcl.CollisionRequest(num_max_contacts=1, enable_contact=False)
        self._apart = fcl.DistanceRequest(enable_nearest_points=False, enable_signed_distance=False)

    def make_body(self, body: CollisionBody) -> Any:
        """Make a body of python-fcl; see :class:`CollisionLibrary`."""
        return self._fcl.CollisionObject(self._make_geometry(body), self._fcl.Transform())

    def _make_geometry(self, body: CollisionBody) -> Any:
        if body.kind == "convex":
            corners = np.column_stack([np.full(len(body.faces), 3), body.faces]).astype(np.int32).ravel()
            return self._fcl.Convex(np.ascontiguousarray(body.vertices), len(body.faces), corners)
        if body.kind == "mesh":
            mesh_model = self._fcl.BVHModel()
            mesh_model.beginModel(len(body.vertices), len(body.faces))
            mesh_model.addSubModel(np.ascontiguousarray(body.vertices), np.ascontiguousarray(body.faces, dtype=np.int64))
            mesh_model.endModel()
            return mesh_model
        kinds = {"box": "Box", "cylinder": "Cylinder", "capsule": "Capsule", "sphere": "Sphere", "ellipsoid": "Ellipsoid"}
        return getattr(self._fcl, kinds[body.kind])(*body.size)

    def place_body(self, library_body: Any, rotation: FloatArray, position: FloatArray) -> None:
        """Place a body; see :class:`CollisionLibrary`."""
        library_body.setRotation(rotation)
        library_body.setTranslation(position)

    def bodies_touch(self, a: Any, b: Any) -> bool:
        """Return True if two bodies touch; see :class:`CollisionLibrary`."""
        return bool(self._fcl.collide(a, b, self._touch, self._fcl.CollisionResult()))

    def body_distance(self, a: Any, b: Any) -> float:
        """Return the distance of two bodies, m; see :class:`CollisionLibrary`."""
        return float(self._fcl.distance(a, b, self._apart, self._fcl.DistanceResult()))


class Coal:
    """Collision library coal, formerly hpp-fcl."""

    accuracy = CONTACT_DISTANCE_M

    def __init__(self) -> None:
        import coal

        self._coal = coal
        self.name = f"coal {coal.__version__}"
        self._touch, self._apart = coal.CollisionRequest(), coal.DistanceRequest()
        self._touch.num_max_contacts, self._touch.enable_contact, self._touch.security_margin = 1, False, CONTACT_DISTANCE_M
        self._pairs: dict[tuple[int, int], tuple[Any, Any]] = {}

    def make_body(self, body: CollisionBody) -> Any:
        """Make a body of coal; see :class:`CollisionLibrary`."""
        return self._make_geometry(body), self._coal.Transform3s()

    def _make_geometry(self, body: CollisionBody) -> Any:
        if body.kind in ("convex", "mesh"):
            points, faces = self._coal.StdVec_Vec3s(), self._coal.StdVec_Triangle()
            for vertex in body.vertices:
                points.append(vertex)
            for face in body.faces.tolist():
                faces.append(self._coal.Triangle(*face))
            if body.kind == "convex":
                return self._coal.Convex(points, faces)
            mesh_model = self._coal.BVHModelOBBRSS()
            mesh_model.beginModel(len(body.faces), len(body.vertices))
            mesh_model.addSubModel(points, faces)
            mesh_model.endModel()
            return mesh_model
        kinds = {"box": "Box", "cylinder": "Cylinder", "capsule": "Capsule", "sphere": "Sphere", "ellipsoid": "Ellipsoid"}
        return getattr(self._coal, kinds[body.kind])(*body.size)

    def place_body(self, library_body: Any, rotation: FloatArray, position: FloatArray) -> None:
        """Place a body; see :class:`CollisionLibrary`."""
        library_body[1].setRotation(rotation)
        library_body[1].setTranslation(position)

    def _pair_queries(self, a: Any, b: Any) -> tuple[Any, Any]:
        key = id(a), id(b)
        if key not in self._pairs:  # keeps the bodies, so that no other can take their place in memory
            queries = self._coal.ComputeCollision(a[0], b[0]), self._coal.ComputeDistance(a[0], b[0])
            self._pairs[key] = queries, (a, b)
        collision, distance = self._pairs[key][0]
        return collision, distance

    def bodies_touch(self, a: Any, b: Any) -> bool:
        """Return True if two bodies touch; see :class:`CollisionLibrary`."""
        return bool(self._pair_queries(a, b)[0](a[1], b[1], self._touch, self._coal.CollisionResult()))

    def body_distance(self, a: Any, b: Any) -> float:
        """Return the distance of two bodies, m; see :class:`CollisionLibrary`."""
        return float(self._pair_queries(a, b)[1](a[1], b[1], self._apart, self._coal.DistanceResult()))
