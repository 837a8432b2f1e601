"""The worst poses of a region, and where in it tolerance is low."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.poses import zyx_angles
from holdfast.present.assessment.facts import Facts, Rows
from holdfast.present.commands import pose_command
from holdfast.probability.distribution import Distribution
from holdfast.regions.region import Region
from holdfast.report import figures, maps
from holdfast.report.page import Block, Code, Picture, Table, Text
from holdfast.report.views import sides
from holdfast.words import counted, fixed, number

TITLE = "The worst {noun}s, and where tolerance is low"
Array = NDArray[np.float64]

_LEAST_FOR_MAP = 200


def blocks(f: Facts) -> list[Block]:
    """The worst poses, and where in the region tolerance is low."""
    rows = f.rows
    if rows is None and not f.d.reached:
        return []
    if rows is None:
        return [Text(f"The {f.noun}s of this run were not kept (keep=False), so the report cannot list or map them.")]
    if not rows.reached.any():
        return []
    if f.nothing:
        return [Text(f"Every {f.noun} reached is equally bad, so there is nothing to list or map.")]
    known = [(name, d, r) for name, d, r in f.samples if r is not None and r.reached.any()]
    blocks: list[Block] = [block for name, d, r in known for block in (_worst_table(f, d, r, name), *_worst_commands(f, r))]
    views = sides(rows.position, ("Seen from the side", "Seen from above"))
    if int(rows.reached.sum()) < _LEAST_FOR_MAP or not views:
        return blocks
    average = "Mean" if f.larger else "Median"
    shown = {name: np.where(r.reached, r.value, np.nan) for name, _, r in f.samples if r is not None and r.reached.any()}
    figure = maps.map_figure(
        rows.position,
        shown,
        views,
        log=f.log,
        smaller_is_better=not f.larger,
        label=figures.plain(f"{average.lower()} {f.index.name}"),
        weights=rows.weight,
    )
    text = (
        f"{average} index of the {f.reached} in each cell, over the whole depth of the region, and below it how many "
        f"{'poses were reached of how many drawn' if f.d.unreached else f'{f.noun}s there are'}; {len(rows.value):,} in all."
    )
    if len(shown) > 1:
        text += " Above at the configurations found, below at the best ones, in the same colours."
    if f.a.region.kind == "joints":
        text += " Positions are those of the tool."
    if f.d.weighted:
        text += f" Within a cell {f.noun}s count by weight; cells without weight are grey."
    return [*blocks, Picture(figures.svg(figure, "map", "Average index over the region"), text)]


def _worst(f: Facts, rows: Rows) -> NDArray[np.intp]:
    some = np.flatnonzero(rows.reached)
    order = np.argsort(rows.value[some] if f.larger else -rows.value[some], kind="stable")
    return np.asarray(some[order[:10]])


def _worst_commands(f: Facts, rows: Rows) -> list[Block]:
    """The commands that look for the best configuration of each of the worst poses."""
    if f.a.region.kind == "joints":
        return []
    poses = np.tile(np.eye(4), (len(chosen := _worst(f, rows)), 1, 1))
    poses[:, :3, 3], poses[:, :3, :3] = rows.position[chosen], rows.rotation[chosen]
    commands = "\n".join(pose_command(f.a.arm, pose) for pose in poses)
    return [Code(commands, "The same poses, in the same order, as commands:")]


def _worst_table(f: Facts, d: Distribution, rows: Rows, name: str) -> Table:
    some, chosen = np.flatnonzero(rows.reached), _worst(f, rows)
    labels = f.failure_labels
    angles = np.rad2deg(_angles(rows.rotation[chosen], f.a.region))
    cells = []
    for k, rpy in zip(chosen, angles, strict=True):
        worst = labels[rows.worst[k]] if rows.worst[k] >= 0 else "singular"
        place = [*(fixed(x, 3) for x in rows.position[k]), *(fixed(x, 1) for x in rpy[::-1])]
        cells.append([f"{rows.number[k] + 1:,}", *place, number(float(rows.value[k])), worst])
    head = [f.noun.capitalize(), "x, m", "y, m", "z, m", "roll, deg", "pitch, deg", "yaw, deg", "index", "worst failure"]
    which = f", {name}" if f.a.optimised is not None else ""
    caption = f"The {len(chosen)} worst of {len(some):,} {f.reached}{which}; R = Rz(yaw) Ry(pitch) Rx(roll)."
    if d.unreached:
        caption += f" The {counted(d.unreached, 'pose')} without one count as worse still and are not listed."
    return Table(cells, head, frozenset(range(8)), caption=caption, wide=True)


def _angles(rotations: Array, region: Region) -> Array:
    """Roll, pitch, yaw: of the two triples of a rotation, and their turns, the one next to the middle of the region."""
    first = zyx_angles(rotations)
    center = np.array(region.center[3:]) if region.kind == "box" else np.zeros(3)
    second = np.stack([first[:, 0] + np.pi, np.pi - first[:, 1], first[:, 2] + np.pi], axis=1)
    both = np.stack([first, second])
    both = center + (both - center + np.pi) % (2 * np.pi) - np.pi
    nearest = np.linalg.norm(both - center, axis=2).argmin(axis=0)
    return np.asarray(both[nearest, np.arange(len(nearest))])
