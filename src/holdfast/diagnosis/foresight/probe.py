"""Self-motions that tell which joint is locked: planned, and decided from the tool's measured pose alone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arm.poses import rotations_of_quaternions
from holdfast.arm.task import Task, as_task
from holdfast.caching import cached_property
from holdfast.clearance.clearance import Clearance
from holdfast.diagnosis.foresight.motions import resampled
from holdfast.diagnosis.foresight.separation import (
    LIKELY,
    differences,
    hypotheses,
    null_space,
    self_motion_rates,
    separations,
    task_rows,
    together,
    unseen,
    weights,
)
from holdfast.diagnosis.sensors import Sensors
from holdfast.errors import InputError
from holdfast.faults.log import Log
from holdfast.files.output import write_table
from holdfast.notice import says
from holdfast.paths.joint_table import joint_columns
from holdfast.result import Result

Array = NDArray[np.float64]

RATE = 100.0  # Hz, of the plan
BEFORE, AFTER, RAMP = 0.2, 0.3, 0.3  # s at rest, s of acceleration
_ROOM = 0.05  # rad or m from a limit
_DIRECTIONS, _LEGS = 24, 3
_INVISIBLE = 1e-6  # of a unit rate


@dataclass(frozen=True, eq=False, kw_only=True)
class Probe(Result):
    """A self-motion, with what it can tell. Joints count from 0; hypothesis 0 is that nothing is locked.

    Attributes:
        arm: The arm.
        task: What the tool keeps.
        suspects: Joints that may be locked.
        t: (T,) s.
        q: (T, n) references, rad and m.
        separation: (n + 1, n + 1) of hypotheses, nothing and each joint locked, in nats; above 9.2 they can be told apart.
        visible: (n,) the largest rate of each joint over self-motions of unit rate where it begins.
        sensors: How good the measured pose is.
        tool: m, how far the tool strays on the plan.
    """

    arm: Arm
    task: Task
    suspects: tuple[int, ...]
    t: Array
    q: Array
    separation: Array
    visible: Array
    sensors: Sensors
    tool: float

    @cached_property
    def untestable(self) -> tuple[str, ...]:
        """Suspects whose lock the tool's pose does not show on this motion."""
        return tuple(self.arm.joint_names[i] for i in unseen(self.separation, self.suspects))

    @cached_property
    def together(self) -> tuple[tuple[str, str], ...]:
        """Pairs of testable suspects that it does not tell apart."""
        names = self.arm.joint_names
        return tuple((names[i], names[j]) for i, j in together(self.separation, self.suspects))

    @property
    def told_apart(self) -> tuple[str, ...]:
        """Suspects that are told from health and from every other suspect."""
        pairs = {name for pair in self.together for name in pair}
        names = [self.arm.joint_names[i] for i in self.suspects]
        return tuple(name for name in names if name not in self.untestable and name not in pairs)

    def describe(self) -> list[str]:
        """What the motion can tell and what not, before anything moves."""
        names = self.arm.joint_names
        lines = [
            f"a self-motion of {self.t[-1]:.3g} s tells {len(self.told_apart)} of {len(self.suspects)} suspects apart"
            + (f": {', '.join(self.told_apart)}" if self.told_apart else "")
        ]
        for name in self.untestable:
            still = self.visible[names.index(name)] < _INVISIBLE
            never = ": no self-motion moves it here, and its lock is not tolerable here either" if still else ""
            lines.append(f"a lock of {name} cannot be tested{never}")
        lines += [f"locks of {a} and {b} cannot be told apart" for a, b in self.together]
        return [*lines, f"the tool stays within {1e3 * self.tool:.2g} mm of where it is while nothing is locked"]

    def to_csv(self, file: str | Path) -> Path:
        """Write the references: ``time_s`` and a column for each joint, as other motions are written.

        Raises:
            StoreError: It cannot be written.
        """
        return write_table(file, "probe", ["time_s", *joint_columns(self.arm)], np.column_stack([self.t, self.q]))

    def at(self, rate: float) -> Array:
        """References (K, n) at so many samples a second, in straight lines between those of the plan."""
        return resampled(self.q, RATE, rate)

    def decide(self, log: Log) -> Finding:
        """What a record of this motion shows; see :func:`holdfast.diagnosis.decide`."""
        return decide(self.arm, log, suspects=[self.arm.joint_names[i] for i in self.suspects], sensors=self.sensors)


@dataclass(frozen=True, eq=False, kw_only=True)
class Finding(Result):
    """What a record of a probe showed of locks.

    Attributes:
        joint: The locked one; None if it was not decided, or none of the suspects is.
        remaining: What explains the pose about as well as the best: joints, and "none" for no lock.
        cleared: Joints that are not locked: without a lock the pose is explained better by far.
        time: s, of the decision, or of the end of the record.
        displacement: m, of the measured tool then, from where it was at rest.
    """

    joint: str | None
    remaining: tuple[str, ...]
    cleared: tuple[str, ...]
    time: float
    displacement: float

    def describe(self) -> list[str]:
        """The locked joint, or what remains possible."""
        at = f"{self.time:.3g} s, with the tool {1e3 * self.displacement:.2g} mm from its rest"
        if self.joint is not None:
            return [f"{self.joint} is locked: decided after {at}"]
        if self.remaining == ("none",):
            return [f"none of the suspects is locked: decided after {at}"]
        lines = [f"not decided after {at}: what remains possible is {', '.join(self.remaining)}"]
        return lines + ([f"not locked: {', '.join(self.cleared)}"] if self.cleared else [])


@checked
@says("planning a self-motion")
def plan_probe(
    arm: Arm,
    q: ArrayLike,
    *,
    suspects: Sequence[str | int] | None = None,
    task: str | Task | Sequence[str] = "pose",
    duration: float = 5.0,
    speed: float = 0.25,
    sensors: Sensors | None = None,
    clearance: Clearance | None = None,
    margin: float = 0.0,
    seed: int = 0,
) -> Probe:
    """A self-motion that tells apart which joint is locked, from the tool's pose alone.

    With one degree of redundancy it goes one of the two ways, with more one of 24 random ones: that which tells most pairs of
    suspects apart. Where pairs remain it goes on from its end, three legs at most.

    Args:
        arm: The arm.
        q: (n,) where it is, rad and m.
        suspects: Joints, by name or number from 0; all if not given.
        task: What the tool keeps.
        duration: s of each leg, at most.
        speed: Norm of the joint rates, rad/s and m/s.
        sensors: How good the measured pose is.
        clearance: What is kept clear on the plan and under the lock of every suspect; None: not looked at.
        margin: m, with ``clearance``.
        seed: Of the random directions.

    Raises:
        InputError: An unknown joint, no redundancy, a time too short to move, or a configuration that is not clear.

    Source: derived here; the bound on what any motion can tell is Wald's.
    """
    rows, sensors = as_task(arm, task), sensors or Sensors()
    here = arm.check_configurations(q)
    if here.ndim != 1:
        raise InputError(f"q has shape {here.shape}; it must be one configuration")
    if arm.n <= rows.m:
        raise InputError(f"'{arm.name}' has no redundancy for task '{rows.name}', so it has no self-motions; keep fewer rows")
    if not duration > 2 * RAMP or not speed > 0:
        raise InputError(f"duration is {duration:g} s and speed {speed:g}; they must be above {2 * RAMP:g} and above 0")
    if clearance is not None and not clearance(here) > margin:
        raise InputError("the configuration is not clear of itself or of the cell by the margin; begin elsewhere")
    chosen = tuple(range(arm.n)) if suspects is None else tuple(arm.joint_index(s) for s in suspects)
    rng, motion, best = np.random.default_rng(seed), np.repeat(here[None], round(BEFORE * RATE), axis=0), (-1, 0.0)
    ids = [0, *(i + 1 for i in chosen)]
    pairs = len(ids) * (len(ids) - 1) // 2
    for _ in range(_LEGS):
        legs = [_timed(leg, speed) for leg in _traced(arm, rows, motion[-1], here, (duration - RAMP) * speed, speed, rng)]
        tried = [np.concatenate([motion, _clear(arm, motion, leg, chosen, clearance, margin)]) for leg in legs]
        scores = [_score(separations(arm, trial, sensors)[np.ix_(ids, ids)]) for trial in tried]
        top = max(range(len(tried)), key=lambda k: scores[k])
        if scores[top] <= best:
            break
        motion, best = tried[top], scores[top]
        if best[0] == pairs:
            break
    motion = np.concatenate([motion, np.repeat(motion[-1:], round(AFTER * RATE), axis=0)])
    poses = arm.forward_kinematics(motion)
    return Probe(
        arm=arm,
        task=rows,
        suspects=chosen,
        t=np.arange(len(motion)) / RATE,
        q=motion,
        separation=separations(arm, motion, sensors),
        visible=self_motion_rates(arm, here, rows),
        sensors=sensors,
        tool=float(np.linalg.norm(task_rows(arm, rows, motion, differences(poses, poses[0])[..., None])[..., 0], axis=1).max()),
    )


@checked
def decide(arm: Arm, log: Log, *, suspects: Sequence[str | int] | None = None, sensors: Sensors | None = None) -> Finding:
    """Which joint is locked, from the tool's measured pose on a motion alone; no joint sensor is looked at.

    Samples are taken in their order until one hypothesis leads all others by ``ln 10^4``. The mean over the rest before the
    motion is taken off.

    Args:
        arm: The arm.
        log: A record with the tool's pose that begins at rest, of a lock that was there from its beginning.
        suspects: Joints, by name or number from 0; all if not given.
        sensors: How good the measured pose is.

    Raises:
        InputError: Another number of joints, no pose, or no sample of it before the references move.

    Source: derived here, a sequential test of likelihood ratios (Wald).
    """
    if log.n != arm.n:
        raise InputError(f"the record has {log.n} joints and '{arm.name}' has {arm.n}; give the arm that was recorded")
    if log.x is None or log.quat is None:
        raise InputError("the record has no measured pose of the tool; record x and quat")
    chosen = tuple(range(arm.n)) if suspects is None else tuple(arm.joint_index(s) for s in suspects)
    there = np.flatnonzero(np.isfinite(log.x).all(axis=1) & np.isfinite(log.quat).all(axis=1))
    moved = np.abs(log.q_ref - log.q_ref[0]).max(axis=1) > 1e-9
    resting = there[there < (int(moved.argmax()) if moved.any() else len(moved))]
    if not resting.size:
        raise InputError("the tool's pose is not measured before the references move; begin the record at rest")
    measured = np.zeros((len(there), 4, 4))
    measured[:, :3, :3], measured[:, :3, 3] = rotations_of_quaternions(log.quat[there]), log.x[there]
    motion = np.concatenate([log.q_ref[:1], log.q_ref[there]])
    ids = [0, *(i + 1 for i in chosen)]
    error = differences(measured, hypotheses(arm, motion)[ids, 1:])
    error -= error[:, : len(resting)].mean(axis=1, keepdims=True)
    likely = -np.cumsum(((error * weights(sensors or Sensors())) ** 2).sum(axis=2), axis=1) / 2
    behind = np.sort(likely, axis=0)[-2]
    done = likely.max(axis=0) - behind > LIKELY
    row = int(done.argmax()) if done.any() else len(there) - 1
    final, names = likely[:, row], ["none", *(arm.joint_names[i] for i in chosen)]
    remaining = tuple(name for name, value in zip(names, final, strict=True) if final.max() - value <= LIKELY)
    return Finding(
        joint=remaining[0] if remaining[1:] == () and remaining[0] != "none" else None,
        remaining=remaining,
        cleared=tuple(name for name, value in zip(names[1:], final[1:], strict=True) if final[0] - value > LIKELY),
        time=float(log.t[there[row]]),
        displacement=float(np.linalg.norm(log.x[there[row]] - log.x[resting].mean(axis=0))),
    )


def _score(apart: Array) -> tuple[int, float]:
    """Pairs that are told apart, and how well."""
    upper = apart[np.triu_indices(len(apart), 1)]
    return int((upper > LIKELY).sum()), float(np.minimum(upper, 3 * LIKELY).sum())


def _traced(
    arm: Arm, task: Task, start: Array, home: Array, length: float, speed: float, rng: np.random.Generator
) -> list[Array]:
    """Curves (K, n) of the self-motion from ``start``, in steps of 1/100 s at ``speed``, as long as limits let them be."""
    step = speed / RATE
    _, null = null_space(arm, task, start[None])
    if null.shape[2] == 1:
        directions = np.array([null[0, :, 0], -null[0, :, 0]])
    else:
        directions = rng.normal(size=(_DIRECTIONS, null.shape[2])) @ null[0].T
    z = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    q, pose = np.repeat(start[None], len(z), axis=0), arm.forward_kinematics(home)
    curves, count, going = [q], np.ones(len(z), dtype=int), np.ones(len(z), dtype=bool)
    # Where it begins within the room of a limit it may leave that.
    low, high = np.minimum(arm.lower + _ROOM, start), np.maximum(arm.upper - _ROOM, start)
    for _ in range(int(length / step)):
        inverse, null = null_space(arm, task, q)
        z = np.einsum("bnk,bmk,bm->bn", null, null, z)
        size = np.linalg.norm(z, axis=1, keepdims=True)
        z = z / np.maximum(size, 1e-12)
        off = task_rows(arm, task, q, differences(np.broadcast_to(pose, (len(q), 4, 4)), arm.forward_kinematics(q))[..., None])
        new = q + step * z + 0.5 * (inverse @ off)[..., 0]
        going &= (size[:, 0] > 1e-6) & ((new >= low) & (new <= high)).all(axis=1)
        if not going.any():
            break
        q = np.where(going[:, None], new, q)
        curves.append(q)
        count += going
    whole = np.stack(curves, axis=1)
    return [whole[k, : count[k]] for k in range(len(z))]


def _timed(curve: Array, speed: float) -> Array:
    """A curve in steps of 1/100 s at ``speed`` as motion that speeds up and slows down within 0.3 s each."""
    length = (len(curve) - 1) * speed / RATE
    ramp = min(RAMP, length / speed)
    total = length / speed + ramp
    t = np.arange(1, int(np.ceil(total * RATE)) + 1) / RATE
    rise = np.minimum(t, ramp) ** 2 / (2 * max(ramp, 1e-9)) + np.maximum(t - ramp, 0.0)
    fall = np.maximum(t - (total - ramp), 0.0) ** 2 / (2 * max(ramp, 1e-9))
    s = np.clip((rise - fall) * speed, 0.0, length)
    along = np.arange(len(curve)) * speed / RATE
    return np.stack([np.interp(s, along, column) for column in curve.T], axis=1)


def _clear(arm: Arm, before: Array, leg: Array, suspects: tuple[int, ...], clearance: Clearance | None, margin: float) -> Array:
    """The part of a leg on which the arm is clear, whichever suspect is locked."""
    if clearance is None or not len(leg):
        return leg
    free = np.asarray(clearance(leg)) > margin
    for i in suspects:
        locked = leg.copy()
        locked[:, i] = before[0, i]
        free &= np.asarray(clearance(locked)) > margin
    return leg[: len(leg) if free.all() else int((~free).argmax())]
