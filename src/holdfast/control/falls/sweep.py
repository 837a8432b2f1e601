"""Space that an arm sweeps during a fall."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress, track
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.model.arm.model import Arm
from holdfast.model.collision.capsules import BASE_LINK, Capsules
from holdfast.model.collision.sphere_cover import make_sphere_cover

MOST_VOXELS = 1 << 27  # of the box around the sweep
SPACING_FRACTION = 0.5  # of the size of a voxel: path of a center between two spheres that are counted
BLOCK_COLUMNS = 1 << 19  # of voxels that are computed together


@dataclass(frozen=True, kw_only=True)
class Sweep:
    """Union of all spheres that cover the moving links, over one fall.

    Attributes:
        voxel: Size of the voxels, m.
        lower_volume: Volume of the voxels that lie inside a sphere, m^3.
        upper_volume: Volume of the voxels that a sphere touches, m^3. The spheres are enlarged by half the path of their
            center between two instants.
        links: (L,) names of the moving links, by the joints that move them.
        boxes: (L, 2, 3) lowest and highest coordinates of each link in the world, m.
        surface: (M, 3) centers in the world of touched voxels next to an untouched one, m.
    """

    voxel: float
    lower_volume: float
    upper_volume: float
    links: tuple[str, ...]
    boxes: FloatArray
    surface: FloatArray

    @property
    def box(self) -> FloatArray:
        """(2, 3) lowest and highest coordinates of all links in the world, m."""
        return np.array([self.boxes[:, 0].min(axis=0), self.boxes[:, 1].max(axis=0)])


@reports_progress("computing the swept space")
def sweep_spheres(arm: Arm, capsules: Capsules, q: FloatArray, voxel: float) -> Sweep:
    """Compute the space that the links sweep along configurations (T, n); see :meth:`holdfast.PowerLoss.sweep`."""
    from scipy.ndimage import binary_erosion

    if not (np.isfinite(voxel) and voxel > 0):
        raise InputError(f"voxel is {voxel:g} m; it must be a finite number above 0")
    cover = make_sphere_cover(capsules)
    moving = np.flatnonzero(cover.link != BASE_LINK)
    if not moving.size:
        raise InputError(f"the collision model of '{arm.name}' contains no moving link; give one as clearance")
    link, radius = cover.link[moving], cover.radius[moving]
    frames = arm.frames(q)[:, link + 1]
    centers = np.einsum("tsij,sj->tsi", frames[..., :3, :3], cover.center[moving]) + frames[..., :3, 3]
    lows, highs = (centers - radius[:, None]).min(axis=0), (centers + radius[:, None]).max(axis=0)
    links = np.unique(link)
    boxes = np.array([[lows[link == k].min(axis=0), highs[link == k].max(axis=0)] for k in links])
    spheres, margins = _thin_out(centers, voxel * SPACING_FRACTION)
    origin = lows.min(axis=0) - margins.max() - voxel
    shape = np.ceil((highs.max(axis=0) + margins.max() + voxel - origin) / voxel).astype(int)
    if np.prod(shape, dtype=float) > MOST_VOXELS:
        smallest = voxel * (np.prod(shape, dtype=float) / MOST_VOXELS) ** (1 / 3)
        raise InputError(f"voxel is {voxel:g} m, too small for this sweep; give at least {smallest:.2g} m")
    rows = np.column_stack([(centers[spheres] - origin) / voxel, radius[spheres[1]] / voxel, margins / voxel])
    inside, touched = (_mark_voxels(rows, shape, is_outer) for is_outer in (False, True))
    return Sweep(
        voxel=float(voxel),
        lower_volume=float(np.count_nonzero(inside) * voxel**3),
        upper_volume=float(np.count_nonzero(touched) * voxel**3),
        links=tuple(arm.joint_names[k] for k in links),
        boxes=boxes,
        surface=origin + voxel * (np.argwhere(touched & ~binary_erosion(touched)) + 0.5),
    )


def _thin_out(centers: FloatArray, spacing: float) -> tuple[tuple[IndexArray, IndexArray], FloatArray]:
    """Choose instants and spheres (K,) of all (T, S), and the margins (K,) by which these spheres contain all others, m.

    The path between two instants is at most the longest chord of the neighboring intervals, because a center may rebound in
    between.
    """
    chords = np.pad(np.linalg.norm(np.diff(centers, axis=0), axis=2), ((1, 1), (0, 0)))
    paths = np.maximum(chords, np.maximum(np.roll(chords, 1, axis=0), np.roll(chords, -1, axis=0)))[1:-1]
    lengths = np.concatenate([np.zeros_like(centers[:1, :, 0]), np.cumsum(paths, axis=0)])
    steps = np.floor(lengths / spacing)
    chosen = np.pad(np.diff(steps, axis=0) > 0, ((1, 0), (0, 0)), constant_values=True)
    chosen[-1] = True
    sphere, instant = np.nonzero(chosen.T)
    gaps = np.diff(lengths[instant, sphere]) * (np.diff(sphere) == 0)
    return (instant, sphere), np.maximum(np.append(0, gaps), np.append(gaps, 0)) / 2


def _mark_voxels(spheres: FloatArray, shape: IndexArray, is_outer: bool) -> BoolArray:
    """Return the voxels inside one of the spheres (K, 5): center, radius, and margin; or those that an enlarged one touches.

    All lengths are in voxels. A sphere marks the ends of its part of each row of voxels along z.
    """
    ends = np.zeros(shape, dtype=np.int32)
    radii = spheres[:, 3] + (spheres[:, 4] if is_outer else 0.0)
    width = int(np.ceil(2 * radii.max())) + 2
    block_count = 1 + len(spheres) * width**2 // BLOCK_COLUMNS
    for block in track("blocks of spheres", np.array_split(np.arange(len(spheres)), block_count)):
        center, radius = spheres[block, :3], radii[block, None]
        first = np.floor(center - radius).astype(int)  # voxel
        offset = np.abs(first[:, :2, None] + np.arange(width) + 0.5 - center[:, :2, None])  # of the middle of a voxel
        distance = np.maximum(offset - 0.5, 0.0) if is_outer else offset + 0.5
        squares = radius[..., None] ** 2 - distance[:, 0, :, None] ** 2 - distance[:, 1, None, :] ** 2
        sphere, x, y = np.nonzero(squares > 0)
        half, z = np.sqrt(squares[sphere, x, y]), center[sphere, 2]
        parts = [np.floor(z - half), np.ceil(z + half)] if is_outer else [np.ceil(z - half), np.floor(z + half)]
        is_filled = parts[1] > parts[0]
        low = first.min(axis=0)  # of the box around the block, which is small because it follows the motion of a sphere
        size = np.minimum(first.max(axis=0) + width + 1, shape) - low
        column = ((first[sphere, 0] + x - low[0]) * size[1] + first[sphere, 1] + y - low[1]) * size[2] - low[2]
        starts, stops = (
            np.bincount((column + part.astype(int))[is_filled], minlength=size.prod()).reshape(size) for part in parts
        )
        ends[tuple(map(slice, low, low + size))] += (starts - stops).astype(np.int32)
    return np.cumsum(ends, axis=2, out=ends) > 0
