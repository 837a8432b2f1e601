"""What is kept along a whole motion: where the tool point stays, and how the tool stays turned."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked, real_numbers
from holdfast.arm.poses import check_poses, rotation_vectors
from holdfast.errors import InputError

Array = NDArray[np.float64]
Frame = Literal["base", "tool"]

WITHIN = (1e-3, float(np.deg2rad(0.5)))  # m and rad within which a row counts as kept between the waypoints
_ROUND = 1e-8  # m and rad
_DOWN = (0.0, 0.0, -1.0)
_FORWARD = (0.0, 0.0, 1.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class Kept:
    """Rows of the end effector's pose that are kept at every instant; made by :func:`upright`, :func:`rail`, :func:`plane`.

    Attributes:
        name: ``upright``, ``rail`` or ``plane``.
        normals: (k, 3) orthonormal directions in which the tool point stays where ``pose`` has it; none: it may be anywhere.
        direction: (3,) the unit vector that the tool's axis is kept along; None: it may point anywhere.
        axis: (3,) that axis, a unit vector in the tool's frame.
        angle: rad, half the opening of the cone about ``direction`` in which the axis stays; 0: it is along it.
        turned: The whole orientation stays as in ``pose``.
        frame: Whose axes normals and direction are given in: of the ``base``, or of the ``tool`` at the start.
        pose: (4, 4) through which the rail or plane goes, world, m; None: the tool's pose at the start.
        within: m and rad by which a row that is kept exactly may be missed between two waypoints.
    """

    name: str
    normals: Array
    direction: Array | None = None
    axis: Array
    angle: float = 0.0
    turned: bool = False
    frame: Frame = "base"
    pose: Array | None = None
    within: tuple[float, float] = WITHIN

    def anchored(self, start: Array) -> Kept:
        """The same in axes of the base and through a pose, given the tool's pose (4, 4) at the start."""
        turn = start[:3, :3] if self.frame == "tool" else np.eye(3)
        return replace(
            self,
            normals=self.normals @ turn.T,
            direction=None if self.direction is None else turn @ self.direction,
            frame="base",
            pose=start if self.pose is None else self.pose,
        )

    @property
    def widest(self) -> float:
        """By how much the tool may be turned away from what is kept, rad; infinite where its orientation is free."""
        if self.direction is None and not self.turned:
            return np.inf
        return self.angle or self.within[1]

    def off(self, poses: Array) -> tuple[Array, Array]:
        """How far (N,) the tool point is from its line or plane, m, and how far it is turned away, rad, at poses (N, 4, 4)."""
        assert self.pose is not None, "not anchored"
        away = np.linalg.norm((poses[:, :3, 3] - self.pose[:3, 3]) @ self.normals.T, axis=1)
        if self.turned:
            turned = np.linalg.norm(rotation_vectors(poses[:, :3, :3] @ self.pose[:3, :3].T), axis=1)
        elif self.direction is not None:
            pointing = poses[:, :3, :3] @ self.axis
            turned = np.arctan2(np.linalg.norm(np.cross(pointing, self.direction), axis=1), pointing @ self.direction)
        else:
            turned = np.zeros(len(poses))
        return away, turned

    def farthest(self, poses: Array) -> tuple[float, float]:
        """The most of :meth:`off` at poses (N, 4, 4), m and rad."""
        away, turned = self.off(poses)
        return float(away.max()), float(turned.max())

    def trouble(self, poses: Array) -> str:
        """By how much poses (N, 4, 4) break what is kept at most, a phrase; empty if they do not."""
        away, turned = self.farthest(poses)
        said = []
        if away > self.within[0] + _ROUND:
            said.append(f"{away:.4g} m off the {self.name}")
        if turned > self.widest + _ROUND:
            said.append(f"turned away by {np.rad2deg(turned):.4g} deg, beyond {np.rad2deg(self.widest):.4g} deg")
        return " and ".join(said)

    def __str__(self) -> str:
        said = []
        if len(self.normals):
            what = "line along" if len(self.normals) == 2 else "plane across"
            way = self.normals[0] if len(self.normals) == 1 else np.cross(*self.normals)
            said.append(f"the tool point on the {what} ({_text(way)})")
        if self.direction is not None:
            axis = "the tool's z axis" if np.array_equal(self.axis, _FORWARD) else f"the tool's axis ({_text(self.axis)})"
            said.append(f"{axis} within {np.rad2deg(self.widest):.4g} deg of ({_text(self.direction)})")
        if self.turned:
            said.append("its orientation as it is")
        return f"{self.name}, {' and '.join(said)}" + " in the tool's axes at the start" * (self.frame == "tool")

    def to_dict(self) -> dict[str, Any]:
        """As JSON data: everything that defines it."""
        values = {name: getattr(self, name) for name in self.__dataclass_fields__}
        return {name: x.tolist() if isinstance(x, np.ndarray) else x for name, x in values.items()}


@checked
def upright(angle: float, *, axis: ArrayLike = _FORWARD, direction: ArrayLike = _DOWN, within: ArrayLike = WITHIN) -> Kept:
    """Keep an axis of the tool in a cone: a tray level, a cup upright, a torch pointing down.

    Args:
        angle: rad, from 0 to below pi/2, half the opening of the cone; with 0 the axis stays along the direction, within
            ``within``.
        axis: (3,) in the tool's frame; its z axis if not given.
        direction: (3,) in the world; straight down if not given.
        within: m and rad within which rows are kept between two waypoints; here only with an angle of 0.

    Returns:
        What :func:`holdfast.recover` and :func:`holdfast.endure` take as ``keep``.

    Raises:
        InputError: An angle out of bounds, or a direction of length 0.
    """
    return Kept(
        name="upright",
        normals=np.zeros((0, 3)),
        direction=_unit(direction, "direction"),
        axis=_unit(axis, "axis"),
        angle=_angle(angle),
        within=_within(within),
    )


@checked
def rail(direction: ArrayLike, *, frame: Frame = "base", pose: ArrayLike | None = None, within: ArrayLike = WITHIN) -> Kept:
    """Keep the tool on a straight line with its orientation, as of a drawer: only the way along the line is free.

    Args:
        direction: (3,) of the line.
        frame: Whose axes it is given in: of the ``base``, or of the ``tool`` as it is at the start.
        pose: (4, 4) the line goes through, with the orientation that is kept, m, world; the tool's at the start if not given.
        within: m and rad within which rows are kept between two waypoints, at which they are met to 1e-6.

    Returns:
        What :func:`holdfast.recover` and :func:`holdfast.endure` take as ``keep``.

    Raises:
        InputError: A direction of length 0, or a pose or frame that cannot be read.
    """
    along = _unit(direction, "direction")
    across = np.linalg.svd(along[None])[2][1:]
    return Kept(
        name="rail",
        normals=across,
        axis=np.array(_FORWARD),
        turned=True,
        frame=_frame(frame),
        pose=_pose(pose),
        within=_within(within),
    )


@checked
def plane(
    normal: ArrayLike,
    *,
    angle: float | None = None,
    axis: ArrayLike = _FORWARD,
    frame: Frame = "base",
    pose: ArrayLike | None = None,
    within: ArrayLike = WITHIN,
) -> Kept:
    """Keep the tool point in a plane, as in wiping a board, and the tool against it if an angle is given.

    Args:
        normal: (3,) of the plane, towards the side that the tool is on.
        angle: rad, from 0 to below pi/2, by which the tool's axis may lean from straight against the plane, the direction
            opposite to the normal; None: it may point anywhere.
        axis: (3,) in the tool's frame; its z axis if not given.
        frame: Whose axes the normal is given in: of the ``base``, or of the ``tool`` as it is at the start.
        pose: (4, 4) or (3,) a place in the plane, m, world; the tool's at the start if not given.
        within: m and rad within which rows are kept between two waypoints, at which they are met to 1e-6.

    Returns:
        What :func:`holdfast.recover` and :func:`holdfast.endure` take as ``keep``.

    Raises:
        InputError: An angle out of bounds, a normal of length 0, or a place or frame that cannot be read.
    """
    across = _unit(normal, "normal")
    return Kept(
        name="plane",
        normals=across[None],
        direction=None if angle is None else -across,
        axis=_unit(axis, "axis"),
        angle=0.0 if angle is None else _angle(angle),
        frame=_frame(frame),
        pose=_pose(pose),
        within=_within(within),
    )


# ---- checked values ------------------------------------------------------------------------------------------------------


def _unit(value: ArrayLike, what: str) -> Array:
    v = real_numbers(value, what, "three numbers")
    if v.shape != (3,) or not np.isfinite(v).all() or np.linalg.norm(v) < 1e-9:
        raise InputError(f"{what} is {np.asarray(value).tolist()}; it must be three finite numbers, not all of them 0")
    return np.asarray(v / np.linalg.norm(v))


def _angle(angle: float) -> float:
    if not 0 <= angle < np.pi / 2:
        raise InputError(f"angle is {angle:g} rad; it must be from 0 to below pi/2 (90 deg)")
    return float(angle)


def _frame(frame: str) -> Frame:
    if frame not in ("base", "tool"):
        raise InputError(f"frame '{frame}' is not known; use 'base' or 'tool'")
    return frame  # type: ignore[return-value]


def _within(within: ArrayLike) -> tuple[float, float]:
    v = real_numbers(within, "within", "two numbers, m and rad")
    if v.shape != (2,) or not np.isfinite(v).all() or (v < 1e-5).any() or v[1] >= np.pi / 2:
        raise InputError(f"within is {np.asarray(within).tolist()}; it must be m and rad, each 1e-5 or more, below 90 deg")
    return float(v[0]), float(v[1])


def _pose(pose: ArrayLike | None) -> Array | None:
    if pose is None:
        return None
    given = real_numbers(pose, "pose", "a pose (4, 4)")
    if given.shape == (3,):
        whole = np.eye(4)
        whole[:3, 3] = given
        given = whole
    if given.shape != (4, 4) or not np.isfinite(given).all():
        raise InputError(f"pose has shape {given.shape}; give (4, 4) finite numbers, m")
    return np.asarray(check_poses(given[None])[0])


def _text(v: Array) -> str:
    return ", ".join(f"{x + 0.0:.4g}" for x in v)
