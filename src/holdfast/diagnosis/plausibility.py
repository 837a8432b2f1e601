"""Checks that an arm can have recorded a log: units, signs, order of joints, and missing signals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.diagnosis.signals import signals_of
from holdfast.errors import InputError
from holdfast.faults.log import Log

Array = NDArray[np.float64]

_TURN = 2 * np.pi
_TURN_TOLERANCE_RAD = 0.5  # a leap within this distance of whole turns is a wrapped angle, no motion
_LEAST_TRAVEL = 0.05  # rad or m: a joint that is asked to move less shows no ratio
_KNOWN_RATIOS = {
    180 / np.pi: "q seems to be in degrees and q_ref in radians",
    np.pi / 180: "q_ref seems to be in degrees and q in radians",
    1000.0: "q seems to be in mm and q_ref in m",
    0.001: "q_ref seems to be in mm and q in m",
    -1.0: "the two have opposite signs",
}
_RATIO_TOLERANCE = 0.1
_RATIO_CORRELATION = 0.98
_FOLLOWING_CORRELATION = 0.9  # least correlation of a joint with its own reference
_CROSS_CORRELATION = 0.99  # correlation with another joint's reference that names a swapped order
_TORQUE_CORRELATION = 0.97
_LEAST_SCALE, _LARGEST_SCALE = 0.25, 4.0  # of a recorded torque to that of the model
_LEAST_LOAD = 0.15  # of the largest gravity torque of a joint: below, its torque may be mostly friction
_LEAST_GRAVITY_SHARE = 0.1  # of the largest gravity torque of all joints: a joint that carries less is not judged
_CONFIGURATIONS = 200  # at which gravity torques are computed
_CHECKED_S = 60.0  # of the logs: more change nothing
_UNEXPLAINED_FRACTION = 0.9  # of the squared torques: a model that leaves more of them explains none


def prepare_log(arm: Arm, log: Log) -> Log:
    """Return the log with whole angles, after checking that ``q`` and ``q_ref`` have one unit and sign.

    Angles that were cut off at a half turn are joined again: no joint turns by 360 degrees between two samples.

    Raises:
        InputError: A log of another arm, in other units, without a number of a joint, or with joints of opposite signs; the
            message names a joint.
    """
    log = _join_angles(arm, log) if log.n == arm.n else log
    log.require(arm)
    for what in ("q_ref", "q", "tau"):
        value = getattr(log, what)
        if value is not None and (empty := np.flatnonzero(~np.isfinite(value).any(axis=0))).size:
            advice = "; leave tau out if it was not recorded" if what == "tau" else ""
            raise InputError(f"{what} of '{arm.joint_names[empty[0]]}' has no number; give it for every joint{advice}")
    for name, wanted, measured in zip(arm.joint_names, log.q_ref.T, log.q.T, strict=True):
        ratio, correlation = _compare(wanted, measured)
        for known, advice in _KNOWN_RATIOS.items():
            if abs(ratio / known - 1) < _RATIO_TOLERANCE and abs(correlation) > _RATIO_CORRELATION:
                raise InputError(f"q of '{name}' moves {ratio:.3g} times as far as its q_ref; {advice}")
    return log


def require_following(arm: Arm, logs: Sequence[Log]) -> None:
    """Refuse logs of a healthy arm whose joints do not follow their references.

    Raises:
        InputError: A joint that follows none or another joint's reference, or a torque that is missing.
    """
    for log in logs:
        moving = [k for k in range(arm.n) if np.ptp(log.q_ref[np.isfinite(log.q_ref[:, k]), k]) > _LEAST_TRAVEL]
        for k in moving:
            name, measured = arm.joint_names[k], log.q[:, k]
            if _compare(log.q_ref[:, k], measured)[1] < _FOLLOWING_CORRELATION:
                others = [j for j in moving if j != k and _compare(log.q_ref[:, j], measured)[1] > _CROSS_CORRELATION]
                advice = (
                    f"it follows that of '{arm.joint_names[others[0]]}', so give the joints in the arm's order"
                    if others
                    else "give records of healthy motion"
                )
                raise InputError(f"q of '{name}' does not follow its q_ref; {advice}")
        if log.tau is not None and moving and not np.nan_to_num(np.nanmax(log.tau, axis=0) - np.nanmin(log.tau, axis=0)).any():
            raise InputError("tau never changes while joints move; leave tau out if it was not recorded")


def require_explained(arm: Arm, logs: Sequence[Log], *, coulomb: Array, viscous: Array) -> None:
    """Refuse torques of a healthy arm that its model does not explain: of another sign, unit or order.

    The observer's residual is the model's torque less the recorded one, and without torques the model's alone.

    Raises:
        InputError: The message names the joints and the probable cause.
    """
    parts: list[tuple[Array, Array]] = []
    checked = 0.0
    for log in logs:
        if log.tau is not None and checked < _CHECKED_S:
            found = [
                signals_of(arm, replace(log, tau=tau), coulomb=coulomb, viscous=viscous)
                for tau in (log.tau, np.where(np.isfinite(log.tau), 0.0, np.nan))
            ]
            parts.append((found[0].torque[found[0].seen], found[1].torque[found[1].seen]))
            checked += log.duration
    if not parts:
        return
    residual, model = (np.concatenate(each) for each in zip(*parts, strict=True))
    recorded = model - residual
    recorded_square, model_square, product = (recorded**2).sum(0), (model**2).sum(0), (recorded * model).sum(0)
    gravity = _largest_gravity_torques(arm)
    significant = (model_square > len(model) * (_LEAST_LOAD * gravity) ** 2) & (gravity > _LEAST_GRAVITY_SHARE * gravity.max())
    correlation = product / np.sqrt(np.maximum(recorded_square * model_square, np.finfo(np.float64).tiny))
    scale = product / np.maximum(model_square, np.finfo(np.float64).tiny)
    reversed_joints = significant & (correlation < -_TORQUE_CORRELATION)
    if reversed_joints.any():
        raise InputError(
            f"tau of {_names(arm, reversed_joints)} has the opposite sign of the torque that the arm's model needs; give the "
            "motors' torques on the joints, positive in the direction of the joint"
        )
    order = _best_order(recorded, model)
    if order is not None and significant.any():
        names = ", ".join(arm.joint_names[j] for j in order)
        raise InputError(
            f"the arm's model explains the recorded torques only in the order {names}; give those of its joints in order"
        )
    unlike = significant & (correlation > _TORQUE_CORRELATION) & ((scale > _LARGEST_SCALE) | (scale < _LEAST_SCALE))
    if unlike.any():
        k = int(np.flatnonzero(unlike)[0])
        raise InputError(
            f"tau of {_names(arm, unlike)} is {scale[k]:.3g} times the torque that the arm's model needs; give torques of the "
            "joints in N m and N, not currents, motor torques or mN m"
        )
    unexplained = (recorded_square + model_square - 2 * product)[significant].sum()
    if unexplained > _UNEXPLAINED_FRACTION * recorded_square[significant].sum() and significant.any():
        raise InputError(
            "the arm's model explains none of the recorded torques; check sign, unit and order of the joints, the mounting of "
            "the arm and its payload"
        )


def _largest_gravity_torques(arm: Arm) -> Array:
    """Return the largest gravity torque (n,) of each joint at random configurations, N m and N."""
    free = np.where(arm.prismatic, 1.0, np.pi)
    low, high = np.where(np.isfinite(arm.lower), arm.lower, -free), np.where(np.isfinite(arm.upper), arm.upper, free)
    q = np.random.default_rng(0).uniform(low, high, (_CONFIGURATIONS, arm.n))
    return np.asarray(np.abs(arm.gravity_torque(q)).max(axis=0))


def _names(arm: Arm, chosen: NDArray[np.bool_]) -> str:
    return ", ".join(f"'{name}'" for name, one in zip(arm.joint_names, chosen, strict=True) if one)


def _best_order(recorded: Array, model: Array) -> list[int] | None:
    """Return the joints to which the columns of recorded torques belong, if another order explains them."""
    from scipy.optimize import linear_sum_assignment

    cost = (recorded**2).sum(0)[:, None] + (model**2).sum(0) - 2 * recorded.T @ model
    rows, columns = linear_sum_assignment(cost)
    found: list[int] = columns.tolist()
    explained = cost[rows, columns].sum() < min(0.3 * (recorded**2).sum(), 0.1 * np.trace(cost))
    return found if explained and found != sorted(found) else None


def _compare(wanted: Array, measured: Array) -> tuple[float, float]:
    """Return the slope of measured over wanted values, and their correlation; zeros without motion."""
    there = np.isfinite(wanted) & np.isfinite(measured)
    if there.sum() < 2 or np.ptp(wanted[there]) <= _LEAST_TRAVEL or np.ptp(measured[there]) == 0:
        return 0.0, 0.0
    x, y = (values[there] - values[there].mean() for values in (wanted, measured))
    return float(x @ y / (x @ x)), float(x @ y / np.sqrt((x @ x) * (y @ y)))


def _join_angles(arm: Arm, log: Log) -> Log:
    """Return the log with angles that do not leap by whole turns, ``q_ref`` within the limits and ``q`` on its turn."""
    wanted, measured = log.q_ref.copy(), log.q.copy()
    for k in np.flatnonzero(~arm.prismatic).tolist():
        for column in (wanted[:, k], measured[:, k]):
            there = np.flatnonzero(np.isfinite(column))
            column[there] -= _TURN * np.cumsum(_whole_turns(np.diff(column[there], prepend=column[there[:1]])))
        wanted[:, k] += _TURN * _turns_to_limits(arm, k, wanted[:, k])
        both = np.flatnonzero(np.isfinite(wanted[:, k]) & np.isfinite(measured[:, k]))[:1]
        if both.size:
            measured[:, k] -= _TURN * _whole_turns(measured[both, k] - wanted[both, k])[0]
    same = np.array_equal(wanted, log.q_ref, equal_nan=True) and np.array_equal(measured, log.q, equal_nan=True)
    return log if same else replace(log, q_ref=wanted, q=measured)


def _turns_to_limits(arm: Arm, k: int, angles: Array) -> int:
    """Return the whole turns that bring angles within the limits of joint k; 0 if none does or they are there already."""
    low, high = np.fmin.reduce(angles), np.fmax.reduce(angles)
    return next((t for t in (0, 1, -1) if arm.lower[k] <= low + t * _TURN and high + t * _TURN <= arm.upper[k]), 0)


def _whole_turns(steps: Array) -> Array:
    """Return the whole turns in steps of an angle, 0 where a step is not near whole turns."""
    turns = np.rint(steps / _TURN)
    return np.where(np.abs(steps - _TURN * turns) < _TURN_TOLERANCE_RAD, turns, 0.0)
