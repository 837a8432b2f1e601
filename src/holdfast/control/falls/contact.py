"""First contacts of falls with the objects of a cell, and of the arm with itself."""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca
import numpy as np

from holdfast.control.falls.simulator import FallSimulator, FallStates
from holdfast.core.progress import track
from holdfast.core.typing import BoolArray, FloatArray, IndexArray, Rows
from holdfast.kernels.kernel import Kernel
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.collision.capsules import BASE_LINK
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.contacts import MIN_DISTANCE_CHANGE_M, Contact
from holdfast.model.collision.segments import LineSegment, closest_parameters

CHECK_SPACING_S = 0.01  # simulated time between two computations of the distances
REQUIRED_GAP_M = 1e-3  # pairs that touch at the power loss are checked once they are this far apart
TIME_RESOLUTION_S = 2e-4  # of a contact; the distances are straight lines over a shorter span
BLOCK_DISTANCES = 1 << 22  # rows of a block times pairs


@dataclass(frozen=True, kw_only=True)
class FallContacts:
    """First contacts of N falls; for a single fall arrays lack the axis N.

    A contact is the first time at which the lower bound of the distance of a pair is 0. Numbers of falls without contact are
    NaN.

    Attributes:
        pair_names: Names of the P checked pairs, as in ``pair_names`` of :class:`holdfast.Clearance`.
        pair: (N,) position of the touching pair in ``pair_names``; -1 for a fall without contact.
        time: (N,) time since the power loss, s.
        point: (N, 3) point of the contact on the link, in the world, m.
        normal: (N, 3) unit vector in the world from the object to the link.
        normal_speed: (N,) speed at which the link approaches the object along the normal, m/s.
        effective_mass: (N,) mass of the arm at the contact along the normal, kg. All joints without power take part, and the
            object is fixed.
        energy_lost: (N,) kinetic energy that the contact dissipates if it is plastic, J.
        kinetic_energy: (N,) kinetic energy of the arm just before the contact, J.
        initial: (N, P) True for a pair that touches at the power loss. It is ignored until its distance is 1 mm.
    """

    pair_names: tuple[str, ...]
    pair: IndexArray
    time: FloatArray
    point: FloatArray
    normal: FloatArray
    normal_speed: FloatArray
    effective_mass: FloatArray
    energy_lost: FloatArray
    kinetic_energy: FloatArray
    initial: BoolArray

    def select_contact(self, row: int = 0) -> Contact | None:
        """Return the contact of one fall, which has a sentence; None for a fall without contact."""
        pair, time = int(np.atleast_1d(self.pair)[row]), float(np.atleast_1d(self.time)[row])
        link, _, other = self.pair_names[pair].partition(" & ")
        return Contact(run=row, time=time, link=link, object=other, depth=0.0) if pair >= 0 else None


@dataclass(frozen=True, kw_only=True)
class _Instant:
    """One instant of each of R falls: its time (R,), q and rates (R, n), and the distances (R, P) of pairs, or (R,) of one."""

    time: FloatArray
    q: FloatArray
    rates: FloatArray
    distances: FloatArray

    def select(self, rows: IndexArray | BoolArray) -> _Instant:
        """Return some of the falls."""
        return _Instant(**{name: value[rows] for name, value in vars(self).items()})

    def join(self, other: _Instant) -> _Instant:
        """Return these instants and, after them, those of the other one."""
        return _Instant(**{name: np.concatenate([value, getattr(other, name)]) for name, value in vars(self).items()})


class ContactSearch:
    """Falls of one arm up to their first contacts.

    The distances are computed every 10 ms. In between, a joint moves along the cubic polynomial through the positions and rates
    at both ends. A pair with the distances d_1 and d_2 at two instants comes no closer between them than ``(d_1 + d_2 - L) /
    2``, where L bounds the change of its distance (:meth:`Clearance.lipschitz_bounds`). If this is below 0, the span is halved,
    until L is below half a millimetre. Only a contact that is less than a quarter of a millimetre deep may be missed.

    Args:
        simulator: Simulator of the falls.
        clearance: Collision model; margins are not contacts.
        starts: (N, n) finite configurations at the power loss, rad and m.
        duration: Longest simulated time, s.
    """

    def __init__(self, simulator: FallSimulator, clearance: Clearance, starts: FloatArray, duration: float) -> None:
        self.simulator, self.clearance, arm = simulator, clearance, simulator.arm
        limits = np.array(sampling_limits(arm))
        # Only the travel of prismatic joints matters. Without a stop it is assumed to be at most that of twice a free fall.
        is_stopped = simulator.has_stops & np.isfinite(arm.lower) & np.isfinite(arm.upper)
        travel = np.where(is_stopped, 0.0, np.linalg.norm(arm.gravity) * duration**2)
        reached = np.concatenate([limits, starts])
        self.change_bounds = clearance.lipschitz_bounds(reached.min(axis=0) - travel, reached.max(axis=0) + travel)
        own, objects = np.split(self.change_bounds, [len(clearance.pairs)])
        self.nearest_change_bounds = np.concatenate([own, objects.max(axis=0, keepdims=True)]) if len(objects) else own

    def run(self, q: FloatArray, rates: FloatArray, until: FloatArray, step: FloatArray) -> FallStates:
        """Simulate falls up to their first contacts, or to given times; see :meth:`FallSimulator.run`."""
        block_rows = BLOCK_DISTANCES // (1 + len(self.clearance.pair_names))
        blocks = [slice(start, start + block_rows) for start in range(0, max(len(q), 1), block_rows)]
        tracked = track("blocks of falls", blocks)
        return FallStates.join([self._run_block(q[b], rates[b], until[b], step[b]) for b in tracked])

    def _run_block(self, q: FloatArray, rates: FloatArray, until: FloatArray, step: FloatArray) -> FallStates:
        stepper, rows = self.simulator.stepper, np.arange(len(q))
        states, parameters, most_calls = self.simulator.make_rows(q, rates, until, step)
        done, time, pair = np.zeros(len(q), dtype=np.bool_), until.copy(), np.full(len(q), -1, dtype=np.int64)
        calls = max(1, int(CHECK_SPACING_S / (stepper.steps_per_call * step.max(initial=1e-9))))
        before, ignored = self._measure_nearest(np.zeros(len(q)), q, rates), self.clearance.by_pair(q) < 0
        for _ in range(most_calls // calls + 1):
            result = stepper.loop.run(states[rows], parameters[rows], 0.5, calls)
            parts = stepper.layout.view_parts(result.state)
            after = self._measure_nearest(parts["time"][:, 0], parts["q"], parts["rates"])
            possible, _ = _find_possible_contacts(before, after, self.nearest_change_bounds)
            doubtful = np.union1d(possible, np.flatnonzero(ignored.any(axis=1)))
            start, end = (self._measure_pairs(part.select(doubtful)) for part in (before, after))
            time[rows[doubtful]], pair[rows[doubtful]] = self._locate_contacts(start, end, ignored[doubtful])
            ignored[doubtful] &= end.distances < REQUIRED_GAP_M
            is_clear = pair[rows] < 0  # all others keep the state before their contact
            states[rows[is_clear]], done[rows] = result.state[is_clear], result.done
            remaining = np.flatnonzero(is_clear & ~result.done)
            rows, before, ignored = rows[remaining], after.select(remaining), ignored[remaining]
            if not rows.size:
                break
        touching = np.flatnonzero(pair >= 0)
        for name, values in stepper.layout.view_parts(states).items():
            if name in ("step", "tries", "mode"):
                values[touching] = 0.0  # the step to the contact is a new one
        stepper.parameters.view_parts(parameters)["until"][touching, 0] = time[touching]
        result = stepper.loop.run(states[touching], parameters[touching], 0.5, most_calls)
        states[touching], done[touching] = result.state, result.done
        return self.simulator.read_states(q, states, done, pair)

    def _measure_pairs(self, instant: _Instant) -> _Instant:
        return replace(instant, distances=self.clearance.by_pair(instant.q))

    def _measure_nearest(self, time: FloatArray, q: FloatArray, rates: FloatArray) -> _Instant:
        """Return instants with the distances of all pairs of links, and of the nearest object, which are fast to compute."""
        distances, obstacles = self.clearance.self_only.by_pair(q), self.clearance.obstacles
        if obstacles is not None:
            distances = np.column_stack([distances, obstacles.smallest_distance(q)])
        return _Instant(time=time, q=q, rates=rates, distances=distances)

    def _locate_contacts(self, start: _Instant, end: _Instant, ignored: BoolArray) -> tuple[FloatArray, IndexArray]:
        """Return the times (R,) and the pairs (R,) of the first contacts between two instants; infinite and -1 for none.

        A span of time in which a contact of a pair is possible is split until it is excluded or located.
        """
        time, pair = np.full(len(ignored), np.inf), np.full(len(ignored), -1, dtype=np.int64)
        latest = time.copy()  # times at which a contact has begun
        falls, pairs = _find_possible_contacts(start, end, self.change_bounds, ignored)
        before, after = (replace(part.select(falls), distances=part.distances[falls, pairs]) for part in (start, end))
        start, end = (replace(part, distances=part.time) for part in (start, end))  # only their motion is needed from here on
        while falls.size:
            change = np.sum(_bound_travel(before, after) * self.change_bounds[pairs], axis=1)
            duration, touching = after.time - before.time, after.distances < 0
            np.minimum.at(latest, falls[touching], after.time[touching])
            is_possible = touching | (before.distances + after.distances < change)
            is_coarse = is_possible & np.where(touching, duration > TIME_RESOLUTION_S, change >= MIN_DISTANCE_CHANGE_M)
            # A span that begins in contact has its contact at its beginning.
            approach = np.maximum(before.distances - after.distances, 1e-300)
            fraction = np.where(touching & (before.distances > 0), before.distances / approach, 0.0)
            instants = np.where(touching & ~is_coarse, before.time + fraction * duration, np.inf)
            order = np.argsort(-instants)  # the earliest contact of a fall is assigned last
            order = order[instants[order] < time[falls[order]]]
            time[falls[order]], pair[falls[order]] = instants[order], pairs[order]
            split = is_coarse & (before.time < latest[falls])
            falls, pairs, before, after = falls[split], pairs[split], before.select(split), after.select(split)
            middle_time = (before.time + after.time) / 2
            middle = self._measure_pairs(_interpolate(start.select(falls), end.select(falls), middle_time))
            middle = replace(middle, distances=middle.distances[np.arange(falls.size), pairs])
            before, after = before.join(middle), middle.join(after)
            falls, pairs = np.tile(falls, 2), np.tile(pairs, 2)
        return time, pair


def _bound_travel(before: _Instant, after: _Instant) -> FloatArray:
    """Bound the travel (R, n) of each joint on the cubic polynomials between two instants, rad and m."""
    half = (after.time - before.time)[:, None] / 2
    travel = half * (np.abs(before.rates) + np.abs(after.rates))
    return np.asarray(travel + np.abs(after.q - before.q - half * (before.rates + after.rates)))


def _find_possible_contacts(
    before: _Instant, after: _Instant, change_bounds: FloatArray, ignored: BoolArray | bool = False
) -> tuple[IndexArray, IndexArray]:
    """Return the falls and the pairs of which the distance may reach 0 between two instants."""
    travel, sums, touching = _bound_travel(before, after), before.distances + after.distances, after.distances < 0
    # Most pairs are excluded by the largest bound of all pairs.
    largest_change = np.einsum("rj,j->r", travel, change_bounds.max(axis=0, initial=0.0))
    falls, pairs = np.nonzero(((sums < largest_change[:, None]) | touching) & np.logical_not(ignored))
    change = np.sum(travel[falls] * change_bounds[pairs], axis=1)
    is_possible = (sums[falls, pairs] < change) | touching[falls, pairs]
    return falls[is_possible], pairs[is_possible]


def _interpolate(start: _Instant, end: _Instant, time: FloatArray) -> _Instant:
    """Return instants on the cubic polynomials between two others, with the distances of the first."""
    duration = (end.time - start.time)[:, None]
    s = (time - start.time)[:, None] / duration
    chord, first, last = end.q - start.q, duration * start.rates, duration * end.rates
    second, third = 3 * chord - 2 * first - last, first + last - 2 * chord
    q = start.q + s * (first + s * (second + s * third))
    return replace(start, time=time, q=q, rates=(first + s * (2 * second + 3 * s * third)) / duration)


def collect_contact_fields(simulator: FallSimulator, clearance: Clearance, starts: FloatArray, states: FallStates) -> Rows:
    """Return the fields of :class:`FallContacts` that have rows, for falls from ``starts`` (N, n) to their contacts."""
    arm, free, q, pair = simulator.arm, np.asarray(simulator.conditions["free"]) > 0, states.q, states.pair
    frames, joints = arm.frames(q), np.arange(arm.n)
    point, normal = np.full((len(q), 3), np.nan), np.full((len(q), 3), np.nan)
    side = np.zeros((len(q), arm.n))  # 1 if the joint moves only the link, -1 if it moves only the other link
    for index in np.unique(pair[pair >= 0]):
        rows = pair == index
        point[rows], normal[rows], link, other = _locate_contact_points(clearance, int(index), frames[rows])
        side[rows] = (joints <= link).astype(float) - (joints <= other)
    axes = np.einsum("nkij,kj->nki", frames[:, 1:-1, :3, :3], [joint.axis for joint in arm.joints])
    levers = np.cross(axes, point[:, None] - frames[:, 1:-1, :3, 3])
    gradient = side * np.einsum("nki,ni->nk", np.where(arm.prismatic[:, None], axes, levers), normal)
    speed, free_gradient = -np.sum(gradient * states.rates, axis=1), (gradient * free)[:, :, None]
    inertia = np.where(np.outer(free, free), simulator.inertia_matrices(q), np.eye(arm.n))
    mobility = np.sum(free_gradient * np.linalg.solve(inertia, free_gradient), axis=(1, 2))  # NaN without contact
    mass = 1 / np.where(mobility == 0, np.nan, mobility)
    block_count = 1 + pair.size * len(clearance.pair_names) // BLOCK_DISTANCES
    return {
        "pair": pair,
        "time": np.where(pair < 0, np.nan, states.time),
        "point": point,
        "normal": normal,
        "normal_speed": speed,
        "effective_mass": mass,
        "energy_lost": mass / 2 * speed**2,
        "kinetic_energy": np.where(pair < 0, np.nan, simulator.energies(q, states.rates)[1]),
        "initial": np.concatenate([clearance.by_pair(block) < 0 for block in np.array_split(starts, block_count)]),
    }


def _locate_contact_points(clearance: Clearance, pair: int, frames: FloatArray) -> tuple[FloatArray, FloatArray, int, int]:
    """Return points on the link and unit vectors from the object to it (N, 3), and the indices of the link and the object.

    The index of an object of the cell is that of the base, which is fixed as well.
    """
    own = len(clearance.pairs)
    if pair >= own and clearance.obstacles is not None:
        link = int(clearance.obstacles.pairs[pair - own, 0])
        point, _, normal = clearance.obstacles.find_closest_points(pair - own, frames[:, link + 1])
        return point, normal, link, BASE_LINK
    parts = [clearance.capsules.parts[index] for index in clearance.pairs[pair]]
    ends, symbols, segments = [], [], []
    for part in parts:
        pose, symbol = frames[:, part.link + 1], ca.SX.sym("ends", 2, 3)
        ends.append(np.array([part.start, part.end]) @ pose[:, :3, :3].swapaxes(1, 2) + pose[:, None, :3, 3])
        segments.append(LineSegment(symbol[0, :].T, (symbol[1, :] - symbol[0, :]).T, part.length**2))
        symbols.append(symbol)
    closest = [segment.point_at(s) for segment, s in zip(segments, closest_parameters(*segments), strict=True)]
    kernel = Kernel("closest points of two capsules", symbols, closest, backend="casadi")
    first, second = np.split(kernel.rows(*ends), 2, axis=1)
    normal = (first - second) / np.maximum(np.linalg.norm(first - second, axis=1, keepdims=True), 1e-300)
    return first - parts[0].radius * normal, normal, parts[0].link, parts[1].link
