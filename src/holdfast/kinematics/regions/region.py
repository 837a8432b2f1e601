"""Regions: distributions of the poses that count in an assessment."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.result import Presentable
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.regions.pose_list import PoseList
from holdfast.kinematics.regions.weights import Density, check_weights, swap_roll_and_yaw
from holdfast.model.arm.model import Arm

Sampling = Literal["random", "sobol"]
Draw = Callable[[np.random.Generator, int], ArrayLike | tuple[ArrayLike, ArrayLike]]
Weight = Callable[[FloatArray], ArrayLike]
Order = Literal["urdf", "abdi"]

_POSES_PER_BLOCK = 1024
_CONFIGURATIONS_PER_BLOCK = 16384


def rotation_from_rpy(rpy: ArrayLike) -> FloatArray:
    """Return rotation matrices (..., 3, 3) from ``rpy`` (..., 3), roll, pitch, yaw, rad: ``R = Rz(roll) Ry(pitch) Rx(yaw)``.

    This is the order of the paper's toolbox, *not* the order of URDF and ROS, ``Rz(yaw) Ry(pitch) Rx(roll)``. The two swap the
    names of the first and the last angle, so reverse the three numbers to convert.

    Source: Abdi et al. 2012, section V.B; see ``docs/conventions``.
    """
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_euler("ZYX", np.asarray(rpy, dtype=np.float64)).as_matrix())


def rpy_from_rotation(rotation: ArrayLike) -> FloatArray:
    """Return one (roll, pitch, yaw), rad, of the matrix ``rotation`` (3, 3) in that order; pitch within +-90 degrees."""
    from scipy.spatial.transform import Rotation

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # at pitch +-90 degrees any of the triples is valid
        return np.asarray(Rotation.from_matrix(np.asarray(rotation)).as_euler("ZYX"))


def rotations_in_cone(axis: FloatArray, samples: FloatArray) -> FloatArray:
    """Return rotations (N, 3, 3) whose z axes are on a spherical cap.

    Args:
        axis: (3,) unit vector at the centre of the cap.
        samples: (N, 3) cosine of the angle from the axis, direction about the axis, rad, and rotation about the z axis, rad.
            Uniform numbers give uniform directions on the sphere, because the area of a cap is linear in its height.
    """
    from scipy.spatial.transform import Rotation

    angle = np.arccos(np.clip(samples[:, 0], -1.0, 1.0))
    tilted = Rotation.from_euler("ZYZ", np.column_stack([samples[:, 1], angle, samples[:, 2] - samples[:, 1]]))
    if axis[2] < -1 + 1e-12:  # half a turn about x, because the formula below has no direction
        z_to_axis = Rotation.from_quat([1.0, 0.0, 0.0, 0.0])
    else:
        z_to_axis = Rotation.from_quat([-axis[1], axis[0], 0.0, 1 + axis[2]])
    return np.asarray((z_to_axis * tilted).as_matrix())


@dataclass(frozen=True)
class Region(Presentable):
    """Distribution of poses (a box, a cone, a list, a function) or of configurations (a box in joint space).

    Use :meth:`box`, :meth:`cone`, :meth:`from_poses`, :meth:`sampler` or :meth:`joints`. Samples come in blocks with their own
    seeds, so the k-th sample of a seed never depends on other computations. Samples may have weights, for example where the
    robot works more often; statistics are then weighted.

    Attributes:
        kind: ``box``, ``cone``, ``joints``, ``poses`` (a list) or ``sampler`` (a function).
        center, size: Centre and size of the box: (6,) position, then the angles a, b, c of ``Rz(a) Ry(b) Rx(c)``. Of the cone:
            (6,) position, cosine of the angle from its axis, direction about the axis, rotation of the tool about its own z
            axis.
            Of a region of joints: (n,) joint values. m and rad. Empty for the other kinds.
        name: Name for reports.
        weight: Weight function of samples (N, 6) of a box, or None for equal weights.
        listed: Poses of a list.
        draw: Function of a sampler, and whether it returns weights.
        axis: (3,) unit vector at the centre of the cone; empty for the other kinds.
    """

    kind: Literal["box", "cone", "joints", "poses", "sampler"]
    center: tuple[float, ...]
    size: tuple[float, ...]
    _: KW_ONLY
    name: str = "region"
    weight: Weight | None = None
    listed: PoseList | None = None
    draw: tuple[Draw, bool] | None = None
    axis: tuple[float, ...] = ()

    @classmethod
    @check_arguments
    def box(
        cls,
        center: ArrayLike,
        size: ArrayLike,
        rpy_center: ArrayLike = (0.0, 0.0, 0.0),
        rpy_size: ArrayLike = (0.0, 0.0, 0.0),
        name: str = "region",
        weight: Weight | Mapping[str, Sequence[Sequence[float]]] | None = None,
        *,
        order: Order = "urdf",
    ) -> Region:
        """Return a region of poses uniform in a box of positions and, independently, a box of angles, with optional weights.

        Args:
            center: (3,) centre in the world, m.
            size: (3,) full edge lengths, m; a scalar is a cube.
            rpy_center: (3,) centre of (roll, pitch, yaw), rad; as in URDF ``R = Rz(yaw) Ry(pitch) Rx(roll)``.
            rpy_size: (3,) full ranges, rad, or a scalar; sampled offsets are added to the centre, so the pitch may leave +-90
                degrees.
            name: Name for reports.
            weight: Weight of a pose, 0 or more; only ratios matter. Either a function of samples (N, 6), x, y, z, then the
                angles about z, y, and x (yaw, pitch, roll) in m and rad, that returns (N,); a results folder cannot store it.
                Or points by coordinate, which it can store: ``{"z": [(0.0, 1), (0.5, 3)]}`` is linear between the points and
                constant beyond them; several coordinates are multiplied.
            order: Convention of roll, pitch, yaw: ``urdf``, or ``abdi`` for ``R = Rz(roll) Ry(pitch) Rx(yaw)``, the order of
                Abdi et al. 2012, which swaps the names of the first and the last angle.

        Raises:
            InputError: An argument is not three finite numbers, a size is negative, or the order or the weight is not valid.
        """
        if order not in ("urdf", "abdi"):
            raise InputError(f"region: order is {order!r}; use urdf or abdi")
        parts = []
        for label, value, scalar in (
            ("center", center, False),
            ("size", size, True),
            ("rpy_center", rpy_center, False),
            ("rpy_size", rpy_size, True),
        ):
            try:
                array = np.asarray(value, dtype=np.float64)
            except (TypeError, ValueError):
                array = np.zeros(0)
            if scalar and array.ndim == 0:
                array = np.full(3, float(array))
            if array.shape != (3,) or not np.isfinite(array).all():
                raise InputError(f"region: {label} is {value!r}; it must be 3 finite numbers")
            if scalar and (array < 0).any():
                raise InputError(f"region: {label} is {array.tolist()}; sizes must not be negative")
            parts.append(array)
        angle_order = slice(None, None, -1 if order == "urdf" else 1)
        middle, edge_lengths = np.r_[parts[0], parts[2][angle_order]], np.r_[parts[1], parts[3][angle_order]]
        if weight is not None and not callable(weight):
            if not isinstance(weight, Mapping):
                raise InputError("region: weight must be a function of samples (N, 6), or points by coordinate")
            weight = Density.from_points(weight if order == "abdi" else swap_roll_and_yaw(weight))
        return cls("box", tuple(middle.tolist()), tuple(edge_lengths.tolist()), name=name, weight=weight)

    @classmethod
    @check_arguments
    def cone(
        cls,
        center: ArrayLike,
        size: ArrayLike,
        *,
        axis: ArrayLike,
        within: float,
        name: str = "region",
        weight: Weight | Mapping[str, Sequence[Sequence[float]]] | None = None,
    ) -> Region:
        """Return a region of poses uniform in a box of positions, with the tool's z axis uniform on a spherical cap and any
        roll.

        Args:
            center: (3,) centre of the positions in the world, m.
            size: (3,) full edge lengths, m; a scalar is a cube.
            axis: (3,) direction at the centre of the cap, in the world, of any length except 0.
            within: Largest angle between the tool's z axis and ``axis``, rad, 0 to pi.
            name: Name for reports.
            weight: Weight as for :meth:`box`; points by coordinate only for x, y, and z.

        Raises:
            InputError: An argument is not three finite numbers, the axis is 0, the angle is out of range, or the weight is not
                valid.
        """
        box = cls.box(center, size, name=name, weight=weight)
        try:
            direction = np.asarray(axis, dtype=np.float64)
        except (TypeError, ValueError):
            direction = np.zeros(0)
        if direction.shape != (3,) or not np.isfinite(direction).all() or not np.linalg.norm(direction) > 1e-9:
            raise InputError(f"region: axis of the cone is {axis!r}; it must be 3 finite numbers, not all 0")
        if not (np.isfinite(within) and 0 <= within <= np.pi):
            raise InputError(f"region: within is {np.rad2deg(within):g} degrees; it must be between 0 and 180")
        if isinstance(box.weight, Density) and (
            unknown := {coordinate for coordinate, _ in box.weight.pieces} - {"x", "y", "z"}
        ):
            raise InputError(f"region: density of {min(unknown)} does not go with a cone; use x, y, z")
        lowest = float(np.cos(within))
        middle, edge_lengths = (*box.center[:3], (1 + lowest) / 2, 0.0, 0.0), (*box.size[:3], 1 - lowest, 2 * np.pi, 2 * np.pi)
        unit = tuple((direction / np.linalg.norm(direction)).tolist())
        return cls("cone", middle, edge_lengths, name=name, weight=box.weight, axis=unit)

    @property
    def max_tilt(self) -> float:
        """Largest angle between the tool's z axis and the axis of the cone, rad."""
        return float(np.arccos(np.clip(1 - self.size[3], -1.0, 1.0)))

    @classmethod
    @check_arguments
    def from_poses(cls, poses: ArrayLike, weights: ArrayLike | None = None, name: str = "list of poses") -> Region:
        """Return the region of a list of poses, for example a recorded job or waypoints.

        An assessment with the number of poses in the list (the default) uses each pose once, in order and with its weight. Any
        other number is sampled from the list with replacement, in proportion to the weights; the sampled poses then have equal
        weights.

        Args:
            poses: (N, 4, 4) poses in the world, m.
            weights: (N,) weights, 0 or more; default: equal weights.
            name: Name for reports.

        Raises:
            InputError: Poses are not transforms, not finite or none, or there is not one weight per pose.
        """
        return cls("poses", (), (), name=name, listed=PoseList.from_matrices(poses, weights))

    @classmethod
    def sampler(cls, draw: Draw, name: str = "own sampler") -> Region:
        """Return a region of poses that a user-defined function samples; a results folder cannot store it.

        Args:
            draw: Function ``draw(generator, count)`` that returns poses (count, 4, 4) in the world, m, or a pair of poses and
                weights (count,), 0 or more. It must take all randomness from the ``numpy.random.Generator`` and keep no state
                between calls, so that a seed always gives the same poses.
            name: Name for reports.

        Raises:
            InputError: The function does not return such arrays (two poses are sampled as a test).
        """
        if not callable(draw):
            raise InputError("region: a sampler must be a function draw(generator, count)")
        sampled = draw(np.random.default_rng(0), 2)
        region = cls("sampler", (), (), name=name, draw=(draw, isinstance(sampled, tuple)))
        region._read_custom_samples(sampled, 2)
        return region

    @classmethod
    @check_arguments
    def joints(cls, lower: ArrayLike, upper: ArrayLike, name: str = "joint range") -> Region:
        """Return a region of configurations uniform between ``lower`` and ``upper`` (n,), rad and m, without inverse
        kinematics.

        ``name`` is the name for reports.

        Raises:
            InputError: Limits are infinite, reversed or of different length.
        """
        try:
            lower_values, upper_values = np.asarray(lower, dtype=np.float64), np.asarray(upper, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise InputError("region of joints: lower and upper must be lists of numbers") from error
        if lower_values.ndim != 1 or lower_values.shape != upper_values.shape:
            raise InputError(
                f"region of joints: lower has shape {lower_values.shape} and upper {upper_values.shape}; both must be (n,)"
            )
        if not (np.isfinite(lower_values).all() and np.isfinite(upper_values).all()):
            raise InputError("region of joints: a limit is infinite; give finite ranges, for example -pi to pi")
        if (lower_values > upper_values).any():
            index = int(np.flatnonzero(lower_values > upper_values)[0])
            raise InputError(
                f"region of joints: lower {lower_values[index]:g} of joint {index + 1} is above upper "
                f"{upper_values[index]:g}; swap them"
            )
        center, size = (lower_values + upper_values) / 2, upper_values - lower_values
        return cls("joints", tuple(center.tolist()), tuple(size.tolist()), name=name)

    @classmethod
    @check_arguments
    def around_tool(cls, arm: Arm, q: ArrayLike | None = None, share: float = 0.25) -> Region:
        """Return the default region of ``arm``: a cube about the tool at ``q`` (n,), rad and m, with edges of ``share`` of its
        reach.

        Angles range over 90 degrees about the pose at ``q``; for a planar arm positions stay in its plane and the angle is
        free. The default of ``q`` is the configuration farthest from a singularity among 256 in the middle halves of the joint
        ranges, because in the middle of the ranges many arms are stretched, and half of the cube would be out of reach.
        """
        from holdfast.model.arm.task import plane_normal

        reach = sum(float(np.linalg.norm(joint.origin[:3, 3])) for joint in arm.joints[1:]) + float(
            np.linalg.norm(arm.tool[:3, 3])
        )
        reach = max(reach, 1e-3)
        home = _well_conditioned_configuration(arm, reach) if q is None else arm.check_configurations(q)
        if home.ndim != 1 or not np.isfinite(home).all():
            raise InputError(f"q of '{arm.name}' must be one configuration of {arm.n} finite numbers")
        pose = arm.forward_kinematics(home)
        edge = share * reach
        angles = rpy_from_rotation(pose[:3, :3])
        normal = plane_normal(arm)
        if normal is not None and abs(normal[2]) > 1 - 1e-9:
            angle_ranges = [2 * np.pi, 0.0, 0.0]
            return cls.box(pose[:3, 3], [edge, edge, 0.0], angles, angle_ranges, name="default region", order="abdi")
        return cls.box(pose[:3, 3], edge, angles, np.pi / 2, name="default region", order="abdi")

    # ---- sampling --------------------------------------------------------------------------------------------------

    @property
    def block(self) -> int:
        """Number of samples per block, which has its own seed."""
        return _CONFIGURATIONS_PER_BLOCK if self.kind == "joints" else _POSES_PER_BLOCK

    def has_weights(self, count: int) -> bool:
        """Return whether ``count`` samples have weights; samples drawn from a list in proportion to its weights have none."""
        if self.listed is not None:
            return self.listed.weights is not None and count == len(self.listed)
        return self.weight is not None or (self.draw is not None and self.draw[1])

    def blocks(self, first: int, seed: int, sampling: Sampling = "random", *, count: int | None = None) -> Iterator[FloatArray]:
        """Yield blocks of samples, in order, from block number ``first`` on.

        A sample of a box is (6,), of a region of joints (n,), of a list the number of the pose (1,), and of a sampler the first
        three rows of the pose and its weight (13,).

        Args:
            first: Number of the first block, from 0.
            seed: Seed of the run.
            sampling: ``random`` or ``sobol`` (scrambled low-discrepancy points; use a power of two of them).
            count: Total number of samples; it matters only for a list, see :meth:`from_poses`.
        """
        if self.draw is not None:
            yield from self._sampler_blocks(first, seed)
        elif self.listed is not None and count == len(self.listed):
            for start in range(first * self.block, count, self.block):
                yield np.arange(start, min(start + self.block, count), dtype=np.float64)[:, None]
        elif self.listed is not None:
            for unit in self._uniform_blocks(first, seed, sampling, 1):
                yield self.listed.sample_indices(unit[:, 0])[:, None].astype(np.float64)
        else:
            for unit in self._uniform_blocks(first, seed, sampling, len(self.center)):
                yield self._scale_to_box(unit)

    def samples(
        self, start: int, stop: int, block: int, *, seed: int, sampling: Sampling, count: int, out: FloatArray | None = None
    ) -> FloatArray:
        """Return samples ``start`` up to ``stop`` of ``count``, at most one block, from the random numbers of one block.

        For a box also more samples, from the following blocks. The samples equal those of :meth:`blocks` if ``start`` begins
        the block. ``sobol`` points, and poses of a list with ``count`` entries, depend only on their number.

        Args:
            start: First sample.
            stop: Sample after the last.
            block: Number of the block whose seed is used.
            seed: Seed of the run.
            sampling: ``random`` or ``sobol``.
            count: Total number of samples.
            out: Contiguous array (N, 6) or (N, n) for the samples of a box; None: a new array.
        """
        if self.listed is not None and count == len(self.listed):
            return np.arange(start, stop, dtype=np.float64)[:, None]
        if self.listed is None and self.draw is None:
            return self._sample_box(
                np.empty((stop - start, len(self.center))) if out is None else out, start, block, seed, sampling
            )
        if sampling == "random":
            return next(self.blocks(block, seed, sampling, count=count))[: stop - start]
        assert self.listed is not None
        unit = self._sobol_engine(seed, 1, start).random(stop - start)
        return self.listed.sample_indices(unit[:, 0])[:, None].astype(np.float64)

    def _sample_box(self, out: FloatArray, start: int, block: int, seed: int, sampling: Sampling) -> FloatArray:
        """Write samples of a box from number ``start`` on, which lies in ``block``, into ``out`` (N, w)."""
        if sampling == "sobol":
            out[:] = self._scale_to_box(self._sobol_engine(seed, out.shape[1], start).random(len(out)))
            return out
        for offset in range(0, len(out), self.block):
            part = out[offset : offset + self.block]
            self._block_generator(seed, block + offset // self.block).random(out=part)
            self._scale_to_box(part)
        return out

    def _scale_to_box(self, unit: FloatArray) -> FloatArray:
        """Return samples of a box from points (N, w) of the unit cube, which are overwritten if they are contiguous."""
        size, lower = np.array(self.size), np.array(self.center) - np.array(self.size) / 2
        # Samples as columns, because numpy is half as fast on rows of a few numbers.
        group = math.gcd(len(unit), 64)
        grouped = unit.reshape(-1, group * unit.shape[1])
        grouped *= np.tile(size, group)
        grouped += np.tile(lower, group)
        return grouped.reshape(unit.shape)

    @staticmethod
    def _sobol_engine(seed: int, width: int, start: int) -> Any:
        """Return the generator of scrambled low-discrepancy points (width,) from number ``start`` on."""
        from scipy.stats import qmc

        engine = qmc.Sobol(width, scramble=True, rng=np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(0,))))
        if start:
            engine.fast_forward(start)
        return engine

    def _uniform_blocks(self, number: int, seed: int, sampling: Sampling, width: int) -> Iterator[FloatArray]:
        """Yield blocks (block, width) of points uniform in the unit cube."""
        engine = self._sobol_engine(seed, width, number * self.block) if sampling == "sobol" else None
        while True:
            if engine is not None:
                yield engine.random(self.block)
            else:
                yield self._block_generator(seed, number).random((self.block, width))
            number += 1

    def _sampler_blocks(self, number: int, seed: int) -> Iterator[FloatArray]:
        assert self.draw is not None
        while True:
            yield self._read_custom_samples(self.draw[0](self._block_generator(seed, number), self.block), self.block)
            number += 1

    @staticmethod
    def _block_generator(seed: int, number: int) -> np.random.Generator:
        return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(0, number)))

    def _read_custom_samples(self, sampled: ArrayLike | tuple[ArrayLike, ArrayLike], count: int) -> FloatArray:
        """Return the poses of a sampler as samples (count, 13)."""
        from holdfast.model.arm.poses import check_poses

        assert self.draw is not None
        label = f"region '{self.name}': its sampler"
        if isinstance(sampled, tuple) != self.draw[1] or (isinstance(sampled, tuple) and len(sampled) != 2):
            raise InputError(f"{label} must give poses, or always a pair of poses and weights")
        poses, weights = sampled if isinstance(sampled, tuple) else (sampled, np.ones(count))
        try:
            matrices = check_poses(poses)
        except (InputError, TypeError, ValueError) as error:
            raise InputError(f"{label}: {error}") from error
        if matrices.shape[0] != count or not np.isfinite(matrices).all():
            raise InputError(f"{label} returned {len(matrices)} poses; it must return {count} poses of finite numbers")
        return np.concatenate([matrices[:, :3].reshape(count, 12), check_weights(weights, count, label)[:, None]], axis=1)

    def poses(self, samples: FloatArray) -> FloatArray:
        """Return the poses (N, 4, 4), world, m, of ``samples``: (N, 6) of a box, (N, 1) of a list, or (N, 13) of a sampler."""
        if self.listed is not None:
            return self.listed.pose_matrices(samples[:, 0].astype(np.int64))
        matrices = np.zeros((len(samples), 4, 4))
        matrices[:, 3, 3] = 1.0
        if self.draw is not None:
            matrices[:, :3] = samples[:, :12].reshape(-1, 3, 4)
            return matrices
        matrices[:, :3, 3] = samples[:, :3]
        if self.kind == "cone":
            matrices[:, :3, :3] = rotations_in_cone(np.array(self.axis), samples[:, 3:])
        else:
            matrices[:, :3, :3] = rotation_from_rpy(samples[:, 3:])
        return matrices

    def weights(self, samples: FloatArray) -> FloatArray:
        """Return the weights (N,) of ``samples`` as in :meth:`poses`, 1 if there are no weights."""
        if self.listed is not None and self.listed.weights is not None:
            return self.listed.weights[samples[:, 0].astype(np.int64)]
        if self.draw is not None:
            return np.asarray(samples[:, 12])
        if self.weight is not None:
            return check_weights(self.weight(samples), len(samples), f"region '{self.name}': its weight function")
        return np.ones(len(samples))

    @property
    def heaviest(self) -> float:
        """Largest possible weight of a sample; 0 if only a user-defined function determines it."""
        if self.listed is not None and self.listed.weights is not None:
            return float(self.listed.weights.max())
        return self.weight.heaviest if isinstance(self.weight, Density) else 0.0

    # ---- files -----------------------------------------------------------------------------------------------------

    @property
    def storable(self) -> bool:
        """True if a results folder can store the region; False if it uses a user-defined function."""
        return self.draw is None and (self.weight is None or isinstance(self.weight, Density))

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON data of the region, complete if it is :attr:`storable`."""
        if self.listed is not None:
            return {"kind": self.kind, "name": self.name, **self.listed.to_dict()}
        if self.draw is not None:
            return {"kind": self.kind, "name": self.name}
        data: dict[str, Any] = {"kind": self.kind, "center": list(self.center), "size": list(self.size), "name": self.name}
        if self.axis:
            data["axis"] = list(self.axis)
        if self.weight is not None:
            data["density"] = self.weight.to_dict() if isinstance(self.weight, Density) else "a function of your own"
        return data

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> Region:
        """Return the region from ``data``, the JSON data of :meth:`to_dict`."""
        if data["kind"] == "poses":
            return cls("poses", (), (), name=data["name"], listed=PoseList.from_dict(data))
        if data["kind"] not in ("box", "cone", "joints"):
            raise InputError(f"region: kind '{data['kind']}' is not known; use box, cone, joints or poses")
        weight = None
        if "density" in data:
            if not isinstance(data["density"], dict):
                raise InputError(f"region: density is {data['density']!r}; it must be points by coordinate")
            weight = Density.from_points(data["density"])
        axis = tuple(data.get("axis", ()))
        return cls(data["kind"], tuple(data["center"]), tuple(data["size"]), name=data["name"], weight=weight, axis=axis)

    @classmethod
    @check_arguments
    def load(cls, path: str | Path) -> Region:
        """Return the region in the YAML file ``path``; see ``docs/files``.

        Raises:
            InputError: The file cannot be read, or a key is unknown, missing or wrong; the message names it.
        """
        from holdfast.kinematics.regions.region_file import read_region_file

        kind, arguments = read_region_file(file := Path(path))
        try:
            if kind == "poses":
                return cls(kind, (), (), **arguments)
            if kind == "cone":
                return cls.cone(**arguments)
            return cls.box(**arguments) if kind == "box" else cls.joints(**arguments)
        except InputError as error:
            raise InputError(f"region file '{file}': {error}") from error

    def describe(self) -> str:
        """Describe the region in one sentence, in degrees and meters."""
        if self.kind == "joints":
            return f"configurations uniform in a box of {len(self.center)} joints"
        if self.listed is not None:
            return f"a list of {len(self.listed):,} poses{', with weights' if self.listed.weights is not None else ''}"
        if self.draw is not None:
            return f"poses sampled by a user-defined function{', with weights' if self.draw[1] else ''}"
        weight_note = "; weighted by a user-defined function" if self.weight is not None else ""
        weight = f"; {self.weight.describe()}" if isinstance(self.weight, Density) else weight_note
        rounded_center, rounded_size = np.round(self.center, 12) + 0.0, np.round(self.size, 12)
        positions = (
            f"positions in {rounded_size[0]:.3g} x {rounded_size[1]:.3g} x {rounded_size[2]:.3g} m about "
            f"({rounded_center[0]:.4g}, {rounded_center[1]:.4g}, {rounded_center[2]:.4g}) m; "
        )
        if self.kind == "cone":
            x, y, z = np.round(self.axis, 12) + 0.0
            return (
                f"{positions}z axis of the tool within {np.rad2deg(self.max_tilt):.4g} deg of ({x:.4g}, {y:.4g}, {z:.4g}), "
                f"uniform on the cap{weight}"
            )
        return (
            f"{positions}roll, pitch, yaw in {np.rad2deg(rounded_size[5]):.4g} x {np.rad2deg(rounded_size[4]):.4g} x "
            f"{np.rad2deg(rounded_size[3]):.4g} deg about ({np.rad2deg(rounded_center[5]):.4g}, "
            f"{np.rad2deg(rounded_center[4]):.4g}, {np.rad2deg(rounded_center[3]):.4g}) deg, R = Rz(yaw) Ry(pitch) "
            f"Rx(roll){weight}"
        )


def builtin_region(arm: str) -> Region | None:
    """Return the region that a paper defines for a built-in arm; None if no paper does.

    Args:
        arm: Name of the arm; ``pa10-9dof`` has a region.

    Source: Abdi et al. 2012, section V.B, printed centre; the pose at the nominal configuration differs by 0.5 mm.
    """
    if arm != "pa10-9dof":
        return None
    quarter = np.pi / 2
    return Region.box([0.968, 0.0, 0.041], 0.5, [0.0, np.deg2rad(174.0), 0.0], quarter, name="Abdi et al. 2012, section V.B")


def _well_conditioned_configuration(arm: Arm, reach: float) -> FloatArray:
    """Return the best conditioned of 256 configurations (n,) about the middle of the ranges, lengths per reach, m."""
    lower = np.where(np.isfinite(arm.lower), arm.lower, -np.pi / 2)
    upper = np.where(np.isfinite(arm.upper), arm.upper, np.pi / 2)
    offsets = np.random.default_rng(0).random((256, arm.n)) - 0.5
    q = (lower + upper) / 2 + offsets * (upper - lower) / 2
    values = np.linalg.svd(arm.jacobian(q) / np.repeat([reach, 1.0], 3)[:, None], compute_uv=False)
    rank = int((values.max(axis=0) > 1e-9).sum())  # a planar arm has at most three
    return np.asarray(q[values[:, max(rank, 1) - 1].argmax()])


def default_region(arm: Arm, spec: str | None = None) -> Region:
    """Return the default region of an arm: the paper's region for the paper's arm, else a region around its home.

    Args:
        arm: Arm model.
        spec: Built-in name or file of the arm. Default: the name of the built-in arm that equals the arm, if there is one.
    """
    from holdfast.model import arms

    if spec is None and arm.name in arms.names() and arms.load(arm.name).fingerprint == arm.fingerprint:
        spec = arm.name
    if spec is None or spec not in arms.names():
        return Region.around_tool(arm)
    return builtin_region(spec) or Region.around_tool(arm, arms.about(spec).home)
