"""Events of a motion along a path: algorithmic singularities, rate caps, limits.

At a configuration that is best along its self-motion, the slope of the objective is 0 and its curvature matrix is definite. If
the matrix becomes singular although J is not, the extremum ends or splits. This is an *algorithmic* singularity, at which the
extended Jacobian loses rank and gradient projection lags behind or jumps.

If the weights of a susceptibility have as many non-zero eigenvalues as there are degrees of redundancy, a region of cost
exactly 0 can be entered or left only through such a point. Inside, ``W^(1/2) f = 0`` fixes the self-motion, and it loses its
solution only where the derivative of ``W^(1/2) f`` along the self-motion is singular.

Source: English and Maciejewski 1998, section VI-B, Figs. 6 to 8.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import casadi as ca
import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kinematics.indices.objective import Objective
from holdfast.kinematics.path_following.clearance_limits import ClearanceHistory
from holdfast.kinematics.path_following.resolution import null_basis_and_gradient
from holdfast.kinematics.path_following.trajectory import Event
from holdfast.model.arm import kinematics
from holdfast.model.arm.task import Task

NEGATIVE_CURVATURE_FRACTION = 1e-2  # of the median curvature along a path: a curvature this far below 0 is not a local best
# Fraction of the median curvature along a path: if it is lower and rates are high, an extremum nearly ends.
_LOW_CURVATURE_FRACTION = 0.2
_FAST_RATE_FACTOR = 4.0  # multiple of the median rate that counts as high
ZERO_COST_FRACTION = 1e-3  # of the largest cost along a path: less counts as zero, because gradient projection lags a little
_VALUE_TOLERANCE = 0.01  # of the value, or of its range
_JUMP_FRACTION = 0.02  # of the range of the values, in one step
_BRIDGED_FRACTION = 0.01  # of the steps: events that are closer together are joined
_DIFFERENCE_STEP_RAD = 1e-5  # rad
_NEARBY_DISTANCE_M = 0.05  # m: objects within this distance slow a motion without a joint at its limit
_MARGIN_TOLERANCE_M = 1e-3  # m: a smaller remaining distance counts as none
_LAG_FRACTION = 0.01  # fraction of the way along the path: later steps make up for a step that is shortened now and then
DISTANCE_TOLERANCE_M = 1e-4  # m: a smaller shortfall below the required distance is due to the step size


class Curvature:
    """Gradient and curvature of an objective along the self-motion of a task, in batches.

    The curvature is the central difference of the projected gradient. Exact derivatives through the null space take seconds to
    compile, and 9 digits suffice to find where the curvature vanishes.

    Args:
        objective: Objective with the slope and curvature.
        task: Task that the self-motion does not affect.
    """

    def __init__(self, objective: Objective, task: Task) -> None:
        self.objective, self.task = objective, task
        self.free = objective.arm.n - task.m

    @cached_property
    @cached_kernel
    def _kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.objective.arm)
        null_space, gradient = null_basis_and_gradient(self.objective, self.task, q)
        return Kernel("slope along the self-motion", [q], [gradient, ca.densify(null_space)])

    def _gradient_and_basis(self, q: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return gradients (N, r) and null-space bases (N, n, r)."""
        outputs = self._kernel.rows(q)
        return outputs[:, : self.free], outputs[:, self.free :].reshape(len(q), -1, self.free)

    def __call__(self, q: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return at ``q`` (N, n) the gradient norm (N,) and curvature matrices (N, r, r), positive definite at a local best."""
        gradient, null_space = self._gradient_and_basis(q)
        matrices = np.empty((len(q), self.free, self.free))
        for column in range(self.free):
            displacement = _DIFFERENCE_STEP_RAD * null_space[:, :, column]
            end_gradients = []
            for neighbor in (q + displacement, q - displacement):
                neighbor_gradient, basis = self._gradient_and_basis(neighbor)
                # The bases at both ends may differ by a rotation or reflection, which is undone to compare the slopes.
                end_gradients.append(np.einsum("nij,nik,nk->nj", null_space, basis, neighbor_gradient))
            matrices[:, :, column] = (end_gradients[1] - end_gradients[0]) / (2 * _DIFFERENCE_STEP_RAD)
        return np.linalg.norm(gradient, axis=1), (matrices + matrices.transpose(0, 2, 1)) / 2

    def smallest(self, q: FloatArray) -> FloatArray:
        """Return the smallest eigenvalue (N,) of the curvature matrix at ``q`` (N, n), rad and m; NaN where singular."""
        matrices = self(q)[1]
        is_finite = np.isfinite(matrices).all(axis=(1, 2))
        eigenvalues = np.full(len(q), np.nan)
        eigenvalues[is_finite] = np.linalg.eigvalsh(matrices[is_finite])[:, 0]
        return eigenvalues


@dataclass(frozen=True, eq=False)
class MotionHistory:
    """History of a motion at its N computed steps.

    Attributes:
        time: (N,) time, s.
        value: (N,) value of the objective.
        curvature: (N,) smallest curvature, see :meth:`Curvature.smallest`.
        rate_norm: (N,) norm of the joint rates, rad/s.
        self_motion, task_share, damping: (N,) see :class:`holdfast.kinematics.path_following.Rates`.
        at_limit: (N,) flags by joint name.
    """

    time: FloatArray
    value: FloatArray
    curvature: FloatArray
    rate_norm: FloatArray
    self_motion: FloatArray
    task_share: FloatArray
    damping: FloatArray
    at_limit: dict[str, BoolArray]


def find_events(
    objective: Objective,
    motion: MotionHistory,
    follows_extremum: bool,
    requested_value: float | None,
    cap_phrase: str,
    clearance_history: ClearanceHistory | None = None,
) -> tuple[Event, ...]:
    """Find the events of a motion, in order of time.

    Args:
        objective: Objective of the self-motion.
        motion: The motion.
        follows_extremum: True if the self-motion should stay at a local best.
        requested_value: Value that the self-motion should keep, or None.
        cap_phrase: Phrase for the limit of the self-motion.
        clearance_history: Distances along the motion, if they were limited.
    """
    events: list[Event] = []
    at_margin = np.zeros(len(motion.time), dtype=bool)
    if clearance_history is not None:
        is_free = ~np.any(list(motion.at_limit.values()), axis=0)
        at_margin = (clearance_history.margin < _MARGIN_TOLERANCE_M) | (
            (motion.task_share < 1 - 1e-9) & (clearance_history.margin < _NEARBY_DISTANCE_M) & is_free
        )

    def add_events(kind: str, flags: BoolArray, write_text: Callable[[str], str]) -> None:
        for first, last in _find_runs(flags, max(1, round(_BRIDGED_FRACTION * len(flags)))):
            start, end = float(motion.time[first]), float(motion.time[last])
            events.append(Event(kind=kind, start=start, end=end, text=write_text(_format_time_span(start, end))))

    positive = objective.better == "smaller" and bool((motion.value >= 0).all())
    is_zero = (
        positive & (motion.value <= ZERO_COST_FRACTION * max(float(motion.value.max()), 1e-300)) & (motion.value.max() > 0)
    )
    text = f"{objective.name} is zero (below {ZERO_COST_FRACTION:.1%} of its largest value)"
    add_events("zero cost", is_zero, lambda when: f"{when}: {text}")
    value_range = float(np.ptp(motion.value))
    jump = np.r_[False, np.abs(np.diff(motion.value)) > _JUMP_FRACTION * value_range] & (value_range > 0)
    add_events(
        "value jump",
        jump,
        lambda when: (
            f"{when}: {objective.name} jumps by more than {_JUMP_FRACTION:.0%} of its range in one step; swing angles do where "
            "a joint is balanced about its axis or upright, and the worst of several failures may"
        ),
    )
    events += _find_fast_motions(objective, motion, follows_extremum, is_zero)
    if requested_value is not None:
        off_value = np.abs(motion.value - requested_value) > _VALUE_TOLERANCE * max(
            abs(requested_value), float(np.ptp(motion.value))
        )
        add_events(
            "value not kept",
            off_value,
            lambda when: f"{when}: {objective.name} is more than {_VALUE_TOLERANCE:.0%} off the wanted {requested_value:.4g}",
        )
    add_events(
        "rate cap",
        motion.self_motion < 1 - 1e-9,
        lambda when: f"{when}: {cap_phrase} slows the self-motion; the tool is not affected",
    )
    add_events(
        "end effector slowed",
        (motion.task_share < 1 - 1e-9) & ~at_margin,
        lambda when: f"{when}: joint limits leave no motion that keeps up: the end effector falls behind its path",
    )
    if clearance_history is not None:
        events += _find_clearance_events(clearance_history, motion, at_margin)
    add_events(
        "near a singularity",
        motion.damping > 0,
        lambda when: f"{when}: the arm is close to a singularity of its task: rates are damped, so the end effector may lag",
    )
    for name, flags in motion.at_limit.items():
        add_events("joint limit", flags, partial("{1}: '{0}' is at its limit".format, name))
    return tuple(sorted(events, key=lambda event: (event.start, event.kind)))


def _find_clearance_events(clearance_history: ClearanceHistory, motion: MotionHistory, at_margin: BoolArray) -> list[Event]:
    """Find where a pair has no margin left, because it limited the motion or came closer."""
    events = []
    bridge = max(1, round(_BRIDGED_FRACTION * len(at_margin)))
    slowed = 1 - motion.task_share
    for pair in np.unique(clearance_history.nearest_pair[at_margin]):
        name, min_distance_mm = clearance_history.pair_names[pair], 1000 * clearance_history.min_distances[pair]
        link, _, obstacle = name.partition(" & ")
        for first, last in _find_runs(at_margin & (clearance_history.nearest_pair == pair), bridge):
            time_phrase = _format_time_span(float(motion.time[first]), float(motion.time[last]))
            samples = slice(first, last + 1)
            smallest_margin = float(clearance_history.margin[samples].min())
            if smallest_margin < -DISTANCE_TOLERANCE_M:
                kind = "too near"
                text = (
                    f"{time_phrase}: {link} comes closer to {obstacle} than the required {min_distance_mm:.3g} mm, by up to "
                    f"{-1000 * smallest_margin:.2g} mm"
                )
            elif slowed[samples].mean() > _LAG_FRACTION:
                kind = "end effector slowed"
                text = (
                    f"{time_phrase}: {obstacle} leaves {link} no motion that keeps up: the end effector falls behind its path"
                )
            else:
                kind = "kept clear"
                text = (
                    f"{time_phrase}: the self-motion keeps {link} at the required distance of {min_distance_mm:.3g} mm "
                    f"from {obstacle}"
                )
            events.append(Event(kind=kind, start=float(motion.time[first]), end=float(motion.time[last]), text=text))
    return events


def _find_fast_motions(objective: Objective, motion: MotionHistory, tracks: bool, is_zero: BoolArray) -> list[Event]:
    """Find where the self-motion lost the extremum that it followed, or ran much faster than elsewhere, as one event each."""
    count = len(motion.time)
    is_finite = np.isfinite(motion.curvature)
    typical = float(np.median(np.abs(motion.curvature[is_finite]))) if is_finite.any() else 0.0
    median_rate = float(np.median(motion.rate_norm))
    flags = (motion.rate_norm > _FAST_RATE_FACTOR * median_rate) & (motion.rate_norm > 1e-9)
    if tracks and typical > 0:
        flags |= motion.curvature < -NEGATIVE_CURVATURE_FRACTION * typical
    events = []
    bridge = max(2, round(_BRIDGED_FRACTION * count))
    for first, last in _find_runs(flags, bridge):
        start, end = float(motion.time[first]), float(motion.time[last])
        window = slice(max(first - bridge, 0), min(last + bridge + 1, count))
        peak = float(motion.rate_norm[window].max())
        rate_phrase = f"joint rates reach {peak:.4g} rad/s ({peak / max(median_rate, 1e-12):.2g} times their median)"
        curvature = motion.curvature[window]
        min_curvature = float(np.nanmin(curvature)) if np.isfinite(curvature).any() else np.nan
        lost_extremum = tracks and min_curvature < -NEGATIVE_CURVATURE_FRACTION * typical
        end_phrase = "; it has not reached one by the end" if lost_extremum and last >= count - 2 else ""
        if tracks and first == 0:
            text = (
                f"{_format_time_span(start, end)}: the arm does not start at a local best of {objective.name} and "
                f"moves to one; {rate_phrase}"
            )
            events.append(Event(kind="not at an extremum", start=start, end=end, text=text + end_phrase))
        elif tracks and min_curvature <= _LOW_CURVATURE_FRACTION * typical:
            reason = "the local best that the arm follows " + (
                "ends or splits here" if lost_extremum else "nearly ends or splits here"
            )
            zero_inside = is_zero[window]
            if zero_inside.any() and not zero_inside.all():
                reason = "here is the border of the region in which it can be zero"
            transition_phrase = (
                f", and until {end:.4g} s the arm is on its way to another local best" if lost_extremum and end > start else ""
            )
            text = (
                f"at {start:.4g} s: {'' if lost_extremum or zero_inside.any() else 'close to an '}algorithmic singularity of "
                f"{objective.name}, though the arm itself is not singular: {reason}{transition_phrase}{end_phrase}; "
                f"{rate_phrase}"
            )
            events.append(Event(kind="algorithmic singularity", start=start, end=end, text=text))
        else:
            events.append(
                Event(kind="fast motion", start=start, end=end, text=f"{_format_time_span(start, end)}: {rate_phrase}")
            )
    return events


def _format_time_span(start: float, end: float) -> str:
    start_text, end_text = f"{start:.4g}", f"{end:.4g}"
    return f"at {start_text} s" if start_text == end_text else f"from {start_text} s to {end_text} s"


def _find_runs(flags: BoolArray, max_gap: int) -> list[tuple[int, int]]:
    """Return the first and last position of every run of True; runs less than ``max_gap`` apart are joined."""
    edges = np.flatnonzero(np.diff(np.r_[False, flags, False].astype(np.int8)))
    runs: list[tuple[int, int]] = []
    for first, last in zip(edges[::2].tolist(), (edges[1::2] - 1).tolist(), strict=True):
        if runs and first - runs[-1][1] <= max_gap:
            runs[-1] = (runs[-1][0], last)
        else:
            runs.append((first, last))
    return runs
