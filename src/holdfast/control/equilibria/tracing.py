"""Tracing of curves of erroneous rest over the value of one locked joint, by a tangent predictor and a corrector.

Source: Goel, Maciejewski, Balakrishnan 2005, section on tracing stationary manifolds. With the equations used here, the curves
pass smoothly through the target and through configurations at which J loses rank.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from holdfast.control.equilibria.curves import Curves, EquilibriumCurve
from holdfast.control.equilibria.equations import EQUATION_TOLERANCE
from holdfast.control.equilibria.events import make_curve_with_events
from holdfast.control.equilibria.points import classify_points
from holdfast.control.equilibria.system import RestSystem, wrap_angles
from holdfast.control.laws.law import Law
from holdfast.core.progress import Progress, ignore_progress
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kinematics.solvers.curve_tracing import Component, distance_to_curve

CURVE_SPACING = 0.04  # distance of consecutive points in the unknowns, rad and m
WAVE_STARTS = 128
MAX_IDLE_WAVES = 3
MAX_WAVES = 30
_CORRECTOR_STEPS = 6
_MIN_STEP_FRACTION = 2.0**-12  # fraction of the spacing; the curve ends if no longer step succeeds
_MIN_TANGENT_COSINE = 0.97  # least cosine between tangents at the two ends of a step
_MAX_LENGTH_RAD = 200.0  # rad: longer curves are cut
_MAX_TRAVEL_M = 50.0  # m: the curve ends if a prismatic joint exceeds it
_ON_CURVE_FRACTION = 0.15  # fraction of the spacing: a seed closer than this to a traced curve lies on it
_SURFACE_TOLERANCE = 1e-6  # fraction of the largest singular value; points with a smaller one are not on a single curve
_MAX_LOOSE_POINTS = 512
_NEW_FRACTION = 0.2  # least fraction of a curve's points that must lie on no other curve
_CONSTANT_TOLERANCE = 1e-6  # rad (and m): a locked value that changes less along a whole curve is constant


def trace_curves(
    law: Law,
    pose: FloatArray,
    joint: int,
    seed: int = 0,
    spacing: float = CURVE_SPACING,
    report_progress: Progress = ignore_progress,
) -> Curves:
    """Trace all curves of erroneous rest that random starts find; see :func:`holdfast.control.equilibria.stationary_points`."""
    system = RestSystem(law, pose, (joint,))
    tracer = RestCurveTracer(system, joint, spacing)
    curves, loose_points, starts = tracer.find_curves(np.random.default_rng(seed), report_progress)
    return Curves(
        law=law,
        target=pose,
        joint=joint,
        curves=tuple(curves),
        loose=classify_points(system, np.array([np.nan]), loose_points, starts),
        starts=starts,
        _system=system,
    )


class RestCurveTracer:
    """Tracer of the curves of one law, target, and locked joint."""

    def __init__(self, system: RestSystem, joint: int, spacing: float) -> None:
        self.system, self.joint, self.spacing = system, joint, spacing
        self._arm = system.law.arm.without_limits
        self._n = system.law.arm.n

    def find_curves(
        self, generator: np.random.Generator, report_progress: Progress = ignore_progress
    ) -> tuple[list[EquilibriumCurve], FloatArray, int]:
        """Return the curves to which starts converge, in waves until some add none, the points on no curve, and the starts."""
        curves: list[EquilibriumCurve] = []
        loose_points = np.empty((0, self._n))
        starts = idle_waves = 0
        for _ in range(MAX_WAVES):
            z = self.system.find_resting_unknowns(WAVE_STARTS, generator)
            starts += WAVE_STARTS
            known_count = len(curves)
            is_on_curve = self._is_on_curve(z)
            loose_points = np.concatenate([loose_points, z[~is_on_curve, : self._n]])[:_MAX_LOOSE_POINTS]
            remaining = self._select_off_curves(z[is_on_curve], curves)
            while len(remaining):
                curve = self._trace_curve(remaining[0])
                remaining = remaining[1:]
                if curve is not None:
                    # Where the equations are flat, a seed can lie next to a known curve.
                    if len(self._select_off_curves(curve.q, curves)) > _NEW_FRACTION * len(curve.q):
                        curves.append(curve)
                    remaining = self._select_off_curves(remaining, [curve])
            idle_waves = 0 if len(curves) > known_count else idle_waves + 1
            report_progress(starts, starts + (MAX_IDLE_WAVES - idle_waves) * WAVE_STARTS)  # if the next waves add none
            if idle_waves == MAX_IDLE_WAVES:
                break
        return curves, wrap_angles(self.system.law.arm, loose_points), starts

    def _is_on_curve(self, z: FloatArray) -> BoolArray:
        """Return a mask of the z (N, size) near which points form one curve, not a surface, and with a single u for each q."""
        if not len(z):
            return np.zeros(0, dtype=bool)
        _, jacobian = self.system.evaluate_equations(z)
        _, singular_values, right_vectors = np.linalg.svd(jacobian)
        return np.asarray(
            (singular_values[:, -1] > _SURFACE_TOLERANCE * singular_values[:, 0])
            & (np.linalg.norm(right_vectors[:, -1, : -2 - self.system.law.task.m], axis=1) > _SURFACE_TOLERANCE)
        )

    def _select_off_curves(self, z: FloatArray, curves: Sequence[EquilibriumCurve]) -> FloatArray:
        """Select the unknowns of z (N, size) that lie on none of the curves."""
        for curve in curves:
            if len(z):
                component = Component(
                    q=curve.q[:-1] if curve.closed else curve.q, closed=curve.closed, bounded_by=(None, None), length=0.0
                )
                z = z[distance_to_curve(self._arm, component, z[:, : self._n]) > _ON_CURVE_FRACTION * self.spacing]
        return z

    def _trace_curve(self, seed: FloatArray) -> EquilibriumCurve | None:
        start, tangent, is_found = self._correct_point(seed, None)
        if not is_found:
            return None
        forward_points, closed = self._follow_curve(start, tangent)
        points = forward_points
        if not closed:
            backward_points, _ = self._follow_curve(start, -tangent)
            points = backward_points[:0:-1] + forward_points
        if len(points) < 3:
            return None
        z = np.array(points)
        if not self.system.is_law_at_rest(z):
            return None
        is_constant = float(np.ptp(z[:, self.joint])) < _CONSTANT_TOLERANCE
        return make_curve_with_events(self.system, self.joint, z, closed, is_constant)

    def _follow_curve(self, z: FloatArray, tangent: FloatArray) -> tuple[list[FloatArray], bool]:
        """Return the points of the curve in one direction from z, and whether it returned to z."""
        points, start, start_tangent = [z], z, tangent
        step, length, curvature = self.spacing, 0.0, np.zeros_like(z)
        is_prismatic = self.system.law.arm.prismatic
        while length < _MAX_LENGTH_RAD:
            next_point, direction, is_found = self._correct_point(z + step * tangent + (step * step / 2) * curvature, tangent)
            distance = float(np.linalg.norm(next_point - z))
            if not is_found or direction @ tangent < _MIN_TANGENT_COSINE or not 0.3 * step < distance < 1.7 * step:
                step /= 2
                if step < _MIN_STEP_FRACTION * self.spacing:
                    break
                continue
            if len(points) > 2 and self._passes_start(start, start_tangent, z, next_point):
                points.append(self._nearest_equivalent_start(start, z))
                return points, True
            points.append(next_point)
            z, curvature, tangent, length = next_point, (direction - tangent) / distance, direction, length + distance
            if np.abs(z[: self._n][is_prismatic]).max(initial=0.0) > _MAX_TRAVEL_M:
                break
            step = min(1.5 * step, self.spacing)
        return points, False

    def _correct_point(self, z: FloatArray, tangent: FloatArray | None) -> tuple[FloatArray, FloatArray, bool]:
        """Return the point of the curve in the plane through z normal to the tangent, its unit tangent, and whether it exists.

        Without a tangent, the point is the nearest one, and the sign of its tangent is arbitrary.
        """
        if tangent is None:
            values, jacobian = self.system.evaluate_equations(z[None])
            tangent = np.zeros_like(z)
            tangent[self.system.active] = np.linalg.svd(jacobian[0])[2][-1]
        active = self.system.active
        matrix = np.empty((active.size, active.size))
        right_sides = np.zeros((active.size, 2))
        matrix[-1], right_sides[-1, 1] = tangent[active], 1.0
        for _ in range(_CORRECTOR_STEPS):
            values, jacobian = self.system.evaluate_equations(z[None])
            matrix[:-1], right_sides[:-1, 0] = jacobian[0], values[0]
            try:
                step = np.linalg.solve(matrix, right_sides)
            except np.linalg.LinAlgError:
                break
            if not np.isfinite(step).all():
                break
            if np.linalg.norm(values[0]) < EQUATION_TOLERANCE:
                direction = np.zeros_like(z)
                direction[active] = step[:, 1] / np.linalg.norm(step[:, 1])
                return z, direction, True
            z = z.copy()
            z[active] -= step[:, 0]
        return z, tangent, False

    def _passes_start(self, start: FloatArray, start_tangent: FloatArray, z: FloatArray, next_point: FloatArray) -> bool:
        """Return True if the step from z to ``next_point`` passes the start, modulo full turns, in its direction."""
        n = self._n
        step, difference = (next_point - z)[:n], self._joint_difference(start[:n], z[:n])
        squared_length = max(float(step @ step), 1e-30)
        fraction = float(difference @ step) / squared_length
        lateral_distance = float(np.linalg.norm(difference - fraction * step))
        return 0 < fraction <= 1 and lateral_distance < 0.1 * np.sqrt(squared_length) and float(start_tangent[:n] @ step) > 0

    def _nearest_equivalent_start(self, start: FloatArray, z: FloatArray) -> FloatArray:
        """Return the start as the next point after z, in the same turn and with the same signs of u, c, and s."""
        n = self._n
        q = z[:n] + self._joint_difference(start[:n], z[:n])
        signs = itertools.product((1, -1), repeat=3)
        choices = [
            np.concatenate([q, first_sign * start[n:-2], [second_sign * start[-2], choice * start[-1]]])
            for first_sign, second_sign, choice in signs
        ]
        choices = [choice for choice in choices if np.linalg.norm(self.system.evaluate_equations(choice[None])[0]) < 1e-8]
        return min(choices, key=lambda choice: float(np.linalg.norm(choice - z)))

    def _joint_difference(self, a: FloatArray, b: FloatArray) -> FloatArray:
        return np.asarray(wrap_angles(self.system.law.arm, a - b))
