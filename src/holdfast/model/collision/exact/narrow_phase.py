"""Exact collision queries: bounds first, then library queries for the undecided pairs, the nearest first."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.model.arm.model import Arm
from holdfast.model.cell.solids import PrimitiveSolid, Solid
from holdfast.model.collision.capsules import BASE_LINK, Capsules
from holdfast.model.collision.exact.bodies import (
    CollisionBody,
    body_from_capsule,
    body_from_piece,
    body_from_solid,
    bounding_primitive,
)
from holdfast.model.collision.exact.collision_geometry import BodyGeometry, CollisionGeometry, PlacedBody, geometry_of_object
from holdfast.model.collision.exact.engines import CONTACT_DISTANCE_M, CollisionLibrary
from holdfast.model.collision.obstacles import Obstacles
from holdfast.model.collision.sphere_cover import SphereCover

SEARCH_DISTANCE_M = 0.05  # m: if everything is farther than the least bound by this, the nearest pair is hardly found


@dataclass(frozen=True, eq=False)
class ArmBody:
    """Body of a link.

    Attributes:
        link: Index from 0 of the joint that moves it; -1 for the base.
        body: Body with its pose in the frame of the link.
        owner: Name of the link in the arm's file; empty if there is none.
        held: True if the arm only holds it.
        known: True if the arm is there; False for a capsule that is assumed, or covers a shape that was not read.
    """

    link: int
    body: CollisionBody
    owner: str = ""
    held: bool = False
    known: bool = True


@dataclass(frozen=True, eq=False)
class CandidatePair:
    """Body of a link, and an object or body that it may touch.

    Attributes:
        pair: Position of its pair in the bounds.
        part: Position of the body.
        geometry: Geometry that it may touch.
        other: Position of the body that has to be placed for the query; the body itself for an object.
        box: Box that contains the object; None for a body of another link.
    """

    pair: int
    part: int
    geometry: CollisionGeometry
    other: int
    box: PrimitiveSolid | None


def arm_bodies(arm: Arm, capsules: Capsules, held: Sequence[Solid] = ()) -> tuple[ArmBody, ...]:
    """Return the bodies of an arm: the shapes that its capsules cover, or the capsules themselves if no shape is known.

    Args:
        arm: Arm model.
        capsules: Capsules of the arm.
        held: Objects that move with the tool, with poses in its frame.
    """
    shape, own_capsules = capsules.shape, capsules.without_held
    if shape is None:
        is_given = not (own_capsules.covers or own_capsules.is_assumed(arm))
        parts = [ArmBody(part.link, body_from_capsule(part), known=is_given) for part in own_capsules]
    else:
        lacking = {item.link for item in shape.missing}
        parts = [ArmBody(piece.link, body_from_piece(piece), piece.owner) for piece in shape.pieces]
        parts += [ArmBody(part.link, body_from_capsule(part), known=False) for part in own_capsules if part.link in lacking]
    bodies = [body_from_solid(solid) for solid in held]
    return (*parts, *(ArmBody(arm.n - 1, replace(body, pose=arm.tool @ body.pose), held=True) for body in bodies))


class NarrowPhase:
    """Exact queries between the bodies of an arm and the bodies that they can touch.

    Args:
        arm: Arm model.
        parts: Bodies of the arm.
        body_pairs: For each checked pair of links, the positions in ``parts`` of the checked bodies.
        obstacles: Objects of the cell, or None.
        engine: Collision library.
    """

    def __init__(
        self,
        arm: Arm,
        parts: Sequence[ArmBody],
        body_pairs: Sequence[Sequence[tuple[int, int]]],
        obstacles: Obstacles | None,
        engine: CollisionLibrary,
    ) -> None:
        self.arm, self.engine, self._parts = arm, engine, tuple(parts)
        self._placed = [PlacedBody(part.body, engine.make_body(part.body), np.eye(3), np.zeros(3)) for part in parts]
        geometries = [BodyGeometry(engine, placed) for placed in self._placed]
        self._candidates = [
            CandidatePair(pair, second, geometries[first], first, None)
            for pair, index_pairs in enumerate(body_pairs)
            for first, second in index_pairs
        ]
        if obstacles is not None:
            objects = [(geometry_of_object(engine, solid), bounding_primitive(solid)) for solid in obstacles.cell]
            by_link = {link: [index for index, part in enumerate(parts) if part.link == link] for link in range(arm.n)}
            for pair, (link, object_index) in enumerate(obstacles.pairs.tolist(), start=len(body_pairs)):
                self._candidates += [
                    CandidatePair(pair, part_index, objects[object_index][0], part_index, objects[object_index][1])
                    for part_index in by_link[link]
                ]
        self._pair_of = np.array([meeting.pair for meeting in self._candidates], dtype=np.int64)

    def check_contacts(self, q: FloatArray, bounds: FloatArray) -> BoolArray:
        """Return (N,) True where anything touches.

        Args:
            q: (N, n) finite configurations, rad and m.
            bounds: (N, P) lower bounds of the distances of all pairs, m: those of links, then those of ``obstacles.pairs``.
        """
        return np.asarray(self.find_too_close_pair(q, bounds, np.zeros(bounds.shape[1])) >= 0)

    def find_too_close_pair(self, q: FloatArray, bounds: FloatArray, allowed: FloatArray) -> IndexArray:
        """Find a pair (N,) that is closer than allowed, by position in the bounds; -1 if there is none.

        Args:
            q: (N, n) finite configurations, rad and m.
            bounds: (N, P) lower bounds as for :meth:`check_contacts`, m.
            allowed: (P,) allowed distance of each pair, m; at 0 the pair may not touch, and below 0 it is not checked.
        """
        pairs, frames = np.full(len(q), -1), self._body_frames(q)
        allowed = allowed[self._pair_of]
        limit = np.where(allowed < 0, -np.inf, np.maximum(allowed, CONTACT_DISTANCE_M))
        bounds_by_candidate = self._lower_bounds(frames, bounds, np.full(len(q), limit.max(initial=CONTACT_DISTANCE_M)))
        rows, columns = np.nonzero(bounds_by_candidate < limit)
        order = np.lexsort((bounds_by_candidate[rows, columns], rows))
        current_row, placed_parts = -1, set[int]()
        for row, candidate_index in zip(rows[order].tolist(), columns[order].tolist(), strict=True):
            if pairs[row] >= 0:
                continue
            if row != current_row:
                current_row, placed_parts = row, set()
            candidate = self._candidates[candidate_index]
            self._place_candidate(candidate, row, frames, placed_parts)
            part = self._placed[candidate.part]
            is_closer = (
                candidate.geometry.body_distance(part) < allowed[candidate_index]
                if allowed[candidate_index] > 0
                else candidate.geometry.bodies_touch(part)
            )
            pairs[row] = candidate.pair if is_closer else -1
        return pairs

    def smallest_distances(self, q: FloatArray, bounds: FloatArray) -> FloatArray:
        """Return the smallest distance (N,), m; 0 in contact, infinite if there is nothing to touch.

        Args:
            q: (N, n) finite configurations, rad and m.
            bounds: (N, P) lower bounds as for :meth:`check_contacts`, m.
        """
        distances, frames = np.full(len(q), np.inf), self._body_frames(q)
        bounds_by_candidate = self._lower_bounds(frames, bounds, bounds.min(axis=1, initial=np.inf) + SEARCH_DISTANCE_M)
        for row, order in enumerate(np.argsort(bounds_by_candidate, axis=1).tolist()):
            smallest, placed_parts = np.inf, set[int]()
            for candidate_index in order:
                if bounds_by_candidate[row, candidate_index] >= smallest or smallest == 0:
                    break
                candidate = self._candidates[candidate_index]
                self._place_candidate(candidate, row, frames, placed_parts)
                smallest = min(smallest, candidate.geometry.body_distance(self._placed[candidate.part]))
            distances[row] = smallest
        return distances

    def _lower_bounds(self, frames: list[tuple[FloatArray, FloatArray]], bounds: FloatArray, limit: FloatArray) -> FloatArray:
        """Return lower bounds (N, M) of the distances of all candidates, m; below a limit (N,) also by balls."""
        lower_bounds = bounds[:, self._pair_of]
        for index, candidate in enumerate(self._candidates):
            (rows,) = np.nonzero(lower_bounds[:, index] < limit)
            if not rows.size:
                continue
            center, radius = self._bounding_spheres(candidate.part, frames, rows)
            if candidate.box is not None:
                distance = candidate.box.signed_distance(center) - radius
            else:
                other_center, other_radius = self._bounding_spheres(candidate.other, frames, rows)
                distance = np.linalg.norm(center - other_center, axis=1) - radius - other_radius
            lower_bounds[rows, index] = np.maximum(lower_bounds[rows, index], distance)
        return lower_bounds

    def _bounding_spheres(
        self, part: int, frames: list[tuple[FloatArray, FloatArray]], rows: IndexArray
    ) -> tuple[FloatArray, float]:
        """Return centers (R, 3) in the world and radius, m, of the ball around a body in some rows."""
        center, radius = self._parts[part].body.bounding_sphere
        rotation, position = frames[part]
        return position[rows] + rotation[rows] @ center, radius

    def _place_candidate(
        self, candidate: CandidatePair, row: int, frames: list[tuple[FloatArray, FloatArray]], placed_parts: set[int]
    ) -> None:
        for part_index in (candidate.part, candidate.other):
            if part_index not in placed_parts:
                placed_parts.add(part_index)
                placed, (rotations, positions) = self._placed[part_index], frames[part_index]
                placed.rotation, placed.position = rotations[row], positions[row]
                self.engine.place_body(placed.library_body, placed.rotation, placed.position)

    def _body_frames(self, q: FloatArray) -> list[tuple[FloatArray, FloatArray]]:
        """Return rotations (N, 3, 3) and positions (N, 3), m, of each part in the world."""
        link_frames = self.arm.frames(q)
        body_frames = []
        for part in self._parts:
            frame = link_frames[:, part.link + 1] @ part.body.pose
            body_frames.append((np.ascontiguousarray(frame[:, :3, :3]), np.ascontiguousarray(frame[:, :3, 3])))
        return body_frames


@lru_cache(maxsize=16)
def make_inner_spheres(parts: tuple[ArmBody, ...]) -> SphereCover:
    """Make spheres inside the known bodies of moving links; an object that touches a sphere touches the arm."""
    rows = []
    for number, part in sorted(enumerate(parts), key=lambda item: item[1].link):
        if part.link > BASE_LINK and part.known:
            centers, radii = part.body.inner_spheres
            centers = centers @ part.body.pose[:3, :3].T + part.body.pose[:3, 3]
            rows += [(part.link, center, radius, number) for center, radius in zip(centers, radii, strict=True)]
    return SphereCover(
        np.array([row[0] for row in rows], dtype=np.int64),
        np.array([row[1] for row in rows]).reshape(-1, 3),
        np.array([row[2] for row in rows]),
        np.array([row[3] for row in rows], dtype=np.int64),
    )
