"""The damping that minimises the peak velocity error over all single locked joints, as straight-line code of fixed length.

With ``J J' = V diag(sigma^2) V'``, ``c = V' u`` and ``s = lambda^2``, the damped inverse moves joint i at
``a_i(s) = sum_k (V' j_i)_k c_k / (sigma_k^2 + s)``, and the squared peak error is

    PKE^2 = s^2 |y|^2 + max_i a_i^2 (2 s + |j_i|^2),   y_k = c_k / (sigma_k^2 + s).

The healthy error ``s |y|`` grows with s, so the allowed one fixes the largest s; below it PKE may have several minima. The
search evaluates PKE^2 and its slope on a grid that is even in s near 0 and in log s far from it, because nothing changes
faster than log s does between the poles ``-sigma_k^2``, and refines the best cells in which the slope turns from down to up,
by the tangents at both ends if PKE has a kink there (another joint becomes the worst), else by the secant of the slope.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, eq. (8), (9). The search is ours.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations, pairwise

import casadi as ca

from holdfast.caching import cached_property
from holdfast.control.c_functions import filled
from holdfast.kernels import c_backend
from holdfast.kernels.program import SX
from holdfast.linalg import Vector, dot, gram, singular_rows, smallest, solve_spd

SINGULAR = 1e-12  # of the largest singular value: at most this counts as 0
FLOOR = 1e-3  # damping where none is allowed, in the unit of the singular values
_SWEEPS = {1: 0, 2: 2, 3: 4, 4: 5, 5: 6, 6: 6}  # of Jacobi rotations, by m: to rounding (measured)
_ORTHOGONAL = 1e-13  # in C a cosine between two rows that is less is 0
_CONVERGED = 1e-8  # in C so are all of the next sweep, if those of this one were less
_BISECTIONS, _NEWTON = 6, 4  # for the largest damping: to rounding (measured)
_EDGE = 0.05  # of a cell: the next point keeps this far from its ends
_SMOOTH = 0.02  # of a cell: tangents that meet this close to its middle belong to a parabola rather than to a kink
_ROUGH = 1e-11  # relative: the tangents of a cell across which PKE^2 bends by less meet at a place made of rounding
_FIRST = 0.2  # of the smallest sigma^2: below about this the grid is even in s
_NEVER = 1e300
_NOTHING = 1e-200  # its square is 0; CasADi would carry a condition with a real 0 through every product
_SAME = 1e-9  # relative: two peak errors closer than this are one, and the last point of the refinement is taken
_END = 1e-9  # relative: a damping as near to the largest is that
_KINK = 1e-6  # relative: as near is the second error to the first at a kink
_FLAT = 1e-9  # of error / s: two slopes smaller than this are both 0, of joints that always share their error


@dataclass(frozen=True)
class Choice:
    """What the search found.

    Attributes:
        damping: lambda, in the unit of the singular values of J.
        largest: The largest damping within the allowed healthy error.
        feasible: 1, or 0 where no damping is within it; both dampings are then :data:`FLOOR`.
        rates: (n,) ``J' (J J' + lambda^2 I)^-1 u``.
    """

    damping: SX
    largest: SX
    feasible: SX
    rates: Vector


def search(j: SX, u: SX, allowed: SX | float) -> Choice:
    """The best damping for the task Jacobian J (m, n) and a direction u (m,) of norm 1.

    Directions that a singular J cannot produce count as error whatever the damping; J = 0 or an allowed error that is
    less than theirs is not feasible.
    """
    m, n = j.shape
    rows, c, squares = singular_rows([ca.horzsplit(j[k, :]) for k in range(m)], ca.vertsplit(ca.densify(u)), _SWEEPS[m])
    columns = [dot(x, x) for x in (ca.vertsplit(j[:, i]) for i in range(n))]
    top = squares[0]
    for x in squares[1:]:
        top = _larger(x, top)
    missing = ca.SX(0)
    for k in range(m):
        none = squares[k] <= SINGULAR**2 * top
        missing = missing + ca.if_else(none, c[k] * c[k], 0.0)
        c[k] = ca.if_else(none, _NOTHING, c[k])
        squares[k] = ca.if_else(none, ca.if_else(top > 0, top, 1.0), squares[k])
    error = _PeakError(squares, c, [[r * c[k] for r in rows[k]] for k in range(m)], columns, missing)
    room = allowed * allowed - missing
    feasible = room > 0
    largest = _largest(squares, [x * x for x in c], ca.if_else(feasible, room, 1.0))
    s = ca.if_else(feasible, _minimise(error, largest, m), FLOOR**2)
    end = ca.if_else(feasible, largest, FLOOR**2)
    return Choice(ca.sqrt(s), ca.sqrt(end), ca.if_else(feasible, 1.0, 0.0), error.rates(s))


def in_c(m: int, n: int, allowed: float) -> str:
    """C99 text of the same search for m rows and n joints, in loops that end where there is nothing left to do.

    ``static void damped_inverse(const double *j, const double *v, double *rates, double *damping, double *largest,
    double *feasible)`` takes J (m, n) row by row and a velocity v (m,) of any norm.
    """
    cells, kept, rounds = _grid(m)
    counts = {"ROWS": m, "JOINTS": n, "WIDE": -(-n // 4) * 4, "CELLS": cells, "KEPT": kept, "REFINED": rounds}
    counts |= {"SWEEPS": _SWEEPS[m], "BISECTIONS": _BISECTIONS, "NEWTON": _NEWTON}
    sizes = {"ORTHOGONAL": _ORTHOGONAL, "CONVERGED": _CONVERGED, "SINGULAR": SINGULAR, "FLOOR": FLOOR, "ALLOWED": allowed}
    sizes |= {"EDGE": _EDGE, "SMOOTH": _SMOOTH, "ROUGH": _ROUGH, "SAME": _SAME, "FIRST": _FIRST}
    words = {key: str(x) for key, x in counts.items()} | {key: c_backend.number(x) for key, x in sizes.items()}
    # Pairs of rows of the same sum, modulo m, have no row in common: a processor need not wait for one to begin another.
    pairs = sorted(combinations(range(m), 2), key=lambda pair: sum(pair) % m) or [(0, 0)]
    words["PAIRS"] = ", ".join(f"{{{a}, {b}}}" for a, b in pairs)
    sums = {"RATE": "f->rows[#][i] * r[#]", "HEALTHY": "squares[#]", "TURNING": "squares[#] * r[#] * f->squares[#]"}
    sums["STEEP"] = "f->rows[#][worst] * r[#] * r[#]"
    words |= {key: " + ".join(x.replace("#", str(k)) for k in range(m)) for key, x in sums.items()}
    words["PRODUCTS"] = " + ".join(f"a[k + {i}] * b[k + {i}]" for i in range(0, n, 4))
    return filled("holdfast.control", "c", "damping_search.c", {f"CONST_{key}": x for key, x in words.items()})


def _grid(m: int) -> tuple[int, int, int]:
    """Cells of the grid for m rows, how many are refined, and in how many rounds."""
    return (16, 1 if m < 3 else 2, 12) if m <= 3 else (32, 2, 9)


def slopes(j: SX, v: SX, allowed: float, found: dict[str, SX], by: SX) -> SX:
    """Derivatives (n, k) of ``J' (J J' + s I)^-1 v``, without differentiating the search.

    Where it has ended one of three equations holds, and by the implicit function theorem tells how s changes: the healthy
    error is the allowed one, the errors of two joints are the same (a kink), or the slope of the worst error is 0. Where no
    damping is best, or none is allowed, s stays.

    Args:
        j: (m, n) task Jacobian, an expression of ``by``.
        v: (m,) task velocity, an expression of ``by``.
        allowed: Error of the healthy arm for the unit velocity.
        found: ``damping``, ``largest_damping`` and ``feasible`` there, as the search has them.
        by: (k,) symbols.
    """
    n, k = j.shape[1], by.numel()
    # Symbols stand for what is not differentiated, until the end.
    s, ends, follows, kink = (ca.SX.sym(name) for name in ("s", "ends", "follows", "kink"))
    top, other = ca.SX.sym("top", n), ca.SX.sym("other", n)
    y = ca.vertcat(*solve_spd(gram(j, s), ca.vertsplit(ca.densify(v))))
    rates = j.T @ y
    healthy = s * s * ca.sumsqr(y)
    errors = healthy + rates * rates * (2 * s + ca.sum1(j * j).T)
    steep = ca.jacobian(errors, s)
    turning = ca.if_else(kink, ca.dot(top - other, errors), ca.dot(top, steep))
    condition = ca.if_else(ends, healthy - allowed**2 * ca.sumsqr(v), turning)
    change = ca.jacobian(condition, ca.vertcat(by, s))
    through = ca.if_else(ca.logic_and(follows, change[k] != 0), -change[:k] / change[k], 0.0)
    out = ca.jacobian(rates, by) + ca.jacobian(rates, s) @ through

    first, most, slope = _chosen(errors, errors, steep)
    crossing = [ca.if_else(x * slope < 0, e, 0.0) for x, e in zip(ca.vertsplit(steep), ca.vertsplit(errors), strict=True)]
    second, next_most, opposite = _chosen(ca.vertcat(*crossing), errors, steep)
    near = ca.logic_and(next_most > most * (1 - _KINK), -slope * opposite * s * s > (_FLAT * most) ** 2)
    out = ca.substitute(out, ca.vertcat(top, other, kink), ca.vertcat(first, second, near))
    end = found["damping"] >= found["largest_damping"] * (1 - _END)
    moves = ca.logic_and(found["feasible"], found["damping"] > 0)
    return ca.substitute(out, ca.vertcat(s, ends, follows), ca.vertcat(found["damping"] ** 2, end, moves))


def _chosen(sizes: SX, errors: SX, steep: SX) -> tuple[SX, SX, SX]:
    """Which of the sizes (n,) is the largest, as 0 and 1 (n,); its error and slope."""
    best, at = sizes[0], ca.SX(0)
    for k in range(1, sizes.numel()):
        more = sizes[k] > best
        best, at = ca.if_else(more, sizes[k], best), ca.if_else(more, k, at)
    chosen = ca.vertcat(*[at == k for k in range(sizes.numel())])
    return chosen, ca.dot(chosen, errors), ca.dot(chosen, steep)


@dataclass(frozen=True)
class _PeakError:
    """``PKE^2`` of s = lambda^2: squared singular values, c, the products ``(V' j_i)_k c_k`` (m, n), ``|j_i|^2``."""

    squares: Vector
    c: Vector
    products: list[Vector]
    columns: Vector
    missing: SX

    def rates(self, s: SX) -> Vector:
        r = [1 / (x + s) for x in self.squares]
        return self._along(r)

    def _along(self, r: Vector) -> Vector:
        return [dot([row[i] for row in self.products], r) for i in range(len(self.columns))]

    def __call__(self, s: SX) -> tuple[SX, SX]:
        """Value and slope."""
        value, slope = self._function(s, *self._given)
        return value, slope

    @cached_property
    def _given(self) -> list[SX]:
        return [ca.vertcat(*x) for x in (self.squares, self.c, *self.products, self.columns)] + [self.missing]

    @cached_property
    def _function(self) -> ca.Function:
        """Value and slope of s and the numbers here: written down once, as CasADi's Python takes long for each of 50 calls."""
        symbols = [ca.SX.sym("x", len(x)) for x in (self.squares, self.c, *self.products, self.columns)]
        squares, c, *products, columns = ([*ca.vertsplit(x)] for x in symbols)
        s, missing = ca.SX.sym("s"), ca.SX.sym("missing")
        known = _PeakError(squares, c, products, columns, missing)._written(s)
        return ca.Function("error", [s, *symbols, missing], known)

    def _written(self, s: SX) -> tuple[SX, SX]:
        r = [1 / (x + s) for x in self.squares]
        double = [x * x for x in r]
        twice = s + s
        value = slope = ca.SX(0)
        for k, (a, b) in enumerate(zip(self._along(r), self._along(double), strict=True)):
            weight = twice + self.columns[k]
            size = a * a * weight
            steep = 2 * a * (a - b * weight)
            more = size > value
            value, slope = (size, steep) if k == 0 else (ca.if_else(more, size, value), ca.if_else(more, steep, slope))
        healthy = [x * x * y for x, y in zip(self.c, double, strict=True)]
        turning = dot(healthy, [x * y for x, y in zip(r, self.squares, strict=True)])
        return self.missing + s * s * dot(healthy, [ca.SX(1)] * len(r)) + value, twice * turning + slope


def _largest(squares: Vector, parts: Vector, room: SX) -> SX:
    """S at which the squared healthy error ``sum parts s^2 / (sigma^2 + s)^2`` is ``room``.

    In ``t = 1/s`` one over the error is concave and nearly straight (as the trust-region equation), so Newton's method
    from the left never passes the root. Bounds by the parts up to, and below, each singular value come first, and then
    bisections of the logarithm: with singular values far apart Newton's method alone would take long.
    """
    m, total = len(squares), dot(parts, [ca.SX(1)] * len(parts))
    least, most = [], []
    for k in range(m):
        below = ca.SX(0)
        for x, p in zip(squares, parts, strict=True):
            below = below + ca.if_else(x < squares[k], p, 0.0)
        upto = ca.SX(0)
        for x, p in zip(squares, parts, strict=True):
            upto = upto + ca.if_else(x <= squares[k], p, 0.0)
        least.append((ca.sqrt(upto / room) - 1) / squares[k])
        left = room - below
        some = left > 0
        longest = (ca.sqrt((total - below) / ca.if_else(some, left, 1.0)) - 1) / squares[k]
        most.append(ca.if_else(some, longest, _NEVER))
    low, high = least[0], smallest(most)
    for x in least[1:]:
        low = _larger(x, low)
    for _ in range(_BISECTIONS):
        middle = ca.sqrt(low * high)
        error = dot(parts, [1 / ((1 + middle * x) * (1 + middle * x)) for x in squares])
        short = error > room
        low, high = ca.if_else(short, middle, low), ca.if_else(short, high, middle)
    t, goal = low, 1 / ca.sqrt(room)
    for _ in range(_NEWTON):
        d = [1 / (1 + t * x) for x in squares]
        terms = [p * x * x for p, x in zip(parts, d, strict=True)]
        error = dot(terms, [ca.SX(1)] * m)
        steep = dot(terms, [x * y for x, y in zip(d, squares, strict=True)])
        size = ca.sqrt(error)
        t = t + (goal - 1 / size) * size * error / steep
    return 1 / t


def _minimise(error: _PeakError, largest: SX, m: int) -> SX:
    cells, kept, rounds = _grid(m)
    # s = first (ratio^k - 1), from 0 to the largest
    first = _larger(_FIRST * smallest(error.squares), 1e-12 * largest)
    first = ca.if_else(first < largest / 3, first, largest / 3)
    ratio = ca.exp(ca.log(1 + largest / first) / cells)
    points, power = [ca.SX(0)], ca.SX(1)
    for _ in range(cells - 1):
        power = power * ratio
        points.append(first * (power - 1))
    points.append(largest)
    values = [(s, *error(s)) for s in points]
    best, least = values[0][0], values[0][1]
    for s, value, _ in values[1:]:
        better = value < least
        best, least = ca.if_else(better, s, best), ca.if_else(better, value, least)
    estimates = [_estimate(*a, *b) for a, b in pairwise(values)]
    for number in range(kept):
        lowest, which, cell = estimates[0], ca.SX(0), [*values[0], *values[1]]
        for k in range(1, cells):
            better = estimates[k] < lowest
            here = [*values[k], *values[k + 1]]
            lowest, which = ca.if_else(better, estimates[k], lowest), ca.if_else(better, k, which)
            cell = [ca.if_else(better, x, y) for x, y in zip(here, cell, strict=True)]
        if number < kept - 1:
            estimates = [ca.if_else(which == k, _NEVER, x) for k, x in enumerate(estimates)]
        turns = lowest < _NEVER
        nearer = _refine(error, cell, best, least, rounds)
        best, least = (ca.if_else(turns, x, y) for x, y in zip(nearer, (best, least), strict=True))
    return best


def _estimate(a: SX, fa: SX, ga: SX, b: SX, fb: SX, gb: SX) -> SX:
    """Where the tangents at both ends of a cell meet, if the slope turns from down to up in it."""
    turns = ca.logic_and(ga < 0, gb > 0)
    return ca.if_else(turns, fa + ga * _meet(a, fa, ga, b, fb, gb), _NEVER)


def _meet(a: SX, fa: SX, ga: SX, b: SX, fb: SX, gb: SX) -> SX:
    """How far beyond a the tangents at a and b meet: the middle for a parabola, the place of a kink between two lines."""
    bend = gb - ga
    return (fa - fb + gb * (b - a)) / ca.if_else(bend > 0, bend, _NEVER)


def _refine(error: _PeakError, cell: Vector, best: SX, least: SX, rounds: int) -> tuple[SX, SX]:
    a, fa, ga, b, fb, gb = cell
    x, value = best, least
    for number in range(rounds):
        edge = _EDGE if number < rounds - 1 else 0.0  # the last point may lie where it is best
        width, bend = b - a, gb - ga
        meet = _meet(a, fa, ga, b, fb, gb)
        flat = -ga * width / ca.if_else(bend > 0, bend, _NEVER)  # where the slope of a parabola is 0
        # In a cell so narrow that its values differ by rounding alone, only their slopes still tell where the minimum is.
        smooth = ca.logic_or(ca.fabs(meet - width / 2) < _SMOOTH * width, bend * width < _ROUGH * fa)
        step = _larger(ca.if_else(smooth, flat, meet), edge * width)
        x = a + ca.if_else(step < (1 - edge) * width, step, (1 - edge) * width)
        value, slope = error(x)
        better = value < least
        best, least = ca.if_else(better, x, best), ca.if_else(better, value, least)
        up = slope > 0
        a, fa, ga = (ca.if_else(up, old, new) for old, new in ((a, x), (fa, value), (ga, slope)))
        b, fb, gb = (ca.if_else(up, new, old) for old, new in ((b, x), (fb, value), (gb, slope)))
    # Values this close differ by rounding alone, and would let it choose among dampings that differ by its square root.
    last = value <= least * (1 + _SAME)
    return ca.if_else(last, x, best), ca.if_else(last, value, least)


def _larger(a: SX, b: SX) -> SX:
    return ca.if_else(a > b, a, b)
