"""Bounds of path certificates against true extremes, next to the place where a check turns from accepted to rejected."""

from __future__ import annotations

import itertools
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest
import written

from holdfast.certificates.verifier_parts.balls import BallArray
from holdfast.certificates.verifier_parts.chain import BallChain, enclose_sines_and_cosines
from holdfast.certificates.verifier_parts.distances import LoopClosureVerifier
from holdfast.certificates.verifier_parts.motions import PathVerifier
from holdfast.certificates.verifier_parts.taylor import InvariantSectionBoxes, TaskErrorEnclosure

flint = pytest.importorskip("flint", reason="python-flint is not installed")
ROUNDING, EDGE = 1e-7, 1e-3
STILL, ORIGIN = np.eye(3), [0.0, 0.0, 0.0]
Z_ALONG_X = written.turn(1, np.pi / 2)


@pytest.fixture(autouse=True)
def quiet():
    """Compute as the verifier does: with 64 bits, and NaN proves nothing."""
    with flint.ctx.workprec(64), np.errstate(all="ignore"):
        yield


def make_arm(*frames, slides=None):
    """An arm of frames (rotation, origin), the last of which is the tool."""
    places = [written.place(*frame) for frame in frames]
    return written.Chain(places[:-1], places[-1], [[-4.0, 4.0]] * (len(frames) - 1), slides).stored()


LEVER = make_arm((STILL, ORIGIN), (STILL, [1.0, 0, 0]))
ELBOW = make_arm((STILL, ORIGIN), (STILL, [1.0, 0, 0]), (STILL, [0.8, 0, 0]))
POLE = make_arm((STILL, ORIGIN), (Z_ALONG_X, ORIGIN), (STILL, ORIGIN), slides=[False, True])
TELESCOPE = make_arm((STILL, ORIGIN), (Z_ALONG_X, ORIGIN), (STILL, [0, 0, 0.3]), slides=[False, True])


# ---- slopes of the error by the path and the section ---------------------------------------------------------------


def bound_and_truth(task, arm, middle, columns, half, points):
    """Bounds (m, 1 + m) of the slopes of g - s by path and section, and the greatest slopes at points of the box.

    ``columns`` (2n, 2 + m): how the joints, then those of the healthy arm backwards, follow the lock, path, and section.
    """
    chain, n, m = BallChain(arm), len(middle), columns.shape[1] - 2

    def error(moves):
        q, goal = (np.array(middle) + moves[:, :n]).T, (np.array(middle) + moves[:, : n - 1 : -1]).T
        return TaskErrorEnclosure(
            task, chain, list(map(enclose_sines_and_cosines, q)), chain, list(map(enclose_sines_and_cosines, goal))
        )

    box = np.array([half], dtype=float)
    cells = InvariantSectionBoxes(error(np.zeros((1, 2 * n))), BallArray(columns[None]), np.zeros((m, 2 + m)), box.copy())
    bound = PathVerifier.bound_residual_gradients(SimpleNamespace(m=m), cells, box)[0]
    step, truth = 1e-4, []
    for column in [1, *range(2, 2 + m)]:
        moves, way = (points * half) @ columns.T, step * columns[:, column]
        ahead, behind = (error(moves + sign * way).value.center[:, :m] for sign in (1, -1))
        own = np.eye(m)[column - 2] if column > 1 else np.zeros(m)
        truth.append(abs((ahead - behind) / (2 * step) - own).max(axis=0))
    return bound, np.stack(truth, 1)


def in_columns(n, m, columns):
    """Columns by number: 0 is the lock, 1 the path, and 2 the first of the section; those that are not given are zero."""
    made = np.zeros((2 * n, 2 + m))
    for number, entries in columns.items():
        made[:, number] = entries
    return made


@pytest.mark.parametrize(
    ("task", "arm", "middle", "entry", "columns"),
    [
        # Both tools go up, and one of them is turned by the lock: 1 - cos. Then the same by the path.
        ("planar", LEVER, [0.0], (1, 1), {0: [1, 0], 2: [1, 1]}),
        ("planar", LEVER, [0.0], (1, 1), {0: [0, 1], 2: [1, 1]}),
        ("planar", LEVER, [0.0], (1, 0), {0: [1, 0], 1: [1, 1]}),
        # The tool goes along the circle, of which the lock takes it away: sin.
        ("planar", LEVER, [0.0], (0, 1), {0: [1, 0], 2: [1, 0]}),
        # A tool at a distance of 1 on a slide.
        ("planar", POLE, [0.0, 1.0], (1, 1), {0: [1, 0, 0, 0], 2: [1, 0, 0, 1]}),
        ("planar", POLE, [0.0, -1.0], (1, 1), {0: [1, 0, 0, 0], 2: [1, 0, 0, 1]}),
        ("planar", TELESCOPE, [0.0, 0.7], (1, 1), {0: [1, 0, 0, 0], 2: [1, 0, 0, 1]}),
        # A slide that goes out while it is turned, by the section or by the lock.
        ("planar", POLE, [0.0, 0.0], (0, 1), {0: [1, 1, 0, 0], 2: [1, 0, 0, 0]}),
        ("planar", POLE, [0.0, 0.0], (0, 1), {0: [1, 0, 0, 0], 2: [0, 1, 1, 0]}),
        # Both joints of an elbow; the section moves the tool by 1.
        ("planar", ELBOW, [0.0, 0.0], (1, 2), {0: [1, 1, 0, 0], 3: [1 / 1.8, 0, 0, 0]}),
        ("planar", ELBOW, [0.0, 0.0], (1, 2), {0: [0, 1, 0, 0], 3: [0, 1 / 0.8, 0, 0]}),
        # The rotation about z: cos - 1, by the one arm or the other.
        ("planar-pose", LEVER, [0.0], (2, 3), {0: [1, 0], 4: [1, 0]}),
        ("planar-pose", LEVER, [0.0], (2, 3), {0: [0, 1], 4: [0, -1]}),
        ("planar-pose", LEVER, [0.0], (2, 0), {0: [1, 0], 1: [1, 0]}),
        ("planar-pose", ELBOW, [0.0, 0.0], (2, 3), {0: [0, 1, 0, 0], 4: [0.5, 0.5, 0, 0]}),
    ],
)
@pytest.mark.parametrize("half", [0.05, 0.4])
def test_slopes_that_one_term_bounds(task, arm, middle, entry, columns, half):
    m = {"planar": 2, "planar-pose": 3}[task]
    made, sides = in_columns(len(middle), m, columns), np.zeros(2 + m)
    sides[0] = half
    points = np.linspace(-1, 1, 9)[:, None] * np.eye(2 + m)[0]
    bound, truth = bound_and_truth(task, arm, middle, made, sides, points)
    assert (truth <= bound + ROUNDING).all()
    assert truth[entry] >= 0.8 * bound[entry]


@pytest.mark.parametrize(("task", "m"), [("planar", 2), ("position", 3), ("pointing", 5), ("pose", 6)])
@pytest.mark.parametrize(("arm", "n"), [(ELBOW, 2), (TELESCOPE, 2)])
def test_slopes_at_random_points(rng, task, m, arm, n):
    for _ in range(3):
        columns, half = rng.normal(size=(2 * n, 2 + m)) * rng.choice([0, 1], (2 * n, 2 + m)), rng.uniform(0, 0.2, 2 + m)
        points = rng.choice([-1.0, 1.0], (40, 2 + m))
        bound, truth = bound_and_truth(task, arm, rng.normal(size=n), columns, half, points)
        assert (truth <= bound + ROUNDING).all()


@pytest.mark.parametrize("factor", [1 - EDGE, 1 + EDGE])
def test_contraction(factor):
    """The box (1, 2) becomes (0.1 + 2 b, 0.4 + 2 c), of which one side is the box's own."""
    for b, c in ((0.4495 / factor, 0.1), (0.1, 0.799 / factor)):
        slope = np.array([[[9.0, 0.1, b], [9.0, 0.4, c]]])
        faults = SimpleNamespace(m=2, bound_residual_gradients=lambda cells, half, slope=slope: slope)
        cells = SimpleNamespace(half_widths=np.ones((1, 4)))
        assert PathVerifier.is_contraction(faults, cells, np.array([[1.0, 2.0]]))[0] == (factor > 1)


# ---- the place on the path -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("factor", [1 - 3 * EDGE, 1 + EDGE])
@pytest.mark.parametrize("columns", [0, 2])
def test_turned_cells_go_forward(rng, factor, columns):
    """Next to where the fastest motion of the section takes the place back as fast as the path takes it forward.

    The section moves as fast as it can where all slopes have the signs that add up: du = (1 - M)^-1 b.
    """
    m = 2
    for _ in range(50):
        slope = rng.uniform(0.05, 0.3, (1, m, 1 + m))
        own = rng.normal(size=(1, m + 1, 2 + columns + m))
        fastest = np.linalg.solve(np.eye(m) - slope[0, :, 1:], slope[0, :, 0])
        own[0, -1, 1] = abs(own[0, -1, -m:]) @ fastest / factor
        faults = SimpleNamespace(m=m, bound_residual_gradients=lambda cells, half, slope=slope: slope)
        cells = SimpleNamespace(half_widths=rng.uniform(0.1, 1, (1, 2 + columns + m)))
        assert PathVerifier.moves_forward(faults, cells, BallArray(own), np.array([-1e3]))[0] == (factor < 1)
        own[0, -1, 1] += 1
        last = abs(own[0, -1]) @ cells.half_widths[0]
        assert PathVerifier.moves_forward(faults, cells, BallArray(own), np.array([-last / factor]))[0] == (factor < 1)


def test_turned_cells_whose_section_runs_away():
    """Slopes of 1 by the section bound nothing; the solution of the equations is negative where they are above 1."""
    own, cells = np.ones((1, 2, 3)), SimpleNamespace(half_widths=np.ones((1, 3)))
    own[0, -1, 1] = 1e9
    for slope in (1.0, 1.5):
        faults = SimpleNamespace(m=1, bound_residual_gradients=lambda cells, half, slope=slope: np.array([[[0.1, slope]]]))
        assert not PathVerifier.moves_forward(faults, cells, BallArray(own), np.array([-1e12]))[0]


def test_turned_cells_whose_equations_are_solved_badly():
    """The matrix is rounded to another one: the section moves by 2.2e13, and the rounded equations say 1.8e13."""
    slope = np.array([[[1e-3, 1e-17, 1.0], [1e-3, 1 - 2.0**-53, 1e-17]]])
    (b, a, c), (e, d, f) = [list(map(Fraction, row)) for row in slope[0].tolist()]
    assert (b * (1 - f) + c * e) / ((1 - a) * (1 - f) - c * d) > 2e13
    own = np.array([[[0.0, 0, 0, 0], [0, 0, 0, 0], [0, 2e13, 1, 0]]])
    faults, cells = (
        SimpleNamespace(m=2, bound_residual_gradients=lambda cells, half: slope),
        SimpleNamespace(half_widths=np.ones((1, 4))),
    )
    assert not PathVerifier.moves_forward(faults, cells, BallArray(own), np.array([-1e30]))[0]


# ---- cells that continue a motion ----------------------------------------------------------------------------------


def draw_cells(rng, count, m, tube):
    """Draw pairs of cells, of which the first begins a slab: the arguments of ``glued`` up to its widths, as arrays."""
    size = 2 * count
    own = rng.normal(size=(size, m + 1, 2 + tube + m))
    own[:, :, [1, *range(-m, 0)]] += 4 * np.eye(m + 1)
    lock = rng.normal(size=(size, m + 1)), rng.normal(size=(size, m + 1))
    return rng.normal(size=(size, m + 1)), own, rng.uniform(0.2, 1, (size, 2 + tube + m)), lock


def entered(here, own, w, lock, k, m):
    """The greatest coordinates (1 + m,), on the path and the section, where the motion enters cell k; even cells are first."""
    if k % 2 == 0:
        place, parts = lock[0][k], [(lock[1][k] - own[k][:, 0]) * w[k, 0]]
    else:
        before, kept = own[k - 1], [0, *range(2, w.shape[1] - m)]
        place = here[k - 1] + before[:, 1] * w[k - 1, 1]
        parts = [(before[:, c] - own[k][:, c]) * w[k, c] for c in kept]
        parts += [before[:, c] * w[k - 1, c] for c in range(w.shape[1] - m, w.shape[1])]
    signs = np.array(list(itertools.product((-1.0, 1.0), repeat=len(parts))))
    ends = place - here[k] + signs @ np.array(parts)
    return abs(np.linalg.solve(own[k][:, [1, *range(-m, 0)]], ends.T)).max(axis=1)


def glue(here, own, w, wide, lock, turned, off=0.0):
    """Whether the verifier accepts that cells continue a motion."""
    balls = BallArray(own, off)
    ends = BallArray(lock[0]), BallArray(lock[1])
    first = np.arange(len(own)) % 2 == 0
    return PathVerifier.contains_previous_solution(
        SimpleNamespace(m=wide.shape[1]), BallArray(here), balls, w, wide, ends, first, turned
    )


@pytest.mark.parametrize(("m", "tube"), [(1, 0), (2, 0), (2, 2), (3, 1)])
@pytest.mark.parametrize("narrow", [None, 0, -1])
def test_cells_that_are_just_wide_enough(rng, m, tube, narrow):
    """All sides of the boxes are a little wider than what the motion needs, but for one, which is a little narrower."""
    here, own, w, lock = draw_cells(rng, 20, m, tube)
    wide, factor = np.zeros((len(w), m)), np.full(1 + m, 1 + EDGE)
    if narrow is not None:
        factor[narrow] = 1 - EDGE
    for k in range(len(w)):
        most = entered(here, own, w, lock, k, m) * factor
        w[k, 1], wide[k] = most[0], most[1:]
    for turned in (np.zeros(len(w), dtype=bool), rng.random(len(w)) < 0.5):
        assert (glue(here, own, w, wide, lock, turned) == (narrow is None)).all()


@pytest.mark.parametrize("turned", [(False, False), (True, False), (False, True), (True, True)])
@pytest.mark.parametrize("beyond", [-1e-9, 0.0, 1e-9, 1e-5])
def test_cells_that_begin_at_a_face(turned, beyond):
    """The next cell begins where the one before ends, up to roundings; turned cells have no common face."""
    own = np.tile(np.eye(2)[:, [0, 0, 1]] * [0, 1, 1], (2, 1, 1))
    here, w = np.array([[0.0, 0], [1.5 + beyond, 0]]), np.array([[0.0, 1, 0], [0, 0.5, 0]])
    accepted = glue(here, own, w, np.ones((2, 1)), (here, 0 * here), np.array(turned))
    assert accepted[0]
    assert accepted[1] == (beyond < (0 if any(turned) else 1e-6))


@pytest.mark.parametrize("off", [0.003, 0.01])
def test_cells_whose_directions_are_not_known_exactly(rng, off):
    """Of all matrices within the balls one needs the widest box; they are tried at their corners."""
    for _ in range(20):
        here, own, w, lock = draw_cells(rng, 1, 1, 0)
        own[:, :, 0] = 0
        here, own, w, lock = here[:1], own[:1], w[:1], (lock[0][:1], 0 * lock[1][:1])
        truth = np.zeros(2)
        for signs in itertools.product((-1.0, 1.0), repeat=4):
            other = own.copy()
            other[0, :, 1:] += off * np.reshape(signs, (2, 2))
            truth = np.maximum(truth, abs(np.linalg.solve(other[0, :, 1:], lock[0][0] - here[0])))
        for narrow in (0, 1):
            sides = truth * np.where(np.arange(2) == narrow, 1 - EDGE, 1.5)
            w[0, :2] = 0, sides[0]
            assert not glue(here, own, w, sides[None, 1:], lock, np.array([True]), off * np.array([0, 1, 1]))[0]


# ---- rings ---------------------------------------------------------------------------------------------------------


def make_ring(arm, middle, low, high, *, turns):
    """The ring of an arm whose tool is where it is in the middle, with joints between bounds."""
    tool, ranges = list(map(Fraction, middle)), list(map(list, zip(low, high, strict=True)))
    return LoopClosureVerifier(arm, ranges, tool_q=tool, uses_rotation=turns, planar=False)


ROOT, TIP = (0, np.zeros(3)), (2, np.array([0.8, 0, 0]))
ASIDE = (1, np.array([0.5, 0.3, 0]))


@pytest.mark.parametrize("first", [ROOT, ASIDE])
@pytest.mark.parametrize("elbow", [-2.0, -0.7, 0.4, 1.5])
@pytest.mark.parametrize("side", [-1, 1])
def test_rings_of_an_elbow(first, elbow, side):
    """A box from the true angle on is not excluded; one that begins a little later is: the law of cosines."""
    q = np.array([0.3, elbow])
    for gap, excluded in ((0.0, False), (2e-3, True)):
        ends = np.sort(elbow + side * np.array([gap, gap + 0.01]))
        ring = make_ring(ELBOW, q, [0.3, ends[0]], [0.3, ends[1]], turns=False)
        assert ring.find_excluded_cells([first, TIP], [((0, 0),) * 2])[0] == excluded


@pytest.mark.parametrize("elbow", [-2.0, -0.7, 0.4, 1.5])
@pytest.mark.parametrize("angle", np.linspace(0, 6, 7))
@pytest.mark.parametrize("part", ["base", "first joint"])
def test_rings_whose_base_is_not_known_exactly(elbow, angle, part):
    """The base, as the tool sees it, is off by 0.01 in any direction, and the ring states this."""
    off = 0.01 * np.array([np.cos(angle), np.sin(angle), 0])
    for side in (-1, 1):
        ends = np.sort(elbow + side * np.array([0, 0.01]))
        ring = make_ring(ELBOW, [0.3, elbow], [0.3, ends[0]], [0.3, ends[1]], turns=False)
        if part == "base":
            ring._base_frame = BallArray(ring._base_frame[0].center + off, abs(off)), ring._base_frame[1]
        else:
            ring.chain.origins[2] = ring.chain.origins[2] + off
            ring._base_radius = abs(off)
        assert not ring.find_excluded_cells([ROOT if part == "base" else ASIDE, TIP], [((0, 0),) * 2])[0]


@pytest.mark.parametrize("slides", [None, [False, True, False]])
@pytest.mark.parametrize("turns", [True, False])
def test_rings_of_random_arms(rng, slides, turns):
    """The configuration with the tool where it is, at a corner of a box, is not excluded by any two points."""
    excluded = 0
    for _ in range(15):
        frames = [(written.turn(0, rng.normal()) @ written.turn(2, rng.normal()), rng.normal(size=3)) for _ in range(4)]
        arm, q, half = make_arm(*frames, slides=slides), rng.normal(size=3), rng.uniform(0, 0.2, 3) * rng.choice([0, 1], 3)
        low, high = q - half * rng.choice([0, 2], 3), q + 0 * half
        high = np.maximum(high, low + 2 * half * (low == q))
        one, other = sorted(rng.integers(4, size=2)) if turns else (int(rng.integers(4)), 3)
        points = [(one, rng.normal(size=3)), (other, rng.normal(size=3) if turns else np.array(frames[-1][1]))]
        assert not make_ring(arm, q, low, high, turns=turns).find_excluded_cells(points, [((0, 0),) * 3])[0]
        elsewhere = make_ring(arm, q, q + 0.5, q + 0.51, turns=turns)
        excluded += elsewhere.find_excluded_cells(points, [((0, 0),) * 3])[0]
    assert excluded > 5
