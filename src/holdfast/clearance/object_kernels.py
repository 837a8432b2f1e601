"""Compiled distances between the spheres that cover an arm and a block of objects, whose numbers are inputs.

A program is of an arm and its spheres; a cell that changed compiles nothing. The objects of a block share the positions of the
spheres. Of the spheres of one radius on a link the nearest is found without a root: outside, the square of the distance from
the object grows with it; inside, the depth is what it is.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, reduce
from itertools import groupby

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.machine import Machine
from holdfast.caching import cached_property
from holdfast.cell.solids import Primitive
from holdfast.clearance.capsules import BASE
from holdfast.clearance.chains import Balls
from holdfast.kernels.kernel import Kernel, Single
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.linalg import Vector, smallest

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

BLOCK = 4  # objects that one call takes
NUMBERS = 18  # of an object: see Primitive.numbers
NOWHERE = 1e9  # m: how far away is what is not looked at


@recalled
def distance_kernel(arm: Machine, balls: Balls) -> Kernel:
    """The least distance from a block of objects, then that of each moving link from each object, (1 + L BLOCK,), link by link.

    Inputs: q (n,) and the block (BLOCK, 18 + L): the numbers of each object, and what is added to its distance from each link.
    """
    q, objects, where = _symbols(arm, balls)
    columns = [_by_link(balls, where, objects[k, :]) for k in range(BLOCK)]
    by_link = [column[at][0] for at in range(len(columns[0])) for column in columns]
    return Kernel("distance from a block of objects", [q, objects], [ca.vertcat(smallest(by_link), *by_link)])


@recalled
def nearest_kernel(arm: Machine, balls: Balls) -> Kernel:
    """The least distance from a block, the position of its link, which object of the block, and the gradient (n,)."""
    q, objects, where = _symbols(arm, balls)
    best: Vector = []
    for k in range(BLOCK):
        for at, (value, point) in enumerate(_by_link(balls, where, objects[k, :])):
            new = [value, ca.SX(at), ca.SX(k), *point]
            best = _chosen(value < best[0], new, best) if best else new
    distance, at, k, *point = best
    numbers = ca.horzsplit(objects[0, :NUMBERS])
    for other in range(1, BLOCK):
        numbers = _chosen(k == other, ca.horzsplit(objects[other, :NUMBERS]), numbers)
    link = sum(ca.if_else(at == i, int(link), 0) for i, link in enumerate(_links(balls)))
    slopes = slopes_of(arm, q, link, point, _outward(ca.horzcat(*numbers), point))
    return Kernel("nearest object of a block", [q, objects], [ca.vertcat(distance, at, k, *slopes)])


def _links(balls: Balls) -> NDArray[np.int64]:
    return np.unique(balls.link[balls.link > BASE])


def _symbols(arm: Machine, balls: Balls) -> tuple[SX, SX, list[Vector]]:
    """Joint variables (n,), the block's numbers (BLOCK, 18 + L), and where each moving sphere is, (3,) in the world."""
    q, where = sphere_centres(arm, balls)
    return q, ca.SX.sym("objects", BLOCK, NUMBERS + len(_links(balls))), where


def sphere_centres(arm: Machine, balls: Balls) -> tuple[SX, list[Vector]]:
    """Joint variables (n,), and where the centre of each moving sphere is, (3,) in the world, m."""
    q = kinematics.joint_symbols(arm)
    moving, _ = kinematics.frames(arm, kinematics.joint_steps(arm, q))
    where = []
    for s in np.flatnonzero(balls.link > BASE):
        rotation, position = moving[balls.link[s] + 1]
        where.append(ca.vertsplit(position + rotation @ kinematics.constant(balls.centre[s])))
    return q, where


def slopes_of(arm: Machine, q: SX, link: SX, point: Sequence[SX], push: Sequence[SX]) -> Vector:
    """How fast a point (3,) on a link goes along a direction (3,), per unit of each joint's speed, of joint variables (n,)."""
    c = kinematics.chain(arm, q)
    slopes = []
    for j, joint in enumerate(arm.joints):
        way = c.axes[j] if joint.prismatic else ca.cross(c.axes[j], ca.vertcat(*point) - c.points[j])
        slopes.append(ca.if_else(link >= j, sum(way[i] * push[i] for i in range(3)), 0.0))
    return slopes


@cache
def outward_kernel() -> Kernel:
    """The gradient (3,) in the world of the signed distance at a point (3,), of an object's numbers (18,)."""
    point, numbers = ca.SX.sym("point", 3), ca.SX.sym("numbers", NUMBERS)
    return Kernel("direction away from an object", [point, numbers], [ca.vertcat(*_outward(numbers, ca.vertsplit(point)))])


def _by_link(balls: Balls, where: list[Vector], numbers: SX) -> list[tuple[SX, Vector]]:
    """For each link its smallest distance from an object and the point (3,) of the sphere that attains it."""
    moving = balls.link > BASE
    links, radii = balls.link[moving], balls.radius[moving]
    out = []
    for at, link in enumerate(_links(balls)):
        best: Vector = []
        alike = sorted(np.flatnonzero(links == link).tolist(), key=radii.__getitem__)
        for radius, some in groupby(alike, radii.__getitem__):
            nearest: Vector = []
            for s in some:
                new = [_square_or_depth(_terms(numbers, where[s])[2]), *where[s]]
                nearest = _chosen(new[0] < nearest[0], new, nearest) if nearest else new
            value, *point = nearest
            root = ca.sqrt(_positive(value))
            new = [ca.if_else(value > 0, root, value) - float(radius), *point]
            best = _chosen(new[0] < best[0], new, best) if best else new
        out.append((best[0] - numbers[15] + numbers[NUMBERS + at], best[1:]))
    return out


def _terms(numbers: SX, point: Sequence[SX]) -> tuple[Vector, Vector, Vector]:
    """The point in the object's frame, how far out it is along each axis there, and that less the half sizes."""
    y: Vector = [numbers[9 + i] + sum(numbers[3 * i + j] * point[j] for j in range(3)) for i in range(3)]
    round_, closed = numbers[16], 1 - 2 * numbers[17]
    below = -closed * y[2]  # y[2] again where the object is open
    size = [ca.sqrt(y[0] * y[0] + round_ * (y[1] * y[1])), ca.fabs(y[1]), ca.if_else(y[2] > below, y[2], below)]
    return y, size, [size[i] - numbers[12 + i] for i in range(3)]


def _square_or_depth(d: Vector) -> SX:
    """Square of the distance outside, the signed distance inside, of an object without rounding."""
    most = _largest(d)
    return ca.if_else(most > 0, _square(d), most)


def _square(d: Vector) -> SX:
    out = [_positive(x) for x in d]
    return sum(x * x for x in out)


def _positive(x: SX) -> SX:
    return ca.if_else(x > 0, x, 0.0)


def _largest(d: Vector) -> SX:
    most = d[0]
    for x in d[1:]:
        most = ca.if_else(x > most, x, most)
    return most


def _outward(numbers: SX, point: Sequence[SX]) -> Vector:
    """Gradient (3,) in the world of the signed distance, a unit vector; 0 in the middle of a sphere or an axis."""
    y, size, d = _terms(numbers, point)
    most, length = _largest(d), ca.sqrt(_square(d))
    outside = most > 0
    taken: SX = 0.0  # inside, the first of the faces that are nearest
    share: Vector = []
    for x in d:
        face = ca.if_else(ca.logic_and(x >= most, taken < 0.5), 1.0, 0.0)
        taken = taken + face
        share.append(ca.if_else(outside, _positive(x) / ca.if_else(outside, length, 1.0), face))
    round_, open_ = numbers[16] > 0.5, numbers[17] > 0.5
    unit = [y[i] / ca.if_else(size[i] == 0, 1.0, size[i]) for i in range(3)]
    own = [
        share[0] * unit[0],
        ca.if_else(round_, share[0] * y[1] / ca.if_else(size[0] == 0, 1.0, size[0]), share[1] * unit[1]),
        share[2] * ca.if_else(open_, 1.0, unit[2]),
    ]
    return [sum(numbers[3 * i + j] * own[i] for i in range(3)) for j in range(3)]


def _chosen(first: SX, a: Vector, b: Vector) -> Vector:
    return [ca.if_else(first, x, y) for x, y in zip(a, b, strict=True)]


# ---- objects --------------------------------------------------------------------------------------------------------------


class FormulaObjects:
    """Objects with a formula, as an arm meets them.

    Args:
        arm: The arm.
        balls: The spheres that cover it.
        objects: F of them.
        added: (L, F) added to the distance of each moving link from each, m.
        margins: (F,) what is kept from each, m; nothing if not given.
    """

    def __init__(
        self, arm: Machine, balls: Balls, objects: Sequence[Primitive], added: Array, margins: Array | None = None
    ) -> None:
        self.arm, self.balls, self.objects, self._added = arm, balls, list(objects), added
        self._margins = np.zeros(len(self.objects)) if margins is None else margins
        self._links = len(np.unique(balls.link[balls.link > BASE]))

    @cached_property
    def _distance_kernel(self) -> Kernel:
        return distance_kernel(self.arm, self.balls)

    @cached_property
    def _nearest_kernel(self) -> Kernel:
        return nearest_kernel(self.arm, self.balls)

    @cached_property
    def _bare(self) -> Array:
        return self._blocks(np.zeros(len(self.objects)))

    @cached_property
    def _larger(self) -> Array:
        return self._blocks(self._margins)

    def _blocks(self, extra: Array) -> Array:
        """(B, BLOCK, 18 + L) what the kernels take, block by block, every object larger by so much (F,), m."""
        nowhere = np.concatenate([np.zeros(NUMBERS), np.full(self._links, NOWHERE)])  # what is lacking to whole blocks
        numbers = [solid.numbers(more) for solid, more in zip(self.objects, extra.tolist(), strict=True)]
        rows = [np.concatenate(row) for row in zip(numbers, self._added.T, strict=True)]
        rows += [nowhere] * (-len(rows) % BLOCK)
        return np.array(rows).reshape(-1, BLOCK, len(nowhere))

    def _by_block(self, kernel: Kernel, q: Array, blocks: Array, first: int | None = None) -> list[Array]:
        """(N, outputs) of each block."""
        if len(q) == 1:  # one call: the blocks are its rows
            return list(kernel.rows(np.repeat(q, len(blocks), axis=0), blocks, first=first)[:, None])
        return [kernel.rows(q, block, first=first) for block in blocks]

    def _least(self, q: Array, blocks: Array) -> Array:
        if not (self.objects and self._links):
            return np.where(np.isfinite(q).all(axis=1), np.inf, np.nan)
        return reduce(np.minimum, [rows[:, 0] for rows in self._by_block(self._distance_kernel, q, blocks, first=1)])

    def least(self, q: Array) -> Array:
        """(N,) the least distance, m; infinite without an object, NaN for rows (N, n) that are not finite."""
        return self._least(q, self._bare)

    def room(self, q: Array) -> Array:
        """(N,) the least distance beyond the margins, m."""
        return self._least(q, self._larger)

    def distances(self, q: Array) -> Array:
        """(N, L, F) lower bound of the distance of every link from every object, m."""
        rows = [x[:, 1:].reshape(len(q), self._links, BLOCK) for x in self._by_block(self._distance_kernel, q, self._bare)]
        return np.concatenate([np.empty((len(q), self._links, 0)), *rows], axis=2)[:, :, : len(self.objects)]

    def single_blocks(self) -> list[Single]:
        """Of each block what :func:`nearest_kernel` says, of one configuration at a time: the first n of its inputs."""
        found = [self._nearest_kernel.single() for _ in self._larger]
        for each, block in zip(found, self._larger, strict=True):
            each.inputs[self.arm.n :] = block.ravel()
        return found

    def nearest(self, q: Array) -> tuple[Array, Indices, Indices, Array]:
        """Least distance beyond the margins, m; position of its link, its object, and the gradient (N, n).

        Args:
            q: (N, n) rad and m; a row that is not finite gets NaN.
        """
        rows = np.stack(self._by_block(self._nearest_kernel, q, self._larger))
        block = np.argmin(rows[:, :, 0], axis=0)  # NaN is in all of them or in none
        best = rows[block, np.arange(len(q))]
        link, thing = np.nan_to_num(best[:, 1]).astype(np.int64), np.nan_to_num(best[:, 2]).astype(np.int64)
        # Where all may touch, an object that is not there may be the first.
        return best[:, 0], link, np.minimum(block * BLOCK + thing, len(self.objects) - 1), best[:, 3:]
