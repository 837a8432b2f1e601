"""Libraries that know exactly whether two bodies touch, and how far they are apart, behind one protocol.

python-fcl comes with the extra ``cell``. Its signs are right; its distances, of bodies apart, are sometimes too large
(measured: 1 in 1,500 pairs, by up to 1.4 mm), and its signed distances throw near contact, so they are never asked for. coal is
taken where it is installed for distances.

Sources: Pan, Chitta & Manocha 2012, FCL, ICRA; Montaut et al. 2022, Collision detection accelerated, RSS (coal).
"""

from __future__ import annotations

from importlib.metadata import version
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import HoldfastError

if TYPE_CHECKING:
    from holdfast.clearance.exact.bodies import Body

Array = NDArray[np.float64]

CONTACT = 1e-6  # m: bodies nearer than this touch


class Engine(Protocol):
    """What such a library can do. Two bodies, once made, may be placed and asked about as often as one likes.

    Attributes:
        name: Of the library, with its version.
        within: How right its distances are, m.
    """

    name: str
    within: float

    def make(self, body: Body) -> Any:
        """The library's own body, not placed yet."""

    def place(self, made: Any, rotation: Array, position: Array) -> None:
        """Put the frame of a body at a rotation (3, 3) and position (3,), m."""

    def hits(self, a: Any, b: Any) -> bool:
        """Whether two placed bodies touch; a mesh is a surface here, with nothing within."""

    def distance(self, a: Any, b: Any) -> float:
        """How far two placed bodies are apart, m; 0 or less where they touch."""


def for_signs() -> Engine:
    """The library that says whether bodies touch.

    Raises:
        HoldfastError: None is installed.
    """
    return Fcl() if find_spec("fcl") else Coal() if find_spec("coal") else _missing()


def for_distances() -> Engine:
    """The library that says how far bodies are apart.

    Raises:
        HoldfastError: None is installed.
    """
    return Coal() if find_spec("coal") else Fcl() if find_spec("fcl") else _missing()


def installed() -> bool:
    """Whether any of them is."""
    return bool(find_spec("fcl") or find_spec("coal"))


def _missing() -> Engine:
    raise HoldfastError(
        "exact answers about collisions need python-fcl, which is not installed; install it with: pip install 'holdfast[cell]'"
    )


class Fcl:
    """python-fcl."""

    within = 2e-3

    def __init__(self) -> None:
        import fcl

        self._fcl = fcl
        self.name = f"python-fcl {version('python-fcl')}"
        self._touch = fcl.CollisionRequest(num_max_contacts=1, enable_contact=False)
        self._apart = fcl.DistanceRequest(enable_nearest_points=False, enable_signed_distance=False)

    def make(self, body: Body) -> Any:
        """See :class:`Engine`."""
        return self._fcl.CollisionObject(self._geometry(body), self._fcl.Transform())

    def _geometry(self, body: Body) -> Any:
        if body.kind == "convex":
            corners = np.column_stack([np.full(len(body.faces), 3), body.faces]).astype(np.int32).ravel()
            return self._fcl.Convex(np.ascontiguousarray(body.vertices), len(body.faces), corners)
        if body.kind == "mesh":
            made = self._fcl.BVHModel()
            made.beginModel(len(body.vertices), len(body.faces))
            made.addSubModel(np.ascontiguousarray(body.vertices), np.ascontiguousarray(body.faces, dtype=np.int64))
            made.endModel()
            return made
        kinds = {"box": "Box", "cylinder": "Cylinder", "capsule": "Capsule", "sphere": "Sphere", "ellipsoid": "Ellipsoid"}
        return getattr(self._fcl, kinds[body.kind])(*body.size)

    def place(self, made: Any, rotation: Array, position: Array) -> None:
        """See :class:`Engine`."""
        made.setRotation(rotation)
        made.setTranslation(position)

    def hits(self, a: Any, b: Any) -> bool:
        """See :class:`Engine`."""
        return bool(self._fcl.collide(a, b, self._touch, self._fcl.CollisionResult()))

    def distance(self, a: Any, b: Any) -> float:
        """See :class:`Engine`."""
        return float(self._fcl.distance(a, b, self._apart, self._fcl.DistanceResult()))


class Coal:
    """coal, which was hpp-fcl."""

    within = CONTACT

    def __init__(self) -> None:
        import coal

        self._coal = coal
        self.name = f"coal {coal.__version__}"
        self._touch, self._apart = coal.CollisionRequest(), coal.DistanceRequest()
        self._touch.num_max_contacts, self._touch.enable_contact, self._touch.security_margin = 1, False, CONTACT
        self._pairs: dict[tuple[int, int], tuple[Any, Any]] = {}

    def make(self, body: Body) -> Any:
        """See :class:`Engine`."""
        return self._geometry(body), self._coal.Transform3s()

    def _geometry(self, body: Body) -> Any:
        if body.kind in ("convex", "mesh"):
            points, faces = self._coal.StdVec_Vec3s(), self._coal.StdVec_Triangle()
            for vertex in body.vertices:
                points.append(vertex)
            for face in body.faces.tolist():
                faces.append(self._coal.Triangle(*face))
            if body.kind == "convex":
                return self._coal.Convex(points, faces)
            made = self._coal.BVHModelOBBRSS()
            made.beginModel(len(body.faces), len(body.vertices))
            made.addSubModel(points, faces)
            made.endModel()
            return made
        kinds = {"box": "Box", "cylinder": "Cylinder", "capsule": "Capsule", "sphere": "Sphere", "ellipsoid": "Ellipsoid"}
        return getattr(self._coal, kinds[body.kind])(*body.size)

    def place(self, made: Any, rotation: Array, position: Array) -> None:
        """See :class:`Engine`."""
        made[1].setRotation(rotation)
        made[1].setTranslation(position)

    def _asked(self, a: Any, b: Any) -> tuple[Any, Any]:
        key = id(a), id(b)
        if key not in self._pairs:  # holds the bodies, so that no other can have their place in memory
            made = self._coal.ComputeCollision(a[0], b[0]), self._coal.ComputeDistance(a[0], b[0])
            self._pairs[key] = made, (a, b)
        collision, distance = self._pairs[key][0]
        return collision, distance

    def hits(self, a: Any, b: Any) -> bool:
        """See :class:`Engine`."""
        return bool(self._asked(a, b)[0](a[1], b[1], self._touch, self._coal.CollisionResult()))

    def distance(self, a: Any, b: Any) -> float:
        """See :class:`Engine`."""
        return float(self._asked(a, b)[1](a[1], b[1], self._apart, self._coal.DistanceResult()))
