"""Paths of the end effector: geometry without time."""

from __future__ import annotations

import pathlib
from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.result import Presentable
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.kinematics.paths.timing import Trapezoid
from holdfast.model.arm.poses import check_poses, rotation_vectors, rotations_of_vectors

_MAX_COORDINATE = 1e12  # m; beyond, squares overflow
_EQUAL_POSE_TOLERANCE = 1e-12  # m and rad: closer poses are equal
_CORNER_TOLERANCE = 1e-9  # relative jump of the twist below which there is no corner


@dataclass(frozen=True, eq=False)
class Path(Presentable):
    """Path of the end effector, ``s`` from 0 to 1, that consists of L legs. Use :func:`line`, :func:`arc`, or :func:`sequence`.

    On a leg, with u from 0 to 1, the position is ``center + exp(u sweep) (p0 - center) + u shift`` and the orientation ``exp(u
    turn) R0``, both at constant speed about axes that are fixed in the world. All legs have the same speed, because ``s`` is
    the fraction of :attr:`length`.

    Attributes:
        starts: (L, 4, 4) pose at the beginning of each leg, world frame, m.
        shift: (L, 3) straight motion of the end effector, m.
        center: (L, 3) point about which the position rotates, m.
        sweep: (L, 3) rotation vector of the position, rad; 0 for a straight leg.
        turn: (L, 3) rotation vector of the orientation, rad.
        oriented: False if only positions were given; the orientation is then the identity, for a task ``position``.
        name: Name for reports.
    """

    starts: FloatArray
    shift: FloatArray
    center: FloatArray
    _: KW_ONLY
    sweep: FloatArray
    turn: FloatArray
    oriented: bool = True
    name: str = "path"

    @cached_property
    def _leg_travels_and_rotations(self) -> tuple[FloatArray, FloatArray]:
        """Travel of the end effector, m, and rotation, rad, of each leg, (L,) each."""
        arc_lengths = np.linalg.norm(np.cross(self.sweep, self.starts[:, :3, 3] - self.center), axis=1)
        return np.hypot(np.linalg.norm(self.shift, axis=1), arc_lengths), np.linalg.norm(self.turn, axis=1)

    @property
    def length(self) -> float:
        """Length of the end effector's path, m, or rad for a path on which the end effector only rotates."""
        travel = float(self._leg_travels_and_rotations[0].sum())
        return travel if travel > _EQUAL_POSE_TOLERANCE else float(self._leg_travels_and_rotations[1].sum())

    @cached_property
    def bounds(self) -> FloatArray:
        """Values (L + 1,) of s at which the legs begin and end; a leg that only rotates counts 1 rad as 1 m."""
        travel, angles = self._leg_travels_and_rotations
        cumulative = np.cumsum(np.where(travel > _EQUAL_POSE_TOLERANCE, travel, angles))
        return np.concatenate([[0.0], cumulative[:-1] / cumulative[-1], [1.0]])

    @cached_property
    def corners(self) -> FloatArray:
        """Values (C,) of s, inside the path, at which the twist jumps."""
        junctions = self.bounds[1:-1]
        twist_before = self._leg_twist(junctions, np.arange(junctions.size))
        twist_after = self._leg_twist(junctions, np.arange(1, junctions.size + 1))
        return np.asarray(
            junctions[
                np.linalg.norm(twist_after - twist_before, axis=1) > _CORNER_TOLERANCE * np.linalg.norm(twist_before, axis=1)
            ]
        )

    def pose(self, s: ArrayLike) -> FloatArray:
        """Return the pose (4, 4) of the end effector in the world at ``s`` from 0 to 1, or (N, 4, 4) for (N,); NaN where s is
        NaN.

        Raises:
            InputError: An s is outside 0 to 1.
        """
        parameters = _check_path_parameters(s)
        leg, fractions = self._locate(np.atleast_1d(parameters))
        start_pose = self.starts[leg]
        radius_vectors = start_pose[:, :3, 3] - self.center[leg]
        poses = np.zeros((fractions.size, 4, 4))
        poses[:, :3, :3] = rotations_of_vectors(fractions[:, None] * self.turn[leg]) @ start_pose[:, :3, :3]
        rotated = _rotate_points(fractions[:, None] * self.sweep[leg], radius_vectors)
        # The displacement from the start, so that a straight leg has no rounding error from a rotation by 0.
        poses[:, :3, 3] = start_pose[:, :3, 3] + (rotated - radius_vectors) + fractions[:, None] * self.shift[leg]
        poses[:, 3, 3] = 1.0
        poses[np.isnan(fractions)] = np.nan
        return poses.reshape((*parameters.shape, 4, 4))

    def twist(self, s: ArrayLike) -> FloatArray:
        """Return the exact derivative of the pose by ``s``, (6,) or (N, 6) for (N,): linear (m), then angular (rad), world
        frame.

        It jumps at the :attr:`corners`, where it is the derivative of the leg that begins there.

        Raises:
            InputError: An s is outside 0 to 1.
        """
        parameters = _check_path_parameters(s)
        flat_parameters = np.atleast_1d(parameters)
        return self._leg_twist(flat_parameters, self._locate(flat_parameters)[0]).reshape((*parameters.shape, 6))

    def twist_slope(self, s: ArrayLike) -> FloatArray:
        """Return the derivative of :meth:`twist` by ``s``, (6,) or (N, 6) for (N,): 0 except on arcs, without jumps at corners.

        Raises:
            InputError: An s is outside 0 to 1.
        """
        parameters = _check_path_parameters(s)
        flat_parameters = np.atleast_1d(parameters)
        leg = self._locate(flat_parameters)[0]
        leg_fractions = np.diff(self.bounds)[leg, None]
        derivative = np.zeros((flat_parameters.size, 6))
        # In the linear part, shift is constant and the part that rotates about the centre rotates.
        linear = self._leg_twist(flat_parameters, leg)[:, :3] * leg_fractions - self.shift[leg]
        derivative[:, :3] = np.cross(self.sweep[leg], linear) / leg_fractions**2
        derivative[np.isnan(flat_parameters)] = np.nan
        return derivative.reshape((*parameters.shape, 6))

    def describe(self) -> str:
        """Describe the path in one sentence, in m and degrees."""
        travel, angle = (float(leg_values.sum()) for leg_values in self._leg_travels_and_rotations)
        parts = []
        if travel > _EQUAL_POSE_TOLERANCE:
            is_arc = np.linalg.norm(self.sweep, axis=1) > 0
            kind = "arc" if is_arc.all() else "straight" if not is_arc.any() else "arcs and lines"
            parts.append(f"{travel:.4g} m ({kind})")
        if angle > _EQUAL_POSE_TOLERANCE:
            parts.append(f"a rotation of {np.rad2deg(angle):.4g} deg")
        corners = f", {self.corners.size} corner{'s' * (self.corners.size != 1)}" if self.corners.size else ""
        return f"{' and '.join(parts)}{corners}{'' if self.oriented else '; positions only'}"

    @classmethod
    @check_arguments
    def load(cls, file: str | pathlib.Path) -> Path:
        """Return the path in the YAML ``file``; its format is in :mod:`holdfast.kinematics.paths.path_file`.

        Raises:
            InputError: The file cannot be read, or a key is unknown, missing or wrong; the message names it.
        """
        return load_path_file(file)[0]

    def _locate(self, s: FloatArray) -> tuple[IndexArray, FloatArray]:
        """Return the leg (N,) and the parameter u (N,) from 0 to 1 on it, of s (N,)."""
        leg = np.clip(np.searchsorted(self.bounds, s, side="right") - 1, 0, len(self.starts) - 1)
        return leg, (s - self.bounds[leg]) / np.diff(self.bounds)[leg]

    def _leg_twist(self, s: FloatArray, leg: IndexArray) -> FloatArray:
        """Return :meth:`twist` on legs (N,) that contain s (N,) or end at it."""
        leg_fractions = np.diff(self.bounds)[leg]
        u = (s - self.bounds[leg]) / leg_fractions
        rotated = _rotate_points(u[:, None] * self.sweep[leg], self.starts[leg, :3, 3] - self.center[leg])
        linear = self.shift[leg] + np.cross(self.sweep[leg], rotated)
        twists = np.concatenate([linear, self.turn[leg]], axis=1) / leg_fractions[:, None]
        twists[np.isnan(s)] = np.nan
        return twists


@check_arguments
def line(start: ArrayLike, end: ArrayLike, name: str = "line") -> Path:
    """Return a straight line of the end effector; the orientation rotates at constant speed about one axis, the short way.

    Args:
        start: (4, 4) pose in the world, or (3,) position, m.
        end: (4, 4) pose or (3,) position, m. If only one end has an orientation, it is kept; if none has, it is the identity.
        name: Name for reports.

    Raises:
        InputError: An end is not a pose or position, or start and end are equal.
    """
    return sequence([start, end], name)


@check_arguments
def sequence(poses: ArrayLike | Sequence[ArrayLike], name: str = "sequence") -> Path:
    """Return straight lines from pose to pose, without stops and without blends, so that the twist jumps at the corners.

    A real arm cannot follow a jump at full speed; :class:`holdfast.kinematics.paths.TimedPath` with ``stop=True`` stops at each
    corner.

    Args:
        poses: (N, 4, 4) poses, (N, 3) positions, m, or a list of both kinds; at least 2. A position takes the orientation of
            the previous pose, or of the first pose if there is none before.
        name: Name for reports.

    Raises:
        InputError: An entry is not a pose or position, there are too few, or two consecutive entries are equal.
    """
    matrices, oriented = _read_poses(poses)
    if len(matrices) < 2:
        raise InputError(f"a path needs 2 poses or more, got {len(matrices)}")
    rotations = _rotations_between(matrices)
    shift = np.diff(matrices[:, :3, 3], axis=0)
    leg_sizes = np.maximum(np.linalg.norm(shift, axis=1), np.linalg.norm(rotations, axis=1))
    if (leg_sizes <= _EQUAL_POSE_TOLERANCE).any():
        index = int(np.argmax(leg_sizes <= _EQUAL_POSE_TOLERANCE))
        raise InputError(f"poses {index} and {index + 1} of the path (from 0) are the same; leave one of them out")
    no_sweep = np.zeros_like(shift)
    return Path(matrices[:-1], shift, matrices[:-1, :3, 3], sweep=no_sweep, turn=rotations, oriented=oriented, name=name)


@check_arguments
def arc(
    start: ArrayLike,
    via: ArrayLike | None = None,
    end: ArrayLike | None = None,
    *,
    center: ArrayLike | None = None,
    axis: ArrayLike | None = None,
    angle: float | None = None,
    turning: bool = False,
    name: str = "arc",
) -> Path:
    """Return an arc of a circle, either through three points, or from a start about an axis.

    Args:
        start: (4, 4) pose in the world, or (3,) position, m.
        via: (4, 4) pose or (3,) position, m, on the arc; with ``end``. The orientation rotates from start to via and on to end,
            in proportion to the arc length.
        end: (4, 4) pose or (3,) position, m, at the end of the arc.
        center: (3,) point on the axis, m; with ``axis`` and ``angle``.
        axis: (3,) direction of the axis in the world.
        angle: Angle of the arc, rad, right-handed about the axis; it may exceed a full turn.
        turning: With ``center``: rotate the end effector with the arc, as a door handle does; otherwise keep its orientation.
        name: Name for reports.

    Raises:
        InputError: Neither form is given, points are collinear or equal, an axis or angle is 0, or the start is on the axis.
    """
    point_arguments, axis_arguments = (via, end), (center, axis, angle)
    if (
        all(argument is not None for argument in point_arguments)
        and all(argument is None for argument in axis_arguments)
        and not turning
    ):
        assert via is not None
        assert end is not None
        return _arc_through(start, via, end, name)
    if all(argument is None for argument in point_arguments) and all(argument is not None for argument in axis_arguments):
        assert center is not None
        assert axis is not None
        assert angle is not None
        return _arc_about(start, _as_vector(center, "center"), _as_vector(axis, "axis"), float(angle), turning, name)
    raise InputError("an arc needs either via and end, or center, axis and angle (and turning, if the tool turns with it)")


def _arc_through(start: ArrayLike, via: ArrayLike, end: ArrayLike, name: str) -> Path:
    matrices, oriented = _read_poses([start, via, end])
    first, middle, last = matrices[:, :3, 3]
    first_chord, second_chord = middle - first, last - first
    normal = np.cross(first_chord, second_chord)
    longest_chord = max(
        float(np.linalg.norm(first_chord)), float(np.linalg.norm(second_chord)), float(np.linalg.norm(last - middle))
    )
    if np.linalg.norm(normal) <= 1e-9 * longest_chord**2 or longest_chord <= _EQUAL_POSE_TOLERANCE:
        raise InputError("the three points of the arc lie on a line or are the same; give three points of one circle")
    # Circumcentre of a triangle, from its corner a.
    center = first + np.cross(
        normal, first_chord * (second_chord @ second_chord) - second_chord * (first_chord @ first_chord)
    ) / (2 * (normal @ normal))
    axis = normal / np.linalg.norm(normal)
    sweep = np.array(
        [
            axis * _angle_about(axis, from_point - center, to_point - center)
            for from_point, to_point in ((first, middle), (middle, last))
        ]
    )
    rotations = _rotations_between(matrices)
    no_shift = np.zeros((2, 3))
    return Path(matrices[:-1], no_shift, np.array([center, center]), sweep=sweep, turn=rotations, oriented=oriented, name=name)


def _arc_about(start: ArrayLike, center: FloatArray, axis: FloatArray, angle: float, turning: bool, name: str) -> Path:
    matrices, oriented = _read_poses([start])
    length = float(np.linalg.norm(axis))
    if length <= _EQUAL_POSE_TOLERANCE or not np.isfinite(angle) or abs(angle) <= _EQUAL_POSE_TOLERANCE:
        raise InputError(f"the arc has axis {axis.tolist()} and angle {angle:g} rad; neither may be 0, and both must be finite")
    sweep = axis / length * angle
    if np.linalg.norm(np.cross(sweep, matrices[0, :3, 3] - center)) <= _EQUAL_POSE_TOLERANCE:
        raise InputError("the start of the arc lies on its axis; move the center away from it")
    if turning and not oriented:
        raise InputError("an arc that turns the end effector must start from a pose (4, 4), not from a position")
    rotation = sweep if turning else np.zeros(3)
    return Path(matrices, np.zeros((1, 3)), center[None], sweep=sweep[None], turn=rotation[None], oriented=oriented, name=name)


def _angle_about(axis: FloatArray, from_vector: FloatArray, to_vector: FloatArray) -> float:
    """Return the angle from the first to the second vector about the axis, above 0 and below 2 pi."""
    return float(np.arctan2(axis @ np.cross(from_vector, to_vector), from_vector @ to_vector) % (2 * np.pi))


def _rotations_between(poses: FloatArray) -> FloatArray:
    """Return rotation vectors (N - 1, 3), world frame, from each pose to the next, by the smaller angle."""
    rotations = poses[:, :3, :3]
    return rotation_vectors(rotations[1:] @ rotations[:-1].transpose(0, 2, 1))


def _rotate_points(vectors: FloatArray, points: FloatArray) -> FloatArray:
    """Return points (N, 3) rotated by rotation vectors (N, 3)."""
    return np.asarray((rotations_of_vectors(vectors) @ points[:, :, None])[:, :, 0])


def _read_poses(values: ArrayLike | Sequence[ArrayLike]) -> tuple[FloatArray, bool]:
    """Return poses (N, 4, 4), and whether any orientation was given."""
    try:
        arrays = [np.asarray(value, dtype=np.float64) for value in values]  # type: ignore[union-attr]
    except (TypeError, ValueError) as error:
        raise InputError("a path needs poses (4, 4) or positions (3,), all of them numbers") from error
    poses = np.tile(np.eye(4), (len(arrays), 1, 1))
    has_orientation = np.zeros(len(arrays), dtype=bool)
    for index, value in enumerate(arrays):
        if value.shape not in ((3,), (4, 4)) or not np.isfinite(value).all():
            raise InputError(f"pose {index} of the path has shape {value.shape}; it must be (4, 4) or (3,), finite numbers")
        if np.abs(value).max() > _MAX_COORDINATE:
            raise InputError(
                f"pose {index} of the path holds {np.abs(value).max():.3g}; numbers must be at most {_MAX_COORDINATE:g}"
            )
        has_orientation[index] = value.shape == (4, 4)
        if has_orientation[index]:
            poses[index] = check_poses(value)[0]
        else:
            poses[index, :3, 3] = value
    if has_orientation.any():
        oriented_indices = np.flatnonzero(has_orientation)
        source_indices = oriented_indices[
            np.maximum(np.searchsorted(oriented_indices, np.arange(len(arrays)), side="right") - 1, 0)
        ]
        poses[:, :3, :3] = poses[source_indices, :3, :3]
    return poses, bool(has_orientation.any())


def _as_vector(value: ArrayLike, label: str) -> FloatArray:
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        array = np.zeros(0)
    if array.shape != (3,) or not np.isfinite(array).all():
        raise InputError(f"{label} of the arc is {value!r}; it must be 3 finite numbers")
    return array


def _check_path_parameters(s: ArrayLike) -> FloatArray:
    array = require_real_numbers(s, "s")
    if array.ndim > 1:
        raise InputError(f"s has shape {array.shape}; it must be one number or (N,)")
    if ((array < -1e-9) | (array > 1 + 1e-9)).any():
        raise InputError(f"s is {float(np.nanmin(array)):g} to {float(np.nanmax(array)):g}; it must lie from 0 to 1")
    return np.asarray(np.clip(array, 0.0, 1.0))


def load_path_file(file: str | pathlib.Path) -> tuple[Path, Trapezoid | None, bool]:
    """Return the path in a file, its timing or None, and whether to stop at corners.

    Raises:
        InputError: The file cannot be read, or a key is unknown, missing or wrong; the message names it.
    """
    from holdfast.kinematics.paths.path_file import parse_path_file

    shape_name, arguments, timing, stop = parse_path_file(path_object := pathlib.Path(file))
    constructors: dict[str, Callable[..., Path]] = {"line": line, "arc": arc, "sequence": sequence}
    try:
        return constructors[shape_name](**arguments), None if timing is None else Trapezoid(**timing), stop
    except InputError as error:
        raise InputError(f"path file '{path_object}': {error}") from error
