"""Start of the page's story: a configuration with much to gain, and random motions with an undetected lock."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.laws.law import Law, by_name
from holdfast.control.simulation.batch import compiled_simulator
from holdfast.control.simulation.runs import RunSettings
from holdfast.core.errors import InputError
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kinematics.indices import index
from holdfast.kinematics.solvers.curve_tracing import Component
from holdfast.kinematics.solvers.inverse_kinematics import solver
from holdfast.kinematics.solvers.self_motions import fibres, make_tracer
from holdfast.model.arm.model import Arm
from holdfast.model.arm.postures import generic_configuration
from holdfast.model.arm.task import Task, as_task, default_path_task
from holdfast.model.collision.clearance import Clearance

_RANDOM_SEED = 20261130
_POSE_COUNT = 40
_MAX_OFFSET_RAD = 0.7  # of the joints of a candidate from home, rad
_MIN_LENGTH_RAD = 1.5  # of a self-motion that is long enough to slide along
_START_FRACTION = 0.25  # of the best worst case, which the start has at most
_SPACING_RAD = 0.05
_STRUCTURAL_ZERO = 1e-6  # worst case below which no configuration of a self-motion helps
_GAIN_PER_S = 2.0
_SPEED_M_S = 0.25
_STEP_S = 0.02  # between the samples of a motion, as in closed_loop.ts
_DURATION_S = 12.0
_REACH_TOLERANCE = 1e-8  # of a tool pose, rad, and in units of the arm's length
_END_M = 0.001  # distance from the target at which a motion ends
_MOTION_COUNT = 400
_MAX_TARGET_OFFSET_RAD = 50.0  # beyond which any target is taken, because the arm hardly moves
_MIN_ARRIVED_FRACTION = 0.5  # of the motions, for an example that arrives
_MIN_WAY_FRACTION = 0.15  # of the arm's length, from the start of a motion to its target


@dataclass(frozen=True)
class StoryLaw:
    """A control law of the story: its label, and its name in a sentence."""

    slug: str
    name: str


@dataclass(frozen=True)
class Story:
    """Motions of a tool after an undetected lock of the worst joint, as in ``page/src/arm_page/data.ts``.

    Attributes:
        start: (n,) configuration at the start, rad and m.
        target: (3,) target position of the example, m.
        laws: The two control laws.
        gain: Proportional gain, 1/s.
        speed: Maximum speed of the tool, m/s.
        motions: Number of random motions; 0 if the target was given.
        deviations: Median of the largest distance from the straight line, m: law 1, law 2, and law 1 from the best
            configuration of the self-motion.
    """

    start: list[float]
    target: list[float]
    laws: tuple[StoryLaw, StoryLaw]
    gain: float
    speed: float
    motions: int
    deviations: tuple[float, float, float]


def measure_fractions(arm: Arm, task: Task, q: FloatArray) -> FloatArray:
    """Return the relative manipulability (N, n) of each joint at configurations (N, n); 0 without redundancy."""
    if arm.n <= task.m:
        return np.zeros(q.shape)
    measure = index.by_name("relative-manipulability", arm, task=task)
    return np.asarray(measure.evaluate(q).by_failure)


def choose_start(arm: Arm, task: Task) -> FloatArray:
    """Choose a configuration (n,) that another configuration of the same tool pose improves much.

    The candidates lie on self-motions of poses near home, with the orientation of home. Of the self-motions that are at least
    1.5 rad long, the one with the largest best worst case is chosen, and on it a configuration with at most a quarter of that.
    The arm does not touch itself on the way from there to the best. The result is the same for the same arm. An arm without
    such a self-motion, or with more than one redundant joint, gets its generic configuration.
    """
    generic = generic_configuration(arm)
    home = arm.states.get("home", generic)
    if arm.n != task.m + 1:
        return generic
    generator = np.random.default_rng(_RANDOM_SEED)
    near = np.clip(home + generator.uniform(-_MAX_OFFSET_RAD, _MAX_OFFSET_RAD, (_POSE_COUNT, arm.n)), arm.lower, arm.upper)
    poses = arm.forward_kinematics(near)
    poses[:, :3, :3] = arm.forward_kinematics(home[None])[0, :3, :3]
    motions = fibres(arm, poses, task, spacing=_SPACING_RAD, starts=4, seed=_RANDOM_SEED)
    curves = [curve for motion in motions for curve in motion.components if curve.length >= _MIN_LENGTH_RAD]
    if not curves:
        return generic
    points, splits = np.vstack([curve.q for curve in curves]), np.cumsum([len(curve.q) for curve in curves])[:-1]
    clearance = Clearance.by_default(arm)
    touches = np.zeros(len(points), dtype=bool) if clearance is None else clearance(points) <= 0
    worst_cases = measure_fractions(arm, task, points).min(axis=1)
    best, start = _STRUCTURAL_ZERO, generic
    for q, worst, is_touching in zip(*(np.split(rows, splits) for rows in (points, worst_cases, touches)), strict=True):
        peak, touching = int(worst.argmax()), np.r_[0, is_touching.cumsum()]
        low = np.flatnonzero(worst <= _START_FRACTION * worst[peak])
        low = low[touching[np.maximum(low, peak) + 1] == touching[np.minimum(low, peak)]]
        if low.size and worst[peak] > best:
            best, start = float(worst[peak]), q[low[np.argmin(abs(low - peak))]]
    return np.asarray(np.round(start, 6))


def simulate_story(
    arm: Arm, task: Task, start: FloatArray, prepared: FloatArray, laws: Sequence[str], target: ArrayLike | None = None
) -> Story | None:
    """Simulate 400 random motions with an undetected lock of the worst joint, or only the one to a given ``target``.

    The targets are positions of random configurations near the start. The example is the motion whose deviations are closest
    to the three medians, of those that arrive if these are at least half. Where the arm has too few joints for a position
    task, there is no story.

    Args:
        arm: Arm to simulate.
        task: Task of the page, which decides the worst joint.
        start: (n,) configuration at the start, rad and m.
        prepared: (n,) better configuration with the same tool pose.
        laws: Labels of the two control laws.
        target: (3,) target position, m; None: choose one.

    Raises:
        InputError: The target is not a position.
    """
    path_task = as_task(arm, default_path_task(arm, oriented=False))
    if arm.n <= path_task.m:
        return None
    if target is None:
        targets = _draw_targets(arm, start)
    else:
        targets = np.asarray(target, dtype=np.float64)
        if targets.shape not in ((3,), (4, 4)):
            raise InputError(f"target has shape {targets.shape}; give a position (3,) or a pose (4, 4)")
        targets = targets[None] if targets.shape == (3,) else targets[None, :3, 3]
    worst = int(np.argmin(measure_fractions(arm, task, start[None])[0]))
    control_laws = [by_name(label, arm, task=path_task, gain=_GAIN_PER_S, speed_limit=_SPEED_M_S) for label in laws]
    runs = [
        simulate_deviations(law, q, targets, worst)
        for law, q in ((control_laws[0], start), (control_laws[1], start), (control_laws[0], prepared))
    ]
    deviations, have_arrived = (np.stack(arrays) for arrays in zip(*runs, strict=True))
    medians = np.median(deviations, axis=1)
    distances = abs(deviations / np.maximum(medians, 1e-9)[:, None] - 1).sum(axis=0)
    is_suitable = have_arrived.all(axis=0)
    is_suitable |= np.mean(is_suitable) < _MIN_ARRIVED_FRACTION
    example = int(np.argmin(np.where(is_suitable, distances, np.inf)))
    choices = [StoryLaw(label, law.name) for label, law in zip(laws, control_laws, strict=True)]
    return Story(
        start=start.tolist(),
        target=np.round(targets[example], 6).tolist(),
        laws=(choices[0], choices[1]),
        gain=_GAIN_PER_S,
        speed=_SPEED_M_S,
        motions=len(targets) if target is None else 0,
        deviations=(float(medians[0]), float(medians[1]), float(medians[2])),
    )


def _draw_targets(arm: Arm, start: FloatArray) -> FloatArray:
    """Draw positions (400, 3) of random configurations near the start that are far enough away, m."""
    generator = np.random.default_rng(_RANDOM_SEED)
    origin = arm.forward_kinematics(start[None])[0, :3, 3]
    targets = np.zeros((0, 3))
    offset = _MAX_OFFSET_RAD
    while len(targets) < _MOTION_COUNT:
        q = np.clip(start + generator.uniform(-offset, offset, (4 * _MOTION_COUNT, arm.n)), arm.lower, arm.upper)
        positions = arm.forward_kinematics(q)[:, :3, 3]
        is_far = np.linalg.norm(positions - origin, axis=1) >= _MIN_WAY_FRACTION * arm.length_unit
        is_far |= offset > _MAX_TARGET_OFFSET_RAD
        targets, offset = np.vstack([targets, positions[is_far]]), 1.5 * offset
    return targets[:_MOTION_COUNT]


def simulate_deviations(law: Law, start: FloatArray, targets: FloatArray, locked: int) -> tuple[FloatArray, BoolArray]:
    """Return the largest distance (N,) of the tool from the straight line to each target (N, 3), m, with a joint locked.

    The controller has no information about the lock. A motion lasts until 1 mm from the target, at most 12 s. The second array
    (N,) is True where the motion ended within 1 mm.
    """
    arm, shape = law.arm, (len(targets), law.arm.n)
    lock_times = np.where(np.arange(arm.n) == locked, 0.0, np.inf)
    settings = RunSettings(_DURATION_S, _END_M, _STEP_S)
    simulator, components = compiled_simulator(law, "rk4"), targets @ law.task.rows[:, :3].T
    q = simulator.trace_steps(np.tile(start, (len(targets), 1)), components, np.broadcast_to(lock_times, shape), settings)
    errors = targets - arm.forward_kinematics(q.reshape(-1, arm.n))[:, :3, 3].reshape(*q.shape[:2], 3)
    is_near = np.linalg.norm(errors, axis=2) <= _END_M
    is_moving, lines = is_near.cumsum(axis=0) == is_near, errors[0]
    fractions = np.clip((errors * lines).sum(axis=2) / (lines**2).sum(axis=1), 0, 1)
    distances = np.linalg.norm(errors - fractions[..., None] * lines, axis=2)
    return np.asarray((distances * is_moving).max(axis=0)), np.asarray(is_near.any(axis=0))


def find_prepared(arm: Arm, task: Task, start: FloatArray) -> FloatArray:
    """Return the configuration (n,) with the tool pose of ``start`` that has the largest worst case of those nearby."""
    pose = arm.forward_kinematics(start[None])
    if arm.n <= task.m:
        return start
    if arm.n == task.m + 1:
        curves: list[list[Component]] = [[]]
        make_tracer(arm, task).trace_curves(pose, np.array([0]), start[None], _SPACING_RAD, curves)
        q = np.vstack([start, *(curve.q for curve in curves[0])])
    else:
        generator = np.random.default_rng(_RANDOM_SEED)
        starts = np.clip(start + generator.normal(0, 0.3, (64, arm.n)), arm.lower, arm.upper)
        poses, seeds = np.repeat(pose, len(starts), axis=0), np.random.SeedSequence(_RANDOM_SEED)
        found = solver(arm, task).solve(poses, seeds, 1, _REACH_TOLERANCE, first=starts)
        q = np.vstack([start, found.q[found.success]])
    return np.asarray(q[int(np.argmax(measure_fractions(arm, task, q).min(axis=1)))])
