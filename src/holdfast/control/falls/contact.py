"""First contacts of falls with the objects of a cell, and of the arm with itself."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import casadi as ca
import numpy as np

from holdfast.control.falls.passive_arm import largest, smallest
from holdfast.control.falls.simulator import FallSimulator, FallStates
from holdfast.control.simulation.system import LARGE_NUMBER, elementwise_max
from holdfast.core.progress import track
from holdfast.core.typing import BoolArray, FloatArray, IndexArray, Rows
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.kernels.threads import in_pool, shared_pool, thread_count
from holdfast.model.arm import kinematics
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.collision.capsules import BASE_LINK, Capsules
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.contacts import MIN_DISTANCE_CHANGE_M, Contact
from holdfast.model.collision.segments import LineSegment, closest_parameters

CHECK_SPACING_S = 0.01  # simulated time between two computations of the distances
REQUIRED_GAP_M = 1e-3  # pairs that touch at the power loss are checked once they are this far apart
TIME_RESOLUTION_S = 2e-4  # of a contact; the distances are straight lines over a shorter span
BLOCK_DISTANCES = 1 << 22  # rows of a block times pairs
MIN_BLOCK_ROWS = 1 << 10  # of the block of one thread
MOST_WAITING_SPANS = 1 << 12  # between two checks, after which contacts are located in all of them together


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
    both ends. The points of a link differ from straight motions, whose longest is D, by at most a margin e
    (:func:`_bound_kernel`). So a pair with the distances d_1 and d_2 at two instants comes no closer between them than
    ``(d_1 + d_2 - D) / 2 - e``. If this is below 0, the span is halved, until the distance changes by less than half a
    millimetre. The distances at an instant are only computed where ``d_1 - D < e``, with the last computed d_1 and the D of all
    spans since. Only a contact less than a quarter of a millimetre deep may be missed.

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
        self.levers = clearance.lipschitz_bounds(reached.min(axis=0) - travel, reached.max(axis=0) + travel).max(
            axis=0, initial=0.0
        )
        self.bound_kernel = _bound_kernel(arm, clearance.capsules, tuple(clearance.pairs), clearance.obstacles is not None)
        own_count, objects = len(clearance.pairs), 0 if clearance.obstacles is None else len(clearance.obstacles.cell)
        others = np.arange(own_count, len(clearance.pair_names))
        self.nearest_of_pair = np.concatenate([np.arange(own_count), own_count + (others - own_count) // max(objects, 1)])

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
        done, time, pair = np.zeros(len(q), dtype=np.bool_), until.copy(), np.full(len(q), -1, dtype=np.int64)
        distances, ignored = self._measure_nearest(q), self.clearance.by_pair(q) < 0
        has_ignored = np.any(ignored, axis=1)
        # Spans of falls in which a contact is possible.
        spans: list[tuple[IndexArray, FloatArray, FloatArray, BoolArray]] = []
        span_count = 0
        for remaining_checks in reversed(range(most_calls // calls + 1)):
            before = states[rows]
            result = stepper.loop.run(before, parameters[rows], 0.5, calls)
            after, watched = self._view_instants(result.state), has_ignored[rows]
            distances, margins, excess = self._bound_distances(self._view_instants(before), after, distances)
            # The distances are computed only where these lower bounds do not exclude a contact.
            doubtful = np.flatnonzero((excess < 0) | watched)
            measured, is_running = self._measure_nearest(after.q[doubtful]), ~result.done
            is_touching = np.any(measured < 0, axis=1)
            is_near = (distances[doubtful] + measured < 2 * margins[doubtful]).any(axis=1)
            possible = doubtful[is_touching | watched[doubtful] | is_near]
            if possible.size:
                span_count += possible.size
                spans.append((rows[possible], before[possible], result.state[possible], ignored[rows[possible]]))
            distances[doubtful] = measured
            is_running[doubtful[is_touching & ~watched[doubtful]]] = False
            if watched.any():
                by_pair, falls = self.clearance.by_pair(after.q[watched]), rows[watched]
                is_running[watched] &= ((by_pair >= 0) | ignored[falls]).all(axis=1)
                ignored[falls] &= by_pair < REQUIRED_GAP_M
                has_ignored[falls] = np.any(ignored[falls], axis=1)
            states[rows], done[rows] = result.state, result.done
            rows, distances = rows[is_running], distances[is_running]
            if spans and not (rows.size and remaining_checks and span_count <= MOST_WAITING_SPANS):
                falls, starts, ends, were_ignored = map(np.concatenate, zip(*spans, strict=True))
                contact_times, pairs = self._locate_contacts(starts, ends, were_ignored)
                order = np.argsort(-contact_times)  # the earliest contact of a fall is assigned last
                order = order[pairs[order] >= 0]
                time[falls[order]], pair[falls[order]], states[falls[order]] = contact_times[order], pairs[order], starts[order]
                spans, span_count, is_clear = [], 0, np.flatnonzero(pair[rows] < 0)
                rows, distances = rows[is_clear], distances[is_clear]
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

    def _view_instants(self, states: FloatArray) -> _Instant:
        """Return the instants of states of the loop."""
        parts = self.simulator.stepper.layout.view_parts(states)
        return _Instant(time=parts["time"][:, 0], q=parts["q"], rates=parts["rates"])

    def _bound_distances(self, start: _Instant, end: _Instant, distances: FloatArray) -> tuple[FloatArray, ...]:
        """Return lower bounds of :meth:`_measure_nearest` at the end, margins (R, 1), and excesses (R,), m."""
        motion = start.q, start.rates, end.q, end.rates, end.time - start.time
        bounds = self.bound_kernel.rows(*motion, np.broadcast_to(self.levers, start.q.shape), distances)
        return bounds[:, :-2], bounds[:, -2:-1], bounds[:, -1]

    def _measure_nearest(self, q: FloatArray) -> FloatArray:
        """Return the distances (R, K) of all pairs of links, and of each link from its nearest object."""
        distances, obstacles = self.clearance.self_only.by_pair(q), self.clearance.obstacles
        return distances if obstacles is None else np.hstack([distances, obstacles.smallest_by_link(q)])

    def _locate_contacts(self, starts: FloatArray, ends: FloatArray, ignored: BoolArray) -> tuple[FloatArray, IndexArray]:
        """Return the times (R,) and the pairs (R,) of the first contacts between states; infinite and -1 for none.

        A span of time in which a contact of a pair is possible is split until it is excluded or located.
        """
        start, end = self._view_instants(starts), self._view_instants(ends)
        duration, first, last = end.time - start.time, self.clearance.by_pair(start.q), self.clearance.by_pair(end.q)
        bounds, margins, _ = self._bound_distances(start, end, np.zeros((len(first), 1 + self.nearest_of_pair.max(initial=-1))))
        is_near = first + last + bounds[:, self.nearest_of_pair] < 2 * margins
        falls, pairs = np.nonzero((is_near | (last < 0)) & ~ignored)
        polynomials = _interpolate(start, end)  # of the fraction of the duration
        rates = 4 * margins[falls, 0] - bounds[falls, self.nearest_of_pair[pairs]]
        spans = np.array([np.zeros(falls.size), np.ones(falls.size), first[falls, pairs], last[falls, pairs], rates])
        fraction, pair = np.full(len(ignored), np.inf), np.full(len(ignored), -1, dtype=np.int64)
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
            instants[~(touching & is_fine)] = np.inf
            order = np.argsort(-instants)  # the earliest contact of a fall is assigned last
            order = order[instants[order] < fraction[falls[order]]]
            fraction[falls[order]], pair[falls[order]] = instants[order], pairs[order]
            split = is_possible & ~is_fine & (before < latest[falls])
            falls, pairs, (before, after, first_distance, last_distance, rates) = falls[split], pairs[split], spans[:, split]
            middle, chosen = (before + after) / 2, polynomials[falls]
            q, s = chosen[:, 3], middle[:, None]
            for power in (2, 1, 0):
                q = chosen[:, power] + s * q
            distance = self._measure_pairs(q, pairs)
            halves = [before, middle, first_distance, distance, rates], [middle, after, distance, last_distance, rates]
            falls, pairs, spans = np.tile(falls, 2), np.tile(pairs, 2), np.concatenate(halves, axis=1)
        return start.time + fraction * duration, pair

    def _measure_pairs(self, q: FloatArray, pairs: IndexArray) -> FloatArray:
        """Return the distance (R,) of one pair at each configuration (R, n)."""
        distances, own_count, obstacles = np.empty(len(q)), len(self.clearance.pairs), self.clearance.obstacles
        own, other = np.flatnonzero(pairs < own_count), np.flatnonzero(pairs >= own_count)
        distances[own] = self.clearance.self_only.by_pair(q[own])[np.arange(own.size), pairs[own]]
        if obstacles is not None:
            distances[other] = obstacles.distances_of_pairs(q[other], pairs[other] - own_count)
        return distances


@lru_cache(maxsize=16)
@cached_kernel
def _bound_kernel(arm: Arm, capsules: Capsules, pairs: tuple[tuple[int, int], ...], has_objects: bool) -> Kernel:
    """Return the kernel of two states, their distance in time, s, levers (n,), and distances (K,), m.

    Its results are the distances minus displacements (K,), a margin, and the least excess of these over the margin, m. A
    displacement is the largest of the points of a link: for each pair of links as seen from the first one, then for each link
    with capsules as seen from the base. In between, a point differs from its straight motion by at most the margin, which is an
    eighth of a bound on its second derivative. The levers bound the distances of all points from the joint axes, m.
    """
    parts, n = capsules.parts, arm.n
    q, rates, later_q, later_rates, levers = (ca.SX.sym(name, n) for name in ("q", "v", "q1", "v1", "l"))
    duration = ca.SX.sym("t")
    ends = [kinematics.joint_transforms(arm, x) for x in (q, later_q)]

    def find_largest(numbers: list[int], seen_from: int) -> SX:
        poses = [kinematics.body_and_joint_frames(arm, steps, seen_from + 1)[0] for steps in ends]
        squares = []
        for part, end in ((parts[number], end) for number in numbers for end in ("start", "end")):
            point = kinematics.constant_matrix(np.array(getattr(part, end)))
            before, after = (rotation @ point + position for rotation, position in (pose[part.link + 1] for pose in poses))
            squares.append(ca.sumsqr(after - before))
        return ca.sqrt(largest(ca.vertcat(*squares)))

    links = sorted({part.link for part in parts} - {BASE_LINK}) if has_objects else []
    own = [find_largest([second], parts[first].link) for first, second in pairs]
    moved = [find_largest([k for k, part in enumerate(parts) if part.link == link], BASE_LINK) for link in links]
    # On the cubic polynomials, rates and accelerations are between Bernstein coefficients. The unit of time is the duration.
    chord, first, last = later_q - q, duration * rates, duration * later_rates
    speed = elementwise_max(elementwise_max(ca.fabs(first), ca.fabs(last)), ca.fabs(3 * chord - first - last))
    bend = elementwise_max(ca.fabs(6 * chord - 4 * first - 2 * last), ca.fabs(6 * chord - 2 * first - 4 * last))
    margin = ca.dot(levers, bend + speed * (2 * ca.cumsum(speed) - speed)) / 8
    distances = ca.SX.sym("d", len(own) + len(moved))
    bounds = distances - ca.vertcat(*own, *moved)
    inputs = [q, rates, later_q, later_rates, duration, levers, distances]
    return Kernel("bounds of distances", inputs, [bounds, margin, smallest(ca.vertcat(bounds, LARGE_NUMBER)) - margin])


def _interpolate(start: _Instant, end: _Instant) -> FloatArray:
    """Return the coefficients (R, 4, n) of the cubic polynomials between two instants, from the constant one on."""
    duration = (end.time - start.time)[:, None]
    chord, first, last = end.q - start.q, duration * start.rates, duration * end.rates
    return np.stack([start.q, first, 3 * chord - 2 * first - last, first + last - 2 * chord], axis=1)


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
