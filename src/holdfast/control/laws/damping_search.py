"""The damping that minimises the peak velocity error over all single locked joints, as straight-line code of fixed length.

With ``J J' = V diag(sigma^2) V'``, ``c = V' u`` and ``s = lambda^2``, the damped inverse moves joint i at
``a_i(s) = sum_k (V' j_i)_k c_k / (sigma_k^2 + s)``, and the squared peak error is

    PKE^2 = s^2 |y|^2 + max_i a_i^2 (2 s + |j_i|^2),   y_k = c_k / (sigma_k^2 + s).

The healthy error ``s |y|`` increases with s, so the allowed error fixes the largest s. Below that, PKE may have several minima.
The search evaluates PKE^2 and its slope on a grid that is uniform in s near 0 and uniform in log s far from 0, because no term
varies faster than log s between the poles ``-sigma_k^2``. It refines the best cells in which the slope changes from negative
to positive: by the tangents at both ends if PKE has a kink (another joint becomes the worst), else by the secant of the slope.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, eq. (8), (9). The search is ours.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations, pairwise

import casadi as ca

from holdfast.control.laws.c_functions import fill_template
from holdfast.core.caching import cached_property
from holdfast.kernels import c_backend
from holdfast.kernels.linalg import Vector, damped_gram, dot_product, rotate_to_singular_rows, select_smallest, solve_spd
from holdfast.kernels.program import SX

SINGULAR_TOLERANCE = 1e-12  # fraction of the largest singular value up to which a singular value counts as 0
MIN_DAMPING = 1e-3  # damping where none is allowed, in the unit of the singular values
_JACOBI_SWEEPS = {1: 0, 2: 2, 3: 4, 4: 5, 5: 6, 6: 6}  # sweeps of Jacobi rotations for m rows; enough for rounding (measured)
_ORTHOGONAL_COSINE = 1e-13  # in C, a smaller cosine between two rows counts as 0
_CONVERGED_COSINE = 1e-8  # in C, if all cosines of a sweep are smaller, those of the next sweep count as 0
# Steps of the search for the largest damping; enough for rounding (measured).
_BISECTION_STEPS = 6
_NEWTON_STEPS = 4
_EDGE_FRACTION = 0.05  # fraction of a cell: least distance of the next point from its ends
_SMOOTH_FRACTION = 0.02  # fraction of a cell: tangents that meet this close to its middle belong to a parabola, not to a kink
_ROUNDING_BEND = 1e-11  # relative: if PKE^2 bends by less across a cell, rounding decides where its tangents meet
_FIRST_FRACTION = 0.2  # fraction of the smallest sigma^2 below which the grid is nearly uniform in s
_NEVER_VALUE = 1e300
_TINY_VALUE = 1e-200  # its square is 0; CasADi would carry a condition with a real 0 through every product
_SAME_ERROR_TOLERANCE = (
    1e-9  # relative: peak errors closer than this count as equal, and the last point of the refinement is used
)
_END_TOLERANCE = 1e-9  # relative: a damping this close to the largest one counts as the largest
_KINK_TOLERANCE = 1e-6  # relative: largest difference between the two largest errors at a kink
_FLAT_SLOPE = 1e-9  # of error / s: two slopes smaller than this count as 0; such joints always have the same error


@dataclass(frozen=True)
class DampingChoice:
    """Result of the search for the damping.

    Attributes:
        damping: Best damping lambda, in the unit of the singular values of J.
        largest: Largest damping that keeps the healthy error within the allowed one.
        feasible: 1, or 0 if no damping keeps it within the allowed one; both dampings are then :data:`MIN_DAMPING`.
        rates: (n,) joint rates ``J' (J J' + lambda^2 I)^-1 u``.
    """

    damping: SX
    largest: SX
    feasible: SX
    rates: Vector


def search_damping(j: SX, u: SX, allowed: SX | float) -> DampingChoice:
    """Search for the best damping for the task Jacobian J (m, n) and a direction u (m,) of norm 1.

    Directions that a singular J cannot produce count as error for every damping. The search is infeasible if J = 0 or if
    their error exceeds the allowed error.
    """
    m, n = j.shape
    rows, components, squares = rotate_to_singular_rows(
        [ca.horzsplit(j[row, :]) for row in range(m)], ca.vertsplit(ca.densify(u)), _JACOBI_SWEEPS[m]
    )
    columns = [dot_product(vector, vector) for vector in (ca.vertsplit(j[:, joint]) for joint in range(n))]
    largest_square = squares[0]
    for vector in squares[1:]:
        largest_square = _maximum(vector, largest_square)
    missing_error = ca.SX(0)
    for row in range(m):
        is_singular = squares[row] <= SINGULAR_TOLERANCE**2 * largest_square
        missing_error = missing_error + ca.if_else(is_singular, components[row] * components[row], 0.0)
        components[row] = ca.if_else(is_singular, _TINY_VALUE, components[row])
        squares[row] = ca.if_else(is_singular, ca.if_else(largest_square > 0, largest_square, 1.0), squares[row])
    peak_error = _PeakError(
        squares, components, [[entry * components[row] for entry in rows[row]] for row in range(m)], columns, missing_error
    )
    allowed_square = allowed * allowed - missing_error
    is_feasible = allowed_square > 0
    largest = _find_largest_squared_damping(
        squares, [vector * vector for vector in components], ca.if_else(is_feasible, allowed_square, 1.0)
    )
    squared_damping = ca.if_else(is_feasible, _minimise_error(peak_error, largest, m), MIN_DAMPING**2)
    largest_squared = ca.if_else(is_feasible, largest, MIN_DAMPING**2)
    return DampingChoice(
        ca.sqrt(squared_damping),
        ca.sqrt(largest_squared),
        ca.if_else(is_feasible, 1.0, 0.0),
        peak_error.compute_joint_rates(squared_damping),
    )


def generate_c_search(m: int, n: int, allowed: float) -> str:
    """Return the C99 text of the search for m rows and n joints, with loops that end as early as possible.

    ``static void damped_inverse(const double *j, const double *v, double *rates, double *damping, double *largest,
    double *feasible)`` takes J (m, n) row by row and a velocity v (m,) of any norm.
    """
    cell_count, refined_cells, rounds = _grid_sizes(m)
    counts = {"ROWS": m, "JOINTS": n, "WIDE": -(-n // 4) * 4, "CELLS": cell_count, "KEPT": refined_cells, "REFINED": rounds}
    counts |= {"SWEEPS": _JACOBI_SWEEPS[m], "BISECTIONS": _BISECTION_STEPS, "NEWTON": _NEWTON_STEPS}
    tolerances = {
        "ORTHOGONAL": _ORTHOGONAL_COSINE,
        "CONVERGED": _CONVERGED_COSINE,
        "SINGULAR": SINGULAR_TOLERANCE,
        "FLOOR": MIN_DAMPING,
        "ALLOWED": allowed,
    }
    tolerances |= {
        "EDGE": _EDGE_FRACTION,
        "SMOOTH": _SMOOTH_FRACTION,
        "ROUGH": _ROUNDING_BEND,
        "SAME": _SAME_ERROR_TOLERANCE,
        "FIRST": _FIRST_FRACTION,
    }
    replacements = {key: str(value) for key, value in counts.items()} | {
        key: c_backend.c_number(value) for key, value in tolerances.items()
    }
    # Pairs of rows with equal index sums modulo m have no row in common, so a processor can overlap their rotations.
    row_pairs = sorted(combinations(range(m), 2), key=lambda pair: sum(pair) % m) or [(0, 0)]
    replacements["NUMBER_OF_PAIRS"] = str(len(row_pairs))
    replacements["PAIRS"] = ", ".join(f"{{{first}, {second}}}" for first, second in row_pairs)
    sum_terms = {"RATE": "f->rows[#][i] * r[#]", "HEALTHY": "squares[#]", "TURNING": "squares[#] * r[#] * f->squares[#]"}
    sum_terms["STEEP"] = "f->rows[#][worst] * r[#] * r[#]"
    replacements |= {key: " + ".join(value.replace("#", str(k)) for k in range(m)) for key, value in sum_terms.items()}
    replacements["PRODUCTS"] = " + ".join(f"a[k + {column}] * b[k + {column}]" for column in range(0, n, 4))
    return fill_template(
        "holdfast.control.laws", "c", "damping_search.c", {f"CONST_{key}": value for key, value in replacements.items()}
    )


def _grid_sizes(m: int) -> tuple[int, int, int]:
    """Return the number of grid cells for m rows, the number of refined cells, and the rounds of refinement."""
    return (16, 1 if m < 3 else 2, 12) if m <= 3 else (32, 2, 9)


def differentiate_damped_rates(j: SX, v: SX, allowed: float, result: dict[str, SX], symbols: SX) -> SX:
    """Return the derivatives (n, k) of ``J' (J J' + s I)^-1 v`` without differentiating the search.

    At the result of the search one of three equations holds: the healthy error equals the allowed error, the errors of two
    joints are equal (a kink), or the slope of the worst error is 0. The implicit function theorem then yields the derivative
    of s. If the best damping is 0 or no damping is feasible, s is constant.

    Args:
        j: (m, n) task Jacobian, an expression of ``symbols``.
        v: (m,) task velocity, an expression of ``symbols``.
        allowed: Allowed error of the healthy arm for the unit velocity.
        result: ``damping``, ``largest_damping`` and ``feasible`` from the search.
        symbols: (k,) symbols.
    """
    n, k = j.shape[1], symbols.numel()
    # Symbols stand for the quantities that are not differentiated; they are substituted at the end.
    s, is_at_end, is_following, is_kink = (ca.SX.sym(name) for name in ("s", "ends", "follows", "kink"))
    worst, second_worst = ca.SX.sym("top", n), ca.SX.sym("other", n)
    y = ca.vertcat(*solve_spd(damped_gram(j, s), ca.vertsplit(ca.densify(v))))
    rates = j.T @ y
    healthy = s * s * ca.sumsqr(y)
    errors = healthy + rates * rates * (2 * s + ca.sum1(j * j).T)
    error_slopes = ca.jacobian(errors, s)
    turning_condition = ca.if_else(is_kink, ca.dot(worst - second_worst, errors), ca.dot(worst, error_slopes))
    condition = ca.if_else(is_at_end, healthy - allowed**2 * ca.sumsqr(v), turning_condition)
    change = ca.jacobian(condition, ca.vertcat(symbols, s))
    damping_derivative = ca.if_else(ca.logic_and(is_following, change[k] != 0), -change[:k] / change[k], 0.0)
    derivatives = ca.jacobian(rates, symbols) + ca.jacobian(rates, s) @ damping_derivative

    worst_joint, largest_error, largest_slope = _select_largest_joint(errors, errors, error_slopes)
    crossing = [
        ca.if_else(joint_slope * largest_slope < 0, joint_error, 0.0)
        for joint_slope, joint_error in zip(ca.vertsplit(error_slopes), ca.vertsplit(errors), strict=True)
    ]
    second_joint, second_error, second_slope = _select_largest_joint(ca.vertcat(*crossing), errors, error_slopes)
    is_near_kink = ca.logic_and(
        second_error > largest_error * (1 - _KINK_TOLERANCE),
        -largest_slope * second_slope * s * s > (_FLAT_SLOPE * largest_error) ** 2,
    )
    derivatives = ca.substitute(
        derivatives, ca.vertcat(worst, second_worst, is_kink), ca.vertcat(worst_joint, second_joint, is_near_kink)
    )
    is_largest = result["damping"] >= result["largest_damping"] * (1 - _END_TOLERANCE)
    is_changing = ca.logic_and(result["feasible"], result["damping"] > 0)
    return ca.substitute(
        derivatives, ca.vertcat(s, is_at_end, is_following), ca.vertcat(result["damping"] ** 2, is_largest, is_changing)
    )


def _select_largest_joint(sizes: SX, errors: SX, slopes_by_joint: SX) -> tuple[SX, SX, SX]:
    """Return a selection (n,) that is 1 at the largest size and 0 elsewhere, with the error and slope selected by it."""
    largest, largest_index = sizes[0], ca.SX(0)
    for index in range(1, sizes.numel()):
        is_larger = sizes[index] > largest
        largest, largest_index = ca.if_else(is_larger, sizes[index], largest), ca.if_else(is_larger, index, largest_index)
    selection = ca.vertcat(*[largest_index == index for index in range(sizes.numel())])
    return selection, ca.dot(selection, errors), ca.dot(selection, slopes_by_joint)


@dataclass(frozen=True)
class _PeakError:
    """``PKE^2`` as a function of s = lambda^2, from sigma_k^2, c, the products ``(V' j_i)_k c_k`` (m, n), and ``|j_i|^2``."""

    squares: Vector
    c: Vector
    products: list[Vector]
    columns: Vector
    missing_error: SX

    def compute_joint_rates(self, s: SX) -> Vector:
        r = [1 / (square + s) for square in self.squares]
        return self._weight_products(r)

    def _weight_products(self, r: Vector) -> Vector:
        return [dot_product([products[joint] for products in self.products], r) for joint in range(len(self.columns))]

    def __call__(self, s: SX) -> tuple[SX, SX]:
        """Return the value and the slope at s."""
        value, slope = self._value_slope_function(s, *self._function_arguments)
        return value, slope

    @cached_property
    def _function_arguments(self) -> list[SX]:
        return [ca.vertcat(*vector) for vector in (self.squares, self.c, *self.products, self.columns)] + [self.missing_error]

    @cached_property
    def _value_slope_function(self) -> ca.Function:
        """CasADi function for value and slope, built once because building it in each of 50 calls would be slow."""
        symbols = [ca.SX.sym("x", len(vector)) for vector in (self.squares, self.c, *self.products, self.columns)]
        squares, c, *products, columns = ([*ca.vertsplit(vector)] for vector in symbols)
        s, missing = ca.SX.sym("s"), ca.SX.sym("missing")
        expressions = _PeakError(squares, c, products, columns, missing)._build_value_slope(s)
        return ca.Function("error", [s, *symbols, missing], expressions)

    def _build_value_slope(self, s: SX) -> tuple[SX, SX]:
        r = [1 / (item + s) for item in self.squares]
        squared_weights = [item * item for item in r]
        doubled = s + s
        value = slope = ca.SX(0)
        for joint, (a, b) in enumerate(zip(self._weight_products(r), self._weight_products(squared_weights), strict=True)):
            weight = doubled + self.columns[joint]
            joint_error = a * a * weight
            joint_slope = 2 * a * (a - b * weight)
            is_larger = joint_error > value
            value, slope = (
                (joint_error, joint_slope)
                if joint == 0
                else (ca.if_else(is_larger, joint_error, value), ca.if_else(is_larger, joint_slope, slope))
            )
        healthy_terms = [item * item * other for item, other in zip(self.c, squared_weights, strict=True)]
        healthy_slope = dot_product(healthy_terms, [item * other for item, other in zip(r, self.squares, strict=True)])
        return self.missing_error + s * s * dot_product(
            healthy_terms, [ca.SX(1)] * len(r)
        ) + value, doubled * healthy_slope + slope


def _find_largest_squared_damping(squares: Vector, squared_parts: Vector, allowed_square: SX) -> SX:
    """Return the s at which the squared healthy error ``sum parts s^2 / (sigma^2 + s)^2`` is ``allowed_square``.

    As a function of ``t = 1/s``, the reciprocal of the error is concave and nearly linear (as in the trust-region equation), so
    Newton's method from the left never overshoots the root. Bounds from the parts up to and below each singular value, and
    bisections of the logarithm, come first because Newton's method alone is slow if the singular values differ widely.
    """
    m, total = len(squares), dot_product(squared_parts, [ca.SX(1)] * len(squared_parts))
    lower_bounds, upper_bounds = [], []
    for index in range(m):
        sum_below = ca.SX(0)
        for square, part in zip(squares, squared_parts, strict=True):
            sum_below = sum_below + ca.if_else(square < squares[index], part, 0.0)
        sum_up_to = ca.SX(0)
        for square, part in zip(squares, squared_parts, strict=True):
            sum_up_to = sum_up_to + ca.if_else(square <= squares[index], part, 0.0)
        lower_bounds.append((ca.sqrt(sum_up_to / allowed_square) - 1) / squares[index])
        remainder = allowed_square - sum_below
        is_positive = remainder > 0
        upper_bound = (ca.sqrt((total - sum_below) / ca.if_else(is_positive, remainder, 1.0)) - 1) / squares[index]
        upper_bounds.append(ca.if_else(is_positive, upper_bound, _NEVER_VALUE))
    lower, upper = lower_bounds[0], select_smallest(upper_bounds)
    for square in lower_bounds[1:]:
        lower = _maximum(square, lower)
    for _ in range(_BISECTION_STEPS):
        middle = ca.sqrt(lower * upper)
        error = dot_product(squared_parts, [1 / ((1 + middle * square) * (1 + middle * square)) for square in squares])
        is_too_small = error > allowed_square
        lower, upper = ca.if_else(is_too_small, middle, lower), ca.if_else(is_too_small, upper, middle)
    t, target_value = lower, 1 / ca.sqrt(allowed_square)
    for _ in range(_NEWTON_STEPS):
        inverses = [1 / (1 + t * square) for square in squares]
        terms = [part * square * square for part, square in zip(squared_parts, inverses, strict=True)]
        error = dot_product(terms, [ca.SX(1)] * m)
        derivative = dot_product(terms, [square * factor for square, factor in zip(inverses, squares, strict=True)])
        error_norm = ca.sqrt(error)
        t = t + (target_value - 1 / error_norm) * error_norm * error / derivative
    return 1 / t


def _minimise_error(error: _PeakError, largest: SX, m: int) -> SX:
    cell_count, refined_cells, rounds = _grid_sizes(m)
    # The grid points are s = first_step (ratio^k - 1), from 0 to the largest.
    first_step = _maximum(_FIRST_FRACTION * select_smallest(error.squares), 1e-12 * largest)
    first_step = ca.if_else(first_step < largest / 3, first_step, largest / 3)
    ratio = ca.exp(ca.log(1 + largest / first_step) / cell_count)
    points, power = [ca.SX(0)], ca.SX(1)
    for _ in range(cell_count - 1):
        power = power * ratio
        points.append(first_step * (power - 1))
    points.append(largest)
    values = [(s, *error(s)) for s in points]
    best_point, least_value = values[0][0], values[0][1]
    for s, value, _ in values[1:]:
        is_better = value < least_value
        best_point, least_value = ca.if_else(is_better, s, best_point), ca.if_else(is_better, value, least_value)
    estimates = [_estimate_minimum(*a, *b) for a, b in pairwise(values)]
    for refinement in range(refined_cells):
        lowest, lowest_index, lowest_cell = estimates[0], ca.SX(0), [*values[0], *values[1]]
        for index in range(1, cell_count):
            is_better = estimates[index] < lowest
            candidate = [*values[index], *values[index + 1]]
            lowest, lowest_index = ca.if_else(is_better, estimates[index], lowest), ca.if_else(is_better, index, lowest_index)
            lowest_cell = [ca.if_else(is_better, x, y) for x, y in zip(candidate, lowest_cell, strict=True)]
        if refinement < refined_cells - 1:
            estimates = [ca.if_else(lowest_index == index, _NEVER_VALUE, x) for index, x in enumerate(estimates)]
        has_minimum = lowest < _NEVER_VALUE
        refined = _refine_minimum(error, lowest_cell, best_point, least_value, rounds)
        best_point, least_value = (
            ca.if_else(has_minimum, x, y) for x, y in zip(refined, (best_point, least_value), strict=True)
        )
    return best_point


def _estimate_minimum(a: SX, fa: SX, ga: SX, b: SX, fb: SX, gb: SX) -> SX:
    """Return the value where the tangents at both ends of a cell meet, if the slope changes from negative to positive."""
    has_minimum = ca.logic_and(ga < 0, gb > 0)
    return ca.if_else(has_minimum, fa + ga * _tangent_crossing_offset(a, fa, ga, b, fb, gb), _NEVER_VALUE)


def _tangent_crossing_offset(a: SX, fa: SX, ga: SX, b: SX, fb: SX, gb: SX) -> SX:
    """Return the distance from a at which the tangents at a and b meet: the middle of a parabola, or a kink of two lines."""
    slope_change = gb - ga
    return (fa - fb + gb * (b - a)) / ca.if_else(slope_change > 0, slope_change, _NEVER_VALUE)


def _refine_minimum(error: _PeakError, cell: Vector, best_point: SX, least_value: SX, rounds: int) -> tuple[SX, SX]:
    a, fa, ga, b, fb, gb = cell
    x, value = best_point, least_value
    for round_number in range(rounds):
        edge_fraction = _EDGE_FRACTION if round_number < rounds - 1 else 0.0  # the last point may lie anywhere in the cell
        width, slope_change = b - a, gb - ga
        intersection = _tangent_crossing_offset(a, fa, ga, b, fb, gb)
        # The slope of a parabola is 0 here.
        parabola_minimum = -ga * width / ca.if_else(slope_change > 0, slope_change, _NEVER_VALUE)
        # In a cell so narrow that its values differ by rounding alone, only the slopes locate the minimum.
        is_smooth = ca.logic_or(
            ca.fabs(intersection - width / 2) < _SMOOTH_FRACTION * width, slope_change * width < _ROUNDING_BEND * fa
        )
        step = _maximum(ca.if_else(is_smooth, parabola_minimum, intersection), edge_fraction * width)
        x = a + ca.if_else(step < (1 - edge_fraction) * width, step, (1 - edge_fraction) * width)
        value, slope = error(x)
        is_better = value < least_value
        best_point, least_value = ca.if_else(is_better, x, best_point), ca.if_else(is_better, value, least_value)
        is_rising = slope > 0
        a, fa, ga = (ca.if_else(is_rising, old_value, new_value) for old_value, new_value in ((a, x), (fa, value), (ga, slope)))
        b, fb, gb = (ca.if_else(is_rising, new_value, old_value) for old_value, new_value in ((b, x), (fb, value), (gb, slope)))
    # Values this close differ by rounding alone, so choosing by value would change the damping by the root of the rounding.
    uses_last = value <= least_value * (1 + _SAME_ERROR_TOLERANCE)
    return ca.if_else(uses_last, x, best_point), ca.if_else(uses_last, value, least_value)


def _maximum(a: SX, b: SX) -> SX:
    return ca.if_else(a > b, a, b)
