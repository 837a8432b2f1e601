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
from dataclasses import dataclass
from functools import partial

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.task import Task
from holdfast.caching import cached_property
from holdfast.indices.objective import Objective
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.recall import recalled
from holdfast.motion.nearness import Near
from holdfast.motion.resolution import slope_along
from holdfast.motion.trajectory import Event

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

FLAT = 1e-2  # of the median curvature along a path: this much below 0 is not a local best
_CLOSE = 0.2  # of the median curvature along a path: where it is less and rates are high, an extremum nearly ends
_FAST = 4.0  # times the median rate: this is high
NOTHING = 1e-3  # of the largest cost along a path: at most this counts as zero, as gradient projection lags a little
_KEPT = 0.01  # of the value, or of its range
_JUMP = 0.02  # of the range of the values, in one step
_BRIDGE = 0.01  # of the steps: events less apart are one
_DIFFERENCE = 1e-5  # rad
_CLOSE_BY = 0.05  # m: a motion without a joint at its limit is slowed by what is so near
_AT_MARGIN = 1e-3  # m: less room than this is as good as none
_LAG = 0.01  # of the way along the path: a step cut short now and then is made up for
TOO_NEAR = 1e-4  # m: less than this below what is to be kept comes of the steps


class Curvature:
    """Slope and curvature of an objective along the self-motion of a task, in batches.

    The curvature is the central difference of the projected gradient: exact derivatives through the null space take
    seconds to compile, and 9 digits are enough to say where it vanishes.

    Args:
        objective: Whose slope and curvature.
        task: That the self-motion leaves alone.
    """

    def __init__(self, objective: Objective, task: Task) -> None:
        self.objective, self.task = objective, task
        self.free = objective.arm.n - task.m

    @cached_property
    @recalled
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


@dataclass(frozen=True, eq=False)
class Course:
    """A motion at each step of its computation, N steps.

    Attributes:
        time: (N,) s.
        value: (N,) of the objective.
        curvature: (N,) see :meth:`Curvature.smallest`.
        rate_norm: (N,) rad/s.
        self_motion, task_share, damping: (N,) see :class:`holdfast.motion.Rates`.
        at_limit: (N,) by joint name.
    """

    time: Array
    value: Array
    curvature: Array
    rate_norm: Array
    self_motion: Array
    task_share: Array
    damping: Array
    at_limit: dict[str, Flags]


def find_events(
    objective: Objective, c: Course, tracks: bool, wanted: float | None, cap: str, near: Near | None = None
) -> tuple[Event, ...]:
    """What happened, in order of time.

    Args:
        objective: What the self-motion served.
        c: The motion.
        tracks: The self-motion was meant to stay at a local best.
        wanted: The value that it was meant to keep, if so.
        cap: What limited the self-motion, for people.
        near: What it kept clear of, if anything.
    """
    found: list[Event] = []
    held = np.zeros(len(c.time), dtype=bool)
    if near is not None:
        free = ~np.any(list(c.at_limit.values()), axis=0)
        held = (near.room < _AT_MARGIN) | ((c.task_share < 1 - 1e-9) & (near.room < _CLOSE_BY) & free)

    def add(kind: str, flags: Flags, say: Callable[[str], str]) -> None:
        for a, b in _runs(flags, max(1, round(_BRIDGE * len(flags)))):
            start, end = float(c.time[a]), float(c.time[b])
            found.append(Event(kind=kind, start=start, end=end, text=say(_when(start, end))))

    positive = objective.better == "smaller" and bool((c.value >= 0).all())
    nothing = positive & (c.value <= NOTHING * max(float(c.value.max()), 1e-300)) & (c.value.max() > 0)
    add("zero cost", nothing, lambda when: f"{when}: {objective.name} is zero (below {NOTHING:.1%} of its largest value)")
    range_ = float(np.ptp(c.value))
    jump = np.r_[False, np.abs(np.diff(c.value)) > _JUMP * range_] & (range_ > 0)
    add(
        "value jump",
        jump,
        lambda when: (
            f"{when}: {objective.name} jumps by more than {_JUMP:.0%} of its range in one step; swing angles do where a joint "
            "is balanced about its axis or upright, and the worst of several failures may"
        ),
    )
    found += _troubles(objective, c, tracks, nothing)
    if wanted is not None:
        off = np.abs(c.value - wanted) > _KEPT * max(abs(wanted), float(np.ptp(c.value)))
        add(
            "value not kept", off, lambda when: f"{when}: {objective.name} is more than {_KEPT:.0%} off the wanted {wanted:.4g}"
        )
    add("rate cap", c.self_motion < 1 - 1e-9, lambda when: f"{when}: {cap} slows the self-motion; the tool is not affected")
    add(
        "end effector slowed",
        (c.task_share < 1 - 1e-9) & ~held,
        lambda when: f"{when}: joint limits leave no motion that keeps up: the end effector falls behind its path",
    )
    if near is not None:
        found += _approaches(near, c, held)
    add(
        "near a singularity",
        c.damping > 0,
        lambda when: f"{when}: the arm is close to a singularity of its task: rates are damped, so the end effector may lag",
    )
    for name, flags in c.at_limit.items():
        add("joint limit", flags, partial(_at_limit, name))
    return tuple(sorted(found, key=lambda e: (e.start, e.kind)))


def _approaches(near: Near, c: Course, held: Flags) -> list[Event]:
    """Where a pair has no more room than it must keep: as a limit that turned the motion, or closer."""
    found = []
    bridge = max(1, round(_BRIDGE * len(held)))
    slowed = 1 - c.task_share
    for pair in np.unique(near.pair[held]):
        name, kept = near.names[pair], 1000 * near.kept[pair]
        link, _, thing = name.partition(" & ")
        for a, b in _runs(held & (near.pair == pair), bridge):
            when = _when(float(c.time[a]), float(c.time[b]))
            span = slice(a, b + 1)
            least = float(near.room[span].min())
            if least < -TOO_NEAR:
                kind = "too near"
                text = f"{when}: comes nearer than {kept:.3g} mm to {thing} with {link}, by up to {-1000 * least:.2g} mm"
            elif slowed[span].mean() > _LAG:
                kind = "end effector slowed"
                text = f"{when}: {thing} leaves {link} no motion that keeps up: the end effector falls behind its path"
            else:
                kind = "kept clear"
                text = f"{when}: the self-motion keeps {link} clear of {thing}, by the {kept:.3g} mm that are asked for"
            found.append(Event(kind=kind, start=float(c.time[a]), end=float(c.time[b]), text=text))
    return found


def _at_limit(name: str, when: str) -> str:
    return f"{when}: '{name}' is at its limit"


def _troubles(objective: Objective, c: Course, tracks: bool, nothing: Flags) -> list[Event]:
    """Where the self-motion lost the extremum that it followed, or ran much faster than elsewhere: one event for each."""
    count = len(c.time)
    good = np.isfinite(c.curvature)
    typical = float(np.median(np.abs(c.curvature[good]))) if good.any() else 0.0
    usual = float(np.median(c.rate_norm))
    flags = (c.rate_norm > _FAST * usual) & (c.rate_norm > 1e-9)
    if tracks and typical > 0:
        flags |= c.curvature < -FLAT * typical
    found = []
    near = max(2, round(_BRIDGE * count))
    for first, last in _runs(flags, near):
        start, end = float(c.time[first]), float(c.time[last])
        window = slice(max(first - near, 0), min(last + near + 1, count))
        peak = float(c.rate_norm[window].max())
        reach = f"joint rates reach {peak:.4g} rad/s ({peak / max(usual, 1e-12):.2g} times their median)"
        bend = c.curvature[window]
        least = float(np.nanmin(bend)) if np.isfinite(bend).any() else np.nan
        lost = tracks and least < -FLAT * typical
        closing = "; it has not reached one by the end" if lost and last >= count - 2 else ""
        if tracks and first == 0:
            text = f"{_when(start, end)}: the arm does not start at a local best of {objective.name} and moves to one; {reach}"
            found.append(Event(kind="not at an extremum", start=start, end=end, text=text + closing))
        elif tracks and least <= _CLOSE * typical:
            why = "the local best that the arm follows " + ("ends or splits here" if lost else "nearly ends or splits here")
            inside = nothing[window]
            if inside.any() and not inside.all():
                why = "here is the border of the region in which it can be zero"
            way = f", and until {end:.4g} s the arm is on its way to another local best" if lost and end > start else ""
            text = (
                f"at {start:.4g} s: {'' if lost or inside.any() else 'close to an '}algorithmic singularity of "
                f"{objective.name}, though the arm itself is not singular: {why}{way}{closing}; {reach}"
            )
            found.append(Event(kind="algorithmic singularity", start=start, end=end, text=text))
        else:
            found.append(Event(kind="fast motion", start=start, end=end, text=f"{_when(start, end)}: {reach}"))
    return found


def _when(start: float, end: float) -> str:
    a, b = f"{start:.4g}", f"{end:.4g}"
    return f"at {a} s" if a == b else f"from {a} s to {b} s"


def _runs(flags: Flags, bridge: int) -> list[tuple[int, int]]:
    """First and last position of every stretch of True; stretches less than ``bridge`` apart are one."""
    edges = np.flatnonzero(np.diff(np.r_[False, flags, False].astype(np.int8)))
    runs: list[tuple[int, int]] = []
    for a, b in zip(edges[::2].tolist(), (edges[1::2] - 1).tolist(), strict=True):
        if runs and a - runs[-1][1] <= bridge:
            runs[-1] = (runs[-1][0], b)
        else:
            runs.append((a, b))
    return runs
