"""Where a failed arm can stop with its joint locked at a given value: all points found, and what they are."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.caching import cached_property
from holdfast.control.law import Law
from holdfast.equilibria.stability import Kind, Kinds, attracts, kinds
from holdfast.equilibria.system import RestSystem, distinct, idle_joints, wrapped
from holdfast.notice import Progress, told
from holdfast.result import Result
from holdfast.simulation.system import tool_errors

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

WAVE, PATIENCE, MOST_WAVES = 256, 3, 40
SAME, SAME_DEGENERATE = 1e-5, 0.05  # rad (and m): points nearer than this are one
SAMPLE = 256  # points of a continuum that are kept


@dataclass(frozen=True, eq=False, kw_only=True)
class StationaryPoints(Result):
    """Stationary points of an arm with locked joints, solutions and erroneous ones.

    Attributes:
        law: The control law.
        target: (4, 4) wanted tool pose; a task takes its rows of it.
        locked: Locked joints, from 0.
        at: (k,) their values, rad (or m).
        q: (P, n) rad and m, from -pi to pi: solutions first, then sinks, saddles, sources and degenerate points;
            joints that the task does not notice are at 0.
        kind: (P,) :class:`holdfast.equilibria.Kind`.
        eigenvalues: (P, n - k) of the linearised motion of the healthy joints, complex, by falling real part, in units of the
            gain Ke.
        error: (P,) norm of the task's error, m and rad.
        residual: (P,) norm of the healthy joints' rates in units of Ke: 0 but for rounding.
        continuum: (P,) True for points that are not isolated, a sample of what may be a curve or a surface of stationary
            points, as where a spherical shoulder can turn without moving what is locked.
        within_limits: (P,) all joints are within their limits, which the law does not heed.
        starts: Random starts that were used; points that none converges to are missed.
    """

    law: Law
    target: Array
    locked: tuple[int, ...]
    at: Array
    q: Array
    kind: Kinds
    eigenvalues: NDArray[np.complex128]
    error: Array
    residual: Array
    continuum: Flags
    within_limits: Flags
    starts: int

    def __len__(self) -> int:
        return len(self.q)

    def of_kind(self, *chosen: Kind) -> StationaryPoints:
        """Only the points of these kinds."""
        return self._subset(np.isin(self.kind, chosen))

    @property
    def kinds(self) -> list[str]:
        """``solution``, ``sink``, ``saddle``, ``source`` or ``degenerate`` of each point."""
        return [Kind(k).word for k in self.kind]

    @property
    def position_error(self) -> Array:
        """(P,) distance of the tool point from the target in the directions of the task, m."""
        return self._tool_errors[0]

    @property
    def angle_error(self) -> Array:
        """(P,) angle of the end effector from the target in the directions of the task, rad."""
        return self._tool_errors[1]

    @cached_property
    def _tool_errors(self) -> tuple[Array, Array]:
        return tool_errors(self.law, self.q, self.error, self.target)

    @property
    def attracting(self) -> Flags:
        """(P,) True for sinks, and for points that repel in no direction: those of a continuum that the arm can end on."""
        return attracts(self.eigenvalues)

    @property
    def balance(self) -> int:
        """Isolated points that attract or repel all around, minus saddles: sum of the signs of the determinants.

        By Poincare and Hopf the sum for two healthy joints that turn without end is 0 where J is regular everywhere, which
        tells of points that were missed.
        """
        alone = ~self.continuum & np.isfinite(self.eigenvalues).all(axis=1)
        signs = int(np.sign(np.prod(self.eigenvalues[alone], axis=1).real).sum())
        return -signs if self.eigenvalues.shape[1] % 2 else signs

    def describe(self) -> list[str]:
        """A few sentences for people."""
        arm = self.law.arm
        where = ", ".join(f"{arm.joint_names[k]} at {_shown(arm, k, x)}" for k, x in zip(self.locked, self.at, strict=True))
        lines = [f"{arm.title} under {self.law.describe()}, locked: {where}; {self.starts} starts"]
        idle = [arm.joint_names[k] for k in idle_joints(self.law) if k not in self.locked]
        if idle:
            lines.append(f"the task does not notice {', '.join(idle)}, shown at 0")
        for kind in Kind:
            here = self.kind == kind
            if (here & ~self.continuum).any():
                lines.append(f"{int((here & ~self.continuum).sum())} x {kind.word}")
            loose = here & self.continuum
            if loose.any():
                attracting = "" if kind == Kind.SOLUTION else f", {int((loose & self.attracting).sum())} of them attracting"
                lines.append(f"{int(loose.sum())} x {kind.word}, sampled from points that are not isolated{attracting}")
        return lines

    def _subset(self, rows: Flags | NDArray[np.intp]) -> StationaryPoints:
        names = ("q", "kind", "eigenvalues", "error", "residual", "continuum", "within_limits")
        return replace(self, **{name: getattr(self, name)[rows] for name in names})


def search(system: RestSystem, at: Array, generator: np.random.Generator, advance: Progress = told) -> StationaryPoints:
    """All stationary points that random starts find with the locked joints at (k,)."""
    # With spare joints the target is reached on curves or surfaces: one wave gives a sample.
    spare = int(system.healthy.sum()) > system.law.task.m
    reached, first = _gathered(system, at, system.solutions, generator, 1 if spare else MOST_WAVES, told)
    stuck, second = _gathered(system, at, system.stuck, generator, MOST_WAVES, advance)
    return classified(system, at, np.concatenate([reached, stuck]), first + second)


def _gathered(
    system: RestSystem,
    at: Array,
    attempt: Callable[[Array], Array],
    generator: np.random.Generator,
    most: int,
    advance: Progress,
) -> tuple[Array, int]:
    """Stationary points (P, n) from waves of starts, until some waves bring none that is isolated and new; how many starts."""
    arm = system.law.arm
    alone, loose = np.empty((0, arm.n)), np.empty((0, arm.n))
    starts = idle = 0
    for _ in range(most):
        z = system.starts(WAVE, generator)
        z[:, list(system.joints)] = at
        starts += WAVE
        found = wrapped(arm, attempt(z))
        firm = system.isolated(found)
        fresh = distinct(arm, found[firm], alone, SAME)
        alone = np.concatenate([alone, fresh])
        loose = np.concatenate([loose, distinct(arm, found[~firm], loose, SAME_DEGENERATE)])[:SAMPLE]
        idle = 0 if len(fresh) else idle + 1
        advance(starts, starts + (PATIENCE - idle) * WAVE)  # if nothing new comes
        if idle == PATIENCE:
            break
    return np.concatenate([alone, loose]), starts


def classified(system: RestSystem, at: Array, q: Array, starts: int) -> StationaryPoints:
    """Stationary points q (P, n) with what there is to know of them, by kind and error."""
    arm, healthy = system.law.arm, system.healthy
    rates, error, scaled = system.linear.rates(q, system.pose)
    eigenvalues = system.eigenvalues(q)
    kind = kinds(eigenvalues, scaled)
    points = StationaryPoints(
        law=system.law,
        target=system.pose,
        locked=system.joints,
        at=at,
        q=q,
        kind=kind,
        eigenvalues=eigenvalues,
        error=error,
        residual=np.linalg.norm(rates[:, healthy], axis=1),
        continuum=~system.isolated(q),
        within_limits=np.asarray(((q >= arm.lower) & (q <= arm.upper)).all(axis=1)),
        starts=starts,
    )
    return points._subset(np.lexsort((np.round(scaled, 9), ~points.attracting, kind)))


def _shown(arm: Arm, k: int, value: float) -> str:
    return f"{value:.4g} m" if arm.joints[k].prismatic else f"{np.rad2deg(value):.4f} deg"
