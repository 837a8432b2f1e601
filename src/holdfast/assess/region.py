"""Regions: which poses matter, and how often."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.model import Arm
from holdfast.errors import InputError

Array = NDArray[np.float64]
Sampling = Literal["random", "sobol"]

_POSE_BLOCK = 1024
_JOINT_BLOCK = 16384


def rotation_from_rpy(rpy: ArrayLike) -> Array:
    """Rotation matrices (..., 3, 3) from (roll, pitch, yaw), rad: ``R = Rz(roll) Ry(pitch) Rx(yaw)``.

    This is the order of the paper's toolbox, *not* the one of URDF and ROS, ``Rz(yaw) Ry(pitch) Rx(roll)``: the two swap
    the names of the first and the last angle. Convert at the edge by reversing the three numbers.

    Source: Abdi et al. 2012, section V.B; see ``docs/conventions``.
    """
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_euler("ZYX", np.asarray(rpy, dtype=np.float64)).as_matrix())


def rpy_from_rotation(rotation: ArrayLike) -> Array:
    """One (roll, pitch, yaw) triple, rad, that gives the rotation; pitch within +-90 degrees."""
    from scipy.spatial.transform import Rotation

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # at pitch +-90 degrees any one of the triples is fine
        return np.asarray(Rotation.from_matrix(np.asarray(rotation)).as_euler("ZYX"))


@dataclass(frozen=True)
class Region:
    """A distribution of poses (a box in position and angles) or of configurations (a box in the joints).

    Use :meth:`box` or :meth:`joints`. Samples come in blocks, each with its own seed, so that the k-th sample of a seed
    is the same whatever is computed before, beside or after it.

    Attributes:
        kind: ``box`` or ``joints``.
        center, size: Of the box: (6,) position then roll, pitch, yaw; or (n,) joints. m and rad.
        name: For reports.
    """

    kind: Literal["box", "joints"]
    center: tuple[float, ...]
    size: tuple[float, ...]
    name: str = "region"

    @classmethod
    def box(
        cls,
        center: ArrayLike,
        size: ArrayLike,
        rpy_center: ArrayLike = (0.0, 0.0, 0.0),
        rpy_size: ArrayLike = (0.0, 0.0, 0.0),
        name: str = "region",
    ) -> Region:
        """Poses uniform in a box of positions and, independently, a box of angles.

        Args:
            center: (3,) middle in the world, m.
            size: (3,) full edge lengths, m; a scalar is a cube.
            rpy_center: (3,) middle of (roll, pitch, yaw), rad; ``R = Rz(roll) Ry(pitch) Rx(yaw)``.
            rpy_size: (3,) full ranges, rad, or a scalar; angles are drawn about the centre by addition, so the pitch may
                leave +-90 degrees.
            name: For reports.

        Raises:
            InputError: Not three finite numbers, or a negative size.
        """
        parts = []
        for what, value, scalar in (
            ("center", center, False),
            ("size", size, True),
            ("rpy_center", rpy_center, False),
            ("rpy_size", rpy_size, True),
        ):
            try:
                a = np.asarray(value, dtype=np.float64)
            except (TypeError, ValueError):
                a = np.zeros(0)
            if scalar and a.ndim == 0:
                a = np.full(3, float(a))
            if a.shape != (3,) or not np.isfinite(a).all():
                raise InputError(f"region: {what} is {value!r}; it must be 3 finite numbers")
            if scalar and (a < 0).any():
                raise InputError(f"region: {what} is {a.tolist()}; sizes must not be negative")
            parts.append(a)
        middle, edges = np.r_[parts[0], parts[2]], np.r_[parts[1], parts[3]]
        return cls("box", tuple(middle.tolist()), tuple(edges.tolist()), name)

    @classmethod
    def joints(cls, lower: ArrayLike, upper: ArrayLike, name: str = "joint range") -> Region:
        """Configurations uniform between (n,) lower and upper joint values, rad and m: no inverse kinematics.

        Raises:
            InputError: Limits that are infinite, upside down or of different length.
        """
        try:
            low, high = np.asarray(lower, dtype=np.float64), np.asarray(upper, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise InputError("region of joints: lower and upper must be lists of numbers") from error
        if low.ndim != 1 or low.shape != high.shape:
            raise InputError(f"region of joints: lower has shape {low.shape} and upper {high.shape}; both must be (n,)")
        if not (np.isfinite(low).all() and np.isfinite(high).all()):
            raise InputError("region of joints: a limit is infinite; give finite ranges, for example -pi to pi")
        if (low > high).any():
            k = int(np.flatnonzero(low > high)[0])
            raise InputError(f"region of joints: lower {low[k]:g} of joint {k + 1} is above upper {high[k]:g}; swap them")
        return cls("joints", tuple(((low + high) / 2).tolist()), tuple((high - low).tolist()), name)

    @classmethod
    def around(cls, arm: Arm, q: ArrayLike | None = None, share: float = 0.25) -> Region:
        """A region to begin with when none is given: a cube about the tool at ``q``, edges ``share`` of the arm's reach.

        Angles range 90 degrees about the pose at ``q``; for an arm that moves in a plane, positions stay in that plane and
        the angle is free. ``q`` is the middle of the joint ranges if not given.
        """
        from holdfast.arm.task import plane_normal

        low = np.where(np.isfinite(arm.lower), arm.lower, -np.pi / 2)
        high = np.where(np.isfinite(arm.upper), arm.upper, np.pi / 2)
        middle = (low + high) / 2 if q is None else arm.check_configurations(q)
        if middle.ndim != 1 or not np.isfinite(middle).all():
            raise InputError(f"q of '{arm.name}' must be one configuration of {arm.n} finite numbers")
        pose = arm.forward_kinematics(middle)
        reach = sum(float(np.linalg.norm(j.origin[:3, 3])) for j in arm.joints[1:]) + float(np.linalg.norm(arm.tool[:3, 3]))
        edge = share * max(reach, 1e-3)
        angles = rpy_from_rotation(pose[:3, :3])
        normal = plane_normal(arm)
        if normal is not None and abs(normal[2]) > 1 - 1e-9:
            return cls.box(pose[:3, 3], [edge, edge, 0.0], angles, [2 * np.pi, 0.0, 0.0], name="default region")
        return cls.box(pose[:3, 3], edge, angles, np.pi / 2, name="default region")

    # ---- sampling --------------------------------------------------------------------------------------------------

    @property
    def block(self) -> int:
        """Samples per block: the unit that has its own seed."""
        return _POSE_BLOCK if self.kind == "box" else _JOINT_BLOCK

    def blocks(self, first: int, seed: int, sampling: Sampling = "random") -> Iterator[Array]:
        """Blocks of samples (block, 6) or (block, n), in order, from block number ``first`` on.

        Args:
            first: Number of the first block.
            seed: Of the run.
            sampling: ``random`` or ``sobol`` (scrambled low-discrepancy points; use a power of two of them).
        """
        width = len(self.center)
        low = np.array(self.center) - np.array(self.size) / 2
        engine = None
        if sampling == "sobol":
            from scipy.stats import qmc

            engine = qmc.Sobol(width, scramble=True, rng=np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(0,))))
            if first:
                engine.fast_forward(first * self.block)
        number = first
        while True:
            if engine is not None:
                unit = engine.random(self.block)
            else:
                generator = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(0, number)))
                unit = generator.random((self.block, width))
            unit *= np.array(self.size)
            unit += low
            yield unit
            number += 1

    def poses(self, samples: Array) -> Array:
        """Poses (N, 4, 4) of samples (N, 6) of a box."""
        t = np.zeros((len(samples), 4, 4))
        t[:, :3, 3] = samples[:, :3]
        t[:, :3, :3] = rotation_from_rpy(samples[:, 3:])
        t[:, 3, 3] = 1.0
        return t

    # ---- files -----------------------------------------------------------------------------------------------------

    def to_dict(self) -> dict[str, Any]:
        """JSON data of the region."""
        return {"kind": self.kind, "center": list(self.center), "size": list(self.size), "name": self.name}

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> Region:
        """The region :meth:`to_dict` wrote."""
        if data["kind"] not in ("box", "joints"):
            raise InputError(f"region: kind '{data['kind']}' is not known; use box or joints")
        return cls(data["kind"], tuple(data["center"]), tuple(data["size"]), data["name"])

    @classmethod
    def load(cls, path: str | Path) -> Region:
        """A region from a YAML file; see ``docs/files``.

        Raises:
            InputError: Unreadable, or a key that is unknown, missing or wrong; the message names it.
        """
        from holdfast.assess.region_file import read

        return read(path)

    def describe(self) -> str:
        """One sentence for people, degrees and metres."""
        if self.kind == "joints":
            return f"configurations uniform in a box of {len(self.center)} joints"
        c, s = np.round(self.center, 12), np.round(self.size, 12)
        return (
            f"positions in {s[0]:.3g} x {s[1]:.3g} x {s[2]:.3g} m about ({c[0]:.4g}, {c[1]:.4g}, {c[2]:.4g}) m; "
            "roll, pitch, yaw in "
            f"{np.rad2deg(s[3]):.4g} x {np.rad2deg(s[4]):.4g} x {np.rad2deg(s[5]):.4g} deg about "
            f"({np.rad2deg(c[3]):.4g}, {np.rad2deg(c[4]):.4g}, {np.rad2deg(c[5]):.4g}) deg, R = Rz(roll) Ry(pitch) Rx(yaw)"
        )


def builtin_region(arm: str) -> Region | None:
    """The region that a paper gives for a built-in arm.

    Source: Abdi et al. 2012, section V.B, printed centre; the pose at the nominal configuration differs by 0.5 mm.
    """
    if arm != "pa10-9dof":
        return None
    quarter = np.pi / 2
    return Region.box([0.968, 0.0, 0.041], 0.5, [0.0, np.deg2rad(174.0), 0.0], quarter, name="Abdi et al. 2012, section V.B")
