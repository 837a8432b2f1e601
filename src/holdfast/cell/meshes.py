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

from holdfast.arguments import checked_class, real_numbers
from holdfast.caching import cached_property
from holdfast.cell.field import Field, of_points, of_surface
from holdfast.cell.solids import Solid
from holdfast.errors import InputError
from holdfast.files import mesh, reading

Array = NDArray[np.float64]
Kind = Literal["exact", "hull"]

LARGEST = 50.0  # m: an object beyond that is in another unit
_FARTHEST = 1e6  # m


@dataclass(frozen=True)
class Source:
    """A file that an object was read from.

    Attributes:
        path: Where it was.
        sha256: Of its bytes.
    """

    path: Path
    sha256: str

    def changed(self) -> bool:
        """Whether the file is gone or has other bytes now."""
        try:
            return hashlib.sha256(reading.raw(self.path)).hexdigest() != self.sha256
        except OSError:
            return True


@dataclass(frozen=True, eq=False)
class Gridded(Solid):
    """An object whose distance is a lower bound from a grid of numbers, see :class:`holdfast.cell.Field`."""

    @property
    def field(self) -> Field:
        """The grid, in the object's own frame."""
        raise NotImplementedError

    def signed_distance(self, points: ArrayLike) -> Array:
        """A lower bound of the distance in m of points (..., 3) in the world from its surface, below 0 inside."""
        return self.distance_and_gradient(points)[0]

    def distance_and_gradient(self, points: ArrayLike) -> tuple[Array, Array]:
        """The same bound (...,), m, and its gradient (..., 3) in the world, of points (..., 3) in the world."""
        distance, gradient = self.field.distance_and_gradient(self.own(points))
        return distance, gradient @ self.pose[:3, :3].T

    def own(self, points: ArrayLike) -> Array:
        """Points (..., 3) in the world, m, in the object's own frame."""
        return np.asarray((np.asarray(points, dtype=np.float64) - self.pose[:3, 3]) @ self.pose[:3, :3])

    def __getstate__(self) -> dict[str, Any]:
        """The data alone: a field is made again, or found on the disk."""
        return {name: getattr(self, name) for name in self.__dataclass_fields__}


@checked_class
@dataclass(frozen=True, eq=False)
class Mesh(Gridded):
    """A closed surface of triangles and all that it encloses.

    Attributes:
        shape: File (STL, OBJ, GLB or PLY; needs the extra ``cell``), or ``(vertices, faces)``: (V, 3) numbers and (F, 3)
            positions in them.
        scale: Metres in one unit of the file: 0.001 for millimetres.
        solid: ``exact`` is the surface itself, which must be closed; ``hull`` is its convex hull.
        surface: The triangles, in m, in the mesh's own frame; of the hull for ``hull``. They face outward.
        source: The file; None for arrays.

    Raises:
        InputError: A file that is missing, empty or damaged, a surface that is not closed, or one in millimetres by its size.
        HoldfastError: A file, and the extra ``cell`` is not installed.
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
                found, content = mesh.read(Path(self.shape))
            except InputError as error:
                raise InputError(f"object '{self.name}': {error}") from error
            object.__setattr__(self, "source", Source(Path(self.shape).resolve(), hashlib.sha256(content).hexdigest()))
        else:
            found = mesh.triangles(*_pair(self.shape, self.name), f"the mesh of object '{self.name}'")
        _in_metres(found.vertices * self.scale, self.name, f"is scale {0.001 * self.scale:g} meant?")
        object.__setattr__(self, "surface", self._sound(mesh.Triangles(found.vertices * self.scale, found.faces)))

    def _sound(self, found: mesh.Triangles) -> mesh.Triangles:
        if self.solid == "hull":
            return _hull(found, self.name)
        if not found.closed:
            raise InputError(f"object '{self.name}': its mesh is not closed, so it has no inside; close it, or say solid: hull")
        return found if found.volume > 0 else mesh.Triangles(found.vertices, found.faces[:, ::-1].copy())

    @cached_property
    def digest(self) -> str:
        """SHA-256 of its triangles."""
        return _sha256(self.surface.vertices, self.surface.faces)

    @cached_property
    def field(self) -> Field:
        """The grid, in the mesh's own frame; made when it is first asked for, and kept on the disk."""
        return of_surface(self.surface, self.digest)


@checked_class
@dataclass(frozen=True, eq=False)
class Points(Gridded):
    """A cloud of points, as a scanner gives it: each is a ball.

    Attributes:
        points: (N, 3) m, in the cloud's own frame, or the .npy file that holds them.
        radius: Of every ball, m: at least half of what lies between neighbours on the thing that was scanned.
        source: The file; None for an array.

    Raises:
        InputError: A file that is missing or damaged, no points, points that are not finite, or in millimetres by their size.
    """

    points: Array | str | Path
    _: KW_ONLY
    radius: float
    source: Source | None = field(init=False, default=None, repr=False)

    def __post_init__(self) -> None:
        super().__post_init__()
        self._length(self.radius, "radius")
        what = f"the points of object '{self.name}'"
        values: Any = self.points
        if isinstance(self.points, (str, Path)):
            path = Path(self.points)
            values, content = _array(path, self.name)
            object.__setattr__(self, "source", Source(path.resolve(), hashlib.sha256(content).hexdigest()))
        found = np.array(real_numbers(values, what))
        if found.ndim != 2 or found.shape[-1] != 3 or not len(found):
            raise InputError(f"{what} have shape {found.shape}; they must be (N, 3) numbers, at least one point, m")
        if not np.isfinite(found).all():
            raise InputError(f"{what} hold NaN or infinity; leave those points out")
        _in_metres(found, self.name, "are they in millimetres?")
        found.setflags(write=False)
        object.__setattr__(self, "points", found)

    @property
    def centres(self) -> Array:
        """(N, 3) m, in its own frame."""
        assert isinstance(self.points, np.ndarray)
        return self.points

    @cached_property
    def digest(self) -> str:
        """SHA-256 of its points."""
        return _sha256(self.centres)

    @cached_property
    def field(self) -> Field:
        """The grid, in the cloud's own frame; made when it is first asked for, and kept on the disk."""
        return of_points(self.centres, self.radius, self.digest)


def _pair(shape: Any, name: str) -> tuple[Any, Any]:
    try:
        vertices, faces = shape
    except (TypeError, ValueError) as error:
        raise InputError(f"object '{name}': its mesh must be a file, or vertices and faces") from error
    return vertices, faces


def _in_metres(points: Array, name: str, question: str) -> None:
    far = float(np.abs(points).max())
    if far > _FARTHEST:
        raise InputError(
            f"object '{name}' is {far:.4g} m from the origin of its own frame; give lengths in metres from a place nearby"
        )
    size = float(np.ptp(points, axis=0).max())
    if size > LARGEST:
        raise InputError(f"object '{name}' is {size:.4g} m large, more than {LARGEST:g} m; {question}")


def _hull(found: mesh.Triangles, name: str) -> mesh.Triangles:
    """The convex hull, its triangles facing outward."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(found.vertices)
    except QhullError as error:
        raise InputError(f"object '{name}': its mesh is flat, so its hull has no inside; give it as a thin box") from error
    corners = hull.points[hull.simplices]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inward = (across * hull.equations[:, :3]).sum(axis=1) < 0
    faces = np.where(inward[:, None], hull.simplices[:, ::-1], hull.simplices)
    return mesh.triangles(hull.points, faces, f"the hull of object '{name}'")


def _array(path: Path, name: str) -> tuple[Any, bytes]:
    with reading.guarded(f"object '{name}': '{path.name}'", "give the path of a .npy file that exists"):
        content = reading.raw(path)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            # Without pickle: a file of points runs no code.
            return np.load(io.BytesIO(content), allow_pickle=False), content
    except Exception as error:  # its header is Python, which fails in every way
        raise InputError(f"object '{name}': '{path.name}' is damaged or not a .npy file; write it with numpy.save") from error


def _sha256(*arrays: NDArray[Any]) -> str:
    found = hashlib.sha256()
    for array in arrays:
        found.update(repr(array.shape).encode() + np.ascontiguousarray(array).tobytes())
    return found.hexdigest()
