"""Exact answers about collisions: the bound first, and a library only for the pairs that it leaves open, the nearest first."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.cell.solids import Primitive, Solid
from holdfast.clearance.capsules import BASE, Capsules
from holdfast.clearance.chains import Balls
from holdfast.clearance.exact.bodies import Body, box_about, of_capsule, of_piece, of_solid
from holdfast.clearance.exact.engines import CONTACT, Engine
from holdfast.clearance.exact.opponents import Another, Opponent, Placed, of_object
from holdfast.clearance.obstacles import Obstacles

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Truths = NDArray[np.bool_]

NEAR = 0.05  # m: beyond the least bound, what is nearest is hardly found


@dataclass(frozen=True, eq=False)
class Part:
    """A body of a link.

    Attributes:
        link: The joint that moves it, from 0; -1 for the base.
        body: With its pose in the frame of the link.
        owner: Name of the link in the arm's file; empty if it is of none.
        held: Whether the arm only holds it.
        known: Whether the arm is there; False for a capsule that covers a shape which was not read, or is assumed.
    """

    link: int
    body: Body
    owner: str = ""
    held: bool = False
    known: bool = True


@dataclass(frozen=True, eq=False)
class Meeting:
    """A body of a link and what it may touch.

    Attributes:
        pair: Position in the bounds of the pair that it belongs to.
        part: Position of the body.
        opponent: What it may touch.
        other: Position of the body that has to be placed for that; the body itself for an object.
        box: Contains the object; None for a body of another link.
    """

    pair: int
    part: int
    opponent: Opponent
    other: int
    box: Primitive | None


def parts_of(arm: Arm, capsules: Capsules, held: Sequence[Solid] = ()) -> list[Part]:
    """The bodies of an arm: what its capsules cover, or the capsules themselves where they cover nothing that is known.

    Args:
        arm: The arm.
        capsules: Its capsules.
        held: What moves with the tool, with poses in its frame.
    """
    shape, own = capsules.shape, capsules.own
    if shape is None:
        given = not (own.covers or own.assumed(arm))
        parts = [Part(part.link, of_capsule(part), known=given) for part in own]
    else:
        lacking = {item.link for item in shape.missing}
        parts = [Part(piece.link, of_piece(piece), piece.owner) for piece in shape.pieces]
        parts += [Part(part.link, of_capsule(part), known=False) for part in own if part.link in lacking]
    bodies = [of_solid(solid) for solid in held]
    return parts + [Part(arm.n - 1, replace(body, pose=arm.tool @ body.pose), held=True) for body in bodies]


class Meetings:
    """The bodies of an arm and what they can touch.

    Args:
        arm: The arm.
        parts: Its bodies.
        between: Of each pair of links that is checked, the positions in ``parts`` of the bodies that are.
        obstacles: The objects of its cell, or None.
        engine: The library.
    """

    def __init__(
        self,
        arm: Arm,
        parts: Sequence[Part],
        between: Sequence[Sequence[tuple[int, int]]],
        obstacles: Obstacles | None,
        engine: Engine,
    ) -> None:
        self.arm, self.engine, self._parts = arm, engine, tuple(parts)
        self._placed = [Placed(part.body, engine.make(part.body), np.eye(3), np.zeros(3)) for part in parts]
        others = [Another(engine, placed) for placed in self._placed]
        self._meetings = [Meeting(pair, b, others[a], a, None) for pair, some in enumerate(between) for a, b in some]
        if obstacles is not None:
            objects = [(of_object(engine, solid), box_about(solid)) for solid in obstacles.cell]
            by_link = {link: [k for k, part in enumerate(parts) if part.link == link] for link in range(arm.n)}
            for pair, (link, thing) in enumerate(obstacles.pairs.tolist(), start=len(between)):
                self._meetings += [Meeting(pair, k, objects[thing][0], k, objects[thing][1]) for k in by_link[link]]
        self._pair_of = np.array([meeting.pair for meeting in self._meetings], dtype=np.int64)

    def any(self, q: Array, bounds: Array) -> Truths:
        """(N,) whether anything touches.

        Args:
            q: (N, n) finite.
            bounds: (N, P) lower bounds of the distances of all pairs, m: those of links, then those of ``obstacles.pairs``.
        """
        return np.asarray(self.closer(q, bounds, np.zeros(bounds.shape[1])) >= 0)

    def closer(self, q: Array, bounds: Array, allowed: Array) -> Indices:
        """(N,) a pair that is closer than allowed, by position in the bounds; -1 where none is.

        Args:
            q: (N, n) finite.
            bounds: As for :meth:`any`.
            allowed: (P,) m, of each pair; at 0 the pair may not touch, and below 0 it is not looked at.
        """
        found, frames = np.full(len(q), -1), self._frames(q)
        allowed = allowed[self._pair_of]
        limit = np.where(allowed < 0, -np.inf, np.maximum(allowed, CONTACT))
        closer = self._closer(frames, bounds, np.full(len(q), limit.max(initial=CONTACT)))
        rows, which = np.nonzero(closer < limit)
        order = np.lexsort((closer[rows, which], rows))
        now, there = -1, set[int]()
        for row, k in zip(rows[order].tolist(), which[order].tolist(), strict=True):
            if found[row] >= 0:
                continue
            if row != now:
                now, there = row, set()
            meeting = self._meetings[k]
            self._place(meeting, row, frames, there)
            part = self._placed[meeting.part]
            near = meeting.opponent.distance(part) < allowed[k] if allowed[k] > 0 else meeting.opponent.hits(part)
            found[row] = meeting.pair if near else -1
        return found

    def distances(self, q: Array, bounds: Array) -> Array:
        """(N,) the smallest distance, m; 0 where anything touches, infinite if there is nothing to touch.

        Args:
            q: (N, n) finite.
            bounds: As for :meth:`any`.
        """
        out, frames = np.full(len(q), np.inf), self._frames(q)
        closer = self._closer(frames, bounds, bounds.min(axis=1, initial=np.inf) + NEAR)
        for row, order in enumerate(np.argsort(closer, axis=1).tolist()):
            best, there = np.inf, set[int]()
            for k in order:
                if closer[row, k] >= best or best == 0:
                    break
                meeting = self._meetings[k]
                self._place(meeting, row, frames, there)
                best = min(best, meeting.opponent.distance(self._placed[meeting.part]))
            out[row] = best
        return out

    def _closer(self, frames: list[tuple[Array, Array]], bounds: Array, limit: Array) -> Array:
        """(N, M) lower bounds of the distances of all meetings, m; below a limit (N,) also of balls about the bodies."""
        out = bounds[:, self._pair_of]
        for k, meeting in enumerate(self._meetings):
            (rows,) = np.nonzero(out[:, k] < limit)
            if not rows.size:
                continue
            centre, radius = self._ball(meeting.part, frames, rows)
            if meeting.box is not None:
                apart = meeting.box.signed_distance(centre) - radius
            else:
                other, more = self._ball(meeting.other, frames, rows)
                apart = np.linalg.norm(centre - other, axis=1) - radius - more
            out[rows, k] = np.maximum(out[rows, k], apart)
        return out

    def _ball(self, part: int, frames: list[tuple[Array, Array]], rows: Indices) -> tuple[Array, float]:
        """Centres (R, 3) in the world and radius, m, of the ball about a body in some rows."""
        centre, radius = self._parts[part].body.ball
        rotation, position = frames[part]
        return position[rows] + rotation[rows] @ centre, radius

    def _place(self, meeting: Meeting, row: int, frames: list[tuple[Array, Array]], there: set[int]) -> None:
        for k in (meeting.part, meeting.other):
            if k not in there:
                there.add(k)
                placed, (rotations, positions) = self._placed[k], frames[k]
                placed.rotation, placed.position = rotations[row], positions[row]
                self.engine.place(placed.made, placed.rotation, placed.position)

    def _frames(self, q: Array) -> list[tuple[Array, Array]]:
        """Rotations (N, 3, 3) and positions (N, 3), m, of each part in the world."""
        moving = self.arm.frames(q)
        out = []
        for part in self._parts:
            frame = moving[:, part.link + 1] @ part.body.pose
            out.append((np.ascontiguousarray(frame[:, :3, :3]), np.ascontiguousarray(frame[:, :3, 3])))
        return out


def spheres_within(parts: Sequence[Part]) -> Balls:
    """Spheres that lie within the known bodies of moving links: what they hit, the arm hits."""
    rows = []
    for number, part in sorted(enumerate(parts), key=lambda item: item[1].link):
        if part.link > BASE and part.known:
            centres, radii = part.body.inside
            centres = centres @ part.body.pose[:3, :3].T + part.body.pose[:3, 3]
            rows += [(part.link, centre, radius, number) for centre, radius in zip(centres, radii, strict=True)]
    return Balls(
        np.array([row[0] for row in rows], dtype=np.int64),
        np.array([row[1] for row in rows]).reshape(-1, 3),
        np.array([row[2] for row in rows]),
        np.array([row[3] for row in rows], dtype=np.int64),
    )
