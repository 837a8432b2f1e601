"""Check that an arm can have recorded a log: units, signs, order of joints, and missing signals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.response.diagnosis.signals import compute_signals
from holdfast.response.faults.log import Log

_FULL_TURN_RAD = 2 * np.pi
_TURN_TOLERANCE_RAD = 0.5  # a jump within this distance of full turns is a wrapped angle, no motion
_MIN_TRAVEL = 0.05  # rad or m: a joint whose reference moves less gives no ratio
_KNOWN_RATIOS = {
    180 / np.pi: "q seems to be in degrees and q_ref in radians",
    np.pi / 180: "q_ref seems to be in degrees and q in radians",
    1000.0: "q seems to be in mm and q_ref in m",
    0.001: "q_ref seems to be in mm and q in m",
    -1.0: "the two have opposite signs",
}
_RATIO_TOLERANCE = 0.1
_RATIO_CORRELATION = 0.98
_FOLLOWING_CORRELATION = 0.9  # smallest correlation of a joint with its own reference
_SWAPPED_JOINT_CORRELATION = 0.99  # correlation with another joint's reference that indicates a swapped order
_TORQUE_CORRELATION = 0.97
_MIN_TORQUE_SCALE = 0.25  # of a recorded torque to that of the model
_MAX_TORQUE_SCALE = 4.0
_MIN_LOAD_FRACTION = 0.15  # of the largest gravity torque of a joint: below, its torque may be mostly friction
_MIN_GRAVITY_FRACTION = 0.1  # of the largest gravity torque of all joints: a joint that carries less is not checked
_CONFIGURATION_COUNT = 200  # configurations at which gravity torques are computed
_CHECKED_S = 60.0  # duration of the logs, s, that is checked; more does not change the result
_UNEXPLAINED_FRACTION = 0.9  # of the squared torques: a model that leaves more than this explains none


def prepare_log(arm: Arm, log: Log) -> Log:
    """Return the log with unwrapped angles, after checking that ``q`` and ``q_ref`` have one unit and sign.

    Angles that were wrapped at a half turn are joined, because no joint turns by 360 degrees between two samples.

    Raises:
        InputError: The log is of another arm, has other units, lacks all values of a joint, or has joints of opposite signs;
            the message names a joint.
    """
    log = _unwrap_angles(arm, log) if log.n == arm.n else log
    log.require(arm)
    for signal in ("q_ref", "q", "tau"):
        value = getattr(log, signal)
        if value is not None and (empty := np.flatnonzero(~np.isfinite(value).any(axis=0))).size:
            advice = "; leave tau out if it was not recorded" if signal == "tau" else ""
            raise InputError(f"{signal} of '{arm.joint_names[empty[0]]}' has no number; give it for every joint{advice}")
    for name, reference, measured in zip(arm.joint_names, log.q_ref.T, log.q.T, strict=True):
        ratio, correlation = _fit_slope_and_correlation(reference, measured)
        for known_ratio, advice in _KNOWN_RATIOS.items():
            if abs(ratio / known_ratio - 1) < _RATIO_TOLERANCE and abs(correlation) > _RATIO_CORRELATION:
                raise InputError(f"q of '{name}' moves {ratio:.3g} times as far as its q_ref; {advice}")
    return log


def require_reference_tracking(arm: Arm, logs: Sequence[Log]) -> None:
    """Raise an error if joints of a healthy arm do not follow their references.

    Raises:
        InputError: A joint follows no reference or that of another joint, or torques are missing.
    """
    for log in logs:
        moving = [joint for joint in range(arm.n) if np.ptp(log.q_ref[np.isfinite(log.q_ref[:, joint]), joint]) > _MIN_TRAVEL]
        for joint in moving:
            name, measured = arm.joint_names[joint], log.q[:, joint]
            if _fit_slope_and_correlation(log.q_ref[:, joint], measured)[1] < _FOLLOWING_CORRELATION:
                advice = "give records of healthy motion"
                for other in moving[::-1]:
                    correlation = _fit_slope_and_correlation(log.q_ref[:, other], measured)[1]
                    if other != joint and correlation > _SWAPPED_JOINT_CORRELATION:
                        advice = f"it follows that of '{arm.joint_names[other]}', so give the joints in the arm's order"
                raise InputError(f"q of '{name}' does not follow its q_ref; {advice}")
        if log.tau is not None and moving and not np.nan_to_num(np.nanmax(log.tau, axis=0) - np.nanmin(log.tau, axis=0)).any():
            raise InputError("tau never changes while joints move; leave tau out if it was not recorded")


def require_explained_torques(arm: Arm, logs: Sequence[Log], *, coulomb: FloatArray, viscous: FloatArray) -> None:
    """Raise an error if the model of a healthy arm does not explain its torques: another sign, unit, or order.

        The residual of the observer is the model's torque minus the recorded one; without torques, the model's torque.

    Raises:
        InputError: The model does not explain the torques; the message names the joints and the probable cause.
    """
    torque_pairs: list[list[FloatArray]] = []
    checked_s, signals_of = 0.0, partial(compute_signals, arm, coulomb=coulomb, viscous=viscous)
    for log in logs:
        if log.tau is not None and checked_s < _CHECKED_S:
            torques = log.tau, np.where(np.isfinite(log.tau), 0.0, np.nan)
            signal_pair = [signals_of(replace(log, tau=tau)) for tau in torques]
            torque_pairs.append([signals.torque[signals.seen] for signals in signal_pair])
            checked_s += log.duration
    if not torque_pairs:
        return
    residual, model = (np.concatenate(arrays) for arrays in zip(*torque_pairs, strict=True))
    recorded = model - residual
    recorded_square, model_square, product = (recorded**2).sum(0), (model**2).sum(0), (recorded * model).sum(0)
    gravity = _largest_gravity_torques(arm)
    significant = gravity > _MIN_GRAVITY_FRACTION * gravity.max()
    significant &= model_square > len(model) * (_MIN_LOAD_FRACTION * gravity) ** 2
    correlation = product / np.sqrt(np.maximum(recorded_square * model_square, np.finfo(np.float64).tiny))
    scale = product / np.maximum(model_square, np.finfo(np.float64).tiny)
    reversed_joints = significant & (correlation < -_TORQUE_CORRELATION)
    if reversed_joints.any():
        raise InputError(
            f"tau of {_quote_names(arm, reversed_joints)} has the opposite sign of the torque that the arm's model needs; give "
            "the motors' torques on the joints, positive in the direction of the joint"
        )
    order = _find_torque_column_order(recorded, model)
    if order is not None and significant.any():
        names = ", ".join(arm.joint_names[joint] for joint in order)
        raise InputError(
            f"the arm's model explains the recorded torques only in the order {names}; give those of its joints in order"
        )
    is_unlike = significant & (correlation > _TORQUE_CORRELATION) & ((scale > _MAX_TORQUE_SCALE) | (scale < _MIN_TORQUE_SCALE))
    if is_unlike.any():
        first_unlike = int(np.flatnonzero(is_unlike)[0])
        raise InputError(
            f"tau of {_quote_names(arm, is_unlike)} is {scale[first_unlike]:.3g} times the torque that the arm's model needs; "
            "give torques of the joints in N m and N, not currents, motor torques or mN m"
        )
    unexplained = (recorded_square + model_square - 2 * product)[significant].sum()
    if unexplained > _UNEXPLAINED_FRACTION * recorded_square[significant].sum() and significant.any():
        raise InputError(
            "the arm's model explains none of the recorded torques; check sign, unit and order of the joints, the mounting of "
            "the arm and its payload"
        )


def _largest_gravity_torques(arm: Arm) -> FloatArray:
    """Return the largest gravity torque (n,) of each joint at random configurations, N m and N."""
    q = np.random.default_rng(0).uniform(*sampling_limits(arm), (_CONFIGURATION_COUNT, arm.n))
    return np.asarray(np.abs(arm.gravity_torque(q)).max(axis=0))


def _quote_names(arm: Arm, chosen: NDArray[np.bool_]) -> str:
    return ", ".join(f"'{arm.joint_names[joint]}'" for joint in np.flatnonzero(chosen))


def _find_torque_column_order(recorded: FloatArray, model: FloatArray) -> list[int] | None:
    """Return the joints to which the columns of recorded torques belong, if another order explains them."""
    from scipy.optimize import linear_sum_assignment

    cost = (recorded**2).sum(0)[:, None] + (model**2).sum(0) - 2 * recorded.T @ model
    row_indices, columns = linear_sum_assignment(cost)
    order: list[int] = columns.tolist()
    explained = cost[row_indices, columns].sum() < min(0.3 * (recorded**2).sum(), 0.1 * np.trace(cost))
    return order if explained and order != sorted(order) else None


def _fit_slope_and_correlation(reference: FloatArray, measured: FloatArray) -> tuple[float, float]:
    """Return the slope of measured over reference values, and their correlation; zeros without motion."""
    is_measured = np.isfinite(reference) & np.isfinite(measured)
    if is_measured.sum() < 2 or np.ptp(reference[is_measured]) <= _MIN_TRAVEL or np.ptp(measured[is_measured]) == 0:
        return 0.0, 0.0
    x, y = (values[is_measured] - values[is_measured].mean() for values in (reference, measured))
    return float(x @ y / (x @ x)), float(x @ y / np.sqrt((x @ x) * (y @ y)))


def _unwrap_angles(arm: Arm, log: Log) -> Log:
    """Return the log with unwrapped angles, ``q_ref`` within the limits, and ``q`` on the same turn as ``q_ref``."""
    references, positions = log.q_ref.copy(), log.q.copy()
    for joint in np.flatnonzero(~arm.prismatic).tolist():
        reference, position = references[:, joint], positions[:, joint]
        for column in (reference, position):
            rows = np.flatnonzero(np.isfinite(column))
            column[rows] -= _FULL_TURN_RAD * np.cumsum(_full_turns(np.diff(column[rows], prepend=column[rows[:1]])))
        reference += _FULL_TURN_RAD * _turns_to_limits(arm, joint, reference)
        first_common = np.flatnonzero(np.isfinite(reference) & np.isfinite(position))[:1]
        if first_common.size:
            position -= _FULL_TURN_RAD * _full_turns(position[first_common] - reference[first_common])[0]
    is_unchanged = np.array_equal(references, log.q_ref, equal_nan=True) and np.array_equal(positions, log.q, equal_nan=True)
    return log if is_unchanged else replace(log, q_ref=references, q=positions)


def _turns_to_limits(arm: Arm, joint: int, angles: FloatArray) -> int:
    """Return the full turns that bring angles within the limits of a joint; 0 if none does or they are there already."""
    lowest, highest = np.fmin.reduce(angles), np.fmax.reduce(angles)
    for turns in (0, 1, -1):
        shift = turns * _FULL_TURN_RAD
        if arm.lower[joint] <= lowest + shift and highest + shift <= arm.upper[joint]:
            return turns
    return 0


def _full_turns(steps: FloatArray) -> FloatArray:
    """Return the full turns in steps of an angle, 0 where a step is not near full turns."""
    rounded = np.rint(steps / _FULL_TURN_RAD)
    return np.where(np.abs(steps - _FULL_TURN_RAD * rounded) < _TURN_TOLERANCE_RAD, rounded, 0.0)
