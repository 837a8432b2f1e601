"""Compiled distances between the spheres that cover an arm and a block of objects, whose numbers are inputs.

A program is of an arm and its spheres; a cell that changed compiles nothing. The objects of a block share the positions of the
spheres.
"""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.machine import Machine
from holdfast.clearance.capsules import BASE
from holdfast.clearance.chains import Balls
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.linalg import Vector

BLOCK = 4  # objects that one call takes
NUMBERS = 18  # of an object: see Primitive.numbers


@recalled
def distance_kernel(arm: Machine, balls: Balls) -> Kernel:
    """The least distance of the spheres of each moving link from each object of a block, (L BLOCK,), link by link.

    Inputs: q (n,) and the block (BLOCK, 18 + L): the numbers of each object, and what is added to its distance from each link.
    """
    q, objects, where = _symbols(arm, balls)
    columns = [_by_link(balls, where, objects[k, :]) for k in range(BLOCK)]
    by_link = [column[at][0] for at in range(len(columns[0])) for column in columns]
    return Kernel("distance from a block of objects", [q, objects], [ca.vertcat(*by_link)])


@recalled
def nearest_kernel(arm: Machine, balls: Balls) -> Kernel:
    """The least distance from a block, the position of its link, which object of the block, and the gradient (n,)."""
    q, objects, where = _symbols(arm, balls)
    best: Vector = []
    for k in range(BLOCK):
        numbers = objects[k, :]
        for at, (value, point) in enumerate(_by_link(balls, where, numbers)):
            new = [value, ca.SX(at), ca.SX(k), *point, *ca.horzsplit(numbers[:, :NUMBERS])]
            best = _chosen(value < best[0], new, best) if best else new
    distance, at, k, *rest = best
    point, push = rest[:3], _outward(ca.horzcat(*rest[3:]), rest[:3])
    c = kinematics.chain(arm, q)
    link = sum(ca.if_else(at == i, int(link), 0) for i, link in enumerate(_links(balls)))
    slopes = []
    for j, joint in enumerate(arm.joints):
        way = c.axes[j] if joint.prismatic else ca.cross(c.axes[j], ca.vertcat(*point) - c.points[j])
        slopes.append(ca.if_else(link >= j, sum(way[i] * push[i] for i in range(3)), 0.0))
    return Kernel("nearest object of a block", [q, objects], [ca.vertcat(distance, at, k, *slopes)])


def _links(balls: Balls) -> NDArray[np.int64]:
    return np.unique(balls.link[balls.link > BASE])


def _symbols(arm: Machine, balls: Balls) -> tuple[SX, SX, list[Vector]]:
    """Joint variables (n,), the block's numbers (BLOCK, 18 + L), and where each moving sphere is, (3,) in the world."""
    q = kinematics.joint_symbols(arm)
    moving, _ = kinematics.frames(arm, kinematics.joint_steps(arm, q))
    where = []
    for s in np.flatnonzero(balls.link > BASE):
        rotation, position = moving[balls.link[s] + 1]
        where.append(ca.vertsplit(position + rotation @ kinematics.constant(balls.centre[s])))
    return q, ca.SX.sym("objects", BLOCK, NUMBERS + len(_links(balls))), where


def _by_link(balls: Balls, where: list[Vector], numbers: SX) -> list[tuple[SX, Vector]]:
    """For each link its smallest distance from an object and the point (3,) of the sphere that attains it."""
    moving = balls.link > BASE
    links, radii = balls.link[moving], balls.radius[moving]
    out = []
    for at, link in enumerate(_links(balls)):
        best: Vector = []
        for s in np.flatnonzero(links == link):
            new = [_signed_distance(numbers, where[s]) - float(radii[s]), *where[s]]
            best = _chosen(new[0] < best[0], new, best) if best else new
        out.append((best[0] + numbers[NUMBERS + at], best[1:]))
    return out


def _terms(numbers: SX, point: Sequence[SX]) -> tuple[Vector, Vector, Vector, SX, SX]:
    """The point in the object's frame, its sizes there, those less the half sizes, and the two flags."""
    y: Vector = [numbers[9 + i] + sum(numbers[3 * i + j] * point[j] for j in range(3)) for i in range(3)]
    round_, open_ = numbers[16] > 0.5, numbers[17] > 0.5
    first = ca.sqrt(y[0] * y[0] + ca.if_else(round_, y[1] * y[1], 0.0))
    size = [first, ca.sqrt(y[1] * y[1]), ca.if_else(open_, y[2], ca.sqrt(y[2] * y[2]))]
    return y, size, [size[i] - numbers[12 + i] for i in range(3)], round_, open_


def _largest(d: Vector) -> SX:
    most = d[0]
    for x in d[1:]:
        most = ca.if_else(x > most, x, most)
    return most


def _signed_distance(numbers: SX, point: Sequence[SX]) -> SX:
    """As :meth:`Primitive.signed_distance`, of symbols."""
    _, _, d, _, _ = _terms(numbers, point)
    most = _largest(d)
    out = [ca.if_else(x > 0, x, 0.0) for x in d]
    return ca.sqrt(sum(x * x for x in out)) + ca.if_else(most < 0, most, 0.0) - numbers[15]


def _outward(numbers: SX, point: Sequence[SX]) -> Vector:
    """Gradient (3,) of :func:`_signed_distance` in the world, a unit vector; 0 in the middle of a sphere or an axis."""
    y, size, d, round_, open_ = _terms(numbers, point)
    most = _largest(d)
    out = [ca.if_else(x > 0, x, 0.0) for x in d]
    length = ca.sqrt(sum(x * x for x in out))
    outside = most > 0
    taken: SX = 0.0  # inside, the first of the faces that are nearest
    share: Vector = []
    for x, o in zip(d, out, strict=True):
        face = ca.if_else(ca.logic_and(x >= most, taken < 0.5), 1.0, 0.0)
        taken = taken + face
        share.append(ca.if_else(outside, o / ca.if_else(outside, length, 1.0), face))
    unit = [y[i] / ca.if_else(size[i] == 0, 1.0, size[i]) for i in range(3)]
    own = [
        share[0] * unit[0],
        ca.if_else(round_, share[0] * y[1] / ca.if_else(size[0] == 0, 1.0, size[0]), share[1] * unit[1]),
        share[2] * ca.if_else(open_, 1.0, unit[2]),
    ]
    return [sum(numbers[3 * i + j] * own[i] for i in range(3)) for j in range(3)]


def _chosen(first: SX, a: Vector, b: Vector) -> Vector:
    return [ca.if_else(first, x, y) for x, y in zip(a, b, strict=True)]
