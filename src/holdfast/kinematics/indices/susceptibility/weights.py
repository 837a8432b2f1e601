"""Weights that combine the joints of a susceptibility into one number: the matrix W of ``f' W f``."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.probability.sobol_sequence import sobol_points
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.model.arm import statics
from holdfast.model.arm.model import Arm
from holdfast.model.arm.soundness import require_masses

WeightSpec = ArrayLike | Literal["effort", "worst-case"] | None

EIGENVALUE_TOLERANCE = -1e-12
"""An eigenvalue below this multiple of the largest magnitude is negative, not rounding noise."""

_SAMPLE_COUNT = 4096
_STARTS_PER_SIGN = 16  # starts for each joint and sign
_MAX_SWEEPS = 200
_CONVERGED_GAIN = 1e-13  # gain of a sweep that ends the search, relative to the carried weight times the arm's length
_ZERO_TORQUE_RATIO = 1e-12  # a torque this small relative to the same product is rounding noise


def weight_matrix(arm: Arm, weights: WeightSpec, torque: bool, name: str) -> tuple[FloatArray, str]:
    """Return W (n, n), symmetric, and a word for its kind.

    Args:
        arm: Arm model.
        weights: None (identity), (n,) diagonal, (n, n), ``"effort"`` or ``"worst-case"``.
        torque: True if the measure is a torque, so that the named weights apply.
        name: Name of the measure, for messages.

    Raises:
        InputError: The weights are not such a matrix, not positive semidefinite, or named and not applicable.
    """
    if weights is None:
        return np.eye(arm.n), "identity"
    if isinstance(weights, str):
        if weights not in ("effort", "worst-case"):
            raise InputError(f"weights '{weights}' are not known; use 'effort', 'worst-case', or numbers")
        if not torque:
            raise InputError(f"weights '{weights}' are of torques and the measure is the {name}; give numbers, or none")
        return _named_weights(arm, weights), weights
    try:
        w = np.array(weights, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(
            f"weights must be {arm.n} numbers or {arm.n} x {arm.n} numbers, or 'effort' or 'worst-case'"
        ) from error
    if w.shape not in ((arm.n,), (arm.n, arm.n)):
        raise InputError(f"weights have shape {w.shape}; '{arm.name}' has {arm.n} joints, so ({arm.n},) or ({arm.n}, {arm.n})")
    if not np.isfinite(w).all():
        raise InputError("weights hold NaN or infinity; they must be finite numbers")
    kind = "full" if w.ndim == 2 else "diagonal"
    w = np.diag(w) if w.ndim == 1 else (w + w.T) / 2
    eigenvalues = np.linalg.eigvalsh(w)
    if eigenvalues[0] < EIGENVALUE_TOLERANCE * np.abs(eigenvalues).max():
        raise InputError(
            f"weights are not positive semidefinite: their smallest eigenvalue is {eigenvalues[0]:.4g}; "
            "with it a failure could count as a gain, so all must be 0 or more"
        )
    return w, kind


def _named_weights(arm: Arm, weights: str) -> FloatArray:
    if weights == "effort":
        for joint in arm.joints:
            if not 0 < joint.effort < np.inf:
                raise InputError(
                    f"joint '{joint.name}' of '{arm.name}' has no largest effort above 0, so weights 'effort' are not "
                    "defined; give the joint its effort, or use 'worst-case'"
                )
        return np.diag([1 / joint.effort**2 for joint in arm.joints])
    largest = largest_static_torque(arm)
    # A joint that never carries a static load has no reference value and contributes nothing.
    return np.diag([0.0 if t == 0 else 1 / t**2 for t in largest])


def largest_static_torque(arm: Arm) -> FloatArray:
    """Return the largest magnitude of each joint's holding torque or force over the joint limits of ``arm``, (n,), N m and N.

    As in English and Maciejewski 1998, eq. (46), for their planar arm, but computed for any arm. Revolute joints without limits
    take every angle. The result is 0 for a joint that gravity never loads.

    Every torque is sinusoidal in each revolute joint and affine in each prismatic joint, so the best value of one joint with
    the others fixed has a closed form. Many starts spread over the workspace improve joint by joint until none gains.

    Raises:
        ArmError: The mass of a link is unknown.
        InputError: A prismatic joint has no limits.
    """
    require_masses(arm)
    low, high = np.where(np.isfinite(arm.lower), arm.lower, -np.pi), np.where(np.isfinite(arm.upper), arm.upper, np.pi)
    for k in np.flatnonzero(arm.prismatic):
        if not (np.isfinite(arm.lower[k]) and np.isfinite(arm.upper[k])):
            raise InputError(
                f"joint '{arm.joint_names[k]}' of '{arm.name}' slides without limits, so no static torque is the largest; "
                "give it a lower and an upper limit"
            )
    spread = sobol_points(_SAMPLE_COUNT, arm.n)
    q = low + spread * (high - low)
    tau = arm.gravity_torque(q)
    signed = np.concatenate([tau, -tau], axis=1)
    order = np.argsort(-signed, axis=0, kind="stable")[:_STARTS_PER_SIGN]
    starts = q[order.T.ravel()]
    joint = np.repeat(np.tile(np.arange(arm.n), 2), _STARTS_PER_SIGN)
    sign = np.repeat([1.0, -1.0], arm.n * _STARTS_PER_SIGN)
    scale = statics.torque_scale(arm)
    reached = _maximise_static_torque(arm, starts, joint, sign, low, high, _CONVERGED_GAIN * scale[joint])
    largest = np.array([reached[joint == k].max() for k in range(arm.n)])
    return np.where(largest > _ZERO_TORQUE_RATIO * scale, largest, 0.0)


def _maximise_static_torque(
    arm: Arm, q: FloatArray, joint: IndexArray, sign: FloatArray, low: FloatArray, high: FloatArray, still: FloatArray
) -> FloatArray:
    """Return ``sign * tau[joint]`` (R,) at the end of a coordinate ascent from every row of q (R, n)."""
    rows = np.arange(len(q))

    def signed_torque(x: FloatArray) -> FloatArray:
        return np.asarray(sign * arm.gravity_torque(x)[rows, joint])

    value = signed_torque(q)
    for _ in range(_MAX_SWEEPS):
        before = value
        for k in range(arm.n):
            best = q[:, k]
            choices = [np.full(len(q), low[k]), np.full(len(q), high[k])]
            if not arm.prismatic[k]:
                quarter = [signed_torque(_replace_joint_value(q, k, np.full(len(q), a))) for a in (0.0, np.pi / 2, np.pi)]
                # a + b cos x + c sin x at 0, a quarter and half a turn
                a, b = (quarter[0] + quarter[2]) / 2, (quarter[0] - quarter[2]) / 2
                top = np.arctan2(quarter[1] - a, b)
                choices.append(np.clip(top + 2 * np.pi * np.ceil((low[k] - top) / (2 * np.pi)), low[k], high[k]))
            for choice in choices:
                new_value = signed_torque(_replace_joint_value(q, k, choice))
                best = np.where(new_value > value, choice, best)
                value = np.maximum(value, new_value)
            q = _replace_joint_value(q, k, best)
        if (value - before <= still).all():
            break
    return value


def _replace_joint_value(q: FloatArray, k: int, x: FloatArray) -> FloatArray:
    changed = q.copy()
    changed[:, k] = x
    return changed
