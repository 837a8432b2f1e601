"""First contacts of falls with the objects of a cell, and of the arm with itself."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, lru_cache

import casadi as ca
import numpy as np

from holdfast.control.falls.passive_arm import solve_selected
from holdfast.control.falls.simulator import FallSimulator, FallStates
from holdfast.core.progress import track
from holdfast.core.typing import BoolArray, FloatArray, IndexArray, Rows
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.threads import in_pool, shared_pool, thread_count
from holdfast.model.arm import kinematics, statics
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.collision.capsules import BASE_LINK
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.compiled.edges import EdgeChecker
from holdfast.model.collision.compiled.spans import SpanChecker
from holdfast.model.collision.contacts import MIN_DISTANCE_CHANGE_M, Contact
from holdfast.model.collision.object_kernels import directional_jacobian
from holdfast.model.collision.segments import LineSegment, closest_parameters

CHECK_SPACING_S = 0.01  # simulated time between two computations of the distances
REQUIRED_GAP_M = 1e-3  # pairs that touch at the power loss are checked once they are this far apart
TIME_RESOLUTION_S = 2e-4  # of a contact; the distances are straight lines over a shorter span
FINEST_PIECE_S = 2.5e-3  # pieces of spans that the compiled check does not halve
BLOCK_DISTANCES = 1 << 22  # rows of a block times pairs
MIN_BLOCK_ROWS = 1 << 10  # of the block of one thread
MOST_WAITING_SPANS = 1 << 14  # between two checks, after which contacts are located in all of them together


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
    """One instant of each of R falls: its time (R,), s, and q and rates (R, n)."""

    time: FloatArray
    q: FloatArray
    rates: FloatArray


class ContactSearch:
    """Falls of one arm up to their first contacts.

    Each pair is checked every 10 ms. In between, a joint moves along the cubic polynomial through the positions and rates at
    both ends. Compiled code excludes contacts in most of these spans (:class:`SpanChecker`). The remaining pieces of spans are
    checked pair by pair: a distance that changes at most at a rate L comes no lower within a duration T than half of
    ``d_1 + d_2 - L T``, with the distances at both ends. If this is below 0, the piece is halved, until the distance changes by
    less than half a millimetre. Only a contact less than a quarter of a millimetre deep may be missed.

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
        self.lipschitz_bounds = clearance.lipschitz_bounds(reached.min(axis=0) - travel, reached.max(axis=0) + travel)
        self.checker = SpanChecker(clearance, self.lipschitz_bounds) if EdgeChecker.supports(clearance) else None
        self.time_row = simulator.stepper.layout.slices["time"].start

    def run(self, q: FloatArray, rates: FloatArray, until: FloatArray, step: FloatArray) -> FallStates:
        """Simulate falls up to their first contacts, or to given times; see :meth:`FallSimulator.run`."""
        calls = max(1, int(CHECK_SPACING_S / (self.simulator.stepper.steps_per_call * step.max(initial=1e-9))))
        fewest = 1 + len(q) * len(self.clearance.pair_names) // BLOCK_DISTANCES
        workers = 1 if in_pool() else min(thread_count(), 1 + len(q) // MIN_BLOCK_ROWS)
        blocks = np.array_split(np.arange(len(q)), max(fewest, workers))

        def run_block(rows: IndexArray) -> FallStates:
            return self._run_block(q[rows], rates[rows], until[rows], step[rows], calls)

        parts = map(run_block, blocks) if workers == 1 else shared_pool().map(run_block, blocks)
        return FallStates.join([part for _, part in zip(track("blocks of falls", blocks), parts, strict=True)])

    def _run_block(self, q: FloatArray, rates: FloatArray, until: FloatArray, step: FloatArray, calls: int) -> FallStates:
        stepper, rows = self.simulator.stepper, np.arange(len(q))
        states, parameters, most_calls = self.simulator.make_rows(q, rates, until, step)
        origins, done = np.empty_like(states), np.zeros(len(q), dtype=np.bool_)  # states before the contacts
        time, pair, ignored = until.copy(), np.full(len(q), -1, dtype=np.int64), self.find_touching(q)
        has_ignored = np.any(ignored, axis=1)
        distances = np.zeros(ignored.shape) if self.checker else self.clearance.by_pair(q)  # lower bounds
        spans: list[tuple[IndexArray, FloatArray, FloatArray]] = []  # falls and states at both ends, if a contact is possible
        contacts: list[tuple[IndexArray, IndexArray, FloatArray]] = []  # their spans, pairs, and pieces (3, C)
        paused: list[IndexArray] = []  # falls that seem to touch something
        span_count = 0

        def locate_contacts() -> None:
            falls, before, after = (np.concatenate(parts, axis=-1) for parts in zip(*spans, strict=True))
            possible = (np.concatenate(parts, axis=-1) for parts in zip(*contacts, strict=True))
            starts = np.ascontiguousarray(before.T)
            contact_times, touched = self._locate_contacts(starts, np.ascontiguousarray(after.T), *possible)
            order = np.argsort(-contact_times)  # the earliest contact of a fall is assigned last
            order = order[touched[order] >= 0]
            time[falls[order]], pair[falls[order]], origins[falls[order]] = contact_times[order], touched[order], starts[order]
            spans.clear()
            contacts.clear()

        def find_ended(falls: IndexArray, before: FloatArray, after: FloatArray) -> BoolArray:
            nonlocal span_count
            rows, pairs, pieces = np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64), np.zeros((3, 0))
            is_touching, slow = np.zeros(falls.size, dtype=np.bool_), np.arange(falls.size)
            if self.checker:
                slow = has_ignored[falls].nonzero()[0]
                found = self.checker.check_spans(before, after, falls.size, self.time_row, FINEST_PIECE_S)
                rows, pairs, pieces, is_touching = found
            if slow.size:
                of_slow, at = np.isin(rows, slow), falls[slow]
                start, end = (self._view_instants(columns[:, slow].T) for columns in (before, after))
                near, near_pairs, near_rates, is_touching[slow] = self._check_spans(start, end, distances, ignored, at)
                has_ignored[at] = np.any(ignored[at], axis=1)
                rows, pairs = np.append(rows[~of_slow], slow[near]), np.append(pairs[~of_slow], near_pairs)
                whole = np.array([np.zeros(near.size), np.ones(near.size), near_rates])
                pieces = np.hstack([pieces[:, ~of_slow], whole])
            if rows.size:
                is_possible = np.zeros(falls.size, dtype=np.bool_)
                is_possible[rows] = True
                possible = is_possible.nonzero()[0]
                spans.append((falls[possible], before[:, possible], after[: len(before), possible]))
                contacts.append((span_count - 1 + np.cumsum(is_possible)[rows], pairs, pieces))
                paused.append(falls[is_touching])
                span_count += possible.size
                if span_count > MOST_WAITING_SPANS:
                    locate_contacts()
                    span_count = 0
                    is_touching |= pair[falls] >= 0
            return is_touching

        while rows.size:
            done[rows] = stepper.loop.run_in_spans(states, parameters, rows, 0.5, most_calls, (calls, find_ended))[rows]
            if spans:
                locate_contacts()
            rows, span_count = np.concatenate([*paused, rows[:0]]), 0
            rows = rows[(pair[rows] < 0) & ~done[rows]]
            paused.clear()
        touching = np.flatnonzero(pair >= 0)
        for name, values in stepper.layout.view_parts(origins).items():
            if name in ("step", "tries", "mode"):
                values[touching] = 0.0  # the step to the contact is a new one
        stepper.parameters.view_parts(parameters)["until"][touching, 0] = time[touching]
        result = stepper.loop.run(origins[touching], parameters[touching], 0.5, most_calls)
        states[touching], done[touching] = result.state, result.done
        return self.simulator.read_states(parameters, states, done, pair)

    def find_touching(self, q: FloatArray) -> BoolArray:
        """Return (N, P) True for pairs that touch at configurations (N, n)."""
        touching, rows = np.zeros((len(q), len(self.clearance.pair_names)), dtype=np.bool_), np.arange(len(q))
        if self.checker:
            columns = np.zeros((2 * q.shape[1] + 1, len(q)))  # at rest, at time 0
            columns[: q.shape[1]] = q.T
            rows = np.unique(self.checker.check_spans(columns, columns, len(q), 2 * q.shape[1])[0])
        for part in np.array_split(rows, 1 + touching[rows].size // BLOCK_DISTANCES):
            touching[part] = self.clearance.by_pair(q[part]) < 0
        return touching

    def _view_instants(self, states: FloatArray) -> _Instant:
        """Return the instants of states of the loop."""
        parts = self.simulator.stepper.layout.view_parts(states)
        return _Instant(time=parts["time"][:, 0], q=parts["q"], rates=parts["rates"])

    def _check_spans(
        self, start: _Instant, end: _Instant, distances: FloatArray, ignored: BoolArray, falls: IndexArray
    ) -> tuple[IndexArray, IndexArray, FloatArray, BoolArray]:
        """Return the spans, pairs, and rates (C,) of possible contacts, and for spans (R,) whether there is one at the end.

        ``distances`` and ``ignored`` (N, P) of the falls (R,) become those at the end. Distances are computed only where their
        lower bounds do not exclude a contact.
        """
        first, last = ((end.time - start.time)[:, None] * part.rates for part in (start, end))
        # The derivatives of the cubic polynomials are between their Bernstein coefficients.
        speeds = np.abs([first, last, 3 * (end.q - start.q) - first - last]).max(axis=0)
        rates = speeds @ self.lipschitz_bounds.T
        bounds, counts = distances[falls] - rates, ~ignored[falls]
        doubtful = np.flatnonzero(np.any(bounds < 0, axis=1) | ~counts.all(axis=1))
        last, counts = self.clearance.by_pair(end.q[doubtful]), counts[doubtful]
        touching = np.zeros(len(falls), dtype=np.bool_)
        touching[doubtful] = np.any((last < 0) & counts, axis=1)
        rows, pairs = np.nonzero(((bounds[doubtful] + last < 0) | (last < 0)) & counts)
        bounds[doubtful] = last
        distances[falls] = bounds if self.checker is None else 0.0
        ignored[falls[doubtful]] = ~counts & (last < REQUIRED_GAP_M)
        return doubtful[rows], pairs, rates[doubtful[rows], pairs], touching

    def _locate_contacts(
        self, starts: FloatArray, ends: FloatArray, falls: IndexArray, pairs: IndexArray, pieces: FloatArray
    ) -> tuple[FloatArray, IndexArray]:
        """Return the times (R,) and the pairs (R,) of the first contacts between states; infinite and -1 for none.

        Contacts of pairs (C,) are possible in pieces (3, C) of the spans of falls (C,); see :class:`SpanChecker`. A piece is
        split until a contact is excluded or located.
        """
        start, end = self._view_instants(starts), self._view_instants(ends)
        duration, polynomials = end.time - start.time, _interpolate(start, end)  # of the fraction of the duration
        distances = [self._measure_pairs(_evaluate(polynomials, falls, fraction), pairs) for fraction in pieces[:2]]
        spans = np.array([*pieces[:2], *distances, pieces[2]])
        fraction, pair = np.full(len(starts), np.inf), np.full(len(starts), -1, dtype=np.int64)
        latest = fraction.copy()  # fractions at which a contact has begun
        while falls.size:
            before, after, first_distance, last_distance, rates = spans
            width, touching = after - before, last_distance < 0
            np.minimum.at(latest, falls[touching], after[touching])
            is_possible = touching | (first_distance + last_distance < rates * width)
            is_fine = np.where(touching, width * duration[falls] <= TIME_RESOLUTION_S, rates * width < MIN_DISTANCE_CHANGE_M)
            # A span that begins in contact has its contact at its beginning.
            approach = np.maximum(first_distance - last_distance, 1e-300)
            instants = before + np.where(first_distance > 0, first_distance / approach, 0.0) * width
            earlier = np.flatnonzero(touching & is_fine & (instants < fraction[falls]))
            order = earlier[np.argsort(-instants[earlier])]  # the earliest contact of a fall is assigned last
            fraction[falls[order]], pair[falls[order]] = instants[order], pairs[order]
            split = is_possible & ~is_fine & (before < latest[falls])
            falls, pairs, (before, after, first_distance, last_distance, rates) = falls[split], pairs[split], spans[:, split]
            middle = (before + after) / 2
            distance = self._measure_pairs(_evaluate(polynomials, falls, middle), pairs)
            halves = [before, middle, first_distance, distance, rates], [middle, after, distance, last_distance, rates]
            falls, pairs, spans = np.tile(falls, 2), np.tile(pairs, 2), np.concatenate(halves, axis=1)
        return start.time + np.where(pair < 0, np.inf, fraction) * np.maximum(duration, 1e-300), pair

    def _measure_pairs(self, q: FloatArray, pairs: IndexArray) -> FloatArray:
        """Return the distance (R,) of one pair at each configuration (R, n)."""
        distances, own_count, obstacles = np.empty(len(q)), len(self.clearance.pairs), self.clearance.obstacles
        own, other = np.flatnonzero(pairs < own_count), np.flatnonzero(pairs >= own_count)
        distances[own] = self.clearance.self_only.by_pair(q[own])[np.arange(own.size), pairs[own]]
        if obstacles is not None:
            distances[other] = obstacles.distances_of_pairs(q[other], pairs[other] - own_count)
        return distances


def _interpolate(start: _Instant, end: _Instant) -> FloatArray:
    """Return the coefficients (4, R, n) of the cubic polynomials between two instants, from the constant one on."""
    duration = (end.time - start.time)[:, None]
    chord, first, last = end.q - start.q, duration * start.rates, duration * end.rates
    return np.stack([start.q, first, 3 * chord - 2 * first - last, first + last - 2 * chord])


def _evaluate(polynomials: FloatArray, rows: IndexArray, fraction: FloatArray) -> FloatArray:
    """Return the values (C, n) of some of the polynomials (4, R, n) at fractions (C,)."""
    values, s = polynomials[3][rows], fraction[:, None]
    for coefficients in polynomials[2::-1]:
        values *= s
        values += coefficients[rows]
    return np.asarray(values)


@lru_cache(maxsize=16)
@cached_kernel
def _contact_kernel(arm: Arm) -> Kernel:
    """Return the kernel of a configuration, rates, a contact point and its normal (3,), and signs and free joints (n,).

    A sign is that of the motion of the link relative to the object by a joint. The results are the speed at which the link
    approaches along the normal, the inverse of the effective mass, and the kinetic energy.
    """
    q, (rates, side, free) = kinematics.joint_symbols(arm), (ca.SX.sym(name, arm.n) for name in ("v", "s", "f"))
    point, normal = ca.SX.sym("p", 3), ca.SX.sym("n", 3)
    gradient = side * ca.vertcat(*directional_jacobian(arm, q, ca.SX(arm.n), ca.vertsplit(point), ca.vertsplit(normal)))
    matrix, nothing = statics.inertia_matrix(arm, q), ca.SX(arm.n, 1)
    mobility = ca.dot(gradient, solve_selected(matrix, gradient, free, nothing))
    results = [-ca.dot(gradient, rates), mobility, ca.dot(rates, matrix @ rates) / 2]
    return Kernel("contact of a fall", [q, rates, point, normal, side, free], results)


def collect_contact_fields(search: ContactSearch, initial: BoolArray, states: FallStates) -> Rows:
    """Return the fields of :class:`FallContacts` that have rows, for falls with ``initial`` contacts (N, P) to later ones."""
    simulator, clearance = search.simulator, search.clearance
    arm, free, q, pair = simulator.arm, np.asarray(simulator.conditions["free"]), states.q, states.pair
    (point, normal), links, joints = np.full((2, len(q), 3), np.nan), np.full((2, len(q)), BASE_LINK), np.arange(arm.n)
    own_count, obstacles = len(clearance.pairs), clearance.obstacles
    own, other = np.flatnonzero((pair >= 0) & (pair < own_count)), np.flatnonzero(pair >= own_count)
    if obstacles is not None and other.size:
        point[other], normal[other] = obstacles.find_contact_points(q[other], pair[other] - own_count)
        links[0, other] = obstacles.pairs[pair[other] - own_count, 0]
    if own.size:
        parts, chosen = clearance.capsules.parts, np.array(clearance.pairs)[pair[own]].T
        links[:, own] = np.array([part.link for part in parts])[chosen]
        ends, frames = np.array([[part.start, part.end] for part in parts]), arm.frames(q[own])
        poses = [frames[np.arange(own.size), of_part + 1] for of_part in links[:, own]]
        squares = np.array([part.length**2 or 1.0 for part in parts])[chosen].T
        first, second = np.split(_closest_points_kernel().rows(*poses, *ends[chosen], squares), 2, axis=1)
        normal[own] = (first - second) / np.maximum(np.linalg.norm(first - second, axis=1, keepdims=True), 1e-300)
        point[own] = first - np.array([part.radius for part in parts])[chosen[0], None] * normal[own]
    # 1 if a joint moves only the link, -1 if it moves only the other link. Objects are fixed, as is the base.
    side = (joints <= links[0, :, None]).astype(float) - (joints <= links[1, :, None])
    motion = _contact_kernel(arm).rows(q, states.rates, point, normal, side, np.broadcast_to(free, q.shape))
    speed, mobility, kinetic = motion.T  # NaN without contact
    mass = 1 / np.where(mobility == 0, np.nan, mobility)
    return {
        "pair": pair,
        "time": np.where(pair < 0, np.nan, states.time),
        "point": point,
        "normal": normal,
        "normal_speed": speed,
        "effective_mass": mass,
        "energy_lost": mass / 2 * speed**2,
        "kinetic_energy": kinetic,
        "initial": initial,
    }


@cache
def _closest_points_kernel() -> Kernel:
    """Return the kernel of two poses, two segments (2, 3) in them, and their squared lengths, to their closest points (3,)."""
    poses, ends = (
        [ca.SX.sym(name, rows, rows if rows == 4 else 3) for _ in range(2)] for name, rows in (("pose", 4), ("ends", 2))
    )
    squares, segments = ca.SX.sym("squares", 2), []
    for k in range(2):
        placed = poses[k][:3, :3] @ ends[k].T + ca.repmat(poses[k][:3, 3], 1, 2)
        segments.append(LineSegment(placed[:, 0], placed[:, 1] - placed[:, 0], squares[k]))
    closest = [segment.point_at(s) for segment, s in zip(segments, closest_parameters(*segments), strict=True)]
    return Kernel("closest points of two capsules", [*poses, *ends, squares], closest)
