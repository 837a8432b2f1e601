"""Bounds of the verifier against the true maximum: of functions and arms that come so near that no term can be left out.

The other tests of the verifier compare bounds with random configurations, which rarely come near. Here the maximum is known in
closed form or sampled densely, on arms whose links are stretched so that the terms of a bound add up.
"""

from __future__ import annotations

import itertools

import numpy as np
import pytest
import written

from holdfast.certificates.verifier_parts import bounds, distances
from holdfast.certificates.verifier_parts.balls import BallArray
from holdfast.certificates.verifier_parts.chain import BallChain, enclose_sines_and_cosines
from holdfast.certificates.verifier_parts.taylor import DerivativeEnclosure, TaskErrorEnclosure

flint = pytest.importorskip("flint", reason="python-flint is not installed")
ROUNDING = 1e-9
Z_ALONG_X = written.turn(1, np.pi / 2)  # a frame whose z axis is the x axis of the one before


@pytest.fixture(autouse=True)
def quiet():
    """Compute as the verifier does: with 64 bits, and NaN proves nothing."""
    with flint.ctx.workprec(64), np.errstate(all="ignore"):
        yield


def make_chain(*frames, slides=None):
    """A chain of frames (rotation, origin), the last of which is the tool."""
    places = [written.place(*frame) for frame in frames]
    limits = [[-4.0, 4.0]] * (len(frames) - 1)
    return BallChain(written.Chain(places[:-1], places[-1], limits, slides).stored())


def at(*middles, half=0.0):
    """Joints at values (N = 1) with half widths."""
    joints = [enclose_sines_and_cosines(np.array([float(x)])) for x in middles]
    for joint, width in zip(joints, np.broadcast_to(half, len(joints)), strict=True):
        joint[:, 2] = width
    return joints


STILL, ORIGIN = np.eye(3), [0.0, 0.0, 0.0]
ELBOW = make_chain((STILL, ORIGIN), (STILL, [1.0, 0, 0]), (STILL, [0.8, 0, 0]))
TELESCOPE = make_chain((STILL, ORIGIN), (Z_ALONG_X, ORIGIN), (STILL, [0, 0, 0.3]), slides=[False, True])
POLE = make_chain((STILL, ORIGIN), (Z_ALONG_X, ORIGIN), (STILL, ORIGIN), slides=[False, True])
MAST = make_chain((STILL, ORIGIN), (Z_ALONG_X, ORIGIN), (STILL, [0, 0, 1.0]))  # the tool lies on the second axis
LEVER = make_chain((STILL, ORIGIN), (STILL, [1.0, 0, 0]))


# ---- functions of one and two variables ----------------------------------------------------------------------------


def of_one_variable(value, slope, second):
    """Vectors (N, 3) along x, whose derivatives are numbers (N,)."""
    numbers = [np.stack([x, 0 * x, 0 * x], 1) for x in (value, slope, second)]
    return DerivativeEnclosure(
        BallArray(numbers[0]), BallArray(numbers[1][:, :, None]), BallArray(numbers[2][:, :, None, None])
    )


@pytest.mark.parametrize("cubic", ["first and second", "value and third", "all"])
def test_lengths_of_cubics(rng, cubic):
    """The vector a + b t + c t^2 / 2 + e t^3 / 6 within |t| <= h, of which the extremes are sampled."""
    a, b, c, e = rng.uniform(0.2, 2, (4, 400))
    keep = {"first and second": (0, 1, 1, 0), "value and third": (1, 0, 0, 1), "all": (1, 1, 1, 1)}[cubic]
    a, b, c, e = (x * k for x, k in zip((a, b, c, e), keep, strict=True))
    half = rng.uniform(0.05, 0.3, 400)
    t = np.linspace(-1, 1, 2001)[:, None] * half
    v = a + b * t + c * t**2 / 2 + e * t**3 / 6
    bends = [(b + c * half + e * half**2 / 2) * half, (c + e * half) * half**2, e * half**3]
    near, far = distances.bound_norm_range(of_one_variable(a, b, c), bends, half[:, None])
    assert (far >= abs(v).max(axis=0) - ROUNDING).all()
    assert (near <= abs(v).min(axis=0) + ROUNDING).all()


def test_lengths_of_parts_that_are_left_behind():
    """The nearest length where a place and a rotation lose a known part, and where one only does."""
    form = DerivativeEnclosure(
        BallArray([[0.6, 0, 0, 0, 0, 0.8]]), BallArray(np.zeros((1, 6, 1))), BallArray(np.zeros((1, 6, 1, 1)))
    )
    for moved, turned in ((0.1, 0.0), (0.0, 0.2), (0.1, 0.2)):
        low = distances.bound_norm_below(form, 3, (np.array([moved]), np.array([turned])), np.array([[0.1]]))
        truth = np.hypot(0.6 - moved, 0.8 - turned)
        assert low[0] <= truth + ROUNDING
        assert low[0] > truth - 0.05


@pytest.mark.parametrize("slope", [1.0, 3.0, np.nan])
def test_a_length_of_zero_with_slopes_along_one_direction(slope):
    """Equations without a solution do not stop the verifier; the leaf proves nothing."""
    form = DerivativeEnclosure(
        BallArray(np.zeros((1, 3))), BallArray([[[1.0], [slope], [slope]]]), BallArray(np.zeros((1, 3, 1, 1)))
    )
    low = distances.bound_norm_below(form, 3, (np.zeros(1), 0), np.ones((1, 1)))
    assert not (low > 0).any()


@pytest.mark.parametrize("variables", [1, 2])
def test_quadratic_functions(rng, variables):
    """Least and greatest values on a grid; of one variable the bound is the true one."""
    value, slope = rng.normal(size=(300, 1)), rng.normal(size=(300, 1, variables)) * rng.choice([0, 1], (300, 1, 1))
    second = rng.normal(size=(300, 1, variables, variables)) * rng.choice([1, 20], (300, 1, 1, 1))
    second = second + second.swapaxes(2, 3)
    half, rest = rng.uniform(0.1, 1, (300, variables)), rng.uniform(0, 0.1, (300, 1))
    form = DerivativeEnclosure(BallArray(value), BallArray(slope), BallArray(second))
    less, more = (x[:, 0] for x in form.bound_decrease_and_increase(half))
    t = np.stack(np.meshgrid(*[np.linspace(-1, 1, 401 if variables == 1 else 101)] * variables), -1).reshape(-1, variables)
    points = t * half[:, None]
    change = np.einsum("ntk,nk->nt", points, slope[:, 0]) + np.einsum("ntj,njk,ntk->nt", points, second[:, 0], points) / 2
    assert (less >= -change.min(axis=1) - ROUNDING).all()
    assert (more >= change.max(axis=1) - ROUNDING).all()
    if variables == 1:
        assert (less + change.min(axis=1) < 1e-3 * (1 + abs(second[:, 0, 0, 0]))).all()
        assert (more - change.max(axis=1) < 1e-3 * (1 + abs(second[:, 0, 0, 0]))).all()
    most = form.bound_magnitude(half, rest)[:, 0]
    assert (most >= abs(value + change).max(axis=1) + rest[:, 0] - ROUNDING).all()


def test_products_of_two_variables():
    """x y on a box of half widths 2 and 3 is 6 at its corner."""
    form = DerivativeEnclosure(BallArray([[0.0]]), BallArray(np.zeros((1, 1, 2))), BallArray([[[[0.0, 1], [1, 0]]]]))
    assert form.bound_magnitude(np.array([[2.0, 3.0]]), np.zeros((1, 1)))[0, 0] >= 6


# ---- arms ----------------------------------------------------------------------------------------------------------

STENCILS = {
    1: np.array([-1, 9, -45, 0, 45, -9, 1]) / 60,
    2: np.array([2, -27, 270, -490, 270, -27, 2]) / 180,
    3: np.array([1, -8, 13, 0, -13, 8, -1]) / 8,
}


def derivative(chain, q, way, order):
    """The length of a derivative of the tool point along a way, by finite differences."""
    step = 0.02
    points = [chain.enclose_point(at(*(q + k * step * way))).tip.center[0] for k in range(-3, 4)]
    return np.linalg.norm(STENCILS[order] @ points) / step**order


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize(
    ("chain", "middle", "far"),
    [
        (ELBOW, (0.0, 0.0), (0.1, 0.2)),
        (ELBOW, (0.0, 0.0), (0.2, 0.0)),
        (ELBOW, (0.0, 0.0), (0.0, 0.2)),
        (TELESCOPE, (0.0, 0.4), (0.3, 0.0)),
        (TELESCOPE, (0.0, 0.0), (0.3, 0.4)),
        (TELESCOPE, (0.0, -0.3), (0.05, 1.0)),
        (TELESCOPE, (0.0, 0.4), (0.0, 0.5)),
        (POLE, (0.0, 0.0), (1.0, 0.5)),
        (MAST, (0.3, 0.0), (0.2, 0.1)),
    ],
)
def test_derivatives_of_stretched_arms(chain, middle, far, order):
    """Of all corners of a box, and all ways along its edges, no derivative is longer."""
    middle, far = np.array(middle), np.array(far)
    bound = chain.bound_derivative(order, far[None], chain.link_lengths, middle[None])[0]
    corners = [np.array(signs) for signs in itertools.product((-1.0, 0.0, 1.0), repeat=2)]
    truth = max(derivative(chain, middle + a * far, b * far, order) for a in corners for b in corners)
    assert truth <= bound * (1 + 1e-5) + 1e-9


@pytest.mark.parametrize("task", ["pose", "position"])
@pytest.mark.parametrize("moved", ["arm", "target", "both"])
@pytest.mark.parametrize("chain", [LEVER, ELBOW, TELESCOPE, MAST])
def test_errors_behind_the_second_order(rng, task, moved, chain):
    """The rows of a task at other joints, less their second-order expansion: at the corners, and at random."""
    n = chain.n
    far = np.full(2 * n, 0.3) * np.repeat([moved != "target", moved != "arm"], n)
    q = [np.zeros(n), np.zeros(n)]
    error = TaskErrorEnclosure(task, chain, at(*q[0]), chain, at(*q[1]))
    rest, _ = error.bound_remainder_and_angle(far[None])
    for way in [*itertools.product((-1.0, 0.0, 1.0), repeat=2 * n), *rng.uniform(-1, 1, (20, 2 * n))]:
        d = far * way
        there = TaskErrorEnclosure(task, chain, at(*(q[0] + d[:n])), chain, at(*(q[1] + d[n:][::-1]))).value.center[0]
        second = error.value.center[0] + error.slopes.center[0] @ d + (error.second.center[0] @ d) @ d / 2
        behind = there - second
        linear = error.linear
        assert np.linalg.norm(behind[:linear]) <= rest[0, 0] + ROUNDING
        assert (abs(behind[linear:]) <= rest[0, linear:] + ROUNDING).all()


@pytest.mark.parametrize("half", [0.1, 0.6])
@pytest.mark.parametrize("q", [(0.0, 0.0), (0.0, 0.5), (0.0, 1.5), (0.0, 3.0)])
def test_distances_of_an_elbow(q, half):
    """The law of cosines: the distance of the tool from the shoulder depends on the elbow only."""
    near, far = distances.bound_distance_range(ELBOW, at(*q, half=half), 0, np.zeros(3), ELBOW.origins[-1], 1)
    inner = np.linspace(q[1] - half, q[1] + half, 2001)
    truth = np.sqrt(1 + 0.8**2 + 2 * 0.8 * np.cos(inner))
    assert near[0] <= truth.min() + ROUNDING
    assert far[0] >= truth.max() - ROUNDING
    assert far[0] < truth.max() + 2 * half**3


@pytest.mark.parametrize("aside", [4e-7, 9e-7])
def test_an_axis_that_nearly_meets_a_point(aside):
    """A turn about an axis that passes by a point moves the other point as far as it passes by."""
    point = np.array([0.0, aside, 0])
    near, far = distances.bound_distance_range(LEVER, at(0.0, half=1.0), 0, point, LEVER.origins[-1], 1)
    angle = np.linspace(-1, 1, 2001)
    truth = np.hypot(np.cos(angle), np.sin(angle) - aside)
    assert near[0] <= truth.min() + 1e-12
    assert far[0] >= truth.max() - 1e-12
    assert far[0] < truth.max() + 1e-6


@pytest.mark.parametrize("axes", ["xy", "xyz"])
@pytest.mark.parametrize(("along", "angle"), [(1.0, 0.12), (0.6, 0.3), (0.0, 0.4)])
def test_distances_from_a_box_of_targets(axes, along, angle):
    """The end of the upper arm and a target that goes far while the arm turns a little."""
    arm = written.Chain([written.place(STILL, ORIGIN)] * 2, written.place(STILL, ORIGIN), [[-angle, angle]] * 2).stored()
    box = [[(-along).hex(), along.hex()], *[["0x0p+0"] * 2] * (len(axes) - 1)]
    lemma = {"link": 1, "point": [x.hex() for x in (1.0, 0.0, 0.0)], "least": "0x0p+0", "most": "0x0p+0"}
    task = {"xy": "planar", "xyz": "position"}[axes]
    target = {"axes": axes, "box": box, "orientation": None}
    limits = [joint["limits"] for joint in arm["joints"]]
    leaves = distances.RefutationVerifier(
        {"task": task, "target": target, "locked": -1, "arm": arm, "limits": limits, "lemmas": [lemma]}
    )
    middles = leaves.enclose_centers([((0, 0),) * len(leaves.width)])
    joints, place = middles[:1], middles[leaves.n :]
    half = np.stack([x[:, 2] for x in (*joints, *(place[axis] for axis in leaves.error_axes))], 1)
    near, far = leaves.bound_target_distance(0, joints, place, half)
    q, x = np.meshgrid(np.linspace(-angle, angle, 201), np.linspace(-along, along, 201))
    truth = np.hypot(np.cos(q) - x, np.sin(q))
    assert near[0] <= truth.min() + ROUNDING
    assert far[0] >= truth.max() - ROUNDING


# ---- relative manipulability ---------------------------------------------------------------------------------------


def random_frames(rng, n):
    """Frames of an arm that turns everywhere, and its tool."""
    turns = [written.turn(0, rng.choice([np.pi / 2, 1.0, -0.7])) @ written.turn(2, rng.uniform(-3, 3)) for _ in range(n + 1)]
    return [(turn, rng.uniform(-0.5, 0.5, 3)) for turn in turns]


def screws_from_the_middle(chain, q, first, point):
    """Axes and moments about a point, all seen from the link before the middle joint where that was at ``first``, (n, 6)."""
    middle, joints = chain.n // 2, at(*q)

    def frame(joints):
        moved = chain.enclose_point(joints[:middle], 0, chain.origins[middle])
        return moved.tip.center[0], moved.rotation.center[0]

    (here, turn), (there, then) = frame(joints), frame(at(*first))
    moved, back = chain.enclose_point(joints), then @ turn.T
    z = moved.axes.center[0] @ back.T
    places = (moved.points.center[0] - here) @ back.T + there
    return np.concatenate([z, np.cross(places - point, z)], axis=1)


@pytest.mark.parametrize("straight", [True, False])
def test_screws_behind_the_first_and_second_order(rng, straight):
    """Of random arms, and of stretched planar ones, at the corners of boxes; derivatives by finite differences."""
    for _ in range(1 if straight else 2):
        n = 5
        chain = make_chain(*([(STILL, [1.0, 0, 0])] * (n + 1) if straight else random_frames(rng, n)))
        q = np.zeros(n) if straight else rng.uniform(-2, 2, n)
        half = rng.uniform(0.02, 0.3, n) * rng.choice([0, 1], n)
        x = bounds.ScrewEnclosure(chain, at(*q, half=half))
        point = chain.enclose_point(at(*q)).points.center[0, n // 2]
        tip, z = chain.enclose_point(at(*q)).tip.center[0], chain.enclose_point(at(*q)).axes.center[0, n // 2]
        point = point + ((tip - point) @ z) * z
        for signs in itertools.product((-1.0, 1.0), repeat=n):
            way = half * np.array(signs)
            near = np.array([screws_from_the_middle(chain, q + k * 0.05 * way, q, point) for k in range(-3, 4)])
            one, two = (np.tensordot(STENCILS[order], near, 1) / 0.05**order for order in (1, 2))
            change = screws_from_the_middle(chain, q + way, q, point) - near[3]
            for left, bound in ((change - one, x.second_remainder[0]), (change - one - two / 2, x.third_remainder[0])):
                left = left[x.order]
                assert (np.linalg.norm(left[:, :3], axis=1) <= bound[:, 0] + 1e-7).all()
                assert (np.linalg.norm(left[:, 3:], axis=1) <= bound[:, 3] + 1e-7).all()


def kept(chain, q, locks):
    """Relative manipulability after each lock, by singular values: sqrt(det(J_k J_k') / det(J J'))."""
    moved = chain.enclose_point(at(*q))
    jacobian = np.concatenate([moved.axes.center[0], moved.columns.center[0]], axis=1).T
    rows = jacobian[np.abs(jacobian).max(axis=1) > 1e-9]
    whole = np.prod(np.linalg.svd(rows)[1])
    return [np.prod(np.linalg.svd(np.delete(rows, k, axis=1))[1]) / whole for k in locks]


@pytest.mark.parametrize("kind", ["ceiling", "floor"])
@pytest.mark.parametrize("width", [0.05, 0.3])
@pytest.mark.parametrize("planar", [True, False])
def test_manipulability_at_the_edge_of_a_leaf(rng, kind, width, planar):
    """The sharpest threshold that a leaf proves, when one joint moves, lies on the right side of the sampled extreme."""
    n = 4 if planar else 7
    tight = []
    for _ in range(4):
        links = [(STILL, [length, 0, 0]) for length in rng.uniform(0.3, 1, n + 1)]
        chain = make_chain(*(links if planar else random_frames(rng, n)))
        q, moving = rng.uniform(-2, 2, n), int(rng.integers(1, n - 1))
        half = np.where(np.arange(n) == moving, width, 0.0)
        lock = int(rng.integers(n))
        box = [[(x - h).hex(), (x + h).hex()] for x, h in zip(q.tolist(), half.tolist(), strict=True)]
        arm = written.Chain(
            [written.place(turn.center, origin) for turn, origin in zip(chain.turns[:-1], chain.origins[:-1], strict=True)],
            written.place(chain.turns[-1].center, chain.origins[-1]),
            [[-4.0, 4.0]] * n,
        ).stored()
        given = {"joint_box": box, "arm": arm, "task": "planar-pose" if planar else "pose", "locks": [lock]}
        leaves = (bounds.CeilingVerifier if kind == "ceiling" else bounds.FloorVerifier)(given | {"threshold": (0.5).hex()})
        truth = [kept(chain, q + t * half, [lock])[0] for t in np.linspace(-1, 1, 21)]
        low, high = 1e-6, 1.0
        for _ in range(13):
            leaves.threshold = (low + high) / 2
            proved = bool(leaves.verify_leaves(lock if kind == "ceiling" else 0, [(((0, 0),) * n, 0)])[0])
            low, high = (low, leaves.threshold) if proved == (kind == "ceiling") else (leaves.threshold, high)
        extreme = max(truth) if kind == "ceiling" else min(truth)
        gap = high - extreme if kind == "ceiling" else extreme - low
        assert gap >= -1e-6
        tight.append(gap)
    assert min(tight) < 0.1
