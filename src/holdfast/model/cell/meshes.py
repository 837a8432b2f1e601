"""Objects of a cell that are a surface of triangles or a cloud of points."""

from __future__ import annotations

import hashlib
import io
import warnings
from dataclasses import KW_ONLY, dataclass, field
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.files import mesh, reading
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_constructor, require_real_numbers
from holdfast.model.cell.field import DistanceField, cloud_field, surface_field
from holdfast.model.cell.solids import Solid

Kind = Literal["exact", "hull"]

MAX_OBJECT_SIZE_M = 50.0  # m: a larger object is in another unit
_MAX_COORDINATE_M = 1e6  # m


@dataclass(frozen=True)
class Source:
    """File from which an object was read.

    Attributes:
        path: Path of the file.
        sha256: SHA-256 of its bytes.
    """

    path: Path
    sha256: str

    def changed(self) -> bool:
        """Return whether the file is missing or its bytes have changed."""
        try:
            return hashlib.sha256(reading.read_bytes(self.path)).hexdigest() != self.sha256
        except OSError:
            return True


@dataclass(frozen=True, eq=False)
class GriddedSolid(Solid):
    """Object whose distance is a lower bound from a grid, see :class:`holdfast.model.cell.field.DistanceField`."""

    @property
    def field(self) -> DistanceField:
        """Distance field in the object's own frame."""
        raise NotImplementedError

    def signed_distance(self, points: ArrayLike) -> FloatArray:
        """Return a lower bound of the distance of points (..., 3) in the world from the surface, m, below 0 inside."""
        return self.distance_and_gradient(points)[0]

    def distance_and_gradient(self, points: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Return the bound (...,), m, and its gradient (..., 3) in the world, at points (..., 3) in the world, m."""
        distance, gradient = self.field.distance_and_gradient(self.to_object_frame(points))
        return distance, gradient @ self.pose[:3, :3].T

    def to_object_frame(self, points: ArrayLike) -> FloatArray:
        """Return points (..., 3) in the world, m, in the object's own frame."""
        return np.asarray((np.asarray(points, dtype=np.float64) - self.pose[:3, 3]) @ self.pose[:3, :3])

    def __getstate__(self) -> dict[str, Any]:
        """Return only the fields of the data class; the distance field is computed again or read from the cache."""
        return {name: getattr(self, name) for name in self.__dataclass_fields__}


@check_constructor
@dataclass(frozen=True, eq=False)
class Mesh(GriddedSolid):
    """Closed surface of triangles with the volume inside it.

    Attributes:
        shape: File (STL, OBJ, GLB or PLY; needs the extra ``cell``), or ``(vertices, faces)``: (V, 3) coordinates and (F, 3)
            row numbers of the corners.
        scale: Metres per unit of the file; 0.001 for millimetres.
        solid: ``exact`` is the surface itself, which must be closed; ``hull`` is its convex hull.
        surface: Outward triangles in the mesh's own frame, m; those of the convex hull for ``hull``.
        source: File of the mesh; None for arrays.

    Raises:
        InputError: The file is missing, empty or damaged, the surface is not closed, or its size suggests millimetres.
        HoldfastError: A file is given and the extra ``cell`` is not installed.
    """

    shape: str | Path | tuple[ArrayLike, ArrayLike]
    _: KW_ONLY
    scale: float = 1.0
    solid: Kind = "exact"
    surface: mesh.Triangles = field(init=False, repr=False)
    source: Source | None = field(init=False, default=None, repr=False)

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (np.isfinite(self.scale) and self.scale > 0):
            raise InputError(f"the scale of object '{self.name}' is {self.scale:g}; it must be finite and above 0")
        if self.solid not in get_args(Kind):
            raise InputError(f"object '{self.name}': solid '{self.solid}' is not known; use {' or '.join(get_args(Kind))}")
        if isinstance(self.shape, (str, Path)):
            try:
                triangles, content = mesh.read_mesh(Path(self.shape))
            except InputError as error:
                raise InputError(f"object '{self.name}': {error}") from error
            object.__setattr__(self, "source", Source(Path(self.shape).resolve(), hashlib.sha256(content).hexdigest()))
        else:
            triangles = mesh.make_triangles(
                *_split_vertices_and_faces(self.shape, self.name), f"the mesh of object '{self.name}'"
            )
        _reject_implausible_size(triangles.vertices * self.scale, self.name, f"is scale {0.001 * self.scale:g} meant?")
        object.__setattr__(
            self, "surface", self._orient_surface(mesh.Triangles(triangles.vertices * self.scale, triangles.faces))
        )

    def _orient_surface(self, triangles: mesh.Triangles) -> mesh.Triangles:
        if self.solid == "hull":
            return _convex_hull(triangles, self.name)
        if not triangles.is_closed:
            raise InputError(f"object '{self.name}': its mesh is not closed, so it has no inside; close it, or use solid: hull")
        return triangles if triangles.volume > 0 else mesh.Triangles(triangles.vertices, triangles.faces[:, ::-1].copy())

    @cached_property
    def digest(self) -> str:
        """SHA-256 of the triangles."""
        return _hash_arrays(self.surface.vertices, self.surface.faces)

    @cached_property
    def field(self) -> DistanceField:
        """Distance field in the mesh's own frame; computed on first use and cached on the disk."""
        return surface_field(self.surface, self.digest)


@check_constructor
@dataclass(frozen=True, eq=False)
class Points(GriddedSolid):
    """Cloud of points, as produced by a scanner, in which each point is a ball.

    Attributes:
        points: (N, 3) points in the cloud's own frame, m, or the .npy file with them.
        radius: Radius of every ball, m: at least half the distance between neighbouring points on the scanned surface.
        source: File of the points; None for an array.

    Raises:
        InputError: The file is missing or damaged, there are no points, or they are not finite or seem to be in millimetres.
    """

    points: FloatArray | str | Path
    _: KW_ONLY
    radius: float
    source: Source | None = field(init=False, default=None, repr=False)

    def __post_init__(self) -> None:
        super().__post_init__()
        self._require_length(self.radius, "radius")
        label = f"the points of object '{self.name}'"
        values: Any = self.points
        if isinstance(self.points, (str, Path)):
            path = Path(self.points)
            values, content = _read_array(path, self.name)
            object.__setattr__(self, "source", Source(path.resolve(), hashlib.sha256(content).hexdigest()))
        points = np.array(require_real_numbers(values, label))
        if points.ndim != 2 or points.shape[-1] != 3 or not len(points):
            raise InputError(f"{label} have shape {points.shape}; they must be (N, 3) numbers, at least one point, m")
        if not np.isfinite(points).all():
            raise InputError(f"{label} hold NaN or infinity; leave those points out")
        _reject_implausible_size(points, self.name, "are they in millimetres?")
        points.setflags(write=False)
        object.__setattr__(self, "points", points)

    @property
    def centres(self) -> FloatArray:
        """Centers (N, 3) of the balls in the cloud's own frame, m."""
        assert isinstance(self.points, np.ndarray)
        return self.points

    @cached_property
    def digest(self) -> str:
        """SHA-256 of the points."""
        return _hash_arrays(self.centres)

    @cached_property
    def field(self) -> DistanceField:
        """Distance field in the cloud's own frame; computed on first use and cached on the disk."""
        return cloud_field(self.centres, self.radius, self.digest)


def _split_vertices_and_faces(shape: Any, name: str) -> tuple[Any, Any]:
    try:
        vertices, faces = shape
    except (TypeError, ValueError) as error:
        raise InputError(f"object '{name}': its mesh must be a file, or vertices and faces") from error
    return vertices, faces


def _reject_implausible_size(points: FloatArray, name: str, advice: str) -> None:
    farthest = float(np.abs(points).max())
    if farthest > _MAX_COORDINATE_M:
        raise InputError(
            f"object '{name}' is {farthest:.4g} m from the origin of its own frame; give lengths in metres from a place nearby"
        )
    extent = float(np.ptp(points, axis=0).max())
    if extent > MAX_OBJECT_SIZE_M:
        raise InputError(f"object '{name}' is {extent:.4g} m large, more than {MAX_OBJECT_SIZE_M:g} m; {advice}")


def _convex_hull(triangles: mesh.Triangles, name: str) -> mesh.Triangles:
    """Return the convex hull with triangles that face outward."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(triangles.vertices)
    except QhullError as error:
        raise InputError(f"object '{name}': its mesh is flat, so its hull has no inside; give it as a thin box") from error
    corners = hull.points[hull.simplices]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    points_inward = (normals * hull.equations[:, :3]).sum(axis=1) < 0
    faces = np.where(points_inward[:, None], hull.simplices[:, ::-1], hull.simplices)
    return mesh.make_triangles(hull.points, faces, f"the hull of object '{name}'")


def _read_array(path: Path, name: str) -> tuple[Any, bytes]:
    with reading.guard_reading(f"object '{name}': '{path.name}'", "give the path of a .npy file that exists"):
        content = reading.read_bytes(path)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            # Without pickle, so that a file of points cannot run code.
            return np.load(io.BytesIO(content), allow_pickle=False), content
    except Exception as error:  # the header is Python code, which can raise any error
        raise InputError(f"object '{name}': '{path.name}' is damaged or not a .npy file; write it with numpy.save") from error


def _hash_arrays(*arrays: NDArray[Any]) -> str:
    digest = hashlib.sha256()
    for array in arrays:
        digest.update(repr(array.shape).encode() + np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()
