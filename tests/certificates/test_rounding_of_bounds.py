"""Roundings of the verifier: its bounds lie on the right side of the same numbers in exact arithmetic, by however little."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import written

from holdfast.certificates.verifier_parts import balls, bounds
from holdfast.certificates.verifier_parts.balls import BallArray
from holdfast.certificates.verifier_parts.chain import BallChain, enclose_sines_and_cosines
from holdfast.certificates.verifier_parts.taylor import DerivativeEnclosure, InvariantSectionBoxes, TaskErrorEnclosure

flint = pytest.importorskip("flint", reason="python-flint is not installed")
COUNT = 100
exact = np.frompyfunc(Fraction, 1, 1)  # arrays of doubles as arrays of fractions


@pytest.fixture(autouse=True)
def quiet():
    """Compute as the verifier does: NaN proves nothing."""
    with np.errstate(all="ignore"):
        yield


def holds(ball, truth):
    """Whether each number lies in its ball."""
    return (abs(truth - exact(ball.center)) <= exact(ball.radius)).all()


def draw_balls(rng, *shape):
    """Draw balls, some of which are numbers, and the numbers at one end of each."""
    ball = BallArray(rng.normal(size=shape), abs(rng.normal(size=shape)) * rng.choice([0, 1e-17, 1e-3], shape))
    return ball, exact(ball.center) + exact(ball.radius) * rng.choice([-1, 1], shape)


def make_chain(*lengths, slides):
    """A chain along x whose slides move along y."""
    along_y = written.turn(0, -np.pi / 2).round()
    turns, before = [], np.eye(3)
    for slide in (*slides, False):
        here = along_y if slide else np.eye(3)
        turns, before = [*turns, before.T @ here], here
    places = [written.place(turn, before.T @ [length, 0, 0]) for turn, length in zip(turns, (0.0, *lengths), strict=True)]
    return BallChain(written.Chain(places[:-1], places[-1], [[-4.0, 4.0]] * len(slides), list(slides)).stored())


def test_sums_and_products_of_balls(rng):
    (a, x), (b, y) = draw_balls(rng, COUNT, 3), draw_balls(rng, COUNT, 3)
    assert holds(a + b, x + y)
    assert holds(-a, -x)
    assert holds(balls.einsum("na,na->n", a, b), (x * y).sum(axis=1))
    cross = np.stack([x[:, i - 2] * y[:, i - 1] - x[:, i - 1] * y[:, i - 2] for i in range(3)], 1)
    assert holds(balls.einsum("nij,nj->ni", balls.cross_matrix(a), b), cross)
    assert (exact(a.magnitude) >= abs(x)).all()
    assert (exact(a.lower) <= x).all()
    assert (exact(balls.bound_length(a.center)) ** 2 >= (exact(a.center) ** 2).sum(axis=1)).all()


@pytest.mark.parametrize("bent", [0.0, 1.0])
def test_losses_to_second_order(rng, bent):
    """Against the sum over the variables of the least value of a parabola, and the products of pairs."""
    value, slopes = rng.normal(size=(COUNT, 1)), rng.normal(size=(COUNT, 1, 2))
    second, half = bent * rng.normal(size=(COUNT, 1, 2, 2)), rng.uniform(0, 1, (COUNT, 2))
    second = np.triu(second) + np.triu(second, 1).swapaxes(2, 3)
    form, rest = DerivativeEnclosure(BallArray(value), BallArray(slopes), BallArray(second)), rng.uniform(0, 0.1, (COUNT, 1))
    s, h = abs(exact(slopes[:, 0])), exact(half)
    pair = abs(exact(second[:, 0, 0, 1])) * h[:, 0] * h[:, 1]
    sides = []
    for sign, found in zip((1, -1), form.bound_decrease_and_increase(half), strict=True):
        own = sign * exact(np.diagonal(second[:, 0], axis1=1, axis2=2))
        inside = s < own * h
        parts = np.where(inside, s**2 / np.where(inside, 2 * own, 1), s * h - own * h**2 / 2)
        sides.append(parts.sum(axis=1) + pair)
        assert (exact(found[:, 0]) >= sides[-1]).all()
    truth = np.maximum(exact(value[:, 0]) + sides[1], sides[0] - exact(value[:, 0])) + exact(rest[:, 0])
    assert (exact(form.bound_magnitude(half, rest)[:, 0]) >= truth).all()


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("slides", [(False, False), (True, True), (True, False), (False, True)])
def test_derivatives_of_points(rng, slides, order):
    """Where all joints slide, nothing is rounded up before the sum."""
    chain = make_chain(0.7, 0.4, slides=slides)
    far, out = rng.uniform(0, 1, (COUNT, 2)), rng.normal(size=(COUNT, 2))
    slid = exact(far) * np.array(slides)
    angle = np.cumsum(exact(far) * ~np.array(slides), axis=1)
    reach = exact(chain.link_lengths) + abs(exact(out)) * np.array(slides) + slid
    truth = (angle**order * reach + order * angle ** (order - 1) * slid).sum(axis=1)
    assert (exact(chain.bound_derivative(order, far, chain.link_lengths, out)) >= truth).all()


def test_lengths_of_links(rng):
    """Along x, where the next axis is across."""
    for lengths in rng.uniform(0.1, 1, (COUNT, 2)):
        whole = make_chain(*lengths, slides=(False, False)).link_lengths
        assert (exact(whole) >= exact(lengths)).all()
        assert (whole < lengths * (1 + 1e-11)).all()


def test_what_is_behind_the_second_order(rng):
    """The angle by which two chains turn at most, and its cube."""
    chain = make_chain(0.7, 0.4, slides=(False, True))
    joints = [enclose_sines_and_cosines(rng.normal(size=COUNT)) for _ in range(4)]
    with flint.ctx.workprec(64):
        error = TaskErrorEnclosure("pose", chain, joints[:2], chain, joints[2:])
    far = rng.uniform(0, 1, (COUNT, 4))
    rest, angle = error.bound_remainder_and_angle(far)
    truth = exact(far[:, 0]) + exact(far[:, 3])  # the other chain's joints come backwards
    assert (exact(angle) >= truth).all()
    assert (exact(rest[:, 3]) >= truth**3 / 6).all()


def test_manipulability_that_is_found(rng):
    """Of planar arms with quarter turns, whose Jacobians are whole numbers: 1 - J_k' (J J')^-1 J_k in fractions."""
    quarter = written.turn(2, np.pi / 2).round()
    for _ in range(10):
        links = rng.integers(1, 6, 4).astype(float)
        frames = [written.place(np.eye(3), [0.0, 0, 0])] + [written.place(quarter, [x, 0.0, 0]) for x in links]
        arm = written.Chain(frames[:-1], frames[-1], [[-4.0, 4.0]] * 4).stored()
        document = {"joint_box": [["-0x1p+0", "0x1p+0"]] * 4, "arm": arm, "task": "planar-pose"}
        leaves = bounds.CeilingVerifier(document | {"threshold": "0x1p-1", "locks": [0, 2]})
        low, high = leaves.enclose_manipulability_at(["0x0p+0"] * 4)
        steps = np.array([[1, 0], [0, 1], [-1, 0], [0, -1]]) * links[:, None]
        places = np.vstack([np.zeros(2), np.cumsum(steps, axis=0)])
        lever = places[-1] - places[:-1]
        rows = [[Fraction(int(x)) for x in row] for row in (np.ones(4), -lever[:, 1], lever[:, 0])]
        gram = flint.fmpq_mat([[flint.fmpq(int(sum(a * b for a, b in zip(r, s, strict=True)))) for s in rows] for r in rows])
        columns = flint.fmpq_mat([[flint.fmpq(int(x)) for x in row] for row in rows])
        parts = columns.transpose() * gram.inv() * columns
        squares = [1 - Fraction(int(parts[k, k].p), int(parts[k, k].q)) for k in (0, 2)]
        assert Fraction(low) ** 2 <= min(squares) <= Fraction(high) ** 2
        assert high - low < 1e-7


@pytest.mark.parametrize("beyond", [-8, -1, 0, 1, 8])
@pytest.mark.parametrize("side", [0, 1])
@pytest.mark.parametrize("radius", [0.0, 1e-17, 1e-3])
def test_joints_at_their_limits(rng, beyond, side, radius):
    """Joints that go up to some roundings from a limit; what is accepted lies within, and some roundings are enough."""
    q, far = BallArray(rng.normal(size=(COUNT, 1)), np.full((COUNT, 1), radius)), rng.uniform(0, 1, (COUNT, 1))
    sign = 2 * side - 1
    ends = exact(q.center) + sign * (exact(q.radius) + exact(far))
    cells = object.__new__(InvariantSectionBoxes)
    accepted = 0
    for k in range(COUNT):
        limits = np.array([[-np.inf, np.inf]])
        limits[0, side] = float(ends[k, 0]) - sign * beyond * 2.0**-53 * (abs(q.center[k, 0]) + far[k, 0])
        cells.joint_travel = far[[k]]
        within = cells.is_within_limits(q[[k]], limits, [0])[0]
        accepted += within
        if within:
            assert sign * ends[k, 0] <= sign * Fraction(float(limits[0, side]))
    assert accepted in {-8: [COUNT], 8: [0]}.get(beyond, range(COUNT + 1))
    cells.joint_travel = far
    assert cells.is_within_limits(q, np.array([[8.0, 9.0]]), []).all()  # joints that are not free have their values
