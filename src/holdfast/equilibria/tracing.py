"""Curves of erroneous rest over the value of one locked joint: predictor along the tangent, corrector back to the curve.

Source: Goel, Maciejewski, Balakrishnan 2005, section on tracing stationary manifolds. In the equations used here the
curves run smoothly through configurations where J loses rank and through the target.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from holdfast.control.law import Law
from holdfast.equilibria.curves import Curve, Curves
from holdfast.equilibria.equations import TOLERANCE
from holdfast.equilibria.events import marked
from holdfast.equilibria.points import classified
from holdfast.equilibria.system import RestSystem, wrapped
from holdfast.notice import Progress, told
from holdfast.solvers.curve_tracing import Component, distance_to_curve

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

SPACING = 0.04  # of the unknowns, rad and m
WAVE, PATIENCE, MOST_WAVES = 128, 3, 30
_NEWTON = 6
_SHORTEST = 2.0**-12  # of the spacing: the curve ends where no longer step succeeds
_STRAIGHT = 0.97  # least cosine between tangents at the two ends of a step
_LONGEST = 200.0  # rad: longer curves are cut
_FAR = 50.0  # m: a prismatic joint beyond it has left
_ON_CURVE = 0.15  # of the spacing: a seed nearer than this to a traced curve lies on it
_SURFACE = 1e-6  # of the largest singular value: points with a smaller one than that are not on one curve
_MOST_LOOSE = 512
_NEW = 0.2  # of a curve's points must lie on no other curve
_CONSTANT = 1e-6  # rad (and m): a locked value that changes less along a whole curve is one value


def trace(law: Law, pose: Array, joint: int, seed: int = 0, spacing: float = SPACING, advance: Progress = told) -> Curves:
    """All curves of erroneous rest that a random start converges to; see :func:`holdfast.equilibria.stationary_points`."""
    system = RestSystem(law, pose, (joint,))
    tracer = Tracer(system, joint, spacing)
    found, loose, starts = tracer.all(np.random.default_rng(seed), advance)
    return Curves(
        law=law,
        target=pose,
        joint=joint,
        curves=tuple(found),
        loose=classified(system, np.array([np.nan]), loose, starts),
        starts=starts,
        _system=system,
    )


class Tracer:
    """Follows the curves of one law, target and locked joint."""

    def __init__(self, system: RestSystem, joint: int, spacing: float) -> None:
        self.system, self.joint, self.spacing = system, joint, spacing
        self._arm = system.law.arm.without_limits
        self._n = system.law.arm.n

    def all(self, generator: np.random.Generator, advance: Progress = told) -> tuple[list[Curve], Array, int]:
        """Every curve that a start converges to, until some waves bring no new one; points on none; how many starts."""
        found: list[Curve] = []
        loose = np.empty((0, self._n))
        starts = idle = 0
        for _ in range(MOST_WAVES):
            z = self.system.seeds(WAVE, generator)
            starts += WAVE
            known = len(found)
            curved = self._curved(z)
            loose = np.concatenate([loose, z[~curved, : self._n]])[:_MOST_LOOSE]
            left = self._off(z[curved], found)
            while len(left):
                curve = self._curve(left[0])
                left = left[1:]
                if curve is not None:
                    # A seed where the equations are flat can lie beside a curve that is known.
                    if len(self._off(curve.q, found)) > _NEW * len(curve.q):
                        found.append(curve)
                    left = self._off(left, [curve])
            idle = 0 if len(found) > known else idle + 1
            advance(starts, starts + (PATIENCE - idle) * WAVE)  # if nothing new comes
            if idle == PATIENCE:
                break
        return found, wrapped(self.system.law.arm, loose), starts

    def _curved(self, z: Array) -> Flags:
        """(N,) whether the points near z (N, size) make one curve, and not a surface or one with several u for one q."""
        if not len(z):
            return np.zeros(0, dtype=bool)
        _, slopes = self.system.values(z)
        _, size, right = np.linalg.svd(slopes)
        return np.asarray(
            (size[:, -1] > _SURFACE * size[:, 0])
            & (np.linalg.norm(right[:, -1, : -2 - self.system.law.task.m], axis=1) > _SURFACE)
        )

    def _off(self, z: Array, curves: Sequence[Curve]) -> Array:
        """Those of z (N, size) that lie on none of the curves."""
        for curve in curves:
            if len(z):
                component = Component(
                    q=curve.q[:-1] if curve.closed else curve.q, closed=curve.closed, bounded_by=(None, None), length=0.0
                )
                z = z[distance_to_curve(self._arm, component, z[:, : self._n]) > _ON_CURVE * self.spacing]
        return z

    def _curve(self, seed: Array) -> Curve | None:
        start, tangent, sound = self._corrected(seed, None)
        if not sound:
            return None
        ahead, closed = self._follow(start, tangent)
        points = ahead
        if not closed:
            behind, _ = self._follow(start, -tangent)
            points = behind[:0:-1] + ahead
        if len(points) < 3:
            return None
        z = np.array(points)
        if not self.system.holds(z):
            return None
        constant = float(np.ptp(z[:, self.joint])) < _CONSTANT
        return marked(self.system, self.joint, z, closed, constant)

    def _follow(self, z: Array, tangent: Array) -> tuple[list[Array], bool]:
        """Points of the curve one way from z, and whether it came back to z."""
        points, start, first = [z], z, tangent
        step, length, bend = self.spacing, 0.0, np.zeros_like(z)
        sliding = self.system.law.arm.prismatic
        while length < _LONGEST:
            new, direction, sound = self._corrected(z + step * tangent + (step * step / 2) * bend, tangent)
            moved = float(np.linalg.norm(new - z))
            if not sound or direction @ tangent < _STRAIGHT or not 0.3 * step < moved < 1.7 * step:
                step /= 2
                if step < _SHORTEST * self.spacing:
                    break
                continue
            if len(points) > 2 and self._passes(start, first, z, new):
                points.append(self._same_turn(start, z))
                return points, True
            points.append(new)
            z, bend, tangent, length = new, (direction - tangent) / moved, direction, length + moved
            if np.abs(z[: self._n][sliding]).max(initial=0.0) > _FAR:
                break
            step = min(1.5 * step, self.spacing)
        return points, False

    def _corrected(self, z: Array, tangent: Array | None) -> tuple[Array, Array, bool]:
        """The point of the curve in the plane through z across the tangent, its unit tangent, and whether there is one.

        Without a tangent, the nearest point, with its tangent either way.
        """
        if tangent is None:
            values, slopes = self.system.values(z[None])
            tangent = np.zeros_like(z)
            tangent[self.system.active] = np.linalg.svd(slopes[0])[2][-1]
        active = self.system.active
        square = np.empty((active.size, active.size))
        right = np.zeros((active.size, 2))
        square[-1], right[-1, 1] = tangent[active], 1.0
        for _ in range(_NEWTON):
            values, slopes = self.system.values(z[None])
            square[:-1], right[:-1, 0] = slopes[0], values[0]
            try:
                step = np.linalg.solve(square, right)
            except np.linalg.LinAlgError:
                break
            if not np.isfinite(step).all():
                break
            if np.linalg.norm(values[0]) < TOLERANCE:
                direction = np.zeros_like(z)
                direction[active] = step[:, 1] / np.linalg.norm(step[:, 1])
                return z, direction, True
            z = z.copy()
            z[active] -= step[:, 0]
        return z, tangent, False

    def _passes(self, start: Array, first: Array, z: Array, new: Array) -> bool:
        """Whether the step from z to new passes the start, modulo whole turns, in its direction."""
        n = self._n
        step, gap = (new - z)[:n], self._difference(start[:n], z[:n])
        size = max(float(step @ step), 1e-30)
        share = float(gap @ step) / size
        across = float(np.linalg.norm(gap - share * step))
        return 0 < share <= 1 and across < 0.1 * np.sqrt(size) and float(first[:n] @ step) > 0

    def _same_turn(self, start: Array, z: Array) -> Array:
        """The start as the next point after z: in the same turn, with u, c and s of the same signs."""
        n = self._n
        q = z[:n] + self._difference(start[:n], z[:n])
        signs = itertools.product((1, -1), repeat=3)
        choices = [np.concatenate([q, a * start[n:-2], [b * start[-2], c * start[-1]]]) for a, b, c in signs]
        choices = [c for c in choices if np.linalg.norm(self.system.values(c[None])[0]) < 1e-8]
        return min(choices, key=lambda c: float(np.linalg.norm(c - z)))

    def _difference(self, a: Array, b: Array) -> Array:
        return np.asarray(wrapped(self.system.law.arm, a - b))
