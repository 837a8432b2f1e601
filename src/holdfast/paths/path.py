"""Paths of the end effector: geometry without time."""

from __future__ import annotations

import pathlib
from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked, real_numbers
from holdfast.arm.poses import check_poses, rotation_vectors, rotations_of_vectors
from holdfast.caching import cached_property
from holdfast.errors import InputError
from holdfast.paths.timing import Trapezoid
from holdfast.result import Shown

Array = NDArray[np.float64]

_FARTHEST = 1e12  # m; beyond, squares overflow
_SAME = 1e-12  # m and rad: poses closer than this are one pose
_SMOOTH = 1e-9  # relative jump of the twist below which a corner is none


@dataclass(frozen=True, eq=False)
class Path(Shown):
    """A path of the end effector, ``s`` from 0 to 1, made of L legs. Use :func:`line`, :func:`arc` or :func:`sequence`.

    On a leg, with u from 0 to 1, the position is ``center + exp(u sweep) (p0 - center) + u shift`` and the orientation
    ``exp(u turn) R0``: both at constant speed, about axes that stay still in the world. The speed is the same on all
    legs: ``s`` is the share of :attr:`length`.

    Attributes:
        starts: (L, 4, 4) pose at which each leg begins, world frame, m.
        shift: (L, 3) straight motion of the end effector, m.
        center: (L, 3) point about which the end effector's position turns, m.
        sweep: (L, 3) rotation vector of that turn, rad; 0 for a straight leg.
        turn: (L, 3) rotation vector of the change of orientation, rad.
        oriented: False if only positions were given; the orientation is then the identity and a task ``position`` is meant.
        name: For reports.
    """

    starts: Array
    shift: Array
    center: Array
    _: KW_ONLY
    sweep: Array
    turn: Array
    oriented: bool = True
    name: str = "path"

    @cached_property
    def _sizes(self) -> tuple[Array, Array]:
        """(L,) way of the end effector, m, and turn, rad, of each leg."""
        around = np.linalg.norm(np.cross(self.sweep, self.starts[:, :3, 3] - self.center), axis=1)
        return np.hypot(np.linalg.norm(self.shift, axis=1), around), np.linalg.norm(self.turn, axis=1)

    @property
    def length(self) -> float:
        """Way of the end effector, m; of a path on which the end effector only turns, rad."""
        moved = float(self._sizes[0].sum())
        return moved if moved > _SAME else float(self._sizes[1].sum())

    @cached_property
    def bounds(self) -> Array:
        """(L + 1,) values of s at which the legs begin and end. A leg that only turns counts 1 rad as 1 m."""
        moved, turned = self._sizes
        ends = np.cumsum(np.where(moved > _SAME, moved, turned))
        return np.concatenate([[0.0], ends[:-1] / ends[-1], [1.0]])

    @cached_property
    def corners(self) -> Array:
        """(C,) values of s, inside the path, at which the twist jumps."""
        inner = self.bounds[1:-1]
        before, after = self._twist(inner, np.arange(inner.size)), self._twist(inner, np.arange(1, inner.size + 1))
        return np.asarray(inner[np.linalg.norm(after - before, axis=1) > _SMOOTH * np.linalg.norm(before, axis=1)])

    def pose(self, s: ArrayLike) -> Array:
        """Pose of the end effector in the world at s from 0 to 1, (4, 4), or (N, 4, 4) for s (N,); NaN where s is NaN.

        Raises:
            InputError: An s outside 0 to 1.
        """
        at = _share(s)
        leg, u = self._place(np.atleast_1d(at))
        start = self.starts[leg]
        arm = start[:, :3, 3] - self.center[leg]
        out = np.zeros((u.size, 4, 4))
        out[:, :3, :3] = rotations_of_vectors(u[:, None] * self.turn[leg]) @ start[:, :3, :3]
        around = _turned(u[:, None] * self.sweep[leg], arm)
        # The way from the start, so that a straight leg does not meet the rounding of a turn by 0.
        out[:, :3, 3] = start[:, :3, 3] + (around - arm) + u[:, None] * self.shift[leg]
        out[:, 3, 3] = 1.0
        out[np.isnan(u)] = np.nan
        return out.reshape((*at.shape, 4, 4))

    def twist(self, s: ArrayLike) -> Array:
        """Derivative of the pose by s, exact, (6,) or (N, 6): linear (m), then angular (rad), both in the world frame.

        It jumps at the :attr:`corners`, where it is that of the leg which begins there.

        Raises:
            InputError: An s outside 0 to 1.
        """
        at = _share(s)
        flat = np.atleast_1d(at)
        return self._twist(flat, self._place(flat)[0]).reshape((*at.shape, 6))

    def twist_slope(self, s: ArrayLike) -> Array:
        """Derivative of :meth:`twist` by s, (6,) or (N, 6): 0 but on arcs, and nothing of the jumps at corners.

        Raises:
            InputError: An s outside 0 to 1.
        """
        at = _share(s)
        flat = np.atleast_1d(at)
        leg = self._place(flat)[0]
        share = np.diff(self.bounds)[leg, None]
        out = np.zeros((flat.size, 6))
        # Of the linear part, shift stays as it is and the part that turns about the centre turns.
        linear = self._twist(flat, leg)[:, :3] * share - self.shift[leg]
        out[:, :3] = np.cross(self.sweep[leg], linear) / share**2
        out[np.isnan(flat)] = np.nan
        return out.reshape((*at.shape, 6))

    def describe(self) -> str:
        """One sentence for people, m and degrees."""
        moved, turned = (float(x.sum()) for x in self._sizes)
        parts = []
        if moved > _SAME:
            bent = np.linalg.norm(self.sweep, axis=1) > 0
            kind = "arc" if bent.all() else "straight" if not bent.any() else "arcs and lines"
            parts.append(f"{moved:.4g} m ({kind})")
        if turned > _SAME:
            parts.append(f"a turn of {np.rad2deg(turned):.4g} deg")
        corners = f", {self.corners.size} corner{'s' * (self.corners.size != 1)}" if self.corners.size else ""
        return f"{' and '.join(parts)}{corners}{'' if self.oriented else '; positions only'}"

    @classmethod
    @checked
    def load(cls, file: str | pathlib.Path) -> Path:
        """A path from a YAML file; the format is in :mod:`holdfast.paths.path_file`.

        Raises:
            InputError: Unreadable, or a key that is unknown, missing or wrong; the message names it.
        """
        return in_file(file)[0]

    def _place(self, s: Array) -> tuple[NDArray[np.intp], Array]:
        """Leg (N,) and u (N,) from 0 to 1 on it, of s (N,)."""
        leg = np.clip(np.searchsorted(self.bounds, s, side="right") - 1, 0, len(self.starts) - 1)
        return leg, (s - self.bounds[leg]) / np.diff(self.bounds)[leg]

    def _twist(self, s: Array, leg: NDArray[np.intp]) -> Array:
        """As :meth:`twist`, on legs (N,) that s (N,) lies on or at the end of."""
        share = np.diff(self.bounds)[leg]
        u = (s - self.bounds[leg]) / share
        around = _turned(u[:, None] * self.sweep[leg], self.starts[leg, :3, 3] - self.center[leg])
        linear = self.shift[leg] + np.cross(self.sweep[leg], around)
        out = np.concatenate([linear, self.turn[leg]], axis=1) / share[:, None]
        out[np.isnan(s)] = np.nan
        return out


@checked
def line(start: ArrayLike, end: ArrayLike, name: str = "line") -> Path:
    """A straight line of the end effector; the orientation turns at constant speed about one axis, the short way round.

    Args:
        start: (4, 4) pose in the world, or (3,) position, m.
        end: The same. Where only one has an orientation, it is kept; where none has, it is the identity.
        name: For reports.

    Raises:
        InputError: Not poses or positions, or start and end are the same.
    """
    return sequence([start, end], name)


@checked
def sequence(poses: ArrayLike | Sequence[ArrayLike], name: str = "sequence") -> Path:
    """Straight lines from pose to pose, without a stop and without rounding: the twist jumps at the corners.

    A real arm cannot do that at full speed; :class:`holdfast.paths.TimedPath` with ``stop=True`` stops at each corner.

    Args:
        poses: (N, 4, 4) poses, (N, 3) positions, m, or a list that mixes both; at least 2. A position takes the
            orientation of the pose before it (the first ones: of the first pose behind them).
        name: For reports.

    Raises:
        InputError: Not poses or positions, too few, or two that follow each other are the same.
    """
    t, oriented = _poses(poses)
    if len(t) < 2:
        raise InputError(f"a path needs 2 poses or more, got {len(t)}")
    turn = _turns(t)
    shift = np.diff(t[:, :3, 3], axis=0)
    size = np.maximum(np.linalg.norm(shift, axis=1), np.linalg.norm(turn, axis=1))
    if (size <= _SAME).any():
        k = int(np.argmax(size <= _SAME))
        raise InputError(f"poses {k} and {k + 1} of the path (from 0) are the same; leave one of them out")
    none = np.zeros_like(shift)
    return Path(t[:-1], shift, t[:-1, :3, 3], sweep=none, turn=turn, oriented=oriented, name=name)


@checked
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
    """An arc of a circle: either through three points, or from a start about an axis.

    Args:
        start: (4, 4) pose in the world, or (3,) position, m.
        via: A pose or position on the way; with ``end``. The orientation turns from start to via and on to end, in
            proportion to the way.
        end: Where the arc ends.
        center: (3,) a point on the axis, m; with ``axis`` and ``angle``.
        axis: (3,) direction of the axis in the world.
        angle: Angle of the arc, rad, right-handed about the axis; may be more than a full turn.
        turning: With ``center``: the end effector turns with the arc, as a door does; else its orientation stays.
        name: For reports.

    Raises:
        InputError: Neither of the two forms, points on a line or the same, an axis or angle of 0, or a start on the axis.
    """
    three, about = (via, end), (center, axis, angle)
    if all(x is not None for x in three) and all(x is None for x in about) and not turning:
        assert via is not None
        assert end is not None
        return _arc_through(start, via, end, name)
    if all(x is None for x in three) and all(x is not None for x in about):
        assert center is not None
        assert axis is not None
        assert angle is not None
        return _arc_about(start, _three(center, "center"), _three(axis, "axis"), float(angle), turning, name)
    raise InputError("an arc needs either via and end, or center, axis and angle (and turning, if the tool turns with it)")


def _arc_through(start: ArrayLike, via: ArrayLike, end: ArrayLike, name: str) -> Path:
    t, oriented = _poses([start, via, end])
    a, b, c = t[:, :3, 3]
    ab, ac = b - a, c - a
    normal = np.cross(ab, ac)
    size = max(float(np.linalg.norm(ab)), float(np.linalg.norm(ac)), float(np.linalg.norm(c - b)))
    if np.linalg.norm(normal) <= 1e-9 * size**2 or size <= _SAME:
        raise InputError("the three points of the arc lie on a line or are the same; give three points of one circle")
    # Circumcentre of a triangle, from its corner a.
    center = a + np.cross(normal, ab * (ac @ ac) - ac * (ab @ ab)) / (2 * (normal @ normal))
    axis = normal / np.linalg.norm(normal)
    sweep = np.array([axis * _angle_about(axis, p - center, q - center) for p, q in ((a, b), (b, c))])
    turn = _turns(t)
    none = np.zeros((2, 3))
    return Path(t[:-1], none, np.array([center, center]), sweep=sweep, turn=turn, oriented=oriented, name=name)


def _arc_about(start: ArrayLike, center: Array, axis: Array, angle: float, turning: bool, name: str) -> Path:
    t, oriented = _poses([start])
    length = float(np.linalg.norm(axis))
    if length <= _SAME or not np.isfinite(angle) or abs(angle) <= _SAME:
        raise InputError(f"the arc has axis {axis.tolist()} and angle {angle:g} rad; neither may be 0, and both must be finite")
    sweep = axis / length * angle
    if np.linalg.norm(np.cross(sweep, t[0, :3, 3] - center)) <= _SAME:
        raise InputError("the start of the arc lies on its axis; move the center away from it")
    if turning and not oriented:
        raise InputError("an arc that turns the end effector must start from a pose (4, 4), not from a position")
    turn = sweep if turning else np.zeros(3)
    return Path(t, np.zeros((1, 3)), center[None], sweep=sweep[None], turn=turn[None], oriented=oriented, name=name)


def _angle_about(axis: Array, p: Array, q: Array) -> float:
    """Angle from p to q about the axis, above 0 and below 2 pi."""
    return float(np.arctan2(axis @ np.cross(p, q), p @ q) % (2 * np.pi))


def _turns(t: Array) -> Array:
    """Rotation vectors (N - 1, 3), world frame, from each pose to the next, the short way round."""
    r = t[:, :3, :3]
    return rotation_vectors(r[1:] @ r[:-1].transpose(0, 2, 1))


def _turned(vectors: Array, points: Array) -> Array:
    """Points (N, 3) turned by rotation vectors (N, 3)."""
    return np.asarray((rotations_of_vectors(vectors) @ points[:, :, None])[:, :, 0])


def _poses(values: ArrayLike | Sequence[ArrayLike]) -> tuple[Array, bool]:
    """Poses (N, 4, 4), and whether any orientation was given."""
    try:
        given = [np.asarray(value, dtype=np.float64) for value in values]  # type: ignore[union-attr]
    except (TypeError, ValueError) as error:
        raise InputError("a path needs poses (4, 4) or positions (3,), all of them numbers") from error
    out = np.tile(np.eye(4), (len(given), 1, 1))
    whole = np.zeros(len(given), dtype=bool)
    for k, value in enumerate(given):
        if value.shape not in ((3,), (4, 4)) or not np.isfinite(value).all():
            raise InputError(f"pose {k} of the path has shape {value.shape}; it must be (4, 4) or (3,), finite numbers")
        if np.abs(value).max() > _FARTHEST:
            raise InputError(f"pose {k} of the path holds {np.abs(value).max():.3g}; numbers must be at most {_FARTHEST:g}")
        whole[k] = value.shape == (4, 4)
        if whole[k]:
            out[k] = check_poses(value)[0]
        else:
            out[k, :3, 3] = value
    if whole.any():
        known = np.flatnonzero(whole)
        source = known[np.maximum(np.searchsorted(known, np.arange(len(given)), side="right") - 1, 0)]
        out[:, :3, :3] = out[source, :3, :3]
    return out, bool(whole.any())


def _three(value: ArrayLike, what: str) -> Array:
    try:
        a = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        a = np.zeros(0)
    if a.shape != (3,) or not np.isfinite(a).all():
        raise InputError(f"{what} of the arc is {value!r}; it must be 3 finite numbers")
    return a


def _share(s: ArrayLike) -> Array:
    a = real_numbers(s, "s")
    if a.ndim > 1:
        raise InputError(f"s has shape {a.shape}; it must be one number or (N,)")
    if ((a < -1e-9) | (a > 1 + 1e-9)).any():
        raise InputError(f"s is {float(np.nanmin(a)):g} to {float(np.nanmax(a)):g}; it must lie from 0 to 1")
    return np.asarray(np.clip(a, 0.0, 1.0))


def in_file(file: str | pathlib.Path) -> tuple[Path, Trapezoid | None, bool]:
    """The path in a file, its timing if it has one, and whether to stop at corners.

    Raises:
        InputError: Unreadable, or a key that is unknown, missing or wrong; the message names it.
    """
    from holdfast.paths.path_file import read

    shape, given, timing, stop = read(named := pathlib.Path(file))
    make: dict[str, Callable[..., Path]] = {"line": line, "arc": arc, "sequence": sequence}
    try:
        return make[shape](**given), None if timing is None else Trapezoid(**timing), stop
    except InputError as error:
        raise InputError(f"path file '{named}': {error}") from error
