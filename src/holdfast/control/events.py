"""Where and why a motion along a path met trouble: algorithmic singularities, caps, limits.

At a configuration that is best along its self-motion, the slope of the objective there is 0 and its curvature matrix is
definite. Where the matrix becomes singular although J is not, the extremum ends or splits: an *algorithmic* singularity,
at which the extended Jacobian loses rank and gradient projection lags behind or jumps.

If the weights of a susceptibility have as many non-zero eigenvalues as there are degrees of redundancy, a region in which
the cost is exactly 0 can be entered or left only through such a point: inside, ``W^(1/2) f = 0`` fixes the self-motion,
and it stops having a solution only where the derivative of ``W^(1/2) f`` along the self-motion is singular.

Source: English and Maciejewski 1998, section VI-B, Figs. 6 to 8.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.task import Task
from holdfast.control.resolution import slope_along
from holdfast.control.trajectory import Event
from holdfast.indices import Objective
from holdfast.kernels import Kernel

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

FLAT = 1e-3  # of the largest curvature along a path: at most this is singular
_DIFFERENCE = 1e-5  # rad
NOTHING = 1e-3  # of the largest cost along a path: at most this counts as zero, as gradient projection lags a little


class Curvature:
    """Slope and curvature of an objective along the self-motion of a task, in batches.

    The curvature is the central difference of the projected gradient: exact derivatives through the null space take
    seconds to compile, and 9 digits are enough to say where it vanishes.
    """

    def __init__(self, objective: Objective, task: Task) -> None:
        self.objective, self.task = objective, task
        self.free = objective.arm.n - task.m

    @cached_property
    def _kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.objective.arm)
        null, slope = slope_along(self.objective, self.task, q)
        return Kernel("slope along the self-motion", [q], [slope, ca.densify(null)])

    def _at(self, q: Array) -> tuple[Array, Array]:
        """Slopes (N, r) and null-space bases (N, n, r)."""
        out = self._kernel.rows(q)
        return out[:, : self.free], out[:, self.free :].reshape(len(q), -1, self.free)

    def __call__(self, q: Array) -> tuple[Array, Array]:
        """Norm of the slope (N,) and curvature matrices (N, r, r), positive definite at a local best."""
        slope, null = self._at(q)
        matrices = np.empty((len(q), self.free, self.free))
        for k in range(self.free):
            move = _DIFFERENCE * null[:, :, k]
            ends = []
            for near in (q + move, q - move):
                there, basis = self._at(near)
                # The basis at either end may be turned or reflected: carried back, the slopes can be compared.
                ends.append(np.einsum("nij,nik,nk->nj", null, basis, there))
            matrices[:, :, k] = (ends[1] - ends[0]) / (2 * _DIFFERENCE)
        return np.linalg.norm(slope, axis=1), (matrices + matrices.transpose(0, 2, 1)) / 2

    def smallest(self, q: Array) -> Array:
        """Smallest eigenvalue (N,) of the curvature matrix; NaN at a singular configuration."""
        matrices = self(q)[1]
        good = np.isfinite(matrices).all(axis=(1, 2))
        found = np.full(len(q), np.nan)
        found[good] = np.linalg.eigvalsh(matrices[good])[:, 0]
        return found


def events(
    objective: Objective,
    time: Array,
    value: Array,
    curvature: Array,
    rate_norm: Array,
    self_motion: Array,
    task_share: Array,
    damping: Array,
    at_limit: dict[str, Flags],
) -> tuple[Event, ...]:
    """What happened, in order of time; all arrays (T,), ``at_limit`` by joint name."""
    found: list[Event] = []
    positive = objective.better == "smaller" and bool((value >= 0).all())
    nothing = positive & (value <= NOTHING * max(float(value.max()), 1e-300))
    if positive and value.max() > 0 and nothing.any():
        found += _spans(
            "zero cost",
            time,
            nothing,
            lambda a, b: f"{objective.name} is zero (below {NOTHING:.1%} of its largest value) from {a:.4g} s to {b:.4g} s",
        )
    scale = float(np.nanmax(np.abs(curvature))) if np.isfinite(curvature).any() else 0.0
    flat = np.abs(curvature) <= FLAT * scale
    crossing = np.r_[np.sign(curvature[1:]) * np.sign(curvature[:-1]) < 0, False]
    for start, end in _runs((flat | crossing) & (scale > 0)):
        found.append(_algorithmic(objective, time, curvature, rate_norm, nothing, start, end, scale))
    lost = (curvature < -FLAT * scale) & (scale > 0)
    found += _spans(
        "not at an extremum",
        time,
        lost,
        lambda a, b: (
            f"from {a:.4g} s to {b:.4g} s the arm is not near a local best of {objective.name} along its self-motion: "
            "the one it followed has ended, or it is on the way to another"
        ),
    )
    found += _spans(
        "rate cap",
        time,
        self_motion < 1 - 1e-9,
        lambda a, b: f"from {a:.4g} s to {b:.4g} s the rate cap slows the self-motion; the hand is not affected",
    )
    found += _spans(
        "hand slowed",
        time,
        task_share < 1 - 1e-9,
        lambda a, b: f"from {a:.4g} s to {b:.4g} s joint limits leave no motion that keeps up: the hand falls behind its path",
    )
    found += _spans(
        "near a singularity",
        time,
        damping > 0,
        lambda a, b: (
            f"from {a:.4g} s to {b:.4g} s the arm is close to a singularity: rates are damped and the hand lags a little"
        ),
    )
    for name, flags in at_limit.items():
        found += _spans(
            "joint limit", time, flags, lambda a, b, name=name: f"'{name}' is at its limit from {a:.4g} s to {b:.4g} s"
        )
    return tuple(sorted(found, key=lambda e: (e.start, e.kind)))


def _algorithmic(
    objective: Objective, time: Array, curvature: Array, rate_norm: Array, nothing: Flags, start: int, end: int, scale: float
) -> Event:
    window = slice(max(start - 2, 0), min(end + 3, len(time)))
    k = start + int(np.nanargmin(np.abs(curvature[start : end + 1])))
    peak = float(rate_norm[window].max())
    before, after = bool(nothing[window][0]), bool(nothing[window][-1])
    why = "the extremum of the self-motion that is followed ends or splits here"
    if before != after:
        why = f"the region of zero cost {'ends' if before else 'begins'} here"
    text = (
        f"at {time[k]:.4g} s: algorithmic singularity of {objective.name}: its curvature along the self-motion falls to "
        f"{abs(curvature[k]) / scale:.1g} of the largest on the path, though the arm is not singular; {why}; "
        f"joint rates reach {peak:.4g} rad/s"
    )
    return Event("algorithmic singularity", float(time[start]), float(time[end]), text)


def _runs(flags: Flags) -> list[tuple[int, int]]:
    """First and last position of every stretch of True."""
    edges = np.flatnonzero(np.diff(np.r_[False, flags, False].astype(np.int8)))
    return [(int(a), int(b) - 1) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def _spans(kind: str, time: Array, flags: Flags, say: Callable[[float, float], str]) -> list[Event]:
    return [Event(kind, float(time[a]), float(time[b]), say(time[a], time[b])) for a, b in _runs(np.asarray(flags))]
