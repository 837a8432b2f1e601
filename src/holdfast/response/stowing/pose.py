"""Search for a configuration that holds without power."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.falls.fall import PowerLoss
from holdfast.control.falls.physical import PhysicalFall
from holdfast.control.falls.power_cut import power_loss
from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress, track
from holdfast.core.result import Result
from holdfast.core.status import Status
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.holding.static_check import HoldCheck, holds
from holdfast.kinematics.regions.region import Region
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.friction import Friction, JointNumbers, joint_numbers
from holdfast.model.arm.model import Arm
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance
from holdfast.response.recovery.space import JointMetric

STOP_PROBABILITY = 0.2  # of a sampled joint at its lower limit, and at its upper limit
RESTING_SAMPLES = 4000  # random configurations whose falls are simulated if none holds
RESTING_RUNS = 20  # of these, with the smallest drops, that are simulated in MuJoCo
RESTING_STEP_S = 2e-3
_CLIMBED_CANDIDATES = 200
_CLIMB_ROUNDS = 25
_CLIMB_TRIALS = 8  # per candidate and round
_CLIMB_FRACTION = 0.2  # of the joint range: first standard deviation of a trial
_CLIMB_SHRINKAGE = 0.8  # of the standard deviation, per round


@dataclass(frozen=True, kw_only=True)
class StowPose(Result):
    """Configuration in which an arm stays when it loses its power, or the one with the smallest drop found.

    Attributes:
        arm: The arm.
        q: (n,) configuration, rad and m.
        check: Static check of ``q`` with its margin and joint.
        factor: Requested ratio of friction to the torque that it must hold.
        at: (n,) configuration from which the arm comes, rad and m; None if it was not given.
        duration: Time of the straight motion from ``at`` at the speed limits, s; None without ``at``.
        fall: Fall from ``q``, until the first contact if contacts are checked. If no configuration holds, its drop is that of
            any point.
        resting: Fall from ``q`` in MuJoCo, after which the arm lies still. This is one simulation, not a proof. None if a
            configuration holds, without objects or MuJoCo, or if the arm moves on after every simulated fall.
        found: Number of the best 200 candidates, all free of collisions, that hold with the factor.
        samples: Number of configurations that were sampled.
        friction: Friction as requested; None as the arm states.
        clearance: Collision model; None if collisions are not checked.
        margin: Smallest clearance, m.
        speeds: (n,) speed limits, rad/s and m/s; None without ``at``.
    """

    arm: Arm
    q: FloatArray
    check: HoldCheck
    factor: float
    at: FloatArray | None
    duration: float | None
    fall: PowerLoss
    resting: PhysicalFall | None
    found: int
    samples: int
    seed: int
    friction: Friction | None
    clearance: Clearance | None
    margin: float
    speeds: FloatArray | None

    @property
    def holds(self) -> bool:
        """True if friction and stops hold the arm in ``q`` with the requested factor."""
        return bool(self.check.factor >= self.factor)


@check_arguments
@reports_progress("searching a configuration that holds")
def stow(
    arm: Arm,
    at: ArrayLike | None = None,
    *,
    friction: Friction | None = None,
    factor: float = 1.5,
    where: Region | None = None,
    cell: CellLike | None = None,
    clearance: Clearance | bool | None = None,
    margin: float = 0.0,
    speeds: JointNumbers | None = None,
    samples: int = 200_000,
    seed: int = 1,
) -> StowPose:
    """Find a configuration in which the arm stays when it loses its power, because friction and stops hold it.

    The search samples configurations with joints at their limits, where stops carry them, and improves the best of them. With
    ``at`` it returns the configuration found that the arm reaches soonest on a straight line in joint space, otherwise the one
    with the largest surplus of friction in its weakest joint, N m.

    If no configuration holds, it returns the one in which any point drops least until the first contact. With objects and with
    ``holdfast-arms[physics]``, 20 such falls are also simulated in MuJoCo with contacts. Of those after which the arm lies
    still, the one with the smallest drop is returned.

    Args:
        arm: The arm, with inertial data for every link.
        at: (n,) present configuration, rad and m.
        friction: Friction of the joints. Default: as the arm states.
        factor: Required ratio of the friction of each joint to the torque that it must hold.
        where: Region of joint values that contains the configuration. Default: the joint limits.
        cell: Objects that the arm must not touch, or their file.
        clearance: Collision model. Default: that of :meth:`holdfast.Clearance.by_default`; False: the arm is not checked
            against itself.
        margin: Smallest clearance, m.
        speeds: Speed limits, rad/s and m/s, one number or n. Default: those of the arm.
        samples: Number of sampled configurations.
        seed: Seed of the search; the same seed gives the same result.

    Raises:
        InputError: A number is wrong, the arm has neither friction nor limits, it states no speed limit, or no sampled
            configuration is free of collisions.
        ArmError: Inertial data are missing or impossible.
    """
    if not factor >= 1:
        raise InputError(f"factor is {factor:g}; it must be 1 or more")
    if samples < 1:
        raise InputError(f"samples is {samples}; it must be 1 or more")
    if not (np.isfinite(margin) and margin >= 0):
        raise InputError(f"margin is {margin:g} m; it must be a finite number of 0 or more")
    if where is not None and where.kind != "joints":
        raise InputError(f"region '{where.name}' contains poses; give a region of joint values (Region.joints)")
    joint_friction = (friction or Friction()).of_joints(arm)
    if not joint_friction.stiction.any() and not joint_friction.load.any() and not np.isfinite([arm.lower, arm.upper]).any():
        raise InputError(f"nothing holds '{arm.name}' but its motors, because it has neither dry friction nor joint limits")
    start, limits = _read_start(arm, at, speeds)
    metric = None if limits is None else JointMetric("time", 1 / limits)
    model = chosen_clearance(arm, clearance, cell)
    lower, upper = sampling_limits(arm)
    if where is not None:
        middle, size = np.array(where.center), np.array(where.size)
        lower, upper = np.maximum(lower, middle - size / 2), np.minimum(upper, middle + size / 2)
    rng = np.random.default_rng(seed)

    def measure_excess(q: FloatArray) -> FloatArray:
        """Return the smallest surplus (N,) of friction over the required torque, N m; 0 or more if the arm holds.

        With a start, a surplus above 0 counts as 0, because then only the time to the configuration matters.
        """
        check = holds(arm, q, friction=friction)
        excess = np.asarray((check.available / factor - check.need).min(axis=1))
        return excess if start is None else np.minimum(excess, 0.0)

    def is_clear(q: FloatArray) -> BoolArray:
        return np.ones(len(q), dtype=bool) if model is None else np.asarray(model.margin_left(q) > margin)

    q = sample_with_stops(rng, samples, lower, upper)
    if start is not None and ((start >= lower) & (start <= upper)).all():
        q = np.vstack([start, q])
    excess = measure_excess(q)
    arrival = np.zeros(len(q)) if start is None or metric is None else metric.measure_length(q - start)
    order = np.lexsort((-excess, np.where(excess >= 0, arrival, np.inf)))
    clear = _first_clear(q, order, is_clear)
    if not clear.size:
        raise InputError(f"none of the best of {samples:,} configurations of '{arm.name}' is free of collisions")
    candidates, excess = _climb(q[clear], excess[clear], measure_excess, is_clear, rng, lower, upper)
    held = candidates[excess >= 0]
    resting: PhysicalFall | None = None
    count = int((excess >= 0).sum())
    if count and start is not None and metric is not None:

        def score(rows: FloatArray) -> FloatArray:
            return np.where(measure_excess(rows) >= 0, -metric.measure_length(rows - start), -np.inf)

        held, scores = _climb(held, score(held), score, is_clear, rng, lower, upper)
        chosen = held[np.argmax(scores)]
    elif count:
        chosen = candidates[np.argmax(excess)]
    else:
        further = q[:RESTING_SAMPLES]
        chosen, resting = _find_resting(arm, np.vstack([candidates, further[is_clear(further)]]), friction, model)
    return StowPose(
        arm=arm,
        q=chosen,
        check=holds(arm, chosen, friction=friction),
        factor=float(factor),
        at=start,
        duration=None if start is None or metric is None else float(metric.measure_length(chosen - start)),
        fall=power_loss(arm, chosen, friction=friction, clearance=model, of="tool" if count else "any point"),
        resting=resting,
        found=count,
        samples=samples,
        seed=seed,
        friction=friction,
        clearance=model,
        margin=float(margin),
        speeds=limits,
    )


def _find_resting(
    arm: Arm, q: FloatArray, friction: Friction | None, clearance: Clearance | None
) -> tuple[FloatArray, PhysicalFall | None]:
    """Return the configuration of q (N, n) in which the arm drops least, and its fall in MuJoCo if the arm lies still then."""
    falls = power_loss(arm, q, friction=friction, clearance=clearance, step=4e-3, of="any point")
    order = np.argsort(np.where(falls.status == Status.OK, falls.drop, np.inf))
    resting: list[PhysicalFall] = []
    if clearance is not None and clearance.cell is not None and find_spec("mujoco") is not None:
        for row in track("falls in MuJoCo", order[:RESTING_RUNS].tolist()):
            with suppress(InputError):  # the meshes overlap, or the simulation is unstable
                run = falls.physical(row, step=RESTING_STEP_S)
                resting += [run] if run.outcome == "rest" else []
    best = min(resting, key=lambda run: run.drop, default=None)
    return (q[order[0]], None) if best is None else (best.q[0], best)


def sample_with_stops(rng: np.random.Generator, count: int, lower: FloatArray, upper: FloatArray) -> FloatArray:
    """Return random configurations (count, n) of a box, in which each joint is often at one of its ends."""
    q, side = rng.uniform(lower, upper, (count, len(lower))), rng.uniform(size=(count, len(lower)))
    return np.asarray(np.where(side < STOP_PROBABILITY, lower, np.where(side > 1 - STOP_PROBABILITY, upper, q)))


def _read_start(arm: Arm, at: ArrayLike | None, speeds: JointNumbers | None) -> tuple[FloatArray | None, FloatArray | None]:
    """Return the start configuration and the speed limits (n,); None without a start."""
    if at is None:
        return None, None
    start = arm.check_configurations(at)
    if start.ndim != 1 or not ((start >= arm.lower) & (start <= arm.upper)).all():
        raise InputError(f"at is {np.asarray(at).tolist()}; give one configuration of {arm.n} numbers within the limits")
    limits = np.array([joint.velocity for joint in arm.joints]) if speeds is None else joint_numbers(arm, speeds, "speed")
    for name, limit in zip(arm.joint_names, limits, strict=True):
        if not (np.isfinite(limit) and limit > 0):
            raise InputError(f"joint '{name}' has no speed limit above 0; give the speeds in rad/s and m/s")
    return start, limits


def _first_clear(q: FloatArray, order: Any, is_clear: Callable[[FloatArray], BoolArray]) -> Any:
    """Return the first indices, in this order, of configurations without a collision."""
    chosen: list[Any] = []
    for first in range(0, min(len(order), 50 * _CLIMBED_CANDIDATES), _CLIMBED_CANDIDATES):
        indices = order[first : first + _CLIMBED_CANDIDATES]
        chosen.append(indices[is_clear(q[indices])])
        if sum(map(len, chosen)) >= _CLIMBED_CANDIDATES:
            break
    return np.concatenate(chosen)[:_CLIMBED_CANDIDATES]


def _climb(
    q: FloatArray,
    values: FloatArray,
    score: Callable[[FloatArray], FloatArray],
    is_clear: Callable[[FloatArray], BoolArray],
    rng: np.random.Generator,
    lower: FloatArray,
    upper: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Improve the score of configurations (N, n) by random steps of shrinking size, in which joints at an end stay there."""
    q, values = q.copy(), values.copy()
    at_stop = (q == lower) | (q == upper)
    for number in track("rounds of the search", range(_CLIMB_ROUNDS)):
        sigma = _CLIMB_FRACTION * _CLIMB_SHRINKAGE**number * (upper - lower)
        moves = rng.normal(size=(len(q), _CLIMB_TRIALS, q.shape[1])) * sigma
        moves *= rng.uniform(size=moves.shape) < 0.5
        trials = np.where(at_stop[:, None], q[:, None], np.clip(q[:, None] + moves, lower, upper))
        scores = score(trials.reshape(-1, q.shape[1])).reshape(len(q), -1)
        best = scores.argmax(axis=1)
        rows = np.arange(len(q))
        better = rows[scores[rows, best] > values]
        better = better[is_clear(trials[better, best[better]])]
        q[better], values[better] = trials[better, best[better]], scores[better, best[better]]
    return q, values
